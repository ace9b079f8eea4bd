/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure as a geometrically exact beam in the mechanism. Its first body is the one that has the
   root at polar angle -a; with phi the arc's axis as that body holds it and P the two images of W,

     theta = turn of second - turn of first (less what is free),  u = R(-phi) (P_second - P_first)
     U(theta, u): energy of the beam of flexure/beam.h between its roots, (M, F) = dU/d(theta, u)

   Force on the ports -dU/dp, on the second body (-R(phi) F, -M), on the first (R(phi) F, M - F x
   u); stiffness J' K J + (M, F) . d2(theta, u)/dp dp with the beam's own tangent K. What the
   material dissipates and what temperature does are as in hinge_element.c: the closed form's kx, ky
   and drift are good enough for a loss.

   Every solution starts near the wrench of the closed form for this pose, or where that does not
   lead to it from the unloaded beam, so that the force depends on the pose alone, to the last bit:
   not on the way there, nor on what was asked for before. What is kept is the answer for the last
   pose, which force, tangent and energy all ask for in turn.
   Inputs p in m and rad; outputs N, N m. Valid where the beam has an equilibrium on its primary
   branch for the pose (`valid` says where not; the force is then that of the closed form, so that a
   search can turn back). Error: relative 1e-8, told by the solver. Cost 6 us per pose. Source:
   docs/theory/hinge-models.md. Test: test_hinge_exact.c, test_hinge_models.c. */
#include "effects/hinge_element.h"
#include "flexure/beam.h"
#include <math.h>
#include <string.h>

const double fw_effects_exact_tolerance = 1e-8;
/* where rounding leaves more than the tolerance, as in a beam that is hardly bent or a leaf that is
   stiff along its chord: of the wrench that deflects it by a thousandth of itself */
static const double rough = 1e-6, deflected = 1e-3;
/* rad, lengths of the strip: below it the beam is linear to the rounding of its ends' positions
   (its drift is 1e-20 m there), which is all that Newton's method would see */
static const double linear = 3e-8;

struct fw_effects_exact {
    fw_flexure_beam beam;
    double length_m; /* of the strip */
    fw_flexure_elastica *solver;
    bool asked, held, weighed; /* the state below is that of `twist`; its energy is known */
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

fw_status fw_effects_exact_new(fw_arena *arena, const fw_mechanism_hinge *h,
                               fw_effects_exact **out) {
    const fw_flexure_result *c = &h->closed_form;
    fw_effects_exact *x = fw_arena_one(arena, fw_effects_exact);
    FW_NEED(x);
    FW_TRY(fw_flexure_beam_of_input(arena, &h->input, c, &x->beam));
    fw_flexure_beam_scale(&x->beam, h->scale);
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

/* the beam at this place; false: it has no equilibrium there */
static bool solve(const fw_effects_flexed *h, const double twist[3]) {
    fw_effects_exact *x = h->exact;
    fw_flexure_elastica_result r;
    double near[3];
    if (x->asked && x->twist[0] == twist[0] && x->twist[1] == twist[1] && x->twist[2] == twist[2])
        return x->held;
    x->asked = true;
    x->weighed = false;
    memcpy(x->twist, twist, sizeof x->twist);
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

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const fw_effects_flexed *h = e->data;
    const place at = place_of(h, s->p);
    double rate, warm = fw_effects_flexed_warmth(e, s, &rate);
    if (!solve(h, at.twist)) {
        fw_effects_flexed_force(h, s, warm, f);
        return;
    }
    const double *w = h->exact->wrench;
    double gx = warm * (at.c * w[1] - at.s * w[2]), gy = warm * (at.s * w[1] + at.c * w[2]);
    double turn = warm * (w[1] * at.twist[2] - w[2] * at.twist[1]);
    memset(f, 0, 6 * sizeof *f);
    if (fw_effects_flexed_loses(h)) fw_effects_flexed_force(h, s, 0, f);
    f[at.second] -= gx, f[at.second + 1] -= gy, f[at.second + 2] -= warm * w[0];
    f[at.first] += gx, f[at.first + 1] += gy, f[at.first + 2] += warm * w[0] - turn;
}

static double stored(const fw_effects_flexed *h,
                     const fw_effects_port_state *s) { /* U where it was made */
    fw_effects_exact *x = h->exact;
    const place at = place_of(h, s->p);
    if (!solve(h, at.twist)) return (double)NAN;
    if (!x->weighed) x->energy_J = fw_flexure_elastica_energy_J(x->solver);
    x->weighed = true;
    return x->energy_J;
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    double rate;
    return fw_effects_flexed_warmth(e, s, &rate) * stored(e->data, s);
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double power[2]) {
    const fw_effects_flexed *h = e->data;
    double rate;
    power[0] = fw_effects_flexed_loses(h) ? fw_effects_flexed_loss_W(h, s) : 0;
    power[1] = 0;
    fw_effects_flexed_warmth(e, s, &rate);
    if (e->laws > 0) power[1] = rate * stored(h, s);
}

enum { N = 6 };

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
static void add_loss(const fw_effects_flexed *h, const fw_effects_port_state *s, double *stiffness,
                     double *damping) {
    double lost[N * N];
    fw_effects_flexed_tangent(h, s, 0, lost, damping);
    for (int i = 0; i < N * N; i++)
        stiffness[i] += lost[i];
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const fw_effects_flexed *h = e->data;
    const place at = place_of(h, s->p);
    double rate, warm = fw_effects_flexed_warmth(e, s, &rate), j[3][N];
    if (!solve(h, at.twist)) {
        fw_effects_flexed_tangent(h, s, warm, stiffness, damping);
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
    if (fw_effects_flexed_loses(h)) add_loss(h, s, stiffness, damping);
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    const fw_effects_flexed *h = e->data;
    const place at = place_of(h, s->p);
    if (solve(h, at.twist)) return true;
    *why = "the flexure as an exact beam has no equilibrium that can be reached from rest with its "
           "ends in that place: it would buckle or close; lower the load, or look at "
           "--hinge-model compliance";
    return false;
}

const fw_effects_element_class fw_effects_exact_class = {.effect = "nonlinear-hinge",
                                                         .force = force,
                                                         .tangent = tangent,
                                                         .energy = energy,
                                                         .power = power,
                                                         .valid = valid};
