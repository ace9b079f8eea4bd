/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the scenes drive the device with, over its drawing: tendons from eyelet to eyelet with an
   arrow where they leave, and electrodes. What several scenes share is drawn once. The same shapes
   go to SVG and, without names, to cairo. */
#include "report/report_page.h"
#include <math.h>
#include <string.h>

static const char INK[] = "#7b3294"; /* none of the colours that stand for utilisation */
enum { FINGERS_SHOWN = 12, LABEL = 11, PULL = 18 };

typedef struct pen {
    const fw_device *device;
    const fw_layout *layout;
    const fw_report_view *view;
    const fw_report_canvas *canvas;
} pen;

/* pose of a body as drawn: centre of mass, turn */
static void pose_of(const pen *p, int body, double pose[3]) {
    pose[0] = pose[1] = pose[2] = 0;
    if (body == FW_GROUND) return;
    const fw_device_body *b = &p->device->body[body];
    bool outlined = fw_report_outlined(p->layout, body) && p->layout->body[body].area_m2 > 0.0;
    pose[0] = isnan(b->x_m) && outlined ? p->layout->body[body].centroid.x : b->x_m;
    pose[1] = isnan(b->y_m) && outlined ? p->layout->body[body].centroid.y : b->y_m;
    pose[2] = b->phi_rad;
}

static fw_geometry_vec2 place_of(const pen *p, int body, double x_m, double y_m) {
    double at[3];
    pose_of(p, body, at);
    double c = cos(at[2]), s = sin(at[2]);
    return (fw_geometry_vec2){at[0] + c * x_m - s * y_m, at[1] + s * x_m + c * y_m};
}

static double px_of(const pen *p) { /* m */
    return p->canvas->px / p->view->scale;
}

/* through world points; the fill NULL: a line */
static void shape(const pen *p, const fw_geometry_vec2 *at, int n, const char *fill, double width,
                  bool dashed) {
    double xy[8];
    for (int i = 0; i < n; i++) {
        xy[2 * i] = fw_report_x(p->view, at[i].x);
        xy[2 * i + 1] = fw_report_y(p->view, at[i].y);
    }
    p->canvas->path(p->canvas->to, xy, n, fill, INK, width * p->canvas->px, dashed);
}

static void line(const pen *p, fw_geometry_vec2 a, fw_geometry_vec2 b, bool dashed) {
    const fw_geometry_vec2 at[2] = {a, b};
    shape(p, at, 2, NULL, 1.6, dashed);
}

/* a head at `tip` that points along (dx, dy) of the world */
static void arrow_head(const pen *p, fw_geometry_vec2 tip, double dx, double dy) {
    double l = hypot(dx, dy), size = 8 * px_of(p);
    if (!(l > 0)) return;
    double ux = size * dx / l, uy = size * dy / l;
    const fw_geometry_vec2 at[3] = {tip,
                                    {tip.x - ux + 0.45 * uy, tip.y - uy - 0.45 * ux},
                                    {tip.x - ux - 0.45 * uy, tip.y - uy + 0.45 * ux}};
    shape(p, at, 3, INK, 0, false);
}

static void label(const pen *p, fw_geometry_vec2 at, const char *text) {
    if (text && p->canvas->label)
        p->canvas->label(p->canvas->to, fw_report_x(p->view, at.x),
                         fw_report_y(p->view, at.y) + 0.35 * LABEL, text);
}

/* pixels to the nearest name of a body or point of a hinge */
static double free_of_names(const pen *p, fw_geometry_vec2 at) {
    double least = HUGE_VAL;
    for (int b = 0; b < p->device->nbody; b++) {
        double pose[3];
        pose_of(p, b, pose);
        least = fmin(least, hypot(at.x - pose[0], at.y - pose[1]));
    }
    for (int j = 0; j < p->device->nrevolute; j++) {
        fw_geometry_vec2 h = fw_report_hinge_point(p->device, p->layout, j);
        least = fmin(least, hypot(at.x - h.x, at.y - h.y));
    }
    return least * p->view->scale;
}

