/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program: one row per command (commands.def) and per option (options.c), which also feed
   --help and the reference page; and what the commands share. Private to the room and its tests. */
#ifndef FW_CLI_CLI_H
#define FW_CLI_CLI_H
#include "base/output.h"
#include "device/device.h"
#include "plan/plan.h"
#include <flexwright.h>
#include <stdbool.h>

enum { FW_MOST_SETS = 64, FW_MOST_NAMES = 1024, FW_MOST_GIVEN = 256 };

typedef struct fw_cli_options {
    fw_design_options design;
    fw_device_set set[FW_MOST_SETS];
    int nset;
    const char *device; /* "-" = standard input; for explain: the code */
    const char *output; /* -o */
    const char *csv, *forces, *animate;
    const char *svg;                                /* of assemble and hinge */
    const char *gds;                                /* of mask */
    const char *level, *deck;                       /* of hinge; NULL: by accuracy, none */
    const char *run, *entry, *entries, *lot, *zone; /* of log */
    const char *wafer, *wafer_ids, *instrument, *report;
    const char *without; /* of calibrate; NULL: none */
    bool all_runs;
    double now_s; /* local time when it was started, since 1970-01-01T00:00 there */
    struct {
        const char *before, *words; /* "set ", "power=251 W" */
    } logged[FW_MOST_SETS];
    int nlogged;
    /* of study */
    const char *study;               /* NULL: the only one */
    const char *more[FW_MOST_NAMES]; /* (nmore) names behind the first */
    int nmore, jobs, shard, shards;
    bool resume, plan_only;
    int tasks; /* of study slurm; 0: not given */
    bool no_submit;
    const char *sbatch[FW_MOST_SETS]; /* (nsbatch) */
    int nsbatch;
    int port; /* of serve; 0: a free one */
    bool no_browser, ipv6;
    const char *settings;          /* of tradeoff; NULL: all */
    double budget_s, time_limit_s; /* the second 0: none */
    bool no_time;
    struct { /* (ngiven) options of the line: their rows' names, their words in argv */
        const char *name;
        int first, last;
    } given[FW_MOST_GIVEN];
    int ngiven;
    char **argv; /* as it was started, for tradeoff, which starts it again under callgrind */
    const fw_cancel *interrupted; /* set by SIGINT and SIGTERM: every design here stops then */
    bool schedules; /* it is a command whose schedules somebody reads: it takes --day */
    bool json, quiet, verbose, no_progress, help, version;
    int colour; /* -1 auto, 0 never, 1 always */
} fw_cli_options;

typedef struct fw_cli_command { /* one row per command */
    const char *name, *argument, *summary, *example, *text;
    unsigned options; /* bit per option group */
    int (*run)(fw_cli_options *options);
} fw_cli_command;
const fw_cli_command *fw_cli_command_table(size_t *count);
const fw_cli_command *fw_cli_find_command(const char *name); /* NULL: there is none */
/* says so, and what was probably meant; returns exit status 2 */
int fw_cli_unknown_command(const char *name);

enum { /* option groups */
       FW_OPT_COMMON = 1,
       FW_OPT_PLAN = 2,
       FW_OPT_SIMULATE = 4,
       FW_OPT_OUTPUT = 8,
       FW_OPT_FABRICATE = 16,
       FW_OPT_MODES = 32,
       FW_OPT_STATICS = 64,
       FW_OPT_ASSEMBLE = 128,
       FW_OPT_HINGE = 256,
       FW_OPT_SCHEDULE = 512,
       FW_OPT_CALIBRATE = 1024,
       FW_OPT_LOG = 2048,
       FW_OPT_TRADEOFF = 4096,
       FW_OPT_SERVE = 8192,
       FW_OPT_VERDICT = 16384,
       FW_OPT_STUDY = 32768,
       FW_OPT_FIGURE = 65536,
       FW_OPT_MASK = 131072
};

