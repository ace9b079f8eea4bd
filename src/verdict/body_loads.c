/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies are rigid in the motion, and what they give between their hinges is in every band (verdict_bending.c). Here is what
   they give beside these: where loads, contacts and cables act, where a stiffness is probed, and what hangs over. Ways are
   those of body_arms.c. Theory: docs/theory/verdict.md. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/law_kind.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

double fw_verdict_load_N(const fw_mechanism_load_end *end, int n, int at, const double *rest_N) {
    double known = 0;
    if (isfinite(end[at].known_N)) return fmax(end[at].known_N, rest_N[end[at].body]);
    for (int k = 0; k < n; k++)
        if (end[k].scene == end[at].scene && end[k].body == end[at].body &&
            isfinite(end[k].known_N))
            known += end[k].known_N;
    return known + rest_N[end[at].body];
}

double fw_verdict_arm_goes(const fw_verdict_arm *arm) {
    const double *g = arm->give;
    return 0.5 * (g[3] + g[5]) + hypot(0.5 * (g[3] - g[5]), g[4]);
}

/* ---- how a known force bends its own place ----
   C, what the place gives by the way to the body's middle, is at least what the body does give, C - C' >= 0 as a form. So of a
   force F the part along n of how far the place goes lies between

     (n.C F - r)/2 and (n.C F + r)/2,   r^2 = (n.C n)(F.C F),

   which is 0 to n.C F where the way gives in one direction alone, or F acts along n. Its law comes over modes of what hangs over,
   which ring by |q - f| of it besides (fw_quantity_law_responds), added as if in step: by as much of r. A body that turns by theta
   turns n and F against C: 2 theta of the most. In: SI, forces of the scene on the very place that is asked. Range: other places
   and loads as fw_verdict_bends_in_plane has them. Test: test_out_of_plane.py, test_a_known_force_bends_its_own_place */

bool fw_verdict_bends_own(const fw_mechanism_load_end *end, int scene, const fw_device_probe *p) {
    const double same_m = 1e-9;
    return end->scene == scene && end->force && end->body == p->body &&
           fabs(end->x_m - p->x_m) < same_m && fabs(end->y_m - p->y_m) < same_m;
}

static double turned_most(const fw_mechanism *m, const fw_dynamics_motion *x, int body) {
    double most = 0;
    fw_dynamics_motion_rows(x, 0, x->nsample);
    for (int r = 1; r < x->nsample; r++)
        most = fmax(most, fabs(x->q[(3 * r * m->nbody) + 3 * body + 2] - x->q[3 * body + 2]));
    return most;
}

fw_status fw_verdict_bends_asked(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                 const fw_verdict_hung *hung, const fw_device_probe *p,
                                 double *down, double *up, double *rings_m) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *x = v->motion[scene];
    const fw_verdict_bending *b = &((const fw_verdict_strain_monitor *)x->observed)->bending;
    const double slow_s = hung ? sqrt(hung[p->body].in_plane_mode_s2) : 0, fast = 30,
                 end_s = m->device->scene[scene].duration_s;
    fw_mechanism_load_end *end;
    int n;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    *down = *up = *rings_m = 0;
    for (int k = 0; k < n; k++) {
        const fw_verdict_arm *arm = &b->arm[2 * m->nhinge + k];
        if (!fw_verdict_bends_own(&end[k], scene, p) || !arm->known) continue;
        const fw_device_force *f = end[k].force;
        const double
            *g = arm->give,
            nx = cos(p->direction_rad), ny = sin(p->direction_rad), fx = f->fx_N, fy = f->fy_N,
            unit = 1 / b->stiff_N,
            along = unit * (nx * (g[3] * fx + g[4] * fy) + ny * (g[4] * fx + g[5] * fy)),
            own = unit * (nx * (g[3] * nx + g[4] * ny) + ny * (g[4] * nx + g[5] * ny)),
            work = unit * (fx * (g[3] * fx + g[4] * fy) + fy * (g[4] * fx + g[5] * fy)),
            size = sqrt(fmax(own * work, 0)),
            turn = 2 * turned_most(m, x, p->body) * unit * fw_verdict_arm_goes(arm) * hypot(fx, fy),
            low = 0.5 * (along - size) - turn, high = 0.5 * (along + size) + turn,
            most = fw_quantity_law_largest(f->law, end_s),
            least = !f->law || fw_quantity_law_never_negative(f->law) ? 0 : -most,
            rings = slow_s > 0
                        ? fw_quantity_law_responds(f->law, end_s, 1 / slow_s, fast / slow_s).behind
                        : most;
        *up += fmax(most * high, least * low), *down += fmax(-most * low, -least * high);
        *rings_m += rings * size;
    }
    return FW_OK;
}

