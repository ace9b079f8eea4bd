/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/stages.h"
#include "study/problem.h"
#include <math.h>

static const double usual_budget_s = 20;

const char *fw_study_count_by_text(fw_study_count_by by) {
    static const char *const text[] = {"model", "scaled", "callgrind"};
    return text[by];
}

/* what simulate does by itself is the first point; where that is a row of equilibria its error will
   hold what inertia does */
static fw_status own(fw_study_problem *p, fw_study_tradeoff *t) {
    const fw_study_tradeoff_setting s = {.row = p->row};
    FW_NEED(t->point = fw_arena_array(p->arena, fw_study_tradeoff_point, 1));
    t->npoint = 1;
    FW_TRY(fw_study_problem_run(p, &s, &t->point[0]));
    if (t->point[0].state == FW_TRADEOFF_DONE) return FW_OK;
    fw_diag_error(&p->plan->diags, 290, p->scene->place, "scene %s: %s",
                  p->scene->name ? p->scene->name : "(unnamed)", t->point[0].why);
    return FW_SOLVER;
}

static void say(const fw_study_problem *p, const fw_study_tradeoff *t) {
    fw_diags *d = &p->plan->diags;
    const fw_study_tradeoff_reference *r = &t->reference;
    if (t->instructions_why)
        fw_diag_note(
            d, 291, p->scene->place,
            "instructions were not counted (%s): costs are right-hand sides times what one "
            "is known to take, good to a factor of two",
            t->instructions_why);
    if (!r->run[1])
        fw_diag_warning(d, 292, p->scene->place,
                        "there is no second run at a tight tolerance to compare the reference "
                        "with, so the stated errors are unconfirmed; a larger --budget may "
                        "allow one");
    else if (!r->independent)
        fw_diag_warning(
            d, 292, p->scene->place,
            "the two reference runs share a method or an integrator with each other or with "
            "what is measured (%s + %s, %s + %s): an error of that method or integrator would "
            "not be noticed",
            r->run[0]->method, r->run[0]->integrator, r->run[1]->method, r->run[1]->integrator);
}

fw_status fw_study_tradeoff_run(fw_plan *plan, const fw_study_tradeoff_options *options,
                                const fw_study_tradeoff **out) {
    fw_study_problem p;
    double budget = options->budget_s > 0 ? options->budget_s : usual_budget_s;
    fw_study_tradeoff *t = fw_arena_one(plan->arena, fw_study_tradeoff);
    FW_NEED(t);
    *out = NULL;
    FW_TRY(fw_study_problem_open(plan, budget, &p));
    *t = (fw_study_tradeoff){.mechanism = p.mechanism,
                             .scene = p.scene,
                             .device = plan->device->name,
                             .flow = p.mechanism->variant->flow,
                             .accuracy = p.accuracy,
                             .level = fw_effects_hinge_model_text(p.effects.hinge),
                             .level_why = p.by_itself->ledger.hinge.why,
                             .duration_s = p.scene->duration_s,
                             .chosen_why = p.by_itself->reason,
                             .row = p.row,
                             .budget_s = budget,
                             .honesty = {(double)NAN, (double)NAN, (double)NAN}};
    FW_TRY(own(&p, t));
    FW_TRY(fw_study_tradeoff_find_reference(&p, t));
    if (!t->rows_only) FW_TRY(fw_study_tradeoff_grid(&p, t));
    fw_study_tradeoff_errors(t);
    FW_TRY(fw_plan_compute_flows(plan));
    FW_TRY(fw_study_tradeoff_models(&p, t));
    FW_TRY(fw_study_tradeoff_masks(&p, t));
    FW_TRY(fw_study_tradeoff_count(&p, options, t));
    FW_TRY(fw_study_tradeoff_judge(plan->arena, t));
    FW_TRY(fw_study_tradeoff_times(&p, options, t));
    say(&p, t);
    *out = t;
    return FW_OK;
}
