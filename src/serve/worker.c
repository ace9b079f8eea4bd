/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes that wait for work of milliseconds: the server's side, and the worker's own. */
#include "base/arena.h"
#include "plan/live.h"
#include "serve/jobs.h"
#include "serve/serve.h"
#include "study/study.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

/* ---- the server's side ---- */

enum {
    ANSWER_MS = 20000,   /* a computation that takes longer is ended */
    CANCELLED_MS = 1000, /* one that nobody waits for any more has so long to stop */
    STOPPING_MS = 50,    /* most that a preview waits for the worker that knows its device */
    RESTART_MS = 1000,   /* a worker that ends at once is not started more often than this */
    MEMORY_MIB = 2048
};

typedef struct fw_serve_worker {
    pid_t pid; /* 0: none */
    int fd;
    int64_t started_ms, asked_ms;
    bool busy, cancelled;
    fw_serve_request *request; /* NULL while busy: nobody waits for the answer */
    fw_serve_worker_head head; /* of the question */
    size_t sent;
    fw_serve_worker_head answer;
    size_t got; /* bytes of the answer with its head */
    char *text; /* in the request's arena */
} fw_serve_worker;

struct fw_serve_pool {
    const char *data_directory; /* "": as installed */
    fw_serve_worker worker[FW_SERVE_WORKERS];
    fw_serve_request *first; /* waiting */
};

static bool start(const fw_serve_pool *pool, fw_serve_worker *w) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) return false;
    const char *const argv[] = {"flexwright", FW_SERVE_CHILD, "worker", pool->data_directory, NULL};
    fw_serve_child_plan plan = {
        .argv = argv,
        .directory = -1,
        .in = -1,
        .out = -1,
        .err = -1,
        .channel = pair[1],
        .limits = {.memory_bytes = (uint64_t)MEMORY_MIB << 20, .file_bytes = 0, .files = 32}};
    pid_t pid = fw_serve_child_start(&plan);
    int why = errno;
    close(pair[1]);
    if (pid < 0) {
        close(pair[0]);
        errno = why;
        return false;
    }
    fcntl(pair[0], F_SETFL, O_NONBLOCK);
    *w = (fw_serve_worker){.pid = pid, .fd = pair[0], .started_ms = fw_serve_now_ms()};
    return true;
}

fw_status fw_serve_pool_open(fw_arena *arena, const char *data_directory, fw_serve_pool **pool) {
    FW_NEED(*pool = fw_arena_one(arena, fw_serve_pool));
    (*pool)->data_directory = data_directory ? data_directory : "";
    for (int i = 0; i < FW_SERVE_WORKERS; i++)
        if (!start(*pool, &(*pool)->worker[i])) return FW_IO;
    return FW_OK;
}

static void end(fw_serve_worker *w) {
    if (!w->pid) return;
    fw_serve_child_kill(w->pid);
    close(w->fd);
    w->pid = 0;
    w->busy = false;
}

void fw_serve_pool_close(fw_serve_pool *pool) {
    for (int i = 0; pool && i < FW_SERVE_WORKERS; i++)
        end(&pool->worker[i]);
}

/* ---- requests ---- */

void fw_serve_pool_ask(fw_serve_pool *pool, fw_serve_request *r, fw_serve_compute what) {
    fw_serve_request **at = &pool->first;
    while (*at)
        at = &(*at)->next;
    r->compute = what;
    r->next = NULL;
    *at = r;
}

/* nobody waits any more: a worker that has begun is asked to stop */
void fw_serve_pool_forget(fw_serve_pool *pool, fw_serve_request *r) {
    if (!pool) return;
    for (fw_serve_request **at = &pool->first; *at; at = &(*at)->next)
        if (*at == r) {
            *at = r->next;
            break;
        }
    for (int i = 0; i < FW_SERVE_WORKERS; i++) {
        fw_serve_worker *w = &pool->worker[i];
        if (!w->busy || w->request != r) continue;
        /* what was not sent or read yet was in the request's memory: such a worker is of no use */
        if (w->sent < sizeof w->head + w->head.n || w->got > 0)
            end(w);
        else {
            kill(w->pid, SIGINT);
            w->asked_ms = fw_serve_now_ms();
        }
        w->cancelled = true;
        w->request = NULL;
        w->text = NULL;
    }
}

