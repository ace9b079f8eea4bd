/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which outlines are another one, moved: letters, combs, marks. */
#include "mask/mask_parts.h"
#include "base/constants.h"
#include "geometry/contour.h"
#include "base/sort.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* bytes: a reference takes some 60 */
enum { SAMPLES = 16, LINE_BYTES = 20, ARC_BYTES = 90, LEAST_BYTES = 160 };
static const double PER_M = 1e12; /* as written: 1 pm */
static const double SAME_RAD = 1e-9;

typedef struct entry {
    uint64_t hash;
    int shape;
} entry;

typedef struct form { /* one segment, from the outline's first point */
    int64_t x, y, radius, cx, cy;
    double sweep;
} form;

static form form_of(const fw_geometry_contour *c, int i, fw_geometry_vec2 upper_left) {
    const fw_geometry_segment *s = &c->segment[i], *first = c->segment;
    int64_t x0 = llround((first->a.x - upper_left.x) * PER_M);
    int64_t y0 = llround((upper_left.y - first->a.y) * PER_M);
    form f = {.x = llround((s->b.x - upper_left.x) * PER_M) - x0,
              .y = llround((upper_left.y - s->b.y) * PER_M) - y0};
    if (s->kind != FW_ARC) return f;
    f.radius = llround(s->radius * PER_M);
    f.cx = llround((s->centre.x - first->a.x) * PER_M);
    f.cy = llround((s->centre.y - first->a.y) * PER_M);
    f.sweep = s->sweep_rad;
    return f;
}

/* of the number of segments and of some of them: what is equal is compared as a whole */
static uint64_t hash_of(const fw_mask_shape *s, fw_geometry_vec2 upper_left) {
    int step = s->contour.count / SAMPLES + 1;
    uint64_t h = 1469598103934665603u ^ (uint64_t)s->contour.count; /* Fowler, Noll and Vo */
    for (int i = 0; i < s->contour.count; i += step) {
        form f = form_of(&s->contour, i, upper_left);
        const int64_t part[] = {f.x, f.y, f.radius};
        for (size_t k = 0; k < sizeof part / sizeof part[0]; k++)
            h = (h ^ (uint64_t)part[k]) * 1099511628211u;
    }
    return h;
}

/* Written ends the same, and arcs the same but for 2 pm of their centres. */
static bool same_form(const fw_geometry_contour *p, const fw_geometry_contour *q,
                      fw_geometry_vec2 upper_left) {
    if (p->count != q->count) return false;
    for (int i = 0; i < p->count; i++) {
        form a = form_of(p, i, upper_left), b = form_of(q, i, upper_left);
        if (a.x != b.x || a.y != b.y || a.radius != b.radius || llabs(a.cx - b.cx) > 2 ||
            llabs(a.cy - b.cy) > 2 || !(fabs(a.sweep - b.sweep) <= SAME_RAD))
            return false;
    }
    return true;
}

static bool pays(const fw_geometry_contour *c) {
    int bytes = 0;
    for (int i = 0; i < c->count && bytes < LEAST_BYTES; i++)
        bytes += c->segment[i].kind == FW_ARC ? ARC_BYTES : LINE_BYTES;
    return bytes >= LEAST_BYTES;
}

static int by_hash(const void *left, const void *right) {
    const entry *a = left, *b = right;
    int order = (a->hash > b->hash) - (a->hash < b->hash); /* of 64 bits without a sign */
    return order ? order : fw_order_wholes(a->shape, b->shape);
}

/* For every shape of a layer the first one that it repeats: itself where others repeat it, -1 where
   none does. In: outlines (m), as they are rounded in the file (1 pm). Out: of (nshape). Cost: O(n
   log n) hashes, then each against the first of its hash. Test: test_svg_repeat.c. */
static fw_status repeats_of(fw_arena *arena, const fw_mask *mask, int layer,
                            fw_geometry_vec2 upper_left, int **out) {
    int n = 0, *of = fw_arena_array(arena, int, (size_t)mask->nshape);
    entry *list = fw_arena_array(arena, entry, (size_t)mask->nshape);
    FW_NEED(of);
    FW_NEED(list);
    for (int i = 0; i < mask->nshape; i++) {
        of[i] = -1;
        if (mask->shape[i].layer == layer && pays(&mask->shape[i].contour))
            list[n++] = (entry){hash_of(&mask->shape[i], upper_left), i};
    }
    qsort(list, (size_t)n, sizeof *list, by_hash);
    for (int i = 0, first = 0; i < n; i++) {
        if (list[i].hash != list[first].hash) first = i;
        const fw_geometry_contour *p = &mask->shape[list[first].shape].contour;
        if (i == first || !same_form(p, &mask->shape[list[i].shape].contour, upper_left)) continue;
        of[list[first].shape] = of[list[i].shape] = list[first].shape;
    }
    *out = of;
    return FW_OK;
}

/* Exact outlines with true arcs: 1 user unit = 1 um, six decimals (1 pm). What is around them comes
   from the canvas (base/svg.h); the outlines themselves, of which there may be millions, have their
   own tight loop and only share the parts of arcs with other pictures (geometry/contour.h). */

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

/* the outlines of one layer as <path>s, um, y downwards from `upper_left` (m); one that is another
   one moved as a <use> of it */
