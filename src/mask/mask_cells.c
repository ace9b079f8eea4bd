/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layers that the cells of a description go to, in the layer tables of the flows; and cells upon the frame. */
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

int fw_mask_layer_named(const fw_mask_table *table, const char *text) {
    int layer, datatype;
    if (strcmp(text, "mask") == 0) return fw_mask_layer_of_role(table, "structure");
    if (fw_mask_gds_pair(text, &layer, &datatype)) {
        for (int k = 0; k < table->nlayer; k++)
            if (table->layer[k].layer == layer && table->layer[k].datatype == datatype) return k;
        return -1;
    }
    for (int k = 0; k < table->nlayer; k++)
        if (fw_text_same(table->layer[k].id, text) || fw_text_same(table->layer[k].name, text))
            return k;
    return fw_mask_layer_of_role(table, text);
}

/* a row for what no row has: it is in every file, and on no plate */
static fw_status add_own(fw_arena *arena, fw_mask_table *table, const char *text, fw_place place) {
    int number, datatype;
    size_t n = (size_t)table->nlayer;
    fw_mask_gds_pair(text, &number, &datatype);
    fw_mask_layer *list = fw_arena_grow(arena, table->layer, n, n + 1, sizeof *list);
    const char *id = fw_arena_printf(arena, "cell-%d-%d", number, datatype);
    const char *name = fw_arena_printf(arena, "CELL_%d_%d", number, datatype);
    FW_NEED(list && id && name ? list : NULL);
    list[n] = (fw_mask_layer){.layer = number,
                              .datatype = datatype,
                              .id = id,
                              .name = name,
                              .purpose = "drawn by cells of the description alone; on no plate",
                              .roles = 1u << FW_ROLE_CELL,
                              .tone = n > 0 ? list[0].tone : NULL,
                              .colour = "#7a7a7a",
                              .place = place};
    table->layer = list;
    table->nlayer++;
    return FW_OK;
}

static int role_of(const fw_mask_layer *layer) {
    for (int r = 0; r < FW_ROLE_COUNT; r++)
        if (layer->roles & 1u << r) return r;
    return FW_CELL_ROLE_NONE;
}

static fw_status unknown_layer(fw_arena *arena, const fw_mask_table *t, const char *to,
                               fw_place place, fw_diags *diags) {
    fw_text has = fw_text_new(arena);
    const char **id = fw_arena_array(arena, const char *, (size_t)t->nlayer + 1);
    FW_NEED(id);
    for (int k = 0; k < t->nlayer; k++)
        id[k] = t->layer[k].id ? t->layer[k].id : "";
    id[t->nlayer] = "mask";
    const char *near = fw_did_you_mean(to, id, (size_t)t->nlayer + 1);
    for (int k = 0; k < t->nlayer; k++)
        if (!t->layer[k].documentation)
            fw_text_printf(&has, "%s%s (%d/%d)", k ? ", " : "", t->layer[k].id, t->layer[k].layer,
                           t->layer[k].datatype);
    FW_NEED(has.failed ? NULL : has.data);
    return fw_diag_error(diags, 570, place,
                         "flow %s has no layer '%.64s' for a cell%s%s%s; it has mask, %s, and any "
                         "NUMBER/DATATYPE besides is a layer of the cell's own",
                         t->flow, to, near ? " (did you mean '" : "", near ? near : "",
                         near ? "'?)" : "", has.data);
}

/* one layer of a cell in one flow */
static fw_status settle(fw_arena *arena, fw_mask_table *t, const fw_device_cell *cell,
                        fw_device_cell_layer *layer, const char *first, fw_diags *diags) {
    int number, datatype, k = fw_mask_layer_named(t, layer->to);
    if (k < 0 && fw_mask_gds_pair(layer->to, &number, &datatype)) {
        k = t->nlayer;
        FW_TRY(add_own(arena, t, layer->to, cell->layers_place));
    }
    if (k < 0) return unknown_layer(arena, t, layer->to, cell->layers_place, diags);
    if (t->layer[k].documentation)
        return fw_diag_error(
            diags, 570, cell->layers_place,
            "layer %s of flow %s is for records and never exposed; put the cell on another one",
            layer->to, t->flow);
    int role = role_of(&t->layer[k]);
    if (layer->role != FW_CELL_ROLE_OPEN && layer->role != role)
        return fw_diag_error(
            diags, 570, cell->layers_place,
            "layer %s draws something else in flow %s than in flow %s; name what it draws: mask, "
            "text, mark ...",
            layer->to, t->flow, first);
    layer->role = role;
    return FW_OK;
}

