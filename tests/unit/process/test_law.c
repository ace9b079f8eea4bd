/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reference values: an independent computation in double precision (scipy) with the main ones
   checked in a second language; transmission against Monte Carlo with 4e5 paths. Six digits. */
#include "process/process_law.h"
#include "test.h"

typedef struct given {
    const char *name, *unit;
    double value, u; /* in `unit` */
} given;

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

static fw_quantity quantity(const given *g) {
    fw_quantity_unit unit;
    assert_true(fw_quantity_unit_parse(g->unit, strlen(g->unit), &unit, NULL, NULL));
    return (fw_quantity){.id = g->name,
                         .unknown = isnan(g->value),
                         .value = isnan(g->value) ? 0.0 : g->value * unit.factor + unit.offset,
                         .uncertainty = g->u * unit.factor,
                         .dimension = unit.dimension,
                         .unit = g->unit,
                         .status = FW_TYPICAL,
                         .source = "test"};
}

static fw_process_law_answer answer_of(const char *law, const char *shape, const char *expression,
                                       const given *g, int n, fw_process_step *step) {
    fw_quantity *q = fw_arena_array(arena, fw_quantity, (size_t)n);
    fw_process_argument *a = fw_arena_array(arena, fw_process_argument, (size_t)n);
    assert_true(q && a);
    for (int i = 0; i < n; i++) {
        q[i] = quantity(&g[i]);
        a[i] = (fw_process_argument){g[i].name, &q[i]};
    }
    fw_process_law_use use = {.law = fw_process_law_find(law),
                              .shape = shape,
                              .expression = expression,
                              .wanted = FW_DIM_TIME,
                              .argument = a,
                              .nargument = n};
    fw_process_law_answer answer;
    assert_non_null(use.law);
    assert_int_equal(fw_process_law_evaluate(arena, &use, &answer), FW_OK);
    if (step && use.law->derive)
        assert_int_equal(use.law->derive(arena, &use, &answer, step), FW_OK);
    return answer;
}

#define TIME_OF(law, ...)                                                                          \
    answer_of(law, "", "", (const given[]){__VA_ARGS__},                                           \
              (int)(sizeof((const given[]){__VA_ARGS__}) / sizeof(given)), NULL)

static const fw_quantity *derived(const fw_process_step *step, const char *name) {
    for (int i = 0; i < step->nderived; i++)
        if (strcmp(step->derived[i]->id, name) == 0) return step->derived[i];
    fail_msg("no derived quantity '%s'", name);
    return NULL;
}

static void faraday(void **state) {
    (void)state;
    static const double eta[] = {1.0, 0.98, 0.97, 0.95, 0.90};
    static const double want[] = {1224.400778, 1249.388549, 1262.268843, 1288.842924, 1360.445309};
    for (int i = 0; i < 5; i++) {
        fw_process_step step = {0};
        const given g[] = {{"thickness", "um", 9, 0},
                           {"density", "g/cm3", 8.96, 0.0448},
                           {"current_density", "mA/cm2", 20, 0.2},
                           {"valence", "1", 2, 0},
                           {"molar_mass", "g/mol", 63.546, 0},
                           {"efficiency", "1", eta[i], 0.02},
                           {"area", "cm2", 10, 0.5}};
        fw_process_law_answer a = answer_of("faraday", "", "", g, 7, &step);
        assert_true(a.computable);
        assert_relative(a.value, want[i], 1e-9);
        if (i != 2) continue;
        assert_relative(derived(&step, "current")->value, 0.2, 1e-12);
        assert_relative(derived(&step, "charge")->value, 252.4537686, 1e-8);
        assert_relative(fw_quantity_in_unit(derived(&step, "charge, as the supply shows it")),
                        0.0701260468, 1e-8);
        assert_relative(fw_quantity_in_unit(derived(&step, "mass deposited")), 80.64, 1e-9);
        /* eta 2 %, supply 1 %, area 5 %, density 0.5 % */
        assert_relative(a.uncertainty / a.value, 0.05522793569, 1e-9);
        /* the current is set by current density and area; in the charge the current density cancels */
        assert_relative(derived(&step, "current")->uncertainty / 0.2, hypot(0.01, 0.05), 1e-9);
        assert_relative(derived(&step, "charge")->uncertainty / derived(&step, "charge")->value,
                        sqrt(0.05522793569 * 0.05522793569 - 0.0001), 1e-9);
        assert_string_equal(a.contribution[0], "area 5 %");
        assert_string_equal(a.contribution[1], "efficiency 2.06 %");
        fw_process_time time;
        fw_process_law_window(&a, 2.0, 0.0, &time);
        assert_relative(time.first_look_s, 1122.843838, 1e-9);
        assert_relative(time.clear_by_s, 1401.693848, 1e-9);
    }
}

