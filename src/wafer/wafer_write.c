/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plate as the formats of masks take it, and as the mask shop writes it.
   And the order sheet of a plate of the layered file, for people: ASCII, to be pasted into a shop's form. */
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "wafer/wafer.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

const fw_wafer_site *fw_wafer_nearest_die(const fw_wafer *w, double x, double y,
                                          const fw_wafer_site *const *before, int n) {
    const fw_wafer_site *best = NULL;
    double least = HUGE_VAL;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        bool taken = s->kind != FW_WAFER_DIE;
        for (int k = 0; k < n; k++)
            taken = taken || before[k] == s;
        double away = hypot(s->x + 0.5 * w->grid.width - x, s->y + 0.5 * w->grid.height - y);
        if (taken || away >= least) continue;
        least = away;
        best = s;
    }
    return best;
}

/* ---- the whole plate ----
   Places to measure are those of the die nearest to the centre, in coordinates of the plate. */

static void lengths(fw_text *out, const char *what, double a_m, const char *between, double b_m) {
    char a[32], b[32], line[160];
    fw_number_text(a, sizeof a, a_m * 1e3, 9);
    fw_number_text(b, sizeof b, b_m * 1e3, 9);
    snprintf(line, sizeof line, "%s%s%s%s", a, between, b, " mm");
    fw_mask_order_line(out, what, line);
}

static void head(const fw_wafer *w, const fw_mask_order *order, fw_text *out) {
    if (w->rejecting) fw_mask_order_rejected(out, w->rejecting);
    bool several = fw_mask_plates(w->table) > 1;
    fw_text_printf(out, "Order sheet of plate %s-%s%s%s (flexwright " FW_VERSION ")\n\n", w->top,
                   w->flow, several ? "-" : "",
                   several ? fw_mask_plate_at(w->table, order->plate_index).id : "");
    fw_mask_order_line(out, "device", w->device->name);
    fw_mask_order_line(out, "title", w->title);
    fw_mask_order_line(out, "flow", w->flow);
    fw_mask_order_line(out, "top cell", w->top);
    lengths(out, "plate", w->form.plate_m, " mm x ", w->form.plate_m);
    lengths(out, "wafer", w->form.diameter_m, " mm, in the plate's middle; edge exclusion ",
            w->form.edge_m);
    fw_mask_order_set_lines(out, w->table, order);
    fw_mask_order_plate_lines(out, "layers on the plate", w->table, order);
}

static void content_of_layers(const fw_wafer *w, const fw_mask_order *order, const fw_mask *any,
                              const fw_wafer_sum *s, fw_text *out) {
    double width = HUGE_VAL, space = HUGE_VAL, polygons = 0, vertices = 0;
    bool unfinished = false;
    for (int k = 0; k < w->table->nlayer; k++) {
        if (!order->plate[k]) continue;
        width = fmin(width, s[k].width_m);
        space = fmin(space, s[k].space_m);
        unfinished = unfinished || s[k].unfinished;
        polygons += s[k].polygons;
        vertices += s[k].vertices;
    }
    fw_mask_order_size_lines(out, width, space, unfinished, any, order->plate_index);
    fw_mask_order_extent_line(out, fw_wafer_extent(w));
    fw_text_printf(out, "%-22s %d dies, %d alignment sites, %d test dies\n", "places", w->dies,
                   w->alignments, w->tests);
    fw_text_printf(out, "%-22s %d, %d references\n", "cells", w->ncell + 1, w->nrun);
    fw_text_printf(out, "%-22s ", "polygons, flat");
    fw_text_number(out, polygons, 15);
    fw_text_add(out, ", ");
    fw_text_number(out, vertices, 15);
    fw_text_add(out, " vertices\n");
}

