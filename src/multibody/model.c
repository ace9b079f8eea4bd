/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From mechanism and active effects to the scaled arrays of fw_model. */
#include "multibody/build.h"
#include <math.h>

typedef struct builder {
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_terms *terms; /* NULL: no forces */
    fw_model *m;
    fw_vec2 centre; /* m: origin of the scaled coordinates */
} builder;

static int index_of(const fw_model *m, int body) {
    return body == FW_GROUND ? m->nbody : body;
}

/* local point in scaled units; those of the ground are seen from the centre */
static void set_local(const builder *b, int body, double x, double y, double *to) {
    bool ground = body == b->m->nbody;
    to[0] = (x - (ground ? b->centre.x : 0)) / b->m->scale.length_m;
    to[1] = (y - (ground ? b->centre.y : 0)) / b->m->scale.length_m;
}

/* positions are taken from the middle of the mechanism, so that far-away coordinates cost no digits
 */
static fw_vec2 middle(const fw_mechanism *m, const double *q) {
    fw_vec2 sum = {0, 0};
    for (int b = 0; b < m->nbody; b++)
        sum.x += q[3 * b], sum.y += q[3 * b + 1];
    return (fw_vec2){sum.x / m->nbody, sum.y / m->nbody};
}

static void set_bodies(const builder *b, const double *q) {
    fw_model *m = b->m;
    const fw_scale s = m->scale;
    for (int i = 0; i < m->nbody; i++) {
        const fw_mass *from = &b->mechanism->body[i];
        m->mass[i] = from->mass_kg / s.mass_kg;
        m->inertia[i] = from->inertia_kg_m2 / (s.mass_kg * s.length_m * s.length_m);
        m->minv[i] = 1 / m->mass[i];
        m->jinv[i] = 1 / m->inertia[i];
        m->origin[3 * i] = (q[3 * i] - b->centre.x) / s.length_m;
        m->origin[3 * i + 1] = (q[3 * i + 1] - b->centre.y) / s.length_m;
        m->origin[3 * i + 2] = q[3 * i + 2];
    }
    m->cosine[m->nbody] = 1;
}

/* ---- constraints ---- */

static double origin_turn(const fw_model *m, int a, int b) {
    return m->origin[3 * b + 2] - m->origin[3 * a + 2];
}

static bool released(const builder *b, int pin) {
    return b->terms && b->terms->released && b->terms->released[pin];
}

static void pin_blocks(const builder *b, fw_block *block, int *count) {
    for (int i = 0; i < b->mechanism->npin; i++) {
        const fw_pin *p = &b->mechanism->pin[i];
        b->m->pin_element[i] = FW_NONE;
        if (released(b, i)) { /* an element stands for it */
            b->m->pin_block[i] = FW_NONE;
            b->m->nreleased++;
            continue;
        }
        block[(*count)++] = (fw_block){.rows = FW_ROWS_PIN,
                                       .a = index_of(b->m, p->body_a),
                                       .b = index_of(b->m, p->body_b),
                                       .pin = i,
                                       .tie = FW_NONE,
                                       .driver = FW_NONE};
    }
}

/* of (ntie): 1 + index of the driver of each tie, the first where there are more; 0: none */
static fw_status drivers_of_ties(const builder *b, int **of) {
    const fw_mechanism *m = b->mechanism;
    FW_NEED(*of = fw_arena_array(b->arena, int, (size_t)m->ntie));
    for (int i = m->ndriver - 1; i >= 0; i--) {
        int tie = m->driver[i].tie;
        if (tie >= 0 && tie < m->ntie) (*of)[tie] = i + 1;
    }
    return FW_OK;
}

