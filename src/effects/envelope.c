/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/envelope.h"
#include "base/constants.h"
#include "effects/modal.h"
#include <float.h>
#include <math.h>

/* Linear theory says nothing beyond; and how much wider its bounds are made per unit of
   `nonlinearity`.
   None of 16 400 random bounds was too small with these; with 1.5 and 0 one of a stop was
   (docs/theory/effects/envelope.md) */
static const double nonlinearity_most = 0.8, widening = 4;

static fw_status arrays(fw_arena *arena, const fw_effects_modal *o, fw_effects_envelope *e) {
    size_t n = (size_t)o->n, m = (size_t)o->modes, pins = (size_t)o->mechanism->npin;
    FW_NEED(e->across = fw_arena_array(arena, double, (size_t)o->mechanism->njoint));
    e->n = o->n, e->modes = o->modes, e->npin = o->mechanism->npin;
    e->omega = o->omega, e->shape = o->shape, e->turn = o->turn;
    double **of[] = {&e->reach, &e->speed,          &e->angle,     &e->rate,       &e->force,
                     &e->give,  &e->response_bound, &e->amplitude, &e->modal_speed};
    const size_t size[] = {n, n, pins, pins, pins, pins, m, m, m};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(arena, double, size[i]));
    return FW_OK;
}

/* ---- modes ---- */

/* integral of |e^(-zeta w t) sin(v t)/v| over the scene at most, v = w sqrt(1 - zeta^2): without
   the decay, whole arches have 2 / v^2 */
static double undamped(double w, double zeta, double end) {
    double v = w * sqrt(fmax(0, 1 - zeta * zeta)), arches = floor(v * end / FW_PI);
    double whole = (2 * arches + 1 - cos(v * end - FW_PI * arches)) / (v * v);
    return v > 0.5 * w ? fmin(end / w, whole) : end / w;
}

/* Amplitude and speed of a mode, whatever its damping. By parts
     q = (f(t) - f(0) cos wt - int f' cos w(t - s) ds) / w^2:  |q| <= (sup|f| + |f(0+)| + var f) /
   w^2 and plainly |q| <= int |f| / w; of each modal load the smaller one. */
static void size_of_modes(const fw_effects_modal *o, const fw_effects_modal_loads *p,
                          fw_effects_envelope *e) {
    double end = o->scene->duration_s;
    size_t m = (size_t)o->modes;
    for (size_t j = 0; j < m; j++) {
        double w = o->omega[j], q = fabs(o->velocity[j]) / w, v = fabs(o->velocity[j]);
        for (int i = 0; i < p->count; i++) {
            const fw_effects_modal_load *f = &p->item[i];
            double kick = f->first[j] + f->sway[j];
            q += fmin((f->sup[j] + kick) / (w * w), f->full[j] / w);
            v += fmin(kick / w, f->full[j]);
        }
        e->amplitude[j] = q, e->modal_speed[j] = v;
        double zeta = 0.5 * o->damping[j * m + j] / w;
        e->response_bound[j] =
            fmin(undamped(w, zeta, end), (1 + 2 / (FW_PI * fmax(zeta, 1e-12))) / (w * w));
    }
    for (size_t j = 0; j < m; j++) { /* to first order in their damping */
        double more = 0;
        for (size_t l = 0; l < m; l++)
            if (l != j) more += fabs(o->damping[j * m + l]) * e->modal_speed[l];
        e->amplitude[j] += more * e->response_bound[j];
        e->modal_speed[j] += more * e->response_bound[j] * o->omega[j];
    }
}

static void spread(int modes, int count, const double *shape, const double *size, double *out) {
    for (int i = 0; i < count; i++)
        for (int j = 0; j < modes; j++)
            out[i] += fabs(shape[(size_t)j * (size_t)count + (size_t)i]) * size[j];
}

/* strains move modes by squares of their turns; dampers resist: a modal load c law', whose
   integral is c
 * times the variation of the law */
