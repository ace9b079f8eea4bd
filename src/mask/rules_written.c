/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width and space between edges as they are written: chords of arcs and rounded lines, from grid
   point to grid point. Nothing is allowed for flattening; this is the verdict, and what comes before
   it (rules_pair.c) says only between which edges of the outlines it is asked for.
     - Two written edges face each other when the scalar product of their directions is below 0, in
   exact integers: their outward normals enclose more than 90 degrees. Of either one only the part
   counts that lies on the other one's side: of its material for widths, of the empty space for
   spaces, in exact integers where no edge has to be cut for it.
     - The value is the greater of the least distances from what is left of one edge to the other,
   and the other way round; without a cut both are the least distance of the two. Below the limit it
   is a finding. This is the Euclidian check of KLayout with its ignore angle of 90 degrees, which
   asks both questions (theory: docs/theory/masks.md, with where the two differ). Of edges that meet it is 0, by the
   same exact integers.
     - Two edges of the outline that meet at a corner which is exactly square, or blunter, are made
   sharper by the grid and by the first chords of an arc alone: what is written of them has to be
   7.5 degrees sharper than a right angle before it counts.
   In: two edges of outlines, m; limits of the search. Out: findings, m. Range: coordinates below
   2^30 nm. Error: signs none; distances 1e-16 of the edges' lengths, below 1e-15 m for lengths of
   10 mm. Cost O(n m) for n and m written edges near each other. Test: test_rules_written.c against
   every pair of edges of the polygons; KLayout's verdict: tests/accept/written_rules.py. */
#include "mask/rule.h"

static const double SIN_LEAN = 0.1305261922200516; /* sin 7.5 deg */

/* ---- findings ---- */

void fw_mask_rule_add(fw_mask_rule_search *in, fw_mask_rule_finding f) {
    in->crowded = in->crowded || (in->most && in->nfound == in->most);
    if (in->crowded) return;
    if (in->nfound == in->room) {
        size_t more = in->room ? 2 * (size_t)in->room : 16;
        fw_mask_rule_finding *grown =
            fw_arena_grow(in->arena, in->found, (size_t)in->nfound, more, sizeof f);
        if (!grown) {
            in->no_memory = true;
            return;
        }
        in->found = grown;
        in->room = (int)more;
    }
    in->found[in->nfound++] = f;
}

void fw_mask_rule_report(fw_mask_rule_search *in, fw_mask_rule_finding f) {
    if (f.shape[0] > f.shape[1] || (f.shape[0] == f.shape[1] && f.segment[0] > f.segment[1]))
        f = (fw_mask_rule_finding){.kind = f.kind,
                                   .shape = {f.shape[1], f.shape[0]},
                                   .segment = {f.segment[1], f.segment[0]},
                                   .value_m = f.value_m,
                                   .slack_m = f.slack_m,
                                   .at = {f.at[1], f.at[0]},
                                   .edge = {f.edge[1], f.edge[0]},
                                   .box = f.box};
    fw_mask_rule_add(in, f);
}

/* ---- what is written ---- */

static fw_status points_of(const fw_mask_rule_search *in, const fw_mask_rule_edge *e,
                           fw_geometry_point **at, int *n) {
    const fw_mask_shape *shape = &in->shape[e->shape];
    const fw_mask_neck *neck = &shape->neck;
    for (int k = 0; k < 2; k++) { /* flattened in two parts */
        if (!neck->divided[k] || neck->segment[k] != e->segment) continue;
        double t = neck->t[k];
        fw_geometry_segment half[2] = {fw_geometry_segment_cut(&e->s, 0, e->s.a, t, neck->at[k]),
                                       fw_geometry_segment_cut(&e->s, t, neck->at[k], 1, e->s.b)};
        fw_geometry_point *p[2];
        int count[2];
        for (int i = 0; i < 2; i++)
            FW_TRY(fw_geometry_flatten_segment(in->arena, &half[i], in->tolerance_m,
                                               shape->flattening, &p[i], &count[i]));
        *n = count[0] + count[1] - 1; /* the middle is in both */
        FW_NEED(*at = fw_arena_raw(in->arena, (size_t)*n * sizeof **at));
        for (int i = 0; i < *n; i++)
            (*at)[i] = i < count[0] ? p[0][i] : p[1][i - count[0] + 1];
        return FW_OK;
    }
    return fw_geometry_flatten_segment(in->arena, &e->s, in->tolerance_m, shape->flattening, at, n);
}

