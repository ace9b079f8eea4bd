/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The air around a device: films below bodies and between walls, drag of the open air. Each is a
   damper; air_films.c has the physics. Theory: docs/theory/effects/air.md. */
#include "effects/air.h"
#include "base/constants.h"
#include "effects/envelope.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    return c->scene->nair > 0;
}

/* the bodies that an <air> of kind slide or drag acts on: [*first, *last] */
static void bodies_of(const fw_effect_case *c, const fw_device_air *a, int *first, int *last) {
    bool all = a->body == FW_NONE;
    *first = all ? 0 : a->body;
    *last = all ? c->mechanism->nbody - 1 : a->body;
}

static fw_status check(const fw_effect_case *c, fw_diags *diags) {
    for (int i = 0; i < c->scene->nair; i++) {
        const fw_device_air *a = &c->scene->air[i];
        int first, last;
        bodies_of(c, a, &first, &last);
        if (a->kind == FW_AIR_SQUEEZE) {
            if (isnan(fw_effects_air_depth(c->mechanism, a)))
                return fw_diag_error(diags, 253, a->place,
                                     "the depth of this film is not known: state it");
            continue;
        }
        for (int b = first; b <= last; b++) {
            const char *id = c->mechanism->body[b].id;
            if (!(fw_effects_air_face(c->mechanism, a, b).area_m2 > 0))
                return fw_diag_error(diags, 253, a->place,
                                     "body %s is not drawn, so the area that the air acts on is "
                                     "not known: state it",
                                     id ? id : "(unnamed)");
        }
    }
    return FW_OK;
}

/* ---- bound: |force| <= c times the largest speed that the envelope allows ---- */

/* at the centroid of the face, which turns about the centre of mass where the two are apart */
static void add_damper(const fw_effect_case *c, int body, fw_effects_damper d, double *force) {
    const double *speed = c->envelope->speed + 3 * body;
    const fw_geometry_vec2 at = fw_effects_air_centre(c->mechanism, body);
    double arm = hypot(at.x, at.y), most = hypot(speed[0], speed[1]) + arm * speed[2];
    force[3 * body] += d.force_Ns_per_m * (arm > 0 ? most : speed[0]);
    force[3 * body + 1] += d.force_Ns_per_m * (arm > 0 ? most : speed[1]);
    force[3 * body + 2] += d.couple_Nms * speed[2] + arm * d.force_Ns_per_m * most;
}

/* how far or fast a point of a body can move, arm in m; way: reach or speed (3 nbody) */
static double point_most(const double *way, int body, double arm_m) {
    if (body == FW_GROUND) return 0;
    return hypot(way[3 * body], way[3 * body + 1]) + arm_m * way[3 * body + 2];
}

static void add_to(double *force, int body, double arm_m, double most_N) {
    if (body == FW_GROUND) return;
    force[3 * body] += most_N, force[3 * body + 1] += most_N;
    force[3 * body + 2] += arm_m * most_N;
}

/* false: the walls may come so close that nothing can be said */
static bool add_squeeze(const fw_effect_case *c, const fw_device_air *a, double *force) {
    const fw_effects_envelope *e = c->envelope;
    const fw_effects_gas gas = fw_effects_gas_of(a);
    const fw_effects_squeeze film =
        fw_effects_air_squeeze(&gas, a->length_m, fw_effects_air_depth(c->mechanism, a), a->gap_m);
    double own = hypot(a->x_m, a->y_m), other = 0;
    if (a->against != FW_GROUND) {
        fw_geometry_vec2 wall = fw_mechanism_local_place(c->mechanism, a->body, a->x_m, a->y_m);
        const fw_mechanism_mass *b = &c->mechanism->body[a->against];
        other = hypot(wall.x - b->x_m, wall.y - b->y_m) + a->gap_m;
    }
    double moved = point_most(e->reach, a->body, own) + point_most(e->reach, a->against, other);
    double far = a->gap_m + moved; /* of the two middles: the lever of a turning normal */
    double turned = a->against == FW_GROUND ? 0 : e->reach[3 * a->against + 2];
    double least = a->gap_m - moved - turned * far;
    if (!(least > 0.01 * a->gap_m)) return false;
    double spin = a->against == FW_GROUND ? 0 : e->speed[3 * a->against + 2];
    double rate = point_most(e->speed, a->body, own) + point_most(e->speed, a->against, other);
    double most = fw_effects_squeeze_at(&film, least, NULL) * (rate + spin * far);
    add_to(force, a->body, own, most);
    add_to(force, a->against, other + far, most);
    return true;
}

static bool add_forces(const fw_effect_case *c, double *force) {
    for (int i = 0; i < c->scene->nair; i++) {
        const fw_device_air *a = &c->scene->air[i];
        const fw_effects_gas gas = fw_effects_gas_of(a);
        int first, last;
        bodies_of(c, a, &first, &last);
        if (a->kind == FW_AIR_SQUEEZE) {
            if (!add_squeeze(c, a, force)) return false;
            continue;
        }
        for (int b = first; b <= last; b++) {
            const fw_effects_face face = fw_effects_air_face(c->mechanism, a, b);
            add_damper(c, b,
                       a->kind == FW_AIR_SLIDE ? fw_effects_air_slide(&gas, &face, a->gap_m)
                                               : fw_effects_air_drag(&gas, &face),
                       force);
        }
    }
    return true;
}

