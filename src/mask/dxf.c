/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DXF of release 12 (AC1009): closed POLYLINEs whose arcs are arcs, from the exact outlines. 1
   drawing unit = 1 um. R12, because every importer since 1992 reads it and it needs no object
   handles. No TEXT entities: some mask shops expose them. What the mask is stands in comments
   (group 999), after the first group, where readers that look at it to recognise the format are not
   disturbed.

   Source: AutoCAD Release 12 Customization Manual, chapter 11 (groups and entities). */
#include "geometry/segment.h"
#include "mask/mask_parts.h"
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
static const char *plain_name(fw_arena *arena, const char *before, const char *text) {
    char *name = fw_arena_printf(arena, "%s%s", before, text);
    for (char *s = name; s && *s; s++) {
        if (*s >= 'a' && *s <= 'z') *s = (char)(*s - 'a' + 'A');
        if (!strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789$_-", *s)) *s = '_';
        if (s - name == NAME_MOST) *s-- = '\0';
    }
    return name;
}

static const char *layer_name(fw_arena *arena, const fw_mask_table *table, bool rejected, int k) {
    return plain_name(arena, rejected ? "REJECTED_" : "", table->layer[k].name);
}

const char *fw_mask_dxf_layer(fw_arena *arena, const fw_mask *mask, int k) {
    return layer_name(arena, mask->table, mask->rejected, k);
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

static void head(const char *const *line, int n, fw_geometry_box box, fw_text *out) {
    section(out, "HEADER");
    group(out, 999, "1 drawing unit = 1 um; arcs are exact (bulges); notes follow");
    for (int i = 0; i < n; i++)
        fw_text_printf(out, "999\n%.250s\n", line[i]); /* lines have at most 256 characters */
    group(out, 9, "$ACADVER");
    group(out, 1, "AC1009");
    group(out, 9, "$INSUNITS");
    whole(out, 70, UM);
    group(out, 9, "$EXTMIN");
    real(out, 10, box.x0 * 1e6, 6);
    real(out, 20, box.y0 * 1e6, 6);
    group(out, 9, "$EXTMAX");
    real(out, 10, box.x1 * 1e6, 6);
    real(out, 20, box.y1 * 1e6, 6);
    group(out, 0, "ENDSEC");
}

/* What is written again and again for the shapes of a layer, composed once: most of a file. */
typedef struct pen {
    const char *name;              /* of the layer */
    const char *open, *at, *close; /* up to the first vertex; up to the x of one; behind the last */
    size_t nopen, nat, nclose;
} pen;

static fw_status pens_of(fw_arena *arena, const fw_mask_table *table, bool rejected, pen **out) {
    pen *p = fw_arena_array(arena, pen, (size_t)table->nlayer);
    FW_NEED(p);
    for (int k = 0; k < table->nlayer; k++) {
        FW_NEED(p[k].name = layer_name(arena, table, rejected, k));
        /* 66: vertices follow, 70: closed */
        FW_NEED(p[k].open = fw_arena_printf(
                    arena, "0\nPOLYLINE\n8\n%s\n66\n1\n70\n1\n10\n0\n20\n0\n30\n0\n", p[k].name));
        FW_NEED(p[k].at = fw_arena_printf(arena, "0\nVERTEX\n8\n%s\n10\n", p[k].name));
        FW_NEED(p[k].close = fw_arena_printf(arena, "0\nSEQEND\n8\n%s\n", p[k].name));
        p[k].nopen = strlen(p[k].open);
        p[k].nat = strlen(p[k].at);
        p[k].nclose = strlen(p[k].close);
    }
    *out = p;
    return FW_OK;
}

static void tables(const fw_mask_table *table, const pen *layer, fw_text *out) {
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
    whole(out, 70, table->nlayer);
    for (int k = 0; k < table->nlayer; k++) {
        if (!table->layer[k].roles) continue;
        group(out, 0, "LAYER");
        group(out, 2, layer[k].name);
        whole(out, 70, 0);
        whole(out, 62, colour_number(table->layer[k].colour, taken));
        group(out, 6, "CONTINUOUS");
    }
    group(out, 0, "ENDTAB");
    group(out, 0, "ENDSEC");
}

/* the place of a vertex, and behind it, where it begins an arc, the bulge: most of the file, hence
   without a format */
static void vertex(const pen *p, fw_geometry_vec2 at, double bulge, fw_text *out) {
    if (out->capacity - out->length < p->nat + 3 * FW_FIXED_BYTES + 16)
        fw_text_reserve(out, p->nat + 3 * FW_FIXED_BYTES + 16);
    if (out->failed) return;
    char *end = out->data + out->length;
    memcpy(end, p->at, p->nat);
    end = fw_millionths_text(end + p->nat, at.x * 1e6);
    memcpy(end, "\n20\n", 4);
    end = fw_millionths_text(end + 4, at.y * 1e6);
    *end++ = '\n';
    if (bulge != 0) {
        memcpy(end, "42\n", 3);
        end = fw_fixed_text(end + 3, bulge, 12);
        *end++ = '\n';
    }
    *end = '\0';
    out->length = (size_t)(end - out->data);
}

/* A segment as vertices with bulge = tan(sweep / 4), > 0 counter-clockwise; arcs in parts of at
   most a third of a turn, so that also a whole circle has three vertices. In: m. Out: um to 1e-9,
   bulge to 1e-15: the reader's arc stays within 1e-9 um of ours, its radius within 1e-9 of itself
   for sweeps above 0.1 rad. Source: DXF reference, group 42. Test: test_dxf.c. */
static void segment(const pen *p, const fw_geometry_segment *s, fw_text *out) {
    if (s->kind == FW_LINE) {
        vertex(p, s->a, 0, out);
        return;
    }
    int parts = (int)ceil(fabs(s->sweep_rad) / (FW_TURN / 3) - 1e-9);
    double bulge = tan(s->sweep_rad / parts / 4);
    vertex(p, s->a, bulge, out);
    for (int i = 1; i < parts; i++) {
        fw_geometry_vec2 r =
            fw_geometry_vec_rotate(vec_sub(s->a, s->centre), s->sweep_rad * i / parts);
        vertex(p, vec_add(s->centre, r), bulge, out);
    }
}

static void shapes(const fw_mask *mask, const pen *layer, fw_text *out) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_geometry_contour *c = &mask->shape[i].contour;
        const pen *p = &layer[mask->shape[i].layer];
        fw_text_bytes(out, p->open, p->nopen);
        for (int k = 0; k < c->count; k++)
            segment(p, &c->segment[k], out);
        fw_text_bytes(out, p->close, p->nclose);
    }
}

