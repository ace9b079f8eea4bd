/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device and one scene with everything but the numbers decided. Private to the room and its
   tests. */
#ifndef FW_STUDY_PROBLEM_H
#define FW_STUDY_PROBLEM_H
#include "study/tradeoff.h"

typedef struct fw_study_problem {
    fw_plan *plan;
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    double moved_m, accuracy;
    fw_effect_choice effects; /* with the level of hinges that all settings share */
    fw_effect_ledger ledger;
    fw_effects_loads loads;              /* with inertia */
    const fw_dynamics_motion *by_itself; /* what simulate does; NULL: not looked at */
    bool quasi_static;                   /* and that is quasi-static */
    double budget; /* instructions, by the model of costs: the same on every machine */
} fw_study_problem;

/* problem.c: the scene, closed joints, what simulate does by itself, effects and level */
fw_status fw_study_problem_open(fw_plan *plan, double budget, fw_study_problem *p);
/* the same with the level given: nothing is run */
fw_status fw_study_problem_at_level(fw_plan *plan, fw_effects_hinge_model level,
                                    fw_study_problem *p);
/* compiles the effects as `p->effects` and the accuracy say */
fw_status fw_study_problem_compile(fw_study_problem *p);

/* problem.c: one answer of a setting. method, integrator NULL and rtol 0: as simulate would */
typedef struct fw_study_tradeoff_setting {
    const char *method, *integrator;
    double rtol;
    long most_steps;   /* 0: as usual */
    bool quasi_static; /* equilibria at successive times */
} fw_study_tradeoff_setting;
/* what callgrind counts and clocks measure: nobody looks on */
fw_status fw_study_tradeoff_answer(const fw_study_problem *p, const fw_study_tradeoff_setting *s,
                                   fw_diags *diags, const fw_dynamics_motion **motion);
/* runs it with the strains watched and keeps the numbers; FW_OK whatever became of it but for
   FW_NOMEM and FW_CANCELLED. error is left to the reference */
fw_status fw_study_problem_run(fw_study_problem *p, const fw_study_tradeoff_setting *s,
                               fw_study_tradeoff_point *point);
/* largest difference of the sizes of peaks, relative to the largest of `ref` */
double fw_study_peaks_differ(const double *a, const double *ref, int n);

/* problem.c: the model of costs */
/* instructions of one right-hand side; good to a factor of 2 */
double fw_study_cost_rhs(const fw_study_problem *p, const char *method);
/* of one answer with these counts, its error estimate included */
double fw_study_cost_answer(const fw_study_problem *p, const fw_study_tradeoff_point *point);
/* of one step, for limits before it is run */
double fw_study_cost_step(const fw_study_problem *p, const char *method, const char *integrator);
/* the same answer at a tenth of the tolerance over this one */
double fw_study_cost_digit(const char *integrator);

/* study_grid.c, models.c, study_measure.c: parts of the whole */
fw_status fw_study_tradeoff_grid(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_find_reference(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_models(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_masks(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_count(fw_study_problem *p, const fw_study_tradeoff_options *o,
                                  fw_study_tradeoff *t);
fw_status fw_study_tradeoff_times(fw_study_problem *p, const fw_study_tradeoff_options *o,
                                  fw_study_tradeoff *t);

#endif
