/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files about the as-run log share. Private to recipe/. */
#ifndef FW_RECIPE_ASRUN_PARTS_H
#define FW_RECIPE_ASRUN_PARTS_H
#include "base/json.h"
#include "base/text.h"
#include "recipe/asrun.h"
#include <stdbool.h>

typedef struct fw_recipe_asrun_reader {
    fw_arena *arena;
    const fw_process_flow *flow;
    const fw_recipe_asrun *run; /* whose wafers there are */
    /* the flow is the computed one of the log's own plan: what a step sets is all known */
    bool bound;
    bool former; /* the line is of a plan before that, and the flow is that of the last one */
    bool fresh;  /* somebody writes it now; lines of a log that stand are read as they are */
    fw_diags *diags;
    fw_place place;
} fw_recipe_asrun_reader;

/* asrun_entry.c: cuts a copy of the words at `separator`; the first is the step, the others are name=value */
fw_status fw_recipe_asrun_entry_read(const fw_recipe_asrun_reader *r, const char *words, size_t n,
                                     char separator, fw_recipe_asrun_entry *e);

/* recipe_words.c: YYYY-MM-DDTHH:MM or with :SS behind, of the years 1 to 9999; behind that Z, +02:00, or " UTC+02:00" as of a
   plan, where it says how far that clock is ahead of UTC: *ahead_s, else NaN. time_s: of that clock */
bool fw_recipe_asrun_time_read(const char *s, double *time_s, double *ahead_s);
/* of which clock its times are, and what that leaves out, where no zone is stated; nothing where one is, or nothing is logged */
void fw_recipe_asrun_put_clock(const fw_recipe_asrun *run, fw_text *out);
/* asrun_values.c: start_s and end_s of an entry, from what is written; FW-D717, FW-D718 */
fw_status fw_recipe_asrun_times(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e);
/* the times that it is judged by, as a word of its line; nothing where it has none */
void fw_recipe_asrun_put_planned(const fw_recipe_asrun_entry *e, fw_text *out);

/* asrun_values.c: "50.1 50.0 49.9 50.2 50.1 um", "centre:50.1 left:49.9 um" or "0.4" */
typedef struct fw_recipe_asrun_values {
    double site[FW_RECIPE_SITES]; /* as written; NaN: none */
    int n;
    const char *unit; /* "": none was written */
} fw_recipe_asrun_values;
/* sites: how many are measured, which so many numbers without names are; 0: as many as there are. FW-D282 */
fw_status fw_recipe_asrun_values_read(const fw_recipe_asrun_reader *r, const char *name,
                                      const char *text, int sites, fw_recipe_asrun_values *v);
/* turns them into the unit that is wanted: FW-D282 where it is of another dimension; where `range` is not NULL, each must
   lie in its range: FW-D278 */
fw_status fw_recipe_asrun_values_in(const fw_recipe_asrun_reader *r, const char *name,
                                    const char *unit, const fw_quantity *range,
                                    fw_recipe_asrun_values *v);
double fw_recipe_asrun_mean(const double *site);
/* the next word of *at up to the separator, without blanks around it and ended there; *at moves behind it, NULL: it was
   the last */
char *fw_recipe_asrun_word(char **at, char separator);
/* FW-D282 with the names (n) that there are, and the one that was probably meant */
fw_status fw_recipe_asrun_unknown(const fw_recipe_asrun_reader *r, const char *what,
                                  const char *name, const char *const *known, int n);
/* the value of a word coupon= */
fw_status fw_recipe_asrun_coupon_read(const fw_recipe_asrun_reader *r, const char *text,
                                      fw_recipe_coupon *coupon);

/* The row of a coupon of a log with what it was read of, and whether that was there: by the step that it is logged for (else
   FW-D706) and by the times of the log (else FW-D707) */
fw_status fw_recipe_asrun_stage(fw_arena *arena, const fw_recipe_asrun *run,
                                const fw_recipe_asrun_entry *e, const fw_recipe_coupon *c,
                                fw_process_measurement *row, bool *there, fw_diags *diags);

/* asrun_entry.c: the step of e as it was set in this run, of which earlier entries may be; anew: of a flow that was not computed,
   as its law times it with the values that the flow has here */