static void faraday_porous(void **state) {
    (void)state;
    static const double d[] = {2.0, 5.0}, want[] = {110.4149070, 276.0372676};
    for (int i = 0; i < 2; i++) {
        fw_process_law_answer a =
            TIME_OF("faraday", {"thickness", "um", d[i], 0}, {"density", "g/cm3", 2.329, 0},
                    {"current_density", "mA/cm2", 20, 0}, {"valence", "1", 2.3, 0},
                    {"molar_mass", "g/mol", 28.0855, 0}, {"porosity", "1", 0.6, 0});
        assert_relative(a.value, want[i], 1e-9);
    }
}

static void rate_and_window(void **state) {
    (void)state;
    fw_process_time time;
    fw_process_law_answer a =
        TIME_OF("rate", {"thickness", "um", 1, 0.025}, {"rate", "Ao/s", 10, 1});
    fw_process_law_window(&a, 2.0, 0.1, &time);
    assert_relative(time.nominal_s, 1000.0, 1e-12);
    assert_relative(time.first_look_s, 793.8447, 1e-6);
    assert_relative(time.clear_by_s, 1206.1553, 1e-6);
    assert_relative(time.stop_s, 1326.7708, 1e-6);
    fw_process_law_window(&a, 2.0, 0.2, &time);
    assert_relative(time.stop_s, 1447.386, 1e-6);
    assert_string_equal(a.contribution[0], "rate 10 %");
    a = TIME_OF("rate", {"thickness", "um", 50, 0.5}, {"rate", "um/min", 50.0 / 90.0, 2.5 / 90.0});
    fw_process_law_window(&a, 2.0, 0.1, &time);
    assert_relative(time.nominal_s / 60.0, 90.0, 1e-12);
    assert_relative(time.first_look_s / 60.0, 80.8218, 1e-6);
    assert_relative(time.clear_by_s / 60.0, 99.1782, 1e-6);
    assert_relative(time.stop_s / 60.0, 109.0961, 1e-6);
    assert_int_equal(time.status, FW_TYPICAL);
    fw_process_law_window(&a, 1000.0, 0.1, &time);
    assert_true(time.first_look_s >= 0.0);
}

static void arrhenius(void **state) {
    (void)state;
    static const double T[] = {17, 22, 27, 30, 40, 50},
                        want[] = {1403.217, 1000.0, 720.737, 595.244, 323.037, 182.069};
    for (int i = 0; i < 6; i++) {
        fw_process_law_answer a =
            TIME_OF("arrhenius", {"thickness", "um", 1, 0}, {"rate", "Ao/s", 10, 0},
                    {"activation_energy", "eV", 0.5, 0}, {"reference_temperature", "K", 295.15, 0},
                    {"temperature", "Cel", T[i], 1.0});
        assert_near(a.value, want[i], 6e-4);
        if (i == 1) /* 6.66 % per kelvin */
            assert_relative(a.uncertainty / a.value, 0.066605721886, 1e-6);
    }
}

