/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliances of plates, and liquid between faces across a gap: the tension at which what they hang on gives way. Theory: docs/theory/stiction.md. */
#include "maths/matrix.h"
#include "mechanism/mechanism_plates.h"
#include <math.h>
#include <string.h>

/* ---- compliances ---- */

fw_status fw_mechanism_plates_across(fw_arena *arena, const fw_mechanism_plates *p,
                                     double **compliance) {
    size_t n = (size_t)p->n;
    double *c;
    FW_NEED(*compliance = c = fw_arena_array(arena, double, n *n));
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                c[i * n + j] += p->shape[k * n + i] * p->shape[k * n + j] / p->per_s2[k];
    return FW_OK;
}

fw_status fw_mechanism_plates_beside(fw_arena *arena, const fw_mechanism_plates *p,
                                     const double *give, double **compliance, bool *known) {
    size_t n = (size_t)p->n;
    double *a, *x, *c, unit = 0;
    int *pivot;
    FW_NEED(*compliance = c = fw_arena_array(arena, double, n *n));
    FW_NEED(a = fw_arena_array(arena, double, n *n));
    FW_NEED(x = fw_arena_array(arena, double, n));
    FW_NEED(pivot = fw_arena_array(arena, int, n));
    for (int b = 0; b < p->n / 3;
         b++) /* lengths of turns: so that all stiffnesses are of one size */
        unit =
            fmax(unit, sqrt(p->mechanism->body[b].inertia_kg_m2 / p->mechanism->body[b].mass_kg));
    fw_status status = fw_mechanism_plates_in_plane(p, give, unit, a);
    *known = status == FW_OK && fw_maths_lu_factor(p->n, a, pivot);
    for (size_t k = 0; k < n && *known; k++) {
        memset(x, 0, n * sizeof *x);
        x[k] = 1;
        fw_maths_lu_solve(p->n, a, pivot, NULL, x);
        for (size_t i = 0; i < n; i++)
            c[i * n + k] = x[i] / ((i % 3 == 2 ? unit : 1) * (k % 3 == 2 ? unit : 1));
        *known = c[k * n + k] > 0;
    }
    return FW_OK;
}

