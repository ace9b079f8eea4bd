/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What accuracy costs, for one device and one scene: the error of the answer that matters (peak
   hinge deflection, utilisation) against instructions and time, for every method, integrator and
   tolerance; what the model itself is off by, on the same axis; what the masks are.
   Theory: docs/theory/tradeoff.md. */
#ifndef FW_STUDY_TRADEOFF_H
#define FW_STUDY_TRADEOFF_H
#include "plan/plan.h"

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

#endif
