/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nearest points of failure, and importance sampling around them. */
#include "chance/estimate.h"
#include "chance/random.h"
#include "maths/functions.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- design points ---- */

enum { ITERATIONS = 40, STEPS = 6 };
#define DIFFERENCE 0.01 /* of the finite differences, in standard deviations */
#define BESIDE                                                                                     \
    0.01 /* of the distance from the origin: how far off the ray of the gradient a point may lie */
#define SMALL 1e-3 /* of g at the origin: where g counts as 0 */
#define FAR   20.0 /* beyond it there is no probability worth the name: 1e-89 */
enum { EDGE = 8 }; /* inputs are followed so far either way: beyond it 6e-16 of them lie */

typedef struct search {
    fw_chance_run *run;
    size_t n, stop;                       /* the evaluation at which to end */
    double scale;                         /* |g| at the origin */
    double *u, *gradient, *point, *value; /* (n), (n), (max(n, STEPS) x n) and their values */
    double *ray;                          /* points along a way, and their values */
    double g;
} search;

static double dot(size_t n, const double *a, const double *b) {
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static bool affordable(const search *s, size_t count) {
    return s->run->used + count <= s->stop;
}

/* Forward differences; false: not finite, or no slope: all the way to FAR g would not change by a thousandth of what it is,
   and what its last digits do leads nowhere. */
static fw_status differences(search *s, bool *good) {
    size_t n = s->n;
    for (size_t i = 0; i < n; i++) {
        memcpy(s->point + i * n, s->u, n * sizeof *s->u);
        s->point[i * n + i] += DIFFERENCE;
    }
    FW_TRY(fw_chance_evaluate(s->run, n, s->point, s->value));
    for (size_t i = 0; i < n; i++)
        s->gradient[i] = (s->value[i] - s->g) / DIFFERENCE;
    double square = dot(n, s->gradient, s->gradient);
    *good = isfinite(square) && sqrt(square) * FAR > SMALL * fmax(fabs(s->g), s->scale);
    return FW_OK;
}

static double merit(double square, double c, double g) {
    return square / 2 + c * fabs(g);
}

/* The step d to the nearest point of the linearised limit, or the longest of 1, 1/2 .. 1/32 of it that lowers the merit
   |u|^2/2 + c |g| enough; all are evaluated in one batch. false: none lowers it. Where that point is farther than FAR the
   step goes along its ray to there: no answer lies beyond, and values of inputs may be none (a lognormal one is above any
   number from some hundreds of deviations on). */
static fw_status step(search *s, bool *moved) {
    size_t n = s->n;
    double square = dot(n, s->gradient, s->gradient),
           along = (dot(n, s->gradient, s->u) - s->g) / square;
    double *next = s->point, far = fabs(along) * sqrt(square);
    if (far > FAR) along *= FAR / far;
    for (int k = 0; k < STEPS; k++)
        for (size_t i = 0; i < n; i++)
            next[(size_t)k * n + i] = s->u[i] + ldexp(along * s->gradient[i] - s->u[i], -k);
    FW_TRY(fw_chance_evaluate(s->run, STEPS, next, s->value));
    double before = dot(n, s->u, s->u), c = 2 * sqrt(before / square);
    if (fabs(s->g) > SMALL * s->scale) c = fmax(c, dot(n, next, next) / fabs(s->g));
    c = fmax(c, 1 / sqrt(square));
    double now = merit(before, c, s->g);
    *moved = false;
    for (int k = 0; k < STEPS && !*moved; k++) {
        const double *u = next + (size_t)k * n;
        if (isnan(s->value[k]) || !(merit(dot(n, u, u), c, s->value[k]) < now)) continue;
        memcpy(s->u, u, n * sizeof *u);
        s->g = s->value[k];
        *moved = true;
    }
    return FW_OK;
}

/* how far u lies beside the ray of the gradient */
static double beside(const search *s) {
    double square = dot(s->n, s->gradient, s->gradient), along = dot(s->n, s->gradient, s->u);
    return sqrt(fmax(0, dot(s->n, s->u, s->u) - along * along / square));
}

/* The improved HLRF iteration: u moves towards the point of the linearised limit that is nearest to the origin, as far as a
   merit falls, until g is 0 and u on the ray of the gradient. Inputs: a start u (n). Output: u with g(u) = 0, |u| locally
   least; found is false where g is flat, not finite or the iteration ends elsewhere. Error: g within 1e-3 of its value at
   the origin; direction within 0.01, of which forward differences with a step of 0.01 take half where g bends as much as
   a unit circle. Cost: n + 6 evaluations an iteration, 2 of them where g is linear, some 10 else, 40 at most. Source:
   R. Rackwitz, B. Fiessler, Comp. Struct. 9 (1978) 489; Y. Zhang, A. Der Kiureghian, Reliability and Optimization of
   Structural Systems 1995, 297 (merit). Test: test_design_point.c */
static fw_status iterate(search *s, bool *found) {
    *found = false;
    FW_TRY(fw_chance_evaluate(s->run, 1, s->u, &s->g));
    if (isnan(s->g)) return FW_OK;
    for (int i = 0; i < ITERATIONS && affordable(s, s->n + STEPS); i++) {
        bool good, moved;
        FW_TRY(differences(s, &good));
        if (!good) return FW_OK;
        double length = sqrt(dot(s->n, s->u, s->u));
        bool near = fabs(s->g) <= SMALL * s->scale && beside(s) <= BESIDE * fmax(1, length);
        if (near && length < FAR) {
            *found = true;
            return FW_OK;
        }
        FW_TRY(step(s, &moved));
        if (!moved) { /* noise: take what is near enough */
            *found = fabs(s->g) <= 10 * SMALL * s->scale &&
                     beside(s) <= 10 * BESIDE * fmax(1, length) && length < FAR;
            return FW_OK;
        }
    }
    return FW_OK;
}

/* adds the point of the search, unless it is there */
static fw_status keep(const search *s, fw_chance_points *out) {
    size_t n = s->n;
    double length = sqrt(dot(n, s->gradient, s->gradient)),
           beta = -dot(n, s->gradient, s->u) / length;
    for (size_t k = 0; k < out->count; k++) {
        double square = 0;
        for (size_t i = 0; i < n; i++)
            square += pow(s->u[i] - out->point[k].u[i], 2);
        if (square < pow(0.2 * fmax(1, fabs(beta)), 2)) return FW_OK;
    }
    if (out->count == FW_CHANCE_POINTS_MOST) return FW_OK;
    fw_chance_design_point *p = &out->point[out->count++];
    p->beta = beta;
    FW_NEED(p->u = fw_arena_array(s->run->arena, double, n));
    FW_NEED(p->alpha = fw_arena_array(s->run->arena, double, n));
    for (size_t i = 0; i < n; i++) {
        p->u[i] = s->u[i];
        p->alpha[i] = s->gradient[i] / length;
    }
    return FW_OK;
}

/* Is a point where a design point leads to expect it: beyond nine tenths of its tangent plane's distance, or of how far out
   those lie that do not fail yet (reach, 0: they fail)? */
static bool explained(const fw_chance_points *points, size_t n, const double *u, double reach) {
    for (size_t k = 0; k < points->count; k++) {
        const double beta = fabs(points->point[k].beta), far = reach > 0 ? fmin(beta, reach) : beta;
        const double along = dot(n, points->point[k].alpha, u);
        if ((points->origin_fails ? along : -along) >= 0.9 * far) return true;
    }
    return false;
}

/* ---- both ways along each input ---- */

/* g at 0 < r <= EDGE along `way` (n): the first r, of steps that are evaluated at once, on whose side of the limit the origin
   is not, and the last one before it. *found false: there is none. */
static fw_status first_beyond(search *s, const fw_chance_points *out, const double *way, int steps,
                              double bracket[2], bool *found) {
    double *at = s->ray, *value = s->ray + (size_t)steps * s->n;
    for (int k = 0; k < steps; k++)
        for (size_t i = 0; i < s->n; i++)
            at[(size_t)k * s->n + i] = (double)EDGE * (k + 1) / steps * way[i];
    FW_TRY(fw_chance_evaluate(s->run, (size_t)steps, at, value));
    *found = false, bracket[0] = 0;
    for (int k = 0; k < steps && !*found; k++) {
        if (isnan(value[k])) continue;
        *found = (value[k] <= 0) != out->origin_fails;
        bracket[*found] = (double)EDGE * (k + 1) / steps;
    }
    return FW_OK;
}

/* s->u: where along `way` the limit lies, between the two of the bracket, to 1/HALVINGS^2 of them */
enum { HALVINGS = 10 };
static fw_status halve(search *s, const fw_chance_points *out, const double *way,
                       double bracket[2]) {
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (bracket[0] + bracket[1]);
        double g;
        for (size_t i = 0; i < s->n; i++)
            s->point[i] = middle * way[i];
        FW_TRY(fw_chance_evaluate(s->run, 1, s->point, &g));
        bracket[!isnan(g) && (g <= 0) != out->origin_fails] = middle;
    }
    for (size_t i = 0; i < s->n; i++)
        s->u[i] = bracket[1] * way[i];
    return FW_OK;
}

