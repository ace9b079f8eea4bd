/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a body gives under all that acts on it at once, as a plane solid in place of a beam for each hinge (body_arms.c):
   two legs that press it from either side bend nothing of it.

   Square cells of plane stress, bilinear with Taylor's incompatible modes (Taylor, Beresford, Wilson 1976), Poisson's
   ratio 0.3, of a stiffness

     E h f/(3 - 2 f),   f the share of the cell that is material

   which is that of the stiffest plate with holes of that share (Hashin and Shtrikman 1963, in the plane), and of round
   ones that are few: what an edge cuts gives more than it does, which is a bound. Closely, a cell that an edge cuts has the
   stiffness of what of it is material, by four points with its mean and second moments (the finite cell method, Parvizian, Duester,
   Rank 2007): slender bars of any direction within 2 % at seven cells
   across and 5 % at four; edges as made to a seventh of what they change. A wrench w = (M, Fx, Fy) acts on nodes about
   its place with weights by the stiffness around them, and the body as a whole moves as by its inertia: forces that
   go with the area balance it. So every column is in equilibrium, no support is needed, and

     U = w^T C w/(2 E h),   C = P^T K^-1 P,   P the nodes' forces of unit wrenches

   holds for any sum of them. In: outlines of the layout in the drawn pose. Error: from a second mesh with cells
   twice as large; crystals count as isotropic, 15 % (fw_mechanism_solid_energy_J). Cost: of 6000 cells and 6 ends about
   0.1 s. Range: NARROW cells across the narrowest place as far as CELLS of material and a GRID of so many places allow it; not known where that is narrower than a
   cell. Of a motion what else acts on a body does so in its middle (wrenches_of). Test: test_body_solid.c */
#include "base/sort.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism.h"
#include <math.h>
#include <string.h>

enum {
    CELLS = 12000,
    CLOSELY = 4500,
    GRID = 200000,
    ACROSS = 80,
    NARROW = 4,
    SAMPLES = 5,
    CLOSE = 16
};
static const double fw_hardly_there = 0.05; /* a share of material below that is none */

typedef struct grid {
    fw_arena *arena;
    const fw_mechanism_line *line;
    int nline;
    fw_geometry_box box;
    double edge_m;          /* by which edges stand out */
    double cell_m, reach_m; /* reach: of a wrench about its place */
    int nx, ny;
    double *share; /* (nx ny) of material */
    bool close;    /* cells have the stiffness of what of them is material, where it lies */
    int samples;   /* to a cell's side */
    double *
        moment; /* (6 nx ny) sums of 1, x, y, x^2, x y, y^2 over samples, sides 2; NULL: where in its cell an edge lies is not asked */
    int *node;  /* ((nx + 1)(ny + 1)) its number; FW_MATHS_NONE */
    int nnode, *at; /* at: (nnode) place of a node in the grid */
    double *weight; /* (nnode) stiffness about it */
    double *area;   /* (nnode) of material about it, m2 */
} grid;

/* ---- what is drawn of a body ---- */

bool fw_mechanism_is_of(const fw_layout_piece *p, int body) {
    return p->body == body && p->role == FW_ROLE_STRUCTURE;
}

fw_status fw_mechanism_body_lines(fw_arena *arena, const fw_layout *layout, int body,
                                  fw_mechanism_line **line, int *n) {
    size_t most = 0;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_geometry_contour *c = &layout->piece[i].contour;
        for (int k = 0; fw_mechanism_is_of(&layout->piece[i], body) && k < c->count; k++)
            most += (size_t)fw_geometry_segment_parts(&c->segment[k]);
    }
    FW_NEED(*line = fw_arena_array(arena, fw_mechanism_line, most));
    *n = 0;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_geometry_contour *c = &layout->piece[i].contour;
        for (int k = 0; fw_mechanism_is_of(&layout->piece[i], body) && k < c->count; k++) {
            const fw_geometry_segment *s = &c->segment[k];
            int parts = fw_geometry_segment_parts(s);
            fw_geometry_vec2 from = fw_geometry_segment_point(s, 0);
            for (int j = 0; j < parts; j++) {
                fw_geometry_vec2 to = fw_geometry_segment_point(s, (double)(j + 1) / parts);
                (*line)[(*n)++] = (fw_mechanism_line){from, to, !(s->flags & FW_SEGMENT_JOINT), i};
                from = to;
            }
        }
    }
    return FW_OK;
}

