/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DXF and GDSII readers: areas against closed forms, what each refuses, and thousands of damaged
   files, none of which may do more than be refused. */
#include "drawing/drawing.h"
#include "test.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UM   1e-6
#define NONE ((double)NAN)
#define HEAD(unit)                                                                                 \
    "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n" unit "\n0\nENDSEC\n"
#define ENTITIES(all) "0\nSECTION\n2\nENTITIES\n" all "0\nENDSEC\n0\nEOF\n"
#define LIGHT(layer, flags, points)                                                                \
    "0\nLWPOLYLINE\n5\n2A\n8\n" layer "\n90\n4\n70\n" flags "\n43\n0.0\n" points
#define AT(x, y) "10\n" x "\n20\n" y "\n"
#define LINE(layer, x0, y0, x1, y1)                                                                \
    "0\nLINE\n8\n" layer "\n10\n" x0 "\n20\n" y0 "\n30\n0.0\n11\n" x1 "\n21\n" y1 "\n31\n0.0\n"
#define ARC(layer, x, y, r, from, to)                                                              \
    "0\nARC\n8\n" layer "\n10\n" x "\n20\n" y "\n40\n" r "\n50\n" from "\n51\n" to "\n"
#define CIRCLE(layer, x, y, r) "0\nCIRCLE\n8\n" layer "\n10\n" x "\n20\n" y "\n40\n" r "\n"

#define BLOCKS(content) "0\nSECTION\n2\nBLOCKS\n" content "0\nENDSEC\n"
#define BLOCK(name, x, y, content)                                                                 \
    "0\nBLOCK\n8\n0\n2\n" name "\n70\n0\n10\n" x "\n20\n" y "\n" content "0\nENDBLK\n8\n0\n"
#define INSERT(name, x, y, more) "0\nINSERT\n8\njaw\n2\n" name "\n10\n" x "\n20\n" y "\n" more

static fw_drawing_asked asked_for(const char *layer, const char *unit, double unit_m) {
    return (fw_drawing_asked){.file = "t.dxf",
                              .layer = layer,
                              .unit = unit,
                              .unit_m = unit_m,
                              .place = {"t.xml", 3, 7},
                              .unit_place = {"t.xml", 3, 20},
                              .layer_place = {"t.xml", 3, 30},
                              .cell_place = {"t.xml", 3, 40}};
}

static fw_drawing sound(fw_arena *arena, const void *data, size_t n,
                        const fw_drawing_asked *asked) {
    fw_diags diags = fw_diags_new(arena);
    fw_drawing d;
    if (fw_drawing_read(arena, data, n, asked, &diags, &d) != FW_OK)
        fail_msg("%s", diags.count ? diags.item[0].message : "no message");
    assert_int_equal(diags.count, 0);
    return d;
}

static void refused(fw_arena *arena, const void *data, size_t n, const fw_drawing_asked *asked,
                    int number, const char *says) {
    fw_diags diags = fw_diags_new(arena);
    fw_drawing d;
    assert_int_equal(fw_drawing_read(arena, data, n, asked, &diags, &d), FW_INPUT);
    if (diags.count != 1 || diags.item[0].number != number || !strstr(diags.item[0].message, says))
        fail_msg("%zu messages, FW-D%03d %s", diags.count, diags.count ? diags.item[0].number : 0,
                 diags.count ? diags.item[0].message : "");
}

static double area(const fw_drawing *d) {
    double sum = 0;
    for (int i = 0; i < d->count; i++)
        sum += (d->outline[i].hole ? -1 : 1) * fw_geometry_contour_area(&d->outline[i].contour);
    return sum;
}

static const char ring[] = HEAD("13") ENTITIES(
    LIGHT("jaw", "1", AT("0", "0") AT("300", "0") "42\n1.0\n" AT("300", "100") AT("0", "100"))
        CIRCLE("jaw", "100", "50", "20") "0\nPOINT\n8\njaw\n10\n1\n20\n1\n");

