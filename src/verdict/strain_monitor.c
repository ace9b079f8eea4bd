/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains of all hinges followed along a motion: their peaks, and the cycles that fatigue counts. And what bodies bear
   of what was seen there: the stress of the ways of body_arms.c under what hinges and loads bring.
   Theory: docs/theory/verdict.md, docs/theory/release.md. Test: test_body_arms.c */
#include "base/constants.h"
#include "base/text.h"
#include "geometry/segment.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>

enum { FW_GLANCED = 64 }; /* hinges whose thirds are kept; of more all instants are taken */

fw_status fw_verdict_strain_monitor_new(fw_arena *arena, const fw_mechanism *mechanism, bool cycles,
                                        fw_verdict_strain_monitor *monitor) {
    size_t n = (size_t)mechanism->nhinge;
    *monitor = (fw_verdict_strain_monitor){.mechanism = mechanism, .arena = arena};
    FW_NEED(monitor->hinge = fw_arena_array(arena, fw_verdict_hinge_peak, n));
    if (cycles) FW_NEED(monitor->root = fw_arena_alloc(arena, n, sizeof *monitor->root));
    return FW_OK;
}

/* a turn by less than this share of the limit strain is none: with an exponent of fatigue of 10, a
   million of them do not add up to one at the limit */
static const double gate_share = 1e-3;

static void start_counting(fw_verdict_strain_monitor *w, int k) {
    const fw_flexure_result *c = &w->mechanism->hinge[k].closed_form;
    for (int side = 0; w->root && side < FW_FACES; side++)
        w->root[k][side] =
            (fw_maths_turning){.gate = gate_share * c->limit_angle_rad * c->strain_per_rad};
}

static void count(fw_verdict_strain_monitor *w, int k, const fw_verdict_hinge_strains *strain,
                  const fw_dynamics_instant *now) {
    if (!strain->known) return;
    for (int side = 0; side < FW_FACES; side++) {
        if (now->begins) fw_maths_turning_jump(&w->root[k][side]);
        fw_maths_turning_add(&w->root[k][side], w->arena, now->t_s,
                             strain->root[side / 2][side % 2]);
    }
}

static const double fw_strains_settle = 2;
/* times the accuracy wanted, of the largest strain or of a share of the limit below which nothing is
   judged more closely; in a trial, whose band nobody sees, of the limit */
static const double fw_strains_accurate = 5, fw_small_strain = 0.02, fw_trial_accurate = 30;

double fw_verdict_strain_monitor_error(const fw_verdict_strain_monitor *tighter,
                                       const fw_verdict_strain_monitor *looser, double margin) {
    double most = 0;
    for (int k = 0; k < tighter->mechanism->nhinge; k++)
        if (tighter->hinge[k].strain.samples > 0 && looser->hinge[k].strain.samples > 0)
            most = fmax(most, fabs(tighter->hinge[k].strain.value - looser->hinge[k].strain.value));
    return fw_strains_settle * margin * most;
}

double fw_verdict_strain_monitor_unsettled(const void *tighter, const void *looser, double margin,
                                           double accuracy) {
    const fw_verdict_strain_monitor *monitor = tighter;
    double limit = HUGE_VAL, most = 0;
    for (int k = 0; k < monitor->mechanism->nhinge; k++) {
        const fw_flexure_result *c = &monitor->mechanism->hinge[k].closed_form;
        limit = fmin(limit, c->limit_angle_rad * c->strain_per_rad);
        most = fmax(most, monitor->hinge[k].strain.value);
    }
    double of = monitor->trial ? limit : fmin(fmax(most, fw_small_strain * limit), limit);
    double times = monitor->trial ? fw_trial_accurate : fw_strains_accurate;
    const fw_verdict_strain_monitor *other = looser;
    double strains = fw_verdict_strain_monitor_error(monitor, looser, margin) /
                     (fmin(times * accuracy, 0.03) * of);
    if (!monitor->probe || !other->probe) return strains;
    return fmax(strains,
                fw_probe_monitor_unsettled(monitor->probe, other->probe, margin, accuracy));
}

