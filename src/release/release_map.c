/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distances all over the die, for a picture. */
#include "release/release_field.h"
#include <math.h>

typedef struct raster {
    fw_release_field *field;
    fw_release_map *map;
    double cell_m;
} raster;

/* the cells whose middles lie in the box: half-open, so that each has one box */
static void fill(raster *r, const fw_release_level *level, const fw_release_box *box) {
    fw_release_map *m = r->map;
    double low_x = (box->x - box->half_m - m->box.x0) / r->cell_m - 0.5,
           low_y = (box->y - box->half_m - m->box.y0) / r->cell_m - 0.5;
    double side = 2.0 * box->half_m / r->cell_m;
    int i0 = (int)fmax(ceil(low_x), 0.0), j0 = (int)fmax(ceil(low_y), 0.0);
    for (int j = j0; j < low_y + side && j < m->rows; j++)
        for (int i = i0; i < low_x + side && i < m->columns; i++) {
            fw_geometry_vec2 p = {m->box.x0 + (i + 0.5) * r->cell_m,
                                  m->box.y0 + (j + 0.5) * r->cell_m};
            double near = HUGE_VAL;
            int part =
                box->part == FW_RELEASE_MIXED ? fw_release_field_part(r->field, p) : box->part;
            if (part < 0) continue;
            for (int k = 0; k < box->count; k++) {
                const fw_release_edge *e = &r->field->edge[level->list[box->first + k]];
                if (e->open) near = fmin(near, fw_release_edge_distance(e, p));
            }
            m->distance_m[(size_t)j * (size_t)m->columns + (size_t)i] = (float)near;
        }
}

/* a box is small enough when it has few edges or few cells */
static fw_status look(raster *r, const fw_release_level *level, fw_release_box *box,
                      fw_release_level *next) {
    enum { FEW = 4 };
    if (box->part == FW_RELEASE_MIXED && !fw_release_box_cut(r->field, level, box))
        fw_release_box_settle(r->field, box);
    if (box->part == FW_RELEASE_OPENING) return FW_OK;
    bool small = box->half_m < r->cell_m || (box->part >= 0 && box->count <= FEW);
    if (!small) return fw_release_level_split(r->field, level, box, next);
    fill(r, level, box);
    return FW_OK;
}

fw_status fw_release_map_make(fw_arena *arena, const fw_layout *layout, bool islands, int columns,
                              const fw_release_map **map) {
    fw_release_field field;
    fw_release_part *part;
    fw_release_level level[2] = {{0}, {0}}, *from = &field.start;
    int *part_of, npart;
    fw_release_map *m = fw_arena_one(arena, fw_release_map);
    FW_NEED(m);
    *map = m;
    FW_TRY(fw_release_parts(arena, layout, islands, &part_of, &part, &npart));
    m->box = layout->die;
    m->columns = columns;
    raster r = {&field, m, (m->box.x1 - m->box.x0) / columns};
    m->rows = (int)ceil((m->box.y1 - m->box.y0) / r.cell_m - 1e-9);
    size_t cells = (size_t)m->columns * (size_t)m->rows;
    FW_NEED(m->distance_m = fw_arena_array(arena, float, cells));
    for (size_t i = 0; i < cells; i++)
        m->distance_m[i] = -1.0F;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(fw_release_field_make(arena, layout, part_of, npart, &field));
    if (field.nedge == 0 || npart == 0) return FW_OK;
    FW_TRY(fw_release_field_start(&field));
    for (int k = 0; from->nbox > 0; from = &level[k], k = 1 - k) {
        level[k].nbox = level[k].nlist = 0;
        for (int i = 0; i < from->nbox; i++)
            FW_TRY(look(&r, from, &from->box[i], &level[k]));
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
