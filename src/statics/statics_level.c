/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One level up at one instant. At the pose q of the level used, under the loads of its time, forces and joint forces leave M a
   (a = sum of modes times forces along them: 0 in an equilibrium, the acceleration of the motion where it swings, less what goes
   with squared velocities). The next level is put into equilibrium under the same loads and the dead forces -M a:

     F_next(q', t) - M a + G'^T lambda' = 0,   Newton's method from q

   and q' - q, the angles and the joint forces are what the level changes. So it is exact where the loads are slow against the
   motion; where it swings it is what the hinges' law changes at that instant, not what their frequencies add up to over many
   periods. In: SI; out: SI. Error: round-off over the least stiffness. Cost: two models and 3 to 5 evaluations of 30 n^3, n = 3
   nbody. Source: d'Alembert's principle. Test: test_hinge_models.c. */
#include "statics/statics.h"
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

enum { FW_TRIES = 30, FW_HALVINGS = 6 };
static const double fw_farthest = 0.5; /* rad or scaled lengths: one step at most */

/* ---- the next level's equilibrium ---- */

/* part of the last step back, where the new level does not reach so far */
static bool step_back(fw_statics_equilibrium *w, double part) {
    for (int half = 0; half < FW_HALVINGS; half++) {
        part /= 2;
        for (int k = 0; k < w->model->nq; k++)
            w->y[k] -= part * w->step[k];
        if (fw_statics_equilibrium_evaluate(w) == FW_OK) return true;
    }
    return false;
}

/* Newton's steps fall by squares: of whole ones the next is some step^3/before^2, and need not be made where that is
   as small as the last */
static const double fw_settled = 1e-11;
static bool next_is_none(double step, double before, double part) {
    return part == 1 && isfinite(before) && step < 0.01 * before &&
           step * (step / before) * (step / before) < 0.1 * fw_settled;
}

static bool settle(fw_statics_equilibrium *w) {
    double before = (double)INFINITY, part = 0;
    for (int i = 0; i < FW_TRIES; i++) {
        if (fw_statics_equilibrium_evaluate(w) != FW_OK && !step_back(w, part)) return false;
        double most = fw_statics_equilibrium_newton(w, w->step);
        if (!isfinite(most)) return false;
        part = fmin(1, fw_farthest / fmax(most, 1e-300));
        for (int k = 0; k < w->model->nq; k++)
            w->y[k] += part * w->step[k];
        if (most <= fw_settled || next_is_none(most, before, part) ||
            (most > 0.5 * before && (most < 1e-9 || fw_statics_equilibrium_quiet(w))))
            return fw_statics_equilibrium_evaluate(w) == FW_OK;
        before = most;
    }
    return false;
}

static void place(const fw_statics_equilibrium *w, const double *q, double *y) {
    memset(y, 0, (size_t)w->model->ny * sizeof *y);
    for (int i = 0; i < w->model->nq; i++)
        y[i] = (q[i] - w->q0[i]) / (i % 3 == 2 ? 1 : w->model->scale.length_m);
}

static fw_status read_state(const fw_statics_equilibrium *w, fw_statics_level_state *out) {
    const fw_mechanism *m = w->mechanism;
    double *joint, *driver;
    FW_NEED(out->strain = fw_arena_array(w->arena, double, (size_t)m->nhinge));
    for (int i = 0; i < m->nhinge; i++)
        out->strain[i] = (double)NAN;
    FW_NEED(out->q = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    FW_NEED(out->angle_rad = fw_arena_array(w->arena, double, (size_t)m->npin));
    FW_NEED(out->reaction_N = fw_arena_array(w->arena, double, 2 * (size_t)m->npin));
    FW_NEED(joint = fw_arena_array(w->arena, double, 3 * (size_t)m->njoint));
    FW_NEED(driver = fw_arena_array(w->arena, double, (size_t)m->ndriver));
    fw_statics_equilibrium_pose(w, w->y, out->q, out->angle_rad);
    fw_statics_equilibrium_reactions(w, out->reaction_N, joint, driver);
    return FW_OK;
}

static double opening(const fw_mechanism_pin *pin, const double *q) {
    const fw_geometry_vec2 by = fw_mechanism_pin_opened(pin, q);
    return hypot(by.x, by.y);
}

/* below the first two, less than an atom, what nothing moves only has round-off, in which models do not differ */
static const double fw_still_rad = 1e-11, fw_still_m = 1e-14, fw_hardly_deflected = 1e-7;

/* Angles count against the largest deflection of any hinge, a displacement across a strip over its length counting as one: a
   stage on leaves hardly turns any. Places count against the largest way of any body, or of what a hinge turns, a
   length away from it: origins may be at pins. least: of both, in the rest of a motion */
static void compare(const fw_mechanism *m, const double *rest, const double least[2],
                    fw_statics_level_step *step) {
    double deflected = least[0], way = least[1], apart = 0;
    step->angle_rad = 0;
    for (int k = 0; k < m->nhinge; k++) {
        int pin = m->hinge[k].pin;
        double L = m->hinge[k].law.length_m;
        for (int up = 0; up < 2; up++) { /* pins may hold a mechanism that flexures let move */
            const fw_statics_level_state *s = up ? &step->up : &step->at;
            deflected = fmax(deflected, fabs(s->angle_rad[pin]));
            if (!(L > 0)) continue;
            deflected = fmax(deflected, opening(&m->pin[pin], s->q) / L);
            way = fmax(way, L * fabs(s->angle_rad[pin]));
        }
        step->angle_rad =
            fmax(step->angle_rad, fabs(step->up.angle_rad[pin] - step->at.angle_rad[pin]));
    }
    for (int b = 0; b < m->nbody; b++) {
        const double *a = step->at.q + 3 * b, *u = step->up.q + 3 * b;
        way = fmax(way, hypot(a[0] - rest[3 * b], a[1] - rest[3 * b + 1]));
        way = fmax(way, hypot(u[0] - rest[3 * b], u[1] - rest[3 * b + 1]));
        apart = fmax(apart, hypot(u[0] - a[0], u[1] - a[1]));
    }
    step->relative =
        fmax(deflected > 0 ? step->angle_rad / deflected : 0, way > 0 ? apart / way : 0);
    if (deflected < fw_still_rad && way < fw_still_m) step->relative = 0;
}

/* ---- what is known without it ---- */

static const fw_effect_entry *entry_of(const fw_effect_ledger *ledger, const char *id) {
    for (int i = 0; i < ledger->count; i++)
        if (strcmp(ledger->item[i].id, id) == 0) return &ledger->item[i];
    return NULL;
}

/* pins without a step: known is what they leave out where its bound let auto leave it out */
static bool pins_unknown(const fw_effect_ledger *ledger) {
    const fw_effect_entry *entry = entry_of(ledger, "nonlinear-hinge");
    return entry && entry->called_for && !isfinite(entry->bound);
}

/* after both are built: `low` evaluated at its pose, `high` under the same loads */
static fw_status climb(fw_statics_equilibrium *low, fw_statics_equilibrium *high,
                       const double least[2], fw_statics_level_step *step) {
    FW_TRY(read_state(low, &step->at));
    place(high, step->at.q, high->y);
    if (!settle(high)) {
        step->why_not = "no equilibrium was found at the next level";
        step->unknown = step->used != FW_HINGE_REVOLUTE || pins_unknown(&low->ledger);
        return FW_OK;
    }
    FW_TRY(read_state(high, &step->up));
    compare(low->mechanism, low->q0, least, step);
    return FW_OK;
}

/* ---- which level is next ---- */

static bool acts(const fw_effect_ledger *ledger, const char *id) {
    const fw_effect_entry *entry = entry_of(ledger, id);
    return entry && entry->active;
}

static fw_statics_level_step *begin(fw_arena *arena, const fw_mechanism *m,
                                    const fw_effect_ledger *ledger, double t_s) {
    fw_statics_level_step *s = fw_arena_one(arena, fw_statics_level_step);
    if (!s) return NULL;
    *s = (fw_statics_level_step){.used = ledger->hinge.used,
                                 .next = ledger->hinge.used,
                                 .t_s = t_s,
                                 .nbody = m->nbody,
                                 .npin = m->npin,
                                 .angle_rad = (double)NAN,
                                 .relative = (double)NAN};
    return s;
}

/* loads of the next level; step->why_not where there are none */
static fw_status next_loads(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                            const fw_effect_ledger *ledger, const fw_effects_loads *loads,
                            fw_effects_loads *up, fw_statics_level_step *step) {
    FW_TRY(fw_effects_hinges_up(arena, m, scene, loads, step->used, up, &step->next));
    up->nfriction = 0;
    /* what they do to a flexure that gives is not in the loads of a pin */
    bool warm = acts(ledger, "temperature") || acts(ledger, "residual-stress");
    if (3 * m->nbody > FW_LEVEL_MOST)
        step->why_not = "the mechanism is too large to be examined", step->unknown = true;
    else if (step->next == step->used)
        step->why_not = step->used == FW_HINGE_ELASTICA ? "exact beams are the highest level here"
                                                        : "no hinge has a law of its own";
    else if (step->used == FW_HINGE_REVOLUTE && warm)
        step->why_not = "temperature and residual stress act on hinges that give in another way",
        step->unknown = pins_unknown(ledger);
    return FW_OK;
}

/* ---- an instant of a motion ---- */

/* the row in which some hinge is deflected most: turned, or displaced by that share of its length; peaks of angles are between
   rows. Where heat or stress presses what is its own mirror image nothing is deflected: that of the largest force */
static int row_of_peak(const fw_mechanism *m, const fw_dynamics_motion *x) {
    double largest = -1, t = 0, across = -1, force = -1;
    int best = 0, moved = 0, pressed = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_dynamics_peak *p = &x->peak[m->hinge[k].pin];
        if (fabs(p->angle_rad) > largest) largest = fabs(p->angle_rad), t = p->t_s;
    }
    const bool presses = fw_effects_has_growth(x->loads) && largest < fw_hardly_deflected;
    if (presses) fw_dynamics_motion_rows(x, 0, x->nsample);
    for (size_t i = 0; i < (size_t)x->nsample; i++) {
        const double *q = x->q + 3 * i * (size_t)m->nbody,
                     *f = x->reaction_N + 2 * i * (size_t)m->npin;
        if (fabs(x->t_s[i] - t) < fabs(x->t_s[best] - t)) best = (int)i;
        for (int k = 0; k < m->nhinge && x->loads->nreleased > 0; k++) {
            const double L = m->hinge[k].law.length_m,
                         share = L > 0 ? opening(&m->pin[m->hinge[k].pin], q) / L : 0;
            if (share > across) across = share, moved = (int)i;
        }
        for (int k = 0; k < 2 * m->npin && presses; k++)
            if (fabs(f[k]) > force) force = fabs(f[k]), pressed = (int)i;
    }
    if (presses && across < fw_hardly_deflected) return pressed;
    return across > largest ? moved : best;
}

enum { FW_ON_THE_WAY = 2 };
typedef struct fw_statics_extent {
    double size[2]; /* largest deflection of a hinge, and way of a body */
    /* in which it has first come a quarter and half of its largest way, places and turns together */
    int row[FW_ON_THE_WAY];
} fw_statics_extent;

/* Of the whole motion: the instant that is looked at may be one where everything is near its rest. Where it snaps those rows
   are on the way over: a level that has not snapped is far from there, while both may agree beyond. Rows that wait are taken
   as they were integrated. */
static fw_status extent_of(fw_arena *arena, const fw_mechanism *m, const fw_dynamics_motion *x,
                           const double *rest, double length_m, fw_statics_extent *out) {
    double *q = fw_arena_array(arena, double, 3 * (size_t)m->nbody), *way, most = 0;
    *out = (fw_statics_extent){0};
    FW_NEED(q);
    FW_NEED(way = fw_arena_array(arena, double, (size_t)x->nsample));
    for (int k = 0; k < m->nhinge; k++)
        out->size[0] = fmax(out->size[0], fabs(x->peak[m->hinge[k].pin].angle_rad));
    for (int i = 0; i < x->nsample; i++) {
        fw_dynamics_motion_pose(x, i, q);
        for (int b = 0; b < m->nbody; b++) {
            const double far = hypot(q[3 * b] - rest[3 * b], q[3 * b + 1] - rest[3 * b + 1]),
                         turn = fabs(q[3 * b + 2] - rest[3 * b + 2]);
            out->size[1] = fmax(out->size[1], far);
            way[i] = fmax(way[i], far + length_m * turn);
        }
        most = fmax(most, way[i]);
    }
    for (int k = 0; k < FW_ON_THE_WAY; k++)
        while (out->row[k] + 1 < x->nsample && way[out->row[k]] < 0.25 * (k + 1) * most)
            out->row[k]++;
    return FW_OK;
}

static fw_status in_time(fw_statics_equilibrium *w, fw_arena *arena, const fw_mechanism *m,
                         const fw_device_scene *scene, const fw_effects_loads *loads,
                         fw_diags *diags) {
    *w = (fw_statics_equilibrium){.arena = arena, .mechanism = m, .scene = scene, .diags = diags};
    return fw_statics_equilibrium_in_time(w, loads);
}

static void at_time(fw_statics_equilibrium *w, double t_s) {
    fw_statics_equilibrium_at(w, t_s, t_s);
    w->system->loading.hold = (fw_multibody_hold){.on = true, .t_s = t_s};
}

/* the acceleration that `low` leaves goes to `high` as a constant one the other way */
static void hand_inertia(const fw_statics_equilibrium *low, fw_statics_equilibrium *high) {
    const fw_statics_reduced *r = &low->reduced;
    const fw_multibody_scale *a = &low->model->scale, *b = &high->model->scale;
    double time = b->time_s / a->time_s, size = time * time * a->length_m / b->length_m;
    for (int i = 0; i < r->n; i++) {
        double sum = 0;
        for (int k = 0; k < r->dof; k++)
            sum += low->gradient[k] * r->shape[(size_t)k * (size_t)r->n + (size_t)i];
        high->gravity[i] -= sum * (i % 3 == 2 ? time * time : size);
    }
}

/* both levels at a row; gravity: of `high` without inertia */
static fw_status climb_at(fw_statics_equilibrium *low, fw_statics_equilibrium *high,
                          const fw_dynamics_motion *x, int row, const double *gravity,
                          const double least[2], fw_statics_level_step *step) {
    double *q = fw_arena_array(low->arena, double, (size_t)low->model->nq);
    FW_NEED(q);
    fw_dynamics_motion_pose(x, row, q);
    at_time(low, x->t_s[row]);
    place(low, q, low->y);
    const fw_status status = fw_statics_equilibrium_evaluate(low);
    if (status == FW_SOLVER) {
        step->why_not = "the pose of the peak could not be evaluated", step->unknown = true;
        return FW_OK;
    }
    FW_TRY(status);
    memcpy(high->gravity, gravity, (size_t)high->model->nq * sizeof *gravity);
    if (!x->loads->quasi_static) hand_inertia(low, high);
    at_time(high, x->t_s[row]);
    return climb(low, high, least, step);
}

fw_status fw_statics_level_of_motion(fw_arena *arena, const fw_mechanism *m,
                                     const fw_device_scene *scene, const fw_dynamics_motion *x,
                                     const fw_statics_level_step **out) {
    fw_diags own = fw_diags_new(arena);
    fw_statics_equilibrium low, high;
    fw_effects_loads loads = *x->loads, up;
    *out = NULL;
    if (m->nhinge == 0 || x->nsample < 1) return FW_OK;
    int row = row_of_peak(m, x);
    fw_statics_extent extent;
    fw_statics_level_step *step = begin(arena, m, &x->ledger, x->t_s[row]);
    FW_NEED(step);
    *out = step;
    loads.nfriction = 0;
    FW_TRY(next_loads(arena, m, scene, &x->ledger, &loads, &up, step));
    if (step->why_not) return FW_OK;
    FW_TRY(in_time(&low, arena, m, scene, &loads, &own));
    FW_TRY(in_time(&high, arena, m, scene, &up, &own));
    low.ledger = x->ledger;
    double *gravity = fw_arena_array(arena, double, (size_t)high.model->nq);
    FW_NEED(gravity);
    memcpy(gravity, high.gravity, (size_t)high.model->nq * sizeof *gravity);
    FW_TRY(extent_of(arena, m, x, low.q0, low.model->scale.length_m, &extent));
    FW_TRY(climb_at(&low, &high, x, row, gravity, extent.size, step));
    if (step->why_not || step->next != FW_HINGE_ELASTICA) return FW_OK;
    bool found = false;
    for (int k = 0; k < FW_ON_THE_WAY; k++) {
        fw_statics_level_step there = *step;
        FW_TRY(climb_at(&low, &high, x, extent.row[k], gravity, extent.size, &there));
        if (there.why_not) continue; /* of one instant that is no sign: what falls has passed it */
        found = true;
        step->relative = fmax(step->relative, there.relative);
    }
    if (!found) step->relative = fmax(step->relative, 1);
    return FW_OK;
}

/* ---- what is put on at once, or nearly so ----
   Forces of joints that come at once ring along what flexures give, as long as nothing damps them: of that pins know
   nothing, and an instant of their motion has only what stands still of it. The ring is as large as the jump, and of a law
   that does not jump as large as the share r of how far it goes that fw_quantity_law_rings bounds for

     omega = sqrt(k/(n M)),   k: least stiffness of a flexure, M: mass of all n bodies,

   below which nothing rings along flexures: an opening of one joint carries at most all bodies, and n openings add up to at most
   sqrt(n) of each. With its energy U = r^2 F d / 2 (d: what the flexure gives by) the largest moment along a strip is at most that
   of a turn by sqrt(6 U/K): 3 is the most that its square is above the mean, of a moment that goes from -M to M; pulled along,
   the fibres bear less than that. In: SI; out: largest strain of what rings over the largest of what turns, 1; infinite
   where no equilibrium of flexures that give was found. Cost: as a step, twice for each instant at which a law jumps, and for
   each law. Source: Clapeyron; Duhamel's integral by parts. Test: judge.examples spring-let-go, arm-stated-pulse.

   What a driver moves hangs on it by its inertia: where nothing else acts, joints take along all bodies by the field v of least
   energy that goes with its speed (an impact from rest). Its acceleration a is the dead force -M v a on all of them, and rings as
   a load does (fw_quantity_law_shakes); where its speed jumps by u, flexures give, and what they swing with is the difference of
   both fields, by joints alone and by pins, too: U <= u^2 T(v_pins - v_joints), each at most all of it. One driver after the other;
   amplitudes add up. Test: judge.examples driven-*. */

enum { FW_JUMPS = 16 };

static int laws_of(const fw_device_scene *s) {
    return s->nforce + s->ntorque + s->nbase + s->ntendon;
}

static const fw_quantity_law *law_of(const fw_device_scene *s, int i) {
    if (i < s->nforce) return s->force[i].law;
    i -= s->nforce;
    if (i < s->ntorque) return s->torque[i].law;
    i -= s->ntorque;
    return i < s->nbase ? s->base[i].law : s->tendon[i - s->nbase].law;
}

static int jumps_of(const fw_device_scene *s, double *t_s) {
    int n = 1;
    t_s[0] = 0;
    for (int i = 0; i < laws_of(s); i++)
        n += fw_quantity_law_breaks_of(law_of(s, i), s->duration_s, t_s + n, FW_JUMPS - n);
    return n;
}

/* forces of the pins and what flexures give under them, world axes, (4 npin), with laws as they are on this side of t_s */
static fw_status forces_of(fw_statics_equilibrium *low, fw_statics_equilibrium *high,
                           const double *q, double t_s, double piece_s, double *out, bool *found) {
    const fw_mechanism *m = low->mechanism;
    fw_statics_level_state at, up;
    fw_statics_equilibrium_at(low, t_s, piece_s);
    low->system->loading.hold = (fw_multibody_hold){.on = true, .t_s = t_s};
    place(low, q, low->y);
    *found = fw_statics_equilibrium_evaluate(low) == FW_OK;
    if (!*found) return FW_OK;
    FW_TRY(read_state(low, &at));
    hand_inertia(low, high);
    fw_statics_equilibrium_at(high, t_s, piece_s);
    high->system->loading.hold = low->system->loading.hold;
    place(high, q, high->y);
    *found = settle(high);
    if (!*found) return FW_OK;
    FW_TRY(read_state(high, &up));
    for (int i = 0; i < m->npin; i++) {
        const fw_geometry_vec2 by = fw_mechanism_pin_opened(&m->pin[i], up.q);
        out[4 * i] = at.reaction_N[2 * i], out[4 * i + 1] = at.reaction_N[2 * i + 1];
        out[4 * i + 2] = by.x, out[4 * i + 3] = by.y;
    }
    return FW_OK;
}

static int row_at(const fw_dynamics_motion *x, double t_s) {
    int best = 0;
    fw_dynamics_motion_rows_at(x, t_s);
    for (int i = 1; i < x->nsample; i++)
        if (fabs(x->t_s[i] - t_s) < fabs(x->t_s[best] - t_s)) best = i;
    return best;
}

static double largest_ring(const fw_mechanism *m, const fw_dynamics_motion *x,
                           const double *ring_J) {
    double rings = 0, turns = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const int pin = m->hinge[k].pin;
        const double by = m->hinge[k].closed_form.strain_per_rad,
                     K = m->pin[pin].stiffness_Nm_per_rad;
        if (K > 0) rings = fmax(rings, by * sqrt(6 * ring_J[pin] / K));
        turns = fmax(turns, by * fabs(x->peak[pin].angle_rad));
    }
    return rings > 0 ? rings / turns : 0;
}

