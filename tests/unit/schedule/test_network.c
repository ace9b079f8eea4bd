/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The temporal network: known windows of the copper flow, and random ones against Floyd and
   Warshall on all starts, written here a second time. */
#include "shops.h"

static fw_arena *arena;
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_schedule_hold hold(const char *from, const char *to, double min_min, double max_min) {
    return hold_of(find_row(cu_rows, CU_ROWS, from), find_row(cu_rows, CU_ROWS, to), 60.0 * min_min,
                   60.0 * max_min);
}

/* wet transfer, rehydration and descum: feasible, and one wafer takes 444.04 min; with the seed
   exposed within 90 min of its drying 122 min lie between */
static void windows(void **state) {
    (void)state;
    fw_schedule_shop shop = shop_of(arena, cu_rows, CU_ROWS, 1, 0);
    fw_schedule_hold holds[] = {hold("C05", "C07", 0, 10), hold("C13", "C16", 77, 1440),
                                hold("C20", "C22", 0, 15), hold("C08", "C16", 0, 90)};
    const char *why;
    double earliest[CU_ROWS];
    bool ok;
    int failing;
    shop.hold = holds;
    shop.nhold = 3;
    assert_int_equal(fw_schedule_network_conflict(arena, &shop, false, &why), FW_OK);
    assert_null(why);
    assert_int_equal(fw_schedule_network_earliest(&shop, 0.0, earliest, &ok, &failing), FW_OK);
    assert_true(ok);
    assert_near(earliest[CU_ROWS - 1] + shop.task[CU_ROWS - 1].duration_s, 444.04 * 60.0, 1e-6);
    shop.nhold = 4;
    assert_int_equal(fw_schedule_network_conflict(arena, &shop, false, &why), FW_OK);
    assert_string_equal(why,
                        "C16 must start within 90 min of the end of C08, but what lies between "
                        "takes 2 h 2 min (C09 10 min, C10 4 min, C11 8 min, C12 4 min, C13 16 "
                        "min, C14 3 min, C15 77 min): 32 min too long");
}

/* two windows against one least time; and a window that only the stop time breaks */
static void chains(void **state) {
    (void)state;
    const row rows[] = {
        {"A", "a", 1, 5, 0}, {"B", "b", 1, 7, 0}, {"C", "c", 1, 3, 0}, {"D", "d", 1, 2, 0}};
    fw_schedule_shop shop = shop_of(arena, rows, 4, 1, 0);
    fw_schedule_hold holds[] = {hold_of(0, 2, 0.0, 600.0), hold_of(1, 3, 0.0, 200.0),
                                hold_of(0, 3, 900.0, (double)INFINITY)};
    const char *why;
    shop.hold = holds;
    shop.nhold = 3;
    /* end A -> D at least 15 min; C within 10 min of A, D within 200 s of the end of B; B ends at
       the latest when C starts: 10 min + 200 s < 15 min */
    assert_int_equal(fw_schedule_network_conflict(arena, &shop, false, &why), FW_OK);
    assert_non_null(why);
    assert_non_null(strstr(why, "C must start within 10 min of the end of A"));
    assert_non_null(strstr(why, "after A at least 15 min"));
    holds[2].min_s = 700.0;
    assert_int_equal(fw_schedule_network_conflict(arena, &shop, false, &why), FW_OK);
    assert_null(why);
    ((fw_schedule_task *)shop.task)[1].latest_s = 660.0;
    assert_int_equal(fw_schedule_network_conflict(arena, &shop, true, &why), FW_OK);
    assert_string_equal(why,
                        "C must start within 10 min of the end of A, but what lies between takes "
                        "11 min (B 11 min): 60 s too long");
    fw_schedule_hold later = hold_of(2, 1, 0.0, 60.0);
    shop.hold = &later;
    shop.nhold = 1;
    assert_int_equal(fw_schedule_network_conflict(arena, &shop, false, &why), FW_OK);
    assert_string_equal(why, "the hold of B counts from C, which comes later");
}

static uint64_t seed = 7;
static int below(int n) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (int)((seed >> 33) % (uint64_t)n);
}

enum { N = 6 };

