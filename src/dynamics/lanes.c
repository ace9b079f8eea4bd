/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/lanes.h"
#include "dynamics/kernel_plan.h"
#include "maths/ode.h"
#include <math.h>
#include <string.h>

struct fw_lanes {
    const fw_core_ops *ops;
    int count, groups, ny, pins;
    fw_core *core; /* (groups) */
};

/* ---- instruction sets ---- */

static const fw_core_ops *const *available(void) {
    static const fw_core_ops *const all[] = {
#if defined(__x86_64__)
        &fw_core_avx512,
        &fw_core_avx2,
#endif
        &fw_core_sse2,
        NULL
    };
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return all + 2;
    if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") ||
        !__builtin_cpu_supports("avx512vl"))
        return all + 1;
#endif
    return all;
}

const char *const *fw_lanes_sets(void) {
    static const char *const names[] = {
#if defined(__x86_64__)
        "avx512",
        "avx2",
#endif
        "sse2",
        NULL
    };
    int skip = 0;
    while (names[skip] && strcmp(names[skip], available()[0]->name) != 0)
        skip++;
    return names + skip;
}

static const fw_core_ops *find_set(const char *name) {
    const fw_core_ops *const *row = available();
    if (!name) return row[0];
    while (*row && strcmp((*row)->name, name) != 0)
        row++;
    return *row;
}

/* ---- a batch ---- */

static bool same_topology(const fw_model *a, const fw_model *b) {
    bool same = a->nbody == b->nbody && a->nblock == b->nblock && a->ntorsion == b->ntorsion &&
                a->ny == b->ny;
    for (int i = 0; same && i < 2 * a->nblock; i++)
        same = a->body[i] == b->body[i];
    for (int i = 0; same && i < a->ntorsion; i++)
        same = a->torsion[i].a == b->torsion[i].a && a->torsion[i].b == b->torsion[i].b;
    return same;
}

fw_status fw_lanes_new(fw_arena *arena, const fw_model *const *models, int count, const char *set,
                       fw_lanes **lanes) {
    const fw_core_ops *ops = find_set(set);
    fw_kernel_plan plan;
    *lanes = NULL;
    if (!ops || count <= 0) return FW_USAGE;
    for (int i = 0; i < count; i++)
        if (!fw_core_plain(models[i]) || !same_topology(models[0], models[i])) return FW_OK;
    FW_TRY(fw_kernel_plan_new(arena, models[0], &plan));
    fw_lanes *l = fw_arena_one(arena, fw_lanes);
    FW_NEED(l);
    *l = (fw_lanes){.ops = ops,
                    .count = count,
                    .groups = (count + ops->width - 1) / ops->width,
                    .ny = plan.ny,
                    .pins = plan.pins};
    FW_NEED(l->core = fw_arena_array(arena, fw_core, (size_t)l->groups));
    for (int g = 0; g < l->groups; g++) {
        FW_TRY(fw_core_new(arena, &plan, ops, &l->core[g]));
        for (int lane = 0; lane < ops->width; lane++) {
            int design = g * ops->width + lane;
            fw_core_fill(&l->core[g], models[design < count ? design : count - 1], lane);
        }
        FW_TRY(fw_core_examine(arena, &l->core[g]));
    }
    *lanes = l;
    return FW_OK;
}

int fw_lanes_width(const fw_lanes *l) {
    return l->ops->width;
}

const char *fw_lanes_set_name(const fw_lanes *l) {
    return l->ops->name;
}

static size_t group_size(const fw_lanes *l) {
    return (size_t)l->ny * (size_t)l->ops->width;
}

size_t fw_lanes_size(const fw_lanes *l) {
    return group_size(l) * (size_t)l->groups;
}

static size_t place(const fw_lanes *l, int design) {
    return (size_t)(design / l->ops->width) * group_size(l) + (size_t)(design % l->ops->width);
}

void fw_lanes_put(const fw_lanes *l, int design, const double *y, double *batch) {
    int end = design + 1 == l->count ? l->groups * l->ops->width : design + 1;
    for (int d = design; d < end; d++)
        for (int i = 0; i < l->ny; i++)
            batch[place(l, d) + (size_t)(i * l->ops->width)] = y[i];
}

void fw_lanes_get(const fw_lanes *l, int design, const double *batch, double *y) {
    for (int i = 0; i < l->ny; i++)
        y[i] = batch[place(l, design) + (size_t)(i * l->ops->width)];
}

void fw_lanes_rhs(fw_lanes *l, const double *y, double *f) {
    for (int g = 0; g < l->groups; g++)
        l->ops->rhs(&l->core[g], y + (size_t)g * group_size(l), f + (size_t)g * group_size(l));
}

bool fw_lanes_project(fw_lanes *l, double *y, double *f) {
    bool good = true;
    for (int g = 0; g < l->groups; g++)
        good &= l->ops->project(&l->core[g], y + (size_t)g * group_size(l),
                                f + (size_t)g * group_size(l));
    return good;
}

void fw_lanes_lambda(const fw_lanes *l, int design, double *lambda) {
    const int w = l->ops->width;
    const double *row = l->core[design / w].row;
    for (int i = 0; i < l->pins; i++)
        for (int c = 0; c < 2; c++)
            lambda[2 * i + c] = row[w * (FW_ROW * i + FW_X + c) + design % w];
}

/* ---- lockstep ---- */

static void group_rhs(void *context, double t, const double *y, double *f) {
    fw_core *k = context;
    (void)t; /* plain models do not depend on time */
    k->ops->rhs(k, y, f);
}

static bool group_project(void *context, double t, double *y, double *f) {
    fw_core *k = context;
    (void)t;
    return k->ops->project(k, y, f);
}

static fw_status integrate_group(fw_arena *arena, fw_core *k, double rtol, const double *atol,
                                 double *y, fw_lanes_run *run) {
    const int w = k->ops->width, n = k->plan.ny * w;
    const fw_ode ode = {.context = k,
                        .rhs = group_rhs,
                        .project = group_project,
                        .n = n,
                        .controlled = 2 * k->plan.nq * w};
    double *wide, share = 1 / sqrt(w);
    fw_stepper *s;
    FW_NEED(wide = fw_arena_array(arena, double, (size_t)n));
    for (int i = 0; i < n; i++)
        wide[i] = share * atol[i / w];
    FW_TRY(fw_stepper_new(arena, fw_stepper_find("dop853"), &ode, share * rtol, wide, &s));
    fw_stepper_start(s, 0, y, 1);
    while (s->t < s->t_end)
        if (fw_stepper_step(s) != FW_ODE_STEP) return FW_SOLVER;
    memcpy(y, s->y, (size_t)n * sizeof *y);
    run->steps += s->steps, run->rejected += s->rejected, run->rhs += s->rhs;
    return FW_OK;
}

fw_status fw_lanes_integrate(fw_arena *arena, fw_lanes *l, const double *duration, double rtol,
                             const double *atol, double *y, fw_lanes_run *run) {
    const int w = l->ops->width;
    fw_status status = FW_OK;
    *run = (fw_lanes_run){0};
    fw_mark mark = fw_arena_mark(arena);
    for (int g = 0; g < l->groups && status == FW_OK; g++) {
        fw_core *k = &l->core[g];
        for (int lane = 0; lane < w; lane++) {
            int design = g * w + lane;
            k->rate[lane] = duration[design < l->count ? design : l->count - 1];
        }
        status = integrate_group(arena, k, rtol, atol, y + (size_t)g * group_size(l), run);
        for (int lane = 0; lane < w; lane++)
            k->rate[lane] = 1;
        fw_arena_rewind(arena, mark);
    }
    return status;
}
