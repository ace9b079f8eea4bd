/* SPDX-License-Identifier: GPL-3.0-or-later */
/* lint_packs BASE FLOW...: what reading, computing and scheduling a flow says, a line each of file, severity, number and
   message, tab between them; a flow that nothing is said of has the line "file, accepted". For tests/process/orders.py. */
#include "base/output.h"
#include "process/plain_facts.h"
#include "schedule/schedule.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *text_of(fw_arena *arena, const char *path, size_t *n) {
    fw_diags diags = fw_diags_new(arena);
    char *data = NULL;
    if (fw_input_read(arena, path, 1u << 23, &diags, &data, n) == FW_OK) return data;
    fprintf(stderr, "cannot read %s\n", path);
    exit(2);
}

static void judge(const char *base_file, const char *file) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_process_flow *flow = NULL;
    const fw_schedule *schedule;
    fw_schedule_options options = {.wafers = 1, .operators = 1, .day = "none"};
    size_t nb = 0, n = 0;
    const char *base = text_of(arena, base_file, &nb), *text = text_of(arena, file, &n);
    int said = 0;
    if (fw_process_flow_read(arena, base_file, base, nb, file, text, n, &diags, &flow) == FW_OK &&
        fw_process_flow_compute(arena, flow, &plain_facts, &diags) == FW_OK)
        fw_schedule_make(arena, flow, &options, &diags, &schedule);
    for (size_t i = 0; i < diags.count; i++) {
        const fw_diag *d = &diags.item[i];
        if (d->severity == FW_NOTE) continue;
        printf("%s\t%s\tFW-D%d\t%s\n", file, d->severity == FW_ERROR ? "error" : "warning",
               d->number, d->message);
        said++;
    }
    if (!said) printf("%s\taccepted\n", file);
    fw_arena_free(arena);
}

int main(int argc, char **argv) {
    for (int i = 2; i < argc; i++)
        judge(argv[1], argv[i]);
    return argc < 3 ? 2 : 0;
}
