/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mechanism of pins (and of turns: drivers of pins, welds) as a sequence of bodies placed one
   after another, starting with the ground. Four steps exist:

   led    a body pinned to a placed body, its angle kept by a turn to a placed body
   dyad   two bodies pinned to each other, each to a placed body (class II Assur group)
   free   a body pinned to a placed body: its angle is an independent coordinate
   loose  a body that no pin holds to a placed one: all three coordinates are independent. Only
          where pins were released, and when nothing else can be placed

   Led bodies and dyads are forced moves: taking one never blocks another. Which body turns freely
   is a choice; depth-first search tries the bodies in the order of the file and takes back choices
   that leave a body with two pins to placed bodies. There are 3 bodies - rows free coordinates when
   the rows are independent, so a branch with more is not followed. Cost O(bodies) for each choice,
   and at most FW_TRIES choices. Source: Assur groups, e.g. Galletti, Mech. Mach. Theory 21 (1986)
   385-391; Kecskemethy, Krupp and Hiller, Multibody Syst. Dyn. 1 (1997). Test: test_minimal.c. */
#include "multibody/multibody_scratch.h"

enum { FW_TRIES = 5000 };

typedef struct links { /* blocks of each body: item[first[b] .. first[b + 1]) */
    int *first, *item;
} links;

typedef struct search {
    const fw_multibody_model *m;
    links links;
    fw_multibody_placing_plan *plan;
    bool *placed; /* (nbody + 1) */
    int *held;    /* (nbody) pins to placed bodies */
    int *queue;   /* bodies to look at */
    int queued;
    int dof, tries, used; /* used: blocks of the steps so far */
    int deepest, culprit; /* most steps reached, and the body that stopped it there */
} search;

static fw_status link_bodies(fw_arena *arena, const fw_multibody_model *m, links *l) {
    size_t bodies = (size_t)m->nbody + 1;
    FW_NEED(l->first = fw_arena_array(arena, int, bodies + 1));
    FW_NEED(l->item = fw_arena_array(arena, int, 2 * (size_t)m->nblock));
    int *fill;
    FW_NEED(fill = fw_arena_array(arena, int, bodies));
    for (int i = 0; i < 2 * m->nblock; i++)
        l->first[m->body[i] + 1]++;
    for (size_t b = 0; b < bodies; b++)
        l->first[b + 1] += l->first[b];
    for (int i = 0; i < 2 * m->nblock; i++)
        l->item[l->first[m->body[i]] + fill[m->body[i]]++] = i / 2;
    return FW_OK;
}

static bool is_pin(const fw_multibody_model *m, int block) {
    return m->block[block].rows == FW_ROWS_PIN;
}

/* a body's block of this kind to a placed body, or FW_NONE */
static int holding(const search *s, int body, fw_multibody_rows rows) {
    for (int i = s->links.first[body]; i < s->links.first[body + 1]; i++) {
        int block = s->links.item[i];
        if (s->m->block[block].rows == rows && s->placed[fw_multibody_across(s->m, block, body)])
            return block;
    }
    return FW_NONE;
}

static void enqueue(search *s, int body) { /* bounded: once per block and side of a placed body */
    if (body < s->m->nbody && !s->placed[body]) s->queue[s->queued++] = body;
}

static void mark_placed(search *s, int body, int change) {
    s->placed[body] = change > 0;
    for (int i = s->links.first[body]; i < s->links.first[body + 1]; i++) {
        int other = fw_multibody_across(s->m, s->links.item[i], body);
        if (other < s->m->nbody && is_pin(s->m, s->links.item[i])) s->held[other] += change;
    }
}

static int blocks_of(const fw_multibody_placing *step) {
    return step->dyad ? 3 : step->loose ? 0 : 1 + (step->turn != FW_NONE);
}