/* beside the line from a to b, in its middle where that is free */
static void label_line(const pen *p, fw_geometry_vec2 a, fw_geometry_vec2 b, const char *text) {
    static const double share[] = {0.5, 0.35, 0.65, 0.25, 0.75};
    double dx = b.x - a.x, dy = b.y - a.y, l = hypot(dx, dy);
    if (!(l > 0)) return;
    double nx = -dy / l, ny = dx / l; /* to the upper side; of upright lines to the right */
    double turn = ny > 0.1 || (ny > -0.1 && nx > 0) ? 1 : -1, way = 12 * px_of(p);
    fw_geometry_vec2 best = a;
    double most = -1;
    for (int i = 0; i < 5 && most < 30; i++) {
        fw_geometry_vec2 at = {a.x + share[i] * dx + turn * way * nx,
                               a.y + share[i] * dy + turn * way * ny};
        double room = free_of_names(p, at);
        if (room > most) most = room, best = at;
    }
    label(p, best, text);
}

/* ---- tendons ---- */

/* the line ends in an arrow: there the actuator pulls */
static void tendon(const pen *p, const fw_device_tendon *t, const char *name) {
    fw_geometry_vec2 last = {0, 0}, before = {0, 0}, from = {0, 0}, to = {0, 0};
    for (int i = 0; i < t->neyelet; i++) {
        const fw_device_eyelet *e = &t->eyelet[i];
        fw_geometry_vec2 at = place_of(p, e->body, e->x_m, e->y_m);
        if (i > 0) line(p, last, at, true);
        before = last, last = at;
        if (i > 0 &&
            hypot(last.x - before.x, last.y - before.y) > hypot(to.x - from.x, to.y - from.y))
            from = before, to = last; /* the longest part bears the name */
    }
    for (int i = 0; i < t->neyelet; i++) {
        const fw_device_eyelet *e = &t->eyelet[i];
        fw_geometry_vec2 at = place_of(p, e->body, e->x_m, e->y_m);
        double px = p->canvas->px;
        p->canvas->circle(p->canvas->to, fw_report_x(p->view, at.x), fw_report_y(p->view, at.y),
                          3.2 * px, i > 0 ? "#ffffff" : INK, INK, 1.4 * px);
    }
    double dx = last.x - before.x, dy = last.y - before.y, l = hypot(dx, dy);
    if (t->neyelet < 2 || !(l > 0)) return;
    double way = PULL * px_of(p);
    fw_geometry_vec2 end = {last.x + way * dx / l, last.y + way * dy / l};
    line(p, last, end, false);
    arrow_head(p, end, dx, dy);
    label_line(p, from, to, name);
}

/* ---- electrodes ---- */

typedef struct frame { /* along and across of a comb, in the world */
    fw_geometry_vec2 at, along, across;
} frame;

static fw_geometry_vec2 point(const frame *f, double x, double y) {
    return (fw_geometry_vec2){f->at.x + x * f->along.x + y * f->across.x,
                              f->at.y + x * f->along.y + y * f->across.y};
}

static void bar(const pen *p, const frame *f, double x0, double x1, double y0, double y1,
                const char *fill) {
    const fw_geometry_vec2 at[4] = {point(f, x0, y0), point(f, x1, y0), point(f, x1, y1),
                                    point(f, x0, y1)};
    shape(p, at, 4, fill, 0.6, false);
}

static frame frame_of(const pen *p, const fw_device_comb *c) {
    double pose[3];
    pose_of(p, c->body_a, pose);
    double turn = c->direction_rad + pose[2];
    return (frame){
        place_of(p, c->body_b, c->bx_m, c->by_m), {cos(turn), sin(turn)}, {-sin(turn), cos(turn)}};
}

static double finger_length(const fw_device_comb *c) {
    return isnan(c->length_m) ? 2 * c->overlap_m : c->length_m;
}

static void plates(const pen *p, const fw_device_comb *c, const frame *f) {
    double px = px_of(p), half = 0.5 * c->length_m, gap = fmax(c->gap_m, 3 * px), thick = 4 * px;
    bar(p, f, -thick, 0, -half, half, INK);
    bar(p, f, gap, gap + thick, -half, half, "#ffffff");
    label(p, point(f, gap + thick + 18 * px, 0), c->id);
}

