/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smooth pieces of a scene, between the breaks of all laws, and the longest steps that leap
   over nothing in them. */
#include "dynamics/run.h"
#include "base/sort.h"
#include "quantity/law_kind.h"
#include <math.h>

static int law_count(const fw_dynamics_problem *problem, const fw_effects_loads *loads) {
    int count = loads->ntimed + problem->mechanism->ndriver + (loads->stretch.law != NULL);
    for (int i = 0; i < loads->nelement; i++)
        count += loads->element[i].laws;
    return count;
}

/* the i-th law of all: of timed loads, drivers, the stretching ground, elements; *coordinate: it
   drives a joint. NULL: constant */
static const fw_quantity_law *law_of(const fw_dynamics_problem *problem,
                                     const fw_effects_loads *loads, int i, bool *coordinate) {
    int drivers = problem->mechanism->ndriver, moving = drivers + (loads->stretch.law != NULL);
    *coordinate = i >= loads->ntimed && i < loads->ntimed + moving;
    if (i < loads->ntimed) return loads->timed[i].law;
    if (*coordinate && i == loads->ntimed + drivers) return loads->stretch.law;
    if (*coordinate) return &problem->mechanism->driver[i - loads->ntimed].law;
    const fw_effects_force_element *e = loads->element;
    for (i -= loads->ntimed + moving; i >= e->laws; e++)
        i -= e->laws;
    return e->law[i];
}

/* the breaks of every law, one law after the other (at, counted), and the strides between them */
static fw_status look_at_laws(fw_dynamics_problem *problem, const fw_effects_loads *loads,
                              double *at, int count) {
    int laws = law_count(problem, loads), have = 0;
    double end = problem->scene->duration_s;
    bool coordinate;
    FW_NEED(problem->stride =
                fw_arena_array(problem->arena, fw_quantity_law_strides, (size_t)laws));
    FW_NEED(problem->stride_row = fw_arena_array(problem->arena, int, (size_t)laws));
    for (int i = 0; i < laws; i++) {
        const fw_quantity_law *law = law_of(problem, loads, i, &coordinate);
        fw_quantity_law_strides *own = &problem->stride[problem->nstride];
        int breaks = fw_quantity_law_breaks_of(law, end, at + have, count - have);
        fw_sort_doubles(at + have, (size_t)breaks);
        FW_TRY(fw_quantity_law_look(problem->arena, law, coordinate, end, at + have, breaks, own));
        have += breaks;
        bool limits = false;
        for (int k = 0; k < own->n; k++)
            if (isfinite(own->most_s[k])) limits = true;
        if (limits && !(fw_quantity_law_wave_of(law).fastest_Hz > 0)) problem->sudden = true;
        if (limits) problem->nstride++;
    }
    return FW_OK;
}

/* longest scaled step from scaled time t on that leaps over nothing in any law, each of whose
   strides may be `factor` times as long */
static double stride(const fw_dynamics_problem *problem, double factor, double t) {
    double most = (double)INFINITY, unit = problem->model->scale.time_s;
    for (int i = 0; i < problem->nstride; i++)
        most = fmin(most, fw_quantity_law_stride(&problem->stride[i], factor, t * unit,
                                                 &problem->stride_row[i]));
    return most / unit;
}

fw_status fw_dynamics_run_pieces(fw_dynamics_problem *problem, const fw_effects_loads *loads) {
    int laws = law_count(problem, loads), have = 0;
    double end = problem->scene->duration_s, unit = problem->model->scale.time_s;
    bool coordinate;
    for (int i = 0; i < laws; i++)
        have += fw_quantity_law_breaks_of(law_of(problem, loads, i, &coordinate), end, NULL, 0);
    double *at;
    FW_NEED(at = fw_arena_array(problem->arena, double, (size_t)have + 1));
    FW_TRY(look_at_laws(problem, loads, at, have));
    if (have > 1) fw_sort_doubles(at, (size_t)have);
    int kept = 0;
    for (int i = 0; i < have; i++)
        if (at[i] > 0 && at[i] < end && (kept == 0 || at[i] > at[kept - 1])) at[kept++] = at[i];
    at[kept++] = end;
    for (int i = 0; i < kept; i++)
        at[i] /= unit;
    problem->end = at;
    problem->npiece = kept;
    problem->system->piece_s = 0.5 * at[0] * unit;
    return FW_OK;
}

/* ---- steps that see all of the loads ---- */

/* Longer by half in the second run, so that the difference of the two tells the error where not the
   tolerance but a law limits the steps. Without error control a step may neither end on a flank
   after a long rest nor be as long as the law bears: an eighth of the whole, and in the second run
   longer like h_fixed, by 10^(1/2). */
void fw_dynamics_run_limit_step(const fw_dynamics_controller *control, fw_maths_stepper *s,
                                double t) {
    if (control->problem->nstride == 0) return;
    s->h_max = s->row->fixed_step ? control->fixed_part * stride(control->problem, 1, t)
                                  : stride(control->problem, control->law_stride, t);
}

void fw_dynamics_run_start(const fw_dynamics_controller *control, fw_maths_stepper *s, double t,
                           const double *y, double end) {
    fw_dynamics_run_limit_step(control, s, t);
    fw_maths_stepper_start(s, t, y, end);
}
