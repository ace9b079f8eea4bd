/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The position problem: poses that satisfy Psi(q, t = 0) = 0, which of several it is, what can
   still move, and why none exists. Everything is repeatable to the byte: no random numbers but
   those of a fixed sequence.

   Theory: docs/theory/assembly.md. */
#ifndef FW_ASSEMBLY_ASSEMBLY_H
#define FW_ASSEMBLY_ASSEMBLY_H
#include "maths/matrix.h"
#include "multibody/model.h"
#include "multibody/system.h"

/* A pose that joints correct by more than this part of the mechanism's size, or a velocity by more
   than this part of the largest, is another start than the one that was stated: what follows from
   it is not an answer to the question (FW-D106, FW-D115). Digits left out when poses were typed are
   far below, another branch is far above. */
static const double fw_assembly_another_start = 0.01;

/* a pin, a joint or a driver, and how far it is from what it asks */
typedef struct fw_assembly_joint_gap {
    const char *id;
    double gap_m, gap_rad;  /* of points or lengths, and of angles; 0 where it asks for none */
    double x_m[2], y_m[2];  /* its points on body a and on body b, world */
    int pin, joint, driver; /* of the mechanism, or FW_NONE */
} fw_assembly_joint_gap;

/* where a body of a dyad is held: a pin, or a prismatic joint */
typedef struct fw_assembly_anchor {
    int pin, joint; /* the other one is FW_NONE */
} fw_assembly_anchor;

/* dyad: pin P between two moving bodies that are held at A (body_a) and B (body_b). Two pins: on
   which side of AB lies P? A pin and a prismatic joint: on which side of the pin, along the axis,
   lies P? */
typedef struct fw_assembly_elbow {
    const char *id; /* of pin P */
    int pin, body_a, body_b;
    fw_assembly_anchor a, b;
    int guess, found; /* sign of the triangle A P B: +1 counter-clockwise, -1, 0: flat */
} fw_assembly_elbow;

typedef struct fw_assembly_rank_result { /* degrees of freedom: unknowns less the rank of G */
    bool known; /* false: more than FW_RANK_MOST unknowns, `dof` counts rows */
    int unknowns, rows, rank, dof;
    double kept, dropped;   /* smallest singular value above the gap, largest below it (0: none),
                               relative to the largest of all */
    bool clear;             /* the gap spans at least a factor of 1e4 */
    const char **redundant; /* (nredundant) joints with a row that others imply, in file order */
    int nredundant;
} fw_assembly_rank_result;
enum { FW_RANK_MOST = 600 };

typedef struct fw_assembly_alternative { /* another assembly */
    double *q;                           /* (3 nbody) SI */
    int *side;                           /* (nelbow) */
    double distance_m;                   /* from the guess, as fw_assembly.distance_m */
} fw_assembly_alternative;
enum { FW_ALTERNATIVES_MOST = 12 };

typedef struct fw_assembly {
    int nbody, ngap, nelbow, nalternative;
    double *before, *after; /* (3 nbody) guess and result: m, rad */
    double *moved_m;        /* (nbody) of the centre of mass */
    double *turned_rad;     /* (nbody) */
    double most_moved_m, most_turned_rad;
    double distance_m;                /* sqrt(sum m (dx^2 + dy^2) + J dphi^2) / sqrt(sum m) */
    fw_assembly_joint_gap *gap;       /* (ngap) pins, joints, drivers in file order, in the guess */
    double gap_before_m, gap_after_m; /* largest; those of angles count with the scene's length */
    int iterations, restarts;
    fw_assembly_elbow *elbow;             /* (nelbow) */
    fw_assembly_alternative *alternative; /* (nalternative) nearest to the guess first */
    bool more;                            /* the search for alternatives ended at its bound */
    fw_assembly_rank_result rank;
} fw_assembly;

/* solves Psi(q) = 0 from the guess q (3 nbody) by damped Newton with mass-weighted steps; *moved_m
   the largest displacement. FW_SOLVER names the joint that cannot close and by how much. */
fw_status fw_assembly_assemble(fw_arena *arena, const fw_mechanism *mechanism, double *q,
                               double *moved_m, fw_diags *diags);

/* the same where elements stand for some pins (released, npin; NULL: for none). Those close, too, where all can; else, as
   where the ground has grown under a stage that is held at both ends, they stay open, evenly, and flexures take that. */
fw_status fw_assembly_assemble_giving(fw_arena *arena, const fw_mechanism *mechanism,
                                      const bool *released, double *q, double *moved_m,
                                      fw_diags *diags);

/* fw_assembly_assemble with everything that is known about the result; q (3 nbody) as there.
   FW_SOLVER as there; then *assembly has before, gap and after: the best that was found. */
fw_status fw_assembly_solve(fw_arena *arena, const fw_mechanism *mechanism, const double *guess,
                            fw_diags *diags, fw_assembly **assembly);

/* a mechanism that stands in its assembled pose: `mechanism` itself when its own pose closes all
   joints to 1e-9 of its size, else a copy, and FW-D115 on how far bodies were moved: a warning
   beyond 1e-6 of the size. *moved_m (may be NULL): the largest displacement. */
fw_status fw_assembly_assembled(fw_arena *arena, const fw_mechanism *mechanism, fw_diags *diags,
                                const fw_mechanism **assembled, double *moved_m);

/* ==== kinematics.c ==== */

/* Velocities, accelerations and forces of a mechanism whose motion is given: by the rates of chosen
   independent coordinates, or by its drivers.

   G v = -Psi_t,  G a = -(G' v + Psi_tt) with v_I, a_I given for the independent coordinates I;
   M a + G^T lambda = Q + E_I tau gives the joint forces and the forces tau that this motion needs.
   Theory: docs/theory/assembly.md. */

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
