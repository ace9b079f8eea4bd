/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges on the page: their picture, every model beside the others, and the table of the worst. */
#include "base/constants.h"
#include "report/report_page.h"
#include <math.h>

/* One panel per hinge: the flexure with its surfaces, and drift and gap against the angle. */

enum { WIDTH = 760, HIGH = 232, HEADING = 62, SKETCH = 200, LEFT = 262, RIGHT = 18, TOP = 30 };
enum { BOTTOM = 40 };

static const double MICRO = 1e6;
static const char *const blue = "#0072B2", *const green = "#009E73", *const orange = "#D55E00";

typedef struct panel {
    const fw_report_hinge *of;
    const fw_device_flexure *flexure;
    double y;         /* of its top */
    fw_svg_axes axes; /* degrees and um */
    fw_text *out;
} panel;

/* ---- the plot ---- */

static void range(panel *p) {
    fw_svg_axes a = {.left = LEFT,
                     .right = WIDTH - RIGHT,
                     .top = p->y + TOP,
                     .bottom = p->y + HIGH - BOTTOM,
                     .columns = 8,
                     .rows = 5};
    for (int i = 0; i < p->of->npoint; i++) {
        const fw_flexure_drift_point *at = &p->of->point[i];
        double drift = at->drift_m * MICRO, left = at->left_m * MICRO;
        a.x0 = fmin(a.x0, at->rotation_rad * FW_DEG_PER_RAD);
        a.x1 = fmax(a.x1, at->rotation_rad * FW_DEG_PER_RAD);
        a.y0 = fmin(a.y0, drift), a.y1 = fmax(a.y1, drift);
        if (p->of->gap_m > 0) a.y0 = fmin(a.y0, left), a.y1 = fmax(a.y1, left);
    }
    if (!(a.x1 > a.x0)) a.x1 = a.x0 + 1;
    double high = a.y1 > a.y0 ? a.y1 - a.y0 : 1;
    a.y0 -= 0.06 * high, a.y1 += 0.08 * high;
    p->axes = a;
}

static void axes(const panel *p) {
    fw_svg_open(p->out, "g font-size='11' fill='#57606a'\n");
    fw_svg_grid(p->out, &p->axes);
    fw_svg_put(p->out, "text x='{c}' y='{c}' text-anchor='end'>angle (\u00b0)", p->axes.right,
               p->axes.bottom + 32);
    fw_svg_put(p->out, "text x='{i}' y='{c}' text-anchor='end'>\u00b5m", LEFT - 7, p->axes.top - 8);
    fw_svg_close(p->out, "g\n");
}

static void curve(const panel *p, const char *colour, bool gap) {
    fw_svg_path(p->out, "fill='none' stroke='{r}' stroke-width='2' stroke-linejoin='round'",
                colour);
    for (int i = 0; i < p->of->npoint; i++) {
        const fw_flexure_drift_point *at = &p->of->point[i];
        fw_markup(p->out, "{r}{c} {c}",
                  i == 0   ? "M"
                  : i == 1 ? "L"
                           : " ",
                  fw_svg_axes_x(&p->axes, at->rotation_rad * FW_DEG_PER_RAD),
                  fw_svg_axes_y(&p->axes, MICRO * (gap ? at->left_m : at->drift_m)));
    }
    fw_svg_path_end(p->out);
}

