/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CPU time of whole calls beside each other: the reference six-bar at --accuracy 1e-1 .. 1e-8, in
   turn, so that what else the processor does meets all of them alike. One process is one round;
   only ratios within a round, and their median over many, are worth showing (run).

   accuracy_times    a row per accuracy: ACCURACY,CPU_MS (the median of some calls) */
#include "dynamics/models.h"
#include "measure.h"

enum { ACCURACIES = 8, CALLS = 15 };

int main(void) {
    fw_arena *arena = fw_arena_new(0);
    static double ms[ACCURACIES][CALLS];
    if (!arena) return 6;
    rig r = rig_six_bar(arena, false);
    for (int c = -3; c < CALLS; c++) /* the first three warm up */
        for (int a = 0; a < ACCURACIES; a++) {
            fw_mark mark = fw_arena_mark(arena);
            fw_diags diags = fw_diags_new(arena);
            const fw_dynamics_motion *m = NULL;
            const fw_dynamics_motion_options o = {
                .accuracy = pow(10, -(a + 1)), .samples = 11, .effects = {.mode = FW_EFFECTS_ALL}};
            double began = cpu_seconds();
            if (fw_dynamics_simulate(arena, &r.m, &r.scene, &o, &diags, &m) != FW_OK) return 7;
            if (c >= 0) ms[a][c] = 1e3 * (cpu_seconds() - began);
            fw_arena_rewind(arena, mark);
        }
    for (int a = 0; a < ACCURACIES; a++) {
        qsort(ms[a], CALLS, sizeof ms[a][0], by_size);
        printf("%.0e,%.6f\n", pow(10, -(a + 1)), ms[a][CALLS / 2]);
    }
    fw_arena_free(arena);
    return 0;
}
