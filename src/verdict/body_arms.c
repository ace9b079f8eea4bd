/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies as beams. What is taken away of a body makes nothing stiffer, so that the strip of the
   circles inscribed along any way from a hinge to the body's middle gives at least as much as the
   body does there:

     E h give = integral over the way of 12 m m'/w^3 + a a'/w + 3.2 s s'/w,   w = 2 (distance to the edge)

   with m the moment, a the axial and s the shear force of a unit wrench, 3.2 >= 2.4 (1 + nu). The way is
   that of the least integral of 1/w^3 over a grid of cells (Hart, Nilsson and Raphael 1968: what is left of it is
   at least the distance over the largest w^3), w there from the distance to the nearest cell that an edge crosses. It is then moved square to itself, by up to a cell, to where the
   circle is largest to a hundredth of it, and there w is exact. */
#include "verdict/body.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ACROSS = 100, CELLS = 1000000 };
/* the narrowest place of a way has as many, or cells are halved: a coarse grid misses a slender bar */
static const double fw_cells_across = 1;
/* a cell is not below this: what is narrower is no part of a body */
static const double fw_least_cell = 2e-6;

typedef struct grid {
    fw_arena *arena, *kept; /* kept: of what arms keep */
    fw_mechanism_line *line;
    int nline;
    fw_geometry_box box;
    double cell;
    int nx, ny;
    bool *inside;
    double *away;  /* m, about, to the nearest edge */
    double *stiff; /* cell^3/away^3: what a cell adds to a way's cost */
    double least;  /* of those */
    int ninside;
    double *cost;            /* of the way there; HUGE_VAL: not reached; -1: no material */
    int *from;               /* the cell before; -1 */
    int *touched, ntouched;  /* cells with a cost */
    int *way, nway;          /* cells from a hinge to the middle */
    fw_verdict_arm_end *end; /* whose way that is */
    const fw_verdict_drawn *of;
} grid;

static void take_lines(const fw_verdict_drawn *from, grid *g) {
    g->line = from->line, g->nline = from->nline;
    for (int i = 0; i < g->nline; i++) {
        fw_geometry_vec2 a = g->line[i].a, b = g->line[i].b;
        fw_geometry_box box = {fw_lesser(a.x, b.x), fw_lesser(a.y, b.y), fw_greater(a.x, b.x),
                               fw_greater(a.y, b.y)};
        g->box = i == 0 ? box : fw_box_join(g->box, box);
    }
}

/* ---- cells ---- */

static fw_geometry_vec2 place(const grid *g, int at) {
    return (fw_geometry_vec2){g->box.x0 + (at % g->nx + 0.5) * g->cell,
                              g->box.y0 + (at / g->nx + 0.5) * g->cell};
}

static int column(const grid *g, double x) {
    return (int)fmin(fmax((x - g->box.x0) / g->cell, 0), g->nx - 1);
}

static int row(const grid *g, double y) {
    return (int)fmin(fmax((y - g->box.y0) / g->cell, 0), g->ny - 1);
}

/* Where the lines of one piece cross the middles of rows: into x, from `at` of each row on, which moves along; x NULL:
   they are counted there. */
static void cross_rows(const grid *g, int first, int last, int *at, double *x) {
    for (int i = first; i < last; i++) {
        fw_geometry_vec2 a = g->line[i].a, b = g->line[i].b;
        int from = row(g, fw_lesser(a.y, b.y) - g->cell), to = row(g, fw_greater(a.y, b.y));
        for (int j = from; j <= to; j++) {
            double y = g->box.y0 + (j + 0.5) * g->cell;
            if ((a.y <= y) == (b.y <= y)) continue;
            if (x) x[at[j]] = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
            at[j]++;
        }
    }
}

