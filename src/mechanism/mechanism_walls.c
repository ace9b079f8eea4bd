/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which walls stand opposite each other, and limbs: what of a body is slender, and bends towards the wall beside it.
   Theory: docs/theory/stiction.md */
#include "base/constants.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include <stdlib.h>
#include <string.h>

/* ---- walls opposite each other ---- */

static const double reach_m =
                        200e-6, /* a liquid between walls further apart pulls next to nothing */
    first_m = 25e-6;            /* most rays, those across a release hole or a slot, end before */
enum { BINS = 512 };            /* along the longer side of the box, at most */

static bool solid_of(const fw_layout_piece *p, int nbody, int *solid) {
    if (p->role == FW_ROLE_FLEXURE && p->joint >= 0)
        *solid = FW_MECHANISM_FLEXED - p->joint;
    else if (fw_layout_is_wall(p))
        *solid = p->body >= 0 && p->body < nbody ? p->body : FW_GROUND;
    else
        return false;
    return true;
}

static fw_status take_walls(const fw_mechanism *m, fw_mechanism_walls *w) {
    const fw_layout *l = m->layout;
    size_t n = 0;
    int solid;
    for (int i = 0; i < l->npiece; i++)
        for (int k = 0; k < l->piece[i].contour.count; k++)
            n += (size_t)fw_geometry_segment_parts(&l->piece[i].contour.segment[k]);
    FW_NEED(w->wall = fw_arena_array(w->arena, fw_mechanism_wall, n));
    for (int i = 0; i < l->npiece; i++) {
        const fw_geometry_contour *c = &l->piece[i].contour;
        for (int k = 0; solid_of(&l->piece[i], m->nbody, &solid) && k < c->count; k++) {
            const fw_geometry_segment *s = &c->segment[k];
            int parts = fw_geometry_segment_parts(s);
            for (int j = 0; j < parts && !(s->flags & FW_SEGMENT_JOINT); j++)
                w->wall[w->nwall++] =
                    (fw_mechanism_wall){fw_geometry_segment_point(s, (double)j / parts),
                                        fw_geometry_segment_point(s, (j + 1.0) / parts), solid, i};
        }
    }
    return FW_OK;
}

static fw_geometry_box box_of(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return (fw_geometry_box){fw_lesser(a.x, b.x), fw_lesser(a.y, b.y), fw_greater(a.x, b.x),
                             fw_greater(a.y, b.y)};
}

static int bin(const fw_mechanism_walls *w, double x, double from, int n) {
    int i = (int)((x - from) / w->side_m);
    return i < 0 ? 0 : i >= n ? n - 1 : i;
}

typedef struct range { /* of bins, the last ones included */
    int i0, i1, j0, j1;
} range;

static range bins_of(const fw_mechanism_walls *w, const fw_geometry_box *b) {
    return (range){bin(w, b->x0, w->box.x0, w->nx), bin(w, b->x1, w->box.x0, w->nx),
                   bin(w, b->y0, w->box.y0, w->ny), bin(w, b->y1, w->box.y0, w->ny)};
}

/* counts the bins that a wall's box covers, or puts it into them */
static void spread_wall(fw_mechanism_walls *w, int at, int *next) {
    const fw_geometry_box box = box_of(w->wall[at].a, w->wall[at].b);
    const range r = bins_of(w, &box);
    for (int j = r.j0; j <= r.j1; j++)
        for (int i = r.i0; i <= r.i1; i++) {
            if (next)
                w->in[next[j * w->nx + i]++] = at;
            else
                w->begin[j * w->nx + i + 1]++;
        }
}

