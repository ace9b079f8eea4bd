/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every unit against a table written down from the SI brochure and CODATA 2018. */
#include "quantity/quantity.h"
#include "test.h"

typedef struct row {
    const char *symbol;
    double factor, offset;
    int m, kg, s, A, K, mol, rad;
} row;

static const row literal[] = {
    {"1", 1.0, 0.0, 0, 0, 0, 0, 0, 0, 0},
    {"%", 0.01, 0.0, 0, 0, 0, 0, 0, 0, 0},
    {"ppm", 9.9999999999999995e-07, 0.0, 0, 0, 0, 0, 0, 0, 0},
    {"m", 1.0, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"km", 1000.0, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"dm", 0.10000000000000001, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"cm", 0.01, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"mm", 0.001, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"um", 9.9999999999999995e-07, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"nm", 1.0000000000000001e-09, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"pm", 9.9999999999999998e-13, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"Ao", 1e-10, 0.0, 1, 0, 0, 0, 0, 0, 0},
    {"kg", 1.0, 0.0, 0, 1, 0, 0, 0, 0, 0},
    {"g", 0.001, 0.0, 0, 1, 0, 0, 0, 0, 0},
    {"mg", 9.9999999999999995e-07, 0.0, 0, 1, 0, 0, 0, 0, 0},
    {"ug", 1.0000000000000001e-09, 0.0, 0, 1, 0, 0, 0, 0, 0},
    {"ng", 9.9999999999999998e-13, 0.0, 0, 1, 0, 0, 0, 0, 0},
    {"s", 1.0, 0.0, 0, 0, 1, 0, 0, 0, 0},
    {"ms", 0.001, 0.0, 0, 0, 1, 0, 0, 0, 0},
    {"us", 9.9999999999999995e-07, 0.0, 0, 0, 1, 0, 0, 0, 0},
    {"ns", 1.0000000000000001e-09, 0.0, 0, 0, 1, 0, 0, 0, 0},
    {"min", 60.0, 0.0, 0, 0, 1, 0, 0, 0, 0},
    {"h", 3600.0, 0.0, 0, 0, 1, 0, 0, 0, 0},
    {"Hz", 1.0, 0.0, 0, 0, -1, 0, 0, 0, 0},
    {"kHz", 1000.0, 0.0, 0, 0, -1, 0, 0, 0, 0},
    {"MHz", 1000000.0, 0.0, 0, 0, -1, 0, 0, 0, 0},
    {"GHz", 1000000000.0, 0.0, 0, 0, -1, 0, 0, 0, 0},
    {"N", 1.0, 0.0, 1, 1, -2, 0, 0, 0, 0},
    {"kN", 1000.0, 0.0, 1, 1, -2, 0, 0, 0, 0},
    {"mN", 0.001, 0.0, 1, 1, -2, 0, 0, 0, 0},
    {"uN", 9.9999999999999995e-07, 0.0, 1, 1, -2, 0, 0, 0, 0},
    {"nN", 1.0000000000000001e-09, 0.0, 1, 1, -2, 0, 0, 0, 0},
    {"pN", 9.9999999999999998e-13, 0.0, 1, 1, -2, 0, 0, 0, 0},
    {"Pa", 1.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"mPa", 0.001, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"uPa", 9.9999999999999995e-07, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"hPa", 100.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"kPa", 1000.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"MPa", 1000000.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"GPa", 1000000000.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"bar", 100000.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"mbar", 100.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"atm", 101325.0, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"Torr", 133.32236842105263, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"mTorr", 0.13332236842105263, 0.0, -1, 1, -2, 0, 0, 0, 0},
    {"J", 1.0, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"kJ", 1000.0, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"mJ", 0.001, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"uJ", 9.9999999999999995e-07, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"nJ", 1.0000000000000001e-09, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"eV", 1.6021766339999999e-19, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"keV", 1.6021766339999999e-16, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"meV", 1.6021766340000001e-22, 0.0, 2, 1, -2, 0, 0, 0, 0},
    {"W", 1.0, 0.0, 2, 1, -3, 0, 0, 0, 0},
    {"kW", 1000.0, 0.0, 2, 1, -3, 0, 0, 0, 0},
    {"mW", 0.001, 0.0, 2, 1, -3, 0, 0, 0, 0},
    {"uW", 9.9999999999999995e-07, 0.0, 2, 1, -3, 0, 0, 0, 0},
    {"A", 1.0, 0.0, 0, 0, 0, 1, 0, 0, 0},
    {"mA", 0.001, 0.0, 0, 0, 0, 1, 0, 0, 0},
    {"uA", 9.9999999999999995e-07, 0.0, 0, 0, 0, 1, 0, 0, 0},
    {"nA", 1.0000000000000001e-09, 0.0, 0, 0, 0, 1, 0, 0, 0},
    {"V", 1.0, 0.0, 2, 1, -3, -1, 0, 0, 0},
    {"kV", 1000.0, 0.0, 2, 1, -3, -1, 0, 0, 0},
    {"mV", 0.001, 0.0, 2, 1, -3, -1, 0, 0, 0},
    {"uV", 9.9999999999999995e-07, 0.0, 2, 1, -3, -1, 0, 0, 0},
    {"C", 1.0, 0.0, 0, 0, 1, 1, 0, 0, 0},
    {"mC", 0.001, 0.0, 0, 0, 1, 1, 0, 0, 0},
    {"uC", 9.9999999999999995e-07, 0.0, 0, 0, 1, 1, 0, 0, 0},
    {"ohm", 1.0, 0.0, 2, 1, -3, -2, 0, 0, 0},
    {"mohm", 0.001, 0.0, 2, 1, -3, -2, 0, 0, 0},
    {"kohm", 1000.0, 0.0, 2, 1, -3, -2, 0, 0, 0},
    {"Mohm", 1000000.0, 0.0, 2, 1, -3, -2, 0, 0, 0},
    {"F", 1.0, 0.0, -2, -1, 4, 2, 0, 0, 0},
    {"uF", 9.9999999999999995e-07, 0.0, -2, -1, 4, 2, 0, 0, 0},
    {"nF", 1.0000000000000001e-09, 0.0, -2, -1, 4, 2, 0, 0, 0},
    {"pF", 9.9999999999999998e-13, 0.0, -2, -1, 4, 2, 0, 0, 0},
    {"fF", 1.0000000000000001e-15, 0.0, -2, -1, 4, 2, 0, 0, 0},
    {"T", 1.0, 0.0, 0, 1, -2, -1, 0, 0, 0},
    {"mT", 0.001, 0.0, 0, 1, -2, -1, 0, 0, 0},
    {"uT", 9.9999999999999995e-07, 0.0, 0, 1, -2, -1, 0, 0, 0},
    {"K", 1.0, 0.0, 0, 0, 0, 0, 1, 0, 0},
    {"mK", 0.001, 0.0, 0, 0, 0, 0, 1, 0, 0},
    {"Cel", 1.0, 273.15, 0, 0, 0, 0, 1, 0, 0},
    {"mol", 1.0, 0.0, 0, 0, 0, 0, 0, 1, 0},
    {"mmol", 0.001, 0.0, 0, 0, 0, 0, 0, 1, 0},
    {"umol", 9.9999999999999995e-07, 0.0, 0, 0, 0, 0, 0, 1, 0},
    {"kmol", 1000.0, 0.0, 0, 0, 0, 0, 0, 1, 0},
    {"M", 1000.0, 0.0, -3, 0, 0, 0, 0, 1, 0},
    {"L", 0.001, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"dL", 0.0001, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"cL", 1.0000000000000001e-05, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"mL", 9.9999999999999995e-07, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"uL", 1.0000000000000001e-09, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"l", 0.001, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"ml", 9.9999999999999995e-07, 0.0, 3, 0, 0, 0, 0, 0, 0},
    {"rad", 1.0, 0.0, 0, 0, 0, 0, 0, 0, 1},
    {"mrad", 0.001, 0.0, 0, 0, 0, 0, 0, 0, 1},
    {"urad", 9.9999999999999995e-07, 0.0, 0, 0, 0, 0, 0, 0, 1},
    {"deg", 0.017453292519943295, 0.0, 0, 0, 0, 0, 0, 0, 1},
    {"rpm", 0.10471975511965978, 0.0, 0, 0, -1, 0, 0, 0, 1},
    {"{sccm}", 7.4358389009117184e-07, 0.0, 0, 0, -1, 0, 0, 1, 0},
};
enum { COUNT = sizeof literal / sizeof literal[0] };

