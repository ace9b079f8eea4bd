/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The arena of a group of tests, and what most of them count. */
#ifndef FW_TEST_CHANCE_TEST_H
#define FW_TEST_CHANCE_TEST_H
#include "base/arena.h"
#include "test.h"

static fw_arena *arena;

static inline int open_arena(void **state) {
    (void)state;
    return !(arena = fw_arena_new(0));
}
static inline int close_arena(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

/* chi-square of counts that should be equal: within five standard deviations of its mean */
static inline void assert_even(const int *count, int cells, double total) {
    double sum = 0, want = total / cells;
    for (int c = 0; c < cells; c++)
        sum += (count[c] - want) * (count[c] - want) / want;
    assert_near(sum, cells - 1, 5 * sqrt(2.0 * (cells - 1)));
}
#endif
