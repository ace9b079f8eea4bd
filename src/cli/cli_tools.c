/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that need no design: measured coupons become a laboratory pack, the local page, a new device file, an
   explanation, what the program finds. */
#include "base/output.h"
#include "cli/cli.h"
#include "base/text.h"
#include "continuum/continuum.h"
#include "process/calibrate.h"
#include "recipe/asrun.h"
#include "report/report.h"
#include "serve/serve.h"
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

static bool somebody_looks(void) {
    const char *x = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    return isatty(STDOUT_FILENO) && ((x && *x) || (wayland && *wayland));
}

/* in the first of two processes: the second is nobody's child and outlives the server */
static _Noreturn void let_go(const char *opener, const char *page) {
    setsid();
    int none = open("/dev/null", O_RDWR);
    if (none < 0 || dup2(none, 0) < 0 || dup2(none, 1) < 0 || dup2(none, 2) < 0) _exit(1);
    close_range(3, ~0U, 0);
    signal(SIGPIPE, SIG_DFL);
    pid_t second = fork();
    if (second == 0) {
        execl(opener, "xdg-open", page, (char *)NULL);
        _exit(1);
    }
    _exit(second < 0);
}

static void open_browser(const char *page) {
    fw_arena *arena = fw_arena_new(0);
    const char *opener = NULL;
    int status = 1;
    if (arena && fw_continuum_program(arena, "xdg-open", &opener) != FW_OK) opener = NULL;
    pid_t first = opener ? fork() : -1;
    if (first == 0) let_go(opener, page);
    if (first < 0 || waitpid(first, &status, 0) != first || status != 0)
        fputs("flexwright: note: the browser could not be opened; copy the address [FW-D285]\n",
              stderr);
    fw_arena_free(arena);
}

static void ready(const char *url, const char *page, void *context) {
    const fw_cli_options *options = context;
    printf("%s\n", url);
    if (!options->quiet)
        puts("The address opens once, on this machine only. Ctrl-C ends the server.");
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) /* without it nobody would ever come */
        fprintf(stderr, "flexwright: error: standard output: %s; the address is %s\n",
                strerror(errno), url);
    if (page && !options->no_browser && somebody_looks()) open_browser(page);
}

int fw_cli_command_serve(fw_cli_options *options) {
    const fw_serve_options serve = {.device = options->device,
                                    .data_directory = options->design.data_directory,
                                    .port = options->port,
                                    .ipv6 = options->ipv6,
                                    .ready = ready,
                                    .context = options,
                                    .interrupted = options->interrupted};
    return fw_serve_run(&serve);
}

/* ---- init ---- */

/* a starter that every command accepts as it is; masses and stiffnesses come from the drawing */
static const char starter[] =
    "  <parameter name=\"arc\" value=\"240 deg\" min=\"140 deg\" max=\"260 deg\" doc=\"subtended "
    "angle of every hinge arc\"/>\n"
    "  <parameter name=\"t\" value=\"10 um\" min=\"6 um\" max=\"20 um\" doc=\"width of every "
    "flexure\"/>\n"
    "\n"
    "  <material ref=\"silicon-100\" thickness=\"50 um\"/>\n"
    "  <limits safety-factor=\"2\"/>\n"
    "  <flow ref=\"al-masked-rie\"/>\n"
    "\n"
    "  <!-- circular-arc flexures with conjugate surfaces; radius may be given instead of length "
    "-->\n"
    "  <flexure id=\"leg\" kind=\"csfh\" length=\"360 um\" angle=\"arc\" width=\"t\" gap=\"8 "
    "um\"/>\n"
    "\n"
    "  <!-- base FA, legs ABC and FED, platform CD -->\n"
    "  <six-bar>\n"
    "    <hinge at=\"A\" x=\"-0.7 mm\" y=\"-1.0 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"B\" x=\"-1.2 mm\" y=\"0 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"C\" x=\"-0.6 mm\" y=\"1.2 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"D\" x=\"0.6 mm\" y=\"1.2 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"E\" x=\"1.2 mm\" y=\"0 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"F\" x=\"0.7 mm\" y=\"-1.0 mm\" flexure=\"leg\"/>\n"
    "    <link id=\"AB\" width=\"120 um\"/>\n"
    "    <link id=\"BC\" width=\"120 um\"/>\n"
    "    <platform id=\"CD\" width=\"1.2 mm\" height=\"0.4 mm\" x=\"0 mm\" y=\"1.4 mm\"/>\n"
    "    <link id=\"DE\" width=\"120 um\"/>\n"
    "    <link id=\"EF\" width=\"120 um\"/>\n"
    "  </six-bar>\n"
    "\n"
    "  <scene name=\"push\" duration=\"10 ms\">\n"
    "    <force on=\"CD\" fx=\"0.04 mN\" fy=\"0 mN\"/>\n"
    "  </scene>\n"
    "  <workspace x-min=\"-40 um\" x-max=\"40 um\" y-min=\"-20 um\" y-max=\"20 um\" phi-min=\"-0.5 "
    "deg\" phi-max=\"0.5 deg\"/>\n"
    "</device>\n";

