/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "cli/cli.h"
#include "plan/design.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static int use_colour(const fw_cli_options *options, int fd) {
    if (options->colour >= 0) return options->colour;
    const char *no = getenv("NO_COLOR"), *force = getenv("FORCE_COLOR"), *term = getenv("TERM");
    if (no && *no) return 0;
    if (force && *force) return 1;
    return isatty(fd) && !(term && strcmp(term, "dumb") == 0);
}

void fw_cli_session_stage(const fw_cli_options *options, const char *stage) {
    if (options->verbose && !options->quiet) fprintf(stderr, "flexwright: %s\n", stage);
}

int fw_cli_session_no_memory(void) {
    fputs("flexwright: error: out of memory\n", stderr);
    return fw_status_exit(FW_NOMEM);
}

/* ---- progress on a terminal: a line that is written over, from the second on; elsewhere with -v a line of its own every
   ten seconds ---- */

static double now_s(void) {
    struct timespec t;
    return clock_gettime(CLOCK_MONOTONIC, &t) == 0 ? (double)t.tv_sec + 1e-9 * (double)t.tv_nsec
                                                   : 0.0;
}

static struct {
    double start_s, said_s; /* 0: nothing was said yet */
    bool lines;
    const char *what; /* of which the share below is */
    double what_s;    /* when that began */
} shown;

static int show(void *context, const char *what, double done, double of, const char *unit) {
    (void)context;
    const double now = now_s();
    if (shown.what != what) shown.what = what, shown.what_s = now;
    const double first_s = shown.lines ? 10.0 : 1.0, every_s = shown.lines ? 10.0 : 0.1;
    if (now - shown.start_s < first_s || now - shown.said_s < every_s) return 0;
    shown.said_s = now;
    fprintf(stderr, "%s%s", shown.lines ? "flexwright: " : "\r\033[K", what);
    const double since = now - shown.what_s, all = fabs(of);
    const double left = all > 0 && done > 0 ? since * (all / done - 1.0) : 0.0;
    if (all > 0)
        fprintf(stderr, ": %.3g of %s%.3g %s", done, of < 0 ? "at most " : "", all, unit);
    else if (done > 0)
        fprintf(stderr, ": %.3g %s so far", done, unit);
    if (left >= 1.0 && since >= 1.0)
        fprintf(stderr, ", %s %.0f s left", of < 0 ? "at most" : "about", left);
    else if (!(all > 0) && since >= 1.0)
        fprintf(stderr, ", %.0f s", since); /* nobody knows how many there will be */
    if (shown.lines) fprintf(stderr, " (%.0f s so far)\n", now - shown.start_s);
    fflush(stderr);
    return 0;
}

static void show_progress(fw_design *design, const fw_cli_options *options) {
    const char *term = getenv("TERM");
    const bool written_over = isatty(STDERR_FILENO) && term && *term && strcmp(term, "dumb") != 0;
    if (options->no_progress || options->quiet || !(written_over || options->verbose)) return;
    shown.lines = !written_over;
    shown.start_s = now_s();
    fw_design_progress(design, show, NULL);
}

static void clear_progress(void) {
    if (shown.said_s > 0 && !shown.lines) fputs("\r\033[K", stderr);
    shown.said_s = 0;
}

fw_design *fw_cli_session_open(fw_cli_options *options, int *exit_status) {
    options->design.jobs = options->jobs > 0 ? options->jobs : fw_processors();
    fw_design *design = fw_design_new(&options->design);
    if (!design) {
        *exit_status = fw_cli_session_no_memory();
        return NULL;
    }
    fw_plan_design_plan(design)->options.schedule.undated = !options->schedules;
    fw_plan_design_cancel_with(design, options->interrupted);
    show_progress(design, options);
    int status = FW_STATUS_OK;
    for (int i = 0; status == FW_STATUS_OK && i < options->nset; i++)
        status = fw_design_set(design, options->set[i].path, options->set[i].value);
    fw_cli_session_stage(options, "reading the description and the process packs");
    if (status == FW_STATUS_OK) status = fw_design_read(design, options->device);
    if (status != FW_STATUS_OK) {
        *exit_status = fw_cli_session_close(design, options, status, 0);
        return NULL;
    }
    return design;
}

int fw_cli_session_target(fw_design *design, const char *directory) {
    fw_plan *plan = fw_plan_design_plan(design);
    return directory ? (int)fw_output_check(plan->arena, directory, &plan->diags) : FW_STATUS_OK;
}

