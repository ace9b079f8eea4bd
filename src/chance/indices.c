/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/joint.h"
#include "chance/random.h"
#include "maths/functions.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { BATCH = 256, REPLICATES = 16, BASE_LEAST = 8 * REPLICATES };

/* of the means x of replicates: sums of x, x^2, and with v and m of the same replicate; `now` is the sum over the rows of
   the one that is being drawn */
typedef struct sums {
    double now, x, xx, xv, xm;
} sums;

typedef struct response {
    double shift; /* near the mean, so that nothing cancels: the mean of the first rows */
    double v_now, m_now, v, vv, m, mm, vm;
    size_t rows_now, rows, replicates;
    sums *first, *total; /* (groups) */
} response;

typedef struct work {
    const fw_chance_model *model;
    size_t n, groups, points; /* points of a row: groups + 2 */
    uint64_t seed;            /* of the replicate */
    bool quasi;
    fw_chance_sobol sobol;
    double *a, *b;  /* (n) of a row */
    response *part; /* (responses) */
} work;

static size_t group_of(const work *w, size_t dimension) {
    return w->model->groups ? w->model->group[dimension] : dimension;
}

/* two independent points; neighbouring dimensions of Sobol' points make the pair of an input */
static void pair(work *w, uint64_t row) {
    for (size_t d = 0; d < w->n; d++)
        for (size_t side = 0; side < 2; side++) {
            size_t dimension = 2 * d + side;
            (side ? w->b : w->a)[d] =
                w->quasi
                    ? fw_maths_normal_quantile(fw_chance_sobol_uniform(&w->sobol, row, dimension))
                    : fw_chance_normal(w->seed, row, dimension);
        }
}

/* the points of a row: a, b, and a with the inputs of each group from b */
static void row_points(work *w, uint64_t row, double *u) {
    size_t n = w->n;
    pair(w, row);
    memcpy(u, w->a, n * sizeof *u);
    memcpy(u + n, w->b, n * sizeof *u);
    for (size_t g = 0; g < w->groups; g++)
        for (size_t d = 0; d < n; d++)
            u[(g + 2) * n + d] = group_of(w, d) == g ? w->b[d] : w->a[d];
}

/* one row of one response: value (points), `stride` apart */
static void add_row(const work *w, response *r, const double *value, size_t stride) {
    for (size_t k = 0; k < w->points; k++)
        if (!isfinite(value[k * stride])) return;
    double a = value[0] - r->shift, b = value[stride] - r->shift;
    r->rows_now++;
    r->v_now += (a * a + b * b) / 2, r->m_now += (a + b) / 2;
    for (size_t g = 0; g < w->groups; g++) {
        double mixed = value[(g + 2) * stride] - r->shift;
        r->first[g].now += b * (mixed - a);
        r->total[g].now += (a - mixed) * (a - mixed) / 2;
    }
}

static void add(sums *s, double rows, double v, double m) {
    double x = s->now / rows;
    s->x += x, s->xx += x * x, s->xv += x * v, s->xm += x * m;
    s->now = 0;
}

/* the replicate's means, where it has rows */
static void add_replicate(const work *w, response *r) {
    double rows = (double)r->rows_now, v = r->v_now / rows, m = r->m_now / rows;
    if (!r->rows_now) return;
    r->v += v, r->vv += v * v, r->m += m, r->mm += m * m, r->vm += v * m;
    for (size_t g = 0; g < w->groups; g++) {
        add(&r->first[g], rows, v, m);
        add(&r->total[g], rows, v, m);
    }
    r->rows += r->rows_now;
    r->replicates++;
    r->rows_now = 0, r->v_now = r->m_now = 0;
}

/* Ratio S = mean(x)/V, V = mean(v) - mean(m)^2, with Student's interval of its linear part: the influence of a replicate is
   (x - S (v - 2 mean(m) m))/V */
