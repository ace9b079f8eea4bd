/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places where a mask breaks design rules. */
#include "report/page.h"

enum { MOST_ROWS = 60 };

static void row(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    const fw_mask_rule *rule = f->rule;
    const fw_mask_layer *layer = &mask->table->layer[rule->layer];
    const char *unit = fw_mask_rule_unit(rule);
    bool too_much = f->value > f->needed;
    fw_markup(out,
              "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{i}/{i} {s}</td><td "
              "class=\"n\">{n} {r}</td><td class=\"n\">{r} {n} {r}</td><td "
              "class=\"n\">{n}, {n}</td><td>{s}{r}{s}</td><td>{s}</td></tr>\n",
              fw_mask_rule_name(rule), rule->severity == FW_ERROR ? "error" : "warning",
              layer->layer, layer->datatype, layer->name, fw_mask_rule_shown(rule, f->value), unit,
              too_much ? "\u2264" : "\u2265", fw_mask_rule_shown(rule, f->needed), unit,
              0.5e6 * (f->at[0].x + f->at[1].x), 0.5e6 * (f->at[0].y + f->at[1].y),
              f->label[0] ? f->label[0] : "", f->label[1] ? ", " : "",
              f->label[1] ? f->label[1] : "", rule->source);
}

/* errors first */
void fw_report_findings(fw_text *out, const fw_mask *mask) {
    int rows = 0;
    fw_text_add(out, "<div class=\"wide\"><table><caption>Where design rules are broken</caption>"
                     "<thead><tr><th scope=\"col\">Rule</th><th scope=\"col\">Severity</th><th "
                     "scope=\"col\">Layer</th><th scope=\"col\" class=\"n\">Found</th><th "
                     "scope=\"col\" class=\"n\">Needed</th><th scope=\"col\" class=\"n\">At x, y "
                     "(um)</th><th scope=\"col\">Pieces</th><th scope=\"col\">Reason</th></tr>"
                     "</thead><tbody>\n");
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < mask->nfinding; i++) {
            bool error = mask->finding[i].rule->severity == FW_ERROR;
            if (error == (pass == 0) && rows++ < MOST_ROWS) row(out, mask, &mask->finding[i]);
        }
    fw_text_add(out, "</tbody></table></div>\n");
    if (rows > MOST_ROWS) fw_markup(out, "<p>and {i} more.</p>\n", rows - MOST_ROWS);
    fw_markup(out,
              "<p class=\"soft small\">With chords and boxes in "
              "masks/{s}.violations.json, as markers in masks/{s}.violations.gds, and in "
              "masks/{s}.violations.lyrdb for KLayout.</p>\n",
              mask->flow, mask->flow, mask->flow);
}