static void sites_of_middle(const fw_wafer *w, const fw_mask_order *order, const fw_wafer_site *die,
                            fw_geometry_vec2 shift, fw_text *out) {
    char name[2 * FW_WAFER_NAME];
    int wide = fw_mask_order_gds_width(w->table);
    fw_text_printf(out,
                   "\nCD sites in die %s: centre of the chord from the plate's middle and its "
                   "direction, um and degrees\n",
                   fw_wafer_site_name(w, die, name));
    fw_mask_order_site_heading(out, "layer", wide);
    for (int i = 0; i < order->nsite; i++) {
        const fw_mask_order_site *s = &order->site[i];
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        char gds[FW_MASK_GDS_TEXT];
        fw_mask_order_site_row(out, i + 1, fw_mask_order_gds(gds, &w->table->layer[s->layer]), wide,
                               s, vec_add(at, shift), along);
    }
}

fw_status fw_wafer_write_order(const fw_wafer *w, int plate, const fw_output_file *file, int nfile,
                               fw_text *out) {
    const fw_wafer_site *die = fw_wafer_nearest_die(w, 0, 0, NULL, 0);
    if (!die) return FW_INTERNAL; /* test dies leave one */
    const fw_wafer_variant *v = &w->variant[die->variant];
    if (fw_wafer_stood_in(v)) v = &w->stand_in;
    fw_mask_order order;
    fw_wafer_sum *s;
    int32_t dx, dy;
    FW_TRY(fw_mask_order_gather(out->arena, v->mask, plate, &order));
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    fw_wafer_origin(&w->grid, v->die, &dx, &dy);
    head(w, &order, out);
    content_of_layers(w, &order, v->mask, s, out);
    sites_of_middle(w, &order, die, (fw_geometry_vec2){(die->x + dx) * 1e-9, (die->y + dy) * 1e-9},
                    out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}

/* ---- as it is drawn ----
   Cells, arrays and lines of text. */

enum { LINE_PITCH_DBU = 1000000 };

static fw_status plate_of(fw_arena *arena, const fw_wafer *w, fw_mask_plate *plate) {
    fw_mask_plate_cell *cell = fw_arena_array(arena, fw_mask_plate_cell, (size_t)w->ncell);
    fw_mask_plate_place *place = fw_arena_array(arena, fw_mask_plate_place, (size_t)w->nrun);
    FW_NEED(cell);
    FW_NEED(place);
    for (int c = 0; c < w->ncell; c++)
        cell[c] = (fw_mask_plate_cell){w->cell[c].name, w->cell[c].mask};
    for (int i = 0; i < w->nrun; i++) {
        const fw_wafer_run *r = &w->run[i];
        place[i] =
            (fw_mask_plate_place){r->cell, r->x, r->y, r->columns, r->rows, r->step_x, r->step_y};
    }
    /* in the left upper corner, below the fiducial: texts too stay within the plate */
    int32_t half = (int32_t)lround(0.5 * w->form.plate_m * 1e9);
    *plate = (fw_mask_plate){.table = w->table,
                             .top = w->top,
                             .title = w->title,
                             .flow = w->flow,
                             .rejected = w->rejected,
                             .edge_m = w->form.plate_m,
                             .cell = cell,
                             .ncell = w->ncell,
                             .place = place,
                             .nplace = w->nrun,
                             .drawn = w->plate,
                             .note_x = LINE_PITCH_DBU - half,
                             .note_y = half - 12 * LINE_PITCH_DBU,
                             .note_step = -LINE_PITCH_DBU};
    return fw_wafer_notes(arena, w, &plate->note, &plate->nnote);
}

fw_status fw_wafer_write_format(const fw_wafer *w, const fw_mask_format *format, fw_text *out) {
    fw_mask_plate plate;
    FW_TRY(plate_of(out->arena, w, &plate));
    return format->plate(&plate, out);
}

fw_status fw_wafer_write_gds(const fw_wafer *w, fw_text *out) {
    fw_mask_plate plate;
    FW_TRY(plate_of(out->arena, w, &plate));
    return fw_mask_plate_gds(&plate, out);
}

/* ---- as it is written ----
   The layers of one plate's order joined to one, cell by cell. Dies are still cells. Cells do not overlap:
   the letters of a die's id lie in a window of its frame, which the cells of rows and columns draw and dies
   leave out. Of the other tone each cell writes what it leaves free of its place, and the top cell what
   the places leave free.

   Scale: vertices of a cell, its place and its windows are each rounded to the grid, so that cells share the
   edges that they shared; places stand on a lattice of the rounded pitch, which is off by at most half a
   nanometre a step. Test: test_wafer_written.c, tests/accept/wafer.sh. */

typedef struct pen {
    fw_arena *arena;
    const fw_wafer *wafer;
    fw_mask_merge_options base;
    bool ids; /* the plate draws the frame, in which they lie */
    double scale;
    fw_mask_plate_cell *cell; /* (ncell) those that draw something */
    int *as, ncell;           /* as: of each cell of the wafer; -1: nothing */
    fw_mask_plate_place *place;
    int nplace;
} pen;

static int32_t scaled(const pen *p, int64_t v) {
    return (int32_t)llround((double)v * p->scale);
}

/* of a place that is whole steps from the first one */
static int32_t on_lattice(const pen *p, int64_t at, int64_t first, int32_t pitch) {
    return scaled(p, first) + (int32_t)((at - first) / pitch) * scaled(p, pitch);
}

/* of a place, in coordinates of a cell, as written */
static fw_mask_window in_cell(const pen *p, const fw_wafer_cell *c, fw_mask_window w) {
    int32_t dx = scaled(p, c->dx), dy = scaled(p, c->dy);
    return (fw_mask_window){scaled(p, w.x0) - dx, scaled(p, w.y0) - dy, scaled(p, w.x1) - dx,
                            scaled(p, w.y1) - dy};
}

static bool is_lettering(const fw_wafer_cell *c) {
    return c->kind == FW_WAFER_CELL_ROW || c->kind == FW_WAFER_CELL_COLUMN;
}

/* the layer that is whole where ids are */
static int frame_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_FRAME) return k;
    return -1;
}

