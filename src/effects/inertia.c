/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inertia against a motion that is a row of equilibria. Theory: docs/theory/effects/inertia.md. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static bool called_for(const fw_effect_case *c) {
    return c->mechanism->nbody > 0;
}

/* ---- how unsteady a law is ---- */

typedef struct unrest { /* over the scene */
    double jumps;       /* sum of |jumps| of the value behind t = 0 */
    double slope;       /* 1/s: |f'(0+)| + total variation of f' behind it, its jumps included */
} unrest;

/* int |f''| of f = sin(a) over phases a of length `turned` from `from`, per angular frequency */
static double sine_variation(double from, double turned) {
    double whole = floor(turned / PI), rest = turned - whole * PI;
    double start = from - PI * floor(from / PI), end = start + rest; /* |sin| has the period pi */
    double part = end <= PI ? cos(start) - cos(end) : cos(start) + 2 + cos(end);
    return 2 * whole + part;
}

/* total variation of f' inside (a, b), where f is smooth, by sampling every `step`: the midpoint
   rule of |f''|. A sign change of f'' inside a cell hides less than its share of one cell. */
static double sampled_variation(const fw_law *law, double a, double b, double piece, double step) {
    double count = fmin(fmax(ceil((b - a) / step), 64), 1e6), sum = 0, value[3];
    for (double i = 0; i < count; i++) {
        fw_law_value(law, a + (b - a) * (i + 0.5) / count, piece, value);
        sum += fabs(value[2]);
    }
    return 1.01 * sum * (b - a) / count;
}

/* shortest step that sees all of an expression between a and b */
static double finest(const fw_law_strides *strides, double a, double b) {
    double most = (double)INFINITY;
    for (int i = 0; i < strides->n; i++) {
        double end = i + 1 < strides->n ? strides->t_s[i + 1] : (double)INFINITY;
        if (strides->t_s[i] < b && end > a) most = fmin(most, strides->most_s[i]);
    }
    return most;
}

/* inside the piece (a, b), for every row of strides with the step that it asks for */
static double expression_variation(const fw_law *law, const fw_law_strides *strides, double a,
                                   double b, double end_s) {
    double sum = 0, piece = 0.5 * (a + b);
    double from = a;
    for (int i = 0; i <= strides->n; i++) {
        double to = i < strides->n ? fmin(b, strides->t_s[i]) : b;
        if (!(to > from)) continue;
        double step = fmin(finest(strides, from, to) / 16, end_s / 4096);
        sum += sampled_variation(law, from, to, piece, step);
        from = to;
    }
    return sum;
}