/* a rod with a driver is one row whose length follows the law; a weld is a pin and a turn */
static fw_status tie_blocks(const builder *b, fw_block *block, int *count) {
    const fw_model *m = b->m;
    int *driver_of;
    FW_TRY(drivers_of_ties(b, &driver_of));
    for (int i = 0; i < b->mechanism->ntie; i++) {
        const fw_tie *t = &b->mechanism->tie[i];
        fw_block k = {.a = index_of(m, t->body_a),
                      .b = index_of(m, t->body_b),
                      .pin = FW_NONE,
                      .tie = i,
                      .driver = FW_NONE};
        double turn = t->angle_rad - origin_turn(m, k.a, k.b);
        if (t->kind == FW_TIE_DISTANCE) {
            const fw_driver *driver = driver_of[i] ? &b->mechanism->driver[driver_of[i] - 1] : NULL;
            k.rows = FW_ROWS_ROD;
            k.value = driver ? 0 : t->length_m / m->scale.length_m;
            if (driver) {
                k.law = &driver->law, k.unit = m->scale.length_m;
                k.driver = driver_of[i] - 1;
            }
        } else if (t->kind == FW_TIE_PRISMATIC) {
            k.rows = FW_ROWS_SLIDE;
            k.cos_axis = cos(t->axis_rad), k.sin_axis = sin(t->axis_rad);
            k.value = turn;
        } else {
            k.rows = FW_ROWS_PIN;
            block[(*count)++] = k;
            k.rows = FW_ROWS_TURN;
            k.value = turn;
        }
        block[(*count)++] = k;
    }
    return FW_OK;
}

/* drivers of rods are in the rods' own blocks */
static void driver_blocks(const builder *b, fw_block *block, int *count) {
    const fw_model *m = b->m;
    for (int i = 0; i < b->mechanism->ndriver; i++) {
        const fw_driver *d = &b->mechanism->driver[i];
        fw_block k = {.law = &d->law, .pin = FW_NONE, .tie = FW_NONE, .driver = i};
        if (d->joint != FW_NONE) {
            const fw_pin *p = &b->mechanism->pin[d->joint];
            k.rows = FW_ROWS_TURN;
            k.a = index_of(m, p->body_a), k.b = index_of(m, p->body_b);
            k.value = p->free_angle_rad - origin_turn(m, k.a, k.b);
            k.unit = 1;
        } else {
            const fw_tie *t = &b->mechanism->tie[d->tie];
            if (t->kind == FW_TIE_DISTANCE) continue;
            k.rows = FW_ROWS_TRAVEL;
            k.a = index_of(m, t->body_a), k.b = index_of(m, t->body_b);
            k.cos_axis = cos(t->axis_rad), k.sin_axis = sin(t->axis_rad);
            k.value = t->free_length_m / m->scale.length_m;
            k.unit = m->scale.length_m;
        }
        block[(*count)++] = k;
    }
}

static const double *local_of(const builder *b, const fw_block *k, double local[4]) {
    const fw_mechanism *from = b->mechanism;
    int tie = k->tie;
    for (int i = 0; i < 4; i++)
        local[i] = 0;
    if (k->driver != FW_NONE && tie == FW_NONE) tie = from->driver[k->driver].tie;
    if (k->pin != FW_NONE) {
        const fw_pin *p = &from->pin[k->pin];
        set_local(b, k->a, p->ax_m, p->ay_m, local);
        set_local(b, k->b, p->bx_m, p->by_m, local + 2);
    } else if (tie != FW_NONE) {
        const fw_tie *t = &from->tie[tie];
        set_local(b, k->a, t->ax_m, t->ay_m, local);
        set_local(b, k->b, t->bx_m, t->by_m, local + 2);
    }
    return local;
}

/* blocks in the order of elimination, with what depends on it */
static fw_status set_blocks(builder *b) {
    fw_model *m = b->m;
    const fw_mechanism *from = b->mechanism;
    size_t most = (size_t)from->npin + 2 * (size_t)from->ntie + (size_t)from->ndriver;
    fw_block *block;
    int *order, *body, count = 0;
    FW_NEED(block = fw_arena_array(b->arena, fw_block, most));
    FW_NEED(order = fw_arena_array(b->arena, int, most));
    FW_NEED(body = fw_arena_array(b->arena, int, 2 * most));
    pin_blocks(b, block, &count);
    FW_TRY(tie_blocks(b, block, &count));
    driver_blocks(b, block, &count);
    for (int i = 0; i < count; i++)
        body[2 * i] = block[i].a, body[2 * i + 1] = block[i].b;
    FW_TRY(fw_topology_order(b->arena, count, body, m->nbody, order));
    FW_TRY(fw_model_block_arrays(b->arena, m, count));
    m->plain = count == from->npin - m->nreleased;
    for (int i = 0; i < count; i++) {
        fw_block *k = &m->block[i];
        double *local = m->local + 4 * i;
        *k = block[order[i]];
        m->body[2 * i] = k->a, m->body[2 * i + 1] = k->b;
        local_of(b, k, local);
        if (k->pin != FW_NONE) m->pin_block[k->pin] = i;
        if (k->tie != FW_NONE && k->rows != FW_ROWS_TURN) m->tie_block[k->tie] = i;
        if (k->driver != FW_NONE) m->driver_block[k->driver] = i;
        m->driven = m->driven || k->law;
        m->rows += k->rows == FW_ROWS_PIN || k->rows == FW_ROWS_SLIDE ? 2 : 1;
        const double *xa = m->origin + 3 * k->a, *xb = m->origin + 3 * k->b;
        double *offset = m->offset + 2 * i;
        offset[0] = xa[0] - xb[0], offset[1] = xa[1] - xb[1];
        m->size = fmax(m->size, hypot(offset[0], offset[1]) + hypot(local[0], local[1]) +
                                    hypot(local[2], local[3]));
    }
    return FW_OK;
}

