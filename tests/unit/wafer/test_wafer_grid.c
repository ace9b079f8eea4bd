/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whole dies on a wafer: against counts in closed form, a search over corners in doubles, and
   the sizes of SEMI M1. */
#include "mask/scene.h"
#include "wafer/wafer.h"

static fw_device_wafer_asked asked(double diameter_m, double flat_m, double edge_m) {
    double none = (double)NAN;
    return (fw_device_wafer_asked){.asked = true,
                                   .diameter_m = diameter_m,
                                   .flat_m = flat_m,
                                   .edge_m = edge_m,
                                   .pitch_x_m = none,
                                   .pitch_y_m = none,
                                   .plate_m = none};
}

typedef struct bench {
    fw_arena *arena;
    fw_diags diags;
    fw_wafer_form form;
    fw_wafer_grid grid;
} bench;

static bench begin(void) {
    fw_arena *arena = fw_arena_new(0);
    return (bench){.arena = arena, .diags = fw_diags_new(arena)};
}

static int fill(bench *b, const fw_device_wafer_asked *a, double width_m, double height_m) {
    assert_int_equal(fw_wafer_form_of(a, &b->diags, &b->form), FW_OK);
    assert_int_equal(fw_wafer_grid_fill(b->arena, &b->form, a, (int32_t)lround(width_m * 1e9),
                                        (int32_t)lround(height_m * 1e9), &b->diags, &b->grid),
                     FW_OK);
    return b->grid.nsite;
}

static void end(bench *b) {
    fw_arena_free(b->arena);
}

/* ---- closed form: unit squares of a lattice whose corner is the centre of a circle of radius n:
   4 sum over k = 1..n of floor(sqrt(n^2 - k^2)) ---- */
static void test_squares_in_a_circle(void **state) {
    (void)state;
    bench b = begin();
    for (int n = 6; n <= 60; n++) {
        long expected = 0;
        for (int k = 1; k <= n; k++) {
            long root = 0;
            while ((root + 1) * (root + 1) + (long)k * k <= (long)n * n)
                root++;
            expected += 4 * root;
        }
        fw_device_wafer_asked a = asked(2e-3 * n, 0, 0);
        a.diameter_m = 2e-3 * n;
        a.centre = FW_CENTRE_STREET;
        if (fw_wafer_form_of(&a, &b.diags, &b.form) != FW_OK) fail();
        if (b.form.diameter_m != a.diameter_m) continue; /* taken for a usual size */
        assert_int_equal(fill(&b, &a, 1e-3, 1e-3), expected);
    }
    end(&b);
}

/* 3 mm on 3.5 mm inside a circle of 94 mm: 517 dies, as other tools count them */
static void test_517_dies(void **state) {
    (void)state;
    bench b = begin();
    fw_device_wafer_asked a = asked(0.1, 0, 3e-3);
    a.pitch_x_m = a.pitch_y_m = 3.5e-3;
    a.centre = FW_CENTRE_DIE;
    assert_int_equal(fill(&b, &a, 3e-3, 3e-3), 517);
    a.centre = FW_CENTRE_AUTO;
    assert_true(fill(&b, &a, 3e-3, 3e-3) >= 517);
    end(&b);
}

/* ---- an independent decision: corners in the circle, beyond the chord, far from the notch ---- */
static void turned(fw_device_wafer_side side, double *x, double *y) {
    double u = *x, v = *y; /* so that the flat is at the bottom */
    if (side == FW_SIDE_TOP) *y = -v;
    if (side == FW_SIDE_LEFT) *x = v, *y = u;
    if (side == FW_SIDE_RIGHT) *x = v, *y = -u;
}

static bool corner_fits(const fw_device_wafer_asked *a, double diameter, double flat, int64_t x_dbu,
                        int64_t y_dbu) {
    double x = (double)x_dbu * 1e-9, y = (double)y_dbu * 1e-9, r = 0.5 * diameter;
    turned(a->side, &x, &y);
    if (hypot(x, y) > r - a->edge_m + 1e-14) return false;
    return flat == 0 || y >= -(sqrt(r * r - 0.25 * flat * flat) - a->edge_m) - 0.5e-9;
}

