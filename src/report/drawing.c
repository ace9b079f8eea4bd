/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colours, the view that holds a device, and its drawing: what all pictures of the room share. */
#include "base/text.h"
#include "geometry/contour.h"
#include "report/figure.h"
#include "report/report_page.h"
#include <math.h>
#include <string.h>

/* Okabe and Ito, Color Universal Design (2008). Colour never stands alone: every mark that uses it
   also carries a number or a word. */

typedef struct class_row {
    double below; /* utilisation */
    const char *colour, *label;
} class_row;
enum { CLASSES = 5 };

/* last: no limit known */
static const class_row utilisation_class[CLASSES] = {
    {0.5, "#0072B2", "below 50 %"},          {0.8, "#009E73", "50 to 80 %"},
    {1.0, "#E69F00", "80 to 100 %"},         {HUGE_VAL, "#D55E00", "above the limit"},
    {HUGE_VAL, "#767676", "no limit known"},
};

const char *fw_report_utilisation_colour(double utilisation) {
    if (isnan(utilisation)) return utilisation_class[CLASSES - 1].colour;
    int i = 0;
    while (i < CLASSES - 2 && !(utilisation < utilisation_class[i].below))
        i++;
    return utilisation_class[i].colour;
}

static const struct {
    const char *word, *colour;
} decisions[] = {
    [FW_ACCEPT] = {"ACCEPT", "#00694D"},
    [FW_INCONCLUSIVE] = {"INCONCLUSIVE", "#8A5A00"},
    [FW_REJECT] = {"REJECT", "#B03A00"},
};

const char *fw_report_decision_colour(fw_verdict_decision decision) {
    return decisions[decision].colour;
}

const char *fw_report_rejected(const fw_verdict *verdict) {
    return verdict && verdict->decision == FW_REJECT ? "REJECTED: " : "";
}

const char *fw_report_decision_word(fw_verdict_decision decision) {
    return decisions[decision].word;
}

const char *fw_report_layer_colour(const char *colour, int index) {
    static const char *const palette[] = {"#0072B2", "#E69F00", "#009E73", "#CC79A7",
                                          "#56B4E9", "#D55E00", "#F0E442", "#767676"};
    size_t n = colour ? strlen(colour) : 0;
    if ((n == 4 || n == 7) && colour[0] == '#' &&
        strspn(colour + 1, "0123456789abcdefABCDEF") == n - 1)
        return colour;
    return palette[(unsigned)index % (sizeof palette / sizeof palette[0])];
}

static fw_geometry_box rest_box(const fw_device *device, const fw_layout *layout) {
    fw_geometry_box box = fw_report_box_empty();
    for (int j = 0; j < device->nrevolute; j++) {
        fw_geometry_vec2 p = fw_report_hinge_point(device, layout, j);
        fw_report_box_add(&box, p.x, p.y);
    }
    for (int b = 0; b < device->nbody; b++)
        fw_report_box_add(&box, device->body[b].x_m, device->body[b].y_m);
    if (fw_report_drawn(layout) && !(fmax(box.x1 - box.x0, box.y1 - box.y0) > 0.0))
        for (int i = 0; i < layout->npiece; i++) {
            fw_geometry_box b = fw_geometry_contour_box(&layout->piece[i].contour);
            fw_report_box_add(&box, b.x0, b.y0);
            fw_report_box_add(&box, b.x1, b.y1);
        }
    return box;
}

/* what moves, as drawn, and where the names of hinges stand: beside the circle that each keeps
   free */
