/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long work: the program's own commands in processes of their own, one after the other, each in a
   directory of its own. Private to the room. */
#ifndef FW_SERVE_JOBS_H
#define FW_SERVE_JOBS_H
#include "serve/child.h"
#include "serve/request.h"
#include <jansson.h>
#include <poll.h>

typedef struct fw_serve_jobs fw_serve_jobs;
typedef enum fw_serve_job_state {
    FW_JOB_QUEUED,
    FW_JOB_RUNNING,
    FW_JOB_DONE,
    FW_JOB_FAILED,
    FW_JOB_CANCELLED
} fw_serve_job_state;

enum {
    FW_JOBS_QUEUED = 4,      /* that wait */
    FW_JOBS_KEPT = 16,       /* with the finished ones, of which the oldest is forgotten */
    FW_JOB_MOST_LINES = 400, /* of messages */
    FW_JOB_MOST_LINE = 2000, /* bytes */
    FW_JOB_MOST_FILES = 4000,
    FW_JOB_MOST_RESULT = 16 << 20 /* bytes of the printed document */
};

typedef struct fw_serve_job_file {
    const char *path, *type; /* below the job's out/ */
    uint64_t bytes;
} fw_serve_job_file;

typedef struct fw_serve_job {
    unsigned id; /* 0: the slot is free */
    fw_arena *arena;
    const char *kind, *name;
    bool keeps;                   /* a study: what it has done stays when it is cancelled */
    const char *directory, *path; /* below the scratch; from the root */
    const char *const *argv;
    fw_serve_job_state state;
    pid_t pid;
    int fd, err; /* its directory; its standard error, -1 when closed */
    int64_t began_ms, told_ms, ended_ms;
    char line[FW_JOB_MOST_LINE + 1];
    size_t line_length;
    char stage[120];
    const char **message; /* (messages) */
    size_t messages;
    int exit_status; /* -1: none */
    const char *why; /* it ended otherwise than by itself */
    const char *result;
    fw_serve_job_file *file; /* (files) by path */
    size_t files;
    pid_t packer; /* of the archive, 0: none */
    bool packed;
    fw_serve_request *waiting; /* for the archive, chained by `next` */
} fw_serve_job;

/* directories of jobs are made in `scratch`; what happens to them goes out as events */
fw_status fw_serve_jobs_open(fw_arena *arena, fw_serve_scratch *scratch, fw_serve_events *events,
                             fw_serve_jobs **jobs);
void fw_serve_jobs_close(fw_serve_jobs *jobs); /* NULL allowed */
void fw_serve_jobs_run(fw_serve_jobs *jobs);
bool fw_serve_jobs_busy(const fw_serve_jobs *jobs);
size_t fw_serve_jobs_poll(const fw_serve_jobs *jobs, struct pollfd *poll, size_t most);
typedef struct fw_serve_job_order { /* what is asked for */
    const json_t *request;          /* {"kind", "set", "options", "files", "resume", "results"} */
    const char *file, *text;        /* name and (n) bytes of the description */
    size_t n;
    const struct fw_serve_beside
        *beside;   /* where what it names lies; NULL: it names nothing there */
    char why[240]; /* what is wrong with it; "": nothing */
} fw_serve_job_order;
/* Queues the job. FW_LIMIT: FW_JOBS_QUEUED wait already; FW_INPUT: order->why; else there is no
   memory, or no room on the disk. */
fw_status fw_serve_jobs_add(fw_serve_jobs *jobs, fw_serve_job_order *order,
                            const fw_serve_job **job);
fw_serve_job *fw_serve_jobs_find(fw_serve_jobs *jobs, unsigned id);

/* one that waits or runs: its process and files go, what it said stays. Of a study the samples stay, too, until it is
   forgotten or gone on with. */
void fw_serve_job_cancel(fw_serve_jobs *jobs, fw_serve_job *job);
/* in any state; its files go */
void fw_serve_job_forget(fw_serve_jobs *jobs, fw_serve_job *job);
const char *fw_serve_job_state_name(fw_serve_job_state state);
/* since it began; of a finished one: how long it took */
double fw_serve_job_seconds(const fw_serve_job *job);
/* The archive of a finished job: at once, or as soon as it is made. */
void fw_serve_job_archive(fw_serve_job *job, fw_serve_request *request);
/* nobody waits any more; the archive is made all the same: it will be asked for again */
void fw_serve_jobs_forget(fw_serve_request *request);

/* ---- job_kinds.c: from the request to a command line ---- */
/* argv of the program for {"kind", "set", "options", "files", "resume", "results"}; beside: the logs that "run" may name,
   NULL: none; FW_INPUT: *why says what is wrong */
fw_status fw_serve_job_command(fw_arena *arena, const void *json, const char *file,
                               const struct fw_serve_beside *beside, const char **kind,
                               const char *const **argv, const char **why);

/* ---- files ---- */
/* a file of the list: its descriptor, or -1 */
int fw_serve_job_open(const fw_serve_job *job, const fw_serve_job_file *file);
/* in a process of its own, in the job's directory: archive.zip of out/ */
int fw_serve_archive_main(void);

#endif
