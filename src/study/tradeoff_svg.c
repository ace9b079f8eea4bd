/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The picture: work-precision of integrators and of methods, what the model is off by on the same axis of error,
   and the masks. Errors get smaller to the right: a step to the right is a digit. */
#include "report/report_page.h"
#include "study/tradeoff.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- panels ---- */

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
static const char *const curve_colour[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#B07D00",
                                           "#56B4E9", "#1f2328", "#7f7f7f", "#8C510A"};
enum { COLOURS = sizeof curve_colour / sizeof curve_colour[0] };

static void marker(double x, double y, int style, fw_text *out) {
    static const char *const shape[] = {"m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0z",
                                        "m-3.1 -3.1h6.2v6.2h-6.2z", "m0 -4.2l4 7h-8z",
                                        "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z", "m0 4.2l-4 -7h8z"};
    fw_markup(out, "M{c} {c}{r}", x, y, shape[style % 5]);
}

void fw_study_panel_curve(const fw_study_panel *p, const double *x, const double *y, int n,
                          int style, fw_text *out) {
    static const char *const dash[] = {"none", "7 3", "2 3"};
    const char *ink = curve_colour[style % COLOURS];
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
        const char *ink = curve_colour[l->item[i].style % COLOURS];
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

/* ---- the picture ---- */

enum { WIDTH = 1080, HEIGHT = 883, LEFT = 66, COLUMN = 530, PLOT_W = 300, PLOT_H = 300 };
enum { TOP = 161, LOWER = 563, LOWER_H = 260 };

/* the range of errors that both panels of points and the one of the model share */
static fw_study_axis errors(const fw_study_tradeoff *t) {
    fw_study_axis a = fw_study_axis_new(true);
    for (int i = 0; i < t->npoint; i++)
        if (t->point[i].state == FW_TRADEOFF_DONE)
            fw_study_axis_add(&a, fmax(t->point[i].error, t->reference.error));
    fw_study_axis_add(&a, t->accuracy);
    fw_study_axis_add(&a, t->reference.error);
    fw_study_axis_add(&a, t->floor);
    for (int i = 0; i < t->nmodel; i++)
        if (t->model[i].change > 1e-12) fw_study_axis_add(&a, t->model[i].change);
    fw_study_axis_end(&a);
    return a;
}

static fw_study_axis costs(const fw_study_tradeoff *t) {
    fw_study_axis a = fw_study_axis_new(false);
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *c = &t->curve[i];
        for (int k = 0; (c->as_method || c->as_integrator) && k < c->count; k++)
            if (t->point[c->first + k].state == FW_TRADEOFF_DONE)
                fw_study_axis_add(&a, t->point[c->first + k].instructions);
    }
    fw_study_axis_add(&a, t->point[0].instructions);
    fw_study_axis_end(&a);
    return a;
}

static void report_exact(fw_text *out, double x) {
    fw_text_real(out, "%.1e", x);
}

/* what is wanted, and from where on digits say nothing */
static void marks(const fw_study_tradeoff *t, const fw_study_panel *p, fw_text *out) {
    if (isfinite(t->floor)) {
        double x = fw_study_panel_x(p, t->floor);
        fw_svg_put(
            out, "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='#8c959f' fill-opacity='0.13'",
            x, p->y, p->x + p->width - x, p->height);
        fw_svg_put(out, "path d='M{c} {c}v{c}' stroke='#57606a' stroke-width='1.5'\n", x, p->y,
                   p->height);
    }
    double x = fw_study_panel_x(p, t->accuracy);
    fw_svg_put(out,
               "path d='M{c} {c}v{c}' stroke='#0550ae' stroke-width='1.2' stroke-dasharray='5 4'",
               x, p->y, p->height);
    fw_svg_put(out,
               "text x='{c}' y='{c}' font-size='11' fill='#0550ae' text-anchor='middle'>wanted\n",
               x, p->y - 5.0);
    if (!isfinite(t->reference.error)) return;
    x = fw_study_panel_x(p, t->reference.error);
    fw_svg_put(out, "path d='M{c} {c}v{c}' stroke='#8c959f' stroke-dasharray='1 4'", x, p->y,
               p->height);
    fw_svg_put(
        out, "text x='{c}' y='{c}' font-size='11' fill='#57606a' text-anchor='middle'>reference\n",
        x, p->y - 5.0);
}