static fw_chance_share ratio(const response *r, const sums *s, double level) {
    double n = (double)r->replicates, x = s->x / n, v = r->v / n, m = r->m / n,
           variance = v - m * m;
    if (r->replicates < 2 || !(variance > 1e-24 * (v + r->shift * r->shift)))
        return (fw_chance_share){(double)NAN, (double)NAN, (double)NAN};
    double index = x / variance;
    double of_x = s->xx / n - x * x, with_v = s->xv / n - x * v, with_m = s->xm / n - x * m;
    double of_v = r->vv / n - v * v, of_m = r->mm / n - m * m, vm = r->vm / n - v * m;
    double of_w = of_v - 4 * m * vm + 4 * m * m * of_m, with_w = with_v - 2 * m * with_m;
    double spread =
        fmax(0, of_x - 2 * index * with_w + index * index * of_w) / (variance * variance);
    double half = fw_maths_student_quantile((1 + level) / 2, n - 1) * sqrt(spread / (n - 1));
    return (fw_chance_share){index, fmin(1, fmax(0, index - half)), fmax(0, fmin(1, index + half))};
}

static fw_status work_new(fw_arena *arena, const fw_chance_model *model, work *w) {
    size_t n = model->dimensions, groups = model->groups ? model->groups : n;
    *w = (work){.model = model, .n = n, .groups = groups, .points = groups + 2};
    w->quasi = 2 * n <= FW_CHANCE_SOBOL_MOST;
    FW_NEED(w->a = fw_arena_array(arena, double, 2 * n));
    w->b = w->a + n;
    FW_NEED(w->part = fw_arena_array(arena, response, model->responses));
    for (size_t r = 0; r < model->responses; r++) {
        FW_NEED(w->part[r].first = fw_arena_array(arena, sums, groups));
        FW_NEED(w->part[r].total = fw_arena_array(arena, sums, groups));
    }
    return FW_OK;
}

/* the mean of what could be evaluated of the first rows' own points */
static void set_shifts(work *w, size_t rows, const double *value) {
    size_t responses = w->model->responses;
    for (size_t r = 0; r < responses; r++) {
        double sum = 0, count = 0;
        for (size_t i = 0; i < rows; i++) {
            double x = value[i * w->points * responses + r];
            if (isfinite(x)) sum += x, count++;
        }
        w->part[r].shift = count > 0 ? sum / count : 0;
    }
}

/* `count` points from the `first` on, in calls of at most `batch` */
static fw_status evaluate(const work *w, fw_arena *arena, size_t batch, size_t first, size_t count,
                          const double *u, double *value) {
    for (size_t done = 0; done < count; done += batch) {
        if (fw_arena_cancelled(arena)) return FW_CANCELLED;
        size_t now = count - done < batch ? count - done : batch;
        FW_TRY(w->model->f(w->model->context, first + done, now, u + done * w->n,
                           value + done * w->model->responses));
    }
    return FW_OK;
}

