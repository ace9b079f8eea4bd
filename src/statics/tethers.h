/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a tether is broken: the probe's force and way, and what hinges bear meanwhile. Linear statics of
   rigid bodies on flexures, and beams of stepped width. Theory: docs/theory/release.md. */
#ifndef FW_STATICS_TETHERS_H
#define FW_STATICS_TETHERS_H
#include "base/json.h"
#include "mechanism/mechanism.h"

typedef struct fw_statics_tether_break {
    double stress_per_N;           /* largest in the tether, Pa/N of the probe */
    bool at_neck;                  /* there; else elsewhere in the finger */
    double force_N, low_N, high_N; /* at the strength, and at either end of its band */
    double move_m;                 /* of the probe, at the strength */
    double hinge_share; /* largest stress of a hinge over the tether's: 1: they break together */
    double hinge_used,
        hinge_most; /* of that hinge's limit, safety factor included: at the strength and at
                                       the upper end of its band */
    int hinge;      /* of the mechanism */
} fw_statics_tether_break;

typedef struct fw_statics_tether {
    const fw_layout_tether *drawn;
    double probe_m; /* from the cut, along the finger: where the probe pushes */
    fw_statics_tether_break first, last; /* all others hold; it is the only one */
    /* how far the body goes towards the finger once it is broken, at most; 0: it does not */
    double toward_m;
    const char *scene; /* in this one */
} fw_statics_tether;

typedef struct fw_statics_tethers {
    const char *why; /* nothing is computed; NULL: it is */
    fw_statics_tether *item;
    int n;
    int keep; /* the one to break last: of all alone it asks least of the hinges */
    bool brittle;
    const char *criterion;
    double strength_Pa, low_Pa, high_Pa;
} fw_statics_tethers;

/* NULL: there are no tethers */
fw_status fw_statics_tethers_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_statics_tethers **out);
/* poses of a motion of these bodies, (nrow x 3 nbody) of centres of mass */
void fw_statics_tethers_watch(const fw_statics_tethers *tethers, const fw_mechanism *mechanism,
                              const char *scene, const double *q, int nrow);
/* a member "tethers" of an open object; nothing where there are none */
void fw_statics_tethers_json(fw_json *json, const fw_mechanism *mechanism,
                             const fw_statics_tethers *tethers);
/* sentences for a run sheet: what to do and what it asks; NULL: there are none */
fw_status fw_statics_tethers_words(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_statics_tethers *tethers, const char **out);

#endif
