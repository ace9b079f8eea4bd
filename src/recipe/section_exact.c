/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The section along a cut, to scale along it; heights by one factor for all steps of a flow. */
#include "base/svg.h"
#include "recipe/legend.h"
#include "recipe/profile.h"
#include "recipe/words.h"
#include <math.h>
#include <string.h>

static const double MOST_PART = 0.42; /* of the width that heights may take */
static const double HATCH = 7.0;      /* between the lines through what nobody stated */

/* 1, 2, 5, 10, 20 ... */
static double round_number(int i) {
    static const double step[] = {1, 2, 5};
    double number = step[i % 3];
    for (int k = 0; k < i / 3; k++)
        number *= 10.0;
    return number;
}

/* Heights over the whole flow, and the largest factor of 1, 2, 5, 10 ... that keeps them below
   MOST_PART of the window's width; what is higher without a factor is drawn as it is. */
fw_status fw_section_scale_of(fw_arena *arena, const fw_flow *flow, const fw_recipe_cut *cut,
                              fw_section_scale *scale) {
    *scale = (fw_section_scale){cut->length_m, 0.0, 0.0, 1.0};
    for (int i = 0; i < flow->nstep; i++) {
        fw_films films;
        if (!fw_step_changes(&flow->step[i])) continue;
        FW_TRY(fw_flow_films(arena, flow, i, &films));
        for (int k = 0; k < films.n; k++) {
            scale->low_m = fmin(scale->low_m, films.film[k].bottom_m);
            scale->high_m = fmax(scale->high_m, films.film[k].top_m);
        }
    }
    double high = scale->high_m - scale->low_m;
    for (int i = 0; i < 12 && high > 0.0; i++) {
        double factor = round_number(i);
        if (factor * high > MOST_PART * cut->length_m) break;
        scale->exaggeration = factor;
    }
    return FW_OK;
}

/* from metres to the picture */
typedef struct frame {
    fw_text *out;
    double x_per_m, y_per_m, high_m, width;
} frame;

static void point(const frame *f, char letter, double s_m, double z_m) {
    fw_svg_point(f->out, letter, s_m * f->x_per_m, (f->high_m - z_m) * f->y_per_m, 2);
}

static void area(const frame *f, const fw_patch *p, bool close) {
    point(f, 'M', p->low_m[0], p->bottom_m);
    point(f, 'L', p->high_m[0], p->top_m);
    point(f, 'L', p->high_m[1], p->top_m);
    point(f, 'L', p->low_m[1], p->bottom_m);
    fw_text_add(f->out, close ? "Z" : "");
}

/* patches of one film in one path */
static void fills(const frame *f, const fw_cross_section *p) {
    for (int i = 0; i < p->n;) {
        const fw_film *film = p->patch[i].film;
        fw_svg_path(f->out, "fill='{r}'", fw_paint_fill(film->material, film->exposed));
        for (; i < p->n && p->patch[i].film == film; i++)
            area(f, &p->patch[i], true);
        fw_svg_path_end(f->out);
    }
}

/* floors and ceilings, and walls that are not the window's ends */
static void outlines(const frame *f, const fw_cross_section *p) {
    double end = f->width / f->x_per_m;
    fw_svg_path(f->out, "fill='none' stroke='#222' stroke-width='0.4'");
    for (int i = 0; i < p->n; i++) {
        const fw_patch *q = &p->patch[i];
        bool left = q->low_m[0] > 0.0 || q->high_m[0] > 0.0;
        bool right = q->low_m[1] < end || q->high_m[1] < end;
        point(f, 'M', q->low_m[0], q->bottom_m);
        point(f, left ? 'L' : 'M', q->high_m[0], q->top_m);
        point(f, 'L', q->high_m[1], q->top_m);
        point(f, right ? 'L' : 'M', q->low_m[1], q->bottom_m);
        point(f, 'L', q->low_m[0], q->bottom_m);
    }
    fw_svg_path_end(f->out);
}