static void paths(const fw_mask *mask, int layer, fw_geometry_vec2 upper_left, fw_text *out) {
    page p = {.out = out, .x0 = upper_left.x, .y1 = upper_left.y};
    int *of;
    if (repeats_of(out->arena, mask, layer, upper_left, &of) != FW_OK) {
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
    paths(mask, k, (fw_geometry_vec2){p->x0, p->y1}, p->out);
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
    enum { HEAD = 4096, SHAPE = 100, LINE = 20, ARC = 90, LEAST_SAMPLED = 32 };
    size_t n = HEAD;
    for (int k = 0; k < mask->nshape; k++) {
        const fw_geometry_contour *c = &mask->shape[k].contour;
        int step = c->count / LEAST_SAMPLED + 1;
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

/* ---- the plate as exact outlines: every cell once in <defs>, with true arcs, and <use> for each
   place. 1 user unit = 1 um, y downwards, the plate's upper left corner is the origin. A <g> is
   used and not a <symbol>, which some importers clip at its own box. ---- */

/* layers in the order of the table; ids stay those of the table in the top cell only. The mask goes
   by the name of its cell here: steps of a sweep have the same name of their own, and ids of a
   document must differ */
static void plate_layers(const fw_mask_plate *plate, const fw_mask *of, const char *name,
                         fw_geometry_vec2 upper_left, bool top, fw_text *out) {
    fw_mask named = *of;
    const fw_mask *mask = &named;
    named.cell = name;
    for (int k = 0; k < plate->table->nlayer; k++) {
        const fw_mask_layer *y = &plate->table->layer[k];
        bool any = false;
        for (int i = 0; i < mask->nshape && !any; i++)
            any = mask->shape[i].layer == k;
        if (!any) continue;
        if (top)
            fw_svg_open(out, "g id='{r}' data-gds='{i}/{i}' fill='{r}' fill-opacity='0.8'\n", y->id,
                        y->layer, y->datatype, y->colour);
        else
            fw_svg_open(out, "g data-gds='{i}/{i}' fill='{r}' fill-opacity='0.8'\n", y->layer,
                        y->datatype, y->colour);
        paths(mask, k, upper_left, out);
        fw_svg_close(out, "g\n");
    }
}

static void plate_head(const fw_mask_plate *plate, fw_text *out) {
    double size = plate->edge_m * 1e6;
    fw_svg_begin(out, &(fw_svg_frame){.width = size,
                                      .height = size,
                                      .decimals = 6,
                                      .size = FW_SVG_SIZE_BEFORE,
                                      .unit_mm = 1e-3,
                                      .mm_decimals = 9,
                                      .file = true,
                                      .links = true,
                                      .lead = "version='1.1'"});
    fw_svg_title(out, "{r}{s}, {s}, whole plate", plate->rejected ? "REJECTED: " : "", plate->title,
                 plate->flow);
    fw_svg_put(out, "desc>1 unit = 1 um; {s}; flexwright " FW_VERSION "\n", plate->table->reading);
}

static void use(const fw_mask_plate *plate, const fw_mask_plate_place *at, double half_um,
                fw_text *out) {
    for (int j = 0; j < at->rows; j++)
        for (int i = 0; i < at->columns; i++)
            fw_svg_put(out, "use xlink:href='#{r}' x='{3}' y='{3}'\n", plate->cell[at->cell].name,
                       half_um + 1e-3 * (at->x + i * at->step_x),
                       half_um - 1e-3 * (at->y + j * at->step_y));
}

static size_t plate_bytes(const fw_mask_plate *plate) {
    size_t n = 16384;
    for (int i = 0; i < plate->nplace; i++)
        n += 96 * (size_t)plate->place[i].columns * (size_t)plate->place[i].rows;
    for (int c = 0; c < plate->ncell; c++) {
        for (int i = 0; i < plate->cell[c].mask->nshape; i++)
            n += 100 + 90 * (size_t)plate->cell[c].mask->shape[i].contour.count;
    }
    return n;
}

fw_status fw_mask_plate_svg(const fw_mask_plate *plate, fw_text *out) {
    double half_um = 0.5 * plate->edge_m * 1e6;
    fw_text_reserve(out, plate_bytes(plate));
    plate_head(plate, out);
    fw_svg_open(out, "defs\n");
    for (int c = 0; c < plate->ncell; c++) {
        fw_svg_open(out, "g id='{r}'\n", plate->cell[c].name);
        plate_layers(plate, plate->cell[c].mask, plate->cell[c].name, (fw_geometry_vec2){0, 0},
                     false, out);
        fw_svg_close(out, "g\n");
    }
    fw_svg_close(out, "defs\n");
    if (plate->drawn)
        plate_layers(plate, plate->drawn, plate->top,
                     (fw_geometry_vec2){-0.5 * plate->edge_m, 0.5 * plate->edge_m}, true, out);
    for (int i = 0; i < plate->nplace; i++)
        use(plate, &plate->place[i], half_um, out);
    if (plate->rejected)
        fw_svg_put(out, "text id='rejected' x='50%' y='50%' text-anchor='middle' "
                        "font-family='sans-serif' font-size='15000' fill='#c00000' "
                        "fill-opacity='0.6'>REJECTED\n");
    fw_svg_end(out);
    return fw_text_end(out);
}
