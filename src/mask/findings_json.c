/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Findings as JSON: an array of the certificate, and a document of its own where there is no mask.
 */
#include "mask/findings.h"
#include "mask/json.h"
#include "mask/rule.h"

static void gds_of(fw_text *out, const char *key, const fw_mask *mask, int layer) {
    fw_text_printf(out, "\"%s\": ", key);
    if (layer < 0)
        fw_text_add(out, "null");
    else
        fw_text_printf(out, "\"%d/%d\"", mask->table->layer[layer].layer,
                       mask->table->layer[layer].datatype);
}

static void numbers(fw_text *out, const double *x, int n) {
    fw_text_add(out, "[");
    for (int i = 0; i < n; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_text_number(out, x[i] * 1e6, 12);
    }
    fw_text_add(out, "]");
}

static void place(fw_text *out, const fw_mask_finding *f) {
    const double from[] = {f->at[0].x, f->at[0].y}, to[] = {f->at[1].x, f->at[1].y};
    const double box[] = {f->box.x0, f->box.y0, f->box.x1, f->box.y1};
    fw_text_add(out, "\"at_um\": [");
    numbers(out, from, 2);
    fw_text_add(out, ", ");
    numbers(out, to, 2);
    fw_text_add(out, "], \"box_um\": ");
    numbers(out, box, 4);
}

static void pieces(fw_text *out, const fw_mask_finding *f) {
    fw_text_add(out, "\"pieces\": [");
    for (int i = 0; i < 2 && f->label[i]; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_mask_json_string(out, f->label[i]);
    }
    fw_text_add(out, "], \"edges\": [");
    for (int i = 0; i < 2 && f->label[i] && f->edge[i] >= 0; i++)
        fw_text_printf(out, "%s%d", i ? ", " : "", f->edge[i]);
    fw_text_add(out, "]");
}

static void finding(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    static const char *const unit[] = {"um", "deg", "um2", "1"};
    const fw_rule_row *kind = f->rule->kind;
    fw_text_add(out, "{");
    fw_mask_json_text(out, "rule", kind->name);
    fw_text_add(out, ", ");
    gds_of(out, "layer", mask, f->rule->layer);
    fw_text_add(out, ", ");
    gds_of(out, "other", mask, f->rule->other);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "severity", f->rule->severity == FW_ERROR ? "error" : "warning");
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "what", f->what);
    fw_text_add(out, ",\n     ");
    fw_mask_json_number(out, "value", fw_rule_shown(kind, f->value), 12);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "limit", fw_rule_shown(kind, f->limit), 12);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "needed", fw_rule_shown(kind, f->needed), 12);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "unit", unit[kind->unit]);
    fw_text_add(out, ", ");
    place(out, f);
    fw_text_add(out, ",\n     ");
    pieces(out, f);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "formula", f->rule->formula);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "reason", f->rule->source);
    fw_text_add(out, "}");
}

void fw_mask_json_findings(fw_text *out, const fw_mask *mask) {
    fw_text_add(out, "[");
    for (int i = 0; i < mask->nfinding; i++) {
        fw_text_add(out, i ? ",\n    " : "\n    ");
        finding(out, mask, &mask->finding[i]);
    }
    fw_text_add(out, mask->nfinding ? "\n  ]" : "]");
}

fw_status fw_mask_write_findings(const fw_mask *mask, fw_text *out) {
    fw_text_add(out, "{\n  \"schema\": \"flexwright.violations/1\",\n  ");
    fw_mask_json_text(out, "device", mask->device);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "flow", mask->flow);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "cell", mask->cell);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "version", FW_VERSION);
    fw_text_printf(out,
                   ",\n  \"errors\": %d, \"warnings\": %d,\n  \"marker_layer\": %d,\n  "
                   "\"findings\": ",
                   mask->nbroken, mask->nfinding - mask->nbroken,
                   fw_mask_marker_layer(mask->table));
    fw_mask_json_findings(out, mask);
    fw_text_add(out, "\n}\n");
    return fw_text_end(out);
}
