/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright tradeoff`: what accuracy costs, for one device and scene. */
#include "study/tradeoff.h"
#include "base/output.h"
#include "cli/session.h"
#include "plan/design.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { MOST_WORDS = 280 };

/* this program and its arguments; NULL: the device was standard input, which is gone */
static const char *const *again(fw_plan *plan, const fw_cli_options *options) {
    char path[4096];
    ssize_t n = readlink("/proc/self/exe", path, sizeof path - 1);
    const char **words = fw_arena_alloc(plan->arena, MOST_WORDS + 1, sizeof *words);
    if (n <= 0 || !words || strcmp(options->device, "-") == 0) return NULL;
    path[n] = '\0';
    words[0] = fw_arena_strdup(plan->arena, path);
    for (int i = 1; options->argv[i]; i++) {
        if (i == MOST_WORDS) return NULL;
        words[i] = options->argv[i];
    }
    return words[0] ? words : NULL;
}

static fw_status save(fw_plan *plan, const fw_study_tradeoff *t, const fw_text *json,
                      const char *path) {
    fw_text csv = fw_text_new(plan->arena), svg = fw_text_new(plan->arena);
    fw_output *output;
    FW_TRY(fw_study_tradeoff_csv(t, &csv));
    FW_TRY(fw_study_tradeoff_svg(t, &svg));
    FW_TRY(fw_output_open(plan->arena, path, &plan->diags, &output));
    fw_status status = fw_output_write(output, "tradeoff.json", json->data, json->length);
    if (status == FW_OK) status = fw_output_write(output, "tradeoff.csv", csv.data, csv.length);
    if (status == FW_OK) status = fw_output_write(output, "tradeoff.svg", svg.data, svg.length);
    if (status == FW_OK) status = fw_output_commit(output);
    fw_output_abort(output);
    return status;
}

static fw_status run(fw_plan *plan, const fw_cli_options *options) {
    const fw_study_tradeoff_options wanted = {.budget_s = options->budget_s,
                                              .times = !options->no_time,
                                              .count = !options->no_time,
                                              .argv = again(plan, options)};
    const fw_study_tradeoff *t;
    fw_text json = fw_text_new(plan->arena), text = fw_text_new(plan->arena);
    if (options->settings) return fw_study_tradeoff_settings(plan, options->settings);
    fw_cli_session_stage(options, "running the scene by every method, integrator and tolerance");
    FW_TRY(fw_study_tradeoff_run(plan, &wanted, &t));
    if (options->json || options->output) FW_TRY(fw_study_tradeoff_json(t, &json));
    if (options->output) FW_TRY(save(plan, t, &json, options->output));
    if (!options->json && options->quiet) return FW_OK;
    if (!options->json) FW_TRY(fw_study_tradeoff_text(t, &text));
    fputs(options->json ? json.data : text.data, stdout);
    return FW_OK;
}

int fw_cli_command_tradeoff(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    fw_plan *plan = fw_plan_design_plan(design);
    return fw_cli_session_close(design, options, (int)run(plan, options), 0);
}
