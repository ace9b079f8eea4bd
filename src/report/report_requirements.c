/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of the device beside its hinges, on the page: probes against time with the bounds of what is
   required of them, all requirements, and how near what moves comes to what it may meet. */
#include "base/constants.h"
#include "report/report.h"
#include "report/report_page.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- curves of probes ---- */

typedef struct curve {
    const fw_verdict_variant_verdict *v;
    int scene, probe, points;
    const fw_probe_result *result;
    const double *t_s, *value; /* (count) in the unit shown */
    int count;
    double per_si;
    char unit[16]; /* "uN" */
    fw_report_axes axes;
} curve;

/* the prefix in which the largest value reads best */
static void choose_unit(curve *c, double largest, const char *unit) {
    char text[FW_PROBE_TEXT];
    double size = fabs(largest);
    c->per_si = 1;
    fw_probe_text(text, size, unit);
    const char *blank = strchr(text, ' ');
    snprintf(c->unit, sizeof c->unit, "%s", blank ? blank + 1 : unit);
    static const struct {
        char prefix;
        double by;
    } table[] = {{'n', 1e9}, {'u', 1e6}, {'m', 1e3}, {'k', 1e-3}, {'M', 1e-6}, {'G', 1e-9}};
    if (strcmp(c->unit, unit) == 0) return;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (c->unit[0] == table[i].prefix) c->per_si = table[i].by;
}

/* a bound that is a value of the course: peaks, extremes and the end */
static bool is_level(const fw_device_requirement *q) {
    switch (q->measure) {
    case FW_MEASURE_PEAK:
    case FW_MEASURE_MAXIMUM:
    case FW_MEASURE_MINIMUM:
    case FW_MEASURE_FINAL:
        return true;
    case FW_MEASURE_PEAK_TO_PEAK:
    case FW_MEASURE_SETTLING:
    case FW_MEASURE_PARASITIC:
        break;
    }
    return false;
}

static const fw_verdict_requirement *next_of(const curve *c, int *k) {
    const fw_device *d = c->v->mechanism->device;
    for (; *k < c->v->nrequirement; (*k)++) {
        const fw_verdict_requirement *r = &c->v->requirement[*k];
        if (r->scene_index == c->scene && r->measure && d->requirement[r->asked].probe == c->probe)
            return &c->v->requirement[(*k)++];
    }
    return NULL;
}

/* a bound far away would flatten the curve: said in words instead */
static bool shown(const curve *c, double bound) {
    double low = c->result->minimum, high = c->result->maximum;
    double size = fmax(high - low, 0.2 * fmax(fabs(low), fabs(high)));
    return isfinite(bound) && bound < high + 1.5 * size && bound > low - 1.5 * size;
}

static void range(curve *c) {
    double low = fmin(0, c->result->minimum), high = fmax(0, c->result->maximum);
    if (c->result->origin != 0) low = c->result->minimum, high = c->result->maximum;
    const fw_verdict_requirement *r;
    for (int k = 0; (r = next_of(c, &k)) != NULL;) {
        if (!is_level(&c->v->mechanism->device->requirement[r->asked])) continue;
        const double bound[2] = {r->min, r->max};
        for (int i = 0; i < 2; i++)
            if (shown(c, bound[i])) low = fmin(low, bound[i]), high = fmax(high, bound[i]);
    }
    double wide = high > low ? high - low : fmax(fabs(high), 1);
    c->axes.low = (low - 0.08 * wide) * c->per_si;
    c->axes.high = (high + 0.12 * wide) * c->per_si;
}