fw_status fw_mechanism_plates_stiffness(fw_arena *arena, const fw_mechanism_plates *p,
                                        fw_mechanism_plates_stiff *out) {
    size_t n = (size_t)p->n;
    double *a, *x, most = 0, c[2][2];
    int *pivot;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(a = fw_arena_array(arena, double, n *n));
    FW_NEED(x = fw_arena_array(arena, double, n));
    FW_NEED(pivot = fw_arena_array(arena, int, n));
    *out = (fw_mechanism_plates_stiff){.in_N_per_m = (double)NAN};
    for (int b = 0; b < p->n / 3; b++) {
        double give = 0; /* sum over the modes */
        for (size_t k = 0; k < n; k++)
            give +=
                p->shape[k * n + 3 * (size_t)b] * p->shape[k * n + 3 * (size_t)b] / p->per_s2[k];
        if (give > most) most = give, out->body = b;
    }
    out->across_N_per_m = 1 / most;
    const fw_mechanism_mass *of = &p->mechanism->body[out->body];
    fw_status status =
        fw_mechanism_plates_in_plane(p, NULL, sqrt(of->inertia_kg_m2 / of->mass_kg), a);
    if (status == FW_OK && fw_maths_lu_factor(p->n, a, pivot)) {
        for (int k = 0; k < 2; k++) {
            memset(x, 0, n * sizeof *x);
            x[3 * out->body + k] = 1;
            fw_maths_lu_solve(p->n, a, pivot, NULL, x);
            c[k][0] = x[3 * out->body], c[k][1] = x[3 * out->body + 1];
        }
        double mean = 0.5 * (c[0][0] + c[1][1]), apart = 0.5 * (c[0][0] - c[1][1]);
        out->in_N_per_m = 1 / (mean + hypot(apart, c[0][1]));
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- modes in the plane and across it ---- */

static double listed(fw_mechanism_frequencies of, int i) {
    double f;
    memcpy(&f, (const char *)of.f_Hz + (size_t)i * of.step, sizeof f);
    return f;
}

int fw_mechanism_plates_nth(int n, fw_device_plane plane, fw_mechanism_frequencies in,
                            fw_mechanism_frequencies out, bool *across) {
    int i = 0, j = 0; /* how many of each are below */
    *across = plane == FW_PLANE_ACROSS;
    for (int k = 0; k < n; k++) {
        bool more_in = plane != FW_PLANE_ACROSS && i < in.count,
             more_out = plane != FW_PLANE_IN && j < out.count;
        if (!more_in && !more_out) return -1;
        *across = !more_in || (more_out && listed(out, j) < listed(in, i));
        if (*across)
            j++;
        else
            i++;
    }
    return *across ? j - 1 : i - 1;
}

/* ---- the tension at which an equilibrium is lost ---- */

enum { STEPS = 40, POWERS = 60, TRIES = 60 };
static const double settled = 1e-9, /* of a gap, by a step */
    kept = 0.1;                     /* of every gap, by a step that is not made shorter */

typedef struct pulled {
    const double *c;
    int n;
    const fw_mechanism_face *face;
    int nface;
    fw_mechanism_pull law;
    double *f, *u, *gap;      /* (n), (n), (nface) */
    int *widest;              /* (n/3 + 1) the face of the largest gap by body[0]; -1: none */
    double *slope, *a, *step; /* (n x n) C df/du, (n x n), (n) */
    double *unit;             /* (n) 1, of turns the largest lever, m */
    int *pivot;               /* (n) */
} pulled;

static double closed(const fw_mechanism_face *face, const double *u) {
    double sum = 0;
    for (int side = 0; side < 2; side++)
        for (int i = 0; face->body[side] != FW_GROUND && i < 3; i++)
            sum += face->by[side][i] * u[3 * face->body[side] + i];
    return sum;
}

static void add_force(const fw_mechanism_face *face, double force_N, double *f) {
    for (int side = 0; side < 2; side++)
        for (int i = 0; face->body[side] != FW_GROUND && i < 3; i++)
            f[3 * face->body[side] + i] += face->by[side][i] * force_N;
}

static void give_way(const pulled *p, double *u) {
    for (int i = 0; i < p->n; i++) {
        u[i] = 0;
        for (int j = 0; j < p->n; j++)
            u[i] += p->c[(size_t)i * (size_t)p->n + (size_t)j] * p->f[j];
    }
}

/* the face whose gap a face's pull goes with, and what of s; -1: it has none */
static int law_of(const pulled *p, int i, double *share) {
    const fw_mechanism_face *face = &p->face[i];
    *share = p->law == FW_PULL_EACH ? 1 + face->more : 1;
    return p->law == FW_PULL_EACH ? i : face->strip ? -1 : p->widest[face->body[0] + 1];
}

static void find_widest(const pulled *p) {
    for (int i = 0; i <= p->n / 3; i++)
        p->widest[i] = -1;
    for (int i = 0; i < p->nface; i++) {
        int *w = &p->widest[p->face[i].body[0] + 1];
        if (!p->face[i].strip && (*w < 0 || p->gap[i] > p->gap[*w])) *w = i;
    }
}

static void pull(const pulled *p, double s) {
    double share;
    memset(p->f, 0, (size_t)p->n * sizeof *p->f);
    if (p->law == FW_PULL_WIDEST) find_widest(p);
    for (int i = 0; i < p->nface; i++) {
        int of = law_of(p, i, &share);
        if (of >= 0) add_force(&p->face[i], s * p->face[i].area_m2 * share / p->gap[of], p->f);
    }
}

/* df/du into `a`: a face pushes its bodies by what the gap of another, or its own, closes */
static void slopes(const pulled *p, double s) {
    size_t n = (size_t)p->n;
    double share;
    memset(p->a, 0, n * n * sizeof *p->a);
    for (int i = 0; i < p->nface; i++) {
        int of = law_of(p, i, &share);
        if (of < 0) continue;
        const fw_mechanism_face *to = &p->face[i], *from = &p->face[of];
        double by = s * to->area_m2 * share / (p->gap[of] * p->gap[of]);
        for (int side = 0; side < 4; side++) {
            int row = to->body[side / 2], column = from->body[side % 2];
            if (row == FW_GROUND || column == FW_GROUND) continue;
            const double *over = from->by[side % 2];
            double *at = p->a + (size_t)(3 * row) * n + 3 * column;
            for (size_t k = 0; k < 3; k++, at += n) {
                const double pushed = by * to->by[side / 2][k];
                if (pushed == 0) continue; /* limbs have one coordinate each */
                at[0] += pushed * over[0], at[1] += pushed * over[1], at[2] += pushed * over[2];
            }
        }
    }
    memset(p->slope, 0, n * n * sizeof *p->slope);
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < n; j++) {
            const double by = p->a[k * n + j];
            if (by == 0) continue; /* most bodies meet few others */
            for (size_t i = 0; i < n; i++)
                p->slope[i * n + j] += p->c[i * n + k] * by;
        }
}

/* u - C f(u) and the gaps at u; the least of what is left of them, of face *first */
static double look_at(const pulled *p, double s, double *miss, int *first) {
    double least = HUGE_VAL;
    for (int i = 0; i < p->nface; i++) {
        p->gap[i] = p->face[i].gap_m - closed(&p->face[i], p->u);
        double left = p->gap[i] / p->face[i].gap_m;
        if (left < least) least = left, *first = i;
    }
    if (!(least > 0)) return least;
    pull(p, s);
    give_way(p, miss);
    for (int i = 0; i < p->n; i++)
        miss[i] = p->u[i] - miss[i];
    return least;
}

/* the step d u of Newton that ends the miss, as long as it leaves a tenth of every gap; its size in gaps. -1: there is none */
static double step_of(const pulled *p, const double *miss) {
    size_t n = (size_t)p->n;
    double size = 0, length = 1;
    for (size_t i = 0; i < n * n; i++)
        p->a[i] = (i % (n + 1) == 0) - p->slope[i];
    memcpy(p->step, miss, n * sizeof *miss);
    if (!fw_maths_lu_factor(p->n, p->a, p->pivot)) return -1;
    fw_maths_lu_solve(p->n, p->a, p->pivot, NULL, p->step);
    for (int i = 0; i < p->nface; i++) {
        double closes = -closed(&p->face[i], p->step), most = (1 - kept) * p->gap[i];
        size = fmax(size, fabs(closes) / p->face[i].gap_m);
        if (closes * length > most) length = most / closes;
    }
    for (size_t i = 0; i < n; i++)
        p->u[i] -= length * p->step[i];
    return isfinite(size) ? size : -1;
}

/* the largest eigenvalue of C df/du, to 1e-3: its powers on the displacement. It is similar to a symmetric matrix */
static double leading(const pulled *p) {
    size_t n = (size_t)p->n;
    double *x = p->step, *y = p->f, before = 0, now = 0;
    memcpy(x, p->u, n * sizeof *x);
    for (int k = 0; k < POWERS; k++) {
        double size = 0;
        before = now, now = 0;
        for (size_t i = 0; i < n; i++) {
            y[i] = 0;
            for (size_t j = 0; j < n; j++)
                y[i] += p->slope[i * n + j] * x[j];
            /* in lengths: turns go with the size of what is turned */
            size = fmax(size, fabs(x[i]) * p->unit[i]);
            now = fmax(now, fabs(y[i]) * p->unit[i]);
        }
        if (!(size > 0)) return 0;
        for (size_t i = 0; i < n; i++)
            x[i] = y[i] / (now > 0 ? now : 1);
        now /= size;
        if (k > 3 && fabs(now - before) < 1e-3 * now) break;
    }
    return now;
}

/* Newton's method for u = C f(u) from what holds at a lesser tension: pulls grow with what they close, so that steps rise to
   the stable equilibrium and become shorter, and C df/du has no eigenvalue of 1 or more there; where there is none, gaps
   end or steps grow. *eigen: the largest at the equilibrium */
static bool holds(const pulled *p, double s, double *miss, int *first, double *eigen) {
    double before = HUGE_VAL;
    for (int k = 0; k < STEPS; k++) {
        if (!(look_at(p, s, miss, first) > 0)) return false;
        slopes(p, s);
        double size = step_of(p, miss);
        if (size < 0 || (k > 1 && size > before && size > settled)) return false;
        before = size;
        if (!(size < settled)) continue;
        *eigen = leading(p);
        return *eigen < 1;
    }
    return false;
}

/* Every gap closes by at most b' |C| F s/(1 - r), F the sizes of all pulls at s = 1 N/m and r the largest share of a gap
   that is closed: it holds where 4 s times that share is below 1 */
static double surely(const pulled *p) {
    double worst = 0;
    memset(p->f, 0, (size_t)p->n * sizeof *p->f);
    for (int i = 0; i < p->nface; i++) {
        const fw_mechanism_face *face = &p->face[i];
        double force = face->area_m2 * (1 + face->more) / face->gap_m;
        for (int side = 0; side < 2; side++)
            for (int k = 0; face->body[side] != FW_GROUND && k < 3; k++)
                p->f[3 * face->body[side] + k] += fabs(face->by[side][k]) * force;
    }
    for (int i = 0; i < p->n; i++) {
        p->u[i] = 0;
        for (int j = 0; j < p->n; j++)
            p->u[i] += fabs(p->c[(size_t)i * (size_t)p->n + (size_t)j]) * p->f[j];
    }
    for (int i = 0; i < p->nface; i++) {
        double sum = 0;
        for (int side = 0; side < 2; side++)
            for (int k = 0; p->face[i].body[side] != FW_GROUND && k < 3; k++)
                sum += fabs(p->face[i].by[side][k]) * p->u[3 * p->face[i].body[side] + k];
        worst = fmax(worst, sum / p->face[i].gap_m);
    }
    return worst > 0 ? 1 / (4 * worst) : HUGE_VAL;
}

/* the next tension to try: of one gap that closes by the share x, s goes with x (1 - x) and the eigenvalue e is x/(1 - x),
   so that ((1 - e)/(1 + e))^2 = 1 - s/s_lost; of several this says somewhat too much: `below` that, and between what is
   known */
static double next_try(double low, double high, double eigen, double below) {
    double left = (1 - eigen) / (1 + eigen), said = low / fmax(1 - left * left, 1e-6);
    double aim = fmax((1 - below) * said,
                      isfinite(high) ? fmin(1.002 * low, sqrt(low * high)) : 1.002 * low);
    return below > 0.5 || aim >= high ? sqrt(low * high) : aim;
}

/* *tension: a bound below; the tension at which it is lost, or `enough` where it holds at that */
static void search(const pulled *p, double *work, double enough, double *tension, int *first) {
    double low = *tension, high = HUGE_VAL, eigen = 0, *held = work + p->n;
    const double start = low;
    const double closely = 0.002;
    double below = closely;
    int at;
    memset(p->u, 0, (size_t)p->n * sizeof *p->u);
    if (isfinite(enough) && holds(p, enough, work, &at, &eigen)) {
        *tension = enough;
        return;
    }
    if (isfinite(enough)) high = enough, *first = at;
    memset(p->u, 0, (size_t)p->n * sizeof *p->u);
    if (!holds(p, low, work, &at, &eigen)) eigen = 0.5; /* never: it is a bound */
    for (int k = 0; k < TRIES && high > 1.004 * low && low < 1e20 * start; k++) {
        double aim = next_try(low, high, eigen, below), e = 0;
        memcpy(held, p->u, (size_t)p->n * sizeof *held);
        if (!holds(p, aim, work, &at, &e)) {
            high = aim, *first = at, below *= 4;
            memcpy(p->u, held, (size_t)p->n * sizeof *held);
        } else {
            low = aim, eigen = e, below = closely;
        }
    }
    *tension = low >= 1e20 * start ? HUGE_VAL : p->law == FW_PULL_WIDEST ? high : low;
}

/* Bodies that no face is of do not push and close nothing: their rows and columns of C, and they, are left out. Exact. */
static fw_status only_faced(fw_arena *arena, const double *compliance, int n, pulled *p) {
    const size_t bodies = (size_t)n / 3;
    int *index, *body, count = 0;
    double *c;
    fw_mechanism_face *face;
    FW_NEED(index = fw_arena_array(arena, int, bodies));
    FW_NEED(body = fw_arena_array(arena, int, bodies));
    FW_NEED(face = fw_arena_array(arena, fw_mechanism_face, (size_t)p->nface));
    for (int i = 0; i < p->nface; i++) {
        face[i] = p->face[i];
        for (int side = 0; side < 2; side++) {
            const int of = face[i].body[side];
            if (of == FW_GROUND) continue;
            if (index[of] == 0) body[count] = of, index[of] = ++count;
            face[i].body[side] = index[of] - 1;
        }
    }
    p->face = face, p->n = 3 * count;
    const size_t m = (size_t)p->n;
    FW_NEED(c = fw_arena_array(arena, double, m *m));
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++)
            c[i * m + j] = compliance[(3 * (size_t)body[i / 3] + i % 3) * (size_t)n +
                                      3 * (size_t)body[j / 3] + j % 3];
    p->c = c;
    return FW_OK;
}

