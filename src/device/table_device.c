/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: what a device is made of and what it is for; and the whole of the table. */
#include "base/constants.h"
#include "device/device.h"
#include "device/device_table.h"
#include <string.h>

/* ---- what the device is for ---- */

#define FW_PROBE(name, ...) #name,
static const char *const probe_kinds[] = {
#include "device/probes.def"
    NULL};
#undef FW_PROBE
#define FW_PROBE(name, unit, suffix, m, kg, s, A, rad, takes, sentence)                            \
    "; " #name " (" unit "): " sentence
static const char probe_kinds_are[] =
#include "device/probes.def"
    ".";
#undef FW_PROBE
#define FW_PROBE(name, unit, suffix, m, kg, s, A, rad, takes, sentence)                            \
    {#name, unit, suffix, {m, kg, s, A, 0, 0, rad, 0}, takes, sentence},
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
static const char *const planes[] = {"either", "in", "across", NULL};
#define PLANE                                                                                      \
    "Among which modes a frequency is counted: in: the motions in the plane; across: those of "    \
    "the "                                                                                         \
    "device as plates on its flexures, out of it; either: both, by frequency, where both are "     \
    "known."
static const fw_xml_attribute_row probe_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id for requirements; it names columns and plots."},
    {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = probe_kinds, .sentence = probe_kinds_are + 2},
    {"on", REF(FW_SPACE_BODY),
     .sentence =
         "Body that carries the point, or that turns. A point goes against the substrate, also "
         "where heat or stress makes the layer longer."},
    {"x", PLACE, .fallback = "0 mm", .sentence = FW_POINT_OF_BODY},
    {"y", PLACE, .fallback = "0 mm", .sentence = FW_POINT_OF_BODY},
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
    {"plane", .kind = FW_KIND_WORD, .words = planes, .fallback = "either", .sentence = PLANE},
};
static const fw_xml_attribute_row require_rows[] = {
    {"probe", REF(FW_SPACE_PROBE),
     .sentence = "What is judged. Exactly one of probe and frequency."},
    {"frequency", D_PURE, WHOLE, RANGE(1, 1000, "modes are counted from 1, by stiffness"),
     .sentence = "Which mode's frequency is judged."},
    {"plane", .kind = FW_KIND_WORD, .words = planes, .fallback = "either",
     .sentence = "With frequency. " PLANE},
    {"measure", .kind = FW_KIND_WORD, .words = measures, .fallback = "peak",
     .sentence =
         "What of its course over the scene: peak: the largest size; maximum, minimum; "
         "final: at the end; peak-to-peak: maximum less minimum; settling-time: after which "
         "it stays within the band about where it comes to rest under the loads that the scene "
         "ends with; parasitic: the largest displacement across the direction."},
    {"min", .kind = FW_KIND_ANY, .fallback = "no bound", .sentence = "At least this."},
    {"max", .kind = FW_KIND_ANY, .fallback = "no bound", .sentence = "At most this."},
    {"band", .kind = FW_KIND_ANY,
     .sentence =
         "Of a settling time: how far from where it comes to rest still counts as settled."},
    {"scene", REF(FW_SPACE_SCENE),
     .fallback = "every scene that has the probe; of stiffness, compliance and frequency: at rest",
     .sentence = "In which scene; of stiffness, compliance and frequency: about the worst of "
                 "the equilibria along its laws."},
};

static const fw_xml_element_row probe_elements[] = {
    {"probe", "device", "id", FW_SPACE_PROBE, .most = 200, ROWS(probe_rows),
     .sentence = "A quantity to look at: a column of motions, a plot, a number of results."},
    {"require", "device", .most = 200, ROWS(require_rows),
     .sentence = "What is asked of a probe: part of the verdict."},
    {0},
};

/* ---- what it is made of ---- */

#define FW_DEVICE_FLEXURE(name, sentence) #name,
static const char *const flexure_kinds[] = {
#include "device/flexures.def"
    NULL};
#undef FW_DEVICE_FLEXURE
#define FW_DEVICE_FLEXURE(name, sentence) "; " #name ": " sentence
static const char flexure_kinds_are[] =
#include "device/flexures.def"
    ".";
