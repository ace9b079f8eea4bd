/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mask to look at: what is drawn, and a rectangle for each finding on a layer that the table does
   not use, with a data type for each kind of rule. A marker is the place itself where that is a
   window, an island or a hole; else the shortest chord, edge or corner with its own length, at
   least 1 um, on all sides. */
#include "mask/findings.h"
#include "mask/rule.h"
#include <math.h>
#include <string.h>

enum { HIGHEST = 60 };
static const double GRID_M = 1e-9, LEAST_M = 1e-6;

int fw_mask_marker_layer(const fw_mask_table *table) {
    for (int layer = HIGHEST; layer > 0; layer--) {
        bool used = false;
        for (int k = 0; k < table->nlayer; k++)
            used = used || table->layer[k].layer == layer;
        if (!used) return layer;
    }
    return HIGHEST;
}

fw_geometry_box fw_mask_marker(const fw_mask_finding *f) {
    const fw_mask_rule_kind_row *kind = f->rule->kind;
    if (kind->unit == FW_UNIT_SHARE || kind->unit == FW_UNIT_AREA) return f->box;
    double more = fmax(LEAST_M, vec_distance(f->at[0], f->at[1]));
    fw_geometry_box b = fw_mask_box_around(f->at[0], f->at[1]);
    return (fw_geometry_box){b.x0 - more, b.y0 - more, b.x1 + more, b.y1 + more};
}

/* what lies beyond 2^30 nm is refused, but there can be findings all the same */
static int32_t on_grid(double x_dbu) {
    return (int32_t)fmax(-1073741823.0, fmin(1073741823.0, x_dbu));
}

static fw_status mark(fw_arena *arena, const fw_mask_finding *f, int layer, fw_mask_shape *out) {
    fw_geometry_box b = fw_mask_marker(f);
    int32_t x0 = on_grid(floor(b.x0 / GRID_M)), x1 = on_grid(ceil(b.x1 / GRID_M));
    int32_t y0 = on_grid(floor(b.y0 / GRID_M)), y1 = on_grid(ceil(b.y1 / GRID_M));
    fw_layout_piece *piece = fw_arena_one(arena, fw_layout_piece);
    FW_NEED(piece);
    *piece = (fw_layout_piece){
        .role = FW_ROLE_MARK, .body = FW_NONE, .joint = FW_NONE, .label = f->what};
    fw_geometry_point *v = fw_arena_array(arena, fw_geometry_point, 4);
    FW_NEED(v);
    v[0] = (fw_geometry_point){x0, y0}, v[1] = (fw_geometry_point){x1, y0};
    v[2] = (fw_geometry_point){x1, y1}, v[3] = (fw_geometry_point){x0, y1};
    *out = (fw_mask_shape){.layer = layer, .piece = piece, .polygon = {v, 4}};
    fw_geometry_box grid = {x0 * GRID_M, y0 * GRID_M, x1 * GRID_M, y1 * GRID_M};
    return fw_geometry_contour_rectangle(arena, grid, &out->contour);
}

/* the table with a marker layer for each kind that was found; by[kind's marker]: its index */
static fw_status marked_table(fw_arena *arena, const fw_mask *mask, int by[64],
                              fw_mask_table *table) {
    size_t kinds = 0;
    while (fw_mask_rule_kind_at(kinds))
        kinds++;
    *table = *mask->table;
    table->layer = fw_arena_array(arena, fw_mask_layer, (size_t)table->nlayer + kinds);
    FW_NEED(table->layer);
    memcpy(table->layer, mask->table->layer, (size_t)table->nlayer * sizeof *table->layer);
    int number = fw_mask_marker_layer(mask->table);
    for (size_t i = 0; i < kinds; i++) {
        const fw_mask_rule_kind_row *kind = fw_mask_rule_kind_at(i);
        by[kind->marker] = -1;
        for (int k = 0; k < mask->nfinding && by[kind->marker] < 0; k++)
            if (mask->finding[k].rule->kind == kind) by[kind->marker] = table->nlayer;
        if (by[kind->marker] < 0) continue;
        const char *name = fw_arena_printf(arena, "BAD_%s", kind->name);
        FW_NEED(name);
        table->layer[table->nlayer++] =
            (fw_mask_layer){.layer = number,
                            .datatype = kind->marker,
                            .id = name,
                            .name = name,
                            .purpose = "places where this rule is broken, not on the plate",
                            .tone = "data dark",
                            .colour = "#d01020"};
    }
    return FW_OK;
}

fw_status fw_mask_marked(fw_arena *arena, const fw_mask *mask, const fw_mask **marked) {
    fw_mask_table *table = fw_arena_one(arena, fw_mask_table);
    fw_mask *m = fw_arena_one(arena, fw_mask);
    int by[64];
    FW_NEED(table);
    FW_NEED(m);
    FW_TRY(marked_table(arena, mask, by, table));
    *m = *mask;
    m->table = table;
    m->measure = NULL; /* of what is drawn only */
    m->nshape = 0;
    m->shape = fw_arena_array(arena, fw_mask_shape, (size_t)(mask->nshape + mask->nfinding));
    FW_NEED(m->shape);
    for (int i = 0; i < mask->nshape; i++) /* one that could not be flattened has no polygon */
        if (mask->shape[i].polygon.count > 0) m->shape[m->nshape++] = mask->shape[i];
    for (int i = 0; i < mask->nfinding; i++) {
        const fw_mask_finding *f = &mask->finding[i];
        fw_mask_shape *shape = &m->shape[m->nshape++];
        FW_TRY(mark(arena, f, by[f->rule->kind->marker], shape));
        m->box = fw_box_join(m->box, fw_geometry_contour_box(&shape->contour));
    }
    *marked = m;
    return FW_OK;
}