static void chosen(const fw_study_tradeoff *t, const fw_study_panel *p, fw_text *out) {
    double x = fw_study_panel_x(p, fmax(t->point[0].error, t->reference.error));
    double y = fw_study_panel_y(p, t->point[0].instructions);
    fw_svg_put(out,
               "circle cx='{c}' cy='{c}' r='8' fill='none' stroke='#1f2328' stroke-width='2.2'", x,
               y);
    fw_svg_put(out,
               "text x='{c}' y='{c}' font-size='12' font-weight='600' fill='#1f2328' stroke='#fff' "
               "stroke-width='4' paint-order='stroke' text-anchor='middle'>chosen\n",
               x, y + 24.0 > p->y + p->height - 4.0 ? y - 14.0 : y + 24.0);
}

/* costs that are only modelled where others are counted: a white dot in the marker */
static void hollow(const fw_study_tradeoff *t, const fw_study_tradeoff_curve *c,
                   const fw_study_panel *p, fw_text *out) {
    for (int i = c->first; i < c->first + c->count && !t->instructions_why; i++) {
        const fw_study_tradeoff_point *at = &t->point[i];
        if (at->state != FW_TRADEOFF_DONE || at->by != FW_COUNT_MODEL) continue;
        if (!isfinite(at->instructions) || (at->floor && i > c->first && at[-1].floor)) continue;
        fw_svg_put(out, "circle cx='{c}' cy='{c}' r='1.7' fill='#fff'",
                   fw_study_panel_x(p, fmax(at->error, t->reference.error)),
                   fw_study_panel_y(p, at->instructions));
    }
}

static void points(const fw_study_tradeoff *t, fw_study_panel *p, bool methods, fw_text *out) {
    int shown = 0;
    fw_study_labels labels = {0};
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *c = &t->curve[i];
        double x[FW_TRADEOFF_TOLERANCES], y[FW_TRADEOFF_TOLERANCES];
        int n = 0;
        if (!(methods ? c->as_method : c->as_integrator)) continue;
        for (int k = 0; k < c->count; k++) {
            const fw_study_tradeoff_point *at = &t->point[c->first + k];
            if (at->state != FW_TRADEOFF_DONE || !isfinite(at->instructions)) continue;
            if (k > 0 && at->floor && at[-1].floor) continue; /* nothing more is known there */
            x[n] = fw_study_panel_x(p, fmax(at->error, t->reference.error));
            y[n++] = fw_study_panel_y(p, at->instructions);
        }
        fw_study_panel_curve(p, x, y, n, shown, out);
        hollow(t, c, p, out);
        if (n > 0)
            fw_study_labels_add(&labels, methods ? c->method : c->integrator, x[n - 1], y[n - 1],
                                shown);
        shown++;
    }
    fw_study_labels_draw(&labels, p, out);
    chosen(t, p, out);
}

/* ---- the model ---- */

/* "hinges: elastica"; NULL: nothing to draw */
static const char *kind_text(const fw_study_tradeoff_model *m) {
    if (m->state != FW_TRADEOFF_DONE || !isfinite(m->change) || m->change <= 0) return NULL;
    if (strcmp(m->kind, "hinge") == 0) return "hinges as ";
    if (strcmp(m->kind, "effects") == 0) return "effects left out";
    if (strcmp(m->kind, "solid") == 0) return "hinges, as the verdict allows";
    return "process: ";
}

