/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The levels of the ladder: one hinge by models of growing fidelity and cost. A level is a function
   and its row in the table at the end. docs/theory/flexure-errors.md. */
#include "base/constants.h"
#include "continuum/continuum.h"
#include "flexure/beam.h"
#include "plan/plan.h"
#include <math.h>

/* Of an arc of an isotropic material the levels show strain and limit of the printed closed form,
   to its digits (converged solids: 8 % below to 4.3 % above it, below by 12 % where deeper than 10
   t). Elsewhere, where solids are up to 15 % (leaves) and 43 % (silicon) above it, and in every
   verdict, they are its upper bound over solids (strain_bound_per_rad). The error of the printed
   one is what it is off by from that bound and from the least below it that the bound allows. */
static void take_printed(const fw_flexure_input *in, fw_flexure_result *r) {
    if (in->kind != FW_FLEXURE_CSFH || in->crystal.known || !(r->strain_fit_per_rad > 0.0)) return;
    double over = r->strain_fit_per_rad / r->strain_per_rad, e = r->error.strain;
    r->error.strain = fmax(fabs(over - 1), fabs(over / (1 - e) - 1));
    r->limit_angle_rad /= over;
    r->strain_per_rad = r->strain_fit_per_rad;
}

/* what a closed form says for small rotations; W is where the mechanism has it */
static fw_report_level linear_row(const fw_flexure_result *r) {
    return (fw_report_level){.stiffness_Nm_per_rad = r->stiffness_Nm_per_rad,
                             .kx_N_per_m = r->kx_N_per_m,
                             .ky_N_per_m = r->ky_N_per_m,
                             .strain_per_rad = r->strain_per_rad,
                             .limit_angle_rad = r->limit_angle_rad,
                             .moment_Nm = r->stiffness_Nm_per_rad * r->limit_angle_rad,
                             .drift_m = (double)NAN,
                             .error = r->error};
}

/* a closed form, with what the ends lose or as printed; W from where the mechanism has it */
static fw_flexure_result by_formula(const fw_plan_ladder_case *c, bool ends) {
    fw_flexure_input in = c->hinge->input;
    fw_flexure_result r;
    in.ends = ends;
    fw_flexure_closed_form(&in, &r);
    return r;
}

static fw_report_level placed_row(const fw_plan_ladder_case *c, const fw_flexure_result *r) {
    const double *offset = c->hinge->closed_form.offset_m;
    fw_report_level row = linear_row(r);
    row.at_m[0] = r->offset_m[0] - offset[0], row.at_m[1] = r->offset_m[1] - offset[1];
    return row;
}

/* linear, roots and depth included, to the printed digits: flexure/flexure.c */
static fw_status closed_form(const fw_plan_ladder_case *c, fw_report_level *row) {
    fw_flexure_result r = by_formula(c, false);
    take_printed(&c->hinge->input, &r);
    *row = placed_row(c, &r);
    return FW_OK;
}

/* ---- with the ends ---- */

/* The closed form with what the ends lose (13a), as a crystal always has it, and the bound of the
   strain: K of 417 solids within 0.11 % (rms), W within 0.1 um. No mechanism uses it yet: the law at finite rotation has
   the printed one. Test: test_csfh.c ends_beside_plain_sums, test_root_strain.c */
static fw_status with_ends(const fw_plan_ladder_case *c, fw_report_level *row) {
    const fw_flexure_result r = by_formula(c, true);
    *row = placed_row(c, &r);
    return FW_OK;
}

/* ---- compliance ---- */

/* The hinge of three degrees of freedom at finite rotation (flexure/finite.c), as the mechanism
   uses it, at the limit angle: what it then is against small displacements, the moment over the
   angle as its stiffness, W of the second body where it has drifted to. Its error is that of the
   closed form it is made from, and the drift's 0.006 um of 0.7 against finite elements, 1 % */
