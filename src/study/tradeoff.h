/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What accuracy costs, for one device and one scene: the error of the answer that matters (peak
   hinge deflection, utilisation) against instructions and time, for every method, integrator and
   tolerance; what the model itself is off by, on the same axis; what the masks are.
   Theory: docs/theory/tradeoff.md. */
#ifndef FW_STUDY_TRADEOFF_H
#define FW_STUDY_TRADEOFF_H
#include "base/text.h"
#include "plan/plan.h"
#include <stdbool.h>

enum { FW_TRADEOFF_TOLERANCES = 9 };

typedef enum fw_study_tradeoff_state {
    FW_TRADEOFF_DONE,
    FW_TRADEOFF_SKIPPED, /* `why` says why */
    FW_TRADEOFF_FAILED   /* `why` says how */
} fw_study_tradeoff_state;

typedef enum fw_study_count_by {
    FW_COUNT_MODEL,    /* right-hand sides times what one is known to cost, good to a factor of 2 */
    FW_COUNT_SCALED,   /* of the same method and integrator at another tolerance, with the number of
                          right-hand sides */
    FW_COUNT_CALLGRIND /* counted */
} fw_study_count_by;

/* CPU time over that of the chosen setting: median of pairs */
typedef struct fw_study_tradeoff_time {
    double ratio, low, high; /* with the 95 % interval of the median */
    int pairs;               /* 0: not measured */
    bool told;               /* the interval is narrow enough */
} fw_study_tradeoff_time;

typedef struct fw_study_tradeoff_point { /* one setting of the numbers */
    const char *method, *integrator;
    double rtol; /* used */
    fw_study_tradeoff_state state;
    const char *why;
    double *peak_rad; /* (npin) with sign */
    /* relative to the largest peak of the reference: largest error of any peak; what the program
       said of it, effects that were left out not counted */
    double error, estimated;
    double utilisation,
        utilisation_error; /* NaN: no hinge has a limit; relative to the reference */
    long steps, rejected, rhs, jacobians, factorisations;
    double instructions; /* of the whole answer, its error estimate included */
    fw_study_count_by by;
    fw_study_tradeoff_time time;
    bool front; /* no setting is both cheaper and better */
    bool floor; /* its error is not above that of the reference: "at most" */
} fw_study_tradeoff_point;

typedef struct fw_study_tradeoff_reference {
    const fw_study_tradeoff_point *run[2]; /* the first is the reference; the second may be NULL */
    /* largest difference of any peak of the two, relative; what points below it are off by is not
       known */
    double error;
    double utilisation_error;
    bool independent; /* neither method nor integrator is shared, nor with the chosen setting */
} fw_study_tradeoff_reference;

typedef struct fw_study_tradeoff_model { /* a choice of the model, everything else alike */
    const char *kind;                    /* "hinge", "effects", "process", "solid" */
    const char *name;
    fw_study_tradeoff_state state;
    const char *why;
    double change; /* largest change of a peak, relative: by the best level, by all effects, by what
                      the flow may make of the device. NaN: not known */
    double bound;  /* what was known of it before; NaN: nothing */
    double utilisation;  /* largest; NaN: not known */
    double instructions; /* NaN: none of its own */
    bool chosen;         /* what simulate takes by itself */
} fw_study_tradeoff_model;

typedef struct fw_study_tradeoff_mask {
    double tolerance_m, edge_m; /* asked for; farthest that an edge is off, at most */
    long vertices, bytes;       /* of the GDSII */
    /* bound on what that changes of a peak deflection, relative; NaN: no hinge */
    double deflection;
    bool usual; /* the tolerance of this plan */
} fw_study_tradeoff_mask;

typedef struct fw_study_tradeoff_curve { /* one pair of method and integrator over the tolerances */
    const char *method, *integrator;
    int first, count; /* of point[] */
    double order;     /* slope of -log error over log right-hand sides; NaN: too few points */
    /* in the picture it stands for its method (at the chosen integrator), and for its integrator
       (with the chosen method) */
    bool as_method, as_integrator;
} fw_study_tradeoff_curve;

