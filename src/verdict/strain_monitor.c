/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains of all hinges followed along a motion: their peaks, and the cycles that fatigue
   counts. */
#include "verdict/strain.h"
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
    fw_verdict_hinge_load load = fw_verdict_hinge_load_at(
        m, k, now->q, now->angle_rad[hinge->pin], now->reaction_N + 2 * hinge->pin, now->hinge);
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
}

void fw_verdict_strain_monitor_record(void *context, const fw_dynamics_instant *now) {
    fw_verdict_strain_monitor *w = context;
    if (w->probe) fw_probe_monitor_record(w->probe, now);
    if (now && now->hinge == FW_HINGE_ELASTICA && !w->beam && !w->no_memory)
        w->no_memory = make_beams(w) != FW_OK;
    if (w->bending.arm) fw_verdict_bending_record(&w->bending, w->mechanism, now);
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
    for (int i = 0; w->bending.arm && i < FW_THIRDS; i++)
        fw_verdict_bending_record(&w->bending, w->mechanism, &third[i]);
    return true;
}

/* ---- fatigue ---- */

/* D = times sum n_i/N(factor sigma_ar,i),  sigma_ar = sqrt((sigma_a + |sigma_m|) sigma_a)
   in: cycles of stress, Pa; out: 1, and it fails at 1 by the data; linear, without order of loads:
   sums from 0.3 to 3 at failure are usual. Cost: two pow a cycle
   source: M. A. Miner, J. Appl. Mech. 12 (1945) A159; test_fatigue.c miner_of_one_amplitude */
double fw_verdict_miner(const fw_flexure_strain_life *law, const fw_maths_cycle *cycle, size_t n,
                        double times, double factor) {
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double a = fw_flexure_equivalent_amplitude_Pa(0.5 * cycle[i].range, cycle[i].mean);
        sum += cycle[i].count / fw_flexure_strain_life_cycles(law, factor * a);
    }
    return times * sum;
}

/* D rises with the factor, on logarithms nearly as a line: secant, kept inside its bracket. One
   step where the law is Basquin's alone. Test: test_fatigue.c
   utilisation_is_amplitude_over_allowable */
double fw_verdict_fatigue_utilisation(const fw_flexure_strain_life *law,
                                      const fw_maths_cycle *cycle, size_t n, double times) {
    double x = 0, y = log(fw_verdict_miner(law, cycle, n, times, 1)), slope = -1 / law->exponent;
    double low = -(double)INFINITY, high = (double)INFINITY; /* of ln factor */
    if (!isfinite(y)) return y > 0 ? y : 0;
    for (int i = 0; i < 100 && fabs(y) > 1e-12; i++) {
        if (y < 0)
            low = x;
        else
            high = x;
        double next = x - y / slope;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (!isfinite(next) || next == x) break;
        double there = log(fw_verdict_miner(law, cycle, n, times, exp(next)));
        if (!isfinite(there)) break;
        double secant = (there - y) / (next - x);
        if (secant > 0) slope = secant;
        x = next;
        y = there;
    }
    return exp(-x);
}

fw_status fw_verdict_fatigue_of(fw_arena *arena, const fw_flexure_strain_life *law,
                                fw_maths_turning root[FW_FACES], double Pa_per_strain, double times,
                                fw_verdict_fatigue *out) {
    *out = (fw_verdict_fatigue){0};
    for (int side = 0; side < FW_FACES; side++) {
        fw_maths_turning *r = &root[side];
        fw_maths_turning_end(r, arena);
        if (r->failed) return FW_NOMEM;
        double *work;
        fw_maths_cycle *cycle;
        FW_NEED(work = fw_arena_array(arena, double, 2 * r->count + 1));
        FW_NEED(cycle = fw_arena_array(arena, fw_maths_cycle, r->count + 1));
        size_t n = fw_maths_rainflow_repeating(r->value, r->count, work, cycle);
        double counted = 0;
        for (size_t i = 0; i < n; i++) {
            cycle[i].range *= Pa_per_strain;
            cycle[i].mean *= Pa_per_strain;
            counted += cycle[i].count;
        }
        double used = fw_verdict_fatigue_utilisation(law, cycle, n, times);
        if (!(used > out->utilisation)) continue;
        *out = (fw_verdict_fatigue){used, fw_verdict_miner(law, cycle, n, times, 1), counted};
    }
    return FW_OK;
}
