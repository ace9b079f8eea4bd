/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include <math.h>

enum { WIDTH = 640, LEGEND_HEIGHT = 30, MOST_LABELS = 40 };

double fw_report_joint_utilisation(const fw_verdict *verdict, int joint) {
    if (verdict)
        for (int i = 0; i < verdict->nhinge; i++)
            if (verdict->hinge[i].joint == joint) return verdict->hinge[i].utilisation;
    return (double)NAN;
}

void fw_report_body_path(const fw_layout *layout, int body, const fw_report_view *view,
                         fw_text *out) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->body == body && p->role == FW_ROLE_STRUCTURE) fw_report_path(out, view, &p->contour);
    }
}

/* from the centre of a body to its local point (x, y) */
static void stick_to(const fw_body *b, double x, double y, const fw_report_view *view,
                     fw_text *out) {
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    if (!isfinite(x) || !isfinite(y) || (x == 0.0 && y == 0.0)) return;
    fw_report_markup(out, "M{c} {c}L{c} {c}", fw_report_x(view, b->x_m), fw_report_y(view, b->y_m),
                     fw_report_x(view, b->x_m + c * x - s * y),
                     fw_report_y(view, b->y_m + s * x + c * y));
}

void fw_report_body_sticks(const fw_device *device, int body, const fw_report_view *view,
                           fw_text *out) {
    double x = 0.0, y = 0.0;
    int n = 0;
    for (int j = 0; j < device->njoint; j++)
        if (device->joint[j].body_a == body || device->joint[j].body_b == body) {
            x += device->joint[j].x_m;
            y += device->joint[j].y_m;
            n++;
        }
    const fw_body *b = &device->body[body];
    x = isfinite(b->x_m) ? b->x_m : n ? x / n : 0.0;
    y = isfinite(b->y_m) ? b->y_m : n ? y / n : 0.0;
    for (int j = 0; j < device->njoint; j++)
        if (device->joint[j].body_a == body || device->joint[j].body_b == body)
            fw_report_markup(out, "M{c} {c}L{c} {c}", fw_report_x(view, x), fw_report_y(view, y),
                             fw_report_x(view, device->joint[j].x_m),
                             fw_report_y(view, device->joint[j].y_m));
    fw_report_markup(out, "M{c} {c}h0", fw_report_x(view, x), fw_report_y(view, y));
    if (!isfinite(b->x_m) || !isfinite(b->y_m)) return;
    for (int i = 0; i < device->nspring; i++) {
        const fw_spring *s = &device->spring[i];
        if (s->body_a == body) stick_to(b, s->ax_m, s->ay_m, view, out);
        if (s->body_b == body) stick_to(b, s->bx_m, s->by_m, view, out);
    }
    for (int i = 0; i < device->ntie; i++) {
        const fw_tie *t = &device->tie[i];
        if (t->body_a == body && t->kind != FW_TIE_PRISMATIC)
            stick_to(b, t->ax_m, t->ay_m, view, out);
        if (t->body_b == body) stick_to(b, t->bx_m, t->by_m, view, out);
    }
}

static void fixed_parts(const fw_layout *layout, const fw_report_view *view, bool ids,
                        fw_text *out) {
    fw_report_markup(out,
                     "<g fill=\"#eceff2\" stroke=\"#b6bec7\" stroke-width=\"0.7\"><path{r} d=\"",
                     ids ? " id=\"fw-fixed\"" : "");
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->role == FW_ROLE_FRAME || (p->body == FW_GROUND && p->role == FW_ROLE_STRUCTURE))
            fw_report_path(out, view, &p->contour);
    }
    fw_text_add(out, "\"/></g>\n");
}

/* in a path of their own: figures that move leave them out */
static void tethers(const fw_layout *layout, const fw_report_view *view, fw_text *out) {
    bool any = false;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_TETHER) continue;
        if (!any)
            fw_text_add(out, "<path class=\"tethers\" fill=\"#eceff2\" stroke=\"#b6bec7\" "
                             "stroke-width=\"0.7\" d=\"");
        any = true;
        fw_report_path(out, view, &p->contour);
    }
    if (any) fw_text_add(out, "\"/>\n");
}

