/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tendons: a cable without mass and friction through eyelets 0..n-1, fixed at the first, an
   actuator behind the last. Path L = sum |p_{i+1} - p_i| over the eyelets as they are now, and

     pulled  T = max(0, pull law s)
     drawn   T = k g + c g'  where it is taut, else 0;  g = L + draw law s - rest,
             rest = path as drawn + slack; taut while min(k g, k g + c g') > 0

   where rest and draw are lengths of a cable that does not grow with the layer (fw_effects_foreign), and
   with the load factor s (1 but in statics). Virtual work: f = -T grad L on the eyelets, that is T
   along the cable on the outer ones and T (u_after - u_before) in a bend. Tangent, H = hess L:

     -df/dp = T H + grad L (k grad L + c H w)^T,    -df/dw = c grad L grad L^T.

   Stored k g^2/2; c g'^2 is lost; the actuator gives T draw law' s (drawn) or -T L' (pulled: at its
   end the cable moves by -L'). Two eyelets that meet have the direction of their relative velocity,
   or none, as a spring between points, and no geometric stiffness.
   Inputs SI. Exact for this model to round-off; what it leaves out (friction at eyelets, weight of
   the cable): docs/theory/effects/tendon.md. Cost about 650 instructions with three eyelets.
   Source: principle of virtual work, e.g. Shabana, Dynamics of Multibody Systems, ch. 3.
   Test: test_tendon.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "quantity/law_kind.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct tendon {
    double pull_N; /* NaN: drawn */
    double draw_m, k_N_per_m, c_Ns_per_m, rest_m;
    fw_effects_foreign foreign;   /* the cable is not of the layer: its lengths in those of it */
    const fw_quantity_law *taken; /* the law of the draw, NULL: constant */
} tendon;

/* factor of the actuation and its rate; likewise of the cable's own lengths */
typedef struct modal_speed {
    double factor, rate_per_s, own, own_per_s;
} modal_speed;

static const tendon *data_of(const fw_effects_force_element *e) {
    return e->data;
}

static bool pulled(const tendon *d) {
    return !isnan(d->pull_N);
}

static modal_speed modal_speed_of(const fw_effects_force_element *e,
                                  const fw_effects_port_state *s) {
    const tendon *d = data_of(e);
    double value[3] = {1, 0, 0}, way;
    /* who takes an element's laws away asks for what it does at their factor 1 */
    if (d->taken && e->laws > 0) fw_quantity_law_value(d->taken, s->t_s, s->piece_s, value);
    const double own = fw_effects_foreign_at(&d->foreign, s->t_s, s->piece_s, &way);
    return (modal_speed){value[0], s->still ? 0 : value[1], own, s->still ? 0 : way};
}

/* ---- the path ---- */

typedef struct segment { /* from eyelet i to i + 1 */
    double length, ux, uy;
} segment;

/* points of a segment that are no farther apart than this coincide */
static double round_off(const fw_effects_port *port, const double *p) {
    double reach = 0;
    for (int i = 0; i < 2; i++)
        reach += fabs(p[3 * i]) + fabs(p[3 * i + 1]) + fabs(port[i].x_m) + fabs(port[i].y_m);
    return 64 * DBL_EPSILON * reach;
}

static segment segment_of(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          int i) {
    const double *p = s->p + 3 * i, *w = s->w + 3 * i;
    double dx = p[3] - p[0], dy = p[4] - p[1], wx = w[3] - w[0], wy = w[4] - w[1];
    double length = sqrt(dx * dx + dy * dy), size = length;
    if (length <= round_off(&e->port[i], p)) {
        dx = wx, dy = wy, size = sqrt(wx * wx + wy * wy);
        length = 0; /* marks that they meet */
    }
    return (segment){length, size > 0 ? dx / size : 0, size > 0 ? dy / size : 0};
}