/* the program with its arguments: the exit status of the contract */
int fw_cli_run(int argc, char **argv);

/* fills options from argv[2..]; false: wrong usage, said on stderr. What it keeps of
   --set is freed by fw_cli_options_free, also where it failed */
bool fw_cli_parse(const fw_cli_command *command, int argc, char **argv, fw_cli_options *options);
void fw_cli_options_free(fw_cli_options *options);
void fw_cli_help(void); /* the program */
void fw_cli_command_help(const fw_cli_command *command);
void fw_cli_reference(fw_text *out); /* docs/reference/command-line.md */
/* says "flexwright: error: ... [FW-D230]" and returns exit status 2 */
int fw_cli_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* ---- the table of options, for the parser, --help and the reference page ---- */

typedef struct fw_cli_option_row {
    const char *name;     /* without the dashes */
    char letter;          /* 0: none */
    const char *argument; /* NULL: none */
    const char *help;     /* {names}: of what may be named, from its table */
    unsigned group;
    const char *(*take)(fw_cli_options *o, const char *value); /* NULL or what is wrong */
} fw_cli_option_row;
const fw_cli_option_row *fw_cli_option_rows(size_t *count);
/* the help of a row with the names filled in; until the next call */
const char *fw_cli_option_help(const fw_cli_option_row *row);
/* "gds, svg or dxf", from the tables; until the next call */
const char *fw_cli_mask_format_names(void);
const char *fw_cli_hinge_model_names(void);
const char *fw_cli_level_names(void);
/* what is said of a value that is none of these: "needs gds, svg ..."; until the next call */
const char *fw_cli_needs(const char *(*names)(void));

/* ---- what options of masks, study and log take (option_values.c) ----
   NULL or what is wrong with the value */

const char *fw_cli_take_tolerance(fw_cli_options *o, const char *v);
const char *fw_cli_take_mask_format(fw_cli_options *o, const char *v);
const char *fw_cli_take_mask_flatten(fw_cli_options *o, const char *v);
/* what was probably meant, of the names in "needs A, B (why) or C": "; did you mean A?" or ""; until the next call */
const char *fw_cli_meant(const char *value, const char *needs);
const char *fw_cli_take_gds(fw_cli_options *o, const char *v);
const char *fw_cli_take_layers(fw_cli_options *o, const char *v);
const char *fw_cli_take_mask_vertices(fw_cli_options *o, const char *v);

const char *fw_cli_take_study(fw_cli_options *o, const char *v);
const char *fw_cli_take_jobs(fw_cli_options *o, const char *v);
const char *fw_cli_take_shard(fw_cli_options *o, const char *v);
const char *fw_cli_take_resume(fw_cli_options *o, const char *v);
const char *fw_cli_take_plan_only(fw_cli_options *o, const char *v);
const char *fw_cli_take_tasks(fw_cli_options *o, const char *v);
const char *fw_cli_take_no_submit(fw_cli_options *o, const char *v);
const char *fw_cli_take_sbatch(fw_cli_options *o, const char *v);

const char *fw_cli_take_run(fw_cli_options *o, const char *v);
const char *fw_cli_take_entry(fw_cli_options *o, const char *v);
const char *fw_cli_take_entries(fw_cli_options *o, const char *v);
const char *fw_cli_take_lot(fw_cli_options *o, const char *v);
const char *fw_cli_take_zone(fw_cli_options *o, const char *v);
const char *fw_cli_take_wafer_ids(fw_cli_options *o, const char *v);
const char *fw_cli_take_without(fw_cli_options *o, const char *v);
const char *fw_cli_take_all_runs(fw_cli_options *o, const char *v);
const char *fw_cli_take_wafer(fw_cli_options *o, const char *v);
const char *fw_cli_take_instrument(fw_cli_options *o, const char *v);
const char *fw_cli_take_report(fw_cli_options *o, const char *v);
const char *fw_cli_take_site(fw_cli_options *o, const char *v);
const char *fw_cli_take_setting(fw_cli_options *o, const char *v);
const char *fw_cli_take_coupon(fw_cli_options *o, const char *v);

