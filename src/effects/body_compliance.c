/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bodies give where contacts, drawn cables and springs act on them (mechanism/body_give.c), in series with those. An element whose port i
   stands where its body gives A_i = R c_i R^T acts on p + d in place of p:

     d = A f(p + d),   E = E_own(p + d) + f.A f/2,   couple on the port's body  += d x f

   f without damping, by Newton's method with the element's own stiffness K. With x = p + d and X = dx/dp = (1 + A K)^-1 (1 + A' f) it is
   -df/dp = K X, and what damps acts through the arm as well: X^T f_damp(X w), -df/dw = X^T D X,
   so that power is balanced as that of the element is. Springs between points become such elements. In: SI. Error: that
   of c (fw_mechanism_give.off); the mass of what gives stays where it is, so that what rings with it does not, and what
   other loads bend is in no motion. Cost: 21500 instructions, damped, with two ports. Source: series of elastic parts; Castigliano.
   Theory: docs/theory/effects/body-compliance.md. Test: test_body_compliance.c. */
#include "effects/effect.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

enum { PORTS = 8, N = 3 * PORTS, SWITCHES = 4, TURNS = 50 };

typedef struct yielding {         /* data */
    fw_effects_force_element own; /* what acts there */
    int given[PORTS], ngiven;     /* its ports whose bodies give */
    double c[PORTS][9];           /* (ngiven) of (x, y, turn), axes of the body */
} yielding;

/* ---- a spring between two points as an element ---- */

typedef struct point_spring {
    double length_m, stiffness_N_per_m, damping_Ns_per_m;
    fw_effects_foreign foreign; /* its length in those of the layer; law NULL: it stays */
} point_spring;                 /* a cable has a switch */

/* that length, and its rate where the element looks at rates */
static double length_at(const point_spring *k, const fw_effects_port_state *s, double *rate) {
    *rate = 0;
    if (!k->foreign.law) return k->length_m;
    const double own = fw_effects_foreign_at(&k->foreign, s->t_s, s->piece_s, rate);
    *rate = s->still ? 0 : *rate * k->length_m;
    return own * k->length_m;
}

static double spring_stretch(const fw_effects_force_element *e, const fw_effects_port_state *s,
                             double u[2], double *length, double *rate) {
    const point_spring *k = e->data;
    const double x = s->p[3] - s->p[0], y = s->p[4] - s->p[1];
    *length = hypot(x, y);
    u[0] = *length > 0 ? x / *length : 0, u[1] = *length > 0 ? y / *length : 0;
    double way;
    const double rest = length_at(k, s, &way);
    *rate = u[0] * (s->w[3] - s->w[0]) + u[1] * (s->w[4] - s->w[1]) - way;
    return *length - rest;
}

static double spring_pull(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double stretch, double rate) {
    const point_spring *k = e->data;
    if (e->switches > 0 && !s->on[0]) return 0;
    return k->stiffness_N_per_m * stretch + k->damping_Ns_per_m * rate;
}

static void spring_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                         double *f) {
    double u[2], length, rate;
    const double stretch = spring_stretch(e, s, u, &length, &rate),
                 pull = spring_pull(e, s, stretch, rate);
    f[0] = pull * u[0], f[1] = pull * u[1], f[2] = 0;
    f[3] = -f[0], f[4] = -f[1], f[5] = 0;
}

static void spring_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                           double *stiffness, double *damping) {
    const point_spring *k = e->data;
    const double sign[2] = {-1, 1};
    double u[2], length, rate;
    memset(stiffness, 0, 36 * sizeof *stiffness);
    memset(damping, 0, 36 * sizeof *damping);
    const double stretch = spring_stretch(e, s, u, &length, &rate),
                 turning = length > 0 ? spring_pull(e, s, stretch, rate) / length : 0;
    if (e->switches > 0 && !s->on[0]) return;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            const double along = u[i % 2] * u[j % 2], across = (i % 2 == j % 2) - along,
                         both = sign[i / 2] * sign[j / 2];
            const int at = 6 * (3 * (i / 2) + i % 2) + 3 * (j / 2) + j % 2;
            stiffness[at] = both * (k->stiffness_N_per_m * along + turning * across);
            damping[at] = both * k->damping_Ns_per_m * along;
        }
}

