/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include "base/constants.h"
#include "geometry/contour.h"
#include <math.h>
#include <string.h>

/* The mask's contour moved by edge - bias: what the mask added, less what the flow took. Edge and
   bias m outside the drawn edge. NaN: not asked for. Test: test_outlines.c, identity. */
static fw_status fabricated(fw_arena *arena, const fw_mask *mask, const fw_mask_shape *s,
                            double edge_m, fw_geometry_contour *out, int *gone) {
    double d = edge_m - mask->bias_m;
    int i, j;
    *out = (fw_geometry_contour){0};
    if (isnan(d)) return FW_OK;
    if (d == 0.0) {
        *out = s->contour;
        return FW_OK;
    }
    fw_status status = fw_geometry_contour_offset(arena, &s->contour, d, out, &i, &j);
    if (status != FW_GEOMETRY) return status;
    *out = (fw_geometry_contour){0};
    ++*gone;
    return FW_OK;
}

fw_status fw_mask_outlines_of(fw_arena *arena, const fw_mask *mask, fw_mask_outlines *out) {
    *out = (fw_mask_outlines){0};
    const fw_mask_edges *e = mask->edges;
    if (!e) return FW_OK;
    FW_NEED(out->outline = fw_arena_array(arena, fw_mask_outline, (size_t)mask->nshape));
    int most = 0; /* gone at the best end is gone at the worst one too */
    for (int k = 0; k < mask->nshape; k++) {
        const fw_mask_shape *s = &mask->shape[k];
        if (!mask->table->layer[s->layer].biased) continue;
        fw_mask_outline *o = &out->outline[out->n++];
        o->shape = s;
        FW_TRY(fabricated(arena, mask, s, e->top_m, &o->top, &out->gone_top));
        FW_TRY(fabricated(arena, mask, s, e->bottom_m, &o->bottom, &out->gone_bottom));
        FW_TRY(fabricated(arena, mask, s, e->least_m, &o->least, &out->gone_least));
        FW_TRY(fabricated(arena, mask, s, e->most_m, &o->most, &most));
    }
    return FW_OK;
}

/* As drawn, on the mask and as fabricated, over each other: one picture with true arcs, and two
   places of it enlarged, the narrowest line and the narrowest space. 1 user unit = 1 um. */

static const double MARGIN_UM = 100, GAP_UM = 60;
enum { DECIMALS = 4 }; /* a picture: 0.1 nm */

typedef struct page {
    fw_text *out;
    const fw_mask *mask;
    fw_mask_outlines lines;
    double x0, y1;              /* m: upper left corner of the drawing */
    double drawn, tall;         /* um: of the drawing with its margin */
    double inset;               /* um: side of an enlargement */
    double font;                /* um */
    bool banded, tapered, even; /* a range; faces that differ; what stands is what was drawn */
    bool made;                  /* what stands in the end is known at all */
    bool part;                  /* of another document */
} page;

/* ids must differ from those of other flows in one document */
static void id(const page *p, const char *name) {
    fw_text_escaped(p->out, p->mask->flow);
    fw_text_printf(p->out, "-%s", name);
}

/* ---- paths ---- */

static fw_geometry_sheet sheet_of(const page *p) {
    return (fw_geometry_sheet){p->x0, p->y1, 1e6, DECIMALS, FW_GEOMETRY_ARC_EXACT};
}

typedef enum which { DRAWN, ON_MASK, TOP, BOTTOM } which;

static const fw_geometry_contour *pick(const fw_mask_outline *o, which w) {
    return w == DRAWN     ? &o->shape->piece->contour
           : w == ON_MASK ? &o->shape->contour
           : w == TOP     ? &o->top
                          : &o->bottom;
}

static void open_path(const page *p, const char *name) {
    fw_svg_start(p->out, "path id");
    id(p, name);
}

/* whole: closed, for filling; else the edges alone, without the cuts between pieces */
static void group(const page *p, const char *name, which w, bool whole) {
    const fw_geometry_sheet sheet = sheet_of(p);
    open_path(p, name);
    fw_svg_more(p->out, "d=''");
    for (int i = 0; i < p->lines.n; i++)
        if (whole)
            fw_geometry_svg_contour(p->out, &sheet, pick(&p->lines.outline[i], w));
        else
            fw_geometry_svg_edges(p->out, &sheet, pick(&p->lines.outline[i], w));
    fw_svg_path_end(p->out);
}

/* between the two ends of the range: both outlines of a shape, even-odd. A shape that is gone at
   the worse end is filled up to the better one. */
