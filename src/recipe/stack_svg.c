/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block behind the cut after every step that changes the wafer: two in a row. */
#include "recipe/sections.h"
#include "base/svg.h"
#include <math.h>
#include <stdlib.h>

fw_status fw_recipe_write_stack_svg(const fw_flow *flow, const fw_recipe_header *header,
                                    fw_text *out) {
    enum { COLUMNS = 2 };
    const double whole = 800.0, own = 385.0, across = whole / COLUMNS;
    fw_slicer slicer;
    fw_section_scale scale;
    FW_TRY(fw_slicer_start(out->arena, header->mask, header->cut, &slicer));
    FW_TRY(fw_section_scale_of(out->arena, flow, header->cut, &scale));
    fw_text body = fw_text_new(out->arena);
    fw_section_head(flow, header, "what stands behind the cut", &body);
    fw_section_scale_bar(&scale, own * cos(0.5), 44.0, &body);
    double y = 70.0, row = 0.0;
    int column = 0;
    for (int i = 0; i < flow->nstep; i++) {
        const fw_step *s = &flow->step[i];
        double height;
        fw_films films;
        if (!fw_step_changes(s)) continue;
        fw_svg_open(&body, "g transform='translate({1} {1})'\n", across * column, y);
        fw_svg_put(&body, "text y='12' font-size='13' font-weight='bold'>{s}&#160; {s}\n", s->id,
                   s->title);
        fw_svg_open(&body, "g transform='translate(0 20)'\n");
        FW_TRY(fw_block_draw(&slicer, flow, &scale, i, own, &body, &height));
        FW_TRY(fw_flow_films(out->arena, flow, i, &films));
        int rows = fw_section_legend(flow, &films, own, 2, height + 4.0, &body);
        fw_svg_close(&body, "g");
        fw_svg_close(&body, "g\n");
        row = fmax(row, height + 44.0 + 14.0 * rows);
        if (++column < COLUMNS) continue;
        column = 0;
        y += row;
        row = 0.0;
    }
    return fw_section_page(&body, y + row, "what stands behind the cut", out);
}
