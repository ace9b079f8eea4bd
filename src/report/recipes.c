/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include <math.h>

static void time_cells(fw_text *out, const fw_step *step) {
    const fw_time *t = &step->time;
    if (t->computable) {
        fw_markup(out, "<td class=\"n\">{h}", t->nominal_s);
        if (t->relative_uncertainty > 0.0 && isfinite(t->relative_uncertainty))
            fw_markup(out, " \u00b1\u00a0{e}\u00a0%", 100.0 * t->relative_uncertainty);
        fw_markup(out,
                  "</td><td class=\"n\">{h}</td><td class=\"n\">{h}</td><td "
                  "class=\"n\">{h}</td><td>{s}",
                  t->first_look_s, t->clear_by_s, t->stop_s, fw_value_status_text(t->status));
        for (int i = 0; i < t->ncontribution && i < 3; i++)
            fw_markup(out, "{r}{s}", i ? ", " : "; ", t->contribution[i]);
        fw_text_add(out, "</td>");
    } else if (t->nmissing || (step->law && step->law[0])) {
        fw_text_add(out, "<td colspan=\"5\"><strong class=\"no\">NOT COMPUTABLE</strong>");
        for (int i = 0; i < t->nmissing; i++)
            fw_markup(out, "{r}{s}", i ? ", " : ": needs ", t->missing[i]);
        fw_text_add(out, "</td>");
    } else
        fw_text_add(out, "<td class=\"n\">\u2013</td><td></td><td></td><td></td><td></td>");
}

static void steps(fw_text *out, const fw_flow *flow) {
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>Steps in order. A step that the source does "
                "not state is marked; a time is only given where every number it needs is known."
                "</caption><thead><tr><th scope=\"col\" class=\"n\">No.</th><th scope=\"col\">"
                "Step</th><th scope=\"col\" class=\"n\">Time</th><th scope=\"col\" "
                "class=\"n\">First look</th><th scope=\"col\" class=\"n\">Clear by</th>"
                "<th scope=\"col\" class=\"n\">Stop</th>"
                "<th scope=\"col\">Worst input</th></tr></thead><tbody>\n");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_step *s = &flow->step[i];
        fw_markup(out, "<tr><td class=\"n\">{i}</td><th scope=\"row\" class=\"step\">{s}{r}</th>",
                  i + 1, s->title ? s->title : s->id,
                  s->in_source ? "" : " <span class=\"soft\">(not in the source)</span>");
        time_cells(out, s);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table></div>\n");
}

fw_status fw_report_section_recipes(fw_page *page) {
    fw_text *out = page->out;
    for (int i = 0; i < page->in->nflow; i++) {
        const fw_flow *flow = page->in->flow[i].flow;
        if (!flow) continue;
        fw_markup(out, "<h3>{s}</h3>\n<p>{i} steps, {h} over those that can be computed; ",
                  flow->id, flow->nstep, flow->total_s);
        if (flow->not_computable)
            fw_markup(out, "<strong class=\"no\">{i} not computable</strong>.</p>\n",
                      flow->not_computable);
        else
            fw_text_add(out, "none is missing.</p>\n");
        steps(out, flow);
    }
    if (page->in->nflow == 0) fw_text_add(out, "<p>The description names no flow.</p>\n");
    return fw_text_end(out);
}