static double spring_energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const point_spring *k = e->data;
    double u[2], length, rate;
    const double stretch = spring_stretch(e, s, u, &length, &rate);
    return e->switches > 0 && !s->on[0] ? 0 : 0.5 * k->stiffness_N_per_m * stretch * stretch;
}

static void spring_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                         double power[2]) {
    const point_spring *k = e->data;
    double u[2], length, rate, way;
    const double stretch = spring_stretch(e, s, u, &length, &rate);
    length_at(k, s, &way);
    power[0] = e->switches > 0 && !s->on[0] ? 0 : k->damping_Ns_per_m * rate * rate;
    power[1] = -way * spring_pull(e, s, stretch, rate);
}

static double spring_taut(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          int i) {
    (void)i;
    const point_spring *k = e->data;
    double u[2], length, rate;
    const double elastic = k->stiffness_N_per_m * spring_stretch(e, s, u, &length, &rate);
    return fmin(elastic, elastic + k->damping_Ns_per_m * rate);
}

static const fw_effects_element_class spring_class = {.effect = "point-spring",
                                                      .force = spring_force,
                                                      .tangent = spring_tangent,
                                                      .energy = spring_energy,
                                                      .power = spring_power,
                                                      .switch_value = spring_taut};

/* ---- where the element's own ports are ---- */

typedef struct there {
    fw_effects_port_state own; /* of the element, at x = p + d, moving at X w */
    double p[N], w[N], d[N], a[PORTS][9];
    double passed[N];           /* w as far as what it damps passes the arm */
    double still[N], damped[N]; /* f at x without damping; and what damping adds to it */
    double stiff[N * N], damp[N * N];
    double series[N * N]; /* 1 + A K of what gives (3 ngiven), as factors */
    int pivot[N];
    double x[N * N]; /* X = dx/dp */
} there;

static void turned(const double *c, double rad, double *a) {
    const double x = cos(rad), y = sin(rad), axes[9] = {x, -y, 0, y, x, 0, 0, 0, 1};
    double half[9] = {0};
    for (int i = 0; i < 9; i++)
        for (int k = 0; k < 3; k++)
            half[i] += axes[3 * (i / 3) + k] * c[3 * k + i % 3];
    for (int i = 0; i < 9; i++) {
        a[i] = 0;
        for (int k = 0; k < 3; k++)
            a[i] += half[3 * (i / 3) + k] * axes[3 * (i % 3) + k];
    }
}

static void times(const double *a, const double *f, double *out) {
    for (int i = 0; i < 3; i++)
        out[i] = a[3 * i] * f[0] + a[3 * i + 1] * f[1] + a[3 * i + 2] * f[2];
}

/* where unknown k of what gives stands among those of all ports */
static int place_of(const yielding *y, int k) {
    return 3 * y->given[k / 3] + k % 3;
}

/* to (m x n) = A K, m = 3 ngiven */
static void give_stiff(const yielding *y, const there *at, int n, double *to) {
    for (int g = 0; g < y->ngiven; g++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < n; j++) {
                double sum = 0;
                for (int k = 0; k < 3; k++)
                    sum += at->a[g][3 * i + k] * at->stiff[(3 * y->given[g] + k) * n + j];
                to[(3 * g + i) * n + j] = sum;
            }
}

static bool factor_series(const yielding *y, there *at, int n) {
    double both[N * N];
    const int m = 3 * y->ngiven;
    give_stiff(y, at, n, both);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++)
            at->series[i * m + j] = (i == j) + both[i * n + place_of(y, j)];
    return fw_maths_lu_factor(m, at->series, at->pivot);
}

/* turns by arms of a millimetre */
static double size_of(const double *way, int n) {
    const double arm_m = 1e-3;
    double size = 0;
    for (int i = 0; i < n; i++)
        size = fmax(size, fabs(way[i]) * (i % 3 == 2 ? arm_m : 1));
    return size;
}

