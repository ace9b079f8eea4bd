/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"
#include "dynamics/dynamics.h"
#include "mask/mask.h"
#include "plan/plan.h"
#include "schedule/schedule.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- one function per option ---- */

static const char *take_output(fw_cli_options *o, const char *v) {
    o->output = v;
    return *v ? NULL : "needs the name of a directory";
}

static const char *take_json(fw_cli_options *o, const char *v) {
    (void)v;
    o->json = true;
    return NULL;
}

static const char *take_set(fw_cli_options *o, const char *v) {
    const char *equals = strchr(v, '=');
    /* flexure[A]/@length=312 um: the first '=' ends the path; ids hold none */
    if (!equals || equals == v)
        return "needs PATH=VALUE, for example arc=\"250 deg\" or \"flexure[A]/@length=312 um\"";
    if (o->nset == FW_MOST_SETS) return "is given more than 64 times";
    char *path = malloc((size_t)(equals - v) + 1); /* until fw_cli_options_free */
    if (!path) return "could not be stored: out of memory";
    memcpy(path, v, (size_t)(equals - v));
    path[equals - v] = '\0';
    o->set[o->nset++] = (fw_device_set){path, equals + 1};
    return NULL;
}

void fw_cli_options_free(fw_cli_options *o) {
    for (int i = 0; i < o->nset; i++)
        free((void *)o->set[i].path); /* ours; const for everyone downstream */
    o->nset = 0;
}

static const char *take_accuracy(fw_cli_options *o, const char *v) {
    double *x = &o->design.accuracy;
    if (!fw_number_parse(v, strlen(v), x) || !(*x >= 1e-12 && *x <= 0.1))
        return "needs a relative error between 1e-12 and 0.1";
    return NULL;
}

static const char *take_memory(fw_cli_options *o, const char *v) {
    double mib;
    if (!fw_number_parse(v, strlen(v), &mib) || !(mib >= 16 && mib <= 1048576))
        return "needs MiB between 16 and 1048576";
    o->design.memory_cap = (size_t)(mib * 1048576);
    return NULL;
}

static const char *take_time_limit(fw_cli_options *o, const char *v) {
    double *x = &o->time_limit_s;
    if (!fw_number_parse(v, strlen(v), x) || !(*x >= 0.001 && *x <= 1e7))
        return "needs seconds between 0.001 and 1e7";
    return NULL;
}

static const char *take_effects(fw_cli_options *o, const char *v) {
    o->design.effects = v;
    return *v ? NULL : "needs auto, all, none or a list of effects";
}

static const char *auto_or_none(const char *v) {
    return strcmp(v, "auto") == 0 || strcmp(v, "none") == 0 ? NULL : "needs auto or none";
}

static const char *take_corners(fw_cli_options *o, const char *v) {
    o->design.corners = v;
    return auto_or_none(v);
}

static const char *take_advice(fw_cli_options *o, const char *v) {
    o->design.advice = v;
    return auto_or_none(v);
}

static const char *take_measurements(fw_cli_options *o, const char *v) {
    o->design.measurements = v;
    return strcmp(v, "all") == 0 || !auto_or_none(v) ? NULL : "needs auto, all or none";
}

static const char *take_quiet(fw_cli_options *o, const char *v) {
    (void)v;
    o->quiet = true;
    return NULL;
}

static const char *take_verbose(fw_cli_options *o, const char *v) {
    (void)v;
    o->verbose = true;
    return NULL;
}

static const char *take_no_progress(fw_cli_options *o, const char *v) {
    (void)v;
    o->no_progress = true;
    return NULL;
}

static const char *take_colour(fw_cli_options *o, const char *v) {
    static const char *const word[] = {"auto", "never", "always"};
    for (int i = 0; i < 3; i++)
        if (strcmp(v, word[i]) == 0) {
            o->colour = i - 1;
            return NULL;
        }
    return "needs auto, always or never";
}

static const char *take_help(fw_cli_options *o, const char *v) {
    (void)v;
    o->help = true;
    return NULL;
}

