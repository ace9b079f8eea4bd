/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure instead of an ideal pin: as an element in closed form, and as a geometrically exact beam. */
#include "effects/effect.h"
#include "flexure/beam.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- in closed form ---- */

/* A flexure instead of an ideal pin. Between W of body a and W of body b, D = W_b - W_a, with the
   rotation th = phi_b - phi_a - free angle and the arc's axis half turned, psi = axis + (turn of a
   + turn of b)/2, e = (cos psi, sin psi), n = (-sin psi, cos psi):

     w = e.D,  v = n.D,  U = U(o th, o w, o v) of flexure/finite_force.c,
     o = 1 where body a has the root at -a, else -1

   Force -dU/dp, stiffness d2U/dp dp in full. The material dissipates in all three deformations:
   forces -(tau_x kx w' dw/dp + tau_y ky z' dz/dp), z = v - o drift(o th), beside the pin's own viscous
   damper c, which goes on acting on th (joint-damping, material-damping); tau of hinge_source.c, at
   most c/K. A damping stated in the file is for the rotation only. All of U is proportional to Young's modulus: warm, it is
   U (1 + beta dT law(t)), which the law feeds with U beta dT law'; dampers keep their values.
   Inputs p in m and rad, w in m/s and rad/s; outputs N, N m. Valid where the law is. Error: see
   flexure/finite_force.c. Cost of a force some 1900 instructions, 750 where hinges stand side by side
   (nonlinear_hinge.c). Source:
   docs/theory/effects/nonlinear-hinge.md. Test: test_nonlinear_hinge.c. */

typedef fw_effects_flexed flexed;

typedef struct
    bent { /* deformations, what they store, and their rates, 0 where nothing is dissipated */
    const fw_effects_bent *at;
    double th_rate, w_rate, z_rate;
} bent;

/* without the forces of the law */
static void softness_alone(const flexed *f, fw_effects_bent *b) {
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
    b->w_rate = b->at->c * ux + b->at->n * uy + b->at->y * turning;
    b->z_rate =
        b->at->c * uy - b->at->n * ux - b->at->x * turning - b->at->law.drift_slope * b->th_rate;
}

static inline bent bend(const flexed *f, const fw_effects_port_state *s) {
    fw_effects_bent *last = f->last;
    if (!fw_effects_bent_at(last, s->p)) {
        fw_effects_flexed_place(f, s->p, last);
        const double o = f->sense, at[3] = {o * last->th, o * last->x, o * last->y};
        fw_flexure_hinge_law_bend(&f->law, &f->rest, at, false, &last->law);
        last->known = true;
    }
    bent b = {.at = last};
    if (fw_effects_flexed_loses(f)) rates(s, &b);
    return b;
}

/* what U is multiplied by, and its rate */
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

/* -(M dth + X dw + Y dv), with the gradients of th, w and v written out: elastic force times warm, and what the
   material dissipates; warm 0: that alone */
static inline void load_of(const flexed *h, const bent *b, double warm, double *f) {
    double o = h->sense * warm, lost = h->loss_s[1] * b->at->law.ky_N_per_m * b->z_rate;
    double moment = o * b->at->law.gradient[0] - lost * b->at->law.drift_slope;
    double X = o * b->at->law.gradient[1] + h->loss_s[0] * b->at->law.kx_N_per_m * b->w_rate;
    double Y = o * b->at->law.gradient[2] + lost;
    double both =
        0.5 * (Y * b->at->x - X * b->at->y); /* half of the couple that the offset makes */
    f[0] = X * b->at->c - Y * b->at->n, f[1] = X * b->at->n + Y * b->at->c;
    f[3] = -f[0], f[4] = -f[1];
    f[2] = both + moment;
    f[5] = both - moment;
}

static inline void modal_load(const flexed *h, const fw_effects_port_state *s, double warm,
                              double *f) {
    const bent b = bend(h, s);
    load_of(h, &b, warm, f);
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double rate;
    modal_load(e->data, s, warmth(e, s, &rate), f);
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const bent b = bend(e->data, s);
    double rate;
    return warmth(e, s, &rate) * b.at->law.energy_J;
}

static double lost_W(const flexed *h, const bent *b) {
    return h->loss_s[0] * b->at->law.kx_N_per_m * b->w_rate * b->w_rate +
           h->loss_s[1] * b->at->law.ky_N_per_m * b->z_rate * b->z_rate;
}

