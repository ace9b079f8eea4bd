/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/fatigue.h"
#include <math.h>

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
   utilisation_is_amplitude_over_allowable
 */
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
                                fw_maths_turning root[2], double Pa_per_strain, double times,
                                fw_verdict_fatigue *out) {
    *out = (fw_verdict_fatigue){0};
    for (int side = 0; side < 2; side++) {
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
