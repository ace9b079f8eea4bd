/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outlines in the frame of a cut, clipped to the block behind it; and, in a flow with several plates, where a film lies in
   the plane: over its columns, what every plate leaves of each.

   region(f) = OR over columns k of f of (block AND over plates p of inside or outside of p in k, moved to the wall of f)

   on a grid of 1 nm (geometry/merge.h), because pieces overlap and touch. In: the mask, a film, where between its foot and
   its head. Out: simple rings, counter-clockwise; edges on the block's sides and where one ring is cut from the next are
   open. Error: 1 nm, and the tolerance of arcs. Cost: one merge for each plate, column and union, kept for all steps. Test:
   test_profile.c. */
#include "geometry/merge.h"
#include "geometry/segment.h"
#include "recipe/recipe_profile.h"
#include <math.h>
#include <string.h>

static fw_recipe_spot local(const fw_recipe_cut *cut, fw_geometry_vec2 p, bool open) {
    fw_geometry_vec2 d = vec_sub(p, cut->line.at);
    return (fw_recipe_spot){vec_dot(d, cut->line.along), vec_cross(cut->line.along, d), open};
}

/* chords of an arc with a sagitta of at most the tolerance: |sweep|/(2 acos(1 - tolerance/r)) */
static int chords(const fw_geometry_segment *s, double tolerance_m) {
    if (s->kind == FW_LINE) return 1;
    double step = tolerance_m < s->radius ? 2.0 * acos(1.0 - tolerance_m / s->radius) : 1.5;
    return (int)ceil(fabs(s->sweep_rad) / step - 1e-9);
}

static fw_status flatten(fw_arena *arena, const fw_recipe_cut *cut, const fw_geometry_contour *c,
                         double tolerance_m, fw_recipe_ring *out) {
    size_t n = 0;
    for (int i = 0; i < c->count; i++)
        n += (size_t)chords(&c->segment[i], tolerance_m);
    *out = (fw_recipe_ring){.corner = fw_arena_array(arena, fw_recipe_spot, n)};
    FW_NEED(out->corner);
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        int parts = chords(s, tolerance_m);
        for (int k = 1; k <= parts; k++)
            out->corner[out->n++] = local(cut, fw_geometry_segment_point(s, (double)k / parts),
                                          (s->flags & FW_SEGMENT_JOINT) != 0);
    }
    return FW_OK;
}

/* distance inside one of the block's four sides */
static double inside(const fw_recipe_cut *cut, int side, fw_recipe_spot p) {
    const double d[] = {p.x, cut->length_m - p.x, p.y, cut->depth_m - p.y};
    return d[side];
}

/* One ring against one side (Sutherland and Hodgman, Comm. ACM 17 (1974) 32): edges that run along
   the side are marked open. */
static fw_status clip_side(fw_arena *arena, const fw_recipe_cut *cut, int side,
                           fw_recipe_ring *ring) {
    fw_recipe_ring out = {.corner = fw_arena_array(arena, fw_recipe_spot, 2 * (size_t)ring->n)};
    FW_NEED(out.corner);
    for (int i = 0; i < ring->n; i++) {
        fw_recipe_spot a = ring->corner[i > 0 ? i - 1 : ring->n - 1], b = ring->corner[i];
        double da = inside(cut, side, a), db = inside(cut, side, b);
        bool in_a = da >= 0.0, in_b = db >= 0.0;
        if (in_a != in_b) {
            double t = da / (da - db);
            fw_recipe_spot at = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                                 in_a ? b.open : true};
            out.corner[out.n++] = at;
        }
        if (in_b) out.corner[out.n++] = b;
    }
    *ring = out;
    return FW_OK;
}

fw_status fw_recipe_ring_of(fw_arena *arena, const fw_recipe_cut *cut,
                            const fw_geometry_contour *contour, double tolerance_m,
                            fw_recipe_ring *ring) {
    FW_TRY(flatten(arena, cut, contour, tolerance_m, ring));
    for (int side = 0; side < 4 && ring->n > 0; side++)
        FW_TRY(clip_side(arena, cut, side, ring));
    return FW_OK;
}

/* ---- regions ---- */

enum { MOST_VERTICES = 1 << 20 };
static const double DBU_M = 1e-9;

typedef struct polygons {
    fw_geometry_polygon *item; /* (n) */
    int n;
} polygons;