static void bounds(const curve *c, fw_text *out) {
    const fw_verdict_requirement *r;
    for (int k = 0; (r = next_of(c, &k)) != NULL;) {
        if (!is_level(&c->v->mechanism->device->requirement[r->asked])) continue;
        const double bound[2] = {r->min, r->max};
        for (int i = 0; i < 2; i++) {
            if (!shown(c, bound[i])) continue;
            double y = fw_report_axes_y(&c->axes, bound[i] * c->per_si), edge = c->axes.y;
            if (i == 0) edge += c->axes.height;
            fw_svg_put(out, "path d='M{c} {c}h{c}V{c}h-{c}z' fill='#D55E00' fill-opacity='0.08'",
                       c->axes.x, y, c->axes.width, edge, c->axes.width);
            fw_svg_put(out,
                       "path d='M{c} {c}h{c}' stroke='#D55E00' stroke-dasharray='5 3' "
                       "fill='none'\n",
                       c->axes.x, y, c->axes.width);
        }
    }
}

static fw_status line(fw_arena *arena, const curve *c, fw_text *out) {
    int most = c->points < 4 ? 4 : c->points, *index;
    FW_NEED(index = fw_arena_array(arena, int, (size_t)most));
    int n = fw_report_decimate(c->value, 1, c->count, most, index);
    fw_svg_path(out, "fill='none' stroke='#0072B2' stroke-width='1.4' stroke-linejoin='round'");
    for (int i = 0; i < n; i++)
        fw_markup(out, "{r}{c} {c}",
                  i == 0   ? "M"
                  : i == 1 ? "L"
                           : " ",
                  fw_report_axes_x(&c->axes, c->t_s[index[i]]),
                  fw_report_axes_y(&c->axes, c->value[index[i]]));
    fw_svg_path_end(out);
    return FW_OK;
}

/* the measure that is judged, else the peak */
static void heading(const curve *c, fw_text *out) {
    const fw_device_probe *p = &c->v->mechanism->device->probe[c->probe];
    char text[FW_PROBE_TEXT];
    int k = 0;
    const fw_verdict_requirement *r = next_of(c, &k);
    fw_svg_put(out, "text x='{c}' y='{c}' font-size='13' font-weight='600' fill='#1f2328'>{s}",
               c->axes.x, c->axes.y - 9.0, p->id);
    fw_svg_open(out, "text x='{c}' y='{c}' font-size='10.5' text-anchor='end' fill='#57606a'",
                c->axes.x + c->axes.width, c->axes.y - 9.0);
    if (r)
        fw_markup(out, "{s} {s}: {s}", r->measure, fw_probe_text(text, r->value, r->unit),
                  fw_verdict_decision_text(r->decision));
    else
        fw_markup(out, "peak {s}",
                  fw_probe_text(text, c->result->peak, fw_device_probe_kinds[p->row].unit));
    fw_svg_close(out, "text");
    fw_svg_put(out,
               "text x='{c}' y='{c}' font-size='10' fill='#57606a' text-anchor='end' "
               "transform='rotate(-90 {c} {c})'>{s} ({s})\n",
               c->axes.x - 36.0, c->axes.y, c->axes.x - 36.0, c->axes.y,
               fw_device_probe_kinds[p->row].name, c->unit);
}

static fw_status values(fw_arena *arena, const fw_probe *p, curve *c) {
    const fw_dynamics_motion *m = c->v->motion[c->scene];
    double *value;
    FW_NEED(value = fw_arena_array(arena, double, (size_t)m->nsample));
    for (int i = 0; i < m->nsample; i++)
        value[i] = fw_probe_at_row(p, m, i) * c->per_si;
    c->t_s = m->t_s, c->value = value, c->count = m->nsample;
    return FW_OK;
}

static fw_status draw(fw_arena *arena, const fw_probe *p, curve *c, fw_text *out) {
    const double largest = fmax(fabs(c->result->maximum), fabs(c->result->minimum));
    choose_unit(c, largest, p->kind->unit);
    FW_TRY(values(arena, p, c));
    range(c);
    fw_svg_open(out, "g class='probe'\n");
    heading(c, out);
    fw_report_axes_draw(&c->axes, out);
    bounds(c, out);
    FW_TRY(line(arena, c, out));
    fw_svg_close(out, "g\n");
    return FW_OK;
}

