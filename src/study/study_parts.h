/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of a study. Private to the room and its tests. */
#ifndef FW_STUDY_STUDY_PARTS_H
#define FW_STUDY_STUDY_PARTS_H
#include "plan/design.h"
#include "study/study.h"
#include "study/study_search.h"
#include "base/svg.h"
#include "chance/estimate.h"
#include "chance/joint.h"
#include <jansson.h>
#include <pthread.h>
#include <stdatomic.h>

/* stages of a design, by what responses ask for */
enum { FW_STUDY_STAGE_JUDGE = 1, FW_STUDY_STAGE_FABRICATE = 2, FW_STUDY_STAGE_SIMULATE = 4 };
enum { FW_STUDY_STAGE_STATICS = 8, FW_STUDY_STAGE_MODES = 16, FW_STUDY_STAGE_WORKSPACE = 32 };
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
/* is it about hinges and requirements, and nothing else of the verdict? */
bool fw_study_response_of_hinges(const fw_study_response *response);
/* The number at the response's path of a document that was read. false: there is none, and `why` (n
   bytes) says which key is missing and which there are. A number that is null is NaN, and found. unit (NULL: nobody
   asks): what the document says beside the number, of root's memory; NULL: nothing, or of several numbers different ones */
bool fw_study_response_find(const fw_study_response *response, const json_t *root, double *value,
                            const char **unit, char *why, size_t n);

/* ---- study_evaluate.c: values of inputs as text and back ---- */
/* the text of a value (SI), so many digits in the input's unit, and its value */
fw_status fw_study_input_write(const fw_study_input *input, double value, int digits,
                               char text[FW_STUDY_TEXT], double *shown);
/* settings (nvary) of a sample that a store has given, whose texts are there only where values are listed */
fw_status fw_study_settings_write(const fw_study *study, const fw_study_sample *sample, int digits,
                                  char (*text)[FW_STUDY_TEXT]);
/* a number that was told and not judged, in as many digits as that may have */
double fw_study_rounded(double value);
/* step k of an input: listed, or between from and to */
fw_status fw_study_input_step(const fw_study_input *input, int k, char text[FW_STUDY_TEXT],
                              double *value);
int fw_study_input_steps(const fw_study_input *input);
/* at a share (0..1) of the way from `from` to `to`, equal ratios where it is logarithmic; listed:
   the nearest of the list */
fw_status fw_study_input_at(const fw_study_input *input, double share, int digits,
                            char text[FW_STUDY_TEXT], double *value);
/* combinations of listed values, beyond `most` no further; *at: the input by which they are more, else FW_NONE */
long fw_study_lists_count(const fw_study *study, long most, int *at);
/* listed inputs of a sample: that combination of them */
fw_status fw_study_lists_write(const fw_study *study, long combination, fw_study_sample *sample);
/* its ends, or what is listed: is there such a parameter or attribute, and may it be so? FW_INPUT: FW-D493 */
fw_status fw_study_input_check(fw_study *study, int k);
/* the other way: 0 at from, 1 at to, not beyond */
double fw_study_input_share(const fw_study_input *input, double value);
/* with room for inputs and responses */
fw_status fw_study_sample_new(fw_arena *arena, const fw_study *study, fw_study_sample *sample);
/* `why` of a device that was not judged: response surfaces told it (kind_sweep.c) */
extern const char fw_study_told_by_surface[];
/* everything but the room that it lies in */
void fw_study_sample_copy(const fw_study *study, const fw_study_sample *from, fw_study_sample *to);
/* Runs the device of sample->text, with everything read anew and nothing left out, as a command does it: decision and
   responses. What cannot be read, drawn or run is in sample->why and no error. FW_NOMEM, FW_CANCELLED, FW_IO, FW_INPUT
   (FW-D500, in *changed). Called by several threads at once. */
fw_status fw_study_evaluate_alone(const fw_study *study, const fw_cancel *cancel,
                                  fw_study_sample *sample, bool *changed);
/* a design with the study's options, sets and these settings, read; *status tells. NULL: no memory */
fw_design *fw_study_design(const fw_study *study, const fw_cancel *cancel,
                           const char (*text)[FW_STUDY_TEXT], int *status);