/* they take 50 kB each: only where a run has hinges as beams */
static fw_status make_beams(fw_verdict_strain_monitor *w) {
    const fw_mechanism *m = w->mechanism;
    fw_flexure_elastica **beam = fw_arena_alloc(w->arena, (size_t)m->nhinge, sizeof *beam);
    FW_NEED(beam);
    for (int k = 0; k < m->nhinge; k++)
        FW_TRY(fw_verdict_hinge_beam(w->arena, &m->hinge[k], &beam[k]));
    w->beam = beam;
    return FW_OK;
}

/* Exact beams are asked where the closed form, which is right within 3 %, comes to this share of the
   peak so far; below it decides nothing, unless cycles are counted. Where the last strain came to more than the other
   share they are asked at once. */
static const double asked_share = 0.8, surely_share = 0.85;

static void strain_at(const fw_verdict_strain_monitor *w, int k, const fw_dynamics_instant *now,
                      fw_verdict_hinge_strains *strain) {
    const fw_mechanism *m = w->mechanism;
    const fw_mechanism_hinge *hinge = &m->hinge[k];
    fw_verdict_hinge_load load = fw_verdict_hinge_load_at(m, k, now);
    load.least_known = w->hinge[k].least;
    fw_flexure_elastica *beam = w->beam && now->hinge == FW_HINGE_ELASTICA ? w->beam[k] : NULL;
    const fw_verdict_largest *peak = &w->hinge[k].strain;
    bool surely = peak->samples > 0 && peak->last[1] > surely_share * peak->value;
    if (beam && !w->root && peak->value > 0 && !surely) {
        fw_verdict_hinge_strain(hinge, NULL, &load, strain);
        if (strain->known && strain->peak < asked_share * peak->value) return;
    }
    fw_verdict_hinge_strain(hinge, beam, &load, strain);
}

static void lose(fw_verdict_strain_monitor *w, int k, double t_s) {
    fw_verdict_hinge_peak *peak = &w->hinge[k];
    peak->strain.samples = 0; /* no parabola across it */
    if (!peak->lost) peak->lost = true, peak->lost_s = t_s;
}

static void take(fw_verdict_strain_monitor *w, int k, double t_s, double angle_rad,
                 const fw_verdict_hinge_strains *strain) {
    if (!strain->known) {
        lose(w, k, t_s);
        return;
    }
    double by_angle = fabs(angle_rad) * w->mechanism->hinge[k].closed_form.strain_per_rad;
    w->hinge[k].forced = fmax(w->hinge[k].forced, fabs(strain->peak - by_angle));
    fw_verdict_largest_add(&w->hinge[k].strain, t_s, strain->peak);
    w->hinge[k].least = fmax(w->hinge[k].least, strain->least);
    w->hinge[k].most = fmax(w->hinge[k].most, strain->most);
}

void fw_verdict_strain_monitor_record(void *context, const fw_dynamics_instant *now) {
    fw_verdict_strain_monitor *w = context;
    if (w->probe) fw_probe_monitor_record(w->probe, now);
    if (now && now->hinge == FW_HINGE_ELASTICA && !w->beam && !w->no_memory)
        w->no_memory = make_beams(w) != FW_OK;
    if (w->bending.hardest_N) fw_verdict_bending_record(&w->bending, w->mechanism, now);
    fw_verdict_touch_record(w, now);
    for (int k = 0; k < w->mechanism->nhinge; k++) {
        if (!now) {
            w->hinge[k] = (fw_verdict_hinge_peak){0};
            start_counting(w, k);
            continue;
        }
        if (now->begins) w->hinge[k].strain.samples = 0; /* no parabola across a jump */
        fw_verdict_hinge_strains strain;
        strain_at(w, k, now, &strain);
        take(w, k, now->t_s, now->angle_rad[w->mechanism->hinge[k].pin], &strain);
        if (w->root) count(w, k, &strain, now);
    }
}

/* ---- the thirds of a step ---- */

static const double small_share = 0.6, smooth_share = 0.05, counted_share = 0.005;

static bool is_enough(const fw_verdict_largest *p, const fw_verdict_hinge_strains *third) {
    double before = p->last[1], a = third[0].peak, b = third[1].peak, c = third[2].peak;
    double most = fmax(fmax(before, a), fmax(b, c)), peak = fmax(p->value, most);
    return most < small_share * peak || fabs(before - 3 * a + 3 * b - c) < smooth_share * peak;
}

