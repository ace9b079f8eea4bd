/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact outlines with true arcs: 1 user unit = 1 um, six decimals (1 pm). What is around them comes
   from the canvas (base/svg.h); the outlines themselves, of which there may be millions, have their
   own tight loop and only share the parts of arcs with other pictures (geometry/geometry_svg.h). */
#include "geometry/geometry_svg.h"
#include "mask/stream.h"
#include "base/constants.h"
#include <math.h>

static const double MARGIN_UM = 150, LEGEND_UM = 150, BAR_UM = 10;

typedef struct page {
    fw_text *out;
    double x0, y1;        /* m: upper left corner of the drawing */
    double width, height; /* um */
} page;

/* `letter` and the place: most of the file, hence in one piece */
static void coordinate(const page *p, char letter, fw_geometry_vec2 at) {
    fw_text *out = p->out;
    if (out->capacity - out->length < 2 * FW_FIXED_BYTES + 3)
        fw_text_reserve(out, 2 * FW_FIXED_BYTES + 2);
    if (out->failed) return;
    char *end = out->data + out->length;
    *end++ = letter;
    end = fw_place_text(end, (at.x - p->x0) * 1e6, (p->y1 - at.y) * 1e6);
    out->length = (size_t)(end - out->data);
}

static void arc(const page *p, const fw_geometry_segment *s) {
    int parts = fw_geometry_arc_parts(s, FW_GEOMETRY_ARC_EXACT);
    for (int i = 1; i <= parts; i++) {
        fw_svg_point(p->out, 'A', s->radius * 1e6, s->radius * 1e6, 6);
        fw_text_add(p->out, s->sweep_rad < 0 ? " 0 0 1" : " 0 0 0");
        coordinate(p, ' ', fw_geometry_arc_end(s, i, parts));
    }
}

static void segment(const page *p, const fw_geometry_segment *s) {
    if (s->kind == FW_ARC) {
        arc(p, s);
        return;
    }
    coordinate(p, 'L', s->b);
}

/* unique among the cells of a document; a name of XML */
static void name_of(fw_text *out, const fw_mask *mask, int shape) {
    fw_text_add(out, "s.");
    for (const char *c = mask->cell; c && *c; c++)
        fw_text_bytes(out, *c == '?' || *c == '$' ? "_" : c, 1);
    fw_text_printf(out, ".%d", shape);
}

/* the path of another shape, moved */
static void repeat(const page *p, const fw_mask *mask, int first, const fw_mask_shape *s) {
    fw_geometry_vec2 from = mask->shape[first].contour.segment[0].a, to = s->contour.segment[0].a;
    double x0 = round((from.x - p->x0) * 1e12), y0 = round((p->y1 - from.y) * 1e12);
    double x1 = round((to.x - p->x0) * 1e12), y1 = round((p->y1 - to.y) * 1e12);
    fw_svg_start(p->out, "use xlink:href");
    fw_text_add(p->out, "#");
    name_of(p->out, mask, first);
    fw_svg_more(p->out, "x='{6}' y='{6}'", (x1 - x0) * 1e-6, (y1 - y0) * 1e-6);
    fw_svg_finish(p->out, ">");
    fw_svg_put(p->out, "title>{s}", s->piece->label);
    fw_svg_close(p->out, "use\n");
}

/* id: of the shape in the mask where others repeat it, else -1 */
static void shape(const page *p, const fw_mask *mask, const fw_mask_shape *s, int id) {
    if (id >= 0) {
        fw_svg_start(p->out, "path id");
        name_of(p->out, mask, id);
        fw_svg_more(p->out, "d=''");
    } else
        fw_svg_path(p->out, "");
    coordinate(p, 'M', s->contour.segment[0].a);
    for (int i = 0; i < s->contour.count; i++)
        segment(p, &s->contour.segment[i]);
    fw_text_add(p->out, "Z");
    fw_svg_finish(p->out, ">");
    fw_svg_put(p->out, "title>{s}", s->piece->label);
    fw_svg_close(p->out, "path\n");
}

void fw_mask_svg_paths(const fw_mask *mask, int layer, fw_geometry_vec2 upper_left, fw_text *out) {
    page p = {.out = out, .x0 = upper_left.x, .y1 = upper_left.y};
    int *of;
    if (fw_mask_svg_repeats(out->arena, mask, layer, upper_left, &of) != FW_OK) {
        out->failed = 1;
        return;
    }
    for (int i = 0; i < mask->nshape; i++) {
        if (mask->shape[i].layer != layer) continue;
        if (of[i] >= 0 && of[i] != i)
            repeat(&p, mask, of[i], &mask->shape[i]);
        else
            shape(&p, mask, &mask->shape[i], of[i]);
    }
}

