/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The air around what moves: films over the ground, drag, and the effect that they make with films between walls
   (squeeze_film.c). */
#include "effects/effect.h"
#include "base/constants.h"
#include "effects/envelope.h"
#include <math.h>

/* ---- what the air acts on ---- */

/* a stated area keeps the drawn figure; without one it is a disc, which has the least polar moment
   and perimeter of its area */
fw_effects_face fw_effects_air_face(const fw_mechanism *m, const fw_device_air *air, int body) {
    const fw_mechanism_shape *drawn = m->shape ? &m->shape[body] : NULL;
    bool known = drawn && drawn->area_m2 > 0;
    double area = air->area_m2;
    if (known && isnan(area))
        return (fw_effects_face){drawn->area_m2, drawn->polar_m4, drawn->perimeter_m};
    if (!known) return (fw_effects_face){area, area * area / (2 * FW_PI), 2 * sqrt(FW_PI * area)};
    double scale = area / drawn->area_m2;
    return (fw_effects_face){area, scale * scale * drawn->polar_m4,
                             sqrt(scale) * drawn->perimeter_m};
}

/* where the air acts on it: the centroid of its shape, from its centre of mass */
static fw_geometry_vec2 centre_of_face(const fw_mechanism *m, int body) {
    return m->shape ? m->shape[body].centroid : (fw_geometry_vec2){0, 0};
}

/* ---- dampers ---- */

/* Couette film: the air between the face of a body and the plane below it is sheared. With the gap
   g, viscosity mu_eff and the velocity field v + omega x r of the face,

     force -mu_eff A/g v at the face's centroid,   couple -mu_eff I_p/g omega,
     mu_eff = mu/(1 + 2 Kn),   Kn = mean free path/g   (slip on both walls)

   A area, I_p polar moment about the centroid; the plane takes the opposite. Source: Couette
   flow with first-order slip, e.g. Veijola and Turowski, J. Microelectromech. Syst. 10 (2001) 263.
   Valid while the gap is small against the penetration depth sqrt(2 nu/omega) and the face's size;
   accommodation 1. For Kn >> 1 it becomes the free-molecular mu A/(2 path) v. Test: test_air.c. */

fw_effects_damper fw_effects_air_slide(const fw_effects_gas *gas, const fw_effects_face *face,
                                       double gap_m) {
    double per_gap = gas->viscosity_Pas / (gap_m + 2 * gas->path_m);
    return (fw_effects_damper){per_gap * face->area_m2, per_gap * face->polar_m4};
}

/* v = B w, v the velocity of the body's port over the plane, which may itself turn about its own:
   d = p0 - p1, v = w0 - w1 - omega1 (-dy, dx). Forces -c B^T v, couples -k (omega0 - omega1). */
static void rows_of(const fw_effects_port_state *s, double b[2][6], double v[2]) {
    double dx = s->p[0] - s->p[3], dy = s->p[1] - s->p[4];
    const double all[2][6] = {{1, 0, 0, -1, 0, dy}, {0, 1, 0, 0, -1, -dx}};
    for (int i = 0; i < 2; i++) {
        v[i] = 0;
        for (int j = 0; j < 6; j++)
            b[i][j] = all[i][j], v[i] += all[i][j] * s->w[j];
    }
}

static void slide_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double *f) {
    const fw_effects_damper *d = e->data;
    double b[2][6], v[2], turn = d->couple_Nms * (s->w[2] - s->w[5]);
    rows_of(s, b, v);
    for (int j = 0; j < 6; j++)
        f[j] = -d->force_Ns_per_m * (b[0][j] * v[0] + b[1][j] * v[1]);
    f[2] -= turn, f[5] += turn;
}