/* ---- what bodies give in series with what presses on them ----
   A contact or spring of stiffness k, or a cable that is drawn, acts on a place that gives c for its force (the way from there to the
   body's middle, body_arms.c; of all its bodies together, a cable's turns counted twice). With c in series

     it presses by at least 1/(1 + c k) of what it does on rigid bodies,
     what it holds up goes farther by at most c k of its way, and by at most U_c/U_h, U_c = F^2 c/2 (Castigliano)

   which is what counts beside what bodies give between their hinges. In: forces of the rigid motion, without damping.
   Range: to first order. Cost: none where c k < 1/500. Test: test_effects.py SlenderArms */
enum { PORTS_SEEN = 16 };
static const double hardly_gives = 0.002; /* c k */

/* What the motion has of a place (effects/body_compliance.c) is in it; what that may be off by is left */
static double left_of(const fw_mechanism_give *g) {
    const double *c = g->c;
    return g->off * (0.5 * (c[4] + c[8]) + hypot(0.5 * (c[4] - c[8]), c[5]));
}

fw_status fw_verdict_places_new(fw_arena *arena, const fw_mechanism *m, int scene,
                                fw_verdict_bending *b) {
    fw_mechanism_load_end *end;
    int n;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    FW_NEED(b->place = fw_arena_array(arena, fw_verdict_place, (size_t)n));
    FW_NEED(b->last = fw_arena_array(arena, double, 12 * (size_t)m->nbody));
    const fw_device_scene *s = n > 0 && scene != FW_NONE ? &m->device->scene[scene] : NULL;
    if (s) b->late_s = 0.9 * s->duration_s;
    for (int i = 0; s && i < s->nbase; i++)
        b->carried_m_per_s2 += hypot(s->base[i].ax_m_per_s2, s->base[i].ay_m_per_s2) *
                               fw_quantity_law_largest(s->base[i].law, s->duration_s);
    for (int k = 0; k < n; k++) {
        const fw_verdict_arm *arm = &b->arm[2 * m->nhinge + k];
        if (end[k].scene != scene || !arm->known) continue;
        const double goes = fw_verdict_arm_goes(arm);
        const fw_mechanism_give *given =
            fw_mechanism_give_at(m, end[k].body, end[k].x_m, end[k].y_m);
        if (isfinite(end[k].known_N))
            b->stated_J += 0.5 * end[k].known_N * end[k].known_N * goes / b->stiff_N;
        b->place[b->nplace++] =
            (fw_verdict_place){.body = end[k].body,
                               .force = end[k].force,
                               .known_N = end[k].known_N,
                               .x_m = end[k].x_m,
                               .y_m = end[k].y_m,
                               .id = end[k].id,
                               .arm = arm,
                               .end = 2 * m->nhinge + end[k].first,
                               .given = given,
                               .m_per_N = given ? left_of(given) : goes / b->stiff_N,
                               .whole_m_per_N = goes / b->stiff_N};
    }
    return FW_OK;
}

fw_status fw_verdict_place_gives(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                                 const fw_device_probe *probe, double *m_per_N) {
    const double x = cos(probe->direction_rad), y = sin(probe->direction_rad);
    fw_mechanism_load_end *end;
    int n;
    *m_per_N = 0;
    if (!arm || fw_device_probe_kinds[probe->row].takes != FW_PROBE_TANGENT) return FW_OK;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    for (int k = 0; k < n; k++) {
        const fw_verdict_arm *way = &arm[2 * m->nhinge + k];
        if (end[k].scene != FW_NONE || end[k].id != probe->id) continue;
        if (way->lost) *m_per_N = HUGE_VAL;
        if (!way->known) continue;
        const double *g = way->give;
        *m_per_N = (g[3] * x * x + 2 * g[4] * x * y + g[5] * y * y) /
                   (m->variant->material.youngs.value * m->variant->thickness_m);
    }
    return FW_OK;
}

