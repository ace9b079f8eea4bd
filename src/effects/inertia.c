/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inertia against a motion that is a sequence of equilibria. Theory:
   docs/theory/effects/inertia.md. */
#include "effects/effect.h"
#include "base/sort.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "quantity/law_kind.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool called_for(const fw_effect_case *c) {
    return c->mechanism->nbody > 0;
}

/* ---- how unsteady a law is ---- */

typedef struct unrest { /* over the scene */
    double jumps;       /* sum of |jumps| of the value behind t = 0 */
    double slope;       /* 1/s: |f'(0+)| + total variation of f' behind it, its jumps included */
    double wave; /* rad/s of a sine; 0: none. It begins, and ends, at `ends` times in the scene */
    int ends;
} unrest;

/* total variation of f' inside (a, b), where f is smooth, by sampling every `step`: the midpoint
   rule of |f''|. A sign change of f'' inside a cell hides less than its share of one cell. */
static double sampled_variation(const fw_quantity_law *law, double a, double b, double piece,
                                double step) {
    double count = fmin(fmax(ceil((b - a) / step), 64), 1e6), sum = 0, value[3];
    for (double i = 0; i < count; i++) {
        fw_quantity_law_value(law, a + (b - a) * (i + 0.5) / count, piece, value);
        sum += fabs(value[2]);
    }
    return 1.01 * sum * (b - a) / count;
}

/* shortest step that sees all of a law between a and b */
static double finest(const fw_quantity_law_strides *strides, double a, double b) {
    double most = (double)INFINITY;
    for (int i = 0; i < strides->n; i++) {
        double end = i + 1 < strides->n ? strides->t_s[i + 1] : (double)INFINITY;
        if (strides->t_s[i] < b && end > a) most = fmin(most, strides->most_s[i]);
    }
    return most;
}

