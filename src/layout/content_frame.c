/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes on the frame of a device's die: marks of the flow's table, and the die's id. The
   drawing of the device does not know the flow, so they are added to a copy of its list of pieces.
 */
#include "geometry/segment.h"
#include "layout/pattern.h"
#include "layout/layout.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CLEAR_M = 12e-6, BESIDE_M = 40e-6; /* of edges; of other marks */
static const double STEP_M = 20e-6, NOTHING_M = 1e-12;

typedef struct sheet {
    fw_arena *arena;
    const fw_layout *device;
    fw_layout_piece *piece;
    int npiece, capacity;
    fw_geometry_box *box; /* (nbox) of the first pieces, as far as they were asked for */
    int nbox, box_room;
} sheet;

static bool in_frame(const fw_layout_piece *p) {
    return p->role == FW_ROLE_TEXT || p->role == FW_ROLE_MARK || p->role == FW_ROLE_BACK;
}

static bool apart(fw_geometry_box p, fw_geometry_box q, double clear) {
    return p.x1 + clear <= q.x0 || q.x1 + clear <= p.x0 || p.y1 + clear <= q.y0 ||
           q.y1 + clear <= p.y0;
}

/* inside one piece of the frame, clear of every outline */
static bool is_free(const sheet *s, const fw_geometry_contour *place) {
    fw_geometry_box b = fw_geometry_contour_box(place);
    fw_geometry_vec2 middle = {0.5 * (b.x0 + b.x1), 0.5 * (b.y0 + b.y1)};
    bool inside = false;
    for (int i = 0; i < s->npiece; i++) {
        const fw_layout_piece *p = &s->piece[i];
        if (apart(b, s->box[i], in_frame(p) ? BESIDE_M : CLEAR_M)) continue;
        if (in_frame(p)) return false;
        if (fw_geometry_contour_distance_below(place, &p->contour, CLEAR_M, NULL, NULL) <
            CLEAR_M - NOTHING_M)
            return false;
        if (!fw_geometry_contour_contains(&p->contour, middle)) continue;
        if (p->role != FW_ROLE_FRAME) return false;
        inside = true;
    }
    return inside;
}

/* of all pieces, those added since the last time included */
static fw_status find_boxes(sheet *s) {
    if (s->npiece > s->box_room) {
        int more = s->npiece + 32;
        FW_NEED(s->box =
                    fw_arena_grow(s->arena, s->box, (size_t)s->nbox, (size_t)more, sizeof *s->box));
        s->box_room = more;
    }
    for (; s->nbox < s->npiece; s->nbox++)
        s->box[s->nbox] = fw_geometry_contour_box(&s->piece[s->nbox].contour);
    return FW_OK;
}

/* one bar of the frame, beside the window */
static fw_status find_upright(sheet *s, bool right, fw_geometry_box *upright) {
    const fw_layout *d = s->device;
    double lane = HUGE_VAL; /* the frame begins where the lane ends */
    FW_TRY(find_boxes(s));
    for (int i = 0; i < s->npiece; i++)
        if (s->piece[i].role == FW_ROLE_FRAME) lane = fmin(lane, d->die.x1 - s->box[i].x1);
    *upright = (fw_geometry_box){right ? d->window.x1 : d->die.x0 + lane, d->window.y0,
                                 right ? d->die.x1 - lane : d->window.x0, d->window.y1};
    return FW_OK;
}

/* lower left corner of a free place in an upright, from the top */
static fw_status find_place(sheet *s, const fw_geometry_box *upright, double width, double height,
                            fw_geometry_vec2 *at, bool *found) {
    const fw_layout *d = s->device;
    const double x0 = upright->x0, x1 = upright->x1;
    double x = fw_layout_to_grid(0.5 * (x0 + x1 - width));
    int steps = (int)floor((d->window.y1 - d->window.y0 - height) / STEP_M);
    *found = false;
    for (int i = 0; i <= steps && !*found && x - x0 >= CLEAR_M - NOTHING_M; i++) {
        double y = d->window.y1 - height - i * STEP_M;
        *at = (fw_geometry_vec2){x, fw_layout_to_grid(y)};
        fw_geometry_contour place;
        fw_mark mark = fw_arena_mark(s->arena);
        FW_TRY(fw_geometry_contour_rectangle(
            s->arena, (fw_geometry_box){at->x, at->y, x + width, at->y + height}, &place));
        *found = is_free(s, &place);
        fw_arena_rewind(s->arena, mark);
    }
    return FW_OK;
}

