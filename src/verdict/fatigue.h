/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fatigue of a motion that is repeated. Private to the room and its tests. */
#ifndef FW_VERDICT_FATIGUE_H
#define FW_VERDICT_FATIGUE_H
#include "flexure/limit.h"
#include "maths/rainflow.h"

typedef struct fw_verdict_fatigue {
    double utilisation; /* factor on all stresses at which the repetitions would just be lasted, to
                           the power -1; no safety factor */
    double damage;      /* Miner's sum at the stresses as they are */
    double cycles;      /* counted in one repetition */
} fw_verdict_fatigue;

/* Miner's sum of n cycles of stress (Pa), `times` over, all stresses times `factor` */
double fw_verdict_miner(const fw_flexure_strain_life *law, const fw_maths_cycle *cycle, size_t n,
                        double times, double factor);
/* x with fw_verdict_miner(..., 1/x) = 1; 0: nothing is stressed */
double fw_verdict_fatigue_utilisation(const fw_flexure_strain_life *law,
                                      const fw_maths_cycle *cycle, size_t n, double times);
/* the worse of both roots. root: turning points of their strain, ended here; Pa_per_strain: what
   makes stresses of them */
fw_status fw_verdict_fatigue_of(fw_arena *arena, const fw_flexure_strain_life *law,
                                fw_maths_turning root[2], double Pa_per_strain, double times,
                                fw_verdict_fatigue *out);

#endif
