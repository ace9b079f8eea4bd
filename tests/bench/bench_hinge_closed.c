/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one evaluation of a hinge costs: ns of thread CPU time, least and median of interleaved
   rounds. Two figures of every closed form:
     in a row   every evaluation waits for the one before: its result enters the next one's input
     in a list  64 hinges that do not wait for each other, as when all of a mechanism are judged
   Inputs vary, so that branches are taken as they come. All of a result is worked out, the estimate
   of its error too. A crystal is prepared once (fw_flexure_crystal_cubic: its moduli and the
   direction of the hinge in it), as all hinges of a material and direction share it.
   `bench_hinge_closed CASE COUNT` evaluates one case (from 0) so many times and
   says nothing: what valgrind counts for two counts gives the instructions of one evaluation. */
#include "flexure/finite.h"
#include "flexure/flexure.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 31, REPEAT = 200000 };
static int repeat = REPEAT;

enum kind { ARC, ARC_CRYSTAL, DEEP_ARC, LEAF, LEAF_CRYSTAL };

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

static fw_flexure_input hinge_of(int kind) {
    fw_flexure_input in = h1;
    if (kind == DEEP_ARC) in.depth_m = 85e-6;
    if (kind == LEAF || kind == LEAF_CRYSTAL) in.kind = FW_FLEXURE_LEAF;
    if (kind == ARC_CRYSTAL || kind == LEAF_CRYSTAL)
        in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, 0.3);
    return in;
}

static double row(int kind) {
    fw_flexure_input in = hinge_of(kind);
    double carry = 0;
    for (int i = 0; i < repeat; i++) {
        fw_flexure_result out;
        in.width_m = 8e-6 + 1e-12 * (i & 255) + 1e-30 * carry;
        fw_flexure_closed_form(&in, &out);
        carry = out.stiffness_Nm_per_rad;
    }
    return carry;
}

static double list(int kind) {
    enum { MANY = 64 };
    static fw_flexure_input in[MANY];
    static fw_flexure_result out[MANY];
    for (int i = 0; i < MANY; i++) {
        in[i] = hinge_of(kind);
        in[i].width_m = 8e-6 + 4e-12 * i;
    }
    for (int i = 0; i < repeat; i++)
        fw_flexure_closed_form(&in[i % MANY], &out[i % MANY]);
    return out[0].stiffness_Nm_per_rad;
}

static double law(int what) {
    fw_flexure_result out;
    fw_flexure_hinge_law l;
    fw_flexure_closed_form(&h1, &out);
    fw_flexure_hinge_law_of(&h1, &out, &l);
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(&l);
    double carry = 0;
    for (int i = 0; i < repeat; i++) {
        fw_flexure_hinge_at at;
        double th = 0.001 * ((i & 511) - 256) + 1e-30 * carry;
        if (what == 2) {
            double twist[3] = {th, 1e-7, 2e-7}, wrench[3], tangent[3][3];
            fw_flexure_hinge_law_wrench(&l, &rest, twist, wrench, tangent);
            carry = wrench[1] + tangent[0][1];
            continue;
        }
        if (what)
            fw_flexure_hinge_law_at(&l, th, &at);
        else
            fw_flexure_hinge_law_slopes(&l, &rest, th, &at);
        carry = at.kx_N_per_m.slope + at.drift_m.slope + at.ky_N_per_m.value;
    }
    return carry;
}

/* Forces of any size as a motion asks for them: `what` is hinges + 16 times the lanes at most. ns of one hinge. The states
   vary: rotations to 0.18 rad, pulls to a hundredth of EI/L^2, leaves and arcs by turns of 64 states */