fw_status fw_layout_coupon_put(fw_arena *arena, const fw_layout_coupon *c, fw_geometry_vec2 at,
                               fw_layout_piece **list, int *count, int *capacity) {
    for (int i = 0; i < c->npiece; i++) {
        fw_layout_piece piece = c->piece[i];
        const fw_geometry_contour *from = &c->piece[i].contour;
        size_t n = (size_t)from->count;
        FW_NEED(piece.contour.segment = fw_arena_array(arena, fw_geometry_segment, n));
        for (int k = 0; k < from->count; k++) {
            fw_geometry_segment *e = &piece.contour.segment[k];
            *e = from->segment[k];
            e->a = (fw_geometry_vec2){fw_layout_to_grid(e->a.x + at.x),
                                      fw_layout_to_grid(e->a.y + at.y)};
            e->b = (fw_geometry_vec2){fw_layout_to_grid(e->b.x + at.x),
                                      fw_layout_to_grid(e->b.y + at.y)};
        }
        FW_TRY(fw_layout_add(arena, piece, list, count, capacity));
    }
    return FW_OK;
}

/* Thief and fill in the window of a device's die. Both grow out of straight edges of the frame: the
   edge is replaced by the way around what stands on it, so that frame, thief and fill are one
   outline, no boolean is needed and nothing comes loose. Everything else keeps the keep-out, from
   where it is drawn; what moves farther than that needs a larger one.

   In: the pieces of a drawn device; dimensions of the rows, m. Out: other outlines of the frame's
   pieces. All coordinates are multiples of 1 nm. Cost: cells of the window times pieces whose boxes
   are near. Test: test_content_window.c. */

static const double CELL_M = 20e-6; /* along the thief's edges */
static const double ROOM_M = 20e-6; /* of an edge's ends: corners, stubs and cuts of the frame */

typedef struct edge { /* of the frame, with the window on its right */
    fw_geometry_vec2 a, along, out;
    double length_m;
} edge;

typedef struct window {
    fw_arena *arena;
    const fw_layout *device;
    fw_layout_piece *piece;
    fw_geometry_box *box; /* (npiece) of each, as it is now */
    int npiece;
    double thief_m;         /* depth of the thief; 0: none */
    fw_geometry_vec2 *path; /* (npath) what stands on the edge in hand */
    int npath, room;
} window;

static fw_geometry_vec2 place_on(const edge *e, double t, double depth) {
    fw_geometry_vec2 p = vec_along(vec_along(e->a, t, e->along), depth, e->out);
    return (fw_geometry_vec2){fw_layout_to_grid(p.x), fw_layout_to_grid(p.y)};
}

static fw_geometry_box cell_of(const edge *e, double t0, double t1, double d0, double d1) {
    fw_geometry_vec2 p = place_on(e, t0, d0), q = place_on(e, t1, d1);
    return (fw_geometry_box){fmin(p.x, q.x), fmin(p.y, q.y), fmax(p.x, q.x), fmax(p.y, q.y)};
}

static bool is_frame(const fw_layout_piece *p) {
    return p->role == FW_ROLE_FRAME;
}

/* lettering and marks lie within the frame, or on what is in the way itself */
static bool is_in_the_way(const fw_layout_piece *p) {
    return p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FLEXURE || p->role == FW_ROLE_TETHER;
}

