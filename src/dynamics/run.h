/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One simulation while it runs: the problem, what controls its steps, and what records them.
   Functions take the part that they need. Private to dynamics/. */
#ifndef FW_DYNAMICS_RUN_H
#define FW_DYNAMICS_RUN_H
#include "assembly/assembly.h"
#include "dynamics/dynamics.h"
#include "maths/ode.h"
#include "multibody/system.h"

/* extreme.c: angles of pins, displacements of flexures that give */
typedef struct fw_dynamics_strip { /* one of those */
    int body[2];
    double local[2][2]; /* its point in each body, scaled */
    double per_length;  /* 1 over its length */
} fw_dynamics_strip;
typedef struct fw_dynamics_peaks {
    double *start;          /* (npin of the mechanism) angle at the assembled pose */
    int *a, *b;             /* (npin) bodies */
    fw_dynamics_peak *peak; /* (npin) time scaled */
    int npin;
    double *mark_t;         /* (nmark) instants at which two runs are compared, ascending, scaled */
    double *mark;           /* (nmark x npin) angles there */
    double *size;           /* (nmark x npin) largest sizes of the angles up to there */
    bool sized;             /* those are wanted */
    fw_dynamics_peak *held; /* (npin) work */
    int nmark, nstrip;
    fw_dynamics_strip *strip; /* (nstrip) */
    double *rest;             /* (3 nbody) assembled pose, scaled */
    double displaced;         /* the largest at any step's end */
    /* the run that set the instants; NULL: this one sets them */
    const struct fw_dynamics_peaks *marked;
} fw_dynamics_peaks;
enum { FW_MARKS = 16 };
fw_status fw_dynamics_peaks_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                const fw_multibody_model *model, fw_dynamics_peaks *peaks);
double fw_dynamics_peaks_angle(const fw_dynamics_peaks *peaks, int pin, const double *y);
/* the last step up to theta_end */
void fw_dynamics_peaks_step(fw_dynamics_peaks *peaks, const fw_multibody_model *m,
                            fw_maths_stepper *s, double theta_end);
/* notes all angles at the marks that the step reaches, and the largest up to there; before
   fw_dynamics_peaks_step; final: scaled end of the scene; y (ny): work */
void fw_dynamics_peaks_mark(fw_dynamics_peaks *peaks, const fw_multibody_model *m,
                            fw_maths_stepper *s, double theta_end, double final, double *y);
/* the first mark of both runs at or behind scaled time t; FW_MARKS: none */
int fw_dynamics_peaks_first_mark(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other,
                                 double t);
/* largest difference of any angle of two runs at mark k; 0 when one of them has none */
double fw_dynamics_peaks_apart(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other,
                               int k);
/* likewise of the largest sizes of angles up to there */
double fw_dynamics_peaks_sizes_apart(const fw_dynamics_peaks *peaks, const fw_dynamics_peaks *other,
                                     int k);

/* choose.c: what is asked for by name exists */
fw_status fw_dynamics_check_options(const fw_dynamics_motion_options *options, fw_diags *diags);
fw_status fw_dynamics_check_names(const fw_dynamics_motion_options *options, fw_diags *diags,
                                  fw_dynamics_motion *motion);

/* extreme.c: what has extremes besides the angles, SI: forces of pins, forces, torques and travels
   of joints, forces or torques of drivers */
typedef struct fw_dynamics_extreme {
    double value, t; /* largest in size, with its sign; scaled time */
    double end;      /* value where the pass ends */
} fw_dynamics_extreme;

enum { FW_PLACES = 16 }; /* parts of a step at whose ends switches are looked at */

/* What is to be moved and on what terms. It is settled before the first step; from then on only the
   system moves. */
typedef struct fw_dynamics_problem {
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    const fw_dynamics_motion_options *options;
    const fw_multibody_model *model;
    fw_multibody_system *system;
    double *q0;        /* (3 nbody) assembled, SI */
    double *start;     /* (ny) scaled */
    double amplitude;  /* scaled size of the motion: the absolute tolerance is rtol times this */
    bool stretched;    /* the ground stretches, as it does under heat */
    bool idle;         /* nothing acts and nothing moves at the start: what moves is round-off */
    double most_angle; /* rad; HUGE_VAL: no end before the end */
    double uneven;     /* heaviest body over the lightest one between two joints */
    const char *why;   /* this method though none was asked for; NULL: the default, or asked for */
    double *end;       /* (npiece) scaled times at which a smooth piece ends */
    int npiece;
    fw_quantity_law_strides *stride; /* (nstride) of the laws that limit steps, s */
    int *stride_row;                 /* (nstride) where each search stands */
    int nstride;
    bool sudden; /* a load or driver may begin at any time: an expression limits steps */
} fw_dynamics_problem;

