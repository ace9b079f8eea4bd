/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges of one layer near edges of another: the least distance of every two that are nearer than a
   limit, 0 where they meet, whatever way they face (fw_geometry_segment_distance, closed form,
   error a few ulp of the coordinates). Which pairs: shapes by a sweep along x over the boxes of
   both layers, then edges by theirs. Cost O(n log n + pairs of neighbours). Test:
   test_rule_seeded.c. */
#include "mask/rule.h"
#include "base/sort.h"
#include <stdlib.h>

typedef struct entry {
    const fw_mask_rule_range *range;
    int side; /* 0: the rule's layer, 1: the other one */
    int index;
} entry;

static int by_left(const void *left, const void *right) {
    const entry *p = left, *q = right;
    int order = fw_order_doubles(p->range->box.x0, q->range->box.x0);
    if (!order) order = fw_order_wholes(p->side, q->side);
    return order ? order : fw_order_wholes(p->index, q->index);
}

static void look_at_edges(fw_mask_rule_search *out, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                          double limit_m) {
    double slack = p->slack_m + q->slack_m;
    if (fw_box_apart(&p->box, &q->box, limit_m + slack)) return;
    if (!(fw_box_gap(p->box, q->box) < limit_m + slack)) return;
    fw_geometry_vec2 at[2];
    double d = fw_geometry_segment_distance(&p->s, &q->s, &at[0], &at[1]);
    if (!(d < limit_m + slack)) return;
    if (d > FW_COINCIDENT_M) d = fw_mask_rule_apart(out, p, q, limit_m, at);
    if (!(d < limit_m)) return;
    fw_mask_rule_finding f = {.kind = FW_RULE_SPACE,
                              .shape = {p->shape, q->shape},
                              .segment = {p->segment, q->segment},
                              .value_m = d <= FW_COINCIDENT_M ? 0 : d,
                              .slack_m = slack,
                              .at = {at[0], at[1]},
                              .edge = {p, q}};
    fw_mask_rule_add(out, f);
}

enum { FEW = 256 };

/* Edges of a range that may be near a box, in their order: most edges of an outline are elsewhere. Their number, or
   FEW + 1 for more than FEW. */
static int edges_near(const fw_mask_rule_edge *edge, const fw_mask_rule_range *of,
                      const fw_geometry_box *box, double far, int near[FEW]) {
    int n = 0;
    for (int i = of->first; i < of->first + of->count && n <= FEW; i++)
        if (!fw_box_beyond(&edge[i].box, box, far)) {
            if (n < FEW) near[n] = i;
            n++;
        }
    return n;
}

static void look_at_ranges(fw_mask_rule_search *out, const fw_mask_rule_search *a,
                           const fw_mask_rule_search *b, const fw_mask_rule_range *r,
                           const fw_mask_rule_range *s, double limit_m) {
    double far = limit_m + a->slack_m + b->slack_m;
    int near[FEW], n = edges_near(b->edge, s, &r->box, far, near), all = n > FEW ? s->count : n;
    for (int i = 0; i < r->count; i++) {
        fw_mask_rule_edge *p = &a->edge[r->first + i];
        if (fw_box_beyond(&p->box, &s->box, far)) continue;
        for (int j = 0; j < all; j++) {
            fw_mask_rule_edge *q = &b->edge[n > FEW ? s->first + j : near[j]];
            if (q->box.x0 - p->box.x1 > far) break;
            look_at_edges(out, p, q, limit_m);
        }
    }
}

/* chords between the rule's two layers below its limit, and edges that cross (rule_layers.c) */
static fw_status between_layers(fw_mask_rules *rules, const fw_mask_rule *rule,
                                fw_mask_rule_search *out) {
    const fw_mask_rule_search *a = &rules->search[rule->layer], *b = &rules->search[rule->other];
    int n = a->nrange + b->nrange;
    *out = (fw_mask_rule_search){.arena = rules->arena,
                                 .shape = rules->shape,
                                 .tolerance_m = rules->tolerance_m,
                                 .most = FW_MASK_FOUND_MOST};
    entry *list = fw_arena_array(rules->arena, entry, (size_t)n);
    FW_NEED(list);
    for (int i = 0; i < n; i++)
        list[i] =
            i < a->nrange ? (entry){&a->range[i], 0, i} : (entry){&b->range[i - a->nrange], 1, i};
    if (n) qsort(list, (size_t)n, sizeof *list, by_left);
    double far = rule->least + a->slack_m + b->slack_m;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n && list[j].range->box.x0 - list[i].range->box.x1 <= far; j++) {
            if (list[i].side == list[j].side ||
                fw_box_gap(list[i].range->box, list[j].range->box) > far)
                continue;
            const entry *p = list[i].side ? &list[j] : &list[i],
                        *q = list[i].side ? &list[i] : &list[j];
            look_at_ranges(out, a, b, p->range, q->range, rule->least);
        }
    return out->no_memory ? FW_NOMEM : FW_OK;
}

