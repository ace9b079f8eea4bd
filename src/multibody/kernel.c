/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Model to plan and numbers; one design, and lanes of designs. */
#include "maths/ode.h"
#include "multibody/kernel.h"
#include <math.h>
#include <string.h>

struct fw_multibody_lanes {
    const fw_multibody_core_ops *ops;
    int count, width, groups, ny;
    fw_multibody_core *core; /* (groups) */
};

bool fw_multibody_core_plain(const fw_multibody_model *m) {
    return m->plain && m->nblock > 0 && !m->driven && m->worked < 0 && m->nload == 0 &&
           m->ntimed == 0 && m->nspring == 0 && m->nslide == 0 && m->nstop == 0 && !m->special;
}

/* ---- plan ---- */

/* the first coupling of every block goes into the table by block, further ones into a list;
   a block without any (fill) gets a sign of zero */
static fw_status plan_couplings(fw_arena *arena, const fw_multibody_model *m,
                                fw_multibody_kernel_plan *p) {
    const fw_multibody_chain *c = &m->chain;
    int *arm, *extra;
    size_t blocks = (size_t)c->blocks, more = (size_t)(c->ncoupling);
    FW_NEED(arm = fw_arena_array(arena, int, 2 * blocks));
    FW_NEED(extra = fw_arena_array(arena, int, 3 * more));
    for (int e = 0; e < 2 * c->blocks; e++)
        arm[e] = -1;
    for (int i = 0; i < c->ncoupling; i++) {
        const fw_multibody_coupling *from = &c->coupling[i];
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

/* from the ground along the pins, every body once and back to the ground? */
static bool follow_loop(const fw_multibody_model *m, fw_multibody_kernel_plan *p) {
    int pin = -1, body = m->nbody;
    for (int i = 0; i <= m->nbody; i++) {
        int next = -1;
        for (int j = 0; j < m->nblock && next < 0; j++)
            if (j != pin && (m->body[2 * j] == body || m->body[2 * j + 1] == body)) next = j;
        if (next < 0) return false;
        pin = next;
        p->loop_body[i] = body, p->loop_pin[i] = pin;
        body = m->body[2 * pin] == body ? m->body[2 * pin + 1] : m->body[2 * pin];
        if ((body == m->nbody) != (i == m->nbody)) return false;
    }
    p->loop_body[m->nbody + 1] = body;
    for (int i = 1; i <= m->nbody; i++)
        for (int j = 1; j < i; j++)
            if (p->loop_body[i] == p->loop_body[j]) return false;
    return true;
}

/* is the model one closed loop of few bodies, with every spring across one of its pins? */
static fw_status plan_loop(fw_arena *arena, const fw_multibody_model *m,
                           fw_multibody_kernel_plan *p) {
    int *place;
    if (m->nbody < FW_LOOP_LEAST || m->nbody > FW_LOOP_MOST || m->nblock != m->nbody + 1 ||
        !follow_loop(m, p))
        return FW_OK;
    FW_NEED(place = fw_arena_array(arena, int, (size_t)m->ntorsion));
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *s = &m->torsion[i];
        place[i] = -1;
        for (int k = 0; k < m->nblock; k++) {
            int a = p->loop_body[k], b = p->loop_body[k + 1];
            if ((a == s->a && b == s->b) || (a == s->b && b == s->a)) place[i] = k;
        }
        if (place[i] < 0) return FW_OK;
    }
    p->loop_torsion = place;
    p->loop = true;
    return FW_OK;
}

static fw_status new_plan(fw_arena *arena, const fw_multibody_model *m,
                          fw_multibody_kernel_plan *p) {
    const fw_multibody_chain *c = &m->chain;
    int *torsion;
    *p = (fw_multibody_kernel_plan){.bodies = m->nbody,
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
    return plan_loop(arena, m, p);
}

/* ---- numbers ---- */

/* sign of a block's coupling: same sides of the two pins add, opposite ones subtract */
static void fill_block(const fw_multibody_model *m, const int arm[2], double *to, int w) {
    int body = m->body[arm[0]];
    double sign = arm[0] % 2 == arm[1] % 2 ? 1 : -1;
    bool shared = body == m->body[arm[1]] && arm[0] / 2 != arm[1] / 2;
    to[0] = shared ? sign * m->minv[body] : 0;
    to[w] = shared ? sign * m->jinv[body] : 0;
}

/* 1/m_a + 1/m_b, the smaller eigenvalue of the pin's own block; where r^2/J makes the block so much
   larger that its round-off would reach fw_healthy of that, 1e-8 of its trace (which does not
   depend on the pose). The pivot of a pin is measured against it. */
static double pin_floor(const fw_multibody_model *m, int pin) {
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

static void fill_pin(const fw_multibody_model *m, int i, double *to, int w) {
    for (int c = 0; c < 4; c++)
        to[w * (FW_LOCAL + c)] = m->local[4 * i + c];
    to[w * FW_MASSES] = m->minv[m->body[2 * i]] + m->minv[m->body[2 * i + 1]];
    to[w * FW_FLOOR] = pin_floor(m, i);
    to[w * FW_OFFSET] = m->offset[2 * i];
    to[w * (FW_OFFSET + 1)] = m->offset[2 * i + 1];
}

static void fill_core(fw_multibody_core *k, const fw_multibody_model *m, int lane) {
    const fw_multibody_kernel_plan *p = &k->plan;
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
        const fw_multibody_torsion *t = &m->torsion[i];
        to[0] = t->k, to[w] = t->c, to[2 * w] = t->k * t->angle0;
    }
    k->size[lane] = m->size;
    k->rate[lane] = 1;
    if (k->loop) k->ops->loop_fill(k, m, lane);
}

/* rows that depend on each other in two poses picked without regard to the joints do so in all */
static fw_status examine(fw_arena *arena, fw_multibody_core *k) {
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

/* `ops->width` models of one topology */
static fw_status new_core(fw_arena *arena, const fw_multibody_kernel_plan *plan,
                          const fw_multibody_core_ops *ops, const fw_multibody_model *const *models,
                          fw_multibody_core *k) {
    const fw_multibody_kernel_plan *p = plan;
    size_t w = (size_t)ops->width, n = (size_t)p->bodies + 1, m = (size_t)p->pins;
    *k = (fw_multibody_core){.plan = *plan, .ops = ops, .healthy = fw_healthy};
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
    if (p->loop) FW_TRY(ops->loop_new(arena, k));
    for (int lane = 0; lane < ops->width; lane++)
        fill_core(k, models[lane], lane);
    return examine(arena, k);
}

/* ---- one design ---- */

fw_status fw_multibody_kernel_new(fw_arena *arena, const fw_multibody_model *m,
                                  fw_multibody_kernel **kernel) {
    *kernel = NULL;
    if (!fw_multibody_core_plain(m)) return FW_OK;
    fw_multibody_kernel *k = fw_arena_one(arena, fw_multibody_kernel);
    fw_multibody_kernel_plan plan;
    FW_NEED(k);
    FW_TRY(new_plan(arena, m, &plan));
    FW_TRY(new_core(arena, &plan, &fw_multibody_core_single, &m, &k->core));
    FW_NEED(k->lambda = fw_arena_array(arena, double, 2 * (size_t)m->nblock));
    *kernel = k;
    return FW_OK;
}

void fw_multibody_kernel_rhs(fw_multibody_kernel *k, const double *y, double *f) {
    k->core.ops->rhs(&k->core, y, f);
}

bool fw_multibody_kernel_project(fw_multibody_kernel *k, double *y, double *f) {
    return k->core.ops->project(&k->core, y, f);
}

static void lambda_of(const fw_multibody_core *k, int lane, double *lambda) {
    const int w = k->ops->width;
    for (int i = 0; i < k->plan.pins; i++)
        for (int c = 0; c < 2; c++)
            lambda[2 * i + c] = k->row[w * (FW_ROW * i + FW_X + c) + lane];
}

const double *fw_multibody_kernel_lambda(fw_multibody_kernel *k) {
    lambda_of(&k->core, 0, k->lambda);
    return k->lambda;
}

fw_multibody_kernel_norms fw_multibody_kernel_norms_of(const fw_multibody_kernel *k) {
    return k->core.norms;
}

/* ---- lanes: instruction sets ---- */

/* best first, NULL after the last */
static const fw_multibody_core_ops *const *available(void) {
    static const fw_multibody_core_ops *const all[] = {
#if defined(__x86_64__)
        &fw_multibody_core_avx512,
        &fw_multibody_core_avx2,
#endif
        &fw_multibody_core_single,
        NULL,
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

const char *fw_multibody_lanes_set(int i) {
    const fw_multibody_core_ops *const *row = available();
    while (i > 0 && *row)
        row++, i--;
    return *row ? (*row)->name : NULL;
}

static const fw_multibody_core_ops *find_set(const char *name) {
    const fw_multibody_core_ops *const *row = available();
    while (name && *row && strcmp((*row)->name, name) != 0)
        row++;
    return *row;
}

/* ---- lanes: a batch ---- */

static bool same_topology(const fw_multibody_model *a, const fw_multibody_model *b) {
    bool same = a->nbody == b->nbody && a->nblock == b->nblock && a->ntorsion == b->ntorsion &&
                a->ny == b->ny;
    for (int i = 0; same && i < 2 * a->nblock; i++)
        same = a->body[i] == b->body[i];
    for (int i = 0; same && i < a->ntorsion; i++)
        same = a->torsion[i].a == b->torsion[i].a && a->torsion[i].b == b->torsion[i].b;
    return same;
}

static fw_status new_group(fw_arena *arena, fw_multibody_lanes *l,
                           const fw_multibody_kernel_plan *plan,
                           const fw_multibody_model *const *models, int g) {
    const fw_multibody_model *of[FW_WIDTH_MOST];
    for (int lane = 0; lane < l->width; lane++) {
        int design = g * l->width + lane;
        of[lane] = models[design < l->count ? design : l->count - 1];
    }
    return new_core(arena, plan, l->ops, of, &l->core[g]);
}

fw_status fw_multibody_lanes_new(fw_arena *arena, const fw_multibody_model *const *models,
                                 int count, const char *name, fw_multibody_lanes **lanes) {
    const fw_multibody_core_ops *chosen = find_set(name);
    fw_multibody_kernel_plan plan;
    *lanes = NULL;
    if (!chosen || count <= 0) return FW_USAGE;
    for (int i = 0; i < count; i++)
        if (!fw_multibody_core_plain(models[i]) || !same_topology(models[0], models[i]))
            return FW_OK;
    fw_multibody_lanes *l = fw_arena_one(arena, fw_multibody_lanes);
    FW_NEED(l);
    FW_TRY(new_plan(arena, models[0], &plan));
    l->ops = chosen;
    l->count = count, l->width = chosen->width;
    l->groups = (count + l->width - 1) / l->width;
    l->ny = plan.ny;
    FW_NEED(l->core = fw_arena_array(arena, fw_multibody_core, (size_t)l->groups));
    for (int g = 0; g < l->groups; g++)
        FW_TRY(new_group(arena, l, &plan, models, g));
    *lanes = l;
    return FW_OK;
}

int fw_multibody_lanes_width(const fw_multibody_lanes *l) {
    return l->width;
}

const char *fw_multibody_lanes_set_name(const fw_multibody_lanes *l) {
    return l->ops->name;
}

static size_t group_size(const fw_multibody_lanes *l) {
    return (size_t)l->ny * (size_t)l->width;
}

size_t fw_multibody_lanes_size(const fw_multibody_lanes *l) {
    return group_size(l) * (size_t)l->groups;
}

static size_t place(const fw_multibody_lanes *l, int design) {
    return (size_t)(design / l->width) * group_size(l) + (size_t)(design % l->width);
}

void fw_multibody_lanes_put(const fw_multibody_lanes *l, int design, const double *y,
                            double *batch) {
    int end = design + 1 == l->count ? l->groups * l->width : design + 1;
    for (int d = design; d < end; d++)
        for (int i = 0; i < l->ny; i++)
            batch[place(l, d) + (size_t)(i * l->width)] = y[i];
}

void fw_multibody_lanes_get(const fw_multibody_lanes *l, int design, const double *batch,
                            double *y) {
    for (int i = 0; i < l->ny; i++)
        y[i] = batch[place(l, design) + (size_t)(i * l->width)];
}

void fw_multibody_lanes_rhs(fw_multibody_lanes *l, const double *y, double *f) {
    for (int g = 0; g < l->groups; g++)
        l->ops->rhs(&l->core[g], y + (size_t)g * group_size(l), f + (size_t)g * group_size(l));
}

bool fw_multibody_lanes_project(fw_multibody_lanes *l, double *y, double *f) {
    bool good = true;
    for (int g = 0; g < l->groups; g++) {
        size_t at = (size_t)g * group_size(l);
        good &= l->ops->project(&l->core[g], y + at, f + at);
    }
    return good;
}

void fw_multibody_lanes_lambda(const fw_multibody_lanes *l, int design, double *lambda) {
    lambda_of(&l->core[design / l->width], design % l->width, lambda);
}

/* ---- lanes: lockstep ---- */

static void ode_rhs(void *context, double t, const double *y, double *f) {
    fw_multibody_core *k = context;
    (void)t; /* plain models do not depend on time */
    k->ops->rhs(k, y, f);
}

static bool ode_project(void *context, double t, double *y, double *f) {
    fw_multibody_core *k = context;
    (void)t;
    return k->ops->project(k, y, f);
}

/* duration NULL: 1 */
static void set_rate(fw_multibody_lanes *l, int g, const double *duration) {
    for (int lane = 0; lane < l->width; lane++) {
        int design = g * l->width + lane;
        l->core[g].rate[lane] = duration ? duration[design < l->count ? design : l->count - 1] : 1;
    }
}

static fw_status integrate_group(fw_arena *arena, fw_multibody_core *k, double rtol,
                                 const double *atol, double *y, fw_multibody_lanes_run *run) {
    const int w = k->ops->width, n = k->plan.ny * w;
    const fw_maths_ode ode = {.context = k,
                              .rhs = ode_rhs,
                              .project = ode_project,
                              .n = n,
                              .controlled = 2 * k->plan.nq * w};
    double *wide, share = 1 / sqrt(w);
    fw_maths_stepper *s;
    FW_NEED(wide = fw_arena_array(arena, double, (size_t)n));
    for (int i = 0; i < n; i++)
        wide[i] = share * atol[i / w];
    FW_TRY(
        fw_maths_stepper_new(arena, fw_maths_stepper_find("dop853"), &ode, share * rtol, wide, &s));
    fw_maths_stepper_start(s, 0, y, 1);
    fw_maths_ode_result result = FW_ODE_STEP;
    while (s->t < s->t_end && result == FW_ODE_STEP)
        result = fw_maths_stepper_step(s);
    memcpy(y, s->y, (size_t)n * sizeof *y);
    fw_maths_stepper_free(s);
    run->steps += s->steps, run->rejected += s->rejected, run->rhs += s->rhs;
    return result == FW_ODE_STEP ? FW_OK : FW_SOLVER;
}

fw_status fw_multibody_lanes_integrate(fw_arena *arena, fw_multibody_lanes *l,
                                       const double *duration, double rtol, const double *atol,
                                       double *y, fw_multibody_lanes_run *run) {
    fw_status status = FW_OK;
    *run = (fw_multibody_lanes_run){0};
    fw_mark mark = fw_arena_mark(arena);
    for (int g = 0; g < l->groups && status == FW_OK; g++) {
        set_rate(l, g, duration);
        status =
            integrate_group(arena, &l->core[g], rtol, atol, y + (size_t)g * group_size(l), run);
        set_rate(l, g, NULL);
        fw_arena_rewind(arena, mark);
    }
    return status;
}