static void polylines_and_circles(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_drawing_asked asked = asked_for(NULL, NULL, NONE);
    fw_drawing d = sound(arena, ring, strlen(ring), &asked);
    assert_int_equal(d.count, 2);
    assert_false(d.outline[0].hole);
    assert_true(d.outline[1].hole);
    double want = 300 * 100 + 0.5 * M_PI * 50 * 50 - M_PI * 400;
    assert_relative(area(&d), want * UM * UM, 1e-13);
    fw_arena_free(arena);
}

/* texts and fillings are told once for each kind, where they lie on the layer that is asked for */
static void what_is_passed_over(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
#define SQUARE_LIGHT       LIGHT("jaw", "1", AT("0", "0") AT("9", "0") AT("9", "9"))
#define OTHER(kind, layer) "0\n" kind "\n8\n" layer "\n"
    static const char text[] = HEAD("13")
        ENTITIES(OTHER("TEXT", "other") OTHER("DIMENSION", "jaw") SQUARE_LIGHT OTHER("HATCH", "jaw")
                     OTHER("MTEXT", "jaw") OTHER("HATCH", "jaw") OTHER("MTEXT", "jaw"));
    fw_drawing_asked asked = asked_for("jaw", NULL, NONE);
    fw_diags diags = fw_diags_new(arena);
    fw_drawing d;
    assert_int_equal(fw_drawing_read(arena, text, strlen(text), &asked, &diags, &d), FW_OK);
    assert_int_equal(d.count, 1);
    static const char *const told[] = {"DIMENSION on layer 'jaw'", "HATCH on layer 'jaw'",
                                       "MTEXT on layer 'jaw'"};
    assert_int_equal(diags.count, 3);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(diags.item[i].number, 723);
        assert_non_null(strstr(diags.item[i].message, told[i]));
    }
    fw_arena_free(arena);
}

/* what the drawing does not show is not taken, which is told once; an arc of a full turn is a circle */
static void invisible_and_full_arcs(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
#define HIDDEN(layer) "0\nCIRCLE\n8\n" layer "\n60\n1\n10\n500\n20\n0\n40\n9\n"
    static const char text[] = HEAD("13") ENTITIES(
        HIDDEN("other") ARC("jaw", "0", "0", "20", "0", "360") HIDDEN("jaw") HIDDEN("jaw"));
    fw_drawing_asked asked = asked_for("jaw", NULL, NONE);
    fw_diags diags = fw_diags_new(arena);
    fw_drawing d;
    assert_int_equal(fw_drawing_read(arena, text, strlen(text), &asked, &diags, &d), FW_OK);
    assert_int_equal(d.count, 1);
    assert_relative(area(&d), M_PI * 400 * UM * UM, 1e-12);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 705);
    assert_non_null(strstr(diags.item[0].message, "CIRCLE on layer 'jaw' is invisible"));
    fw_arena_free(arena);
}

#define TABLES(all)                                                                                \
    "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n3\n" all "0\nENDTAB\n0\nENDSEC\n"
#define LAYER(name, flags, colour)                                                                 \
    "0\nLAYER\n2\n" name "\n70\n" flags "\n62\n" colour "\n6\nCONTINUOUS\n"

/* areas in um2, and the one warning or 0 */
static void of_layers(const char *text, const char *layer, double area_um2, int number,
                      const char *says) {
    fw_arena *arena = fw_arena_new(0);
    fw_drawing_asked asked = asked_for(layer, NULL, NONE);
    fw_diags diags = fw_diags_new(arena);
    fw_drawing d;
    fw_status status = fw_drawing_read(arena, text, strlen(text), &asked, &diags, &d);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no message");
    assert_relative(area(&d), area_um2 * UM * UM, 1e-12);
    assert_int_equal(diags.count, number != 0);
    if (number) {
        assert_int_equal(diags.item[0].number, number);
        if (!strstr(diags.item[0].message, says)) fail_msg("%s", diags.item[0].message);
    }
    fw_arena_free(arena);
}

/* what lies on a layer that is off or frozen is taken where that is asked for by its name; a frozen layer hides the whole
   block that was inserted on it, one that is off its layer 0 alone */
