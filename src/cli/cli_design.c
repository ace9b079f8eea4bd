/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands over a design: what they do is the library's; here is what each of them asks for and
   shows. */
#include "base/output.h"
#include "cli/cli.h"
#include "plan/design.h"
#include "study/tradeoff.h"
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- verdict, masks and recipes: the exit status is the decision ---- */

/* masks and recipes are of an accepted device, and who asks for these alone may wonder what takes so long */
static int judge(fw_design *design, const fw_cli_options *options, bool waits) {
    const char *corners = options->design.corners;
    const bool drawn = corners && strcmp(corners, "none") == 0;
    fw_cli_session_stage(options,
                         waits && !drawn
                             ? "layout, mechanism, motion and verdict at the corners of what is "
                               "made, which are waited for (--corners none: as drawn)"
                             : "layout, mechanism, motion and verdict");
    return fw_design_judge(design);
}

int fw_cli_command_check(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    int status = fw_cli_session_target(design, options->output);
    if (status == FW_STATUS_OK) status = judge(design, options, false);
    if (status == FW_STATUS_OK && options->output)
        status = fw_design_write(design, options->output, FW_DESIGN_VERDICT);
    if (status == FW_STATUS_OK)
        status = fw_cli_session_print(
            design, options, options->json ? FW_DOCUMENT_VERDICT_JSON : FW_DOCUMENT_VERDICT_TEXT);
    return fw_cli_session_close(design, options, status, fw_design_decision(design));
}

/* there is no verdict on what cannot be made, but a picture of what is wrong with it */
static int show_marked(fw_design *design, const fw_cli_options *options, const char *directory) {
    fw_plan *plan = fw_plan_design_plan(design);
    fw_status status = fw_plan_write_marked(plan, directory);
    if (status != FW_OK) return (int)status;
    if (plan->files_written > 0 && !options->quiet && !options->json)
        printf("the layout cannot be made: no verdict, no masks; its drawing, with what is wrong "
               "marked: %s/device.svg\n",
               directory);
    return FW_STATUS_GEOMETRY;
}

static int make(fw_design *design, const fw_cli_options *options, unsigned what,
                const char *directory) {
    int status = fw_cli_session_target(design, directory);
    if (status == FW_STATUS_OK) status = (int)fw_plan_check_dates(fw_plan_design_plan(design));
    if (status != FW_STATUS_OK) return status;
    status = judge(design, options, what != FW_DESIGN_EVERYTHING);
    if (status == FW_STATUS_GEOMETRY && what == FW_DESIGN_EVERYTHING)
        return show_marked(design, options, directory);
    if (status != FW_STATUS_OK) return status;
    fw_cli_session_stage(options, "bias, masks and recipes");
    status = fw_design_fabricate(design);
    if (status != FW_STATUS_OK) return status;
    fw_cli_session_stage(options, "writing");
    return directory ? fw_design_write(design, directory, what) : FW_STATUS_OK;
}

static bool of_a_flow(fw_design *design) {
    const fw_plan *plan = fw_plan_design_plan(design);
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow) return true;
    return false;
}

/* why no file is there */
static void say_nothing_written(fw_design *design) {
    if (of_a_flow(design))
        puts("\nnothing was written: a rejected design gets no masks and no recipes (--force "
             "writes them, marked REJECTED)");
    else
        puts("\nnothing was written: masks and recipes are of a process flow, and the device names "
             "no <flow>");
}

/* plan, mask and recipe differ only in what is written and shown */
static int fabricate(fw_cli_options *options, unsigned what, const char *kind, int json) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    char by_name[4200]; /* a name has at most 4096 bytes */
    snprintf(by_name, sizeof by_name, "out/%s%s", fw_design_name(design), kind);
    const char *directory = options->output ? options->output : by_name;
    /* with --json alone nothing is written unless -o asks for it; plan always writes */
    if (options->json && !options->output && what != FW_DESIGN_EVERYTHING) directory = NULL;
    int status = make(design, options, what, directory);
    if (status == FW_STATUS_OK)
        status =
            fw_cli_session_print(design, options, options->json ? json : FW_DOCUMENT_VERDICT_TEXT);
    if (status == FW_STATUS_OK && !options->json) {
        if (fw_design_files_written(design) > 0)
            printf("\nresults: %s/\n", directory);
        else
            say_nothing_written(design);
    }
    return fw_cli_session_close(design, options, status, fw_design_decision(design));
}