/* miss (3 ngiven) = A f(p + d) - d; its size */
static double miss_at(const yielding *y, const fw_effects_port_state *s, there *at, double *miss) {
    const int n = 3 * y->own.ports;
    for (int i = 0; i < n; i++)
        at->p[i] = s->p[i] + at->d[i];
    y->own.class_->force(&y->own, &at->own, at->still);
    for (int g = 0; g < y->ngiven; g++)
        times(at->a[g], at->still + 3 * y->given[g], miss + 3 * g);
    for (int k = 0; k < 3 * y->ngiven; k++)
        miss[k] -= at->d[place_of(y, k)];
    return size_of(miss, 3 * y->ngiven);
}

/* adds a step of Newton's method, or what of it comes nearer; the size of what is missed then */
static double add_step(const yielding *y, const fw_effects_port_state *s, there *at, double *miss,
                       double last, bool whole) {
    const int m = 3 * y->ngiven;
    double step[N], part = 1, off;
    memcpy(step, miss, (size_t)m * sizeof *step);
    for (int k = 0; k < m; k++)
        at->d[place_of(y, k)] += step[k];
    while (!((off = miss_at(y, s, at, miss)) < last) && !whole && part > 1e-3) {
        part /= 2;
        for (int k = 0; k < m; k++)
            at->d[place_of(y, k)] -= part * step[k];
    }
    return off;
}

/* d = A f(p + d), of what does not damp; false: no place is found. The last step is squared by the method: as small as
   round-off where this one is below its root */
static bool find_place(const fw_effects_force_element *e, const fw_effects_port_state *s,
                       there *at) {
    static const double none[N] = {0};
    const double root = 1e-8;
    const yielding *y = e->data;
    double miss[N], reach = 0;
    memset(at->d, 0, sizeof at->d);
    at->own = *s;
    at->own.p = at->p, at->own.w = none, at->own.still = true;
    for (int g = 0; g < y->ngiven; g++)
        turned(y->c[g], s->p[3 * y->given[g] + 2], at->a[g]);
    for (int i = 0; i < e->ports; i++)
        reach = fmax(reach, hypot(s->p[3 * i], s->p[3 * i + 1]));
    double off = miss_at(y, s, at, miss);
    for (int turn = 0; turn < TURNS; turn++) {
        y->own.class_->tangent(&y->own, &at->own, at->stiff, at->damp);
        if (!factor_series(y, at, 3 * e->ports)) return false;
        fw_maths_lu_solve(3 * y->ngiven, at->series, at->pivot, NULL, miss);
        const bool last = size_of(miss, 3 * y->ngiven) <= root * reach;
        off = add_step(y, s, at, miss, off, last);
        if (last) return true;
    }
    return false;
}

/* A' f of the turn of what gives: A' = J A - A J, J the quarter turn of x and y */
static void by_turn(const double *a, const double *f, double out[3]) {
    const double turn[3] = {-f[1], f[0], 0};
    double first[3], second[3];
    times(a, f, first);
    times(a, turn, second);
    out[0] = -first[1] - second[0], out[1] = first[0] - second[1], out[2] = -second[2];
}

/* X = 1 + dd/dp, (1 + A K) dd = A' f dphi - A K dp */
static void find_slopes(const yielding *y, there *at, int n) {
    const int m = 3 * y->ngiven;
    double both[N * N], column[N], turn[3];
    give_stiff(y, at, n, both);
    for (int i = 0; i < n * n; i++)
        at->x[i] = i / n == i % n;
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < m; k++)
            column[k] = -both[k * n + j];
        for (int g = 0; g < y->ngiven; g++) {
            if (j != 3 * y->given[g] + 2) continue;
            by_turn(at->a[g], at->still + 3 * y->given[g], turn);
            for (int k = 0; k < 3; k++)
                column[3 * g + k] += turn[k];
        }
        fw_maths_lu_solve(m, at->series, at->pivot, NULL, column);
        for (int k = 0; k < m; k++)
            at->x[place_of(y, k) * n + j] += column[k];
    }
}

/* What damps bends the arm as well, by dd = (1 + A K)^-1 A f_damp, and so takes K dd from what presses: X^T f_damp is left of it,
   which is what damps at w - (1 + A K)^-1 A K w. With that a thing lets go where nothing is left that presses the body; at w
   itself it would let go while it presses, take hold again at once, and so on for ever */