static void band(const page *p) {
    const fw_geometry_sheet sheet = sheet_of(p);
    open_path(p, "band");
    fw_svg_more(p->out, "fill-rule='evenodd' d=''");
    for (int i = 0; i < p->lines.n; i++) {
        fw_geometry_svg_contour(p->out, &sheet, &p->lines.outline[i].most);
        fw_geometry_svg_contour(p->out, &sheet, &p->lines.outline[i].least);
    }
    fw_svg_path_end(p->out);
}

static void define(const page *p) {
    fw_svg_open(p->out, "defs\n");
    group(p, "drawn", DRAWN, false);
    group(p, "mask", ON_MASK, false);
    group(p, "body", p->tapered ? BOTTOM : TOP, true);
    if (!p->even) group(p, "top", TOP, false);
    if (p->tapered) group(p, "bottom", BOTTOM, false);
    if (p->banded) band(p);
    fw_svg_close(p->out, "defs\n");
}

/* ---- one view of everything ---- */

static const char *const BODY = "#dfeadf", *const BAND = "#f4a340", *const MASK = "#1f5fbf",
                         *const MADE = "#187a2f";

static void open_use(const page *p, const char *name) {
    fw_svg_start(p->out, "use href");
    fw_text_add(p->out, "#");
    id(p, name);
}

static void filled(const page *p, const char *name, const char *colour) {
    open_use(p, name);
    fw_svg_more(p->out, "fill='{r}'", colour);
    fw_svg_path_end(p->out);
}

static void use(const page *p, const char *name, const char *colour, double width,
                const char *dashes, double unit) {
    open_use(p, name);
    fw_svg_more(p->out, "fill='none' stroke='{r}' stroke-width=''", colour);
    fw_text_number(p->out, width, 4);
    if (*dashes) fw_svg_more(p->out, "stroke-dasharray=''");
    for (const char *d = dashes; *d; d++) { /* one digit each, in units */
        if (d != dashes) fw_text_add(p->out, " ");
        fw_text_number(p->out, (*d - '0') * unit, 4);
    }
    fw_svg_path_end(p->out);
}

/* unit: um of a hair line in this view */
static void view(const page *p, double unit) {
    filled(p, "body", BODY);
    if (p->banded) filled(p, "band", BAND);
    use(p, "mask", MASK, unit, "", unit);
    if (p->tapered) use(p, "bottom", MADE, unit, "23", unit);
    if (p->made) use(p, p->even ? "drawn" : "top", MADE, 3 * unit, "", unit);
    use(p, "drawn", "#000000", unit, "97", unit);
}

static void words(const page *p, double x, double y, double size, const char *text) {
    fw_svg_put(p->out, "text x='{2}' y='{2}' font-size='{2}'>{s}\n", x, y, size, text);
}

/* ---- enlargements ---- */

/* a square of the drawing, `across` wide, about the middle of a chord; label below */
static void enlarge(const page *p, const fw_geometry_vec2 *at, double across_um, double x, double y,
                    const char *const *label, int nlabel) {
    double cx = (0.5 * (at[0].x + at[1].x) - p->x0) * 1e6;
    double cy = (p->y1 - 0.5 * (at[0].y + at[1].y)) * 1e6;
    fw_svg_inset(p->out, "x='{3}' y='{3}' width='{3}' height='{3}' viewBox='{4} {4} {4} {4}'", x, y,
                 p->inset, p->inset, cx - across_um / 2, cy - across_um / 2, across_um, across_um);
    view(p, across_um / 300);
    fw_svg_end(p->out);
    fw_svg_put(p->out,
               "rect fill='none' stroke='#606060' stroke-width='3' x='{3}' y='{3}' width='{3}' "
               "height='{3}'\n",
               x, y, p->inset, p->inset);
    for (int i = 0; i < nlabel; i++)
        words(p, x, y + p->inset + (1.2 + 1.15 * i) * p->font, p->font, label[i]);
}

static const char *um(char *text, double value_m) {
    return fw_number_text(text, 32, value_m * 1e6, 4);
}

/* sign +1: a line, -1: a space, mask_m wide on the mask */
static fw_status size_labels(const page *p, const char *what, double sign, double mask_m,
                             const char *label[3]) {
    const fw_mask_edges *e = p->mask->edges;
    char t[6][32];
    double drawn = mask_m - sign * 2 * p->mask->bias_m, twice = 2 * sign;
    double least = fmax(0, drawn + twice * fmin(sign * e->least_m, sign * e->most_m) * sign),
           most = fmax(0, drawn + twice * fmax(sign * e->least_m, sign * e->most_m) * sign);
    fw_arena *arena = p->out->arena;
    label[0] = what;
    FW_NEED(label[1] = fw_arena_printf(arena, "drawn %s, on the mask %s um", um(t[0], drawn),
                                       um(t[1], mask_m)));
    label[2] =
        p->tapered ? fw_arena_printf(arena, "made %s at the top, %s um below",
                                     um(t[2], fmax(0, drawn + twice * e->top_m)),
                                     um(t[3], fmax(0, drawn + twice * e->bottom_m)))
        : p->banded
            ? fw_arena_printf(arena, "made %s to %s um at the top", um(t[2], least), um(t[3], most))
            : fw_arena_printf(arena, "made %s um", um(t[2], drawn + twice * e->top_m));
    if (!p->made) label[2] = "";
    FW_NEED(label[2]);
    return FW_OK;
}

