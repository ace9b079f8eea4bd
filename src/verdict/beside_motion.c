/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What no motion has: fingers that bend, by the motion that was found.

   Where no envelope is valid, as where a contact takes hold, nothing bounds beforehand how far a rotor comes aside. Behind the run
   it is known: y = (largest over rows + what its rate may add up to the next row)/(1 - e), e what flexures, their model and bodies
   may be off by. What the motion lacks then is a force f aside, its couple and one along (fw_effects_fingers_lack), and

     du = max over both K of sum over modes |s| |s . f| (1 + turns)/(K (1 - e)),   f = f(y + du aside)

   what it does: K of all modes at rest, and about the equilibrium of the loads, both without contacts and stops, which only
   stiffen. `turns` is the variation of V^2; a row of equilibria has 0 in its place. It is found from below until nothing
   changes, while du is at most half of y. Its share is the largest of: turns of hinges and what goes across strips, over the
   largest deflection; places of bodies, over their ways; probes that are asked for, over how far they go. Up to 2.9 % it is in
   every band.
   In: v->motion with its rows, SI. Out: the ledger and errors of peaks of a copy. Range: no tendons, cables or drivers, all
   modes known and stable. Probes: lengths between points, angles, forces of contacts, which are of what is left of these ways
   (near_a_fold.c); no other that is required. Error: y between rows and K away from both poses are tested, not proved; so is that
   blows of a contact do no more than V^2 does. Cost: twice the modes. Theory: docs/theory/effects/finger-bending.md.
   Test: test_effects.py, FingersThatPress */
#include "effects/envelope.h"
#include "probe/probe.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

typedef struct fingers {
    fw_arena *arena;
    const fw_mechanism *m;
    const fw_device_scene *s;
    const fw_dynamics_motion *x;
    const fw_statics_modes *about[2];
    fw_effects_comb_stood *stood; /* (ncomb) */
    double off;                   /* of flexures and bodies beyond what modes say themselves */
    double *force;                /* (n) f */
    double *far, *turn, *open; /* (n), (npin), (npin): du, what pins turn and ends part the more */
    double across;             /* the largest of strips, as a turn that bends as much: 6 d/L */
} fingers;

/* the scene without what touches; the mechanism without its stops */
static fw_status untouched(const fingers *w, fw_mechanism *m, fw_device_scene *s) {
    const size_t n = (size_t)w->m->npin;
    *m = *w->m, *s = *w->s;
    s->ncontact = 0;
    FW_NEED(m->pin = fw_arena_grow(w->arena, m->pin, n, n, sizeof *m->pin));
    for (size_t i = 0; i < n; i++)
        m->pin[i].stop_stiffness_Nm_per_rad = 0;
    return FW_OK;
}

/* *stands false: not all modes are known, or one is not held; e of the worst */
static fw_status find_modes(fingers *w, const fw_dynamics_motion_options *o, double *e,
                            bool *stands) {
    fw_mechanism m;
    fw_device_scene s;
    FW_TRY(untouched(w, &m, &s));
    *stands = true;
    for (int k = 0; k < 2 && *stands; k++) {
        fw_statics_mode_options with = {.effects = o->effects, .at_equilibrium = k == 1};
        fw_diags own = fw_diags_new(w->arena);
        with.effects.hinge = w->x->ledger.hinge.used;
        with.effects.like = NULL, with.effects.untold = true;
        const fw_status status =
            fw_statics_small_motions(w->arena, &m, &s, &with, &own, &w->about[k]);
        if (status == FW_NOMEM || status == FW_CANCELLED) return status;
        *stands = status == FW_OK && w->about[k]->count == w->about[k]->dof;
        for (int j = 0; *stands && j < w->about[k]->count; j++) {
            const fw_statics_mode *mode = &w->about[k]->mode[j];
            *e = fmax(*e, mode->stiffness_error + w->off);
            *stands = mode->stiffness_per_s2 > 0 && mode->stiffness_error + w->off < 0.5;
        }
    }
    return FW_OK;
}

/* the next element that is a drive's behind `from`; drives with a voltage have theirs in order */
static const fw_effects_force_element *next_drive(const fw_effects_loads *t, int *from) {
    while (*from < t->nelement)
        if (fw_effects_comb_of(&t->element[(*from)++])) return &t->element[*from - 1];
    return NULL;
}

