/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `flexwright study`: many devices of one description. */
#include "cli/cli.h"
#include "plan/design.h"
#include "study/study.h"
#include <signal.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void progress(void *context, long done, long all, double seconds) {
    double *last = context;
    const long most = labs(all);
    const char *at = all < 0 ? "at most " : "";
    if (done > 0 && done < most && seconds - *last < 0.5) return;
    *last = seconds;
    double rate = seconds > 0 ? (double)done / seconds : 0;
    if (most > 0 && rate > 0)
        fprintf(stderr, "\r%ld of %s%ld devices, %.3g a second, %s%.0f s left \033[K", done, at,
                most, rate, at, (double)(most - done) / rate);
    else
        fprintf(stderr, "\r%ld devices \033[K", done);
    fflush(stderr);
}

/* the same for a program that reads: a line of -v twice a second, as of every stage */
static void progress_lines(void *context, long done, long all, double seconds) {
    double *last = context;
    if (done < labs(all) && seconds - *last < 0.5) return;
    *last = seconds;
    if (all == 0)
        fprintf(stderr, "flexwright: %ld devices\n", done);
    else
        fprintf(stderr, "flexwright: %ld of %s%ld devices\n", done, all < 0 ? "at most " : "",
                labs(all));
    fflush(stderr);
}

static fw_status print(fw_study *study, fw_status (*compose)(const fw_study *study, fw_text *out)) {
    fw_text text = fw_text_new(study->arena);
    FW_TRY(compose(study, &text));
    fputs(text.data, stdout);
    return FW_OK;
}

/* out/DEVICE-STUDY */
static fw_status settle_output(fw_study *study) {
    if (study->options.output) return FW_OK;
    FW_NEED(study->options.output =
                fw_arena_printf(study->arena, "out/%s-%s", study->device_name, study->asked->name));
    return FW_OK;
}

static void waits(void) {
    fputs("flexwright: note: another process writes into the directory; going on after it "
          "[FW-D553]\n",
          stderr);
}

static bool is_verb(const fw_cli_options *options, const char *verb) {
    return strcmp(options->device, verb) == 0;
}

/* ---- an array job ---- */

static void say_jobs(const fw_study *study, const fw_study_cluster *c) {
    const char *out = study->options.output;
    if (c->submit)
        printf("job %s: %d shards; job %s puts them together after the last one, in %s/\n"
               "squeue shows them; study slurm with --resume submits them again after a failure\n",
               c->array_job, c->shards, c->merge_job, out);
    else
        printf("%s/array.sh and merge.sh are written; nothing is submitted:\n"
               "  job=$(sbatch --parsable %s/array.sh)\n"
               "  sbatch --dependency=afterok:$job --kill-on-invalid-dep=yes %s/merge.sh\n",
               out, out, out);
}

/* the options of the line go to the tasks, but for those that say where and how they run */
static int words_of_tasks(const fw_cli_options *options, const char **word) {
    static const char *const ours[] = {"output", "shards",  "sbatch", "no-submit",
                                       "plan",   "resume",  "jobs",   "json",
                                       "quiet",  "verbose", "color",  "no-progress"};
    int n = 0;
    for (int i = 0; i < options->ngiven; i++) {
        bool stays = false;
        for (size_t k = 0; k < sizeof ours / sizeof ours[0]; k++)
            stays = stays || strcmp(options->given[i].name, ours[k]) == 0;
        for (int w = options->given[i].first; !stays && w <= options->given[i].last; w++)
            word[n++] = options->argv[w];
    }
    return n;
}

static fw_status run_on_cluster(fw_study *study, const fw_cli_options *options) {
    static char where[PATH_MAX], program[PATH_MAX];
    const char *word[2 * FW_MOST_GIVEN];
    fw_study_cluster c = {.shards = options->tasks,
                          .jobs = options->jobs > 0 ? options->jobs : 1,
                          .argument = word,
                          .nargument = words_of_tasks(options, word),
                          .sbatch = options->sbatch,
                          .nsbatch = options->nsbatch,
                          .program = realpath("/proc/self/exe", program),
                          .where = getcwd(where, sizeof where),
                          .data = getenv("FLEXWRIGHT_DATA"),
                          .submit = !options->no_submit};
    if (!c.program || !c.where) return FW_IO;
    FW_TRY(settle_output(study));
    FW_TRY(fw_study_slurm(study, &c));
    if (!options->quiet) say_jobs(study, &c);
    return FW_OK;
}