static int print(fw_design *design, const fw_cli_options *options, int document, FILE *to) {
    const char *text;
    size_t n;
    int detail = options->quiet ? FW_DETAIL_QUIET : options->verbose ? FW_DETAIL_VERBOSE : 0;
    fw_design_text_style(design, detail, use_colour(options, fileno(to)));
    int status = fw_design_document(design, document, &text, &n);
    clear_progress();
    if (status == FW_STATUS_OK) fwrite(text, 1, n, to);
    return status;
}

int fw_cli_session_print(fw_design *design, const fw_cli_options *options, int document) {
    return print(design, options, document, stdout);
}

int fw_cli_session_put(fw_plan *plan, const char *directory, const fw_output_member *file,
                       size_t count) {
    bool made;
    fw_status status = fw_output_directory(plan->arena, directory, &made);
    if (status == FW_OK)
        status = fw_output_members(plan->arena, directory, file, count, &plan->diags);
    if (status != FW_OK && made) rmdir(directory);
    return (int)status;
}

/* composed first, then written */
int fw_cli_session_save(fw_design *design, const char *directory, const fw_cli_session_file *file,
                        size_t count) {
    enum { FILES_MOST = 8 };
    fw_output_member member[FILES_MOST];
    if (count > FILES_MOST) return FW_STATUS_INTERNAL;
    for (size_t i = 0; i < count; i++) {
        const char *text;
        size_t n;
        int status = fw_design_document(design, file[i].document, &text, &n);
        if (status != FW_STATUS_OK) return status;
        member[i] = (fw_output_member){file[i].name, text, n};
    }
    return fw_cli_session_put(fw_plan_design_plan(design), directory, member, count);
}

bool fw_cli_session_file_on_stdout(const fw_cli_options *options) {
    const char *const file[] = {options->csv, options->forces, options->animate, options->svg,
                                options->gds};
    for (size_t i = 0; i < sizeof file / sizeof file[0]; i++)
        if (file[i] && strcmp(file[i], "-") == 0) return true;
    return false;
}

/* status: of the call that failed; want of memory has numbers of its own, beside which an error of before says nothing */
static bool error_was_said(fw_design *design, int status) {
    for (size_t i = 0; i < fw_design_diagnostics(design); i++) {
        const fw_diagnostic *d = fw_design_diagnostic(design, i);
        const bool of_memory = d->number == 720 || d->number == 721;
        if (d->severity == FW_SEVERITY_ERROR && (of_memory || status != FW_STATUS_NOMEM))
            return true;
    }
    return false;
}

int fw_cli_session_close(fw_design *design, const fw_cli_options *options, int status,
                         int result_if_ok) {
    const bool ended = status == FW_STATUS_NOMEM || status == FW_STATUS_CANCELLED;
    if (options->json && status != FW_STATUS_OK && !ended)
        print(design, options, FW_DOCUMENT_DIAGNOSTICS_JSON, stdout); /* in place of the document */
    bool said = print(design, options, FW_DOCUMENT_DIAGNOSTICS_TEXT, stderr) == FW_STATUS_OK &&
                error_was_said(design, status);
    int exit_status = status == FW_STATUS_OK ? result_if_ok : fw_status_exit((fw_status)status);
    int number = fw_cancel_requested(options->interrupted);
    bool late = status == FW_STATUS_CANCELLED && number == SIGALRM;
    if (late)
        exit_status = fw_status_exit(FW_LIMIT);
    else if (status == FW_STATUS_CANCELLED && number)
        exit_status = 128 + number;
    if (late)
        fprintf(
            stderr,
            "flexwright: error: the time limit of %g s is over; nothing was written; allow more "
            "with --time-limit, or ask for less (a lower --accuracy, one --flow, --advice none) "
            "[FW-D460]\n",
            options->time_limit_s);
    else if (status == FW_STATUS_NOMEM && said)
        fputs("flexwright: nothing was written\n", stderr);
    else if (status == FW_STATUS_NOMEM)
        fprintf(stderr,
                "flexwright: error: out of memory: a design may take %zu MiB; nothing was written; "
                "allow more with --memory, or ask for less (a lower --accuracy, one --flow, fewer "
                "steps of a <sweep>, of simulate fewer --samples)\n",
                (options->design.memory_cap ? options->design.memory_cap : FW_ARENA_USUAL) >> 20);
    else if (status != FW_STATUS_OK && !said)
        fprintf(stderr, "flexwright: error: %s; nothing was written\n", fw_status_name(status));
    fw_design_free(design);
    return exit_status;
}
