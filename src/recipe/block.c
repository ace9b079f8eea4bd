/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/sort.h"
#include "base/svg.h"
#include "geometry/segment.h"
#include "recipe/recipe_profile.h"
#include "recipe/recipe.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- outlines in the frame of the cut ---- */

/* the structure with its edges so far outside the drawn ones, arcs within tolerance_m */
static fw_status block_rings(fw_recipe_slicer *slicer, double edge_m, double tolerance_m,
                             fw_recipe_rings *rings) {
    const fw_recipe_outline_at *at;
    FW_TRY(fw_recipe_slicer_at(slicer, edge_m, &at));
    *rings = (fw_recipe_rings){
        .ring = fw_arena_array(slicer->arena, fw_recipe_ring, (size_t)slicer->nshape)};
    FW_NEED(rings->ring);
    for (int k = 0; k < slicer->nshape; k++) {
        fw_recipe_ring *r = &rings->ring[rings->n];
        if (at->contour[k].count == 0) continue;
        FW_TRY(fw_recipe_ring_of(slicer->arena, slicer->cut, &at->contour[k], tolerance_m, r));
        if (r->n >= 3) rings->n++;
    }
    return FW_OK;
}

/* ---- which wall hides which ---- */

typedef struct span { /* of a wall, seen from the eye */
    double from, to, depth_from, depth_to;
} span;

static span visible_span(const fw_recipe_wall *w, double tx, double ty) {
    double xa = -ty * w->a.x + tx * w->a.y, xb = -ty * w->b.x + tx * w->b.y; /* to the right */
    double da = tx * w->a.x + ty * w->a.y, db = tx * w->b.x + ty * w->b.y;
    return xa <= xb ? (span){xa, xb, da, db} : (span){xb, xa, db, da};
}

static double depth_at(const span *s, double x) {
    double length = s->to - s->from;
    return length > 0.0 ? s->depth_from + (s->depth_to - s->depth_from) * (x - s->from) / length
                        : fmax(s->depth_from, s->depth_to);
}

/* must p be drawn before q? Where both are seen in one direction q is nearer to the eye. */
static bool before(const span *p, const span *q) {
    double from = fmax(p->from, q->from), to = fmin(p->to, q->to);
    if (to - from <= 1e-12) return false;
    double middle = 0.5 * (from + to);
    return depth_at(p, middle) < depth_at(q, middle);
}

/* Walls do not cross, so that "is hidden by" has no cycle in one direction of view (de Berg et al.,
   Computational Geometry, section 12.1: true of disjoint segments in the plane); what could come
   first comes in the order given. In: n walls. Cost O(n^2). Test: test_profile.c, walls. */
