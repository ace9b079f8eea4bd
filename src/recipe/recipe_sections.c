/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/sort.h"
#include "base/svg.h"
#include "geometry/contour.h"
#include "geometry/segment.h"
#include "process/process.h"
#include "recipe/recipe_profile.h"
#include "recipe/recipe.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The section after every step as one picture and as numbers; the map of a release. */

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

/* ---- the map of a release ----
   When every place of the die is free, in eight steps up to the end of the step, and what stays bonded after it; the last
   place that comes free and the first that is lost; and below, in words, what is free when and what must hold, for whoever
   stands at the bench. */

enum { BANDS = 8, CELL = 2, MAP_MARGIN = 16, KEY = 192, LINE = 17 }; /* pixels: of a cell */
static const double MAP_WIDTH = CELL * FW_RECIPE_RELEASE_COLUMNS + 2 * MAP_MARGIN + KEY;

/* light to dark: what is free soon to what is free last; what stays is grey */
static const char *const colour[BANDS + 1] = {"#fdf3d0", "#f9dd9b", "#f4c16c", "#eb9f50", "#dc7a45",
                                              "#c25345", "#9a3550", "#6a1f57", "#9aa4ad"};

typedef struct release_picture {
    const fw_process_flow *flow;
    const fw_release_map *map;
    const fw_process_step *step;
    double reach_m, run_m, per_m; /* as planned, with its over-etch; pixels per metre */
    fw_text *out;
} release_picture;

/* minutes after which a reach is run; 0: not known. Every reach takes its part of the time. */
static double minutes(const release_picture *p, double reach_m) {
    const fw_process_step *s = p->step;
    bool known = s->time.computable && s->law && strcmp(s->law, "rate") == 0;
    return known ? s->time.nominal_s / 60.0 * reach_m / p->reach_m : 0.0;
}

/* of a distance as drawn: the foot of the walls stands outside by so much */
static int band_of(const release_picture *p, double distance_m) {
    double part = (distance_m + p->flow->release_foot_m) / p->run_m;
    return part >= 1.0 ? BANDS : part <= 0.0 ? 0 : (int)(part * BANDS);
}

/* runs of equal cells of a row as one stroke, a unit long for each cell; one path for all of a band */
static void bars(const release_picture *p, int band) {
    const fw_release_map *m = p->map;
    fw_svg_path(p->out, "fill='none' stroke='{r}' stroke-width='1.1'", colour[band]);
    for (int j = m->rows - 1; j >= 0; j--)
        for (int i = 0; i < m->columns; i++) {
            const float *row = m->distance_m + (size_t)j * (size_t)m->columns;
            int end = i;
            while (end < m->columns && row[end] >= 0.0F && band_of(p, (double)row[end]) == band)
                end++;
            if (end == i) continue;
            fw_text_printf(p->out, "M%d %d.5h%d", i, m->rows - 1 - j, end - i);
            i = end;
        }
    fw_svg_path_end(p->out);
}

static void edges(const release_picture *p, const fw_layout *layout, bool islands) {
    fw_geometry_sheet sheet = {.x0_m = p->map->box.x0 - MAP_MARGIN / p->per_m,
                               .y1_m = p->map->box.y1 + MAP_MARGIN / p->per_m,
                               .per_m = p->per_m,
                               .decimals = 1,
                               .most_rad = FW_GEOMETRY_ARC_PICTURE};
    fw_svg_path(p->out, "fill='none' stroke='#333333' stroke-width='0.4'");
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *piece = &layout->piece[i];
        bool solid = piece->role == FW_ROLE_STRUCTURE || piece->role == FW_ROLE_FLEXURE ||
                     piece->role == FW_ROLE_FRAME || piece->role == FW_ROLE_TETHER;
        if (solid && (piece->body != FW_ISLAND || islands))
            fw_geometry_svg_edges(p->out, &sheet, &piece->contour);
    }
    fw_svg_path_end(p->out);
}

static double x_of(const release_picture *p, double x_m) {
    return MAP_MARGIN + (x_m - p->map->box.x0) * p->per_m;
}

