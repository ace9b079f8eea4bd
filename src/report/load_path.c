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
    double x0, x1, y0, y1;
    fw_text *out;
} plot;

static double shown(const plot *p, int i) {
    return (p->value[(size_t)i * p->stride] - p->zero) * p->factor;
}

static double px(const plot *p, double x) {
    return LEFT + (WIDTH - LEFT - RIGHT) * (x - p->x0) / (p->x1 - p->x0);
}

static double py(const plot *p, double y) {
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (y - p->y0) / (p->y1 - p->y0);
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
            *p = (plot){p->statics, path, NULL, "\u00b5m", path->q + 3 * b + c, n, 0, 1e6, 0,
                        0,          0,    0,    p->out};
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
        *p = (plot){p->statics, path, NULL,          "\u00b0", path->angle_rad + widest,
                    pins,       0,    180.0 / FW_PI, 0,        0,
                    0,          0,    p->out};
        FW_NEED(p->what = fw_arena_printf(arena, "angle of %s from rest", m->pin[widest].id));
    }
    p->zero = p->value[0];
    return FW_OK;
}

static void range(plot *p) {
    p->x0 = p->x1 = 0.0;
    p->y0 = 0.0, p->y1 = 1.0;
    for (int i = 0; i < p->path->count; i++) {
        double x = shown(p, i), y = p->path->factor[i];
        p->x0 = fmin(p->x0, x), p->x1 = fmax(p->x1, x);
        p->y0 = fmin(p->y0, y), p->y1 = fmax(p->y1, y);
    }
    double wide = p->x1 > p->x0 ? p->x1 - p->x0 : 1.0, high = p->y1 - p->y0;
    p->x0 -= 0.06 * wide, p->x1 += 0.06 * wide;
    p->y0 -= 0.06 * high, p->y1 += 0.1 * high;
}

static int decimals(double step) {
    int n = 0;
    for (; n < 12 && step < 0.999; n++)
        step *= 10.0;
    return n;
}

static void tick(const plot *p, double x, double y, const char *anchor, double value, double step) {
    fw_report_markup(p->out, "<text x=\"{c}\" y=\"{c}\" text-anchor=\"{r}\">", x, y, anchor);
    if (value < -1e-9 * step) fw_text_add(p->out, "\u2212");
    fw_text_fixed(p->out, fabs(value) < 1e-9 * step ? 0.0 : fabs(value), decimals(step));
    fw_text_add(p->out, "</text>");
}

static void axes(const plot *p) {
    double bottom = HEIGHT - BOTTOM, right = WIDTH - RIGHT;
    double sx = fw_report_nice((p->x1 - p->x0) / 7.0), sy = fw_report_nice((p->y1 - p->y0) / 7.0);
    fw_text_add(p->out, "<g font-size=\"11\" fill=\"#57606a\">\n");
    for (double k = ceil(p->y0 / sy); k * sy <= p->y1; k += 1.0) {
        double y = py(p, k * sy);
        fw_report_markup(p->out, "<path d=\"M{i} {c}H{c}\" stroke=\"{r}\"/>", LEFT, y, right,
                         fabs(k) < 0.5 ? "#8c959f" : "#eaeef2");
        tick(p, LEFT - 7.0, y + 4.0, "end", k * sy, sy);
    }
    for (double k = ceil(p->x0 / sx); k * sx <= p->x1; k += 1.0) {
        double x = px(p, k * sx);
        fw_report_markup(p->out, "<path d=\"M{c} {i}V{c}\" stroke=\"{r}\"/>", x, TOP, bottom,
                         fabs(k) < 0.5 ? "#8c959f" : "#eaeef2");
        tick(p, x, bottom + 16.0, "middle", k * sx, sx);
    }
    fw_report_markup(p->out,
                     "<text x=\"{c}\" y=\"{c}\" text-anchor=\"end\">{s} ({r})</text><text x=\"16\" "
                     "y=\"{i}\" text-anchor=\"end\" transform=\"rotate(-90 16 {i})\">load factor"
                     "</text></g>\n",
                     right, bottom + 34.0, p->what, p->unit, TOP, TOP);
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
        fw_report_markup(p->out,
                         "<path fill=\"none\" stroke=\"{r}\" stroke-width=\"2\" "
                         "stroke-linejoin=\"round\"{r} d=\"M{c} {c}L",
                         good ? "#0072B2" : "#D55E00", good ? "" : " stroke-dasharray=\"6 4\"",
                         px(p, shown(p, i - 1)), py(p, p->path->factor[i - 1]));
        for (bool first = true; i < p->path->count && stable(p, i) == good; i++, first = false)
            fw_report_markup(p->out, "{r}{c} {c}", first ? "" : " ", px(p, shown(p, i)),
                             py(p, p->path->factor[i]));
        fw_text_add(p->out, "\"/>\n");
    }
}