static fw_mask_merge_options options_for(const pen *p, const fw_wafer_cell *c,
                                         fw_mask_window *window) {
    const fw_wafer *w = p->wafer;
    const fw_mask_window place = {0, 0, w->grid.width, w->grid.height};
    fw_mask_merge_options o = p->base;
    fw_mask_window own = w->id_window[c->kind == FW_WAFER_CELL_COLUMN];
    if (c->kind == FW_WAFER_CELL_DIE) own.x1 = w->id_window[1].x1;
    *window = in_cell(p, c, own);
    o.scale = p->scale;
    o.field = is_lettering(c) ? *window : in_cell(p, c, place);
    if (!p->ids || c->kind == FW_WAFER_CELL_OTHER) return o;
    o.window = window;
    o.nwindow = 1;
    if (is_lettering(c)) o.under = frame_layer(w->table);
    return o;
}

static void add_up(fw_mask_merge_sums *all, const fw_mask_merge_sums *s, double times) {
    all->polygons += times * s->polygons;
    all->vertices += times * s->vertices;
    all->cuts += times * s->cuts;
    all->holes += times * s->holes;
    all->area_m2 += times * s->area_m2;
    all->clear_m = fmin(all->clear_m, s->clear_m);
    all->rounded += s->rounded;
}

static fw_status write_cells(pen *p, fw_wafer_written *out) {
    const fw_wafer *w = p->wafer;
    for (int c = 0; c < w->ncell; c++) {
        const fw_wafer_cell *cell = &w->cell[c];
        fw_mask_window window;
        fw_mask_merge_options o = options_for(p, cell, &window);
        fw_mask_merge_sums sums;
        const fw_mask *mask;
        p->as[c] = -1;
        if (is_lettering(cell) && !p->ids) continue;
        FW_TRY(fw_mask_merged(p->arena, cell->mask, &o, &mask, &sums));
        if (mask->nshape == 0) continue;
        p->as[c] = p->ncell;
        p->cell[p->ncell++] = (fw_mask_plate_cell){cell->name, mask};
        add_up(&out->sums, &sums, cell->placed);
    }
    return FW_OK;
}

