/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/recipe_profile.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

static const double SAME_EDGE_M = 1e-15; /* two walls of one cache entry */

/* ---- the plate near the cut ---- */

static fw_geometry_box window_box(const fw_recipe_cut *cut) {
    fw_geometry_vec2 a = cut->line.at, b = vec_along(a, cut->length_m, cut->line.along);
    return (fw_geometry_box){fmin(a.x, b.x), fmin(a.y, b.y), fmax(a.x, b.x), fmax(a.y, b.y)};
}

/* does the whole line meet the box? */
static bool line_meets(fw_geometry_cut_line line, fw_geometry_box box) {
    fw_geometry_vec2 corner[4] = {
        {box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < 4; i++) {
        double across = vec_cross(line.along, vec_sub(corner[i], line.at));
        low = fmin(low, across);
        high = fmax(high, across);
    }
    return low <= FW_COINCIDENT_M && high >= -FW_COINCIDENT_M;
}

static fw_status start_plate(fw_arena *arena, const fw_mask *mask, int plate,
                             const fw_recipe_cut *cut, fw_recipe_slicer *slicer) {
    fw_mask_plate_term *term;
    *slicer = (fw_recipe_slicer){.arena = arena, .mask = mask, .cut = cut, .bias_m = mask->bias_m};
    FW_TRY(fw_mask_plate_terms_of(arena, mask->table, plate, &term, &slicer->nterm));
    slicer->term = term;
    if (plate != mask->table->device_plate && slicer->nterm > 0)
        slicer->bias_m = fw_mask_layer_bias_m(mask, term[0].layer);
    size_t most = (size_t)mask->nshape * (size_t)slicer->nterm;
    FW_NEED(slicer->shape = fw_arena_array(arena, const fw_mask_shape *, most));
    FW_NEED(slicer->term_of = fw_arena_array(arena, int, most));
    fw_geometry_box window = window_box(cut);
    double near = fmax(FW_NEAR_M, cut->depth_m); /* what stands behind the cut is shown, too */
    for (int t = 0; t < slicer->nterm; t++)
        for (int i = 0; i < mask->nshape; i++) {
            const fw_mask_shape *s = &mask->shape[i];
            if (s->layer != term[t].layer) continue;
            fw_geometry_box box = fw_geometry_contour_box(&s->contour);
            if (fw_box_gap(box, window) > near && !line_meets(cut->line, box)) continue;
            slicer->term_of[slicer->nshape] = t;
            slicer->shape[slicer->nshape++] = s;
        }
    return FW_OK;
}

fw_status fw_recipe_slicer_start(fw_arena *arena, const fw_mask *mask, const fw_recipe_cut *cut,
                                 fw_recipe_slicer *slicer) {
    return start_plate(arena, mask, mask->table->device_plate, cut, slicer);
}

/* A biased shape stands `edge_m` outside what was drawn; what is taken out of it (lettering) stands
   as far inside its own outline as the structure moved from the plate. A shape that cannot be moved
   so far is gone; a hole that cannot stays as it is. */
static fw_status moved(const fw_recipe_slicer *slicer, int k, double edge_m,
                       fw_geometry_contour *out) {
    const fw_mask *mask = slicer->mask;
    const fw_mask_shape *s = slicer->shape[k];
    double own_m = fw_mask_layer_bias_m(mask, s->layer);
    bool biased = mask->table->layer[s->layer].biased;
    bool hole = slicer->term[slicer->term_of[k]].rule == FW_SET_NOT;
    double d = hole ? slicer->bias_m - edge_m : edge_m - slicer->bias_m;
    int i, j;
    *out = s->contour;
    if (biased && edge_m == 0.0 && !hole) *out = s->piece->contour;
    if (d == 0.0 || (biased && edge_m == 0.0 && !hole)) return FW_OK;
    if (own_m != 0.0 && !biased && fabs(own_m + d) < 1e-15) { /* back to what is drawn */
        *out = s->piece->contour;
        return FW_OK;
    }
    fw_status status = fw_geometry_contour_offset(slicer->arena, &s->contour, d, out, &i, &j);
    if (status != FW_GEOMETRY) return status;
    *out = hole ? s->contour : (fw_geometry_contour){0};
    return FW_OK;
}

/* what lies between the intervals, ends at infinity */
static fw_status between(fw_arena *arena, fw_geometry_slices in, fw_geometry_slices *out) {
    *out = (fw_geometry_slices){.item = fw_arena_array(arena, fw_geometry_slice, (size_t)in.n + 1)};
    FW_NEED(out->item);
    fw_geometry_slice gap = {-(double)INFINITY, 0.0, 1.0, 1.0};
    for (int i = 0; i <= in.n; i++) {
        gap.to_m = i < in.n ? in.item[i].from_m : (double)INFINITY;
        gap.to_sine = i < in.n ? in.item[i].from_sine : 1.0;
        out->item[out->n++] = gap;
        if (i < in.n) gap = (fw_geometry_slice){in.item[i].to_m, 0.0, in.item[i].to_sine, 1.0};
    }
    return FW_OK;
}

static fw_status slice(fw_recipe_slicer *slicer, fw_recipe_outline_at *at) {
    fw_arena *arena = slicer->arena;
    fw_geometry_slices all = {0};
    for (int t = 0; t < slicer->nterm; t++) {
        fw_geometry_slices own = {0}, one;
        for (int k = 0; k < slicer->nshape; k++) {
            if (slicer->term_of[k] != t || at->contour[k].count == 0) continue;
            FW_TRY(fw_geometry_contour_slice(arena, &at->contour[k], slicer->cut->line, &one));
            if (one.n) FW_TRY(fw_geometry_slices_combine(arena, own, one, FW_SET_OR, &own));
        }
        FW_TRY(fw_geometry_slices_combine(arena, all, own, slicer->term[t].rule, &all));
    }
    at->inside = all;
    FW_TRY(between(arena, all, &at->gap));
    FW_NEED(at->width_m = fw_arena_array(arena, double, (size_t)at->gap.n));
    for (int g = 0; g < at->gap.n; g++)
        at->width_m[g] = (double)NAN;
    return FW_OK;
}

fw_status fw_recipe_slicer_at(fw_recipe_slicer *slicer, double edge_m,
                              const fw_recipe_outline_at **out) {
    for (int i = 0; i < slicer->nat; i++)
        if (fabs(slicer->at[i].edge_m - edge_m) <= SAME_EDGE_M) {
            *out = &slicer->at[i];
            return FW_OK;
        }
    if (slicer->nat == slicer->capacity) {
        enum { MOST = 256 };
        if (slicer->capacity) return FW_LIMIT; /* a flow has a handful of walls */
        FW_NEED(slicer->at = fw_arena_array(slicer->arena, fw_recipe_outline_at, MOST));
        slicer->capacity = MOST; /* not grown: pointers to entries stay good */
    }
    fw_recipe_outline_at *at = &slicer->at[slicer->nat];
    *at = (fw_recipe_outline_at){.edge_m = edge_m};
    FW_NEED(at->contour =
                fw_arena_array(slicer->arena, fw_geometry_contour, (size_t)slicer->nshape));
    for (int k = 0; k < slicer->nshape; k++)
        FW_TRY(moved(slicer, k, edge_m, &at->contour[k]));
    FW_TRY(slice(slicer, at));
    slicer->nat++;
    *out = at;
    return FW_OK;
}

/* from a point of the cut to the nearest edge of the structure; m, HUGE_VAL beyond FW_NEAR_M */
static double slicer_distance(const fw_recipe_slicer *slicer, const fw_recipe_outline_at *at,
                              double s_m) {
    fw_geometry_vec2 from = vec_along(slicer->cut->line.at, s_m, slicer->cut->line.along), on;
    fw_geometry_box here = {from.x, from.y, from.x, from.y};
    double best = HUGE_VAL, t;
    for (int k = 0; k < slicer->nshape; k++) {
        const fw_geometry_contour *c = &at->contour[k];
        for (int i = 0; i < c->count; i++) {
            const fw_geometry_segment *s = &c->segment[i];
            if (s->flags & FW_SEGMENT_JOINT || fw_box_gap(here, fw_segment_box(s)) >= best)
                continue;
            best = fmin(best, fw_geometry_segment_nearest(s, from, &t, &on));
        }
    }
    return best;
}

/* The greatest distance from the edges over the points of an opening: the best of 17 places, the
   middle among them, then golden section between its neighbours. In a slot the distance rises from
   either wall at the same rate, so that the top is found to 1e-12 m; in a wide opening that has
   several, one of the highest. Cost: 60 distances, once for each opening and wall. */
static double widest(const fw_recipe_slicer *slicer, const fw_recipe_outline_at *at, double from,
                     double to) {
    enum { PLACES = 17, STEPS = 42 };
    const double golden = 0.61803398874989485;
    double best = 0.0, step = (to - from) / (PLACES + 1), middle = from;
    for (int i = 1; i <= PLACES; i++) {
        double d = slicer_distance(slicer, at, from + step * i);
        if (d <= best) continue;
        best = d;
        middle = from + step * i;
    }
    double a = middle - step, b = middle + step, p = b - golden * (b - a), q = a + golden * (b - a);
    double at_p = slicer_distance(slicer, at, p), at_q = slicer_distance(slicer, at, q);
    for (int i = 0; i < STEPS; i++) {
        best = fmax(best, fmax(at_p, at_q));
        if (at_p > at_q) {
            b = q, q = p, at_q = at_p;
            p = b - golden * (b - a);
            at_p = slicer_distance(slicer, at, p);
        } else {
            a = p, p = q, at_p = at_q;
            q = a + golden * (b - a);
            at_q = slicer_distance(slicer, at, q);
        }
    }
    return fmin(2.0 * best, to - from);
}

double fw_recipe_slicer_opening(const fw_recipe_slicer *slicer, const fw_recipe_outline_at *at,
                                int g) {
    const fw_geometry_slice *o = &at->gap.item[g];
    if (!isfinite(o->from_m) || !isfinite(o->to_m)) return (double)INFINITY;
    if (isnan(at->width_m[g])) at->width_m[g] = widest(slicer, at, o->from_m, o->to_m);
    return at->width_m[g];
}

/* ---- films ---- */

static fw_status put(fw_recipe_slicer *slicer, fw_recipe_cross_section *p, fw_recipe_patch patch) {
    double end = slicer->cut->length_m;
    for (int i = 0; i < 2; i++) {
        patch.low_m[i] = fmin(fmax(patch.low_m[i], 0.0), end);
        patch.high_m[i] = fmin(fmax(patch.high_m[i], 0.0), end);
    }
    if (!(patch.low_m[1] > patch.low_m[0]) && !(patch.high_m[1] > patch.high_m[0])) return FW_OK;
    if (p->n == p->capacity) {
        int more = p->capacity ? 2 * p->capacity : 32;
        FW_NEED(p->patch = fw_arena_grow(slicer->arena, p->patch, (size_t)p->n, (size_t)more,
                                         sizeof patch));
        p->capacity = more;
    }
    p->patch[p->n++] = patch;
    return FW_OK;
}

static bool alike(fw_geometry_slices p, fw_geometry_slices q) {
    bool same = p.n == q.n;
    for (int i = 0; same && i < p.n; i++)
        same = p.item[i].from_m < q.item[i].to_m && q.item[i].from_m < p.item[i].to_m;
    return same;
}

/* trapezia between the film's intervals at its bottom and at its top; where these do not match (a
   part ends on the way), each half of the height has its own */
static fw_status put_between(fw_recipe_slicer *slicer, fw_recipe_cross_section *p,
                             const fw_process_film *f, fw_geometry_slices low,
                             fw_geometry_slices high, double bottom_m, double top_m) {
    if (!alike(low, high)) {
        double middle = 0.5 * (bottom_m + top_m);
        FW_TRY(put_between(slicer, p, f, low, low, bottom_m, middle));
        return put_between(slicer, p, f, high, high, middle, top_m);
    }
    for (int i = 0; i < low.n; i++)
        FW_TRY(put(slicer, p,
                   (fw_recipe_patch){.film = f,
                                     .low_m = {low.item[i].from_m, low.item[i].to_m},
                                     .high_m = {high.item[i].from_m, high.item[i].to_m},
                                     .bottom_m = bottom_m,
                                     .top_m = top_m}));
    return FW_OK;
}

/* Feet beside narrow openings stand farther out than beside the open field, by (1 - A) times what
   the lag leaves less of the over-etch: fw_process_fixed_point_edge. In: the intervals of the foot
   beside the open field. To first order in the shift over the radius of the wall. */
double fw_recipe_foot_more(const fw_process_flow *flow, const fw_process_cut *cut, double w_m) {
    const fw_process_fixed_point *e = &flow->edges;
    if (isnan(cut->anisotropy) || isnan(cut->etched_m) || cut->anisotropy >= 1.0) return 0.0;
    double field =
        fw_process_cut_foot(cut, e->ncls ? e->cls[e->field].opening_m : (double)INFINITY);
    return (1.0 - cut->anisotropy) * (field - fw_process_cut_foot(cut, w_m));
}

static fw_status correct_feet(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                              const fw_process_film *f, fw_geometry_slices *foot) {
    const fw_recipe_outline_at *mask;
    fw_geometry_slices out = {.n = foot->n};
    FW_TRY(fw_recipe_slicer_at(slicer, f->mask_edge_m, &mask));
    if (!alike(mask->inside, *foot)) return FW_OK;
    FW_NEED(out.item = fw_arena_array(slicer->arena, fw_geometry_slice, (size_t)foot->n));
    double before = 0.0;
    for (int g = 0; g < mask->gap.n; g++) { /* openings g and g + 1 stand beside part g */
        double more = fw_recipe_foot_more(flow, f->cut, fw_recipe_slicer_opening(slicer, mask, g));
        if (g > 0) {
            out.item[g - 1] = foot->item[g - 1];
            out.item[g - 1].from_m -= before / foot->item[g - 1].from_sine;
            out.item[g - 1].to_m += more / foot->item[g - 1].to_sine;
        }
        before = more;
    }
    *foot = out;
    return FW_OK;
}

/* what is left below the structure: points farther than the reach from every edge. The distance
   from the edges changes along the cut by at most as much as the place does, so that |distance -
   reach| is a step in which nothing changes; below 20 nm the step is 20 nm, which is the error. */
static fw_status put_left(fw_recipe_slicer *slicer, fw_recipe_cross_section *p,
                          const fw_process_film *f, fw_geometry_slices inside,
                          const fw_recipe_outline_at *edges) {
    const double least = 20e-9;
    double end = slicer->cut->length_m;
    for (int i = 0; i < inside.n; i++) {
        double s = fmax(inside.item[i].from_m, 0.0), to = fmin(inside.item[i].to_m, end);
        double start = (double)NAN;
        while (s < to) {
            double more = slicer_distance(slicer, edges, s) - f->reach_m;
            if (more > 0.0 && isnan(start)) start = s;
            bool ends = more <= 0.0 && !isnan(start);
            double next = fmin(to, s + fmax(fabs(more), least));
            if (ends || (next >= to && !isnan(start))) {
                double stop = ends ? s : to;
                FW_TRY(
                    put(slicer, p,
                        (fw_recipe_patch){f, {start, stop}, {start, stop}, f->bottom_m, f->top_m}));
                start = (double)NAN;
            }
            s = next;
        }
    }
    return FW_OK;
}

static fw_status put_structure(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                               fw_recipe_cross_section *p, const fw_process_film *f) {
    const fw_recipe_outline_at *low, *high;
    FW_TRY(fw_recipe_slicer_at(slicer, f->foot_m, &low));
    FW_TRY(fw_recipe_slicer_at(slicer, f->head_m, &high));
    if (f->reach_m > 0.0) return put_left(slicer, p, f, low->inside, low);
    fw_geometry_slices foot = low->inside;
    if (f->cut) FW_TRY(correct_feet(slicer, flow, f, &foot));
    return put_between(slicer, p, f, foot, high->inside, f->bottom_m, f->top_m);
}

/* floors that the lag has left in narrow openings */
static fw_status put_floors(fw_recipe_slicer *slicer, fw_recipe_cross_section *p,
                            const fw_process_film *f) {
    const fw_recipe_outline_at *mask, *low, *high;
    FW_TRY(fw_recipe_slicer_at(slicer, f->mask_edge_m, &mask));
    FW_TRY(fw_recipe_slicer_at(slicer, f->foot_m, &low));
    FW_TRY(fw_recipe_slicer_at(slicer, f->head_m, &high));
    bool fit = alike(mask->gap, low->gap) && alike(mask->gap, high->gap);
    for (int g = 0; g < mask->gap.n; g++) {
        double left = f->cut->depth_m -
                      fw_process_cut_depth(f->cut, fw_recipe_slicer_opening(slicer, mask, g));
        if (left <= 1e-9 * f->cut->depth_m) continue;
        fw_geometry_slice b = fit ? low->gap.item[g] : mask->gap.item[g];
        fw_geometry_slice t = fit ? high->gap.item[g] : mask->gap.item[g];
        double up = left / (f->top_m - f->bottom_m);
        FW_TRY(put(slicer, p,
                   (fw_recipe_patch){.film = f,
                                     .low_m = {b.from_m, b.to_m},
                                     .high_m = {b.from_m + up * (t.from_m - b.from_m),
                                                b.to_m + up * (t.to_m - b.to_m)},
                                     .bottom_m = f->bottom_m,
                                     .top_m = f->bottom_m + left}));
    }
    return FW_OK;
}

static fw_status put_field(fw_recipe_slicer *slicer, fw_recipe_cross_section *p,
                           const fw_process_film *f) {
    if (f->cut) return put_floors(slicer, p, f);
    const fw_recipe_outline_at *low, *high;
    FW_TRY(fw_recipe_slicer_at(slicer, f->foot_m, &low));
    FW_TRY(fw_recipe_slicer_at(slicer, f->head_m, &high));
    return put_between(slicer, p, f, low->gap, high->gap, f->bottom_m, f->top_m);
}

/* ---- flows with further plates ---- */

fw_status fw_recipe_slicer_of_plate(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                    int plate, fw_recipe_slicer **out) {
    if (plate == 0) {
        *out = slicer;
        return FW_OK;
    }
    fw_recipe_slicer **own = &slicer->further[plate - 1];
    if (!*own) {
        int row = fw_mask_plate_named(slicer->mask->table, flow->plate[plate - 1].id);
        if (row < 0) return FW_INTERNAL; /* cannot be: flow and table were compared (FW-D412) */
        FW_NEED(*own = fw_arena_one(slicer->arena, fw_recipe_slicer));
        FW_TRY(start_plate(slicer->arena, slicer->mask, row, slicer->cut, *own));
    }
    *out = *own;
    return FW_OK;
}

/* along the cut, one side of a plate with its wall at edge_m */
static fw_status side_slices(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                             fw_process_side side, double edge_m, fw_geometry_slices *out) {
    fw_recipe_slicer *of;
    const fw_recipe_outline_at *at;
    FW_TRY(fw_recipe_slicer_of_plate(slicer, flow, side.plate, &of));
    FW_TRY(fw_recipe_slicer_at(of, edge_m, &at));
    bool inside = side.plate == 0 ? !side.set : side.set;
    *out = inside ? at->inside : at->gap;
    return FW_OK;
}

/* where a film lies: over its columns, what all plates leave of each; plates on both of whose sides it lies alike part
   nothing */
static fw_status film_slices(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                             const fw_process_film *f, bool head, fw_geometry_slices *out) {
    fw_geometry_slice all = {-1.0, 2.0 * slicer->cut->length_m + 1.0, 1.0, 1.0};
    *out = (fw_geometry_slices){0};
    for (int k = 0; k < fw_process_flow_columns(flow); k++) {
        fw_geometry_slices own = {.item = &all, .n = 1}, part;
        if (!f->in[k]) continue;
        for (int plate = 0; plate <= flow->nplate; plate++) {
            fw_process_side side = {plate,
                                    fw_process_side_holds(flow, (fw_process_side){plate, true}, k)};
            double foot_m = plate ? f->further[plate - 1].foot_m : f->foot_m,
                   head_m = plate ? f->further[plate - 1].head_m : f->head_m;
            FW_TRY(side_slices(slicer, flow, side, head ? head_m : foot_m, &part));
            FW_TRY(fw_geometry_slices_combine(slicer->arena, own, part, FW_SET_AND, &own));
        }
        FW_TRY(fw_geometry_slices_combine(slicer->arena, *out, own, FW_SET_OR, out));
    }
    return FW_OK;
}

static fw_status put_film(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                          fw_recipe_cross_section *p, const fw_process_film *f) {
    fw_geometry_slices low, high;
    FW_TRY(film_slices(slicer, flow, f, false, &low));
    FW_TRY(film_slices(slicer, flow, f, true, &high));
    return put_between(slicer, p, f, low, high, f->bottom_m, f->top_m);
}

/* Every film along the cut. In: the flow as computed. Out: trapezia, clipped to the window. Exact
   where outlines are (fw_geometry_contour_offset, fw_geometry_contour_slice: 1e-12 m); floors and
   feet of narrow openings as the fixed point has them for their width. Cost: one offset and one
   slice of the shapes near the cut for each wall that occurs, kept over all steps. Test:
   test_profile.c: gaps against the certificate's, volumes, depths. */
fw_status fw_recipe_cross_section_of(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                     int index, fw_recipe_cross_section *profile) {
    *profile = (fw_recipe_cross_section){0};
    FW_TRY(fw_process_flow_films(slicer->arena, flow, index, &profile->films));
    double end = slicer->cut->length_m;
    for (int i = 0; i < profile->films.n; i++) {
        const fw_process_film *f = &profile->films.film[i];
        if (flow->nplate > 0 && !(f->cut && !f->in[FW_STACK_STRUCTURE]))
            FW_TRY(put_film(slicer, flow, profile, f));
        else if (f->in[FW_STACK_STRUCTURE] && f->in[FW_STACK_FIELD])
            FW_TRY(put(slicer, profile,
                       (fw_recipe_patch){f, {0.0, end}, {0.0, end}, f->bottom_m, f->top_m}));
        else if (f->in[FW_STACK_STRUCTURE])
            FW_TRY(put_structure(slicer, flow, profile, f));
        else if (f->in[FW_STACK_FIELD])
            FW_TRY(put_field(slicer, profile, f));
    }
    return FW_OK;
}