/* the rows of one replicate, in blocks that a batch holds */
static fw_status replicate(fw_arena *arena, work *w, size_t number, size_t base, size_t batch) {
    size_t responses = w->model->responses, most = batch / w->points > 1 ? batch / w->points : 1;
    if (most > base) most = base;
    fw_mark mark = fw_arena_mark(arena);
    if (w->quasi) FW_TRY(fw_chance_sobol_new(arena, 2 * w->n, w->seed, &w->sobol));
    double *u = fw_arena_array(arena, double, most * w->points * w->n);
    double *value = fw_arena_array(arena, double, most * w->points * responses);
    FW_NEED(u && value ? u : NULL);
    for (size_t row = 0; row < base; row += most) {
        size_t rows = base - row < most ? base - row : most;
        for (size_t i = 0; i < rows; i++)
            row_points(w, row + i, u + i * w->points * w->n);
        FW_TRY(evaluate(w, arena, batch, (number * base + row) * w->points, rows * w->points, u,
                        value));
        if (number == 0 && row == 0) set_shifts(w, rows, value);
        for (size_t i = 0; i < rows; i++)
            for (size_t r = 0; r < responses; r++)
                add_row(w, &w->part[r], value + i * w->points * responses + r, responses);
    }
    for (size_t r = 0; r < responses; r++)
        add_replicate(w, &w->part[r]);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

fw_status fw_chance_indices_check(const fw_chance_model *model, const fw_chance_index_options *o,
                                  const char **why) {
    *why = NULL;
    if (model->dimensions < 1 || model->responses < 1)
        *why = "nothing scatters, or nothing is asked for";
    else if (o->base < BASE_LEAST)
        *why = "indices take at least 128 rows";
    else if (!(o->level >= 0 && o->level < 1))
        *why = "the level of an interval is above 0 and below 1";
    for (size_t d = 0; model->groups && d < model->dimensions; d++)
        if (model->group[d] >= model->groups) *why = "an input is in a group that there is not";
    return *why ? FW_INPUT : FW_OK;
}

/* Indices of variance: S_i = Var(E(f | x_i))/Var f, T_i = E(Var(f | all but x_i))/Var f, from N pairs of points a, b and
   points c_i, a with group i from b:  S_i = mean f(b) (f(c_i) - f(a))/V (Saltelli), T_i = mean (f(a) - f(c_i))^2/2 V
   (Jansen), f less its mean, V from all a and b. Pairs are halves of scrambled Sobol' points up to 168 dimensions, random
   beyond, in 16 independent replicates, from which the intervals are: what the points of one replicate have to do with each
   other, which for two poorly paired dimensions may be worse than chance, is in them. Error: N^-1/2 for random points, a
   tenth of it for smooth responses of few inputs and N = 4096. Cost: N (groups + 2) evaluations, N = 16 2^k. Source:
   A. Saltelli et al., Comp. Phys. Comm. 181 (2010) 259; M. Jansen, Comp. Phys. Comm. 117 (1999) 35; I. M. Sobol', Math.
   Comput. Simul. 55 (2001) 271. Test: test_indices.c */
fw_status fw_chance_indices_run(fw_arena *arena, const fw_chance_model *model,
                                const fw_chance_index_options *options, fw_chance_indices *out,
                                const char **why) {
    work w;
    size_t base = 1;
    FW_TRY(fw_chance_indices_check(model, options, why));
    FW_TRY(work_new(arena, model, &w));
    while (2 * base * REPLICATES <= options->base)
        base *= 2;
    for (size_t r = 0; r < REPLICATES; r++) {
        w.seed = fw_chance_seed(options->seed, r);
        FW_TRY(replicate(arena, &w, r, base, options->batch ? options->batch : BATCH));
    }
    size_t responses = model->responses;
    *out = (fw_chance_indices){.groups = w.groups,
                               .responses = responses,
                               .evaluations = REPLICATES * base * w.points,
                               .level = options->level > 0 ? options->level : 0.95};
    FW_NEED(out->mean = fw_arena_array(arena, double, responses));
    FW_NEED(out->variance = fw_arena_array(arena, double, responses));
    FW_NEED(out->rows = fw_arena_array(arena, size_t, responses));
    FW_NEED(out->first = fw_arena_array(arena, fw_chance_share, responses * w.groups));
    FW_NEED(out->total = fw_arena_array(arena, fw_chance_share, responses * w.groups));
    for (size_t r = 0; r < responses; r++) {
        const response *part = &w.part[r];
        double n = (double)part->replicates, m = part->m / n;
        out->rows[r] = part->rows;
        out->mean[r] = part->shift + m;
        out->variance[r] = part->v / n - m * m;
        for (size_t g = 0; g < w.groups; g++) {
            out->first[r * w.groups + g] = ratio(part, &part->first[g], out->level);
            out->total[r * w.groups + g] = ratio(part, &part->total[g], out->level);
        }
    }
    return FW_OK;
}