#undef FW_DEVICE_FLEXURE
static const char *const carriers[] = {"none", "insulating", NULL};
static const char *const yes_no[] = {"yes", "no", NULL};
static const char *const wafer_centres[] = {"auto", "die", "street", NULL};
static const char *const wafer_sides[] = {"bottom", "top", "left", "right", NULL};
static const char *const wafer_alignments[] = {"none", "2 sites", NULL};
static const char *const order_materials[] = {"soda-lime", "quartz", NULL};
static const char *const order_tones[] = {"as drawn", "inverted", NULL};
static const char *const order_mirrors[] = {"as read", "yes", "no", NULL};
static const char *const wafer_assignments[] = {"round-robin", "blocks", NULL};

static const fw_xml_attribute_row device_rows[] = {
    {"name", ID, REQUIRED, .sentence = "Name of the device; it names outputs and the GDSII cell."},
};
static const fw_xml_attribute_row parameter_rows[] = {
    {"name", .kind = FW_KIND_NAME, REQUIRED,
     .sentence = "Name for expressions; not a unit symbol and not a function."},
    {"value", .kind = FW_KIND_ANY, REQUIRED,
     .sentence = "Number with unit or an expression; it may use other parameters."},
    {"min", .kind = FW_KIND_ANY, .fallback = "no limit",
     .sentence = "Least value that --set, the page and studies may give."},
    {"max", .kind = FW_KIND_ANY, .fallback = "no limit",
     .sentence = "Greatest value that --set, the page and studies may give."},
    {"doc", TEXT, .sentence = "One sentence for the page."},
};
static const fw_xml_attribute_row material_rows[] = {
    {"ref", ID, REQUIRED, .sentence = "Id of a material in processes/base.xml."},
    {"youngs-modulus", D_PRESSURE,
     RANGE(1e6, 2e12, "below 1 MPa are gels and foams; no material is stiffer than 2 TPa"),
     .fallback = "the material's",
     .sentence = "Young's modulus for bending in the wafer plane, in every direction. Of a crystal "
                 "the elastic constants still say how the layer gives way to its stress, unless "
                 "poisson is stated with it."},
    {"poisson", D_PURE, ABOVE(-1, 0.5, "elastic stability of an isotropic body"),
     .fallback = "the material's",
     .sentence =
         "Poisson's ratio; of a crystal out of the plane, where youngs-modulus is not stated."},
    {"density", D_DENSITY,
     RANGE(1, 3e4, "no solid to build of is lighter than 1 kg/m3 or denser than 30000 kg/m3"),
     .fallback = "the material's", .sentence = "Density."},
    {"strength", D_PRESSURE,
     RANGE(1e3, 2e11,
           "what is weaker than 1 kPa cannot be handled; no material is stronger than 200 GPa"),
     .fallback = "the material's", .sentence = "Stress that the safety factor divides."},
    {"thickness", THICKNESS, .fallback = "the flow's",
     .sentence = "Thickness of the device layer."},
    {"orientation", TURN, .fallback = "45 deg: the wafer's flat, along <110>, is parallel to x",
     .sentence =
         "Of a crystal: angle of its [100] from the device's +x. Its modulus then goes with "
         "the direction of every hinge, unless youngs-modulus is stated."},
    {"weibull-strength", SOME_STRESS,
     .sentence = "Of fracture: stress sigma0 at which 63 % of surfaces of weibull-area break; only "
                 "together with weibull-modulus and weibull-area."},
    {"weibull-modulus", D_PURE,
     ABOVE(0, 200, "0 or below is no distribution; 3 to 30 are reported"),
     .fallback = "the material's", .sentence = "Of fracture: m, the higher the less scatter."},
    {"weibull-area", .kind = FW_KIND_NUMBER, .dimension = {.m = 2}, .unit = "mm^2",
     ABOVE(0, 1, "a surface on which strength was measured has an area, far below 1 m2"),
     .fallback = "the material's",
     .sentence = "Of fracture: surface A0 that was stressed when sigma0 was found."},
    {"offset-yield", SOME_STRESS, .sentence = "Of yield: the 0.2 % offset value."},
    {"proportional-factor", D_PURE,
     ABOVE(0, 1, "the proportional limit lies below the 0.2 % offset value"),
     .fallback = "the material's",
     .sentence = "Of yield: proportional limit over the 0.2 % offset value."},
    {"film-yield", SOME_STRESS,
     .sentence = "Of yield of films: A of the 0.2 % offset A + B (t/1 um)^-n at thickness t."},
    {"film-yield-rise", SOME_STRESS, .sentence = "Of yield of films: B."},
    {"film-exponent", D_PURE, ABOVE(0, 2, "thin films are stronger; 0.5 to 1 is reported"),
     .fallback = "the material's", .sentence = "Of yield of films: n."},
    {"film-thickest", THICKNESS, .fallback = "the material's",
     .sentence = "Of yield of films: thickness up to which the law was found."},
    {"fatigue-strength", SOME_STRESS,
     .sentence = "Of fatigue: amplitude, fully reversed, that lasts fatigue-cycles; only together "
                 "with it."},
    {"fatigue-cycles", D_PURE, ABOVE(0, 1e15, "no device lives for more than 1e15 cycles"),
     .fallback = "the material's", .sentence = "Of fatigue: cycles that fatigue-strength lasts."},
    {"fatigue-exponent", D_PURE, RANGE(-0.999, -1e-6, "more cycles bear less"),
     .fallback = "the material's", .sentence = "Of fatigue: b of Basquin's law."},
    {"ductility", D_PURE, ABOVE(0, 10, "a plastic strain amplitude above 10 is not known"),
     .fallback = "the material's",
     .sentence = "Of fatigue: plastic strain amplitude at one reversal (Manson and Coffin)."},
    {"ductility-exponent", D_PURE, RANGE(-0.999, -1e-6, "more cycles bear less"),
     .fallback = "the material's", .sentence = "Of fatigue: c of Manson and Coffin's law."},
};
static const fw_xml_attribute_row limits_rows[] = {
    {"safety-factor", D_PURE, RANGE(1, 100, "below 1 the limit itself would be exceeded"),
     .fallback = "1.5", .sentence = "Strength divided by the stress that is allowed."},
    {"cycles", D_PURE, RANGE(1, 1e15, "a scene is run at least once"), .fallback = "none: static",
     .sentence = "How often every scene is repeated: fatigue is judged as well."},
    {"failure-probability", D_PURE,
     ABOVE(0, 0.5, "never is not to be had, and a device that more often breaks than not is none"),
     .fallback = "none: the material's plain strength",
     .sentence =
         "Of the whole device, of a material that fractures: its Weibull data then rule. All "
         "flexures together may break with it, whichever has how much of it."},
    {"clearance", SIZE, .fallback = "none: parts that move do not meet",
     .sentence = "That everything that moves keeps from whatever it may meet, in every scene and "
                 "required pose, as drawn and as made."},
    {"survival", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "yes: metals may pass their proportional limit up to the 0.2 % offset, as in a "
                 "shock behind which accuracy does not matter."},
};
static const fw_xml_attribute_row flow_rows[] = {
    {"ref", ID, REQUIRED, .sentence = "Name of a process pack, e.g. al-masked-rie."},
    {"material", ID, .fallback = "the device's", .sentence = "Id of the material in this flow."},
    {"thickness", THICKNESS, .fallback = "the device's",
     .sentence = "Thickness of the device layer in this flow."},
    {"orientation", TURN, .fallback = "the device's",
     .sentence = "Angle of the crystal's [100] from the device's +x in this flow."},
    {"carrier", .kind = FW_KIND_WORD, .words = carriers, .fallback = "none",
     .sentence =
         "What a device that its flow cuts out of the wafer is put on afterwards: none, so that "
         "all that is anchored is one conductor; insulating (borosilicate glass), so that only "
         "what is joined in the layer is. A flow that has a carrier of its own says itself what "
         "it is."},
};
static const fw_xml_attribute_row flexure_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id for hinges to refer to."},
    {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = flexure_kinds,
     .sentence = flexure_kinds_are + 2}, /* without the first semicolon */
    {"length", SIZE,
     .sentence = "Along the centre line, from face to face. csfh: exactly two of "
                 "length, radius and angle."},
    {"radius", SIZE, .sentence = "Of the arc's centre line (csfh only)."},
    {"angle", D_ANGLE, .unit = "deg",
     ABOVE(0, 330 * FW_PI / 180, "beyond 330 deg the ends of the arc meet"),
     .sentence = "Subtended by the arc (csfh only)."},
    {"width", THIN, REQUIRED,
     .sentence = "Of the thin part, in the wafer plane; with width-middle at its two ends, of a "
                 "path where it begins. At most a quarter of the length: formulas of beams hold "
                 "for no stouter one (FW-D059)."},
    {"width-middle", THIN, .fallback = "width",
     .sentence =
         "Half way along a csfh or leaf; each edge is then one arc through the ends and the "
         "middle."},
    {"gap", GAP, .fallback = "0 um", .sentence = "Of the conjugate surfaces; 0: none."},
    {"fillet", GAP, .fallback = "chosen by the layout",
     .sentence = "Radius at the roots. Strain and limit rest on it, whether or not the device is "
                 "laid out: one that is chosen is as "
                 "wide as the flexure (of a path: as the narrower of its ends), at arcs at most a "
                 "third of their inner radius; the "
                 "layout draws a smaller one where the roots have no room for it. `hinge` and "
                 "`check -v` say how large it is."},
};
#define PIECE_WIDTHS                                                                               \
    {"width", THIN, .fallback = "where the piece before it ends",                                  \
     .sentence = "Where it begins; the first piece begins with the width of the flexure."},        \
        {"width-middle", THIN, .fallback = "half way between width and width-end",                 \
         .sentence = "Half way along; each edge is one arc through start, middle and end."},       \
    {                                                                                              \
        "width-end", THIN, .fallback = "width", .sentence = "Where it ends."                       \
    }
