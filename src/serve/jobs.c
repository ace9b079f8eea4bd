/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a job: queued, running in its process, finished; and who waits for its archive. What is asked by HTTP is in
   routes.c. */
#include "serve/jobs.h"
#include "serve/serve.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- a job's life ---- */

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

struct fw_serve_jobs {
    fw_serve_scratch *scratch;
    fw_serve_events *events;
    fw_serve_job job[FW_JOBS_KEPT];
    unsigned last_id;
};

const char *fw_serve_job_state_name(fw_serve_job_state state) {
    static const char *const name[] = {"queued", "running", "done", "failed", "cancelled"};
    return name[state];
}

double fw_serve_job_seconds(const fw_serve_job *job) {
    if (!job->began_ms) return 0.0;
    int64_t end = job->ended_ms ? job->ended_ms : fw_serve_now_ms();
    return (double)(end - job->began_ms) / 1000.0;
}

static void tell(const fw_serve_jobs *jobs, fw_serve_job *job) {
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
    if (fw_json_finish(&json, "") == FW_OK) fw_serve_events_send(jobs->events, "job", text.data);
    fw_arena_rewind(job->arena, mark);
}

/* ---- start ---- */

static bool write_file(const fw_serve_job *job, const char *name, const char *text, size_t n) {
    int fd = openat(job->fd, name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
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

/* what came with the description; their names were looked at with the request */
static bool write_files(const fw_serve_job *job, json_t *files) {
    const char *name;
    json_t *text;
    json_object_foreach(files, name, text) if (!write_file(job, name, json_string_value(text),
                                                           json_string_length(text))) return false;
    return true;
}

/* the samples of a study that was stopped become those of this one */
static fw_status take_over(fw_serve_jobs *jobs, fw_serve_job *job, fw_serve_job *from) {
    if (renameat(from->fd, "out", job->fd, "out") != 0 && errno != ENOENT) return FW_IO;
    fw_serve_job_forget(jobs, from);
    return FW_OK;
}

/* or those that a terminal has left beside the description */
static fw_status take_copy(const fw_serve_job *job, fw_serve_job_order *order) {
    const json_t *results = json_object_get(order->request, "results");
    if (!results || json_is_null(results)) return FW_OK;
    const char *name = json_string_value(results);
    const char *why = job->keeps && name && !json_object_get(order->request, "resume")
                          ? fw_serve_beside_copy(order->beside, name, job->fd)
                          : "\"results\" is the name of a directory, of a study that begins";
    if (why) snprintf(order->why, sizeof order->why, "%s", why);
    return why ? FW_INPUT : FW_OK;
}

/* commands that are told a file in out/, and do not make it */
static bool writes_into(const char *kind) {
    return strcmp(kind, "calibrate") == 0 || strcmp(kind, "log") == 0;
}

/* its directory with the description in it; FW_IO when that cannot be */
static fw_status prepare(fw_serve_jobs *jobs, fw_serve_job *job, fw_serve_job_order *order,
                         fw_serve_job *from) {
    job->directory = fw_arena_printf(job->arena, "job-%u", job->id);
    job->message = fw_arena_array(job->arena, const char *, FW_JOB_MOST_LINES);
    FW_NEED(job->message);
    FW_NEED(job->directory);
    FW_NEED(job->path = fw_serve_scratch_path(job->arena, jobs->scratch, job->directory));
    job->fd = fw_serve_scratch_make(jobs->scratch, job->directory);
    if (job->fd < 0 || !write_file(job, job->name, order->text, order->n) ||
        !write_files(job, json_object_get(order->request, "files")))
        return FW_IO;
    if (writes_into(job->kind) && mkdirat(job->fd, "out", 0700) != 0) return FW_IO;
    if (from) FW_TRY(take_over(jobs, job, from));
    FW_TRY(take_copy(job, order));
    tell(jobs, job);
    return FW_OK;
}

static bool start(fw_serve_job *job) {
    int errors[2];
    int out = openat(job->fd, "printed", O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (out < 0 || pipe2(errors, O_CLOEXEC) != 0) {
        if (out >= 0) close(out); /* which leaves errno as it is */
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
    const pid_t pid = fw_serve_child_start(&plan);
    const int why = errno;
    close(out);
    close(errors[1]);
    if (pid < 0) { /* a pipe whose other end is gone would be looked at without end */
        close(errors[0]);
        errno = why;
        return false;
    }
    fcntl(errors[0], F_SETFL, O_NONBLOCK);
    job->pid = pid;
    job->err = errors[0];
    return true;
}

/* ---- what it says ---- */

/* a line with -v is "flexwright: what it does now"; others are for the person */
static void one_line(fw_serve_jobs *jobs, fw_serve_job *job) {
    static const char ours[] = "flexwright: ";
    job->line[job->line_length] = '\0';
    job->line_length = 0;
    fw_serve_reply_clean(job->line);
    const char *text = job->line + sizeof ours - 1;
    if (strncmp(job->line, ours, sizeof ours - 1) == 0 && strncmp(text, "error", 5) != 0) {
        snprintf(job->stage, sizeof job->stage, "%.119s", text);
        fw_serve_reply_clean(job->stage);
        tell(jobs, job);
    } else if (job->line[0] && job->messages < FW_JOB_MOST_LINES) {
        const char *copy = fw_arena_strdup(job->arena, job->line);
        if (copy) job->message[job->messages++] = copy;
    }
}

/* everything that its standard error holds; a line that is too long is cut */
static void hear(fw_serve_jobs *jobs, fw_serve_job *job) {
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
                one_line(jobs, job);
            else if (job->line_length < FW_JOB_MOST_LINE)
                job->line[job->line_length++] = buffer[i];
        }
    }
}

/* ---- who waits for the archive ---- */

/* begins it, unless it has begun */
static bool pack(fw_serve_job *job) {
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

static void reply_archive(fw_serve_request *r, const fw_serve_job *job) {
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
    r->reply.disposition = "attachment"; /* its name is the page's to give: that of the device */
}

static void answer_waiting(fw_serve_job *job) {
    while (job->waiting) {
        fw_serve_request *r = job->waiting;
        job->waiting = r->next;
        r->job = NULL;
        reply_archive(r, job);
        fw_serve_request_answer(r);
    }
}

void fw_serve_job_archive(fw_serve_job *job, fw_serve_request *r) {
    if (job->packed)
        reply_archive(r, job);
    else if (job->state != FW_JOB_DONE || job->files == 0)
        fw_serve_reply_error(r, 404, NULL, "this job has no files");
    else if (!pack(job))
        fw_serve_reply_error(r, 503, NULL, "the archive could not be made");
    else {
        r->job = job;
        r->next = job->waiting;
        job->waiting = r;
    }
}

void fw_serve_jobs_forget(fw_serve_request *r) {
    for (fw_serve_request **at = r->job ? &r->job->waiting : NULL; at && *at; at = &(*at)->next)
        if (*at == r) {
            *at = r->next;
            break;
        }
    r->job = NULL;
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

static void finish(fw_serve_jobs *jobs, fw_serve_job *job, int status) {
    hear(jobs, job);
    if (job->line_length) one_line(jobs, job);
    if (job->err >= 0) close(job->err);
    job->err = -1;
    kill(-job->pid, SIGKILL); /* what it may have left behind */
    job->pid = 0;
    job->ended_ms = fw_serve_now_ms();
    job->exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (WIFSIGNALED(status))
        job->why = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
                       ? "it was ended: a job may take half an hour and 4 GiB of memory"
                       : "it crashed";
    /* 0 accepted, 1 rejected, 4 inconclusive: all are results */
    int e = job->exit_status;
    job->state = e == 0 || e == 1 || e == 4 ? FW_JOB_DONE : FW_JOB_FAILED;
    job->result = printed(job);
    if (fw_serve_job_list(job) != FW_OK) job->files = 0;
    tell(jobs, job);
}

void fw_serve_job_cancel(fw_serve_jobs *jobs, fw_serve_job *job) {
    fw_serve_child_kill(job->pid);
    if (job->err >= 0) close(job->err);
    job->pid = 0;
    job->err = -1;
    if (!job->keeps) {
        if (job->fd >= 0) close(job->fd);
        job->fd = -1;
        fw_serve_scratch_remove(jobs->scratch, job->directory);
    }
    if (job->began_ms) job->ended_ms = fw_serve_now_ms();
    job->state = FW_JOB_CANCELLED;
    tell(jobs, job);
}

void fw_serve_job_forget(fw_serve_jobs *jobs, fw_serve_job *job) {
    fw_serve_child_kill(job->pid);
    fw_serve_child_kill(job->packer);
    job->packer = 0;
    job->packed = false;
    answer_waiting(job);
    if (job->err >= 0) close(job->err);
    if (job->fd >= 0) close(job->fd);
    if (job->directory) fw_serve_scratch_remove(jobs->scratch, job->directory);
    fw_arena_free(job->arena);
    *job = (fw_serve_job){0};
}

/* ---- the table ---- */

fw_status fw_serve_jobs_open(fw_arena *arena, fw_serve_scratch *scratch, fw_serve_events *events,
                             fw_serve_jobs **jobs) {
    FW_NEED(*jobs = fw_arena_one(arena, fw_serve_jobs));
    (*jobs)->scratch = scratch;
    (*jobs)->events = events;
    return FW_OK;
}

void fw_serve_jobs_close(fw_serve_jobs *jobs) {
    for (int i = 0; jobs && i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].id) fw_serve_job_forget(jobs, &jobs->job[i]);
}

fw_serve_job *fw_serve_jobs_find(fw_serve_jobs *jobs, unsigned id) {
    for (int i = 0; id && i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].id == id) return &jobs->job[i];
    return NULL;
}

bool fw_serve_jobs_gone(const fw_serve_jobs *jobs, unsigned id) {
    if (id < 1 || id > jobs->last_id) return false;
    for (int i = 0; i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].id == id) return false;
    return true;
}

/* a free slot; of those that are finished, but for one, the oldest makes room. NULL: too many wait */
static fw_serve_job *slot(fw_serve_jobs *jobs, const fw_serve_job *but) {
    fw_serve_job *oldest = NULL, *empty = NULL;
    int waiting = 0;
    for (int i = 0; i < FW_JOBS_KEPT; i++) {
        fw_serve_job *job = &jobs->job[i];
        if (!job->id)
            empty = job;
        else if (job->state == FW_JOB_QUEUED)
            waiting++;
        else if (job != but && job->state != FW_JOB_RUNNING && (!oldest || job->id < oldest->id))
            oldest = job;
    }
    if (waiting >= FW_JOBS_QUEUED) return NULL;
    if (empty) return empty;
    fw_serve_job_forget(jobs, oldest); /* 16 slots, 5 at most wait or run */
    return oldest;
}

/* the study that is to be gone on with; NULL: none is asked for. FW_INPUT: it cannot be */
static fw_status resumed(fw_serve_jobs *jobs, fw_serve_job_order *order, fw_serve_job **from) {
    const json_t *id = json_object_get(order->request, "resume");
    *from = NULL;
    if (!id || json_is_null(id)) return FW_OK;
    json_int_t number = json_is_integer(id) ? json_integer_value(id) : 0;
    if (number > 0 && number < 1000000000) *from = fw_serve_jobs_find(jobs, (unsigned)number);
    if (*from && (*from)->keeps && (*from)->fd >= 0 && (*from)->state != FW_JOB_QUEUED &&
        (*from)->state != FW_JOB_RUNNING)
        return FW_OK;
    snprintf(order->why, sizeof order->why,
             "\"resume\" has to be the number of a study that was stopped, or has ended");
    return FW_INPUT;
}

const fw_serve_job *fw_serve_jobs_after(const fw_serve_jobs *jobs, unsigned id) {
    const fw_serve_job *next = NULL;
    for (int i = 0; i < FW_JOBS_KEPT; i++) {
        const fw_serve_job *job = &jobs->job[i];
        if (job->id > id && (!next || job->id < next->id)) next = job;
    }
    return next;
}

/* what the request says of it beside its command */
static fw_status take_order(fw_serve_job *job, fw_serve_job_order *order) {
    const json_t *request = order->request, *of = json_object_get(request, "of");
    const char *study =
        json_string_value(json_object_get(json_object_get(request, "options"), "study"));
    if (of && (!json_is_string(of) || json_string_length(of) > FW_JOB_MOST_OF)) {
        snprintf(order->why, sizeof order->why, "\"of\" is a text of at most %d bytes",
                 (int)FW_JOB_MOST_OF);
        return FW_INPUT;
    }
    if (of) FW_NEED(job->of = fw_arena_strdup(job->arena, json_string_value(of)));
    job->keeps = strcmp(job->kind, "study") == 0;
    job->automatic = json_is_true(json_object_get(request, "automatic"));
    job->asked_ms = fw_serve_now_ms();
    if (job->keeps && study) FW_NEED(job->study = fw_arena_strdup(job->arena, study));
    return FW_OK;
}

fw_status fw_serve_jobs_add(fw_serve_jobs *jobs, fw_serve_job_order *order,
                            const fw_serve_job **out) {
    fw_serve_job *from;
    FW_TRY(resumed(jobs, order, &from));
    fw_serve_job *job = slot(jobs, from);
    const char *why = "";
    if (!job) return FW_LIMIT;
    *job = (fw_serve_job){.id = jobs->last_id + 1, .fd = -1, .err = -1, .exit_status = -1};
    job->arena = fw_arena_new(0);
    job->name = job->arena ? fw_arena_strdup(job->arena, order->file) : NULL;
    fw_status status = job->name ? fw_serve_job_command(job->arena, order->request, job->name,
                                                        order->beside, &job->kind, &job->argv, &why)
                                 : FW_NOMEM;
    if (status == FW_INPUT) snprintf(order->why, sizeof order->why, "%s", why);
    if (status == FW_OK) {
        jobs->last_id++;
        status = take_order(job, order);
        if (status == FW_OK) status = prepare(jobs, job, order, from);
    }
    if (status != FW_OK) fw_serve_job_forget(jobs, job);
    *out = job;
    return status;
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

static void run_one(fw_serve_jobs *jobs, fw_serve_job *job, int64_t now) {
    int status;
    if (job->packer && fw_serve_child_ended(job->packer, &status)) {
        job->packer = 0;
        job->packed = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        answer_waiting(job);
    }
    const bool left = job->automatic && now - job->asked_ms > FW_JOB_LEASE_MS;
    if (left && (job->state == FW_JOB_QUEUED || job->state == FW_JOB_RUNNING))
        fw_serve_job_cancel(jobs, job);
    if (job->state != FW_JOB_RUNNING) return;
    hear(jobs, job);
    if (fw_serve_child_ended(job->pid, &status))
        finish(jobs, job, status);
    else if (now - job->began_ms > JOB_MS)
        kill(-job->pid, SIGKILL);
    else if (now - job->told_ms > TELL_MS)
        tell(jobs, job);
}

void fw_serve_jobs_run(fw_serve_jobs *jobs) {
    int64_t now = fw_serve_now_ms();
    for (int i = 0; i < FW_JOBS_KEPT; i++)
        if (jobs->job[i].id) run_one(jobs, &jobs->job[i], now);
    fw_serve_job *next = first_in(jobs, FW_JOB_RUNNING) ? NULL : first_in(jobs, FW_JOB_QUEUED);
    if (!next) return;
    next->began_ms = now;
    next->state = FW_JOB_RUNNING;
    if (!start(next)) {
        next->state = FW_JOB_FAILED;
        next->ended_ms = now;
        next->why = fw_arena_printf(next->arena, "it could not be started: %s", strerror(errno));
    }
    tell(jobs, next);
}

size_t fw_serve_jobs_poll(const fw_serve_jobs *jobs, struct pollfd *poll, size_t most) {
    size_t n = 0;
    for (int i = 0; i < FW_JOBS_KEPT && n < most; i++)
        if (jobs->job[i].id && jobs->job[i].err >= 0)
            poll[n++] = (struct pollfd){.fd = jobs->job[i].err, .events = POLLIN};
    return n;
}
