/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was simulated and what was left out, and how well. Measured run time is not printed: the
   same input gives the same bytes. */
#include "report/page.h"
#include <math.h>

static void effect_rows(fw_text *out, const char *flow, const char *scene,
                        const fw_effect_ledger *ledger) {
    for (int i = 0; i < ledger->count; i++) {
        const fw_effect_entry *e = &ledger->item[i];
        fw_report_markup(out,
                         "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}</td><td>{r}</td>"
                         "<td class=\"n\">",
                         e->id, scene, flow, e->active ? "<strong>active</strong>" : "left out");
        if (isinf(e->bound))
            fw_text_add(out, "none");
        else
            fw_report_markup(out, "{p}", e->bound);
        fw_text_add(out, "</td><td class=\"n\">");
        if (e->cost > 0)
            fw_report_markup(out, "{n}", e->cost);
        else
            fw_text_add(out, "\u2013");
        fw_report_markup(out, "</td><td>{s}</td></tr>\n", e->reason);
    }
}

typedef void (*motion_rows)(fw_text *out, const char *flow, const char *scene,
                            const fw_motion *motion);

static void each_motion(fw_page *page, motion_rows rows) {
    const fw_verdict *verdict = page->in->verdict;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_variant_verdict *v = &verdict->variant[i];
        const char *flow = v->variant && v->variant->flow ? v->variant->flow : "\u2013";
        for (int k = 0; v->motion && k < page->in->device->nscene; k++)
            if (v->motion[k]) rows(page->out, flow, page->in->device->scene[k].name, v->motion[k]);
    }
}

static void effects_of(fw_text *out, const char *flow, const char *scene, const fw_motion *motion) {
    effect_rows(out, flow, scene, &motion->ledger);
}

static void sum_of(fw_text *out, const char *flow, const char *scene, const fw_motion *motion) {
    if (!(motion->ledger.left_out > 0)) return;
    fw_report_markup(out, "<li>{s}, {s}: {e}</li>\n", scene, flow, motion->ledger.left_out);
}

fw_status fw_report_section_effects(fw_page *page) {
    fw_text_add(
        page->out,
        "<p>An effect is simulated when the scene calls for it; those with the smallest bounds are "
        "left out as long as the sum of their bounds stays below the accuracy wanted.</p>\n<div "
        "class=\"wide\"><table><caption>Ledger of effects. Bound: the most that leaving it out "
        "changes the peak hinge deflection; none: it is the motion itself, or nothing bounds it. "
        "Cost: instructions per evaluation of the forces.</caption><thead><tr><th "
        "scope=\"col\">Effect</th><th scope=\"col\">Scene</th><th scope=\"col\">Flow</th>"
        "<th scope=\"col\">State</th><th scope=\"col\" class=\"n\">Bound</th>"
        "<th scope=\"col\" class=\"n\">Cost</th><th scope=\"col\">Reason</th></tr></thead>"
        "<tbody>\n");
    each_motion(page, effects_of);
    fw_report_markup(page->out,
                     "</tbody></table></div>\n<p>What was left out in sum, where the accuracy "
                     "wanted is {e}; it is part of the angles' errors:</p>\n<ul class=\"plain\">\n",
                     page->in->verdict->accuracy_wanted);
    each_motion(page, sum_of);
    fw_text_add(page->out,
                "<li class=\"soft\">Scenes that are not listed leave out nothing that has a "
                "bound above 0.</li>\n</ul>\n");
    return fw_text_end(page->out);
}

static void stats_of(fw_text *out, const char *flow, const char *scene, const fw_motion *motion) {
    const fw_motion_stats *s = &motion->stats;
    fw_report_markup(
        out,
        "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}</td><td>{s}</td><td "
        "class=\"n\">{e}</td><td class=\"n\">{l} ({l})</td><td class=\"n\">{l}</td><td "
        "class=\"n\">{l}</td><td class=\"n\">{e}</td><td class=\"n\">{e}</td><td "
        "class=\"n\">{e}</td></tr>\n",
        scene, flow, motion->method, motion->integrator, s->rtol, s->steps, s->rejected, s->rhs,
        s->projections, s->max_constraint_norm, s->max_velocity_norm, s->energy_error);
}

static void reason_of(fw_text *out, const char *flow, const char *scene, const fw_motion *motion) {
    if (motion->reason && motion->reason[0])
        fw_report_markup(out, "<li>{s}, {s}: {s}</li>\n", scene, flow, motion->reason);
}

fw_status fw_report_section_accuracy(fw_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_text *out = page->out;
    fw_report_markup(
        out,
        "<p>Relative error wanted on the peak hinge deflection: <strong>{e}</strong>; "
        "estimated: <strong>{e}</strong>. This is the error of the computation and the sum of the "
        "bounds of effects that were left out; what the "
        "model itself leaves open is in the error bands and under <a "
        "href=\"#assumptions\">assumptions</a>.</p>\n",
        v->accuracy_wanted, v->accuracy_estimated);
    fw_text_add(out,
                "<div class=\"wide\"><table><caption>What it took. Constraint norms are relative "
                "to the size of the scene, the largest over all steps.</caption><thead><tr><th "
                "scope=\"col\">Scene</th><th scope=\"col\">Flow</th><th scope=\"col\">Method</th>"
                "<th scope=\"col\">Integrator</th><th scope=\"col\" class=\"n\">Tolerance</th><th "
                "scope=\"col\" class=\"n\">Steps (rejected)</th><th scope=\"col\" class=\"n\">"
                "Evaluations</th><th scope=\"col\" class=\"n\">Projections</th><th scope=\"col\" "
                "class=\"n\">Constraints</th><th scope=\"col\" class=\"n\">Their rates</th><th "
                "scope=\"col\" class=\"n\">Energy error</th></tr></thead><tbody>\n");
    each_motion(page, stats_of);
    fw_text_add(out, "</tbody></table></div>\n<ul class=\"plain\">\n");
    each_motion(page, reason_of);
    fw_text_add(out, "<li class=\"soft\">The pictures show decimated curves; the verdict does not "
                     "depend on them.</li>\n</ul>\n");
    return fw_text_end(out);
}
