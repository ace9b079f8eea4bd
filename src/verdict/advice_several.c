/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smallest change of several values at once that satisfies every check.

   In: a device that is not accepted; n values that may be changed, each with its ends. z: their
   changes (fw_verdict_variable_z), 0 as described; g(z): the checks (trial.c), accepted
   where all are below 0.

   Out: z with the least sum |z_i| that was found, at which the whole verdict accepts, or none.

   Method: successive linear programmes. The slopes dg/dz are differences at z = 0, one look for
   each value, and are corrected after every further look by Broyden's rank-one formula. Each round
   solves

     min  sum |y_i|    g + b + G (y - z) <= -m,   |y_i - z_i| <= d,   ends of the values

   b: what the corners, and the last whole verdict, add to a look, m: a small margin, d: the trust region,
   which shrinks where a step makes the worst check no better and grows where it does. What cannot
   be held is exceeded as little as possible. Looks are coarse and at the corners that refused
   last; where one may be accepted the whole verdict is asked for. Because the sum of sizes is
   minimised and not that of their squares, a solution changes no more values than there are checks
   at their limits: one where one is enough. In the end the straight way back from what is accepted
   to what is described is halved until less of it by 1.5 % is not accepted.

   Values are decimal numbers in the units as written at every look; what is printed was judged.

   Validity: a local method: it finds what can be reached along slopes. A check without a number
   (a drawing that overlaps, a workspace out of reach) only says that a step was too long.

   Cost: at most MOST_LOOKS looks, n + 15 to n + 30 usually, and most_work evaluations of hinges.

   Source: R. Fletcher, Practical Methods of Optimization (1987), ch. 14 (linear programmes in
   succession); C. G. Broyden, Math. Comp. 19 (1965) 577.

   Test: tests/cli/test_advice.py, test_two_at_once, test_of_opposite_corners, test_of_mixed_reasons. */
#include "verdict/advice.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

enum { MOST_LOOKS = 80, MOST_ROUNDS = 24, MOST_HALVINGS = 7, MOST_REFRESHED = 3 };
static const double first_step = 0.04, first_trust = 0.35, most_trust = 1.2, least_trust = 0.004;
static const double margin = 0.003;         /* of the checks in a programme */
static const double less = 0.985;           /* of the change is not accepted */
static const double worth_going_on = 0.985; /* the next accepted change is smaller than that */
static const double clearly = 0.9;          /* ... than what is known already */
static const double penalty = 1e3;
static const double most_off = 1;
static const double furthest = 0.03;       /* of g that a whole verdict may still accept */
static const double worth_judging = 0.005; /* of g: wholly, which may take long */

typedef struct point { /* where a look was taken */
    double *z, *x, *g; /* (n), (n) as typed, (m) */
    bool drawn, rejected, accepted;
} point;

typedef struct search {
    fw_verdict_trial *trial;
    const fw_verdict_variable *variable;
    int n, m, looks;
    double smaller_than, most_work, trust;
    double over; /* what the last programme could not hold */
    int refreshed;
    bool stale;          /* slopes are no more those of differences */
    double *slope, *off; /* (m x n), (m) */
    double *sloped;      /* (n) z where slopes were differences last */
    point now, next, best;
    bool found;
} search;

static bool spent(const search *s) {
    return s->looks >= MOST_LOOKS || s->trial->work >= s->most_work;
}

static fw_status new_point(fw_arena *arena, int n, int m, point *p) {
    FW_NEED(p->z = fw_arena_array(arena, double, (size_t)n));
    FW_NEED(p->x = fw_arena_array(arena, double, (size_t)n));
    FW_NEED(p->g = fw_arena_array(arena, double, (size_t)m));
    return FW_OK;
}

static void copy(const search *s, point *to, const point *from) {
    memcpy(to->z, from->z, (size_t)s->n * sizeof *to->z);
    memcpy(to->x, from->x, (size_t)s->n * sizeof *to->x);
    memcpy(to->g, from->g, (size_t)s->m * sizeof *to->g);
    to->drawn = from->drawn, to->rejected = from->rejected, to->accepted = from->accepted;
}

static double size_of(const search *s, const point *p) {
    double sum = 0;
    for (int i = 0; i < s->n; i++)
        sum += fw_verdict_variable_size(&s->variable[i], p->x[i]);
    return sum;
}

/* ---- looks ---- */

/* p->z as it would be typed */
static void type(const search *s, point *p) {
    for (int i = 0; i < s->n; i++) {
        const fw_verdict_variable *v = &s->variable[i];
        p->x[i] = fw_verdict_variable_typed(v, fw_verdict_variable_x(v, p->z[i]));
        p->z[i] = fw_verdict_variable_z(v, p->x[i]);
    }
}