static void add_outlines(const fw_device *device, const fw_layout *layout, double label_m,
                         fw_geometry_box *box) {
    if (!fw_report_drawn(layout)) return;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_STRUCTURE || p->body < 0) continue;
        fw_geometry_box b = fw_geometry_contour_box(&p->contour);
        fw_report_box_add(box, b.x0 - 0.2 * label_m, b.y0 - 0.2 * label_m);
        fw_report_box_add(box, b.x1 + 0.2 * label_m, b.y1 + 0.2 * label_m);
    }
    for (int j = 0; layout->hinge && j < device->nrevolute; j++) {
        if (!layout->hinge[j].drawn || !isfinite(layout->hinge[j].keep_out_m)) continue;
        fw_geometry_vec2 p = layout->hinge[j].centre;
        double x = layout->hinge[j].keep_out_m + label_m;
        fw_report_box_add(box, p.x - x, p.y);
        fw_report_box_add(box, p.x + x, p.y);
        if (layout->nfault == 0) continue; /* then whole circles may be marked */
        fw_report_box_add(box, p.x, p.y - 1.03 * layout->hinge[j].keep_out_m);
        fw_report_box_add(box, p.x, p.y + 1.03 * layout->hinge[j].keep_out_m);
    }
}

/* hinge points, centres of the bodies, and room for links around them, less where they only pass;
   tethers, which reach to the frame, run out of the picture */
fw_report_view fw_report_device_view(const fw_device *device, const fw_layout *layout,
                                     const fw_geometry_box *reach, double width) {
    fw_geometry_box box = rest_box(device, layout);
    double size = fmax(box.x1 - box.x0, box.y1 - box.y0);
    if (!isfinite(size) || !(size > 0.0)) return fw_report_view_fit(box, width, 0.0);
    double pad = 0.2 * size, less = 0.1 * size;
    box = (fw_geometry_box){box.x0 - pad, box.y0 - pad, box.x1 + pad, box.y1 + pad};
    add_outlines(device, layout, 0.18 * size, &box);
    fw_geometry_box led = fw_report_box_empty();
    fw_report_actuators_reach(device, layout, &led);
    if (led.x1 >= led.x0) {
        fw_report_box_add(&box, led.x0 - less, led.y0 - less);
        fw_report_box_add(&box, led.x1 + less, led.y1 + less);
    }
    if (reach && reach->x1 >= reach->x0 && reach->y1 >= reach->y0) {
        fw_report_box_add(&box, reach->x0 - less, reach->y0 - less);
        fw_report_box_add(&box, reach->x1 + less, reach->y1 + less);
    }
    return fw_report_view_fit(box, width, 0.0);
}

/* length of a scale bar that fills about a fifth of the view: 1, 2 or 5 times a power of ten */
static double scale_bar_m(const fw_report_view *view) {
    return fw_svg_nice(0.1 * view->width / view->scale);
}

void fw_report_scale_bar_svg(fw_text *out, const fw_report_view *view) {
    double length = scale_bar_m(view), px = length * view->scale;
    double x = view->width - 16.0 - px, y = view->height - 14.0;
    fw_svg_open(out, "g class='scale'");
    fw_svg_put(
        out, "rect x='{c}' y='{c}' width='{c}' height='30' rx='3' fill='#fff' fill-opacity='0.85'",
        x - 8.0, y - 22.0, px + 16.0);
    fw_svg_put(out,
               "path d='M{c} {c}v-5M{c} {c}h{c}v-5' fill='none' stroke='#444' stroke-width='1.5'",
               x, y, x, y, px);
    fw_svg_put(out, "text x='{c}' y='{c}' text-anchor='middle' font-size='11' fill='#444'>{u}",
               x + 0.5 * px, y - 7.0, length, "m");
    fw_svg_close(out, "g\n");
}

enum { WIDTH = 640, LEGEND_HEIGHT = 30, MOST_LABELS = 40 };

double fw_report_joint_utilisation(const fw_verdict *verdict, int joint) {
    if (verdict)
        for (int i = 0; i < verdict->nhinge; i++)
            if (verdict->hinge[i].joint == joint) return verdict->hinge[i].utilisation;
    return (double)NAN;
}

static void fixed_parts(const fw_layout *layout, const fw_report_view *view, bool ids,
                        fw_text *out) {
    fw_svg_open(out, "g fill='#eceff2' stroke='#b6bec7' stroke-width='0.7'");
    fw_svg_path(out, ids ? "id='fw-fixed'" : "");
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role == FW_ROLE_FRAME ||
            ((p->body == FW_GROUND || p->body == FW_ISLAND) && p->role == FW_ROLE_STRUCTURE))
            fw_report_path(out, view, &p->contour);
    }
    fw_svg_finish(out, "/>");
    fw_svg_close(out, "g\n");
}