/* ---- how much of every cell is material: along rows exactly, across by subrows ---- */

typedef struct filled {
    const fw_mechanism_cells *of;
    const fw_mechanism_line *line;
    const bool *left_out;
    int nline;
} filled;

typedef struct crossed {
    double x; /* in cells */
    int piece;
} crossed;

static int by_piece(const void *a, const void *b) {
    const crossed *p = a, *q = b;
    return p->piece != q->piece ? (p->piece > q->piece) - (p->piece < q->piece)
                                : fw_order_doubles(p->x, q->x);
}

/* where lines cross the middles of subrows: n[k] of row k on, to x; x NULL: they are counted */
static void cross_subrows(const filled *t, int *n, crossed *x) {
    const int rows = t->of->ny * FW_MECHANISM_SUBROWS;
    const double fine = t->of->cell_m / FW_MECHANISM_SUBROWS;
    for (int i = 0; i < t->nline; i++) {
        const fw_geometry_vec2 a = t->line[i].a, b = t->line[i].b;
        const int first = (int)((fmin(a.y, b.y) - t->of->box.y0) / fine),
                  last = (int)((fmax(a.y, b.y) - t->of->box.y0) / fine) + 1;
        for (int k = first > 0 ? first - 1 : 0; !t->left_out[i] && k <= last && k < rows; k++) {
            const double y = t->of->box.y0 + (k + 0.5) * fine;
            if ((a.y <= y) == (b.y <= y)) continue;
            if (x) {
                const double at = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                x[n[k]] = (crossed){(at - t->of->box.x0) / t->of->cell_m, t->line[i].piece};
            }
            n[k]++;
        }
    }
}

/* To row (n), which has what its subrows fill of the cells at the ends of their intervals: more (n), by how many subrows each cell
   is filled whole more than the one before it. Out: the share of each that is filled. */
static void sum_row(float *row, const float *more, int n) {
    float whole = 0;
    for (int i = 0; i < n; i++) {
        whole += more[i];
        row[i] = fminf((row[i] + whole) / FW_MECHANISM_SUBROWS, 1);
    }
}

fw_status fw_mechanism_fill_cells(fw_arena *arena, const fw_mechanism_line *line,
                                  const bool *left_out, int nline, const fw_mechanism_cells *of,
                                  float *full) {
    const filled *t = &(filled){of, line, left_out, nline};
    const int rows = of->ny * FW_MECHANISM_SUBROWS;
    int *n = fw_arena_array(arena, int, (size_t)rows), all = 0;
    FW_NEED(n);
    cross_subrows(t, n, NULL);
    for (int k = 0; k < rows; k++)
        all += n[k], n[k] = all - n[k];
    crossed *x = fw_arena_raw(arena, ((size_t)all + 1) * sizeof *x);
    float *more = fw_arena_raw(arena, (size_t)of->nx * sizeof *more);
    FW_NEED(x);
    FW_NEED(more);
    cross_subrows(t, n, x); /* n[k]: where the next row begins */
    for (int k = 0; k < rows; k++) {
        const int first = k > 0 ? n[k - 1] : 0;
        float *row = full + (size_t)(k / FW_MECHANISM_SUBROWS) * (size_t)of->nx;
        if (k % FW_MECHANISM_SUBROWS == 0) memset(more, 0, (size_t)of->nx * sizeof *more);
        if (n[k] - first > 2) qsort(x + first, (size_t)(n[k] - first), sizeof *x, by_piece);
        for (int i = first; i + 1 < n[k]; i += 2) {
            const double from = fmin(x[i].x, x[i + 1].x), to = fmax(x[i].x, x[i + 1].x);
            const int a = (int)from, b = (int)to;
            row[a] += (float)(fmin(to, a + 1) - from);
            if (b == a) continue;
            row[b] += (float)(to - b);
            more[a + 1]++, more[b]--;
        }
        if (k % FW_MECHANISM_SUBROWS == FW_MECHANISM_SUBROWS - 1) sum_row(row, more, of->nx);
    }
    return FW_OK;
}

