/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stress that the layer has from its deposition. Released, the layer takes the length that it
   wants: a mean tension makes it shorter than the substrate that still holds its anchors, a
   gradient along the thickness bends every body out of the plane, and what is seen of an arc from
   above is its shorter chord. Theory: docs/theory/effects/residual-stress.md. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->nstress; i++)
        if (c->scene->stress[i].mean_Pa != 0 || c->scene->stress[i].gradient_Pa_per_m != 0)
            return true;
    return false;
}

/* 1/M of the layer, 1/Pa, M its biaxial modulus; NaN where it is not known */
static double compliance(const fw_mechanism *m) {
    return m->variant ? 1 / fw_device_material_biaxial_Pa(&m->variant->material) : (double)NAN;
}

typedef struct released {
    double strain;          /* of the layer: -mean/M */
    double curvature_per_m; /* gradient/M */
} released;

static released released_in(const fw_mechanism *m, const fw_device_scene *s) {
    double per_Pa = compliance(m), mean = 0, gradient = 0;
    for (int i = 0; i < s->nstress; i++) {
        mean += s->stress[i].mean_Pa;
        gradient += s->stress[i].gradient_Pa_per_m;
    }
    return (released){-mean * per_Pa, gradient * per_Pa};
}

static released released_by(const fw_effect_case *c) {
    return released_in(c->mechanism, c->scene);
}

double fw_effects_stress_strain(const fw_mechanism *m, const fw_device_scene *s) {
    const double strain = s->nstress > 0 ? released_in(m, s).strain : 0;
    return isnan(strain) ? 0 : -strain / (1 + strain);
}

/* ---- bow ---- */

typedef struct points { /* of all joints, local, body after body */
    int *first;         /* (nbody + 1) */
    fw_geometry_vec2 *at;
} points;

/* fill NULL: only counted */
static void put_point(points *p, int body, double x_m, double y_m, int *fill) {
    if (body == FW_GROUND) return;
    if (fill)
        p->at[fill[body]++] = (fw_geometry_vec2){x_m, y_m};
    else
        p->first[body + 1]++;
}

static void put_points(const fw_mechanism *m, points *p, int *fill) {
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *from = &m->pin[i];
        put_point(p, from->body_a, from->ax_m, from->ay_m, fill);
        put_point(p, from->body_b, from->bx_m, from->by_m, fill);
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *from = &m->joint[i];
        put_point(p, from->body_a, from->ax_m, from->ay_m, fill);
        put_point(p, from->body_b, from->bx_m, from->by_m, fill);
    }
}

/* largest distance between two joints of every body, m; 0 with fewer than two */
static fw_status find_extents(fw_arena *arena, const fw_mechanism *m, double *extent) {
    points p;
    int *fill;
    size_t n = (size_t)m->nbody;
    FW_NEED(p.first = fw_arena_array(arena, int, n + 1));
    FW_NEED(fill = fw_arena_array(arena, int, n));
    put_points(m, &p, NULL);
    for (size_t b = 0; b < n; b++)
        fill[b] = p.first[b], p.first[b + 1] += p.first[b];
    FW_NEED(p.at = fw_arena_array(arena, fw_geometry_vec2, (size_t)p.first[n]));
    put_points(m, &p, fill);
    for (size_t b = 0; b < n; b++)
        for (int i = p.first[b]; i < p.first[b + 1]; i++)
            for (int j = p.first[b]; j < i; j++)
                extent[b] = fmax(extent[b], hypot(p.at[i].x - p.at[j].x, p.at[i].y - p.at[j].y));
    return FW_OK;
}

/* strain that the chord of an arc of length L shows: (2/(kappa L)) sin(kappa L/2) - 1, whose series
   begins with -(kappa L)^2/24. Exact for a circle. */
static double chord_strain(double curvature_per_m, double length_m) {
    double half = 0.5 * curvature_per_m * length_m;
    if (fabs(half) < 1e-3) return -half * half / 6 * (1 - half * half / 20);
    return sin(half) / half - 1;
}