/* both levels of a motion of pins, and what their forces leave ringing so far */
typedef struct {
    fw_statics_equilibrium low, high;
    double *gravity, *f[2], *ring_J;
} fw_statics_ringing;

static fw_status side_at(fw_statics_ringing *r, const double *q, double t_s, double piece_s,
                         double *f, bool *found) {
    memcpy(r->high.gravity, r->gravity, (size_t)r->high.model->nq * sizeof *r->gravity);
    return forces_of(&r->low, &r->high, q, t_s, piece_s, f, found);
}

/* what lies between both sides rings by so much of it; amplitudes add up */
static void add_ring(fw_statics_ringing *r, double share) {
    for (int i = 0; i < r->low.mechanism->npin; i++) {
        const double *a = r->f[0] + 4 * i, *b = r->f[1] + 4 * i;
        const double U = 0.5 * fabs((b[0] - a[0]) * (b[2] - a[2]) + (b[1] - a[1]) * (b[3] - a[3]));
        const double all = sqrt(r->ring_J[i]) + share * sqrt(U);
        r->ring_J[i] = all * all;
    }
}

/* what the laws do where they jump; before the scene nothing acts */
static fw_status ring_of_jumps(fw_statics_ringing *r, const fw_device_scene *scene,
                               const fw_dynamics_motion *x, bool *found) {
    double t_s[FW_JUMPS];
    const int jumps = jumps_of(scene, t_s);
    for (int j = 0; j < jumps && j < FW_JUMPS && *found; j++) {
        const double *q = x->q + (size_t)row_at(x, t_s[j]) * (size_t)r->low.model->nq;
        for (int side = j > 0 ? 0 : 1; side < 2 && *found; side++)
            FW_TRY(side_at(r, q, t_s[j], side ? t_s[j] : t_s[j] * (1 - 1e-12), r->f[side], found));
        if (*found) add_ring(r, 1);
    }
    return FW_OK;
}

