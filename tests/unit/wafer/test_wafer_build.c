/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells, arrays, ids and the GDSII of the whole plate, read back record by record. */
#include "wafer/plate.h"
#include "base/output.h"
#include "mask/mask_parts.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- arrays against places ---- */

/* every place is covered once, by the cell that belongs there; nothing else is placed but ids */
static void check_runs(const plate *p, const fw_wafer *w) {
    const fw_wafer_grid *g = &w->grid;
    int *covered = fw_arena_array(p->arena, int, (size_t)g->nsite);
    for (int k = 0; k < w->nrun; k++) {
        const fw_wafer_run *r = &w->run[k];
        const fw_wafer_cell *c = &w->cell[r->cell];
        bool id = strncmp(c->name, "ROW_", 4) == 0 || strncmp(c->name, "COLUMN_", 7) == 0;
        assert_true(r->columns >= 1 && r->rows >= 1 && r->columns <= 32767 && r->rows <= 32767);
        for (int j = 0; j < r->rows && !id; j++)
            for (int i = 0; i < r->columns; i++) {
                int x = r->x + i * r->step_x - c->dx, y = r->y + j * r->step_y - c->dy, at = -1;
                for (int s = 0; s < g->nsite && at < 0; s++)
                    if (g->site[s].x == x && g->site[s].y == y) at = s;
                assert_true(at >= 0);
                covered[at]++;
                const fw_wafer_site *s = &g->site[at];
                if (s->kind == FW_WAFER_ALIGNMENT)
                    assert_string_equal(c->name, "ALIGNMENT_SITE");
                else if (s->kind == FW_WAFER_DIE && w->variant[s->variant].mask)
                    assert_ptr_equal(c->mask, w->variant[s->variant].mask);
                else if (s->kind == FW_WAFER_DIE)
                    assert_ptr_equal(c->mask, p->input.stand_in.mask);
            }
    }
    for (int s = 0; s < g->nsite; s++)
        assert_int_equal(covered[s], 1);
}

static void test_one_device(void **state) {
    (void)state;
    plate *p = plate_new(240);
    p->device.wafer.alignment = true;
    p->device.wafer.tests = 1;
    const fw_wafer *w = plate_build(p);
    check_runs(p, w);
    assert_int_equal(p->diags.count, 0);
    assert_int_equal(w->dies + w->alignments + w->tests, w->grid.nsite);
    assert_int_equal(w->alignments, 2);
    assert_int_equal(w->variant[0].dies, w->dies);
    int arrays = 0; /* one per row, two in the row that a test die divides; alignment: one more */
    for (int k = 0; k < w->nrun; k++)
        arrays += w->cell[w->run[k].cell].mask == p->variant[0].mask;
    assert_true(arrays <= w->grid.rows + 1);
    assert_string_equal(w->top, "tiny_device_WAFER");
    fw_arena_free(p->arena);
}

static void test_sweeps(void **state) {
    (void)state;
    for (int k = 0; k < 4; k++) {
        plate *p = plate_new(240);
        plate_sweep(p, 240, 4, k % 2 ? 3 : 1);
        p->device.wafer.blocks = k / 2;
        p->device.wafer.alignment = k % 2;
        if (k == 3) p->variant[2].mask = p->variant[5].mask = NULL;
        const fw_wafer *w = plate_build(p);
        check_runs(p, w);
        int dies = 0;
        for (int v = 0; v < w->nvariant; v++)
            dies += w->variant[v].dies;
        assert_int_equal(dies, w->dies);
        for (int c = 0; c < w->ncell; c++)
            for (int d = 0; d < c; d++)
                assert_string_not_equal(w->cell[c].name, w->cell[d].name);
        fw_arena_free(p->arena);
    }
}

/* ---- ids ---- */

