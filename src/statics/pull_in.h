/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The voltage at which comb drives lose their equilibrium. Theory:
   docs/theory/effects/comb-drive.md. */
#ifndef FW_STATICS_PULL_IN_H
#define FW_STATICS_PULL_IN_H
#include "statics/statics.h"

typedef enum fw_statics_pull_in_kind {
    FW_PULL_IN_NONE, /* stable as far as the voltage could be followed */
    FW_PULL_IN_FOLD, /* the rotor goes on along the drive */
    FW_PULL_IN_SIDE, /* across it, out of the middle */
    FW_PULL_IN_TILT  /* turns out of it */
} fw_statics_pull_in_kind;
const char *fw_statics_pull_in_kind_text(fw_statics_pull_in_kind kind); /* "fold" */

typedef struct fw_statics_pull_in {
    fw_statics_pull_in_kind kind;
    bool bifurcation; /* else the equilibrium turns back there */
    const char *comb; /* the drive whose field takes most of the stiffness that is lost */
    fw_place place;   /* of it in the file */
    double voltage_V; /* of it; NONE: stable at least up to here, infinite: always */
    double largest_V; /* of it in the scene */
    double margin;    /* voltage over largest; below 1 the scene's equilibrium does not exist */
    double where[3];  /* of its rotor: along, across (m), tilt (rad) */
    /* of its capacitance, relative, that is left out at most (fw_effects_comb_fringe) */
    double fringe;
    const char *body;  /* moves most in the motion that becomes free; NULL: NONE */
    double *q, *shape; /* (3 nbody) pose in SI; motion, its largest part 1; NULL: NONE */
    const char *why;   /* NONE: what ended it */
} fw_statics_pull_in;

/* margin below which it may not hold: fringe fields, which are left out, raise C and so the force
   by up to `fringe`, and it goes with V^2: sqrt(1 + fringe) */
double fw_statics_pull_in_margin(const fw_statics_pull_in *p);
/* the static voltage lies above the scene's: electrodes that touch all the same were thrown there
   (dynamic pull-in) */
bool fw_statics_pull_in_dynamic(const fw_statics_pull_in *p);
/* what electrodes that touched have to do with the static pull-in voltage, a sentence; NULL:
   memory */
const char *fw_statics_pull_in_explain(fw_arena *arena, const fw_statics_pull_in *p);

enum { FW_PULL_IN_MOST = 150 }; /* unknowns: some hundred dense evaluations of 30 n^3 */

/* All combs at their largest voltages of the scene times sqrt(s), other loads and drivers in full
   as they are at its end, from s = 0 to the first loss of stability. *found is NULL for a scene
   without comb drives. Warns with FW-D248 when the scene's voltage is beyond, or within the share
   of fringe fields, with FW-D249 when it could not be followed up to the scene's voltage. FW_OK
   then too; FW_NOMEM, FW_CANCELLED. */
fw_status fw_statics_pull_in_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_device_scene *scene, const fw_effect_choice *effects,
                                  fw_diags *diags, const fw_statics_pull_in **found);

#endif
