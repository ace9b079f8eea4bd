/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/ladder.h"
#include "base/constants.h"
#include <math.h>

static double turned(double angle_rad) { /* into (-pi, pi] */
    return remainder(angle_rad, 2 * FW_PI);
}

/* Least angle between where the convex surface is pushed by the drift and the sector in which both
   surfaces are: W of body b drifts along +-y of the hinge's frame from W of body a; small
   rotations, the sector does not turn */
static double aside(const fw_mechanism *m, const fw_mechanism_hinge *h) {
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    if (!isfinite(h->cover_from_rad) || !isfinite(h->axis_rad)) return 0;
    double drawn = pin->body_a == FW_GROUND ? 0 : m->body[pin->body_a].phi_rad;
    double push =
        h->axis_rad - drawn + (h->first_is_a ? 0.5 : -0.5) * FW_PI + (h->convex_is_a ? FW_PI : 0);
    double middle = 0.5 * (h->cover_from_rad + h->cover_to_rad);
    double half = 0.5 * (h->cover_to_rad - h->cover_from_rad);
    return fmax(0, fabs(turned(push - middle)) - half);
}

void fw_plan_ladder_drift_of(const fw_mechanism *m, const fw_mechanism_hinge *h,
                             fw_plan_ladder_drift *out) {
    const fw_flexure_hinge_law *law = &h->law;
    const fw_device_flexure *f = &m->device->flexure[h->flexure];
    double sense = h->first_is_a ? 1 : -1; /* of the pin's rotation against the law's */
    double most = 1.9 * (FW_PI - law->half_angle_rad) / law->share;
    *out = (fw_plan_ladder_drift){
        .surfaces = {.gap_m = f->gap_m,
                     .aside_rad = aside(m, h),
                     .centre_m = {-h->closed_form.offset_m[0], -h->closed_form.offset_m[1]}},
        .limit_rad = fmin(fmin(h->closed_form.limit_angle_rad, most), 3),
        .contact_rad = {(double)NAN, (double)NAN},
        .closing_N = {(double)NAN, (double)NAN}};
    out->advice = fw_flexure_drift_advise(law, -out->limit_rad, out->limit_rad);
    fw_flexure_drift_curve(law, &out->surfaces, -sense * out->limit_rad, sense * out->limit_rad,
                           FW_DRIFT_POINTS, out->point);
    for (int i = 0; i < FW_DRIFT_POINTS; i++)
        out->point[i].rotation_rad *= sense;
    if (!(f->gap_m > 0)) return;
    out->closing_N[0] = f->gap_m * h->closed_form.kx_N_per_m;
    out->closing_N[1] = f->gap_m * h->closed_form.ky_N_per_m;
    if (out->surfaces.aside_rad >= 0.5 * FW_PI) return; /* pushed away from each other */
    for (int side = 0; side < 2; side++)
        out->contact_rad[side] = sense * fw_flexure_drift_contact_rad(law, &out->surfaces, NULL,
                                                                      (side ? 1 : -1) * (int)sense);
}
