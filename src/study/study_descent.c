/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least value of an objective where constraints are at most 0, of few judgements that cost much: two ways to choose
   what is judged next.

   COBYLA (linear models on a simplex, no derivatives; Powell 1994, as NLopt has it), each constraint with models of its own: those
   of the largest of them mix up what belongs to different ones. It ends where nothing better has come for long. It is for
   searches that know nothing but their start: worst cases, and dies at a wanted yield.

   And from what was judged already, on from the best of it or from one place: around the best of it quadratic models of the
   objective and of each constraint, or of each part of those that are the largest of several, by weighted least squares, the
   nearest counting most; and a plane between what holds and what does not although no model says so (a region where check
   accepts nothing, and says no number by which it does not). Next is judged what is best by these within a radius. Each answer
   turns the plane, so the border of such a region is halved, and followed where the objective falls along it. Nothing is
   proved. Test: tests/unit/study/test_descent.c */
#include "chance/random.h"
#include "maths/matrix.h"
#include "study/study_parts.h"
#include <math.h>
#include <nlopt.h>
#include <string.h>

static bool better(const fw_study_tried *a, const fw_study_tried *b, int m) {
    return fw_study_search_better(a->f, fw_study_tried_worst(a, m), b->f,
                                  fw_study_tried_worst(b, m));
}

static const fw_study_tried *look(fw_study_descent *d, const double *x) {
    const size_t bytes = (size_t)d->n * sizeof *x;
    const fw_study_tried *last = d->used > 0 ? &d->tried[d->used - 1] : NULL;
    if (last && (d->over || memcmp(x, last->x, bytes) == 0)) return last;
    fw_study_tried *t = &d->tried[d->used++];
    memcpy(t->x, x, bytes);
    if (!d->judge(d->context, t) || d->used >= d->most) d->over = true;
    return t;
}

/* ---- COBYLA ---- */

static const double rho = 0.15;        /* first step, share of a range */
static const double fine = 2e-4;       /* last step */
static const double as_bad_as = 1e3;   /* of what could not be run */
static const double gain_least = 2e-4; /* share of the objective that is worth a judgement */
static const double inside = 2e-4; /* by which models have to hold; worth one of what does not */
enum { IDLE = 4 }; /* judgements for each input, and so many more, without a better one: enough */

typedef struct simplex {
    fw_study_descent *d;
    nlopt_opt opt;
    double scale;
    const fw_study_tried *best;
    int at; /* judgements when it came */
} simplex;

/* by what is worth a judgement */
static bool clearly_better(const fw_study_tried *a, const fw_study_tried *b, int m) {
    const double ca = fw_study_tried_worst(a, m), cb = fw_study_tried_worst(b, m);
    if (!better(a, b, m)) return false;
    if (ca <= 0 && cb <= 0) return a->f < b->f - gain_least * fabs(b->f);
    return ca <= 0 || isnan(cb) || ca < cb - inside;
}

static const fw_study_tried *vertex(simplex *s, const double *x) {
    const int was = s->d->used;
    const fw_study_tried *t = look(s->d, x);
    if (!(s->scale > 0) && isfinite(t->f)) s->scale = fmax(fabs(t->f), 1e-300);
    if (s->d->used > was && (!s->best || clearly_better(t, s->best, s->d->m)))
        s->best = t, s->at = s->d->used;
    if (s->d->over || s->d->used - s->at >= IDLE * (s->d->n + 1)) nlopt_force_stop(s->opt);
    return t;
}

static double objective(unsigned n, const double *x, double *gradient, void *context) {
    simplex *s = context;
    (void)n, (void)gradient;
    const double f = vertex(s, x)->f;
    return isfinite(f) ? f / s->scale : as_bad_as;
}

static void constraints(unsigned m, double *c, unsigned n, const double *x, double *gradient,
                        void *context) {
    (void)n, (void)gradient;
    const fw_study_tried *t = vertex(context, x);
    for (unsigned k = 0; k < m; k++)
        c[k] = isfinite(t->c[k]) ? t->c[k] : as_bad_as;
}

