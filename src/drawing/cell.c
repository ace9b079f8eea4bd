/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a drawing that somebody finished to outlines on the grid: which format it is, and its polygons merged for each
   layer that they go to. */
#include "base/sort.h"
#include "base/text.h"
#include "drawing/drawing.h"
#include "geometry/merge.h"
#include "geometry/segment.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double CHORD_M = 5e-9; /* of a DXF file's arcs: as masks have them */

/* ---- DXF ---- */

static size_t byte_of_line(const char *data, size_t n, int line) {
    size_t at = 0;
    for (int i = 1; i < line && at < n; at++)
        i += data[at] == '\n';
    return at;
}

/* what the reader says of a place in the file, at the place that asked for it */
static fw_status say_of_file(const fw_drawing_flat *flat, const char *data, size_t n,
                             const fw_diags *said) {
    const fw_drawing_cell_asked *a = flat->asked;
    for (size_t i = 0; i < said->count; i++) {
        const fw_diag *d = &said->item[i];
        int number = d->number == 314 ? 568 : d->number == 319 ? 567 : 565;
        if (d->place.file != a->file || d->place.line < 1)
            fw_diag_error(flat->diags, number, d->place, "%s", d->message);
        else
            fw_diag_error(flat->diags, number, a->place, "%s, line %d, byte %zu: %s", a->file,
                          d->place.line, byte_of_line(data, n, d->place.line), d->message);
    }
    return said->failed ? FW_NOMEM : FW_INPUT;
}

/* what it passed over: warnings, with the line */
static void tell_of_file(const fw_drawing_flat *flat, const fw_diags *said) {
    const fw_drawing_cell_asked *a = flat->asked;
    for (size_t i = 0; i < said->count; i++)
        fw_diag_warning(flat->diags, said->item[i].number, a->place, "%s, line %d: %s", a->file,
                        said->item[i].place.line, said->item[i].message);
}

static fw_status add_outline(fw_drawing_flat *flat, int map, const fw_drawing_outline *o) {
    fw_geometry_contour moved;
    fw_geometry_polygon polygon;
    fw_geometry_vec2 *at;
    FW_TRY(fw_geometry_contour_transform(flat->arena, &o->contour, flat->asked->pose,
                                         flat->asked->mirrored, &moved));
    FW_TRY(fw_geometry_flatten(flat->arena, &moved, CHORD_M, FW_FLATTEN_INSIDE, &polygon, NULL));
    FW_NEED(at = fw_arena_array(flat->arena, fw_geometry_vec2, (size_t)polygon.count));
    for (int i = 0; i < polygon.count; i++)
        at[i] = (fw_geometry_vec2){polygon.vertex[i].x_dbu, polygon.vertex[i].y_dbu};
    return fw_drawing_flat_add(flat, map, at, polygon.count, o->hole);
}

static fw_status flatten_dxf(fw_drawing_flat *flat, const char *data, size_t n) {
    const fw_drawing_cell_asked *a = flat->asked;
    if (a->cell)
        return fw_diag_error(flat->diags, 568, a->cell_place,
                             "cell is of GDSII files, and %s is none; remove it", a->file);
    for (int i = 0; i < flat->nmap; i++) {
        fw_drawing_asked asked = {.file = a->file,
                                  .segments_most = FW_DRAWING_DXF_MOST,
                                  .outlines_most = FW_DRAWING_PARTS_MOST,
                                  .layer = flat->map[i].from,
                                  .unit = a->unit,
                                  .unit_m = a->unit_m,
                                  .place = a->place,
                                  .unit_place = a->unit_place,
                                  .cell_place = a->cell_place,
                                  .layer_place = a->layers_place};
        fw_diags said = fw_diags_new(flat->arena);
        fw_drawing drawing;
        fw_status status = fw_drawing_read_dxf(flat->arena, data, n, &asked, &said, &drawing);
        if (status == FW_INPUT) return say_of_file(flat, data, n, &said);
        FW_TRY(status);
        tell_of_file(flat, &said);
        flat->map[i].found = true;
        for (int k = 0; k < drawing.count; k++) {
            status = add_outline(flat, i, &drawing.outline[k]);
            if (status != FW_LIMIT && status != FW_GEOMETRY) FW_TRY(status);
            if (status != FW_OK)
                return fw_diag_error(flat->diags, 567, a->place,
                                     "%s, line %d, byte %zu: it is larger than a mask, or vanishes "
                                     "on the 1 nm grid; "
                                     "correct its unit, or where it is placed",
                                     a->file, drawing.outline[k].line,
                                     byte_of_line(data, n, drawing.outline[k].line));
        }
    }
    return FW_OK;
}

/* ---- merging ---- */

typedef struct edge { /* of a polygon, its lesser end first */
    fw_geometry_point low, high;
    int polygon, at;
} edge;

static int by_ends(const void *left, const void *right) {
    const edge *p = left, *q = right;
    int order = fw_order_wholes(fw_geometry_merge_key(p->low), fw_geometry_merge_key(q->low));
    return order ? order
                 : fw_order_wholes(fw_geometry_merge_key(p->high), fw_geometry_merge_key(q->high));
}

