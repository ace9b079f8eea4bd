/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the measurements of a log say: control charts, with limits by the ranges within subgroups, and their picture; the
   coupons as calibrate takes them. */
#include "base/svg.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

/* ---- limits, and what breaks the rules ---- */

bool fw_recipe_chart_factors(int n, double *A2, double *D3, double *D4) {
    static const double factor[][3] = {
        {1.880, 0.0, 3.267},   {1.023, 0.0, 2.574},   {0.729, 0.0, 2.282},
        {0.577, 0.0, 2.114},   {0.483, 0.0, 2.004},   {0.419, 0.076, 1.924},
        {0.373, 0.136, 1.864}, {0.337, 0.184, 1.816}, {0.308, 0.223, 1.777}};
    if (n < 2 || n > 10) return false;
    *A2 = factor[n - 2][0], *D3 = factor[n - 2][1], *D4 = factor[n - 2][2];
    return true;
}

/* the most frequent number of sites, of two the larger */
static int frequent(const fw_recipe_chart *c, int *times) {
    int best = 1;
    *times = 0;
    for (int i = 0; i < c->npoint; i++) {
        int n = 0;
        for (int k = 0; k < c->npoint; k++)
            n += c->point[k].n == c->point[i].n;
        if (n > *times || (n == *times && c->point[i].n > best)) best = c->point[i].n, *times = n;
    }
    return best;
}

/* |x_i - x_(i-1)| of individual values, none at the first */
static void moving_ranges(fw_recipe_chart *c) {
    const fw_recipe_chart_point *before = NULL;
    for (int i = 0; i < c->npoint; i++) {
        fw_recipe_chart_point *p = &c->point[i];
        if (p->n != 1) continue;
        p->range = before ? fabs(p->mean - before->mean) : (double)NAN;
        before = p;
    }
}

static void averages(fw_recipe_chart *c) {
    int ranges = 0;
    c->centre = c->range_centre = 0.0;
    for (int i = 0; i < c->npoint; i++) {
        const fw_recipe_chart_point *p = &c->point[i];
        if (p->n != c->size) continue;
        c->centre += p->mean / c->counted;
        if (!isnan(p->range)) c->range_centre += p->range, ranges++;
    }
    c->range_centre = ranges ? c->range_centre / ranges : (double)NAN;
}

static void mark(fw_recipe_chart *c) {
    int same = 0, side = 0;
    for (int i = 0; i < c->npoint; i++) {
        fw_recipe_chart_point *p = &c->point[i];
        if (p->n != c->size) continue;
        int is = (p->mean > c->centre) - (p->mean < c->centre);
        same = is != 0 && is == side ? same + 1 : is != 0;
        side = is;
        p->run = same >= FW_CHART_RUN;
        p->beyond = p->mean < c->lower || p->mean > c->upper;
        p->range_beyond = p->range < c->range_lower || p->range > c->range_upper;
    }
}

/* Subgroups of n = 2 to 10 sites: xbar-bar +- A2 R-bar, ranges D3 R-bar to D4 R-bar. Individual values: x-bar +- 2.66
   MR-bar, moving ranges of two 0 to 3.267 MR-bar (2.66 = 3/d2(2), 3.267 = D4(2)). Limits of their own from 8 subgroups of
   one size on (trial limits until 20); with fewer there are none. Out of control: beyond a limit, or the eighth and every
   further of a run on one side of the centre. Input and output in the unit of what was measured. A false alarm of the
   limits is one in 370 points of a normal distribution, of the runs one in 128 starts.
   Source: D. C. Montgomery, Introduction to Statistical Quality Control, 6.2, 6.4 and appendix VI; NIST/SEMATECH e-Handbook
   of Statistical Methods, 6.3.2. Test: test_asrun_measured.c. */
void fw_recipe_chart_judge(fw_recipe_chart *c) {
    double A2 = 2.66, D3 = 0.0, D4 = 3.267;
    c->size = frequent(c, &c->counted);
    moving_ranges(c);
    averages(c);
    c->limits = c->counted >= FW_CHART_LEAST &&
                (c->size == 1 || fw_recipe_chart_factors(c->size, &A2, &D3, &D4));
    if (!c->limits) return;
    c->lower = c->centre - A2 * c->range_centre;
    c->upper = c->centre + A2 * c->range_centre;
    c->range_lower = D3 * c->range_centre;
    c->range_upper = D4 * c->range_centre;
    mark(c);
}