/* in nobody's way: `keep` from the device, `from_frame` from the frame, both outlines apart */
static fw_status is_clear(const window *w, fw_geometry_box box, double keep, double from_frame,
                          bool *clear) {
    fw_geometry_contour place;
    fw_mark mark = fw_arena_mark(w->arena);
    *clear = true;
    FW_TRY(fw_geometry_contour_rectangle(w->arena, box, &place));
    for (int i = 0; i < w->npiece && *clear; i++) {
        const fw_geometry_contour *c = &w->piece[i].contour;
        double far = is_frame(&w->piece[i]) ? from_frame : is_in_the_way(&w->piece[i]) ? keep : 0;
        if (far <= 0 || fw_box_gap(box, w->box[i]) >= far) continue;
        *clear = fw_geometry_contour_distance_below(&place, c, far, NULL, NULL) >= far &&
                 !fw_geometry_contour_contains(c, place.segment[0].a) &&
                 !fw_geometry_contour_contains(&place, c->segment[0].a);
    }
    fw_arena_rewind(w->arena, mark);
    return FW_OK;
}

static fw_status go_to(window *w, fw_geometry_vec2 p) {
    if (w->npath == w->room) {
        int more = w->room ? 2 * w->room : 256;
        FW_NEED(w->path = fw_arena_grow(w->arena, w->path, (size_t)w->npath, (size_t)more,
                                        sizeof *w->path));
        w->room = more;
    }
    w->path[w->npath++] = p;
    return FW_OK;
}

/* ---- the thief: cells along the edge that are clear, runs of them are one rectangle ---- */
static fw_status add_thief(window *w, const edge *e, const fw_layout_pattern *p) {
    double width = fw_layout_to_grid(p->value[0]), keep = p->value[1], run = -1;
    const fw_geometry_box *b = &w->device->window;
    for (double t = ROOM_M; t <= e->length_m - ROOM_M + 1e-12; t += CELL_M) {
        fw_geometry_box cell = cell_of(e, t, t + CELL_M, 1e-6, width);
        bool clear = t + CELL_M <= e->length_m - ROOM_M + 1e-12;
        if (e->out.x == 0) /* the rims of two sides do not meet in a corner */
            clear = clear && cell.x0 >= b->x0 + 2 * width && cell.x1 <= b->x1 - 2 * width;
        else
            clear = clear && cell.y0 >= b->y0 + 2 * width && cell.y1 <= b->y1 - 2 * width;
        if (clear) FW_TRY(is_clear(w, cell, keep, 0, &clear));
        if (clear && run < 0) run = t;
        if (clear || run < 0) continue;
        if (t - run >= 2 * CELL_M - 1e-12) {
            FW_TRY(go_to(w, place_on(e, run, 0)));
            FW_TRY(go_to(w, place_on(e, run, width)));
            FW_TRY(go_to(w, place_on(e, t, width)));
            FW_TRY(go_to(w, place_on(e, t, 0)));
        }
        run = -1;
    }
    return FW_OK;
}

/* ---- the fill: chains of squares on columns that the lower and the upper edge share ---- */
typedef struct chain {
    double square, stem, gap, keep;
    double t; /* along the edge, of the square's middle */
    int count;
} chain;

/* out along one side of it and back along the other */
static fw_status draw_chain(window *w, const edge *e, const chain *c) {
    double s = 0.5 * c->square, n = 0.5 * c->stem;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < c->count; i++) {
            int k = side < 0 ? i : c->count - 1 - i;
            double low = c->gap + k * (c->square + c->gap), high = low + c->square;
            double foot = k > 0 ? low - c->gap : 0;
            const double t[4] = {c->t + side * n, c->t + side * n, c->t + side * s,
                                 c->t + side * s};
            const double d[4] = {foot, low, low, high};
            for (int m = 0; m < 4; m++) {
                int at = side < 0 ? m : 3 - m;
                FW_TRY(go_to(w, place_on(e, t[at], d[at])));
            }
        }
    return FW_OK;
}

/* how many squares stand clear in the column, away from the edge, up to the middle of the window:
   chains from below and from above meet there, so that none hangs farther than it must */
static fw_status count_squares(window *w, const edge *e, chain *c) {
    const fw_geometry_box *b = &w->device->window;
    bool up = e->out.y > 0, clear = true;
    double pitch = c->square + c->gap, s = 0.5 * c->square, middle = 0.5 * (b->y0 + b->y1);
    for (c->count = 0; clear; c->count += clear) {
        double low = c->gap + c->count * pitch;
        fw_geometry_box box = cell_of(e, c->t - s, c->t + s, low, low + c->square);
        clear = up ? box.y1 <= middle - 0.5 * c->gap : box.y0 >= middle + 0.5 * c->gap;
        if (clear) FW_TRY(is_clear(w, box, c->keep, c->gap - 2e-9, &clear));
    }
    return FW_OK;
}

