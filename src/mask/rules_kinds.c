/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What kinds of rules share: findings, one for each place, chords of a layer, which shape holds a place, islands. */
#include "mask/rule.h"
#include <stdlib.h>

/* ---- places ----
   Chords that are too short, as places. Two edges have many such chords, and a thin part has many
   edges; what a person wants is one finding for each place, with its shortest chord.
     - A chord stands for the stretch of either edge around its foot in which the other edge is
   nearer than the limit, walked from the foot in steps of a quarter of the limit. Chords of the
   same two edges with both feet in these stretches belong to it.
     - Stretches that run on along an edge, or over the end it shares with the next one, within half
   the limit, are one place; between other pieces only where both sides run on, so that a gap to
   one piece and the next gap to another stay two.
   In: chords of one kind below the limit, m. Out: the places, each with its shortest chord and the
   box of all of it. Error: places less than half a limit apart become one; none is lost, and no
   length is changed. Cost O(n log n + edge / limit for each stretch + neighbours). Test:
   test_rule_seeded.c, test_rules_search.c. */

enum { MOST_STEPS = 8192 };

typedef struct stretch { /* of both edges */
    const fw_mask_rule_finding *worst;
    double from[2], to[2];
    fw_geometry_box box;
    int place; /* the first stretch of its place */
} stretch;

static int in_order(const void *left, const void *right) {
    const fw_mask_rule_finding *p = left, *q = right;
    int order = 0;
    for (int k = 0; k < 2 && !order; k++)
        order = fw_order_wholes(p->shape[k], q->shape[k]);
    for (int k = 0; k < 2 && !order; k++) /* of one array each: the order is the same every time */
        order = (p->edge[k] > q->edge[k]) - (p->edge[k] < q->edge[k]);
    if (!order) order = fw_order_doubles(p->value_m, q->value_m);
    for (int k = 0; k < 2 && !order; k++)
        order = fw_mask_order_places(p->at[k], q->at[k]);
    return order;
}

static bool same_edges(const fw_mask_rule_finding *f, const fw_mask_rule_finding *g) {
    return f->edge[0] == g->edge[0] && f->edge[1] == g->edge[1];
}

static bool same_shapes(const fw_mask_rule_finding *f, const fw_mask_rule_finding *g) {
    return f->shape[0] == g->shape[0] && f->shape[1] == g->shape[1];
}

/* how far from t the other edge stays nearer than the limit, in steps of dt */
static double walk(const fw_geometry_segment *s, const fw_geometry_segment *other, double t,
                   double dt, double needed) {
    fw_geometry_vec2 foot;
    double at, end = dt > 0 ? 1 : 0;
    while (t != end) {
        double next = dt > 0 ? fmin(t + dt, 1) : fmax(t + dt, 0);
        if (!(fw_geometry_segment_nearest(other, fw_geometry_segment_point(s, next), &at, &foot) <
              needed))
            break;
        t = next;
    }
    return t;
}

static fw_geometry_box box_of(const stretch *r) {
    fw_geometry_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 2; k++) {
        const fw_geometry_segment *s = &r->worst->edge[k]->s;
        fw_geometry_vec2 at = r->worst->at[k], a = fw_geometry_segment_point(s, r->from[k]),
                         b = fw_geometry_segment_point(s, r->to[k]);
        box = fw_box_join(box, (fw_geometry_box){at.x, at.y, at.x, at.y});
        if (r->to[k] - r->from[k] > 1e-9) {
            fw_geometry_segment part = fw_geometry_segment_cut(s, r->from[k], a, r->to[k], b);
            box = fw_box_join(box, fw_segment_box(&part));
        }
    }
    return box;
}

static stretch around(const fw_mask_rule_finding *f, double limit_m) {
    stretch r = {.worst = f};
    for (int k = 0; k < 2; k++) {
        const fw_geometry_segment *s = &f->edge[k]->s, *other = &f->edge[1 - k]->s;
        double needed = limit_m + f->slack_m, length = fw_geometry_segment_length(s);
        double step = fmax(0.25 * needed / length, 1.0 / MOST_STEPS);
        double t = fw_geometry_segment_parameter(s, f->at[k]);
        r.from[k] = s == other ? 0 : walk(s, other, t, -step, needed);
        r.to[k] = s == other ? 1 : walk(s, other, t, step, needed);
    }
    r.box = box_of(&r);
    return r;
}

static bool covers(const stretch *r, const fw_mask_rule_finding *f) {
    for (int k = 0; k < 2; k++) {
        double t = fw_geometry_segment_parameter(&f->edge[k]->s, f->at[k]);
        if (t < r->from[k] - 1e-9 || t > r->to[k] + 1e-9) return false;
    }
    return true;
}

/* do two stretches of edges run into each other, within `near_m` along them? */
static bool run_on(const fw_geometry_segment *s, double from_s, double to_s,
                   const fw_geometry_segment *t, double from_t, double to_t, double near_m) {
    double length = fw_geometry_segment_length(s);
    if (s == t) return fmax(from_s, from_t) - fmin(to_s, to_t) <= near_m / length;
    double at_end = (1 - to_s) * length, at_start = from_s * length;
    double t_end = (1 - to_t) * fw_geometry_segment_length(t),
           t_start = from_t * fw_geometry_segment_length(t);
    return (vec_same(s->b, t->a) && at_end + t_start <= near_m) ||
           (vec_same(t->b, s->a) && t_end + at_start <= near_m);
}