static bool all_inside(const fw_geometry_polygon *q, int32_t dx, int32_t dy, const fw_mask *mask) {
    for (int i = 0; i < q->count; i++) {
        fw_geometry_vec2 at = {(q->vertex[i].x_dbu + dx) * 1e-9, (q->vertex[i].y_dbu + dy) * 1e-9};
        bool inside = false;
        for (int s = 0; s < mask->nshape && !inside; s++)
            inside = mask->shape[s].piece->role == FW_ROLE_FRAME &&
                     fw_geometry_contour_contains(&mask->shape[s].contour, at);
        if (!inside) return false;
    }
    return true;
}

/* distance in dbu between boxes of two polygons, the second moved */
static double apart(const fw_geometry_polygon *a, const fw_geometry_polygon *b, int32_t dx,
                    int32_t dy) {
    double least = HUGE_VAL;
    for (int i = 0; i < a->count; i++)
        for (int j = 0; j < b->count; j++) /* corners of right-angled letters: within a stroke */
            least = fmin(least, hypot(a->vertex[i].x_dbu - b->vertex[j].x_dbu - dx,
                                      a->vertex[i].y_dbu - b->vertex[j].y_dbu - dy));
    return least;
}

/* the letters over one die: in the frame, away from its own lettering and marks; names those of the
   map */
static void test_ids(void **state) {
    (void)state;
    plate *p = plate_new(240);
    p->lettering = "LETTERS ALONG ALL OF THE BAR"; /* where ids would else stand */
    plate_sweep(p, 240, 3, 1);
    p->device.wafer.alignment = true;
    const fw_wafer *w = plate_build(p);
    assert_true(w->ids);
    int lettered = 0, checked = 0;
    for (int k = 0; k < w->nrun; k++) {
        const fw_wafer_run *r = &w->run[k];
        const fw_mask *m = w->cell[r->cell].mask;
        const char *name = w->cell[r->cell].name;
        bool row = strncmp(name, "ROW_", 4) == 0, column = strncmp(name, "COLUMN_", 7) == 0;
        for (int i = 0; (row || column) && i < r->columns * r->rows; i++) {
            int32_t x = r->x + i % r->columns * r->step_x, y = r->y + i / r->columns * r->step_y;
            const fw_wafer_site *on = NULL;
            for (int s = 0; s < w->grid.nsite; s++) {
                const fw_wafer_site *t = &w->grid.site[s];
                if (x >= t->x && y >= t->y && x < t->x + w->grid.width && y < t->y + w->grid.height)
                    on = t;
            }
            assert_non_null(on);
            assert_int_equal(on->kind, FW_WAFER_DIE);
            char text[FW_WAFER_NAME];
            assert_string_equal(name + (row ? 4 : 7),
                                row ? fw_wafer_row_name(on->row, text)
                                    : fw_wafer_column_name(&w->grid, on->column, text));
            lettered++;
            if (checked++ > 200) continue;
            const fw_mask *die = w->variant[on->variant].mask;
            int32_t dx = x - on->x + (int32_t)lround(p->variant[0].die.x0 * 1e9);
            int32_t dy = y - on->y + (int32_t)lround(p->variant[0].die.y0 * 1e9);
            for (int s = 0; s < m->nshape; s++) {
                assert_true(all_inside(&m->shape[s].polygon, dx, dy, die));
                for (int t = 0; t < die->nshape; t++)
                    if (die->shape[t].piece->role == FW_ROLE_TEXT)
                        assert_true(apart(&die->shape[t].polygon, &m->shape[s].polygon, dx, dy) >
                                    10000);
            }
        }
    }
    assert_int_equal(lettered, 2 * w->dies);
    fw_arena_free(p->arena);
}

/* where bars hold 12 um strokes they are used, narrow ones get smaller letters, the narrowest none
 */
