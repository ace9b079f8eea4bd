/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancel.h"
#include "cli/cli.h"
#include "cli/session.h"
#include "serve/serve.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const fw_cli_command table[] = {
    {"plan", "DEVICE.xml", "everything: verdict, masks, recipes, report",
     "flexwright plan device.xml -o out",
     "Judges the device in every flow it names, draws the masks with the flow's bias, computes "
     "the\n"
     "recipes and writes a report. Exit status 0: accepted; 1: rejected (the report says which\n"
     "parameter to change and by how much), or a flow cannot make it; 4: the error band straddles\n"
     "the limit. The directory appears complete or not at all.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_VERDICT | FW_OPT_OUTPUT | FW_OPT_FABRICATE |
         FW_OPT_SCHEDULE,
     fw_cli_command_plan},
    {"check", "DEVICE.xml", "only the verdict: does a hinge leave its elastic range?",
     "flexwright check device.xml --set arc=\"250 deg\"",
     "Runs every scene and the required workspace and compares each hinge's peak strain with its\n"
     "limit. Writes nothing, or with -o DIR the verdict as JSON.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_VERDICT | FW_OPT_OUTPUT, fw_cli_command_check},
    {"simulate", "DEVICE.xml", "one scene: motion, peaks, statistics",
     "flexwright simulate device.xml --scene step-load --csv motion.csv",
     "Solves the equations of motion of one scene and prints the peak of every hinge angle. With\n"
     "--csv every body's position and velocity, evenly sampled; with --animate a moving picture;\n"
     "-o DIR writes motion.csv, forces.csv and motion.svg.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT | FW_OPT_SIMULATE, fw_cli_command_simulate},
    {"assemble", "DEVICE.xml", "close all joints from the poses of the description; kinematics",
     "flexwright assemble device.xml --svg assembled.svg",
     "Takes the poses of the bodies as a guess, however bad, and finds the position that closes "
     "all\n"
     "joints nearest to it; says what moved, on which side every elbow stands, which other\n"
     "assemblies exist and what can still move. With --rates velocities, accelerations and joint\n"
     "forces under the loads of the scene too. -o DIR writes assemble.json and assemble.svg.\n"
     "Exit status 7: the joints cannot be closed; the message says which one and by how much.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT | FW_OPT_ASSEMBLE, fw_cli_command_assemble},
    {"statics", "DEVICE.xml", "equilibrium under a scene's loads, and the load path to it",
     "flexwright statics device.xml --path -o statics-out",
     "Takes loads and drivers as they are at the scene's end and finds where the mechanism rests "
     "under\n"
     "them; says whether it is stable. With --path the load grows from nothing (springs and "
     "weight\n"
     "always act), through limit points, where the mechanism snaps, and past bifurcations, each "
     "located.\n"
     "-o DIR writes statics.json, statics.svg, statics.csv and with --path path.svg. Exit status "
     "7: "
     "there\n"
     "is no equilibrium.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT | FW_OPT_STATICS, fw_cli_command_statics},
    {"modes", "DEVICE.xml", "natural frequencies, damping and mode shapes",
     "flexwright modes device.xml --at equilibrium -o modes-out",
     "Small motions about the assembled pose, or about the equilibrium under a scene's loads: "
     "natural\n"
     "frequencies, damped eigenvalues, shapes. Motions that nothing holds and poses that are "
     "unstable\n"
     "are named. -o DIR writes modes.json and modes.svg, in which the mechanism moves.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT | FW_OPT_MODES, fw_cli_command_modes},
    {"mask", "DEVICE.xml",
     "only the masks (GDSII, SVG, OASIS, DXF, KLayout files, certificate, order sheet)",
     "flexwright mask device.xml --flow al-masked-rie -o masks-out",
     "Judges the device first: a rejected design gets no mask unless --force.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_VERDICT | FW_OPT_OUTPUT | FW_OPT_FABRICATE,
     fw_cli_command_mask},
    {"recipe", "DEVICE.xml",
     "only the recipes (run sheet, sections, CSV, calendar, JSON, schedule)",
     "flexwright recipe device.xml --wafers 4 --operators 2 --day 08:00-18:00",
     "Judges the device first: a rejected design gets no recipe unless --force. With --json and "
     "one\n"
     "flow the recipe is printed; with several, a document that holds them all. The schedule for\n"
     "--wafers and --operators keeps every hold window, says how far from the best possible it "
     "may\n"
     "be, and is written as FLOW.schedule.csv, .json and .svg and into the calendar. The run sheet "
     "shows\n"
     "the wafer after every step, cut along --cut; FLOW.sections.svg and .stack.svg are these "
     "pictures\n"
     "by themselves.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_VERDICT | FW_OPT_OUTPUT | FW_OPT_FABRICATE |
         FW_OPT_SCHEDULE,
     fw_cli_command_recipe},
    {"log", "DEVICE.xml", "what was done, beside what was planned",
     "flexwright log device.xml --flow copper-on-porous-silicon --run lot7.log",
     "Keeps the as-run log of one flow: a text file that only grows, begun for the hash of its "
     "recipe.\n"
     "With --entry a step is added; what the step does not know, measures or allows is refused. "
     "Without\n"
     "--entry the log is verified and set beside the plan: times against their windows, holds "
     "against\n"
     "their limits, values against what is accepted. A line that was changed afterwards is seen; "
     "whoever\n"
     "rewrites the whole file is not.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_LOG, fw_cli_command_log},
    {"hinge", "DEVICE.xml", "every flexure: elastic centre, stiffness, strain, limit angle",
     "flexwright hinge device.xml --svg hinges.svg",
     "Every flexure on a ladder of models, for every flow's material and thickness: elastic "
     "centre,\n"
     "stiffnesses, peak strain per radian (crystal: peak stress over the mean modulus), limit "
     "angle,\n"
     "each level's own estimate of its error, and what it costs. * marks the cheapest level whose\n"
     "estimate for the stiffness is within --accuracy; where none is, the best. Then how the axis\n"
     "drifts, and where the conjugate surfaces meet. --svg, or -o DIR with hinge.json and "
     "hinge.svg,\n"
     "draws it.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT | FW_OPT_HINGE, fw_cli_command_hinge},
    {"workspace", "DEVICE.xml", "reachable set under the strain limit, certified; picture",
     "flexwright workspace device.xml -o workspace-out",
     "The platform poses of a <six-bar> at which no hinge is beyond its elastic limit: volume, "
     "areas "
     "at\n"
     "constant rotation, extents, singular poses; and the required boxes. All bounds are proved "
     "by\n"
     "interval arithmetic. -o DIR writes workspace.json, workspace.svg and certificate.json, which "
     "other\n"
     "programs can verify. It reports and does not judge: check has the verdict.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT, fw_cli_command_workspace},
    {"tradeoff", "DEVICE.xml", "what accuracy costs: every method, integrator, tolerance and model",
     "flexwright tradeoff device.xml -o tradeoff-out",
     "Runs one scene by every method, integrator and tolerance and compares the peak deflections "
     "and "
     "the\n"
     "utilisation with two far tighter, independent runs; beside it what the model itself is off "
     "by\n"
     "(levels of hinges, effects left out, what the flow may make) and what masks cost. Costs are\n"
     "instructions, counted by callgrind where valgrind is installed; CPU time only as medians of\n"
     "ratios, and none that noise makes uncertain. -o DIR writes tradeoff.json, tradeoff.csv and\n"
     "tradeoff.svg.",
     FW_OPT_COMMON | FW_OPT_PLAN | FW_OPT_OUTPUT | FW_OPT_TRADEOFF, fw_cli_command_tradeoff},
    {"calibrate", "MEASURED.csv", "measured coupons in, laboratory pack out",
     "flexwright calibrate lot7.csv --flow al-masked-rie -o lab.xml",
     "Reads widths, depths, thicknesses and masses measured on the coupons of a mask and finds "
     "the\n"
     "numbers of the process with their uncertainty: anisotropy, lag, rates, efficiency, edges, "
     "spin\n"
     "curve. Data that contradict the law of their coupon are refused (exit status 3). The pack is "
     "for\n"
     "plan --lab: times, bias and verdict follow it.",
     FW_OPT_COMMON | FW_OPT_CALIBRATE, fw_cli_command_calibrate},
    {"serve", "[DEVICE.xml]",
     "the page: see it move, change a number, watch verdict, masks and recipe",
     "flexwright serve device.xml",
     "Serves a page on loopback and prints its address, which opens once; in a terminal with a "
     "display\n"
     "the browser is opened. The file is watched: what your editor saves, the page shows. Nothing "
     "leaves\n"
     "the machine. Ctrl-C ends it.",
     FW_OPT_COMMON | FW_OPT_SERVE, fw_cli_command_serve},
    {"init", "[NAME]", "a starter device on standard output",
     "flexwright init my-device > device.xml",
     "Prints a small six-bar with comments; every command accepts it as it is.", FW_OPT_COMMON,
     fw_cli_command_init},
    {"explain", "CODE", "the long text of a diagnostic", "flexwright explain FW-D204",
     "Says what the diagnostic means and what to do.", FW_OPT_COMMON, fw_cli_command_explain},
    {"doctor", NULL, "what is installed, for a bug report", "flexwright doctor",
     "Versions of the libraries, where the data files are, what the processor offers.",
     FW_OPT_COMMON, fw_cli_command_doctor},
};

/* named in the contract, not in this version: say so instead of "unknown" */
static const char *const later[] = {"study"};

const fw_cli_command *fw_cli_command_table(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

static const fw_cli_command *find_command(const char *name) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (strcmp(table[i].name, name) == 0) return &table[i];
    return NULL;
}

static int unknown_command(const char *name) {
    for (size_t i = 0; i < sizeof later / sizeof later[0]; i++)
        if (strcmp(later[i], name) == 0)
            return fw_cli_usage("'%s' is not in this version (%s); flexwright --help lists what is",
                                name, FW_VERSION);
    const char *names[sizeof table / sizeof table[0]];
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        names[i] = table[i].name;
    const char *near = fw_did_you_mean(name, names, sizeof table / sizeof table[0]);
    return fw_cli_usage("unknown command '%s'%s%s%s; see flexwright --help", name,
                        near ? "; did you mean " : "", near ? near : "", near ? "?" : "");
}

/* the first signal asks to stop, the second one stops; a handler sees nothing but what is static */
static fw_cancel interrupted;

static void on_signal(int number) {
    if (fw_cancel_requested(&interrupted)) _exit(128 + number);
    fw_cancel_request(&interrupted, number);
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

int fw_cli_run(int argc, char **argv) {
    catch_signals();
    if (argc < 2) return fw_cli_usage("no command; see flexwright --help");
    const char *name = argv[1];
    if (strcmp(name, FW_SERVE_CHILD) == 0) return fw_serve_child(argc, argv);
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        const fw_cli_command *about = argc > 2 ? find_command(argv[2]) : NULL;
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
    const fw_cli_command *command = find_command(name);
    if (!command) return unknown_command(name);
    fw_cli_options options = {.design = fw_design_options_default(),
                              .colour = -1,
                              .argv = argv,
                              .interrupted = &interrupted};
    options.design.data_directory = getenv("FLEXWRIGHT_DATA");
    int status;
    if (!fw_cli_parse(command, argc, argv, &options))
        status = fw_status_exit(FW_USAGE);
    else if (options.help)
        fw_cli_command_help(command), status = last_words(0);
    else
        status = last_words(command->run(&options));
    fw_cli_options_free(&options);
    return status;
}