/* L and L'; grad (3 ports) may be NULL */
static void path_of(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *length, double *rate, double *grad) {
    *length = *rate = 0;
    if (grad) memset(grad, 0, 3 * (size_t)e->ports * sizeof *grad);
    for (int i = 0; i + 1 < e->ports; i++) {
        const double *w = s->w + 3 * i;
        segment g = segment_of(e, s, i);
        *length += g.length;
        *rate += g.ux * (w[3] - w[0]) + g.uy * (w[4] - w[1]);
        if (!grad) continue;
        grad[3 * i] -= g.ux, grad[3 * i + 1] -= g.uy;
        grad[3 * i + 3] += g.ux, grad[3 * i + 4] += g.uy;
    }
}

/* how far a drawn cable is stretched beyond its rest length, and how fast */
static void stretch_of(const tendon *d, modal_speed at, double load, double length, double rate,
                       double *stretch, double *speed) {
    *stretch = length + d->draw_m * at.factor * load * at.own - d->rest_m * at.own;
    *speed = rate + d->draw_m * at.rate_per_s * load * at.own +
             (d->draw_m * at.factor * load - d->rest_m) * at.own_per_s;
}

/* ---- the class ---- */

/* T as the switch says: a cable that is held on may for the rest of a step push a little */
static double tension(const fw_effects_force_element *e, const fw_effects_port_state *s,
                      double length, double rate) {
    const tendon *d = data_of(e);
    modal_speed at = modal_speed_of(e, s);
    double stretch, speed;
    if (e->switches > 0 && !s->on[0]) return 0;
    if (pulled(d)) {
        double pull = d->pull_N * at.factor * s->load;
        return e->switches > 0 ? pull : fmax(0, pull);
    }
    stretch_of(d, at, s->load, length, rate, &stretch, &speed);
    return d->k_N_per_m * stretch + d->c_Ns_per_m * speed;
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double length, rate;
    path_of(e, s, &length, &rate, f);
    double t = tension(e, s, length, rate);
    for (int i = 0; i < 3 * e->ports; i++)
        f[i] *= -t;
}

/* += T H, and, in `turned`, H w */
static void geometric(const fw_effects_force_element *e, const fw_effects_port_state *s, double t,
                      double *stiffness, double *turned) {
    int n = 3 * e->ports;
    for (int i = 0; i + 1 < e->ports; i++) {
        segment g = segment_of(e, s, i);
        if (!(g.length > 0)) continue;
        double h[2][2] = {{g.uy * g.uy / g.length, -g.ux * g.uy / g.length},
                          {-g.ux * g.uy / g.length, g.ux * g.ux / g.length}};
        const double *w = s->w + 3 * i;
        for (int a = 0; a < 2; a++) {
            double way = h[a][0] * (w[3] - w[0]) + h[a][1] * (w[4] - w[1]);
            turned[3 * i + a] -= way;
            turned[3 * i + 3 + a] += way;
            for (int b = 0; b < 2; b++)
                for (int k = 0; k < 4; k++) {
                    int row = 3 * (i + k / 2) + a, column = 3 * (i + k % 2) + b;
                    stiffness[row * n + column] += (k / 2 == k % 2 ? t : -t) * h[a][b];
                }
        }
    }
}