/* where a pass ended because a formula of an element did; t NaN: it did not */
typedef struct fw_dynamics_formula_end {
    double t, rtol; /* scaled */
    const fw_maths_stepper_row *integrator;
} fw_dynamics_formula_end;

/* What decides about steps: how long the next one may be, which are made again, when a run ends,
   and what two runs say of the error. */
typedef struct fw_dynamics_controller {
    const fw_dynamics_problem *problem;
    const fw_maths_stepper_row *integrator;
    /* the estimate of errors */
    double trust; /* what differences of two runs count times; 1: as they are */
    double part;  /* likewise of peak angles (tolerance_control.c); 0: as the rest */
    double lower; /* tolerance of the answer before over this one; 0: there was none */
    /* the choice of the integrator, and its trial */
    double stable, needed; /* explicit steps that are stable, and that the tolerance needs */
    double implicit_cost;  /* cost of an implicit step in explicit ones; 0: nothing is tried */
    double chosen_cost; /* likewise where an implicit one was chosen; 0: it was not, or is left */
    double patience;    /* steps of one pass after which explicit ones are doubted; 0: never */
    double given_up_s;  /* and where that was; NaN: it was not */
    fw_dynamics_formula_end end, before; /* of the last two passes that were computed differently */
    /* the budget */
    long steps;               /* over all passes */
    long taken;               /* in this pass */
    long trial;               /* steps after which a pass ends; 0: it does not */
    double next_choice_check; /* steps of this pass after which the choice is doubted again */
    /* steps that laws limit */
    double law_stride; /* this times the stride of a law is the longest step */
    double fixed_part; /* likewise of a fixed step */
    /* events */
    double *moved; /* (ny) a state at an event */
    double *fit;   /* (FW_PLACES + 1 x entries) along a step: switches, then joints with friction */
    bool *unfit;   /* (entries) found in this step */
    double *friction_fit; /* (friction) */
    int aims;             /* steps made again for the event at hand */
    int idle;             /* joints that were to let go and held after all, one after the other */
    double nudge;         /* how far such a one is left alone, scaled time; 0: not */
    struct fw_dynamics_near_zero *near_zero; /* near_zero_force.c; NULL: no friction */
} fw_dynamics_controller;

typedef struct fw_dynamics_shown { /* a step, as it was shown */
    bool fresh;                    /* a smooth piece begins with it */
    /* (FW_INSTANTS + 1) times 1, nq, npin, 2 npin; the first instant of a step that is fresh alone */
    double *t_s, *q, *angle_rad, *reaction_N;
    fw_dynamics_piece piece; /* q NULL: nobody wanted it */
    struct fw_dynamics_shown *next;
} fw_dynamics_shown;
typedef struct fw_dynamics_tape { /* all that a pass shows */
    fw_arena *arena;
    fw_dynamics_shown *first, *last;
    bool torn; /* more than is kept: it is of no use */
} fw_dynamics_tape;

/* What looks at the steps that were made: rows, the observer, extremes and energy. */
typedef struct fw_dynamics_recorder {
    const fw_dynamics_problem *problem;
    fw_dynamics_motion *motion; /* the result */
    bool full;                  /* of the answer: rows and energy too */
    int row;                    /* next one */
    bool fresh;                 /* no step yet behind a break or an event */
    double *state;              /* (ny) a sample */
    double *rate;               /* (ny) its derivative */
    double *kept;               /* (nq) its positions before they were projected */
    fw_multibody_energy first;
    double drift, largest; /* of the energies */
    /* (nq), (npin), (2 npin), (9 x 2 npin): what the observer is shown, SI */
    double *seen_q, *seen_angle, *seen_force, *seen_grid;
    double *seen_piece; /* (FW_PIECE_NODES x nq) likewise */
    /* whole instants: forces of joints (3 njoint) and drivers follow those of the pins, and (nq)
       velocities */
    double *seen_v;
    int seen_forces;
    fw_dynamics_extreme *extreme; /* (channels) of this pass; NULL: not asked for */
    double *channel_now;          /* (channels) */
    double *channel_grid;         /* (9 channels) along a step */
    double *pin_now, *joint_now;  /* (2 npin), (3 njoint) */
    fw_dynamics_tape *tape;       /* that this pass is kept in; NULL: it is not kept */
} fw_dynamics_recorder;

typedef struct fw_dynamics_run {
    fw_dynamics_problem problem;
    fw_dynamics_controller control;
    fw_dynamics_recorder record;
    fw_diags *diags; /* where what is wrong is said; of a trial, which may fail, its own */
} fw_dynamics_run;

