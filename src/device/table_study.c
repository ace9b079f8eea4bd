/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: studies, in a device file and in a file of their own. */
#include "device/device.h"
#include "device/device_table.h"

#define FW_STUDY(name, word, sentence) word,
static const char *const kinds[] = {
#include "device/studies.def"
    NULL};
#undef FW_STUDY
#define FW_STUDY(name, word, sentence) "; " word ": " sentence
static const char kinds_are[] =
#include "device/studies.def"
    ".";
#undef FW_STUDY
static const char *const points[] = {[FW_POINTS_GRID] = "grid",
                                     [FW_POINTS_LIST] = "list",
                                     [FW_POINTS_SOBOL] = "sobol",
                                     [FW_POINTS_SOBOL + 1] = NULL};
static const char *const judged[] = {[FW_JUDGE_DRAWN] = "drawn",
                                     [FW_JUDGE_MADE] = "made",
                                     [FW_JUDGE_HINGES] = "hinges",
                                     [FW_JUDGE_DIE] = "die",
                                     [FW_JUDGE_DIE + 1] = NULL};
static const char *const spreads[] = {
    [FW_SPREAD_NORMAL] = "normal",   [FW_SPREAD_LOGNORMAL] = "lognormal",
    [FW_SPREAD_UNIFORM] = "uniform", [FW_SPREAD_TRUNCATED] = "truncated",
    [FW_SPREAD_TABLE] = "table",     [FW_SPREAD_INTERVAL] = "interval",
    [FW_SPREAD_INTERVAL + 1] = NULL};
static const char *const takes[] = {[FW_TAKE_ONE] = "one",
                                    [FW_TAKE_LARGEST] = "largest",
                                    [FW_TAKE_LEAST] = "least",
                                    [FW_TAKE_SUM] = "sum",
                                    [FW_TAKE_SUM + 1] = NULL};
static const char *const goals[] = {[FW_GOAL_NONE] = "none",
                                    [FW_GOAL_MINIMISE] = "minimise",
                                    [FW_GOAL_MAXIMISE] = "maximise",
                                    [FW_GOAL_MAXIMISE + 1] = NULL};
static const char *const levels[] = {[FW_LEVEL_LOT] = "lot",
                                     [FW_LEVEL_WAFER] = "wafer",
                                     [FW_LEVEL_DIE] = "die",
                                     [FW_LEVEL_HINGE] = "hinge",
                                     [FW_LEVEL_HINGE + 1] = NULL};
static const char *const scales[] = {"linear", "logarithmic", NULL};

const char *fw_device_study_kind_text(fw_device_study_kind kind) {
    return kinds[kind];
}

const char *fw_device_study_points_text(fw_device_study_points kind) {
    return points[kind];
}

const char *fw_device_study_judge_text(fw_device_study_judge judge) {
    return judged[judge];
}

const fw_device_study_words fw_device_study_words_of = {kinds, points, judged, spreads,
                                                        takes, goals,  levels};

/* what both rows of <study> have */
#define STUDY_ROWS                                                                                 \
    {"name", ID, REQUIRED, .sentence = "Name of the study; it names outputs."},                    \
        {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = kinds, .sentence = kinds_are + 2},       \
        {"points", .kind = FW_KIND_WORD, .words = points, .fallback = "grid",                      \
         .sentence = "Of a sweep: every combination of the values; the values of all inputs side " \
                     "by side, as many as each has; or a Sobol' sequence over the ranges."},       \
        {"as", .kind = FW_KIND_WORD, .words = judged, .fallback = "made",                          \
         .sentence =                                                                               \
             "How each device is judged: as drawn, or also as its flows make it; or only the "     \
             "hinges and requirements of the drawing, and nothing of clearances, plates and "      \
             "adhesion; of a sweep also as one die, with a value of its own of all that its "      \
             "flow and <uncertain> make differ, by what it uses of its limits, without bands. "    \
             "A yield is of devices as they are made, and takes no other."},                       \
        {"samples",                                                                                \
         D_PURE,                                                                                   \
         WHOLE,                                                                                    \
         RANGE(1, 1e7, "more than ten million devices are several studies"),                       \
         .fallback = "as many as the kind asks for",                                               \
         .sentence = "Devices of a Sobol' sequence or of indices; most of them of a size, or of "  \
                     "each estimate of a yield (at least 200): "                                   \
                     "there are three at each setting of what is only assumed, as computed and "   \
                     "with the limit moved either way by the model's band, and one that merely "   \
                     "counts takes 16 times a power of two."},                                     \
        {"seed",          D_PURE,                                                                  \
         WHOLE,           RANGE(0, 2147483647, "seeds have 31 bits"),                              \
         .fallback = "1", .sentence = "Of random numbers: the same seed gives the same study."},   \
        {"fitted", D_PURE, ABOVE(0, 0.2, "what is off by more tells nothing"), .fallback = "none", \
         .sentence =                                                                               \
             "Of a sweep over a grid or a Sobol' sequence: devices whose decision and numbers "    \
             "response surfaces tell are not judged. Responses may be off by this share of the "   \
             "largest one. none: all devices are judged."},                                        \
        {"confidence", D_PURE, ABOVE(0.5, 0.999999, "of an interval"), .fallback = "0.95",         \
         .sentence = "How often intervals hold the truth."},                                       \
    {                                                                                              \
        "yield", D_PURE, RANGE(0.5, 0.999999, "below, most devices fail; above, nothing is sure"), \
            .fallback = "none",                                                                    \
            .sentence = "Of a size: the share of devices that have to hold every limit, of each "  \
                        "flow, with what its pack and <uncertain> say of how they differ."         \
    }

