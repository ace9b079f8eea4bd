/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which walls stand opposite each other, and sections of the material between two walls of its own.
   Theory: docs/theory/stiction.md */
#include "base/constants.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include <stdlib.h>
#include <string.h>

/* ---- walls opposite each other ---- */

static const double reach_m =
                        200e-6, /* a liquid between walls further apart pulls next to nothing */
    least_side_m = 25e-6;       /* of a bin */
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
    w->side_m = fmax(least_side_m, fmax(width, height) / BINS);
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

static bool is_in(const range *r, int i, int j) {
    return i >= r->i0 && i <= r->i1 && j >= r->j0 && j <= r->j1;
}

/* of the walls of a bin, one that the ray meets before *gap */
static void look_in(const fw_mechanism_walls *w, int of, int own, fw_geometry_vec2 p,
                    fw_geometry_vec2 n, int *found, double *gap) {
    for (int k = w->begin[of]; k < w->begin[of + 1]; k++) {
        const fw_mechanism_wall *to = &w->wall[w->in[k]];
        fw_geometry_vec2 along = vec_sub(to->b, to->a), off = vec_sub(to->a, p);
        double det = vec_cross(n, along), beside = vec_cross(off, n); /* 0 to det within it */
        if (det > 0 ? beside < 0 || beside > det : beside > 0 || beside < det) continue;
        if (w->in[k] == own || det == 0) continue;
        double t = vec_cross(off, along) / det;
        if (t > 0 && t < *gap) *gap = t, *found = w->in[k];
    }
}

