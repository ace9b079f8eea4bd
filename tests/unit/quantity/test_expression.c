/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "quantity/quantity.h"
#include "test.h"

static const fw_quantity_dimension pure = {0}, length = {.m = 1}, angle = {.rad = 1},
                                   area = {.m = 2}, force = {1, 1, -2, 0, 0, 0, 0, 0},
                                   mass = {.kg = 1}, turning = {2, 1, -2, 0, 0, 0, -1, 0},
                                   rate = {.s = -1};
static const fw_quantity_name_value items[] = {
    {"t", 10e-6, {.m = 1}}, {"arc", 4.0, {.rad = 1}}, {"n", 3.0, {0}}, {"zero", 0.0, {0}}};
static const fw_quantity_names names = {items, 4};

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

static void values(void **state) {
    (void)state;
    const double pi = 3.14159265358979323846;
    const struct {
        const char *text;
        fw_quantity_dimension wanted;
        double value;
    } good[] = {
        {"10 um", length, 1e-5},
        {"10um", length, 1e-5},
        {" 2*t + 5 um ", length, 2.5e-5},
        {"2 * (t + 5 um)", length, 3e-5},
        {"1.711e-6 N m/rad", turning, 1.711e-6},
        {"sqrt((3 um)^2 + (4 um)^2)", length, 5e-6},
        {"240 deg", angle, 4 * pi / 3},
        {"6 um / 2 um", pure, 3},
        {"1 / 2 um/s", {-1, 0, 1, 0, 0, 0, 0, 0}, 5e5}, /* a unit binds tighter than / */
        {"300 um/arc", length, 75e-6},               /* rad is forgiven in a quotient */
        {"arc * 100 um", length, 4e-4},
        {"1 um + 300 um/arc", length, 76e-6},
        {"300 um/arc + 1 um", length, 76e-6},
        {"60 um / t", angle, 6},
        {"2*1e-3 N * 1 mm", turning, 2e-6},
        {"sin(30 deg)", pure, 0.5},
        {"cos(pi)", pure, -1},
        {"tan(45 deg)", pure, 1},
        {"asin(1)", angle, pi / 2},
        {"acos(0)", angle, pi / 2},
        {"atan(1)", angle, pi / 4},
        {"atan2(1 um, -1 um)", angle, 3 * pi / 4},
        {"exp(ln(5))", pure, 5},
        {"min(3 um, t, 2 um)", length, 2e-6},
        {"max(3 um, t)", length, 1e-5},
        {"abs(-3 um)", length, 3e-6},
        {"-2^2", pure, -4},
        {"2^-1", pure, 0.5},
        {"2^3^2", pure, 512},
        {"--2", pure, 2},
        {"+2", pure, 2},
        {"8/2/2", pure, 2},
        {"1-2-3", pure, -4},
        {"2+3*4^2", pure, 50},
        {"5 um^2", area, 5e-12},
        {"(5 um)^2", area, 25e-12},
        {"(4 um^2)^0.5", length, 2e-6},
        {"50 %", pure, 0.5},
        {"100 1/s", rate, 100},
        {"10 s^-1", rate, 10},
        {"20 mA/cm2", {-2, 0, 0, 1, 0, 0, 0, 0}, 200},
        {"20 Cel", {.K = 1}, 293.15},
        {"-40 Cel", {.K = 1}, 233.15},
        {"20 Cel - 40 Cel", {.K = 1}, -20},
        {"0.5*(20 Cel + 40 Cel)", {.K = 1}, 303.15},
        {"2*(40 Cel - 20 Cel)", {.K = 1}, 40},
        {"20 Cel/300 K*300 K", {.K = 1}, 293.15},
        {"-40 Cel - 20 Cel", {.K = 1}, -60},
        {"-40 K", {.K = 1}, -40},
        {"1e3", pure, 1000},
        {".5", pure, 0.5},
        {"5.", pure, 5},
        {"2 eV", {2, 1, -2, 0, 0, 0, 0, 0}, 2 * 1.602176634e-19},
        {"n", pure, 3},
        {"5 min", {.s = 1}, 300},
        {"5 um*min(1, 2)", length, 5e-6},
        {"10 um - 2 um", length, 8e-6},
        {"10 um -2 um", length, 8e-6},
        {"0^0", pure, 1},
        {"3 N*m/2 m", force, 1.5},
        {"zero * 1 um", length, 0},
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        double value;
        fw_quantity_expression_error e;
        fw_status s = fw_quantity_expression_evaluate(arena, good[i].text, strlen(good[i].text),
                                                      &names, good[i].wanted, &value, &e);
        if (s != FW_OK) fail_msg("'%s': %s", good[i].text, e.message);
        if (!(fabs(value - good[i].value) <= 1e-14 * fabs(good[i].value) + 1e-300 + 1e-16))
            fail_msg("'%s' = %.17g, expected %.17g", good[i].text, value, good[i].value);
    }
}