static int name_is_plain(const char *name) {
    size_t n = strlen(name);
    if (n == 0 || n > 64 || (name[0] >= '0' && name[0] <= '9') || name[0] == '-') return 0;
    return strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == n;
}

int fw_cli_command_init(fw_cli_options *options) {
    const char *name = options->device ? options->device : "my-device";
    if (!name_is_plain(name))
        return fw_cli_usage("a device is named with letters, digits, - and _, not '%s'", name);
    printf("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<device xmlns=\"urn:flexwright:device:1\" name=\"%s\">\n%s",
           name, starter);
    return 0;
}

/* ---- figure ---- */

enum { MOST_FIGURE = 64 << 20 };

static fw_status write_figure(fw_arena *arena, const fw_cli_options *options, fw_diags *diags) {
    char *svg;
    size_t n;
    const char *unknown;
    fw_text pdf = fw_text_new(arena);
    FW_TRY(fw_input_read(arena, options->device, MOST_FIGURE, diags, &svg, &n));
    int line = 0;
    const fw_status status = fw_report_figure_pdf(arena, svg, n, &pdf, &unknown, &line);
    const fw_place place = {options->device, line, line > 0};
    if (status == FW_INPUT && line > 0)
        return fw_diag_error(diags, 549, place,
                             "this is no picture: here it is no XML; name a .svg file that this "
                             "program wrote");
    if (status == FW_INPUT && !unknown)
        return fw_diag_error(
            diags, 549, place,
            "this is no picture: it has no element svg with a width and height; name "
            "a .svg file that this program wrote");
    if (status == FW_INPUT)
        return fw_diag_error(diags, 549, place,
                             "'%s' in it is nothing that the pictures of this program have; "
                             "convert it with another program",
                             unknown);
    FW_TRY(status);
    return fw_output_single(arena, options->output ? options->output : "-", pdf.data, pdf.length,
                            diags);
}

int fw_cli_command_figure(fw_cli_options *options) {
    if (!options->output && isatty(STDOUT_FILENO)) /* its bytes would only upset a terminal */
        return fw_cli_usage("a PDF is nothing for a terminal: name a file with -o, or send it to "
                            "another program; -o - writes it here all the same");
    fw_arena *arena = fw_arena_new(0);
    if (!arena) return fw_status_exit(FW_NOMEM);
    fw_diags diags = fw_diags_new(arena);
    const fw_status status = write_figure(arena, options, &diags);
    fw_text said = fw_text_new(arena);
    fw_diags_print(&diags, &said, options->device, NULL, 0, 0);
    if (said.length > 0) fputs(said.data, stderr);
    fw_arena_free(arena);
    return fw_status_exit(status);
}

/* ---- explain ---- */

int fw_cli_command_explain(fw_cli_options *options) {
    const char *code = options->device;
    const char *digits = code;
    if (strncasecmp(digits, "FW", 2) == 0) digits += 2;
    digits += strspn(digits, "-_ ");
    if (*digits == 'D' || *digits == 'd') digits++;
    double number;
    const fw_diag_entry *entry = NULL;
    if (fw_number_parse(digits, strlen(digits), &number) && number >= 0 && number < 1000)
        entry = fw_diag_find((int)number);
    if (!entry) return fw_cli_usage("no diagnostic '%s'; they look like FW-D041", code);
    printf("FW-D%03d: %s\n\n%s\n", entry->number, entry->title, entry->text);
    return 0;
}

/* ---- doctor ---- */

