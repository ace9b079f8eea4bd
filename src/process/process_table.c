/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a process pack may hold, and a laboratory pack. The schemas of processes/ come from these
   rows.
   References may lead into base.xml and are looked up by the reader of packs (process_read.c). */
#include "process/coupon.h"
#include "process/pack.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

#define ROWS(a) .attribute = (a), .nattribute = sizeof(a) / sizeof((a)[0])
#define TEXT    .kind = FW_KIND_TEXT
/* ids come into names of files and of cells, and into lines of calendars and tables */
#define TOKEN                                                                                      \
    .kind = FW_KIND_FORM, .form = fw_xml_is_token, .datatype = "NCName", .reason = FW_XML_TOKEN
#define ID                                                                                         \
    { "id", TOKEN, .required = true, .sentence = "Name that references use." }
#define WORD(of) .kind = FW_KIND_WORD, .words = (of)
#define TO(what) .kind = FW_KIND_REF, .datatype = "NCName", .space = 1 + FW_ID_##what
#define REQUIRED .required = true
#define AMOUNT   .kind = FW_KIND_DECIMAL, .ranged = true, .max = 1e9, .reason = "an amount"
#define COUNT                                                                                      \
    .kind = FW_KIND_DECIMAL, .ranged = true, .whole = true, .min = 1, .max = 1e9,                  \
    .reason = "there is at least one"

static const char *const yes_no[] = {"yes", "no", NULL};
static const char *const carriers[] = {"none", "insulating", NULL};
static const char *const source_kinds[] = {"publication", "datasheet", "handbook", "measured",
                                           "convention",  "assumed",   NULL};
static const char *const corners[] = {"edge",   "taper", "anisotropy", "thickness",
                                      "youngs", "local", NULL};
static const char *const operations[] = {
#define X(op, adds_up, goes_on) op,
#include "process/step_kinds.def"
#undef X
    NULL};
static const char *const changes[] = {"add", "remove", "convert", "pattern", NULL};
static const char *const sides[] = {"front", "back", NULL};
static const char *const profiles[] = {"isotropic", "anisotropic", NULL};
static const char *const faces[] = {"top", "middle", "bottom", NULL};
static const char *const shapes[] = {"slot", "cylinder", "linear", NULL};
static const char *const finishes[] = {"rinse", "dry", "cool", "vent", NULL};
static const char *const dryings[] = {"spin",   "nitrogen",       "oven",        "air",
                                      "vapour", "critical-point", "sublimation", NULL};
static const char *const held_by[] = {"tethers", NULL};
static const char *const leavings[] = {"wafers", "dies", NULL};
static const char *const there[] = {"present", "absent", NULL};
static const char *const states[] = {
#define X(name, key, longest, most, is, why) key,
#include "process/wafer_states.def"
#undef X
    NULL};
static const char *const amounts[] = {"L", "kg", "piece", NULL};
static const char *const takers[] = {"wafer", "load", "lot", NULL};
static const char *const outcomes[] = {"rework", "continue", "hold", "scrap", NULL};

static const fw_xml_attribute_row process_rows[] = {
    {"id", TOKEN, REQUIRED, .sentence = "Name of the flow; the device file uses it."},
    {"version", TEXT, REQUIRED, .sentence = "It goes into every run sheet."},
    {"title", TEXT, REQUIRED, .sentence = "What people call the flow."},
    {"material", TO(MATERIAL), .sentence = "Of the device layer; every flow has one."},
    {"thickness", TO(QUANTITY), .sentence = "Of the device layer; every flow has one."},
    {"carrier", WORD(carriers), .fallback = "none",
     .sentence = "insulating: what is not joined in the device layer is insulated."},
};
static const fw_xml_attribute_row open_point_rows[] = {
    {"until", TEXT,
     .sentence = "Quantities with spaces between: once all of them are known, as a "
                 "laboratory states them, the point is no longer open."},
};