/* a line at 45 degrees through a box, from its floor; heights grow downward */
static void hatch_line(fw_text *out, double x0, double x1, double top, double low, double from) {
    double a = fmax(from, x0), b = fmin(from + (low - top), x1);
    if (b <= a) return;
    fw_svg_point(out, 'M', a, low - (a - from), 1);
    fw_svg_point(out, 'L', b, low - (b - from), 1);
}

static void hatch(const frame *f, const fw_cross_section *p) {
    bool any = false;
    for (int i = 0; i < p->n; i++) {
        const fw_patch *q = &p->patch[i];
        if (!isnan(q->film->thickness_m)) continue;
        if (!any) fw_svg_path(f->out, "fill='none' stroke='#222' stroke-width='0.4'");
        any = true;
        double x0 = q->low_m[0] * f->x_per_m, x1 = q->low_m[1] * f->x_per_m;
        double top = (f->high_m - q->top_m) * f->y_per_m;
        double low = (f->high_m - q->bottom_m) * f->y_per_m;
        for (double x = HATCH * floor((x0 - (low - top)) / HATCH); x < x1; x += HATCH)
            hatch_line(f->out, x0, x1, top, low, x);
    }
    if (any) fw_svg_path_end(f->out);
}

/* the zigzag through what is drawn thinner than it is */
static void breaks(const frame *f, const fw_cross_section *p) {
    for (int i = 0; i < p->n; i++) {
        const fw_patch *q = &p->patch[i];
        if (!q->film->shortened) continue;
        double y = (f->high_m - 0.5 * (q->top_m + q->bottom_m)) * f->y_per_m, up = 2.5;
        fw_svg_path(f->out, "fill='none' stroke='#fff' stroke-width='2'");
        for (double x = q->low_m[0] * f->x_per_m; x < q->low_m[1] * f->x_per_m + 6.0; x += 6.0) {
            fw_svg_point(f->out, x > q->low_m[0] * f->x_per_m ? 'L' : 'M',
                         fmin(x, q->low_m[1] * f->x_per_m), y + up, 1);
            up = -up;
        }
        fw_svg_path_end(f->out);
    }
}

void fw_section_draw(const fw_cross_section *p, const fw_section_scale *scale, double width,
                     fw_text *out, double *height) {
    frame f = {.out = out, .width = width, .x_per_m = width / scale->window_m};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < p->n; i++) {
        low = fmin(low, p->patch[i].bottom_m);
        high = fmax(high, p->patch[i].top_m);
    }
    f.y_per_m = f.x_per_m * scale->exaggeration;
    f.high_m = high + 1.0 / f.y_per_m;
    *height = p->n ? (high - low) * f.y_per_m + 2.0 : 0.0;
    if (p->n == 0) return;
    fills(&f, p);
    hatch(&f, p);
    breaks(&f, p);
    outlines(&f, p);
}

/* ---- legend ---- */

static void collect(const fw_films *films, fw_legend *list) {
    for (int column = 0; column < FW_STACK_COLUMNS; column++) {
        for (int i = 0; i < films->n; i++) {
            const fw_film *f = &films->film[i];
            if (!f->in[column] || (f->cut && !f->in[FW_STACK_STRUCTURE])) continue;
            fw_legend_add(list, &(fw_legend_entry){.material = f->material,
                                                   .exposed = f->exposed,
                                                   .thickness_m = f->thickness_m,
                                                   .top_m = f->top_m,
                                                   .reach_m = f->reach_m});
        }
        fw_legend_end_column(list);
    }
    fw_legend_from_the_top(list);
}

static void swatch(fw_text *out, const fw_legend_entry *e, double x, double y) {
    fw_svg_put(out,
               "rect x='{1}' y='{1}' width='9' height='9' fill='{r}' stroke='#222' "
               "stroke-width='0.5'\n",
               x, y, fw_paint_fill(e->material, e->exposed));
    if (!e->unknown) return;
    fw_svg_path(out, "fill='none' stroke='#222' stroke-width='0.4'");
    for (double from = x - 5.0; from < x + 9.0; from += 4.0)
        hatch_line(out, x, x + 9.0, y, y + 9.0, from);
    fw_svg_path_end(out);
}