/* values (nresponse) of a design whose stages have run; what is not found is NaN. diags (else NULL) is of the description
   as it stands: what is not found is said there, and units that stand beside numbers become those of the responses */
int fw_study_responses_take(const fw_study *study, fw_design *design, double *value,
                            fw_diags *diags);
/* what a design that was read says: decision and responses, or why not; the library's status */
int fw_study_answers_take(const fw_study *study, fw_design *design, fw_study_sample *sample);
/* used (limit_used) of a device whose hinges and requirements use at most so much, by what was decided: 0 accepted */
double fw_study_used(double most, int decision);
/* the same of a device that was judged: the most over its hinges, requirements, corners and measured reasons */
double fw_study_used_of(const struct fw_verdict *verdict, int decision);
/* what responses need of a design that was read; the library's status */
int fw_study_stages_run(fw_design *design, unsigned stages);
/* one hash of all files that a plan has read */
fw_status fw_study_files_hash(fw_arena *arena, const fw_plan *plan, const char **hash);

/* study_engine.c: origin and hash of a study; in what one differs whose store says its own by key: "; it had --accuracy
   1e-6", "" where it does not say */
struct sqlite3;
typedef const char *fw_study_says(fw_arena *arena, struct sqlite3 *db, const char *key);
fw_study_says fw_study_store_says; /* of *db; NULL: nothing, or it is no store (study_store.c) */
fw_status fw_study_find_hash(fw_study *study);
fw_status fw_study_difference(fw_study *study, fw_study_says *says, struct sqlite3 *db,
                              const char **words);

/* is what a design was read from what the study was? */
bool fw_study_same_files(const fw_study *study, fw_design *design);
fw_status fw_study_failure_open(fw_study *study);
void fw_study_failure_close(fw_study *study);
/* A file that could not be read or written ends a study, in whatever thread and design that is: the first such error is
   kept, and said where the study ends. status: what the design gave; only FW_STATUS_IO counts */
void fw_study_note_error(const fw_study *study, struct fw_design *design, int status);
fw_status fw_study_said(fw_study *study, fw_status status); /* status, or FW_NOMEM */

/* ---- study_engine.c: what samples have in common ---- */
typedef struct fw_study_engines fw_study_engines;
double fw_study_now_s(void); /* of a clock that nobody sets */
fw_status fw_study_engines_open(fw_study *study);
void fw_study_engines_close(fw_study *study);
/* the design that the study was opened with, as it was read: the first thread works in it, so that it is not read twice;
   `files` is set and nothing else reads it from now on */
void fw_study_engines_lend(fw_study *study);
/* as fw_study_evaluate_alone, to the last bit, sharing what samples have in common */
fw_status fw_study_evaluate(const fw_study *study, const fw_cancel *cancel, fw_study_sample *sample,
                            bool *changed);
fw_status fw_study_time_samples(fw_study *study); /* seconds_each and seconds_tight of some */
/* ---- study_pool.c: many devices in threads ---- */
typedef struct fw_study_work {
    long n; /* samples 0 to n - 1 of this work; sample->i is what `fill` says */
    /* inputs and number of sample k; false in *wanted: it is not run. Called by any thread. */
    fw_status (*fill)(void *context, long k, fw_study_sample *sample, bool *wanted);
    /* in the calling thread, in the order in which they end; NULL: nobody */
    fw_status (*take)(void *context, const fw_study_sample *sample);
    /* what the store has is judged once more: it does not hold all that `take` wants to know */
    bool anew;
    void *context;
} fw_study_work;
/* FW_CANCELLED: what was taken before is whole */
fw_status fw_study_pool_run(fw_study *study, const fw_study_work *work);

/* `one` for 0 to n - 1 in the study's threads, in the "C" locale, each once, until one of them is not
   FW_OK: that is the answer */
fw_status fw_study_each(const fw_study *study, long n, fw_status (*one)(void *context, long i),
                        void *context);
/* What a study of several rounds tells is of all of them: how many devices there were, of how many at most */
typedef struct fw_study_told {
    atomic_long done;
    long most; /* 0: nobody knows */
    double begun_s;
    pthread_t thread; /* that runs the study, and in which its options are told */
} fw_study_told;
/* tells of study->told, if there is one and this is its thread; else nothing */
void fw_study_tell(const fw_study *study);
/* threads of the study: options.jobs, or the processors that there are */
int fw_study_jobs(const fw_study *study);