static void layers_that_are_not_shown(void **state) {
    (void)state;
#define SHOWN                                                                                      \
    HEAD("13") TABLES(LAYER("jaw", "0", "7") LAYER("help", "0", "-7") LAYER("old", "1", "7"))
    static const char two[] = SHOWN ENTITIES(CIRCLE("help", "500", "0", "9") CIRCLE(
        "help", "600", "0", "9") CIRCLE("jaw", "0", "0", "10"));
    of_layers(two, NULL, M_PI * 100, 716,
              "layer 'help' is switched off in the drawing, and what lies on it is not taken: "
              "where it is meant to be drawn, switch it on or thaw it");
    of_layers(two, "jaw", M_PI * 100, 0, NULL);
    of_layers(two, "help", 2 * M_PI * 81, 716,
              "layer 'help' is switched off in the drawing, which does not show it; it is taken "
              "all the same");
    static const char frozen[] = SHOWN BLOCKS(
        BLOCK("B", "0", "0", CIRCLE("jaw", "0", "0", "10") CIRCLE("0", "50", "0", "10")))
        ENTITIES("0\nINSERT\n8\nOLD\n2\nB\n10\n0\n20\n0\n" CIRCLE("jaw", "200", "0", "1"));
    of_layers(frozen, "jaw", M_PI, 716,
              "layer 'OLD' is frozen in the drawing, and what lies on it is not taken: where it is "
              "meant to be drawn, switch it on or thaw it");
    static const char off[] = SHOWN BLOCKS(
        BLOCK("B", "0", "0", CIRCLE("jaw", "0", "0", "10") CIRCLE("0", "50", "0", "10")))
        ENTITIES("0\nINSERT\n8\nhelp\n2\nB\n10\n0\n20\n0\n" CIRCLE("jaw", "200", "0", "1"));
    of_layers(off, "jaw", M_PI * 101, 0, NULL);
    of_layers(off, NULL, M_PI * 101, 716, "layer 'help' is switched off");
}

/* names are UTF-8, \U+XXXX, or of the code page that the header states */
static void names_of_layers(void **state) {
    (void)state;
    of_layers(HEAD("13") ENTITIES(CIRCLE("\xc3\x96l", "0", "0", "10")), "Öl", M_PI * 100, 0, NULL);
    of_layers(HEAD("13") ENTITIES(CIRCLE("\\U+00D6l", "0", "0", "10")), "Öl", M_PI * 100, 0, NULL);
    of_layers(HEAD("13") ENTITIES(CIRCLE("\xd6l", "0", "0", "10")), "Öl", M_PI * 100, 0, NULL);
    of_layers("0\nSECTION\n2\nHEADER\n9\n$DWGCODEPAGE\n3\nANSI_1251\n9\n$"
              "INSUNITS\n70\n13\n0\nENDSEC\n" ENTITIES(CIRCLE("\xc6", "0", "0", "10")),
              "Ж", M_PI * 100, 0, NULL);
    of_layers(HEAD("13") ENTITIES(CIRCLE("\\U+20acx\\U+12", "0", "0", "10")), "€x\\U+12",
              M_PI * 100, 0, NULL);
    fw_arena *arena = fw_arena_new(0);
    static const char text[] = HEAD("13") ENTITIES(CIRCLE("Maske", "0", "0", "10") CIRCLE(
        "\xd6l", "0", "0", "10") CIRCLE("Maske", "0", "0", "20"));
    fw_drawing_asked asked = asked_for("Mask", NULL, NONE);
    refused(arena, text, strlen(text), &asked, 314,
            "has no closed line on layer 'Mask'; something lies on 'Maske', 'Öl'; draw one");
    fw_arena_free(arena);
}

/* lines and arcs in any order and direction, within a nanometre of each other; millimetres */
static void chains(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const char text[] = ENTITIES(
        LINE("a", "0", "0", "0.3", "0") LINE("b", "0", "0", "9", "9")
            ARC("a", "0.3", "0.05", "0.05", "270", "90") LINE("a", "0", "0.1", "0", "0.0000005")
                LINE("a", "0", "0.1", "0.3", "0.1"));
    fw_drawing_asked asked = asked_for("a", "mm", 1e-3);
    fw_drawing d = sound(arena, text, strlen(text), &asked);
    assert_int_equal(d.count, 1);
    assert_relative(area(&d), (300 * 100 + 0.5 * M_PI * 50 * 50) * UM * UM, 1e-7);
    fw_arena_free(arena);
}

