/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Behind the public header: for commands that show more than the library does. */
#ifndef FW_PLAN_DESIGN_H
#define FW_PLAN_DESIGN_H
#include "base/arena.h"
#include "plan/plan.h"
#include <flexwright.h>
#include <locale.h>

/* what options may be, for those who ask for them in a form */
#define FW_ACCURACY_LEAST 1e-12
#define FW_ACCURACY_MOST  0.1
#define FW_RTOL_LEAST     1e-14
#define FW_RTOL_MOST      1e-2

fw_plan *fw_plan_design_plan(fw_design *design); /* NULL for NULL */
/* a request to stop the whole program stops this design too; before any work */
void fw_plan_design_cancel_with(fw_design *design, const fw_cancel *above);
/* A design that was read and nothing else, to be another one over and over: with other settings in place of its own,
   and what was read of packs as it was. The design stays its caller's and must outlive this.
   Cost: reading the description, and copying what the design held. Test: tests/unit/study/test_engine.c */
typedef struct fw_plan_kept {
    fw_design *design;
    fw_arena_copy copy;
} fw_plan_kept;
fw_status fw_plan_keep(fw_design *design, fw_plan_kept *kept);
/* The design is then as one that was read with these settings, which must live as long as it is in use.
   *same false: it names other packs or materials, or has mistakes, and is of no use until the next time */
fw_status fw_plan_kept_again(fw_plan_kept *kept, const fw_device_set *set, int nset, bool *same);
/* The same of another description, n bytes that are copied. *same false also where something was said of files that are
   not the description, which would not be said again, or where these files are others by now */
fw_status fw_plan_kept_with(fw_plan_kept *kept, const char *xml, size_t n, const fw_device_set *set,
                            int nset, bool *same);
void fw_plan_kept_free(fw_plan_kept *kept);
/* flexwright.table/1 */
fw_status fw_plan_table_json(fw_text *out);
/* flexwright.preview/1 of what has been done with the design so far; *provisional as there */
fw_status fw_plan_design_preview_json(fw_design *design, fw_text *out);

/* ---- what a design holds: for design.c, design_documents.c, live_*.c and study/ ---- */

enum { /* what was done with it */
       FW_DONE_READ = 1,
       FW_DONE_JUDGED = 2,
       FW_DONE_FABRICATED = 4,
       FW_DONE_SIMULATED = 8,
       FW_DONE_MODES = 16,
       FW_DONE_STATICS = 32,
       FW_DONE_ASSEMBLED = 64,
       FW_DONE_ASSEMBLY_TRIED = 128,
       FW_DONE_WORKSPACE = 256,
       FW_DONE_TRADEOFF = 512
};
enum { FW_DESIGN_DOCUMENTS = FW_DOCUMENT_DIAGNOSTICS_JSON + 1 };
enum { FW_DESIGN_NUMBERS = FW_NUMBERS_WORKSPACE + 1 };
enum { FW_TRADEOFF_DOCUMENTS = FW_DOCUMENT_TRADEOFF_SVG - FW_DOCUMENT_TRADEOFF_JSON + 1 };
struct fw_study_tradeoff;

struct fw_design {
    fw_plan *plan;        /* its arena holds this struct too */
    fw_cancel cancel;     /* of this design; its arenas carry it */
    fw_progress progress; /* likewise */
    fw_team team;         /* likewise: who may help to judge */
    atomic_bool capped;   /* likewise: was it the design's own cap that refused memory? */
    const char *over_cap; /* what is said then, which needs no memory */
    locale_t locale;
    unsigned done;
    bool tried; /* a description was given, read or not */
    fw_device_set *set;
    int set_capacity;
    const char *wrong_option; /* a sentence, or NULL */
    fw_design_options given;  /* its options, with strings of its own: for other designs like it */
    unsigned wanted;          /* FW_WANTED_..., of a motion: what is asked for with it */
    unsigned known;           /* and what is */
    const fw_dynamics_motion *motion;
    const fw_statics_modes *modes;
    const fw_statics *statics;
    const fw_mechanism *mechanism; /* of `scene`, the same for all three */
    const fw_device_scene *scene;
    fw_plan_assembly assembly;
    fw_report_workspace workspace;
    const struct fw_study_tradeoff *tradeoff;
    /* of a later room, which sets them with the result */
    fw_status (*tradeoff_document[FW_TRADEOFF_DOCUMENTS])(const struct fw_study_tradeoff *t,
                                                          fw_text *out);
    fw_report_terminal_style style;
    double read_s, judge_s, simulate_s;                /* CPU time of these stages */
    fw_text document[FW_DESIGN_DOCUMENTS];             /* data NULL: not composed, or out of date */
    struct fw_plan_arrays *numbers[FW_DESIGN_NUMBERS]; /* NULL: not composed, or out of date */
    fw_diagnostic *diagnostic;                         /* (FW_DIAG_MOST) */
};