/* Whoever counts cycles has the height of every turn: between places evenly apart a parabola is off by
   at most 0.0642 of the third difference, here by 0.03 % of the peak. */
static bool is_enough_to_count(const fw_maths_turning *face, double peak,
                               const fw_verdict_hinge_strains *third) {
    for (int side = 0; side < FW_FACES; side++) {
        int root = side / 2, at = side % 2;
        double a = third[0].root[root][at], b = third[1].root[root][at];
        double bent = face[side].s[1] - 3 * a + 3 * b - third[2].root[root][at];
        if (face[side].samples < 2 || !(fabs(bent) < counted_share * peak)) return false;
    }
    return true;
}

bool fw_verdict_strain_monitor_glance(void *context, const fw_dynamics_instant *third) {
    fw_verdict_strain_monitor *w = context;
    int n = w->mechanism->nhinge;
    if (w->probe || n > FW_GLANCED) return false;
    fw_verdict_hinge_strains strain[FW_GLANCED][FW_THIRDS];
    for (int k = 0; k < n; k++) {
        if (w->hinge[k].strain.samples < 2) return false;
        for (int i = 0; i < FW_THIRDS; i++)
            strain_at(w, k, &third[i], &strain[k][i]);
        if (!is_enough(&w->hinge[k].strain, strain[k])) return false;
        if (w->root && !is_enough_to_count(w->root[k], w->hinge[k].strain.value, strain[k]))
            return false;
    }
    for (int k = 0; k < n; k++)
        for (int i = 0; i < FW_THIRDS; i++) {
            take(w, k, third[i].t_s, third[i].angle_rad[w->mechanism->hinge[k].pin], &strain[k][i]);
            if (w->root) count(w, k, &strain[k][i], &third[i]);
        }
    for (int i = 0; w->bending.hardest_N && i < FW_THIRDS; i++)
        fw_verdict_bending_record(&w->bending, w->mechanism, &third[i]);
    for (int i = 0; i < FW_THIRDS; i++)
        fw_verdict_touch_record(w, &third[i]);
    return true;
}

/* ---- fatigue ---- */

/* of what nothing is known to damp the quality is at most 1e8: single crystals of silicon have some 1e7 at best near 300 K, plated
   metals 1e4 (assumed, after Chandorkar et al., IEEE MEMS 2008, 74) */
static double falls_by(const fw_verdict_ring *r) {
    const double quality_most = 1e8;
    return r->decrement > 0 ? r->decrement : FW_PI / quality_most;
}

/* A block is a fiftieth of the amplitude, or one swing where that is more; its middle stands for it. Test: test_fatigue.c
   rings_out */
size_t fw_verdict_rung_out(const fw_verdict_after *after, int k, double peak_Pa,
                           fw_maths_cycle *to) {
    const double block = 0.02, down_to = log(20);
    const fw_verdict_ring *r = &after->ring[k];
    const double d = falls_by(r), step = fmax(block, d);
    size_t n = 0;
    for (double at = 0.5 * step; at < down_to && n < FW_RING_BLOCKS; at += step) {
        double share = r->share * exp(-at);
        for (int j = 1; k == 0 && j < after->n; j++) {
            const fw_verdict_ring *on = &after->ring[j];
            share += on->share * exp(-at * falls_by(on) * on->omega_per_s / (d * r->omega_per_s));
        }
        to[n++] = (fw_maths_cycle){2 * fmin(share, 1) * peak_Pa, after->rest * peak_Pa, step / d};
    }
    return n;
}

/* what rings on, so many times as far, is put behind cycles; undamped: what nothing is known to damp instead. Returns how many */
static size_t put_after(const fw_verdict_after *after, double times, double peak_Pa, bool undamped,
                        fw_maths_cycle *to) {
    size_t n = 0;
    if (!after) return 0;
    fw_verdict_after so_far = *after;
    for (int k = 0; k < so_far.n; k++)
        so_far.ring[k].share *= times;
    for (int k = 0; k < so_far.n; k++)
        if (undamped == !(so_far.ring[k].decrement > 0))
            n += fw_verdict_rung_out(&so_far, k, peak_Pa, to + n);
    return n;
}

