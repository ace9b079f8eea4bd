/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/axes.h"
#include "report/report_page.h"
#include <math.h>
#include <stdlib.h>

fw_study_axis fw_study_axis_new(bool falls) {
    return (fw_study_axis){HUGE_VAL, -HUGE_VAL, falls};
}

void fw_study_axis_add(fw_study_axis *a, double value) {
    if (!isfinite(value) || !(value > 0)) return;
    a->low = fmin(a->low, log10(value));
    a->high = fmax(a->high, log10(value));
}

void fw_study_axis_end(fw_study_axis *a) {
    if (!(a->low <= a->high)) a->low = a->high = 0;
    a->low = floor(a->low - 0.05);
    a->high = ceil(a->high + 0.05);
}

static double part(const fw_study_axis *a, double value) {
    double x = (log10(value) - a->low) / (a->high - a->low);
    x = fmin(1, fmax(0, x));
    return a->falls ? 1 - x : x;
}

double fw_study_panel_x(const fw_study_panel *p, double value) {
    return p->x + p->width * part(&p->ax, value);
}

double fw_study_panel_y(const fw_study_panel *p, double value) {
    return p->y + p->height * (1 - part(&p->ay, value));
}

static void power(fw_text *out, int exponent) {
    static const char *const digit[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                        "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    if (exponent >= 0 && exponent <= 2) {
        fw_text_add(out, exponent == 0 ? "1" : exponent == 1 ? "10" : "100");
        return;
    }
    int n = abs(exponent);
    fw_text_printf(out, "10%s", exponent < 0 ? "\u207b" : "");
    if (n > 9) fw_text_add(out, digit[n / 10 % 10]);
    fw_text_add(out, digit[n % 10]);
}

static void ticks_x(const fw_study_panel *p, fw_text *out) {
    double bottom = p->y + p->height;
    int every = p->ax.high - p->ax.low > 8 ? 2 : 1;
    for (int e = (int)p->ax.low; e <= (int)p->ax.high; e++) {
        double x = fw_study_panel_x(p, pow(10, e));
        fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='#eaeef2'", x, p->y, bottom);
        if ((e - (int)p->ax.low) % every) continue;
        fw_svg_open(out, "text x='{c}' y='{c}' text-anchor='middle'", x, bottom + 16.0);
        power(out, e);
        fw_svg_close(out, "text");
    }
}

static void ticks_y(const fw_study_panel *p, fw_text *out) {
    bool fine = p->ay.high - p->ay.low <= 2; /* few decades: 2 and 5 too */
    static const double step[] = {1, 2, 5};
    for (int e = (int)p->ay.low; e <= (int)p->ay.high; e++)
        for (int k = 0; k < (fine ? 3 : 1) && (k == 0 || e < (int)p->ay.high); k++) {
            double y = fw_study_panel_y(p, step[k] * pow(10, e));
            fw_svg_put(out, "path d='M{c} {c}H{c}' stroke='#eaeef2'", p->x, y, p->x + p->width);
            fw_svg_open(out, "text x='{c}' y='{c}' text-anchor='end'", p->x - 6.0, y + 4.0);
            fw_markup(out, "{r}", k == 0 ? "" : k == 1 ? "2\u00b7" : "5\u00b7");
            power(out, e);
            fw_svg_close(out, "text");
        }
}

void fw_study_panel_frame(const fw_study_panel *p, const char *title, const char *x_name,
                          const char *y_name, fw_text *out) {
    double bottom = p->y + p->height, middle = p->y + 0.5 * p->height;
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='14' font-weight='600' fill='#1f2328'>{s}\n",
               p->x, p->y - 22.0, title);
    fw_svg_open(out, "g font-size='11.5' fill='#57606a'");
    ticks_x(p, out);
    if (!p->bare) ticks_y(p, out);
    fw_svg_put(out, "text x='{c}' y='{c}' text-anchor='middle'>{s}{r}", p->x + 0.5 * p->width,
               bottom + 34.0, x_name, p->ax.falls ? " (smaller to the right)" : "");
    fw_svg_put(out, "path d='M{c} {c}V{c}H{c}' fill='none' stroke='#8c959f'", p->x, p->y, bottom,
               p->x + p->width);
    if (!p->bare)
        fw_svg_put(out,
                   "text x='{c}' y='{c}' text-anchor='middle' transform='rotate(-90 {c} {c})'>{s}",
                   p->x - 50.0, middle, p->x - 50.0, middle, y_name);
    fw_svg_close(out, "g\n");
}