static double flexed_loss_W(const fw_effects_flexed *h, const fw_effects_port_state *s) {
    const bent b = bend(h, s);
    return lost_W(h, &b);
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double power[2]) {
    const flexed *h = e->data;
    double rate;
    warmth(e, s, &rate);
    const bent b = bend(h, s);
    power[0] = lost_W(h, &b);
    power[1] = rate != 0 ? rate * b.at->law.energy_J : 0;
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

static void flexed_tangent(const fw_effects_flexed *h, const fw_effects_port_state *s, double warm,
                           double *stiffness, double *damping) {
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
    flexed_tangent(e->data, s, warmth(e, s, &rate), stiffness, damping);
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    const flexed *h = e->data;
    const bent b = bend(h, s);
    if (b.at->law.holds) return true;
    *why =
        fw_flexure_hinge_law_holds(&h->law, h->sense * b.at->th)
            ? "a flexure is pressed beyond its buckling load, or displaced by four tenths of its "
              "length, which its closed form does not know; lower the load, or look at "
              "--hinge-model elastica"
            : "the flexure is wound up to a full circle, where its ends would meet; lower the "
              "load, or make its angle smaller";
    return false;
}

const fw_effects_element_class fw_effects_flexed_class = {.effect = "nonlinear-hinge",
                                                          .closed_form = true,
                                                          .force = force,
                                                          .tangent = tangent,
                                                          .energy = energy,
                                                          .power = power,
                                                          .valid = valid};

/* ---- as an exact beam ---- */

/* A flexure as a geometrically exact beam in the mechanism. Its first body is the one that has the
   root at polar angle -a; with phi the arc's axis as that body holds it and P the two images of W,

     theta = turn of second - turn of first (less what is free),  u = R(-phi) (P_second - P_first)
     U(theta, u): energy of the beam of flexure/beam.h between its roots, (M, F) = dU/d(theta, u)

   Force on the ports -dU/dp, on the second body (-R(phi) F, -M), on the first (R(phi) F, M - F x
   u); stiffness J' K J + (M, F) . d2(theta, u)/dp dp with the beam's own tangent K. What the
   material dissipates and what temperature does are as above: the closed form's kx, ky
   and drift are good enough for a loss.

   Every solution starts near the wrench of the closed form for this pose, or where that does not
   lead to it from the unloaded beam, so that the force depends on the pose alone, to the last bit:
   not on the way there, nor on what was asked for before. What is kept is the answer for the last
   pose, which force, tangent and energy all ask for in turn.
   Inputs p in m and rad; outputs N, N m. Valid where the beam has an equilibrium on its primary
   branch for the pose (`valid` says where not; the force is then that of the closed form, so that a
   search can turn back). Error: relative 1e-8, told by the solver; 1e-6 while a motion is followed, when
   a lattice of solutions answers. Cost 6 us per pose, 0.4 us then. Source:
   docs/theory/hinge-models.md. Test: test_hinge_exact.c, test_hinge_models.c. */

const double fw_effects_exact_tolerance = 1e-8, fw_effects_followed_error = 1e-6;
/* where rounding leaves more than the tolerance, as in a beam that is hardly bent or a leaf that is
   stiff along its chord: of the wrench that deflects it by a thousandth of itself */
static const double rough = 1e-6, deflected = 1e-3;
/* rad, lengths of the strip: below it the beam is linear to the rounding of its ends' positions
   (its drift is 1e-20 m there), which is all that Newton's method would see */
static const double linear = 3e-8;

struct fw_effects_exact {
    fw_flexure_input input; /* what the beam is made of, all of it times `scale` */
    double scale;
    fw_flexure_beam beam;
    double length_m; /* of the strip */
    fw_flexure_elastica *solver;
    fw_flexure_chart *chart; /* while a motion is followed; else NULL */
    /* the state below is that of `twist`; its energy, and its stiffness, are known */
    bool asked, held, weighed, stiff;
    double twist[3], wrench[3], k[3][3], energy_J;
    double rest[3][3]; /* stiffness of the unloaded beam */
};

static void take_stiffness(const fw_flexure_elastica_result *r, double k[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k[i][j] = 0.5 * (r->stiffness[i][j] + r->stiffness[j][i]);
}

bool fw_effects_exact_is_known(const fw_mechanism_hinge *h) {
    return h->input.length_m > 0 && h->input.width_m > 0 && h->input.depth_m > 0 &&
           h->closed_form.stiffness_Nm_per_rad > 0;
}

fw_status fw_effects_exact_new(fw_arena *arena, const fw_mechanism_hinge *h, double along,
                               fw_effects_exact **out) {
    const fw_flexure_result *c = &h->closed_form;
    fw_effects_exact *x = fw_arena_one(arena, fw_effects_exact);
    FW_NEED(x);
    x->input = h->input, x->scale = h->scale;
    FW_TRY(fw_flexure_beam_of_input(arena, &h->input, c, &x->beam));
    fw_flexure_beam_scale(&x->beam, h->scale), x->beam.along = along;
    /* where the pin is: the ends of the strip are that far from it in both bodies */
    const double pin[2] = {c->centre_m + c->offset_m[0], c->offset_m[1]};
    static const double none[3] = {0};
    fw_flexure_elastica_result r;
    FW_TRY(fw_flexure_elastica_new(arena, &x->beam, pin, false, &x->solver));
    x->length_m = fw_flexure_elastica_linear(x->solver)->length_m;
    fw_flexure_elastica_of_twist(x->solver, none, fw_effects_exact_tolerance, false, &r);
    take_stiffness(&r, x->rest);
    *out = x;
    return FW_OK;
}

/* of the same numbers, to the last bit, and so the same beam and the same law */
static bool same_beam(const fw_effects_exact *x, const fw_effects_exact *y) {
    const fw_flexure_input *a = &x->input, *b = &y->input;
    const fw_flexure_crystal *c = &a->crystal, *d = &b->crystal;
    const size_t doubles = offsetof(fw_flexure_input, piece) - offsetof(fw_flexure_input, length_m);
    const size_t of_crystal = sizeof *c - offsetof(fw_flexure_crystal, a0_per_Pa);
    return x->scale == y->scale && x->beam.along == y->beam.along && a->kind == b->kind &&
           a->ends == b->ends && a->npiece == b->npiece &&
           (a->npiece == 0 || a->piece == b->piece) && c->known == d->known &&
           c->aligned == d->aligned && memcmp(&a->length_m, &b->length_m, doubles) == 0 &&
           memcmp(&c->a0_per_Pa, &d->a0_per_Pa, of_crystal) == 0;
}

/* flexures that are the same beam ask one lattice of its solutions */
fw_status fw_effects_hinges_follow(fw_arena *arena, const fw_effects_loads *loads) {
    for (int i = 0; i < loads->nelement; i++) {
        if (loads->element[i].class_ != &fw_effects_exact_class) continue;
        const fw_effects_flexed *f = loads->element[i].data;
        fw_effects_exact *x = f->exact;
        x->chart = NULL, x->asked = false;
        for (int k = 0; arena && k < i && !x->chart; k++) {
            if (loads->element[k].class_ != &fw_effects_exact_class) continue;
            const fw_effects_exact *y = ((const fw_effects_flexed *)loads->element[k].data)->exact;
            if (same_beam(x, y)) x->chart = y->chart;
        }
        if (!arena || x->chart) continue;
        FW_TRY(fw_flexure_chart_new(arena, &f->law, x->solver, &x->chart));
    }
    return FW_OK;
}

typedef struct place { /* of the second body in the first one's frame */
    int first, second; /* offsets of their ports in p */
    double c, s;       /* of phi */
    double twist[3];
} place;

static place place_of(const fw_effects_flexed *f, const double *p) {
    place at = {.first = f->sense > 0 ? 0 : 3, .second = f->sense > 0 ? 3 : 0};
    const double *a = p + at.first, *b = p + at.second;
    double phi = f->axis_rad + a[2] + 0.5 * f->sense * f->free_rad;
    double dx = b[0] - a[0], dy = b[1] - a[1];
    at.c = cos(phi), at.s = sin(phi);
    at.twist[0] = b[2] - a[2] - f->sense * f->free_rad;
    at.twist[1] = at.c * dx + at.s * dy;
    at.twist[2] = at.c * dy - at.s * dx;
    return at;
}

static bool good(const fw_flexure_elastica_result *r, double length_m) {
    if (r->code != FW_ELASTICA_ROUGH) return r->code == FW_ELASTICA_OK;
    for (int i = 0; i < 3; i++) {
        double size = 0;
        for (int j = 0; j < 3; j++)
            size += deflected * (j ? length_m : 1) * fabs(r->stiffness[i][j]);
        if (!(r->wrench_error[i] <= rough * (size + fabs(r->wrench[i])))) return false;
    }
    return true;
}

static bool hardly_bent(fw_effects_exact *x) {
    memcpy(x->k, x->rest, sizeof x->k);
    x->energy_J = 0;
    for (int i = 0; i < 3; i++) {
        x->wrench[i] = 0;
        for (int j = 0; j < 3; j++)
            x->wrench[i] += x->rest[i][j] * x->twist[j];
        x->energy_J += 0.5 * x->wrench[i] * x->twist[i];
    }
    x->weighed = true;
    return true;
}

static bool charted(fw_effects_exact *x) {
    fw_flexure_hinge_bent b;
    const fw_flexure_half_turned state = fw_flexure_hinge_half_turned(x->twist);
    if (!fw_flexure_chart_bend(x->chart, state.at, x->stiff, &b)) return false;
    fw_flexure_hinge_wrench_of(&b, &state, x->wrench, x->stiff ? x->k : NULL);
    x->energy_J = b.energy_J;
    return x->weighed = true;
}

/* the beam at this place; false: it has no equilibrium there */
static bool solve(const fw_effects_flexed *h, const double twist[3], bool tangent) {
    fw_effects_exact *x = h->exact;
    fw_flexure_elastica_result r;
    double near[3];
    if (x->asked && x->twist[0] == twist[0] && x->twist[1] == twist[1] && x->twist[2] == twist[2])
        if (x->stiff || !tangent) return x->held;
    x->asked = true;
    x->weighed = false;
    x->stiff = tangent || !x->chart;
    memcpy(x->twist, twist, sizeof x->twist);
    if (x->chart && charted(x)) return x->held = true;
    x->stiff = true;
    if (fmax(fabs(twist[0]), hypot(twist[1], twist[2]) / x->length_m) < linear)
        return x->held = hardly_bent(x);
    fw_flexure_hinge_law_wrench(&h->law, &h->rest, twist, near, NULL);
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                           {twist[0], twist[1], twist[2]}};
    fw_flexure_elastica_near(x->solver, &task, twist, near, fw_effects_exact_tolerance, &r);
    x->held = good(&r, x->length_m);
    memcpy(x->wrench, r.wrench, sizeof x->wrench);
    take_stiffness(&r, x->k);
    return x->held;
}

/* while a motion is followed, as of the closed form: the lattice has the same coordinates */
static bool charted_load(const fw_effects_flexed *h, const fw_effects_port_state *s, double warm,
                         double *f) {
    fw_effects_bent here = {0};
    bent b = {.at = &here};
    fw_effects_flexed_place(h, s->p, &here);
    const double o = h->sense, at[3] = {o * here.th, o * here.x, o * here.y};
    if (!h->exact->chart || !fw_flexure_chart_bend(h->exact->chart, at, false, &here.law))
        return false;
    if (fw_effects_flexed_loses(h)) {
        softness_alone(h, &here);
        rates(s, &b);
    }
    load_of(h, &b, warm, f);
    return true;
}

static void exact_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double *f) {
    const fw_effects_flexed *h = e->data;
    double rate, warm = warmth(e, s, &rate);
    if (charted_load(h, s, warm, f)) return;
    const place at = place_of(h, s->p);
    if (!solve(h, at.twist, false)) {
        modal_load(h, s, warm, f);
        return;
    }
    const double *w = h->exact->wrench;
    double gx = warm * (at.c * w[1] - at.s * w[2]), gy = warm * (at.s * w[1] + at.c * w[2]);
    double turn = warm * (w[1] * at.twist[2] - w[2] * at.twist[1]);
    memset(f, 0, 6 * sizeof *f);
    if (fw_effects_flexed_loses(h)) modal_load(h, s, 0, f);
    f[at.second] -= gx, f[at.second + 1] -= gy, f[at.second + 2] -= warm * w[0];
    f[at.first] += gx, f[at.first + 1] += gy, f[at.first + 2] += warm * w[0] - turn;
}

