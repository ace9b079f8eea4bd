/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distances all over the die, for a picture. */
#include "release/release_field.h"
#include <math.h>

typedef struct raster {
    fw_release_field *field;
    fw_release_map *map;
    double cell_m;
} raster;

/* Material is 0 for a beginning, what is not stays negative. */
static fw_status find_material(raster *r) {
    fw_release_map *m = r->map;
    fw_release_crossing *row =
        fw_arena_raw(r->field->arena, ((size_t)r->field->nclimb + 1) * sizeof *row);
    FW_NEED(row);
    for (int j = 0; j < m->rows; j++) {
        float *to = m->distance_m + (size_t)j * (size_t)m->columns;
        int n = fw_release_field_row(r->field, m->box.y0 + (j + 0.5) * r->cell_m, m->box.x0,
                                     m->box.x1, row),
            i = 0;
        for (int k = 0; k <= n; k++)
            for (; i < m->columns && m->box.x0 + (i + 0.5) * r->cell_m < row[k].x; i++)
                to[i] = row[k].part >= 0 ? 0.0F : -1.0F;
    }
    return FW_OK;
}

/* a box's cells: half-open, so that each has one box */
typedef struct patch {
    int i0, i1, j0, j1; /* i1, j1: no longer */
} patch;

static patch cells_of(const raster *r, const fw_release_box *box) {
    const fw_release_map *m = r->map;
    double low_x = (box->x - box->half_m - m->box.x0) / r->cell_m - 0.5,
           low_y = (box->y - box->half_m - m->box.y0) / r->cell_m - 0.5;
    double side = 2.0 * box->half_m / r->cell_m, from_x = ceil(low_x), from_y = ceil(low_y);
    double to_x = ceil(low_x + side), to_y = ceil(low_y + side);
    return (patch){from_x > 0.0 ? (int)from_x : 0, to_x < m->columns ? (int)to_x : m->columns,
                   from_y > 0.0 ? (int)from_y : 0, to_y < m->rows ? (int)to_y : m->rows};
}

static void fill(raster *r, const fw_release_level *level, const fw_release_box *box, patch p) {
    fw_release_map *m = r->map;
    const int *list = level->list + box->first;
    for (int j = p.j0; j < p.j1; j++) {
        float *row = m->distance_m + (size_t)j * (size_t)m->columns;
        double most = HUGE_VAL, y = m->box.y0 + (j + 0.5) * r->cell_m;
        for (int i = p.i0; i < p.i1; i++) {
            most += 1.000001 * r->cell_m;
            if (row[i] < 0.0F) continue;
            fw_geometry_vec2 c = {m->box.x0 + (i + 0.5) * r->cell_m, y};
            fw_release_nearest(r->field, list, box->count, c, most, &most);
            row[i] = (float)most;
        }
    }
}

static bool has_material(const raster *r, patch p) {
    for (int j = p.j0; j < p.j1; j++)
        for (int i = p.i0; i < p.i1; i++)
            if (r->map->distance_m[(size_t)j * (size_t)r->map->columns + (size_t)i] >= 0.0F)
                return true;
    return false;
}

/* a box is small enough when it has few edges or few cells */
static fw_status look(raster *r, const fw_release_level *level, const fw_release_box *box,
                      fw_release_level *next) {
    enum { FEW = 16, FEW_CELLS = 16 };
    patch p = cells_of(r, box);
    if (!has_material(r, p)) return FW_OK;
    if (box->count > FEW && (p.i1 - p.i0) * (p.j1 - p.j0) > FEW_CELLS)
        return fw_release_level_split(r->field, level, box, next);
    fill(r, level, box, p);
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
    FW_TRY(find_material(&r));
    FW_TRY(fw_release_field_start(&field));
    for (int k = 0; from->nbox > 0; from = &level[k], k = 1 - k) {
        level[k].nbox = level[k].nlist = 0;
        for (int i = 0; i < from->nbox; i++)
            FW_TRY(look(&r, from, &from->box[i], &level[k]));
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