/* how far the free end of the longest body rises when the other one is held flat, m */
static fw_status find_rise(const fw_effect_case *c, double *rise_m, int *body) {
    const fw_mechanism *m = c->mechanism;
    double longest = 0, *extent;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_NEED(extent = fw_arena_array(c->arena, double, (size_t)m->nbody));
    FW_TRY(find_extents(c->arena, m, extent));
    *body = 0;
    for (int b = 0; b < m->nbody; b++)
        if (extent[b] > longest) longest = extent[b], *body = b;
    fw_arena_rewind(c->arena, mark);
    *rise_m = 0.5 * fabs(released_by(c).curvature_per_m) * longest * longest;
    return FW_OK;
}

/* ---- what is said ---- */

static fw_status check(const fw_effect_case *c, fw_diags *diags) {
    fw_place place = c->scene->nstress ? c->scene->stress[0].place : c->scene->place;
    if (isnan(compliance(c->mechanism)))
        return fw_diag_error(diags, 253, place,
                             "residual stress needs Young's modulus and Poisson's ratio of the "
                             "material, and they are not known; state them in <material>");
    int body;
    double up;
    FW_TRY(find_rise(c, &up, &body));
    double thickness = c->mechanism->variant->thickness_m;
    char rises[32], thick[32];
    if (!(up > thickness) || fw_diag_said(diags, 251, place)) return FW_OK;
    const char *id = c->mechanism->body[body].id;
    fw_diag_warning(diags, 251, place,
                    "the gradient of the layer's stress lifts the end of %s%s by %s um out "
                    "of the plane, more than the layer's thickness of %s um; the computed "
                    "motion in the plane neglects this; reduce the gradient, or judge whether "
                    "opposing walls still face each other",
                    FW_NAMED("body", fw_text_name(id)),
                    fw_number_text(rises, sizeof rises, 1e6 * up, 3),
                    fw_number_text(thick, sizeof thick, 1e6 * thickness, 3));
    return FW_OK;
}

/* The layer is the measure: by similarity the ground's points move by the opposite strain. Each
   body is shorter by its own bow besides. Inputs Pa, Pa/m, M in Pa; valid for sigma/M << 1
   and small slopes of the bow. Test: test_thermal.c. */
static fw_status add_strain(const fw_effect_case *c, double *strain) {
    const released r = released_by(c);
    const int bodies = c->mechanism->nbody;
    double *extent;
    FW_NEED(extent = fw_arena_array(c->arena, double, (size_t)bodies));
    FW_TRY(find_extents(c->arena, c->mechanism, extent));
    for (int b = 0; b < bodies; b++)
        strain[b] += chord_strain(r.curvature_per_m, extent[b]);
    strain[bodies] -= r.strain / (1 + r.strain);
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    if (isnan(released_by(c).strain)) return FW_OK; /* not known: see check */
    loads->strained = true;
    loads->grown += released_by(c).strain;
    return add_strain(c, loads->strain);
}

/* by the envelope: envelope_strain.c. Test: test_bounds.c */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    released r = released_by(c);
    int body;
    char strain[32], up[32];
    double rises;
    FW_TRY(find_rise(c, &rises, &body));
    *value = (double)INFINITY;
    if (c->envelope && c->envelope->valid && isfinite(r.strain + r.curvature_per_m)) {
        double *strains;
        FW_NEED(strains = fw_arena_array(c->arena, double, (size_t)c->mechanism->nbody + 1));
        FW_TRY(add_strain(c, strains));
        FW_TRY(fw_effects_envelope_strain(c, strains, NULL, value));
    }
    if (r.strain != 0 && (fw_effects_places_count(c) || fw_effects_foreign_in(c)))
        /* it moves places by itself, and against what is not of the layer */
        *value = (double)INFINITY;
    FW_NEED(*reason = fw_arena_printf(
                c->arena,
                "the released layer has a strain of %s against its substrate and bends its hinges; "
                "its gradient lifts the end of the longest body by %s um out of the plane%s",
                fw_number_text(strain, sizeof strain, r.strain, 3),
                fw_number_text(up, sizeof up, 1e6 * rises, 3), isfinite(*value) ? "" : ": kept"));
    return FW_OK;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    for (int i = 0; i < s->nstress; i++)
        fw_effects_say(to, "; residual stress {u}", s->stress[i].mean_Pa, "Pa");
}

const fw_effect_row fw_effect_residual_stress = {
    .id = "residual-stress",
    .summary = "the released layer is longer or shorter than its substrate, and bowed",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .check = check,
    .describe = describe};
