/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load factor against the coordinate that tells the path best. */
#include "report/page.h"
#include "base/constants.h"
#include "report/rest.h"
#include <math.h>

enum { WIDTH = 640, HEIGHT = 460, LEFT = 62, RIGHT = 22, TOP = 48, BOTTOM = 66 };

typedef struct plot {
    const fw_statics *statics;
    const fw_path *path;
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
    const fw_path *path = p->path;
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
                     .right = WIDTH - RIGHT,
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
    const fw_path *path = p->path;
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
    const fw_path *path = p->path;
    for (int i = 0; i < path->count; i++) {
        if (path->mark[i] == FW_PATH_POINT) continue;
        double x = fw_svg_axes_x(&p->axes, shown(p, i)),
               y = fw_svg_axes_y(&p->axes, path->factor[i]);
        bool left = x > 0.6 * WIDTH, low = path->factor[i] < 0.5 * (p->axes.y0 + p->axes.y1);
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
                                  const fw_mechanism *mechanism, const fw_scene *scene,
                                  const fw_statics *statics, fw_text *out) {
    if (!statics->path || statics->path->count == 0) return FW_USAGE;
    plot p = {.statics = statics, .path = statics->path, .out = out};
    FW_TRY(choose(arena, device, mechanism, &p));
    range(&p);
    fw_svg_begin(out, &(fw_svg_frame){.width = WIDTH,
                                      .height = HEIGHT,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .file = true,
                                      .lead = "role='img'",
                                      .font = fw_svg_font_page});
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
