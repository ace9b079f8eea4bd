/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and names as the run sheet prints them; private to recipe/. */
#ifndef FW_RECIPE_RECIPE_WORDS_H
#define FW_RECIPE_RECIPE_WORDS_H
#include "recipe/recipe.h"
#include "schedule/schedule.h"

/* a row of a step: a setting, an input of the time law or a derived value */
typedef struct fw_recipe_row {
    const char *name, *low, *high; /* tolerances as written, "" = none */
    const fw_quantity *q;
    bool derived;
} fw_recipe_row;

/* every quantity of a step once: settings, then inputs that are no setting, then derived ones */
fw_status fw_recipe_step_rows(fw_arena *arena, const fw_process_step *step, fw_recipe_row **row,
                              int *n);

/* of the lot: those of the schedule, else one */
int fw_recipe_wafers(const fw_recipe_header *header);

/* standard uncertainty in the quantity's own unit */
double fw_recipe_row_uncertainty(const fw_quantity *q);
/* shortest text of at most 12 digits: what arithmetic adds beyond them is no information. An
   uncertainty gets 9, since slopes by central difference hold about 1e-10. */
enum { FW_PLAIN_DIGITS = 12, FW_UNCERTAINTY_DIGITS = 9 };
void fw_recipe_put_plain(fw_text *out, double value);
void fw_recipe_put_uncertainty(fw_text *out, double value);
void fw_recipe_put_span(fw_text *out, const char *low, const char *high); /* "48 to 52" */
void fw_recipe_put_value(fw_text *out, double value); /* up to 6 significant digits */
/* unit for people: um as micrometre sign, Cel as degree sign; escaped for HTML */
void fw_recipe_put_unit(fw_text *out, const char *unit);
/* "um" for what a sheet prints as "µm": people type what they read; NULL: no memory */
const char *fw_recipe_unit_of_printed(fw_arena *arena, const char *unit);
/* NULL: no memory */
const char *fw_recipe_missing_list(fw_arena *arena, const fw_process_time *time);

/* "day 2, 13:05", or "Mon 2026-11-23, 13:05" where the calendar knows the first day */
void fw_recipe_put_moment(fw_text *out, const fw_schedule_calendar *calendar, double seconds);
void fw_recipe_put_wafers(fw_text *out, const fw_schedule_run *run); /* "3" or "1-6" */
/* sentences about a schedule: how long, how good, what is not known; escaped for XML and HTML */
void fw_recipe_put_schedule_summary(fw_text *out, const fw_schedule *s);
/* the section about it in the run sheet; nothing without a schedule */
void fw_recipe_html_schedule(const fw_recipe_header *header, fw_text *out);

/* one step of the run sheet; slicer NULL: nothing is cut, its layers are drawn not to scale */
struct fw_recipe_slicer;
struct fw_recipe_section_scale;
/* what is made: the block behind the cut, the parts and openings along it */
fw_status fw_recipe_html_pictures(const fw_process_flow *flow, const fw_recipe_header *header,
                                  struct fw_recipe_slicer *slicer,
                                  const struct fw_recipe_section_scale *scale, fw_text *out);
void fw_recipe_html_step(const fw_process_flow *flow, int index, const fw_recipe_header *header,
                         struct fw_recipe_slicer *slicer,
                         const struct fw_recipe_section_scale *scale, const int *number,
                         fw_text *out);
/* the numbers by which the steps' rows name their sources, one for each source of the flow; 0: none names it */
fw_status fw_recipe_source_numbers(fw_arena *arena, const fw_process_flow *flow, int **number);

/* "48 to 52", ">= 48", "<= 52", or nothing; escaped */
void fw_recipe_put_limits(fw_text *out, const char *low, const char *high);
/* "rinse in deionised water", "dry by spinning" */
const char *fw_recipe_finish_words(fw_arena *arena, const fw_process_finish *finish);

/* html_wafers.c: cells for every wafer of the schedule, and what to do where it went wrong; the hazards of a step by number; the table of hazards; what
   deviated */
void fw_recipe_html_wafers(const fw_process_step *step, bool of_dies,
                           const fw_recipe_header *header, fw_text *out);
/* how many fillings of its baths the lot takes, as the table of baths has them; nothing where one does */
void fw_recipe_html_fillings(const fw_process_flow *flow, const fw_process_step *step,
                             const fw_recipe_header *header, fw_text *out);
void fw_recipe_html_outcome(const fw_process_flow *flow, int index, const fw_recipe_header *header,
                            fw_text *out);
void fw_recipe_html_hazard_line(const fw_process_flow *flow, const fw_process_step *step,
                                fw_text *out);
void fw_recipe_html_hazards(const fw_process_flow *flow, fw_text *out);
/* rows of the first page: the wafer's places, its crystal, where the coupons are */
void fw_recipe_wafer_rows(const fw_process_flow *flow, const fw_recipe_header *header,
                          fw_text *out);
void fw_recipe_html_deviations(const fw_process_flow *flow, const fw_recipe_header *header,
                               fw_text *out);

/* recipe_tables.c: what the lot uses up */
struct fw_json;
fw_status fw_recipe_html_bill(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out);
fw_status fw_recipe_json_bill(const fw_process_flow *flow, const fw_recipe_header *header,
                              struct fw_json *out);

#endif