int fw_cli_command_plan(fw_cli_options *options) {
    return fabricate(options, FW_DESIGN_EVERYTHING, "", FW_DOCUMENT_VERDICT_JSON);
}

/* the flow whose mask is asked for; NULL: there is none, or there are several, as was said */
static const fw_plan_flow *only_flow(fw_design *design) {
    const fw_plan *plan = fw_plan_design_plan(design);
    const fw_plan_flow *found = NULL;
    for (int i = 0; i < plan->nflow; i++) {
        if (!plan->flow[i].flow) continue;
        if (found) {
            fw_plan_design_usage(design, "--gds is of one flow, and the device names several: say "
                                         "which with --flow");
            return NULL;
        }
        found = &plan->flow[i];
    }
    if (!found) fw_plan_design_usage(design, "--gds: the device names no <flow>");
    return found;
}

/* the device alone as GDSII; *drawn: there is a mask */
static int draw(fw_design *design, const fw_cli_options *options, bool *drawn) {
    fw_plan *plan = fw_plan_design_plan(design);
    const fw_plan_flow *flow = only_flow(design);
    if (!flow) return FW_STATUS_USAGE;
    plan->options.drawn_alone = true;
    int status = judge(design, options, false);
    if (status != FW_STATUS_OK) return status;
    fw_cli_session_stage(options, "bias and mask");
    status = fw_design_fabricate(design);
    *drawn = flow->mask != NULL;
    if (status != FW_STATUS_OK || !*drawn) return status;
    return (int)fw_output_single(plan->arena, options->gds, flow->gds.data, flow->gds.length,
                                 &plan->diags);
}

static int mask_alone(fw_cli_options *options) {
    int exit_status;
    bool drawn = false;
    if (options->output)
        return fw_cli_usage("--gds draws the device alone, and -o writes all masks: one of them");
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    int status = draw(design, options, &drawn);
    const bool taken = drawn && fw_cli_session_file_on_stdout(options);
    if (status == FW_STATUS_OK && options->json && !taken)
        status = fw_cli_session_print(design, options, FW_DOCUMENT_MASKS_JSON);
    else if (status == FW_STATUS_OK && !taken && !options->quiet)
        status = fw_cli_session_print(design, options, FW_DOCUMENT_VERDICT_TEXT);
    if (status == FW_STATUS_OK && !drawn)
        fputs("flexwright: nothing was written: a rejected design, or one whose mask breaks rules, "
              "is drawn with --force only\n",
              stderr);
    return fw_cli_session_close(design, options, status, fw_design_decision(design));
}

int fw_cli_command_mask(fw_cli_options *options) {
    if (options->gds) return mask_alone(options);
    return fabricate(options, FW_DESIGN_MASKS, "-masks", FW_DOCUMENT_MASKS_JSON);
}

int fw_cli_command_recipe(fw_cli_options *options) {
    return fabricate(options, FW_DESIGN_RECIPES, "-recipes", FW_DOCUMENT_RECIPES_JSON);
}

/* ---- commands that compute one thing, whose exit status is that of the computation ---- */

typedef int (*computation)(fw_design *design, const fw_cli_options *options);

static int with_design(fw_cli_options *options, computation compute) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    int status = compute(design, options);
    return fw_cli_session_close(design, options, status, fw_design_unreliable(design) ? 4 : 0);
}

/* what is printed at the end is asked for at once; a file of the motion alone needs no more */
static bool prints_figures(const fw_cli_options *options) {
    return options->json || !(options->quiet || fw_cli_session_file_on_stdout(options));
}

static int simulate(fw_design *design, const fw_cli_options *options) {
    int status = fw_design_simulate(design);
    if (status == FW_STATUS_OK && options->csv)
        status = fw_design_save(design, FW_DOCUMENT_MOTION_CSV, options->csv);
    if (status == FW_STATUS_OK && options->forces)
        status = fw_design_save(design, FW_DOCUMENT_FORCES_CSV, options->forces);
    if (status == FW_STATUS_OK && options->animate)
        status = fw_design_save(design, FW_DOCUMENT_ANIMATION_SVG, options->animate);
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_MOTION_CSV, "motion.csv"},
                                               {FW_DOCUMENT_FORCES_CSV, "forces.csv"},
                                               {FW_DOCUMENT_ANIMATION_SVG, "motion.svg"}};
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, 3);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_SIMULATE_JSON);
    if (!prints_figures(options)) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_SIMULATE_TEXT);
}

