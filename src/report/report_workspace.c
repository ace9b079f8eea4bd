/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/constants.h"
#include "report/report_page.h"
#include "report/report.h"
#include <math.h>

/* Slices of the workspace at constant rotation. Pictures are drawn from sampled poses; the figures
   beside them are certified. */

enum { GRID = 72, PANEL = 300, COLUMNS = 3, HEAD = 54, PLOT = 232, MARGIN = 46 };
enum { EDGES = 2 * (GRID + 1) * (GRID + 1) };

/* Okabe-Ito; the names stand beside the lines, so that hinges are told apart without colour */
static const char *const ink[FW_SIX] = {"#0072B2", "#D55E00", "#009E73",
                                        "#CC79A7", "#E69F00", "#56B4E9"};

typedef struct slice {
    const fw_report_workspace_flow *flow;
    double phi_rad;
    double low[2], high[2];          /* m, of the picture */
    double used[GRID + 1][GRID + 1]; /* utilisation at the poses of the grid */
    unsigned char governs[GRID + 1][GRID + 1];
    int next[EDGES]; /* following point of the boundary; -1: none */
    unsigned char visited[EDGES];
    double plot_wide, plot_high; /* pixels */
    double x0, y0;               /* upper left corner of the plot, pixels */
    fw_text *out;
} slice;

static double place(const slice *s, int axis, double i) {
    return s->low[axis] + (s->high[axis] - s->low[axis]) * i / GRID;
}

static void sample(slice *s) {
    for (int i = 0; i <= GRID; i++)
        for (int j = 0; j <= GRID; j++) {
            const double pose[3] = {place(s, 0, i), place(s, 1, j), s->phi_rad};
            int who = fw_workspace_governs(s->flow->map, s->flow->mechanism, pose, &s->used[i][j]);
            s->governs[i][j] = (unsigned char)(who == FW_NONE ? FW_SIX : who);
            /* nothing is inside on the frame, so that every boundary closes */
            if (i == 0 || j == 0 || i == GRID || j == GRID)
                s->used[i][j] = fmax(s->used[i][j], 1.0 + 1e-9);
        }
}

/* the edge from grid point (i, j) to the right (up = 0) or upward (up = 1) */
static int edge(int i, int j, int up) {
    return 2 * (i * (GRID + 1) + j) + up;
}

static void ends_of(const slice *s, int e, int at[2], int to[2], double *share) {
    at[0] = e / 2 / (GRID + 1), at[1] = e / 2 % (GRID + 1);
    to[0] = at[0] + (e % 2 == 0), to[1] = at[1] + (e % 2 == 1);
    double a = s->used[at[0]][at[1]] - 1.0, b = s->used[to[0]][to[1]] - 1.0;
    *share = a / (a - b);
}

static void point(const slice *s, int e, double *x, double *y) {
    int at[2], to[2];
    double t;
    ends_of(s, e, at, to, &t);
    *x = s->x0 + s->plot_wide * (at[0] + t * (to[0] - at[0])) / GRID;
    *y = s->y0 + s->plot_high * (1.0 - (at[1] + t * (to[1] - at[1])) / GRID);
}

/* the hinge at its limit where the boundary crosses an edge: that of the end outside */
static int owner(const slice *s, int e) {
    int at[2], to[2];
    double t;
    ends_of(s, e, at, to, &t);
    bool first = s->used[at[0]][at[1]] > 1.0;
    double pose[3] = {place(s, 0, at[0] + t * (to[0] - at[0])),
                      place(s, 1, at[1] + t * (to[1] - at[1])), s->phi_rad},
           unused;
    int who = fw_workspace_governs(s->flow->map, s->flow->mechanism, pose, &unused);
    if (who != FW_NONE) return who;
    return first ? s->governs[at[0]][at[1]] : s->governs[to[0]][to[1]];
}

