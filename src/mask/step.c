/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ISO 10303-21 (STEP), schema AP214: the solid that the outlines of the biased layers stand for, drawn up from z = 0 to
   the device's thickness as an exact boundary: lines become planes, arcs cylinders. 1 unit = 1 mm.

   Pieces that share a JOINT are one solid: at its end an outline goes on behind its partner, so that what is left are the
   outlines of the union, bit for bit, without any boolean. Outlines that run clockwise are holes of the least outline
   around them. Each of the others is a MANIFOLD_SOLID_BREP with one CLOSED_SHELL. Arcs of more than half a turn are two
   or three edges, so that no face has a seam. Error: none but that of numbers written with 16 digits. Cost: n log n in
   the segments, holes times outlines for what lies in what. Sources: ISO 10303-21:2002, ISO 10303-42 (geometry), Pratt, J. Comput. Inf.
   Sci. Eng. 1 (2001) 102. Test: tests/accept/step.py, which has Open CASCADE read it and measure it; test_mask_solid.c */
#include "base/constants.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double UNKNOWN_M = 1e-6; /* where nobody said how thick the device is */
static const double MM = 1e3;

typedef struct part { /* a segment of a shape, in the order of shapes */
    const fw_geometry_segment *s;
    int shape, next; /* next: of the same shape */
    int partner;     /* of a JOINT; else -1 */
    bool used;
} part;

typedef struct loop {             /* of the union */
    fw_geometry_segment *segment; /* (n) each at most half a turn */
    int n;
    double area_m2; /* < 0: a hole */
    int outer;      /* of a hole: index of the loop that it lies in */
    const char *label;
} loop;

typedef struct writer {
    fw_text *out;
    long id; /* of the last entity */
    double top_mm;
    long along, up, down; /* directions x, z, -z, */
    long rise;            /* and the vector along z */
} writer;

/* ---- outlines of the union ---- */

typedef struct end_pair { /* of a JOINT, its lesser end first */
    fw_geometry_vec2 low, high;
    int layer, part;
} end_pair;

static int by_ends(const void *left, const void *right) {
    const end_pair *p = left, *q = right;
    const double a[4] = {p->low.x, p->low.y, p->high.x, p->high.y};
    const double b[4] = {q->low.x, q->low.y, q->high.x, q->high.y};
    int order = fw_order_wholes(p->layer, q->layer);
    for (int i = 0; i < 4 && !order; i++)
        order = fw_order_doubles(a[i], b[i]);
    return order;
}

static fw_status find_partners(fw_arena *arena, const fw_mask *mask, part *list, int n) {
    end_pair *pair = fw_arena_array(arena, end_pair, (size_t)n + 1);
    size_t count = 0;
    FW_NEED(pair);
    for (int i = 0; i < n; i++) {
        const fw_geometry_segment *s = list[i].s;
        if (!(s->flags & FW_SEGMENT_JOINT)) continue;
        bool forth = vec_before(s->a, s->b);
        pair[count++] = (end_pair){forth ? s->a : s->b, forth ? s->b : s->a,
                                   mask->shape[list[i].shape].layer, i};
    }
    if (count > 0) qsort(pair, count, sizeof *pair, by_ends);
    for (size_t i = 1; i < count; i++) {
        if (by_ends(&pair[i - 1], &pair[i]) != 0) continue;
        list[pair[i - 1].part].partner = pair[i].part;
        list[pair[i].part].partner = pair[i - 1].part;
        i++; /* each has one */
    }
    return FW_OK;
}

/* segments of all shapes of biased layers */
static fw_status list_parts(fw_arena *arena, const fw_mask *mask, part **out, int *count) {
    int n = 0;
    for (int i = 0; i < mask->nshape; i++)
        n += mask->shape[i].contour.count;
    part *list = fw_arena_array(arena, part, (size_t)n + 1);
    FW_NEED(list);
    *out = list;
    *count = 0;
    for (int i = 0; i < mask->nshape; i++) {
        const fw_geometry_contour *c = &mask->shape[i].contour;
        if (!mask->table->layer[mask->shape[i].layer].biased) continue;
        int first = *count;
        for (int k = 0; k < c->count; k++)
            list[(*count)++] = (part){.s = &c->segment[k],
                                      .shape = i,
                                      .next = first + (k + 1 < c->count ? k + 1 : 0),
                                      .partner = -1};
    }
    return find_partners(arena, mask, list, *count);
}

