/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of a study: responses against inputs with their limits, maps of two inputs, tornados, the front of
   two goals, how much of the limits the devices use, parallel coordinates. Of many samples every k-th is
   drawn, of a Sobol' sequence the first ones. Colours tell accepted, rejected and undecided, and so do the shapes. */
#include "base/sort.h"
#include "base/svg.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include "study/study.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DRAWN_MOST = 3000, PAIRS_MOST = 12, LINES_MOST = 400, BARS = 40 };
enum {
    WIDTH = FW_STUDY_WIDE,
    HEIGHT = FW_STUDY_HIGH,
    LEFT = 86,
    RIGHT = 600,
    TOP = 46,
    BOTTOM = 340
};

enum {
    NO_BETTER = 5
}; /* beside decisions: accepted at the corners that were watched, the others were not judged */

typedef struct points { /* of the samples that are drawn */
    const fw_study *study;
    long every, met; /* which of them; rows so far */
    int n;
    double *x;     /* (DRAWN_MOST x ninput) listed ones: which of the list */
    double *y;     /* (DRAWN_MOST x nresponse) as they are drawn: shares of a limit in % */
    double *used;  /* (DRAWN_MOST) % */
    int *decision; /* (DRAWN_MOST) */
} points;

static int which_listed(const fw_study_input *in, const char *text) {
    for (int i = 0; i < in->ntext; i++)
        if (strcmp(in->text[i], text) == 0) return i;
    return 0;
}

static fw_status collect(void *context, const fw_study_sample *s) {
    points *p = context;
    const fw_study *study = p->study;
    if (p->met++ % p->every != 0 || !s->run || p->n == DRAWN_MOST || fw_study_was_refused(study, s))
        return FW_OK;
    size_t at = (size_t)p->n++;
    for (int k = 0; k < study->ninput; k++) {
        const fw_study_input *in = &study->input[k];
        p->x[at * (size_t)study->ninput + (size_t)k] =
            in->ntext > 0 ? which_listed(in, s->text[k])
                          : fw_quantity_unit_from_si(&in->unit, s->value[k]);
    }
    for (int r = 0; r < study->nresponse; r++)
        p->y[at * (size_t)study->nresponse + (size_t)r] =
            fw_study_response_drawn(&study->response[r], s->response[r]);
    p->used[at] = 100 * s->used;
    p->decision[at] = fw_study_is_partly(s) ? NO_BETTER : s->decision;
    return FW_OK;
}

/* ---- a plot ---- */

static const char *colour_of(int decision) {
    return decision == 0   ? "#0072b2"
           : decision == 1 ? "#d55e00"
           : decision == 4 ? "#cc9a00"
                           : "#57606a";
}

static void dot(fw_text *out, double x, double y, int decision) {
    if (decision == 1)
        fw_svg_put(out, "path d='M{c} {c}l5 5m0 -5l-5 5' stroke='{r}' stroke-width='1.4'\n",
                   x - 2.5, y - 2.5, colour_of(1));
    else if (decision == 4)
        fw_svg_put(out, "rect x='{c}' y='{c}' width='5' height='5' fill='{r}'\n", x - 2.5, y - 2.5,
                   colour_of(4));
    else
        fw_svg_put(out, "circle cx='{c}' cy='{c}' r='2.6' fill='{r}' fill-opacity='0.75'\n", x, y,
                   colour_of(decision));
}

static void widen(double *low, double *high) {
    const double size = fmax(fabs(*low), fabs(*high));
    double room = 0.05 * (*high - *low);
    /* what differs in its last digits alone is the same, and has no scale */
    if (!(room > 1e-9 * size)) room = size > 0 ? 0.05 * size : 1;
    *low -= room, *high += room;
}

static void labels(fw_text *out, const char *x, const char *x_unit, const char *y,
                   const char *y_unit) {
    fw_svg_put(
        out,
        "text x='{c}' y='{c}' font-size='12' text-anchor='middle' fill='#1f2328'>{s}{s}{s}{s}\n",
        0.5 * (LEFT + RIGHT), BOTTOM + 44.0, x, *x_unit ? " (" : "", x_unit, *x_unit ? ")" : "");
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='12' fill='#1f2328'>{s}{s}{s}{s}\n", 16.0,
               TOP - 6.0, y, *y_unit ? " (" : "", y_unit, *y_unit ? ")" : "");
}