static fw_status sort_walls(fw_mechanism_walls *w) {
    for (int i = 0; i < w->nwall; i++) {
        fw_geometry_box box = box_of(w->wall[i].a, w->wall[i].b);
        w->box = i ? fw_box_join(w->box, box) : box;
    }
    const double width = w->box.x1 - w->box.x0, height = w->box.y1 - w->box.y0;
    w->side_m = fmax(first_m, fmax(width, height) / BINS);
    w->nx = 1 + (int)(width / w->side_m);
    w->ny = 1 + (int)(height / w->side_m);
    size_t n = (size_t)w->nx * (size_t)w->ny;
    int *next;
    FW_NEED(w->begin = fw_arena_array(w->arena, int, n + 1));
    FW_NEED(next = fw_arena_array(w->arena, int, n));
    for (int i = 0; i < w->nwall; i++)
        spread_wall(w, i, NULL);
    for (size_t i = 0; i < n; i++)
        w->begin[i + 1] += w->begin[i], next[i] = w->begin[i];
    FW_NEED(w->in = fw_arena_array(w->arena, int, (size_t)w->begin[n] + 1));
    for (int i = 0; i < w->nwall; i++)
        spread_wall(w, i, next);
    return FW_OK;
}

/* the nearest wall that the ray from p along the unit vector n meets within reach, and how far away; -1: none */
static int look_within(const fw_mechanism_walls *w, int own, fw_geometry_vec2 p, fw_geometry_vec2 n,
                       double reach, double *gap) {
    const fw_geometry_box box = box_of(p, vec_along(p, reach, n));
    const range r = bins_of(w, &box);
    int found = -1;
    *gap = reach;
    for (int j = r.j0; j <= r.j1; j++)
        for (int i = r.i0; i <= r.i1; i++)
            for (int k = w->begin[j * w->nx + i]; k < w->begin[j * w->nx + i + 1]; k++) {
                const fw_mechanism_wall *to = &w->wall[w->in[k]];
                fw_geometry_vec2 along = vec_sub(to->b, to->a), off = vec_sub(to->a, p);
                double det = vec_cross(n, along),
                       beside = vec_cross(off, n); /* 0 to det within it */
                if (det > 0 ? beside < 0 || beside > det : beside > 0 || beside < det) continue;
                if (w->in[k] == own || det == 0) continue;
                double t = vec_cross(off, along) / det;
                if (t > 0 && t < *gap) *gap = t, found = w->in[k];
            }
    return found;
}

/* near the wall first: what is found there is the nearest of all */
int fw_mechanism_walls_look(const fw_mechanism_walls *w, int own, fw_geometry_vec2 p,
                            fw_geometry_vec2 n, double *gap) {
    int found = look_within(w, own, p, n, first_m, gap);
    return found >= 0 ? found : look_within(w, own, p, n, reach_m, gap);
}

fw_status fw_mechanism_walls_take(fw_arena *arena, const fw_mechanism *m, fw_mechanism_walls *w) {
    *w = (fw_mechanism_walls){.arena = arena};
    if (!m->layout || !m->layout->drawn) return FW_OK;
    FW_TRY(take_walls(m, w));
    return w->nwall > 0 ? sort_walls(w) : FW_OK;
}

fw_status fw_mechanism_faces_add(fw_mechanism_faces *to, const fw_mechanism_face *face) {
    if (to->count == to->room) {
        size_t more = to->room ? 2 * to->room : 64;
        FW_NEED(to->face = fw_arena_grow(to->arena, to->face, to->count, more, sizeof *to->face));
        to->room = more;
    }
    to->face[to->count++] = *face;
    return FW_OK;
}