/* Is the point of the search, which was found, nearest of those about it? Along an axis of symmetry it may be the farthest:
   then the origin's side of the limit ends nearer than it beside it, and s->u goes there. */
static fw_status is_nearest(search *s, const fw_chance_points *out, bool *nearest) {
    const double length = sqrt(dot(s->n, s->u, s->u)), aside = 0.25 * length;
    *nearest = true;
    for (int side = -1; side < 2 && *nearest; side += 2) {
        for (size_t i = 0; i < s->n; i++) {
            double *at = s->point + i * s->n;
            memcpy(at, s->u, s->n * sizeof *at);
            at[i] += side * aside;
            const double scale = length / sqrt(dot(s->n, at, at));
            for (size_t d = 0; d < s->n; d++)
                at[d] *= scale;
        }
        FW_TRY(fw_chance_evaluate(s->run, s->n, s->point, s->value));
        for (size_t i = 0; i < s->n && *nearest; i++) {
            const double beyond = out->origin_fails ? s->value[i] : -s->value[i];
            *nearest = !(beyond > 5 * SMALL * s->scale);
            if (!*nearest) memcpy(s->u, s->point + i * s->n, s->n * sizeof *s->u);
        }
    }
    return FW_OK;
}

/* Where the limit is met along `way` a search begins, unless a design point explains that it is. Of one input the place
   itself is the design point; of several it stands for one that the search does not end at, where g has a slope. */
