/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/cut_tree.h"
#include <math.h>

enum { RUN = 8 }; /* edges of a leaf */

int64_t fw_mask_cut_cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

double fw_mask_cut_distance(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    double u = (double)c.x_dbu - a.x_dbu, w = (double)c.y_dbu - a.y_dbu;
    double t = fmin(1, fmax(0, (x * u + y * w) / (x * x + y * y)));
    double dx = u - t * x, dy = w - t * y;
    return sqrt(dx * dx + dy * dy);
}

static fw_mask_cut_box join(fw_mask_cut_box a, fw_mask_cut_box b) {
    return (fw_mask_cut_box){fmin(a.x0, b.x0), fmin(a.y0, b.y0), fmax(a.x1, b.x1),
                             fmax(a.y1, b.y1)};
}

fw_status fw_mask_cut_tree_new(fw_arena *arena, const fw_geometry_polygon *polygon,
                               fw_mask_cut_tree *tree) {
    int n = polygon->count, leaves = 1;
    while (leaves * RUN < n)
        leaves *= 2;
    *tree = (fw_mask_cut_tree){.polygon = polygon, .leaves = leaves};
    FW_NEED(tree->box = fw_arena_array(arena, fw_mask_cut_box, 2 * (size_t)leaves));
    for (int k = 0; k < leaves; k++) {
        fw_mask_cut_box *b = &tree->box[leaves + k];
        *b = (fw_mask_cut_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (int e = k * RUN; e <= (k + 1) * RUN && e <= n && k * RUN < n; e++) {
            fw_geometry_point v = polygon->vertex[e < n ? e : 0];
            *b = join(*b, (fw_mask_cut_box){v.x_dbu, v.y_dbu, v.x_dbu, v.y_dbu});
        }
    }
    for (int k = leaves - 1; k > 0; k--)
        tree->box[k] = join(tree->box[2 * k], tree->box[2 * k + 1]);
    return FW_OK;
}

typedef struct query {
    const fw_mask_cut_tree *tree;
    int i, j;
    fw_geometry_point a, b;
    fw_mask_cut_box box; /* of the segment */
    double x, y, length; /* its direction, not normed */
    double least, now;   /* what need not be undercut; what was found so far */
} query;

/* no more than the distance between the segment and a box: that of their boxes along an axis, and
   that of the box from the line */
static double at_least(const query *q, fw_mask_cut_box b) {
    double gap_x = fmax(b.x0 - q->box.x1, q->box.x0 - b.x1);
    double gap_y = fmax(b.y0 - q->box.y1, q->box.y0 - b.y1);
    double cx = 0.5 * (b.x0 + b.x1) - q->a.x_dbu, cy = 0.5 * (b.y0 + b.y1) - q->a.y_dbu;
    double reach = 0.5 * ((b.x1 - b.x0) * fabs(q->y) + (b.y1 - b.y0) * fabs(q->x));
    double beside = (fabs(q->x * cy - q->y * cx) - reach) / q->length;
    return fmax(beside, fmax(gap_x, gap_y));
}

static bool between(fw_geometry_point a, fw_geometry_point b,
                    fw_geometry_point c) { /* c on the line through a and b */
    int64_t dot = ((int64_t)c.x_dbu - a.x_dbu) * ((int64_t)c.x_dbu - b.x_dbu);
    int64_t more = ((int64_t)c.y_dbu - a.y_dbu) * ((int64_t)c.y_dbu - b.y_dbu);
    return dot <= 0 && more <= 0;
}

static bool meet(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c,
                 fw_geometry_point d) {
    int64_t abc = fw_mask_cut_cross(a, b, c), abd = fw_mask_cut_cross(a, b, d);
    if ((abc > 0 && abd > 0) || (abc < 0 && abd < 0)) return false;
    int64_t cda = fw_mask_cut_cross(c, d, a), cdb = fw_mask_cut_cross(c, d, b);
    if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc && abd && cda && cdb)
        return true;
    return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) ||
           (cda == 0 && between(c, d, a)) || (cdb == 0 && between(c, d, b));
}

static void leaf(query *q, int run) {
    const fw_geometry_polygon *p = q->tree->polygon;
    for (int k = run * RUN; k < (run + 1) * RUN && k < p->count; k++) {
        int next = k + 1 < p->count ? k + 1 : 0;
        bool own = k == q->i || k == q->j, next_own = next == q->i || next == q->j;
        if (!own) q->now = fmin(q->now, fw_mask_cut_distance(q->a, q->b, p->vertex[k]));
        if (!own && !next_own && meet(q->a, q->b, p->vertex[k], p->vertex[next])) q->now = -1;
        if (q->now <= q->least) return;
    }
}

static void visit(query *q, int node) {
    if (at_least(q, q->tree->box[node]) > q->now) return;
    if (node >= q->tree->leaves) {
        leaf(q, node - q->tree->leaves);
        return;
    }
    for (int side = 0; side < 2 && q->now > q->least; side++)
        visit(q, 2 * node + side);
}

/* Search down a tree of boxes (Guttman 1984, "R-trees", here over runs of a chain). In: a polygon
   and two of its vertices (dbu). Out: the distance (dbu). Error: whether edges meet is exact;
   distances have some ulp of the coordinates. Cost: about ln n boxes where little is near. Test:
   test_polygon_cut.c, against all vertices. */
double fw_mask_cut_clearance(const fw_mask_cut_tree *tree, int i, int j, double least,
                             double most) {
    fw_geometry_point a = tree->polygon->vertex[i], b = tree->polygon->vertex[j];
    query q = {.tree = tree,
               .i = i,
               .j = j,
               .a = a,
               .b = b,
               .box = join((fw_mask_cut_box){a.x_dbu, a.y_dbu, a.x_dbu, a.y_dbu},
                           (fw_mask_cut_box){b.x_dbu, b.y_dbu, b.x_dbu, b.y_dbu}),
               .x = (double)b.x_dbu - a.x_dbu,
               .y = (double)b.y_dbu - a.y_dbu,
               .least = least,
               .now = most};
    q.length = hypot(q.x, q.y);
    if (q.length > 0) visit(&q, 1);
    return q.now;
}