int fw_cli_command_simulate(fw_cli_options *options) {
    options->design.figures = prints_figures(options);
    return with_design(options, simulate);
}

static int modes(fw_design *design, const fw_cli_options *options) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_MODES_JSON, "modes.json"},
                                               {FW_DOCUMENT_MODES_SVG, "modes.svg"}};
    int status = fw_design_modes(design);
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, 2);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_MODES_JSON);
    if (options->quiet) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_MODES_TEXT);
}

int fw_cli_command_modes(fw_cli_options *options) {
    return with_design(options, modes);
}

static int statics(fw_design *design, const fw_cli_options *options) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_STATICS_JSON, "statics.json"},
                                               {FW_DOCUMENT_STATICS_SVG, "statics.svg"},
                                               {FW_DOCUMENT_LOAD_PATH_CSV, "statics.csv"},
                                               {FW_DOCUMENT_LOAD_PATH_SVG, "path.svg"}};
    int status = fw_design_statics(design);
    if (status == FW_STATUS_OK && options->csv)
        status = fw_design_save(design, FW_DOCUMENT_LOAD_PATH_CSV, options->csv);
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, options->design.path ? 4 : 3);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_STATICS_JSON);
    if (options->quiet || fw_cli_session_file_on_stdout(options)) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_STATICS_TEXT);
}

int fw_cli_command_statics(fw_cli_options *options) {
    return with_design(options, statics);
}

/* the picture is worth most where the joints do not close: it is saved in any case */
static int save_pictures(fw_design *design, const fw_cli_options *options, bool closed) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_ASSEMBLE_SVG, "assemble.svg"},
                                               {FW_DOCUMENT_ASSEMBLE_JSON, "assemble.json"}};
    int status = FW_STATUS_OK;
    if (options->svg) status = fw_design_save(design, FW_DOCUMENT_ASSEMBLE_SVG, options->svg);
    if (status != FW_STATUS_OK || !options->output) return status;
    return fw_cli_session_save(design, options->output, file, closed ? 2 : 1);
}

static int assemble(fw_design *design, const fw_cli_options *options) {
    int status = fw_design_assemble(design);
    if (status != FW_STATUS_OK && status != FW_STATUS_SOLVER) return status;
    int saved = save_pictures(design, options, status == FW_STATUS_OK);
    if (status != FW_STATUS_OK || saved != FW_STATUS_OK)
        return status != FW_STATUS_OK ? status : saved;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_ASSEMBLE_JSON);
    if (options->quiet || fw_cli_session_file_on_stdout(options)) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_ASSEMBLE_TEXT);
}

int fw_cli_command_assemble(fw_cli_options *options) {
    return with_design(options, assemble);
}

static int workspace(fw_design *design, const fw_cli_options *options) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_WORKSPACE_JSON, "workspace.json"},
                                               {FW_DOCUMENT_WORKSPACE_SVG, "workspace.svg"},
                                               {FW_DOCUMENT_CERTIFICATE_JSON, "certificate.json"}};
    fw_cli_session_stage(options, "inverse kinematics, interval branch and bound");
    int status = fw_design_workspace(design);
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, 3);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_WORKSPACE_JSON);
    if (options->quiet) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_WORKSPACE_TEXT);
}

int fw_cli_command_workspace(fw_cli_options *options) {
    return with_design(options, workspace);
}

/* ---- `flexwright tradeoff`: what accuracy costs, for one device and scene ---- */

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

static fw_status compare(fw_plan *plan, const fw_cli_options *options) {
    const fw_study_tradeoff_options wanted = {.budget_s = options->budget_s,
                                              .times = !options->no_time,
                                              .count = !options->no_time,
                                              .argv = again(plan, options)};
    const fw_study_tradeoff *t;
    fw_text json = fw_text_new(plan->arena), text = fw_text_new(plan->arena);
    if (options->settings) return fw_study_tradeoff_settings(plan, options->settings);
    if (options->output) FW_TRY(fw_output_check(plan->arena, options->output, &plan->diags));
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
    return fw_cli_session_close(design, options, (int)compare(plan, options), 0);
}
