/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Model to plan and numbers; the choice between the path and the flat schedule. */
#include "multibody/kernel_plan.h"
#include <math.h>

struct fw_kernel {
    fw_core core;
    const fw_path_ops *ops; /* of the path */
    void *path;             /* NULL: the flat schedule */
    void *own;              /* what the model allows */
    int pins;
    double *lambda; /* (2 pins) */
};

bool fw_core_plain(const fw_model *m) {
    return m->plain && m->nblock > 0 && !m->driven && m->worked < 0 && m->nload == 0 &&
           m->ntimed == 0 && m->nspring == 0 && m->nslide == 0 && m->nstop == 0 && !m->friction;
}

/* 1/m_a + 1/m_b, the smaller eigenvalue of the pin's own block; where r^2/J makes the block so much
   larger that its round-off would reach fw_healthy of that, 1e-8 of its trace (which does not
   depend on the pose) */
double fw_pin_floor(const fw_model *m, int pin) {
    double masses = 0, trace = 0;
    for (int side = 0; side < 2; side++) {
        int b = m->body[2 * pin + side];
        const double *l = m->local + 4 * pin + 2 * side;
        if (b == m->nbody) continue;
        masses += m->minv[b];
        trace += 2 * m->minv[b] + m->jinv[b] * (l[0] * l[0] + l[1] * l[1]);
    }
    return fmax(masses, 1e-8 * trace);
}

/* ---- plan ---- */

/* the first coupling of every block goes into the table by block, further ones into a list;
   a block without any (fill) gets a sign of zero */
static fw_status plan_couplings(fw_arena *arena, const fw_model *m, fw_kernel_plan *p) {
    const fw_chain *c = &m->chain;
    int *arm, *extra;
    size_t blocks = (size_t)c->blocks, more = (size_t)(c->ncoupling);
    FW_NEED(arm = fw_arena_array(arena, int, 2 * blocks));
    FW_NEED(extra = fw_arena_array(arena, int, 3 * more));
    for (int e = 0; e < 2 * c->blocks; e++)
        arm[e] = -1;
    for (int i = 0; i < c->ncoupling; i++) {
        const fw_coupling *from = &c->coupling[i];
        int *to = arm + 2 * from->block;
        if (to[0] >= 0) {
            to = extra + 3 * p->extras++;
            *to++ = from->block;
        }
        to[0] = from->row_arm, to[1] = from->column_arm;
    }
    for (int e = 0; e < 2 * c->blocks; e++)
        if (arm[e] < 0) arm[e] = 0;
    p->arm = arm, p->extra = extra;
    return FW_OK;
}

fw_status fw_kernel_plan_new(fw_arena *arena, const fw_model *m, fw_kernel_plan *p) {
    const fw_chain *c = &m->chain;
    int *torsion;
    *p = (fw_kernel_plan){.bodies = m->nbody,
                          .pins = m->nblock,
                          .blocks = c->blocks,
                          .torsions = m->ntorsion,
                          .nq = m->nq,
                          .ny = m->ny,
                          .dissipates = m->dissipated >= 0,
                          .body = m->body,
                          .column = c->column,
                          .row = c->row,
                          .first = c->first,
                          .update = c->update};
    FW_TRY(plan_couplings(arena, m, p));
    FW_NEED(torsion = fw_arena_array(arena, int, 2 * (size_t)m->ntorsion));
    for (int i = 0; i < m->ntorsion; i++)
        torsion[2 * i] = m->torsion[i].a, torsion[2 * i + 1] = m->torsion[i].b;
    p->torsion = torsion;
    return FW_OK;
}

