/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inverse kinematics of the six-bar ABCDEF and the hinge rotations over the required workspace. */
#ifndef FW_WORKSPACE_WORKSPACE_H
#define FW_WORKSPACE_WORKSPACE_H
#include "maths/maths_interval.h"
#include "mechanism/mechanism.h"

enum { FW_SIX = 6 };

/* joint rotations (phi_b - phi_a, from the drawn pose) for a platform pose given as displacement of
   its centre of mass and rotation. false: out of reach, *leg is 0 (A-B-C) or 1 (F-E-D). */
bool fw_workspace_six_bar_inverse(const fw_mechanism *mechanism, double x_m, double y_m,
                                  double phi_rad, double angle_rad[FW_SIX], int *leg);

typedef struct fw_workspace_peak {
    double angle_rad;         /* with its sign; certified: the far end of the proved range */
    double error_rad;         /* certified: the truth is at most this much nearer to zero */
    double x_m, y_m, phi_rad; /* where */
} fw_workspace_peak;

typedef struct fw_workspace_extreme { /* a pose, and the range that its joint angle is proved to be
                                         in */
    double pose[3];                   /* x m, y m, phi rad */
    fw_maths_interval angle_rad;
} fw_workspace_extreme;

/* One required box: every pose of it can be assembled on the drawn branch with every hinge's angle
   in `angle_rad`. The tree says how the box was taken apart: a node is x, y or p (halved at 0.5
   (low + high) along that coordinate; lower half first) or . (a leaf, where one enclosure is
   enough). */
typedef struct fw_workspace_proof {
    bool proved;
    double low[3], high[3];                           /* the box: x m, y m, phi rad */
    fw_maths_interval angle_rad[FW_SIX];              /* holds the joint angle at every pose */
    fw_workspace_extreme least[FW_SIX], most[FW_SIX]; /* near the ends of that range */
    const char *tree;
    long boxes; /* looked at */
    int leaves;
} fw_workspace_proof;

/* ---- the strain that the rotations and the joint forces of a required pose make ---- */

/* Volume of the three unit wrenches below which, anywhere in the box, three actuators are no way to hold it */
#define FW_WORKSPACE_HOLDS_WELL 0.02
typedef struct fw_workspace_hold fw_workspace_hold; /* pose_load.h: what may hold the pose */

typedef struct fw_workspace_strain_extreme { /* a pose, what holds it, and the strain there */
    double pose[3];
    int grip; /* of the hold */
    fw_maths_interval strain;
} fw_workspace_strain_extreme;

/* At every pose of the box, whatever holds it, hinge i is strained by at most strain[i]. The tree
   is that of fw_workspace_proof, one of its own. */
typedef struct fw_workspace_strain_proof {
    const fw_workspace_hold *hold; /* NULL: nothing is known of the joint forces */
    bool proved;                   /* else from samples */
    double strain[FW_SIX];         /* 0 where there is no flexure */
    double force_N[FW_SIX];        /* no pose has a larger joint force; of samples the largest */
    double rub_Nm[FW_SIX];         /* and no larger torque of dry friction */
    fw_workspace_strain_extreme most[FW_SIX];
    const char *tree;
    long boxes;
    int leaves;
    const struct fw_workspace_strain_proof
        *also; /* by what is given in another scene; NULL: no more */
} fw_workspace_strain_proof;

/* Joint forces on second bodies, N, world, (n x 6 x 2): in the corners of the box by every grip, and at the worst pose of
   every hinge by its own; of friction with every choice of its signs */
fw_status fw_workspace_forces(fw_arena *arena, const fw_workspace_strain_proof *proof,
                              const double low[3], const double high[3], double **force_N, int *n);
/* what holds the pose that strains the hinge most */
const char *fw_workspace_actuation(const fw_workspace_strain_proof *proof, int hinge);

typedef struct fw_workspace_load { /* of one hinge, the worst over all required boxes */
    bool known;                    /* it is a flexure, and the joint forces can be computed */
    double strain;                 /* certified: proved not to be exceeded */
    double error;                  /* certified: the truth is at most this much less */
    double x_m, y_m, phi_rad;      /* where it is nearly reached, and there: */
    double angle_rad, force_N;
    double most_N;        /* certified: no required pose has a larger joint force */
    double rub_Nm;        /* certified: nor a larger torque of dry friction in this hinge */
    double over_rotation; /* strain over that of the rotation alone */
    /* relative: what poses with hinges that drift and give were found to have beyond `strain`, or
       less; of both together what these may add besides (HUGE_VAL: nothing bounds it), and take away */
    double added, give, relief;
    const char *actuation; /* what holds the pose, the worst that the description allows */
} fw_workspace_load;

/* Of a box that pins do not reach, the pose that is farthest from what its flexures may give: a leg of pins lacks that much
   there, and its three hinges move it by at most so much within their limits. certain: it lacks more; turns: it lacks
   rotation, of which they have gives_rad together. */
typedef struct fw_workspace_beyond {
    bool certain, turns;
    int leg; /* 0: A-B-C, 1: F-E-D */
    double lacks_m, gives_m, gives_rad, pose[3];
} fw_workspace_beyond;

typedef struct fw_workspace_result {
    bool required;              /* the device asks for one in this flow */
    bool reachable;             /* all of it can be assembled */
    bool in_part;               /* not all is reached, for all that is known: peaks are of a part */
    bool certified;             /* interval proof; sampled otherwise */
    double volume_m2_rad;       /* of the required box */
    fw_workspace_beyond beyond; /* a pose out of reach ... */
    int fail_box;               /* ... of this one of the device's boxes; FW_NONE */
    const bool *asked,
        *box_reachable; /* (device->nworkspace) holds in this flow; all of it reachable */
    const fw_workspace_proof *proof;         /* (device->nworkspace) */
    const fw_workspace_strain_proof *strain; /* (device->nworkspace) */
    /* three actuators of the scenes that hold a required box badly, where no three do well, and the volume of their
       unit wrenches at worst; NULL: others hold it */
    const char *badly_by;
    double badly;
    /* acts on the six-bar with a force that poses do not tell; NULL: nothing does */
    const char *unknown;
    /* what scenes state that may strain hinges in a required pose, and that is not counted there; NULL: nothing */
    const char *left_out;
    const char *presses_itself; /* friction that has no bound there: the scene's name; NULL: none */
    fw_workspace_load load[FW_SIX];
    fw_workspace_peak peak[FW_SIX];
} fw_workspace_result;

/* What is kept from one device to the next: proofs of rotations over boxes and where everything is at poses depend on
   where the pins are drawn and how hinges lie, so that devices that differ in the rest have them in common. Compared
   byte by byte. Of one thread at a time; lives as long as its arena; 5 MB. */
typedef struct fw_workspace_kept fw_workspace_kept;
fw_status fw_workspace_kept_new(fw_arena *arena, fw_workspace_kept **kept);
/* kept: where this is looked up and added; NULL: nowhere. The result is the same to the last bit. */
fw_status fw_workspace_required(fw_arena *arena, const fw_mechanism *mechanism,
                                fw_workspace_kept *kept, fw_diags *diags,
                                fw_workspace_result *result);

#endif