static double largest_face(const fw_maths_turning root[FW_FACES]) {
    double most = 0;
    for (int side = 0; side < FW_FACES; side++) {
        most = fmax(most, fabs(root[side].latest));
        for (size_t i = 0; i < root[side].count; i++)
            most = fmax(most, fabs(root[side].value[i]));
    }
    return most;
}

fw_status fw_verdict_fatigue_of(fw_arena *arena, const fw_flexure_strain_life *law,
                                fw_maths_turning root[FW_FACES], double peak_strain,
                                double youngs_Pa, double times, const fw_verdict_after *after,
                                fw_verdict_fatigue *out) {
    const double most = largest_face(root),
                 Pa = youngs_Pa * (most > 0 ? fmax(1, peak_strain / most) : 1),
                 peak_Pa = fmax(peak_strain, most) * youngs_Pa;
    const double small = 0.9; /* what rings on may be off by a tenth: small motions (assumed) */
    const double large = 1 + (after ? after->more : 0);
    const size_t rings = after ? (size_t)after->n * FW_RING_BLOCKS : 0;
    *out = (fw_verdict_fatigue){0};
    for (int side = 0; side < FW_FACES; side++) {
        fw_maths_turning *r = &root[side];
        fw_maths_turning_end(r, arena);
        if (r->failed) return FW_NOMEM;
        double *work;
        fw_maths_cycle *cycle;
        FW_NEED(work = fw_arena_array(arena, double, 2 * r->count + 1));
        FW_NEED(cycle = fw_arena_array(arena, fw_maths_cycle, r->count + 1 + rings));
        size_t n = fw_maths_rainflow_repeating(r->value, r->count, work, cycle);
        double counted = 0;
        for (size_t i = 0; i < n; i++) {
            cycle[i].range *= Pa;
            cycle[i].mean *= Pa;
            counted += cycle[i].count;
        }
        size_t rung = put_after(after, small, peak_Pa, false, cycle + n);
        out->at_least =
            fmax(out->at_least, fw_verdict_fatigue_utilisation(law, cycle, n + rung, times));
        rung = put_after(after, 1, peak_Pa, false, cycle + n);
        const double used = fw_verdict_fatigue_utilisation(law, cycle, n + rung, times),
                     damage = fw_verdict_miner(law, cycle, n + rung, times, 1);
        rung = put_after(after, large, peak_Pa, false, cycle + n);
        out->damped =
            fmax(out->damped, fw_verdict_fatigue_utilisation(law, cycle, n + rung, times));
        rung += put_after(after, large, peak_Pa, true, cycle + n + rung);
        out->at_most =
            fmax(out->at_most, fw_verdict_fatigue_utilisation(law, cycle, n + rung, times));
        if (!(used > out->utilisation)) continue;
        out->utilisation = used, out->damage = damage, out->cycles = counted;
    }
    return FW_OK;
}

/* ---- scenes that are repeated in turn ----
   Each is repeated as often as `cycles` says. Who has them all goes from the farthest of one to that of another: in turn, which makes
   most of such ranges, is counted. Out: utilisation, no safety factor; 0: fewer than two scenes bend the hinge. Test: test_limits.py */
static const fw_verdict_strain_monitor *saw_of(const fw_verdict_variant_verdict *v, int i, int k,
                                               const fw_verdict_strain_monitor *monitor) {
    const fw_verdict_strain_monitor *saw = v->motion[i] ? v->motion[i]->observed : NULL;
    if (v->motion[i] && !saw) saw = &monitor[i];
    return saw && saw->root && saw->hinge[k].strain.value > 0 ? saw : NULL;
}