static fw_status follow(search *s, const double *way, int steps, fw_chance_points *out) {
    const size_t n = s->n;
    double bracket[2];
    bool beyond, good = true, found = false;
    FW_TRY(first_beyond(s, out, way, steps, bracket, &beyond));
    if (!beyond || !affordable(s, HALVINGS)) return FW_OK;
    FW_TRY(halve(s, out, way, bracket));
    double *met = s->ray;
    memcpy(met, s->u, n * sizeof *met);
    if (n > 1) {
        bool nearest;
        if (explained(out, n, met, 0) || !affordable(s, 3 * (n + STEPS))) return FW_OK;
        FW_TRY(iterate(s, &found));
        if (!found) memcpy(s->u, met, n * sizeof *met);
        if (!affordable(s, 4 * n + STEPS)) return found ? keep(s, out) : FW_OK;
        FW_TRY(is_nearest(s, out, &nearest));
        if (!nearest) FW_TRY(iterate(s, &found));
        if (found || !nearest) return found ? keep(s, out) : FW_OK;
        FW_TRY(fw_chance_evaluate(s->run, 1, s->u, &s->g));
        FW_TRY(differences(s, &good));
    }
    for (size_t i = 0; i < n; i++)
        s->gradient[i] = out->origin_fails ? way[i] : -way[i];
    return good ? keep(s, out) : FW_OK;
}

