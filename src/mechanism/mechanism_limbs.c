/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Limbs: what of a body is slender, and bends towards the wall beside it. Theory: docs/theory/stiction.md */
#include "base/sort.h"
#include "geometry/segment.h"
#include "maths/matrix.h"
#include "mechanism/mechanism_plates.h"
#include <stdlib.h>
#include <string.h>

/* ---- limbs ----
   What of a body, or of what stands, is slender bends towards what stands beside it: fingers, bars, jaws, with all that hangs on
   them. Sections of the material are found along its outline, one for each 15 um of a wall: the line to the wall at its back, t long.
   One whose ends are of one outline cuts off what lies between them, which hangs on it where no hinge is there, and of two such
   parts the smaller one: sections that lie in one another are a tree, from where it is held to its tips. So steps, bumps, heads and
   corners are places of one limb. Sections from one outline to another, or between hinges, are a strut, held at both ends: it begins
   where it is wider than four times its least t. A limb goes from one fork to the next, and

     C(p) = sum over its sections up to p of 12 ds/(E h t^3) ((p - m) x n)^2      of a strut less c F^-1 c, both its ends held

   is how far a place p goes along its normal n by a force on it. m: the middle of a section; what widens to more than twice as much
   holds it 0.45 t further on (a beam on a half-plane turns by 5.3 M/(E h t^2)). Compliances between two places are at most
   sqrt(C(p) C(q)), so that one coordinate with the shape sqrt(C) bends at least as far as the limb, whatever pulls it: 6 % more
   for an even pull on a cantilever, 18 % on what is clamped at both ends. What pulls are all gaps of the limb, and of what hangs on
   it, that bend it one way; what faces it bends as well, each limb by one coordinate. The limbs that it hangs on are added by
   Dunkerley's rule.
   Error: t as made; plain beams; ds is known to half a ray. Rings within rings are seen strut by strut. Cost: two rays each 15 um, and
   fw_mechanism_pull_in of some coordinates for each side of a limb. Test: test_mechanism_pull.c */

typedef fw_mechanism_station station;
typedef fw_mechanism_chain chain;
typedef fw_mechanism_section section;
typedef struct
    node { /* sums up to a section: of w r r', r = (m_y, -m_x, 1) from the limb's origin */
    double xx, xy, xk, yy, yk, kk;
} node;

typedef struct limb {
    int parent, at_node; /* limb that it hangs on, and where; FW_NONE */
    int chain, lo, hi;   /* all that it holds */
    bool strut, forks;
    fw_geometry_vec2 origin;
    double back[3][3];    /* of a strut: F^-1 */
    double bears_N_per_m; /* of one that forks: where all that faces it stands */
} limb;

typedef struct limbs {
    fw_mechanism_sections s;
    limb *limb;
    node *node;
    int nlimb, nnode;
} limbs;
static const double widens = 2, turns = 0.45, stub = 3;

/* where a section's own thickness ends on the way to the one before it */
static void share_way(const limbs *r, const section *s, const section *p, double *own,
                      double *other) {
    const double way = vec_distance(s->middle, p->middle);
    *own = *other = 0.5 * way;
    if (p->thick_m > widens * s->thick_m)
        *own = fmin(way, 0.5 * r->s.station[s->at].length_m + turns * s->thick_m),
        *other = way - *own;
    else if (s->thick_m > widens * p->thick_m)
        *other = fmin(way, 0.5 * r->s.station[p->at].length_m + turns * p->thick_m),
        *own = way - *other;
}

static void add_span(node *to, fw_geometry_vec2 origin, fw_geometry_vec2 at, double by) {
    const double x = at.x - origin.x, y = at.y - origin.y;
    to->xx += by * y * y, to->xy -= by * x * y, to->xk += by * y;
    to->yy += by * x * x, to->yk -= by * x, to->kk += by;
}

static double bends_by(const limbs *r, double length_m, double thick_m) {
    return 12 * length_m /
           (r->s.m->variant->material.youngs.value * r->s.m->variant->thickness_m * thick_m *
            thick_m * thick_m);
}

