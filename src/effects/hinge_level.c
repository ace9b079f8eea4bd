/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The levels at which hinges can be taken, and the way from one to the next. Theory:
   docs/theory/hinge-models.md. */
#include "effects/hinge_level.h"
#include "effects/hinge_element.h"
#include <math.h>
#include <string.h>

/* measured like the rows' costs: a solution of the beam, for force or tangent */
static const double exact_cost = 21000;

static const struct {
    const char *name, *summary;
    fw_effects_hinge_model below; /* the level that auto tries before it */
} models[] = {
    [FW_HINGE_AUTO] = {"auto", "the cheapest whose error is below the accuracy", FW_HINGE_AUTO},
    [FW_HINGE_REVOLUTE] = {"revolute", "pins at the elastic centres", FW_HINGE_REVOLUTE},
    [FW_HINGE_COMPLIANCE] = {"compliance", "closed form that gives and drifts", FW_HINGE_REVOLUTE},
    [FW_HINGE_ELASTICA] = {"elastica", "geometrically exact beams", FW_HINGE_COMPLIANCE},
};

size_t fw_effects_hinge_model_count(void) {
    return sizeof models / sizeof models[0];
}

const char *fw_effects_hinge_model_text(fw_effects_hinge_model model) {
    return models[model].name;
}

const char *fw_effects_hinge_model_summary(fw_effects_hinge_model model) {
    return models[model].summary;
}

static int could(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->nhinge; i++)
        n += fw_effects_hinge_flexes(c, i);
    return n;
}

bool fw_effects_hinge_forced(const char *effect, fw_effects_hinge_model asked, bool *in) {
    if (asked == FW_HINGE_AUTO || strcmp(effect, "nonlinear-hinge") != 0) return false;
    *in = asked != FW_HINGE_REVOLUTE;
    return true;
}

const char *fw_effects_hinge_forced_reason(const fw_effect_choice *choice) {
    if (choice->hinge == FW_HINGE_REVOLUTE)
        return "ideal pins in place of the hinges were asked for (--hinge-model revolute)";
    if (choice->below > 0)
        return choice->hinge == FW_HINGE_ELASTICA
                   ? "called for, as exact beams: the closed form was found to be off by more than "
                     "the accuracy wanted"
                   : "called for: pins were found to be off by more than the accuracy wanted";
    return choice->hinge == FW_HINGE_ELASTICA
               ? "called for, and hinges as exact beams were asked for (--hinge-model elastica)"
               : "called for, and hinges that give were asked for (--hinge-model compliance)";
}

static fw_status why_climbed(const fw_effect_case *c, const fw_effect_choice *choice,
                             const char **why) {
    char by[32];
    fw_percent_text(by, sizeof by, choice->below);
    FW_NEED(*why = fw_arena_printf(
                c->arena,
                "%s was computed to be off by %s %% of the largest hinge angle, not "
                "below the accuracy wanted",
                models[models[choice->hinge].below].name, by));
    return FW_OK;
}

static const char *why_used(const fw_effect_entry *entry, const fw_effect_choice *choice,
                            fw_effects_hinge_model used, bool touching) {
    fw_effects_hinge_model asked = choice->hinge;
    if (asked == used) return "asked for";
    if (!entry || !entry->called_for) return "no flexure has a law of its own";
    if (asked != FW_HINGE_AUTO)
        return touching ? "pins were asked for, but surfaces that may touch need hinges that give"
                        : "another was asked for, which no hinge here can be";
    if (choice->mode != FW_EFFECTS_AUTO)
        return used == FW_HINGE_REVOLUTE ? "nonlinear-hinge is not among the effects asked for"
                                         : "nothing is left out";
    return used == FW_HINGE_REVOLUTE
               ? "what hinges do besides turning is bounded below the accuracy wanted"
               : "nothing bounds what hinges do besides turning below the accuracy wanted";
}