/* how closely a way is looked at, and how many ways there are: of one input all that it may be, of two around the origin, of
   more both ways along each */
typedef struct ways {
    int steps;
    size_t count;
} ways;

static ways ways_of(size_t n) {
    if (n == 1) return (ways){4 * EDGE, 2};
    return n == 2 ? (ways){EDGE, 16} : (ways){EDGE, 2 * n};
}

static void way_of(size_t n, size_t k, double *way) {
    memset(way, 0, n * sizeof *way);
    if (n == 2) {
        const double turned = 0.3926990816987241 * (double)k; /* pi/8 */
        way[0] = cos(turned), way[1] = sin(turned);
    } else {
        way[k / 2] = k % 2 ? -1 : 1;
    }
}

/* Regions of failure on both sides of an input are both found, however much rarer the one is: what fails along an input is met
   at EDGE steps. out->followed false: the budget does not allow it. Cost: EDGE evaluations for each way, 2 n ways; 80 of one
   input. Test: test_design_point.c, both_sides */
static fw_status follow_all(search *s, fw_chance_points *out) {
    const ways all = ways_of(s->n);
    double *way = fw_arena_array(s->run->arena, double, s->n);
    FW_NEED(way);
    FW_NEED(s->ray = fw_arena_array(s->run->arena, double, (size_t)all.steps *(s->n + 1)));
    out->followed = affordable(s, all.count * (size_t)all.steps);
    for (size_t k = 0; k < all.count && out->followed; k++) {
        out->followed = affordable(s, (size_t)all.steps);
        if (!out->followed) return FW_OK;
        way_of(s->n, k, way);
        FW_TRY(follow(s, way, all.steps, out));
    }
    return FW_OK;
}

static int nearer(const void *a, const void *b) {
    double one = fabs(((const fw_chance_design_point *)a)->beta),
           other = fabs(((const fw_chance_design_point *)b)->beta);
    return (one > other) - (one < other);
}

static fw_status search_new(fw_chance_run *run, size_t budget, search *s) {
    const size_t n = run->limit->dimensions, rows = n > STEPS ? n : STEPS;
    *s = (search){.run = run, .n = n, .stop = run->used + budget};
    FW_NEED(s->u = fw_arena_array(run->arena, double, n));
    FW_NEED(s->gradient = fw_arena_array(run->arena, double, n));
    FW_NEED(s->point = fw_arena_array(run->arena, double, rows *n));
    FW_NEED(s->value = fw_arena_array(run->arena, double, rows));
    return FW_OK;
}

/* from times * start (n) */
static fw_status search_from(search *s, double times, const double *start, fw_chance_points *out) {
    bool found;
    for (size_t i = 0; i < s->n; i++)
        s->u[i] = times * start[i];
    FW_TRY(iterate(s, &found));
    return found ? keep(s, out) : FW_OK;
}