/* ---- the picture ----
   Means above, ranges below. What is accepted is a band, limits are dashed lines, points that break a rule are red and
   filled. */

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

static void put_label(fw_text *out, double x, double y, const char *name, double value) {
    fw_svg_open(out, "text x='{c}' y='{c}'", x, y);
    fw_text_printf(out, "%s ", name);
    fw_recipe_put_value(out, value);
    fw_svg_close(out, "text\n");
}

static void frame(const panel *p, const char *name) {
    fw_text *out = p->out;
    const double right = WIDTH - RIGHT;
    double step = fw_svg_nice((p->high - p->low) * MEANS / p->height / 5.0);
    for (double v = ceil(p->low / step) * step; v <= p->high; v += step) {
        fw_svg_put(out, "path stroke='#ddd' d='M{c} {c}H{c}'\n", (double)LEFT, y_of(p, v), right);
        fw_svg_open(out, "text x='{c}' y='{c}' text-anchor='end'", LEFT - 6.0, y_of(p, v) + 4.0);
        fw_svg_tick(out, v, step);
        fw_svg_close(out, "text\n");
    }
    fw_svg_put(out, "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='none' stroke='#999'\n",
               (double)LEFT, p->top, right - LEFT, p->height);
    fw_svg_put(out, "text transform='translate(14 {c}) rotate(-90)' text-anchor='middle'>{s}\n",
               p->top + 0.5 * p->height, name);
}

/* a line across the panel; its value is written at the right edge by names() */
static void level(panel *p, double value, const char *style, const char *name) {
    if (!isfinite(value)) return;
    double y = y_of(p, value);
    fw_svg_put(p->out, "path {r} d='M{c} {c}H{c}'\n", style, (double)LEFT, y,
               (double)(WIDTH - RIGHT));
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
    for (int i = 0; i < p->nnamed; i++)
        put_label(p->out, WIDTH - RIGHT + 5.0, p->named[i].y + 4.0, p->named[i].name,
                  p->named[i].value);
}

static const char dashed[] = "stroke='#b00' stroke-dasharray='6 3'";
static const char solid[] = "stroke='#555'";
static const char dotted[] = "stroke='#2a7' stroke-dasharray='2 3'";
static const char green[] = "stroke='#2a7'";

static void points(const panel *p, bool ranges) {
    const fw_recipe_chart *c = p->chart;
    char command = 'M';
    fw_svg_path(p->out, "fill='none' stroke='#357'");
    for (int i = 0; i < c->npoint; i++) {
        double value = ranges ? c->point[i].range : c->point[i].mean;
        if (isnan(value)) continue;
        fw_svg_point(p->out, command, x_of(c, i), y_of(p, value), 2);
        command = 'L';
    }
    fw_svg_path_end(p->out);
    for (int i = 0; i < c->npoint; i++) {
        const fw_recipe_chart_point *q = &c->point[i];
        double value = ranges ? q->range : q->mean;
        bool bad = ranges ? q->range_beyond : q->beyond || q->run || q->outside;
        const char *fill = q->n == c->size ? "#357" : "#fff";
        if (!isnan(value))
            fw_svg_put(p->out, "circle cx='{c}' cy='{c}' r='{c}' fill='{r}' stroke='{r}'\n",
                       x_of(c, i), y_of(p, value), bad ? 5.0 : 3.5, bad ? "#d22" : fill,
                       bad ? "#800" : "#357");
    }
}

static void labels(const fw_recipe_chart *c, double y, fw_text *out) {
    int every = c->npoint / 16 + 1;
    for (int i = 0; i < c->npoint; i += every)
        fw_svg_put(out, "text x='{c}' y='{c}' text-anchor='middle'>{s}\n", x_of(c, i), y,
                   c->point[i].label);
    fw_svg_put(out, "text x='{c}' y='{c}'>wafer\n", WIDTH - RIGHT + 5.0, y);
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
        fw_svg_put(out, "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='#e3f4ea'\n",
                   (double)LEFT, y_of(&p, top), (double)(WIDTH - LEFT - RIGHT),
                   fmax(y_of(&p, bottom) - y_of(&p, top), 0.0));
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
    fw_svg_begin(out, &(fw_svg_frame){.width = WIDTH,
                                      .height = TOP + MEANS + BETWEEN + RANGES + BELOW,
                                      .size = FW_SVG_SIZE_NONE,
                                      .font = fw_svg_font_page,
                                      .font_size = 11});
    fw_svg_title(out, "{s}", c->title);
    fw_svg_open(out, "text x='{c}' y='16' font-size='13'", (double)LEFT);
    fw_text_escaped(out, c->title);
    if (c->unit[0]) {
        fw_text_add(out, ", ");
        fw_recipe_put_unit(out, c->unit);
    }
    fw_svg_close(out, "text\n");
    means(c, out);
    ranges(c, out);
    fw_svg_end(out);
}

