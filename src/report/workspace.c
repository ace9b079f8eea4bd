/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include "base/constants.h"
#include "report/workspace.h"
#include <math.h>

static void span(fw_text *out, double low, double high, bool angle) {
    if (angle)
        fw_markup(out, "{d} to {d}", low, high);
    else
        fw_markup(out, "{u} to {u}", low, "m", high, "m");
}

static void boxes(fw_page *page, const char *flow) {
    const fw_device *d = page->in->device;
    for (int i = 0; i < d->nworkspace; i++) {
        const fw_workspace_box *b = &d->workspace[i];
        if (!fw_device_in_flow(b->flow, flow)) continue;
        fw_text_add(page->out, "<p>Required box, from the drawn pose: x ");
        span(page->out, b->x_min_m, b->x_max_m, false);
        fw_text_add(page->out, ", y ");
        span(page->out, b->y_min_m, b->y_max_m, false);
        fw_text_add(page->out, ", rotation ");
        span(page->out, b->phi_min_rad, b->phi_max_rad, true);
        fw_text_add(page->out, ".</p>\n");
    }
}

static void judgement(fw_text *out, const fw_workspace_result *w) {
    if (!w->reachable)
        fw_markup(out,
                  "<p><strong class=\"no\">Not reachable:</strong> the mechanism cannot be "
                  "assembled at ({u}, {u}, {d}).</p>\n",
                  w->fail_x_m, "m", w->fail_y_m, "m", w->fail_phi_rad);
    else
        fw_markup(out, "<p>All of it can be reached{r}. Volume {n} mm\u00b2\u00b7\u00b0.</p>\n",
                  w->certified ? ", <strong>certified</strong> by interval arithmetic: the "
                                 "peaks below enclose every pose of the box"
                               : "; peaks from samples, <strong>not certified</strong>",
                  w->volume_m2_rad * 1e6 * FW_DEG_PER_RAD);
}

static void peaks(fw_page *page, const fw_variant_verdict *v) {
    fw_text *out = page->out;
    fw_text_add(
        out,
        "<div class=\"wide\"><table><caption>Worst pose of every hinge</caption><thead>"
        "<tr><th scope=\"col\">Hinge</th><th scope=\"col\" class=\"n\">Angle (\u00b0)</th><th "
        "scope=\"col\" class=\"n\">Limit (\u00b0)</th><th scope=\"col\" class=\"n\">Utilisation"
        "</th><th scope=\"col\" class=\"n\">Platform x</th><th scope=\"col\" "
        "class=\"n\">y</th><th scope=\"col\" class=\"n\">rotation</th></tr></thead>"
        "<tbody>\n");
    for (int k = 0; k < FW_SIX && k < v->mechanism->npin; k++) {
        const fw_workspace_peak *p = &v->workspace.peak[k];
        double limit = fw_report_pin_limit(v->mechanism, k), u = fabs(p->angle_rad) / limit;
        fw_markup(out, "<tr{r}><th scope=\"row\">{s}</th><td class=\"n\">{D} \u00b1 ",
                  u > 1.0 ? " class=\"bad\"" : "", v->mechanism->pin[k].id, p->angle_rad);
        fw_markup_number(out, p->error_rad * FW_DEG_PER_RAD, 2);
        fw_markup(out,
                  "</td><td class=\"n\">{D}</td><td class=\"n\">{p}</td><td "
                  "class=\"n\">{u}</td><td class=\"n\">{u}</td><td class=\"n\">{d}</td></tr>\n",
                  limit, u, p->x_m, "m", p->y_m, "m", p->phi_rad);
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

/* the reachable set of the flow; what is not a six-bar with flexures has none */
static fw_status reachable(fw_page *page, const fw_variant_verdict *v) {
    fw_workspace_map *map = fw_arena_one(page->arena, fw_workspace_map);
    FW_NEED(map);
    FW_TRY(fw_workspace_map_make(page->arena, v->mechanism, fw_workspace_quick, map));
    if (map->none || !(map->volume.value.lo > 0.0)) return FW_OK;
    const fw_report_workspace_flow flow = {v->variant ? v->variant->flow : NULL, v->mechanism, map,
                                           &v->workspace, NULL};
    fw_text picture = fw_text_new(page->arena);
    double height;
    FW_TRY(fw_report_slices(page->arena, &flow, 0.0, &height, &picture));
    FW_TRY(fw_text_end(&picture));
    fw_markup(page->out,
              "<p>Reachable with every hinge inside its elastic limit: {n} to {n} "
              "mm\u00b2\u00b7\u00b0, <strong>certified</strong>; x from {u} to {u}, y from {u} "
              "to {u}, rotation {d} to {d}. It grows with all limits to the power ",
              map->volume.value.lo * 1e6 * FW_DEG_PER_RAD,
              map->volume.value.hi * 1e6 * FW_DEG_PER_RAD, map->survey.least[0].hi, "m",
              map->survey.most[0].lo, "m", map->survey.least[1].hi, "m", map->survey.most[1].lo,
              "m", map->survey.least[2].hi, map->survey.most[2].lo);
    fw_markup_number(page->out, map->survey.exponent, 3);
    fw_text_add(page->out, ".</p>\n<figure class=\"wide\">");
    fw_svg_begin(page->out, &(fw_svg_frame){.width = FW_SLICES_WIDTH,
                                            .height = height,
                                            .decimals = 2,
                                            .size = FW_SVG_SIZE_BEHIND,
                                            .lead = "role='img'",
                                            .font = fw_svg_font_page});
    fw_svg_title(page->out, "Workspace at constant rotation, x and y in \u00b5m");
    fw_svg_paper(page->out, "#fff");
    fw_text_bytes(page->out, picture.data, picture.length);
    fw_svg_close(page->out, "svg");
    fw_text_add(page->out,
                "<figcaption>Workspace at constant rotation, x and y of the "
                "platform in \u00b5m from the drawn pose. The boundary has the colour of "
                "the hinge that is at its limit; dashed: the required box. The line is "
                "drawn from samples, areas and volume are proved.</figcaption></figure>\n");
    return FW_OK;
}

fw_status fw_report_section_workspace(fw_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_variant_verdict *v = &verdict->variant[i];
        if (!v->workspace.required) continue;
        any = true;
        const char *flow = v->variant ? v->variant->flow : NULL;
        fw_markup(page->out, "<h3>{s}</h3>\n", flow ? flow : "all flows");
        boxes(page, flow);
        judgement(page->out, &v->workspace);
        if (v->workspace.reachable) peaks(page, v);
        FW_TRY(reachable(page, v));
    }
    if (!any) fw_text_add(page->out, "<p>The description states no required workspace.</p>\n");
    return fw_text_end(page->out);
}