/* ---- study_search.c: optimisers over the inputs ---- */
struct fw_study_found; /* a device that was found, with all that is told of it */
fw_status fw_study_keep_found(fw_study *study, const fw_study_sample *sample, double excess,
                              struct fw_study_found *found);

fw_status fw_study_tell_limits(fw_study *study, struct fw_study_found *found); /* study_limits.c */

/* kind_sensitivity.c: where derivatives by an input are taken, SI: at the description, or at the middle of the range where
   that does not hold it, or the description has no parameter of it */
bool fw_study_input_is_inside(const fw_study_input *in);
double fw_study_input_centre(const fw_study_input *in);
/* devices that derivatives are taken from; their accuracy becomes that of the study (study_engine.c): which was it? */
long fw_study_count_tight(const fw_study *study);
double fw_study_tighten(fw_study *study);
/* weights (n <= 7) of the first derivative at `at` by values at the nodes x (kind_sensitivity.c) */
void fw_study_derivative_weights(const double *x, int n, double at, double *weight);

/* ---- what kinds of studies share ---- */
/* keeps a sample in the store, where there is one */
fw_status fw_study_keep(fw_study *study, const fw_study_sample *sample);
/* is sample i of this shard, and not in the store yet? */
bool fw_study_is_due(const fw_study *study, long i);
/* "accept", "reject", "inconclusive", "run" (not judged), "failed" */
const char *fw_study_state_text(bool run, int decision);
void fw_study_state_take(const char *state, fw_study_sample *sample); /* the reverse of it */
void fw_study_sort_samples(fw_study_sample *sample, int n);
/* the largest share by which a limit of a <respond> is missed; <= 0: all hold; NaN: it was not run, or
   a response that has a limit has no value */
double fw_study_excess(const fw_study *study, const fw_study_sample *sample);
/* the same of each limit by itself: c, as many as is answered; c NULL: only counted */
int fw_study_limits(const fw_study *study, const fw_study_sample *sample, double *c);
double *fw_study_used_by(const fw_study *study, const fw_study_sample *sample, double from,
                         double of, double *part);
/* of each limit that is the largest of what hinges and requirements use: how many of them, and these; either may be NULL, both are moved on */
void fw_study_limits_parts(const fw_study *study, const fw_study_sample *sample, int **count,
                           double **part);
/* what a device uses, of which no number says by how much it is not accepted */
extern const double fw_study_beyond;
/* ---- study_fitted.c: devices that are told and not judged ---- */
typedef struct fw_study_points { /* all devices of a study, chosen beforehand */
    long n;
    fw_status (*at)(const void *context, long k, fw_study_sample *sample); /* inputs of device k */
    const void *context;
} fw_study_points;
enum { FW_STUDY_FARTHEST = 8 }; /* devices at either end of an axis that are judged first */
typedef struct fw_study_outer {
    double value[FW_STUDY_FARTHEST];
    long at[FW_STUDY_FARTHEST]; /* the devices, the outermost first; -1: there are not so many */
} fw_study_outer;

typedef struct fw_study_chance_axis { /* of what is left to chance */
    int number;                       /* of settings, then of the state of the flow */
    fw_study_outer low, high;         /* of all devices */
} fw_study_chance_axis;

typedef struct fw_study_axes {  /* numbers in which devices differ by chance */
    fw_study_chance_axis *axis; /* (n) */
    int n;
    double *chance; /* room for one device */
} fw_study_axes;
/* draws all devices; room: a sample. study_made.c */
fw_status fw_study_axes_find(const fw_study *study, const fw_study_points *points,
                             fw_study_sample *room, fw_study_axes *axes);
/* z (nvary + axes->n) from -1 to 1 */
void fw_study_axes_place(const fw_study_axes *axes, const fw_study *study,
                         const fw_study_sample *sample, double *z);
/* judges some of them, tells those that response surfaces tell, and judges the others. FW_INPUT: FW-D660, FW-D661 */
fw_status fw_study_fitted_run(fw_study *study, const fw_study_points *points,
                              struct fw_study_result *result);

