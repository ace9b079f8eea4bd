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

#endif