static void knudsen(void **state) {
    (void)state;
    static const double x[] = {0.1, 0.5, 1, 2, 5, 10, 25, 50},
                        slot[] = {0.952452, 0.804725, 0.684384, 0.542060,
                                  0.356480, 0.240805, 0.132381, 0.080348},
                        cylinder[] = {0.909215, 0.671984, 0.514232, 0.356575,
                                      0.190994, 0.109384, 0.048508, 0.025289};
    for (int i = 0; i < 8; i++) {
        assert_near(fw_process_knudsen_slot(x[i]), slot[i], 5.1e-7);
        assert_near(fw_process_knudsen_cylinder(2.0 * x[i]), cylinder[i], 5.1e-7);
    }
    /* the published formulas in 60 digits */
    static const double exact[][3] = {
        {1e-6, 0.99999950000025, 0.99999950000025},
        {3e-5, 0.99998500022499887, 0.99998500022499719},
        {0.0009, 0.99955020246958402, 0.999550202424083},
        {0.0011, 0.99945030244445022, 0.99945030236139991},
        {0.03, 0.98522382530455499, 0.98522221268891684},
        {0.7, 0.7502130632084744, 0.74340983374693227},
        {5, 0.35647958097201873, 0.31053455380701209},
        {19, 0.15967039664928552, 0.11421874522711752},
        {21, 0.14923261980352557, 0.10494743401258423},
        {300, 0.019529702800511269, 0.0087082737468760086},
        {1000, 0.0070829224176362711, 0.0026478714502270541},
        {10000, 0.00094000226460675776, 0.00026643200512995095},
    };
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        assert_relative(fw_process_knudsen_slot(exact[i][0]), exact[i][1], 1e-14);
        assert_relative(fw_process_knudsen_cylinder(exact[i][0]), exact[i][2], 1e-14);
    }
    /* each form meets the next: 2e-12 of x apart, and K falls more slowly than 1/x */
    static const double seam[] = {1e-3, 20.0};
    for (int i = 0; i < 2; i++) {
        double a = seam[i] * (1 - 1e-12), b = seam[i] * (1 + 1e-12);
        assert_relative(fw_process_knudsen_slot(a), fw_process_knudsen_slot(b), 4e-12);
        assert_relative(fw_process_knudsen_cylinder(a), fw_process_knudsen_cylinder(b), 4e-12);
    }
    assert_near(fw_process_knudsen_slot(0.0), 1.0, 0.0);
    assert_near(fw_process_knudsen_cylinder(0.0), 1.0, 0.0);
    for (double a = 1e-6; a < 1e3; a *= 1.7) {
        assert_true(fw_process_knudsen_slot(a) > fw_process_knudsen_slot(1.7 * a));
        assert_true(fw_process_knudsen_cylinder(a) > fw_process_knudsen_cylinder(1.7 * a));
    }
}

static void arde_integral(void **state) {
    (void)state;
    static const double w[] = {2, 5, 10, 20, 50, 100},
                        J[] = {181.912, 86.9866, 49.1898, 27.2509, 11.9227, 6.15046};
    for (int i = 0; i < 6; i++)
        assert_relative(1e6 * fw_process_arde_integral(w[i] * 1e-6, 50e-6, false), J[i], 5e-6);
    /* additive in depth, homogeneous in size */
    double a = fw_process_arde_integral(7e-6, 31e-6, true),
           b = fw_process_arde_integral(14e-6, 62e-6, true);
    assert_relative(b, 2.0 * a, 1e-13);
    /* small aspect ratio: 1/K - 1 = x/2 + O(x^3) for the slot */
    assert_relative(fw_process_arde_integral(1.0, 1e-3, false), 0.25e-6, 1e-5);
}

