/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges that are no pins: which pins become flexures, at which level, and what these do that is not linear. */
#include "effects/effect.h"
#include "effects/modal.h"
#include <math.h>
#include <string.h>

/* ---- pins that become flexures ---- */

/* Pins of the mechanism that become flexures: which of them can, and with which element, the closed
   form, warm or not, or the exact beam (hinge_element.c). */

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

/* springs between points, and of pins that are no flexures, that are let go strained */
static bool springs_let_go(const fw_mechanism *m) {
    const double rounding = 1e-9;
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        const fw_geometry_vec2 a = fw_mechanism_local_place(m, s->body_a, s->ax_m, s->ay_m),
                               b = fw_mechanism_local_place(m, s->body_b, s->bx_m, s->by_m);
        const double length = hypot(b.x - a.x, b.y - a.y), by = length - s->length_m;
        if (s->stiffness_N_per_m > 0 && (s->cable ? by : fabs(by)) > rounding * length) return true;
    }
    for (int i = 0; i < m->npin; i++)
        if (m->pin[i].hinge == FW_NONE && m->pin[i].stiffness_Nm_per_rad > 0 &&
            fabs(fw_effects_pin_deflection(m, i)) > rounding)
            return true;
    return false;
}

/* The largest of all that has a law, drivers among it, of what begins with a velocity, and of springs that are let go;
   weight and friction are there from the start and jolt nothing. Where a scene has a part of another's loads it is damped as
   that one is. */
static double largest_jolt(const fw_effect_case *c, double omega) {
    const fw_device_scene *s = c->scene->set_off ? c->scene->set_off : c->scene;
    const fw_mechanism *m = c->mechanism;
    double most = 0, end = s->duration_s;
    for (int i = 0; i < s->nforce; i++)
        most = fmax(most, fw_quantity_law_jolt(s->force[i].law, false, end, omega));
    for (int i = 0; i < s->ntorque; i++)
        most = fmax(most, fw_quantity_law_jolt(s->torque[i].law, false, end, omega));
    for (int i = 0; i < s->ntendon; i++)
        most = fmax(most, fw_quantity_law_jolt(s->tendon[i].law, false, end, omega));
    for (int i = 0; i < s->ncomb; i++)
        most = fmax(most, fw_quantity_law_jolt(s->comb[i].law, false, end, omega));
    for (int i = 0; i < s->nbase; i++)
        most = fmax(most, fw_quantity_law_jolt(s->base[i].law, false, end, omega));
    for (int i = 0; i < s->ntemperature; i++)
        most = fmax(most, fw_quantity_law_jolt(s->temperature[i].law, false, end, omega));
    for (int i = 0; i < s->npart; i++)
        most = fmax(most, fw_quantity_law_jolt(s->part[i].law, false, end, omega));
    for (int i = 0; i < m->ndriver; i++)
        most = fmax(most, fw_quantity_law_jolt(&m->driver[i].law, true, end, omega));
    return s->ninitial > 0 || springs_let_go(m) ? 1 : most;
}

/* A loss factor hardly depends on the frequency, a damper's is proportional to it. So along either
   direction the relaxation time is eta/omega, omega = sqrt(k/m) of the smaller mass of the hinge's
   bodies on the stiffness there, and no more than that of the rotation: what rings a hundred times
   faster would be damped a hundred times too much, and its strain with it. Where the scene sets off
   less than a two-hundredth of what its loads do (velocities and jumps set off all of it), eta is no
   less than a quarter of a per cent of critical damping: what nothing but rounding and the law's
   first instant sets off dies within the scene, and need not be followed by steps as short as its
   period. What is set off in earnest keeps the material's loss, since the least loss takes 0.8 % of
   its amplitude per half period, and its peak with it. Where the loss is not known it is the least.
   in: s, 1; out: s. Source: docs/decisions/0062-what-is-jolted-rings.md. Test:
   test_material_damping.c what_is_stiff_rings_on, judge.examples */
static const double fw_least_ringing_loss = 5e-3, fw_jolted = 5e-3;

