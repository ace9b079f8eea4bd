/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coulomb friction of joints. What is added here is what the scene states; the forces come with the
   joints' own, in multibody/multibody_friction.c and stick.c.

     at rest   |Q| <= mu_s N r      slides   Q = -mu_k N r sign(rate)      r = 1 of a slide

   N = preload + the force of the joint, or of the <contact> of the hinge. Theory:
   docs/theory/effects/friction.md. Test: test_friction_effect.c, test_friction.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>
#include <string.h>

static double largest(const fw_device_friction_use *u) {
    return isnan(u->static_coefficient) ? u->coefficient
                                        : fmax(u->coefficient, u->static_coefficient);
}

/* has it a joint that can rub, and a coefficient? */
static bool rubs(const fw_effect_case *c, const fw_device_friction_use *u) {
    const fw_mechanism *m = c->mechanism;
    bool pin = u->revolute != FW_NONE && u->revolute < m->npin;
    bool slide = u->joint != FW_NONE && u->joint < m->njoint &&
                 m->joint[u->joint].kind == FW_JOINT_PRISMATIC;
    return (pin || slide) && largest(u) > 0 && (!pin || !(u->radius_m <= 0));
}

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->nfriction; i++)
        if (rubs(c, &c->scene->friction[i])) return true;
    return false;
}

static int count(const fw_effect_case *c) {
    int sum = 0;
    for (int i = 0; i < c->scene->nfriction; i++)
        sum += rubs(c, &c->scene->friction[i]);
    return sum;
}

/* of the hinge's convex conjugate surface; NaN: there is none */
static double surface(const fw_mechanism *m, int pin) {
    for (int i = 0; i < m->nhinge; i++)
        if (m->hinge[i].pin == pin && m->hinge[i].surface_radius_m > 0)
            return m->hinge[i].surface_radius_m;
    return (double)NAN;
}

static bool same_point(const fw_effects_port *p, int body, double x, double y) {
    return p->body == body && p->x_m == x && p->y_m == y;
}

/* the contact element between the two points of the pin, or FW_NONE */
static int contact_of(const fw_effect_case *c, const fw_effects_loads *loads, int pin) {
    const fw_mechanism_pin *p = &c->mechanism->pin[pin];
    for (int i = 0; i < loads->nelement; i++) {
        const fw_effects_force_element *e = &loads->element[i];
        if (!e->class_->pressing || e->ports < 2 || strcmp(e->class_->effect, "contact") != 0)
            continue;
        const fw_effects_port *a = &e->port[0], *b = &e->port[1];
        bool forth = same_point(a, p->body_a, p->ax_m, p->ay_m) &&
                     same_point(b, p->body_b, p->bx_m, p->by_m);
        bool back = same_point(b, p->body_a, p->ax_m, p->ay_m) &&
                    same_point(a, p->body_b, p->bx_m, p->by_m);
        if (e->pin == pin || forth || back) return i;
    }
    return FW_NONE;
}

static fw_status unknown_radius(const fw_effect_case *c, const fw_device_friction_use *u) {
    const char *id = c->mechanism->pin[u->revolute].id;
    if (!c->diags) return FW_INPUT;
    return fw_diag_error(c->diags, 245, u->place,
                         "friction of joint %s needs the radius of the sliding surface, and the "
                         "joint has no conjugate surfaces that define one; give radius on "
                         "<friction>",
                         id ? id : "(unnamed)");
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    const fw_mechanism *m = c->mechanism;
    fw_status status = FW_OK;
    for (int i = 0; i < c->scene->nfriction; i++) {
        const fw_device_friction_use *u = &c->scene->friction[i];
        if (!rubs(c, u)) continue;
        bool pin = u->revolute != FW_NONE;
        double radius = !pin ? 1 : isnan(u->radius_m) ? surface(m, u->revolute) : u->radius_m;
        if (isnan(radius)) {
            status = unknown_radius(c, u); /* all of them are reported */
            if (status == FW_NOMEM) return status;
            continue;
        }
        fw_effects_friction *f = fw_effects_loads_add_friction(c->arena, loads);
        FW_NEED(f);
        *f = (fw_effects_friction){.pin = u->revolute,
                                   .joint = pin ? FW_NONE : u->joint,
                                   .element = pin ? contact_of(c, loads, u->revolute) : FW_NONE,
                                   .static_coefficient = largest(u),
                                   .kinetic_coefficient = u->coefficient,
                                   .radius_m = radius,
                                   .preload_N = u->preload_N,
                                   .id = pin ? m->pin[u->revolute].id : m->joint[u->joint].id,
                                   .place = u->place};
    }
    return status;
}

/* What it changes at most: friction_bound.c. Contacts press with forces of their own, which no
   envelope has. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    fw_effect_case quiet = *c; /* a radius that is missing is reported when it is compiled */
    fw_effects_loads rubs;
    *value = (double)INFINITY;
    *reason = "kept: contacts may press, with forces that friction changes itself";
    if (c->scene->ncontact > 0) return FW_OK;
    *reason = "kept: dry friction has no bound where linear theory has none";
    if (!c->envelope || !c->envelope->valid) return FW_OK;
    quiet.diags = NULL;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_TRY(fw_effects_loads_new(c->arena, c->mechanism, c->scene, &rubs));
    fw_status status = add(&quiet, &rubs);
    if (status == FW_NOMEM) return status;
    *reason = "kept: the radius of what slides is not known";
    if (status == FW_OK) FW_TRY(fw_effects_friction_bound(c, &rubs, value, reason));
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    for (int i = 0; i < s->nfriction; i++) {
        const fw_device_friction_use *f = &s->friction[i];
        fw_effects_say(to, "; friction in {s}, coefficient {n}",
                       f->revolute != FW_NONE ? device->revolute[f->revolute].id
                                              : device->joint[f->joint].id,
                       f->coefficient);
    }
}

const fw_effect_row fw_effect_friction = {
    .id = "friction",
    .summary = "Coulomb friction of hinges and sliding joints, with sticking",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 12000,
    .count = count,
    .describe = describe};