/* cells of a row within a piece: between crossings, two by two */
static void fill_row(grid *g, int j, double *x, int n) {
    for (int i = 1; i < n; i++) {
        const double at = x[i];
        int k = i;
        for (; k > 0 && x[k - 1] > at; k--)
            x[k] = x[k - 1];
        x[k] = at;
    }
    for (int k = 0; k + 1 < n; k += 2)
        for (int i = column(g, x[k]); i <= column(g, x[k + 1]); i++) {
            double centre = g->box.x0 + (i + 0.5) * g->cell;
            if (centre >= x[k] && centre <= x[k + 1]) g->inside[j * g->nx + i] = true;
        }
}

static fw_status fill_piece(grid *g, int first, int last) {
    const size_t ny = (size_t)g->ny;
    int *at = fw_arena_array(g->arena, int, ny), *end = fw_arena_array(g->arena, int, ny), n = 0;
    FW_NEED(at && end ? at : NULL);
    cross_rows(g, first, last, at, NULL);
    for (int j = 0; j < g->ny; j++)
        end[j] = n, n += at[j], at[j] = end[j];
    double *x = fw_arena_array(g->arena, double, (size_t)n);
    FW_NEED(x);
    cross_rows(g, first, last, end, x);
    for (int j = 0; j < g->ny; j++)
        fill_row(g, j, x + at[j], end[j] - at[j]);
    return FW_OK;
}

static fw_status fill(grid *g) {
    for (int first = 0, last; first < g->nline; first = last) {
        for (last = first; last < g->nline && g->line[last].piece == g->line[first].piece;)
            last++;
        FW_TRY(fill_piece(g, first, last));
    }
    return FW_OK;
}

/* ---- the distance to the nearest edge: rows of cells from row to row, then along each row. Squares of distances in
   cells are whole numbers, so that the order in which they are compared changes no bit (Felzenszwalb and
   Huttenlocher 2012 for the two passes). ---- */

typedef short eight __attribute__((vector_size(16), may_alias));
enum { TOGETHER = 8, FAR = 1 << 14 }; /* cells in lanes; of a cell whose column no edge crosses */
static const double fw_far = 1e12;    /* the square, where no edge is */

/* one row of cells no farther than the next one and a cell */
static void step_from(const eight *next, eight *row, int n) {
    for (int i = 0; i < n; i++) {
        const eight other = next[i] + 1, less = other < row[i];
        row[i] = (other & less) | (row[i] & ~less);
    }
}

static void mark_edges(const grid *g, short *off, int wide) {
    for (int i = 0; i < g->nline; i++) {
        const fw_mechanism_line *l = &g->line[i];
        int steps = 1 + (int)(2 * vec_distance(l->a, l->b) / g->cell);
        for (int k = 0; l->edge && k <= steps; k++) {
            fw_geometry_vec2 p = vec_along(l->a, (double)k / steps, vec_sub(l->b, l->a));
            off[row(g, p.y) * wide + column(g, p.x)] = 0;
        }
    }
}

/* Square of the distance to the nearest edge, of the cell i of a row, from what columns have between first and
   last. From a cell of the material the nearest edge is not far beyond where the material of its row ends, since an
   edge is there. */
static double square_at(const short *off, int i, int first, int last) {
    int best = off[i] * off[i];
    for (int k = 1; k * k < best && (i - k >= first || i + k <= last); k++) {
        const int a = i - k >= first ? off[i - k] : FAR, b = i + k <= last ? off[i + k] : FAR;
        const int nearer = a < b ? a : b, square = k * k + nearer * nearer;
        best = square < best ? square : best;
    }
    return best < FAR * FAR ? best : fw_far;
}

static void measure_row(grid *g, int j, const short *off) {
    enum { BEYOND = 3 };
    const bool *inside = g->inside + j * g->nx;
    int first = 0, last = g->nx - 1;
    while (first <= last && !inside[first])
        first++;
    while (last > first && !inside[last])
        last--;
    const int from = first > BEYOND ? first - BEYOND : 0,
              to = last + BEYOND < g->nx ? last + BEYOND : g->nx - 1;
    for (int i = first; i <= last; i++) {
        if (!inside[i]) continue;
        const int at = j * g->nx + i;
        const double cells = sqrt(square_at(off, i, from, to)), w = fw_greater(cells, 0.5);
        g->away[at] = g->cell * cells;
        g->stiff[at] = 1 / (w * w * w);
        g->least = fw_lesser(g->least, g->stiff[at]);
        g->cost[at] = HUGE_VAL;
        g->ninside++;
    }
}

