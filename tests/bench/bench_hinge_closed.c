/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one evaluation of a hinge costs: ns of thread CPU time, least and median of interleaved
   rounds. Every evaluation waits for the one before it: its result enters the next one's input.
   Inputs vary, so that branches are taken as they come. All of a result is worked out, the estimate
   of its error too. `bench_hinge_closed CASE COUNT` evaluates one case (from 0) so many times and
   says nothing: what valgrind counts for two counts gives the instructions of one evaluation. */
#include "flexure/finite.h"
#include "flexure/flexure.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 31, REPEAT = 200000 };
static int repeat = REPEAT;

static double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static const fw_flexure_input h1 = {.kind = FW_FLEXURE_CSFH,
                                    .length_m = 150e-6 * M_PI,
                                    .angle_rad = 1.5 * M_PI,
                                    .radius_m = 100e-6,
                                    .width_m = 8e-6,
                                    .fillet_m = 4e-6,
                                    .depth_m = 50e-6,
                                    .youngs_Pa = 169e9,
                                    .poisson = 0.22,
                                    .strength_Pa = 1e9,
                                    .safety_factor = 1};

static double whole(bool crystal) {
    fw_flexure_input in = h1;
    if (crystal) in.crystal = fw_crystal_cubic(165.7e9, 63.9e9, 79.6e9, 0.3);
    double carry = 0;
    for (int i = 0; i < repeat; i++) {
        fw_flexure_result out;
        in.width_m = 8e-6 + 1e-12 * (i & 255) + 1e-30 * carry;
        fw_flexure_closed_form(&in, &out);
        carry = out.stiffness_Nm_per_rad;
    }
    return carry;
}

static double part(bool crystal) {
    fw_flexure_input in = h1;
    if (crystal) in.crystal = fw_crystal_cubic(165.7e9, 63.9e9, 79.6e9, 0.3);
    fw_flexure_shape shape;
    fw_flexure_shape_of(&in, &shape);
    double carry = 0;
    for (int i = 0; i < repeat; i++) {
        fw_flexure_result out;
        in.depth_m = 50e-6 + 1e-12 * (i & 255) + 1e-30 * carry;
        fw_flexure_closed_form_at(&shape, &in, &out);
        carry = out.stiffness_Nm_per_rad;
    }
    return carry;
}

static double law(int what) {
    fw_flexure_result out;
    fw_hinge_law l;
    fw_flexure_closed_form(&h1, &out);
    fw_hinge_law_of(&h1, &out, &l);
    const fw_hinge_rest rest = fw_hinge_rest_of(&l);
    double carry = 0;
    for (int i = 0; i < repeat; i++) {
        fw_hinge_at at;
        double th = 0.001 * ((i & 511) - 256) + 1e-30 * carry;
        if (what == 2) {
            double twist[3] = {th, 1e-7, 2e-7}, wrench[3], tangent[3][3];
            fw_hinge_law_wrench(&l, &rest, twist, wrench, tangent);
            carry = wrench[1] + tangent[0][1];
            continue;
        }
        if (what)
            fw_hinge_law_at(&l, th, &at);
        else
            fw_hinge_law_slopes(&l, &rest, th, &at);
        carry = at.kx_N_per_m.slope + at.drift_m.slope + at.ky_N_per_m.value;
    }
    return carry;
}

static double run(int which) {
    switch (which) {
    case 0:
    case 1:
        return whole(which == 1);
    case 2:
    case 3:
        return part(which == 3);
    default:
        return law(which - 4);
    }
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    static const char *const name[] = {
        "closed form, outline included",      "closed form of a crystal, outline included",
        "closed form, outline at hand",       "closed form of a crystal, outline at hand",
        "finite rotation, values and slopes", "finite rotation, second derivatives too",
        "finite rotation, wrench and tangent"};
    enum { CASES = sizeof name / sizeof name[0] };
    static double ns[CASES][ROUNDS];
    volatile double sink = 0;
    if (argc > 2) {
        repeat = atoi(argv[2]);
        sink = run(atoi(argv[1]));
        return 0;
    }
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < CASES; i++) {
            double began = now_ns();
            sink = sink + run(i);
            ns[i][round] = (now_ns() - began) / REPEAT;
        }
    for (int i = 0; i < CASES; i++) {
        qsort(ns[i], ROUNDS, sizeof ns[i][0], by_size);
        printf("%-45s %7.1f ns least %7.1f ns median\n", name[i], ns[i][0], ns[i][ROUNDS / 2]);
    }
    return 0;
}
