/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the scenes drive the device with, over its drawing: tendons from eyelet to eyelet with an
   arrow where they leave, electrodes, arrows for forces. What several scenes share is drawn once.
 */
#include "report/page.h"
#include <math.h>
#include <string.h>

static const char INK[] = "#7b3294"; /* none of the colours that stand for utilisation */
enum { FINGERS_SHOWN = 12, LABEL = 11 };

typedef struct pen {
    const fw_device *device;
    const fw_layout *layout;
    const fw_report_view *view;
    fw_text *out;
} pen;

/* pose of a body as drawn: centre of mass, turn */
static void pose_of(const pen *p, int body, double pose[3]) {
    pose[0] = pose[1] = pose[2] = 0;
    if (body == FW_GROUND) return;
    const fw_body *b = &p->device->body[body];
    bool outlined = fw_report_outlined(p->layout, body);
    pose[0] = isnan(b->x_m) && outlined ? p->layout->body[body].centroid.x : b->x_m;
    pose[1] = isnan(b->y_m) && outlined ? p->layout->body[body].centroid.y : b->y_m;
    pose[2] = b->phi_rad;
}

static fw_vec2 place_of(const pen *p, int body, double x_m, double y_m) {
    double at[3];
    pose_of(p, body, at);
    double c = cos(at[2]), s = sin(at[2]);
    return (fw_vec2){at[0] + c * x_m - s * y_m, at[1] + s * x_m + c * y_m};
}

static void line(const pen *p, fw_vec2 a, fw_vec2 b, double width, const char *more) {
    fw_report_markup(p->out,
                     "<path d=\"M{c} {c}L{c} {c}\" fill=\"none\" stroke=\"{r}\" "
                     "stroke-width=\"{c}\"{r}/>\n",
                     fw_report_x(p->view, a.x), fw_report_y(p->view, a.y),
                     fw_report_x(p->view, b.x), fw_report_y(p->view, b.y), INK, width, more);
}

/* a head at `tip` that points along (dx, dy) of the world, `size` pixels long */
static void arrow_head(const pen *p, fw_vec2 tip, double dx, double dy, double size) {
    double l = hypot(dx, dy), x = fw_report_x(p->view, tip.x), y = fw_report_y(p->view, tip.y);
    if (!(l > 0)) return;
    double ux = dx / l, uy = -dy / l; /* y points down in the picture */
    fw_report_markup(p->out, "<path fill=\"{r}\" d=\"M{c} {c}L{c} {c}L{c} {c}Z\"/>\n", INK, x, y,
                     x - size * ux - 0.45 * size * uy, y - size * uy + 0.45 * size * ux,
                     x - size * ux + 0.45 * size * uy, y - size * uy - 0.45 * size * ux);
}

static void label(const pen *p, fw_vec2 at, double dx, double dy, const char *text) {
    if (!text) return;
    fw_report_markup(p->out,
                     "<text x=\"{c}\" y=\"{c}\" font-size=\"{i}\" fill=\"{r}\" stroke=\"#fff\" "
                     "stroke-width=\"2.5\" paint-order=\"stroke\" text-anchor=\"middle\">{s}"
                     "</text>\n",
                     fw_report_x(p->view, at.x) + dx, fw_report_y(p->view, at.y) + dy, LABEL, INK,
                     text);
}

/* ---- tendons ---- */

/* the line ends in an arrow: there the actuator pulls */
static void tendon(const pen *p, const fw_tendon *t) {
    fw_vec2 last = {0, 0}, before = {0, 0};
    for (int i = 0; i < t->neyelet; i++) {
        const fw_eyelet *e = &t->eyelet[i];
        fw_vec2 at = place_of(p, e->body, e->x_m, e->y_m);
        if (i > 0) line(p, last, at, 1.6, " stroke-dasharray=\"6 3\"");
        before = last, last = at;
    }
    for (int i = 0; i < t->neyelet; i++) {
        const fw_eyelet *e = &t->eyelet[i];
        fw_vec2 at = place_of(p, e->body, e->x_m, e->y_m);
        fw_report_markup(p->out,
                         "<circle cx=\"{c}\" cy=\"{c}\" r=\"{c}\" fill=\"{r}\" stroke=\"{r}\" "
                         "stroke-width=\"1.4\"/>\n",
                         fw_report_x(p->view, at.x), fw_report_y(p->view, at.y), 3.2,
                         i > 0 ? "#fff" : INK, INK);
    }
    if (t->neyelet < 2) return;
    double dx = last.x - before.x, dy = last.y - before.y, l = hypot(dx, dy);
    if (!(l > 0)) return;
    double way = 18 / p->view->scale;
    fw_vec2 end = {last.x + way * dx / l, last.y + way * dy / l};
    line(p, last, end, 1.6, "");
    arrow_head(p, end, dx, dy, 8);
    fw_vec2 middle = {0.5 * (last.x + before.x), 0.5 * (last.y + before.y)};
    label(p, middle, 14, -4, t->id);
}

/* ---- electrodes ---- */

typedef struct frame { /* along and across of a comb, in the world */
    fw_vec2 at, along, across;
} frame;

