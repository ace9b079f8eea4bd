/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The view of a device: from metres to the coordinates of a picture. */
#include "geometry/contour.h"
#include "report/report_page.h"
#include <math.h>

bool fw_report_drawn(const fw_layout *layout) {
    return layout && (layout->drawn || layout->nfault > 0) && layout->npiece;
}

bool fw_report_outlined(const fw_layout *layout, int body) {
    if (body < 0 || !fw_report_drawn(layout) || !layout->body) return false;
    bool pieces = false; /* of what cannot be made nothing may be measured */
    for (int i = 0; layout->nfault > 0 && i < layout->npiece; i++)
        pieces =
            pieces || (layout->piece[i].body == body && layout->piece[i].role == FW_ROLE_STRUCTURE);
    return pieces || layout->body[body].area_m2 > 0.0;
}

fw_geometry_box fw_report_box_empty(void) {
    return (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
}

void fw_report_box_add(fw_geometry_box *box, double x_m, double y_m) {
    if (!isfinite(x_m) || !isfinite(y_m)) return;
    box->x0 = fmin(box->x0, x_m);
    box->x1 = fmax(box->x1, x_m);
    box->y0 = fmin(box->y0, y_m);
    box->y1 = fmax(box->y1, y_m);
}

double fw_report_whole_pixels(double height) {
    return ceil(height - 1e-6);
}

fw_report_view fw_report_view_fit(fw_geometry_box box, double width, double pad_m) {
    if (!(box.x1 >= box.x0) || !(box.y1 >= box.y0)) box = (fw_geometry_box){0.0, 0.0, 1e-3, 1e-3};
    double wide = box.x1 - box.x0 + 2.0 * pad_m, high = box.y1 - box.y0 + 2.0 * pad_m;
    double size = fmax(wide, high);
    if (!(size > 0.0)) size = 1e-3;
    wide = fmax(wide, 0.25 * size);
    high = fmax(high, 0.25 * size);
    fw_report_view view = {.width = width};
    view.scale = fmin(width / wide, 1.25 * width / high); /* never taller than 5:4 */
    view.height = fw_report_whole_pixels(high * view.scale);
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

void fw_report_path(fw_text *out, const fw_report_view *view, const fw_geometry_contour *contour) {
    const fw_geometry_sheet sheet = {view->x0_m, view->y1_m, view->scale, 2,
                                     FW_GEOMETRY_ARC_PICTURE};
    fw_geometry_svg_contour(out, &sheet, contour);
}

void fw_report_body_path(const fw_layout *layout, int body, const fw_report_view *view,
                         fw_text *out) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->body == body && p->role == FW_ROLE_STRUCTURE) fw_report_path(out, view, &p->contour);
    }
}

fw_geometry_vec2 fw_report_hinge_point(const fw_device *device, const fw_layout *layout,
                                       int joint) {
    if (fw_report_drawn(layout) && layout->hinge && layout->hinge[joint].drawn)
        return layout->hinge[joint].centre;
    return (fw_geometry_vec2){device->revolute[joint].x_m, device->revolute[joint].y_m};
}
