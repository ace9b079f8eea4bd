/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is made, at the head of the run sheet: the block behind the cut, and widths to look for. */
#include "base/svg.h"
#include "recipe/sections.h"
#include "recipe/words.h"
#include <math.h>

static void parts(const fw_section_plan *plan, fw_text *out) {
    enum {
        MOST = 8
    }; /* a cut across a whole device meets dozens: they are in the picture of sections */
    if (plan->npart == 0 || plan->npart > MOST) return;
    fw_text_add(out, "<p>Along the cut, from the left: ");
    for (int i = 0; i < plan->npart; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_text_escaped(out, plan->part[i].label ? plan->part[i].label : "");
    }
    fw_text_add(out, ".</p>\n");
}

static void width(fw_text *out, double m) {
    fw_text_add(out, "<td class=\"n\">");
    if (isnan(m))
        fw_text_add(out, "-");
    else
        fw_put_value(out, m * 1e6);
    fw_text_add(out, "</td>");
}

static double rounded(double m) { /* to 1 nm: what a microscope can tell, and more */
    return isnan(m) ? m : 1e-9 * floor(m * 1e9 + 0.5);
}

static void openings(const fw_section_plan *plan, fw_text *out) {
    enum { MOST = 6 };
    if (plan->nopening == 0 || plan->nopening > MOST) return;
    fw_text_add(out, "<table class=\"small\"><tr><th>Opening at, µm</th><th class=\"n\">drawn</th>"
                     "<th class=\"n\">mask</th><th class=\"n\">top</th><th class=\"n\">bottom"
                     "</th><th class=\"n\">deep</th></tr>\n");
    for (int i = 0; i < plan->nopening; i++) {
        const fw_section_opening *o = &plan->opening[i];
        const double value[] = {o->drawn_m, o->mask_m, o->top_m, o->bottom_m, o->depth_m};
        fw_text_add(out, "<tr><td>");
        fw_put_value(out, rounded(0.5 * (o->from_m + o->to_m)) * 1e6);
        fw_text_add(out, "</td>");
        for (int k = 0; k < 5; k++)
            width(out, rounded(value[k]));
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</table>\n");
}

fw_status fw_html_pictures(const fw_flow *flow, const fw_recipe_header *header, fw_slicer *slicer,
                           const fw_section_scale *scale, fw_text *out) {
    double height;
    fw_section_plan plan;
    fw_text body = fw_text_new(out->arena);
    fw_text_add(&body, "");
    FW_TRY(fw_section_plan_of(slicer, flow, &plan));
    FW_TRY(fw_block_draw(slicer, flow, scale, flow->nstep - 1, 420.0, &body, &height));
    FW_TRY(fw_text_end(&body));
    fw_text_add(out, "<h3>What is made</h3>\n<div class=\"pair\"><div><p>Sections: ");
    fw_text_escaped(out, header->cut->name);
    fw_text_add(out,
                ", to scale along the cut, heights as each picture says. Walls stand where mask, "
                "printing and etches leave them. Hatched: nobody stated its thickness. A zigzag: "
                "drawn thinner than it is. The picture shows the finished wafer behind the same "
                "cut, seen from above.</p>\n");
    parts(&plan, out);
    openings(&plan, out);
    fw_text_add(out, "</div><div>");
    fw_svg_begin(out, &(fw_svg_frame){.width = 420,
                                      .height = ceil(height),
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .trail = "role='img'"});
    fw_svg_title(out, "finished wafer at the cut");
    fw_text_add(out, body.data);
    fw_svg_close(out, "svg");
    fw_text_add(out, "</div></div>\n");
    return FW_OK;
}