/* grad L and H w are kept in the first row of the two matrices while these are not yet needed */
static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const tendon *d = data_of(e);
    int n = 3 * e->ports;
    double length, rate;
    memset(stiffness, 0, (size_t)n * (size_t)n * sizeof *stiffness);
    memset(damping, 0, (size_t)n * (size_t)n * sizeof *damping);
    bool taut = e->switches == 0 || s->on[0], elastic = taut && !pulled(d);
    double *grad = damping, *turned = damping + n; /* n >= 6: two rows */
    path_of(e, s, &length, &rate, grad);
    geometric(e, s, tension(e, s, length, rate), stiffness, turned);
    for (int i = 0; elastic && i < n; i++)
        for (int j = 0; j < n; j++)
            stiffness[i * n + j] += grad[i] * (d->k_N_per_m * grad[j] + d->c_Ns_per_m * turned[j]);
    memset(turned, 0, (size_t)n * sizeof *turned);
    double c = elastic ? d->c_Ns_per_m : 0;
    for (int i = n - 1; i >= 0; i--) { /* the first row, which holds grad L, last */
        double share = c * grad[i];
        for (int j = n - 1; j >= 0; j--)
            damping[i * n + j] = share * grad[j];
    }
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const tendon *d = data_of(e);
    double length, rate, stretch, speed;
    if (pulled(d) || !s->on[0]) return 0;
    path_of(e, s, &length, &rate, NULL);
    stretch_of(d, modal_speed_of(e, s), s->load, length, rate, &stretch, &speed);
    return 0.5 * d->k_N_per_m * stretch * stretch;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    const tendon *d = data_of(e);
    double length, rate, stretch, speed;
    path_of(e, s, &length, &rate, NULL);
    double t = tension(e, s, length, rate);
    out[0] = 0, out[1] = -t * rate;
    if (pulled(d)) return;
    modal_speed at = modal_speed_of(e, s);
    stretch_of(d, at, s->load, length, rate, &stretch, &speed);
    if (s->on[0]) out[0] = d->c_Ns_per_m * speed * speed;
    out[1] = t * (speed - rate);
}

/* the load factor never decides whether a pulled cable pulls: at 0 it is about to */
static double switch_value(const fw_effects_force_element *e, const fw_effects_port_state *s,
                           int i) {
    (void)i;
    const tendon *d = data_of(e);
    modal_speed at = modal_speed_of(e, s);
    double length, rate, stretch, speed;
    if (pulled(d)) return d->pull_N * at.factor;
    path_of(e, s, &length, &rate, NULL);
    stretch_of(d, at, s->load, length, rate, &stretch, &speed);
    return fmin(d->k_N_per_m * stretch, d->k_N_per_m * stretch + d->c_Ns_per_m * speed);
}

static void slope(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const tendon *d = data_of(e);
    modal_speed at = modal_speed_of(e, s);
    double length, rate, t;
    path_of(e, s, &length, &rate, f);
    if (pulled(d))
        t = d->pull_N * at.factor;
    else
        t = d->draw_m * (d->k_N_per_m * at.factor * at.own +
                         d->c_Ns_per_m * (at.rate_per_s * at.own + at.factor * at.own_per_s));
    if (e->switches > 0 && !s->on[0]) t = 0;
    for (int i = 0; i < 3 * e->ports; i++)
        f[i] *= -t;
}

static const fw_effects_element_class tendon_class = {.effect = "tendon",
                                                      .force = force,
                                                      .tangent = tangent,
                                                      .energy = energy,
                                                      .power = power,
                                                      .switch_value = switch_value,
                                                      .slope = slope};

/* ---- the row ---- */

static bool called_for(const fw_effect_case *c) {
    return c->scene->ntendon > 0;
}

/* Kept whatever it is. Of tendons that may go slack it says how far the motion without them, which
   the other bounds are made from, is from the one with them: envelope_find.c */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    bool loose = e && e->valid && e->loose_pull > 0 && isfinite(e->loose_pull);
    *value = loose ? e->loose_pull : (double)INFINITY;
    *reason = loose ? "kept; bound: answer to the largest pull of those that may go slack, of any "
                      "course"
                    : "the scene has tendons: they are the motion itself";
    return FW_OK;
}

static double path_as_drawn(const fw_mechanism *m, const fw_device_tendon *t) {
    double length = 0;
    for (int i = 0; i + 1 < t->neyelet; i++) {
        const fw_device_eyelet *a = &t->eyelet[i], *b = a + 1;
        fw_geometry_vec2 from = fw_mechanism_local_place(m, a->body, a->x_m, a->y_m);
        fw_geometry_vec2 to = fw_mechanism_local_place(m, b->body, b->x_m, b->y_m);
        length += hypot(to.x - from.x, to.y - from.y);
    }
    return length;
}

/* a pull that its law only ever makes smaller never lets go, so that nothing has to be switched */
static bool always_pulls(const fw_device_tendon *t) {
    return t->pull_N >= 0 && fw_quantity_law_never_negative(t->law);
}

