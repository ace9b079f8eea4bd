/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: what the device is for. */
#include "device/device.h"
#include "device/device_table.h"

#define FW_PROBE(name, ...) #name,
static const char *const kinds[] = {
#include "device/probes.def"
    NULL};
#undef FW_PROBE
#define FW_PROBE(name, unit, suffix, m, kg, s, rad, takes, sentence)                               \
    "; " #name " (" unit "): " sentence
static const char kinds_are[] =
#include "device/probes.def"
    ".";
#undef FW_PROBE
#define FW_PROBE(name, unit, suffix, m, kg, s, rad, takes, sentence)                               \
    {#name, unit, suffix, {m, kg, s, 0, 0, 0, rad, 0}, takes, sentence},
const fw_device_probe_kind fw_device_probe_kinds[FW_PROBE_KINDS] = {
#include "device/probes.def"
};
#undef FW_PROBE

static const char *const measures[] = {
    [FW_MEASURE_PEAK] = "peak",
    [FW_MEASURE_MAXIMUM] = "maximum",
    [FW_MEASURE_MINIMUM] = "minimum",
    [FW_MEASURE_FINAL] = "final",
    [FW_MEASURE_PEAK_TO_PEAK] = "peak-to-peak",
    [FW_MEASURE_SETTLING] = "settling-time",
    [FW_MEASURE_PARASITIC] = "parasitic",
    [FW_MEASURE_PARASITIC + 1] = NULL,
};

const char *fw_device_measure_text(fw_device_measure measure) {
    return measures[measure];
}

bool fw_device_probe_moves(const fw_device_probe_kind *kind) {
    return kind->takes != FW_PROBE_TANGENT && kind->takes != FW_PROBE_MODE;
}

#define POINT "In the frame of the body; on ground in the world."
static const fw_xml_attribute_row probe_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id for requirements; it names columns and plots."},
    {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = kinds, .sentence = kinds_are + 2},
    {"on", REF(FW_SPACE_BODY), .sentence = "Body that carries the point, or that turns."},
    {"x", PLACE, .fallback = "0 mm", .sentence = "Point in the body's frame."},
    {"y", PLACE, .fallback = "0 mm", .sentence = "Point in the body's frame."},
    {"direction", TURN, .fallback = "the size of the vector",
     .sentence = "From the world's x axis; of an opening in the frame of a. Stiffness and "
                 "compliance need it."},
    {"a", REF(FW_SPACE_BODY), .ground = true,
     .sentence = "Body of the first point or outline, or ground."},
    {"a-x", PLACE, .fallback = "0 mm", .sentence = POINT},
    {"a-y", PLACE, .fallback = "0 mm", .sentence = POINT},
    {"b", REF(FW_SPACE_BODY), .ground = true,
     .sentence = "Body of the second point or outline, or ground."},
    {"b-x", PLACE, .fallback = "0 mm", .sentence = POINT},
    {"b-y", PLACE, .fallback = "0 mm", .sentence = POINT},
    {"of", TEXT,
     .sentence = "Id of what carries a force, torque or power: a joint, driver or spring, or of a "
                 "scene a tendon, comb drive or contact; in scenes without that there is no value. "
                 "Of an angle: a revolute joint."},
    {"mode", D_PURE, WHOLE, RANGE(1, 1000, "modes are counted from 1, by stiffness"),
     .fallback = "1", .sentence = "Which mode, of a frequency."},
};
static const fw_xml_attribute_row require_rows[] = {
    {"probe", REF(FW_SPACE_PROBE),
     .sentence = "What is judged. Exactly one of probe and frequency."},
    {"frequency", D_PURE, WHOLE, RANGE(1, 1000, "modes are counted from 1, by stiffness"),
     .sentence = "Which mode's frequency is judged."},
    {"measure", .kind = FW_KIND_WORD, .words = measures, .fallback = "peak",
     .sentence =
         "What of its course over the scene: peak: the largest size; maximum, minimum; "
         "final: at the end; peak-to-peak: maximum less minimum; settling-time: after which "
         "it stays within the band about its final value; parasitic: the largest "
         "displacement across the direction."},
    {"min", .kind = FW_KIND_ANY, .fallback = "no bound", .sentence = "At least this."},
    {"max", .kind = FW_KIND_ANY, .fallback = "no bound", .sentence = "At most this."},
    {"band", .kind = FW_KIND_ANY,
     .sentence = "Of a settling time: how far from the final value still counts as settled."},
    {"scene", REF(FW_SPACE_SCENE),
     .fallback = "every scene that has the probe; of stiffness, compliance and frequency: at rest",
     .sentence = "In which scene; of stiffness, compliance and frequency: about the equilibrium "
                 "under its loads."},
};

const fw_xml_element_row fw_device_table_probe[] = {
    {"probe", "device", "id", FW_SPACE_PROBE, .most = 200, ROWS(probe_rows),
     .sentence = "A quantity to look at: a column of motions, a plot, a number of results."},
    {"require", "device", .most = 200, ROWS(require_rows),
     .sentence = "What is asked of a probe: part of the verdict."},
    {0},
};
