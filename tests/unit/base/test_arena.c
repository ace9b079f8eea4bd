/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"
#include "test.h"

#ifdef FW_ASAN
#include <sanitizer/asan_interface.h>
#endif

static void zeroed_and_aligned(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (size_t n = 0; n < 5000; n = 3 * n + 1) {
        unsigned char *p = fw_arena_alloc(arena, n, 3);
        assert_non_null(p);
        assert_int_equal((uintptr_t)p % 64, 0);
        for (size_t i = 0; i < 3 * n; i++)
            assert_int_equal(p[i], 0);
        memset(p, 0xff, 3 * n);
    }
    fw_arena_free(arena);
}

static void overflow_and_cap_are_null(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(1 << 20);
    assert_null(fw_arena_alloc(arena, SIZE_MAX, 2));
    assert_null(fw_arena_alloc(arena, SIZE_MAX / 2, 2));
    assert_null(fw_arena_alloc(arena, (1 << 20) + 1, 1));
    assert_non_null(fw_arena_alloc(arena, 1 << 19, 1));
    assert_null(fw_arena_alloc(arena, 1 << 20, 1));
    assert_true(fw_arena_peak(arena) <= 1 << 20);
    fw_arena_free(arena);
    fw_arena_free(NULL);
}

static void rewinding_gives_back(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(1 << 22);
    char *kept = fw_arena_printf(arena, "%s %d", "kept", 1);
    for (int round = 0; round < 100; round++) { /* would pass the cap without the rewind */
        fw_mark mark = fw_arena_mark(arena);
        for (int i = 0; i < 10; i++) {
            char *p = fw_arena_alloc(arena, 1 << 18, 1);
            assert_non_null(p);
            assert_int_equal(p[0], 0);
            p[0] = 1;
        }
        fw_arena_rewind(arena, mark);
    }
    assert_string_equal(kept, "kept 1");
    fw_arena_free(arena);
}

/* over and over from the same state, at the same addresses, and without more memory from round to round */
/* AddressSanitizer is told what is nobody's: behind a block, and after a rewind; what a copy put back is ours again */
static void a_sanitizer_sees_inside(void **state) {
    (void)state;
#ifdef FW_ASAN
    fw_arena *arena = fw_arena_new(0);
    char *first = fw_arena_alloc(arena, 64, 1);
    fw_mark mark = fw_arena_mark(arena);
    fw_arena_copy copy;
    assert_true(fw_arena_copy_take(arena, &copy));
    for (int round = 0; round < 2; round++) {
        char *block = fw_arena_raw(arena, 13);
        assert_false(__asan_address_is_poisoned(first + 63));
        assert_true(__asan_address_is_poisoned(first + 64));
        assert_false(__asan_address_is_poisoned(block + 12));
        assert_true(__asan_address_is_poisoned(block + 13));
        if (round == 0)
            fw_arena_rewind(arena, mark);
        else
            fw_arena_copy_put_back(arena, &copy);
        assert_true(__asan_address_is_poisoned(block));
        assert_false(__asan_address_is_poisoned(first));
    }
    fw_arena_copy_free(&copy);
    fw_arena_free(arena);
#endif
}

static void a_copy_is_put_back(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_arena_copy copy;
    char *before[200], *first = NULL;
    for (int i = 0; i < 200; i++) /* several chunks */
        before[i] = fw_arena_printf(arena, "%01000d", i);
    assert_true(fw_arena_copy_take(arena, &copy));
    for (int round = 0; round < 50; round++) {
        for (int i = 0; i < 200; i += 7)
            before[i][i] = 'x';
        char *large = fw_arena_alloc(arena, 3 << 20, 1);
        assert_non_null(large);
        assert_int_equal(large[round], 0); /* zeroed, though it was in use before */
        large[round + 1] = 1;
        if (round == 0) first = large;
        assert_ptr_equal(large, first);
        fw_arena_copy_put_back(arena, &copy);
        for (int i = 0; i < 200; i++)
            assert_int_equal(strtol(before[i], NULL, 10), i);
    }
    fw_arena_copy_free(&copy);
    fw_arena_free(arena);
}