static const fw_xml_attribute_row source_rows[] = {
    ID,
    {"kind", WORD(source_kinds), REQUIRED, .sentence = "What sort of source it is."},
    {"date", TEXT, .datatype = "date", .sentence = "When it was published or measured."},
};
static const fw_xml_attribute_row material_rows[] = {
    ID,
    {"name", TEXT, REQUIRED, .sentence = "What people call it."},
    {"criterion", TEXT, .sentence = "What its strength is: fracture, proportional limit or yield."},
    {"contaminates", TEXT, .datatype = "NMTOKEN",
     .sentence = "Group of contaminants that a tool must take."},
    {"holes", WORD(yes_no), .fallback = "no",
     .sentence = "yes: a film that does not protect what is below it."},
    {"conducts", WORD(yes_no), .sentence = "Whether metal can be plated on it."},
};
static const fw_xml_attribute_row equipment_rows[] = {
    ID,
    {"class", TEXT, REQUIRED, .sentence = "What sort of equipment it is."},
    {"capacity", COUNT, REQUIRED, .sentence = "Wafers that it takes at once."},
    {"takes", TEXT, .datatype = "NMTOKENS", .sentence = "Groups of contaminants that it may meet."},
    {"brings", TEXT, .datatype = "NMTOKENS",
     .sentence = "Hazards of whatever is done there: every step at it names them."},
    {"vacuum", WORD(yes_no), .fallback = "no", .sentence = "yes: wafers lie in a pumped chamber."},
    {"sees-back", WORD(yes_no), .fallback = "no",
     .sentence = "yes: an aligner that sees marks of the face that lies down."},
};
static const fw_xml_attribute_row hazard_rows[] = {
    ID,
    {"name", TEXT, .sentence = "What people call it; without: its id."},
    {"ghs", TEXT, .datatype = "NMTOKENS", REQUIRED, .sentence = "Its pictograms."},
    {"buddy", WORD(yes_no), .fallback = "no",
     .sentence = "yes: never alone; a step with it has a second signature."},
    {"wets", WORD(yes_no), .fallback = "no",
     .sentence = "yes: a liquid, which a wafer carries along until it is rinsed."},
    {"reacts-as", TEXT, .datatype = "NMTOKENS",
     .sentence = "Of a liquid: what it reacts as, which says what it must not meet: none"
#define FW_REACTIVITY_GROUP(name, word) ", " word
#include "process/reactivity.def"
#undef FW_REACTIVITY_GROUP
                 "; of all but none there may be several."},
};
static const fw_xml_attribute_row consumable_rows[] = {
    ID,
    {"name", TEXT, REQUIRED, .sentence = "What people call it, with its strength or grade."},
    {"unit", WORD(amounts), .fallback = "L",
     .sentence =
         "What it is counted in. Its price is the quantity ID.price, in a currency per L, "
         "per kg or for a piece; a laboratory pack may give it although the pack does not."},
    {"hazard", TO(HAZARD), .sentence = "What is dangerous about it."},
};
static const fw_xml_attribute_row bath_rows[] = {
    ID,
    {"name", TEXT, REQUIRED, .sentence = "What people call it."},
    {"hazard", TO(HAZARD), REQUIRED,
     .sentence = "What is dangerous about the mixture; every step that uses it names it, too."},
    {"volume", TO(QUANTITY), .sentence = "Of one filling."},
    {"one-part", TO(QUANTITY), .sentence = "Or volume of one part; the filling is all of them."},
    {"serves", TO(QUANTITY),
     .sentence = "How many wafers go through one filling, one after the other; without: all of a "
                 "lot, and every step has a filling of its own."},
    {"keeps", TO(QUANTITY),
     .sentence = "How long it may be used after it was mixed, by the log after its first use where "
                 "that is not in it; the schedule keeps to it. Without: nothing says so."},
};
static const fw_xml_attribute_row part_rows[] = {
    {"of", TO(CONSUMABLE), REQUIRED, .sentence = "Of what."},
    {"q", TO(QUANTITY), REQUIRED,
     .sentence = "How much: parts by volume of a liquid; of what is counted in kg mass or amount "
                 "of substance per volume of the bath, or its share by mass."},
    {"molar-mass", TO(QUANTITY), .sentence = "Where q is an amount of substance per volume."},
    {"density", TO(QUANTITY), .sentence = "Of the bath, where q is a share by mass."},
};
static const fw_xml_attribute_row uses_rows[] = {
    {"bath", TO(BATH), .sentence = "A bath that the step works in."},
    {"consumable", TO(CONSUMABLE), .sentence = "Or what it uses up by itself."},
    {"q", TO(QUANTITY), .sentence = "How much of the consumable: a volume, a mass or a number."},
    {"per", WORD(takers), .fallback = "wafer",
     .sentence = "load: of as many wafers as the step takes at once."},
};
static const fw_xml_attribute_row align_rows[] = {
    {"to", TEXT, REQUIRED, .sentence = "Mask that an earlier step has exposed."},
    {"side", WORD(sides), .fallback = "front",
     .sentence = "Of the wafer that this plate is on; back: its marks are looked at through the "
                 "wafer or from below, and the plate is the mirror image."},
    {"overlay", TO(QUANTITY), REQUIRED, .sentence = "Largest distance of the two images."},
    {"marks", TEXT, .datatype = "NMTOKENS",
     .sentence = "Patterns of the mask table that show it, by their ids."},
};
static const fw_xml_attribute_row alternative_rows[] = {
    {"id", TOKEN, REQUIRED, .sentence = "Name that a laboratory pack uses."},
    {"title", TEXT, REQUIRED, .sentence = "What people call it."},
};
static const fw_xml_attribute_row tool_rows[] = {
    {"equipment", TOKEN, REQUIRED, .sentence = "An equipment of the flow."},
    {"open", TEXT,
     .sentence = "Hours between which a whole run lies, as 09:00-12:00,13:00-17:00; or it is "
                 "closed on days."},
    {"days", TEXT, .datatype = "NMTOKENS",
     .sentence = "With open: Mon Tue Wed Thu Fri Sat Sun, those that it is open on; without, all."},
    {"closed", TEXT, .datatype = "date",
     .sentence = "First day on which it may not be used, as a whole; what another lot books for "
                 "hours cannot be stated."},
    {"to", TEXT, .datatype = "date", .sentence = "Last one; without, closed is the only one."},
};
static const fw_xml_attribute_row choose_rows[] = {
    {"alternative", TOKEN, REQUIRED, .sentence = "An alternative of the flow."},
};
static const fw_xml_attribute_row waste_rows[] = {
    {"stream", TEXT, REQUIRED, .sentence = "Container that it goes into."},
};
static const fw_xml_attribute_row incompatible_rows[] = {
    {"with", TO(HAZARD), REQUIRED, .sentence = "What it must not meet."},
};
static const fw_xml_attribute_row attacks_rows[] = {
    {"material", TO(MATERIAL), REQUIRED, .sentence = "What it dissolves or sputters."},
};
static const fw_xml_attribute_row corner_rows[] = {
    {"of", WORD(corners), REQUIRED,
     .sentence = "What is not made exactly as drawn; local: by how much the "
                 "edges of one hinge may stand apart from those of the others, either way: "
                 "by the largest size that the range of q has (0 +-0.07 um, 0.14 um and 0 to "
                 "0.14 um all say 0.14 um)."},
    {"name", TEXT, REQUIRED, .sentence = "What reports call it."},
    {"q", TO(QUANTITY),
     .sentence =
         "Its range is the corner; none for youngs. Of a thickness: a length beside the planned "
         "one, or the share of it that comes out, which follows whatever is planned."},
    {"assumed", TO(QUANTITY),
     .sentence =
         "Whose range holds where q is unknown. Without it an unknown q has no range: nothing "
         "that the flow makes is accepted before it is known (FW-D694)."},
    {"within", TO(QUANTITY),
     .sentence =
         "A quantity that holds this one, too, once it was measured: the corner falls away then."},
    {"etched", WORD(yes_no),
     .sentence =
         "yes: q is an edge that isotropic etches leave, and as uncertain as their rates make it."},
};
static const fw_xml_attribute_row plate_rows[] = {
    {"id", TOKEN, REQUIRED, .sentence = "That of its row in the layer table."},
    {"inside", TOKEN, REQUIRED, .sentence = "What the part of the wafer is called that it draws."},
    {"outside", TOKEN, REQUIRED, .sentence = "... and the rest of it."},
    {"shrink", TO(QUANTITY),
     .sentence =
         "Length by which it is printed inside of what is drawn: what its step takes sideways."},
    {"within", TEXT, .fallback = "everywhere",
     .sentence = "Parts of which all hold wherever the inside is, such as \"structure bond\"."},
};
static const fw_xml_attribute_row finished_rows[] = {
    {"material", TO(MATERIAL), REQUIRED, .sentence = "Which layer."},
    {"is", WORD(there), REQUIRED, .sentence = "Whether it is still there at the end."},
    {"where", TOKEN, .fallback = "all",
     .sentence =
         "structure: in what stays of the device; field: in all else; or a part of a <plate>."},
};
static const fw_xml_attribute_row step_rows[] = {
    ID,
    {"op", WORD(operations), REQUIRED, .sentence = "What is done."},
    {"title", TEXT, REQUIRED, .sentence = "What people call the step."},
    {"equipment", TO(EQUIPMENT), REQUIRED, .sentence = "Where it is done."},
    {"in-source", WORD(yes_no), REQUIRED, .sentence = "Does the publication describe the step?"},
    {"mask", TEXT, .sentence = "Layer of the mask that it exposes."},
    {"batch", COUNT, .fallback = "1", .sentence = "Wafers at once."},
    {"leaves", WORD(leavings), .fallback = "wafers",
     .sentence =
         "dies: the step parts the wafer, and from the next one on the sheet is of the dies "
         "of each wafer, in a box of their own."},
    {"second-signature", WORD(yes_no), .fallback = "no", .sentence = "Two people sign."},
    {"attended", AMOUNT, .fallback = "0", .sentence = "How many minutes somebody must be there."},
    {"bears", TO(QUANTITY),
     .sentence =
         "Of a step that puts the device's own voltages on its drives: the highest one that "
         "what it is done with bears."},
    {"only-with", WORD(held_by),
     .sentence =
         "Of a step that only such a device needs: for one whose <die> has tethers=\"no\" it "
         "is left out of everything, and the sheet says so."},
};
static const fw_xml_attribute_row change_rows[] = {
    {"kind", WORD(changes), REQUIRED, .sentence = "What the step does to the wafer."},
    {"material", TO(MATERIAL), REQUIRED, .sentence = "To which layer, or what it becomes."},
    {"thickness", TO(QUANTITY), .sentence = "How much of it."},
    {"where", TOKEN, .fallback = "all",
     .sentence = "structure: what stays of the device; field: all else; or a part of a <plate>. "
                 "With reach, all means that everything comes off, frame and bases, too, and only "
                 "islands are asked to stay; with field, what carries the device has to."},
    {"spans", WORD(yes_no), .fallback = "no",
     .sentence = "add: it lies on the highest ground, and hollows below it stay hollow."},
    {"from", TO(MATERIAL), .sentence = "convert: what is turned into the material."},
    {"side", WORD(sides), .fallback = "front", .sentence = "Of the wafer."},
    {"profile", WORD(profiles), .fallback = "anisotropic",
     .sentence = "isotropic: it undercuts its mask."},
    {"anisotropy", TO(QUANTITY), .sentence = "Of a masked etch: 1 less lateral over vertical."},
    {"compensate", WORD(faces), .fallback = "middle",
     .sentence = "The face whose edge the mask brings to where it is drawn."},
    {"spread", TO(QUANTITY),
     .sentence = "Of a plating: largest local thickness over the mean, at least 1 (1.12 where the "
                 "thickest place has 12 % more)."},
    {"across", TO(QUANTITY),
     .sentence = "Diameter of the circle about the wafer's centre inside which it is made."},
    {"reach", TO(QUANTITY),
     .sentence = "remove: how far it goes sideways from every opening, below what stays."},
};
static const fw_xml_attribute_row exposed_rows[] = {
    {"material", TO(MATERIAL), REQUIRED, .sentence = "What lies open and is taken along."},
    {"rate", TO(QUANTITY), .sentence = "Its own rate."},
    {"selectivity", TO(QUANTITY), .sentence = "Or the selectivity of the etch to it."},
};
static const fw_xml_attribute_row set_rows[] = {
    {"name", TEXT, REQUIRED, .sentence = "What is set."},
    {"q", TO(QUANTITY), REQUIRED, .sentence = "To which value."},
    {"tol-lo", TEXT, REQUIRED, .sentence = "Lowest that is tolerated, in the unit of q; or empty."},
    {"tol-hi", TEXT, REQUIRED, .sentence = "Highest that is tolerated; or empty."},
};
static const fw_xml_attribute_row time_rows[] = {
    {"law", TOKEN, REQUIRED, .sentence = "How the time is computed."},
    {"overrun", TEXT, REQUIRED,
     .sentence = "Share that is added beyond the end: a number, or the id of a quantity."},
    {"k", .kind = FW_KIND_DECIMAL, .ranged = true, .min = 1, .max = 4,
     .reason = "below 1 a third of all wafers are outside, above 4 none ever is", REQUIRED,
     .sentence = "Standard uncertainties between first look and clear-by."},
    {"shape", WORD(shapes), .sentence = "Of what is filled or emptied, where the law asks."},
    {"id", TOKEN,
     .sentence =
         "Values derived in the step and later laws may use the time, over-etch included, by it."},
    {"pulse", TO(QUANTITY), .sentence = "The step is done in parts of at most this time."},
    {"pause", TO(QUANTITY), .sentence = "How long it pauses between the parts."},
};
static const fw_xml_attribute_row derive_rows[] = {
    {"name", TEXT, REQUIRED, .sentence = "What is computed on the way."},
    {"unit", TEXT, REQUIRED, .sentence = "In which it is shown."},
    {"law", TOKEN, REQUIRED, .sentence = "How it is computed."},
    {"shape", WORD(shapes), .sentence = "Of what is filled or emptied, where the law asks."},
    {"id", TOKEN, .sentence = "Later laws may use the value by this name."},
    {"most", TO(QUANTITY), .sentence = "Above it the plan warns."},
};
static const fw_xml_attribute_row argument_rows[] = {
    {"name", TEXT, REQUIRED, .sentence = "Argument of the law."},
    {"q", TO(QUANTITY), REQUIRED, .sentence = "Its value."},
};
static const fw_xml_attribute_row accept_rows[] = {
    {"measure", TEXT, REQUIRED, .sentence = "What is measured."},
    {"lo", TEXT, REQUIRED, .sentence = "Lowest that is accepted; or empty."},
    {"hi", TEXT, REQUIRED, .sentence = "Highest that is accepted; or empty."},
    {"unit", TEXT, REQUIRED, .sentence = "Of lo, hi and planned."},
    {"planned", TEXT,
     .sentence =
         "What a wafer reads that comes out as planned: outside of lo and hi the plan warns."},
    {"sites", COUNT, REQUIRED, .sentence = "At how many sites of a wafer."},
    {"every", COUNT, REQUIRED, .sentence = "On every so many wafers."},
    {"coupon", TEXT, .datatype = "NCName",
     .sentence = "Pattern of the test die that is looked at: an id of masks/FLOW.xml."},
    {"only-with", WORD(held_by),
     .sentence = "Measured on such a device only: not where its <die> has tethers=\"no\"."},
};
static const fw_xml_attribute_row hazard_ref_rows[] = {
    {"ref", TO(HAZARD), REQUIRED, .sentence = "A hazard of the step."},
};
static const fw_xml_attribute_row on_fail_rows[] = {
    {"if", TEXT, REQUIRED, .sentence = "What was found."},
    {"then", WORD(outcomes), REQUIRED, .sentence = "What becomes of the wafer."},
    {"goto", TO(STEP), .sentence = "Where it goes on."},
};
static const fw_xml_attribute_row finish_rows[] = {
    {"kind", WORD(finishes), REQUIRED, .sentence = "What is done."},
    {"with", TO(HAZARD), .sentence = "rinse: in which chemical; without: in deionised water."},
    {"by", WORD(dryings), .sentence = "dry: how."},
    {"tension", TO(QUANTITY),
     .sentence = "dry: surface tension of the liquid whose meniscus passes over the wafer; of "
                 "devices that are free the "
                 "verdict then says whether they bear it. Without: that of the alcohol with "
                 "vapour, none at the critical "
                 "point and by sublimation."},
    {"angle", TO(QUANTITY),
     .sentence = "dry: its contact angle, as a range; without: dry.angle of the pack."},
    {"q", TO(QUANTITY), .sentence = "How long; without: within the time of the step."},
};
static const fw_xml_attribute_row requires_rows[] = {
    {"step", TO(STEP), .sentence = "A step that must have been done before."},
    {"material", TO(MATERIAL), .sentence = "Or a layer that is there, or is not."},
    {"state", WORD(states), .sentence = "Or what the wafer is like, or is not."},
    {"is", WORD(there), .fallback = "present", .sentence = "Whether it is there."},
    {"where", TOKEN, .fallback = "all",
     .sentence = "Of a layer. structure: in what stays of the device; field: in all else; or a "
                 "part of a <plate>."},
};
static const fw_xml_attribute_row lag_rows[] = {
    {"from", TO(STEP), REQUIRED, .sentence = "The step from whose end it is counted."},
    {"min", AMOUNT, .sentence = "Shortest wait."},
    {"max", AMOUNT, .sentence = "Longest wait."},
    {"unit", TEXT, REQUIRED, .sentence = "Of time, for min and max."},
};

