/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which effects the envelope takes in: those that add forces, springs, dampers, elements that
   act on both sides, and free strains. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include <math.h>
#include <string.h>

typedef struct search {
    const fw_effect_case *c;
    const fw_effect_row *const *row; /* (rows) */
    size_t rows;
    bool *taken; /* (rows) */
    bool *loose; /* (ntendon) drawn tendons that may go slack: not in the envelope */
} search;

static bool linear(const fw_effects_loads *t) {
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].switches > 0) return false;
    return t->nstop == 0 && t->nfriction == 0 && !t->quasi_static;
}

/* does its `add` stay within what linear theory takes in? */
static fw_status can_take(const fw_effect_case *c, const fw_effect_row *row, bool *taken) {
    fw_effects_loads scratch;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_TRY(fw_effects_loads_new(c->arena, c->mechanism, c->scene, &scratch));
    fw_status status = row->add(c, &scratch); /* it says no when it is compiled */
    if (status == FW_NOMEM) return status;
    *taken = status == FW_OK && linear(&scratch);
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

/* Tendons that stay taut, and those that are pulled, need no switch; loose ones go */
static void hold_tendons(const search *s, fw_effects_loads *loads) {
    int kept = 0, tendon = 0;
    for (int i = 0; i < loads->nelement; i++) {
        fw_effects_force_element *e = &loads->element[i];
        bool is = strcmp(e->class_->effect, "tendon") == 0;
        if (is) e->switches = 0;
        if (is && s->loose[tendon++]) continue;
        loads->element[kept++] = *e;
    }
    loads->nelement = kept;
}

static fw_status add_taken(const search *s, fw_effects_loads *loads) {
    const fw_effect_case *c = s->c;
    const bool *taken = s->taken;
    FW_TRY(fw_effects_loads_new(c->arena, c->mechanism, c->scene, loads));
    for (size_t i = 0; i < s->rows; i++)
        if (taken[i]) FW_TRY(s->row[i]->add(c, loads));
    hold_tendons(s, loads);
    return FW_OK;
}

/* Where flexures are to act as they are there are two of them: with the hinges as linear springs
   about the drawn pose, which all bounds go by, and with pins in their place, against which
   nonlinear-hinge is measured. */
static fw_status with_hinges(const search *s, int hinges, fw_effects_envelope *envelope) {
    const fw_effect_case *c = s->c;
    bool *taken = s->taken;
    fw_effects_loads *loads;
    fw_effects_envelope *pinned;
    FW_NEED(loads = fw_arena_one(c->arena, fw_effects_loads));
    FW_NEED(pinned = fw_arena_one(c->arena, fw_effects_envelope));
    *pinned = *envelope;
    taken[hinges] = true;
    FW_TRY(add_taken(s, loads));
    if (loads->strained || loads->stretch.law) { /* what strains do to hinges that give: unknown */
        taken[hinges] = false;
        return FW_OK;
    }
    FW_TRY(fw_effects_envelope_of(c->arena, c->mechanism, c->scene, loads, envelope));
    envelope->pinned = pinned;
    return FW_OK;
}

/* with everything that `taken` says, and the tendons that are not loose */
static fw_status find_all(const search *s, int hinges, fw_effects_envelope *envelope) {
    fw_effects_loads *loads;
    FW_NEED(loads = fw_arena_one(s->c->arena, fw_effects_loads));
    FW_TRY(add_taken(s, loads));
    FW_TRY(fw_effects_envelope_of(s->c->arena, s->c->mechanism, s->c->scene, loads, envelope));
    if (hinges != FW_NONE) FW_TRY(with_hinges(s, hinges, envelope));
    return FW_OK;
}

/* any tendon more, with hinges that give or with pins */
static bool slackens(const search *s, const fw_effects_envelope *e) {
    bool more = fw_effects_tendons_loosen(s->c, e, s->loose);
    if (e->pinned) more = fw_effects_tendons_loosen(s->c, e->pinned, s->loose) || more;
    return more;
}

/* Tendons are taut until the envelope does not say so, fewer every time; what it does not have
   besides could slacken any of them. */
static fw_status settle_tendons(const search *s, int hinges, bool alone,
                                fw_effects_envelope *envelope) {
    const fw_effect_case *c = s->c;
    bool any = false;
    for (int i = 0; i < c->scene->ntendon; i++)
        any = any || isnan(c->scene->tendon[i].pull_N);
    if (!any) return FW_OK;
    bool loose = false;
    while (alone && slackens(s, envelope)) {
        loose = true;
        if (hinges != FW_NONE) s->taken[hinges] = false;
        FW_TRY(find_all(s, hinges, envelope));
    }
    if (!alone) {
        envelope->valid = false;
        envelope->why_not = "cables may go slack by what the envelope does not have";
    }
    if (!loose) return FW_OK;
    for (size_t i = 0; i < s->rows; i++)
        if (strcmp(s->row[i]->id, "tendon") == 0) s->taken[i] = false;
    if (!envelope->valid) return FW_OK;
    const fw_effects_loads *t = envelope->modal->loads;
    if (t->strained || t->stretch.law) { /* what strains do to the cable is in no bound */
        envelope->valid = false;
        envelope->why_not = "strains move the ends of cables that may go slack";
        return FW_OK;
    }
    FW_TRY(fw_effects_tendons_pull(c, envelope, s->loose, &envelope->loose_pull));
    if (!envelope->pinned) return FW_OK;
    double pinned;
    FW_TRY(fw_effects_tendons_pull(c, envelope->pinned, s->loose, &pinned));
    pinned *= envelope->pinned->floor / envelope->floor;
    envelope->loose_pull = fmax(envelope->loose_pull, pinned);
    return FW_OK;
}

fw_status fw_effects_envelope_of_rows(fw_arena *arena, const fw_mechanism *mechanism,
                                      const fw_device_scene *scene, const fw_effect_row *const *row,
                                      size_t count, fw_effects_envelope *envelope) {
    fw_effects_envelope first = {.why_not = "not computed yet"};
    fw_diags quiet =
        fw_diags_new(arena); /* what an effect objects to is said when it is compiled */
    const fw_effect_case c = {arena, mechanism, scene, &first, &quiet};
    search s = {.c = &c, .row = row, .rows = count};
    fw_effects_loads all;
    bool more = false, alone = true;
    int hinges = FW_NONE;
    FW_NEED(s.taken = fw_arena_array(arena, bool, count));
    FW_NEED(s.loose = fw_arena_array(arena, bool, (size_t)scene->ntendon));
    for (size_t i = 0; i < count; i++)
        s.taken[i] = row[i]->kept && row[i]->called_for(&c);
    FW_TRY(add_taken(&s, &all));
    FW_TRY(fw_effects_envelope_of(arena, mechanism, scene, &all, &first));
    for (size_t i = 0; i < count; i++)
        if (!row[i]->kept && row[i]->called_for(&c)) {
            FW_TRY(can_take(&c, row[i], &s.taken[i]));
            alone = alone && s.taken[i];
            if (s.taken[i] && strcmp(row[i]->id, "nonlinear-hinge") == 0)
                hinges = (int)i, s.taken[i] = false;
            more = more || s.taken[i];
        }
    *envelope = first;
    if (more || hinges != FW_NONE) FW_TRY(find_all(&s, hinges, envelope));
    FW_TRY(settle_tendons(&s, hinges, alone, envelope));
    envelope->taken = s.taken;
    return FW_OK;
}
