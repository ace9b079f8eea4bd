/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of a study. Private to the room and its tests. */
#ifndef FW_STUDY_STUDY_PARTS_H
#define FW_STUDY_STUDY_PARTS_H
#include "study/study.h"
#include "study/study_store.h"
#include <jansson.h>

enum { /* stages of a design, by what responses ask for */
       FW_STUDY_STAGE_JUDGE = 1,
       FW_STUDY_STAGE_FABRICATE = 2,
       FW_STUDY_STAGE_SIMULATE = 4,
       FW_STUDY_STAGE_STATICS = 8,
       FW_STUDY_STAGE_MODES = 16,
       FW_STUDY_STAGE_WORKSPACE = 32
};

/* ---- study_response.c: numbers of documents ---- */

typedef struct fw_study_document {
    const char *name;
    int document;    /* FW_DOCUMENT_... */
    unsigned stages; /* that must have run */
} fw_study_document;
extern const fw_study_document fw_study_documents[];
extern const int fw_study_document_count;

/* "modes:modes[0].frequency_Hz": document, path and unit of a response; FW_INPUT: said in diags */
fw_status fw_study_response_parse(fw_arena *arena, const fw_device_respond *asked, fw_diags *diags,
                                  fw_study_response *response);
/* The number at the response's path of a document that was read. false: there is none, and `why` (n
   bytes) says which key is missing and which there are. A number that is null is NaN, and found. */
bool fw_study_response_find(const fw_study_response *response, const json_t *root, double *value,
                            char *why, size_t n);

/* ---- study_input.c: values of inputs as text and back ---- */

/* the text of a value (SI), so many digits in the input's unit, and the value that this text has */
fw_status fw_study_input_write(const fw_study_input *input, double value, int digits,
                               char text[FW_STUDY_TEXT], double *shown);
/* step k of an input: listed, or between from and to */
fw_status fw_study_input_step(const fw_study_input *input, int k, char text[FW_STUDY_TEXT],
                              double *value);
int fw_study_input_steps(const fw_study_input *input);
/* at a share (0..1) of the way from `from` to `to`, equal ratios where it is logarithmic; listed:
   the nearest of the list */
fw_status fw_study_input_at(const fw_study_input *input, double share, int digits,
                            char text[FW_STUDY_TEXT], double *value);

/* the other way: 0 at from, 1 at to, not beyond */
double fw_study_input_share(const fw_study_input *input, double value);

/* ---- study_evaluate.c: one device ---- */

/* a sample with room for inputs and responses */
fw_status fw_study_sample_new(fw_arena *arena, const fw_study *study, fw_study_sample *sample);
/* everything but the room that it lies in */
void fw_study_sample_copy(const fw_study *study, const fw_study_sample *from, fw_study_sample *to);
/* Runs the device of sample->text: decision and responses. What cannot be read, drawn or run is in
   sample->why and no error. FW_NOMEM, FW_CANCELLED, FW_IO, FW_INPUT (FW-D500, in *diags). Called by
   several threads at once. */
fw_status fw_study_evaluate(const fw_study *study, const fw_cancel *cancel, fw_study_sample *sample,
                            bool *changed);
/* a design with the study's options, sets and these settings, read; *status tells. NULL: no memory */
fw_design *fw_study_design(const fw_study *study, const fw_cancel *cancel,
                           const char (*text)[FW_STUDY_TEXT], int *status);
/* values (nresponse) of a design whose stages have run, each document read once; what is not found is NaN,
   and said in diags (NULL: nobody is told). The library's status */
int fw_study_responses_take(const fw_study *study, fw_design *design, double *value,
                            fw_diags *diags);
/* what responses need of a design that was read; the library's status */
int fw_study_stages_run(fw_design *design, unsigned stages);
/* one hash of all files that a plan has read */
fw_status fw_study_files_hash(fw_arena *arena, const fw_plan *plan, const char **hash);

/* ---- study_pool.c: many devices in threads ---- */

typedef struct fw_study_work {
    long n; /* samples 0 to n - 1 of this work; sample->i is what `fill` says */
    /* inputs and number of sample k; false in *wanted: it is not run. Called by any thread. */
    fw_status (*fill)(void *context, long k, fw_study_sample *sample, bool *wanted);
    /* in the calling thread, in the order in which they end; NULL: nobody */
    fw_status (*take)(void *context, const fw_study_sample *sample);
    void *context;
} fw_study_work;
/* FW_CANCELLED: what was taken before is whole */
fw_status fw_study_pool_run(fw_study *study, const fw_study_work *work);

/* ---- study_search.c: optimisers over the inputs ---- */

typedef struct fw_study_search {
    /* of a sample that was run: what is to be small, and what must not be above 0 (NaN: as bad as can be) */
    double (*objective)(const void *context, const fw_study_sample *sample);
    double (*constraint)(const void *context, const fw_study_sample *sample);
    const void *context;
    /* shares 0..1 of the ranges of the ranged inputs; listed ones keep their texts */
    double *start;
    const fw_study_sample *from; /* texts of listed inputs */
    int most;                    /* evaluations */
    int digits;                  /* of the values that are tried */
    long first;                  /* number of its first sample */
    /* out: the best sample, feasible first; its objective and constraint */
    fw_study_sample best;
    double f, c;
    int used;
} fw_study_search;
/* begins at a sample: its shares, and its texts of listed inputs */
fw_status fw_study_search_from(const fw_study *study, const fw_study_sample *from,
                               fw_study_search *search);
/* n searches, in threads: each gives the same whatever runs beside it */
fw_status fw_study_search_run(fw_study *study, fw_study_search *search, int n);
/* a is better than b: feasible before infeasible, then by objective, or by constraint */
bool fw_study_search_better(double fa, double ca, double fb, double cb);

/* weights (n <= 7) of the first derivative at `at` by values at the nodes x (kind_sensitivity.c) */
void fw_study_derivative_weights(const double *x, int n, double at, double *weight);

/* study.c: the two steps of fw_study_open. NULL: memory is short */
fw_study *fw_study_new(const fw_study_options *options);
fw_status fw_study_open_in(fw_study *study);

/* ---- study_threads.c ---- */

/* `one` for 0 to n - 1 in the study's threads, in the "C" locale, each once, until one of them is not
   FW_OK: that is the answer */
fw_status fw_study_each(const fw_study *study, long n, fw_status (*one)(void *context, long i),
                        void *context);
/* threads of the study: options.jobs, or the processors that there are */
int fw_study_jobs(const fw_study *study);

/* ---- what kinds of studies share ---- */

/* keeps a sample in the store, where there is one */
fw_status fw_study_keep(fw_study *study, const fw_study_sample *sample);
/* is sample i of this shard, and not in the store yet? */
bool fw_study_is_due(const fw_study *study, long i);
/* "accept", "reject", "inconclusive", "run" (not judged), "failed" */
const char *fw_study_state_text(bool run, int decision);
/* by their numbers */
void fw_study_sort_samples(fw_study_sample *sample, int n);
/* the largest share by which a limit of a <respond> is missed; <= 0: all hold; NaN: it was not run, or
   a response that has a limit has no value */
double fw_study_excess(const fw_study *study, const fw_study_sample *sample);

#define FW_STUDY(name, word, sentence)                                                             \
    fw_status fw_study_kind_##name(fw_study *study, struct fw_study_result *result);               \
    long fw_study_count_##name(const fw_study *study); /* devices, at most */
#include "device/studies.def"
#undef FW_STUDY

#endif
