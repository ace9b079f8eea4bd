/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancel.h"
#include "cli/session.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int use_colour(const fw_cli_options *options, int fd) {
    if (options->colour >= 0) return options->colour;
    const char *no = getenv("NO_COLOR"), *force = getenv("FORCE_COLOR"), *term = getenv("TERM");
    if (no && *no) return 0;
    if (force && *force) return 1;
    return isatty(fd) && !(term && strcmp(term, "dumb") == 0);
}

void fw_session_stage(const fw_cli_options *options, const char *stage) {
    if (options->verbose && !options->quiet) fprintf(stderr, "flexwright: %s\n", stage);
}

fw_plan *fw_session_open(fw_cli_options *options, int *exit_status) {
    fw_plan *plan = fw_plan_new(&options->plan);
    if (!plan) {
        fputs("flexwright: error: out of memory\n", stderr);
        *exit_status = fw_status_exit(FW_NOMEM);
        return NULL;
    }
    fw_session_stage(options, "reading the description and the process packs");
    fw_status status = fw_plan_load(plan, options->device);
    if (status != FW_OK) {
        *exit_status = fw_session_close(plan, options, status, 0);
        return NULL;
    }
    return plan;
}

static void keep_serious(fw_diags *diags, const fw_cli_options *options) {
    size_t kept = 0;
    for (size_t i = 0; i < diags->count; i++) {
        fw_severity s = diags->item[i].severity;
        if (s == FW_ERROR || (s == FW_WARNING && !options->quiet) ||
            (s == FW_NOTE && options->verbose))
            diags->item[kept++] = diags->item[i];
    }
    diags->count = kept;
}

int fw_session_close(fw_plan *plan, const fw_cli_options *options, fw_status status,
                     int result_if_ok) {
    fw_text text = fw_text_new(plan->arena);
    keep_serious(&plan->diags, options);
    fw_diags_print(&plan->diags, &text, plan->source_file, plan->source, plan->source_length,
                   use_colour(options, STDERR_FILENO));
    if (text.length) fwrite(text.data, 1, text.length, stderr);
    int exit_status = status == FW_OK ? result_if_ok : fw_status_exit(status);
    if (status == FW_CANCELLED && fw_cancel_requested()) exit_status = 128 + fw_cancel_requested();
    if (status != FW_OK && (plan->diags.errors == 0 || status == FW_NOMEM))
        fprintf(stderr, "flexwright: error: %s; nothing was written\n", fw_status_text(status));
    fw_plan_free(plan);
    return exit_status;
}

int fw_session_result(const fw_plan *plan) {
    if (plan->verdict.decision == FW_REJECT) return 1;
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow && plan->flow[i].flow->manufacturable == 0) return 1;
    return plan->verdict.decision == FW_INCONCLUSIVE ? 4 : 0;
}

void fw_session_print(const fw_text *text) {
    if (text->data) fwrite(text->data, 1, text->length, stdout);
}

const char *fw_session_directory(fw_plan *plan, const fw_cli_options *options) {
    return options->output ? options->output
                           : fw_arena_printf(plan->arena, "out/%s", plan->device->name);
}

/* ---- the verdict for people ---- */

static const char *short_number(char buffer[32], double value, int digits) {
    return fw_number_text(buffer, 32, value, digits);
}

static void print_hinge(const fw_hinge_verdict *h) {
    double degrees = 180.0 / acos(-1.0);
    printf("  %-6s %8.2f deg %7.2f deg %7.3f %% %6.1f %%  %5.1f..%-5.1f  %-12s %s%s%s%s\n", h->id,
           h->peak_angle_rad * degrees, h->limit_angle_rad * degrees, 100.0 * h->peak_strain,
           100.0 * h->utilisation, 100.0 * h->utilisation_low, 100.0 * h->utilisation_high,
           fw_decision_text(h->decision), h->scene, h->flow ? " (" : "", h->flow ? h->flow : "",
           h->flow ? ")" : "");
}

/* the first reasons; all of them with -v and in the report */
static void print_flow(const fw_plan_flow *pf, const fw_cli_options *options) {
    enum { FEW = 3 };
    const fw_flow *f = pf->flow;
    printf("\nflow %s: manufacturable: %s\n", pf->use->ref,
           f->manufacturable > 0    ? "yes"
           : f->manufacturable == 0 ? "NO"
                                    : "not guaranteed");
    int shown = options->verbose || f->nreason <= FEW ? f->nreason : FEW;
    for (int i = 0; i < shown; i++)
        printf("  - %s\n", f->reason[i]);
    if (shown < f->nreason)
        printf("  and %d more (in the report, or with -v)\n", f->nreason - shown);
    char hours[32];
    printf("  %d steps, computed times add up to %s h; %d steps not computable\n", f->nstep,
           short_number(hours, f->total_s / 3600.0, 3), f->not_computable);
}

static void print_advice(const fw_verdict *v) {
    if (v->nadvice == 0 && !v->advice_note) return;
    printf("\nwhat to change:\n");
    for (int i = 0; i < v->nadvice; i++)
        printf("  %s\n    --set \"%s=%s\"\n", v->advice[i].text, v->advice[i].set_path,
               v->advice[i].value_text);
    if (v->advice_note) printf("  %s\n", v->advice_note);
}

void fw_session_print_verdict(const fw_plan *plan, const fw_cli_options *options) {
    const fw_verdict *v = &plan->verdict;
    static const char *const word[] = {"ACCEPT", "INCONCLUSIVE", "REJECT"};
    static const char *const paint[] = {"\033[1;32m", "\033[1;33m", "\033[1;31m"};
    int colour = use_colour(options, STDOUT_FILENO);
    printf("%s: %s%s%s\n", plan->device->name, colour ? paint[v->decision] : "", word[v->decision],
           colour ? "\033[0m" : "");
    if (v->governing != FW_NONE) {
        const fw_hinge_verdict *h = &v->hinge[v->governing];
        char t[32];
        printf("governing hinge %s: %.1f %% of the elastic limit in %s%s%s%s%s%s\n", h->id,
               100.0 * h->utilisation, h->scene, isnan(h->t_s) ? "" : " at ",
               isnan(h->t_s) ? "" : short_number(t, h->t_s * 1e3, 4), isnan(h->t_s) ? "" : " ms",
               h->flow ? ", flow " : "", h->flow ? h->flow : "");
    }
    if (!options->quiet) {
        printf("\n  hinge      peak       limit     strain    used  band %%        verdict      "
               "in\n");
        for (int k = 0; k < v->nhinge; k++)
            print_hinge(&v->hinge[k]);
    }
    print_advice(v);
    for (int i = 0; !options->quiet && v->decision != FW_REJECT && i < plan->nflow; i++)
        if (plan->flow[i].flow) print_flow(&plan->flow[i], options);
}
