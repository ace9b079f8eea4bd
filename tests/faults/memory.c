/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A whole plan with the n-th allocation failing, once and for ever after: the answer is "out of memory"
   or (where a caller can do without) the same result; never a crash, never half a directory.
   memory DEVICE [COUNT]: COUNT values of n spread over all of them, default 120. */
#include "plan/plan.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static fw_status whole_plan(const char *device, const char *out) {
    fw_plan_options options = fw_plan_options_default();
    options.verdict.motion.samples = 101;
    fw_plan *plan = fw_plan_new(&options);
    if (!plan) return FW_NOMEM;
    fw_status status = fw_plan_load(plan, device);
    if (status == FW_OK) status = fw_plan_judge(plan);
    if (status == FW_OK) status = fw_plan_fabricate(plan);
    if (status == FW_OK) status = fw_plan_write(plan, out, FW_WRITE_ALL);
    fw_plan_free(plan);
    return status;
}

static int exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    long count = argc > 2 ? atol(argv[2]) : 120;
    char room[] = "memory-XXXXXX", out[64], command[128];
    if (!mkdtemp(room)) return 70;
    snprintf(out, sizeof out, "%s/out", room);
    snprintf(command, sizeof command, "rm -rf %s", room);
    fw_arena_fail_at(0, 0);
    int bad = whole_plan(argv[1], out) != FW_OK;
    long all = fw_arena_count(), nomem = 0, done = 0;
    for (long i = 0; i < count && !bad; i++)
        for (int ever = 0; ever < 2; ever++) {
            /* dense at the start, where each allocation is another place in the code */
            long n = i < count / 2 ? i + 1 : 1 + (all - 1) * (i - count / 2) / (count - count / 2);
            if (system(command) != 0 || mkdir(room, 0700) != 0) return 70;
            fw_arena_fail_at(n, ever);
            fw_status status = whole_plan(argv[1], out);
            fw_arena_fail_at(0, 0);
            nomem += status == FW_NOMEM;
            done += status == FW_OK;
            if ((status != FW_NOMEM && status != FW_OK) || (status == FW_OK) != exists(out)) {
                printf("allocation %ld of %ld%s: status %d, output %s\n", n, all,
                       ever ? " and all later" : "", (int)status, exists(out) ? "there" : "absent");
                bad = 1;
            }
        }
    if (system(command) != 0) return 70;
    printf("%ld allocations; %ld plans out of memory, %ld without harm, %s\n", all, nomem, done,
           bad ? "WRONG" : "all clean");
    return bad;
}