/* a drawn value of a response; NULL: of an input */
static const char *number_of(char text[32], const fw_study_response *response, double drawn) {
    return response && response->share ? fw_percent_text(text, 32, drawn / 100)
                                       : fw_number_text(text, 32, drawn, 3);
}

static void limit_line(fw_text *out, const fw_svg_axes *a, double value, const char *what) {
    if (isnan(value) || value < a->y0 || value > a->y1) return;
    double y = fw_svg_axes_y(a, value);
    fw_svg_put(out,
               "path d='M{c} {c}H{c}' stroke='#d1242f' stroke-width='1.3' stroke-dasharray='6 4'\n",
               a->left, y, a->right);
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' text-anchor='end' fill='#d1242f'>{s}\n",
               a->right - 4, y - 4, what);
}

static void legend(fw_text *out, bool watches) {
    static const struct {
        int decision;
        const char *word;
    } item[] = {{NO_BETTER, "no better"}, {0, "accepted"}, {1, "rejected"}, {4, "inconclusive"}};
    for (int i = watches ? 0 : 1; i < 4; i++) {
        double x = RIGHT - 334.0 + 84 * i;
        dot(out, x, HEIGHT - 14.0, item[i].decision);
        fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' fill='#57606a'>{s}\n", x + 8,
                   HEIGHT - 10.0, item[i].word);
    }
}

static bool judged(const points *p) {
    for (int i = 0; i < p->n; i++)
        if (p->decision[i] >= 0) return true;
    return false;
}

/* axes of two columns of numbers; false: there is nothing to show */
static bool fit(const double *x, int nx, const double *y, int ny, int n, fw_svg_axes *a) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < n; i++) {
        double at[2] = {x[i * nx], y[i * ny]};
        if (!isfinite(at[0]) || !isfinite(at[1])) continue;
        for (int k = 0; k < 2; k++)
            low[k] = fmin(low[k], at[k]), high[k] = fmax(high[k], at[k]);
    }
    if (!(high[0] >= low[0])) return false;
    widen(&low[0], &high[0]), widen(&low[1], &high[1]);
    *a = (fw_svg_axes){LEFT, RIGHT, TOP, BOTTOM, low[0], high[0], low[1], high[1], 6, 6};
    return true;
}

typedef struct order { /* of points along an input */
    double x;
    int at;
} order;

static int by_x(const void *a, const void *b) {
    const order *p = a, *q = b;
    int c = fw_order_doubles(p->x, q->x);
    return c ? c : fw_order_wholes(p->at, q->at);
}

static fw_status curve(const points *p, fw_arena *arena, const fw_svg_axes *a, const double *x,
                       const double *y, int ny, fw_text *out) {
    order *o = fw_arena_array(arena, order, (size_t)p->n);
    bool open = false;
    FW_NEED(o);
    for (int i = 0; i < p->n; i++)
        o[i] = (order){x[i], i};
    qsort(o, (size_t)p->n, sizeof *o, by_x);
    fw_svg_path(out, "fill='none' stroke='#8c959f' stroke-width='1.2'");
    for (int i = 0; i < p->n; i++) {
        double v = y[o[i].at * ny];
        if (isnan(v)) {
            open = false;
            continue;
        }
        fw_svg_point(out, open ? 'L' : 'M', fw_svg_axes_x(a, o[i].x), fw_svg_axes_y(a, v), 2);
        open = true;
    }
    fw_svg_path_end(out);
    return FW_OK;
}

