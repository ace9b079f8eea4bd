/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study: many devices of one description, each judged like any other, and what they say together.

   fw_study_open reads what is asked (a <study> of a device file, or a file of its own), runs the
   description as it stands and finds every response in its documents; fw_study_run judges the samples
   in threads and keeps each in a store as it comes; what the kind of study makes of them is in
   fw_study_result. A sample is a function of the study, its seed and its number alone: threads, shards
   and interruptions change nothing. */
#ifndef FW_STUDY_STUDY_H
#define FW_STUDY_STUDY_H
#include "device/device.h"
#include "plan/plan.h"
#include <flexwright.h>

enum {
    FW_STUDY_TEXT = 96, /* bytes of a setting, its NUL included */
    FW_STUDY_WHY = 320, /* of the reason why a device could not be judged */
    FW_STUDY_SHARDS_MOST = 100000
};

typedef struct fw_study_options {
    fw_design_options design; /* of every device */
    const fw_device_set *set; /* (nset) of every device, before the study's own */
    int nset;
    const fw_plan_lab_text *lab_text; /* (nlab_text) laboratory packs beside those of `design` */
    int nlab_text;
    const char *file; /* device or study file */
    const char
        *text; /* (length) of the device, where it is no file; NULL: it is read from `file` */
    size_t length;
    const char *study;  /* which of a device file; NULL: the only one */
    const char *output; /* directory of the store and of the results */
    int jobs;           /* threads; 0: as many as there are processors */
    int shard, shards;  /* from 1; 0: all of it */
    bool resume;        /* go on with the store that is there */
    bool timed;         /* some devices are judged for their time, which a plan says */
    const fw_cancel *cancel;
    atomic_bool *capped; /* told why there was no memory, see fw_arena_capped_with; may be NULL */
    /* called now and then from the thread that runs the study; NULL: nobody asks */
    /* all below 0: so many at most, since searches end earlier; 0: nobody knows how many */
    void (*progress)(void *context, long done, long all, double seconds);
    void *progress_context;
    /* called once where another process writes into `output`, which is waited for (resume) */
    void (*waits)(void);
} fw_study_options;

/* an input of the study: chosen, or left to chance */
typedef struct fw_study_input {
    const char *what, *unit_text;
    fw_quantity_unit unit;
    double from, to; /* SI; NaN where values are listed or it is left to chance */
    bool logarithmic;
    int steps;
    const char *const *text; /* (ntext) listed values */
    int ntext;
    double now; /* SI, of the description as it stands; NaN: not a parameter */
    const fw_device_uncertain *uncertain; /* its first row; NULL: chosen, or of a flow */
    fw_place place;
} fw_study_input;

/* where a response stands: a document and the keys that lead to it */
typedef struct fw_study_response {
    const fw_device_respond *asked;
    int document;     /* index into the table of documents, study_response.c */
    const char *path; /* behind the document's name */
    const char *unit; /* of the number, "m"; "" for pure numbers */
    bool
        unit_beside; /* the document says the unit beside the number: read as the description stands */
    double min, max; /* in that unit; NaN: no limit */
    bool share;      /* of a limit, of 1; texts and pictures have it in %, as verdicts do */
    double now;      /* of the description as it stands */
} fw_study_response;

/* how a device is read: by the values of its checks, or by either end of the band of each; every one of them fails it */
typedef enum fw_study_reading {
    FW_STUDY_BY_VALUE,
    FW_STUDY_AT_BEST,  /* each check at the lower end of its band */
    FW_STUDY_AT_WORST, /* each at the upper end */
    FW_STUDY_READINGS
} fw_study_reading;

typedef struct fw_study_sample {
    long i;                      /* number in the study */
    char (*text)[FW_STUDY_TEXT]; /* (ninput) as --set takes them */
    double *value;               /* (ninput) SI; NaN: listed words */
    double *response;            /* (nresponse) in the unit of the number; NaN: none */
    int decision;                /* 0 accepted, 1 rejected, 4 inconclusive; -1: not judged */
    /* largest share of a limit that any hinge or requirement uses, at the upper end of its band and over all
       that the flows make of it; above 1 where it is not accepted; NaN: not judged */
    double used;
    double used_low, used_high; /* of a die of a yield, by either end of all bands; else NaN */
    /* (FW_VERDICT_LOOKS x study->npart x FW_PART_NUMBERS) of the drawn device, look by look: what every hinge, then every requirement
       uses of its limit, both ends of its band and the value; 0: it has none. NULL where npart is 0 */
    double *part;
    /* of a size (study->nuse x FW_USE_NUMBERS): what every hinge, then every requirement of each flow uses of its limit, the most of
       all corners that were judged; NaN: it was not judged. NULL where nuse is 0 */
    double *use;
    int looks[FW_VERDICT_LOOKS]; /* (nlook) which, in order (fw_verdict_refinement) */
    int nlook;                   /* 0: it has other hinges or requirements than the description */
    uint64_t way;                /* fw_study.way; 0: nobody asked, or nothing was judged */
    bool run;                    /* false: `why` says why not */
    char why[FW_STUDY_WHY];
    /* in: as made it is looked at in these corners alone, and `why` says so where it is accepted (fw_study_is_partly); NULL: in all */
    const struct fw_study_watch *watch;
    char corner
        [FW_PLAN_CORNER]; /* of a size that watches corners: the one that governs, of a device that was looked at in all */
} fw_study_sample;