fw_status fw_core_new(fw_arena *arena, const fw_kernel_plan *plan, const fw_core_ops *ops,
                      fw_core *k) {
    const fw_kernel_plan *p = plan;
    size_t w = (size_t)ops->width, n = (size_t)p->bodies + 1, m = (size_t)p->pins;
    *k = (fw_core){.plan = *plan, .ops = ops, .healthy = fw_healthy};
    FW_NEED(k->body = fw_arena_array(arena, double, w *FW_BODY *n));
    FW_NEED(k->pin = fw_arena_array(arena, double, w *FW_PIN *m));
    FW_NEED(k->block = fw_arena_array(arena, double, w *FW_BLOCK *(size_t)p->blocks));
    FW_NEED(k->extra = fw_arena_array(arena, double, w *FW_BLOCK *(size_t)p->extras));
    FW_NEED(k->torsion = fw_arena_array(arena, double, w *FW_TORSION *(size_t)p->torsions));
    FW_NEED(k->size = fw_arena_array(arena, double, w));
    FW_NEED(k->rate = fw_arena_array(arena, double, w));
    FW_NEED(k->state = fw_arena_array(arena, double, w *FW_STATE *n));
    FW_NEED(k->row = fw_arena_array(arena, double, w *FW_ROW *m));
    FW_NEED(k->coupling = fw_arena_array(arena, double, w *FW_COUPLING *(size_t)p->blocks));
    FW_NEED(k->keep = fw_arena_array(arena, double, w *FW_KEEP *m));
    if (ops->width == 1) {
        FW_NEED(k->angle = fw_arena_array(arena, double, n));
        FW_NEED(k->sine = fw_arena_array(arena, double, n));
        FW_NEED(k->cosine = fw_arena_array(arena, double, n));
    }
    return FW_OK;
}

/* ---- numbers ---- */

/* sign of a block's coupling: same sides of the two pins add, opposite ones subtract */
static void fill_block(const fw_model *m, const int arm[2], double *to, int w) {
    int body = m->body[arm[0]];
    double sign = arm[0] % 2 == arm[1] % 2 ? 1 : -1;
    bool shared = body == m->body[arm[1]] && arm[0] / 2 != arm[1] / 2;
    to[0] = shared ? sign * m->minv[body] : 0;
    to[w] = shared ? sign * m->jinv[body] : 0;
}

static void fill_pin(const fw_model *m, int i, double *to, int w) {
    for (int c = 0; c < 4; c++)
        to[w * (FW_LOCAL + c)] = m->local[4 * i + c];
    to[w * FW_MASSES] = m->minv[m->body[2 * i]] + m->minv[m->body[2 * i + 1]];
    to[w * FW_FLOOR] = fw_pin_floor(m, i);
    to[w * FW_OFFSET] = m->offset[2 * i];
    to[w * (FW_OFFSET + 1)] = m->offset[2 * i + 1];
}

void fw_core_fill(fw_core *k, const fw_model *m, int lane) {
    const fw_kernel_plan *p = &k->plan;
    const int w = k->ops->width;
    for (int b = 0; b <= p->bodies; b++) {
        double *to = k->body + w * FW_BODY * b + lane;
        bool ground = b == p->bodies;
        to[w * FW_MINV] = ground ? 0 : m->minv[b];
        to[w * FW_JINV] = ground ? 0 : m->jinv[b];
        for (int c = 0; c < 3; c++)
            to[w * (FW_AX + c)] = ground ? 0 : m->constant[3 * b + c];
        to[w * FW_PHI0] = ground ? 0 : m->origin[3 * b + 2];
        k->state[w * (FW_STATE * b + FW_C) + lane] = 1; /* of the ground it stays */
    }
    for (int i = 0; i < p->pins; i++)
        fill_pin(m, i, k->pin + w * FW_PIN * i + lane, w);
    for (int e = 0; e < p->blocks; e++)
        fill_block(m, p->arm + 2 * e, k->block + w * FW_BLOCK * e + lane, w);
    for (int e = 0; e < p->extras; e++)
        fill_block(m, p->extra + 3 * e + 1, k->extra + w * FW_BLOCK * e + lane, w);
    for (int i = 0; i < p->torsions; i++) {
        double *to = k->torsion + w * FW_TORSION * i + lane;
        const fw_model_torsion *t = &m->torsion[i];
        to[0] = t->k, to[w] = t->c, to[2 * w] = t->k * t->angle0;
    }
    k->size[lane] = m->size;
    k->rate[lane] = 1;
}