static void marks(const plot *p) {
    const fw_path *path = p->path;
    for (int i = 0; i < path->count; i++) {
        if (path->mark[i] == FW_PATH_POINT) continue;
        double x = px(p, shown(p, i)), y = py(p, path->factor[i]);
        bool left = x > 0.6 * WIDTH, low = path->factor[i] < 0.5 * (p->y0 + p->y1);
        const char *shape = path->mark[i] == FW_PATH_FOLD ? "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z"
                            : path->mark[i] == FW_PATH_BIFURCATION ? "M-6 0L0-6L6 0L0 6z"
                            : path->mark[i] == FW_PATH_SWITCH
                                ? "M-4-4h8v8h-8z"
                                : "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z";
        fw_report_markup(
            p->out,
            "<path transform=\"translate({c} {c})\" d=\"{r}\" fill=\"{r}\" "
            "stroke=\"#1f2328\" stroke-width=\"1.5\"/><text x=\"{c}\" y=\"{c}\" "
            "font-size=\"11.5\" text-anchor=\"{r}\" fill=\"#1f2328\" stroke=\"#fff\" "
            "stroke-width=\"3\" paint-order=\"stroke\">{r}",
            x, y, shape, path->mark[i] == FW_PATH_END ? "#1f2328" : "#fff",
            left ? x - 10.0 : x + 10.0, low ? y + 16.0 : y - 8.0, left ? "end" : "start",
            path->mark[i] == FW_PATH_END ? "full load" : fw_report_path_mark(path->mark[i]));
        if (path->which[i] != FW_NONE)
            fw_report_markup(p->out, " of {s}", p->statics->active[path->which[i]].id);
        if (path->mark[i] != FW_PATH_END) fw_report_markup(p->out, " at {n}", path->factor[i]);
        fw_text_add(p->out, "</text>\n");
    }
}

fw_status fw_report_load_path_svg(fw_arena *arena, const fw_device *device,
                                  const fw_mechanism *mechanism, const fw_scene *scene,
                                  const fw_statics *statics, fw_text *out) {
    if (!statics->path || statics->path->count == 0) return FW_USAGE;
    plot p = {.statics = statics, .path = statics->path, .out = out};
    FW_TRY(choose(arena, device, mechanism, &p));
    range(&p);
    fw_report_markup(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {i} {i}\" "
        "width=\"{i}\" height=\"{i}\" font-family=\"system-ui,'DejaVu Sans',"
        "sans-serif\">\n<title>{s}, scene {s}: load path</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<text x=\"{i}\" y=\"26\" font-size=\"15\" font-weight=\"600\" "
        "fill=\"#1f2328\">{s}, scene {s}: load path</text>\n",
        WIDTH, HEIGHT, WIDTH, HEIGHT, device->name, scene->name, 14, device->name, scene->name);
    axes(&p);
    curve(&p);
    marks(&p);
    fw_report_markup(out,
                     "<g font-size=\"11\" fill=\"#57606a\"><path d=\"M{i} {c}h26\" "
                     "stroke=\"#0072B2\" stroke-width=\"2\"/><text x=\"{i}\" y=\"{c}\">stable"
                     "</text><path d=\"M{i} {c}h26\" stroke=\"#D55E00\" stroke-width=\"2\" "
                     "stroke-dasharray=\"6 4\"/><text x=\"{i}\" y=\"{c}\">unstable</text></g>\n"
                     "</svg>\n",
                     LEFT, HEIGHT - 14.0, LEFT + 32, HEIGHT - 10.0, LEFT + 90, HEIGHT - 14.0,
                     LEFT + 122, HEIGHT - 10.0);
    return fw_text_end(out);
}
