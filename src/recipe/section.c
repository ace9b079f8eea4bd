/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cross-section of the wafer, not to scale: a narrow and a wide part of the structure between
 * fields. */
#include "base/svg.h"
#include "process/stack.h"
#include "recipe/legend.h"
#include "recipe/profile.h"
#include "recipe/words.h"
#include <math.h>
#include <string.h>

enum { WIDTH = 310, SECTION = 150, HEIGHT = 118, BANDS = 7 };
/* which column each band shows, and its width; two flexures, their slot, a body */
static const int band_column[BANDS] = {1, 0, 1, 0, 1, 0, 1};
static const int band_width[BANDS] = {26, 9, 12, 9, 16, 52, 26};

/* lowest and highest drawn edge over the whole flow, so that the picture does not jump */
static fw_status extent(fw_arena *arena, const fw_flow *flow, double *low, double *high) {
    *low = 0.0;
    *high = 1.0;
    for (int i = 0; i < flow->nstep; i++) {
        fw_stack stack;
        if (flow->step[i].nchange == 0) continue;
        FW_TRY(fw_flow_stack(arena, flow, i, &stack, NULL));
        for (int column = 0; column < FW_STACK_COLUMNS; column++)
            for (int k = 0; k < stack.n[column]; k++) {
                const fw_cell *c = &stack.cell[column][k];
                *low = fmin(*low, c->bottom);
                *high = fmax(*high, c->bottom + c->height);
            }
    }
    return FW_OK;
}

static void rectangle(fw_text *out, double x, double y, double w, double h, const char *fill) {
    fw_svg_put(out, "rect x='{2}' y='{2}' width='{2}' height='{2}' fill='{r}'\n", x, y, w, h, fill);
}

/* outline of a cell: floor and ceiling always, walls only where the neighbour band differs */
static void stroke(fw_text *out, double x0, double y0, double x1, double y1) {
    fw_svg_point(out, 'M', x0, y0, 2);
    fw_svg_point(out, 'L', x1, y1, 2);
}

static bool has_cell(const fw_stack *s, int column, const fw_cell *like) {
    for (int i = 0; i < s->n[column]; i++) {
        const fw_cell *c = &s->cell[column][i];
        if (strcmp(c->material, like->material) == 0 && c->bottom == like->bottom &&
            c->height == like->height && c->exposed == like->exposed)
            return true;
    }
    return false;
}

static void draw_bands(fw_text *out, const fw_stack *s, double high, double scale, bool lines) {
    double x = 0.0;
    for (int band = 0; band < BANDS; band++) {
        int column = band_column[band];
        for (int i = 0; i < s->n[column]; i++) {
            const fw_cell *c = &s->cell[column][i];
            double top = (high - c->bottom - c->height) * scale,
                   floor_y = (high - c->bottom) * scale, w = band_width[band];
            bool edge = band == 0 || band == BANDS - 1;
            bool same = has_cell(s, 1 - column, c);
            if (!lines) {
                rectangle(out, x, top, w, floor_y - top, fw_paint_fill(c->material, c->exposed));
                continue;
            }
            stroke(out, x, top, x + w, top);
            stroke(out, x, floor_y, x + w, floor_y);
            if (!same && !(edge && band == 0)) stroke(out, x, top, x, floor_y);
            if (!same && !(edge && band > 0)) stroke(out, x + w, top, x + w, floor_y);
        }
        x += band_width[band];
    }
}

static void collect(const fw_stack *s, fw_legend *legend) {
    for (int column = 0; column < FW_STACK_COLUMNS; column++) {
        for (int i = 0; i < s->n[column]; i++) {
            const fw_cell *c = &s->cell[column][i];
            fw_legend_add(legend, &(fw_legend_entry){.material = c->material,
                                                     .exposed = c->exposed,
                                                     .thickness_m = c->thickness_m,
                                                     .top_m = c->bottom + c->height});
        }
        fw_legend_end_column(legend);
    }
    fw_legend_from_the_top(legend);
}

static void label(fw_text *out, const fw_flow *flow, const fw_legend_entry *l, int y) {
    fw_svg_put(out,
               "rect x='{i}' y='{i}' width='9' height='9' fill='{r}' stroke='#222' "
               "stroke-width='0.5'\n",
               SECTION + 10, y, fw_paint_fill(l->material, l->exposed));
    fw_svg_open(out, "text x='{i}' y='{i}'", SECTION + 23, y + 8);
    char shown[32];
    fw_text_escaped(out, l->exposed ? l->material : fw_paint_name(flow, l->material, shown));
    fw_text_add(out, l->exposed ? ", exposed" : "");
    if (l->unknown)
        fw_text_add(out, " ?");
    else {
        fw_text_add(out, " ");
        fw_text_number(out, l->thickness_m * 1e6, 3);
        fw_text_add(out, " µm");
    }
    fw_svg_close(out, "text\n");
}

fw_status fw_recipe_section_svg(const fw_flow *flow, int index, fw_text *out) {
    fw_stack stack;
    fw_legend legend = {.most = 8};
    double low, high;
    FW_TRY(extent(out->arena, flow, &low, &high));
    FW_TRY(fw_flow_stack(out->arena, flow, index, &stack, NULL));
    double scale = (HEIGHT - 4.0) / (high - low), top = -1e9, bottom = 1e9;
    collect(&stack, &legend);
    for (int column = 0; column < FW_STACK_COLUMNS; column++)
        for (int i = 0; i < stack.n[column]; i++) {
            const fw_cell *c = &stack.cell[column][i];
            top = fmax(top, c->bottom + c->height);
            bottom = fmin(bottom, c->bottom);
        }
    /* only as high as the layers or their names need */
    double height = ceil(fmax(fmax(top - bottom, 0.0) * scale + 4.0, 15.0 * legend.n + 2.0));
    fw_svg_begin(out, &(fw_svg_frame){.width = WIDTH,
                                      .height = height,
                                      .size = FW_SVG_SIZE_BEHIND,
                                      .trail = "role='img'",
                                      .font = fw_svg_font_step,
                                      .font_size = 10});
    fw_svg_title(out, "layers after this step, not to scale");
    high = top + 2.0 / scale; /* drawn from the top down */
    draw_bands(out, &stack, high, scale, false);
    fw_svg_path(out, "fill='none' stroke='#222' stroke-width='0.6'");
    draw_bands(out, &stack, high, scale, true);
    fw_svg_path_end(out);
    for (int i = 0; i < legend.n; i++)
        label(out, flow, &legend.entry[i], 2 + 15 * i);
    fw_svg_end(out);
    return fw_text_end(out);
}