static void find_passed(const yielding *y, there *at, int n) {
    const int m = 3 * y->ngiven;
    double both[N * N], lost[N];
    give_stiff(y, at, n, both);
    for (int k = 0; k < m; k++) {
        lost[k] = 0;
        for (int j = 0; j < n; j++)
            lost[k] += both[k * n + j] * at->w[j];
    }
    fw_maths_lu_solve(m, at->series, at->pivot, NULL, lost);
    memcpy(at->passed, at->w, (size_t)n * sizeof *at->passed);
    for (int k = 0; k < m; k++)
        at->passed[place_of(y, k)] -= lost[k];
}

/* X, and what damps there */
static bool find_all(const fw_effects_force_element *e, const fw_effects_port_state *s, there *at) {
    const yielding *y = e->data;
    const int n = 3 * e->ports;
    if (!find_place(e, s, at)) return false;
    find_slopes(y, at, n);
    for (int i = 0; i < n; i++) {
        at->w[i] = 0;
        for (int j = 0; j < n; j++)
            at->w[i] += at->x[i * n + j] * s->w[j];
    }
    at->own.w = at->w, at->own.still = s->still;
    y->own.class_->force(&y->own, &at->own, at->damped);
    for (int i = 0; i < n; i++)
        at->damped[i] -= at->still[i];
    return true;
}

/* += X^T f */
static void back(const there *at, int n, const double *f, double *to) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[j] += at->x[i * n + j] * f[i];
}

/* ---- the class ---- */

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const int n = 3 * e->ports;
    there at;
    memset(f, 0, (size_t)n * sizeof *f);
    if ((e->dissipates || e->works) && !s->still) { /* else X is not needed */
        if (find_all(e, s, &at)) back(&at, n, at.damped, f);
    } else {
        find_place(e, s, &at);
    }
    for (int i = 0; i < n; i++)
        f[i] += at.still[i];
    for (int i = 0; i < n; i += 3) /* it acts at p + d, and is told at p */
        f[i + 2] += at.d[i] * at.still[i + 1] - at.d[i + 1] * at.still[i];
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const int n = 3 * e->ports;
    there at;
    memset(stiffness, 0, (size_t)n * (size_t)n * sizeof *stiffness);
    memset(damping, 0, (size_t)n * (size_t)n * sizeof *damping);
    if (!find_all(e, s, &at)) return;
    for (int j = 0; j < n; j++) {
        double df[N], dd[N], lost[N], through[N] = {0}; /* by p_j, and by w_j */
        for (int i = 0; i < n; i++) {
            df[i] = lost[i] = 0;
            dd[i] = at.x[i * n + j] - (i == j);
            for (int k = 0; k < n; k++) {
                df[i] -= at.stiff[i * n + k] * at.x[k * n + j];
                lost[i] += at.damp[i * n + k] * at.x[k * n + j];
            }
        }
        back(&at, n, lost, through);
        for (int i = 0; i < n; i += 3)
            df[i + 2] += dd[i] * at.still[i + 1] - dd[i + 1] * at.still[i] + at.d[i] * df[i + 1] -
                         at.d[i + 1] * df[i];
        for (int i = 0; i < n; i++)
            stiffness[i * n + j] = -df[i], damping[i * n + j] = through[i];
    }
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const yielding *y = e->data;
    there at;
    if (!find_place(e, s, &at)) return y->own.class_->energy(&y->own, s);
    double sum = y->own.class_->energy(&y->own, &at.own);
    for (int i = 0; i < 3 * e->ports; i++)
        sum += 0.5 * at.still[i] * at.d[i];
    return sum;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    const yielding *y = e->data;
    there at;
    out[0] = out[1] = 0;
    if (find_all(e, s, &at)) y->own.class_->power(&y->own, &at.own, out);
}

/* what presses first presses on an arm that is not bent */
static double switch_value(const fw_effects_force_element *e, const fw_effects_port_state *s,
                           int i) {
    const yielding *y = e->data;
    bool on[SWITCHES];
    there at;
    for (int k = 0; k < e->switches; k++)
        on[k] = true;
    fw_effects_port_state pressed = *s;
    pressed.on = on;
    if (!find_all(e, &pressed, &at)) return y->own.class_->switch_value(&y->own, s, i);
    find_passed(y, &at, 3 * e->ports);
    at.own.w = at.passed;
    return y->own.class_->switch_value(&y->own, &at.own, i);
}