static void heavy_polyline(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
#define VERTEX(x, y, more) "0\nVERTEX\n8\n0\n10\n" x "\n20\n" y "\n30\n0\n" more
    static const char text[] = HEAD("4") ENTITIES(
        "0\nPOLYLINE\n8\n0\n66\n1\n70\n1\n10\n0\n20\n0\n30\n0\n" VERTEX("0", "0", "42\n1\n")
            VERTEX("0.2", "0", "42\n1\n") "0\nSEQEND\n");
    fw_drawing_asked asked = asked_for(NULL, "mm", 1e-3);
    fw_drawing d = sound(arena, text, strlen(text), &asked);
    assert_relative(area(&d), M_PI * 100 * 100 * UM * UM, 1e-13);
    fw_arena_free(arena);
}

/* A half disc of radius 10 about (1, 2), flat below, its base there: twice as large, mirrored about y and turned by a
   quarter, two by three times in a block that is itself placed; layer 0 is the INSERT's, others stay. */
static void blocks(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const char text[] = HEAD("13") BLOCKS(
        BLOCK("Half", "1", "2",
              LIGHT("0", "1", AT("11", "2") "42\n1\n" AT("-9", "2")) CIRCLE("other", "0", "0", "5"))
            BLOCK(
                "rows", "0", "0",
                INSERT("HALF", "5", "7", "41\n-2\n42\n2\n50\n90\n70\n2\n71\n3\n44\n100\n45\n50\n")))
        ENTITIES(INSERT("rows", "1000", "0", ""));
    fw_drawing_asked asked = asked_for("jaw", NULL, NONE);
    fw_drawing d = sound(arena, text, strlen(text), &asked);
    assert_int_equal(d.count, 6);
    assert_relative(area(&d), 6 * 0.5 * M_PI * 400 * UM * UM, 1e-13);
    fw_geometry_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < d.count; i++) {
        fw_geometry_box one = fw_geometry_contour_box(&d.outline[i].contour);
        box = (fw_geometry_box){fmin(box.x0, one.x0), fmin(box.y0, one.y0), fmax(box.x1, one.x1),
                                fmax(box.y1, one.y1)};
    }
    /* y of the half disc, 0 to 20, goes to -x; its x, -20 to 20, to y; columns to y, rows to -x */
    assert_near(box.x0, (1005 - 100 - 20) * UM, 1e-12);
    assert_near(box.x1, 1005 * UM, 1e-12);
    assert_near(box.y0, (7 - 20) * UM, 1e-12);
    assert_near(box.y1, (7 + 100 + 20) * UM, 1e-12);
    asked = asked_for("other", NULL, NONE);
    assert_int_equal(sound(arena, text, strlen(text), &asked).count, 6);
    fw_arena_free(arena);
}

