/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/films.h"
#include "base/sort.h"
#include "process/pack.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Heights that nobody stated are drawn as this part of the device layer; what is thicker than so
   many device layers, and nothing is made of it, is drawn as thick as half of one. */
static const double UNKNOWN_PART = 0.12, THICK = 3.0, SHORTENED_PART = 0.4;
static const double TOUCH_M = 1e-12; /* heights nearer than that are one */
static const fw_process_side STRUCTURE = {0, false}, FIELD = {0, true};

typedef struct maker {
    fw_arena *arena;
    const fw_process_flow *flow;
    fw_process_films *films;
    double device_m; /* thickness of the device layer */
    int note_room, columns;
} maker;

static double known(const fw_quantity *q) {
    return q && !q->unknown ? q->value : (double)NAN;
}

static fw_status note(maker *m, const char *sentence) {
    FW_NEED(sentence);
    fw_process_films *f = m->films;
    for (int i = 0; i < f->nnote; i++)
        if (fw_text_same(f->note[i], sentence)) return FW_OK;
    if (f->nnote == m->note_room) {
        int more = m->note_room ? 2 * m->note_room : 4;
        FW_NEED(f->note = fw_arena_grow(m->arena, f->note, (size_t)f->nnote, (size_t)more,
                                        sizeof *f->note));
        m->note_room = more;
    }
    f->note[f->nnote++] = sentence;
    return FW_OK;
}

static fw_status add_film(maker *m, fw_process_film film) {
    fw_process_films *f = m->films;
    if (f->n == f->capacity) {
        int more = f->capacity ? 2 * f->capacity : 16;
        FW_NEED(f->film =
                    fw_arena_grow(m->arena, f->film, (size_t)f->n, (size_t)more, sizeof film));
        f->capacity = more;
    }
    f->film[f->n++] = film;
    return FW_OK;
}

static fw_process_side other(fw_process_side side) {
    side.set = !side.set;
    return side;
}

static bool in_side(const maker *m, const fw_process_film *f, fw_process_side side) {
    for (int c = 0; c < m->columns; c++)
        if (f->in[c] && fw_process_side_holds(m->flow, side, c)) return true;
    return false;
}

static bool only_in(const maker *m, const fw_process_film *f, fw_process_side side) {
    return in_side(m, f, side) && !in_side(m, f, other(side));
}

/* does it end where the plate has its edges? */
static bool is_parted(const maker *m, const fw_process_film *f, int plate) {
    fw_process_side side = {plate, false};
    return in_side(m, f, side) != in_side(m, f, other(side));
}

/* its wall at the edges of a plate */
static double *foot_of(fw_process_film *f, int plate) {
    return plate ? &f->further[plate - 1].foot_m : &f->foot_m;
}

static double *head_of(fw_process_film *f, int plate) {
    return plate ? &f->further[plate - 1].head_m : &f->head_m;
}

static void set_walls(fw_process_film *f, int plate, double foot_m, double head_m) {
    *foot_of(f, plate) = foot_m;
    *head_of(f, plate) = head_m;
}

/* what narrow openings have left of a film that is gone from wide ones */
static bool is_floor(const maker *m, const fw_process_film *f) {
    return f->cut && !in_side(m, f, STRUCTURE);
}

static double top_of(const maker *m, int column) {
    const fw_process_films *f = m->films;
    double top = 0.0;
    for (int i = 0; i < f->n; i++)
        if (f->film[i].in[column] && !is_floor(m, &f->film[i])) top = fmax(top, f->film[i].top_m);
    return top;
}

static double bottom_of(const maker *m, int column) {
    double low = (double)INFINITY;
    for (int i = 0; i < m->films->n; i++)
        if (m->films->film[i].in[column]) low = fmin(low, m->films->film[i].bottom_m);
    return low;
}

static double floor_of(const fw_process_films *f) {
    double low = 0.0;
    for (int i = 0; i < f->n; i++)
        low = fmin(low, f->film[i].bottom_m);
    return low;
}