static void stood_at(const fingers *w, const fw_effects_force_element *e, double by,
                     fw_effects_comb_stood *to) {
    const fw_dynamics_motion *x = w->x;
    const size_t n = 3 * (size_t)w->m->nbody;
    double most[3] = {0}, p[6], v[6];
    for (int row = 0; row < x->nsample; row++) {
        const double ahead = row + 1 < x->nsample ? x->t_s[row + 1] - x->t_s[row] : 0,
                     behind = row > 0 ? x->t_s[row] - x->t_s[row - 1] : 0;
        double place[3], rate[3];
        fw_effects_element_place_ports(e, x->q + (size_t)row * n, x->v + (size_t)row * n, p, v);
        fw_effects_comb_place(e, p, place);
        fw_effects_comb_rate(e, p, v, rate);
        for (int i = 0; i < 3; i++)
            most[i] = fmax(most[i], fabs(place[i]) + 0.5 * fmax(ahead, behind) * fabs(rate[i]));
    }
    *to = (fw_effects_comb_stood){
        .along_m = by * most[0], .aside_m = by * most[1], .tilt_rad = by * most[2]};
}

/* += how much farther a drive stands: across its direction e a body that turns by t about its centre goes by |r . e| t */
static void add_goes(const fingers *w, const fw_device_comb *c, fw_effects_comb_stood *to) {
    const fw_geometry_vec2 at = fw_mechanism_local_place(w->m, c->body_b, c->bx_m, c->by_m);
    const double turned = c->body_a == FW_GROUND ? 0 : w->m->body[c->body_a].phi_rad,
                 ex = cos(c->direction_rad + turned), ey = sin(c->direction_rad + turned);
    for (int k = 0; k < 2; k++) {
        const int body = k ? c->body_b : c->body_a;
        if (body == FW_GROUND) continue;
        const double *u = w->far + 3 * body, rx = at.x - w->m->body[body].x_m,
                     ry = at.y - w->m->body[body].y_m;
        to->aside_m += fabs(ey) * u[0] + fabs(ex) * u[1] + fabs(rx * ex + ry * ey) * u[2];
        to->along_m += hypot(u[0], u[1]) + hypot(rx, ry) * u[2];
        to->tilt_rad += u[2];
    }
}

/* of a mode: what a pin turns by */
static double turn_of(const fw_mechanism_pin *pin, const double *shape) {
    return (pin->body_b == FW_GROUND ? 0 : shape[3 * pin->body_b + 2]) -
           (pin->body_a == FW_GROUND ? 0 : shape[3 * pin->body_a + 2]);
}

/* m: by how much its two ends part, which are in one place as drawn */
static double opens(const fw_mechanism *m, const fw_mechanism_pin *pin, const double *shape) {
    double part[2] = {0};
    for (int k = 0; k < 2; k++) {
        const int body = k ? pin->body_b : pin->body_a;
        if (body == FW_GROUND) continue;
        const fw_geometry_vec2 at =
            fw_mechanism_local_place(m, body, k ? pin->bx_m : pin->ax_m, k ? pin->by_m : pin->ay_m);
        const double *u = shape + 3 * body, sign = k ? 1 : -1;
        part[0] += sign * (u[0] - u[2] * (at.y - m->body[body].y_m));
        part[1] += sign * (u[1] + u[2] * (at.x - m->body[body].x_m));
    }
    return hypot(part[0], part[1]);
}

/* += du of the force in modes about one pose */
static void add_modes(const fingers *w, const fw_statics_modes *about, double times, double *far,
                      double *turn, double *open) {
    const int n = 3 * w->m->nbody;
    for (int j = 0; j < about->count; j++) {
        const fw_statics_mode *mode = &about->mode[j];
        const double stiff =
            mode->stiffness_per_s2 * mode->modal_mass_kg_m2 * (1 - mode->stiffness_error - w->off);
        double by = 0;
        for (int i = 0; i < n; i++)
            by += fabs(mode->shape[i]) * w->force[i] * times / stiff;
        for (int i = 0; i < n; i++)
            far[i] += by * fabs(mode->shape[i]);
        for (int i = 0; i < w->m->npin; i++) {
            turn[i] += by * fabs(turn_of(&w->m->pin[i], mode->shape));
            open[i] += by * opens(w->m, &w->m->pin[i], mode->shape);
        }
    }
}

/* Pins do not part: all of the force through the softest strip, as the envelope has it (fw_effects_envelope_displaced) */
static double across_strips(const fingers *w, double times) {
    double all = 0, softest = 0;
    for (int b = 0; b < w->m->nbody; b++)
        all += hypot(w->force[3 * b], w->force[3 * b + 1]);
    for (int h = 0; h < w->m->nhinge; h++) {
        const fw_mechanism_hinge *hinge = &w->m->hinge[h];
        const double k =
            hinge->scale * fmin(hinge->closed_form.kx_N_per_m, hinge->closed_form.ky_N_per_m);
        softest = fmax(softest, 6 / (k * hinge->input.length_m));
    }
    return times * all * softest / (1 - w->off);
}