static void add_step(search *s, fw_multibody_placing step) {
    fw_multibody_placing_plan *plan = s->plan;
    for (int axis = step.loose ? 0 : 2; axis < 3 && step.rate != FW_NONE; axis++) {
        plan->rate_body[plan->rates] = step.body[0];
        plan->rate_axis[plan->rates++] = axis;
    }
    plan->step[plan->count++] = step;
    s->used += blocks_of(&step);
    for (int i = 0; i <= step.dyad; i++)
        mark_placed(s, step.body[i], 1);
    for (int k = 0; k <= step.dyad; k++)
        for (int i = s->links.first[step.body[k]]; i < s->links.first[step.body[k] + 1]; i++)
            enqueue(s, fw_multibody_across(s->m, s->links.item[i], step.body[k]));
}

static void take_back(search *s, int count) {
    fw_multibody_placing_plan *plan = s->plan;
    while (plan->count > count) {
        const fw_multibody_placing *step = &plan->step[--plan->count];
        if (step->rate != FW_NONE) plan->rates -= step->loose ? 3 : 1;
        s->used -= blocks_of(step);
        for (int i = 0; i <= step->dyad; i++)
            mark_placed(s, step->body[i], -1);
    }
}

static bool stopped(search *s, int body) {
    if (s->plan->count >= s->deepest) {
        s->deepest = s->plan->count;
        s->culprit = body;
    }
    return false;
}

/* the forced move at a body; false: it is held by two placed bodies, so nothing can be solved */
static bool look_at(search *s, int body) {
    const fw_multibody_model *m = s->m;
    if (s->placed[body] || s->held[body] == 0) return true;
    if (s->held[body] > 1) return stopped(s, body);
    int pin = holding(s, body, FW_ROWS_PIN), turn = holding(s, body, FW_ROWS_TURN);
    if (turn != FW_NONE) {
        add_step(s, (fw_multibody_placing){.body = {body, FW_NONE},
                                           .block = {pin, FW_NONE, FW_NONE},
                                           .turn = turn,
                                           .rate = FW_NONE});
        return true;
    }
    for (int i = s->links.first[body]; i < s->links.first[body + 1]; i++) {
        int block = s->links.item[i], other = fw_multibody_across(m, block, body);
        if (!is_pin(m, block) || other == m->nbody || s->placed[other] || s->held[other] != 1)
            continue;
        int end = holding(s, other, FW_ROWS_PIN);
        if (holding(s, other, FW_ROWS_TURN) != FW_NONE) continue; /* led, at its own turn */
        add_step(s, (fw_multibody_placing){.dyad = true,
                                           .body = {body, other},
                                           .block = {pin, block, end},
                                           .turn = FW_NONE,
                                           .rate = FW_NONE});
        return true;
    }
    return true;
}

static bool forced_moves(search *s) {
    while (s->queued > 0)
        if (!look_at(s, s->queue[--s->queued])) {
            s->queued = 0;
            return false;
        }
    return true;
}

/* that hangs on so many pins */
static int next_body(const search *s, int pins, int from) {
    for (int b = from; b < s->m->nbody; b++)
        if (!s->placed[b] && s->held[b] == pins) return b;
    return FW_NONE;
}

static bool complete(search *s) {
    if (s->used == s->m->nblock) return true;
    for (int b = 0; b < s->m->nbody; b++) /* a block between placed bodies that nothing needed */
        if (s->links.first[b + 1] > s->links.first[b]) return stopped(s, b);
    return false;
}

static bool find_rest(search *s) { /* depth: one level per body that moves by itself */
    if (!forced_moves(s)) return false;
    bool all = true;
    for (int b = 0; b < s->m->nbody && all; b++)
        if (!s->placed[b]) all = false;
    if (all) return complete(s);
    int pins = 1, first = next_body(s, 1, 0);
    if (first == FW_NONE && s->m->nreleased > 0) pins = 0, first = next_body(s, 0, 0);
    int rates = s->plan->rates + (pins ? 1 : 3);
    if (first == FW_NONE || rates > s->dof || rates > FW_MOST_RATES) {
        for (int b = 0; b < s->m->nbody; b++)
            if (!s->placed[b]) return stopped(s, b);
    }
    for (int b = first; b != FW_NONE && s->tries < FW_TRIES; b = next_body(s, pins, b + 1)) {
        int before = s->plan->count, pin = pins ? holding(s, b, FW_ROWS_PIN) : FW_NONE;
        s->tries++;
        add_step(s, (fw_multibody_placing){.body = {b, FW_NONE},
                                           .block = {pin, FW_NONE, FW_NONE},
                                           .turn = FW_NONE,
                                           .rate = s->plan->rates,
                                           .loose = !pins});
        if (find_rest(s)) return true;
        take_back(s, before);
    }
    return false;
}