fw_status fw_report_probe_panels(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                 const fw_report_figure *figure, fw_text *out) {
    const int n = fw_probe_count(v->mechanism), columns = figure->columns;
    int known = 0, at = 0;
    fw_probe *probe;
    for (int i = 0; v->probed && i < n; i++)
        known += v->probed[scene * n + i].known;
    if (known == 0) return FW_OK;
    const fw_dynamics_motion *motion = v->motion[scene];
    FW_TRY(fw_probe_bind(arena, v->mechanism, &v->mechanism->device->scene[scene], motion->loads,
                         &probe));
    int shown_ = known < FW_REPORT_PANELS ? known : FW_REPORT_PANELS;
    fw_svg_begin(out, &(fw_svg_frame){.width = columns * FW_REPORT_PANEL_WIDTH,
                                      .height = (double)((shown_ + columns - 1) / columns) *
                                                FW_REPORT_PANEL_HEIGHT,
                                      .decimals = 2,
                                      .size = FW_SVG_SIZE_NONE,
                                      .lead = "class='probes' role='img'",
                                      .font = fw_svg_font_page});
    fw_svg_title(out, "Probes of scene {s} and what is required of them", figure->title);
    for (int i = 0; i < n && at < shown_; i++) {
        const fw_probe_result *result = &v->probed[scene * n + i];
        if (!result->known) continue;
        curve c = {.v = v,
                   .scene = scene,
                   .probe = i,
                   .points = figure->curve_points,
                   .result = result,
                   .axes = fw_report_axes_at(motion, at++, columns, 0)};
        FW_TRY(draw(arena, &probe[i], &c, out));
    }
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- the table of requirements ---- */

static void bound_text(fw_text *out, const fw_verdict_requirement *r) {
    char text[FW_PROBE_TEXT];
    if (!isnan(r->min)) fw_markup(out, "\u2265 {s}", fw_probe_text(text, r->min, r->unit));
    if (!isnan(r->min) && !isnan(r->max)) fw_text_add(out, ", ");
    if (!isnan(r->max)) fw_markup(out, "\u2264 {s}", fw_probe_text(text, r->max, r->unit));
}

static void requirement_row(fw_text *out, const fw_verdict_requirement *r, const char *at) {
    double band[2];
    fw_verdict_requirement_band(r, band);
    char value[FW_PROBE_TEXT], low[FW_PROBE_TEXT], high[FW_PROBE_TEXT];
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td>", r->probe,
              r->measure ? r->measure : r->kind);
    if (r->why)
        fw_markup(out, "<td colspan=\"2\">not known: {s}</td>", r->why);
    else
        fw_markup(out, "<td class=\"n\">{s}</td><td class=\"n\">{s} to {s}</td>",
                  fw_probe_text(value, r->value, r->unit), fw_probe_text(low, band[0], r->unit),
                  fw_probe_text(high, band[1], r->unit));
    fw_text_add(out, "<td class=\"n\">");
    bound_text(out, r);
    fw_markup(out, "</td><td class=\"n\">{s}</td><td>{s}</td><td>{s}{s}</td><td>{s}</td></tr>\n",
              r->why ? "" : fw_probe_text(value, r->margin, r->unit),
              fw_verdict_decision_text(r->decision), r->scene ? r->scene : fw_verdict_at_rest,
              fw_probe_when(low, r->measure ? (double)NAN : r->t_s), at ? at : "as drawn");
}

const char *fw_report_without_bodies(fw_arena *arena, const char *rigid) {
    const char *few = fw_text_few(arena, rigid);
    if (!few) return "";
    const char *text = fw_arena_printf(
        arena,
        "the bands are those of rigid bodies: nothing of the device is drawn, so that what its "
        "bodies give themselves (%s) is not known and not in them",
        few);
    return text ? text : "";
}