static void test_id_sizes(void **state) {
    (void)state;
    static const double bar[] = {340, 120, 80, 60};
    double before = 1;
    for (int k = 0; k < 4; k++) {
        plate *p = plate_new(bar[k]);
        const fw_wafer *w = plate_build(p);
        if (k == 0) assert_near(w->stroke_m, 12e-6, 1e-12);
        if (k < 3) assert_true(w->ids && w->stroke_m >= 5e-6 - 1e-12 && w->stroke_m <= before);
        if (k == 3) {
            assert_false(w->ids);
            assert_int_equal(p->diags.item[p->diags.count - 1].number, 193);
        }
        before = w->stroke_m;
        fw_arena_free(p->arena);
    }
}

/* ---- refusals and warnings ---- */

static void test_spaces(void **state) {
    (void)state;
    static const struct {
        double pitch_um;
        bool ok;
    } row[] = {{2000, true}, {2000.001, true}, {2003, false}, {2004, true}, {2100, true}};
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        plate *p = plate_new(240);
        p->device.wafer.pitch_x_m = row[k].pitch_um * UM;
        const fw_wafer *w = NULL;
        fw_status status = fw_wafer_build(p->arena, &p->input, &p->diags, &w);
        assert_int_equal(status, row[k].ok ? FW_OK : FW_INPUT);
        if (!row[k].ok) assert_int_equal(p->diags.item[0].number, 191);
        if (!row[k].ok) assert_says(p->diags.item[0].message, "4/0");
        fw_arena_free(p->arena);
    }
}

static void test_more_steps_than_columns(void **state) {
    (void)state;
    plate *p = plate_new(240);
    plate_sweep(p, 240, 3, 1);
    p->device.wafer.diameter_m = 12e-3;
    p->device.wafer.flat_m = 0;
    const fw_wafer *w = plate_build(p);
    int without = 0;
    for (int v = 0; v < w->nvariant; v++)
        without += w->variant[v].dies == 0;
    bool said = false;
    for (size_t i = 0; i < p->diags.count; i++)
        said = said || p->diags.item[i].number == 195;
    assert_int_equal(said, without > 0);
    check_runs(p, w);
    fw_arena_free(p->arena);
}

static void test_rejected(void **state) {
    (void)state;
    plate *p = plate_new(240);
    plate_sweep(p, 240, 3, 1);
    p->variant[1].mask =
        die_mask(p, 240, 250, "TINY", true, &p->variant[1].die, &p->variant[1].window);
    const fw_wafer *w = plate_build(p);
    assert_true(w->rejected);
    assert_non_null(strstr(w->top, "REJECTED"));
    fw_arena_free(p->arena);
}

/* ---- GDSII, read by itself ---- */

typedef struct reader {
    const unsigned char *data;
    size_t n, at;
    int kind;
    size_t length; /* of the payload */
    const unsigned char *payload;
} reader;

static bool next(reader *r) {
    if (r->at + 4 > r->n) return false;
    size_t whole = (size_t)r->data[r->at] << 8 | r->data[r->at + 1];
    assert_true(whole >= 4 && whole % 2 == 0 && whole < 0x8000 && r->at + whole <= r->n);
    r->kind = r->data[r->at + 2];
    r->payload = r->data + r->at + 4;
    r->length = whole - 4;
    r->at += whole;
    return true;
}

static int64_t i32(const reader *r, size_t k) {
    const unsigned char *b = r->payload + 4 * k;
    return (int32_t)((uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3]);
}

typedef struct cell {
    char name[40];
    double area[64]; /* dbu^2 per layer, with children */
    long placed;     /* boundaries with children */
} cell;

static int find(const cell *c, int n, const char *name) {
    for (int i = 0; i < n; i++)
        if (strcmp(c[i].name, name) == 0) return i;
    return -1;
}

static void read_name(const reader *r, char name[40]) {
    assert_true(r->length <= 32);
    memcpy(name, r->payload, r->length);
    name[r->length] = '\0';
    assert_int_equal(
        strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_"),
        strlen(name));
}