static fw_status add_fill(window *w, const edge *e, const fw_layout_pattern *p) {
    chain c = {.square = 2 * fw_layout_to_grid(0.5 * p->value[0]),
               .stem = 2 * fw_layout_to_grid(0.5 * p->value[1]),
               .keep = p->value[3]};
    const fw_geometry_box *b = &w->device->window;
    if (e->out.y == 0) return FW_OK; /* the uprights have none */
    c.gap = fw_layout_to_grid(fw_layout_fill_gap_m(c.square, c.stem, p->value[2]));
    if (!(c.gap > 0)) return FW_OK;
    double pitch = c.square + c.gap;
    int columns = (int)floor((b->x1 - b->x0 - c.gap) / pitch);
    bool right = e->along.x > 0;
    for (int i = 0; i < columns; i++) {
        int column = right ? i : columns - 1 - i; /* the edge is walked along */
        double x = fw_layout_to_grid(b->x0 + c.gap + 0.5 * c.square + column * pitch);
        c.t = (x - e->a.x) * e->along.x;
        if (c.t - 0.5 * pitch < 0 || c.t + 0.5 * pitch > e->length_m) continue;
        FW_TRY(count_squares(w, e, &c));
        if (c.count > 0) FW_TRY(draw_chain(w, e, &c));
    }
    return FW_OK;
}

/* ---- edges ---- */

/* a straight edge of the window or of the thief: along an axis, the window's inside on its right */
static bool edge_of(const window *w, const fw_geometry_segment *s, edge *e) {
    const fw_geometry_box *b = &w->device->window;
    fw_geometry_vec2 d = vec_sub(s->b, s->a);
    if (s->kind != FW_LINE || s->flags & FW_SEGMENT_JOINT || (d.x != 0 && d.y != 0)) return false;
    *e = (edge){s->a, vec_unit(d), {0, 0}, vec_length(d)};
    e->out = (fw_geometry_vec2){e->along.y, -e->along.x};
    double depth = e->out.y > 0   ? s->a.y - b->y0
                   : e->out.y < 0 ? b->y1 - s->a.y
                   : e->out.x > 0 ? s->a.x - b->x0
                                  : b->x1 - s->a.x;
    return e->length_m > 2 * ROOM_M && (fabs(depth) < 1e-10 || fabs(depth - w->thief_m) < 1e-10);
}

typedef struct growing { /* an outline */
    fw_geometry_contour contour;
    int room;
} growing;

static fw_status append(window *w, growing *g, fw_geometry_segment s) {
    if (s.kind == FW_LINE && vec_same(s.a, s.b)) return FW_OK;
    if (g->contour.count == g->room) {
        int more = g->room ? 2 * g->room : 256;
        FW_NEED(g->contour.segment =
                    fw_arena_grow(w->arena, g->contour.segment, (size_t)g->contour.count,
                                  (size_t)more, sizeof *g->contour.segment));
        g->room = more;
    }
    g->contour.segment[g->contour.count++] = s;
    return FW_OK;
}

typedef fw_status (*add_to)(window *w, const edge *e, const fw_layout_pattern *p);

/* the outline of one piece of the frame with what stands on its edges */
static fw_status grow(window *w, fw_layout_piece *piece, add_to add, const fw_layout_pattern *p) {
    growing out = {{NULL, 0}, 0};
    for (int i = 0; i < piece->contour.count; i++) {
        fw_geometry_segment s = piece->contour.segment[i];
        edge e;
        w->npath = 0;
        if (edge_of(w, &s, &e)) FW_TRY(add(w, &e, p));
        fw_geometry_segment part = s;
        for (int k = 0; k < w->npath; k++) {
            part.b = w->path[k];
            FW_TRY(append(w, &out, part));
            part.a = part.b;
        }
        part.b = s.b;
        FW_TRY(append(w, &out, part));
    }
    piece->contour = out.contour;
    return FW_OK;
}