/* a file of the data directory; counts it where it is missing */
static fw_status look_for(fw_arena *arena, const fw_cli_options *options, const char *directory,
                          const char *name, int *missing) {
    const char *path, *file = fw_arena_printf(arena, "%s/%s.xml", directory, name);
    FW_NEED(file);
    FW_TRY(fw_data_path(arena, options->design.data_directory, file, &path));
    printf("%-40s %s\n", file, path ? path : "MISSING");
    *missing += !path;
    return FW_OK;
}

/* what all flows share, and every flow with its layer table */
static fw_status look_for_packs(fw_arena *arena, const fw_cli_options *options, int *missing) {
    const char *const *name = NULL;
    size_t n = 0;
    FW_TRY(look_for(arena, options, "processes", "base", missing));
    fw_status status = fw_data_names(arena, options->design.data_directory, "processes", &name, &n);
    if (status == FW_NOMEM) return status;
    if (status != FW_OK) {
        printf("%-40s %s\n", "processes/", "CANNOT BE LISTED");
        ++*missing;
    }
    for (size_t i = 0; status == FW_OK && i < n; i++) {
        if (strcmp(name[i], "base") == 0) continue;
        FW_TRY(look_for(arena, options, "processes", name[i], missing));
        FW_TRY(look_for(arena, options, "masks", name[i], missing));
    }
    return FW_OK;
}

static fw_status examine(fw_arena *arena, const fw_cli_options *options, int *missing) {
    const char *solver; /* no part of what must be there */
    FW_TRY(look_for_packs(arena, options, missing));
    FW_TRY(fw_continuum_program(arena, "ccx", &solver));
    printf("%-40s %s\n", "ccx (continuum level of hinges)", solver ? solver : fw_continuum_install);
    return FW_OK;
}

int fw_cli_command_doctor(fw_cli_options *options) {
    int missing = 0;
    printf("flexwright %s\ncompiler %s\njansson %s\n", FW_VERSION, __VERSION__, JANSSON_VERSION);
    fw_arena *arena = fw_arena_new(0);
    fw_status status = arena ? examine(arena, options, &missing) : FW_NOMEM;
    fw_arena_free(arena);
    if (status != FW_OK) return fw_cli_session_no_memory();
#if defined(__x86_64__)
    printf("processor: fma %s, avx2 %s\n", __builtin_cpu_supports("fma") ? "yes" : "no",
           __builtin_cpu_supports("avx2") ? "yes" : "no");
#endif
    return missing ? fw_status_exit(FW_IO) : 0;
}

/* ---- `flexwright calibrate`: measured coupons in, laboratory pack out ---- */

enum { MOST_BYTES = 8 * 1024 * 1024, MOST_LAB_BYTES = 1024 * 1024, MOST_LABS = 8 };

typedef struct lab { /* a laboratory pack */
    const char *file, *xml;
    size_t n;
} lab;

typedef struct work {
    fw_arena *arena;
    fw_diags diags;
    const fw_cli_options *options;
    const char *text; /* of the table, for carets */
    size_t n;
    lab lab[MOST_LABS]; /* (nlab) */
    int nlab;
    const char *packs; /* their names; NULL: none */
} work;

static fw_status read_data(work *w, const char *name, char **data, size_t *n) {
    const char *path, *const *pack, *near = NULL;
    size_t npack;
    FW_TRY(fw_data_path(w->arena, w->options->design.data_directory, name, &path));
    if (!path) {
        FW_TRY(
            fw_data_names(w->arena, w->options->design.data_directory, "processes", &pack, &npack));
        if (w->options->design.flow) near = fw_did_you_mean(w->options->design.flow, pack, npack);
        return fw_diag_error(&w->diags, 224, (fw_place){.file = name},
                             "there is no such process pack%s%s%s: correct the name of the flow, "
                             "or set FLEXWRIGHT_DATA to the directory that holds processes/",
                             FW_DID_YOU_MEAN(near));
    }
    return fw_input_read(w->arena, path, MOST_BYTES, &w->diags, data, n);
}