/* ---- walls ---- */

static double wall_at(const fw_process_film *f, int plate, double z_m) {
    double foot = plate ? f->further[plate - 1].foot_m : f->foot_m,
           head = plate ? f->further[plate - 1].head_m : f->head_m, h = f->top_m - f->bottom_m;
    return h > 0.0 ? foot + (head - foot) * (z_m - f->bottom_m) / h : foot;
}

/* where printing leaves the edge of a plate */
static double edge_of_plate(const maker *m, int plate) {
    const fw_quantity *shrink = plate ? m->flow->plate[plate - 1].shrink : NULL;
    if (!plate) return fw_process_fixed_point_printed_m(&m->flow->edges);
    return shrink && !shrink->unknown ? -shrink->value : 0.0;
}

/* the film on one side of a plate alone that lies next above z (from z on), or below it; NULL */
static const fw_process_film *mask_beyond(const maker *m, fw_process_side side, bool back,
                                          double z_m) {
    const fw_process_films *f = m->films;
    const fw_process_film *best = NULL;
    for (int i = 0; i < f->n; i++) {
        const fw_process_film *c = &f->film[i];
        if (only_in(m, c, side) && fw_process_columns_edge(m->flow, c->in, side.plate) &&
            (back ? c->top_m <= z_m + TOUCH_M && (!best || c->top_m > best->top_m)
                  : c->bottom_m >= z_m - TOUCH_M && (!best || c->bottom_m < best->bottom_m)))
            best = c;
    }
    return best;
}

/* edge of what covers a side above a film, or below it, that is of the mask of whatever is done beside it */
static double mask_edge(const maker *m, const fw_process_film *film, fw_process_side side,
                        bool back) {
    const fw_process_film *mask = mask_beyond(m, side, back, back ? film->bottom_m : film->top_m);
    return mask ? wall_at(mask, side.plate, back ? mask->top_m : mask->bottom_m)
                : edge_of_plate(m, side.plate);
}

/* is something of its material on the face that a change works on? Then on that face alone: fw_process_stack_works_on */
static bool has_own(const maker *m, const fw_process_change *c) {
    bool own = false;
    for (int i = 0; i < m->films->n; i++)
        own = own || (m->films->film[i].back == c->back &&
                      fw_text_same(m->films->film[i].material, c->material));
    return own;
}

static bool works_on(const fw_process_change *c, bool own, const fw_process_film *film) {
    return fw_text_same(film->material, c->material) && (film->back == c->back || !own);
}

/* a film on both sides becomes one on each; *at is the one on `side` */
static fw_status split(maker *m, int i, fw_process_side side, double edge_m, int *at) {
    fw_process_film twin = m->films->film[i];
    *at = i;
    if (!in_side(m, &twin, other(side))) return FW_OK;
    fw_process_film *f = &m->films->film[i];
    for (int c = 0; c < m->columns; c++)
        *(fw_process_side_holds(m->flow, side, c) ? &twin.in[c] : &f->in[c]) = false;
    set_walls(&twin, side.plate, edge_m, edge_m);
    set_walls(f, side.plate, edge_m, edge_m);
    return add_film(m, twin);
}

static void set_wall(const maker *m, int plate, const fw_process_film *like, double foot_m,
                     double head_m) {
    fw_process_films *f = m->films;
    for (int i = 0; i < f->n; i++) {
        fw_process_film *c = &f->film[i];
        if (fw_text_same(c->material, like->material) && is_parted(m, c, plate) &&
            fabs(c->bottom_m - like->bottom_m) <= TOUCH_M)
            set_walls(c, plate, foot_m, head_m);
    }
}

/* ---- what is added ---- */