static fw_status measure(grid *g) {
    const int across = (g->nx + TOGETHER - 1) / TOGETHER, wide = across * TOGETHER;
    eight *rows = fw_arena_raw(g->arena, (size_t)across * (size_t)g->ny * sizeof *rows);
    FW_NEED(rows);
    for (int i = 0; i < across * g->ny; i++)
        rows[i] = (eight){0} + FAR;
    mark_edges(g, (short *)rows, wide);
    for (int j = 1; j < g->ny; j++)
        step_from(rows + (j - 1) * across, rows + j * across, across);
    for (int j = g->ny - 2; j >= 0; j--)
        step_from(rows + (j + 1) * across, rows + j * across, across);
    for (int i = 0; i < g->nx * g->ny; i++)
        g->cost[i] = -1;
    for (int j = 0; j < g->ny; j++)
        measure_row(g, j, (const short *)(rows + j * across));
    return FW_OK;
}

static fw_status lay(grid *g, double cell) {
    g->cell = cell;
    g->least = HUGE_VAL, g->ninside = 0;
    g->nx = 1 + (int)((g->box.x1 - g->box.x0) / cell);
    g->ny = 1 + (int)((g->box.y1 - g->box.y0) / cell);
    size_t n = (size_t)g->nx * (size_t)g->ny;
    FW_NEED(g->inside = fw_arena_array(g->arena, bool, n));
    FW_NEED(g->away = fw_arena_raw(g->arena, n * sizeof(double)));
    FW_NEED(g->stiff =
                fw_arena_raw(g->arena, n * sizeof(double))); /* of cells inside, as the rest */
    FW_NEED(g->cost = fw_arena_raw(g->arena, n * sizeof(double)));
    FW_NEED(g->from = fw_arena_raw(g->arena, n * sizeof(int)));
    FW_TRY(fill(g));
    return measure(g);
}

/* ---- the stiffest ways ---- */

typedef struct queued {
    double key, cost; /* of the whole way at least; up to the cell */
    int cell;
} queued;

typedef struct queue {
    queued *item;
    int n;
} queue;

static void push(queue *q, const queued *one) {
    int i = q->n++;
    for (; i > 0 && q->item[(i - 1) / 2].key > one->key; i = (i - 1) / 2)
        q->item[i] = q->item[(i - 1) / 2];
    q->item[i] = *one;
}

static queued pop(queue *q) {
    const queued top = q->item[0], last = q->item[--q->n];
    int i = 0;
    for (int child; (child = 2 * i + 1) < q->n; i = child) {
        if (child + 1 < q->n && q->item[child + 1].key < q->item[child].key) child++;
        if (q->item[child].key >= last.key) break;
        q->item[i] = q->item[child];
    }
    q->item[i] = last;
    return top;
}

/* along columns and rows, and across */
static const int step_x[8] = {1, -1, 0, 0, 1, 1, -1, -1}, step_y[8] = {0, 0, 1, -1, 1, -1, 1, -1};

static fw_status begin_search(grid *g, queue *q) {
    const size_t n = (size_t)g->nx * (size_t)g->ny;
    const size_t most = 1 + 8 * (size_t)g->ninside; /* a cell of the material has 8 neighbours */
    g->ntouched = 0;
    FW_NEED(q->item = fw_arena_raw(g->arena, most * sizeof(queued)));
    FW_NEED(g->touched = fw_arena_raw(g->arena, n * sizeof(int)));
    FW_NEED(g->way = fw_arena_raw(g->arena, n * sizeof(int)));
    return FW_OK;
}

