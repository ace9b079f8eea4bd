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

/* ---- the distance of many places from few edges ----
   Four edges in a register, each with the operations of fw_release_edge_distance in their order, so that the bits are the
   same: lines, then arcs. Of ends the least square is taken and its root once, which is that of the least distance, since
   a root that is rounded correctly never falls. In: up to PACKED open edges, place (m). Out: the least distance (m).
   Error: a few ulp of the coordinates. Cost: some 6 operations a line, 14 an arc. Test: test_reach_field.c,
   maps_are_distances. */

enum { PACKED = 64, TOGETHER = 4, ROOM = PACKED + TOGETHER };

typedef struct pack {
    double ax[ROOM], ay[ROOM], bx[ROOM], by[ROOM]; /* ends */
    double ux[ROOM], uy[ROOM],
        size[ROOM]; /* line: along it, its length; arc: to its middle, the cosine */
    double cx[ROOM], cy[ROOM], radius[ROOM];
    int lines, n; /* lines fill registers, arcs behind them, too: by edges that are there twice */
} pack;

typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long mask __attribute__((vector_size(32), aligned(8), may_alias));

static void put(pack *to, const fw_release_edge *e) {
    const bool arc = e->radius > 0.0;
    const int i = to->n++;
    to->ax[i] = e->a.x, to->ay[i] = e->a.y, to->bx[i] = e->b.x, to->by[i] = e->b.y;
    to->ux[i] = arc ? e->middle.x : e->along.x, to->uy[i] = arc ? e->middle.y : e->along.y;
    to->size[i] = arc ? e->cosine : e->length;
    to->cx[i] = e->centre.x, to->cy[i] = e->centre.y, to->radius[i] = e->radius;
}

/* the open edges of a list; at most PACKED with those that are there twice */
static bool pack_edges(const fw_release_field *f, const int *list, int n, pack *to) {
    to->n = 0;
    if (n > PACKED - TOGETHER) return false;
    for (int arcs = 0; arcs < 2; arcs++) {
        const fw_release_edge *last = NULL;
        for (int i = 0; i < n; i++) {
            const fw_release_edge *e = &f->edge[list[i]];
            if (e->open && (e->radius > 0.0) == arcs) put(to, last = e);
        }
        while (last && to->n % TOGETHER)
            put(to, last);
        if (!arcs) to->lines = to->n;
    }
    return true;
}

#define PICK(which, yes, no) ((four)(((mask)(yes) & (which)) | ((mask)(no) & ~(which))))

__attribute__((always_inline)) static inline double least_of(const pack *k, fw_geometry_vec2 p) {
    const four none = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL}, sign = {-0.0, -0.0, -0.0, -0.0};
    four far = none, ends = none; /* to the inside of edges; squares, to their ends */
    for (int i = 0; i < k->n; i += TOGETHER) {
        const four x = p.x - *(const four *)(k->ax + i), y = p.y - *(const four *)(k->ay + i),
                   ux = *(const four *)(k->ux + i), uy = *(const four *)(k->uy + i),
                   size = *(const four *)(k->size + i), to_x = p.x - *(const four *)(k->bx + i),
                   to_y = p.y - *(const four *)(k->by + i);
        const four to_a = x * x + y * y, to_b = to_x * to_x + to_y * to_y;
        four here, end;
        mask inside;
        if (i < k->lines) {
            const four t = x * ux + y * uy;
            const mask before = t <= 0.0;
            here = ux * y - uy * x;
            inside = ~before & (t < size);
            end = PICK(before, to_a, to_b);
        } else {
            const four rx = p.x - *(const four *)(k->cx + i), ry = p.y - *(const four *)(k->cy + i),
                       square = rx * rx + ry * ry;
            const four length = {sqrt(square[0]), sqrt(square[1]), sqrt(square[2]),
                                 sqrt(square[3])};
            here = length - *(const four *)(k->radius + i);
            inside = rx * ux + ry * uy >= size * length;
            end = PICK(to_a < to_b, to_a, to_b);
        }
        here = (four)((mask)here & ~(mask)sign);
        far = PICK(inside & (here < far), here, far);
        ends = PICK(~inside & (end < ends), end, ends);
    }
    double least = fw_lesser(fw_lesser(far[0], far[1]), fw_lesser(far[2], far[3])),
           square = fw_lesser(fw_lesser(ends[0], ends[1]), fw_lesser(ends[2], ends[3]));
    return fw_lesser(least, sqrt(square));
}

static void fill_row(const pack *k, double x0, double cell_m, double y, int i0, int i1,
                     float *row) {
    for (int i = i0; i < i1; i++)
        if (row[i] >= 0.0F)
            row[i] = (float)least_of(k, (fw_geometry_vec2){x0 + (i + 0.5) * cell_m, y});
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void fill_row_avx2(const pack *k, double x0, double cell_m,
                                                          double y, int i0, int i1, float *row) {
    for (int i = i0; i < i1; i++)
        if (row[i] >= 0.0F)
            row[i] = (float)least_of(k, (fw_geometry_vec2){x0 + (i + 0.5) * cell_m, y});
}
#endif

static void fill_packed(const raster *r, const pack *k, patch p) {
    const fw_release_map *m = r->map;
    void (*row)(const pack *, double, double, double, int, int, float *) = fill_row;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) row = fill_row_avx2;
#endif
    for (int j = p.j0; j < p.j1; j++)
        row(k, m->box.x0, r->cell_m, m->box.y0 + (j + 0.5) * r->cell_m, p.i0, p.i1,
            m->distance_m + (size_t)j * (size_t)m->columns);
}

static void fill(raster *r, const fw_release_level *level, const fw_release_box *box, patch p) {
    fw_release_map *m = r->map;
    const int *list = level->list + box->first;
    pack edges;
    if (pack_edges(r->field, list, box->count, &edges)) {
        fill_packed(r, &edges, p);
        return;
    }
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
    enum { FEW = 48, FEW_CELLS = 24 };
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
