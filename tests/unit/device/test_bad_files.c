/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every file of tests/bad: exactly the diagnostics of its .expect, at their places. Files named
   pack-* are material packs. Lines "--set PATH=VALUE" of .expect are given along. */
#include "files.h"
#include <dirent.h>
#include <stdlib.h>

enum { MOST = 32 };

typedef struct want {
    int line, column, number, seen;
} want;

typedef struct expectation {
    want item[MOST];
    int n;
    fw_device_set set[4];
    int nset;
} expectation;

static int used[100];

static void read_expectation(fw_arena *arena, const char *name, expectation *e) {
    char path[300];
    size_t n;
    snprintf(path, sizeof path, "tests/bad/%s.expect", name);
    char *text = load(arena, path, &n), *rest;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        want w = {0};
        if (strncmp(line, "--set ", 6) == 0) {
            char *path_end = strstr(line + 6, "/@"), *equals;
            equals = strchr(path_end ? path_end : line + 6, '=');
            assert_non_null(equals);
            *equals = '\0';
            e->set[e->nset++] = (fw_device_set){line + 6, equals + 1};
        } else if (sscanf(line, "%d:%d FW-D%d", &w.line, &w.column, &w.number) == 3) {
            assert_true(e->n < MOST);
            e->item[e->n++] = w;
        } else
            fail_msg("%s: '%s'", path, line);
    }
    assert_true(e->n > 0);
}

static void check_message(const char *name, const fw_diag *d) {
    if (!fw_diag_find(d->number))
        fail_msg("%s: FW-D%03d has no row in diagnostics.def", name, d->number);
    if (strlen(d->message) < 12) fail_msg("%s: message '%s'", name, d->message);
    used[d->number % 100]++;
}

static void compare(const char *name, const fw_diags *diags, expectation *e) {
    for (size_t i = 0; i < diags->count; i++) {
        const fw_diag *d = &diags->item[i];
        int k = 0;
        check_message(name, d);
        while (k < e->n && (e->item[k].seen || e->item[k].line != d->place.line ||
                            e->item[k].column != d->place.column || e->item[k].number != d->number))
            k++;
        if (k == e->n)
            fail_msg("%s: not expected: %d:%d FW-D%03d %s", name, d->place.line, d->place.column,
                     d->number, d->message);
        e->item[k].seen = 1;
    }
    for (int k = 0; k < e->n; k++)
        if (!e->item[k].seen)
            fail_msg("%s: not reported: %d:%d FW-D%03d", name, e->item[k].line, e->item[k].column,
                     e->item[k].number);
}

static void check_file(const char *name) {
    fw_arena *arena = fw_arena_new(0);
    char path[300];
    size_t n;
    expectation e = {0};
    read_expectation(arena, name, &e);
    snprintf(path, sizeof path, "tests/bad/%s.xml", name);
    char *xml = load(arena, path, &n);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    fw_device_materials materials;
    fw_status s = strncmp(name, "pack-", 5) == 0
                      ? fw_device_materials_read(arena, name, xml, n, &diags, &materials)
                      : fw_device_read(arena, name, xml, n, e.set, e.nset, &diags, &device);
    if (s != FW_INPUT) fail_msg("%s: status %s", name, fw_status_text(s));
    compare(name, &diags, &e);
    fw_arena_free(arena);
}

static int is_xml(const struct dirent *d) {
    size_t n = strlen(d->d_name);
    return n > 4 && strcmp(d->d_name + n - 4, ".xml") == 0;
}

static void every_bad_file(void **state) {
    (void)state;
    struct dirent **list;
    int n = scandir(FW_TEST_SOURCE_DIR "/tests/bad", &list, is_xml, alphasort);
    assert_true(n >= 100);
    for (int i = 0; i < n; i++) {
        list[i]->d_name[strlen(list[i]->d_name) - 4] = '\0';
        check_file(list[i]->d_name);
        free(list[i]);
    }
    free(list);
}

/* each diagnostic of files, expressions and descriptions has a file that triggers it */
static void every_diagnostic_has_a_file(void **state) {
    (void)state;
    static const int generated[] = {1, 2, 8}; /* test_hostile.c: too large for a file, or binary */
    size_t count;
    const fw_diag_entry *table = fw_diag_table(&count);
    for (size_t i = 0; i < count && table[i].number < 100; i++) {
        int skip = table[i].number >= 80 && table[i].number < 93; /* of later rooms */
        for (size_t k = 0; k < sizeof generated / sizeof generated[0]; k++)
            skip |= generated[k] == table[i].number;
        if (!skip && !used[table[i].number])
            fail_msg("no file in tests/bad triggers FW-D%03d", table[i].number);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bad_file),
        cmocka_unit_test(every_diagnostic_has_a_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