static bool is_at(const fw_verdict_place *at, int body, double x_m, double y_m) {
    const double same_m = 1e-9;
    return body == at->body && fabs(x_m - at->x_m) < same_m && fabs(y_m - at->y_m) < same_m;
}

static void find_spring(fw_verdict_place *at, const fw_effects_loads *loads) {
    at->spring = NULL;
    for (int i = 0; at->id && i < loads->nspring && !at->spring; i++) {
        const fw_device_spring *k = &loads->spring[i];
        const bool first = is_at(at, k->body_a, k->ax_m, k->ay_m),
                   second = is_at(at, k->body_b, k->bx_m, k->by_m);
        if (k->id && strcmp(k->id, at->id) == 0 && (first || second))
            at->spring = k, at->second = !first;
    }
    if (at->spring && at->m_per_N * at->spring->stiffness_N_per_m > hardly_gives)
        at->stiff_N_per_m = at->spring->stiffness_N_per_m;
}

/* what acts there in this run: an element of that name with a port at the place; does it go by how the place goes? */
static void find_element(fw_verdict_place *at, const fw_effects_loads *loads) {
    at->element = NULL, at->stiff_N_per_m = 0;
    for (int i = 0; at->id && i < loads->nelement && !at->element; i++) {
        const fw_effects_force_element *e = &loads->element[i];
        if (!e->id || strcmp(e->id, at->id) != 0 || e->class_->electrodes || e->pin != FW_NONE ||
            e->ports > PORTS_SEEN || e->switches > PORTS_SEEN)
            continue;
        for (int k = 0; k < e->ports && !at->element; k++)
            if (is_at(at, e->port[k].body, e->port[k].x_m, e->port[k].y_m))
                at->element = e, at->port = k;
    }
    if (at->element && at->m_per_N * at->element->size_N_per_m > hardly_gives)
        at->stiff_N_per_m = at->element->size_N_per_m;
}

static fw_geometry_vec2 place_now(const double *q, int body, double x_m, double y_m) {
    const fw_geometry_vec2 own = {x_m, y_m};
    if (body == FW_GROUND) return own;
    return vec_add((fw_geometry_vec2){q[3 * body], q[3 * body + 1]},
                   fw_geometry_vec_rotate(own, q[3 * body + 2]));
}

static void spring_acts(const fw_verdict_place *at, const double *q, double acts[3],
                        double *stored_J) {
    const fw_device_spring *k = at->spring;
    const fw_geometry_vec2 along = vec_sub(place_now(q, k->body_b, k->bx_m, k->by_m),
                                           place_now(q, k->body_a, k->ax_m, k->ay_m));
    const double length = vec_length(along), stretch = length - k->length_m,
                 pull = k->cable && stretch < 0 ? 0 : k->stiffness_N_per_m * stretch;
    if (!(length > 0)) return;
    acts[0] = (at->second ? -1 : 1) * pull * along.x / length;
    acts[1] = (at->second ? -1 : 1) * pull * along.y / length;
    if (stored_J) *stored_J += 0.5 * pull * stretch;
}

void fw_verdict_place_acts(const fw_verdict_place *at, const fw_dynamics_instant *now,
                           double acts[3], double *stored_J) {
    const fw_effects_force_element *e = at->element;
    double p[3 * PORTS_SEEN], w[3 * PORTS_SEEN], f[3 * PORTS_SEEN], law[3] = {1};
    bool on[PORTS_SEEN] = {false};
    acts[0] = acts[1] = acts[2] = 0;
    if (at->force) {
        if (at->force->law) fw_quantity_law_value(at->force->law, now->t_s, now->piece_s, law);
        acts[0] = at->force->fx_N * law[0], acts[1] = at->force->fy_N * law[0];
    }
    if (at->spring) spring_acts(at, now->q, acts, stored_J);
    if (!e) return;
    fw_effects_element_place_ports(e, now->q, NULL, p, w);
    const fw_effects_port_state seen = {.t_s = now->t_s,
                                        .piece_s = now->piece_s,
                                        .load = 1,
                                        .p = p,
                                        .w = w,
                                        .on = on,
                                        .still = true};
    for (int i = 0; i < e->switches; i++)
        on[i] = e->class_->switch_value && e->class_->switch_value(e, &seen, i) > 0;
    e->class_->force(e, &seen, f);
    memcpy(acts, f + 3 * at->port, 3 * sizeof *acts);
    if (stored_J && e->class_->energy) *stored_J += e->class_->energy(e, &seen);
}