/* cost of a way to a cell at least: straight and across, in the widest place */
static double least_to(const grid *g, int x, int y, int to) {
    const int dx = abs(x - to % g->nx), dy = abs(y - to / g->nx);
    const int far = dx > dy ? dx : dy, near = dx > dy ? dy : dx;
    return g->least * (far + (sqrt(2) - 1) * near);
}

static void offer(grid *g, queue *q, int to, int from, double cost, double left) {
    if (g->cost[to] == HUGE_VAL) g->touched[g->ntouched++] = to;
    g->cost[to] = cost;
    g->from[to] = from;
    push(q, &(queued){cost + left, cost, to});
}

static void spread_from(grid *g, queue *q, const queued *now, int middle) {
    const int at = now->cell, x = at % g->nx, y = at / g->nx;
    const bool inner = x > 0 && y > 0 && x < g->nx - 1 && y < g->ny - 1;
    for (int k = 0; k < 8; k++) {
        int i = x + step_x[k], j = y + step_y[k], to = j * g->nx + i;
        if (!inner && (i < 0 || j < 0 || i >= g->nx || j >= g->ny)) continue;
        if (g->cost[to] <= now->cost) continue; /* as that of a cell outside */
        double far = k < 4 ? 1 : sqrt(2),
               cost = now->cost + 0.5 * far * (g->stiff[at] + g->stiff[to]);
        if (cost < g->cost[to]) offer(g, q, to, at, cost, least_to(g, i, j, middle));
    }
}

/* the way from a cell to the middle; without one nway is 0 */
static void find_way(grid *g, queue *q, int begin, int middle) {
    for (int i = 0; i < g->ntouched; i++)
        g->cost[g->touched[i]] = HUGE_VAL;
    g->ntouched = g->nway = q->n = 0;
    offer(g, q, begin, -1, 0, 0);
    while (q->n > 0 && g->nway == 0) {
        const queued now = pop(q);
        if (now.cost > g->cost[now.cell]) continue;
        if (now.cell != middle) {
            spread_from(g, q, &now, middle);
            continue;
        }
        for (int at = middle; at >= 0; at = g->from[at])
            g->nway++;
        for (int at = middle, i = g->nway; at >= 0; at = g->from[at])
            g->way[--i] = at;
    }
}

/* The cell of the material that is nearest to a place, nearer by so many times its distance from the edge, the first
   of those that are as near; -1: there is none. Rows from that of the place outwards, of each what may be nearer. */
static int cell_at(const grid *g, fw_geometry_vec2 at, double deep) {
    const double most = 1.000001 * deep * g->cell / cbrt(g->least);
    const int middle = row(g, at.y);
    int found = -1;
    double best = HUGE_VAL;
    for (int k = 0; k < 2 * g->ny; k++) {
        const int j = middle + (k % 2 ? (k + 1) / 2 : -k / 2);
        if (j < 0 || j >= g->ny) continue;
        if ((k / 2 - 1) * g->cell - most > best) break;
        const double reach = best + most + g->cell, y = g->box.y0 + (j + 0.5) * g->cell - at.y;
        const int first = isfinite(best) ? column(g, at.x - reach) : 0,
                  last = isfinite(best) ? column(g, at.x + reach) : g->nx - 1;
        for (int i = first; i <= last; i++) {
            const int cell = j * g->nx + i;
            if (!g->inside[cell]) continue;
            fw_geometry_vec2 off = {g->box.x0 + (i + 0.5) * g->cell - at.x, y};
            if (deep == 0 && vec_dot(off, off) > 1.000001 * best * best) continue; /* no root */
            double d = vec_length(off) - (deep > 0 ? deep * g->away[cell] : 0);
            if (d < best || (d == best && cell < found)) best = d, found = cell;
        }
    }
    return found;
}

/* ---- along a way ---- */

enum { FARTHER = 12 };

typedef struct edges {
    fw_geometry_lines all, near; /* near: those around a place */
    fw_geometry_lines
        wide;    /* those that may be around any place up to FARTHER cells from `centre` */
    double *off; /* squared distances from a place */
    fw_geometry_vec2 centre;
} edges;

