/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole device is warmer than it was when it was made: it grows by alpha dT, its substrate by
   another alpha, and its flexures become softer or stiffer. What all lengths have in common changes
   no angle, so it is scaled out: only the ground's points move, by the difference. Another angle of
   a hinge needs another shape, and hinges keep their free angles: the difference bends them.
   Theory: docs/theory/effects/temperature.md. */
#include "effects/effect.h"
#include "base/sort.h"
#include "effects/envelope.h"
#include <math.h>
#include <stdlib.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->ntemperature; i++)
        if (c->scene->temperature[i].change_K != 0) return true;
    return false;
}

/* coefficient of the layer: what the scene states, else the material's in the mean over the change; NaN: not known */
static double own_expansion(const fw_device_temperature *t, const fw_mechanism *m) {
    if (!isnan(t->expansion_per_K)) return t->expansion_per_K;
    if (!m->variant) return (double)NAN;
    const fw_device_material *of = &m->variant->material;
    return fw_device_mean_expansion(&of->expansion, &of->expansion_slope, &of->expansion_curvature,
                                    t->change_K);
}

/* likewise of what the layer is anchored to */
static double substrate_of(const fw_device_temperature *t, const fw_mechanism *m) {
    const fw_mechanism_variant *v = m->variant;
    if (!isnan(t->substrate_expansion_per_K)) return t->substrate_expansion_per_K;
    return v ? fw_device_mean_expansion(&v->substrate_expansion, &v->substrate_slope,
                                        &v->substrate_curvature, t->change_K)
             : (double)NAN;
}

/* relative change of Young's modulus; NaN: not known */
static double modulus_change_of(const fw_device_temperature *t, const fw_mechanism *m) {
    if (!isnan(t->modulus_change_per_K)) return t->modulus_change_per_K;
    const fw_mechanism_variant *v = m->variant;
    return v && !v->material.modulus_change.unknown ? v->material.modulus_change.value
                                                    : (double)NAN;
}

static bool has_hinge(const fw_mechanism *m) {
    for (int i = 0; i < m->npin; i++)
        if (m->pin[i].hinge != FW_NONE && m->pin[i].stiffness_Nm_per_rad > 0) return true;
    return false;
}

/* of the ground against the device where the law is 1: (1 + alpha_s dT)/(1 + alpha dT) - 1, about
   -(alpha - alpha_s) dT */
static double ground_strain(const fw_mechanism *m, const fw_device_temperature *t) {
    double own = own_expansion(t, m) * t->change_K;
    double substrate = substrate_of(t, m) * t->change_K;
    return (substrate - own) / (1 + own);
}

double fw_effects_layer_expands(const fw_mechanism *m, const fw_device_temperature *t) {
    return own_expansion(t, m) * t->change_K;
}

/* ---- what is not of the layer ----
   A thing that is put in from outside has its length l in metres, whatever the layer's own lengths do. The model counts in
   lengths of the layer, S = (1 + grown)(1 + varying law) metres each, so that there it has
     l (1 + own + varying_own law)/S
   with the growth of the thing itself by its own expansion. In, out: dimensionless, 1/s. Exact. Constant strains of the layer
   add up, as in fw_effects_growth_at. Theory: docs/theory/effects/temperature.md. Test: test_contact.c, test_heated.py */

fw_effects_foreign fw_effects_foreign_of(const fw_effect_case *c, double expansion_per_K) {
    fw_effects_foreign f = {0};
    const double stress =
        fw_effects_act(c, "residual-stress") ? fw_effects_stress_strain(c->mechanism, c->scene) : 0;
    f.grown = -stress / (1 + stress);
    for (int i = 0; i < c->scene->ntemperature && fw_effects_act(c, "temperature"); i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        const double layer = fw_effects_layer_expands(c->mechanism, t),
                     own = expansion_per_K * t->change_K;
        if (t->change_K == 0 || isnan(layer)) continue; /* not known: the scene is refused */
        if (fw_quantity_law_is_constant(t->law))
            f.grown += layer, f.own += own;
        else
            f.varying = layer, f.varying_own = own, f.law = t->law;
    }
    return f;
}

