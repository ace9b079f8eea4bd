/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/strain.h"
#include "base/constants.h"
#include <math.h>

/* Wrench on the upper body at W, in the flexure's half-rotated frame:
     M = K theta, F;  section moment M(b) = M + xW Fy + r (Fx sin b - Fy cos b), |b| <= a
     extremum at b* = atan2(Fx, -Fy) or b* + pi where inside, else at an end
   strain = (eps/rad / K) |M(b)| at the roots, without the fillet's concentration inside the arc
   in: radius m, half angle rad, centre m, moment N m, force N; out: largest |M| at the roots and
   inside, N m
   source: docs/theory/verdict.md eq. 2; test_strain.c section_moments_of_a_whole_six_bar
 */
void fw_verdict_arc_moments(const fw_device_flexure *f, double centre_m, double M, double Fx,
                            double Fy, double *root_Nm, double *inside_Nm) {
    double r = f->radius_m, a = 0.5 * f->angle_rad, pi = FW_PI;
    *root_Nm = *inside_Nm = 0.0;
    for (int side = -1; side <= 1; side += 2) {
        double b = side * a;
        *root_Nm = fmax(*root_Nm, fabs(M + centre_m * Fy + r * (Fx * sin(b) - Fy * cos(b))));
    }
    double b0 = atan2(Fx, -Fy);
    for (int k = -2; k <= 2; k++) {
        double b = b0 + k * pi;
        if (fabs(b) <= a)
            *inside_Nm =
                fmax(*inside_Nm, fabs(M + centre_m * Fy + r * (Fx * sin(b) - Fy * cos(b))));
    }
}

static double largest_lever(const fw_device_flexure *f, double centre_m) {
    double a = 0.5 * f->angle_rad;
    return f->kind == FW_FLEXURE_CSFH ? hypot(f->radius_m * cos(a) - centre_m, f->radius_m * sin(a))
                                      : 0.5 * f->length_m;
}

/* no drawn axis, or a leaf: the force acts on its largest lever wherever it points */
static double bounded_moment(const fw_device_flexure *f, double centre_m, double M,
                             double force_N) {
    return fabs(M) + largest_lever(f, centre_m) * force_N;
}

/* likewise of any centre line: no section is farther from the pin than this */
static double farthest_m(const fw_flexure_path_strain *s, double x, double y) {
    double far = 0;
    for (int i = 0; i < s->n; i++)
        far = fmax(far, hypot(s->point[i].x_m - x, s->point[i].y_m - y));
    return far;
}