fw_status fw_recipe_walls_sort(fw_arena *arena, fw_recipe_wall *wall, int n, double toward_x,
                               double toward_y) {
    fw_mark mark = fw_arena_mark(arena);
    span *s = fw_arena_array(arena, span, (size_t)n);
    int *waits = fw_arena_array(arena, int, (size_t)n);
    bool *done = fw_arena_array(arena, bool, (size_t)n);
    fw_recipe_wall *sorted = fw_arena_array(arena, fw_recipe_wall, (size_t)n);
    FW_NEED(s && waits && done && sorted);
    for (int i = 0; i < n; i++)
        s[i] = visible_span(&wall[i], toward_x, toward_y);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            waits[i] += i != k && before(&s[k], &s[i]);
    for (int left = n; left > 0; left--) {
        int best = -1;
        for (int i = 0; i < n; i++)
            if (!done[i] && (best < 0 || waits[i] < waits[best])) best = i;
        done[best] = true;
        sorted[n - left] = wall[best];
        for (int i = 0; i < n; i++)
            if (!done[i] && before(&s[best], &s[i])) waits[i]--;
    }
    for (int i = 0; i < n; i++)
        wall[i] = sorted[i];
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* A block of the wafer behind the cut, in parallel projection from above: the section is its front.

   Along a sight ray height only grows towards the eye, so that what lies higher hides what lies
   lower and never the other way round: layers are painted from the lowest up. Within a layer walls
   hide each other by their order in the plane (block.c), and the ceilings lie above all of them.
   The two cut faces are nearer than all else and come last. Heights as in the sections. */

static const double TURN = 0.50, TILT = 0.62; /* rad: of the block to the left, of the eye upward */
static const double TOLERANCE_PX = 0.12;      /* of an arc from its chords */

typedef struct view {
    fw_text *out;
    double k, kz;          /* pixels per metre along the plane and of heights */
    double xx, xy, yx, yy; /* screen x, y (downward) of the cut's x and y, pixels per metre */
    double origin;         /* y of the point (0, 0, 0) */
} view;

static void put(const view *v, char letter, double x, double y, double z) {
    fw_svg_point(v->out, letter, v->xx * x + v->xy * y,
                 v->origin + v->yx * x + v->yy * y - v->kz * z, 1);
}

/* "#rrggbb" times a factor, at most white */
static const char *shaded(char text[8], const char *fill, double factor) {
    static const char digit[] = "0123456789abcdef";
    text[0] = '#', text[7] = '\0';
    for (int i = 0; i < 3; i++) {
        char hex[3] = {fill[1 + 2 * i], fill[2 + 2 * i], '\0'};
        int c = (int)lround(factor * (double)strtol(hex, NULL, 16));
        c = c < 0 ? 0 : c > 255 ? 255 : c;
        text[1 + 2 * i] = digit[c / 16], text[2 + 2 * i] = digit[c % 16];
    }
    return text;
}

/* ---- a layer: films between two heights ---- */

typedef struct layer {
    const fw_process_films *films;
    double low_m, high_m;
} layer;

static bool is_floor(const fw_process_film *f) {
    return f->cut && !f->in[FW_STACK_STRUCTURE];
}

/* what of the structure an etch from the openings has left lies behind its edges, out of sight */
static bool is_hidden(const fw_process_film *f) {
    return is_floor(f) || f->reach_m > 0.0;
}

static bool fills_layer(const layer *l, const fw_process_film *f) {
    return !is_hidden(f) && f->bottom_m <= l->low_m + 1e-12 && f->top_m >= l->high_m - 1e-12;
}

static bool occupied(const layer *l, int column) {
    for (int i = 0; i < l->films->n; i++)
        if (l->films->film[i].in[column] && fills_layer(l, &l->films->film[i])) return true;
    return false;
}

static double edge_of(const fw_process_film *f) {
    return 0.5 * (f->foot_m + f->head_m);
}

static fw_status count_walls(const fw_recipe_rings *rings, fw_arena *arena, fw_recipe_wall **wall) {
    size_t n = 0;
    for (int i = 0; i < rings->n; i++)
        n += (size_t)rings->ring[i].n;
    FW_NEED(*wall = fw_arena_array(arena, fw_recipe_wall, n));
    return FW_OK;
}

/* walls that face the eye; those of the field's films run the other way round */
static int walls_of(const fw_recipe_rings *rings, bool field, int film, double tx, double ty,
                    fw_recipe_wall *wall) {
    int n = 0;
    for (int i = 0; i < rings->n; i++) {
        const fw_recipe_ring *r = &rings->ring[i];
        for (int k = 0; k < r->n; k++) {
            fw_recipe_spot a = r->corner[k > 0 ? k - 1 : r->n - 1], b = r->corner[k];
            if (b.open) continue;
            fw_recipe_wall w = field ? (fw_recipe_wall){b, a, film} : (fw_recipe_wall){a, b, film};
            double nx = w.b.y - w.a.y, ny = w.a.x - w.b.x; /* out of the material */
            if (nx * tx + ny * ty > 0.0) wall[n++] = w;
        }
    }
    return n;
}

static void draw_wall(const view *v, const fw_recipe_wall *w, const fw_process_film *f,
                      const layer *l) {
    double nx = w->b.y - w->a.y, ny = w->a.x - w->b.x, n = hypot(nx, ny);
    double light = n > 0.0 ? (0.55 * nx - 0.83 * ny) / n : 0.0; /* from the right, before it */
    const char *fill = fw_recipe_paint_fill(f->material, f->exposed);
    double factor = 0.80 + 0.04 * floor(4.0 * light);
    char ink[8];
    shaded(ink, fill, factor);
    /* a stroke too: no seams between facets */
    fw_svg_path(v->out, "stroke-width='0.4' stroke='{r}' fill='{r}'", ink, ink);
    put(v, 'M', w->a.x, w->a.y, l->low_m);
    put(v, 'L', w->b.x, w->b.y, l->low_m);
    put(v, 'L', w->b.x, w->b.y, l->high_m);
    put(v, 'L', w->a.x, w->a.y, l->high_m);
    fw_text_add(v->out, "Z");
    fw_svg_path_end(v->out);
}

static fw_status draw_walls(fw_recipe_slicer *slicer, const view *v, const layer *l,
                            double tolerance_m) {
    double tx = sin(TURN), ty = -cos(TURN);
    for (int column = 0; column <= FW_STACK_FIELD; column++) {
        if (occupied(l, FW_STACK_FIELD + FW_STACK_STRUCTURE - column)) continue;
        for (int i = 0; i < l->films->n; i++) {
            const fw_process_film *f = &l->films->film[i];
            fw_recipe_rings rings;
            fw_recipe_wall *wall;
            if (!f->in[column] || !fills_layer(l, f)) continue;
            FW_TRY(block_rings(slicer, edge_of(f), tolerance_m, &rings));
            FW_TRY(count_walls(&rings, slicer->arena, &wall));
            int n = walls_of(&rings, column == FW_STACK_FIELD, i, tx, ty, wall);
            FW_TRY(fw_recipe_walls_sort(slicer->arena, wall, n, tx, ty));
            for (int k = 0; k < n; k++)
                draw_wall(v, &wall[k], f, l);
        }
    }
    return FW_OK;
}

/* is a ceiling covered by a film that lies on all of it? */
static bool covered(const fw_process_films *films, const fw_process_film *f, int columns) {
    for (int i = 0; i < films->n; i++) {
        const fw_process_film *g = &films->film[i];
        bool all = !is_hidden(g) && fabs(g->bottom_m - f->top_m) <= 1e-12;
        for (int k = 0; k < columns && all; k++)
            all = g->in[k] || !f->in[k];
        if (all) return true;
    }
    return false;
}

static void block_top(const view *v, const fw_recipe_cut *cut, double z) {
    put(v, 'M', 0.0, 0.0, z);
    put(v, 'L', cut->length_m, 0.0, z);
    put(v, 'L', cut->length_m, cut->depth_m, z);
    put(v, 'L', 0.0, cut->depth_m, z);
    fw_text_add(v->out, "Z");
}

/* edges of the ceiling that are edges of the material, and of the block where the field is */
static void ceiling_edges(const view *v, const fw_recipe_rings *rings, const fw_recipe_cut *block,
                          double z) {
    fw_svg_path(v->out, "fill='none' stroke='#222' stroke-width='0.35'");
    if (block) block_top(v, block, z);
    for (int i = 0; i < rings->n; i++) {
        const fw_recipe_ring *r = &rings->ring[i];
        bool down = false;
        for (int k = 0; k < r->n; k++) {
            fw_recipe_spot a = r->corner[k > 0 ? k - 1 : r->n - 1], b = r->corner[k];
            if (!b.open && !down) put(v, 'M', a.x, a.y, z);
            if (!b.open) put(v, 'L', b.x, b.y, z);
            down = !b.open;
        }
    }
    fw_svg_path_end(v->out);
}

/* of a flow with further plates: the film's own region, whatever parts it */
static fw_status draw_region(fw_recipe_slicer *slicer, const view *v, const fw_process_flow *flow,
                             const fw_process_film *f, double tolerance_m) {
    fw_recipe_rings rings;
    char ink[8];
    FW_TRY(fw_recipe_region_of(slicer, flow, f, 1.0, tolerance_m, &rings));
    fw_svg_path(v->out, "fill='{r}'",
                shaded(ink, fw_recipe_paint_fill(f->material, f->exposed), 1.07));
    for (int i = 0; i < rings.n; i++) {
        for (int k = 0; k < rings.ring[i].n; k++)
            put(v, k ? 'L' : 'M', rings.ring[i].corner[k].x, rings.ring[i].corner[k].y, f->top_m);
        fw_text_add(v->out, "Z");
    }
    fw_svg_path_end(v->out);
    ceiling_edges(v, &rings, NULL, f->top_m);
    return FW_OK;
}

/* walls of all films of a layer, sorted together: none crosses another */
static fw_status draw_region_walls(fw_recipe_slicer *slicer, const view *v,
                                   const fw_process_flow *flow, const layer *l,
                                   double tolerance_m) {
    double tx = sin(TURN), ty = -cos(TURN);
    size_t most = 0;
    int n = 0;
    fw_recipe_rings *rings =
        fw_arena_array(slicer->arena, fw_recipe_rings, (size_t)l->films->n + 1);
    FW_NEED(rings);
    for (int i = 0; i < l->films->n; i++) {
        if (!fills_layer(l, &l->films->film[i])) continue;
        FW_TRY(fw_recipe_region_of(slicer, flow, &l->films->film[i], 0.5, tolerance_m, &rings[i]));
        for (int k = 0; k < rings[i].n; k++)
            most += (size_t)rings[i].ring[k].n;
    }
    fw_recipe_wall *wall = fw_arena_array(slicer->arena, fw_recipe_wall, most + 1);
    FW_NEED(wall);
    for (int i = 0; i < l->films->n; i++)
        n += walls_of(&rings[i], false, i, tx, ty, wall + n);
    FW_TRY(fw_recipe_walls_sort(slicer->arena, wall, n, tx, ty));
    for (int k = 0; k < n; k++)
        draw_wall(v, &wall[k], &l->films->film[wall[k].film], l);
    return FW_OK;
}

static fw_status draw_ceiling(fw_recipe_slicer *slicer, const view *v, const fw_process_film *f,
                              double tolerance_m) {
    fw_recipe_rings rings = {0};
    bool both = f->in[0] && f->in[1];
    if (!both) FW_TRY(block_rings(slicer, f->head_m, tolerance_m, &rings));
    char ink[8];
    fw_svg_path(v->out, "fill-rule='evenodd' fill='{r}'",
                shaded(ink, fw_recipe_paint_fill(f->material, f->exposed), 1.07));
    if (f->in[FW_STACK_FIELD]) block_top(v, slicer->cut, f->top_m);
    for (int i = 0; i < rings.n; i++) {
        for (int k = 0; k < rings.ring[i].n; k++)
            put(v, k ? 'L' : 'M', rings.ring[i].corner[k].x, rings.ring[i].corner[k].y, f->top_m);
        fw_text_add(v->out, "Z");
    }
    fw_svg_path_end(v->out);
    ceiling_edges(v, &rings, f->in[FW_STACK_FIELD] ? slicer->cut : NULL, f->top_m);
    return FW_OK;
}

static fw_status draw_layers(fw_recipe_slicer *slicer, const view *v, const fw_process_flow *flow,
                             const fw_process_films *films) {
    int columns = fw_process_flow_columns(flow);
    bool several = flow->nplate > 0;
    double tolerance_m = TOLERANCE_PX / v->k;
    double *level = fw_arena_array(slicer->arena, double, 2 * (size_t)films->n);
    FW_NEED(level);
    for (int i = 0; i < films->n; i++) {
        level[2 * i] = films->film[i].bottom_m;
        level[2 * i + 1] = films->film[i].top_m;
    }
    fw_sort_doubles(level, 2 * (size_t)films->n);
    for (int i = 0; i + 1 < 2 * films->n; i++) {
        layer l = {films, level[i], level[i + 1]};
        if (l.high_m - l.low_m <= 1e-12) continue;
        FW_TRY(several ? draw_region_walls(slicer, v, flow, &l, tolerance_m)
                       : draw_walls(slicer, v, &l, tolerance_m));
        for (int k = 0; k < films->n; k++) {
            const fw_process_film *f = &films->film[k];
            if (fabs(f->top_m - l.high_m) > 1e-12 || !fills_layer(&l, f) ||
                covered(films, f, columns))
                continue;
            FW_TRY(several ? draw_region(slicer, v, flow, f, tolerance_m)
                           : draw_ceiling(slicer, v, f, tolerance_m));
        }
    }
    return FW_OK;
}

/* ---- the cut faces ---- */

/* a profile as a face: s runs from (x, y) in the direction (dx, dy) of the cut's frame */
static void draw_face(const view *v, const fw_recipe_cross_section *p, double x, double y,
                      double dx, double dy, double factor) {
    for (int i = 0; i < p->n; i++) {
        const fw_recipe_patch *q = &p->patch[i];
        const double s[] = {q->low_m[0], q->high_m[0], q->high_m[1], q->low_m[1]};
        char ink[8];
        fw_svg_path(v->out, "fill='{r}'",
                    shaded(ink, fw_recipe_paint_fill(q->film->material, q->film->exposed), factor));
        for (int k = 0; k < 4; k++)
            put(v, k ? 'L' : 'M', x + dx * s[k], y + dy * s[k],
                k == 0 || k == 3 ? q->bottom_m : q->top_m);
        fw_text_add(v->out, "Z");
        fw_svg_more(v->out, "stroke='#222' stroke-width='0.35'");
        fw_svg_path_end(v->out);
    }
}

static fw_status draw_faces(fw_recipe_slicer *slicer, const view *v, const fw_process_flow *flow,
                            int index) {
    const fw_recipe_cut *cut = slicer->cut;
    const fw_geometry_vec2 u = cut->line.along;
    const fw_recipe_cut side = {
        .line = {{cut->line.at.x + cut->length_m * u.x, cut->line.at.y + cut->length_m * u.y},
                 {-u.y, u.x}},
        .length_m = cut->depth_m,
        .depth_m = cut->length_m,
        .name = cut->name};
    fw_recipe_slicer beside;
    fw_recipe_cross_section p;
    FW_TRY(fw_recipe_slicer_start(slicer->arena, slicer->mask, &side, &beside));
    FW_TRY(fw_recipe_cross_section_of(&beside, flow, index, &p));
    draw_face(v, &p, cut->length_m, 0.0, 0.0, 1.0, 0.80);
    FW_TRY(fw_recipe_cross_section_of(slicer, flow, index, &p));
    draw_face(v, &p, 0.0, 0.0, 1.0, 0.0, 0.94);
    return FW_OK;
}

fw_status fw_recipe_block_draw(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                               const fw_recipe_section_scale *scale, int index, double width,
                               fw_text *out, double *height) {
    const fw_recipe_cut *cut = slicer->cut;
    fw_process_films films;
    FW_TRY(fw_process_flow_films(slicer->arena, flow, index, &films));
    *height = 0.0;
    if (films.n == 0) return FW_OK;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < films.n; i++) {
        low = fmin(low, films.film[i].bottom_m);
        high = fmax(high, films.film[i].top_m);
    }
    double across = cut->length_m * cos(TURN) + cut->depth_m * sin(TURN),
           k = (width - 2.0) / across;
    view v = {.out = out,
              .k = k,
              .kz = k * cos(TILT) * scale->exaggeration,
              .xx = k * cos(TURN),
              .xy = k * sin(TURN),
              .yx = k * sin(TURN) * sin(TILT),
              .yy = -k * cos(TURN) * sin(TILT)};
    v.origin = v.kz * high - v.yy * cut->depth_m + 1.0;
    *height = v.origin + v.yx * cut->length_m - v.kz * low + 1.0;
    fw_svg_open(out, "g stroke-linejoin='round'\n");
    FW_TRY(draw_layers(slicer, &v, flow, &films));
    FW_TRY(draw_faces(slicer, &v, flow, index));
    fw_svg_close(out, "g\n");
    return FW_OK;
}