fw_status fw_recipe_asrun_as_set(fw_arena *arena, const fw_recipe_asrun *run,
                                 const fw_recipe_asrun_entry *e, bool anew,
                                 const fw_process_step **as_set);
/* asrun_runs.c: is o the run of an earlier step, of the wafer and by the time of e, that stands in the end? And what of a run is
   not accepted; NULL: nothing that the flow alone has limits for */
bool fw_recipe_asrun_is_behind(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o,
                               const fw_recipe_asrun_entry *e);
const fw_recipe_measured *fw_recipe_asrun_not_accepted(const fw_recipe_asrun_entry *o);
/* asrun_values.c: FW-D736 where what was measured or set of an entry that was just added is outside of what its step accepts */
fw_status fw_recipe_asrun_ask_values(const fw_recipe_asrun_entry *e, fw_place place,
                                     fw_diags *diags);
/* asrun_time.c: "step S14 (line 2, ...) was planned with 25 min, and with the values that are used here it would be 18 min"; nothing
   where it was planned as the flow plans it here */
fw_status fw_recipe_asrun_put_otherwise(fw_arena *arena, const fw_recipe_asrun *run,
                                        const fw_recipe_asrun_entry *o, fw_text *how);
/* asrun.c: FW-D735; is there, behind the readings of e that follow the plan, a run that was planned otherwise than the flow plans
   it here? `first`: of these n readings */
fw_status fw_recipe_asrun_ask_plan(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, int n,
                                   const fw_recipe_coupon *first, bool *otherwise, fw_diags *diags);
/* asrun_compare.c, asrun_values.c: is it the last entry of its step and wafer, which counts? what is accepted of its step; a
   limit as it is written; does what was measured and set keep its limits? */
bool fw_recipe_asrun_is_last(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e);
const fw_process_accept *fw_recipe_asrun_accept(const fw_process_step *step, const char *measure);
double fw_recipe_asrun_limit(const char *text, double absent);
/* is it within these limits? An empty one is none */
bool fw_recipe_asrun_inside(const char *low, const char *high, double value);
bool fw_recipe_asrun_accepted(const fw_recipe_measured *m);
bool fw_recipe_asrun_allowed(const fw_recipe_set *set);
/* recipe_words.c: "7.9 um (left), 8 um (top)" of the sites that are not accepted */
void fw_recipe_asrun_put_out(const fw_recipe_measured *m, const char *unit, fw_text *out);
/* "80.3 mTorr", in the unit of the plan; behind that " (written 10.7 Pa)" where it was written in another one */
void fw_recipe_asrun_put_set(const fw_recipe_set *s, fw_text *out);
void fw_recipe_asrun_put_set_beside_planned(const fw_recipe_set *s, fw_text *out);
/* What the values of an entry are judged by, as words of its line: limits of NAME=LOW HIGH PLANNED UNIT, "-" for none; and into an
   entry that has a value of that name: a line is judged by the plan that held when it was written */
bool fw_recipe_asrun_is_limits(const char *name);
void fw_recipe_asrun_put_limits(const fw_recipe_asrun_entry *e, fw_text *out);
fw_status fw_recipe_asrun_take_limits(fw_arena *arena, fw_recipe_asrun_entry *e, const char *name,
                                      const char *text);
/* what was planned, as the member of that name: a word, else the number that it has in its unit, null where that is not known */
void fw_recipe_asrun_planned(const fw_quantity *q, double planned, fw_json *out);

/* what was measured of a thickness against what the step's law makes of the time that it took, and of what was set */
typedef struct fw_recipe_amount_in_time {
    bool fits;                          /* or there is nothing to hold against each other */
    const fw_recipe_measured *measured; /* in the unit of what is accepted */
    double
        took_s; /* by the log, the runs that it goes on from included, at what is set in this one */
    double time_s, law_m, off; /* what the law makes of that time, and relatively how surely */
    const char *formula;
} fw_recipe_amount_in_time;

/* recipe_words.c: the amount that the step's law takes and that it adds or removes; NULL: its time is not that of an outcome (a bake,
   a spin). What was measured of it, SI; NaN: nothing */
