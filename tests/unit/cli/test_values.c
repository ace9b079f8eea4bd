/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of options: of every option that takes one, what it takes up to the ends of its range, and what it refuses just beyond
   them. What is read of a value is looked at where it is a number. */
#include "cli/cli.h"
#include "test.h"

static const struct {
    const char *option, *takes[5], *refuses[7]; /* NULL behind the last */
} row[] = {
    {"set", {"arc=250 deg", "flexure[A]/@length=312 um"}, {"arc", "=3"}},
    {"accuracy", {"1e-3", "0.01"}, {"", "x", "0", "-1e-3", "1e-3x"}},
    {"memory", {"64", "512"}, {"", "x", "0", "-1"}},
    {"time-limit", {"0.5", "3600"}, {"", "x", "0", "-1"}},
    {"corners", {"auto", "none"}, {"", "some"}},
    {"advice", {"auto", "none"}, {"", "some"}},
    {"measurements", {"auto", "all", "none"}, {"", "some"}},
    {"hinge-model", {"auto", "revolute", "elastica"}, {"", "beam"}},
    {"mask-tolerance", {"0.36", "5", "1000"}, {"", "x", "0.359", "1000.1", "-5", "5nm"}},
    {"mask-flatten", {"inside", "equal-area"}, {"", "outside", "inside,equal-area"}},
    {"mask-format", {"gds", "gds,svg,outlines,oasis,dxf,stl,step", "all"}, {"pdf", "gds,pdf"}},
    {"mask-vertices", {"199", "4094", "8190"}, {"", "200", "8191", "199x"}},
    {"layers", {"map.txt"}, {""}},
    {"wafers", {"1", "50"}, {"", "x", "0", "51", "1.5"}},
    {"operators", {"1", "50"}, {"", "x", "0", "51", "1.5"}},
    {"stabilise", {"projection", "baumgarte", "none"}, {"", "all"}},
    {"rtol", {"1e-9"}, {"", "x", "0", "-1e-9"}},
    {"samples", {"2", "1001"}, {"", "x", "0", "-3", "2.5"}},
    {"at", {"rest", "equilibrium"}, {"", "start"}},
    {"gds", {"a.gds", "-"}, {""}},
    {"run", {"lot.log"}, {""}},
    {"entry", {"C22; by=AB"}, {""}},
    {"entries", {"lot.txt"}, {""}},
    {"lot", {"L", "a lot of 1"}, {"", "two\nlines", "\033[2J"}},
    {"zone", {"UTC", "UTC+01:00", "CET-1CEST,M3.5.0,M10.5.0/3"}, {"", "CET", "UTC+15:00"}},
    {"wafer", {"3", "1-4"}, {""}},
    {"without", {"3", "A1,B7"}, {""}},
    {"site", {"thickness=9.1 um"}, {"thickness", "a=1;b=2", ""}},
    {"setting", {"power=251 W"}, {"power", "a=1;b=2", ""}},
    {"coupon", {"arde-slots, drawn=10 um"}, {"", "a;b"}},
    {"instrument", {"profiler"}, {""}},
    {"report", {"a.html", "-"}, {""}},
    {"level", {"closed-form", "ends", "compliance", "elastica", "all"}, {"", "exact"}},
    {"budget", {"1", "20", "3600"}, {"", "x", "0.9", "3601", "-20"}},
    {"study", {"widest"}, {""}},
    {"jobs", {"1", "256"}, {"", "x", "0", "257", "1.5", "-1"}},
    {"shard", {"1/1", "2/5", "100000/100000"}, {"", "3", "0/5", "6/5", "1/100001", "1.5/5", "x/5"}},
    {"shards", {"1", "1000"}, {"", "x", "0", "1001", "1.5"}},
    {"sbatch", {"--time=60"}, {"", "time=60"}},
    {"port", {"1024", "65535"}, {"x", "-1", "65536", "80.5"}},
    {"color", {"auto", "always", "never"}, {"", "sometimes"}},
};