/* ---- cells ---- */

static void mark_between(bool *row, int n, const double *x, int crossings) {
    for (int k = 0; k + 1 < crossings; k += 2) {
        const int first = (int)ceil(fmax(x[k] - 0.5, 0)),
                  last = (int)floor(fmin(x[k + 1] - 0.5, n - 1));
        for (int i = first; i <= last; i++)
            row[i] = true;
    }
}

/* samples of a row at height y that lie in any piece */
static void sample_row(const grid *s, double y, double *x, bool *row) {
    const double fine = s->cell_m / s->samples;
    const int n = s->nx * s->samples;
    for (int i = 0; i < n; i++)
        row[i] = false;
    for (int first = 0, last; first < s->nline; first = last) {
        int crossings = 0;
        for (last = first; last < s->nline && s->line[last].piece == s->line[first].piece; last++) {
            const fw_geometry_vec2 a = s->line[last].a, b = s->line[last].b;
            if ((a.y <= y) == (b.y <= y)) continue;
            x[crossings++] = (a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) - s->box.x0) / fine;
        }
        fw_sort_doubles(x, (size_t)crossings);
        mark_between(row, n, x, crossings);
    }
}

static void add_moment(const grid *s, int i, int j) {
    const double x = (2 * (i % s->samples) + 1.0) / s->samples - 1,
                 y = (2 * (j % s->samples) + 1.0) / s->samples - 1;
    double *to = s->moment + 6 * (size_t)(j / s->samples * s->nx + i / s->samples);
    to[0] += 1, to[1] += x, to[2] += y, to[3] += x * x, to[4] += x * y, to[5] += y * y;
}

static fw_status share_cells(grid *s) {
    bool *row = fw_arena_array(s->arena, bool, (size_t)s->nx *(size_t)s->samples);
    double *x = fw_arena_array(s->arena, double, (size_t)s->nline + 1);
    const double one = 1.0 / (s->samples * s->samples);
    FW_NEED(row && x ? row : NULL);
    for (int j = 0; j < s->ny * s->samples; j++) {
        if (fw_arena_cancelled(s->arena)) return FW_CANCELLED;
        sample_row(s, s->box.y0 + (j + 0.5) / s->samples * s->cell_m, x, row);
        for (int i = 0; i < s->nx * s->samples; i++) {
            if (!row[i]) continue;
            s->share[j / s->samples * s->nx + i / s->samples] += one;
            if (s->moment) add_moment(s, i, j);
        }
    }
    return FW_OK;
}

/* The area between an edge as drawn and as made goes to the cells on either side of it that can take it */
static void move_edge(grid *s, const fw_mechanism_line *line) {
    const fw_geometry_vec2 off = vec_sub(line->b, line->a), side = vec_left(vec_unit(off));
    const double length = vec_length(off);
    const int steps = 1 + (int)(4 * length / s->cell_m);
    for (int i = 0; i < steps; i++) {
        const fw_geometry_vec2 at = vec_along(line->a, (i + 0.5) / steps, off);
        int cell[2], best = 0;
        for (int k = 0; k < 2; k++) {
            const fw_geometry_vec2 p = vec_along(at, (k ? -0.3 : 0.3) * s->cell_m, side);
            const int x = (int)fmin(fmax((p.x - s->box.x0) / s->cell_m, 0), s->nx - 1),
                      y = (int)fmin(fmax((p.y - s->box.y0) / s->cell_m, 0), s->ny - 1);
            cell[k] = y * s->nx + x;
        }
        if ((s->share[cell[1]] > s->share[cell[0]]) == (s->edge_m < 0)) best = 1;
        const double by = s->edge_m * length / steps / (s->cell_m * s->cell_m);
        s->share[cell[best]] = fmin(fmax(s->share[cell[best]] + by, 0), 1);
    }
}