/* of the places of one element or spring the first that counts */
static bool is_first(const fw_verdict_bending *b, int place) {
    for (int i = 0; i < place; i++)
        if (b->place[i].element == b->place[place].element &&
            b->place[i].spring == b->place[place].spring && b->place[i].stiff_N_per_m > 0)
            return false;
    return true;
}

/* ---- what hits by itself ----
   The motion has all mass in rigid bodies, and what a place gives without any. What stands on a slender part hits by its own mass
   first, and rings about the motion: with v at the touch and m of what goes with the place's bend by c k/(1 + c k) (k m)^(1/2) v.
   Blows that come again add up, at most to all that moves, (2 k E)^(1/2), E the largest kinetic energy:

     F <= F of the motion + min(1, 2 c k) ((2 k E)^(1/2) + D v),   (2 E)^(1/2) <= (2 T)^(1/2) + (c m)^(1/2) (a.M a)^(1/2)

   D of what acts there; the last: what the slender part swings before, a of the motion before anything presses there and of
   what carries it, m of the body (Rayleigh: no mode of it is slower). In: instants, speeds by what lies between two. Out: N. Error:
   an upper bound, of rings that fall no slower than the motion: at the end of a scene E is that of its last tenth. Test:
   test_effects.py, SlenderArms */

static double stiffness_of(const fw_verdict_place *at) {
    return at->spring ? at->spring->stiffness_N_per_m : at->element ? at->element->size_N_per_m : 0;
}

/* by which what acts there may change its length: of all its places together */
static double fast(const fw_verdict_place *at, const double *q, const double *v) {
    double sum = 0;
    for (int i = 0; i < (at->element ? at->element->ports : 2); i++) {
        const fw_device_spring *k = at->spring;
        const fw_effects_port port =
            at->element ? at->element->port[i]
                        : (fw_effects_port){i ? k->body_b : k->body_a, i ? k->bx_m : k->ax_m,
                                            i ? k->by_m : k->ay_m};
        if (port.body == FW_GROUND) continue;
        const fw_geometry_vec2 r =
            fw_geometry_vec_rotate((fw_geometry_vec2){port.x_m, port.y_m}, q[3 * port.body + 2]);
        const double *of = v + 3 * port.body;
        sum += hypot(of[0] - of[2] * r.y, of[1] + of[2] * r.x);
    }
    return sum;
}

static bool may_ring(const fw_verdict_place *at) {
    return at->whole_m_per_N * stiffness_of(at) > 0.1 * hardly_gives;
}

static void find_swing(const fw_mechanism *m, fw_verdict_bending *b) {
    b->swings_s = HUGE_VAL;
    for (int i = 0; i < b->nplace; i++)
        if (may_ring(&b->place[i]))
            b->swings_s = fmin(b->swings_s,
                               sqrt(b->place[i].whole_m_per_N * m->body[b->place[i].body].mass_kg));
}

/* speeds of an instant; *grows: by how much since the anchor, NULL: it is the same. false: none are known */
static bool find_speeds(const fw_mechanism *m, fw_verdict_bending *b,
                        const fw_dynamics_instant *now, const double **grows) {
    const int n = 3 * m->nbody;
    double *q = b->last, *v = q + n, *anchor = v + n, *by = anchor + n;
    const double since = now->t_s - b->last_s, middle = now->t_s - 0.5 * since,
                 round_off = 1e-9 * b->late_s, after = middle - b->anchor_s;
    const bool known = since > round_off;
    *grows = NULL;
    if (!known && !isnan(b->last_s)) return false;
    for (int i = 0; known && i < n; i++)
        v[i] = (now->q[i] - q[i]) / since;
    memcpy(q, now->q, (size_t)n * sizeof *q);
    b->last_s = now->t_s;
    if (!known || after < b->swings_s) return known;
    for (int i = 0; i < n; i++)
        by[i] = (v[i] - anchor[i]) / after, anchor[i] = v[i];
    if (!isnan(b->anchor_s)) *grows = by;
    b->anchor_s = middle;
    return true;
}