/* marching squares: in every cell the boundary goes with the inside to its left */
static void march(slice *s) {
    for (int e = 0; e < EDGES; e++)
        s->next[e] = -1;
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++) {
            const int side[4] = {edge(i, j, 0), edge(i + 1, j, 1), edge(i, j + 1, 0),
                                 edge(i, j, 1)};
            const bool in[4] = {s->used[i][j] < 1.0, s->used[i + 1][j] < 1.0,
                                s->used[i + 1][j + 1] < 1.0, s->used[i][j + 1] < 1.0};
            /* corners counter-clockwise; side k lies between corners k and k + 1. Leaving the
               inside along the sides, the boundary enters the cell; the next change is where it
               leaves. */
            for (int k = 0; k < 4; k++) {
                if (!(in[k] && !in[(k + 1) % 4])) continue; /* the boundary comes in here */
                for (int n = 1; n < 4; n++) {
                    int other = (k + 4 - n) % 4;
                    if (in[other] == in[(other + 1) % 4]) continue;
                    s->next[side[k]] = side[other];
                    break;
                }
            }
        }
}

static void fill(slice *s) {
    for (int e = 0; e < EDGES; e++)
        s->visited[e] = 0;
    fw_svg_path(s->out, "fill='#eaeef2' fill-rule='evenodd'");
    for (int e = 0; e < EDGES; e++) {
        if (s->next[e] < 0 || s->visited[e]) continue;
        const char *how = "M";
        for (int at = e; at >= 0 && !s->visited[at]; at = s->next[at]) {
            double x, y;
            s->visited[at] = 1;
            point(s, at, &x, &y);
            fw_markup(s->out, "{r}{c} {c}", how, x, y);
            how = "L";
        }
        fw_text_add(s->out, "Z");
    }
    fw_svg_path_end(s->out);
}

/* the hinge's name outside of the middle of its part of the boundary, which has the inside to
   its left */
static void name_it(const slice *s, int who, int e) {
    double x, y, u, v;
    point(s, e, &x, &y);
    point(s, s->next[e], &u, &v);
    double d = fmax(hypot(u - x, v - y), 1e-9);
    fw_svg_put(s->out,
               "text x='{c}' y='{c}' font-size='11' font-weight='600' text-anchor='middle' "
               "fill='{r}'>{s}\n",
               x - 11.0 * (v - y) / d, y + 11.0 * (u - x) / d + 4.0, ink[who],
               s->flow->mechanism->pin[who].id);
}

static void outline(slice *s) {
    for (int who = 0; who < FW_SIX; who++) {
        int count = 0, middle = -1;
        for (int e = 0; e < EDGES; e++) {
            if (s->next[e] < 0 || owner(s, e) != who) continue;
            double x, y, u, v;
            if (count++ == 0)
                fw_svg_path(s->out,
                            "fill='none' stroke='{r}' stroke-width='3' stroke-linecap='round'",
                            ink[who]);
            point(s, e, &x, &y);
            point(s, s->next[e], &u, &v);
            fw_markup(s->out, "M{c} {c}L{c} {c}", x, y, u, v);
        }
        if (count == 0) continue;
        fw_svg_finish(s->out, ">");
        fw_svg_put(s->out, "title>{s}", s->flow->mechanism->pin[who].id);
        fw_svg_close(s->out, "path\n");
        for (int e = 0, k = 0; e < EDGES && middle < 0; e++)
            if (s->next[e] >= 0 && owner(s, e) == who && k++ == count / 2) middle = e;
        name_it(s, who, middle);
    }
}

