/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of a yield: how its estimate came to be, where its spread comes from, and the wafer; and what all pictures of a
   study begin with. */
#include "base/constants.h"
#include "base/svg.h"
#include "study/study_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LEFT = 86, RIGHT = 600, TOP = 46, BOTTOM = 340 };

/* ---- of all pictures ---- */

fw_text *fw_study_sheet_add(fw_study_sheet *s, const char *name, const char *title) {
    if (s->n == s->most || !name || !title) return NULL;
    fw_study_picture *p = &s->item[s->n++];
    *p = (fw_study_picture){.name = name, .title = title, .svg = fw_text_new(s->study->arena)};
    return &p->svg;
}

const char *fw_study_picture_name(fw_arena *arena, const char *a, const char *b) {
    char *name = fw_arena_printf(arena, "%s-%s", a, b);
    for (char *at = name; at && *at; at++)
        if (!((*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z') ||
              (*at >= '0' && *at <= '9')))
            *at = '-';
    return name;
}

void fw_study_picture_begin(fw_text *out, double height, const char *title) {
    fw_svg_begin_picture(out, FW_STUDY_WIDE, height, false); /* a page takes it in as it is */
    fw_svg_title(out, "{s}", title);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out, "text x='16' y='24' font-size='14' font-weight='600' fill='#1f2328'>{s}\n",
               title);
}

/* at most so many bytes of it (most < FW_STUDY_TEXT - 4), whole characters, and dots for the rest */
static void shortened(char text[FW_STUDY_TEXT], const char *from, size_t most) {
    size_t n = strlen(from);
    const bool whole = n <= most;
    if (!whole)
        for (n = most - 1; n > 0 && ((unsigned char)from[n] & 0xC0) == 0x80;)
            n--;
    snprintf(text, FW_STUDY_TEXT, "%.*s%s", (int)n, from, whole ? "" : "\u2026");
}

/* Values of a list stand where its numbers are, 0 and on, as they are written: as many as have room, the first among them;
   what is longer than the margin is cut short. */
static void listed(fw_text *out, const fw_svg_axes *a, const fw_study_input *in, bool upright) {
    enum { MARGIN = 12, ALONG = 24 };   /* characters left of a plot, and below it */
    const double wide = 6.2, high = 13; /* pixels of a character */
    size_t longest = 1;
    for (int i = 0; i < in->ntext; i++) {
        const size_t n = strlen(in->text[i]);
        longest = n > longest ? n : longest;
    }
    const double each = upright ? fabs(fw_svg_axes_y(a, 1) - fw_svg_axes_y(a, 0))
                                : fw_svg_axes_x(a, 1) - fw_svg_axes_x(a, 0);
    const double room = upright ? high : wide * (double)(longest < ALONG ? longest : ALONG) + 8;
    const int every = (int)fmax(1, ceil(room / each));
    const size_t most = upright ? MARGIN : ALONG;
    for (int i = 0; i < in->ntext; i += every) {
        const double x = upright ? a->left : fw_svg_axes_x(a, i),
                     y = upright ? fw_svg_axes_y(a, i) : a->bottom;
        if (x < a->left || x > a->right || y < a->top || y > a->bottom) continue;
        if (upright)
            fw_svg_put(out, "path d='M{c} {c}H{c}' stroke='#eaeef2'", a->left, y, a->right);
        else
            fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='#eaeef2'", x, a->top, a->bottom);
        char text[FW_STUDY_TEXT];
        shortened(text, in->text[i], most);
        fw_svg_put(out, "text x='{c}' y='{c}' text-anchor='{r}'>{s}\n", upright ? x - 7 : x,
                   upright ? y + 4 : y + 16, upright ? "end" : "middle", text);
    }
}

void fw_study_picture_grid(fw_text *out, const fw_svg_axes *axes, const fw_study_input *x,
                           const fw_study_input *y) {
    fw_svg_axes numbers = *axes;
    fw_svg_open(out, "g font-size='11'");
    if (x && x->ntext > 0) numbers.columns = 0, listed(out, axes, x, false);
    if (y && y->ntext > 0) numbers.rows = 0, listed(out, axes, y, true);
    fw_svg_grid(out, &numbers);
    fw_svg_close(out, "g\n");
}

