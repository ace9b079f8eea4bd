/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The union of pieces that share joints is bounded by their other segments, with the material on
   the left. So width and space of the union need no boolean: every two boundary edges are looked
   at, and the side on which the chord leaves tells material from empty space. */
#include "geometry/segment.h"
#include "mask/rules.h"
#include <stdlib.h>

static const double GRID_M = 1e-9;
static const double ROUND_M = 0.70710678118654752e-9; /* a vertex moves by at most g/sqrt2 */
static const double PART_RAD = FW_PI / 24;            /* arcs are looked at in parts of 7.5 deg */
static const double FACING = -1e-6;                   /* normals more than 90 deg apart */
static const double NEAR_CORNER_M = 1e-7;             /* contacts there are the corner itself */
static const fw_place nowhere;

typedef struct edge {
    fw_segment s;
    fw_box box;
    int shape, segment;
    bool corner_a, corner_b; /* the outline turns there; false between the parts of an arc */
    double slack_m;          /* what flattening may take away on this side */
} edge;

typedef enum kind { WIDTH, SPACE, OVERLAP } kind;

typedef struct finding { /* worst place of one pair of shapes */
    kind kind;
    int shape[2], segment[2];
    double value_m, needed_m;
    fw_vec2 at;
} finding;

enum { MOST_FINDINGS = 64 };

typedef struct search {
    const fw_mask_layer *layer;
    const fw_mask_shape *shape;
    const edge *edge;
    int nedge;
    fw_mask_measure *measure;
    finding found[MOST_FINDINGS];
    int nfound;
} search;

/* ---- edges of one layer ---- */
static bool on_grid(double x) {
    double n = x / GRID_M;
    return fabs(n - nearbyint(n)) < 1e-5;
}

static double slack_of(const fw_segment *s, double tolerance_m) {
    bool exact = on_grid(s->a.x) && on_grid(s->a.y) && on_grid(s->b.x) && on_grid(s->b.y);
    return s->kind == FW_ARC ? tolerance_m + ROUND_M : exact ? 0 : ROUND_M;
}

static int parts_of(const fw_segment *s) {
    if (s->flags & FW_SEGMENT_JOINT) return 0;
    return s->kind == FW_ARC ? (int)ceil(fabs(s->sweep_rad) / PART_RAD) : 1;
}

static int by_left(const void *left, const void *right) {
    const edge *p = left, *q = right;
    if (p->box.x0 != q->box.x0) return p->box.x0 < q->box.x0 ? -1 : 1;
    if (p->shape != q->shape) return p->shape < q->shape ? -1 : 1;
    if (p->segment != q->segment) return p->segment < q->segment ? -1 : 1;
    return p->box.y0 < q->box.y0 ? -1 : p->box.y0 > q->box.y0;
}

/* corners of the union: across a joint the outline goes on in the other piece */
static void mark_corners(edge *list, int n) {
    for (int i = 0; i < n; i++)
        list[i].corner_a = list[i].corner_b = true;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            if (!vec_same(list[i].s.b, list[j].s.a)) continue;
            fw_vec2 u = fw_segment_tangent(&list[i].s, 1), v = fw_segment_tangent(&list[j].s, 0);
            if (vec_dot(u, v) > 0 && fabs(vec_cross(u, v)) < FW_SMOOTH_RAD)
                list[i].corner_b = list[j].corner_a = false;
        }
}

static fw_status list_edges(fw_arena *arena, const fw_mask_shape *shape, int nshape, int layer,
                            double tolerance_m, edge **out, int *count) {
    size_t n = 0;
    for (int k = 0; k < nshape; k++)
        for (int i = 0; shape[k].layer == layer && i < shape[k].contour.count; i++)
            n += (size_t)parts_of(&shape[k].contour.segment[i]);
    edge *list = fw_arena_array(arena, edge, n);
    FW_NEED(list);
    *count = 0;
    for (int k = 0; k < nshape; k++)
        for (int i = 0; shape[k].layer == layer && i < shape[k].contour.count; i++) {
            const fw_segment *s = &shape[k].contour.segment[i];
            int parts = parts_of(s);
            for (int m = 0; m < parts; m++) {
                double t0 = (double)m / parts, t1 = (double)(m + 1) / parts;
                edge *e = &list[(*count)++];
                e->s = fw_segment_cut(s, t0, fw_segment_point(s, t0), t1, fw_segment_point(s, t1));
                e->box = fw_segment_box(&e->s);
                e->shape = k;
                e->segment = i;
                e->slack_m = slack_of(s, tolerance_m);
            }
        }
    qsort(list, (size_t)*count, sizeof *list, by_left);
    mark_corners(list, *count);
    *out = list;
    return FW_OK;
}

