/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One arena owns everything of a plan; nothing is freed singly. Chunks of 64 KiB, 512 KiB, 4 MiB, then 8 MiB.
   Memory is zeroed. A failed or capped allocation gives NULL, never an abort. */
#ifndef FW_BASE_ARENA_H
#define FW_BASE_ARENA_H
#include "base/status.h"
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* defined where AddressSanitizer watches, by gcc's word for it and by clang's */
#if defined(__SANITIZE_ADDRESS__)
#define FW_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FW_ASAN 1
#endif
#endif

/* A request to stop, which signal handlers and other threads may make and long loops look at. Every
   design has one of its own; its arena carries it (fw_arena_cancelled), so that whatever computes
   for that design sees it and nothing else does. */
typedef struct fw_cancel {
    atomic_int number;             /* 0: go on; else why to stop, by custom the signal's number */
    const struct fw_cancel *above; /* stops this work too: that of the whole program; may be NULL */
} fw_cancel;

void fw_cancel_request(fw_cancel *cancel, int number); /* async-signal-safe */
void fw_cancel_clear(fw_cancel *cancel);               /* not what stands above it */
int fw_cancel_requested(const fw_cancel *cancel);      /* the number, or 0; NULL is never stopped */

/* Who is told what the work is at, done of `of` (0: not known; below 0: of at most -of), each in `unit`.
   Texts live as long as the arena. An answer that is not 0 asks to stop. */
typedef struct fw_progress {
    int (*told)(void *context, const char *what, double done, double of, const char *unit);
    void *context;
    fw_cancel *cancel; /* by which it is stopped then */
} fw_progress;

/* Work of many parts that would each tell of itself: what they tell is told as this, so that who listens is asked as
   often, and hears how far the whole is. Lives as long as the arena of the part does. */
typedef struct fw_progress_whole {
    const char *what;
    double done, of;
    const char *unit;
    fw_progress own;
    const fw_progress *outer;
} fw_progress_whole;

typedef struct fw_arena fw_arena;
typedef struct fw_mark {
    void *chunk;
    size_t used, total;
} fw_mark;

#define FW_ARENA_USUAL ((size_t)512 << 20)
/* cap_bytes 0 means FW_ARENA_USUAL; NULL when memory is short */
fw_arena *fw_arena_new(size_t cap_bytes);
void fw_arena_free(fw_arena *arena); /* NULL allowed */

/* The arena of a design is what all of its work has in hand, so it carries the request to stop that
   work. A new arena has none; an arena for a part of the work has that of the whole, and may take as much as the whole may where
   its cap is 0. */
void fw_arena_stop_with(fw_arena *arena, const fw_cancel *cancel); /* NULL: never stopped */
fw_arena *fw_arena_part(const fw_arena *whole, size_t cap_bytes);
const fw_cancel *fw_arena_request(const fw_arena *arena); /* or NULL */
bool fw_arena_cancelled(const fw_arena *arena);
/* likewise of those who are told: parts of the arena that are made from then on tell them, too */
void fw_arena_tell_with(fw_arena *arena, const fw_progress *progress); /* NULL: nobody */
void fw_arena_tell_of(fw_arena *part, fw_progress_whole *whole);
void fw_arena_tell_alone(fw_arena *part, const fw_progress_whole *whole); /* and no longer */
bool fw_arena_tells(const fw_arena *arena); /* is there anybody to compose a text for? */
void fw_arena_tell(const fw_arena *arena, const char *what, double done, double of,
                   const char *unit);

/* Threads that may help beside the one that has the work in hand, shared by all parts of one design: who begins a part
   in another thread takes one of them, and gives it back at its end. */
typedef struct fw_team {
    atomic_int idle;
} fw_team;
enum { FW_JOBS_MOST = 256 }; /* threads of one work */
int fw_processors(void);     /* of this machine, 1 to FW_JOBS_MOST */
/* likewise of those who help: parts of the arena that are made from then on have them, too */
void fw_arena_help_with(fw_arena *arena,
                        fw_team *team);      /* NULL: nobody, everything is done in turn */
bool fw_arena_helped(const fw_arena *arena); /* is anybody idle at the moment? */
/* Likewise of who wants to know why there was no memory: *capped is true after the cap of the arena refused, false after the
   machine did. Parts with another cap than the whole's do not say it. NULL: nobody asks */
void fw_arena_capped_with(fw_arena *arena, atomic_bool *capped);
/* n parts of work that need nothing of each other: `one` does part i in the arena that it is given, in this thread or in one
   that helps, and what it leaves there is the whole's afterwards. Where nobody helps that arena is the whole itself. Results do
   not depend on how many help. Only this thread tells how far it is. After a part that fails no other is begun; the status
   is that of the first of them in their order, and what they left is there. Cost: a thread for each that helps. Test: tests/unit/base/test_arena.c */
fw_status fw_arena_each(fw_arena *whole, size_t n,
                        fw_status (*one)(void *context, size_t i, fw_arena *arena), void *context);

/* count * size bytes, zeroed, aligned to 64; NULL on overflow, cap or failure. count 0 gives a
   valid pointer. */
void *fw_arena_alloc(fw_arena *arena, size_t count, size_t size);
/* the same, not zeroed: for bytes that are all written before they are read */
void *fw_arena_raw(fw_arena *arena, size_t bytes);
#define fw_arena_array(arena, type, count) ((type *)fw_arena_alloc((arena), (count), sizeof(type)))
#define fw_arena_one(arena, type)          fw_arena_array((arena), type, 1)

/* grow an array from old_count to new_count items, copying (the old block stays in the arena) */
void *fw_arena_grow(fw_arena *arena, const void *old, size_t old_count, size_t new_count,
                    size_t size);
char *fw_arena_strdup(fw_arena *arena, const char *text); /* NULL text gives NULL */
char *fw_arena_strndup(fw_arena *arena, const char *text, size_t n);
char *fw_arena_printf(fw_arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* scratch: everything allocated after the mark is returned at the rewind */
fw_mark fw_arena_mark(const fw_arena *arena);
void fw_arena_rewind(fw_arena *arena, fw_mark mark);
void fw_arena_keep(fw_arena *arena); /* what is rewound from now on is kept for what comes next */
size_t fw_arena_peak(const fw_arena *arena);

/* ---- all that an arena holds, byte by byte ---- */

/* So that it can be as it was at the same addresses: for work that begins over and over from the same state, whatever it
   changes of it. Pointers into the arena stay good; what is not in it (files, memory of libraries) is the caller's affair. */
typedef struct fw_arena_copy {
    fw_mark mark;
    unsigned char *bytes; /* of malloc; NULL: none */
} fw_arena_copy;

/* false: no memory. What is rewound from then on stays with the arena for the next time */
bool fw_arena_copy_take(fw_arena *arena, fw_arena_copy *copy);
/* The arena must not have been rewound behind the copy meanwhile. Cost: that of copying the bytes */
void fw_arena_copy_put_back(fw_arena *arena, const fw_arena_copy *copy);
void fw_arena_copy_free(fw_arena_copy *copy);

/* fault injection for tests: the n-th allocation from now on (1 = next) fails, and every later one
   too when `ever_after`; n = 0 turns it off. Counts over all arenas of the process. */
void fw_arena_fail_at(long n, int ever_after);
long fw_arena_count(void); /* allocations so far, over all arenas */

#endif
