/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a job: queued, running in its process, finished; and of the process that packs its
   archive. What is asked by HTTP is in route_jobs.c. */
#include "serve/jobs.h"
#include "base/json.h"
#include "serve/child.h"
#include "serve/events.h"
#include "serve/jobs_table.h"
#include "serve/scratch.h"
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    JOB_MS = 1800 * 1000, /* half an hour by the clock */
    TELL_MS = 500,
    CPU_S = 1800,
    MEMORY_GIB = 4,
    FILE_MIB = 512,
    FILES = 256,
    NICE = 5
};

static const fw_serve_child_limits limits = {.memory_bytes = (uint64_t)MEMORY_GIB << 30,
                                             .cpu_s = CPU_S,
                                             .file_bytes = (uint64_t)FILE_MIB << 20,
                                             .files = FILES,
                                             .nice = NICE};

const char *fw_serve_job_state_name(fw_serve_job_state state) {
    static const char *const name[] = {"queued", "running", "done", "failed", "cancelled"};
    return name[state];
}

double fw_serve_job_seconds(const fw_serve_job *job) {
    if (!job->began_ms) return 0.0;
    int64_t end = job->ended_ms ? job->ended_ms : fw_serve_now_ms();
    return (double)(end - job->began_ms) / 1000.0;
}

static void tell(fw_serve_server *server, fw_serve_job *job) {
    fw_text text = fw_text_new(job->arena);
    fw_mark mark = fw_arena_mark(job->arena);
    fw_json json = fw_json_new(&text, FW_JSON_SPACED);
    job->told_ms = fw_serve_now_ms();
    fw_json_object(&json, NULL);
    fw_json_whole(&json, "id", job->id);
    fw_json_text(&json, "state", fw_serve_job_state_name(job->state));
    fw_json_text(&json, "stage", job->stage);
    fw_json_number(&json, "seconds", fw_serve_job_seconds(job), 4);
    fw_json_end(&json);
    if (fw_json_finish(&json, "") == FW_OK) fw_serve_events_send(server, "job", "%s", text.data);
    fw_arena_rewind(job->arena, mark);
}

/* ---- start ---- */

static bool write_device(const fw_serve_job *job, const char *text, size_t n) {
    int fd = openat(job->fd, job->name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (fd < 0) return false;
    while (n > 0) {
        ssize_t done = write(fd, text, n);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) break;
        text += done;
        n -= (size_t)done;
    }
    return close(fd) == 0 && n == 0;
}

fw_status fw_serve_job_prepare(fw_serve_server *server, fw_serve_job *job, const char *text,
                               size_t n) {
    job->directory = fw_arena_printf(job->arena, "job-%u", job->id);
    job->message = fw_arena_array(job->arena, const char *, FW_JOB_MOST_LINES);
    FW_NEED(job->message);
    FW_NEED(job->directory);
    FW_NEED(job->path = fw_serve_scratch_path(job->arena, server->scratch, job->directory));
    job->fd = fw_serve_scratch_make(server->scratch, job->directory);
    if (job->fd < 0 || !write_device(job, text, n)) return FW_IO;
    tell(server, job);
    return FW_OK;
}

static bool start(fw_serve_job *job) {
    int errors[2];
    int out = openat(job->fd, "printed", O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (out < 0) return false;
    if (pipe2(errors, O_CLOEXEC) != 0) {
        close(out);
        return false;
    }
    fw_serve_child_plan plan = {.argv = job->argv,
                                .directory = job->fd,
                                .temporary = job->path,
                                .in = -1,
                                .out = out,
                                .err = errors[1],
                                .channel = -1,
                                .limits = limits};
    job->pid = fw_serve_child_start(&plan);
    close(out);
    close(errors[1]);
    fcntl(errors[0], F_SETFL, O_NONBLOCK);
    job->err = errors[0];
    return job->pid > 0;
}

/* ---- what it says ---- */

/* a line with -v is "flexwright: what it does now"; others are for the person */
static void one_line(fw_serve_server *server, fw_serve_job *job) {
    static const char ours[] = "flexwright: ";
    job->line[job->line_length] = '\0';
    job->line_length = 0;
    fw_serve_reply_clean(job->line);
    const char *text = job->line + sizeof ours - 1;
    if (strncmp(job->line, ours, sizeof ours - 1) == 0 && strncmp(text, "error", 5) != 0) {
        snprintf(job->stage, sizeof job->stage, "%.119s", text);
        fw_serve_reply_clean(job->stage);
        tell(server, job);
    } else if (job->line[0] && job->messages < FW_JOB_MOST_LINES) {
        const char *copy = fw_arena_strdup(job->arena, job->line);
        if (copy) job->message[job->messages++] = copy;
    }
}

/* everything that its standard error holds; a line that is too long is cut */
static void hear(fw_serve_server *server, fw_serve_job *job) {
    char buffer[4096];
    for (;;) {
        ssize_t got = job->err >= 0 ? read(job->err, buffer, sizeof buffer) : 0;
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            if (got == 0 && job->err >= 0) {
                close(job->err);
                job->err = -1;
            }
            return;
        }
        for (ssize_t i = 0; i < got; i++) {
            if (buffer[i] == '\n')
                one_line(server, job);
            else if (job->line_length < FW_JOB_MOST_LINE)
                job->line[job->line_length++] = buffer[i];
        }
    }
}