/* Corners that governed devices of a size, the last one first (study_made.c, study_descent.c) */
enum { FW_STUDY_WATCHED = 2 };
typedef struct fw_study_watch {
    char text[FW_STUDY_WATCHED][FW_PLAN_CORNER];
    int n;
} fw_study_watch;
void fw_study_watch_add(fw_study_watch *watch, const char *corner); /* "": nothing is added */
/* was it accepted at the corners that were watched, and the others were not judged? */
bool fw_study_is_partly(const fw_study_sample *sample);

typedef struct fw_study_without { /* devices that have no value of a response, by what they are */
    long accepted, rejected, inconclusive, failed, n; /* n: all of them, also those only run */
    long at;                     /* number of the first; -1: every device has a value */
    const char *state;           /* of the first, as a store has it, and its settings (nvary) */
    char (*text)[FW_STUDY_TEXT]; /* as --set takes them */
} fw_study_without;

typedef struct fw_study_extreme { /* of one response over all samples that were run */
    double least, largest;
    long least_at, largest_at; /* numbers of their samples; -1: none */
    long n;                    /* samples with a value */
    fw_study_without without;  /* samples without one */
    double sum, square;        /* of the values less the first one, for mean and deviation */
    double first;
} fw_study_extreme;

struct fw_study_store;
struct fw_study_result;
struct fw_verdict;

/* what decides a sample, as a store keeps it; NULL: a store of before they were kept */
typedef struct fw_study_origin {
    const char *program, *options; /* version; an option of the line on each line */
    const char *files;             /* on each line the hash of a file that was read, and its name */
    const char *asked;             /* hash of the study's own words */
} fw_study_origin;

typedef struct fw_study {
    fw_arena *arena;
    fw_diags diags;
    fw_study_options options;
    const fw_device_study *asked;
    const char *device_path, *device_name;
    const char *source; /* (source_length) of options.file, for carets */
    size_t source_length;
    struct fw_study_told *told; /* NULL: each round tells of itself */
    fw_team *team;    /* threads that have no device to judge: they help with those of others */
    bool stored_only; /* of a merge: what the store has not is not run */
    const char *hash; /* of everything that decides what a sample is */
    fw_study_origin origin;
    /* (ninput) those of <vary>, then what <uncertain> sets (of flexure[*] each), then quantities of flows */
    fw_study_input *input;
    int ninput, nvary, nsetting;
    fw_study_response *response; /* (nresponse) */
    int nresponse;
    unsigned stages; /* FW_STUDY_STAGE_..., what the responses need */
    /* what a verdict says in words and whole numbers, as one number, for samples that say it; NULL: none does */
    uint64_t (*way)(const struct fw_verdict *verdict, int scenes);
    bool watches; /* fw_study_may_watch */
    bool
        explored; /* of points that somebody looks at: a device that no flow can make says why, too */
    /* hinges and requirements, and hinges of them, where devices are told by them; else 0 */
    int npart, nhinge;
    int nuse;  /* of a size: hinges and requirements of all flows */
    int neach; /* of a die: how many of them each hinge has (scenes and workspace); else 0 */
    fw_design *design; /* the description as it stands; of a yield judged as drawn */
    fw_design *former; /* as it was first read: places are of it; NULL: the same */
    fw_plan *plan;     /* of `design` */
    /* what some samples took, or one die of a yield, CPU: where it is timed, else 0 */
    double seconds_each;
    double
        seconds_tight; /* of a sensitivity: likewise of a device that derivatives are taken from */
    /* of a yield: dies of one estimate that merely counts; estimates; dies where all are counted, so many more where the
       ends of what is only assumed are not enough, and at most */
    long counted, estimates, likely, inside, most;
    struct fw_study_store *store; /* NULL: none was asked for */
    const struct fw_study_result *result;
    struct fw_study_engines *engines; /* what samples have in common */
    struct fw_study_failure *failure; /* why a design, which is gone, could not be read */
    const char *
        files; /* hash of those that `design` was read from, where a thread works in it; else NULL */
    /* of a size at a wanted yield: the yield of a device, first of the description as it stands, then of what was found */
    struct fw_study *dies;
    /* of a yield: (nflow) limits of responses that dies hold (study_limits.c); NULL: none */
    struct fw_study_counted *held;
    /* how the yield of a chosen device is opened and closed (study.c, which a kind does not call) */
    fw_status (*open_dies)(const struct fw_study *of, const fw_study_sample *chosen,
                           struct fw_study **out);
    /* status: what came of it; where it failed, the errors that say why become those of `of` */
    void (*close_dies)(struct fw_study *of, struct fw_study *dies, fw_status status);
} fw_study;

