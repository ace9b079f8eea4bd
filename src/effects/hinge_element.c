/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure instead of an ideal pin. Between W of body a and W of body b, D = W_b - W_a, with the
   rotation th = phi_b - phi_a - free angle and the arc's axis half turned, psi = axis + (turn of a
   + turn of b)/2, e = (cos psi, sin psi), n = (-sin psi, cos psi):

     w = e.D,  v = n.D,  U = U(o th, o w, o v) of flexure/finite_force.c,
     o = 1 where body a has the root at -a, else -1

   Force -dU/dp, stiffness d2U/dp dp in full. The material dissipates in all three deformations:
   forces -(tau_x kx w' dw/dp + tau_y ky z' dz/dp), z = v - o drift(o th), beside the pin's own viscous
   damper c, which goes on acting on th (joint-damping, material-damping); tau of hinge_release.c, at
   most c/K. A damping stated in the file is for the rotation only. All of U is proportional to Young's modulus: warm, it is
   U (1 + beta dT law(t)), which the law feeds with U beta dT law'; dampers keep their values.
   Inputs p in m and rad, w in m/s and rad/s; outputs N, N m. Valid where the law is. Error: see
   flexure/finite_force.c. Cost of a force some 1500 instructions. Source:
   docs/theory/effects/nonlinear-hinge.md. Test: test_nonlinear_hinge.c. */
#include "effects/hinge_element.h"
#include <math.h>
#include <string.h>

typedef fw_effects_flexed flexed;

typedef struct bent {           /* deformations, their rates, and what they store */
    double c, n, x, y;          /* of psi, and e.D, n.D = w, v */
    double th, th_rate, w_rate; /* rates: 0 where nothing is dissipated */
    double z_rate;
    fw_flexure_hinge_bent law;
} bent;

/* without the forces of the law */
static void softness_alone(const flexed *f, bent *b) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_slopes(&f->law, &f->rest, f->sense * b->th, &at);
    b->law.kx_N_per_m = at.kx_N_per_m.value, b->law.ky_N_per_m = at.ky_N_per_m.value;
    b->law.drift_slope = at.drift_m.slope;
}

/* rates of w and of z, and the stiffness against them */
static inline void rates(const fw_effects_port_state *s, bent *b) {
    const double *va = s->w, *vb = s->w + 3;
    double ux = vb[0] - va[0], uy = vb[1] - va[1], turning = 0.5 * (va[2] + vb[2]);
    b->th_rate = vb[2] - va[2];
    b->w_rate = b->c * ux + b->n * uy + b->y * turning;
    b->z_rate = b->c * uy - b->n * ux - b->x * turning - b->law.drift_slope * b->th_rate;
}

static inline bent bend(const flexed *f, const fw_effects_port_state *s, bool law) {
    const double *pa = s->p, *pb = s->p + 3, o = f->sense;
    double psi = f->axis_rad + 0.5 * (pa[2] + pb[2]), c = cos(psi), n = sin(psi);
    double dx = pb[0] - pa[0], dy = pb[1] - pa[1];
    bent b = {.c = c,
              .n = n,
              .x = c * dx + n * dy,
              .y = c * dy - n * dx,
              .th = pb[2] - pa[2] - f->free_rad};
    const double at[3] = {o * b.th, o * b.x, o * b.y};
    if (law) fw_flexure_hinge_law_bend(&f->law, &f->rest, at, false, &b.law);
    if (fw_effects_flexed_loses(f)) {
        if (!law) softness_alone(f, &b);
        rates(s, &b);
    }
    return b;
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
    const bent b = bend(h, s, warm != 0);
    double o = h->sense * warm, lost = h->loss_s[1] * b.law.ky_N_per_m * b.z_rate;
    double moment = o * b.law.gradient[0] - lost * b.law.drift_slope;
    double X = o * b.law.gradient[1] + h->loss_s[0] * b.law.kx_N_per_m * b.w_rate;
    double Y = o * b.law.gradient[2] + lost;
    double both = 0.5 * (Y * b.x - X * b.y); /* half of the couple that the offset makes */
    f[0] = X * b.c - Y * b.n, f[1] = X * b.n + Y * b.c;
    f[3] = -f[0], f[4] = -f[1];
    f[2] = both + moment;
    f[5] = both - moment;
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double rate;
    modal_load(e->data, s, warmth(e, s, &rate), f);
}

void fw_effects_flexed_force(const fw_effects_flexed *h, const fw_effects_port_state *s,
                             double warm, double *f) {
    modal_load(h, s, warm, f);
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const bent b = bend(e->data, s, true);
    double rate;
    return warmth(e, s, &rate) * b.law.energy_J;
}

static double lost_W(const flexed *h, const bent *b) {
    return h->loss_s[0] * b->law.kx_N_per_m * b->w_rate * b->w_rate +
           h->loss_s[1] * b->law.ky_N_per_m * b->z_rate * b->z_rate;
}

double fw_effects_flexed_loss_W(const fw_effects_flexed *h, const fw_effects_port_state *s) {
    const bent b = bend(h, s, false);
    return lost_W(h, &b);
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double power[2]) {
    const flexed *h = e->data;
    double rate;
    warmth(e, s, &rate);
    const bent b =
        bend(h, s, rate != 0); /* its energy is asked for only while the law changes it */
    power[0] = lost_W(h, &b);
    power[1] = rate != 0 ? rate * b.law.energy_J : 0;
}

