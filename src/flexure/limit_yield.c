/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/limit_kinds.h"
#include <math.h>
#include <string.h>

/* 0.2 % offset of a film of thickness t: A + B (t/1 um)^-n, up to the thickness that the law was
   found for. in: Pa, Pa, 1, t m; out: Pa; source: Yu and Spaepen (2004) for copper on polymer;
   test_limits.c film_law */
static bool film(const fw_limit_input *in, fw_quantity *offset) {
    const fw_limit_data *d = &in->material->limit;
    const fw_quantity *const used[] = {&d->film_yield, &d->film_yield_rise, &d->film_exponent,
                                       &d->film_thickest};
    double t = in->flexure->depth_m;
    for (int i = 0; i < 4; i++)
        if (!fw_limit_known(used[i])) return false;
    if (!(t <= d->film_thickest.value)) return false;
    *offset = d->film_yield;
    offset->value += d->film_yield_rise.value * pow(t / 1e-6, -d->film_exponent.value);
    offset->status = fw_limit_weakest(used, 4);
    return true;
}

static bool from_device(const fw_quantity *q) {
    return fw_limit_known(q) && q->source && strcmp(q->source, "device file") == 0;
}

/* What yields, for position accuracy: the proportional limit. It is, in this order, factor x the
   0.2 % offset value that the device file states, or that the thickness law gives; the material's
   own strength, unless that is of fracture; factor x the material's 0.2 % offset. For survival: the
   0.2 % offset itself, and where only a strength is known that. */
bool fw_limit_yield(const fw_limit_input *in, fw_limits *all, fw_limit *limit) {
    (void)all;
    const fw_material *m = in->material;
    const fw_limit_data *d = &m->limit;
    fw_quantity offset = d->offset_yield;
    bool own = from_device(&d->offset_yield), law = !own && film(in, &offset);
    bool have = fw_limit_known(&offset);
    bool strength = !fw_limit_brittle(m) && fw_limit_known(&m->strength);
    if (in->asked->survival && have) {
        fw_limit_plain(&offset,
                       law ? "0.2 % offset yield of a film this thick (survival only)"
                           : "0.2 % offset yield (survival only)",
                       limit);
        return true;
    }
    if (have && (own || law || !strength) && fw_limit_known(&d->proportional_factor)) {
        const fw_quantity *const used[] = {&offset, &d->proportional_factor};
        fw_limit_plain(&offset,
                       law ? "proportional limit, a share of the 0.2 % offset yield of a film this "
                             "thick"
                           : "proportional limit, a share of the 0.2 % offset yield",
                       limit);
        limit->allowable_Pa *= d->proportional_factor.value;
        limit->status = fw_limit_weakest(used, 2);
        return true;
    }
    if (!strength) return false;
    fw_limit_plain(&m->strength, "strength of the material's data, taken as proportional limit",
                   limit);
    return true;
}