/* at p->x */
static fw_status look(search *s, fw_verdict_look how, point *p) {
    fw_verdict_trial *t = s->trial;
    const fw_device_set *set;
    int nset;
    FW_TRY(fw_verdict_variables_settings(t->arena, s->variable, s->n, p->x, &set, &nset));
    s->looks++;
    FW_TRY(fw_verdict_trial_restate(t, set, nset, how));
    memcpy(p->g, t->check, (size_t)s->m * sizeof *p->g);
    for (int k = 0; k < s->m; k++)
        if (!isnan(t->made[k] - t->check[k])) s->off[k] = fmax(t->made[k] - t->check[k], s->off[k]);
    p->drawn = t->drawn;
    p->rejected = t->decision == FW_REJECT || !t->drawn;
    p->accepted = t->decision == FW_ACCEPT && t->drawn;
    return FW_OK;
}

/* of what has numbers the worst, 0 where nothing is beyond its limit; nothing has: infinite */
static double worst_of(const search *s, const point *p) {
    double worst = -HUGE_VAL;
    for (int k = 0; k < s->m; k++)
        if (!isnan(p->g[k])) worst = fmax(worst, p->g[k] + s->off[k]);
    return isinf(worst) || !p->drawn ? HUGE_VAL : worst;
}

/* ---- slopes ---- */

/* into next: z + h along i, inwards from the end that is too near */
static void step_along(search *s, int i) {
    const fw_verdict_variable *v = &s->variable[i];
    const double x = fw_verdict_variable_x(v, s->now.z[i] + first_step);
    const bool room = fw_verdict_variable_z(v, x) >= s->now.z[i] + 0.5 * first_step;
    copy(s, &s->next, &s->now);
    s->next.z[i] += room ? first_step : -first_step;
    s->next.x[i] = fw_verdict_variable_typed(v, fw_verdict_variable_x(v, s->next.z[i]));
    s->next.z[i] = fw_verdict_variable_z(v, s->next.x[i]);
}

static fw_status differences(search *s) {
    memcpy(s->sloped, s->now.z, (size_t)s->n * sizeof *s->sloped);
    for (int i = 0; i < s->n && !spent(s); i++) {
        step_along(s, i);
        const double h = s->next.z[i] - s->now.z[i];
        if (h == 0) continue;
        FW_TRY(look(s, FW_LOOK_VALUES, &s->next));
        for (int k = 0; k < s->m; k++) {
            const double d = s->next.g[k] - s->now.g[k];
            s->slope[k * s->n + i] = isnan(d) ? 0 : d / h;
        }
    }
    return FW_OK;
}

/* G += (dg - G dz) dz^T / |dz|^2 */
static void correct(search *s) {
    double squares = 0;
    for (int i = 0; i < s->n; i++)
        squares += (s->next.z[i] - s->now.z[i]) * (s->next.z[i] - s->now.z[i]);
    for (int k = 0; squares > 0 && k < s->m; k++) {
        double rest = s->next.g[k] - s->now.g[k], *row = s->slope + (size_t)k * (size_t)s->n;
        if (isnan(rest)) continue;
        for (int i = 0; i < s->n; i++)
            rest -= row[i] * (s->next.z[i] - s->now.z[i]);
        for (int i = 0; i < s->n; i++)
            row[i] += rest * (s->next.z[i] - s->now.z[i]) / squares;
    }
}

/* ---- the programme ---- */

typedef struct programme { /* y_i = from_i + p_i - q_i */
    double *a, *b, *c, *from, *x;
    int rows;
} programme;

/* y_i of the trust region and the ends, as p_i and q_i from the end that is nearer to 0 */
static void bound(const search *s, int i, programme *l) {
    const fw_verdict_variable *v = &s->variable[i];
    const double low = fmin(0, fw_verdict_variable_z(v, v->value.low)),
                 high = fmax(0, fw_verdict_variable_z(v, v->value.high));
    const double least = fmax(low, s->now.z[i] - s->trust),
                 most = fmin(high, s->now.z[i] + s->trust);
    l->from[i] = fmin(fmax(0, least), most);
    const double room[2] = {most - l->from[i], l->from[i] - least};
    for (int k = 0; k < 2; k++) {
        double *row = l->a + (size_t)l->rows * 2 * (size_t)s->n;
        memset(row, 0, 2 * (size_t)s->n * sizeof *row);
        row[2 * i + k] = 1;
        l->b[l->rows++] = fmax(room[k], 0);
    }
    l->c[2 * i] = l->c[2 * i + 1] = 1;
}

