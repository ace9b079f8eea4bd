/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hollows below what moves and the ground that is left, on square cells over the drawing. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "release/release.h"
#include "release/release_field.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

/* ---- square cells over a drawing ----
   Which of them a part covers or touches, sets of them grown and closed, and the outlines of such a set. For what need
   not follow a drawing to the nanometre: hollows in the carrier, places of bond and metal. */

typedef struct cell_grid {
    fw_geometry_vec2 from; /* lower left corner, a multiple of the step */
    double step_m;
    int columns, rows;
} cell_grid;

static const double HALF_DIAGONAL = FW_SQRT_HALF; /* of a cell of side 1 */
static const double MOST_CELLS = 16e6;

static size_t number_of(const cell_grid *c) {
    return (size_t)c->columns * (size_t)c->rows;
}

/* of a box with room around it; FW_LIMIT: more than 16 million cells */
static fw_status cells_over(fw_geometry_box box, double room_m, double step_m, cell_grid *cells) {
    double x0 = floor((box.x0 - room_m) / step_m), y0 = floor((box.y0 - room_m) / step_m);
    double columns = ceil((box.x1 + room_m) / step_m) - x0 + 1.0,
           rows = ceil((box.y1 + room_m) / step_m) - y0 + 1.0;
    if (!(columns > 0.0 && rows > 0.0 && columns * rows <= MOST_CELLS)) return FW_LIMIT;
    *cells = (cell_grid){
        {x0 * step_m, y0 * step_m}, .step_m = step_m, .columns = (int)columns, .rows = (int)rows};
    return FW_OK;
}

/* a set: one byte a cell, row by row from below */
static fw_status cells_set(fw_arena *arena, const cell_grid *cells, unsigned char **set) {
    FW_NEED(*set = fw_arena_array(arena, unsigned char, number_of(cells)));
    return FW_OK;
}

static fw_geometry_vec2 middle(const cell_grid *c, int column, int row) {
    return (fw_geometry_vec2){c->from.x + (column + 0.5) * c->step_m,
                              c->from.y + (row + 0.5) * c->step_m};
}

typedef struct span { /* columns and rows that a box meets, both ends included */
    int c0, c1, r0, r1;
} span;

static int within(double at, int most) {
    return at < 0.0 ? 0 : at > most ? most : (int)at;
}

static span span_of(const cell_grid *c, fw_geometry_box b, double room_m) {
    double s = c->step_m;
    return (span){within(floor((b.x0 - room_m - c->from.x) / s), c->columns - 1),
                  within(floor((b.x1 + room_m - c->from.x) / s), c->columns - 1),
                  within(floor((b.y0 - room_m - c->from.y) / s), c->rows - 1),
                  within(floor((b.y1 + room_m - c->from.y) / s), c->rows - 1)};
}

static int column_of(const cell_grid *c, double x) {
    return within(floor((x - c->from.x) / c->step_m), c->columns - 1);
}

/* what of a box a line may reach in the row at y: all of it, of an arc and of a line that hardly rises */
static fw_geometry_box reached(const fw_geometry_segment *s, fw_geometry_box box, double y,
                               double reach) {
    const double rise = s->b.y - s->a.y, run = s->b.x - s->a.x;
    if (s->kind == FW_ARC || fabs(rise) < 1e-3 * fabs(run)) return box;
    const double mid = s->a.x + run / rise * (y - s->a.y), half = 1.001 * reach * fabs(run / rise);
    box.x0 = fw_greater(box.x0, mid - half), box.x1 = fw_lesser(box.x1, mid + half);
    return box;
}

/* adds the cells that an outline may touch: none that it touches is missing, none is added whose middle is farther than a
   step from it */
