/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server. libmicrohttpd parses HTTP and moves bytes: here are its callbacks, and the loop over sockets,
   workers, jobs and the file, with the signals that end it. Who may ask is serve_guard.c's, what is
   answered the rows' of routes.c. Never more than one thread: the daemons have none, the loop runs them. */
#include "base/arena.h"
#include "serve/server.h"
#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <time.h>

enum { HEAD_BYTES = 32 * 1024, REQUEST_CAP = 256 * 1024 * 1024 };

/* ---- facts of a request ---- */

typedef struct header_row {
    const char *name;
    size_t offset;
} header_row;
#define FACT(name_, field_)                                                                        \
    { .name = (name_), .offset = offsetof(fw_serve_guard_facts, field_) }
static const header_row headers[] = {
    FACT("Host", host),
    FACT("Origin", origin),
    FACT("Sec-Fetch-Site", fetch_site),
    FACT("Content-Type", content_type),
    FACT("Content-Length", content_length),
    FACT("Transfer-Encoding", transfer_encoding),
    FACT("Cookie", cookie),
    FACT("X-Flexwright-Token", token),
};

static enum MHD_Result one_header(void *context, enum MHD_ValueKind kind, const char *name,
                                  const char *value) {
    (void)kind;
    fw_serve_guard_facts *facts = context;
    facts->seen_bytes += strlen(name) + 2 + (value ? strlen(value) : 0) + 2;
    /* of RFC 9110, 5.6.2: "Transfer-Encoding " is another header to us and may be none to others */
    static const char token[] = "!#$%&'*+-.^_`|~0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                "abcdefghijklmnopqrstuvwxyz";
    if (!name[0] || strspn(name, token) != strlen(name)) facts->odd_name = true;
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++) {
        if (strcasecmp(name, headers[i].name) != 0) continue;
        const char **field = (const char **)(void *)((char *)facts + headers[i].offset);
        if (*field) facts->repeated = true;
        *field = value ? value : "";
    }
    return MHD_YES;
}

static enum MHD_Result one_argument(void *context, enum MHD_ValueKind kind, const char *name,
                                    const char *value) {
    (void)kind;
    fw_serve_guard_facts *facts = context;
    if (facts->query) facts->repeated = true; /* one argument at most */
    facts->query = true;
    facts->seen_bytes += 1 + strlen(name) + (value ? 1 + strlen(value) : 0);
    if (strcmp(name, "token") == 0) facts->entry = value ? value : "";
    return MHD_YES;
}

/* nothing is decoded: see plain_path in serve_guard.c */
static size_t as_it_is(void *context, struct MHD_Connection *connection, char *text) {
    (void)context, (void)connection;
    return strlen(text);
}

/* ---- a request ---- */

static fw_serve_connection *slot_of(struct MHD_Connection *mhd) {
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info ? info->socket_context : NULL;
}

static void phase(fw_serve_connection *slot, fw_serve_phase next) {
    if (!slot) return;
    slot->phase = next;
    slot->since_ms = fw_serve_now_ms();
}

static enum MHD_Result send_reply(fw_serve_request *r, struct MHD_Connection *mhd) {
    phase(r->connection, r->stream ? FW_STREAMING : FW_SENDING);
    return fw_serve_reply_queue(r, mhd);
}

static fw_serve_request *request_new(fw_serve_server *server, struct MHD_Connection *mhd) {
    fw_arena *arena = fw_arena_new(REQUEST_CAP);
    fw_serve_request *r = arena ? fw_arena_one(arena, fw_serve_request) : NULL;
    if (!r) {
        fw_arena_free(arena);
        return NULL;
    }
    *r = (fw_serve_request){.server = server, .arena = arena, .connection = slot_of(mhd)};
    r->reply.fd = -1;
    if (r->connection) r->connection->request = r;
    return r;
}