/* the sides of the die in steps of 20 um: corners alone do not see a notch between them */
static bool misses_notch(const fw_device_wafer_asked *a, double diameter, const fw_wafer_grid *g,
                         int64_t x_dbu, int64_t y_dbu) {
    double near = 1.25e-3 + a->edge_m - 1e-14, r = 0.5 * diameter;
    for (int side = 0; side < 4; side++)
        for (int64_t t = 0; t <= (side % 2 ? g->height : g->width); t += 20000) {
            int64_t along_x = side % 2 ? (side / 2) * g->width : t;
            int64_t along_y = side % 2 ? t : (side / 2) * g->height;
            double x = (double)(x_dbu + along_x) * 1e-9, y = (double)(y_dbu + along_y) * 1e-9;
            turned(a->side, &x, &y);
            if (hypot(x, y + r) < near) return false;
        }
    return true;
}

static void search(bench *b, const fw_device_wafer_asked *a, double diameter, double flat,
                   bool notch) {
    const fw_wafer_grid *g = &b->grid;
    int found = 0;
    int64_t x0 = g->site[0].x, y0 = g->site[0].y;
    for (int j = -300; j <= 300; j++)
        for (int i = -300; i <= 300; i++) {
            bool fits = true;
            int64_t x = x0 + (int64_t)i * g->pitch_x, y = y0 + (int64_t)j * g->pitch_y;
            if (x < -200000000 || x > 200000000 || y < -200000000 || y > 200000000) continue;
            for (int k = 0; k < 4 && fits; k++)
                fits = corner_fits(a, diameter, flat, x + k % 2 * g->width, y + k / 2 * g->height);
            if (fits && notch) fits = misses_notch(a, diameter, g, x, y);
            found += fits;
        }
    assert_int_equal(found, g->nsite);
}

static void check_order(const fw_wafer_grid *g) {
    int row = 0, column = -1, top = 0, left = 0;
    for (int i = 0; i < g->nsite; i++) {
        const fw_wafer_site *s = &g->site[i];
        assert_true(s->row > row || (s->row == row && s->column > column));
        assert_true(s->row < g->rows && s->column < g->columns && s->column >= 0);
        assert_int_equal(s->x - g->site[0].x, (s->column - g->site[0].column) * g->pitch_x);
        assert_int_equal(s->y - g->site[0].y, -s->row * g->pitch_y);
        row = s->row;
        column = s->column;
        top += s->row == 0;
        left += s->column == 0;
    }
    assert_true(top > 0 && left > 0);
}

static void test_against_search(void **state) {
    (void)state;
    static const struct {
        double diameter, flat;
        bool notch;
    } wafer[] = {{50.8e-3, 15.88e-3, false},
                 {76.2e-3, 22.22e-3, false},
                 {0.1, 32.5e-3, false},
                 {0.15, 57.5e-3, false},
                 {0.2, 0, true}};
    uint64_t seed = 7;
    for (int k = 0; k < 60; k++) {
        bench b = begin();
        int which = k % 5;
        fw_device_wafer_asked a = asked(wafer[which].diameter, (double)NAN, 1e-3 * (1 + k % 4));
        a.side = (fw_device_wafer_side)(k % 4);
        a.centre = (fw_device_wafer_centre)(k / 5 % 3);
        double w = 1e-9 * floor(1e9 * (2e-3 + 6e-3 * random01(&seed)));
        double h = 1e-9 * floor(1e9 * (2e-3 + 6e-3 * random01(&seed)));
        a.pitch_x_m = w + 1e-4 * (k % 3);
        fill(&b, &a, w, h);
        search(&b, &a, wafer[which].diameter, wafer[which].flat, wafer[which].notch);
        check_order(&b.grid);
        end(&b);
    }
}

/* the best centre is never worse than those that can be asked for */
static void test_auto_is_best(void **state) {
    (void)state;
    for (int k = 0; k < 30; k++) {
        bench b = begin();
        fw_device_wafer_asked a = asked(0.1, (double)NAN, 3e-3);
        double size = 3e-3 + 0.137e-3 * k;
        int best = fill(&b, &a, size, size);
        a.centre = FW_CENTRE_DIE;
        assert_true(fill(&b, &a, size, size) <= best);
        a.centre = FW_CENTRE_STREET;
        assert_true(fill(&b, &a, size, size) <= best);
        assert_int_equal(b.grid.columns % 2, 0);
        end(&b);
    }
}