static fw_status drawn_height(maker *m, const fw_process_change *c, double *height_m,
                              bool *shortened) {
    double t = known(c->thickness);
    *shortened = false;
    *height_m = t;
    if (isnan(t) || !(t > 0.0)) {
        *height_m = UNKNOWN_PART * m->device_m;
        return note(m, fw_arena_printf(m->arena, "The thickness of %s is not known",
                                       fw_process_flow_material_name(m->flow, c->material)));
    }
    double depth;
    if (t > THICK * m->device_m && fw_process_change_is_background(m->flow, c, &depth)) {
        *shortened = true;
        *height_m = SHORTENED_PART * m->device_m + depth;
    }
    return FW_OK;
}

/* the wall at z between a film that grows on a side and what stands beside it at `beside_m` */
static double wall_beside(const maker *m, fw_process_side side, double beside_m, double z_m) {
    double best = edge_of_plate(m, side.plate), near = (double)INFINITY;
    for (int i = 0; i < m->films->n; i++) {
        const fw_process_film *f = &m->films->film[i];
        if (!is_parted(m, f, side.plate)) continue;
        bool beside =
            in_side(m, f, other(side)) && f->bottom_m <= beside_m + TOUCH_M && f->top_m > beside_m;
        double far = beside ? -1.0 : fabs(f->top_m - beside_m);
        if (far >= near) continue;
        near = far;
        best = wall_at(f, side.plate, beside ? z_m : f->top_m);
    }
    return best;
}

/* walls of a new film at the edges of every plate at which it ends */
static void stand_beside(const maker *m, fw_process_film *f) {
    for (int plate = 0; plate <= m->flow->nplate; plate++) {
        fw_process_side side = {plate, in_side(m, f, (fw_process_side){plate, true})};
        if (is_parted(m, f, plate))
            set_walls(f, plate, wall_beside(m, side, f->bottom_m, f->bottom_m),
                      wall_beside(m, side, f->top_m - TOUCH_M, f->top_m));
    }
}

/* one film for all columns of one height; what spans lies on the highest of all */
static fw_status add_front(maker *m, const fw_process_change *c, fw_process_film film,
                           double height_m) {
    double top[FW_STACK_MOST], ground = 0.0;
    bool left[FW_STACK_MOST];
    for (int k = 0; k < m->columns; k++) {
        top[k] = top_of(m, k);
        ground = fmax(ground, top[k]);
        left[k] = fw_process_where_holds(m->flow, c->where, k);
    }
    for (int column = 0; column < m->columns; column++) {
        if (!left[column]) continue;
        fw_process_film f = film;
        f.bottom_m = c->spans ? ground : top[column];
        f.top_m = f.bottom_m + height_m;
        for (int k = column; k < m->columns; k++)
            if (left[k] && (c->spans || fabs(top[k] - top[column]) <= TOUCH_M)) {
                f.in[k] = true;
                left[k] = false;
            }
        stand_beside(m, &f);
        FW_TRY(add_film(m, f));
    }
    return FW_OK;
}

static fw_status add(maker *m, const fw_process_change *c) {
    fw_process_film film = {
        .material = c->material, .thickness_m = known(c->thickness), .back = c->back};
    double height;
    FW_TRY(drawn_height(m, c, &height, &film.shortened));
    if (!c->back) return add_front(m, c, film, height);
    film.top_m = floor_of(m->films);
    film.bottom_m = film.top_m - height;
    for (int k = 0; k < m->columns; k++)
        film.in[k] = fw_process_where_holds(m->flow, c->where, k);
    film.foot_m = film.head_m = fw_process_fixed_point_printed_m(&m->flow->edges);
    return add_film(m, film);
}

/* ---- what is changed ---- */

/* the side that a change names; false: all of the wafer */
static bool side_of(const maker *m, const fw_process_change *c, fw_process_side *side) {
    *side = STRUCTURE;
    return !fw_text_same(c->where, "all") && fw_process_where_side(m->flow, c->where, side);
}