/* ---- the end ---- */

/* the document that it printed, when it is one */
static const char *printed(fw_serve_job *job) {
    int fd = openat(job->fd, "printed", O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    struct stat info;
    char *text = NULL;
    if (fd >= 0 && fstat(fd, &info) == 0 && info.st_size > 0 && info.st_size <= FW_JOB_MOST_RESULT)
        text = fw_arena_array(job->arena, char, (size_t)info.st_size + 1);
    bool whole = text && read(fd, text, (size_t)info.st_size) == info.st_size;
    if (fd >= 0) close(fd);
    json_t *json = whole ? json_loads(text, 0, NULL) : NULL;
    whole = json != NULL;
    json_decref(json);
    return whole ? text : NULL;
}

static void finish(fw_serve_server *server, fw_serve_job *job, int status) {
    hear(server, job);
    if (job->line_length) one_line(server, job);
    if (job->err >= 0) close(job->err);
    job->err = -1;
    kill(-job->pid, SIGKILL); /* what it may have left behind */
    job->pid = 0;
    job->ended_ms = fw_serve_now_ms();
    job->exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (WIFSIGNALED(status))
        job->why = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
                       ? "it was ended: it took more time or memory than a job may"
                       : "it crashed";
    /* 0 accepted, 1 rejected, 4 inconclusive: all are results */
    int e = job->exit_status;
    job->state = e == 0 || e == 1 || e == 4 ? FW_JOB_DONE : FW_JOB_FAILED;
    job->result = printed(job);
    if (fw_serve_job_list(job) != FW_OK) job->files = 0;
    tell(server, job);
}

void fw_serve_job_cancel(fw_serve_server *server, fw_serve_job *job) {
    fw_serve_child_kill(job->pid);
    if (job->err >= 0) close(job->err);
    job->pid = 0;
    job->err = -1;
    if (job->fd >= 0) close(job->fd);
    job->fd = -1;
    fw_serve_scratch_remove(server->scratch, job->directory);
    if (job->began_ms) job->ended_ms = fw_serve_now_ms();
    job->state = FW_JOB_CANCELLED;
    tell(server, job);
}

static void answer_waiting(fw_serve_server *server, const fw_serve_job *job);

void fw_serve_job_forget(fw_serve_server *server, fw_serve_job *job) {
    fw_serve_child_kill(job->pid);
    fw_serve_child_kill(job->packer);
    job->packer = 0;
    job->packed = false;
    answer_waiting(server, job);
    if (job->err >= 0) close(job->err);
    if (job->fd >= 0) close(job->fd);
    if (job->directory) fw_serve_scratch_remove(server->scratch, job->directory);
    fw_arena_free(job->arena);
    *job = (fw_serve_job){0};
}

/* ---- the archive ---- */

bool fw_serve_job_pack(fw_serve_job *job) {
    static const char *const argv[] = {"flexwright", FW_SERVE_CHILD, "archive", NULL};
    if (job->packer || job->packed) return true;
    fw_serve_child_plan plan = {.argv = argv,
                                .directory = job->fd,
                                .temporary = job->path,
                                .in = -1,
                                .out = -1,
                                .err = -1,
                                .channel = -1,
                                .limits = limits};
    job->packer = fw_serve_child_start(&plan);
    if (job->packer < 0) job->packer = 0;
    return job->packer > 0;
}

void fw_serve_job_reply_archive(fw_serve_request *r, const fw_serve_job *job) {
    int fd = job->packed ? openat(job->fd, "archive.zip", O_RDONLY | O_NOFOLLOW | O_CLOEXEC) : -1;
    struct stat info;
    if (fd < 0 || fstat(fd, &info) != 0) {
        if (fd >= 0) close(fd);
        fw_serve_reply_error(r, 500, "FW-D222", "the archive could not be made");
        return;
    }
    r->reply.status = 200;
    r->reply.type = "application/zip";
    r->reply.file = true;
    r->reply.fd = fd;
    r->reply.n = (size_t)info.st_size;
    r->reply.disposition =
        fw_arena_printf(r->arena, "attachment; filename=\"%s-%u.zip\"", job->kind, job->id);
}

static void answer_waiting(fw_serve_server *server, const fw_serve_job *job) {
    for (size_t i = 0; i < sizeof server->connection / sizeof *server->connection; i++) {
        fw_serve_request *r = server->connection[i].fd >= 0 ? server->connection[i].request : NULL;
        if (!r || r->job != job) continue;
        r->job = NULL;
        fw_serve_job_reply_archive(r, job);
        fw_serve_request_answer(r);
    }
}

void fw_serve_jobs_forget(fw_serve_jobs *jobs, fw_serve_request *r) {
    (void)jobs;
    r->job = NULL; /* the archive is made all the same: it will be asked for again */
}

/* ---- the table ---- */

fw_status fw_serve_jobs_open(fw_serve_server *server) {
    FW_NEED(server->jobs = fw_arena_one(server->arena, fw_serve_jobs));
    return FW_OK;
}

void fw_serve_jobs_close(fw_serve_server *server) {
    for (int i = 0; server->jobs && i < FW_JOBS_KEPT; i++)
        if (server->jobs->job[i].id) fw_serve_job_forget(server, &server->jobs->job[i]);
}

fw_serve_job *fw_serve_jobs_find(fw_serve_jobs *jobs, unsigned id) {
    for (int i = 0; id && i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].id == id) return &jobs->job[i];
    return NULL;
}