/* a cell that asks for the bias of its layers, in a flow where none of them has one */
static void look_for_bias(const fw_mask_table *t, const fw_device_cell *cell, fw_diags *diags) {
    bool any = cell->nlayer == 0;
    for (int k = 0; k < cell->nlayer; k++) {
        int layer = fw_mask_layer_named(t, cell->layer[k].to);
        any = any || (layer >= 0 && t->layer[layer].biased);
    }
    if (!any)
        fw_diag_warning(diags, 724, cell->place,
                        "cell '%.64s' asks for the bias of its layers (bias=\"yes\"), and none of "
                        "them has one in flow %s: it is on the mask as it was drawn",
                        cell->name, t->flow);
}

fw_status fw_mask_cells_settle(fw_arena *arena, const fw_device *device,
                               fw_mask_table *const *table, int ntable, fw_diags *diags) {
    fw_status worst = FW_OK;
    for (int side = 0; side < 2; side++) {
        const fw_device_cell *cell = side ? device->wafer.cell : device->cell;
        int n = side ? device->wafer.ncell : device->ncell;
        for (int i = 0; i < n; i++) {
            for (int k = 0; k < cell[i].nlayer; k++) {
                cell[i].layer[k].role = FW_CELL_ROLE_OPEN;
                for (int t = 0; t < ntable; t++) {
                    fw_status status =
                        settle(arena, table[t], &cell[i], &cell[i].layer[k], table[0]->flow, diags);
                    if (status != FW_OK && status != FW_INPUT) return status;
                    if (status != FW_OK) worst = status;
                }
            }
            for (int t = 0; t < ntable && cell[i].biased && worst == FW_OK; t++)
                look_for_bias(table[t], &cell[i], diags);
        }
    }
    return worst;
}

/* ---- what files say of them ---- */

/* "7/0" of where it goes */
static const char *gds_of(const fw_mask *mask, const fw_layout_cell *c,
                          char text[FW_MASK_GDS_TEXT]) {
    int k = fw_mask_layer_named(mask->table, c->layer);
    if (k < 0) return c->layer;
    snprintf(text, FW_MASK_GDS_TEXT, "%d/%d", mask->table->layer[k].layer,
             mask->table->layer[k].datatype);
    return text;
}

void fw_mask_cells_json(fw_json *json, const fw_mask *mask) {
    if (mask->nplaced == 0) return;
    fw_json_line(json, 2);
    fw_json_list(json, "drawings");
    for (int i = 0; i < mask->nplaced; i++) {
        const fw_layout_cell *c = &mask->placed[i];
        char gds[FW_MASK_GDS_TEXT];
        fw_json_object(json, NULL);
        fw_json_text(json, "name", c->of->name);
        fw_json_text(json, "file", c->of->file);
        fw_json_text(json, "gds", gds_of(mask, c, gds));
        fw_json_truth(json, "biased", c->biased);
        fw_json_end(json);
    }
    fw_json_end(json);
}

void fw_mask_cells_order_text(const fw_mask *mask, fw_text *out) {
    if (mask->nplaced == 0) return;
    fw_text_add(out, "\ndrawings of others on it: name, file, layer\n");
    for (int i = 0; i < mask->nplaced; i++) {
        const fw_layout_cell *c = &mask->placed[i];
        char gds[FW_MASK_GDS_TEXT];
        fw_text_printf(out, "%s  %s  %s\n", c->of->name, c->of->file, gds_of(mask, c, gds));
    }
}

