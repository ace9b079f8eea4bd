/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/serve.h"
#include "cli/session.h"
#include "continuum/continuum.h"
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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
    const char *opener = arena ? fw_continuum_program(arena, "xdg-open") : NULL;
    int status = 1;
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
    fflush(stdout);
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
