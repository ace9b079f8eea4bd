/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CPU time of certified workspaces: design, limit (deg), bracket (um2 rad), relative width, boxes,
   ms.
   No arguments. */
#include "../unit/workspace/six_bar_fixture.h"
#include "measure.h"
#include "workspace/reach.h"

typedef struct job {
    fw_arena *arena;
    const fw_workspace_loop *loop;
    fw_workspace_reach_limits limits;
    fw_workspace_proof_effort effort;
    fw_workspace_measure out;
} job;

static outcome run(void *context) {
    job *j = context;
    double start = cpu_seconds();
    fw_status status = fw_workspace_reach_volume(j->arena, j->loop, &j->limits, j->effort, &j->out);
    return (outcome){.cpu_s = cpu_seconds() - start, .failed = status ? "status" : NULL};
}

int main(void) {
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_loop loop;
    if (!fw_workspace_loop_set_up(&f.mechanism, &loop)) return 1;
    printf("limit_deg,wanted,low_um2rad,high_um2rad,relative,boxes,ms\n");
    const double deg[] = {2, 5, 10, 15}, relative[] = {1e-2, 1e-3, 5e-4};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            double limit[FW_SIX];
            for (int h = 0; h < FW_SIX; h++)
                limit[h] = deg[i] * acos(-1.0) / 180.0;
            job j = {.arena = fw_arena_new(0), .loop = &loop};
            j.limits = fw_workspace_limits_symmetric(limit);
            j.effort = (fw_workspace_proof_effort){relative[k], 5000000};
            outcome o = measure(run, &j);
            printf("%g,%g,%.6f,%.6f,%.3e,%ld,%.2f\n", deg[i], relative[k], j.out.value.lo * 1e12,
                   j.out.value.hi * 1e12, j.out.value.hi / j.out.value.lo - 1, j.out.boxes,
                   o.cpu_s * 1e3);
            fw_arena_free(j.arena);
        }
    return 0;
}