static fw_status pair(fw_study_sheet *s, const points *p, int r, int k) {
    const fw_study *study = p->study;
    const fw_study_response *q = &study->response[r];
    const fw_study_input *in = &study->input[k];
    fw_arena *arena = study->arena;
    fw_svg_axes a;
    double *x = fw_arena_array(arena, double, (size_t)p->n + 1);
    FW_NEED(x);
    for (int i = 0; i < p->n; i++)
        x[i] = p->x[(size_t)i * (size_t)study->ninput + (size_t)k];
    if (!fit(x, 1, p->y + r, study->nresponse, p->n, &a)) return FW_OK;
    /* a limit that is near is shown */
    const double bound[2] = {fw_study_response_drawn(q, q->min),
                             fw_study_response_drawn(q, q->max)};
    for (int b = 0; b < 2; b++)
        if (!isnan(bound[b]) && fabs(bound[b] - 0.5 * (a.y0 + a.y1)) < 2 * (a.y1 - a.y0))
            a.y0 = fmin(a.y0, bound[b]), a.y1 = fmax(a.y1, bound[b]);
    fw_text *out =
        fw_study_sheet_add(s, fw_study_picture_name(arena, q->asked->name, in->what),
                           fw_arena_printf(arena, "%s against %s", q->asked->name, in->what));
    if (!out) return FW_OK;
    fw_study_picture_begin(out, HEIGHT, s->item[s->n - 1].title);
    fw_study_picture_grid(out, &a, in, NULL);
    if (study->ninput == 1 && study->asked->kind == FW_STUDY_IS_sweep)
        FW_TRY(curve(p, arena, &a, x, p->y + r, study->nresponse, out));
    for (int i = 0; i < p->n; i++) {
        double y = p->y[(size_t)i * (size_t)study->nresponse + (size_t)r];
        if (isfinite(x[i]) && isfinite(y))
            dot(out, fw_svg_axes_x(&a, x[i]), fw_svg_axes_y(&a, y), p->decision[i]);
    }
    limit_line(out, &a, bound[0], "at least");
    limit_line(out, &a, bound[1], "at most");
    labels(out, in->what, in->unit_text, q->asked->name, fw_study_response_drawn_in(q));
    if (judged(p)) legend(out, study->watches);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- two inputs ---- */

static double cell(const fw_study_input *in) {
    int steps = fw_study_input_steps(in);
    if (in->ntext > 0) return 1;
    return (fw_quantity_unit_from_si(&in->unit, in->to) -
            fw_quantity_unit_from_si(&in->unit, in->from)) /
           (steps - 1);
}

static fw_status map(fw_study_sheet *s, const points *p, int r) {
    const fw_study *study = p->study;
    const fw_study_response *q = &study->response[r];
    fw_svg_axes a;
    if (!fit(p->x, 2, p->x + 1, 2, p->n, &a)) return FW_OK;
    double wide = cell(&study->input[0]), high = cell(&study->input[1]);
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i < p->n; i++) {
        double v = p->y[(size_t)i * (size_t)study->nresponse + (size_t)r];
        if (isfinite(v)) least = fmin(least, v), most = fmax(most, v);
    }
    if (!(most >= least)) return FW_OK;
    fw_text *out =
        fw_study_sheet_add(s, fw_study_picture_name(study->arena, "map", q->asked->name),
                           fw_arena_printf(study->arena, "%s over %s and %s", q->asked->name,
                                           study->input[0].what, study->input[1].what));
    if (!out) return FW_OK;
    a.x0 = fmin(a.x0, a.x0 - 0.5 * wide), a.x1 += 0.5 * wide, a.y0 -= 0.5 * high,
    a.y1 += 0.5 * high;
    fw_study_picture_begin(out, HEIGHT, s->item[s->n - 1].title);
    for (int i = 0; i < p->n; i++) {
        double v = p->y[(size_t)i * (size_t)study->nresponse + (size_t)r];
        double x = p->x[2 * i], y = p->x[2 * i + 1];
        char colour[8];
        if (!isfinite(v)) continue;
        fw_study_shade(colour, most > least ? (v - least) / (most - least) : 0.5);
        double left = fw_svg_axes_x(&a, x - 0.5 * wide), top = fw_svg_axes_y(&a, y + 0.5 * high);
        fw_svg_put(out, "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='{r}'\n", left, top,
                   fw_svg_axes_x(&a, x + 0.5 * wide) - left + 0.3,
                   fw_svg_axes_y(&a, y - 0.5 * high) - top + 0.3, colour);
    }
    fw_study_picture_grid(out, &a, &study->input[0], &study->input[1]);
    for (int i = 0; i < p->n; i++)
        if (p->decision[i] > 0)
            dot(out, fw_svg_axes_x(&a, p->x[2 * i]), fw_svg_axes_y(&a, p->x[2 * i + 1]),
                p->decision[i]);
    labels(out, study->input[0].what, study->input[0].unit_text, study->input[1].what,
           study->input[1].unit_text);
    char number[2][32], colour[8];
    for (int k = 0; k <= 40; k++) {
        fw_study_shade(colour, k / 40.0);
        fw_svg_put(out, "rect x='{c}' y='{c}' width='4.2' height='10' fill='{r}'\n", LEFT + 4.0 * k,
                   HEIGHT - 20.0, colour);
    }
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' fill='#57606a'>{s} to {s} {s}\n",
               LEFT + 174.0, HEIGHT - 11.0, number_of(number[0], q, least),
               number_of(number[1], q, most), fw_study_response_drawn_in(q));
    if (judged(p)) legend(out, study->watches);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- bars ---- */

