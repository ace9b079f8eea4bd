/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The field at the edges of electrodes: every gap counts as deeper than the layer by F(gap) gap,

     comb   C += eps0 N int [F(g - y - theta s) + F(g + y + theta s)] ds
     plate  C += eps0 int F(g - x + theta s) ds + eps0 h [E(g - x - theta l/2) + E(g - x + theta l/2)]

   F of fingers is exact where they are deep against the gap and stand in open space; against boundary elements it is
   within 0.2 % of C from a depth of half a gap on, aside by half of the gap within 0.5 %. F of plates, bars that stand
   in open space, is fitted to the exact map of two bars; E is that of their ends. What is near besides is not known:
   fw_effects_comb_fringe. Theory: docs/theory/effects/fringe-field.md. Test: test_fringe.c. */
#include "base/constants.h"
#include "effects/effect.h"
#include "effects/envelope.h"
#include "quantity/quantity_law.h"
#include <math.h>
#include <string.h>

/* The fringe at both edges of one gap, over eps0 and length: how much longer the straight field would have to be, over
   the gap. Of fingers of width w, gap m on either side, deep against m, alternately at two potentials,

     F(x) = (2 ln(1 + 2x) - 2 ln x + ln(1 + 2x)/x)/pi,   x = m/w

   exactly: the cell from the middle of a finger to that of a gap is mapped onto a half plane (Schwarz and Christoffel),
   where the field is that of a strip. F' and F'' by m. Derivation: docs/theory/effects/fringe-field.md. */
double fw_effects_comb_edge(double gap_m, double width_m, double slope[2]) {
    const double x = gap_m / width_m, ln = log1p(2 * x), per = 1 / (FW_PI * x * x);
    if (slope) {
        slope[0] = -ln * per / width_m;
        slope[1] = (2 * ln / x - 2 / (1 + 2 * x)) * per / (width_m * width_m);
    }
    return (2 * (ln - log(x)) + ln / x) / FW_PI;
}

/* Two bars of width w and depth h, gap g, at +-V/2: the quarter of the section about one of them is mapped onto a half
   plane (Schwarz and Christoffel), its sides found by Newton's method; C/eps0 = K'/K of that map. With x = g/h, y = w/h

     F = (2/pi) ln(B + D/x^(1/2) + A/x),  A = a0 + a1 y^(1/2) + a2 y,  B = b0 + b1 y^(1/2)/(1 + y^(1/2)),
     D = d0/(1 + d1 y^(1/4))

   is within 0.3 % of C and 1.8 % of the pull for x from 0.035 to 4, y from 0.05 to 12; for small x it is the exact
   (2/pi) ln(A/x). */
double fw_effects_plate_edge(double gap_m, double width_m, double depth_m, double slope[2]) {
    const double y = width_m / depth_m, u = 1 / gap_m, root = sqrt(y), deep = sqrt(depth_m * u);
    const double a = fmax(0, -0.049 + 3.028 * root + 8.066 * y) * depth_m * u,
                 b = 1.993 + 1.472 * root / (1 + root), d = 4.084 / (1 + 0.449 * sqrt(root)) * deep,
                 all = a + b + d;
    if (slope) {
        const double by = -(a + 0.5 * d) * u / all;
        slope[0] = 2 / FW_PI * by;
        slope[1] = 2 / FW_PI * ((2 * a + 0.75 * d) * u * u / all - by * by);
    }
    return 2 / FW_PI * log(all);
}

/* One end of a plate, in the plane of the wafer: between that of two equal bars (half of F) and that before a wall
   without end, which is a bar and its image (F at twice the gap). Plates are drawn with a stator that is longer by the
   gap and 10 um at either end: within 0.7 % of C and 1 % of the pull of boundary elements where they are 40 gaps long, 3 % where they are 10. */
double fw_effects_plate_end(double gap_m, double width_m, double length_m, double slope[2]) {
    double equal[2], wall[2];
    const double one = fw_effects_plate_edge(gap_m, width_m, length_m, equal),
                 two = fw_effects_plate_edge(2 * gap_m, width_m, length_m, wall);
    for (int k = 0; slope && k < 2; k++)
        slope[k] = 0.21 * equal[k] + (k + 1) * 2 * 0.58 * wall[k];
    return 0.21 * one + 0.58 * two;
}

static double of_fingers(const fw_effects_comb_element *c, double gap_m, double slope[2]) {
    return fw_effects_comb_edge(gap_m, c->width_m, slope);
}

static double of_plates(const fw_effects_comb_element *c, double gap_m, double slope[2]) {
    return fw_effects_plate_edge(gap_m, c->width_m, c->depth_m, slope);
}

static double of_ends(const fw_effects_comb_element *c, double gap_m, double slope[2]) {
    return fw_effects_plate_end(gap_m, c->width_m, c->length_m, slope);
}

/* along: fingers gain what they gain in C, plates what their edges lose as the gap opens */
double fw_effects_comb_fringe(const fw_effects_comb_element *c) {
    const double left = c->edge ? 0 : 1, g = c->gap_m;
    double by[2], end[2];
    if (c->kind == FW_ELECTRODES_COMB)
        return (left + 0.5) * of_fingers(c, g, NULL) * g / c->depth_m;
    of_plates(c, g, by);
    of_ends(c, g, end);
    return -g * g * ((left + 0.5) * by[0] / c->depth_m + left * 2 * end[0] / c->length_m);
}

static bool called_for(const fw_effect_case *c) {
    return fw_effects_comb_count(c) > 0;
}

/* what the edges add to the pull, over V^2/2: at a gap that the motion may come down to */
static double pull_of(const fw_effects_comb_element *e, double gap_m) {
    double by[2], end[2];
    if (e->kind == FW_ELECTRODES_COMB) return 2 * e->edge_F_per_m * of_fingers(e, gap_m, NULL);
    of_plates(e, gap_m, by);
    of_ends(e, gap_m, end);
    return -e->edge_F_per_m * (e->length_m * by[0] + 2 * e->depth_m * end[0]);
}

/* of the pull of parallel faces, as drawn */
static double share_of(const fw_effects_comb_element *e) {
    const double g = e->gap_m;
    return pull_of(e, g) * (e->kind == FW_ELECTRODES_COMB ? 0.5 * g : g * g / e->length_m) /
           e->face_Fm;
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
    if (!comb && !(aside + tilt * half < 0.95 * d.gap_m)) return false;
    along = 0.5 * square_V2 * pull_of(&d, comb ? d.gap_m : d.gap_m - aside - tilt * half);
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
