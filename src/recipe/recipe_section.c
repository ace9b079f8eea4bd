/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of layers: colours and names of films, their legend, the stack not to scale, and the
   exact section along a cut. */
#include "base/svg.h"
#include "process/films.h"
#include "recipe/recipe_profile.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

/* Colours and names of films, the same in every picture of a run sheet. */

static const struct {
    const char *material, *fill;
} palette[] = {{"silicon-100", "#b9c2cf"},    {"silicon-substrate", "#a7b1c2"},
               {"porous-silicon", "#e9dfc6"}, {"copper-plated", "#d98a52"},
               {"copper-seed", "#8c4a21"},    {"aluminium", "#7d868f"},
               {"resist", "#f4c4cc"},         {"carrier-wax", "#f3eaa5"},
               {"carrier", "#e2e2e2"},        {"glass-carrier", "#cfe3ea"},
               {"gold", "#e3b64a"},           {"pad-gold", "#e3b64a"},
               {"chromium", "#5f6b73"}};

/* materials without a place in the palette take one of four tints by the sum of their letters */
const char *fw_recipe_paint_fill(const char *material, bool exposed) {
    static const char *const others[] = {"#c7dcc1", "#d5c9e3", "#c6e0e4", "#eed2bb"};
    unsigned sum = 0;
    if (exposed) return "#fdeef0";
    for (size_t i = 0; i < sizeof palette / sizeof palette[0]; i++)
        if (strcmp(palette[i].material, material) == 0) return palette[i].fill;
    for (const char *c = material; *c; c++)
        sum = 31 * sum + (unsigned char)*c;
    return others[sum % 4];
}

/* "silicon (100)" of "silicon (100), single crystal"; at most 26 bytes, ends of UTF-8 kept */
static const char *paint_name(const fw_process_flow *flow, const char *material, char shown[32]) {
    enum { MOST = 26 };
    const char *name = fw_process_flow_material_name(flow, material);
    size_t n = strcspn(name, ",(");
    while (n > 0 && name[n - 1] == ' ')
        n--;
    if (n > MOST) n = MOST;
    while (n > 0 && ((unsigned char)name[n] & 0xC0) == 0x80)
        n--;
    memcpy(shown, name, n);
    shown[n] = '\0';
    return shown;
}

/* ---- legend: one entry for each material, the topmost first ---- */

typedef struct legend_entry {
    const char *material;
    bool exposed, unknown; /* unknown: some layer's thickness is not stated */
    bool back;             /* was put on the back; said where the front has some, too */
    double thickness_m, top_m, reach_m;
} legend_entry;

enum { LEGEND_MOST = 16 };
typedef struct legend_list {
    int n, most; /* entries, and how many the picture has room for */
    legend_entry entry[LEGEND_MOST];
    double column_m[LEGEND_MOST]; /* thickness so far within the column */
} legend_list;

/* a layer of the column at hand; thickness_m NAN: not stated */
static void legend_add(legend_list *legend, const legend_entry *layer) {
    legend_entry *e = legend->entry;
    int at = 0;
    while (at < legend->n && (strcmp(e[at].material, layer->material) != 0 ||
                              e[at].exposed != layer->exposed || e[at].back != layer->back))
        at++;
    if (at == legend->most) return;
    if (at == legend->n) {
        e[legend->n++] = *layer;
        e[at].thickness_m = 0, legend->column_m[at] = 0;
    }
    e[at].unknown = e[at].unknown || isnan(layer->thickness_m);
    e[at].top_m = fmax(e[at].top_m, layer->top_m);
    e[at].reach_m = fmax(e[at].reach_m, layer->reach_m);
    legend->column_m[at] += layer->thickness_m;
}

/* ", exposed, back" */
static void legend_more(const legend_list *legend, const legend_entry *e, fw_text *out) {
    bool both = false;
    for (int i = 0; i < legend->n; i++)
        both = both || (!legend->entry[i].back && e->back &&
                        strcmp(legend->entry[i].material, e->material) == 0);
    fw_text_add(out, e->exposed ? ", exposed" : "");
    fw_text_add(out, both ? ", back" : "");
}