static fw_status tolerances(fw_arena *arena, int m, double each, double **near) {
    FW_NEED(*near = fw_arena_array(arena, double, (size_t)m));
    for (int k = 0; k < m; k++)
        (*near)[k] = each;
    return FW_OK;
}

fw_status fw_study_descent_cobyla(fw_study_descent *d, double *start, fw_arena *arena) {
    simplex s = {.d = d};
    double least, *near;
    FW_TRY(tolerances(arena, d->m, 1e-9, &near));
    FW_NEED(s.opt = nlopt_create(NLOPT_LN_COBYLA, (unsigned)d->n));
    nlopt_set_min_objective(s.opt, objective, &s);
    nlopt_add_inequality_mconstraint(s.opt, (unsigned)d->m, constraints, &s, near);
    nlopt_set_lower_bounds1(s.opt, 0);
    nlopt_set_upper_bounds1(s.opt, 1);
    nlopt_set_initial_step1(s.opt, d->step > 0 ? d->step : rho);
    nlopt_set_xtol_abs1(s.opt, fine);
    nlopt_set_maxeval(s.opt, d->most);
    nlopt_optimize(s.opt, start, &least); /* what it met is what counts */
    nlopt_destroy(s.opt);
    return FW_OK;
}

/* ---- what was judged, around the best ---- */

enum {
    CROSS = 8,      /* inputs up to which models have products of two of them */
    THROWN = 400,   /* places that are looked at by the models */
    AROUND = 80,    /* and around the best of these, in narrower boxes */
    NARROWER = 5,   /* boxes */
    STEPS = 100,    /* of SLSQP on the models */
    SWEEPS = 500,   /* for a plane */
    PLANE_REACH = 3 /* radii within which a plane counts what was judged */
};
static const double reach = 0.1;        /* first radius, share of a range */
static const double least_reach = 2e-3; /* last one */
static const double away_reach = 0.02; /* down to it places far from what does not hold are tried */
static const double offset = 0.1;      /* the plane is sought near the best */
static const double again_least = 5e-3; /* and to begin with wide steps again */
static const double apart = 2e-4;       /* of a place from all that was judged, share of a range */
/* of the span of the objective, where it is nearly 0: along a valley in a wide range what is gained is little of it */
static const double span_counts = 1e-3;
static const double as_largest_within = 1e-6; /* a number is the largest of its parts */
static const double nearer = 4; /* times as far it may be from what holds as from what does not */

typedef enum side { HOLDS, NUMBERED, UNTOLD } side; /* does not: models say so; none does */

typedef struct support { /* a device near enough to have a share in the plane */
    const double *u;
    double y, square, most, alpha;
} support;

typedef struct cloud {
    int n, m, terms;
    const fw_study_tried **at; /* (count) */
    side *side;
    int count, known;           /* known: before this search */
    const fw_study_tried *from; /* where it begins; NULL: at the best of what is known */
    const fw_study_tried *best;
    double radius, scale; /* scale: of the objective */
    double enough;     /* what has to be reached for a judgement: objective, or worst constraint */
    bool walled, away; /* there is a plane; far from what does not hold is better */
    double margin;     /* from the plane; 1: as far as what holds nearest to it */
    /* A number that is the largest of several has a model of each, since it has edges where another one becomes the largest:
       number k has models row[k] to row[k + 1] - 1, of its parts from part_at[k] on, or one of itself */
    const int *parts;
    int *row, *part_at; /* (m + 2), (m + 1) */
    double *beta;       /* (rows x terms) of u = (x - best) / radius, less what the best has */
    double *normal;     /* (n + 1): plane, normal u + offset last = 0; what holds below 0 */
    support *support;   /* of the plane, with their places */
    double *near_u;
    double *matrix, *basis, *near; /* room for a model, its terms, tolerances */
    int *pivot;
    double *u, *x, *trial, *middle; /* (n) each */
} cloud;

