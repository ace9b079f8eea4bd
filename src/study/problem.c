/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Everything but the numbers, decided once: scene, closed joints, effects, how hinges are taken. */
#include "plan/stages.h"
#include "statics/quasi.h"
#include "study/problem.h"
#include <math.h>

static const double fw_nominal_rate = 2.5e9; /* instructions a second of the budget */

fw_status fw_study_problem_compile(fw_study_problem *p) {
    FW_TRY(fw_effects_compile(p->arena, p->mechanism, p->scene, &p->effects, p->accuracy,
                              &p->plan->diags, &p->ledger, &p->loads));
    p->ledger.left_out = 0;        /* errors of the numbers, not of the model */
    p->loads.quasi_static = false; /* integrators are compared: inertia acts */
    return FW_OK;
}

static fw_status start(fw_plan *plan, fw_study_problem *p) {
    const fw_dynamics_motion_options *wanted = &plan->options.verdict.motion;
    *p = (fw_study_problem){.plan = plan,
                            .arena = plan->arena,
                            .accuracy = wanted->accuracy > 0 ? wanted->accuracy : 1e-3,
                            .effects = wanted->effects};
    return fw_plan_start(plan, &p->mechanism, &p->scene, &p->moved_m);
}

/* exact beams take some 25 000 instructions each, and several times as many as are known before */
static long beams(double budget) {
    return (long)fmax(1, 0.03 * budget / 25000);
}

static fw_status look(fw_study_problem *p, double budget) {
    fw_dynamics_motion_options o = p->plan->options.verdict.motion;
    o.moved_m = p->moved_m;
    o.samples = 1001; /* the level of hinges is looked at in the row nearest the peak */
    o.most_beams = beams(budget);
    FW_TRY(fw_statics_move_scene(p->arena, p->mechanism, p->scene, &o, &p->plan->diags,
                                 &p->by_itself));
    p->row = p->by_itself->loads->quasi_static;
    return FW_OK;
}

static fw_status something_turns(fw_study_problem *p) {
    double most = 0;
    for (int i = 0; i < p->by_itself->npin; i++)
        most = fmax(most, fabs(p->by_itself->peak[i].angle_rad));
    if (most > 1e-10) return FW_OK;
    return fw_diag_error(&p->plan->diags, 290, p->scene->place,
                         "scene %s: no joint turns, so that there is no peak deflection whose "
                         "error could be shown; choose another with --scene, or load it",
                         p->scene->name ? p->scene->name : "(unnamed)");
}

fw_status fw_study_problem_open(fw_plan *plan, double budget_s, fw_study_problem *p) {
    FW_TRY(start(plan, p));
    p->budget = budget_s * fw_nominal_rate;
    FW_TRY(look(p, p->budget));
    FW_TRY(something_turns(p));
    p->effects.hinge = p->by_itself->ledger.hinge.used;
    return fw_study_problem_compile(p);
}

fw_status fw_study_problem_at_level(fw_plan *plan, fw_effects_hinge_model level,
                                    fw_study_problem *p) {
    FW_TRY(start(plan, p));
    p->effects.hinge = level;
    return fw_study_problem_compile(p);
}