/* the required boxes that hold at this rotation, dashed */
static void required(const slice *s) {
    const fw_device *d = s->flow->mechanism->device;
    for (int k = 0; k < d->nworkspace; k++) {
        const fw_device_workspace_box *b = &d->workspace[k];
        if (!fw_device_in_flow(b->flow, s->flow->flow) || s->phi_rad < b->phi_min_rad ||
            s->phi_rad > b->phi_max_rad)
            continue;
        double fx = s->plot_wide / (s->high[0] - s->low[0]);
        double left = fmin(fmax((b->x_min_m - s->low[0]) * fx, 0.0), s->plot_wide);
        double right = fmin(fmax((b->x_max_m - s->low[0]) * fx, 0.0), s->plot_wide);
        double bottom = fmin(fmax((s->high[1] - b->y_min_m) * fx, 0.0), s->plot_high);
        double top = fmin(fmax((s->high[1] - b->y_max_m) * fx, 0.0), s->plot_high);
        fw_svg_open(s->out,
                    "rect x='{c}' y='{c}' width='{c}' height='{c}' fill='none' stroke='#1f2328' "
                    "stroke-width='1.2' stroke-dasharray='4 3'",
                    s->x0 + left, s->y0 + top, right - left, bottom - top);
        fw_svg_put(s->out, "title>required");
        fw_svg_close(s->out, "rect\n");
    }
}

static void number(fw_text *out, double value, int digits) {
    if (value < 0.0) fw_text_add(out, "\u2212");
    fw_markup_number(out, fabs(value), digits);
}

static void frame(const slice *s) {
    double wide = s->high[0] - s->low[0], high = s->high[1] - s->low[1];
    double step[2] = {fw_svg_nice(wide / 4.0), fw_svg_nice(high / 4.0)};
    fw_svg_open(s->out, "g font-size='10' fill='#57606a'\n");
    for (int axis = 0; axis < 2; axis++)
        for (double k = ceil(s->low[axis] / step[axis]); k * step[axis] <= s->high[axis];
             k += 1.0) {
            double t = (k * step[axis] - s->low[axis]) / (s->high[axis] - s->low[axis]);
            const char *grey = fabs(k) < 0.5 ? "#8c959f" : "#eaeef2";
            double x = s->x0 + s->plot_wide * t, y = s->y0 + s->plot_high * (1.0 - t);
            if (axis == 0) {
                fw_svg_put(s->out, "path d='M{c} {c}v{c}' stroke='{r}'", x, s->y0, s->plot_high,
                           grey);
                fw_svg_open(s->out, "text x='{c}' y='{c}' text-anchor='middle'", x,
                            s->y0 + s->plot_high + 13.0);
            } else {
                fw_svg_put(s->out, "path d='M{c} {c}h{c}' stroke='{r}'", s->x0, y, s->plot_wide,
                           grey);
                fw_svg_open(s->out, "text x='{c}' y='{c}' text-anchor='end'", s->x0 - 4.0, y + 3.5);
            }
            number(s->out, k * step[axis] * 1e6, 4);
            fw_svg_close(s->out, "text");
        }
    fw_svg_close(s->out, "g\n");
}

static void caption(const slice *s, const fw_workspace_slice *at) {
    fw_svg_open(s->out, "text x='{c}' y='{c}' font-size='12' font-weight='600' fill='#1f2328'",
                s->x0, s->y0 - 20.0);
    fw_text_add(s->out, "rotation ");
    number(s->out, fabs(at->phi_rad) < 1e-12 ? 0.0 : at->phi_rad * FW_DEG_PER_RAD, 3);
    fw_text_add(s->out, "\u00b0");
    fw_svg_close(s->out, "text");
    fw_svg_open(s->out, "text x='{c}' y='{c}' font-size='11' fill='#57606a'", s->x0, s->y0 - 6.0);
    fw_text_add(s->out, "area ");
    fw_text_number(s->out, at->area.value.lo * 1e12, 6);
    fw_text_add(s->out, " to ");
    fw_text_number(s->out, at->area.value.hi * 1e12, 6);
    fw_text_add(s->out, " \u00b5m\u00b2");
    fw_svg_close(s->out, "text\n");
}

