/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/lanes.h"
#include "multibody/kernel_plan.h"
#include "maths/ode.h"
#include <math.h>
#include <string.h>

typedef struct set { /* one instruction set */
    const fw_core_ops *flat;
    const fw_path_ops *path;
} set;

struct fw_lanes {
    const set *set;
    bool is_path;
    int count, width, groups, nq, ny, pins;
    fw_core *core; /* (groups), or */
    void **path;   /* (groups) */
};

/* ---- instruction sets ---- */

/* best first, ends with an empty row */
static const set *available(void) {
    static const set all[] = {
#if defined(__x86_64__)
        {&fw_core_avx512, &fw_path_avx512},
        {&fw_core_avx2, &fw_path_avx2},
#endif
        {&fw_core_sse2, &fw_path_sse2},
        {NULL, NULL}
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

const char *fw_lanes_set(int i) {
    const set *row = available();
    while (i > 0 && row->flat)
        row++, i--;
    return row->flat ? row->flat->name : NULL;
}

static const set *find_set(const char *name) {
    const set *row = available();
    while (name && row->flat && strcmp(row->flat->name, name) != 0)
        row++;
    return row->flat ? row : NULL;
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

static fw_status new_group(fw_arena *arena, fw_lanes *l, const fw_kernel_plan *plan,
                           const fw_trail *trail, const fw_model *const *models, int g) {
    const fw_model *of[8];
    for (int lane = 0; lane < l->width; lane++) {
        int design = g * l->width + lane;
        of[lane] = models[design < l->count ? design : l->count - 1];
    }
    if (l->is_path) return l->set->path->create(arena, of, trail, &l->path[g]);
    FW_TRY(fw_core_new(arena, plan, l->set->flat, &l->core[g]));
    for (int lane = 0; lane < l->width; lane++)
        fw_core_fill(&l->core[g], of[lane], lane);
    return fw_core_examine(arena, &l->core[g]);
}

fw_status fw_lanes_new(fw_arena *arena, const fw_model *const *models, int count, const char *name,
                       fw_lanes **lanes) {
    const set *chosen = find_set(name);
    fw_kernel_plan plan;
    fw_trail trail;
    *lanes = NULL;
    if (!chosen || count <= 0) return FW_USAGE;
    for (int i = 0; i < count; i++)
        if (!fw_core_plain(models[i]) || !same_topology(models[0], models[i])) return FW_OK;
    fw_lanes *l = fw_arena_one(arena, fw_lanes);
    FW_NEED(l);
    FW_TRY(fw_kernel_plan_new(arena, models[0], &plan));
    FW_TRY(fw_trail_find(arena, models[0], &trail, &l->is_path));
    l->set = chosen;
    l->count = count, l->width = chosen->flat->width;
    l->groups = (count + l->width - 1) / l->width;
    l->nq = plan.nq, l->ny = plan.ny, l->pins = plan.pins;
    FW_NEED(l->core = fw_arena_array(arena, fw_core, (size_t)l->groups));
    FW_NEED(l->path = fw_arena_array(arena, void *, (size_t)l->groups));
    for (int g = 0; g < l->groups; g++)
        FW_TRY(new_group(arena, l, &plan, &trail, models, g));
    *lanes = l;
    return FW_OK;
}

int fw_lanes_width(const fw_lanes *l) {
    return l->width;
}

const char *fw_lanes_set_name(const fw_lanes *l) {
    return l->set->flat->name;
}

static size_t group_size(const fw_lanes *l) {
    return (size_t)l->ny * (size_t)l->width;
}

size_t fw_lanes_size(const fw_lanes *l) {
    return group_size(l) * (size_t)l->groups;
}

static size_t place(const fw_lanes *l, int design) {
    return (size_t)(design / l->width) * group_size(l) + (size_t)(design % l->width);
}

void fw_lanes_put(const fw_lanes *l, int design, const double *y, double *batch) {
    int end = design + 1 == l->count ? l->groups * l->width : design + 1;
    for (int d = design; d < end; d++)
        for (int i = 0; i < l->ny; i++)
            batch[place(l, d) + (size_t)(i * l->width)] = y[i];
}

void fw_lanes_get(const fw_lanes *l, int design, const double *batch, double *y) {
    for (int i = 0; i < l->ny; i++)
        y[i] = batch[place(l, design) + (size_t)(i * l->width)];
}

static void group_rhs(fw_lanes *l, int g, const double *y, double *f) {
    if (l->is_path)
        l->set->path->rhs(l->path[g], y, f);
    else
        l->set->flat->rhs(&l->core[g], y, f);
}

static bool group_project(fw_lanes *l, int g, double *y, double *f) {
    return l->is_path ? l->set->path->project(l->path[g], y, f)
                      : l->set->flat->project(&l->core[g], y, f);
}

void fw_lanes_rhs(fw_lanes *l, const double *y, double *f) {
    for (int g = 0; g < l->groups; g++)
        group_rhs(l, g, y + (size_t)g * group_size(l), f + (size_t)g * group_size(l));
}

bool fw_lanes_project(fw_lanes *l, double *y, double *f) {
    bool good = true;
    for (int g = 0; g < l->groups; g++)
        good &= group_project(l, g, y + (size_t)g * group_size(l), f + (size_t)g * group_size(l));
    return good;
}

void fw_lanes_lambda(const fw_lanes *l, int design, double *lambda) {
    const int w = l->width, g = design / w;
    if (l->is_path) {
        l->set->path->lambda(l->path[g], design % w, lambda);
        return;
    }
    const double *row = l->core[g].row;
    for (int i = 0; i < l->pins; i++)
        for (int c = 0; c < 2; c++)
            lambda[2 * i + c] = row[w * (FW_ROW * i + FW_X + c) + design % w];
}

/* ---- lockstep ---- */

typedef struct group {
    fw_lanes *lanes;
    int number;
} group;

static void ode_rhs(void *context, double t, const double *y, double *f) {
    const group *g = context;
    (void)t; /* plain models do not depend on time */
    group_rhs(g->lanes, g->number, y, f);
}

static bool ode_project(void *context, double t, double *y, double *f) {
    const group *g = context;
    (void)t;
    return group_project(g->lanes, g->number, y, f);
}

static void set_rate(fw_lanes *l, int g, const double *duration) {
    double rate[8];
    for (int lane = 0; lane < l->width; lane++) {
        int design = g * l->width + lane;
        rate[lane] = duration ? duration[design < l->count ? design : l->count - 1] : 1;
    }
    if (l->is_path)
        l->set->path->set_rate(l->path[g], rate);
    else
        memcpy(l->core[g].rate, rate, (size_t)l->width * sizeof *rate);
}

static fw_status integrate_group(fw_arena *arena, group g, double rtol, const double *atol,
                                 double *y, fw_lanes_run *run) {
    const int w = g.lanes->width, n = g.lanes->ny * w;
    const fw_ode ode = {.context = &g,
                        .rhs = ode_rhs,
                        .project = ode_project,
                        .n = n,
                        .controlled = 2 * g.lanes->nq * w};
    double *wide, share = 1 / sqrt(w);
    fw_stepper *s;
    FW_NEED(wide = fw_arena_array(arena, double, (size_t)n));
    for (int i = 0; i < n; i++)
        wide[i] = share * atol[i / w];
    FW_TRY(fw_stepper_new(arena, fw_stepper_find("dop853"), &ode, share * rtol, wide, &s));
    fw_stepper_start(s, 0, y, 1);
    fw_ode_result result = FW_ODE_STEP;
    while (s->t < s->t_end && result == FW_ODE_STEP)
        result = fw_stepper_step(s);
    memcpy(y, s->y, (size_t)n * sizeof *y);
    fw_stepper_free(s);
    run->steps += s->steps, run->rejected += s->rejected, run->rhs += s->rhs;
    return result == FW_ODE_STEP ? FW_OK : FW_SOLVER;
}

fw_status fw_lanes_integrate(fw_arena *arena, fw_lanes *l, const double *duration, double rtol,
                             const double *atol, double *y, fw_lanes_run *run) {
    fw_status status = FW_OK;
    *run = (fw_lanes_run){0};
    fw_mark mark = fw_arena_mark(arena);
    for (int g = 0; g < l->groups && status == FW_OK; g++) {
        set_rate(l, g, duration);
        status =
            integrate_group(arena, (group){l, g}, rtol, atol, y + (size_t)g * group_size(l), run);
        set_rate(l, g, NULL);
        fw_arena_rewind(arena, mark);
    }
    return status;
}
