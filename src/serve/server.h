/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the server and of a request. Private to the room. */
#ifndef FW_SERVE_SERVER_H
#define FW_SERVE_SERVER_H
#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"
#include "serve/serve_guard.h"
#include "serve/serve.h"
#include <microhttpd.h>
#include <stdint.h>

enum {
    FW_SERVE_CONNECTIONS = 32,  /* at once; more wait until one is free */
    FW_SERVE_IDLE_S = 5,        /* a connection on which nothing moves */
    FW_SERVE_REQUEST_MS = 9000, /* a request must be complete by then */
    FW_SERVE_REPLY_MS = 60000,  /* and its answer taken */
    FW_SERVE_CROWDED_MS =
        500,              /* when all connections are taken, who is slower than this makes room */
    FW_SERVE_STREAMS = 4, /* of events */
    FW_SERVE_QUEUED = 4,  /* jobs that wait */
    FW_SERVE_WORKERS = 2
};

typedef struct fw_serve_server fw_serve_server;
typedef struct fw_serve_request fw_serve_request;

typedef struct fw_serve_reply {
    unsigned status; /* HTTP; 0: there is none yet */
    const char *type;
    const void *data; /* (n), in the request's arena or static */
    size_t n;
    int fd; /* instead of data where `file`: n bytes from its start; the reply owns it */
    bool file;
    const char *location, *cookie, *etag, *disposition; /* headers, NULL: none */
    const char *policy;                                 /* NULL: that of the page */
    bool may_cache;                                     /* else no-store */
    bool close;                                         /* the connection ends with it */
} fw_serve_reply;

typedef enum fw_serve_phase {
    FW_RECEIVING, /* also between requests */
    FW_WORKING,
    FW_SENDING,
    FW_STREAMING
} fw_serve_phase;

typedef struct fw_serve_connection { /* a slot of the server's table */
    struct MHD_Connection *mhd;
    int fd; /* -1: the slot is free */
    fw_serve_phase phase;
    int64_t since_ms; /* when the phase began */
    bool cut;
    fw_serve_request *request;
} fw_serve_connection;

typedef struct fw_serve_stream { /* events for one page */
    fw_serve_request *request;   /* NULL: free */
    char *waiting;               /* (capacity) bytes not yet taken */
    size_t length, taken;
    int64_t last_ms;
} fw_serve_stream;

struct fw_serve_request {
    fw_serve_server *server;
    fw_serve_connection *connection;
    fw_arena *arena; /* freed with the request */
    const struct fw_serve_route *route;
    const char *path, *method;
    const char *if_none_match;
    bool foreign;    /* comes from a page that is not ours: only the entry may */
    size_t declared; /* bytes of body */
    char *body;      /* (declared) and a NUL */
    size_t received;
    fw_serve_reply reply;
    bool suspended, answered;
    bool gone;                /* the client went away */
    fw_serve_request *next;   /* waiting for a worker */
    unsigned compute;         /* what the worker is to do: an fw_serve_compute */
    struct fw_serve_job *job; /* whose archive is awaited */
    fw_serve_stream *stream;
};

typedef struct fw_serve_route { /* one row of routes.c */
    const char *method, *path;  /* a path that ends with '*' has anything behind */
    /* fills request->reply, or leaves it empty and sees to it that fw_serve_request_answer is
       called */
    void (*handle)(fw_serve_request *request);
} fw_serve_route;
const fw_serve_route *fw_serve_route_find(const char *method, const char *path, bool *known_path);

struct fw_serve_server {
    fw_serve_options options;
    fw_arena *arena; /* of the server's life; small */
    struct MHD_Daemon *daemon[FW_SERVE_ADDRESSES];
    unsigned port;
    fw_serve_guard guard;
    fw_serve_connection connection[2 * FW_SERVE_CONNECTIONS];
    fw_serve_stream stream[FW_SERVE_STREAMS];
    struct fw_serve_pool *pool;
    struct fw_serve_jobs *jobs;
    struct fw_serve_file_watch *watch;
    struct fw_serve_scratch *scratch;
    bool asked; /* something was asked for since workers and jobs were looked at */
};

int64_t fw_serve_now_ms(void);

/* ---- http.c ---- */
bool fw_serve_http_start(fw_serve_server *server, fw_diags *diags);
void fw_serve_http_stop(fw_serve_server *server);
/* cuts clients that are too slow, and notices those that went away */
void fw_serve_http_reap(fw_serve_server *server);
/* a request that waited has its reply now */
void fw_serve_request_answer(fw_serve_request *request);

/* ---- replies ---- */
/* what is no UTF-8 becomes '?': texts of other programs, and such as were cut, go into JSON */
void fw_serve_reply_clean(char *text);
/* text in the request's arena, or static */
void fw_serve_reply_json(fw_serve_request *request, unsigned status, const char *text, size_t n);
void fw_serve_reply_text(fw_serve_request *request, unsigned status, const fw_text *text);
/* {"error": {"message", "code"}}; code NULL or "FW-D286" */
void fw_serve_reply_error(fw_serve_request *request, unsigned status, const char *code,
                          const char *format, ...) __attribute__((format(printf, 4, 5)));

/* ---- handlers ---- */
void fw_serve_route_entry(fw_serve_request *request);
void fw_serve_route_page(fw_serve_request *request);
void fw_serve_route_session(fw_serve_request *request);
void fw_serve_route_table(fw_serve_request *request);
void fw_serve_route_preview(fw_serve_request *request);
void fw_serve_route_pose(fw_serve_request *request);
void fw_serve_route_edit(fw_serve_request *request);
void fw_serve_route_file(fw_serve_request *request);
void fw_serve_route_save(fw_serve_request *request);
void fw_serve_route_events(fw_serve_request *request);
void fw_serve_route_job_new(fw_serve_request *request);
void fw_serve_route_job(fw_serve_request *request); /* also its files and its archive */
void fw_serve_route_job_delete(fw_serve_request *request);

#endif