static double bent(int what) {
    enum { STATES = 512, HINGES = 8 };
    static fw_flexure_hinge_law laws[HINGES];
    static fw_flexure_hinge_rest rests[HINGES];
    static fw_flexure_hinge_bent out[HINGES];
    static double state[HINGES][STATES][3];
    const int hinges = what % 16, widest = what / 16;
    const fw_flexure_hinge_rest *rest[HINGES];
    fw_flexure_hinge_lanes lanes;
    bool known[HINGES];
    for (int i = 0; i < hinges; i++) {
        fw_flexure_result closed;
        fw_flexure_input in = hinge_of(i % 3 == 2 ? ARC : LEAF);
        in.width_m += 1e-7 * i;
        fw_flexure_closed_form(&in, &closed);
        fw_flexure_hinge_law_of(&in, &closed, &laws[i]);
        rests[i] = fw_flexure_hinge_rest_of(&laws[i]), rest[i] = &rests[i];
        for (int k = 0; k < STATES; k++) {
            fw_flexure_hinge_at at;
            double *to = state[i][k], pull = 0.01 * sin(3 * k);
            to[0] = 0.0007 * (k - STATES / 2), to[1] = 3e-7 * sin(k);
            fw_flexure_hinge_law_at(&laws[i], to[0], &at);
            to[2] = at.drift_m.value - 0.6 * to[1] * to[1] / laws[i].length_m +
                    pull * laws[i].length_m / (8 * laws[i].bend_m_per_N) / at.ky_N_per_m.value;
        }
    }
    fw_arena *arena = fw_arena_new(0);
    if (fw_flexure_hinge_lanes_new(arena, hinges, rest, &lanes) != FW_OK) return 0;
    if (lanes.widest > widest) lanes.widest = widest;
    for (int i = 0; i < hinges; i++)
        lanes.out[i] = &out[i];
    for (int k = 0; k < repeat / hinges; k++) {
        for (int i = 0; i < hinges; i++)
            for (int c = 0; c < 3; c++)
                lanes.at[(size_t)c * lanes.stride + (size_t)i] = state[i][(k + 37 * i) % STATES][c];
        fw_flexure_hinge_lanes_bend(&lanes, known);
    }
    fw_arena_free(arena);
    return out[0].gradient[0];
}

static const struct bench_case {
    const char *name;
    double (*run)(int what);
    int what;
} cases[] = {
    {"arc, in a row", row, ARC},
    {"arc of a crystal, in a row", row, ARC_CRYSTAL},
    {"arc, in a list", list, ARC},
    {"arc of a crystal, in a list", list, ARC_CRYSTAL},
    {"arc deeper than 10 t, in a row", row, DEEP_ARC},
    {"leaf, in a row", row, LEAF},
    {"leaf of a crystal, in a row", row, LEAF_CRYSTAL},
    {"leaf, in a list", list, LEAF},
    {"leaf of a crystal, in a list", list, LEAF_CRYSTAL},
    {"finite rotation, values and slopes", law, 0},
    {"finite rotation, second derivatives too", law, 1},
    {"finite rotation, wrench and tangent", law, 2},
    {"forces of any size, one hinge", bent, 1 + 16 * 1},
    {"forces of any size, 4 hinges one by one", bent, 4 + 16 * 1},
    {"forces of any size, 4 hinges, SSE2", bent, 4 + 16 * 2},
    {"forces of any size, 4 hinges, AVX2", bent, 4 + 16 * 4},
    {"forces of any size, 6 hinges, SSE2", bent, 6 + 16 * 2},
    {"forces of any size, 6 hinges, AVX2", bent, 6 + 16 * 4},
    {"forces of any size, 6 hinges, AVX-512", bent, 6 + 16 * 8},
};

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    enum { CASES = sizeof cases / sizeof cases[0] };
    static double ns[CASES][ROUNDS];
    volatile double sink = 0;
    if (argc > 2) {
        repeat = atoi(argv[2]);
        int which = atoi(argv[1]);
        if (which < 0 || which >= CASES) return 2;
        sink = cases[which].run(cases[which].what);
        return 0;
    }
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < CASES; i++) {
            double began = now_ns();
            sink = sink + cases[i].run(cases[i].what);
            ns[i][round] = (now_ns() - began) / REPEAT;
        }
    for (int i = 0; i < CASES; i++) {
        qsort(ns[i], ROUNDS, sizeof ns[i][0], by_size);
        printf("%-45s %7.1f ns least %7.1f ns median\n", cases[i].name, ns[i][0],
               ns[i][ROUNDS / 2]);
    }
    return 0;
}