typedef struct bar {
    const char *what;
    double low, high;
} bar;

static int by_size(const void *a, const void *b) {
    const bar *p = a, *q = b;
    int c = fw_order_doubles(fmax(fabs(q->low), fabs(q->high)), fmax(fabs(p->low), fabs(p->high)));
    return c ? c : strcmp(p->what, q->what);
}

static fw_status bars(fw_study_sheet *s, const char *name, const char *title, const char *unit,
                      bar *b, int n) {
    double least = 0, most = 0;
    qsort(b, (size_t)n, sizeof *b, by_size);
    for (int i = 0; i < n; i++)
        least = fmin(least, fmin(b[i].low, b[i].high)),
        most = fmax(most, fmax(b[i].low, b[i].high));
    if (!(most > least)) return FW_OK;
    fw_text *out = fw_study_sheet_add(s, name, title);
    if (!out) return FW_OK;
    double height = 110.0 + 26.0 * n;
    fw_study_picture_begin(out, height, title);
    fw_svg_axes a = {190, RIGHT, TOP, height - 60, least, most, 0, 1, 6, 1};
    widen(&a.x0, &a.x1);
    for (int i = 0; i < n; i++) {
        double y = TOP + 8 + 26.0 * i, x0 = fw_svg_axes_x(&a, fmin(b[i].low, b[i].high)),
               x1 = fw_svg_axes_x(&a, fmax(b[i].low, b[i].high));
        fw_svg_put(
            out, "rect x='{c}' y='{c}' width='{c}' height='18' fill='#0072b2' fill-opacity='0.8'\n",
            x0, y, fmax(x1 - x0, 0.5));
        fw_svg_put(out,
                   "text x='182' y='{c}' font-size='12' text-anchor='end' fill='#1f2328'>{s}\n",
                   y + 13, b[i].what);
    }
    double step = fw_svg_nice((a.x1 - a.x0) / 7);
    for (double x = ceil(a.x0 / step) * step; x <= a.x1; x += step) {
        double at = fw_svg_axes_x(&a, x);
        fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='{r}'\n", at, (double)TOP, height - 60,
                   fabs(x) < 0.5 * step ? "#57606a" : "#d8dee4");
        fw_svg_open(out, "text x='{c}' y='{c}' font-size='11' text-anchor='middle' fill='#57606a'",
                    at, height - 44);
        fw_svg_tick(out, fabs(x) < 1e-9 * step ? 0 : x, step);
        fw_svg_close(out, "text\n");
    }
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='12' text-anchor='middle' fill='#1f2328'>{s}\n",
               0.5 * (190 + RIGHT), height - 20, unit);
    fw_svg_end(out);
    return fw_text_end(out);
}

static fw_status tornados(fw_study_sheet *s) {
    const fw_study *study = s->study;
    for (int r = 0; r < study->nresponse; r++)
        for (int share = 0; share < 2; share++) {
            bar *b = fw_arena_array(study->arena, bar, (size_t)study->ninput);
            FW_NEED(b);
            for (int k = 0; k < study->ninput; k++) {
                size_t at = (size_t)r * (size_t)study->ninput + (size_t)k;
                double d = fw_study_response_drawn(&study->response[r],
                                                   study->result->derivative[at].spread);
                double i = study->result->index ? study->result->index[at].total : (double)NAN;
                b[k] = (bar){study->input[k].what,
                             share      ? 0
                             : isnan(d) ? 0
                                        : -d,
                             share      ? isnan(i) ? 0 : i
                             : isnan(d) ? 0
                                        : d};
            }
            const char *of = study->response[r].asked->name;
            FW_TRY(bars(s, fw_study_picture_name(study->arena, share ? "shares" : "tornado", of),
                        fw_arena_printf(study->arena,
                                        share ? "Where the variance of %s comes from"
                                              : "What half the range of each input makes of %s",
                                        of),
                        share ? "share of the variance, with all interactions (total Sobol' index)"
                        : study->response[r].share ? "percentage points"
                                                   : study->response[r].unit,
                        b, study->ninput));
        }
    return FW_OK;
}

