/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "release/release_cells.h"
#include "base/constants.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

static const double HALF_DIAGONAL = FW_SQRT_HALF; /* of a cell of side 1 */
static const double MOST_CELLS = 16e6;

static size_t number_of(const fw_release_cells *c) {
    return (size_t)c->columns * (size_t)c->rows;
}

fw_status fw_release_cells_over(fw_geometry_box box, double room_m, double step_m,
                                fw_release_cells *cells) {
    double x0 = floor((box.x0 - room_m) / step_m), y0 = floor((box.y0 - room_m) / step_m);
    double columns = ceil((box.x1 + room_m) / step_m) - x0 + 1.0,
           rows = ceil((box.y1 + room_m) / step_m) - y0 + 1.0;
    if (!(columns > 0.0 && rows > 0.0 && columns * rows <= MOST_CELLS)) return FW_LIMIT;
    *cells = (fw_release_cells){
        {x0 * step_m, y0 * step_m}, .step_m = step_m, .columns = (int)columns, .rows = (int)rows};
    return FW_OK;
}

fw_status fw_release_cells_set(fw_arena *arena, const fw_release_cells *cells,
                               unsigned char **set) {
    FW_NEED(*set = fw_arena_array(arena, unsigned char, number_of(cells)));
    return FW_OK;
}

static fw_geometry_vec2 middle(const fw_release_cells *c, int column, int row) {
    return (fw_geometry_vec2){c->from.x + (column + 0.5) * c->step_m,
                              c->from.y + (row + 0.5) * c->step_m};
}

typedef struct span { /* columns and rows that a box meets, both ends included */
    int c0, c1, r0, r1;
} span;

static int within(double at, int most) {
    return at < 0.0 ? 0 : at > most ? most : (int)at;
}

static span span_of(const fw_release_cells *c, fw_geometry_box b, double room_m) {
    double s = c->step_m;
    return (span){within(floor((b.x0 - room_m - c->from.x) / s), c->columns - 1),
                  within(floor((b.x1 + room_m - c->from.x) / s), c->columns - 1),
                  within(floor((b.y0 - room_m - c->from.y) / s), c->rows - 1),
                  within(floor((b.y1 + room_m - c->from.y) / s), c->rows - 1)};
}

void fw_release_cells_touch(const fw_release_cells *cells, const fw_geometry_contour *outline,
                            unsigned char *set) {
    double reach = HALF_DIAGONAL * cells->step_m * (1.0 + 1e-9), t;
    fw_geometry_vec2 on;
    for (int i = 0; i < outline->count; i++) {
        const fw_geometry_segment *s = &outline->segment[i];
        span a = span_of(cells, fw_segment_box(s), reach);
        for (int r = a.r0; r <= a.r1; r++)
            for (int c = a.c0; c <= a.c1; c++) {
                unsigned char *cell = &set[(size_t)r * (size_t)cells->columns + (size_t)c];
                if (!*cell && fw_geometry_segment_nearest(s, middle(cells, c, r), &t, &on) <= reach)
                    *cell = 1;
            }
    }
}

/* neighbours in a row that no edge parts lie on one side of the outline, so that one of them is asked */
fw_status fw_release_cells_inside(fw_arena *arena, const fw_release_cells *cells,
                                  const fw_geometry_contour *outline, const unsigned char *edge,
                                  unsigned char *set) {
    (void)arena;
    span a = span_of(cells, fw_geometry_contour_box(outline), 0.0);
    for (int r = a.r0; r <= a.r1; r++) {
        bool known = false, in = false;
        for (int c = a.c0; c <= a.c1; c++) {
            size_t at = (size_t)r * (size_t)cells->columns + (size_t)c;
            if (edge[at]) {
                known = false;
                continue;
            }
            if (!known) in = fw_geometry_contour_contains(outline, middle(cells, c, r));
            known = true;
            if (in) set[at] = 1;
        }
    }
    return FW_OK;
}

