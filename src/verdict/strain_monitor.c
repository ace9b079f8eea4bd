/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains of all hinges followed along a motion: their peaks, and the cycles that fatigue counts, of hinges and of what
   they and loads bring to bodies; scenes in which nothing is strained (FW-D655). Theory: docs/theory/verdict.md. Test: test_fatigue.c, test_body_arms.c */
#include "base/constants.h"
#include "base/text.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "quantity/law_kind.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

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
    if (!now) w->glances = 0;
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

/* steps of a run that are looked at closely where anything is probed; of those behind them only where it may come to more */
static const long fw_closely_seen = 4096;

bool fw_verdict_strain_monitor_glance(void *context, const fw_dynamics_instant *third) {
    fw_verdict_strain_monitor *w = context;
    int n = w->mechanism->nhinge;
    if (n > FW_GLANCED ||
        (w->probe && (w->glances++ < fw_closely_seen || !fw_probe_monitor_glance(w->probe, third))))
        return false;
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
    for (int i = 0; i < FW_THIRDS; i++) {
        fw_verdict_touch_record(w, &third[i]);
        if (w->probe) fw_probe_monitor_record(w->probe, &third[i]);
    }
    return true;
}

void fw_verdict_strain_monitor_watch(fw_verdict_strain_monitor *w, fw_dynamics_motion_options *o) {
    o->observe = fw_verdict_strain_monitor_record, o->glance = fw_verdict_strain_monitor_glance;
    o->context = w;
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

/* ---- what bodies bear in the course of a scene that is repeated (body_together.c), once it has ended ---- */

/* `most` as the static limit sees it. Of a load of which no course was seen one swing to both sides */
static fw_status lasts_of(fw_arena *arena, const fw_verdict_strain_monitor *w, int row, double most,
                          const fw_verdict_after *after) {
    const fw_mechanism *m = w->mechanism;
    fw_verdict_courses *c = w->bending.courses;
    const fw_flexure_limits *l = &m->hinge[row < 2 * m->nhinge ? row / 2 : 0].limits;
    const double amplitude_Pa = l->item[l->fatigue].allowable_Pa, seen = largest_face(c->row[row]),
                 barely = 0.1;
    const bool whole = seen > barely * most || isinf(c->gate[row]);
    fw_verdict_fatigue f;
    c->lasts[row] = whole ? 0 : most;
    if (!(most > 0) || !whole || !(seen > 0)) return FW_OK;
    for (int i = 0; m->device->nscene > 1 && i < FW_FACES; i++)
        for (int side = 1; side >= -1; side -= 2) {
            fw_maths_turning_jump(&c->row[row][i]);
            fw_maths_turning_add(&c->row[row][i], arena, HUGE_VAL, side * seen);
        }
    FW_TRY(fw_verdict_fatigue_of(arena, &l->life, c->row[row], most, amplitude_Pa / most,
                                 m->device->limits.cycles * m->device->nscene, after, &f));
    c->lasts[row] = fmax(f.utilisation, f.at_most) * most;
    return FW_OK;
}

/* of a body's hinges the one that rings on most beside the most that it was bent by; FW_GROUND: of all */
static const fw_verdict_after *rings_most(const fw_verdict_strain_monitor *w, int body) {
    const fw_mechanism *m = w->mechanism;
    const fw_verdict_after *most = NULL;
    for (int k = 0; w->after && k < m->nhinge; k++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[k].pin];
        const fw_verdict_after *one = &w->after[k];
        if (pin->body_a != body && pin->body_b != body) continue;
        if (!most || (one->n > 0 && (most->n == 0 || one->ring[0].share > most->ring[0].share)))
            most = one;
    }
    return most;
}

