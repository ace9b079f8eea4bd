/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The map of a release: when every place of the die is free, in eight steps up to the end of the step, and
   what stays bonded after it; the last place that comes free and the first that is lost. */
#include "base/svg.h"
#include "geometry/geometry_svg.h"
#include "process/process.h"
#include "recipe/recipe.h"
#include <math.h>

enum { COLUMNS = 288, BANDS = 8, WIDTH = 800, MARGIN = 16, KEY = 190 };

/* light to dark: what is free soon to what is free last; what stays is grey */
static const char *const colour[BANDS + 1] = {"#fdf3d0", "#f9dd9b", "#f4c16c", "#eb9f50", "#dc7a45",
                                              "#c25345", "#9a3550", "#6a1f57", "#9aa4ad"};

typedef struct picture {
    const fw_process_flow *flow;
    const fw_release_map *map;
    double run_m, per_m; /* end of the step; pixels per metre */
    fw_text *out;
} picture;

/* of a distance as drawn: the foot of the walls stands outside by so much */
static int band_of(const picture *p, double distance_m) {
    double part = (distance_m + p->flow->release_foot_m) / p->run_m;
    return part >= 1.0 ? BANDS : part <= 0.0 ? 0 : (int)(part * BANDS);
}

/* runs of equal cells of a row as one stroke; one path for all of a band */
static void bars(const picture *p, int band) {
    const fw_release_map *m = p->map;
    double cell = (m->box.x1 - m->box.x0) / m->columns * p->per_m;
    fw_svg_path(p->out, "fill='none' stroke='{r}' stroke-width='{c}'", colour[band], cell + 0.15);
    for (int j = 0; j < m->rows; j++)
        for (int i = 0; i < m->columns; i++) {
            const float *row = m->distance_m + (size_t)j * (size_t)m->columns;
            int end = i;
            while (end < m->columns && row[end] >= 0.0F && band_of(p, (double)row[end]) == band)
                end++;
            if (end == i) continue;
            double x = MARGIN + i * cell, y = MARGIN + (m->rows - 0.5 - j) * cell;
            double to = MARGIN + end * cell;
            fw_svg_point(p->out, 'M', x, y, 1);
            fw_svg_point(p->out, 'L', to, y, 1);
            i = end;
        }
    fw_svg_path_end(p->out);
}

static void edges(const picture *p, const fw_layout *layout, bool islands) {
    fw_geometry_sheet sheet = {.x0_m = p->map->box.x0 - MARGIN / p->per_m,
                               .y1_m = p->map->box.y1 + MARGIN / p->per_m,
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

static void mark(const picture *p, const fw_release_part *part, const char *word) {
    double x = MARGIN + (part->at.x - p->map->box.x0) * p->per_m,
           y = MARGIN + (p->map->box.y1 - part->at.y) * p->per_m;
    fw_svg_put(p->out,
               "circle cx='{c}' cy='{c}' r='5' fill='none' stroke='#0b3d91' stroke-width='1.6'\n",
               x, y);
    fw_svg_put(p->out,
               "text x='{c}' y='{c}' font-size='11' fill='#0b3d91' stroke='#ffffff' "
               "stroke-width='2.5' paint-order='stroke'>{s}\n",
               x + 8.0, y + 4.0, word);
}

/* reach and, where the rate is known, minutes of every band */
static void key(const picture *p, const fw_process_step *s, double top) {
    fw_text *out = p->out;
    double minutes = s->time.computable ? s->time.nominal_s * (1.0 + s->overrun) / 60.0 : 0.0;
    double x = WIDTH - KEY + 6.0;
    char from[32], to[32], t0[32], t1[32];
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' fill='#222222'>{s}\n", x, top,
               s->time.computable ? "free after, um and min" : "free after, um");
    for (int k = 0; k <= BANDS; k++) {
        double y = top + 10.0 + 20.0 * k, low = (double)k / BANDS, high = (k + 1.0) / BANDS;
        fw_svg_put(out,
                   "rect x='{c}' y='{c}' width='16' height='14' fill='{r}' stroke='#555555' "
                   "stroke-width='0.5'\n",
                   x, y, colour[k]);
        fw_number_text(from, sizeof from, 1e6 * low * p->run_m, 3);
        fw_number_text(to, sizeof to, 1e6 * high * p->run_m, 3);
        fw_number_text(t0, sizeof t0, low * minutes, 3);
        fw_number_text(t1, sizeof t1, high * minutes, 3);
        if (k == BANDS)
            fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' fill='#222222'>stays bonded\n",
                       x + 22.0, y + 11.0);
        else if (minutes > 0.0)
            fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' fill='#222222'>{s}-{s}; {s}-{s}\n",
                       x + 22.0, y + 11.0, from, to, t0, t1);
        else
            fw_svg_put(out, "text x='{c}' y='{c}' font-size='11' fill='#222222'>{s} to {s}\n",
                       x + 22.0, y + 11.0, from, to);
    }
}

/* NULL release or an unknown reach: writes nothing. layout: with the flow's own marks */
fw_status fw_recipe_write_release_svg(fw_arena *arena, const fw_process_flow *flow,
                                      const fw_layout *layout, bool islands, fw_text *out) {
    double reach;
    const fw_process_step *s = fw_process_flow_release_step(flow, &reach);
    const fw_release *r = flow->release;
    if (!r || !s || !(reach > 0.0)) return FW_OK;
    picture p = {.flow = flow, .run_m = reach * (1.0 + s->overrun), .out = out};
    FW_TRY(fw_release_map_make(arena, layout, islands, COLUMNS, &p.map));
    p.per_m = (WIDTH - KEY - 2.0 * MARGIN) / (p.map->box.x1 - p.map->box.x0);
    double high = (p.map->box.y1 - p.map->box.y0) * p.per_m + 2.0 * MARGIN;
    fw_svg_begin_picture(out, WIDTH, fmax(high, 230.0), true);
    fw_svg_title(out, "{s}, step {s}: when every place is free", flow->id, s->id);
    fw_svg_paper(out, "#ffffff");
    for (int k = 0; k <= BANDS; k++)
        bars(&p, k);
    edges(&p, layout, islands);
    if (r->slowest >= 0) mark(&p, &r->part[r->slowest], "free last");
    if (r->weakest >= 0) mark(&p, &r->part[r->weakest], "lost first");
    key(&p, s, MARGIN + 12.0);
    fw_svg_end(out);
    return fw_text_end(out);
}
