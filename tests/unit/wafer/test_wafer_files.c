/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The map as CSV and picture, the plate as SVG, the certificate: each read back and compared with
   the places it was made from. */
#include "wafer/plate.h"
#include <jansson.h>
#include <stdlib.h>
#include <zlib.h>

static const char *write_with(plate *p, const fw_wafer *w,
                              fw_status (*write)(const fw_wafer *, fw_text *)) {
    fw_text out = fw_text_new(p->arena), again = fw_text_new(p->arena);
    assert_int_equal(write(w, &out), FW_OK);
    assert_int_equal(write(w, &again), FW_OK);
    assert_string_equal(out.data, again.data);
    return out.data;
}

static int count_of(const char *text, const char *part) {
    int n = 0;
    for (const char *s = strstr(text, part); s; s = strstr(s + strlen(part), part))
        n++;
    return n;
}

/* field k of a line, NUL-terminated; quotes are taken off */
static const char *field(const char *line, int k, char out[200]) {
    for (; k > 0; k--)
        line = strchr(line, ',') + 1;
    size_t n = *line == '"' ? strcspn(++line, "\"") : strcspn(line, ",\n");
    assert_true(n < 200);
    memcpy(out, line, n);
    out[n] = '\0';
    return out;
}

static plate *two_sweeps(void) {
    plate *p = plate_new(240);
    plate_sweep(p, 240, 3, 2);
    p->variant[4].mask = NULL;
    p->variant[4].why = "too \"thin\", says the verdict";
    p->input.stand_in.value[0] = 111 * PI / 180;
    p->input.stand_in.value[1] = 33 * UM;
    p->device.wafer.alignment = true;
    p->device.wafer.tests = 2;
    return p;
}

/* the plate in the format of that name */
static fw_status plate_write(const fw_wafer *wafer, const char *name, fw_text *out) {
    const fw_mask_format *format;
    for (size_t i = 0; (format = fw_mask_format_at(i)); i++)
        if (strcmp(format->name, name) == 0) return fw_wafer_write_format(wafer, format, out);
    return FW_USAGE;
}

static fw_status write_svg(const fw_wafer *wafer, fw_text *out) {
    return plate_write(wafer, "svg", out);
}

/* what can be said without a reader (tests/accept/wafer.sh has one): the cells by name in their
   order, the END record of 256 bytes with the places of the tables, the checksum */
static void test_oasis(void **state) {
    (void)state;
    plate *p = two_sweeps();
    const fw_wafer *w = plate_build(p);
    fw_text out = fw_text_new(p->arena), again = fw_text_new(p->arena);
    assert_int_equal(plate_write(w, "oasis", &out), FW_OK);
    assert_int_equal(plate_write(w, "oasis", &again), FW_OK);
    assert_int_equal(out.length, again.length);
    assert_memory_equal(out.data, again.data, out.length);
    const unsigned char *b = (const unsigned char *)out.data;
    size_t n = out.length, end = n - 256, at = 0;
    assert_memory_equal(b, "%SEMI-OASIS\r\n", 13);
    assert_int_equal(b[end], 2);     /* END */
    assert_int_equal(b[end + 1], 1); /* strict: the table of cell names is at */
    for (int k = 0; k < 9 && (k == 0 || b[end + 1 + (size_t)k] & 0x80); k++)
        at |= (size_t)(b[end + 2 + (size_t)k] & 0x7f) << 7 * k;
    for (int c = 0; c <= w->ncell; c++) {
        const char *name = c < w->ncell ? w->cell[c].name : w->top;
        assert_int_equal(b[at], 3); /* CELLNAME, numbered as it comes */
        assert_int_equal(b[at + 1], strlen(name));
        assert_memory_equal(b + at + 2, name, strlen(name));
        at += 2 + strlen(name);
    }
    assert_int_not_equal(b[at], 3);
    unsigned long crc = crc32(crc32(0, NULL, 0), b, (unsigned)(n - 4));
    assert_int_equal(b[n - 5], 1);
    for (size_t k = 0; k < 4; k++)
        assert_int_equal(b[n - 4 + k], crc >> 8 * k & 0xff);
    fw_arena_free(p->arena);
}