/* does anything differ from die to die of a sweep, and in one flow? FW_INPUT: FW-D491, FW-D658 */
fw_status fw_study_dies_check(fw_study *study);
fw_status fw_study_say_idle(fw_study *study); /* FW-D737 */

/* ---- study_decides.c: what a decision follows from ---- */
enum { FW_USE_VALUE, FW_USE_HIGH, FW_USE_NUMBERS }; /* of one that uses something of its limit */
/* what each uses in all that was judged of a device */
void fw_study_uses_take(const fw_study *study, const struct fw_verdict *verdict,
                        fw_study_sample *sample);
/* is it the largest of what hinges and requirements use? */
bool fw_study_response_is_largest(const fw_study_response *response);
enum { FW_PART_LOW, FW_PART_HIGH, FW_PART_VALUE, FW_PART_NUMBERS }; /* numbers of a part */
/* of the description as it stands, where devices are told by it: npart and nhinge, as drawn its hinges and requirements, of a die
   every check, those of hinges first; of a size nuse */
void fw_study_parts_of(const fw_plan *plan, fw_study *study);
void fw_study_parts_take(const fw_study *study, const fw_verdict *verdict, fw_study_sample *sample);
/* The die that the flow makes with the values of a sample, of a device that was judged as drawn: run, used, decision (0
   accepted: no check uses more than its limit, by the value of a first look and not by its band, as dies of a yield are
   counted; 1 rejected) and parts. *numbers: hinges and requirements of the plan's verdict are those of the die. */
fw_status fw_study_die_take(const fw_study *study, fw_plan *plan, fw_study_sample *sample,
                            bool *numbers);
/* before anything is written, are these the shards of this study? FW-D497 (study_slurm.c) */
fw_status fw_study_check_shards(fw_study *study, const char *const *directory, int n);
/* has each device values of its own of what is uncertain? */
bool fw_study_draws(const fw_study *study);
/* ---- study_scatter.c: what differs from device to device, on which level, and where ---- */
typedef struct fw_study_group { /* an input: the rows that say how it differs add up */
    const char *what, *unit;
    const fw_device_uncertain *asked; /* its first row; NULL: a quantity of the flow */
    const fw_device_trend *trend;     /* NULL: none */
    int first, variables;             /* of the joint */
    int at, count; /* values of a point: one, or of what=flexure[*]/... one each flexure */
    int carrier;   /* variable, normal and not of hinges, with the largest spread; -1 */
} fw_study_group;

typedef struct fw_study_place { /* a die of the wafer */
    fw_chance_place at;
    const char *id; /* "C07" */
    int number;     /* of the grid */
} fw_study_place;

/* of one flow; a point: its quantities, then the settings of the study */
typedef struct fw_study_scatter {
    fw_chance_joint joint;
    int variables;
    fw_study_group *group; /* (groups) in the order of the point */
    int groups, trends, correlations;
    int ninput, npoint;
    size_t dimensions;     /* of the joint, and one for the place where there are trends */
    double *middle;        /* (joint.unknowns) */
    bool levels;           /* a level or a trend is stated */
    fw_study_place *place; /* (places) from the centre outwards; none without <wafer> */
    size_t places;
    double rim_m, flat_m, die_x_m, die_y_m;
    fw_device_wafer_side side; /* of the flat, which is 0 where there is none */
} fw_study_scatter;

/* FW_INPUT: a row names what is not there (FW-D556, FW-D557) */
fw_status fw_study_scatter_check(fw_study *study);
fw_status fw_study_scatter_of(fw_study *study, const fw_verdict_variant_verdict *v,
                              fw_study_scatter *scatter);
/* the place at a share (0..1) of all, from the centre outwards; NULL: there is no wafer */
const fw_study_place *fw_study_scatter_place(const fw_study_scatter *s, double share);
/* the last number of a point u (dimensions) says where the die is, where that matters; NULL: nowhere */
const fw_chance_place *fw_study_scatter_at(const fw_study_scatter *s, const double *u);
/* point (npoint) of u (joint.dimensions). unknown NULL: middles; place NULL: no trends. x: room for joint.values */
void fw_study_scatter_point(const fw_study_scatter *s, const double *u, const double *unknown,
                            const fw_chance_place *place, double *x, double *point);