static void contacts(const panel *p) {
    for (int side = 0; side < 2; side++) {
        double at = p->of->contact_rad[side] * FW_DEG_PER_RAD;
        if (!isfinite(at) || at < p->axes.x0 || at > p->axes.x1) continue;
        fw_svg_put(p->out, "path d='M{c} {c}V{c}' stroke='{r}' stroke-dasharray='5 3'",
                   fw_svg_axes_x(&p->axes, at), p->y + TOP, p->y + HIGH - BOTTOM, orange);
        fw_svg_put(
            p->out,
            "text x='{c}' y='{c}' font-size='11' fill='{r}' text-anchor='{r}'>surfaces meet\n",
            fw_svg_axes_x(&p->axes, at) + (side ? -5.0 : 5.0), p->y + TOP + 12, orange,
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
        fw_markup(p->out, "{r}{c} {c}", i == 0 ? "M" : i == 1 ? "L" : " ", at[0], at[1]);
    }
}

static void surfaces(const panel *p, const sketch *s) {
    const fw_mechanism_hinge *h = p->of->hinge;
    const double *cover = p->of->cover_rad;
    if (!(h->surface_radius_m > 0) || !isfinite(cover[0])) return;
    for (int outer = 0; outer < 2; outer++) {
        fw_svg_path(p->out, "fill='none' stroke='{r}' stroke-width='1.5'",
                    outer ? green : "#57606a");
        arc(p, s, 0, h->surface_radius_m + (outer ? p->of->gap_m : 0), cover[0] - s->axis,
            cover[1] - s->axis);
        fw_svg_path_end(p->out);
    }
}

/* outline of a flexure that varies, left edge there and right edge back */
static void outline(const panel *p, const sketch *s, const fw_flexure_course *path) {
    enum { PLACES = 24 };
    const char *join = "M";
    double centre = p->of->hinge->closed_form.centre_m, at[2];
    for (int side = 1; side >= -1; side -= 2)
        for (int i = 0; i < path->n; i++)
            for (int k = 0; k <= PLACES; k++) {
                int piece = side > 0 ? i : path->n - 1 - i;
                double part = (double)(side > 0 ? k : PLACES - k) / PLACES;
                fw_geometry_vec2 q = fw_flexure_path_edge(path, piece, part, side);
                place(s, q.x - centre, q.y, at);
                fw_markup(p->out, "{r}{c} {c}", join, at[0], at[1]);
                join = "L";
            }
    fw_text_add(p->out, "Z");
}

static void draw(const panel *p) {
    const fw_mechanism_hinge *h = p->of->hinge;
    const fw_device_flexure *f = p->flexure;
    bool bent = f->kind == FW_FLEXURE_CSFH;
    double centre = h->closed_form.centre_m, size = bent ? f->radius_m : 0.5 * f->length_m;
    bool varies = fw_flexure_input_varies(&h->input);
    fw_flexure_course path;
    if (varies) {
        fw_flexure_shape shape;
        fw_flexure_path_of(&h->input, &path);
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
    fw_svg_path(p->out, "fill='{r}' stroke='#1f2328' stroke-width='{c}'",
                varies ? "#1f2328" : "none", varies ? 0.5 : fmax(1.2, s.scale * f->width_m));
    double from[2], to[2], a = 0.5 * f->angle_rad;
    if (varies)
        outline(p, &s, &path);
    else if (bent)
        arc(p, &s, -centre, f->radius_m, -a, a);
    else {
        place(&s, 0, -size, from), place(&s, 0, size, to);
        fw_markup(p->out, "M{c} {c}L{c} {c}", from[0], from[1], to[0], to[1]);
    }
    fw_svg_path_end(p->out);
    const double *off = h->closed_form.offset_m;
    double w[2];
    place(&s, off[0], off[1], w);
    fw_svg_put(p->out, "circle cx='{c}' cy='{c}' r='3.5' fill='{r}'", w[0], w[1], blue);
    fw_svg_put(p->out, "text x='{c}' y='{c}' font-size='11' fill='{r}'>W\n", w[0] + 6, w[1] - 5,
               blue);
}

static void heading(const panel *p) {
    const fw_flexure_result *c = &p->of->hinge->closed_form;
    fw_svg_put(p->out,
               "text x='14' y='{c}' font-size='13' font-weight='600' fill='#1f2328'>{s}{r}{s}",
               p->y + 16, p->of->id, p->of->flow ? ", " : "", p->of->flow ? p->of->flow : "");
    fw_svg_put(p->out, "text x='{i}' y='{c}' font-size='11' fill='#57606a'>{u}, limit {d}\n", LEFT,
               p->y + 16, c->stiffness_Nm_per_rad, "N m/rad", c->limit_angle_rad);
}

static void legend(fw_text *out) {
    static const char *const word[] = {"drift of the axis", "left of the gap"};
    const char *const colour[] = {blue, green};
    for (int i = 0; i < 2; i++) {
        fw_svg_put(out, "path d='M{i} 46h26' stroke='{r}' stroke-width='2'", LEFT + 180 * i,
                   colour[i]);
        fw_svg_put(out, "text x='{i}' y='50' font-size='11' fill='#57606a'>{r}\n",
                   LEFT + 180 * i + 32, word[i]);
    }
}

static fw_status picture(const fw_device *device, const fw_report_hinge *hinge, int count,
                         bool file, fw_text *out) {
    int height = HEADING + count * HIGH + 8;
    fw_svg_begin_picture(out, WIDTH, height, file);
    fw_svg_title(out, "{s}: hinges", device->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out,
               "text x='14' y='26' font-size='15' font-weight='600' fill='#1f2328'>{s}: hinges "
               "under a pure moment, up to the limit angle\n",
               device->name);
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
    fw_svg_end(out);
    return fw_text_end(out);
}

/* hinges.c: the same picture as an element of the page */
static fw_status hinges_picture(const fw_device *device, const fw_report_hinge *hinge, int count,
                                fw_text *out) {
    return picture(device, hinge, count, false, out);
}

fw_status fw_report_hinges_svg(const fw_device *device, const fw_report_hinge *hinge, int count,
                               fw_text *out) {
    return picture(device, hinge, count, true, out);
}

/* Every hinge by models of growing fidelity, with what each says of its own error. */

static void within(fw_text *out, double error) {
    fw_text_add(out, " <span class=\"soft\">\u00b1 ");
    fw_markup_number(out, error * 100, 2);
    fw_text_add(out, " %</span></td><td class=\"n\">");
}

static void level(fw_text *out, const fw_report_level *l) {
    fw_markup(out, "<td>{s}</td>", l->name);
    if (l->state != FW_LEVEL_SOLVED) {
        fw_markup(out, "<td colspan=\"7\">not here: {s}</td></tr>\n", l->why);
        return;
    }
    fw_markup(out, "<td class=\"n\">{u}", l->stiffness_Nm_per_rad, "N\u00b7m/rad");
    within(out, l->error.stiffness);
    fw_markup(out, "{u}", l->kx_N_per_m, "N/m");
    within(out, l->error.kx);
    fw_markup(out, "{u}", l->ky_N_per_m, "N/m");
    within(out, l->error.ky);
    fw_text_fixed(out, l->centre_m[0] * 1e6, 2);
    fw_text_add(out, ", ");
    fw_text_fixed(out, l->centre_m[1] * 1e6, 2);
    fw_text_add(out, " <span class=\"soft\">\u00b1 ");
    fw_markup_number(out, l->error.centre_m * 1e6, 2);
    fw_markup(out, "</span></td><td class=\"n\">{n}", l->strain_per_rad);
    within(out, l->error.strain);
    fw_markup(out, "{D}</td><td class=\"n\">", l->limit_angle_rad);
    if (l->drift_m >= 0)
        fw_markup(out, "{u}", l->drift_m, "m");
    else
        fw_text_add(out, "\u2013");
    fw_text_add(out, "</td></tr>\n");
}

static void rows(fw_text *out, const fw_report_hinge *h) {
    for (int k = 0; k < h->nlevel; k++) {
        fw_text_add(out, "<tr>");
        if (k == 0)
            fw_markup(out, "<th scope=\"rowgroup\" rowspan=\"{i}\">{s}{r}{s}</th>", h->nlevel,
                      h->id, h->flow ? ", " : "", h->flow);
        level(out, &h->level[k]);
    }
}

/* hinges.c: table of the hinges by every model, and their picture; nothing without hinges */
static fw_status ladder_section(fw_report_page *page) {
    const fw_report_input *in = page->in;
    fw_text *out = page->out;
    if (in->nhinge == 0) return FW_OK;
    fw_text_add(
        out,
        "<details><summary><h3>The hinges by models of growing fidelity</h3></summary>\n"
        "<div class=\"wide tight\"><table><caption>"
        "What each model says of the flexure and, behind \u00b1, of its own error. Kx is along the "
        "axis of symmetry, Ky across. The compliance model is the hinge at its limit angle, the "
        "others are at rest; drift of the axis under a pure moment is at the limit angle. A solid "
        "model is <code>flexwright hinge --level continuum</code>.</caption><thead><tr>"
        "<th scope=\"col\">Hinge</th><th scope=\"col\">Model</th><th scope=\"col\" "
        "class=\"n\">Stiffness</th><th scope=\"col\" class=\"n\">Kx</th><th scope=\"col\" "
        "class=\"n\">Ky</th><th scope=\"col\" class=\"n\">Elastic centre x, y (\u00b5m)</th>"
        "<th scope=\"col\" class=\"n\">Peak strain per rad</th><th scope=\"col\" class=\"n\">Limit "
        "(\u00b0)</th><th scope=\"col\" class=\"n\">Drift</th></tr></thead><tbody>\n");
    for (int i = 0; i < in->nhinge; i++)
        rows(out, &in->hinge[i]);
    fw_text_add(out, "</tbody></table></div>\n<div class=\"wide\">");
    FW_TRY(hinges_picture(in->device, in->hinge, in->nhinge, out));
    fw_text_add(out, "</div></details>\n");
    return fw_text_end(out);
}

enum { BAR = 150 };
static const double least_told = 2e-4; /* of a part of a band */

static double bar_scale(const fw_verdict_hinge_verdict *hinge, int nhinge) {
    double most = 1.2;
    for (int i = 0; i < nhinge; i++) {
        double u =
            isfinite(hinge[i].utilisation_high) ? hinge[i].utilisation_high : hinge[i].utilisation;
        if (isfinite(u)) most = fmax(most, 1.05 * u);
    }
    return fmin(most, 20.0);
}

/* a bar up to the utilisation, a whisker over its error band, a line at the limit */
static void bar(fw_text *out, const fw_verdict_hinge_verdict *h, double most) {
    if (!isfinite(h->utilisation)) {
        fw_text_add(out, "no limit known");
        return;
    }
    double px = BAR / most, u = fmin(h->utilisation, most);
    fw_svg_begin(out, &(fw_svg_frame){.width = BAR,
                                      .height = 16,
                                      .size = FW_SVG_SIZE_BEFORE,
                                      .lead = "class='bar' role='img'"});
    fw_svg_title(out, "{p} of the limit", h->utilisation);
    fw_svg_put(out, "rect y='3' width='{i}' height='10' fill='#eaeef2'", BAR);
    fw_svg_put(out, "rect y='3' width='{c}' height='10' fill='{r}'", u * px,
               fw_report_utilisation_colour(h->utilisation));
    if (isfinite(h->utilisation_low) && isfinite(h->utilisation_high)) {
        double low = fmin(h->utilisation_low, most) * px;
        double high = fmin(h->utilisation_high, most) * px;
        fw_svg_put(out, "path d='M{c} 8H{c}M{c} 5v6M{c} 5v6' stroke='#1f2328' stroke-width='1.2'",
                   low, high, low, high);
    }
    fw_svg_put(
        out, "path d='M{c} 0v16' stroke='#1f2328' stroke-width='1.5' stroke-dasharray='2 1.5'", px);
    fw_svg_close(out, "svg");
}

static void share(fw_text *out, const char *before, double value) {
    fw_text_add(out, before);
    fw_text_number(out, 100 * value, 2);
}

/* "-1.1 and +0.8 %": what is below a fiftieth of a per cent on its side is left out */
static void both_ways(fw_text *out, const double part[2]) {
    const bool down = part[0] >= least_told, up = part[1] >= least_told;
    if (down) share(out, "-", part[0]);
    if (up) share(out, down ? " and +" : "+", part[1]);
    fw_text_add(out, " %");
}

bool fw_report_band_words(fw_text *out, const fw_verdict_hinge_verdict *h) {
    const fw_verdict_band_parts *p = &h->parts;
    const struct {
        const char *what;
        const double *part;
    } of[] = {{"the law of the peak at a root", p->root},
              {"the stiffness of hinges", p->stiffness},
              {"the next model of the hinges", p->model},
              {"where the moment stands at a root and what blocks give", p->place},
              {"bodies and bases that bend", p->bodies},
              {h->numeric > 0 ? "numbers, less by a tighter --accuracy" : "numbers", p->numbers}};
    enum { PARTS = sizeof of / sizeof *of };
    bool told[PARTS] = {false};
    int n = 0;
    for (; n < PARTS; n++) { /* the widest first */
        int widest = FW_NONE;
        for (int i = 0; i < PARTS; i++)
            if (!told[i] && fmax(of[i].part[0], of[i].part[1]) >= least_told &&
                (widest == FW_NONE ||
                 of[i].part[0] + of[i].part[1] > of[widest].part[0] + of[widest].part[1]))
                widest = i;
        if (widest == FW_NONE) break;
        told[widest] = true;
        fw_text_printf(out, "%s%s, ", n > 0 ? "; " : "", of[widest].what);
        both_ways(out, of[widest].part);
    }
    return n > 0;
}

static void row(fw_text *out, const fw_verdict_hinge_verdict *h, bool with_flow, double most) {
    fw_markup(out, "<tr{r}><th scope=\"row\">{s}</th>",
              h->decision == FW_ACCEPT ? "" : " class=\"bad\"", h->id);
    if (with_flow) fw_markup(out, "<td>{s}</td>", h->flow ? h->flow : "\u2013");
    fw_markup(out, "<td class=\"n\">{D} \u00b1 ", h->peak_angle_rad);
    fw_markup_number(out, h->angle_error_rad * FW_DEG_PER_RAD, 2);
    fw_markup(out,
              "</td><td class=\"n\">{D}</td><td class=\"n\">{p}</td>"
              "<td class=\"n\">{p}</td><td>",
              h->limit_angle_rad, h->peak_strain, h->strain_limit);
    bar(out, h, most);
    fw_text band = fw_text_new(out->arena);
    fw_markup(out, "</td><td class=\"n\">{p}</td><td class=\"n\"", h->utilisation);
    if (fw_report_band_words(&band, h)) fw_markup(out, " title=\"made of: {s}\"", band.data);
    if (band.failed) out->failed = true;
    fw_text_add(out, ">");
    if (isfinite(h->utilisation_low) && isfinite(h->utilisation_high))
        fw_markup(out, "{p} to {p}", h->utilisation_low, h->utilisation_high);
    else
        fw_text_add(out, "\u2013");
    fw_markup(out, "</td><td>{s}</td><td>{s}</td><td class=\"n\">",
              h->limit ? h->limit->criterion : "\u2013", h->scene ? h->scene : "\u2013");
    if (isfinite(h->t_s))
        fw_markup(out, "{u}", h->t_s, "s");
    else
        fw_text_add(out, "\u2013");
    fw_text_add(out, "</td></tr>\n");
}

void fw_report_hinge_table(fw_text *out, const fw_verdict_hinge_verdict *hinge, int nhinge,
                           bool with_flow, const char *caption) {
    double most = bar_scale(hinge, nhinge);
    fw_markup(out,
              "<div class=\"wide\"><table><caption>{s}</caption><thead><tr><th "
              "scope=\"col\">Hinge</th>{r}<th scope=\"col\" class=\"n\">Peak angle (\u00b0)</th>"
              "<th scope=\"col\" class=\"n\">Limit (\u00b0)</th><th scope=\"col\" class=\"n\">Peak "
              "strain</th><th scope=\"col\" class=\"n\">Strain limit</th><th scope=\"col\" "
              "colspan=\"2\">Utilisation</th><th scope=\"col\" class=\"n\">Error band</th><th "
              "scope=\"col\">Criterion</th><th scope=\"col\">Scene</th><th scope=\"col\" "
              "class=\"n\">Instant</th></tr></thead>"
              "<tbody>\n",
              caption, with_flow ? "<th scope=\"col\">Flow</th>" : "");
    for (int i = 0; i < nhinge; i++)
        row(out, &hinge[i], with_flow, most);
    fw_text_add(out, "</tbody></table></div>\n");
}

fw_status fw_report_section_hinges(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    if (v->nhinge == 0) {
        fw_text_add(page->out, "<p>This device has no flexure hinges.</p>\n");
        return fw_text_end(page->out);
    }
    fw_report_hinge_table(
        page->out, v->hinge, v->nhinge, true,
        "The worst case of every hinge over all flows, scenes and required poses. "
        "The dashed line in the bar is the limit, safety factor included; the "
        "whisker is the error band.");
    return ladder_section(page);
}
