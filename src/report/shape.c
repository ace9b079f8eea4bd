/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include "geometry/svg.h"
#include <math.h>

bool fw_report_drawn(const fw_layout *layout) {
    return layout && layout->drawn && layout->npiece;
}

bool fw_report_outlined(const fw_layout *layout, int body) {
    return body >= 0 && fw_report_drawn(layout) && layout->body && layout->body[body].area_m2 > 0.0;
}

fw_box fw_report_box_empty(void) {
    return (fw_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
}

void fw_report_box_add(fw_box *box, double x_m, double y_m) {
    if (!isfinite(x_m) || !isfinite(y_m)) return;
    box->x0 = fmin(box->x0, x_m);
    box->x1 = fmax(box->x1, x_m);
    box->y0 = fmin(box->y0, y_m);
    box->y1 = fmax(box->y1, y_m);
}

fw_report_view fw_report_view_fit(fw_box box, double width, double pad_m) {
    if (!(box.x1 >= box.x0) || !(box.y1 >= box.y0)) box = (fw_box){0.0, 0.0, 1e-3, 1e-3};
    double wide = box.x1 - box.x0 + 2.0 * pad_m, high = box.y1 - box.y0 + 2.0 * pad_m;
    double size = fmax(wide, high);
    if (!(size > 0.0)) size = 1e-3;
    wide = fmax(wide, 0.25 * size);
    high = fmax(high, 0.25 * size);
    fw_report_view view = {.width = width};
    view.scale = fmin(width / wide, 1.25 * width / high); /* never taller than 5:4 */
    view.height = ceil(high * view.scale);
    view.x0_m = 0.5 * (box.x0 + box.x1) - 0.5 * width / view.scale;
    view.y1_m = 0.5 * (box.y0 + box.y1) + 0.5 * view.height / view.scale;
    return view;
}

double fw_report_x(const fw_report_view *view, double x_m) {
    return (x_m - view->x0_m) * view->scale;
}

double fw_report_y(const fw_report_view *view, double y_m) {
    return (view->y1_m - y_m) * view->scale;
}

void fw_report_path(fw_text *out, const fw_report_view *view, const fw_contour *contour) {
    const fw_geometry_sheet sheet = {view->x0_m, view->y1_m, view->scale, 2,
                                     FW_GEOMETRY_ARC_PICTURE};
    fw_geometry_svg_contour(out, &sheet, contour);
}

fw_vec2 fw_report_hinge_point(const fw_device *device, const fw_layout *layout, int joint) {
    if (fw_report_drawn(layout) && layout->hinge && layout->hinge[joint].drawn)
        return layout->hinge[joint].centre;
    return (fw_vec2){device->joint[joint].x_m, device->joint[joint].y_m};
}

static fw_box rest_box(const fw_device *device, const fw_layout *layout) {
    fw_box box = fw_report_box_empty();
    for (int j = 0; j < device->njoint; j++) {
        fw_vec2 p = fw_report_hinge_point(device, layout, j);
        fw_report_box_add(&box, p.x, p.y);
    }
    for (int b = 0; b < device->nbody; b++)
        fw_report_box_add(&box, device->body[b].x_m, device->body[b].y_m);
    if (fw_report_drawn(layout) && !(fmax(box.x1 - box.x0, box.y1 - box.y0) > 0.0))
        for (int i = 0; i < layout->npiece; i++) {
            fw_box b = fw_contour_box(&layout->piece[i].contour);
            fw_report_box_add(&box, b.x0, b.y0);
            fw_report_box_add(&box, b.x1, b.y1);
        }
    return box;
}

/* what moves, as drawn, and where the names of hinges stand: beside the circle that each keeps free
 */
static void add_outlines(const fw_device *device, const fw_layout *layout, double label_m,
                         fw_box *box) {
    if (!fw_report_drawn(layout)) return;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_STRUCTURE || p->body < 0) continue;
        fw_box b = fw_contour_box(&p->contour);
        fw_report_box_add(box, b.x0 - 0.2 * label_m, b.y0 - 0.2 * label_m);
        fw_report_box_add(box, b.x1 + 0.2 * label_m, b.y1 + 0.2 * label_m);
    }
    for (int j = 0; layout->hinge && j < device->njoint; j++) {
        if (!layout->hinge[j].drawn || !isfinite(layout->hinge[j].keep_out_m)) continue;
        fw_vec2 p = layout->hinge[j].centre;
        double x = layout->hinge[j].keep_out_m + label_m;
        fw_report_box_add(box, p.x - x, p.y);
        fw_report_box_add(box, p.x + x, p.y);
    }
}

/* hinge points, centres of the bodies, and room for links around them, less where they only pass;
   tethers, which reach to the frame, run out of the picture */
fw_report_view fw_report_device_view(const fw_device *device, const fw_layout *layout,
                                     const fw_box *reach, double width) {
    fw_box box = rest_box(device, layout);
    double size = fmax(box.x1 - box.x0, box.y1 - box.y0);
    if (!isfinite(size) || !(size > 0.0)) return fw_report_view_fit(box, width, 0.0);
    double pad = 0.2 * size, less = 0.1 * size;
    box = (fw_box){box.x0 - pad, box.y0 - pad, box.x1 + pad, box.y1 + pad};
    add_outlines(device, layout, 0.18 * size, &box);
    fw_box led = fw_report_box_empty();
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

double fw_report_scale_bar(const fw_report_view *view) {
    return fw_svg_nice(0.1 * view->width / view->scale);
}

void fw_report_scale_bar_svg(fw_text *out, const fw_report_view *view) {
    double length = fw_report_scale_bar(view), px = length * view->scale;
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