static fw_status edges_new(const grid *g, edges *to) {
    FW_TRY(fw_geometry_lines_new(g->arena, g->nline, &to->all));
    FW_TRY(fw_geometry_lines_new(g->arena, g->nline, &to->near));
    FW_TRY(fw_geometry_lines_new(g->arena, g->nline, &to->wide));
    FW_NEED(to->off =
                fw_arena_array(g->arena, double, (size_t)g->nline + FW_GEOMETRY_LINES_TOGETHER));
    for (int i = 0; i < g->nline; i++) {
        const fw_mechanism_line *l = &g->line[i];
        if (l->edge) fw_geometry_lines_add(&to->all, l->a.x, l->a.y, l->b.x, l->b.y);
    }
    return FW_OK;
}

/* in one of the pieces: a line to the right crosses it an odd number of times. In a cell of the material that is
   some cells from every edge all places are. */
static bool is_inside(const grid *g, fw_geometry_vec2 p) {
    const int cell = row(g, p.y) * g->nx + column(g, p.x);
    bool in = false;
    if (g->inside[cell] && g->away[cell] > 3 * g->cell) return true;
    for (int i = 0; i < g->nline; i++) {
        fw_geometry_vec2 a = g->line[i].a, b = g->line[i].b;
        if (i > 0 && g->line[i].piece != g->line[i - 1].piece) {
            if (in) return true;
            in = false;
        }
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) in = !in;
    }
    return in;
}

/* of `from` those that are no farther from a place than the nearest and `more` */
static void within(const fw_geometry_lines *from, fw_geometry_vec2 at, double more, double *off,
                   fw_geometry_lines *to) {
    double most = sqrt(fw_geometry_lines_least_square(from, at, off)) + more;
    to->n = 0;
    for (int i = 0; i < from->n; i++)
        if (off[i] <= most * most)
            fw_geometry_lines_add(to, from->ax[i], from->ay[i], from->bx[i], from->by[i]);
}

/* the edges that may be the nearest of any place within a cell and a half */
static void look_around(const grid *g, fw_geometry_vec2 at, edges *around) {
    if (around->wide.n == 0 || vec_distance(at, around->centre) > FARTHER * g->cell) {
        around->centre = at;
        within(&around->all, at, (2 * FARTHER + 4) * g->cell, around->off, &around->wide);
    }
    within(&around->wide, at, 3 * g->cell, around->off, &around->near);
}

static double nearest(edges *around, fw_geometry_vec2 at) {
    return sqrt(fw_geometry_lines_least_square(&around->near, at, around->off));
}

static bool is_cut(const edges *around, fw_geometry_vec2 p, fw_geometry_vec2 q) {
    fw_geometry_vec2 along = vec_sub(q, p);
    const fw_geometry_lines *l = &around->near;
    for (int i = 0; i < l->n; i++) {
        const fw_geometry_vec2 from = {l->ax[i], l->ay[i]}, to = {l->bx[i], l->by[i]},
                               edge = vec_sub(to, from);
        double a = vec_cross(along, vec_sub(from, p)), b = vec_cross(along, vec_sub(to, p));
        double c = vec_cross(edge, vec_sub(p, from)), d = vec_cross(edge, vec_sub(q, from));
        if ((a > 0) != (b > 0) && (c > 0) != (d > 0)) return true;
    }
    return false;
}

/* a place square to the way where the circle is largest, from one in the material and nowhere beyond an
   edge; returns its diameter */
static double widest(const grid *g, edges *around, fw_geometry_vec2 *at, fw_geometry_vec2 side) {
    const fw_geometry_vec2 from = *at;
    look_around(g, from, around);
    double best = nearest(around, from), where = 0;
    for (double step = 0.5; step * g->cell > 0.02 * best; step /= 2) {
        const double middle = where;
        for (int k = step < 0.5 ? 1 : 2; k != 0; k = k > 0 ? -k : -k - 1) {
            double to = middle + k * step;
            fw_geometry_vec2 p = vec_along(from, to * g->cell, side);
            double d = nearest(around, p);
            if (d > best && !is_cut(around, from, p)) best = d, where = to, *at = p;
        }
    }
    return 2 * best;
}