static void slide_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double *stiffness, double *damping) {
    const fw_effects_damper *d = e->data;
    const double c = d->force_Ns_per_m, spin = s->w[5];
    double b[2][6], v[2];
    rows_of(s, b, v);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            damping[6 * i + j] = c * (b[0][i] * b[0][j] + b[1][i] * b[1][j]);
            stiffness[6 * i + j] = 0;
        }
    for (int sign = 1, j = 0; j < 6; j += 3, sign = -1) { /* columns of d: p0 and, negative, p1 */
        for (int i = 0; i < 6; i++) { /* dv/ddx = (0, -spin), dv/ddy = (spin, 0) */
            stiffness[6 * i + j] = -sign * c * b[1][i] * spin;
            stiffness[6 * i + j + 1] = sign * c * b[0][i] * spin;
        }
        stiffness[6 * 5 + j] -= sign * c * v[1];
        stiffness[6 * 5 + j + 1] += sign * c * v[0];
    }
    damping[6 * 2 + 2] += d->couple_Nms, damping[6 * 5 + 5] += d->couple_Nms;
    damping[6 * 2 + 5] -= d->couple_Nms, damping[6 * 5 + 2] -= d->couple_Nms;
}

static void slide_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                        double out[2]) {
    const fw_effects_damper *d = e->data;
    double b[2][6], v[2], spin = s->w[2] - s->w[5];
    rows_of(s, b, v);
    out[0] = d->force_Ns_per_m * (v[0] * v[0] + v[1] * v[1]) + d->couple_Nms * spin * spin;
    out[1] = 0;
}

static const fw_effects_element_class slide_class = {
    .effect = "air", .force = slide_force, .tangent = slide_tangent, .power = slide_power};

static fw_status slide_add(const fw_effect_case *c, fw_effects_loads *loads,
                           const fw_device_air *air, int body) {
    fw_effects_damper *data = fw_arena_one(c->arena, fw_effects_damper);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &slide_class, 2);
    FW_NEED(data && e);
    const fw_effects_gas gas = fw_effects_gas_of(air);
    const fw_effects_face face = fw_effects_air_face(c->mechanism, air, body);
    const fw_mechanism_mass *at = &c->mechanism->body[body];
    *data = fw_effects_air_slide(&gas, &face, air->gap_m);
    e->id = at->id;
    e->place = air->place;
    const fw_geometry_vec2 centre = centre_of_face(c->mechanism, body),
                           over = fw_mechanism_local_place(c->mechanism, body, centre.x, centre.y);
    e->port[0] = (fw_effects_port){body, centre.x, centre.y};
    e->port[1] = (fw_effects_port){FW_GROUND, over.x, over.y};
    e->dissipates = true;
    e->data = data;
    return FW_OK;
}

/* Open air around a thin body that moves in its own plane: the disc of its size, edgewise and
   turning about its axis, in creeping flow,

     force -(32/3) mu R v,   couple -(32/3) mu R^3 omega,

   R of the disc of equal perimeter for the force, of equal polar moment for the couple; in rare air
   both faces feel mu/(2 path) per area instead, and the two resistances add:

     1/c = 1/(32/3 mu R) + path/(mu A),   1/k = 1/(32/3 mu R^3) + path/(mu I_p).

   Source: Happel and Brenner, Low Reynolds Number Hydrodynamics, 1965, 4-26 and 5-11 (discs); sum
   of resistances: Sherman 1963, within some 10 % between the limits. Bodies that are not round: the
   disc is a stand-in, some 20 % for bars up to 10:1. Valid for Reynolds numbers below 1 and bodies
   smaller than the penetration depth sqrt(2 nu/omega). Test: test_air.c. */

fw_effects_damper fw_effects_air_drag(const fw_effects_gas *gas, const fw_effects_face *face) {
    double mu = gas->viscosity_Pas, radius = face->perimeter_m / (2 * FW_PI);
    double turning = pow(2 * face->polar_m4 / FW_PI, 0.25);
    double force = 32 * mu * radius / 3, couple = 32 * mu * turning * turning * turning / 3;
    return (fw_effects_damper){1 / (1 / force + gas->path_m / (mu * face->area_m2)),
                               1 / (1 / couple + gas->path_m / (mu * face->polar_m4))};
}

static void drag_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                       double *f) {
    const fw_effects_damper *d = e->data;
    f[0] = -d->force_Ns_per_m * s->w[0];
    f[1] = -d->force_Ns_per_m * s->w[1];
    f[2] = -d->couple_Nms * s->w[2];
}

static void drag_tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                         double *stiffness, double *damping) {
    const fw_effects_damper *d = e->data;
    (void)s;
    for (int i = 0; i < 9; i++)
        stiffness[i] = damping[i] = 0;
    damping[0] = damping[4] = d->force_Ns_per_m;
    damping[8] = d->couple_Nms;
}

