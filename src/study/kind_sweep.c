/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep: every response at each of many points, chosen beforehand. Points are numbered; point i of a grid
   has the digits of i in mixed radix, the last input the fastest. */
#include "chance/sobol.h"
#include "study/study_parts.h"
#include "study/study_result.h"
#include <math.h>

enum { SOBOL_USUAL = 256, SWEEP_MOST = 100000000, SOBOL_DIGITS = 9 };

typedef struct sweep {
    const fw_study *study;
    fw_chance_sobol sobol;
    long n;
} sweep;

static fw_status at_grid(const fw_study *study, long k, fw_study_sample *sample) {
    for (int v = study->ninput; v-- > 0;) {
        int steps = fw_study_input_steps(&study->input[v]);
        FW_TRY(fw_study_input_step(&study->input[v], (int)(k % steps), sample->text[v],
                                   &sample->value[v]));
        k /= steps;
    }
    return FW_OK;
}

static fw_status fill(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const sweep *s = context;
    const fw_study *study = s->study;
    sample->i = k;
    *wanted = fw_study_is_due(study, k);
    if (!*wanted) return FW_OK;
    switch (study->asked->points) {
    case FW_POINTS_GRID:
        return at_grid(study, k, sample);
    case FW_POINTS_LIST:
        for (int v = 0; v < study->ninput; v++)
            FW_TRY(
                fw_study_input_step(&study->input[v], (int)k, sample->text[v], &sample->value[v]));
        return FW_OK;
    case FW_POINTS_SOBOL:
        for (int v = 0; v < study->ninput; v++)
            FW_TRY(fw_study_input_at(&study->input[v],
                                     fw_chance_sobol_uniform(&s->sobol, (uint64_t)k, (size_t)v),
                                     SOBOL_DIGITS, sample->text[v], &sample->value[v]));
        return FW_OK;
    }
    return FW_INTERNAL;
}

/* how many points there are; FW_INPUT: they do not go together */
fw_status fw_study_sweep_points(fw_study *study, long *n) {
    *n = study->asked->points == FW_POINTS_SOBOL
             ? (study->asked->samples > 0 ? study->asked->samples : SOBOL_USUAL)
             : 1;
    for (int v = 0; v < study->ninput; v++) {
        const fw_study_input *in = &study->input[v];
        int steps = fw_study_input_steps(in);
        if (study->asked->points == FW_POINTS_GRID) *n *= steps;
        if (*n > SWEEP_MOST)
            return fw_diag_error(&study->diags, 490, in->place,
                                 "the grid has more than %d points; take fewer steps, or "
                                 "points=\"sobol\" with so many samples as are wanted",
                                 (int)SWEEP_MOST);
        if (study->asked->points != FW_POINTS_LIST) continue;
        if (v == 0) *n = steps;
        if (steps != *n)
            return fw_diag_error(&study->diags, 490, in->place,
                                 "points=\"list\" takes the values of all inputs side by side, and "
                                 "'%s' has %d where '%s' has %ld; give each as many",
                                 in->what, steps, study->input[0].what, *n);
    }
    return FW_OK;
}

fw_status fw_study_kind_sweep(fw_study *study, fw_study_result *result) {
    sweep s = {.study = study};
    (void)result;
    FW_TRY(fw_study_sweep_points(study, &s.n));
    study->samples = s.n;
    if (study->asked->points == FW_POINTS_SOBOL)
        FW_TRY(fw_chance_sobol_new(study->arena, (size_t)study->ninput,
                                   (uint64_t)study->asked->seed, &s.sobol));
    const fw_study_work work = {.n = s.n, .fill = fill, .context = &s};
    return fw_study_pool_run(study, &work);
}
