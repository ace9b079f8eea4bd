/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "cli/session.h"
#include "plan/design.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
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

/* ---- progress on a terminal: a line that is written over, from the second on ---- */

static double now_s(void) {
    struct timespec t;
    return clock_gettime(CLOCK_MONOTONIC, &t) == 0 ? (double)t.tv_sec + 1e-9 * (double)t.tv_nsec
                                                   : 0.0;
}

static struct {
    double start_s, said_s; /* 0: nothing was said yet */
    const char *what;       /* of which the share below is */
    double what_s;          /* when that began */
} shown;

static int show(void *context, const char *what, double done, double of, const char *unit) {
    (void)context;
    const double now = now_s();
    if (shown.what != what) shown.what = what, shown.what_s = now;
    if (now - shown.start_s < 1.0 || now - shown.said_s < 0.1) return 0;
    shown.said_s = now;
    fprintf(stderr, "\r\033[K%s", what);
    if (of > 0) fprintf(stderr, ": %.3g of %.3g %s", done, of, unit);
    const double left = of > 0 && done > 0 ? (now - shown.what_s) * (of / done - 1.0) : 0.0;
    if (left >= 1.0 && now - shown.what_s >= 1.0) fprintf(stderr, ", about %.0f s left", left);
    fflush(stderr);
    return 0;
}

static void show_progress(fw_design *design, const fw_cli_options *options) {
    const char *term = getenv("TERM");
    if (options->no_progress || options->quiet || !isatty(STDERR_FILENO)) return;
    if (!term || !*term || strcmp(term, "dumb") == 0) return;
    shown.start_s = now_s();
    fw_design_progress(design, show, NULL);
}

static void clear_progress(void) {
    if (shown.said_s > 0) fputs("\r\033[K", stderr);
    shown.said_s = 0;
}

fw_design *fw_cli_session_open(fw_cli_options *options, int *exit_status) {
    fw_design *design = fw_design_new(&options->design);
    if (!design) {
        fputs("flexwright: error: out of memory\n", stderr);
        *exit_status = fw_status_exit(FW_NOMEM);
        return NULL;
    }
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

enum { FILES_MOST = 8, PATH_MOST = 4200 };
typedef char file_path[PATH_MOST];

static int save_aside(fw_design *design, const char *directory, const fw_cli_session_file *file,
                      file_path aside, file_path path) {
    int a = snprintf(aside, PATH_MOST, "%s/.%s.%ld", directory, file->name, (long)getpid());
    int b = snprintf(path, PATH_MOST, "%s/%s", directory, file->name);
    if (a >= PATH_MOST || b >= PATH_MOST) return FW_STATUS_IO;
    return fw_design_save(design, file->document, aside);
}

/* all of them or none: composed first, then written under other names, which they lose at the
   end */
int fw_cli_session_save(fw_design *design, const char *directory, const fw_cli_session_file *file,
                        size_t count) {
    static file_path aside[FILES_MOST], path[FILES_MOST];
    int status = count <= FILES_MOST ? FW_STATUS_OK : FW_STATUS_INTERNAL;
    const char *text;
    size_t n, written = 0;
    for (size_t i = 0; status == FW_STATUS_OK && i < count; i++)
        status = fw_design_document(design, file[i].document, &text, &n);
    if (status != FW_STATUS_OK) return status;
    bool fabricated = mkdir(directory, 0777) == 0; /* what is wrong with it, saving will say */
    while (status == FW_STATUS_OK && written < count) {
        status = save_aside(design, directory, &file[written], aside[written], path[written]);
        written += status == FW_STATUS_OK;
    }
    for (size_t i = 0; i < written; i++)
        if (status != FW_STATUS_OK)
            unlink(aside[i]);
        else if (rename(aside[i], path[i]) != 0)
            status = FW_STATUS_IO;
    if (status != FW_STATUS_OK && fabricated) rmdir(directory);
    return status;
}

bool fw_cli_session_file_on_stdout(const fw_cli_options *options) {
    const char *const file[] = {options->csv, options->forces, options->animate, options->svg};
    for (size_t i = 0; i < sizeof file / sizeof file[0]; i++)
        if (file[i] && strcmp(file[i], "-") == 0) return true;
    return false;
}

static bool error_was_said(fw_design *design) {
    for (size_t i = 0; i < fw_design_diagnostics(design); i++)
        if (fw_design_diagnostic(design, i)->severity == FW_SEVERITY_ERROR) return true;
    return false;
}

int fw_cli_session_close(fw_design *design, const fw_cli_options *options, int status,
                         int result_if_ok) {
    const bool ended = status == FW_STATUS_NOMEM || status == FW_STATUS_CANCELLED;
    if (options->json && status != FW_STATUS_OK && !ended)
        print(design, options, FW_DOCUMENT_DIAGNOSTICS_JSON, stdout); /* in place of the document */
    bool said = print(design, options, FW_DOCUMENT_DIAGNOSTICS_TEXT, stderr) == FW_STATUS_OK &&
                error_was_said(design);
    int exit_status = status == FW_STATUS_OK ? result_if_ok : fw_status_exit((fw_status)status);
    int number = fw_cancel_requested(options->interrupted);
    if (status == FW_STATUS_CANCELLED && number) exit_status = 128 + number;
    if (status == FW_STATUS_NOMEM)
        fprintf(stderr,
                "flexwright: error: out of memory: a design may take %zu MiB; nothing was written; "
                "allow more with --memory, or ask for less (fewer --samples, a lower --accuracy)\n",
                (options->design.memory_cap ? options->design.memory_cap : FW_ARENA_USUAL) >> 20);
    else if (status != FW_STATUS_OK && !said)
        fprintf(stderr, "flexwright: error: %s; nothing was written\n", fw_status_name(status));
    fw_design_free(design);
    return exit_status;
}