fw_status fw_verdict_courses_end(fw_arena *arena, fw_verdict_strain_monitor *w) {
    const fw_mechanism *m = w->mechanism;
    const fw_verdict_bending *b = &w->bending;
    const bool holes = b->rest_Nm != NULL;
    if (!b->courses) return FW_OK;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_verdict_arm *arm = &b->arm[i];
        const double *hardest = b->hardest_N + 2 * m->nhinge + i / 2 * 2,
                     *along = b->along_N + 2 * i,
                     force = sqrt(hardest[0]) * (holes ? arm->rim_m : arm->edge_m),
                     sides = along[0] * (holes ? arm->rim_x_m : arm->edge_x_m) +
                             along[1] * (holes ? arm->rim_y_m : arm->edge_y_m);
        FW_TRY(lasts_of(arena, w, i,
                        hardest[1] * (holes ? arm->rim_m2 : arm->edge_m2) + fmin(force, sides),
                        w->after ? &w->after[i / 2] : NULL));
    }
    for (int i = 0; i < m->nbody; i++) {
        const fw_verdict_after *after = rings_most(w, i);
        FW_TRY(lasts_of(arena, w, fw_verdict_course_of_force(m, i), b->rest_N[i], after));
        if (holes)
            FW_TRY(lasts_of(arena, w, fw_verdict_course_of_moment(m, i), b->rest_Nm[i], after));
    }
    for (int k = 0; k < b->nplace; k++)
        if (isfinite(b->place[k].known_N))
            FW_TRY(lasts_of(arena, w, fw_verdict_course_of_place(m, k), b->place[k].known_N, NULL));
    return FW_OK;
}

/* ---- and what hangs over bears what shakes it (body_hung.c) ---- */

/* Where a mode swings that what hangs over may lower, its own ways are left (resonance.c). Here is what it bears as it is
   shaken itself: its own mode is computed, and lies between these times 1/sqrt(droop per acceleration), from a load at its end to
   one all along, where it is a bar. */
static double shaken_by(const fw_device_scene *s, const fw_verdict_hung *hung) {
    const double lowest = 0.95, highest = 1.4, root = sqrt(hung->in_plane_s2),
                 own = sqrt(hung->in_plane_mode_s2);
    double most = hypot(s->gx_m_per_s2, s->gy_m_per_s2);
    for (int i = 0; i < s->nbase && root > 0; i++) {
        const double size = hypot(s->base[i].ax_m_per_s2, s->base[i].ay_m_per_s2);
        if (size > 0)
            most += size * fw_quantity_law_answer(s->base[i].law, s->duration_s,
                                                  lowest / fmax(root, own),
                                                  fmax(highest / root, 1 / own));
    }
    return most;
}

/* The same over what lasts: all that shakes it is an amplitude to both sides, about what its weight bends it by, as often as its
   mode swings and its laws turn in one repetition, and behind it falls by what the material's loss factor takes. Out: over the
   largest stress, once */
static fw_status shaken_lasts(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                              const fw_verdict_hung *hung, double *times) {
    const fw_flexure_limits *l = &m->hinge[0].limits;
    const double all = shaken_by(s, hung), weight = hypot(s->gx_m_per_s2, s->gy_m_per_s2),
                 root = sqrt(hung->in_plane_s2), own = sqrt(hung->in_plane_mode_s2), highest = 1.4,
                 fastest = fmax(root > 0 ? highest / root : 0, own > 0 ? 1 / own : 0);
    const fw_quantity *loss = &m->variant->material.loss;
    *times = 0;
    if (!(fw_verdict_tires(m, 0) > 0) || !isfinite(all) || !(all > weight)) return FW_OK;
    const double amplitude_Pa = l->item[l->fatigue].allowable_Pa, to_Pa = amplitude_Pa / all;
    double turns = 1 + fastest * s->duration_s / (2 * FW_PI);
    for (int i = 0; i < s->nbase; i++)
        turns += s->duration_s * fw_quantity_law_wave_of(s->base[i].law).fastest_Hz +
                 fw_quantity_law_breaks_of(s->base[i].law, s->duration_s, NULL, 0);
    const fw_verdict_after after = {
        .rest = weight / (all - weight),
        .ring = {{1, FW_PI * (loss->unknown ? 0 : fmax(loss->value, 0)), 1}},
        .n = 1};
    fw_maths_cycle *cycle = fw_arena_array(arena, fw_maths_cycle, 1 + FW_RING_BLOCKS);
    FW_NEED(cycle);
    cycle[0] = (fw_maths_cycle){2 * (all - weight) * to_Pa, weight * to_Pa, turns};
    const size_t n = 1 + fw_verdict_rung_out(&after, 0, (all - weight) * to_Pa, cycle + 1);
    *times = fw_verdict_tires(m, 0) *
             fw_verdict_fatigue_utilisation(&l->life, cycle, n,
                                            m->device->limits.cycles * m->device->nscene);
    return FW_OK;
}

