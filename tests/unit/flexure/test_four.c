/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Many hinges by one call: each has, bit by bit, what it has alone, whatever stands beside it and
   whichever way the processor takes. */
#include "flexure/flexure.h"
#include "flexure/kinds.h"
#include "test.h"
#include <string.h>

static uint64_t seed = 0x9e3779b97f4a7c15u;

static double uniform(double low, double high) { /* xorshift */
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return low + (high - low) * (double)(seed >> 11) * 0x1p-53;
}

/* inside of what was compared with solids; edges of that range among them */
static fw_flexure_input usual_arc(bool crystal) {
    double r = uniform(30e-6, 200e-6), angle = uniform(1.0, 6.28), least = angle * r / 16;
    double t = fmin(uniform(0.02, 0.15) * r, least);
    double ratio = uniform(0, 1) < 0.2 ? 0.1 : uniform(0.1, 1.25);
    fw_flexure_input in = {.kind = FW_FLEXURE_CSFH,
                           .length_m = angle * r,
                           .angle_rad = angle,
                           .radius_m = r,
                           .width_m = t,
                           .fillet_m = fmin(fmax(ratio, 0.1 * (1 + 1e-15)) * t, 1.25 * t),
                           .depth_m = uniform(0.1, 10) * t,
                           .youngs_Pa = uniform(50e9, 200e9),
                           .poisson = uniform(0, 0.45),
                           .strength_Pa = uniform(0.1e9, 2e9),
                           .safety_factor = uniform(1, 3)};
    if (crystal)
        in.crystal =
            fw_flexure_crystal_cubic(165.7e9 * uniform(0.9, 1.1), 63.9e9, 79.6e9, uniform(-4, 4));
    return in;
}

/* of any kind: most as above, beside leaves, thick arcs, ideal ends, unknown directions, arcs of
   varying width */
static fw_flexure_input any_hinge(void) {
    fw_flexure_input in = usual_arc(uniform(0, 1) < 0.5);
    switch ((int)uniform(0, 16)) {
    case 0:
        in.kind = FW_FLEXURE_LEAF;
        break;
    case 1:
        in.width_m = 0.25 * in.radius_m;
        break;
    case 2:
        in.fillet_m = -1;
        break;
    case 3:
        in.depth_m = 14 * in.width_m;
        break;
    case 4:
        in.width_middle_m = 0.8 * in.width_m;
        break;
    case 5:
        in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, (double)NAN);
        break;
    default:
        break;
    }
    return in;
}

/* the gaps between members hold nothing; all others are written by whoever is asked */
static void same_bits(const fw_flexure_result *a, const fw_flexure_result *b) {
    assert_memory_equal(a, b, sizeof *a);
}

typedef void four_of(const fw_flexure_input *const in[4], fw_flexure_result *const out[4]);

static void four_are_four(four_of *four, bool crystal) {
    for (int i = 0; i < 20000; i++) {
        fw_flexure_input in[4];
        fw_flexure_result one, out[4];
        memset(out, 0, sizeof out), memset(&one, 0, sizeof one);
        for (int k = 0; k < 4; k++) {
            in[k] = usual_arc(crystal);
            assert_true(fw_flexure_csfh_usual(&in[k]));
        }
        four((const fw_flexure_input *const[]){in, in + 1, in + 2, in + 3},
             (fw_flexure_result *const[]){out, out + 1, out + 2, out + 3});
        for (int k = 0; k < 4; k++) {
            fw_flexure_closed_form(&in[k], &one);
            same_bits(&one, &out[k]);
        }
    }
}

static void four_at_once(void **state) {
    (void)state;
    four_are_four(fw_flexure_csfh_four, false);
    four_are_four(fw_flexure_csfh_four, true);
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx")) {
        print_message("no AVX here: csfh_four_avx.c has not run\n");
        return;
    }
    four_are_four(fw_flexure_csfh_four_avx, false);
    four_are_four(fw_flexure_csfh_four_avx, true);
#endif
}

/* rows of none to nineteen, and what follows a row stays as it was */
static void many_by_one_call(void **state) {
    enum { MOST = 20 };
    (void)state;
    for (int i = 0; i < 5000; i++) {
        fw_flexure_input in[MOST];
        fw_flexure_result out[MOST], one;
        const fw_flexure_input *from[MOST];
        fw_flexure_result *to[MOST];
        int n = i % MOST;
        memset(out, 0, sizeof out), memset(&one, 0, sizeof one);
        for (int k = 0; k < MOST; k++)
            in[k] = any_hinge(), from[k] = &in[k], to[k] = &out[k];
        fw_flexure_closed_forms(from, to, (size_t)n);
        for (int k = 0; k < n; k++) {
            fw_flexure_closed_form(&in[k], &one);
            same_bits(&one, &out[k]);
        }
        memset(&one, 0, sizeof one);
        same_bits(&one, &out[n]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(four_at_once),
                                       cmocka_unit_test(many_by_one_call)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
