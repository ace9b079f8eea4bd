/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A control chart as a picture: means above, ranges below. What is accepted is a band, limits are dashed lines, points that
   break a rule are red and filled. */
#include "recipe/control_chart.h"
#include "recipe/recipe_words.h"
#include <math.h>

enum {
    WIDTH = 720,
    LEFT = 78,
    RIGHT = 120,
    TOP = 26,
    MEANS = 170,
    BETWEEN = 26,
    RANGES = 84,
    BELOW = 40
};

typedef struct named { /* a level and where its value is written */
    const char *name;
    double value, y;
} named;

typedef struct panel {
    double low, high; /* of the values */
    double top, height;
    const fw_recipe_chart *chart;
    fw_text *out;
    named named[6];
    int nnamed;
} panel;

static double y_of(const panel *p, double value) {
    return p->top + p->height * (p->high - value) / (p->high - p->low);
}

static double x_of(const fw_recipe_chart *c, int i) {
    return LEFT + (WIDTH - LEFT - RIGHT) * (i + 0.5) / c->npoint;
}

static void take(panel *p, double value) {
    if (!isfinite(value)) return;
    p->low = fmin(p->low, value);
    p->high = fmax(p->high, value);
}

/* room above and below, and some where all values are one */
static void widen(panel *p) {
    double span = p->high - p->low;
    if (!(span > 1e-9 * fmax(fabs(p->high), fabs(p->low))))
        span = p->high != 0.0 || p->low != 0.0 ? 0.1 * fmax(fabs(p->high), fabs(p->low)) : 1.0;
    p->low -= 0.08 * span;
    p->high += 0.08 * span;
}

static double step_of(double span) { /* 1, 2 or 5 times a power of ten, about five in the panel */
    double raw = span / 5.0, power = pow(10.0, floor(log10(raw)));
    double part = raw / power;
    return power * (part > 5.0 ? 10.0 : part > 2.0 ? 5.0 : part > 1.0 ? 2.0 : 1.0);
}

static void frame(const panel *p, const char *name) {
    fw_text *out = p->out;
    fw_text_printf(out,
                   "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" fill=\"none\" "
                   "stroke=\"#999\"/>\n",
                   LEFT, p->top, WIDTH - LEFT - RIGHT, p->height);
    double step = step_of((p->high - p->low) * 170.0 / p->height);
    for (double v = ceil(p->low / step) * step; v <= p->high; v += step) {
        fw_text_printf(out,
                       "<line x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>"
                       "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">",
                       LEFT, WIDTH - RIGHT, y_of(p, v), y_of(p, v), LEFT - 6, y_of(p, v) + 4);
        fw_recipe_put_value(out, fabs(v) < 1e-6 * step ? 0.0 : v);
        fw_text_add(out, "</text>\n");
    }
    fw_text_printf(out,
                   "<text transform=\"translate(14 %.1f) rotate(-90)\" text-anchor=\"middle\">",
                   p->top + p->height / 2);
    fw_text_escaped(out, name);
    fw_text_add(out, "</text>\n");
}

/* a line across the panel; its value is written at the right edge by names() */
static void level(panel *p, double value, const char *style, const char *name) {
    if (!isfinite(value)) return;
    double y = y_of(p, value);
    fw_text_printf(p->out, "<line x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\" %s/>\n", LEFT,
                   WIDTH - RIGHT, y, y, style);
    int at = p->nnamed++;
    for (; at > 0 && p->named[at - 1].y > y; at--) /* from above to below */
        p->named[at] = p->named[at - 1];
    p->named[at] = (named){name, value, y};
}

/* one below the other where they would meet, and none below the panel */
static void names(panel *p) {
    const double line = 12.0;
    double below = p->top + p->height + 4.0;
    for (int i = 1; i < p->nnamed; i++)
        p->named[i].y = fmax(p->named[i].y, p->named[i - 1].y + line);
    for (int i = p->nnamed - 1; i >= 0; i--) {
        p->named[i].y = fmin(p->named[i].y, below);
        below = p->named[i].y - line;
    }
    for (int i = 0; i < p->nnamed; i++) {
        fw_text_printf(p->out, "<text x=\"%d\" y=\"%.1f\">%s ", WIDTH - RIGHT + 5,
                       p->named[i].y + 4, p->named[i].name);
        fw_recipe_put_value(p->out, p->named[i].value);
        fw_text_add(p->out, "</text>\n");
    }
}

static const char dashed[] = "stroke=\"#b00\" stroke-dasharray=\"6 3\"";
static const char solid[] = "stroke=\"#555\"";
static const char dotted[] = "stroke=\"#2a7\" stroke-dasharray=\"2 3\"";
static const char green[] = "stroke=\"#2a7\"";

