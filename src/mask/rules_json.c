/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rules that a mask is judged by, in its certificate: for programs that check the same polygons themselves, as the
   scripts of klayout/ do. Limits are numbers here, whatever expression the table has. */
#include "mask/mask_writers.h"
#include "mask/rule.h"
#include <stdio.h>

static const char *of_text(unsigned of) {
    static const struct {
        unsigned of;
        const char *word;
    } words[] = {{FW_OF_OUTLINE, "outline"},
                 {FW_OF_POLYGON, "polygon"},
                 {FW_OF_ISLAND, "island"},
                 {FW_OF_HOLE, "hole"}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (of == words[i].of) return words[i].word;
    return NULL; /* both, or the kind knows no difference */
}

static void gds_of(fw_json *json, const char *key, const fw_mask_table *table, int layer) {
    char text[32];
    if (layer < 0) {
        fw_json_null(json, key);
        return;
    }
    snprintf(text, sizeof text, "%d/%d", table->layer[layer].layer, table->layer[layer].datatype);
    fw_json_text(json, key, text);
}

static void bound(fw_json *json, const char *key, const fw_mask_rule *rule, double value) {
    if (value > 0 && value < HUGE_VAL)
        fw_json_number(json, key, fw_mask_rule_row_shown(rule->kind, value), 12);
    else
        fw_json_null(json, key);
}

static void length_um(fw_json *json, const char *key, double length_m) {
    if (length_m > 0)
        fw_json_number(json, key, length_m * 1e6, 12);
    else
        fw_json_null(json, key);
}

fw_status fw_mask_rules_json(fw_json *json, const fw_mask_table *table) {
    static const char *const unit[] = {"um", "deg", "um2", "1"};
    fw_mask_rules rules = {.arena = json->out->arena, .table = table};
    FW_TRY(fw_mask_rules_list(&rules));
    fw_json_line(json, 2);
    fw_json_list(json, "rules");
    for (int i = 0; i < rules.nrule; i++) {
        const fw_mask_rule *rule = &rules.rule[i];
        if (table->layer[rule->layer].documentation) continue;
        fw_json_line(json, 4);
        fw_json_object(json, NULL);
        fw_json_text(json, "kind", rule->kind->name);
        gds_of(json, "layer", table, rule->layer);
        gds_of(json, "other", table, rule->other);
        fw_json_text(json, "of", of_text(rule->of));
        bound(json, "min", rule, rule->least);
        bound(json, "max", rule, rule->most);
        fw_json_text(json, "unit", unit[rule->kind->unit]);
        length_um(json, "window_um", rule->window_m);
        length_um(json, "step_um", rule->step_m);
        fw_json_text(json, "severity", rule->severity == FW_ERROR ? "error" : "warning");
        fw_json_whole(json, "code", rule->kind->number);
        fw_json_text(json, "formula", rule->formula);
        fw_json_text(json, "source", rule->source);
        fw_json_end(json);
    }
    fw_json_end_line(json, 2);
    return FW_OK;
}