/* cells in order; a reference to a cell that was not complete before fails */
static int read_library(const char *data, size_t n, cell *c, int most) {
    reader r = {.data = (const unsigned char *)data, .n = n};
    int cells = 0, layer = 0, child = -1, times = 1, columns = 1, rows = 1, element = 0;
    bool used[256] = {false}, ended = false;
    while (next(&r)) {
        assert_false(ended);
        if (r.kind == 0x01 || r.kind == 0x05)
            for (size_t i = 0; i < r.length; i++)
                assert_int_equal(r.payload[i], 0); /* dates */
        if (r.kind == 0x06) {
            char name[40];
            read_name(&r, name);
            assert_int_equal(find(c, cells, name), -1);
            assert_true(cells < most);
            c[cells] = (cell){.placed = 0};
            memcpy(c[cells++].name, name, sizeof name);
        }
        if (r.kind == 0x08 || r.kind == 0x0a || r.kind == 0x0b || r.kind == 0x0c) element = r.kind;
        if (r.kind == 0x0d) layer = r.payload[0] << 8 | r.payload[1];
        if (r.kind == 0x12) {
            char name[40];
            read_name(&r, name);
            child = find(c, cells - 1, name);
            assert_true(child >= 0);
            used[child] = true;
            columns = rows = times = 1;
        }
        if (r.kind == 0x13) {
            columns = r.payload[0] << 8 | r.payload[1];
            rows = r.payload[2] << 8 | r.payload[3];
            times = columns * rows;
            assert_true(times > 1);
        }
        if (r.kind == 0x10 && element == 0x0b) {
            assert_int_equal(r.length, 24);
            assert_int_equal((i32(&r, 2) - i32(&r, 0)) % columns, 0);
            assert_int_equal((i32(&r, 5) - i32(&r, 1)) % rows, 0);
            assert_int_equal(i32(&r, 3), i32(&r, 1));
            assert_int_equal(i32(&r, 4), i32(&r, 0));
        }
        if (r.kind == 0x10 && element == 0x08) {
            int64_t twice = 0;
            for (size_t i = 0; i + 1 < r.length / 8; i++)
                twice +=
                    i32(&r, 2 * i) * i32(&r, 2 * i + 3) - i32(&r, 2 * i + 2) * i32(&r, 2 * i + 1);
            c[cells - 1].area[layer] += 0.5 * (double)twice;
            c[cells - 1].placed++;
        }
        if (r.kind == 0x11 && (element == 0x0a || element == 0x0b)) {
            for (int k = 0; k < 64; k++)
                c[cells - 1].area[k] += times * c[child].area[k];
            c[cells - 1].placed += times * c[child].placed;
        }
        ended = r.kind == 0x04;
    }
    assert_true(ended);
    assert_int_equal(r.at, n);
    for (int i = 0; i + 1 < cells; i++)
        assert_true(used[i]); /* one top cell */
    return cells;
}

static void test_gds(void **state) {
    (void)state;
    static cell c[256];
    for (int k = 0; k < 2; k++) {
        plate *p = plate_new(240);
        p->device.wafer.alignment = true;
        if (k) plate_sweep(p, 240, 4, 2);
        const fw_wafer *w = plate_build(p);
        fw_text gds = fw_text_new(p->arena), again = fw_text_new(p->arena);
        assert_int_equal(fw_wafer_write_gds(w, &gds), FW_OK);
        assert_int_equal(fw_wafer_write_gds(w, &again), FW_OK);
        assert_int_equal(gds.length, again.length);
        assert_memory_equal(gds.data, again.data, gds.length);
        int n = read_library(gds.data, gds.length, c, 256);
        assert_string_equal(c[n - 1].name, w->top);
        assert_int_equal(n, w->ncell + 1);
        double area[5] = {0};
        for (int s = 0; s < w->grid.nsite; s++) { /* place by place, from the masks themselves */
            const fw_wafer_site *t = &w->grid.site[s];
            const fw_mask *m = t->variant >= 0 ? w->variant[t->variant].mask : NULL;
            for (int i = 0; m && i < m->nshape; i++)
                area[m->shape[i].layer] +=
                    0.5 * (double)fw_geometry_polygon_area2(&m->shape[i].polygon);
        }
        assert_relative(c[n - 1].area[4], area[3], 1e-12);
        assert_true(c[n - 1].area[1] > area[0]);       /* plate and alignment besides */
        assert_true(c[n - 1].area[2] > 1.2 * area[1]); /* ids besides */
        fw_arena_free(p->arena);
    }
}

