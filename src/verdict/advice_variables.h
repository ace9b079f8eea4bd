/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What advice may change, as settings of the description: parameters, attributes of flexures, shares
   of loads and of required poses. Private to the room. */
#ifndef FW_VERDICT_ADVICE_VARIABLES_H
#define FW_VERDICT_ADVICE_VARIABLES_H
#include "verdict/trial_value.h"

typedef struct fw_verdict_part { /* an attribute that a share multiplies */
    const char *path, *unit;     /* SI, with a prefix where that takes one */
    double value;
    bool squared;  /* it goes with the root of the share */
    bool prefixed; /* the unit takes one */
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
fw_status fw_verdict_variable_of_loads(fw_verdict_trial *trial, int scene,
                                       fw_verdict_variable *variable, bool *ok);
fw_status fw_verdict_variable_of_box(fw_verdict_trial *trial, int box,
                                     fw_verdict_variable *variable, bool *ok);

/* settings of all that differ from what they are now */
fw_status fw_verdict_variables_settings(fw_arena *arena, const fw_verdict_variable *variable,
                                        int count, const double *x, const fw_device_set **set,
                                        int *nset);
/* "width 9.2 um (now 8 um) and leg 2.3 mm (now 2.2 mm) together: accepted" */
fw_status fw_verdict_variables_text(fw_arena *arena, const fw_verdict_variable *variable, int count,
                                    const double *x, const char **text);

#endif
