/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/sort.h"
#include "base/svg.h"
#include "geometry/segment.h"
#include "recipe/recipe_profile.h"
#include "recipe/recipe_words.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The section after every step as one picture and as numbers. */

static const double WIDTH = 860.0, MARGIN = 30.0;

/* ---- what lies along the cut ---- */

static int by_place(const void *left, const void *right) {
    const fw_recipe_section_part *p = left, *q = right;
    return fw_order_doubles(p->from_m, q->from_m);
}

static fw_status list_parts(fw_recipe_slicer *slicer, fw_recipe_section_plan *plan) {
    size_t room = 0;
    for (int k = 0; k < slicer->nshape; k++)
        room += (size_t)slicer->shape[k]->piece->contour.count;
    FW_NEED(plan->part = fw_arena_array(slicer->arena, fw_recipe_section_part, room));
    for (int k = 0; k < slicer->nshape; k++) {
        const fw_layout_piece *piece = slicer->shape[k]->piece;
        fw_geometry_slices in;
        if (slicer->term[slicer->term_of[k]].rule == FW_SET_NOT) continue;
        FW_TRY(fw_geometry_contour_slice(slicer->arena, &piece->contour, slicer->cut->line, &in));
        for (int i = 0; i < in.n; i++) {
            double from = fmax(in.item[i].from_m, 0.0);
            double to = fmin(in.item[i].to_m, slicer->cut->length_m);
            if (to - from > 1e-9)
                plan->part[plan->npart++] = (fw_recipe_section_part){from, to, piece->label};
        }
    }
    if (plan->npart > 1) qsort(plan->part, (size_t)plan->npart, sizeof *plan->part, by_place);
    return FW_OK;
}

/* the last film of the device's material: its walls are those that stay */
static fw_status device_film(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                             fw_process_film *out, bool *there) {
    fw_process_films films;
    *there = false;
    FW_TRY(fw_process_flow_films(slicer->arena, flow, flow->nstep - 1, &films));
    for (int i = 0; flow->material && i < films.n; i++)
        if (films.film[i].in[FW_STACK_STRUCTURE] && !films.film[i].in[FW_STACK_FIELD] &&
            strcmp(films.film[i].material, flow->material) == 0) {
            *out = films.film[i];
            *there = true;
        }
    return FW_OK;
}

/* opening number g between the parts of the structure with the edge at edge_m */
static fw_status width_at(fw_recipe_slicer *slicer, double edge_m, int g, int n, double *width_m) {
    const fw_recipe_outline_at *at;
    FW_TRY(fw_recipe_slicer_at(slicer, edge_m, &at));
    *width_m = (double)NAN;
    if (at->inside.n != n) return FW_OK; /* a part is gone there */
    *width_m =
        fw_recipe_slicer_opening(slicer, at, g + 1); /* opening 0 lies before the first part */
    return FW_OK;
}

static fw_status list_openings(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                               fw_recipe_section_plan *plan) {
    const fw_recipe_outline_at *drawn;
    fw_process_film film = {0};
    bool there;
    FW_TRY(fw_recipe_slicer_at(slicer, 0.0, &drawn));
    FW_TRY(device_film(slicer, flow, &film, &there));
    const fw_geometry_slice *in = drawn->inside.item;
    int n = drawn->inside.n;
    FW_NEED(plan->opening =
                fw_arena_array(slicer->arena, fw_recipe_section_opening, (size_t)n + 1));
    for (int g = 0; g + 1 < n; g++) {
        if (in[g].to_m < 0.0 || in[g + 1].from_m > slicer->cut->length_m) continue;
        fw_recipe_section_opening *o = &plan->opening[plan->nopening++];
        *o = (fw_recipe_section_opening){.from_m = in[g].to_m,
                                         .to_m = in[g + 1].from_m,
                                         .top_m = (double)NAN,
                                         .bottom_m = (double)NAN,
                                         .depth_m = (double)NAN};
        FW_TRY(width_at(slicer, 0.0, g, n, &o->drawn_m));
        FW_TRY(width_at(slicer, slicer->mask->bias_m, g, n, &o->mask_m));
        if (!there) continue;
        FW_TRY(width_at(slicer, film.head_m, g, n, &o->top_m));
        FW_TRY(width_at(slicer, film.foot_m, g, n, &o->bottom_m));
        if (!film.cut) continue;
        double masked;
        FW_TRY(width_at(slicer, film.mask_edge_m, g, n, &masked));
        o->depth_m = fw_process_cut_depth(film.cut, masked);
        double more = fw_recipe_foot_more(flow, film.cut, masked);
        if (!isnan(more)) o->bottom_m -= 2.0 * more;
    }
    return FW_OK;
}

fw_status fw_recipe_section_plan_of(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                    fw_recipe_section_plan *plan) {
    *plan = (fw_recipe_section_plan){0};
    FW_TRY(list_parts(slicer, plan));
    return list_openings(slicer, flow, plan);
}

