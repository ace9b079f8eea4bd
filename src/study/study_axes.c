/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a device is among all of a study, for response surfaces (study_fitted.c). Inputs that are chosen go by the share of
   their range.

   Of what is left to chance a device has the values of its settings and, of its flow, the state that they make
   (fw_verdict_fabrication): how far edges stand out, how much walls flare, thickness and modulus against what is drawn.
   Whatever differs in a flow, and wherever on the wafer the die is, the device is a function of these four numbers alone. */
#include "study/study_parts.h"
#include "verdict/verdict_fabrication.h"
#include <math.h>
#include <string.h>

enum { STATE = 4 };

static int chances(const fw_study *study) {
    return study->nsetting + (study->asked->judge == FW_JUDGE_DIE ? STATE : 0);
}

static void chance_of(const fw_study *study, const fw_study_sample *sample, double *at) {
    const int first = study->nvary + study->nsetting;
    if (study->nsetting > 0)
        memcpy(at, sample->value + study->nvary, (size_t)study->nsetting * sizeof *at);
    if (study->asked->judge != FW_JUDGE_DIE) return;
    const fw_verdict_variant_verdict *v = &study->plan->verdict.variant[0];
    const fw_verdict_fabrication made =
        fw_verdict_fabrication_at(v->input, v->ninput, sample->value + first);
    const double state[STATE] = {made.edge_m, made.flare_m, made.thickness_ratio,
                                 made.youngs_ratio};
    memcpy(at + study->nsetting, state, sizeof state);
}

void fw_study_axes_place(const fw_study_axes *axes, const fw_study *study,
                         const fw_study_sample *sample, double *z) {
    const int vary = study->nvary;
    for (int v = 0; v < vary; v++)
        z[v] = 2 * fw_study_input_share(&study->input[v], sample->value[v]) - 1;
    chance_of(study, sample, axes->chance);
    for (int a = 0; a < axes->n; a++) {
        const fw_study_chance_axis *x = &axes->axis[a];
        const double low = x->low.value[0], high = x->high.value[0];
        z[vary + a] = 2 * (axes->chance[x->number] - low) / (high - low) - 1;
    }
}

/* keeps the outermost; way: 1 the largest, -1 the least */
static void keep_end(fw_study_outer *e, double value, long at, int way) {
    for (int i = 0; i < FW_STUDY_FARTHEST; i++) {
        if (e->at[i] >= 0 && way * (value - e->value[i]) <= 0) continue;
        memmove(e->value + i + 1, e->value + i, (size_t)(FW_STUDY_FARTHEST - 1 - i) * sizeof value);
        memmove(e->at + i + 1, e->at + i, (size_t)(FW_STUDY_FARTHEST - 1 - i) * sizeof at);
        e->value[i] = value, e->at[i] = at;
        return;
    }
}

/* Each goes from -1 to 1 between the devices that have least and most of it. These and some beside them are judged first: no
   device that is told lies beyond, and what a surface misses at the ends is seen by others near by. One that is the same in
   all devices is left out. */
fw_status fw_study_axes_find(const fw_study *study, const fw_study_points *points,
                             fw_study_sample *room, fw_study_axes *out) {
    const int n = chances(study);
    *out = (fw_study_axes){.n = 0};
    FW_NEED(out->axis = fw_arena_array(study->arena, fw_study_chance_axis, (size_t)n));
    FW_NEED(out->chance = fw_arena_array(study->arena, double, (size_t)n + 1));
    for (int i = 0; i < n; i++)
        for (int k = 0; k < FW_STUDY_FARTHEST; k++)
            out->axis[i].low.at[k] = out->axis[i].high.at[k] = -1;
    for (long k = 0; n > 0 && k < points->n; k++) {
        if (fw_cancel_requested(study->options.cancel)) return FW_CANCELLED;
        FW_TRY(points->at(points->context, k, room));
        chance_of(study, room, out->chance);
        for (int i = 0; i < n; i++) {
            keep_end(&out->axis[i].low, out->chance[i], k, -1);
            keep_end(&out->axis[i].high, out->chance[i], k, 1);
        }
    }
    for (int i = 0; i < n; i++) {
        const double low = out->axis[i].low.value[0], high = out->axis[i].high.value[0];
        if (!(high - low > 1e-12 * fabs(high))) continue;
        out->axis[out->n] = out->axis[i];
        out->axis[out->n++].number = i;
    }
    return FW_OK;
}
