/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files about the as-run log share. Private to recipe/. */
#ifndef FW_RECIPE_ASRUN_PARTS_H
#define FW_RECIPE_ASRUN_PARTS_H
#include "recipe/asrun.h"

typedef struct fw_recipe_asrun_reader {
    fw_arena *arena;
    const fw_process_flow *flow;
    const fw_recipe_asrun *run; /* whose wafers there are */
    /* the flow is the computed one of the log's own plan: what a step sets is all known */
    bool bound;
    fw_diags *diags;
    fw_place place;
} fw_recipe_asrun_reader;

/* asrun_entry.c: cuts a copy of the words at `separator`; the first is the step, the others are name=value */
fw_status fw_recipe_asrun_entry_read(const fw_recipe_asrun_reader *r, const char *words, size_t n,
                                     char separator, fw_recipe_asrun_entry *e);

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
/* asrun_coupon.c: the value of a word coupon= */
fw_status fw_recipe_asrun_coupon_read(const fw_recipe_asrun_reader *r, const char *text,
                                      fw_recipe_coupon *coupon);

/* asrun_deviation.c: is it the last entry of its step and wafer, which counts? how long it took; what is accepted of its
   step; a limit as it is written; does what was measured, set and waited keep its limits? */
bool fw_recipe_asrun_is_last(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e);
const char *fw_recipe_asrun_in_time(const fw_process_step *step, double actual_s);
const fw_process_accept *fw_recipe_asrun_accept(const fw_process_step *step, const char *measure);
double fw_recipe_asrun_limit(const char *text, double absent);
bool fw_recipe_asrun_accepted(const fw_process_accept *a, const fw_recipe_measured *m);
bool fw_recipe_asrun_allowed(const fw_recipe_set *set);
double fw_recipe_asrun_waited(const fw_recipe_asrun *run, const fw_process_lag *lag,
                              const fw_recipe_asrun_entry *e);
bool fw_recipe_asrun_wait_is_fine(const fw_process_lag *lag, double wait_s);
/* of one wafer, or both of the whole lot */
bool fw_recipe_asrun_same_wafer(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b);
/* "48 to 52", "any to 52"; the limits of a wait */
void fw_recipe_asrun_put_span(fw_text *out, const char *low, const char *high);
void fw_recipe_asrun_put_wait(fw_text *out, const fw_process_lag *lag);

#endif