static void errors(void **state) {
    (void)state;
    const struct {
        const char *text;
        fw_quantity_dimension wanted;
        int number;
        size_t offset;
        const char *says;
    } bad[] = {
        {"", length, 33, 0, "empty"},
        {"   ", length, 33, 0, "empty"},
        {"12", length, 24, 0, "'12 um'"},
        {" 12 ", length, 24, 1, "'12 um'"},
        {"2*3", length, 24, 0, "'um'"},
        {"12 mg", length, 25, 0, "a mass, and a length"},
        {"12 deg", length, 25, 0, "an angle"},
        {"1e-6 N m", turning, 25, 0, "torsional stiffness"},
        {"2*arc", pure, 25, 0, "an angle"}, /* an angle never is a pure number */
        {"2*3", angle, 24, 0, "deg"},
        {"12 umm", length, 21, 3, "did you mean 'um'"},
        {"12 xm", length, 21, 3, "did you mean 'um'"},
        {"12 qPa", (fw_quantity_dimension){-1, 1, -2, 0, 0, 0, 0, 0}, 21, 3, "did you mean 'GPa'"},
        {"300,5 um", length, 20, 3, "the decimal sign is a point, not a comma: write '300.5'"},
        {"2*(1,25 um)", length, 20, 4, "write '1.25'"},
        {"12 um, 3 um", length, 20, 5, "only between the arguments"},
        {"12 \xc2\xb5q", length, 21, 3, "unknown unit"},
        {"12 N m/rod", turning, 22, 7, "'rod'"},
        {"12 um foo", length, 21, 6, "'foo'"},
        {"arcs", angle, 22, 0, "'arc'"},
        {"nothing", length, 22, 0, "<parameter"},
        {"um", length, 22, 0, "1 um"},
        {"sin", pure, 23, 0, "sin(...)"},
        {"sinn(1)", pure, 23, 0, "'sin'"},
        {"sqrt(1, 2)", pure, 23, 0, "1 argument, 2 given"},
        {"atan2(1)", pure, 23, 0, "2 arguments, 1 given"},
        {"2*20 Cel", {.K = 1}, 719, 1, "586.3 K"}, /* 40 Cel is meant, or nothing */
        {"20 Cel*2", {.K = 1}, 719, 6, "586.3 K"},
        {"(20 Cel)/2", {.K = 1}, 719, 8, "in K"},
        {"1 um + 1 mg", length, 26, 5, "a length cannot be added to a mass"},
        {"1 um - 1", length, 26, 5, "a pure number cannot be subtracted from a length"},
        {"1 um + 2 um deg", length, 26, 5, "m rad"}, /* only products are forgiven */
        {"min(1 um, 1 s)", length, 26, 0, "both must be the same"},
        {"exp(1 um)", pure, 26, 0, "a pure number"},
        {"sin(1 um)", pure, 26, 0, "an angle or"},
        {"1/0", pure, 27, 1, "zero"},
        {"1 um / (t - 10 um)", pure, 27, 5, "zero"},
        {"0^-1", pure, 27, 1, "zero"},
        {"1e308*10", pure, 28, 5, "too large"},
        {"exp(1000)", pure, 28, 0, "too large"},
        {"1e308 + 1e308", pure, 28, 6, "too large"},
        {"10^400", pure, 28, 2, "too large"},
        {"1e999", pure, 28, 0, "not finite"},
        {"1e308 km", length, 28, 0, "too large"},
        {"sqrt(-1)", pure, 29, 0, "negative"},
        {"ln(0)", pure, 29, 0, "positive"},
        {"asin(1.1)", angle, 29, 0, "between -1 and 1"},
        {"(-8)^0.5", pure, 29, 4, "negative"},
        {"2^t", pure, 30, 1, "pure number"},
        {"t^0.5", length, 30, 1, "whole"},
        {"t^200", length, 30, 1, "whole"},
        {"sqrt(t)", length, 30, 0, "a square"},
        {"(2", pure, 32, 0, "never closed"},
        {"min(2, 3", pure, 32, 8, "missing"},
        {"2)", pure, 32, 1, "closes nothing"},
        {"2 +", pure, 20, 3, "missing"},
        {"2 3", pure, 20, 2, "operator"},
        {"5 1", pure, 20, 2, "operator"},
        {"* 2", pure, 20, 0, "'*'"},
        {"2 $ 3", pure, 20, 2, "'$'"},
        {"2 \x01", pure, 20, 2, "no meaning"},
        {"()", pure, 20, 1, "')'"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double value = 7;
        fw_quantity_expression_error e;
        fw_status s = fw_quantity_expression_evaluate(arena, bad[i].text, strlen(bad[i].text),
                                                      &names, bad[i].wanted, &value, &e);
        if (s != FW_INPUT) fail_msg("'%s' is accepted", bad[i].text);
        assert_true(isnan(value));
        if (e.number != bad[i].number || e.offset != bad[i].offset ||
            !strstr(e.message, bad[i].says))
            fail_msg("'%s': %d at %zu: %s", bad[i].text, e.number, e.offset, e.message);
    }
}

static void nesting_is_limited(void **state) {
    (void)state;
    char text[20001];
    double value;
    fw_quantity_expression_error e;
    for (int kind = 0; kind < 3; kind++) {
        memset(text, "(-2"[kind], 20000);
        for (int i = 1; kind == 2 && i < 20000; i += 2)
            text[i] = '^';
        assert_int_equal(
            fw_quantity_expression_evaluate(arena, text, 20000, NULL, pure, &value, &e), FW_INPUT);
        assert_int_equal(e.number, 31);
    }
    memset(text, '(', 63);
    text[63] = '1';
    memset(text + 64, ')', 63);
    assert_int_equal(fw_quantity_expression_evaluate(arena, text, 127, NULL, pure, &value, &e),
                     FW_OK);
}

/* random expressions against their value computed on the way */
static uint64_t seed;
static unsigned draw(unsigned below) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(seed >> 33) % below;
}