/* du: of either pose the larger one of each; and what goes across strips */
static fw_status answer(fingers *w, double times) {
    const size_t n = 3 * (size_t)w->m->nbody, pins = (size_t)w->m->npin, all = n + 2 * pins;
    const fw_mark mark = fw_arena_mark(w->arena);
    memset(w->far, 0, all * sizeof *w->far);
    for (int k = 0; k < 2; k++) {
        double *now = fw_arena_array(w->arena, double, all);
        FW_NEED(now);
        add_modes(w, w->about[k], times, now, now + n, now + n + pins);
        for (size_t i = 0; i < all; i++)
            w->far[i] = fmax(w->far[i], now[i]);
    }
    fw_arena_rewind(w->arena, mark);
    w->across = w->x->ledger.hinge.used == FW_HINGE_REVOLUTE ? across_strips(w, times) : 0;
    for (int h = 0; h < w->m->nhinge; h++)
        w->across =
            fmax(w->across, 6 * w->open[w->m->hinge[h].pin] / w->m->hinge[h].input.length_m);
    return FW_OK;
}

/* f and du together, from below; false: nothing bounds it, or it is more than half of what it is of */
static fw_status draws_aside(fingers *w, bool *bounded) {
    double before = 0;
    *bounded = false;
    for (int tries = 0; tries < 60; tries++) {
        double turns = 0, most = 0;
        memset(w->force, 0, 3 * (size_t)w->m->nbody * sizeof *w->force);
        for (int i = 0; i < w->s->ncomb; i++) {
            const fw_device_comb *c = &w->s->comb[i];
            const double half = 0.5, arm = 0.5 * c->length_m;
            const fw_effects_comb_stood stood = w->stood[i];
            fw_effects_comb_stood at = stood;
            add_goes(w, c, &at);
            if (at.aside_m + arm * at.tilt_rad >
                (1 + half) * (stood.aside_m + arm * stood.tilt_rad))
                return FW_OK;
            if (!fw_effects_fingers_lack(w->arena, w->m, w->s, c, &at, w->force, &turns))
                return FW_OK;
        }
        const double times = w->x->loads->quasi_static ? 1 : 1 + turns;
        FW_TRY(answer(w, times));
        for (int i = 0; i < 3 * w->m->nbody; i++)
            most = fmax(most, w->far[i]);
        if ((*bounded = most <= before * (1 + 1e-6))) return FW_OK;
        before = most;
    }
    return FW_OK;
}

/* du over how far a probe goes at most; infinite: of its kind nothing is known */
static fw_status share_of_probe(const fingers *w, const fw_probe *p, double *share) {
    const fw_dynamics_motion *x = w->x;
    const size_t n = 3 * (size_t)w->m->nbody;
    const fw_device_probe *asked = p->asked;
    double *room, way = 0, more = 0;
    *share = (double)INFINITY;
    if (asked->row == FW_PROBE_IS_force && p->element &&
        strcmp(p->element->class_->effect, "contact") == 0)
        *share = 0; /* it is what is left of ways */
    if (*share == 0) return FW_OK;
    FW_NEED(room = fw_arena_array(w->arena, double, 3 * n));
    for (int row = 0; row < x->nsample; row++)
        way = fmax(way, fabs(fw_probe_at_row(p, x, row) - fw_probe_origin(p)));
    if (asked->row == FW_PROBE_IS_angle)
        for (int k = 0; k < 2; k++) {
            const fw_mechanism_pin *pin = asked->of ? &w->m->pin[asked->index] : NULL;
            const int body = pin ? (k ? pin->body_b : pin->body_a) : k ? asked->body : FW_GROUND;
            more += body == FW_GROUND ? 0 : w->far[3 * body + 2];
        }
    else
        for (int k = 0; k <= 4; k++) {
            const int row = (x->nsample - 1) * k / 4;
            more = fmax(more, fw_probe_beside(p, NULL, 0, x->t_s[row], x->q + (size_t)row * n,
                                              w->far, room));
        }
    *share = more / way;
    return FW_OK;
}

/* du over all that it may be seen in; NaN counts as infinite */
static fw_status share_of_motion(const fingers *w, int index, const fw_verdict_variant_verdict *v,
                                 double *share) {
    const int nb = w->m->nbody;
    double *far, bent = w->x->displaced, turned = 0;
    fw_probe *probe;
    FW_NEED(far = fw_arena_array(w->arena, double, 2 * (size_t)nb + (size_t)w->m->nhinge + 1));
    fw_verdict_farthest(w->m, w->x, far);
    for (int i = 0; i < w->m->npin; i++)
        bent = fmax(bent, fabs(w->x->peak[i].angle_rad)), turned = fmax(turned, w->turn[i]);
    *share = (turned + w->across) / bent;
    const double most = fw_verdict_most_of(far, nb);
    for (int b = 0; b < nb; b++)
        if (far[b] > FW_VERDICT_HARDLY_MOVES * most)
            *share = fmax(*share, hypot(w->far[3 * b], w->far[3 * b + 1]) / far[b]);
    FW_TRY(fw_probe_bind(w->arena, w->m, w->s, w->x->loads, &probe));
    for (int k = 0; k < v->nrequirement; k++) {
        const fw_verdict_requirement *r = &v->requirement[k];
        double own;
        if (r->scene_index != index || !r->measure) continue;
        FW_TRY(share_of_probe(w, &probe[w->m->device->requirement[r->asked].probe], &own));
        *share = isnan(own) ? (double)INFINITY : fmax(*share, own);
    }
    if (isnan(*share)) *share = (double)INFINITY;
    return FW_OK;
}

