/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worker's side: one question after the other from descriptor 3. */
#include "base/arena.h"
#include "plan/live.h"
#include "serve/worker.h"
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

enum { CHANNEL = 3, QUESTION_CPU_S = 20, MEMORY_CAP = 1024 * 1024 * 1024 };

/* nobody waits for the answer any more; a handler sees nothing but what is static */
static fw_cancel unwanted;

static void stop(int number) {
    fw_cancel_request(&unwanted, number);
}

/* so much processor time for the next question; beyond it the system ends this process */
static void ration(void) {
    struct rusage used;
    struct rlimit most;
    if (getrusage(RUSAGE_SELF, &used) != 0 || getrlimit(RLIMIT_CPU, &most) != 0) return;
    most.rlim_cur = (rlim_t)(used.ru_utime.tv_sec + used.ru_stime.tv_sec + QUESTION_CPU_S);
    setrlimit(RLIMIT_CPU, &most);
}

static bool read_all(void *to, size_t n) {
    for (char *at = to; n > 0;) {
        ssize_t got = read(CHANNEL, at, n);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got;
        n -= (size_t)got;
    }
    return true;
}

static bool write_all(const void *from, size_t n) {
    for (const char *at = from; n > 0;) {
        ssize_t done = write(CHANNEL, at, n);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        n -= (size_t)done;
    }
    return true;
}

static bool answer(unsigned status, const char *text, size_t n) {
    fw_serve_worker_head head = {.what = status, .n = (uint32_t)n};
    return write_all(&head, sizeof head) && write_all(text, n);
}

static unsigned http_status(fw_status status) {
    switch (status) {
    case FW_OK:
        return 200;
    case FW_USAGE:
    case FW_INPUT:
        return 400;
    case FW_LIMIT:
    case FW_NOMEM:
        return 413; /* more than one request may cost */
    case FW_CANCELLED:
        return 409;
    case FW_GEOMETRY:
    case FW_IO:
    case FW_SOLVER:
    case FW_INTERNAL:
        break;
    }
    return 500;
}

static bool compute(fw_plan_live *live, uint32_t what, const char *request, size_t n) {
    fw_plan_live_answer a = {0};
    switch ((fw_serve_compute)what) {
    case FW_COMPUTE_TABLE:
        a = fw_plan_live_table(live);
        break;
    case FW_COMPUTE_PREVIEW:
        a = fw_plan_live_preview(live, request, n);
        break;
    case FW_COMPUTE_POSE:
        a = fw_plan_live_pose(live, request, n);
        break;
    case FW_COMPUTE_EDIT:
        a = fw_plan_live_edit(live, request, n);
        break;
    }
    if (!a.text) return false; /* the parent asks for what this child does not know */
    return answer(http_status(a.status), a.text, a.length);
}

static bool one(void *state) {
    fw_serve_worker_head head;
    if (!read_all(&head, sizeof head) || head.n > FW_SERVE_MOST_QUESTION) return false;
    fw_arena *arena = fw_arena_new(0);
    char *request = arena ? fw_arena_array(arena, char, (size_t)head.n + 1) : NULL;
    bool ok = request && read_all(request, head.n);
    fw_cancel_clear(&unwanted);
    ration();
    ok = ok && compute(state, head.what, request, head.n);
    fw_arena_free(arena);
    return ok;
}

int fw_serve_worker_main(const char *data_directory) {
    struct sigaction cancel = {.sa_handler = stop}, end = {.sa_handler = SIG_DFL};
    sigaction(SIGINT, &cancel, NULL);
    sigaction(SIGTERM, &end, NULL);
    fw_plan_live_settings settings = {.data_directory = *data_directory ? data_directory : NULL,
                                      .memory_cap = MEMORY_CAP,
                                      .cancel = &unwanted};
    fw_plan_live *live = fw_plan_live_new(&settings);
    if (!live) return fw_status_exit(FW_NOMEM);
    while (one(live)) {
    }
    fw_plan_live_free(live);
    return 0;
}