fw_status fw_verdict_shaken_bears(fw_arena *arena, fw_verdict_variant_verdict *v,
                                  const fw_verdict_hung *every, int scene) {
    const fw_mechanism *m = v->mechanism;
    const fw_device_scene *s = &m->device->scene[scene];
    const double corners = 3;
    const fw_flexure_limit *limit =
        m->nhinge > 0 ? fw_flexure_limits_governing(&m->hinge[0].limits) : NULL;
    double worst = 1;
    int body = FW_NONE;
    bool by_fatigue = false;
    const bool counts = limit && v->motion[scene] && every;
    for (int i = 0; counts && i < m->nbody; i++) {
        const fw_verdict_hung *hung = &every[i];
        double again, share = corners * shaken_by(s, hung) * hung->Pa_per_m_s2 /
                              (limit->allowable_Pa / m->device->safety_factor);
        FW_TRY(shaken_lasts(arena, m, s, hung, &again));
        if (share * fmax(again, 1) > worst)
            worst = share * fmax(again, 1), body = i, by_fatigue = again > 1;
    }
    if (body == FW_NONE) return FW_OK;
    char high[32];
    const char *allowed = fw_verdict_allowed_words(arena, m, by_fatigue);
    FW_NEED(allowed);
    const char *text = fw_arena_printf(
        arena,
        "in %s%s %s%s is not known to bear its own weight as it is shaken, where it reaches beyond "
        "its hinges and "
        "its middle: at most %s %% of %s, corners counted three times; make it wider "
        "or shorter there",
        FW_NAMED("scene", s->name), FW_NAMED("body", fw_text_name(m->body[body].id)),
        isfinite(worst) ? fw_number_text(high, sizeof high, 100 * worst, 3) : "any number of",
        allowed);
    FW_NEED(text);
    return fw_verdict_scene_reason(v, s, FW_VERDICT_BODIES, FW_INCONCLUSIVE, 0.98 / worst, text);
}

/* ---- solids of a hinge that meet before it has turned that far ---- */

fw_verdict_decision fw_verdict_by_band(const fw_verdict_hinge_verdict *h) {
    return h->touches && !h->open && h->utilisation_high < 1 ? FW_ACCEPT : h->decision;
}

