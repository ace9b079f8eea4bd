/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/figure.h"
#include "base/constants.h"
#include <math.h>

enum { FEWEST_WAVES = 8, MOST_WAVES = 30 }; /* half waves of a spring */

typedef fw_report_figure_pen pen_t;

/* Okabe and Ito without the yellow, which is no line on white */
const char *fw_report_figure_colour(int body) {
    static const char *const palette[] = {"#0072B2", "#E69F00", "#009E73", "#CC79A7",
                                          "#56B4E9", "#D55E00", "#8A6D3B", "#767676"};
    return body < 0 ? "#57606a" : palette[(unsigned)body % (sizeof palette / sizeof palette[0])];
}

/* the same mixed with white, 30 to 70 */
static const char *tint(int body) {
    static const char *const palette[] = {"#b3d5e8", "#f8e2b3", "#b3e2d5", "#f0d7e5",
                                          "#ccebfb", "#f2cfb3", "#dcd3c4", "#d6d6d6"};
    return body < 0 ? "#d0d7de" : palette[(unsigned)body % (sizeof palette / sizeof palette[0])];
}

static fw_geometry_vec2 in_view(const pen_t *pen, const double *q, fw_report_figure_point p) {
    fw_geometry_vec2 w = fw_report_figure_place(q, p);
    return (fw_geometry_vec2){fw_report_x(pen->view, w.x), fw_report_y(pen->view, w.y)};
}

static const double *frame(const pen_t *pen, int i) {
    return pen->frame + 3 * (size_t)pen->nbody * (size_t)i;
}

/* ---- paths: every frame has the same commands, so that viewers can move between them ---- */

/* half waves that look like a spring at its still length: as many in all frames */
static int waves_of(const fw_report_figure_part *part, const pen_t *pen) {
    fw_geometry_vec2 a = in_view(pen, pen->still, part->end[0]),
                     b = in_view(pen, pen->still, part->end[1]);
    double n = hypot(b.x - a.x, b.y - a.y) / (1.6 * pen->mark);
    return n > MOST_WAVES ? MOST_WAVES : n > FEWEST_WAVES ? (int)n : FEWEST_WAVES;
}

/* A spring between two points of the picture: its coils keep their height, their pitch follows the
   length. */
static void zigzag(const pen_t *pen, fw_geometry_vec2 a, fw_geometry_vec2 b, int waves) {
    double dx = b.x - a.x, dy = b.y - a.y, d = hypot(dx, dy), high = 0.95 * pen->mark;
    double ex = d > 1e-9 ? dx / d : 1.0, ey = d > 1e-9 ? dy / d : 0.0;
    double lead = fmin(0.15 * d, 2.5 * pen->mark), pitch = (d - 2.0 * lead) / waves;
    fw_markup(pen->out, "M{c} {c}L{c} {c}", a.x, a.y, a.x + lead * ex, a.y + lead * ey);
    for (int i = 0; i < waves; i++) {
        double s = lead + (i + 0.5) * pitch, h = i % 2 ? -high : high;
        fw_markup(pen->out, "L{c} {c}", a.x + s * ex - h * ey, a.y + s * ey + h * ex);
    }
    fw_markup(pen->out, "L{c} {c}L{c} {c}", b.x - lead * ex, b.y - lead * ey, b.x, b.y);
}

void fw_report_figure_path(const fw_report_figure_part *part, const fw_report_figure_pen *pen,
                           const double *q) {
    if (part->noutline) {
        for (int i = 0; i < part->noutline; i++) {
            fw_geometry_vec2 p =
                in_view(pen, q,
                        (fw_report_figure_point){part->end[0].body, part->outline[i].x,
                                                 part->outline[i].y});
            fw_markup(pen->out, "{r}{c} {c}", i ? "L" : "M", p.x, p.y);
        }
        if (part->noutline > 2) fw_text_add(pen->out, "Z");
        return;
    }
    fw_geometry_vec2 a = in_view(pen, q, part->end[0]), b = in_view(pen, q, part->end[1]);
    if (part->role == FW_FIGURE_SPRING)
        zigzag(pen, a, b, waves_of(part, pen));
    else
        fw_markup(pen->out, "M{c} {c}L{c} {c}", a.x, a.y, b.x, b.y);
}

static bool at_rest(const fw_report_figure_part *part) {
    return part->end[0].body == FW_GROUND && part->end[1].body == FW_GROUND &&
           part->turns_with == FW_GROUND;
}

#define ROUND " stroke-linecap='round' stroke-linejoin='round'"