static void arde(void **state) {
    (void)state;
    static const double w[] = {2, 5, 10, 20, 50, 100}, S[] = {0.02, 0.1, 0.2, 0.5};
    static const double want[6][4] = {
        {96.5488, 122.744, 155.488, 253.721}, {93.1315, 105.658, 121.315, 168.288},
        {91.7708, 98.8542, 107.708, 134.271}, {90.9810, 94.9052, 99.8103, 114.526},
        {90.4292, 92.1461, 94.2922, 100.730}, {90.2214, 91.1071, 92.2142, 95.5354}};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 4; k++) {
            fw_process_law_answer a =
                TIME_OF("arde", {"depth", "um", 50, 0}, {"rate", "um/min", 50.0 / 90.0, 0},
                        {"width", "um", w[i], 0}, {"probability", "1", S[k], 0});
            assert_relative(a.value / 60.0, want[i][k], 6e-6);
        }
    const given linear[] = {{"depth", "um", 50, 0},
                            {"rate", "um/min", 1, 0},
                            {"width", "um", 10, 0},
                            {"lag", "1", 0.1, 0}};
    fw_process_law_answer a = answer_of("arde", "linear", "", linear, 4, NULL);
    assert_relative(a.value / 60.0, 50.0 + 0.1 * 2500.0 / 20.0, 1e-12);
    a = answer_of("arde", "slot", "", linear, 4, NULL); /* a lag is no probability */
    assert_false(a.computable);
    a = answer_of("arde", "triangle", "", linear, 4, NULL);
    assert_false(a.computable);
}

/* two slots of one wafer give S and R0 back, and so every other time */
static void arde_calibration(void **state) {
    (void)state;
    double d1 = 45.0, d2 = 48.5, J1 = 1e6 * fw_process_arde_integral(10e-6, d1 * 1e-6, false),
           J2 = 1e6 * fw_process_arde_integral(100e-6, d2 * 1e-6, false);
    double S = (d2 - d1) / (J1 - J2), R0 = (d1 + S * J1) / 90.0;
    assert_relative(S, 0.100745, 6e-6);
    assert_relative(R0, 0.545372, 2e-6);
    assert_relative((50.0 + S * 1e6 * fw_process_arde_integral(5e-6, 50e-6, false)) / R0, 107.749,
                    6e-6);
}

static void loading(void **state) {
    (void)state;
    static const double A[] = {5, 10, 30, 50, 70},
                        want[] = {72.6923, 76.1538, 90.0, 103.8462, 117.6923};
    for (int i = 0; i < 5; i++) {
        fw_process_law_answer a =
            TIME_OF("loading", {"thickness", "um", 50, 0}, {"rate", "um/min", 50.0 / 90.0, 0},
                    {"loading", "cm-2", 0.01, 0}, {"open_area", "cm2", A[i], 0},
                    {"reference_area", "cm2", 30, 0});
        assert_relative(a.value / 60.0, want[i], 1e-6);
        fw_process_law_answer slot = TIME_OF(
            "arde", {"depth", "um", 50, 0}, {"rate", "um/min", 50.0 / 90.0, 0},
            {"width", "um", 10, 0}, {"probability", "1", 0.1, 0}, {"loading", "cm-2", 0.01, 0},
            {"open_area", "cm2", A[i], 0}, {"reference_area", "cm2", 30, 0});
        assert_relative(slot.value / a.value, 98.854173 / 90.0, 1e-6);
    }
}

static void spin(void **state) {
    (void)state;
    static const double d[] = {8.0, 16.0 / 1.9, 16.0 / 2.1, 16.0},
                        want[] = {2402.5, 2168.25625, 2648.75625, 600.625};
    for (int i = 0; i < 4; i++) {
        fw_process_step step = {0};
        const given g[] = {{"thickness", "um", d[i], 0.02 * d[i]},
                           {"reference_thickness", "um", 6.2, 0},
                           {"reference_speed", "rpm", 4000, 0},
                           {"exponent", "1", 0.5, 0},
                           {"time", "s", 60, 0}};
        assert_relative(answer_of("spin", "", "", g, 5, &step).value, 60.0, 1e-12);
        assert_relative(fw_quantity_in_unit(derived(&step, "spin speed")), want[i], 1e-9);
        assert_relative(derived(&step, "spin speed")->uncertainty /
                            derived(&step, "spin speed")->value,
                        0.04, 1e-9);
    }
}