static const fw_xml_attribute_row line_rows[] = {
    {"length", SIZE, REQUIRED, .sentence = "Of the centre line."},
    PIECE_WIDTHS,
};
static const fw_xml_attribute_row arc_rows[] = {
    {"radius", SIZE, REQUIRED, .sentence = "Of the centre line."},
    {"angle", D_ANGLE, .unit = "deg",
     RANGE(-330 * FW_PI / 180, 330 * FW_PI / 180, "beyond 330 deg the ends of an arc meet"),
     REQUIRED, .sentence = "By which it turns: to the left above 0, to the right below."},
    PIECE_WIDTHS,
};
static const fw_xml_attribute_row workspace_rows[] = {
    {"flow", REF(FW_SPACE_FLOW), .fallback = "all flows", .sentence = "Only in this flow."},
    {"x-min", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"x-max", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"y-min", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"y-max", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"phi-min", TURN, REQUIRED, .sentence = "Platform rotation from the drawn pose."},
    {"phi-max", TURN, REQUIRED, .sentence = "Platform rotation from the drawn pose."},
};
static const fw_xml_attribute_row die_rows[] = {
    {"width", SIZE, .fallback = "from the drawn mechanism", .sentence = "Of the chip."},
    {"height", SIZE, .fallback = "from the drawn mechanism", .sentence = "Of the chip."},
    {"frame", GAP, .fallback = "chosen by the layout", .sentence = "Width of the frame."},
    {"lane", GAP, .fallback = "chosen by the layout", .sentence = "Width of the dicing lane."},
    {"clearance", GAP, .fallback = "chosen by the layout",
     .sentence = "Between moving parts and the frame."},
    {"anchor", D_LENGTH, .unit = "um",
     RANGE(40e-6, 5e-3, "narrower than a tether nothing holds; " WAFER),
     .fallback = "chosen by the layout",
     .sentence =
         "Width of the bases of ground hinges: of their bars, and of what leads from them to "
         "the frame. What is wider keeps its bond longer in a release."},
    {"pad", D_LENGTH, .unit = "um",
     RANGE(100e-6, 5e-3, "a probe needs a square of 80 um, clear of edges; " WAFER),
     .fallback = "150 um",
     .sentence = "Side of the part of a stator's pad that is bonded. What is wider keeps its bond "
                 "longer in a release."},
    {"title", TEXT, .fallback = "the device's name", .sentence = "Written on the die."},
    {"tethers", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "yes",
     .sentence = "Thin bridges that hold the mechanism until they are broken."},
    {"fill", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "Thief and fill in the window, joined to the frame, in flows that have them "
                 "(window-thief and window-fill of the layer table): copper is plated more evenly. "
                 "They keep out of what is drawn; what moves farther needs a larger keep-out."},
    {"release-pitch", GAP, .fallback = "no holes",
     .sentence = "Pitch of round release holes in bodies that are wider than the release reaches "
                 "between them, heads and necks of hinges too; mass and inertia are without them."},
    {"release-hole", GAP, .fallback = "0.3 release-pitch",
     .sentence = "Diameter of a release hole."},
};