static fw_status add_one(const fw_effect_case *c, const fw_device_tendon *t,
                         fw_effects_loads *loads) {
    tendon *d;
    fw_effects_force_element *e;
    FW_NEED(d = fw_arena_one(c->arena, tendon));
    FW_NEED(e = fw_effects_loads_add_element(c->arena, loads, &tendon_class, t->neyelet));
    double most = fw_quantity_law_largest(t->law, c->scene->duration_s);
    *d = (tendon){.pull_N = t->pull_N};
    e->id = t->id ? t->id : "tendon";
    e->place = t->place;
    e->data = d;
    for (int i = 0; i < t->neyelet; i++)
        e->port[i] = (fw_effects_port){t->eyelet[i].body, t->eyelet[i].x_m, t->eyelet[i].y_m};
    if (!fw_quantity_law_is_constant(t->law)) e->law[e->laws++] = d->taken = t->law;
    e->works = true;
    if (pulled(d)) {
        e->switches = !always_pulls(t);
        e->force_N = fabs(t->pull_N) * most;
        return FW_OK;
    }
    d->draw_m = t->draw_m;
    d->foreign = fw_effects_foreign_of(c, t->expansion_per_K);
    if (d->foreign.law) e->law[e->laws++] = d->foreign.law;
    d->k_N_per_m = t->stiffness_N_per_m;
    d->c_Ns_per_m = t->damping_Ns_per_m;
    d->rest_m = path_as_drawn(c->mechanism, t) + t->slack_m;
    e->switches = 1;
    e->dissipates = d->c_Ns_per_m > 0;
    e->size_N_per_m = d->k_N_per_m;
    e->force_N = d->k_N_per_m * (fabs(d->draw_m) * most + fmax(0, -t->slack_m));
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->scene->ntendon; i++)
        FW_TRY(add_one(c, &c->scene->tendon[i], loads));
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    return c->scene->ntendon;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    for (int i = 0; i < s->ntendon; i++) {
        const fw_device_tendon *t = &s->tendon[i];
        const bool pulls = !isnan(t->pull_N);
        fw_effects_say(to, "; cable {s} {s} {u}", t->id, pulls ? "pulls with" : "taken in by",
                       pulls ? t->pull_N : t->draw_m, pulls ? "N" : "m");
        fw_effects_say_law(to, t->law);
    }
}

static void loads(const fw_device_scene *s, fw_effects_load_scaling *list) {
    bool pulls = false, draws = false;
    for (int i = 0; i < s->ntendon; i++) {
        pulls = pulls || !isnan(s->tendon[i].pull_N);
        draws = draws || !isnan(s->tendon[i].draw_m);
    }
    if (pulls) fw_effects_add_load(list, (fw_effects_load){.name = "tendon pulls"});
    if (draws) fw_effects_add_load(list, (fw_effects_load){.name = "tendon draws"});
}

/* the one of the two that is not there (NaN) stays so */
static void scale(fw_device_scene *s, double by) {
    for (int i = 0; i < s->ntendon; i++) {
        s->tendon[i].pull_N *= by;
        s->tendon[i].draw_m *= by;
    }
}

static void values(const fw_device_scene *s, fw_effects_load_values *list) {
    for (int i = 0; i < s->ntendon; i++) {
        const fw_device_tendon *t = &s->tendon[i];
        const bool pulled = !isnan(t->pull_N);
        fw_effects_add_load_value(list,
                                  (fw_effects_load_value){.element = "tendon",
                                                          .id = t->id,
                                                          .attribute = pulled ? "pull" : "draw",
                                                          .unit = pulled ? "N" : "m",
                                                          .value = pulled ? t->pull_N : t->draw_m});
    }
}

const fw_effect_row fw_effect_tendon = {
    .id = "tendon",
    .summary = "cables through eyelets, pulled with a force or drawn in by a length",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 953,
    .count = count,
    .kept = true,
    .describe = describe,
    .loads = loads,
    .scale = scale,
    .values = values};
