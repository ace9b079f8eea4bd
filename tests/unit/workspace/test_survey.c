/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/reach.h"
#include "six_bar_fixture.h"
#include "test.h"

static const double degree = 0.017453292519943295;

static fw_workspace_reach_limits all_equal(double deg) {
    double limit[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        limit[i] = deg * degree;
    return fw_workspace_limits_symmetric(limit);
}

/* independent bounds of twice the areas over a superset of the 10 deg workspace, um2 */
static const struct {
    int hinge[3];
    double low, high;
} passive[FW_TRIANGLES] = {
    {{0, 1, 2}, -1212069.7, -1053210.5}, {{0, 1, 3}, -2046978.4, -1776930.8},
    {{0, 1, 4}, -2609122.4, -2135874.8}, {{0, 1, 5}, -1500284.6, -1257177.1},
    {{0, 2, 3}, -1533469.7, -1182494.3}, {{0, 2, 4}, -3283631.1, -2525968.8},
    {{0, 2, 5}, -2564290.7, -2168864.0}, {{0, 3, 4}, -2422182.0, -1735529.6},
    {{0, 3, 5}, -2628540.6, -2066798.9}, {{0, 4, 5}, -1543716.6, -1133387.3},
    {{1, 2, 3}, -731398.3, -366918.0},   {{1, 2, 4}, -1871385.2, -1427636.4},
    {{1, 2, 5}, -2367828.6, -1864532.2}, {{1, 3, 4}, -1999595.4, -1201417.1},
    {{1, 3, 5}, -3322485.4, -2529094.1}, {{1, 4, 5}, -2598827.8, -2151829.4},
    {{2, 3, 4}, -849411.4, -161704.3},   {{2, 3, 5}, -1592073.4, -1027828.3},
    {{2, 4, 5}, -2186632.8, -1660051.1}, {{3, 4, 5}, -1311173.4, -906565.5},
};

static void singularities_of_the_reference(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_loop loop;
    assert_true(fw_workspace_loop_set_up(&f.mechanism, &loop));
    fw_workspace_reach_limits limits = all_equal(10);
    fw_workspace_survey s;
    assert_int_equal(fw_workspace_reach_survey(arena, &loop, &limits, 5, true, &s), FW_OK);
    assert_true(s.singular.regular[0] && s.singular.regular[1]);
    for (int i = 0; i < FW_TRIANGLES; i++) {
        const fw_workspace_triangle *t = &s.singular.passive[i];
        for (int k = 0; k < 3; k++)
            assert_int_equal(t->hinge[k], passive[i].hinge[k]);
        assert_true(t->regular && t->negative && !t->positive);
        /* both hold the truth, which the signs at poses lie in */
        assert_true(t->area2_m2.lo * 1e12 <= passive[i].high &&
                    t->area2_m2.hi * 1e12 >= passive[i].low);
        double wide = passive[i].high - passive[i].low;
        assert_true(t->area2_m2.lo * 1e12 >= passive[i].low - 0.15 * wide);
        assert_true(t->area2_m2.hi * 1e12 <= passive[i].high + 0.15 * wide);
        assert_true(t->length_m.lo > 0 && t->length_m.lo <= t->length_m.hi);
        /* the pose does have that length */
        double angle[FW_SIX];
        int leg;
        assert_true(fw_workspace_six_bar_inverse(&f.mechanism, t->pose[0], t->pose[1], t->pose[2],
                                                 angle, &leg));
        for (int j = 0; j < FW_SIX; j++)
            assert_true(fabs(angle[j]) <= 10 * degree + 1e-12);
    }
    fw_arena_free(arena);
}

/* shares against central differences of certified volumes, exponent against the same */
static void shares_of_the_reference(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_loop loop;
    assert_true(fw_workspace_loop_set_up(&f.mechanism, &loop));
    fw_workspace_reach_limits limits = all_equal(10);
    fw_workspace_survey s;
    assert_int_equal(fw_workspace_reach_survey(arena, &loop, &limits, 6, true, &s), FW_OK);
    const double want[FW_SIX] = {.143, .155, .201, .201, .156, .144}; /* independent */
    double sum = 0;
    for (int i = 0; i < FW_SIX; i++) {
        assert_near(s.share[i], want[i], 3e-3);
        sum += s.share[i];
    }
    assert_near(sum, 1, 1e-12);
    assert_near(s.exponent, 2.99, 0.02);
    /* they need no singularities */
    fw_workspace_survey alone;
    assert_int_equal(fw_workspace_reach_survey(arena, &loop, &limits, 6, false, &alone), FW_OK);
    assert_memory_equal(alone.share, s.share, sizeof s.share);
    assert_true(alone.exponent == s.exponent);
    /* one hinge alone is tight: it owns nearly all of it that it can */
    limits.low_rad[4] = -0.01, limits.high_rad[4] = 0.01;
    assert_int_equal(fw_workspace_reach_survey(arena, &loop, &limits, 6, false, &s), FW_OK);
    double grows[FW_SIX], all = 0;
    for (int i = 0; i < FW_SIX; i++) {
        double v[2];
        for (int k = 0; k < 2; k++) {
            fw_workspace_reach_limits other = limits;
            other.low_rad[i] *= k ? 1.05 : 0.95;
            other.high_rad[i] *= k ? 1.05 : 0.95;
            fw_workspace_measure m;
            assert_int_equal(fw_workspace_reach_volume(arena, &loop, &other,
                                                       (fw_workspace_proof_effort){2e-3, 1000000},
                                                       &m),
                             FW_OK);
            v[k] = 0.5 * (m.value.lo + m.value.hi);
        }
        all += grows[i] = (v[1] - v[0]) / 0.1;
    }
    for (int i = 0; i < FW_SIX; i++)
        assert_near(s.share[i], grows[i] / all, 0.01);
    fw_arena_free(arena);
}

/* reached extents of the reference at 10 deg: x -261..264, y -126..111 um, phi +-10.7 deg, sampled
 */
static void extents_of_the_reference(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_loop loop;
    assert_true(fw_workspace_loop_set_up(&f.mechanism, &loop));
    fw_workspace_reach_limits limits = all_equal(10);
    fw_workspace_survey s;
    fw_arena *arena = fw_arena_new(0);
    assert_int_equal(fw_workspace_reach_extents(arena, &loop, &limits, 1e-3, 20000, &s), FW_OK);
    const double low[3] = {-261e-6, -126e-6, -10.7 * degree},
                 high[3] = {264e-6, 111e-6, 10.7 * degree};
    for (int c = 0; c < 3; c++) {
        double wide = high[c] - low[c];
        assert_true(s.least[c].hi - s.least[c].lo <= 4e-3 * wide);
        assert_true(s.most[c].hi - s.most[c].lo <= 4e-3 * wide);
        /* samples fall short of the end, a little */
        assert_true(s.most[c].hi >= high[c] - 0.003 * wide &&
                    s.least[c].lo <= low[c] + 0.003 * wide);
        assert_near(s.most[c].hi, high[c], 0.02 * wide);
        assert_near(s.least[c].lo, low[c], 0.02 * wide);
        for (int k = 0; k < 2; k++) {
            const double *at = k ? s.most_at[c] : s.least_at[c];
            double angle[FW_SIX];
            int leg;
            assert_true(
                fw_workspace_six_bar_inverse(&f.mechanism, at[0], at[1], at[2], angle, &leg));
            for (int j = 0; j < FW_SIX; j++)
                assert_true(fabs(angle[j]) <= 10 * degree + 1e-12);
            assert_near(at[c], k ? s.most[c].lo : s.least[c].hi, 1e-12);
        }
    }
    fw_arena_free(arena);
    /* the mirror image of this design: x and phi are symmetric */
    assert_near(s.least[0].hi, -s.most[0].lo, 3e-3 * (high[0] - low[0]));
    assert_near(s.least[2].hi, -s.most[2].lo, 3e-3 * (high[2] - low[2]));
}

static void required_box_is_regular_or_not(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_loop loop;
    assert_true(fw_workspace_loop_set_up(&f.mechanism, &loop));
    fw_workspace_regularity r;
    fw_workspace_box3 box = {{-50e-6, -50e-6, -0.03}, {50e-6, 50e-6, 0.03}};
    assert_int_equal(fw_workspace_required_survey(arena, &loop, &box, &r), FW_OK);
    for (int i = 0; i < FW_TRIANGLES; i++)
        assert_true(r.passive[i].regular);
    assert_true(r.regular[0] && r.regular[1]);
    /* far enough to put C, D and E in line: both signs of that triangle are met */
    fw_workspace_box3 far = {{-100e-6, 0, -0.9}, {100e-6, 0, 0}};
    assert_int_equal(fw_workspace_required_survey(arena, &loop, &far, &r), FW_OK);
    const fw_workspace_triangle *cde = &r.passive[16];
    assert_false(cde->regular);
    assert_true(cde->positive && cde->negative && cde->length_m.hi == 0);
    fw_arena_free(arena);
}

/* Poses are bounded by what hinges turn elastically: a hinge without such a limit, or with one beyond 3 rad, up to which rotations
   of the loop are told apart, gives no map; and all limits below do. */
static void a_map_needs_every_limit(void **state) {
    (void)state;
    static const struct {
        double limit_rad;
        bool there;
    } row[] = {{0.03, true}, {(double)NAN, false}, {0, false}, {3.1, false}};
    const fw_workspace_effort rough = {.relative = 0.5, .most = 200, .level = 2};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        fw_arena *arena = fw_arena_new(0);
        six_bar_fixture f;
        fw_mechanism_hinge hinge[6] = {0};
        fw_workspace_map map;
        six_bar_make(&f, six_bar_reference);
        for (int i = 0; i < 6; i++) {
            hinge[i].closed_form.limit_angle_rad = i == 4 ? row[k].limit_rad : 0.03;
            f.pin[i].hinge = i;
        }
        f.mechanism.hinge = hinge, f.mechanism.nhinge = 6;
        assert_int_equal(fw_workspace_map_make(arena, &f.mechanism, rough, &map), FW_OK);
        assert_int_equal(map.none == NULL, row[k].there);
        if (map.none) assert_non_null(strstr(map.none, "a hinge has no elastic limit"));
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singularities_of_the_reference),
        cmocka_unit_test(shares_of_the_reference),
        cmocka_unit_test(extents_of_the_reference),
        cmocka_unit_test(required_box_is_regular_or_not),
        cmocka_unit_test(a_map_needs_every_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
