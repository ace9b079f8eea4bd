/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes that wait for work of milliseconds: preview, pose, edit, table. They were started
   beforehand, have limits, and are started anew after a crash or a limit; the server itself never
   reads a description. Private to the room.

   Over a socket, native bytes: request {uint32 kind, uint32 n} and n bytes; answer {uint32 HTTP
   status, uint32 n} and n bytes. */
#ifndef FW_SERVE_WORKER_H
#define FW_SERVE_WORKER_H
#include "serve/request.h"
#include <poll.h>

typedef struct fw_serve_pool fw_serve_pool;

enum { FW_SERVE_WORKERS = 2, FW_SERVE_MOST_QUESTION = 1024 * 1024 }; /* bytes of a question */

typedef enum fw_serve_compute {
    FW_COMPUTE_TABLE,
    FW_COMPUTE_PREVIEW,
    FW_COMPUTE_POSE,
    FW_COMPUTE_EDIT
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

/* the other side: serves descriptor 3 until it is closed */
int fw_serve_worker_main(const char *data_directory);

#endif