double fw_effects_foreign_at(const fw_effects_foreign *f, double t_s, double piece_s,
                             double *rate) {
    double law[3] = {0};
    if (f->law) fw_quantity_law_value(f->law, t_s, piece_s, law);
    const double own = 1 + f->own + f->varying_own * law[0], varied = 1 + f->varying * law[0],
                 layer = (1 + f->grown) * varied;
    if (rate) *rate = law[1] * (f->varying_own - own * f->varying / varied) / layer;
    return own / layer;
}

double fw_effects_foreign_most(const fw_effects_foreign *f, double end_s) {
    const double law = f->law ? fw_quantity_law_largest(f->law, end_s) : 0;
    return fabs(f->own) + fabs(f->grown) + (fabs(f->varying) + fabs(f->varying_own)) * law;
}

/* relative change of hinge stiffness per unit of the law; 0 where no hinge asks for it */
static double softening(const fw_mechanism *m, const fw_device_temperature *t) {
    return has_hinge(m) ? modulus_change_of(t, m) * t->change_K : 0;
}

void fw_effects_heat_strains(const fw_mechanism *m, const fw_device_scene *s, double strain[2]) {
    double low = 0, high = 0;
    enum { SAMPLES = 256 };
    for (int i = 0; i < s->ntemperature; i++) {
        const fw_device_temperature *t = &s->temperature[i];
        const double one = t->change_K != 0 ? ground_strain(m, t) : 0;
        double least = 0, most = 0, value[3];
        if (!(fabs(one) > 0)) continue; /* none, or not known: the scene is refused */
        if (fw_quantity_law_is_constant(t->law)) {
            low += fmin(one, 0), high += fmax(one, 0);
            continue;
        }
        for (int k = 1; k <= SAMPLES; k++) { /* of which sign it is */
            fw_quantity_law_value(t->law, s->duration_s * k / SAMPLES, 0, value);
            least = fmin(least, value[0]), most = fmax(most, value[0]);
        }
        const double largest = fw_quantity_law_largest(t->law, s->duration_s);
        if (least < 0) least = -largest;
        if (most > 0) most = largest;
        low += fmin(one * least, one * most), high += fmax(one * least, one * most);
    }
    strain[0] = low, strain[1] = high;
}

double fw_effects_softened(const fw_mechanism *m, const fw_device_scene *s) {
    double most = 0;
    for (int i = 0; i < s->ntemperature; i++) {
        const double one = softening(m, &s->temperature[i]);
        if (s->temperature[i].change_K != 0 && !isnan(one))
            most += fabs(one) * fw_quantity_law_largest(s->temperature[i].law, s->duration_s);
    }
    return most;
}

/* ---- what cannot be ---- */

static fw_status unknown(const fw_device_temperature *t, fw_diags *diags, const char *what,
                         const char *attribute) {
    return fw_diag_error(diags, 253, t->place,
                         "the %s that this temperature needs is not known for the material; state "
                         "it as %s",
                         what, attribute);
}