static const char *take_flow(fw_cli_options *o, const char *v) {
    o->design.flow = v;
    return *v ? NULL : "needs the name of a flow";
}

static const char *take_force(fw_cli_options *o, const char *v) {
    (void)v;
    o->design.force = 1;
    return NULL;
}

/* ---- of recipe and plan: the schedule ---- */

static const char *whole(const char *v, int32_t *to) {
    double n;
    if (!fw_number_parse(v, strlen(v), &n) || n != floor(n) || !(n >= 1 && n <= 50))
        return "needs a whole number between 1 and 50";
    *to = (int32_t)n;
    return NULL;
}

static const char *take_wafers(fw_cli_options *o, const char *v) {
    return whole(v, &o->design.wafers);
}

static const char *take_operators(fw_cli_options *o, const char *v) {
    return whole(v, &o->design.operators);
}

static const char *take_day(fw_cli_options *o, const char *v) {
    fw_schedule_calendar day;
    o->design.day = v;
    return fw_schedule_calendar_parse(v, &day)
               ? NULL
               : "needs times like 08:00-18:00 or 08:00-12:00,13:00-18:00, or none; and \" from "
                 "2026-11-23\" behind them for a first day, \"T13:00\" for a time of it, \" UTC\" "
                 "or \" UTC+01:00\" for a zone, \" CET-1CEST,M3.5.0,M10.5.0/3\" for one whose "
                 "clocks are changed (the last line of its file in /usr/share/zoneinfo)";
}

static const char *take_lab(fw_cli_options *o, const char *v) {
    o->design.laboratory = v;
    return *v ? NULL : "needs the name of a laboratory pack";
}

static const char *take_planned(fw_cli_options *o, const char *v) {
    o->design.planning_times = v;
    return strchr(v, '=') ? NULL
                          : "needs STEP=TIME with commas between, like \"S03=90 min,S09=20 s\"";
}

static const char *take_cut(fw_cli_options *o, const char *v) {
    o->design.cut = v;
    return *v ? NULL : "needs \"x1,y1,x2,y2\" in um or with units, or flexure:ID";
}

static const char *take_at(fw_cli_options *o, const char *v) {
    o->design.at = v;
    return strcmp(v, "rest") == 0 || strcmp(v, "equilibrium") == 0 ? NULL
                                                                   : "needs rest or equilibrium";
}

static const char *take_path(fw_cli_options *o, const char *v) {
    (void)v;
    o->design.path = 1;
    return NULL;
}

static const char *take_scene(fw_cli_options *o, const char *v) {
    o->design.scene = v;
    return *v ? NULL : "needs the name of a scene";
}

/* NULL, or a sentence that names all that are known */
static const char *from_table(const char *v, fw_multibody_method_row (*at)(size_t)) {
    static char known[600];
    const char *name[32];
    size_t rows = 0;
    for (; at(rows).name && rows < sizeof name / sizeof name[0]; rows++)
        name[rows] = at(rows).name;
    const char *near = fw_did_you_mean(v, name, rows);
    size_t n = (size_t)snprintf(known, sizeof known, "is not known%s%s%s; known are",
                                near ? "; did you mean " : "", near ? near : "", near ? "?" : "");
    for (size_t i = 0; at(i).name; i++) {
        if (strcmp(v, at(i).name) == 0) return NULL;
        if (n < sizeof known)
            n += (size_t)snprintf(known + n, sizeof known - n, "%s %s", i ? "," : "", at(i).name);
    }
    return known;
}

static const char *take_method(fw_cli_options *o, const char *v) {
    o->design.method = v;
    return from_table(v, fw_multibody_method_at);
}

static const char *take_integrator(fw_cli_options *o, const char *v) {
    o->design.integrator = v;
    return from_table(v, fw_dynamics_integrator_at);
}

static const char *take_stabilise(fw_cli_options *o, const char *v) {
    o->design.stabilise = v;
    return from_table(v, fw_dynamics_stabilisation_at);
}