/* ---- limbs ----
   What of a body, or of what stands, is slender between two walls of its own bends towards what stands beside it: fingers, bars,
   jaws. A wall that goes straight on (within 20 degrees) is a run; with t(x) of material behind it, and what its ends do, it is a
   beam of one coordinate, the deflection u of its tip or middle, with the shape phi of an even load:

     K = kappa E h t^3/(12 L^3),   1/t^3 = sum of weight/t(x)^3 over sum of weight,   from the tip x^3, else 1

     at one end   phi = z^2 (6 - 4 z + z^2)/3,   kappa = 3       z = x/L from the root
     at both      phi = 16 z^2 (1 - z)^2,        kappa = 192     into something wider
     at both      phi = sin(pi z),               kappa = 48      where hinges are, or it turns a corner

   kappa is that of a force at the place of u, the least of any load: an even pull finds it 6 % stiffer. A run ends free where its
   outline comes round to the wall behind it within twice the thickness, and clamped where it turns to the outside.
   What pulls a run is the liquid before it alone, with what faces it bending as well, each by one coordinate.
   Error: beams, of runs more than three times as long as wide; 12 % of a pair of cantilevers. What bends round a corner is seen
   leg by leg. Cost: rays as above, and fw_mechanism_pull_in of some coordinates a run. Test: test_mechanism_pull.c */

typedef enum limb_kind { LIMB_NONE, LIMB_FREE, LIMB_CLAMPED, LIMB_PINNED, LIMB_TIPS } limb_kind;
typedef enum end_kind { END_ROOT, END_TIP, END_HINGE } end_kind;

typedef struct run {
    int first, last; /* walls */
    double length_m, thick_m;
    limb_kind kind;
    /* where along it the limb begins, at its root where one end is free, and how far it reaches from there: < 0: back */
    double root_m, reach_m;
} run;

typedef struct runs {
    const fw_mechanism_walls *w;
    int *next, *before, *of; /* (nwall) wall after and before it, FW_NONE; its run */
    double *at_m;            /* (nwall) where it begins along its run */
    bool *hole;              /* (nwall) of a release hole */
    run *run;
    int nrun;
} runs;

static const double corner_rad = 0.2, turned_rad = 0.35, round_m = 200e-6, /* of a release hole */
    slender = 3, shortest_m = 20e-6;

static double direction(const fw_mechanism_wall *w) {
    return atan2(w->b.y - w->a.y, w->b.x - w->a.x);
}

static double turn(const fw_mechanism_walls *w, int from, int to) {
    return fw_geometry_angle_near(direction(&w->wall[to]) - direction(&w->wall[from]), 0);
}

typedef struct begin {
    fw_geometry_vec2 at;
    int wall;
} begin;

static int by_place(const void *a, const void *b) {
    const begin *p = a, *q = b;
    if (vec_before(p->at, q->at)) return -1;
    if (vec_before(q->at, p->at)) return 1;
    return (p->wall > q->wall) - (p->wall < q->wall);
}

static fw_status link_walls(runs *r) {
    const fw_mechanism_walls *w = r->w;
    const size_t n = (size_t)w->nwall;
    begin *order;
    FW_NEED(order = fw_arena_array(w->arena, begin, n));
    for (size_t i = 0; i < n; i++) {
        order[i] = (begin){w->wall[i].a, (int)i};
        r->next[i] = r->before[i] = r->of[i] = FW_NONE;
    }
    qsort(order, n, sizeof *order, by_place);
    for (size_t i = 0; i < n; i++) {
        size_t low = 0, high = n;
        while (low < high) {
            const size_t middle = (low + high) / 2;
            if (vec_before(order[middle].at, w->wall[i].b))
                low = middle + 1;
            else
                high = middle;
        }
        for (; low < n && vec_same(order[low].at, w->wall[i].b); low++) {
            const int to = order[low].wall;
            if (w->wall[to].solid != w->wall[i].solid || r->before[to] != FW_NONE) continue;
            r->next[i] = to, r->before[to] = (int)i;
            break;
        }
    }
    return FW_OK;
}

/* closed chains that go round clockwise, and are short */
static void find_holes(const runs *r) {
    const fw_mechanism_walls *w = r->w;
    for (int i = 0; i < w->nwall; i++) {
        double round = 0, area = 0;
        int k = i;
        bool first = true;
        do {
            const fw_mechanism_wall *at = &w->wall[k];
            round += vec_distance(at->a, at->b), area += vec_cross(at->a, at->b);
            first = first && k >= i;
            k = r->next[k];
        } while (k != FW_NONE && k != i && round <= round_m);
        if (k != i || !first || !(area < 0) || round > round_m) continue;
        do
            r->hole[k] = true, k = r->next[k];
        while (k != i);
    }
}

