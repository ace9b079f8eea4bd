/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was done, beside what was planned. The log is a text of lines that only grows: the first one
   names the flow and the hash of its plan (recipes/FLOW.json), every other one is a step as it was
   run. Each ends with chain=, the SHA-256 of the line before it (its chain) and of its own words,
   so that a line that was changed, removed or moved afterwards is seen. Fields are separated by
   tabs. */
#ifndef FW_RECIPE_ASRUN_H
#define FW_RECIPE_ASRUN_H
#include "process/process.h"

typedef struct fw_recipe_measured {
    const char *measure, *value; /* one of the step's <accept measure>s; a number, yes or no */
    double number;               /* NaN: yes or no */
} fw_recipe_measured;

typedef struct fw_recipe_asrun_entry {
    const fw_process_step *step;
    double start_s, end_s; /* local time of the laboratory, seconds since 1970-01-01T00:00 there */
    const char *start, *end, *by, *second, *tool, *bath, *note; /* as written; NULL: not given */
    fw_recipe_measured *measured;
    int nmeasured, line;
    char chain[65]; /* of its line */
} fw_recipe_asrun_entry;

typedef struct fw_recipe_asrun {
    const char *plan, *lot;
    fw_recipe_asrun_entry *entry; /* (nentry) in the order of the log */
    int nentry;
    char chain[65]; /* of the last line */
    char begun[65]; /* of the first one */
} fw_recipe_asrun;

/* reads and verifies a log. FW_INPUT: FW-D280 (damaged or changed), FW-D281 (of another plan or
   flow), FW-D282 (an entry that cannot be). */
fw_status fw_recipe_asrun_read(fw_arena *arena, const fw_process_flow *flow,
                               const char *plan_sha256, const char *file, const char *text,
                               size_t n, fw_diags *diags, fw_recipe_asrun *run);

/* the line that begins a log, and the line of one entry written as
     C22; start=2026-11-20T10:00; end=2026-11-20T10:21; by=AB; thickness=9.1; note=...
   with second, tool, bath and the step's measures as further words. *line ends with a newline; what
   is wrong with the entry is FW-D282, what a cautious colleague would ask is a warning FW-D283. */
fw_status fw_recipe_asrun_begin(fw_arena *arena, const fw_process_flow *flow,
                                const char *plan_sha256, const char *lot, const char **line);
fw_status fw_recipe_asrun_add(fw_arena *arena, const fw_process_flow *flow,
                              const fw_recipe_asrun *run, const char *words, fw_diags *diags,
                              const char **line);

/* asrun_head.c: the line of the file beside the log that says how many entries it has; FW-D280 where the log has fewer, or
   others */
fw_status fw_recipe_asrun_head(fw_arena *arena, int nentry, const char *chain, const char **line);
fw_status fw_recipe_asrun_check_head(const fw_recipe_asrun *run, const char *file, const char *text,
                                     size_t n, fw_diags *diags);

/* planned against actual, as a table and as JSON */
fw_status fw_recipe_asrun_write_text(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out);
fw_status fw_recipe_asrun_write_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out);

#endif