static fw_status compliance(const fw_plan_ladder_case *c, fw_report_level *row) {
    fw_flexure_hinge_law unscaled =
        c->hinge->law; /* a stated stiffness is no level of the ladder */
    const fw_flexure_hinge_law *law = &unscaled;
    fw_flexure_result own = c->hinge->closed_form;
    FW_TRY(fw_flexure_hinge_law_scale(c->arena, &unscaled, 1 / c->hinge->scale));
    const fw_flexure_result *r = &own;
    take_printed(&c->hinge->input, &own);
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(law);
    double limit = r->limit_angle_rad, most = 2 * (FW_PI - law->half_angle_rad) / law->share;
    if (!(limit < fmin(0.95 * most, FW_PI))) {
        *row = (fw_report_level){.state = FW_LEVEL_NONE,
                                 .why = "the arc would close before the limit angle"};
        return FW_OK;
    }
    fw_flexure_hinge_at at;
    double u[2], wrench[3], tangent[3][3];
    fw_flexure_drift_displacement(law, limit, NULL, u);
    const double twist[3] = {limit, u[0], u[1]};
    fw_flexure_hinge_law_wrench(law, &rest, twist, wrench, tangent);
    fw_flexure_hinge_law_at(law, limit, &at);
    *row = (fw_report_level){.stiffness_Nm_per_rad = wrench[0] / limit,
                             .kx_N_per_m = at.kx_N_per_m.value,
                             .ky_N_per_m = at.ky_N_per_m.value,
                             .strain_per_rad = r->strain_per_rad,
                             .limit_angle_rad = limit,
                             .moment_Nm = wrench[0],
                             .drift_m = hypot(u[0], u[1]),
                             .at_m = {u[0], u[1]},
                             .error = r->error};
    row->error.kx += 0.002, row->error.ky += 0.002; /* its own thick arc: Winkler's is 0.2 % off */
    row->error.centre_m += 0.01 * hypot(u[0], u[1]);
    return FW_OK;
}

/* ---- exact beam ---- */

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
static void errors_of(const fw_plan_ladder_case *c, const fw_flexure_result *closed_form,
                      const fw_flexure_elastica_result *at, fw_report_level *row) {
    const fw_flexure_input *in = &c->hinge->input;
    bool arc = in->kind == FW_FLEXURE_CSFH;
    double u = arc ? 0.5 * in->width_m / in->radius_m : 0, a = 0.5 * in->angle_rad;
    fw_flexure_error e = closed_form->error; /* of the strain that is shown */
    e.stiffness += at->error, e.strain += at->error;
    e.kx += 2 * u * u + at->error, e.ky += 4 * u * u + at->error;
    if (arc) e.centre_m += in->radius_m * u * u / 3 * fabs(sin(a)) / a;
    row->error = e;
}

/* The geometrically exact beam of the hinge (flexure/beam.h): roots as point rotations, depth
   factor, crystal by direction. At rest its centre of elastic weights W and compliance there:
     K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy
   and by rotations under a pure moment the limit angle, strain(theta) = strength/safety factor/E,
     strain = M_root t/(2 I D g E) Kt (1 + t/3r) F
   with the closed form's factors of fillet, curvature, depth and crystal (flexure.md 5, 14); moment
   and drift of W there. Strain per rad is the limit strain over the limit angle.
   in: hinge; out SI. Valid below half a turn and where the beam has a primary branch. Cost 1 ms,
   most of it the solution's tables. Test: tests/cli/test_hinge.py */
static fw_status elastica(const fw_plan_ladder_case *c, fw_report_level *row) {
    const fw_flexure_input *in = &c->hinge->input;
    fw_flexure_result own = c->hinge->closed_form;
    const fw_flexure_result *r = &own;
    take_printed(in, &own);
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
    errors_of(c, r, &t.at, row);
    return FW_OK;
}

/* ---- solid ---- */

static const char *unfit(const fw_plan_ladder_case *c) {
    const fw_flexure_input *in = &c->hinge->input;
    if (in->crystal.known && !in->crystal.aligned)
        return "the direction of the hinge in the crystal is not known";
    if (fw_flexure_input_varies(in)) return "solids are made of one arc or line of one width";
    return in->fillet_m > 0 ? NULL : "roots without fillets have no finite strain";
}

