/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jobs as they are asked for by HTTP. */
#include "serve/jobs_table.h"
#include "base/json.h"
#include "serve/watch.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- POST /api/jobs ---- */

/* a free slot; of those that are finished the oldest makes room. NULL: too many wait */
static fw_serve_job *slot(fw_serve_server *server) {
    fw_serve_jobs *jobs = server->jobs;
    fw_serve_job *oldest = NULL, *empty = NULL;
    int waiting = 0;
    for (int i = 0; i < FW_JOBS_KEPT; i++) {
        fw_serve_job *job = &jobs->job[i];
        if (!job->id)
            empty = job;
        else if (job->state == FW_JOB_QUEUED)
            waiting++;
        else if (job->state != FW_JOB_RUNNING && (!oldest || job->id < oldest->id))
            oldest = job;
    }
    if (waiting >= FW_SERVE_QUEUED) return NULL;
    if (empty) return empty;
    fw_serve_job_forget(server, oldest); /* 16 slots, 5 at most wait or run */
    return oldest;
}

static void begin(fw_serve_request *r, const json_t *request, const char *text, size_t n) {
    fw_serve_server *server = r->server;
    fw_serve_job *job = slot(server);
    if (!job) {
        fw_serve_reply_error(r, 429, "FW-D287", "%d jobs wait already; cancel one, or wait",
                             (int)FW_SERVE_QUEUED);
        return;
    }
    const char *file = fw_serve_file_watch_name(server->watch), *why = NULL;
    *job = (fw_serve_job){.id = server->jobs->last_id + 1, .fd = -1, .err = -1, .exit_status = -1};
    job->arena = fw_arena_new(0);
    job->name = job->arena ? fw_arena_strdup(job->arena, file ? file : "device.xml") : NULL;
    fw_status status = job->name ? fw_serve_job_command(job->arena, request, job->name, &job->kind,
                                                        &job->argv, &why)
                                 : FW_NOMEM;
    if (status == FW_OK) {
        server->jobs->last_id++;
        status = fw_serve_job_prepare(server, job, text, n);
    }
    if (status == FW_OK) {
        fw_text answer = fw_text_new(r->arena);
        fw_json json = fw_json_new(&answer, FW_JSON_SPACED);
        fw_json_object(&json, NULL);
        fw_json_whole(&json, "id", job->id);
        fw_json_end(&json);
        if (fw_json_finish(&json, "\n") != FW_OK) answer.failed = 1;
        fw_serve_reply_text(r, 202, &answer);
        return;
    }
    if (status == FW_INPUT)
        fw_serve_reply_error(r, 400, NULL, "%s", why);
    else
        fw_serve_reply_error(r, 503, "FW-D222",
                             "the job could not be prepared: no memory, or no room on the disk");
    fw_serve_job_forget(server, job);
}

void fw_serve_route_job_new(fw_serve_request *r) {
    json_t *request = json_loadb(r->body, r->received, 0, NULL);
    const json_t *text = json_object_get(request, "text");
    if (json_is_string(text))
        begin(r, request, json_string_value(text), json_string_length(text));
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
    if (!job) fw_serve_reply_error(r, 404, NULL, "there is no such job");
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
    if (fw_json_finish(&json, "\n") != FW_OK) text.failed = 1;
    fw_serve_reply_text(r, 200, &text);
}

/* What a job made is a document of its own: whatever stands in it can neither ask this server nor
   reach the page. */
static const char document_policy[] =
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; "
    "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

static void reply_file(fw_serve_request *r, const fw_serve_job *job, const char *path) {
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

static void archive(fw_serve_request *r, fw_serve_job *job) {
    if (job->packed)
        fw_serve_job_reply_archive(r, job);
    else if (job->state != FW_JOB_DONE || job->files == 0)
        fw_serve_reply_error(r, 404, NULL, "this job has no files");
    else if (fw_serve_job_pack(job))
        r->job = job; /* answered when it is made */
    else
        fw_serve_reply_error(r, 503, NULL, "the archive could not be made");
}

void fw_serve_route_job(fw_serve_request *r) {
    const char *rest;
    fw_serve_job *job = job_of(r, &rest);
    if (!job) return;
    if (!*rest)
        describe(r, job);
    else if (strncmp(rest, "/files/", 7) == 0)
        reply_file(r, job, rest + 7);
    else if (strcmp(rest, "/archive") == 0)
        archive(r, job);
    else
        fw_serve_reply_error(r, 404, NULL, "a job has files and an archive, nothing else");
}

void fw_serve_route_job_delete(fw_serve_request *r) {
    const char *rest;
    fw_serve_job *job = job_of(r, &rest);
    if (!job) return;
    if (*rest) {
        fw_serve_reply_error(r, 404, NULL, "only a whole job can be deleted");
        return;
    }
    fw_text text = fw_text_new(r->arena);
    bool ended = job->state != FW_JOB_QUEUED && job->state != FW_JOB_RUNNING;
    if (!ended) fw_serve_job_cancel(r->server, job);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_whole(&json, "id", job->id);
    fw_json_text(&json, "state", fw_serve_job_state_name(job->state));
    fw_json_end(&json);
    if (fw_json_finish(&json, "\n") != FW_OK) text.failed = 1;
    fw_serve_reply_text(r, 200, &text);
    if (ended) fw_serve_job_forget(r->server, job);
}