/* are its electrodes part of the drawing? */
static bool is_drawn(const pen *p, const fw_device_comb *c) {
    static const char start[] = "stator of ";
    for (int i = 0; p->layout && c->id && i < p->layout->npiece; i++) {
        const fw_layout_piece *piece = &p->layout->piece[i];
        if (piece->body != FW_ISLAND || strncmp(piece->label, start, sizeof start - 1) != 0)
            continue;
        const char *kind = fw_text_kind("comb drive ", c->id),
                   *of = piece->label + sizeof start - 1;
        if (strncmp(of, kind, strlen(kind)) == 0 && strcmp(of + strlen(kind), c->id) == 0)
            return true;
    }
    return false;
}

/* Electrodes that the drawing has get their name only, beside the fingers. Of others a comb is
   shown with fingers as wide as the gap, at least two pixels, and at most FINGERS_SHOWN of them;
   the rotor is filled, the stator is not. */
static void comb(const pen *p, const fw_device_comb *c) {
    frame f = frame_of(p, c);
    if (is_drawn(p, c)) {
        double half = c->kind == FW_ELECTRODES_COMB ? c->fingers * (c->width_m + c->gap_m)
                                                    : 0.5 * c->length_m;
        label(p, point(&f, 0, (f.across.y < 0 ? -1 : 1) * (half + 10 * px_of(p))), c->id);
        return;
    }
    if (c->kind == FW_ELECTRODES_PLATE) {
        plates(p, c, &f);
        return;
    }
    int shown = c->fingers < FINGERS_SHOWN ? c->fingers : FINGERS_SHOWN;
    double px = px_of(p), wide = fmax(c->gap_m, 2 * px), pitch = 4 * wide;
    double side = 0.5 * pitch * shown, length = finger_length(c);
    double tip = 0.5 * c->overlap_m, back = fmax(2 * wide, 3 * px);
    bar(p, &f, tip - length - back, tip - length, -side, side, INK);
    bar(p, &f, length - tip, length - tip + back, -side - 0.5 * pitch, side + 0.5 * pitch,
        "#ffffff");
    for (int i = 0; i < shown; i++) {
        double y = (i - 0.5 * (shown - 1)) * pitch;
        bar(p, &f, tip - length, tip, y - 0.5 * wide, y + 0.5 * wide, INK);
    }
    for (int i = 0; i <= shown; i++) {
        double y = (i - 0.5 * shown) * pitch;
        bar(p, &f, -tip, length - tip, y - 0.5 * wide, y + 0.5 * wide, "#ffffff");
    }
    label(p, point(&f, length - tip + back + 22 * px, 0), c->id);
}

/* ---- all scenes ---- */

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* through the same eyelets, or of the same name: what several scenes share */
static bool same_way(const fw_device_tendon *a, const fw_device_tendon *b) {
    if (a->id && same_text(a->id, b->id)) return true;
    if (a->neyelet != b->neyelet) return false;
    for (int i = 0; i < a->neyelet; i++) {
        const fw_device_eyelet *e = &a->eyelet[i], *f = &b->eyelet[i];
        if (e->body != f->body || e->x_m != f->x_m || e->y_m != f->y_m) return false;
    }
    return true;
}

static bool tendon_before(const fw_device *d, int scene, int tendon) {
    const fw_device_tendon *t = &d->scene[scene].tendon[tendon];
    for (int s = 0; s <= scene; s++)
        for (int i = 0; i < (s < scene ? d->scene[s].ntendon : tendon); i++)
            if (same_way(&d->scene[s].tendon[i], t)) return true;
    return false;
}

/* "TL, CL": of all that run there; NULL: none has a name */
static const char *names_of(const fw_device *d, const fw_device_tendon *t, char *text, size_t n) {
    size_t used = 0;
    for (int s = 0; s < d->nscene; s++)
        for (int i = 0; i < d->scene[s].ntendon; i++) {
            const fw_device_tendon *other = &d->scene[s].tendon[i];
            size_t length = other->id ? strlen(other->id) : 0;
            bool said = length == 0 || !same_way(other, t) || used + length + 3 > n;
            for (int k = 0; k <= s && !said; k++)
                for (int m = 0; m < (k < s ? d->scene[k].ntendon : i) && !said; m++)
                    said = same_text(d->scene[k].tendon[m].id, other->id);
            if (said) continue;
            if (used > 0) memcpy(text + used, ", ", 2), used += 2;
            memcpy(text + used, other->id, length + 1), used += length;
        }
    return used > 0 ? text : NULL;
}

