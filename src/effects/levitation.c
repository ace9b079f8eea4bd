/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Electrodes over a carrier are lifted, and then face each other over less of their depth. No motion has that: what it may
   come to is in every band, and how far they rise is judged beside the motion
   (verdict/verdict_out_of_plane.c). Theory: docs/theory/effects/levitation.md. */
#include "base/constants.h"
#include "effects/effect.h"
#include "effects/envelope.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/quantity_law.h"

bool fw_effects_levitation_may_be(const fw_mechanism *m) {
    return m->device && m->layout && m->variant && !m->variant->below.open &&
           !m->variant->substrate_insulates;
}

/* N, up: what the field pulls at the upper edges of one drive where the lower ones feel nothing, because the carrier
   below has the rotor's potential and screens them. Of the map of fringe_field.c the field on an upper face is
   V/((w + g) (t - kappa^2)^(1/2)), and its stress adds up to eps0 V^2/(4 g) per length and edge of a gap, whatever w is:

     comb   N L eps0 V^2/(2 g), two edges to a finger, engaged all along;   plate   l eps0 V^2/(4 g)

   Exact for electrodes deep against the gap; any other carrier lifts less, and one at the stator's potential pulls down. */
double fw_effects_levitation_N(const fw_device_comb *c, const fw_device_scene *s) {
    const double volt = c->voltage_V * fw_quantity_law_measure(c->law, s->duration_s).most,
                 one = FW_VACUUM_PERMITTIVITY_F_PER_m * volt * volt / (4 * c->gap_m);
    if (c->kind == FW_ELECTRODES_PLATE) return one * c->length_m;
    return 2 * one * c->fingers * (isnan(c->length_m) ? 2 * c->overlap_m : c->length_m);
}

const fw_device_comb *fw_effects_levitation_lift(const fw_mechanism *m, const fw_device_scene *s,
                                                 double *force) {
    const fw_device_comb *first = NULL;
    for (int i = 0; i < s->ncomb; i++) {
        const fw_device_comb *c = &s->comb[i];
        const fw_geometry_vec2 at = fw_mechanism_local_place(m, c->body_b, c->bx_m, c->by_m);
        const int body[2] = {c->body_a, c->body_b};
        const double up = fw_effects_levitation_N(c, s);
        for (int k = 0; k < 2 && up != 0; k++) {
            if (body[k] == FW_GROUND) continue;
            double *f = force + 3 * body[k];
            f[0] += up;
            f[1] += (at.y - m->body[body[k]].y_m) * up;
            f[2] -= (at.x - m->body[body[k]].x_m) * up;
            if (!first) first = c;
        }
    }
    return first;
}

static bool called_for(const fw_effect_case *c) {
    return fw_effects_comb_count(c) > 0 && fw_effects_levitation_may_be(c->mechanism);
}