#define Q_ROW(parents)                                                                             \
    {                                                                                              \
        "q", parents, "id",                                                                        \
            .apart = true, .attribute = fw_xml_quantity_rows, .nattribute = FW_QUANTITY_ROWS,      \
            .sentence = "A number with its unit, uncertainty, status and source, or unknown."      \
    }
static const fw_xml_element_row pack_rows[] = {
    {"process", "", ROWS(process_rows), .sentence = "A process pack."},
    {"source", "process", "id", .text = true, .needed = true, ROWS(source_rows),
     .sentence = "Where numbers are from."},
    {"material", "process", "id", ROWS(material_rows), .sentence = "A material of the wafer."},
    {"equipment", "process", "id", .text = true, ROWS(equipment_rows),
     .sentence = "A machine or a bench."},
    {"hazard", "process", "id", ROWS(hazard_rows), .sentence = "What is dangerous."},
    {"consumable", "process", "id", ROWS(consumable_rows),
     .sentence = "A chemical, a gas or a piece that a lot uses up."},
    {"bath", "process", "id", .text = true, ROWS(bath_rows),
     .sentence = "What a bath is mixed from; the text says how."},
    Q_ROW("process material"),
    {"corner", "process", ROWS(corner_rows),
     .sentence = "What a flow does not make exactly as drawn."},
    {"plate", "process", ROWS(plate_rows),
     .sentence = "A plate that the flow prints besides the device's."},
    {"finished", "process", ROWS(finished_rows),
     .sentence = "What must be true of the wafer when the flow has ended."},
    {"open-point", "process", ROWS(open_point_rows), .text = true,
     .sentence = "What the source leaves open."},
    {"alternative", "process", ROWS(alternative_rows),
     .sentence = "Another way of doing a step: a whole step with the id of the one whose place "
                 "it takes when a laboratory pack chooses it."},
    {"step", "process alternative", "id", ROWS(step_rows), .sentence = "A step of the flow."},
    {"ppe", "hazard", .text = true, .once = true, .needed = true,
     .sentence = "Protection that people wear."},
    {"firstaid", "hazard", .text = true, .once = true, .needed = true,
     .sentence = "What to do at once."},
    {"waste", "hazard", .text = true, .once = true, .needed = true, ROWS(waste_rows),
     .sentence = "Where it goes afterwards."},
    {"incompatible", "hazard", ROWS(incompatible_rows), .sentence = "Two that must not meet."},
    {"attacks", "hazard", ROWS(attacks_rows), .sentence = "What it harms."},
    {"part", "bath", .needed = true, ROWS(part_rows), .sentence = "What the bath is mixed from."},
    {"purpose", "step", .text = true, .once = true, .needed = true,
     .sentence = "Why the step is there."},
    {"change", "step", ROWS(change_rows), .sentence = "What becomes of a layer."},
    {"exposed", "step", ROWS(exposed_rows), .sentence = "What the chemistry takes along."},
    {"set", "step", ROWS(set_rows), .sentence = "A setting of the machine."},
    {"time", "step", .once = true, .needed = true, ROWS(time_rows),
     .sentence = "How long the step takes."},
    {"derive", "step", ROWS(derive_rows), .sentence = "Another law on the way."},
    {"endpoint", "step", .text = true, .needed = true, .sentence = "How people see its end."},
    {"accept", "step", .needed = true, ROWS(accept_rows), .sentence = "What is measured after it."},
    {"uses", "step", ROWS(uses_rows), .sentence = "What the step uses up."},
    {"align", "step", .once = true, ROWS(align_rows),
     .sentence = "To which earlier mask its own is aligned, and how well."},
    {"hazard-ref", "step", ROWS(hazard_ref_rows), .sentence = "A hazard that it has."},
    {"on-fail", "step", .text = true, .needed = true, ROWS(on_fail_rows),
     .sentence = "What to do where it failed."},
    {"requires", "step", ROWS(requires_rows),
     .sentence = "What must be true of the wafer before the step."},
    {"finish", "step", .text = true, ROWS(finish_rows),
     .sentence = "What is done at the same bench before the wafer leaves it, in this order."},
    {"lag", "step", ROWS(lag_rows), .sentence = "A shortest or longest wait since another step."},
    {"arg", "time derive", ROWS(argument_rows), .sentence = "An argument of the law."},
    {"needs", "time", ROWS(argument_rows),
     .sentence = "What must be known although the law does not take it."},
    {"expr", "time derive", .text = true, .once = true, .sentence = "The law expr as a formula."},
    {0},
};

