/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fringe at the upper and lower edges of a comb's fingers: every gap counts as deeper than the layer by F(gap) gap,

     C += eps0 N int [F(g - y - theta s) + F(g + y + theta s)] ds

   with F of fw_effects_comb_edge, which is exact for fingers that are deep against the gap and stand in
   open space; against boundary elements it is within 0.2 % of C from a depth of half a gap on, aside by half of the gap
   within 0.5 %. Plates keep Palmer's share beside them: what stands behind their faces is not known. Theory:
   docs/theory/effects/fringe-field.md. Test: test_fringe.c. */
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

static bool drives(const fw_device_comb *c) {
    return c->kind == FW_ELECTRODES_COMB && c->voltage_V != 0;
}

static int count(const fw_effect_case *c) {
    int combs = 0;
    for (int i = 0; i < c->scene->ncomb; i++)
        combs += drives(&c->scene->comb[i]);
    return combs;
}

static bool called_for(const fw_effect_case *c) {
    return count(c) > 0;
}

/* of the pull of parallel faces, as drawn */
static double share_of(double gap_m, double width_m, double depth_m) {
    return fw_effects_comb_edge(gap_m, width_m, NULL) * gap_m / depth_m;
}

static double depth_of(const fw_effect_case *c, const fw_device_comb *comb) {
    const fw_mechanism_variant *v = c->mechanism->variant;
    return isnan(comb->depth_m) && v ? v->thickness_m : comb->depth_m;
}

/* comb-drive has put in one element for each */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < loads->nelement; i++) {
        fw_effects_force_element *e = &loads->element[i];
        if (strcmp(e->class_->effect, "comb-drive") != 0) continue;
        const fw_effects_comb_element *without = e->data;
        if (without->kind != FW_ELECTRODES_COMB) continue;
        fw_effects_comb_element *with = fw_arena_one(c->arena, fw_effects_comb_element);
        FW_NEED(with);
        *with = *without;
        with->edge = fw_effects_comb_edge;
        with->edge_F_per_m = with->face_Fm / with->depth_m;
        e->data = with;
        e->force_N *= 1 + share_of(with->gap_m, with->width_m, with->depth_m);
    }
    return FW_OK;
}

/* on a body at a point: += */
static void push(const fw_effect_case *c, int body, fw_geometry_vec2 at, double force_N,
                 double *force) {
    if (body == FW_GROUND) return;
    const fw_mechanism_mass *b = &c->mechanism->body[body];
    force[3 * body] += force_N;
    force[3 * body + 1] += force_N;
    force[3 * body + 2] += force_N * hypot(at.x - b->x_m, at.y - b->y_m);
}

/* What one comb lacks without: along it eps0 N F V^2; across it the slope of F for as far as the rotor gets aside */
static void lacks(const fw_effect_case *c, const fw_device_comb *from, double square_V2,
                  double *force) {
    const fw_effects_envelope *e = c->envelope;
    double by[2], F = fw_effects_comb_edge(from->gap_m, fw_device_comb_width_m(from), by), aside = 0;
    const int body[2] = {from->body_a, from->body_b};
    for (int k = 0; k < 2; k++)
        if (body[k] != FW_GROUND) aside += hypot(e->reach[3 * body[k]], e->reach[3 * body[k] + 1]);
    const double per = FW_VACUUM_PERMITTIVITY_F_PER_m * from->fingers * square_V2,
                 most = per * (F + fmin(aside, from->gap_m) * (from->overlap_m + aside) * by[1]);
    const fw_geometry_vec2 at =
        fw_mechanism_local_place(c->mechanism, from->body_b, from->bx_m, from->by_m);
    for (int k = 0; k < 2; k++)
        push(c, body[k], at, most, force);
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    double *force, sum = 0, share = 0;
    *value = (double)INFINITY;
    fw_mark mark = fw_arena_mark(c->arena);
    for (int i = 0; i < c->scene->ncomb; i++) {
        const fw_device_comb *from = &c->scene->comb[i];
        if (!drives(from)) continue;
        share = fmax(share, share_of(from->gap_m, fw_device_comb_width_m(from), depth_of(c, from)));
        if (!e || !e->valid) continue;
        const fw_quantity_law_size law = fw_quantity_law_measure(from->law, c->scene->duration_s);
        const double volt = from->voltage_V * law.most;
        FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
        lacks(c, from, volt * volt, force);
        /* of the square: as many turns, each twice as steep */
        const double turns = law.most > 0 ? 2 * law.variation / law.most : 0;
        sum += fw_effects_envelope_answer(c, force, turns) +
               fw_effects_envelope_displaced(c, force, turns);
    }
    fw_arena_rewind(c->arena, mark);
    char part[32];
    if (e && e->valid && sum < (double)INFINITY) *value = sum;
    FW_NEED(*reason = fw_arena_printf(
                c->arena, "the field at the edges of the fingers adds %s %% to a drive's pull%s",
                fw_number_text(part, sizeof part, 100 * share, 3),
                isfinite(*value) ? "" : ", and nothing bounds what that does: kept"));
    return FW_OK;
}

const fw_effect_row fw_effect_fringe_field = {
    .id = "fringe-field",
    .summary = "the field at the upper and lower edges of a comb's fingers",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 2450,
    .count = count};