/* keeps what hangs together with the cell: a corner alone holds nothing */
static fw_status keep_connected(grid *s, int from) {
    const int n = s->nx * s->ny;
    bool *kept = fw_arena_array(s->arena, bool, (size_t)n);
    int *queue = fw_arena_array(s->arena, int, (size_t)n), first = 0, last = 0;
    FW_NEED(kept && queue ? kept : NULL);
    kept[from] = true, queue[last++] = from;
    while (first < last) {
        const int c = queue[first++], i = c % s->nx, j = c / s->nx;
        const int next[4] = {i > 0 ? c - 1 : c, i + 1 < s->nx ? c + 1 : c, j > 0 ? c - s->nx : c,
                             j + 1 < s->ny ? c + s->nx : c};
        for (int k = 0; k < 4; k++)
            if (!kept[next[k]] && s->share[next[k]] >= fw_hardly_there)
                kept[next[k]] = true, queue[last++] = next[k];
    }
    for (int c = 0; c < n; c++)
        if (!kept[c]) s->share[c] = 0;
    return FW_OK;
}

static double stiffness(const grid *s, double share) {
    return s->moment ? share : share / (3 - 2 * share);
}

/* corner k of a cell, counter-clockwise, in the grid of nodes */
static int corner_of(const grid *s, int cell, int k) {
    const int i = cell % s->nx + (k == 1 || k == 2), j = cell / s->nx + (k >= 2);
    return j * (s->nx + 1) + i;
}

static fw_status number_nodes(grid *s) {
    const size_t n = (size_t)(s->nx + 1) * (size_t)(s->ny + 1);
    FW_NEED(s->node = fw_arena_array(s->arena, int, n));
    FW_NEED(s->at = fw_arena_array(s->arena, int, n));
    FW_NEED(s->weight = fw_arena_array(s->arena, double, n));
    FW_NEED(s->area = fw_arena_array(s->arena, double, n));
    for (size_t i = 0; i < n; i++)
        s->node[i] = FW_MATHS_NONE;
    for (int c = 0; c < s->nx * s->ny; c++)
        for (int k = 0; s->share[c] > 0 && k < 4; k++) {
            const int at = corner_of(s, c, k);
            if (s->node[at] == FW_MATHS_NONE) s->at[s->nnode] = at, s->node[at] = s->nnode++;
            s->weight[s->node[at]] += stiffness(s, s->share[c]);
            s->area[s->node[at]] += 0.25 * s->share[c] * s->cell_m * s->cell_m;
        }
    return FW_OK;
}

static fw_geometry_vec2 place_of(const grid *s, int node) {
    const int at = s->at[node];
    return (fw_geometry_vec2){s->box.x0 + at % (s->nx + 1) * s->cell_m,
                              s->box.y0 + at / (s->nx + 1) * s->cell_m};
}

/* ---- stiffness ---- */

/* Four points with the mean and the second moments of the material in a cell: those of Gauss where it is full */
static void points_in(const double *moment, double point[4][2]) {
    const double n = moment[0], x = moment[1] / n, y = moment[2] / n, xy = moment[4] / n - x * y,
                 xx = fmax(moment[3] / n - x * x, 0), yy = fmax(moment[5] / n - y * y, 0),
                 turn = 0.5 * atan2(2 * xy, xx - yy), c = cos(turn), s = sin(turn),
                 half = hypot(0.5 * (xx - yy), xy), a = sqrt(0.5 * (xx + yy) + half),
                 b = sqrt(fmax(0.5 * (xx + yy) - half, 0));
    for (int i = 0; i < 4; i++) {
        const double along = i == 0 || i == 3 ? -a : a, across = i < 2 ? -b : b;
        point[i][0] = x + c * along - s * across;
        point[i][1] = y + s * along + c * across;
    }
}

