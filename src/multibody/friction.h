/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coulomb friction of joints: what multibody_friction.c (the equations) and stick.c (who sticks)
   share.
   Private to multibody/. Theory: docs/theory/effects/friction.md. */
#ifndef FW_MULTIBODY_FRICTION_H
#define FW_MULTIBODY_FRICTION_H
#include "multibody/model.h"

typedef struct fw_multibody_model_friction { /* scaled */
    int a, b;                                /* bodies */
    int block;          /* of the joint; FW_NONE: an element stands for the pin */
    bool slides;        /* along a prismatic joint; else it turns about a pin */
    int element;        /* what presses, or FW_NONE: the joint's own force */
    double rest, slide; /* coefficient times radius (travel: 1), static and kinetic */
    double preload;
    const char *id;
    fw_place place;
    /* held during a step, changed by events */
    int slip;    /* sign of the rate; 0: it sticks */
    bool yields; /* at rest because others hold it, with the largest static torque, against slip */
    double held; /* coordinate at which it came to rest */
    /* at the last evaluation */
    double torque, press;
} fw_multibody_model_friction;

struct fw_multibody_frictions {
    int n;
    fw_multibody_model_friction *item; /* (n) */
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
    /* work of the sorting: */
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

/* rows, rates, responses and gains at the pose and factor of the model; velocities of y */
void fw_multibody_friction_respond(fw_multibody_model *m, const double *y);
/* with the accelerations and multipliers without friction in the model: what presses, and c */
void fw_multibody_friction_evaluate(fw_multibody_model *m, double t, const double *y);
/* torques for the present flags; false: there is none, or perhaps more than one */
bool fw_multibody_friction_solve(fw_multibody_model *m);
/* the joint's own force that presses entry i, and all that does, at the torques found */
void fw_multibody_friction_force(const fw_multibody_model *m, int i, double force[2]);
double fw_multibody_friction_press(const fw_multibody_model *m, int i);
/* x of least norm with gain x = right among the `count` entries of `which` (both in that order) */
bool fw_multibody_friction_hold(struct fw_multibody_frictions *s, int count, const int *which);
void fw_multibody_friction_holding(struct fw_multibody_frictions *s, int count, const int *which,
                                   const double *right, double *x);
/* friction_box.c: flags and torques of the entries at rest for the limits of the `press` that they
   have;
   the others keep their torques */
bool fw_multibody_friction_box(struct fw_multibody_frictions *s);
double fw_multibody_friction_coordinate(const fw_multibody_model *m, int i, const double *u);
void fw_multibody_friction_rates(fw_multibody_model *m, const double *v);
void fw_multibody_friction_rows(fw_multibody_model *m, const double *y); /* posed */

#endif