/* about what the shapes take, so that the text is not copied while it grows */
static size_t bytes_of(const fw_mask *mask) {
    enum { SHAPE = 100, SEGMENT = 60 };
    size_t n = 0;
    for (int i = 0; i < mask->nshape; i++)
        n += SHAPE + SEGMENT * (size_t)mask->shape[i].contour.count;
    return n;
}

enum { HEAD_BYTES = 16384 };

fw_status fw_mask_write_dxf(const fw_mask *mask, fw_text *out) {
    const char **line;
    int n;
    pen *layer;
    FW_TRY(fw_mask_notes(out->arena, mask, &line, &n));
    FW_TRY(pens_of(out->arena, mask->table, mask->rejected, &layer));
    fw_text_reserve(out, HEAD_BYTES + bytes_of(mask));
    head(line, n, mask->box, out);
    tables(mask->table, layer, out);
    section(out, "BLOCKS");
    group(out, 0, "ENDSEC");
    section(out, "ENTITIES");
    shapes(mask, layer, out);
    group(out, 0, "ENDSEC");
    group(out, 0, "EOF");
    return fw_text_end(out);
}

/* ---- the plate: a BLOCK for every different die, an INSERT with columns and rows for each of its
   arrays. No block within a block, none turned, scaled or mirrored. ---- */

/* names of R12 that no other block has; of each cell */
static fw_status block_names(fw_arena *arena, const fw_mask_plate *p, const char ***out) {
    const char **name = fw_arena_array(arena, const char *, (size_t)p->ncell);
    FW_NEED(name);
    for (int c = 0; c < p->ncell; c++) {
        FW_NEED(name[c] = plain_name(arena, "", p->cell[c].name));
        for (int i = 0, k = 2; i < c; i++) {
            if (strcmp(name[i], name[c]) != 0) continue;
            FW_NEED(name[c] = fw_arena_printf(arena, "%.24s_%d", name[c], k++));
            i = -1; /* against all of them again */
        }
    }
    *out = name;
    return FW_OK;
}

static void block(const char *name, const char *on, const fw_mask *mask, const pen *layer,
                  fw_text *out) {
    group(out, 0, "BLOCK");
    group(out, 8, on);
    group(out, 2, name);
    whole(out, 70, 0);
    for (int axis = 10; axis <= 30; axis += 10)
        real(out, axis, 0, 1);
    group(out, 3, name);
    shapes(mask, layer, out);
    group(out, 0, "ENDBLK");
    group(out, 8, on);
}

static void insert(const char *name, const char *on, const fw_mask_plate_place *at, fw_text *out) {
    group(out, 0, "INSERT");
    group(out, 8, on);
    group(out, 2, name);
    real(out, 10, at->x * 1e-3, 6);
    real(out, 20, at->y * 1e-3, 6);
    real(out, 30, 0, 1);
    if (at->columns == 1 && at->rows == 1) return;
    whole(out, 70, at->columns);
    whole(out, 71, at->rows);
    real(out, 44, at->step_x * 1e-3, 6);
    real(out, 45, at->step_y * 1e-3, 6);
}

fw_status fw_mask_plate_dxf(const fw_mask_plate *plate, fw_text *out) {
    const char **name;
    pen *layer;
    size_t bytes = HEAD_BYTES + 120 * (size_t)plate->nplace;
    FW_TRY(block_names(out->arena, plate, &name));
    FW_TRY(pens_of(out->arena, plate->table, plate->rejected, &layer));
    const char *on = "0"; /* a layer that is drawn: some shops take nothing on layer 0 */
    for (int k = plate->table->nlayer - 1; k >= 0; k--)
        if (plate->table->layer[k].roles) on = layer[k].name;
    for (int c = 0; c < plate->ncell; c++)
        bytes += bytes_of(plate->cell[c].mask);
    fw_text_reserve(out, bytes + (plate->drawn ? bytes_of(plate->drawn) : 0));
    double half = 0.5 * plate->edge_m;
    head(plate->note, plate->nnote, (fw_geometry_box){-half, -half, half, half}, out);
    tables(plate->table, layer, out);
    section(out, "BLOCKS");
    for (int c = 0; c < plate->ncell; c++)
        block(name[c], on, plate->cell[c].mask, layer, out);
    group(out, 0, "ENDSEC");
    section(out, "ENTITIES");
    if (plate->drawn) shapes(plate->drawn, layer, out);
    for (int i = 0; i < plate->nplace; i++)
        insert(name[plate->place[i].cell], on, &plate->place[i], out);
    group(out, 0, "ENDSEC");
    group(out, 0, "EOF");
    return fw_text_end(out);
}