/* whose limit bounds the set, as bars */
static void shares(const slice *s) {
    const fw_workspace_survey *survey = &s->flow->map->survey;
    double most = 0.0;
    for (int i = 0; i < FW_SIX; i++)
        most = fmax(most, survey->share[i]);
    fw_svg_put(
        s->out,
        "text x='{c}' y='{c}' font-size='12' font-weight='600' fill='#1f2328'>boundary by hinge",
        s->x0, s->y0 - 20.0);
    fw_svg_put(
        s->out,
        "text x='{c}' y='{c}' font-size='11' fill='#57606a'>share of the growth with its limit\n",
        s->x0, s->y0 - 6.0);
    for (int i = 0; i < FW_SIX; i++) {
        double y = s->y0 + 10.0 + 30.0 * i;
        fw_svg_put(s->out, "text x='{c}' y='{c}' font-size='12' fill='#1f2328'>{s}", s->x0,
                   y + 12.0, s->flow->mechanism->pin[i].id);
        fw_svg_put(s->out, "rect x='{c}' y='{c}' width='{c}' height='16' fill='{r}'", s->x0 + 34.0,
                   y, fmax(130.0 * survey->share[i] / most, 1.0), ink[i]);
        fw_svg_put(s->out, "text x='{c}' y='{c}' font-size='11' fill='#57606a'>{p}\n",
                   s->x0 + 40.0 + 130.0 * survey->share[i] / most, y + 12.0, survey->share[i]);
    }
}

static fw_status slices(fw_arena *arena, const fw_report_workspace_flow *flow, double top,
                        double *height, fw_text *out) {
    const fw_workspace_map *map = flow->map;
    *height = 0.0;
    if (map->none || !(map->volume.value.lo > 0.0)) return FW_OK;
    slice *s = fw_arena_one(arena, slice);
    FW_NEED(s);
    s->flow = flow, s->out = out;
    double middle[2], half[2];
    for (int c = 0; c < 2; c++) {
        double low = map->survey.least[c].lo, high = map->survey.most[c].hi;
        middle[c] = 0.5 * (low + high);
        half[c] = 0.56 * (high - low);
    }
    /* the same scale along both axes; a flat or narrow set leaves room for the bars */
    half[1] = fmax(half[1], 0.8 * half[0]);
    half[0] = fmax(half[0], 0.6 * half[1]);
    double scale = PLOT / (2.0 * fmax(half[0], half[1]));
    s->plot_wide = 2.0 * half[0] * scale, s->plot_high = 2.0 * half[1] * scale;
    const double row = s->plot_high + HEAD + 28.0;
    for (int i = 0; i <= FW_SLICES; i++) {
        s->x0 = MARGIN + PANEL * (i % COLUMNS);
        s->y0 = top + HEAD + row * (i / COLUMNS);
        if (i == FW_SLICES) {
            shares(s);
            break;
        }
        s->phi_rad = map->slice[i].phi_rad;
        for (int c = 0; c < 2; c++)
            s->low[c] = middle[c] - half[c], s->high[c] = middle[c] + half[c];
        sample(s);
        march(s);
        fill(s);
        frame(s);
        outline(s);
        required(s);
        caption(s, &map->slice[i]);
    }
    *height = 2.0 * row;
    return FW_OK;
}

fw_status fw_report_workspace_svg(fw_arena *arena, const fw_report_workspace *in, fw_text *out) {
    fw_text body = fw_text_new(arena);
    double top = 44.0;
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        double height;
        fw_svg_open(&body, "text x='14' y='{c}' font-size='13' fill='#1f2328'", top + 14.0);
        fw_markup(&body, "{s}: ", f->flow ? f->flow : f->mechanism->variant->material.id);
        if (f->map->none)
            fw_markup(&body, "no reachable set, {s}", f->map->none);
        else {
            fw_text_add(&body, "volume ");
            fw_markup_number(&body, f->map->volume.value.lo * 1e12, 6);
            fw_text_add(&body, " to ");
            fw_markup_number(&body, f->map->volume.value.hi * 1e12, 6);
            fw_text_add(&body, " \u00b5m\u00b2 rad, certified");
        }
        fw_svg_close(&body, "text\n");
        FW_TRY(slices(arena, f, top + 20.0, &height, &body));
        top += 34.0 + height;
    }
    FW_TRY(fw_text_end(&body));
    fw_svg_begin_picture(out, FW_SLICES_WIDTH, top, true);
    fw_svg_title(out, "{s}: workspace", in->device->name);
    fw_svg_paper(out, "#fff");
    fw_svg_put(out,
               "text x='14' y='26' font-size='15' font-weight='600' fill='#1f2328'>{s}: workspace "
               "at constant rotation, x and y in \u00b5m\n",
               in->device->name);
    fw_text_bytes(out, body.data, body.length);
    fw_svg_end(out);
    return fw_text_end(out);
}

