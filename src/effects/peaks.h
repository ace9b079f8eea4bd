/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far every hinge is deflected at most in the linear motion of a scene, from below and from
   above. Private to the room: for comparing two linear mechanisms under the same loads. */
#ifndef FW_EFFECTS_PEAKS_H
#define FW_EFFECTS_PEAKS_H
#include "effects/modal.h"

typedef struct fw_effects_peaks {
    double *low, *high; /* (npin) rad: the largest |deflection| lies between */
    double *still;      /* (npin) rad: the largest |deflection| along the equilibria of the loads */
    double *ring;       /* (modes) largest |q| about the equilibria */
    double *late;       /* (modes) what breaks and bends of the loads behind the start add to it */
    double *rapid_rad;  /* (npin) modes too fast for the grid: their rings, of sizes */
    const char *why_not;
} fw_effects_peaks;

/* modal forces that depend on the motion: force (modes) at modal coordinates q under loads `load`
   (modes). Straight in every cell, to second order in it */
typedef struct fw_effects_peaks_source {
    void (*at)(void *data, const double *q, const double *load, double *force);
    void *data;
    const double *late; /* (modes) of the motion without them */
} fw_effects_peaks_source;

/* `source`: NULL without. `fastest_rad_per_s`: modes up to there are followed, others enter with
   the size of their ring, at most `amplitude` (modes; NULL: not known) */
fw_status fw_effects_peaks_find(fw_arena *arena, const fw_effects_modal *modal,
                                const fw_effects_modal_loads *modal_loads, double fastest_rad_per_s,
                                const double *amplitude, const fw_effects_peaks_source *source,
                                fw_effects_peaks *peaks);

/* What of hinges is not linear, as forces on the modes of the linear motion: along a motion, and
   how much of it the rings of fast modes leave open. Private to the room. */

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
