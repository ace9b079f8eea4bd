/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of documents by their keys; weights of derivatives; values of inputs as text. */
#include "study/study_parts.h"
#include "test.h"
#include <math.h>
#include <string.h>

static const char document[] =
    "{\"governing\": {\"utilisation\": 0.5, \"utilisation_band\": [0.4, 0.6], \"flow\": \"a\"},"
    " \"hinges\": [{\"id\": \"A\", \"utilisation\": 0.25}, {\"id\": \"B\", \"utilisation\": 0.5},"
    "             {\"id\": \"C\", \"utilisation\": null}],"
    " \"requirements\": [{\"probe\": \"p\", \"scene\": \"s\", \"value\": 1e-6},"
    "                   {\"probe\": \"p\", \"scene\": \"t\", \"value\": 2e-6}],"
    " \"verdict\": \"accept\", \"none\": null, \"yes\": true, \"words\": [\"x\", \"y\"]}";

static fw_status parse(fw_arena *arena, const char *value, fw_device_respond_take take,
                       fw_study_response *r) {
    fw_diags diags = fw_diags_new(arena);
    fw_device_respond *asked = fw_arena_one(arena, fw_device_respond);
    *asked = (fw_device_respond){.name = "r", .value = value, .take = take};
    return fw_study_response_parse(arena, asked, &diags, r);
}

static void paths_lead_to_numbers(void **state) {
    const struct {
        const char *value;
        fw_device_respond_take take;
        double wanted;
    } row[] = {{"governing.utilisation", FW_TAKE_ONE, 0.5},
               {"governing.utilisation_band[1]", FW_TAKE_ONE, 0.6},
               {"verdict: governing.utilisation", FW_TAKE_ONE, 0.5},
               {"hinges[A].utilisation", FW_TAKE_ONE, 0.25},
               {"hinges[1].utilisation", FW_TAKE_ONE, 0.5},
               {"hinges[*].utilisation", FW_TAKE_LARGEST, 0.5},
               {"hinges[*].utilisation", FW_TAKE_LEAST, 0.25},
               {"requirements[p,t].value", FW_TAKE_ONE, 2e-6},
               {"requirements[p].value", FW_TAKE_SUM, 3e-6},
               {"verdict", FW_TAKE_ONE, 1},
               {"yes", FW_TAKE_ONE, 1}};
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    json_t *root = json_loads(document, 0, NULL);
    char why[FW_STUDY_WHY];
    double value;
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_study_response r;
        assert_int_equal(parse(arena, row[i].value, row[i].take, &r), FW_OK);
        if (!fw_study_response_find(&r, root, &value, NULL, why, sizeof why) ||
            fabs(value - row[i].wanted) > 1e-18)
            fail_msg("%s: %g, wanted %g (%s)", row[i].value, value, row[i].wanted, why);
    }
    fw_study_response r; /* what would hold it is null: no number, and no mistake */
    const char *const null[] = {"none", "none.below", "none[A].x", "hinges[C].utilisation"};
    for (size_t i = 0; i < sizeof null / sizeof null[0]; i++) {
        assert_int_equal(parse(arena, null[i], FW_TAKE_ONE, &r), FW_OK);
        assert_true(fw_study_response_find(&r, root, &value, NULL, why, sizeof why));
        assert_true(isnan(value));
    }
    json_decref(root);
    fw_arena_free(arena);
}