static void models(const fw_study_tradeoff *t, const fw_study_panel *p, fw_text *out) {
    int n = 0;
    for (int i = 0; i < t->nmodel; i++)
        n += kind_text(&t->model[i]) != NULL;
    double step = fmin(30, p->height / fmax(1, n + 1)), y = p->y + step;
    for (int i = 0; i < t->nmodel; i++) {
        const fw_study_tradeoff_model *m = &t->model[i];
        const char *kind = kind_text(m);
        if (!kind) continue;
        bool process = strcmp(m->kind, "process") == 0, hinge = strcmp(m->kind, "hinge") == 0;
        const char *colour = process ? "#E69F00" : m->chosen ? "#D55E00" : "#8c959f";
        double x = fw_study_panel_x(p, fmax(m->change, 1e-16));
        x = fmin(x, p->x + p->width);
        fw_svg_put(out, "path d='M{c} {c}H{c}' stroke='{r}' stroke-width='7' stroke-opacity='0.55'",
                   p->x, y, x, colour);
        fw_svg_put(out, "circle cx='{c}' cy='{c}' r='4' fill='{r}'", x, y, colour);
        fw_svg_open(out,
                    "text x='{c}' y='{c}' font-size='11.5' fill='#1f2328' stroke='#fff' "
                    "stroke-width='3' paint-order='stroke'",
                    x + 9.0, y + 4.0);
        fw_markup(out, "{r}{s} ", kind, process || hinge ? m->name : "");
        report_exact(out, m->change);
        fw_text_add(out, m->chosen && hinge ? " (chosen)" : "");
        fw_svg_close(out, "text\n");
        y += step;
    }
    if (n == 0)
        fw_svg_put(out,
                   "text x='{c}' y='{c}' font-size='12' fill='#57606a'>nothing that is known: no "
                   "flexure and no flow\n",
                   p->x + 12.0, p->y + 30.0);
}

/* ---- masks ---- */

static void masks(const fw_study_tradeoff *t, fw_text *out) {
    fw_study_panel p = {.x = COLUMN + LEFT, .y = LOWER, .width = PLOT_W, .height = LOWER_H};
    p.ax = fw_study_axis_new(true), p.ay = fw_study_axis_new(false);
    double x[16], y[16];
    for (int i = 0; i < t->nmask; i++) {
        fw_study_axis_add(&p.ax, 1e9 * t->mask[i].edge_m);
        fw_study_axis_add(&p.ay, (double)t->mask[i].bytes);
    }
    if (t->nmask == 0) return;
    fw_study_axis_end(&p.ax), fw_study_axis_end(&p.ay);
    fw_study_panel_frame(&p, "masks", "chord error of arcs, nm", "bytes of GDSII", out);
    for (int i = 0; i < t->nmask; i++) {
        x[i] = fw_study_panel_x(&p, 1e9 * t->mask[i].edge_m);
        y[i] = fw_study_panel_y(&p, (double)t->mask[i].bytes);
    }
    fw_study_panel_curve(&p, x, y, t->nmask, 0, out);
    for (int i = 0; i < t->nmask; i++) {
        if (!t->mask[i].usual) continue;
        fw_svg_put(out,
                   "circle cx='{c}' cy='{c}' r='8' fill='none' stroke='#1f2328' stroke-width='2.2'",
                   x[i], y[i]);
        fw_svg_put(out,
                   "text x='{c}' y='{c}' font-size='12' font-weight='600' fill='#1f2328' "
                   "text-anchor='end'>chosen\n",
                   x[i] - 12.0, y[i] - 4.0);
    }
    fw_svg_open(out, "g font-size='11.5' fill='#57606a'");
    fw_svg_put(out, "text x='{c}' y='{c}'>of a deflection", p.x + p.width + 10.0, p.y + 4.0);
    fw_svg_put(out, "text x='{c}' y='{c}'>at most", p.x + p.width + 10.0, p.y + 18.0);
    for (int i = 0; i < t->nmask; i++) {
        if (!isfinite(t->mask[i].deflection)) continue;
        fw_svg_open(out, "text x='{c}' y='{c}'", p.x + p.width + 10.0, p.y + 38.0 + 15.0 * i);
        fw_text_real(out, "%.3g nm: ", 1e9 * t->mask[i].tolerance_m);
        report_exact(out, t->mask[i].deflection);
        fw_svg_close(out, "text");
    }
    fw_svg_close(out, "g\n");
}

