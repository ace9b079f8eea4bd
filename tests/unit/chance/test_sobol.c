/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol' points: the table of polynomials and numbers, the points as nets, what scrambling keeps and changes. */
#include "chance/random.h"
#include "chance_test.h"

enum { MOST = FW_CHANCE_SOBOL_MOST, BITS = 32 };

static const struct {
    uint16_t polynomial, m[11];
} number[] = {
#include "chance/sobol_numbers.def"
};

static int degree_of(unsigned p) {
    int degree = -1;
    for (; p; p >>= 1)
        degree++;
    return degree;
}

/* x generates the field: no smaller power than 2^s - 1 is 1 */
static void table(void **state) {
    (void)state;
    assert_int_equal(sizeof number / sizeof *number, MOST - 1);
    for (size_t i = 0; i < MOST - 1; i++) {
        unsigned p = number[i].polynomial, x = 1, order = 0;
        int s = degree_of(p);
        assert_true(s >= 1 && s <= 11 && (!i || p > number[i - 1].polynomial));
        do {
            x <<= 1;
            if (x >> s & 1) x ^= p;
            order++;
        } while (x > 1 && order < 1u << s);
        assert_true(x == 1 && order == (1u << s) - 1);
        for (int k = 0; k < s; k++)
            assert_true(number[i].m[k] % 2 == 1 && number[i].m[k] < 2u << k);
    }
}

/* each elementary box of 2^-a x 2^-b, a + b = m - t, has 2^t of the first 2^m points of the pair */
static int quality(const fw_chance_sobol *s, size_t one, size_t other, int m) {
    static int count[1 << 12];
    for (int t = 0; t < m; t++) {
        int good = 1;
        for (int a = 0; good && a <= m - t; a++) {
            int b = m - t - a;
            memset(count, 0, sizeof count);
            for (uint64_t i = 0; i < 1u << m; i++) {
                uint64_t x = fw_chance_sobol_digits(s, i, one),
                         y = fw_chance_sobol_digits(s, i, other);
                count[(x >> (BITS - a)) << b | y >> (BITS - b)]++;
            }
            for (int c = 0; good && c < 1 << (m - t); c++)
                good = count[c] == 1 << t;
        }
        if (good) return t;
    }
    return m;
}

static void nets(void **state) {
    (void)state;
    fw_chance_sobol s;
    assert_int_equal(fw_chance_sobol_new(arena, MOST, 1, &s), FW_OK);
    assert_int_equal(quality(&s, 0, 1, 10), 0); /* the first two are a (0, 2)-sequence */
    /* by counting points: pairs of the table's first dimensions, and of its last, with 2048 points */
    for (size_t i = 0; i < 12; i++)
        for (size_t j = 0; j < i; j++)
            assert_true(quality(&s, j, i, 11) <= 5);
    int bad = 0;
    for (size_t i = MOST - 6; i < MOST; i++)
        for (size_t j = MOST - 6; j < i; j++) {
            int t = quality(&s, j, i, 11);
            assert_true(t <= 9);
            bad += t > 7;
        }
    assert_true(bad <= 1); /* of 15; of all 56616 pairs 190 are beyond 7 */
    /* in one dimension every block of 2^m, also of the scrambled points, has one point in each interval of 2^-m */
    for (size_t d = 0; d < MOST; d += 7) {
        static char seen[256];
        memset(seen, 0, sizeof seen);
        for (uint64_t i = 512; i < 768; i++)
            seen[(int)(fw_chance_sobol_uniform(&s, i, d) * 256)]++;
        for (int c = 0; c < 256; c++)
            assert_int_equal(seen[c], 1);
    }
}

/* dimensions 1 to 3 as printed by Bratley and Fox, in the order of plain numbers */
static void values(void **state) {
    (void)state;
    fw_chance_sobol s;
    assert_int_equal(fw_chance_sobol_new(arena, 3, 1, &s), FW_OK);
    static const double point[8][2] = {{0, 0},         {0.5, 0.5},     {0.25, 0.75},
                                       {0.75, 0.25},   {0.125, 0.625}, {0.625, 0.125},
                                       {0.375, 0.375}, {0.875, 0.875}};
    for (uint64_t i = 0; i < 8; i++)
        for (size_t d = 0; d < 2; d++)
            assert_near(fw_chance_sobol_digits(&s, i, d) * 0x1p-32, point[i][d], 0);
}

/* two points agree in as many leading digits after the scrambling as before: nested; and over seeds a point is uniform */
static void scrambling(void **state) {
    (void)state;
    fw_chance_sobol s;
    assert_int_equal(fw_chance_sobol_new(arena, 40, 99, &s), FW_OK);
    for (size_t d = 0; d < 40; d += 3)
        for (uint64_t i = 1; i < 200; i++)
            for (uint64_t j = 0; j < i; j += 7) {
                uint32_t before =
                    fw_chance_sobol_digits(&s, i, d) ^ fw_chance_sobol_digits(&s, j, d);
                uint32_t after = (uint32_t)(fw_chance_sobol_uniform(&s, i, d) * 0x1p32) ^
                                 (uint32_t)(fw_chance_sobol_uniform(&s, j, d) * 0x1p32);
                assert_int_equal(__builtin_clz(before), __builtin_clz(after));
            }
    enum { SEEDS = 4096, CELLS = 16 };
    int count[CELLS] = {0}, joint[CELLS] = {0};
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        fw_mark mark = fw_arena_mark(arena);
        assert_int_equal(fw_chance_sobol_new(arena, 5, seed, &s), FW_OK);
        double x = fw_chance_sobol_uniform(&s, 77, 4), y = fw_chance_sobol_uniform(&s, 77, 1);
        count[(int)(x * CELLS)]++;
        joint[(int)(x * 4) * 4 + (int)(y * 4)]++;
        fw_arena_rewind(arena, mark);
    }
    assert_even(count, CELLS, SEEDS);
    assert_even(joint, CELLS, SEEDS);
}

/* root of the mean square error of a smooth integral over 50 scramblings: the rate of a net, 1.5, not that of chance, 0.5 */
static double error_of(size_t dimensions, unsigned points) {
    double sum = 0;
    for (uint64_t seed = 0; seed < 50; seed++) {
        fw_mark mark = fw_arena_mark(arena);
        fw_chance_sobol s;
        assert_int_equal(fw_chance_sobol_new(arena, dimensions, seed, &s), FW_OK);
        double mean = 0;
        for (uint64_t i = 0; i < points; i++) {
            double product = 1;
            for (size_t d = 0; d < dimensions; d++) {
                double x = fw_chance_sobol_uniform(&s, i, d);
                product *= 1 + (x - 0.5) / (double)(d + 1);
            }
            mean += product / points;
        }
        sum += (mean - 1) * (mean - 1) / 50;
        fw_arena_rewind(arena, mark);
    }
    return sqrt(sum);
}

static void rate(void **state) {
    (void)state;
    assert_true(error_of(2, 64) / error_of(2, 4096) > pow(64, 1.3));
    assert_true(error_of(6, 4096) <
                0.3 * 0.3 / 64); /* sd 0.3: a thirtieth of that of random points */
}

static void refused(void **state) {
    (void)state;
    fw_chance_sobol s;
    assert_int_equal(fw_chance_sobol_new(arena, MOST + 1, 1, &s), FW_LIMIT);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(table), cmocka_unit_test(values),
                                       cmocka_unit_test(nets),  cmocka_unit_test(scrambling),
                                       cmocka_unit_test(rate),  cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