static void take_run(runs *r, int first) {
    const fw_mechanism_walls *w = r->w;
    run *to = &r->run[r->nrun];
    double turned = 0;
    *to = (run){.first = first, .last = first};
    for (int k = first; k != FW_NONE && r->of[k] == FW_NONE; k = r->next[k]) {
        if (k != first) {
            const double by = turn(w, r->before[k], k);
            turned += by;
            if (fabs(by) > corner_rad || fabs(turned) > turned_rad) break;
        }
        r->of[k] = r->nrun, r->at_m[k] = to->length_m, to->last = k;
        to->length_m += vec_distance(w->wall[k].a, w->wall[k].b);
    }
    r->nrun++;
}

static fw_status take_runs(const fw_mechanism_walls *w, runs *r) {
    const size_t n = (size_t)w->nwall;
    *r = (runs){.w = w};
    FW_NEED(r->next = fw_arena_array(w->arena, int, 3 * n));
    r->before = r->next + n, r->of = r->before + n;
    FW_NEED(r->at_m = fw_arena_array(w->arena, double, n));
    FW_NEED(r->hole = fw_arena_array(w->arena, bool, n));
    FW_NEED(r->run = fw_arena_array(w->arena, run, n));
    FW_TRY(link_walls(r));
    find_holes(r);
    for (int i = 0; i < w->nwall; i++)
        if (r->before[i] == FW_NONE || fabs(turn(w, r->before[i], i)) > corner_rad) take_run(r, i);
    for (int i = 0; i < w->nwall; i++)
        if (r->of[i] == FW_NONE) take_run(r, i);
    return FW_OK;
}

typedef struct station { /* of a run */
    int wall, opposite;  /* opposite: the wall at its back; FW_NONE: it is not slender there */
    fw_geometry_vec2 at, normal;
    double x_m, length_m, thick_m;
} station;

/* Material behind a wall, holes left out; HUGE_VAL: more than `most_m`, or something else begins there */
static double behind(const runs *r, const station *s, double most_m, int *opposite) {
    enum { HOLES = 20 };
    const fw_mechanism_walls *w = r->w;
    fw_geometry_vec2 p = s->at, in = vec_scale(-1, s->normal);
    int own = s->wall;
    double sum = 0, t;
    *opposite = FW_NONE;
    for (int k = 0; k < HOLES; k++) {
        int hit = look_within(w, own, p, in, most_m, &t);
        if (hit < 0 || w->wall[hit].solid != w->wall[s->wall].solid) break;
        sum += t;
        if (!r->hole[hit]) {
            *opposite = hit;
            return sum;
        }
        p = vec_along(p, t, in);
        own = look_within(w, hit, p, in, most_m, &t);
        if (own < 0 || !r->hole[own]) break;
        p = vec_along(p, t, in);
    }
    return HUGE_VAL;
}

/* thick: with what lies behind them */
static fw_status put_stations(const runs *r, const run *of, bool thick, station **out, int *n) {
    const fw_mechanism_walls *w = r->w;
    const double step = fmin(FW_MECHANISM_RAYS_m, of->length_m / 8),
                 most = fmin(reach_m, of->length_m / slender);
    int stations = 0;
    for (int k = of->first;; k = r->next[k]) {
        stations += 1 + (int)(vec_distance(w->wall[k].a, w->wall[k].b) / step);
        if (k == of->last) break;
    }
    FW_NEED(*out = fw_arena_array(w->arena, station, (size_t)stations));
    *n = 0;
    for (int k = of->first;; k = r->next[k]) {
        const fw_mechanism_wall *a = &w->wall[k];
        const double length = vec_distance(a->a, a->b);
        const int parts = 1 + (int)(length / step);
        const fw_geometry_vec2 along = vec_sub(a->b, a->a),
                               normal = {along.y / length, -along.x / length};
        for (int i = 0; i < parts && length > 0; i++) {
            station *s = &(*out)[(*n)++];
            *s = (station){.wall = k,
                           .at = vec_along(a->a, (i + 0.5) / parts, along),
                           .normal = normal,
                           .x_m = r->at_m[k] + (i + 0.5) * length / parts,
                           .length_m = length / parts};
            if (thick) s->thick_m = behind(r, s, most, &s->opposite);
        }
        if (k == of->last) break;
    }
    return FW_OK;
}