static void bodies(const fw_device *device, const fw_layout *layout, const fw_report_view *view,
                   bool ids, fw_text *out) {
    bool drawn = fw_report_drawn(layout);
    for (int b = 0; b < device->nbody; b++) {
        const char *fill = device->body[b].platform ? "#bcd0e3" : "#d5dbe1";
        if (drawn)
            fw_report_markup(out, "<g fill=\"{r}\" stroke=\"#57606a\" stroke-width=\"0.7\"><path",
                             fill);
        else
            fw_report_markup(out,
                             "<g fill=\"none\" stroke=\"{r}\" stroke-width=\"7\" "
                             "stroke-linecap=\"round\"><path",
                             device->body[b].platform ? "#7f9fbd" : "#9aa4ae");
        if (ids) fw_report_markup(out, " id=\"fw-b{i}\"", b);
        fw_text_add(out, " d=\"");
        if (drawn)
            fw_report_body_path(layout, b, view, out);
        else
            fw_report_body_sticks(device, b, view, out);
        fw_text_add(out, "\"/></g>\n");
    }
}

static void hinges(const fw_device *device, const fw_layout *layout, const fw_verdict *verdict,
                   const fw_report_view *view, fw_text *out) {
    if (fw_report_drawn(layout))
        for (int i = 0; i < layout->npiece; i++) {
            const fw_piece *p = &layout->piece[i];
            if (p->role != FW_ROLE_FLEXURE) continue;
            const char *colour =
                fw_report_utilisation_colour(fw_report_joint_utilisation(verdict, p->joint));
            fw_report_markup(out, "<path fill=\"{r}\" stroke=\"{r}\" stroke-width=\"1.2\" d=\"",
                             colour, colour);
            fw_report_path(out, view, &p->contour);
            fw_text_add(out, "\"/>\n");
        }
    for (int j = 0; j < device->njoint; j++) {
        bool flexure = fw_report_drawn(layout) && layout->hinge && layout->hinge[j].drawn;
        fw_vec2 p = fw_report_hinge_point(device, layout, j);
        fw_report_markup(out,
                         "<circle cx=\"{c}\" cy=\"{c}\" r=\"{c}\" fill=\"{r}\" "
                         "stroke=\"#fff\" stroke-width=\"1\"/>\n",
                         fw_report_x(view, p.x), fw_report_y(view, p.y), flexure ? 2.2 : 5.0,
                         fw_report_utilisation_colour(fw_report_joint_utilisation(verdict, j)));
    }
}

/* names stand outside the mechanism, away from the middle of the hinge points */
static void hinge_labels(const fw_device *device, const fw_layout *layout,
                         const fw_verdict *verdict, const fw_report_view *view, fw_text *out) {
    if (device->njoint > MOST_LABELS) return;
    double mx = 0.0, my = 0.0;
    for (int j = 0; j < device->njoint; j++) {
        fw_vec2 p = fw_report_hinge_point(device, layout, j);
        mx += fw_report_x(view, p.x) / device->njoint;
        my += fw_report_y(view, p.y) / device->njoint;
    }
    for (int j = 0; j < device->njoint; j++) {
        fw_vec2 p = fw_report_hinge_point(device, layout, j);
        double x = fw_report_x(view, p.x), y = fw_report_y(view, p.y);
        double dx = x - mx, dy = y - my, d = hypot(dx, dy);
        double away = 20.0;
        if (fw_report_drawn(layout) && layout->hinge && isfinite(layout->hinge[j].keep_out_m))
            away = fmax(away, layout->hinge[j].keep_out_m * view->scale + 6.0);
        dx = d > 1e-9 ? dx / d : 1.0;
        dy = d > 1e-9 ? dy / d : 0.0;
        double side = fabs(dx) < 0.35 ? 0.0 : dx, tx = x + away * dx;
        double room = 62.0;
        tx = side > 0.0   ? fmin(tx, view->width - room)
             : side < 0.0 ? fmax(tx, room)
                          : fmax(0.6 * room, fmin(view->width - 0.6 * room, tx));
        double ty = fmax(14.0, fmin(view->height - 8.0, y + away * dy + 4.0));
        double u = fw_report_joint_utilisation(verdict, j);
        fw_report_markup(out,
                         "<text x=\"{c}\" y=\"{c}\" font-size=\"13\" text-anchor=\"{r}\" "
                         "fill=\"#1f2328\" stroke=\"#fff\" stroke-width=\"3\" "
                         "paint-order=\"stroke\"><tspan font-weight=\"700\">{s}</tspan>",
                         tx, ty,
                         side > 0.0   ? "start"
                         : side < 0.0 ? "end"
                                      : "middle",
                         device->joint[j].id);
        if (isfinite(u)) fw_report_markup(out, " {p}", u);
        fw_text_add(out, "</text>\n");
    }
}

