/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dry friction of joints: how much it can change the peaks, and which joints have it. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

/* ---- how much it can change ---- */

/* How much dry friction can change the peaks. A joint with friction pushes its coordinate with
   |T_i| <= mu_i r_i N_i, of any course in time:

     N_i <= preload_i + N0_i + sum_j G_ij T_j     N0: joint force of the motion without friction
     (1 - K) T = mu r (preload + N0),  K_ij = mu_i r_i G_ij    has T > 0 just where the spectral
                                                  radius of K is below 1: else there is no bound
     |change of a pin| <= sum_l |turn_l| y_l sum_j |s_l . b_j| T_j,   y: integral of the size of
                                                  the mode's response to an impulse over the scene
   b: gradient of the coordinate. G from the multipliers: with q'' = s.b T - w^2 q - c q'
     lambda = [lambda(b) - sum_l lambda(M s_l) s_l.b] T + sum_l lambda(M s_l) (w_l^2 q_l + c q')
   with |q_l| <= y_l |s_l.b| T; of hinges that give by the forces of their springs.

   Inputs SI from the envelope; output relative to its floor. Proved within linear theory; the
   margin of the envelope for what is not linear is tested (test_bounds.c, test_hard_bounds.c). Not
   above a third: stops keep half of the floor as their distance. Cost: a solution per friction and
   mode. Source: docs/theory/effects/friction.md; positive systems: Collatz 1942. Test:
   test_friction_effect.c. */

typedef struct rubbing {
    const fw_effect_case *c;
    const fw_effects_envelope *e; /* whose motion is looked at */
    const fw_effects_friction *item;
    int count;
    double *gradient; /* (count x n) of the coordinate */
    double *mode;     /* (count x modes) shape . gradient */
    double *direct;   /* (count x count x 2) N: on i, per unit of torque j, without the ring */
    double *ring;     /* (modes x count x 2) N: on i, of inertia with q'' = 1 */
    double *gain;     /* (count x count) */
    double *torque;   /* (count) */
    double *lambda, *work, *modal_load;
} rubbing;

/* ---- coordinates ---- */

static fw_geometry_vec2 arm_of(const fw_mechanism *m, int body, fw_geometry_vec2 at) {
    if (body == FW_GROUND) return (fw_geometry_vec2){0, 0};
    return (fw_geometry_vec2){at.x - m->body[body].x_m, at.y - m->body[body].y_m};
}

/* ds/dq of s = u . (p_b - p_a), u turning with body a */
static void travel(const fw_mechanism *m, const fw_device_joint *t, double *out) {
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    double turned = t->axis_rad + (t->body_a == FW_GROUND ? 0 : m->body[t->body_a].phi_rad);
    double ux = cos(turned), uy = sin(turned);
    fw_geometry_vec2 ra = arm_of(m, t->body_a, a), rb = arm_of(m, t->body_b, b);
    if (t->body_b != FW_GROUND) {
        double *at = out + 3 * t->body_b;
        at[0] += ux, at[1] += uy, at[2] += rb.x * uy - rb.y * ux;
    }
    if (t->body_a != FW_GROUND) {
        double *at = out + 3 * t->body_a;
        at[0] -= ux, at[1] -= uy;
        at[2] += -(ra.x * uy - ra.y * ux) + ux * (b.y - a.y) - uy * (b.x - a.x);
    }
}

static void gradients(rubbing *r) {
    const fw_mechanism *m = r->c->mechanism;
    size_t n = (size_t)r->e->n, modes = (size_t)r->e->modes;
    for (int i = 0; i < r->count; i++) {
        const fw_effects_friction *f = &r->item[i];
        double *out = r->gradient + (size_t)i * n;
        if (f->pin == FW_NONE) {
            travel(m, &m->joint[f->joint], out);
        } else {
            const fw_mechanism_pin *p = &m->pin[f->pin];
            if (p->body_a != FW_GROUND) out[3 * p->body_a + 2] -= 1;
            if (p->body_b != FW_GROUND) out[3 * p->body_b + 2] += 1;
        }
        for (size_t l = 0; l < modes; l++)
            for (size_t k = 0; k < n; k++)
                r->mode[(size_t)i * modes + l] += r->e->shape[l * n + k] * out[k];
    }
}

/* ---- forces ---- */