/* thief and fill (kinds with in_window) on the frame's pieces, whose outlines are made anew; the
   layout's own are left alone */
static fw_status in_window(fw_arena *arena, const fw_layout *device,
                           const fw_layout_pattern *pattern, int npattern, fw_layout_piece *piece,
                           int npiece) {
    window w = {.arena = arena, .device = device, .piece = piece, .npiece = npiece};
    FW_NEED(w.box = fw_arena_array(arena, fw_geometry_box, (size_t)npiece));
    for (int i = 0; i < npiece; i++)
        w.box[i] = fw_geometry_contour_box(&piece[i].contour);
    for (int round = 0; round < 2; round++) /* the fill stands on the thief, whatever their order */
        for (int k = 0; k < npattern; k++) {
            fw_layout_growth growth = pattern[k].kind->in_window;
            bool thief = growth == FW_GROWS_ALONG_EDGES;
            if (growth == FW_GROWS_NOT || thief != (round == 0)) continue;
            for (int i = 0; i < npiece; i++)
                if (is_frame(&piece[i])) {
                    FW_TRY(grow(&w, &piece[i], thief ? add_thief : add_fill, &pattern[k]));
                    w.box[i] = fw_geometry_contour_box(&piece[i].contour);
                }
            if (thief) w.thief_m = fw_layout_to_grid(pattern[k].value[0]);
        }
    return FW_OK;
}

static void take_no_room(const fw_layout_pattern *p, const fw_layout_coupon *c,
                         const fw_geometry_box *upright, fw_layout_no_room *no_room) {
    if (no_room->count++ > 0) return;
    no_room->id = p->id;
    no_room->upright = *upright;
    no_room->width_m = c->width_m;
    no_room->height_m = c->height_m;
    no_room->frame_m = 1e-6 * ceil(1e6 * (c->width_m + 2.0 * CLEAR_M) - 1e-6);
}

fw_status fw_layout_content_on_frame(fw_arena *arena, const fw_layout *device,
                                     const fw_layout_pattern *pattern, int npattern,
                                     double width_rule_m, double space_rule_m,
                                     const fw_layout **out, fw_layout_no_room *no_room) {
    int n = 0;
    *out = device;
    *no_room = (fw_layout_no_room){0};
    for (int i = 0; i < npattern; i++)
        n += pattern[i].kind->on_frame + (device->fill && pattern[i].kind->in_window);
    if (n == 0 || !device->drawn) return FW_OK;
    fw_layout *l = fw_arena_one(arena, fw_layout);
    sheet s = {
        .arena = arena, .device = device, .npiece = device->npiece, .capacity = device->npiece + 8};
    FW_NEED(l);
    FW_NEED(s.piece = fw_arena_grow(arena, device->piece, (size_t)device->npiece,
                                    (size_t)s.capacity, sizeof *s.piece));
    for (int i = 0; i < npattern; i++) {
        fw_layout_coupon c;
        if (!pattern[i].kind->on_frame) continue;
        FW_TRY(fw_layout_pattern_draw(arena, &pattern[i], width_rule_m, space_rule_m, 0, &c));
        for (int k = 0; k < pattern[i].kind->on_frame; k++) {
            fw_geometry_vec2 at;
            fw_geometry_box upright;
            bool found;
            FW_TRY(find_upright(&s, k == 1, &upright));
            FW_TRY(find_place(&s, &upright, c.width_m, c.height_m, &at, &found));
            if (found)
                FW_TRY(fw_layout_coupon_put(arena, &c, at, &s.piece, &s.npiece, &s.capacity));
            else if (pattern[i].kind->aligns)
                take_no_room(&pattern[i], &c, &upright, no_room);
            no_room->of += pattern[i].kind->aligns;
        }
    }
    if (device->fill) FW_TRY(in_window(arena, device, pattern, npattern, s.piece, s.npiece));
    *l = *device;
    l->piece = s.piece;
    l->npiece = s.npiece;
    *out = l;
    return FW_OK;
}