/* ---- the coupons of a log, as calibrate takes them ---- */

static bool of_wafer(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return !a->wafer || !b->wafer || strcmp(a->wafer, b->wafer) == 0;
}

/* Is b, which comes later, in the place of a? It reads the same feature of the same drawn size again. A rate is read off
   several times of one wafer, which are readings of their own; where all readings of a coupon are of one run, another `at` is
   that of the run that counts, or corrects what was mistyped. Other drawn sizes are other readings, and stay. */
static bool same_reading(const fw_recipe_asrun_entry *a, const fw_recipe_coupon *ca,
                         const fw_recipe_asrun_entry *b, const fw_recipe_coupon *cb) {
    const char *wa = a->wafer ? a->wafer : "", *wb = b->wafer ? b->wafer : "";
    bool drawn = isnan(ca->row.drawn_m) ? isnan(cb->row.drawn_m)
                                        : fabs(ca->row.drawn_m - cb->row.drawn_m) < 1e-12;
    bool under = isnan(ca->row.at) ? isnan(cb->row.at) : ca->row.at == cb->row.at;
    if (a->step != b->step || strcmp(wa, wb) != 0 || !drawn ||
        strcmp(ca->row.coupon, cb->row.coupon) != 0 ||
        strcmp(ca->row.feature, cb->row.feature) != 0)
        return false;
    return under || (a != b && fw_process_coupon_of_one_run(ca->row.coupon));
}

/* in a later entry or further on in this one; the last such reading counts */
static bool read_again(const fw_recipe_asrun *run, int entry, int coupon,
                       fw_recipe_read_again *again) {
    const fw_recipe_asrun_entry *e = &run->entry[entry];
    *again = (fw_recipe_read_again){.entry = e, .coupon = &e->coupon[coupon]};
    for (int i = entry; i < run->nentry; i++)
        for (int k = i == entry ? coupon + 1 : 0; k < run->entry[i].ncoupon; k++)
            if (same_reading(e, again->coupon, &run->entry[i], &run->entry[i].coupon[k])) {
                again->by = &run->entry[i];
                again->by_coupon = &run->entry[i].coupon[k];
            }
    return again->by;
}

bool fw_recipe_asrun_read_again(const fw_recipe_asrun *run, int *entry, int *coupon,
                                fw_recipe_read_again *again) {
    for (; *entry < run->nentry; ++*entry, *coupon = 0)
        while (*coupon < run->entry[*entry].ncoupon)
            if (read_again(run, *entry, (*coupon)++, again)) return true;
    return false;
}

static void warn_again(const fw_recipe_read_again *again, fw_diags *diags) {
    const char *wafer = again->entry->wafer;
    fw_diag_warning(diags, 610, again->coupon->row.place,
                    "'%s' of step %s%s%s does not count: line %d reads it again ('%s'). %s",
                    again->coupon->text, again->entry->step->id, wafer ? ", wafer " : "",
                    wafer ? wafer : "", again->by->line, again->by_coupon->text,
                    FW_RECIPE_KEEP_BOTH);
}

/* of a wafer that was scrapped or held by then: what was read is of another state than the flow's */
static bool is_out(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                   const fw_recipe_coupon *c, fw_diags *diags) {
    const fw_recipe_asrun_entry *out =
        e->wafer ? fw_recipe_asrun_out(run, e->wafer, e->end_s) : NULL;
    if (!out) return false;
    fw_diag_warning(diags, 604, c->row.place,
                    "'%s' of step %s does not count: wafer %s was %s at %s before (line %d)",
                    c->text, e->step->id, e->wafer, fw_recipe_fate_word(out->fate), out->at->id,
                    out->line);
    return true;
}