static void hold(const search *s, int k, programme *l) {
    double *row = l->a + (size_t)l->rows * 2 * (size_t)s->n;
    double rest = -margin - s->now.g[k] - s->off[k];
    for (int i = 0; i < s->n; i++) {
        const double slope = s->slope[k * s->n + i];
        row[2 * i] = slope, row[2 * i + 1] = -slope;
        rest += slope * (s->now.z[i] - l->from[i]);
    }
    l->b[l->rows++] = rest;
}

/* into next.z; *moved: how far any value is from where it is now */
static fw_status solve(search *s, double *moved) {
    fw_arena *arena = s->trial->arena;
    const size_t n = 2 * (size_t)s->n, m = (size_t)s->m + n;
    programme l = {.rows = 0};
    double t;
    bool solved;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(l.a = fw_arena_array(arena, double, m *n));
    FW_NEED(l.b = fw_arena_array(arena, double, m));
    FW_NEED(l.c = fw_arena_array(arena, double, n));
    FW_NEED(l.x = fw_arena_array(arena, double, n));
    FW_NEED(l.from = fw_arena_array(arena, double, (size_t)s->n));
    for (int i = 0; i < s->n; i++) /* from, which the soft rows need */
        bound(s, i, &l);
    l.rows = 0;
    for (int k = 0; k < s->m; k++)
        if (!isnan(s->now.g[k])) hold(s, k, &l);
    const int soft = l.rows;
    for (int i = 0; i < s->n; i++)
        bound(s, i, &l);
    const fw_maths_linear_programme p = {
        .n = (int)n, .m = l.rows, .nsoft = soft, .a = l.a, .b = l.b, .c = l.c, .penalty = penalty};
    FW_TRY(fw_maths_linear_programme_solve(arena, &p, l.x, &t, &solved));
    copy(s, &s->next, &s->now);
    for (int i = 0; solved && i < s->n; i++)
        s->next.z[i] = l.from[i] + l.x[2 * i] - l.x[2 * i + 1];
    fw_arena_rewind(arena, mark);
    s->over = t;
    type(s, &s->next);
    *moved = 0;
    for (int i = 0; i < s->n; i++)
        *moved = fmax(*moved, fabs(s->next.z[i] - s->now.z[i]));
    return FW_OK;
}

/* ---- rounds ---- */

/* the whole verdict at next, which a look may accept: found, or what looks are off by */
static fw_status judge(search *s, bool *better) {
    double *glanced;
    *better = false;
    FW_NEED(glanced = fw_arena_array(s->trial->arena, double, (size_t)s->m));
    memcpy(glanced, s->next.g, (size_t)s->m * sizeof *glanced);
    FW_TRY(look(s, FW_LOOK_WHOLE, &s->next));
    double highest = -HUGE_VAL;
    for (int k = 0; k < s->m; k++) {
        const double whole = fmax(s->next.g[k], s->trial->made[k]), d = whole - glanced[k];
        if (!isnan(whole)) highest = fmax(highest, whole);
        /* one corner is bad for this check, another one for that: all were run only where none is
           rejected */
        if (!isnan(d))
            s->off[k] = fmin(fmax(d, s->next.accepted ? -furthest : s->off[k]), most_off);
        if (!isnan(glanced[k])) s->next.g[k] = glanced[k]; /* slopes are those of looks */
    }
    for (int k = 0; !s->next.accepted && highest <= 0 && k < s->m; k++)
        if (s->next.g[k] + s->off[k] > -furthest) s->off[k] += 0.3 * furthest; /* a band is open */
    if (!s->next.accepted) return FW_OK;
    *better = !s->found || size_of(s, &s->next) < worth_going_on * size_of(s, &s->best);
    if (!s->found || size_of(s, &s->next) < size_of(s, &s->best)) copy(s, &s->best, &s->next);
    s->found = true;
    return FW_OK;
}

/* next becomes now where that is progress */
static void go_on(search *s, bool judged) {
    const double was = worst_of(s, &s->now), is = worst_of(s, &s->next);
    const bool back = is <= 0.5 * margin && was <= 0.5 * margin;
    if (judged || back || is < was - 0.02 * fabs(was)) {
        s->trust = fmin(1.4 * s->trust, most_trust);
        copy(s, &s->now, &s->next);
    } else {
        s->trust *= 0.4;
    }
}

/* by the slopes alone, nothing clearly smaller than what is known would do */
static fw_status promises(search *s, bool *promising) {
    double moved;
    FW_TRY(solve(s, &moved));
    *promising = s->over > 1e-6 || size_of(s, &s->next) < s->smaller_than;
    s->trust = first_trust;
    return FW_OK;
}

/* Slopes by differences once more, where the best is; *again false: that would change nothing, or was done often
   enough. Where they are what they were, the steps that follow are those that failed. */