/* In: m/N ..., m, m^2; out: N/m. Between a tension that holds and one that does not, the next one from the eigenvalue at the
   former. Valid: small motions. Error 0.5 %, below it for EACH; of WIDEST the upper end is the answer. Cost some 40 times
   n^3 of the bodies that have faces, and 200 for each face. Source: docs/theory/stiction.md. Test: test_mechanism_pull.c */
fw_status fw_mechanism_pull_in(fw_arena *arena, const double *compliance, int n,
                               const fw_mechanism_face *face, int nface, fw_mechanism_pull law,
                               double enough_N_per_m, double *tension, int *first) {
    pulled p = {.face = face, .nface = nface, .law = law};
    double *work;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(only_faced(arena, compliance, n, &p));
    const size_t size = (size_t)p.n;
    FW_NEED(p.f = fw_arena_array(arena, double, size));
    FW_NEED(p.u = fw_arena_array(arena, double, size));
    FW_NEED(p.step = fw_arena_array(arena, double, size));
    FW_NEED(p.unit = fw_arena_array(arena, double, size));
    FW_NEED(p.slope = fw_arena_array(arena, double, size *size));
    FW_NEED(p.a = fw_arena_array(arena, double, size *size));
    FW_NEED(p.gap = fw_arena_array(arena, double, (size_t)nface));
    FW_NEED(p.widest = fw_arena_array(arena, int, size / 3 + 1));
    FW_NEED(p.pivot = fw_arena_array(arena, int, size));
    FW_NEED(work = fw_arena_array(arena, double, 2 * size));
    double lever = 0;
    for (int i = 0; i < nface; i++)
        lever = fmax(lever, fmax(fabs(face[i].by[0][2]), fabs(face[i].by[1][2])));
    for (int i = 0; i < p.n; i++)
        p.unit[i] = i % 3 == 2 && lever > 0 ? lever : 1;
    *first = FW_NONE;
    *tension = surely(&p);
    if (nface > 0 && isfinite(*tension) && *tension < enough_N_per_m)
        search(&p, work, enough_N_per_m, tension, first);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* Between clamped ends, w'''' = q/(1 - w) with q = s (1 + more) b L^4/(EI g^2) has no solution beyond q = 116.94: what
   a shooting of the equation gives (test_mechanism_pull.c integrates it anew). In SI; out N/m. */
double fw_mechanism_strip_pull_in(double bend_Nm2, double length_m, double width_m, double gap_m,
                                  double more) {
    double l2 = length_m * length_m;
    return 116.94 * bend_Nm2 * gap_m * gap_m / ((1 + more) * width_m * l2 * l2);
}

/* ---- what scenes ask ---- */

static double gradient_of(const fw_device_scene *s) {
    double sum = 0;
    for (int i = 0; i < s->nstress; i++)
        sum += s->stress[i].gradient_Pa_per_m;
    return sum;
}

bool fw_mechanism_plates_shaken(const fw_device_scene *s) {
    for (int i = 0; i < s->nbase; i++)
        if (s->base[i].az_m_per_s2 != 0) return true;
    return false;
}

bool fw_mechanism_plates_asked(const fw_device_scene *s) {
    return s->gz_m_per_s2 != 0 || fw_mechanism_plates_shaken(s) || gradient_of(s) != 0;
}

double fw_mechanism_plates_curvature(const fw_mechanism *m, const fw_device_scene *s) {
    const fw_device_material *of = &m->variant->material;
    double gradient = gradient_of(s);
    const double modulus = fw_device_material_biaxial_Pa(of);
    if (gradient == 0 || of->youngs.unknown) return 0;
    return gradient / (isnan(modulus) ? of->youngs.value : modulus); /* nu not known: 0, at most */
}
