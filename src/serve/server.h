/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server: its parts put together, and the rows of what can be asked for. Private to the
   room. */
#ifndef FW_SERVE_SERVER_H
#define FW_SERVE_SERVER_H
#include "serve/jobs.h"
#include "serve/serve.h"
#include "serve/serve_guard.h"
#include "serve/document.h"
#include "serve/child.h"

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
