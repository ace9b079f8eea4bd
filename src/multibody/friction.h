/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coulomb friction of joints: what multibody_friction.c (the equations), friction_solve.c (the
   small systems) and stick.c (who sticks) share. Scaled units. Private to multibody/. Theory:
   docs/theory/effects/friction.md. */
#ifndef FW_MULTIBODY_FRICTION_H
#define FW_MULTIBODY_FRICTION_H
#include "multibody/multibody_scratch.h"

typedef struct fw_multibody_friction_state {
    /* held during a step, changed by events */
    int slip;    /* sign of the rate; 0: it sticks */
    bool yields; /* at rest because others hold it, with the largest static torque, against slip */
    double held; /* coordinate at which it came to rest */
    /* what fw_multibody_friction_solve found for these flags */
    double torque, press;
} fw_multibody_friction_state;

struct fw_multibody_frictions {
    int n;
    const fw_multibody_friction_joint *joint; /* (n) the model's */
    fw_multibody_friction_state *item;        /* (n) */
    double *row;              /* (6 n) h of bodies a, b: rate = h.v, generalised force = h T */
    double *bias, *rate;      /* (n) relative acceleration at a = 0; h.v */
    double *accel;            /* (n) relative acceleration without friction */
    double *size;             /* (n) of what that adds up from */
    double *response, *react; /* (n x 3 (nbody + 1)), (n x 2 nblock) a and lambda for unit T */
    double *nothing;          /* (2 nblock) zeros */
    double *gain;             /* (n x n) relative acceleration i for unit T_j */
    double *loose;            /* (n) the same of i for itself if no joint held its bodies */
    double *base, *turn;      /* (2 n), (2 n x n) force that presses at T = 0, for unit T_j */
    double *torque;           /* (n) T, the answer */
    double *left;             /* (n) gain of i for itself while all that stick hold */
    bool *rests, *held;       /* (n) its rate is 0: may stick; it was at rest before */
    /* work of the small system */
    double *factor, *hold, *jacobian, *reach;            /* (n x n); reach (2 n x n) */
    double *start, *right, *more, *step, *press, *value; /* (n), the last two (2 n) */
    double *push, *creep;        /* (n) N but for the joint's force; what pulls back to rest */
    int *stuck, *moving, *pivot; /* (n) */
    /* work of the sorting */
    double *shift, *most, *centre, *before; /* (n) */
    int *side, *free, *inside;              /* (n) */
    bool *slid;                             /* (n) cannot hold */
    double *state;                          /* (ny) a derivative nobody reads */
    double speed;                           /* largest velocity seen: what round-off of a rate is */
    int met, met_slip; /* entry whose flag no longer fitted, and that flag; -1: none */
    int jam;           /* entry without a (single) torque, or -1 */
    int tight;         /* entry next to a jam, or -1 */
    int jammed;        /* the last such entry, kept, and when */
    double jam_time;
};

/* rows, rates, responses and gains for velocities v */
void fw_multibody_friction_respond(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                   const double *v);
/* with the accelerations and multipliers without friction: what presses, and c */
void fw_multibody_friction_evaluate(fw_multibody_system *sys, const fw_multibody_solution *found,
                                    const double *v);
/* both, then torques for the flags that are held, and the solution with them; *lost: the power that
   they take. false: there are none, or perhaps more than one */
bool fw_multibody_friction_apply(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                 const double *v, double *lost);
/* what sticks to rate 0: v */
void fw_multibody_friction_settle(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                  double *v);
/* torques for the present flags; false: there is none, or perhaps more than one */
bool fw_multibody_friction_solve(struct fw_multibody_frictions *s);
/* the joint's own force that presses entry i, and all that does, at the torques found */
void fw_multibody_friction_force(const struct fw_multibody_frictions *s, int i, double force[2]);
double fw_multibody_friction_press(const struct fw_multibody_frictions *s, int i);
/* x of least norm with gain x = right among the `count` entries of `which` (both in that order) */
bool fw_multibody_friction_hold(struct fw_multibody_frictions *s, int count, const int *which);
void fw_multibody_friction_holding(struct fw_multibody_frictions *s, int count, const int *which,
                                   const double *right, double *x);
/* flags and torques of the entries at rest for the limits of the `press` that they
   have; the others keep their torques */
bool fw_multibody_friction_box(struct fw_multibody_frictions *s);
double fw_multibody_friction_coordinate(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                        int i);
/* rows and, by them, rates of v */
void fw_multibody_friction_rows(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v);

#endif
