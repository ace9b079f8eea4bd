/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/elastica.h"
#include "base/constants.h"
#include "plan/ladder.h"
#include <math.h>

static const double tolerance = 1e-9;

typedef struct turned {
    fw_flexure_elastica *e;
    double per_moment; /* strain at a root, per N m there */
    fw_flexure_elastica_result at;
} turned;

/* strain at the roots of the second body turned by `angle_rad`, no force on it: the moments of both
   roots and what the closed form makes of them at the fillet; NaN: not solved */
static double strain_at(turned *t, double angle_rad) {
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY}, {angle_rad, 0, 0}};
    fw_flexure_elastica_solve(t->e, &task, tolerance, true, &t->at);
    if (t->at.code != FW_ELASTICA_OK && t->at.code != FW_ELASTICA_ROUGH) return (double)NAN;
    fw_flexure_elastica_state first, second;
    fw_flexure_elastica_at(t->e, 0, &first);
    fw_flexure_elastica_at(t->e, fw_flexure_elastica_linear(t->e)->length_m, &second);
    return t->per_moment * fmax(fabs(first.moment_Nm), fabs(second.moment_Nm));
}

/* secant on strain(theta) = limit from (0, 0) and the closed form's answer; the beam is close to
   linear, so two or three steps. NaN: it does not get there */
static double limit_angle(turned *t, double guess_rad, double limit) {
    double low = 0, miss_low = -limit, angle = guess_rad;
    for (int k = 0; k < 20; k++) {
        double miss = strain_at(t, angle) - limit;
        if (!isfinite(miss)) return (double)NAN;
        if (fabs(miss) <= 1e-10 * limit) return angle;
        double next = angle - miss * (angle - low) / (miss - miss_low);
        low = angle, miss_low = miss, angle = next;
        if (!(angle > 0 && angle < FW_PI)) return (double)NAN;
    }
    return (double)NAN;
}

/* What the level does not know is what the closed form does not (roots, depth), and the thick arc:
   a section's axial force does not bend it here. W then misses the neutral radius, r u^2/3
   sin(a)/a, u = t/2r; kx and ky miss up to 2 u^2 and 4 u^2. The beam's own error is told and far
   smaller */
static void errors_of(const fw_plan_ladder_case *c, const fw_flexure_elastica_result *at,
                      fw_report_level *row) {
    const fw_flexure_input *in = &c->hinge->input;
    bool arc = in->kind == FW_FLEXURE_CSFH;
    double u = arc ? 0.5 * in->width_m / in->radius_m : 0, a = 0.5 * in->angle_rad;
    fw_flexure_error e = c->hinge->closed_form.error;
    e.stiffness += at->error, e.strain += at->error;
    e.kx += 2 * u * u + at->error, e.ky += 4 * u * u + at->error;
    if (arc) e.centre_m += in->radius_m * u * u / 3 * fabs(sin(a)) / a;
    row->error = e;
}

/* The geometrically exact beam of the hinge (flexure/elastica.h): roots as point rotations, depth
   factor, crystal by direction. At rest its centre of elastic weights W and compliance there:
     K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy
   and by rotations under a pure moment the limit angle, strain(theta) = strength/safety factor/E,
     strain = M_root t/(2 I D g E) Kt (1 + t/3r) F
   with the closed form's factors of fillet, curvature, depth and crystal (flexure.md 5, 14); moment
   and drift of W there. Strain per rad is the limit strain over the limit angle.
   in: hinge; out SI. Valid below half a turn and where the beam has a primary branch. Cost 1 ms,
   most of it the solution's tables. Test: tests/cli/test_hinge.py */
fw_status fw_plan_ladder_elastica(const fw_plan_ladder_case *c, fw_report_level *row) {
    const fw_flexure_input *in = &c->hinge->input;
    fw_flexure_result own = c->hinge->closed_form;
    const fw_flexure_result *r = &own;
    fw_plan_ladder_printed(in, &own);
    fw_flexure_beam beam;
    turned t = {.per_moment = r->strain_per_rad / r->stiffness_Nm_per_rad};
    FW_TRY(fw_flexure_beam_of_input(c->arena, in, r, &beam));
    FW_TRY(fw_flexure_elastica_new(c->arena, &beam, NULL, false, &t.e));
    double limit = in->strength_Pa / (in->safety_factor * in->youngs_Pa);
    double angle =
        r->limit_angle_rad < FW_PI ? limit_angle(&t, r->limit_angle_rad, limit) : (double)NAN;
    if (!isfinite(angle)) {
        *row = (fw_report_level){.state = FW_LEVEL_NONE,
                                 .why = "the beam has no equilibrium at the limit strain below "
                                        "half a turn"};
        return FW_OK;
    }
    const fw_flexure_beam_linear *at_rest = fw_flexure_elastica_linear(t.e);
    *row = (fw_report_level){.at_m = {at_rest->centre_m[0] - r->centre_m - r->offset_m[0],
                                      at_rest->centre_m[1] - r->offset_m[1]},
                             .stiffness_Nm_per_rad = 1 / at_rest->c[0][0],
                             .kx_N_per_m = 1 / at_rest->c[1][1],
                             .ky_N_per_m = 1 / at_rest->c[2][2],
                             .strain_per_rad = limit / angle,
                             .limit_angle_rad = angle,
                             .moment_Nm = t.at.wrench[0],
                             .drift_m = hypot(t.at.twist[1], t.at.twist[2])};
    errors_of(c, &t.at, row);
    return FW_OK;
}
