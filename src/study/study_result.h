/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the samples of a study say together, by kind. Numbers are in SI; NaN: none. */
#ifndef FW_STUDY_STUDY_RESULT_H
#define FW_STUDY_STUDY_RESULT_H
#include "study/study.h"

typedef struct fw_study_extreme { /* of one response over all samples that were run */
    double least, largest;
    long least_at, largest_at; /* numbers of their samples; -1: none */
    long n;                    /* samples with a value */
    double sum, square;        /* of the values less the first one, for mean and deviation */
    double first;
} fw_study_extreme;

typedef struct
    fw_study_derivative { /* of a response by an input, at the description as it stands */
    double value;         /* SI over SI; NaN: not there */
    double error;         /* of it, estimated by halving the step */
    double spread;        /* value times half the input's range: what the tornado shows */
} fw_study_derivative;

typedef struct fw_study_index { /* share of a response's variance, with its interval */
    double first, first_low, first_high, total, total_low, total_high;
} fw_study_index;

typedef struct fw_study_end { /* worst case: one end of a response */
    double value;
    char (*text)[FW_STUDY_TEXT]; /* (ninput) where */
    bool known;
} fw_study_end;

typedef struct fw_study_found {  /* size: a design */
    char (*text)[FW_STUDY_TEXT]; /* (ninput) */
    double *value;               /* (ninput) */
    double *response;            /* (nresponse) */
    double excess;               /* <= 0: every limit holds */
    int decision;
    long i; /* its sample */
} fw_study_found;

typedef struct fw_study_flow_yield { /* yield of one flow */
    const char *flow;                /* may be NULL */
    double low, high;                /* interval of the yield, the model's own band in it */
    double value;                    /* by the utilisations themselves; the range's middle */
    double sampled_low,
        sampled_high; /* interval of sampling alone, by the utilisations themselves */
    const char *method, *reason, *caution; /* sentences; caution may be NULL */
    long evaluations, unevaluated;
    double band; /* of the model at the governing check: factor between best and worst reading */
    int ninput;
    const char *const *input; /* (ninput) names of what differs */
    const double *share;      /* (ninput) alpha^2 of the nearest design point; NULL: none found */
    const double *at;         /* (ninput) SI: the nearest device that fails; NULL: none found */
    const char *const *unit;  /* (ninput) */
    double beta;              /* its distance in standard deviations; NaN */
} fw_study_flow_yield;

typedef struct fw_study_result {
    long run, accepted, rejected, inconclusive, failed; /* samples */
    fw_study_extreme *extreme;                          /* (nresponse) */
    const char *example_why; /* of a sample that could not be run; NULL */
    long example_at;
    fw_study_derivative *derivative; /* (nresponse x ninput) sensitivity */
    fw_study_index *index;           /* (nresponse x ninput) sensitivity; NULL: not asked for */
    fw_study_end *end;               /* (nresponse x 2) worst case: least, largest */
    /* (nfound) size: the best; of two goals the Pareto front, by the first */
    fw_study_found *found;
    int nfound;
    fw_study_found nearest;     /* where nothing was found; text NULL: nothing was run */
    const char *how;            /* a sentence: what was tried */
    fw_study_flow_yield *yield; /* (nyield) a flow each */
    int nyield;
} fw_study_result;

#endif