/* of an array: mirrored, its last column is its first */
static void write_places(pen *p) {
    const fw_wafer *w = p->wafer;
    const fw_wafer_grid *g = &w->grid;
    for (int i = 0; i < w->nrun; i++) {
        const fw_wafer_run *r = &w->run[i];
        const fw_wafer_cell *c = &w->cell[r->cell];
        if (p->as[r->cell] < 0) continue;
        int32_t x = on_lattice(p, (int64_t)r->x - c->dx, g->site[0].x, g->pitch_x);
        int32_t y = on_lattice(p, (int64_t)r->y - c->dy, g->site[0].y, g->pitch_y);
        int32_t step_x = r->step_x / g->pitch_x * scaled(p, g->pitch_x);
        int32_t step_y = r->step_y / g->pitch_y * scaled(p, g->pitch_y);
        x += scaled(p, c->dx);
        if (p->base.mirror) x = -(x + (r->columns - 1) * step_x);
        p->place[p->nplace++] = (fw_mask_plate_place){
            p->as[r->cell], x, y + scaled(p, c->dy), r->columns, r->rows, step_x, step_y};
    }
}

static const double FREE_RIM_M = 4e-3; /* of the plate: nothing is written there */

/* places that cells write of the other tone themselves */
static fw_status taken_places(const pen *p, fw_mask_merge_options *o) {
    const fw_wafer_grid *g = &p->wafer->grid;
    fw_mask_window *list = fw_arena_array(p->arena, fw_mask_window, (size_t)g->nsite);
    FW_NEED(list);
    o->window = list;
    for (int i = 0; i < p->wafer->nrun; i++) {
        const fw_wafer_run *r = &p->wafer->run[i];
        const fw_wafer_cell *c = &p->wafer->cell[r->cell];
        for (int k = 0; k < r->columns && !is_lettering(c); k++) {
            int32_t x = on_lattice(p, (int64_t)r->x - c->dx + (int64_t)k * r->step_x, g->site[0].x,
                                   g->pitch_x);
            int32_t y = on_lattice(p, (int64_t)r->y - c->dy, g->site[0].y, g->pitch_y);
            list[o->nwindow++] =
                (fw_mask_window){x, y, x + scaled(p, g->width), y + scaled(p, g->height)};
        }
    }
    return FW_OK;
}

/* what of the top cell lies over no wafer, which is as large as the dies are scaled, and mirrored with them. m2 */
static double beyond_wafer(const pen *p, const fw_mask *drawn) {
    fw_wafer_form form = p->wafer->form;
    double area_m2 = 0;
    form.diameter_m *= p->scale, form.flat_m *= p->scale;
    if (p->base.mirror && form.side == FW_SIDE_LEFT)
        form.side = FW_SIDE_RIGHT;
    else if (p->base.mirror && form.side == FW_SIDE_RIGHT)
        form.side = FW_SIDE_LEFT;
    for (int i = 0; i < drawn->nshape; i++) {
        const fw_geometry_polygon *polygon = &drawn->shape[i].polygon;
        area_m2 += 0.5e-18 * (double)fw_geometry_polygon_area2(polygon) -
                   fw_wafer_area_over(&form, polygon);
    }
    return area_m2;
}

/* What lies beside the dies. Title and crosses belong to the plate and stay as they are; cells of the description that
   lie on the wafer are scaled as its dies are. */
static fw_status scales_beside(const pen *p, const fw_mask *plate, const double **out) {
    const bool *on;
    double *scale = fw_arena_array(p->arena, double, (size_t)plate->nshape + 1);
    FW_NEED(scale);
    FW_TRY(fw_wafer_cells_on(p->arena, p->wafer, &on));
    for (int i = 0; i < plate->nshape; i++)
        scale[i] = on[i] ? p->scale : 1;
    *out = scale;
    return FW_OK;
}