/* two coats of one material add up within a column; of all columns the thickest counts */
static void legend_end_column(legend_list *legend) {
    for (int i = 0; i < legend->n; i++) {
        legend->entry[i].thickness_m = fmax(legend->entry[i].thickness_m, legend->column_m[i]);
        legend->column_m[i] = 0;
    }
}

static void legend_from_the_top(legend_list *legend) {
    legend_entry *e = legend->entry;
    for (int i = 1; i < legend->n; i++)
        for (int k = i; k > 0 && e[k].top_m > e[k - 1].top_m; k--) {
            legend_entry swap = e[k];
            e[k] = e[k - 1];
            e[k - 1] = swap;
        }
}

/* Cross-section of the wafer, not to scale: a narrow and a wide part of the structure between
 * fields. */

enum { WIDTH = 310, SECTION = 150, HEIGHT = 118, BANDS = 7 };
/* which column each band shows, and its width; two flexures, their slot, a body */
static const int band_column[BANDS] = {1, 0, 1, 0, 1, 0, 1};
static const int band_width[BANDS] = {26, 9, 12, 9, 16, 52, 26};
enum { BANDS_MOST = FW_STACK_MOST };

typedef struct bands {
    int column[BANDS_MOST], n;
    double width[BANDS_MOST];
} bands;

/* a flow with further plates: field, structure with the last plate's inside, then without, the rest of the field */
static bands bands_of(const fw_process_flow *flow) {
    bands b = {.n = 0};
    int columns = fw_process_flow_columns(flow);
    fw_process_side field = {0, true}, last = {flow->nplate, true};
    for (int k = 0; columns == 2 && k < BANDS; k++)
        b.column[b.n] = band_column[k], b.width[b.n++] = band_width[k];
    if (columns == 2) return b;
    for (int turn = 0; turn < 4; turn++)
        for (int k = 0; k < columns; k++) {
            bool in_field = fw_process_side_holds(flow, field, k),
                 inside = fw_process_side_holds(flow, last, k);
            int when = in_field ? (k == FW_STACK_FIELD ? 0 : 3) : inside ? 1 : 2;
            if (when == turn) b.column[b.n++] = k;
        }
    for (int k = 0; k < b.n; k++)
        b.width[k] = SECTION / (double)b.n;
    return b;
}