static void span(fw_text *out, double low, double high, bool angle) {
    if (angle)
        fw_markup(out, "{d} to {d}", low, high);
    else
        fw_markup(out, "{u} to {u}", low, "m", high, "m");
}

static void boxes(fw_report_page *page, const char *flow) {
    const fw_device *d = page->in->device;
    for (int i = 0; i < d->nworkspace; i++) {
        const fw_device_workspace_box *b = &d->workspace[i];
        if (!fw_device_in_flow(b->flow, flow)) continue;
        fw_text_add(page->out, "<p>Required box, from the drawn pose: x ");
        span(page->out, b->x_min_m, b->x_max_m, false);
        fw_text_add(page->out, ", y ");
        span(page->out, b->y_min_m, b->y_max_m, false);
        fw_text_add(page->out, ", rotation ");
        span(page->out, b->phi_min_rad, b->phi_max_rad, true);
        fw_text_add(page->out, ".</p>\n");
    }
}

static void judgement(fw_text *out, const fw_workspace_result *w) {
    const fw_workspace_beyond *b = &w->beyond;
    if (!w->reachable)
        fw_markup(out, "<p><strong class=\"no\">{s}</strong> at ({u}, {u}, {d}).</p>\n",
                  b->certain ? "Not reachable: neither the legs nor what their flexures give goes"
                             : "Not reached by pins, and perhaps by flexures that give:",
                  b->pose[0], "m", b->pose[1], "m", b->pose[2]);
    else
        fw_markup(out, "<p>All of it can be reached{r}. Volume {n} mm\u00b2\u00b7\u00b0.</p>\n",
                  w->certified ? ", <strong>certified</strong> by interval arithmetic: the "
                                 "peaks below enclose every pose of the box"
                               : "; peaks from samples, <strong>not certified</strong>",
                  w->volume_m2_rad * 1e6 * FW_DEG_PER_RAD);
}

static double strain_limit(const fw_verdict_variant_verdict *v, int pin) {
    for (int i = 0; i < v->nhinge; i++)
        if (v->hinge[i].joint == pin) return v->hinge[i].strain_limit;
    return (double)NAN;
}

/* one hinge: farthest rotation, and the pose that strains it most; without forces that rotation's */
static void peak(fw_text *out, const fw_verdict_variant_verdict *v, int k) {
    const fw_workspace_peak *p = &v->workspace.peak[k];
    const fw_workspace_load *l = &v->workspace.load[k];
    double limit = fw_report_pin_limit(v->mechanism, k), by_angle = fabs(p->angle_rad) / limit;
    double allowed = strain_limit(v, k), u = l->known ? l->strain / allowed : by_angle;
    fw_markup(out, "<tr{r}><th scope=\"row\">{s}</th><td class=\"n\">{D} \u00b1 ",
              u > 1.0 ? " class=\"bad\"" : "", v->mechanism->pin[k].id, p->angle_rad);
    fw_markup_number(out, p->error_rad * FW_DEG_PER_RAD, 2);
    fw_markup(out,
              "</td><td class=\"n\">{D}</td><td class=\"n\">{p}</td><td class=\"n\">{p}</td><td "
              "class=\"n\">{u}</td><td class=\"n\">{u}</td><td class=\"n\">{u}</td><td "
              "class=\"n\">{d}</td><td>{s}</td></tr>\n",
              limit, u, by_angle, l->known ? l->force_N : (double)NAN, "N",
              l->known ? l->x_m : p->x_m, "m", l->known ? l->y_m : p->y_m, "m",
              l->known ? l->phi_rad : p->phi_rad, l->actuation ? l->actuation : "not known");
}