static fw_status enlargements(const page *p) {
    const fw_mask_measure *line = NULL, *space = NULL;
    for (int k = 0; k < p->mask->table->nlayer; k++) {
        const fw_mask_measure *m = &p->mask->measure[k];
        if (!p->mask->table->layer[k].biased) continue;
        if (isfinite(m->width_m) && (!line || m->width_m < line->width_m)) line = m;
        if (isfinite(m->space_m) && (!space || m->space_m < space->space_m)) space = m;
    }
    const char *label[3];
    double x = p->drawn + GAP_UM, y = MARGIN_UM;
    if (line) {
        FW_TRY(size_labels(p, "narrowest line", 1, line->width_m, label));
        enlarge(p, line->width_at, 3e6 * line->width_m, x, y, label, 3);
        y += p->inset + 4.6 * p->font;
    }
    if (space) {
        FW_TRY(size_labels(p, "narrowest space", -1, space->space_m, label));
        enlarge(p, space->space_at, 3e6 * space->space_m, x, y, label, 3);
    }
    return FW_OK;
}

/* ---- legend ---- */

static void sample(const page *p, double y, const char *style) {
    double middle = y - 0.35 * p->font;
    fw_svg_put(p->out, "line x1='{2}' x2='{2}' y1='{2}' y2='{2}' {r}\n", MARGIN_UM,
               MARGIN_UM + 4 * p->font, middle, middle, style);
}

static void entry(const page *p, int *line, const char *style, const char *text) {
    double y = p->tall + (1.5 + 1.4 * (*line)++) * p->font;
    if (style) sample(p, y, style);
    words(p, style ? MARGIN_UM + 5 * p->font : MARGIN_UM, y, p->font, text);
}

static int parts_of(const char *range) {
    int n = 1;
    for (const char *s = range; *s; s++)
        n += *s == ';';
    return n;
}

/* one line for each of the parts between semicolons */
static fw_status range_entries(const page *p, int *line) {
    const char *s = p->mask->edges->range, *lead = "where the top edge may stand: ";
    for (int i = 0; i < parts_of(p->mask->edges->range); i++) {
        int n = (int)strcspn(s, ";");
        const char *text = fw_arena_printf(p->out->arena, "%s%.*s", lead, n, s);
        FW_NEED(text);
        if (i == 0)
            entry(p, line, "stroke=\"#f4a340\" stroke-width=\"36\"", text);
        else
            words(p, MARGIN_UM + 6 * p->font, p->tall + (1.5 + 1.4 * (*line)++) * p->font, p->font,
                  text);
        s += n + (s[n] == ';');
        s += *s == ' ';
        lead = "and ";
    }
    return FW_OK;
}

static fw_status gone_entry(const page *p, int *line) {
    const fw_mask_outlines *l = &p->lines;
    const char *text;
    if (l->gone_top + l->gone_bottom + l->gone_least == 0) return FW_OK;
    FW_NEED(
        text = fw_arena_printf(
            p->out->arena,
            "Not drawn, because nothing is left of them or edges meet: %d shapes at the top, %d "
            "at the bottom, %d at the worse end of the range.",
            l->gone_top, l->gone_bottom, l->gone_least));
    entry(p, line, NULL, text);
    return FW_OK;
}

static const char *side(double edge_m) {
    return edge_m < 0 ? "inside" : "outside";
}

static fw_status legend(const page *p) {
    const fw_mask_edges *e = p->mask->edges;
    fw_arena *arena = p->out->arena;
    char t[4][32];
    const char *mask = fw_arena_printf(arena, "mask: %s um %s the drawn edge",
                                       um(t[0], fabs(p->mask->bias_m)), side(p->mask->bias_m)),
               *top = fw_arena_printf(arena, "as fabricated%s%s: %s um %s the drawn edge",
                                      p->tapered ? ", top face" : "",
                                      e->known_part ? ", known part"
                                      : p->banded   ? ", nominal"
                                                    : "",
                                      um(t[1], fabs(e->top_m)), side(e->top_m)),
               *bottom =
                   fw_arena_printf(arena, "as fabricated, bottom face: %s um %s the drawn edge",
                                   um(t[2], fabs(e->bottom_m)), side(e->bottom_m));
    FW_NEED(mask && top && bottom ? mask : NULL);
    int line = 0;
    entry(p, &line, "stroke=\"#000000\" stroke-width=\"6\" stroke-dasharray=\"36 24\"", "as drawn");
    entry(p, &line, "stroke=\"#1f5fbf\" stroke-width=\"6\"", mask);
    if (p->made) entry(p, &line, "stroke=\"#187a2f\" stroke-width=\"12\"", top);
    if (p->tapered)
        entry(p, &line, "stroke=\"#187a2f\" stroke-width=\"6\" stroke-dasharray=\"12 18\"", bottom);
    if (p->banded) FW_TRY(range_entries(p, &line));
    FW_TRY(gone_entry(p, &line));
    if (e->note) entry(p, &line, NULL, e->note);
    return FW_OK;
}