void fw_study_shade(char text[8], double share) {
    static const int key[5][3] = {
        {45, 20, 80}, {60, 80, 150}, {40, 145, 140}, {120, 200, 90}, {250, 230, 90}};
    static const char digit[] = "0123456789abcdef";
    double at = fmin(fmax(share, 0), 1) * 4;
    int i = at >= 4 ? 3 : (int)at;
    text[0] = '#';
    for (int k = 0; k < 3; k++) {
        int v = (int)lround(key[i][k] + (at - i) * (key[i + 1][k] - key[i][k]));
        text[1 + 2 * k] = digit[v >> 4], text[2 + 2 * k] = digit[v & 15];
    }
    text[7] = '\0';
}

/* ---- the estimate against the number of devices ---- */

enum { ENDS = 2 }; /* the least and the most yield; one where nothing is only assumed */

static void band(fw_text *out, const fw_svg_axes *a, const fw_study_yield_end *y,
                 const char *colour) {
    fw_svg_path(out, "fill='{r}' fill-opacity='0.18'", colour);
    for (size_t k = 0; k < 2 * y->steps; k++) {
        const fw_chance_step *step = &y->step[k < y->steps ? k : 2 * y->steps - 1 - k];
        double v = 100 * (1 - (k < y->steps ? step->low : step->high));
        fw_svg_point(out, k ? 'L' : 'M', fw_svg_axes_x(a, (double)step->evaluations),
                     fw_svg_axes_y(a, fmin(fmax(v, a->y0), a->y1)), 2);
    }
    fw_svg_path_end(out);
    fw_svg_path(out, "fill='none' stroke='{r}' stroke-width='1.8'", colour);
    for (size_t k = 0; k < y->steps; k++) {
        double v = 100 * (1 - y->step[k].probability);
        fw_svg_point(out, k ? 'L' : 'M', fw_svg_axes_x(a, (double)y->step[k].evaluations),
                     fw_svg_axes_y(a, fmin(fmax(v, a->y0), a->y1)), 2);
    }
    fw_svg_path_end(out);
}

static fw_status convergence(fw_study_sheet *s, const fw_study_flow_yield *y, const char *of) {
    static const char *const colour[ENDS] = {"#0072b2", "#d55e00"};
    fw_arena *arena = s->study->arena;
    const fw_study_yield_end *end[ENDS] = {&y->least, &y->most};
    const int ends = y->nassumed > 0 ? ENDS : 1;
    if (y->least.steps < 2) return FW_OK;
    fw_text *out = fw_study_sheet_add(
        s, fw_study_picture_name(arena, "convergence", of),
        fw_arena_printf(arena, "Yield of %s as it was known after so many devices", of));
    if (!out) return FW_OK;
    double least = 100, most = 0, last = 0;
    for (int e = 0; e < ends; e++)
        if (end[e]->steps > 0)
            last = fmax(last, (double)end[e]->step[end[e]->steps - 1].evaluations);
    for (int e = 0; e < ends; e++)
        for (size_t k = 0; k < end[e]->steps; k++) {
            const fw_chance_step *step = &end[e]->step[k];
            /* the first steps know nothing; what counts is how the interval closes from a fifth of the way on */
            if ((double)step->evaluations < 0.2 * last) continue;
            least = fmin(least, 100 * (1 - step->high));
            most = fmax(most, 100 * (1 - step->low));
        }
    double room = fmax(0.08 * (most - least), 1e-9);
    fw_svg_axes a = {
        LEFT, RIGHT, TOP, BOTTOM, 0, last * 1.02, fmax(least - room, 0), fmin(most + room, 100),
        6,    6};
    if (!(a.y1 > a.y0)) a.y0 = a.y1 - 1;
    fw_study_picture_begin(out, FW_STUDY_HIGH, s->item[s->n - 1].title);
    fw_study_picture_grid(out, &a, NULL, NULL);
    for (int e = 0; e < ends; e++)
        band(out, &a, end[e], colour[e]);
    fw_svg_put(
        out,
        "text x='{c}' y='{c}' font-size='12' text-anchor='middle' fill='#1f2328'>devices that "
        "were judged\n",
        0.5 * (LEFT + RIGHT), BOTTOM + 44.0);
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='12' fill='#1f2328'>yield in %\n", (double)LEFT,
               TOP - 7.0);
    fw_svg_put(
        out,
        "text x='{c}' y='{c}' font-size='11' text-anchor='end' fill='#57606a'>{s}band: interval "
        "of sampling at {p}\n",
        (double)RIGHT, FW_STUDY_HIGH - 10.0,
        ends > 1 ? "blue: the least, orange: the most, as is what is only assumed; " : "",
        s->study->asked->confidence);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- where the spread comes from ---- */