/* of a cell over E h, which its size is not in, and the share that is material: corners counter-clockwise, x and y of each.
   Strains at the points by 8 displacements of corners and 4 of the modes 1 - xi^2, 1 - eta^2, less their mean, so that even
   strains have no part in them; they are eliminated where the material suffices for them */
static void cell_stiffness(const double point[4][2], double to[8][8]) {
    enum { CORNERS = 8, ALL = 12, MODES = 4 };
    const double nu = 0.3, d = 1 / (1 - nu * nu), g = 0.5 * (1 - nu) * d,
                 corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    double full[ALL][ALL] = {{0}}, own[MODES * MODES], by[MODES], mean[2] = {0};
    for (int p = 0; p < 4; p++)
        mean[0] += 0.25 * point[p][0], mean[1] += 0.25 * point[p][1];
    for (int p = 0; p < 4; p++) {
        const double x = point[p][0], y = point[p][1];
        double b[3][ALL] = {{0}};
        for (int k = 0; k < 4; k++) { /* a cell of side 2 */
            const double dx = 0.25 * corner[k][0] * (1 + corner[k][1] * y),
                         dy = 0.25 * corner[k][1] * (1 + corner[k][0] * x);
            b[0][2 * k] = b[2][2 * k + 1] = dx;
            b[1][2 * k + 1] = b[2][2 * k] = dy;
        }
        b[0][8] = b[2][9] = -2 * (x - mean[0]);
        b[2][10] = b[1][11] = -2 * (y - mean[1]);
        for (int i = 0; i < ALL; i++)
            for (int j = 0; j < ALL; j++)
                full[i][j] +=
                    d * (b[0][i] * (b[0][j] + nu * b[1][j]) + b[1][i] * (b[1][j] + nu * b[0][j])) +
                    g * b[2][i] * b[2][j];
    }
    for (int i = 0; i < MODES; i++)
        for (int j = 0; j < MODES; j++)
            own[i * MODES + j] = full[CORNERS + i][CORNERS + j];
    for (int i = 0; i < CORNERS; i++)
        for (int j = 0; j < CORNERS; j++)
            to[i][j] = full[i][j];
    if (!fw_maths_cholesky(MODES, own)) return;
    for (int j = 0; j < CORNERS; j++) {
        for (int i = 0; i < MODES; i++)
            by[i] = full[CORNERS + i][j];
        if (!fw_maths_cholesky_solve(MODES, own, by)) return;
        for (int i = 0; i < CORNERS; i++)
            for (int k = 0; k < MODES; k++)
                to[i][j] -= full[i][CORNERS + k] * by[k];
    }
}