static double legend_height(const page *p) {
    bool gone = p->lines.gone_top + p->lines.gone_bottom + p->lines.gone_least > 0;
    int ranges = p->banded ? parts_of(p->mask->edges->range) : 0;
    int rows = 3 + p->tapered + ranges + gone + (p->mask->edges->note != NULL);
    return (1.5 + 1.4 * rows) * p->font;
}

/* ---- the page ---- */

/* as wide as a screen: at its own size a device is a dot */
static const double PICTURE_MM = 280;

static void head(const page *p, double width, double height) {
    fw_svg_begin(p->out,
                 &(fw_svg_frame){.width = width,
                                 .height = height,
                                 .decimals = 4,
                                 .size = p->part ? FW_SVG_SIZE_NONE : FW_SVG_SIZE_BEFORE,
                                 .unit_mm = PICTURE_MM / width,
                                 .mm_decimals = 3,
                                 .file = !p->part,
                                 .lead = p->part ? "version='1.1' class='drawing' role='img'"
                                                 : "version='1.1'",
                                 .font = "sans-serif"});
    fw_svg_title(p->out, "{r}{s}, {s}: as drawn, on the mask, as fabricated",
                 p->mask->rejected ? "REJECTED: " : "", p->mask->title, p->mask->flow);
    fw_svg_put(p->out, "desc>1 unit of the view box = 1 um; a picture, not for writing masks; "
                       "flexwright " FW_VERSION "\n");
    fw_svg_paper(p->out, "#ffffff");
}

static page page_of(const fw_mask *mask, fw_text *out) {
    const fw_mask_edges *e = mask->edges;
    page p = {.out = out,
              .mask = mask,
              .x0 = mask->box.x0 - MARGIN_UM * 1e-6,
              .y1 = mask->box.y1 + MARGIN_UM * 1e-6,
              .banded = isfinite(e->least_m) && isfinite(e->most_m) &&
                        fabs(e->most_m - e->least_m) > 1e-12,
              .tapered = fabs(e->top_m - e->bottom_m) > 1e-12};
    p.even = !p.tapered && fabs(e->top_m) < 1e-12;
    p.drawn = (mask->box.x1 - mask->box.x0) * 1e6 + 2 * MARGIN_UM;
    p.tall = (mask->box.y1 - mask->box.y0) * 1e6 + 2 * MARGIN_UM;
    p.font = 0.02 * fmin(p.drawn, p.tall);
    p.inset = 0.5 * (p.tall - 2 * MARGIN_UM) - 4.6 * p.font;
    return p;
}

static fw_status picture(const fw_mask *mask, bool part, fw_text *out) {
    const fw_mask_edges as_drawn = {.least_m = (double)NAN, .most_m = (double)NAN, .range = ""};
    fw_mask own = *mask;
    if (!own.edges) own.edges = &as_drawn;
    page p = page_of(&own, out);
    p.part = part;
    p.made = mask->edges != NULL;
    FW_TRY(fw_mask_outlines_of(out->arena, &own, &p.lines));
    double width = p.drawn + GAP_UM + p.inset + MARGIN_UM, height = p.tall + legend_height(&p);
    head(&p, width, height);
    define(&p);
    view(&p, p.drawn / 2500);
    FW_TRY(enlargements(&p));
    FW_TRY(legend(&p));
    if (mask->rejected)
        fw_svg_put(out, "text x='50%' y='50%' text-anchor='middle' font-size='500' fill='#c00000' "
                        "fill-opacity='0.6'>REJECTED\n");
    fw_svg_end(out);
    return fw_text_end(out);
}

/* a tapered band is drawn by its top face; without edges: the drawing and the mask alone */
fw_status fw_mask_write_outlines(const fw_mask *mask, fw_text *out) {
    return picture(mask, false, out);
}

fw_status fw_mask_outlines_part(const fw_mask *mask, fw_text *out) {
    return picture(mask, true, out);
}