static const fw_xml_attribute_row study_rows[] = {STUDY_ROWS};
static const fw_xml_attribute_row file_rows[] = {
    STUDY_ROWS,
    {"device", TEXT, REQUIRED,
     .sentence = "The device file; a relative name counts from where this file is."},
};
static const fw_xml_attribute_row vary_rows[] = {
    {"what", TEXT, REQUIRED, .sentence = "A parameter or a path, as --set takes it."},
    {"from", .kind = FW_KIND_ANY, .sentence = "Least value. With to, or else values."},
    {"to", .kind = FW_KIND_ANY, .sentence = "Largest value."},
    {"steps", D_PURE, WHOLE, RANGE(2, 100000, "one step is no sweep"), .fallback = "11",
     .sentence = "How many values of a grid or list, both ends among them."},
    {"scale", .kind = FW_KIND_WORD, .words = scales, .fallback = "linear",
     .sentence = "logarithmic: equal ratios, not differences, between the values."},
    {"values", TEXT, .sentence = "Values as --set takes them, with ; between: \"8 um; 10 um\"."},
};
static const fw_xml_attribute_row uncertain_rows[] = {
    {"what", TEXT, REQUIRED,
     .sentence =
         "A parameter or a path, as --set takes it; flexure[*] stands for all flexures. With "
         "flow: the name of a quantity of it, as the study lists its inputs (thickness)."},
    {"flow", TEXT, .fallback = "of the device",
     .sentence =
         "The quantity is of this flow; what is stated here stands in the place of what its "
         "pack states, and a mean that is not stated is the pack's value."},
    {"level", .kind = FW_KIND_WORD, .words = levels, .fallback = "die",
     .sentence =
         "With what it takes a new value: lot (all wafers of a lot share it), wafer (all dies "
         "of a wafer), die (all hinges of a die), hinge (none; what is then flexure[*]/@...). "
         "Rows of one input on several levels add up: the first has the mean, each other one "
         "is a deviation from it, stated by sd alone or by from and to about 0."},
    {"spread", .kind = FW_KIND_WORD, .words = spreads, .fallback = "normal",
     .sentence = "normal and lognormal: mean and sd; uniform: from and to; truncated: all four; "
                 "table: table; interval: nothing is known but from and to, and the yield is then "
                 "a range."},
    {"mean", .kind = FW_KIND_ANY,
     .sentence = "Mean of the values; of what a size chooses it is what is chosen, and none is "
                 "stated."},
    {"sd", .kind = FW_KIND_ANY, .sentence = "Standard deviation of the values."},
    {"from", .kind = FW_KIND_ANY, .sentence = "Least value."},
    {"to", .kind = FW_KIND_ANY, .sentence = "Largest value."},
    {"table", TEXT,
     .sentence = "Of spread=\"table\": values, each with the share of devices that are up to it, "
                 "with ; between, the "
                 "first with 0 and the last with 1: \"7.8 um 0; 8 um 0.3; 8.4 um 1\". Straight in "
                 "between."},
};
static const fw_xml_attribute_row correlation_rows[] = {
    {"of", TEXT, REQUIRED, .sentence = "As in its <uncertain>, or a quantity of the flow."},
    {"with", TEXT, REQUIRED, .sentence = "The other one, likewise."},
    {"flow", TEXT, .fallback = "of the device",
     .sentence =
         "Both are quantities of this flow, by the names that the study's list of inputs has."},
    {"value", D_PURE, REQUIRED,
     RANGE(-0.999999, 0.999999, "beyond, one of them says all of the other"),
     .sentence = "Pearson's coefficient of correlation of their values."},
};
static const fw_xml_attribute_row trend_rows[] = {
    {"what", TEXT, REQUIRED, .sentence = "As in its <uncertain>, or a quantity of the flow."},
    {"flow", TEXT, .fallback = "of the device", .sentence = "As in its <uncertain>."},
    {"radial", .kind = FW_KIND_ANY, .fallback = "none",
     .sentence =
         "How much more it is at the rim of the wafer than in its centre; in between it goes "
         "with the square of the radius."},
    {"along-x", .kind = FW_KIND_ANY, .fallback = "none",
     .sentence =
         "How much more it is at the rim on the right than in the centre, in a straight line."},
    {"along-y", .kind = FW_KIND_ANY, .fallback = "none",
     .sentence =
         "How much more it is at the rim at the top than in the centre, in a straight line."},
};
static const fw_xml_attribute_row respond_rows[] = {
    {"name", ID, REQUIRED, .sentence = "Name of the column."},
    {"value", TEXT, REQUIRED,
     .sentence = "Where the number stands in a document of --json, by its keys: "
                 "governing.utilisation, hinges[C].utilisation, requirements[stroke].value, "
                 "modes:modes[0].f_Hz; [*] stands for all. The document before the colon "
                 "is one of verdict (without one), simulate, statics, modes, workspace, masks, "
                 "recipes. true and accept count 1; false, inconclusive and reject 0."},
    {"take", .kind = FW_KIND_WORD, .words = takes, .fallback = "one",
     .sentence = "Of several values: the largest, the least, their sum."},
    {"min", .kind = FW_KIND_ANY, .fallback = "no limit",
     .sentence = "At least this, with its unit; without one in that of the number, by its key: um "
                 "of min_space_um."},
    {"max", .kind = FW_KIND_ANY, .fallback = "no limit",
     .sentence =
         "At most this, likewise. Dies of a yield, and of a size at one, are held against both."},
    {"goal", .kind = FW_KIND_WORD, .words = goals, .fallback = "none",
     .sentence = "Of a size: what is wanted of it. Two goals give a Pareto front."},
};

