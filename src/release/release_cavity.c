/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "release/release_cavity.h"
#include "release/release_cells.h"
#include "release/release_field.h"
#include <math.h>
#include <string.h>

typedef struct maker {
    fw_arena *arena;
    const fw_layout *layout;
    fw_release_cells cells;
    size_t n;
    int *part_of; /* (npiece) */
    fw_release_part *part;
    int npart;
    unsigned char *hollow;
} maker;

static bool is_free_to_move(const maker *m, int piece) {
    int part = m->part_of[piece];
    return part >= 0 && m->part[part].duty != FW_RELEASE_STAYS;
}

/* cells that a part touches or holds: its outlines, then what they surround */
static fw_status cover(maker *m, bool (*wanted)(const maker *m, int piece), unsigned char *set) {
    unsigned char *edge;
    fw_mark mark = fw_arena_mark(m->arena);
    FW_TRY(fw_release_cells_set(m->arena, &m->cells, &edge));
    for (int i = 0; i < m->layout->npiece; i++)
        if (wanted(m, i)) fw_release_cells_touch(&m->cells, &m->layout->piece[i].contour, edge);
    for (int i = 0; i < m->layout->npiece; i++)
        if (wanted(m, i))
            FW_TRY(fw_release_cells_inside(m->arena, &m->cells, &m->layout->piece[i].contour, edge,
                                           set));
    for (size_t i = 0; i < m->n; i++)
        set[i] = set[i] || edge[i];
    fw_arena_rewind(m->arena, mark);
    return FW_OK;
}

/* where hollows touch in a corner alone the ground between them is taken, until no such place is left */
static fw_status join_corners(maker *m) {
    int columns = m->cells.columns;
    for (bool again = true; again;) {
        again = false;
        for (int r = 0; r + 1 < m->cells.rows; r++)
            for (int c = 0; c + 1 < columns; c++) {
                unsigned char *p = &m->hollow[(size_t)r * (size_t)columns + (size_t)c];
                bool one = p[0] && p[columns + 1] && !p[1] && !p[columns];
                bool other = p[1] && p[columns] && !p[0] && !p[columns + 1];
                if (!one && !other) continue;
                p[0] = p[1] = p[columns] = p[columns + 1] = 1;
                again = true;
            }
    }
    return FW_OK;
}

/* a hollow beside ground that is itself surrounded: that ground goes */
static fw_status flatten_nested(maker *m) {
    int *ground, *hole, nground, nhole, columns = m->cells.columns;
    fw_mark mark = fw_arena_mark(m->arena);
    FW_TRY(fw_release_cells_label(m->arena, &m->cells, m->hollow, 0, &ground, &nground));
    FW_TRY(fw_release_cells_label(m->arena, &m->cells, m->hollow, 1, &hole, &nhole));
    bool *outer = fw_arena_array(m->arena, bool, (size_t)nhole + 1);
    bool *gone = fw_arena_array(m->arena, bool, (size_t)nground + 1);
    FW_NEED(outer && gone ? gone : NULL);
    int outside = ground[0]; /* the drawing has room around it */
    for (size_t i = 0; i + (size_t)columns < m->n; i++) {
        size_t beside[] = {i + 1, i + (size_t)columns};
        for (int k = 0; k < 2; k++) {
            size_t j = beside[k];
            if (ground[i] == outside && hole[j]) outer[hole[j]] = true;
            if (ground[j] == outside && hole[i]) outer[hole[i]] = true;
        }
    }
    for (size_t i = 0; i + (size_t)columns < m->n; i++) {
        size_t beside[] = {i + 1, i + (size_t)columns};
        for (int k = 0; k < 2; k++) {
            size_t j = beside[k];
            if (ground[i] && hole[j] && !outer[hole[j]]) gone[ground[i]] = true;
            if (ground[j] && hole[i] && !outer[hole[i]]) gone[ground[j]] = true;
        }
    }
    for (size_t i = 0; i < m->n; i++)
        if (ground[i] && gone[ground[i]]) m->hollow[i] = 1;
    fw_arena_rewind(m->arena, mark);
    return FW_OK;
}

/* outlines apart: those around hollows, and, turned round, those around ground within them */
static fw_status sort_outlines(maker *m, fw_release_cavity *cavity) {
    fw_geometry_region all;
    FW_TRY(fw_release_cells_outlines(m->arena, &m->cells, m->hollow, &all));
    size_t n = (size_t)all.count;
    FW_NEED(cavity->hollow.contour = fw_arena_array(m->arena, fw_geometry_contour, n));
    FW_NEED(cavity->land.contour = fw_arena_array(m->arena, fw_geometry_contour, n));
    for (int i = 0; i < all.count; i++) {
        double area = fw_geometry_contour_area(&all.contour[i]);
        cavity->area_m2 += area;
        if (area > 0.0)
            cavity->hollow.contour[cavity->hollow.count++] = all.contour[i];
        else
            FW_TRY(fw_geometry_contour_reverse(m->arena, &all.contour[i],
                                               &cavity->land.contour[cavity->land.count++]));
    }
    return FW_OK;
}

