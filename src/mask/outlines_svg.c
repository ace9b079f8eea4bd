/* SPDX-License-Identifier: GPL-3.0-or-later */
/* As drawn, on the mask and as fabricated, over each other: one picture with true arcs, and two
   places of it enlarged, the narrowest line and the narrowest space. 1 user unit = 1 um. */
#include "mask/outlines.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

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

static void point(const page *p, char letter, fw_vec2 at) {
    char text[2 * FW_FIXED_BYTES + 2], *end = text;
    *end++ = letter;
    end = fw_fixed_text(end, (at.x - p->x0) * 1e6, DECIMALS);
    *end++ = ' ';
    end = fw_fixed_text(end, (p->y1 - at.y) * 1e6, DECIMALS);
    fw_text_bytes(p->out, text, (size_t)(end - text));
}

/* in parts of at most a third of a turn, as in svg.c */
static void arc(const page *p, const fw_segment *s) {
    int parts = (int)ceil(fabs(s->sweep_rad) / (2 * FW_PI / 3) - 1e-9);
    fw_vec2 r = {s->a.x - s->centre.x, s->a.y - s->centre.y};
    for (int i = 1; i <= parts; i++) {
        double c = cos(s->sweep_rad * i / parts), n = sin(s->sweep_rad * i / parts);
        fw_vec2 to = {s->centre.x + r.x * c - r.y * n, s->centre.y + r.x * n + r.y * c};
        fw_text_add(p->out, "A");
        fw_text_fixed(p->out, s->radius * 1e6, DECIMALS);
        fw_text_add(p->out, " ");
        fw_text_fixed(p->out, s->radius * 1e6, DECIMALS);
        fw_text_add(p->out, s->sweep_rad < 0 ? " 0 0 1" : " 0 0 0");
        point(p, ' ', i < parts ? to : s->b);
    }
}

/* whole: closed, for filling; else the edges alone, without the cuts between pieces */
static void contour(const page *p, const fw_contour *c, bool whole) {
    bool pen = false;
    for (int i = 0; i < c->count; i++) {
        const fw_segment *s = &c->segment[i];
        if (!whole && s->flags & FW_SEGMENT_JOINT) {
            pen = false;
            continue;
        }
        if (!pen) point(p, 'M', s->a);
        pen = true;
        if (s->kind == FW_ARC)
            arc(p, s);
        else
            point(p, 'L', s->b);
    }
    if (whole && c->count > 0) fw_text_add(p->out, "Z");
}

typedef enum which { DRAWN, ON_MASK, TOP, BOTTOM } which;

static const fw_contour *pick(const fw_mask_outline *o, which w) {
    return w == DRAWN     ? &o->shape->piece->contour
           : w == ON_MASK ? &o->shape->contour
           : w == TOP     ? &o->top
                          : &o->bottom;
}

static void group(const page *p, const char *name, which w, bool whole) {
    fw_text_add(p->out, "<path id=\"");
    id(p, name);
    fw_text_add(p->out, "\" d=\"");
    for (int i = 0; i < p->lines.n; i++)
        contour(p, pick(&p->lines.outline[i], w), whole);
    fw_text_add(p->out, "\"/>\n");
}

/* between the two ends of the range: both outlines of a shape, even-odd. A shape that is gone at
   the worse end is filled up to the better one. */
static void band(const page *p) {
    fw_text_add(p->out, "<path id=\"");
    id(p, "band");
    fw_text_add(p->out, "\" fill-rule=\"evenodd\" d=\"");
    for (int i = 0; i < p->lines.n; i++) {
        contour(p, &p->lines.outline[i].most, true);
        contour(p, &p->lines.outline[i].least, true);
    }
    fw_text_add(p->out, "\"/>\n");
}

static void define(const page *p) {
    fw_text_add(p->out, "<defs>\n");
    group(p, "drawn", DRAWN, false);
    group(p, "mask", ON_MASK, false);
    group(p, "body", p->tapered ? BOTTOM : TOP, true);
    if (!p->even) group(p, "top", TOP, false);
    if (p->tapered) group(p, "bottom", BOTTOM, false);
    if (p->banded) band(p);
    fw_text_add(p->out, "</defs>\n");
}

/* ---- one view of everything ---- */

static const char *const BODY = "#dfeadf", *const BAND = "#f4a340", *const MASK = "#1f5fbf",
                         *const MADE = "#187a2f";