/* ---- curves ---- */

/* Okabe and Ito's, without their yellow, which white swallows */
static const char *const colour[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#B07D00",
                                     "#56B4E9", "#1f2328", "#7f7f7f", "#8C510A"};
enum { COLOURS = sizeof colour / sizeof colour[0] };

static void marker(double x, double y, int style, fw_text *out) {
    static const char *const shape[] = {"m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0z",
                                        "m-3.1 -3.1h6.2v6.2h-6.2z", "m0 -4.2l4 7h-8z",
                                        "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z", "m0 4.2l-4 -7h8z"};
    fw_markup(out, "M{c} {c}{r}", x, y, shape[style % 5]);
}

void fw_study_panel_curve(const fw_study_panel *p, const double *x, const double *y, int n,
                          int style, fw_text *out) {
    static const char *const dash[] = {"none", "7 3", "2 3"};
    const char *ink = colour[style % COLOURS];
    (void)p;
    if (n == 0) return;
    fw_svg_path(out, "fill='none' stroke='{r}' stroke-width='1.7' stroke-dasharray='{r}'", ink,
                dash[style / 3 % 3]);
    for (int i = 0; i < n; i++)
        fw_markup(out, "{r}{c} {c}", i ? "L" : "M", x[i], y[i]);
    fw_svg_finish(out, "/>");
    fw_svg_path(out, "fill='{r}' stroke='#fff' stroke-width='0.7'", ink);
    for (int i = 0; i < n; i++)
        marker(x[i], y[i], style, out);
    fw_svg_path_end(out);
}

/* ---- labels ---- */

void fw_study_labels_add(fw_study_labels *l, const char *text, double x, double y, int style) {
    if (l->n == FW_LABELS) return;
    int at = l->n++;
    for (; at > 0 && l->item[at - 1].y > y; at--)
        l->item[at] = l->item[at - 1];
    l->item[at].text = text;
    l->item[at].x = x;
    l->item[at].y = l->item[at].at = y;
    l->item[at].style = style;
}

/* moves labels apart so that none covers another: from `top` to `bottom`, `room` each */
static void spread(fw_study_labels *l, double top, double bottom, double room) {
    for (int i = 0; i < l->n; i++)
        l->item[i].at = fmax(l->item[i].y, i ? l->item[i - 1].at + room : top);
    for (int i = l->n - 1; i >= 0; i--)
        l->item[i].at = fmin(l->item[i].at, i < l->n - 1 ? l->item[i + 1].at - room : bottom);
}

void fw_study_labels_draw(fw_study_labels *l, const fw_study_panel *p, fw_text *out) {
    double x = p->x + p->width + 12;
    spread(l, p->y + 6, p->y + p->height - 4, 16);
    for (int i = 0; i < l->n; i++) {
        const char *ink = colour[l->item[i].style % COLOURS];
        fw_svg_put(out,
                   "path d='M{c} {c}L{c} {c}' stroke='{r}' stroke-width='0.8' stroke-opacity='0.6'",
                   l->item[i].x + 4.0, l->item[i].y, x - 4.0, l->item[i].at, ink);
        fw_svg_path(out, "fill='{r}'", ink);
        marker(x + 3.0, l->item[i].at, l->item[i].style, out);
        fw_svg_finish(out, "/>");
        fw_svg_put(out, "text x='{c}' y='{c}' font-size='12' fill='{r}'>{s}\n", x + 11.0,
                   l->item[i].at + 4.0, ink, l->item[i].text);
    }
}