/* ---- what <order> puts on the plate ---- */

/* ISO/IEC 16388, sign by sign: bar, gap, bar, ...; 1 is wide */
static const char *const code_39[] = {
    "0000110100", "1100100001", "2001100001", "3101100000", "4000110001", "5100110000",
    "6001110000", "7000100101", "8100100100", "9001100100", "A100001001", "B001001001",
    "C101001000", "D000011001", "E100011000", "F001011000", "G000001101", "H100001100",
    "I001001100", "J000011100", "K100000011", "L001000011", "M101000010", "N000010011",
    "O100010010", "P001010010", "Q000000111", "R100000110", "S001000110", "T000010110",
    "U110000001", "V011000001", "W111000000", "X010010001", "Y110010000", "Z011010000",
    "-010000101", ".110000100", " 011000100", "*010010100", "$010101000", "/010100010",
    "+010001010", "%000101010"};

typedef struct bar {
    double from, to;
} bar;

static int by_from(const void *left, const void *right) {
    const bar *p = left, *q = right;
    return (p->from > q->from) - (p->from < q->from);
}

/* the bars as drawn, upwards, without the process bias */
static int bars_of(const plate *p, const fw_wafer *w, bar list[600]) {
    int n = 0;
    for (int i = 0; i < w->plate->nshape; i++) {
        const fw_mask_shape *s = &w->plate->shape[i];
        if (strcmp(s->piece->label, "barcode") != 0) continue;
        double bias = p->input.mask.bias_m;
        assert_true(s->box.x1 < -0.5 * w->form.diameter_m && n < 600);
        assert_true(s->box.x0 > -0.5 * w->form.plate_m + 4.9e-3);
        list[n++] = (bar){s->box.y0 + bias, s->box.y1 - bias};
    }
    if (n) qsort(list, (size_t)n, sizeof *list, by_from);
    return n;
}

static char sign_of(const char *elements) {
    for (size_t k = 0; k < sizeof code_39 / sizeof code_39[0]; k++)
        if (memcmp(code_39[k] + 1, elements, 9) == 0) return code_39[k][0];
    return '?';
}

static void test_barcode(void **state) {
    (void)state;
    static const char *const text[] = {"ABCDEFGHIJKL",
                                       "MNOPQRSTUVWX",
                                       "YZ0123456789",
                                       "-. $/+%",
                                       "A",
                                       "FLEXWRIGHT-1 REV C 2026 $/+%"};
    for (size_t t = 0; t < sizeof text / sizeof text[0]; t++) {
        plate *p = plate_new(240);
        p->device.wafer.plate_m = 127e-3;
        p->device.wafer.order.barcode = text[t];
        const fw_wafer *w = plate_build(p);
        assert_int_equal(p->diags.count, 0);
        bar list[600];
        char element[1200], read[64];
        int n = bars_of(p, w, list), m = 0, signs = 0;
        assert_int_equal(n, 5 * (int)(strlen(text[t]) + 2));
        double narrow = HUGE_VAL;
        for (int i = 0; i < n; i++)
            narrow = fmin(narrow, list[i].to - list[i].from);
        assert_true(narrow >= 100e-6 - 1e-12 && narrow <= 250e-6 + 1e-12);
        for (int i = 0; i < n; i++) {
            element[m++] = list[i].to - list[i].from > 2 * narrow ? '1' : '0';
            if (i + 1 < n) element[m++] = list[i + 1].from - list[i].to > 2 * narrow ? '1' : '0';
        }
        for (int i = 0; i + 9 <= m; i += 10)
            read[signs++] = sign_of(element + i);
        read[signs] = '\0';
        assert_int_equal(read[0], '*');
        assert_int_equal(read[signs - 1], '*');
        read[signs - 1] = '\0';
        assert_string_equal(read + 1, text[t]);
        fw_arena_free(p->arena);
    }
    plate *p = plate_new(240); /* 42 signs at 0.1 mm are 67 mm: too long for a plate of 3 inches */
    p->device.wafer.order.barcode = "0123456789012345678901234567890123456789";
    const fw_wafer *w = plate_build(p);
    bar list[600];
    assert_int_equal(bars_of(p, w, list), 0);
    assert_int_equal(p->diags.count, 1);
    assert_int_equal(p->diags.item[0].number, 195);
    fw_arena_free(p->arena);
}