static void add_piece(const grid *g, const fw_verdict_pierced *pierced, fw_geometry_vec2 at,
                      fw_geometry_vec2 from, fw_geometry_vec2 until, double w) {
    fw_verdict_arm_end *end = g->end;
    fw_verdict_arm_add(end->to, end->pin, at, from, until, w);
    fw_verdict_arm_rims(pierced, end->pin, from, until, w, end->to);
    end->to->strip[end->to->nstrip++] = (fw_verdict_strip){at, from, until, w};
}

/* From where a way ends up to the middle of the cut of a base, as wide as its last circle; and the frame, which gives as if the
   base went on into it by 0.44 of the cut: 5.3 M/(E h w^2) (W. J. O'Donnell, J. Appl. Mech. 27 (1960) 461) */
static void add_foot(const grid *g, const fw_verdict_pierced *pierced, fw_geometry_vec2 from,
                     double w) {
    const double goes_on = 5.3 / 12;
    const fw_verdict_drawn *to = g->of;
    const fw_geometry_vec2 cut = to->middle, left = vec_left(to->along),
                           out = vec_dot(vec_sub(cut, from), left) < 0 ? vec_scale(-1, left) : left,
                           frame = vec_along(cut, goes_on * to->foot_m, out);
    if (vec_distance(from, cut) > 0)
        add_piece(g, pierced, vec_along(from, 0.5, vec_sub(cut, from)), from, cut, w);
    add_piece(g, pierced, vec_along(cut, 0.5, vec_sub(frame, cut)), cut, frame, to->foot_m);
}

/* Two cells at a time, from half way to the circle before to half way to the one behind; the flexure's own
   root is in its closed form: the way begins where it is a cell inside */
static fw_status follow(const grid *g, edges *around, const fw_verdict_pierced *pierced) {
    const int last = g->nway - 1;
    around->wide.n = 0;
    g->end->to->known = true;
    g->end->to->narrow_m = HUGE_VAL;
    FW_NEED(g->end->to->strip = fw_arena_array(g->kept, fw_verdict_strip, (size_t)g->nway + 4));
    fw_geometry_vec2 from = place(g, g->way[0]), here = from;
    double w = 0;
    for (int i = 0; i < last;) {
        const int to = i + 1 < last ? i + 2 : i + 1;
        fw_geometry_vec2 p = place(g, g->way[i]), off = vec_sub(place(g, g->way[to]), p);
        fw_geometry_vec2 next = vec_along(p, 0.5, off);
        if (!is_inside(g, next)) next = p;
        double wide = widest(g, around, &next, vec_left(vec_unit(off)));
        fw_geometry_vec2 until = w > 0 ? vec_along(here, 0.5, vec_sub(next, here)) : from;
        if (w > 0) add_piece(g, pierced, here, from, until, w);
        from = until, here = next, i = to;
        w = fw_greater(wide, 1e-3 * g->cell);
    }
    if (last > 0) add_piece(g, pierced, here, from, place(g, g->way[last]), w);
    if (last > 0 && g->of->foot_m > 0) add_foot(g, pierced, place(g, g->way[last]), w);
    return FW_OK;
}

/* Does a way from this cell begin at the place? Of an arm between two rows of cells the nearest one is elsewhere. */
static bool begins_at(const grid *g, const edges *around, fw_geometry_vec2 at, int cell) {
    if (cell < 0) return false;
    const double beside_m =
        is_inside(g, at) ? 0 : sqrt(fw_geometry_lines_least_square(&around->all, at, around->off));
    return vec_distance(place(g, cell), at) <= beside_m + 1.5 * g->cell;
}

/* ---- all ends of a drawn piece ---- */