static void record_blows(const fw_mechanism *m, fw_verdict_bending *b,
                         const fw_dynamics_instant *now) {
    const double *grows, *v = b->last + 3 * (size_t)m->nbody;
    if (!now->loads || b->swings_s == HUGE_VAL || now->loads->quasi_static ||
        !find_speeds(m, b, now, &grows))
        return;
    const bool late = now->t_s >= b->late_s;
    const double moves_J = fw_verdict_mass_form(m, v, v);
    b->moves_J = fmax(b->moves_J, moves_J);
    if (late) b->late_J = fmax(b->late_J, moves_J);
    for (int i = 0; i < b->nplace; i++) {
        fw_verdict_place *at = &b->place[i];
        fw_verdict_blow *blow = &at->blow;
        double acts[3] = {0};
        if (!may_ring(at)) continue;
        const double goes = fast(at, now->q, v);
        blow->goes = fmax(blow->goes, goes);
        if (late) blow->late_goes = fmax(blow->late_goes, goes);
        if (!blow->touched) fw_verdict_place_acts(at, now, acts, NULL);
        if (!blow->touched && hypot(acts[0], acts[1]) > 0)
            blow->touched = true, blow->touched_s = now->t_s;
        if (blow->touched || !grows) continue;
        blow->swung = fmax(blow->swung, sqrt(fw_verdict_mass_form(m, grows, grows)));
        blow->shaken = fmax(blow->shaken, fast(at, now->q, grows));
    }
}

void fw_verdict_places_record(fw_verdict_bending *b, const fw_mechanism *m,
                              const fw_dynamics_instant *now) {
    if (!now) {
        b->loads = NULL, b->places_J = b->springs_J = 0, b->acted_J = HUGE_VAL;
        b->moves_J = b->late_J = 0, b->last_s = b->anchor_s = (double)NAN;
        for (int i = 0; i < b->nplace; i++)
            b->place[i].force_N = 0, b->place[i].blow = (fw_verdict_blow){0};
        return;
    }
    for (int i = 0; now->loads != b->loads && i < b->nplace; i++) {
        find_element(&b->place[i], now->loads);
        find_spring(&b->place[i], now->loads);
    }
    if (now->loads != b->loads) find_swing(m, b);
    b->loads = now->loads;
    record_blows(m, b, now);
    double stored_J = 0;
    for (int i = 0; i < b->nplace; i++) {
        fw_verdict_place *at = &b->place[i];
        if (!(at->stiff_N_per_m > 0)) continue;
        double acts[3];
        fw_verdict_place_acts(at, now, acts, is_first(b, i) ? &stored_J : NULL);
        at->force_N = fmax(at->force_N, hypot(acts[0], acts[1]));
    }
    b->springs_J = fmax(b->springs_J, stored_J);
}

/* ---- along a motion ----
   What hinges and loads put on bodies, at up to KEPT instants that lie equally far from each other in number: where they are
   more, every second one is left out. An instant: (3 nhinge) moment of the flexure, N m, and force on body b, N, world; (nbody)
   how far each has turned; (3 nplace) force and couple of what acts there */
enum { KEPT = 256 };

size_t fw_verdict_instant_size(const fw_mechanism *m, int nplace) {
    return 3 * (size_t)m->nhinge + (size_t)m->nbody + 3 * (size_t)nplace;
}

fw_status fw_verdict_solid_keep_new(fw_arena *arena, const fw_mechanism *m, int nplace,
                                    fw_verdict_solid_kept **kept) {
    FW_NEED(*kept = fw_arena_one(arena, fw_verdict_solid_kept));
    (*kept)->nplace = nplace;
    FW_NEED((*kept)->instant =
                fw_arena_array(arena, double, KEPT *fw_verdict_instant_size(m, nplace)));
    fw_verdict_solid_keep_none(*kept);
    return FW_OK;
}

void fw_verdict_solid_keep_none(fw_verdict_solid_kept *kept) {
    kept->n = kept->seen = 0, kept->every = 1;
}

void fw_verdict_solid_keep(const fw_verdict_bending *b, const fw_mechanism *m,
                           const fw_dynamics_instant *now) {
    fw_verdict_solid_kept *kept = b->kept;
    const size_t size = fw_verdict_instant_size(m, kept->nplace);
    if (kept->seen++ % kept->every != 0) return;
    if (kept->n == KEPT) {
        for (size_t i = 1; 2 * i < KEPT; i++)
            memcpy(kept->instant + i * size, kept->instant + 2 * i * size, size * sizeof(double));
        kept->n = KEPT / 2, kept->every *= 2;
    }
    double *to = kept->instant + (size_t)kept->n++ * size;
    for (int k = 0; k < m->nhinge; k++) {
        const int j = m->hinge[k].pin;
        *to++ = m->pin[j].stiffness_Nm_per_rad * now->angle_rad[j];
        *to++ = now->reaction_N[2 * j];
        *to++ = now->reaction_N[2 * j + 1];
    }
    for (int i = 0; i < m->nbody; i++)
        *to++ = b->turn[i].rad;
    for (int i = 0; i < b->nplace; i++, to += 3)
        fw_verdict_place_acts(&b->place[i], now, to, NULL);
}