fw_status fw_report_section_requirements(fw_report_page *page) {
    const fw_verdict *verdict = page->in->verdict;
    const char *rigid = NULL;
    fw_text_add(
        page->out,
        "<div class=\"wide\"><table><caption>What the device is for: each value with its error "
        "band, as drawn and of the worst device that was run as fabricated, there "
        "with the band over all corners of the flow.</caption><thead><tr>"
        "<th scope=\"col\">Probe</th><th scope=\"col\">Measure</th><th scope=\"col\" "
        "class=\"n\">Value</th><th scope=\"col\" class=\"n\">Band</th><th scope=\"col\" "
        "class=\"n\">Required</th><th scope=\"col\" class=\"n\">Margin</th><th scope=\"col\">"
        "Verdict</th><th scope=\"col\">Scene</th><th scope=\"col\">Device</th></tr></thead>"
        "<tbody>\n");
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; k < v->nrequirement; k++) {
            int corner = 0;
            const fw_verdict_requirement *worst = fw_verdict_requirement_made(v, k, &corner);
            if (v->requirement[k].rigid) rigid = v->requirement[k].rigid;
            requirement_row(page->out, &v->requirement[k], NULL);
            if (worst) requirement_row(page->out, worst, v->fabricated->corner[corner].what);
        }
    }
    fw_text_add(page->out, "</tbody></table></div>\n");
    if (rigid)
        fw_markup(page->out, "<p>{s}.</p>\n", fw_report_without_bodies(page->out->arena, rigid));
    return fw_text_end(page->out);
}

bool fw_report_has_requirements(const fw_report_page *page) {
    for (int i = 0; i < page->in->verdict->nvariant; i++)
        if (page->in->verdict->variant[i].nrequirement > 0) return true;
    return false;
}

/* ---- clearances ----
   A table, and a picture of each pair where it is nearest. */

enum { PICTURE = 360, PICTURES = 6 };

/* the smallest window that shows the place: some times the distance, at least 120 um */
static fw_geometry_box window_of(const fw_clearance_least *l) {
    double half = fmax(120e-6, 3 * l->m);
    double x = 0.5 * (l->at.at_a.x + l->at.at_b.x), y = 0.5 * (l->at.at_a.y + l->at.at_b.y);
    return (fw_geometry_box){x - half, y - half, x + half, y + half};
}

/* outlines of one of the two where it is then */
static fw_status solid(fw_report_page *page, const fw_verdict_variant_verdict *v,
                       const fw_clearance_least *l, int which, const fw_report_view *view) {
    const fw_layout *layout = page->in->verdict->layout;
    const int body = which ? l->b : l->a;
    const char *const ink = which ? "#0072B2" : "#D55E00", *const fill =
                                                               which ? "#d6e6f2" : "#f8e0d2";
    fw_geometry_pose move = {0, 0, 0};
    if (body != FW_GROUND) {
        const fw_clearance_solid *s = &v->things->solid[body];
        const fw_clearance_pose p = l->pose[which];
        double turn = p.phi_rad - s->turned_rad, c = cos(turn), n = sin(turn);
        move = (fw_geometry_pose){p.x_m - (c * s->centre.x - n * s->centre.y),
                                  p.y_m - (n * s->centre.x + c * s->centre.y), turn};
    }
    fw_svg_path(page->out, "fill='{r}' stroke='{r}' stroke-width='1.2'", fill, ink);
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        bool fixed = p->body == FW_GROUND || p->body == FW_ISLAND;
        bool wall =
            p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FRAME || p->role == FW_ROLE_TETHER;
        if (!wall || (body == FW_GROUND ? !fixed : p->body != body)) continue;
        fw_geometry_contour moved;
        FW_TRY(fw_geometry_contour_transform(page->arena, &p->contour, move, false, &moved));
        fw_report_path(page->out, view, &moved);
    }
    fw_svg_path_end(page->out);
    return FW_OK;
}

