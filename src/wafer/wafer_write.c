/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plate as the formats of masks take it, and as the mask shop writes it. */
#include "geometry/segment.h"
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>
#include <stdio.h>

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
   The layers of the order joined to one, cell by cell, mirrored as
   the plate is read. Dies are still cells. Cells do not overlap: the letters of a die's id lie in a window
   of its frame, which the cells of rows and columns draw and dies leave out. */

static fw_mask_window moved(fw_mask_window w, int32_t dx, int32_t dy) {
    return (fw_mask_window){w.x0 - dx, w.y0 - dy, w.x1 - dx, w.y1 - dy};
}

/* the layer that is whole where ids are */
static int frame_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_FRAME) return k;
    return -1;
}

static fw_mask_merge_options options_for(const fw_wafer *w, const fw_wafer_cell *c,
                                         fw_mask_merge_options o) {
    fw_mask_window whole = w->id_window[0];
    whole.x1 = w->id_window[1].x1;
    o.under = -1;
    switch (c->kind) {
    case FW_WAFER_CELL_OTHER:
        break;
    case FW_WAFER_CELL_DIE:
        if (w->ids) o.window = moved(whole, c->dx, c->dy);
        break;
    case FW_WAFER_CELL_ROW:
    case FW_WAFER_CELL_COLUMN:
        o.window = moved(w->id_window[c->kind == FW_WAFER_CELL_COLUMN], c->dx, c->dy);
        o.under = frame_layer(w->table);
        break;
    }
    return o;
}

static void add_up(fw_mask_merge_sums *all, const fw_mask_merge_sums *s, double times) {
    all->polygons += times * s->polygons;
    all->vertices += times * s->vertices;
    all->cuts += times * s->cuts;
    all->holes += times * s->holes;
    all->area_m2 += times * s->area_m2;
    all->rounded += s->rounded;
}

/* of an array: mirrored, its last column is its first */
static fw_mask_plate_place place_of(const fw_wafer_run *r, bool mirror) {
    int32_t x = mirror ? -(r->x + (r->columns - 1) * r->step_x) : r->x;
    return (fw_mask_plate_place){r->cell, x, r->y, r->columns, r->rows, r->step_x, r->step_y};
}

static bool mirrored(const fw_wafer *w, const fw_mask_order *order) {
    switch (w->device->wafer.order.mirror) {
    case FW_MIRROR_YES:
        return true;
    case FW_MIRROR_NO:
        return false;
    case FW_MIRROR_READ:
        break;
    }
    return order->mirror == 1;
}

fw_status fw_wafer_written_of(fw_arena *arena, const fw_wafer *w, fw_wafer_written *out) {
    fw_mask_order order;
    const fw_mask *any = w->ncell > 0 ? w->cell[0].mask : w->plate;
    fw_mask_merge_options base = {.under = -1, .vertices = any->vertex_limit};
    fw_mask_plate_cell *cell = fw_arena_array(arena, fw_mask_plate_cell, (size_t)w->ncell);
    fw_mask_plate_place *place = fw_arena_array(arena, fw_mask_plate_place, (size_t)w->nrun);
    FW_NEED(cell && place ? cell : NULL);
    FW_TRY(fw_mask_order_gather(arena, any, w->table->device_plate, &order));
    FW_TRY(fw_mask_written_table(arena, w->table, &base.written));
    base.mirror = mirrored(w, &order);
    *out =
        (fw_wafer_written){.mirrored = base.mirror, .cells = w->ncell + 1, .references = w->nrun};
    for (int c = 0; c < w->ncell; c++) {
        fw_mask_merge_options o = options_for(w, &w->cell[c], base);
        fw_mask_merge_sums sums;
        cell[c].name = w->cell[c].name;
        FW_TRY(fw_mask_merged(arena, w->cell[c].mask, &o, &cell[c].mask, &sums));
        add_up(&out->sums, &sums, w->cell[c].placed);
    }
    for (int i = 0; i < w->nrun; i++)
        place[i] = place_of(&w->run[i], base.mirror);
    const fw_mask *drawn = NULL;
    if (w->plate) {
        fw_mask_merge_sums sums;
        FW_TRY(fw_mask_merged(arena, w->plate, &base, &drawn, &sums));
        add_up(&out->sums, &sums, 1);
    }
    out->plate = (fw_mask_plate){.table = base.written,
                                 .top = w->top,
                                 .title = w->title,
                                 .flow = w->flow,
                                 .rejected = w->rejected,
                                 .edge_m = w->form.plate_m,
                                 .cell = cell,
                                 .ncell = w->ncell,
                                 .place = place,
                                 .nplace = w->nrun,
                                 .drawn = drawn};
    return FW_OK;
}

fw_status fw_wafer_write_written(const fw_wafer_written *written, const fw_mask_format *format,
                                 fw_text *out) {
    return format->plate(&written->plate, out);
}
