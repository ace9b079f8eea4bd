/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What kinds of patterns draw with: shapes on the bar, and what is measured of them. */
#include "layout/pattern.h"
#include "layout/layout.h"
#include <math.h>

const char FW_PEN_SIZE[] = "size";

double fw_layout_pen_value(const fw_layout_pen *pen, int parameter) {
    return pen->pattern->value[parameter];
}

/* ---- shapes ---- */

fw_status fw_layout_pen_box(fw_layout_pen *pen, double x0, double y0, double x1, double y1) {
    if (!(x1 > x0 && y1 > y0)) return FW_GEOMETRY;
    if (pen->nbox == pen->box_room) {
        int room = pen->box_room ? 2 * pen->box_room : 16;
        FW_NEED(pen->box = fw_arena_grow(pen->arena, pen->box, (size_t)pen->nbox, (size_t)room,
                                         sizeof *pen->box));
        pen->box_room = room;
    }
    fw_geometry_box box = {fw_layout_to_grid(x0), fw_layout_to_grid(y0), fw_layout_to_grid(x1),
                           fw_layout_to_grid(y1)};
    return fw_geometry_contour_rectangle(pen->arena, box, &pen->box[pen->nbox++]);
}

static fw_geometry_vec2 snapped(fw_geometry_vec2 p) {
    return (fw_geometry_vec2){fw_layout_to_grid(p.x), fw_layout_to_grid(p.y)};
}

static bool same(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x == q.x && p.y == q.y;
}

/* is q on the way straight from p to r? Axis-parallel edges only */
static bool needless(fw_geometry_vec2 p, fw_geometry_vec2 q, fw_geometry_vec2 r) {
    return same(p, q) || (p.x == q.x && q.x == r.x) || (p.y == q.y && q.y == r.y);
}

static fw_status add_piece(fw_layout_pen *pen, fw_layout_role role, const char *label,
                           const fw_geometry_contour *contour) {
    fw_layout_coupon *c = pen->coupon;
    fw_geometry_box b = fw_geometry_contour_box(contour);
    const bool below = role == FW_ROLE_CAVITY; /* another plate, under the bar, too */
    if (b.x0 < -1e-12 || (b.y0 < -1e-12 && !below)) return FW_GEOMETRY;
    c->width_m = fmax(c->width_m, b.x1);
    c->height_m = fmax(c->height_m, b.y1);
    const bool mark = below || role == FW_ROLE_MARK || role == FW_ROLE_BACK ||
                      role == FW_ROLE_TEXT || role == FW_ROLE_METAL;
    fw_layout_piece piece = {role, mark ? FW_NONE - 1 : FW_GROUND, FW_NONE, label, *contour};
    return fw_layout_add(pen->arena, piece, &c->piece, &c->npiece, &c->piece_room);
}

/* edges on the bar become feet; marks have none */
static void set_feet(fw_geometry_contour *c, fw_layout_role role) {
    if (role != FW_ROLE_STRUCTURE) return;
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].kind == FW_LINE && c->segment[i].a.y == 0 && c->segment[i].b.y == 0)
            c->segment[i].flags |= FW_SEGMENT_JOINT;
}

static fw_status tidy(fw_layout_pen *pen, const fw_geometry_contour *raw,
                      fw_geometry_contour *out) {
    fw_geometry_vec2 *p = fw_arena_array(pen->arena, fw_geometry_vec2, (size_t)raw->count);
    FW_NEED(p);
    int n = 0;
    for (int i = 0; i < raw->count; i++) {
        fw_geometry_vec2 at = snapped(raw->segment[i].a);
        fw_geometry_vec2 next = snapped(raw->segment[i].b);
        fw_geometry_vec2 last = n ? p[n - 1] : snapped(raw->segment[raw->count - 1].a);
        if (!needless(last, at, next)) p[n++] = at;
    }
    if (n < 4) return FW_GEOMETRY;
    fw_geometry_outline o = fw_geometry_outline_start(pen->arena, p[0]);
    for (int i = 1; i < n; i++)
        fw_geometry_outline_line(&o, p[i], 0);
    return fw_geometry_outline_close(&o, out);
}