static void dose(void **state) {
    (void)state;
    static const double I[] = {8, 10, 20}, want[] = {176.7857143, 141.4285714, 70.71428571};
    for (int i = 0; i < 3; i++) {
        fw_process_step step = {0};
        const given g[] = {{"intensity", "mW/cm2", I[i], 0.05 * I[i]},
                           {"thickness", "um", 16, 0},
                           {"thickness_1", "um", 10, 0},
                           {"dose_1", "mJ/cm2", 900, 0},
                           {"thickness_2", "um", 24, 0},
                           {"dose_2", "mJ/cm2", 2100, 0}};
        fw_process_law_answer a = answer_of("dose", "", "", g, 6, &step);
        assert_relative(a.value, want[i], 1e-9);
        assert_relative(a.uncertainty / a.value, 0.05, 1e-6);
        assert_relative(fw_quantity_in_unit(derived(&step, "dose")), 1414.285714, 1e-9);
    }
    /* u(D) 7 %, u(I) 5 %: 117.1 to 165.8 s */
    fw_process_time time;
    fw_process_law_answer a = TIME_OF("dose", {"intensity", "mW/cm2", 10, 0.5},
                                      {"dose", "mJ/cm2", 1414.2857143, 0.07 * 1414.2857143});
    fw_process_law_window(&a, 2.0, 0.0, &time);
    assert_near(time.first_look_s, 117.1, 0.05);
    assert_near(time.clear_by_s, 165.8, 0.05);
    /* the same from two entries of one table with 7 % each: their errors go together */
    a = TIME_OF("dose", {"intensity", "mW/cm2", 10, 0.5}, {"thickness", "um", 16, 0.5},
                {"thickness_1", "um", 10, 0}, {"dose_1", "mJ/cm2", 900, 63},
                {"thickness_2", "um", 24, 0}, {"dose_2", "mJ/cm2", 2100, 147});
    /* and the thickness counts with the slope of the table, 1200/14 mJ/cm2 per um */
    double slope = 1200.0 / 14 * 0.5 / (900 + 1200.0 * 6 / 14);
    assert_relative(a.uncertainty / a.value, hypot(hypot(0.07, 0.05), slope), 1e-8);
    assert_int_equal(a.ncontribution, 3);
    assert_string_equal(a.contribution[0], "dose table 7 %");
    assert_string_equal(a.contribution[1], "intensity 5 %");
    fw_process_law_window(&a, 2.0, 0.0, &time);
    assert_near(time.first_look_s, 115.63, 0.01);
    assert_near(time.clear_by_s, 167.23, 0.01);
    a = TIME_OF("dose", {"intensity", "mW/cm2", 10, 0}, {"thickness", "um", 25, 0},
                {"thickness_1", "um", 10, 0}, {"dose_1", "mJ/cm2", 900, 0},
                {"thickness_2", "um", 24, 0}, {"dose_2", "mJ/cm2", 2100, 0});
    assert_false(a.computable); /* never extrapolated */
    assert_non_null(strstr(a.missing[0], "never extrapolated"));
}

static void simple_laws(void **state) {
    (void)state;
    fw_process_law_answer a =
        TIME_OF("diffusion", {"thickness", "um", 16, 0}, {"reference_thickness", "um", 10, 0},
                {"reference_time", "min", 30, 0});
    assert_relative(a.value / 60.0, 76.8, 1e-12);
    a = TIME_OF("dilution", {"volume", "L", 10, 0}, {"flow", "L/min", 10, 0},
                {"dilution", "1", 1e4, 0});
    assert_relative(a.value / 60.0, 9.210340372, 1e-9);
    assert_false(TIME_OF("dilution", {"volume", "L", 10, 0}, {"flow", "L/min", 10, 0},
                         {"dilution", "1", 0.5, 0})
                     .computable);
    a = TIME_OF("const", {"time", "min", 5, 1});
    assert_relative(a.value, 300.0, 1e-12);
    assert_relative(a.uncertainty, 60.0, 1e-6);
}

