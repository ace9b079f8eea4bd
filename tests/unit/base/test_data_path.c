/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Packs are found where the caller says, else beside the program, else in the source; a directory of results is
   looked at before the work. */
#include "base/output.h"
#include "test.h"
#include <sys/stat.h>
#include <unistd.h>

static void packs(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *path;
    assert_int_equal(fw_data_path(arena, NULL, "processes/base.xml", &path), FW_OK);
    assert_int_equal(access(path, R_OK), 0);
    assert_int_equal(fw_data_path(arena, "", "processes/base.xml", &path),
                     FW_OK); /* as without one */
    assert_non_null(path);
    assert_int_equal(fw_data_path(arena, "/nowhere", "processes/base.xml", &path), FW_OK);
    assert_null(path); /* that one and no other */
    assert_int_equal(fw_data_path(arena, NULL, "processes/none.xml", &path), FW_OK);
    assert_null(path);
    const char *const *name;
    size_t n;
    assert_int_equal(fw_data_names(arena, FW_TEST_SOURCE_DIR, "processes", &name, &n), FW_OK);
    assert_true(n >= 3);
    for (size_t i = 0; i < n; i++) {
        assert_null(strstr(name[i], ".xml"));
        if (i > 0) assert_true(strcmp(name[i - 1], name[i]) < 0);
        assert_int_equal(fw_data_path(arena, FW_TEST_SOURCE_DIR,
                                      fw_arena_printf(arena, "processes/%s.xml", name[i]), &path),
                         FW_OK);
        assert_non_null(path);
    }
    assert_int_equal(fw_data_names(arena, "/nowhere", "processes", &name, &n), FW_OK);
    assert_int_equal(n, 0);
    fw_arena_free(arena);
}

static fw_status looked_at(fw_arena *arena, const char *path) {
    fw_diags diags = fw_diags_new(arena);
    fw_status status = fw_output_check(arena, path, &diags);
    assert_int_equal(status == FW_OK, diags.count == 0);
    return status;
}

static void targets(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    char directory[] = "fw-target-XXXXXX";
    assert_non_null(mkdtemp(directory));
    const char *file = fw_arena_printf(arena, "%s/file", directory);
    assert_int_equal(looked_at(arena, directory), FW_OK); /* empty */
    assert_int_equal(looked_at(arena, fw_arena_printf(arena, "%s/new/deep/", directory)), FW_OK);
    FILE *f = fopen(file, "w");
    assert_non_null(f);
    fclose(f);
    assert_int_equal(looked_at(arena, directory), FW_IO);
    assert_int_equal(looked_at(arena, file), FW_IO);
    assert_int_equal(looked_at(arena, fw_arena_printf(arena, "%s/below", file)), FW_IO);
    assert_int_equal(access(fw_arena_printf(arena, "%s/new", directory), F_OK), -1);
    assert_int_equal(unlink(file), 0);
    assert_int_equal(rmdir(directory), 0);
    /* below where the test runs, by a name that nothing else there has: ./demo leaves an "out" */
    assert_int_equal(looked_at(arena, "fw-target-of-nobody"), FW_OK);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(packs), cmocka_unit_test(targets)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