static double stored(const fw_effects_flexed *h,
                     const fw_effects_port_state *s) { /* U where it was made */
    fw_effects_exact *x = h->exact;
    const place at = place_of(h, s->p);
    if (!solve(h, at.twist, false)) return (double)NAN;
    if (!x->weighed) x->energy_J = fw_flexure_elastica_energy_J(x->solver);
    x->weighed = true;
    return x->energy_J;
}

static double exact_energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    double rate;
    return warmth(e, s, &rate) * stored(e->data, s);
}

static void exact_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double power[2]) {
    const fw_effects_flexed *h = e->data;
    double rate;
    power[0] = fw_effects_flexed_loses(h) ? flexed_loss_W(h, s) : 0;
    power[1] = 0;
    warmth(e, s, &rate);
    if (e->laws > 0) power[1] = rate * stored(h, s);
}

/* gradient of (theta, ux, uy) by p */
static void gradient(const place *at, double j[3][N]) {
    int a = at->first, b = at->second;
    memset(j, 0, 3 * sizeof j[0]);
    j[0][b + 2] = 1, j[0][a + 2] = -1;
    j[1][b] = at->c, j[1][b + 1] = at->s, j[2][b] = -at->s, j[2][b + 1] = at->c;
    for (int i = 1; i < 3; i++)
        j[i][a] = -j[i][b], j[i][a + 1] = -j[i][b + 1];
    j[1][a + 2] = at->twist[2], j[2][a + 2] = -at->twist[1];
}