static void body_labels(const fw_device *device, const fw_layout *layout,
                        const fw_report_view *view, fw_text *out) {
    if (!fw_report_drawn(layout) || !layout->body || device->nbody > MOST_LABELS) return;
    for (int b = 0; b < device->nbody; b++) {
        if (!(layout->body[b].area_m2 > 0.0)) continue;
        fw_vec2 c = layout->body[b].centroid;
        fw_report_markup(out,
                         "<text x=\"{c}\" y=\"{c}\" font-size=\"10.5\" text-anchor=\"middle\" "
                         "fill=\"#424a53\" stroke=\"#fff\" stroke-opacity=\"0.8\" "
                         "stroke-width=\"2.5\" paint-order=\"stroke\">{s}</text>\n",
                         fw_report_x(view, c.x), fw_report_y(view, c.y) + 3.5, device->body[b].id);
    }
}

void fw_report_drawing(const fw_device *device, const fw_layout *layout, const fw_verdict *verdict,
                       const fw_report_view *view, bool ids, fw_text *out) {
    if (fw_report_drawn(layout)) {
        fixed_parts(layout, view, ids, out);
        tethers(layout, view, out);
    }
    bodies(device, layout, view, ids, out);
    hinges(device, layout, verdict, view, out);
    body_labels(device, layout, view, out);
    hinge_labels(device, layout, verdict, view, out);
    fw_report_scale_bar_svg(out, view);
    fw_report_markup(out,
                     "<g font-size=\"11\" fill=\"#424a53\"><rect y=\"{c}\" width=\"{c}\" "
                     "height=\"60\" fill=\"#fff\"/>\n",
                     view->height, view->width);
    static const double place[FW_REPORT_CLASSES] = {10.0, 118.0, 220.0, 330.0, 456.0};
    double size = view->width / WIDTH;
    for (int i = 0; i < FW_REPORT_CLASSES; i++)
        fw_report_markup(out,
                         "<rect x=\"{c}\" y=\"{c}\" width=\"12\" height=\"12\" rx=\"2\" "
                         "fill=\"{r}\"/><text x=\"{c}\" y=\"{c}\">{r}</text>\n",
                         place[i] * size, view->height + 10.0, fw_report_classes[i].colour,
                         place[i] * size + 18.0, view->height + 20.0, fw_report_classes[i].label);
    fw_text_add(out, "</g>\n");
}

fw_status fw_report_device_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict *verdict, fw_text *out) {
    (void)arena; /* `out` brings its own; kept so that all writers are called alike */
    fw_report_view view = fw_report_device_view(device, layout, NULL, WIDTH);
    fw_report_markup(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {c} {c}\" "
        "width=\"{c}\" height=\"{c}\" font-family=\"system-ui,'DejaVu Sans',"
        "sans-serif\">\n<title>{r}{s}: hinges coloured by utilisation</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        view.width, view.height + LEGEND_HEIGHT, view.width, view.height + LEGEND_HEIGHT,
        fw_report_rejected(verdict), device->name);
    fw_report_drawing(device, layout, verdict, &view, false, out);
    if (*fw_report_rejected(verdict))
        fw_report_markup(out,
                         "<text x=\"{c}\" y=\"22\" font-size=\"18\" font-weight=\"700\" "
                         "text-anchor=\"end\" fill=\"{r}\">REJECTED</text>\n",
                         view.width - 10.0, fw_report_decision_colour(FW_REJECT));
    fw_text_add(out, "</svg>\n");
    return fw_text_end(out);
}