/* a segment as edges of at most half a turn; the middles of an arc lie on its circle */
static int divide(const fw_geometry_segment *s, fw_geometry_segment out[3]) {
    int parts = s->kind == FW_ARC ? 1 + (int)floor(fabs(s->sweep_rad) / (FW_PI * (1 + 1e-9))) : 1;
    if (parts == 2 && fabs(s->sweep_rad) > 1.5 * FW_PI) parts = 3;
    double start = s->kind == FW_ARC ? atan2(s->a.y - s->centre.y, s->a.x - s->centre.x) : 0;
    fw_geometry_vec2 at = s->a;
    for (int i = 0; i < parts; i++) {
        double turn = start + s->sweep_rad * (i + 1) / parts;
        out[i] = *s;
        out[i].a = at;
        out[i].sweep_rad = s->sweep_rad / parts;
        if (i + 1 < parts)
            out[i].b = (fw_geometry_vec2){s->centre.x + s->radius * cos(turn),
                                          s->centre.y + s->radius * sin(turn)};
        at = out[i].b;
    }
    return parts;
}

/* the loop from an unused part on */
static fw_status follow(fw_arena *arena, const fw_mask *mask, part *list, int n, int from,
                        loop *out) {
    int steps = 0, at = from;
    fw_geometry_segment *s = NULL;
    size_t room = 0, count = 0;
    do {
        if (count + 3 > room) {
            size_t more = room ? 2 * room : 64;
            FW_NEED(s = fw_arena_grow(arena, s, count, more, sizeof *s));
            room = more;
        }
        list[at].used = true;
        count += (size_t)divide(list[at].s, s + count);
        at = list[at].next;
        while (list[at].partner >= 0 && steps++ < 2 * n)
            at = list[list[at].partner].next;
        if (steps++ > 4 * n) return FW_INTERNAL;
    } while (at != from);
    fw_geometry_contour c = {s, (int)count};
    *out = (loop){.segment = s,
                  .n = (int)count,
                  .area_m2 = fw_geometry_contour_area(&c),
                  .outer = -1,
                  .label = mask->shape[list[from].shape].piece->label};
    return FW_OK;
}

static bool holds(const loop *around, const loop *hole) {
    fw_geometry_contour c = {around->segment, around->n};
    return around->area_m2 > -hole->area_m2 &&
           fw_geometry_contour_contains(&c, fw_geometry_segment_point(&hole->segment[0], 0.5));
}

static fw_status loops_of(fw_arena *arena, const fw_mask *mask, loop **out, int *count) {
    part *list;
    int n;
    FW_TRY(list_parts(arena, mask, &list, &n));
    loop *loops = fw_arena_array(arena, loop, (size_t)n + 1);
    FW_NEED(loops);
    *count = 0;
    for (int i = 0; i < n; i++)
        if (!list[i].used && list[i].partner < 0)
            FW_TRY(follow(arena, mask, list, n, i, &loops[(*count)++]));
    for (int i = 0; i < *count; i++)
        for (int k = 0; k < *count && loops[i].area_m2 < 0; k++) {
            bool less = loops[i].outer < 0 || loops[k].area_m2 < loops[loops[i].outer].area_m2;
            if (loops[k].area_m2 > 0 && less && holds(&loops[k], &loops[i])) loops[i].outer = k;
        }
    *out = loops;
    return FW_OK;
}

/* ---- entities ---- */

static long begin(writer *w, const char *kind) {
    fw_text_printf(w->out, "#%ld=%s", ++w->id, kind);
    return w->id;
}

/* 16 digits; a number of Part 21 has a point, and its exponent an E */
static void real(writer *w, double value) {
    char number[40];
    fw_number_text(number, sizeof number, value == 0 ? 0.0 : value, 16); /* no -0 */
    size_t n = strcspn(number, "e");
    fw_text_printf(w->out, "%.*s%s", (int)n, number, strchr(number, '.') ? "" : ".");
    if (number[n]) fw_text_printf(w->out, "E%s", number + n + 1);
}

static long triple(writer *w, const char *kind, double x, double y, double z) {
    long id = begin(w, kind);
    fw_text_add(w->out, "('',(");
    real(w, x);
    fw_text_add(w->out, ",");
    real(w, y);
    fw_text_add(w->out, ",");
    real(w, z);
    fw_text_add(w->out, "));\n");
    return id;
}

