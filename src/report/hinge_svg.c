/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One panel per hinge: the flexure with its surfaces, and drift and gap against the angle. */
#include "report/page.h"
#include "base/constants.h"
#include <math.h>

enum { WIDTH = 760, HIGH = 232, HEADING = 62, SKETCH = 200, LEFT = 262, RIGHT = 18, TOP = 30 };
enum { BOTTOM = 40 };

static const double MICRO = 1e6;
static const char *const blue = "#0072B2", *const green = "#009E73", *const orange = "#D55E00";

typedef struct panel {
    const fw_report_hinge *of;
    const fw_flexure *flexure;
    double y;              /* of its top */
    double x0, x1, y0, y1; /* degrees and um at the edges of the plot */
    fw_text *out;
} panel;

/* ---- the plot ---- */

static double px(const panel *p, double degrees) {
    return LEFT + (WIDTH - LEFT - RIGHT) * (degrees - p->x0) / (p->x1 - p->x0);
}

static double py(const panel *p, double um) {
    return p->y + HIGH - BOTTOM - (HIGH - TOP - BOTTOM) * (um - p->y0) / (p->y1 - p->y0);
}

static void range(panel *p) {
    p->x0 = p->y0 = 0, p->x1 = p->y1 = 0;
    for (int i = 0; i < p->of->npoint; i++) {
        const fw_drift_point *at = &p->of->point[i];
        double drift = at->drift_m * MICRO, left = at->left_m * MICRO;
        p->x0 = fmin(p->x0, at->rotation_rad * FW_DEG_PER_RAD);
        p->x1 = fmax(p->x1, at->rotation_rad * FW_DEG_PER_RAD);
        p->y0 = fmin(p->y0, drift), p->y1 = fmax(p->y1, drift);
        if (p->of->gap_m > 0) p->y0 = fmin(p->y0, left), p->y1 = fmax(p->y1, left);
    }
    if (!(p->x1 > p->x0)) p->x1 = p->x0 + 1;
    double high = p->y1 > p->y0 ? p->y1 - p->y0 : 1;
    p->y0 -= 0.06 * high, p->y1 += 0.08 * high;
}

static int decimals(double step) {
    int n = 0;
    for (; n < 9 && step < 0.999; n++)
        step *= 10;
    return n;
}

static void tick(const panel *p, double x, double y, const char *anchor, double value,
                 double step) {
    fw_report_markup(p->out, "<text x=\"{c}\" y=\"{c}\" text-anchor=\"{r}\">", x, y, anchor);
    if (value < -1e-9 * step) fw_text_add(p->out, "\u2212");
    fw_text_fixed(p->out, fabs(value) < 1e-9 * step ? 0 : fabs(value), decimals(step));
    fw_text_add(p->out, "</text>");
}

static void axes(const panel *p) {
    double bottom = p->y + HIGH - BOTTOM, right = WIDTH - RIGHT, top = p->y + TOP;
    double sx = fw_report_nice((p->x1 - p->x0) / 8), sy = fw_report_nice((p->y1 - p->y0) / 5);
    fw_text_add(p->out, "<g font-size=\"11\" fill=\"#57606a\">\n");
    for (double k = ceil(p->y0 / sy); k * sy <= p->y1; k += 1) {
        fw_report_markup(p->out, "<path d=\"M{i} {c}H{c}\" stroke=\"{r}\"/>", LEFT, py(p, k * sy),
                         right, fabs(k) < 0.5 ? "#8c959f" : "#eaeef2");
        tick(p, LEFT - 7.0, py(p, k * sy) + 4, "end", k * sy, sy);
    }
    for (double k = ceil(p->x0 / sx); k * sx <= p->x1; k += 1) {
        fw_report_markup(p->out, "<path d=\"M{c} {c}V{c}\" stroke=\"{r}\"/>", px(p, k * sx), top,
                         bottom, fabs(k) < 0.5 ? "#8c959f" : "#eaeef2");
        tick(p, px(p, k * sx), bottom + 16, "middle", k * sx, sx);
    }
    fw_report_markup(p->out,
                     "<text x=\"{c}\" y=\"{c}\" text-anchor=\"end\">angle (\u00b0)</text>"
                     "<text x=\"{i}\" y=\"{c}\" text-anchor=\"end\">\u00b5m</text></g>\n",
                     right, bottom + 32, LEFT - 7, top - 8);
}