/* appends an expression of dimension m^power; returns its value, which is positive when asked for;
 *size bounds the terms, for the tolerance */
static double random_sum(fw_text *out, int power, int depth, int positive, double *size) {
    static const char *const unit[] = {"um", "mm", "nm", "cm"};
    static const double factor[] = {1e-6, 1e-3, 1e-9, 1e-2};
    unsigned kind = depth <= 0 ? 0 : draw(9);
    double a, b, sa, sb;
    switch (kind) {
    case 1: /* sum */
    case 2: {
        int minus = !positive && draw(2);
        fw_text_add(out, "(");
        a = random_sum(out, power, depth - 1, positive, &sa);
        fw_text_add(out, minus ? " - " : "+");
        b = random_sum(out, power, depth - 1, positive || minus, &sb);
        fw_text_add(out, ")");
        *size = sa + sb;
        return minus ? a - b : a + b;
    }
    case 3: { /* product */
        int split = (int)draw(3) - 1;
        a = random_sum(out, split, depth - 1, positive, &sa);
        fw_text_add(out, draw(2) ? "*" : " * ");
        b = random_sum(out, power - split, depth - 1, positive, &sb);
        *size = sa * sb;
        return a * b;
    }
    case 4: { /* quotient */
        int split = (int)draw(3) - 1;
        a = random_sum(out, power + split, depth - 1, positive, &sa);
        fw_text_add(out, " / ");
        fw_text_add(out, "(");
        b = random_sum(out, split, depth - 1, 1, &sb);
        fw_text_add(out, ")");
        *size = sa / b;
        return a / b;
    }
    case 5: /* root of a square */
        fw_text_add(out, "sqrt(");
        a = random_sum(out, 2 * power, depth - 1, 1, &sa);
        fw_text_add(out, ")");
        *size = sqrt(a);
        return sqrt(a);
    case 6:
        if (power % 2) break;
        fw_text_add(out, "(");
        a = random_sum(out, power / 2, depth - 1, positive, &sa);
        fw_text_add(out, ")^2");
        *size = sa * sa;
        return a * a;
    case 7:
        fw_text_add(out, "max(");
        a = random_sum(out, power, depth - 1, positive, &sa);
        fw_text_add(out, " , ");
        b = random_sum(out, power, depth - 1, positive, &sb);
        fw_text_add(out, ")");
        *size = sa > sb ? sa : sb;
        return a > b ? a : b;
    case 8:
        if (positive) break;
        fw_text_add(out, "(-");
        a = random_sum(out, power, depth - 1, 0, size);
        fw_text_add(out, ")");
        return -a;
    default:
        break;
    }
    double number = (1 + (double)draw(1000)) / 100.0, value = number;
    fw_text_number(out, number, 17);
    if (power != 0) {
        unsigned u = draw(4);
        fw_text_printf(out, draw(2) ? " %s^%d" : "%s^%d", unit[u], power);
        value = number * pow(factor[u], power);
    }
    *size = fabs(value);
    return value;
}

