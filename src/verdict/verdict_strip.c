/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures that bend onto their own two bodies: what turned and strained each most, in all scenes and
   required poses, bounds where its strip can be (clearance/clearance_strip.c). What a flow makes of
   walls and widths is allowed for and not run again at every corner. Test: tests/clearance/cases.py */
#include "base/constants.h"
#include "base/text.h"
#include "clearance/clearance.h"
#include "verdict/strain.h"
#include "verdict/verdict_clearance.h"
#include "verdict/verdict_parts.h"
#include <math.h>

/* of rotation and curvature, and on either wall: more than corners differ by from the drawn device */
static const double fw_made_share = 0.1, fw_made_m = 1e-6;

typedef struct seen {            /* most of a hinge */
    double turn, strain, forced; /* forced: HUGE_VAL where it is not known apart */
} seen;

static seen most_of_scenes(const fw_verdict_variant_verdict *v, int k) {
    const fw_mechanism *m = v->mechanism;
    const int pin = m->hinge[k].pin;
    seen most = {0, 0, 0};
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_dynamics_motion *motion = v->motion[i];
        if (!motion || !motion->observed) continue;
        const fw_verdict_strain_monitor *saw = motion->observed;
        double off = fw_verdict_motion_model_error(m, motion);
        const fw_dynamics_peak *peak = &motion->peak[pin];
        double error = isfinite(peak->error_rad) ? peak->error_rad : 0;
        most.turn = fmax(most.turn, fabs(peak->angle_rad) * (1 + off) + error);
        most.strain = fmax(most.strain, saw->hinge[k].strain * (1 + off));
        most.forced = fmax(most.forced, saw->hinge[k].forced + off * saw->hinge[k].strain);
    }
    return most;
}

static seen most_of_boxes(const fw_verdict_variant_verdict *v, int k) {
    const fw_mechanism_hinge *hinge = &v->mechanism->hinge[k];
    seen most = {0, 0, HUGE_VAL};
    if (!v->workspace.required || !v->workspace.reachable || hinge->pin >= FW_SIX) return most;
    const fw_workspace_peak *peak = &v->workspace.peak[hinge->pin];
    const fw_workspace_load *load = &v->workspace.load[hinge->pin];
    most.turn = fabs(peak->angle_rad) + peak->error_rad;
    most.strain = most.turn * hinge->closed_form.strain_per_rad;
    if (load->known) most.strain = fmax(most.strain, load->strain);
    return most;
}

/* Of the strip itself: what its roots have more is the fillets'; under rotation alone its curvature is
   even, forces may bend it most between the roots. Of required poses forces are not known apart: there
   curvature of either sign along the whole strip is allowed for. Between the instants that were looked
   at forces are taken to add a tenth more; their other sign is at most twice as large, and equal in a
   straight strip, where a fifth more is for what its own bending adds to the lever. */
static fw_clearance_bend bend_of(const fw_verdict_variant_verdict *v, int k, const seen *most) {
    const double between = 1.1, other_sign = 2, lever = 1.2;
    const fw_mechanism_hinge *hinge = &v->mechanism->hinge[k];
    fw_clearance_bend b = fw_clearance_bend_of(v->mechanism, hinge);
    double made = (1 + fw_made_share) * (1 + fw_verdict_model_error.strain);
    const fw_flexure_result *c = &hinge->closed_form;
    const double per = made * b.curvature_per_m / b.strain,
                 at_root = per / fmax(1, c->concentration), inside = per / fmax(1, c->fibre);
    const double turned = fmin(most->turn * c->strain_per_rad, most->strain);
    b.turn_rad = (1 + fw_made_share) * most->turn;
    b.strain = made * most->strain;
    b.curvature_per_m = isfinite(most->forced)
                            ? fmin(inside * most->strain, at_root * turned + inside * most->forced)
                            : at_root * most->strain;
    b.forced_per_m = (b.straight ? lever : other_sign) * between * inside * most->forced;
    return b;
}

static const fw_layout_piece *piece_of(const fw_layout *layout, int joint) {
    for (int i = 0; i < layout->npiece; i++)
        if (layout->piece[i].role == FW_ROLE_FLEXURE && layout->piece[i].joint == joint)
            return &layout->piece[i];
    return NULL;
}

static fw_status say(fw_arena *arena, const fw_layout_piece *piece, const fw_clearance_edge *met,
                     double turn_rad, fw_verdict_variant_verdict *v) {
    char turn[32];
    const char *text;
    FW_NEED(
        text = fw_arena_printf(
            arena,
            "the %s may come to %s, its own root or ring, within the %s deg that it turns by, "
            "margins included: its bent strip is not proved to keep off; use a longer flexure, a "
            "smaller subtended angle or a smaller load",
            piece->label, met->label ? met->label : "its body",
            fw_number_text(turn, sizeof turn, FW_DEG_PER_RAD * turn_rad, 3)));
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = NULL,
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = 295,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = 0.7,
                                                  .text = text};
    return FW_OK;
}

static fw_status look_at(fw_arena *arena, const fw_layout *layout, const fw_layout_piece *piece,
                         int k, const seen *most, fw_verdict_variant_verdict *v) {
    const fw_clearance_bend bend = bend_of(v, k, most);
    const fw_clearance_edge *met;
    fw_clearance_strip strip;
    if (!(bend.curvature_per_m > 0) || !isfinite(bend.curvature_per_m)) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(fw_clearance_strip_of(arena, layout, piece, &strip));
    if (!strip.known) return FW_OK;
    const double wall = 2 * (layout->edge_m + fw_made_m) + fabs(layout->flare_m);
    FW_TRY(fw_clearance_strip_meets(arena, v->things, &strip, &bend, wall, &met));
    fw_arena_rewind(arena, mark);
    return met ? say(arena, piece, met, bend.turn_rad, v) : FW_OK;
}

fw_status fw_verdict_clearance_strips(fw_arena *arena, const fw_layout *layout,
                                      fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    if (!v->things || v->corner) return FW_OK; /* allowed for */
    for (int k = 0; k < m->nhinge; k++) {
        const fw_layout_piece *piece = piece_of(layout, m->hinge[k].pin);
        const seen most[2] = {most_of_scenes(v, k), most_of_boxes(v, k)};
        const int before = v->nreason;
        if (v->hinge[k].decision != FW_ACCEPT) continue; /* it bends too far in any case */
        if (!piece || !layout->hinge[m->hinge[k].pin].drawn) continue;
        for (int i = 0; i < 2 && v->nreason == before; i++)
            FW_TRY(look_at(arena, layout, piece, k, &most[i], v));
    }
    return FW_OK;
}