/* a rectangle that touches each border is in, one a nanometre larger is not */
static void test_borders(void **state) {
    (void)state;
    bench b = begin();
    fw_device_wafer_asked a = asked(0.1, (double)NAN, 3e-3);
    assert_int_equal(fw_wafer_form_of(&a, &b.diags, &b.form), FW_OK);
    assert_near((double)b.form.flat_dbu, 1e9 * (sqrt(0.05 * 0.05 - 0.01625 * 0.01625) - 3e-3),
                0.51);
    /* 28.2 - 37.6 - 47 is 3 - 4 - 5 */
    assert_true(fw_wafer_holds(&b.form, 0, 0, 28200000, 37600000));
    assert_false(fw_wafer_holds(&b.form, 0, 0, 28200001, 37600000));
    assert_true(fw_wafer_holds(&b.form, -28200000, 0, 0, 37600000));
    assert_false(fw_wafer_holds(&b.form, -28200000, 0, 0, 37600001));
    assert_true(fw_wafer_holds(&b.form, -1, -b.form.flat_dbu, 1, 0));
    assert_false(fw_wafer_holds(&b.form, -1, -b.form.flat_dbu - 1, 1, 0));
    a = asked(0.2, (double)NAN, 2e-3);
    assert_int_equal(fw_wafer_form_of(&a, &b.diags, &b.form), FW_OK);
    int64_t near = 100000000 - 3250000; /* 1.25 mm of notch and 2 mm of exclusion above the rim */
    assert_true(fw_wafer_holds(&b.form, -1000, -near, 1000, 0));
    assert_false(fw_wafer_holds(&b.form, -1000, -near - 1, 1000, 0));
    end(&b);
}

static void refused(fw_device_wafer_asked a, int number, const char *part) {
    bench b = begin();
    fw_status status = fw_wafer_form_of(&a, &b.diags, &b.form);
    if (status == FW_OK)
        status = fw_wafer_grid_fill(b.arena, &b.form, &a, 3000000, 3000000, &b.diags, &b.grid);
    assert_int_equal(status, FW_INPUT);
    assert_int_equal(b.diags.item[0].number, number);
    if (!strstr(b.diags.item[0].message, part))
        fail_msg("\"%s\" does not say \"%s\"", b.diags.item[0].message, part);
    end(&b);
}

static void test_refusals(void **state) {
    (void)state;
    refused(asked(0.09, (double)NAN, 3e-3), 190, "state flat");
    refused(asked(0.1, 0.1, 3e-3), 190, "chord");
    refused(asked(0.1, 0, 0.05), 190, "nothing is left");
    refused(asked(0.1, 0, 0.0489), 190, "no die");
    fw_device_wafer_asked a = asked(0.1, 0, 3e-3);
    a.plate_m = 0.105;
    refused(a, 190, "plate");
    a = asked(0.1, 0, 3e-3);
    a.pitch_y_m = 2.9999e-3;
    refused(a, 191, "pitch-y");
    bench b = begin();
    a = asked(0.3, (double)NAN, 3e-3);
    assert_int_equal(fw_wafer_form_of(&a, &b.diags, &b.form), FW_OK);
    assert_int_equal(fw_wafer_grid_fill(b.arena, &b.form, &a, 500000, 500000, &b.diags, &b.grid),
                     FW_INPUT);
    assert_says(b.diags.item[0].message, "20000");
    end(&b);
}

/* a wafer of four inches is 100 mm and so on; plates as they are sold */
static void test_usual_sizes(void **state) {
    (void)state;
    static const double size[][4] = {/* asked, diameter, flat, plate: mm */
                                     {51, 50.8, 15.88, 76.2}, {76, 76.2, 22.22, 101.6},
                                     {101.6, 100, 32.5, 127}, {125, 125, 42.5, 152.4},
                                     {152, 150, 57.5, 177.8}, {200, 200, 0, 228.6},
                                     {300, 300, 0, 355.6}};
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++) {
        bench b = begin();
        fw_device_wafer_asked a = asked(1e-3 * size[i][0], (double)NAN, 3e-3);
        assert_int_equal(fw_wafer_form_of(&a, &b.diags, &b.form), FW_OK);
        assert_relative(b.form.diameter_m, 1e-3 * size[i][1], 1e-12);
        assert_near(b.form.flat_m, 1e-3 * size[i][2], 1e-12);
        assert_relative(b.form.plate_m, 1e-3 * size[i][3], 1e-12);
        assert_int_equal(b.form.notch_m > 0, size[i][2] == 0);
        end(&b);
    }
}