static void curve(const panel *p, const char *colour, bool gap) {
    fw_report_markup(p->out,
                     "<path fill=\"none\" stroke=\"{r}\" stroke-width=\"2\" "
                     "stroke-linejoin=\"round\" d=\"",
                     colour);
    for (int i = 0; i < p->of->npoint; i++) {
        const fw_drift_point *at = &p->of->point[i];
        fw_report_markup(p->out, "{r}{c} {c}",
                         i == 0   ? "M"
                         : i == 1 ? "L"
                                  : " ",
                         px(p, at->rotation_rad * FW_DEG_PER_RAD),
                         py(p, MICRO * (gap ? at->left_m : at->drift_m)));
    }
    fw_text_add(p->out, "\"/>\n");
}

static void contacts(const panel *p) {
    for (int side = 0; side < 2; side++) {
        double at = p->of->contact_rad[side] * FW_DEG_PER_RAD;
        if (!isfinite(at) || at < p->x0 || at > p->x1) continue;
        fw_report_markup(p->out,
                         "<path d=\"M{c} {c}V{c}\" stroke=\"{r}\" stroke-dasharray=\"5 3\"/>"
                         "<text x=\"{c}\" y=\"{c}\" font-size=\"11\" fill=\"{r}\" "
                         "text-anchor=\"{r}\">surfaces meet</text>\n",
                         px(p, at), p->y + TOP, p->y + HIGH - BOTTOM, orange,
                         px(p, at) + (side ? -5.0 : 5.0), p->y + TOP + 12, orange,
                         side ? "end" : "start");
    }
}

/* ---- the sketch: hinge frame turned to where it lies in the device, W in the middle ---- */

typedef struct sketch {
    double x, y, scale, axis;
} sketch;

static void place(const sketch *s, double along, double across, double at[2]) {
    double c = cos(s->axis), n = sin(s->axis);
    at[0] = s->x + s->scale * (c * along - n * across);
    at[1] = s->y - s->scale * (n * along + c * across);
}

/* an arc about a point, as a line of 48 pieces */
static void arc(const panel *p, const sketch *s, double centre, double r, double from, double to) {
    for (int i = 0; i <= 48; i++) {
        double b = from + (to - from) * i / 48, at[2];
        place(s, centre + r * cos(b), r * sin(b), at);
        fw_report_markup(p->out, "{r}{c} {c}", i == 0 ? "M" : i == 1 ? "L" : " ", at[0], at[1]);
    }
}

static void surfaces(const panel *p, const sketch *s) {
    const fw_hinge *h = p->of->hinge;
    const double *cover = p->of->cover_rad;
    if (!(h->surface_radius_m > 0) || !isfinite(cover[0])) return;
    for (int outer = 0; outer < 2; outer++) {
        fw_report_markup(p->out, "<path fill=\"none\" stroke=\"{r}\" stroke-width=\"1.5\" d=\"",
                         outer ? green : "#57606a");
        arc(p, s, 0, h->surface_radius_m + (outer ? p->of->gap_m : 0), cover[0] - s->axis,
            cover[1] - s->axis);
        fw_text_add(p->out, "\"/>\n");
    }
}

/* outline of a flexure that varies, left edge there and right edge back */
static void outline(const panel *p, const sketch *s, const fw_course *path) {
    enum { PLACES = 24 };
    const char *join = "M";
    double centre = p->of->hinge->closed_form.centre_m, at[2];
    for (int side = 1; side >= -1; side -= 2)
        for (int i = 0; i < path->n; i++)
            for (int k = 0; k <= PLACES; k++) {
                int piece = side > 0 ? i : path->n - 1 - i;
                double part = (double)(side > 0 ? k : PLACES - k) / PLACES;
                fw_vec2 q = fw_path_edge(path, piece, part, side);
                place(s, q.x - centre, q.y, at);
                fw_report_markup(p->out, "{r}{c} {c}", join, at[0], at[1]);
                join = "L";
            }
    fw_text_add(p->out, "Z");
}