/* a latent image: what of the film lies on one side becomes exposed */
static fw_status expose(maker *m, const fw_process_change *c) {
    fw_process_side side;
    bool part = side_of(m, c, &side), own = has_own(m, c);
    double slope = side.plate ? 0.0 : fw_process_fixed_point_slope(&m->flow->edges, m->device_m),
           foot =
               edge_of_plate(m, side.plate) + (slope != 0.0 ? 0.5 * m->flow->edges.flare_m : 0.0);
    double base = (double)INFINITY;
    for (int i = 0; i < m->films->n; i++)
        if (works_on(c, own, &m->films->film[i])) base = fmin(base, m->films->film[i].bottom_m);
    for (int i = 0, n = m->films->n; i < n; i++) {
        int at = i;
        if (!works_on(c, own, &m->films->film[i]) ||
            (part && !in_side(m, &m->films->film[i], side)))
            continue;
        if (part) FW_TRY(split(m, i, side, foot, &at));
        fw_process_film *f = &m->films->film[at];
        f->exposed = true;
        set_wall(m, side.plate, f, foot + slope * (f->bottom_m - base),
                 foot + slope * (f->top_m - base));
    }
    return FW_OK;
}

/* topmost film of a material in a column; -1: there is none */
static int topmost(const maker *m, int column, const char *material) {
    int at = -1;
    for (int i = 0; i < m->films->n; i++)
        if (m->films->film[i].in[column] && fw_text_same(m->films->film[i].material, material) &&
            (at < 0 || m->films->film[i].top_m > m->films->film[at].top_m))
            at = i;
    return at;
}

/* the upper part of the topmost film of `from` becomes `material` */
static fw_status convert(maker *m, const fw_process_change *c) {
    double height, t = known(c->thickness);
    bool shortened, done[FW_STACK_MOST] = {false};
    fw_process_side side;
    bool part = side_of(m, c, &side);
    for (int column = 0; column < m->columns; column++) {
        int at = topmost(m, column, c->from);
        if (at < 0 || done[column] || !fw_process_where_holds(m->flow, c->where, column)) continue;
        FW_TRY(drawn_height(m, c, &height, &shortened));
        if (part)
            FW_TRY(split(m, at, side, mask_edge(m, &m->films->film[at], other(side), false), &at));
        fw_process_film *f = &m->films->film[at], fabricated = *f;
        height = fmin(height, 0.6 * (f->top_m - f->bottom_m));
        fabricated.material = c->material;
        fabricated.thickness_m = t;
        fabricated.shortened = false;
        fabricated.bottom_m = f->top_m = f->top_m - height;
        for (int plate = 0; plate <= m->flow->nplate; plate++)
            *foot_of(&fabricated, plate) = *head_of(f, plate) =
                wall_at(f, plate, fabricated.bottom_m);
        if (!isnan(t)) f->thickness_m -= t;
        for (int k = 0; k < m->columns; k++)
            done[k] = done[k] || fabricated.in[k];
        FW_TRY(add_film(m, fabricated));
    }
    return FW_OK;
}

/* ---- what is removed ---- */

static void drop(fw_process_films *f, int i) {
    memmove(f->film + i, f->film + i + 1, (size_t)(f->n - i - 1) * sizeof *f->film);
    f->n--;
}

/* Walls after a cut: top (1 - A) E, foot (1 - A) (E - D - lag of the open field) behind the edge of
   the mask, that of a cut through another layer than the device's with its foot alone, as in
   fw_process_fixed_point_edge; an unknown A counts as 1. */