static void test_csv(void **state) {
    (void)state;
    plate *p = two_sweeps();
    const fw_wafer *w = plate_build(p);
    const char *csv = write_with(p, w, fw_wafer_write_csv);
    assert_int_equal(count_of(csv, "\n"), w->grid.nsite + 1);
    assert_int_equal(strncmp(csv,
                             "die,row,column,x_mm,y_mm,kind,variant,arc [deg],link [um],verdict,"
                             "utilisation,note\n",
                             80),
                     0);
    char a[200];
    double sum_x = 0;
    const char *line = csv;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        line = strchr(line, '\n') + 1;
        char b[16];
        snprintf(b, sizeof b, "%c%02d", 'A' + s->row, s->column % 100 + 1);
        assert_string_equal(field(line, 0, a), b);
        assert_near(atof(field(line, 3, a)), 1e-6 * (s->x + 0.5 * w->grid.width), 1e-9);
        assert_near(atof(field(line, 4, a)), 1e-6 * (s->y + 0.5 * w->grid.height), 1e-9);
        sum_x += atof(field(line, 3, a));
        static const char *const kind[] = {"die", "alignment", "test"};
        assert_string_equal(field(line, 5, a), kind[s->kind]);
        if (s->variant < 0) {
            assert_string_equal(field(line, 6, a), "");
            continue;
        }
        bool other = s->variant == 4; /* is what stands there, not what was asked for */
        assert_int_equal(atoi(field(line, 6, a)), s->variant + 1);
        assert_near(atof(field(line, 7, a)), other ? 111 : 100 + 10 * (s->variant % 3), 1e-6);
        assert_near(atof(field(line, 8, a)), other ? 33 : 10 + 5 * (s->variant / 3), 1e-6);
        assert_string_equal(field(line, 9, a), s->variant == 1 ? "inconclusive" : "accept");
        assert_near(atof(field(line, 10, a)), other ? 0.5 : 0.5 + 0.01 * s->variant, 1e-9);
        assert_string_equal(field(line, 11, a),
                            other ? "nominal die in place of arc = 110 deg, link = 15 um" : "");
    }
    assert_near(sum_x, 0, 1e-6); /* the flat is below: left and right are alike */
    fw_arena_free(p->arena);
}

static double number(const json_t *o, const char *key) {
    const json_t *v = json_object_get(o, key);
    if (!json_is_number(v)) fail_msg("%s is no number", key);
    return json_number_value(v);
}

static void test_json(void **state) {
    (void)state;
    plate *p = two_sweeps();
    const fw_wafer *w = plate_build(p);
    fw_text out = fw_text_new(p->arena);
    assert_int_equal(fw_wafer_write_json(w, "abc", &out), FW_OK);
    json_t *root = json_loads(out.data, 0, NULL);
    assert_non_null(root);
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "flexwright.wafer/1");
    json_t *grid = json_object_get(root, "grid");
    assert_near(number(grid, "dies"), w->dies, 0);
    assert_near(number(json_object_get(root, "plate"), "edge_mm"), 76.2, 1e-9);
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "plate"), "field")),
                        "clear");
    json_t *variants = json_object_get(root, "variants");
    assert_int_equal(json_array_size(variants), 6);
    double dies = 0;
    for (size_t i = 0; i < 6; i++)
        dies += number(json_array_get(variants, i), "dies");
    assert_near(dies, w->dies, 0);
    assert_string_equal(json_string_value(json_object_get(json_array_get(variants, 4), "why")),
                        p->variant[4].why);
    /* the lane: the same in every die, and only there */
    const json_t *lane = json_array_get(json_object_get(root, "layers"), 3);
    assert_relative(number(lane, "polygon_area_um2"), w->dies * 2000.0 * 50, 1e-12);
    assert_near(number(lane, "polygons"), w->dies, 0);
    double placed = 0;
    size_t i;
    const json_t *cell;
    json_array_foreach(json_object_get(root, "cells"), i, cell) placed += number(cell, "placed");
    assert_near(placed, w->grid.nsite + 2 * w->dies, 0); /* a cell per place, two of the id */
    json_decref(root);
    fw_arena_free(p->arena);
}