static bool parse(const char *text, fw_quantity_unit *unit) {
    return fw_quantity_unit_parse(text, strlen(text), unit, NULL, NULL);
}

static void every_symbol_has_its_value(void **state) {
    (void)state;
    size_t count;
    const char *const *names = fw_quantity_unit_names(&count);
    size_t currencies = 0;
    for (size_t i = 0; i < count; i++) {
        const row *r = literal;
        if (fw_quantity_unit_currency(names[i])) {
            currencies++;
            continue;
        }
        while (r < literal + COUNT && strcmp(r->symbol, names[i]) != 0)
            r++;
        if (r == literal + COUNT) fail_msg("%s is not in the literal table", names[i]);
        fw_quantity_unit unit;
        assert_true(parse(names[i], &unit));
        assert_relative(unit.factor, r->factor, 4e-16);
        assert_near(unit.offset, r->offset, 0.0);
        fw_quantity_dimension d = unit.dimension;
        int got[] = {d.m, d.kg, d.s, d.A, d.K, d.mol, d.rad, d.money};
        int want[] = {r->m, r->kg, r->s, r->A, r->K, r->mol, r->rad, 0};
        assert_memory_equal(got, want, sizeof got);
    }
    assert_int_equal(count, COUNT + currencies);
    assert_true(currencies >= 20);
}

