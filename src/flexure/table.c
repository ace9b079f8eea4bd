/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/kinds.h"
#include <math.h>

static const fw_flexure_model table[] = {
    {FW_FLEXURE_CSFH, "csfh", "circular arc with a pair of conjugate surfaces", fw_flexure_csfh},
    {FW_FLEXURE_LEAF, "leaf", "straight leaf", fw_flexure_leaf},
};

const fw_flexure_model *fw_flexure_models(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

/* limit angle = strength / safety factor / (E eps/rad); its relative uncertainty is that of the
   strain formula: half of the 2.9 % by which held-out finite elements were off, and 5 % more where
   the fillet lies outside the fitted range or the arc is thick (t/r > 0.3) */
void fw_flexure_closed_form(const fw_flexure_input *in, fw_flexure_result *out) {
    *out = (fw_flexure_result){0};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (table[i].kind == in->kind) table[i].closed_form(in, out);
    out->stress_per_rad_Pa = in->youngs_Pa * out->strain_per_rad;
    out->limit_angle_rad = in->strength_Pa / in->safety_factor / out->stress_per_rad_Pa;
    double x = in->fillet_m / in->width_m;
    bool outside = x < 0.05 || x > 1.0 + 1e-9 ||
                   (in->kind == FW_FLEXURE_CSFH && in->width_m > 0.3 * in->radius_m);
    out->limit_uncertainty = outside ? 0.065 : FW_FLEXURE_STRAIN_UNCERTAINTY;
}

double fw_flexure_default_fillet(const fw_flexure *flexure) {
    double t = flexure->width_m;
    if (flexure->kind != FW_FLEXURE_CSFH) return t;
    return fmin(t, (flexure->radius_m - 0.5 * t) / 3.0);
}