/* the head is there: may it go on, and where to? Fills the reply when not. */
static void admit(fw_serve_request *r, struct MHD_Connection *mhd, const char *path,
                  const char *method, const char *version) {
    fw_serve_guard *guard = &r->server->guard;
    fw_serve_guard_facts facts = {.version = version, .method = method, .path = path};
    MHD_get_connection_values(mhd, MHD_HEADER_KIND, one_header, &facts);
    MHD_get_connection_values(mhd, MHD_GET_ARGUMENT_KIND, one_argument, &facts);
    /* "GET /path HTTP/1.1" with its two spaces and line end, and the empty line */
    facts.seen_bytes += strlen(method) + strlen(path) + strlen(version) + 4 + 2;
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_REQUEST_HEADER_SIZE);
    facts.head_bytes = info ? info->header_size : SIZE_MAX;
    fw_serve_refusal refusal = fw_serve_guard_check(guard, &facts);
    r->reply.close = true; /* whatever comes behind a refused head is not looked at */
    if (refusal.status) {
        if (fw_serve_guard_is_entry(&facts) || (strcmp(path, "/") == 0 && refusal.status == 401))
            fw_serve_reply_refusal(r, refusal.status, refusal.why);
        else
            fw_serve_reply_error(r, refusal.status, NULL, "%s", refusal.why);
        return;
    }
    bool known;
    r->route = fw_serve_route_find(method, path, &known);
    if (!r->route) {
        fw_serve_reply_error(r, known ? 405 : 404, NULL, "this server has no %s %s", method, path);
        return;
    }
    r->path = fw_arena_strdup(r->arena, path);
    r->method = r->route->method;
    r->if_none_match = MHD_lookup_connection_value(mhd, MHD_HEADER_KIND, "If-None-Match");
    r->declared = fw_serve_guard_body(&facts);
    r->body = fw_arena_array(r->arena, char, r->declared + 1);
    if (!r->path || !r->body) {
        fw_serve_reply_no_memory(r);
        return;
    }
    r->foreign = facts.fetch_site && strcmp(facts.fetch_site, "same-origin") != 0 &&
                 strcmp(facts.fetch_site, "none") != 0;
    if (fw_serve_guard_is_entry(&facts)) {
        guard->entry_used = true;
        fw_serve_route_entry(r);
        fw_serve_scratch_drop_page(r->server->scratch);
        return;
    }
    r->reply.close = false;
}

static enum MHD_Result more_body(fw_serve_request *r, const char *data, size_t *n) {
    if (*n > r->declared - r->received) return MHD_NO; /* more than was said: cut */
    memcpy(r->body + r->received, data, *n);
    r->received += *n;
    *n = 0;
    return MHD_YES;
}

static enum MHD_Result on_request(void *context, struct MHD_Connection *mhd, const char *path,
                                  const char *method, const char *version, const char *data,
                                  size_t *n, void **state) {
    fw_serve_request *r = *state;
    if (!r) {
        *state = r = request_new(context, mhd);
        if (!r) return MHD_NO;
        admit(r, mhd, path, method, version);
        return r->reply.status ? send_reply(r, mhd) : MHD_YES;
    }
    if (*n > 0) return more_body(r, data, n);
    if (r->answered) return send_reply(r, mhd);
    if (r->received != r->declared) return MHD_NO;
    phase(r->connection, FW_WORKING);
    r->server->asked = true;
    if (r->server->ending)
        fw_serve_reply_error(r, 503, NULL, "the server ends");
    else
        r->route->handle(r);
    if (r->reply.status) return send_reply(r, mhd);
    r->suspended = true;
    MHD_suspend_connection(mhd);
    return MHD_YES;
}

static void on_completed(void *context, struct MHD_Connection *mhd, void **state,
                         enum MHD_RequestTerminationCode why) {
    (void)context, (void)mhd, (void)why;
    fw_serve_request *r = *state;
    if (!r) return;
    *state = NULL;
    fw_serve_pool_forget(r->server->pool, r);
    fw_serve_jobs_forget(r);
    fw_serve_events_close(r);
    if (r->connection) {
        r->connection->request = NULL;
        phase(r->connection, FW_RECEIVING);
    }
    fw_arena_free(r->arena);
}

/* ---- connections ---- */

