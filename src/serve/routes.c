/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be asked for: a function for each and its row in the table at the end.
   docs/reference/serve.md says what goes in and out. */
#include "serve/jobs.h"
#include "serve/server.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* ---- the files of the page, the exchange of the one-time token, what a session is told ---- */

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

static void get_page(fw_serve_request *r) {
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

static void get_session(fw_serve_request *r) {
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
    fw_json_whole(&json, "queued_jobs", FW_JOBS_QUEUED);
    fw_json_whole(&json, "preview_samples", 2001);
    fw_json_end(&json);
    fw_json_end(&json);
    fw_serve_reply_document(r, 200, &json, &text);
}

/* ---- what a worker answers ---- */

static void compute(fw_serve_request *r) {
    fw_serve_pool_ask(r->server->pool, r, r->route->compute);
}

/* ---- the file, and what changes ---- */

static void reply_file(fw_serve_request *r, unsigned status, const fw_serve_file_state *file) {
    const char *name = fw_serve_file_watch_name(r->server->watch);
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    if (!fw_json_is_text(file->text, file->n)) {
        fw_serve_reply_error(r, 422, NULL, "%s is not UTF-8 text", name);
        return;
    }
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.file/1");
    fw_json_text(&json, "name", name);
    fw_json_text(&json, "text", file->text);
    fw_json_text(&json, "version", file->version);
    fw_json_truth(&json, "writable", file->writable);
    fw_json_end(&json);
    fw_serve_reply_document(r, status, &json, &text);
}

static const char *first_message(const fw_diags *diags) {
    return diags->count ? diags->item[0].message : "out of memory";
}

static bool no_file(fw_serve_request *r) {
    if (r->server->watch) return false;
    fw_serve_reply_error(
        r, 404, NULL,
        "the server was started without a device file; start it as flexwright serve DEVICE.xml");
    return true;
}

static void get_file(fw_serve_request *r) {
    fw_diags diags = fw_diags_new(r->arena);
    fw_serve_file_state now;
    if (no_file(r)) return;
    if (fw_serve_file_watch_read(r->arena, r->server->watch, &diags, &now) != FW_OK)
        fw_serve_reply_error(r, 404, "FW-D220", "%s %s", fw_serve_file_watch_name(r->server->watch),
                             first_message(&diags));
    else
        reply_file(r, 200, &now);
}

static void save_file(fw_serve_request *r, const char *text, size_t n, const char *version) {
    fw_diags diags = fw_diags_new(r->arena);
    fw_serve_file_state now;
    fw_status status =
        fw_serve_file_watch_save(r->arena, r->server->watch, text, n, version, &diags, &now);
    if (status == FW_OK || status == FW_CANCELLED)
        reply_file(r, status == FW_OK ? 200 : 409, &now);
    else
        fw_serve_reply_error(r, 500, "FW-D222", "%s", first_message(&diags));
}

static void post_file(fw_serve_request *r) {
    json_t *body = json_loadb(r->body, r->received, 0, NULL);
    const json_t *text = json_object_get(body, "text"), *version = json_object_get(body, "version");
    if (no_file(r)) {
    } else if (!json_is_string(text) || !json_is_string(version))
        fw_serve_reply_error(r, 400, NULL, "a file to be saved needs \"text\" and \"version\"");
    else
        save_file(r, json_string_value(text), json_string_length(text), json_string_value(version));
    json_decref(body);
}

/* ---- what nobody saved ---- */

static const char *draft_path(fw_serve_request *r) {
    return fw_serve_draft_path(r->arena, fw_serve_file_watch_path(r->server->watch));
}

static void get_draft(fw_serve_request *r) {
    fw_serve_draft_get(r, draft_path(r));
}

static void post_draft(fw_serve_request *r) {
    fw_serve_draft_post(r, draft_path(r));
}

static void delete_draft(fw_serve_request *r) {
    fw_serve_draft_delete(r, draft_path(r));
}

static void get_beside(fw_serve_request *r) {
    const char *name = r->path + strlen("/api/beside");
    fw_serve_beside_get(r, fw_serve_file_watch_path(r->server->watch), *name ? name + 1 : NULL);
}

static void get_events(fw_serve_request *r) {
    if (fw_serve_events_open(&r->server->events, r))
        fw_serve_file_watch_tell(r->server->watch, r->stream);
    else
        fw_serve_reply_error(
            r, 429, NULL,
            "%d pages listen for changes already, the most that this server serves; close one",
            (int)FW_SERVE_STREAMS);
}

/* ---- POST /api/jobs ---- */

static void begin(fw_serve_request *r, const json_t *request, const json_t *text) {
    const char *name = fw_serve_file_watch_name(r->server->watch);
    const char *kind = json_string_value(json_object_get(request, "kind"));
    if (kind && strcmp(kind, "calibrate") == 0) name = "measured.csv"; /* no description */
    fw_serve_job_order order = {.request = request,
                                .file = name ? name : "device.xml",
                                .text = json_string_value(text),
                                .n = json_string_length(text)};
    const fw_serve_job *job;
    fw_status status = FW_OK;
    fw_serve_beside beside;
    if (json_object_get(json_object_get(request, "options"), "run") ||
        json_object_get(request, "results")) {
        status =
            fw_serve_beside_look(r->arena, fw_serve_file_watch_path(r->server->watch), &beside);
        order.beside = &beside;
    }
    if (status == FW_OK) status = fw_serve_jobs_add(r->server->jobs, &order, &job);
    if (status == FW_OK) {
        fw_text answer = fw_text_new(r->arena);
        fw_json json = fw_json_new(&answer, FW_JSON_SPACED);
        fw_json_object(&json, NULL);
        fw_json_whole(&json, "id", job->id);
        fw_json_end(&json);
        fw_serve_reply_document(r, 202, &json, &answer);
    } else if (status == FW_LIMIT)
        fw_serve_reply_error(
            r, 429, "FW-D287",
            "%d jobs wait already, the most that this server queues; cancel one, or wait",
            (int)FW_JOBS_QUEUED);
    else if (status == FW_INPUT)
        fw_serve_reply_error(r, 400, NULL, "%s", order.why);
    else
        fw_serve_reply_error(r, 503, "FW-D222",
                             "the job could not be prepared: no memory, or no room on the disk");
}

static void post_job(fw_serve_request *r) {
    json_t *request = json_loadb(r->body, r->received, 0, NULL);
    const json_t *text = json_object_get(request, "text");
    if (json_is_string(text))
        begin(r, request, text);
    else
        fw_serve_reply_error(r, 400, NULL, "a job needs \"kind\" and \"text\"");
    json_decref(request);
}

/* ---- GET and DELETE /api/jobs/ID... ---- */

/* the job of the path; *rest is what stands behind its number */
static fw_serve_job *job_of(fw_serve_request *r, const char **rest) {
    const char *at = r->path + strlen("/api/jobs/");
    size_t n = strspn(at, "0123456789");
    *rest = at + n;
    fw_serve_job *job = n >= 1 && n <= 9 && (!at[n] || at[n] == '/')
                            ? fw_serve_jobs_find(r->server->jobs, (unsigned)strtoul(at, NULL, 10))
                            : NULL;
    if (!job)
        fw_serve_reply_error(
            r, 404, NULL,
            "there is no job of this number; of finished jobs only the newest are kept");
    return job;
}

static void describe_files(fw_json *json, const fw_serve_job *job) {
    fw_json_list(json, "files");
    for (size_t i = 0; i < job->files; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "path", job->file[i].path);
        fw_json_whole(json, "bytes", (long long)job->file[i].bytes);
        fw_json_text(json, "type", job->file[i].type);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void describe(fw_serve_request *r, const fw_serve_job *job) {
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_whole(&json, "id", job->id);
    fw_json_text(&json, "kind", job->kind);
    fw_json_text(&json, "of", job->of);
    fw_json_text(&json, "state", fw_serve_job_state_name(job->state));
    if (job->exit_status >= 0)
        fw_json_whole(&json, "exit_status", job->exit_status);
    else
        fw_json_null(&json, "exit_status");
    fw_json_fixed(&json, "seconds", fw_serve_job_seconds(job), 3);
    fw_json_text(&json, "stage", job->stage);
    fw_json_list(&json, "messages");
    for (size_t i = 0; i < job->messages; i++)
        fw_json_text(&json, NULL, job->message[i]);
    if (job->why) fw_json_text(&json, NULL, job->why);
    fw_json_end(&json);
    describe_files(&json, job);
    fw_text_add(fw_json_value(&json, "result"), job->result ? job->result : "null");
    fw_json_end(&json);
    fw_serve_reply_document(r, 200, &json, &text);
}

/* What a job made is a document of its own: whatever stands in it can neither ask this server nor
   reach the page. */
static const char document_policy[] =
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; "
    "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

static void job_file(fw_serve_request *r, const fw_serve_job *job, const char *path) {
    for (size_t i = 0; i < job->files; i++) {
        const fw_serve_job_file *file = &job->file[i];
        if (strcmp(file->path, path) != 0) continue;
        int fd = fw_serve_job_open(job, file);
        if (fd < 0) break;
        r->reply.status = 200;
        r->reply.type = file->type;
        r->reply.file = true;
        r->reply.fd = fd;
        r->reply.n = file->bytes;
        r->reply.policy = document_policy;
        return;
    }
    fw_serve_reply_error(r, 404, NULL, "this job has no such file");
}

/* all that are kept, in short, by number: a page that comes anew sees what others have begun */
static void get_jobs(fw_serve_request *r) {
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    const fw_serve_job *job = NULL;
    fw_json_object(&json, NULL);
    fw_json_list(&json, "jobs");
    while ((job = fw_serve_jobs_after(r->server->jobs, job ? job->id : 0))) {
        fw_json_object(&json, NULL);
        fw_json_whole(&json, "id", job->id);
        fw_json_text(&json, "kind", job->kind);
        fw_json_text(&json, "study", job->study);
        fw_json_text(&json, "of", job->of);
        fw_json_truth(&json, "automatic", job->automatic);
        fw_json_text(&json, "state", fw_serve_job_state_name(job->state));
        fw_json_fixed(&json, "seconds", fw_serve_job_seconds(job), 3);
        fw_json_text(&json, "stage", job->stage);
        fw_json_end(&json);
    }
    fw_json_end(&json);
    fw_json_end(&json);
    fw_serve_reply_document(r, 200, &json, &text);
}

static void get_job(fw_serve_request *r) {
    const char *rest;
    fw_serve_job *job = job_of(r, &rest);
    if (!job) return;
    job->asked_ms = fw_serve_now_ms();
    if (!*rest)
        describe(r, job);
    else if (strncmp(rest, "/files/", 7) == 0)
        job_file(r, job, rest + 7);
    else if (strcmp(rest, "/archive") == 0)
        fw_serve_job_archive(job, r);
    else
        fw_serve_reply_error(r, 404, NULL,
                             "of a job there are /files/PATH and /archive, nothing else");
}

/* what is to be gone and is: another page has ended it, or newer ones took its place */
static bool deleted_before(fw_serve_request *r) {
    const char *at = r->path + strlen("/api/jobs/");
    const size_t n = strspn(at, "0123456789");
    if (n < 1 || n > 9 || at[n]) return false;
    const unsigned id = (unsigned)strtoul(at, NULL, 10);
    if (!fw_serve_jobs_gone(r->server->jobs, id)) return false;
    fw_text text = fw_text_new(r->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_whole(&json, "id", id);
    fw_json_text(&json, "state", "gone");
    fw_json_end(&json);
    fw_serve_reply_document(r, 200, &json, &text);
    return true;
}

static void delete_job(fw_serve_request *r) {
    const char *rest;
    if (deleted_before(r)) return;
    fw_serve_job *job = job_of(r, &rest);
    if (!job) return;
    if (*rest) {
        fw_serve_reply_error(r, 404, NULL,
                             "a job can be deleted as a whole only, not one of its files");
        return;
    }
    fw_text text = fw_text_new(r->arena);
    bool ended = job->state != FW_JOB_QUEUED && job->state != FW_JOB_RUNNING;
    if (!ended) fw_serve_job_cancel(r->server->jobs, job);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_whole(&json, "id", job->id);
    fw_json_text(&json, "state", fw_serve_job_state_name(job->state));
    fw_json_end(&json);
    fw_serve_reply_document(r, 200, &json, &text);
    if (ended) fw_serve_job_forget(r->server->jobs, job);
}

/* ---- the table ---- */

static const fw_serve_route table[] = {
    {.method = "GET", .path = "/api/session", .handle = get_session},
    {.method = "GET", .path = "/api/table", .handle = compute, .compute = FW_COMPUTE_TABLE},
    {.method = "GET", .path = "/api/file", .handle = get_file},
    {.method = "POST", .path = "/api/file", .handle = post_file},
    {.method = "GET", .path = "/api/draft", .handle = get_draft},
    {.method = "POST", .path = "/api/draft", .handle = post_draft},
    {.method = "DELETE", .path = "/api/draft", .handle = delete_draft},
    {.method = "GET", .path = "/api/beside", .handle = get_beside},
    {.method = "GET", .path = "/api/beside/*", .handle = get_beside},
    {.method = "GET", .path = "/api/events", .handle = get_events},
    {.method = "POST", .path = "/api/preview", .handle = compute, .compute = FW_COMPUTE_PREVIEW},
    {.method = "POST", .path = "/api/picture", .handle = compute, .compute = FW_COMPUTE_PICTURE},
    {.method = "POST", .path = "/api/pose", .handle = compute, .compute = FW_COMPUTE_POSE},
    {.method = "POST", .path = "/api/edit", .handle = compute, .compute = FW_COMPUTE_EDIT},
    {.method = "POST", .path = "/api/explore", .handle = compute, .compute = FW_COMPUTE_EXPLORE},
    {.method = "POST", .path = "/api/jobs", .handle = post_job},
    {.method = "GET", .path = "/api/jobs", .handle = get_jobs},
    {.method = "GET", .path = "/api/jobs/*", .handle = get_job},
    {.method = "DELETE", .path = "/api/jobs/*", .handle = delete_job},
};

/* the files of the page have one row for all: their table is made at build time */
static const fw_serve_route page = {.method = "GET", .path = "/", .handle = get_page};

static bool fits(const char *row, const char *path) {
    size_t n = strlen(row);
    return row[n - 1] == '*' ? strncmp(row, path, n - 1) == 0 && path[n - 1]
                             : strcmp(row, path) == 0;
}

const fw_serve_route *fw_serve_route_at(size_t i) {
    return i < sizeof table / sizeof table[0] ? &table[i] : NULL;
}

const fw_serve_route *fw_serve_route_find(const char *method, const char *path, bool *known_path) {
    *known_path = false;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        if (!fits(table[i].path, path)) continue;
        *known_path = true;
        if (strcmp(table[i].method, method) == 0) return &table[i];
    }
    for (size_t i = 0; i < fw_serve_page_count; i++)
        if (strcmp(fw_serve_page_files[i].path, path) == 0) {
            *known_path = true;
            return strcmp(method, page.method) == 0 ? &page : NULL;
        }
    return NULL;
}
