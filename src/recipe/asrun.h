/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was done, beside what was planned. The log is a text of lines that only grows: the first one
   names the flow, the hash of its plan (recipes/FLOW.json) and the wafers of the lot, every other one is a step as it was
   run, of one wafer or of all. Each ends with chain=, the SHA-256 of the line before it (its chain) and of its own words,
   so that a line that was changed, removed or moved afterwards is seen. Fields are separated by
   tabs. */
#ifndef FW_RECIPE_ASRUN_H
#define FW_RECIPE_ASRUN_H
#include "mask/mask.h"
#include "process/calibrate.h"
#include "process/process.h"

enum { FW_RECIPE_SITES = 5, FW_RECIPE_WAFERS = 50 };
extern const char
    *const fw_recipe_site_name[FW_RECIPE_SITES]; /* centre, top, left, bottom, right */

typedef struct fw_recipe_measured {
    const char *measure, *value; /* one of the step's <accept measure>s; as it was written */
    double number; /* mean of the sites in the unit of the run sheet; NaN: yes or no */
    double site[FW_RECIPE_SITES]; /* NaN: not measured there; one value without a name: the first */
    int nsite;                    /* 0: yes or no */
    const char *low,
        *high; /* what is accepted, in the same unit; of a line of another plan by that one */
} fw_recipe_measured;

typedef struct fw_recipe_set { /* what was set, or measured of what was set */
    const char *name, *text;
    const fw_quantity *q; /* what was planned; NULL: read without the log's plan */
    double value;         /* in the unit of q; NaN: a text */
    double planned;       /* in the unit of q; NaN: not known, or a text */
    const char *low,
        *high; /* what the step allows, as written in the unit of q; "": any. planned and these of a line of another plan: by that one */
} fw_recipe_set;

typedef struct fw_recipe_coupon {
    const char *text;
    /* value: mean of the sites; uncertainty: the instrument's, 0: not given */
    fw_process_measurement row;
    double site[FW_RECIPE_SITES]; /* SI */
    int nsite;                    /* 0: looked at, not measured */
} fw_recipe_coupon;

/* An entry is of a step that was run, or says what became of a wafer: from scrapped or held on no entry of it is expected or
   taken, until a held one is resumed. */
typedef enum fw_recipe_fate {
    FW_FATE_RUN,
    FW_FATE_HELD,
    FW_FATE_RESUMED,
    FW_FATE_SCRAPPED
} fw_recipe_fate;

typedef struct fw_recipe_asrun_entry {
    const fw_process_step *step; /* that was run; NULL: none was (fate) */
    const fw_process_step *at;   /* that one, or the one at which the fate was seen */
    /* step as its law times it at what was set in this run; `step` where that is as planned, or the plan is not known */
    const fw_process_step *as_set;
    fw_recipe_fate fate;
    const char *why;       /* of a fate, as written */
    double start_s, end_s; /* seconds since 1970-01-01T00:00 of the log's clock (fw_recipe_asrun) */
    double ahead_s;        /* of UTC, as its start names it; NaN: it names none */
    /* as written; NULL: not given; wafer NULL: the whole lot */
    const char *start, *end, *by, *second, *tool, *bath, *note, *wafer, *instrument;
    const char
        *replaces; /* line of the entry in whose place this one stands, as written; NULL: none */
    const char *deviation; /* what was done otherwise than the sheet says, with its number there */
    fw_recipe_measured *measured;
    fw_recipe_set *set;
    fw_recipe_coupon *coupon;
    int nmeasured, nset, ncoupon, line;
    bool former; /* of a plan before that of the last lines, and judged by the times of its line */
    bool
        limited; /* its line says by what its values are judged, as lines of former versions do not */
    int loads; /* of the step that the entry is of: of the whole lot several, one after the other */
    char chain[65]; /* of its line */
} fw_recipe_asrun_entry;

typedef struct fw_recipe_replan {         /* from here on the lot follows another plan */
    const char *plan, *start, *by, *note; /* note NULL: none */
    int line;
} fw_recipe_replan;

typedef struct fw_recipe_asrun {
    const fw_process_flow *flow; /* whose steps the entries are of */
    const char *plan, *lot;      /* plan: that of its last lines */
    /* What its times are of. zone: of the clock of this one, and the seconds are of UTC. NULL: of the laboratory's own clock,
       of which nobody says when it is changed; from the first entry on that names how far its times are ahead of UTC
       (ahead_s, else NaN) the seconds are of a clock that is always so far ahead */
    const char *zone;
    double ahead_s;
    const char **wafer; /* (nwafer) ids of the lot; 0: the log was begun without */
    int nwafer;
    fw_recipe_asrun_entry *entry; /* (nentry) in the order of the log */
    int nentry;
    fw_recipe_replan *replan; /* (nreplan) in the order of the log */
    char (*link)[65];         /* (nline) chains of the lines behind the first one */
    int nreplan, nline;
    char chain[65];             /* of the last line */
    char begun[65];             /* of the first one */
    const fw_mask_table *table; /* of the test die that coupons are on; NULL: not looked at */
    bool headed;                /* its first line says that a head is kept beside it */
} fw_recipe_asrun;

/* does the text begin as a log does? */
bool fw_recipe_asrun_is_log(const char *text, size_t n);
/* reads and verifies a log. FW_INPUT: FW-D280 (damaged or changed), FW-D281 (of another plan or
   flow), FW-D282 and FW-D278 (an entry that cannot be). plan_sha256 NULL: of whatever plan of this flow; then settings are
   not looked at. */
fw_status fw_recipe_asrun_read(fw_arena *arena, const fw_process_flow *flow,
                               const char *plan_sha256, const char *file, const char *text,
                               size_t n, fw_diags *diags, fw_recipe_asrun *run);

