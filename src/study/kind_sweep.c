/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep: every response at each of many points, chosen beforehand. Points are numbered; point i of a grid
   has the digits of i in mixed radix, the last input the fastest. */
#include "chance/random.h"
#include "study/study_parts.h"
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

/* a grid of more than SWEEP_MOST: more than that */
long fw_study_count_sweep(const fw_study *study) {
    long n = 1;
    if (study->asked->points == FW_POINTS_SOBOL)
        return study->asked->samples > 0 ? study->asked->samples : SOBOL_USUAL;
    if (study->asked->points == FW_POINTS_LIST) return fw_study_input_steps(&study->input[0]);
    for (int v = 0; v < study->ninput && n <= SWEEP_MOST; v++)
        n *= fw_study_input_steps(&study->input[v]);
    return n;
}

static fw_status check_points(fw_study *study, long n) {
    if (n > SWEEP_MOST)
        return fw_diag_error(&study->diags, 490, study->asked->place,
                             "the grid has more than %d points; take fewer steps, or "
                             "points=\"sobol\" with so many samples as are wanted",
                             (int)SWEEP_MOST);
    for (int v = 0; study->asked->points == FW_POINTS_LIST && v < study->ninput; v++) {
        const fw_study_input *in = &study->input[v];
        int steps = fw_study_input_steps(in);
        if (steps != n)
            return fw_diag_error(&study->diags, 490, in->place,
                                 "points=\"list\" takes the values of all inputs side by side, and "
                                 "'%s' has %d where '%s' has %ld; give each as many",
                                 in->what, steps, study->input[0].what, n);
    }
    return FW_OK;
}

fw_status fw_study_kind_sweep(fw_study *study, fw_study_result *result) {
    sweep s = {.study = study, .n = fw_study_count_sweep(study)};
    (void)result;
    FW_TRY(check_points(study, s.n));
    if (study->asked->points == FW_POINTS_SOBOL)
        FW_TRY(fw_chance_sobol_new(study->arena, (size_t)study->ninput,
                                   (uint64_t)study->asked->seed, &s.sobol));
    const fw_study_work work = {.n = s.n, .fill = fill, .context = &s};
    return fw_study_pool_run(study, &work);
}
