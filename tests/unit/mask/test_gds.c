/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene.h"

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static fw_text written(const fw_mask *mask, fw_arena *arena) {
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_mask_write_gds(mask, &out), FW_OK);
    return out;
}

/* written by hand from the record table of the format, not by a program */
static const unsigned char expected[] = {
    0x00, 0x06, 0x00, 0x02, 0x02, 0x58, /* HEADER 600 */
    0x00, 0x1c, 0x01, 0x02,             /* BGNLIB, dates zero */
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0x0e, 0x02, 0x06,
    'F',  'L',  'E',  'X',  'W',  'R',  'I',  'G',  'H',  'T', /* LIBNAME */
    0x00, 0x14, 0x03, 0x05,                                    /* UNITS 1e-3, 1e-9 */
    0x3e, 0x41, 0x89, 0x37, 0x4b, 0xc6, 0xa7, 0xf0, 0x39, 0x44, 0xb8, 0x2f, 0xa0, 0x9b,
    0x5a, 0x54, 0x00, 0x1c, 0x05, 0x02, /* BGNSTR */
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0x10, 0x06, 0x06,
    't',  'e',  's',  't',  '_',  'd',  'e',  'v',  'i',  'c',  'e',  0, /* STRNAME */
    0x00, 0x04, 0x08, 0x00,                                              /* BOUNDARY */
    0x00, 0x06, 0x0d, 0x02, 0x00, 0x01,                                  /* LAYER 1 */
    0x00, 0x06, 0x0e, 0x02, 0x00, 0x00,                                  /* DATATYPE 0 */
    0x00, 0x2c, 0x10, 0x03,                                              /* XY, 5 points */
    0xff, 0xff, 0xff, 0xff, 0x00, 0x00, 0x00, 0x00,                      /* -1, 0 nm */
    0x00, 0x00, 0x27, 0x10, 0x00, 0x00, 0x00, 0x00,                      /* 10000, 0 */
    0x00, 0x00, 0x27, 0x10, 0x00, 0x00, 0x4e, 0x20,                      /* 10000, 20000 */
    0xff, 0xff, 0xff, 0xff, 0x00, 0x00, 0x4e, 0x20,                      /* -1, 20000 */
    0xff, 0xff, 0xff, 0xff, 0x00, 0x00, 0x00, 0x00,                      /* closed */
    0x00, 0x04, 0x11, 0x00,                                              /* ENDEL */
    0x00, 0x04, 0x07, 0x00,                                              /* ENDSTR */
    0x00, 0x04, 0x04, 0x00,                                              /* ENDLIB */
};

static void bytes(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    s->table.nlayer = 2; /* no layer for notes */
    scene_box(s, "box", -0.001, 0, 10, 20);
    fw_text out = written(built(s), s->arena);
    for (size_t i = 0; i < sizeof expected && i < out.length; i++)
        if ((unsigned char)out.data[i] != expected[i])
            fail_msg("byte %zu is %02x, expected %02x", i, (unsigned char)out.data[i], expected[i]);
    assert_int_equal(out.length, sizeof expected);
    scene_free(s);
}

/* ---- an independent reader of the records ---- */
static unsigned u16(const unsigned char *p) {
    return (unsigned)p[0] << 8 | p[1];
}

