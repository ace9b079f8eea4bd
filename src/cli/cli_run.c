/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"
#include "cli/options.h"
#include "cli/session.h"
#include "serve/serve.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

/* the first signal asks to stop, the second one stops; a handler sees nothing but what is static */
static fw_cancel interrupted;

static void on_signal(int number) {
    if (fw_cancel_requested(&interrupted)) _exit(128 + number);
    fw_cancel_request(&interrupted, number);
}

/* the end of what --time-limit allows is a request to stop like another */
static void on_alarm(int number) {
    if (!fw_cancel_requested(&interrupted)) fw_cancel_request(&interrupted, number);
}

static void start_clock(double limit_s) {
    if (limit_s <= 0) return;
    struct sigaction late = {.sa_handler = on_alarm, .sa_flags = SA_RESTART};
    double whole = floor(limit_s), part = fmax(limit_s - whole, 1e-6); /* 0 would be never */
    struct itimerval in = {
        .it_value = {.tv_sec = (time_t)whole, .tv_usec = (suseconds_t)(1e6 * part)}};
    sigaction(SIGALRM, &late, NULL);
    setitimer(ITIMER_REAL, &in, NULL);
}

static void catch_signals(void) {
    struct sigaction stop = {.sa_handler = on_signal}, ignore = {.sa_handler = SIG_IGN};
    sigaction(SIGINT, &stop, NULL);
    sigaction(SIGTERM, &stop, NULL);
    sigaction(SIGPIPE, &ignore, NULL); /* a closed pipe is an input/output error like others */
    sigaction(SIGXFSZ, &ignore, NULL);
}

static int last_words(int status) {
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fputs("flexwright: error: standard output could not be written [FW-D222]\n", stderr);
        return fw_status_exit(FW_IO);
    }
    return status;
}

/* the clock on the wall, seconds since 1970-01-01T00:00 there; NaN: there is none. Nothing that is computed depends on it: an
   entry of a log is not accepted before its time has come. */
static double local_time(void) {
    struct tm local;
    time_t now = time(NULL);
    if (now == (time_t)-1 || !localtime_r(&now, &local)) return (double)NAN;
    return (double)now + (double)local.tm_gmtoff;
}

int fw_cli_run(int argc, char **argv) {
    catch_signals();
    if (argc < 2) return fw_cli_usage("no command; see flexwright --help");
    const char *name = argv[1];
    if (strcmp(name, FW_SERVE_CHILD) == 0) return fw_serve_child(argc, argv);
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        const fw_cli_command *about = argc > 2 ? fw_cli_find_command(argv[2]) : NULL;
        if (about)
            fw_cli_command_help(about);
        else
            fw_cli_help();
        return last_words(0);
    }
    if (strcmp(name, "--version") == 0) {
        printf("flexwright %s\n", FW_VERSION);
        return last_words(0);
    }
    const fw_cli_command *command = fw_cli_find_command(name);
    if (!command) return fw_cli_unknown_command(name);
    fw_cli_options options = {.design = fw_design_options_default(),
                              .colour = -1,
                              .argv = argv,
                              .interrupted = &interrupted,
                              .now_s = local_time()};
    options.design.data_directory = getenv("FLEXWRIGHT_DATA");
    int status;
    if (!fw_cli_parse(command, argc, argv, &options))
        status = fw_status_exit(FW_USAGE);
    else if (options.help)
        fw_cli_command_help(command), status = last_words(0);
    else
        start_clock(options.time_limit_s), status = last_words(command->run(&options));
    fw_cli_options_free(&options);
    return status;
}