/* along the ray from bin to bin: what is found before the next one is the nearest of all */
int fw_mechanism_walls_look(const fw_mechanism_walls *w, int own, fw_geometry_vec2 p,
                            fw_geometry_vec2 n, double *gap) {
    range last = {1, 0, 1, 0};
    int found = -1;
    *gap = reach_m;
    for (double from = 0; from < *gap; from += w->side_m) {
        const fw_geometry_box box =
            box_of(vec_along(p, from, n), vec_along(p, fmin(from + w->side_m, reach_m), n));
        const range r = bins_of(w, &box);
        for (int j = r.j0; j <= r.j1; j++)
            for (int i = r.i0; i <= r.i1; i++)
                if (!is_in(&last, i, j)) look_in(w, j * w->nx + i, own, p, n, &found, gap);
        last = r;
    }
    return found;
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

/* ---- sections of the material, for mechanism_limbs.c ----
   Along its outlines, one for each 15 um of a wall: the line to the wall at its back. One whose ends are of one outline cuts off what
   lies between them, which hangs on it where no hinge is there, and of two such parts the smaller one. Of two that cross the thicker
   one is left out, so that sections lie in one another. Cost: a ray for two stations. Test: test_mechanism_pull.c */

typedef fw_mechanism_station station;
typedef fw_mechanism_chain chain;
typedef fw_mechanism_section section;

static const double round_m = 200e-6; /* of a release hole */

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

static fw_status link_walls(fw_mechanism_sections *r) {
    const fw_mechanism_walls *w = r->w;
    const size_t n = (size_t)w->nwall;
    begin *order;
    FW_NEED(order = fw_arena_array(w->arena, begin, n));
    for (size_t i = 0; i < n; i++) {
        order[i] = (begin){w->wall[i].a, (int)i};
        r->next[i] = r->before[i] = r->first[i] = FW_NONE;
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
static void find_holes(const fw_mechanism_sections *r) {
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

/* ---- stations ---- */

static int stations_of(const fw_mechanism_wall *w) {
    const double length = vec_distance(w->a, w->b);
    const int least = length > FW_MECHANISM_RAYS_m ? 4 : 1,
              n = 1 + (int)(length / FW_MECHANISM_RAYS_m);
    return n > least ? n : least;
}

int fw_mechanism_sections_nearest(const fw_mechanism_sections *r, int wall, fw_geometry_vec2 p) {
    const fw_mechanism_wall *w = &r->w->wall[wall];
    const fw_geometry_vec2 along = vec_sub(w->b, w->a);
    const int n = stations_of(w),
              k = (int)(n * vec_dot(vec_sub(p, w->a), along) / vec_dot(along, along));
    return r->first[wall] == FW_NONE ? FW_NONE : r->first[wall] + (k < 0 ? 0 : k >= n ? n - 1 : k);
}

static fw_geometry_vec2 out_of(const fw_mechanism_wall *w) {
    const fw_geometry_vec2 along = vec_unit(vec_sub(w->b, w->a));
    return (fw_geometry_vec2){along.y, -along.x};
}

/* Material behind a wall, holes left out, to a wall that faces away from it */
static void look_back(const fw_mechanism_sections *r, station *s) {
    enum { HOLES = 20 };
    const fw_mechanism_walls *w = r->w;
    fw_geometry_vec2 p = s->at, in = vec_scale(-1, s->normal);
    int own = s->wall;
    double t;
    for (int k = 0; k < HOLES; k++) {
        const int hit = fw_mechanism_walls_look(w, own, p, in, &t);
        if (hit < 0 || w->wall[hit].solid != w->wall[s->wall].solid) return;
        s->thick_m += t;
        p = vec_along(p, t, in);
        if (!r->hole[hit]) {
            if (vec_dot(out_of(&w->wall[hit]), in) > FW_MECHANISM_FACING)
                s->back = fw_mechanism_sections_nearest(r, hit, p);
            return;
        }
        own = fw_mechanism_walls_look(w, hit, p, in, &t);
        if (own < 0 || !r->hole[own]) return;
        p = vec_along(p, t, in);
    }
}

void fw_mechanism_sections_across(const fw_mechanism_sections *r, station *s) {
    const int hit = fw_mechanism_walls_look(r->w, s->wall, s->at, s->normal, &s->gap_m);
    if (hit < 0 || vec_dot(out_of(&r->w->wall[hit]), s->normal) > -FW_MECHANISM_FACING) return;
    s->opposite = hit;
    s->gap_m = fmax(s->gap_m - fw_layout_walls_m(r->m->layout), 1e-9);
}

static bool is_left_out(const fw_mechanism_sections *r, int wall) {
    const fw_layout_piece *p = &r->m->layout->piece[r->w->wall[wall].piece];
    return r->hole[wall] || p->role == FW_ROLE_TETHER || p->role == FW_ROLE_FRAME ||
           vec_same(r->w->wall[wall].a, r->w->wall[wall].b);
}

static void take_chain(fw_mechanism_sections *r, int from, bool closed) {
    const fw_mechanism_walls *w = r->w;
    chain *c = &r->chain[r->nchain];
    *c = (chain){.first = r->nstation, .closed = closed};
    for (int k = from; k != FW_NONE && r->first[k] == FW_NONE; k = r->next[k]) {
        const int n = stations_of(&w->wall[k]);
        const fw_geometry_vec2 along = vec_sub(w->wall[k].b, w->wall[k].a);
        r->first[k] = r->nstation;
        if (is_left_out(r, k)) continue;
        for (int i = 0; i < n; i++)
            r->station[r->nstation++] =
                (station){.wall = k,
                          .chain = r->nchain,
                          .at = vec_along(w->wall[k].a, (i + 0.5) / n, along),
                          .normal = out_of(&w->wall[k]),
                          .length_m = vec_length(along) / n,
                          .back = FW_NONE,
                          .opposite = FW_NONE,
                          .limb = FW_NONE};
    }
    c->count = r->nstation - c->first;
    r->nchain++;
}

static fw_status take_stations(fw_mechanism_sections *r) {
    const fw_mechanism_walls *w = r->w;
    const size_t n = (size_t)w->nwall;
    size_t all = 0;
    FW_NEED(r->next = fw_arena_array(w->arena, int, 3 * n));
    r->before = r->next + n, r->first = r->before + n;
    FW_NEED(r->hole = fw_arena_array(w->arena, bool, n));
    FW_NEED(r->chain = fw_arena_array(w->arena, chain, n));
    for (int i = 0; i < w->nwall; i++)
        all += (size_t)stations_of(&w->wall[i]);
    FW_NEED(r->station = fw_arena_array(w->arena, station, all));
    FW_TRY(link_walls(r));
    find_holes(r);
    for (int i = 0; i < w->nwall; i++)
        if (r->before[i] == FW_NONE) take_chain(r, i, false);
    for (int i = 0; i < w->nwall; i++)
        if (r->first[i] == FW_NONE) take_chain(r, i, true);
    for (int i = 0; i < w->nwall; i++)
        if (is_left_out(r, i)) r->first[i] = FW_NONE;
    for (int i = 0; i < r->nstation; i++) {
        station *s = &r->station[i];
        if (s->back == FW_NONE) look_back(r, s);
        if (!(s->thick_m + 2 * r->m->layout->edge_m > 0)) s->back = FW_NONE;
        if (s->back != FW_NONE && r->station[s->back].back == FW_NONE)
            r->station[s->back].back = i, r->station[s->back].thick_m = s->thick_m;
    }
    for (int i = 0; i < r->nstation; i++)
        r->station[i].thick_m += 2 * r->m->layout->edge_m;
    return FW_OK;
}

/* ---- sections ---- */

int fw_mechanism_sections_place(const fw_mechanism_sections *r, int k) {
    const chain *c = &r->chain[r->station[k].chain];
    return (k - c->first - c->begin + c->count) % c->count;
}

int fw_mechanism_sections_station(const fw_mechanism_sections *r, int of, int place) {
    const chain *c = &r->chain[of];
    return c->first + (place + c->begin) % c->count;
}

fw_geometry_vec2 fw_mechanism_sections_middle(const fw_mechanism_sections *r, const station *s) {
    return vec_scale(0.5, vec_add(s->at, r->station[s->back].at));
}

/* Of a chain: what hangs on each of its stations' sections, from `lo` on, `lo` + `n` the last; n 0: nothing. sum: (count + 1) of areas */
static int hangs_on(const fw_mechanism_sections *r, const chain *c, const double *sum, int k,
                    int *lo) {
    const station *s = &r->station[c->first + k];
    if (s->back == FW_NONE || s->back == c->first + k || r->station[s->back].chain != s->chain)
        return 0;
    const int back = s->back - c->first, i = k < back ? k : back, j = k < back ? back : k;
    const double closes = vec_cross(r->station[c->first + j].at, r->station[c->first + i].at),
                 inner = sum[j] - sum[i] + closes, outer = sum[c->count] - inner;
    const bool in = !c->closed || (inner > 0 && !(outer > 0 && outer < inner));
    *lo = in ? i : j;
    return in ? j - i : c->count - (j - i);
}

static fw_status take_sections(fw_mechanism_sections *r, int of) {
    chain *c = &r->chain[of];
    const size_t n = (size_t)c->count;
    double *sum;
    int *covers, lo, long_;
    FW_NEED(sum = fw_arena_array(r->w->arena, double, n + 1));
    FW_NEED(covers = fw_arena_array(r->w->arena, int, 2 * n + 2));
    for (int k = 0; k < c->count; k++)
        sum[k + 1] = sum[k] + vec_cross(r->station[c->first + k].at,
                                        r->station[c->first + (k + 1) % c->count].at);
    for (int k = 0; k < c->count; k++)
        if ((long_ = hangs_on(r, c, sum, k, &lo)) > 0) covers[lo + 1]++, covers[lo + long_ + 1]--;
    for (int k = 1; k < 2 * c->count + 2; k++)
        covers[k] += covers[k - 1];
    int best = 0;
    for (int k = 1; c->closed && k < c->count; k++)
        if (covers[k] + covers[k + c->count] < covers[best] + covers[best + c->count]) best = k;
    for (int k = 0; k < c->count; k++) {
        const station *s = &r->station[c->first + k];
        if ((long_ = hangs_on(r, c, sum, k, &lo)) == 0) continue;
        const int from = (lo - best + c->count) % c->count;
        if (from + long_ < c->count)
            r->section[r->nsection++] = (section){.chain = of,
                                                  .lo = from,
                                                  .hi = from + long_,
                                                  .at = c->first + k,
                                                  .parent = FW_NONE,
                                                  .heir = FW_NONE,
                                                  .limb = FW_NONE,
                                                  .thick_m = s->thick_m,
                                                  .middle = fw_mechanism_sections_middle(r, s)};
    }
    c->begin = best;
    return FW_OK;
}

static int by_nest(const void *a, const void *b) {
    const section *p = a, *q = b;
    if (p->chain != q->chain) return p->chain < q->chain ? -1 : 1;
    if (p->lo != q->lo) return p->lo < q->lo ? -1 : 1;
    if (p->hi != q->hi) return p->hi > q->hi ? -1 : 1;
    if (p->thick_m != q->thick_m) return p->thick_m < q->thick_m ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

static bool holds_other(const section *p, const section *q) {
    return p->chain == q->chain && p->lo <= q->lo && q->hi <= p->hi;
}

/* of two that cross, or hold the same, the thinner one is kept */
static fw_status nest_sections(fw_mechanism_sections *r) {
    int *stack, top = 0, n = 0;
    FW_NEED(stack = fw_arena_array(r->w->arena, int, (size_t)r->nsection + 1));
    qsort(r->section, (size_t)r->nsection, sizeof *r->section, by_nest);
    for (int i = 0; i < r->nsection; i++) {
        section *s = &r->section[i];
        bool kept = true;
        while (top > 0 && kept) {
            section *t = &r->section[stack[top - 1]];
            if (t->chain != s->chain || t->hi < s->lo) {
                top--;
                continue;
            }
            const bool same = t->lo == s->lo && t->hi == s->hi;
            if (holds_other(t, s) && !same) break;
            if (same || !(s->thick_m < t->thick_m))
                kept = false;
            else
                t->at = FW_NONE, top--;
        }
        if (kept)
            stack[top++] = i;
        else
            s->at = FW_NONE;
    }
    for (int i = 0; i < r->nsection; i++)
        if (r->section[i].at != FW_NONE) r->section[n++] = r->section[i];
    r->nsection = n, top = 0;
    for (int i = 0; i < n; i++) {
        while (top > 0 && !holds_other(&r->section[stack[top - 1]], &r->section[i]))
            top--;
        r->section[i].parent = top > 0 ? stack[top - 1] : FW_NONE;
        stack[top++] = i;
    }
    return FW_OK;
}

fw_status fw_mechanism_sections_take(const fw_mechanism *m, const fw_mechanism_walls *w,
                                     fw_mechanism_sections *r) {
    fw_arena *arena = w->arena;
    *r = (fw_mechanism_sections){.w = w, .m = m};
    FW_TRY(take_stations(r));
    FW_NEED(r->section = fw_arena_array(arena, section, (size_t)r->nstation + 1));
    for (int i = 0; i < r->nchain; i++) {
        fw_mark mark = fw_arena_mark(arena);
        if (r->chain[i].count > 0) FW_TRY(take_sections(r, i));
        fw_arena_rewind(arena, mark);
    }
    return nest_sections(r);
}