static void numbers_are_told_in_percent_and_with_prefixes(void **state) {
    const struct {
        const char *path;
        double value;
        const char *said, *drawn_in;
    } row[] = {{"governing.utilisation", 0.38449, "38.4 %", "%"},
               {"hinges[A].utilisation_band[1]", 1.2, "120 %", "%"},
               {"hinges[*].fatigue_cycles", 0.38449, "0.38449", ""},
               {"hinges[A].peak_angle_rad", 0.38449, "0.38449 rad", "rad"},
               {"hinges[A].peak_angle_rad", 0.0038449, "0.0038449 rad", "rad"},
               {"requirements[p].gap_m", -0.00025194, "-251.94 um", "m"},
               {"requirements[p].gap_m", 0.25194, "0.25194 m", "m"},
               {"modes[0].f_Hz", 123456, "123.46 kHz", "Hz"},
               {"die.area_um2", 123456, "1.2346e+05 um2", "um2"},
               {"contacts[0].force_N", 8e-5, "80 uN", "N"},
               {"contacts[0].force_N", 0, "0 N", "N"}};
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_study_response r;
        fw_text said = fw_text_new(arena);
        assert_int_equal(parse(arena, row[i].path, FW_TAKE_ONE, &r), FW_OK);
        fw_study_response_text(&said, &r, row[i].value);
        assert_int_equal(fw_text_end(&said), FW_OK);
        assert_string_equal(said.data, row[i].said);
        assert_string_equal(fw_study_response_drawn_in(&r), row[i].drawn_in);
    }
    fw_arena_free(arena);
}

static void wrong_paths_say_what_there_is(void **state) {
    const struct {
        const char *value, *says;
    } row[] = {{"governing.used", "utilisation utilisation_band flow"},
               {"hinges[Q].utilisation", "it has A B C"},
               {"hinges[7].utilisation", "no [7]"},
               {"hinges[*].utilisation", "3 numbers, of [A], [B], [C]: name one"},
               {"requirements[p].value", "2 numbers, of [p,s], [p,t]: name one"},
               {"governing", "an object"},
               {"governing.flow", "a text"},
               {"governing[0]", "no list"},
               {"words", "a list"}};
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    json_t *root = json_loads(document, 0, NULL);
    char why[FW_STUDY_WHY];
    double value;
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_study_response r;
        assert_int_equal(parse(arena, row[i].value, FW_TAKE_ONE, &r), FW_OK);
        if (fw_study_response_find(&r, root, &value, NULL, why, sizeof why) ||
            !strstr(why, row[i].says))
            fail_msg("%s: said \"%s\", wanted \"%s\"", row[i].value, why, row[i].says);
    }
    const char *const none[] = {"",   ".a",  "a.",    "a..b",     "[0]",
                                "a[", "a[]", "a[0]b", "masses:x", "a.[0]"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        fw_study_response r;
        if (parse(arena, none[i], FW_TAKE_ONE, &r) != FW_INPUT) fail_msg("'%s' is a path", none[i]);
    }
    json_decref(root);
    fw_arena_free(arena);
}

static void units_are_those_of_keys(void **state) {
    const char *const row[][2] = {{"hinges[A].peak_angle_rad", "rad"},
                                  {"workspace: flows[0].volume_m2_rad", "m2 rad"},
                                  {"modes:modes[0].f_Hz", "Hz"},
                                  {"x.speed_m_per_s", "m/s"},
                                  {"x.torque_Nm", "N m"},
                                  {"x.stiffness_Nm_per_rad", "N m/rad"},
                                  {"modes:eigenvalues_per_s2[0]", "1/s2"},
                                  {"modes:modes[0].eigenvalue_per_s", "1/s"},
                                  {"masks:masks[0].layers[0].min_space_um", "um"},
                                  {"recipes:a[0].bias_um_per_edge", "um"},
                                  {"workspace:flows[0].reachable.volume.m2_rad", "m2 rad"},
                                  {"stiction.adhesion[0].J_per_m2", "J/m2"},
                                  {"recipes:recipes[0].steps[3].time_s.stop", "s"},
                                  {"recipes:recipes[0].steps[3].time_s.relative_uncertainty", ""},
                                  {"recipes:recipes[0].min_s", "s"},
                                  {"requirements[p].value", ""},
                                  {"governing.utilisation", ""},
                                  {"a.as_fabricated.utilisation_band[0]", ""}};
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_study_response r;
        assert_int_equal(parse(arena, row[i][0], FW_TAKE_ONE, &r), FW_OK);
        assert_string_equal(r.unit, row[i][1]);
    }
    fw_arena_free(arena);
}