/* its inner edge lies on the flat, scaled as the dies are: the chord as long as that, on its side; and left out with a warning
   where that reaches the lettering */
static void test_flat_line(void **state) {
    (void)state;
    for (int k = 0; k < 16; k++) {
        const fw_device_wafer_side side = (fw_device_wafer_side)(k % 4);
        const double scale = (const double[]){1, 0.98, 1.1, 1.04}[k / 4];
        plate *p = plate_new(240);
        p->device.wafer.order.scale = scale;
        p->device.wafer.side = side;
        p->device.wafer.order.flat_line = true;
        const fw_wafer *w = plate_build(p);
        double half = 0.5 * scale * w->form.flat_m, r = 0.5 * scale * w->form.diameter_m;
        double bias = p->input.mask.bias_m, away = sqrt(r * r - half * half) - bias;
        int lines = 0;
        for (int i = 0; i < w->plate->nshape; i++) {
            const fw_mask_shape *s = &w->plate->shape[i];
            if (strcmp(s->piece->label, "flat line") != 0) continue;
            const double to[4] = {-s->box.y1, s->box.y0, -s->box.x1, s->box.x0};
            bool along_x = side == FW_SIDE_BOTTOM || side == FW_SIDE_TOP;
            assert_near(to[side], away, 1e-9);
            assert_near(along_x ? s->box.x1 : s->box.y1, half + bias, 1e-9);
            lines++;
        }
        assert_int_equal(lines, scale < 1.05);
        assert_int_equal(p->diags.count, scale > 1.05);
        fw_arena_free(p->arena);
    }
}

/* dies too small for the marks of the pairs of plates on their alignment sites say so, and those of the size that is named
   have all of them: the cross of the site, and in four places the bars of a mark */
static void test_small_sites(void **state) {
    (void)state;
    double least_um = 0.0;
    for (int k = 0; k < 4; k++) {
        const double side_um[] = {700, least_um - 1, least_um, 2000};
        plate *p = plate_new(240);
        die_um[0] = die_um[1] = side_um[k];
        char *xml;
        size_t n;
        const char *path = FW_TEST_SOURCE_DIR "/masks/silicon-on-glass.xml";
        assert_int_equal(fw_input_read(p->arena, path, 1 << 20, &p->diags, &xml, &n), FW_OK);
        assert_int_equal(fw_mask_table_read(p->arena, path, xml, n, &p->diags, &p->table), FW_OK);
        fw_wafer_variant *v = &p->input.stand_in;
        v->mask = die_mask(p, 100, 100, "TINY", false, &v->die, &v->window);
        p->variant[0] = *v;
        p->device.wafer.alignment = true;
        const fw_wafer *w = plate_build(p);
        const char *named = NULL;
        for (size_t i = 0; i < p->diags.count; i++)
            if (p->diags.item[i].number == 620)
                named = strstr(p->diags.item[i].message, "a die of ");
        assert_int_equal(named != NULL, side_um[k] < least_um || k == 0);
        if (k == 0) assert_int_equal(sscanf(named, "a die of %lf um by", &least_um), 1);
        int windows = 0, crosses = 0;
        for (int c = 0; c < w->ncell; c++)
            for (int i = 0;
                 strcmp(w->cell[c].name, "ALIGNMENT_SITE") == 0 && i < w->cell[c].mask->nshape;
                 i++) {
                windows +=
                    strcmp(w->cell[c].mask->shape[i].piece->label, "window of the back mark") == 0;
                crosses += strcmp(w->cell[c].mask->shape[i].piece->label, "alignment site") == 0;
            }
        assert_int_equal(crosses, 2); /* the block and the cross in it */
        assert_true(named ? windows == 0 : windows >= 4);
        fw_arena_free(p->arena);
        die_um[0] = 2000, die_um[1] = 1600;
    }
}