/* what was found between layers as places: one alone where a shape crosses, lies in or outside */
static fw_status add_distances(fw_mask_rules *rules, const fw_mask_rule *rule,
                               fw_mask_rule_search *between) {
    fw_mask_rule_finding *place;
    int count;
    if (between->no_memory) return FW_NOMEM;
    rules->search[rule->layer].crowded |= between->crowded;
    FW_TRY(fw_mask_rule_places(rules->arena, between->found, between->nfound, rule->least, &place,
                               &count));
    for (int i = 0, next; i < count; i = next) {
        bool zero = false, told = false;
        for (next = i; next < count && place[next].shape[0] == place[i].shape[0] &&
                       place[next].shape[1] == place[i].shape[1];
             next++)
            zero = zero || place[next].value_m == 0;
        for (int k = i; k < next && !(zero && told); k++) {
            const fw_mask_rule_finding *f = &place[k];
            if (zero && f->value_m > 0) continue;
            told = true;
            const char *label[2] = {rules->shape[f->edge[0]->shape].piece->label,
                                    rules->shape[f->edge[1]->shape].piece->label};
            bool alone = f->edge[0] == f->edge[1];
            fw_mask_rules_add(rules, (fw_mask_finding){.rule = rule,
                                                       .what = rule->kind->name,
                                                       .at = {f->at[0], f->at[1]},
                                                       .box = f->box,
                                                       .value = f->value_m,
                                                       .limit = rule->least,
                                                       .needed = rule->least,
                                                       .label = {label[0], alone ? NULL : label[1]},
                                                       .edge = {f->segment[0], f->segment[1]}});
        }
    }
    return FW_OK;
}

/* Enclosure: a shape of one layer lies inside the union of another, and farther than the limit (and
   what flattening takes) from its boundary: lettering inside the frame it is cleared from. Least
   distances of exact edges (rule_layers.c); a shape that crosses the boundary, lies outside, or
   has a hole of the other layer in it is one finding with the value 0.
   In: edges of both layers, m. Out: one finding for each place. Error: a few ulp of the
   coordinates. Cost O(n log n), and O(pieces) for each point that says inside or not. Test:
   test_rule_seeded.c. */

static void add_outside(fw_mask_rule_search *between, const fw_mask_rule_edge *e) {
    fw_geometry_vec2 at = fw_geometry_segment_point(&e->s, 0.5);
    fw_mask_rule_add(between, (fw_mask_rule_finding){.shape = {e->shape, -1},
                                                     .segment = {e->segment, -1},
                                                     .at = {at, at},
                                                     .edge = {e, e}});
}

/* an edge of the outer layer's boundary that lies inside the shape, where none cross: a hole */
static bool holds_boundary(const fw_mask_rules *rules, const fw_mask_rule_range *r,
                           const fw_mask_rule_search *outer) {
    for (int i = 0; i < outer->nrange && outer->range[i].box.x0 <= r->box.x1; i++) {
        if (fw_box_gap(outer->range[i].box, r->box) > 0) continue;
        for (int j = 0; j < outer->range[i].count; j++) {
            const fw_mask_rule_edge *e = &outer->edge[outer->range[i].first + j];
            if (fw_box_gap(e->box, r->box) == 0 &&
                fw_geometry_contour_contains(&rules->shape[r->shape].contour,
                                             fw_geometry_segment_point(&e->s, 0.5)))
                return true;
        }
    }
    return false;
}

static fw_status add_all_outside(fw_mask_rules *rules, const fw_mask_rule *rule,
                                 fw_mask_rule_search *between) {
    const fw_mask_rule_search *inner = &rules->search[rule->layer],
                              *outer = &rules->search[rule->other];
    bool *crosses = fw_arena_array(rules->arena, bool, (size_t)rules->nshape);
    FW_NEED(crosses);
    for (int i = 0; i < between->nfound; i++)
        if (between->found[i].value_m == 0) crosses[between->found[i].edge[0]->shape] = true;
    for (int i = 0; i < inner->nrange; i++) {
        const fw_mask_rule_range *r = &inner->range[i];
        if (crosses[r->shape]) continue;
        if (holds_boundary(rules, r, outer)) add_outside(between, &inner->edge[r->first]);
        for (int j = 0; j < r->count; j++) {
            const fw_mask_rule_edge *e = &inner->edge[r->first + j];
            if (fw_mask_rules_first(rules, e) &&
                !fw_mask_rules_holding(rules, rule->other, fw_geometry_segment_point(&e->s, 0.5)))
                add_outside(between, e);
        }
    }
    return FW_OK;
}

static fw_status check_enclosure(fw_mask_rules *rules, const fw_mask_rule *rule) {
    fw_mask_rule_search between;
    FW_TRY(between_layers(rules, rule, &between));
    for (int i = 0; i < between.nfound; i++) /* the other layer is one union */
        between.found[i].shape[1] = -1;
    FW_TRY(add_all_outside(rules, rule, &between));
    return add_distances(rules, rule, &between);
}

