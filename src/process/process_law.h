/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time laws: one line of time_laws.def each, their rows in law_*.c. A law is a function of named
   arguments with dimensions; the evaluator adds uncertainty, status, window and what is missing. */
#ifndef FW_PROCESS_PROCESS_LAW_H
#define FW_PROCESS_PROCESS_LAW_H
#include "process/process.h"

#define FW_DIM(m, kg, s, A, K, mol, rad)                                                           \
    { m, kg, s, A, K, mol, rad, 0 }
#define FW_DIM_NONE            FW_DIM(0, 0, 0, 0, 0, 0, 0)
#define FW_DIM_LENGTH          FW_DIM(1, 0, 0, 0, 0, 0, 0)
#define FW_DIM_AREA            FW_DIM(2, 0, 0, 0, 0, 0, 0)
#define FW_DIM_PER_AREA        FW_DIM(-2, 0, 0, 0, 0, 0, 0)
#define FW_DIM_VOLUME          FW_DIM(3, 0, 0, 0, 0, 0, 0)
#define FW_DIM_FLOW            FW_DIM(3, 0, -1, 0, 0, 0, 0)
#define FW_DIM_TIME            FW_DIM(0, 0, 1, 0, 0, 0, 0)
#define FW_DIM_SPEED           FW_DIM(1, 0, -1, 0, 0, 0, 0)
#define FW_DIM_ROTATION        FW_DIM(0, 0, -1, 0, 0, 0, 1)
#define FW_DIM_TEMPERATURE     FW_DIM(0, 0, 0, 0, 1, 0, 0)
#define FW_DIM_ENERGY          FW_DIM(2, 1, -2, 0, 0, 0, 0)
#define FW_DIM_DOSE            FW_DIM(0, 1, -2, 0, 0, 0, 0)
#define FW_DIM_INTENSITY       FW_DIM(0, 1, -3, 0, 0, 0, 0)
#define FW_DIM_CURRENT         FW_DIM(0, 0, 0, 1, 0, 0, 0)
#define FW_DIM_CURRENT_DENSITY FW_DIM(-2, 0, 0, 1, 0, 0, 0)
#define FW_DIM_CHARGE          FW_DIM(0, 0, 1, 1, 0, 0, 0)
#define FW_DIM_MASS            FW_DIM(0, 1, 0, 0, 0, 0, 0)
#define FW_DIM_MOLAR_MASS      FW_DIM(0, 1, 0, 0, 0, -1, 0)
#define FW_DIM_DENSITY         FW_DIM(-3, 1, 0, 0, 0, 0, 0)

enum { FW_LAW_ARGUMENTS = 24 }; /* most arguments of one law */

typedef enum fw_process_law_need {
    FW_LAW_REQUIRED,
    FW_LAW_OPTIONAL,
    /* of a correction that is made where all such arguments of the law are known, and not at all where one is not: what is
       not known there leaves the time computable, and counts neither for its status nor for its uncertainty */
    FW_LAW_WHEN_KNOWN
} fw_process_law_need;

typedef struct fw_process_law_argument {
    const char *name;
    fw_quantity_dimension dimension;
    fw_process_law_need need;
    bool any_dimension; /* `dimension` is not looked at */
    /* arguments of one group stand in one table and share its error: their parts add up before
       squaring, as those of one quantity do. It names the contribution; NULL: independent. */
    const char *group;
} fw_process_law_argument;

typedef struct fw_process_law_call {
    fw_arena *arena;
    const char *shape, *expression;         /* "" when not given */
    const char *const *name;                /* (n) the arguments that x holds; needed by expr */
    const fw_quantity_dimension *dimension; /* (n) */
    int n;
    fw_quantity_dimension wanted; /* of the result; a time except for expr in <derive> */
    const char *why;              /* set with FW_INPUT: why there is no answer */
} fw_process_law_call;

typedef struct fw_process_law_answer {
    bool computable;
    double value, uncertainty;         /* SI, standard */
    double shortest, longest;          /* what the law is told that it may be; NAN: nothing */
    fw_quantity_value_status status;   /* worst of the inputs */
    fw_quantity_value_status u_status; /* of the inputs' uncertainties that count */
    const char **missing;              /* (nmissing) */
    const char **contribution;         /* (ncontribution) */
    int nmissing, ncontribution;
} fw_process_law_answer;

typedef struct fw_process_law_use { /* a law with what it is applied to */
    const struct fw_process_law *law;
    const char *shape, *expression;
    fw_quantity_dimension wanted;
    const fw_process_argument *argument;
    int nargument;
    /* inputs that must be known although the law does not take them */
    const fw_process_argument *need;
    int nneed;
    const fw_process_setting *setting; /* gives missing inputs the name that the run sheet uses */
    int nsetting;
} fw_process_law_use;

