/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of the page, the exchange of the one-time token, and what a session is told. */
#include "serve/serve_page.h"
#include "base/json.h"
#include "serve/server.h"
#include "serve/watch.h"
#include <string.h>

/* To what a person opened the browser goes on by itself. When a file led here (the one of
   cli/cli_tools.c), the browser takes the whole chain for another page's and would keep the cookie
   back: then a page of ours leads on. */
void fw_serve_route_entry(fw_serve_request *r) {
    const fw_serve_guard *guard = &r->server->guard;
    static const char moved[] = "opening the page\n";
    static const char onward[] =
        "<!doctype html><meta http-equiv=\"refresh\" content=\"0;url=/\">\n"
        "<title>Flexwright</title><p><a href=\"/\">Open the page</a>\n";
    r->reply = (fw_serve_reply){
        .status = r->foreign ? 200 : 303,
        .type = r->foreign ? "text/html; charset=utf-8" : "text/plain; charset=utf-8",
        .data = r->foreign ? onward : moved,
        .n = r->foreign ? sizeof onward - 1 : sizeof moved - 1,
        .fd = -1,
        .location = r->foreign ? NULL : "/",
        .cookie = fw_arena_printf(r->arena, "%s=%s; Path=/; HttpOnly; SameSite=Strict",
                                  guard->cookie_name, guard->cookie),
    };
}

void fw_serve_route_page(fw_serve_request *r) {
    for (size_t i = 0; i < fw_serve_page_count; i++) {
        const fw_serve_page_file *file = &fw_serve_page_files[i];
        if (strcmp(file->path, r->path) != 0) continue;
        bool same = r->if_none_match && strcmp(r->if_none_match, file->etag) == 0;
        r->reply = (fw_serve_reply){
            .status = same ? 304 : 200,
            .type = file->type,
            .data = file->data,
            .n = same ? 0 : file->n,
            .fd = -1,
            .etag = file->etag,
            .may_cache = true,
        };
        return;
    }
}

void fw_serve_route_session(fw_serve_request *r) {
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    char *clean = fw_arena_strdup(r->arena, fw_serve_file_watch_name(r->server->watch));
    if (clean) fw_serve_reply_clean(clean);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.session/1");
    fw_json_text(&json, "version", FW_VERSION);
    fw_json_text(&json, "token", r->server->guard.header);
    fw_json_text(&json, "file", clean);
    fw_json_object(&json, "limits");
    fw_json_whole(&json, "body_bytes", FW_SERVE_MOST_BODY);
    fw_json_whole(&json, "connections", FW_SERVE_CONNECTIONS);
    fw_json_whole(&json, "streams", FW_SERVE_STREAMS);
    fw_json_whole(&json, "queued_jobs", FW_SERVE_QUEUED);
    fw_json_whole(&json, "preview_samples", 2001);
    fw_json_end(&json);
    fw_json_end(&json);
    if (fw_json_finish(&json, "\n") != FW_OK) text.failed = 1;
    fw_serve_reply_text(r, 200, &text);
}