/* the laboratory packs that the results are for use with */
static fw_status read_packs(work *w) {
    const char *at = w->options->design.laboratory ? w->options->design.laboratory : "", *of;
    fw_text said = fw_text_new(w->arena);
    for (size_t n; *at; at += n + (at[n] == ',')) {
        lab *l = &w->lab[w->nlab];
        char hash[65], *xml;
        fw_place place;
        n = strcspn(at, ",");
        if (w->nlab == MOST_LABS)
            return fw_diag_error(&w->diags, 211, (fw_place){0}, "more than %d laboratory packs",
                                 MOST_LABS);
        FW_NEED(l->file = fw_arena_strndup(w->arena, at, n));
        FW_TRY(fw_input_read(w->arena, l->file, MOST_LAB_BYTES, &w->diags, &xml, &l->n));
        l->xml = xml;
        FW_TRY(fw_process_lab_flow(w->arena, l->file, l->xml, l->n, &of, &place));
        if (*of && strcmp(of, w->options->design.flow) != 0)
            return fw_diag_error(&w->diags, 211, place,
                                 "this laboratory pack is for the flow '%s', and the coupons went "
                                 "through '%s'",
                                 of, w->options->design.flow);
        const char *slash = strrchr(l->file, '/');
        fw_sha256(l->xml, l->n, hash);
        fw_text_printf(&said, "%s%s (SHA-256 %.16s)", w->nlab ? ", " : "",
                       slash ? slash + 1 : l->file, hash);
        w->nlab++;
    }
    if (w->nlab == 0) return FW_OK;
    FW_TRY(fw_text_end(&said));
    w->packs = said.data;
    return FW_OK;
}

/* with the values of the laboratory, and the steps as it does them */
static fw_status read_flow(work *w, fw_process_flow **flow) {
    char *base, *xml;
    size_t nbase, n;
    fw_process_choice *choice = NULL;
    int nchoice = 0;
    const char *name = fw_arena_printf(w->arena, "processes/%s.xml", w->options->design.flow);
    FW_NEED(name);
    FW_TRY(read_data(w, "processes/base.xml", &base, &nbase));
    FW_TRY(read_data(w, name, &xml, &n));
    FW_TRY(read_packs(w));
    for (int i = 0; i < w->nlab; i++)
        FW_TRY(fw_process_lab_choices(w->arena, w->lab[i].file, w->lab[i].xml, w->lab[i].n,
                                      w->options->design.flow, &choice, &nchoice));
    FW_TRY(fw_process_flow_read_chosen(w->arena, "processes/base.xml", base, nbase, name, xml, n,
                                       choice, nchoice, NULL, &w->diags, flow));
    for (int i = 0; i < w->nlab; i++)
        FW_TRY(fw_process_lab_apply(w->arena, w->lab[i].file, w->lab[i].xml, w->lab[i].n, *flow,
                                    &w->diags));
    return fw_process_lab_ask(w->arena, *flow, &w->diags);
}

static fw_status of_table(work *w, const fw_process_flow *flow, const char *file, const char *text,
                          fw_process_calibration *found) {
    fw_process_measurement *row;
    int nrow;
    if (w->options->without || w->options->all_runs)
        return fw_diag_error(&w->diags, 211, (fw_place){.file = file},
                             "a table has neither wafers nor runs: --without and --all-runs are "
                             "for the as-run log of a lot; leave rows out of the table itself");
    FW_TRY(fw_process_measurements_read(w->arena, file, text, w->n, &w->diags, &row, &nrow));
    const fw_process_measurement **each =
        fw_arena_array(w->arena, const fw_process_measurement *, (size_t)nrow + 1);
    FW_NEED(each);
    for (int i = 0; i < nrow; i++)
        each[i] = &row[i];
    FW_TRY(fw_process_measurements_ask(flow, each, nrow, true, file, &w->diags));
    FW_TRY(fw_process_calibrate(w->arena, flow, row, nrow, &w->diags, found));
    FW_TRY(fw_process_calibration_correlate(w->arena, flow, row, nrow, found));
    return fw_process_calibration_keep_spread(w->arena, flow, found);
}