fw_status fw_verdict_in_turn(fw_arena *arena, const fw_verdict_variant_verdict *v, int k,
                             const fw_verdict_strain_monitor *monitor, double *used) {
    const fw_mechanism *m = v->mechanism;
    const double E = m->variant->material.youngs.value;
    size_t most = 1, rings = 0, bent = 0;
    double *turn;
    fw_maths_cycle *cycle;
    *used = 0;
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_verdict_strain_monitor *saw = saw_of(v, i, k, monitor);
        for (int side = 0; saw && side < FW_FACES; side++)
            most += saw->root[k][side].count;
        if (saw) bent++, rings += saw->after ? (size_t)saw->after[k].n : 0;
    }
    if (bent < 2) return FW_OK;
    FW_NEED(turn = fw_arena_array(arena, double, 3 * most));
    FW_NEED(cycle = fw_arena_array(arena, fw_maths_cycle, most + rings * FW_RING_BLOCKS));
    for (int side = 0; side < FW_FACES; side++) {
        size_t n = 0, at = 0;
        for (int i = 0; i < m->device->nscene; i++) {
            const fw_verdict_strain_monitor *saw = saw_of(v, i, k, monitor);
            for (size_t j = 0; saw && j < saw->root[k][side].count; j++)
                turn[n++] = E * saw->root[k][side].value[j];
            for (int j = 0; saw && saw->after && j < saw->after[k].n; j++)
                if (saw->after[k].ring[j].decrement > 0)
                    at += fw_verdict_rung_out(&saw->after[k], j, E * saw->hinge[k].strain.value,
                                              cycle + at);
        }
        at += fw_maths_rainflow_repeating(turn, n, turn + most, cycle + at);
        *used = fmax(*used, fw_verdict_fatigue_utilisation(&m->hinge[k].limits.life, cycle, at,
                                                           m->device->limits.cycles));
    }
    return FW_OK;
}

/* ---- rims of release holes ---- */

/* what the hinge of an end brings: its largest moment and force, and what equilibrium asks of the cut, times thickness */
typedef struct brought {
    double moment_Nm, force_N, cut_N_per_m;
    const double *along_N; /* as fw_verdict_arm_rims_bear takes it */
    double rest[2];
} brought;

/* shares of what is allowed at the rims beside one end of a hinge. Walls that the flow puts farther in leave less of
   every strip, and of the narrowest one most; walls farther out leave more */
static fw_verdict_band rims_of(const fw_mechanism *m, const fw_verdict_arm *arm, int i,
                               const brought *by) {
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&m->hinge[i / 2].limits);
    if (!arm->known || !limit) return (fw_verdict_band){0, 0};
    const double allowed_N_per_m =
        limit->allowable_Pa / m->device->safety_factor * m->variant->thickness_m;
    const double walls = m->layout ? 2 * m->layout->edge_m : 0;
    const double made = fmax(arm->narrow_m + walls, 1e-3 * arm->narrow_m) / arm->narrow_m;
    const double low = by->cut_N_per_m / (fmax(made, 1) * fmax(made, 1));
    return (fw_verdict_band){
        low / allowed_N_per_m,
        fw_verdict_arm_rims_bear(m, i / 2, arm, by->moment_Nm, by->force_N, by->along_N, by->rest)};
}

static brought in_motion(const fw_mechanism *m, const fw_verdict_bending *b, int i) {
    const double *most = b->hardest_N + 2 * m->nhinge + i / 2 * 2;
    const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
    const int body = i % 2 ? pin->body_b : pin->body_a;
    const bool moves = body != FW_GROUND;
    return (brought){most[1],
                     sqrt(most[0]),
                     b->cut_N_per_m[i],
                     b->along_N + 2 * i,
                     {moves ? b->rest_N[body] : 0, moves ? b->rest_Nm[body] : 0}};
}

fw_verdict_band fw_verdict_bending_rims(const fw_mechanism *m, const fw_dynamics_motion *motion,
                                        int at[2]) {
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    fw_verdict_band worst = {0, 0};
    if (!saw || !saw->bending.arm || !saw->bending.cut_N_per_m)
        return (fw_verdict_band){(double)NAN, (double)NAN};
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const brought by = in_motion(m, &saw->bending, i);
        const fw_verdict_band here = rims_of(m, &saw->bending.arm[i], i, &by);
        if (here.low > worst.low) worst.low = here.low, at[0] = i;
        if (here.high > worst.high) worst.high = here.high, at[1] = i;
    }
    const double off = fw_verdict_motion_model_error(m, motion);
    return (fw_verdict_band){worst.low * fmax(1 - off, 0), worst.high * (1 + off)};
}

/* No required pose turns a hinge further, or has a larger joint force, than is proved of all of them; what drift and
   give of the hinges add to strains they are taken to add to forces. Where nothing bounds that (FW-D535) it is left
   out: the poses are undecided. What else holds a body is no more than all its hinges together. */
