/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of design rules: one line each, in the order of docs/theory/masks.md. */
#include "mask/rule.h"

#define FW_MASK_RULE(name) &fw_mask_kind_##name,
static const fw_mask_rule_kind_row *const kinds[] = {
#include "mask/rules.def"
};
#undef FW_MASK_RULE

const fw_mask_rule_kind_row *fw_mask_rule_kind_at(size_t i) {
    return i < sizeof kinds / sizeof kinds[0] ? kinds[i] : NULL;
}

const char *fw_mask_rule_name(const fw_mask_rule *rule) {
    return rule->kind->name;
}

double fw_mask_rule_row_shown(const fw_mask_rule_kind_row *kind, double value) {
    switch (kind->unit) {
    case FW_UNIT_LENGTH:
        return value * 1e6;
    case FW_UNIT_ANGLE:
        return value * 180 / FW_PI;
    case FW_UNIT_AREA:
        return value * 1e12;
    case FW_UNIT_SHARE:
        return value;
    }
    return value;
}

const char *fw_mask_rule_unit_name(const fw_mask_rule_kind_row *kind) {
    static const char *const name[] = {"um", "deg", "um2", "of the window"};
    return name[kind->unit];
}

double fw_mask_rule_shown(const fw_mask_rule *rule, double value) {
    return fw_mask_rule_row_shown(rule->kind, value);
}

const char *fw_mask_rule_unit(const fw_mask_rule *rule) {
    return rule->kind->unit == FW_UNIT_SHARE ? "" : fw_mask_rule_unit_name(rule->kind);
}

/* All rules of one mask. The union of pieces that share joints is bounded by their other segments,
   with the material on the left. So width and space of the union need no boolean: every two
   boundary edges that are near enough are looked at, and the side on which the chord leaves tells
   material from empty space. Edges: rules_edges.c; which pairs: rules_search.c; a pair:
   rules_pair.c; places: rules_places.c. What a rule makes of it: rule_*.c. */

/* ---- the rules: rows of the table, and what layers say in a word ---- */

static void add_rule(fw_mask_rules *r, const fw_mask_rule_kind_row *kind, int layer,
                     double least_m) {
    const fw_mask_layer *l = &r->table->layer[layer];
    if (!kind->built_in && !(least_m > 0)) return;
    for (int i = 0; i < r->table->nrule; i++) { /* it stands there as a row, with its own reason */
        const fw_mask_rule *rule = &r->table->rule[i];
        if (rule->kind == kind && rule->layer == layer && rule->severity == FW_ERROR) return;
    }
    r->rule[r->nrule++] = (fw_mask_rule){.kind = kind,
                                         .layer = layer,
                                         .other = -1,
                                         .least = least_m,
                                         .most = HUGE_VAL,
                                         .of = kind->usual_of,
                                         .source = l->rule_source ? l->rule_source : "layer table",
                                         .severity = FW_ERROR,
                                         .place = l->place};
}

static fw_status list_rules(fw_mask_rules *r) {
    const fw_mask_table *t = r->table;
    size_t most = (size_t)t->nrule + 3 * (size_t)t->nlayer;
    FW_NEED(r->rule = fw_arena_array(r->arena, fw_mask_rule, most));
    for (int k = 0; k < t->nlayer; k++) {
        add_rule(r, &fw_mask_kind_overlap, k, 0);
        add_rule(r, &fw_mask_kind_width, k, t->layer[k].min_width_m);
        add_rule(r, &fw_mask_kind_space, k, t->layer[k].min_space_m);
    }
    for (int i = 0; i < t->nrule; i++)
        r->rule[r->nrule++] = t->rule[i];
    return FW_OK;
}

static void set_limits(fw_mask_rules *r) {
    for (int i = 0; i < r->nrule; i++) {
        const fw_mask_rule *rule = &r->rule[i];
        double *limit = r->search[rule->layer].limit_m;
        for (int k = FW_RULE_WIDTH; k <= FW_RULE_SPACE; k++)
            if (rule->kind->chords & 1u << k) limit[k] = fmax(limit[k], rule->least);
    }
}

/* ---- pieces inside each other: no edges meet then ---- */
static bool box_inside(fw_geometry_box in, fw_geometry_box out) {
    return in.x0 >= out.x0 && in.x1 <= out.x1 && in.y0 >= out.y0 && in.y1 <= out.y1;
}

static void look_at_nested(fw_mask_rule_search *in, const fw_mask_rule_range *r,
                           const fw_mask_rule_range *out) {
    if (!box_inside(r->box, out->box)) return;
    const fw_mask_rule_edge *e = &in->edge[r->first];
    fw_geometry_vec2 at = fw_geometry_segment_point(&e->s, 0.5);
    if (fw_geometry_contour_contains(&in->shape[out->shape].contour, at))
        fw_mask_rule_report(in, (fw_mask_rule_finding){.kind = FW_RULE_OVERLAP,
                                                       .shape = {r->shape, out->shape},
                                                       .segment = {e->segment, 0},
                                                       .at = {at, at}});
}

static void look_at_nesting(fw_mask_rule_search *in) {
    for (int i = 0; i < in->nrange; i++)
        for (int j = i + 1; j < in->nrange && in->range[j].box.x0 <= in->range[i].box.x1; j++) {
            look_at_nested(in, &in->range[i], &in->range[j]);
            look_at_nested(in, &in->range[j], &in->range[i]);
        }
}

static double perimeter_of(const fw_mask_rule_edge *e, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fw_geometry_segment_length(&e[i].s);
    return sum;
}

static fw_status look_at_layer(fw_mask_rules *r, int k, fw_mask_measure *m) {
    fw_mask_rule_search *in = &r->search[k];
    m->width_m = m->space_m = HUGE_VAL;
    FW_TRY(fw_mask_rule_edges(in, r->nshape, r->tolerance_m));
    m->perimeter_m = perimeter_of(in->edge, in->nedge);
    fw_mask_rule_search_run(in);
    look_at_nesting(in);
    if (m->width_m > FW_MASK_LOOK_M) m->width_m = HUGE_VAL;
    if (m->space_m > FW_MASK_LOOK_M) m->space_m = HUGE_VAL;
    return in->no_memory ? FW_NOMEM : FW_OK;
}

fw_status fw_mask_rules_start(fw_mask_rules *r, fw_mask_measure *measure) {
    int n = r->table->nlayer;
    FW_TRY(list_rules(r));
    FW_NEED(r->search = fw_arena_array(r->arena, fw_mask_rule_search, (size_t)n));
    for (int k = 0; k < n; k++)
        r->search[k] = (fw_mask_rule_search){
            .arena = r->arena, .index = k, .shape = r->shape, .measure = &measure[k]};
    set_limits(r);
    for (int k = 0; k < n; k++)
        FW_TRY(look_at_layer(r, k, &measure[k]));
    return FW_OK;
}

fw_status fw_mask_rules_check(fw_mask_rules *r, bool polygons) {
    for (int i = 0; i < r->nrule; i++)
        if ((r->rule[i].of == FW_OF_POLYGON) == polygons)
            FW_TRY(r->rule[i].kind->check(r, &r->rule[i]));
    return r->no_memory ? FW_NOMEM : FW_OK;
}