static long point(writer *w, fw_geometry_vec2 p, double z_mm) {
    return triple(w, "CARTESIAN_POINT", MM * p.x, MM * p.y, z_mm);
}

/* a text of Part 21: ASCII, with the quote and the backslash doubled */
static void quoted(writer *w, const char *text) {
    fw_text_add(w->out, "'");
    for (const char *s = text; *s; s++) {
        char c = *s >= ' ' && *s <= '~' ? *s : '?';
        fw_text_printf(w->out, c == '\'' || c == '\\' ? "%c%c" : "%c", c, c);
    }
    fw_text_add(w->out, "'");
}

/* at a point, with the ids of its axis and of its first direction */
static long placement(writer *w, fw_geometry_vec2 o, double z_mm, long axis, long first) {
    long at = point(w, o, z_mm), id = begin(w, "AXIS2_PLACEMENT_3D");
    fw_text_printf(w->out, "('',#%ld,#%ld,#%ld);\n", at, axis, first);
    return id;
}

static long round_one(writer *w, const char *kind, long at, double radius_m) {
    long id = begin(w, kind);
    fw_text_printf(w->out, "('',#%ld,", at);
    real(w, MM * radius_m);
    fw_text_add(w->out, ");\n");
    return id;
}

static long vector(writer *w, long direction) {
    long id = begin(w, "VECTOR");
    fw_text_printf(w->out, "('',#%ld,1.);\n", direction);
    return id;
}

static long line(writer *w, long from, long along) {
    long id = begin(w, "LINE");
    fw_text_printf(w->out, "('',#%ld,#%ld);\n", from, along);
    return id;
}

static long edge(writer *w, long from, long to, long curve, bool forth) {
    long id = begin(w, "EDGE_CURVE");
    fw_text_printf(w->out, "('',#%ld,#%ld,#%ld,.%c.);\n", from, to, curve, forth ? 'T' : 'F');
    return id;
}

static long use(writer *w, long of, bool forth) {
    long id = begin(w, "ORIENTED_EDGE");
    fw_text_printf(w->out, "('',*,*,#%ld,.%c.);\n", of, forth ? 'T' : 'F');
    return id;
}

/* ("name", (#1,#2,...)) */
static long listed(writer *w, const char *kind, const long *item, int n) {
    long id = begin(w, kind);
    fw_text_add(w->out, "('',(");
    for (int i = 0; i < n; i++)
        fw_text_printf(w->out, "%s#%ld", i ? "," : "", item[i]);
    fw_text_add(w->out, "));\n");
    return id;
}

static long bound(writer *w, const long *oriented, int n, bool outer) {
    long of = listed(w, "EDGE_LOOP", oriented, n);
    long id = begin(w, outer ? "FACE_OUTER_BOUND" : "FACE_BOUND");
    fw_text_printf(w->out, "('',#%ld,.T.);\n", of);
    return id;
}

static long face(writer *w, const long *bounds, int n, long surface, bool same) {
    long id = begin(w, "ADVANCED_FACE");
    fw_text_add(w->out, "('',(");
    for (int i = 0; i < n; i++)
        fw_text_printf(w->out, "%s#%ld", i ? "," : "", bounds[i]);
    fw_text_printf(w->out, "),#%ld,.%c.);\n", surface, same ? 'T' : 'F');
    return id;
}

static long plane(writer *w, long at) {
    long id = begin(w, "PLANE");
    fw_text_printf(w->out, "('',#%ld);\n", at);
    return id;
}

/* ---- one loop, drawn up ---- */

typedef struct wall {      /* (n) of a loop: at the start of each segment, and along it */
    long *low, *high, *up; /* vertices below and above; the edge between them */
    long *below, *above;   /* edges along the segment */
} wall;

static long curve_of(writer *w, const fw_geometry_segment *s, long from, double z_mm) {
    fw_geometry_vec2 d = vec_unit(vec_sub(s->b, s->a));
    if (s->kind == FW_ARC)
        return round_one(w, "CIRCLE", placement(w, s->centre, z_mm, w->up, w->along), s->radius);
    return line(w, from, vector(w, triple(w, "DIRECTION", d.x, d.y, 0)));
}

