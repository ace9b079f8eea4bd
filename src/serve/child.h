/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes and directories of the server's own: how they are started and limited, where they work, and
   those that wait for work. Private to the room. */
#ifndef FW_SERVE_CHILD_H
#define FW_SERVE_CHILD_H
#include "base/diag.h"
#include "plan/live.h"
#include <poll.h>
#include <stdint.h>
#include <sys/types.h>

/* ---- the same program, run again, with limits ----
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
struct fw_serve_request;

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
void fw_serve_pool_ask(fw_serve_pool *pool, struct fw_serve_request *request,
                       fw_serve_compute what);
/* nobody waits for its answer any more, when it is one of them */
void fw_serve_pool_forget(fw_serve_pool *pool, struct fw_serve_request *request);
/* what to poll, at most `most`; and what to do afterwards */
size_t fw_serve_pool_poll(const fw_serve_pool *pool, struct pollfd *poll, size_t most);
void fw_serve_pool_run(fw_serve_pool *pool);

/* the other side: what it answers a question with; without a text where it does not know what is asked */
fw_plan_live_answer fw_serve_worker_answer(fw_plan_live *live, fw_serve_compute what,
                                           const char *request, size_t n);
/* serves descriptor 3 until it is closed */
int fw_serve_worker_main(const char *data_directory);

#endif
