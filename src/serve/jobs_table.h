/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between jobs.c and route_jobs.c. */
#ifndef FW_SERVE_JOBS_TABLE_H
#define FW_SERVE_JOBS_TABLE_H
#include "serve/jobs.h"

struct fw_jobs {
    fw_job job[FW_JOBS_KEPT];
    unsigned last_id;
};

const char *fw_job_state_name(fw_job_state state);
double fw_job_seconds(const fw_job *job); /* since it began; of a finished one: how long it took */
/* its directory with the description in it; FW_IO when that cannot be */
fw_status fw_job_prepare(fw_server *server, fw_job *job, const char *text, size_t n);
void fw_job_cancel(
    fw_server *server,
    fw_job *job); /* one that waits or runs: its process and files go, what it said stays */
void fw_job_forget(fw_server *server, fw_job *job); /* in any state; its files go */
bool fw_job_pack(fw_job *job);                      /* begins the archive, unless it has begun */
void fw_job_reply_archive(fw_request *request, const fw_job *job);

#endif