/* ---- study_scatter.c: simulated wafers ---- */
typedef struct fw_study_levels {
    fw_chance_nested used; /* of the logarithm of the largest share of a limit that is used */
    fw_chance_nested held; /* of 1 where a die holds every limit, else 0 */
    bool hinges;           /* something differs from hinge to hinge */
    long devices, not_judged;
    const fw_study_scatter *scatter;
    const fw_chance_share *at; /* (scatter->places) yield by place; NULL: no trends, or no wafer */
} fw_study_levels;

/* judges n points (npoint each): ln of the largest share of a limit; NaN: it could not be judged */
typedef fw_status fw_study_judge(void *context, long first, size_t n, const double *point,
                                 double *ln);
/* from `devices` dies at most, numbered from `first` on */
fw_status fw_study_levels_run(fw_study *study, const fw_study_scatter *scatter, long devices,
                              long first, fw_study_judge *judge, void *context,
                              fw_study_levels *out);

/* ---- study_made.c: devices that a flow may make, as a limit state ---- */
enum { FW_STUDY_FLOW_PART = 100000000, FW_STUDY_DIES_USUAL = 4000, FW_STUDY_DIES_RARE = 3000 };

typedef struct fw_study_cached {
    long i; /* number of its sample; -1: free */
    double ln[FW_STUDY_READINGS];
    bool elsewhere; /* another shard judges it: ln is none */
} fw_study_cached;

typedef struct fw_study_yielding {
    fw_study *study;
    int flow;        /* of the plan */
    int ninput;      /* of the flow */
    int first_input; /* column of its first one */
    /* (nbase) settings of a device that was chosen, before those of what is uncertain; NULL: the study's own device */
    const fw_device_set *base;
    int nbase;
    fw_study_scatter scatter;
    const double *unknown; /* values of what is not known; NULL: middles */
    fw_study_reading as;   /* what the model may be off by, in its favour or against it */
    long evaluated;        /* devices of this flow so far */
    long told;             /* those and what simulated wafers had, for progress */
    long base_number;      /* of its first sample */
    /* devices by their values (open addressing): methods ask for the same ones again */
    double *key;            /* (room x npoint) */
    fw_study_cached *value; /* (room) */
    size_t room, filled;
    /* of the estimators, which give back what they took: nothing of ours is in it */
    fw_arena *chance;
} fw_study_yielding;

/* of a flow of the study's plan; y->chance is freed by the caller. FW_INPUT: nothing differs (FW-D491) */
fw_status fw_study_yielding_begin(fw_study *study, int flow, int first_input, fw_study_yielding *y);
/* before anything is run or written: does anything differ, and can it be looked at? */
fw_status fw_study_yielding_check(fw_study *yield);
/* one device; x: a point of the scatter; why (FW_STUDY_WHY): what is not known of it; response: as they are; or NULL */
fw_status fw_study_yielding_judge(const fw_study_yielding *y, const double *x,
                                  fw_verdict_made *made, char *why, double *response);
/* fw_chance_function, context the yielding: minus ln of the largest share of a limit that is used, as it is read */
fw_status fw_study_yielding_limit(void *context, size_t first, size_t count, const double *u,
                                  double *value);
/* the same of points that choose no other ones: a shard leaves out those of others */
fw_status fw_study_yielding_apart(void *context, size_t first, size_t count, const double *u,
                                  double *value);
/* fw_study_judge, of which a shard leaves out those of others */
fw_status fw_study_yielding_points(void *context, long first, size_t n, const double *x,
                                   double *ln);

/* ---- kind_yield.c: the dies of a device that a size looks at ----
   A yield of the same description, its dies around a device that is chosen. */

/* one that a flow may make, where it uses most at a distance from what is intended */
typedef struct fw_study_die {
    int flow, number; /* number: of those that a size has found */
    size_t dimensions, unknowns;
    double intended;     /* the same as ln, of what is intended */
    double *u, *unknown; /* (dimensions) in standard deviations; (unknowns) what is only assumed */
    /* of the largest share of a limit that it uses, its band in it; NaN: it could not be judged */
    double ln;
} fw_study_die;

/* the yield that a size asks of a device: rows of <uncertain>, those of what is chosen around the sample's values (NULL:
   around the description's, or the middles of the ranges) */
