/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Verdicts of random devices near their limit at several accuracies: does a looser one decide
   otherwise?

   accuracy_verdicts FROM COUNT [usual]    a row per device: SEED,DECISIONS,UTILISATION, as soon as it is judged; usual: at 1e-3 alone

   DECISIONS: a letter for 1e-1, 1e-2 .. 1e-6 and, last, 1e-8: a accepted, i inconclusive, r
   rejected,
   - no verdict. UTILISATION: of the governing hinge at 1e-8 (usual: at 1e-3). The devices are those of
   test_hard_verdict.c; a device without a verdict at the usual accuracy has no row. */
#include "verdict/random_device.h"
#include <stdlib.h>

static const double accuracies[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8};
enum { ACCURACIES = sizeof accuracies / sizeof *accuracies };

static void one(uint64_t seed, bool usual) {
    fw_arena *arena = fw_arena_new(0);
    double by, used = (double)NAN;
    if (!arena) exit(6);
    if (device_aimed(arena, seed, &by)) {
        const char *xml = device_describe(arena, seed, by), *message;
        char letters[ACCURACIES + 1] = "";
        for (int i = 0; i < ACCURACIES; i++) {
            fw_verdict v;
            letters[i] = '-';
            if (usual && accuracies[i] != 1e-3) continue;
            if (device_judge(arena, xml, accuracies[i], &v, &message) != FW_OK) continue;
            letters[i] = *fw_verdict_decision_text(v.decision);
            if (v.governing != FW_NONE) used = v.hinge[v.governing].utilisation;
        }
        printf("%llu,%s,%.6f\n", (unsigned long long)seed, letters, used);
        fflush(stdout); /* a device takes seconds: who waits sees how far it is */
    }
    fw_arena_free(arena);
}

int main(int argc, char **argv) {
    const bool usual = argc == 4 && strcmp(argv[3], "usual") == 0;
    if (argc != 3 && !usual) return 2;
    uint64_t from = strtoull(argv[1], NULL, 10);
    for (int i = 0; i < atoi(argv[2]); i++)
        one(from + (uint64_t)i, usual);
    return 0;
}