static fw_geometry_vec2 place_of(fw_geometry_point p) {
    return (fw_geometry_vec2){p.x_dbu * FW_GEOMETRY_GRID_M, p.y_dbu * FW_GEOMETRY_GRID_M};
}

bool fw_mask_rule_write(fw_mask_rule_search *in, fw_mask_rule_edge *e) {
    if (e->written) return true;
    fw_geometry_point *at;
    int n;
    fw_status status = points_of(in, e, &at, &n);
    if (status == FW_LIMIT) n = 0; /* beyond the grid: it is refused anyway */
    if (status != FW_OK && status != FW_LIMIT) goto no_memory;
    e->written = fw_arena_raw(in->arena, (size_t)(n + 1) * sizeof *e->written);
    e->near = fw_arena_raw(in->arena, (size_t)(n + 1) * sizeof *e->near);
    if (!e->written || !e->near) goto no_memory;
    fw_geometry_vec2 from = {0, 0}, to;
    for (int i = 0; i < n; i++, from = to) {
        to = place_of(at[i]);
        if (i == 0 || vec_same(from, to)) continue;
        fw_geometry_box box = {fw_lesser(from.x, to.x), fw_lesser(from.y, to.y),
                               fw_greater(from.x, to.x), fw_greater(from.y, to.y)};
        e->written_box = e->nwritten ? fw_box_join(e->written_box, box) : box;
        e->written[e->nwritten++] = (fw_mask_rule_written){at[i - 1], at[i], box};
    }
    return true;
no_memory:
    in->no_memory = true;
    return false;
}

/* ---- two written edges ---- */

typedef struct pair { /* as doubles from p's beginning, nm: exact for edges of up to 90 mm */
    fw_geometry_vec2 p[2], q[2];
} pair;

typedef struct apart { /* a distance, and its ends */
    double nm;
    fw_geometry_vec2 at[2]; /* on the first and on the second edge */
} apart;

static pair pair_of(const fw_mask_rule_written *p, const fw_mask_rule_written *q) {
    const fw_geometry_point *o = &p->a;
    const fw_geometry_point at[] = {p->a, p->b, q->a, q->b};
    fw_geometry_vec2 v[4];
    for (int i = 0; i < 4; i++)
        v[i] = (fw_geometry_vec2){(double)at[i].x_dbu - o->x_dbu, (double)at[i].y_dbu - o->y_dbu};
    return (pair){{v[0], v[1]}, {v[2], v[3]}};
}

static bool facing(const fw_mask_rule_written *p, const fw_mask_rule_written *q, bool square) {
    int64_t px = (int64_t)p->b.x_dbu - p->a.x_dbu, py = (int64_t)p->b.y_dbu - p->a.y_dbu;
    int64_t qx = (int64_t)q->b.x_dbu - q->a.x_dbu, qy = (int64_t)q->b.y_dbu - q->a.y_dbu;
    int64_t dot = px * qx + py * qy;
    if (dot >= 0 || !square) return dot < 0;
    double pp = (double)(px * px + py * py), qq = (double)(qx * qx + qy * qy);
    return (double)dot < -SIN_LEAN * sqrt(pp) * sqrt(qq);
}