static fw_status cut_walls(maker *m, const fw_process_change *c, const fw_process_cut *cut,
                           double edge_m, double way, fw_process_film *f) {
    const fw_process_fixed_point *p = &m->flow->edges;
    double field = p->ncls ? p->cls[p->field].opening_m : (double)INFINITY;
    double loss = isnan(cut->anisotropy) ? 0.0 : 1.0 - cut->anisotropy;
    double foot = fw_process_cut_foot(cut, field), flare = cut->device ? 0.5 * p->flare_m : 0.0;
    f->mask_edge_m = edge_m;
    f->cut = cut;
    f->foot_m = edge_m - way * (loss > 0.0 ? loss * foot : 0.0) + flare;
    f->head_m =
        edge_m - way * (loss > 0.0 ? loss * (cut->device ? cut->least_m : foot) : 0.0) - flare;
    if (!isnan(cut->anisotropy) && !isnan(cut->etched_m)) return FW_OK;
    const char *id = c->anisotropy->id ? c->anisotropy->id : "anisotropy",
               *what = isnan(cut->anisotropy) ? id : "lag";
    return note(
        m, fw_arena_printf(
               m->arena, "What step %s takes sideways is not known (%s): its walls are drawn %s",
               cut->step->id, what, isnan(cut->anisotropy) ? "straight" : "for the least of it"));
}

/* one film, of which a side is etched beside a mask on the other; bowl: its foot stays at the mask's edge */
static fw_status etch_beside(maker *m, const fw_process_step *s, const fw_process_change *c, int i,
                             fw_process_side side, bool bowl) {
    double edge = mask_edge(m, &m->films->film[i], other(side), c->back);
    bool field = side.plate == 0 && side.set;
    double way =
        field || (side.plate && !side.set) ? 1.0 : -1.0; /* what is drawn shrinks, or grows */
    const fw_process_cut *cut = fw_process_fixed_point_cut(&m->flow->edges, c->anisotropy);
    int at;
    FW_TRY(split(m, i, side, edge, &at));
    fw_process_film gone = m->films->film[at], walls = gone;
    double foot = edge, head = edge, t = known(c->thickness);
    if (c->isotropic && !isnan(t) && !bowl) foot = head = edge - way * t * (1.0 + s->overrun);
    if (bowl) head = edge - way * t;
    if (!cut && c->anisotropy && !isnan(t) && !c->anisotropy->unknown) { /* of another plate */
        double loss = way * (1.0 - c->anisotropy->value), all = t * (1.0 + s->overrun);
        *(c->back ? &foot : &head) = edge - loss * all;
        *(c->back ? &head : &foot) = edge - loss * (all - t);
    }
    if (cut) {
        walls.foot_m = walls.head_m = edge;
        FW_TRY(cut_walls(m, c, cut, edge, way, &walls));
        foot = walls.foot_m, head = walls.head_m;
    }
    set_wall(m, side.plate, &gone, foot, head);
    for (int k = 0; cut && k < m->films->n; k++) { /* what stays beside it has a foot of its own */
        fw_process_film *f = &m->films->film[k];
        if (only_in(m, f, other(side)) && fw_text_same(f->material, gone.material) &&
            fabs(f->bottom_m - gone.bottom_m) <= TOUCH_M) {
            f->cut = cut;
            f->mask_edge_m = edge;
        }
    }
    bool floors = cut && cut->lag != FW_LAG_NONE && !isnan(cut->lag_value) && field;
    if (!floors) {
        drop(m->films, at);
        return FW_OK;
    }
    m->films->film[at].cut = cut; /* stays as what narrow openings have left */
    m->films->film[at].mask_edge_m = edge;
    if (!fw_process_lag_is_guess(cut->lag_quantity)) return FW_OK;
    return note(
        m, fw_arena_printf(m->arena, "The lag of narrow openings in step %s is assumed (%s)",
                           cut->step->id, cut->lag_quantity->id ? cut->lag_quantity->id : "lag"));
}

/* an isotropic etch of a depth that leaves the rest of the film: its upper part becomes a film of its own, which is
   etched through. Its wall is a quarter of a circle about the mask's edge, drawn as its chord. */
static fw_status hollow_out(maker *m, const fw_process_step *s, const fw_process_change *c, int i,
                            fw_process_side side) {
    fw_process_film upper = m->films->film[i];
    double t = known(c->thickness);
    fw_process_film *f = &m->films->film[i];
    f->top_m -= t;
    f->thickness_m -= t;
    upper.bottom_m = f->top_m;
    upper.thickness_m = t;
    upper.shortened = false;
    FW_TRY(add_film(m, upper));
    return etch_beside(m, s, c, m->films->n - 1, side, side.plate > 0);
}