static void legend(const fw_flow *flow, const fw_legend_entry *e, double x, double y,
                   fw_text *out) {
    char shown[32];
    swatch(out, e, x, y);
    fw_svg_open(out, "text x='{1}' y='{1}'", x + 13.0, y + 8.0);
    fw_text_escaped(out, e->exposed ? e->material : fw_paint_name(flow, e->material, shown));
    fw_text_add(out, e->exposed ? ", exposed" : "");
    if (e->reach_m > 0.0) {
        fw_text_add(out, " beyond ");
        fw_text_number(out, e->reach_m * 1e6, 3);
        fw_text_add(out, " µm from openings");
    } else if (e->unknown)
        fw_text_add(out, ", not stated");
    else {
        fw_text_add(out, " ");
        fw_text_number(out, e->thickness_m * 1e6, 3);
        fw_text_add(out, " µm");
    }
    fw_svg_close(out, "text\n");
}

/* the longest of 1, 2, 5, 10 ... um that is at most a quarter of the window */
static double bar_m(double window_m) {
    double best = 1e-6;
    for (int i = 0; i < 15; i++) {
        double m = round_number(i) * 1e-6;
        if (m <= 0.25 * window_m) best = m;
    }
    return best;
}

void fw_section_scale_bar(const fw_section_scale *scale, double width, double y, fw_text *out) {
    double m = bar_m(scale->window_m), to = m * width / scale->window_m;
    fw_svg_put(out, "path fill='none' stroke='#000' d='M1 {1}v6m0 -3h{1}m0 -3v6'\n", y + 3.0,
               to - 1.0);
    fw_svg_open(out, "text x='{1}' y='{1}'", to + 5.0, y + 9.5);
    fw_text_fixed(out, m < 1e-3 ? m * 1e6 : m * 1e3, 0);
    fw_text_add(out, m < 1e-3 ? " µm" : " mm");
    if (scale->exaggeration == 1.0)
        fw_text_add(out, ", heights to scale");
    else {
        fw_text_add(out, ", heights × ");
        fw_text_number(out, scale->exaggeration, 3);
    }
    fw_svg_close(out, "text\n");
}

int fw_section_legend(const fw_flow *flow, const fw_films *films, double width, int columns,
                      double y, fw_text *out) {
    fw_legend list = {.most = FW_LEGEND_MOST};
    collect(films, &list);
    int rows = (list.n + columns - 1) / columns;
    for (int i = 0; i < list.n; i++)
        legend(flow, &list.entry[i], width / columns * (i / rows) + 1.0, y + 14.0 * (i % rows),
               out);
    return rows;
}

fw_status fw_section_exact(fw_slicer *slicer, const fw_flow *flow, const fw_section_scale *scale,
                           int index, fw_text *out) {
    const double width = 310.0;
    double height;
    fw_cross_section profile;
    FW_TRY(fw_cross_section_of(slicer, flow, index, &profile));
    fw_text body = fw_text_new(out->arena);
    fw_section_draw(&profile, scale, width, &body, &height);
    fw_section_scale_bar(scale, width, height + 2.0, &body);
    int rows = fw_section_legend(flow, &profile.films, width, 2, height + 17.0, &body);
    FW_TRY(fw_text_end(&body));
    fw_svg_begin(out, &(fw_svg_frame){.width = width,
                                      .height = ceil(height + 18.0 + 14.0 * rows),
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .trail = "role='img'",
                                      .font = fw_svg_font_step,
                                      .font_size = 10});
    fw_svg_title(out, "section after this step: {s}", slicer->cut->name);
    fw_text_add(out, body.data);
    fw_svg_end(out);
    return fw_text_end(out);
}
