/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What kinds of rules share: findings, chords of a layer, which shape holds a place, islands. */
#include "mask/rule.h"
#include <stdlib.h>

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
    int n = 0, count, *island = NULL;
    if (in->nfound == 0) return FW_OK;
    FW_NEED(list = fw_arena_array(r->arena, fw_mask_rule_finding, (size_t)in->nfound));
    for (int i = 0; i < in->nfound; i++) {
        const fw_mask_rule_finding *f = &in->found[i];
        if (f->kind != kind || !fw_mask_rule_short(f->value_m, rule->least) ||
            (pick && !pick(r, f, with)))
            continue;
        if (kind == FW_RULE_WIDTH && f->shape[0] != f->shape[1]) { /* of what hangs together */
            if (!island) FW_TRY(fw_mask_rules_islands(r, rule->layer, &island));
            if (island[f->shape[0]] != island[f->shape[1]]) continue;
        }
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
                                               .needed = rule->least,
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