/* what presses every joint under r->modal_load at rest: (count x 2) N */
static void presses(rubbing *r, double *out) {
    const fw_effects_modal *o = r->e->modal;
    const fw_effects_linear *s = &o->linear;
    double unit = s->stiffness_N_per_m * s->length_m;
    fw_effects_modal_multipliers(o, r->modal_load, r->work, r->lambda);
    for (int i = 0; i < r->count; i++) {
        const fw_effects_friction *f = &r->item[i];
        int row = f->pin == FW_NONE ? s->joint_row[f->joint] : s->pin_row[f->pin];
        if (row == FW_NONE) continue;
        out[2 * i] = unit * r->lambda[row];
        out[2 * i + 1] = f->pin == FW_NONE ? 0 : unit * r->lambda[row + 1];
    }
}

static void responses(rubbing *r) {
    const fw_mechanism *m = r->c->mechanism;
    size_t n = (size_t)r->e->n, modes = (size_t)r->e->modes, count = (size_t)r->count;
    for (size_t l = 0; l < modes; l++) {
        for (size_t k = 0; k < n; k++) {
            const fw_mechanism_mass *b = &m->body[k / 3];
            r->modal_load[k] =
                (k % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * r->e->shape[l * n + k];
        }
        presses(r, r->ring + 2 * l * count);
    }
    for (size_t j = 0; j < count; j++) {
        double *out = r->direct + 2 * j * count;
        memcpy(r->modal_load, r->gradient + j * n, n * sizeof *r->modal_load);
        presses(r, out);
        for (size_t l = 0; l < modes; l++)
            for (size_t k = 0; k < 2 * count; k++)
                out[k] -= r->ring[2 * l * count + k] * r->mode[j * modes + l];
    }
}

/* of the ring that torque j can make: w^2 q + c q' of mode l */
static double rings(const rubbing *r, size_t j, size_t l) {
    const fw_effects_envelope *e = r->e;
    size_t modes = (size_t)e->modes;
    const double *mode = r->mode + j * modes;
    double sum = e->omega[l] * e->omega[l] * e->response_bound[l] * fabs(mode[l]);
    for (size_t k = 0; k < modes; k++)
        sum +=
            fabs(e->modal->damping[l * modes + k] * mode[k]) * e->omega[k] * e->response_bound[k];
    return sum;
}

static double gain_of(const rubbing *r, size_t i, size_t j) {
    const fw_effects_envelope *e = r->e;
    size_t modes = (size_t)e->modes, count = (size_t)r->count, pins = (size_t)e->npin;
    const fw_effects_friction *f = &r->item[i];
    bool gives = f->pin != FW_NONE && e->modal->linear.pin_row[f->pin] == FW_NONE;
    double sum = 0;
    if (!gives) sum += hypot(r->direct[2 * (j * count + i)], r->direct[2 * (j * count + i) + 1]);
    for (size_t l = 0; l < modes; l++) {
        const double *ring = r->ring + 2 * (l * count + i);
        if (!gives) {
            sum += hypot(ring[0], ring[1]) * rings(r, j, l);
        } else {
            const double *pull = e->modal->pull + 2 * (l * pins + (size_t)f->pin);
            sum += hypot(pull[0], pull[1]) * e->response_bound[l] * fabs(r->mode[j * modes + l]);
        }
    }
    return sum * e->margin;
}

/* ---- torques ---- */

static double limit_of(const fw_effects_friction *f) {
    return fmax(f->static_coefficient, f->kinetic_coefficient) * f->radius_m;
}

/* false: what presses may grow with the friction without end */
static fw_status torques(rubbing *r, bool *known) {
    int count = r->count;
    int *pivot;
    FW_NEED(pivot = fw_arena_array(r->c->arena, int, (size_t)count));
    *known = true;
    for (int i = 0; i < count; i++) {
        const fw_effects_friction *f = &r->item[i];
        double force = f->pin == FW_NONE ? r->e->across[f->joint] : r->e->force[f->pin];
        r->torque[i] = limit_of(f) * (f->preload_N + force);
        for (int j = 0; j < count; j++) {
            double *k = &r->gain[i * count + j];
            *k = (i == j) - limit_of(f) * gain_of(r, (size_t)i, (size_t)j);
            *known = *known && isfinite(*k);
        }
        *known = *known && isfinite(r->torque[i]);
    }
    *known = *known && fw_maths_lu_factor(count, r->gain, pivot);
    if (*known) fw_maths_lu_solve(count, r->gain, pivot, NULL, r->torque);
    for (int i = 0; i < count; i++)
        *known = *known && r->torque[i] >= 0;
    return FW_OK;
}

static fw_status room(rubbing *r) {
    fw_arena *arena = r->c->arena;
    size_t n = (size_t)r->e->n, modes = (size_t)r->e->modes, count = (size_t)r->count;
    double **of[] = {&r->gradient, &r->mode,   &r->direct, &r->ring,      &r->gain,
                     &r->torque,   &r->lambda, &r->work,   &r->modal_load};
    const size_t size[] = {count * n,
                           count * modes,
                           2 * count * count,
                           2 * modes * count,
                           count * count,
                           count,
                           (size_t)r->e->modal->linear.rows,
                           2 * n,
                           n};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(arena, double, size[i]));
    return FW_OK;
}

