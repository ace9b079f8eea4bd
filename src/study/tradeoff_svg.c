/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The picture: work-precision of integrators and of methods, what the model is off by on the same
   axis of error, and the masks. Errors get smaller to the right: a step to the right is a digit. */
#include "report/report_page.h"
#include "study/axes.h"
#include "study/problem.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

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
               t->device, t->scene->name ? t->scene->name : "(unnamed)");
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