/* ---- one pair ---- */
static void report(search *in, finding f) {
    if (f.shape[0] > f.shape[1] || (f.shape[0] == f.shape[1] && f.segment[0] > f.segment[1])) {
        int shape = f.shape[0], segment = f.segment[0];
        f.shape[0] = f.shape[1];
        f.segment[0] = f.segment[1];
        f.shape[1] = shape;
        f.segment[1] = segment;
    }
    for (int i = 0; i < in->nfound; i++) {
        finding *old = &in->found[i];
        if (old->kind != f.kind || old->shape[0] != f.shape[0] || old->shape[1] != f.shape[1])
            continue;
        if (f.value_m < old->value_m) *old = f;
        return;
    }
    if (in->nfound < MOST_FINDINGS) in->found[in->nfound++] = f;
}

/* a chord measures a width or a space when it stands square on the edge or ends at a corner */
static bool counts(const edge *e, double t, fw_vec2 unit_chord) {
    if ((t <= 0 && e->corner_a) || (t >= 1 && e->corner_b)) return true;
    return fabs(vec_dot(fw_segment_tangent(&e->s, t), unit_chord)) < 1e-5;
}

static void measured(search *in, kind what, double length, const fw_chord *chord) {
    double *least = what == WIDTH ? &in->measure->width_m : &in->measure->space_m;
    fw_vec2 *at = what == WIDTH ? in->measure->width_at : in->measure->space_at;
    if (length >= *least) return;
    *least = length;
    at[0] = chord->at_p;
    at[1] = chord->at_q;
}

static void judged(search *in, kind what, const edge *p, const edge *q, double length, fw_vec2 at) {
    double rule = what == WIDTH ? in->layer->min_width_m : in->layer->min_space_m;
    double needed = rule + p->slack_m + q->slack_m;
    if (rule > 0 && length < needed - FW_COINCIDENT_M)
        report(in,
               (finding){what, {p->shape, q->shape}, {p->segment, q->segment}, length, needed, at});
}

static fw_vec2 outward(const fw_segment *s, double t) {
    fw_vec2 tangent = fw_segment_tangent(s, t);
    return (fw_vec2){tangent.y, -tangent.x};
}

/* p ends where q begins: a corner of the union. Sharper than 90 degrees it is a width or a space
   that goes to nothing. */
static void look_at_corner(search *in, const edge *p, const edge *q) {
    fw_vec2 before = fw_segment_tangent(&p->s, 1), after = fw_segment_tangent(&q->s, 0);
    if (vec_dot(before, after) < FACING)
        judged(in, vec_cross(before, after) > 0 ? WIDTH : SPACE, p, q, 0, p->s.b);
}

static void look_at_contacts(search *in, const edge *p, const edge *q) {
    bool p_then_q = vec_same(p->s.b, q->s.a), q_then_p = vec_same(q->s.b, p->s.a);
    if (p_then_q) look_at_corner(in, p, q);
    if (q_then_p) look_at_corner(in, q, p);
    fw_hit hit[FW_MOST_HITS];
    int n = fw_segment_intersect(&p->s, &q->s, hit);
    for (int i = 0; i < n; i++) {
        bool corner = (p_then_q && vec_distance(hit[i].at, p->s.b) < NEAR_CORNER_M) ||
                      (q_then_p && vec_distance(hit[i].at, q->s.b) < NEAR_CORNER_M);
        if (!corner)
            report(in,
                   (finding){
                       OVERLAP, {p->shape, q->shape}, {p->segment, q->segment}, 0, 0, hit[i].at});
    }
}

/* Shortest chord between edges that face each other: outward normals n_p . n_q < 0 at its ends, the
   chord leaving through material (width) or through empty space (space) at both.
   The rule judges every such chord; the measure takes those square on edges or ending at corners.
   In: two edges, m. Error: a few ulp of the coordinates; parts of arcs turn by at most 7.5 deg, so
   the 90 deg limit of the rule is met to that angle. Cost O(1). Source: Euclidian width and space
   with a 90 deg limit, as KLayout has it. Test: test_mask_rules.c. */
static void look_at_pair(search *in, const edge *p, const edge *q) {
    if (fw_box_gap(p->box, q->box) <= FW_COINCIDENT_M) look_at_contacts(in, p, q);
    fw_chord chord[FW_MOST_CHORDS];
    int n = fw_segment_chords(&p->s, &q->s, chord);
    for (int i = 0; i < n; i++) {
        fw_vec2 c = vec_sub(chord[i].at_q, chord[i].at_p);
        double length = vec_length(c);
        if (length <= FW_COINCIDENT_M) continue;
        fw_vec2 np = outward(&p->s, chord[i].tp), nq = outward(&q->s, chord[i].tq);
        if (!(vec_dot(np, nq) < FACING)) continue;
        double leaves = vec_dot(c, np) / length, arrives = -vec_dot(c, nq) / length;
        if (!(leaves > 1e-9 && arrives > 1e-9) && !(leaves < -1e-9 && arrives < -1e-9)) continue;
        kind what = leaves > 0 ? SPACE : WIDTH;
        fw_vec2 unit = vec_scale(1 / length, c);
        if (counts(p, chord[i].tp, unit) && counts(q, chord[i].tq, unit))
            measured(in, what, length, &chord[i]);
        judged(in, what, p, q, length, vec_along(chord[i].at_p, 0.5, c));
    }
}