/* from the section before it, NULL: from where it is held, to a section */
static void add_section(const limbs *r, node *to, fw_geometry_vec2 origin, const section *s,
                        const section *p) {
    double own, other;
    if (!p) {
        own = 0.5 * r->s.station[s->at].length_m + turns * s->thick_m;
        add_span(to, origin, s->middle, bends_by(r, own, s->thick_m));
        return;
    }
    const double way = vec_distance(s->middle, p->middle);
    const fw_geometry_vec2 back = vec_sub(p->middle, s->middle);
    if (!(way > 0)) return;
    share_way(r, s, p, &own, &other);
    add_span(to, origin, vec_along(s->middle, 0.5 * own / way, back), bends_by(r, own, s->thick_m));
    add_span(to, origin, vec_along(p->middle, -0.5 * other / way, back),
             bends_by(r, other, p->thick_m));
}

/* which sections go on as one limb: what is shorter than three times its thickness is no fork */
static void find_heirs(limbs *r) {
    for (int i = r->s.nsection - 1; i >= 0; i--) {
        section *s = &r->s.section[i], *p = s->parent == FW_NONE ? NULL : &r->s.section[s->parent];
        double own, other;
        s->slender =
            s->slender || s->long_m + 0.5 * r->s.station[s->at].length_m >= stub * s->thick_m;
        if (!p) continue;
        share_way(r, s, p, &own, &other);
        const bool better = p->heir == FW_NONE || r->s.section[p->heir].slender < s->slender ||
                            (r->s.section[p->heir].slender == s->slender &&
                             r->s.section[p->heir].long_m < s->long_m);
        if (better) p->heir = i;
        p->branches += s->slender, p->slender = p->slender || s->slender;
        p->long_m =
            fmax(p->long_m, s->long_m + own + (p->thick_m > widens * s->thick_m ? 0 : other));
    }
}

static int new_limb(limbs *r, const section *s, int parent, int at_node) {
    r->limb[r->nlimb] = (limb){.parent = parent,
                               .at_node = at_node,
                               .chain = s->chain,
                               .lo = s->lo,
                               .hi = s->hi,
                               .origin = s->middle,
                               .bears_N_per_m = HUGE_VAL};
    if (parent != FW_NONE) r->limb[parent].forks = true;
    return r->nlimb++;
}

/* A bar that stands is held along itself, as far as it is no more than twice as thick anywhere */
static bool is_held(const limbs *r, const section *s, const section *p) {
    const chain *c = &r->s.chain[s->chain];
    if (!c->closed || r->s.w->wall[r->s.station[s->at].wall].solid != FW_GROUND) return false;
    if (p) return p->stands && p->thick_m < widens * s->thick_m;
    for (int k = 0; k < 2; k++) {
        const int place = k ? s->hi + 1 : s->lo - 1 + c->count;
        const station *beyond =
            &r->s.station[fw_mechanism_sections_station(&r->s, s->chain, place % c->count)];
        if (beyond->back != FW_NONE && beyond->thick_m < widens * s->thick_m) return true;
    }
    return false;
}

static void take_tree(limbs *r) {
    for (int i = 0; i < r->s.nsection; i++) {
        section *s = &r->s.section[i];
        const section *p = s->parent == FW_NONE ? NULL : &r->s.section[s->parent];
        const bool goes_on = p && p->limb != FW_NONE && p->heir == i && p->branches < 2;
        s->stands = is_held(r, s, p);
        if (s->stands) continue;
        if (!goes_on && !s->slender) { /* a stub: it is a part of what it stands on */
            if (p) s->limb = p->limb, s->node = p->node;
            continue;
        }
        s->limb = goes_on ? p->limb : new_limb(r, s, p ? p->limb : FW_NONE, p ? p->node : FW_NONE);
        s->node = r->nnode++;
        r->node[s->node] = goes_on ? r->node[p->node] : (node){0};
        add_section(r, &r->node[s->node], r->limb[s->limb].origin, s, p);
    }
}