static void duty(void **state) {
    (void)state;
    fw_process_step step = {0};
    const given g[] = {
        {"time", "s", 141.4285714286, 7}, {"pulse", "s", 20, 0}, {"pause", "s", 30, 0}};
    fw_process_law_answer a = answer_of("duty", "", "", g, 3, &step);
    assert_relative(a.value, 351.4285714286, 1e-12);
    /* 7.07 +- 0.35 parts: 7 or 8, and now and then 9 */
    assert_relative(a.uncertainty, 7.0 + 30.0 * (0.35 + 0.5), 1e-12);
    a = TIME_OF("duty", {"time", "s", 151, 3}, {"pulse", "s", 20, 0}, {"pause", "s", 30, 0});
    assert_relative(a.uncertainty, 3.0, 1e-12); /* 8 parts for sure */
    assert_near(derived(&step, "number of parts")->value, 8.0, 0.0);
    a = TIME_OF("duty", {"time", "s", 40, 0}, {"pulse", "s", 20, 0}, {"pause", "s", 30, 0});
    assert_near(a.value, 70.0, 1e-12);
    a = TIME_OF("duty", {"time", "s", 5, 0}, {"pulse", "s", 20, 0}, {"pause", "s", 30, 0});
    assert_near(a.value, 5.0, 1e-12);
}

static void lab_table(void **state) {
    (void)state;
    const given g[] = {
        {"value", "um", 0.3, 0.03}, {"value_1", "um", 0.1, 0}, {"time_1", "min", 1, 0},
        {"value_2", "um", 0.2, 0},  {"time_2", "min", 3, 0},   {"value_3", "um", 0.4, 0},
        {"time_3", "min", 5, 0},    {"shortest", "min", 2, 0}, {"longest", "min", 4.5, 0}};
    fw_process_law_answer a = answer_of("table", "", "", g, 9, NULL);
    assert_relative(a.value, 240.0, 1e-12);
    assert_relative(a.uncertainty, 18.0, 1e-6); /* slope 600 s/um */
    fw_process_time time; /* what is too long by then is stopped then: t + k u is 276 s */
    fw_process_law_window(&a, 2.0, 0.1, &time);
    assert_relative(time.first_look_s, 204.0, 1e-9);
    assert_relative(time.clear_by_s, 270.0, 1e-12);
    assert_relative(time.stop_s, 270.0, 1e-12);
    fw_process_law_window(&a, 8.0, 0.0, &time);
    assert_relative(time.first_look_s, 120.0, 1e-12);
    given later[9];
    memcpy(later, g, sizeof g);
    later[0].value = 0.38; /* 4.8 min: after the longest */
    a = answer_of("table", "", "", later, 9, NULL);
    assert_false(a.computable);
    assert_non_null(strstr(a.missing[0], "288 s, is above the longest allowed, 270 s"));
    later[0].value = 0.3;
    later[3].value = 0.05; /* does not rise */
    assert_false(answer_of("table", "", "", later, 9, NULL).computable);
    /* a pair without its second number ends the table */
    const double pairs[] = {0.1, 1, 0.2, 3, 0.4, (double)NAN, 0.5, 6};
    const char *why;
    double y;
    assert_true(fw_process_table_between(pairs, 4, 0.15, &y, &why));
    assert_relative(y, 2, 1e-12);
    assert_false(fw_process_table_between(pairs, 4, 0.3, &y, &why));
    assert_non_null(strstr(why, "outside the table"));
}

static void expr(void **state) {
    (void)state;
    const given g[] = {{"d", "um", 50, 0.5}, {"R", "um/min", 0.5, 0.025}};
    fw_process_law_answer a = answer_of("expr", "", "d/R*(1 + 0.1) + 2 min", g, 2, NULL);
    assert_true(a.computable);
    assert_relative(a.value / 60.0, 112.0, 1e-12);
    assert_relative(a.uncertainty / 60.0, 110.0 * hypot(0.01, 0.05), 1e-6);
    a = answer_of("expr", "", "d*R", g, 2, NULL); /* not a time */
    assert_false(a.computable);
}

static void missing_inputs(void **state) {
    (void)state;
    fw_process_law_answer a =
        TIME_OF("rate", {"thickness", "um", (double)NAN, 0}, {"rate", "Ao/s", (double)NAN, 0});
    assert_false(a.computable);
    assert_int_equal(a.nmissing, 2);
    assert_string_equal(a.missing[0], "thickness (thickness)");
    a = TIME_OF("rate", {"thickness", "um", 1, 0});
    assert_false(a.computable);
    assert_string_equal(a.missing[0], "rate");
    a = TIME_OF("rate", {"thickness", "um", 1, 0}, {"rate", "Ao/s", 0, 0});
    assert_false(a.computable);
    a = TIME_OF("rate", {"thickness", "um", 1, 0}, {"rate", "Ao/s", -1, 0});
    assert_false(a.computable);
}