static void finish(fw_serve_worker *w) {
    fw_serve_request *r = w->request;
    w->busy = w->cancelled = false;
    w->request = NULL;
    if (!r) return;
    fw_serve_reply_json(r, w->answer.what, w->text, w->answer.n);
    fw_serve_request_answer(r);
}

/* it crashed, reached a limit, or says what makes no sense */
static void fail(fw_serve_worker *w, const char *why) {
    fw_serve_request *r = w->request;
    w->request = NULL;
    end(w);
    if (!r) return;
    fw_serve_reply_error(r, 500, "FW-D286", "%s", why);
    fw_serve_request_answer(r);
}

/* ---- bytes ---- */

/* a request that was given up leaves no memory to read from or into: then the worker was ended, and
   only the whole answer is still to come, which is thrown away */
static bool send_more(fw_serve_worker *w) {
    size_t head = sizeof w->head;
    while (w->sent < head + w->head.n) {
        const char *from =
            w->sent < head ? (const char *)&w->head + w->sent : w->request->body + (w->sent - head);
        size_t n = w->sent < head ? head - w->sent : head + w->head.n - w->sent;
        ssize_t done = send(w->fd, from, n, MSG_NOSIGNAL);
        if (done < 0) return errno == EAGAIN || errno == EINTR;
        w->sent += (size_t)done;
    }
    return true;
}

static bool room_for_answer(fw_serve_worker *w) {
    if (w->answer.n > FW_WORKER_MOST_ANSWER || w->answer.what < 200 || w->answer.what > 599)
        return false;
    if (!w->request) return true;
    w->text = fw_arena_array(w->request->arena, char, (size_t)w->answer.n + 1);
    return w->text != NULL;
}

/* 1: more to come, 0: whole, -1: it ended */
static int read_more(fw_serve_worker *w) {
    char thrown_away[16384];
    size_t head = sizeof w->answer;
    for (;;) {
        if (w->got == head + w->answer.n && w->got >= head) return 0;
        char *to = thrown_away;
        size_t n = sizeof thrown_away;
        if (w->got < head) {
            to = (char *)&w->answer + w->got;
            n = head - w->got;
        } else {
            if (head + w->answer.n - w->got < n || w->request) n = head + w->answer.n - w->got;
            if (w->request) to = w->text + (w->got - head);
        }
        ssize_t got = recv(w->fd, to, n, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0 && errno == EAGAIN) return 1;
        if (got <= 0) return -1;
        w->got += (size_t)got;
        if (w->got == head && !room_for_answer(w)) return -1;
    }
}

/* ---- the loop's share ---- */

static void give(fw_serve_worker *w, fw_serve_request *r) {
    w->request = r;
    w->busy = true;
    w->cancelled = false;
    w->head = (fw_serve_worker_head){.what = r->compute, .n = (uint32_t)r->received};
    w->answer = (fw_serve_worker_head){0};
    w->sent = w->got = 0;
    w->asked_ms = fw_serve_now_ms();
}

/* A worker remembers the mechanism that it posed last, and the study whose points it judged, so that these go to the
   same one; previews and their pictures, of which it remembers what the last one read, go to the other while it is free. A
   slider that moves on has the preview before given up: its worker stops within moments, and is waited for, since the
   other one would read everything anew. So is a picture, which its preview follows: another processor draws it meanwhile.
   NULL: nobody is free, or free enough. */
static fw_serve_worker *free_worker(fw_serve_pool *pool, unsigned what, int64_t now) {
    bool kept = what == FW_COMPUTE_POSE || what == FW_COMPUTE_EXPLORE;
    int first = kept ? FW_SERVE_WORKERS - 1 : 0;
    const fw_serve_worker *usual = &pool->worker[first];
    const bool shown = what == FW_COMPUTE_PREVIEW || what == FW_COMPUTE_PICTURE;
    const bool soon = usual->cancelled || (usual->busy && usual->head.what == FW_COMPUTE_PICTURE);
    if (shown && usual->pid && soon && now - usual->asked_ms < STOPPING_MS) return NULL;
    for (int i = 0; i < FW_SERVE_WORKERS; i++) {
        fw_serve_worker *w = &pool->worker[(first + i) % FW_SERVE_WORKERS];
        if (w->pid && !w->busy) return w;
    }
    return NULL;
}