/* += (Fx, Fy) . d2 u/dp dp: u turns back as the first body turns */
static void add_turning(const place *at, const double *w, double warm, double *stiffness) {
    int a = at->first, b = at->second, t = a + 2;
    double gx = warm * (at->c * w[1] - at->s * w[2]), gy = warm * (at->s * w[1] + at->c * w[2]);
    const int to[4] = {b, b + 1, a, a + 1};
    const double by[4] = {-gy, gx, gy, -gx};
    for (int i = 0; i < 4; i++)
        stiffness[N * t + to[i]] += by[i], stiffness[N * to[i] + t] += by[i];
    stiffness[N * t + t] -= warm * (w[1] * at->twist[1] + w[2] * at->twist[2]);
}

/* of what is dissipated: the closed form's alone */
static void add_closed_loss(const fw_effects_flexed *h, const fw_effects_port_state *s,
                            double *stiffness, double *damping) {
    double lost[N * N];
    flexed_tangent(h, s, 0, lost, damping);
    for (int i = 0; i < N * N; i++)
        stiffness[i] += lost[i];
}

static void exact_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double *stiffness, double *damping) {
    const fw_effects_flexed *h = e->data;
    const place at = place_of(h, s->p);
    double rate, warm = warmth(e, s, &rate), j[3][N];
    if (!solve(h, at.twist, true)) {
        flexed_tangent(h, s, warm, stiffness, damping);
        return;
    }
    gradient(&at, j);
    for (int r = 0; r < N; r++)
        for (int c = 0; c < N; c++) {
            double sum = 0;
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++)
                    sum += j[i][r] * h->exact->k[i][k] * j[k][c];
            stiffness[N * r + c] = warm * sum;
        }
    add_turning(&at, h->exact->wrench, warm, stiffness);
    memset(damping, 0, N * N * sizeof *damping);
    if (fw_effects_flexed_loses(h)) add_closed_loss(h, s, stiffness, damping);
}

static bool exact_valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        const char **why) {
    const fw_effects_flexed *h = e->data;
    const place at = place_of(h, s->p);
    if (solve(h, at.twist, false)) return true;
    *why = "the exact beam of the flexure is followed from rest only, and with its ends in that "
           "place it "
           "would have buckled between them, or closed, on the way; what is made may go on from "
           "there, which "
           "no model here says: lower the load, or make the flexure wider or shorter";
    return false;
}

const fw_effects_element_class fw_effects_exact_class = {.effect = "nonlinear-hinge",
                                                         .beam = true,
                                                         .force = exact_force,
                                                         .tangent = exact_tangent,
                                                         .energy = exact_energy,
                                                         .power = exact_power,
                                                         .valid = exact_valid};