static void filled(const page *p, const char *name, const char *colour) {
    fw_text_add(p->out, "<use href=\"#");
    id(p, name);
    fw_text_printf(p->out, "\" fill=\"%s\"/>\n", colour);
}

static void use(const page *p, const char *name, const char *colour, double width,
                const char *dashes, double unit) {
    fw_text_add(p->out, "<use href=\"#");
    id(p, name);
    fw_text_printf(p->out, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"", colour);
    fw_text_number(p->out, width, 4);
    if (*dashes) {
        fw_text_add(p->out, "\" stroke-dasharray=\"");
        for (const char *d = dashes; *d; d++) { /* one digit each, in units */
            if (d != dashes) fw_text_add(p->out, " ");
            fw_text_number(p->out, (*d - '0') * unit, 4);
        }
    }
    fw_text_add(p->out, "\"/>\n");
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
    fw_text_add(p->out, "<text x=\"");
    fw_text_fixed(p->out, x, 2);
    fw_text_add(p->out, "\" y=\"");
    fw_text_fixed(p->out, y, 2);
    fw_text_add(p->out, "\" font-size=\"");
    fw_text_fixed(p->out, size, 2);
    fw_text_add(p->out, "\">");
    fw_text_escaped(p->out, text);
    fw_text_add(p->out, "</text>\n");
}

/* ---- enlargements ---- */

/* a square of the drawing, `across` wide, about the middle of a chord; label below */
static void enlarge(const page *p, const fw_vec2 *at, double across_um, double x, double y,
                    const char *const *label, int nlabel) {
    double cx = (0.5 * (at[0].x + at[1].x) - p->x0) * 1e6;
    double cy = (p->y1 - 0.5 * (at[0].y + at[1].y)) * 1e6;
    fw_text_add(p->out, "<svg x=\"");
    fw_text_fixed(p->out, x, 3);
    fw_text_add(p->out, "\" y=\"");
    fw_text_fixed(p->out, y, 3);
    fw_text_add(p->out, "\" width=\"");
    fw_text_fixed(p->out, p->inset, 3);
    fw_text_add(p->out, "\" height=\"");
    fw_text_fixed(p->out, p->inset, 3);
    fw_text_add(p->out, "\" viewBox=\"");
    const double box[] = {cx - across_um / 2, cy - across_um / 2, across_um, across_um};
    for (int i = 0; i < 4; i++) {
        if (i) fw_text_add(p->out, " ");
        fw_text_fixed(p->out, box[i], 4);
    }
    fw_text_add(p->out, "\">\n");
    view(p, across_um / 300);
    fw_text_add(p->out, "</svg>\n<rect fill=\"none\" stroke=\"#606060\" stroke-width=\"3\" x=\"");
    fw_text_fixed(p->out, x, 3);
    fw_text_add(p->out, "\" y=\"");
    fw_text_fixed(p->out, y, 3);
    fw_text_add(p->out, "\" width=\"");
    fw_text_fixed(p->out, p->inset, 3);
    fw_text_add(p->out, "\" height=\"");
    fw_text_fixed(p->out, p->inset, 3);
    fw_text_add(p->out, "\"/>\n");
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
    fw_text_add(p->out, "<line x1=\"");
    fw_text_fixed(p->out, MARGIN_UM, 2);
    fw_text_add(p->out, "\" x2=\"");
    fw_text_fixed(p->out, MARGIN_UM + 4 * p->font, 2);
    for (int i = 1; i < 3; i++) {
        fw_text_printf(p->out, "\" y%d=\"", i);
        fw_text_fixed(p->out, y - 0.35 * p->font, 2);
    }
    fw_text_printf(p->out, "\" %s/>\n", style);
}

static void entry(const page *p, int *row, const char *style, const char *text) {
    double y = p->tall + (1.5 + 1.4 * (*row)++) * p->font;
    if (style) sample(p, y, style);
    words(p, style ? MARGIN_UM + 5 * p->font : MARGIN_UM, y, p->font, text);
}

static int parts_of(const char *range) {
    int n = 1;
    for (const char *s = range; *s; s++)
        n += *s == ';';
    return n;
}