/* A drawing that is to stand beside the dies is refused where it lies on the place of a die, meets its edge or leaves the plate, and
   is on the plate elsewhere. The dies of 2 mm x 1.6 mm stand without a street on a plate of 3 inches. */
static void test_cells_stand_beside_the_dies(void **state) {
    (void)state;
    const double side = 100e-6, nm = 1e-9;
    for (int k = 0; k < 8; k++) {
        plate *p = plate_new(240);
        const fw_wafer *w = plate_build(p);
        const fw_wafer_site *low = w->grid.site,
                            *high = w->grid.site; /* first of the lowest row, last of the highest */
        for (int i = 0; i < w->grid.nsite; i++) {
            const fw_wafer_site *s = &w->grid.site[i];
            if (s->y < low->y) low = s;
            if (s->y >= high->y) high = s;
        }
        const double half = 0.5 * w->form.plate_m, top = (high->y + (double)w->grid.height) * nm;
        const struct {
            double x, y; /* its lower left corner */
            bool beside;
        } at[8] = {
            {low->x * nm + 1e-3, low->y * nm + 1e-3, false},
            {high->x * nm + 1e-3, top - 1e-3, false},
            {high->x * nm + 1e-3, top - nm, false},
            {high->x * nm + 1e-3, top + nm, true},
            {low->x * nm + 1e-3, low->y * nm - side - nm, true},
            {-half, half - side, true},
            {half - side + nm, -half, false},
            {-half, -half - nm, false},
        };
        fw_geometry_contour box;
        const fw_geometry_box own = {at[k].x, at[k].y, at[k].x + side, at[k].y + side};
        assert_int_equal(fw_geometry_contour_rectangle(p->arena, own, &box), FW_OK);
        const fw_drawing_cell_layer drawn = {.to = "marks", .outline = &box, .n = 1, .box = own};
        fw_device_cell_layer layer = {.to = "marks", .drawn = &drawn, .role = FW_ROLE_MARK};
        fw_device_cell logo = {.name = "logo", .layer = &layer, .nlayer = 1};
        p->device.wafer.cell = &logo, p->device.wafer.ncell = 1;
        const fw_status status = fw_wafer_build(p->arena, &p->input, &p->diags, &w);
        int refused = 0, there = 0;
        for (size_t i = 0; i < p->diags.count; i++)
            refused += p->diags.item[i].number == 571;
        for (int i = 0; status == FW_OK && i < w->plate->nshape; i++)
            there += strcmp(w->plate->shape[i].piece->label, "cell logo") == 0;
        if (refused != !at[k].beside || there != at[k].beside || (status == FW_OK) != at[k].beside)
            fail_msg("place %d", k);
        fw_arena_free(p->arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_barcode),     cmocka_unit_test(test_flat_line),
        cmocka_unit_test(test_one_device),  cmocka_unit_test(test_sweeps),
        cmocka_unit_test(test_ids),         cmocka_unit_test(test_id_sizes),
        cmocka_unit_test(test_spaces),      cmocka_unit_test(test_more_steps_than_columns),
        cmocka_unit_test(test_rejected),    cmocka_unit_test(test_gds),
        cmocka_unit_test(test_small_sites), cmocka_unit_test(test_cells_stand_beside_the_dies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