/* the same without asking whether its last lines are of that plan, for an entry that says that they are from now on. Lines of
   a former plan are judged by the times that stand in them */
fw_status fw_recipe_asrun_read_former(fw_arena *arena, const fw_process_flow *flow,
                                      const char *plan_sha256, const char *file, const char *text,
                                      size_t n, fw_diags *diags, fw_recipe_asrun *run);

/* one line more behind what was read, of the same plan; run->entry has room for it */
fw_status fw_recipe_asrun_read_next(fw_arena *arena, const fw_process_flow *flow, const char *file,
                                    const char *line, fw_diags *diags, fw_recipe_asrun *run);

/* "6" or "A1,A2,B7" as the ids of a lot with commas between; NULL and *wrong: it is neither */
const char *fw_recipe_asrun_wafers(fw_arena *arena, const char *text, const char **wrong);
/* the line that begins a log (lot, wafers and zone may be NULL), and the line of one entry written as
     C22; start=2026-11-20T10:00; end=2026-11-20T10:21; by=AB; wafer=3; thickness=9.1 9.0 9.2 9.1 9.1 um;
     set current=0.2 A; coupon=plating-pads, drawn=1000 um, value=9.1 um, u=0.05 um, at=25 C/cm2
   or of what became of a wafer
     C22; wafer=3; start=2026-11-20T10:21; by=AB; scrapped=cracked in the jig
   (held and resumed likewise, end as start),
   with second, tool, bath, instrument, note, deviation and the step's measures as further words. *line ends with a newline; what
   is wrong with the entry is FW-D282, a value that makes no sense FW-D278, what a cautious colleague would ask a warning
   FW-D283, an entry of a wafer that is scrapped or held FW-D603, a coupon that the flow does not have
   FW-D605, a time that its clock has twice, or never, FW-D717, at `place`. now_s: local time, NaN: not known. */
fw_status fw_recipe_asrun_begin(fw_arena *arena, const fw_process_flow *flow,
                                const char *plan_sha256, const char *lot, const char *wafers,
                                const char *zone, const char **line);
fw_status fw_recipe_asrun_add(fw_arena *arena, const fw_process_flow *flow,
                              const fw_recipe_asrun *run, const char *words, fw_place place,
                              double now_s, fw_diags *diags, const char **line);

/* "plan; start=2026-11-20T13:00; by=AB; note=with the pack of wafer 1": from then on the log is of this plan. is_plan: are the
   words such an entry? FW-D282 */
bool fw_recipe_asrun_is_plan(const char *words);
fw_status fw_recipe_asrun_add_plan(fw_arena *arena, const fw_recipe_asrun *run,
                                   const char *plan_sha256, const char *words, fw_place place,
                                   fw_diags *diags, const char **line);

/* asrun.c: the line of the file beside the log that says how many entries it has; FW-D280 where the log has fewer, or
   others. A log that says of itself that a head is kept (`headed`) is not whole without one. */
fw_status fw_recipe_asrun_head(fw_arena *arena, int nentry, const char *chain, const char **line);
fw_status fw_recipe_asrun_check_head(const fw_recipe_asrun *run, const char *file, const char *text,
                                     size_t n, fw_diags *diags);

/* ---- planned against actual ---- */

typedef struct fw_recipe_deviation {
    const fw_recipe_asrun_entry *entry;
    const char *what, *planned, *actual; /* "thickness", "8.1 to 9.9 um", "7.9 um" */
    bool repeated;                       /* the step was run once more for this wafer */
} fw_recipe_deviation;
/* asrun_compare.c: what is out of its limits, in the order of the flow and of the log. What was put right by another run has been so, all the
   same: it stands in the list, `repeated` */
fw_status fw_recipe_asrun_deviations(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_recipe_asrun *run, fw_recipe_deviation **list,
                                     int *n);

/* FW-D283 where entry e, which was just added, took another time than planned; said at once, while something can be done */
fw_status fw_recipe_asrun_ask_time(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, fw_place place, fw_diags *diags);

/* as a table, as JSON, and as a page with control charts (asrun_report.c) */
fw_status fw_recipe_asrun_write_text(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out);
fw_status fw_recipe_asrun_write_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out);
fw_status fw_recipe_asrun_write_html(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out);

/* asrun_measured.c: the coupons of the log, wafer by wafer, for fw_process_calibrate_wafers. FW-D610: a reading that a later
   one took the place of; FW-D611: readings of one run under something else; FW-D604: of a wafer that was scrapped or held by then, left out; FW-D693: of a run that was not as
   planned, left out where nothing else says under what it was read */
typedef struct fw_recipe_counted { /* which readings of a log count */
    bool all_runs;       /* those of runs out of their window, too, and those that were overtaken */
    const char *without; /* ids of wafers with commas between; NULL: of all */
} fw_recipe_counted;
fw_status fw_recipe_asrun_readings(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_counted *counted, fw_diags *diags,
                                   fw_process_readings *readings);
typedef struct fw_recipe_read_again {
    const fw_recipe_asrun_entry *entry, *by;
    const fw_recipe_coupon *coupon, *by_coupon; /* of theirs; by_coupon counts */
} fw_recipe_read_again;
/* The next reading, from coupon *coupon of entry *entry on, in whose place a later one stands; false: there is none. Begin
   with 0 and 0 */
bool fw_recipe_asrun_read_again(const fw_recipe_asrun *run, int *entry, int *coupon,
                                fw_recipe_read_again *again);
/* what to do where both shall count */
#define FW_RECIPE_KEEP_BOTH                                                                        \
    "Where both shall count, write them into one entry as sites of one value (value=9.1 9.2 um)"

#endif
