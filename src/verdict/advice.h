/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What advice is made with: a changed copy of the device, judged again; what of a description may change, as
   settings of it; and the searches for the least change that is accepted. Private to the room. */
#ifndef FW_VERDICT_ADVICE_H
#define FW_VERDICT_ADVICE_H
#include "verdict/verdict.h"

/* ---- a changed copy of the device, judged again ---- */

typedef struct fw_verdict_trial_hinge { /* what a change needs to know of a hinge's verdict */
    int joint; /* FW_NONE: no hinge, but a reason against the scene: utilisation_high is then 1 over
                  the share of its loads that it may bear */
    fw_verdict_decision decision;
    double utilisation_high;
    double likely;     /* the same without what closer numbers would take away */
    double reach;      /* peak angle / angle at which the drawn solids meet; 0: never */
    const char *scene; /* of the device, or "workspace" */
    const char *flow;
    bool not_by_loads, not_by_width; /* less load, or wider flexures, are no help */
    bool either_way;                 /* fw_verdict_reason */
} fw_verdict_trial_hinge;

/* how closely a trial is judged */
typedef enum fw_verdict_look {
    FW_LOOK_GLANCE, /* coarsely, as drawn and at the corners that were not accepted last; what that
                       rejects is rejected */
    FW_LOOK_VALUES, /* the same, with a value of every check that can have one */
    FW_LOOK_WHOLE   /* as closely as any verdict */
} fw_verdict_look;

/* The corners of a flow that governed last, each once, the last of them first. One is not enough: where one requirement
   fails of thin walls and another one of thick ones, a search that looks at one corner goes from the one to the other. */
enum { FW_VERDICT_SUSPECTS = 3 };
typedef struct fw_verdict_suspects {
    int count;
    double x[FW_VERDICT_SUSPECTS]
            [FW_FABRICATION_INPUTS]; /* in the ranges of the device as described */
} fw_verdict_suspects;

typedef struct fw_verdict_trial_end { /* the device with one parameter at its min or max */
    const fw_device *device;          /* NULL: it cannot be read so */
    bool read;
} fw_verdict_trial_end;

typedef struct fw_verdict_trial {
    double work;                /* fw_verdict_options.work of the trials so far */
    double most_work;           /* no search goes on beyond that */
    fw_dynamics_spent spent;    /* evaluations that `work` does not have yet */
    fw_progress_whole told;     /* of the trial that is run */
    double excess_as_described; /* fw_verdict_trial_excess before anything was changed */
    fw_arena *arena;            /* of the plan: outlives the trial */
    const fw_device *device;    /* as described */
    fw_device *changed;         /* a copy; flexures, loads and workspaces are its own */
    const fw_verdict_options *options;
    const fw_verdict *verdict;     /* of the device as described */
    fw_verdict_trial_hinge *hinge; /* (nhinge) of the last run */
    int nhinge;
    fw_verdict_suspects *suspect; /* (nvariant) */
    double *share;                /* (device->nscene) of each scene's loads that is left */
    fw_verdict_decision decision;
    int round;      /* of a change that is repeated; its caller's */
    bool ended;     /* a change of one kind was, before it was done */
    bool drawn;     /* or nothing is drawn of the device as described either: */
    bool shapeless; /* its bodies have no shapes, and a change is accepted without */
    int fabricated; /* flows whose making of it the last run looked at, too */
    bool all_made;  /* all that have ranges */
    /* (ncheck) of the last run, in an order that no change of a value alters: trial.c */
    double *check;
    double *made; /* (ncheck) the largest at the corners that were run; NaN: none was */
    int ncheck;
    bool brief; /* clearances that are enough have no value */
    const struct fw_device_written
        *written; /* the file, opened when its units are asked for; NULL: not yet */
    fw_verdict_trial_end
        *end; /* (2 device->nparameter) as they are asked for; NULL: none was yet */
    const struct fw_verdict_accepted *accepted; /* what was judged wholly; NULL: nothing yet */
} fw_verdict_trial;

/* copies the device and takes over the verdict that it has */
fw_status fw_verdict_trial_start(fw_arena *arena, const fw_device *device,
                                 const fw_verdict_options *options, const fw_verdict *verdict,
                                 fw_verdict_trial *trial);
/* `changed` is the device as described once more, with all of its loads */
fw_status fw_verdict_trial_reset(fw_verdict_trial *trial);
/* judges `changed`; what could not be run is a rejection that is not drawn */
fw_status fw_verdict_trial_run(fw_verdict_trial *trial, fw_verdict_look look);

/* judges the description read again with `set` instead of `changed` */
fw_status fw_verdict_trial_restate(fw_verdict_trial *trial, const fw_device_set *set, int nset,
                                   fw_verdict_look look);
/* these settings, in this order, were judged wholly before, and accepted and drawn: the same device has the same verdict */
bool fw_verdict_trial_accepted(const fw_verdict_trial *trial, const fw_device_set *set, int nset);
/* the largest `likely` (or reach) of the last run; NaN: it was not run */
double fw_verdict_trial_excess(const fw_verdict_trial *trial);

/* A secant between two values that have different signs came to `at`, of the sign of `side`, the end that it takes the
   place of. Where it comes no nearer to 0 the function jumps between them, as when electrodes begin to touch, and
   halves are the way there: two secants in vain for each of them would double the looks. In: logarithms of what is
   used of a limit. NaN: one has no number. Test: test_advice.c */
static inline bool fw_verdict_jumps(double side, double at) {
    const double nearer = 0.5;
    return fabs(at) > nearer * fabs(side);
}

/* states `changed` as settings and judges them; *accepted: they are proposed */
typedef fw_status fw_verdict_propose(void *context, bool *accepted);