/* scaled time at which the scene ends */
static inline double fw_dynamics_end(const fw_dynamics_problem *problem) {
    return problem->end[problem->npiece - 1];
}
static inline const char *fw_dynamics_scene_name(const fw_dynamics_problem *problem) {
    return fw_text_name(problem->scene->name);
}

/* run_ends.c: smooth pieces, problem.end, and what limits steps in them */
fw_status fw_dynamics_run_pieces(fw_dynamics_problem *problem, const fw_effects_loads *loads);
/* to the longest step that laws allow from t on */
void fw_dynamics_run_limit_step(const fw_dynamics_controller *control, fw_maths_stepper *s,
                                double t);
/* the stepper from t on, with the longest step that laws allow */
void fw_dynamics_run_start(const fw_dynamics_controller *control, fw_maths_stepper *s, double t,
                           const double *y, double end);

/* run_ends.c: what ends a run early, each with its message; FW_OK where it does not */
/* all that acts comes so slowly that less than `share` of what it does rings at omega (rad/s), from rest; open: contacts that
   do not touch at the start are left out, else there may be none */
bool fw_dynamics_run_gentle(const fw_dynamics_problem *problem, const fw_effects_loads *loads,
                            double omega_per_s, double share, bool open);
/* FW-D242 where an element says that it does not hold */
fw_status fw_dynamics_run_valid(const fw_dynamics_run *r, double t, const double *y);
/* FW-D244 when friction is what ended the run at scaled time t */
fw_status fw_dynamics_run_jammed(const fw_dynamics_run *r, double t);
/* FW-D108 when it takes more steps or events than it may */
fw_status fw_dynamics_run_limits(const fw_dynamics_run *r, const fw_maths_stepper *s);
/* a step was not possible, `why` */
fw_status fw_dynamics_run_stopped(const fw_dynamics_run *r, const fw_maths_stepper *s,
                                  fw_maths_ode_result why);
fw_status fw_dynamics_run_position_jumps(const fw_dynamics_run *r, double t);
/* a clause, where hinges are pins that give nothing of what a layer grows by; else "" */
const char *fw_dynamics_run_pinned(const fw_dynamics_run *r);

/* start.c: pieces, assembled state with fitting velocities, size of the motion, output arrays */
fw_status fw_dynamics_run_prepare(fw_dynamics_run *r, const fw_effects_loads *loads);
fw_status fw_dynamics_run_arrays(fw_dynamics_run *r);

/* choose.c: by name, or by the masses; problem.why says so where it is not the default */
fw_status fw_dynamics_method_choose(fw_dynamics_run *r, const fw_effects_loads *loads);
/* by name, or by the scene; says why in motion->reason */
fw_status fw_dynamics_integrator_choose(fw_dynamics_run *r, const fw_effects_loads *loads,
                                        const char *name);
/* to an explicit one, where implicit steps have become too many for a tolerance */
fw_status fw_dynamics_integrator_back(fw_dynamics_run *r, long steps, bool *changed);
/* steps are as short as they are for the sake of stability */
fw_status fw_dynamics_integrator_stuck(const fw_dynamics_problem *problem,
                                       const fw_maths_stepper *s, bool *stuck);
/* to an implicit one, after a pass that was given up */
fw_status fw_dynamics_integrator_change(fw_dynamics_run *r);

/* sample.c */
/* rows wait from now on, where they may */
fw_status fw_dynamics_record_late(fw_dynamics_recorder *record);
void fw_dynamics_record_begin(fw_dynamics_recorder *record, const double *y);
/* everything that looks at the last step, up to theta_end; false: a state cannot be projected */
bool fw_dynamics_record_step(fw_dynamics_recorder *record, fw_maths_stepper *s,
                             fw_dynamics_peaks *peaks, double theta_end);
/* early: the run ended at scaled time t, before the scene does */
void fw_dynamics_record_end(fw_dynamics_recorder *record, bool early, double t);
bool fw_dynamics_record_is_observed(const fw_dynamics_recorder *record); /* in this pass */
bool fw_dynamics_record_is_traced(const fw_dynamics_recorder *record);
/* whether a row waits; only of motions with rows that wait any does */
void fw_dynamics_record_waits(fw_dynamics_recorder *record, int row, bool waits);
/* shows a pass once more, from its first step on */
void fw_dynamics_record_again(fw_dynamics_recorder *record, const fw_dynamics_shown *first);

/* tape.c: fw_dynamics_run_pass, or what it would do, where a pass from the same numbers was kept */
fw_status fw_dynamics_tape_pass(fw_dynamics_run *r, fw_maths_stepper *s, fw_dynamics_peaks *peaks);