/* ---- forces ---- */

static void set_turning(const builder *b) {
    fw_model *m = b->m;
    const fw_scale s = m->scale;
    double tt = s.time_s * s.time_s, turn = s.mass_kg * s.length_m * s.length_m;
    for (int i = 0; i < b->terms->ntorsion; i++) {
        const fw_torsion *t = &b->terms->torsion[i];
        int p = index_of(m, t->body_a), q = index_of(m, t->body_b);
        m->torsion[i] = (fw_model_torsion){p, q, t->stiffness_Nm_per_rad * tt / turn,
                                           t->damping_Nms_per_rad * s.time_s / turn,
                                           origin_turn(m, p, q) - t->free_angle_rad};
    }
    for (int i = 0; i < b->terms->nstop; i++) {
        const fw_stop *t = &b->terms->stop[i];
        int p = index_of(m, t->body_a), q = index_of(m, t->body_b);
        m->stop[i] = (fw_model_stop){.a = p,
                                     .b = q,
                                     .pin = t->pin,
                                     .side = t->side,
                                     .at = t->at_rad + t->free_angle_rad - origin_turn(m, p, q),
                                     .k = t->stiffness_Nm_per_rad * tt / turn,
                                     .c = t->damping_Nms_per_rad * s.time_s / turn};
    }
    m->ntorsion = b->terms->ntorsion;
    m->nstop = b->terms->nstop;
}

static void set_loads(const builder *b) {
    fw_model *m = b->m;
    const fw_scale s = m->scale;
    double force = s.time_s * s.time_s / (s.mass_kg * s.length_m); /* N to scaled */
    for (int i = 0; i < m->nbody; i++)
        for (int c = 0; c < 3; c++)
            m->constant[3 * i + c] = b->terms->constant[3 * i + c] * force *
                                     (c < 2 ? m->minv[i] : m->jinv[i] / s.length_m);
    for (int i = 0; i < b->terms->nload; i++) {
        const fw_point_load *l = &b->terms->load[i];
        m->load[i] = (fw_model_load){l->body, l->x_m / s.length_m, l->y_m / s.length_m,
                                     l->fx_N * force, l->fy_N * force};
    }
    for (int i = 0; i < b->terms->ntimed; i++) {
        const fw_timed_load *l = &b->terms->timed[i];
        m->timed[i] = (fw_model_timed){
            l->body,         l->x_m / s.length_m, l->y_m / s.length_m,
            l->fx_N * force, l->fy_N * force,     l->torque_Nm * force / s.length_m,
            l->law};
    }
    m->nload = b->terms->nload;
    m->ntimed = b->terms->ntimed;
}

static void set_springs(const builder *b) {
    fw_model *m = b->m;
    const fw_scale s = m->scale;
    double tt = s.time_s * s.time_s;
    for (int i = 0; i < b->terms->nspring; i++) {
        const fw_spring *p = &b->terms->spring[i];
        double local[4];
        int at = index_of(m, p->body_a), to = index_of(m, p->body_b);
        set_local(b, at, p->ax_m, p->ay_m, local);
        set_local(b, to, p->bx_m, p->by_m, local + 2);
        m->spring[i] = (fw_model_spring){at,
                                         to,
                                         local[0],
                                         local[1],
                                         local[2],
                                         local[3],
                                         p->stiffness_N_per_m * tt / s.mass_kg,
                                         p->damping_Ns_per_m * s.time_s / s.mass_kg,
                                         p->length_m / s.length_m,
                                         p->cable,
                                         !p->cable};
        m->ncable += p->cable;
    }
    for (int i = 0; i < b->terms->nslide; i++) {
        const fw_slide *p = &b->terms->slide[i];
        const fw_tie *t = &b->mechanism->tie[p->tie];
        int block = m->tie_block[p->tie];
        fw_model_slide *to = &m->slide[i];
        *to = (fw_model_slide){.a = m->block[block].a,
                               .b = m->block[block].b,
                               .block = block,
                               .k = p->stiffness_N_per_m * tt / s.mass_kg,
                               .c = p->damping_Ns_per_m * s.time_s / s.mass_kg,
                               .free = t->free_length_m / s.length_m};
    }
    m->nspring = b->terms->nspring;
    m->nslide = b->terms->nslide;
}