static void add_drag(const fw_effects_modal *o, fw_effects_envelope *e) {
    double second = fw_effects_modal_second(o);
    for (int j = 0; j < e->modes && second > 0; j++) {
        double turn = 0;
        for (int i = 0; i < e->npin; i++)
            turn = fmax(turn, fabs(e->turn[(size_t)j * (size_t)e->npin + (size_t)i]));
        if (turn > 0) e->amplitude[j] += second / turn;
        if (turn > 0) e->modal_speed[j] += second / turn * e->omega[j];
    }
    if (!o->shift[1]) return;
    double variation =
        fw_quantity_law_measure(o->loads->stretch.law, o->scene->duration_s).variation;
    for (int j = 0; j < e->modes; j++) {
        double drag = fabs(o->shift_drag[1][j]);
        if (drag > 0) e->amplitude[j] += drag * variation / o->omega[j];
        if (drag > 0) e->modal_speed[j] += drag * variation;
    }
}

/* how far, and how fast, free strains move it by themselves */
static void add_shifts(const fw_effects_modal *o, fw_effects_envelope *e) {
    for (int i = 0; i < 2; i++) {
        if (!o->shift[i]) continue;
        const fw_quantity_law *law = i ? o->loads->stretch.law : NULL;
        fw_quantity_law_size size = fw_quantity_law_measure(law, o->scene->duration_s);
        for (int k = 0; k < e->n; k++) {
            e->reach[k] += size.most * fabs(o->shift[i][k]);
            e->speed[k] += size.slope * fabs(o->shift[i][k]);
        }
        for (int k = 0; k < e->npin; k++) {
            e->angle[k] += size.most * fabs(o->shift_turn[i][k]);
            e->rate[k] += size.slope * fabs(o->shift_turn[i][k]);
            if (i == 1) e->force[k] = (double)INFINITY; /* the ground pulls with its own inertia */
        }
        for (int k = 0; k < o->mechanism->njoint && i == 1; k++)
            e->across[k] = (double)INFINITY;
    }
}

/* ---- joint forces ---- */

static void add_joints(const fw_effects_modal *o, const double *lambda, double factor,
                       fw_effects_envelope *e) {
    const fw_effects_linear *s = &o->linear;
    double unit = factor * s->stiffness_N_per_m * s->length_m;
    for (int i = 0; i < o->mechanism->npin; i++)
        if (s->pin_row[i] != FW_NONE)
            e->force[i] += unit * hypot(lambda[s->pin_row[i]], lambda[s->pin_row[i] + 1]);
    for (int i = 0; i < o->mechanism->njoint; i++)
        e->across[i] += unit * fabs(lambda[s->joint_row[i]]);
}

/* lambda(t) = static multipliers of F(t) less those of M shape q'' of every mode, with
   |q''| <= |f(0+)| + var f + w |v|, or sup|f| + w^2 |q| */