static const char *const cell_units[] = {"um", "nm", "mm", "cm", "m", "in", "mil", NULL};
static const fw_xml_attribute_row cell_rows[] = {
    {"id", ID, .fallback = "the name of the cell, or of the file",
     .sentence = "Name in messages and lists."},
    {"file", TEXT, REQUIRED,
     .sentence = "A GDSII or DXF file, beside the device file or below it. Of GDSII the "
                 "boundaries, boxes and paths, "
                 "with all cells that it refers to; texts are left out."},
    {"cell", TEXT, .fallback = "the only top cell", .sentence = "Cell of a GDSII file."},
    {"unit", .kind = FW_KIND_WORD, .words = cell_units, .fallback = "what the file says",
     .sentence = "What one unit of a DXF file is; where the file says so too ($INSUNITS), both "
                 "must agree."},
    {"x", POSITION, .fallback = "0 mm",
     .sentence = "Where its origin lies: in the device's axes, on a wafer from its middle."},
    {"y", POSITION, .fallback = "0 mm", .sentence = "See x."},
    {"angle", TURN, .fallback = "0 deg", .sentence = "By which it is turned about its origin."},
    {"mirror", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "Drawn as its mirror image (y becomes -y), before it is turned."},
    {"layers", TEXT, .fallback = "its only layer goes to mask",
     .sentence =
         "Which of its layers go where: FROM>TO; FROM>TO. FROM is NUMBER/DATATYPE, NUMBER, or of "
         "DXF a name. TO is "
         "mask (the layer that draws the device), a role, id or name of the flow's layer table, or "
         "NUMBER/DATATYPE: a layer of the table, or else one of the cell's own that is on no "
         "plate."},
    {"bias", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence =
         "no: it is on the mask as it was drawn; yes: with the bias of the layer that it goes to."},
};