const fw_mask_rule_kind_row fw_mask_kind_enclosure = {
    .name = "enclosure",
    .advice = "move it inwards, or make what is around it larger",
    .number = 154,
    .marker = 8,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_INSIDE,
    .check = check_enclosure,
};

/* Separation: shapes of two layers are farther than the limit (and what flattening takes) from each
   other: the lane of the saw from the device. Least distances of exact edges (rule_layers.c); two
   shapes that cross, or of which one lies in the other, are one finding with the value 0.
   In: edges of both layers, m. Out: one finding for each place. Error: a few ulp of the
   coordinates. Cost O(n log n), and O(pieces) for each point that says inside or not. Test:
   test_rule_seeded.c. */

/* runs of one layer's boundary that lie inside the other layer; those that cross it are known */
static void add_inside(const fw_mask_rules *rules, int layer, int other, bool turned,
                       fw_mask_rule_search *between) {
    const fw_mask_rule_search *in = &rules->search[layer], *out = &rules->search[other];
    for (int i = 0; i < in->nedge; i++) {
        const fw_mask_rule_edge *e = &in->edge[i];
        if (!fw_mask_rules_first(rules, e)) continue;
        fw_geometry_vec2 at = fw_geometry_segment_point(&e->s, 0.5);
        const fw_mask_rule_range *around = fw_mask_rules_holding(rules, other, at);
        if (!around) continue;
        const fw_mask_rule_edge *q = &out->edge[around->first], *own = turned ? q : e;
        if (turned) q = e;
        fw_mask_rule_add(between, (fw_mask_rule_finding){.shape = {own->shape, q->shape},
                                                         .segment = {own->segment, q->segment},
                                                         .at = {at, at},
                                                         .edge = {own, q}});
    }
}

static fw_status check_separation(fw_mask_rules *rules, const fw_mask_rule *rule) {
    fw_mask_rule_search between;
    FW_TRY(between_layers(rules, rule, &between));
    add_inside(rules, rule->layer, rule->other, false, &between);
    add_inside(rules, rule->other, rule->layer, true, &between);
    if (between.no_memory) return FW_NOMEM;
    return add_distances(rules, rule, &between);
}

const fw_mask_rule_kind_row fw_mask_kind_separation = {
    .name = "separation",
    .advice = "move the two apart",
    .number = 154,
    .marker = 9,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_FROM,
    .check = check_separation,
};

/* Pieces of one layer that meet without a shared joint, or lie in each other: built in, because
   area and width of the union would be wrong. One finding for every two pieces. Points where edges
   meet: fw_geometry_segment_intersect, a few ulp; nesting: one point of a piece against the others
   whose box holds it. Test: test_mask_rules.c, test_rule_seeded.c. */

static int by_shapes(const void *left, const void *right) {
    const fw_mask_rule_finding *p = left, *q = right;
    int order = 0;
    for (int k = 0; k < 2 && !order; k++)
        order = fw_order_wholes(p->shape[k], q->shape[k]);
    for (int k = 0; k < 2 && !order; k++)
        order = fw_order_wholes(p->segment[k], q->segment[k]);
    return order ? order : fw_mask_order_places(p->at[0], q->at[0]);
}

static fw_status check_overlap(fw_mask_rules *rules, const fw_mask_rule *rule) {
    const fw_mask_rule_search *in = &rules->search[rule->layer];
    int n = 0, most = 0;
    for (int i = 0; i < in->nfound; i++)
        most += in->found[i].kind == FW_RULE_OVERLAP;
    if (most == 0) return FW_OK;
    fw_mask_rule_finding *list = fw_arena_array(rules->arena, fw_mask_rule_finding, (size_t)most);
    FW_NEED(list);
    for (int i = 0; i < in->nfound; i++)
        if (in->found[i].kind == FW_RULE_OVERLAP) list[n++] = in->found[i];
    if (n) qsort(list, (size_t)n, sizeof *list, by_shapes);
    for (int i = 0, next; i < n; i = next) {
        const fw_mask_rule_finding *f = &list[i];
        fw_mask_finding found = {.rule = rule,
                                 .what = "overlap",
                                 .at = {f->at[0], f->at[1]},
                                 .box = fw_mask_box_around(f->at[0], f->at[1]),
                                 .label = {rules->shape[f->shape[0]].piece->label,
                                           rules->shape[f->shape[1]].piece->label},
                                 .edge = {f->segment[0], f->segment[1]}};
        for (next = i;
             next < n && list[next].shape[0] == f->shape[0] && list[next].shape[1] == f->shape[1];
             next++)
            found.box =
                fw_box_join(found.box, fw_mask_box_around(list[next].at[0], list[next].at[1]));
        fw_mask_rules_add(rules, found);
    }
    return FW_OK;
}

const fw_mask_rule_kind_row fw_mask_kind_overlap = {
    .name = "overlap",
    .advice = "move them apart or join them",
    .number = 152,
    .marker = 10,
    .unit = FW_UNIT_LENGTH,
    .built_in = true,
    .check = check_overlap,
};