static bool comb_before(const fw_device *d, int scene, const char *id) {
    for (int s = 0; s < scene; s++)
        for (int i = 0; id && i < d->scene[s].ncomb; i++)
            if (d->scene[s].comb[i].id && strcmp(d->scene[s].comb[i].id, id) == 0) return true;
    return false;
}

void fw_report_actuators(const fw_device *device, const fw_layout *layout,
                         const fw_report_view *view, const fw_report_canvas *canvas) {
    const pen p = {device, layout, view, canvas};
    for (int s = 0; s < device->nscene; s++) {
        const fw_device_scene *scene = &device->scene[s];
        for (int i = 0; i < scene->ncomb; i++)
            if (!comb_before(device, s, scene->comb[i].id)) comb(&p, &scene->comb[i]);
        for (int i = 0; i < scene->ntendon; i++)
            if (!tendon_before(device, s, i)) {
                char names[64];
                const char *name = names_of(device, &scene->tendon[i], names, sizeof names);
                tendon(&p, &scene->tendon[i], name);
            }
    }
}

void fw_report_actuators_reach(const fw_device *device, const fw_layout *layout,
                               fw_geometry_box *box) {
    const pen p = {device, layout, NULL, NULL};
    for (int s = 0; s < device->nscene; s++) {
        const fw_device_scene *scene = &device->scene[s];
        for (int i = 0; i < scene->ntendon; i++)
            for (int k = 0; k < scene->tendon[i].neyelet; k++) {
                const fw_device_eyelet *e = &scene->tendon[i].eyelet[k];
                fw_geometry_vec2 at = place_of(&p, e->body, e->x_m, e->y_m);
                fw_report_box_add(box, at.x, at.y);
            }
        for (int i = 0; i < scene->ncomb; i++) {
            const fw_device_comb *c = &scene->comb[i];
            frame f = frame_of(&p, c);
            bool plate = c->kind == FW_ELECTRODES_PLATE;
            fw_geometry_vec2 end = point(&f, plate ? c->gap_m : finger_length(c), 0);
            fw_report_box_add(box, end.x, end.y);
        }
    }
}

/* ---- as SVG ---- */

static void svg_path(void *to, const double *xy, int n, const char *fill, const char *ink,
                     double width, bool dashed) {
    fw_text *out = to;
    fw_svg_path(out, "");
    for (int i = 0; i < n; i++)
        fw_svg_point(out, i ? 'L' : 'M', xy[2 * i], xy[2 * i + 1], 2);
    fw_text_add(out, fill ? "Z" : "");
    fw_svg_more(out, "fill='{r}'", fill ? fill : "none");
    if (width > 0) fw_svg_more(out, "stroke='{r}' stroke-width='{c}'", ink, width);
    if (dashed) fw_svg_more(out, "stroke-dasharray='6 3'");
    fw_svg_path_end(out);
}

static void svg_circle(void *to, double x, double y, double r, const char *fill, const char *ink,
                       double width) {
    fw_svg_put(to, "circle cx='{c}' cy='{c}' r='{c}' fill='{r}' stroke='{r}' stroke-width='{c}'\n",
               x, y, r, fill, ink, width);
}

static void svg_label(void *to, double x, double y, const char *text) {
    fw_svg_put(to,
               "text x='{c}' y='{c}' font-size='{i}' fill='{r}' stroke='#fff' stroke-width='2.5' "
               "paint-order='stroke' text-anchor='middle'>{s}\n",
               x, y, LABEL, INK, text);
}

void fw_report_actuators_svg(const fw_device *device, const fw_layout *layout,
                             const fw_report_view *view, fw_text *out) {
    const fw_report_canvas canvas = {
        .path = svg_path, .circle = svg_circle, .label = svg_label, .to = out, .px = 1};
    fw_report_actuators(device, layout, view, &canvas);
}