/* what they do where they do not */
static fw_status ring_of_laws(fw_statics_ringing *r, const fw_device_scene *scene,
                              const fw_dynamics_motion *x, bool *found) {
    const double omega = fw_statics_slowest_along(r->low.mechanism), none = 1e-4;
    for (int i = 0; i < laws_of(scene) && *found; i++) {
        double t_s;
        const double share =
            fw_quantity_law_rings(law_of(scene, i), scene->duration_s, omega, &t_s);
        if (share < none) continue;
        const double *q = x->q + (size_t)row_at(x, t_s) * (size_t)r->low.model->nq;
        FW_TRY(side_at(r, q, 0, 0, r->f[0], found));
        if (*found) FW_TRY(side_at(r, q, t_s, t_s, r->f[1], found));
        *found = *found && isfinite(share);
        if (*found) add_ring(r, share);
    }
    return FW_OK;
}

static fw_status ring_of_driver(fw_statics_ringing *r, int j, const fw_quantity_law_shaking *s,
                                const fw_dynamics_motion *x, bool *found) {
    const size_t nq = (size_t)r->low.model->nq;
    const double *q = x->q + (size_t)row_at(x, s->at_s) * nq, t_s = s->at_s;
    double *pins = fw_arena_array(r->low.arena, double, 2 * nq), blow = 0;
    FW_NEED(pins);
    double *joints = pins + nq;
    place(&r->low, q, r->low.y), place(&r->high, q, r->high.y);
    FW_TRY(fw_statics_taken_along(&r->low, j, pins, found));
    if (*found) FW_TRY(fw_statics_taken_along(&r->high, j, joints, found));
    if (*found) FW_TRY(side_at(r, q, t_s, t_s, r->f[0], found));
    if (!*found) return FW_OK;
    for (size_t i = 0; i < nq; i++)
        blow += 0.5 * pow(pins[i] - joints[i], 2) * fw_statics_mass_of(r->low.mechanism, (int)i);
    for (int i = 0; i < r->low.mechanism->npin; i++)
        r->ring_J[i] = pow(sqrt(r->ring_J[i]) + s->blows * sqrt(blow), 2);
    fw_statics_push(&r->low, s->most, pins, r->low.gravity);
    fw_statics_push(&r->high, s->most, pins, r->gravity);
    FW_TRY(side_at(r, q, t_s, t_s, r->f[1], found));
    fw_statics_push(&r->low, -s->most, pins, r->low.gravity);
    fw_statics_push(&r->high, -s->most, pins, r->gravity);
    if (*found) add_ring(r, s->rings);
    return FW_OK;
}