static fw_status shares(fw_study_sheet *s, const fw_study_levels *l, const char *of) {
    const struct {
        const char *name;
        const fw_chance_share *share;
    } row[] = {{"from lot to lot", &l->used.lot},
               {"from wafer to wafer", &l->used.wafer},
               {"by place on the wafer", &l->used.place},
               {"from die to die", &l->used.die},
               {"from hinge to hinge", &l->used.hinge}};
    enum { ROWS = sizeof row / sizeof row[0], BAR = 34, FROM = 190, HIGH = TOP + ROWS * BAR + 70 };
    fw_arena *arena = s->study->arena;
    if (l->used.units == 0 || !(l->used.variance > 0)) return FW_OK;
    fw_text *out = fw_study_sheet_add(
        s, fw_study_picture_name(arena, "levels", of),
        fw_arena_printf(arena, "Where the spread of what devices of %s use comes from", of));
    if (!out) return FW_OK;
    fw_study_picture_begin(out, HIGH, s->item[s->n - 1].title);
    double foot = TOP + ROWS * BAR + 8.0;
    for (int k = 0; k <= 5; k++) {
        double x = FROM + (RIGHT - FROM) * k / 5.0;
        fw_svg_put(out, "path d='M{c} {c}V{c}' stroke='#d8dee4'\n", x, (double)TOP, foot);
        fw_svg_put(
            out, "text x='{c}' y='{c}' font-size='11' text-anchor='middle' fill='#57606a'>{i} %\n",
            x, foot + 16, 20 * k);
    }
    for (int k = 0; k < ROWS; k++) {
        double y = TOP + 6.0 + BAR * k, wide = RIGHT - FROM;
        const fw_chance_share *v = row[k].share;
        fw_svg_put(out,
                   "text x='{c}' y='{c}' font-size='12' text-anchor='end' fill='#1f2328'>{s}\n",
                   FROM - 10.0, y + 15, row[k].name);
        fw_svg_put(
            out, "rect x='{c}' y='{c}' width='{c}' height='22' fill='#0072b2' fill-opacity='0.8'\n",
            (double)FROM, y, fmax(wide * v->value, 0.5));
        if (v->high > v->low)
            fw_svg_put(out,
                       "path d='M{c} {c}v10m0 -5H{c}m0 -5v10' stroke='#1f2328' fill='none' "
                       "stroke-width='1.2'\n",
                       FROM + wide * v->low, y + 6, FROM + wide * v->high);
    }
    fw_svg_put(
        out,
        "text x='{c}' y='{c}' font-size='12' text-anchor='middle' fill='#1f2328'>share of the "
        "variance of ln(largest share of a limit that is used), with its interval\n",
        0.5 * FW_STUDY_WIDE, foot + 42);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- the wafer ---- */

enum { DISC = 170, MIDDLE_X = 220, MIDDLE_Y = 224, MAP_HIGH = 440 };

/* the rim, and its flat where there is one */
static void rim(fw_text *out, const fw_study_scatter *s) {
    double half = 0.5 * s->flat_m, r = DISC;
    static const double turn[] = {
        [FW_SIDE_BOTTOM] = -90, [FW_SIDE_TOP] = 90, [FW_SIDE_LEFT] = 180, [FW_SIDE_RIGHT] = 0};
    if (!(half > 0)) {
        fw_svg_put(out, "circle cx='{c}' cy='{c}' r='{c}' fill='#f6f8fa' stroke='#57606a'\n",
                   (double)MIDDLE_X, (double)MIDDLE_Y, r);
        return;
    }
    double open = asin(fmin(half / s->rim_m, 1)), at = turn[s->side] * FW_PI / 180;
    double x0 = MIDDLE_X + r * cos(at + open), y0 = MIDDLE_Y - r * sin(at + open),
           x1 = MIDDLE_X + r * cos(at - open), y1 = MIDDLE_Y - r * sin(at - open);
    fw_svg_put(out, "path d='M{c} {c}A{c} {c} 0 1 0 {c} {c}Z' fill='#f6f8fa' stroke='#57606a'\n",
               x0, y0, r, r, x1, y1);
}

static void scale_of(fw_text *out, double least, double most) {
    enum { STEPS = 40, X = 440, FROM = 330, HIGH = 5 };
    char colour[8];
    for (int k = 0; k < STEPS; k++) {
        fw_study_shade(colour, (k + 0.5) / STEPS);
        fw_svg_put(out, "rect x='{i}' y='{c}' width='18' height='{c}' fill='{r}'\n", X,
                   FROM - HIGH * (k + 1.0), HIGH + 0.4, colour);
    }
    for (int k = 0; k <= 4; k++)
        fw_svg_put(out, "text x='{i}' y='{c}' font-size='11' fill='#57606a'>{n} %\n", X + 24,
                   FROM - HIGH * STEPS * k / 4.0 + 4, 100 * (least + (most - least) * k / 4));
    fw_svg_put(out, "text x='{i}' y='{c}' font-size='12' fill='#1f2328'>yield\n", X,
               (double)FROM - HIGH * STEPS - 12);
}

static fw_status wafer(fw_study_sheet *s, const fw_study_levels *l, const char *of) {
    const fw_study_scatter *c = l->scatter;
    fw_arena *arena = s->study->arena;
    if (!l->at) return FW_OK;
    fw_text *out =
        fw_study_sheet_add(s, fw_study_picture_name(arena, "wafer", of),
                           fw_arena_printf(arena, "Yield of %s by place on the wafer", of));
    if (!out) return FW_OK;
    double scale = DISC / c->rim_m, least = 1, most = 0, wide = 0;
    for (size_t q = 0; q < c->places; q++) {
        if (isnan(l->at[q].value)) continue;
        least = fmin(least, l->at[q].value), most = fmax(most, l->at[q].value);
        wide = fmax(wide, l->at[q].high - l->at[q].low);
    }
    double top = most, bottom = least;
    if (top - bottom < 1e-3) bottom = fmax(top - 1e-3, 0), top = bottom + 1e-3;
    fw_study_picture_begin(out, MAP_HIGH, s->item[s->n - 1].title);
    rim(out, c);
    for (size_t q = 0; q < c->places; q++) {
        const fw_study_place *p = &c->place[q];
        char colour[8];
        fw_study_shade(colour, (l->at[q].value - bottom) / (top - bottom));
        fw_svg_open(out, "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='{r}'",
                    MIDDLE_X + scale * (p->at.x_m - 0.46 * c->die_x_m),
                    MIDDLE_Y - scale * (p->at.y_m + 0.46 * c->die_y_m), 0.92 * scale * c->die_x_m,
                    0.92 * scale * c->die_y_m, isnan(l->at[q].value) ? "#d0d7de" : colour);
        fw_svg_title(out, "{s}: {p}, {p} to {p}", p->id, l->at[q].value, l->at[q].low,
                     l->at[q].high);
        fw_svg_close(out, "rect\n");
    }
    scale_of(out, bottom, top);
    fw_svg_put(out,
               "text x='16' y='{c}' font-size='11' fill='#57606a'>{l} dies of simulated wafers; "
               "the interval of a place at {p} is {e} % wide at most\n",
               MAP_HIGH - 14.0, l->devices, s->study->asked->confidence, 100 * wide);
    fw_svg_end(out);
    return fw_text_end(out);
}

fw_status fw_study_yield_pictures(fw_study_sheet *s) {
    const fw_study_result *r = s->study->result;
    for (int i = 0; i < r->nyield; i++) {
        const fw_study_flow_yield *y = &r->yield[i];
        const char *of = y->flow ? y->flow : s->study->device_name;
        if (y->levels) FW_TRY(wafer(s, y->levels, of));
        if (y->levels) FW_TRY(shares(s, y->levels, of));
        FW_TRY(convergence(s, y, of));
    }
    return FW_OK;
}