/* least_change.c: an accepted change, made as small as it may be in its own direction, and proposed.
   *added: it was. most_work: of hinges, then what is known is proposed, and trial->ended says so */
fw_status fw_verdict_least_change(fw_verdict_trial *trial, double most_work,
                                  fw_verdict_propose *propose, void *context, bool *added);

struct fw_verdict_variable;
/* least_change.c: the least change of one value, towards the one end that it has room to, that is accepted where the
   drawing goes in steps with it. *x: as typed, where *found */
fw_status fw_verdict_least_step(fw_verdict_trial *trial, const struct fw_verdict_variable *variable,
                                double most_work, double *x, bool *found);

/* the least change first */
void fw_verdict_sort_proposals(fw_verdict *verdict);

/* parameters.c: every declared parameter alone */
fw_status fw_verdict_change_parameters(fw_verdict_trial *trial, fw_verdict *out);

/* ---- a number of the description, as somebody would type it ---- */

typedef struct fw_verdict_value { /* all in the unit as written */
    const char *path;             /* what --set takes */
    fw_quantity_unit unit;
    const char *unit_text;
    double now, low, high;
    double range; /* to the farther end */
    double digit; /* no value is finer */
} fw_verdict_value;

/* of a parameter; *ok false: nothing says how far it may go, or it may not go anywhere */
fw_status fw_verdict_value_of_parameter(fw_verdict_trial *trial, const fw_device_parameter *p,
                                        fw_verdict_value *value, bool *ok);
/* of an attribute that is a length, between two shares of what it is: in the file's unit, and no finer than 0.1 um */
fw_status fw_verdict_value_of_length(fw_verdict_trial *trial, const char *path, double m,
                                     double least, double most, fw_verdict_value *value);
/* "12.4 um" */
const char *fw_verdict_value_text(fw_arena *arena, const fw_verdict_value *value, double x,
                                  int digits);
/* the power of ten at or below x, not finer than the finest digit */
double fw_verdict_value_step(const fw_verdict_value *value, double x);
/* the nearest whole number of steps, which are a power of ten */
double fw_verdict_value_rounded(double x, double step);

/* ---- what may change: parameters, attributes of flexures, shares of loads and of required poses ---- */

typedef struct fw_verdict_part { /* an attribute that a share multiplies */
    const char *path, *unit;     /* the file's, or SI with a prefix where that takes one */
    fw_quantity_unit as;         /* the same */
    double value;                /* SI */
    bool squared;                /* it goes with the root of the share */
    bool prefixed;               /* the unit takes one */
} fw_verdict_part;

typedef struct fw_verdict_variable {
    fw_verdict_value value; /* of a share: 1, without unit */
    const char *name;       /* "width", "width of flexure A", "loads of scene push" */
    fw_verdict_proposal_kind kind;
    const fw_verdict_part *part; /* (npart) */
    int npart;                   /* 0: the value itself is set */
} fw_verdict_variable;

/* How large a change is: |ln(x/now)|, so that twice as much and half as much are the same, whatever
   the unit; of a value that is 0, or changes its sign, |x - now| over the range that it has. With
   its sign: z. A change of several is the sum of theirs: of two ways to the same end the one that
   changes fewer things is the smaller. */
double fw_verdict_variable_z(const fw_verdict_variable *variable, double x);
double fw_verdict_variable_x(const fw_verdict_variable *variable, double z);
double fw_verdict_variable_size(const fw_verdict_variable *variable, double x);
/* x as it would be typed: to 0.4 % of the change, 0.01 % of the value */
double fw_verdict_variable_typed(const fw_verdict_variable *variable, double x);

/* every parameter that has room */
fw_status fw_verdict_variables_of_parameters(fw_verdict_trial *trial,
                                             fw_verdict_variable **variable, int *count);
/* lengths and widths of flexures, loads of scenes, required poses */
fw_status fw_verdict_variables_of_attributes(fw_verdict_trial *trial,
                                             fw_verdict_variable **variable, int *count);
/* the loads of a scene, a required box; *ok false: nothing of it can be set */
/* length and width of the flexure of `changed` are such that min and max of the parameters which they hang on allow */
bool fw_verdict_flexure_within(fw_verdict_trial *trial, int flexure);
fw_status fw_verdict_variable_of_loads(fw_verdict_trial *trial, int scene,
                                       fw_verdict_variable *variable, bool *ok);
fw_status fw_verdict_variable_of_box(fw_verdict_trial *trial, int box,
                                     fw_verdict_variable *variable, bool *ok);

/* pitch and diameter of release holes; none where no rim of them speaks against the device */
fw_status fw_verdict_variables_of_holes(fw_verdict_trial *trial, fw_verdict_variable **variable,
                                        int *count);

/* settings of all that differ from what they are now */
fw_status fw_verdict_variables_settings(fw_arena *arena, const fw_verdict_variable *variable,
                                        int count, const double *x, const fw_device_set **set,
                                        int *nset);
/* "width 9.2 um (now 8 um) and leg 2.3 mm (now 2.2 mm) together: accepted" */
fw_status fw_verdict_variables_text(fw_arena *arena, const fw_verdict_variable *variable, int count,
                                    const double *x, const char **text);

/* ---- several values at once ---- */

typedef struct fw_verdict_several {
    bool accepted; /* the device at x was read, drawn, run and accepted */
    bool ended;    /* the search was ended before it was done */
    double *x;     /* (count) in the units of the variables */
    double size;   /* sum of the sizes of all changes */
    int looks;
} fw_verdict_several;

/* smaller_than: the size of a change that is known; what is not clearly smaller is not looked for.
   most_work: trial->work may come to */
fw_status fw_verdict_change_several(fw_verdict_trial *trial, const fw_verdict_variable *variable,
                                    int count, double smaller_than, double most_work,
                                    fw_verdict_several *out);

#endif