static bool holds(const fw_study_tried *t, int m) {
    return !isnan(t->f) && !t->untold && fw_study_tried_worst(t, m) <= 0;
}

/* of a search from one place the others that are known teach its models, but it does not go to them */
static void find_best(cloud *c) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    c->best = NULL;
    for (int p = 0; p < c->count; p++) {
        const fw_study_tried *t = c->at[p];
        if (isnan(t->f)) continue;
        least = fmin(least, t->f), most = fmax(most, t->f);
        if (c->from && p < c->known && t != c->from) continue;
        if (!c->best || better(t, c->best, c->m)) c->best = t;
    }
    if (c->best) c->scale = fmax(fmax(fabs(c->best->f), span_counts * (most - least)), 1e-300);
}

/* the largest share of the radius */
static double place(const cloud *c, const double *x, double *u) {
    double most = 0;
    for (int i = 0; i < c->n; i++) {
        u[i] = (x[i] - c->best->x[i]) / c->radius;
        most = fmax(most, fabs(u[i]));
    }
    return most;
}

/* ---- models ---- */

static int terms_of(int n) {
    return n <= CROSS ? n + n * (n + 1) / 2 : 2 * n;
}

static void basis_of(int n, const double *u, double *b) {
    int at = n;
    for (int i = 0; i < n; i++) {
        b[i] = u[i];
        b[at++] = u[i] * u[i];
        for (int j = 0; j < i && n <= CROSS; j++)
            b[at++] = u[i] * u[j];
    }
}

/* 0: objective; k: constraint k - 1 */
static double number_of(const fw_study_tried *t, int k) {
    return k == 0 ? t->f : t->untold ? (double)NAN : t->c[k - 1];
}

static int rows_of(const cloud *c, int k) {
    return c->row[k + 1] - c->row[k];
}

/* what model r of number k is of */
static double part_of(const cloud *c, const fw_study_tried *t, int k, int r) {
    return rows_of(c, k) > 1 ? t->part[c->part_at[k] + r] : number_of(t, k);
}

/* is it the largest of its parts in the best, and in nine of ten that were judged? Where check has another reason it is not */
static bool is_largest(const cloud *c, int k) {
    const int n = c->parts ? c->parts[k] : 0;
    int known = 0, off = 0;
    for (int p = 0; n > 1 && p < c->count; p++) {
        const fw_study_tried *t = c->at[p];
        const double is = number_of(t, k);
        double most = -HUGE_VAL;
        for (int r = 0; r < n; r++)
            most = isnan(t->part[c->part_at[k] + r]) ? (double)NAN
                                                     : fmax(most, t->part[c->part_at[k] + r]);
        if (!isfinite(is)) continue;
        const bool as_largest = fabs(is - most) <= as_largest_within * fmax(fabs(is), 1e-3);
        if (!as_largest && t == c->best) return false;
        known++, off += !as_largest;
    }
    return known > 0 && 10 * off <= known;
}

static void find_rows(cloud *c) {
    for (int k = 0, part = 0; k <= c->m; k++) {
        c->part_at[k] = part;
        part += c->parts ? c->parts[k] : 0;
        c->row[k + 1] = c->row[k] + (is_largest(c, k) ? c->parts[k] : 1);
    }
}

/* of one model b (terms) of u, (n) */
static void slope(const cloud *c, const double *b, const double *u, double *g) {
    int at = c->n;
    for (int i = 0; i < c->n; i++)
        g[i] = b[i];
    for (int i = 0; i < c->n; i++) {
        g[i] += 2 * u[i] * b[at++];
        for (int j = 0; j < i && c->n <= CROSS; j++, at++)
            g[i] += b[at] * u[j], g[j] += b[at] * u[i];
    }
}

