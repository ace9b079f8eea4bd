/* SPDX-License-Identifier: GPL-3.0-or-later */
/* inotify on the directory, because editors put a new file in place of the old one; and a look
   every second, because network file systems tell nobody. */
#include "serve/watch.h"
#include "base/json.h"
#include "base/hash.h"
#include "base/output.h"
#include "serve/events.h"
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LOOK_MS = 1000 };

struct fw_serve_file_watch {
    const char *path, *directory, *name;
    int fd;
    int64_t looked_ms;
    bool changed;
    char version[65]; /* of what was seen last; "": it could not be read */
};

static fw_status resolve(fw_arena *arena, fw_serve_file_watch *w, const char *path,
                         fw_diags *diags) {
    char *whole = realpath(path, NULL); /* saving must not replace a link by a file */
    if (!whole) {
        fw_diag_error(diags, 220, (fw_place){.file = path}, "cannot be read: %s", strerror(errno));
        return FW_IO;
    }
    w->path = fw_arena_strdup(arena, whole);
    free(whole);
    FW_NEED(w->path);
    const char *slash = strrchr(w->path, '/');
    w->name = slash + 1;
    FW_NEED(w->directory = fw_arena_strndup(arena, w->path, (size_t)(slash - w->path) + 1));
    return FW_OK;
}

/* text and version of the file as it is now, in `arena` */
static fw_status look(fw_arena *arena, const fw_serve_file_watch *w, fw_diags *diags, char **text,
                      size_t *n, char version[65]) {
    version[0] = '\0';
    FW_TRY(fw_input_read(arena, w->path, FW_SERVE_MOST_BODY, diags, text, n));
    fw_sha256(*text, *n, version);
    return FW_OK;
}

fw_status fw_serve_file_watch_open(fw_arena *arena, const char *path, fw_diags *diags,
                                   fw_serve_file_watch **watch) {
    *watch = NULL;
    if (!path) return FW_OK;
    fw_serve_file_watch *w = fw_arena_one(arena, fw_serve_file_watch);
    FW_NEED(w);
    *w = (fw_serve_file_watch){.fd = -1};
    FW_TRY(resolve(arena, w, path, diags));
    fw_output_remove_leftovers(arena, w->path); /* of a server that was killed while it saved */
    fw_arena *scratch = fw_arena_new(0);
    FW_NEED(scratch);
    char *text;
    size_t n;
    fw_diags here = fw_diags_new(arena);
    fw_status status = look(scratch, w, &here, &text, &n, w->version);
    fw_arena_free(scratch);
    if (status != FW_OK) {
        fw_diag_error(diags, 220, (fw_place){.file = path},
                      "cannot be read, or is larger than 1 MiB");
        return status;
    }
    w->fd = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (w->fd >= 0)
        inotify_add_watch(w->fd, w->directory,
                          IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_ONLYDIR);
    *watch = w;
    return FW_OK;
}

void fw_serve_file_watch_close(fw_serve_file_watch *w) {
    if (w && w->fd >= 0) close(w->fd);
}

const char *fw_serve_file_watch_version(const fw_serve_file_watch *w) {
    return w && w->version[0] ? w->version : NULL;
}

const char *fw_serve_file_watch_name(const fw_serve_file_watch *w) {
    return w ? w->name : NULL;
}

int fw_serve_file_watch_fd(const fw_serve_file_watch *w) {
    return w ? w->fd : -1;
}

static bool told(fw_serve_file_watch *w) {
    union {
        struct inotify_event event;
        char room[4096];
    } buffer;
    bool ours = false;
    for (;;) {
        ssize_t got = w->fd >= 0 ? read(w->fd, &buffer, sizeof buffer) : -1;
        if (got <= 0) return ours;
        for (ssize_t at = 0; at < got;) {
            struct inotify_event event;
            memcpy(&event, buffer.room + at, sizeof event);
            const char *name = buffer.room + at + sizeof event;
            if (event.mask & IN_Q_OVERFLOW || (event.len && strcmp(name, w->name) == 0))
                ours = true;
            at += (ssize_t)(sizeof event + event.len);
        }
    }
}

static void tell(fw_serve_server *server, const char *version) {
    fw_serve_events_send(server, "file", "{\"version\": \"%s\"}", version);
}

