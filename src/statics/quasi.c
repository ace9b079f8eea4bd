/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/quasi.h"
#include "statics/level.h"
#include "statics/quasi_static.h"
#include <math.h>
#include <string.h>

/* the line of the ledger that says whether inertia acts; NULL in a build without it */
static fw_effect_entry *inertia_of(const fw_effect_ledger *ledger) {
    for (int i = 0; i < ledger->count; i++)
        if (strcmp(ledger->item[i].id, "inertia") == 0) return &ledger->item[i];
    return NULL;
}

static bool asked(const char *name, const char *usual) {
    return name && strcmp(name, usual) != 0;
}

/* what only an integration of the motion can follow */
static const char *integration_asked_for(const fw_dynamics_motion_options *o) {
    if (o->effects.mode != FW_EFFECTS_AUTO) return NULL; /* the effects were chosen by hand */
    if (asked(o->integrator, "auto")) return "an integrator was asked for: inertia acts";
    if (asked(o->method, "chain")) return "a method was asked for: inertia acts";
    if (asked(o->stabilise, "projection")) return "a stabilisation was asked for: inertia acts";
    return o->rtol > 0 ? "a tolerance was asked for: inertia acts" : NULL;
}

static void keep_inertia(fw_effect_ledger *ledger, fw_effects_loads *loads, const char *why) {
    fw_effect_entry *entry = inertia_of(ledger);
    loads->quasi_static = false;
    if (!entry) return;
    ledger->left_out = fmax(0, ledger->left_out - entry->bound);
    entry->active = true;
    entry->reason = why;
}

/* what a try that counts had to say */
static void take_messages(const fw_diags *from, fw_diags *diags) {
    for (size_t i = 0; i < from->count; i++) {
        const fw_diag *d = &from->item[i];
        if (d->severity == FW_ERROR)
            fw_diag_error(diags, d->number, d->place, "%s", d->message);
        else if (d->severity == FW_WARNING)
            fw_diag_warning(diags, d->number, d->place, "%s", d->message);
    }
}

/* effects chosen by hand: what that may have cost is said where it is more than was asked for */
static void report_cost(const fw_device_scene *scene, const fw_effect_ledger *ledger,
                        double accuracy, fw_diags *diags) {
    const fw_effect_entry *entry = inertia_of(ledger);
    char text[32];
    if (!entry || entry->bound < accuracy) return;
    fw_number_text(text, sizeof text, 100 * entry->bound, 2);
    fw_diag_warning(diags, 254, scene->place,
                    "scene %s is computed as a quasi-static sequence of equilibria, because "
                    "--effects excludes inertia: deflections may be wrong by %s%s",
                    scene->name ? scene->name : "(unnamed)",
                    isinf(entry->bound) ? "an amount that is not bounded" : text,
                    isinf(entry->bound) ? "; use --effects all or auto to include it" : " %");
}

static fw_status move(fw_arena *arena, const fw_mechanism *mechanism, const fw_device_scene *scene,
                      const fw_dynamics_motion_options *options, fw_diags *diags,
                      const fw_dynamics_motion **motion) {
    fw_effects_loads loads;
    fw_effect_ledger ledger;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags, &ledger,
                              &loads));
    if (loads.quasi_static) {
        const char *why = integration_asked_for(options);
        if (!why) {
            fw_diags own = fw_diags_new(arena);
            fw_status status = fw_statics_quasi_static_motion(arena, mechanism, scene, options,
                                                              &ledger, &loads, &own, motion, &why);
            if (status != FW_SOLVER) {
                take_messages(&own, diags);
                if (status == FW_OK && options->effects.mode != FW_EFFECTS_AUTO)
                    report_cost(scene, &ledger, accuracy, diags);
                return diags->failed ? FW_NOMEM : status;
            }
            if (options->effects.mode != FW_EFFECTS_AUTO)
                fw_diag_warning(diags, 254, scene->place,
                                "scene %s was computed with inertia, although --effects "
                                "excludes it: %s",
                                scene->name ? scene->name : "(unnamed)", why);
        }
        keep_inertia(&ledger, &loads, why);
    }
    return fw_dynamics_simulate_compiled(arena, mechanism, scene, options, &ledger, &loads, diags,
                                         motion);
}

