/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/draft.h"
#include "base/diag.h"
#include "base/output.h"
#include "base/text.h"
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_BYTES = 4 * 1024 * 1024 }; /* of a document: 1 MiB of text, escaped */

const char *fw_serve_draft_path(fw_arena *arena, const char *file) {
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    const char *key = file ? file : "";
    char name[65];
    fw_sha256(key, strlen(key), name);
    if (state && state[0] == '/')
        return fw_arena_printf(arena, "%s/flexwright/drafts/%s.json", state, name);
    if (home && home[0] == '/')
        return fw_arena_printf(arena, "%s/.local/state/flexwright/drafts/%s.json", home, name);
    return NULL;
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
