/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Release holes where a square grid leaves none: heads and necks of hinges, ends of bars, plates beside
   curved edges, columns that reach no straight edge.

   Looked at are the points of a lattice eight times as fine as the holes'. The one that is farthest from
   everything open gets a hole, again and again, until none is farther than half the pitch (that much a hole
   needs around it: its radius and the rim). A hole keeps that rim from edges and other holes, and from
   flexures, seams and their roots three times the flexure's width besides, so that the strain at a root is
   that of the whole head to exp(-3 pi/2) by Saint-Venant's rule.

   Each is opened by a cut along the way to the nearest edge or hole that has room for its two sides, and
   keeps off the cuts of others: so nothing else lies in that way, nor comes there later. Cut and cap are as in release.c, and so are moments. In: the body with
   the holes of its grid. Out: the same with more. Error: a point of the body where holes may lie is at most
   half the pitch and a lattice step's diagonal from an opening. Cost: lattice points times edges near the
   grid's gaps. Test: test_release.c, holes_keep_away. */
#include "layout/draw.h"
#include "base/constants.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

typedef fw_layout_release_grid grid;

enum { FINER = 8, TRIES = 6, MOST_HOLES = 4000 };
static const double BESIDE_LINE_M = 6e-6, BESIDE_ARC_M = 1.0e-6, SEAM_M = 4e-6;

fw_status fw_layout_note_hole(grid *g, fw_geometry_vec2 middle) {
    if (g->nhole == g->room) {
        int room = g->room ? 2 * g->room : 32;
        FW_NEED(g->hole = fw_arena_grow(g->d->arena, g->hole, (size_t)g->nhole, (size_t)room,
                                        sizeof *g->hole));
        g->room = room;
    }
    g->hole[g->nhole++] = middle;
    return FW_OK;
}

fw_status fw_layout_release_open(grid *g, int i, int more) {
    fw_geometry_contour *c = &g->outline;
    int n = c->count + more;
    if (n > g->segments) {
        const fw_geometry_segment *old = c->segment;
        FW_NEED(c->segment = fw_arena_array(g->d->arena, fw_geometry_segment, 2 * (size_t)n));
        memcpy(c->segment, old, (size_t)c->count * sizeof *old);
        g->segments = 2 * n;
    }
    memmove(c->segment + i + 1 + more, c->segment + i + 1,
            (size_t)(c->count - i - 1) * sizeof *c->segment);
    c->count = n;
    return FW_OK;
}

typedef struct place {
    fw_geometry_vec2 at;
    double open_m;   /* from everything open; 0: no cut leads to it, */
    double closed_m; /* and then this */
} place;

enum { BLOCK = 256 };

typedef struct rest {
    grid *g;
    double need_m; /* of a hole's middle from edges and holes' edges */
    place *place;  /* in rows from below */
    int n, room;
    int *best;                        /* of every BLOCK places the farthest; FW_NONE: not known */
    int *first, *next, columns, rows; /* of the grid's holes, by squares */
    int *row, nrow;                   /* edges near the row that is looked at */
} rest;

static bool is_seam(const fw_geometry_segment *s) {
    return s->flags & FW_SEGMENT_JOINT;
}

/* a lower bound of the distance to a segment, without a root of a line and without an angle */
static double at_least(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    if (s->kind == FW_ARC) return fabs(vec_distance(p, s->centre) - s->radius);
    double dx = fw_greater(fw_lesser(s->a.x, s->b.x) - p.x, p.x - fw_greater(s->a.x, s->b.x)),
           dy = fw_greater(fw_lesser(s->a.y, s->b.y) - p.y, p.y - fw_greater(s->a.y, s->b.y));
    return fw_greater(fw_greater(dx, dy), 0.0);
}

/* holes by squares of the pitch: a hole that counts for a point is in its own or one beside */
static int square_of(const rest *r, fw_geometry_vec2 p, int dx, int dy) {
    double x = floor((p.x - r->g->box.x0) / r->g->pitch_m) + dx,
           y = floor((p.y - r->g->box.y0) / r->g->pitch_m) + dy;
    return x < 0 || y < 0 || x >= r->columns || y >= r->rows ? -1 : (int)(y * r->columns + x);
}