static const fw_xml_attribute_row laboratory_rows[] = {
    {"id", TOKEN, .sentence = "Name of the pack."},
    {"version", TEXT, .sentence = "Of the pack."},
    {"title", TEXT, .sentence = "What people call it."},
    {"flow", TOKEN, REQUIRED, .sentence = "id of the flow whose values it replaces."},
};
static const fw_xml_attribute_row laboratory_source_rows[] = {
    ID,
    {"kind", WORD(source_kinds), .sentence = "What sort of source it is."},
    {"date", TEXT, .datatype = "date", .sentence = "When it was measured."},
};
static const fw_xml_attribute_row correlation_rows[] = {
    {"of", TEXT, REQUIRED, .sentence = "ids of the quantities, with blanks between."},
};
static const fw_xml_attribute_row row_rows[] = {
    {"of", TOKEN, REQUIRED,
     .sentence = "The quantity of this row; rows stand in the order of the ids."},
    {"values", TEXT, REQUIRED,
     .sentence = "Its correlations with all of them, -1 to 1, with blanks between; 1 with itself."},
};
static const fw_xml_attribute_row with_rows[] = {
    {"q", TOKEN, REQUIRED, .sentence = "A quantity of the flow."},
    {"value", TEXT, .sentence = "What it was then, a number; left out: it was not known."},
    {"unit", TEXT, .sentence = "Of the value."},
    {"of", TEXT, REQUIRED,
     .sentence = "ids of what was found with it, with blanks between: where a plan has another "
                 "value of q together with these, it says so."},
};
static const fw_xml_element_row laboratory[] = {
    {"process", "", ROWS(laboratory_rows), .sentence = "Values of a laboratory."},
    {"source", "process", "id", .text = true, ROWS(laboratory_source_rows),
     .sentence = "Where numbers are from."},
    {"tool", "process", ROWS(tool_rows),
     .sentence = "When a machine may be used; of several for one machine each holds."},
    {"choose", "process", ROWS(choose_rows), .sentence = "How the laboratory does a step."},
    Q_ROW("process"),
    {"correlation", "process", ROWS(correlation_rows),
     .sentence =
         "How the errors of quantities go together that were found from the same measurements."},
    {"row", "correlation", .needed = true, ROWS(row_rows), .sentence = "A row of the matrix."},
    {"with", "process", ROWS(with_rows),
     .sentence = "A value of the flow with which calibrate found values of this pack."},
    {0},
};

