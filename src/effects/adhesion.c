/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces that have met and hold each other: of a hinge, or of a contact between two bodies. It changes nothing until
   they meet, and what it does then is judged beside the motion (verdict/verdict_stiction.c).
   Theory: docs/theory/effects/adhesion.md. */
#include "base/constants.h"
#include "effects/effect.h"

static bool is_known(const fw_mechanism *m) {
    const fw_mechanism_variant *v = m->variant;
    return v && v->drying.adhesion_words && !v->material.youngs.unknown;
}

/* The same of a convex surface of the relative radius R' */
static double line_holds(double youngs_Pa, double poisson, double depth_m, double relative_m,
                         double adhesion_J_per_m2) {
    double modulus = youngs_Pa / (2 * (1 - poisson * poisson)), w = adhesion_J_per_m2;
    return 1.5 * depth_m * cbrt(0.5 * FW_PI * modulus * w * w * relative_m);
}

/* Two cylinders of one material, the convex one of radius R in a concave one of R + gap, hold with at most

     P/h = 3/2 (pi Ec w^2 R'/2)^(1/3),   Ec = E/(2 (1 - nu^2)),   R' = R (R + gap)/gap

   the turning point of P(a)/h = pi Ec a^2/(4 R') - (2 pi Ec a w)^(1/2). In: w in J/m2, SI; out: N. Valid: smooth walls,
   a = (2 w R'^2/(pi Ec))^(1/3) small against R. Rough or leaning walls hold less: an upper bound. Source: M. Barquins, J.
   Adhesion 26 (1988) 1. Test: test_adhesion.c. */
double fw_effects_adhesion_holds(double youngs_Pa, double poisson, double depth_m, double radius_m,
                                 double gap_m, double adhesion_J_per_m2) {
    return line_holds(youngs_Pa, poisson, depth_m, radius_m * (radius_m + gap_m) / gap_m,
                      adhesion_J_per_m2);
}

/* R' of what touches, at most. A flat face, and something round whose radius is the distance: that. Two round things
   side by side, of which both radii together are known: 1/R' = 1/R1 + 1/R2 is least where they are alike, R' = distance/4.
   NaN: flat on flat, a corner, a disc in a hole. In, out: m. Test: test_adhesion.c two_bodies */
double fw_effects_contact_radius(const fw_device_contact_use *use) {
    const bool round = use->side == FW_CONTACT_OUTSIDE && use->distance_m > 0;
    if (use->joint != FW_NONE || !round) return (double)NAN;
    return use->face ? use->distance_m : 0.25 * use->distance_m;
}

fw_effects_adhered fw_effects_adhesion_of(const fw_effect_case *c, const fw_device_contact_use *use,
                                          double adhesion_J_per_m2) {
    const fw_mechanism *m = c->mechanism;
    const fw_mechanism_hinge *h = fw_effects_contact_hinge(m, use);
    fw_effects_adhered out = {.known = false, .opens_N = (double)NAN};
    if (!is_known(m)) return out;
    const fw_device_material *of = &m->variant->material;
    if (use->joint == FW_NONE) {
        const double radius = fw_effects_contact_radius(use);
        out.known = radius > 0;
        out.holds_N = line_holds(of->youngs.value, of->poisson.unknown ? 0 : of->poisson.value,
                                 m->variant->thickness_m, radius, adhesion_J_per_m2);
        return out;
    }
    if (!h || !(h->surface_radius_m > 0)) return out;
    double gap = fw_effects_contact_gap(c, use, h);
    if (!(gap > 0)) return out;
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&h->law, 0, &at);
    out.known = true;
    out.opens_N = gap * fmin(at.kx_N_per_m.value, at.ky_N_per_m.value);
    out.holds_N = fw_effects_adhesion_holds(
        of->youngs.value, of->poisson.unknown ? 0 : of->poisson.value, m->variant->thickness_m,
        h->surface_radius_m, gap, adhesion_J_per_m2);
    return out;
}

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->ncontact && is_known(c->mechanism); i++)
        if (c->scene->contact[i].joint != FW_NONE ||
            c->scene->contact[i].undrawn != FW_UNDRAWN_PLACED)
            return true;
    return false;
}

/* 0 where no gap closes; else nothing bounds what surfaces that stay closed change, and the reason says what holds them
   over what opens them: below 1 they let go */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    double most = 0;
    *value = 0;
    *reason = "no gap closes within the reach of the motion";
    if (!fw_effects_contact_may_touch(c)) return FW_OK;
    *value = (double)INFINITY;
    for (int i = 0; i < c->scene->ncontact; i++) {
        const fw_effects_adhered a = fw_effects_adhesion_of(
            c, &c->scene->contact[i], c->mechanism->variant->drying.adhesion_high);
        if (a.known && c->scene->contact[i].joint != FW_NONE)
            most = fmax(most, a.opens_N > 0 ? a.holds_N / a.opens_N : HUGE_VAL);
    }
    char share[32];
    if (!(most > 0)) {
        *reason = "surfaces that meet may hold each other; judged beside the motion";
        return FW_OK;
    }
    FW_NEED(*reason = fw_arena_printf(c->arena,
                                      "surfaces that meet may hold each other with up to %s times "
                                      "what their flexure opens "
                                      "them with; judged beside the motion",
                                      fw_number_text(share, sizeof share, most, 3)));
    return FW_OK;
}

const fw_effect_row fw_effect_adhesion = {
    .id = "adhesion",
    .summary = "surfaces that have met hold each other; judged beside the motion",
    .called_for = called_for,
    .bound = bound,
    .add = fw_effects_add_nothing,
    .solid = FW_EFFECTS_SOLID_NO_PART};
