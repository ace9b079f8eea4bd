/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tolerances that an accuracy needs. Private to dynamics/. */
#ifndef FW_DYNAMICS_TOLERANCE_CONTROL_H
#define FW_DYNAMICS_TOLERANCE_CONTROL_H
#include "dynamics/run.h"

typedef struct fw_dynamics_tolerances { /* of two runs */
    double looser, rtol; /* relative tolerances: of the one that is compared with, of the answer */
    double margin;       /* times the difference of both: error of the answer */
    /* likewise of peak angles, with fw_dynamics_tolerance_difference; 0: as the rest */
    double part;
} fw_dynamics_tolerances;

/* relative error of the numbers that is wanted: what the effects left out do not take */
double fw_dynamics_tolerance_wanted(const fw_dynamics_recorder *record);
/* is there a table for this integrator, and is the tolerance ours to choose? */
bool fw_dynamics_tolerance_known(const fw_dynamics_problem *problem,
                                 const fw_maths_stepper_row *row);
/* the tolerances to begin with for a relative error of `wanted` */
fw_dynamics_tolerances fw_dynamics_tolerance_start(const fw_dynamics_controller *control,
                                                   const fw_maths_stepper_row *row, double wanted);
/* the tolerance of the answer after a looser run that took so many steps */
fw_dynamics_tolerances fw_dynamics_tolerance_answer(const fw_dynamics_run *r,
                                                    fw_dynamics_tolerances tolerances, long steps);
/* the next ones where the estimate came out `off` (> 1) times too large in try number `tries` (from
   1); *reuse: the answer so far may be what is compared with */
fw_dynamics_tolerances fw_dynamics_tolerance_next(const fw_dynamics_controller *control,
                                                  fw_dynamics_tolerances tolerances, double off,
                                                  int tries, bool *reuse);
/* rad that two runs differ by, from what they do in a peak, in the largest angles up to marks, and
   in angles there */
double fw_dynamics_tolerance_difference(double peak, double sizes, double angles);
/* error of a peak over the relative error of the energies */
double fw_dynamics_tolerance_energy_ratio(long steps, long looser_steps);
/* the tightest tolerance that round-off leaves room for */
double fw_dynamics_tolerance_tightest(const fw_dynamics_problem *problem);

/* choose.c: the integrator by trial */
typedef struct fw_dynamics_integrator_trial {
    const fw_maths_stepper_row *row; /* NULL: none */
    long steps;                      /* that it may take */
} fw_dynamics_integrator_trial;
/* before (0) or after a looser run of so many steps */
fw_dynamics_integrator_trial fw_dynamics_integrator_trial_of(const fw_dynamics_controller *control,
                                                             long steps);
/* the integrator at hand won against one that took `before` steps, 0: was not tried */
fw_status fw_dynamics_integrator_trial_won(fw_dynamics_run *r, long before, long steps);

/* accuracy_report.c: estimate over what is wanted, the largest of all that counts */
double fw_dynamics_run_error_ratio(const fw_dynamics_recorder *record);
/* warns of what was not reached and of energies that do not add up; motion->tolerance */
fw_status fw_dynamics_run_report(fw_dynamics_run *r, bool enough);

#endif