static void test_names(void **state) {
    (void)state;
    char name[FW_WAFER_NAME];
    assert_string_equal(fw_wafer_row_name(0, name), "A");
    assert_string_equal(fw_wafer_row_name(25, name), "Z");
    assert_string_equal(fw_wafer_row_name(26, name), "AA");
    assert_string_equal(fw_wafer_row_name(53, name), "BB");
    assert_string_equal(fw_wafer_row_name(701, name), "ZZ");
    assert_string_equal(fw_wafer_row_name(702, name), "AAA");
    fw_wafer_grid g = {.columns = 27};
    assert_string_equal(fw_wafer_column_name(&g, 6, name), "07");
    g.columns = 100;
    assert_string_equal(fw_wafer_column_name(&g, 6, name), "007");
}

/* a square over all, one beyond, halves by either axis, one that the flat cuts, and the four quarters of a corner: the parts
   add up to the wafer, and the flat is on its own side */
static void test_area_over(void **state) {
    (void)state;
    const double R = 50e-3, half = 16.25e-3, h = sqrt(R * R - half * half);
    const double disc = acos(-1.0) * R * R, segment = R * R * acos(h / R) - half * h;
    static const struct {
        fw_device_wafer_side side;
        double x, y;
    } flat[] = {{FW_SIDE_BOTTOM, 0, -1}, {FW_SIDE_TOP, 0, 1}, {FW_SIDE_LEFT, -1, 0}, {FW_SIDE_RIGHT, 1, 0}};
    for (size_t k = 0; k < sizeof flat / sizeof *flat; k++) {
        const fw_wafer_form form = {.diameter_m = 2 * R, .flat_m = 2 * half, .side = flat[k].side};
        static const int32_t edge[] = {-60000000, -48000000, -47280000, -10000000, 3000000, 47300000, 60000000};
        enum { N = sizeof edge / sizeof *edge };
        double sum = 0, over[2] = {0, 0};
        for (int i = 0; i + 1 < N; i++)
            for (int j = 0; j + 1 < N; j++) {
                fw_geometry_point p[4] = {{edge[i], edge[j]}, {edge[i + 1], edge[j]}, {edge[i + 1], edge[j + 1]}, {edge[i], edge[j + 1]}};
                const fw_geometry_polygon q = {p, 4};
                const double is = fw_wafer_area_over(&form, &q), whole = 1e-18 * (edge[i + 1] - edge[i]) * (double)(edge[j + 1] - edge[j]);
                assert_true(is >= -1e-15 && is <= whole * (1 + 1e-12));
                if (i == 3 && j == 3) assert_true(fabs(is / whole - 1) < 1e-12); /* inside */
                sum += is;
            }
        assert_true(fabs(fw_wafer_area(&form) - (disc - segment)) < 1e-12);
        assert_true(fabs(sum - (disc - segment)) < 1e-12);
        for (int way = 0; way < 2; way++) { /* beyond the chord of the flat there is something on the other side alone */
            const double a = way ? -1 : 1, cut = 47.3e-3;
            const double x0 = flat[k].x * a * cut, y0 = flat[k].y * a * cut;
            const double x1 = flat[k].x * a * 60e-3, y1 = flat[k].y * a * 60e-3;
            const double sx = flat[k].y * 60e-3, sy = flat[k].x * 60e-3;
            fw_geometry_point p[4] = {{(int32_t)lround(1e9 * (x0 - sx)), (int32_t)lround(1e9 * (y0 - sy))},
                                      {(int32_t)lround(1e9 * (x0 + sx)), (int32_t)lround(1e9 * (y0 + sy))},
                                      {(int32_t)lround(1e9 * (x1 + sx)), (int32_t)lround(1e9 * (y1 + sy))},
                                      {(int32_t)lround(1e9 * (x1 - sx)), (int32_t)lround(1e9 * (y1 - sy))}};
            const fw_geometry_polygon q = {p, 4};
            over[way] = fabs(fw_wafer_area_over(&form, &q));
        }
        const double cap = R * R * acos(47.3e-3 / R) - 47.3e-3 * sqrt(R * R - 47.3e-3 * 47.3e-3);
        assert_true(over[0] < 1e-12 && fabs(over[1] - cap) < 1e-12);
        fw_geometry_point beyond[4] = {{51000000, 0}, {52000000, 0}, {52000000, 1000000}, {51000000, 1000000}};
        assert_true(fabs(fw_wafer_area_over(&form, &(fw_geometry_polygon){beyond, 4})) < 1e-15);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_squares_in_a_circle),
        cmocka_unit_test(test_517_dies),
        cmocka_unit_test(test_against_search),
        cmocka_unit_test(test_auto_is_best),
        cmocka_unit_test(test_borders),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_usual_sizes),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_area_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