static bool one_place(const stretch *p, const stretch *q, double limit_m) {
    bool run[2][2];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            run[i][j] = run_on(&p->worst->edge[i]->s, p->from[i], p->to[i], &q->worst->edge[j]->s,
                               q->from[j], q->to[j], 0.5 * limit_m);
    if (same_shapes(p->worst, q->worst)) return run[0][0] || run[0][1] || run[1][0] || run[1][1];
    return (run[0][0] && run[1][1]) || (run[0][1] && run[1][0]);
}

/* chords of one pair of edges, shortest first: a stretch around each that is in none before */
static int stretches_of(const fw_mask_rule_finding *f, int n, double limit_m, stretch *out,
                        int count) {
    int first = count;
    for (int i = 0; i < n; i++) {
        bool new = true;
        for (int k = first; k < count && new; k++)
            new = !covers(&out[k], &f[i]);
        if (new) out[count++] = around(&f[i], limit_m);
    }
    return count;
}

static int root(const stretch *list, int i) {
    while (list[i].place != i && list[i].place >= 0)
        i = list[i].place;
    return i;
}

static int by_box(const void *left, const void *right) {
    const stretch *p = *(const stretch *const *)left, *q = *(const stretch *const *)right;
    int order = fw_order_doubles(p->box.x0, q->box.x0);
    return order ? order : (p > q) - (p < q); /* of one array */
}

/* marks with each stretch the first one of its place */
static fw_status join_places(fw_arena *arena, stretch *list, int n, double limit_m) {
    stretch **by = fw_arena_array(arena, stretch *, (size_t)n);
    FW_NEED(by);
    for (int i = 0; i < n; i++) {
        list[i].place = i;
        by[i] = &list[i];
    }
    if (n) qsort(by, (size_t)n, sizeof *by, by_box);
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n && by[j]->box.x0 - by[i]->box.x1 <= limit_m; j++) {
            if (fw_box_gap(by[i]->box, by[j]->box) > limit_m) continue;
            int p = root(list, (int)(by[i] - list)), q = root(list, (int)(by[j] - list));
            if (p != q && one_place(by[i], by[j], limit_m))
                list[p > q ? p : q].place = p > q ? q : p;
        }
    return FW_OK;
}

/* the shortest chord, moved to the middle of its stretch where it is as short there: between
   parallel lines and concentric arcs */
static fw_mask_rule_finding centred(const stretch *r) {
    fw_mask_rule_finding f = *r->worst;
    const fw_geometry_segment *s = &f.edge[0]->s, *other = &f.edge[1]->s;
    double t;
    fw_geometry_vec2 foot, middle = fw_geometry_segment_point(s, 0.5 * (r->from[0] + r->to[0]));
    f.box = r->box;
    if (s != other &&
        fabs(fw_geometry_segment_nearest(other, middle, &t, &foot) - f.value_m) <= FW_COINCIDENT_M)
        f.at[0] = middle, f.at[1] = foot;
    return f;
}

/* the shortest chord of each place, and the box of all of it */
static int shortest(stretch *list, int n, fw_mask_rule_finding *out) {
    int count = 0;
    for (int i = 0; i < n; i++) {
        int first = root(list, i);
        if (first == i) {
            list[i].place = -1 - count; /* from now on: where it is in `out` */
            out[count++] = centred(&list[i]);
        } else {
            fw_mask_rule_finding *f = &out[-1 - list[first].place];
            fw_geometry_box box = fw_box_join(f->box, list[i].box);
            if (list[i].worst->value_m < f->value_m - FW_COINCIDENT_M) *f = centred(&list[i]);
            f->box = box;
        }
    }
    return count;
}

fw_status fw_mask_rule_places(fw_arena *arena, fw_mask_rule_finding *list, int n, double limit_m,
                              fw_mask_rule_finding **out, int *nout) {
    *nout = 0;
    FW_NEED(*out = fw_arena_array(arena, fw_mask_rule_finding, (size_t)n));
    fw_mark mark = fw_arena_mark(arena);
    stretch *r = fw_arena_array(arena, stretch, (size_t)n);
    FW_NEED(r);
    int count = 0;
    if (n) qsort(list, (size_t)n, sizeof *list, in_order);
    for (int i = 0, next; i < n; i = next) {
        for (next = i; next < n && same_edges(&list[next], &list[i]);)
            next++;
        count = stretches_of(list + i, next - i, limit_m, r, count);
    }
    FW_TRY(join_places(arena, r, count, limit_m));
    *nout = shortest(r, count, *out);
    fw_arena_rewind(arena, mark);
    return FW_OK;
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
    int n = 0, most = 0, count, *island = NULL;
    for (int i = 0; i < in->nfound; i++)
        most += in->found[i].kind == kind && fw_mask_rule_short(in->found[i].value_m, rule->least);
    if (most == 0) return FW_OK;
    FW_NEED(list = fw_arena_array(r->arena, fw_mask_rule_finding, (size_t)most));
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