/* ---- the bias of cells with holes ----
   A hole is cut open, and the cuts are no edges: their ends do not lie where a moved edge ends. So outlines and holes are put
   together again, each is moved by the bias, and what they then enclose is cut anew. Where their number changes, two of them
   have met: what was apart would be one, or a wall would vanish. Test: tests/klayout/cells.py, against KLayout's sized(). */

/* behind the last shape of a cell, whose shapes follow each other */
static int end_of(const fw_mask *mask, int first) {
    int end = first;
    while (end < mask->nshape && mask->shape[end].piece->label == mask->shape[first].piece->label)
        end++;
    return end;
}

bool fw_mask_cell_is_cut(const fw_mask *mask, int first) {
    const int end = end_of(mask, first);
    for (int s = first; s < end; s++)
        for (int i = 0; i < mask->shape[s].contour.count; i++)
            if (mask->shape[s].contour.segment[i].flags & FW_SEGMENT_JOINT) return true;
    return false;
}

/* what the shapes of a cell cover as it was drawn, as outlines and holes */
static fw_status loops_of(fw_arena *arena, const fw_mask *mask, int first, int end,
                          fw_geometry_polygon **loop, int **depth, int *n) {
    static const fw_geometry_merge_term all = {0, FW_SET_OR};
    const size_t count = (size_t)(end - first);
    fw_geometry_merge_input *input = fw_arena_array(arena, fw_geometry_merge_input, count);
    fw_geometry_polygon *polygon = fw_arena_array(arena, fw_geometry_polygon, count);
    FW_NEED(input && polygon ? input : NULL);
    for (size_t i = 0; i < count; i++) {
        FW_TRY(fw_geometry_flatten(arena, &mask->shape[(size_t)first + i].piece->contour,
                                   mask->tolerance_m, FW_FLATTEN_INSIDE, &polygon[i], NULL));
        input[i].polygon = &polygon[i];
    }
    return fw_geometry_merge_loops(arena, input, (int)count, &all, 1, loop, depth, n);
}

/* each outline moved out and each hole moved in, and what lies between them cut again. FW_GEOMETRY: they meet */
static fw_status moved_loops(fw_arena *arena, const fw_mask *mask, double bias_m,
                             fw_geometry_polygon *loop, const int *depth, int n,
                             fw_geometry_contour **out, int *nout) {
    fw_geometry_merge_input *input = fw_arena_array(arena, fw_geometry_merge_input, (size_t)n);
    fw_geometry_merge_term term[FW_MERGE_SETS];
    fw_geometry_merged merged;
    int deepest = 0;
    FW_NEED(input);
    for (int i = 0; i < n; i++) {
        fw_geometry_contour drawn, moved;
        FW_TRY(fw_drawing_outline_of(arena, &loop[i], &drawn));
        FW_TRY(fw_geometry_contour_offset(arena, &drawn, depth[i] % 2 ? -bias_m : bias_m, &moved,
                                          NULL, NULL));
        FW_TRY(fw_geometry_flatten(arena, &moved, mask->tolerance_m, mask->flattening, &loop[i],
                                   NULL));
        input[i] = (fw_geometry_merge_input){&loop[i], depth[i]};
        deepest = depth[i] > deepest ? depth[i] : deepest;
    }
    for (int k = 0; k <= deepest; k++)
        term[k] = (fw_geometry_merge_term){k, k % 2 ? FW_SET_NOT : FW_SET_OR};
    FW_TRY(fw_geometry_merge(arena, input, n, term, deepest + 1, FW_DRAWING_CORNERS_MOST, &merged));
    if (merged.outlines + merged.holes != n) return FW_GEOMETRY;
    *nout = merged.n;
    return fw_drawing_outlines_of(arena, &merged, out);
}