static fw_status refuse(fw_diags *diags, fw_place place, const char *what, const char *id) {
    fw_status status = fw_diag_error(
        diags, 109, place,
        "method minimal needs pins whose loops close two bodies at a time: %s %s does "
        "not fit; use --method chain",
        what, id);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

static fw_status refuse_joint(const fw_mechanism *m, fw_diags *diags, const fw_multibody_block *b) {
    if (b->joint != FW_NONE)
        return refuse(diags, m->joint[b->joint].place, "joint", m->joint[b->joint].id);
    if (b->driver != FW_NONE)
        return refuse(diags, m->driver[b->driver].place, "driver", m->driver[b->driver].id);
    const fw_device *d = m->device;
    fw_place place = d && b->pin < d->nrevolute ? d->revolute[b->pin].place : (fw_place){0};
    return refuse(diags, place, "joint", m->pin[b->pin].id);
}

static fw_status refuse_body(const fw_mechanism *m, fw_diags *diags, int body) {
    const fw_device *d = m->device;
    fw_place place = d && body < d->nbody ? d->body[body].place : (fw_place){0};
    return refuse(diags, place, "body", m->body[body].id);
}

/* a joint that is no pin, or the second pin between two bodies, of those the one that comes later
   in the file; FW_NONE: all fit */
static int misfit(const search *s) {
    const fw_multibody_model *m = s->m;
    for (int i = 0; i < m->nblock; i++) {
        if (m->block[i].rows == FW_ROWS_TURN) continue;
        if (!is_pin(m, i)) return i;
        int a = m->body[2 * i], b = m->body[2 * i + 1];
        if (a == m->nbody) a = b, b = m->nbody; /* a body has few joints */
        for (int k = s->links.first[a]; k < s->links.first[a + 1]; k++) {
            int other = s->links.item[k];
            if (other != i && is_pin(m, other) && fw_multibody_across(m, other, a) == b)
                return m->block[other].pin > m->block[i].pin ? other : i;
        }
    }
    return FW_NONE;
}

fw_status fw_multibody_placing_find(fw_arena *arena, const fw_multibody_model *m,
                                    const fw_mechanism *mechanism, fw_diags *diags,
                                    fw_multibody_placing_plan *plan) {
    search s = {.m = m, .plan = plan, .dof = m->nq - m->rows};
    size_t bodies = (size_t)m->nbody + 1;
    *plan = (fw_multibody_placing_plan){0};
    FW_NEED(plan->step = fw_arena_array(arena, fw_multibody_placing, bodies));
    FW_NEED(plan->rate_body = fw_arena_array(arena, int, 3 * bodies));
    FW_NEED(plan->rate_axis = fw_arena_array(arena, int, 3 * bodies));
    FW_NEED(s.placed = fw_arena_array(arena, bool, bodies));
    FW_NEED(s.held = fw_arena_array(arena, int, bodies));
    FW_NEED(s.queue = fw_arena_array(arena, int, 2 * (size_t)m->nblock + bodies));
    FW_TRY(link_bodies(arena, m, &s.links));
    int block = misfit(&s);
    if (block != FW_NONE) return refuse_joint(mechanism, diags, &m->block[block]);
    mark_placed(&s, m->nbody, 1);
    for (int i = s.links.first[m->nbody]; i < s.links.first[m->nbody + 1]; i++)
        enqueue(&s, fw_multibody_across(m, s.links.item[i], m->nbody));
    if (find_rest(&s)) return FW_OK;
    return refuse_body(mechanism, diags, s.culprit);
}
