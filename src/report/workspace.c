/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include <math.h>

static void span(fw_text *out, double low, double high, bool angle) {
    if (angle)
        fw_report_markup(out, "{d} to {d}", low, high);
    else
        fw_report_markup(out, "{u} to {u}", low, "m", high, "m");
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
        fw_report_markup(out,
                         "<p><strong class=\"no\">Not reachable:</strong> the mechanism cannot be "
                         "assembled at ({u}, {u}, {d}).</p>\n",
                         w->fail_x_m, "m", w->fail_y_m, "m", w->fail_phi_rad);
    else
        fw_report_markup(out,
                         "<p>All of it can be reached{r}. Volume {n} mm\u00b2\u00b7\u00b0.</p>\n",
                         w->certified ? ", <strong>certified</strong> by interval arithmetic: the "
                                        "peaks below enclose every pose of the box"
                                      : "; peaks from samples, <strong>not certified</strong>",
                         w->volume_m2_rad * 1e6 * 57.29577951308232);
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
        fw_report_markup(out, "<tr{r}><th scope=\"row\">{s}</th><td class=\"n\">{D} \u00b1 ",
                         u > 1.0 ? " class=\"bad\"" : "", v->mechanism->pin[k].id, p->angle_rad);
        fw_report_number(out, p->error_rad * 57.29577951308232, 2);
        fw_report_markup(
            out,
            "</td><td class=\"n\">{D}</td><td class=\"n\">{p}</td><td "
            "class=\"n\">{u}</td><td class=\"n\">{u}</td><td class=\"n\">{d}</td></tr>\n",
            limit, u, p->x_m, "m", p->y_m, "m", p->phi_rad);
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

fw_status fw_report_section_workspace(fw_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_variant_verdict *v = &verdict->variant[i];
        if (!v->workspace.required) continue;
        any = true;
        const char *flow = v->variant ? v->variant->flow : NULL;
        fw_report_markup(page->out, "<h3>{s}</h3>\n", flow ? flow : "all flows");
        boxes(page, flow);
        judgement(page->out, &v->workspace);
        if (v->workspace.reachable) peaks(page, v);
    }
    if (!any) fw_text_add(page->out, "<p>The description asks for no workspace.</p>\n");
    return fw_text_end(page->out);
}