static fw_status sort_holes(rest *r) {
    const grid *g = r->g;
    r->columns = (int)((g->box.x1 - g->box.x0) / g->pitch_m) + 1;
    r->rows = (int)((g->box.y1 - g->box.y0) / g->pitch_m) + 1;
    size_t squares = (size_t)r->columns * (size_t)r->rows;
    FW_NEED(r->first = fw_arena_array(g->d->arena, int, squares));
    FW_NEED(r->next = fw_arena_array(g->d->arena, int, (size_t)g->nhole + 1));
    for (int i = 0; i < g->nhole; i++) { /* numbers from 1: 0 is none */
        int at = square_of(r, g->hole[i], 0, 0);
        r->next[i] = at < 0 ? 0 : r->first[at];
        if (at >= 0) r->first[at] = i + 1;
    }
    return FW_OK;
}

/* to the nearest hole of the grid, at most the pitch */
static double to_holes(const rest *r, fw_geometry_vec2 p) {
    double least = r->g->pitch_m;
    for (int k = 0; k < 9; k++) {
        int at = square_of(r, p, k % 3 - 1, k / 3 - 1);
        for (int i = at < 0 ? 0 : r->first[at]; i > 0; i = r->next[i - 1])
            least = fw_lesser(least, vec_distance(r->g->hole[i - 1], p) - 0.5 * r->g->hole_m);
    }
    return least;
}

/* to the body's own edges, holes not counted, at most `limit`; *seam_m: to its seams; ends where the one
   is less than `enough` */
static double to_edges(const rest *r, fw_geometry_vec2 p, double limit, double enough,
                       double *seam_m) {
    double open = limit, t;
    *seam_m = limit;
    for (int i = 0; i < r->nrow && open >= enough; i++) {
        const fw_geometry_segment *s = &r->g->before.segment[r->row[i]];
        double *which = is_seam(s) ? seam_m : &open;
        fw_geometry_vec2 where;
        if (at_least(s, p) < *which)
            *which = fw_lesser(*which, fw_geometry_segment_nearest(s, p, &t, &where));
    }
    return open;
}

/* the edges that come within the pitch of a row */
static void list_row(rest *r, double y) {
    r->nrow = 0;
    for (int i = 0; i < r->g->before.count; i++) {
        fw_geometry_box box = fw_segment_box(&r->g->before.segment[i]);
        if (box.y0 - y < r->g->pitch_m && y - box.y1 < r->g->pitch_m) r->row[r->nrow++] = i;
    }
}

/* far enough from every flexure of the body's hinges */
static bool clear_of_flexures(const grid *g, fw_geometry_vec2 p, double need) {
    const fw_device *device = g->d->device;
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &g->d->layout->hinge[j];
        const fw_geometry_contour *c = &g->d->hinge[j].flexure;
        if (h->lower != g->body && h->upper != g->body) continue;
        if (fw_norm(fw_sub(p, h->centre)) > h->keep_out_m + need + 1e-4) continue;
        double width = fw_device_flexure_narrowest_m(&device->flexure[device->revolute[j].flexure]);
        for (int i = 0; i < c->count; i++) {
            double t;
            fw_geometry_vec2 where;
            if (fw_geometry_segment_nearest(&c->segment[i], p, &t, &where) < need + 3.0 * width)
                return false;
        }
    }
    return true;
}

/* how many points of a lattice lie less than so far behind one */
static int within_m(double far_m, double step) {
    return far_m > 0.0 ? (int)(far_m / step * (1.0 - 1e-9)) : 0;
}

/* Distances change by no more than the way: *skip: so many points behind this one in its row have no hole for the same
   reason; *inside: so many lie inside of the body, as this one does */
static fw_status look_at(rest *r, fw_geometry_vec2 p, double step, int *inside, int *skip) {
    grid *g = r->g;
    const double holes = to_holes(r, p);
    double seam;
    *skip = within_m(r->need_m - holes, step);
    if (holes < r->need_m) return FW_OK;
    const double edges = to_edges(r, p, g->pitch_m, r->need_m, &seam), open = fmin(holes, edges);
    *skip = within_m(r->need_m - edges, step);
    if (open < r->need_m) return FW_OK;
    if (*inside <= 0) {
        const int same = within_m(fmin(edges, seam), step);
        if (!fw_geometry_contour_contains(&g->before, p)) {
            *skip = same;
            return FW_OK;
        }
        *inside = same + 1;
    }
    if (seam < 0.5 * g->hole_m + SEAM_M || !clear_of_flexures(g, p, r->need_m)) return FW_OK;
    if (r->n == r->room) {
        int more = r->room ? 4 * r->room : 256;
        FW_NEED(r->place = fw_arena_grow(g->d->arena, r->place, (size_t)r->n, (size_t)more,
                                         sizeof *r->place));
        r->room = more;
    }
    r->place[r->n++] = (place){p, open, 0.0};
    return FW_OK;
}

