/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of design rules: one line each, in the order of docs/theory/masks.md. */
#include "mask/rule.h"
#include <stdlib.h>

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
   material from empty space. Edges: rules_search.c; which pairs: rules_search.c; a pair:
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

/* ---- for the kinds ---- */

fw_geometry_box fw_mask_box_around(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return (fw_geometry_box){fmin(p.x, q.x), fmin(p.y, q.y), fmax(p.x, q.x), fmax(p.y, q.y)};
}

void fw_mask_rules_add(fw_mask_rules *r, fw_mask_finding f) {
    if (r->nfinding == r->room) {
        size_t more = r->room ? 2 * (size_t)r->room : 16;
        fw_mask_finding *grown =
            fw_arena_grow(r->arena, r->finding, (size_t)r->nfinding, more, sizeof f);
        if (!grown) {
            r->no_memory = true;
            return;
        }
        r->finding = grown;
        r->room = (int)more;
    }
    r->finding[r->nfinding++] = f;
}

fw_status fw_mask_rules_chords(fw_mask_rules *r, const fw_mask_rule *rule, fw_mask_rule_kind kind,
                               bool (*pick)(const fw_mask_rules *rules,
                                            const fw_mask_rule_finding *f, const void *with),
                               const void *with) {
    if (!(rule->kind->chords & 1u << kind)) return FW_INTERNAL; /* they were not all searched */
    const fw_mask_rule_search *in = &r->search[rule->layer];
    fw_mask_rule_finding *list, *place;
    int n = 0, count;
    if (in->nfound == 0) return FW_OK;
    FW_NEED(list = fw_arena_array(r->arena, fw_mask_rule_finding, (size_t)in->nfound));
    for (int i = 0; i < in->nfound; i++) {
        const fw_mask_rule_finding *f = &in->found[i];
        if (f->kind == kind && f->value_m < rule->least + f->slack_m - FW_COINCIDENT_M &&
            (!pick || pick(r, f, with)))
            list[n++] = *f;
    }
    FW_TRY(fw_mask_rule_places(r->arena, list, n, rule->least, &place, &count));
    for (int i = 0; i < count; i++) {
        const fw_mask_rule_finding *f = &place[i];
        fw_mask_rules_add(r, (fw_mask_finding){.rule = rule,
                                               .what = kind == FW_RULE_WIDTH ? "width" : "space",
                                               .at = {f->at[0], f->at[1]},
                                               .box = f->box,
                                               .value = f->value_m,
                                               .limit = rule->least,
                                               .needed = rule->least + f->slack_m,
                                               .label = {r->shape[f->shape[0]].piece->label,
                                                         r->shape[f->shape[1]].piece->label},
                                               .edge = {f->segment[0], f->segment[1]}});
    }
    return FW_OK;
}

const fw_mask_rule_range *fw_mask_rules_holding(const fw_mask_rules *r, int layer,
                                                fw_geometry_vec2 at) {
    const fw_mask_rule_search *in = &r->search[layer];
    for (int i = 0; i < in->nrange && in->range[i].box.x0 <= at.x; i++) {
        const fw_mask_rule_range *s = &in->range[i];
        if (at.x <= s->box.x1 && at.y >= s->box.y0 && at.y <= s->box.y1 &&
            fw_geometry_contour_contains(&r->shape[s->shape].contour, at))
            return s;
    }
    return NULL;
}

bool fw_mask_rules_first(const fw_mask_rules *r, const fw_mask_rule_edge *edge) {
    const fw_geometry_contour *c = &r->shape[edge->shape].contour;
    if (c->segment[(edge->segment + c->count - 1) % c->count].flags & FW_SEGMENT_JOINT) return true;
    if (edge->segment > 0) return false;
    for (int i = 0; i < c->count; i++) /* of a shape with joints: where the run begins */
        if (c->segment[i].flags & FW_SEGMENT_JOINT) return false;
    return true;
}

/* ---- islands: pieces with a joint in common ---- */

typedef struct seam { /* a joint, its lesser end first */
    fw_geometry_vec2 a, b;
    int shape;
} seam;

static int by_ends(const void *left, const void *right) {
    const seam *p = left, *q = right;
    int order = fw_mask_order_places(p->a, q->a);
    if (!order) order = fw_mask_order_places(p->b, q->b);
    return order ? order : fw_order_wholes(p->shape, q->shape);
}

static int first_of(int *group, int i) {
    while (group[i] != i)
        i = group[i] = group[group[i]];
    return i;
}

static int list_seams(const fw_mask_rules *r, int layer, seam *list) {
    int n = 0;
    for (int k = 0; k < r->nshape; k++)
        for (int i = 0; r->shape[k].layer == layer && i < r->shape[k].contour.count; i++) {
            const fw_geometry_segment *s = &r->shape[k].contour.segment[i];
            if (!(s->flags & FW_SEGMENT_JOINT)) continue;
            bool forth = vec_before(s->a, s->b);
            if (list) list[n] = (seam){forth ? s->a : s->b, forth ? s->b : s->a, k};
            n++;
        }
    return n;
}

/* In: shapes whose joints have the same bits on either side (fw_mask_join). Cost O(n log n). */
fw_status fw_mask_rules_islands(const fw_mask_rules *r, int layer, int **out) {
    int *group, n = list_seams(r, layer, NULL);
    seam *list = fw_arena_array(r->arena, seam, (size_t)n);
    FW_NEED(list);
    FW_NEED(group = fw_arena_array(r->arena, int, (size_t)r->nshape));
    for (int k = 0; k < r->nshape; k++)
        group[k] = k;
    list_seams(r, layer, list);
    if (n) qsort(list, (size_t)n, sizeof *list, by_ends);
    for (int i = 1; i < n; i++) {
        const seam *p = &list[i - 1], *q = &list[i];
        if (!vec_same(p->a, q->a) || !vec_same(p->b, q->b)) continue;
        int g = first_of(group, p->shape), h = first_of(group, q->shape);
        group[g > h ? g : h] = g > h ? h : g;
    }
    for (int k = 0; k < r->nshape; k++)
        group[k] = r->shape[k].layer == layer ? first_of(group, k) : -1;
    *out = group;
    return FW_OK;
}