static void on_connection(void *context, struct MHD_Connection *mhd, void **socket_context,
                          enum MHD_ConnectionNotificationCode what) {
    fw_serve_server *server = context;
    if (what == MHD_CONNECTION_NOTIFY_CLOSED) {
        fw_serve_connection *slot = *socket_context;
        if (slot) slot->fd = -1;
        *socket_context = NULL;
        return;
    }
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_CONNECTION_FD);
    *socket_context = NULL;
    for (size_t i = 0; info && i < sizeof server->connection / sizeof *server->connection; i++) {
        fw_serve_connection *slot = &server->connection[i];
        if (slot->fd >= 0) continue;
        *slot = (fw_serve_connection){.mhd = mhd, .fd = info->connect_fd};
        phase(slot, FW_RECEIVING);
        *socket_context = slot;
        return;
    }
}

static void cut(fw_serve_connection *slot) {
    if (slot->cut) return;
    slot->cut = true;
    shutdown(slot->fd, SHUT_RDWR); /* libmicrohttpd sees the end and closes */
}

static bool went_away(const fw_serve_connection *slot) {
    struct pollfd at = {.fd = slot->fd, .events = POLLRDHUP};
    return poll(&at, 1, 0) == 1 && (at.revents & (POLLRDHUP | POLLHUP | POLLERR));
}

/* the client of a request that waits has gone: so may what it waits for */
static void notice_gone(fw_serve_connection *slot) {
    fw_serve_request *r = slot->request;
    if (!r || !r->suspended || r->gone || !went_away(slot)) return;
    r->gone = true;
    fw_serve_pool_forget(r->server->pool, r);
    fw_serve_jobs_forget(r);
    if (!r->stream) fw_serve_reply_error(r, 400, NULL, "the client went away");
    fw_serve_request_answer(r);
}

/* all connections are taken: those that have been asking for longest without having asked for
   anything make room, a few at a time */
static void make_room(fw_serve_server *server, int64_t now) {
    for (int round = 0; round < FW_SERVE_CONNECTIONS / 4; round++) {
        fw_serve_connection *slowest = NULL;
        int taken = 0;
        for (size_t i = 0; i < sizeof server->connection / sizeof *server->connection; i++) {
            fw_serve_connection *slot = &server->connection[i];
            if (slot->fd < 0 || slot->cut) continue;
            taken++;
            if (slot->phase == FW_RECEIVING && now - slot->since_ms > FW_SERVE_CROWDED_MS &&
                (!slowest || slot->since_ms < slowest->since_ms))
                slowest = slot;
        }
        if (!slowest || taken < FW_SERVE_CONNECTIONS - FW_SERVE_CONNECTIONS / 4) return;
        cut(slowest);
    }
}

/* cuts clients that are too slow, and notices those that went away */
static void reap(fw_serve_server *server) {
    int64_t now = fw_serve_now_ms();
    int taken = 0;
    for (size_t i = 0; i < sizeof server->connection / sizeof *server->connection; i++) {
        fw_serve_connection *slot = &server->connection[i];
        if (slot->fd < 0) continue;
        taken++;
        notice_gone(slot);
        int64_t age = now - slot->since_ms;
        if (!FW_DEFENDED(REAPER)) continue;
        if ((slot->phase == FW_RECEIVING && age > FW_SERVE_REQUEST_MS) ||
            (slot->phase == FW_SENDING && age > FW_SERVE_REPLY_MS))
            cut(slot);
    }
    if (taken >= FW_SERVE_CONNECTIONS) make_room(server, now);
}

/* ---- listening ---- */

static struct MHD_Daemon *listen_on(fw_serve_server *server, const struct sockaddr *address,
                                    unsigned flags) {
    return MHD_start_daemon(
        flags | MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, NULL, NULL, on_request, server,
        MHD_OPTION_SOCK_ADDR, address, MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)HEAD_BYTES,
        MHD_OPTION_CONNECTION_LIMIT, (unsigned)FW_SERVE_CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT,
        (unsigned)FW_SERVE_IDLE_S, MHD_OPTION_NOTIFY_COMPLETED, on_completed, server,
        MHD_OPTION_NOTIFY_CONNECTION, on_connection, server, MHD_OPTION_UNESCAPE_CALLBACK, as_it_is,
        NULL, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_LISTEN_BACKLOG_SIZE, 256U,
        MHD_OPTION_SIGPIPE_HANDLED_BY_APP, 1, MHD_OPTION_END);
}