/* ---- how much of the limits is used ---- */

static fw_status histogram(fw_study_sheet *s, const points *p) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    int count[BARS] = {0}, top = 0;
    for (int i = 0; i < p->n; i++)
        if (isfinite(p->used[i])) least = fmin(least, p->used[i]), most = fmax(most, p->used[i]);
    if (!(most > least)) return FW_OK;
    widen(&least, &most);
    for (int i = 0; i < p->n; i++)
        if (isfinite(p->used[i]))
            count[(int)fmin(BARS - 1, BARS * (p->used[i] - least) / (most - least))]++;
    for (int i = 0; i < BARS; i++)
        top = count[i] > top ? count[i] : top;
    const char *title = "How much of their limits the devices use that were judged";
    for (int k = 0; k < s->study->result->nyield; k++)
        if (s->study->result->yield[k].nassumed > 0)
            title = "How much of their limits devices use, at all settings of what is only assumed";
    fw_text *out = fw_study_sheet_add(s, "used", title);
    if (!out) return FW_OK;
    fw_svg_axes a = {LEFT, RIGHT, TOP, BOTTOM, least, most, 0, 1.05 * top, 6, 5};
    fw_study_picture_begin(out, HEIGHT, s->item[s->n - 1].title);
    fw_study_picture_grid(out, &a, NULL, NULL);
    for (int i = 0; i < BARS; i++) {
        double from = least + (most - least) * i / BARS, x = fw_svg_axes_x(&a, from),
               y = fw_svg_axes_y(&a, count[i]);
        fw_svg_put(out, "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='{r}'\n", x, y,
                   (RIGHT - LEFT) / (double)BARS - 1, BOTTOM - y,
                   from >= 100 ? colour_of(1) : colour_of(0));
    }
    if (least < 100 && most > 100)
        fw_svg_put(
            out,
            "path d='M{c} {c}V{c}' stroke='#d1242f' stroke-width='1.3' stroke-dasharray='6 4'\n",
            fw_svg_axes_x(&a, 100), (double)TOP, (double)BOTTOM);
    labels(out, "largest share of a limit that is used", "%", "devices", "");
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- all inputs and responses side by side ---- */

