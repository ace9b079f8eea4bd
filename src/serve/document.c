/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text that a page edits: its file, watched and saved, the draft of it that nobody saved, and what the
   program has written beside it. */
#include "base/diag.h"
#include "base/output.h"
#include "base/text.h"
#include "recipe/asrun.h"
#include "serve/jobs.h"
#include "study/study.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- the file ----
   inotify on the directory, because editors put a new file in place of the old one; and a look every
   second, because network file systems tell nobody. */

enum { LOOK_MS = 1000 };

struct fw_serve_file_watch {
    const char *path, *directory, *name;
    size_t most_bytes;
    fw_serve_events *events;
    int fd;
    int64_t looked_ms, lost_ms; /* lost: since when it cannot be read; 0: it can */
    char version[65];           /* of what was seen last; "": it could not be read */
    char why[200];              /* then */
};

static fw_status resolve(fw_arena *arena, fw_serve_file_watch *w, const char *path,
                         fw_diags *diags) {
    char *whole = realpath(path, NULL); /* saving must not replace a link by a file */
    if (!whole) {
        fw_diag_error(fw_diags_because(diags, errno), 220, (fw_place){.file = path},
                      "cannot be read: %s", strerror(errno));
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

/* opening a pipe would wait for its other end, and the whole server with it */
static int open_regular(const char *path, fw_diags *diags) {
    int fd = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat info;
    if (fd < 0)
        fw_diag_error(fw_diags_because(diags, errno), 220, (fw_place){.file = path},
                      "cannot be read: %s", strerror(errno));
    else if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        fw_diag_error(diags, 220, (fw_place){.file = path},
                      "cannot be read: it is no ordinary file");
        close(fd);
        fd = -1;
    }
    return fd;
}

fw_status fw_serve_file_watch_read(fw_arena *arena, const fw_serve_file_watch *w, fw_diags *diags,
                                   fw_serve_file_state *now) {
    *now = (fw_serve_file_state){.writable =
                                     access(w->path, W_OK) == 0 && access(w->directory, W_OK) == 0};
    char *text;
    int fd = open_regular(w->path, diags);
    if (fd < 0) return FW_IO;
    const char *opened = fw_arena_printf(arena, "/proc/self/fd/%d", fd);
    fw_status status =
        opened ? fw_input_read(arena, opened, w->most_bytes, diags, &text, &now->n) : FW_NOMEM;
    close(fd);
    FW_TRY(status);
    now->text = text;
    fw_sha256(now->text, now->n, now->version);
    return FW_OK;
}

fw_status fw_serve_file_watch_open(fw_arena *arena, const char *path, size_t most_bytes,
                                   fw_serve_events *events, fw_diags *diags,
                                   fw_serve_file_watch **watch) {
    *watch = NULL;
    if (!path) return FW_OK;
    fw_serve_file_watch *w = fw_arena_one(arena, fw_serve_file_watch);
    FW_NEED(w);
    *w = (fw_serve_file_watch){.fd = -1, .most_bytes = most_bytes, .events = events};
    FW_TRY(resolve(arena, w, path, diags));
    fw_output_remove_leftovers(arena, w->path); /* of a server that was killed while it saved */
    fw_arena *scratch = fw_arena_new(0);
    FW_NEED(scratch);
    fw_serve_file_state now;
    fw_diags here = fw_diags_new(arena);
    fw_status status = fw_serve_file_watch_read(scratch, w, &here, &now);
    memcpy(w->version, now.version, sizeof w->version);
    fw_arena_free(scratch);
    if (status != FW_OK) {
        fw_diag_error(diags, 220, (fw_place){.file = path},
                      "cannot be read, or is larger than %zu KiB, the most that the page takes",
                      most_bytes >> 10);
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

const char *fw_serve_file_watch_path(const fw_serve_file_watch *w) {
    return w ? w->path : NULL;
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

/* {"version": "..."}, or {"version": null, "why": "..."} */
static fw_status version_json(const fw_serve_file_watch *w, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "version", w->version[0] ? w->version : NULL);
    if (!w->version[0]) fw_json_text(&json, "why", w->why);
    fw_json_end(&json);
    return fw_json_finish(&json, "");
}

static void tell_all(fw_arena *arena, const fw_serve_file_watch *w) {
    fw_text text = fw_text_new(arena);
    if (version_json(w, &text) == FW_OK) fw_serve_events_send(w->events, "file", text.data);
}

/* a file that is gone for the moment is waited for: an editor may be putting a new one in place */
static void lost(fw_arena *arena, fw_serve_file_watch *w, int64_t now_ms, const char *why) {
    if (!w->lost_ms) w->lost_ms = now_ms;
    if (!w->version[0] || now_ms - w->lost_ms < LOOK_MS) return;
    w->version[0] = '\0';
    snprintf(w->why, sizeof w->why, "%s", why);
    fw_serve_reply_clean(w->why);
    tell_all(arena, w);
}

void fw_serve_file_watch_run(fw_serve_file_watch *w) {
    if (!w) return;
    int64_t now_ms = fw_serve_now_ms();
    bool event = told(w);
    if (!event && now_ms - w->looked_ms < LOOK_MS) return;
    w->looked_ms = now_ms;
    fw_arena *arena = fw_arena_new(0);
    if (!arena) return;
    fw_diags diags = fw_diags_new(arena);
    fw_serve_file_state now;
    if (fw_serve_file_watch_read(arena, w, &diags, &now) != FW_OK)
        lost(arena, w, now_ms, diags.count ? diags.item[0].message : "out of memory");
    else {
        w->lost_ms = 0;
        if (strcmp(now.version, w->version) != 0) {
            memcpy(w->version, now.version, sizeof w->version);
            tell_all(arena, w);
        }
    }
    fw_arena_free(arena);
}

void fw_serve_file_watch_tell(const fw_serve_file_watch *w, fw_serve_stream *stream) {
    if (!w) return;
    fw_text text = fw_text_new(stream->request->arena);
    if (version_json(w, &text) == FW_OK) fw_serve_stream_send(stream, "file", text.data);
}

fw_status fw_serve_file_watch_save(fw_arena *arena, fw_serve_file_watch *w, const char *text,
                                   size_t n, const char *version, fw_diags *diags,
                                   fw_serve_file_state *now) {
    fw_diags reading = fw_diags_new(arena);
    struct stat info;
    fw_status read = fw_serve_file_watch_read(arena, w, &reading, now);
    if (read == FW_OK && strcmp(now->version, version) != 0) return FW_CANCELLED;
    if (read != FW_OK && lstat(w->path, &info) == 0) {
        fw_diag_error(
            diags, 222, (fw_place){.file = w->path},
            "%s is not what it was, and saving would replace it: it %s. Move it away first",
            w->name, reading.count ? reading.item[0].message : "cannot be read");
        return FW_IO;
    }
    mode_t mode = stat(w->path, &info) == 0 ? info.st_mode & 0777 : 0666;
    mode_t before = umask(~mode & 0777);
    fw_status status = fw_output_single(arena, w->path, text, n, diags);
    umask(before);
    FW_TRY(status);
    now->text = text;
    now->n = n;
    fw_sha256(text, n, now->version);
    memcpy(w->version, now->version, sizeof w->version);
    tell_all(arena, w);
    return FW_OK;
}

/* ---- the draft ---- */

enum { MOST_BYTES = 4 * 1024 * 1024 }; /* of a document: 1 MiB of text, escaped */

/* below the user's state; NULL: neither variable names a directory */
static const char *state_path(fw_arena *arena, const char *rest) {
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    if (state && state[0] == '/') return fw_arena_printf(arena, "%s/flexwright/%s", state, rest);
    if (home && home[0] == '/')
        return fw_arena_printf(arena, "%s/.local/state/flexwright/%s", home, rest);
    return NULL;
}

const char *fw_serve_draft_path(fw_arena *arena, const char *file) {
    const char *key = file ? file : "";
    char name[65];
    fw_sha256(key, strlen(key), name);
    const char *rest = fw_arena_printf(arena, "drafts/%s.json", name);
    return rest ? state_path(arena, rest) : NULL;
}

/* its directories, for nobody but the user */
static bool make_directories(fw_arena *arena, const char *path) {
    char *at = fw_arena_strdup(arena, path);
    for (char *slash = at ? strchr(at + 1, '/') : NULL; slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(at, 0700) != 0 && errno != EEXIST) return false;
        *slash = '/';
    }
    return at != NULL;
}

/* what was kept, or NULL */
static json_t *kept(fw_arena *arena, const char *path) {
    char *data;
    size_t n;
    struct stat info;
    fw_diags diags = fw_diags_new(arena);
    if (!path || lstat(path, &info) != 0 || !S_ISREG(info.st_mode)) return NULL;
    if (fw_input_read(arena, path, MOST_BYTES, &diags, &data, &n) != FW_OK) return NULL;
    json_t *draft = json_loadb(data, n, 0, NULL);
    if (json_is_string(json_object_get(draft, "text")) &&
        json_is_string(json_object_get(draft, "version")))
        return draft;
    json_decref(draft);
    return NULL;
}

static void text_or_null(fw_json *json, const json_t *draft, const char *key) {
    fw_json_text(json, key, json_string_value(json_object_get(draft, key)));
}

void fw_serve_draft_get(fw_serve_request *r, const char *path) {
    json_t *draft = kept(r->arena, path);
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.draft/1");
    text_or_null(&json, draft, "text");
    text_or_null(&json, draft, "version");
    fw_json_end(&json);
    fw_serve_reply_document(r, 200, &json, &text);
    json_decref(draft);
}

static void keep(fw_serve_request *r, const char *path, const json_t *draft) {
    fw_diags diags = fw_diags_new(r->arena);
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    text_or_null(&json, draft, "text");
    text_or_null(&json, draft, "version");
    fw_json_end(&json);
    fw_status status = fw_json_finish(&json, "\n");
    mode_t before = umask(077);
    if (status == FW_OK && make_directories(r->arena, path))
        status = fw_output_single(r->arena, path, text.data, text.length, &diags);
    else
        status = FW_IO;
    umask(before);
    static const char done[] = "{\"kept\": true}\n";
    if (status == FW_OK)
        fw_serve_reply_json(r, 200, done, sizeof done - 1);
    else
        fw_serve_reply_error(r, 503, "FW-D222", "the draft could not be kept in %s", path);
}

void fw_serve_draft_post(fw_serve_request *r, const char *path) {
    json_t *draft = json_loadb(r->body, r->received, 0, NULL);
    const json_t *text = json_object_get(draft, "text"),
                 *version = json_object_get(draft, "version");
    if (!path)
        fw_serve_reply_error(
            r, 503, NULL,
            "there is no place for drafts: neither XDG_STATE_HOME nor HOME names a "
            "directory");
    else if (!json_is_string(text) || !json_is_string(version) || json_object_size(draft) != 2)
        fw_serve_reply_error(r, 400, NULL,
                             "a draft is \"text\" and \"version\", that of the file it began from");
    else
        keep(r, path, draft);
    json_decref(draft);
}

void fw_serve_draft_delete(fw_serve_request *r, const char *path) {
    static const char done[] = "{\"kept\": false}\n";
    if (path) unlink(path);
    fw_serve_reply_json(r, 200, done, sizeof done - 1);
}

/* ---- what lies beside the file ---- */

enum {
    MOST_DEPTH = 3,     /* out/NAME/study.sqlite, and one more */
    MOST_LOOKED = 2000, /* entries of directories: the file may lie in one with very many */
    MOST_FOUND = 60,
    LOG_BEGINS = 64,           /* bytes that tell a log */
    MOST_SAMPLES = 1024 << 20, /* bytes of a study's samples */
    MOST_LOG = 16 << 20
};

typedef struct search {
    fw_arena *arena;
    fw_serve_beside *found;
    int looked;
} search;

static bool ends_in(const char *name, const char *ending) {
    size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0;
}

/* a regular file at `name` of the open directory; -1: it is none, or cannot be read */
static int open_in(int directory, const char *name) {
    int fd = openat(directory, name, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat info;
    if (fd >= 0 && (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode))) {
        close(fd);
        fd = -1;
    }
    return fd;
}

static bool begins_as_log(int directory, const char *name) {
    char begin[LOG_BEGINS];
    int fd = open_in(directory, name);
    ssize_t n = fd >= 0 ? read(fd, begin, sizeof begin) : -1;
    if (fd >= 0) close(fd);
    return n > 0 && fw_recipe_asrun_is_log(begin, (size_t)n);
}

static fw_status add_name(search *s, const char ***list, size_t *n, const char *name) {
    if (*n == MOST_FOUND) return FW_OK;
    FW_NEED(*list = fw_arena_grow(s->arena, *list, *n, *n + 1, sizeof **list));
    FW_NEED((*list)[(*n)++] = fw_arena_strdup(s->arena, name));
    return FW_OK;
}

static fw_status look_in(search *s, int parent, const char *name, const char *below, int depth);

static fw_status look_at(search *s, int fd, const char *name, const char *below, int depth) {
    fw_serve_beside *found = s->found;
    struct stat info;
    if (fstatat(fd, name, &info, AT_SYMLINK_NOFOLLOW) != 0) return FW_OK;
    if (depth == 0 && !S_ISDIR(info.st_mode) && ends_in(name, ".log") && begins_as_log(fd, name))
        return add_name(s, &found->log, &found->nlog, name);
    if (*below && S_ISREG(info.st_mode) && strcmp(name, "study.sqlite") == 0) {
        const char *directory = fw_arena_strndup(s->arena, below, strlen(below) - 1);
        FW_NEED(directory);
        return add_name(s, &found->study, &found->nstudy, directory);
    }
    if (!S_ISDIR(info.st_mode) || depth == MOST_DEPTH) return FW_OK;
    const char *deeper = fw_arena_printf(s->arena, "%s%s/", below, name);
    FW_NEED(deeper);
    return look_in(s, fd, name, deeper, depth + 1);
}

static fw_status look_in(search *s, int parent, const char *name, const char *below, int depth) {
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *dir = fd >= 0 ? fdopendir(fd) : NULL;
    if (!dir) {
        if (fd >= 0) close(fd);
        return FW_OK;
    }
    fw_status status = FW_OK;
    for (struct dirent *e; status == FW_OK && s->looked < MOST_LOOKED && (e = readdir(dir));) {
        if (e->d_name[0] == '.') continue;
        s->looked++;
        status = look_at(s, fd, e->d_name, below, depth);
    }
    closedir(dir);
    return status;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

fw_status fw_serve_beside_look(fw_arena *arena, const char *file, fw_serve_beside *beside) {
    search s = {.arena = arena, .found = beside};
    *beside = (fw_serve_beside){0};
    if (file)
        FW_NEED(beside->directory =
                    fw_arena_strndup(arena, file, (size_t)(strrchr(file, '/') - file) + 1));
    else {
        beside->directory = state_path(arena, "logs/");
        if (beside->directory && !make_directories(arena, beside->directory))
            beside->directory = NULL;
        if (!beside->directory) return FW_OK;
    }
    FW_TRY(look_in(&s, AT_FDCWD, beside->directory, "", 0));
    if (beside->nlog) qsort(beside->log, beside->nlog, sizeof *beside->log, by_name);
    if (beside->nstudy) qsort(beside->study, beside->nstudy, sizeof *beside->study, by_name);
    return FW_OK;
}

static bool is_among(const char *const *list, size_t n, const char *name) {
    for (size_t i = 0; i < n; i++)
        if (strcmp(list[i], name) == 0) return true;
    return false;
}

bool fw_serve_beside_is_log(const fw_serve_beside *beside, const char *name) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    size_t stem = strspn(name, plain);
    if (is_among(beside->log, beside->nlog, name)) return true;
    if (stem == 0 || stem > 60 || name[0] == '-' || strcmp(name + stem, ".log") != 0) return false;
    const char *path =
        beside->directory; /* what is there and is no log is nobody's to write into */
    int fd = path ? open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    struct stat info;
    bool is_new = fd >= 0 && fstatat(fd, name, &info, AT_SYMLINK_NOFOLLOW) != 0 && errno == ENOENT;
    if (fd >= 0) close(fd);
    return is_new;
}

static bool copy_file(int from, int to, const char *name) {
    int in = open_in(from, name);
    if (in < 0) return errno == ENOENT;
    struct stat info;
    int out = openat(to, name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    bool good = out >= 0 && fstat(in, &info) == 0 && info.st_size <= MOST_SAMPLES;
    char buffer[1 << 16];
    for (ssize_t n; good && (n = read(in, buffer, sizeof buffer)) != 0;)
        good = n > 0 && write(out, buffer, (size_t)n) == n;
    close(in);
    return (out < 0 || close(out) == 0) && good;
}

/* SQLite keeps what was written last beside the file until it is closed; whoever writes has the directory locked */
static const char *copy_locked(int from, int to) {
    static const char *const part[] = {"study.sqlite", "study.sqlite-wal"};
    if (flock(from, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return "a study is running there: wait for its end, or stop it with Ctrl-C in its terminal";
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++)
        if (!copy_file(from, to, part[i]))
            return "its samples cannot be read, or there is no room on the disk for a copy";
    return NULL;
}

const char *fw_serve_beside_copy(const fw_serve_beside *beside, const char *study, int to) {
    if (!is_among(beside->study, beside->nstudy, study))
        return "\"results\" has to name a directory of samples that lies beside the description";
    const char *why = "the directory of its samples cannot be opened";
    int base = open(beside->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int from = base >= 0 ? openat(base, study, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    int out = from >= 0 && mkdirat(to, "out", 0700) == 0
                  ? openat(to, "out", O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                  : -1;
    if (out >= 0) why = copy_locked(from, out);
    for (int i = 0; i < 3; i++) {
        int fd = (int[]){out, from, base}[i];
        if (fd >= 0) close(fd);
    }
    return why;
}

/* the file itself, to be kept */
static void send_log(fw_serve_request *r, const fw_serve_beside *beside, const char *name) {
    int base = open(beside->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int fd = base >= 0 ? open_in(base, name) : -1;
    if (base >= 0) close(base);
    struct stat info;
    if (fd < 0 || fstat(fd, &info) != 0 || info.st_size > MOST_LOG) {
        if (fd >= 0) close(fd);
        fw_serve_reply_error(r, 500, "FW-D222", "the log cannot be read, or is too large");
        return;
    }
    r->reply.status = 200;
    r->reply.type = "text/plain; charset=utf-8";
    r->reply.file = true;
    r->reply.fd = fd;
    r->reply.n = (size_t)info.st_size;
    r->reply.disposition = "attachment";
}

static void names(fw_json *json, const char *key, const char *const *list, size_t n) {
    fw_json_list(json, key);
    for (size_t i = 0; i < n; i++)
        fw_json_text(json, NULL, list[i]);
    fw_json_end(json);
}

/* Whose samples these are, as their store says. Nothing is known where a study runs there, or of what is no store. */
static fw_status owner(fw_serve_request *r, const fw_serve_beside *beside, const char *study,
                       fw_json *json) {
    static const char *const key[] = {"study", "kind", "device"};
    const char *path = fw_arena_printf(r->arena, "%s%s", beside->directory, study);
    fw_diags quiet = fw_diags_new(r->arena);
    fw_status status = FW_OK;
    FW_NEED(path);
    const int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool rests = fd >= 0 && flock(fd, LOCK_SH | LOCK_NB) == 0;
    fw_json_object(json, NULL);
    fw_json_text(json, "directory", study);
    for (size_t i = 0; i < sizeof key / sizeof key[0] && status != FW_NOMEM; i++) {
        const char *value = NULL;
        if (rests) status = fw_study_store_said(r->arena, &quiet, path, key[i], &value);
        fw_json_text(json, key[i], status == FW_OK ? value : NULL);
    }
    fw_json_end(json);
    if (fd >= 0) close(fd);
    return status == FW_NOMEM ? FW_NOMEM : FW_OK;
}

static fw_status owners(fw_serve_request *r, const fw_serve_beside *beside, fw_json *json) {
    fw_json_list(json, "results");
    for (size_t i = 0; i < beside->nstudy; i++)
        FW_TRY(owner(r, beside, beside->study[i], json));
    fw_json_end(json);
    return FW_OK;
}

void fw_serve_beside_get(fw_serve_request *r, const char *file, const char *name) {
    fw_serve_beside beside;
    if (fw_serve_beside_look(r->arena, file, &beside) != FW_OK)
        fw_serve_reply_no_memory(r);
    else if (name && is_among(beside.log, beside.nlog, name))
        send_log(r, &beside, name);
    else if (name)
        fw_serve_reply_error(r, 404, NULL, "there is no log of this name beside the description");
    else {
        fw_text text = fw_text_new(r->arena);
        fw_json json = fw_json_new(&text, FW_JSON_SPACED);
        fw_json_object(&json, NULL);
        fw_json_text(&json, "schema", "flexwright.beside/1");
        fw_json_text(&json, "directory", beside.directory);
        names(&json, "logs", beside.log, beside.nlog);
        names(&json, "studies", beside.study, beside.nstudy);
        const fw_status status = owners(r, &beside, &json);
        fw_json_end(&json);
        if (status == FW_OK)
            fw_serve_reply_document(r, 200, &json, &text);
        else
            fw_serve_reply_no_memory(r);
    }
}