/* df = f' - K dx, (1 + A K) dx = A f' */
static void slope(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const yielding *y = e->data;
    const int n = 3 * e->ports;
    double by[N], given[N], dx[N] = {0};
    there at;
    memset(f, 0, (size_t)n * sizeof *f);
    if (!find_all(e, s, &at)) return;
    y->own.class_->slope(&y->own, &at.own, by);
    for (int g = 0; g < y->ngiven; g++)
        times(at.a[g], by + 3 * y->given[g], given + 3 * g);
    fw_maths_lu_solve(3 * y->ngiven, at.series, at.pivot, NULL, given);
    for (int k = 0; k < 3 * y->ngiven; k++)
        dx[place_of(y, k)] = given[k];
    for (int i = 0; i < n; i++) {
        f[i] = by[i];
        for (int k = 0; k < n; k++)
            f[i] -= at.stiff[i * n + k] * dx[k];
    }
    for (int i = 0; i < n; i += 3)
        f[i + 2] += dx[i] * at.still[i + 1] - dx[i + 1] * at.still[i] + at.d[i] * f[i + 1] -
                    at.d[i + 1] * f[i];
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    const yielding *y = e->data;
    there at;
    if (!find_place(e, s, &at)) {
        *why =
            "the slender part of a body on which it acts bends by more than 0.15 rad, beyond which "
            "what it gives is not known: make that part wider or shorter, or the load smaller";
        return false;
    }
    return !y->own.class_->valid || y->own.class_->valid(&y->own, &at.own, why);
}

static double pressing(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const yielding *y = e->data;
    there at;
    if (!find_all(e, s, &at)) return 0;
    find_passed(y, &at, 3 * e->ports);
    at.own.w = at.passed;
    return y->own.class_->pressing(&y->own, &at.own);
}

/* As the elements' own, whose effects they stay. beam: where what is known of a part that bends ends is no proof of anything */
static const fw_effects_element_class yielding_class[] = {{.effect = "contact",
                                                           .beam = true,
                                                           .force = force,
                                                           .tangent = tangent,
                                                           .energy = energy,
                                                           .power = power,
                                                           .valid = valid,
                                                           .switch_value = switch_value,
                                                           .pressing = pressing},
                                                          {.effect = "tendon",
                                                           .beam = true,
                                                           .force = force,
                                                           .tangent = tangent,
                                                           .energy = energy,
                                                           .power = power,
                                                           .valid = valid,
                                                           .switch_value = switch_value,
                                                           .slope = slope},
                                                          {.effect = "point-spring",
                                                           .beam = true,
                                                           .force = force,
                                                           .tangent = tangent,
                                                           .energy = energy,
                                                           .power = power,
                                                           .valid = valid,
                                                           .switch_value = switch_value}};
enum { CLASSES = sizeof yielding_class / sizeof yielding_class[0] };

/* ---- the row ---- */

static bool gives(const fw_mechanism *m, int body, double x_m, double y_m) {
    return fw_mechanism_give_at(m, body, x_m, y_m) != NULL;
}

static int count(const fw_effect_case *c) {
    const fw_mechanism *m = c->mechanism;
    int n = 0;
    for (int i = 0; m->ngive > 0 && i < c->scene->ncontact; i++) {
        const fw_device_contact_use *k = &c->scene->contact[i];
        n += k->joint == FW_NONE &&
             (gives(m, k->body_a, k->ax_m, k->ay_m) || gives(m, k->body_b, k->bx_m, k->by_m));
    }
    for (int i = 0; m->ngive > 0 && i < c->scene->ntendon; i++) {
        const fw_device_tendon *t = &c->scene->tendon[i];
        bool any = false;
        for (int k = 0; isnan(t->pull_N) && k < t->neyelet; k++)
            any = any || gives(m, t->eyelet[k].body, t->eyelet[k].x_m, t->eyelet[k].y_m);
        n += any;
    }
    for (int i = 0; m->ngive > 0 && i < m->nspring; i++) {
        const fw_device_spring *k = &m->spring[i];
        n += gives(m, k->body_a, k->ax_m, k->ay_m) || gives(m, k->body_b, k->bx_m, k->by_m);
    }
    return n;
}