/* Reads, runs the description as it stands, resolves inputs and responses. What is wrong is in
   study->diags. *study may be asked for its diagnostics and must be freed after any status, and is
   NULL only when memory is short. */
fw_status fw_study_open(const fw_study_options *options, fw_study **study);
void fw_study_free(fw_study *study); /* NULL allowed */
/* may it judge devices at a few corners, and at all of them only what is better than the best so far? */
bool fw_study_may_watch(const fw_study *study);
bool fw_study_asks_for_no_clearance(const fw_study *study); /* are all responses about hinges? */
/* options of a design for a sample of such a study, and what of its corners the sample says */
void fw_study_look(const fw_study *study, const fw_study_sample *sample, fw_plan_options *options);
void fw_study_say_corner(const fw_study *study, const fw_plan *plan, fw_study_sample *sample);
/* was such a device of a study that has ended judged at all corners as another sample, and found to be worse? */
bool fw_study_was_refused(const fw_study *study, const fw_study_sample *sample);
/* runs what is not in the store yet, and computes study->result */
fw_status fw_study_run(fw_study *study);
/* devices that it will run, at most */
long fw_study_count(const fw_study *study);
/* what would be run: a text for a terminal, from the study as opened */
fw_status fw_study_plan_text(const fw_study *study, fw_text *out);
/* 1 where nothing was found that holds every limit (of a size); 4 where no device could be judged; else 0 */
int fw_study_decision(const fw_study *study);

/* ---- points that somebody chooses while looking ----
   A study without a store and without an end: inputs and responses are settled once, points come as they are wanted. */

/* As fw_study_open, of the device options.text, for the inputs (vary, without values) and responses of `asked`, which
   has to live as long. Nothing is run: a response that is not there has no value (NaN). Cost: that of reading it. */
fw_status fw_study_open_points(const fw_study_options *options, const fw_device_study *asked,
                               fw_study **study);

struct fw_plan_live;
struct fw_plan_live_answer;
/* {"text", "set", "options", "inputs": [PATH], "values": [RESPONSE], "points": [[TEXT]]}: what `check` says of the
   device with these inputs, a point each: flexwright.explore/1 (docs/reference/json.md). The study is kept until
   a request for another one comes. Cost: of a new one that of reading the device twice, of a point that of a sample of
   a study, in as many threads as there are processors. Test: tests/unit/study/test_explore.c */
struct fw_plan_live_answer fw_study_explore(struct fw_plan_live *live, const char *request,
                                            size_t n);

/* ---- shards ----
   Run apart without a word between them, and put together. */

/* as fw_study_open, of the file and the study that the store of a shard names */
fw_status fw_study_open_merge(const fw_study_options *options, const char *directory,
                              fw_study **study);
/* FW-D490 where samples depend on earlier ones, so that there are no shards */
fw_status fw_study_check_apart(fw_study *study);
/* the rows of all shards into options.output, then the result: the same bytes as of one run. FW-D497: a
   shard is missing, twice, not complete or of another study */
fw_status fw_study_merge(fw_study *study, const char *const *directory, int n);

typedef struct fw_study_cluster { /* how shards are run as an array job of Slurm */
    int shards, jobs;             /* tasks, threads of each */
    const char *const *argument;  /* (nargument) options of the study, as words of a line */
    int nargument;
    const char *const *sbatch; /* (nsbatch) the cluster's own, as lines of #SBATCH: "--time=60" */
    int nsbatch;
    const char *program, *where; /* absolute: this program, the directory that paths count from */
    const char *data;            /* FLEXWRIGHT_DATA; NULL: not set */
    bool submit;                 /* false: the scripts are written, and that is all */
    const char *array_job, *merge_job; /* out: numbers of the jobs */
} fw_study_cluster;
/* Writes array.sh and merge.sh into options.output and submits them, the second after all tasks of the first. FW-D490,
   FW-D554, FW-D555, FW_IO. */
fw_status fw_study_slurm(fw_study *study, fw_study_cluster *cluster);

/* ---- limits of responses that dies hold ----
   A yield counts the limits that its study states beside those of check: dies->held. */

