/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of statics: the equilibrium, the path to it, and modes about it. */
#include "base/constants.h"
#include "report/report_page.h"
#include "report/report.h"
#include <math.h>
#include <string.h>

/* ---- a path in words ---- */

const char *fw_report_path_mark(fw_statics_path_mark mark) {
    static const char *const text[] = {"point", "limit point", "bifurcation", "switch", "end"};
    return text[mark];
}

int fw_report_path_second(const fw_statics_path *p) {
    for (int i = 1; i + 1 < p->count; i++)
        if (p->mark[i] == FW_PATH_FOLD && p->negative[i - 1] > 0 && p->negative[i + 1] == 0)
            return i;
    return FW_NONE;
}

/* The mechanism under its loads, over the pose at rest. */

enum { WIDTH = 720, HEAD = 38, FRAMES = 120, SECONDS = 8, ARROW = 70 };

typedef struct picture {
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    const fw_dynamics_motion *motion;
    const fw_report_view *view;
    fw_text *out;
} picture;

/* factor of a load at the scene's end, where statics takes it */
static double at_end(const picture *p, const fw_quantity_law *law) {
    double value[3] = {1.0, 0.0, 0.0}, end = p->scene->duration_s;
    if (law) fw_quantity_law_value(law, end, end * (1.0 - 1e-9), value);
    return value[0];
}

static fw_geometry_vec2 place(const picture *p, int body, double x, double y) {
    double pose[3];
    fw_report_pose_at(p->motion, body, 1.0, pose);
    double c = cos(pose[2]), s = sin(pose[2]);
    fw_geometry_vec2 w = {pose[0] + c * x - s * y, pose[1] + s * x + c * y};
    return (fw_geometry_vec2){fw_report_x(p->view, w.x), fw_report_y(p->view, w.y)};
}

static void label(const picture *p, double x, double y, double value, const char *unit) {
    x = fmax(6.0, fmin(p->view->width - 70.0, x));
    fw_svg_put(p->out,
               "text x='{c}' y='{c}' font-size='12' fill='#B03A00' stroke='#fff' stroke-width='3' "
               "paint-order='stroke'>{u}\n",
               x, fmax(12.0, y), value, unit);
}

/* the arrow ends at the point of the force; false: there is none */
static bool arrow_ends(const picture *p, const fw_device_force *f, double largest,
                       fw_geometry_vec2 *tail, fw_geometry_vec2 *tip) {
    double factor = at_end(p, f->law), fx = factor * f->fx_N, fy = factor * f->fy_N;
    double size = hypot(fx, fy), far = ARROW * (0.35 + 0.65 * size / largest);
    if (f->body == FW_GROUND || !(size > 0.0)) return false;
    *tip = place(p, f->body, f->x_m, f->y_m);
    *tail = (fw_geometry_vec2){tip->x - far * fx / size, tip->y + far * fy / size};
    return true;
}

static double largest_force(const picture *p) {
    double largest = 0.0;
    for (int i = 0; i < p->scene->nforce; i++) {
        const fw_device_force *f = &p->scene->force[i];
        largest = fmax(largest, fabs(at_end(p, f->law)) * hypot(f->fx_N, f->fy_N));
    }
    return largest;
}

/* adds the tails of the arrows as a view places them, and room for their labels */
static void arrows_reach(const picture *p, fw_geometry_box *box) {
    double largest = largest_force(p);
    for (int i = 0; i < p->scene->nforce; i++) {
        fw_geometry_vec2 tail, tip;
        if (!arrow_ends(p, &p->scene->force[i], largest, &tail, &tip)) continue;
        for (int k = 0; k < 2; k++)
            fw_report_box_add(box, p->view->x0_m + (tail.x + (k ? 40.0 : 0.0)) / p->view->scale,
                              p->view->y1_m - (tail.y - (k ? 8.0 : 0.0)) / p->view->scale);
    }
}

