/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long work: the program's own commands in processes of their own, one after the other, each in a
   directory of its own; and how processes of the server are started and limited, where they work, and those that wait for
   work of milliseconds. Private to the room. */
#ifndef FW_SERVE_JOBS_H
#define FW_SERVE_JOBS_H
#include "base/diag.h"
#include "plan/live.h"
#include "serve/request.h"
#include <jansson.h>
#include <poll.h>
#include <stdint.h>
#include <sys/types.h>

/* ---- child.c: the same program, run again, with limits ----
   It knows no secret of the server (nothing is inherited but what is named here), and ends with the
   server. */

typedef struct fw_serve_child_limits {
    /* these two not under a sanitizer, which needs it all and has to say what it found */
    uint64_t memory_bytes; /* address space */
    uint64_t file_bytes;   /* of one file */
    uint64_t cpu_s;        /* 0: none */
    uint64_t files;        /* open at once */
    int nice;              /* so much behind the server itself */
} fw_serve_child_limits;

typedef struct fw_serve_child_plan {
    const char *const *argv; /* NULL-terminated, [0] is the program's name */
    int directory;           /* to start in; -1: the server's */
    const char *temporary;   /* its $TMPDIR; NULL: the server's */
    int in, out, err;        /* become 0, 1 and 2; -1: /dev/null (err: the server's) */
    int channel;             /* becomes 3; -1: none */
    fw_serve_child_limits limits;
} fw_serve_child_plan;

/* the process (and group) or -1. The descriptors stay the caller's. */
pid_t fw_serve_child_start(const fw_serve_child_plan *plan);
/* has it ended? Then *status is as of waitpid */
int fw_serve_child_ended(pid_t pid, int *status);
/* ends it and all that it started, and waits for it */
void fw_serve_child_kill(pid_t pid);

/* ---- the server's directory for its jobs ----
   Below $TMPDIR or /tmp, for the owner alone. A lock in it says that its server lives: what a
   killed one left, the next one removes. */

typedef struct fw_serve_scratch fw_serve_scratch;

fw_status fw_serve_scratch_open(fw_arena *arena, fw_diags *diags, fw_serve_scratch **scratch);
void fw_serve_scratch_close(fw_serve_scratch *scratch); /* with all that is in it; NULL allowed */
/* a new directory in it: its descriptor, or -1 */
int fw_serve_scratch_make(fw_serve_scratch *scratch, const char *name);
/* where it is, from the root */
const char *fw_serve_scratch_path(fw_arena *arena, const fw_serve_scratch *scratch,
                                  const char *name);
/* open.html, for the owner alone, which leads to the address: a command line would show its token
   to every user of the machine. Its path, NULL when it cannot be written. */
const char *fw_serve_scratch_page(fw_arena *arena, fw_serve_scratch *scratch, const char *url);
void fw_serve_scratch_drop_page(fw_serve_scratch *scratch); /* it has served */
void fw_serve_scratch_remove(fw_serve_scratch *scratch, const char *name);

/* ---- processes that wait for work of milliseconds ----
   Preview, pose, edit, table, points that are explored. They were started beforehand, have limits, and are started anew after a
   crash or a limit; the server itself never reads a description.

   Over a socket, native bytes: request {uint32 kind, uint32 n} and n bytes; answer {uint32 HTTP
   status, uint32 n} and n bytes. */

typedef struct fw_serve_pool fw_serve_pool;

enum { FW_SERVE_WORKERS = 2, FW_SERVE_MOST_QUESTION = 1024 * 1024 }; /* bytes of a question */

typedef enum fw_serve_compute {
    FW_COMPUTE_TABLE,
    FW_COMPUTE_PREVIEW,
    FW_COMPUTE_PICTURE,
    FW_COMPUTE_POSE,
    FW_COMPUTE_EDIT,
    FW_COMPUTE_EXPLORE
} fw_serve_compute;

typedef struct fw_serve_worker_head {
    uint32_t what, n;
} fw_serve_worker_head;
enum { FW_WORKER_MOST_ANSWER = 32 * 1024 * 1024 };

