/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For tests that read packs: every case with an arena and messages of its own. */
#ifndef FW_TESTS_PACK_FIXTURE_H
#define FW_TESTS_PACK_FIXTURE_H
#include "packs.h"

static fw_arena *arena;
static fw_diags diags;

static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    diags = fw_diags_new(arena);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

/* what was said with this number and these words, or NULL */
static inline const fw_diag *said_of(int number, const char *words) {
    for (size_t k = 0; k < diags.count; k++)
        if (diags.item[k].number == number && strstr(diags.item[k].message, words))
            return &diags.item[k];
    return NULL;
}

/* a pack with a text replaced, computed for a plain device */
static inline fw_process_flow *computed_pack(const char *name, const char *from, const char *to) {
    diags = fw_diags_new(arena);
    fw_process_flow *f = read_pack(arena, name, from, to, &diags);
    assert_non_null(f);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    return f;
}

#endif