static const fw_xml_element_row *const pack_parts[] = {pack_rows, NULL};
static const fw_xml_element_row *const laboratory_parts[] = {laboratory, NULL};
static const char *const spaces[] = {"name",     "source", "material",   "equipment", "hazard",
                                     "quantity", "step",   "consumable", "bath"};
#define FILE_OF(what, rows)                                                                        \
    .file = what, .root = "process", .urn = "urn:flexwright:process:1",                            \
    .source = "src/process/process_table.c", .part = rows, .space = spaces,                        \
    .nspace = sizeof spaces / sizeof spaces[0]

const fw_xml_table fw_process_pack_table = {FILE_OF("process pack", pack_parts),
                                            .head = "id=\"...\" version=\"...\" title=\"...\"",
                                            .numbers = {.root = 178,
                                                        .element = 160,
                                                        .misplaced = 160,
                                                        .once = 51,
                                                        .needed = 180,
                                                        .attribute = 161,
                                                        .at_value = true,
                                                        .missing = 162,
                                                        .text = 49,
                                                        .word = 163,
                                                        .form = 545,
                                                        .range = 171,
                                                        .whole = 171,
                                                        .decimal = 171}};
const fw_xml_table fw_process_laboratory_table = {FILE_OF("laboratory pack", laboratory_parts),
                                                  .head = "id=\"lab\" flow=\"...\"",
                                                  .numbers = {.root = 178,
                                                              .element = 211,
                                                              .misplaced = 211,
                                                              .once = 51,
                                                              .needed = 211,
                                                              .attribute = 211,
                                                              .at_value = true,
                                                              .missing = 211,
                                                              .text = 49,
                                                              .word = 163,
                                                              .form = 545,
                                                              .range = 211,
                                                              .whole = 211,
                                                              .decimal = 211}};

