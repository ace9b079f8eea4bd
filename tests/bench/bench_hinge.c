/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one evaluation of a hinge costs on each level: thread CPU time, median and least of rounds.
   Closed form and law in ns: inputs change from call to call and every result is used. The
   geometrically exact beam in us: an arc of 270 degrees (r = 100 um, t = 8 um) and a leaf of its
   length, a loop of rotations up to 10 degrees and forces up to 100 uN; cold from the unloaded
   beam, warm from the state a hundredth of the loop before. Tolerance 1e-8.

   cmake --build DIR --target bench_hinge && DIR/tests/bench/bench_hinge */
#include "flexure/beam.h"
#include "flexure/finite.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 21 };

typedef struct hinge {
    fw_flexure_input in;
    fw_flexure_result closed;
    fw_flexure_hinge_law law;
    fw_flexure_hinge_rest rest;
    fw_flexure_beam_piece piece;
    fw_flexure_beam beam;
    fw_flexure_elastica *e;
    double wrench[3], way[100][3]; /* way: twists of a loop of rotation and force */
    double used, worst;            /* worst: of the errors told */
    long passes, calls;
    int failed;
} hinge;

static double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void closed_form(hinge *h, long n) {
    fw_flexure_result out;
    for (long i = 0; i < n; i++) {
        h->in.width_m = 8e-6 + 1e-9 * (double)(i & 63);
        fw_flexure_closed_form(&h->in, &out);
        h->used += out.stiffness_Nm_per_rad + out.strain_per_rad + out.kx_N_per_m + out.ky_N_per_m;
    }
}

static void law_slopes(hinge *h, long n) {
    fw_flexure_hinge_at at;
    for (long i = 0; i < n; i++) {
        fw_flexure_hinge_law_slopes(&h->law, &h->rest, 1e-3 * (double)(i & 255), &at);
        h->used += at.kx_N_per_m.slope + at.ky_N_per_m.slope + at.drift_m.slope;
    }
}

static void law_curves(hinge *h, long n) {
    fw_flexure_hinge_at at;
    for (long i = 0; i < n; i++) {
        fw_flexure_hinge_law_at(&h->law, 1e-3 * (double)(i & 255), &at);
        h->used += at.kx_N_per_m.curve + at.ky_N_per_m.curve + at.drift_m.curve;
    }
}

static void look(hinge *h, const fw_flexure_elastica_result *at) {
    h->used += at->wrench[0] + at->twist[1] + at->stiffness[0][0];
    h->worst = fmax(h->worst, at->error);
    h->passes += at->passes;
    h->calls++;
    h->failed += at->code != FW_ELASTICA_OK;
}

static void loop(hinge *h, long n, bool warm, bool wrench) {
    fw_flexure_elastica_result at;
    for (long i = 0; i < n; i++) {
        double a = 0.02 * M_PI * (double)(i % 100), c = cos(a), s = sin(a);
        if (wrench) {
            const double load[3] = {h->wrench[0] * s, h->wrench[1] * c, h->wrench[2] * s};
            fw_flexure_elastica_of_wrench(h->e, load, 1e-8, warm, &at);
        } else {
            fw_flexure_elastica_of_twist(h->e, h->way[i % 100], 1e-8, warm, &at);
        }
        look(h, &at);
    }
}

static void twist_cold(hinge *h, long n) {
    loop(h, n, false, false);
}
static void twist_warm(hinge *h, long n) {
    loop(h, n, true, false);
}
static void wrench_cold(hinge *h, long n) {
    loop(h, n, false, true);
}
static void wrench_warm(hinge *h, long n) {
    loop(h, n, true, true);
}

static void compliance(hinge *h, long n) {
    fw_flexure_beam_linear out;
    for (long i = 0; i < n; i++) {
        fw_flexure_beam_compliance(&h->beam, &out);
        h->used += out.c[1][1];
    }
}