fw_status fw_chance_points_find(fw_chance_run *run, size_t budget, const fw_chance_subset *from,
                                fw_chance_points *out) {
    const size_t n = run->limit->dimensions, one = n + STEPS + 1;
    search s;
    *out = (fw_chance_points){.count = 0};
    FW_TRY(search_new(run, budget, &s));
    FW_NEED(out->point = fw_arena_array(run->arena, fw_chance_design_point, FW_CHANCE_POINTS_MOST));
    if (!budget) return FW_OK;
    FW_TRY(fw_chance_evaluate(run, 1, s.u, &s.g));
    out->origin_fails = s.g <= 0;
    s.scale = fmax(fabs(s.g), DBL_MIN);
    if (affordable(&s, one)) FW_TRY(search_from(&s, 0, s.point, out));
    FW_TRY(follow_all(&s, out));
    for (size_t i = 0; i < from->failing && affordable(&s, one); i++)
        if (!explained(out, n, from->failed + i * n, from->reach))
            FW_TRY(search_from(&s, 1, from->failed + i * n, out));
    const size_t mirrored = out->count; /* what fails on one side may fail on the other, too */
    for (size_t k = 0; k < mirrored && affordable(&s, one); k++)
        FW_TRY(search_from(&s, -1, out->point[k].u, out));
    qsort(out->point, out->count, sizeof *out->point, nearer);
    return FW_OK;
}

/* ---- samples around them ---- */

#define OWN 0.1 /* share of the inputs' own density: no weight is above its inverse */
const double fw_chance_weighted_own = OWN;
#define LEAST 0.05 /* share of a design point before all are scaled to a sum of 1 */

void fw_chance_weighted_start(const fw_chance_points *points, fw_chance_weighted *out) {
    *out = (fw_chance_weighted){.points = points};
    double sum = 0, total = 0;
    for (size_t k = 0; k < points->count; k++)
        sum += fw_maths_normal_cdf(-fabs(points->point[k].beta));
    for (size_t k = 0; k < points->count; k++)
        total += out->share[k + 1] =
            fmax(LEAST, fw_maths_normal_cdf(-fabs(points->point[k].beta)) / sum);
    for (size_t k = 0; k < points->count; k++)
        out->share[k + 1] *= (1 - OWN) / total;
    out->share[0] = points->count ? OWN : 1;
}

/* the mixture's component of a number that is uniform in (0, 1) */
static size_t component(const fw_chance_weighted *w, double x) {
    size_t k = 0;
    for (double sum = w->share[0]; k < w->points->count && x >= sum; sum += w->share[k])
        k++;
    return k;
}

/* density of the inputs over that of the mixture: 1/(q_0 + sum of q_k exp(u u_k - |u_k|^2/2)) */
static double weight_of(const fw_chance_weighted *w, size_t n, const double *u) {
    double mixture = w->share[0];
    for (size_t k = 0; k < w->points->count; k++) {
        const double *centre = w->points->point[k].u;
        double power = 0;
        for (size_t i = 0; i < n; i++)
            power += centre[i] * (u[i] - centre[i] / 2);
        mixture += w->share[k + 1] * exp(power);
    }
    return 1 / mixture;
}

static void add(fw_chance_weighted *w, double weight, double value) {
    bool unknown = isnan(value) != 0, rare = !unknown && (value <= 0) != w->points->origin_fails;
    for (int way = 0; way < 2; way++) {
        if (!rare && !(unknown && way == 1)) continue;
        w->sum[way] += weight;
        w->square[way] += weight * weight;
        w->most[way] = fmax(w->most[way], weight);
    }
}

/* Importance sampling: points are drawn from normal densities of unit variance around the design points, shares as
   Phi(-beta), and a tenth from the inputs' own density, so that a failure far from all of them has a weight of 10 at most
   and shows as a wide interval, not as none. Input: design points in the run's space; output sums of weights of what is
   rare. Error: unbiased; coefficient of variation sqrt(beta sqrt(pi/2)/N) for a linear limit. Cost: one evaluation a
   point. Source: G. I. Schueller, R. Stix, Struct. Safety 4 (1987) 293; T. Hesterberg, Technometrics 37 (1995) 185
   (the share of the own density). Test: test_estimate.c (coverage) */