/* > 0: to the left of the edge; twice the area of the triangle, exact for |coordinate| < 2^30 */
static int64_t side_of(const fw_mask_rule_written *e, fw_geometry_point at) {
    return ((int64_t)e->b.x_dbu - e->a.x_dbu) * ((int64_t)at.y_dbu - e->a.y_dbu) -
           ((int64_t)e->b.y_dbu - e->a.y_dbu) * ((int64_t)at.x_dbu - e->a.x_dbu);
}

/* from a point to an edge */
static double from_point(fw_geometry_vec2 at, const fw_geometry_vec2 e[2], fw_geometry_vec2 *foot) {
    fw_geometry_vec2 d = vec_sub(e[1], e[0]), u = vec_sub(at, e[0]);
    double along = vec_dot(u, d), square = vec_dot(d, d);
    if (along <= 0 || along >= square) {
        *foot = along <= 0 ? e[0] : e[1];
        return vec_distance(at, *foot);
    }
    *foot = vec_along(e[0], along / square, d);
    return fabs(vec_cross(d, u)) / sqrt(square);
}

static apart least_of(const fw_geometry_vec2 p[2], const fw_geometry_vec2 q[2]) {
    apart best = {.nm = HUGE_VAL};
    for (int i = 0; i < 4; i++) {
        fw_geometry_vec2 end = i < 2 ? p[i] : q[i - 2], foot;
        double d = from_point(end, i < 2 ? q : p, &foot);
        if (d < best.nm) best = (apart){d, {i < 2 ? end : foot, i < 2 ? foot : end}};
    }
    return best;
}

/* the part of an edge with sides s[0] and s[1] on which they are not below 0 */
static void cut_to(const int64_t s[2], const fw_geometry_vec2 e[2], fw_geometry_vec2 out[2]) {
    double t = (double)s[0] / ((double)s[0] - (double)s[1]);
    fw_geometry_vec2 cut = vec_along(e[0], t, vec_sub(e[1], e[0]));
    out[0] = s[0] < 0 ? cut : e[0];
    out[1] = s[1] < 0 ? cut : e[1];
}

/* the ends of an edge lie on either side of a line, or on it */
static bool spans(const int64_t s[2]) {
    return (s[0] <= 0 && s[1] >= 0) || (s[0] >= 0 && s[1] <= 0);
}

/* where an edge with ends on two sides of another, or on it, meets that one */
static apart meeting(const int64_t s[2], const fw_geometry_vec2 e[2]) {
    const double t = (double)s[0] / ((double)s[0] - (double)s[1]);
    const fw_geometry_vec2 at = vec_along(e[0], t, vec_sub(e[1], e[0]));
    return (apart){0, {at, at}};
}

/* INFINITY: nothing of one is on the other one's side */
static apart across(const fw_mask_rule_written *p, const fw_mask_rule_written *q,
                    fw_mask_rule_kind kind) {
    int64_t sign = kind == FW_RULE_WIDTH ? 1 : -1;
    int64_t of_q[2] = {sign * side_of(p, q->a), sign * side_of(p, q->b)};
    if (of_q[0] <= 0 && of_q[1] <= 0) return (apart){.nm = HUGE_VAL};
    int64_t of_p[2] = {sign * side_of(q, p->a), sign * side_of(q, p->b)};
    if (of_p[0] <= 0 && of_p[1] <= 0) return (apart){.nm = HUGE_VAL};
    pair x = pair_of(p, q);
    if (of_q[0] >= 0 && of_q[1] >= 0 && of_p[0] >= 0 && of_p[1] >= 0) return least_of(x.p, x.q);
    if (spans(of_q) && spans(of_p)) return meeting(of_p, x.p);
    fw_geometry_vec2 part_p[2] = {x.p[0], x.p[1]}, part_q[2] = {x.q[0], x.q[1]};
    if (of_p[0] < 0 || of_p[1] < 0) cut_to(of_p, x.p, part_p);
    if (of_q[0] < 0 || of_q[1] < 0) cut_to(of_q, x.q, part_q);
    apart one = least_of(part_p, x.q), two = least_of(x.p, part_q);
    return one.nm >= two.nm ? one : two;
}

