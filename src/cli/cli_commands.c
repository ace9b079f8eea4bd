/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands, one row of commands.def each; what --help and the reference page say of them and of
   their options; the reader of a command's line; and the program: signals, the clock, one command. */
#include "base/arena.h"
#include "cli/cli.h"
#include "dynamics/dynamics.h"
#include "serve/serve.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static const fw_cli_command commands[] = {
#define COMMAND(name_, argument_, summary_, example_, text_, options_)                             \
    {.name = #name_,                                                                               \
     .argument = (argument_),                                                                      \
     .summary = (summary_),                                                                        \
     .example = (example_),                                                                        \
     .text = (text_),                                                                              \
     .options = (options_),                                                                        \
     .run = fw_cli_command_##name_},
#include "cli/commands.def"
#undef COMMAND
};

const fw_cli_command *fw_cli_command_table(size_t *count) {
    *count = sizeof commands / sizeof commands[0];
    return commands;
}

const fw_cli_command *fw_cli_find_command(const char *name) {
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        if (strcmp(commands[i].name, name) == 0) return &commands[i];
    return NULL;
}

int fw_cli_unknown_command(const char *name) {
    const char *names[sizeof commands / sizeof commands[0]];
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        names[i] = commands[i].name;
    const char *near = fw_did_you_mean(name, names, sizeof commands / sizeof commands[0]);
    return fw_cli_usage("unknown command '%s'%s%s%s flexwright --help", name,
                        near ? "; did you mean " : "", near ? near : "", near ? "? See" : "; see");
}

/* ---- help ---- */

static void print_options(unsigned groups, FILE *to) {
    size_t count;
    const fw_cli_option_row *table = fw_cli_option_rows(&count);
    for (size_t i = 0; i < count; i++) {
        if (!(table[i].group & groups)) continue;
        char left[64];
        snprintf(left, sizeof left, "%s%c%s--%s%s%s", table[i].letter ? "-" : " ",
                 table[i].letter ? table[i].letter : ' ', table[i].letter ? ", " : "  ",
                 table[i].name, table[i].argument ? " " : "",
                 table[i].argument ? table[i].argument : "");
        fprintf(to, "  %-26s %s\n", left, fw_cli_option_help(&table[i]));
    }
}

void fw_cli_help(void) {
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    fputs(
        "flexwright - from one description of a compliant micromanipulator to a verdict, masks "
        "and\n"
        "fabrication recipes\n\n"
        "  flexwright plan device.xml -o out       everything, for every flow of the device\n"
        "  flexwright check device.xml             only: does a hinge leave its elastic range?\n\n"
        "Commands:\n",
        stdout);
    for (size_t i = 0; i < n; i++)
        printf("  %-9s %s\n", command[i].name, command[i].summary);
    fputs(
        "\n  flexwright COMMAND --help              options of a command, with an example\n"
        "  flexwright --version\n\n"
        "Exit status: 0 accepted or done, 1 design rejected, 2 wrong usage, 3 invalid input,\n"
        "4 inconclusive, 5 input or output failed, 6 out of memory or another limit,\n"
        "7 no numerical solution, 70 internal error, 130 and 143 on signals.\n"
        "Results go to standard output, messages to standard error.\n\n"
        "FLEXWRIGHT_DATA names the directory that holds processes/ and masks/ (then only that one\n"
        "is used); NO_COLOR and FORCE_COLOR as usual. No other setting changes a result.\n",
        stdout);
}

static void print_rows(const char *title, fw_multibody_method_row (*at)(size_t)) {
    puts(title);
    for (size_t i = 0; at(i).name; i++)
        printf("  %-24s %s\n", at(i).name, at(i).summary);
}

void fw_cli_command_help(const fw_cli_command *command) {
    printf("flexwright %s%s%s [options]\n\n  %s\n\n%s\n\nOptions:\n", command->name,
           command->argument ? " " : "", command->argument ? command->argument : "",
           command->example, command->text);
    print_options(command->options, stdout);
    if (command->options & FW_OPT_SIMULATE) {
        print_rows("\nMethods:", fw_multibody_method_at);
        print_rows("Integrators:", fw_dynamics_integrator_at);
        print_rows("Stabilisation:", fw_dynamics_stabilisation_at);
    }
}

void fw_cli_reference(fw_text *out) {
    size_t n, count;
    const fw_cli_command *command = fw_cli_command_table(&n);
    const fw_cli_option_row *table = fw_cli_option_rows(&count);
    fw_text_add(out, "# Command line\n\nGenerated from the option table; do not edit.\n");
    for (size_t i = 0; i < n; i++) {
        fw_text_printf(out, "\n## flexwright %s%s%s\n\n%s\n\n    %s\n\n%s\n\n", command[i].name,
                       command[i].argument ? " " : "",
                       command[i].argument ? command[i].argument : "", command[i].summary,
                       command[i].example, command[i].text);
        fw_text_add(out, "| option | meaning |\n|---|---|\n");
        for (size_t k = 0; k < count; k++)
            if (table[k].group & command[i].options)
                fw_text_printf(
                    out, "| `%s%.*s%s--%s%s%s` | %s |\n", table[k].letter ? "-" : "",
                    table[k].letter ? 1 : 0, &table[k].letter, table[k].letter ? "`, `" : "",
                    table[k].name, table[k].argument ? " " : "",
                    table[k].argument ? table[k].argument : "", fw_cli_option_help(&table[k]));
    }
}