static fw_status find_places(rest *r) {
    grid *g = r->g;
    double step = g->pitch_m / FINER;
    int columns = (int)ceil((g->box.x1 - g->box.x0) / step),
        rows = (int)ceil((g->box.y1 - g->box.y0) / step);
    FW_NEED(r->row = fw_arena_array(g->d->arena, int, (size_t)g->before.count));
    for (int j = 0; j < rows; j++) {
        int inside = 0, skip = 0;
        list_row(r, g->box.y0 + (j + 0.5) * step);
        for (int i = 0; i < columns; i += 1 + skip, inside -= 1 + skip)
            FW_TRY(look_at(r, fw_v(g->box.x0 + (i + 0.5) * step, g->box.y0 + (j + 0.5) * step),
                           step, &inside, &skip));
    }
    return FW_OK;
}

/* ---- a cut to what is nearest ---- */

typedef struct way {
    int edge; /* of the outline */
    double far_m;
    fw_geometry_vec2 u, p[2], q[2]; /* outward; on the edge and on the hole, right and left */
} way;

/* where a side of the cut meets the edge; false: it does not, or too near to its ends */
static bool meets(const fw_geometry_segment *s, fw_geometry_vec2 from, fw_geometry_vec2 u,
                  double *t, fw_geometry_vec2 *at) {
    double beside = s->kind == FW_LINE ? BESIDE_LINE_M : BESIDE_ARC_M;
    if (s->kind == FW_LINE) {
        fw_geometry_vec2 along = vec_unit(fw_sub(s->b, s->a));
        double across = vec_cross(u, along);
        if (fabs(across) < 0.7) return false;
        *at = fw_add(from, vec_cross(fw_sub(s->a, from), along) / across, u);
        *t = fw_dot(fw_sub(*at, s->a), along) / fw_norm(fw_sub(s->b, s->a));
    } else {
        fw_geometry_vec2 w = fw_sub(from, s->centre);
        double half = fw_dot(w, u), in = half * half - fw_dot(w, w) + s->radius * s->radius;
        if (in < 0.5 * s->radius * s->radius) return false; /* within 45 degrees of square */
        double near = -half - sqrt(in), far = -half + sqrt(in);
        *at = fw_add(from, near > 0.0 ? near : far, u);
        if (!fw_geometry_segment_faces(s, fw_sub(*at, s->centre), t)) return false;
    }
    double length = fw_geometry_segment_length(s);
    return *t * length > beside && (1.0 - *t) * length > beside;
}

static bool way_to(const grid *g, fw_geometry_vec2 middle, int edge, way *w) {
    const fw_geometry_segment *s = &g->outline.segment[edge];
    double half = 0.25 * g->hole_m, deep = 0.25 * sqrt(3.0) * g->hole_m, t[2], foot_t;
    fw_geometry_vec2 foot;
    *w = (way){.edge = edge, .far_m = fw_geometry_segment_nearest(s, middle, &foot_t, &foot)};
    w->u = fw_towards(middle, foot);
    fw_geometry_vec2 left = fw_left(w->u);
    if (fw_dot(fw_geometry_segment_tangent(s, foot_t), left) < 0.9) return false;
    for (int k = 0; k < 2; k++) {
        w->q[k] = fw_add(fw_add(middle, deep, w->u), k ? half : -half, left);
        if (!meets(s, w->q[k], w->u, &t[k], &w->p[k])) return false;
        if (fw_dot(fw_sub(w->p[k], w->q[k]), w->u) < 1e-6) return false;
    }
    return t[0] < t[1];
}

/* nothing else of the outline in the cut or within 2.5 um of its sides */
static bool is_free(const grid *g, const way *w) {
    const double near = 2.5e-6;
    fw_geometry_vec2 middle = vec_scale(0.5, fw_add(w->q[0], 1.0, w->q[1]));
    double far = fmax(fw_norm(fw_sub(w->p[0], middle)), fw_norm(fw_sub(w->p[1], middle))) + near;
    fw_geometry_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    fw_geometry_segment side[2];
    for (int k = 0; k < 2; k++) {
        side[k] = (fw_geometry_segment){.kind = FW_LINE, .a = w->q[k], .b = w->p[k]};
        box = k ? fw_box_join(box, fw_segment_box(&side[k])) : fw_segment_box(&side[k]);
    }
    for (int i = 0; i < g->outline.count; i++) {
        const fw_geometry_segment *s = &g->outline.segment[i];
        fw_geometry_vec2 a, b;
        if (i == w->edge || at_least(s, middle) > far || fw_box_gap(fw_segment_box(s), box) > near)
            continue;
        for (int k = 0; k < 2; k++)
            if (fw_geometry_segment_distance(&side[k], s, &a, &b) < near) return false;
    }
    return true;
}