static void judge(fw_mask_rule_search *in, const fw_mask_rule_edge *p, const fw_mask_rule_edge *q,
                  const fw_mask_rule_written *a, const fw_mask_rule_written *b) {
    for (int kind = FW_RULE_WIDTH; kind <= FW_RULE_SPACE; kind++) {
        if (!(in->limit_m[kind] > 0)) continue;
        apart x = across(a, b, (fw_mask_rule_kind)kind);
        if (!fw_mask_rule_short(x.nm * FW_GEOMETRY_GRID_M, in->limit_m[kind])) continue;
        fw_geometry_vec2 from = place_of(a->a);
        fw_mask_rule_report(
            in, (fw_mask_rule_finding){.kind = (fw_mask_rule_kind)kind,
                                       .shape = {p->shape, q->shape},
                                       .segment = {p->segment, q->segment},
                                       .value_m = x.nm * FW_GEOMETRY_GRID_M,
                                       .slack_m = p->slack_m + q->slack_m,
                                       .at = {vec_along(from, FW_GEOMETRY_GRID_M, x.at[0]),
                                              vec_along(from, FW_GEOMETRY_GRID_M, x.at[1])},
                                       .edge = {p, q}});
    }
}

/* what of q is nearer to a box than the limit, from `first` on: numbers in q->near */
static int near_of(fw_mask_rule_edge *q, fw_geometry_box box, int first, double limit_m) {
    int n = 0;
    for (int j = first; j < q->nwritten; j++)
        if (!fw_box_apart(&box, &q->written[j].box, limit_m)) q->near[n++] = j;
    return n;
}

static bool ready(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q) {
    return fw_mask_rule_write(in, p) && fw_mask_rule_write(in, q) && p->nwritten > 0 &&
           q->nwritten > 0;
}

void fw_mask_rule_judge(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                        bool square) {
    if (!ready(in, p, q)) return;
    double limit_m = fw_greater(in->limit_m[FW_RULE_WIDTH], in->limit_m[FW_RULE_SPACE]);
    const fw_geometry_box *all = &q->written_box;
    int n = p == q ? 0 : near_of(q, p->written_box, 0, limit_m);
    for (int i = 0; i < p->nwritten; i++) {
        const fw_mask_rule_written *a = &p->written[i], *b;
        if (p == q) n = near_of(q, a->box, i + 1, limit_m);
        if (fw_box_apart(&a->box, all, limit_m)) continue;
        for (int k = 0; k < n; k++) {
            b = &q->written[q->near[k]];
            if (!fw_box_apart(&a->box, &b->box, limit_m) && facing(a, b, square))
                judge(in, p, q, a, b);
        }
    }
}

double fw_mask_rule_apart(fw_mask_rule_search *in, fw_mask_rule_edge *p, fw_mask_rule_edge *q,
                          double limit_m, fw_geometry_vec2 at[2]) {
    apart best = {.nm = HUGE_VAL};
    if (!ready(in, p, q)) return HUGE_VAL;
    int n = near_of(q, p->written_box, 0, limit_m);
    for (int i = 0; i < p->nwritten; i++)
        for (int k = 0; k < n; k++) {
            const fw_mask_rule_written *a = &p->written[i], *b = &q->written[q->near[k]];
            if (fw_box_apart(&a->box, &b->box, limit_m)) continue;
            pair x = pair_of(a, b);
            apart d = least_of(x.p, x.q);
            if (!(d.nm < best.nm)) continue;
            best.nm = d.nm;
            for (int j = 0; j < 2; j++)
                at[j] = vec_along(place_of(a->a), FW_GEOMETRY_GRID_M, d.at[j]);
        }
    return fw_mask_rule_short(best.nm * FW_GEOMETRY_GRID_M, limit_m) ? best.nm * FW_GEOMETRY_GRID_M
                                                                     : HUGE_VAL;
}