/* how far edges can be apart and still change a result */
static double reach(const search *in) {
    double rule = fmax(in->layer->min_width_m, in->layer->min_space_m) + 2e-7;
    double open = fmax(fmin(in->measure->width_m, FW_MASK_LOOK_M),
                       fmin(in->measure->space_m, FW_MASK_LOOK_M));
    return fmax(rule, open);
}

static void look_at_edges(search *in) {
    for (int i = 0; i < in->nedge; i++) {
        const edge *p = &in->edge[i];
        for (int j = i + 1; j < in->nedge; j++) {
            const edge *q = &in->edge[j];
            double far = reach(in);
            if (q->box.x0 - p->box.x1 > far) break;
            if (fw_box_gap(p->box, q->box) <= far) look_at_pair(in, p, q);
        }
    }
}

/* ---- pieces inside each other: no edges meet then ---- */
static bool box_inside(fw_box in, fw_box out) {
    return in.x0 >= out.x0 && in.x1 <= out.x1 && in.y0 >= out.y0 && in.y1 <= out.y1;
}

static void look_at_nesting(search *in, int nshape, int layer) {
    for (int i = 0; i < nshape; i++) {
        if (in->shape[i].layer != layer) continue;
        const fw_contour *c = &in->shape[i].contour;
        fw_box box = fw_contour_box(c);
        int k = 0;
        while (k < c->count - 1 && c->segment[k].flags & FW_SEGMENT_JOINT)
            k++;
        fw_vec2 at = fw_segment_point(&c->segment[k], 0.5);
        for (int j = 0; j < nshape; j++) {
            const fw_contour *d = &in->shape[j].contour;
            if (i != j && in->shape[j].layer == layer && box_inside(box, fw_contour_box(d)) &&
                fw_contour_contains(d, at))
                report(in, (finding){OVERLAP, {i, j}, {k, 0}, 0, 0, at});
        }
    }
}

/* ---- messages ---- */
static void tell(const search *in, const finding *f, fw_diags *diags) {
    const fw_mask_shape *p = &in->shape[f->shape[0]], *q = &in->shape[f->shape[1]];
    const char *name_p = p->piece->label, *name_q = q->piece->label;
    char at[80], value[32], needed[32], rule[32];
    fw_mask_place_text(at, sizeof at, f->at);
    fw_number_text(value, sizeof value, f->value_m * 1e6, 6);
    fw_number_text(needed, sizeof needed, f->needed_m * 1e6, 6);
    double limit = f->kind == WIDTH ? in->layer->min_width_m : in->layer->min_space_m;
    fw_number_text(rule, sizeof rule, limit * 1e6, 6);
    const char *source = in->layer->rule_source ? in->layer->rule_source : "layer table";
    if (f->kind == OVERLAP)
        fw_diag_error(diags, 152, nowhere,
                      "%s (edge %d) and %s (edge %d) meet at %s on layer %s without a shared "
                      "joint; move them apart or join them",
                      name_p, f->segment[0], name_q, f->segment[1], at, in->layer->name);
    else
        fw_diag_error(
            diags, f->kind == WIDTH ? 144 : 145, nowhere,
            "%s (edge %d) and %s (edge %d): %s of %s um at %s; layer %s needs %s um "
            "(rule %s um and what the 1 nm grid takes; %s); %s, or choose a smaller bias",
            name_p, f->segment[0], name_q, f->segment[1], f->kind == WIDTH ? "width" : "space",
            value, at, in->layer->name, needed, rule, source,
            f->kind == WIDTH ? "make the part wider there" : "move the edges apart there");
}

static int in_order(const void *left, const void *right) {
    const finding *p = left, *q = right;
    if (p->shape[0] != q->shape[0]) return p->shape[0] - q->shape[0];
    if (p->shape[1] != q->shape[1]) return p->shape[1] - q->shape[1];
    return (int)p->kind - (int)q->kind;
}

static double perimeter_of(const edge *e, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fw_segment_length(&e[i].s);
    return sum;
}

fw_status fw_mask_check_rules(fw_arena *arena, const fw_mask_table *table,
                              const fw_mask_shape *shape, int nshape, double tolerance_m,
                              fw_mask_measure *measure, fw_diags *diags) {
    size_t errors = diags->errors;
    for (int k = 0; k < table->nlayer; k++) {
        edge *list;
        int n;
        FW_TRY(list_edges(arena, shape, nshape, k, tolerance_m, &list, &n));
        fw_mask_measure *m = &measure[k];
        m->width_m = m->space_m = HUGE_VAL;
        m->perimeter_m = perimeter_of(list, n);
        search in = {
            .layer = &table->layer[k], .shape = shape, .edge = list, .nedge = n, .measure = m};
        look_at_edges(&in);
        look_at_nesting(&in, nshape, k);
        if (m->width_m > FW_MASK_LOOK_M) m->width_m = HUGE_VAL;
        if (m->space_m > FW_MASK_LOOK_M) m->space_m = HUGE_VAL;
        qsort(in.found, (size_t)in.nfound, sizeof in.found[0], in_order);
        for (int i = 0; i < in.nfound; i++)
            tell(&in, &in.found[i], diags);
    }
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}