static fw_status ring_of_drivers(fw_statics_ringing *r, const fw_device_scene *scene,
                                 const fw_dynamics_motion *x, bool *found) {
    const fw_mechanism *m = r->low.mechanism;
    const double omega = fw_statics_slowest_along(m);
    for (int j = 0; j < m->ndriver && *found; j++) {
        const fw_quantity_law_shaking s =
            fw_quantity_law_shakes(&m->driver[j].law, scene->duration_s, omega);
        *found = isfinite(s.most) && isfinite(s.rings) && isfinite(s.blows);
        if (*found && (s.rings > 0 || s.blows > 0)) FW_TRY(ring_of_driver(r, j, &s, x, found));
    }
    return FW_OK;
}

fw_status fw_statics_level_rings(fw_arena *arena, const fw_mechanism *m,
                                 const fw_device_scene *scene, const fw_dynamics_motion *x,
                                 double *share) {
    fw_diags own = fw_diags_new(arena);
    fw_effects_loads loads = *x->loads, up;
    fw_statics_ringing r = {0};
    bool found = true;
    *share = 0;
    if (!scene || m->nhinge == 0 || x->nsample < 1 || x->loads->quasi_static) return FW_OK;
    fw_statics_level_step *step = begin(arena, m, &x->ledger, 0);
    FW_NEED(step);
    loads.nfriction = 0;
    FW_TRY(next_loads(arena, m, scene, &x->ledger, &loads, &up, step));
    if (step->why_not) return FW_OK; /* which the step of the peak says */
    FW_TRY(in_time(&r.low, arena, m, scene, &loads, &own));
    FW_TRY(in_time(&r.high, arena, m, scene, &up, &own));
    r.low.ledger = x->ledger;
    const size_t n = 4 * (size_t)m->npin, nq = (size_t)r.high.model->nq;
    FW_NEED(r.f[0] = fw_arena_array(arena, double, n));
    FW_NEED(r.f[1] = fw_arena_array(arena, double, n));
    FW_NEED(r.ring_J = fw_arena_array(arena, double, (size_t)m->npin));
    FW_NEED(r.gravity = fw_arena_array(arena, double, nq));
    memcpy(r.gravity, r.high.gravity, nq * sizeof *r.gravity);
    FW_TRY(ring_of_jumps(&r, scene, x, &found));
    if (found) FW_TRY(ring_of_laws(&r, scene, x, &found));
    if (found) FW_TRY(ring_of_drivers(&r, scene, x, &found));
    *share = found ? largest_ring(m, x, r.ring_J) : (double)INFINITY;
    return FW_OK;
}