/* workers that read packs from data_directory (NULL: as installed) */
fw_status fw_serve_pool_open(fw_arena *arena, const char *data_directory, fw_serve_pool **pool);
void fw_serve_pool_close(fw_serve_pool *pool);
/* the request's body goes to a worker as soon as one is free; the answer comes by
   fw_serve_request_answer */
void fw_serve_pool_ask(fw_serve_pool *pool, fw_serve_request *request, fw_serve_compute what);
/* nobody waits for its answer any more, when it is one of them */
void fw_serve_pool_forget(fw_serve_pool *pool, fw_serve_request *request);
/* what to poll, at most `most`; and what to do afterwards */
size_t fw_serve_pool_poll(const fw_serve_pool *pool, struct pollfd *poll, size_t most);
void fw_serve_pool_run(fw_serve_pool *pool);

/* the other side: what it answers a question with; without a text where it does not know what is asked */
fw_plan_live_answer fw_serve_worker_answer(fw_plan_live *live, fw_serve_compute what,
                                           const char *request, size_t n);
/* serves descriptor 3 until it is closed */
int fw_serve_worker_main(const char *data_directory);

/* ---- jobs ---- */

typedef struct fw_serve_jobs fw_serve_jobs;
typedef enum fw_serve_job_state {
    FW_JOB_QUEUED,
    FW_JOB_RUNNING,
    FW_JOB_DONE,
    FW_JOB_FAILED,
    FW_JOB_CANCELLED
} fw_serve_job_state;

