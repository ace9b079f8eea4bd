/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that need no design: the local page, a new device file, an explanation, what the program
   finds. */
#include "base/output.h"
#include "cli/session.h"
#include "continuum/continuum.h"
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
