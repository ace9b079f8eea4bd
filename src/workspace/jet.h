/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A quantity over a box of poses with its derivatives by x, y and phi, all four in centred form, so
   that what is made of many operations is still bounded to second order in the size of the box.
   Private to the room and its tests. */
#ifndef FW_WORKSPACE_JET_H
#define FW_WORKSPACE_JET_H
#include "maths/maths_interval.h"

typedef struct fw_workspace_jet {
    fw_maths_centred v, d[3];
} fw_workspace_jet;

typedef struct fw_workspace_jet2 {
    fw_workspace_jet x, y;
} fw_workspace_jet2;

static inline fw_workspace_jet fw_jet_exact(double x) {
    return (fw_workspace_jet){.v = {x, 0.0, 0.0}};
}

static inline fw_workspace_jet fw_jet_add(fw_workspace_jet a, fw_workspace_jet b) {
    a.v = fw_centred_add(a.v, b.v);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_add(a.d[i], b.d[i]);
    return a;
}

static inline fw_workspace_jet fw_jet_sub(fw_workspace_jet a, fw_workspace_jet b) {
    a.v = fw_centred_sub(a.v, b.v);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_sub(a.d[i], b.d[i]);
    return a;
}

static inline fw_workspace_jet fw_jet_scaled(fw_workspace_jet a, double k) {
    a.v = fw_centred_scaled(a.v, k);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_scaled(a.d[i], k);
    return a;
}

static inline fw_workspace_jet fw_jet_negated(fw_workspace_jet a) {
    a.v = fw_centred_negated(a.v);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_negated(a.d[i]);
    return a;
}

static inline fw_workspace_jet fw_jet_mul(fw_workspace_jet a, fw_workspace_jet b) {
    fw_workspace_jet c = {.v = fw_centred_mul(a.v, b.v)};
    for (int i = 0; i < 3; i++)
        c.d[i] = fw_centred_add(fw_centred_mul(a.d[i], b.v), fw_centred_mul(a.v, b.d[i]));
    return c;
}

static inline fw_workspace_jet fw_jet_inverse(fw_workspace_jet a) {
    fw_workspace_jet c = {.v = fw_centred_inverse(a.v)};
    fw_maths_centred slope = fw_centred_negated(fw_centred_mul(c.v, c.v));
    for (int i = 0; i < 3; i++)
        c.d[i] = fw_centred_mul(slope, a.d[i]);
    return c;
}

static inline fw_workspace_jet fw_jet_sqrt(fw_workspace_jet a) {
    fw_workspace_jet c = {.v = fw_centred_sqrt(a.v)};
    fw_maths_centred slope = fw_centred_scaled(fw_centred_inverse(c.v), 0.5);
    for (int i = 0; i < 3; i++)
        c.d[i] = fw_centred_mul(slope, a.d[i]);
    return c;
}

/* |f(c + s d) - f(c)| <= s sum |d_i| max |f_i'|: linear in s, as centred forms ask */
static inline double fw_jet_reach(const fw_workspace_jet *a, const double half[3]) {
    double reach = 0.0;
    for (int i = 0; i < 3; i++)
        reach += half[i] * (fabs(a->d[i].m) + a->d[i].r);
    return fw_grown(fw_grown(reach) + a->v.e);
}

/* the smaller of both radii: that of the operations, and that of the derivatives */
static inline fw_workspace_jet fw_jet_tight(fw_workspace_jet a, const double half[3]) {
    double reach = fw_jet_reach(&a, half);
    if (reach < a.v.r) a.v.r = reach;
    return a;
}

/* f(c + d) = f(c) + g(c).d within sum |d_i| (g_i.e + g_i.r)/2 (maths_interval.h) */
static inline fw_maths_interval fw_jet_range(const fw_workspace_jet *a, const double half[3]) {
    double reach = a->v.e;
    for (int i = 0; i < 3; i++)
        reach += half[i] * (fabs(a->d[i].m) + 0.5 * (a->d[i].e + a->d[i].r));
    reach = fw_grown(fw_grown(reach));
    if (!(reach < a->v.r)) reach = a->v.r;
    return (fw_maths_interval){fw_down(a->v.m - reach), fw_up(a->v.m + reach)};
}

/* ---- of the plane ---- */

static inline fw_workspace_jet2 fw_jet2_exact(double x, double y) {
    return (fw_workspace_jet2){fw_jet_exact(x), fw_jet_exact(y)};
}

static inline fw_workspace_jet2 fw_jet2_add(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return (fw_workspace_jet2){fw_jet_add(a.x, b.x), fw_jet_add(a.y, b.y)};
}

static inline fw_workspace_jet2 fw_jet2_sub(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return (fw_workspace_jet2){fw_jet_sub(a.x, b.x), fw_jet_sub(a.y, b.y)};
}

static inline fw_workspace_jet2 fw_jet2_times(fw_workspace_jet2 a, fw_workspace_jet k) {
    return (fw_workspace_jet2){fw_jet_mul(a.x, k), fw_jet_mul(a.y, k)};
}

static inline fw_workspace_jet fw_jet2_dot(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return fw_jet_add(fw_jet_mul(a.x, b.x), fw_jet_mul(a.y, b.y));
}

static inline fw_workspace_jet fw_jet2_cross(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return fw_jet_sub(fw_jet_mul(a.x, b.y), fw_jet_mul(a.y, b.x));
}

static inline fw_workspace_jet2 fw_jet2_quarter(fw_workspace_jet2 a) { /* J a */
    return (fw_workspace_jet2){fw_jet_negated(a.y), a.x};
}

/* a fixed vector turned by the rotation of which `turn` is (cos, sin) */
static inline fw_workspace_jet2 fw_jet2_turned(fw_workspace_jet2 turn, double x, double y) {
    return (fw_workspace_jet2){fw_jet_sub(fw_jet_scaled(turn.x, x), fw_jet_scaled(turn.y, y)),
                               fw_jet_add(fw_jet_scaled(turn.x, y), fw_jet_scaled(turn.y, x))};
}

/* one rotation after another */
static inline fw_workspace_jet2 fw_jet2_both(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return (fw_workspace_jet2){fw_jet2_dot((fw_workspace_jet2){a.x, fw_jet_negated(a.y)}, b),
                               fw_jet_add(fw_jet_mul(a.x, b.y), fw_jet_mul(a.y, b.x))};
}

#endif