static void test_svg(void **state) {
    (void)state;
    plate *p = two_sweeps();
    const fw_wafer *w = plate_build(p);
    const char *svg = write_with(p, w, write_svg);
    int placed = 0;
    for (int c = 0; c < w->ncell; c++) {
        char def[80], use[80];
        snprintf(def, sizeof def, "<g id=\"%s\">", w->cell[c].name);
        snprintf(use, sizeof use, "<use xlink:href=\"#%s\" ", w->cell[c].name);
        assert_int_equal(count_of(svg, def), 1);
        assert_int_equal(count_of(svg, use), w->cell[c].placed);
        placed += w->cell[c].placed;
    }
    int within = count_of(svg, "<use xlink:href=\"#s."); /* outlines that a cell repeats */
    assert_int_equal(count_of(svg, "<use "), placed + within);
    assert_int_equal(count_of(svg, "<g"), count_of(svg, "</g>"));
    assert_non_null(strstr(svg, "width=\"76.2mm\""));
    /* the first array's first place: from the plate's upper left corner, y downwards, um */
    const fw_wafer_run *r = &w->run[0];
    char use[160], x[FW_FIXED_BYTES], y[FW_FIXED_BYTES];
    fw_fixed_text(x, 38100 + 1e-3 * r->x, 3);
    fw_fixed_text(y, 38100 - 1e-3 * r->y, 3);
    snprintf(use, sizeof use, "<use xlink:href=\"#%s\" x=\"%.40s\" y=\"%.40s\"/>",
             w->cell[r->cell].name, x, y);
    assert_int_equal(count_of(svg, use), 1);
    fw_arena_free(p->arena);
}

static void test_map(void **state) {
    (void)state;
    plate *p = two_sweeps();
    p->device.wafer.title = "A < B & \"C\"";
    const fw_wafer *w = plate_build(p);
    const char *map = write_with(p, w, fw_wafer_write_map);
    assert_int_equal(count_of(map, "<g"), count_of(map, "</g>"));
    assert_non_null(strstr(map, "A &lt; B &amp; &quot;C&quot;"));
    /* a box per place, one per step and one for the test die in the legend, the ground */
    assert_int_equal(count_of(map, "<rect "), w->grid.nsite + w->nvariant + 2);
    char name[64], row[FW_WAFER_NAME], column[FW_WAFER_NAME];
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        snprintf(name, sizeof name, ">%s%s</text>", fw_wafer_row_name(s->row, row),
                 fw_wafer_column_name(&w->grid, s->column, column));
        assert_int_equal(count_of(map, name), s->kind != FW_WAFER_ALIGNMENT);
    }
    assert_non_null(strstr(map, "nominal dies instead"));
    fw_arena_free(p->arena);
}

/* every number ends where the name of its column ends */
static void columns_below_heading(const char *heading) {
    static const char *const name[] = {" x", " y", " angle", " CD"};
    const char *row = strchr(heading, '\n') + 1;
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        const char *end = strstr(heading, name[i]) + strlen(name[i]);
        const char *last = row + (end - heading);
        if (!strchr("0123456789", last[-1]) || last[0] != ' ')
            fail_msg("'%s' stands beside its numbers:\n%.180s", name[i], heading);
    }
}