/* ---- kinds of steps: step_kinds.def ---- */

typedef enum adds_up { FW_ADDS_UP_NOT, FW_ADDS_UP, FW_ADDS_UP_BY_LAW } adds_up;
typedef struct step_kind {
    const char *op;
    adds_up adds_up;
    fw_process_goes_on goes_on;
} step_kind;

static const step_kind *kind_of(const fw_process_step *s) {
    static const step_kind row[] = {
#define X(op, adds_up, goes_on) {op, adds_up, goes_on},
#include "process/step_kinds.def"
#undef X
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        if (strcmp(s->op, row[i].op) == 0) return &row[i];
    return NULL;
}

bool fw_process_step_adds_up(const fw_process_step *s) {
    const step_kind *of = kind_of(s);
    const fw_process_law *law = fw_process_law_find(s->law);
    return of &&
           (of->adds_up == FW_ADDS_UP || (of->adds_up == FW_ADDS_UP_BY_LAW && law && !law->stated));
}

fw_process_goes_on fw_process_step_goes_on(const fw_process_step *s) {
    const step_kind *of = kind_of(s);
    return of ? of->goes_on : FW_GOES_ON_NOT;
}

bool fw_process_step_runs_on(const fw_process_step *s) {
    return fw_process_step_goes_on(s) != FW_GOES_ON_NOT;
}

/* Is R + e I positive definite? Cholesky's factorization: the first pivot that is not above zero says no. e = 1e-5 stands
   for what is lost by writing six digits. R (n n) symmetric with a unit diagonal. Cost n^3/3.
   Source: Golub and Van Loan, Matrix Computations, 4.2. Test: test_correlation.c, wrong_matrices. */
bool fw_process_correlation_possible(const double *r, int n, double *L) {
    const double lost = 1e-5;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++) {
            double sum = r[i * n + k] + (i == k ? lost : 0.0);
            for (int j = 0; j < k; j++)
                sum -= L[i * n + j] * L[k * n + j];
            if (i == k && !(sum > 0.0)) return false;
            L[i * n + k] = i == k ? sqrt(sum) : sum / L[k * n + k];
        }
    return true;
}