/* such as teeth: they are one region as they stand */
static bool clear_of(const fw_geometry_box *box, int n, fw_geometry_box b) {
    const double apart = 1e-9;
    for (int i = 0; i < n; i++)
        if (box[i].x1 + apart > b.x0 && b.x1 + apart > box[i].x0 && box[i].y1 + apart > b.y0 &&
            b.y1 + apart > box[i].y0)
            return false;
    return true;
}

fw_status fw_layout_pen_shape(fw_layout_pen *pen, fw_layout_role role, const char *label) {
    if (pen->nbox == 0) return FW_GEOMETRY;
    fw_geometry_region all = {&pen->box[0], 1};
    fw_geometry_box *box = fw_arena_array(pen->arena, fw_geometry_box, (size_t)pen->nbox);
    FW_NEED(box);
    for (int i = 0; i < pen->nbox; i++)
        box[i] = fw_geometry_contour_box(&pen->box[i]);
    for (int i = 1; i < pen->nbox;) {
        int n = 1;
        while (i + n < pen->nbox && clear_of(&box[i], n, box[i + n]))
            n++;
        fw_geometry_region more = {&pen->box[i], n}, sum;
        FW_TRY(fw_geometry_region_boolean(pen->arena, &all, &more, FW_UNION, &sum));
        all = sum;
        i += n;
    }
    pen->nbox = 0;
    if (all.count != 1) return FW_GEOMETRY;
    fw_geometry_contour c;
    FW_TRY(tidy(pen, &all.contour[0], &c));
    set_feet(&c, role);
    return add_piece(pen, role, label, &c);
}

fw_status fw_layout_pen_bar(fw_layout_pen *pen, fw_layout_role role, const char *label, double x0,
                            double y0, double x1, double y1) {
    FW_TRY(fw_layout_pen_box(pen, x0, y0, x1, y1));
    return fw_layout_pen_shape(pen, role, label);
}

fw_status fw_layout_pen_outline(fw_layout_pen *pen, fw_layout_role role, const char *label,
                                fw_geometry_outline *outline) {
    fw_geometry_contour c;
    FW_TRY(fw_geometry_outline_close(outline, &c));
    set_feet(&c, role);
    return add_piece(pen, role, label, &c);
}

/* ---- what is measured ---- */

fw_status fw_layout_pen_feature(fw_layout_pen *pen, const char *name, double drawn_m,
                                fw_geometry_vec2 from, fw_geometry_vec2 to, const char *label) {
    fw_layout_coupon *c = pen->coupon;
    if (c->nfeature == c->feature_room) {
        int room = c->feature_room ? 2 * c->feature_room : 16;
        FW_NEED(c->feature = fw_arena_grow(pen->arena, c->feature, (size_t)c->nfeature,
                                           (size_t)room, sizeof *c->feature));
        c->feature_room = room;
    }
    if (label == FW_PEN_SIZE) {
        char number[32];
        FW_NEED(label = fw_arena_strdup(pen->arena,
                                        fw_number_text(number, sizeof number, drawn_m * 1e6, 6)));
    }
    c->feature[c->nfeature++] =
        (fw_layout_feature){name, drawn_m, snapped(from), snapped(to), label};
    return FW_OK;
}

fw_status fw_layout_pen_chord(fw_layout_pen *pen, const char *name, double x0, double y0, double x1,
                              double y1, const char *label) {
    return fw_layout_pen_feature(pen, name, hypot(x1 - x0, y1 - y0), (fw_geometry_vec2){x0, y0},
                                 (fw_geometry_vec2){x1, y1}, label);
}

void fw_layout_pen_figure(fw_layout_pen *pen, const char *name, double value, const char *unit) {
    fw_layout_coupon *c = pen->coupon;
    if (c->nfigure < FW_FIGURES)
        c->figure[c->nfigure++] = (fw_layout_pattern_figure){name, unit, value};
}