/* What a solid's two meshes do not tell:
     K, kx, ky  whether the blocks' sides are held, 5e-4 of K (2.7e-4 of H2), five times as much of
                kx and ky; a force along the strip also finds blocks of another size: twice theirs
                gives as 0.7 to 0.8 t more of strip (four leaves, L/t 20 to 80), four times as 1.6 t:
                compliance 1.6 t/(E h t) along it
     strain     CalculiX extrapolates to nodes, and the wider the fillet for its eight elements the
                more is missed: -3.2 to +0.7 % of converged surfaces, 1 % + 3.5 % of min(rho/t, 1)
     W          0.028 um of H2: 0.004 t
   a: half the angle of the strip, its direction at a root. Test: test_hinge.py,
   test_reference_continuum; docs/theory/continuum.md */
static fw_flexure_error beyond_meshes(const fw_flexure_input *in, const fw_continuum_result *s) {
    double a = in->kind == FW_FLEXURE_LEAF ? 0 : 0.5 * in->angle_rad;
    double stiffness = s->stiffness_error + 5e-4, give = 1.6 / (in->youngs_Pa * in->depth_m);
    double wide = fmin(in->fillet_m / in->width_m, 1);
    return (fw_flexure_error){
        .stiffness = stiffness,
        .kx = 5 * stiffness + s->kx_N_per_m * give * sin(a) * sin(a),
        .ky = 5 * stiffness + s->ky_N_per_m * give * cos(a) * cos(a),
        .strain = s->strain_error + 0.01 + 0.035 * wide,
        .centre_m = s->centre_error_m + 0.004 * in->width_m,
    };
}

/* the solid with fillets and root blocks (src/continuum), linear, two meshes */
static fw_status continuum(const fw_plan_ladder_case *c, fw_report_level *row) {
    const fw_flexure_input *in = &c->hinge->input;
    const fw_flexure_result *r = &c->hinge->closed_form;
    *row = (fw_report_level){.state = FW_LEVEL_NONE, .why = unfit(c)};
    if (row->why) return FW_OK;
    const fw_continuum_material material = fw_continuum_material_of(c->mechanism, c->hinge);
    fw_continuum_shape shape;
    fw_continuum_result s;
    fw_diags own = fw_diags_new(c->arena);
    fw_place place = c->mechanism->device->flexure[c->hinge->flexure].place;
    fw_continuum_shape_of(in, &shape);
    fw_status status = fw_continuum_hinge(c->arena, &shape, &material, &(fw_continuum_options){0},
                                          place, &own, &s);
    if (status == FW_GEOMETRY || status == FW_SOLVER) { /* the other levels hold all the same */
        row->why = "the solid could not be solved";
        for (size_t i = 0; i < own.count; i++)
            fw_diag_warning(c->diags, own.item[i].number, place, "%s", own.item[i].message);
        return FW_OK;
    }
    FW_TRY(status);
    if (!s.installed) {
        row->state = FW_LEVEL_MISSING, row->why = s.missing;
        return FW_OK;
    }
    double strain = in->crystal.known ? s.stress_per_rad_Pa / in->youngs_Pa : s.strain_per_rad;
    *row = (fw_report_level){
        .at_m = {s.centre_x_m - r->centre_m - r->offset_m[0], s.centre_y_m - r->offset_m[1]},
        .stiffness_Nm_per_rad = s.stiffness_Nm_per_rad,
        .kx_N_per_m = s.kx_N_per_m,
        .ky_N_per_m = s.ky_N_per_m,
        .strain_per_rad = strain,
        .limit_angle_rad = in->strength_Pa / (in->safety_factor * in->youngs_Pa * strain),
        .drift_m = (double)NAN,
        .error = beyond_meshes(in, &s),
        .cpu_s = s.cpu_s};
    row->moment_Nm = row->stiffness_Nm_per_rad * row->limit_angle_rad;
    return FW_OK;
}

/* ---- the table, in the order of what a level costs ---- */

static const fw_plan_ladder_level levels[] = {
    {"closed-form", "linear, at rest", false, closed_form},
    {"ends", "linear, at rest, with what the ends lose", false, with_ends},
    {"compliance", "three degrees of freedom, at the limit angle", false, compliance},
    {"elastica", "geometrically exact beam", false, elastica},
    {"continuum", "solid with fillets and root blocks", true, continuum},
};
_Static_assert(sizeof levels / sizeof levels[0] <= FW_LADDER_LEVELS_MOST, "room in a ladder");

const fw_plan_ladder_level *fw_plan_ladder_levels(size_t *count) {
    *count = sizeof levels / sizeof levels[0];
    return levels;
}
