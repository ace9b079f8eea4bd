/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which measurement pays: the section of the report and the line on the terminal. */
#include "report/report_page.h"
#include <math.h>

/* ---- page ---- */

bool fw_report_has_measurements(const fw_report_page *page) {
    for (int i = 0; i < page->in->nflow; i++)
        if (page->in->flow[i].measuring) return true;
    return false;
}

static fw_status value_text(fw_arena *arena, const fw_measuring_item *x, bool after,
                            const char **out) {
    fw_text text = fw_text_new(arena);
    fw_measuring_put_value(&text, x, after);
    FW_TRY(fw_text_end(&text));
    *out = text.data;
    return FW_OK;
}

/* "S18: 80.8..99.2 to 84.1..95.9 min" of the step whose window loses most, and how many more there are */
static fw_status window_text(fw_arena *arena, const fw_measuring_item *x, const char **out) {
    fw_text text = fw_text_new(arena);
    fw_measuring_put_windows(&text, x);
    FW_TRY(fw_text_end(&text));
    *out = text.length ? text.data : "";
    return FW_OK;
}

static fw_status row(fw_report_page *page, const fw_measuring *m, int i) {
    const fw_measuring_item *x = &m->item[i];
    const char *before, *after, *windows;
    fw_text worth = fw_text_new(page->arena);
    FW_TRY(value_text(page->arena, x, false, &before));
    FW_TRY(value_text(page->arena, x, true, &after));
    FW_TRY(window_text(page->arena, x, &windows));
    fw_measuring_put_worth(&worth, m, x);
    FW_TRY(fw_text_end(&worth));
    fw_markup(page->out,
              "<tr><td class=\"n\">{i}</td><th scope=\"row\">{s}{s}{s}{s}</th><td>{s}{s}</td>"
              "<td>{s}</td><td>{s}</td><td class=\"n\">{s}</td><td>{s}</td></tr>\n",
              i + 1, x->name, x->id ? " (" : "", x->id, x->id ? ")" : "", before,
              x->unknown && !isnan(x->value) ? " (assumed)" : "", x->by ? x->by : "nothing here",
              isnan(x->value) ? "" : after, worth.length ? worth.data : "", windows);
    return FW_OK;
}

static fw_status one_flow(fw_report_page *page, const fw_report_flow *f) {
    const fw_measuring *m = f->measuring;
    fw_text band = fw_text_new(page->arena);
    fw_markup(page->out, "<h3>{s}</h3>\n", f->flow ? f->flow->id : "");
    if (m->first) fw_markup(page->out, "<p><strong>{s}</strong></p>\n", m->first);
    if (m->what && m->banded) {
        fw_measuring_put_band(&band, &m->band);
        FW_TRY(fw_text_end(&band));
        fw_markup(page->out,
                  "<p>As it is known now, {s} uses {s} of its limit over all that the flow may "
                  "make ({s}). {i} more devices were run for this.</p>\n",
                  m->what, band.data, fw_verdict_decision_text(m->decision), m->judged);
    }
    if (m->nitem > 0) {
        fw_markup(
            page->out,
            "<div class=\"wide\"><table><caption>Each input measured alone, its value kept: {r}, "
            "and of the steps' time windows (first look to clear by)</caption><thead><tr><th "
            "scope=\"col\" class=\"n\">Rank</th><th scope=\"col\">Input</th><th scope=\"col\">"
            "Now</th><th scope=\"col\">Read by</th><th scope=\"col\">Then</th><th scope=\"col\" "
            "class=\"n\">{r}</th><th scope=\"col\">Windows</th></tr></thead><tbody>\n",
            m->banded ? "what would be left of the band"
                      : "what it brings to the standard uncertainty, now and then (bands: "
                        "--measurements all)",
            m->banded ? "Band" : "Uncertainty");
        for (int i = 0; i < m->nitem; i++)
            FW_TRY(row(page, m, i));
        fw_text_add(page->out, "</tbody></table></div>\n"
                               "<p>Where nothing here reads an input, it is taken to be known "
                               "exactly: a bound on what any measurement of it can do.</p>\n");
    }
    if (m->nothing[0])
        fw_markup(page->out, "<p>Measuring these changes nothing: {s}.</p>\n", m->nothing);
    return fw_text_end(page->out);
}

fw_status fw_report_section_measurements(fw_report_page *page) {
    for (int i = 0; i < page->in->nflow; i++)
        if (page->in->flow[i].measuring) FW_TRY(one_flow(page, &page->in->flow[i]));
    return fw_text_end(page->out);
}

/* ---- terminal ---- */

/* where it is undecided what a flow makes; the whole list stands in the report */
void fw_report_measurements_text(fw_text *out, const fw_report_input *in) {
    for (int i = 0; i < in->nflow; i++) {
        const fw_measuring *m = in->flow[i].measuring;
        if (!m || !m->asked || !m->first || m->decision != FW_INCONCLUSIVE) continue;
        fw_text_printf(out, "\n%s: %s\n", in->flow[i].flow ? in->flow[i].flow->id : "", m->first);
    }
}