static bool called_for(const fw_effect_case *c) {
    return count(c) > 0;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    (void)c;
    *value = (double)INFINITY;
    *reason = "what acts on slender parts of bodies is softer by them: they are the motion itself";
    return FW_OK;
}

static const fw_effects_element_class *class_of(const fw_effects_force_element *e) {
    for (int i = 0; i < CLASSES; i++)
        if (strcmp(e->class_->effect, yielding_class[i].effect) == 0) return &yielding_class[i];
    return NULL;
}

/* the element in its place of the list, with what its ports give */
static fw_status yield(const fw_effect_case *c, fw_effects_force_element *e) {
    const fw_effects_element_class *class_ = class_of(e);
    bool any = false;
    if (!class_ || e->pin != FW_NONE || !(e->size_N_per_m > 0) || e->ports > PORTS ||
        e->switches > SWITCHES)
        return FW_OK;
    for (int i = 0; i < e->ports; i++)
        any = any || gives(c->mechanism, e->port[i].body, e->port[i].x_m, e->port[i].y_m);
    if (!any) return FW_OK;
    yielding *y = fw_arena_one(c->arena, yielding);
    FW_NEED(y);
    y->own = *e;
    for (int i = 0; i < e->ports; i++) {
        const fw_effects_port *at = &e->port[i];
        const fw_mechanism_give *g = fw_mechanism_give_at(c->mechanism, at->body, at->x_m, at->y_m);
        if (!g) continue;
        static const int from[3] = {1, 2, 0}; /* that is of moment and turn, x, y */
        for (int k = 0; k < 9; k++)
            y->c[y->ngiven][k] = g->c[3 * from[k / 3] + from[k % 3]];
        y->given[y->ngiven++] = i;
    }
    e->class_ = class_, e->data = y;
    return FW_OK;
}

fw_status fw_effects_spring_element(const fw_effect_case *c, fw_effects_loads *loads,
                                    const fw_device_spring *k, const fw_effects_foreign *of) {
    point_spring *s = fw_arena_one(c->arena, point_spring);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &spring_class, 2);
    if (!s || !e) return FW_NOMEM;
    s->length_m = k->length_m, s->stiffness_N_per_m = k->stiffness_N_per_m;
    s->damping_Ns_per_m = k->damping_Ns_per_m;
    if (of) s->foreign = *of;
    if (k->id) e->id = k->id;
    e->place = k->place;
    e->port[0] = (fw_effects_port){k->body_a, k->ax_m, k->ay_m};
    e->port[1] = (fw_effects_port){k->body_b, k->bx_m, k->by_m};
    e->switches = k->cable;
    e->data = s;
    e->size_N_per_m = k->stiffness_N_per_m;
    e->dissipates = k->damping_Ns_per_m > 0;
    if (of && of->law) e->law[0] = of->law, e->laws = 1, e->works = true;
    return of ? FW_OK : yield(c, e);
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    const fw_mechanism *m = c->mechanism;
    for (int i = 0; i < loads->nelement; i++)
        FW_TRY(yield(c, &loads->element[i]));
    int kept = 0;
    for (int i = 0; i < loads->nspring; i++) {
        const fw_device_spring k = loads->spring[i];
        if (k.stiffness_N_per_m > 0 &&
            (gives(m, k.body_a, k.ax_m, k.ay_m) || gives(m, k.body_b, k.bx_m, k.by_m)))
            FW_TRY(fw_effects_spring_element(c, loads, &k, NULL));
        else
            loads->spring[kept++] = k;
    }
    loads->nspring = kept;
    return FW_OK;
}

const fw_effect_row fw_effect_body_compliance = {
    .id = "body-compliance",
    .summary = "what slender parts of bodies give where contacts, springs and cables act on them",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 21500,
    .count = count,
    .kept = true,
    .passive = true,
    .solid = FW_EFFECTS_SOLID_HAS};
