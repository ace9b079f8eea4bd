/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of a device, and of many. Included by device.h. */
#ifndef FW_DEVICE_DEVICE_ASKED_H
#define FW_DEVICE_DEVICE_ASKED_H
#include "base/diag.h"
#include "quantity/quantity.h"
#include <stdbool.h>

/* ---- what it is for ----
   Quantities that are looked at (<probe>), and what is asked of them (<require>). Theory: docs/theory/probes.md. */

typedef enum fw_device_probe_takes {                 /* the attributes that a kind goes by */
                                     FW_PROBE_POINT, /* on, x, y, direction */
                                     FW_PROBE_BODY,  /* on, or of a joint */
                                     FW_PROBE_PAIR, /* a, a-x, a-y, b, b-x, b-y, direction (opening) */
                                     FW_PROBE_OUTLINES, /* a, b */
                                     FW_PROBE_CARRIER,  /* of, direction */
                                     FW_PROBE_TANGENT, /* on, x, y, direction: of an equilibrium, not of a motion */
                                     FW_PROBE_MODE /* mode; likewise */
} fw_device_probe_takes;

typedef struct fw_device_probe_kind { /* a row of probes.def */
    const char *name, *unit, *suffix; /* "force", "N m", "Nm" */
    fw_quantity_dimension dimension;
    fw_device_probe_takes takes;
    const char *sentence;
} fw_device_probe_kind;
/* its place among the rows */
#define FW_PROBE(name, ...) FW_PROBE_IS_##name,
typedef enum fw_device_probe_row {
#include "device/probes.def"
    FW_PROBE_KINDS
} fw_device_probe_row;
#undef FW_PROBE
extern const fw_device_probe_kind fw_device_probe_kinds[FW_PROBE_KINDS];
/* of a motion, with a value at every instant; else of an equilibrium */
bool fw_device_probe_moves(const fw_device_probe_kind *kind);

typedef enum fw_device_carrier { /* what `of` names: each may be in the device or in a scene */
                                 FW_CARRIER_REVOLUTE,
                                 FW_CARRIER_JOINT, /* prismatic, distance, weld */
                                 FW_CARRIER_DRIVER,
                                 FW_CARRIER_SPRING,
                                 FW_CARRIER_TENDON, /* of a scene, as the next two */
                                 FW_CARRIER_COMB,
                                 FW_CARRIER_CONTACT
} fw_device_carrier;

typedef enum fw_device_plane { /* modes that are counted: all, those in the plane, those across it */
                               FW_PLANE_EITHER,
                               FW_PLANE_IN,
                               FW_PLANE_ACROSS
} fw_device_plane;
const char *fw_device_plane_text(fw_device_plane plane); /* as the file says it */

typedef struct fw_device_probe {
    const char *id;
    fw_device_probe_row row;
    int body, body_b;          /* point, outline or body a, and b; FW_GROUND */
    double x_m, y_m;           /* local to it; of the ground: world */
    double bx_m, by_m;         /* of b */
    double direction_rad;      /* in the world, of an opening in the frame of a; NaN: none */
    const char *of;            /* id of what carries it; NULL */
    fw_device_carrier carrier; /* which kind of thing that is */
    int index;             /* of revolutes, joints, drivers and springs; those of scenes go by id */
    int mode;              /* from 1 */
    fw_device_plane plane; /* of a frequency: among which modes they are counted */
    bool implied;          /* made for a <require frequency>: no <probe> of the file */
    fw_place place;
} fw_device_probe;

typedef enum fw_device_measure { /* what of the course of a probe a requirement judges */
                                 FW_MEASURE_PEAK, /* the largest size */
                                 FW_MEASURE_MAXIMUM,
                                 FW_MEASURE_MINIMUM,
                                 FW_MEASURE_FINAL,        /* at the end of the scene */
                                 FW_MEASURE_PEAK_TO_PEAK, /* maximum less minimum */
                                 FW_MEASURE_SETTLING, /* time after which it stays within a band about where it rests */
                                 FW_MEASURE_PARASITIC /* largest displacement across the direction */
} fw_device_measure;
const char *fw_device_measure_text(fw_device_measure measure); /* as the file says it */

typedef struct fw_device_requirement { /* <require> */
    int probe;                         /* index */
    int scene;                 /* index; FW_NONE: every scene that has it; of an equilibrium:
                                          at rest, without loads */
    fw_device_measure measure; /* of what moves */
    double min, max;           /* SI, of the measure; NaN: no bound on this side */
    double band;               /* SI of the probe, of settling */
    fw_place place;
} fw_device_requirement;

/* ---- <study>: what is asked of many devices of one description ----
   It stands in a device file, or is the root of a file of its own that names the device. Theory and
   examples: docs/studies.md. */

typedef enum fw_device_study_kind {
#define FW_STUDY(name, word, sentence) FW_STUDY_IS_##name,
#include "device/studies.def"
#undef FW_STUDY
    FW_STUDY_KINDS
} fw_device_study_kind;
/* "worst-case", as files write it */
const char *fw_device_study_kind_text(fw_device_study_kind kind);

typedef enum fw_device_study_points { /* of a sweep */
                                      FW_POINTS_GRID,
                                      FW_POINTS_LIST,
                                      FW_POINTS_SOBOL
} fw_device_study_points;
const char *fw_device_study_points_text(fw_device_study_points points);