static void cells_touch(const cell_grid *cells, const fw_geometry_contour *outline,
                        unsigned char *set) {
    const double reach = HALF_DIAGONAL * cells->step_m * (1.0 + 1e-9);
    const fw_geometry_vec2 from = cells->from, to = middle(cells, cells->columns, cells->rows);
    for (int i = 0; i < outline->count; i++) {
        const fw_geometry_segment *s = &outline->segment[i];
        const fw_geometry_box box = fw_segment_box(s);
        if (fw_box_gap(box, (fw_geometry_box){from.x, from.y, to.x, to.y}) > reach) continue;
        const span a = span_of(cells, box, reach);
        const fw_geometry_near near = fw_geometry_near_of(s, reach);
        for (int r = a.r0; r <= a.r1; r++) {
            unsigned char *row = &set[(size_t)r * (size_t)cells->columns];
            const double y = middle(cells, 0, r).y;
            const fw_geometry_box in = reached(s, box, y, reach);
            fw_geometry_near_row(&near, cells->from.x, cells->step_m, y,
                                 column_of(cells, in.x0 - reach), column_of(cells, in.x1 + reach),
                                 row);
        }
    }
}

/* Adds the cells with their middle in the outline that are not in `edge`, a set that holds all that the outline touches.
   Neighbours that no edge parts, in a row or one above the other, lie on one side of the outline, so that one of them is
   asked. */
