/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small motions about a pose: M u'' + C u' + K u = 0 on the motions that the joints allow, with the
   exact tangent K (geometric stiffness and joint forces included). Theory:
   docs/theory/statics-and-modes.md. */
#ifndef FW_STATICS_MODES_H
#define FW_STATICS_MODES_H
#include "statics/statics.h"

typedef struct fw_statics_mode_options {
    fw_effect_choice effects; /* "auto" is taken as "all": nothing is left out */
    bool at_equilibrium;      /* about the equilibrium under the scene's loads; else about rest:
                                 the assembled pose, drivers at their start, without the loads */
    double accuracy;          /* of the hinges' level, where auto chooses it; 0: 1e-3 */
    int drawn;                /* for so many modes frames are made */
} fw_statics_mode_options;

typedef enum fw_statics_mode_kind {
    FW_MODE_OSCILLATION,
    FW_MODE_OVERDAMPED, /* two real decaying eigenvalues */
    FW_MODE_FREE,       /* no stiffness: a rigid motion that nothing holds */
    FW_MODE_UNSTABLE    /* grows */
} fw_statics_mode_kind;
const char *fw_statics_mode_kind_text(fw_statics_mode_kind kind);

enum { FW_MODE_FRAMES = 25 }; /* one period, first and last the same */

typedef struct fw_statics_mode {
    fw_statics_mode_kind kind;
    double omega_rad_per_s, f_Hz;  /* undamped; 0 where there is none */
    double stiffness_per_s2;       /* omega^2, below 0 when unstable */
    double eigenvalue_per_s[2][2]; /* damped, re and im: a conjugate pair (im > 0 first), or two
                                      real ones, the larger first */
    double damping_ratio;          /* -re / |eigenvalue|; NaN for free and unstable motions */
    double modal_mass_kg_m2;       /* of the undamped shape as normalised below */
    double *shape;                 /* (3 nbody) undamped, m and rad per unit; the largest of
                                      |rotation| and |displacement| / unit_length_m is 1 */
    double *damped;                /* (6 nbody) shape of eigenvalue_per_s[0]: real, then imaginary
                                      parts, normalised likewise and with the largest entry real */
    const char *body;              /* moves most; `bodies`: all that take part */
    const char *bodies;
    double *frame; /* (FW_MODE_FRAMES x 3 nbody) m, rad: one period at a visible amplitude, joints
                      closed; NULL beyond `drawn` */
} fw_statics_mode;

typedef struct fw_statics_modes {
    int nbody, npin, count; /* count = degrees of freedom */
    bool at_equilibrium;
    double *q;             /* (3 nbody) the pose */
    double unit_length_m;  /* of the shapes */
    fw_statics_mode *mode; /* (count) by stiffness: unstable, free, then slow to fast */
    double out_of_rest;    /* what a Newton step to equilibrium would move at most, rad or unit
                             lengths; 0 within round-off at an equilibrium, infinite: there is
                             none */
    /* Relative, of every frequency: what the next model of the hinges changes, and half of the error
       of a flexure's stiffness against solids (0 where all are stated), since a frequency goes with
       the root of it. Masses are taken as exact. NaN: not known, infinite never; 0: no flexures */
    double frequency_error, stiffness_error;
    fw_statics_row_rank rank;
    fw_effect_ledger ledger;
} fw_statics_modes;

/* FW_SOLVER: no equilibrium (FW-D111), or the eigenvalues were not found */
fw_status fw_statics_small_motions(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_device_scene *scene,
                                   const fw_statics_mode_options *options, fw_diags *diags,
                                   const fw_statics_modes **modes);

#endif