enum {
    FW_JOBS_QUEUED = 4, /* that wait */
    FW_JOB_LEASE_MS =
        90000, /* an automatic job nobody has asked for so long: pages in the background look once a minute */
    FW_JOBS_KEPT = 16,       /* with the finished ones, of which the oldest is forgotten */
    FW_JOB_MOST_LINES = 400, /* of messages */
    FW_JOB_MOST_LINE = 2000, /* bytes */
    FW_JOB_MOST_FILES = 4000,
    FW_JOB_MOST_OF = 200,         /* bytes of what a page says that a job is of */
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
    const char *study; /* the study's name; NULL: no study, or none was named */
    const char *of;    /* what the page that began it says that it is of; NULL: nothing */
    bool keeps;        /* a study: what it has done stays when it is cancelled */
    bool automatic;    /* nobody has asked for it: it ends when no page looks at it any more */
    const char *directory, *path; /* below the scratch; from the root */
    const char *const *argv;
    fw_serve_job_state state;
    pid_t pid;
    int fd, err; /* its directory; its standard error, -1 when closed */
    int64_t began_ms, told_ms, ended_ms, asked_ms; /* asked: when a page last asked for it */
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
    const json_t
        *request; /* {"kind", "set", "options", "files", "resume", "results", "automatic", "of"} */
    const char *file, *text; /* name and (n) bytes of the description */
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
/* there was a job of this number, and it is not there any more */
bool fw_serve_jobs_gone(const fw_serve_jobs *jobs, unsigned id);
/* the next one by number after `id` (0: the first); NULL: none */
const fw_serve_job *fw_serve_jobs_after(const fw_serve_jobs *jobs, unsigned id);

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

/* ---- job_kinds.c: from the request to a command line, and what it made ---- */
/* argv of the program for {"kind", "set", "options", "files", "resume", "results"}; beside: the logs that "run" may name,
   NULL: none; FW_INPUT: *why says what is wrong */
fw_status fw_serve_job_command(fw_arena *arena, const void *json, const char *file,
                               const struct fw_serve_beside *beside, const char **kind,
                               const char *const **argv, const char **why);

/* ---- files ---- */
/* what is below out/ of the job's directory, by path */
fw_status fw_serve_job_list(fw_serve_job *job);
/* a file of the list: its descriptor, or -1 */
int fw_serve_job_open(const fw_serve_job *job, const fw_serve_job_file *file);
/* in a process of its own, in the job's directory: archive.zip of out/ */
int fw_serve_archive_main(void);

/* ---- document.c: the text that a page edits ----
   The one file that the server shows, watches and saves, the draft that a page has and nobody saved, and what lies beside the
   file. */

typedef struct fw_serve_file_watch fw_serve_file_watch;

/* `path` NULL: there is no file, and *watch is NULL. A file larger than most_bytes is not read;
   changes of it go out as events. Errors are diagnostics. */
fw_status fw_serve_file_watch_open(fw_arena *arena, const char *path, size_t most_bytes,
                                   fw_serve_events *events, fw_diags *diags,
                                   fw_serve_file_watch **watch);
void fw_serve_file_watch_close(fw_serve_file_watch *watch);
/* without directories; NULL: no file */
const char *fw_serve_file_watch_name(const fw_serve_file_watch *watch);
/* whole; NULL: no file */
const char *fw_serve_file_watch_path(const fw_serve_file_watch *watch);
int fw_serve_file_watch_fd(const fw_serve_file_watch *watch); /* to be polled; -1: there is none */
/* looks at the file when the system says that it changed, and every second in any case: tells the
   pages when its content is another, and when it could not be read for a second: gone, too large,
   no file any more */
void fw_serve_file_watch_run(fw_serve_file_watch *watch);
/* tells one page which version was seen last: it may have missed a change */
void fw_serve_file_watch_tell(const fw_serve_file_watch *watch, fw_serve_stream *stream);

/* ---- the file as it is now ---- */
typedef struct fw_serve_file_state {
    const char *text; /* (n) in the caller's arena, or what was to be saved */
    size_t n;
    char version[65]; /* hash of the text; "": it could not be read */
    bool writable;
} fw_serve_file_state;
fw_status fw_serve_file_watch_read(fw_arena *arena, const fw_serve_file_watch *watch,
                                   fw_diags *diags, fw_serve_file_state *state);
/* Saves n bytes, whole or not at all, with the permissions that the file has; state is then what
   was saved. FW_CANCELLED: the file is not at `version` any more, state says what it is. A file that
   is gone is written anew; what is there and cannot be read is not replaced. */
fw_status fw_serve_file_watch_save(fw_arena *arena, fw_serve_file_watch *watch, const char *text,
                                   size_t n, const char *version, fw_diags *diags,
                                   fw_serve_file_state *state);

/* ---- the draft ----
   Kept beside no file of the user's, below $XDG_STATE_HOME/flexwright/drafts (else ~/.local/state), one
   for every watched file and one for servers without a file. So it survives a page that is closed and
   a server that ends, on whatever port it starts again. */

/* where the draft of this file is (an absolute path; NULL: of no file); NULL: memory was short, or
   neither $XDG_STATE_HOME nor $HOME names a directory */
const char *fw_serve_draft_path(fw_arena *arena, const char *file);

/* The handlers of GET, POST and DELETE. GET answers what was kept, {"text": null} where nothing
   is; what is no document of ours counts as nothing. */
void fw_serve_draft_get(fw_serve_request *request, const char *path);
void fw_serve_draft_post(fw_serve_request *request, const char *path);
void fw_serve_draft_delete(fw_serve_request *request, const char *path);

/* ---- what lies beside the file ----
   As-run logs in its directory, and directories below it that hold the samples of a study: what the program has
   written there in a terminal. A server without a file keeps logs below $XDG_STATE_HOME/flexwright/logs. */

typedef struct fw_serve_beside {
    const char *directory; /* absolute, with a slash at its end; NULL: there is none */
    const char **log;      /* (nlog) names of files that begin as logs do, by name */
    const char *
        *study; /* (nstudy) directories with a study.sqlite, from the directory on, by name */
    size_t nlog, nstudy;
} fw_serve_beside;

/* `file` as fw_serve_file_watch_path has it */
fw_status fw_serve_beside_look(fw_arena *arena, const char *file, fw_serve_beside *beside);
/* a log that is there, or a name that a new one may have: letters, digits, '-' and '_' before ".log" */
bool fw_serve_beside_is_log(const fw_serve_beside *beside, const char *name);
/* The samples of one of its studies as out/study.sqlite of the directory `to`: a copy, what is beside the file stays as it
   is. NULL, or why not. */
const char *fw_serve_beside_copy(const fw_serve_beside *beside, const char *study, int to);
/* the handler of GET: what there is, or with a name the log of that name */
void fw_serve_beside_get(fw_serve_request *request, const char *file, const char *name);

#endif