/* What becomes of a run beyond its last wall (forward) or its first one, where the wall at its back is of the run `back` */
static end_kind end_of(const runs *r, const run *of, bool forward, const station *s) {
    const fw_mechanism_walls *w = r->w;
    double round = 0;
    if (s->opposite == FW_NONE) return END_ROOT;
    int from = forward ? of->last : of->first, to = forward ? r->next[from] : r->before[from];
    const bool strip = w->wall[from].solid <= FW_MECHANISM_FLEXED;
    if (to == FW_NONE) return strip ? END_ROOT : END_HINGE;
    if ((forward ? turn(w, from, to) : turn(w, to, from)) < 0) return END_ROOT;
    for (; to != FW_NONE && round <= 2 * s->thick_m; to = forward ? r->next[to] : r->before[to]) {
        if (r->of[to] == r->of[s->opposite]) return END_TIP;
        round += vec_distance(w->wall[to].a, w->wall[to].b);
    }
    return END_HINGE;
}

/* thickness of a beam of even width that gives as much */
static double even_thickness(const run *of, const station *s, int n) {
    double sum = 0, all = 0;
    for (int i = 0; i < n; i++) {
        const double z = (s[i].x_m - of->root_m) / of->reach_m, t = s[i].thick_m;
        if (z < 0 || z > 1) continue;
        const double weight = s[i].length_m * (of->kind == LIMB_FREE ? pow(1 - z, 3) : 1);
        all += weight, sum += weight / (t * t * t);
    }
    return sum > 0 ? cbrt(all / sum) : HUGE_VAL;
}

/* What is more than four times as thick as the thinnest place at an end of a run holds it there. */
static void measure(const runs *r, run *of, const station *s, int n) {
    const double holds = 4;
    double least = HUGE_VAL;
    int i = 0, k = n - 1;
    for (int j = 0; j < n; j++)
        least = fmin(least, s[j].thick_m);
    of->kind = LIMB_NONE;
    if (!isfinite(least)) return;
    while (s[i].thick_m > holds * least)
        i++;
    while (s[k].thick_m > holds * least)
        k--;
    const end_kind first = i > 0 ? END_ROOT : end_of(r, of, false, &s[0]),
                   last = k < n - 1 ? END_ROOT : end_of(r, of, true, &s[n - 1]);
    of->root_m = s[i].x_m - 0.5 * s[i].length_m;
    of->reach_m = s[k].x_m + 0.5 * s[k].length_m - of->root_m;
    if (first == END_TIP && last == END_TIP)
        of->kind = LIMB_TIPS;
    else if (first == END_TIP)
        of->kind = LIMB_FREE, of->root_m += of->reach_m, of->reach_m *= -1;
    else if (last == END_TIP)
        of->kind = LIMB_FREE;
    else
        of->kind = first == END_ROOT && last == END_ROOT ? LIMB_CLAMPED : LIMB_PINNED;
    of->thick_m = even_thickness(of, s, n);
    if (of->kind != LIMB_TIPS && !(slender * of->thick_m < fabs(of->reach_m))) of->kind = LIMB_NONE;
}