/* an etch that runs sideways from every opening: out of the field, and from below the structure */
static fw_status undercut(maker *m, const fw_process_step *s, const fw_process_change *c) {
    double reach = known(c->reach);
    for (int i = m->films->n - 1; i >= 0; i--) {
        fw_process_film *f = &m->films->film[i];
        if (!fw_text_same(f->material, c->material)) continue;
        if (isnan(reach) || !in_side(m, f, STRUCTURE)) {
            drop(m->films, i);
            continue;
        }
        if (in_side(m, f, FIELD)) {
            f->foot_m = f->head_m = mask_edge(m, f, STRUCTURE, false);
            for (int k = 0; k < m->columns; k++)
                if (fw_process_side_holds(m->flow, FIELD, k)) f->in[k] = false;
        }
        f->reach_m = fmax(f->reach_m, reach * (1.0 + s->overrun));
    }
    if (!isnan(reach)) return FW_OK;
    return note(m, fw_arena_printf(m->arena,
                                   "How far step %s reaches sideways is not known: drawn as if it "
                                   "reached everywhere",
                                   s->id));
}

/* a stated depth that is less than the film's thickness */
static bool is_shallow(const fw_process_change *c, const fw_process_film *f) {
    double t = known(c->thickness);
    return !c->anisotropy && !c->isotropic && t > 0.0 && t < 0.98 * f->thickness_m && !f->shortened;
}

static void thin(const fw_process_change *c, fw_process_film *f) {
    double t = known(c->thickness), left = f->thickness_m - t;
    if (c->back)
        f->bottom_m += t;
    else {
        f->head_m = wall_at(f, 0, f->top_m - t);
        f->top_m -= t;
    }
    f->thickness_m = left;
}

static fw_status take_away(maker *m, const fw_process_step *s, const fw_process_change *c) {
    fw_process_side side;
    bool whole = !side_of(m, c, &side), etch = c->isotropic || c->anisotropy, own = has_own(m, c);
    if (c->reach) return undercut(m, s, c);
    for (int i = m->films->n - 1; i >= 0; i--) { /* what is split off comes behind */
        fw_process_film *f = &m->films->film[i];
        if (!works_on(c, own, f) || (!whole && !in_side(m, f, side))) continue;
        if (is_shallow(c, f)) {
            int at = i;
            if (!whole) FW_TRY(split(m, i, side, mask_edge(m, f, other(side), c->back), &at));
            thin(c, &m->films->film[at]);
        } else if (!whole && c->isotropic && known(c->thickness) < 0.5 * f->thickness_m) {
            FW_TRY(hollow_out(m, s, c, i, side));
        } else if (!whole && (etch || in_side(m, f, other(side)))) {
            FW_TRY(etch_beside(m, s, c, i, side, false));
        } else {
            drop(m->films, i);
        }
    }
    return FW_OK;
}

/* the part of film i that lies open on top becomes a film of its own where the other part is covered, or, where nothing
   known is taken of it and other plates may lean its walls, stays one with it; -1: none is open, or no plate parts one from the other */
static fw_status open_part(maker *m, int i, bool back, const double top[], bool taken, int *open) {
    const fw_process_film *f = &m->films->film[i];
    bool up[FW_STACK_MOST], any = false, all = true;
    for (int k = 0; k < m->columns; k++) {
        up[k] = f->in[k] && fabs((back ? f->bottom_m : f->top_m) - top[k]) <= TOUCH_M;
        any = any || up[k];
        all = all && (up[k] || !f->in[k]);
    }
    *open = any ? i : -1;
    if (!any || all || !taken) return FW_OK;
    for (int half = 0; half < 2 * (m->flow->nplate + 1); half++) {
        fw_process_side side = {half / 2, half % 2 == 1};
        bool fits = true;
        for (int k = 0; k < m->columns; k++)
            fits = fits && (!f->in[k] || up[k] == fw_process_side_holds(m->flow, side, k));
        if (fits) return split(m, i, side, mask_edge(m, f, other(side), back), open);
    }
    *open = -1;
    return FW_OK;
}

