/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The map of a release: when every place of the die is free, in eight steps up to the end of the step, and
   what stays bonded after it; the last place that comes free and the first that is lost; and below, in words,
   what is free when and what must hold, for whoever stands at the bench. */
#include "base/svg.h"
#include "geometry/contour.h"
#include "process/process.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

enum { BANDS = 8, CELL = 2, MARGIN = 16, KEY = 192, LINE = 17 }; /* pixels: of a cell */
static const double WIDTH = CELL * FW_RECIPE_RELEASE_COLUMNS + 2 * MARGIN + KEY;

/* light to dark: what is free soon to what is free last; what stays is grey */
static const char *const colour[BANDS + 1] = {"#fdf3d0", "#f9dd9b", "#f4c16c", "#eb9f50", "#dc7a45",
                                              "#c25345", "#9a3550", "#6a1f57", "#9aa4ad"};

typedef struct picture {
    const fw_process_flow *flow;
    const fw_release_map *map;
    const fw_process_step *step;
    double reach_m, run_m, per_m; /* as planned, with its over-etch; pixels per metre */
    fw_text *out;
} picture;

/* minutes after which a reach is run; 0: not known. Every reach takes its part of the time. */
static double minutes(const picture *p, double reach_m) {
    const fw_process_step *s = p->step;
    bool known = s->time.computable && s->law && strcmp(s->law, "rate") == 0;
    return known ? s->time.nominal_s / 60.0 * reach_m / p->reach_m : 0.0;
}

/* of a distance as drawn: the foot of the walls stands outside by so much */
static int band_of(const picture *p, double distance_m) {
    double part = (distance_m + p->flow->release_foot_m) / p->run_m;
    return part >= 1.0 ? BANDS : part <= 0.0 ? 0 : (int)(part * BANDS);
}

/* runs of equal cells of a row as one stroke, a unit long for each cell; one path for all of a band */
static void bars(const picture *p, int band) {
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

static double x_of(const picture *p, double x_m) {
    return MARGIN + (x_m - p->map->box.x0) * p->per_m;
}

static double y_of(const picture *p, double y_m) {
    return MARGIN + (p->map->box.y1 - y_m) * p->per_m;
}

static void mark(const picture *p, const fw_release_part *part, const char *word) {
    double x = x_of(p, part->at.x), y = y_of(p, part->at.y);
    bool right = x > 0.6 * WIDTH;
    fw_svg_put(p->out,
               "circle cx='{c}' cy='{c}' r='5' fill='none' stroke='#0b3d91' stroke-width='1.6'\n",
               x, y);
    fw_svg_put(p->out,
               "text x='{c}' y='{c}' text-anchor='{r}' font-size='12' fill='#0b3d91' "
               "stroke='#ffffff' stroke-width='3' paint-order='stroke'>{s}\n",
               right ? x - 8.0 : x + 8.0, y + 4.0, right ? "end" : "start", word);
}

static void words(const picture *p, double x, double y, const char *fill, const char *text) {
    fw_svg_put(p->out, "text x='{c}' y='{c}' font-size='12' fill='{r}'>{s}\n", x, y, fill, text);
}

/* a number at the right end of its column */
static void number(const picture *p, double x, double y, double value) {
    char text[32];
    fw_number_text(text, sizeof text, value, fw_number_plain(value, 3));
    fw_svg_put(p->out, "text x='{c}' y='{c}' text-anchor='end' font-size='12' fill='#222222'>{s}\n",
               x, y, text);
}

/* reach and, where the rate is known, minutes up to which every band comes free */
static void key(const picture *p, double top) {
    double x = WIDTH - KEY + 4.0;
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

static void scale_bar(const picture *p, double y) {
    double x = WIDTH - KEY + 4.0, length = fw_svg_nice(40.0 / p->per_m);
    char text[32];
    fw_svg_put(p->out, "path d='M{c} {c}v6m0 -3h{c}m0 -3v6' fill='none' stroke='#222222'\n", x, y,
               length * p->per_m);
    fw_number_text(text, sizeof text, 1e6 * length, fw_number_plain(1e6 * length, 3));
    fw_svg_put(p->out, "text x='{c}' y='{c}' font-size='12' fill='#222222'>{s} \u00b5m\n",
               x + length * p->per_m + 6.0, y + 7.0, text);
}

/* "22.4 um (112 min)" */
static const char *when(const picture *p, fw_arena *arena, double reach_m) {
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
static fw_status say(const picture *p, fw_arena *arena, double y) {
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
        words(p, MARGIN, y + LINE * i, i == 2 && lost ? "#b00020" : "#222222", line[i]);
    return FW_OK;
}

/* the cells, drawn a unit large */
static void cells(const picture *p) {
    fw_svg_open(p->out, "g transform='translate({c} {c}) scale({c})'", (double)MARGIN,
                (double)MARGIN, (double)CELL);
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
    picture p = {.flow = flow, .map = map, .out = out};
    p.step = fw_process_flow_release_step(flow, &p.reach_m);
    p.run_m = fw_process_release_run(flow, p.step, p.reach_m);
    p.per_m = CELL * map->columns / (map->box.x1 - map->box.x0);
    double below = fmax(CELL * map->rows + 2.0 * MARGIN, LEAST_KEY);
    fw_svg_begin_picture(out, WIDTH, below + SENTENCES * LINE + 4.0, file);
    fw_svg_title(out, "{s}, step {s}: when every place is free", flow->id, p.step->id);
    fw_svg_paper(out, "#ffffff");
    cells(&p);
    edges(&p, layout, islands);
    if (r->slowest < r->own) mark(&p, &r->part[r->slowest], "free last");
    if (r->weakest >= 0 && r->weakest < r->own) mark(&p, &r->part[r->weakest], "lost first");
    key(&p, MARGIN + 12.0);
    scale_bar(&p, below - 24.0);
    FW_TRY(say(&p, arena, below + 12.0));
    fw_svg_end(out);
    return fw_text_end(out);
}