/* an edge that two polygons share is inside what was drawn: a cut */
static fw_status mark_cuts(fw_arena *arena, const fw_geometry_merged *merged,
                           fw_geometry_contour *outline) {
    edge *list = fw_arena_array(arena, edge, (size_t)merged->vertices);
    size_t n = 0;
    FW_NEED(list);
    for (int i = 0; i < merged->n; i++)
        for (int k = 0; k < merged->polygon[i].count; k++) {
            const fw_geometry_polygon *p = &merged->polygon[i];
            fw_geometry_point a = p->vertex[k], b = p->vertex[k + 1 < p->count ? k + 1 : 0];
            bool forth = fw_geometry_merge_key(a) < fw_geometry_merge_key(b);
            list[n++] = (edge){forth ? a : b, forth ? b : a, i, k};
        }
    if (n > 0) qsort(list, n, sizeof *list, by_ends);
    for (size_t i = 1; i < n; i++) {
        if (by_ends(&list[i - 1], &list[i]) != 0) continue;
        for (size_t k = i - 1; k <= i; k++)
            outline[list[k].polygon].segment[list[k].at].flags |= FW_SEGMENT_JOINT;
    }
    return FW_OK;
}

static fw_geometry_vec2 in_metres(fw_geometry_point p) {
    return (fw_geometry_vec2){p.x_dbu * FW_GEOMETRY_GRID_M, p.y_dbu * FW_GEOMETRY_GRID_M};
}

fw_status fw_drawing_outline_of(fw_arena *arena, const fw_geometry_polygon *p,
                                fw_geometry_contour *c) {
    FW_NEED(c->segment = fw_arena_array(arena, fw_geometry_segment, (size_t)p->count));
    c->count = p->count;
    for (int k = 0; k < p->count; k++)
        c->segment[k] =
            (fw_geometry_segment){.kind = FW_LINE,
                                  .flags = FW_SEGMENT_ROUNDED,
                                  .a = in_metres(p->vertex[k]),
                                  .b = in_metres(p->vertex[k + 1 < p->count ? k + 1 : 0])};
    return FW_OK;
}

fw_status fw_drawing_outlines_of(fw_arena *arena, const fw_geometry_merged *merged,
                                 fw_geometry_contour **out) {
    FW_NEED(*out = fw_arena_array(arena, fw_geometry_contour, (size_t)merged->n));
    for (int i = 0; i < merged->n; i++)
        FW_TRY(fw_drawing_outline_of(arena, &merged->polygon[i], &(*out)[i]));
    return mark_cuts(arena, merged, *out);
}

static fw_status outlines_of(fw_arena *arena, const fw_geometry_merged *merged,
                             fw_drawing_cell_layer *layer) {
    FW_TRY(fw_drawing_outlines_of(arena, merged, &layer->outline));
    layer->n = merged->n;
    layer->box = (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < merged->n; i++)
        layer->box = fw_box_join(layer->box, fw_geometry_contour_box(&layer->outline[i]));
    return FW_OK;
}

/* all that goes to the layer of map `first`, as one region; holes of a DXF file are cut out */
static fw_status merge_layer(fw_drawing_flat *flat, int first, fw_drawing_cell_layer *layer,
                             size_t *corners, size_t *parts) {
    static const fw_geometry_merge_term terms[] = {{0, FW_SET_OR}, {1, FW_SET_NOT}};
    fw_geometry_merge_input *input =
        fw_arena_array(flat->arena, fw_geometry_merge_input, (size_t)flat->n);
    fw_geometry_merged merged;
    int n = 0;
    bool holes = false;
    FW_NEED(input);
    layer->to = flat->map[first].to;
    for (int i = 0; i < flat->n; i++) {
        const fw_drawing_shape *s = &flat->shape[i];
        if (strcmp(flat->map[s->map].to, layer->to) != 0) continue;
        input[n++] = (fw_geometry_merge_input){&s->polygon, s->hole};
        holes = holes || s->hole;
    }
    fw_status status = fw_geometry_merge(flat->arena, input, n, terms, holes ? 2 : 1,
                                         FW_DRAWING_CORNERS_MOST, &merged);
    if (status == FW_LIMIT)
        return fw_diag_error(flat->diags, 567, flat->asked->place,
                             "%s: its %d polygons lie upon each other so often that to make one "
                             "region of them would take minutes; merge them where they are drawn, "
                             "or let arrays step by more than their cell",
                             flat->asked->file, n);
    FW_TRY(status);
    *corners += (size_t)merged.vertices;
    *parts += (size_t)merged.n;
    if (*corners > FW_DRAWING_CORNERS_MOST || *parts > FW_DRAWING_PARTS_MOST)
        return fw_diag_error(
            flat->diags, 567, flat->asked->place,
            "%s: merged, the cell has more than %d polygons or %d vertices; place a smaller one",
            flat->asked->file, (int)FW_DRAWING_PARTS_MOST, (int)FW_DRAWING_CORNERS_MOST);
    if (merged.n == 0)
        return fw_diag_error(flat->diags, 568, flat->asked->place,
                             "%s: what it draws%s%s has no area, so that nothing of it would be "
                             "on the mask; draw it with a width, or leave it out",
                             flat->asked->file, flat->asked->nmap ? " on layer " : "",
                             flat->asked->nmap ? flat->map[first].from : "");
    return outlines_of(flat->arena, &merged, layer);
}