static void dxf_is_refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
#define SQUARE AT("0", "0") AT("100", "0") AT("100", "100") AT("0", "100")
    static const struct {
        const char *text, *layer, *unit;
        double unit_m;
        int number;
        const char *says;
    } bad[] = {
        {"", NULL, NULL, NONE, 312, "empty"},
        {"hello\nworld\n", NULL, NULL, NONE, 312, "group code"},
        {"0\nSECTION\n2\nENTITIES\n", NULL, "um", UM, 312, "does not end"},
        {"0\nSECTION\n", NULL, "um", UM, 312, "no name"},
        {HEAD("13") "0\nSECTION\n", NULL, NULL, NONE, 312, "no name"},
        {"AutoCAD Binary DXF\r\n\032", NULL, NULL, NONE, 312, "binary"},
        {ENTITIES(LIGHT("0", "1", SQUARE)), NULL, NULL, NONE, 313, "unit"},
        {HEAD("0") ENTITIES(LIGHT("0", "1", SQUARE)), NULL, NULL, NONE, 313, "unit"},
        {HEAD("4") ENTITIES(LIGHT("0", "1", SQUARE)), NULL, "um", UM, 313, "drawn in mm"},
        {HEAD("6") ENTITIES(LIGHT("0", "1", SQUARE)), NULL, NULL, NONE, 313, "300 mm"},
        {HEAD("13") ENTITIES(LIGHT("0", "1", SQUARE)), "jaw", NULL, NONE, 314, "no closed line"},
        {HEAD("13") ENTITIES(LIGHT("a", "1", SQUARE) LIGHT("b", "1", SQUARE)), NULL, NULL, NONE,
         314, "'a' and 'b'"},
        {HEAD("13") ENTITIES(LIGHT("0", "0", SQUARE)), NULL, NULL, NONE, 315, "ends at (0, 100)"},
        {HEAD("13") ENTITIES(LIGHT("0", "1", AT("0", "0") AT("9", "9") AT("9", "0") AT("0", "9"))),
         NULL, NULL, NONE, 315, "crosses"},
        {HEAD("13") ENTITIES("0\nSPLINE\n8\n0\n"), NULL, NULL, NONE, 315, "SPLINE"},
        /* what is not known is not passed over */
        {HEAD("13") ENTITIES("0\nPLANESURFACE\n8\n0\n"), NULL, NULL, NONE, 315, "PLANESURFACE"},
        {HEAD("13") ENTITIES(INSERT("block", "0", "0", "")), NULL, NULL, NONE, 315,
         "not in the file"},
        {HEAD("13") BLOCKS(BLOCK("b", "0", "0", CIRCLE("0", "0", "0", "9")))
             ENTITIES(INSERT("b", "0", "0", "41\n2\n")),
         NULL, NULL, NONE, 315, "stretched"},
        {HEAD("13") BLOCKS(BLOCK("b", "0", "0", CIRCLE("0", "0", "0", "9")))
             ENTITIES(INSERT("b", "0", "0", "230\n-1\n")),
         NULL, NULL, NONE, 315, "plane"},
        {HEAD("13") BLOCKS(BLOCK("b", "0", "0", INSERT("c", "1", "1", "")) BLOCK(
             "c", "0", "0", INSERT("b", "1", "1", ""))) ENTITIES(INSERT("b", "0", "0", "")),
         NULL, NULL, NONE, 319, "holds itself"},
        {HEAD("13") BLOCKS(BLOCK("b", "0", "0", ""))
             ENTITIES(INSERT("b", "0", "0", "70\n32000\n71\n32000\n44\n1\n45\n1\n")),
         NULL, NULL, NONE, 319, "100000"},
        {HEAD("13") BLOCKS(BLOCK("b", "0", "0", CIRCLE("0", "0", "0", "9") "0\nSPLINE\n8\n0\n"))
             ENTITIES(INSERT("b", "0", "0", "")),
         NULL, NULL, NONE, 315, "SPLINE on layer 'jaw'"},
        {HEAD("13") "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n", NULL, NULL, NONE, 312,
         "does not end"},
        {HEAD("13") ENTITIES("0\nLWPOLYLINE\n8\n0\n43\n5\n70\n1\n" SQUARE), NULL, NULL, NONE, 315,
         "width"},
        {HEAD("13") ENTITIES("0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0\n"), NULL, NULL, NONE, 312,
         "radius"},
        {HEAD("13") ENTITIES("0\nCIRCLE\n8\n0\n10\nx\n20\n0\n40\n1\n"), NULL, NULL, NONE, 312,
         "number"},
        {HEAD("13") ENTITIES("0\nCIRCLE\n8\n0\n230\n-1\n10\n0\n20\n0\n40\n1\n"), NULL, NULL, NONE,
         315, "plane"},
        {HEAD("13") ENTITIES(CIRCLE("0", "0", "0", "9") CIRCLE("0", "0", "0", "6")
                                 CIRCLE("0", "0", "0", "3")),
         NULL, NULL, NONE, 315, "island"},
        {HEAD("13") ENTITIES(LINE("0", "0", "0", "9", "0") LINE("0", "9", "0", "9", "9")
                                 LINE("0", "9", "0", "0", "9")),
         NULL, NULL, NONE, 315, "more than one"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_drawing_asked asked = asked_for(bad[i].layer, bad[i].unit, bad[i].unit_m);
        refused(arena, bad[i].text, strlen(bad[i].text), &asked, bad[i].number, bad[i].says);
    }
    fw_drawing_asked cell = asked_for(NULL, NULL, NONE);
    cell.cell = "TOP";
    refused(arena, ring, strlen(ring), &cell, 314, "GDSII");
    fw_arena_free(arena);
}