/* Nodes beside each other are coupled. Three springs hold what is in equilibrium anyhow: no force is in them. */
static fw_status assemble(const grid *s, fw_maths_sparse **out) {
    const int n = 2 * s->nnode;
    fw_maths_sparse_shape shape = {.n = n, .groups = s->nnode};
    int *first = fw_arena_array(s->arena, int, (size_t)n),
        *second = fw_arena_array(s->arena, int, (size_t)n), couplings = 0,
        *coupled = fw_arena_array(s->arena, int, 12 * (size_t)s->nx * (size_t)s->ny);
    FW_NEED(first && second && coupled ? first : NULL);
    for (int i = 0; i < n; i++)
        first[i] = i / 2, second[i] = FW_MATHS_NONE;
    for (int c = 0; c < s->nx * s->ny; c++)
        for (int i = 0; s->share[c] > 0 && i < 4; i++)
            for (int j = 0; j < i; j++) {
                coupled[2 * couplings] = s->node[corner_of(s, c, i)];
                coupled[2 * couplings++ + 1] = s->node[corner_of(s, c, j)];
            }
    shape.first = first, shape.second = second, shape.coupled = coupled;
    shape.couplings = couplings;
    FW_TRY(fw_maths_sparse_new(s->arena, &shape, out));
    const double all[6] = {1, 0, 0, 1.0 / 3, 0, 1.0 / 3};
    double point[4][2], whole[8][8], cut[8][8];
    points_in(all, point);
    cell_stiffness(point, whole);
    for (int c = 0; c < s->nx * s->ny; c++) {
        const bool edged = s->moment && s->share[c] < 1 && s->moment[6 * (size_t)c] > 0;
        if (!(s->share[c] > 0)) continue;
        if (edged) points_in(s->moment + 6 * (size_t)c, point);
        if (edged) cell_stiffness(point, cut);
        for (int i = 0; i < 8; i++)
            for (int j = 0; j <= i; j++)
                fw_maths_sparse_add(*out, 2 * s->node[corner_of(s, c, i / 2)] + i % 2,
                                    2 * s->node[corner_of(s, c, j / 2)] + j % 2,
                                    stiffness(s, s->share[c]) * (edged ? cut : whole)[i][j]);
    }
    int far = 0;
    for (int i = 1; i < s->nnode; i++)
        if (vec_distance(place_of(s, i), place_of(s, 0)) >
            vec_distance(place_of(s, far), place_of(s, 0)))
            far = i;
    const fw_geometry_vec2 off = vec_sub(place_of(s, far), place_of(s, 0));
    fw_maths_sparse_add(*out, 0, 0, 1);
    fw_maths_sparse_add(*out, 1, 1, 1);
    const int across = 2 * far + (fabs(off.x) > fabs(off.y));
    fw_maths_sparse_add(*out, across, across, 1);
    return FW_OK;
}

/* ---- wrenches ---- */

/* forces at nodes, weighted, that are together the wrench (M, Fx, Fy) about `about`: weight (u + phi x r). false: there
   are too few nodes */
static bool spread(const grid *s, const double *weight, const int *node, int n,
                   fw_geometry_vec2 about, const double wrench[3], double *to) {
    double g[9] = {0}, by[3] = {wrench[0], wrench[1], wrench[2]};
    for (int i = 0; i < n; i++) {
        const int at = node ? node[i] : i;
        const fw_geometry_vec2 r = vec_sub(place_of(s, at), about);
        const double w = weight[at], rigid[2][3] = {{-r.y, 1, 0}, {r.x, 0, 1}};
        for (int a = 0; a < 2; a++)
            for (int j = 0; j < 9; j++)
                g[j] += w * rigid[a][j / 3] * rigid[a][j % 3];
    }
    if (!(g[0] > 0) || !fw_maths_cholesky(3, g) || !fw_maths_cholesky_solve(3, g, by)) return false;
    for (int i = 0; i < n; i++) {
        const int at = node ? node[i] : i;
        const fw_geometry_vec2 r = vec_sub(place_of(s, at), about);
        to[2 * at] += weight[at] * (by[1] - r.y * by[0]);
        to[2 * at + 1] += weight[at] * (by[2] + r.x * by[0]);
    }
    return true;
}

/* of a place in a hole, as of an eyelet, the nodes of its rim: nearest ones that lie on all sides of it; 0: it is in the open */
static int find_rim(const grid *s, fw_geometry_vec2 at, int *node) {
    const double all_sides = 0.5;
    double near = HUGE_VAL;
    fw_geometry_vec2 sum = {0, 0};
    int n = 0;
    for (int i = 0; i < s->nnode; i++)
        near = fmin(near, vec_distance(place_of(s, i), at));
    for (int i = 0; i < s->nnode; i++) {
        const fw_geometry_vec2 off = vec_sub(place_of(s, i), at);
        if (vec_length(off) < near + s->reach_m) node[n++] = i, sum = vec_add(sum, off);
    }
    return vec_length(sum) < all_sides * near * n ? n : 0;
}