static fw_serve_job *first_in(fw_serve_jobs *jobs, fw_serve_job_state state) {
    fw_serve_job *first = NULL;
    for (int i = 0; i < FW_JOBS_KEPT; i++) {
        fw_serve_job *job = &jobs->job[i];
        if (job->id && job->state == state && (!first || job->id < first->id)) first = job;
    }
    return first;
}

bool fw_serve_jobs_busy(const fw_serve_jobs *jobs) {
    for (int i = 0; i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].pid || jobs->job[i].packer) return true;
    return false;
}

static void run_one(fw_serve_server *server, fw_serve_job *job, int64_t now) {
    int status;
    if (job->packer && fw_serve_child_ended(job->packer, &status)) {
        job->packer = 0;
        job->packed = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        answer_waiting(server, job);
    }
    if (job->state != FW_JOB_RUNNING) return;
    hear(server, job);
    if (fw_serve_child_ended(job->pid, &status))
        finish(server, job, status);
    else if (now - job->began_ms > JOB_MS)
        kill(-job->pid, SIGKILL);
    else if (now - job->told_ms > TELL_MS)
        tell(server, job);
}

void fw_serve_jobs_run(fw_serve_server *server) {
    fw_serve_jobs *jobs = server->jobs;
    int64_t now = fw_serve_now_ms();
    for (int i = 0; i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].id) run_one(server, &jobs->job[i], now);
    fw_serve_job *next = first_in(jobs, FW_JOB_RUNNING) ? NULL : first_in(jobs, FW_JOB_QUEUED);
    if (!next) return;
    next->began_ms = now;
    next->state = FW_JOB_RUNNING;
    if (!start(next)) {
        next->state = FW_JOB_FAILED;
        next->ended_ms = now;
        next->why = "it could not be started";
    }
    tell(server, next);
}

size_t fw_serve_jobs_poll(const fw_serve_jobs *jobs, struct pollfd *poll, size_t most) {
    size_t n = 0;
    for (int i = 0; i < FW_JOBS_KEPT && n < most; i++)
        if (jobs->job[i].id && jobs->job[i].err >= 0)
            poll[n++] = (struct pollfd){.fd = jobs->job[i].err, .events = POLLIN};
    return n;
}