static bool all_pairs(const fw_schedule_shop *shop,
                      double d[N][N]) { /* d: most of start_j - start_i */
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            d[i][j] = i == j ? 0.0 : 1e18;
    for (int i = 0; i + 1 < N; i++)
        d[i + 1][i] = -shop->task[i].duration_s;
    for (int k = 0; k < shop->nhold; k++) {
        const fw_schedule_hold *h = &shop->hold[k];
        double p = shop->task[h->from].duration_s;
        d[h->to][h->from] = fmin(d[h->to][h->from], -(p + h->min_s));
        d[h->from][h->to] = fmin(d[h->from][h->to], p + h->max_s);
    }
    for (int k = 0; k < N; k++)
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
                d[i][j] = fmin(d[i][j], d[i][k] + d[k][j]);
    for (int i = 0; i < N; i++)
        if (d[i][i] < -1e-9) return false;
    return true;
}

static void random_networks(void **state) {
    (void)state;
    static const char *const id[] = {"A", "B", "C", "D", "E", "F"};
    int feasible = 0;
    for (int round = 0; round < 3000; round++) {
        row rows[N];
        fw_schedule_hold holds[4];
        for (int i = 0; i < N; i++)
            rows[i] = (row){id[i], id[i], 1, 1 + below(9), 0};
        fw_schedule_shop shop = shop_of(arena, rows, N, 1, 0);
        shop.hold = holds;
        shop.nhold = below(5);
        for (int k = 0; k < shop.nhold; k++) {
            int from = below(N - 1), to = from + 1 + below(N - 1 - from);
            double least = 60.0 * below(8);
            holds[k] = hold_of(from, to, least, least + 60.0 * below(20));
        }
        const char *why;
        double d[N][N], earliest[N], pause[N];
        bool possible = all_pairs(&shop, d), ok = false;
        int failing;
        assert_int_equal(fw_schedule_network_conflict(arena, &shop, false, &why), FW_OK);
        assert_int_equal(why == NULL, possible);
        if (!possible) {
            assert_non_null(strstr(why, "must start within"));
            continue;
        }
        feasible++;
        assert_int_equal(fw_schedule_network_earliest(&shop, 0.0, earliest, &ok, &failing), FW_OK);
        assert_true(ok);
        assert_int_equal(fw_schedule_network_pauses(arena, &shop, pause), FW_OK);
        for (int i = 0; i < N; i++)
            assert_near(earliest[i], -d[i][0], 1e-6);
        for (int i = 0; i + 1 < N; i++) {
            double most = d[i][i + 1] - shop.task[i].duration_s;
            if (most > 1e17)
                assert_true(isinf(pause[i]));
            else
                assert_near(pause[i], most, 1e-6);
        }
    }
    assert_in_range(feasible, 600, 2400); /* both answers are tried */
}

/* the working day: a window over night cannot be kept when its end needs somebody */
static void days(void **state) {
    (void)state;
    const row rows[] = {{"A", "a", 1, 60, 60}, {"B", "b", 1, 700, 1}, {"C", "c", 1, 5, 5}};
    fw_schedule_shop shop = shop_of(arena, rows, 3, 1, 1);
    fw_schedule_hold holds[] = {hold_of(1, 2, 0.0, 600.0)};
    double at[3];
    bool ok;
    int failing;
    shop.hold = holds;
    shop.nhold = 1;
    shop.calendar =
        (fw_schedule_calendar){.open_s = 8 * 3600.0, .close_s = 18 * 3600.0, .weekends = true};
    /* B takes 11 h 40 min, so that C falls on the next morning: B starts 20:10 at night at the
       earliest, which needs somebody; C within 10 min of 8:00 never comes */
    assert_int_equal(fw_schedule_network_earliest(&shop, 8 * 3600.0, at, &ok, &failing), FW_OK);
    assert_false(ok);
    holds[0].max_s = 6.0 * 3600.0;
    assert_int_equal(fw_schedule_network_earliest(&shop, 8 * 3600.0, at, &ok, &failing), FW_OK);
    assert_true(ok);
    assert_near(at[0], 8 * 3600.0, 1e-6);
    assert_near(at[2], 32 * 3600.0, 1e-6);
    assert_near(at[1], 32 * 3600.0 - 6 * 3600.0 - 700 * 60.0, 1e-6); /* 14:20 of the first day */
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(windows), cmocka_unit_test(chains),
                                       cmocka_unit_test(random_networks), cmocka_unit_test(days)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