/* ---- an equilibrium ---- */

/* `high` as it is at s = 1 of what `w` was made from */
static fw_status next_rest(fw_statics_equilibrium *w, fw_statics_level_step *step,
                           fw_statics_equilibrium *high) {
    fw_effects_loads up;
    FW_TRY(next_loads(w->arena, w->plain, w->scene, &w->ledger, w->loads, &up, step));
    if (step->why_not) return FW_OK;
    return fw_statics_equilibrium_again(w, &up, high);
}

fw_status fw_statics_level_of_equilibrium(fw_statics_equilibrium *w,
                                          const fw_statics_level_step **out) {
    fw_statics_equilibrium high;
    *out = NULL;
    if (!w->loads || w->mechanism->nhinge == 0) return FW_OK;
    fw_statics_level_step *step = begin(w->arena, w->mechanism, &w->ledger, (double)NAN);
    FW_NEED(step);
    *out = step;
    FW_TRY(next_rest(w, step, &high));
    return step->why_not ? FW_OK : climb(w, &high, (const double[2]){0}, step);
}

fw_status fw_statics_level_of_modes(fw_statics_equilibrium *w, fw_statics_level_small *out) {
    fw_statics_equilibrium high;
    *out = (fw_statics_level_small){.relative = (double)NAN};
    if (!w->loads || w->mechanism->nhinge == 0) return FW_OK;
    fw_statics_level_step *step = begin(w->arena, w->mechanism, &w->ledger, (double)NAN);
    FW_NEED(step);
    FW_TRY(next_rest(w, step, &high));
    if (step->why_not) return FW_OK;
    double *q;
    FW_NEED(q = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    fw_statics_equilibrium_pose(w, w->y, q, NULL);
    place(&high, q, high.y);
    bool rests = w->factor == 0; /* about the assembled pose it is held as it is */
    if (rests ? fw_statics_equilibrium_evaluate(&high) != FW_OK : !settle(&high)) return FW_OK;
    const fw_statics_reduced *a = &w->reduced, *b = &high.reduced;
    double worst = 0;
    /* those that the mechanism has with pins: what hinges add is far above. A stage that pins would hold has none */
    int own = b->dof - 2 * high.model->nreleased;
    if (own != a->dof - 2 * w->model->nreleased || own < 1) own = a->dof == b->dof ? a->dof : 0;
    if (own == 0) return FW_OK;
    const int both = a->dof == b->dof ? a->dof : own;
    double *change;
    FW_NEED(change = fw_arena_array(w->arena, double, (size_t)a->dof));
    for (int k = 0; k < a->dof; k++) {
        double x = a->value[k] * fw_statics_equilibrium_per_s2(w),
               y = k < both ? b->value[k] * fw_statics_equilibrium_per_s2(&high) : 0;
        change[k] = x > 0 && y > 0 ? fabs(sqrt(y / x) - 1) : (double)NAN;
        if (k < own && isnan(change[k])) return FW_OK;
        if (k < own) worst = fmax(worst, change[k]);
    }
    out->relative = worst, out->each = change;
    return step->next == FW_HINGE_ELASTICA ? fw_statics_tangents_apart(w, &high, out) : FW_OK;
}