/* opens the path of a line or outline in the look of its part */
static void open_line(const fw_report_figure_part *part, const pen_t *pen) {
    const char *colour = fw_report_figure_colour(part->of);
    double mark = pen->mark;
    switch (part->role) {
    case FW_FIGURE_BODY:
        fw_svg_path(pen->out,
                    "fill='{r}' fill-opacity='0.22' stroke='{r}' stroke-width='{c}'" ROUND, colour,
                    colour, (part->noutline > 2 ? 0.45 : 1.1) * mark);
        return;
    case FW_FIGURE_RAIL:
        fw_svg_path(pen->out, "stroke='{r}' stroke-width='{c}'" ROUND,
                    part->of == FW_GROUND ? "#57606a" : "#1f2328", 0.35 * mark);
        return;
    case FW_FIGURE_DRIVEN_ROD:
        fw_svg_path(pen->out, "stroke='#D55E00' stroke-width='{c}'" ROUND, 0.8 * mark);
        return;
    case FW_FIGURE_SPRING:
        fw_svg_path(pen->out, "fill='none' stroke='#8250df' stroke-width='{c}'" ROUND, 0.28 * mark);
        return;
    case FW_FIGURE_CABLE:
        fw_svg_path(pen->out, "stroke='#424a53' stroke-width='{c}' stroke-dasharray='6 3'" ROUND,
                    0.28 * mark);
        return;
    case FW_FIGURE_ROD:
    case FW_FIGURE_PLATE: /* marks have their own looks, see shape */
    case FW_FIGURE_BLOCK:
    case FW_FIGURE_FOOT:
    case FW_FIGURE_WELD:
    case FW_FIGURE_STOP:
    case FW_FIGURE_TURN:
    case FW_FIGURE_PUSH:
    case FW_FIGURE_END:
    case FW_FIGURE_PIN:
        break;
    }
    fw_svg_path(pen->out, "stroke='#1f2328' stroke-width='{c}'" ROUND, 0.5 * mark);
}

/* the ground under a guide: a row of short strokes across it */
static void hatch(const fw_report_figure_part *part, const pen_t *pen) {
    fw_svg_path(pen->out, "stroke='#8c959f' stroke-width='{c}' stroke-dasharray='1 5'",
                1.8 * pen->mark);
    fw_report_figure_path(part, pen, pen->still);
    fw_svg_path_end(pen->out);
}

static void line(const fw_report_figure_part *part, const pen_t *pen) {
    if (part->role == FW_FIGURE_RAIL && part->of == FW_GROUND) hatch(part, pen);
    open_line(part, pen);
    fw_report_figure_path(part, pen, pen->still);
    if (pen->frames == 0 || at_rest(part)) {
        fw_svg_path_end(pen->out);
        return;
    }
    fw_svg_finish(pen->out, ">");
    fw_svg_animate_path(pen->out, pen->seconds);
    for (int i = 0; i < pen->frames; i++) {
        fw_text_add(pen->out, i ? ";" : "");
        fw_report_figure_path(part, pen, frame(pen, i));
    }
    fw_svg_finish(pen->out, "/>");
    fw_svg_close(pen->out, "path\n");
}

/* ---- marks: one drawing in pixels about their place, x along their angle, y down ---- */

/* from the first angle to the second, counter-clockwise as seen */
static void arc(const pen_t *pen, double r, double from, double to) {
    fw_markup(pen->out, "M{c} {c}A{c} {c} 0 {i} 0 {c} {c}", r * cos(from), -r * sin(from), r, r,
              to - from > 0.5 * 360.0 / FW_DEG_PER_RAD ? 1 : 0, r * cos(to), -r * sin(to));
}

static void ray(const pen_t *pen, double angle, double from, double to) {
    fw_markup(pen->out, "M{c} {c}L{c} {c}", from * cos(angle), -from * sin(angle), to * cos(angle),
              -to * sin(angle));
}

static void stop_shape(const fw_report_figure_part *part, const pen_t *pen) {
    double low = part->from_rad, high = part->to_rad, m = pen->mark, about = 0.35;
    fw_svg_path(pen->out, "fill='none' stroke='#B03A00' stroke-width='{c}'", 0.3 * m);
    if (isfinite(low)) ray(pen, low, 2.2 * m, 4.4 * m);
    if (isfinite(high)) ray(pen, high, 2.2 * m, 4.4 * m);
    double from = isfinite(low) ? low : high - about, to = isfinite(high) ? high : low + about;
    if (to - from < 6.2) arc(pen, 3.3 * m, from, to);
    fw_svg_finish(pen->out, "/>");
}