static void peak(hinge *h, long n) {
    fw_flexure_elastica_state out;
    for (long i = 0; i < n; i++) {
        fw_flexure_elastica_peak_strain(h->e, &out);
        h->used += out.strain[0];
    }
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void measure(const char *name, void (*run)(hinge *, long), hinge *h, long n, double unit) {
    double ns[ROUNDS];
    h->worst = 0;
    h->passes = h->calls = 0;
    run(h, n);
    for (int r = 0; r < ROUNDS; r++) {
        double began = now_ns();
        run(h, n);
        ns[r] = (now_ns() - began) / (double)n;
    }
    qsort(ns, ROUNDS, sizeof *ns, by_size);
    printf("%-44s %8.2f %8.2f %s", name, ns[ROUNDS / 2] / unit, ns[0] / unit,
           unit > 1 ? "us" : "ns");
    if (h->calls)
        printf("   %.1f passes, error told <= %.1e", (double)h->passes / (double)h->calls,
               h->worst);
    printf("\n");
}

static bool set_up(hinge *h, fw_arena *arena, bool leaf) {
    double r = 100e-6, angle = 1.5 * M_PI;
    h->in = (fw_flexure_input){.kind = leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                               .length_m = r * angle,
                               .angle_rad = angle,
                               .radius_m = r,
                               .width_m = 8e-6,
                               .fillet_m = 4e-6,
                               .depth_m = 50e-6,
                               .youngs_Pa = 169e9,
                               .poisson = 0.22,
                               .strength_Pa = 500e6,
                               .safety_factor = 1};
    fw_flexure_closed_form(&h->in, &h->closed);
    fw_flexure_hinge_law_of(&h->in, &h->closed, &h->law);
    h->rest = fw_flexure_hinge_rest_of(&h->law);
    fw_flexure_beam_of_flexure(&h->in, &h->closed, &h->piece, &h->beam);
    if (fw_flexure_elastica_new(arena, &h->beam, NULL, false, &h->e)) return false;
    h->wrench[0] = 0.17 * h->closed.stiffness_Nm_per_rad;
    h->wrench[1] = h->wrench[2] = 100e-6;
    for (int i = 0; i < 100; i++) {
        fw_flexure_elastica_result at;
        double a = 0.02 * M_PI * i;
        const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                               {0.17 * sin(a), 1e-4 * cos(a), 1e-4 * sin(a)}};
        fw_flexure_elastica_solve(h->e, &task, 1e-10, false, &at);
        if (at.code > FW_ELASTICA_ROUGH) return false;
        for (int k = 0; k < 3; k++)
            h->way[i][k] = at.twist[k];
    }
    return true;
}

static void measure_beam(hinge *h) {
    measure("exact beam, wrench of a twist, cold", twist_cold, h, 2000, 1e3);
    measure("exact beam, wrench of a twist, warm", twist_warm, h, 2000, 1e3);
    measure("exact beam, twist of a wrench, cold", wrench_cold, h, 2000, 1e3);
    measure("exact beam, twist of a wrench, warm", wrench_warm, h, 2000, 1e3);
    measure("exact beam, peak strain after a solution", peak, h, 200, 1e3);
}

int main(void) {
    static hinge h[2];
    fw_arena *arena = fw_arena_new(0);
    if (!arena || !set_up(&h[0], arena, false) || !set_up(&h[1], arena, true)) return 1;
    printf("%-44s %8s %8s\n", "arc", "median", "least");
    measure("closed form with corrections", closed_form, h, 200000, 1);
    measure("law at finite rotation, values and slopes", law_slopes, h, 200000, 1);
    measure("the same with second derivatives", law_curves, h, 200000, 1);
    measure("compliance of the beam, W", compliance, h, 500, 1e3);
    measure_beam(&h[0]);
    printf("leaf\n");
    measure_beam(&h[1]);
    fw_arena_free(arena);
    int failed = h[0].failed + h[1].failed;
    if (failed) printf("%d did not reach the tolerance\n", failed);
    return failed || !isfinite(h[0].used + h[1].used);
}