/* unit wrenches about the pin of an end, on nodes about its root, and what balances them: to (3 x 2 nnode) */
static fw_status load_end(const grid *s, const fw_mechanism_solid_end *end, fw_geometry_vec2 root,
                          double *to, bool *known) {
    int *node = fw_arena_array(s->arena, int, (size_t)s->nnode), n = 0;
    FW_NEED(node);
    for (int i = 0; i < s->nnode; i++)
        if (vec_distance(place_of(s, i), root) < fmax(s->reach_m, end->reach_m)) node[n++] = i;
    if (n < 4) n = find_rim(s, root, node);
    for (int k = 0; k < 3 && *known; k++) {
        const double unit[3] = {k == 0, k == 1, k == 2}, back[3] = {-unit[0], -unit[1], -unit[2]};
        double *column = to + (size_t)k * 2 * (size_t)s->nnode;
        *known = n >= 4 && spread(s, s->weight, node, n, end->pin, unit, column) &&
                 spread(s, s->area, NULL, s->nnode, end->pin, back, column);
    }
    return FW_OK;
}

/* c (3n x 3n), one mesh; *known: it hangs together and has all ends */
static fw_status compliance(grid *s, fw_geometry_vec2 middle, const fw_mechanism_solid_end *end,
                            int n, double *c, bool *known) {
    const int from = (int)((middle.y - s->box.y0) / s->cell_m) * s->nx +
                     (int)((middle.x - s->box.x0) / s->cell_m);
    int start = FW_MATHS_NONE;
    double near = HUGE_VAL;
    *known = false;
    FW_TRY(share_cells(s));
    for (int i = 0; s->edge_m != 0.0 && i < s->nline; i++)
        if (s->line[i].edge) move_edge(s, &s->line[i]);
    for (int i = 0; i < s->nx * s->ny; i++) { /* the fullest of the nearest */
        const double off = hypot(i % s->nx - from % s->nx, i / s->nx - from / s->nx);
        if (s->share[i] > 0.9 && off < near) near = off, start = i;
    }
    if (start == FW_MATHS_NONE) return FW_OK;
    const fw_geometry_vec2 full = {s->box.x0 + (start % s->nx + 0.5) * s->cell_m,
                                   s->box.y0 + (start / s->nx + 0.5) * s->cell_m};
    FW_TRY(keep_connected(s, start));
    FW_TRY(number_nodes(s));
    const size_t rows = 2 * (size_t)s->nnode;
    double *p, *u, *work;
    fw_maths_sparse *system;
    fw_maths_sparse_signs signs;
    FW_NEED(p = fw_arena_array(s->arena, double, 3 * (size_t)n * rows));
    FW_NEED(u = fw_arena_array(s->arena, double, rows));
    FW_NEED(work = fw_arena_array(s->arena, double, 2 * rows));
    *known = true;
    for (int i = 0; i < n && *known; i++)
        FW_TRY(load_end(s, &end[i], end[i].nearest ? full : end[i].root, p + 3 * (size_t)i * rows,
                        known));
    if (!*known) return FW_OK;
    FW_TRY(assemble(s, &system));
    FW_TRY(fw_maths_sparse_factor(system, 1e-13, &signs));
    *known = signs.negative == 0 && signs.nothing == 0;
    for (int j = 0; j < 3 * n && *known; j++) {
        memcpy(u, p + (size_t)j * rows, rows * sizeof *u);
        fw_maths_sparse_solve(system, u, work);
        for (int i = 0; i < 3 * n; i++) {
            double sum = 0;
            for (size_t k = 0; k < rows; k++)
                sum += p[(size_t)i * rows + k] * u[k];
            c[i * 3 * n + j] = sum;
        }
    }
    return FW_OK;
}

