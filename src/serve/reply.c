/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replies, and streams of events: what goes out to a page. */
#include "serve/request.h"
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Nothing but the page's own files; pictures may be made on the spot. No script or style stands in
   the text of a page. */
static const char page_policy[] =
    "default-src 'self'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; object-src 'none'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

int64_t fw_serve_now_ms(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

void fw_serve_request_answer(fw_serve_request *r) {
    r->answered = true;
    if (!r->suspended) return;
    r->suspended = false;
    MHD_resume_connection(r->connection->mhd);
}

/* bytes of the UTF-8 sequence at `s`, 0 where none begins (RFC 3629: no long forms, no
   surrogates) */
static size_t sequence(const unsigned char *s) {
    unsigned char first = s[0];
    size_t n = first < 0x80                    ? 1
               : first >= 0xC2 && first < 0xE0 ? 2
               : first >= 0xE0 && first < 0xF0 ? 3
               : first >= 0xF0 && first < 0xF5 ? 4
                                               : 0;
    for (size_t i = 1; i < n; i++)
        if ((s[i] & 0xC0) != 0x80) return 0;
    if ((first == 0xE0 && s[1] < 0xA0) || (first == 0xED && s[1] >= 0xA0) ||
        (first == 0xF0 && s[1] < 0x90) || (first == 0xF4 && s[1] >= 0x90))
        return 0;
    return n;
}

void fw_serve_reply_clean(char *text) {
    for (char *at = text; *at;) {
        size_t n = sequence((const unsigned char *)at);
        if (n == 0) *at = '?';
        at += n ? n : 1;
    }
}

const char *fw_serve_reply_type(const char *path) {
    static const struct {
        const char *ending, *type;
    } known[] = {{".html", "text/html; charset=utf-8"},
                 {".svg", "image/svg+xml"},
                 {".png", "image/png"},
                 {".json", "application/json"},
                 {".csv", "text/csv; charset=utf-8"},
                 {".txt", "text/plain; charset=utf-8"},
                 {".ics", "text/calendar; charset=utf-8"},
                 {".xml", "application/xml"}};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof known[0]; i++)
        if (strcmp(dot, known[i].ending) == 0) return known[i].type;
    return "application/octet-stream";
}

void fw_serve_reply_json(fw_serve_request *r, unsigned status, const char *text, size_t n) {
    r->reply.status = status;
    r->reply.type = "application/json";
    r->reply.data = text;
    r->reply.n = n;
}

void fw_serve_reply_no_memory(fw_serve_request *r) {
    static const char text[] = "{\"error\": {\"message\": \"out of memory\", \"code\": null}}\n";
    fw_serve_reply_json(r, 503, text, sizeof text - 1);
}

void fw_serve_reply_document(fw_serve_request *r, unsigned status, fw_json *json,
                             const fw_text *text) {
    if (fw_json_finish(json, "\n") == FW_OK)
        fw_serve_reply_json(r, status, text->data, text->length);
    else
        fw_serve_reply_no_memory(r);
}

void fw_serve_reply_error(fw_serve_request *r, unsigned status, const char *code,
                          const char *format, ...) {
    char message[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    fw_serve_reply_clean(message);
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_object(&json, "error");
    fw_json_text(&json, "message", message);
    fw_json_text(&json, "code", code);
    fw_json_end(&json);
    fw_json_end(&json);
    fw_serve_reply_document(r, status, &json, &text);
}

void fw_serve_reply_refusal(fw_serve_request *r, unsigned status, const char *why) {
    const char *text = fw_arena_printf(
        r->arena,
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Flexwright</title>"
        "<meta name=\"viewport\" content=\"width=device-width\"><meta name=\"color-scheme\" "
        "content=\"light dark\">\n<h1>Not opened</h1>\n<p>%s.</p>\n<p>If the page is open in this "
        "browser already, <a href=\"/\">go on there</a>: what was not saved is kept. Otherwise end "
        "flexwright serve with Ctrl-C, start it again and open the address that it prints.</p>\n",
        why);
    if (!text) {
        fw_serve_reply_no_memory(r);
        return;
    }
    r->reply.status = status;
    r->reply.type = "text/html; charset=utf-8";
    r->reply.data = text;
    r->reply.n = strlen(text);
}

static struct MHD_Response *response_of(fw_serve_request *r) {
    fw_serve_reply *reply = &r->reply;
    if (reply->made) return reply->made;
    if (!reply->file) /* the arena lives until the request is completed, which is after sending */
        return MHD_create_response_from_buffer(reply->n, (void *)(uintptr_t)reply->data,
                                               MHD_RESPMEM_PERSISTENT);
    struct MHD_Response *response = MHD_create_response_from_fd64(reply->n, reply->fd);
    if (!response) close(reply->fd);
    reply->fd = -1; /* the response closes it */
    return response;
}

static void header(struct MHD_Response *response, const char *name, const char *value) {
    if (value) MHD_add_response_header(response, name, value);
}

enum MHD_Result fw_serve_reply_queue(fw_serve_request *r, struct MHD_Connection *mhd) {
    fw_serve_reply *reply = &r->reply;
    struct MHD_Response *response = response_of(r);
    if (!response) return MHD_NO;
    header(response, "Content-Type", reply->type);
    header(response, "Content-Security-Policy", reply->policy ? reply->policy : page_policy);
    header(response, "X-Content-Type-Options", "nosniff");
    header(response, "Referrer-Policy", "no-referrer");
    header(response, "Cross-Origin-Opener-Policy", "same-origin");
    header(response, "Cross-Origin-Resource-Policy", "same-origin");
    header(response, "Cache-Control", reply->may_cache ? "no-cache" : "no-store");
    header(response, "ETag", reply->etag);
    header(response, "Location", reply->location);
    header(response, "Set-Cookie", reply->cookie);
    header(response, "Content-Disposition", reply->disposition);
    if (reply->close) header(response, "Connection", "close");
    enum MHD_Result queued = MHD_queue_response(mhd, reply->status, response);
    MHD_destroy_response(response);
    return queued;
}

/* ---- server-sent events ---- */

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
