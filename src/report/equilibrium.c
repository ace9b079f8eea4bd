/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanism under its loads, over the pose at rest. */
#include "report/page.h"
#include "report/rest.h"
#include <math.h>
#include <string.h>

enum { WIDTH = 720, HEAD = 38, FRAMES = 120, SECONDS = 8, ARROW = 70 };

typedef struct picture {
    const fw_mechanism *mechanism;
    const fw_scene *scene;
    const fw_motion *motion;
    const fw_report_view *view;
    fw_text *out;
} picture;

/* factor of a load at the scene's end, where statics takes it */
static double at_end(const picture *p, const fw_law *law) {
    double value[3] = {1.0, 0.0, 0.0}, end = p->scene->duration_s;
    if (law) fw_law_value(law, end, end * (1.0 - 1e-9), value);
    return value[0];
}

static fw_vec2 place(const picture *p, int body, double x, double y) {
    double pose[3];
    fw_report_pose_at(p->motion, body, 1.0, pose);
    double c = cos(pose[2]), s = sin(pose[2]);
    fw_vec2 w = {pose[0] + c * x - s * y, pose[1] + s * x + c * y};
    return (fw_vec2){fw_report_x(p->view, w.x), fw_report_y(p->view, w.y)};
}

static void label(const picture *p, double x, double y, double value, const char *unit) {
    x = fmax(6.0, fmin(p->view->width - 70.0, x));
    fw_svg_put(p->out,
               "text x='{c}' y='{c}' font-size='12' fill='#B03A00' stroke='#fff' stroke-width='3' "
               "paint-order='stroke'>{u}\n",
               x, fmax(12.0, y), value, unit);
}

/* the arrow ends at the point of the force; false: there is none */
static bool arrow_ends(const picture *p, const fw_force *f, double largest, fw_vec2 *tail,
                       fw_vec2 *tip) {
    double factor = at_end(p, f->law), fx = factor * f->fx_N, fy = factor * f->fy_N;
    double size = hypot(fx, fy), far = ARROW * (0.35 + 0.65 * size / largest);
    if (f->body == FW_GROUND || !(size > 0.0)) return false;
    *tip = place(p, f->body, f->x_m, f->y_m);
    *tail = (fw_vec2){tip->x - far * fx / size, tip->y + far * fy / size};
    return true;
}

static double largest_force(const picture *p) {
    double largest = 0.0;
    for (int i = 0; i < p->scene->nforce; i++) {
        const fw_force *f = &p->scene->force[i];
        largest = fmax(largest, fabs(at_end(p, f->law)) * hypot(f->fx_N, f->fy_N));
    }
    return largest;
}

/* adds the tails of the arrows as a view places them, and room for their labels */
static void arrows_reach(const picture *p, fw_box *box) {
    double largest = largest_force(p);
    for (int i = 0; i < p->scene->nforce; i++) {
        fw_vec2 tail, tip;
        if (!arrow_ends(p, &p->scene->force[i], largest, &tail, &tip)) continue;
        for (int k = 0; k < 2; k++)
            fw_report_box_add(box, p->view->x0_m + (tail.x + (k ? 40.0 : 0.0)) / p->view->scale,
                              p->view->y1_m - (tail.y - (k ? 8.0 : 0.0)) / p->view->scale);
    }
}

static void arrow(const picture *p, const fw_force *f, double largest) {
    fw_vec2 tail, tip;
    if (!arrow_ends(p, f, largest, &tail, &tip)) return;
    double far = hypot(tip.x - tail.x, tip.y - tail.y);
    double ex = (tip.x - tail.x) / far, ey = (tip.y - tail.y) / far, x = tail.x, y = tail.y;
    double bx = tip.x - 11.0 * ex, by = tip.y - 11.0 * ey;
    double size = fabs(at_end(p, f->law)) * hypot(f->fx_N, f->fy_N);
    fw_svg_put(p->out, "path d='M{c} {c}L{c} {c}' stroke='#D55E00' stroke-width='2.5'", x, y, bx,
               by);
    fw_svg_put(p->out, "path d='M{c} {c}L{c} {c}L{c} {c}Z' fill='#D55E00'\n", tip.x, tip.y,
               bx - 5.0 * ey, by + 5.0 * ex, bx + 5.0 * ey, by - 5.0 * ex);
    label(p, x + 6.0, y - 6.0, size, "N");
}