/* ---- GDSII ---- */

typedef struct stream {
    unsigned char data[4096];
    size_t n;
} stream;

static void put16(stream *s, unsigned v) {
    s->data[s->n++] = (unsigned char)(v >> 8);
    s->data[s->n++] = (unsigned char)v;
}
static void put32(stream *s, long v) {
    put16(s, (unsigned)((unsigned long)v >> 16) & 0xffff);
    put16(s, (unsigned)v & 0xffff);
}
static void head(stream *s, size_t length, unsigned kind) {
    put16(s, (unsigned)length + 4);
    put16(s, kind);
}
static void short_record(stream *s, unsigned kind, unsigned value) {
    head(s, 2, kind);
    put16(s, value);
}
static void name_record(stream *s, unsigned kind, const char *name) {
    size_t n = (strlen(name) + 1) / 2 * 2;
    head(s, n, kind);
    memset(s->data + s->n, 0, n);
    memcpy(s->data + s->n, name, strlen(name));
    s->n += n;
}
/* a dbu of 1 nm: 1e-9 = 0x3944b82fa09b5a54 in excess 64 */
static void begin_library(stream *s) {
    static const unsigned char units[] = {0x3e, 0x41, 0x89, 0x37, 0x4b, 0xc6, 0xa7, 0xf0,
                                          0x39, 0x44, 0xb8, 0x2f, 0xa0, 0x9b, 0x5a, 0x54};
    s->n = 0;
    short_record(s, 0x0002, 600);
    head(s, 24, 0x0102);
    memset(s->data + s->n, 0, 24);
    s->n += 24;
    name_record(s, 0x0206, "LIB");
    head(s, sizeof units, 0x0305);
    memcpy(s->data + s->n, units, sizeof units);
    s->n += sizeof units;
}
static void begin_cell(stream *s, const char *name) {
    head(s, 24, 0x0502);
    memset(s->data + s->n, 0, 24);
    s->n += 24;
    name_record(s, 0x0606, name);
}
static void polygon(stream *s, unsigned kind, unsigned layer, const long (*p)[2], size_t n) {
    head(s, 0, kind);
    short_record(s, 0x0d02, layer);
    short_record(s, 0x0e02, 0);
    head(s, 8 * n, 0x1003);
    for (size_t i = 0; i < n; i++)
        put32(s, p[i][0] * 1000), put32(s, p[i][1] * 1000);
    head(s, 0, 0x1100);
}
static const long square[][2] = {{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}};
static const long bow[][2] = {{0, 0}, {100, 100}, {100, 0}, {0, 90}, {0, 0}};
static const long shifted[][2] = {{-50, -40}, {-10, -40}, {-10, 0}, {-50, -40}};

static stream library(void) {
    stream s;
    begin_library(&s);
    begin_cell(&s, "OTHER");
    polygon(&s, 0x0800, 3, bow, 5);
    head(&s, 0, 0x0700);
    begin_cell(&s, "JAW");
    polygon(&s, 0x0800, 3, square, 5);
    polygon(&s, 0x0800, 3, shifted, 4);
    polygon(&s, 0x0900, 7, square, 5);
    head(&s, 0, 0x0700);
    head(&s, 0, 0x0400);
    return s;
}

static void cells_and_layers(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s = library();
    fw_drawing_asked asked = asked_for("3", NULL, NONE);
    asked.cell = "JAW";
    fw_drawing d = sound(arena, s.data, s.n, &asked);
    assert_int_equal(d.count, 2);
    assert_relative(area(&d), (100 * 100 + 0.5 * 40 * 40) * UM * UM, 1e-12);
    asked.layer = "3/0";
    assert_int_equal(sound(arena, s.data, s.n, &asked).count, 2);
    fw_arena_free(arena);
}