/* which quadratures the state carries */
static void set_books(fw_model *m, bool friction) {
    bool loses = friction;
    for (int i = 0; i < m->ntorsion; i++)
        loses = loses || m->torsion[i].c > 0;
    for (int i = 0; i < m->nspring; i++)
        loses = loses || m->spring[i].c > 0;
    for (int i = 0; i < m->nslide; i++)
        loses = loses || m->slide[i].c > 0;
    for (int i = 0; i < m->nstop; i++)
        loses = loses || m->stop[i].c > 0;
    bool driven = m->driven || m->ntimed > 0;
    for (int i = 0; i < m->nelement; i++) {
        loses = loses || m->element[i].own->dissipates;
        driven = driven || m->element[i].own->works;
    }
    m->ny = 2 * m->nq;
    m->dissipated = loses ? m->ny++ : -1;
    m->worked = driven ? m->ny++ : -1;
}

static fw_status set_terms(const builder *b) {
    fw_model *m = b->m;
    const fw_terms *t = b->terms;
    FW_NEED(m->torsion = fw_arena_array(b->arena, fw_model_torsion, (size_t)t->ntorsion));
    FW_NEED(m->stop = fw_arena_array(b->arena, fw_model_stop, (size_t)t->nstop));
    FW_NEED(m->load = fw_arena_array(b->arena, fw_model_load, (size_t)t->nload));
    FW_NEED(m->timed = fw_arena_array(b->arena, fw_model_timed, (size_t)t->ntimed));
    FW_NEED(m->slide = fw_arena_array(b->arena, fw_model_slide, (size_t)t->nslide));
    FW_NEED(m->spring = fw_arena_array(b->arena, fw_model_spring, (size_t)t->nspring));
    set_turning(b);
    set_loads(b);
    set_springs(b);
    m->special = t->nelement > 0 || m->nreleased > 0 || t->nfriction > 0 || t->stretch.law;
    return fw_model_elements_new(b->arena, m, t, b->centre);
}

/* the model in its own units: lengths of order 1 and masses of mean 1 bring the condition of the
   six-bar's equations from 1.5e14 (SI) to 2e2. Inputs SI, q (3 nbody) the pose that becomes u = 0.
   Cost O(bodies) for chains and rings. Test: test_constraints.c, test_simulate.c. */
fw_status fw_model_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_terms *terms,
                       const double *q, double duration_s, const fw_method *method, fw_diags *diags,
                       fw_model **model) {
    fw_model *m = fw_arena_one(arena, fw_model);
    FW_NEED(m);
    m->nbody = mechanism->nbody;
    m->npin = mechanism->npin, m->ntie = mechanism->ntie, m->ndriver = mechanism->ndriver;
    m->nq = 3 * m->nbody;
    m->projecting = true;
    m->epsilon = fw_epsilon;
    m->actuation = m->drive = m->actuation_rate = m->drive_rate = 1;
    m->held_s = -1;
    fw_model_scale(mechanism, terms, duration_s, &m->scale);
    FW_TRY(fw_model_body_arrays(arena, m));
    builder b = {arena, mechanism, terms, m, middle(mechanism, q)};
    set_bodies(&b, q);
    FW_TRY(set_blocks(&b));
    m->size = fmax(m->size, 1);
    if (terms) FW_TRY(set_terms(&b));
    if (terms && terms->stretch.law) FW_TRY(fw_stretch_new(arena, &terms->stretch, b.centre, m));
    set_books(m, terms && terms->nfriction > 0);
    FW_TRY(fw_friction_new(arena, mechanism, terms, m));
    FW_NEED(m->stage = fw_arena_array(arena, double, (size_t)m->ny));
    FW_TRY(fw_chain_compile(arena, m));
    m->method = method ? method : fw_method_find(NULL);
    if (m->method->prepare) FW_TRY(m->method->prepare(arena, m, mechanism, diags, &m->work));
    *model = m;
    return FW_OK;
}