/* inside the piece (a, b), for every row of strides with the step that it asks for */
static double looked_variation(const fw_quantity_law *law, const fw_quantity_law_strides *strides,
                               double a, double b, double end_s) {
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

static double smooth_variation(const fw_quantity_law *law, const fw_quantity_law_strides *strides,
                               double a, double b, double end_s) {
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    if (fw_quantity_law_is_straight(law)) return 0;
    if (law->kind->slope_variation) return law->kind->slope_variation(law, a, b);
    if (wave.fastest_Hz > 0)
        return sampled_variation(law, a, b, 0.5 * (a + b), 1 / (64 * wave.fastest_Hz));
    return looked_variation(law, strides, a, b, end_s);
}

/* Jumps and the variation of the slope of a law over (0, end_s). Exact for steps, ramps, tables,
   sines and half sines; any other law by midpoint sums with a hundredth on top. */
static fw_status look_at_law(fw_arena *arena, const fw_quantity_law *law, double end_s,
                             unrest *out) {
    *out = (unrest){0};
    if (fw_quantity_law_is_constant(law)) return FW_OK;
    fw_quantity_law_strides strides = {0};
    int count = fw_quantity_law_breaks_of(law, end_s, NULL, 0);
    double *at, value[3], next[3];
    FW_NEED(at = fw_arena_array(arena, double, (size_t)count + 1));
    count = fw_quantity_law_breaks_of(law, end_s, at, count);
    fw_sort_doubles(at, (size_t)count);
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    if (!(wave.fastest_Hz > 0))
        FW_TRY(fw_quantity_law_look(arena, law, false, end_s, at, count, &strides));
    at[count] = end_s;
    double from = 0;
    for (int i = 0; i <= count; i++) {
        double to = at[i], piece = 0.5 * (from + to);
        if (!(to > from)) continue;
        fw_quantity_law_value(law, from, piece, next); /* the limit from the right */
        out->jumps += from > 0 ? fabs(next[0] - value[0]) : 0;
        out->slope += from > 0 ? fabs(next[1] - value[1]) : fabs(next[1]);
        out->slope += smooth_variation(law, &strides, from, to, end_s);
        fw_quantity_law_value(law, to, piece, value);
        from = to;
    }
    if (!isfinite(out->jumps) || !isfinite(out->slope))
        *out = (unrest){.jumps = (double)INFINITY, .slope = (double)INFINITY};
    out->wave = wave.rad_per_s;
    out->ends = 1 + (wave.to_s < end_s);
    return FW_OK;
}

/* What the slope of a law moves a mode off its equilibrium, over |F|/w^2; lag: of all modes, s. Of
   a sine W the motion that it settles to is off by a = x/(1 - x), x = (W/w)^2 + W lag, at most, and
   what rings from each of its ends by a and b = W/(w (1 - x)) together: that does not grow with its
   number of waves. */
static double off_by_slope(const unrest *u, double lag, double w) {
    double off = (lag + hypot(lag, 1 / w)) * u->slope;
    double x = u->wave / w * (u->wave / w) + u->wave * lag;
    if (!(u->wave > 0) || !(x < 1)) return off;
    double a = x / (1 - x), b = u->wave / (w * (1 - x));
    return fmin(off, a + u->ends * hypot(a, b));
}

/* ---- sums over modes ---- */

typedef struct modal {
    const fw_effects_envelope *e;
    int pins, modes;
    double lowest;      /* rad/s */
    double *modal_load; /* (modes) work: modal force of one group of loads */
    double *rotation;   /* (npin) bound, rad */
    double *flexible;   /* (npin) sqrt(sum turn^2 / omega^2) */
    double lag;         /* s: |W^-1 D W^-1| from above, D: modal damping; 0: none */
} modal;

static fw_status start(fw_arena *arena, const fw_effects_envelope *e, int pins, modal *m) {
    *m = (modal){.e = e, .pins = pins, .modes = e->modes, .lowest = (double)INFINITY};
    FW_NEED(m->modal_load = fw_arena_array(arena, double, (size_t)e->modes));
    FW_NEED(m->rotation = fw_arena_array(arena, double, (size_t)pins));
    FW_NEED(m->flexible = fw_arena_array(arena, double, (size_t)pins));
    double sum = 0;
    for (int j = 0; j < e->modes; j++) {
        m->lowest = fmin(m->lowest, e->omega[j]);
        for (int k = 0; k < e->modes; k++)
            sum += pow(e->modal->damping[j * e->modes + k] / (e->omega[j] * e->omega[k]), 2);
    }
    m->lag = sqrt(sum);
    for (int p = 0; p < pins; p++) {
        sum = 0;
        for (int j = 0; j < e->modes; j++)
            sum += pow(e->turn[j * pins + p] / e->omega[j], 2);
        m->flexible[p] = sqrt(sum);
    }
    return FW_OK;
}

/* What one group of loads with modal forces `modal_load` that share a law can move every pin off
   its equilibrium. Undamped, mode by mode: (|F|/omega^2) (jumps + slope/omega). Damped, in the
   energy norm of all modes: |turn/omega| |F/omega| (jumps + (kappa + sqrt(kappa^2 + 1/omega_1^2))
   slope). `speed`: modal_load is a velocity, which moves by v/omega. */
static void spread(modal *m, const double *modal_load, const unrest *u, bool speed) {
    const double *omega = m->e->omega;
    double size = 0;
    for (int j = 0; j < m->modes; j++)
        size += pow(modal_load[j] / (speed ? 1 : omega[j]), 2);
    double whole = sqrt(size) * (u->jumps + off_by_slope(u, m->lag, m->lowest));
    for (int p = 0; p < m->pins; p++) {
        double sum = 0;
        for (int j = 0; j < m->modes && m->lag == 0; j++) {
            double w = omega[j], f = fabs(modal_load[j]) / (speed ? w : w * w);
            sum += fabs(m->e->turn[j * m->pins + p]) * f * (u->jumps + off_by_slope(u, 0, w));
        }
        m->rotation[p] += m->lag > 0 ? m->flexible[p] * whole : sum;
    }
}

/* loads that share a law go together */
static fw_status spread_laws(fw_arena *arena, const fw_effects_modal_loads *p, double end_s,
                             modal *m) {
    for (int i = 0; i < p->count; i++) {
        const fw_quantity_law *law = p->item[i].law;
        bool done = fw_quantity_law_is_constant(law);
        for (int k = 0; k < i; k++)
            done = done || p->item[k].law == law;
        if (done) continue;
        unrest u;
        memset(m->modal_load, 0, (size_t)m->modes * sizeof(double));
        for (int k = i; k < p->count; k++)
            for (int j = 0; j < m->modes && p->item[k].law == law; j++)
                m->modal_load[j] += p->item[k].mode[j];
        FW_TRY(look_at_law(arena, law, end_s, &u));
        spread(m, m->modal_load, &u, false);
    }
    return FW_OK;
}

/* a ground that stretches drags its dampers along: the row does not know of that */
static void spread_drag(const fw_effects_modal *o, double end_s, modal *m) {
    if (!o->shift[1]) return;
    double variation = fw_quantity_law_measure(o->loads->stretch.law, end_s).variation;
    for (int p = 0; p < m->pins; p++)
        for (int j = 0; j < m->modes; j++)
            if (o->shift_drag[1][j] != 0)
                m->rotation[p] += fabs(m->e->turn[j * m->pins + p] * o->shift_drag[1][j]) *
                                  variation / o->omega[j];
}

/* what acts behind t = 0 is put on at once, constants and laws together: one jump; velocities */
static void spread_start(const fw_effects_modal_loads *p, modal *m) {
    const unrest jump = {.jumps = 1};
    memset(m->modal_load, 0, (size_t)m->modes * sizeof(double));
    for (int i = 0; i < p->count; i++)
        fw_effects_modal_load_at(m->e->modal, p, &p->item[i], 0, DBL_MIN, m->modal_load);
    spread(m, m->modal_load, &jump, false);
    spread(m, m->e->modal->velocity, &jump, true);
}

/* ---- how far it moves at least ---- */

static double largest_deflection(const fw_effect_case *c, const fw_effects_modal_loads *p,
                                 const modal *m, double t_s, double piece_s) {
    double most = 0;
    memset(m->modal_load, 0, (size_t)m->modes * sizeof(double));
    for (int i = 0; i < p->count; i++)
        fw_effects_modal_load_at(m->e->modal, p, &p->item[i], t_s, piece_s, m->modal_load);
    for (int pin = 0; pin < m->pins; pin++) {
        double turn = fw_effects_modal_shifted(m->e->modal, pin, t_s, piece_s);
        for (int j = 0; j < m->modes; j++)
            turn += m->e->turn[j * m->pins + pin] * m->modal_load[j] / pow(m->e->omega[j], 2);
        /* what is not linear could make the turn smaller */
        double less = fabs(turn) * (1 - 1 / m->e->margin);
        most = fmax(most, fabs(fw_effects_pin_deflection(c->mechanism, pin) + turn) - less);
    }
    return most;
}

/* The envelope's floor looks at the first periods of every load; that of slow loads is what the
   equilibria reach at any time, less what the motion may be off by there (off_rad). Times: ends and
   insides of the smooth pieces. Any set of times gives a floor. */
static fw_status find_floor(const fw_effect_case *c, const fw_effects_modal_loads *p,
                            const modal *m, double off_rad, double *floor_rad) {
    enum { LOOKS = 16 };
    double *end, from = 0, most = 0;
    int count;
    FW_TRY(fw_effects_modal_loads_breaks(c->arena, m->e->modal, p, &end, &count));
    for (int i = 0; i < count; i++) {
        for (int k = 0; k <= LOOKS; k++)
            most = fmax(most, largest_deflection(c, p, m, from + (end[i] - from) * k / LOOKS,
                                                 0.5 * (from + end[i])));
        from = end[i];
    }
    *floor_rad = fmax(m->e->floor, most - off_rad);
    return FW_OK;
}

/* ---- what goes by velocities ---- */

/* c w/k of what a force or torque is looked at of: of its damper beside its spring, in the lowest mode */
static double damper_beside(const fw_effect_case *c, const fw_device_probe *p, double w) {
    const fw_mechanism *m = c->mechanism;
    double damping = 0, stiffness = 1;
    switch (p->carrier) {
    case FW_CARRIER_REVOLUTE:
        if (p->row == FW_PROBE_IS_force) return 0; /* of the joint, without its flexure */
        if (fw_effects_material_damped(c, p->index)) return fmax(0, fw_effects_loss(c));
        damping = m->pin[p->index].damping_Nms_per_rad;
        stiffness = m->pin[p->index].stiffness_Nm_per_rad;
        break;
    case FW_CARRIER_SPRING:
        damping = m->device->spring[p->index].damping_Ns_per_m;
        stiffness = m->device->spring[p->index].stiffness_N_per_m;
        break;
    case FW_CARRIER_TENDON:
        for (int i = 0; i < c->scene->ntendon; i++) {
            const fw_device_tendon *t = &c->scene->tendon[i];
            if (isnan(t->draw_m) || !t->id || !fw_text_same(t->id, p->of)) continue;
            damping = t->damping_Ns_per_m, stiffness = t->stiffness_N_per_m;
        }
        break;
    case FW_CARRIER_JOINT:
    case FW_CARRIER_DRIVER: /* no motion with one is bounded */
    case FW_CARRIER_COMB:
    case FW_CARRIER_CONTACT:
        break;
    }
    return damping > 0 ? damping * w / stiffness : 0;
}

/* By how much more than a rotation what is looked at by a probe may change without inertia. Under a
   ramp a mode is F/(w^3 rise) off its equilibrium at most, and in its velocity w times that, which is
   all of the velocity F/(w^2 rise) that equilibria have: what is at rest must be brought up to speed,
   and goes to and fro about it then. So it is of any course: the largest |f'| is no more than |f'(0+)|
   and the total variation of f', which the sum has. However slow a load is, that sum leaves nothing of
   a velocity: infinite. */
static double by_velocity(const fw_effect_case *c, const fw_device_probe *p, double w) {
    switch (p->row) {
    case FW_PROBE_IS_velocity:
    case FW_PROBE_IS_power: /* a force times a rate; of drivers, tendons and comb drives */
        return (double)INFINITY;
    case FW_PROBE_IS_force:
    case FW_PROBE_IS_torque:
        return damper_beside(c, p, w);
    case FW_PROBE_IS_displacement:
    case FW_PROBE_IS_angle:
    case FW_PROBE_IS_distance:
    case FW_PROBE_IS_opening:
    case FW_PROBE_IS_gap:
    case FW_PROBE_IS_capacitance:
    case FW_PROBE_IS_stiffness:
    case FW_PROBE_IS_compliance:
    case FW_PROBE_IS_frequency:
    case FW_PROBE_KINDS:
        break;
    }
    return 0;
}

/* the probe of this scene that goes by velocities most; NULL: none does */
static const fw_device_probe *fastest_probe(const fw_effect_case *c, double *more) {
    const fw_device *d = c->mechanism->device;
    const fw_effects_envelope *e = c->envelope;
    const fw_device_probe *most = NULL;
    *more = 0;
    for (int i = 0; d && i < d->nprobe; i++) {
        const fw_device_probe *p = &d->probe[i];
        if (p->of && !fw_device_probe_in_scene(p, c->scene)) continue;
        double now = by_velocity(c, p, e->valid && e->modes > 0 ? e->omega[0] : 0);
        if (now > *more) *more = now, most = p;
    }
    return most;
}

static fw_status looked_at(const fw_effect_case *c, const char **why) {
    double more;
    const fw_device_probe *p = fastest_probe(c, &more);
    if (!isinf(more)) return FW_OK;
    FW_NEED(*why = fw_arena_printf(
                c->arena,
                "masses resist changes of motion, and probe %s goes by velocities, which "
                "equilibria do not have right however slow the loads are: what they bring up to "
                "speed goes to and fro about it: kept",
                fw_text_name(p->id)));
    return FW_OK;
}

/* ---- what has no bound ---- */

/* NULL: the sums know all that moves the mechanism */
static const char *reason_to_keep(const fw_effect_case *c) {
    const fw_effects_envelope *e = c->envelope;
    if (c->mechanism->ndriver > 0)
        return "drivers move the mechanism, and its joint forces are those of inertia too";
    if (!e->valid || !e->modal) return e->why_not ? e->why_not : "the motion has no linear theory";
    if (e->loose_pull > 0) return "cables may go slack";
    for (int i = 0; i < e->modal->loads->nelement; i++)
        if (e->modal->loads->element[i].laws > 0)
            return "a force depends on the pose and on time at once";
    return NULL;
}

/* Relative change of the largest hinge deflection when the motion is taken as a sequence of
   equilibria:
   in each mode q'' + omega^2 q = F f(t) moves off q = F f / omega^2 by at most
     (|F|/omega^2) (sum of jumps of f) + (|F|/omega^3) (|f'(0+)| + total variation of f')
   by integrating Duhamel's integral by parts twice, loads of one law together, laws added; viscous
   damping makes the free part smaller and adds a lag (see spread). Inputs: the envelope's modes,
   SI. Output dimensionless, against the least that the largest deflection can be; infinite where
   there is no envelope. What the envelope does not take in widens it like all bounds (table.c).
   More where something that is looked at goes by velocities (by_velocity). Valid in the linear theory
   of the envelope, with its margin for what is not linear. Cost modes x (n + npin) per law. Source: Duhamel's integral, e.g. Clough and Penzien, Dynamics of Structures
   1993, ch. 6; the integration by parts is ours. Test: test_inertia.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    double more;
    const char *keep = reason_to_keep(c);
    *value = (double)INFINITY;
    if (keep) {
        FW_NEED(*reason = fw_arena_printf(c->arena,
                                          "masses resist changes of motion, and no bound is "
                                          "known on the error of a quasi-static sequence of "
                                          "equilibria: kept (%s)",
                                          keep));
        return FW_OK;
    }
    fw_mark mark = fw_arena_mark(c->arena);
    fw_effects_modal_loads modal_loads;
    modal m;
    double most = 0;
    FW_TRY(start(c->arena, e, c->mechanism->npin, &m));
    FW_TRY(fw_effects_modal_loads_find(c->arena, e->modal, &modal_loads));
    spread_start(&modal_loads, &m);
    FW_TRY(spread_laws(c->arena, &modal_loads, c->scene->duration_s, &m));
    spread_drag(e->modal, c->scene->duration_s, &m);
    for (int p = 0; p < m.pins; p++)
        most = fmax(most, isnan(m.rotation[p]) ? (double)INFINITY : m.rotation[p]);
    double least;
    most = most * e->margin + fw_effects_modal_second(e->modal);
    FW_TRY(find_floor(c, &modal_loads, &m, most, &least));
    fw_arena_rewind(c->arena, mark);
    fastest_probe(c, &more);
    *value = most / least * (isinf(more) ? 1 : 1 + more); /* infinite: looked_at decides */
    *reason = "masses resist changes of motion: jumps of the loads and changes of their slope, "
              "compared with a quasi-static sequence of equilibria";
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    (void)c;
    loads->quasi_static = false;
    return FW_OK;
}

static fw_status leave_out(const fw_effect_case *c, fw_effects_loads *loads) {
    (void)c;
    loads->quasi_static = true;
    return FW_OK;
}

const fw_effect_row fw_effect_inertia = {
    .id = "inertia",
    .summary = "masses resist changes of motion; without it, the motion is a quasi-static "
               "sequence of equilibria",
    .called_for = called_for,
    .bound = bound,
    .looked_at = looked_at,
    .add = add,
    .adds_blindly = true,
    .leave_out = leave_out,
    .solid = FW_EFFECTS_SOLID_NO_PART};
