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

#endif