static const fw_cli_option_row *option(const char *name) {
    size_t n;
    const fw_cli_option_row *all = fw_cli_option_rows(&n);
    for (size_t i = 0; i < n; i++)
        if (strcmp(all[i].name, name) == 0) return &all[i];
    fail_msg("there is no --%s", name);
    return NULL;
}

static void values(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        const fw_cli_option_row *o = option(row[i].option);
        assert_non_null(o->argument);
        for (size_t k = 0; k < 5 && row[i].takes[k]; k++) {
            fw_cli_options to = {0};
            const char *wrong = o->take(&to, row[i].takes[k]);
            if (wrong) fail_msg("--%s '%s': %s", o->name, row[i].takes[k], wrong);
            fw_cli_options_free(&to);
        }
        for (size_t k = 0; k < 7 && row[i].refuses[k]; k++) {
            fw_cli_options to = {0};
            const char *wrong = o->take(&to, row[i].refuses[k]);
            if (!wrong) fail_msg("--%s '%s' is taken", o->name, row[i].refuses[k]);
            assert_true(strlen(wrong) > 8);
            fw_cli_options_free(&to);
        }
    }
}

/* options without a row here take any text, or what other tests look at */
static void each_is_here(void **state) {
    (void)state;
    static const char *const other[] = {
        "effects", "flow", "day", "planned", "cut", "lab", "scene", "method", "integrator", "forces", "csv",
        "animate", "independent", "rates", "accelerations", "svg", "deck", "settings", "output"};
    size_t n;
    const fw_cli_option_row *all = fw_cli_option_rows(&n);
    for (size_t i = 0; i < n; i++) {
        bool here = !all[i].argument;
        for (size_t k = 0; k < sizeof row / sizeof *row; k++)
            here = here || strcmp(row[k].option, all[i].name) == 0;
        for (size_t k = 0; k < sizeof other / sizeof *other; k++)
            here = here || strcmp(other[k], all[i].name) == 0;
        if (!here) fail_msg("--%s has no row", all[i].name);
    }
}

static void numbers(void **state) {
    (void)state;
    fw_cli_options to = {0};
    assert_null(fw_cli_take_shard(&to, "2/5"));
    assert_true(to.shard == 2 && to.shards == 5);
    assert_null(fw_cli_take_shard(&to, "12/345"));
    assert_true(to.shard == 12 && to.shards == 345);
    assert_null(fw_cli_take_jobs(&to, "7"));
    assert_int_equal(to.jobs, 7);
    assert_null(fw_cli_take_tasks(&to, "40"));
    assert_int_equal(to.tasks, 40);
    assert_null(fw_cli_take_tolerance(&to, "7"));
    assert_float_equal(to.design.mask_tolerance_m, 7e-9, 1e-20);
    assert_null(fw_cli_take_mask_vertices(&to, "8190"));
    assert_int_equal(to.design.mask_vertices, 8190);
    for (int i = 0; i < FW_MOST_SETS; i++)
        assert_null(fw_cli_take_setting(&to, "power=251 W"));
    assert_int_equal(to.nlogged, FW_MOST_SETS);
    assert_non_null(fw_cli_take_setting(&to, "power=251 W"));
}

/* what was probably meant, of the names that a refusal lists */
static void meant(void **state) {
    (void)state;
    static const char needs[] = "needs auto, gds (always written, or not) or equal-area; an-other is none";
    assert_string_equal(fw_cli_meant("equal-aera", needs), "; did you mean equal-area?");
    assert_string_equal(fw_cli_meant("gsd", needs), "; did you mean gds?");
    assert_string_equal(fw_cli_meant("auto,equalarea", needs), "; did you mean equal-area?");
    assert_string_equal(fw_cli_meant("an-othr", needs), "");
    assert_string_equal(fw_cli_meant("alwais", needs), "");
    assert_string_equal(fw_cli_meant("xyzxyz", needs), "");
    assert_string_equal(fw_cli_meant("aut", "is no such thing"), "");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(values), cmocka_unit_test(each_is_here), cmocka_unit_test(numbers),
                                       cmocka_unit_test(meant)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