/* analytic slopes against differences of the law itself, on deterministic pseudo-random input */
static void slopes(void **state) {
    (void)state;
    unsigned seed = 12345;
    for (int l = 0; fw_process_law_row(l); l++) {
        const fw_process_law *law = fw_process_law_row(l);
        if (!law->slope || law == &fw_process_law_duty || law == &fw_process_law_dose)
            continue; /* their own tests */
        for (int trial = 0; trial < 50; trial++) {
            double x[FW_LAW_ARGUMENTS], dx[FW_LAW_ARGUMENTS], f, f1, f2;
            fw_process_law_call call = {.shape = "", .expression = ""};
            for (int i = 0; i < law->nargument; i++) {
                seed = seed * 1664525u + 1013904223u;
                x[i] = 0.5 + (seed >> 8) / 16777216.0;
            }
            if (law == &fw_process_law_arrhenius) x[2] *= 1.380649e-23; /* J, at some kelvin */
            assert_int_equal(law->evaluate(&call, x, &f), FW_OK);
            law->slope(x, f, dx);
            for (int i = 0; i < law->nargument; i++) {
                if (law == &fw_process_law_faraday && strcmp(law->argument[i].name, "area") == 0) {
                    assert_relative(dx[i], f / x[i], 1e-12);
                    continue;
                }
                double at = x[i], h = 1e-5;
                x[i] = at + h;
                law->evaluate(&call, x, &f2);
                x[i] = at - h;
                law->evaluate(&call, x, &f1);
                x[i] = at;
                if (isnan(dx[i])) continue; /* left to the difference */
                assert_near((f2 - f1) / (2.0 * h), dx[i], 1e-7 * (1.0 + fabs(dx[i])));
            }
        }
    }
}

static void uncertainty(void **state) {
    (void)state;
    /* one quantity in two places adds up before squaring: d/(d/1 s) has no uncertainty */
    fw_quantity q = quantity(&(given){"d", "um", 3, 0.3});
    fw_process_argument a[] = {{"d", &q}, {"e", &q}};
    fw_process_law_use use = {.law = &fw_process_law_expr,
                              .expression = "1 s*d/e",
                              .wanted = FW_DIM_TIME,
                              .argument = a,
                              .nargument = 2};
    fw_process_law_answer answer;
    assert_int_equal(fw_process_law_evaluate(arena, &use, &answer), FW_OK);
    assert_near(answer.uncertainty, 0.0, 1e-9);
    q.status = FW_ASSUMED;
    assert_int_equal(fw_process_law_evaluate(arena, &use, &answer), FW_OK);
    assert_int_equal(answer.status, FW_ASSUMED);
}

static void units(void **state) {
    (void)state;
    fw_quantity q = quantity(&(given){"p", "mTorr", 80, 0});
    assert_relative(q.value, 10.66579, 1e-6);
    q = quantity(&(given){"p", "mbar", 1.9e-2, 0});
    assert_relative(q.value, 1.9, 1e-12);
    assert_relative(q.value / (10.6657894736842 / 80.0), 14.25117, 1e-6);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {TEST(faraday),
                                       TEST(faraday_porous),
                                       TEST(rate_and_window),
                                       TEST(arrhenius),
                                       TEST(knudsen),
                                       TEST(arde_integral),
                                       TEST(arde),
                                       TEST(arde_calibration),
                                       TEST(loading),
                                       TEST(spin),
                                       TEST(dose),
                                       TEST(simple_laws),
                                       TEST(duty),
                                       TEST(lab_table),
                                       TEST(expr),
                                       TEST(missing_inputs),
                                       TEST(slopes),
                                       TEST(uncertainty),
                                       TEST(units)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
