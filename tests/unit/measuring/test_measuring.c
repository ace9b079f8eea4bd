/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of measurements and what is said of them, of items whose worth is known. What they are worth
   is tested where it is found: test_ranges.c, test_measurable.c, tests/cli/test_measurements.py. */
#include "measuring/measuring.h"
#include "test.h"

enum { MOST = 8 };

static fw_arena *arena;
static fw_measuring m;
static fw_measuring_item item[MOST];

static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    m = (fw_measuring){.judged_made = true,
                       .banded = true,
                       .hinge = 0,
                       .requirement = FW_NONE,
                       .what = "hinge A",
                       .band = {0.79, 1.02},
                       .decision = FW_INCONCLUSIVE};
    memset(item, 0, sizeof item);
    return arena ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_measuring_item made(const char *id, const char *name, double low, double high,
                              fw_verdict_decision decision) {
    return (fw_measuring_item){.id = id,
                               .name = name,
                               .by = "coupon undercut-ladder",
                               .made = true,
                               .value = 0.995,
                               .before = 0.0025,
                               .after = 0.0003,
                               .q = {.unit = "1"},
                               .band = {low, high},
                               .governs = "hinge A",
                               .most = high,
                               .decision = decision};
}

static void rank(int n) {
    assert_int_equal(fw_measuring_rank(arena, &m, item, n), FW_OK);
}

static void expect(int i, const char *id) {
    assert_true(i < m.nitem);
    assert_string_equal(m.item[i].id, id);
}

/* the one that dominates goes first, wherever it stood */
static void the_one_that_dominates(void **state) {
    for (int at = 0; at < 3; at++) {
        if (at > 0) teardown(state), setup(state);
        for (int i = 0; i < 3; i++)
            item[i] = i == at ? made("rie.A", "anisotropy", 0.85, 0.995, FW_INCONCLUSIVE)
                              : made(i == 2 ? "c" : "b", "edge", 0.80, 1.01, FW_INCONCLUSIVE);
        rank(3);
        assert_int_equal(m.nitem, 3);
        expect(0, "rie.A");
        assert_near(m.item[0].narrowing, 0.23 - 0.145, 1e-12);
        assert_false(m.item[0].decides);
        assert_string_equal(
            m.first, "Measure the anisotropy first (rie.A; coupon undercut-ladder): the band "
                     "of hinge A goes from 79.0..102.0 % to 85.0..99.5 %.");
    }
}

/* what decides goes before what narrows more */
static void what_decides(void **state) {
    (void)state;
    item[0] = made("a", "edge", 0.85, 0.99, FW_INCONCLUSIVE);
    item[1] = made("b", "thickness", 0.79, 0.97, FW_ACCEPT);
    rank(2);
    expect(0, "b");
    assert_true(m.item[0].decides && m.item[0].narrowing < m.item[1].narrowing);
    assert_non_null(strstr(m.first, ", and all that the flow makes is accepted."));
}

/* a flexure that is gone at a corner is the widest band of all */
static void gone(void **state) {
    (void)state;
    m.band.high = (double)INFINITY;
    item[0] = made("a", "edge", 0.79, (double)INFINITY, FW_INCONCLUSIVE);
    item[1] = made("b", "thickness", 0.79, 1.4, FW_INCONCLUSIVE);
    rank(2);
    expect(0, "b");
    assert_int_equal(m.nitem, 1);
    assert_non_null(strstr(m.first, "from 79.0 % to cut through to 79.0..140.0 %"));
    assert_string_equal(m.nothing, "edge (a)");
}

/* bands, then steps that become computable, then windows; what changes nothing is named in one line */
static void the_rest(void **state) {
    (void)state;
    static const fw_measuring_window narrow[] = {{"S14", {800, 1200}, {950, 1050}}},
                                     wide[] = {{"S18", {4800, 6000}, {5300, 5500}}};
    item[0] = (fw_measuring_item){
        .id = "w", .name = "rate", .window = narrow, .nwindow = 1, .windows = 0.3};
    item[1] = (fw_measuring_item){
        .id = "v", .name = "rate", .window = wide, .nwindow = 1, .windows = 0.2};
    item[2] = (fw_measuring_item){.id = "u",
                                  .name = "sputter rate",
                                  .unknown = true,
                                  .value = (double)NAN,
                                  .before = (double)NAN,
                                  .opens = 1,
                                  .needed = 1,
                                  .needed_for = "S03"};
    item[3] = (fw_measuring_item){.id = "t",
                                  .name = "power",
                                  .unknown = true,
                                  .value = (double)NAN,
                                  .needed = 1,
                                  .needed_for = "S03 (with sputter rate (u))"};
    item[4] = made("s", "edge", 0.79, 1.01, FW_INCONCLUSIVE);
    item[5] = made("r", "taper", 0.79, 1.02, FW_INCONCLUSIVE);
    item[6] = (fw_measuring_item){.name = "Young's modulus"};
    rank(7);
    assert_int_equal(m.nitem, 5);
    expect(0, "s"), expect(1, "u"), expect(2, "t"), expect(3, "w"), expect(4, "v");
    assert_string_equal(m.nothing, "taper (r), Young's modulus");
    fw_text text = fw_text_new(arena);
    fw_measuring_put_windows(&text, &m.item[4]);
    assert_string_equal(text.data, "S18: 80..100 to 88.33..91.67 min");
    text = fw_text_new(arena);
    fw_measuring_put_windows(&text, &m.item[1]);
    assert_string_equal(text.data, "not computable without it: S03");
    text = fw_text_new(arena);
    fw_measuring_put_value(&text, &m.item[1], false);
    assert_string_equal(text.data, "unknown");
}

