/* SPDX-License-Identifier: GPL-3.0-or-later */
/* KLayout's report database, for its marker browser: a category for each rule that is broken, and
   in it an item for each place, with the shortest chord as an edge, the whole place as a box (um),
   and what it is. Texts are in apostrophes with \ before ' and \. Format: as KLayout 0.28 writes it
   (class ReportDatabase of its reference); accepted by ReportDatabase#load, which
   tests/cli/test_violations.py does. */
#include "mask/findings.h"
#include "mask/rule.h"
#include <string.h>

static void xml(fw_text *out, const char *s) {
    for (; *s; s++) {
        const char *instead = *s == '&' ? "&amp;" : *s == '<' ? "&lt;" : *s == '>' ? "&gt;" : NULL;
        if (instead)
            fw_text_add(out, instead);
        else
            fw_text_bytes(out, s, 1);
    }
}

static void text_value(fw_text *out, const char *name, const char *s) {
    fw_text_add(out, "    <value>text: '");
    xml(out, name);
    for (const char *at = s; *at; at++) {
        if (*at == '\'' || *at == '\\') fw_text_add(out, "\\");
        char one[2] = {*at, '\0'};
        xml(out, one);
    }
    fw_text_add(out, "'</value>\n");
}

static void numbers(fw_text *out, fw_geometry_vec2 p, fw_geometry_vec2 q) {
    fw_text_add(out, "(");
    fw_text_number(out, p.x * 1e6, 12);
    fw_text_add(out, ",");
    fw_text_number(out, p.y * 1e6, 12);
    fw_text_add(out, ";");
    fw_text_number(out, q.x * 1e6, 12);
    fw_text_add(out, ",");
    fw_text_number(out, q.y * 1e6, 12);
    fw_text_add(out, ")");
}

/* of a rule: "width 1/0", "enclosure 2/0 1/0 warning"; no two rules have the same */
static void category_name(fw_text *out, const fw_mask *mask, const fw_mask_rule *rule) {
    const fw_mask_layer *l = &mask->table->layer[rule->layer];
    fw_text_printf(out, "%s %d/%d", rule->kind->name, l->layer, l->datatype);
    if (rule->other >= 0) {
        l = &mask->table->layer[rule->other];
        fw_text_printf(out, " %d/%d", l->layer, l->datatype);
    }
    if (rule->of == FW_OF_POLYGON) fw_text_add(out, " polygon");
    if (rule->of == FW_OF_ISLAND) fw_text_add(out, " island");
    if (rule->of == FW_OF_HOLE) fw_text_add(out, " hole");
    if (rule->kind->unit == FW_UNIT_SHARE) {
        fw_text_add(out, " in ");
        fw_text_number(out, rule->window_m * 1e6, 6);
        fw_text_add(out, " um");
    }
    if (rule->severity != FW_ERROR) fw_text_add(out, " warning");
}

static void category(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    fw_text_add(out, "  <category>\n   <name>");
    category_name(out, mask, f->rule);
    fw_text_add(out, "</name>\n   <description>layer ");
    xml(out, mask->table->layer[f->rule->layer].name);
    fw_text_add(out, ": ");
    xml(out, f->rule->kind->name);
    fw_text_add(out, ", limit ");
    fw_text_number(out, fw_mask_rule_row_shown(f->rule->kind, f->limit), 6);
    fw_text_printf(out, " %s; ", fw_mask_rule_unit_name(f->rule->kind));
    xml(out, f->rule->source);
    fw_text_add(out, "</description>\n   <categories>\n   </categories>\n  </category>\n");
}

static void item(fw_text *out, const fw_mask *mask, const fw_mask_finding *f) {
    fw_text_add(out, "  <item>\n   <tags/>\n   <category>'");
    category_name(out, mask, f->rule);
    fw_text_printf(out,
                   "'</category>\n   <cell>%s</cell>\n   <visited>false</visited>\n"
                   "   <multiplicity>1</multiplicity>\n   <image/>\n   <values>\n",
                   mask->cell);
    fw_geometry_box b = fw_mask_marker(f);
    fw_geometry_vec2 low = {b.x0, b.y0}, high = {b.x1, b.y1};
    bool chord = !vec_same(f->at[0], f->at[1]) && f->rule->kind->unit == FW_UNIT_LENGTH;
    fw_text_add(out, chord ? "    <value>edge: " : "    <value>box: ");
    numbers(out, chord ? f->at[0] : low, chord ? f->at[1] : high);
    fw_text_add(out, "</value>\n");
    if (chord) {
        fw_text_add(out, "    <value>box: ");
        numbers(out, (fw_geometry_vec2){f->box.x0, f->box.y0},
                (fw_geometry_vec2){f->box.x1, f->box.y1});
        fw_text_add(out, "</value>\n");
    }
    char value[32];
    fw_number_text(value, sizeof value, fw_mask_rule_row_shown(f->rule->kind, f->value), 9);
    text_value(out, f->what, "");
    fw_text_printf(out, "    <value>float: %s</value>\n", value);
    for (int i = 0; i < 2 && f->label[i]; i++)
        text_value(out, "piece: ", f->label[i]);
    fw_text_add(out, "   </values>\n  </item>\n");
}

fw_status fw_mask_write_lyrdb(const fw_mask *mask, fw_text *out) {
    fw_text_add(out, "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<report-database>\n "
                     "<description>Design rules of flow ");
    xml(out, mask->flow);
    fw_text_add(out, ", device ");
    xml(out, mask->device);
    fw_text_printf(out,
                   "</description>\n <original-file>%s.violations.gds</original-file>\n "
                   "<generator>flexwright " FW_VERSION "</generator>\n "
                   "<top-cell>%s</top-cell>\n <tags>\n </tags>\n <categories>\n",
                   mask->flow, mask->cell);
    for (int i = 0; i < mask->nfinding; i++) /* those of one rule follow each other */
        if (i == 0 || mask->finding[i].rule != mask->finding[i - 1].rule)
            category(out, mask, &mask->finding[i]);
    fw_text_printf(out,
                   " </categories>\n <cells>\n  <cell>\n   <name>%s</name>\n   <variant/>\n"
                   "   <references>\n   </references>\n  </cell>\n </cells>\n <items>\n",
                   mask->cell);
    for (int i = 0; i < mask->nfinding; i++)
        item(out, mask, &mask->finding[i]);
    fw_text_add(out, " </items>\n</report-database>\n");
    return fw_text_end(out);
}