struct fw_recipe_region { /* what was asked for before */
    bool in[FW_STACK_MOST];
    double edge_m[FW_PROCESS_PLATES + 1];
    fw_recipe_rings rings;
    struct fw_recipe_region *next;
};

static fw_status on_grid(fw_arena *arena, const fw_recipe_ring *r, fw_geometry_polygon *out) {
    *out = (fw_geometry_polygon){.vertex = fw_arena_array(arena, fw_geometry_point, (size_t)r->n)};
    FW_NEED(out->vertex);
    for (int i = 0; i < r->n; i++) {
        fw_geometry_point p = {(int32_t)lround(r->corner[i].x / DBU_M),
                               (int32_t)lround(r->corner[i].y / DBU_M)};
        const fw_geometry_point *last = out->count ? &out->vertex[out->count - 1] : NULL;
        if (!last || last->x_dbu != p.x_dbu || last->y_dbu != p.y_dbu)
            out->vertex[out->count++] = p;
    }
    return FW_OK;
}

static fw_status merged(fw_arena *arena, const polygons *set, int nset,
                        const fw_geometry_merge_term *term, polygons *out) {
    size_t n = 0;
    int at = 0;
    for (int i = 0; i < nset; i++)
        n += (size_t)set[i].n;
    fw_geometry_merge_input *input = fw_arena_array(arena, fw_geometry_merge_input, n + 1);
    fw_geometry_merged result;
    FW_NEED(input);
    for (int i = 0; i < nset; i++)
        for (int k = 0; k < set[i].n; k++)
            input[at++] = (fw_geometry_merge_input){&set[i].item[k], i};
    FW_TRY(fw_geometry_merge(arena, input, at, term, nset, MOST_VERTICES, &result));
    *out = (polygons){result.polygon, result.n};
    return FW_OK;
}

/* what a plate draws with its edges at edge_m, within the block */
static fw_status of_plate(fw_recipe_slicer *slicer, double edge_m, double tolerance_m,
                          polygons *out) {
    fw_arena *arena = slicer->arena;
    const fw_recipe_outline_at *at;
    polygons set[FW_MERGE_SETS] = {{0}};
    fw_geometry_merge_term term[FW_MERGE_SETS];
    if (slicer->nterm > FW_MERGE_SETS) return FW_LIMIT;
    FW_TRY(fw_recipe_slicer_at(slicer, edge_m, &at));
    for (int t = 0; t < slicer->nterm; t++) {
        term[t] = (fw_geometry_merge_term){t, slicer->term[t].rule};
        FW_NEED(set[t].item =
                    fw_arena_array(arena, fw_geometry_polygon, (size_t)slicer->nshape + 1));
        for (int k = 0; k < slicer->nshape; k++) {
            fw_recipe_ring ring;
            if (slicer->term_of[k] != t || at->contour[k].count == 0) continue;
            FW_TRY(fw_recipe_ring_of(arena, slicer->cut, &at->contour[k], tolerance_m, &ring));
            if (ring.n < 3) continue;
            FW_TRY(on_grid(arena, &ring, &set[t].item[set[t].n]));
            if (set[t].item[set[t].n].count >= 3) set[t].n++;
        }
    }
    return merged(arena, set, slicer->nterm, term, out);
}

static fw_status whole_block(fw_arena *arena, const fw_recipe_cut *cut, polygons *out) {
    fw_recipe_spot corner[] = {{0.0, 0.0, true},
                               {cut->length_m, 0.0, true},
                               {cut->length_m, cut->depth_m, true},
                               {0.0, cut->depth_m, true}};
    *out = (polygons){fw_arena_array(arena, fw_geometry_polygon, 1), 1};
    FW_NEED(out->item);
    return on_grid(arena, &(fw_recipe_ring){corner, 4}, out->item);
}

/* does an edge lie on a side of the block, or does another ring run back along it? */
static bool is_open(const fw_recipe_cut *cut, const polygons *all, fw_geometry_point a,
                    fw_geometry_point b) {
    int32_t right = (int32_t)lround(cut->length_m / DBU_M),
            far = (int32_t)lround(cut->depth_m / DBU_M);
    if (a.x_dbu == b.x_dbu && (a.x_dbu == 0 || a.x_dbu == right)) return true;
    if (a.y_dbu == b.y_dbu && (a.y_dbu == 0 || a.y_dbu == far)) return true;
    for (int i = 0; i < all->n; i++)
        for (int k = 0; k < all->item[i].count; k++) {
            fw_geometry_point p = all->item[i].vertex[k],
                              q = all->item[i].vertex[(k + 1) % all->item[i].count];
            if (p.x_dbu == b.x_dbu && p.y_dbu == b.y_dbu && q.x_dbu == a.x_dbu &&
                q.y_dbu == a.y_dbu)
                return true;
        }
    return false;
}

