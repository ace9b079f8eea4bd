/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges of one layer near edges of another: the least distance of every two that are nearer than a
   limit, 0 where they meet, whatever way they face (fw_geometry_segment_distance, closed form,
   error a few
   ulp of the coordinates). Which pairs: shapes by a sweep along x over the boxes of both layers,
   then edges by theirs. Cost O(n log n + pairs of neighbours). Test: test_rule_seeded.c. */
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

static void look_at_edges(fw_mask_rule_search *out, const fw_mask_rule_edge *p,
                          const fw_mask_rule_edge *q, double limit_m) {
    double slack = p->slack_m + q->slack_m;
    if (fw_box_apart(&p->box, &q->box, limit_m + slack)) return;
    if (!(fw_box_gap(p->box, q->box) < limit_m + slack)) return;
    fw_geometry_vec2 at_p, at_q;
    double d = fw_geometry_segment_distance(&p->s, &q->s, &at_p, &at_q);
    if (!(d < limit_m + slack - FW_COINCIDENT_M)) return;
    fw_mask_rule_finding f = {.kind = FW_RULE_SPACE,
                              .shape = {p->shape, q->shape},
                              .segment = {p->segment, q->segment},
                              .value_m = d <= FW_COINCIDENT_M ? 0 : d,
                              .slack_m = slack,
                              .at = {at_p, at_q},
                              .edge = {p, q}};
    fw_mask_rule_add(out, f);
}

static void look_at_ranges(fw_mask_rule_search *out, const fw_mask_rule_search *a,
                           const fw_mask_rule_search *b, const fw_mask_rule_range *r,
                           const fw_mask_rule_range *s, double limit_m) {
    double far = limit_m + a->slack_m + b->slack_m;
    for (int i = 0; i < r->count; i++) {
        const fw_mask_rule_edge *p = &a->edge[r->first + i];
        if (fw_box_gap(p->box, s->box) > far) continue;
        for (int j = 0; j < s->count; j++) {
            const fw_mask_rule_edge *q = &b->edge[s->first + j];
            if (q->box.x0 - p->box.x1 > far) break;
            look_at_edges(out, p, q, limit_m);
        }
    }
}

fw_status fw_mask_rules_between(fw_mask_rules *rules, const fw_mask_rule *rule,
                                fw_mask_rule_search *out) {
    const fw_mask_rule_search *a = &rules->search[rule->layer], *b = &rules->search[rule->other];
    int n = a->nrange + b->nrange;
    *out = (fw_mask_rule_search){.arena = rules->arena, .shape = rules->shape};
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

fw_status fw_mask_rules_distances(fw_mask_rules *rules, const fw_mask_rule *rule,
                                  fw_mask_rule_search *between) {
    fw_mask_rule_finding *place;
    int count;
    if (between->no_memory) return FW_NOMEM;
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
                                                       .needed = rule->least + f->slack_m,
                                                       .label = {label[0], alone ? NULL : label[1]},
                                                       .edge = {f->segment[0], f->segment[1]}});
        }
    }
    return FW_OK;
}
