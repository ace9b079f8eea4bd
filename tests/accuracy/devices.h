/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random devices and scenes for the survey of --accuracy: those of the test of the bounds
   (six-bars, four-bars, chains, sliders with every effect), rows of bodies with step loads and
   without damping, and rows in which some hinges are up to ten million times as stiff as others. */
#ifndef FW_TESTS_ACCURACY_DEVICES_H
#define FW_TESTS_ACCURACY_DEVICES_H
#include "dynamics/bounds.h"

enum { SURVEY_GROUPS = 6 };
static const char *const survey_groups[SURVEY_GROUPS] = {"six-bar", "four-bar", "chain",
                                                         "slider",  "row",      "stiff"};

/* which of bounds_devices bounds_make takes */
static inline int survey_bounds_kind(uint64_t seed) {
    for (int i = 0; i < 5; i++)
        rig_random(&seed);
    return (int)(4 * rig_random(&seed));
}

/* one hinge or two are stiff, and damped so that what is fast dies away or does not */
static inline void survey_stiffen(rig *r, uint64_t *seed) {
    int count = 1 + (rig_random(seed) < 0.4);
    for (int i = 0; i < count; i++) {
        fw_mechanism_pin *p = &r->m.pin[(int)(r->m.npin * rig_random(seed))];
        double factor = bounds_log(seed, 10, 1e7), zeta = bounds_log(seed, 1e-4, 1);
        p->stiffness_Nm_per_rad *= factor;
        if (rig_random(seed) < 0.7) /* of a body of some 1e-15 kg m^2 about the joint */
            p->damping_Nms_per_rad = 2 * zeta * sqrt(p->stiffness_Nm_per_rad * 5e-15);
    }
}

/* false: it cannot be moved by its loads */
static inline bool survey_device(fw_arena *arena, uint64_t seed, bounds_device *d, int *group) {
    uint64_t own = seed ^ 0x7f4a7c15;
    memset(d, 0, sizeof *d);
    if (seed % 4 < 2) {
        *group = survey_bounds_kind(seed);
        return bounds_make(arena, seed, d);
    }
    *group = seed % 4 == 2 ? 4 : 5;
    d->r = rig_any(arena, own);
    d->omega = 1;
    for (int i = 0; i < 3; i++)
        rig_random(&own);
    if (*group == 5) survey_stiffen(&d->r, &own);
    return true;
}

#endif
