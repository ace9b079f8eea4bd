/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include "base/constants.h"
#include <math.h>

enum { BAR = 150 };

static double bar_scale(const fw_hinge_verdict *hinge, int nhinge) {
    double most = 1.2;
    for (int i = 0; i < nhinge; i++) {
        double u =
            isfinite(hinge[i].utilisation_high) ? hinge[i].utilisation_high : hinge[i].utilisation;
        if (isfinite(u)) most = fmax(most, 1.05 * u);
    }
    return fmin(most, 20.0);
}

/* a bar up to the utilisation, a whisker over its error band, a line at the limit */
static void bar(fw_text *out, const fw_hinge_verdict *h, double most) {
    if (!isfinite(h->utilisation)) {
        fw_text_add(out, "no limit known");
        return;
    }
    double px = BAR / most, u = fmin(h->utilisation, most);
    fw_svg_begin(out, &(fw_svg_frame){.width = BAR,
                                      .height = 16,
                                      .size = FW_SVG_SIZE_BEFORE,
                                      .lead = "class='bar' role='img'"});
    fw_svg_title(out, "{p} of the limit", h->utilisation);
    fw_svg_put(out, "rect y='3' width='{i}' height='10' fill='#eaeef2'", BAR);
    fw_svg_put(out, "rect y='3' width='{c}' height='10' fill='{r}'", u * px,
               fw_report_utilisation_colour(h->utilisation));
    if (isfinite(h->utilisation_low) && isfinite(h->utilisation_high)) {
        double low = fmin(h->utilisation_low, most) * px;
        double high = fmin(h->utilisation_high, most) * px;
        fw_svg_put(out, "path d='M{c} 8H{c}M{c} 5v6M{c} 5v6' stroke='#1f2328' stroke-width='1.2'",
                   low, high, low, high);
    }
    fw_svg_put(
        out, "path d='M{c} 0v16' stroke='#1f2328' stroke-width='1.5' stroke-dasharray='2 1.5'", px);
    fw_svg_close(out, "svg");
}

static void row(fw_text *out, const fw_hinge_verdict *h, bool with_flow, double most) {
    fw_markup(out, "<tr{r}><th scope=\"row\">{s}</th>",
              h->decision == FW_ACCEPT ? "" : " class=\"bad\"", h->id);
    if (with_flow) fw_markup(out, "<td>{s}</td>", h->flow ? h->flow : "\u2013");
    fw_markup(out, "<td class=\"n\">{D} \u00b1 ", h->peak_angle_rad);
    fw_markup_number(out, h->angle_error_rad * FW_DEG_PER_RAD, 2);
    fw_markup(out,
              "</td><td class=\"n\">{D}</td><td class=\"n\">{p}</td>"
              "<td class=\"n\">{p}</td><td>",
              h->limit_angle_rad, h->peak_strain, h->strain_limit);
    bar(out, h, most);
    fw_markup(out, "</td><td class=\"n\">{p}</td><td class=\"n\">", h->utilisation);
    if (isfinite(h->utilisation_low) && isfinite(h->utilisation_high))
        fw_markup(out, "{p} to {p}", h->utilisation_low, h->utilisation_high);
    else
        fw_text_add(out, "\u2013");
    fw_markup(out, "</td><td>{s}</td><td>{s}</td><td class=\"n\">",
              h->limit ? h->limit->criterion : "\u2013", h->scene ? h->scene : "\u2013");
    if (isfinite(h->t_s))
        fw_markup(out, "{u}", h->t_s, "s");
    else
        fw_text_add(out, "\u2013");
    fw_text_add(out, "</td></tr>\n");
}

void fw_report_hinge_table(fw_text *out, const fw_hinge_verdict *hinge, int nhinge, bool with_flow,
                           const char *caption) {
    double most = bar_scale(hinge, nhinge);
    fw_markup(out,
              "<div class=\"wide\"><table><caption>{s}</caption><thead><tr><th "
              "scope=\"col\">Hinge</th>{r}<th scope=\"col\" class=\"n\">Peak angle (\u00b0)</th>"
              "<th scope=\"col\" class=\"n\">Limit (\u00b0)</th><th scope=\"col\" class=\"n\">Peak "
              "strain</th><th scope=\"col\" class=\"n\">Strain limit</th><th scope=\"col\" "
              "colspan=\"2\">Utilisation</th><th scope=\"col\" class=\"n\">Error band</th><th "
              "scope=\"col\">Criterion</th><th scope=\"col\">Scene</th><th scope=\"col\" "
              "class=\"n\">Instant</th></tr></thead>"
              "<tbody>\n",
              caption, with_flow ? "<th scope=\"col\">Flow</th>" : "");
    for (int i = 0; i < nhinge; i++)
        row(out, &hinge[i], with_flow, most);
    fw_text_add(out, "</tbody></table></div>\n");
}

fw_status fw_report_section_hinges(fw_page *page) {
    const fw_verdict *v = page->in->verdict;
    if (v->nhinge == 0) {
        fw_text_add(page->out, "<p>This device has no flexure hinges.</p>\n");
        return fw_text_end(page->out);
    }
    fw_report_hinge_table(
        page->out, v->hinge, v->nhinge, true,
        "The worst case of every hinge over all flows, scenes and required poses. "
        "The dashed line in the bar is the limit, safety factor included; the "
        "whisker is the error band.");
    return fw_report_ladder(page);
}