enum { FW_GRID = 8 };
/* places in a step and the weights of the polynomial through them */
typedef struct fw_dynamics_grid {
    int last;
    double at[FW_GRID + 1], weight[FW_GRID + 1]; /* at: of the way to theta_end */
} fw_dynamics_grid;
void fw_dynamics_run_places(const fw_maths_stepper *s, double theta_end, fw_dynamics_grid *grid);
/* that polynomial of a column of values at the places, x of the way */
double fw_dynamics_run_between(const fw_dynamics_grid *grid, const double *column, int stride,
                               double x);

/* extreme.c */
int fw_dynamics_run_channels(const fw_dynamics_problem *problem);
fw_status
fw_dynamics_run_extremes_new(fw_dynamics_recorder *record); /* work, and the peaks of the motion */
/* the last step up to theta_end */
void fw_dynamics_run_extremes(fw_dynamics_recorder *record, fw_maths_stepper *s, double theta_end);
/* peaks of the motion with errors from the looser pass */
void fw_dynamics_run_take_extremes(fw_dynamics_recorder *record, double margin,
                                   const fw_dynamics_extreme *fine,
                                   const fw_dynamics_extreme *coarse, double uncertainty,
                                   long steps);
/* the largest error over the largest value of its kind */
double fw_dynamics_run_extremes_off(const fw_dynamics_recorder *record);

/* event.c */
typedef struct fw_dynamics_event {
    int which;    /* entry: switches, then joints with friction; -1: there is none */
    double theta; /* of the step, 1 where there is none */
} fw_dynamics_event;
/* the earliest event of the last step */
fw_dynamics_event fw_dynamics_event_first(fw_dynamics_controller *control, fw_maths_stepper *s);
/* true: the step is to be made again, to end just behind the event */
bool fw_dynamics_event_aim(fw_dynamics_controller *control, fw_maths_stepper *s,
                           fw_dynamics_event event);
/* goes on from the event with the flag changed; false: no state or no friction fits there */
bool fw_dynamics_event_pass(fw_dynamics_controller *control, fw_maths_stepper *s,
                            fw_dynamics_event event, double end);
/* none where it is of a joint that held all the same a moment ago */
fw_dynamics_event fw_dynamics_event_unless_idle(const fw_dynamics_controller *control,
                                                const fw_maths_stepper *s, fw_dynamics_event event);
/* behind an event, `changed`: a flag is another one, or behind a step without one */
void fw_dynamics_event_mind_idle(fw_dynamics_controller *control, fw_maths_stepper *s,
                                 fw_dynamics_event event, bool changed, double end);

/* near_zero_force.c: steps beside places where a joint that slips is hardly pressed */
fw_status fw_dynamics_near_zero_new(fw_dynamics_controller *control);
void fw_dynamics_near_zero_begin(fw_dynamics_controller *control);  /* a pass */
void fw_dynamics_near_zero_forget(fw_dynamics_controller *control); /* forces may have jumped */
void fw_dynamics_near_zero_limit(const fw_dynamics_controller *control,
                                 fw_maths_stepper *s); /* the next step */
/* true: the last step is made again, a shorter one */
bool fw_dynamics_near_zero_again(fw_dynamics_controller *control, fw_maths_stepper *s);
/* what all of them may have moved anything by in this pass, scaled, up to k parts of the scene */
void fw_dynamics_near_zero_uncertainty(const fw_dynamics_controller *control,
                                       double up_to[FW_MARKS + 1]);
/* |error| of the integral of hypot(t - centre, width) from start to end by a rule of that order */
double fw_dynamics_near_zero_error(double start, double end, double centre, double width,
                                   int order);

/* from start to end with one stepper; counts and norms are in system and stepper */
fw_status fw_dynamics_run_pass(fw_dynamics_run *r, fw_maths_stepper *s, fw_dynamics_peaks *peaks);

/* ---- tolerance_control.c ---- */

/* The tolerances that an accuracy needs. Private to dynamics/. */

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
/* Tolerance of the looser run at which a motion would just have been near enough, from the last try
   at `looser`, which was `off` times what is allowed, and the one before (0: there was none); 0: it is
   not known. */
double fw_dynamics_tolerance_needed(double looser, double off, double before, double off_before);
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

/* estimate over what is wanted, the largest of all that counts */
double fw_dynamics_run_error_ratio(const fw_dynamics_recorder *record);
/* warns of what was not reached and of energies that do not add up; motion->tolerance */
fw_status fw_dynamics_run_report(fw_dynamics_run *r, bool enough);

#endif
