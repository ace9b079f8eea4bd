/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pins of the mechanism that become flexures: which of them can, and with which element, the closed
   form of hinge_element.c, warm or not, or the exact beam of hinge_exact.c. */
#include "effects/hinge_element.h"
#include <math.h>
#include <string.h>

bool fw_effects_hinge_is_known(const fw_mechanism_hinge *hinge) {
    return isfinite(hinge->axis_rad) && hinge->law.length_m > 0 &&
           isfinite(hinge->law.bend_m_per_N);
}

static bool touches(const fw_device_scene *scene, int pin) {
    for (int i = 0; i < scene->ncontact; i++)
        if (scene->contact[i].joint == pin) return true;
    return false;
}

bool fw_effects_material_damped(const fw_effect_case *c, int pin) {
    const fw_mechanism *m = c->mechanism;
    int hinge = m->pin[pin].hinge;
    return c->scene->ndamping > 0 && hinge != FW_NONE && hinge < m->nhinge &&
           !m->hinge[hinge].damping_stated;
}

double fw_effects_loss(const fw_effect_case *c) {
    const int n = c->scene->ndamping;
    if (n > 0 && !isnan(c->scene->damping[n - 1].loss_factor))
        return c->scene->damping[n - 1].loss_factor;
    const fw_mechanism_variant *v = c->mechanism->variant;
    if (!v || v->material.loss.unknown || !isfinite(v->material.loss.value)) return (double)NAN;
    return v->material.loss.value;
}

static double drawn_turn(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

static double mass_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? (double)INFINITY : m->body[body].mass_kg;
}

/* A loss factor hardly depends on the frequency, a damper's is proportional to it. So along either
   direction the relaxation time is eta/omega, omega = sqrt(k/m) of the smaller mass of the hinge's
   bodies on the stiffness there, and no more than that of the rotation: what rings a hundred times
   faster would be damped a hundred times too much, and its strain with it. eta is no less than this,
   a quarter of a per cent of critical damping: what nothing but rounding and the law's first instant
   sets off dies within the scene, and need not be followed by steps as short as its period; what
   rings loses 0.8 % of its amplitude per half period.
   in: s, 1; out: s. Test: test_material_damping.c what_is_stiff_rings_on */
static const double fw_least_ringing_loss = 5e-3;

/* Where bodies may touch it is that of the rotation: every impact sets off what is stiff, and following
   it took twenty times as long (docs/decisions/0054-what-is-stiff-rings-on.md) */
static void lose(const fw_effect_case *c, const fw_mechanism_pin *pin,
                 const fw_flexure_hinge_at *at, double tau_s, double out[2]) {
    const double k[2] = {at->kx_N_per_m.value, at->ky_N_per_m.value};
    const double loss = fmax(fw_effects_loss(c), fw_least_ringing_loss);
    double mass = fmin(mass_of(c->mechanism, pin->body_a), mass_of(c->mechanism, pin->body_b));
    for (int i = 0; i < 2; i++)
        out[i] = c->scene->ncontact > 0 ? tau_s : fmin(tau_s, loss * sqrt(mass / k[i]));
}