static void random_expressions(void **state) {
    (void)state;
    for (int i = 0; i < 20000; i++) {
        fw_mark mark = fw_arena_mark(arena);
        fw_text text = fw_text_new(arena);
        seed = (uint64_t)i + 1;
        draw(2);
        double size, value, want = random_sum(&text, (int)draw(5) - 2, 5, 0, &size);
        fw_quantity_dimension found;
        fw_quantity_expression_error e;
        fw_status s = fw_quantity_expression_evaluate_any(arena, text.data, text.length, NULL,
                                                          &value, &found, &e);
        if (s != FW_OK) fail_msg("seed %d: '%s': %s", i + 1, text.data, e.message);
        if (!(fabs(value - want) <= 1e-12 * size))
            fail_msg("seed %d: '%s' = %.17g, expected %.17g", i + 1, text.data, value, want);
        fw_arena_rewind(arena, mark);
    }
}

/* whatever the bytes: no crash, an offset inside, a sentence, NaN */
static void random_bytes(void **state) {
    (void)state;
    static const char alphabet[] = "0123456789.eE+-*/^(), umNradtx{%}1\xc2\xb5sqrtmin";
    seed = 11;
    for (int i = 0; i < 100000; i++) {
        fw_mark mark = fw_arena_mark(arena);
        char text[40];
        size_t n = draw(sizeof text);
        for (size_t k = 0; k < n; k++)
            text[k] = alphabet[draw(sizeof alphabet)];
        double value;
        fw_quantity_expression_error e;
        fw_status s = fw_quantity_expression_evaluate(arena, text, n, &names, length, &value, &e);
        assert_true(s == FW_OK ? isfinite(value) : isnan(value));
        if (s == FW_INPUT) {
            assert_true(e.offset <= n);
            assert_in_range(e.number, 20, 39);
            assert_non_null(e.message);
        }
        fw_arena_rewind(arena, mark);
    }
}

static void memory_runs_out(void **state) {
    (void)state;
    static const char *const text[] = {"1 um + 1 mg", "12 umm",         "q",    "sqrt(t)", "12",
                                       "foo(1)",      "min(1 um, 1 s)", "t^0.5"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        for (long n = 1; n < 20; n++) {
            double value;
            fw_quantity_expression_error e;
            fw_arena_fail_at(n, 1);
            fw_status s = fw_quantity_expression_evaluate(arena, text[i], strlen(text[i]), &names,
                                                          mass, &value, &e);
            long used = fw_arena_count();
            fw_arena_fail_at(0, 0);
            assert_true(s == FW_NOMEM || (s == FW_INPUT && e.message));
            if (used < n) break;
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(values, setup, teardown),
        cmocka_unit_test_setup_teardown(errors, setup, teardown),
        cmocka_unit_test_setup_teardown(nesting_is_limited, setup, teardown),
        cmocka_unit_test_setup_teardown(random_expressions, setup, teardown),
        cmocka_unit_test_setup_teardown(random_bytes, setup, teardown),
        cmocka_unit_test_setup_teardown(memory_runs_out, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