static fw_status mesh(fw_arena *arena, const grid *of, double cell_m, fw_geometry_vec2 middle,
                      const fw_mechanism_solid_end *end, int n, double *c, bool *known) {
    grid s = *of;
    s.arena = arena, s.cell_m = cell_m, s.reach_m = 3.5 * cell_m;
    s.nx = 1 + (int)((s.box.x1 - s.box.x0) / cell_m);
    s.ny = 1 + (int)((s.box.y1 - s.box.y0) / cell_m);
    FW_NEED(s.share = fw_arena_array(arena, double, (size_t)s.nx *(size_t)s.ny));
    s.samples = of->close ? CLOSE : SAMPLES;
    if (of->close)
        FW_NEED(s.moment = fw_arena_array(arena, double, 6 * (size_t)s.nx * (size_t)s.ny));
    return compliance(&s, middle, end, n, c, known);
}

fw_status fw_mechanism_solid_of(fw_arena *arena, const fw_mechanism_line *line, int nline,
                                const fw_mechanism_solid_mesh *as,
                                const fw_mechanism_solid_end *end, int n, fw_mechanism_solid *out) {
    grid s = {.line = line, .nline = nline};
    *out = (fw_mechanism_solid){.n = n};
    if (nline == 0 || n == 0) return FW_OK;
    for (int i = 0; i < nline; i++) {
        const fw_geometry_vec2 a = line[i].a, b = line[i].b;
        const fw_geometry_box box = {fmin(a.x, b.x), fmin(a.y, b.y), fmax(a.x, b.x),
                                     fmax(a.y, b.y)};
        s.box = i == 0 ? box : fw_box_join(s.box, box);
    }
    s.edge_m = as->edge_m, s.close = as->close;
    const double narrow_m = as->narrow_m;
    const double cells = as->cells > 0 ? as->cells : as->close ? CLOSELY : CELLS;
    const double wide = s.box.x1 - s.box.x0, high = s.box.y1 - s.box.y0,
                 material = as->area_m2 > 0 ? as->area_m2 : wide * high,
                 least_m = fmax(sqrt(material / cells), sqrt(wide * high / GRID)),
                 cell_m = fmax(fmin(fmax(wide, high) / ACROSS, narrow_m / NARROW), least_m);
    if (!(cell_m > 0) || (narrow_m > 0 && !(cell_m < narrow_m))) return FW_OK;
    const size_t size = 9 * (size_t)n * (size_t)n;
    FW_NEED(out->fine = fw_arena_array(arena, double, 2 * size));
    out->coarse = out->fine + size;
    out->known = true;
    for (int k = 0; k < 2 && out->known; k++) {
        fw_arena *scratch = fw_arena_part(arena, 0);
        FW_NEED(scratch);
        const fw_status status = mesh(scratch, &s, k ? 2 * cell_m : cell_m, as->middle, end, n,
                                      k ? out->coarse : out->fine, &out->known);
        fw_arena_free(scratch);
        out->known = out->known && status != FW_SOLVER;
        if (status != FW_SOLVER) FW_TRY(status);
    }
    return FW_OK;
}

static double energy_of(const double *c, int rows, const double *w) {
    double sum = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < rows; j++)
            sum += w[i] * c[i * rows + j] * w[j];
    return 0.5 * sum;
}

double fw_mechanism_solid_energy_J(const fw_mechanism_solid *s, double stiff_N, const double *w) {
    const double crystal = 0.15;
    const double fine = energy_of(s->fine, 3 * s->n, w), coarse = energy_of(s->coarse, 3 * s->n, w);
    return ((1 + crystal) * fine + fabs(fine - coarse)) / stiff_N;
}

void fw_mechanism_solid_goes(const fw_mechanism_solid *s, double stiff_N, const double *w, int end,
                             double to[3]) {
    const int rows = 3 * s->n;
    for (int k = 0; k < 3; k++) {
        to[k] = 0;
        for (int j = 0; j < rows; j++)
            to[k] += s->fine[(3 * end + k) * rows + j] * w[j] / stiff_N;
    }
}