/* of several windows the one is told that loses the largest share of where it lies: here by 500 s of 1200 s, 600 of 6000, and
   100 of 150 of a window that ends at 1000 s; of equal ones the first. One that was not known loses nothing. */
static void the_window_that_loses_most(void **state) {
    (void)state;
    const double unknown = (double)NAN;
    const fw_measuring_window row[] = {{"S18", {4800, 6000}, {5100, 5700}}, {"S14", {600, 1200}, {850, 950}}, {"S03", {850, 1000}, {900, 950}},
                                       {"S05", {unknown, unknown}, {1, 2}}};
    static const char *const say[] = {"S18: 80..100 to 85..95 min", "S14: 10..20 to 14.17..15.83 min, and 1 more step",
                                      "S14: 10..20 to 14.17..15.83 min, and 2 more steps", "S14: 10..20 to 14.17..15.83 min, and 3 more steps"};
    for (int n = 1; n <= 4; n++) {
        const fw_measuring_item of = {.id = "a", .window = row, .nwindow = n};
        fw_text text = fw_text_new(arena);
        fw_measuring_put_windows(&text, &of);
        assert_string_equal(text.data, say[n - 1]);
    }
    const fw_measuring_window close[] = {{"A", {1000, 1100}, {1000, 1060}}, {"B", {100, 200}, {100, 170}}};
    const fw_measuring_item of = {.id = "a", .window = close, .nwindow = 2};
    fw_text text = fw_text_new(arena);
    fw_measuring_put_windows(&text, &of);
    assert_string_equal(text.data, "B: 100..200 to 100..170 s, and 1 more step"); /* 30 of 200, against 40 of 1100 */
}

/* nothing reads it: a bound, and said so */
static void nothing_reads_it(void **state) {
    (void)state;
    item[0] = made(NULL, "Young's modulus", 0.85, 0.99, FW_INCONCLUSIVE);
    item[0].by = NULL, item[0].after = 0;
    rank(1);
    assert_string_equal(m.first,
                        "Measure Young's modulus first (nothing in this flow reads it): if it "
                        "were known exactly, the band of hinge A goes from 79.0..102.0 % to "
                        "85.0..99.0 %.");
    fw_text text = fw_text_new(arena);
    fw_measuring_put_value(&text, &m.item[0], true);
    assert_string_equal(text.data, "if known exactly");
    /* of two the one that can be read, though it is worth less */
    item[0] = made(NULL, "Young's modulus", 0.85, 0.99, FW_INCONCLUSIVE);
    item[0].by = NULL, item[0].after = 0;
    item[1] = made("litho.edge", "printed edge", 0.80, 1.01, FW_INCONCLUSIVE);
    rank(2);
    assert_null(m.item[0].id);
    assert_string_equal(
        m.first, "Measure the printed edge first (litho.edge; coupon undercut-ladder): the "
                 "band of hinge A goes from 79.0..102.0 % to 80.0..101.0 %; Young's modulus "
                 "would be worth more, 85.0..99.0 % if it were known exactly, but nothing in "
                 "this flow reads it.");
}

/* without bands the shares of the uncertainty rank; a band that gets no narrower is nothing to say */
static void first_order_and_nothing(void **state) {
    (void)state;
    m.banded = false;
    m.sigma = 0.05;
    item[0] = made("a", "edge", 0, 0, FW_INCONCLUSIVE);
    item[0].share = 0.02, item[0].share_after = 0.002;
    item[1] = made("b", "anisotropy", 0, 0, FW_INCONCLUSIVE);
    item[1].share = 0.04, item[1].share_after = 0.004;
    item[2] = made("c", "taper", 0, 0, FW_INCONCLUSIVE);
    rank(3);
    expect(0, "b"), expect(1, "a");
    assert_string_equal(m.nothing, "taper (c)");
    assert_non_null(strstr(m.first,
                           "the standard uncertainty that it brings to hinge A goes from 4 to "
                           "0.4 % of the limit, of 5 % in all."));
    m.banded = true, m.first = NULL;
    item[0] = made("a", "edge", 0.70, 1.02, FW_INCONCLUSIVE); /* wider than it was */
    rank(1);
    assert_null(m.first);
    assert_int_equal(m.nitem, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_one_that_dominates, setup, teardown),
        cmocka_unit_test_setup_teardown(what_decides, setup, teardown),
        cmocka_unit_test_setup_teardown(gone, setup, teardown),
        cmocka_unit_test_setup_teardown(the_rest, setup, teardown),
        cmocka_unit_test_setup_teardown(the_window_that_loses_most, setup, teardown),
        cmocka_unit_test_setup_teardown(nothing_reads_it, setup, teardown),
        cmocka_unit_test_setup_teardown(first_order_and_nothing, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