/* lowest and highest drawn edge over the whole flow, so that the picture does not jump */
static fw_status extent(fw_arena *arena, const fw_process_flow *flow, double *low, double *high) {
    *low = 0.0;
    *high = 1.0;
    for (int i = 0; i < flow->nstep; i++) {
        fw_process_stack stack;
        if (flow->step[i].nchange == 0) continue;
        FW_TRY(fw_process_flow_stack(arena, flow, i, &stack, NULL));
        for (int column = 0; column < FW_STACK_MOST; column++)
            for (int k = 0; k < stack.n[column]; k++) {
                const fw_process_cell *c = &stack.cell[column][k];
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

static bool has_cell(const fw_process_stack *s, int column, const fw_process_cell *like) {
    for (int i = 0; i < s->n[column]; i++) {
        const fw_process_cell *c = &s->cell[column][i];
        if (strcmp(c->material, like->material) == 0 && c->bottom == like->bottom &&
            c->height == like->height && c->exposed == like->exposed)
            return true;
    }
    return false;
}

static void draw_bands(fw_text *out, const fw_process_stack *s, const bands *b, double high,
                       double scale, bool lines) {
    double x = 0.0;
    for (int band = 0; band < b->n; band++) {
        int column = b->column[band];
        for (int i = 0; i < s->n[column]; i++) {
            const fw_process_cell *c = &s->cell[column][i];
            double top = (high - c->bottom - c->height) * scale,
                   floor_y = (high - c->bottom) * scale, w = b->width[band];
            if (!lines) {
                rectangle(out, x, top, w, floor_y - top,
                          fw_recipe_paint_fill(c->material, c->exposed));
                continue;
            }
            stroke(out, x, top, x + w, top);
            stroke(out, x, floor_y, x + w, floor_y);
            if (band > 0 && !has_cell(s, b->column[band - 1], c)) stroke(out, x, top, x, floor_y);
            if (band < b->n - 1 && !has_cell(s, b->column[band + 1], c))
                stroke(out, x + w, top, x + w, floor_y);
        }
        x += b->width[band];
    }
}

static void collect(const fw_process_stack *s, legend_list *legend) {
    for (int column = 0; column < FW_STACK_MOST; column++) {
        for (int i = 0; i < s->n[column]; i++) {
            const fw_process_cell *c = &s->cell[column][i];
            legend_add(legend, &(legend_entry){.material = c->material,
                                               .exposed = c->exposed,
                                               .back = c->back,
                                               .thickness_m = c->thickness_m,
                                               .top_m = c->bottom + c->height});
        }
        legend_end_column(legend);
    }
    legend_from_the_top(legend);
}

static void label(fw_text *out, const fw_process_flow *flow, const legend_list *list,
                  const legend_entry *l, int y) {
    fw_svg_put(out,
               "rect x='{i}' y='{i}' width='9' height='9' fill='{r}' stroke='#222' "
               "stroke-width='0.5'\n",
               SECTION + 10, y, fw_recipe_paint_fill(l->material, l->exposed));
    fw_svg_open(out, "text x='{i}' y='{i}'", SECTION + 23, y + 8);
    char shown[32];
    fw_text_escaped(out, l->exposed ? l->material : paint_name(flow, l->material, shown));
    legend_more(list, l, out);
    if (l->unknown)
        fw_text_add(out, " ?");
    else {
        fw_text_add(out, " ");
        fw_text_number(out, l->thickness_m * 1e6, 3);
        fw_text_add(out, " µm");
    }
    fw_svg_close(out, "text\n");
}

fw_status fw_recipe_section_svg(const fw_process_flow *flow, int index, fw_text *out) {
    fw_process_stack stack;
    legend_list legend = {.most = 8};
    bands row = bands_of(flow);
    double low, high;
    FW_TRY(extent(out->arena, flow, &low, &high));
    FW_TRY(fw_process_flow_stack(out->arena, flow, index, &stack, NULL));
    double scale = (HEIGHT - 4.0) / (high - low), top = -1e9, bottom = 1e9;
    collect(&stack, &legend);
    for (int column = 0; column < FW_STACK_MOST; column++)
        for (int i = 0; i < stack.n[column]; i++) {
            const fw_process_cell *c = &stack.cell[column][i];
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
    draw_bands(out, &stack, &row, high, scale, false);
    fw_svg_path(out, "fill='none' stroke='#222' stroke-width='0.6'");
    draw_bands(out, &stack, &row, high, scale, true);
    fw_svg_path_end(out);
    for (int i = 0; i < legend.n; i++)
        label(out, flow, &legend, &legend.entry[i], 2 + 15 * i);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* The section along a cut, to scale along it; heights by one factor for all steps of a flow. */

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
fw_status fw_recipe_section_scale_of(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_recipe_cut *cut, fw_recipe_section_scale *scale) {
    *scale = (fw_recipe_section_scale){cut->length_m, 0.0, 0.0, 1.0};
    for (int i = 0; i < flow->nstep; i++) {
        fw_process_films films;
        if (!fw_process_step_changes(&flow->step[i])) continue;
        FW_TRY(fw_process_flow_films(arena, flow, i, &films));
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

static void area(const frame *f, const fw_recipe_patch *p, bool close) {
    point(f, 'M', p->low_m[0], p->bottom_m);
    point(f, 'L', p->high_m[0], p->top_m);
    point(f, 'L', p->high_m[1], p->top_m);
    point(f, 'L', p->low_m[1], p->bottom_m);
    fw_text_add(f->out, close ? "Z" : "");
}

/* patches of one film in one path */
static void fills(const frame *f, const fw_recipe_cross_section *p) {
    for (int i = 0; i < p->n;) {
        const fw_process_film *film = p->patch[i].film;
        fw_svg_path(f->out, "fill='{r}'", fw_recipe_paint_fill(film->material, film->exposed));
        for (; i < p->n && p->patch[i].film == film; i++)
            area(f, &p->patch[i], true);
        fw_svg_path_end(f->out);
    }
}

/* floors and ceilings, and walls that are not the window's ends */
static void outlines(const frame *f, const fw_recipe_cross_section *p) {
    double end = f->width / f->x_per_m;
    fw_svg_path(f->out, "fill='none' stroke='#222' stroke-width='0.4'");
    for (int i = 0; i < p->n; i++) {
        const fw_recipe_patch *q = &p->patch[i];
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

static void hatch(const frame *f, const fw_recipe_cross_section *p) {
    bool any = false;
    for (int i = 0; i < p->n; i++) {
        const fw_recipe_patch *q = &p->patch[i];
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
static void breaks(const frame *f, const fw_recipe_cross_section *p) {
    for (int i = 0; i < p->n; i++) {
        const fw_recipe_patch *q = &p->patch[i];
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

void fw_recipe_section_draw(const fw_recipe_cross_section *p, const fw_recipe_section_scale *scale,
                            double width, fw_text *out, double *height) {
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

static void exact_collect(const fw_process_films *films, legend_list *list) {
    for (int column = 0; column < FW_STACK_MOST; column++) {
        for (int i = 0; i < films->n; i++) {
            const fw_process_film *f = &films->film[i];
            if (!f->in[column] || (f->cut && !f->in[FW_STACK_STRUCTURE])) continue;
            legend_add(list, &(legend_entry){.material = f->material,
                                             .exposed = f->exposed,
                                             .back = f->back,
                                             .thickness_m = f->thickness_m,
                                             .top_m = f->top_m,
                                             .reach_m = f->reach_m});
        }
        legend_end_column(list);
    }
    legend_from_the_top(list);
}

static void swatch(fw_text *out, const legend_entry *e, double x, double y) {
    fw_svg_put(out,
               "rect x='{1}' y='{1}' width='9' height='9' fill='{r}' stroke='#222' "
               "stroke-width='0.5'\n",
               x, y, fw_recipe_paint_fill(e->material, e->exposed));
    if (!e->unknown) return;
    fw_svg_path(out, "fill='none' stroke='#222' stroke-width='0.4'");
    for (double from = x - 5.0; from < x + 9.0; from += 4.0)
        hatch_line(out, x, x + 9.0, y, y + 9.0, from);
    fw_svg_path_end(out);
}

static void legend_words(const fw_process_flow *flow, const legend_list *list,
                         const legend_entry *e, fw_text *out) {
    char shown[32];
    fw_text_escaped(out, e->exposed ? e->material : paint_name(flow, e->material, shown));
    legend_more(list, e, out);
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
}

static void legend(const fw_process_flow *flow, const legend_list *list, const legend_entry *e,
                   double x, double y, fw_text *out) {
    swatch(out, e, x, y);
    fw_svg_open(out, "text x='{1}' y='{1}'", x + 13.0, y + 8.0);
    legend_words(flow, list, e, out);
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

void fw_recipe_section_scale_bar(const fw_recipe_section_scale *scale, double width, double y,
                                 fw_text *out) {
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

/* of the longest entry with its box, in units of the picture, by what a letter of the font takes on average */
static double widest_legend(const fw_process_flow *flow, const legend_list *list, fw_text *out) {
    const double letter = 4.8, box = 16.0;
    double most = 0.0;
    for (int i = 0; i < list->n; i++) {
        fw_text words = fw_text_new(out->arena);
        legend_words(flow, list, &list->entry[i], &words);
        out->failed |= words.failed;
        most = fmax(most, box + letter * (double)words.length);
    }
    return most;
}

int fw_recipe_section_legend(const fw_process_flow *flow, const fw_process_films *films,
                             double width, int columns, double y, fw_text *out) {
    legend_list list = {.most = LEGEND_MOST};
    exact_collect(films, &list);
    while (columns > 1 && widest_legend(flow, &list, out) > width / columns)
        columns--;
    int rows = (list.n + columns - 1) / columns;
    for (int i = 0; i < list.n; i++)
        legend(flow, &list, &list.entry[i], width / columns * (i / rows) + 1.0,
               y + 14.0 * (i % rows), out);
    return rows;
}

fw_status fw_recipe_section_exact(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                  const fw_recipe_section_scale *scale, int index, fw_text *out) {
    const double width = 310.0;
    double height;
    fw_recipe_cross_section profile;
    FW_TRY(fw_recipe_cross_section_of(slicer, flow, index, &profile));
    fw_text body = fw_text_new(out->arena);
    fw_recipe_section_draw(&profile, scale, width, &body, &height);
    fw_recipe_section_scale_bar(scale, width, height + 2.0, &body);
    int rows = fw_recipe_section_legend(flow, &profile.films, width, 2, height + 17.0, &body);
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
