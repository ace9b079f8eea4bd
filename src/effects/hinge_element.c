/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure instead of an ideal pin. Between W of body a and W of body b, D = W_b - W_a, with the
   rotation th = phi_b - phi_a - free angle and the arc's axis half turned, psi = axis + (turn of a
   + turn of b)/2, e = (cos psi, sin psi), n = (-sin psi, cos psi):

     w = e.D,  v = n.D - o drift(o th),  o = 1 where body a has the root at -a, else -1
     U = K th^2/2 + kx(o th) w^2/2 + ky(o th) v^2/2

   Force -dU/dp, stiffness d2U/dp dp in full, all derivatives of kx, ky and the drift included. The
   material dissipates in all three deformations alike: forces -tau (kx w' dw/dp + ky v' dv/dp) with
   tau = c/K of the pin's own viscous damper, which goes on acting on th (joint-damping,
   material-damping); a damping stated in the file is for the rotation only. All of U is
   proportional to Young's modulus: warm, it is U (1 + beta dT law(t)), which the law feeds with
   U beta dT law'; dampers keep their values.
   Inputs p in m and rad, w in m/s and rad/s; outputs N, N m. Valid until the arc closes to a full
   circle. Error: see flexure/finite.c. Cost of a force some 850 instructions. Source:
   docs/theory/effects/nonlinear-hinge.md. Test: test_nonlinear_hinge.c. */
#include "effects/hinge_element.h"
#include <math.h>
#include <string.h>

typedef fw_effects_flexed flexed;

typedef struct bent {               /* values and rates, for what needs no second derivative */
    double c, n, x, y;              /* of psi, and e.D, n.D */
    double th, w, v;                /* deformations */
    double th_rate, w_rate, v_rate; /* and their rates */
    double kx, kx_slope, ky, ky_slope, drift_slope;
} bent;

static inline bent bend(const flexed *f, const fw_effects_port_state *s) {
    const double *a = s->p, *b = s->p + 3, *va = s->w, *vb = s->w + 3, o = f->sense;
    double psi = f->axis_rad + 0.5 * (a[2] + b[2]), c = cos(psi), n = sin(psi);
    double dx = b[0] - a[0], dy = b[1] - a[1], x = c * dx + n * dy, y = c * dy - n * dx;
    double ux = vb[0] - va[0], uy = vb[1] - va[1], turning = 0.5 * (va[2] + vb[2]);
    double th = b[2] - a[2] - f->free_rad, th_rate = vb[2] - va[2];
    fw_flexure_hinge_at law;
    fw_flexure_hinge_law_slopes(&f->law, &f->rest, o * th, &law);
    return (bent){.c = c,
                  .n = n,
                  .x = x,
                  .y = y,
                  .th = th,
                  .w = x,
                  .v = y - o * law.drift_m.value,
                  .th_rate = th_rate,
                  .w_rate = c * ux + n * uy + y * turning,
                  .v_rate = c * uy - n * ux - x * turning - law.drift_m.slope * th_rate,
                  .kx = law.kx_N_per_m.value,
                  .kx_slope = o * law.kx_N_per_m.slope,
                  .ky = law.ky_N_per_m.value,
                  .ky_slope = o * law.ky_N_per_m.slope,
                  .drift_slope = law.drift_m.slope};
}

static inline double warmth(const fw_effects_force_element *e, const fw_effects_port_state *s,
                            double *rate) {
    const flexed *h = e->data;
    *rate = 0;
    if (e->laws == 0) return h->factor;
    double law[3];
    fw_quantity_law_value(e->law[0], s->t_s, s->piece_s, law);
    *rate = h->varying * law[1];
    return h->factor + h->varying * law[0];
}

double fw_effects_flexed_warmth(const fw_effects_force_element *e, const fw_effects_port_state *s,
                                double *rate) {
    return warmth(e, s, rate);
}

/* -(M dth + X dw + Y dv), with the gradients of th, w and v written out */
static inline void modal_load(const flexed *h, const fw_effects_port_state *s, double warm,
                              double *f) {
    const bent b = bend(h, s);
    double moment = warm * (h->law.stiffness_Nm_per_rad * b.th +
                            0.5 * (b.kx_slope * b.w * b.w + b.ky_slope * b.v * b.v));
    double X = b.kx * (warm * b.w + h->loss_s * b.w_rate);
    double Y = b.ky * (warm * b.v + h->loss_s * b.v_rate);
    double both = 0.5 * (Y * b.x - X * b.y); /* half of the couple that the offset makes */
    f[0] = X * b.c - Y * b.n, f[1] = X * b.n + Y * b.c;
    f[3] = -f[0], f[4] = -f[1];
    f[2] = both + moment - Y * b.drift_slope;
    f[5] = both - moment + Y * b.drift_slope;
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double rate;
    modal_load(e->data, s, warmth(e, s, &rate), f);
}

void fw_effects_flexed_force(const fw_effects_flexed *h, const fw_effects_port_state *s,
                             double warm, double *f) {
    modal_load(h, s, warm, f);
}

static inline double stored(const flexed *h, const bent *b) { /* U where it was made */
    return 0.5 * (h->law.stiffness_Nm_per_rad * b->th * b->th + b->kx * b->w * b->w +
                  b->ky * b->v * b->v);
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const flexed *h = e->data;
    const bent b = bend(h, s);
    double rate;
    return warmth(e, s, &rate) * stored(h, &b);
}