static fw_status refresh(search *s, bool *again) {
    *again = s->stale && s->refreshed < MOST_REFRESHED && !spent(s);
    if (!*again) return FW_OK;
    if (s->found) copy(s, &s->now, &s->best);
    *again = memcmp(s->sloped, s->now.z, (size_t)s->n * sizeof *s->sloped) != 0;
    if (!*again) return FW_OK;
    FW_TRY(differences(s));
    s->trust = first_trust;
    s->stale = false;
    s->refreshed++;
    return FW_OK;
}

/* a step along the programme's solution; *stuck: there is none, or it gained nothing */
static fw_status step(search *s, bool *stuck) {
    bool better = false, judged = false;
    FW_TRY(look(s, FW_LOOK_VALUES, &s->next));
    correct(s);
    s->stale = true;
    /* what corners added elsewhere they need not add here: the look at those that are known has said so */
    const bool worth_it = s->next.accepted || worst_of(s, &s->next) <= worth_judging;
    if (worth_it && !s->next.rejected && !spent(s)) {
        FW_TRY(judge(s, &better));
        judged = true;
    }
    *stuck = s->next.accepted && judged && !better;
    go_on(s, judged);
    return FW_OK;
}

static fw_status rounds(search *s) {
    for (int round = 0; round < MOST_ROUNDS && !spent(s); round++) {
        double moved;
        bool stuck, again = true;
        FW_TRY(solve(s, &moved));
        const double size = size_of(s, &s->next);
        if (!s->found && s->over < 1e-6 && size > s->smaller_than) return FW_OK;
        stuck = moved < 1e-3 || s->trust < least_trust ||
                (s->found && size > worth_going_on * size_of(s, &s->best));
        if (!stuck) FW_TRY(step(s, &stuck));
        if (stuck) FW_TRY(refresh(s, &again));
        if (!again) return FW_OK;
    }
    return FW_OK;
}

/* ---- the straight way back ---- */

static fw_status accepts_at(search *s, double part, bool *accepts) {
    for (int i = 0; i < s->n; i++)
        s->next.z[i] = part * s->best.z[i];
    type(s, &s->next);
    *accepts = false;
    FW_TRY(look(s, FW_LOOK_GLANCE, &s->next));
    if (s->next.rejected || spent(s)) return FW_OK;
    FW_TRY(look(s, FW_LOOK_WHOLE, &s->next));
    *accepts = s->next.accepted;
    return FW_OK;
}

static fw_status go_back(search *s) {
    double low = 0, high = 1, stride = 1 - less;
    point least = {.drawn = false};
    FW_TRY(new_point(s->trial->arena, s->n, s->m, &least));
    copy(s, &least, &s->best);
    for (int i = 0; i < MOST_HALVINGS && low < less * high - 1e-9 && !spent(s); i++) {
        const double part = low > 0 ? 0.5 * (low + high) : (1 - stride) * high;
        bool accepts;
        FW_TRY(accepts_at(s, part, &accepts));
        stride = fmin(4 * stride, 0.5);
        if (accepts)
            high = part, copy(s, &least, &s->next);
        else
            low = part;
    }
    copy(s, &s->best, &least);
    return FW_OK;
}

fw_status fw_verdict_change_several(fw_verdict_trial *trial, const fw_verdict_variable *variable,
                                    int count, double smaller_than, double most_work,
                                    fw_verdict_several *out) {
    fw_arena *arena = trial->arena;
    search s = {.trial = trial,
                .variable = variable,
                .n = count,
                .m = trial->ncheck,
                .smaller_than = clearly * smaller_than,
                .most_work = most_work,
                .trust = most_trust};
    *out = (fw_verdict_several){.accepted = false};
    FW_NEED(s.slope = fw_arena_array(arena, double, (size_t)s.m *(size_t)s.n));
    FW_NEED(s.off = fw_arena_array(arena, double, (size_t)s.m));
    FW_NEED(s.sloped = fw_arena_array(arena, double, (size_t)s.n));
    FW_TRY(new_point(arena, s.n, s.m, &s.now));
    FW_TRY(new_point(arena, s.n, s.m, &s.next));
    FW_TRY(new_point(arena, s.n, s.m, &s.best));
    type(&s, &s.now);
    FW_TRY(look(&s, FW_LOOK_VALUES, &s.now));
    FW_TRY(differences(&s));
    bool promising;
    FW_TRY(promises(&s, &promising));
    if (promising) FW_TRY(rounds(&s));
    if (s.found) FW_TRY(go_back(&s));
    out->accepted = s.found;
    out->ended = spent(&s);
    out->x = s.best.x;
    out->size = s.found ? size_of(&s, &s.best) : (double)NAN;
    out->looks = s.looks;
    return FW_OK;
}