static fw_status joint_forces(fw_arena *arena, const fw_effects_modal *o,
                              const fw_effects_modal_loads *p, fw_effects_envelope *e) {
    size_t n = (size_t)o->n;
    double *work, *lambda, *modal_load;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(work = fw_arena_array(arena, double, 2 * n));
    FW_NEED(modal_load = fw_arena_array(arena, double, n));
    FW_NEED(lambda = fw_arena_array(arena, double, (size_t)o->linear.rows));
    for (int i = 0; i < p->count; i++) {
        const fw_effects_modal_load *f = &p->item[i];
        double most = 1;
        for (size_t k = 0; k < n; k++)
            modal_load[k] = f->force[k];
        if (f->element) { /* its direction as where it pushes most */
            double t =
                fw_effects_loads_element_busiest(o->mechanism, f->element, o->scene->duration_s);
            fw_effects_loads_element_force(o->mechanism, f->element, t, fmax(t, DBL_MIN),
                                           modal_load);
        } else if (f->law)
            most = fw_quantity_law_largest(f->law, o->scene->duration_s);
        fw_effects_modal_multipliers(o, modal_load, work, lambda);
        add_joints(o, lambda, most, e);
    }
    for (int j = 0; j < o->modes; j++) {
        double w = o->omega[j], soft = w * w * e->amplitude[j], kick = w * fabs(o->velocity[j]);
        for (int i = 0; i < p->count; i++) {
            soft += p->item[i].sup[j];
            kick += p->item[i].first[j] + p->item[i].sway[j];
        }
        for (size_t k = 0; k < n; k++) {
            const fw_mechanism_mass *b = &o->mechanism->body[k / 3];
            modal_load[k] =
                (k % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * o->shape[(size_t)j * n + k];
        }
        fw_effects_modal_multipliers(o, modal_load, work, lambda);
        add_joints(o, lambda, fmin(soft, kick), e);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* pins that hinges stand for: what the modes open them by, and the force of that */
static void released(const fw_effects_modal *o, fw_effects_envelope *e) {
    size_t pins = (size_t)e->npin;
    for (size_t j = 0; j < (size_t)o->modes; j++)
        for (size_t i = 0; i < pins; i++) {
            const double *open = o->open + 2 * (j * pins + i), *pull = o->pull + 2 * (j * pins + i);
            e->give[i] += hypot(open[0], open[1]) * e->amplitude[j];
            e->force[i] += hypot(pull[0], pull[1]) * e->amplitude[j];
        }
}

/* ---- how far linear theory can be trusted ---- */

/* largest turn of a body or a pin, and of the line of a spring, rad */
static double largest_turn(const fw_effects_modal *o, const fw_effects_envelope *e) {
    const fw_mechanism *m = o->mechanism;
    double most = 0;
    for (int i = 0; i < m->npin; i++)
        most = fmax(most, e->angle[i]);
    for (int b = 0; b < m->nbody; b++)
        most = fmax(most, e->reach[3 * b + 2]);
    for (int i = 0; i < o->loads->nspring; i++) {
        const fw_device_spring *s = &o->loads->spring[i];
        fw_geometry_vec2 a = fw_mechanism_local_place(m, s->body_a, s->ax_m, s->ay_m);
        fw_geometry_vec2 b = fw_mechanism_local_place(m, s->body_b, s->bx_m, s->by_m);
        double moved = 0, length = hypot(b.x - a.x, b.y - a.y);
        if (s->body_a != FW_GROUND)
            moved += hypot(e->reach[3 * s->body_a], e->reach[3 * s->body_a + 1]) +
                     e->reach[3 * s->body_a + 2] * hypot(s->ax_m, s->ay_m);
        if (s->body_b != FW_GROUND)
            moved += hypot(e->reach[3 * s->body_b], e->reach[3 * s->body_b + 1]) +
                     e->reach[3 * s->body_b + 2] * hypot(s->bx_m, s->by_m);
        if (length > 0) most = fmax(most, moved / length);
    }
    return most;
}

/* hinges that stand for pins: forces through the drift take F drift''/K of the stiffness */
static double hinges_nonlinearity(const fw_effects_modal *o, const fw_effects_envelope *e) {
    const fw_mechanism *m = o->mechanism;
    double most = 0;
    for (int h = 0; h < m->nhinge && o->loads->nreleased > 0; h++) {
        int i = m->hinge[h].pin;
        fw_flexure_hinge_at at;
        if (!o->loads->released[i]) continue;
        fw_flexure_hinge_law_at(&m->hinge[h].law, 0, &at);
        most = fmax(most, e->force[i] * fabs(at.drift_m.curve) / m->pin[i].stiffness_Nm_per_rad);
    }
    return most;
}

/* turns, and what the loads at their largest with the multipliers that hold them do to the
   stiffness (twice, because the motion overshoots; a frequency follows by half of it) */
static fw_status nonlinearity_of(fw_arena *arena, const fw_effects_modal *o,
                                 const fw_effects_envelope *e, double *nonlinearity) {
    double *force, part, bend;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(force = fw_arena_array(arena, double, (size_t)o->n));
    fw_effects_loads_largest_force(o->mechanism, o->loads, o->scene->duration_s, force);
    FW_TRY(fw_effects_modal_softening(arena, o, force, false, &part));
    fw_arena_rewind(arena, mark);
    FW_TRY(fw_effects_modal_bend(arena, o, e->amplitude, &bend));
    *nonlinearity = largest_turn(o, e) + part + bend + hinges_nonlinearity(o, e);
    return FW_OK;
}

/* largest of value[from], value[from + step], ... */
static double largest(const double *value, int from, int step, int count) {
    double most = 0;
    for (int i = from; i < count; i += step)
        most = fmax(most, value[i]);
    return most;
}

/* Bounds grow by the margin, and by a share of the largest of their kind: what does not move in
   linear theory moves with the square of what does */
static void widen(fw_effects_envelope *e, int joints, double nonlinearity) {
    double *of[] = {e->reach, e->speed, e->angle, e->rate, e->force, e->give};
    e->margin = 1 + widening * nonlinearity;
    for (int k = 0; k < 2; k++) {
        double x = fmax(largest(of[k], 0, 3, e->n), largest(of[k], 1, 3, e->n));
        double turn = largest(of[k], 2, 3, e->n);
        for (int i = 0; i < e->n; i++)
            of[k][i] = of[k][i] * e->margin + nonlinearity * (i % 3 == 2 ? turn : x);
    }
    double pressed = largest(e->across, 0, 1, joints);
    for (int i = 0; i < e->npin; i++)
        if (isfinite(e->force[i])) pressed = fmax(pressed, e->force[i]);
    for (int i = 0; i < joints; i++)
        e->across[i] = e->across[i] * e->margin + nonlinearity * pressed;
    for (int k = 2; k < 6; k++) {
        double most = 0;
        for (int i = 0; i < e->npin; i++)
            if (isfinite(of[k][i])) most = fmax(most, of[k][i]);
        for (int i = 0; i < e->npin; i++)
            of[k][i] = of[k][i] * e->margin + nonlinearity * most;
    }
}

static fw_status fail(fw_effects_envelope *e, const char *why) {
    e->valid = false;
    e->why_not = why;
    return FW_OK;
}

fw_status fw_effects_envelope_of(fw_arena *arena, const fw_mechanism *m,
                                 const fw_device_scene *scene, const fw_effects_loads *loads,
                                 fw_effects_envelope *e) {
    fw_effects_modal *o;
    fw_effects_modal_loads modal_loads;
    double nonlinearity;
    *e = (fw_effects_envelope){.duration_s = scene->duration_s};
    if (!(scene->duration_s > 0) || !isfinite(scene->duration_s))
        return fail(e, "the scene has no duration");
    FW_NEED(o = fw_arena_one(arena, fw_effects_modal));
    e->modal = o;
    FW_TRY(fw_effects_modal_find(arena, m, scene, loads, o));
    if (o->why_not) return fail(e, o->why_not);
    FW_TRY(fw_effects_modal_loads_find(arena, o, &modal_loads));
    if (modal_loads.why_not) return fail(e, modal_loads.why_not);
    FW_TRY(arrays(arena, o, e));
    size_of_modes(o, &modal_loads, e);
    add_drag(o, e);
    spread(e->modes, e->n, e->shape, e->amplitude, e->reach);
    spread(e->modes, e->n, e->shape, e->modal_speed, e->speed);
    spread(e->modes, e->npin, e->turn, e->amplitude, e->angle);
    spread(e->modes, e->npin, e->turn, e->modal_speed, e->rate);
    FW_TRY(joint_forces(arena, o, &modal_loads, e));
    released(o, e);
    add_shifts(o, e);
    FW_TRY(nonlinearity_of(arena, o, e, &nonlinearity));
    if (!(nonlinearity <= nonlinearity_most))
        return fail(e, "the mechanism turns too far, or its loads change its stiffness too much, "
                       "for linear theory");
    FW_TRY(fw_effects_modal_floor(arena, o, &modal_loads, nonlinearity, &e->floor));
    widen(e, m->njoint, nonlinearity);
    for (int i = 0; i < e->npin; i++)
        e->most = fmax(e->most, fabs(fw_effects_pin_deflection(m, i)) + e->angle[i]);
    if (!(e->floor > 0)) return fail(e, "no hinge is deflected for sure");
    e->valid = true;
    return FW_OK;
}

/* ---- answers ---- */

/* A mode under a force of size f and variation var f: (1 + var) f / w^2 by parts, or f times the
   integral of the size of its response to an impulse: T / w, and with damping zeta at most
   coth(pi zeta / 2 sqrt(1 - zeta^2)) / w^2 <= (1 + 2 / (pi zeta)) / w^2. */
double fw_effects_envelope_mode_answer(const fw_effect_case *c, const double *mode,
                                       double variation) {
    const fw_effects_envelope *e = c->envelope;
    if (!e->valid) return (double)INFINITY;
    double most = 0;
    for (int i = 0; i < e->npin; i++) {
        double sum = 0;
        for (int j = 0; j < e->modes; j++) {
            double turn = fabs(e->turn[(size_t)j * (size_t)e->npin + (size_t)i]);
            double w = e->omega[j], f = fabs(mode[j]);
            if (f != 0) sum += turn * f * fmin((1 + variation) / (w * w), e->response_bound[j]);
        }
        most = fmax(most, sum);
        if (isnan(sum)) return (double)INFINITY;
    }
    return most / e->floor * e->margin;
}

/* a strip of length L that is displaced by d across itself bends as much at its roots as one that is
   turned by 6 d/L (both roots clamped: 6 EI d/L^2 against EI theta/L) */
double fw_effects_envelope_displaced(const fw_effect_case *c, const double *force,
                                     double variation) {
    const fw_mechanism *m = c->mechanism;
    const fw_effects_envelope *e = c->envelope;
    double all = 0, softest = 0;
    if (!e->valid) return (double)INFINITY;
    for (int b = 0; b < m->nbody; b++)
        all += hypot(force[3 * b], force[3 * b + 1]);
    for (int h = 0; h < m->nhinge; h++) {
        const fw_flexure_result *r = &m->hinge[h].closed_form;
        double k = m->hinge[h].scale * fmin(r->kx_N_per_m, r->ky_N_per_m);
        softest = fmax(softest, 6 / (k * m->hinge[h].input.length_m));
    }
    return softest > 0 ? (1 + variation) * all * softest / e->floor : 0;
}

double fw_effects_envelope_answer(const fw_effect_case *c, const double *force, double variation) {
    const fw_effects_envelope *e = c->envelope;
    if (!e->valid) return (double)INFINITY;
    double most = 0;
    for (int i = 0; i < e->npin; i++) {
        double sum = 0;
        for (int j = 0; j < e->modes; j++) {
            const double *shape = e->shape + (size_t)j * (size_t)e->n;
            double turn = fabs(e->turn[(size_t)j * (size_t)e->npin + (size_t)i]);
            double f = 0, w = e->omega[j];
            for (int k = 0; k < e->n; k++)
                f += force[k] != 0 ? fabs(shape[k] * force[k]) : 0;
            if (f != 0) sum += turn * f * fmin((1 + variation) / (w * w), e->response_bound[j]);
        }
        most = fmax(most, sum);
        if (isnan(sum)) return (double)INFINITY;
    }
    return most / e->floor * e->margin;
}

/* With dK_jl = part w_j w_l at most between modes: mode j is pushed by part w_j w_l q_l. Its own
   motion shifts its frequency: part w T of the amplitude, at most twice the amplitude (and the
   static change). Others push it off resonance, 2/|w_j^2 - w_l^2| + 2/w_j^2 of the force, or T/w_j
   of it. 1/(1 - part): what the change does to itself. */
double fw_effects_envelope_stiffness(const fw_effect_case *c, double part) {
    const fw_effects_envelope *e = c->envelope;
    if (part == 0) return 0;
    if (!e->valid || !(part < 0.5)) return (double)INFINITY;
    double most = 0, more = part / (1 - part);
    for (int i = 0; i < e->npin; i++) {
        double sum = 0;
        for (int j = 0; j < e->modes; j++) {
            double turn = fabs(e->turn[(size_t)j * (size_t)e->npin + (size_t)i]);
            double w = e->omega[j],
                   change =
                       e->amplitude[j] *
                       fmin(2 + more, more * w * fmin(e->duration_s, w * e->response_bound[j]));
            for (int l = 0; l < e->modes; l++) {
                if (l == j) continue;
                double u = e->omega[l], apart = fabs(w * w - u * u);
                change += more * w * u * e->amplitude[l] *
                          fmin(e->response_bound[j], 2 / apart + 2 / (w * w));
            }
            sum += turn * change;
        }
        most = fmax(most, sum);
    }
    return most / e->floor * e->margin;
}

fw_status fw_effects_envelope_softening(const fw_effect_case *c, const double *force,
                                        double *part) {
    *part = (double)INFINITY;
    if (!c->envelope->valid) return FW_OK;
    FW_TRY(fw_effects_modal_softening(c->arena, c->envelope->modal, force, true, part));
    *part *= 2;
    return FW_OK;
}
