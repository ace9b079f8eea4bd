/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/serve.h"
#include "cli/session.h"
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

/* twice forked, so that the browser is nobody's child and outlives the server */
static void open_browser(const char *page) {
    pid_t first = fork();
    if (first != 0) {
        int status = 0;
        if (first < 0 || waitpid(first, &status, 0) != first || !WIFEXITED(status) ||
            WEXITSTATUS(status))
            fputs("flexwright: note: the browser could not be opened; copy the address [FW-D285]\n",
                  stderr);
        return;
    }
    setsid();
    int none = open("/dev/null", O_RDWR);
    if (none < 0 || dup2(none, 0) < 0 || dup2(none, 1) < 0 || dup2(none, 2) < 0) _exit(1);
    close_range(3, ~0U, 0);
    signal(SIGPIPE, SIG_DFL);
    pid_t second = access("/usr/bin/xdg-open", X_OK) == 0 ? fork() : -1;
    if (second == 0) {
        execl("/usr/bin/xdg-open", "xdg-open", page, (char *)NULL);
        _exit(1);
    }
    _exit(second < 0);
}

static void ready(const char *url, const char *page, void *context) {
    const fw_cli_options *options = context;
    printf("%s\n", url);
    if (!options->quiet)
        puts("The address opens once, on this machine only. Ctrl-C ends the server.");
    fflush(stdout);
    if (page && !options->no_browser && somebody_looks()) open_browser(page);
}

int fw_command_serve(fw_cli_options *options) {
    const fw_serve_options serve = {.device = options->device,
                                    .data_directory = options->design.data_directory,
                                    .port = options->port,
                                    .ipv6 = options->ipv6,
                                    .ready = ready,
                                    .context = options};
    return fw_serve_run(&serve);
}
