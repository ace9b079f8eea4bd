/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <study>: what is asked of many devices of one description. It stands in a device file, or is the
   root of a file of its own that names the device. Included by device.h; theory and examples:
   docs/studies.md. */
#ifndef FW_DEVICE_DEVICE_STUDY_H
#define FW_DEVICE_DEVICE_STUDY_H
#include "quantity/quantity.h"

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
                                     FW_JUDGE_MADE
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
    bool logarithmic;
    fw_place place;
} fw_device_vary;

typedef enum fw_device_spread {
    FW_SPREAD_NORMAL,
    FW_SPREAD_LOGNORMAL,
    FW_SPREAD_UNIFORM,
    FW_SPREAD_TRUNCATED, /* normal between from and to */
    FW_SPREAD_INTERVAL   /* nothing is known but from and to */
} fw_device_spread;

typedef struct fw_device_uncertain { /* <uncertain>: an input that differs from device to device */
    const char *what;                /* parameter or path, as --set takes it */
    fw_device_spread spread;
    double mean, sd, from, to; /* SI; NaN: not stated */
    fw_quantity_dimension dimension;
    const char *unit; /* values are written in it; "" for pure numbers */
    fw_place place;
} fw_device_uncertain;

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
    const char *value; /* where it stands: "governing.utilisation", "modes:modes[0].frequency_Hz" */
    fw_device_respond_take take;
    fw_device_respond_goal goal;
    double min, max; /* SI; NaN: no limit */
    fw_place place;
} fw_device_respond;

typedef struct fw_device_study {
    const char *name;
    const char *device; /* of a study in a file of its own: the device file; else NULL */
    fw_device_study_kind kind;
    fw_device_study_points points;
    fw_device_study_judge judge;
    int samples;          /* 0: as many as the kind wants */
    long seed;            /* of random numbers */
    double confidence;    /* of intervals */
    fw_device_vary *vary; /* (nvary) */
    int nvary;
    fw_device_uncertain *uncertain; /* (nuncertain) */
    int nuncertain;
    fw_device_respond *respond; /* (nrespond) */
    int nrespond;
    fw_place place;
} fw_device_study;

#endif