static bool could_not_listen(const fw_serve_server *server, const char *address, fw_diags *diags) {
    fw_diag_error(diags, 284, (fw_place){.file = NULL}, "cannot listen on %s port %d: %s", address,
                  server->options.port, strerror(errno));
    return false;
}

static bool start_http(fw_serve_server *server, fw_diags *diags) {
    struct sockaddr_in four = {.sin_family = AF_INET,
                               .sin_port = htons((uint16_t)server->options.port),
                               .sin_addr = {.s_addr = htonl(INADDR_LOOPBACK)}};
    server->daemon[0] = listen_on(server, (const struct sockaddr *)&four, 0);
    if (!server->daemon[0]) return could_not_listen(server, "127.0.0.1", diags);
    const union MHD_DaemonInfo *info =
        MHD_get_daemon_info(server->daemon[0], MHD_DAEMON_INFO_BIND_PORT);
    server->port = info ? info->port : 0;
    if (!server->options.ipv6) return true;
    struct sockaddr_in6 six = {.sin6_family = AF_INET6,
                               .sin6_port = htons((uint16_t)server->port),
                               .sin6_addr = IN6ADDR_LOOPBACK_INIT};
    server->daemon[1] = listen_on(server, (const struct sockaddr *)&six, MHD_USE_IPv6);
    return server->daemon[1] || could_not_listen(server, "::1", diags);
}

/* Ends every connection. What comes in during the last run of the library, and a stream whose
   first words are just out, must not be put to sleep: the library ends the whole program then. */
static void stop_http(fw_serve_server *server) {
    server->ending = true;
    for (size_t i = 0; i < sizeof server->connection / sizeof *server->connection; i++) {
        fw_serve_connection *slot = &server->connection[i];
        if (slot->fd < 0 || !slot->request) continue;
        slot->request->gone = true;
        if (!slot->request->suspended) continue;
        if (!slot->request->stream)
            fw_serve_reply_error(slot->request, 503, NULL, "the server ends");
        fw_serve_request_answer(slot->request);
    }
    for (int i = 0; i < FW_SERVE_ADDRESSES; i++) {
        if (!server->daemon[i]) continue;
        MHD_run(server->daemon[i]);
        MHD_stop_daemon(server->daemon[i]);
        server->daemon[i] = NULL;
    }
}

_Static_assert((int)FW_SERVE_MOST_QUESTION >= (int)FW_SERVE_MOST_BODY,
               "a worker takes every body that the guard lets through");

enum { TICK_MS = 50, REST_MS = 500, MOST_POLLED = 64 };

/* ---- one round of the loop ---- */

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
    if (server->asked) wait_ms = 0;
    /* no memory to wait with: everybody is asked in turn as always, but not without a pause, which would take a processor */
    if (poll(at, n, wait_ms) < 0 && errno != EINTR)
        nanosleep(&(struct timespec){.tv_nsec = 1000000L * wait_ms}, NULL);
    run_http(server);
    server->asked = false;
    fw_serve_pool_run(server->pool);
    fw_serve_jobs_run(server->jobs);
    fw_serve_file_watch_run(server->watch);
    fw_serve_events_run(&server->events);
    reap(server);
    run_http(server); /* what was answered just now goes out at once */
}

/* ---- the server from its start to its end ---- */

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
    if (!start_http(server, diags)) return FW_IO;
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
    if (fw_text_end(&text) == FW_OK)
        fputs(text.data, stderr);
    else
        fprintf(stderr, "flexwright: error: %s\n", fw_status_text(FW_NOMEM));
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
    stop_http(server);
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
    } else
        fprintf(stderr, "flexwright: error: %s\n", fw_status_text(status));
    fw_arena_free(arena);
    return fw_status_exit(status);
}

int fw_serve_child(int argc, char **argv) {
    if (argc == 4 && strcmp(argv[2], "worker") == 0) return fw_serve_worker_main(argv[3]);
    if (argc == 3 && strcmp(argv[2], "archive") == 0) return fw_serve_archive_main();
    return fw_status_exit(FW_USAGE);
}