/* what straight cuts need of a body; of which end they are told later */
static fw_status pierced_of(const grid *g, const fw_verdict_arm_end *ends, int nhinge,
                            fw_verdict_pierced *out) {
    FW_NEED(out->room = fw_arena_array(g->arena, double, (size_t)g->nline + 1));
    FW_NEED(out->hinge = fw_arena_array(g->arena, fw_geometry_vec2, (size_t)nhinge + 1));
    for (int k = 0; k < nhinge; k++)
        out->hinge[k] = ends[k].root;
    out->line = g->line, out->n = g->nline, out->nhinge = nhinge;
    return fw_verdict_pierced_boxes(g->arena, out);
}

static fw_status keep_way(const grid *g, fw_verdict_arm *to) {
    FW_NEED(to->way = fw_arena_array(g->kept, fw_geometry_vec2, (size_t)g->nway));
    for (int i = 0; i < g->nway; i++)
        to->way[i] = place(g, g->way[i]);
    to->nway = g->nway;
    return FW_OK;
}

fw_status fw_verdict_arms_of(fw_arena *scratch, fw_arena *kept, const fw_verdict_drawn *from,
                             fw_verdict_arm_end *ends, int nhinge, int n, double hole_m) {
    grid g = {.arena = scratch, .kept = kept, .of = from};
    fw_verdict_pierced pierced = {.hole_m = hole_m};
    take_lines(from, &g);
    if (g.nline == 0) return FW_OK;
    FW_TRY(pierced_of(&g, ends, nhinge, &pierced));
    double across = vec_length((fw_geometry_vec2){g.box.x1 - g.box.x0, g.box.y1 - g.box.y0});
    double cell = fw_greater(across / ACROSS, fw_least_cell);
    fw_mark lines = fw_arena_mark(scratch);
    bool all = false;
    for (int turn = 0; turn < from->finest && !all; turn++, cell /= 2) {
        double cells = across * across / (cell * cell);
        if (cells > CELLS) break;
        fw_arena_rewind(scratch, lines); /* the former cells */
        FW_TRY(lay(&g, cell));
        int middle = cell_at(&g, from->middle, from->deep);
        if (middle < 0) continue;
        queue q;
        edges around;
        FW_TRY(begin_search(&g, &q));
        FW_TRY(edges_new(&g, &around));
        all = true;
        for (int i = 0; i < n; i++) {
            fw_verdict_arm *to = ends[i].to;
            *to = (fw_verdict_arm){.known = false, .pin = ends[i].pin};
            pierced.own = i, pierced.root = ends[i].root;
            const int begin = cell_at(&g, ends[i].root, 0);
            find_way(&g, &q, begin, middle);
            const bool there = begins_at(&g, &around, ends[i].root, begin);
            g.end = &ends[i];
            if (g.nway > 0 && (there || i < nhinge)) FW_TRY(follow(&g, &around, &pierced));
            if (to->known && i < nhinge) FW_TRY(keep_way(&g, to));
            to->lost = !to->known && i >= nhinge;
            if (!to->known || !there || to->narrow_m < fw_cells_across * cell) all = false;
        }
    }
    FW_TRY(fw_verdict_ways_meet(kept, ends, n, g.cell, from->middle));
    for (int i = 0; i < nhinge; i++) {
        pierced.own = i, pierced.root = ends[i].root;
        if (ends[i].to->known) fw_verdict_arm_cut_at_edge(&pierced, ends[i].to);
    }
    return FW_OK;
}

fw_status fw_verdict_shared_arms(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                                 fw_verdict_arm **to) {
    const size_t n = 2 * (size_t)m->nhinge;
    fw_geometry_vec2 pin, root;
    *to = NULL;
    if (!arm) return FW_OK;
    FW_NEED(*to = fw_arena_grow(arena, arm, n, n, sizeof *arm));
    for (int b = 0; b < m->nbody; b++) {
        int ends = 0, last = 0;
        for (int k = 0; k < 2 * m->nhinge; k++)
            if (fw_mechanism_hinge_end(m, b, k, &pin, &root)) ends++, last = k;
        if (ends == 1) (*to)[last].known = false;
    }
    return FW_OK;
}
