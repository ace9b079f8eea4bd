/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rigid bodies in a plane, joined by exact beams, and what acts on them.
 * Units um, uN, s, kg (so that uN = kg um/s^2). */
#ifndef JUDGE_MODEL_H
#define JUDGE_MODEL_H

#include "beam.h"

enum { BODIES = 8, FLEXURES = 16, LOADS = 16, UNKNOWNS = 3 * BODIES + 3 * FLEXURES + 3 * LOADS };

struct body {
    double x, y, mass, inertia;
};

enum load_kind {
    LOAD_FORCE,  /* number: px, py, fx, fy */
    LOAD_TORQUE, /* number: torque */
    LOAD_COMB,   /* number: px, py, direction, 1/2 eps0 h n V^2 (uN um), gap, overlap */
    LOAD_SHAKE,  /* number: ax, ay; on all bodies */
    LOAD_HEAT,   /* number: expansion of layer, of substrate, softening per unit; middle */
    LOAD_START,  /* number: vx, vy, omega */
    HOLD_SLIDE,  /* number: dx, dy; the whole pose is given */
    HOLD_ROD,    /* number: px, py, gx, gy, change of length */
    HOLD_TURN    /* number: angle */
};

struct load {
    enum load_kind kind;
    int body;
    double number[8];
};

struct model {
    int bodies;
    struct body body[BODIES + 1]; /* from 1 on; 0 is the ground */
    int flexures;
    struct flexure flexure[FLEXURES];
    int loads;
    struct load load[LOADS];
    double pulse;    /* s: how long a half sine lasts; 0: loads act as steps */
    double duration; /* s: of a motion; 0: loads come slowly */
};

/* Pose of every body: displacement x, y and turn from the drawing. */
struct state {
    double q[3 * (BODIES + 1)];
    double p[3 * FLEXURES]; /* wrenches of the first roots */
    double m[3 * LOADS];    /* forces of what holds */
};

/* 0, or a message on stderr and 1. */
int model_read(const char *path, struct model *model);

/* Place of a point that body k carries; px, py from its centre. */
void model_point(const struct model *model, const double *q, int k, double px, double py,
                 double out[2]);

/* Place of a root in the world for the share of the load that has come. */
void model_root(const struct model *model, const double *q, const struct flexure *f, int which,
                double share, double out[2]);

/* Adds what the loads of the given share put on the bodies to force, 3 for each and the ground. */
void model_loads(const struct model *model, const double *q, double share, double time,
                 double *force);

/* Share of a half sine or step at a time. */
double model_law(const struct model *model, double time);

#endif