/* of numbers whose unit stands beside them: of several one, where they have the same */
static void units_stand_beside_numbers(void **state) {
    static const char units[] =
        "{\"requirements\": [{\"probe\": \"p\", \"unit\": \"rad\", \"value\": 1, \"utilisation\": "
        "0.5,"
        "   \"made\": {\"band\": [1, 2]}}, {\"probe\": \"q\", \"unit\": \"Hz\", \"value\": 2},"
        "  {\"probe\": \"r\", \"unit\": \"Hz\", \"value\": 3}, {\"probe\": \"s\", \"value\": 4}]}";
    const struct {
        const char *value, *unit;
        bool beside;
    } row[] = {{"requirements[p].value", "rad", true},
               {"requirements[p].made.band[1]", "rad", true},
               {"requirements[p].utilisation", "rad", false},
               {"requirements[q].value", "Hz", true},
               {"requirements[Hz].value", "Hz", true},
               {"requirements[s].value", NULL, true},
               {"requirements[*].value", NULL, true}};
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    json_t *root = json_loads(units, 0, NULL);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_study_response r;
        char why[FW_STUDY_WHY];
        double value;
        const char *unit;
        assert_int_equal(parse(arena, row[i].value, FW_TAKE_SUM, &r), FW_OK);
        assert_int_equal(r.unit_beside, row[i].beside);
        assert_string_equal(r.unit, "");
        assert_true(fw_study_response_find(&r, root, &value, &unit, why, sizeof why));
        if (row[i].unit)
            assert_string_equal(unit, row[i].unit);
        else
            assert_null(unit);
    }
    json_decref(root);
    fw_arena_free(arena);
}

/* of a polynomial of degree n - 1 they are exact, wherever the nodes are */
static void derivatives_of_polynomials_are_exact(void **state) {
    (void)state;
    double x[7], w[7];
    for (int trial = 0; trial < 50; trial++) {
        int n = 3 + trial % 5;
        double at = 0.1 * trial - 2;
        for (int i = 0; i < n; i++)
            x[i] = at + 0.3 * (i - trial % n) + 0.01 * i * i;
        fw_study_derivative_weights(x, n, at, w);
        for (int power = 0; power < n; power++) {
            double sum = 0, exact = power == 0 ? 0 : power * pow(at, power - 1), size = 1;
            for (int i = 0; i < n; i++)
                sum += w[i] * pow(x[i], power), size = fmax(size, fabs(w[i] * pow(x[i], power)));
            if (fabs(sum - exact) > 1e-12 * size)
                fail_msg("n %d, power %d: %g, not %g", n, power, sum, exact);
        }
    }
}

/* responses over an input from 7 to 9; the slope at x beside each */
static double is_smooth(double x, double *slope) {
    *slope = 0.3 * cos(x) + 0.1;
    return 0.3 * sin(x) + 0.1 * x;
}
/* a period that is just what the far nodes are apart: they see nothing of it */
static double rings(double x, double *slope) {
    const double turn = 2 * 3.14159265358979 / (0.2 / 3), y = is_smooth(x, slope);
    *slope += 0.001 * turn * cos(turn * x + 0.4);
    return y + 0.001 * sin(turn * x + 0.4);
}
static double rings_a_little(double x, double *slope) {
    const double turn = 2 * 3.14159265358979 / (0.2 / 3), y = is_smooth(x, slope);
    *slope += 1e-6 * turn * cos(turn * x + 0.4);
    return y + 1e-6 * sin(turn * x + 0.4);
}
/* at 8, in the middle: the slope is another one from there on */
static double has_a_corner(double x, double *slope) {
    *slope = (double)NAN;
    return 1 + 0.1 * fabs(x - 8);
}
static double stays(double x, double *slope) {
    (void)x;
    *slope = 0;
    return 2;
}
/* finer than any of them are apart */
static double is_rough(double x, double *slope) {
    *slope = (double)NAN;
    return 1 + 1e-3 * sin(1e5 * x) + 0.01 * x;
}