static void peaks(fw_report_page *page, const fw_verdict_variant_verdict *v) {
    fw_text *out = page->out;
    fw_text_add(
        out,
        "<div class=\"wide\"><table><caption>Worst pose of every hinge</caption><thead>"
        "<tr><th scope=\"col\">Hinge</th><th scope=\"col\" class=\"n\">Angle (\u00b0)</th><th "
        "scope=\"col\" class=\"n\">Limit (\u00b0)</th><th scope=\"col\" class=\"n\">Utilisation"
        "</th><th scope=\"col\" class=\"n\">of it by rotation</th><th scope=\"col\" "
        "class=\"n\">Joint force</th><th scope=\"col\" class=\"n\">Platform x</th><th "
        "scope=\"col\" class=\"n\">y</th><th scope=\"col\" class=\"n\">rotation</th><th "
        "scope=\"col\">Held by</th></tr></thead>"
        "<tbody>\n");
    for (int k = 0; k < FW_SIX && k < v->mechanism->npin; k++)
        peak(out, v, k);
    fw_text_add(out, "</tbody></table></div>\n");
}

/* the reachable set of the flow; what is not a six-bar with flexures has none */
static fw_status reachable(fw_report_page *page, const fw_verdict_variant_verdict *v) {
    fw_workspace_map *map = fw_arena_one(page->arena, fw_workspace_map);
    FW_NEED(map);
    FW_TRY(fw_workspace_map_make(page->arena, v->mechanism, fw_workspace_quick, map));
    if (map->none || !(map->volume.value.lo > 0.0)) return FW_OK;
    const fw_report_workspace_flow flow = {v->variant ? v->variant->flow : NULL, v->mechanism, map,
                                           &v->workspace, NULL};
    fw_text picture = fw_text_new(page->arena);
    double height;
    FW_TRY(slices(page->arena, &flow, 0.0, &height, &picture));
    FW_TRY(fw_text_end(&picture));
    fw_markup(page->out,
              "<p>Reachable with every hinge inside its elastic limit: {n} to {n} "
              "mm\u00b2\u00b7\u00b0, <strong>certified</strong>; x from {u} to {u}, y from {u} "
              "to {u}, rotation {d} to {d}. It grows with all limits to the power ",
              map->volume.value.lo * 1e6 * FW_DEG_PER_RAD,
              map->volume.value.hi * 1e6 * FW_DEG_PER_RAD, map->survey.least[0].hi, "m",
              map->survey.most[0].lo, "m", map->survey.least[1].hi, "m", map->survey.most[1].lo,
              "m", map->survey.least[2].hi, map->survey.most[2].lo);
    fw_markup_number(page->out, map->survey.exponent, 3);
    fw_text_add(page->out, ".</p>\n<figure class=\"wide\">");
    fw_svg_begin_picture(page->out, FW_SLICES_WIDTH, height, false);
    fw_svg_title(page->out, "Workspace at constant rotation, x and y in \u00b5m");
    fw_svg_paper(page->out, "#fff");
    fw_text_bytes(page->out, picture.data, picture.length);
    fw_svg_close(page->out, "svg");
    fw_text_add(page->out,
                "<figcaption>Workspace at constant rotation, x and y of the "
                "platform in \u00b5m from the drawn pose. The boundary has the colour of "
                "the hinge that is at its limit; dashed: the required box. The line is "
                "drawn from samples, areas and volume are proved.</figcaption></figure>\n");
    return FW_OK;
}

fw_status fw_report_section_workspace(fw_report_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (!v->workspace.required) continue;
        any = true;
        const char *flow = v->variant ? v->variant->flow : NULL;
        fw_markup(page->out, "<h3>{s}</h3>\n", flow ? flow : "all flows");
        boxes(page, flow);
        judgement(page->out, &v->workspace);
        if (v->workspace.reachable) peaks(page, v);
        FW_TRY(reachable(page, v));
    }
    if (!any) fw_text_add(page->out, "<p>The description states no required workspace.</p>\n");
    return fw_text_end(page->out);
}