/* Of what is free at both ends on this side something holds the other side: the longest limb there is its own as well */
static void measure_tips(const runs *r, run *of, const station *s, int n) {
    const fw_mechanism_walls *w = r->w;
    const run *best = NULL;
    const fw_geometry_vec2 start = w->wall[of->first].a,
                           along = vec_unit(vec_sub(w->wall[of->last].b, start));
    of->kind = LIMB_NONE;
    for (int i = 0; i < n; i++) {
        const run *back = s[i].opposite == FW_NONE ? NULL : &r->run[r->of[s[i].opposite]];
        if (!back || back->kind != LIMB_FREE) continue;
        if (!best || fabs(back->reach_m) > fabs(best->reach_m)) best = back;
    }
    if (!best) return;
    const fw_geometry_vec2 root =
        best->reach_m > 0 ? w->wall[best->first].a : w->wall[best->last].b;
    of->kind = LIMB_FREE, of->thick_m = best->thick_m;
    of->root_m = vec_dot(vec_sub(root, start), along), of->reach_m = -best->reach_m;
}

static double shape_at(const run *of, double x_m) {
    double z = (x_m - of->root_m) / of->reach_m;
    if (!(z > 0)) return 0;
    z = fmin(z, 1);
    switch (of->kind) {
    case LIMB_FREE:
        return z * z * (6 - 4 * z + z * z) / 3;
    case LIMB_CLAMPED:
        return 16 * z * z * (1 - z) * (1 - z);
    case LIMB_PINNED:
        return sin(FW_PI * z);
    case LIMB_NONE:
    case LIMB_TIPS:
        break;
    }
    return 0;
}

static double gives(const run *of, double youngs_Pa, double depth_m) {
    const double L = fabs(of->reach_m),
                 kappa = of->kind == LIMB_FREE      ? 3
                         : of->kind == LIMB_CLAMPED ? 192
                                                    : 48,
                 t = of->thick_m;
    return 12 * L * L * L / (kappa * youngs_Pa * depth_m * t * t * t);
}

/* ---- what pulls a limb ---- */

enum {
    PARTNERS = 8
}; /* limbs that face one wall; what else faces it, and the rest of them, is as if it stood */

typedef struct pair {
    int limb[1 + PARTNERS], n;
} pair;

static int partner(pair *p, int limb) {
    for (int i = 0; i < p->n; i++)
        if (p->limb[i] == limb) return i;
    if (p->n > PARTNERS) return FW_NONE;
    p->limb[p->n] = limb;
    return p->n++;
}

static fw_status put_facing(const fw_mechanism *m, const runs *r, int own, const station *s,
                            double come_m, pair *p, fw_mechanism_faces *to) {
    const fw_mechanism_walls *w = r->w;
    const double phi = shape_at(&r->run[own], s->x_m), depth = m->variant->thickness_m;
    double gap;
    const int hit = phi > 0 ? fw_mechanism_walls_look(w, s->wall, s->at, s->normal, &gap) : -1;
    if (hit < 0) return FW_OK;
    const fw_mechanism_wall *b = &w->wall[hit];
    const fw_geometry_vec2 back = vec_unit(vec_sub(b->b, b->a)), out = {back.y, -back.x};
    if (vec_dot(out, s->normal) > -FW_MECHANISM_FACING) return FW_OK;
    gap = fmax(gap - come_m, 1e-9);
    fw_mechanism_face face = {.body = {0, FW_GROUND},
                              .by = {{phi, 0, 0}},
                              .area_m2 = s->length_m * depth,
                              .gap_m = gap,
                              .more = gap / depth,
                              .at = s->at,
                              .normal = s->normal,
                              .piece = {w->wall[s->wall].piece, b->piece}};
    const int other = r->of[hit];
    if (other != own && r->run[other].kind != LIMB_NONE) {
        const fw_geometry_vec2 met = vec_along(s->at, gap, s->normal);
        face.body[1] = partner(p, other);
        if (face.body[1] != FW_NONE)
            face.by[1][0] =
                shape_at(&r->run[other], r->at_m[hit] + vec_dot(vec_sub(met, b->a), back));
        else
            face.body[1] = FW_GROUND;
    }
    return fw_mechanism_faces_add(to, &face);
}