/* a flexure that varies: moment and section modulus place by place (flexure/path.h) */
static double varying_strain(const fw_mechanism_hinge *hinge, const fw_layout_hinge_layout *drawn,
                             const fw_verdict_hinge_load *load, double sign) {
    const fw_flexure_result *c = &hinge->closed_form;
    const double W[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    double moment = c->stiffness_Nm_per_rad * load->angle_rad;
    if (!drawn || !drawn->drawn) {
        double most =
            fabs(moment) + farthest_m(&hinge->section, W[0], W[1]) * hypot(load->fx_N, load->fy_N);
        return c->strain_per_rad / c->stiffness_Nm_per_rad * most;
    }
    double turn = drawn->axis_rad + load->frame_rad, cs = cos(turn), sn = sin(turn);
    double fx = -sign * load->fx_N, fy = -sign * load->fy_N;
    return fw_flexure_path_strain_at(
        &hinge->section, W,
        (const double[3]){sign * moment, cs * fx + sn * fy, -sn * fx + cs * fy});
}

double fw_verdict_hinge_strain(const fw_mechanism *m, const fw_mechanism_hinge *hinge,
                               const fw_layout_hinge_layout *drawn,
                               const fw_verdict_hinge_load *load) {
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    const fw_device_flexure *f = &m->device->flexure[hinge->flexure];
    const fw_flexure_result *c = &hinge->closed_form;
    double per_moment = c->strain_per_rad / c->stiffness_Nm_per_rad;
    double area = fw_device_flexure_narrowest_m(f) * m->variant->thickness_m;
    double force = hypot(load->fx_N, load->fy_N);
    double axial = force / (m->variant->material.youngs.value * area);
    double moment = c->stiffness_Nm_per_rad * load->angle_rad;
    if (hinge->section.n > 0)
        return varying_strain(hinge, drawn, load,
                              drawn && drawn->upper != pin->body_b ? -1.0 : 1.0) +
               axial;
    if (!drawn || !drawn->drawn || f->kind != FW_FLEXURE_CSFH)
        return per_moment * (bounded_moment(f, c->centre_m, moment, force) +
                             hypot(c->offset_m[0], c->offset_m[1]) * force) +
               axial;

    /* what the flexure carries on the upper body is minus what the pin does to it */
    double sign = drawn->upper == pin->body_b ? 1.0 : -1.0;
    double turn = drawn->axis_rad + load->frame_rad, cs = cos(turn), sn = sin(turn);
    double fx = -sign * load->fx_N, fy = -sign * load->fy_N, root, inside;
    /* the pin is at the true centre; of a crystal it is off the axis: M - yW Fx */
    double along = cs * fx + sn * fy, centre = c->centre_m + c->offset_m[0];
    fw_verdict_arc_moments(f, centre, sign * moment - c->offset_m[1] * along, along,
                           -sn * fx + cs * fy, &root, &inside);
    return per_moment * fmax(root, inside / c->concentration) + axial;
}

/* M(-a), M(+a) of eq. 2 times eps/(theta K); of a leaf M -+ Fx L/2, x across it. Where the axis is
   not drawn, with the sign of the rotation what both add at most. Test: test_strain.c
   root_strains_have_signs, root_strains_of_a_leaf */
void fw_verdict_hinge_root_strains(const fw_mechanism *m, const fw_mechanism_hinge *hinge,
                                   const fw_layout_hinge_layout *drawn,
                                   const fw_verdict_hinge_load *load, double strain[2]) {
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    const fw_device_flexure *f = &m->device->flexure[hinge->flexure];
    const fw_flexure_result *c = &hinge->closed_form;
    double per_moment = c->strain_per_rad / c->stiffness_Nm_per_rad;
    double moment = c->stiffness_Nm_per_rad * load->angle_rad, r = f->radius_m;
    if (hinge->section.n > 0) { /* of the worst section, with the sign of the rotation */
        double worst =
            varying_strain(hinge, drawn, load, drawn && drawn->upper == pin->body_b ? 1.0 : -1.0);
        strain[0] = strain[1] = copysign(worst, load->angle_rad);
        return;
    }
    if (!drawn || !drawn->drawn) {
        double force = hypot(load->fx_N, load->fy_N);
        strain[0] = strain[1] =
            per_moment * copysign(bounded_moment(f, c->centre_m, moment, force) +
                                      hypot(c->offset_m[0], c->offset_m[1]) * force,
                                  load->angle_rad);
        return;
    }
    double sign = drawn->upper == pin->body_b ? 1.0 : -1.0;
    double turn = drawn->axis_rad + load->frame_rad, cs = cos(turn), sn = sin(turn);
    double fx = -sign * (cs * load->fx_N + sn * load->fy_N);
    double fy = -sign * (-sn * load->fx_N + cs * load->fy_N);
    for (int side = -1; side <= 1; side += 2) {
        double b = side * 0.5 * f->angle_rad, force = side * 0.5 * f->length_m * fx;
        if (f->kind == FW_FLEXURE_CSFH)
            force = (c->centre_m + c->offset_m[0]) * fy - c->offset_m[1] * fx +
                    r * (fx * sin(b) - fy * cos(b));
        strain[side > 0] = per_moment * (sign * moment + force);
    }
}