/* rows that depend on each other in two poses picked without regard to the joints do so in all */
fw_status fw_core_examine(fw_arena *arena, fw_core *k) {
    const int n = k->plan.nq, w = k->ops->width;
    fw_mark mark = fw_arena_mark(arena);
    double *u;
    FW_NEED(u = fw_arena_array(arena, double, (size_t)(n * w)));
    k->redundant = true;
    for (int pose = 0; pose < 2 && k->redundant; pose++) {
        for (int i = 0; i < n * w; i++)
            u[i] = 0.3 * sin(7.1 * (i / w) + 1 + pose);
        k->redundant = k->ops->singular(k, u);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* ---- one design ---- */

const fw_path_ops *fw_path_single(int i) {
    static const fw_path_ops *const all[] = {
#if defined(__x86_64__)
        &fw_path_single_avx512,
        &fw_path_single_avx,
#endif
        &fw_path_baseline,
        NULL,
    };
    const fw_path_ops *const *row = all;
#if defined(__x86_64__)
    __builtin_cpu_init();
    bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                __builtin_cpu_supports("avx512vl");
    row += wide ? 0 : __builtin_cpu_supports("avx") ? 1 : 2;
#endif
    while (i > 0 && *row)
        row++, i--;
    return *row;
}

fw_status fw_kernel_new(fw_arena *arena, const fw_model *m, fw_kernel **kernel) {
    *kernel = NULL;
    if (!fw_core_plain(m)) return FW_OK;
    fw_kernel *k = fw_arena_one(arena, fw_kernel);
    fw_kernel_plan plan;
    FW_NEED(k);
    FW_TRY(fw_kernel_plan_new(arena, m, &plan));
    FW_TRY(fw_core_new(arena, &plan, &fw_core_single, &k->core));
    fw_core_fill(&k->core, m, 0);
    FW_TRY(fw_core_examine(arena, &k->core));
    fw_trail trail;
    bool found;
    FW_TRY(fw_trail_find(arena, m, &trail, &found));
    k->ops = fw_path_single(0);
    if (found) FW_TRY(k->ops->create(arena, &m, &trail, &k->own));
    k->path = k->own;
    k->pins = m->nblock;
    FW_NEED(k->lambda = fw_arena_array(arena, double, 2 * (size_t)m->nblock));
    *kernel = k;
    return FW_OK;
}

void fw_kernel_rhs(fw_kernel *k, const double *y, double *f) {
    if (k->path)
        k->ops->rhs(k->path, y, f);
    else
        k->core.ops->rhs(&k->core, y, f);
}

bool fw_kernel_project(fw_kernel *k, double *y, double *f) {
    return k->path ? k->ops->project(k->path, y, f) : k->core.ops->project(&k->core, y, f);
}

const double *fw_kernel_lambda(fw_kernel *k) {
    if (k->path)
        k->ops->lambda(k->path, 0, k->lambda);
    else
        for (int i = 0; i < k->pins; i++)
            for (int c = 0; c < 2; c++)
                k->lambda[2 * i + c] = k->core.row[FW_ROW * i + FW_X + c];
    return k->lambda;
}

fw_kernel_norms fw_kernel_norms_of(const fw_kernel *k) {
    return k->path ? k->ops->norms(k->path) : k->core.norms;
}

bool fw_kernel_is_path(const fw_kernel *k) {
    return k->path;
}

void fw_kernel_prefer(fw_kernel *k, bool path) {
    k->path = path ? k->own : NULL;
}

void fw_kernel_set_healthy(fw_kernel *k, double relative) {
    k->core.healthy = relative;
    if (k->own) k->ops->set_healthy(k->own, relative);
}