static int solid_shown(int solid) {
    return solid <= FW_MECHANISM_FLEXED ? FW_GROUND : solid;
}

static fw_status pull_limb(const fw_mechanism *m, const runs *r, int own, double enough_N_per_m,
                           fw_mechanism_limb *out) {
    fw_arena *arena = r->w->arena;
    const fw_mechanism_walls *w = r->w;
    pair p = {.limb = {own}, .n = 1};
    fw_mechanism_faces to = {.arena = arena};
    station *s;
    int n, first;
    FW_TRY(put_stations(r, &r->run[own], false, &s, &n));
    for (int i = 0; i < n; i++)
        FW_TRY(put_facing(m, r, own, &s[i], fw_layout_walls_m(m->layout), &p, &to));
    *out = (fw_mechanism_limb){.tension_N_per_m = HUGE_VAL};
    if (to.count == 0) return FW_OK;
    double *c;
    const size_t size = 3 * (size_t)p.n;
    FW_NEED(c = fw_arena_array(arena, double, size *size));
    for (size_t i = 0; i < (size_t)p.n; i++)
        c[3 * i * size + 3 * i] =
            gives(&r->run[p.limb[i]], m->variant->material.youngs.value, m->variant->thickness_m);
    FW_TRY(fw_mechanism_pull_in(arena, c, (int)size, to.face, (int)to.count, FW_PULL_EACH,
                                enough_N_per_m, &out->tension_N_per_m, &first));
    if (first == FW_NONE) return FW_OK;
    const fw_mechanism_face *at = &to.face[first];
    out->gap_m = at->gap_m;
    for (int k = 0; k < 2; k++) {
        out->piece[k] = at->piece[k];
        out->body[k] = FW_GROUND;
    }
    out->body[0] = solid_shown(w->wall[r->run[own].first].solid);
    const fw_layout_piece *other = &m->layout->piece[at->piece[1]];
    out->body[1] = other->body >= 0 && other->body < m->nbody ? other->body : FW_GROUND;
    out->limbs = at->body[1] != FW_GROUND;
    return FW_OK;
}

/* In: the layout in the drawn pose, as made; enough: a tension (s) of which nothing is known any closer. Out: of every limb that something
   pulls at a lesser tension than those before it. */
fw_status fw_mechanism_limbs_beside(const fw_mechanism *m, const fw_mechanism_walls *w,
                                    double enough_N_per_m, fw_mechanism_limb **limb, int *nlimb) {
    fw_arena *arena = w->arena;
    runs r;
    station *s;
    int n;
    *limb = NULL, *nlimb = 0;
    if (w->nwall == 0) return FW_OK;
    FW_TRY(take_runs(w, &r));
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < r.nrun; i++) {
            run *of = &r.run[i];
            const fw_layout_piece *piece = &m->layout->piece[w->wall[of->first].piece];
            fw_mark mark = fw_arena_mark(arena);
            if (pass ? of->kind != LIMB_TIPS : of->length_m < shortest_m) continue;
            if (piece->role == FW_ROLE_TETHER || piece->role == FW_ROLE_FRAME) continue;
            FW_TRY(put_stations(&r, of, true, &s, &n));
            if (pass == 0)
                measure(&r, of, s, n);
            else
                measure_tips(&r, of, s, n);
            fw_arena_rewind(arena, mark);
        }
    FW_NEED(*limb = fw_arena_array(arena, fw_mechanism_limb, (size_t)r.nrun));
    for (int i = 0; i < r.nrun; i++) {
        fw_mark mark = fw_arena_mark(arena);
        fw_mechanism_limb *to = &(*limb)[*nlimb];
        if (r.run[i].kind == LIMB_NONE) continue;
        FW_TRY(pull_limb(m, &r, i, enough_N_per_m, to));
        fw_arena_rewind(arena, mark);
        if (to->tension_N_per_m < enough_N_per_m) (*nlimb)++;
    }
    return FW_OK;
}