static void errors_of_derivatives_hold(void **state) {
    (void)state;
    static const struct {
        double (*f)(double, double *);
        double most; /* what it may be off by, of the slope; NaN: it is to be not known */
        bool finer;  /* than the far nodes are apart: it is told */
    } row[] = {{is_smooth, 1e-6, false}, {rings, 0.05, true},        {rings_a_little, 1e-3, false},
               {has_a_corner, (double)NAN, 0},   {is_rough, (double)NAN, 0}, {stays, 0, false}};
    const double at[] = {8, 7, 9, 7.0005, 8.93, 7.31};
    const fw_study_input in = {.from = 7, .to = 9};
    for (size_t r = 0; r < sizeof row / sizeof row[0]; r++)
        for (size_t k = 0; k < (row[r].f == has_a_corner ? 1 : sizeof at / sizeof at[0]); k++)
            for (int off = 0; off < 2; off++) { /* each value by as much as is claimed */
                double x[11], value[11], slope;
                fw_study_derivative d;
                for (int j = 0; j < 11; j++) {
                    x[j] = fw_study_derivative_node(&in, at[k], j);
                    assert_true(x[j] >= 7 && x[j] <= 9);
                    for (int i = 0; i < j; i++)
                        assert_true(j < 7 || i < 7 || fabs(x[j] - x[i]) > 1e-5);
                    value[j] = row[r].f(x[j], &slope) * (1 + (j * 7 % 3 - 1) * off * 1e-9);
                }
                row[r].f(at[k], &slope);
                fw_study_derive(x, value, at[k], 1e-9, 2, &d);
                if (isnan(row[r].most)) {
                    if (!isnan(d.value) || !(d.over < d.wide) || isnan(d.slope[0] + d.slope[1]))
                        fail_msg("%zu at %g: %g to within %g", r, at[k], d.value, d.error);
                    continue;
                }
                const double wrong = fabs(d.value - slope);
                if (!(wrong <= d.error * (1 + 1e-9)) || (d.wide > 0) != row[r].finer ||
                    d.error > (k > 0 ? 100 : 1) * row[r].most * fabs(slope) + 2e-6)
                    fail_msg("%zu at %g: %g to within %g, not %g", r, at[k], d.value, d.error,
                             slope);
            }
}

static void the_text_is_the_value(void **state) {
    (void)state;
    fw_study_input in = {.what = "w", .unit_text = "um", .from = 1e-6, .to = 100e-6, .steps = 5};
    char text[FW_STUDY_TEXT];
    double value;
    assert_true(fw_quantity_unit_parse("um", 2, &in.unit, NULL, NULL));
    assert_int_equal(fw_study_input_write(&in, 12.34567e-6, 4, text, &value), FW_OK);
    assert_string_equal(text, "12.35 um");
    assert_true(value == fw_quantity_unit_to_si(&in.unit, 12.35));
    in.logarithmic = true;
    assert_int_equal(fw_study_input_step(&in, 2, text, &value), FW_OK);
    assert_string_equal(text, "10 um");
    assert_int_equal(fw_study_input_at(&in, 1, 5, text, &value), FW_OK);
    assert_string_equal(text, "100 um");
    const char *const words[] = {"csfh", "8 um"};
    in = (fw_study_input){.what = "w", .unit_text = "", .text = words, .ntext = 2};
    assert_int_equal(fw_study_input_steps(&in), 2);
    assert_int_equal(fw_study_input_step(&in, 0, text, &value), FW_OK);
    assert_string_equal(text, "csfh");
    assert_true(isnan(value));
    assert_int_equal(fw_study_input_at(&in, 0.9, 5, text, &value), FW_OK);
    assert_string_equal(text, "8 um");
    assert_true(fabs(value - 8e-6) < 1e-20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_lead_to_numbers),
        cmocka_unit_test(numbers_are_told_in_percent_and_with_prefixes),
        cmocka_unit_test(wrong_paths_say_what_there_is),
        cmocka_unit_test(units_are_those_of_keys),
        cmocka_unit_test(units_stand_beside_numbers),
        cmocka_unit_test(derivatives_of_polynomials_are_exact),
        cmocka_unit_test(errors_of_derivatives_hold),
        cmocka_unit_test(the_text_is_the_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