const fw_process_argument *fw_recipe_asrun_amount_of_law(const fw_process_step *s);
double fw_recipe_asrun_amount_measured(const fw_recipe_asrun_entry *e, const fw_quantity *planned,
                                       const fw_recipe_measured **as);

/* ---- runs of one step on one wafer, one after the other: asrun_runs.c ---- */

/* the run of e's step and wafer before that of e, which a later entry did not take the place of; NULL: e is the first */
const fw_recipe_asrun_entry *fw_recipe_asrun_run_before(const fw_recipe_asrun *run,
                                                        const fw_recipe_asrun_entry *e);
/* the same where both come to one longer run: their step adds up (step_kinds.def), and nothing between them renewed or took
   away what it works on */
const fw_recipe_asrun_entry *fw_recipe_asrun_goes_on_from(const fw_recipe_asrun *run,
                                                          const fw_recipe_asrun_entry *e);
/* asrun_runs.c: what the run of a rate that was read in the entry was set to, into a row that does not say it */
void fw_recipe_asrun_etched_at(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                               fw_process_measurement *row);
/* asrun_runs.c: does e say that it stands in the place of o? did any entry say so of o? Then o never was */
bool fw_recipe_asrun_replaces(const fw_recipe_asrun_entry *e, const fw_recipe_asrun_entry *o);
bool fw_recipe_asrun_taken_back(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o);

/* asrun_runs.c: did the wafer (NULL: of a log without) go on to later steps without that one? */
bool fw_recipe_asrun_left_out(const fw_recipe_asrun *run, const fw_process_step *step,
                              const char *wafer);
/* asrun_compare.c: does a later run go on from this one? Then it is neither short nor repeated: both come to one */
bool fw_recipe_asrun_is_gone_on(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e);
/* The run of an earlier step that was done again after e, of the wafer (NULL: of any), or of the step that e inspects where
   there was none before e: what e found, or did, is not so. NULL: it stands. FW-D687 and FW-D707 say it of the entry that shows it */
const fw_recipe_asrun_entry *fw_recipe_asrun_overtaken(const fw_recipe_asrun *run,
                                                       const fw_recipe_asrun_entry *e,
                                                       const char *wafer);
/* was the step of o run on the wafer before e had ended, too? */
bool fw_recipe_asrun_is_again(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *o,
                              const fw_recipe_asrun_entry *e, const char *wafer);
/* asrun_runs.c: the run by which what a coupon's stage reads was not there at e: it makes it and is after e, or it ends it and is
   before. NULL: it was there, or the log does not say */
const fw_recipe_asrun_entry *fw_recipe_asrun_not_there(const fw_recipe_asrun *run,
                                                       const fw_recipe_asrun_entry *e,
                                                       const fw_process_coupon_stage *stage);
fw_status fw_recipe_asrun_ask_overtaken(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                        fw_place place, fw_diags *diags);
typedef struct fw_recipe_runs { /* that come to one longer run */
    int n;
    double took_s; /* of all; of one load where there are several */
    double
        time_s; /* the same, each as long as it would have been at what was set in the last one */
} fw_recipe_runs;
fw_recipe_runs fw_recipe_asrun_runs(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e);

/* "short", "in window", "long", "no plan", or "unclear" (FW-D680, FW-D684, FW-D732, FW-D759: asked, and not answered): an entry's duration, with
   the runs that it goes on from */
const char *fw_recipe_asrun_in_time(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e);
/* of one that is unclear since it is longer than what is finished at the bench explains: "took 22 min, and is to stop by 12 min,
   with ..."; false: it is not */
bool fw_recipe_asrun_put_left_in_it(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                    fw_text *out);
/* of one that is unclear since its pauses leave less than the first look: "took 1 h 50 min, of which its pauses leave 80 min, ..." -> 732;
   or what finishes it at the bench -> 759; 0: it is not. Both are numbers of what it is asked by */
int fw_recipe_asrun_put_inside(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                               fw_text *out);
/* recipe_words.c, FW-D703: where the plan has no time for a step that goes on for as long as the wafer is in it, did this one take much less or more
   than other wafers of the lot, or more than a working day? *planned: "no planned time (missing ...); other wafers took 15 min" */