/* ---- validity: numbers above 1 are named ---- */

static void name(fw_text *out, const char *what, double number) {
    char text[32];
    if (!(number > 1)) return;
    fw_text_printf(out, "; outside its validity: %s is %s (below 1 wanted)", what,
                   fw_number_text(text, sizeof text, number, 2));
}

/* at the lowest mode of the envelope and its largest speeds */
static void validity(const fw_effect_case *c, const fw_device_air *a, fw_text *out) {
    const fw_effects_envelope *e = c->envelope;
    const fw_effects_gas gas = fw_effects_gas_of(a);
    double omega = e->modes > 0 ? e->omega[0] : 0, mu = gas.viscosity_Pas;
    double rho = gas.density_kg_per_m3, depth = sqrt(2 * mu / (rho * omega));
    int first, last;
    if (a->kind == FW_AIR_SQUEEZE) {
        double across = fmin(a->length_m, fw_effects_air_depth(c->mechanism, a)), g = a->gap_m;
        name(out, "the squeeze number",
             12 * mu * omega * across * across / (gas.pressure_Pa * g * g));
        name(out, "the film's Reynolds number", rho * omega * g * g / mu);
        name(out, "ten gaps over the film's shorter side", 10 * g / across);
        return;
    }
    bodies_of(c, a, &first, &last);
    double largest = 0, fastest = 0;
    for (int b = first; b <= last; b++) {
        double size = sqrt(fw_effects_air_face(c->mechanism, a, b).area_m2 / FW_PI);
        largest = fmax(largest, size);
        fastest = fmax(fastest, size * point_most(e->speed, b, size));
    }
    if (a->kind == FW_AIR_SLIDE) {
        name(out, "gap over penetration depth", a->gap_m / depth);
        name(out, "gap over the radius of the largest face", a->gap_m / largest);
    } else {
        name(out, "radius over penetration depth", largest / depth);
        name(out, "the Reynolds number", rho * fastest / mu);
    }
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    *value = (double)INFINITY;
    if (!c->envelope || !c->envelope->valid) {
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "the air damps, and nothing bounds how fast the bodies move: kept (%s)",
                    c->envelope ? c->envelope->why_not : "not looked at"));
        return FW_OK;
    }
    double *force;
    FW_NEED(force = fw_arena_array(c->arena, double, 3 * (size_t)c->mechanism->nbody));
    if (add_forces(c, force)) *value = fw_effects_envelope_answer(c, force, (double)INFINITY);
    if (isnan(*value)) *value = (double)INFINITY;
    fw_text text = fw_text_new(c->arena);
    fw_text_add(&text,
                isfinite(*value)
                    ? "the air damps: answer of the modes to its forces at the largest speeds"
                    : "the air damps, and a film may close: kept");
    for (int i = 0; i < c->scene->nair; i++)
        validity(c, &c->scene->air[i], &text);
    FW_TRY(fw_text_end(&text));
    *reason = text.data;
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->scene->nair; i++) {
        const fw_device_air *a = &c->scene->air[i];
        int first, last;
        bodies_of(c, a, &first, &last);
        if (a->kind == FW_AIR_SQUEEZE) {
            if (fw_effects_air_depth(c->mechanism, a) > 0)
                FW_TRY(fw_effects_air_squeeze_add(c, loads, a));
            continue;
        }
        for (int b = first; b <= last; b++) {
            if (!(fw_effects_air_face(c->mechanism, a, b).area_m2 > 0)) continue; /* see check */
            FW_TRY(a->kind == FW_AIR_SLIDE ? fw_effects_air_slide_add(c, loads, a, b)
                                           : fw_effects_air_drag_add(c, loads, a, b));
        }
    }
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int all = 0;
    for (int i = 0; i < c->scene->nair; i++) {
        bool every = c->scene->air[i].kind != FW_AIR_SQUEEZE && c->scene->air[i].body == FW_NONE;
        all += every ? c->mechanism->nbody : 1;
    }
    return all;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    static const char *const kind[] = {[FW_AIR_SLIDE] = "sliding film",
                                       [FW_AIR_SQUEEZE] = "squeezed film",
                                       [FW_AIR_DRAG] = "drag"};
    for (int i = 0; i < s->nair; i++)
        fw_effects_say(to, "; air: {s} on {s}, {u}", kind[s->air[i].kind],
                       s->air[i].body < 0 ? "all bodies" : device->body[s->air[i].body].id,
                       s->air[i].pressure_Pa, "Pa");
}

const fw_effect_row fw_effect_air = {.id = "air",
                                     .summary = "films of air below and between bodies, and drag",
                                     .called_for = called_for,
                                     .bound = bound,
                                     .by_rate = true,
                                     .add = add,
                                     .check = check,
                                     .cost = 1470,
                                     .count = count,
                                     .describe = describe,
                                     .solid = FW_EFFECTS_SOLID_NO_PART};
