/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Findings as messages: the worst few of each rule, with their number. */
#include "mask/rule.h"
#include "mask/mask_rules.h"
#include <stdlib.h>

enum { MOST_TOLD = 4 }; /* of one rule */

/* < 1: the smaller the worse */
static double badness(const fw_mask_finding *f) {
    if (f->value > f->needed) return f->needed / f->value; /* a density that is too high */
    return f->needed > 0 ? f->value / f->needed : 0;
}

static int by_badness(const void *left, const void *right) {
    const fw_mask_finding *p = *(const fw_mask_finding *const *)left,
                          *q = *(const fw_mask_finding *const *)right;
    double a = badness(p), b = badness(q);
    return a != b ? (a < b ? -1 : 1) : (p > q) - (p < q);
}

static const char *piece(fw_arena *arena, const char *label, int edge) {
    return edge < 0 ? label : fw_arena_printf(arena, "%s (edge %d)", label, edge);
}

static const char *pieces(fw_arena *arena, const fw_mask_finding *f) {
    if (!f->label[0]) return "the layer";
    const char *p = piece(arena, f->label[0], f->edge[0]);
    if (!f->label[1]) return p;
    const char *q = piece(arena, f->label[1], f->edge[1]);
    return p && q ? fw_arena_printf(arena, "%s and %s", p, q) : NULL;
}

static const char *sentence(fw_arena *arena, const fw_mask_layer *layer, const fw_mask_finding *f) {
    const fw_mask_rule *rule = f->rule;
    const fw_mask_rule_kind_row *kind = rule->kind;
    const char *who = pieces(arena, f), *unit = fw_mask_rule_unit_name(kind);
    char at[80], value[32], needed[32], limit[32];
    fw_mask_place_text(at, sizeof at, vec_scale(0.5, vec_add(f->at[0], f->at[1])));
    fw_number_text(value, sizeof value, fw_mask_rule_row_shown(kind, f->value), 6);
    fw_number_text(needed, sizeof needed, fw_mask_rule_row_shown(kind, f->needed), 6);
    fw_number_text(limit, sizeof limit, fw_mask_rule_row_shown(kind, f->limit), 6);
    if (!who) return NULL;
    if (kind->built_in)
        return fw_arena_printf(arena, "%s meet at %s on layer %s without a shared joint; %s", who,
                               at, layer->name, kind->advice);
    return fw_arena_printf(
        arena, "%s: %s of %s %s at %s; layer %s %s %s %s (rule %s %s%s%s%s; %s); %s", who, f->what,
        value, unit, at, layer->name, f->value > f->needed ? "takes at most" : "needs", needed,
        unit, limit, unit, f->needed != f->limit ? " and what the 1 nm grid takes" : "",
        rule->formula ? ", " : "", rule->formula ? rule->formula : "", rule->source, kind->advice);
}

static fw_status tell(fw_mask_rules *r, const fw_mask_finding *f, fw_diags *diags) {
    const char *text = sentence(r->arena, &r->table->layer[f->rule->layer], f);
    FW_NEED(text);
    fw_place place = {0};
    if (f->rule->severity == FW_ERROR)
        fw_diag_error(diags, f->rule->kind->number, place, "%s", text);
    else
        fw_diag_warning(diags, f->rule->kind->number, place, "%s", text);
    return FW_OK;
}

static void tell_rest(const fw_mask_rules *r, const fw_mask_rule *rule, int more, fw_diags *diags) {
    fw_place place = {0};
    const char *layer = r->table->layer[rule->layer].name, *flow = r->table->flow;
    fw_diag_note(diags, 159, place,
                 "%d more place(s) on layer %s break the rule \"%s\"; all of them are in "
                 "%s.violations.lyrdb, .gds and .json, or in the mask's certificate where the rule "
                 "is a warning",
                 more, layer, rule->kind->name, flow);
}

fw_status fw_mask_rules_tell(fw_mask_rules *r, fw_diags *diags, int *nbroken) {
    *nbroken = 0;
    const fw_mask_finding **list =
        fw_arena_alloc(r->arena, (size_t)r->nfinding, sizeof(const fw_mask_finding *));
    FW_NEED(list);
    for (int i = 0; i < r->nrule; i++) {
        const fw_mask_rule *rule = &r->rule[i];
        int n = 0;
        for (int k = 0; k < r->nfinding; k++)
            if (r->finding[k].rule == rule) list[n++] = &r->finding[k];
        if (n) qsort(list, (size_t)n, sizeof *list, by_badness);
        if (rule->severity == FW_ERROR) *nbroken += n;
        for (int k = 0; k < n && k < MOST_TOLD; k++)
            FW_TRY(tell(r, list[k], diags));
        if (n > MOST_TOLD) tell_rest(r, rule, n - MOST_TOLD, diags);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}