/* ---- the picture ---- */

static void um(fw_text *out, double m) {
    if (isnan(m))
        fw_text_add(out, "gone");
    else
        fw_text_number(out, m * 1e6, 4);
}

/* numbers of the parts over the section, then what they are */
static double parts(const fw_recipe_section_plan *plan, const fw_recipe_section_scale *scale,
                    double width, fw_text *out) {
    double per_m = width / scale->window_m, y = 0.0, last = -20.0;
    for (int i = 0; i < plan->npart; i++) {
        double x = 0.5 * (plan->part[i].from_m + plan->part[i].to_m) * per_m;
        fw_svg_put(out, "path stroke='#000' stroke-width='2' d='M{1} 16H{1}'\n",
                   plan->part[i].from_m * per_m, plan->part[i].to_m * per_m);
        if (x - last < 14.0) continue; /* two numbers would lie on each other */
        last = x;
        fw_svg_put(out, "text x='{1}' y='11' text-anchor='middle'>{i}\n", x, i + 1);
    }
    for (int i = 0; i < plan->npart; i++, y += 15.0) {
        fw_svg_open(out, "text x='0' y='{1}'", 34.0 + y);
        fw_markup(out, "{i}&#160; {s}", i + 1, plan->part[i].label);
        fw_text_add(out, ", ");
        um(out, plan->part[i].to_m - plan->part[i].from_m);
        fw_text_add(out, " µm along the cut");
        fw_svg_close(out, "text\n");
    }
    for (int i = 0; i < plan->nopening; i++, y += 15.0) {
        const fw_recipe_section_opening *o = &plan->opening[i];
        fw_svg_open(out, "text x='0' y='{1}'", 34.0 + y);
        fw_text_add(out, "opening from ");
        um(out, o->from_m);
        fw_text_add(out, " to ");
        um(out, o->to_m);
        fw_text_add(out, " µm: ");
        um(out, o->drawn_m);
        fw_text_add(out, " µm wide as drawn, ");
        um(out, o->mask_m);
        fw_text_add(out, " on the mask, ");
        um(out, o->top_m);
        fw_text_add(out, " at the top in the end, ");
        um(out, o->bottom_m);
        fw_text_add(out, " at the bottom");
        if (!isnan(o->depth_m)) {
            fw_text_add(out, "; etched ");
            um(out, o->depth_m);
            fw_text_add(out, " µm deep");
        }
        fw_svg_close(out, "text\n");
    }
    return 34.0 + y;
}

static void step_title(const fw_process_step *s, double y, fw_text *out) {
    fw_svg_put(out, "text x='0' y='{1}' font-size='14' font-weight='bold'>{s}&#160; {s}\n", y,
               s->id, s->title);
}

/* steps that leave the films as they are, in one line */
static double quiet_steps(const fw_process_flow *flow, int from, int to, double y, fw_text *out) {
    if (from > to) return y;
    fw_svg_open(out, "text x='0' y='{1}' fill='#444'", y + 12.0);
    fw_text_escaped(out, flow->step[from].id);
    if (to > from) {
        fw_text_add(out, " to ");
        fw_text_escaped(out, flow->step[to].id);
    }
    fw_text_add(out, ": no change of the layers");
    fw_svg_close(out, "text\n");
    return y + 26.0;
}

static fw_status steps(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                       const fw_recipe_section_scale *scale, double width, double *y,
                       fw_text *out) {
    fw_recipe_cross_section before = {0};
    int quiet = 0;
    for (int i = 0; i < flow->nstep; i++) {
        if (!fw_process_step_changes(&flow->step[i])) continue;
        fw_recipe_cross_section p;
        double height;
        *y = quiet_steps(flow, quiet, i - 1, *y, out);
        quiet = i + 1;
        FW_TRY(fw_recipe_cross_section_of(slicer, flow, i, &p));
        step_title(&flow->step[i], *y + 14.0, out);
        fw_svg_open(out, "g transform='translate(0 {1})'\n", *y + 22.0);
        fw_recipe_section_draw(&p, scale, width, out, &height);
        int rows = fw_recipe_section_legend(flow, &p.films, width, 3, height + 6.0, out);
        fw_svg_close(out, "g\n");
        *y += 22.0 + height + 8.0 + 14.0 * rows;
        for (int k = 0; k < p.films.nnote; k++) {
            if (!fw_process_films_is_new(&p.films, &before.films, k)) continue;
            fw_svg_put(out, "text x='0' y='{1}' fill='#444'>{s}.\n", *y + 10.0, p.films.note[k]);
            *y += 14.0;
        }
        *y += 16.0;
        before = p;
    }
    *y = quiet_steps(flow, quiet, flow->nstep - 1, *y, out);
    return FW_OK;
}