/* c k of all places of one thing, and what they store */
static double in_series(const fw_verdict_bending *b, const char *id, double *stored_J) {
    double share = 0;
    *stored_J = 0;
    for (int i = 0; i < b->nplace; i++) {
        const fw_verdict_place *at = &b->place[i];
        if (!(at->force_N > 0) || strcmp(at->id, id) != 0) continue;
        const double passes =
            at->element && at->port > 0 && at->port + 1 < at->element->ports ? 4 : 1;
        const double own = passes * at->m_per_N * at->stiff_N_per_m;
        share += at->given ? own / (1 + own / at->given->off) : own; /* d ln F = d(c k)/(1 + c k) */
        *stored_J += 0.5 * at->force_N * at->force_N * at->m_per_N;
    }
    return share;
}

void fw_verdict_places_end(fw_verdict_bending *b) {
    for (int i = 0; i < b->nplace; i++) {
        const fw_verdict_place *at = &b->place[i];
        double all_J, own_J = 0.5 * at->force_N * at->force_N * at->m_per_N;
        if (!(at->force_N > 0)) continue;
        const double most_J = in_series(b, at->id, &all_J) * b->hinges_J;
        own_J *= fmin(1, most_J / all_J);
        b->places_J += own_J;
        b->body_J[at->body] += own_J;
    }
}

double fw_verdict_bending_all_J(const fw_verdict_bending *b) {
    return fmin(b->bodies_J + b->places_J, b->acted_J) + b->bases_J;
}

/* the first place of everything that acts on one; NULL: nothing does, or nobody looked */
static const fw_verdict_place *first_of(const fw_verdict_bending *b, const char *id) {
    for (int i = 0; i < b->nplace; i++)
        if (b->place[i].force_N > 0 && strcmp(b->place[i].id, id) == 0) return &b->place[i];
    return NULL;
}

static const fw_verdict_bending *seen_by(const fw_dynamics_motion *motion) {
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    return saw ? &saw->bending : NULL;
}

/* one that the motion has with what gives there */
static bool is_spring(const fw_effects_force_element *e) {
    return strcmp(e->class_->effect, "point-spring") == 0;
}

double fw_verdict_places_error(const fw_dynamics_motion *motion, const fw_device_probe *probe) {
    const fw_verdict_bending *b = seen_by(motion);
    if (!b || !(b->hinges_J > 0)) return 0;
    if (probe->row == FW_PROBE_IS_velocity) return b->stated_J / b->hinges_J;
    if (!probe->of || !first_of(b, probe->of)) return 0;
    for (int i = 0; i < b->nplace; i++)
        if (b->place[i].force_N > 0 &&
            (b->place[i].spring || is_spring(b->place[i].element) ||
             b->place[i].element->class_->pressing) &&
            strcmp(b->place[i].id, probe->of) != 0)
            return 0; /* what one contact does not bear another one may */
    const double all_J = fw_verdict_bending_all_J(b);
    return fmax(all_J - b->places_J, 0) / (b->hinges_J + b->springs_J) - all_J / b->hinges_J;
}

/* what is not known of the field at edges, ends and corners of the electrodes that a probe reads the capacitance of */
static bool capacitance_off(const fw_dynamics_motion *motion, const char *id, double *low_F,
                            double *high_F) {
    static const double drawn[3] = {0, 0, 0};
    for (int i = 0; motion->loads && i < motion->loads->nelement; i++) {
        const fw_effects_force_element *e = &motion->loads->element[i];
        const fw_effects_comb_element *c = fw_effects_comb_of(e);
        if (!c || strcmp(e->id, id) != 0) continue;
        const double off = fw_effects_comb_capacitance_off(c, drawn);
        *low_F *= 1 - fmin(1, off), *high_F *= 1 + off;
        return true;
    }
    return false;
}