typedef struct fw_plan_bytes {
    const char *name;
    const void *data; /* NULL: the file `name` */
    size_t n;
} fw_plan_bytes;

/* Every call of the header that may fail begins so: what it says is told apart from what was said before. false: NULL, which
   is no design */
bool fw_plan_design_begin(fw_design *d);
/* says what was called wrongly: FW_USAGE */
fw_status fw_plan_design_usage(fw_design *d, const char *what);
/* work in the "C" locale of this thread, so that the caller's cannot change a byte */
int fw_plan_design_run(fw_design *d, fw_status (*work)(fw_design *d, void *argument),
                       void *argument);
void fw_plan_design_forget_documents(fw_design *d);
/* what a document prints of the motion of a simulated scene: asked for now where it is not known */
fw_status fw_plan_design_know(fw_design *d, unsigned wanted);
/* for programs, in the order in which they were found: schema flexwright.diagnostics/1 */
fw_status fw_plan_diags_json(const fw_diags *diags, fw_text *out);

/* ---- numbers of a design as named arrays (FW_NUMBERS_... of the public header): for arrays*.c and design_documents.c ----
   One set is composed by one function, out of columns or of tables with axes. Test: tests/unit/plan/test_arrays.c */

enum { FW_PLAN_ARRAYS_MOST = 48 };

typedef struct fw_plan_arrays { /* one set */
    fw_arena *arena;
    fw_array *item[FW_PLAN_ARRAYS_MOST];
    size_t count;
    bool no_memory; /* what was asked for next is NULL */
} fw_plan_arrays;

typedef struct fw_plan_axis {
    size_t n;
    const char *const *label; /* (n) or NULL */
} fw_plan_axis;

typedef struct fw_plan_array_name {
    const char *name, *unit, *about;
} fw_plan_array_name;

/* zeroed values of a new array in its set, to be filled; NULL: memory was short (the set says so) */
double *fw_plan_array_real(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                           const fw_plan_axis *axis);
const char **fw_plan_array_text(fw_plan_arrays *to, fw_plan_array_name name, fw_plan_axis axis);
int32_t *fw_plan_array_whole(fw_plan_arrays *to, fw_plan_array_name name, int32_t type,
                             fw_plan_axis axis);
double *fw_plan_array_complex(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                              const fw_plan_axis *axis);

/* a member of the struct that stands for a row */
typedef struct fw_plan_column {
    fw_plan_array_name name;
    int32_t type; /* FW_ARRAY_REAL: double, _TEXT: const char *, _WHOLE and _TRUTH: int */
    size_t at;    /* offset of it */
} fw_plan_column;

/* an array for each column; row: (n) structs of `size` bytes; label: of the rows, or NULL */
void fw_plan_array_columns(fw_plan_arrays *to, const fw_plan_column *column, size_t ncolumn,
                           const void *row, size_t n, size_t size, const char *const *label);
#define FW_PLAN_COLUMN(type, row, member, name, unit, about)                                       \
    { {name, unit, about}, type, offsetof(row, member) }

/* (n) places for labels, NULL: memory was short */
const char **fw_plan_labels(fw_plan_arrays *to, size_t n);

/* ---- the sets: the stage that makes them was called ---- */

typedef fw_status fw_plan_compose(fw_design *design, fw_plan_arrays *to);
/* arrays_verdict.c */
fw_plan_compose fw_plan_numbers_parameters, fw_plan_numbers_scenes, fw_plan_numbers_hinges,
    fw_plan_numbers_flow_hinges, fw_plan_numbers_flows, fw_plan_numbers_governing,
    fw_plan_numbers_clearances, fw_plan_numbers_requirements, fw_plan_numbers_probes,
    fw_plan_numbers_motion_probes;
/* arrays.c */
fw_plan_compose fw_plan_numbers_motion, fw_plan_numbers_peaks, fw_plan_numbers_modes,
    fw_plan_numbers_statics, fw_plan_numbers_load_path, fw_plan_numbers_assembly,
    fw_plan_numbers_workspace;

#endif