static bool beyond_limits(const fw_mechanism *m, const fw_dynamics_motion *x) {
    for (int k = 0; k < m->nhinge; k++)
        if (fabs(x->peak[m->hinge[k].pin].angle_rad) > m->hinge[k].closed_form.limit_angle_rad)
            return true;
    return false;
}

static fw_status with_level(fw_arena *arena, const fw_dynamics_motion *found,
                            const fw_statics_level_step *step, double accuracy,
                            const fw_effect_choice *asked, const fw_dynamics_motion **motion) {
    fw_dynamics_motion *own = fw_arena_one(arena, fw_dynamics_motion);
    FW_NEED(own);
    *own = *found;
    own->level = step;
    FW_TRY(fw_statics_level_note(arena, step, accuracy, asked, &own->ledger.hinge));
    *motion = own;
    return FW_OK;
}

/* the next level failed: the motion that is there counts, and who looks on sees it again */
static fw_status stay(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                      const fw_dynamics_motion_options *options,
                      const fw_dynamics_motion **motion) {
    fw_dynamics_motion *own = fw_arena_one(arena, fw_dynamics_motion);
    fw_dynamics_motion_options o = *options;
    const fw_dynamics_motion *again;
    FW_NEED(own);
    *own = **motion;
    FW_TRY(fw_statics_level_stays(arena, own->level, "the scene could not be followed with it",
                                  &own->ledger.hinge));
    *motion = own;
    if (!options->observe) return FW_OK;
    fw_diags quiet = fw_diags_new(arena);
    o.effects.hinge = own->ledger.hinge.used;
    return move(arena, m, scene, &o, &quiet, &again);
}

/* exact beams cost some 10 us each: not by itself where there would be very many */
static fw_status too_many_beams(fw_arena *arena, const fw_mechanism *m,
                                const fw_dynamics_motion_options *options,
                                const fw_statics_level_step *step,
                                const fw_dynamics_motion **motion, bool *too_many) {
    double beams = (double)(*motion)->stats.rhs * m->nhinge;
    *too_many = options->most_beams > 0 && step->next == FW_HINGE_ELASTICA &&
                beams > (double)options->most_beams;
    if (!*too_many) return FW_OK;
    fw_dynamics_motion *own = fw_arena_one(arena, fw_dynamics_motion);
    FW_NEED(own);
    *own = **motion;
    *motion = own;
    const char *why = fw_arena_printf(
        arena, "would take some %.0e exact beams: request it with --hinge-model elastica", beams);
    FW_NEED(why);
    return fw_statics_level_stays(arena, step, why, &own->ledger.hinge);
}

/* with the hinges as they were asked for; auto climbs where the step to the next level is computed
   to change more than the accuracy wanted, and stays where that level has no such motion */
fw_status fw_statics_move_scene(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_scene *scene,
                                const fw_dynamics_motion_options *options, fw_diags *diags,
                                const fw_dynamics_motion **motion) {
    fw_dynamics_motion_options o = *options;
    const fw_effect_choice *asked = &options->effects;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    if (options->hinge_accuracy > 0) accuracy = options->hinge_accuracy;
    *motion = NULL;
    FW_TRY(fw_dynamics_check_request(mechanism, scene, options, diags));
    for (;;) {
        const fw_dynamics_motion *found;
        const fw_statics_level_step *step;
        fw_diags own = fw_diags_new(arena);
        bool higher = *motion != NULL;
        fw_status status = move(arena, mechanism, scene, &o, higher ? &own : diags, &found);
        if (higher && status == FW_SOLVER) return stay(arena, mechanism, scene, options, motion);
        FW_TRY(status);
        if (higher) take_messages(&own, diags);
        FW_TRY(fw_statics_level_of_motion(arena, mechanism, scene, found, &step));
        FW_TRY(with_level(arena, found, step, accuracy, asked, motion));
        if (options->within_limits && beyond_limits(mechanism, found)) return FW_OK;
        if (!fw_statics_level_climb(step, accuracy, asked, &o.effects)) return FW_OK;
        bool too_many;
        FW_TRY(too_many_beams(arena, mechanism, options, step, motion, &too_many));
        if (too_many) return FW_OK;
    }
}