static void draw(const panel *p) {
    const fw_hinge *h = p->of->hinge;
    const fw_flexure *f = p->flexure;
    bool bent = f->kind == FW_FLEXURE_CSFH;
    double centre = h->closed_form.centre_m, size = bent ? f->radius_m : 0.5 * f->length_m;
    bool varies = fw_flexure_input_varies(&h->input);
    fw_course path;
    if (varies) {
        fw_flexure_shape shape;
        fw_path_of(&h->input, &path);
        fw_flexure_shape_of(&h->input, &shape);
        size = shape.radius_m, bent = false;
    }
    double reach =
        fmax(size + (bent ? centre : 0), h->surface_radius_m + p->of->gap_m) + 0.5 * f->width_m;
    sketch s = {.x = 20 + 0.5 * SKETCH,
                .y = p->y + TOP + 0.5 * (HIGH - TOP - BOTTOM) + 6,
                .scale = 0.42 * SKETCH / reach,
                .axis = isfinite(h->axis_rad) ? h->axis_rad : 0};
    surfaces(p, &s);
    fw_report_markup(p->out, "<path fill=\"{r}\" stroke=\"#1f2328\" stroke-width=\"{c}\" d=\"",
                     varies ? "#1f2328" : "none", varies ? 0.5 : fmax(1.2, s.scale * f->width_m));
    double from[2], to[2], a = 0.5 * f->angle_rad;
    if (varies)
        outline(p, &s, &path);
    else if (bent)
        arc(p, &s, -centre, f->radius_m, -a, a);
    else {
        place(&s, 0, -size, from), place(&s, 0, size, to);
        fw_report_markup(p->out, "M{c} {c}L{c} {c}", from[0], from[1], to[0], to[1]);
    }
    fw_text_add(p->out, "\"/>\n");
    const double *off = h->closed_form.offset_m;
    double w[2];
    place(&s, off[0], off[1], w);
    fw_report_markup(p->out,
                     "<circle cx=\"{c}\" cy=\"{c}\" r=\"3.5\" fill=\"{r}\"/><text x=\"{c}\" "
                     "y=\"{c}\" font-size=\"11\" fill=\"{r}\">W</text>\n",
                     w[0], w[1], blue, w[0] + 6, w[1] - 5, blue);
}

static void heading(const panel *p) {
    const fw_flexure_result *c = &p->of->hinge->closed_form;
    fw_report_markup(p->out,
                     "<text x=\"14\" y=\"{c}\" font-size=\"13\" font-weight=\"600\" "
                     "fill=\"#1f2328\">{s}{r}{s}</text><text x=\"{i}\" y=\"{c}\" font-size=\"11\" "
                     "fill=\"#57606a\">{u}, limit {d}</text>\n",
                     p->y + 16, p->of->id, p->of->flow ? ", " : "", p->of->flow ? p->of->flow : "",
                     LEFT, p->y + 16, c->stiffness_Nm_per_rad, "N m/rad", c->limit_angle_rad);
}

static void legend(fw_text *out) {
    static const char *const word[] = {"drift of the axis", "left of the gap"};
    const char *const colour[] = {blue, green};
    for (int i = 0; i < 2; i++)
        fw_report_markup(out,
                         "<path d=\"M{i} 46h26\" stroke=\"{r}\" stroke-width=\"2\"/><text "
                         "x=\"{i}\" y=\"50\" font-size=\"11\" fill=\"#57606a\">{r}</text>\n",
                         LEFT + 180 * i, colour[i], LEFT + 180 * i + 32, word[i]);
}

fw_status fw_report_hinges_picture(const fw_device *device, const fw_report_hinge *hinge, int count,
                                   fw_text *out) {
    int height = HEADING + count * HIGH + 8;
    fw_report_markup(out,
                     "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {i} "
                     "{i}\" width=\"{i}\" height=\"{i}\" font-family=\"system-ui,'DejaVu Sans',"
                     "sans-serif\">\n<title>{s}: hinges</title>\n"
                     "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
                     "<text x=\"14\" y=\"26\" font-size=\"15\" font-weight=\"600\" "
                     "fill=\"#1f2328\">{s}: hinges under a pure moment, up to the limit angle"
                     "</text>\n",
                     WIDTH, height, WIDTH, height, device->name, device->name);
    legend(out);
    for (int i = 0; i < count; i++) {
        panel p = {.of = &hinge[i],
                   .flexure = &device->flexure[hinge[i].hinge->flexure],
                   .y = HEADING + i * HIGH,
                   .out = out};
        range(&p);
        heading(&p);
        draw(&p);
        axes(&p);
        if (hinge[i].gap_m > 0) curve(&p, green, true);
        curve(&p, blue, false);
        contacts(&p);
    }
    fw_text_add(out, "</svg>\n");
    return fw_text_end(out);
}

fw_status fw_report_hinges_svg(const fw_device *device, const fw_report_hinge *hinge, int count,
                               fw_text *out) {
    fw_text_add(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    return fw_report_hinges_picture(device, hinge, count, out);
}