static void drag_power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                       double out[2]) {
    const fw_effects_damper *d = e->data;
    out[0] = d->force_Ns_per_m * (s->w[0] * s->w[0] + s->w[1] * s->w[1]) +
             d->couple_Nms * s->w[2] * s->w[2];
    out[1] = 0;
}

static const fw_effects_element_class drag_class = {
    .effect = "air", .force = drag_force, .tangent = drag_tangent, .power = drag_power};

static fw_status drag_add(const fw_effect_case *c, fw_effects_loads *loads,
                          const fw_device_air *air, int body) {
    fw_effects_damper *data = fw_arena_one(c->arena, fw_effects_damper);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &drag_class, 1);
    FW_NEED(data && e);
    const fw_effects_gas gas = fw_effects_gas_of(air);
    const fw_effects_face face = fw_effects_air_face(c->mechanism, air, body);
    const fw_geometry_vec2 centre = centre_of_face(c->mechanism, body);
    *data = fw_effects_air_drag(&gas, &face);
    e->id = c->mechanism->body[body].id;
    e->place = air->place;
    e->port[0] = (fw_effects_port){body, centre.x, centre.y};
    e->dissipates = true;
    e->data = data;
    return FW_OK;
}

/* ---- the effect ---- */

/* The air around a device: films below bodies and between walls, drag of the open air. Each is a
   damper; air.c has the physics. Theory: docs/theory/effects/air.md. */

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
                                     "%s%s is not drawn, so the area that the air acts on is "
                                     "not known: state it",
                                     FW_NAMED("body", fw_text_name(id)));
        }
    }
    return FW_OK;
}

/* ---- bound: |force| <= c times the largest speed that the envelope allows ---- */

/* at the centroid of the face, which turns about the centre of mass where the two are apart */
static void add_damper(const fw_effect_case *c, int body, fw_effects_damper d, double *force) {
    const double *speed = c->envelope->speed + 3 * body;
    const fw_geometry_vec2 at = centre_of_face(c->mechanism, body);
    double arm = hypot(at.x, at.y), most = hypot(speed[0], speed[1]) + arm * speed[2];
    force[3 * body] += d.force_Ns_per_m * (arm > 0 ? most : speed[0]);
    force[3 * body + 1] += d.force_Ns_per_m * (arm > 0 ? most : speed[1]);
    force[3 * body + 2] += d.couple_Nms * speed[2] + arm * d.force_Ns_per_m * most;
}

static bool add_forces(const fw_effect_case *c, double *force) {
    for (int i = 0; i < c->scene->nair; i++) {
        const fw_device_air *a = &c->scene->air[i];
        const fw_effects_gas gas = fw_effects_gas_of(a);
        int first, last;
        bodies_of(c, a, &first, &last);
        if (a->kind == FW_AIR_SQUEEZE) {
            if (!fw_effects_squeeze_push(c, a, force)) return false;
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
        name(out, "the film's Reynolds number", rho * omega * g * g / mu);
        name(out, "ten gaps over the film's shorter side", 10 * g / across);
        return;
    }
    bodies_of(c, a, &first, &last);
    double largest = 0, fastest = 0;
    for (int b = first; b <= last; b++) {
        double size = sqrt(fw_effects_air_face(c->mechanism, a, b).area_m2 / FW_PI);
        largest = fmax(largest, size);
        fastest = fmax(fastest, size * fw_effects_envelope_point(e->speed, b, size));
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
                FW_TRY(fw_effects_squeeze_add(c, loads, a));
            continue;
        }
        for (int b = first; b <= last; b++) {
            if (!(fw_effects_air_face(c->mechanism, a, b).area_m2 > 0)) continue; /* see check */
            FW_TRY(a->kind == FW_AIR_SLIDE ? slide_add(c, loads, a, b) : drag_add(c, loads, a, b));
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
                                     .lacking = fw_effects_squeeze_lacking,
                                     .add = add,
                                     .check = check,
                                     .cost = 1470,
                                     .count = count,
                                     .describe = describe,
                                     .solid = FW_EFFECTS_SOLID_NO_PART};
