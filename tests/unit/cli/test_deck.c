/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decks for a person's own solver: which files, and what is said where one cannot be written. */
#include "cli/cli.h"
#include "test.h"
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static fw_plan *plan_of(const char *device) {
    char path[600];
    fw_plan_options options = fw_plan_options_default();
    fw_plan *plan = fw_plan_new(&options);
    assert_non_null(plan);
    snprintf(path, sizeof path, "%s/docs/gallery/%s/device.xml", FW_TEST_SOURCE_DIR, device);
    assert_int_equal(fw_plan_load(plan, path), FW_OK);
    return plan;
}

static long size_of(const char *room, const char *name) {
    char path[600];
    struct stat info;
    snprintf(path, sizeof path, "%s/out/%s", room, name);
    return stat(path, &info) == 0 ? (long)info.st_size : -1;
}

static void clean(const char *room) {
    char command[600];
    snprintf(command, sizeof command, "rm -r %s", room);
    assert_int_equal(system(command), 0);
}

static void six_bar(void **state) {
    (void)state;
    char room[] = "fw-deck-XXXXXX", out[600];
    assert_non_null(mkdtemp(room));
    snprintf(out, sizeof out, "%s/out", room);
    fw_plan *plan = plan_of("reference-six-bar");
    int files, errors = 0;
    assert_int_equal(fw_cli_decks(plan, out, 0, &files), FW_OK);
    assert_int_equal(files, 2 * 6 * 2 + 2); /* two flows: six hinges twice, a scene each */
    assert_true(size_of(room, "hinge-A-al-masked-rie.inp") > 100000);
    assert_true(size_of(room, "hinge-F-copper-on-porous-silicon-large.inp") > 100000);
    assert_true(size_of(room, "mechanism-step-load-al-masked-rie.inp") > 100000);
    assert_true(size_of(room, "mechanism-gentle-step-copper-on-porous-silicon.inp") > 100000);
    for (size_t i = 0; i < plan->diags.count; i++)
        errors += plan->diags.item[i].severity == FW_ERROR;
    assert_int_equal(errors, 0);
    fw_plan_free(plan);
    clean(room);
}

static void springs_and_weight(void **state) {
    (void)state;
    char room[] = "fw-deck-XXXXXX", out[600];
    assert_non_null(mkdtemp(room));
    snprintf(out, sizeof out, "%s/out", room);
    fw_plan *plan = plan_of("leaf-four-bar");
    int files, warnings = 0;
    assert_int_equal(fw_cli_decks(plan, out, 0.5, &files), FW_OK);
    assert_int_equal(files, 8);
    for (size_t i = 0; i < plan->diags.count; i++)
        warnings += plan->diags.item[i].number == 213 && plan->diags.item[i].severity == FW_WARNING;
    assert_int_equal(warnings, 1);
    fw_plan_free(plan);
    clean(room);
}

static void no_directory(void **state) {
    (void)state;
    fw_plan *plan = plan_of("leaf-four-bar");
    int files;
    assert_int_equal(fw_cli_decks(plan, "/dev/null/below", 0.5, &files), FW_IO);
    assert_int_equal(files, 0);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(six_bar),
                                       cmocka_unit_test(springs_and_weight),
                                       cmocka_unit_test(no_directory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
