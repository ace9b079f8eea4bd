/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the comparison: one device and one scene with everything but the numbers decided, what
   is worth its cost, medians, and panels with axes. Private to the room and its tests. */
#ifndef FW_STUDY_TRADEOFF_PARTS_H
#define FW_STUDY_TRADEOFF_PARTS_H
#include "base/text.h"
#include "study/tradeoff.h"
#include <stdbool.h>

/* ---- one device and one scene (problem.c) ---- */

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

/* the scene, closed joints, what simulate does by itself, effects and level */
fw_status fw_study_problem_open(fw_plan *plan, double budget, fw_study_problem *p);
/* the same with the level given: nothing is run */
fw_status fw_study_problem_at_level(fw_plan *plan, fw_effects_hinge_model level,
                                    fw_study_problem *p);
/* compiles the effects as `p->effects` and the accuracy say */
fw_status fw_study_problem_compile(fw_study_problem *p);

/* one answer of a setting. method, integrator NULL and rtol 0: as simulate would */
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

/* ---- the model of costs (problem.c) ---- */

/* instructions of one right-hand side; good to a factor of 2 */
double fw_study_cost_rhs(const fw_study_problem *p, const char *method);
/* of one answer with these counts, its error estimate included */
double fw_study_cost_answer(const fw_study_problem *p, const fw_study_tradeoff_point *point);
/* of one step, for limits before it is run */
double fw_study_cost_step(const fw_study_problem *p, const char *method, const char *integrator);
/* the same answer at a tenth of the tolerance over this one */
double fw_study_cost_digit(const char *integrator);

/* ---- parts of the whole: study_grid.c, study_tradeoff.c, study_measure.c ---- */

fw_status fw_study_tradeoff_grid(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_find_reference(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_models(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_masks(fw_study_problem *p, fw_study_tradeoff *t);
fw_status fw_study_tradeoff_count(fw_study_problem *p, const fw_study_tradeoff_options *o,
                                  fw_study_tradeoff *t);
fw_status fw_study_tradeoff_times(fw_study_problem *p, const fw_study_tradeoff_options *o,
                                  fw_study_tradeoff *t);

/* ---- costs and errors of several settings (study_tradeoff.c): plain arrays, no physics ---- */

/* front[i]: no other point has both cost and error smaller (or one smaller, the other the same; of
   equal points the first). Points with a cost or error that is no number are never on it. In: n
   costs and errors > 0. O(n^2). Test: test_front.c. */
void fw_study_front_mark(const double *cost, const double *error, int n, bool *front);

/* Cost at which the front reaches an error: log-log line between its neighbours, no line beyond its
   ends: the cheapest point's cost where that reaches it, NaN where none does. */
double fw_study_front_cost(const double *cost, const double *error, const bool *front, int n,
                           double wanted);

/* Factor of cost for one more digit over the whole front: (c1/c0)^(1/log10(e0/e1)) of its ends; NaN
   with less than half a digit between them. */
double fw_study_front_digit(const double *cost, const double *error, const bool *front, int n);

/* Least-squares slope of -log error over log work: the order that is seen. Points at or below
   `least` are round-off or reference and do not count; NaN with fewer than three points. */
double fw_study_front_order(const double *work, const double *error, int n, double least);

/* ---- medians with intervals, for times on noisy machines (study_measure.c) ---- */

typedef struct fw_study_median {
    double value, low, high; /* NaN: too few samples for the interval */
} fw_study_median;

/* Median of n samples, which are sorted, and the interval of two order statistics x_(k), x_(n+1-k)
   that holds the median of their distribution with a probability of at least 95 %, whatever that
   distribution is: 1 - 2 B(k - 1; n, 1/2) of the binomial. Needs n >= 6; O(n log n). Source: David
   and Nagaraja, Order Statistics, 7.1. Test: test_medians.c. */
fw_study_median fw_study_median_of(double *sample, int n);

/* wider than this share of the median is not told */
static const double fw_interval_most = 0.1;
bool fw_study_median_told(const fw_study_median *m);

/* ---- panels (tradeoff_svg.c) ----
   With logarithmic axes, curves that are told apart without colour, labels at their ends. */

typedef struct fw_study_axis { /* decades from low to high, as exponents */
    double low, high;
    bool falls; /* large values first */
} fw_study_axis;
fw_study_axis fw_study_axis_new(bool falls);
void fw_study_axis_add(fw_study_axis *axis,
                       double value);        /* what is no number above 0 is passed by */
void fw_study_axis_end(fw_study_axis *axis); /* whole decades, at least one */

typedef struct fw_study_panel {
    double x, y, width, height; /* of the plot area */
    fw_study_axis ax, ay;
    bool bare; /* no axis of y */
} fw_study_panel;
double fw_study_panel_x(const fw_study_panel *p, double value);
double fw_study_panel_y(const fw_study_panel *p, double value);
void fw_study_panel_frame(const fw_study_panel *p, const char *title, const char *x_name,
                          const char *y_name, fw_text *out);
/* n points in picture coordinates; `style` gives colour, dashes and marker */
void fw_study_panel_curve(const fw_study_panel *p, const double *x, const double *y, int n,
                          int style, fw_text *out);

enum { FW_LABELS = 24 };
typedef struct fw_study_labels {
    struct {
        const char *text;
        double x, y, at; /* end of the curve; where the label is */
        int style;
    } item[FW_LABELS];
    int n;
} fw_study_labels;
void fw_study_labels_add(fw_study_labels *l, const char *text, double x, double y, int style);
void fw_study_labels_draw(fw_study_labels *l, const fw_study_panel *p, fw_text *out);

#endif