static void cut_text(const fw_recipe_cut *cut, fw_text *out) {
    fw_geometry_vec2 b = vec_along(cut->line.at, cut->length_m, cut->line.along);
    const double value[] = {cut->line.at.x, cut->line.at.y, b.x, b.y};
    fw_text_add(out, "Cut: ");
    fw_text_escaped(out, cut->name);
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, i == 0 ? ", from (" : i == 2 ? ") to (" : ", ");
        fw_text_fixed(out, value[i] * 1e6, 3);
    }
    fw_text_add(out, ") µm");
}

/* title, device, cut and REJECTED; 40 high */
static void section_head(const fw_process_flow *flow, const fw_recipe_header *header,
                         const char *what, fw_text *out) {
    fw_svg_put(out, "text x='0' y='20' font-size='16' font-weight='bold'>{s}: {s}, {r}\n",
               header->device, flow->title, what);
    fw_svg_open(out, "text x='0' y='38'");
    cut_text(header->cut, out);
    fw_svg_close(out, "text\n");
    if (!header->rejected) return;
    fw_svg_put(out,
               "text x='{1}' y='38' text-anchor='end' font-size='14' font-weight='bold' "
               "fill='#b00020'>REJECTED - DO NOT FABRICATE\n",
               WIDTH - 2.0 * MARGIN);
}

/* body in a page of WIDTH, `height` high */
static fw_status section_page(const fw_text *body, double height, const char *title, fw_text *out) {
    FW_TRY(fw_text_end(body));
    double whole = ceil(height + 2.0 * MARGIN);
    fw_svg_begin(out, &(fw_svg_frame){.width = WIDTH,
                                      .height = whole,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .font = fw_svg_font_sheet,
                                      .font_size = 11});
    fw_svg_title(out, "{r}", title);
    fw_svg_put(out, "rect width='{c}' height='{c}' fill='#fff'\n", WIDTH, whole);
    fw_svg_open(out, "g transform='translate({c} {c})'\n", MARGIN, MARGIN);
    fw_text_add(out, body->data);
    fw_svg_close(out, "g\n");
    fw_svg_end(out);
    return fw_text_end(out);
}

fw_status fw_recipe_write_sections_svg(const fw_process_flow *flow, const fw_recipe_header *header,
                                       fw_text *out) {
    fw_recipe_slicer slicer;
    fw_recipe_section_scale scale;
    fw_recipe_section_plan plan;
    const double width = WIDTH - 2.0 * MARGIN;
    FW_TRY(fw_recipe_slicer_start(out->arena, header->mask, header->cut, &slicer));
    FW_TRY(fw_recipe_section_scale_of(out->arena, flow, header->cut, &scale));
    FW_TRY(fw_recipe_section_plan_of(&slicer, flow, &plan));
    fw_text body = fw_text_new(out->arena);
    section_head(flow, header, "section after every step", &body);
    double y = 44.0;
    fw_recipe_section_scale_bar(&scale, width, y, &body);
    fw_svg_open(&body, "g transform='translate(0 62)'\n");
    y = 62.0 + parts(&plan, &scale, width, &body) + 4.0;
    fw_svg_close(&body, "g\n");
    FW_TRY(steps(&slicer, flow, &scale, width, &y, &body));
    return section_page(&body, y, "section after every step", out);
}

/* The block behind the cut after every step that changes the wafer: two in a row. */

fw_status fw_recipe_write_stack_svg(const fw_process_flow *flow, const fw_recipe_header *header,
                                    fw_text *out) {
    enum { COLUMNS = 2 };
    const double whole = 800.0, own = 385.0, across = whole / COLUMNS;
    fw_recipe_slicer slicer;
    fw_recipe_section_scale scale;
    FW_TRY(fw_recipe_slicer_start(out->arena, header->mask, header->cut, &slicer));
    FW_TRY(fw_recipe_section_scale_of(out->arena, flow, header->cut, &scale));
    fw_text body = fw_text_new(out->arena);
    section_head(flow, header, "what stands behind the cut", &body);
    fw_recipe_section_scale_bar(&scale, own * cos(0.5), 44.0, &body);
    double y = 70.0, row = 0.0;
    int column = 0;
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        double height;
        fw_process_films films;
        if (!fw_process_step_changes(s)) continue;
        fw_svg_open(&body, "g transform='translate({1} {1})'\n", across * column, y);
        fw_svg_put(&body, "text y='12' font-size='13' font-weight='bold'>{s}&#160; {s}\n", s->id,
                   s->title);
        fw_svg_open(&body, "g transform='translate(0 20)'\n");
        FW_TRY(fw_recipe_block_draw(&slicer, flow, &scale, i, own, &body, &height));
        FW_TRY(fw_process_flow_films(out->arena, flow, i, &films));
        int rows = fw_recipe_section_legend(flow, &films, own, 2, height + 4.0, &body);
        fw_svg_close(&body, "g");
        fw_svg_close(&body, "g\n");
        row = fmax(row, height + 44.0 + 14.0 * rows);
        if (++column < COLUMNS) continue;
        column = 0;
        y += row;
        row = 0.0;
    }
    return section_page(&body, y + row, "what stands behind the cut", out);
}