#define INPUTS                                                                                     \
    {"vary", "study", .most = 200, ROWS(vary_rows),                                                \
     .sentence = "An input that the study chooses."},                                              \
        {"uncertain", "study", .most = 200, ROWS(uncertain_rows),                                  \
         .sentence = "An input that differs from device to device, beside what the flow may make " \
                     "of it."},                                                                    \
        {"trend", "study", .most = 200, ROWS(trend_rows),                                          \
         .sentence =                                                                               \
             "How an uncertain input goes over the wafer, the same on every wafer; the mean "      \
             "over the whole wafer stays what it is. The device needs a <wafer>: its dies "        \
             "are the places."},                                                                   \
        {"correlation", "study", .most = 2000, ROWS(correlation_rows),                             \
         .sentence =                                                                               \
             "Two inputs that differ together; of one level. All others are independent."},        \
        {"respond", "study", .most = 1000, ROWS(respond_rows),                                     \
         .sentence = "A number that is looked at."},

const fw_xml_element_row fw_device_table_study[] = {
    {"study", "device", "name", FW_SPACE_STUDY, .most = 100, ROWS(study_rows),
     .sentence = "What is asked of many devices of this description: flexwright study."},
    INPUTS{0},
};

static const fw_xml_element_row alone[] = {
    {"study", "", "name", ROWS(file_rows), .once = true,
     .sentence = "A study in a file of its own; xmlns=\"urn:flexwright:study:1\"."},
    INPUTS{0},
};
static const fw_xml_element_row *const parts[] = {alone, NULL};
static const char *const spaces[] = {"name"};

const fw_xml_table fw_device_study_table = {.file = "study file",
                                            .root = "study",
                                            .urn = "urn:flexwright:study:1",
                                            .head = "name=\"...\" kind=\"...\" device=\"...\"",
                                            .source = "src/device/table_study.c",
                                            .part = parts,
                                            .space = spaces,
                                            .nspace = 1,
                                            .numbers = FW_DEVICE_TABLE_NUMBERS};
