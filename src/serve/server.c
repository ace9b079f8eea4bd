/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loop: sockets, workers, jobs, the file, and the signals that end it. */
#include "serve/server.h"
#include "base/arena.h"
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert((int)FW_SERVE_MOST_QUESTION >= (int)FW_SERVE_MOST_BODY,
               "a worker takes every body that the guard lets through");

enum { TICK_MS = 50, REST_MS = 500, MOST_POLLED = 64 };

/* ---- one round ---- */

static bool anybody_there(const fw_serve_server *server) {
    for (size_t i = 0; i < sizeof server->connection / sizeof *server->connection; i++)
        if (server->connection[i].fd >= 0) return true;
    return fw_serve_jobs_busy(server->jobs);
}

static size_t what_to_poll(const fw_serve_server *server, struct pollfd *at, int *wait_ms) {
    size_t n = 0;
    *wait_ms = anybody_there(server) ? TICK_MS : REST_MS;
    for (int i = 0; i < FW_SERVE_ADDRESSES; i++) {
        if (!server->daemon[i]) continue;
        const union MHD_DaemonInfo *info =
            MHD_get_daemon_info(server->daemon[i], MHD_DAEMON_INFO_EPOLL_FD);
        at[n++] = (struct pollfd){.fd = info->epoll_fd, .events = POLLIN};
        MHD_UNSIGNED_LONG_LONG soon;
        if (MHD_get_timeout(server->daemon[i], &soon) == MHD_YES && soon < (unsigned)*wait_ms)
            *wait_ms = (int)soon;
    }
    if (fw_serve_file_watch_fd(server->watch) >= 0)
        at[n++] = (struct pollfd){.fd = fw_serve_file_watch_fd(server->watch), .events = POLLIN};
    n += fw_serve_pool_poll(server->pool, at + n, MOST_POLLED - n);
    n += fw_serve_jobs_poll(server->jobs, at + n, MOST_POLLED - n);
    return n;
}

static void run_http(fw_serve_server *server) {
    for (int i = 0; i < FW_SERVE_ADDRESSES; i++)
        if (server->daemon[i]) MHD_run(server->daemon[i]);
}

static void round_once(fw_serve_server *server) {
    struct pollfd at[MOST_POLLED];
    int wait_ms;
    size_t n = what_to_poll(server, at, &wait_ms);
    poll(at, n, server->asked ? 0 : wait_ms);
    run_http(server);
    server->asked = false;
    fw_serve_pool_run(server->pool);
    fw_serve_jobs_run(server->jobs);
    fw_serve_file_watch_run(server->watch);
    fw_serve_events_run(&server->events);
    fw_serve_http_reap(server);
    run_http(server); /* what was answered just now goes out at once */
}

/* ---- start and end ---- */

static fw_status prepare(fw_serve_server *server, fw_diags *diags) {
    fw_arena *arena = server->arena;
    FW_TRY(fw_serve_file_watch_open(arena, server->options.device, FW_SERVE_MOST_BODY,
                                    &server->events, diags, &server->watch));
    FW_TRY(fw_serve_scratch_open(arena, diags, &server->scratch));
    FW_TRY(fw_serve_jobs_open(arena, server->scratch, &server->events, &server->jobs));
    fw_status status = fw_serve_pool_open(arena, server->options.data_directory, &server->pool);
    if (status == FW_IO)
        fw_diag_error(diags, 461, (fw_place){0}, "cannot start the processes that compute: %s",
                      strerror(errno));
    FW_TRY(status);
    if (!fw_serve_http_start(server, diags)) return FW_IO;
    return fw_serve_guard_new(&server->guard, server->port, server->options.ipv6) ? FW_OK : FW_IO;
}

/* children may be started in other directories */
static fw_status absolute(fw_serve_server *server) {
    const char *data = server->options.data_directory;
    char *whole = data && *data ? realpath(data, NULL) : NULL;
    if (!whole) return FW_OK; /* what is wrong with it, the children will say */
    server->options.data_directory = fw_arena_strdup(server->arena, whole);
    setenv("FLEXWRIGHT_DATA", whole, 1);
    free(whole);
    FW_NEED(server->options.data_directory);
    return FW_OK;
}

static void say(const fw_serve_server *server, const fw_diags *diags) {
    fw_text text = fw_text_new(server->arena);
    fw_diags_print(diags, &text, "flexwright", NULL, 0, 0);
    if (fw_text_end(&text) == FW_OK) fputs(text.data, stderr);
}

static void announce(const fw_serve_server *server) {
    char url[200];
    snprintf(url, sizeof url, "http://%s/?token=%s", server->guard.host[0], server->guard.entry);
    const char *page = fw_serve_scratch_page(server->arena, server->scratch, url);
    server->options.ready(url, page, server->options.context);
}

/* the terminal was closed; a handler sees nothing but what is static */
static fw_cancel closed_terminal;

static void hung_up(int number) {
    fw_cancel_request(&closed_terminal, number);
}

static fw_status serve(fw_serve_server *server) {
    struct sigaction closed = {.sa_handler = hung_up};
    sigaction(SIGHUP, &closed, NULL); /* of the terminal; SIGINT and SIGTERM are the program's */
    fw_diags diags = fw_diags_new(server->arena);
    fw_status status = absolute(server);
    if (status == FW_OK) status = prepare(server, &diags);
    if (diags.count) say(server, &diags);
    if (status == FW_OK) {
        announce(server);
        while (!fw_cancel_requested(server->options.interrupted) &&
               !fw_cancel_requested(&closed_terminal))
            round_once(server);
    } else if (!diags.count)
        fprintf(stderr, "flexwright: error: %s\n", fw_status_text(status));
    fw_serve_http_stop(server);
    fw_serve_jobs_close(server->jobs);
    fw_serve_pool_close(server->pool);
    fw_serve_file_watch_close(server->watch);
    fw_serve_scratch_close(server->scratch);
    return status;
}

int fw_serve_run(const fw_serve_options *options) {
    fw_arena *arena = fw_arena_new(0);
    fw_serve_server *server = arena ? fw_arena_one(arena, fw_serve_server) : NULL;
    fw_status status = FW_NOMEM;
    if (server) {
        server->options = *options;
        server->arena = arena;
        for (size_t i = 0; i < sizeof server->connection / sizeof *server->connection; i++)
            server->connection[i].fd = -1;
        status = serve(server);
    }
    fw_arena_free(arena);
    return fw_status_exit(status);
}

int fw_serve_child(int argc, char **argv) {
    if (argc == 4 && strcmp(argv[2], "worker") == 0) return fw_serve_worker_main(argv[3]);
    if (argc == 3 && strcmp(argv[2], "archive") == 0) return fw_serve_archive_main();
    return fw_status_exit(FW_USAGE);
}