/* how far the device rises at most, over the depth of its layer; known false: nothing says how it is held */
static fw_status rise(const fw_effect_case *c, double *share, bool *known) {
    fw_mechanism_plates p;
    double *f, *x;
    const fw_geometry_vec2 origin = {0, 0};
    fw_mark mark = fw_arena_mark(c->arena);
    *share = 0;
    FW_TRY(fw_mechanism_plates_new(c->arena, c->mechanism, NULL, &p));
    *known = p.why == NULL;
    if (*known) {
        FW_NEED(f = fw_arena_array(c->arena, double, (size_t)p.n));
        FW_NEED(x = fw_arena_array(c->arena, double, (size_t)p.n));
        if (fw_effects_levitation_lift(c->mechanism, c->scene, f)) {
            fw_mechanism_plates_answer(&p, f, x);
            *share = fw_mechanism_plates_reached(&p, x, NULL, 0, origin).highest_m * (1 + p.error) /
                     c->mechanism->variant->thickness_m;
        }
    }
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

/* what a drive pulls with at most, at the least gap that the motion may come down to; false: none is left for sure */
static bool pulls(const fw_effect_case *c, const fw_device_comb *from, double share, double *force,
                  double *turns) {
    const fw_effects_comb_element d = fw_effects_comb_as_drawn(c, from);
    const fw_effects_comb_reach at = fw_effects_comb_reaches(c, from, &d);
    const bool comb = d.kind == FW_ELECTRODES_COMB;
    const double g = d.gap_m - fabs(d.lean_m), tilted = at.tilt_rad * at.half_m;
    const double *reach = c->envelope->reach;
    double by[2], y = at.aside_m + tilted;
    if (!comb) { /* along is what closes the gap */
        y = tilted;
        for (int k = 0; k < 2; k++) {
            const int body = k ? from->body_b : from->body_a;
            if (body != FW_GROUND) y += hypot(reach[3 * body], reach[3 * body + 1]);
        }
    }
    const double left = g - y;
    *turns = at.turns;
    if (!(left > 0.05 * g)) return false;
    double along, across = 0, couple;
    if (comb) {
        const double away = fw_effects_comb_away(&d, at.along_m, at.tilt_rad);
        if (!(away > FW_EFFECTS_COMB_NEAREST_ROOT * g)) return false;
        along = at.square_V2 *
                (d.face_Fm * g / (left * (g + y)) + d.edge_F_per_m * d.tip.edge_m / g +
                 (d.face_Fm + FW_EFFECTS_COMB_EDGE_AT_ROOT * d.edge_F_per_m * d.tip.edge_m) *
                     fw_effects_comb_tip_share(&d, away) / g);
        across = 2 * d.face_Fm / (left * left * left) * at.square_V2 *
                 (2 * at.half_m + 2 * d.tip.aside * g) * y;
        couple = at.half_m * across;
    } else {
        fw_effects_plate_edge(left, d.width_m, d.depth_m, by);
        along = 0.5 * at.square_V2 *
                (d.face_Fm * d.length_m / (left * left) - d.edge_F_per_m * d.length_m * by[0]);
        couple = at.half_m * along;
    }
    fw_effects_comb_push(c, from, share * along, share * (across + along * fmin(1, at.tilt_rad)),
                         share * couple, force);
    return true;
}

/* A device that rises by z faces its stator over a depth that is less by z: the pull falls by z/h at most, and so does
   what draws it aside. That of the edges, which it takes with it, falls by less. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    double *force, sum = 0, turns, share;
    bool known, valid = e && e->valid;
    FW_TRY(rise(c, &share, &known));
    fw_mark mark = fw_arena_mark(c->arena);
    for (int i = 0; i < c->scene->ncomb && valid && known; i++) {
        if (!fw_effects_comb_drives(&c->scene->comb[i])) continue;
        FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
        if (!pulls(c, &c->scene->comb[i], share, force, &turns)) sum = (double)INFINITY;
        sum += fw_effects_envelope_answer(c, force, turns) +
               fw_effects_envelope_displaced(c, force, turns);
    }
    fw_arena_rewind(c->arena, mark);
    *value = valid && known && share < 1 && sum < (double)INFINITY ? sum : (double)INFINITY;
    char part[32];
    FW_NEED(*reason =
                known ? fw_arena_printf(
                            c->arena,
                            "over a carrier that conducts electrodes rise by up to %s %% of "
                            "their depth, and pull by as much less%s",
                            fw_number_text(part, sizeof part, 100 * share, 2),
                            isfinite(*value) ? "" : "; nothing bounds what that does to the motion")
                      : "what holds electrodes down over a carrier is not known: nothing "
                        "bounds how they rise");
    return FW_OK;
}

static fw_status beside(const fw_effect_case *c, double *share) {
    bool known;
    FW_TRY(rise(c, share, &known));
    return FW_OK;
}

const fw_effect_row fw_effect_levitation = {
    .id = "levitation",
    .summary = "electrodes that a carrier below lifts; in every band, in no motion",
    .called_for = called_for,
    .bound = bound,
    .add = fw_effects_add_nothing,
    .count = fw_effects_comb_count,
    .beside = beside};