/* in a path of their own: figures that move leave them out */
static void tethers(const fw_layout *layout, const fw_report_view *view, fw_text *out) {
    bool any = false;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_TETHER) continue;
        if (!any)
            fw_svg_path(out, "class='tethers' fill='#eceff2' stroke='#b6bec7' stroke-width='0.7'");
        any = true;
        fw_report_path(out, view, &p->contour);
    }
    if (any) fw_svg_path_end(out);
}

static void bodies(const fw_device *device, const fw_layout *layout, const fw_report_view *view,
                   bool ids, fw_text *out) {
    for (int b = 0; b < device->nbody; b++) {
        fw_svg_open(out, "g fill='{r}' stroke='#57606a' stroke-width='0.7'",
                    device->body[b].platform ? "#bcd0e3" : "#d5dbe1");
        fw_svg_path(out, ids ? "id='fw-b{i}'" : "", b);
        fw_report_body_path(layout, b, view, out);
        fw_svg_finish(out, "/>");
        fw_svg_close(out, "g\n");
    }
}

/* nothing is drawn: everything as in figure.h but the joints, which hinges() colours. Bodies are
   paths of their own, without a look, so that figures that move may <use> them; grey, because
   colours stand for utilisation here. */
static fw_status schematic(const fw_device *device, const fw_verdict *verdict,
                           const fw_report_view *view, bool ids, fw_text *out) {
    fw_report_drawing_figure figure = {0};
    double *q;
    FW_TRY(fw_report_figure_of_verdict(out->arena, verdict, &figure, &q));
    const fw_report_figure_pen pen = {
        .view = view, .out = out, .still = q, .nbody = device->nbody, .mark = 5.5};
    for (int b = 0; q && b < device->nbody; b++) {
        const fw_report_figure_part *body = NULL;
        for (int i = 0; i < figure.count; i++)
            if (figure.part[i].role == FW_FIGURE_BODY && figure.part[i].of == b)
                body = &figure.part[i];
        fw_svg_open(out,
                    "g fill='#8c959f' fill-opacity='0.25' stroke='{r}' stroke-width='5' "
                    "stroke-linecap='round' stroke-linejoin='round'",
                    device->body[b].platform ? "#7f9fbd" : "#8c959f");
        fw_svg_path(out, ids ? "id='fw-b{i}'" : "", b);
        if (body)
            fw_report_figure_path(body, &pen, q);
        else
            fw_markup(out, "M{c} {c}h14v8h-14Z", fw_report_x(view, q[3 * b]) - 7.0,
                      fw_report_y(view, q[3 * b + 1]) - 4.0);
        fw_svg_finish(out, "/>");
        fw_svg_close(out, "g\n");
    }
    for (int i = 0; i < figure.count; i++) {
        fw_report_figure_role role = figure.part[i].role;
        if (role != FW_FIGURE_BODY && role != FW_FIGURE_PLATE && role != FW_FIGURE_PIN)
            fw_report_figure_draw(&figure.part[i], &pen);
    }
    return FW_OK;
}

static void hinges(const fw_device *device, const fw_layout *layout, const fw_verdict *verdict,
                   const fw_report_view *view, fw_text *out) {
    if (fw_report_drawn(layout))
        for (int i = 0; i < layout->npiece; i++) {
            const fw_layout_piece *p = &layout->piece[i];
            if (p->role != FW_ROLE_FLEXURE) continue;
            const char *colour =
                fw_report_utilisation_colour(fw_report_joint_utilisation(verdict, p->joint));
            fw_svg_path(out, "fill='{r}' stroke='{r}' stroke-width='1.2'", colour, colour);
            fw_report_path(out, view, &p->contour);
            fw_svg_path_end(out);
        }
    for (int j = 0; j < device->nrevolute; j++) {
        bool flexure = fw_report_drawn(layout) && layout->hinge && layout->hinge[j].drawn;
        fw_geometry_vec2 p = fw_report_hinge_point(device, layout, j);
        fw_svg_put(out,
                   "circle cx='{c}' cy='{c}' r='{c}' fill='{r}' stroke='#fff' stroke-width='1'\n",
                   fw_report_x(view, p.x), fw_report_y(view, p.y), flexure ? 2.2 : 5.0,
                   fw_report_utilisation_colour(fw_report_joint_utilisation(verdict, j)));
    }
}

