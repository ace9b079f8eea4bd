/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes on the frame of a device's die: marks of the flow's table, and the die's id. The
   drawing of the device does not know the flow, so they are added to a copy of its list of pieces.
 */
#include "layout/content.h"
#include "layout/text.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CLEAR_M = 12e-6, BESIDE_M = 40e-6; /* of edges; of other marks */
static const double STEP_M = 20e-6;
static const double STROKE_M = 5e-6, HIGH_M = 45e-6, LINE_M = 65e-6;

typedef struct sheet {
    fw_arena *arena;
    const fw_layout *device;
    fw_piece *piece;
    int npiece, capacity;
    fw_box *box; /* (nbox) of the first pieces, as far as they were asked for */
    int nbox, box_room;
} sheet;

static bool in_frame(const fw_piece *p) {
    return p->role == FW_ROLE_TEXT || p->role == FW_ROLE_MARK || p->role == FW_ROLE_BACK;
}

static bool apart(fw_box p, fw_box q, double clear) {
    return p.x1 + clear <= q.x0 || q.x1 + clear <= p.x0 || p.y1 + clear <= q.y0 ||
           q.y1 + clear <= p.y0;
}

/* inside one piece of the frame, clear of every outline */
static bool is_free(const sheet *s, const fw_contour *place) {
    fw_box b = fw_contour_box(place);
    fw_vec2 middle = {0.5 * (b.x0 + b.x1), 0.5 * (b.y0 + b.y1)};
    bool inside = false;
    for (int i = 0; i < s->npiece; i++) {
        const fw_piece *p = &s->piece[i];
        if (apart(b, s->box[i], in_frame(p) ? BESIDE_M : CLEAR_M)) continue;
        if (in_frame(p)) return false;
        if (fw_contour_distance_below(place, &p->contour, CLEAR_M, NULL, NULL) < CLEAR_M)
            return false;
        if (!fw_contour_contains(&p->contour, middle)) continue;
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
        s->box[s->nbox] = fw_contour_box(&s->piece[s->nbox].contour);
    return FW_OK;
}

/* lower left corner of a free place in an upright; from the top or from below */
static fw_status find_place(sheet *s, bool right, bool from_top, double width, double height,
                            fw_vec2 *at, bool *found) {
    const fw_layout *d = s->device;
    double lane = HUGE_VAL; /* the frame begins where the lane ends */
    FW_TRY(find_boxes(s));
    for (int i = 0; i < s->npiece; i++)
        if (s->piece[i].role == FW_ROLE_FRAME) lane = fmin(lane, d->die.x1 - s->box[i].x1);
    double x0 = right ? d->window.x1 : d->die.x0 + lane;
    double x1 = right ? d->die.x1 - lane : d->window.x0;
    double x = fw_layout_to_grid(0.5 * (x0 + x1 - width));
    int steps = (int)floor((d->window.y1 - d->window.y0 - height) / STEP_M);
    *found = false;
    for (int i = 0; i <= steps && !*found && x - x0 >= CLEAR_M; i++) {
        double y = from_top ? d->window.y1 - height - i * STEP_M : d->window.y0 + i * STEP_M;
        *at = (fw_vec2){x, fw_layout_to_grid(y)};
        fw_contour place;
        fw_mark mark = fw_arena_mark(s->arena);
        FW_TRY(fw_contour_rectangle(s->arena, (fw_box){at->x, at->y, x + width, at->y + height},
                                    &place));
        *found = is_free(s, &place);
        fw_arena_rewind(s->arena, mark);
    }
    return FW_OK;
}

static fw_status add_mark(sheet *s, const fw_coupon *c, fw_vec2 at) {
    for (int i = 0; i < c->npiece; i++) {
        fw_piece piece = c->piece[i];
        const fw_contour *from = &c->piece[i].contour;
        size_t n = (size_t)from->count;
        FW_NEED(piece.contour.segment = fw_arena_array(s->arena, fw_segment, n));
        for (int k = 0; k < from->count; k++) {
            fw_segment *e = &piece.contour.segment[k];
            *e = from->segment[k];
            e->a = (fw_vec2){fw_layout_to_grid(e->a.x + at.x), fw_layout_to_grid(e->a.y + at.y)};
            e->b = (fw_vec2){fw_layout_to_grid(e->b.x + at.x), fw_layout_to_grid(e->b.y + at.y)};
        }
        FW_TRY(fw_layout_add(s->arena, piece, &s->piece, &s->npiece, &s->capacity));
    }
    return FW_OK;
}

fw_status fw_content_on_frame(fw_arena *arena, const fw_layout *device, const fw_pattern *pattern,
                              int npattern, double width_rule_m, double space_rule_m,
                              const fw_layout **out, int *left_out) {
    int n = 0;
    *out = device;
    *left_out = 0;
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
        fw_coupon c;
        if (!pattern[i].kind->on_frame) continue;
        FW_TRY(fw_pattern_draw(arena, &pattern[i], width_rule_m, space_rule_m, 0, &c));
        for (int k = 0; k < pattern[i].kind->on_frame; k++) {
            fw_vec2 at;
            bool found;
            FW_TRY(find_place(&s, k == 1, true, c.width_m, c.height_m, &at, &found));
            if (found)
                FW_TRY(add_mark(&s, &c, at));
            else
                ++*left_out;
        }
    }
    if (device->fill)
        FW_TRY(fw_content_in_window(arena, device, pattern, npattern, s.piece, s.npiece));
    *l = *device;
    l->piece = s.piece;
    l->npiece = s.npiece;
    *out = l;
    return FW_OK;
}

fw_status fw_content_die_id(fw_arena *arena, const fw_layout *device, const char *id,
                            fw_piece **piece, int *npiece, int *capacity) {
    sheet s = {.arena = arena,
               .device = device,
               .piece = device->piece,
               .npiece = device->npiece,
               .capacity = device->npiece};
    double room = 0;
    for (int i = 0; i < device->npiece; i++)
        if (device->piece[i].role == FW_ROLE_FRAME)
            room = fmax(room, device->window.x0 - fw_contour_box(&device->piece[i].contour).x0);
    room -= 2 * CLEAR_M;
    size_t total = strlen(id), per = total;
    char line[40];
    if (total == 0 || total >= sizeof line) return FW_OK;
    double width = HUGE_VAL;
    for (; per > 0; per--) { /* as many characters as the widest line bears */
        width = 0;
        for (size_t k = 0; k < total; k += per) {
            snprintf(line, sizeof line, "%.*s", (int)per, id + k);
            width = fmax(width, fw_layout_text_width(line, HIGH_M, STROKE_M));
        }
        if (width <= room) break;
    }
    if (per == 0) return FW_OK;
    size_t lines = (total + per - 1) / per;
    fw_vec2 at;
    bool found;
    double height = (double)(lines - 1) * LINE_M + HIGH_M;
    FW_TRY(find_place(&s, false, false, width, height, &at, &found));
    for (size_t k = 0; found && k < lines; k++) {
        snprintf(line, sizeof line, "%.*s", (int)per, id + k * per);
        fw_vec2 origin = {at.x, fw_layout_to_grid(at.y + (double)(lines - 1 - k) * LINE_M)};
        FW_TRY(fw_layout_text(arena, line, origin, HIGH_M, STROKE_M, FW_ROLE_TEXT, "die id", piece,
                              npiece, capacity));
    }
    return FW_OK;
}
