/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The field at the edges of electrodes: every gap counts as deeper than the layer by F(gap) gap,

     comb   C += eps0 N int [F(g - y - theta s) + F(g + y + theta s)] ds, and of what ends of fingers have (comb_drive.c) 1.42 and 0.3 times F g/h
     plate  C += eps0 int F(g - x + theta s) ds + eps0 h [E(g - x - theta l/2) + E(g - x + theta l/2)]

   F of fingers is exact where they are deep against the gap and stand in open space; against boundary elements it is
   within 0.2 % of C from a depth of half a gap on, aside by half of the gap within 0.5 %. F of plates, bars that stand
   in open space, is fitted to the exact map of two bars; E is that of their ends. What is near besides is not known:
   fw_effects_comb_fringe. F and E themselves, which other effects of electrodes ask for, too, stand in element.c.
   Theory: docs/theory/effects/fringe-field.md. Test: test_fringe.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "quantity/quantity_law.h"
#include <math.h>
#include <string.h>

static double of_fingers(const fw_effects_comb_element *c, double gap_m, double slope[2]) {
    return fw_effects_comb_edge(gap_m, c->width_m, slope);
}

static double of_plates(const fw_effects_comb_element *c, double gap_m, double slope[2]) {
    return fw_effects_plate_edge(gap_m, c->width_m, c->depth_m, slope);
}

static double of_ends(const fw_effects_comb_element *c, double gap_m, double slope[2]) {
    return fw_effects_plate_end(gap_m, c->width_m, c->length_m, slope);
}

static bool called_for(const fw_effect_case *c) {
    return fw_effects_comb_count(c) > 0;
}

/* what the edges add to the pull, over V^2/2: at a gap, or a distance of tips from the root, that the motion may come down to */
static double pull_of(const fw_effects_comb_element *e, double gap_m, double away_m) {
    double by[2], end[2];
    if (e->kind == FW_ELECTRODES_COMB)
        return 2 * e->edge_F_per_m * e->tip.edge_m / e->gap_m *
               (1 + FW_EFFECTS_COMB_EDGE_AT_ROOT * fw_effects_comb_tip_share(e, away_m));
    of_plates(e, gap_m, by);
    of_ends(e, gap_m, end);
    return -e->edge_F_per_m * (e->length_m * by[0] + 2 * e->depth_m * end[0]);
}

/* of the pull of parallel faces, as drawn */
static double share_of(const fw_effects_comb_element *e) {
    const double g = e->gap_m;
    return pull_of(e, g, fmax(fw_effects_comb_away(e, 0, 0), FW_EFFECTS_COMB_NEAREST_ROOT * g)) *
           (e->kind == FW_ELECTRODES_COMB ? 0.5 * g : g * g / e->length_m) / e->face_Fm;
}

/* comb-drive has put in one element for each */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < loads->nelement; i++) {
        fw_effects_force_element *e = &loads->element[i];
        if (strcmp(e->class_->effect, "comb-drive") != 0) continue;
        const fw_effects_comb_element *without = e->data;
        fw_effects_comb_element *with = fw_arena_one(c->arena, fw_effects_comb_element);
        FW_NEED(with);
        *with = *without;
        with->edge = with->kind == FW_ELECTRODES_COMB ? of_fingers : of_plates;
        with->end = of_ends;
        e->data = with;
        e->force_N *= 1 + share_of(with);
    }
    return FW_OK;
}

/* What one drive lacks without: along it the pull of its edges at the least gap, turned with the stator; across a comb
   the slope of F for as far as the rotor gets aside; a couple where the rotor tilts. false: no gap is left for certain */
static bool lacks(const fw_effect_case *c, const fw_device_comb *from, double square_V2,
                  double *force) {
    const fw_effects_envelope *e = c->envelope;
    const fw_effects_comb_element d = fw_effects_comb_as_drawn(c, from);
    const bool comb = d.kind == FW_ELECTRODES_COMB;
    double aside = 0, tilt = 0, by[2], across = 0, along, couple;
    const int body[2] = {from->body_a, from->body_b};
    for (int k = 0; k < 2; k++)
        if (body[k] != FW_GROUND) {
            aside += hypot(e->reach[3 * body[k]], e->reach[3 * body[k] + 1]);
            tilt += e->reach[3 * body[k] + 2];
        }
    const double half = 0.5 * (comb ? d.overlap_m + aside : d.length_m);
    if (!comb && !(aside + tilt * half + fabs(d.lean_m) < 0.95 * d.gap_m)) return false;
    const double away = comb ? fw_effects_comb_away(&d, aside, tilt) : 1;
    if (!(away > FW_EFFECTS_COMB_NEAREST_ROOT * d.gap_m)) return false;
    along = 0.5 * square_V2 *
            pull_of(&d, d.gap_m - fabs(d.lean_m) - (comb ? 0 : aside + tilt * half), away);
    if (comb) {
        fw_effects_comb_edge(d.gap_m, d.width_m, by);
        across =
            2 * d.edge_F_per_m * square_V2 * fmin(aside + tilt * half, d.gap_m) * half * -by[0];
        couple = half * across;
    } else {
        couple = half * along;
    }
    fw_effects_comb_push(c, from, along, across + along * fmin(1, tilt), couple, force);
    return true;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    double *force, sum = 0, share = 0;
    *value = (double)INFINITY;
    fw_mark mark = fw_arena_mark(c->arena);
    for (int i = 0; i < c->scene->ncomb; i++) {
        const fw_device_comb *from = &c->scene->comb[i];
        if (!fw_effects_comb_drives(from)) continue;
        const fw_effects_comb_element d = fw_effects_comb_as_drawn(c, from);
        share = fmax(share, share_of(&d));
        if (!e || !e->valid) continue;
        const fw_quantity_law_size law = fw_quantity_law_measure(from->law, c->scene->duration_s);
        const double volt = from->voltage_V * law.most;
        FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
        if (!lacks(c, from, volt * volt, force)) sum = (double)INFINITY;
        /* of the square: as many turns, each twice as steep */
        const double turns = law.most > 0 ? 2 * law.variation / law.most : 0;
        sum += fw_effects_envelope_answer(c, force, turns) +
               fw_effects_envelope_displaced(c, force, turns);
    }
    fw_arena_rewind(c->arena, mark);
    char part[32];
    if (e && e->valid && sum < (double)INFINITY) *value = sum;
    FW_NEED(*reason = fw_arena_printf(
                c->arena, "the field at the edges of the electrodes adds %s %% to a drive's pull%s",
                fw_number_text(part, sizeof part, 100 * share, 3),
                isfinite(*value) ? "" : ", and nothing bounds what that does: kept"));
    return FW_OK;
}

const fw_effect_row fw_effect_fringe_field = {
    .id = "fringe-field",
    .summary = "the field at the edges of a comb's fingers and of plates",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 2450,
    .count = fw_effects_comb_count};
