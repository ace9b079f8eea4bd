/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/append.h"
#include "base/hash.h"
#include "base/output.h"
#include "cli/session.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "recipe/asrun.h"
#include <stdio.h>
#include <string.h>

static const size_t LARGEST_LOG = 16u << 20;

/* the one flow that the log is about */
static fw_plan_flow *flow_of(fw_plan *plan) {
    fw_plan_flow *found = NULL;
    for (int i = 0; i < plan->nflow; i++) {
        if (!plan->flow[i].flow) continue;
        if (found) return NULL;
        found = &plan->flow[i];
    }
    return found;
}

/* of recipes/FLOW.json, as the manifest has it */
static fw_status hash_of(fw_plan *plan, const fw_plan_flow *pf, char hash[65]) {
    fw_text text = fw_text_new(plan->arena);
    fw_recipe_header header = fw_plan_recipe_header(plan, pf);
    FW_TRY(fw_recipe_write_json(pf->flow, &header, &text));
    fw_sha256(text.data, text.length, hash);
    return FW_OK;
}

static fw_status show(fw_plan *plan, const fw_process_flow *flow, const fw_recipe_asrun *run,
                      bool json) {
    fw_text text = fw_text_new(plan->arena);
    FW_TRY(json ? fw_recipe_asrun_write_json(flow, run, &text)
                : fw_recipe_asrun_write_text(flow, run, &text));
    fwrite(text.data, 1, text.length, stdout);
    return FW_OK;
}

static fw_status read_log(fw_plan *plan, const fw_plan_flow *pf, const char *hash,
                          const fw_cli_options *options) {
    char *text;
    size_t n;
    fw_recipe_asrun run;
    FW_TRY(fw_input_read(plan->arena, options->run, LARGEST_LOG, &plan->diags, &text, &n));
    FW_TRY(fw_recipe_asrun_read(plan->arena, pf->flow, hash, options->run, text, n, &plan->diags,
                                &run));
    return show(plan, pf->flow, &run, options->json);
}

/* the file is locked from here to the end, so that two entries never have one line before them */
static fw_status add_to(fw_append *file, fw_plan *plan, const fw_plan_flow *pf, const char *hash,
                        const fw_cli_options *options) {
    fw_recipe_asrun run = {0};
    const char *first = "", *line;
    if (file->n == 0) {
        FW_TRY(fw_recipe_asrun_begin(plan->arena, pf->flow, hash, options->lot, &first));
        FW_TRY(fw_recipe_asrun_read(plan->arena, pf->flow, hash, options->run, first, strlen(first),
                                    &plan->diags, &run));
    } else {
        FW_TRY(fw_recipe_asrun_read(plan->arena, pf->flow, hash, options->run, file->text, file->n,
                                    &plan->diags, &run));
    }
    FW_TRY(fw_recipe_asrun_add(plan->arena, pf->flow, &run, options->entry, &plan->diags, &line));
    const char *all = fw_arena_printf(plan->arena, "%s%s", first, line);
    FW_NEED(all);
    FW_TRY(fw_append_text(file, all, strlen(all)));
    if (!options->quiet) printf("%s: entry %d\n", options->run, run.nentry + 1);
    return FW_OK;
}

static fw_status keep(fw_plan *plan, const fw_cli_options *options) {
    fw_plan_flow *pf = flow_of(plan);
    char hash[65];
    if (!pf)
        return fw_diag_error(&plan->diags, 230, (fw_place){0},
                             "a log is about one flow: name it with --flow");
    FW_TRY(hash_of(plan, pf, hash));
    if (!options->entry) return read_log(plan, pf, hash, options);
    fw_append file;
    FW_TRY(fw_append_open(plan->arena, options->run, LARGEST_LOG, &plan->diags, &file));
    fw_status status = add_to(&file, plan, pf, hash, options);
    fw_append_close(&file);
    return status;
}

int fw_cli_command_log(fw_cli_options *options) {
    int exit_status;
    if (!options->run) return fw_cli_usage("log needs --run FILE, the log");
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    int status = fw_design_judge(design);
    if (status == FW_STATUS_OK) status = fw_design_fabricate(design);
    fw_plan *plan = fw_plan_design_plan(design);
    if (status == FW_STATUS_OK && plan->verdict.decision == FW_REJECT)
        status = (int)fw_diag_error(&plan->diags, 281, (fw_place){0},
                                    "the design is rejected: there is no recipe to run");
    if (status == FW_STATUS_OK) status = (int)keep(plan, options);
    return fw_cli_session_close(design, options, status, 0);
}