static fw_status parallel(fw_study_sheet *s, const points *p) {
    const fw_study *study = p->study;
    int n = study->ninput + study->nresponse;
    if (n < 3 || n > 14 || p->n < 2) return FW_OK;
    fw_text *out =
        fw_study_sheet_add(s, "parallel", "Every device a line through its inputs and responses");
    if (!out) return FW_OK;
    double *low = fw_arena_array(study->arena, double, (size_t)n),
           *high = fw_arena_array(study->arena, double, (size_t)n);
    FW_NEED(low && high ? low : NULL);
    fw_study_picture_begin(out, HEIGHT, s->item[s->n - 1].title);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0, every = p->n / LINES_MOST + 1; i < p->n; i += pass ? every : 1) {
            if (pass)
                fw_svg_path(out, "fill='none' stroke='{r}' stroke-opacity='0.45'",
                            colour_of(p->decision[i]));
            for (int k = 0; k < n; k++) {
                double v =
                    k < study->ninput
                        ? p->x[(size_t)i * (size_t)study->ninput + (size_t)k]
                        : p->y[(size_t)i * (size_t)study->nresponse + (size_t)(k - study->ninput)];
                if (!pass && i == 0) low[k] = HUGE_VAL, high[k] = -HUGE_VAL;
                if (!pass) low[k] = fmin(low[k], v), high[k] = fmax(high[k], v);
                double y =
                    isnan(v)
                        ? BOTTOM
                        : BOTTOM - (BOTTOM - TOP - 20) *
                                       (high[k] > low[k] ? (v - low[k]) / (high[k] - low[k]) : 0.5);
                if (pass) fw_svg_point(out, k ? 'L' : 'M', 60 + 500.0 * k / (n - 1), y, 2);
            }
            if (pass) fw_svg_path_end(out);
        }
    for (int k = 0; k < n; k++) {
        double x = 60 + 500.0 * k / (n - 1);
        const fw_study_response *q = k < study->ninput ? NULL : &study->response[k - study->ninput];
        char text[2][32];
        const char *name = q ? q->asked->name : study->input[k].what,
                   *percent = q && q->share ? " %" : "", *end[2];
        for (int e = 0; e < 2; e++) {
            const double v = e ? low[k] : high[k];
            end[e] = q || study->input[k].ntext == 0 || !isfinite(v) ? number_of(text[e], q, v)
                                                                     : study->input[k].text[(int)v];
        }
        fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='#57606a'\n", x, TOP + 20.0, (double)BOTTOM);
        fw_svg_put(out,
                   "text x='{c}' y='{c}' font-size='10' text-anchor='middle' "
                   "fill='#57606a'>{s}{s}\n",
                   x, TOP + 14.0, end[0], percent);
        fw_svg_put(out,
                   "text x='{c}' y='{c}' font-size='10' text-anchor='middle' "
                   "fill='#57606a'>{s}{s}\n",
                   x, BOTTOM + 14.0, end[1], percent);
        fw_svg_put(out,
                   "text x='{c}' y='{c}' font-size='11' text-anchor='middle' fill='#1f2328'>{s}\n",
                   x, BOTTOM + (k % 2 ? 44.0 : 30.0), name);
    }
    fw_svg_end(out);
    return fw_text_end(out);
}