/* would a hole leave the cuts of others whole? A long cut passes places that are far from every opening. */
static bool is_off_cuts(const grid *g, fw_geometry_vec2 middle) {
    const double need = 0.5 * g->hole_m + SEAM_M;
    for (int i = 0; i < g->outline.count; i++) {
        const fw_geometry_segment *s = &g->outline.segment[i];
        fw_geometry_vec2 at;
        double t;
        if (!is_seam(s) || at_least(s, middle) > need) continue;
        if (fw_geometry_segment_nearest(s, middle, &t, &at) < need) return false;
    }
    return true;
}

/* the shortest of the first few */
static bool find_way(const grid *g, fw_geometry_vec2 middle, way *best) {
    double tried = 0.0; /* ways up to here were tried */
    if (!is_off_cuts(g, middle)) return false;
    for (int n = 0; n < TRIES; n++) {
        int edge = -1;
        double least = 2.5 * g->pitch_m, t;
        for (int i = 0; i < g->outline.count; i++) {
            const fw_geometry_segment *s = &g->outline.segment[i];
            fw_geometry_vec2 at;
            if (is_seam(s) || at_least(s, middle) > least) continue;
            double far = fw_geometry_segment_nearest(s, middle, &t, &at);
            if (far < least && far > tried) least = far, edge = i;
        }
        if (edge < 0) return false;
        if (way_to(g, middle, edge, best) && is_free(g, best)) return true;
        tried = least;
    }
    return false;
}

static fw_geometry_segment side_of(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return (fw_geometry_segment){
        .kind = FW_LINE, .flags = FW_SEGMENT_JOINT | FW_SEGMENT_THROUGH, .a = a, .b = b};
}

static fw_geometry_segment round_hole(const grid *g, fw_geometry_vec2 middle, fw_geometry_vec2 a,
                                      fw_geometry_vec2 b, double sweep_rad) {
    return (fw_geometry_segment){.kind = FW_ARC,
                                 .a = a,
                                 .b = b,
                                 .centre = middle,
                                 .radius = 0.5 * g->hole_m,
                                 .sweep_rad = sweep_rad};
}

static fw_status open_hole(grid *g, fw_geometry_vec2 middle, const way *w) {
    const fw_geometry_segment edge = g->outline.segment[w->edge];
    const double third = FW_PI / 3.0;
    double t0 = fw_geometry_segment_parameter(&edge, w->p[0]),
           t1 = fw_geometry_segment_parameter(&edge, w->p[1]);
    fw_geometry_contour cap = {.count = 4};
    FW_NEED(cap.segment = fw_arena_array(g->d->arena, fw_geometry_segment, 4));
    FW_TRY(fw_layout_release_open(g, w->edge, 4));
    fw_geometry_segment *to = g->outline.segment + w->edge;
    to[0] = fw_geometry_segment_cut(&edge, 0.0, edge.a, t0, w->p[0]);
    to[1] = side_of(w->p[0], w->q[0]);
    to[2] = round_hole(g, middle, w->q[0], w->q[1], -5.0 * third);
    to[3] = side_of(w->q[1], w->p[1]);
    to[4] = fw_geometry_segment_cut(&edge, t1, w->p[1], 1.0, edge.b);
    cap.segment[0] = fw_geometry_segment_cut(&edge, t0, w->p[0], t1, w->p[1]);
    cap.segment[1] = side_of(w->p[1], w->q[1]);
    cap.segment[2] = round_hole(g, middle, w->q[1], w->q[0], -third);
    cap.segment[3] = side_of(w->q[0], w->p[0]);
    FW_TRY(fw_layout_drawing_add(g->d, FW_ROLE_STRUCTURE, g->body, FW_NONE, g->label, &cap));
    return fw_layout_note_hole(g, middle);
}

/* ---- the farthest place that is left ---- */

static int farther(const rest *r, int best, int i) {
    const bool needs = r->place[i].open_m >= r->need_m;
    return needs && (best < 0 || r->place[i].open_m > r->place[best].open_m) ? i : best;
}