static fw_status run(fw_study *study, const fw_cli_options *options) {
    if (options->plan_only) return print(study, fw_study_plan_text);
    if (is_verb(options, "slurm")) return run_on_cluster(study, options);
    FW_TRY(settle_output(study));
    if (options->verbose && !options->quiet) {
        fw_text text = fw_text_new(study->arena);
        FW_TRY(fw_study_plan_text(study, &text));
        fputs(text.data, stderr);
    }
    fw_status status = is_verb(options, "merge")
                           ? fw_study_merge(study, options->more, options->nmore)
                           : fw_study_run(study);
    if (study->options.progress == progress) fputs("\r\033[K", stderr);
    FW_TRY(status);
    if (options->shards > 0) {
        if (!options->quiet)
            printf("shard %d of %d: %ld samples in %s/; flexwright study merge puts all shards "
                   "together\n",
                   options->shard, options->shards, fw_study_store_count(study->store),
                   study->options.output);
        return FW_OK;
    }
    FW_TRY(fw_study_write(study));
    if (options->json) return print(study, fw_study_json);
    if (options->quiet) return FW_OK;
    FW_TRY(print(study, fw_study_text));
    printf("results: %s/\n", study->options.output);
    return FW_OK;
}

/* every diagnostic, on standard error; json: on standard output too, in place of the document that there is not */
static void say(const fw_study *study, bool json) {
    fw_text text = fw_text_new(study->arena);
    if (json && fw_plan_diags_json(&study->diags, &text) == FW_OK) fputs(text.data, stdout);
    text = fw_text_new(study->arena);
    fw_diags_print(&study->diags, &text, study->options.file, study->source, study->source_length,
                   0);
    if (!text.failed && text.length) fputs(text.data, stderr);
}

static int finish(fw_study *study, const fw_cli_options *options, fw_status status) {
    int number = fw_cancel_requested(options->interrupted);
    const bool ended = status == FW_NOMEM || status == FW_CANCELLED;
    say(study, options->json && status != FW_OK && !ended);
    int exit_status = status == FW_OK ? (options->plan_only ? 0 : fw_study_decision(study))
                                      : fw_status_exit(status);
    if (status == FW_CANCELLED && number) {
        bool late = number == SIGALRM;
        exit_status = late ? fw_status_exit(FW_LIMIT) : 128 + number;
        if (study->options.output && study->store)
            fprintf(stderr, "flexwright: %s; what is done is in %s, and --resume goes on%s\n",
                    late ? "error: the time limit is over" : "stopped", study->options.output,
                    late ? " [FW-D460]" : "");
    } else if (status != FW_OK && study->diags.errors == 0) {
        fprintf(stderr, "flexwright: error: %s\n", fw_status_text(status));
    }
    fw_study_free(study);
    return exit_status;
}

/* NULL, or what is wrong with the names and the options that belong together */
static const char *wrong_line(const fw_cli_options *options) {
    if (is_verb(options, "merge"))
        return options->nmore == 0 || !options->output
                   ? "study merge needs the directories of all shards and -o DIR"
                   : NULL;
    if (!is_verb(options, "slurm")) {
        if (options->tasks > 0 || options->nsbatch > 0 || options->no_submit)
            return "--shards, --sbatch and --no-submit belong to study slurm; a shard is --shard "
                   "I/N";
        return options->nmore > 0 ? "study takes one FILE" : NULL;
    }
    if (options->nmore != 1 || strcmp(options->more[0], "-") == 0)
        return "study slurm takes one FILE, which is not standard input";
    if (options->ngiven == FW_MOST_GIVEN) return "study slurm takes fewer than 256 options";
    if (options->tasks == 0) return "study slurm needs --shards N, how many tasks there are";
    return options->shards > 0 ? "study slurm has --shards N; --shard I/N is what its tasks get"
                               : NULL;
}

int fw_cli_command_study(fw_cli_options *options) {
    double last = 0;
    const char *wrong = wrong_line(options);
    if (wrong && options->nmore > 0)
        return fw_cli_usage("%s; got '%s' and '%s'", wrong, options->device, options->more[0]);
    if (wrong) return fw_cli_usage("%s", wrong);
    fw_study_options o = {.design = options->design,
                          .set = options->set,
                          .nset = options->nset,
                          .file = is_verb(options, "slurm") ? options->more[0] : options->device,
                          .study = options->study,
                          .output = options->output,
                          .jobs = options->jobs,
                          .shard = options->shard,
                          .shards = options->shards,
                          .resume = options->resume,
                          .cancel = options->interrupted,
                          .waits = waits};
    o.timed = options->plan_only;
    if (!options->no_progress && !options->quiet && isatty(2))
        o.progress = progress, o.progress_context = &last;
    else if (options->verbose && !options->quiet)
        o.progress = progress_lines, o.progress_context = &last;
    fw_study *study;
    fw_status status = is_verb(options, "merge") ? fw_study_open_merge(&o, options->more[0], &study)
                                                 : fw_study_open(&o, &study);
    if (!study) return fw_cli_session_no_memory();
    if (status == FW_OK) status = run(study, options);
    return finish(study, options, status);
}