static void torque(const picture *p, const fw_torque *t) {
    double value = at_end(p, t->law) * t->value_Nm, r = 17.0;
    if (value == 0.0) return;
    fw_vec2 c = place(p, t->body, 0.0, 0.0);
    /* counter-clockwise from below to the left, else to the right: the tip points down there */
    double sign = value > 0.0 ? 1.0 : -1.0;
    fw_svg_put(
        p->out,
        "path d='M{c} {c}A{c} {c} 0 1 {i} {c} {c}' fill='none' stroke='#D55E00' stroke-width='2.5'",
        c.x, c.y + r, r, r, sign > 0.0 ? 0 : 1, c.x - sign * r, c.y);
    fw_svg_put(p->out, "path d='M{c} {c}l-5-10h10Z' fill='#D55E00'\n", c.x - sign * r, c.y + 9.0);
    label(p, c.x + r + 4.0, c.y - 8.0, value, "N\u00b7m");
}

static void loads(const picture *p) {
    const fw_scene *s = p->scene;
    double largest = largest_force(p);
    for (int i = 0; i < s->nforce; i++)
        arrow(p, &s->force[i], largest);
    for (int i = 0; i < s->ntorque; i++)
        if (s->torque[i].body != FW_GROUND) torque(p, &s->torque[i]);
}

/* rest and equilibrium, or the points of the path */
static fw_status poses(fw_arena *arena, const fw_mechanism *m, const fw_statics *s,
                       fw_motion *motion) {
    size_t n = 3 * (size_t)m->nbody;
    if (s->path && s->path->complete)
        return fw_report_poses(arena, m, s->path->count, s->path->q, motion);
    double *q;
    FW_NEED(q = fw_arena_array(arena, double, 2 * n));
    memcpy(q, s->rest_q, n * sizeof *q);
    memcpy(q + n, s->q, n * sizeof *q);
    return fw_report_poses(arena, m, 2, q, motion);
}

fw_status fw_report_statics_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                const fw_mechanism *mechanism, const fw_scene *scene,
                                const fw_statics *statics, fw_text *out) {
    fw_motion motion;
    bool moves = statics->path && statics->path->complete;
    FW_TRY(poses(arena, mechanism, statics, &motion));
    fw_box box = fw_report_box_empty();
    FW_TRY(fw_report_poses_reach(arena, &box, layout, mechanism, &motion));
    fw_report_view view = fw_report_poses_view(device, layout, &box, WIDTH);
    const picture p = {mechanism, scene, &motion, &view, out};
    if (!moves) {
        arrows_reach(&p, &box);
        view = fw_report_poses_view(device, layout, &box, WIDTH);
    }
    const fw_report_film film = {.device = device,
                                 .layout = layout,
                                 .mechanism = mechanism,
                                 .motion = &motion,
                                 .view = &view,
                                 .out = out,
                                 .frames = moves ? FRAMES : 0,
                                 .seconds = SECONDS,
                                 .still_s = 1.0,
                                 .ghost = true};
    double height = HEAD + view.height + 26.0;
    fw_svg_begin(out, &(fw_svg_frame){.width = view.width,
                                      .height = height,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .file = true,
                                      .lead = "role='img'",
                                      .font = fw_svg_font_page});
    fw_svg_title(out, "{s}, scene {s}: equilibrium", device->name, scene->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out, "text x='14' y='25' font-size='14' fill='#1f2328'>{s}, scene {s}: {r}\n",
               device->name, scene->name,
               statics->negative > 0  ? "unstable equilibrium"
               : statics->neutral > 0 ? "indifferent equilibrium"
                                      : "stable equilibrium");
    fw_svg_inset(out, "y='{i}' width='{c}' height='{c}'", HEAD, view.width, view.height);
    FW_TRY(fw_report_film_draw(arena, &film));
    if (!moves) loads(&p);
    fw_report_scale_bar_svg(out, &view);
    fw_svg_end(out);
    fw_svg_put(out, "text x='14' y='{c}' font-size='11' fill='#57606a'>{r}\n", height - 10.0,
               moves ? "From rest (dashed) along the load path to the full load."
                     : "Dashed: unloaded. Arrows: the loads at the end of the scene.");
    fw_svg_end(out);
    return fw_text_end(out);
}