/* ---- manuals.c: not part of the program; tools/manuals writes them at build time ---- */

/* man(7), section 1; command NULL: of the program, which names those of the commands */
void fw_cli_manual(const fw_cli_command *command, fw_text *out);

typedef enum fw_cli_shell { FW_SHELL_BASH, FW_SHELL_ZSH, FW_SHELL_FISH } fw_cli_shell;
void fw_cli_completion(fw_cli_shell shell, fw_text *out);

/* what may stand behind an option: words with a space between, or NULL: a file, directory or anything, as
   *kind says; until the next call */
typedef enum fw_cli_value {
    FW_VALUE_WORDS,
    FW_VALUE_FILE,
    FW_VALUE_DIRECTORY,
    FW_VALUE_FLOW, /* of those that are installed where it is typed: `doctor` knows */
    FW_VALUE_OTHER
} fw_cli_value;
const char *fw_cli_option_values(const fw_cli_option_row *row, fw_cli_value *kind);

/* ---- session.c: what the commands share ---- */

#define COMMAND(name_, argument_, summary_, example_, text_, options_)                             \
    int fw_cli_command_##name_(fw_cli_options *options);
#include "cli/commands.def"
#undef COMMAND

/* a design that was read, or NULL with *exit_status set and everything said */
fw_design *fw_cli_session_open(fw_cli_options *options, int *exit_status);
/* prints the diagnostics on standard error and frees; returns the exit status */
int fw_cli_session_close(fw_design *design, const fw_cli_options *options, int status,
                         int result_if_ok);
/* says so where there is no design to say it of; returns the exit status */
int fw_cli_session_no_memory(void);
/* a line on standard error with -v */
void fw_cli_session_stage(const fw_cli_options *options, const char *stage);
/* a directory of results that would be refused is refused before the work; NULL: none is written */
int fw_cli_session_target(fw_design *design, const char *directory);
/* a document (FW_DOCUMENT_...) on standard output; returns the library's status */
int fw_cli_session_print(fw_design *design, const fw_cli_options *options, int document);

typedef struct fw_cli_session_file {
    int document; /* FW_DOCUMENT_... */
    const char *name;
} fw_cli_session_file;
/* documents as files of a directory, which is made where it is not there and may hold others: all of
   them or none; returns the library's status */
int fw_cli_session_save(fw_design *design, const char *directory, const fw_cli_session_file *file,
                        size_t count);
/* the same of bytes */
int fw_cli_session_put(fw_plan *plan, const char *directory, const fw_output_member *file,
                       size_t count);
/* --csv - : the table has standard output for itself */
bool fw_cli_session_file_on_stdout(const fw_cli_options *options);

/* ---- cli_laboratory.c: what is kept beside a log shows that no line of it was removed (FW-D280, FW-D283) ---- */

struct fw_recipe_asrun;
fw_status fw_cli_check_head(fw_arena *arena, fw_diags *diags, const char *file, bool begun,
                            const struct fw_recipe_asrun *run);

/* ---- cli_hinge.c: input decks of the continuum level for a person's own solver ---- */

/* Into DIRECTORY, made when it is not there, for every flow of the plan (the plan is loaded):
   hinge-ID[-FLOW].inp       unit loads on each flexure
   hinge-ID[-FLOW]-large.inp a quarter, half, three quarters and all of its limit angle
   mechanism-SCENE[-FLOW].inp the whole mechanism under each scene's loads at its end; where it
                             cannot be written a warning (FW-D213) says why
   each file whole or not at all. refinement 0: the default. *files counts them. */
fw_status fw_cli_decks(fw_plan *plan, const char *directory, double refinement, int *files);

#endif