/* puts the outlines in the place of the shapes from `first` on to `end` */
static fw_status put_shapes(fw_arena *arena, fw_mask *mask, int first, int end,
                            const fw_geometry_contour *outline, int n) {
    const int behind = mask->nshape - end;
    fw_mask_shape *list =
        fw_arena_array(arena, fw_mask_shape, (size_t)first + (size_t)n + (size_t)behind);
    FW_NEED(list);
    for (int i = 0; i < first; i++)
        list[i] = mask->shape[i];
    for (int i = 0; i < n; i++) {
        list[first + i] = mask->shape[first + i < end ? first + i : first];
        list[first + i].contour = outline[i];
    }
    for (int i = 0; i < behind; i++)
        list[first + n + i] = mask->shape[end + i];
    mask->shape = list;
    mask->nshape = first + n + behind;
    return FW_OK;
}

fw_status fw_mask_cells_bias(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                             fw_diags *diags) {
    fw_status worst = FW_OK;
    for (int first = 0, end; first < mask->nshape; first = end) {
        const fw_layout_cell *cell = fw_layout_cell_of(layout, mask->shape[first].piece);
        const double bias_m = fw_mask_layer_bias_m(mask, mask->shape[first].layer);
        fw_geometry_polygon *loop;
        fw_geometry_contour *outline = NULL;
        int *depth, n, nout = 0;
        char bias[32], apart[32];
        end = end_of(mask, first);
        if (!cell || !cell->biased || bias_m == 0 || !fw_mask_cell_is_cut(mask, first)) continue;
        FW_TRY(loops_of(arena, mask, first, end, &loop, &depth, &n));
        fw_status status = moved_loops(arena, mask, bias_m, loop, depth, n, &outline, &nout);
        if (status == FW_GEOMETRY) {
            fw_diag_error(diags, 143, cell->of->place,
                          "%s cannot take the bias of %s um per edge: an outline of it, or a hole, "
                          "would meet another or itself, or vanish; draw nothing of it nearer to "
                          "anything else of it than %s um",
                          cell->label, fw_number_text(bias, sizeof bias, bias_m * 1e6, 6),
                          fw_number_text(apart, sizeof apart, fabs(2 * bias_m) * 1e6, 6));
            worst = FW_INPUT;
            continue;
        }
        FW_TRY(status);
        FW_TRY(put_shapes(arena, mask, first, end, outline, nout));
        end = first + nout;
    }
    return diags->failed ? FW_NOMEM : worst;
}

/* ---- cells upon the frame ----
   What a cell has in common with the frame, a base or another cell on a layer of the device is taken off the cell, exactly,
   and the edge that they then share becomes a joint of both, so that together they are one region: its area counts once, the
   rules see no edge between them, and nothing is counted as an overlap. After the bias: the frame is as it is on the
   mask, its arcs near a cell as chords. Around what lies wholly inside of it a cell is cut in parts, down through the middle
   of each hole, whose cuts are joints, too. What cannot be united so (edges that run within 1e-12 m of each other) stays
   as it is, and the rules refuse it (FW-D152). Cost: pairs of cells and pieces whose boxes meet. Test: tests/klayout/cells.py */

typedef struct uniter {
    fw_arena *arena;
    const fw_layout *layout;
    double tolerance_m;
    fw_mask_shape *shape;
    int n, room;
} uniter;

static const double ONE_PLACE_M = 1e-12; /* of the boolean */
static const double LEAST_M2 = 1e-18;    /* a square of the grid: less in common is nothing */

static bool stands(const uniter *u, int k) {
    const fw_layout_piece *p = u->shape[k].piece;
    return p->body == FW_GROUND && (p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FRAME);
}

static bool near_to(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return vec_distance(p, q) <= ONE_PLACE_M;
}

/* how far along a line a point of it lies; NaN: it is off the line or beyond its ends */
static double on_line(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    const double length = vec_distance(s->a, s->b);
    const fw_geometry_vec2 u = vec_scale(1 / length, vec_sub(s->b, s->a)), r = vec_sub(p, s->a);
    const double t = vec_dot(r, u);
    return fabs(vec_cross(u, r)) <= ONE_PLACE_M && t >= -ONE_PLACE_M && t <= length + ONE_PLACE_M
               ? t
               : (double)NAN;
}