static fw_status clearance_picture(fw_report_page *page, const fw_verdict_variant_verdict *v,
                                   const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    const fw_report_view view = fw_report_view_fit(window_of(l), PICTURE, 0);
    double x0 = fw_report_x(&view, l->at.at_a.x), y0 = fw_report_y(&view, l->at.at_a.y);
    double x1 = fw_report_x(&view, l->at.at_b.x), y1 = fw_report_y(&view, l->at.at_b.y);
    fw_markup(page->out, "<figure class=\"pair\">\n");
    fw_svg_begin_picture(page->out, view.width, view.height, false);
    fw_svg_title(page->out, "{s} and {s} where they are nearest in {s}", l->at.a, l->at.b,
                 c->scene);
    fw_svg_paper(page->out, "#fff");
    for (int which = 0; which < 2; which++)
        FW_TRY(solid(page, v, l, which, &view));
    fw_svg_put(page->out, "path d='M{c} {c}L{c} {c}' stroke='#1f2328' stroke-width='1.5'", x0, y0,
               x1, y1);
    fw_svg_put(page->out,
               "circle cx='{c}' cy='{c}' r='9' fill='none' stroke='#1f2328' stroke-width='1.5'",
               0.5 * (x0 + x1), 0.5 * (y0 + y1));
    fw_report_scale_bar_svg(page->out, &view);
    fw_svg_end(page->out);
    fw_markup(page->out, "<figcaption>{s} (orange) and {s} (blue) in {s}", l->at.a, l->at.b,
              c->scene);
    if (c->box == FW_NONE)
        fw_markup(page->out, " at {h}", l->t_s);
    else
        fw_markup(page->out, ", the platform at ({u}, {u}, {d})", l->platform[0], "m",
                  l->platform[1], "m", l->platform[2]);
    fw_markup(page->out, ": {r}</figcaption></figure>\n",
              l->m <= 0 ? "they meet in the circle" : "the line is their distance as drawn");
    return FW_OK;
}

static void clearance_row(fw_text *out, const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    fw_markup(out, "<tr><th scope=\"row\">{s}</th><td>{s}</td><td>{s}, {s}</td>", c->scene,
              c->flow ? c->flow : "", l->at.a, l->at.b);
    if (l->m <= 0)
        fw_markup(out, "<td>they meet</td><td></td>");
    else if (fw_clearance_has_no_band(l))
        fw_markup(out, "<td>{u}</td><td>not known</td>", c->m, "m");
    else
        fw_markup(out, "<td>{u}</td><td>{u} to {u}</td>", c->m, "m", c->low_m, "m", c->high_m, "m");
    if (c->required_m > 0)
        fw_markup(out, "<td>{u}</td>", c->required_m, "m");
    else
        fw_markup(out, "<td>apart</td>");
    if (c->box == FW_NONE)
        fw_markup(out, "<td>{h}</td>", l->t_s);
    else
        fw_markup(out, "<td></td>");
    fw_markup(out, "<td>({u}, {u})</td><td>{s}</td></tr>\n", l->at.at_a.x, "m", l->at.at_a.y, "m",
              fw_verdict_decision_text(c->decision));
}

fw_status fw_report_section_clearance(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    int n = 0, shown = 0;
    for (int i = 0; i < v->nvariant; i++)
        n += v->variant[i].nclearance;
    if (n == 0) {
        fw_markup(page->out, "<p>Nothing that is drawn moves against anything else.</p>\n");
        return FW_OK;
    }
    fw_markup(page->out,
              "<table><caption>The least distance of everything that moves from what it may meet, "
              "over the whole motion, between its samples too, and over every required pose. "
              "Range: what is proved, less and more what the motion may be off by. Halves of "
              "hinges: <a href=\"#hinges\">hinges</a>.</caption>\n<thead><tr>"
              "<th>Scene</th><th>Flow</th><th>Pair</th><th>Least</th><th>Range</th>"
              "<th>Asked for</th><th>At</th><th>Place</th><th>Verdict</th></tr></thead><tbody>\n");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nclearance; k++)
            clearance_row(page->out, &v->variant[i].clearance[k]);
    fw_markup(page->out, "</tbody></table>\n<div class=\"pairs\">\n");
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; v->layout && k < v->variant[i].nclearance && shown < PICTURES; k++, shown++)
            FW_TRY(clearance_picture(page, &v->variant[i], &v->variant[i].clearance[k]));
    fw_markup(page->out, "</div>\n");
    return FW_OK;
}

