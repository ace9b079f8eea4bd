/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server: who may ask for what, its parts put together, and the rows of what can be asked for. Private to the
   room. */
#ifndef FW_SERVE_SERVER_H
#define FW_SERVE_SERVER_H
#include "serve/jobs.h"
#include "serve/serve.h"
#include <stdbool.h>
#include <stddef.h>

/* ---- serve_guard.c: one function over the facts of a request, before anything else looks at it ----
   The threats and what each check is for: docs/decisions/0015-serve.md. */
enum {
    FW_SERVE_SECRET = 65,             /* 64 hexadecimal digits (256 bits) and a NUL */
    FW_SERVE_MOST_BODY = 1024 * 1024, /* bytes of a request's body */
    FW_SERVE_MOST_PATH = 512,         /* bytes of a request's path */
    FW_SERVE_ADDRESSES = 2            /* 127.0.0.1, and ::1 when asked for */
};

typedef struct fw_serve_guard {
    char host[FW_SERVE_ADDRESSES][40];   /* exactly what Host must be: "127.0.0.1:8931" */
    char origin[FW_SERVE_ADDRESSES][48]; /* "http://" and the same */
    int addresses;
    char cookie_name[40];         /* has the port: cookies are shared by the ports of a host */
    char cookie[FW_SERVE_SECRET]; /* of the session */
    char header[FW_SERVE_SECRET]; /* of X-Flexwright-Token */
    char entry[FW_SERVE_SECRET];  /* the one-time token of the printed address */
    bool entry_used;
} fw_serve_guard;

/* what the server knows of a request when its head is there; NULL: the header is not there */
typedef struct fw_serve_guard_facts {
    const char *version, *method, *path; /* path as it was sent, without the query */
    const char *host, *origin, *fetch_site, *fetch_mode, *content_type, *content_length,
        *transfer_encoding, *cookie, *token;
    bool repeated;     /* one of these headers is there twice */
    bool odd_name;     /* the name of a header holds what may not stand in one */
    const char *entry; /* value of ?token= */
    bool query;        /* there is a query */
    size_t head_bytes; /* of the whole head */
    size_t seen_bytes; /* of its parts as texts, with one blank before each value */
} fw_serve_guard_facts;

typedef struct fw_serve_refusal {
    unsigned status; /* HTTP; 0: not refused */
    const char *why;
} fw_serve_refusal;

/* new secrets for a server on this port; false: the system gives no random numbers */
bool fw_serve_guard_new(fw_serve_guard *guard, unsigned port, bool ipv6);
/* the answer for a request, {0} when it may go on. Does not change the guard. */
fw_serve_refusal fw_serve_guard_check(const fw_serve_guard *guard,
                                      const fw_serve_guard_facts *facts);
/* is this the request that exchanges the one-time token for the cookie? */
bool fw_serve_guard_is_entry(const fw_serve_guard_facts *facts);
/* the bytes of a declared body; only after the check */
size_t fw_serve_guard_body(const fw_serve_guard_facts *facts);

/* ---- the defences by name ----
   All are on. A test builds the program once for each with FW_SERVE_WITHOUT=FW_DEFENCE_..., and
   must then see a hostile request get through (tests/serve/mutants.py). Checks that the table of
   routes repeats (methods, paths) are not here: without one of them the other still refuses. */

enum fw_serve_defence {
    FW_DEFENCE_NONE,
    FW_DEFENCE_HOST,
    FW_DEFENCE_ORIGIN,
    FW_DEFENCE_FETCH_SITE,
    FW_DEFENCE_ONE_TIME,
    FW_DEFENCE_COOKIE,
    FW_DEFENCE_HEADER_TOKEN,
    FW_DEFENCE_CONTENT_TYPE,
    FW_DEFENCE_BODY,
    FW_DEFENCE_HEAD,
    FW_DEFENCE_REAPER
};
#ifndef FW_SERVE_WITHOUT
#define FW_SERVE_WITHOUT FW_DEFENCE_NONE
#endif
#define FW_DEFENDED(what) (FW_SERVE_WITHOUT != FW_DEFENCE_##what)

typedef struct fw_serve_server {
    fw_serve_options options;
    fw_arena *arena; /* of the server's life; small */
    struct MHD_Daemon *daemon[FW_SERVE_ADDRESSES];
    unsigned port;
    fw_serve_guard guard;
    fw_serve_connection connection[2 * FW_SERVE_CONNECTIONS];
    fw_serve_events events;
    fw_serve_pool *pool;
    fw_serve_jobs *jobs;
    fw_serve_file_watch *watch; /* NULL: no file */
    fw_serve_scratch *scratch;
    bool asked;  /* something was asked for since workers and jobs were looked at */
    bool ending; /* no request waits any more: the library ends only what waits for nothing */
} fw_serve_server;

/* ---- routes.c: one row for everything that can be asked for ---- */
typedef struct fw_serve_route {
    const char *method, *path; /* a path that ends with '*' has anything behind */
    /* fills request->reply, or leaves it empty and sees to it that fw_serve_request_answer is
       called */
    void (*handle)(fw_serve_request *request);
    fw_serve_compute compute; /* of rows that a worker answers */
} fw_serve_route;
const fw_serve_route *fw_serve_route_find(const char *method, const char *path, bool *known_path);
/* the i-th row of what can be asked for, without the page's files; NULL: there are not so many */
const fw_serve_route *fw_serve_route_at(size_t i);
/* the request that exchanges the one-time token for the cookie; no row leads here */
void fw_serve_route_entry(fw_serve_request *request);

/* ---- the files of the page, in the program itself: cmake/embed.cmake writes the table ---- */
typedef struct fw_serve_page_file {
    const char *path; /* "/page.js"; "/" is index.html */
    const char *type; /* of its content, for HTTP */
    const char *etag; /* with its quotes: of all bytes */
    const unsigned char *data;
    size_t n;
} fw_serve_page_file;
extern const fw_serve_page_file fw_serve_page_files[];
extern const size_t fw_serve_page_count;

#endif
