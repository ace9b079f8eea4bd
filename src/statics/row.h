/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A row of equilibria while it is followed. Private to statics/. */
#ifndef FW_STATICS_ROW_H
#define FW_STATICS_ROW_H
#include "dynamics/dynamics.h"
#include "statics/rest.h"

typedef struct fw_node { /* an equilibrium: pose and du/dt, scaled */
    double t, *u, *v;    /* (n) */
} fw_node;

typedef struct fw_track { /* largest size of something seen at instants, peaks between them by
                             parabolas */
    double t[2], s[2];    /* the last two */
    int seen;
    double most, value, at, between; /* size, with its sign, time, what the parabola adds */
} fw_track;

typedef struct fw_row {
    fw_rest w;
    const fw_motion_options *options;
    fw_motion *motion;
    double duration, piece_s; /* scaled; s */
    double *end;              /* (npiece) scaled */
    int npiece;
    fw_node from, middle, to;     /* the step */
    double *rate, *guess, *accel; /* (n) work */
    double *angle0;               /* (npin) at the assembled pose */
    double tolerance;             /* of the cubic through the step's ends, relative to the size */
    double size, worst;           /* largest |u| so far; largest miss of a cubic */
    double kinetic, elastic;      /* largest, scaled */
    long solved, evaluated, rejected;
    int row;              /* next sample */
    bool first;           /* no step of this smooth piece yet */
    fw_law_strides *look; /* (nlook) of expressions */
    int *look_row, nlook;
    double law_step_s;                           /* the laws' own longest step */
    double *q, *angle, *reaction, *tie, *driver; /* SI, of one instant */
    fw_track *track;                             /* (channels) or NULL */
    const char *why;                             /* it cannot go on */
} fw_row;

/* row.c: the equilibrium at scaled t nearest to row->guess; the model stays there. FW_SOLVER: there
   is none that Newton's method reaches in a few steps, or it is not stable */
fw_status fw_row_solve(fw_row *r, double t);
/* the step's curve at theta in [0, 1]: degree 5 through three equilibria and their rates. value,
   slope and bend (n) by scaled time; may be NULL */
void fw_row_curve(const fw_row *r, double theta, double *value, double *slope, double *bend);

/* row_look.c: results */
fw_status fw_row_arrays(fw_row *r);
/* at the start of a smooth piece and after every step: peaks, samples, instants */
fw_status fw_row_begin(fw_row *r);
fw_status fw_row_look(fw_row *r);
void fw_row_finish(fw_row *r);

#endif
