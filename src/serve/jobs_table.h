/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between jobs.c and route_jobs.c. */
#ifndef FW_SERVE_JOBS_TABLE_H
#define FW_SERVE_JOBS_TABLE_H
#include "serve/jobs.h"

struct fw_serve_jobs {
    fw_serve_job job[FW_JOBS_KEPT];
    unsigned last_id;
};

const char *fw_serve_job_state_name(fw_serve_job_state state);
double fw_serve_job_seconds(
    const fw_serve_job *job); /* since it began; of a finished one: how long it took */
/* its directory with the description in it; FW_IO when that cannot be */
fw_status fw_serve_job_prepare(fw_serve_server *server, fw_serve_job *job, const char *text,
                               size_t n);
void fw_serve_job_cancel(
    fw_serve_server *server,
    fw_serve_job *job); /* one that waits or runs: its process and files go, what it said stays */
void fw_serve_job_forget(fw_serve_server *server,
                         fw_serve_job *job); /* in any state; its files go */
bool fw_serve_job_pack(fw_serve_job *job);   /* begins the archive, unless it has begun */
void fw_serve_job_reply_archive(fw_serve_request *request, const fw_serve_job *job);

#endif