fw_status fw_recipe_asrun_odd_time(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, const char **planned);
/* recipe_words.c: what a liquid takes along in so long, by the rates that the pack states: ", up to 2.1 um of aluminium where it is open" */
void fw_recipe_asrun_put_taken(const fw_recipe_asrun_entry *e, double time_s, fw_text *out);
/* recipe_words.c: "temperature = 32 Cel" of whatever the entry says that was set otherwise */
void fw_recipe_asrun_put_settings(fw_text *out, const fw_recipe_asrun_entry *e);
/* as members "overtaken_by" and "as_set", where it was */
void fw_recipe_asrun_as_set_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                 fw_json *out);
/* FW-D708: has the filling that the entry names served more wafers by then, or for longer, than it does? *is NULL: no, or it is
   not known; else "wafer 3 of one filling", and "a filling of SC1 serves 2 (ID)" */
fw_status fw_recipe_asrun_bath_life(fw_arena *arena, const fw_recipe_asrun *run,
                                    const fw_recipe_asrun_entry *e, const char **is,
                                    const char **allowed);
/* asrun_values.c: FW-D709 where one thing of the entry says otherwise than another: a coupon and what was measured, or the time
   that it says it was etched for and that of the run */
fw_status fw_recipe_asrun_ask_contradictions(const fw_recipe_asrun *run,
                                             const fw_recipe_asrun_entry *e, fw_place place,
                                             fw_diags *diags);
/* Runs that add up are to stop when one run is, with handling once more for each; *surely NULL, or where handling may be in
   every run: so much is too long in any case. One run: its loads together */
double fw_recipe_asrun_stop_by(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                               const fw_recipe_runs *runs, double *surely);
/* "45 min", "31 min in 2 runs" */
void fw_recipe_asrun_put_took(fw_text *out, const fw_recipe_asrun_entry *e,
                              const fw_recipe_runs *runs);
/* is it in its window, but would not be were what is finished at the bench no part of its time, because of what was set? */
bool fw_recipe_asrun_is_late_as_set(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e);
/* FW-D654: "19.1 um (17.9 to 20.2), by t = d/R in 45 min"; a->fits: what was measured goes with it, or nothing was */
fw_status fw_recipe_asrun_amount_by_law(fw_arena *arena, const fw_recipe_asrun *run,
                                        const fw_recipe_asrun_entry *e, fw_recipe_amount_in_time *a,
                                        fw_text *planned, fw_text *actual);
/* loads one after the other that share the time of the entry, and how many entries do (*together) */
double fw_recipe_asrun_loads(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                             int *together);

/* asrun_runs.c: were more wafers in the machine of the entry at one time than its step, or the machine, takes? *is NULL:
   no, or no machine is known; else "3 wafers", and "1 in hotplate" are allowed. FW-D659 says it of an entry */
fw_status fw_recipe_asrun_too_many(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, const char **is,
                                   const char **allowed);
fw_status fw_recipe_asrun_ask_at_once(fw_arena *arena, const fw_recipe_asrun *run,
                                      const fw_recipe_asrun_entry *e, fw_place place,
                                      fw_diags *diags);
/* how far its times may be off: a clock that was read to the minute leaves up to a minute */
double fw_recipe_asrun_clock_s(const fw_recipe_asrun_entry *e);

/* ---- what a wafer waited before an entry: asrun_runs.c ---- */

typedef struct fw_recipe_wait {
    const char *since; /* id of the step from whose end on */
    const char *is;    /* what the wafer is like meanwhile, "wet with water"; NULL: of a lag */
    const fw_recipe_asrun_entry *from; /* that counts of it; NULL: it is not in the log */
    double waited_s;     /* below 0: it began before that step ended; NaN: not known */
    double min_s, max_s; /* max_s NaN: no limit */
    bool fine;
} fw_recipe_wait;
/* The next wait of an entry, from *i on, which begins with 0: of each lag of its step, of each state of the wafer that its step
   ends, and of the step before it where that is below 0. false: there is none */