void fw_serve_file_watch_run(fw_serve_server *server) {
    fw_serve_file_watch *w = server->watch;
    if (!w) return;
    int64_t now = fw_serve_now_ms();
    bool event = told(w);
    if (!event && now - w->looked_ms < LOOK_MS) return;
    w->looked_ms = now;
    fw_arena *arena = fw_arena_new(0);
    if (!arena) return;
    fw_diags diags = fw_diags_new(arena);
    char *text, version[65];
    size_t n;
    /* a file that is gone for the moment is waited for */
    if (look(arena, w, &diags, &text, &n, version) == FW_OK && strcmp(version, w->version) != 0) {
        memcpy(w->version, version, sizeof version);
        tell(server, version);
    }
    fw_arena_free(arena);
}

/* ---- what the page asks ---- */

static void reply_file(fw_serve_request *r, unsigned status, const fw_serve_file_watch *w,
                       const char *text, size_t n, const char *version) {
    fw_text body = fw_text_new(r->arena);
    fw_json json = fw_json_new(&body, FW_JSON_SPACED);
    if (!fw_json_is_text(text, n)) {
        fw_serve_reply_error(r, 422, NULL, "%s is not UTF-8 text", w->name);
        return;
    }
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.file/1");
    fw_json_text(&json, "name", w->name);
    fw_json_text(&json, "text", text);
    fw_json_text(&json, "version", version);
    fw_json_truth(&json, "writable", access(w->path, W_OK) == 0 && access(w->directory, W_OK) == 0);
    fw_json_end(&json);
    if (fw_json_finish(&json, "") == FW_OK)
        fw_serve_reply_json(r, status, body.data, body.length);
    else
        fw_serve_reply_error(r, 503, NULL, "out of memory");
}

static const char *first_message(const fw_diags *diags) {
    return diags->count ? diags->item[0].message : "out of memory";
}

void fw_serve_route_file(fw_serve_request *r) {
    fw_serve_file_watch *w = r->server->watch;
    if (!w) {
        fw_serve_reply_error(r, 404, NULL, "the server was started without a device file");
        return;
    }
    fw_diags diags = fw_diags_new(r->arena);
    char *text, version[65];
    size_t n;
    if (look(r->arena, w, &diags, &text, &n, version) != FW_OK)
        fw_serve_reply_error(r, 404, "FW-D220", "%s %s", w->name, first_message(&diags));
    else
        reply_file(r, 200, w, text, n, version);
}

/* whole or not at all, with the permissions that the file has */
static fw_status save(fw_serve_request *r, const fw_serve_file_watch *w, const char *text, size_t n,
                      fw_diags *diags) {
    struct stat info;
    mode_t mode = stat(w->path, &info) == 0 ? info.st_mode & 0777 : 0666;
    mode_t before = umask(~mode & 0777);
    fw_status status = fw_output_single(r->arena, w->path, text, n, diags);
    umask(before);
    return status;
}

static void save_if_unchanged(fw_serve_request *r, fw_serve_file_watch *w, const char *text,
                              size_t n, const char *version) {
    fw_diags diags = fw_diags_new(r->arena);
    char *now_text, now[65];
    size_t now_n;
    if (look(r->arena, w, &diags, &now_text, &now_n, now) == FW_OK && strcmp(now, version) != 0) {
        reply_file(r, 409, w, now_text, now_n, now);
        return;
    }
    diags = fw_diags_new(r->arena);
    if (save(r, w, text, n, &diags) != FW_OK) {
        fw_serve_reply_error(r, 500, "FW-D222", "%s", first_message(&diags));
        return;
    }
    fw_sha256(text, n, w->version);
    tell(r->server, w->version);
    reply_file(r, 200, w, text, n, w->version);
}

void fw_serve_route_save(fw_serve_request *r) {
    fw_serve_file_watch *w = r->server->watch;
    json_t *body = json_loadb(r->body, r->received, 0, NULL);
    const json_t *text = json_object_get(body, "text"), *version = json_object_get(body, "version");
    if (!w)
        fw_serve_reply_error(r, 404, NULL, "the server was started without a device file");
    else if (!json_is_string(text) || !json_is_string(version))
        fw_serve_reply_error(r, 400, NULL, "a file to be saved needs \"text\" and \"version\"");
    else
        save_if_unchanged(r, w, json_string_value(text), json_string_length(text),
                          json_string_value(version));
    json_decref(body);
}