/* a time where the law jumps within the scene; NaN: it does not */
static fw_status jump(fw_arena *arena, const fw_quantity_law *law, double end_s, double *at_s) {
    *at_s = (double)NAN;
    int n = fw_quantity_law_breaks_of(law, end_s, NULL, 0);
    double *at, before[3], behind[3];
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(at = fw_arena_array(arena, double, (size_t)n + 2));
    fw_quantity_law_breaks_of(law, end_s, at + 1, n);
    fw_sort_doubles(at + 1, (size_t)n);
    at[n + 1] = end_s;
    for (int i = 1; i <= n && isnan(*at_s); i++) {
        fw_quantity_law_value(law, at[i], 0.5 * (at[i - 1] + at[i]), before);
        fw_quantity_law_value(law, at[i], 0.5 * (at[i] + at[i + 1]), behind);
        if (fabs(behind[0] - before[0]) > 1e-9 * fmax(1, fabs(behind[0]))) *at_s = at[i];
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

static fw_status check_law(const fw_effect_case *c, const fw_device_temperature *t, int *laws,
                           fw_diags *diags) {
    double at;
    char time[32];
    if (fw_quantity_law_is_constant(t->law)) return FW_OK;
    if (++*laws > 1)
        return fw_diag_error(diags, 252, t->place,
                             "a scene can have one temperature with a law; put the changes into "
                             "one law");
    FW_TRY(jump(c->arena, t->law, c->scene->duration_s, &at));
    if (isnan(at)) return FW_OK;
    return fw_diag_error(diags, 252, t->place,
                         "the temperature jumps at %s s, but the joints on the ground move with "
                         "it and cannot jump; use law=\"ramp\" with a rise, or another law "
                         "without jumps",
                         fw_number_text(time, sizeof time, at, 6));
}

/* A coefficient of which the pack does not say how it goes with temperature is that near 300 K. What is left where two materials
   are nearly alike may then be another one by far. */
static void tell_far(const fw_effect_case *c, const fw_device_temperature *t, fw_diags *diags) {
    static const double near_K = 50;
    const fw_mechanism_variant *v = c->mechanism->variant;
    if (!v || fabs(t->change_K) <= near_K || ground_strain(c->mechanism, t) == 0) return;
    const bool own = isnan(t->expansion_per_K) && v->material.expansion_slope.unknown;
    const bool other = isnan(t->substrate_expansion_per_K) && v->substrate_slope.unknown;
    if (!(own || other) || fw_diag_said(diags, 748, t->place)) return;
    fw_diag_warning(diags, 748, t->place,
                    "over a change of more than 50 K the thermal expansion of %s is not what it is "
                    "near 300 K, and the pack does not say how it goes with temperature; state its "
                    "mean over this change as %s",
                    own && other ? "the layer and its substrate"
                    : own        ? "the layer"
                                 : "the substrate",
                    own && other ? "expansion and substrate-expansion"
                    : own        ? "expansion"
                                 : "substrate-expansion");
}

static fw_status check(const fw_effect_case *c, fw_diags *diags) {
    double least = 1;
    int laws = 0;
    for (int i = 0; i < c->scene->ntemperature; i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        if (t->change_K == 0) continue;
        double soft = softening(c->mechanism, t);
        if (isnan(ground_strain(c->mechanism, t)))
            return unknown(t, diags, "thermal expansion", "expansion and substrate-expansion");
        if (isnan(soft))
            return unknown(t, diags, "change of Young's modulus",
                           "modulus-change (0 where it does not matter)");
        tell_far(c, t, diags);
        FW_TRY(check_law(c, t, &laws, diags));
        least -= fabs(soft) * fw_quantity_law_largest(t->law, c->scene->duration_s);
        if (!(least > 0))
            return fw_diag_error(diags, 252, t->place,
                                 "at this temperature the linear modulus-change would reduce "
                                 "the stiffness of the flexures to 0 or below; it is valid for "
                                 "small changes only: lower the change of temperature or "
                                 "modulus-change");
    }
    return FW_OK;
}

/* ---- bound ---- */

typedef struct sizes {     /* of all temperatures of the scene */
    double soft, changing; /* parts of the stiffness: for good, with a law */
    double strain, common; /* largest |strain| of the ground, and of the device */
} sizes;

static sizes sizes_of(const fw_effect_case *c) {
    sizes s = {0};
    for (int i = 0; i < c->scene->ntemperature; i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        if (t->change_K == 0) continue;
        double largest = fw_quantity_law_largest(t->law, c->scene->duration_s);
        double own = own_expansion(t, c->mechanism) * t->change_K;
        double part = fabs(softening(c->mechanism, t)) * largest;
        *(fw_quantity_law_is_constant(t->law) ? &s.soft : &s.changing) += part;
        s.strain += fabs(ground_strain(c->mechanism, t)) * largest;
        if (!isnan(own)) s.common += fabs(own) * largest;
    }
    return s;
}

/* of the mismatch: constant ones together, one with a law */
static fw_status strain_bound(const fw_effect_case *c, double *value) {
    const int n = c->mechanism->nbody;
    double *strain, one = 0;
    *value = 0;
    FW_NEED(strain = fw_arena_array(c->arena, double, (size_t)n + 1));
    for (int i = 0; i < c->scene->ntemperature; i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        if (t->change_K != 0 && fw_quantity_law_is_constant(t->law))
            strain[n] += ground_strain(c->mechanism, t);
    }
    if (strain[n] != 0) FW_TRY(fw_effects_envelope_strain(c, strain, NULL, &one));
    *value += one;
    for (int i = 0; i < c->scene->ntemperature; i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        strain[n] = t->change_K != 0 ? ground_strain(c->mechanism, t) : 0;
        if (strain[n] == 0 || fw_quantity_law_is_constant(t->law)) continue;
        FW_TRY(fw_effects_envelope_strain(c, strain, t->law, &one));
        *value += one;
    }
    return FW_OK;
}

/* Mismatch: envelope_strain.c. Modulus: the envelope's answer to a relative change of the
   stiffness, |beta dT| times the largest |law|; the envelope has the changed stiffness, so that the
   part is of that. What was scaled out changes angles by about three times the common expansion
   (docs). Test: test_temperature.c, test_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const sizes s = sizes_of(c);
    char grown[32], differs[32];
    fw_number_text(grown, sizeof grown, s.common, 2);
    fw_number_text(differs, sizeof differs, s.strain, 2);
    *value = (double)INFINITY;
    if (c->envelope && c->envelope->valid && isfinite(s.soft + s.changing + s.strain)) {
        double left = 1 - s.soft - s.changing;
        FW_TRY(strain_bound(c, value));
        *value += left > 0 ? fw_effects_envelope_stiffness(c, s.soft / left) +
                                 fw_effects_envelope_varying(c, s.changing / left)
                           : (double)INFINITY;
    }
    if (isfinite(*value) && s.common > 0 && fw_effects_foreign_in(c)) {
        *value = (double)INFINITY;
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "the device grows by %s, which what is placed, springs and drawn cables do "
                    "not: kept (the ground's points move by a strain of %s against the device)",
                    grown, differs));
    } else if (isfinite(*value) && s.strain > 0 && fw_effects_places_count(c)) {
        *value = (double)INFINITY;
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "the ground's points move by a strain of %s against the device, and with them "
                    "every place that is drawn or probed: kept (the common expansion of %s is "
                    "scaled out)",
                    differs, grown));
    } else if (isfinite(*value))
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "the ground's points move by a strain of %s against the device, and flexures "
                    "change: answer of the modes (the common expansion of %s is scaled out)",
                    differs, grown));
    else
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "the ground's points move by a strain of %s against the device and bend its "
                    "hinges, or flexures change: kept (the common expansion of %s is scaled out)",
                    differs, grown));
    return FW_OK;
}

/* ---- modulus with a law: torque -k beta dT law(t) (phi_b - phi_a - free) on b ---- */

typedef struct change {
    double k_Nm_per_rad, free_rad; /* k beta dT */
} change;

static double stiffer(const fw_effects_force_element *e, const fw_effects_port_state *s,
                      double *rate) {
    const change *d = e->data;
    double law[3];
    fw_quantity_law_value(e->law[0], s->t_s, s->piece_s, law);
    *rate = d->k_Nm_per_rad * law[1];
    return d->k_Nm_per_rad * law[0];
}

static double bent(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const change *d = e->data;
    return s->p[5] - s->p[2] - d->free_rad;
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double rate, torque = stiffer(e, s, &rate) * bent(e, s);
    for (int i = 0; i < 6; i++)
        f[i] = 0;
    f[2] = torque, f[5] = -torque;
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    double rate, k = stiffer(e, s, &rate);
    for (int i = 0; i < 36; i++)
        stiffness[i] = damping[i] = 0;
    stiffness[2 * 6 + 2] = stiffness[5 * 6 + 5] = k;
    stiffness[2 * 6 + 5] = stiffness[5 * 6 + 2] = -k;
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    double rate, angle = bent(e, s);
    return 0.5 * stiffer(e, s, &rate) * angle * angle;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    double rate, angle = bent(e, s);
    stiffer(e, s, &rate);
    out[0] = 0;
    out[1] = 0.5 * rate * angle * angle;
}

static const fw_effects_element_class modulus_class = {
    .effect = "temperature", .force = force, .tangent = tangent, .energy = energy, .power = power};

/* ---- what acts ---- */

static fw_status add_changing_modulus(const fw_effect_case *c, fw_effects_loads *loads,
                                      const fw_device_temperature *t,
                                      const fw_effects_torsion *on) {
    change *data = fw_arena_one(c->arena, change);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &modulus_class, 2);
    FW_NEED(data && e);
    data->k_Nm_per_rad = softening(c->mechanism, t) * on->stiffness_Nm_per_rad;
    data->free_rad = on->free_angle_rad;
    e->id = c->mechanism->pin[on->pin].id;
    e->place = t->place;
    e->port[0].body = on->body_a, e->port[1].body = on->body_b;
    e->law[0] = t->law, e->laws = 1;
    e->works = true;
    e->data = data;
    return FW_OK;
}

/* The flexures among the loads: springs of ideal pins, which joint-elasticity has put there, and
   elements that stand for a pin, whose spring is theirs. */
static fw_status add_modulus(const fw_effect_case *c, fw_effects_loads *loads) {
    double part = 0;
    const fw_device_temperature *changing = NULL;
    for (int i = 0; i < c->scene->ntemperature; i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        if (!(fabs(softening(c->mechanism, t)) > 0)) continue;
        if (fw_quantity_law_is_constant(t->law))
            part += softening(c->mechanism, t);
        else
            changing = t;
    }
    for (int i = 0; i < loads->ntorsion; i++) {
        fw_effects_torsion *on = &loads->torsion[i];
        if (c->mechanism->pin[on->pin].hinge == FW_NONE || !(on->stiffness_Nm_per_rad > 0))
            continue;
        if (changing) FW_TRY(add_changing_modulus(c, loads, changing, on));
        on->stiffness_Nm_per_rad *= 1 + part;
    }
    return fw_effects_hinges_warm(c->arena, loads, part,
                                  changing ? softening(c->mechanism, changing) : 0,
                                  changing ? changing->law : NULL);
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->scene->ntemperature; i++) {
        const fw_device_temperature *t = &c->scene->temperature[i];
        double strain = t->change_K != 0 ? ground_strain(c->mechanism, t) : 0;
        if (!(fabs(strain) > 0)) continue; /* none, or not known: see check */
        if (fw_quantity_law_is_constant(t->law)) {
            loads->strain[loads->nbody] += strain;
            loads->strained = true;
            loads->grown += fw_effects_layer_expands(c->mechanism, t);
        } else
            loads->stretch =
                (fw_effects_stretch){strain, fw_mechanism_ground_centre(c->mechanism), t->law,
                                     fw_effects_layer_expands(c->mechanism, t)};
    }
    return add_modulus(c, loads);
}

