/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DXF of release 12 (AC1009): closed POLYLINEs whose arcs are arcs, from the exact outlines. 1
   drawing unit = 1 um. R12, because every importer since 1992 reads it and it needs no object
   handles. No TEXT entities: some mask shops expose them. What the mask is stands in comments
   (group 999), after the first group, where readers that look at it to recognise the format are not
   disturbed.

   Source: AutoCAD Release 12 Customization Manual, chapter 11 (groups and entities). */
#include "geometry/segment.h"
#include "mask/mask_writers.h"
#include <stdlib.h>
#include <string.h>

enum { UM = 13 /* microns, of $INSUNITS */, NAME_MOST = 31, COLOURS = 9 };

static void group(fw_text *out, int code, const char *value) {
    fw_text_printf(out, "%d\n%s\n", code, value);
}

static void whole(fw_text *out, int code, int value) {
    fw_text_printf(out, "%d\n%d\n", code, value);
}

static void real(fw_text *out, int code, double value, int decimals) {
    fw_text_printf(out, "%d\n", code);
    fw_text_fixed(out, value, decimals);
    fw_text_add(out, "\n");
}

static void section(fw_text *out, const char *name) {
    group(out, 0, "SECTION");
    group(out, 2, name);
}

/* upper case letters, digits, $ _ -, at most 31 characters: names of R12 */
const char *fw_mask_dxf_layer(fw_arena *arena, const fw_mask *mask, int k) {
    char *name = fw_arena_printf(arena, "%s%s", mask->rejected ? "REJECTED_" : "",
                                 mask->table->layer[k].name);
    for (char *s = name; s && *s; s++) {
        if (*s >= 'a' && *s <= 'z') *s = (char)(*s - 'a' + 'A');
        if (!strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789$_-", *s)) *s = '_';
        if (s - name == NAME_MOST) *s-- = '\0';
    }
    return name;
}

/* R12 knows numbered colours only: the nearest of the first nine that is still free */
static int colour_number(const char *rgb, bool *taken) {
    static const unsigned table[COLOURS] = {0xff0000, 0xffff00, 0x00ff00, 0x00ffff, 0x0000ff,
                                            0xff00ff, 0x000000, 0x808080, 0xc0c0c0};
    long want = strtol(rgb + 1, NULL, 16), least = 1 << 30;
    int best = -1;
    for (int i = 0; i < COLOURS; i++) {
        long distance = 0;
        for (int shift = 0; shift < 24; shift += 8) {
            long d = (want >> shift & 255) - (long)(table[i] >> shift & 255);
            distance += d * d;
        }
        if (taken[i] || distance >= least) continue;
        least = distance;
        best = i;
    }
    if (best < 0) return COLOURS;
    taken[best] = true;
    return best + 1;
}

static fw_status head(const fw_mask *mask, fw_text *out) {
    const char **line;
    int n;
    FW_TRY(fw_mask_notes(out->arena, mask, &line, &n));
    section(out, "HEADER");
    group(out, 999, "1 drawing unit = 1 um; arcs are exact (bulges); notes follow");
    for (int i = 0; i < n; i++)
        fw_text_printf(out, "999\n%.250s\n", line[i]); /* lines have at most 256 characters */
    group(out, 9, "$ACADVER");
    group(out, 1, "AC1009");
    group(out, 9, "$INSUNITS");
    whole(out, 70, UM);
    group(out, 9, "$EXTMIN");
    real(out, 10, mask->box.x0 * 1e6, 6);
    real(out, 20, mask->box.y0 * 1e6, 6);
    group(out, 9, "$EXTMAX");
    real(out, 10, mask->box.x1 * 1e6, 6);
    real(out, 20, mask->box.y1 * 1e6, 6);
    group(out, 0, "ENDSEC");
    return FW_OK;
}

static void tables(const fw_mask *mask, const char **name, fw_text *out) {
    bool taken[COLOURS] = {false};
    section(out, "TABLES");
    group(out, 0, "TABLE");
    group(out, 2, "LTYPE");
    whole(out, 70, 1);
    group(out, 0, "LTYPE");
    group(out, 2, "CONTINUOUS");
    whole(out, 70, 0);
    group(out, 3, "Solid line");
    whole(out, 72, 65);
    whole(out, 73, 0);
    real(out, 40, 0, 1);
    group(out, 0, "ENDTAB");
    group(out, 0, "TABLE");
    group(out, 2, "LAYER");
    whole(out, 70, mask->table->nlayer);
    for (int k = 0; k < mask->table->nlayer; k++) {
        if (!mask->table->layer[k].roles) continue;
        group(out, 0, "LAYER");
        group(out, 2, name[k]);
        whole(out, 70, 0);
        whole(out, 62, colour_number(mask->table->layer[k].colour, taken));
        group(out, 6, "CONTINUOUS");
    }
    group(out, 0, "ENDTAB");
    group(out, 0, "ENDSEC");
}

static void vertex(const char *layer, fw_geometry_vec2 at, double bulge, fw_text *out) {
    group(out, 0, "VERTEX");
    group(out, 8, layer);
    real(out, 10, at.x * 1e6, 6);
    real(out, 20, at.y * 1e6, 6);
    if (bulge != 0) real(out, 42, bulge, 12);
}

/* A segment as vertices with bulge = tan(sweep / 4), > 0 counter-clockwise; arcs in parts of at
   most a third of a turn, so that also a whole circle has three vertices. In: m. Out: um to 1e-9,
   bulge to 1e-15: the reader's arc stays within 1e-9 um of ours, its radius within 1e-9 of itself
   for sweeps above 0.1 rad. Source: DXF reference, group 42. Test: test_dxf.c. */
static void segment(const char *layer, const fw_geometry_segment *s, fw_text *out) {
    if (s->kind == FW_LINE) {
        vertex(layer, s->a, 0, out);
        return;
    }
    int parts = (int)ceil(fabs(s->sweep_rad) / (FW_TURN / 3) - 1e-9);
    for (int i = 0; i < parts; i++) {
        fw_geometry_vec2 r =
            fw_geometry_vec_rotate(vec_sub(s->a, s->centre), s->sweep_rad * i / parts);
        vertex(layer, i ? vec_add(s->centre, r) : s->a, tan(s->sweep_rad / parts / 4), out);
    }
}

static void outline(const char *layer, const fw_geometry_contour *c, fw_text *out) {
    group(out, 0, "POLYLINE");
    group(out, 8, layer);
    whole(out, 66, 1); /* vertices follow */
    whole(out, 70, 1); /* closed */
    real(out, 10, 0, 1);
    real(out, 20, 0, 1);
    real(out, 30, 0, 1);
    for (int i = 0; i < c->count; i++)
        segment(layer, &c->segment[i], out);
    group(out, 0, "SEQEND");
    group(out, 8, layer);
}

fw_status fw_mask_write_dxf(const fw_mask *mask, fw_text *out) {
    const char **name = fw_arena_array(out->arena, const char *, (size_t)mask->table->nlayer);
    FW_NEED(name);
    for (int k = 0; k < mask->table->nlayer; k++)
        FW_NEED(name[k] = fw_mask_dxf_layer(out->arena, mask, k));
    FW_TRY(head(mask, out));
    tables(mask, name, out);
    section(out, "BLOCKS");
    group(out, 0, "ENDSEC");
    section(out, "ENTITIES");
    for (int i = 0; i < mask->nshape; i++)
        outline(name[mask->shape[i].layer], &mask->shape[i].contour, out);
    group(out, 0, "ENDSEC");
    group(out, 0, "EOF");
    return fw_text_end(out);
}
