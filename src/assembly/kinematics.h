/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocities, accelerations and forces of a mechanism whose motion is given: by the rates of chosen
   independent coordinates, or by its drivers.

   G v = -Psi_t,  G a = -(G' v + Psi_tt) with v_I, a_I given for the independent coordinates I;
   M a + G^T lambda = Q + E_I tau gives the joint forces and the forces tau that this motion needs.
   Theory: docs/theory/assembly.md. */
#ifndef FW_ASSEMBLY_KINEMATICS_H
#define FW_ASSEMBLY_KINEMATICS_H
#include "maths/dense.h"
#include "multibody/system.h"

/* ---- the choice of independent coordinates ---- */

typedef struct fw_assembly_coordinate { /* of a body: 0 x, 1 y, 2 phi */
    int body, axis;
} fw_assembly_coordinate;

typedef struct fw_assembly_coordinate_choice {
    fw_assembly_coordinate *item; /* (count) count = degrees of freedom */
    int count;
    double condition; /* largest scaled velocity of any motion over the rates that give it; >= 1 */
    bool automatic;   /* chosen by pivoting, not asked for */
    const char *text; /* "AB.phi,CD.phi" */
    const char *better; /* the automatic choice where it is ten times better conditioned, or NULL */
    double better_condition;
} fw_assembly_coordinate_choice;

/* space: singular values of the scaled G, of which `rank` count; asked: as in the options, or
   NULL */
fw_status fw_assembly_independent_choose(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_maths_singular *space, int rank,
                                         const char *asked, fw_diags *diags,
                                         fw_assembly_coordinate_choice *choice);
/* N_I (count x count): rows of the null space at the chosen coordinates */
fw_status fw_assembly_independent_rows(fw_arena *arena, const fw_maths_singular *space, int rank,
                                       const fw_assembly_coordinate_choice *choice,
                                       fw_maths_singular *rows);

/* ---- a given motion ---- */

typedef struct fw_assembly_kinematics_options {
    const char *independent; /* "BODY.x|y|phi", comma separated; NULL: chosen by pivoting */
    const double *rate;      /* (nrate) m/s, rad/s; NULL: 0 */
    const double *accel;     /* (naccel) m/s2, rad/s2; NULL: 0 */
    int nrate, naccel;
    double accuracy; /* of the choice of effects; 0: 1e-3 */
    fw_effect_choice effects;
} fw_assembly_kinematics_options;

typedef struct fw_assembly_kinematics { /* at one instant; SI */
    int nbody, npin, njoint, ndriver;
    double t_s;
    fw_assembly_coordinate_choice independent;
    double *rate, *accel, *drive; /* (independent.count); drive: force or torque it needs */
    double *q, *v, *a;            /* (3 nbody) */
    double *reaction_N;           /* (2 npin) on body b, world axes */
    double *joint_N;              /* (3 njoint) as fw_dynamics_motion.tie_N */
    double *driver_N;             /* (ndriver) */
    bool unique; /* false: redundant rows share the joint forces; those of least norm are shown */
} fw_assembly_kinematics;

/* at t = 0 in the assembled pose q (3 nbody). scene NULL: no loads. FW_USAGE (FW-D117) for a choice
   that does not fit, with one that does; FW_LIMIT beyond FW_KINEMATICS_MOST unknowns. */
enum { FW_KINEMATICS_MOST = 600 };
fw_status fw_assembly_kinematics_solve(fw_arena *arena, const fw_mechanism *mechanism,
                                       const fw_device_scene *scene, const double *q,
                                       const fw_assembly_kinematics_options *options,
                                       fw_diags *diags, const fw_assembly_kinematics **result);

/* a mechanism that its drivers move (no degree of freedom left): `samples` instants evenly over the
   scene, each with q, v, a and forces. FW_SOLVER when it cannot follow its drivers (FW-D118). */
fw_status fw_assembly_kinematics_follow(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_device_scene *scene, const double *q, int samples,
                                        const fw_assembly_kinematics_options *options,
                                        fw_diags *diags, const fw_assembly_kinematics **result);

#endif