/* how it went otherwise than planned; of: "S14 (line 3)", "" of the entry itself */
static void put_how(fw_text *out, const fw_recipe_asrun_entry *o, const char *of) {
    const fw_recipe_measured *m = of[0] ? fw_recipe_asrun_not_accepted(o) : NULL;
    for (int i = 0; i < o->nset; i++)
        if (!fw_recipe_asrun_allowed(&o->set[i])) {
            fw_text_printf(out, "; %s%s was ", of, o->set[i].name);
            fw_recipe_put_value(out, o->set[i].value);
            if (strcmp(o->set[i].q->unit, "1") != 0) fw_text_printf(out, " %s", o->set[i].q->unit);
        }
    if (m) fw_text_printf(out, "; %s%s was %s, which is not accepted", of, m->measure, m->value);
    if (o->deviation) fw_text_printf(out, "; %swritten down: %s", of, o->deviation);
}

/* Readings of a step that was not run as it is meant to be, or of a wafer of which an earlier one was not, where what is found
   takes that wafer to be as planned (`planned`), speak of that run. They count, since nobody else knows whether what they tell
   depends on it. Times are looked at below */
static fw_status tell_otherwise(fw_arena *arena, const fw_recipe_asrun *run,
                                const fw_recipe_asrun_entry *e, bool planned, fw_diags *diags) {
    fw_text text = fw_text_new(arena);
    if (e->ncoupon == 0 || !e->step) return FW_OK;
    put_how(&text, e, "");
    for (int i = 0; planned && i < run->nentry; i++) {
        const fw_recipe_asrun_entry *o = &run->entry[i];
        if (!fw_recipe_asrun_is_behind(run, o, e)) continue;
        const char *of = fw_arena_printf(arena, "%s (line %d): ", o->step->id, o->line);
        FW_NEED(of);
        put_how(&text, o, of);
    }
    if (text.length == 0) return FW_OK;
    FW_TRY(fw_text_end(&text));
    fw_diag_warning(diags, 652, (fw_place){0},
                    "what was read of step %s (line %d of the log) is of a run that went otherwise "
                    "than planned%s; it counts like any other: leave it out where what it tells "
                    "depends on that",
                    e->step->id, e->line, text.data);
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- readings of runs that were not as planned ----
   What says under what it was read (at=: a time, a depth, a charge) goes with that, however long it took. A line or a space
   is taken to be of a wafer that went through its steps as planned: by a wet etch of twice the time it would tell of that
   run alone, and of no next wafer. Of its own wafer it tells where the edge is, and slots and the ladder begin at that edge. */

/* the run of the reading's wafer, up to a step, that was out of its window in the end, and what it is made of; NULL: none is known
   to be. A log of before its lines had their times tells nothing */
static const fw_recipe_asrun_entry *out_of_window(const fw_recipe_asrun *run,
                                                  const fw_recipe_asrun_entry *of,
                                                  const fw_process_step *last) {
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++) {
        if (!e->step || e->step > last || fw_process_step_is_of_lot(e->step) ||
            e->start_s > of->start_s || e->step->nchange == 0 ||
            !fw_process_step_adds_up(e->step) || !of_wafer(e, of) ||
            !fw_recipe_asrun_is_last(run, e) || fw_recipe_asrun_overtaken(run, e, of->wafer))
            continue;
        const char *judged = fw_recipe_asrun_in_time(run, e);
        if (strcmp(judged, "short") == 0 || strcmp(judged, "long") == 0) return e;
    }
    return NULL;
}

/* the run by which the layer that the wet etch takes is not as planned; NULL: none is known */
static const fw_recipe_asrun_entry *layer_not_accepted(const fw_recipe_asrun *run,
                                                       const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++)
        if (fw_recipe_asrun_is_behind(run, o, e) &&
            fw_process_step_makes_edges(run->flow, o->step) && fw_recipe_asrun_not_accepted(o))
            return o;
    return NULL;
}