static void shape(const fw_report_figure_part *part, const pen_t *pen) {
    const char *colour = fw_report_figure_colour(part->of);
    double m = pen->mark, s = 1.9 * m;
    switch (part->role) {
    case FW_FIGURE_FOOT:
        fw_svg_put(pen->out,
                   "path d='M0 0l{c} {c}h{c}Zm{c} {c}h{c}' fill='#eceff2' stroke='#57606a'",
                   -0.6 * s, s, 1.2 * s, -0.95 * s, s, 1.9 * s);
        return;
    case FW_FIGURE_BLOCK:
    case FW_FIGURE_PLATE: /* the line in a plate shows how it turns */
        fw_svg_put(
            pen->out,
            "path d='M{c} {c}h{c}v{c}h{c}ZM0 0h{c}' fill='{r}' stroke='{r}' stroke-width='{c}'",
            -2.2 * m, -1.4 * m, 4.4 * m, 2.8 * m, -4.4 * m,
            part->role == FW_FIGURE_PLATE ? 2.2 * m : 0.0, tint(part->of), colour, 0.3 * m);
        return;
    case FW_FIGURE_WELD:
        fw_svg_put(pen->out, "path d='M{c} {c}h{c}v{c}h{c}Z' fill='#1f2328'", -0.8 * m, -0.8 * m,
                   1.6 * m, 1.6 * m, -1.6 * m);
        return;
    case FW_FIGURE_STOP:
        stop_shape(part, pen);
        return;
    case FW_FIGURE_TURN: /* an arrow round the pin */
        fw_svg_path(pen->out, "fill='none' stroke='#D55E00' stroke-width='2'");
        arc(pen, 2.6 * m, -0.6, 3.4);
        fw_svg_finish(pen->out, "/>");
        fw_svg_put(pen->out, "path d='M{c} {c}l{c} {c}h{c}Z' fill='#D55E00'", -2.6 * m, 1.7 * m,
                   -0.8 * m, -1.3 * m, 1.6 * m);
        return;
    case FW_FIGURE_PUSH: /* a double arrow beside the slider */
        fw_svg_put(pen->out,
                   "path fill='none' stroke='#D55E00' stroke-width='2' d='M{c} {c}h{c}m{c} {c}l{c} "
                   "{c}l{c} {c}M{c} {c}l{c} {c}l{c} {c}'",
                   -2.6 * m, -2.4 * m, 5.2 * m, -0.9 * m, -0.7 * m, 0.9 * m, 0.7 * m, -0.9 * m,
                   0.7 * m, -1.7 * m, -3.1 * m, -0.9 * m, 0.7 * m, 0.9 * m, 0.7 * m);
        return;
    case FW_FIGURE_END:
        fw_svg_put(pen->out, "circle r='{c}' fill='#1f2328'", 0.45 * m);
        return;
    case FW_FIGURE_PIN:
    case FW_FIGURE_RAIL: /* lines are drawn as such, see look */
    case FW_FIGURE_BODY:
    case FW_FIGURE_ROD:
    case FW_FIGURE_DRIVEN_ROD:
    case FW_FIGURE_SPRING:
    case FW_FIGURE_CABLE:
        break;
    }
    fw_svg_put(pen->out, "circle r='{c}' fill='#fff' stroke='#1f2328' stroke-width='{c}'", 0.75 * m,
               0.28 * m);
}

static double angle(const fw_report_figure_part *part, const double *q) {
    double turn =
        part->angle_rad + (part->turns_with == FW_GROUND ? 0.0 : q[3 * part->turns_with + 2]);
    return -FW_DEG_PER_RAD * turn;
}

static void turning(const fw_report_figure_part *part, const pen_t *pen) {
    fw_svg_open(pen->out, "g transform='rotate({2})'", angle(part, pen->still));
    if (pen->frames == 0 || part->turns_with == FW_GROUND) return;
    fw_svg_animate_group(pen->out, "rotate", pen->seconds);
    for (int i = 0; i < pen->frames; i++)
        fw_markup(pen->out, "{r}{2}", i ? ";" : "", angle(part, frame(pen, i)));
    fw_svg_finish(pen->out, "/>");
}

static void mark(const fw_report_figure_part *part, const pen_t *pen) {
    fw_geometry_vec2 p = in_view(pen, pen->still, part->end[0]);
    fw_svg_open(pen->out, "g transform='translate({c} {c})'", p.x, p.y);
    if (pen->frames && part->end[0].body != FW_GROUND) {
        fw_svg_animate_group(pen->out, "translate", pen->seconds);
        for (int i = 0; i < pen->frames; i++) {
            p = in_view(pen, frame(pen, i), part->end[0]);
            fw_markup(pen->out, "{r}{c} {c}", i ? ";" : "", p.x, p.y);
        }
        fw_svg_finish(pen->out, "/>");
    }
    bool turns = part->turns_with != FW_GROUND || part->angle_rad != 0.0;
    if (turns) turning(part, pen);
    shape(part, pen);
    if (turns) fw_svg_close(pen->out, "g");
    fw_svg_close(pen->out, "g\n");
}

void fw_report_figure_draw(const fw_report_figure_part *part, const fw_report_figure_pen *pen) {
    if (fw_report_figure_is_line(part))
        line(part, pen);
    else
        mark(part, pen);
}

void fw_report_figure_ghost(const fw_report_figure_part *part, const double *q,
                            const fw_report_figure_pen *pen) {
    if (part->role != FW_FIGURE_BODY) return;
    fw_svg_path(pen->out, "");
    fw_report_figure_path(part, pen, q);
    fw_svg_path_end(pen->out);
}

int fw_report_figure_numbers(const fw_report_figure_part *part) {
    if (at_rest(part)) return 0;
    if (!fw_report_figure_is_line(part)) return part->turns_with == FW_GROUND ? 2 : 3;
    return part->role == FW_FIGURE_SPRING ? 2 * (MOST_WAVES + 4)
           : part->noutline               ? 2 * part->noutline
                                          : 4;
}
