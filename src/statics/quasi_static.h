/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sequence of equilibria while it is followed. Private to statics/. */
#ifndef FW_STATICS_QUASI_STATIC_H
#define FW_STATICS_QUASI_STATIC_H
#include "dynamics/dynamics.h"
#include "statics/statics_equilibrium.h"

typedef struct fw_statics_node { /* an equilibrium: pose and du/dt, scaled */
    double t, *u, *v;            /* (n) */
} fw_statics_node;

/* largest size of something seen at instants, peaks between them by parabolas */
typedef struct fw_statics_track {
    double t[2], s[2]; /* the last two */
    int samples;
    double most, value, at, between; /* size, with its sign, time, what the parabola adds */
} fw_statics_track;

typedef struct fw_statics_quasi_static {
    fw_statics_equilibrium w;
    const fw_dynamics_motion_options *options;
    fw_dynamics_motion *motion;
    double duration, piece_s; /* scaled; s */
    double *end;              /* (npiece) scaled */
    int npiece;
    fw_statics_node from, middle, to; /* the step */
    double *rate, *guess, *accel;     /* (n) work */
    double *angle0;                   /* (npin) at the assembled pose */
    double tolerance;        /* of the cubic through the step's ends, relative to the size */
    double size, worst;      /* largest |u| so far; largest miss of a cubic */
    double kinetic, elastic; /* largest, scaled */
    long solved, evaluated, rejected;
    int row;                       /* next sample */
    bool first;                    /* no step of this smooth piece yet */
    fw_quantity_law_strides *look; /* (nlook) of expressions */
    int *look_row, nlook;
    double law_step_s;                                     /* the laws' own longest step */
    double *q, *angle, *reaction, *joint, *driver, *speed; /* SI, of one instant */
    double *piece_q;         /* (FW_PIECE_NODES x 3 nbody) of one step */
    fw_statics_track *track; /* (channels) or NULL */
    const char *why;         /* it cannot go on */
} fw_statics_quasi_static;

/* quasi_static_step.c: the equilibrium at scaled t nearest to row->guess; the model stays there.
   FW_SOLVER: there is none that Newton's method reaches in a few steps, or it is not stable */
fw_status fw_statics_quasi_static_solve(fw_statics_quasi_static *r, double t);
/* the step's curve at theta in [0, 1]: degree 5 through three equilibria and their rates. value,
   slope and bend (n) by scaled time; may be NULL */
void fw_statics_quasi_static_curve(const fw_statics_quasi_static *r, double theta, double *value,
                                   double *slope, double *bend);

/* by how much the cubic through the step's ends misses its middle */
double fw_statics_quasi_static_miss(const fw_statics_quasi_static *r);
/* where a piece begins: loads may have jumped, so that the nearest minimum is looked for. It goes
   to `from` */
fw_status fw_statics_quasi_static_land(fw_statics_quasi_static *r, double t);
/* from `from` to t; middle and end go to `middle` and `to` */
fw_status fw_statics_quasi_static_step(fw_statics_quasi_static *r, double t);

/* quasi_static_record.c: results */
fw_status fw_statics_quasi_static_arrays(fw_statics_quasi_static *r);
/* at the start of a smooth piece and after every step: peaks, samples, instants */
fw_status fw_statics_quasi_static_begin(fw_statics_quasi_static *r);
fw_status fw_statics_quasi_static_record(fw_statics_quasi_static *r);
void fw_statics_quasi_static_finish(fw_statics_quasi_static *r);

#endif
