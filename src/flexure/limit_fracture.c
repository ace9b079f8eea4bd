/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/limit_kinds.h"
#include <math.h>

/* What breaks: its plain strength, or, where a failure probability P of the whole device is asked
   for, the stress at which one of its n flexures in series breaks with 1 - (1 - P)^(1/n):
     sigma = sigma0 ((A0/A_eff) ln(1/(1 - P))/n)^(1/m)
   source: Weibull (1951), docs/theory/limits-of-materials.md eq. 1-3; test_weibull.c */
bool fw_limit_fracture(const fw_limit_input *in, fw_limits *all, fw_limit *limit) {
    const fw_material *m = in->material;
    const fw_limit_data *d = &m->limit;
    if (!fw_limit_brittle(m)) return false;
    double probability = in->asked->failure_probability;
    bool asked = probability > 0;
    if (fw_limit_known(&d->weibull_strength) && fw_limit_known(&d->weibull_modulus) &&
        fw_limit_known(&d->weibull_area))
        all->weibull =
            (fw_weibull){.known = true,
                         .strength_Pa = d->weibull_strength.value,
                         .modulus = d->weibull_modulus.value,
                         .area_m2 = d->weibull_area.value,
                         .effective_m2 = fw_weibull_area_m2(in->flexure, d->weibull_modulus.value)};
    if (asked && all->weibull.known) {
        const fw_quantity *const used[] = {&d->weibull_strength, &d->weibull_modulus,
                                           &d->weibull_area};
        limit->definition =
            "fracture of one flexure of the device at the failure probability asked "
            "for (Weibull, with the stressed surface)";
        limit->source = d->weibull_strength.source;
        limit->status = fw_limit_weakest(used, 3);
        limit->allowable_Pa =
            fw_weibull_stress_Pa(&all->weibull, fw_series_share(probability, in->nhinge));
        return true;
    }
    if (asked) {
        all->missing = "weibull-strength, weibull-modulus and weibull-area";
        all->missing_place = in->asked->probability_place;
    }
    if (!fw_limit_known(&m->strength)) return false;
    fw_limit_plain(&m->strength, "fracture strength of the material's data, without a probability",
                   limit);
    return true;
}