/* px that a name and its share take, at 13 px */
static double label_room(const char *id, double utilisation) {
    const double least = 62.0, letter = 7.7;
    double letters = (double)strlen(id);
    char used[32];
    if (isfinite(utilisation)) /* three digits, zeros too; " " and " %" */
        letters += 3 + fmax(4, (double)strlen(fw_percent_text(used, sizeof used, utilisation)));
    return fmax(least, letter * letters);
}

/* names stand outside the mechanism, away from the middle of the hinge points */
static void hinge_labels(const fw_device *device, const fw_layout *layout,
                         const fw_verdict *verdict, const fw_report_view *view, fw_text *out) {
    if (device->nrevolute > MOST_LABELS) return;
    double mx = 0.0, my = 0.0;
    for (int j = 0; j < device->nrevolute; j++) {
        fw_geometry_vec2 p = fw_report_hinge_point(device, layout, j);
        mx += fw_report_x(view, p.x) / device->nrevolute;
        my += fw_report_y(view, p.y) / device->nrevolute;
    }
    for (int j = 0; j < device->nrevolute; j++) {
        fw_geometry_vec2 p = fw_report_hinge_point(device, layout, j);
        double x = fw_report_x(view, p.x), y = fw_report_y(view, p.y);
        double dx = x - mx, dy = y - my, d = hypot(dx, dy);
        double away = 20.0;
        if (fw_report_drawn(layout) && layout->hinge && isfinite(layout->hinge[j].keep_out_m))
            away = fmax(away, layout->hinge[j].keep_out_m * view->scale + 6.0);
        dx = d > 1e-9 ? dx / d : 1.0;
        dy = d > 1e-9 ? dy / d : 0.0;
        double side = fabs(dx) < 0.35 ? 0.0 : dx, tx = x + away * dx;
        double u = fw_report_joint_utilisation(verdict, j);
        double room = label_room(device->revolute[j].id, u);
        tx = side > 0.0   ? fmin(tx, view->width - room)
             : side < 0.0 ? fmax(tx, room)
                          : fmax(0.6 * room, fmin(view->width - 0.6 * room, tx));
        double ty = fmax(14.0, fmin(view->height - 8.0, y + away * dy + 4.0));
        double bar = scale_bar_m(view) * view->scale + 32.0; /* the scale bar's corner */
        if (tx + room > view->width - bar) ty = fmin(ty, view->height - 42.0);
        fw_svg_open(out,
                    "text x='{c}' y='{c}' font-size='13' text-anchor='{r}' fill='#1f2328' "
                    "stroke='#fff' stroke-width='3' paint-order='stroke'",
                    tx, ty,
                    side > 0.0   ? "start"
                    : side < 0.0 ? "end"
                                 : "middle");
        fw_svg_put(out, "tspan font-weight='700'>{s}", device->revolute[j].id);
        if (isfinite(u)) fw_markup(out, " {p}", u);
        fw_svg_close(out, "text\n");
    }
}

static void body_labels(const fw_device *device, const fw_layout *layout,
                        const fw_report_view *view, fw_text *out) {
    if (!fw_report_drawn(layout) || !layout->body || device->nbody > MOST_LABELS) return;
    for (int b = 0; b < device->nbody; b++) {
        if (!(layout->body[b].area_m2 > 0.0)) continue;
        fw_geometry_vec2 c = layout->body[b].centroid;
        fw_svg_put(
            out,
            "text x='{c}' y='{c}' font-size='10.5' text-anchor='middle' fill='#424a53' "
            "stroke='#fff' stroke-opacity='0.8' stroke-width='2.5' paint-order='stroke'>{s}\n",
            fw_report_x(view, c.x), fw_report_y(view, c.y) + 3.5, device->body[b].id);
    }
}