double fw_effects_flexed_loss_W(const fw_effects_flexed *h, const fw_effects_port_state *s) {
    const bent b = bend(h, s);
    return h->loss_s * (b.kx * b.w_rate * b.w_rate + b.ky * b.v_rate * b.v_rate);
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double power[2]) {
    const flexed *h = e->data;
    const bent b = bend(h, s);
    power[0] = h->loss_s * (b.kx * b.w_rate * b.w_rate + b.ky * b.v_rate * b.v_rate);
    double rate;
    warmth(e, s, &rate);
    power[1] = rate * stored(h, &b);
}

/* ---- the tangent: all second derivatives ---- */

enum { N = 6 };

typedef struct strain { /* one of w and v: value, rate, gradient by the ports, second derivative */
    double value, rate, slope[N], curve[N][N];
} strain;

typedef struct state {
    fw_flexure_hinge_jet kx, ky, drift;
    strain w, v;
} state;

static const double turns[N] = {0, 0, -1, 0, 0, 1};   /* d th */
static const double half[N] = {0, 0, 0.5, 0, 0, 0.5}; /* d psi */

/* a jet of o th as one of th; `odd` where the value itself goes with o */
static fw_flexure_hinge_jet seen_from_a(fw_flexure_hinge_jet j, double sense, bool odd) {
    double o = odd ? sense : 1;
    return (fw_flexure_hinge_jet){o * j.value, o * sense * j.slope, o * j.curve};
}

/* x = u.D, y = its partner a quarter turn on, so that dx/dpsi = side y: gradient and second
   derivative without the drift. line: d(u.D) by the places, cross: the same of the partner */
static void project(strain *s, double x, double y, double side, const double *line,
                    const double *cross) {
    s->value = x;
    for (int i = 0; i < N; i++)
        s->slope[i] = line[i] + side * y * half[i];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            s->curve[i][j] =
                -x * half[i] * half[j] + side * (cross[i] * half[j] + half[i] * cross[j]);
}

static void deform(const flexed *f, const fw_effects_port_state *s, state *at) {
    const double *a = s->p, *b = s->p + 3;
    double psi = f->axis_rad + 0.5 * (a[2] + b[2]), c = cos(psi), n = sin(psi);
    double dx = b[0] - a[0], dy = b[1] - a[1], x = c * dx + n * dy, y = c * dy - n * dx;
    const double along[N] = {-c, -n, 0, c, n, 0}, across[N] = {n, -c, 0, -n, c, 0};
    fw_flexure_hinge_at law;
    fw_flexure_hinge_law_at(&f->law, f->sense * (b[2] - a[2] - f->free_rad), &law);
    at->kx = seen_from_a(law.kx_N_per_m, f->sense, false);
    at->ky = seen_from_a(law.ky_N_per_m, f->sense, false);
    at->drift = seen_from_a(law.drift_m, f->sense, true);
    project(&at->w, x, y, 1, along, across);
    project(&at->v, y, x, -1, across, along);
    at->v.value -= at->drift.value;
    for (int i = 0; i < N; i++)
        at->v.slope[i] -= at->drift.slope * turns[i];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            at->v.curve[i][j] -= at->drift.curve * turns[i] * turns[j];
    at->w.rate = at->v.rate = 0;
    for (int i = 0; i < N; i++) {
        at->w.rate += at->w.slope[i] * s->w[i];
        at->v.rate += at->v.slope[i] * s->w[i];
    }
}

/* of k (s + tau s') ds/dp: stiffness and damping, += */
static void add_strain(const strain *s, fw_flexure_hinge_jet k, double tau, const double *speed,
                       double *stiffness, double *damping) {
    double pull = s->value + tau * s->rate, turning[N] = {0};
    for (int j = 0; j < N; j++) /* of s' */
        for (int i = 0; i < N; i++)
            turning[j] += s->curve[i][j] * speed[i];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            stiffness[N * i + j] +=
                k.value * (s->slope[i] * (s->slope[j] + tau * turning[j]) + pull * s->curve[i][j]) +
                k.slope * (pull * s->slope[i] * turns[j] + s->value * turns[i] * s->slope[j]) +
                0.5 * k.curve * s->value * s->value * turns[i] * turns[j];
            damping[N * i + j] += tau * k.value * s->slope[i] * s->slope[j];
        }
}

void fw_effects_flexed_tangent(const fw_effects_flexed *h, const fw_effects_port_state *s,
                               double warm, double *stiffness, double *damping) {
    state at;
    deform(h, s, &at);
    memset(damping, 0, N * N * sizeof *damping);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            stiffness[N * i + j] = h->law.stiffness_Nm_per_rad * turns[i] * turns[j];
    double tau = h->loss_s / warm;
    add_strain(&at.w, at.kx, tau, s->w, stiffness, damping);
    add_strain(&at.v, at.ky, tau, s->w, stiffness, damping);
    for (int i = 0; i < N * N; i++)
        stiffness[i] *= warm, damping[i] *= warm;
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    double rate;
    fw_effects_flexed_tangent(e->data, s, warmth(e, s, &rate), stiffness, damping);
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    const flexed *h = e->data;
    double th = h->sense * (s->p[5] - s->p[2] - h->free_rad);
    if (fw_flexure_hinge_law_holds(&h->law, th)) return true;
    *why =
        "the flexure is wound up to a full circle, where its ends would meet; lower the load, or "
        "make its angle smaller";
    return false;
}

const fw_effects_element_class fw_effects_flexed_class = {.effect = "nonlinear-hinge",
                                                          .force = force,
                                                          .tangent = tangent,
                                                          .energy = energy,
                                                          .power = power,
                                                          .valid = valid};