/* ---- the tangent: all second derivatives ---- */

enum { N = 6 };

typedef struct strain { /* one of w and v: value, rate, gradient by the ports, second derivative */
    double value, rate, slope[N], curve[N][N];
} strain;

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

/* the elastic part, with w and v: J' H J + gradient . second derivatives */
static void add_elastic(const flexed *f, const fw_flexure_hinge_bent *law, const strain *w,
                        const strain *v, double warm, double *stiffness) {
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double a[3] = {turns[i], w->slope[i], v->slope[i]};
            const double b[3] = {turns[j], w->slope[j], v->slope[j]};
            double sum =
                f->sense * (law->gradient[1] * w->curve[i][j] + law->gradient[2] * v->curve[i][j]);
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    sum += a[k] * law->hessian[k][l] * b[l];
            stiffness[N * i + j] = warm * sum;
        }
}

/* v and its derivatives become those of z = v - drift */
static void less_drift(strain *v, fw_flexure_hinge_jet drift) {
    v->value -= drift.value;
    for (int i = 0; i < N; i++)
        v->slope[i] -= drift.slope * turns[i];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            v->curve[i][j] -= drift.curve * turns[i] * turns[j];
}

static double rate_of(const strain *s, const double *speed) {
    double rate = 0;
    for (int i = 0; i < N; i++)
        rate += s->slope[i] * speed[i];
    return rate;
}

/* of tau k s' ds/dp: stiffness and damping, += */
static void add_strain(const strain *s, fw_flexure_hinge_jet k, double tau, const double *speed,
                       double *stiffness, double *damping) {
    double turning[N] = {0};
    for (int j = 0; j < N; j++) /* of s' */
        for (int i = 0; i < N; i++)
            turning[j] += s->curve[i][j] * speed[i];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            stiffness[N * i + j] +=
                tau * (k.value * (s->slope[i] * turning[j] + s->rate * s->curve[i][j]) +
                       k.slope * s->rate * s->slope[i] * turns[j]);
            damping[N * i + j] += tau * k.value * s->slope[i] * s->slope[j];
        }
}

static void add_loss(const flexed *h, const fw_effects_port_state *s, strain *w, strain *z,
                     double *stiffness, double *damping) {
    fw_flexure_hinge_at law;
    fw_flexure_hinge_law_at(&h->law, h->sense * (s->p[5] - s->p[2] - h->free_rad), &law);
    less_drift(z, seen_from_a(law.drift_m, h->sense, true));
    w->rate = rate_of(w, s->w), z->rate = rate_of(z, s->w);
    add_strain(w, seen_from_a(law.kx_N_per_m, h->sense, false), h->loss_s[0], s->w, stiffness,
               damping);
    add_strain(z, seen_from_a(law.ky_N_per_m, h->sense, false), h->loss_s[1], s->w, stiffness,
               damping);
}

void fw_effects_flexed_tangent(const fw_effects_flexed *h, const fw_effects_port_state *s,
                               double warm, double *stiffness, double *damping) {
    const double *a = s->p, *b = s->p + 3, o = h->sense;
    double psi = h->axis_rad + 0.5 * (a[2] + b[2]), c = cos(psi), n = sin(psi);
    double dx = b[0] - a[0], dy = b[1] - a[1], x = c * dx + n * dy, y = c * dy - n * dx;
    const double along[N] = {-c, -n, 0, c, n, 0}, across[N] = {n, -c, 0, -n, c, 0};
    const double at[3] = {o * (b[2] - a[2] - h->free_rad), o * x, o * y};
    strain w, v;
    fw_flexure_hinge_bent law;
    project(&w, x, y, 1, along, across);
    project(&v, y, x, -1, across, along);
    memset(damping, 0, N * N * sizeof *damping);
    memset(stiffness, 0, N * N * sizeof *stiffness);
    if (warm != 0) {
        fw_flexure_hinge_law_bend(&h->law, &h->rest, at, true, &law);
        add_elastic(h, &law, &w, &v, warm, stiffness);
    }
    if (fw_effects_flexed_loses(h)) add_loss(h, s, &w, &v, stiffness, damping);
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    double rate;
    fw_effects_flexed_tangent(e->data, s, warmth(e, s, &rate), stiffness, damping);
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    const flexed *h = e->data;
    const bent b = bend(h, s, true);
    if (b.law.holds) return true;
    *why =
        fw_flexure_hinge_law_holds(&h->law, h->sense * b.th)
            ? "a flexure is pressed beyond its buckling load, or displaced by four tenths of its "
              "length, which its closed form does not know; lower the load, or look at "
              "--hinge-model elastica"
            : "the flexure is wound up to a full circle, where its ends would meet; lower the "
              "load, or make its angle smaller";
    return false;
}

const fw_effects_element_class fw_effects_flexed_class = {.effect = "nonlinear-hinge",
                                                          .force = force,
                                                          .tangent = tangent,
                                                          .energy = energy,
                                                          .power = power,
                                                          .valid = valid};
