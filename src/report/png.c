/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preview picture by cairo. No text: cairo's text engine neither survives a lack of memory nor
   gives the same picture on two machines. Never geometry of record: cairo keeps 1/256 of a
   pixel. */
#include "report/report_page.h"
#include "base/constants.h"
#include <errno.h>
#include <cairo.h>
#include <math.h>
#include <stdlib.h>

static void paint(cairo_t *c, const char *colour) {
    unsigned long v = strtoul(colour + 1, NULL, 16);
    cairo_set_source_rgb(c, (double)(v >> 16 & 255) / 255.0, (double)(v >> 8 & 255) / 255.0,
                         (double)(v & 255) / 255.0);
}

static void trace(cairo_t *c, const fw_report_view *view, const fw_geometry_contour *contour) {
    if (contour->count == 0) return;
    cairo_move_to(c, fw_report_x(view, contour->segment[0].a.x),
                  fw_report_y(view, contour->segment[0].a.y));
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        if (s->kind == FW_LINE) {
            cairo_line_to(c, fw_report_x(view, s->b.x), fw_report_y(view, s->b.y));
            continue;
        }
        double x = fw_report_x(view, s->centre.x), y = fw_report_y(view, s->centre.y);
        double r = s->radius * view->scale;
        double from = -atan2(s->a.y - s->centre.y, s->a.x - s->centre.x); /* y points down */
        if (s->sweep_rad > 0.0)
            cairo_arc_negative(c, x, y, r, from, from - s->sweep_rad);
        else
            cairo_arc(c, x, y, r, from, from - s->sweep_rad);
    }
    cairo_close_path(c);
}

static void fill(cairo_t *c, const char *inside, const char *edge, double width) {
    paint(c, inside);
    cairo_fill_preserve(c);
    paint(c, edge);
    cairo_set_line_width(c, width);
    cairo_stroke(c);
}

static void pieces(cairo_t *c, const fw_device *device, const fw_layout *layout,
                   const fw_verdict *verdict, const fw_report_view *view, double px) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        bool fixed = p->role == FW_ROLE_FRAME || p->body == FW_GROUND;
        if (p->role != FW_ROLE_FRAME && p->role != FW_ROLE_STRUCTURE &&
            p->role != FW_ROLE_FLEXURE && p->role != FW_ROLE_TETHER)
            continue;
        trace(c, view, &p->contour);
        if (p->role == FW_ROLE_FLEXURE) {
            const char *colour =
                fw_report_utilisation_colour(fw_report_joint_utilisation(verdict, p->joint));
            fill(c, colour, colour, 1.2 * px);
        } else if (fixed)
            fill(c, "#eceff2", "#b6bec7", 0.7 * px);
        else
            fill(c, p->body >= 0 && device->body[p->body].platform ? "#bcd0e3" : "#d5dbe1",
                 "#57606a", 0.7 * px);
    }
}

static void sticks(cairo_t *c, const fw_device *device, const fw_report_view *view, double px) {
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_device_revolute *joint = &device->revolute[j];
        const int side[2] = {joint->body_a, joint->body_b};
        for (int k = 0; k < 2; k++) {
            if (side[k] < 0 || !isfinite(device->body[side[k]].x_m)) continue;
            const fw_device_body *b = &device->body[side[k]];
            cairo_move_to(c, fw_report_x(view, joint->x_m), fw_report_y(view, joint->y_m));
            cairo_line_to(c, fw_report_x(view, b->x_m), fw_report_y(view, b->y_m));
            paint(c, b->platform ? "#7f9fbd" : "#9aa4ae");
            cairo_set_line_width(c, 7.0 * px);
            cairo_set_line_cap(c, CAIRO_LINE_CAP_ROUND);
            cairo_stroke(c);
        }
    }
}

static void points(cairo_t *c, const fw_device *device, const fw_layout *layout,
                   const fw_verdict *verdict, const fw_report_view *view, double px) {
    for (int j = 0; j < device->nrevolute; j++) {
        bool flexure = fw_report_drawn(layout) && layout->hinge && layout->hinge[j].drawn;
        fw_geometry_vec2 p = fw_report_hinge_point(device, layout, j);
        if (!isfinite(p.x) || !isfinite(p.y)) continue;
        cairo_new_sub_path(c);
        cairo_arc(c, fw_report_x(view, p.x), fw_report_y(view, p.y), (flexure ? 2.2 : 5.0) * px,
                  0.0, FW_TURN);
        fill(c, fw_report_utilisation_colour(fw_report_joint_utilisation(verdict, j)), "#ffffff",
             px);
    }
}

