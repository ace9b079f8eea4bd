/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/maths_interval.h"
#include "test.h"

static uint64_t seed;

static double unit(void) { /* 0..1 */
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* either sign, sizes over `decades` powers of ten about one */
static double any(double decades) {
    double x = pow(10.0, decades * (unit() - 0.5));
    return unit() < 0.5 ? -x : x;
}

static fw_maths_interval between(double a, double b) {
    return (fw_maths_interval){fmin(a, b), fmax(a, b)};
}

static fw_maths_interval any_interval(double decades) {
    double kind = unit(), a = any(decades);
    if (kind < 0.2) return fw_interval_point(a);
    if (kind < 0.6) return between(a, a * (1.0 + 1e-3 * unit()));
    return between(a, any(decades));
}

static double within(fw_maths_interval a) {
    double kind = unit();
    if (kind < 0.2) return a.lo;
    if (kind < 0.4) return a.hi;
    return fmin(fmax(a.lo + unit() * (a.hi - a.lo), a.lo), a.hi);
}

#define assert_holds(set, exact)                                                                   \
    do {                                                                                           \
        fw_maths_interval s_ = (set);                                                              \
        long double x_ = (exact);                                                                  \
        if (!((long double)s_.lo <= x_ && x_ <= (long double)s_.hi))                               \
            fail_msg("%s: %.21Lg not in [%.17g, %.17g]", #set, x_, s_.lo, s_.hi);                  \
    } while (0)

/* the result of every operation on points of the operands, in 64-bit mantissas, lies in the result;
   and that is at most three units wide where the operands are points */
static void operations_enclose(void **state) {
    (void)state;
    seed = 7;
    for (int i = 0; i < 300000; i++) {
        fw_maths_interval a = any_interval(12), b = any_interval(12);
        double x = within(a), y = within(b);
        long double u = (long double)x, v = (long double)y;
        assert_holds(fw_interval_add(a, b), u + v);
        assert_holds(fw_interval_sub(a, b), u - v);
        assert_holds(fw_maths_interval_mul(a, b), u * v);
        assert_holds(fw_maths_interval_div(a, b), u / v);
        assert_holds(fw_interval_negated(a), -u);
        assert_holds(fw_interval_hull(a, b), u);
        if (x >= 0) assert_holds(fw_maths_interval_sqrt(a), sqrtl(u));
        fw_maths_interval p = fw_maths_interval_mul(fw_interval_point(x), fw_interval_point(y));
        assert_true(p.hi - p.lo <= 5e-16 * fabs(p.lo));
    }
}

static void functions_enclose(void **state) {
    (void)state;
    seed = 11;
    for (int i = 0; i < 300000; i++) {
        fw_maths_interval a = any_interval(4);
        double x = within(a);
        assert_holds(fw_maths_interval_sin(a), sinl((long double)x));
        assert_holds(fw_maths_interval_cos(a), cosl((long double)x));
    }
    assert_true(isnan(fw_maths_interval_sqrt((fw_maths_interval){-2.0, -1.0}).hi));
}

/* no wider than the exact range by more than rounding: the extremes of sin are found, others not */
static void functions_are_tight(void **state) {
    (void)state;
    seed = 13;
    double turn = 2 * acos(-1.0);
    for (int i = 0; i < 20000; i++) {
        double a = 20 * (unit() - 0.5), w = 7 * unit();
        fw_maths_interval s = fw_maths_interval_sin((fw_maths_interval){a, a + w});
        double lo = 1, hi = -1;
        for (int k = 0; k <= 2000; k++) {
            double v = sin(a + w * k / 2000);
            lo = fmin(lo, v), hi = fmax(hi, v);
        }
        assert_true(s.lo <= lo + 1e-14 && s.hi >= hi - 1e-14); /* samples round too */
        assert_near(s.lo, lo, 1e-5);
        assert_near(s.hi, hi, 1e-5);
        fw_maths_interval c =
            fw_maths_interval_cos((fw_maths_interval){a - turn / 4, a + w - turn / 4});
        assert_near(c.lo, s.lo, 1e-13);
        assert_near(c.hi, s.hi, 1e-13);
    }
}

static void directed_steps(void **state) {
    (void)state;
    seed = 17;
    for (int i = 0; i < 200000; i++) {
        double x = any(500);
        assert_true(fw_up(x) >= nextafter(x, (double)INFINITY));
        assert_true(fw_down(x) <= nextafter(x, -(double)INFINITY));
        assert_true(fw_up(x) <= nextafter(nextafter(x, (double)INFINITY), (double)INFINITY));
    }
    assert_true(fw_up(0.0) > 0.0 && fw_down(0.0) < 0.0);
    assert_true(fw_up(0x1p-1074) > 0x1p-1074);
}

/* by an interval that holds zero: anything; what is proved from such bounds is nothing */
static void nothing_is_proved_by_infinities(void **state) {
    (void)state;
    fw_maths_interval zero = {-1.0, 1.0}, one = {1.0, 2.0};
    fw_maths_interval all = fw_maths_interval_div(one, zero),
                      more = fw_maths_interval_mul(all, zero);
    assert_true(all.lo == -(double)INFINITY && all.hi == (double)INFINITY);
    assert_true(more.lo == -(double)INFINITY && more.hi == (double)INFINITY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations_enclose),
        cmocka_unit_test(functions_enclose),
        cmocka_unit_test(functions_are_tight),
        cmocka_unit_test(directed_steps),
        cmocka_unit_test(nothing_is_proved_by_infinities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
