/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/events.h"
#include "serve/watch.h"
#include <stdio.h>
#include <string.h>

enum { WAITING_BYTES = 64 * 1024, KEEP_ALIVE_MS = 10000 };

void fw_serve_route_events(fw_serve_request *r) {
    fw_serve_server *server = r->server;
    for (int i = 0; i < FW_SERVE_STREAMS; i++) {
        fw_serve_stream *stream = &server->stream[i];
        if (stream->request) continue;
        char *room = fw_arena_array(r->arena, char, WAITING_BYTES);
        if (!room) break;
        *stream = (fw_serve_stream){.request = r, .waiting = room, .last_ms = fw_serve_now_ms()};
        stream->length = (size_t)snprintf(room, WAITING_BYTES, ": flexwright\nretry: 1000\n\n");
        const char *version =
            fw_serve_file_watch_version(server->watch); /* it may have missed a change */
        if (version)
            stream->length +=
                (size_t)snprintf(room + stream->length, WAITING_BYTES - stream->length,
                                 "event: file\ndata: {\"version\": \"%s\"}\n\n", version);
        r->stream = stream;
        r->reply.status = 200;
        r->reply.type = "text/event-stream";
        return;
    }
    fw_serve_reply_error(r, 429, NULL, "there are %d pages already that listen",
                         (int)FW_SERVE_STREAMS);
}

void fw_serve_events_close(fw_serve_request *r) {
    if (r->stream) r->stream->request = NULL;
    r->stream = NULL;
}

/* what waits goes out; with nothing the connection sleeps until there is something */
static ssize_t take(void *context, uint64_t position, char *to, size_t most) {
    (void)position;
    fw_serve_stream *s = context;
    fw_serve_request *r = s->request;
    if (!r || r->gone) return MHD_CONTENT_READER_END_OF_STREAM;
    size_t n = s->length - s->taken;
    if (n > most) n = most;
    memcpy(to, s->waiting + s->taken, n);
    s->taken += n;
    if (s->taken == s->length) s->taken = s->length = 0;
    if (n == 0 && !r->suspended) {
        r->suspended = true;
        MHD_suspend_connection(r->connection->mhd);
    }
    return (ssize_t)n;
}

struct MHD_Response *fw_serve_events_response(fw_serve_request *r) {
    return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 4096, take, r->stream, NULL);
}

/* a page that does not read its events loses the stream, and asks anew */
static void append(fw_serve_stream *s, const char *text, size_t n) {
    if (n > WAITING_BYTES - s->length)
        s->request->gone = true;
    else {
        memcpy(s->waiting + s->length, text, n);
        s->length += n;
    }
    s->last_ms = fw_serve_now_ms();
    fw_serve_request_answer(s->request);
}

void fw_serve_events_send(fw_serve_server *server, const char *event, const char *format, ...) {
    char text[2048];
    int head = snprintf(text, sizeof text, "event: %s\ndata: ", event);
    va_list arguments;
    va_start(arguments, format);
    int data = vsnprintf(text + head, sizeof text - (size_t)head - 2, format, arguments);
    va_end(arguments);
    if (data < 0 || (size_t)(head + data) + 3 > sizeof text) return; /* ours are all short */
    memcpy(text + head + data, "\n\n", 3);
    for (int i = 0; i < FW_SERVE_STREAMS; i++)
        if (server->stream[i].request) append(&server->stream[i], text, (size_t)(head + data) + 2);
}

void fw_serve_events_run(fw_serve_server *server) {
    int64_t now = fw_serve_now_ms();
    for (int i = 0; i < FW_SERVE_STREAMS; i++)
        if (server->stream[i].request && now - server->stream[i].last_ms > KEEP_ALIVE_MS)
            append(&server->stream[i], ": still here\n\n", 14);
}
