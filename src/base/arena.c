/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#ifdef FW_ASAN
#include <sanitizer/asan_interface.h>
#endif

/* The first access to a page costs as much as some thousand operations, on virtual machines ten times that, and an arena is
   filled from its start: blocks of malloc grow fast to where huge pages hold them. */
enum { ALIGNMENT = 64, HUGE_PAGE = 2 * 1024 * 1024 };
enum { FIRST_BLOCK = 64 * 1024, GROWTH = 8, LARGEST_BLOCK = 4 * HUGE_PAGE };

typedef struct chunk {
    struct chunk *before;
    size_t size, used;
    unsigned char *data; /* aligned, inside the block of this header */
} chunk;

struct fw_arena {
    chunk *last;
    size_t cap, total, peak; /* bytes handed out, and the most ever */
    size_t held;             /* bytes asked of malloc */
    chunk *spare; /* of one that is put back to a copy: given back, and asked for again soon */
    bool keeps;
    const fw_cancel *cancel;
    const fw_progress *progress; /* NULL: nobody is told */
    fw_team *team;               /* NULL: nobody helps */
    atomic_bool *capped;         /* was it the cap that refused? NULL: nobody asks */
};

/* AddressSanitizer sees only blocks of malloc, of which an arena hands out parts: without its being told, nothing that is read or
   written behind an array of ours, or after a rewind, would be noticed. Nothing otherwise. */
#ifdef FW_ASAN
enum { BETWEEN = ALIGNMENT }; /* bytes behind each block that are nobody's */

static void hide(const void *at, size_t n) {
    ASAN_POISON_MEMORY_REGION(at, n);
}

static void show(const void *at, size_t n) {
    ASAN_UNPOISON_MEMORY_REGION(at, n);
}

/* with what is between the blocks, which the memcpy of AddressSanitizer would complain of; blocks are
   whole numbers of pieces */
__attribute__((no_sanitize("address"))) static void copy_all(void *to, const void *from, size_t n) {
    typedef struct piece {
        unsigned char byte[ALIGNMENT];
    } piece;
    piece *t = to;
    const piece *f = from;
    for (size_t i = 0; i < n / sizeof(piece); i++) {
        t[i] = f[i];
        __asm__ volatile("" ::
                             : "memory"); /* one by one: a compiler makes a memcpy of such a loop */
    }
}
#else
enum { BETWEEN = 0 };

static void hide(const void *at, size_t n) {
    (void)at, (void)n;
}

static void show(const void *at, size_t n) {
    (void)at, (void)n;
}

static void copy_all(void *to, const void *from, size_t n) {
    memcpy(to, from, n);
}
#endif

/* of the process, so that a test can fail the n-th of any arena; atomic since designs run in
   parallel */
static atomic_long fault_at, allocations;
static atomic_int fault_ever_after;

void fw_arena_fail_at(long n, int ever_after) {
    fault_at = n;
    fault_ever_after = ever_after;
    allocations = 0;
}

long fw_arena_count(void) {
    return allocations;
}

static int injected_fault(void) {
    /* not one operation, which would cost more than the rest of most allocations: where designs run
       in parallel some are not counted, and faults are injected where one runs alone */
    long n = atomic_load_explicit(&allocations, memory_order_relaxed) + 1;
    atomic_store_explicit(&allocations, n, memory_order_relaxed);
    long at = atomic_load_explicit(&fault_at, memory_order_relaxed);
    if (at == 0) return 0;
    return n == at || (fault_ever_after && n > at);
}

fw_arena *fw_arena_new(size_t cap_bytes) {
    if (injected_fault()) return NULL;
    fw_arena *arena = calloc(1, sizeof *arena);
    if (arena) arena->cap = cap_bytes ? cap_bytes : FW_ARENA_USUAL;
    return arena;
}

void fw_arena_stop_with(fw_arena *arena, const fw_cancel *cancel) {
    arena->cancel = cancel;
}

const fw_cancel *fw_arena_request(const fw_arena *arena) {
    return arena->cancel;
}

fw_arena *fw_arena_part(const fw_arena *whole, size_t cap_bytes) {
    fw_arena *arena = fw_arena_new(cap_bytes ? cap_bytes : whole->cap);
    if (!arena) return NULL;
    arena->cancel = whole->cancel;
    arena->progress = whole->progress;
    arena->team = whole->team;
    if (arena->cap == whole->cap) arena->capped = whole->capped;
    return arena;
}

void fw_arena_capped_with(fw_arena *arena, atomic_bool *capped) {
    arena->capped = capped;
}