/* the innermost section that holds each station */
static fw_status put_stations(limbs *r) {
    int *stack, top = 0, next = 0;
    FW_NEED(stack = fw_arena_array(r->s.w->arena, int, (size_t)r->s.nsection + 1));
    for (int c = 0; c < r->s.nchain; c++) {
        top = 0;
        for (int i = 0; i < r->s.chain[c].count; i++) {
            station *s = &r->s.station[fw_mechanism_sections_station(&r->s, c, i)];
            while (top > 0 && r->s.section[stack[top - 1]].hi < i)
                top--;
            for (; next < r->s.nsection && r->s.section[next].chain == c &&
                   r->s.section[next].lo == i;
                 next++)
                stack[top++] = next;
            while (top > 0 && r->s.section[stack[top - 1]].hi < i)
                top--;
            if (top == 0) continue;
            s->limb = r->s.section[stack[top - 1]].limb,
            s->node = r->s.section[stack[top - 1]].node;
        }
    }
    return FW_OK;
}

/* ---- struts ---- */

static bool is_tied(const limbs *r, const station *s) {
    return s->back != FW_NONE && r->s.station[s->back].chain != s->chain;
}

static section section_of(const limbs *r, int k) {
    return (section){.at = k,
                     .chain = r->s.station[k].chain,
                     .thick_m = r->s.station[k].thick_m,
                     .middle = fw_mechanism_sections_middle(&r->s, &r->s.station[k])};
}

static bool goes_on_to(const section *p, const section *s, const limbs *r) {
    return r->s.station[r->s.station[p->at].back].chain ==
               r->s.station[r->s.station[s->at].back].chain &&
           vec_distance(p->middle, s->middle) <
               2 * fmax(p->thick_m, s->thick_m) + 4 * FW_MECHANISM_RAYS_m;
}

/* an end that turns freely: at a hinge, and where another strut as thin as it goes on */
static bool turns_freely(const limbs *r, const chain *c, int end, int beyond, bool trimmed) {
    const station *s = &r->s.station[end];
    if (trimmed || r->s.w->wall[s->wall].solid <= FW_MECHANISM_FLEXED) return false;
    if (!c->closed && (beyond < c->first || beyond >= c->first + c->count)) return true;
    const int k = c->first + (beyond - c->first + c->count) % c->count;
    return is_tied(r, &r->s.station[k]);
}

static bool invert_ends(limb *l, const node *all, bool turns_at_end) {
    const double f[3][3] = {{all->xx, all->xy, turns_at_end ? 0 : all->xk},
                            {all->xy, all->yy, turns_at_end ? 0 : all->yk},
                            {turns_at_end ? 0 : all->xk, turns_at_end ? 0 : all->yk, all->kk}};
    double det;
    memset(l->back, 0, sizeof l->back);
    for (int i = 0; i < 3; i++)
        l->back[i][i] = 1;
    if (!fw_maths_solve3(f, 3, l->back, &det)) return false;
    for (int i = 0; i < 3 && turns_at_end; i++)
        l->back[2][i] = l->back[i][2] = 0;
    return true;
}

/* sections (n) in a row along a chain, of those from i on to k */
static void take_strut(limbs *r, const section *of, int i, int k, bool free_first, bool free_last) {
    const double big = 1e4;
    const int first = r->nnode, at = of[i].at, last = of[k].at;
    const chain *c = &r->s.chain[of[i].chain];
    limb *l = &r->limb[r->nlimb];
    *l = (limb){.parent = FW_NONE,
                .chain = of[i].chain,
                .lo = fw_mechanism_sections_place(&r->s, at),
                .strut = true,
                .origin = of[k].middle,
                .bears_N_per_m = HUGE_VAL};
    l->hi = l->lo + (last - at + c->count) % c->count;
    node sum = {0};
    double stretch = 0;
    const double area_N = r->s.m->variant->material.youngs.value * r->s.m->variant->thickness_m;
    for (int j = i; j <= k; j++) {
        add_section(r, &sum, l->origin, &of[j], j > i ? &of[j - 1] : NULL);
        if (j > i) {
            const fw_geometry_vec2 way = vec_sub(of[j].middle, of[j - 1].middle);
            const double length = vec_length(way);
            stretch =
                length > 0 ? 1 / (area_N * length * fmin(of[j].thick_m, of[j - 1].thick_m)) : 0;
            sum.xx += stretch * way.x * way.x, sum.xy += stretch * way.x * way.y;
            sum.yy += stretch * way.y * way.y;
        }
        r->node[r->nnode++] = sum;
    }
    if (!free_last) add_section(r, &sum, l->origin, &of[k], NULL);
    const double turned = big * sum.kk;
    for (int j = first; j < r->nnode && free_first; j++)
        add_span(&r->node[j], l->origin, of[i].middle, turned);
    if (free_first) add_span(&sum, l->origin, of[i].middle, turned);
    if (!invert_ends(l, &sum, free_last)) return;
    const section *place = &of[i];
    for (int j = 0; j <= l->hi - l->lo; j++) {
        station *s =
            &r->s.station[fw_mechanism_sections_station(&r->s, l->chain, (l->lo + j) % c->count)];
        while (place < &of[k] && &r->s.station[place[1].at] != s && j > 0 &&
               (place[1].at - at + c->count) % c->count <= j)
            place++;
        if (place < &of[k] && &r->s.station[place[1].at] == s) place++;
        if (j == 0) l->parent = s->limb, l->at_node = s->node;
        if (s->limb == l->parent) s->limb = r->nlimb, s->node = first + (int)(place - &of[i]);
    }
    r->nlimb++;
}