static double smooth_variation(const fw_law *law, const fw_law_strides *strides, double a, double b,
                               double end_s) {
    double w = 2 * PI * law->frequency_Hz, piece = 0.5 * (a + b);
    switch (law->kind) {
    case FW_LAW_STEP:
    case FW_LAW_RAMP:
    case FW_LAW_TABLE:
        return 0;
    case FW_LAW_SINE:
        if (piece < law->start_s || piece >= law->end_s) return 0;
        return w * sine_variation(w * (a - law->start_s) + law->phase_rad, w * (b - a));
    case FW_LAW_HALF_SINE:
        if (piece < law->start_s || piece >= law->start_s + law->rise_s) return 0;
        w = PI / law->rise_s;
        return w * sine_variation(w * (a - law->start_s), w * (b - a));
    case FW_LAW_RANDOM:
        return sampled_variation(law, a, b, piece,
                                 1 / (64 * fmax(law->frequency_Hz, law->frequency_most_Hz)));
    case FW_LAW_EXPRESSION:
    default:
        return expression_variation(law, strides, a, b, end_s);
    }
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Jumps and the variation of the slope of a law over (0, end_s). Exact for steps, ramps, tables,
   sines and half sines; random and expressions by midpoint sums with a hundredth on top. */
static fw_status look_at_law(fw_arena *arena, const fw_law *law, double end_s, unrest *out) {
    *out = (unrest){0};
    if (fw_law_is_constant(law)) return FW_OK;
    fw_law_strides strides = {0};
    int count = fw_law_breaks(law, end_s, NULL, 0);
    double *at, value[3], next[3];
    FW_NEED(at = fw_arena_array(arena, double, (size_t)count + 1));
    count = fw_law_breaks(law, end_s, at, count);
    if (count > 1) qsort(at, (size_t)count, sizeof *at, by_size);
    if (law->kind == FW_LAW_EXPRESSION)
        FW_TRY(fw_law_look(arena, law, false, end_s, at, count, &strides));
    at[count] = end_s;
    double from = 0;
    for (int i = 0; i <= count; i++) {
        double to = at[i], piece = 0.5 * (from + to);
        if (!(to > from)) continue;
        fw_law_value(law, from, piece, next); /* the limit from the right */
        out->jumps += from > 0 ? fabs(next[0] - value[0]) : 0;
        out->slope += from > 0 ? fabs(next[1] - value[1]) : fabs(next[1]);
        out->slope += smooth_variation(law, &strides, from, to, end_s);
        fw_law_value(law, to, piece, value);
        from = to;
    }
    if (!isfinite(out->jumps) || !isfinite(out->slope))
        *out = (unrest){(double)INFINITY, (double)INFINITY};
    return FW_OK;
}

/* ---- modal forces and damping ---- */

typedef struct modal {
    const fw_effect_case *c;
    const fw_envelope *e;
    fw_terms terms;   /* all that acts but inertia */
    double *force;    /* (n) work */
    double *push;     /* (modes) of one group of loads */
    double *rotation; /* (npin) bound, rad */
    double *flexible; /* (npin) sqrt(sum turn^2 / omega^2) */
    double lag;       /* s: |W^-1 D W^-1|, D: modal damping */
    bool damped;
} modal;

/* everything that the scene calls for, whether or not it will be left out: a bound on all of it */
static fw_status gather(modal *m) {
    const fw_effect_case *c = m->c;
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    FW_TRY(fw_terms_new(c->arena, c->mechanism, c->scene, &m->terms));
    for (size_t i = 0; i < count; i++)
        if (row[i] != &fw_effect_inertia && row[i]->called_for(c))
            FW_TRY(row[i]->add(c, &m->terms));
    FW_NEED(m->force = fw_arena_array(c->arena, double, (size_t)m->e->n));
    FW_NEED(m->push = fw_arena_array(c->arena, double, (size_t)m->e->modes));
    FW_NEED(m->rotation = fw_arena_array(c->arena, double, (size_t)c->mechanism->npin));
    FW_NEED(m->flexible = fw_arena_array(c->arena, double, (size_t)c->mechanism->npin));
    return FW_OK;
}

static double along(const modal *m, int mode, const double *force) {
    const double *shape = m->e->shape + (size_t)mode * (size_t)m->e->n;
    double sum = 0;
    for (int i = 0; i < m->e->n; i++)
        sum += shape[i] * force[i];
    return sum;
}

/* modal damping D (modes x modes) += c g g^T, g = rate of the damper in every mode */
static void add_damper(const modal *m, double c, const double *rate, double *d) {
    for (int j = 0; j < m->e->modes; j++)
        for (int k = 0; k < m->e->modes; k++)
            d[j * m->e->modes + k] += c * rate[j] * rate[k];
}

/* rate at which point b goes away from point a along (ux, uy) in every mode */
static void rates_along(const modal *m, int a, fw_vec2 pa, int b, fw_vec2 pb, double ux, double uy,
                        double *rate) {
    const fw_mechanism *from = m->c->mechanism;
    memset(m->force, 0, (size_t)m->e->n * sizeof(double));
    for (int side = 0; side < 2; side++) {
        int body = side ? b : a;
        fw_vec2 p = side ? pb : pa;
        double sign = side ? 1 : -1;
        if (body == FW_GROUND) continue;
        m->force[3 * body] += sign * ux;
        m->force[3 * body + 1] += sign * uy;
        m->force[3 * body + 2] +=
            sign * ((p.x - from->body[body].x_m) * uy - (p.y - from->body[body].y_m) * ux);
    }
    for (int j = 0; j < m->e->modes; j++)
        rate[j] = along(m, j, m->force);
}

static void add_springs(const modal *m, double *rate, double *d) {
    const fw_mechanism *from = m->c->mechanism;
    for (int i = 0; i < m->terms.nspring; i++) {
        const fw_spring *s = &m->terms.spring[i];
        fw_vec2 a = fw_local_place(from, s->body_a, s->ax_m, s->ay_m);
        fw_vec2 b = fw_local_place(from, s->body_b, s->bx_m, s->by_m);
        double l = hypot(b.x - a.x, b.y - a.y);
        bool line = l > 0; /* points that coincide: damped in all directions */
        if (!(s->damping_Ns_per_m > 0)) continue;
        rates_along(m, s->body_a, a, s->body_b, b, line ? (b.x - a.x) / l : 1,
                    line ? (b.y - a.y) / l : 0, rate);
        add_damper(m, s->damping_Ns_per_m, rate, d);
        if (line) continue;
        rates_along(m, s->body_a, a, s->body_b, b, 0, 1, rate);
        add_damper(m, s->damping_Ns_per_m, rate, d);
    }
    for (int i = 0; i < m->terms.nslide; i++) {
        const fw_tie *t = &from->tie[m->terms.slide[i].tie];
        fw_vec2 b = fw_local_place(from, t->body_b, t->bx_m, t->by_m);
        double turned = t->axis_rad + (t->body_a == FW_GROUND ? 0 : from->body[t->body_a].phi_rad);
        /* the axis turns with body a: both ends move as points at b */
        rates_along(m, t->body_a, b, t->body_b, b, cos(turned), sin(turned), rate);
        add_damper(m, m->terms.slide[i].damping_Ns_per_m, rate, d);
    }
}

static fw_status add_elements(const modal *m, double *d) {
    const fw_mechanism *from = m->c->mechanism;
    fw_arena *arena = m->c->arena;
    size_t n = (size_t)m->e->n;
    double *q, *whole, *damping;
    FW_NEED(q = fw_arena_array(arena, double, n));
    FW_NEED(whole = fw_arena_array(arena, double, n *n));
    FW_NEED(damping = fw_arena_array(arena, double, n *n));
    for (int b = 0; b < from->nbody; b++)
        q[3 * b] = from->body[b].x_m, q[3 * b + 1] = from->body[b].y_m,
              q[3 * b + 2] = from->body[b].phi_rad;
    for (int i = 0; i < m->terms.nelement; i++) {
        const fw_force_element *e = &m->terms.element[i];
        size_t p = 3 * (size_t)e->ports;
        double *see, *k;
        FW_NEED(see = fw_arena_array(arena, double, 3 * p));
        FW_NEED(k = fw_arena_array(arena, double, 2 * p * p));
        const fw_seen now = {.piece_s = DBL_MIN, .load = 1, .p = see, .w = see + p};
        fw_element_look(e, q, NULL, see, see + p);
        e->class_->force(e, &now, see + 2 * p);
        e->class_->tangent(e, &now, k, k + p * p);
        fw_element_push(e, q, see + 2 * p, m->force);
        fw_element_spread(e, from->nbody, q, NULL, see + 2 * p, k, k + p * p, whole, damping);
    }
    for (int j = 0; j < m->e->modes; j++)
        for (int k = 0; k < m->e->modes; k++) {
            const double *right = m->e->shape + (size_t)k * n;
            for (size_t r = 0; r < n; r++) {
                double sum = 0;
                for (size_t s = 0; s < n; s++)
                    sum += damping[r * n + s] * right[s];
                d[j * m->e->modes + k] += m->e->shape[(size_t)j * n + r] * sum;
            }
        }
    return FW_OK;
}

/* |W^-1 D W^-1| from above, by the sum of squares of its entries. The forces of the elements at the
   start are left in m->force. */
static fw_status find_lag(modal *m) {
    size_t modes = (size_t)m->e->modes;
    double *d, *rate, sum = 0;
    FW_NEED(d = fw_arena_array(m->c->arena, double, modes *modes));
    FW_NEED(rate = fw_arena_array(m->c->arena, double, modes));
    for (int i = 0; i < m->terms.ntorsion; i++) {
        const fw_torsion *t = &m->terms.torsion[i];
        for (size_t j = 0; j < modes; j++)
            rate[j] = m->e->turn[j * (size_t)m->c->mechanism->npin + (size_t)t->pin];
        add_damper(m, t->damping_Nms_per_rad, rate, d);
    }
    add_springs(m, rate, d);
    memset(m->force, 0, (size_t)m->e->n * sizeof(double));
    if (m->terms.nelement > 0) FW_TRY(add_elements(m, d));
    for (size_t j = 0; j < modes; j++)
        for (size_t k = 0; k < modes; k++) {
            double part = d[j * modes + k] / (m->e->omega[j] * m->e->omega[k]);
            sum += part * part;
        }
    m->lag = sqrt(sum);
    m->damped = m->lag > 0;
    return FW_OK;
}

/* ---- sums over modes ---- */

/* What one group of loads with modal forces `push` that share a law can move every pin off its
   equilibrium. Undamped, mode by mode: (|F|/omega^2) jumps + (|F|/omega^3) slope. Damped, in the
   energy norm of all modes: |turn/omega| |F/omega| (jumps + (kappa + sqrt(kappa^2 + 1/omega_1^2))
   slope). `speed`: push is a velocity, which moves by v/omega. */
static void spread(modal *m, const unrest *u, bool speed) {
    int pins = m->c->mechanism->npin, modes = m->e->modes;
    double size = 0, lowest = m->e->omega[0];
    for (int j = 0; j < modes; j++) {
        double w = m->e->omega[j], part = m->push[j] / (speed ? 1 : w);
        size += part * part;
        lowest = fmin(lowest, w);
    }
    double whole = sqrt(size) * (u->jumps + (m->lag + hypot(m->lag, 1 / lowest)) * u->slope);
    for (int p = 0; p < pins; p++) {
        double sum = 0;
        for (int j = 0; j < modes && !m->damped; j++) {
            double w = m->e->omega[j], f = fabs(m->push[j]) / (speed ? w : w * w);
            sum += fabs(m->e->turn[j * pins + p]) * f * (u->jumps + u->slope / w);
        }
        m->rotation[p] += m->damped ? m->flexible[p] * whole : sum;
    }
}

static void add_load(const fw_mechanism *m, const fw_timed_load *l, double *force) {
    if (l->body == FW_GROUND) return;
    fw_vec2 p = fw_local_place(m, l->body, l->x_m, l->y_m);
    force[3 * l->body] += l->fx_N;
    force[3 * l->body + 1] += l->fy_N;
    force[3 * l->body + 2] += l->torque_Nm + (p.x - m->body[l->body].x_m) * l->fy_N -
                              (p.y - m->body[l->body].y_m) * l->fx_N;
}

/* loads that share a law go together */
static fw_status spread_timed(modal *m) {
    const fw_terms *t = &m->terms;
    for (int i = 0; i < t->ntimed; i++) {
        bool done = false;
        for (int k = 0; k < i; k++)
            done = done || t->timed[k].law == t->timed[i].law;
        if (done) continue;
        unrest u;
        memset(m->force, 0, (size_t)m->e->n * sizeof(double));
        for (int k = i; k < t->ntimed; k++)
            if (t->timed[k].law == t->timed[i].law)
                add_load(m->c->mechanism, &t->timed[k], m->force);
        FW_TRY(look_at_law(m->c->arena, t->timed[i].law, m->c->scene->duration_s, &u));
        for (int j = 0; j < m->e->modes; j++)
            m->push[j] = along(m, j, m->force);
        spread(m, &u, false);
    }
    return FW_OK;
}

/* what acts from the start on is put on at once: a jump; m->force has the elements' part */
static fw_status spread_start(modal *m) {
    double *first;
    FW_NEED(first = fw_arena_array(m->c->arena, double, (size_t)m->e->n));
    fw_terms_initial_force(m->c->mechanism, &m->terms, first);
    const unrest jump = {.jumps = 1};
    for (int i = 0; i < m->e->n; i++)
        first[i] += m->force[i];
    for (int j = 0; j < m->e->modes; j++)
        m->push[j] = along(m, j, first);
    spread(m, &jump, false);
    /* velocities v in the mass metric: M v against the shapes */
    for (int i = 0; i < m->e->n; i++) {
        const fw_mass *b = &m->c->mechanism->body[i / 3];
        first[i] = (i % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * m->terms.velocity[i];
    }
    for (int j = 0; j < m->e->modes; j++)
        m->push[j] = along(m, j, first);
    spread(m, &jump, true);
    return FW_OK;
}

/* ---- what has no bound ---- */

/* the motion then depends on its history, or on more than the sums above know; NULL: it does not */
static const char *reason_to_keep(const fw_effect_case *c, const fw_terms *t) {
    if (c->mechanism->ndriver > 0)
        return "drivers move the mechanism, and its joint forces are those of inertia too: kept";
    if (t->nstop > 0 || t->nfriction > 0 || t->nreleased > 0)
        return "stops, friction or contact: where they act depends on the way there: kept";
    for (int i = 0; i < t->nspring; i++)
        if (t->spring[i].cable) return "cables go slack and taut on the way: kept";
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].switches > 0)
            return "something that touches or goes slack acts on the way: kept";
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].laws > 0)
            return "the force of an actuator depends on the pose and on time at once: kept";
    if (t->strained || t->stretch.law) return "strains set the mechanism in motion: kept";
    for (int i = 0, moves = 0; i < 3 * t->nbody; i++) {
        moves = moves || t->velocity[i] != 0;
        if (moves && c->scene->ninitial < t->nbody)
            return "the scene starts with velocities: inertia carries them on";
    }
    for (int i = 0; i < c->scene->ninitial; i++)
        if (fw_effect_initial_velocity.called_for(c) &&
            (c->scene->initial[i].moves_free || c->scene->initial[i].turns_free))
            return "the scene starts with velocities: inertia carries them on";
    return NULL;
}