static double damping_of(const fw_device *d, const fw_verdict_place *at) {
    double most = at->spring ? at->spring->damping_Ns_per_m : 0;
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *s = &d->scene[i];
        for (int k = 0; k < s->ncontact; k++)
            if (s->contact[k].id && strcmp(s->contact[k].id, at->id) == 0)
                most = fmax(most, s->contact[k].damping_Ns_per_m);
        for (int k = 0; k < s->ntendon; k++)
            if (s->tendon[k].id && strcmp(s->tendon[k].id, at->id) == 0)
                most = fmax(most, s->tendon[k].damping_Ns_per_m);
    }
    return most;
}

static double blow_of(const fw_mechanism *m, const fw_verdict_bending *b, const char *id,
                      bool at_end) {
    const fw_verdict_place *at = NULL;
    double share = 0;
    for (int i = 0; i < b->nplace; i++) {
        const fw_verdict_place *one = &b->place[i];
        if (!one->id || strcmp(one->id, id) != 0 || !may_ring(one)) continue;
        const bool passes = one->element && one->port > 0 && one->port + 1 < one->element->ports;
        share += (passes ? 4 : 1) * one->whole_m_per_N * stiffness_of(one);
        if (!at || one->whole_m_per_N > at->whole_m_per_N) at = one;
    }
    if (!at || share < hardly_gives) return 0;
    double mass_kg = 0;
    for (int i = 0; i < m->nbody; i++)
        mass_kg += m->body[i].mass_kg;
    const bool over = at_end && at->blow.touched_s < b->late_s; /* what swung before the touch */
    const double swings_s = sqrt(at->whole_m_per_N * m->body[at->body].mass_kg),
                 swung = (over ? 0 : at->blow.swung) + sqrt(mass_kg) * b->carried_m_per_s2,
                 shaken = (over ? 0 : at->blow.shaken) + b->carried_m_per_s2,
                 root = sqrt(at_end ? b->late_J : b->moves_J) + swings_s * swung,
                 goes = (at_end ? at->blow.late_goes : at->blow.goes) + swings_s * shaken;
    return fmin(1, 2 * share) * (sqrt(stiffness_of(at)) * root + damping_of(m->device, at) * goes);
}

/* false: that measure asks for no force */
static bool add_blow(const fw_dynamics_motion *x, const fw_device_probe *probe,
                     fw_device_measure measure, double *low_N, double *high_N) {
    if (!(*high_N > 0) && !(*low_N < 0)) return false; /* it never presses */
    const fw_verdict_strain_monitor *saw = x->observed;
    const double by =
                     blow_of(saw->mechanism, &saw->bending, probe->of, measure == FW_MEASURE_FINAL),
                 least = *low_N < 0 ? -HUGE_VAL : 0;
    switch (measure) {
    case FW_MEASURE_PEAK:
    case FW_MEASURE_MAXIMUM:
        *high_N += by;
        break;
    case FW_MEASURE_PEAK_TO_PEAK:
        *high_N += 2 * by;
        break;
    case FW_MEASURE_MINIMUM:
        *low_N = fmax(least, *low_N - by);
        break;
    case FW_MEASURE_FINAL:
        *low_N = fmax(least, *low_N - by), *high_N += by;
        break;
    case FW_MEASURE_SETTLING:
    case FW_MEASURE_PARASITIC:
        return false;
    }
    return by > 0;
}

bool fw_verdict_places_lower(const fw_dynamics_motion *motion, const fw_device_probe *probe,
                             fw_device_measure measure, double *low_N, double *high_N) {
    const fw_verdict_bending *b = seen_by(motion);
    const char *id = probe->of;
    if (probe->row == FW_PROBE_IS_capacitance)
        return id && capacitance_off(motion, id, low_N, high_N);
    double left = 1, more = 1, stored_J;
    if (!b || !id) return false;
    for (int i = 0; i < b->nplace; i++) {
        const fw_verdict_place *at = &b->place[i];
        if (!first_of(b, id) || !(at->force_N > 0) || first_of(b, at->id) != at) continue;
        const double share = in_series(b, at->id, &stored_J);
        left /= 1 + share;
        if (at->given) more *= 1 + share;
    }
    *low_N *= *low_N > 0 ? left : more; /* below 0: a spring that is pressed */
    *high_N *= *high_N > 0 ? more : left;
    return add_blow(motion, probe, measure, low_N, high_N) || left < 1;
}
