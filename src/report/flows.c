/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

static const char *name_of(const fw_report_flow *f) {
    if (f->flow && f->flow->id) return f->flow->id;
    if (f->variant && f->variant->variant && f->variant->variant->flow)
        return f->variant->variant->flow;
    return "flow";
}

static void manufacturable(fw_text *out, const fw_flow *flow) {
    fw_markup(out, "<p>{s}{r}", flow->title, flow->title ? ". " : "");
    fw_text_add(out, flow->manufacturable > 0
                         ? "<strong>Manufacturable</strong> with the numbers known."
                     : flow->manufacturable == 0
                         ? "<strong class=\"no\">Not manufacturable</strong> in this flow."
                         : "<strong>Not guaranteed</strong> until something is measured.");
    fw_text_add(out, "</p>\n");
    if (flow->nreason == 0) return;
    fw_text_add(out, "<ul class=\"plain\">\n");
    for (int i = 0; i < flow->nreason; i++)
        fw_markup(out, "<li>{s}</li>\n", flow->reason[i]);
    fw_text_add(out, "</ul>\n");
}

fw_status fw_report_section_flows(fw_page *page) {
    fw_text *out = page->out;
    if (page->in->nflow == 0) fw_text_add(out, "<p>The description names no flow.</p>\n");
    for (int i = 0; i < page->in->nflow; i++) {
        const fw_report_flow *f = &page->in->flow[i];
        fw_markup(out, "<h3>{s} ", name_of(f));
        if (f->variant)
            fw_markup(out, "<span class=\"tag\" style=\"background:{r}\">{r}</span>",
                      fw_report_decision_colour(f->variant->decision),
                      fw_report_decision_word(f->variant->decision));
        fw_text_add(out, "</h3>\n");
        if (f->flow) manufacturable(out, f->flow);
        if (f->variant && f->variant->nhinge)
            fw_report_hinge_table(out, f->variant->hinge, f->variant->nhinge, false,
                                  "Hinges in this flow");
    }
    return fw_text_end(out);
}