/* what the step's chemical takes of films that lie open on top (fw_process_exposed_loss), and of
   the device's walls where it is a liquid (films.h) */
static fw_status wear(maker *m, const fw_process_step *s, const fw_process_exposed *x, bool back) {
    double most, loss = fw_process_exposed_loss(s, x, &most);
    double top[FW_STACK_MOST];
    for (int k = 0; k < m->columns; k++)
        top[k] = back ? bottom_of(m, k) : top_of(m, k);
    bool open = false, walls = fw_process_step_is_wet(s) && x->rate && m->flow->material &&
                               fw_text_same(x->material, m->flow->material);
    for (int i = m->films->n - 1; i >= 0; i--) {
        const fw_process_film *whole = &m->films->film[i];
        int at = -1;
        if (fw_text_same(whole->material, x->material) && !whole->shortened &&
            !isnan(whole->thickness_m))
            FW_TRY(open_part(m, i, back, top, !isnan(loss) || m->flow->nplate == 0, &at));
        if (at < 0) continue;
        open = true;
        if (isnan(loss)) continue;
        fw_process_film *f = &m->films->film[at];
        if (loss >= f->thickness_m) {
            drop(m->films, at);
            continue;
        }
        f->thickness_m -= loss;
        if (back) {
            f->bottom_m += loss;
            continue;
        }
        f->head_m = wall_at(f, 0, f->top_m - loss);
        f->top_m -= loss;
        if (!walls || in_side(m, f, FIELD)) continue;
        f->foot_m -= loss;
        f->head_m -= loss;
    }
    if (!open || !isnan(loss)) return FW_OK;
    return note(m, fw_arena_printf(m->arena, "How much %s step %s takes is not known",
                                   fw_process_flow_material_name(m->flow, x->material), s->id));
}

/* ---- all steps ---- */

static fw_status apply(maker *m, const fw_process_step *s, const fw_process_change *c) {
    if (fw_text_same(c->kind, "add")) return add(m, c);
    if (fw_text_same(c->kind, "remove")) return take_away(m, s, c);
    if (fw_text_same(c->kind, "pattern")) return expose(m, c);
    return convert(m, c);
}

static int by_height(const void *left, const void *right) {
    const fw_process_film *p = left, *q = right;
    int order = fw_order_doubles(p->bottom_m, q->bottom_m);
    return order ? order : fw_order_wholes(q->in[FW_STACK_STRUCTURE], p->in[FW_STACK_STRUCTURE]);
}

/* Every change of every step up to `index`, in order. Heights add up from the first film, the back
   of the wafer downward. Cost O(steps x films). Source of walls and depths:
   process/fixed_point.c. Test: test_films.c: the three packs step by step, walls against
   fw_process_fixed_point_edge, depths against t(w). */
fw_status fw_process_flow_films(fw_arena *arena, const fw_process_flow *flow, int index,
                                fw_process_films *films) {
    double device = known(flow->thickness);
    maker m = {arena, flow, films, device > 0.0 ? device : 10e-6, 0, fw_process_flow_columns(flow)};
    *films = (fw_process_films){0};
    for (int i = 0; i < flow->nstep && i <= index; i++) {
        const fw_process_step *s = &flow->step[i];
        films->changed = fw_process_step_changes(s);
        for (int k = 0; k < s->nchange; k++)
            FW_TRY(apply(&m, s, &s->change[k]));
        for (int k = 0; k < s->nexposed; k++)
            for (int back = 0; back < 2; back++)
                if (fw_process_step_meets(s, back)) FW_TRY(wear(&m, s, &s->exposed[k], back));
    }
    if (films->n > 1) qsort(films->film, (size_t)films->n, sizeof *films->film, by_height);
    return FW_OK;
}