static void run_worker(const fw_serve_pool *pool, fw_serve_worker *w, int64_t now) {
    if (!w->pid) {
        if (now - w->started_ms >= RESTART_MS || now - w->started_ms < 0) start(pool, w);
        return;
    }
    int status;
    if (!w->busy) { /* it has nothing to say, unless it ended */
        if (fw_serve_child_ended(w->pid, &status)) {
            close(w->fd);
            w->pid = 0;
        }
        return;
    }
    if (!send_more(w)) {
        fail(w, "the computation ended unexpectedly");
        return;
    }
    int more = read_more(w);
    if (more == 0)
        finish(w);
    else if (more < 0)
        fail(w, "the computation ended unexpectedly: it crashed, or needed more than 2 GiB of "
                "memory, the most "
                "that the server gives to one");
    else if (now - w->asked_ms > (w->cancelled ? CANCELLED_MS : ANSWER_MS))
        fail(w, "the computation was ended after 20 s, the most that the server gives to one; ask "
                "for less, "
                "or start it as a job");
}

void fw_serve_pool_run(fw_serve_pool *pool) {
    int64_t now = fw_serve_now_ms();
    for (int i = 0; i < FW_SERVE_WORKERS; i++)
        run_worker(pool, &pool->worker[i], now);
    while (pool->first) {
        fw_serve_worker *w = free_worker(pool, pool->first->compute, now);
        if (!w) return;
        fw_serve_request *r = pool->first;
        pool->first = r->next;
        give(w, r);
        if (!send_more(w)) fail(w, "the computation could not be started");
    }
}

size_t fw_serve_pool_poll(const fw_serve_pool *pool, struct pollfd *poll, size_t most) {
    size_t n = 0;
    for (int i = 0; i < FW_SERVE_WORKERS && n < most; i++) {
        const fw_serve_worker *w = &pool->worker[i];
        if (!w->pid) continue;
        bool sending = w->busy && w->sent < sizeof w->head + w->head.n;
        poll[n++] =
            (struct pollfd){.fd = w->fd, .events = (short)(POLLIN | (sending ? POLLOUT : 0))};
    }
    return n;
}

/* ---- the worker's side: one question after the other from descriptor 3 ---- */

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

fw_plan_live_answer fw_serve_worker_answer(fw_plan_live *live, fw_serve_compute what,
                                           const char *request, size_t n) {
    switch (what) {
    case FW_COMPUTE_TABLE:
        return fw_plan_live_table(live);
    case FW_COMPUTE_PREVIEW:
        return fw_plan_live_preview(live, request, n);
    case FW_COMPUTE_PICTURE:
        return fw_plan_live_picture(live, request, n);
    case FW_COMPUTE_POSE:
        return fw_plan_live_pose(live, request, n);
    case FW_COMPUTE_EDIT:
        return fw_plan_live_edit(live, request, n);
    case FW_COMPUTE_EXPLORE:
        return fw_study_explore(live, request, n);
    }
    return (fw_plan_live_answer){0};
}

static bool compute(fw_plan_live *live, uint32_t what, const char *request, size_t n) {
    const fw_plan_live_answer a = fw_serve_worker_answer(live, (fw_serve_compute)what, request, n);
    if (!a.text) return false; /* the parent asks for what this child does not know */
    return answer(http_status(a.status), a.text, a.length);
}

static bool one_question(void *state) {
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
    struct sigaction cancel = {.sa_handler = stop}, usual = {.sa_handler = SIG_DFL};
    sigaction(SIGINT, &cancel, NULL);
    sigaction(SIGTERM, &usual, NULL);
    fw_plan_live_settings settings = {.data_directory = *data_directory ? data_directory : NULL,
                                      .memory_cap = MEMORY_CAP,
                                      .cancel = &unwanted};
    fw_plan_live *live = fw_plan_live_new(&settings);
    if (!live) return fw_status_exit(FW_NOMEM);
    while (one_question(live)) {
    }
    fw_plan_live_free(live);
    return 0;
}