/* all of one dimension, which no other unit has; named in what is composed of them */
static void currencies(void **state) {
    (void)state;
    static const struct {
        const char *text, *is;
        double factor;
        fw_quantity_dimension d;
    } at[] = {{"EUR", "EUR", 1, {.money = 1}},
              {"USD/L", "USD", 1e3, {.m = -3, .money = 1}},
              {"CHF/kg", "CHF", 1, {.kg = -1, .money = 1}},
              {"JPY h-1", "JPY", 1.0 / 3600, {.s = -1, .money = 1}}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        fw_quantity_unit unit;
        assert_true(parse(at[i].text, &unit));
        assert_relative(unit.factor, at[i].factor, 1e-14);
        assert_true(fw_quantity_dimension_equal(unit.dimension, at[i].d));
        assert_string_equal(fw_quantity_unit_currency(at[i].text), at[i].is);
    }
    assert_null(fw_quantity_unit_currency("um/min"));
    assert_null(fw_quantity_unit_currency("{sccm}"));
    assert_null(fw_quantity_unit_currency("EURO/L"));
    assert_null(fw_quantity_unit_currency(""));
}

static void composed_units(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double factor;
        fw_quantity_dimension d;
    } good[] = {
        {"N m/rad", 1.0, {2, 1, -2, 0, 0, 0, -1, 0}},
        {"N.m/rad", 1.0, {2, 1, -2, 0, 0, 0, -1, 0}},
        {"N*m/rad", 1.0, {2, 1, -2, 0, 0, 0, -1, 0}},
        {"mA/cm2", 10.0, {-2, 0, 0, 1, 0, 0, 0, 0}},
        {"Ao/s", 1e-10, {1, 0, -1, 0, 0, 0, 0, 0}},
        {"g/cm3", 1000.0, {-3, 1, 0, 0, 0, 0, 0, 0}},
        {"mg mm^2", 1e-12, {2, 1, 0, 0, 0, 0, 0, 0}},
        {"um^2", 1e-12, {2, 0, 0, 0, 0, 0, 0, 0}},
        {"s-1", 1.0, {0, 0, -1, 0, 0, 0, 0, 0}},
        {"s^-1", 1.0, {0, 0, -1, 0, 0, 0, 0, 0}},
        {"1/min", 1.0 / 60.0, {0, 0, -1, 0, 0, 0, 0, 0}},
        {"m/s/s", 1.0, {1, 0, -2, 0, 0, 0, 0, 0}},
        {"um/min", 1e-6 / 60.0, {1, 0, -1, 0, 0, 0, 0, 0}},
        {"kJ/mol", 1000.0, {2, 1, -2, 0, 0, -1, 0, 0}},
        {"W/m/Cel", 1.0, {1, 1, -3, 0, -1, 0, 0, 0}},
        {" um ", 1e-6, {1, 0, 0, 0, 0, 0, 0, 0}},
        {"%/K", 0.01, {0, 0, 0, 0, -1, 0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        fw_quantity_unit unit;
        if (!parse(good[i].text, &unit)) fail_msg("%s is refused", good[i].text);
        assert_relative(unit.factor, good[i].factor, 1e-15);
        assert_near(unit.offset, 0.0, 0.0);
        if (!fw_quantity_dimension_equal(unit.dimension, good[i].d))
            fail_msg("%s has the wrong dimension", good[i].text);
    }
}

/* U+00B5 and U+03BC, as people and the page write them */
static void the_sign_of_micro_is_u(void **state) {
    (void)state;
    static const char *const pair[][2] = {{"\xc2\xb5m", "um"}, {"\xce\xbcm", "um"}, {"\xc2\xb5N m/rad", "uN m/rad"}, {"N/\xce\xbcm^2", "N/um^2"}, {"\xc2\xb5" "Pa", "uPa"}};
    for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
        fw_quantity_unit mine, plain;
        assert_true(fw_quantity_unit_parse(pair[i][0], strlen(pair[i][0]), &mine, NULL, NULL));
        assert_true(fw_quantity_unit_parse(pair[i][1], strlen(pair[i][1]), &plain, NULL, NULL));
        assert_true(mine.factor == plain.factor);
        assert_memory_equal(&mine.dimension, &plain.dimension, sizeof plain.dimension);
    }
    fw_quantity_unit unit;
    assert_false(fw_quantity_unit_parse("\xc2\xb5", 2, &unit, NULL, NULL));
    assert_false(fw_quantity_unit_parse("\xc2m", 2, &unit, NULL, NULL));
}