/* One mode under constant loads: friction takes energy from its swing about the equilibrium, so
   that no extreme goes farther than without, and the farthest comes with the first swing, or the
   second of a motion that starts with a velocity or away from its springs' rest: at most one arch
   of the response, or two. */
static double first_swings(const fw_effect_case *c, const fw_effects_envelope *e) {
    const fw_effects_modal *o = e->modal;
    const fw_effects_loads *t = o->loads;
    if (e->modes != 1 || t->ntimed > 0 || o->shift[0] || o->shift[1]) return (double)INFINITY;
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].laws > 0) return (double)INFINITY;
    bool rest = o->velocity[0] == 0;
    for (int i = 0; i < e->npin; i++)
        rest = rest && fw_effects_pin_deflection(c->mechanism, i) == 0;
    return (rest ? 2 : 4) / (e->omega[0] * e->omega[0]);
}

/* bound in the motion of one envelope, over the floor of the other */
static fw_status in_motion(const fw_effect_case *c, const fw_effects_envelope *e,
                           const fw_effects_loads *rubs, double *value) {
    fw_effects_envelope narrowed = *e;
    const fw_effect_case one = {c->arena, c->mechanism, c->scene, &narrowed, c->diags, NULL};
    rubbing r = {.c = &one, .e = &narrowed, .item = rubs->friction, .count = rubs->nfriction};
    size_t modes = (size_t)e->modes;
    double *force, *passed;
    bool known;
    narrowed.floor = c->envelope->floor;
    FW_NEED(narrowed.response_bound = fw_arena_array(c->arena, double, modes));
    for (size_t l = 0; l < modes; l++)
        narrowed.response_bound[l] = fmin(e->response_bound[l], first_swings(c, e));
    FW_TRY(room(&r));
    FW_NEED(force = fw_arena_array(c->arena, double, modes));
    FW_NEED(passed = fw_arena_array(c->arena, double, modes));
    gradients(&r);
    responses(&r);
    FW_TRY(torques(&r, &known));
    *value = (double)INFINITY;
    if (!known) return FW_OK;
    for (size_t l = 0; l < modes; l++)
        for (size_t j = 0; j < (size_t)r.count; j++)
            force[l] += fabs(r.mode[j * modes + l]) * r.torque[j];
    for (size_t l = 0; l < modes; l++) { /* dampers pass motion on */
        passed[l] = force[l];
        for (size_t k = 0; k < modes; k++)
            if (k != l)
                passed[l] += fabs(e->modal->damping[l * modes + k]) * e->omega[k] *
                             e->response_bound[k] * force[k];
    }
    *value = fw_effects_envelope_mode_answer(&one, passed, (double)INFINITY);
    return FW_OK;
}

static fw_status friction_bound(const fw_effect_case *c, const fw_effects_loads *rubs,
                                double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    double most, pinned = 0;
    *value = (double)INFINITY;
    *reason = "kept: dry friction has no bound where pins for hinges have no linear theory";
    if (e->pinned && !e->pinned->valid) return FW_OK;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_TRY(in_motion(c, e, rubs, &most));
    if (e->pinned) FW_TRY(in_motion(c, e->pinned, rubs, &pinned));
    fw_arena_rewind(c->arena, mark);
    most = fmax(most, pinned);
    *reason = "kept: dry friction may change the motion by more than a third, or grow with what it "
              "presses itself";
    if (!(most <= 1.0 / 3)) return FW_OK;
    *value = most;
    *reason = "bound: answer to the largest torques that the joint forces allow, of any course";
    return FW_OK;
}

/* ---- the effect ---- */

/* Coulomb friction of joints. What is added here is what the scene states; the forces come with the
   joints' own, in multibody/multibody_friction.c and multibody_flags.c.

     at rest   |Q| <= mu_s N r      slides   Q = -mu_k N r sign(rate)      r = 1 of a slide

   N = preload + the force of the joint, or of the <contact> of the hinge. Theory:
   docs/theory/effects/friction.md. Test: test_friction_effect.c, test_friction.c. */

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
                         "friction of %s%s needs the radius of the sliding surface, and the "
                         "joint has no conjugate surfaces that define one; give radius on "
                         "<friction>",
                         FW_NAMED("joint", fw_text_name(id)));
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

/* What it changes at most: friction.c. Contacts press with forces of their own, which no
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
    if (status == FW_OK) FW_TRY(friction_bound(c, &rubs, value, reason));
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