/* without what is more than four times as thick as its thinnest at the ends */
static void trim_strut(limbs *r, const section *of, int n) {
    const double thicker = 4, slender = 3;
    int i = 0, k = n - 1;
    double least = HUGE_VAL, length = 0;
    for (int j = 0; j < n; j++)
        least = fmin(least, of[j].thick_m);
    while (of[i].thick_m > thicker * least)
        i++;
    while (of[k].thick_m > thicker * least)
        k--;
    for (int j = i; j < k; j++)
        length += vec_distance(of[j].middle, of[j + 1].middle);
    const chain *c = &r->s.chain[of[i].chain];
    if (length > slender * least)
        take_strut(r, of, i, k, turns_freely(r, c, of[i].at, of[i].at - 1, i > 0),
                   turns_freely(r, c, of[k].at, of[k].at + 1, k < n - 1));
}

static fw_status take_struts(limbs *r) {
    section *of;
    FW_NEED(of = fw_arena_array(r->s.w->arena, section, (size_t)r->s.nstation + 1));
    for (int i = 0; i < r->s.nchain; i++) {
        const chain *c = &r->s.chain[i];
        int start = 0, n = 0; /* what goes round begins where it is thickest */
        for (int k = 0; k < c->count && c->closed; k++) {
            const station *s = &r->s.station[c->first + k], *b = &r->s.station[c->first + start];
            if (is_tied(r, b) && (!is_tied(r, s) || s->thick_m > b->thick_m)) start = k;
        }
        for (int k = 0; k < c->count; k++) {
            const int at = c->first + (start + k) % c->count;
            if (!is_tied(r, &r->s.station[at])) continue;
            of[n] = section_of(r, at);
            if (n > 0 && !goes_on_to(&of[n - 1], &of[n], r)) {
                trim_strut(r, of, n);
                of[0] = of[n], n = 0;
            }
            n++;
        }
        if (n > 0) trim_strut(r, of, n);
    }
    return FW_OK;
}

/* what hangs on a strut */
static void hang_on_struts(limbs *r) {
    for (int i = 0; i < r->nlimb; i++) {
        limb *l = &r->limb[i];
        const chain *c = &r->s.chain[l->chain];
        if (l->strut || (l->lo == 0 && !c->closed)) continue;
        const station *s = &r->s.station[fw_mechanism_sections_station(
            &r->s, l->chain, (l->lo - 1 + c->count) % c->count)];
        const limb *on = s->limb == FW_NONE ? NULL : &r->limb[s->limb];
        if (!on || !on->strut || on->parent != l->parent || on->chain != l->chain ||
            (l->lo - on->lo + c->count) % c->count + l->hi - l->lo >= on->hi - on->lo)
            continue;
        r->limb[s->limb].forks = true;
        l->parent = s->limb, l->at_node = s->node;
    }
}

/* ---- what pulls a limb ---- */

typedef struct given { /* a place of a limb, and how a force along its normal bends that */
    int node;
    double v[3], end[3]; /* end: of a strut, by how far its last end would go */
} given;