static void gds_is_refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    stream s = library();
    static const struct {
        const char *layer, *cell, *unit;
        int number;
        const char *says;
    } bad[] = {
        {"3", NULL, NULL, 315,
         "crosses"}, /* the first cell is looked at before there is a second */
        {"9", NULL, NULL, 314, "OTHER and JAW"},
        {"3", "NONE", NULL, 314, "no cell"},
        {"9", "JAW", NULL, 314, "no polygon"},
        {"3/1", "JAW", NULL, 314, "no polygon"},
        {"7", "JAW", NULL, 315, "path"},
        {"metal", "JAW", NULL, 314, "is a number"},
        {"70000", "JAW", NULL, 314, "is a number"},
        {"3", "JAW", "um", 313, "own unit"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_drawing_asked asked = asked_for(bad[i].layer, bad[i].unit, UM);
        asked.cell = bad[i].cell;
        refused(arena, s.data, s.n, &asked, bad[i].number, bad[i].says);
    }
    fw_drawing_asked asked = asked_for("3", NULL, NONE);
    asked.cell = "JAW";
    for (size_t n = 4; n < s.n; n += 2) { /* cut off anywhere */
        fw_diags diags = fw_diags_new(arena);
        fw_drawing d;
        unsigned char *copy = malloc(n);
        assert_non_null(copy);
        memcpy(copy, s.data, n);
        assert_int_equal(fw_drawing_read(arena, (char *)copy, n, &asked, &diags, &d), FW_INPUT);
        assert_int_equal(diags.errors, 1);
        free(copy);
    }
    fw_arena_free(arena);
}

/* ---- damage ---- */

static unsigned next_random(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* bytes changed, removed and repeated at random places: read or refused with one message or more,
   within little memory */
static void damage(const char *original, size_t n, const fw_drawing_asked *asked, int rounds) {
    unsigned seed = 1;
    for (int round = 0; round < rounds; round++) {
        fw_arena *arena = fw_arena_new((size_t)32 << 20);
        char *copy = malloc(2 * n);
        size_t length = n;
        assert_non_null(copy);
        memcpy(copy, original, n);
        for (unsigned k = 0; k <= next_random(&seed) % 4; k++) {
            size_t at = next_random(&seed) % length, part = 1 + next_random(&seed) % 9;
            if (part > length - at) part = length - at;
            unsigned kind = next_random(&seed) % 4;
            if (kind < 2)
                copy[at] = (char)next_random(&seed);
            else if (kind == 2 && length > part + 1) {
                memmove(copy + at, copy + at + part, length - at - part);
                length -= part;
            } else if (length + part <= 2 * n) {
                memmove(copy + at + part, copy + at, length - at);
                length += part;
            }
        }
        char *exact = malloc(length); /* reading beyond is found by the sanitizer */
        assert_non_null(exact);
        memcpy(exact, copy, length);
        fw_diags diags = fw_diags_new(arena);
        fw_drawing d;
        fw_status status = fw_drawing_read(arena, exact, length, asked, &diags, &d);
        if (status != FW_OK) {
            assert_int_equal(status, FW_INPUT);
            assert_true(diags.errors > 0);
        } else
            assert_true(d.count > 0);
        free(exact);
        free(copy);
        fw_arena_free(arena);
    }
}

static void damaged_files(void **state) {
    (void)state;
    fw_drawing_asked dxf = asked_for(NULL, NULL, NONE), gds = asked_for("3", NULL, NONE);
    gds.cell = "JAW";
    stream s = library();
    damage(ring, strlen(ring), &dxf, 4000);
    damage((const char *)s.data, s.n, &gds, 4000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polylines_and_circles),   cmocka_unit_test(what_is_passed_over),
        cmocka_unit_test(invisible_and_full_arcs), cmocka_unit_test(layers_that_are_not_shown),
        cmocka_unit_test(names_of_layers),         cmocka_unit_test(chains),
        cmocka_unit_test(heavy_polyline),          cmocka_unit_test(blocks),
        cmocka_unit_test(dxf_is_refused),          cmocka_unit_test(cells_and_layers),
        cmocka_unit_test(gds_is_refused),          cmocka_unit_test(damaged_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