static void lose(const fw_effect_case *c, const fw_mechanism_pin *pin,
                 const fw_flexure_hinge_at *at, double tau_s, double out[2]) {
    const double k[2] = {at->kx_N_per_m.value, at->ky_N_per_m.value};
    double own = fw_effects_loss(c), slow = fmax(own, fw_least_ringing_loss);
    double mass = fmin(mass_of(c->mechanism, pin->body_a), mass_of(c->mechanism, pin->body_b));
    for (int i = 0; i < 2; i++) {
        double omega = sqrt(k[i] / mass);
        bool rings = isfinite(own) && largest_jolt(c, omega) > fw_jolted;
        out[i] = fmin(tau_s, (rings ? own : slow) / omega);
    }
}

fw_status fw_effects_hinge_release(const fw_effect_case *c, fw_effects_loads *loads, int hinge) {
    const fw_mechanism *m = c->mechanism;
    const fw_mechanism_hinge *h = &m->hinge[hinge];
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    if (loads->released[h->pin]) return FW_OK;
    fw_effects_flexed *f = fw_arena_one(c->arena, fw_effects_flexed);
    fw_effects_force_element *e =
        fw_effects_loads_add_element(c->arena, loads, &fw_effects_flexed_class, 2);
    fw_effects_bent *last = fw_arena_one(c->arena, fw_effects_bent);
    if (!f || !e || !last) return FW_NOMEM;
    *f = (fw_effects_flexed){
        .law = h->law,
        .last = last,
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

fw_status fw_effects_hinges_stiffer(const fw_effect_case *c, fw_effects_loads *loads, double part,
                                    double along) {
    for (int k = 0; k < c->mechanism->nhinge; k++) {
        const int of = loads->torsion_of[c->mechanism->hinge[k].pin];
        if (of > 0) loads->torsion[of - 1].stiffness_Nm_per_rad *= 1 + part;
    }
    for (int i = 0; i < loads->nelement; i++) {
        fw_effects_force_element *e = &loads->element[i];
        if (e->class_ != &fw_effects_flexed_class) continue;
        fw_effects_flexed *f = fw_arena_one(c->arena, fw_effects_flexed);
        FW_NEED(f);
        *f = *(const fw_effects_flexed *)e->data;
        f->factor *= 1 + part, f->varying *= 1 + part;
        e->size_N_per_m *= 1 + part;
        if (along != 0) { /* of another law nothing is remembered */
            f->along = along;
            FW_TRY(fw_flexure_hinge_law_along(c->arena, &f->law, 1 + along));
            f->rest = fw_flexure_hinge_rest_of(&f->law);
            FW_NEED(f->last = fw_arena_one(c->arena, fw_effects_bent));
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
        FW_TRY(fw_effects_exact_new(arena, h, f->along, &f->exact));
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

/* ---- what a flexure does that its tangent does not ---- */

/* What a flexure does that its tangent as drawn does not. With F the force that it carries (world),
   e and n its axes turned by psi = half of what both bodies have turned, C its softness:

     opening  (R C(th) R^T - C(0)) F + o d(o th) n(psi)      turned, softer, drifted
     torque   F_n d'(o th) - o (1/2) (kx'/kx^2 F_e^2 + ky'/ky^2 F_n^2)  on th
     couple   -(1/2) F_e (F_n (1/ky - 1/kx) + o d)  on both bodies

   (negative gradient of the energy U of hinge_element.c; d: drift; and what the hinge shortens by
   and is stiffened by, flexure/finite_force.c). An opening D pushes mode j with -pull_j . D, pull_j
   the force of the hinge in the mode. F is that of the slow modes as they are and of the others as
   they follow the loads: pins hold a mechanism without repeated joints whatever the openings are,
   so that F does not change with them.

   Fast modes ring besides, with F + r, |r| <= ring: what is linear in r comes at their frequencies
   (`wave`), what is quadratic stays (`lasting`). Inputs SI. Exact in the law; first order in the
   geometry of arms, which pins have too. Cost per instant: a law per hinge, and hinges times modes.
   Source: docs/theory/effects/nonlinear-hinge.md. Test: test_hinge_give.c. */

double fw_effects_hinge_source_mode(const fw_effects_hinge_source *s, int part, int mode) {
    if (part == 0) return -s->pull_e[mode];
    if (part == 1) return -s->pull_n[mode];
    return part == 2 ? s->turn[mode] : s->both[mode];
}

void fw_effects_hinge_source_of(const fw_mechanism_hinge *h, fw_effects_hinge_source *s) {
    fw_flexure_hinge_at drawn;
    *s = (fw_effects_hinge_source){.hinge = h, .sense = h->first_is_a ? 1 : -1};
    s->rest = fw_flexure_hinge_rest_of(&h->law);
    fw_flexure_hinge_law_slopes(&h->law, &s->rest, 0, &drawn);
    s->softness_m_per_N[0] = 1 / drawn.kx_N_per_m.value;
    s->softness_m_per_N[1] = 1 / drawn.ky_N_per_m.value;
}

static fw_status new_source(fw_arena *arena, const fw_effects_modal *o, const fw_mechanism_hinge *h,
                            int slow, const double *ring, fw_effects_hinge_source *s) {
    size_t modes = (size_t)o->modes, pins = (size_t)o->mechanism->npin, n = (size_t)o->n;
    const fw_mechanism_pin *p = &o->mechanism->pin[h->pin];
    fw_effects_hinge_source_of(h, s);
    double **of[] = {&s->pull_e, &s->pull_n, &s->turn, &s->both};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(arena, double, modes));
    double c = cos(h->axis_rad), sine = sin(h->axis_rad);
    for (size_t j = 0; j < modes; j++) {
        const double *pull = o->pull + 2 * (j * pins + (size_t)h->pin);
        s->pull_e[j] = c * pull[0] + sine * pull[1];
        s->pull_n[j] = c * pull[1] - sine * pull[0];
        s->turn[j] = o->turn[j * pins + (size_t)h->pin];
        if (p->body_a != FW_GROUND) s->both[j] += o->shape[j * n + 3 * (size_t)p->body_a + 2];
        if (p->body_b != FW_GROUND) s->both[j] += o->shape[j * n + 3 * (size_t)p->body_b + 2];
        if (j < (size_t)slow) continue;
        s->ring_N[0] += fabs(s->pull_e[j]) * ring[j];
        s->ring_N[1] += fabs(s->pull_n[j]) * ring[j];
    }
    return FW_OK;
}

fw_status fw_effects_hinge_sources_new(fw_arena *arena, const fw_effects_modal *o, int slow,
                                       const double *ring, fw_effects_hinge_sources *all) {
    const fw_mechanism *m = o->mechanism;
    *all = (fw_effects_hinge_sources){.modal = o, .slow = slow};
    FW_NEED(all->item = fw_arena_array(arena, fw_effects_hinge_source, (size_t)m->nhinge));
    FW_NEED(all->at = fw_arena_array(arena, double, (size_t)o->modes));
    FW_NEED(all->force = fw_arena_array(arena, double, (size_t)o->modes));
    FW_NEED(all->rapid_rad = fw_arena_array(arena, double, (size_t)m->npin));
    for (int i = 0; i < m->nhinge; i++)
        if (o->loads->released[m->hinge[i].pin])
            FW_TRY(new_source(arena, o, &m->hinge[i], slow, ring, &all->item[all->count++]));
    return FW_OK;
}

/* of a hinge at an instant: where its axes are, and its law at that rotation */
typedef struct posture {
    double rotation, sense, c, s; /* c, s: of psi */
    fw_flexure_hinge_rotated law;
} posture;

static void posture_of(const fw_effects_hinge_source *h, double rotation, double turned,
                       posture *at) {
    at->rotation = rotation, at->sense = h->sense;
    at->c = cos(turned), at->s = sin(turned);
    fw_flexure_hinge_law_rotated(&h->hinge->law, &h->rest, h->sense * rotation, &at->law);
}

/* the parts under a force along e and n as drawn; infinite where the hinge cannot carry it */
static void parts_at(const fw_effects_hinge_source *h, const posture *at, double fe, double fn,
                     double *part) {
    double o = at->sense, e = at->c * fe + at->s * fn, n = at->c * fn - at->s * fe; /* as turned */
    double u[2], moment, pull, th = o * at->rotation;
    if (!fw_flexure_hinge_rotated_under(&at->law, (const double[2]){o * e, o * n}, u, &moment,
                                        &pull)) {
        for (int k = 0; k < FW_HINGE_PARTS; k++)
            part[k] = (double)INFINITY;
        return;
    }
    double w = o * u[0], y = o * u[1];
    part[0] = at->c * w - at->s * y - h->softness_m_per_N[0] * fe;
    part[1] = at->s * w + at->c * y - h->softness_m_per_N[1] * fn;
    part[2] = -o * (moment - h->hinge->law.stiffness_Nm_per_rad * th);
    part[3] = -0.5 * (e * y - n * w);
}

void fw_effects_hinge_source_parts(const fw_effects_hinge_source *h, double rotation, double turned,
                                   double fe, double fn, double *part) {
    posture p;
    posture_of(h, rotation, turned, &p);
    parts_at(h, &p, fe, fn, part);
}

/* what r along e, or n, can add in either direction */
static void open_parts(fw_effects_hinge_source *h, const posture *at, double fe, double fn,
                       const double *now) {
    for (int d = 0; d < 2; d++) {
        double r = h->ring_N[d], plus[FW_HINGE_PARTS], minus[FW_HINGE_PARTS];
        if (r == 0) continue; /* nothing rings */
        parts_at(h, at, fe + (d ? 0 : r), fn + (d ? r : 0), plus);
        parts_at(h, at, fe - (d ? 0 : r), fn - (d ? r : 0), minus);
        for (int k = 0; k < FW_HINGE_PARTS; k++) {
            h->wave[k] = fmax(h->wave[k], fabs(plus[k] - minus[k]));
            h->lasting[k] = fmax(h->lasting[k], 2 * fabs(0.5 * (plus[k] + minus[k]) - now[k]));
        }
    }
    double mixed = fabs(h->softness_m_per_N[0] - h->softness_m_per_N[1]);
    h->lasting[3] = fmax(h->lasting[3], h->ring_N[0] * h->ring_N[1] * mixed);
}

/* the largest so far of the forces, and of what modes that follow at rest turn pins by */
static void note_most(const fw_effects_hinge_sources *all, const double *force) {
    const fw_effects_modal *o = all->modal;
    size_t pins = (size_t)o->mechanism->npin;
    for (int j = 0; j < o->modes; j++)
        all->force[j] = isfinite(force[j]) ? fmax(all->force[j], fabs(force[j])) : (double)INFINITY;
    for (size_t i = 0; i < pins; i++) {
        double sum = 0;
        for (int j = all->slow; j < o->modes; j++)
            sum += o->turn[(size_t)j * pins + i] * force[j] / (o->omega[j] * o->omega[j]);
        all->rapid_rad[i] = fmax(all->rapid_rad[i], fabs(sum));
    }
}

void fw_effects_hinge_sources_at(void *data, const double *q, const double *load, bool there,
                                 double *force) {
    fw_effects_hinge_sources *all = data;
    const fw_effects_modal *o = all->modal;
    posture p;
    for (int j = 0; j < o->modes; j++) {
        all->at[j] = j < all->slow ? q[j] : load[j] / (o->omega[j] * o->omega[j]);
        force[j] = 0;
    }
    for (int i = 0; i < all->count; i++) {
        fw_effects_hinge_source *h = &all->item[i];
        double fe = 0, fn = 0, angle = 0, turned = 0, part[FW_HINGE_PARTS];
        for (int j = 0; j < o->modes; j++) {
            double at = all->at[j];
            fe -= h->pull_e[j] * at, fn -= h->pull_n[j] * at;
            angle += h->turn[j] * at, turned += 0.5 * h->both[j] * at;
        }
        posture_of(h, angle, turned, &p);
        parts_at(h, &p, fe, fn, part);
        if (there) open_parts(h, &p, fe, fn, part);
        for (int j = 0; j < o->modes; j++)
            force[j] = force[j] - part[0] * h->pull_e[j] - part[1] * h->pull_n[j] +
                       part[2] * h->turn[j] + part[3] * h->both[j];
    }
    note_most(all, force);
}

/* The levels at which hinges can be taken, and the way from one to the next. Theory:
   docs/theory/hinge-models.md. */

/* measured like the rows' costs: a force from the lattice, as motions have it; a solution of the beam
   itself takes 21000 */
static const double exact_cost = 3000;

static const struct {
    const char *name, *summary;
    fw_effects_hinge_model below; /* the level that auto tries before it */
} models[] = {
    [FW_HINGE_AUTO] = {"auto", "the cheapest whose error is below the accuracy", FW_HINGE_AUTO},
    [FW_HINGE_REVOLUTE] = {"revolute", "pins at the elastic centres", FW_HINGE_REVOLUTE},
    [FW_HINGE_COMPLIANCE] = {"compliance", "closed form that gives and drifts", FW_HINGE_REVOLUTE},
    [FW_HINGE_ELASTICA] = {"elastica", "geometrically exact beams", FW_HINGE_COMPLIANCE},
};

size_t fw_effects_hinge_model_count(void) {
    return sizeof models / sizeof models[0];
}

const char *fw_effects_hinge_model_text(fw_effects_hinge_model model) {
    return models[model].name;
}

const char *fw_effects_hinge_model_summary(fw_effects_hinge_model model) {
    return models[model].summary;
}

static int could(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->nhinge; i++)
        n += fw_effects_hinge_flexes(c, i);
    return n;
}

bool fw_effects_hinge_forced(const char *effect, fw_effects_hinge_model asked, bool *in) {
    if (asked == FW_HINGE_AUTO || strcmp(effect, "nonlinear-hinge") != 0) return false;
    *in = asked != FW_HINGE_REVOLUTE;
    return true;
}

const char *fw_effects_hinge_forced_reason(const fw_effect_choice *choice) {
    if (choice->pins_first)
        return "pins are tried first: their stiffnesses are stated, and what hinges that give "
               "would "
               "change is computed at the peak";
    if (choice->hinge == FW_HINGE_REVOLUTE)
        return "ideal pins in place of the hinges were asked for (--hinge-model revolute)";
    if (choice->ended)
        return "called for, as exact beams: the closed form does not hold where this leads";
    if (choice->elsewhere)
        return "called for, as exact beams: they may rest elsewhere than the closed form";
    if (choice->below > 0)
        return choice->hinge == FW_HINGE_ELASTICA
                   ? "called for, as exact beams: the closed form was found to be off by more than "
                     "the accuracy wanted"
                   : "called for: pins were found to be off by more than the accuracy wanted";
    return choice->hinge == FW_HINGE_ELASTICA
               ? "called for, and hinges as exact beams were asked for (--hinge-model elastica)"
               : "called for, and hinges that give were asked for (--hinge-model compliance)";
}

static fw_status why_climbed(const fw_effect_case *c, const fw_effect_choice *choice,
                             const char **why) {
    char by[32];
    fw_percent_text(by, sizeof by, choice->below);
    FW_NEED(*why = fw_arena_printf(
                c->arena, "%s was computed to be off by %s %% of %s, not below the accuracy wanted",
                models[models[choice->hinge].below].name, by,
                choice->below_of ? choice->below_of : "the largest hinge angle"));
    return FW_OK;
}

static const char *why_used(const fw_effect_entry *entry, const fw_effect_choice *choice,
                            fw_effects_hinge_model used, bool touching) {
    fw_effects_hinge_model asked = choice->hinge;
    if (choice->ended && asked == used)
        return "closed forms were tried, and a flexure came to where its own does not hold";
    if (choice->elsewhere && asked == used)
        return "closed forms were tried, and exact beams may rest elsewhere: they have no "
               "equilibrium there, or forces along and across a flexure are coupled";
    if (choice->pins_first && asked == used) return "pins are what stated stiffnesses describe";
    if (asked == used) return "asked for";
    if (!entry || !entry->called_for) return "no flexure has a law of its own";
    if (asked != FW_HINGE_AUTO)
        return touching ? "pins were asked for, but surfaces that may touch need hinges that give"
                        : "another was asked for, which no hinge here can be";
    if (choice->mode != FW_EFFECTS_AUTO)
        return used == FW_HINGE_REVOLUTE ? "nonlinear-hinge is not among the effects asked for"
                                         : "nothing is left out";
    return used == FW_HINGE_REVOLUTE
               ? "what hinges do besides turning is bounded below the accuracy wanted"
               : "nothing bounds what hinges do besides turning below the accuracy wanted";
}

/* hinges of which nothing but a rotation is known */
static fw_status report_pins(const fw_effect_case *c, const char **why) {
    const fw_mechanism *m = c->mechanism;
    fw_text names = fw_text_new(c->arena);
    int count = 0;
    for (int i = 0; i < m->nhinge; i++)
        if (!fw_effects_hinge_flexes(c, i))
            fw_text_printf(&names, "%s%s", count++ ? ", " : "", m->pin[m->hinge[i].pin].id);
    if (count == 0) return FW_OK;
    FW_TRY(fw_text_end(&names));
    const char *few = fw_text_few(c->arena, names.data);
    FW_NEED(few);
    FW_NEED(*why = fw_arena_printf(c->arena,
                                   "%s; %s %s: the axis is not known (it is neither drawn nor "
                                   "stated)",
                                   *why, few, count > 1 ? "stay pins" : "stays a pin"));
    return FW_OK;
}

fw_status fw_effects_hinge_settle(const fw_effect_case *c, const fw_effect_choice *choice,
                                  fw_effect_ledger *ledger, fw_effects_loads *loads) {
    const fw_effects_hinge_model asked = choice->hinge;
    fw_effect_entry *entry = NULL;
    bool touching = false;
    for (int i = 0; i < ledger->count; i++) {
        if (strcmp(ledger->item[i].id, "nonlinear-hinge") == 0) entry = &ledger->item[i];
        if (strcmp(ledger->item[i].id, "contact") == 0) touching = ledger->item[i].active;
    }
    bool gives = loads->nreleased > 0 && (!entry || entry->active || touching);
    ledger->hinge = (fw_effects_hinge_use){
        .used = FW_HINGE_REVOLUTE, .error = (double)NAN, .pins_first = choice->pins_first};
    if (c->mechanism->nhinge == 0) return FW_OK;
    if (gives)
        ledger->hinge.used = asked == FW_HINGE_ELASTICA ? FW_HINGE_ELASTICA : FW_HINGE_COMPLIANCE;
    ledger->hinge.why = why_used(entry, choice, ledger->hinge.used, touching);
    if (choice->below > 0 && asked == ledger->hinge.used)
        FW_TRY(why_climbed(c, choice, &ledger->hinge.why));
    FW_TRY(report_pins(c, &ledger->hinge.why));
    if (ledger->hinge.used != FW_HINGE_ELASTICA) return FW_OK;
    ledger->hinge.error = fw_effects_exact_tolerance;
    if (entry) entry->cost = exact_cost * could(c);
    return fw_effects_hinges_exact(c->arena, c->mechanism, loads);
}

/* ---- one level up ---- */

static bool any_exact(const fw_effects_loads *from, const fw_effects_loads *to) {
    for (int i = 0; i < from->nelement; i++)
        if (from->element[i].class_ != to->element[i].class_) return true;
    return false;
}

/* arrays that releasing a hinge writes to become the copy's own */
static fw_status own_arrays(fw_arena *arena, const fw_mechanism *m, fw_effects_loads *loads) {
    size_t pins = (size_t)m->npin, elements = (size_t)loads->nelement;
    fw_effects_torsion *torsion;
    bool *released;
    fw_effects_force_element *element;
    FW_NEED(torsion = fw_arena_array(arena, fw_effects_torsion, pins));
    FW_NEED(released = fw_arena_array(arena, bool, pins));
    FW_NEED(element = fw_arena_array(arena, fw_effects_force_element, 2 * elements + 1));
    if (loads->ntorsion > 0)
        memcpy(torsion, loads->torsion, (size_t)loads->ntorsion * sizeof *torsion);
    if (pins > 0) memcpy(released, loads->released, pins * sizeof *released);
    if (elements > 0) memcpy(element, loads->element, elements * sizeof *element);
    loads->torsion = torsion;
    loads->released = released;
    loads->element = element;
    return FW_OK;
}

fw_status fw_effects_hinges_up(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, const fw_effects_loads *loads,
                               fw_effects_hinge_model used, fw_effects_loads *up,
                               fw_effects_hinge_model *next) {
    const fw_effect_case c = {.arena = arena, .mechanism = mechanism, .scene = scene};
    *up = *loads;
    *next = used;
    if (used == FW_HINGE_REVOLUTE) {
        FW_TRY(own_arrays(arena, mechanism, up));
        FW_TRY(fw_effects_hinges_flex(&c, up));
        if (up->nreleased > loads->nreleased) *next = FW_HINGE_COMPLIANCE;
    } else if (used == FW_HINGE_COMPLIANCE) {
        FW_TRY(fw_effects_hinges_exact(arena, mechanism, up));
        if (any_exact(loads, up)) *next = FW_HINGE_ELASTICA;
    }
    return FW_OK;
}