/* Relative change of the largest hinge deflection when the motion is taken as a row of equilibria:
   in each mode q'' + omega^2 q = F f(t) moves off q = F f / omega^2 by at most
     (|F|/omega^2) (sum of jumps of f) + (|F|/omega^3) (|f'(0+)| + total variation of f')
   by integrating Duhamel's integral by parts twice, loads of one law together, laws added; viscous
   damping makes the free part smaller and adds a lag (see spread). Inputs: the envelope's modes,
   SI. Output dimensionless, against envelope->floor; infinite where there is no envelope, or where
   the way matters. Valid in the linear theory of the envelope. Cost modes x (n + npin) per law.
   Source: Duhamel's integral, e.g. Clough and Penzien, Dynamics of Structures 1993, ch. 6; the
   integration by parts is ours. Test: test_inertia.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_envelope *e = c->envelope;
    *value = (double)INFINITY;
    *reason = "the motion has no bound in linear theory: inertia acts";
    fw_mark mark = fw_arena_mark(c->arena);
    modal m = {.c = c, .e = e};
    FW_TRY(gather(&m));
    const char *keep = reason_to_keep(c, &m.terms);
    bool held = e->valid && e->modes > 0 && e->floor > 0;
    for (int j = 0; held && j < e->modes; j++)
        held = e->omega[j] > 0;
    if (keep) *reason = keep;
    if (keep || !held) {
        fw_arena_rewind(c->arena, mark);
        if (!keep && e->why_not)
            FW_NEED(*reason = fw_arena_printf(c->arena, "no linear bound on the motion (%s): kept",
                                              e->why_not));
        return FW_OK;
    }
    int pins = c->mechanism->npin;
    for (int p = 0; p < pins; p++) {
        double sum = 0;
        for (int j = 0; j < e->modes; j++)
            sum += pow(e->turn[j * pins + p] / e->omega[j], 2);
        m.flexible[p] = sqrt(sum);
    }
    FW_TRY(find_lag(&m));
    FW_TRY(spread_start(&m));
    FW_TRY(spread_timed(&m));
    double most = 0;
    for (int p = 0; p < pins; p++)
        most = fmax(most, isnan(m.rotation[p]) ? (double)INFINITY : m.rotation[p]);
    fw_arena_rewind(c->arena, mark);
    *value = most / e->floor;
    *reason = "inertia against a row of equilibria: bound from the jumps of the loads and the "
              "changes of their slope, mode by mode, over the largest deflection";
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_terms *terms) {
    (void)c;
    terms->quasi_static = false;
    return FW_OK;
}

static fw_status leave_out(const fw_effect_case *c, fw_terms *terms) {
    (void)c;
    terms->quasi_static = true;
    return FW_OK;
}

const fw_effect_row fw_effect_inertia = {
    .id = "inertia",
    .summary = "masses resist changes of motion; without, the motion is a row of equilibria",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .leave_out = leave_out};