static void times(const node *g, const double v[3], double out[3]) {
    out[0] = g->xx * v[0] + g->xy * v[1] + g->xk * v[2];
    out[1] = g->xy * v[0] + g->yy * v[1] + g->yk * v[2];
    out[2] = g->xk * v[0] + g->yk * v[1] + g->kk * v[2];
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* the place of a station in a limb that it belongs to, or that it hangs on; false: it does neither */
static bool look_up(const limbs *r, int k, int of, given *out) {
    const station *s = &r->s.station[k];
    int l = s->limb;
    out->node = s->node;
    while (l != FW_NONE && l != of)
        out->node = r->limb[l].at_node, l = r->limb[l].parent;
    if (l == FW_NONE) return false;
    const fw_geometry_vec2 p = vec_sub(s->at, r->limb[l].origin);
    out->v[0] = s->normal.x, out->v[1] = s->normal.y, out->v[2] = vec_cross(p, s->normal);
    times(&r->node[out->node], out->v, out->end);
    return true;
}

/* m/N: how far `a` goes by a force at `b` */
static double gives(const limbs *r, int of, const given *a, const given *b) {
    const given *less = a->node < b->node ? a : b, *more = less == a ? b : a;
    const double plain = dot3(less->end, more->v);
    double sum = 0;
    for (int i = 0; i < 3 && r->limb[of].strut; i++)
        sum += a->end[i] * dot3(r->limb[of].back[i], b->end);
    return plain - sum;
}

/* by how much two walls of one limb that face each other close */
static double gives_between(const limbs *r, int of, const given *a, const given *b) {
    given d = *a;
    double twice[3], sum = 0;
    times(&r->node[b->node], a->v, twice);
    for (int i = 0; i < 3; i++)
        d.end[i] -= twice[i];
    for (int i = 0; i < 3 && r->limb[of].strut; i++)
        sum += d.end[i] * dot3(r->limb[of].back[i], d.end);
    return fabs(dot3(d.end, d.v)) - sum;
}

enum { PARTNERS = 8 }; /* limbs that face one; the rest of them bends with it */

typedef struct pair {
    int limb[1 + PARTNERS], n;
    bool alone; /* of one that forks: as if all that faces it stood */
} pair;

static int partner(pair *p, int of) {
    for (int i = 1; i < p->n; i++)
        if (p->limb[i] == of) return i;
    if (p->n > PARTNERS) return FW_NONE;
    p->limb[p->n] = of;
    return p->n++;
}

/* Of a limb of many stations a face is added to the one beside it, at its middle place and gap: a twenty-fourth of both sides in one */
static bool goes_with(const fw_mechanism_faces *to, const fw_mechanism_face *face, int stations) {
    fw_mechanism_face *f = to->count > 0 ? &to->face[to->count - 1] : NULL;
    const double most = stations / 24.0 * face->area_m2, alike = 1.1;
    if (!f || f->body[1] != face->body[1] || f->area_m2 + face->area_m2 > most ||
        fmax(f->gap_m, face->gap_m) > alike * fmin(f->gap_m, face->gap_m) ||
        vec_distance(f->at, face->at) > 4 * FW_MECHANISM_RAYS_m)
        return false;
    const double all = f->area_m2 + face->area_m2, share = face->area_m2 / all;
    for (int side = 0; side < 2; side++)
        f->by[side][0] += share * (face->by[side][0] - f->by[side][0]);
    f->gap_m = 1 / ((1 - share) / f->gap_m + share / face->gap_m);
    f->more += share * (face->more - f->more);
    f->at = vec_along(f->at, share, vec_sub(face->at, f->at));
    f->area_m2 = all;
    return true;
}

/* What a station's liquid pulls, of a limb that gives by `own` there. What faces one that forks, and does not fork itself, is pulled where
   that is looked at. */
static fw_status put_facing(const limbs *r, int of, int k, const given *here, pair *p,
                            fw_mechanism_faces *to) {
    const station *s = &r->s.station[k];
    const double depth = r->s.m->variant->thickness_m;
    const int across =
        fw_mechanism_sections_nearest(&r->s, s->opposite, vec_along(s->at, s->gap_m, s->normal));
    double own = gives(r, of, here, here);
    fw_mechanism_face face = {
        .body = {0, FW_GROUND},
        .area_m2 = s->length_m * depth,
        .gap_m = s->gap_m,
        .more = s->gap_m / depth,
        .at = s->at,
        .normal = s->normal,
        .piece = {r->s.w->wall[s->wall].piece, r->s.w->wall[s->opposite].piece}};
    given there;
    if (across != FW_NONE && look_up(r, across, of, &there))
        own = gives_between(r, of, here, &there);
    else if (across != FW_NONE && r->s.station[across].limb != FW_NONE) {
        const int other = r->s.station[across].limb;
        look_up(r, across, other, &there);
        const double give = fmax(gives(r, other, &there, &there), 0);
        if (!r->limb[of].forks || (!p->alone && r->limb[other].forks)) {
            face.body[1] = partner(p, other);
            if (face.body[1] == FW_NONE)
                face.body[1] = FW_GROUND, own += give;
            else
                face.by[1][0] = sqrt(give);
        }
    }
    face.by[0][0] = sqrt(fmax(own, 0));
    if (!(face.by[0][0] > 0 || face.by[1][0] > 0)) return FW_OK;
    return goes_with(to, &face, r->limb[of].hi - r->limb[of].lo)
               ? FW_OK
               : fw_mechanism_faces_add(to, &face);
}

static int solid_shown(int solid) {
    return solid <= FW_MECHANISM_FLEXED ? FW_GROUND : solid;
}

/* station of a limb's i-th place that faces something; FW_NONE: none does */
static int facing_at(const limbs *r, int of, int i, given *out) {
    const limb *l = &r->limb[of];
    const int k =
        fw_mechanism_sections_station(&r->s, l->chain, (l->lo + i) % r->s.chain[l->chain].count);
    return r->s.station[k].opposite != FW_NONE && look_up(r, k, of, out) ? k : FW_NONE;
}

static int nearest(const fw_mechanism_faces *of) {
    int found = 0;
    for (int i = 1; i < (int)of->count; i++) {
        const fw_mechanism_face *f = &of->face[i], *best = &of->face[found];
        if ((f->by[0][0] + f->by[1][0]) * best->gap_m >
            (best->by[0][0] + best->by[1][0]) * f->gap_m)
            found = i;
    }
    return found;
}

/* of what bends it one way: the one of where it gives most, or the other */
static fw_status pull_limb(limbs *r, int of, bool other_way, bool alone, double enough_N_per_m,
                           fw_mechanism_limb *out) {
    fw_arena *arena = r->s.w->arena;
    limb *l = &r->limb[of];
    pair p = {.limb = {of}, .n = 1, .alone = alone};
    fw_mechanism_faces to = {.arena = arena};
    given most = {0}, here;
    double best = 0, *c;
    int first;
    *out = (fw_mechanism_limb){
        .tension_N_per_m = HUGE_VAL, .order = 2 * of + other_way, .limb = {of, FW_NONE}};
    for (int i = 0; i <= l->hi - l->lo; i++)
        if (facing_at(r, of, i, &here) != FW_NONE && gives(r, of, &here, &here) > best)
            best = gives(r, of, &here, &here), most = here;
    for (int i = 0; i <= l->hi - l->lo && best > 0; i++) {
        const int k = facing_at(r, of, i, &here);
        if (k != FW_NONE && (gives(r, of, &most, &here) < 0) == other_way)
            FW_TRY(put_facing(r, of, k, &here, &p, &to));
    }
    if (to.count == 0) return FW_OK;
    const size_t size = 3 * (size_t)p.n;
    FW_NEED(c = fw_arena_array(arena, double, size *size));
    for (size_t i = 0; i < size; i += 3)
        c[i * size + i] = 1; /* m/N; what a place gives is in its shape */
    FW_TRY(fw_mechanism_pull_in(arena, c, (int)size, to.face, (int)to.count, FW_PULL_EACH,
                                enough_N_per_m, &out->tension_N_per_m, &first));
    if (!(out->tension_N_per_m < enough_N_per_m)) return FW_OK;
    if (first == FW_NONE) first = nearest(&to);
    const fw_mechanism_face *at = &to.face[first];
    out->gap_m = at->gap_m, out->at = at->at;
    for (int k = 0; k < 2; k++)
        out->piece[k] = at->piece[k];
    const int own = r->s.w->wall[r->s.station[r->s.chain[l->chain].first].wall].solid;
    const fw_layout_piece *other = &r->s.m->layout->piece[at->piece[1]];
    out->body[0] = solid_shown(own);
    out->body[1] = other->body >= 0 && other->body < r->s.m->nbody ? other->body : FW_GROUND;
    out->limbs = at->body[1] != FW_GROUND;
    if (out->limbs) out->limb[1] = p.limb[at->body[1]];
    return FW_OK;
}

static bool hangs_from(const limbs *r, int of, int on) {
    for (; of != FW_NONE; of = r->limb[of].parent)
        if (of == on) return true;
    return false;
}

/* what it hangs on gives as well, where that does not hold both */
static void add_parents(const limbs *r, fw_mechanism_limb *l) {
    double share = 1 / l->tension_N_per_m;
    for (int k = 0; k < 2; k++) {
        const int of = l->limb[k], other = l->limb[1 - k];
        for (int on = of == FW_NONE ? FW_NONE : r->limb[of].parent; on != FW_NONE;
             on = r->limb[on].parent)
            if (other == FW_NONE || !hangs_from(r, other, on))
                share += 1 / r->limb[on].bears_N_per_m;
    }
    l->tension_N_per_m = 1 / share;
}

static fw_status take_limbs(limbs *r) {
    fw_arena *arena = r->s.w->arena;
    const size_t n = (size_t)r->s.nstation + 1;
    FW_NEED(r->limb = fw_arena_array(arena, limb, n));
    FW_NEED(r->node = fw_arena_array(arena, node, 2 * n));
    find_heirs(r);
    take_tree(r);
    FW_TRY(put_stations(r));
    FW_TRY(take_struts(r));
    hang_on_struts(r);
    for (int i = 0; i < r->s.nstation; i++)
        if (r->s.station[i].limb != FW_NONE) fw_mechanism_sections_across(&r->s, &r->s.station[i]);
    return FW_OK;
}

static int by_tension(const void *a, const void *b) {
    const fw_mechanism_limb *p = a, *q = b;
    return p->tension_N_per_m != q->tension_N_per_m
               ? fw_order_doubles(p->tension_N_per_m, q->tension_N_per_m)
               : (p->order > q->order) - (p->order < q->order);
}

/* In: the layout in the drawn pose, as made; enough: a tension (s) of which nothing is known any closer. Out: of every
   limb that something pulls at a lesser tension, each way; the least first. */
fw_status fw_mechanism_limbs_beside(const fw_mechanism *m, const fw_mechanism_walls *w,
                                    double enough_N_per_m, fw_mechanism_limb **found, int *nfound) {
    limbs r = {0};
    *found = NULL, *nfound = 0;
    if (w->nwall == 0) return FW_OK;
    FW_TRY(fw_mechanism_sections_take(m, w, &r.s));
    FW_TRY(take_limbs(&r));
    FW_NEED(*found = fw_arena_array(w->arena, fw_mechanism_limb, 2 * (size_t)r.nlimb + 1));
    for (int i = 0; i < 2 * r.nlimb; i++) {
        fw_mechanism_limb *to = &(*found)[*nfound];
        fw_mark mark = fw_arena_mark(w->arena);
        if (r.limb[i / 2].forks) {
            FW_TRY(pull_limb(&r, i / 2, i % 2, true, enough_N_per_m, to));
            r.limb[i / 2].bears_N_per_m = fmin(r.limb[i / 2].bears_N_per_m, to->tension_N_per_m);
        }
        FW_TRY(pull_limb(&r, i / 2, i % 2, false, enough_N_per_m, to));
        fw_arena_rewind(w->arena, mark);
        if (to->tension_N_per_m < enough_N_per_m) (*nfound)++;
    }
    for (int i = 0; i < *nfound; i++)
        add_parents(&r, &(*found)[i]);
    qsort(*found, (size_t)*nfound, sizeof **found, by_tension);
    return FW_OK;
}