fw_status fw_verdict_touching(fw_arena *arena, const fw_layout_hinge_layout *drawn,
                              const fw_verdict_hinge_verdict *h, fw_diags *diags,
                              fw_verdict_variant_verdict *v) {
    enum { FEW = 3, MOST = 9 }; /* digits: as many as tell the two angles apart */
    char peak[32] = "", room[32] = "";
    const char *text;
    if (!h->touches || (!diags && h->decision != FW_INCONCLUSIVE)) return FW_OK;
    for (int digits = FEW; digits <= MOST && strcmp(peak, room) == 0; digits++) {
        fw_number_text(peak, sizeof peak, fabs(h->peak_angle_rad) * FW_DEG_PER_RAD, digits);
        fw_number_text(room, sizeof room, drawn->free_rad * FW_DEG_PER_RAD, digits);
    }
    FW_NEED(text = fw_arena_printf(
                arena,
                "%s%s turns by %s%s deg in %s (%s), but its drawn solids touch at %s deg: use a "
                "smaller subtended angle, a longer arc or a smaller load",
                FW_NAMED("hinge", h->id), h->peak_angle_rad < 0 ? "-" : "", peak, h->scene,
                h->flow ? h->flow : "the device's own material", room));
    if (diags) {
        fw_diag_warning(diags, 204, v->mechanism->device->revolute[h->joint].place, "%s", text);
        return FW_OK;
    }
    const double keep = drawn->free_rad / fabs(h->peak_angle_rad);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = h->scene,
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = 204,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = keep,
                                                  .text = text};
    return FW_OK;
}

/* ---- scenes in which nothing moves ---- */

/* Nothing goes by more than 1e-8 of the longest arm, or turns by more than 1e-8, from its first pose, which is the drawn one
   but for what closing the loops moved; and no hinge uses 1e-5 of what it bears, where that is known already: what integrators
   leave of a start at rest. Of small devices that is below an atom. Equilibria under one load do not move, either, but away
   from the drawn pose they stand. Test: test_probe.py, test_equilibria_under_one_load_have_bands */
static bool goes(const fw_mechanism *m, const fw_dynamics_motion *motion, double arm_m) {
    const size_t n = 3 * (size_t)m->nbody;
    const double share = 1e-8, closed_m = 2 * motion->stats.assembly_moved_m;
    for (size_t i = 0; i < n; i++) {
        const fw_mechanism_mass *body = &m->body[i / 3];
        const double drawn[3] = {body->x_m, body->y_m, body->phi_rad};
        const bool turn = i % 3 == 2;
        const double little = share * (turn ? 1 : arm_m),
                     closed = turn && arm_m > 0 ? closed_m / arm_m : closed_m;
        if (fabs(motion->q[i] - drawn[i % 3]) > little + closed) return true;
        for (int r = 1; r < motion->nsample; r++)
            if (fabs(motion->q[(size_t)r * n + i] - motion->q[i]) > little) return true;
    }
    return false;
}

bool fw_verdict_stands_still(const fw_verdict_variant_verdict *v, int scene) {
    const double unused = 1e-5;
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *motion = v->motion[scene];
    const size_t columns = (size_t)m->device->nscene + 1;
    double arm_m = 0;
    const fw_device_scene *s = &m->device->scene[scene];
    if (!motion || motion->ended) return false;
    if (s->gz_m_per_s2 != 0 || fw_mechanism_plates_shaken(s)) return false; /* across the plane */
    for (int i = 0; i < m->npin; i++)
        arm_m = fmax(arm_m, fmax(hypot(m->pin[i].ax_m, m->pin[i].ay_m),
                                 hypot(m->pin[i].bx_m, m->pin[i].by_m)));
    for (int k = 0; k < v->nhinge; k++)
        if (v->used[(size_t)k * columns + (size_t)scene] > unused) return false;
    return !goes(m, motion, arm_m);
}

/* ---- what is met, of small motions ---- */

void fw_verdict_reach_gives(const fw_statics_modes *modes, int most, bool rests,
                            fw_verdict_shaken *to) {
    for (int c = 0; c < to->nreach; c++) {
        fw_verdict_reach *r = &to->reach[c];
        if (rests && !r->rests) continue;
        r->gives_m_per_N = 0;
        for (int k = 0; k < modes->count && k < most; k++) {
            const fw_statics_mode *by = &modes->mode[k];
            if (by->stiffness_per_s2 > 0 && by->shape)
                r->gives_m_per_N += pow(fw_verdict_reach_by(r, modes->q, by->shape), 2) /
                                    (by->modal_mass_kg_m2 * by->stiffness_per_s2);
        }
    }
}