fw_status fw_effects_hinge_release(const fw_effect_case *c, fw_effects_loads *loads, int hinge) {
    const fw_mechanism *m = c->mechanism;
    const fw_mechanism_hinge *h = &m->hinge[hinge];
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    if (loads->released[h->pin]) return FW_OK;
    fw_effects_flexed *f = fw_arena_one(c->arena, fw_effects_flexed);
    fw_effects_force_element *e =
        fw_effects_loads_add_element(c->arena, loads, &fw_effects_flexed_class, 2);
    if (!f || !e) return FW_NOMEM;
    *f = (fw_effects_flexed){
        .law = h->law,
        .sense = h->first_is_a ? 1 : -1,
        .factor = 1,
        .free_rad = pin->free_angle_rad,
        .axis_rad = h->axis_rad - 0.5 * (drawn_turn(m, pin->body_a) + drawn_turn(m, pin->body_b))};
    f->law.stiffness_Nm_per_rad = pin->stiffness_Nm_per_rad;
    double tau = 0;
    if (loads->torsion_of[h->pin]) { /* the spring is the element's now, the damper stays */
        fw_effects_torsion *t = &loads->torsion[loads->torsion_of[h->pin] - 1];
        t->stiffness_Nm_per_rad = 0;
        if (!h->damping_stated && pin->stiffness_Nm_per_rad > 0)
            tau = t->damping_Nms_per_rad / pin->stiffness_Nm_per_rad;
    }
    f->rest = fw_flexure_hinge_rest_of(&f->law);
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&f->law, 0, &at);
    lose(c, pin, &at, tau, f->loss_s);
    e->data = f;
    e->id = pin->id;
    e->pin = h->pin;
    e->port[0] = (fw_effects_port){pin->body_a, pin->ax_m, pin->ay_m};
    e->port[1] = (fw_effects_port){pin->body_b, pin->bx_m, pin->by_m};
    e->root_m[0] = pin->root_a_m, e->root_m[1] = pin->root_b_m;
    e->size_N_per_m = fmax(at.kx_N_per_m.value, at.ky_N_per_m.value);
    e->dissipates = fw_effects_flexed_loses(f);
    if (m->device && h->pin < m->device->nrevolute) e->place = m->device->revolute[h->pin].place;
    loads->released[h->pin] = true;
    loads->nreleased++;
    return FW_OK;
}

fw_status fw_effects_hinges_warm(fw_arena *arena, fw_effects_loads *loads, double part,
                                 double varying, const fw_quantity_law *law) {
    for (int i = 0; i < loads->nelement; i++) {
        fw_effects_force_element *e = &loads->element[i];
        if (e->class_ != &fw_effects_flexed_class) continue;
        fw_effects_flexed *f = fw_arena_one(arena, fw_effects_flexed);
        FW_NEED(f);
        *f = *(const fw_effects_flexed *)e->data;
        f->factor += part;
        e->size_N_per_m *= fabs(1 + part);
        if (law && fabs(varying) > 0) {
            f->varying = varying;
            e->law[0] = law, e->laws = 1;
            e->works = true;
        }
        e->data = f;
    }
    return FW_OK;
}

fw_status fw_effects_hinges_exact(fw_arena *arena, const fw_mechanism *m, fw_effects_loads *loads) {
    fw_effects_force_element *own;
    FW_NEED(own = fw_arena_array(arena, fw_effects_force_element, 2 * (size_t)loads->nelement + 1));
    if (loads->nelement > 0) memcpy(own, loads->element, (size_t)loads->nelement * sizeof *own);
    loads->element = own;
    for (int i = 0; i < loads->nelement; i++) {
        const fw_mechanism_hinge *h;
        if (own[i].class_ != &fw_effects_flexed_class) continue;
        h = &m->hinge[m->pin[own[i].pin].hinge];
        if (!fw_effects_exact_is_known(h)) continue;
        fw_effects_flexed *f = fw_arena_one(arena, fw_effects_flexed);
        FW_NEED(f);
        *f = *(const fw_effects_flexed *)own[i].data;
        FW_TRY(fw_effects_exact_new(arena, h, &f->exact));
        own[i].data = f;
        own[i].class_ = &fw_effects_exact_class;
    }
    return FW_OK;
}

/* where the file states the stiffness its law holds, unless the surfaces can touch: that needs the
   hinge to give */
bool fw_effects_hinge_flexes(const fw_effect_case *c, int hinge) {
    const fw_mechanism_hinge *h = &c->mechanism->hinge[hinge];
    bool stiff = !h->stated || c->mechanism->pin[h->pin].stiffness_Nm_per_rad > 0;
    return fw_effects_hinge_is_known(h) && (stiff || touches(c->scene, h->pin));
}

fw_status fw_effects_hinges_flex(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->mechanism->nhinge; i++)
        if (fw_effects_hinge_flexes(c, i)) FW_TRY(fw_effects_hinge_release(c, loads, i));
    return FW_OK;
}