static const char *take_hinge_model(fw_cli_options *o, const char *v) {
    o->design.hinge_model = v;
    for (size_t i = 0; i < fw_effects_hinge_model_count(); i++)
        if (strcmp(v, fw_effects_hinge_model_text((fw_effects_hinge_model)i)) == 0) return NULL;
    return fw_cli_needs(fw_cli_hinge_model_names);
}

static const char *take_rtol(fw_cli_options *o, const char *v) {
    double *x = &o->design.rtol;
    if (!fw_number_parse(v, strlen(v), x) || !(*x >= 1e-14 && *x <= 1e-2))
        return "needs a relative tolerance between 1e-14 and 1e-2";
    return NULL;
}

static const char *take_samples(fw_cli_options *o, const char *v) {
    double n;
    if (!fw_number_parse(v, strlen(v), &n) || n != floor(n) || !(n >= 2 && n <= 1e6))
        return "needs a whole number between 2 and 1000000";
    o->design.samples = (int)n;
    return NULL;
}

static const char *take_forces(fw_cli_options *o, const char *v) {
    o->forces = v;
    return *v ? NULL : "needs a file name";
}

static const char *take_csv(fw_cli_options *o, const char *v) {
    o->csv = v;
    return *v ? NULL : "needs the name of a file";
}

static const char *take_animate(fw_cli_options *o, const char *v) {
    o->animate = v;
    return *v ? NULL : "needs the name of a file";
}

/* ---- of assemble ---- */

static const char *take_independent(fw_cli_options *o, const char *v) {
    o->design.independent = v;
    return *v ? NULL : "needs coordinates like AB.phi,CD.x";
}

static const char *take_rates(fw_cli_options *o, const char *v) {
    o->design.rates = v;
    return *v ? NULL : "needs values with units like \"10 rad/s,0.2 mm/s\"";
}

static const char *take_accelerations(fw_cli_options *o, const char *v) {
    o->design.accelerations = v;
    return *v ? NULL : "needs values with units like \"10 rad/s^2,0.2 mm/s^2\"";
}

static const char *take_svg(fw_cli_options *o, const char *v) {
    o->svg = v;
    return *v ? NULL : "needs the name of a file";
}

static const char *take_level(fw_cli_options *o, const char *v) {
    static char wrong[200];
    size_t count;
    const fw_plan_ladder_level *level = fw_plan_ladder_levels(&count);
    o->level = v;
    if (strcmp(v, "auto") == 0 || strcmp(v, "all") == 0) return NULL;
    for (size_t i = 0; i < count; i++)
        if (strcmp(level[i].name, v) == 0) return NULL;
    snprintf(wrong, sizeof wrong, "needs %s, or auto or all", fw_cli_level_names());
    return wrong;
}

static const char *take_deck(fw_cli_options *o, const char *v) {
    o->deck = v;
    return *v ? NULL : "needs the name of a directory";
}

/* ---- of serve ---- */

static const char *take_port(fw_cli_options *o, const char *v) {
    double n;
    if (!fw_number_parse(v, strlen(v), &n) || n != floor(n) || !(n >= 0 && n <= 65535))
        return "needs a whole number between 0 (any free port) and 65535";
    o->port = (int)n;
    return NULL;
}

static const char *take_no_browser(fw_cli_options *o, const char *v) {
    (void)v;
    o->no_browser = true;
    return NULL;
}

static const char *take_ipv6(fw_cli_options *o, const char *v) {
    (void)v;
    o->ipv6 = true;
    return NULL;
}

/* ---- of tradeoff ---- */

static const char *take_budget(fw_cli_options *o, const char *v) {
    double *x = &o->budget_s;
    if (!fw_number_parse(v, strlen(v), x) || !(*x >= 1 && *x <= 3600))
        return "needs seconds between 1 and 3600";
    return NULL;
}

static const char *take_no_time(fw_cli_options *o, const char *v) {
    (void)v;
    o->no_time = true;
    return NULL;
}

static const char *take_settings(fw_cli_options *o, const char *v) {
    o->settings = v;
    return *v ? NULL : "needs LEVEL;METHOD/INTEGRATOR/RTOL,...";
}

