/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single-character edits of the gallery device and of two others: never a crash, and an edit that
   makes the file invalid is reported within one line of it in at least 95 % of the cases. */
#include "files.h"
#include <stdlib.h>

static uint64_t seed = 2024;
static unsigned draw(unsigned below) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(seed >> 33) % below;
}

typedef struct tally {
    int valid, near, far;
} tally;

static int line_of(const char *text, size_t at) {
    int line = 1;
    for (size_t i = 0; i < at; i++)
        line += text[i] == '\n';
    return line;
}

static void judge(const char *xml, size_t n, int line, tally *t) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    fw_status s = fw_device_read(arena, "g.xml", xml, n, NULL, 0, &diags, &device);
    assert_true(s == FW_OK ? device && diags.errors == 0 : s == FW_INPUT && diags.errors > 0);
    if (s == FW_OK)
        t->valid++;
    else {
        int found = 0;
        for (size_t i = 0; i < diags.count; i++)
            found |= abs(diags.item[i].place.line - line) <= 1;
        if (found)
            t->near++;
        else {
            t->far++;
            if (getenv("FW_SHOW_FAR"))
                printf("line %d, said %d:%d %s\n", line, diags.item[0].place.line,
                       diags.item[0].place.column, diags.item[0].message);
        }
    }
    fw_arena_free(arena);
}

static void edit(const char *name) {
    static const char replacement[] = "aZ09 <>\"'/=&-.!?[]#@";
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *original = load(arena, name, &n), *edited = malloc(n + 2);
    assert_non_null(edited);
    tally t = {0};
    for (size_t at = 0; at < n; at += (size_t)test_cases(1, 7)) {
        int line = line_of(original, at);
        /* delete */
        memcpy(edited, original, at);
        memcpy(edited + at, original + at + 1, n - at - 1);
        judge(edited, n - 1, line, &t);
        /* replace */
        memcpy(edited, original, n);
        edited[at] = replacement[draw(sizeof replacement - 1)];
        judge(edited, n, line, &t);
        /* insert */
        memcpy(edited, original, at);
        edited[at] = replacement[draw(sizeof replacement - 1)];
        memcpy(edited + at + 1, original + at, n - at);
        judge(edited, n + 1, line, &t);
    }
    double share = 100.0 * t.near / (t.near + t.far);
    printf("%s: %d edits stay valid, %d are reported within a line, %d farther (%.2f %% near)\n",
           name, t.valid, t.near, t.far, share);
    assert_true(share >= 95.0);
    free(edited);
    fw_arena_free(arena);
}

static void single_edits(void **state) {
    (void)state;
    edit(GALLERY);
    edit("tests/data/effects/comb.xml");
    edit("tests/data/effects/rubbing.xml");
}

/* every cut of the file is refused or whole, and never read beyond its end */
static void cut_files(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *original = load(arena, GALLERY, &n);
    for (size_t cut = 0; cut < n; cut += 3) {
        char *copy = malloc(cut ? cut : 1);
        assert_non_null(copy);
        memcpy(copy, original, cut);
        fw_arena *inner = fw_arena_new(0);
        fw_diags diags = fw_diags_new(inner);
        const fw_device *device;
        fw_status s = fw_device_read(inner, "g.xml", copy, cut, NULL, 0, &diags, &device);
        assert_true(s == FW_INPUT || cut + 2 >= n);
        fw_arena_free(inner);
        free(copy);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_edits),
        cmocka_unit_test(cut_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