/* which substrate is meant, behind the reason */
static fw_status name_substrate(const fw_effect_case *c, const char **reason) {
    bool left_open = false;
    for (int i = 0; i < c->scene->ntemperature; i++)
        left_open = left_open || isnan(c->scene->temperature[i].substrate_expansion_per_K);
    const char *name = c->mechanism->variant ? c->mechanism->variant->substrate : NULL;
    if (!left_open) name = "as the scene states it";
    FW_NEED(*reason =
                fw_arena_printf(c->arena, "%s; substrate: %s", *reason, name ? name : "not known"));
    return FW_OK;
}

/* what is constant costs nothing while it moves */
static int count(const fw_effect_case *c) {
    int hinges = 0;
    for (int i = 0; i < c->scene->ntemperature; i++)
        for (int k = 0; k < c->mechanism->npin; k++)
            if (!fw_quantity_law_is_constant(c->scene->temperature[i].law) &&
                c->mechanism->pin[k].hinge != FW_NONE)
                hinges++;
    return hinges;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    for (int i = 0; i < s->ntemperature; i++) {
        fw_effects_say(to, "; temperature changed by {n} K", s->temperature[i].change_K);
        fw_effects_say_law(to, s->temperature[i].law);
    }
}

const fw_effect_row fw_effect_temperature = {
    .id = "temperature",
    .summary = "expansion of the device against its substrate, and softer flexures",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .check = check,
    .note = name_substrate,
    .cost = 658,
    .count = count,
    .describe = describe};