/* as drawing_marks.c, without its numbers */
static void marked(cairo_t *c, const fw_device *device, const fw_layout *layout,
                   const fw_report_marks *marks, const fw_report_view *view, double px) {
    bool drawn = fw_report_drawn(layout);
    paint(c, fw_report_mark_colour);
    for (int i = 0; i < marks->count; i++) {
        const fw_report_mark *m = &marks->item[i];
        for (int k = 0; drawn && k < layout->npiece; k++) {
            const fw_layout_piece *p = &layout->piece[k];
            bool of = false;
            for (int n = 0; n < m->nbody; n++)
                of = of || (m->body[n] >= 0 && m->body[n] == p->body);
            if (!of || p->role != FW_ROLE_STRUCTURE) continue;
            trace(c, view, &p->contour);
            cairo_set_line_width(c, 2.0 * px);
            cairo_stroke(c);
        }
        for (int k = 0; m->overlap && k < m->overlap->count; k++)
            trace(c, view, &m->overlap->contour[k]);
        cairo_fill(c);
        for (int n = 0; n < m->njoint; n++) {
            fw_geometry_vec2 p = fw_report_hinge_point(device, layout, m->joint[n]);
            double r = drawn && layout->hinge[m->joint[n]].drawn
                           ? layout->hinge[m->joint[n]].keep_out_m * view->scale
                           : 0.0;
            if (!isfinite(p.x + p.y)) continue;
            cairo_new_sub_path(c);
            cairo_arc(c, fw_report_x(view, p.x), fw_report_y(view, p.y), fmax(r, 11.0 * px), 0.0,
                      FW_TURN);
            cairo_set_line_width(c, 2.5 * px);
            cairo_stroke(c);
        }
    }
}

static void png_path(void *to, const double *xy, int n, const char *inside, const char *ink,
                     double width, bool dashed) {
    cairo_t *c = to;
    for (int i = 0; i < n; i++)
        (i ? cairo_line_to : cairo_move_to)(c, xy[2 * i], xy[2 * i + 1]);
    if (inside) {
        cairo_close_path(c);
        paint(c, inside);
        cairo_fill_preserve(c);
    }
    paint(c, ink);
    cairo_set_line_width(c, width);
    cairo_set_line_cap(c, CAIRO_LINE_CAP_BUTT);
    const double dash[] = {3.75 * width, 1.875 * width};
    cairo_set_dash(c, dash, dashed ? 2 : 0, 0.0);
    if (width > 0.0)
        cairo_stroke(c);
    else
        cairo_new_path(c);
    cairo_set_dash(c, dash, 0, 0.0);
}

static void png_circle(void *to, double x, double y, double r, const char *inside, const char *ink,
                       double width) {
    cairo_t *c = to;
    cairo_new_sub_path(c);
    cairo_arc(c, x, y, r, 0.0, FW_TURN);
    fill(c, inside, ink, width);
}

static cairo_status_t collect(void *closure, const unsigned char *data, unsigned int length) {
    fw_text *out = closure;
    fw_text_bytes(out, data, length);
    return out->failed ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

/* cairo 1.16 does not survive every allocation that fails in it (a stroke of many boxes ends in a
   segmentation fault, others in an abort), so what a picture takes is asked for before: the surface,
   and room for paths, scan lines and the compressor. What it survives it does not always tell, and
   leaves out of the picture; the allocator tells it in errno. Test: tests/faults/loops.py. */
static fw_status room_for_picture(const fw_arena *arena, int width_px, double height_px) {
    enum { BESIDES = 8 << 20 };
    fw_arena *room = fw_arena_part(arena, 0);
    FW_NEED(room);
    void *block = fw_arena_raw(room, 4 * (size_t)width_px * (size_t)height_px + BESIDES);
    fw_arena_free(room);
    return block ? FW_OK : FW_NOMEM;
}

fw_status fw_report_device_png(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict *verdict, int width_px, fw_text *out) {
    fw_report_marks marks;
    if (width_px < 16 || width_px > 8192) return FW_USAGE;
    FW_TRY(fw_report_marks_of(arena, device, layout, verdict, &marks));
    fw_report_view view = fw_report_device_view(device, layout, NULL, width_px);
    double px = width_px / 640.0;
    FW_TRY(room_for_picture(arena, width_px, view.height));
    errno = 0;
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, (int)view.height);
    cairo_t *c = cairo_create(surface);
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
    paint(c, "#ffffff");
    cairo_paint(c);
    if (fw_report_drawn(layout))
        pieces(c, device, layout, verdict, &view, px);
    else
        sticks(c, device, &view, px);
    points(c, device, layout, verdict, &view, px);
    const fw_report_canvas canvas = {.path = png_path, .circle = png_circle, .to = c, .px = px};
    fw_report_actuators(device, layout, &view, &canvas);
    marked(c, device, layout, &marks, &view, px);
    cairo_status_t drawn = cairo_status(c);
    cairo_destroy(c);
    cairo_surface_flush(surface);
    cairo_status_t written = drawn;
    if (drawn == CAIRO_STATUS_SUCCESS)
        written = cairo_surface_write_to_png_stream(surface, collect, out);
    cairo_surface_destroy(surface);
    if (errno == ENOMEM || written == CAIRO_STATUS_NO_MEMORY || out->failed) return FW_NOMEM;
    return written == CAIRO_STATUS_SUCCESS ? FW_OK : FW_INTERNAL;
}