fw_status fw_report_legend_height(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_verdict *verdict, double *height) {
    fw_report_marks marks;
    FW_TRY(fw_report_marks_of(arena, device, layout, verdict, &marks));
    *height = LEGEND_HEIGHT + fw_report_marks_height(&marks);
    return FW_OK;
}

fw_status fw_report_drawing(const fw_device *device, const fw_layout *layout,
                            const fw_verdict *verdict, const fw_report_view *view, bool ids,
                            fw_text *out) {
    fw_report_marks marks;
    FW_TRY(fw_report_marks_of(out->arena, device, layout, verdict, &marks));
    if (fw_report_drawn(layout)) {
        fixed_parts(layout, view, ids, out);
        tethers(layout, view, out);
        bodies(device, layout, view, ids, out);
    } else
        FW_TRY(schematic(device, verdict, view, ids, out));
    hinges(device, layout, verdict, view, out);
    fw_report_actuators_svg(device, layout, view, out);
    fw_report_marks_svg(device, layout, &marks, view, out);
    body_labels(device, layout, view, out);
    hinge_labels(device, layout, verdict, view, out);
    fw_report_marks_tags(device, layout, &marks, view, out);
    fw_report_scale_bar_svg(out, view);
    fw_svg_open(out, "g font-size='11' fill='#424a53'");
    fw_svg_put(out, "rect y='{c}' width='{c}' height='{c}' fill='#fff'\n", view->height,
               view->width, 60.0 + fw_report_marks_height(&marks));
    static const double place[CLASSES] = {10.0, 118.0, 220.0, 330.0, 456.0};
    double size = view->width / WIDTH;
    for (int i = 0; i < CLASSES; i++) {
        fw_svg_put(out, "rect x='{c}' y='{c}' width='12' height='12' rx='2' fill='{r}'",
                   place[i] * size, view->height + 10.0, utilisation_class[i].colour);
        fw_svg_put(out, "text x='{c}' y='{c}'>{r}\n", place[i] * size + 18.0, view->height + 20.0,
                   utilisation_class[i].label);
    }
    FW_TRY(
        fw_report_marks_legend(out->arena, &marks, view->width, view->height + LEGEND_HEIGHT, out));
    fw_svg_close(out, "g\n");
    return FW_OK;
}

fw_status fw_report_device_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_verdict *verdict, fw_text *out) {
    fw_report_view view = fw_report_device_view(device, layout, NULL, WIDTH);
    if (!fw_report_drawn(layout)) {
        fw_geometry_box box = fw_report_box_empty();
        FW_TRY(fw_report_figure_rest_reach(arena, verdict, &box));
        if (box.x1 >= box.x0) view = fw_report_figure_view(&box, WIDTH);
    }
    double legend;
    FW_TRY(fw_report_legend_height(arena, device, layout, verdict, &legend));
    fw_svg_begin_picture(out, view.width, view.height + legend, true);
    fw_svg_title(out, "{r}{s}: hinges coloured by utilisation", fw_report_rejected(verdict),
                 device->name);
    fw_svg_paper(out, "#fff");
    FW_TRY(fw_report_drawing(device, layout, verdict, &view, false, out));
    if (*fw_report_rejected(verdict))
        fw_svg_put(out,
                   "text x='{c}' y='22' font-size='18' font-weight='700' text-anchor='end' "
                   "fill='{r}'>REJECTED\n",
                   view.width - 10.0, fw_report_decision_colour(FW_REJECT));
    else if (layout && layout->nfault > 0)
        fw_svg_put(
            out,
            "text x='{c}' y='22' font-size='18' font-weight='700' text-anchor='end' "
            "fill='{r}' stroke='#fff' stroke-width='3' paint-order='stroke'>CANNOT BE MADE\n",
            view.width - 10.0, fw_report_decision_colour(FW_REJECT));
    fw_svg_end(out);
    return fw_text_end(out);
}