/* places to measure: on the die nearest to the middle, where its own order sheet has them */
static void test_order(void **state) {
    (void)state;
    plate *p = two_sweeps();
    const fw_wafer *w = plate_build(p);
    const fw_output_file file = {"f.gds", 12, "0123"};
    fw_text out = fw_text_new(p->arena), own = fw_text_new(p->arena);
    assert_int_equal(fw_wafer_write_order(w, 0, &file, 1, &out), FW_OK);
    assert_non_null(strstr(out.data, "0123  12  f.gds\n"));
    assert_non_null(strstr(out.data, "76.2 mm x 76.2 mm"));
    const char *line = strstr(out.data, "CD sites in die ");
    assert_non_null(line);
    const fw_wafer_site *die = NULL;
    char name[2 * FW_WAFER_NAME], row[FW_WAFER_NAME], column[FW_WAFER_NAME];
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        snprintf(name, sizeof name, "%s%s:", fw_wafer_row_name(s->row, row),
                 fw_wafer_column_name(&w->grid, s->column, column));
        if (strncmp(line + strlen("CD sites in die "), name, strlen(name)) == 0) die = s;
    }
    assert_non_null(die);
    assert_int_equal(die->kind, FW_WAFER_DIE);
    assert_true(abs(die->x) < 2 * w->grid.pitch_x && abs(die->y) < 2 * w->grid.pitch_y);
    const fw_wafer_variant *v = &w->variant[die->variant];
    assert_int_equal(
        fw_mask_write_order_text(v->mask ? v->mask : w->stand_in.mask, 0, NULL, 0, &own), FW_OK);
    const char *there = strstr(own.data, "CD sites");
    int sites = 0, a, b;
    double x, y, x0, y0;
    columns_below_heading(strstr(line, "site  layer"));
    columns_below_heading(strstr(there, "site  layer"));
    line = strchr(strstr(line, "site  layer"), '\n'); /* behind the heading */
    there = strchr(strstr(there, "site  layer"), '\n');
    while (sscanf(line + 1, "%d %*s %*s %lf %lf", &a, &x, &y) == 3 &&
           sscanf(there + 1, "%d %*s %*s %lf %lf", &b, &x0, &y0) == 3) {
        assert_int_equal(a, b); /* the die is 2000 um x 1600 um from (-700, -1000) um */
        assert_near(x - x0, die->x * 1e-3 + 700, 2e-3);
        assert_near(y - y0, die->y * 1e-3 + 1000, 2e-3);
        line = strchr(line + 1, '\n');
        there = strchr(there + 1, '\n');
        sites++;
    }
    assert_true(sites >= 3);
    fw_arena_free(p->arena);
}

/* CD tolerance: half of what the verdict has left of a width, no more than its corners have gone, downwards to 10 nm, and a
   tenth of the least feature at most; what is stated stays as it is stated */
static void cd_tolerance(void **state) {
    (void)state;
    const double none = (double)NAN;
    const struct {
        double left_m, looked_m, stated_m;
        const char *says;
    } row[] = {
        {0.2e-6, 0.3e-6, none, "+- 0.1 um (half of what the verdict has left)"},
        {0.576e-6, 0.3e-6, none, "+- 0.28 um (half of what the verdict has left)"},
        {0.8e-6, 0.3e-6, none, "+- 0.3 um (as far again as the verdict's corners have moved lines)"},
        {4e-4, 3e-4, none, " um (a tenth of the least feature or space)"},
        {HUGE_VAL, 3e-4, none, " um (a tenth of the least feature or space)"},
        {none, none, none, " um (a tenth of the least feature or space)"},
        {0.2e-6, 0.3e-6, 0.25e-6, "+- 0.25 um (stated)"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        plate *p = plate_new(240);
        p->input.effect = (fw_wafer_width_effect){"hinge A: at most 60 % of its limit",
                                                    row[i].left_m, row[i].looked_m};
        p->input.overlay_m = (double)NAN;
        p->device.wafer.order = (fw_device_order_asked){.thickness_m = none,
                                                        .cd_m = row[i].stated_m,
                                                        .registration_m = none,
                                                        .defect_m = none,
                                                        .scale = 1,
                                                        .quantity = 2};
        const fw_wafer *w = plate_build(p);
        fw_wafer_written written;
        fw_text out = fw_text_new(p->arena);
        assert_int_equal(fw_wafer_written_of(p->arena, w, 0, &written), FW_OK);
        assert_int_equal(fw_wafer_write_written_order(w, &written, NULL, 0, &out), FW_OK);
        const char *line = strstr(out.data, "CD tolerance +-");
        assert_non_null(line);
        char one[200];
        snprintf(one, sizeof one, "%.*s", (int)strcspn(line, "\n"), line);
        const char *number = row[i].says + (row[i].says[0] == '+' ? 3 : 0);
        if (!strstr(one, number)) fail_msg("case %d: %s", (int)i, one);
        assert_non_null(strstr(out.data, "hinge A: at most"));
        fw_arena_free(p->arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cd_tolerance), cmocka_unit_test(test_csv), cmocka_unit_test(test_oasis),
        cmocka_unit_test(test_json),    cmocka_unit_test(test_svg), cmocka_unit_test(test_map),
        cmocka_unit_test(test_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
