/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion that never leaves an unstable equilibrium: in exact symmetry, as of a load along an arm
   above the buckling load, nothing pushes it off, while the smallest disturbance of a real device
   does. Theory: docs/theory/statics-and-modes.md. */
#ifndef FW_STATICS_STABILITY_H
#define FW_STATICS_STABILITY_H
#include "dynamics/dynamics.h"

typedef struct fw_statics_stability {
    double t_s;        /* where it is most unstable */
    double rate_per_s; /* sqrt(-lowest eigenvalue) there */
    double growth;     /* integral of it over the scene: a disturbance grows by e^growth */
    const char *body;  /* moves most in the motion that becomes free */
    double *angle_rad; /* (npin) of the stable equilibrium that it would fall to, under the loads of
                          t_s; NULL: none was found */
    int pin;           /* with the largest of them, or FW_NONE */
    double share;      /* of the loads that it would bear, by the eigenvalues with and without them;
                          0: it does not stand without them either */
    const char *text;  /* all that in a sentence */
} fw_statics_stability;

enum { FW_STABILITY_MOST = 300 }; /* unknowns: two to twelve dense evaluations of 30 n^3 */
/* what grows less has not left a thousandth of its way when the scene ends */
extern const double fw_statics_stability_growth;

/* Looks along the motion of a scene. *poise is NULL where it is stable, where it has left, and
   where instability lasts too short to grow. Warns with FW-D259; a note says when the mechanism is
   too large to look. FW_OK then too; FW_NOMEM, FW_CANCELLED. */
fw_status fw_statics_stability_find(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                    fw_diags *diags, const fw_statics_stability **stability);

#endif