/* along a row or a column: a cell is set where one of the k before or behind it is */
static void grow_line(unsigned char *line, size_t stride, int n, int k, unsigned char *old) {
    int last = -1; /* the last one that was set, seen from the left, then from the right */
    for (int i = 0; i < n; i++)
        old[i] = line[(size_t)i * stride];
    for (int i = 0; i < n; i++) {
        if (old[i]) last = i;
        if (last >= 0 && i - last <= k) line[(size_t)i * stride] = 1;
    }
    last = -1;
    for (int i = n - 1; i >= 0; i--) {
        if (old[i]) last = i;
        if (last >= 0 && last - i <= k) line[(size_t)i * stride] = 1;
    }
}

fw_status fw_release_cells_grow(fw_arena *arena, const fw_release_cells *cells, int k,
                                unsigned char *set) {
    size_t n = number_of(cells);
    int longest = cells->columns > cells->rows ? cells->columns : cells->rows;
    fw_mark mark = fw_arena_mark(arena);
    unsigned char *old = fw_arena_array(arena, unsigned char, (size_t)longest);
    FW_NEED(old);
    for (size_t i = 0; k < 0 && i < n; i++)
        set[i] = !set[i];
    for (int r = 0; r < cells->rows; r++)
        grow_line(set + (size_t)r * (size_t)cells->columns, 1, cells->columns, k < 0 ? -k : k, old);
    for (int c = 0; c < cells->columns; c++)
        grow_line(set + c, (size_t)cells->columns, cells->rows, k < 0 ? -k : k, old);
    for (size_t i = 0; k < 0 && i < n; i++)
        set[i] = !set[i];
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

fw_status fw_release_cells_square(fw_arena *arena, const fw_release_cells *cells,
                                  const unsigned char *set, fw_geometry_box *square) {
    fw_mark mark = fw_arena_mark(arena);
    int n = cells->columns, best = 0, at_c = 0, at_r = 0, *below, *own;
    FW_NEED(below = fw_arena_array(arena, int, (size_t)n + 1));
    FW_NEED(own = fw_arena_array(arena, int, (size_t)n + 1));
    for (int r = 0; r < cells->rows; r++) { /* side of the largest with its upper right cell here */
        for (int c = 0; c < n; c++) {
            int least = below[c] < below[c + 1] ? below[c] : below[c + 1];
            if (own[c] < least) least = own[c];
            own[c + 1] = set[(size_t)r * (size_t)n + (size_t)c] ? least + 1 : 0;
            if (own[c + 1] > best) best = own[c + 1], at_c = c, at_r = r;
        }
        memcpy(below, own, ((size_t)n + 1) * sizeof *own);
        own[0] = 0;
    }
    fw_arena_rewind(arena, mark);
    double s = cells->step_m, x1 = cells->from.x + (at_c + 1) * s,
           y1 = cells->from.y + (at_r + 1) * s;
    *square = best ? (fw_geometry_box){x1 - best * s, y1 - best * s, x1, y1} : (fw_geometry_box){0};
    return FW_OK;
}

fw_status fw_release_cells_label(fw_arena *arena, const fw_release_cells *cells,
                                 const unsigned char *set, unsigned char value, int **label,
                                 int *count) {
    int columns = cells->columns, n = columns * cells->rows, *stack;
    *count = 0;
    FW_NEED(*label = fw_arena_array(arena, int, (size_t)n));
    FW_NEED(stack = fw_arena_array(arena, int, (size_t)n));
    for (int first = 0; first < n; first++) {
        if (set[first] != value || (*label)[first]) continue;
        int top = 0;
        (*label)[first] = ++*count;
        stack[top++] = first;
        while (top > 0) {
            int at = stack[--top], c = at % columns;
            const int next[] = {c > 0 ? at - 1 : -1, c < columns - 1 ? at + 1 : -1, at - columns,
                                at + columns};
            for (int k = 0; k < 4; k++) {
                if (next[k] < 0 || next[k] >= n || set[next[k]] != value || (*label)[next[k]])
                    continue;
                (*label)[next[k]] = *count;
                stack[top++] = next[k];
            }
        }
    }
    return FW_OK;
}

/* ---- outlines ---- */

enum { EAST, NORTH, WEST, SOUTH, NOWHERE };

typedef struct lattice { /* corners of the cells: which way the outline leaves each */
    const fw_release_cells *cells;
    unsigned char *way; /* (columns + 1) x (rows + 1) */
    int across;         /* columns + 1 */
} lattice;

static bool is_set(const fw_release_cells *cells, const unsigned char *set, int c, int r) {
    return c >= 0 && r >= 0 && c < cells->columns && r < cells->rows &&
           set[(size_t)r * (size_t)cells->columns + (size_t)c];
}

/* the set is on the left of every way */
static void find_ways(const lattice *l, const unsigned char *set) {
    const fw_release_cells *cells = l->cells;
    size_t across = (size_t)l->across;
    memset(l->way, NOWHERE, across * ((size_t)cells->rows + 1));
    for (int r = 0; r < cells->rows; r++)
        for (int c = 0; c < cells->columns; c++) {
            size_t low = (size_t)r * across + (size_t)c, high = low + across;
            if (!is_set(cells, set, c, r)) continue;
            if (!is_set(cells, set, c, r - 1)) l->way[low] = EAST;
            if (!is_set(cells, set, c + 1, r)) l->way[low + 1] = NORTH;
            if (!is_set(cells, set, c, r + 1)) l->way[high + 1] = WEST;
            if (!is_set(cells, set, c - 1, r)) l->way[high] = SOUTH;
        }
}

static fw_geometry_vec2 corner(const lattice *l, size_t at) {
    return (fw_geometry_vec2){
        l->cells->from.x + (double)(at % (size_t)l->across) * l->cells->step_m,
        l->cells->from.y + (double)(at / (size_t)l->across) * l->cells->step_m};
}

/* all the way around from `first`, where the outline turns; takes its ways off the lattice */
static fw_status trace(fw_arena *arena, const lattice *l, size_t first, fw_geometry_contour *out) {
    fw_geometry_outline o = fw_geometry_outline_start(arena, corner(l, first));
    size_t at = first;
    unsigned char way = l->way[at];
    do {
        const ptrdiff_t step[] = {1, l->across, -1, -l->across};
        l->way[at] = NOWHERE;
        at = (size_t)((ptrdiff_t)at + step[way]);
        unsigned char next = at == first ? NOWHERE : l->way[at];
        if (next != way && at != first) fw_geometry_outline_line(&o, corner(l, at), 0);
        way = next;
    } while (at != first);
    return fw_geometry_outline_close(&o, out);
}

/* an outline turns where the way that comes in is not the one that goes out; the lowest corner of a set, from the left,
   always is such a place */
fw_status fw_release_cells_outlines(fw_arena *arena, const fw_release_cells *cells,
                                    const unsigned char *set, fw_geometry_region *outlines) {
    lattice l = {.cells = cells, .across = cells->columns + 1};
    size_t n = (size_t)l.across * ((size_t)cells->rows + 1);
    int room = 0;
    FW_NEED(l.way = fw_arena_array(arena, unsigned char, n));
    find_ways(&l, set);
    *outlines = (fw_geometry_region){0};
    for (size_t at = 0; at < n; at++) {
        if (l.way[at] == NOWHERE) continue;
        if (outlines->count == room) {
            int more = 2 * room + 16;
            FW_NEED(outlines->contour = fw_arena_grow(arena, outlines->contour, (size_t)room,
                                                      (size_t)more, sizeof *outlines->contour));
            room = more;
        }
        FW_TRY(trace(arena, &l, at, &outlines->contour[outlines->count++]));
    }
    return FW_OK;
}