static bool is_first(const fw_drawing_flat *flat, int map) {
    for (int i = 0; i < map; i++)
        if (strcmp(flat->map[i].to, flat->map[map].to) == 0) return false;
    return true;
}

/* with the layers that hold polygons, where one was asked for */
static fw_status say_nothing(const fw_drawing_flat *flat, const char *from) {
    const fw_drawing_cell_asked *a = flat->asked;
    const int most = sizeof flat->other / sizeof *flat->other;
    fw_text others = fw_text_new(flat->arena);
    fw_text_add(&others, "");
    for (int i = 0; i < flat->nother && i < most; i++)
        fw_text_printf(&others, "%s%d/%d", i == 0 ? "; polygons lie on " : ", ",
                       flat->other[i].layer, flat->other[i].type);
    if (flat->nother > most) fw_text_add(&others, " and others");
    FW_TRY(fw_text_end(&others));
    return fw_diag_error(flat->diags, 568, a->nmap ? a->layers_place : a->place,
                         "%s has no polygon in %s%s%s%s%s", a->file,
                         flat->name ? fw_text_kind("cell ", flat->name) : "it",
                         flat->name ? flat->name : "", a->nmap ? " on layer " : "",
                         a->nmap ? from : "", others.data);
}

static fw_status merge_all(fw_drawing_flat *flat, fw_drawing_cell *out) {
    const fw_drawing_cell_asked *a = flat->asked;
    size_t corners = 0, parts = 0;
    for (int i = 0; i < flat->nmap; i++)
        if (!flat->map[i].found) return say_nothing(flat, flat->map[i].from);
    FW_NEED(out->layer = fw_arena_array(flat->arena, fw_drawing_cell_layer, (size_t)flat->nmap));
    for (int i = 0; i < flat->nmap; i++) {
        if (!is_first(flat, i)) continue;
        FW_TRY(merge_layer(flat, i, &out->layer[out->nlayer], &corners, &parts));
        out->nlayer++;
    }
    if (flat->rounded)
        fw_diag_note(flat->diags, 573, a->place,
                     "%s: %d points do not lie on the 1 nm grid of masks where they are placed, "
                     "and are rounded to it",
                     a->file, flat->rounded);
    return FW_OK;
}

static bool is_named_gds(const char *file) {
    const char *dot = strrchr(file, '.');
    return dot && (dot[1] | 32) == 'g' && (dot[2] | 32) == 'd' && (dot[3] | 32) == 's';
}

/* the first line of a DXF file is a number */
static bool begins_as_dxf(const char *data, size_t n) {
    size_t i = 0;
    while (i < n && (data[i] == ' ' || data[i] == '\t'))
        i++;
    return i < n && data[i] >= '0' && data[i] <= '9';
}

fw_status fw_drawing_cell_read(fw_arena *arena, const char *data, size_t n,
                               const fw_drawing_cell_asked *asked, fw_diags *diags,
                               fw_drawing_cell *out) {
    static const char oasis[] = "%SEMI-OASIS", binary[] = "AutoCAD Binary DXF";
    fw_drawing_flat flat = {.arena = arena, .diags = diags, .asked = asked};
    bool gds = n >= 4 && data[0] == 0 && (data[1] == 4 || data[1] == 6) && data[2] == 0;
    *out = (fw_drawing_cell){0};
    if (n >= sizeof oasis - 1 && memcmp(data, oasis, sizeof oasis - 1) == 0)
        return fw_diag_error(diags, 569, asked->place,
                             "%s is an OASIS file, which is not read; save it as GDSII in KLayout "
                             "(File > Save As), or without a window as `flexwright explain "
                             "FW-D569` says",
                             asked->file);
    if (n >= sizeof binary - 1 && memcmp(data, binary, sizeof binary - 1) == 0)
        return fw_diag_error(diags, 565, asked->place,
                             "%s is a binary DXF file; save it as ASCII DXF", asked->file);
    if (!gds && is_named_gds(asked->file) && !begins_as_dxf(data, n))
        return fw_diag_error(
            diags, 565, asked->place,
            "%s, byte 0: this is no GDSII file as it should be: %s; write it again", asked->file,
            n ? "it does not begin with HEADER" : "it is empty");
    flat.nmap = asked->nmap ? asked->nmap : 1;
    FW_NEED(flat.map = fw_arena_array(arena, fw_drawing_map, (size_t)flat.nmap));
    for (int i = 0; i < asked->nmap; i++)
        flat.map[i] = asked->map[i];
    if (asked->nmap == 0) flat.map[0] = (fw_drawing_map){.to = asked->usual, .layer = -1};
    FW_TRY(gds ? fw_drawing_flatten_gds(&flat, data, n) : flatten_dxf(&flat, data, n));
    out->name = flat.name;
    return merge_all(&flat, out);
}
