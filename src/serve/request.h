/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request, its reply, and the streams of events: what every part of the server may use, and what
   knows nothing of the parts. Private to the room and its tests. */
#ifndef FW_SERVE_REQUEST_H
#define FW_SERVE_REQUEST_H
#include "base/arena.h"
#include "base/json.h"
#include <microhttpd.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    FW_SERVE_CONNECTIONS = 32,  /* at once; more wait until one is free */
    FW_SERVE_IDLE_S = 5,        /* a connection on which nothing moves */
    FW_SERVE_REQUEST_MS = 9000, /* a request must be complete by then */
    FW_SERVE_REPLY_MS = 60000,  /* and its answer taken */
    FW_SERVE_CROWDED_MS = 500,  /* when all are taken, who is slower than this makes room */
    FW_SERVE_STREAMS = 4        /* of events */
};

typedef struct fw_serve_request fw_serve_request;

typedef struct fw_serve_reply {
    unsigned status; /* HTTP; 0: there is none yet */
    const char *type;
    const void *data; /* (n), in the request's arena or static */
    size_t n;
    int fd; /* instead of data where `file`: n bytes from its start; the reply owns it */
    bool file;
    struct MHD_Response *made; /* instead of both: its bytes are still to come; the reply owns it */
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

struct fw_serve_request {
    struct fw_serve_server *server; /* for handlers and callbacks */
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
    fw_serve_request *next;   /* that waits behind this one: for a worker, or for an archive */
    unsigned compute;         /* what the worker is to do: an fw_serve_compute */
    struct fw_serve_job *job; /* whose archive is awaited */
    struct fw_serve_stream *stream; /* of events that it gets; NULL: an ordinary request */
};

/* ---- reply.c ---- */
int64_t fw_serve_now_ms(void);
/* a request that waited has its reply now */
void fw_serve_request_answer(fw_serve_request *request);
/* what is no UTF-8 becomes '?': texts of other programs, and such as were cut, go into JSON */
void fw_serve_reply_clean(char *text);
/* the media type of a file, by its ending */
const char *fw_serve_reply_type(const char *path);
/* text in the request's arena, or static */
void fw_serve_reply_json(fw_serve_request *request, unsigned status, const char *text, size_t n);
/* what was written into `text`, finished here; where memory was short for it, that is the answer */
void fw_serve_reply_document(fw_serve_request *request, unsigned status, fw_json *json,
                             const fw_text *text);
/* {"error": {"message", "code"}}; code NULL or "FW-D286" */
void fw_serve_reply_error(fw_serve_request *request, unsigned status, const char *code,
                          const char *format, ...) __attribute__((format(printf, 4, 5)));
/* the same for a person who opened an address by hand; `why` is text of ours */
void fw_serve_reply_refusal(fw_serve_request *request, unsigned status, const char *why);
void fw_serve_reply_no_memory(fw_serve_request *request);
/* hands request->reply over, with the headers that every answer has */
enum MHD_Result fw_serve_reply_queue(fw_serve_request *request, struct MHD_Connection *mhd);

/* ---- server-sent events, what changed, for at most FW_SERVE_STREAMS pages ---- */
typedef struct fw_serve_stream { /* events for one page */
    fw_serve_request *request;   /* NULL: free */
    char *waiting;               /* (capacity) bytes not yet taken */
    size_t length, taken;
    int64_t last_ms;
} fw_serve_stream;

typedef struct fw_serve_events {
    fw_serve_stream stream[FW_SERVE_STREAMS];
} fw_serve_events;

/* makes the request a stream; false: there are as many as there may be */
bool fw_serve_events_open(fw_serve_events *events, fw_serve_request *request);
void fw_serve_events_close(fw_serve_request *request); /* when it is one of them */
/* one event, for one page and for all; the text is one line of JSON */
void fw_serve_stream_send(fw_serve_stream *stream, const char *event, const char *json);
void fw_serve_events_send(fw_serve_events *events, const char *event, const char *json);
/* a comment from time to time, so that a page that went away is noticed */
void fw_serve_events_run(fw_serve_events *events);

#endif