static void faults_are_injected(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_arena_fail_at(2, 0);
    assert_non_null(fw_arena_alloc(arena, 1, 1));
    assert_null(fw_arena_alloc(arena, 1, 1));
    assert_non_null(fw_arena_alloc(arena, 1, 1));
    assert_int_equal(fw_arena_count(), 3);
    fw_arena_fail_at(1, 1);
    assert_null(fw_arena_alloc(arena, 1, 1));
    assert_null(fw_arena_new(0));
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

enum { PARTS = 37 };

typedef struct parts {
    char *text[PARTS];
    char *large[PARTS];
    size_t fails; /* this part, and those behind it; PARTS: none */
} parts;

static fw_status one_part(void *context, size_t i, fw_arena *arena) {
    parts *p = context;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(fw_arena_alloc(arena, 1 << 17, 1));
    fw_arena_rewind(arena, mark);
    p->text[i] = fw_arena_printf(arena, "part %zu", i);
    p->large[i] = fw_arena_alloc(arena, 1000 * (i + 1), 1);
    FW_NEED(p->text[i] && p->large[i] ? arena : NULL);
    memset(p->large[i], 'a' + (int)(i % 26), 1000 * (i + 1));
    return i < p->fails ? FW_OK : i == p->fails ? FW_SOLVER : FW_INPUT;
}

static void parts_are_there(const parts *p) {
    for (size_t i = 0; i < PARTS; i++) {
        char want[16];
        snprintf(want, sizeof want, "part %zu", i);
        assert_string_equal(p->text[i], want);
        for (size_t k = 0; k < 1000 * (i + 1); k++)
            assert_int_equal(p->large[i][k], 'a' + (int)(i % 26));
    }
}

/* what the parts leave is the whole's: it stays, counts, and goes back with a mark from before; as often as one likes */
static void parts_are_the_wholes(void **state) {
    (void)state;
    for (int turn = 0; turn < 8; turn++) {
        const int idle = turn / 2;
        const bool keeps = turn % 2;
        fw_team team = {idle};
        fw_arena *arena = fw_arena_new(4 << 20);
        char *before = fw_arena_strdup(arena, "before");
        fw_arena_copy copy = {.bytes = NULL};
        fw_arena_help_with(arena, &team);
        if (keeps) assert_true(fw_arena_copy_take(arena, &copy));
        const fw_mark mark = fw_arena_mark(arena);
        for (int round = 0; round < 8; round++) { /* would pass the cap if anything were left of it */
            parts p = {.fails = PARTS};
            assert_int_equal(fw_arena_each(arena, PARTS, one_part, &p), FW_OK);
            assert_int_equal(team.idle, idle);
            char *after = fw_arena_strdup(arena, "after");
            parts_are_there(&p);
            assert_string_equal(before, "before");
            assert_string_equal(after, "after");
            assert_true(fw_arena_peak(arena) > 1000 * PARTS * (PARTS + 1) / 2);
            if (keeps)
                fw_arena_copy_put_back(arena, &copy);
            else
                fw_arena_rewind(arena, mark);
        }
        fw_arena_copy_free(&copy);
        fw_arena_free(arena);
    }
}

/* the first of those that fail counts, and what the whole may not hold is refused */
static void a_part_fails(void **state) {
    (void)state;
    for (int idle = 0; idle < 4; idle++) {
        fw_team team = {idle};
        fw_arena *arena = fw_arena_new(0);
        fw_arena_help_with(arena, &team);
        parts p = {.fails = 11};
        assert_int_equal(fw_arena_each(arena, PARTS, one_part, &p), FW_SOLVER);
        assert_int_equal(team.idle, idle);
        for (size_t i = 0; i < 12; i++) { /* and what it left itself: its messages */
            char want[16];
            snprintf(want, sizeof want, "part %zu", i);
            assert_string_equal(p.text[i], want);
        }
        fw_arena_free(arena);
        arena = fw_arena_new(1 << 19); /* of some 700 kB */
        fw_arena_help_with(arena, &team);
        p = (parts){.fails = PARTS};
        assert_int_equal(fw_arena_each(arena, PARTS, one_part, &p), FW_NOMEM);
        assert_int_equal(team.idle, idle);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_the_wholes), cmocka_unit_test(a_part_fails),
        cmocka_unit_test(zeroed_and_aligned),   cmocka_unit_test(overflow_and_cap_are_null),
        cmocka_unit_test(rewinding_gives_back), cmocka_unit_test(a_copy_is_put_back),
        cmocka_unit_test(faults_are_injected), cmocka_unit_test(a_sanitizer_sees_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