static fw_status front(fw_study_sheet *s, const points *p) {
    const fw_study *study = p->study;
    int goal[2], n = 0;
    fw_svg_axes a;
    for (int r = 0; r < study->nresponse; r++)
        if (study->response[r].asked->goal != FW_GOAL_NONE && n < 2) goal[n++] = r;
    if (n < 2 || !fit(p->y + goal[0], study->nresponse, p->y + goal[1], study->nresponse, p->n, &a))
        return FW_OK;
    fw_text *out =
        fw_study_sheet_add(s, "front", "Both goals: what no other device beats in both is ringed");
    if (!out) return FW_OK;
    fw_study_picture_begin(out, HEIGHT, s->item[s->n - 1].title);
    fw_study_picture_grid(out, &a, NULL, NULL);
    for (int i = 0; i < p->n; i++) {
        const double *y = p->y + (size_t)i * (size_t)study->nresponse;
        if (isfinite(y[goal[0]]) && isfinite(y[goal[1]]))
            dot(out, fw_svg_axes_x(&a, y[goal[0]]), fw_svg_axes_y(&a, y[goal[1]]), p->decision[i]);
    }
    for (int i = 0; i < study->result->nfound; i++) {
        const double *y = study->result->found[i].response;
        fw_svg_put(
            out, "circle cx='{c}' cy='{c}' r='6' fill='none' stroke='#1f2328' stroke-width='1.6'\n",
            fw_svg_axes_x(&a, fw_study_response_drawn(&study->response[goal[0]], y[goal[0]])),
            fw_svg_axes_y(&a, fw_study_response_drawn(&study->response[goal[1]], y[goal[1]])));
    }
    labels(out, study->response[goal[0]].asked->name,
           fw_study_response_drawn_in(&study->response[goal[0]]),
           study->response[goal[1]].asked->name,
           fw_study_response_drawn_in(&study->response[goal[1]]));
    legend(out, study->watches);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- the best designs ---- */

enum { DRAWINGS_MOST = 3 };

/* judged once more, for its drawing with the hinges coloured by what they use */
static fw_status draw_design(fw_study_sheet *s, const fw_study_found *f, const char *name,
                             const char *title) {
    fw_study *study = s->study;
    const char *svg = NULL;
    size_t n;
    int status;
    fw_design *design = fw_study_design(study, study->options.cancel, f->text, &status);
    FW_NEED(design);
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    if (status == FW_STATUS_OK)
        status = fw_design_document(design, FW_DOCUMENT_DEVICE_SVG, &svg, &n);
    const char *head = status == FW_STATUS_OK && svg ? strstr(svg, "?>\n") : NULL;
    const char *picture = head ? head + 3 : NULL; /* without the declaration of a file */
    fw_text *out = picture ? fw_study_sheet_add(s, name, title) : NULL;
    if (out) s->item[s->n - 1].captioned = true;
    if (out) fw_text_add(out, picture);
    fw_design_free(design);
    if (fw_plan_is_final((fw_status)status)) return (fw_status)status;
    return out ? fw_text_end(out) : FW_OK;
}

static fw_status drawings(fw_study_sheet *s) {
    const fw_study *study = s->study;
    const fw_study_result *r = study->result;
    for (int i = 0; i < r->nfound && i < DRAWINGS_MOST; i++) {
        /* of a front one at each end and one between */
        int k = r->nfound <= DRAWINGS_MOST ? i : i * (r->nfound - 1) / (DRAWINGS_MOST - 1);
        char number[24];
        snprintf(number, sizeof number, "%d", k + 1);
        FW_TRY(draw_design(s, &r->found[k], fw_study_picture_name(study->arena, "design", number),
                           fw_arena_printf(study->arena,
                                           "Design %d of the table, hinges coloured by what they "
                                           "use of their limits",
                                           k + 1)));
    }
    if (r->nfound == 0 && r->nearest.text)
        return draw_design(s, &r->nearest, "design-nearest",
                           "The nearest design, hinges coloured by what they use of their limits");
    return FW_OK;
}

static fw_status pictures(fw_study_sheet *s, const points *p) {
    const fw_study *study = s->study;
    const fw_device_study *asked = study->asked;
    bool grid =
        asked->kind == FW_STUDY_IS_sweep && asked->points == FW_POINTS_GRID && study->ninput == 2;
    if (study->result->derivative) FW_TRY(tornados(s));
    if (asked->kind == FW_STUDY_IS_size) FW_TRY(drawings(s));
    if (asked->kind == FW_STUDY_IS_size) FW_TRY(front(s, p));
    for (int r = 0; grid && r < study->nresponse; r++)
        FW_TRY(map(s, p, r));
    if (asked->kind == FW_STUDY_IS_yield) FW_TRY(fw_study_yield_pictures(s));
    if (asked->kind == FW_STUDY_IS_yield) return histogram(s, p);
    int pairs = 0;
    for (int r = 0; r < study->nresponse; r++)
        for (int k = 0; k < study->ninput && pairs < PAIRS_MOST; k++, pairs++)
            FW_TRY(pair(s, p, r, k));
    return parallel(s, p);
}

/* the first points of a Sobol' sequence fill the ranges evenly, every k-th of them do not */
static long every_of(const fw_study *study) {
    const fw_study_result *r = study->result;
    const fw_device_study *a = study->asked;
    return a->kind == FW_STUDY_IS_sweep && a->points == FW_POINTS_SOBOL
               ? 1
               : (r->run + r->failed) / DRAWN_MOST + 1;
}

fw_status fw_study_pictures(fw_study *study, const fw_study_picture **picture, int *n) {
    const fw_study_result *r = study->result;
    size_t inputs = (size_t)study->ninput, responses = (size_t)study->nresponse;
    points p = {.study = study, .every = every_of(study)};
    fw_study_sheet s = {.study = study,
                        .most =
                            6 + DRAWINGS_MOST + PAIRS_MOST + 3 * study->nresponse + 3 * r->nyield};
    FW_NEED(s.item = fw_arena_array(study->arena, fw_study_picture, (size_t)s.most));
    FW_NEED(p.x = fw_arena_array(study->arena, double, DRAWN_MOST *inputs + 1));
    FW_NEED(p.y = fw_arena_array(study->arena, double, DRAWN_MOST *responses + 1));
    FW_NEED(p.used = fw_arena_array(study->arena, double, DRAWN_MOST));
    FW_NEED(p.decision = fw_arena_array(study->arena, int, DRAWN_MOST));
    FW_TRY(fw_study_store_each(study->store, collect, &p));
    FW_TRY(pictures(&s, &p));
    *picture = s.item, *n = s.n;
    return FW_OK;
}