static const fw_xml_attribute_row wafer_rows[] = {
    {"diameter", D_LENGTH, .unit = "mm", RANGE(10e-3, 0.305, WAFER), .fallback = "100 mm",
     .sentence = "Of the wafer. Within 2 % of 50.8, 76.2, 100, 125, 150, 200 or 300 mm it is that "
                 "size, with the flat or notch of SEMI M1."},
    {"flat", GAP, .fallback = "of SEMI M1",
     .sentence = "Length of the primary flat; 0: none. Needed for other diameters."},
    {"flat-side", .kind = FW_KIND_WORD, .words = wafer_sides, .fallback = "bottom",
     .sentence = "Where flat or notch lie, seen as drawn."},
    {"edge-exclusion", D_LENGTH, .unit = "mm",
     RANGE(1e-4, 0.1, "no die reaches nearer than the bevel; a wafer is at most 300 mm wide"),
     .fallback = "3 mm", .sentence = "Rim, at the flat too, into which no die reaches."},
    {"pitch-x", SIZE, .fallback = "the die with its lane", .sentence = "From die to die along x."},
    {"pitch-y", SIZE, .fallback = "the die with its lane", .sentence = "From die to die along y."},
    {"centre", .kind = FW_KIND_WORD, .words = wafer_centres, .fallback = "auto",
     .sentence = "What lies in the wafer's centre: a die, a crossing of streets, or what gives the "
                 "most dies."},
    {"alignment", .kind = FW_KIND_WORD, .words = wafer_alignments, .fallback = "none",
     .sentence = "2 sites: the outermost dies left and right of the centre give way to alignment "
                 "crosses."},
    {"test-dies", D_PURE, WHOLE, RANGE(0, 9, "nine places, from the centre outwards"),
     .fallback = "0", .sentence = "Dies that give way to the die with the coupons."},
    {"assign", .kind = FW_KIND_WORD, .words = wafer_assignments, .fallback = "round-robin",
     .sentence = "How the steps of a sweep are laid on columns and rows: in turn, or side by side "
                 "in blocks."},
    {"plate", D_LENGTH, .unit = "mm", RANGE(10e-3, 0.4, "plates are at most 14 inches wide"),
     .fallback = "the next plate in inches, 20 mm larger than the wafer",
     .sentence = "Edge of the square mask plate."},
    {"title", TEXT, .fallback = "the die's title", .sentence = "Written on the plate."},
};
static bool is_code_39(const char *text) {
    size_t n = strlen(text);
    return n >= 1 && n <= 40 && strspn(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 -.$/+%") == n;
}

static const fw_xml_attribute_row order_rows[] = {
    {"plate", .kind = FW_KIND_ID, .fallback = "all plates that have no <order> of their own",
     .sentence = "Plate of a flow that prints several, by its id in the layer table. What it does "
                 "not say is as in the <order> of all plates."},
    {"material", .kind = FW_KIND_WORD, .words = order_materials, .fallback = "soda-lime",
     .sentence = "Of the plate. Quartz is for exposure below 350 nm and for close registration."},
    {"thickness", D_LENGTH, .unit = "mm", RANGE(0.5e-3, 20e-3, "plates are 1 to 13 mm thick"),
     .fallback = "as usual for the size", .sentence = "Of the plate."},
    {"mirror", .kind = FW_KIND_WORD, .words = order_mirrors, .fallback = "as read",
     .sentence = "Are the written data the mirror image of the drawing? as read: the written file "
                 "is what is seen with the chrome up."},
    {"tone", .kind = FW_KIND_WORD, .words = order_tones, .fallback = "as drawn",
     .sentence = "inverted: the written polygons are what the drawing leaves free within 4 mm of "
                 "the plate's edge, and the tone of the data is the other one."},
    {"scale", D_PURE, RANGE(0.1, 10, "projection printers reduce at most ten times"),
     .fallback = "1",
     .sentence = "Of all that lies on the wafer, about the plate's middle: 5 for a reticle, 1.0002 "
                 "where a bond shrinks. Title, barcode and crosses of the plate stay, and cells "
                 "beyond the wafer."},
    {"size", D_LENGTH, .unit = "mm", RANGE(10e-3, 0.4, "plates are at most 14 inches wide"),
     .fallback = "plate of <wafer>; of one die the next plate in inches, 20 mm larger",
     .sentence = "Edge of the square plate; one for all plates."},
    {"cd-tolerance", D_LENGTH, .unit = "um",
     RANGE(10e-9, 10e-6, "plates are held to 0.01 to 10 um"),
     .fallback = "from the verdict: what the governing hinge can bear",
     .sentence = "What a width on the plate may be off by, either way."},
    {"registration", D_LENGTH, .unit = "um",
     RANGE(10e-9, 10e-6, "plates are held to 0.01 to 10 um"),
     .fallback = "a third of the closest overlay that the flow asks for",
     .sentence = "What a place on the plate may be off by, either way."},
    {"defect", D_LENGTH, .unit = "um", RANGE(50e-9, 100e-6, "what inspection sees"),
     .fallback = "a third of the least feature or space",
     .sentence = "Largest defect that may stay."},
    {"pellicle", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "A film over the plate; not for contact or proximity printing."},
    {"quantity", D_PURE, WHOLE, RANGE(1, 100, "an order of more is a mistake"), .fallback = "1",
     .sentence = "How many plates."},
    {"barcode", .kind = FW_KIND_FORM, .form = is_code_39, .fallback = "none",
     .reason = "A to Z, 0 to 9, space and - . $ / + %, 1 to 40 of them: Code 39 has no other signs",
     .sentence = "Text of a Code 39 that stands beside the wafer, on the left of the drawing."},
    {"flat-line", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "A line on the plate whose inner edge is where the wafer's flat lies."},
};
static const fw_xml_attribute_row sweep_rows[] = {
    {"parameter", REF(FW_SPACE_PARAMETER), REQUIRED,
     .sentence = "Which parameter differs from die to die."},
    {"from", .kind = FW_KIND_ANY, REQUIRED, .sentence = "Its first value."},
    {"to", .kind = FW_KIND_ANY, REQUIRED, .sentence = "Its last value."},
    {"steps", D_PURE, WHOLE, REQUIRED,
     RANGE(2, 64, "one step is no sweep; 64 devices are judged and drawn at most"),
     .sentence = "How many values, evenly spaced."},
};

static const fw_xml_element_row own[] = {
    {"device", "", "name", ROWS(device_rows), .once = true,
     .sentence = "One planar compliant mechanism; xmlns=\"urn:flexwright:device:1\"."},
    {"parameter", "device", "name", FW_SPACE_PARAMETER, .most = 200, ROWS(parameter_rows),
     .sentence = "A named value that expressions use and --set, the page and studies may change."},
    {"material", "device", "ref", .once = true, ROWS(material_rows),
     .sentence = "What the device is made of; attributes replace the material's own values."},
    {"limits", "device", .once = true, ROWS(limits_rows), .sentence = "What the verdict asks for."},
    {"flow", "device", "ref", FW_SPACE_FLOW, .most = 50, ROWS(flow_rows),
     .sentence = "A fabrication flow to plan for."},
    {"flexure", "device", "id", FW_SPACE_FLEXURE, .most = 4000, ROWS(flexure_rows),
     .sentence = "Geometry of a flexure hinge."},
    {"line", "flexure", .most = 40000, ROWS(line_rows), .sentence = "A straight piece of a path."},
    {"arc", "flexure", .most = 40000, ROWS(arc_rows), .sentence = "A circular piece of a path."},
    {"workspace", "device", .most = 200, ROWS(workspace_rows),
     .sentence = "Platform poses that must be reachable, relative to the drawn pose: displacements "
                 "of the platform's centre of mass (of its drawing, or where its mass is stated), "
                 "and rotations about it. What holds a pose is as strong as it takes: loads of "
                 "scenes are there without their size, so that no payload is at a pose; required "
                 "stiffness and frequency are not those at poses, and the way from one box to "
                 "another is not looked at. For these a scene drives to the pose."},
    {"die", "device", .once = true, ROWS(die_rows), .sentence = "The chip around the mechanism."},
    {"wafer", "device", .once = true, ROWS(wafer_rows),
     .sentence = "Step and repeat of the die on a wafer, and the mask plate for it."},
    {"cell", "device", "id", .most = 200, ROWS(cell_rows),
     .sentence = "A finished drawing that goes onto the mask of every die."},
    {"cell", "wafer", "id", .most = 200, ROWS(cell_rows),
     .sentence = "The same, beside the dies of the wafer."},
    {"order", "device", .most = 20, ROWS(order_rows),
     .sentence = "What the mask shop is asked for; all that is not said has a value of its own. "
                 "Without a <wafer> one die stands in the plate's middle."},
    {"order", "wafer", .most = 20, ROWS(order_rows),
     .sentence = "The same, of the plates of the wafer."},
    {"sweep", "wafer", .most = 2, ROWS(sweep_rows),
     .sentence = "A parameter that differs from die to die: the first along columns, the second "
                 "along rows."},
    {0},
};

static const fw_xml_element_row *const parts[] = {own,
                                                  fw_device_table_mechanism,
                                                  fw_device_table_shapes,
                                                  fw_device_table_scene,
                                                  fw_device_table_effects,
                                                  probe_elements,
                                                  fw_device_table_study,
                                                  NULL};
static const char *const spaces[FW_SPACE_COUNT] = {
    "name",   "parameter", "flow",   "flexure",    "body",    "joint", "spring",
    "driver", "scene",     "tendon", "comb-drive", "contact", "probe", "study"};

const fw_xml_table fw_device_table = {.file = "device file",
                                      .root = "device",
                                      .urn = "urn:flexwright:device:1",
                                      .head = "name=\"...\"",
                                      .source = "src/device/table_*.c",
                                      .part = parts,
                                      .space = spaces,
                                      .nspace = FW_SPACE_COUNT,
                                      .names = FW_SPACE_PARAMETER,
                                      .numbers = FW_DEVICE_TABLE_NUMBERS};