/* puts the part from b to a, which a cell has from a to b, into edge i of an outline as a joint */
static fw_status split(fw_arena *arena, fw_geometry_contour *c, int i, fw_geometry_vec2 a,
                       fw_geometry_vec2 b) {
    const fw_geometry_segment s = c->segment[i];
    fw_geometry_segment *list = fw_arena_array(arena, fw_geometry_segment, (size_t)c->count + 2);
    int n = 0;
    FW_NEED(list);
    for (int k = 0; k < c->count; k++) {
        if (k != i) {
            list[n++] = c->segment[k];
            continue;
        }
        fw_geometry_segment part = s;
        if (!near_to(s.a, b)) part.b = b, list[n++] = part;
        part = s;
        part.a = near_to(s.a, b) ? s.a : b, part.b = near_to(s.b, a) ? s.b : a;
        part.flags |= FW_SEGMENT_JOINT;
        list[n++] = part;
        part = s;
        if (!near_to(s.b, a)) part.a = a, list[n++] = part;
    }
    *c = (fw_geometry_contour){.segment = list, .count = n};
    return FW_OK;
}

/* the edge of `q` that an edge of what is left of a cell lies on, the other way round; -1: none */
static int edge_under(const fw_geometry_contour *q, const fw_geometry_segment *s) {
    for (int i = 0; i < q->count; i++) {
        const fw_geometry_segment *t = &q->segment[i];
        if (t->kind != FW_LINE || t->flags & FW_SEGMENT_JOINT) continue;
        const double a = on_line(t, s->a), b = on_line(t, s->b);
        if (a > b) return i; /* false where one is NaN */
    }
    return -1;
}

/* an outline of what is left of a cell that something lies wholly inside of; -1: there is none */
static int hole_of(const fw_geometry_region *left) {
    for (int k = 0; k < left->count; k++)
        if (fw_geometry_contour_area(&left->contour[k]) < 0) return k;
    return -1;
}

/* joints are lines: arcs near a cell become chords within the tolerance, as they are on the mask */
static fw_status straighten(uniter *u, fw_geometry_contour *q, fw_geometry_box near) {
    int most = 0, n = 0;
    for (int i = 0; i < q->count; i++) {
        const fw_geometry_segment *s = &q->segment[i];
        most += s->kind == FW_ARC && fw_box_gap(fw_segment_box(s), near) <= ONE_PLACE_M;
    }
    if (most == 0) return FW_OK;
    enum { CHORDS = 512 };
    fw_geometry_segment *list =
        fw_arena_array(u->arena, fw_geometry_segment, (size_t)q->count + CHORDS * (size_t)most);
    FW_NEED(list);
    for (int i = 0; i < q->count; i++) {
        const fw_geometry_segment *s = &q->segment[i];
        const bool bends = s->kind == FW_ARC && fw_box_gap(fw_segment_box(s), near) <= ONE_PLACE_M;
        const double turn = 2 * acos(fmax(1 - u->tolerance_m / s->radius, -1));
        const int parts = bends ? (int)fmin(ceil(fabs(s->sweep_rad) / turn), CHORDS) : 1;
        fw_geometry_vec2 from = s->a;
        for (int k = 1; k <= parts; k++) {
            fw_geometry_segment part = *s;
            if (bends) part = (fw_geometry_segment){.kind = FW_LINE, .flags = s->flags};
            part.a = from;
            part.b = from = k < parts ? fw_geometry_segment_point(s, (double)k / parts) : s->b;
            list[n++] = part;
        }
    }
    *q = (fw_geometry_contour){.segment = list, .count = n};
    return FW_OK;
}

/* cuts lines of c where an outline has corners on them, so that each then lies on one edge of it at most */
static fw_status cut_at_corners(const uniter *u, fw_geometry_contour *c,
                                const fw_geometry_contour *q) {
    for (int j = 0; j < q->count; j++) {
        const fw_geometry_vec2 corner = q->segment[j].a;
        for (int i = 0; i < c->count; i++) {
            const fw_geometry_segment s = c->segment[i];
            if (s.kind != FW_LINE || near_to(s.a, corner) || near_to(s.b, corner) ||
                !isfinite(on_line(&s, corner)))
                continue;
            const size_t had = (size_t)c->count;
            fw_geometry_segment *list =
                fw_arena_grow(u->arena, c->segment, had, had + 1, sizeof *list);
            FW_NEED(list);
            for (int k = c->count++; k > i; k--)
                list[k] = list[k - 1];
            list[i].b = list[i + 1].a = corner;
            c->segment = list;
            break;
        }
    }
    return FW_OK;
}