typedef struct fw_study_tradeoff {
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    const char *device, *flow; /* flow NULL: the device's own material */
    double accuracy;           /* wanted */
    const char *level;         /* how hinges are taken in all settings */
    const char *level_why;     /* NULL: there are no hinges */
    double duration_s;
    fw_study_tradeoff_reference reference;
    fw_study_tradeoff_point *point; /* (npoint) the first is what simulate does by itself */
    int npoint;
    fw_study_tradeoff_curve *curve; /* (ncurve) */
    int ncurve;
    const char *chosen_why; /* the program's own reason for its integrator */
    bool quasi_static;      /* by itself simulate takes equilibria: the first point is one */
    bool quasi_static_only; /* and no integration with inertia ends: none is compared */
    int cheapest;           /* of those that are good enough, fw_study_tradeoff_good; FW_NONE */
    double over_cheapest;   /* cost of the chosen one over it; NaN */
    double digit_here, digit_overall; /* factor of cost for one more digit: at the chosen setting,
                                         over all of the front; NaN: cannot be said */
    double honesty[3];  /* estimated over true error: least, median, largest, of points whose true
                           error is known; NaN: none */
    int least_honest;   /* point with the least; FW_NONE */
    int honest, judged; /* points whose estimate is not below the true error, of how many */
    fw_study_tradeoff_model *model; /* (nmodel) */
    int nmodel;
    double floor; /* largest change that the chosen model leaves: nobody needs digits below */
    const char *floor_what;
    fw_study_tradeoff_mask *mask; /* (nmask) */
    int nmask;
    const char *mask_why;         /* why there is none */
    const char *instructions_why; /* why nothing was counted; NULL: it was */
    const char *times_why;        /* why nothing was timed; NULL: it was */
    double chosen_cpu_s, chosen_cpu_low_s, chosen_cpu_high_s; /* NaN: not told */
    double budget_s;
} fw_study_tradeoff;

/* starts a program again under callgrind: what the library cannot know of its caller */
typedef struct fw_study_tradeoff_options {
    double budget_s; /* of a machine that does 2.5e9 instructions a second; 0: 20 */
    bool times;      /* measure time */
    bool count;      /* count instructions where callgrind is there */
    /* this program and its arguments, absolute, NULL behind the last; it runs the settings of one
       more option --settings LIST by fw_study_tradeoff_settings. NULL: it cannot */
    const char *const *argv;
} fw_study_tradeoff_options;

/* FW_INPUT: no scene, or nothing turns in it (FW-D290). After fw_plan_load. */
fw_status fw_study_tradeoff_run(fw_plan *plan, const fw_study_tradeoff_options *options,
                                const fw_study_tradeoff **out);
/* runs the settings "LEVEL;METHOD/INTEGRATOR/RTOL,..." one after the other, each within the
   function that callgrind looks at; auto/auto/0: as simulate does by itself */
fw_status fw_study_tradeoff_settings(fw_plan *plan, const char *list);

/* true errors: of the peaks within the accuracy, of the utilisation within ten times the accuracy
   of the limit, which is what the verdict settles for */
bool fw_study_tradeoff_good(const fw_study_tradeoff *t, const fw_study_tradeoff_point *point);
const char *fw_study_tradeoff_floor_text(const fw_study_tradeoff *t);

fw_status fw_study_tradeoff_text(const fw_study_tradeoff *t, fw_text *out);
fw_status fw_study_tradeoff_json(const fw_study_tradeoff *t, fw_text *out);
fw_status fw_study_tradeoff_csv(const fw_study_tradeoff *t, fw_text *out);
fw_status fw_study_tradeoff_svg(const fw_study_tradeoff *t, fw_text *out);

/* ==== shared by the files of the comparison: one device and one scene with everything but the numbers decided, what is worth
   its cost, medians, and panels with axes. Private to the room and its tests ==== */

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