/* model r of number k where the terms are c->basis */
static double model_of(const cloud *c, int k, int r) {
    const double *b = c->beta + (c->row[k] + r) * c->terms;
    double sum = part_of(c, c->best, k, r);
    for (int t = 0; t < c->terms; t++)
        sum += b[t] * c->basis[t];
    return sum;
}

static double model(const cloud *c, int k, const double *u) {
    double most = -HUGE_VAL;
    basis_of(c->n, u, c->basis);
    for (int r = 0; r < rows_of(c, k); r++)
        most = fmax(most, model_of(c, k, r));
    return most;
}

/* Squares are held back where nothing says how large they are: by so little that along a valley, whose floor bends a thousandth
   as much as its sides, what holds the sides back does not hide the floor. Test: test_descent.c, valleys */
static void fit(cloud *c, int k) {
    const int n = c->terms, rows = rows_of(c, k);
    double *a = c->matrix, *all = c->beta + c->row[k] * n, sum = 0;
    memset(a, 0, (size_t)(n * n) * sizeof *a);
    memset(all, 0, (size_t)(rows * n) * sizeof *all);
    for (int p = 0; p < c->count; p++) {
        const fw_study_tried *t = c->at[p];
        if (!isfinite(number_of(t, k) - number_of(c->best, k)) || t == c->best) continue;
        const double r = place(c, t->x, c->u), r4 = r * r * r * r, w = 1 / (1 + r4 * r4);
        basis_of(c->n, c->u, c->basis);
        sum += w;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                a[i * n + j] += w * c->basis[i] * c->basis[j];
        for (int of = 0; of < rows; of++) {
            const double off = part_of(c, t, k, of) - part_of(c, c->best, k, of);
            for (int i = 0; i < n && isfinite(off); i++)
                all[of * n + i] += w * off * c->basis[i];
        }
    }
    for (int i = 0; i < n; i++)
        a[i * n + i] += fmax(sum, 1e-9) * (i < c->n ? 1e-7 : 1e-5);
    const bool solvable = fw_maths_lu_factor(n, a, c->pivot);
    for (int of = 0; of < rows && solvable; of++)
        fw_maths_lu_solve(n, a, c->pivot, NULL, all + of * n);
    if (!solvable) memset(all, 0, (size_t)(rows * n) * sizeof *all);
}

static void find_sides(cloud *c) {
    for (int p = 0; p < c->count; p++) {
        const fw_study_tried *t = c->at[p];
        c->side[p] = holds(t, c->m) ? HOLDS : UNTOLD;
        if (c->side[p] == HOLDS || isnan(t->f) || t->untold) continue;
        place(c, t->x, c->u);
        for (int k = 1; k <= c->m; k++)
            if (!(model(c, k, c->u) <= 0)) c->side[p] = NUMBERED;
    }
}

/* ---- the plane ---- */

static double over_plane(const cloud *c, const double *u) {
    double sum = offset * c->normal[c->n];
    for (int i = 0; i < c->n; i++)
        sum += c->normal[i] * u[i];
    return sum;
}

/* its share changes: how much of it */
static double turn_plane(cloud *c, support *s) {
    const double was = s->alpha;
    s->alpha = fmin(fmax(was - (s->y * over_plane(c, s->u) - 1) / s->square, 0), s->most);
    const double by = (s->alpha - was) * s->y;
    c->normal[c->n] += offset * by;
    for (int i = 0; i < c->n && by != 0; i++)
        c->normal[i] += by * s->u[i];
    return fabs(by) / (1 + was);
}

static int find_supports(cloud *c) {
    int n = 0;
    c->walled = false;
    for (int p = 0; p < c->count; p++) {
        double *u = c->near_u + n * c->n, square = offset * offset;
        const double r = place(c, c->at[p]->x, u);
        if (r > PLANE_REACH || c->side[p] == NUMBERED) continue;
        for (int i = 0; i < c->n; i++)
            square += u[i] * u[i];
        c->support[n++] = (support){.u = u,
                                    .y = c->side[p] == UNTOLD ? 1 : -1,
                                    .square = square,
                                    .most = 1e5 / (1 + r * r * r * r)};
        c->walled |= c->side[p] == UNTOLD;
    }
    return n;
}