fw_status fw_study_dies_asked(fw_arena *arena, const fw_study *of, const fw_study_sample *chosen,
                              const fw_device_study **asked);
/* The die of a flow, `beta` standard deviations from what is intended, that uses most: along the gradient, turned until it
   stays (advanced mean value: Y.-T. Wu, H. R. Millwater, T. A. Cruse, AIAA J. 28 (1990) 1663), and what is only assumed at
   the ends that are worst. Locally so. `die` is of `arena`. Cost: some 5 (n + 2) dies. */
fw_status fw_study_dies_worst(fw_study *dies, int flow, double beta, fw_arena *arena,
                              fw_study_die *die);
/* what a die of another device, chosen by a sample of `of`, uses: as die->ln. Several threads may ask at once. */
fw_status fw_study_dies_at(const fw_study *dies, const fw_study *of, const fw_study_sample *chosen,
                           const fw_study_die *die, double *ln);
/* The share of dies of a flow that fail with the model's band against them, from few hundred dies around the nearest ones
   that fail, what is only assumed at the ends that are worst for what is intended; no interval. */
fw_status fw_study_dies_failing(fw_study *dies, int flow, double *share);

/* numbers of samples of a search begin at a multiple; searches at a wanted yield that a budget is for */
enum { FW_STUDY_SEARCH_PART = 1000000, FW_STUDY_ROUNDS_USUAL = 4 };
/* study_search.c: the best that has the yield asked for, of what was judged (n) and of what searches `like` this one try */
fw_status fw_study_at_yield(fw_study *study, const fw_study_search *like,
                            const fw_study_sample *judged, int n, struct fw_study_result *result);

/* ---- parts of the documents ---- */
/* inputs and responses as they were asked for; before it runs, too */
fw_status fw_study_asked_text(const fw_study *study, fw_text *out);

typedef struct fw_study_picture {
    const char *name;  /* "map-C", of its file NAME.svg */
    const char *title; /* a sentence */
    bool captioned;    /* the page says the title below it: it is not in the picture */
    fw_text svg;
} fw_study_picture;
/* what there is to look at, by kind */
fw_status fw_study_pictures(fw_study *study, const fw_study_picture **picture, int *n);

/* study_yield_svg.c: what pictures begin and end with, and those of a yield */
typedef struct fw_study_sheet { /* all pictures so far */
    fw_study *study;
    fw_study_picture *item;
    int n, most;
} fw_study_sheet;
enum { FW_STUDY_WIDE = 620, FW_STUDY_HIGH = 424 }; /* of a picture */
/* the next picture; NULL: there is no room, or no memory for its name or title */
fw_text *fw_study_sheet_add(fw_study_sheet *s, const char *name, const char *title);
/* a name for a file, "A-B": letters, digits and '-' */
const char *fw_study_picture_name(fw_arena *arena, const char *a, const char *b);
void fw_study_picture_begin(fw_text *out, double height, const char *title);
/* x, y: inputs along the axes, whose listed values are written there; NULL: numbers */
void fw_study_picture_grid(fw_text *out, const fw_svg_axes *axes, const fw_study_input *x,
                           const fw_study_input *y);
/* from dark to light, in even steps of lightness: "#2d1450" */
void fw_study_shade(char text[8], double share);
fw_status fw_study_yield_pictures(fw_study_sheet *s);

/* the page: the pictures, which are also files of their own, and the numbers; it needs nothing beside it */
fw_status fw_study_html(const fw_study *study, const fw_study_picture *picture, int n,
                        fw_text *out);

/* ---- the kinds ---- */
#define FW_STUDY(name, word, sentence)                                                             \
    /* what is wrong with it is said before anything is run or written (FW-D490) */                \
    fw_status fw_study_check_##name(fw_study *study);                                              \
    fw_status fw_study_kind_##name(fw_study *study, struct fw_study_result *result);               \
    long fw_study_count_##name(const fw_study *study); /* devices, at most */
#include "device/studies.def"
#undef FW_STUDY
/* ---- what the samples of a study say together, by kind ----
   Numbers are in SI; NaN: none. */

/* study_limits.c: a sample without a value is counted; what is said of them on a terminal */
fw_status fw_study_without_take(fw_study *study, const fw_study_sample *sample,
                                fw_study_without *without);
void fw_study_without_say(fw_text *out, const fw_study *study);