/* ---- the line of a command: its options by the rows of options.c, and at most one name ---- */

enum { MOST_OPTIONS = 256 }; /* of one command, for what was probably meant */

static const fw_cli_option_row *find(const fw_cli_command *command, const char *name, size_t n,
                                     char letter) {
    size_t count;
    const fw_cli_option_row *table = fw_cli_option_rows(&count);
    for (size_t i = 0; i < count; i++) {
        if (!(table[i].group & command->options)) continue;
        if (letter ? table[i].letter == letter
                   : strlen(table[i].name) == n && strncmp(table[i].name, name, n) == 0)
            return &table[i];
    }
    return NULL;
}

static bool unknown_option(const fw_cli_command *command, const char *argument) {
    const char *names[MOST_OPTIONS];
    size_t n = 0, count;
    const fw_cli_option_row *table = fw_cli_option_rows(&count);
    for (size_t i = 0; i < count && n < MOST_OPTIONS; i++)
        if (table[i].group & command->options) names[n++] = table[i].name;
    const char *near = argument[1] == '-' ? fw_did_you_mean(argument + 2, names, n) : NULL;
    fw_cli_usage("%s has no option '%s'%s%s%s flexwright %s --help", command->name, argument,
                 near ? "; did you mean --" : "", near ? near : "", near ? "? See" : "; see",
                 command->name);
    return false;
}

/* the row of the option at argv[*i], and its value from behind '=' or from the next argument; a value that is missing or
   not wanted is the caller's affair */
static const fw_cli_option_row *option_at(const fw_cli_command *command, char **argv, int *i,
                                          const char **value) {
    const char *argument = argv[*i];
    const fw_cli_option_row *row;
    if (argument[1] == '-') {
        size_t n = strcspn(argument + 2, "=");
        row = find(command, argument + 2, n, 0);
        *value = argument[2 + n] == '=' ? argument + 3 + n : NULL;
    } else {
        row = find(command, NULL, 0, argument[1]);
        *value = argument[2] ? argument + 2 : NULL;
    }
    if (row && row->argument && !*value && argv[*i + 1]) *value = argv[++*i];
    return row;
}

static bool one_option(const fw_cli_command *command, char **argv, int *i, fw_cli_options *o) {
    const char *argument = argv[*i], *value;
    int first = *i;
    const fw_cli_option_row *row = option_at(command, argv, i, &value);
    if (!row || (!row->argument && value)) return unknown_option(command, argument);
    if (row->argument && !value) {
        fw_cli_usage("--%s needs %s: %s", row->name, row->argument, fw_cli_option_help(row));
        return false;
    }
    if (o->ngiven < FW_MOST_GIVEN) {
        o->given[o->ngiven].name = row->name;
        o->given[o->ngiven].first = first, o->given[o->ngiven++].last = *i;
    }
    const char *wrong = row->take(o, value);
    if (wrong)
        fw_cli_usage("--%s%s%s %s%s", row->name, value ? " " : "", value ? value : "", wrong,
                     value ? fw_cli_meant(value, wrong) : "");
    return !wrong;
}

static bool is_stdout(const char *file) {
    return file && strcmp(file, "-") == 0;
}

/* standard output holds one document */
static bool one_document(const fw_cli_command *command, const fw_cli_options *o) {
    const struct {
        const char *name;
        bool wanted;
    } use[] = {{"--json", o->json},
               {"--csv -", is_stdout(o->csv)},
               {"--forces -", is_stdout(o->forces)},
               {"--animate -", is_stdout(o->animate)},
               {"--svg -", is_stdout(o->svg)},
               {"--gds -", is_stdout(o->gds)}};
    const char *first = NULL;
    for (size_t i = 0; i < sizeof use / sizeof use[0]; i++) {
        if (!use[i].wanted) continue;
        if (first) {
            fw_cli_usage("%s: %s and %s both want standard output, which holds one document; give "
                         "one of them a file",
                         command->name, first, use[i].name);
            return false;
        }
        first = use[i].name;
    }
    return true;
}

bool fw_cli_parse(const fw_cli_command *command, int argc, char **argv, fw_cli_options *o) {
    bool only_names = false;
    o->schedules = (command->options & FW_OPT_SCHEDULE) != 0;
    for (int i = 2; i < argc; i++) {
        const char *argument = argv[i];
        if (!only_names && strcmp(argument, "--") == 0)
            only_names = true;
        else if (!only_names && argument[0] == '-' && argument[1]) {
            if (!one_option(command, argv, &i, o)) return false;
        } else if (o->device && (command->options & FW_OPT_STUDY) && o->nmore < FW_MOST_NAMES) {
            o->more[o->nmore++] = argument;
        } else if (o->device) {
            fw_cli_usage("%s takes one %s, got '%s' and '%s'", command->name,
                         command->argument ? command->argument : "argument", o->device, argument);
            return false;
        } else
            o->device = argument;
    }
    if (!o->help && command->argument && command->argument[0] != '[' && !o->device) {
        fw_cli_usage("%s needs %s; see flexwright %s --help", command->name, command->argument,
                     command->name);
        return false;
    }
    return o->help || one_document(command, o);
}

/* ---- the program ---- */

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
