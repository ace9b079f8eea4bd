/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Philox against the known answers of its authors; the numbers made of it. */
#include "chance/random.h"
#include "chance_test.h"

static void known_answers(void **state) {
    (void)state;
    static const struct {
        uint32_t counter[4], key[2], out[4];
    } row[] = {{{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
               {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
                {0xffffffff, 0xffffffff},
                {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
               {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                {0xa4093822, 0x299f31d0},
                {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        uint32_t out[4];
        fw_chance_philox(row[i].key, row[i].counter, out);
        assert_memory_equal(out, row[i].out, sizeof out);
    }
}

/* the number of a sample does not change when others are asked for, and depends on all three */
static void a_function(void **state) {
    (void)state;
    double a = fw_chance_uniform(7, 3, 2);
    for (uint64_t i = 0; i < 100; i++)
        fw_chance_uniform(i, i, i);
    assert_true(a == fw_chance_uniform(7, 3, 2));
    assert_true(a != fw_chance_uniform(8, 3, 2) && a != fw_chance_uniform(7, 4, 2) &&
                a != fw_chance_uniform(7, 3, 3));
    assert_true(a != fw_chance_uniform(7, 2, 3)); /* sample and dimension do not change places */
    assert_true(fw_chance_seed(7, 1) != fw_chance_seed(7, 2) &&
                fw_chance_seed(7, 1) != fw_chance_seed(8, 1));
    assert_true(fw_chance_uniform(7, (uint64_t)1 << 40, 0) != fw_chance_uniform(7, 0, 0));
}

/* 64 cells: chi-square with 63 degrees of freedom, within 5 standard deviations; the second halves of pairs as well */
static void even(void **state) {
    (void)state;
    enum { N = 200000, CELLS = 64 };
    for (uint64_t seed = 1; seed <= 4; seed++) {
        int count[CELLS] = {0}, pair[CELLS] = {0};
        for (uint64_t i = 0; i < N; i++) {
            double x = fw_chance_uniform(seed, i, 5), y = fw_chance_uniform(seed, i, 6);
            assert_true(x > 0 && x < 1);
            count[(int)(x * CELLS)]++;
            pair[(int)(x * 8) * 8 + (int)(y * 8)]++;
        }
        assert_even(count, CELLS, N);
        assert_even(pair, CELLS, N);
    }
}

static void normal(void **state) {
    (void)state;
    enum { N = 200000 };
    double sum = 0, square = 0, fourth = 0, product = 0;
    for (uint64_t i = 0; i < N; i++) {
        double u = fw_chance_normal(11, i, 0);
        sum += u, square += u * u, fourth += u * u * u * u,
            product += u * fw_chance_normal(11, i + 1, 0);
    }
    double root = sqrt((double)N); /* five standard deviations of each mean */
    assert_near(sum / N, 0, 5 / root);
    assert_near(square / N, 1, 5 * sqrt(2.0) / root);
    assert_near(fourth / N, 3, 5 * sqrt(96.0) / root);
    assert_near(product / N, 0, 5 / root);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(known_answers),
                                       cmocka_unit_test(a_function), cmocka_unit_test(even),
                                       cmocka_unit_test(normal)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