/* stated stiffness: the hinge stays what its file says, at every level */
static fw_status report_stated(const fw_effect_case *c, const char **why) {
    const fw_mechanism *m = c->mechanism;
    fw_text names = fw_text_new(c->arena);
    int count = 0;
    for (int i = 0; i < m->nhinge; i++)
        if (!fw_effects_hinge_flexes(c, i))
            fw_text_printf(&names, "%s%s", count++ ? ", " : "", m->pin[m->hinge[i].pin].id);
    if (count == 0) return FW_OK;
    FW_TRY(fw_text_end(&names));
    FW_NEED(*why = fw_arena_printf(c->arena,
                                   "%s; %s %s: the file states the stiffness, or the axis is not "
                                   "known",
                                   *why, names.data, count > 1 ? "stay pins" : "stays a pin"));
    return FW_OK;
}

fw_status fw_effects_hinge_settle(const fw_effect_case *c, const fw_effect_choice *choice,
                                  fw_effect_ledger *ledger, fw_effects_loads *loads) {
    const fw_effects_hinge_model asked = choice->hinge;
    fw_effect_entry *entry = NULL;
    bool touching = false;
    for (int i = 0; i < ledger->count; i++) {
        if (strcmp(ledger->item[i].id, "nonlinear-hinge") == 0) entry = &ledger->item[i];
        if (strcmp(ledger->item[i].id, "contact") == 0) touching = ledger->item[i].active;
    }
    bool gives = loads->nreleased > 0 && (!entry || entry->active || touching);
    ledger->hinge = (fw_effects_hinge_use){.used = FW_HINGE_REVOLUTE, .error = (double)NAN};
    if (c->mechanism->nhinge == 0) return FW_OK;
    if (gives)
        ledger->hinge.used = asked == FW_HINGE_ELASTICA ? FW_HINGE_ELASTICA : FW_HINGE_COMPLIANCE;
    ledger->hinge.why = why_used(entry, choice, ledger->hinge.used, touching);
    if (choice->below > 0 && asked == ledger->hinge.used)
        FW_TRY(why_climbed(c, choice, &ledger->hinge.why));
    FW_TRY(report_stated(c, &ledger->hinge.why));
    if (ledger->hinge.used != FW_HINGE_ELASTICA) return FW_OK;
    ledger->hinge.error = fw_effects_exact_tolerance;
    if (entry) entry->cost = exact_cost * could(c);
    return fw_effects_hinges_exact(c->arena, c->mechanism, loads);
}

/* ---- one level up ---- */

static bool any_exact(const fw_effects_loads *from, const fw_effects_loads *to) {
    for (int i = 0; i < from->nelement; i++)
        if (from->element[i].class_ != to->element[i].class_) return true;
    return false;
}

/* arrays that releasing a hinge writes to become the copy's own */
static fw_status own_arrays(fw_arena *arena, const fw_mechanism *m, fw_effects_loads *loads) {
    size_t pins = (size_t)m->npin, elements = (size_t)loads->nelement;
    fw_effects_torsion *torsion;
    bool *released;
    fw_effects_force_element *element;
    FW_NEED(torsion = fw_arena_array(arena, fw_effects_torsion, pins));
    FW_NEED(released = fw_arena_array(arena, bool, pins));
    FW_NEED(element = fw_arena_array(arena, fw_effects_force_element, 2 * elements + 1));
    if (loads->ntorsion > 0)
        memcpy(torsion, loads->torsion, (size_t)loads->ntorsion * sizeof *torsion);
    if (pins > 0) memcpy(released, loads->released, pins * sizeof *released);
    if (elements > 0) memcpy(element, loads->element, elements * sizeof *element);
    loads->torsion = torsion;
    loads->released = released;
    loads->element = element;
    return FW_OK;
}

fw_status fw_effects_hinges_up(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, const fw_effects_loads *loads,
                               fw_effects_hinge_model used, fw_effects_loads *up,
                               fw_effects_hinge_model *next) {
    const fw_effect_case c = {.arena = arena, .mechanism = mechanism, .scene = scene};
    *up = *loads;
    *next = used;
    if (used == FW_HINGE_REVOLUTE) {
        FW_TRY(own_arrays(arena, mechanism, up));
        FW_TRY(fw_effects_hinges_flex(&c, up));
        if (up->nreleased > loads->nreleased) *next = FW_HINGE_COMPLIANCE;
    } else if (used == FW_HINGE_COMPLIANCE) {
        FW_TRY(fw_effects_hinges_exact(arena, mechanism, up));
        if (any_exact(loads, up)) *next = FW_HINGE_ELASTICA;
    }
    return FW_OK;
}