static void arrow(const picture *p, const fw_device_force *f, double largest) {
    fw_geometry_vec2 tail, tip;
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

static void torque(const picture *p, const fw_device_torque *t) {
    double value = at_end(p, t->law) * t->value_Nm, r = 17.0;
    if (value == 0.0) return;
    fw_geometry_vec2 c = place(p, t->body, 0.0, 0.0);
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
    const fw_device_scene *s = p->scene;
    double largest = largest_force(p);
    for (int i = 0; i < s->nforce; i++)
        arrow(p, &s->force[i], largest);
    for (int i = 0; i < s->ntorque; i++)
        if (s->torque[i].body != FW_GROUND) torque(p, &s->torque[i]);
}

/* rest and equilibrium, or the points of the path */
static fw_status poses(fw_arena *arena, const fw_mechanism *m, const fw_statics *s,
                       fw_dynamics_motion *motion) {
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
                                const fw_mechanism *mechanism, const fw_device_scene *scene,
                                const fw_statics *statics, fw_text *out) {
    fw_dynamics_motion motion;
    bool moves = statics->path && statics->path->complete;
    FW_TRY(poses(arena, mechanism, statics, &motion));
    fw_geometry_box box = fw_report_box_empty();
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
    fw_svg_begin_picture(out, view.width, height, true);
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

/* Load factor against the coordinate that tells the path best. */

enum { PATH_WIDTH = 640, HEIGHT = 460, LEFT = 62, RIGHT = 22, TOP = 48, BOTTOM = 66 };

typedef struct plot {
    const fw_statics *statics;
    const fw_statics_path *path;
    const char *what, *unit; /* of the abscissa */
    const double *value;     /* with `stride` between points */
    size_t stride;
    double zero, factor; /* shown = (value - zero) factor */
    fw_svg_axes axes;
    fw_text *out;
} plot;

static double shown(const plot *p, int i) {
    return (p->value[(size_t)i * p->stride] - p->zero) * p->factor;
}

static double spread(const double *value, size_t stride, int count) {
    double least = value[0], most = value[0];
    for (int i = 1; i < count; i++) {
        least = fmin(least, value[(size_t)i * stride]);
        most = fmax(most, value[(size_t)i * stride]);
    }
    return most - least;
}

/* the platform's way; without a platform the joint that turns most, or the body that moves most */
static fw_status choose(fw_arena *arena, const fw_device *device, const fw_mechanism *m, plot *p) {
    const fw_statics_path *path = p->path;
    size_t n = 3 * (size_t)path->nbody, pins = (size_t)path->npin;
    int body = FW_NONE;
    for (int b = 0; b < device->nbody && b < path->nbody; b++)
        if (device->body[b].platform) body = b;
    double best = -1.0;
    for (int b = 0; b < path->nbody; b++) {
        if (body != FW_NONE ? b != body : pins > 0) continue;
        for (int c = 0; c < 2; c++) {
            double now = spread(path->q + 3 * b + c, n, path->count);
            if (now <= best) continue;
            best = now;
            *p = (plot){.statics = p->statics,
                        .path = path,
                        .unit = "\u00b5m",
                        .value = path->q + 3 * b + c,
                        .stride = n,
                        .factor = 1e6,
                        .out = p->out};
            FW_NEED(p->what =
                        fw_arena_printf(arena, "%s of %s from rest", c ? "y" : "x", m->body[b].id));
        }
    }
    if (best < 0.0) {
        int widest = 0;
        for (int i = 1; i < path->npin; i++)
            if (spread(path->angle_rad + i, pins, path->count) >
                spread(path->angle_rad + widest, pins, path->count))
                widest = i;
        *p = (plot){.statics = p->statics,
                    .path = path,
                    .unit = "\u00b0",
                    .value = path->angle_rad + widest,
                    .stride = pins,
                    .factor = 180.0 / FW_PI,
                    .out = p->out};
        FW_NEED(p->what = fw_arena_printf(arena, "angle of %s from rest", m->pin[widest].id));
    }
    p->zero = p->value[0];
    return FW_OK;
}

static void range(plot *p) {
    fw_svg_axes a = {.left = LEFT,
                     .right = PATH_WIDTH - RIGHT,
                     .top = TOP,
                     .bottom = HEIGHT - BOTTOM,
                     .y1 = 1.0,
                     .columns = 7,
                     .rows = 7};
    for (int i = 0; i < p->path->count; i++) {
        double x = shown(p, i), y = p->path->factor[i];
        a.x0 = fmin(a.x0, x), a.x1 = fmax(a.x1, x);
        a.y0 = fmin(a.y0, y), a.y1 = fmax(a.y1, y);
    }
    double wide = a.x1 > a.x0 ? a.x1 - a.x0 : 1.0, high = a.y1 - a.y0;
    a.x0 -= 0.06 * wide, a.x1 += 0.06 * wide;
    a.y0 -= 0.06 * high, a.y1 += 0.1 * high;
    p->axes = a;
}

static void axes(const plot *p) {
    fw_svg_open(p->out, "g font-size='11' fill='#57606a'\n");
    fw_svg_grid(p->out, &p->axes);
    fw_svg_put(p->out, "text x='{c}' y='{c}' text-anchor='end'>{s} ({r})", p->axes.right,
               p->axes.bottom + 34.0, p->what, p->unit);
    fw_svg_put(p->out,
               "text x='16' y='{i}' text-anchor='end' transform='rotate(-90 16 {i})'>load factor",
               TOP, TOP);
    fw_svg_close(p->out, "g\n");
}

/* stable between two points? Where a point is itself the change, the other one knows */
static bool stable(const plot *p, int i) {
    const fw_statics_path *path = p->path;
    bool turning = path->mark[i - 1] == FW_PATH_FOLD || path->mark[i - 1] == FW_PATH_BIFURCATION;
    return path->negative[turning ? i : i - 1] == 0;
}

static void curve(const plot *p) {
    for (int i = 1; i < p->path->count;) {
        bool good = stable(p, i);
        fw_svg_path(p->out,
                    good ? "fill='none' stroke='#0072B2' stroke-width='2' stroke-linejoin='round'"
                         : "fill='none' stroke='#D55E00' stroke-width='2' stroke-linejoin='round' "
                           "stroke-dasharray='6 4'");
        fw_markup(p->out, "M{c} {c}L", fw_svg_axes_x(&p->axes, shown(p, i - 1)),
                  fw_svg_axes_y(&p->axes, p->path->factor[i - 1]));
        for (bool first = true; i < p->path->count && stable(p, i) == good; i++, first = false)
            fw_markup(p->out, "{r}{c} {c}", first ? "" : " ", fw_svg_axes_x(&p->axes, shown(p, i)),
                      fw_svg_axes_y(&p->axes, p->path->factor[i]));
        fw_svg_path_end(p->out);
    }
}

static void marks(const plot *p) {
    const fw_statics_path *path = p->path;
    for (int i = 0; i < path->count; i++) {
        if (path->mark[i] == FW_PATH_POINT) continue;
        double x = fw_svg_axes_x(&p->axes, shown(p, i)),
               y = fw_svg_axes_y(&p->axes, path->factor[i]);
        bool left = x > 0.6 * PATH_WIDTH, low = path->factor[i] < 0.5 * (p->axes.y0 + p->axes.y1);
        const char *shape = path->mark[i] == FW_PATH_FOLD ? "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z"
                            : path->mark[i] == FW_PATH_BIFURCATION ? "M-6 0L0-6L6 0L0 6z"
                            : path->mark[i] == FW_PATH_SWITCH
                                ? "M-4-4h8v8h-8z"
                                : "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z";
        fw_svg_put(p->out,
                   "path transform='translate({c} {c})' d='{r}' fill='{r}' stroke='#1f2328' "
                   "stroke-width='1.5'",
                   x, y, shape, path->mark[i] == FW_PATH_END ? "#1f2328" : "#fff");
        fw_svg_open(p->out,
                    "text x='{c}' y='{c}' font-size='11.5' text-anchor='{r}' fill='#1f2328' "
                    "stroke='#fff' stroke-width='3' paint-order='stroke'",
                    left ? x - 10.0 : x + 10.0, low ? y + 16.0 : y - 8.0, left ? "end" : "start");
        fw_markup(p->out, "{r}",
                  path->mark[i] == FW_PATH_END ? "full load" : fw_report_path_mark(path->mark[i]));
        if (path->which[i] != FW_NONE)
            fw_markup(p->out, " of {s}", p->statics->active[path->which[i]].id);
        if (path->mark[i] != FW_PATH_END) fw_markup(p->out, " at {n}", path->factor[i]);
        fw_svg_close(p->out, "text\n");
    }
}

fw_status fw_report_load_path_svg(fw_arena *arena, const fw_device *device,
                                  const fw_mechanism *mechanism, const fw_device_scene *scene,
                                  const fw_statics *statics, fw_text *out) {
    if (!statics->path || statics->path->count == 0) return FW_USAGE;
    plot p = {.statics = statics, .path = statics->path, .out = out};
    FW_TRY(choose(arena, device, mechanism, &p));
    range(&p);
    fw_svg_begin_picture(out, PATH_WIDTH, HEIGHT, true);
    fw_svg_title(out, "{s}, scene {s}: load path", device->name, scene->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out,
               "text x='{i}' y='26' font-size='15' font-weight='600' fill='#1f2328'>{s}, scene "
               "{s}: load path\n",
               14, device->name, scene->name);
    axes(&p);
    curve(&p);
    marks(&p);
    fw_svg_open(out, "g font-size='11' fill='#57606a'");
    fw_svg_put(out, "path d='M{i} {c}h26' stroke='#0072B2' stroke-width='2'", LEFT, HEIGHT - 14.0);
    fw_svg_put(out, "text x='{i}' y='{c}'>stable", LEFT + 32, HEIGHT - 10.0);
    fw_svg_put(out, "path d='M{i} {c}h26' stroke='#D55E00' stroke-width='2' stroke-dasharray='6 4'",
               LEFT + 90, HEIGHT - 14.0);
    fw_svg_put(out, "text x='{i}' y='{c}'>unstable", LEFT + 122, HEIGHT - 10.0);
    fw_svg_close(out, "g\n");
    fw_svg_end(out);
    return fw_text_end(out);
}

/* Mode shapes over the mechanism: one panel each, every one plays its own period. */

enum {
    PANEL = 330,
    GAP = 10,
    MODE_HEAD = 40,
    CAPTION = 44,
    MODE_FRAMES = 25,
    MODE_SECONDS = 2,
    STILL = 6
};

typedef struct sheet {
    fw_arena *arena;
    const fw_device *device;
    const fw_layout *layout;
    const fw_mechanism *mechanism;
    const fw_statics_modes *modes;
    fw_report_view view;
    fw_text *out;
} sheet;

static int drawn_modes(const fw_statics_modes *modes) {
    int n = 0;
    while (n < modes->count && modes->mode[n].frame)
        n++;
    return n;
}

static void caption(const sheet *s, int k) {
    const fw_statics_mode *m = &s->modes->mode[k];
    double y = s->view.height + 16.0;
    fw_svg_open(s->out, "text x='4' y='{c}' font-size='13' fill='#1f2328'", y);
    fw_svg_put(s->out, "tspan font-weight='700'>{i}", k + 1);
    fw_text_add(s->out, "  ");
    if (m->kind == FW_MODE_OSCILLATION || m->kind == FW_MODE_OVERDAMPED)
        fw_markup(s->out, "{u}, damping {p}", m->f_Hz, "Hz", m->damping_ratio);
    if (m->kind != FW_MODE_OSCILLATION)
        fw_markup(s->out, "{r}{s}", m->omega_rad_per_s > 0 ? ", " : "",
                  fw_statics_mode_kind_text(m->kind));
    if (m->kind == FW_MODE_UNSTABLE)
        fw_markup(s->out, ", grows with {n} 1/s", m->eigenvalue_per_s[0][0]);
    fw_svg_close(s->out, "text");
    fw_svg_put(s->out, "text x='4' y='{c}' font-size='11' fill='#57606a'>moves {s}\n", y + 16.0,
               m->bodies);
}

static fw_status panel(const sheet *s, int k, double x, double y) {
    fw_dynamics_motion motion;
    FW_TRY(
        fw_report_poses(s->arena, s->mechanism, FW_MODE_FRAMES, s->modes->mode[k].frame, &motion));
    const fw_report_film film = {.device = s->device,
                                 .layout = s->layout,
                                 .mechanism = s->mechanism,
                                 .motion = &motion,
                                 .view = &s->view,
                                 .out = s->out,
                                 .frames = MODE_FRAMES,
                                 .seconds = MODE_SECONDS,
                                 .still_s = motion.t_s[STILL],
                                 .ghost = true,
                                 .small = true};
    fw_svg_open(s->out, "g transform='translate({c} {c})'", x, y);
    fw_svg_inset(s->out, "width='{c}' height='{c}' viewBox='0 0 {c} {c}'", s->view.width,
                 s->view.height, s->view.width, s->view.height);
    fw_svg_put(s->out, "rect width='100%' height='100%' fill='#fff' stroke='#d0d7de'\n");
    FW_TRY(fw_report_film_draw(s->arena, &film));
    if (k == 0) fw_report_scale_bar_svg(s->out, &s->view);
    fw_svg_end(s->out);
    caption(s, k);
    fw_svg_close(s->out, "g\n");
    return fw_text_end(s->out);
}

static fw_status reach(sheet *s, int count) {
    fw_geometry_box box = fw_report_box_empty();
    for (int k = 0; k < count; k++) {
        fw_dynamics_motion motion;
        FW_TRY(fw_report_poses(s->arena, s->mechanism, FW_MODE_FRAMES, s->modes->mode[k].frame,
                               &motion));
        FW_TRY(fw_report_poses_reach(s->arena, &box, s->layout, s->mechanism, &motion));
    }
    s->view = fw_report_poses_view(s->device, s->layout, &box, PANEL);
    return FW_OK;
}

fw_status fw_report_modes_svg(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                              const fw_mechanism *mechanism, const fw_device_scene *scene,
                              const fw_statics_modes *modes, fw_text *out) {
    sheet s = {.arena = arena,
               .device = device,
               .layout = layout,
               .mechanism = mechanism,
               .modes = modes,
               .out = out};
    int count = drawn_modes(modes), columns = count < 3 ? (count > 0 ? count : 1) : 3;
    int rows = (count + columns - 1) / columns;
    FW_TRY(reach(&s, count));
    double width = columns * (PANEL + GAP) + GAP, high = s.view.height + CAPTION;
    if (width < 480.0) width = 480.0;
    double height = MODE_HEAD + rows * (high + GAP) + 14.0;
    fw_svg_begin_picture(out, width, height, true);
    fw_svg_title(out, "{s}: modes", device->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(
        out,
        "text x='{i}' y='25' font-size='15' font-weight='600' fill='#1f2328'>{s}: modes {r}{s}\n",
        GAP, device->name,
        modes->at_equilibrium ? "about the equilibrium in scene " : "about rest, scene ",
        scene->name ? scene->name : "");
    for (int k = 0; k < count; k++)
        FW_TRY(panel(&s, k, GAP + (k % columns) * (PANEL + GAP),
                     MODE_HEAD + (k / columns) * (high + GAP)));
    fw_svg_open(out, "text x='{i}' y='{c}' font-size='11' fill='#57606a'", GAP, height - 8.0);
    fw_markup(out, "{r}",
              count ? "Amplitudes are enlarged; dashed: the pose of rest."
                    : "Joints and drivers leave nothing free to oscillate.");
    if (count < modes->count) fw_markup(out, " The first {i} of {i} modes.", count, modes->count);
    fw_svg_close(out, "text\n");
    fw_svg_end(out);
    return fw_text_end(out);
}
