/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/verdict.h"
#include <math.h>
#include <string.h>

enum { ROUNDS = 12 };

/* a copy of the device whose flexures may be changed; everything else is shared */
static fw_device *copy_with_flexures(fw_arena *arena, const fw_device *device) {
    fw_device *copy = fw_arena_one(arena, fw_device);
    if (!copy) return NULL;
    *copy = *device;
    copy->flexure = fw_arena_grow(arena, device->flexure, (size_t)device->nflexure,
                                  (size_t)device->nflexure, sizeof *device->flexure);
    return copy->flexure ? copy : NULL;
}

static void set_length(fw_flexure *f, double length_m) {
    f->length_m = length_m;
    if (f->kind == FW_FLEXURE_CSFH) f->radius_m = length_m / f->angle_rad;
}

/* what the file gives (length, or radius times angle), rounded up to 1 um of that */
static double rounded_up(const fw_flexure *f, double length_m) {
    if (f->length_given || f->kind != FW_FLEXURE_CSFH) return ceil(length_m * 1e6 - 1e-6) * 1e-6;
    return ceil(length_m / f->angle_rad * 1e7 - 1e-6) * 1e-7 * f->angle_rad;
}

static fw_status try_lengths(fw_arena *arena, const fw_device *device,
                             const fw_verdict_options *options, const fw_verdict *verdict,
                             fw_verdict *out, bool *drawn) {
    fw_verdict_options quiet = *options;
    quiet.with_advice = false;
    fw_diags diags = fw_diags_new(arena);
    const fw_layout *layout;
    *out = (fw_verdict){.nvariant = verdict->nvariant};
    FW_NEED(out->variant = fw_arena_array(arena, fw_variant_verdict, (size_t)verdict->nvariant));
    for (int i = 0; i < verdict->nvariant; i++)
        out->variant[i].variant = verdict->variant[i].variant;
    FW_TRY(fw_verdict_run(arena, device, &quiet, &diags, out, &layout));
    *drawn = layout != NULL;
    return FW_OK;
}

/* strain per radian goes with 1/L: lengthen each failing flexure by its own utilisation until all
   accept. Stiffness follows the geometry where the file leaves it, hence the rounds. */
static int lengthen(fw_device *trial, const fw_verdict *now, bool *changed, double extra) {
    int failing = 0;
    for (int k = 0; k < now->nhinge; k++) {
        const fw_hinge_verdict *h = &now->hinge[k];
        if (h->decision == FW_ACCEPT) continue;
        int index = trial->joint[h->joint].flexure;
        fw_flexure *f = &trial->flexure[index];
        double grow = fmin(fmax(h->utilisation_high * extra, 1.0005), 3.0);
        set_length(f, rounded_up(f, f->length_m * grow));
        changed[index] = true;
        failing++;
    }
    return failing;
}

static fw_status write_line(fw_arena *arena, const fw_flexure *was, const fw_flexure *f,
                            fw_advice *advice) {
    char to[32], from[32], arc_to[32];
    bool radius = !f->length_given && f->kind == FW_FLEXURE_CSFH;
    double value = radius ? f->radius_m : f->length_m,
           before = radius ? was->radius_m : was->length_m;
    fw_number_text(to, sizeof to, value * 1e6, 6);
    fw_number_text(from, sizeof from, before * 1e6, 4);
    fw_number_text(arc_to, sizeof arc_to, f->length_m * 1e6, 4);
    advice->value = value;
    advice->value_text = fw_arena_printf(arena, "%s um", to);
    advice->set_path =
        fw_arena_printf(arena, "flexure[%s]/@%s", f->id, radius ? "radius" : "length");
    advice->text =
        radius ? fw_arena_printf(arena,
                                 "flexure %s: radius >= %s um (arc length >= %s um) accepts; now "
                                 "%s um",
                                 f->id, to, arc_to, from)
               : fw_arena_printf(arena, "flexure %s: %s length >= %s um accepts; now %s um", f->id,
                                 f->kind == FW_FLEXURE_CSFH ? "arc" : "leaf", to, from);
    FW_NEED(advice->value_text);
    FW_NEED(advice->set_path);
    FW_NEED(advice->text);
    return FW_OK;
}

fw_status fw_verdict_advise(fw_arena *arena, const fw_device *device,
                            const fw_verdict_options *options, fw_verdict *verdict) {
    for (int i = 0; i < verdict->nvariant; i++)
        if (verdict->variant[i].workspace.required && !verdict->variant[i].workspace.reachable) {
            verdict->advice_note = "part of the required workspace is out of reach: no flexure can "
                                   "change that; make the links longer or the workspace smaller";
            return FW_OK;
        }
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < device->nscene; k++)
            if (verdict->variant[i].motion[k] && verdict->variant[i].motion[k]->ended) {
                verdict->advice_note =
                    "a scene turns a joint by more than a whole turn: no flexure "
                    "can follow; lower its load";
                return FW_OK;
            }
    fw_device *trial = copy_with_flexures(arena, device);
    bool *changed = fw_arena_array(arena, bool, (size_t)device->nflexure + 1);
    FW_NEED(trial);
    FW_NEED(changed);
    fw_verdict now = *verdict;
    bool drawn = true;
    double extra = 1.0;
    for (int round = 0; round < ROUNDS && now.decision != FW_ACCEPT; round++) {
        if (lengthen(trial, &now, changed, extra) == 0) break;
        extra = round > 4 ? 1.02 : 1.0; /* creeping up on the limit: help it across */
        fw_status status = try_lengths(arena, trial, options, verdict, &now, &drawn);
        if (status == FW_NOMEM || status == FW_CANCELLED) return status;
        if (status != FW_OK) break;
    }
    verdict->advice_verified = now.decision == FW_ACCEPT;
    size_t most = (size_t)device->nflexure;
    FW_NEED(verdict->advice = fw_arena_array(arena, fw_advice, most));
    for (int i = 0; i < device->nflexure; i++)
        if (changed[i])
            FW_TRY(write_line(arena, &device->flexure[i], &trial->flexure[i],
                              &verdict->advice[verdict->nadvice++]));
    if (!verdict->advice_verified)
        verdict->advice_note = "longer flexures alone do not accept this design: lower the load or "
                               "the required workspace, or choose a stronger material";
    else if (!drawn)
        verdict->advice_note =
            "accepted by the mechanics, but these lengths do not fit the drawing: "
            "move the hinge points further apart as well";
    else
        verdict->advice_note = verdict->nadvice > 1 ? "all of these together were run and accepted"
                                                    : "this was run and accepted";
    return FW_OK;
}