static double i32(const unsigned char *p) {
    uint32_t v = (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
    return v >= 0x80000000u ? (double)v - 4294967296.0 : (double)v;
}

static double real8(const unsigned char *p) {
    double m = 0;
    for (int i = 1; i < 8; i++)
        m = m * 256 + p[i];
    return ldexp(m, 4 * ((p[0] & 127) - 64) - 56) * (p[0] & 128 ? -1 : 1);
}

typedef struct stream {
    double unit[2], area[64];
    int boundaries[64], texts, most_vertices;
    char cell[64], text[40][520];
} stream;

static void read_xy(stream *r, const unsigned char *p, size_t n, int layer) {
    assert_true(n % 8 == 0 && n >= 32);
    assert_true(i32(p) == i32(p + n - 8) && i32(p + 4) == i32(p + n - 4)); /* closed */
    double twice = 0;
    for (size_t k = 0; k + 16 <= n; k += 8) {
        twice += i32(p + k) * i32(p + k + 12) - i32(p + k + 8) * i32(p + k + 4);
        assert_true(i32(p + k) != i32(p + k + 8) || i32(p + k + 4) != i32(p + k + 12));
    }
    assert_true(twice > 0);
    r->area[layer] += 0.5 * twice;
    r->boundaries[layer]++;
    int vertices = (int)(n / 8) - 1;
    r->most_vertices = vertices > r->most_vertices ? vertices : r->most_vertices;
}

/* the order of the records comes back as one letter each */
static void read_stream(stream *r, const fw_text *data, char *order, size_t most) {
    *r = (stream){0};
    const unsigned char *p = (const unsigned char *)data->data, *end = p + data->length;
    int layer = -1, in_text = 0;
    size_t n = 0;
    while (p < end) {
        size_t length = u16(p), payload = length - 4;
        unsigned type = p[2];
        const unsigned char *d = p + 4;
        assert_true(length >= 4 && length % 2 == 0 && length < 0x8000 && p + length <= end);
        assert_true(n + 1 < most);
        if (type == 0x08 || type == 0x0c) in_text = type == 0x0c;
        if (type == 0x03) {
            r->unit[0] = real8(d);
            r->unit[1] = real8(d + 8);
        }
        if (type == 0x0d) layer = (int)u16(d);
        if (type == 0x10 && !in_text) read_xy(r, d, payload, layer);
        if (type == 0x06) memcpy(r->cell, d, payload < 63 ? payload : 63);
        if (type == 0x19) {
            assert_true(layer == 63 && payload <= 512);
            memcpy(r->text[r->texts++], d, payload);
        }
        static const char letter[] = "hblueBNEo???cyd?X.????t??S";
        assert_true(type < sizeof letter - 1 && letter[type] != '?');
        order[n++] = letter[type];
        p += length;
    }
    order[n] = '\0';
    assert_true(p == end);
}

static void reads_back(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    static const double p[4][2] = {{0, 200}, {8, 200}, {8, 208}, {0, 208}};
    scene_add(s, FW_ROLE_TEXT, "letter", polygon(s->arena, p, 4));
    const char *note[] = {"arc=240 deg", "umlaut=\xc3\xa4"};
    s->options.note = note;
    s->options.nnote = 2;
    const fw_mask *mask = built(s);
    fw_text out = written(mask, s->arena);
    stream r;
    char order[4096];
    read_stream(&r, &out, order, sizeof order);
    const char *at = order;
    assert_true(strncmp(at, "hbluBN", 6) == 0);
    for (at += 6; strncmp(at, "oydX.", 5) == 0;)
        at += 5;
    for (; strncmp(at, "cytXS.", 6) == 0;)
        at += 6;
    assert_string_equal(at, "Ee");
    assert_true(r.unit[0] == 1e-3 && r.unit[1] == 1e-9);
    assert_string_equal(r.cell, "test_device");
    assert_int_equal(r.boundaries[1], 3);
    assert_int_equal(r.boundaries[2], 1);
    assert_near(r.area[2], 64e6, 0);
    double area = (PI * 50 * 8 + 2 * 8 * 20) * 1e6;
    assert_near(r.area[1], area, mask->measure[0].bound_m2 * 1e18);
    assert_near(r.area[1], mask->measure[0].polygon_area_m2 * 1e18, 1e-3);
    bool device = false, deg = false, masked = false;
    for (int i = 0; i < r.texts; i++) {
        device = device || strcmp(r.text[i], "device=test device") == 0;
        deg = deg || strcmp(r.text[i], "arc=240 deg") == 0;
        masked = masked || strcmp(r.text[i], "umlaut=<U+00E4>") == 0;
        assert_null(strstr(r.text[i], "REJECTED"));
    }
    assert_true(device && deg && masked);
    scene_free(s);
}

/* area of random ring sectors recomputed from the file, against the closed form */
static void random_sectors_through_the_file(void **state) {
    (void)state;
    uint64_t seed = 99;
    for (int i = 0; i < 100; i++) {
        scene *s = scene_new(0, 0);
        double area = 0;
        for (int k = 0; k < 5; k++) {
            double inner = (10 + 100 * random01(&seed)) * UM;
            double width = (4 + 30 * random01(&seed)) * UM, sweep = 0.5 + 5 * random01(&seed);
            fw_geometry_contour c;
            fw_geometry_vec2 o = {k * 400 * UM, random01(&seed) * 1e-3};
            assert_int_equal(fw_geometry_contour_ring_sector(s->arena, o, inner, inner + width,
                                                             6 * random01(&seed), sweep, &c),
                             FW_OK);
            scene_add(s, FW_ROLE_FLEXURE, "ring", c);
            area += 0.5 * sweep * width * (2 * inner + width);
        }
        const fw_mask *mask = built(s);
        fw_text out = written(mask, s->arena);
        stream r;
        char order[4096];
        read_stream(&r, &out, order, sizeof order);
        assert_int_equal(r.boundaries[1], 5);
        assert_near(r.area[1] * 1e-18, area, mask->measure[0].bound_m2);
        scene_free(s);
    }
}

static void names_that_readers_take(void **state) {
    (void)state;
    static const struct {
        const char *device;
        bool rejected;
        const char *cell;
    } row[] = {
        {"reference-six-bar", false, "reference_six_bar"},
        {"reference-six-bar", true, "reference_six_bar_REJECTED"},
        {"a name of more than thirty-two characters", false, "a_name_of_more_than_thirty_two_c"},
        {"a name of more than thirty-two characters", true, "a_name_of_more_than_thi_REJECTED"},
        {"", false, "DEVICE"},
        {"\xc2\xb5$?", false, "__$?"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        scene *s = scene_new(0, 0);
        scene_box(s, "box", 0, 0, 10, 10);
        s->options.rejected = row[i].rejected;
        const fw_mask *mask = NULL;
        assert_int_equal(fw_mask_build(s->arena, &s->layout, &s->table, row[i].device, &s->options,
                                       &s->diags, &mask),
                         FW_OK);
        assert_string_equal(mask->cell, row[i].cell);
        fw_text out = written(mask, s->arena);
        stream r;
        char order[4096];
        read_stream(&r, &out, order, sizeof order);
        assert_string_equal(r.cell, row[i].cell);
        bool said = false;
        for (int k = 0; k < r.texts; k++)
            said = said || strcmp(r.text[k], "status=REJECTED") == 0;
        assert_true(said == row[i].rejected);
        scene_free(s);
    }
}

static void same_mask_same_bytes(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM), *t = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    scene_arch(t, 50, 8, 20);
    fw_text a = written(built(s), s->arena), b = written(built(t), t->arena);
    assert_int_equal(a.length, b.length);
    assert_memory_equal(a.data, b.data, a.length);
    scene_free(s);
    scene_free(t);
}

static void short_memory(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    const fw_mask *mask = built(s);
    fw_status status = FW_NOMEM;
    for (long at = 1; status != FW_OK && at < 100; at++) {
        fw_text out = fw_text_new(s->arena);
        fw_arena_fail_at(at, 1);
        status = fw_mask_write_gds(mask, &out);
        fw_arena_fail_at(0, 0);
        assert_true(status == FW_OK || status == FW_NOMEM);
    }
    assert_int_equal(status, FW_OK);
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes),
        cmocka_unit_test(reads_back),
        cmocka_unit_test(random_sectors_through_the_file),
        cmocka_unit_test(names_that_readers_take),
        cmocka_unit_test(same_mask_same_bytes),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