static void points(const panel *p, bool ranges) {
    const fw_recipe_chart *c = p->chart;
    double before[2] = {(double)NAN, (double)NAN};
    for (int i = 0; i < c->npoint; i++) {
        const fw_recipe_chart_point *q = &c->point[i];
        double value = ranges ? q->range : q->mean, x = x_of(c, i);
        if (isnan(value)) continue;
        if (!isnan(before[0]))
            fw_text_printf(p->out,
                           "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" "
                           "stroke=\"#357\"/>",
                           before[0], before[1], x, y_of(p, value));
        before[0] = x, before[1] = y_of(p, value);
    }
    for (int i = 0; i < c->npoint; i++) {
        const fw_recipe_chart_point *q = &c->point[i];
        double value = ranges ? q->range : q->mean;
        bool bad = ranges ? q->range_beyond : q->beyond || q->run || q->outside;
        if (isnan(value)) continue;
        fw_text_printf(p->out,
                       "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" stroke=\"%s\"/>\n",
                       x_of(c, i), y_of(p, value), bad ? "5" : "3.5",
                       bad               ? "#d22"
                       : q->n == c->size ? "#357"
                                         : "#fff",
                       bad ? "#800" : "#357");
    }
}

static void labels(const fw_recipe_chart *c, double y, fw_text *out) {
    int every = c->npoint / 16 + 1;
    for (int i = 0; i < c->npoint; i += every) {
        fw_text_printf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", x_of(c, i), y);
        fw_text_escaped(out, c->point[i].label);
        fw_text_add(out, "</text>");
    }
    fw_text_printf(out, "<text x=\"%d\" y=\"%.1f\">wafer</text>\n", WIDTH - RIGHT + 5, y);
}

static void means(const fw_recipe_chart *c, fw_text *out) {
    panel p = {.low = (double)INFINITY,
               .high = -(double)INFINITY,
               .top = TOP,
               .height = MEANS,
               .chart = c,
               .out = out};
    for (int i = 0; i < c->npoint; i++)
        take(&p, c->point[i].mean);
    take(&p, c->low), take(&p, c->high);
    if (c->limits) take(&p, c->lower), take(&p, c->upper);
    widen(&p);
    double top = isnan(c->high) ? p.high : c->high, bottom = isnan(c->low) ? p.low : c->low;
    if (!isnan(c->high) || !isnan(c->low))
        fw_text_printf(
            out, "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" fill=\"#e3f4ea\"/>\n",
            LEFT, y_of(&p, top), WIDTH - LEFT - RIGHT, fmax(y_of(&p, bottom) - y_of(&p, top), 0.0));
    frame(&p, c->size > 1 ? "mean of the sites" : "value");
    if (!c->limits) level(&p, 0.5 * (c->low + c->high), dotted, "planned");
    level(&p, c->high, green, "accept");
    level(&p, c->low, green, "accept");
    if (c->limits) {
        level(&p, c->upper, dashed, "UCL");
        level(&p, c->centre, solid, "centre");
        level(&p, c->lower, dashed, "LCL");
    }
    names(&p);
    points(&p, false);
}

static void ranges(const fw_recipe_chart *c, fw_text *out) {
    panel p = {.top = TOP + MEANS + BETWEEN, .height = RANGES, .chart = c, .out = out};
    for (int i = 0; i < c->npoint; i++)
        take(&p, c->point[i].range);
    if (c->limits) take(&p, c->range_upper);
    p.high = p.high > 0.0 ? 1.12 * p.high : 1.0;
    frame(&p, c->size > 1 ? "range" : "moving range");
    if (c->limits) {
        level(&p, c->range_upper, dashed, "UCL");
        level(&p, c->range_centre, solid, "mean");
        if (c->range_lower > 0.0) level(&p, c->range_lower, dashed, "LCL");
    }
    names(&p);
    points(&p, true);
    labels(c, p.top + p.height + 16, out);
}

void fw_recipe_chart_svg(const fw_recipe_chart *c, fw_text *out) {
    int height = TOP + MEANS + BETWEEN + RANGES + BELOW;
    fw_text_printf(out,
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" role=\"img\" "
                   "font-family=\"sans-serif\" font-size=\"11\">\n<title>",
                   WIDTH, height);
    fw_text_escaped(out, c->title);
    fw_text_printf(out, "</title>\n<text x=\"%d\" y=\"16\" font-size=\"13\">", LEFT);
    fw_text_escaped(out, c->title);
    if (c->unit[0]) {
        fw_text_add(out, ", ");
        fw_recipe_put_unit(out, c->unit);
    }
    fw_text_add(out, "</text>\n");
    means(c, out);
    ranges(c, out);
    fw_text_add(out, "</svg>\n");
}