/* a copy of the motion whose ledger and errors have the share */
static fw_status with_share(const fingers *w, double share, const fw_dynamics_motion **motion) {
    fw_dynamics_motion *own = fw_arena_one(w->arena, fw_dynamics_motion);
    const size_t items = (size_t)w->x->ledger.count, pins = (size_t)w->x->npin;
    bool found;
    FW_NEED(own);
    *own = *w->x;
    FW_NEED(own->ledger.item =
                fw_arena_grow(w->arena, own->ledger.item, items, items, sizeof *own->ledger.item));
    FW_NEED(own->peak = fw_arena_grow(w->arena, own->peak, pins, pins, sizeof *own->peak));
    const fw_effect_entry *e = fw_effects_fingers_open(&own->ledger);
    const char *how;
    if (!e) return FW_OK;
    FW_TRY(fw_effects_fingers_words(w->arena, e, &how));
    FW_TRY(fw_effects_found_bound(w->arena, e->id, how, share, &own->ledger, &found));
    const double more = fw_dynamics_motion_left_out(own) - fw_dynamics_motion_left_out(w->x);
    for (size_t i = 0; i < pins && isfinite(more); i++)
        own->peak[i].error_rad = fmax(0, own->peak[i].error_rad + more);
    if (found) *motion = own;
    return FW_OK;
}

static bool out_of_range(const fw_mechanism *m, const fw_device_scene *s,
                         const fw_dynamics_motion *x) {
    bool out = m->ndriver > 0 || s->ntendon > 0 || x->ended || x->nsample < 2 || !x->loads;
    for (int i = 0; i < m->nspring; i++)
        out = out || m->spring[i].cable;
    return out;
}

/* the motion of the scene stays what it is where nothing is found */
static fw_status bound_fingers(fw_arena *arena, const fw_device_scene *s, int index,
                               const fw_dynamics_motion_options *options,
                               fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion **motion = &v->motion[index], *x = *motion;
    fingers w = {.arena = arena, .m = m, .s = s, .x = x};
    double e = 0, share;
    bool stands;
    if (!fw_effects_fingers_open(&x->ledger) || out_of_range(m, s, x)) return FW_OK;
    fw_dynamics_motion known = *x;
    known.ledger.undecided = NULL; /* that is asked here */
    w.off = fw_verdict_motion_model_error(m, &known) + fw_verdict_bending_moving(x);
    if (!(w.off < 0.5)) return FW_OK;
    FW_TRY(find_modes(&w, options, &e, &stands));
    if (!stands) return FW_OK;
    const size_t n = 3 * (size_t)m->nbody;
    FW_NEED(w.stood = fw_arena_array(arena, fw_effects_comb_stood, (size_t)s->ncomb));
    FW_NEED(w.force = fw_arena_array(arena, double, 2 * (n + (size_t)m->npin)));
    w.far = w.force + n, w.turn = w.far + n, w.open = w.turn + m->npin;
    fw_dynamics_motion_rows(x, 0, x->nsample);
    for (int i = 0, at = 0; i < s->ncomb; i++) {
        if (s->comb[i].voltage_V == 0) continue;
        const fw_effects_force_element *drive = next_drive(x->loads, &at);
        if (!drive) return FW_OK;
        stood_at(&w, drive, 1 / (1 - e), &w.stood[i]);
    }
    FW_TRY(draws_aside(&w, &stands));
    if (!stands) return FW_OK;
    FW_TRY(share_of_motion(&w, index, v, &share));
    return with_share(&w, share, motion);
}

fw_status fw_verdict_beside(fw_arena *arena, const fw_device_scene *scene, int index,
                            const fw_dynamics_motion_options *options,
                            fw_verdict_variant_verdict *v) {
    FW_TRY(bound_fingers(arena, scene, index, options, v));
    const char *undecided = v->motion[index]->ledger.undecided;
    if (!undecided) return FW_OK;
    return fw_verdict_scene_reason(
        v, scene, 607, FW_INCONCLUSIVE, FW_VERDICT_KEEP_MOST,
        fw_arena_printf(arena, "in %s%s %s", FW_NAMED("scene", scene->name), undecided));
}