/* ---- the whole ---- */

static void headline(const fw_study_tradeoff *t, fw_text *out) {
    fw_svg_put(out,
               "text x='20' y='28' font-size='18' font-weight='600' fill='#1f2328'>{s}, {s}: what "
               "accuracy costs\n",
               t->device, fw_text_name(t->scene->name));
    fw_svg_open(out, "text x='20' y='52' font-size='15' fill='#1f2328'");
    if (isfinite(t->digit_here)) {
        fw_text_add(out, "One more digit costs \u00d7");
        fw_text_real(out, "%.2f", t->digit_here);
        fw_text_add(out, " from the chosen setting on");
        if (isfinite(t->digit_overall)) {
            fw_text_add(out, ", \u00d7");
            fw_text_real(out, "%.2f", t->digit_overall);
            fw_text_add(out, " on average");
        }
        fw_text_add(out, ".");
    }
    fw_svg_close(out, "text\n");
    fw_svg_open(out, "text x='20' y='74' font-size='13' fill='#1f2328'");
    if (isfinite(t->over_cheapest)) {
        fw_text_add(out, "The chosen setting costs \u00d7");
        fw_text_real(out, "%.2f", t->over_cheapest);
        fw_markup(out, " the cheapest that would have done: {s} + {s}.",
                  t->point[t->cheapest].method, t->point[t->cheapest].integrator);
    }
    fw_svg_close(out, "text\n");
    fw_svg_open(out, "text x='20' y='95' font-size='12' fill='#57606a'");
    if (isfinite(t->floor)) {
        fw_text_add(out, "Grey: digits below ");
        report_exact(out, t->floor);
        fw_text_printf(out, ", %s. ", fw_study_tradeoff_floor_text(t));
    }
    if (!t->instructions_why) fw_text_add(out, "White dot: cost by a model, not counted.");
    fw_svg_close(out, "text\n");
    fw_svg_open(out, "text x='20' y='112' font-size='12' fill='#57606a'");
    if (t->reference.run[1])
        fw_markup(out, "Reference: {s} + {s} against {s} + {s}{r}.", t->reference.run[0]->method,
                  t->reference.run[0]->integrator, t->reference.run[1]->method,
                  t->reference.run[1]->integrator,
                  t->reference.independent ? "" : ", not independent");
    fw_svg_close(out, "text\n");
}

fw_status fw_study_tradeoff_svg(const fw_study_tradeoff *t, fw_text *out) {
    fw_study_panel p = {.x = LEFT, .y = TOP, .width = PLOT_W, .height = PLOT_H};
    const fw_study_tradeoff_point *c = &t->point[0];
    char title[2][120];
    snprintf(title[0], sizeof title[0], "integrators, by %s",
             t->quasi_static ? "chain" : c->method);
    snprintf(title[1], sizeof title[1], "methods, by %s",
             t->quasi_static ? "radau5" : c->integrator);
    fw_svg_begin(out, &(fw_svg_frame){.width = WIDTH,
                                      .height = HEIGHT,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_BEFORE,
                                      .file = true,
                                      .lead = "role='img'",
                                      .font = fw_svg_font_page});
    fw_svg_title(out, "what accuracy costs: {s}", t->device);
    fw_svg_paper(out, "#fff");
    headline(t, out);
    p.ax = errors(t), p.ay = costs(t);
    for (int k = 0; k < 2; k++) {
        p.x = LEFT + k * COLUMN;
        fw_study_panel_frame(&p, title[k], "error of the peak deflection, relative",
                             t->instructions_why ? "instructions, by a model" : "instructions",
                             out);
        marks(t, &p, out);
        points(t, &p, k == 1, out);
    }
    p.x = LEFT, p.y = LOWER, p.height = LOWER_H;
    p.bare = true;
    fw_study_panel_frame(&p, "what no tolerance takes away",
                         "change of the peak deflection, relative", "", out);
    models(t, &p, out);
    masks(t, out);
    fw_svg_end(out);
    return fw_text_end(out);
}
