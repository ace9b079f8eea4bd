/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which effects the envelope takes in: those whose terms are loads, springs, dampers, elements that
   act on both sides, and free strains. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <string.h>

static bool linear(const fw_terms *t) {
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].switches > 0) return false;
    return t->nstop == 0 && t->nfriction == 0 && !t->quasi_static;
}

/* does its `add` stay within what linear theory takes in? */
static fw_status can_take(const fw_effect_case *c, const fw_effect_row *row, bool *taken) {
    fw_terms scratch;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_TRY(fw_terms_new(c->arena, c->mechanism, c->scene, &scratch));
    fw_status status = row->add(c, &scratch); /* it says no when it is compiled */
    if (status == FW_NOMEM) return status;
    *taken = status == FW_OK && linear(&scratch);
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

static fw_status add_taken(const fw_effect_case *c, const bool *taken, fw_terms *terms) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    FW_TRY(fw_terms_new(c->arena, c->mechanism, c->scene, terms));
    for (size_t i = 0; i < count; i++)
        if (taken[i]) FW_TRY(row[i]->add(c, terms));
    return FW_OK;
}

/* Where flexures are to act as they are there are two of them: with the hinges as linear springs
   about the drawn pose, which all bounds go by, and with pins in their place, against which
   nonlinear-hinge is measured. */
static fw_status with_hinges(const fw_effect_case *c, bool *taken, int hinges,
                             fw_envelope *envelope) {
    fw_terms *terms;
    fw_envelope *pinned;
    FW_NEED(terms = fw_arena_one(c->arena, fw_terms));
    FW_NEED(pinned = fw_arena_one(c->arena, fw_envelope));
    *pinned = *envelope;
    taken[hinges] = true;
    FW_TRY(add_taken(c, taken, terms));
    if (terms->strained || terms->stretch.law) { /* what strains do to hinges that give: unknown */
        taken[hinges] = false;
        return FW_OK;
    }
    FW_TRY(fw_envelope_of(c->arena, c->mechanism, c->scene, terms, envelope));
    envelope->pinned = pinned;
    return FW_OK;
}

fw_status fw_envelope_find(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                           fw_envelope *envelope) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    fw_envelope first = {.why_not = "not computed yet"};
    fw_diags quiet =
        fw_diags_new(arena); /* what an effect objects to is said when it is compiled */
    const fw_effect_case c = {arena, mechanism, scene, &first, &quiet};
    fw_terms *terms, all;
    bool *taken, more = false;
    int hinges = FW_NONE;
    FW_NEED(taken = fw_arena_array(arena, bool, count));
    FW_NEED(terms = fw_arena_one(arena, fw_terms));
    for (size_t i = 0; i < count; i++)
        taken[i] = row[i]->kept && row[i]->called_for(&c);
    FW_TRY(add_taken(&c, taken, &all));
    FW_TRY(fw_envelope_of(arena, mechanism, scene, &all, &first));
    for (size_t i = 0; i < count; i++)
        if (!row[i]->kept && row[i]->called_for(&c)) {
            FW_TRY(can_take(&c, row[i], &taken[i]));
            if (taken[i] && strcmp(row[i]->id, "nonlinear-hinge") == 0)
                hinges = (int)i, taken[i] = false;
            more = more || taken[i];
        }
    *envelope = first;
    if (more) {
        FW_TRY(add_taken(&c, taken, terms));
        FW_TRY(fw_envelope_of(arena, mechanism, scene, terms, envelope));
    }
    if (hinges != FW_NONE) FW_TRY(with_hinges(&c, taken, hinges, envelope));
    envelope->taken = taken;
    return FW_OK;
}
