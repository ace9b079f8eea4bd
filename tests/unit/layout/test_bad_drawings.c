/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every file of tests/bad/layout: a description that can be read, and cannot be drawn as it states.
   Exactly the diagnostics of its .expect, at their places. */
#include "layout/layout.h"
#include "test.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *load(fw_arena *arena, const char *name, const char *ending, size_t *n) {
    char path[400];
    snprintf(path, sizeof path, FW_TEST_SOURCE_DIR "/tests/bad/layout/%s%s", name, ending);
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("cannot open %s", path);
    enum { MOST = 1 << 16 };
    char *text = fw_arena_array(arena, char, MOST + 1);
    assert_non_null(text);
    *n = fread(text, 1, MOST, file);
    text[*n] = '\0';
    fclose(file);
    return text;
}

static void check_file(const char *name) {
    fw_arena *arena = fw_arena_new(0);
    size_t n, size, k = 0;
    const char *xml = load(arena, name, ".xml", &size);
    char *line = load(arena, name, ".expect", &n), *rest = NULL;
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device = NULL;
    const fw_layout *layout;
    if (fw_device_read(arena, name, xml, size, NULL, 0, &diags, &device) != FW_OK)
        fail_msg("%s: %s", name, diags.item[0].message);
    fw_status status = fw_layout_build(arena, device, &diags, &layout);
    assert_int_equal(status, diags.errors ? FW_GEOMETRY : FW_OK);
    for (line = strtok_r(line, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest), k++) {
        char said[64] = "nothing";
        if (k < diags.count)
            snprintf(said, sizeof said, "%d:%d FW-D%03d", diags.item[k].place.line,
                     diags.item[k].place.column, diags.item[k].number);
        if (strcmp(said, line) != 0) fail_msg("%s: %s is expected, not %s", name, line, said);
    }
    if (k != diags.count) fail_msg("%s: not expected: %s", name, diags.item[k].message);
    fw_arena_free(arena);
}

static int is_xml(const struct dirent *d) {
    size_t n = strlen(d->d_name);
    return n > 4 && strcmp(d->d_name + n - 4, ".xml") == 0;
}

static void every_bad_drawing(void **state) {
    (void)state;
    struct dirent **list;
    int n = scandir(FW_TEST_SOURCE_DIR "/tests/bad/layout", &list, is_xml, alphasort);
    assert_true(n >= 5);
    for (int i = 0; i < n; i++) {
        list[i]->d_name[strlen(list[i]->d_name) - 4] = '\0';
        check_file(list[i]->d_name);
        free(list[i]);
    }
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_bad_drawing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