/* joints of both along the edges that they share now; ends of edges take the bits of those of the other */
static fw_status join_edges(uniter *u, fw_geometry_contour *q, fw_geometry_contour *c,
                            int *joined) {
    FW_TRY(cut_at_corners(u, c, q));
    for (int i = 0; i < c->count; i++) {
        fw_geometry_segment *s = &c->segment[i];
        const int under = s->kind == FW_LINE ? edge_under(q, s) : -1;
        if (under < 0) continue;
        const fw_geometry_segment *t = &q->segment[under];
        fw_geometry_segment *before = &c->segment[(i + c->count - 1) % c->count],
                            *after = &c->segment[(i + 1) % c->count];
        if (near_to(s->a, t->b)) s->a = before->b = t->b;
        if (near_to(s->b, t->a)) s->b = after->a = t->a;
        s->flags |= FW_SEGMENT_JOINT;
        ++*joined;
        FW_TRY(split(u->arena, q, under, s->a, s->b));
    }
    return FW_OK;
}

static fw_status add_shape(uniter *u, const fw_mask_shape *shape) {
    if (u->n == u->room) {
        const int more = 2 * u->room;
        FW_NEED(u->shape = fw_arena_grow(u->arena, u->shape, (size_t)u->n, (size_t)more,
                                         sizeof *u->shape));
        u->room = more;
    }
    u->shape[u->n++] = *shape;
    return FW_OK;
}

/* adds a region in parts without holes, of which neighbours share an edge along each cut; `most` cuts at the most */
static fw_status part_at_holes(uniter *u, const fw_geometry_region *left, int most,
                               fw_geometry_region *parts) {
    const int hole = hole_of(left);
    if (hole < 0) {
        const size_t had = (size_t)parts->count, more = had + (size_t)left->count;
        FW_NEED(parts->contour =
                    fw_arena_grow(u->arena, parts->contour, had, more, sizeof *parts->contour));
        for (int k = 0; k < left->count; k++)
            parts->contour[parts->count++] = left->contour[k];
        return FW_OK;
    }
    if (most == 0) return FW_GEOMETRY;
    const fw_geometry_box inner = fw_geometry_contour_box(&left->contour[hole]);
    fw_geometry_box all = inner;
    for (int k = 0; k < left->count; k++)
        all = fw_box_join(all, fw_geometry_contour_box(&left->contour[k]));
    const double beyond = all.x1 - all.x0, cut = 0.5 * (inner.x0 + inner.x1);
    for (int side = 0; side < 2; side++) {
        const fw_geometry_box half = {side ? cut : all.x0 - beyond, all.y0 - beyond,
                                      side ? all.x1 + beyond : cut, all.y1 + beyond};
        fw_geometry_contour around;
        fw_geometry_region one;
        FW_TRY(fw_geometry_contour_rectangle(u->arena, half, &around));
        const fw_geometry_region within = {&around, 1};
        FW_TRY(fw_geometry_region_boolean(u->arena, left, &within, FW_INTERSECTION, &one));
        FW_TRY(part_at_holes(u, &one, most - 1, parts));
    }
    return FW_OK;
}

/* a cell around something: what is left of it in parts that are joined to each other */
static fw_status surround(uniter *u, fw_geometry_region *left) {
    enum { CUTS = 32 };
    fw_geometry_region parts = {NULL, 0};
    int joined = 0;
    if (hole_of(left) < 0) return FW_OK;
    FW_TRY(part_at_holes(u, left, CUTS, &parts));
    for (int i = 0; i < parts.count; i++)
        for (int j = i + 1; j < parts.count; j++)
            FW_TRY(join_edges(u, &parts.contour[i], &parts.contour[j], &joined));
    *left = parts;
    return FW_OK;
}