static void layer(const page *p, const fw_mask *mask, int k) {
    const fw_mask_layer *y = &mask->table->layer[k];
    fw_svg_open(p->out, "g id='{r}' data-gds='{i}/{i}' fill='{r}' fill-opacity='0.8'", y->id,
                y->layer, y->datatype, y->colour);
    fw_svg_title(p->out, "{s}: {s} ({r})", y->name, y->purpose, y->tone);
    fw_mask_svg_paths(mask, k, (fw_geometry_vec2){p->x0, p->y1}, p->out);
    fw_svg_close(p->out, "g\n");
}

/* 1, 2 or 5 times a power of ten, at most a quarter of the width */
static double bar_length(double width_um) {
    double ten = pow(10, floor(log10(width_um / 4)));
    double times = width_um / 4 / ten;
    return ten * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

static void scale_bar(const page *p, double drawn_um) {
    double length = bar_length(drawn_um), y = p->height - LEGEND_UM;
    fw_svg_open(p->out, "g id='scale' fill='#000000'\n");
    fw_svg_put(p->out, "rect x='{6}' y='{6}' width='{6}' height='{6}'\n", MARGIN_UM, y, length,
               BAR_UM);
    fw_svg_open(p->out, "text font-family='sans-serif' font-size='80' x='{6}' y='{6}'", MARGIN_UM,
                y + 90);
    fw_text_number(p->out, length, 6);
    fw_text_add(p->out, " um");
    fw_svg_close(p->out, "text\n");
    fw_svg_close(p->out, "g\n");
}

static void head(const page *p, const fw_mask *mask) {
    fw_svg_begin(p->out, &(fw_svg_frame){.width = p->width,
                                         .height = p->height,
                                         .decimals = 6,
                                         .size = FW_SVG_SIZE_BEFORE,
                                         .unit_mm = 1e-3,
                                         .mm_decimals = 9,
                                         .file = true,
                                         .links = true,
                                         .lead = "version='1.1'"});
    fw_svg_title(p->out, "{r}{s}, {s}", mask->rejected ? "REJECTED: " : "", mask->title,
                 mask->flow);
    fw_svg_open(p->out, "desc");
    fw_markup(p->out, "1 unit = 1 um; {s}; bias per edge ", mask->table->reading);
    fw_text_number(p->out, mask->bias_m * 1e6, 6);
    fw_text_add(p->out, " um, included; flexwright " FW_VERSION);
    fw_svg_close(p->out, "desc\n");
}

/* about what the outlines take, so that the text is not copied while it grows: by some of their
   segments, since to read all of them takes as long as to write them */
static size_t expected_bytes(const fw_mask *mask) {
    enum { HEAD = 4096, SHAPE = 100, LINE = 20, ARC = 90, SAMPLES = 32 };
    size_t n = HEAD;
    for (int k = 0; k < mask->nshape; k++) {
        const fw_geometry_contour *c = &mask->shape[k].contour;
        int step = c->count / SAMPLES + 1;
        n += SHAPE;
        for (int i = 0; i < c->count; i += step)
            n += (size_t)step * (c->segment[i].kind == FW_ARC ? ARC : LINE);
    }
    return n;
}

fw_status fw_mask_write_svg(const fw_mask *mask, fw_text *out) {
    double width = (mask->box.x1 - mask->box.x0) * 1e6,
           height = (mask->box.y1 - mask->box.y0) * 1e6;
    page p = {out, mask->box.x0 - MARGIN_UM * 1e-6, mask->box.y1 + MARGIN_UM * 1e-6,
              width + 2 * MARGIN_UM, height + 2 * MARGIN_UM + LEGEND_UM};
    fw_text_reserve(out, expected_bytes(mask));
    head(&p, mask);
    for (int k = 0; k < mask->table->nlayer; k++)
        if (mask->table->layer[k].roles) layer(&p, mask, k);
    scale_bar(&p, width);
    if (mask->rejected)
        fw_svg_put(out, "text id='rejected' x='50%' y='50%' text-anchor='middle' "
                        "font-family='sans-serif' font-size='500' fill='#c00000' "
                        "fill-opacity='0.6'>REJECTED\n");
    fw_svg_end(out);
    return fw_text_end(out);
}