/* by which run the edge that slots and the ladder of e begin at is not as planned: "S14 (line 3, 2026-11-03T10:00) was long" */
static fw_status edge_off(fw_arena *arena, const fw_recipe_asrun *run,
                          const fw_recipe_asrun_entry *e, const char **off) {
    const fw_process_step *edge = fw_process_flow_edge_step(run->flow);
    const fw_recipe_asrun_entry *of = edge ? out_of_window(run, e, edge) : NULL;
    if (!of) return FW_OK;
    *off = fw_arena_printf(arena, "%s (line %d, %s) was %s", of->step->id, of->line, of->start,
                           fw_recipe_asrun_in_time(run, of));
    return *off ? FW_OK : FW_NOMEM;
}

/* FW-D693, of n readings of e */
static void tell_left_out(const fw_recipe_asrun_entry *e, const fw_recipe_coupon *first, int n,
                          bool all_runs, const char *why, fw_diags *diags) {
    fw_diag_warning(diags, 693, first->row.place, "%d reading%s of %s at step %s%s%s %s: %s%s", n,
                    n > 1 ? "s" : "", first->row.coupon, e->step->id, e->wafer ? " of wafer " : "",
                    e->wafer ? e->wafer : "",
                    all_runs ? (n > 1 ? "count" : "counts")
                             : (n > 1 ? "do not count" : "does not count"),
                    why, all_runs ? ", and --all-runs asks for all" : "; --all-runs counts all");
}

/* of readings that say nothing of what they were read under: OF_WAFER tell how their own wafer is, and of no next one, IS_PAST how it was
   before a step was run again */
typedef enum standing { COUNTS, OF_WAFER, IS_PAST } standing;

/* once for the entry; row: those of its readings */
static standing is_of_bad_run(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                              const fw_process_measurement *row, const bool *there,
                              const fw_recipe_counted *counted, fw_diags *diags) {
    const fw_recipe_asrun_entry *by = e->step ? fw_recipe_asrun_overtaken(run, e, e->wafer) : NULL,
                                *bad = by || !e->step ? NULL : out_of_window(run, e, e->step);
    const fw_recipe_coupon *first = NULL;
    bool edge = false;
    int n = 0;
    for (int i = 0; i < e->ncoupon; i++) {
        fw_recipe_read_again again;
        if (!isnan(e->coupon[i].row.at) || !there[i] ||
            read_again(run, (int)(e - run->entry), i, &again))
            continue;
        if (n++ == 0) first = &e->coupon[i];
        edge = edge || fw_process_coupon_tells_edge(run->flow, &row[i]);
    }
    if (n == 0 || (!by && !bad)) return COUNTS;
    const fw_recipe_asrun_entry *of = by ? by : bad;
    const char *why = fw_arena_printf(
        diags->arena, "%s%s (line %d, %s)%s%s%s", of->step->id,
        !by                                              ? ""
        : fw_recipe_asrun_is_again(run, by, e, e->wafer) ? ", run again after it"
                                                         : ", run after it",
        of->line, of->start, by ? "" : " was ", by ? "" : fw_recipe_asrun_in_time(run, of),
        !by && edge && !counted->all_runs ? "; what is read of slots and the ladder of this wafer "
                                            "begins at the edge that they tell"
                                          : "");
    if (!why) return COUNTS;
    tell_left_out(e, first, n, counted->all_runs, why, diags);
    return counted->all_runs ? COUNTS : by ? IS_PAST : OF_WAFER;
}

/* FW-D735, FW-D693; true: its readings that follow the plan do not count */
static fw_status is_otherwise(fw_arena *arena, const fw_recipe_asrun *run,
                              const fw_recipe_asrun_entry *e, const bool *follows,
                              const fw_recipe_counted *counted, bool *otherwise, fw_diags *diags) {
    const fw_recipe_coupon *first = NULL;
    int n = 0;
    *otherwise = false;
    for (int k = 0; k < e->ncoupon; k++) {
        fw_recipe_read_again again;
        if (follows[k] && !read_again(run, (int)(e - run->entry), k, &again) && n++ == 0)
            first = &e->coupon[k];
    }
    if (n == 0) return FW_OK;
    FW_TRY(fw_recipe_asrun_ask_plan(arena, run, e, n, first, otherwise, diags));
    const fw_recipe_asrun_entry *o = layer_not_accepted(run, e);
    if (*otherwise || !o) return FW_OK;
    *otherwise = !counted->all_runs;
    const fw_recipe_measured *m = fw_recipe_asrun_not_accepted(o);
    const char *why = fw_arena_printf(arena, "%s of step %s (line %d) was not accepted, %s",
                                      m->measure, o->step->id, o->line, m->value);
    FW_NEED(why);
    tell_left_out(e, first, n, counted->all_runs, why, diags);
    return diags->failed ? FW_NOMEM : FW_OK;
}