/* The plane with the most room on both sides between what holds and what does not although no model says so, the nearest
   counting most: a support vector machine, its dual by coordinates (C.-J. Hsieh and others, A dual coordinate descent method
   for large-scale linear SVM, ICML 2008). */
static void find_plane(cloud *c) {
    const int n = find_supports(c);
    double moved = c->walled ? 1 : 0;
    memset(c->normal, 0, (size_t)(c->n + 1) * sizeof *c->normal);
    for (int sweep = 0; sweep < SWEEPS && moved > 1e-4; sweep++) {
        moved = 0;
        for (int k = 0; k < n; k++)
            moved = fmax(moved, turn_plane(c, &c->support[k]));
    }
}

/* ---- what is judged next ---- */

/* apart from all that was judged, and not much nearer to what does not hold than to what does */
static bool may_hold(const cloud *c, const double *x, double *to_untold) {
    double to_held = HUGE_VAL;
    *to_untold = HUGE_VAL;
    for (int p = 0; p < c->count; p++) {
        double d = 0;
        for (int i = 0; i < c->n; i++)
            d += (x[i] - c->at[p]->x[i]) * (x[i] - c->at[p]->x[i]);
        d = sqrt(d);
        if (d < apart) return false;
        if (c->side[p] == UNTOLD) *to_untold = fmin(*to_untold, d);
        if (c->side[p] == HOLDS) to_held = fmin(to_held, d);
    }
    return !c->walled || !(to_held > nearer * *to_untold);
}

/* what is to be small; HUGE_VAL: not worth a judgement */
static double score(const cloud *c, const double *x) {
    const bool held = holds(c->best, c->m);
    double worst = -HUGE_VAL, to_untold;
    place(c, x, c->u);
    for (int k = 1; k <= c->m; k++)
        worst = fmax(worst, model(c, k, c->u));
    if (held && worst > -inside) return HUGE_VAL;
    if (held && c->walled && over_plane(c, c->u) > -c->margin) return HUGE_VAL;
    const double f = held ? model(c, 0, c->u) : worst;
    if (!(f < c->enough) || !may_hold(c, x, &to_untold)) return HUGE_VAL;
    return c->away ? -to_untold : f;
}

/* the k-th place in a box around the middle; of every third only one input differs */
static void throw_one(const cloud *c, uint64_t seed, int k, double width, double *x) {
    for (int i = 0; i < c->n; i++) {
        const double by = 2 * fw_chance_uniform(seed, (uint64_t)k, (uint64_t)i) - 1;
        const bool stays = k % 3 == 0 && (k / 3) % c->n != i;
        x[i] = stays ? c->middle[i] : c->middle[i] + width * by;
        x[i] = fmin(fmax(x[i], c->best->x[i] - c->radius), c->best->x[i] + c->radius);
        x[i] = fmin(fmax(x[i], 0), 1);
    }
}

/* Of an objective that is the largest of its parts the least is sought of one more variable, which no part is above */
static bool is_lifted(const cloud *c) {
    return rows_of(c, 0) > 1;
}

static double modelled(unsigned n, const double *u, double *gradient, void *context) {
    const cloud *c = context;
    const bool lifted = is_lifted(c);
    if (gradient && !lifted) slope(c, c->beta, u, gradient);
    for (unsigned i = 0; gradient && i < n; i++)
        gradient[i] = lifted ? i + 1 == n : gradient[i] / c->scale;
    return lifted ? u[n - 1] : (model(c, 0, u) - c->best->f) / c->scale;
}

