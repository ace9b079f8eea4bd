/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A changed copy of the device, judged again. Private to the room. */
#ifndef FW_VERDICT_TRIAL_H
#define FW_VERDICT_TRIAL_H
#include "verdict/verdict.h"

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
} fw_verdict_trial_hinge;

/* how closely a trial is judged */
typedef enum fw_verdict_look {
    FW_LOOK_GLANCE, /* coarsely, as drawn and at the corners that were not accepted last; what that
                       rejects is rejected */
    FW_LOOK_VALUES, /* the same, with a value of every check that can have one */
    FW_LOOK_WHOLE   /* as closely as any verdict */
} fw_verdict_look;

typedef struct fw_verdict_trial {
    double work;                /* fw_verdict_options.work of the trials so far */
    double excess_as_described; /* fw_verdict_trial_excess before anything was changed */
    fw_arena *arena;            /* of the plan: outlives the trial */
    const fw_device *device;    /* as described */
    fw_device *changed;         /* a copy; flexures, loads and workspaces are its own */
    const fw_verdict_options *options;
    const fw_verdict *verdict;     /* of the device as described */
    fw_verdict_trial_hinge *hinge; /* (nhinge) of the last run */
    int nhinge;
    double *suspect; /* (nvariant x FW_FABRICATION_INPUTS) corner of each flow that governed last */
    bool *suspected; /* (nvariant) there is one */
    double *share;   /* (device->nscene) of each scene's loads that is left */
    fw_verdict_decision decision;
    int round; /* of a change that is repeated; its caller's */
    bool drawn;
    int fabricated; /* flows whose making of it the last run looked at, too */
    /* (ncheck) of the last run, in an order that no change of a value alters: trial_checks.c */
    double *check;
    double *made; /* (ncheck) the largest at the corners that were run; NaN: none was */
    int ncheck;
    bool brief; /* clearances that are enough have no value */
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
/* the largest `likely` (or reach) of the last run; NaN: it was not run */
double fw_verdict_trial_excess(const fw_verdict_trial *trial);

/* trial_checks.c: how far each check is from its limit: 0 there, below 0 within, ln of the
   utilisation where there is one. NaN: nothing is known of it, or it says only yes */
fw_status fw_verdict_trial_checks_new(fw_arena *arena, fw_verdict_trial *trial);
void fw_verdict_trial_checks(fw_verdict_trial *trial, const fw_verdict *verdict,
                             const fw_layout *layout);

/* states `changed` as settings and judges them; *accepted: they are proposed */
typedef fw_status fw_verdict_propose(void *context, bool *accepted);

/* least_change.c: an accepted change, made as small as it may be in its own direction, and proposed.
   *added: it was */
fw_status fw_verdict_least_change(fw_verdict_trial *trial, fw_verdict_propose *propose,
                                  void *context, bool *added);

/* parameters.c: every declared parameter alone */
fw_status fw_verdict_change_parameters(fw_verdict_trial *trial, fw_verdict *out);

#endif