static brought in_poses(const fw_verdict_variant_verdict *v, int i) {
    const fw_mechanism *m = v->mechanism;
    const fw_workspace_result *w = &v->workspace;
    const int at = m->hinge[i / 2].pin;
    const fw_workspace_load *load = &w->load[at];
    const double more =
        (1 + fmax(load->added, 0)) * (1 + (isfinite(load->give) ? fmax(load->give, 0) : 0));
    return (brought){.moment_Nm = m->pin[at].stiffness_Nm_per_rad *
                                      (fabs(w->peak[at].angle_rad) + w->peak[at].error_rad) +
                                  (load->known ? more * load->rub_Nm : 0),
                     .force_N = load->known ? more * load->most_N : 0};
}

/* what the hinges of a body put on it together at most */
static void add_rest(const fw_verdict_variant_verdict *v, int body, double rest[2]) {
    const fw_mechanism *m = v->mechanism;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        if (m->hinge[i / 2].pin >= FW_SIX || (i % 2 ? pin->body_b : pin->body_a) != body) continue;
        const brought by = in_poses(v, i);
        const fw_geometry_vec2 middle = {m->drawn[body].x_m, m->drawn[body].y_m};
        rest[0] += by.force_N;
        rest[1] +=
            by.moment_Nm + by.force_N * vec_distance(fw_mechanism_pin_place(m, pin, i % 2), middle);
    }
}

static double required_at_most(const fw_verdict_variant_verdict *v, int *at) {
    const fw_mechanism *m = v->mechanism;
    const fw_workspace_result *w = &v->workspace;
    double worst = 0;
    if (!v->arm || !w->required || !w->reachable) return (double)NAN;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const int body = i % 2 ? pin->body_b : pin->body_a;
        if (m->hinge[i / 2].pin >= FW_SIX || body == FW_GROUND) continue;
        brought by = in_poses(v, i);
        if (m->device->release_pitch_m > 0) add_rest(v, body, by.rest);
        const double high =
            m->device->release_pitch_m > 0
                ? rims_of(m, &v->arm[i], i, &by).high
                : fw_verdict_arm_bears(m, i / 2, &v->arm[i], by.moment_Nm, by.force_N, NULL);
        if (high > worst) worst = high, *at = i;
    }
    return worst * (1 + fw_verdict_motion_lasting_error(m));
}

double fw_verdict_bending_rims_required(const fw_verdict_variant_verdict *v, int *at) {
    return v->mechanism->device->release_pitch_m > 0 ? required_at_most(v, at) : (double)NAN;
}

/* ---- and of bodies, with holes and without ---- */

typedef struct weak { /* what a body is not known to bear */
    double share;     /* over what is allowed, at most */
    const fw_verdict_arm *arm;
    int body;
    const char *what, *id;
} weak;

static void take_weak(weak *worst, double share, const fw_verdict_arm *arm, int body,
                      const char *what, const char *id) {
    if (share > worst->share) *worst = (weak){share, arm, body, what, id};
}

static fw_status weakest_of(fw_arena *arena, const fw_mechanism *m, int scene,
                            const fw_verdict_bending *b, weak *worst) {
    fw_mechanism_load_end *end;
    int n;
    for (int i = 0; !b->cut_N_per_m && i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const double *most = b->hardest_N + 2 * m->nhinge + i / 2 * 2;
        take_weak(worst,
                  fw_verdict_arm_bears(m, i / 2, &b->arm[i], most[1], sqrt(most[0]),
                                       b->along_N ? b->along_N + 2 * i : NULL),
                  &b->arm[i], i % 2 ? pin->body_b : pin->body_a, "hinge", pin->id);
    }
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    for (int k = 0; k < n; k++)
        for (int i = 0; end[k].scene == scene && i < 2 * m->nhinge; i++) {
            const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
            const fw_verdict_arm *arm = &b->arm[2 * m->nhinge + k];
            if ((i % 2 ? pin->body_b : pin->body_a) != end[k].body) continue;
            if (arm->lost) take_weak(worst, HUGE_VAL, arm, end[k].body, end[k].what, end[k].id);
            const double load_N = fw_verdict_load_N(end, n, k, b->rest_N);
            const double rest[2] = {b->rest_N[end[k].body],
                                    b->rest_Nm ? b->rest_Nm[end[k].body] : 0};
            take_weak(worst,
                      b->rest_Nm ? fw_verdict_arm_rims_bear(m, i / 2, arm, 0, load_N, NULL, rest)
                                 : fw_verdict_arm_bears(m, i / 2, arm, 0, load_N, NULL),
                      arm, end[k].body, end[k].what, end[k].id);
        }
    return FW_OK;
}