/* gradient: (m x n) */
static void modelled_limits(unsigned m, double *limit, unsigned n, const double *u,
                            double *gradient, void *context) {
    const cloud *c = context;
    const bool lifted = is_lifted(c);
    double *g = gradient;
    if (g) memset(g, 0, (size_t)m * n * sizeof *g);
    basis_of(c->n, u, c->basis);
    for (int k = lifted ? 0 : 1; k <= c->m; k++)
        for (int r = 0; r < rows_of(c, k); r++, g = g ? g + n : NULL) {
            const double is = model_of(c, k, r);
            *limit++ = k > 0 ? is + 1.5 * inside : (is - c->best->f) / c->scale - u[c->n];
            if (g) slope(c, c->beta + (c->row[k] + r) * c->terms, u, g);
            for (int i = 0; i < c->n && g && k == 0; i++)
                g[i] /= c->scale;
            if (g && k == 0) g[c->n] = -1;
        }
    if (!c->walled) return;
    *limit = over_plane(c, u) + c->margin + 1e-3;
    if (g) memcpy(g, c->normal, (size_t)c->n * sizeof *g);
}

/* trial: the least of the models from x on, by SLSQP (Kraft 1988, as NLopt has it) */
static fw_status settle(cloud *c) {
    double least;
    const int n = c->n + is_lifted(c),
              m = c->row[c->m + 1] - (is_lifted(c) ? 0 : c->row[1]) + c->walled;
    nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, (unsigned)n);
    FW_NEED(opt);
    nlopt_set_min_objective(opt, modelled, c);
    nlopt_add_inequality_mconstraint(opt, (unsigned)m, modelled_limits, c, c->near);
    place(c, c->x, c->trial);
    if (n > c->n) c->trial[c->n] = (model(c, 0, c->trial) - c->best->f) / c->scale;
    for (int i = 0; i < c->n; i++) {
        nlopt_set_lower_bound(opt, i, fmax(-1, -c->best->x[i] / c->radius));
        nlopt_set_upper_bound(opt, i, fmin(1, (1 - c->best->x[i]) / c->radius));
    }
    nlopt_set_xtol_abs1(opt, 1e-5);
    nlopt_set_maxeval(opt, STEPS);
    nlopt_optimize(opt, c->trial, &least);
    nlopt_destroy(opt);
    for (int i = 0; i < c->n; i++)
        c->trial[i] = fmin(fmax(c->best->x[i] + c->radius * c->trial[i], 0), 1);
    return FW_OK;
}

/* x: the most promising place; *found false: none is worth a judgement, and x is the best's */
static fw_status choose(cloud *c, uint64_t seed, bool *found) {
    const size_t bytes = (size_t)c->n * sizeof *c->x;
    double best = HUGE_VAL, width = c->radius, now;
    int thrown = 0;
    memcpy(c->x, c->best->x, bytes);
    for (int box = 0; box <= NARROWER && (box == 0 || isfinite(best)); box++, width *= 0.4) {
        memcpy(c->middle, c->x, bytes);
        for (int k = 0; k < (box == 0 ? THROWN : AROUND); k++) {
            throw_one(c, seed, thrown++, width, c->trial);
            if (!((now = score(c, c->trial)) < best)) continue;
            best = now;
            memcpy(c->x, c->trial, bytes);
        }
    }
    if (!c->away && holds(c->best, c->m)) {
        FW_TRY(settle(c));
        if ((now = score(c, c->trial)) < best) {
            best = now;
            memcpy(c->x, c->trial, bytes);
        }
    }
    *found = isfinite(best);
    return FW_OK;
}

/* by all that is known; and where the plane leaves nothing, but is only guessed by few, far from what does not hold */
static fw_status choose_next(cloud *c, uint64_t seed, bool *found) {
    const bool held = holds(c->best, c->m);
    find_rows(c);
    for (int k = 0; k <= c->m; k++)
        fit(c, k);
    find_sides(c);
    find_plane(c);
    c->away = false;
    c->enough =
        held ? c->best->f - gain_least * c->scale : fw_study_tried_worst(c->best, c->m) - inside;
    FW_TRY(choose(c, seed, found));
    if (*found || !held || !c->walled || c->radius < away_reach) return FW_OK;
    c->walled = false, c->away = true;
    return choose(c, seed, found);
}