static const fw_cli_option_row table[] = {
    {"output", 'o', "DIR", "directory of the results; it appears whole or not at all",
     FW_OPT_OUTPUT, take_output},
    {"json", 0, NULL,
     "one JSON document on standard output; where there is no result, the diagnostics", FW_OPT_PLAN,
     take_json},
    {"study", 0, "NAME", "which <study> of the device file; default the only one", FW_OPT_STUDY,
     fw_cli_take_study},
    {"output", 'o', "DIR",
     "directory of the samples (study.sqlite) and the results; default out/DEVICE-STUDY",
     FW_OPT_STUDY, take_output},
    {"plan", 0, NULL, "say what would be run, how many devices and how long, and stop",
     FW_OPT_STUDY, fw_cli_take_plan_only},
    {"jobs", 0, "N",
     "threads, 1 to 256; default one for each processor. The results are the same for any number",
     FW_OPT_STUDY | FW_OPT_VERDICT, fw_cli_take_jobs},
    {"shard", 0, "I/N",
     "only every N-th sample from the I-th on, for a machine of its own; study merge puts the N "
     "directories together",
     FW_OPT_STUDY, fw_cli_take_shard},
    {"resume", 0, NULL,
     "go on with the samples that are in the directory; where another process writes there, after "
     "it",
     FW_OPT_STUDY, fw_cli_take_resume},
    {"shards", 0, "N", "of study slurm: tasks of the array job, 1 to 1000, a shard each",
     FW_OPT_STUDY, fw_cli_take_tasks},
    {"sbatch", 0, "OPTIONS",
     "of study slurm: the cluster's own options, of both jobs: \"--partition=long --time=60\"; "
     "repeatable",
     FW_OPT_STUDY, fw_cli_take_sbatch},
    {"no-submit", 0, NULL, "of study slurm: write the two scripts and submit nothing", FW_OPT_STUDY,
     fw_cli_take_no_submit},
    {"set", 0, "PATH=VALUE",
     "override a parameter (arc=\"250 deg\") or an attribute (flexure[A]/@length=\"312 um\"); "
     "repeatable",
     FW_OPT_PLAN, take_set},
    {"accuracy", 0, "REL", "relative error wanted on the peak hinge deflection; default 1e-3",
     FW_OPT_PLAN, take_accuracy},
    {"memory", 0, "MIB", "most memory that the design may take, in MiB; default 512", FW_OPT_PLAN,
     take_memory},
    {"time-limit", 0, "SECONDS",
     "most time that the command may take; where it is over, nothing is written and the exit "
     "status is 6. Default: none",
     FW_OPT_PLAN, take_time_limit},
    {"effects", 0, "WHICH",
     "auto (leaves out what provably changes less than the accuracy wanted), all, none, or a "
     "list like inertia,gravity,joint-damping (without inertia: a quasi-static sequence of "
     "equilibria; an actuator's law, initial velocities, friction and snaps keep it); whatever "
     "the choice, stiffness, springs, stops within reach, loads, tendons, comb drives and initial "
     "velocities stay, and weight and base motion where nothing else moves the device",
     FW_OPT_PLAN, take_effects},
    {"corners", 0, "WHICH",
     "auto: the verdict holds for what each flow may make of the device, at the corners of its "
     "ranges (edges, etch, thickness, modulus); none: for the drawn geometry only",
     FW_OPT_PLAN, take_corners},
    {"advice", 0, "WHICH",
     "auto: for a design that is not accepted, the smallest changes that would be are searched "
     "for, each one computed; none: the verdict only, in a fraction of the time",
     FW_OPT_VERDICT, take_advice},
    {"measurements", 0, "WHICH",
     "which input of a flow to measure first: by how much knowing each as exactly as its coupon "
     "reads "
     "it narrows the verdict's band and the steps' time windows. auto: with a recipe, and where "
     "what a flow makes is undecided; all: always; none: never",
     FW_OPT_VERDICT, take_measurements},
    {"flow", 0, "NAME", "only this process flow", FW_OPT_PLAN, take_flow},
    {"hinge-model", 0, "MODEL", "how flexures enter the mechanism: {names}", FW_OPT_PLAN,
     take_hinge_model},
    {"force", 0, NULL, "masks and recipes of a rejected design too, each marked REJECTED",
     FW_OPT_FABRICATE, take_force},
    {"gds", 0, "FILE",
     "the device of one flow alone as GDSII, in place of -o: no test die, wafer or order sheet; - "
     "is standard output",
     FW_OPT_MASK, fw_cli_take_gds},
    {"mask-tolerance", 0, "NM",
     "largest distance between an arc and its polygon, in nm, from 0.36 to 1000; default 5",
     FW_OPT_FABRICATE, fw_cli_take_tolerance},
    {"mask-flatten", 0, "HOW",
     "arcs as polygons: inside (default; vertices on the arc) or equal-area (chords that enclose "
     "the area of the arc)",
     FW_OPT_FABRICATE, fw_cli_take_mask_flatten},
    {"mask-format", 0, "LIST", "{names} (GDSII is always written)", FW_OPT_FABRICATE,
     fw_cli_take_mask_format},
    {"mask-vertices", 0, "N",
     "most vertices of one GDSII boundary: 199, 4094 or 8190; default 4094; larger outlines are "
     "cut at vertices",
     FW_OPT_FABRICATE, fw_cli_take_mask_vertices},
    {"layers", 0, "FILE",
     "the laboratory's own layer numbers, 0 to 65535, and names, a line for each layer: "
     "\"structure 7/0 "
     "name POLY2\"; LAYER is an id or a role of the layer table, lines below \"flow NAME\" are for "
     "that flow, # begins a remark",
     FW_OPT_FABRICATE, fw_cli_take_layers},
    {"wafers", 0, "N", "wafers of the schedule, 1 to 50; default 1", FW_OPT_SCHEDULE, take_wafers},
    {"operators", 0, "K", "people who stand at the machines, 1 to 50; default 1", FW_OPT_SCHEDULE,
     take_operators},
    {"day", 0, "FROM-TO",
     "working day, Monday to Friday; default 08:00-18:00; with breaks 08:00-12:00,13:00-18:00; "
     "none: round the clock; "
     "\"08:00-18:00 from 2026-11-23T13:00 UTC+01:00\": the first day, with a time of it and a zone "
     "where they matter; a zone whose clocks are changed as POSIX writes it, \"08:00-18:00 from "
     "2026-10-23 CET-1CEST,M3.5.0,M10.5.0/3\". What needs nobody may go on over night, but for "
     "what nobody may be alone with and what is looked at between its parts",
     FW_OPT_SCHEDULE, take_day},
    {"planned", 0, "LIST",
     "planning times for steps whose own is NOT COMPUTABLE, like \"S03=90 min,S09=20 s\"; marked "
     "in the schedule, and used for nothing else",
     FW_OPT_SCHEDULE, take_planned},
    {"cut", 0, "LINE",
     "where the sections of the run sheet cut the wafer: \"x1,y1,x2,y2\" in um or as lengths with "
     "units, or flexure:ID; default radially through the narrowest gap of a hinge",
     FW_OPT_SCHEDULE, take_cut},
    {"lab", 0, "FILE",
     "laboratory pack (or several with commas between): its values replace those of the process "
     "packs by id, and every one is named in run sheet and report; calibrate writes and takes one",
     FW_OPT_PLAN | FW_OPT_CALIBRATE, take_lab},
    {"output", 'o', "FILE", "the laboratory pack; default standard output", FW_OPT_CALIBRATE,
     take_output},
    {"without", 0, "LIST",
     "wafers of a log whose readings do not count: their ids with commas "
     "between",
     FW_OPT_CALIBRATE, fw_cli_take_without},
    {"all-runs", 0, NULL,
     "count readings of a log also where its own times say that the run was out of its window, or "
     "an earlier step was run again since",
     FW_OPT_CALIBRATE, fw_cli_take_all_runs},
    {"output", 'o', "FILE",
     "the PDF; default standard output where that is no terminal, - in any case", FW_OPT_FIGURE,
     take_output},
    {"flow", 0, "NAME", "the process flow that the coupons went through", FW_OPT_CALIBRATE,
     take_flow},
    {"scene", 0, "NAME", "the scene; default the first",
     FW_OPT_SIMULATE | FW_OPT_MODES | FW_OPT_STATICS | FW_OPT_ASSEMBLE | FW_OPT_TRADEOFF,
     take_scene},
    {"at", 0, "POSE",
     "about which pose: rest (default: the assembled pose without the scene's loads) or "
     "equilibrium",
     FW_OPT_MODES, take_at},
    {"path", 0, NULL, "follow the load path from rest to the full load, through limit points",
     FW_OPT_STATICS, take_path},
    {"method", 0, "NAME",
     "how the constraint forces are found; default chain, or coordinate-partitioning where a body "
     "between its joints is a thousand times lighter than another",
     FW_OPT_SIMULATE, take_method},
    {"integrator", 0, "NAME", "default auto", FW_OPT_SIMULATE, take_integrator},
    {"stabilise", 0, "HOW", "projection, baumgarte or none", FW_OPT_SIMULATE, take_stabilise},
    {"rtol", 0, "R",
     "relative tolerance of the integrator, used between 1e-13 and 1e-5 (a note says when it is "
     "not used as given); default from --accuracy",
     FW_OPT_SIMULATE, take_rtol},
    {"samples", 0, "N", "rows of the CSV, evenly over the scene; default 1001", FW_OPT_SIMULATE,
     take_samples},
    {"forces", 0, "FILE",
     "accelerations of bodies, forces of joints and drivers, 17 digits; - is standard output",
     FW_OPT_SIMULATE, take_forces},
    {"csv", 0, "FILE", "position and velocity of every body, 17 digits; - is standard output",
     FW_OPT_SIMULATE, take_csv},
    {"csv", 0, "FILE",
     "load factor, stability, poses, angles and joint forces, 17 digits, of the path "
     "or the equilibrium; - is standard output",
     FW_OPT_STATICS, take_csv},
    {"animate", 0, "FILE", "an SVG that plays by itself; - is standard output", FW_OPT_SIMULATE,
     take_animate},
    {"independent", 0, "LIST",
     "independent coordinates like AB.phi,CD.x (BODY.x, BODY.y: of its centre of mass); default by "
     "pivoting",
     FW_OPT_ASSEMBLE, take_independent},
    {"rates", 0, "LIST", "their rates, like \"10 rad/s,0.2 mm/s\"; default 0", FW_OPT_ASSEMBLE,
     take_rates},
    {"accelerations", 0, "LIST", "their accelerations, like \"0 rad/s^2,1 m/s^2\"; default 0",
     FW_OPT_ASSEMBLE, take_accelerations},
    {"svg", 0, "FILE", "picture of before and after; - is standard output", FW_OPT_ASSEMBLE,
     take_svg},
    {"svg", 0, "FILE",
     "drift of the axis and gap of the surfaces against the angle; - is standard output",
     FW_OPT_HINGE, take_svg},
    {"level", 0, "LEVEL",
     "{names}: only this one; all; auto (default where "
     "--accuracy is given): continuum, which takes seconds, where the others do not reach the "
     "accuracy. Default: all but continuum",
     FW_OPT_HINGE, take_level},
    {"deck", 0, "DIR",
     "input decks of the solids for CalculiX: every hinge, linear and at finite rotation, and the "
     "mechanism under each scene; each file whole or not at all",
     FW_OPT_HINGE, take_deck},
    {"run", 0, "FILE", "the log, which only grows; made by the first entry", FW_OPT_LOG,
     fw_cli_take_run},
    {"entry", 0, "WORDS",
     "one step as it was run: \"C22; start=2026-11-20T10:00; end=2026-11-20T10:21; by=AB; "
     "thickness=9.1\", further second, tool (which machine of several), bath (which "
     "filling: it serves so many wafers), note and what the step measures",
     FW_OPT_LOG, fw_cli_take_entry},
    {"entries", 0, "FILE",
     "many entries at once, a line for each with the words of --entry and wafer=ID; "
     "instrument=NAME; set power=251 W; coupon=...; # begins a remark. All of them are added, or "
     "none; - is standard input",
     FW_OPT_LOG, fw_cli_take_entries},
    {"lot", 0, "NAME", "name of the lot, for a log that begins", FW_OPT_LOG, fw_cli_take_lot},
    {"zone", 0, "ZONE", "zone of its clock, for a log that begins, written as in --day", FW_OPT_LOG,
     fw_cli_take_zone},
    {"wafers", 0, "LIST",
     "wafers of the lot, for a log that begins: how many, or their ids with commas between",
     FW_OPT_LOG, fw_cli_take_wafer_ids},
    {"wafer", 0, "ID",
     "of which wafer the entry is, or of which load: \"1-4\", \"1,3\" are an entry of each; "
     "without it, of the whole lot",
     FW_OPT_LOG, fw_cli_take_wafer},
    {"site", 0, "MEASURE=VALUES",
     "what the step measures, at the sites centre, top, left, bottom, right: \"thickness=9.1 9.0 "
     "9.2 9.1 9.1 um\", or fewer by name: \"thickness=centre:9.1 left:9.0 um\"; repeatable",
     FW_OPT_LOG, fw_cli_take_site},
    {"setting", 0, "NAME=VALUE",
     "what was really set, of the settings of the step: \"power=251 W\"; repeatable", FW_OPT_LOG,
     fw_cli_take_setting},
    {"coupon", 0, "WORDS",
     "a coupon as calibrate takes it, at the step where it was read: \"arde-slots, drawn=10 um, "
     "value=45.6 45.4 45.7 45.5 45.6 um, u=0.1 um, at=90 min\"; repeatable",
     FW_OPT_LOG, fw_cli_take_coupon},
    {"instrument", 0, "NAME", "with which it was measured", FW_OPT_LOG, fw_cli_take_instrument},
    {"report", 0, "FILE",
     "planned against actual as a page with control charts; - is standard output", FW_OPT_LOG,
     fw_cli_take_report},
    {"port", 0, "N", "port of the page; default: a free one", FW_OPT_SERVE, take_port},
    {"no-browser", 0, NULL, "only print the address", FW_OPT_SERVE, take_no_browser},
    {"ipv6", 0, NULL, "listen on ::1 as well as on 127.0.0.1", FW_OPT_SERVE, take_ipv6},
    {"budget", 0, "SECONDS",
     "how much work to spend, 1 to 3600 s of a machine that does 2.5e9 instructions a second; "
     "default 20. Settings that would go over their share are left out and listed as such",
     FW_OPT_TRADEOFF, take_budget},
    {"no-time", 0, NULL,
     "measure nothing on this machine (times, counted instructions): costs are those of a model, "
     "and the same input gives the same bytes",
     FW_OPT_TRADEOFF, take_no_time},
    {"settings", 0, "LIST",
     "run only the settings LEVEL;METHOD/INTEGRATOR/RTOL,... and print nothing: what the program "
     "starts under callgrind to count instructions",
     FW_OPT_TRADEOFF, take_settings},
    {"quiet", 'q', NULL,
     "no text of a result (of check its first lines), no messages but errors and what is not to be "
     "relied on; --json and files stay",
     FW_OPT_COMMON, take_quiet},
    {"verbose", 'v', NULL, "stages, how far they are, and every note", FW_OPT_COMMON, take_verbose},
    {"color", 0, "WHEN", "auto, always or never", FW_OPT_COMMON, take_colour},
    {"no-progress", 0, NULL, "no progress on a terminal", FW_OPT_COMMON, take_no_progress},
    {"help", 'h', NULL, "this text", FW_OPT_COMMON, take_help},
};
enum { NOPTION = sizeof table / sizeof table[0] };

const fw_cli_option_row *fw_cli_option_rows(size_t *count) {
    *count = NOPTION;
    return table;
}
