/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/request.h"
#include <stdio.h>
#include <string.h>

enum { WAITING_BYTES = 64 * 1024, KEEP_ALIVE_MS = 10000 };

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

bool fw_serve_events_open(fw_serve_events *events, fw_serve_request *r) {
    static const char hello[] = ": flexwright\nretry: 1000\n\n";
    fw_serve_stream *s = NULL;
    for (int i = 0; i < FW_SERVE_STREAMS && !s; i++)
        if (!events->stream[i].request) s = &events->stream[i];
    char *room = s ? fw_arena_array(r->arena, char, WAITING_BYTES) : NULL;
    if (!room) return false;
    *s = (fw_serve_stream){.request = r, .waiting = room, .last_ms = fw_serve_now_ms()};
    r->reply.made = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 4096, take, s, NULL);
    if (!r->reply.made) {
        s->request = NULL;
        return false;
    }
    r->stream = s;
    r->reply.status = 200;
    r->reply.type = "text/event-stream";
    append(s, hello, sizeof hello - 1);
    return true;
}

void fw_serve_stream_send(fw_serve_stream *s, const char *event, const char *json) {
    char text[2048]; /* ours are all short */
    int n = snprintf(text, sizeof text, "event: %s\ndata: %s\n\n", event, json);
    if (n > 0 && (size_t)n < sizeof text) append(s, text, (size_t)n);
}

void fw_serve_events_send(fw_serve_events *events, const char *event, const char *json) {
    for (int i = 0; i < FW_SERVE_STREAMS; i++)
        if (events->stream[i].request) fw_serve_stream_send(&events->stream[i], event, json);
}

void fw_serve_events_run(fw_serve_events *events) {
    static const char still_here[] = ": still here\n\n";
    int64_t now = fw_serve_now_ms();
    for (int i = 0; i < FW_SERVE_STREAMS; i++)
        if (events->stream[i].request && now - events->stream[i].last_ms > KEEP_ALIVE_MS)
            append(&events->stream[i], still_here, sizeof still_here - 1);
}
