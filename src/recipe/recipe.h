/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The computed flow as documents. */
#ifndef FW_RECIPE_RECIPE_H
#define FW_RECIPE_RECIPE_H
#include "base/text.h"
#include "mask/mask.h"
#include "measuring/measuring.h"
#include "process/process.h"
#include "schedule/schedule.h"
#include "statics/statics.h"
#include "verdict/verdict.h"
#include "wafer/wafer.h"

typedef struct fw_recipe_cut { /* where the wafer is cut open, and how much of it is shown */
    fw_geometry_cut_line line; /* shown from 0 to length_m along it */
    double length_m, depth_m;  /* depth to the left of the line: of the view from above */
    const char *name;          /* "hinge C, radially through its gap" */
} fw_recipe_cut;

typedef struct fw_recipe_header {
    const char *device, *flow_sha256, *mask_sha256, *program_version;
    bool rejected;
    const char *const *because; /* (nbecause) why the verdict rejects the design */
    int nbecause;
    const fw_schedule *schedule;   /* NULL: none was asked for */
    const fw_mask *mask;           /* NULL: none was made; then the layers are drawn not to scale */
    const fw_recipe_cut *cut;      /* NULL: the same */
    const fw_measuring *measuring; /* which measurement pays; NULL: not asked for */
    const fw_statics_tethers *tethers; /* NULL: there are none; then no mechanism is needed */
    const fw_mechanism *mechanism;     /* that they hold */
    const fw_text *release;            /* the picture of the release as a fragment; NULL: none */
    const fw_verdict_variant_verdict *verdict; /* of this flow, for what drying it bears; NULL */
    const fw_wiring *wiring;                   /* nets and their contacts; NULL: nothing is drawn */
    const fw_verdict_from_outside
        *outside; /* (noutside) what the device needs and the masks do not have */
    int noutside;
    bool plates_written;        /* there are plates as the shop writes them, */
    bool test_die;              /* a test die, */
    const char *test_die_lacks; /* what steps read and it has no room for; NULL: nothing */
    const fw_wafer *wafer;      /* that those plates are of; NULL: one die, or none */
} fw_recipe_header;

fw_status fw_recipe_write_html(const fw_process_flow *flow, const fw_recipe_header *header,
                               fw_text *out);
fw_status fw_recipe_write_csv(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out);
fw_status fw_recipe_write_ics(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out);
fw_status fw_recipe_write_json(const fw_process_flow *flow, const fw_recipe_header *header,
                               fw_text *out);
/* which measurement pays; only with header->measuring */
fw_status fw_recipe_write_measurements_json(const fw_process_flow *flow,
                                            const fw_recipe_header *header, fw_text *out);
/* who does what when; only with header->schedule */
fw_status fw_recipe_write_schedule_csv(const fw_process_flow *flow, const fw_recipe_header *header,
                                       fw_text *out);
fw_status fw_recipe_write_schedule_json(const fw_process_flow *flow, const fw_recipe_header *header,
                                        fw_text *out);
/* machines, people and hold windows over the days */
fw_status fw_recipe_write_schedule_svg(const fw_process_flow *flow, const fw_recipe_header *header,
                                       fw_text *out);
/* only with header->mask and header->cut: the section after every step below each other; the same
   as JSON; what stands around the cut after the steps that change the wafer, seen from above */
fw_status fw_recipe_write_sections_svg(const fw_process_flow *flow, const fw_recipe_header *header,
                                       fw_text *out);
fw_status fw_recipe_write_sections_json(const fw_process_flow *flow, const fw_recipe_header *header,
                                        fw_text *out);
fw_status fw_recipe_write_stack_svg(const fw_process_flow *flow, const fw_recipe_header *header,
                                    fw_text *out);
/* layers of the wafer after step `index`, not to scale, as an SVG fragment */
fw_status fw_recipe_section_svg(const fw_process_flow *flow, int index, fw_text *out);

/* when every place of the die is free, for a picture of it; NULL where the flow frees nothing or how far it must
   go is not known. layout: with the flow's own marks. islands: what stands by itself is there */
enum { FW_RECIPE_RELEASE_COLUMNS = 288 };
fw_status fw_recipe_release_map(fw_arena *arena, const fw_process_flow *flow,
                                const fw_layout *layout, bool islands, const fw_release_map **map);
/* the picture: a file of its own, or a fragment for a page */
fw_status fw_recipe_write_release_svg(fw_arena *arena, const fw_process_flow *flow,
                                      const fw_layout *layout, bool islands,
                                      const fw_release_map *map, bool file, fw_text *out);

/* ---- recipe_words.c: how a recipe says things ---- */

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
/* a cell of a table: its value in its unit, or its word; nothing where it is unknown */
void fw_recipe_put_known(fw_text *out, const fw_quantity *q);
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