bool fw_recipe_asrun_wait(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, int *i,
                          fw_recipe_wait *wait);
/* does it stand, of a run that others follow on: did the wafer come to the next one from the same? */
bool fw_recipe_asrun_wait_stands(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                 const fw_recipe_wait *wait);
/* "0 s to 10 min"; "waited 21 min since C20", "waited 21 min since C20, wet with water" or "began 5 min
   before C20 ended" */
void fw_recipe_put_wait_limits(fw_text *out, const fw_recipe_wait *wait);
void fw_recipe_put_waited(fw_text *out, const fw_recipe_wait *wait);
/* FW-D648 where an entry that was just added, or one of before that follows on it, did not wait as it should */
fw_status fw_recipe_asrun_ask_waits(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                    fw_place place, fw_diags *diags);

typedef struct fw_recipe_asrun_total {
    int logged, out, repeated;
    int left_out; /* steps that a wafer went on without, of each of them */
    /* of the steps in the log that have a planned time; what several wafers share counts once. earlier_s: what of actual_s
       went into runs before the last one of a wafer */
    double planned_s, actual_s, earlier_s;
    int unplanned; /* steps in the log that have none, and what they took */
    double unplanned_s;
} fw_recipe_asrun_total;
fw_status fw_recipe_asrun_sum_up(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                 fw_arena *arena, fw_recipe_asrun_total *total);

/* what became of wafers as a table, and what somebody wrote down as a deviation, of every entry: html_wafers.c, asrun_compare.c */
void fw_recipe_asrun_fates_html(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                fw_text *out);
void fw_recipe_asrun_put_declared(const fw_recipe_asrun *run, fw_text *out);
void fw_recipe_asrun_declared_html(const fw_recipe_asrun *run, fw_text *out);

/* ---- what became of wafers: asrun_runs.c ---- */

/* "scrapped", "held", "resumed" */
const char *fw_recipe_fate_word(fw_recipe_fate fate);
/* the entry by which the wafer is scrapped or held at that time; NULL: it is there. INFINITY: by all that is in the log */
const fw_recipe_asrun_entry *fw_recipe_asrun_out(const fw_recipe_asrun *run, const char *wafer,
                                                 double time_s);
/* is there to be an entry of the step for the wafer? Neither was it run, nor is the wafer out */
bool fw_recipe_asrun_expects(const fw_recipe_asrun *run, const fw_process_step *step,
                             const char *wafer);
/* How many wafers come out of the first `steps` steps of the flow (FW_FATE_RUN), or are held or scrapped in one of them */
int fw_recipe_asrun_count(const fw_process_flow *flow, const fw_recipe_asrun *run, int steps,
                          fw_recipe_fate fate);

/* ---- control charts of what was measured ---- */

typedef struct fw_recipe_chart_point { /* a subgroup: the sites of one wafer */
    const char *label;
    double mean, range; /* range of its sites; of single values the moving range; NaN: none */
    int n;              /* sites */
    bool outside;       /* a site of it is not accepted */
    bool beyond, run,
        range_beyond; /* of the limits; the eighth and further of one side; of the range's limits */
} fw_recipe_chart_point;

typedef struct fw_recipe_chart {
    const char *title, *unit;
    double low, high; /* what is accepted; NaN: no such limit */
    fw_recipe_chart_point *point;
    int npoint;
    int size; /* of the subgroups that limits are of: the most frequent one; 1: individual values */
    bool limits; /* there are enough subgroups for limits of their own */
    int counted; /* subgroups of that size */
    double centre, lower, upper, range_centre, range_lower, range_upper;
} fw_recipe_chart;

enum { FW_CHART_LEAST = 8, FW_CHART_FIRM = 20, FW_CHART_RUN = 8 };

/* factors of subgroups of n, 2 to 10; false: no such n */
bool fw_recipe_chart_factors(int n, double *A2, double *D3, double *D4);
/* limits and what breaks the rules, from the points' means, ranges and sizes */
void fw_recipe_chart_judge(fw_recipe_chart *chart);
/* as an SVG fragment, two panels one above the other */
void fw_recipe_chart_svg(const fw_recipe_chart *chart, fw_text *out);

#endif
