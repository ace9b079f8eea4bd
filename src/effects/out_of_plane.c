/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weight, shocks and stress gradients across the plane. They move nothing in it: what they do to the device, its sag and
   its tilt, is judged beside the motion (verdict/verdict_out_of_plane.c), and here only what that changes of the motion.
   Theory: docs/theory/effects/out-of-plane.md. */
#include "effects/effect.h"
#include "mechanism/mechanism_plates.h"
#include <string.h>

static double shock_of(const fw_device_scene *s) { /* m/s2, at most, ringing included */
    double sum = 0;
    for (int i = 0; i < s->nbase; i++)
        if (s->base[i].az_m_per_s2 != 0)
            sum += 2 * fabs(s->base[i].az_m_per_s2) *
                   fw_quantity_law_measure(s->base[i].law,
                                           fw_quantity_law_done_s(s->base[i].law, s->duration_s))
                       .most;
    return sum;
}

static bool called_for(const fw_effect_case *c) {
    return fw_mechanism_plates_asked(c->scene);
}

/* largest stiffness against tilt over that of the rotation, of any flexure */
static double stiffest(const fw_mechanism_plates *p) {
    double most = 0;
    for (int k = 0; k < p->mechanism->nhinge; k++) {
        const double(*c)[3] = (const double(*)[3])p->hinge[k].c;
        double mean = 0.5 * (c[1][1] + c[2][2]), apart = 0.5 * (c[1][1] - c[2][2]);
        double least = mean - hypot(apart, c[1][2]);
        most = fmax(
            most, 1 / (least * p->mechanism->pin[p->mechanism->hinge[k].pin].stiffness_Nm_per_rad));
    }
    return most;
}

/* The motion in the plane and that out of it are not coupled to first order: sections are mirror images of
   themselves. To second order a flexure whose ends are tilted by b against the plane bends about the wafer's normal
   with K (1 - b^2) + K_tilt b^2, and what is seen of a length from above is shorter by b^2/2:

     change <= b^2 (1 + max K_tilt/K)

   b: the largest tilt of a body under all of it. In: SI; out: dimensionless. An estimate, not a proof: small tilts.
   Cost 10 (3 nbody)^3. Test: test_out_of_plane.py */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    fw_mechanism_plates p;
    fw_geometry_vec2 middle = {0, 0};
    fw_mark mark = fw_arena_mark(c->arena);
    *value = 0;
    FW_TRY(fw_mechanism_plates_new(c->arena, c->mechanism, NULL, &p));
    if (p.why) {
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "acts across the plane: nothing in it moves, and what the device does "
                    "out of it is not known (%s)",
                    p.why));
        return FW_OK;
    }
    size_t n = (size_t)p.n;
    double curvature = fw_mechanism_plates_curvature(c->mechanism, c->scene), *f, *x, *bow;
    FW_NEED(f = fw_arena_array(c->arena, double, n));
    FW_NEED(x = fw_arena_array(c->arena, double, n));
    FW_NEED(bow = fw_arena_array(c->arena, double, n));
    fw_mechanism_plates_weight(&p, fabs(c->scene->gz_m_per_s2) + shock_of(c->scene), f);
    fw_mechanism_plates_answer(&p, f, x);
    if (curvature != 0) {
        fw_mechanism_plates_curl(&p, curvature, &middle, f);
        fw_mechanism_plates_answer(&p, f, bow);
    }
    double tilt = fw_mechanism_plates_reached(&p, x, NULL, 0, middle).tilt_rad +
                  fw_mechanism_plates_reached(&p, bow, NULL, curvature, middle).tilt_rad;
    *value = tilt * tilt * (1 + stiffest(&p));
    fw_arena_rewind(c->arena, mark);
    char text[32];
    FW_NEED(*reason = fw_arena_printf(
                c->arena,
                "acts across the plane, and tilts bodies by up to %s rad, which changes the motion "
                "in it to second order; sag and touch are judged beside it",
                fw_number_text(text, sizeof text, tilt, 2)));
    return FW_OK;
}

const fw_effect_row fw_effect_out_of_plane = {.id = "out-of-plane",
                                              .summary =
                                                  "weight, shocks and stress gradients across the "
                                                  "plane: sag and tilt, judged beside the motion",
                                              .called_for = called_for,
                                              .bound = bound,
                                              .add = fw_effects_add_nothing,
                                              .solid = FW_EFFECTS_SOLID_NO_PART};