/* nothing is handed out, and who asks is told why */
static void *refuse(const fw_arena *arena, bool by_cap) {
    if (arena->capped) atomic_store(arena->capped, by_cap);
    return NULL;
}

void fw_arena_tell_with(fw_arena *arena, const fw_progress *progress) {
    arena->progress = progress;
}

static int tell_whole(void *context, const char *what, double done, double of, const char *unit) {
    const fw_progress_whole *w = context;
    (void)what, (void)done, (void)of, (void)unit; /* of the part */
    return w->outer->told(w->outer->context, w->what, w->done, w->of, w->unit);
}

void fw_arena_tell_of(fw_arena *part, fw_progress_whole *whole) {
    if (!fw_arena_tells(part)) return;
    whole->outer = part->progress;
    whole->own = (fw_progress){tell_whole, whole, part->progress->cancel};
    part->progress = &whole->own;
}

void fw_arena_tell_alone(fw_arena *part, const fw_progress_whole *whole) {
    if (part->progress == &whole->own) part->progress = whole->outer;
}

bool fw_arena_tells(const fw_arena *arena) {
    return arena->progress && arena->progress->told;
}

void fw_arena_tell(const fw_arena *arena, const char *what, double done, double of,
                   const char *unit) {
    const fw_progress *p = arena->progress;
    if (!p || !p->told) return;
    if (p->told(p->context, what, done, of, unit) != 0) fw_cancel_request(p->cancel, SIGINT);
}

bool fw_arena_cancelled(const fw_arena *arena) {
    return fw_cancel_requested(arena->cancel) != 0;
}

static void free_chunks(chunk *c) {
    while (c) {
        chunk *before = c->before;
        free(c);
        c = before;
    }
}

void fw_arena_free(fw_arena *arena) {
    if (!arena) return;
    free_chunks(arena->last);
    free_chunks(arena->spare);
    free(arena);
}

/* a block of malloc, whole huge pages where it is as large as one; no harm where the system refuses them */
static void *block_of(size_t bytes) {
    if (bytes < HUGE_PAGE) return malloc(bytes);
    void *block = aligned_alloc(HUGE_PAGE, bytes);
#ifdef MADV_HUGEPAGE
    if (block) madvise(block, bytes, MADV_HUGEPAGE);
#endif
    return block;
}

/* its pages are there: fresh ones would cost more than most of what is done with them */
static chunk *take_spare(fw_arena *arena, size_t bytes) {
    for (chunk **at = &arena->spare; *at; at = &(*at)->before)
        if ((*at)->size >= bytes) {
            chunk *c = *at;
            *at = c->before;
            c->before = arena->last;
            c->used = 0;
            arena->last = c;
            hide(c->data, c->size);
            return c;
        }
    return NULL;
}