static fw_status draw_edges(writer *w, const loop *l, wall *out) {
    fw_arena *arena = w->out->arena;
    long *all = fw_arena_array(arena, long, 7 * (size_t)l->n);
    FW_NEED(all);
    *out = (wall){all, all + l->n, all + 2 * l->n, all + 3 * l->n, all + 4 * l->n};
    long *low = all + 5 * l->n, *high = all + 6 * l->n; /* points */
    for (int i = 0; i < l->n; i++) {
        low[i] = point(w, l->segment[i].a, 0);
        high[i] = point(w, l->segment[i].a, w->top_mm);
        out->low[i] = begin(w, "VERTEX_POINT");
        fw_text_printf(w->out, "('',#%ld);\n", low[i]);
        out->high[i] = begin(w, "VERTEX_POINT");
        fw_text_printf(w->out, "('',#%ld);\n", high[i]);
        out->up[i] = edge(w, out->low[i], out->high[i], line(w, low[i], w->rise), true);
    }
    for (int i = 0; i < l->n; i++) {
        const fw_geometry_segment *s = &l->segment[i];
        int next = i + 1 < l->n ? i + 1 : 0;
        bool forth = s->kind != FW_ARC || s->sweep_rad > 0;
        out->below[i] = edge(w, out->low[i], out->low[next], curve_of(w, s, low[i], 0), forth);
        out->above[i] =
            edge(w, out->high[i], out->high[next], curve_of(w, s, high[i], w->top_mm), forth);
    }
    return FW_OK;
}

/* looks to the right of d */
static long wall_plane(writer *w, fw_geometry_vec2 at, fw_geometry_vec2 d) {
    long right = triple(w, "DIRECTION", d.y, -d.x, 0), own = triple(w, "DIRECTION", d.x, d.y, 0);
    return plane(w, placement(w, at, 0, right, own));
}

/* Material lies on the left of a segment: its face looks to the right. */
static long side_face(writer *w, const loop *l, const wall *of, int i) {
    const fw_geometry_segment *s = &l->segment[i];
    fw_geometry_vec2 d = vec_unit(vec_sub(s->b, s->a));
    int next = i + 1 < l->n ? i + 1 : 0;
    bool arc = s->kind == FW_ARC;
    long oriented[4] = {use(w, of->below[i], true), use(w, of->up[next], true),
                        use(w, of->above[i], false), use(w, of->up[i], false)};
    long around = bound(w, oriented, 4, true);
    long surface = arc ? round_one(w, "CYLINDRICAL_SURFACE",
                                   placement(w, s->centre, 0, w->up, w->along), s->radius)
                       : wall_plane(w, s->a, d);
    return face(w, &around, 1, surface, !arc || s->sweep_rad > 0);
}

/* of the bottom or the top */
static fw_status flat_bound(writer *w, const loop *l, const wall *of, bool top, long *id) {
    long *oriented = fw_arena_array(w->out->arena, long, (size_t)l->n);
    FW_NEED(oriented);
    for (int i = 0; i < l->n; i++)
        oriented[i] = use(w, top ? of->above[i] : of->below[l->n - 1 - i], top);
    *id = bound(w, oriented, l->n, l->area_m2 > 0);
    return FW_OK;
}

/* a loop and its holes */
static fw_status draw_solid(writer *w, const loop *list, int n, int outer, long *id) {
    fw_arena *arena = w->out->arena;
    size_t faces = 2, holes = 0;
    for (int k = 0; k < n; k++)
        if (k == outer || list[k].outer == outer) faces += (size_t)list[k].n, holes++;
    long *own = fw_arena_array(arena, long, faces), *low = fw_arena_array(arena, long, holes),
         *high = fw_arena_array(arena, long, holes);
    FW_NEED(own && low && high ? own : NULL);
    int nface = 0, nbound = 0;
    for (int pass = 0; pass < 2; pass++) /* the outer one first */
        for (int k = 0; k < n; k++) {
            wall of;
            if (pass == 0 ? k != outer : list[k].outer != outer) continue;
            FW_TRY(draw_edges(w, &list[k], &of));
            for (int i = 0; i < list[k].n; i++)
                own[nface++] = side_face(w, &list[k], &of, i);
            FW_TRY(flat_bound(w, &list[k], &of, false, &low[nbound]));
            FW_TRY(flat_bound(w, &list[k], &of, true, &high[nbound]));
            nbound++;
        }
    const fw_geometry_vec2 o = {0, 0};
    own[nface++] = face(w, low, nbound, plane(w, placement(w, o, 0, w->down, w->along)), true);
    own[nface++] =
        face(w, high, nbound, plane(w, placement(w, o, w->top_mm, w->up, w->along)), true);
    long shell = listed(w, "CLOSED_SHELL", own, nface);
    *id = begin(w, "MANIFOLD_SOLID_BREP");
    fw_text_add(w->out, "(");
    quoted(w, list[outer].label);
    fw_text_printf(w->out, ",#%ld);\n", shell);
    return FW_OK;
}

