/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "faults/sites.h"
#include "base/arena.h"
#include <execinfo.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>

static sites *noted;

sites *sites_new(void) {
    void *s = mmap(NULL, sizeof(sites), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return s == MAP_FAILED ? NULL : s;
}

void sites_free(sites *s) {
    if (s) munmap(s, sizeof *s);
}

void sites_note(sites *s) {
    noted = s;
}

static void note(void) {
    enum { SKIPPED = 2 }; /* this function and the wrapper */
    void *frame[SITES_DEEP + SKIPPED];
    sites *s = noted;
    if (!s || s->count == SITES_MOST) return;
    int n = backtrace(frame, SITES_DEEP + SKIPPED);
    unsigned long hash = 14695981039346656037ul; /* FNV-1a, in words */
    for (int i = SKIPPED; i < n; i++)
        hash = (hash ^ (unsigned long)(uintptr_t)frame[i]) * 1099511628211ul;
    unsigned long at = hash % (2 * SITES_MOST);
    while (s->seen[at] && s->seen[at] != hash)
        at = (at + 1) % (2 * SITES_MOST);
    if (s->seen[at]) return;
    s->seen[at] = hash;
    s->first[s->count++] = fw_arena_count() + 1;
}

/* ---- in the place of the arena's functions: __real_ is the arena's, __wrap_ what others call ---- */

#define WRAPPED(type, name, arguments, values)                                                     \
    type __real_##name arguments;                                                                  \
    type __wrap_##name arguments;                                                                  \
    type __wrap_##name arguments {                                                                 \
        note();                                                                                    \
        return __real_##name values;                                                               \
    }
WRAPPED(fw_arena *, fw_arena_new, (size_t cap), (cap))
WRAPPED(fw_arena *, fw_arena_part, (const fw_arena *whole, size_t cap), (whole, cap))
WRAPPED(void *, fw_arena_alloc, (fw_arena * a, size_t count, size_t size), (a, count, size))
WRAPPED(void *, fw_arena_raw, (fw_arena * a, size_t bytes), (a, bytes))
WRAPPED(void *, fw_arena_grow,
        (fw_arena * a, const void *old, size_t had, size_t count, size_t size),
        (a, old, had, count, size))
WRAPPED(char *, fw_arena_strdup, (fw_arena * a, const char *text), (a, text))
WRAPPED(char *, fw_arena_strndup, (fw_arena * a, const char *text, size_t n), (a, text, n))

char *__wrap_fw_arena_printf(fw_arena *a, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
char *__wrap_fw_arena_printf(fw_arena *a, const char *format, ...) {
    va_list arguments;
    note();
    va_start(arguments, format);
    int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = n < 0 ? NULL : __real_fw_arena_alloc(a, (size_t)n + 1, 1);
    va_start(arguments, format);
    if (text) vsnprintf(text, (size_t)n + 1, format, arguments);
    va_end(arguments);
    return text;
}