static chunk *add_chunk(fw_arena *arena, size_t bytes) {
    chunk *kept = take_spare(arena, bytes);
    if (kept) return kept;
    const size_t head = sizeof(chunk) + ALIGNMENT;
    const chunk *last = arena->last;
    size_t whole = last ? GROWTH * (last->size + head) : FIRST_BLOCK;
    if (whole > LARGEST_BLOCK) whole = LARGEST_BLOCK;
    if (bytes > SIZE_MAX - head - HUGE_PAGE) return NULL;
    if (whole < bytes + head) whole = bytes + head;
    if (whole >= HUGE_PAGE) whole = (whole + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
    chunk *c = block_of(whole);
    if (!c) return NULL;
    uintptr_t start = (uintptr_t)(c + 1);
    size_t shift = (ALIGNMENT - start % ALIGNMENT) % ALIGNMENT;
    *c = (chunk){arena->last, whole - head, 0, (unsigned char *)(c + 1) + shift};
    hide(c->data, c->size);
    arena->last = c;
    arena->held += whole;
    return c;
}

void *fw_arena_raw(fw_arena *arena, size_t bytes) {
    if (injected_fault()) return refuse(arena, false);
    if (bytes > SIZE_MAX - ALIGNMENT - BETWEEN) return refuse(arena, true);
    const size_t asked = bytes;
    bytes = (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (bytes == 0) bytes = ALIGNMENT;
    if (bytes > arena->cap || arena->total > arena->cap - bytes) return refuse(arena, true);
    chunk *c = arena->last;
    if (!c || c->size - c->used < bytes + BETWEEN) c = add_chunk(arena, bytes + BETWEEN);
    if (!c) return refuse(arena, false);
    void *block = c->data + c->used;
    show(block, asked);
    c->used += bytes + BETWEEN;
    arena->total += bytes;
    if (arena->total > arena->peak) arena->peak = arena->total;
    return block;
}

void *fw_arena_alloc(fw_arena *arena, size_t count, size_t size) {
    if (size && count > SIZE_MAX / size) return NULL;
    void *block = fw_arena_raw(arena, count * size);
    return block ? memset(block, 0, count * size) : NULL;
}

void *fw_arena_grow(fw_arena *arena, const void *old, size_t old_count, size_t new_count,
                    size_t size) {
    if (size && new_count > SIZE_MAX / size) return NULL;
    size_t bytes = new_count * size, kept = old ? old_count * size : 0;
    unsigned char *block = fw_arena_raw(arena, bytes);
    if (!block) return NULL;
    if (kept > 0) memcpy(block, old, kept);
    memset(block + kept, 0, bytes - kept);
    return block;
}

char *fw_arena_strndup(fw_arena *arena, const char *text, size_t n) {
    char *copy = fw_arena_alloc(arena, n + 1, 1);
    if (copy && n) memcpy(copy, text, n);
    return copy;
}

char *fw_arena_strdup(fw_arena *arena, const char *text) {
    return text ? fw_arena_strndup(arena, text, strlen(text)) : NULL;
}

char *fw_arena_printf(fw_arena *arena, const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = n < 0 ? NULL : fw_arena_alloc(arena, (size_t)n + 1, 1);
    if (text) vsnprintf(text, (size_t)n + 1, format, again);
    va_end(again);
    return text;
}

fw_mark fw_arena_mark(const fw_arena *arena) {
    return (fw_mark){arena->last, arena->last ? arena->last->used : 0, arena->total};
}

void fw_arena_rewind(fw_arena *arena, fw_mark mark) {
    while (arena->last && (void *)arena->last != mark.chunk) {
        chunk *c = arena->last;
        arena->last = c->before;
        if (arena->keeps) {
            c->before = arena->spare;
            arena->spare = c;
            continue;
        }
        arena->held -= c->size + sizeof(chunk) + ALIGNMENT;
        free(c);
    }
    if (arena->last) {
        chunk *c = arena->last;
        hide(c->data + mark.used, c->used - mark.used);
        c->used = mark.used;
    }
    arena->total = mark.total;
}

void fw_arena_keep(fw_arena *arena) {
    arena->keeps = true;
}

size_t fw_arena_peak(const fw_arena *arena) {
    return arena->peak;
}

bool fw_arena_copy_take(fw_arena *arena, fw_arena_copy *copy) {
    size_t n = 1, at = 0;
    for (const chunk *c = arena->last; c; c = c->before)
        n += c->used;
    *copy = (fw_arena_copy){fw_arena_mark(arena), injected_fault() ? NULL : malloc(n)};
    if (!copy->bytes) return false;
    arena->keeps = true;
    for (const chunk *c = arena->last; c; at += c->used, c = c->before)
        copy_all(copy->bytes + at, c->data, c->used);
    return true;
}

void fw_arena_copy_put_back(fw_arena *arena, const fw_arena_copy *copy) {
    size_t at = 0;
    fw_arena_rewind(arena, copy->mark);
    for (chunk *c = arena->last; c; at += c->used, c = c->before)
        copy_all(c->data, copy->bytes + at, c->used);
}

void fw_arena_copy_free(fw_arena_copy *copy) {
    free(copy->bytes);
    copy->bytes = NULL;
}

/* ---- parts in threads ---- */

enum { MOST_HELPERS = FW_JOBS_MOST - 1 };

int fw_processors(void) {
    const long there = sysconf(_SC_NPROCESSORS_ONLN);
    return there < 1 ? 1 : there > FW_JOBS_MOST ? FW_JOBS_MOST : (int)there;
}

void fw_arena_help_with(fw_arena *arena, fw_team *team) {
    arena->team = team;
}

bool fw_arena_helped(const fw_arena *arena) {
    return arena->team && atomic_load(&arena->team->idle) > 0;
}

/* all that a part holds is the whole's, behind what that has: a mark from before goes back behind both; false: that is more
   than the whole may hold, which then gives nothing any more */
static bool take_over(fw_arena *whole, fw_arena *part) {
    chunk *oldest = part->last;
    while (oldest && oldest->before)
        oldest = oldest->before;
    if (oldest) {
        oldest->before = whole->last;
        whole->last = part->last;
    }
    whole->total += part->total;
    whole->held += part->held;
    if (whole->total > whole->peak) whole->peak = whole->total;
    part->last = NULL;
    if (whole->total > whole->cap) refuse(whole, true);
    return whole->total <= whole->cap;
}

typedef struct parts {
    size_t n;
    fw_status (*one)(void *context, size_t i, fw_arena *arena);
    void *context;
    fw_arena **arena;  /* (n) of the parts */
    fw_status *status; /* (n) */
    fw_team *team;
    atomic_size_t next;
    atomic_bool failed;
    locale_t locale; /* of the thread that asks */
} parts;

static void do_parts(parts *p, bool helping) {
    while (!atomic_load(&p->failed)) {
        const size_t i = atomic_fetch_add(&p->next, 1);
        if (i >= p->n) return;
        if (helping) p->arena[i]->progress = NULL; /* one thread tells */
        p->status[i] = p->one(p->context, i, p->arena[i]);
        if (p->status[i] != FW_OK) atomic_store(&p->failed, true);
    }
}

static void *help(void *argument) {
    parts *p = argument;
    const locale_t before = uselocale(p->locale);
    do_parts(p, true);
    uselocale(before);
    atomic_fetch_add(&p->team->idle, 1);
    return NULL;
}

static bool take_helper(fw_team *team) {
    int idle = team ? atomic_load(&team->idle) : 0;
    while (idle > 0)
        if (atomic_compare_exchange_weak(&team->idle, &idle, idle - 1)) return true;
    return false;
}

/* arenas of the parts, which have the blocks that the whole keeps: their pages are there */
static bool begin_parts(fw_arena *whole, parts *p) {
    for (size_t i = 0; i < p->n; i++) {
        if (!(p->arena[i] = fw_arena_part(whole, whole->cap))) return false;
        p->arena[i]->keeps = whole->keeps;
    }
    for (size_t i = 0; whole->spare; i = (i + 1) % p->n) {
        chunk *c = whole->spare;
        whole->spare = c->before;
        c->before = p->arena[i]->spare;
        p->arena[i]->spare = c;
    }
    return true;
}

static void run_parts(parts *p) {
    pthread_t thread[MOST_HELPERS];
    size_t helpers = 0;
    for (; helpers + 1 < p->n && helpers < MOST_HELPERS && take_helper(p->team); helpers++)
        if (pthread_create(&thread[helpers], NULL, help, p) != 0) {
            atomic_fetch_add(&p->team->idle, 1);
            break;
        }
    do_parts(p, false);
    for (size_t i = 0; i < helpers; i++)
        pthread_join(thread[i], NULL);
}

static fw_status end_parts(fw_arena *whole, parts *p, fw_status status) {
    for (size_t i = 0; i < p->n && p->arena[i]; i++) {
        fw_arena *part = p->arena[i];
        if (status == FW_OK) status = p->status[i];
        if (!take_over(whole, part) && status == FW_OK)
            status = FW_NOMEM; /* messages of a part that failed stay */
        while (whole->keeps && part->spare) {
            chunk *c = part->spare;
            part->spare = c->before;
            c->before = whole->spare;
            whole->spare = c;
        }
        fw_arena_free(part);
    }
    return status;
}

fw_status fw_arena_each(fw_arena *whole, size_t n,
                        fw_status (*one)(void *context, size_t i, fw_arena *arena), void *context) {
    parts p = {.n = n, .one = one, .context = context, .team = whole->team, .locale = uselocale(0)};
    if (n < 2 || !fw_arena_helped(whole)) {
        for (size_t i = 0; i < n; i++)
            FW_TRY(one(context, i, whole));
        return FW_OK;
    }
    FW_NEED(p.arena = fw_arena_array(whole, fw_arena *, n));
    FW_NEED(p.status = fw_arena_array(whole, fw_status, n));
    const bool begun = begin_parts(whole, &p);
    if (begun) run_parts(&p);
    return end_parts(whole, &p, begun ? FW_OK : FW_NOMEM);
}

/* lock-free, hence fit for signal handlers, and for other threads too. No other memory hangs on the
   number, so that no order is asked for. */
_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler may not wait for a lock");

void fw_cancel_request(fw_cancel *cancel, int number) {
    atomic_store_explicit(&cancel->number, number, memory_order_relaxed);
}

void fw_cancel_clear(fw_cancel *cancel) {
    atomic_store_explicit(&cancel->number, 0, memory_order_relaxed);
}

int fw_cancel_requested(const fw_cancel *cancel) {
    int number = 0;
    for (; cancel && number == 0; cancel = cancel->above)
        number = atomic_load_explicit(&cancel->number, memory_order_relaxed);
    return number;
}
