/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed loop of the six-bar: its angles for a pose, with bounds over boxes of poses, the proof
   that every pose of a box is reached, and the volume a plane cuts of a box. */
#ifndef FW_WORKSPACE_LOOP_H
#define FW_WORKSPACE_LOOP_H
#include "maths/maths_interval.h"
#include "workspace/workspace.h"

/* ---- angles for a pose ---- */
/* The six-bar as two dyads, set up once per mechanism. Private to the room and its tests. */

typedef struct fw_workspace_dyad {
    fw_geometry_vec2 base;        /* A or F, m */
    double l_m, m_m;              /* link lengths, from the base outward */
    double alpha0_rad, beta0_rad; /* direction of the first link, elbow angle, as drawn */
    double sign;                  /* assembly branch: sign of the elbow angle */
} fw_workspace_dyad;

typedef struct fw_workspace_six_bar {
    fw_workspace_dyad left, right; /* A-B-C and F-E-D */
    fw_geometry_vec2 centre;       /* platform's centre of mass as drawn */
    fw_geometry_vec2 to_c, to_d;   /* from it to C and D */
    double start_rad[FW_SIX];      /* joint angles as drawn */
} fw_workspace_six_bar;

bool fw_workspace_six_bar_set_up(const fw_mechanism *mechanism, fw_workspace_six_bar *out);
bool fw_workspace_six_bar_solve(const fw_workspace_six_bar *six_bar, double x_m, double y_m,
                                double phi_rad, double angle_rad[FW_SIX], int *leg);
/* id of the joint or driver that takes freedom from the platform, NULL when there is none */
fw_status fw_workspace_six_bar_foreign_joint(fw_arena *arena, const fw_mechanism *mechanism,
                                             const char **id);

/* ---- over boxes of poses ---- */
/* The six-bar over a whole box of poses or of joint rotations, with proved bounds. Private to the
   room, to its tests and to what writes its certificate.

   Hinges count A..F as everywhere; inside this header the six rotations are those of the legs'
   convention, from the ground up: A, B, C of the left leg and D, E, F of the right one, where the
   joint angle of the engine is sense[i] psi_i + start_i, sense +1 for A, B, C and -1 for D, E, F.
 */

typedef struct fw_workspace_centred2 {
    fw_maths_centred x, y;
} fw_workspace_centred2;

/* from the ground up, as drawn; the mechanism is what these doubles say */
typedef struct fw_workspace_leg {
    fw_geometry_vec2 base;   /* A or F, m */
    fw_geometry_vec2 a, b;   /* base to elbow, elbow to platform hinge, m */
    fw_geometry_vec2 to;     /* from the platform's centre of mass to that hinge, m */
    double sign;             /* of the elbow's cross product a x b: the assembly branch */
    fw_maths_centred a2, b2; /* squared lengths, m2 */
} fw_workspace_leg;

typedef struct fw_workspace_loop {
    fw_workspace_leg leg[2]; /* A-B-C, F-E-D */
    fw_geometry_vec2 centre; /* platform's centre of mass as drawn, m */
    double start_rad[FW_SIX];
} fw_workspace_loop;

typedef struct fw_workspace_box3 {
    double lo[3], hi[3];
} fw_workspace_box3;

/* value at the middle + grad.d within +- rest, for every d of the box */
typedef struct fw_workspace_form {
    fw_maths_interval at;
    double grad[3], rest;
} fw_workspace_form;

typedef enum fw_workspace_reached {
    FW_REACHED,
    FW_OUT_OF_REACH,
    FW_MAY_BE_OUT
} fw_workspace_reached;

typedef struct fw_workspace_loop_box {   /* what is known of a box */
    fw_workspace_form d2[2];             /* squared reach of both legs, m2 */
    fw_workspace_form psi[FW_SIX];       /* rotation of every hinge from the drawn pose, rad */
    fw_workspace_centred2 hinge[FW_SIX]; /* where the hinges are, m */
    fw_maths_centred cross[2]; /* a x b of both legs, m2: 0 where the leg is stretched or folded */
    fw_workspace_centred2 place; /* of the platform's centre of mass from the drawn one, m */
    fw_maths_centred phi;        /* rotation of the platform, rad */
    fw_workspace_form extent[3]; /* of x, y, phi; joint boxes only */
    int leg;                     /* that is out of reach */
    fw_workspace_reached reached;
} fw_workspace_loop_box;