/* takes what q has in common with cell k off it. *gone: nothing is left */
static fw_status take_off(uniter *u, int k, int q, bool *gone) {
    fw_geometry_region left;
    fw_geometry_contour together = u->shape[q].contour;
    FW_TRY(straighten(u, &together, fw_geometry_contour_box(&u->shape[k].contour)));
    const fw_geometry_region cell = {&u->shape[k].contour, 1}, other = {&together, 1};
    int joined = 0;
    fw_status status = fw_geometry_region_boolean(u->arena, &cell, &other, FW_DIFFERENCE, &left);
    *gone = status == FW_OK && left.count == 0;
    if (status == FW_OK) status = surround(u, &left);
    if (status == FW_GEOMETRY || *gone) return FW_OK;
    FW_TRY(status);
    for (int i = 0; i < left.count; i++)
        FW_TRY(join_edges(u, &together, &left.contour[i], &joined));
    /* edges that others have joined already are no more to be joined, but what they are around of is taken off */
    double taken = fw_geometry_contour_area(&u->shape[k].contour);
    for (int i = 0; i < left.count; i++)
        taken -= fw_geometry_contour_area(&left.contour[i]);
    if (joined == 0 && !(taken > LEAST_M2)) return FW_OK;
    u->shape[q].contour = together;
    for (int i = 0; i < left.count; i++) {
        fw_mask_shape own = u->shape[k];
        own.contour = left.contour[i];
        if (i == 0)
            u->shape[k] = own;
        else
            FW_TRY(add_shape(u, &own));
    }
    return FW_OK;
}

static void drop(uniter *u, int k) {
    for (u->n--; k < u->n; k++)
        u->shape[k] = u->shape[k + 1];
}

static int shapes_of(const uniter *u, const fw_layout_cell *cell) {
    int n = 0;
    for (int k = 0; k < u->n; k++)
        n += fw_layout_cell_of(u->layout, u->shape[k].piece) == cell;
    return n;
}

/* had: (ncell) of how many shapes each was: of one that lies within what is drawn anyway nothing can be seen */
static fw_status tell_gone(const uniter *u, const int *had, fw_diags *diags) {
    for (int i = 0; i < u->layout->ncell; i++) {
        const fw_layout_cell *cell = &u->layout->cell[i];
        if (had[i] == 0 || shapes_of(u, cell) > 0) continue;
        if (fw_diag_said(diags, 722, cell->of->layers_place)) continue;
        fw_diag_warning(diags, 722, cell->of->layers_place,
                        "nothing of %s is on the mask: it lies within what is drawn there; "
                        "send it to text, which is taken out of the frame (layers=\"FROM>text\"), "
                        "or move it to where nothing is drawn",
                        cell->label);
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_mask_cells_unite(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                              fw_diags *diags) {
    uniter u = {arena, layout, mask->tolerance_m, mask->shape, mask->nshape, mask->nshape};
    if (layout->ncell == 0) return FW_OK;
    int *had = fw_arena_array(arena, int, (size_t)layout->ncell);
    FW_NEED(had);
    for (int i = 0; i < layout->ncell; i++)
        had[i] = shapes_of(&u, &layout->cell[i]);
    for (int k = 0; k < u.n; k++) {
        bool gone = false;
        if (!fw_layout_cell_of(layout, u.shape[k].piece) || !stands(&u, k)) continue;
        for (int q = 0; q < u.n && !gone; q++) {
            const bool later = fw_layout_cell_of(layout, u.shape[q].piece) && q >= k;
            if (later || u.shape[q].layer != u.shape[k].layer || !stands(&u, q) ||
                u.shape[q].piece->label == u.shape[k].piece->label ||
                fw_box_gap(fw_geometry_contour_box(&u.shape[q].contour),
                           fw_geometry_contour_box(&u.shape[k].contour)) > ONE_PLACE_M)
                continue;
            FW_TRY(take_off(&u, k, q, &gone));
        }
        if (gone) drop(&u, k--);
    }
    mask->shape = u.shape;
    mask->nshape = u.n;
    return tell_gone(&u, had, diags);
}
