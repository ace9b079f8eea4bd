/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright calibrate`: measured coupons in, laboratory pack out. */
#include "process/calibrate.h"
#include "base/hash.h"
#include "base/output.h"
#include "cli/session.h"
#include <stdio.h>
#include <string.h>

enum { MOST_BYTES = 8 * 1024 * 1024 };

typedef struct work {
    fw_arena *arena;
    fw_diags diags;
    const fw_cli_options *options;
    const char *text; /* of the table, for carets */
    size_t n;
} work;

static fw_status read_data(work *w, const char *name, char **data, size_t *n) {
    const char *path;
    FW_TRY(fw_data_path(w->arena, w->options->design.data_directory, name, &path));
    if (!path)
        return fw_diag_error(&w->diags, 224, (fw_place){.file = name},
                             "there is no such process pack: correct the name of the flow, or set "
                             "FLEXWRIGHT_DATA to the directory that holds processes/");
    return fw_input_read(w->arena, path, MOST_BYTES, &w->diags, data, n);
}

static fw_status read_flow(work *w, fw_process_flow **flow) {
    char *base, *xml;
    size_t nbase, n;
    const char *name = fw_arena_printf(w->arena, "processes/%s.xml", w->options->design.flow);
    FW_NEED(name);
    FW_TRY(read_data(w, "processes/base.xml", &base, &nbase));
    FW_TRY(read_data(w, name, &xml, &n));
    return fw_process_flow_read(w->arena, "processes/base.xml", base, nbase, name, xml, n,
                                &w->diags, flow);
}

static fw_status run(work *w) {
    const char *file = w->options->device, *slash = strrchr(file, '/');
    fw_process_flow *flow;
    fw_process_measurement *row;
    fw_process_calibration found;
    char *text, hash[65];
    int nrow;
    FW_TRY(read_flow(w, &flow));
    FW_TRY(fw_input_read(w->arena, file, MOST_BYTES, &w->diags, &text, &w->n));
    w->text = text;
    fw_sha256(text, w->n, hash);
    FW_TRY(fw_process_measurements_read(w->arena, file, text, w->n, &w->diags, &row, &nrow));
    FW_TRY(fw_process_calibrate(w->arena, flow, row, nrow, &w->diags, &found));
    fw_text pack = fw_text_new(w->arena), table = fw_text_new(w->arena);
    FW_TRY(fw_process_calibration_pack(flow, &found, slash ? slash + 1 : file, hash, &pack));
    FW_TRY(fw_process_calibration_text(flow, &found, &table));
    const char *to = w->options->output ? w->options->output : "-";
    FW_TRY(fw_output_single(w->arena, to, pack.data, pack.length, &w->diags));
    if (!w->options->quiet) fputs(table.data, strcmp(to, "-") == 0 ? stderr : stdout);
    return FW_OK;
}

int fw_cli_command_calibrate(fw_cli_options *options) {
    if (!options->design.flow)
        return fw_cli_usage("calibrate needs --flow NAME: the flow that the coupons went through");
    if (strpbrk(options->design.flow, "/\\"))
        return fw_cli_usage("--flow takes the name of a flow, not a path");
    work w = {.arena = fw_arena_new(0), .options = options};
    if (!w.arena) return fw_status_exit(FW_NOMEM);
    w.diags = fw_diags_new(w.arena);
    fw_status status = run(&w);
    fw_text said = fw_text_new(w.arena);
    fw_text_add(&said, "");
    size_t kept = 0; /* notes of the pack are for plan -v */
    for (size_t i = 0; i < w.diags.count; i++)
        if (w.diags.item[i].severity > FW_NOTE || options->verbose)
            w.diags.item[kept++] = w.diags.item[i];
    w.diags.count = kept;
    fw_diags_print(&w.diags, &said, options->device, w.text, w.n, 0);
    if (!said.failed) fputs(said.data, stderr);
    if (status != FW_OK && w.diags.errors == 0)
        fprintf(stderr, "flexwright: error: %s; nothing was written\n", fw_status_text(status));
    fw_arena_free(w.arena);
    return fw_status_exit(status);
}