/* false: the drawn pose has no branch (a leg stretched or folded) or it is no six-bar */
bool fw_workspace_loop_set_up(const fw_mechanism *mechanism, fw_workspace_loop *loop);

/* range of psi_i for a range of the engine's joint angle */
fw_maths_interval fw_workspace_loop_psi_range(const fw_workspace_loop *loop, int hinge,
                                              fw_maths_interval angle);
fw_maths_interval fw_workspace_loop_angle_range(const fw_workspace_loop *loop, int hinge,
                                                fw_maths_interval psi);

/* poses: x, y (m) and phi (rad) from the drawn one; `middle` and the half widths are chosen so that
   the box lies within middle +- half */
void fw_workspace_loop_pose_box(const fw_workspace_loop *loop, const fw_workspace_box3 *box,
                                fw_workspace_loop_box *out);
/* What is wanted of a box of rotations: D and F their psi, E the reach of the right leg, which
   stands for its psi; BRANCH whether that leg can be there at all; REST everything else but the
   rotations of A, B, C, phi, the left leg's cross product and D's place, which always come. What is
   not wanted is not set; without D, F, BRANCH and REST a box is called reached unseen. */
enum {
    FW_WANT_C = 1 << 2,
    FW_WANT_D = 1 << 3,
    FW_WANT_E = 1 << 4,
    FW_WANT_F = 1 << 5,
    FW_WANT_BRANCH = 1 << 6,
    FW_WANT_REST = 1 << 7,
    FW_WANT_LIMITS = FW_WANT_C | FW_WANT_D | FW_WANT_E | FW_WANT_F | FW_WANT_BRANCH,
    FW_WANT_ALL = FW_WANT_LIMITS | FW_WANT_REST
};
/* rotations of A, B, C (rad). Where d2 of the right leg is wanted and certain to be outside of
   `d2_m2`, the box is called out of reach and nothing more is computed. */
void fw_workspace_loop_joint_box(const fw_workspace_loop *loop, const fw_workspace_box3 *box,
                                 fw_maths_interval d2_m2, unsigned wanted,
                                 fw_workspace_loop_box *out);
/* rotations of A and B (rad) with the platform at the rotation phi; box[2] is not used */
void fw_workspace_loop_slice_box(const fw_workspace_loop *loop, const fw_workspace_box3 *box,
                                 double phi_rad, fw_maths_interval d2_m2, unsigned wanted,
                                 fw_workspace_loop_box *out);

/* a x b of the left leg, m2, for rotations of B within c +- half */
fw_maths_centred fw_workspace_loop_left_cross(const fw_workspace_loop *loop, double c, double half);

/* range of a form over the box with these half widths */
static inline fw_maths_interval fw_form_range(const fw_workspace_form *f, const double half[3]) {
    double reach = 0.0;
    for (int i = 0; i < 3; i++)
        reach += fabs(f->grad[i]) * half[i];
    reach = fw_grown(reach + f->rest);
    return (fw_maths_interval){fw_down(f->at.lo - reach), fw_up(f->at.hi + reach)};
}

static inline double fw_box3_middle(const fw_workspace_box3 *box, int axis, double *half) {
    double c = 0.5 * (box->lo[axis] + box->hi[axis]);
    double up = box->hi[axis] - c, down = c - box->lo[axis];
    *half = fw_up(up > down ? up : down);
    return c;
}

/* ---- every pose of a box ---- */

typedef enum fw_workspace_proof_end { FW_PROVED, FW_REFUTED, FW_UNDECIDED } fw_workspace_proof_end;

/* FW_REFUTED: the mechanism cannot be assembled at `pose`. Ends of ranges are within `relative` of
   the truth. FW_UNDECIDED: more than `most` boxes, or boxes that cannot be halved any more. */
fw_status fw_workspace_certify_box(fw_arena *arena, const fw_workspace_loop *loop,
                                   const fw_workspace_box3 *box, double relative, long most,
                                   fw_workspace_proof *proof, double pose[3],
                                   fw_workspace_proof_end *end);

/* ---- the part of a box on one side of a plane ---- */

/* share of the box |d_i| <= 1 with p[0] d_0 + p[1] d_1 + p[2] d_2 <= t; p >= 0, in any order; p = 0
   stands for a dimension less. The interval holds the exact share. */
fw_maths_interval fw_workspace_cut_share(const double p[3], double t);

#endif