struct fw_study_yielding;
struct fw_verdict_made;
/* limits of the responses of `of`, which lives as long: `dies` itself, or the size whose dies these are */
fw_status fw_study_counted_open(fw_study *dies, const fw_study *of);
void fw_study_counted_warn(fw_study *study); /* FW-D755: what cannot be counted */
void fw_study_counted_close(fw_study *dies);
/* Of the die x of y, which check has judged, the largest share of a limit with those of responses, in all readings. response:
   (nresponse of the study that states them) their values; may be NULL. made->why is of `arena`. Cost: what the documents of
   these responses take. Test: tests/cli/test_sizing.py, LimitsOfDies */
fw_status fw_study_counted_judge(const struct fw_study_yielding *y, fw_arena *arena,
                                 const double *x, struct fw_verdict_made *made, double *response);
/* why dies of a yield are not held against the limit of response k; NULL: they are, or there is no limit or no yield */
const char *fw_study_not_counted(const fw_study *study, int k);
/* what is behind a response in a list of what is asked: does a yield count it? and the end of its line */
void fw_study_counted_say(fw_text *out, const fw_study *study, int k);
void fw_study_counted_json(struct fw_json *json, const fw_study *study, int k);

/* ---- the results as documents ----
   JSON (schema flexwright.study/1), CSV (a row each sample), a text for a terminal, pictures and one page. After
   fw_study_run. */

fw_status fw_study_json(const fw_study *study, fw_text *out);
fw_status fw_study_text(const fw_study *study, fw_text *out);
/* A value of a response as people read it, with the unit: of shares of a limit in %, in the digits of a verdict. */
void fw_study_response_text(fw_text *out, const fw_study_response *response, double value);
/* likewise a difference of two values */
void fw_study_change_text(fw_text *out, const fw_study_response *response, double change);
/* a value in the unit that pictures have it in */
double fw_study_response_drawn(const fw_study_response *response, double value);
const char *fw_study_response_drawn_in(const fw_study_response *response);

/* study.json, study.csv, study.html and pictures/ into the output directory, each whole or not at all */
fw_status fw_study_write(fw_study *study);

/* ---- the store ---- */

/* The samples of a study on disk: DIR/study.sqlite, a row each, which other programs may ask with
   ordinary SQL while the study runs (write-ahead log). Rows come in any order; when all are there the
   file is written once more in the order of their numbers, so that its bytes depend on nothing but
   the samples. Memory does not grow with them.

     study(key, value)    what it is of: hash, name, kind, options, files, shard ...
     sample(i, state, why, limit_used, INPUT..., RESPONSE...)
                          state: accept, reject, inconclusive, run (not judged), failed; inputs and
                          responses in SI under their own names, listed words as text

   Test: tests/cli/test_study.py */
typedef struct fw_study_store fw_study_store;

/* Opens or makes the store of the study's output directory. resume: one that is there goes on, if it is
   of this study (FW-D495); else one that is there is begun anew, and anything that is no store of ours is left
   alone (FW-D496). */
fw_status fw_study_store_open(fw_study *study, fw_study_store **store);
/* Before a store that holds samples is begun anew: those of another study, or of another device, stay and the study ends
   (FW-D743); how many of this one go, of which there are no results yet, is told (FW-D745). Test: tests/cli/test_study.py */
struct sqlite3;
fw_status fw_study_gives_up(fw_study *study,
                            const char *(*says)(fw_arena *arena, struct sqlite3 *db,
                                                const char *key),
                            struct sqlite3 *db, long held);
/* commits what is open; NULL allowed */
void fw_study_store_close(fw_study_store *store);
/* FW_IO: FW-D496, and what was added before is whole */
fw_status fw_study_store_add(fw_study_store *store, const fw_study_sample *sample);
/* is sample i there? Then inputs, responses and decision are filled in */
fw_status fw_study_store_get(fw_study_store *store, long i, fw_study_sample *sample, bool *found);
long fw_study_store_count(fw_study_store *store);
/* all of them by number; `row` has the store's own room for inputs and responses. Texts of inputs are
   there only where values are listed. */
fw_status fw_study_store_each(fw_study_store *store,
                              fw_status (*row)(void *context, const fw_study_sample *sample),
                              void *context);
/* the file written once more, in order, without a log; the store stays open for reading */
fw_status fw_study_store_finish(fw_study_store *store);
/* the rows of the shards' stores into this one: FW-D497 where one is of another study, missing, twice
   or not complete */
fw_status fw_study_store_merge(fw_study_store *store, const char *const *directory, int n);
/* closed, and the file goes: half of a merge is of no use */
void fw_study_store_abandon(fw_study_store *store);
/* what a store says of itself under a key ("file"), for merging; *value NULL: nothing */
fw_status fw_study_store_said(fw_arena *arena, fw_diags *diags, const char *directory,
                              const char *key, const char **value);

#endif