fw_status fw_chance_weighted_draw(fw_chance_run *run, size_t samples, bool chooses,
                                  fw_chance_weighted *w) {
    size_t n = run->limit->dimensions;
    fw_mark mark = fw_arena_mark(run->arena);
    double *u = fw_arena_array(run->arena, double, run->batch *n),
           *value = fw_arena_array(run->arena, double, run->batch);
    FW_NEED(u && value ? u : NULL);
    for (size_t done = 0; done < samples; done += run->batch) {
        size_t now = samples - done < run->batch ? samples - done : run->batch;
        for (size_t i = 0; i < now; i++) {
            size_t sample = w->samples + i,
                   k = component(w, fw_chance_uniform(run->seed, sample, n));
            for (size_t d = 0; d < n; d++)
                u[i * n + d] =
                    fw_chance_normal(run->seed, sample, d) + (k ? w->points->point[k - 1].u[d] : 0);
            w->own += k == 0;
        }
        FW_TRY(chooses ? fw_chance_evaluate(run, now, u, value)
                       : fw_chance_evaluate_apart(run, now, u, value));
        for (size_t i = 0; i < now; i++)
            add(w, weight_of(w, n, u + i * n), value[i]);
        w->samples += now;
    }
    fw_arena_rewind(run->arena, mark);
    return FW_OK;
}

double fw_chance_weighted_effective(const fw_chance_weighted *w) {
    return w->square[0] > 0 ? w->sum[0] * w->sum[0] / w->square[0] : 0;
}

/* by (4) of docs/theory/chance.md, whose right side is beta sqrt(pi/2) far out */
double fw_chance_weighted_of_plane(const fw_chance_weighted *w) {
    const double beta = w->points->count ? fabs(w->points->point[0].beta) : 0;
    return (1 - OWN) * (double)w->samples / (1 + 1.2533141373155 * beta);
}

typedef struct part {
    double mean, variance; /* of the mean */
    double heaviest;       /* weight over number of points */
} part;

static part part_of(const fw_chance_weighted *w, int way) {
    double n = (double)w->samples, mean = w->sum[way] / n;
    double variance = fmax(w->square[way] / n - mean * mean, 1e-9 * mean * mean) / (n - 1);
    return (part){mean, variance, w->most[way] / n};
}

/* quantile of the gamma distribution that has this mean and variance */
static double gamma_quantile(double p, double mean, double variance) {
    return fw_maths_gamma_quantile(p, mean * mean / variance) * variance / mean;
}

/* Interval of a sum of weights (M. P. Fay, E. J. Feuer, Statistics in Medicine 16 (1997) 791): gamma distributions with
   mean and variance of the sum, for the upper end with one failure more, of the heaviest weight met. With equal weights it
   is the exact interval of a Poisson count; with heavy ones it is wider above than below, which mean +- sd is not. The
   variance is that of the sample. Without a failure only the share of the own density speaks: none of `own`. */
static void interval(const fw_chance_weighted *w, double level, double *low, double *high) {
    double tail = (1 - level) / 2;
    part least = part_of(w, 0), most = part_of(w, 1);
    *low = least.mean > 0 ? gamma_quantile(tail, least.mean, least.variance) : 0;
    *high = -expm1(log(tail) / fmax(1, (double)w->own));
    if (most.mean > 0)
        *high = fmin(1, gamma_quantile(1 - tail, most.mean + most.heaviest,
                                       most.variance + most.heaviest * most.heaviest));
}

void fw_chance_weighted_result(const fw_chance_weighted *w, double level, fw_chance_estimate *out) {
    double low, high, least = fmin(1, part_of(w, 0).mean), most = fmin(1, part_of(w, 1).mean);
    interval(w, level, &low, &high);
    bool turned = w->points->origin_fails; /* then what was counted is survival */
    out->probability_low = turned ? 1 - most : least;
    out->probability_high = turned ? 1 - least : most;
    out->low = turned ? 1 - high : low;
    out->high = turned ? 1 - low : high;
    out->standard_error =
        least > 0 ? sqrt(fmax(part_of(w, 0).variance, part_of(w, 1).variance)) : (double)NAN;
}