/* of a response by an input, at the description as it stands; SI over SI */
typedef struct fw_study_derivative {
    double value, error; /* NaN: not there, or not known */
    double spread;       /* value times half the input's range: what the tornado shows */
    double over, wide; /* SI: how far either side it is of; what the response is finer than, or 0 */
    double slope[2];   /* where it is not known: over `wide` and `over`; else NaN */
} fw_study_derivative;
/* kind_sensitivity.c: node j, SI, of seven far ones, two nearer and two nearest; at `at`, of values there, each of a
   relative accuracy. Test: tests/unit/study/test_response.c */
double fw_study_derivative_node(const fw_study_input *in, double centre, int j);
void fw_study_derive(const double *x, const double *value, double at, double accuracy, double range,
                     fw_study_derivative *d);

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
    /* (nlimit) sentences: what keeps it from being accepted, or from being better */
    const char **limit;
    int nlimit;
} fw_study_found;

typedef struct fw_study_yield_end { /* the yield at values of what is only assumed */
    double value, low, high;        /* by the utilisations themselves; interval of sampling alone */
    const double *at;               /* SI, of fw_study_flow_yield.assumed */
    const fw_chance_step *step;     /* (steps) of the probability of failing */
    size_t steps;
} fw_study_yield_end;

typedef struct fw_study_flow_yield { /* yield of one flow */
    const char *flow;                /* may be NULL */
    double low, high;                /* interval of the yield, the model's own band in it */
    /* by the utilisations themselves; NaN where something is only assumed: then it is a range, from least to most */
    double value;
    fw_study_yield_end least, most;                   /* equal where nothing is only assumed */
    int nassumed;                                     /* what is only assumed */
    const char *const *assumed, *const *assumed_unit; /* (nassumed) */
    long each, settings; /* devices of one estimate; settings of what is only assumed, one each */
    double sampled_low, sampled_high; /* of sampling alone, by the utilisations themselves */
    const char *method, *reason, *caution, *sought; /* sentences; the last two may be NULL */
    long evaluations, unevaluated;
    double band; /* of the model at the governing check: factor between best and worst reading */
    int ninput;
    const char *const *input; /* (ninput) names of what differs */
    const double *share;      /* (ninput) alpha^2 of the nearest design point; NULL: none found */
    const double *at;         /* (ninput) SI: the nearest device that fails; NULL: none found */
    const char *const *unit;  /* (ninput) */
    double beta;              /* its distance in standard deviations; NaN */
    const fw_study_levels *levels; /* NULL: neither a level nor a trend is stated */
} fw_study_flow_yield;

typedef struct fw_study_fitted { /* a sweep of which response surfaces told the most */
    long judged, open, told;     /* of which they were made; that they left open; the others */
    long checked; /* devices of the last round that were told and then judged: all came as told */
    double *off, used_off; /* (nresponse) what a response that is told may be off by; limit_used */
} fw_study_fitted;

typedef struct fw_study_result {
    const fw_study_fitted *fitted; /* NULL: every device was judged */
    /* samples; partly: fw_study_is_partly */
    long run, accepted, rejected, inconclusive, failed, partly;
    fw_study_extreme *extreme; /* (nresponse) */
    const char *example_why;   /* of a sample that could not be run; NULL */
    long example_at;
    fw_study_derivative *derivative; /* (nresponse x ninput) sensitivity */
    fw_study_index *index;           /* (nresponse x ninput) sensitivity; NULL: not asked for */
    /* (nresponse) groups of devices that indices are of, each of which has a value, of so many; NULL as index */
    const size_t *index_rows;
    size_t index_rows_all;
    fw_study_end *end; /* (nresponse x 2) worst case: least, largest */
    /* (nfound) size: the best; of two goals the Pareto front, by the first */
    fw_study_found *found;
    int nfound;
    long unbeaten;              /* of two goals: devices of the front, of which these are listed */
    fw_study_found nearest;     /* where nothing was found; text NULL: nothing was run */
    const char *how;            /* a sentence: what was tried */
    fw_study_flow_yield *yield; /* (nyield) a flow each */
    int nyield;
    long may_be, estimated; /* size at a yield: accepted; those whose yield was estimated in full */
} fw_study_result;

#endif