typedef struct fw_process_law {
    const char *name, *formula;
    /* (nargument); NULL: any names, and an <expr> says it */
    const fw_process_law_argument *argument;
    int nargument;
    /* x in the order of `argument`, NaN where not given. FW_INPUT with call->why when outside. */
    fw_status (*evaluate)(fw_process_law_call *call, const double *x, double *result);
    /* d(result)/dx where it differs from the slope of `evaluate` or is cheaper; may be NULL, and
       dx stays NaN where the central difference is to be used */
    void (*slope)(const double *x, double result, double *dx);
    /* quantities that come with the result, for the run sheet; may be NULL */
    fw_status (*derive)(fw_arena *arena, const fw_process_law_use *use,
                        const fw_process_law_answer *answer, fw_process_step *step);
    /* what steps of the result within the inputs' uncertainties u add to its own: standard, to be
       added as it is; NULL: the law has no steps */
    double (*steps)(const double *x, const double *u);
    bool stated;          /* hands a time on as it is stated, with its status */
    bool by_rate;         /* is thickness over rate, and nothing else */
    bool lags;            /* knows how narrow openings fall behind: probability or lag */
    const char *pairs_of; /* numbered arguments are pairs of this; NULL: it has none of its own */
    /* what it derives, and the argument that goes in proportion to it: who sets the one has set the other; may be NULL */
    const char *derived, *of_argument;
} fw_process_law;

const fw_process_law *fw_process_law_row(int i);             /* i-th law, NULL after the last */
const fw_process_law *fw_process_law_find(const char *name); /* or NULL, as for NULL */
/* of two statuses the one that a result of both inherits */
static inline fw_quantity_value_status fw_process_status_worse(fw_quantity_value_status a,
                                                               fw_quantity_value_status b) {
    return a > b ? a : b; /* the enum goes from best to worst */
}
/* measured, stated or derived: no one's guess */
static inline bool fw_process_status_firm(fw_quantity_value_status status) {
    return fw_process_status_worse(status, FW_DERIVED) == FW_DERIVED;
}
/* index of argument `name`, or -1 */
int fw_process_law_argument_index(const fw_process_law *law, const char *name);

/* the law of a step's time with as many arguments in place of its own; what else it needs is not asked for */
fw_process_law_use fw_process_law_of_step(const fw_process_step *step,
                                          const fw_process_argument *argument);
/* the arguments of a law without its lag, of which a list and one quantity are kept by the caller: the time of wide openings.
   `guess`: only where the lag is assumed */
const fw_process_argument *fw_process_law_wide(const fw_process_law_use *use,
                                               fw_process_argument *list, fw_quantity *none,
                                               bool guess);
/* FW_OK also when it is not computable (answer->computable false, missing filled) */
fw_status fw_process_law_evaluate(fw_arena *arena, const fw_process_law_use *use,
                                  fw_process_law_answer *answer);
/* the answer as a time with its window */
void fw_process_law_window(const fw_process_law_answer *answer, double k, double overrun,
                           fw_process_time *time);
/* value and uncertainty of argument `name` as used; NULL when not given or unknown */
const fw_quantity *fw_process_law_input(const fw_process_law_use *use, const char *name);
/* appends a derived quantity to the step; `value` and u in SI */
fw_status fw_process_step_derive(fw_arena *arena, fw_process_step *step, const char *name,
                                 double value, double uncertainty, fw_quantity_dimension dimension,
                                 const char *unit, fw_quantity_value_status status,
                                 const char *source);

/* A value as it was set in place of what was planned, SI */
typedef struct fw_process_set {
    const fw_quantity *planned; /* of a setting, of an argument, or derived in the step */
    double value, uncertainty;
} fw_process_set;
/* variants.c: the step as its law times and books it with these values (n), handling as planned. What is asked of the step is not
   replaced: what it adds, a dose, a time. *out is the step itself where its time stays the same; step: of a computed flow */
fw_status fw_process_step_as_set(fw_arena *arena, const fw_process_step *step,
                                 const fw_process_set *set, int n, const fw_process_step **out);

#define FW_PROCESS_LAW(name) extern const fw_process_law fw_process_law_##name;
#include "process/time_laws.def"
#undef FW_PROCESS_LAW

/* probability that a particle crosses a slot of depth/width x, or a cylinder of length/radius l */
double fw_process_knudsen_slot(double x);
double fw_process_knudsen_cylinder(double l);
/* int_0^depth (1/K(z/w) - 1) dz */
double fw_process_arde_integral(double width_m, double depth_m, bool cylinder);
/* piecewise linear through n pairs (stride 2: x0 y0 x1 y1 ...), ends where x is NaN. false outside
   the pairs or when they do not rise; *why then says so */
bool fw_process_table_between(const double *pairs, int n, double x, double *y, const char **why);

/* variants.c: the time by the step's own law for another amount of one of its arguments, as exact as it is stated. Not computable:
   the law has no such time. And the amount of so much time, from *amount nearby: times rise with it, not far from in proportion */
fw_status fw_process_step_time_of(fw_arena *arena, const fw_process_step *step, int argument,
                                  double amount_m, fw_process_law_answer *answer);
fw_status fw_process_step_amount_in(fw_arena *arena, const fw_process_step *step, int argument,
                                    double time_s, double *amount_m);

/* of so long at the machine, pauses between its parts included, how much is the step's own time */
double fw_process_step_own_s(const fw_process_step *step, double machine_s);

#endif