static double y_of(const release_picture *p, double y_m) {
    return MAP_MARGIN + (p->map->box.y1 - y_m) * p->per_m;
}

static void mark(const release_picture *p, const fw_release_part *part, const char *word) {
    double x = x_of(p, part->at.x), y = y_of(p, part->at.y);
    bool right = x > 0.6 * MAP_WIDTH;
    fw_svg_put(p->out,
               "circle cx='{c}' cy='{c}' r='5' fill='none' stroke='#0b3d91' stroke-width='1.6'\n",
               x, y);
    fw_svg_put(p->out,
               "text x='{c}' y='{c}' text-anchor='{r}' font-size='12' fill='#0b3d91' "
               "stroke='#ffffff' stroke-width='3' paint-order='stroke'>{s}\n",
               right ? x - 8.0 : x + 8.0, y + 4.0, right ? "end" : "start", word);
}

static void words(const release_picture *p, double x, double y, const char *fill,
                  const char *text) {
    fw_svg_put(p->out, "text x='{c}' y='{c}' font-size='12' fill='{r}'>{s}\n", x, y, fill, text);
}

/* a number at the right end of its column */
static void number(const release_picture *p, double x, double y, double value) {
    char text[32];
    fw_number_text(text, sizeof text, value, fw_number_plain(value, 3));
    fw_svg_put(p->out, "text x='{c}' y='{c}' text-anchor='end' font-size='12' fill='#222222'>{s}\n",
               x, y, text);
}

/* reach and, where the rate is known, minutes up to which every band comes free */
static void key(const release_picture *p, double top) {
    double x = MAP_WIDTH - KEY + 4.0;
    bool timed = minutes(p, p->run_m) > 0.0;
    words(p, x, top, "#222222", "free at the latest after");
    fw_svg_put(p->out,
               "text x='{c}' y='{c}' text-anchor='end' font-size='12' fill='#222222'>\u00b5m\n",
               x + 80.0, top + LINE);
    if (timed)
        fw_svg_put(p->out,
                   "text x='{c}' y='{c}' text-anchor='end' font-size='12' fill='#222222'>min\n",
                   x + 140.0, top + LINE);
    for (int k = 0; k <= BANDS; k++) {
        double y = top + 10.0 + LINE + 20.0 * k, to = (k + 1.0) / BANDS * p->run_m;
        fw_svg_put(p->out,
                   "rect x='{c}' y='{c}' width='16' height='14' fill='{r}' stroke='#555555' "
                   "stroke-width='0.5'\n",
                   x, y, colour[k]);
        if (k == BANDS) {
            words(p, x + 24.0, y + 11.0, "#222222", "still bonded at the end");
            continue;
        }
        number(p, x + 80.0, y + 11.0, 1e6 * to);
        if (timed) number(p, x + 140.0, y + 11.0, minutes(p, to));
    }
}

static void scale_bar(const release_picture *p, double y) {
    double x = MAP_WIDTH - KEY + 4.0, length = fw_svg_nice(40.0 / p->per_m);
    char text[32];
    fw_svg_put(p->out, "path d='M{c} {c}v6m0 -3h{c}m0 -3v6' fill='none' stroke='#222222'\n", x, y,
               length * p->per_m);
    fw_number_text(text, sizeof text, 1e6 * length, fw_number_plain(1e6 * length, 3));
    fw_svg_put(p->out, "text x='{c}' y='{c}' font-size='12' fill='#222222'>{s} \u00b5m\n",
               x + length * p->per_m + 6.0, y + 7.0, text);
}

/* "22.4 um (112 min)" */
static const char *when(const release_picture *p, fw_arena *arena, double reach_m) {
    char um[32], min[32];
    double t = minutes(p, reach_m);
    fw_number_text(um, sizeof um, 1e6 * reach_m, fw_number_plain(1e6 * reach_m, 3));
    fw_number_text(min, sizeof min, t, fw_number_plain(t, 3));
    const char *text = t > 0.0 ? fw_arena_printf(arena, "%s \u00b5m (%s min)", um, min)
                               : fw_arena_printf(arena, "%s \u00b5m", um);
    return text ? text : "";
}

