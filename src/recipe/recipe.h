/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The computed flow as documents. */
#ifndef FW_RECIPE_RECIPE_H
#define FW_RECIPE_RECIPE_H
#include "base/text.h"
#include "process/process.h"
#include "schedule/schedule.h"

typedef struct fw_recipe_header {
    const char *device, *flow_sha256, *mask_sha256, *program_version;
    bool rejected;
    const fw_schedule *schedule; /* NULL: none was asked for */
} fw_recipe_header;

fw_status fw_recipe_write_html(const fw_flow *flow, const fw_recipe_header *header, fw_text *out);
fw_status fw_recipe_write_csv(const fw_flow *flow, const fw_recipe_header *header, fw_text *out);
fw_status fw_recipe_write_ics(const fw_flow *flow, const fw_recipe_header *header, fw_text *out);
fw_status fw_recipe_write_json(const fw_flow *flow, const fw_recipe_header *header, fw_text *out);
/* who does what when; only with header->schedule */
fw_status fw_recipe_write_schedule_csv(const fw_flow *flow, const fw_recipe_header *header,
                                       fw_text *out);
fw_status fw_recipe_write_schedule_json(const fw_flow *flow, const fw_recipe_header *header,
                                        fw_text *out);
/* machines, people and hold windows over the days */
fw_status fw_recipe_write_schedule_svg(const fw_flow *flow, const fw_recipe_header *header,
                                       fw_text *out);
/* cross-section of the wafer after step `index`, as an SVG fragment */
fw_status fw_recipe_section_svg(const fw_flow *flow, int index, fw_text *out);

#endif
