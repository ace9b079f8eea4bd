/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/maths_interval.h"
#include "test.h"

static uint64_t seed;

static double unit(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

typedef struct pair { /* a quantity in exact numbers and as a centred form */
    long double x;
    fw_maths_centred c;
} pair;

/* one random function of three coordinates: the same steps for a point and for the box */
static void evaluate(uint64_t start, const double middle[3], const double half[3],
                     const long double at[3], pair out[24]) {
    seed = start;
    for (int i = 0; i < 3; i++)
        out[i] = (pair){at[i], fw_centred_axis(middle[i], half[i])};
    for (int i = 3; i < 24; i++) {
        pair a = out[(int)(unit() * i)], b = out[(int)(unit() * i)];
        fw_maths_centred s, c;
        switch ((int)(unit() * 8)) {
        case 0:
            out[i] = (pair){a.x + b.x, fw_centred_add(a.c, b.c)};
            break;
        case 1:
            out[i] = (pair){a.x - b.x, fw_centred_sub(a.c, b.c)};
            break;
        case 2:
            out[i] = (pair){a.x * b.x, fw_centred_mul(a.c, b.c)};
            break;
        case 3:
            out[i] = (pair){1 / a.x, fw_centred_inverse(a.c)};
            break;
        case 4: /* of something positive */
            out[i] = (pair){
                sqrtl(a.x * a.x + 0.25L),
                fw_centred_sqrt(fw_centred_add(fw_centred_mul(a.c, a.c), fw_centred_exact(0.25)))};
            break;
        case 5:
            fw_centred_turn(a.c, &s, &c);
            out[i] = (pair){sinl(a.x), s};
            break;
        case 6:
            fw_centred_turn(a.c, &s, &c);
            out[i] = (pair){cosl(a.x), c};
            break;
        default:
            out[i] = (pair){a.x * -1.75L, fw_centred_scaled(a.c, -1.75)};
        }
    }
}

/* at every share s of the way from the middle the value is within ((1 - s) e + s r) of m */
static void values_stay_within_radii(void **state) {
    (void)state;
    long finite = 0;
    for (uint64_t i = 1; i <= 20000; i++) {
        seed = i * 7919;
        double middle[3], half[3], shift[3], s = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 1.0 : unit();
        long double at[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = 4 * unit() - 2;
            half[k] = pow(10, -1 - 5 * unit());
            shift[k] = unit() < 0.3 ? 1.0 : 2 * unit() - 1;
            at[k] = (long double)middle[k] +
                    (long double)s * (long double)shift[k] * (long double)half[k];
        }
        pair v[24];
        evaluate(i, middle, half, at, v);
        for (int k = 0; k < 24; k++) {
            fw_maths_centred c = v[k].c;
            if (!(c.r < 1e100 && fabs(c.m) < 1e100)) continue;
            finite++;
            long double share = (long double)s, m = (long double)c.m;
            long double allowed = (1 - share) * (long double)c.e + share * (long double)c.r;
            long double own = 0x1p-61L * (1 + fabsl(v[k].x)); /* of the point itself */
            if (!(fabsl(v[k].x - m) <= allowed + own))
                fail_msg("function %d step %d: %.20Lg, m %.17g e %.3g r %.3g s %.3g", (int)i, k,
                         v[k].x, c.m, c.e, c.r, s);
            fw_maths_interval range = fw_centred_range(c);
            assert_true(range.lo <= c.m - c.r && range.hi >= c.m + c.r);
        }
    }
    assert_true(finite > 200000);
}

/* radii shrink with the box, rounding stays: the form is of first order */
static void radii_follow_the_box(void **state) {
    (void)state;
    for (int k = 1; k < 6; k++) {
        double h = pow(10, -k);
        fw_maths_centred s, c;
        fw_centred_turn(fw_centred_axis(0.7, h), &s, &c);
        fw_maths_centred q = fw_centred_mul(s, fw_centred_inverse(c)); /* tan, slope 1 + tan^2 */
        assert_near(q.r / h, 1 + tan(0.7) * tan(0.7), 0.2 + 5 * h);
        assert_true(q.e < 1e-15);
    }
    fw_maths_centred zero = fw_centred_inverse(fw_centred_axis(0.5, 0.5));
    assert_true(isinf(zero.r));
    assert_true(isinf(fw_centred_sqrt(fw_centred_axis(0.1, 0.2)).r));
}

static void direction_encloses(void **state) {
    (void)state;
    seed = 3;
    for (int i = 0; i < 100000; i++) {
        double x = 2 * unit() - 1, y = 2 * unit() - 1, e = pow(10, -16 + 15 * unit());
        fw_maths_interval a =
            fw_centred_direction((fw_maths_centred){y, e, e}, (fw_maths_centred){x, e, e});
        long double r = (long double)e, dx = (long double)(2 * unit() - 1) * r,
                    dy = (long double)(2 * unit() - 1) * r;
        long double exact = atan2l((long double)y + dy, (long double)x + dx);
        long double turn = exact - (long double)atan2(y, x);
        if (fabsl(turn) > 3) continue; /* the cut: callers look at the range */
        assert_true((long double)a.lo <= exact && exact <= (long double)a.hi);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_stay_within_radii),
        cmocka_unit_test(radii_follow_the_box),
        cmocka_unit_test(direction_encloses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
