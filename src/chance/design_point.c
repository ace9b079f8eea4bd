/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimators.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ITERATIONS = 40, STEPS = 6 };
#define DIFFERENCE 0.01 /* of the finite differences, in standard deviations */
#define BESIDE                                                                                     \
    0.01 /* of the distance from the origin: how far off the ray of the gradient a point may lie */
#define SMALL 1e-3 /* of g at the origin: where g counts as 0 */
#define FAR   20.0 /* beyond it there is no probability worth the name: 1e-89 */

typedef struct search {
    fw_chance_run *run;
    size_t n, stop;                       /* the evaluation at which to end */
    double scale;                         /* |g| at the origin */
    double *u, *gradient, *point, *value; /* (n), (n), (max(n, STEPS) x n) and their values */
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

/* forward differences; false: not finite, or 0 */
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
    *good = isfinite(square) && square > 0;
    return FW_OK;
}

static double merit(double square, double c, double g) {
    return square / 2 + c * fabs(g);
}

/* The step d to the nearest point of the linearised limit, or the longest of 1, 1/2 .. 1/32 of it that lowers the merit
   |u|^2/2 + c |g| enough; all are evaluated in one batch. false: none lowers it. */
static fw_status step(search *s, bool *moved) {
    size_t n = s->n;
    double square = dot(n, s->gradient, s->gradient),
           along = (dot(n, s->gradient, s->u) - s->g) / square;
    double *next = s->point;
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

/* Is a failing point where a design point leads to expect it: beyond nine tenths of its tangent plane's distance? */
static bool explained(const fw_chance_points *points, size_t n, const double *u) {
    for (size_t k = 0; k < points->count; k++)
        if (-dot(n, points->point[k].alpha, u) >= 0.9 * fabs(points->point[k].beta)) return true;
    return false;
}

static int nearer(const void *a, const void *b) {
    double one = fabs(((const fw_chance_design_point *)a)->beta),
           other = fabs(((const fw_chance_design_point *)b)->beta);
    return (one > other) - (one < other);
}

fw_status fw_chance_points_find(fw_chance_run *run, size_t budget, size_t starts,
                                const double *start, fw_chance_points *out) {
    size_t n = run->limit->dimensions, rows = n > STEPS ? n : STEPS;
    search s = {.run = run, .n = n, .stop = run->used + budget};
    *out = (fw_chance_points){.count = 0};
    FW_NEED(s.u = fw_arena_array(run->arena, double, n));
    FW_NEED(s.gradient = fw_arena_array(run->arena, double, n));
    FW_NEED(s.point = fw_arena_array(run->arena, double, rows *n));
    FW_NEED(s.value = fw_arena_array(run->arena, double, rows));
    FW_NEED(out->point = fw_arena_array(run->arena, fw_chance_design_point, FW_CHANCE_POINTS_MOST));
    if (!budget) return FW_OK;
    FW_TRY(fw_chance_evaluate(run, 1, s.u, &s.g));
    out->origin_fails = s.g <= 0;
    s.scale = fmax(fabs(s.g), DBL_MIN);
    for (size_t i = 0; i <= starts && affordable(&s, n + STEPS + 1); i++) {
        const double *from = i ? start + (i - 1) * n : NULL;
        if (from && explained(out, n, from)) continue;
        memset(s.u, 0, n * sizeof *s.u);
        if (from) memcpy(s.u, from, n * sizeof *from);
        bool found;
        FW_TRY(iterate(&s, &found));
        if (found) FW_TRY(keep(&s, out));
    }
    size_t mirrored = out->count; /* what fails on one side may fail on the other, too */
    for (size_t k = 0; k < mirrored && affordable(&s, n + STEPS + 1); k++) {
        for (size_t i = 0; i < n; i++)
            s.u[i] = -out->point[k].u[i];
        bool found;
        FW_TRY(iterate(&s, &found));
        if (found) FW_TRY(keep(&s, out));
    }
    qsort(out->point, out->count, sizeof *out->point, nearer);
    return FW_OK;
}