/* a log is verified as far as it can be without its device: chain, head and entries, not the plan's hash */
static fw_status of_log(work *w, const fw_process_flow *flow, const char *file, const char *text,
                        const char *hash, fw_process_calibration *found) {
    const char *slash = strrchr(file, '/');
    fw_recipe_asrun run;
    fw_process_readings readings;
    FW_TRY(fw_recipe_asrun_read(w->arena, flow, NULL, file, text, w->n, &w->diags, &run));
    FW_TRY(fw_cli_check_head(w->arena, &w->diags, file, true, &run));
    const fw_recipe_counted counted = {.all_runs = w->options->all_runs,
                                       .without = w->options->without};
    FW_TRY(fw_recipe_asrun_readings(w->arena, &run, &counted, &w->diags, &readings));
    readings.file = slash ? slash + 1 : file;
    readings.sha256 = hash;
    const fw_process_measurement **each =
        fw_arena_array(w->arena, const fw_process_measurement *, (size_t)readings.n + 1);
    FW_NEED(each);
    for (int i = 0; i < readings.n; i++)
        each[i] = &readings.item[i].row;
    FW_TRY(fw_process_measurements_ask(flow, each, readings.n, false, file, &w->diags));
    return fw_process_calibrate_wafers(w->arena, flow, &readings, &w->diags, found);
}

/* what was read of the value that a message names: a lab has no 'u' to correct there, but wafers that differ */
static const char *with_readings(work *w, const fw_process_calibration *found,
                                 const char *message) {
    for (int i = 0; i < found->count; i++) {
        const fw_process_calibrated *c = &found->item[i];
        const char *name = fw_arena_printf(w->arena, "'%s'", c->id);
        if (!name) return NULL;
        if (!strstr(message, name)) continue;
        return fw_arena_printf(
            w->arena,
            "%s. It comes of %s (%s): measure more wafers, or leave out what was "
            "read where a step was repeated or went otherwise than planned",
            message, c->source ? c->source : c->coupon, c->note);
    }
    return message;
}

/* what --lab would not take is not written: the same questions, asked of the flow with these values */
static fw_status is_taken(work *w, fw_process_flow *flow, const fw_process_calibration *found,
                          const fw_text *pack) {
    fw_diags said = fw_diags_new(w->arena);
    fw_status status =
        fw_process_lab_apply(w->arena, "calibrated", pack->data, pack->length, flow, &said);
    if (said.failed) return FW_NOMEM;
    for (size_t i = 0; i < said.count; i++)
        if (said.item[i].severity == FW_ERROR) {
            fw_diag d = said.item[i];
            d.place = (fw_place){.file = w->options->device};
            FW_NEED(d.message = with_readings(w, found, d.message));
            fw_diags_add(&w->diags, &d, FW_ERROR);
        }
    return w->diags.failed ? FW_NOMEM : status;
}

static fw_status run(work *w) {
    const char *file = w->options->device, *slash = strrchr(file, '/');
    fw_process_flow *flow;
    fw_process_calibration found;
    char *text, hash[65];
    FW_TRY(read_flow(w, &flow));
    FW_TRY(fw_input_read(w->arena, file, MOST_BYTES, &w->diags, &text, &w->n));
    w->text = text;
    fw_sha256(text, w->n, hash);
    if (fw_recipe_asrun_is_log(text, w->n))
        FW_TRY(of_log(w, flow, file, text, hash, &found));
    else
        FW_TRY(of_table(w, flow, file, text, &found));
    found.packs = w->packs;
    fw_process_calibration_ask(flow, &found, file, &w->diags);
    fw_text pack = fw_text_new(w->arena), table = fw_text_new(w->arena);
    FW_TRY(fw_process_calibration_pack(flow, &found, slash ? slash + 1 : file, hash, &pack));
    FW_TRY(fw_process_calibration_text(flow, &found, &table));
    FW_TRY(is_taken(w, flow, &found, &pack));
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
    if (!w.arena) return fw_cli_session_no_memory();
    w.diags = fw_diags_new(w.arena);
    fw_status status = run(&w);
    fw_text said = fw_text_new(w.arena);
    fw_text_add(&said, "");
    size_t kept = 0; /* notes of the pack are for plan -v */
    for (size_t i = 0; i < w.diags.count; i++)
        if (w.diags.item[i].severity != FW_NOTE || options->verbose)
            w.diags.item[kept++] = w.diags.item[i];
    w.diags.count = kept;
    fw_diags_print(&w.diags, &said, options->device, w.text, w.n, 0);
    if (!said.failed) fputs(said.data, stderr);
    if (status == FW_NOMEM)
        fw_cli_session_no_memory();
    else if (status != FW_OK && w.diags.errors == 0)
        fprintf(stderr, "flexwright: error: %s; nothing was written\n", fw_status_text(status));
    fw_arena_free(w.arena);
    return fw_status_exit(status);
}