/* ---- out of the plane ---- */

bool fw_report_has_out_of_plane(const fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].out_of_plane) return true;
    return false;
}

static void plates_row(fw_text *out, const fw_verdict_variant_verdict *v) {
    enum { FEW = 3 };
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    fw_markup(out, "<tr><td>{s}</td><td>", v->variant->flow ? v->variant->flow : "");
    if (o->why) fw_markup(out, "not known: {s}", o->why);
    for (int k = 0; k < o->nmode && k < FEW; k++)
        fw_markup(out, "{r}{u} ({u} to {u}): {s} {s}", k ? "<br/>" : "", o->mode[k].f_Hz, "Hz",
                  o->mode[k].low_Hz, "Hz", o->mode[k].high_Hz, "Hz", o->mode[k].body,
                  o->mode[k].tilts ? "tilts" : "up and down");
    fw_markup(out, "</td>");
    if (o->why)
        fw_markup(out, "<td></td><td></td><td></td>");
    else
        fw_markup(out, "<td>{u}, {s}</td><td>{n}</td><td>{u}, at most {u}</td>", o->across_N_per_m,
                  "N/m", o->body, o->ratio, o->weight_m, "m", o->weight_most_m, "m");
    fw_markup(out, "<td>{s}</td></tr>\n",
              v->variant->below.known ? v->variant->below.words : "not known");
}

static void across_rows(fw_text *out, const fw_verdict_variant_verdict *v) {
    for (int k = 0; !v->out_of_plane->why && k < v->out_of_plane->nscene; k++) {
        const fw_verdict_across *s = &v->out_of_plane->scene[k];
        fw_markup(out, "<tr><td>{s}</td><td>{s}</td>", s->scene,
                  v->variant->flow ? v->variant->flow : "");
        if (s->asked)
            fw_markup(out, "<td>{u}</td><td>{u}</td><td>{n}</td>", -s->lowest_m, "m", s->highest_m,
                      "m", s->tilt_rad);
        else
            fw_markup(out, "<td>nothing across</td><td></td><td></td>");
        if (s->strained_hinge && isfinite(s->strained))
            fw_markup(out, "<td>{p}, {s}</td>", s->strained, s->strained_hinge);
        else
            fw_markup(out, "<td></td>");
        if (fw_verdict_across_tips(s))
            fw_markup(out, "<td>{n}, {p}</td><td>{n}</td>", s->tips, s->tips_error,
                      s->tips / (1 + s->tips_error));
        else
            fw_markup(out, "<td>{s}</td><td></td>", isnan(s->tips) ? "" : "nothing found");
        fw_markup(out, "<td>{s}</td></tr>\n", fw_verdict_decision_text(s->decision));
    }
}

fw_status fw_report_section_out_of_plane(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_markup(page->out,
              "<table><caption>The device as rigid plates on its flexures, out of the plane that "
              "it moves in. Ranges: "
              "the flexures' errors, and downwards what bodies may "
              "give.</caption>\n<thead><tr><th>Flow</th>"
              "<th>First frequencies</th><th>Stiffness across</th><th>Over that in the plane</th>"
              "<th>Down by its weight</th><th>Below it</th></tr></thead><tbody>\n");
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].out_of_plane) plates_row(page->out, &v->variant[i]);
    fw_markup(page->out,
              "</tbody></table>\n<table><caption>By scene: how far anything comes down "
              "and up, at most; the largest tilt, "
              "in rad; what a hinge uses of its limit there and in the plane, at most; how "
              "many times the scene's forces tip it out of the plane at "
              "the earliest, with what they may be off by; and how many times them it "
              "is sure not to.</caption>\n"
              "<thead><tr><th>Scene</th><th>Flow</th><th>Down</th><th>Up</th><th>Tilt</"
              "th><th>Hinges use</th><th>Tips at, off by</th><th>Sure up to</th>"
              "<th>Verdict</th></tr></thead><tbody>\n");
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].out_of_plane) across_rows(page->out, &v->variant[i]);
    fw_markup(page->out, "</tbody></table>\n");
    return fw_text_end(page->out);
}