static fw_status rings_of(fw_arena *arena, const fw_recipe_cut *cut, const polygons *all,
                          fw_recipe_rings *rings) {
    *rings = (fw_recipe_rings){fw_arena_array(arena, fw_recipe_ring, (size_t)all->n + 1), all->n};
    FW_NEED(rings->ring);
    for (int i = 0; i < all->n; i++) {
        const fw_geometry_polygon *p = &all->item[i];
        fw_recipe_ring *r = &rings->ring[i];
        *r = (fw_recipe_ring){fw_arena_array(arena, fw_recipe_spot, (size_t)p->count), p->count};
        FW_NEED(r->corner);
        for (int k = 0; k < p->count; k++)
            r->corner[k] = (fw_recipe_spot){
                p->vertex[k].x_dbu * DBU_M, p->vertex[k].y_dbu * DBU_M,
                is_open(cut, all, p->vertex[k > 0 ? k - 1 : p->count - 1], p->vertex[k])};
    }
    return FW_OK;
}

/* one column: of the block what lies on its side of every plate */
static fw_status of_column(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                           const polygons *plate, int column, polygons *out) {
    polygons set[FW_PROCESS_PLATES + 2];
    fw_geometry_merge_term term[FW_PROCESS_PLATES + 2] = {{0, FW_SET_OR}};
    FW_TRY(whole_block(slicer->arena, slicer->cut, &set[0]));
    for (int p = 0; p <= flow->nplate; p++) {
        bool set_side = fw_process_side_holds(flow, (fw_process_side){p, true}, column);
        bool inside = p == 0 ? !set_side : set_side;
        set[p + 1] = plate[p];
        term[p + 1] = (fw_geometry_merge_term){p + 1, inside ? FW_SET_AND : FW_SET_NOT};
    }
    return merged(slicer->arena, set, flow->nplate + 2, term, out);
}

static fw_status solve(fw_recipe_slicer *slicer, const fw_process_flow *flow, double tolerance_m,
                       struct fw_recipe_region *r) {
    polygons plate[FW_PROCESS_PLATES + 1], column[FW_STACK_MOST], all;
    fw_geometry_merge_term term[FW_STACK_MOST];
    int n = 0;
    for (int p = 0; p <= flow->nplate; p++) {
        fw_recipe_slicer *of;
        FW_TRY(fw_recipe_slicer_of_plate(slicer, flow, p, &of));
        FW_TRY(of_plate(of, r->edge_m[p], tolerance_m, &plate[p]));
    }
    for (int k = 0; k < fw_process_flow_columns(flow); k++) {
        if (!r->in[k]) continue;
        FW_TRY(of_column(slicer, flow, plate, k, &column[n]));
        term[n] = (fw_geometry_merge_term){n, FW_SET_OR};
        n++;
    }
    FW_TRY(merged(slicer->arena, column, n, term, &all));
    return rings_of(slicer->arena, slicer->cut, &all, &r->rings);
}

fw_status fw_recipe_region_of(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                              const fw_process_film *film, double part, double tolerance_m,
                              fw_recipe_rings *rings) {
    struct fw_recipe_region asked = {.next = slicer->region}, *r;
    memcpy(asked.in, film->in, sizeof asked.in);
    for (int p = 0; p <= flow->nplate; p++) {
        double foot = p ? film->further[p - 1].foot_m : film->foot_m,
               head = p ? film->further[p - 1].head_m : film->head_m;
        asked.edge_m[p] = foot + part * (head - foot);
    }
    for (r = slicer->region; r; r = r->next)
        if (memcmp(r->in, asked.in, sizeof r->in) == 0) {
            bool same = true;
            for (int p = 0; p <= flow->nplate; p++)
                same = same && fabs(r->edge_m[p] - asked.edge_m[p]) <= 1e-12;
            if (same) break;
        }
    if (!r) {
        FW_NEED(r = fw_arena_one(slicer->arena, struct fw_recipe_region));
        *r = asked;
        FW_TRY(solve(slicer, flow, tolerance_m, r));
        slicer->region = r;
    }
    *rings = r->rings;
    return FW_OK;
}