typedef enum fw_device_study_judge { /* what a device of the study is */
                                     FW_JUDGE_DRAWN,
                                     FW_JUDGE_MADE,
                                     FW_JUDGE_HINGES, /* of the drawing, and requirements */
                                     FW_JUDGE_DIE     /* one of those that a flow may make */
} fw_device_study_judge;
const char *fw_device_study_judge_text(fw_device_study_judge judge);

typedef struct fw_device_vary { /* <vary>: an input that the study chooses */
    const char *what;           /* parameter or path, as --set takes it */
    const char **text;          /* (ntext) listed values, as --set takes them; none: from..to */
    int ntext;
    double from, to;                 /* SI; NaN where values are listed */
    fw_quantity_dimension dimension; /* of from and to */
    const char *unit;                /* values are written in it; "" for pure numbers */
    int steps;                       /* of a grid */
    bool stepped;                    /* they are stated */
    bool logarithmic;
    fw_place place;
} fw_device_vary;

typedef enum fw_device_spread {
    FW_SPREAD_NORMAL,
    FW_SPREAD_LOGNORMAL,
    FW_SPREAD_UNIFORM,
    FW_SPREAD_TRUNCATED, /* normal between from and to */
    FW_SPREAD_TABLE,     /* of the shares of devices up to some values */
    FW_SPREAD_INTERVAL   /* nothing is known but from and to */
} fw_device_spread;

typedef enum fw_device_level { /* with what an input takes a new value */
                               FW_LEVEL_LOT,
                               FW_LEVEL_WAFER,
                               FW_LEVEL_DIE,
                               FW_LEVEL_HINGE
} fw_device_level;

/* <uncertain>: an input that differs from device to device. Rows of one input on several levels add up: the first has the
   mean, the others are deviations from it. */
typedef struct fw_device_uncertain {
    const char
        *what; /* parameter or path, as --set takes it; of a flow: the name of a quantity of it */
    const char *flow; /* NULL: an input of the device */
    fw_device_level level;
    bool levelled; /* the level is stated */
    bool deviates; /* from what the study chooses by vary[chosen]: no mean of its own */
    int chosen;
    fw_device_spread spread;
    double mean, sd, from,
        to; /* SI; NaN: not stated; a mean that is not stated: 0 of a further row, of a flow what the
                                  pack states */
    double *x,
        *p; /* (ntable) of a table: values, SI, and the shares of devices up to them, 0 to 1; from, to: its ends */
    int ntable;
    fw_quantity_dimension dimension;
    const char *unit; /* values are written in it; "" for pure numbers */
    fw_place place;
} fw_device_uncertain;

typedef struct fw_device_correlation { /* <correlation>: of two uncertain inputs */
    const char *of, *with, *flow;      /* as their <uncertain>; with a flow, quantities of it */
    double value;                      /* Pearson's coefficient */
    fw_place place;
} fw_device_correlation;

typedef struct
    fw_device_trend { /* <trend>: how an uncertain input goes over the wafer, the same on all wafers */
    const char *what, *flow; /* as its <uncertain>; the flow may be NULL */
    double radial;           /* SI: at the rim less in the centre; 0: not stated */
    double along_x, along_y; /* at the rim to the right, and at the top, less in the centre */
    fw_quantity_dimension dimension;
    fw_place place;
} fw_device_trend;

typedef enum fw_device_respond_take { /* of several values at one place */
                                      FW_TAKE_ONE,
                                      FW_TAKE_LARGEST,
                                      FW_TAKE_LEAST,
                                      FW_TAKE_SUM
} fw_device_respond_take;

typedef enum fw_device_respond_goal {
    FW_GOAL_NONE,
    FW_GOAL_MINIMISE,
    FW_GOAL_MAXIMISE
} fw_device_respond_goal;

typedef struct fw_device_respond { /* <respond>: a number that is looked at */
    const char *name;
    const char *value; /* where it stands: "governing.utilisation", "modes:modes[0].f_Hz" */
    fw_device_respond_take take;
    fw_device_respond_goal goal;
    double min, max; /* SI, or as the number stands where they have no unit; NaN: no limit */
    fw_quantity_dimension dimension; /* of min and max; pure: the unit of the number is meant */
    fw_place min_place, max_place;
    fw_place place;
} fw_device_respond;

typedef struct fw_device_study {
    const char *name;
    const char *device; /* of a study in a file of its own: the device file; else NULL */
    fw_device_study_kind kind;
    fw_device_study_points points;
    fw_device_study_judge judge;
    int samples;       /* 0: as many as the kind wants */
    long seed;         /* of random numbers */
    double confidence; /* of intervals */
    bool confident;    /* it is stated */
    double yield;      /* that a size wants; 0: none */
    /* what responses of a sweep's devices that are not judged may be off by, of the largest; 0: all are judged */
    double fitted;
    fw_device_vary *vary; /* (nvary) */
    int nvary;
    fw_device_uncertain *uncertain; /* (nuncertain) */
    int nuncertain;
    fw_device_trend *trend; /* (ntrend) */
    int ntrend;
    fw_device_correlation *correlation; /* (ncorrelation) */
    int ncorrelation;
    fw_device_respond *respond; /* (nrespond) */
    int nrespond;
    fw_place place;
} fw_device_study;

#endif