/* the first of those that are equally far; -1: none needs a hole */
static int farthest(rest *r) {
    int best = -1;
    for (int b = 0; b * BLOCK < r->n; b++) {
        if (r->best[b] == FW_NONE) {
            int own = -1;
            for (int i = b * BLOCK; i < r->n && i < (b + 1) * BLOCK; i++)
                own = farther(r, own, i);
            r->best[b] = own < 0 ? r->n : own; /* r->n: none */
        }
        if (r->best[b] < r->n) best = farther(r, best, r->best[b]);
    }
    return best;
}

/* a new hole: places are at most the pitch from what is open already, so that only those of the rows beside it are nearer
   to it */
static void count_hole(rest *r, fw_geometry_vec2 at) {
    const double radius = 0.5 * r->g->hole_m, reach = r->g->pitch_m + radius;
    int low = 0, high = r->n;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (r->place[middle].at.y < at.y - reach)
            low = middle + 1;
        else
            high = middle;
    }
    for (int k = low; k < r->n && r->place[k].at.y <= at.y + reach; k++) {
        place *p = &r->place[k];
        if (fabs(p->at.x - at.x) > reach) continue;
        const double far = fw_norm(fw_sub(p->at, at)) - radius;
        if (far < p->open_m) r->best[k / BLOCK] = FW_NONE;
        p->open_m = fmin(p->open_m, far);
        p->closed_m = fmin(p->closed_m, far);
    }
}

/* how far a place is from what is open on the mask: edges of the body, holes and the cuts that open them */
static double from_open(const grid *g, fw_geometry_vec2 p) {
    double least = (double)INFINITY;
    for (int i = 0; i < g->outline.count; i++) {
        double t;
        fw_geometry_vec2 where;
        if (!is_seam(&g->outline.segment[i]))
            least = fmin(least, fw_geometry_segment_nearest(&g->outline.segment[i], p, &t, &where));
    }
    return least;
}

/* The place that stays farthest from what is open, of those that have no hole: from each point of the lattice that is within a
   lattice's step of the farthest one, for between its points it may be as much more, by steps that are halved where none leads
   on. Error: a nanometre. Cost: edges times some hundred. Test: test_release.c, the_farthest_place */
static void farthest_left(const rest *r) {
    enum { AROUND = 8, MOST = 64 };
    static const double finest_m = 1e-9, worth = 0.02; /* or a ridge is followed for ever */
    grid *g = r->g;
    const double step = g->pitch_m / FINER;
    double most = 0.0;
    for (int k = 0; k < r->n; k++)
        most = fmax(most, r->place[k].closed_m);
    for (int k = 0, n = 0; k < r->n && n < MOST && most >= r->need_m; k++) {
        fw_geometry_vec2 at = r->place[k].at;
        if (r->place[k].closed_m < fmax(most - step, r->need_m)) continue;
        double far = from_open(g, at);
        n++;
        for (double h = step; h > finest_m;) {
            bool on = false;
            for (int i = 0; i < AROUND && !on; i++) {
                const double turn = 2.0 * FW_PI * i / AROUND;
                const fw_geometry_vec2 to = fw_add(at, h, fw_v(cos(turn), sin(turn)));
                const double there = from_open(g, to);
                on = there > far + worth * h && fw_norm(fw_sub(to, r->place[k].at)) <= step &&
                     fw_geometry_contour_contains(&g->outline, to);
                if (on) at = to, far = there;
            }
            h = on ? h : 0.5 * h;
        }
        if (far >= r->need_m && far > g->far_m) g->far_m = far, g->far = at;
    }
}

fw_status fw_layout_release_rest(grid *g) {
    rest r = {.g = g, .need_m = 0.5 * g->hole_m + g->rim_m};
    FW_TRY(sort_holes(&r));
    FW_TRY(find_places(&r));
    FW_NEED(r.best = fw_arena_array(g->d->arena, int, (size_t)r.n / BLOCK + 1));
    for (int b = 0; b * BLOCK < r.n; b++)
        r.best[b] = FW_NONE;
    for (int made = 0; made < MOST_HOLES; made++) {
        int i = farthest(&r);
        way w;
        if (i < 0) break;
        fw_geometry_vec2 at = r.place[i].at;
        if (!find_way(g, at, &w)) {
            r.place[i].closed_m = r.place[i].open_m; /* a neighbour may have a way */
            r.place[i].open_m = 0.0;
            r.best[i / BLOCK] = FW_NONE;
            continue;
        }
        FW_TRY(open_hole(g, at, &w));
        count_hole(&r, at);
    }
    farthest_left(&r);
    return FW_OK;
}
