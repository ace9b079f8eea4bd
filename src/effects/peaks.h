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

#endif