static fw_vec2 point(const frame *f, double x, double y) {
    return (fw_vec2){f->at.x + x * f->along.x + y * f->across.x,
                     f->at.y + x * f->along.y + y * f->across.y};
}

static void bar(const pen *p, const frame *f, double x0, double x1, double y0, double y1,
                const char *fill) {
    const double x[4] = {x0, x1, x1, x0}, y[4] = {y0, y0, y1, y1};
    fw_report_markup(p->out, "<path fill=\"{r}\" stroke=\"{r}\" stroke-width=\"0.6\" d=\"", fill,
                     INK);
    for (int i = 0; i < 4; i++) {
        fw_vec2 q = point(f, x[i], y[i]);
        fw_report_markup(p->out, "{r}{c} {c}", i ? "L" : "M", fw_report_x(p->view, q.x),
                         fw_report_y(p->view, q.y));
    }
    fw_text_add(p->out, "Z\"/>\n");
}

/* The file does not say how wide fingers are: they are shown as wide as the gap, at least two
   pixels, and at most FINGERS_SHOWN of them. */
static void comb(const pen *p, const fw_comb *c) {
    double pose[3];
    pose_of(p, c->body_a, pose);
    double turn = c->direction_rad + pose[2], px = 1 / p->view->scale;
    frame f = {place_of(p, c->body_b, c->bx_m, c->by_m), {cos(turn), sin(turn)}, {0, 0}};
    f.across = (fw_vec2){-f.along.y, f.along.x};
    if (c->kind == FW_ELECTRODES_PLATE) {
        double half = 0.5 * c->length_m, gap = fmax(c->gap_m, 3 * px), thick = 4 * px;
        bar(p, &f, -thick, 0, -half, half, INK);
        bar(p, &f, gap, gap + thick, -half, half, "#fff");
        label(p, point(&f, gap + thick, 0), 16 * f.along.x, -16 * f.along.y + 4, c->id);
        return;
    }
    int shown = c->fingers < FINGERS_SHOWN ? c->fingers : FINGERS_SHOWN;
    double wide = fmax(c->gap_m, 2 * px), pitch = 4 * wide, side = 0.5 * pitch * shown;
    double length = isnan(c->length_m) ? 2 * c->overlap_m : c->length_m;
    double tip = 0.5 * c->overlap_m; /* the point is the middle of the overlap */
    bar(p, &f, tip - length - 2 * wide, tip - length, -side, side, INK);
    bar(p, &f, length - tip, length - tip + 2 * wide, -side - 0.5 * pitch, side + 0.5 * pitch,
        "#fff");
    for (int i = 0; i < shown; i++) {
        double y = (i - 0.5 * (shown - 1)) * pitch;
        bar(p, &f, tip - length, tip, y - 0.5 * wide, y + 0.5 * wide, INK);
    }
    for (int i = 0; i <= shown; i++) {
        double y = (i - 0.5 * shown) * pitch;
        bar(p, &f, -tip, length - tip, y - 0.5 * wide, y + 0.5 * wide, "#fff");
    }
    fw_vec2 tag = point(&f, length - tip + 2 * wide, 0);
    label(p, tag, 18 * f.along.x, -18 * f.along.y + 4, c->id);
}

/* ---- all scenes ---- */

static bool tendon_before(const fw_device *d, int scene, const char *id) {
    for (int s = 0; s < scene; s++)
        for (int i = 0; id && i < d->scene[s].ntendon; i++)
            if (d->scene[s].tendon[i].id && strcmp(d->scene[s].tendon[i].id, id) == 0) return true;
    return false;
}

static bool comb_before(const fw_device *d, int scene, const char *id) {
    for (int s = 0; s < scene; s++)
        for (int i = 0; id && i < d->scene[s].ncomb; i++)
            if (d->scene[s].comb[i].id && strcmp(d->scene[s].comb[i].id, id) == 0) return true;
    return false;
}

void fw_report_actuators(const fw_device *device, const fw_layout *layout,
                         const fw_report_view *view, fw_text *out) {
    const pen p = {device, layout, view, out};
    for (int s = 0; s < device->nscene; s++) {
        const fw_scene *scene = &device->scene[s];
        for (int i = 0; i < scene->ncomb; i++)
            if (!comb_before(device, s, scene->comb[i].id)) comb(&p, &scene->comb[i]);
        for (int i = 0; i < scene->ntendon; i++)
            if (!tendon_before(device, s, scene->tendon[i].id)) tendon(&p, &scene->tendon[i]);
    }
}

void fw_report_actuators_reach(const fw_device *device, const fw_layout *layout, fw_box *box) {
    const pen p = {device, layout, NULL, NULL};
    for (int s = 0; s < device->nscene; s++)
        for (int i = 0; i < device->scene[s].ntendon; i++)
            for (int k = 0; k < device->scene[s].tendon[i].neyelet; k++) {
                const fw_eyelet *e = &device->scene[s].tendon[i].eyelet[k];
                fw_vec2 at = place_of(&p, e->body, e->x_m, e->y_m);
                fw_report_box_add(box, at.x, at.y);
            }
}