static bool is_among(const char *list, const char *wafer) {
    fw_word word;
    while (list && wafer && fw_word_next(&list, ", ", &word))
        if (fw_word_is(word, wafer)) return true;
    return false;
}

static fw_status check_without(const fw_recipe_asrun *run, const fw_recipe_counted *counted,
                               fw_diags *diags) {
    const char *list = counted->without;
    fw_word word;
    while (list && fw_word_next(&list, ", ", &word)) {
        bool known = false;
        for (int i = 0; i < run->nwafer; i++)
            known = known || fw_word_is(word, run->wafer[i]);
        if (!known)
            return fw_diag_error(diags, 282, (fw_place){0},
                                 "--without %s: the log has no wafer '%.*s'", counted->without,
                                 (int)word.length, word.at);
    }
    return FW_OK;
}

fw_status fw_recipe_asrun_readings(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_counted *counted, fw_diags *diags,
                                   fw_process_readings *readings) {
    int most = 0;
    for (int i = 0; i < run->nentry; i++)
        most += run->entry[i].ncoupon;
    *readings = (fw_process_readings){.lot = run->lot};
    FW_TRY(check_without(run, counted, diags));
    FW_NEED(readings->item = fw_arena_array(arena, fw_process_reading, (size_t)most + 1));
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (is_among(counted->without, e->wafer) || fw_recipe_asrun_taken_back(run, e)) continue;
        fw_process_measurement *row =
            fw_arena_array(arena, fw_process_measurement, (size_t)e->ncoupon + 1);
        bool *there = fw_arena_array(arena, bool, (size_t)e->ncoupon + 1),
             *follows = fw_arena_array(arena, bool, (size_t)e->ncoupon + 1), any = false, otherwise;
        FW_NEED(row && there ? follows : NULL);
        for (int k = 0; k < e->ncoupon; k++)
            FW_TRY(fw_recipe_asrun_stage(arena, run, e, &e->coupon[k], &row[k], &there[k], diags));
        const standing bad = is_of_bad_run(run, e, row, there, counted, diags);
        for (int k = 0; k < e->ncoupon; k++) {
            if (bad != COUNTS && isnan(row[k].at)) {
                row[k].of_wafer =
                    there[k] && bad == OF_WAFER && fw_process_coupon_tells_edge(run->flow, &row[k]);
                there[k] = row[k].of_wafer;
            }
            follows[k] = there[k] && !row[k].of_wafer && fw_process_coupon_follows_plan(&row[k]);
            any = any || follows[k];
        }
        FW_TRY(is_otherwise(arena, run, e, follows, counted, &otherwise, diags));
        FW_TRY(tell_otherwise(arena, run, e, any && !otherwise, diags));
        for (int k = 0; k < e->ncoupon; k++) {
            const fw_recipe_coupon *c = &e->coupon[k];
            fw_recipe_read_again again;
            if (is_out(run, e, c, diags)) continue;
            if (read_again(run, i, k, &again)) {
                warn_again(&again, diags);
                continue;
            }
            if (!there[k] || (otherwise && (follows[k] || row[k].of_wafer))) continue;
            fw_process_reading *r = &readings->item[readings->n++];
            *r = (fw_process_reading){.row = row[k],
                                      .wafer = e->wafer ? e->wafer : "",
                                      .step = e->step->id,
                                      .nsite = c->nsite};
            if (!counted->all_runs && fw_process_coupon_begins_at_edge(&r->row))
                FW_TRY(edge_off(arena, run, e, &r->edge_off));
            fw_recipe_asrun_etched_at(run, e, &r->row);
            FW_NEED(r->date = fw_arena_strndup(arena, e->end, 10));
            for (int s = 0; s < FW_RECIPE_SITES; s++) {
                double off = c->site[s] - c->row.value;
                if (!isnan(c->site[s])) r->squares += off * off;
            }
            fw_process_readings_ask_apart(readings, diags);
        }
    }
    fw_process_readings_of_edges(run->flow, readings, diags);
    readings->left_out = most - readings->n;
    return diags->failed ? FW_NOMEM : FW_OK;
}