static void wrong_units_point_at_the_symbol(void **state) {
    (void)state;
    static const struct {
        const char *text;
        size_t at, n;
    } bad[] = {{"", 0, 0},          {"foo", 0, 3},  {"N m/rod", 4, 3}, {"mA/", 3, 0},
               {"um um 1", 6, 1},   {"um+m", 2, 2}, {"{scfm}", 0, 6},  {"5 um", 0, 0},
               {"\xc2\xb5q", 0, 3}, {"m^", 1, 1},   {"um**2", 3, 0}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_quantity_unit unit;
        const char *wrong = NULL;
        size_t n = 99;
        if (fw_quantity_unit_parse(bad[i].text, strlen(bad[i].text), &unit, &wrong, &n))
            fail_msg("'%s' is accepted", bad[i].text);
        if (wrong != bad[i].text + bad[i].at || n != bad[i].n)
            fail_msg("'%s': at %td, %zu bytes", bad[i].text, wrong - bad[i].text, n);
    }
}

static void exponents_do_not_overflow(void **state) {
    (void)state;
    fw_quantity_unit unit;
    assert_true(parse("m^100", &unit));
    assert_false(parse("m^200", &unit));
    assert_false(parse("m^100 m^100", &unit));
    assert_false(parse("nm^99", &unit)); /* 1e-891 is not a number above 0 */
    assert_false(parse("m^1000", &unit));
}

/* a value that binary holds exactly becomes the double nearest to its decimal: "10 um" is 10e-6 */
static void decimals_stay_exact(void **state) {
    (void)state;
    static const struct {
        const char *unit;
        double written, si;
    } exact[] = {{"um", 10, 10e-6},
                 {"um", 8.5, 8.5e-6},
                 {"nm", 3, 3e-9},
                 {"mg", 0.0625, 0.0625e-6},
                 {"mg mm^2", 1.25, 1.25e-12},
                 {"mm", 2.875, 2.875e-3},
                 {"GPa", 169, 169e9},
                 {"min", 7, 420},
                 {"Cel", 20, 293.15},
                 {"uN mm", 1.5, 1.5e-9}};
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        fw_quantity_unit unit;
        assert_true(parse(exact[i].unit, &unit));
        assert_near(fw_quantity_unit_to_si(&unit, exact[i].written), exact[i].si, 0.0);
        assert_relative(fw_quantity_unit_from_si(&unit, exact[i].si), exact[i].written, 2e-16);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(currencies),
        cmocka_unit_test(every_symbol_has_its_value),
        cmocka_unit_test(composed_units),
        cmocka_unit_test(decimals_stay_exact),
        cmocka_unit_test(the_sign_of_micro_is_u),
        cmocka_unit_test(wrong_units_point_at_the_symbol),
        cmocka_unit_test(exponents_do_not_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
