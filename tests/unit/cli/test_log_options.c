/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of log: what they take, what they refuse, and in which order words reach the entry. */
#include "cli/cli.h"
#include "test.h"
#include <string.h>

static bool parse(char **words, int n, fw_cli_options *o) {
    char *argv[24] = {"flexwright", "log", "device.xml"};
    for (int i = 0; i < n; i++)
        argv[3 + i] = words[i];
    *o = (fw_cli_options){.design = fw_design_options_default(), .colour = -1};
    return fw_cli_parse(fw_cli_find_command("log"), 3 + n, argv, o);
}

static void taken(void **state) {
    (void)state;
    fw_cli_options o;
    char *words[] = {
        "--run",    "l.log",          "--entry",   "S01",       "--lot",        "L7",
        "--wafers", "A1,A2",          "--wafer",   "A1",        "--instrument", "gauge 1",
        "--site",   "thickness=1 um", "--setting", "power=2 W", "--coupon",     "spin, value=1 um"};
    assert_true(parse(words, 18, &o));
    assert_string_equal(o.run, "l.log");
    assert_string_equal(o.entry, "S01");
    assert_string_equal(o.lot, "L7");
    assert_string_equal(o.wafer_ids, "A1,A2");
    assert_string_equal(o.wafer, "A1");
    assert_string_equal(o.instrument, "gauge 1");
    assert_int_equal(o.nlogged, 3);
    static const char *const whole[] = {"",          "thickness=1 um", "set ",
                                        "power=2 W", "coupon=",        "spin, value=1 um"};
    for (int i = 0; i < 3; i++) {
        assert_string_equal(o.logged[i].before, whole[2 * i]);
        assert_string_equal(o.logged[i].words, whole[2 * i + 1]);
    }
    fw_cli_options_free(&o);
    char *report[] = {"--report", "r.html"};
    assert_true(parse(report, 2, &o));
    assert_string_equal(o.report, "r.html");
    fw_cli_options_free(&o);
}

static void refused(void **state) {
    (void)state;
    static char *bad[][2] = {{"--run", ""},
                             {"--entry", ""},
                             {"--lot", "a\tb"},
                             {"--wafers", "0"},
                             {"--wafers", "a b"},
                             {"--wafer", ""},
                             {"--instrument", ""},
                             {"--report", ""},
                             {"--site", "thickness"},
                             {"--site", "thickness=1;by=X"},
                             {"--setting", "power"},
                             {"--coupon", ""},
                             {"--coupon", "spin; by=X"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_cli_options o;
        if (parse(bad[i], 2, &o)) fail_msg("%s '%s'", bad[i][0], bad[i][1]);
        fw_cli_options_free(&o);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(taken), cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