static fw_status cells_inside(fw_arena *arena, const cell_grid *cells,
                              const fw_geometry_contour *outline, const unsigned char *edge,
                              unsigned char *set) {
    enum { UNKNOWN, OUT, IN };
    const span a = span_of(cells, fw_geometry_contour_box(outline), 0.0);
    fw_mark mark = fw_arena_mark(arena);
    unsigned char *below = fw_arena_array(arena, unsigned char, (size_t)cells->columns);
    FW_NEED(below);
    for (int r = a.r0; r <= a.r1; r++) {
        const size_t row = (size_t)r * (size_t)cells->columns;
        for (int c = a.c0, to; c <= a.c1; c = to) {
            to = c + 1;
            if (edge[row + (size_t)c]) {
                below[c] = UNKNOWN;
                continue;
            }
            const unsigned char *end = memchr(edge + row + c, 1, (size_t)a.c1 + 1 - (size_t)c);
            to = end ? (int)(end - (edge + row)) : a.c1 + 1;
            unsigned char is = UNKNOWN;
            for (int k = c; k < to && is == UNKNOWN; k++)
                is = below[k];
            if (is == UNKNOWN)
                is = fw_geometry_contour_contains(outline, middle(cells, c, r)) ? IN : OUT;
            memset(below + c, is, (size_t)(to - c));
            if (is == IN) memset(set + row + c, 1, (size_t)(to - c));
        }
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

typedef uint64_t lot __attribute__((vector_size(32)));

/* many cells at once: to[i] = p[i] | q[i], i from below, so that both may lie in the same list, at or beyond it */
static void join_sets(unsigned char *to, const unsigned char *p, const unsigned char *q, size_t n) {
    size_t i = 0;
    lot a, b;
    for (; i + sizeof a <= n; i += sizeof a) {
        memcpy(&a, p + i, sizeof a);
        memcpy(&b, q + i, sizeof b);
        a |= b;
        memcpy(to + i, &a, sizeof a);
    }
    for (; i < n; i++)
        to[i] = p[i] | q[i];
}

static void turn_round(unsigned char *set, size_t n) {
    size_t i = 0;
    uint64_t a;
    for (; i + sizeof a <= n; i += sizeof a) {
        memcpy(&a, set + i, sizeof a);
        a ^= UINT64_C(0x0101010101010101);
        memcpy(set + i, &a, sizeof a);
    }
    for (; i < n; i++)
        set[i] ^= 1;
}

/* each cell of a list becomes the sum of it and the `reach` that follow at every `stride`, by doubling; n: of the list,
   behind which nothing is read */
static void join_following(unsigned char *list, size_t n, size_t reach, size_t stride) {
    size_t have = 1, want = reach + 1;
    for (; 2 * have <= want; have *= 2)
        join_sets(list, list, list + have * stride, n - have * stride);
    if (have < want)
        join_sets(list, list, list + (want - have) * stride, n - (want - have) * stride);
}

/* Every cell within k columns and rows of one of the set; k < 0: away from those that are not in it. On a wider list with
   k empty cells on every side, so that no row runs into the next. */
static fw_status cells_grow(fw_arena *arena, const cell_grid *cells, int k, unsigned char *set) {
    const size_t by = (size_t)(k < 0 ? -k : k), across = (size_t)cells->columns,
                 wide = across + 2 * by, n = wide * ((size_t)cells->rows + 2 * by);
    unsigned char *padded;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(padded = fw_arena_array(arena, unsigned char, n));
    if (k < 0) turn_round(set, number_of(cells));
    for (size_t r = 0; r < (size_t)cells->rows; r++)
        memcpy(padded + (r + by) * wide + by, set + r * across, across);
    join_following(padded, n, 2 * by, 1);
    join_following(padded, n, 2 * by, wide);
    for (size_t r = 0; r < (size_t)cells->rows; r++)
        memcpy(set + r * across, padded + r * wide, across);
    if (k < 0) turn_round(set, number_of(cells));
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* the largest square within the set, the first from below, which has no cell outside of a span; side 0: the set is empty */
static fw_status cells_square(fw_arena *arena, const cell_grid *cells, span a,
                              const unsigned char *set, fw_geometry_box *square) {
    fw_mark mark = fw_arena_mark(arena);
    int n = cells->columns, best = 0, at_c = 0, at_r = 0, *below, *own;
    FW_NEED(below = fw_arena_array(arena, int, (size_t)n + 1));
    FW_NEED(own = fw_arena_array(arena, int, (size_t)n + 1));
    for (int r = a.r0; r <= a.r1; r++) { /* side of the largest with its upper right cell here */
        const unsigned char *row = set + (size_t)r * (size_t)n;
        for (int c = a.c0; c <= a.c1; c++) {
            int least = below[c] < below[c + 1] ? below[c] : below[c + 1];
            if (own[c] < least) least = own[c];
            own[c + 1] = row[c] ? least + 1 : 0;
            if (own[c + 1] > best) best = own[c + 1], at_c = c, at_r = r;
        }
        int *free = below;
        below = own, own = free;
        own[a.c0] = 0;
    }
    fw_arena_rewind(arena, mark);
    double s = cells->step_m, x1 = cells->from.x + (at_c + 1) * s,
           y1 = cells->from.y + (at_r + 1) * s;
    *square = best ? (fw_geometry_box){x1 - best * s, y1 - best * s, x1, y1} : (fw_geometry_box){0};
    return FW_OK;
}

/* ---- connected parts ----
   of a set and of what is not in it, over edges, by the runs of every row. */

typedef struct run {         /* from <= column < to of a row, whose value changes at both */
    int from, to, row, part; /* part: a run of the same part, lower or itself */
    bool set;
} run;

typedef struct runs { /* of all rows from below, each from the left */
    run *item;
    int n, room;
} runs;

static int part_of(const runs *all, int i) {
    while (all->item[i].part != i)
        i = all->item[i].part = all->item[all->item[i].part].part;
    return i;
}

static void unite(const runs *all, int i, int j) {
    i = part_of(all, i), j = part_of(all, j);
    all->item[i < j ? j : i].part = i < j ? i : j;
}

static fw_status add_row(fw_arena *arena, const cell_grid *cells, const unsigned char *row, int r,
                         runs *all) {
    for (int c = 0; c < cells->columns;) {
        const unsigned char *end = memchr(row + c, !row[c], (size_t)cells->columns - (size_t)c);
        const int to = end ? (int)(end - row) : cells->columns;
        if (all->n == all->room) {
            int more = 2 * all->room + 256;
            FW_NEED(all->item = fw_arena_grow(arena, all->item, (size_t)all->room, (size_t)more,
                                              sizeof *all->item));
            all->room = more;
        }
        all->item[all->n] = (run){c, to, r, all->n, row[c]};
        all->n++;
        c = to;
    }
    return FW_OK;
}

typedef struct parts { /* of a set and of what is not in it; a part is named by its first run */
    runs all;
    int outside;        /* the part of the lower left corner: the drawing has room around it */
    bool *outer, *gone; /* (all.n) of hollows beside it; of ground within others */
} parts;

/* all runs that share an edge: of one row, and of two rows one above the other */
static void each_pair(parts *p, void (*visit)(parts *p, int i, int j)) {
    const run *a = p->all.item;
    for (int i = 0, up = 0; i < p->all.n; i++) {
        const int above = a[i].row + 1;
        if (i + 1 < p->all.n && a[i + 1].row == a[i].row) visit(p, i, i + 1);
        while (up < p->all.n &&
               (a[up].row < above || (a[up].row == above && a[up].to <= a[i].from)))
            up++;
        for (int j = up; j < p->all.n && a[j].row == above && a[j].from < a[i].to; j++)
            visit(p, i, j);
    }
}

static void unite_alike(parts *p, int i, int j) {
    if (p->all.item[i].set == p->all.item[j].set) unite(&p->all, i, j);
}

static void mark_outer(parts *p, int i, int j) {
    if (p->all.item[i].set == p->all.item[j].set) return;
    const int hollow = part_of(&p->all, p->all.item[i].set ? i : j),
              ground = part_of(&p->all, p->all.item[i].set ? j : i);
    if (ground == p->outside) p->outer[hollow] = true;
}

static void mark_gone(parts *p, int i, int j) {
    if (p->all.item[i].set == p->all.item[j].set) return;
    const int hollow = part_of(&p->all, p->all.item[i].set ? i : j),
              ground = part_of(&p->all, p->all.item[i].set ? j : i);
    if (!p->outer[hollow]) p->gone[ground] = true;
}

/* ---- outlines ---- */

enum { EAST, NORTH, WEST, SOUTH, NOWHERE };

typedef struct lattice { /* corners of the cells: which way the outline leaves each */
    const cell_grid *cells;
    unsigned char *way; /* (columns + 1) x (rows + 1) */
    int across;         /* columns + 1 */
} lattice;

static bool is_set(const cell_grid *cells, const unsigned char *set, int c, int r) {
    return c >= 0 && r >= 0 && c < cells->columns && r < cells->rows &&
           set[(size_t)r * (size_t)cells->columns + (size_t)c];
}

/* are eight cells of a row as those beside them? Then no outline runs there */
static bool alike(const unsigned char *cell, size_t across) {
    return !memcmp(cell, cell - 1, 8) && !memcmp(cell, cell + 1, 8) &&
           !memcmp(cell, cell - across, 8) && !memcmp(cell, cell + across, 8);
}

/* the set is on the left of every way */
static void find_ways(const lattice *l, const unsigned char *set) {
    const cell_grid *cells = l->cells;
    size_t across = (size_t)l->across;
    memset(l->way, NOWHERE, across * ((size_t)cells->rows + 1));
    for (int r = 0; r < cells->rows; r++)
        for (int c = 0; c < cells->columns; c++) {
            const bool inner = r > 0 && r + 1 < cells->rows && c > 0 && c + 8 < cells->columns;
            if (inner && alike(set + (size_t)r * (across - 1) + c, across - 1)) {
                c += 7;
                continue;
            }
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

/* Outlines of the set, counter-clockwise around it and clockwise around its holes; no two of its cells may touch in a
   corner alone. An outline turns where the way that comes in is not the one that goes out; the lowest corner of a set,
   from the left, always is such a place. */
static fw_status cells_outlines(fw_arena *arena, const cell_grid *cells, const unsigned char *set,
                                fw_geometry_region *outlines) {
    lattice l = {.cells = cells, .across = cells->columns + 1};
    size_t n = (size_t)l.across * ((size_t)cells->rows + 1);
    const unsigned char nowhere[8] = {NOWHERE, NOWHERE, NOWHERE, NOWHERE,
                                      NOWHERE, NOWHERE, NOWHERE, NOWHERE};
    int room = 0;
    FW_NEED(l.way = fw_arena_array(arena, unsigned char, n));
    find_ways(&l, set);
    *outlines = (fw_geometry_region){0};
    for (size_t at = 0; at < n; at++) {
        while (at + 8 < n && !memcmp(l.way + at, nowhere, 8))
            at += 8;
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

/* ---- hollows and ground ---- */

typedef struct maker {
    fw_arena *arena;
    const fw_layout *layout;
    cell_grid cells;
    size_t n;
    int *part_of; /* (npiece) */
    fw_release_part *part;
    int npart;
    unsigned char *hollow, *opening;
} maker;

static bool is_free_to_move(const maker *m, int piece) {
    int part = m->part_of[piece];
    return part >= 0 && m->part[part].duty != FW_RELEASE_STAYS;
}

/* cells that a part touches or holds: its outlines, then what they surround */
static fw_status cover(maker *m, bool (*wanted)(const maker *m, int piece), unsigned char *set) {
    unsigned char *edge;
    fw_mark mark = fw_arena_mark(m->arena);
    FW_TRY(cells_set(m->arena, &m->cells, &edge));
    for (int i = 0; i < m->layout->npiece; i++)
        if (wanted(m, i)) cells_touch(&m->cells, &m->layout->piece[i].contour, edge);
    for (int i = 0; i < m->layout->npiece; i++)
        if (wanted(m, i))
            FW_TRY(cells_inside(m->arena, &m->cells, &m->layout->piece[i].contour, edge, set));
    join_sets(set, set, edge, m->n);
    fw_arena_rewind(m->arena, mark);
    return FW_OK;
}

/* where hollows touch in a corner alone the ground between them is taken, until no such place is left */
static void join_corners(const maker *m) {
    int columns = m->cells.columns;
    for (bool again = true; again;) {
        again = false;
        for (int r = 0; r + 1 < m->cells.rows; r++)
            for (int c = 0; c + 1 < columns; c++) {
                unsigned char *p = &m->hollow[(size_t)r * (size_t)columns + (size_t)c];
                if (c + 8 < columns && !memcmp(p, p + 1, 8)) { /* nothing to either side */
                    c += 7;
                    continue;
                }
                if (p[0] == p[1] || p[columns] == p[columns + 1]) continue;
                bool one = p[0] && p[columns + 1] && !p[1] && !p[columns];
                bool other = p[1] && p[columns] && !p[0] && !p[columns + 1];
                if (!one && !other) continue;
                p[0] = p[1] = p[columns] = p[columns + 1] = 1;
                again = true;
            }
    }
}

/* a hollow beside ground that is itself surrounded: that ground goes */
static fw_status flatten_nested(maker *m) {
    parts p = {0};
    const size_t columns = (size_t)m->cells.columns;
    fw_mark mark = fw_arena_mark(m->arena);
    for (int r = 0; r < m->cells.rows; r++)
        FW_TRY(add_row(m->arena, &m->cells, m->hollow + (size_t)r * columns, r, &p.all));
    FW_NEED(p.outer = fw_arena_array(m->arena, bool, (size_t)p.all.n));
    FW_NEED(p.gone = fw_arena_array(m->arena, bool, (size_t)p.all.n));
    each_pair(&p, unite_alike);
    p.outside = part_of(&p.all, 0);
    each_pair(&p, mark_outer);
    each_pair(&p, mark_gone);
    for (int i = 0; i < p.all.n; i++) {
        const run *a = &p.all.item[i];
        if (p.gone[part_of(&p.all, i)])
            memset(m->hollow + (size_t)a->row * columns + a->from, 1, (size_t)(a->to - a->from));
    }
    fw_arena_rewind(m->arena, mark);
    return FW_OK;
}

/* outlines apart: those around hollows, and, turned round, those around ground within them */
static fw_status sort_outlines(maker *m, fw_release_cavity *cavity) {
    fw_geometry_region all;
    FW_TRY(cells_outlines(m->arena, &m->cells, m->hollow, &all));
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

/* cells that letters and marks touch, which are cleared */
static fw_status find_openings(maker *m) {
    FW_TRY(cells_set(m->arena, &m->cells, &m->opening));
    for (int i = 0; i < m->layout->npiece; i++)
        if (m->part_of[i] == FW_RELEASE_OPENING)
            cells_touch(&m->cells, &m->layout->piece[i].contour, m->opening);
    return FW_OK;
}

/* the columns and rows in which cells of a part may lie */
static span span_of_part(const maker *m, int part) {
    fw_geometry_box box = {0};
    bool any = false;
    for (int i = 0; i < m->layout->npiece; i++) {
        if (m->part_of[i] != part) continue;
        const fw_geometry_box own = fw_geometry_contour_box(&m->layout->piece[i].contour);
        box = any ? fw_box_join(box, own) : own;
        any = true;
    }
    return any ? span_of(&m->cells, box, 0.0) : (span){0, -1, 0, -1};
}

/* cells that lie whole in a part, less those of a set; none is outside of its span */
static fw_status whole_cells(maker *m, int part, span a, const unsigned char *without,
                             unsigned char *set) {
    unsigned char *edge;
    const size_t columns = (size_t)m->cells.columns;
    FW_TRY(cells_set(m->arena, &m->cells, &edge));
    memcpy(edge, m->opening, m->n);
    for (int i = 0; i < m->layout->npiece; i++)
        if (m->part_of[i] == part) cells_touch(&m->cells, &m->layout->piece[i].contour, edge);
    for (int i = 0; i < m->layout->npiece; i++)
        if (m->part_of[i] == part)
            FW_TRY(cells_inside(m->arena, &m->cells, &m->layout->piece[i].contour, edge, set));
    for (int r = a.r0; without && r <= a.r1; r++)
        for (int c = a.c0; c <= a.c1; c++)
            set[(size_t)r * columns + (size_t)c] &= !without[(size_t)r * columns + (size_t)c];
    return FW_OK;
}

static fw_status find_ground(maker *m, fw_release_cavity *cavity) {
    const size_t columns = (size_t)m->cells.columns;
    FW_NEED(cavity->ground = fw_arena_array(m->arena, fw_release_ground, (size_t)m->npart));
    FW_TRY(find_openings(m));
    for (int part = 0; part < m->npart; part++) {
        const fw_release_part *p = &m->part[part];
        if (p->duty != FW_RELEASE_STAYS) continue;
        fw_release_ground *g = &cavity->ground[cavity->nground++];
        *g = (fw_release_ground){
            .label = p->label, .role = p->role, .body = p->body, .area_m2 = p->area_m2};
        unsigned char *set;
        const span a = span_of_part(m, part);
        fw_mark mark = fw_arena_mark(m->arena);
        FW_TRY(cells_set(m->arena, &m->cells, &set));
        FW_TRY(whole_cells(m, part, a, m->hollow, set));
        for (int r = a.r0; r <= a.r1; r++)
            for (int c = a.c0; c <= a.c1; c++)
                if (set[(size_t)r * columns + (size_t)c])
                    g->bonded_m2 += m->cells.step_m * m->cells.step_m;
        FW_TRY(cells_square(m->arena, &m->cells, a, set, &g->square));
        fw_arena_rewind(m->arena, mark);
    }
    return FW_OK;
}

static span all_of(const maker *m) {
    return (span){0, m->cells.columns - 1, 0, m->cells.rows - 1};
}

static fw_status start(fw_arena *arena, const fw_layout *layout, double room_m, double step_m,
                       maker *m) {
    *m = (maker){.arena = arena, .layout = layout};
    FW_TRY(cells_over(layout->die, room_m, step_m, &m->cells));
    m->n = number_of(&m->cells);
    return fw_release_parts(arena, layout, true, &m->part_of, &m->part, &m->npart);
}

fw_status fw_release_cavity_make(fw_arena *arena, const fw_layout *layout,
                                 const fw_release_cavity_asked *asked, fw_release_cavity *cavity) {
    maker m;
    int k = (int)ceil(asked->margin_m / asked->step_m - 1e-9),
        w = (int)ceil(0.5 * asked->wall_m / asked->step_m - 1e-9);
    *cavity = (fw_release_cavity){0};
    FW_TRY(start(arena, layout, asked->margin_m + 2.0 * asked->wall_m, asked->step_m, &m));
    FW_TRY(cells_set(arena, &m.cells, &m.hollow));
    FW_TRY(cover(&m, is_free_to_move, m.hollow));
    FW_TRY(cells_grow(arena, &m.cells, k + w, m.hollow)); /* what is narrower than */
    FW_TRY(cells_grow(arena, &m.cells, -w, m.hollow));    /* a wall is closed */
    join_corners(&m);
    FW_TRY(flatten_nested(&m));
    FW_TRY(sort_outlines(&m, cavity));
    if (asked->drawn_only) return FW_OK;
    FW_TRY(cells_square(arena, &m.cells, all_of(&m), m.hollow, &cavity->widest));
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
    FW_TRY(find_openings(&m));
    FW_TRY(cells_set(arena, &m.cells, &set));
    FW_TRY(whole_cells(&m, m.part_of[piece], all_of(&m), NULL, set));
    FW_TRY(cells_grow(arena, &m.cells, -(int)ceil(clear_m / step_m - 1e-9), set));
    FW_TRY(cells_square(arena, &m.cells, all_of(&m), set, square));
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