/* cells that lie whole in a part, less those of a set */
static fw_status whole_cells(maker *m, int part, const unsigned char *without, unsigned char *set) {
    unsigned char *edge;
    FW_TRY(fw_release_cells_set(m->arena, &m->cells, &edge));
    for (int i = 0; i < m->layout->npiece; i++)
        if (m->part_of[i] == part || m->part_of[i] == FW_RELEASE_OPENING)
            fw_release_cells_touch(&m->cells, &m->layout->piece[i].contour, edge);
    for (int i = 0; i < m->layout->npiece; i++)
        if (m->part_of[i] == part)
            FW_TRY(fw_release_cells_inside(m->arena, &m->cells, &m->layout->piece[i].contour, edge,
                                           set));
    for (size_t i = 0; i < m->n; i++)
        if (without && without[i]) set[i] = 0;
    return FW_OK;
}

static fw_status find_ground(maker *m, fw_release_cavity *cavity) {
    FW_NEED(cavity->ground = fw_arena_array(m->arena, fw_release_ground, (size_t)m->npart));
    for (int part = 0; part < m->npart; part++) {
        const fw_release_part *p = &m->part[part];
        if (p->duty != FW_RELEASE_STAYS) continue;
        fw_release_ground *g = &cavity->ground[cavity->nground++];
        *g = (fw_release_ground){
            .label = p->label, .role = p->role, .body = p->body, .area_m2 = p->area_m2};
        unsigned char *set;
        fw_mark mark = fw_arena_mark(m->arena);
        FW_TRY(fw_release_cells_set(m->arena, &m->cells, &set));
        FW_TRY(whole_cells(m, part, m->hollow, set));
        for (size_t i = 0; i < m->n; i++)
            g->bonded_m2 += set[i] ? m->cells.step_m * m->cells.step_m : 0.0;
        FW_TRY(fw_release_cells_square(m->arena, &m->cells, set, &g->square));
        fw_arena_rewind(m->arena, mark);
    }
    return FW_OK;
}

static fw_status start(fw_arena *arena, const fw_layout *layout, double room_m, double step_m,
                       maker *m) {
    *m = (maker){.arena = arena, .layout = layout};
    FW_TRY(fw_release_cells_over(layout->die, room_m, step_m, &m->cells));
    m->n = (size_t)m->cells.columns * (size_t)m->cells.rows;
    return fw_release_parts(arena, layout, true, &m->part_of, &m->part, &m->npart);
}

fw_status fw_release_cavity_make(fw_arena *arena, const fw_layout *layout,
                                 const fw_release_cavity_asked *asked, fw_release_cavity *cavity) {
    maker m;
    int k = (int)ceil(asked->margin_m / asked->step_m - 1e-9),
        w = (int)ceil(0.5 * asked->wall_m / asked->step_m - 1e-9);
    *cavity = (fw_release_cavity){0};
    FW_TRY(start(arena, layout, asked->margin_m + 2.0 * asked->wall_m, asked->step_m, &m));
    FW_TRY(fw_release_cells_set(arena, &m.cells, &m.hollow));
    FW_TRY(cover(&m, is_free_to_move, m.hollow));
    FW_TRY(fw_release_cells_grow(arena, &m.cells, k + w, m.hollow)); /* what is narrower than */
    FW_TRY(fw_release_cells_grow(arena, &m.cells, -w, m.hollow));    /* a wall is closed */
    FW_TRY(join_corners(&m));
    FW_TRY(flatten_nested(&m));
    FW_TRY(sort_outlines(&m, cavity));
    FW_TRY(fw_release_cells_square(arena, &m.cells, m.hollow, &cavity->widest));
    return find_ground(&m, cavity);
}

fw_status fw_release_square_in(fw_arena *arena, const fw_layout *layout, int piece, double clear_m,
                               double step_m, fw_geometry_box *square) {
    maker m;
    unsigned char *set;
    fw_mark mark = fw_arena_mark(arena);
    fw_layout own = *layout; /* cells over the part alone */
    own.die = fw_geometry_contour_box(&layout->piece[piece].contour);
    FW_TRY(start(arena, &own, 2.0 * step_m, step_m, &m));
    FW_TRY(fw_release_cells_set(arena, &m.cells, &set));
    FW_TRY(whole_cells(&m, m.part_of[piece], NULL, set));
    FW_TRY(fw_release_cells_grow(arena, &m.cells, -(int)ceil(clear_m / step_m - 1e-9), set));
    FW_TRY(fw_release_cells_square(arena, &m.cells, set, square));
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
