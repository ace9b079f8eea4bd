/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One flexure as a geometrically exact (Reissner) beam, shot from its first root to its second.
 * Units um, uN, s, kg. */
#ifndef JUDGE_BEAM_H
#define JUDGE_BEAM_H

enum { FACES = 2 };

/* What a place of the strip has: direction from the first tangent, stiffnesses, and stress of
 * either face per moment. */
struct place {
    double psi;         /* rad, of the unloaded strip */
    double bend;        /* EI with the depth factor, uN um^2 */
    double stretch;     /* EA, uN */
    double shear;       /* k GA, uN */
    double area;        /* um^2 */
    double left, right; /* |stress| per moment of the left and of the right face, 1/um^3 */
};

struct span {
    int steps;           /* of Runge and Kutta */
    double step;         /* um */
    struct place *place; /* 2 steps + 1 of them */
};

struct root {
    double give;        /* rad per moment: dL/EI */
    double left, right; /* |stress| per moment with the fillet's concentration */
    double tension;     /* stress per axial force with the fillet's concentration */
};

struct flexure {
    int a, b;      /* bodies; 0 is the ground */
    double x, y;   /* first root, in the world as drawn */
    double psi;    /* direction of the strip there */
    double bx, by; /* second root, found from the unloaded strip */
    int spans;
    struct span *span;
    struct root root[2];
    double softer; /* factor on all stiffnesses (warmth) */
};

/* The end of the strip under the wrench p = (M0, F1, F2) of its first section, in the frame of
 * the first root. */
struct shot {
    double turn, x, y;   /* of the second root's body against the first's; place of the end */
    double by[3][3];     /* their derivatives by p */
    double moment;       /* of the last section */
    double moment_by[3]; /* its derivatives */
    double worst;        /* largest |stress| of roots and strip, MPa */
    double roots;        /* of the roots alone */
    int at;              /* 0, 1: root; 2: within the strip */
    double signal[4];    /* stress of first left, first right, second left, second right face */
};

void beam_shoot(const struct flexure *f, const double p[3], int stresses, struct shot *out);

/* p such that the end of the strip is where (turn, x, y) say; p is also where the search starts.
 * 0 when found. */
int beam_hold(const struct flexure *f, const double where[3], double p[3], struct shot *out);

/* Solves a x = b of n unknowns in place (rows of a one behind the other); the sign of the
 * determinant, 0 if singular. */
int solve_dense(int n, double *a, double *b);

#endif