/* one row for each of the parts between semicolons */
static fw_status range_entries(const page *p, int *row) {
    const char *s = p->mask->edges->range, *lead = "where the top edge may stand: ";
    for (int i = 0; i < parts_of(p->mask->edges->range); i++) {
        int n = (int)strcspn(s, ";");
        const char *text = fw_arena_printf(p->out->arena, "%s%.*s", lead, n, s);
        FW_NEED(text);
        if (i == 0)
            entry(p, row, "stroke=\"#f4a340\" stroke-width=\"36\"", text);
        else
            words(p, MARGIN_UM + 6 * p->font, p->tall + (1.5 + 1.4 * (*row)++) * p->font, p->font,
                  text);
        s += n + (s[n] == ';');
        s += *s == ' ';
        lead = "and ";
    }
    return FW_OK;
}

static fw_status gone_entry(const page *p, int *row) {
    const fw_mask_outlines *l = &p->lines;
    const char *text;
    if (l->gone_top + l->gone_bottom + l->gone_least == 0) return FW_OK;
    FW_NEED(
        text = fw_arena_printf(
            p->out->arena,
            "Not drawn, because nothing is left of them or edges meet: %d shapes at the top, %d "
            "at the bottom, %d at the worse end of the range.",
            l->gone_top, l->gone_bottom, l->gone_least));
    entry(p, row, NULL, text);
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
    int row = 0;
    entry(p, &row, "stroke=\"#000000\" stroke-width=\"6\" stroke-dasharray=\"36 24\"", "as drawn");
    entry(p, &row, "stroke=\"#1f5fbf\" stroke-width=\"6\"", mask);
    if (p->made) entry(p, &row, "stroke=\"#187a2f\" stroke-width=\"12\"", top);
    if (p->tapered)
        entry(p, &row, "stroke=\"#187a2f\" stroke-width=\"6\" stroke-dasharray=\"12 18\"", bottom);
    if (p->banded) FW_TRY(range_entries(p, &row));
    FW_TRY(gone_entry(p, &row));
    if (e->note) entry(p, &row, NULL, e->note);
    return FW_OK;
}

static double legend_height(const page *p) {
    bool gone = p->lines.gone_top + p->lines.gone_bottom + p->lines.gone_least > 0;
    int ranges = p->banded ? parts_of(p->mask->edges->range) : 0;
    int rows = 3 + p->tapered + ranges + gone + (p->mask->edges->note != NULL);
    return (1.5 + 1.4 * rows) * p->font;
}

/* ---- the page ---- */

static void title(const page *p) {
    fw_text_add(p->out, "<title>");
    if (p->mask->rejected) fw_text_add(p->out, "REJECTED: ");
    fw_text_escaped(p->out, p->mask->title);
    fw_text_add(p->out, ", ");
    fw_text_escaped(p->out, p->mask->flow);
    fw_text_add(p->out, ": as drawn, on the mask, as fabricated</title>\n");
}

/* as wide as a screen: at its own size a device is a dot */
static const double PICTURE_MM = 280;

static void head(const page *p, double width, double height) {
    fw_text_add(p->out, p->part ? "" : "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    fw_text_add(p->out, "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"");
    const double side_um[] = {width, height};
    for (int i = 0; i < 2 && !p->part; i++) {
        fw_text_printf(p->out, " %s=\"", i ? "height" : "width");
        fw_text_fixed(p->out, side_um[i] * PICTURE_MM / width, 3);
        fw_text_add(p->out, "mm\"");
    }
    fw_text_add(p->out,
                p->part ? " class=\"drawing\" role=\"img\" viewBox=\"0 0 " : " viewBox=\"0 0 ");
    fw_text_fixed(p->out, width, 4);
    fw_text_add(p->out, " ");
    fw_text_fixed(p->out, height, 4);
    fw_text_add(p->out, "\" font-family=\"sans-serif\">\n");
    title(p);
    fw_text_add(p->out, "<desc>1 unit of the view box = 1 um; a picture, not for writing masks; "
                        "flexwright " FW_VERSION "</desc>\n<rect width=\"100%\" height=\"100%\" "
                        "fill=\"#ffffff\"/>\n");
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
        fw_text_add(out, "<text x=\"50%\" y=\"50%\" text-anchor=\"middle\" font-size=\"500\" "
                         "fill=\"#c00000\" fill-opacity=\"0.6\">REJECTED</text>\n");
    fw_text_add(out, "</svg>\n");
    return fw_text_end(out);
}

/* a tapered band is drawn by its top face; without edges: the drawing and the mask alone */
fw_status fw_mask_write_outlines(const fw_mask *mask, fw_text *out) {
    return picture(mask, false, out);
}

fw_status fw_mask_outlines_part(const fw_mask *mask, fw_text *out) {
    return picture(mask, true, out);
}