/* ---- the file ---- */

static void write_head(fw_text *out, const fw_mask *mask) {
    fw_text_printf(
        out,
        "ISO-10303-21;\nHEADER;\n"
        "FILE_DESCRIPTION(('%sexact outlines of the mask drawn up to the thickness; %s; 1 unit = 1 "
        "mm'),'2;1');\n"
        "FILE_NAME('%s','1970-01-01T00:00:00',(''),(''),'FLEXWRIGHT " FW_VERSION
        "','FLEXWRIGHT " FW_VERSION "','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n",
        mask->rejected ? "REJECTED; " : "",
        mask->thickness_m > 0 ? "walls vertical" : "THICKNESS NOT KNOWN", mask->cell);
}

/* what every file says of its one product and its units; ids from 1 */
static void write_product(writer *w, const fw_mask *mask) {
    static const char *const rows[] = {
        "APPLICATION_CONTEXT('automotive design');",
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1);",
        "PRODUCT_CONTEXT('',#1,'mechanical');",
        "PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        begin(w, rows[i]);
        fw_text_add(w->out, "\n");
    }
    begin(w, "PRODUCT");
    fw_text_printf(w->out, "('%s','%s','',(#3));\n", mask->cell, mask->cell);
    fw_text_add(w->out,
                "#6=PRODUCT_DEFINITION_FORMATION('','',#5);\n"
                "#7=PRODUCT_DEFINITION('design','',#6,#4);\n"
                "#8=PRODUCT_DEFINITION_SHAPE('','',#7);\n"
                "#9=PRODUCT_RELATED_PRODUCT_CATEGORY('part','',(#5));\n"
                "#10=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                "#11=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
                "#12=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
                "#13=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),#10,'distance_accuracy_"
                "value','');\n"
                "#14=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#13))"
                "GLOBAL_UNIT_ASSIGNED_CONTEXT((#10,#11,#12))REPRESENTATION_CONTEXT('',''));\n");
    w->id = 14;
}

fw_status fw_mask_write_step(const fw_mask *mask, fw_text *out) {
    writer w = {.out = out, .top_mm = MM * (mask->thickness_m > 0 ? mask->thickness_m : UNKNOWN_M)};
    loop *list;
    long *solid;
    int n, nsolid = 0;
    FW_TRY(loops_of(out->arena, mask, &list, &n));
    FW_NEED(solid = fw_arena_array(out->arena, long, (size_t)n + 1));
    write_head(out, mask);
    write_product(&w, mask);
    const fw_geometry_vec2 o = {0, 0};
    w.along = triple(&w, "DIRECTION", 1, 0, 0);
    w.up = triple(&w, "DIRECTION", 0, 0, 1);
    w.down = triple(&w, "DIRECTION", 0, 0, -1);
    w.rise = vector(&w, w.up);
    solid[nsolid++] = placement(&w, o, 0, w.up, w.along);
    for (int i = 0; i < n; i++)
        if (list[i].area_m2 > 0) FW_TRY(draw_solid(&w, list, n, i, &solid[nsolid++]));
    long shape = begin(&w, "ADVANCED_BREP_SHAPE_REPRESENTATION");
    fw_text_add(out, "('',(");
    for (int i = 0; i < nsolid; i++)
        fw_text_printf(out, "%s#%ld", i ? "," : "", solid[i]);
    fw_text_add(out, "),#14);\n");
    begin(&w, "SHAPE_DEFINITION_REPRESENTATION");
    fw_text_printf(out, "(#8,#%ld);\nENDSEC;\nEND-ISO-10303-21;\n", shape);
    return fw_text_end(out);
}