/* a body that is narrower than its hinges or loads ask for breaks before they do; scene NULL: in required poses */
static fw_status say_weak(fw_arena *arena, const char *scene, const weak *w,
                          fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    char high[32], wide[32], x[32], y[32];
    const char *text =
        w->arm->lost
            ? fw_arena_printf(
                  arena,
                  "in %s%s %s%s is not known to bear what %s%s%s brings: where that acts it is "
                  "narrower "
                  "than an 800th of its size, or hangs by so little; make it wider there",
                  scene ? fw_text_kind("scene ", scene) : "required poses", scene ? scene : "",
                  FW_NAMED("body", m->device->body[w->body].id), w->what, w->id ? " " : "",
                  w->id ? w->id : "")
            : fw_arena_printf(
                  arena,
                  "in %s%s %s%s is not known to bear what %s%s%s brings: at most %s %% of what is "
                  "allowed, where it is %s um wide, near (%s, %s) um, corners counted three times; "
                  "make it "
                  "wider there, or %s",
                  scene ? fw_text_kind("scene ", scene) : "required poses", scene ? scene : "",
                  FW_NAMED("body", m->device->body[w->body].id), w->what, w->id ? " " : "",
                  w->id ? w->id : "", fw_number_text(high, sizeof high, 100 * w->share, 3),
                  fw_number_text(wide, sizeof wide, 1e6 * w->arm->edge_wide_m, 3),
                  fw_number_text(x, sizeof x, 1e6 * w->arm->edge.x, 4),
                  fw_number_text(y, sizeof y, 1e6 * w->arm->edge.y, 4),
                  scene ? "the load smaller" : "the required box smaller");
    FW_NEED(text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = scene ? scene : "workspace",
                                                  .flow = m->variant->flow,
                                                  .number = FW_VERDICT_BODIES,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = fmin(fmax(0.98 / w->share, 1e-3), 0.99),
                                                  .not_by_loads = scene == NULL,
                                                  .not_by_width = true,
                                                  .text = text};
    return FW_OK;
}

static fw_status judge_bodies(fw_arena *arena, int scene, const fw_dynamics_motion *motion,
                              fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    weak worst = {.share = 0};
    if (!saw || !saw->bending.arm || !saw->bending.rest_N) return FW_OK;
    FW_TRY(weakest_of(arena, m, scene, &saw->bending, &worst));
    worst.share *= 1 + fw_verdict_motion_model_error(m, motion);
    return worst.share > 1 ? say_weak(arena, m->device->scene[scene].name, &worst, v) : FW_OK;
}

fw_status fw_verdict_bending_judge(fw_arena *arena, int scene, const fw_dynamics_motion *motion,
                                   fw_verdict_variant_verdict *v) {
    int at[2] = {0, 0};
    const fw_verdict_band band = fw_verdict_bending_rims(v->mechanism, motion, at);
    FW_TRY(judge_bodies(arena, scene, motion, v));
    if (!(band.high > 1)) return FW_OK;
    const fw_verdict_strain_monitor *saw = motion->observed;
    const int i = at[band.low > 1 ? 0 : 1];
    return fw_verdict_give_rims(arena, &saw->bending.arm[i], i, band.low, band.high,
                                v->mechanism->device->scene[scene].name, v);
}

fw_status fw_verdict_bending_judge_required(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    int at = 0;
    const double high = required_at_most(v, &at);
    if (!(high > 1)) return FW_OK;
    if (m->device->release_pitch_m > 0)
        return fw_verdict_give_rims(arena, &v->arm[at], at, 0, high, NULL, v);
    const fw_mechanism_pin *pin = &m->pin[m->hinge[at / 2].pin];
    const weak worst = {high, &v->arm[at], at % 2 ? pin->body_b : pin->body_a, "hinge", pin->id};
    return say_weak(arena, NULL, &worst, v);
}
