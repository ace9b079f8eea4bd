/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all answers have in common. */
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