enum { SENTENCES = 4 };

/* what is free when, where the step ends, what must hold, and what is not known */
static fw_status say(const release_picture *p, fw_arena *arena, double y) {
    const fw_release *r = p->flow->release;
    double foot = p->flow->release_foot_m;
    const char *line[SENTENCES] = {NULL};
    bool lost = r->weakest >= 0 && r->lost_m + foot <= p->run_m;
    FW_NEED(line[0] = fw_arena_printf(
                arena, "Everything that moves is free after %s; the last place is in %s.",
                when(p, arena, r->needed_m + foot), r->part[r->slowest].label));
    FW_NEED(line[1] = fw_arena_printf(
                arena, "Step %s is planned for %s and, with its over-etch, ends at %s.",
                p->step->id, when(p, arena, p->reach_m), when(p, arena, p->run_m)));
    if (r->weakest < 0)
        line[2] = "Nothing must stay on the wafer: the device may come off in one piece.";
    else
        FW_NEED(line[2] = fw_arena_printf(
                    arena, "Of what must stay, %s goes first, at %s: %s.",
                    r->part[r->weakest].label, when(p, arena, r->lost_m + foot),
                    lost ? "before the step ends, so that there is no window" : "stop before"));
    line[3] =
        p->flow->release_lag_known
            ? "Narrow openings are taken as slow as the flow's law says."
            : "Narrow openings may be slower, by how much is not known: read the release ladder "
              "of the test die first.";
    for (int i = 0; i < SENTENCES; i++)
        words(p, MAP_MARGIN, y + LINE * i, i == 2 && lost ? "#b00020" : "#222222", line[i]);
    return FW_OK;
}

/* the cells, drawn a unit large */
static void cells(const release_picture *p) {
    fw_svg_open(p->out, "g transform='translate({c} {c}) scale({c})'", (double)MAP_MARGIN,
                (double)MAP_MARGIN, (double)CELL);
    for (int k = 0; k <= BANDS; k++)
        bars(p, k);
    fw_svg_close(p->out, "g\n");
}

fw_status fw_recipe_release_map(fw_arena *arena, const fw_process_flow *flow,
                                const fw_layout *layout, bool islands, const fw_release_map **map) {
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(flow, &reach);
    *map = NULL;
    if (!flow->release || !s || !(reach > 0.0) || flow->release->slowest < 0) return FW_OK;
    return fw_release_map_make(arena, layout, islands, FW_RECIPE_RELEASE_COLUMNS, map);
}

fw_status fw_recipe_write_release_svg(fw_arena *arena, const fw_process_flow *flow,
                                      const fw_layout *layout, bool islands,
                                      const fw_release_map *map, bool file, fw_text *out) {
    enum { LEAST_KEY = 260 };
    const fw_release *r = flow->release;
    release_picture p = {.flow = flow, .map = map, .out = out};
    p.step = fw_process_flow_release_step(flow, &p.reach_m);
    p.run_m = fw_process_release_run(flow, p.step, p.reach_m);
    p.per_m = CELL * map->columns / (map->box.x1 - map->box.x0);
    double below = fmax(CELL * map->rows + 2.0 * MAP_MARGIN, LEAST_KEY);
    fw_svg_begin_picture(out, MAP_WIDTH, below + SENTENCES * LINE + 4.0, file);
    fw_svg_title(out, "{s}, step {s}: when every place is free", flow->id, p.step->id);
    fw_svg_paper(out, "#ffffff");
    cells(&p);
    edges(&p, layout, islands);
    if (r->slowest < r->own) mark(&p, &r->part[r->slowest], "free last");
    if (r->weakest >= 0 && r->weakest < r->own) mark(&p, &r->part[r->weakest], "lost first");
    key(&p, MAP_MARGIN + 12.0);
    scale_bar(&p, below - 24.0);
    FW_TRY(say(&p, arena, below + 12.0));
    fw_svg_end(out);
    return fw_text_end(out);
}
