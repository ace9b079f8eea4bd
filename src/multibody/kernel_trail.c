/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Do the joints of a model form one path, and which? */
#include "multibody/kernel_plan.h"

static int other_pin(const int *pins_of, int body, int pin) {
    return pins_of[2 * body] == pin ? pins_of[2 * body + 1] : pins_of[2 * body];
}

/* follows the bodies from one end; false when that does not reach every pin and body once */
static bool follow(const fw_model *m, const int *pins_of, int start, int end, fw_trail *t) {
    int moving = end == m->nbody ? 0 : 1, pin = start, body = end;
    t->count = 0;
    t->body[0] = body;
    while (pin >= 0 && t->count < m->nblock) {
        body = m->body[2 * pin] == body ? m->body[2 * pin + 1] : m->body[2 * pin];
        t->pin[t->count++] = pin;
        t->body[t->count] = body;
        if (body == m->nbody) break;
        moving++;
        pin = other_pin(pins_of, body, pin);
    }
    return t->count == m->nblock && moving == m->nbody;
}

/* false: a body with three pins */
static bool two_pins_each(const fw_model *m, int *pins_of) {
    for (int i = 0; i < 2 * m->nbody; i++)
        pins_of[i] = -1;
    for (int i = 0; i < 2 * m->nblock; i++) {
        int b = m->body[i];
        if (b == m->nbody) continue;
        if (pins_of[2 * b + 1] >= 0) return false;
        pins_of[2 * b + (pins_of[2 * b] >= 0)] = i / 2;
    }
    return true;
}

static bool find(const fw_model *m, int *pins_of, fw_trail *t) {
    if (!two_pins_each(m, pins_of)) return false;
    for (int i = 0; i < 2 * m->nblock; i++) { /* from an end: the ground, or a body with one pin */
        int b = m->body[i];
        if (b == m->nbody || pins_of[2 * b + 1] < 0)
            return follow(m, pins_of, i / 2, b, t); /* one end reaches all, or none does */
    }
    return false;
}

/* every spring sits across one of the pins */
static bool place_torsions(const fw_model *m, const int *place, fw_trail *t) {
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_model_torsion *s = &m->torsion[i];
        int inner = s->a == m->nbody ? s->b : s->a, outer = s->a == m->nbody ? s->a : s->b, at = -1;
        if (inner == m->nbody) return false;
        for (int k = place[inner] - 1; k <= place[inner]; k++) /* the pins beside this body */
            if (k >= 0 && k < t->count && (t->body[k] == outer || t->body[k + 1] == outer)) at = k;
        if (at < 0) return false;
        t->torsion[i] = at;
    }
    return true;
}

fw_status fw_trail_find(fw_arena *arena, const fw_model *m, fw_trail *t, bool *found) {
    int *pins_of, *place;
    FW_NEED(pins_of = fw_arena_array(arena, int, 2 * (size_t)m->nbody));
    FW_NEED(place = fw_arena_array(arena, int, (size_t)m->nbody + 1));
    FW_NEED(t->pin = fw_arena_array(arena, int, (size_t)m->nblock));
    FW_NEED(t->body = fw_arena_array(arena, int, (size_t)m->nblock + 1));
    FW_NEED(t->torsion = fw_arena_array(arena, int, (size_t)m->ntorsion));
    *found = find(m, pins_of, t);
    if (!*found) return FW_OK;
    for (int i = 0; i <= t->count; i++)
        place[t->body[i]] = i;
    *found = place_torsions(m, place, t);
    return FW_OK;
}
