/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The joint forces that hold a pose of the six-bar, and the strain that they and the rotations make
   in every hinge, over boxes of poses. Private to the room, its tests and the certificate.

   Sections: what a hinge is to the strain. Actuators: what may hold the pose; a grip is three of
   them. Statics: from the pose to the joint forces. */
#ifndef FW_WORKSPACE_POSE_LOAD_H
#define FW_WORKSPACE_POSE_LOAD_H
#include "workspace/jet.h"
#include "workspace/loop.h"

/* ---- sections.c: places along a flexure at which its strain is looked at ---- */

/* strain = bending |K theta - lever.F| + axial |F|, F the joint's force on its second body in the
   frame half turned; N m, N */
typedef struct fw_workspace_station {
    double lever_m[2], bending_per_Nm, axial_per_N;
} fw_workspace_station;

typedef struct fw_workspace_section {    /* of one of the six hinges */
    double spring_Nm_per_rad;            /* what the joint does to its bodies */
    double moment_Nm_per_rad;            /* what bends the flexure: its own stiffness */
    double axis[2];                      /* direction of its axis, as drawn */
    const fw_workspace_station *station; /* (n) */
    int n;                               /* 0: no flexure, no strain */
    int roots;                           /* the first ones; all others are below `inside` */
    fw_workspace_station inside;         /* not looked at where all stations are roots */
} fw_workspace_section;

fw_status fw_workspace_sections(fw_arena *arena, const fw_mechanism *mechanism,
                                fw_workspace_section section[FW_SIX]);

/* ---- actuation.c: what holds a pose ---- */

typedef enum fw_workspace_actuator_kind {
    FW_ACTUATOR_TORQUE,    /* on a body */
    FW_ACTUATOR_FORCE,     /* at a point of a body, in a fixed direction */
    FW_ACTUATOR_TENDON,    /* along a cable through points of bodies */
    FW_ACTUATOR_ELECTRODES /* at a point of a body, in a direction that turns with another */
} fw_workspace_actuator_kind;

typedef struct fw_workspace_body_point {
    int body;        /* 0..4 or FW_GROUND */
    double x_m, y_m; /* world, as drawn */
} fw_workspace_body_point;

/* of size 1 N, or 1 N times the length of the platform */
typedef struct fw_workspace_actuator {
    fw_workspace_actuator_kind kind;
    int body;            /* torque */
    int against;         /* electrodes: the body that the direction turns with */
    double direction[2]; /* unit vector, as drawn */
    const fw_workspace_body_point *point;
    int npoint;
    bool pulls;     /* not the other way round */
    bool platform;  /* a component of the wrench on the platform about its centre of mass */
    const char *id; /* "torque on AB" */
} fw_workspace_actuator;

typedef struct fw_workspace_grip { /* three actuators that hold the pose */
    int actuator[3];
    bool wrench;      /* all three are the platform's wrench */
    const char *name; /* "torque on AB, force on CD" */
} fw_workspace_grip;

/* what is held by what: of one flow */
struct fw_workspace_hold {
    const fw_workspace_loop *loop;
    fw_workspace_section section[FW_SIX];
    fw_geometry_vec2 at[5]; /* point of every body that moments are about, as drawn */
    double length_m;        /* of the platform, C to D: scale of torques */
    const fw_workspace_actuator *actuator;
    int nactuator;
    const fw_workspace_grip *grip;
    int ngrip;
};

/* which grips there are over a box: triples that hold all of it */
fw_status fw_workspace_hold_of(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_workspace_loop *loop, const fw_workspace_box3 *box,
                               fw_workspace_hold *hold);

/* ---- pose_load.c: statics over a box ---- */

typedef struct fw_workspace_response { /* to one actuator, or to the hinges' own moments */
    fw_workspace_jet2 force[FW_SIX];   /* of hinge i on its second body, N */
    fw_workspace_jet wrench[3];        /* that the platform lacks: N, N, N (times length_m) */
    bool on_leg[2];                    /* left, right: force is not 0 there */
} fw_workspace_response;

typedef struct fw_workspace_pose_load {
    double half[3];
    fw_workspace_jet2 turn[5];       /* (cos, sin) of every body's rotation */
    fw_workspace_jet2 a[2], b[2];    /* links of both legs, from the ground up */
    fw_workspace_jet2 to[2];         /* platform's centre of mass to C and D */
    fw_workspace_jet gain[2];        /* 1/(a x b) */
    fw_workspace_jet theta[FW_SIX];  /* joint angles */
    fw_workspace_jet2 frame[FW_SIX]; /* (cos, sin) of every hinge's axis, half turned */
    fw_workspace_response own;       /* to the hinges' moments */
} fw_workspace_pose_load;

/* false: not every pose of the box is known to be reached. shift: what C and D are displaced by
   against the rest of the platform (m, four numbers), or NULL */
bool fw_workspace_pose_load_over(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                                 const double *shift, fw_workspace_pose_load *out);
void fw_workspace_pose_response(const fw_workspace_hold *hold, const fw_workspace_pose_load *at,
                                const fw_workspace_actuator *by, fw_workspace_response *out);
/* Joint forces under one grip. response: (nactuator). false: this grip would have to push where it
   only pulls, all over the box; `certain`: at no pose of it. own: of which legs the forces are what
   they are under a wrench on the platform. */
bool fw_workspace_pose_forces(const fw_workspace_hold *hold, const fw_workspace_pose_load *at,
                              const fw_workspace_response *response, const fw_workspace_grip *grip,
                              bool *certain, bool own[2], fw_workspace_jet2 force[FW_SIX]);
/* range that holds the largest strain of a hinge at every pose of the box, and where in the box it
   grows to (signs of its slope; may be NULL) */
fw_maths_interval fw_workspace_pose_strain(const fw_workspace_hold *hold,
                                           const fw_workspace_pose_load *at, int hinge,
                                           const fw_workspace_jet2 *force, double slope[3]);

/* ---- pose_strain.c: over a whole required box ---- */

/* Bounds of all strains by branch and bound, within `relative` of the truth; FW_UNDECIDED: more
   than `most` boxes. */
fw_status fw_workspace_certify_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                      const fw_workspace_box3 *box, double relative, long most,
                                      fw_workspace_strain_proof *proof,
                                      fw_workspace_proof_end *end);
/* the same from samples; nothing is proved */
fw_status fw_workspace_sample_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                     const fw_workspace_box3 *box,
                                     fw_workspace_strain_proof *proof);
/* What is known of a hinge at its worst pose beside the strain: see fw_workspace_load. */
fw_status fw_workspace_load_of(fw_arena *arena, const fw_workspace_hold *hold,
                               const fw_mechanism *mechanism,
                               const fw_workspace_strain_proof *proof, int hinge,
                               fw_workspace_load *load);

#endif