/* ---- drying and sticking ---- */

bool fw_report_has_stiction(const fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].stiction) return true;
    return false;
}

/* bounds of a number; one that is infinite is left out */
static void number_cell(fw_text *out, bool known, const double number[2]) {
    if (!known || !isfinite(number[0]))
        fw_markup(out, "<td></td>");
    else if (!isfinite(number[1]))
        fw_markup(out, "<td>{n} at least</td>", number[0]);
    else
        fw_markup(out, "<td>{n} to {n}</td>", number[0], number[1]);
}

static fw_status stiction_row(fw_text *out, const fw_verdict_variant_verdict *v) {
    const fw_verdict_stiction *s = v->stiction;
    const char *needs;
    FW_TRY(fw_verdict_drying_words(out->arena, v, &needs));
    fw_markup(out, "<tr><td>{s}</td><td>{s}</td><td>{s}</td>",
              v->variant->flow ? v->variant->flow : "",
              v->variant->drying.words ? v->variant->drying.words : "", needs ? needs : "");
    number_cell(out, s->below.known, s->below.number);
    number_cell(out, s->beside.known, s->beside.number);
    number_cell(out, isfinite(s->adhesion_J_per_m2), s->peel);
    fw_markup(out, "<td>{s}</td></tr>\n", fw_verdict_decision_text(s->decision));
    return FW_OK;
}

/* "" where it is not known */
static void force_cell(fw_text *out, double force_N) {
    if (isfinite(force_N))
        fw_markup(out, "<td class=\"n\">{n} uN</td>", 1e6 * force_N);
    else
        fw_markup(out, "<td></td>");
}

/* surfaces that a scene closes */
static fw_status stuck_table(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    int rows = 0;
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_stiction *s = v->variant[i].stiction;
        for (int k = 0; s && k < s->nstuck; k++) {
            const fw_verdict_stuck *one = &s->stuck[k];
            if (rows++ == 0)
                fw_markup(
                    page->out,
                    "<table><caption>Surfaces that meet in a scene: what adhesion may hold "
                    "them with at most, and what flexures open them with at least.</caption>\n"
                    "<thead><tr><th>Surfaces</th><th>Scene</th><th>Held</th><th>Opened</th>"
                    "<th>Not known</th><th>Verdict</th></tr></thead><tbody>\n");
            fw_markup(page->out, "<tr><td>{s}</td><td>{s}</td>",
                      one->contact ? one->contact : one->hinge, one->scene);
            force_cell(page->out, one->holds_N[1]);
            force_cell(page->out, one->opens_N[0]);
            fw_markup(page->out, "<td>{s}</td><td>{s}</td></tr>\n", one->why ? one->why : "",
                      fw_verdict_decision_text(one->decision));
        }
    }
    if (rows > 0) fw_markup(page->out, "</tbody></table>\n");
    return FW_OK;
}

fw_status fw_report_section_stiction(fw_report_page *page) {
    const fw_verdict *v = page->in->verdict;
    fw_markup(
        page->out,
        "<table><caption>What the liquid that it is dried from does to the device, and "
        "adhesion to what has touched. Elastocapillary numbers: to the carrier, and from wall "
        "to wall; at 1 a stable equilibrium is lost. Peel number: above 1 what has touched "
        "comes free.</caption>\n<thead><tr><th>Flow</th><th>Drying</th><th>What the device "
        "needs</th><th>To the carrier</th><th>Wall to wall</th><th>Peel number</th>"
        "<th>Verdict</th></tr></thead><tbody>\n");
    for (int i = 0; i < v->nvariant; i++)
        if (v->variant[i].stiction) FW_TRY(stiction_row(page->out, &v->variant[i]));
    fw_markup(page->out, "</tbody></table>\n");
    FW_TRY(stuck_table(page));
    return fw_text_end(page->out);
}