static fw_status write_top(pen *p, fw_wafer_written *out, const fw_mask **drawn) {
    const fw_wafer *w = p->wafer;
    fw_mask_merge_options o = p->base;
    fw_mask_merge_sums sums;
    *drawn = NULL;
    out->over_m2 = out->sums.area_m2; /* of dies: all of it */
    if (!w->plate && !o.inverted) return FW_OK;
    fw_mask nothing = *(w->plate ? w->plate : w->cell[0].mask);
    if (!w->plate) nothing.nshape = 0;
    if (w->plate) FW_TRY(scales_beside(p, w->plate, &o.scales));
    if (o.inverted) {
        out->field_m = w->form.plate_m - 2 * FREE_RIM_M;
        int32_t half = (int32_t)lround(0.5e9 * out->field_m);
        o.field = (fw_mask_window){-half, -half, half, half};
        FW_TRY(taken_places(p, &o));
    }
    FW_TRY(fw_mask_merged(p->arena, &nothing, &o, drawn, &sums));
    add_up(&out->sums, &sums, 1);
    out->over_m2 += sums.area_m2 - beyond_wafer(p, *drawn);
    return FW_OK;
}

static bool mirrored(const fw_device_order_asked *asked, const fw_mask_order *order) {
    switch (asked->mirror) {
    case FW_MIRROR_YES:
        return true;
    case FW_MIRROR_NO:
        return false;
    case FW_MIRROR_READ:
        break;
    }
    return order->mirror == 1;
}

static fw_status pen_new(fw_arena *arena, const fw_wafer *w, const fw_wafer_written *out, pen *p) {
    fw_mask_order order;
    const fw_mask *any = w->ncell > 0 ? w->cell[0].mask : w->plate;
    int frame = frame_layer(w->table);
    FW_TRY(fw_mask_order_gather(arena, any, out->of, &order));
    *p = (pen){.arena = arena,
               .wafer = w,
               .ids = w->ids && frame >= 0 && order.plate[frame],
               .scale = out->asked->scale,
               .base = {.plate = out->of,
                        .under = -1,
                        .scale = 1,
                        .vertices = any->vertex_limit,
                        .inverted = out->asked->inverted,
                        .mirror = mirrored(out->asked, &order)}};
    p->cell = fw_arena_array(arena, fw_mask_plate_cell, (size_t)w->ncell);
    p->as = fw_arena_array(arena, int, (size_t)w->ncell);
    p->place = fw_arena_array(arena, fw_mask_plate_place, (size_t)w->nrun);
    FW_NEED(p->cell && p->as && p->place ? p->cell : NULL);
    return fw_mask_written_table(arena, w->table, out->of, p->base.inverted, &p->base.written);
}

fw_status fw_wafer_written_of(fw_arena *arena, const fw_wafer *w, int plate,
                              fw_wafer_written *out) {
    const char *id = fw_mask_plate_at(w->table, plate).id;
    pen p;
    const fw_mask *drawn;
    *out = (fw_wafer_written){.of = plate,
                              .asked = fw_device_order_of(&w->device->wafer, id),
                              .sums = {.clear_m = HUGE_VAL}};
    FW_TRY(pen_new(arena, w, out, &p));
    FW_TRY(write_cells(&p, out));
    write_places(&p);
    FW_TRY(write_top(&p, out, &drawn));
    out->mirrored = p.base.mirror;
    out->cells = p.ncell + 1;
    out->references = p.nplace;
    out->plate = (fw_mask_plate){.table = p.base.written,
                                 .top = w->top,
                                 .title = w->title,
                                 .flow = w->flow,
                                 .rejected = w->rejected,
                                 .edge_m = w->form.plate_m,
                                 .cell = p.cell,
                                 .ncell = p.ncell,
                                 .place = p.place,
                                 .nplace = p.nplace,
                                 .drawn = drawn};
    return FW_OK;
}

fw_status fw_wafer_write_written(const fw_wafer_written *written, const fw_mask_format *format,
                                 fw_text *out) {
    return format->plate(&written->plate, out);
}