/* how far to go next, by what became of the place */
static void learn(cloud *c, const fw_study_tried *t) {
    const fw_study_tried *was = c->best;
    const double gone = place(c, t->x, c->u);
    c->at[c->count++] = t;
    find_best(c);
    if (c->best != was) {
        c->margin = 0;
        if (gone > 0.7) c->radius = fmin(1.6 * c->radius, 2 * reach);
        return;
    }
    if (!t->untold) { /* models learn where they bend: where the largest of several numbers rules */
        c->radius *= c->away ? 0.6 : 0.7, c->margin = 0;
        return;
    }
    /* a plane is known by as many answers as there are inputs, and some */
    c->margin += 1.2 / (c->n + 2);
    if (c->away || c->margin > 0.95) c->radius *= 0.6, c->margin = 0;
}

static fw_status cloud_new(fw_arena *arena, const fw_study_descent *d, const fw_study_tried *known,
                           int nknown, cloud *c) {
    const size_t most = (size_t)(nknown + d->most), n = (size_t)d->n;
    *c = (cloud){.n = d->n, .m = d->m, .terms = terms_of(d->n), .radius = reach, .parts = d->parts};
    const size_t terms = (size_t)c->terms;
    int rows = c->m + 1;
    for (int k = 0; d->parts && k <= c->m; k++)
        rows += d->parts[k];
    FW_NEED(c->at = fw_arena_array(arena, const fw_study_tried *, most));
    FW_NEED(c->side = fw_arena_array(arena, side, most));
    FW_NEED(c->support = fw_arena_array(arena, support, most));
    FW_NEED(c->near_u = fw_arena_array(arena, double, most *n));
    FW_NEED(c->beta = fw_arena_array(arena, double, terms *(size_t)rows));
    FW_NEED(c->row = fw_arena_array(arena, int, (size_t)c->m + 2));
    FW_NEED(c->part_at = fw_arena_array(arena, int, (size_t)c->m + 1));
    FW_NEED(c->matrix = fw_arena_array(arena, double, terms *terms));
    FW_NEED(c->pivot = fw_arena_array(arena, int, terms));
    FW_NEED(c->basis = fw_arena_array(arena, double, terms));
    FW_NEED(c->normal = fw_arena_array(arena, double, n + 1));
    FW_NEED(c->u = fw_arena_array(arena, double, 4 * n + 1)); /* and a variable of settle */
    c->x = c->u + n, c->middle = c->x + n, c->trial = c->middle + n;
    for (int i = 0; i < nknown; i++)
        c->at[c->count++] = &known[i];
    c->known = nknown, c->from = d->from;
    find_best(c);
    return tolerances(arena, rows + 1, 1e-8, &c->near);
}

/* is it worth to begin with wide steps again? */
static bool gained(const cloud *c, const fw_study_tried *was) {
    return holds(c->best, c->m) &&
           (!holds(was, c->m) || c->best->f < was->f - again_least * c->scale);
}

fw_status fw_study_descent_models(fw_study_descent *d, const fw_study_tried *known, int nknown,
                                  fw_arena *arena) {
    cloud c;
    FW_TRY(cloud_new(arena, d, known, nknown, &c));
    const fw_study_tried *was = NULL;
    uint64_t seed = 0;
    while (c.best && !d->over && (!was || gained(&c, was))) {
        was = c.best;
        for (c.radius = reach, c.margin = 0; !d->over && c.radius > least_reach;) {
            bool found;
            FW_TRY(choose_next(&c, ++seed, &found));
            if (found)
                learn(&c, look(d, c.x));
            else
                c.radius *= 0.5, c.margin = 0;
        }
    }
    return FW_OK;
}
