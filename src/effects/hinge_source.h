/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of hinges is not linear, as forces on the modes of the linear motion: along a motion, and
   how much of it the rings of fast modes leave open. Private to the room. */
#ifndef FW_EFFECTS_HINGE_SOURCE_H
#define FW_EFFECTS_HINGE_SOURCE_H
#include "effects/peaks.h"

/* what a hinge does besides: its opening along e and n as drawn (m), a torque on its rotation, and
   one on the turn of both bodies (N m) */
enum { FW_HINGE_PARTS = 4 };

typedef struct fw_effects_hinge_source {
    const fw_mechanism_hinge *hinge;
    double sense;               /* 1 where body a has the root at -a, else -1 */
    double *pull_e, *pull_n;    /* (modes) N: force on b along e and n */
    double *turn, *both;        /* (modes) of the pin, of both bodies together */
    double ring_N[2];           /* what the fast modes may add to its force along e and n */
    double softness_m_per_N[2]; /* as drawn */
    fw_flexure_hinge_rest rest;
    /* largest over the motion so far of what those rings add: in step with them, and for good */
    double wave[FW_HINGE_PARTS], lasting[FW_HINGE_PARTS];
} fw_effects_hinge_source;

typedef struct fw_effects_hinge_sources {
    const fw_effects_modal *modal;
    fw_effects_hinge_source *item;
    int count, slow; /* modes below `slow` are the motion; the others follow the loads at rest */
    /* largest over the motion so far: (modes) force; (npin) rad, answer at rest of the others */
    double *force, *rapid_rad;
} fw_effects_hinge_sources;

/* `ring` (modes): largest |q| of the rings */
fw_status fw_effects_hinge_sources_new(fw_arena *arena, const fw_effects_modal *modal, int slow,
                                       const double *ring, fw_effects_hinge_sources *sources);
/* force (modes) at modal coordinates q under modal loads `load`; an fw_effects_peaks_source */
void fw_effects_hinge_sources_at(void *sources, const double *q, const double *load, double *force);
/* softness as drawn, and what does not depend on the rotation */
void fw_effects_hinge_source_of(const fw_mechanism_hinge *hinge, fw_effects_hinge_source *source);
/* the parts at a rotation, with both bodies turned by `turned_rad` on average, under the force (fe,
   fn) that it carries, along e and n as drawn */
void fw_effects_hinge_source_parts(const fw_effects_hinge_source *source, double rotation_rad,
                                   double turned_rad, double fe_N, double fn_N, double *part);
/* force on a mode by one unit of a part */
double fw_effects_hinge_source_mode(const fw_effects_hinge_source *source, int part, int mode);

#endif
