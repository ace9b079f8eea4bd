/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: <scene> with its loads. */
#include "device/device_table.h"

static const fw_xml_attribute_row scene_rows[] = {
    {"name", ID, REQUIRED, .sentence = "Name of the scene."},
    {"duration", D_TIME, REQUIRED,
     RANGE(1e-12, 1e9,
           "nothing that this model holds for moves within 1 ps, and no motion takes longer than "
           "1e9 s, thirty years"),
     .sentence = "How long the motion is followed."},
    {"flow", REF(FW_SPACE_FLOW), .fallback = "all flows", .sentence = "Only in this flow."},
};
static const fw_xml_attribute_row force_rows[] = {
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that it pulls."},
    {"x", PLACE, .fallback = "0 mm", .sentence = FW_POINT_OF_BODY},
    {"y", PLACE, .fallback = "0 mm", .sentence = FW_POINT_OF_BODY},
    {"fx", D_FORCE, .fallback = "0 uN", .sentence = "Along the world's x axis."},
    {"fy", D_FORCE, .fallback = "0 uN", .sentence = "Along the world's y axis."},
};
static const fw_xml_attribute_row torque_rows[] = {
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that it turns."},
    {"value", D_TORQUE, REQUIRED, .sentence = "Positive counter-clockwise, from x to y."},
};
static const fw_xml_attribute_row gravity_rows[] = {
    {"gx", D_GRAVITY, .fallback = "0 m/s^2", .sentence = "Along the world's x axis."},
    {"gy", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Along the world's y axis; -9.81 m/s^2 where y points up."},
    {"gz", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Across the plane, away from the carrier; -9.81 m/s^2 where the device lies on a "
                 "table. It moves "
                 "nothing in the plane: the device's sag is judged."},
};
static const fw_xml_attribute_row initial_rows[] = {
    {"body", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that moves at the start."},
    {"vx", D_SPEED, .fallback = "0 mm/s", .sentence = "Velocity of the centre of mass."},
    {"vy", D_SPEED, .fallback = "0 mm/s", .sentence = "Velocity of the centre of mass."},
    {"omega", D_SPIN, .fallback = "0 rad/s", .sentence = "Angular velocity."},
};

const fw_xml_element_row fw_device_table_scene[] = {
    {"scene", "device", "name", FW_SPACE_SCENE, .most = 200, ROWS(scene_rows),
     .sentence = "What acts on the mechanism, and for how long; the verdict holds for all scenes."},
    {"force", "scene", .timed = true, ROWS(force_rows),
     .sentence = "A force on a point of a body; the point moves with it, the direction stays."},
    {"torque", "scene", .timed = true, ROWS(torque_rows), .sentence = "A torque on a body."},
    {"gravity", "scene", .once = true, ROWS(gravity_rows), .sentence = "Weight of all bodies."},
    {"initial", "scene", ROWS(initial_rows),
     .sentence = "Velocity of a body at the start; without any the device is at rest before, where "
                 "it is drawn. What is not given, of this body or of others, "
                 "follows through the joints; what they do not allow is corrected, as little as "
                 "possible."},
    {0},
};

/* Rows of the table: what else can act in a <scene>. Each calls for the effect of its name. */

static const char *const pad_places[] = {"probed", "edge", NULL};
static const char *const electrode_kinds[] = {"comb", "plate", NULL};
static const char *const contact_sides[] = {"inside", "outside", NULL};
static const char *const undrawn_words[] = {"placed", "etched", NULL};
static const char *const air_kinds[] = {"slide", "squeeze", "drag", NULL};

#define D_VOLTAGE   .kind = FW_KIND_NUMBER, .dimension = {2, 1, -3, -1, 0, 0, 0, 0}, .unit = "V"
#define D_KELVIN    .kind = FW_KIND_NUMBER, .dimension = {.K = 1}, .unit = "K"
#define D_PER_K     .kind = FW_KIND_NUMBER, .dimension = {.K = -1}, .unit = "ppm/K"
#define D_AREA      .kind = FW_KIND_NUMBER, .dimension = {.m = 2}, .unit = "mm^2"
#define D_VISCOSITY .kind = FW_KIND_NUMBER, .dimension = {-1, 1, -1, 0, 0, 0, 0, 0}, .unit = "uPa s"
#define D_STRESS    .kind = FW_KIND_NUMBER, .dimension = {-1, 1, -2, 0, 0, 0, 0, 0}, .unit = "MPa"
#define D_STRESS_SLOPE                                                                             \
    .kind = FW_KIND_NUMBER, .dimension = {-2, 1, -2, 0, 0, 0, 0, 0}, .unit = "MPa/um"
#define BODY_POINT_X                                                                               \
    "Point in the body's frame, whose origin is the centroid of what is drawn of a link or "       \
    "platform without mass; on ground in the world."

/* ---- actuators ---- */

static const fw_xml_attribute_row tendon_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the cable, its own in this scene."},
    {"pull", D_FORCE, RANGE(0, 1e20, "a cable only pulls; 1e20 N is beyond any structure"),
     .sentence = "Tension that an actuator keeps, times the law. Exactly one of pull and draw."},
    {"draw", PLACE,
     .sentence = "Length of cable that an actuator takes in, times the law; needs stiffness."},
    {"stiffness", D_LINEAR_K,
     ABOVE(
         0, 1e20,
         "a cable that is drawn in needs a stiffness to be under tension; no structure is stiffer"),
     .sentence =
         "Of the whole cable: tension per length by which it is stretched; only with draw."},
    {"damping", D_LINEAR_C, ELASTIC, .fallback = "0 N s/m",
     .sentence = "Of the whole cable, while it is taut: tension per speed; only with draw."},
    {"slack", PLACE, .fallback = "0 mm",
     .sentence = "Length that the cable has to spare as drawn; negative: it is stretched by that "
                 "much. Only with draw."},
    {"expansion", D_PER_K, RANGE(-0.01, 0.01, "no solid stretches by 1 % per kelvin"),
     .fallback = "0: it keeps its length",
     .sentence =
         "Of the cable: its own thermal expansion, where the scene has a temperature, which "
         "it then has too. Only with draw."},
};
static const fw_xml_attribute_row eyelet_rows[] = {
    {"on", REF(FW_SPACE_BODY), .ground = true, REQUIRED,
     .sentence = "Body that carries it, or ground."},
    {"x", PLACE, .fallback = "0 mm", .sentence = BODY_POINT_X},
    {"y", PLACE, .fallback = "0 mm", .sentence = BODY_POINT_X},
    {"hole", D_LENGTH, .unit = "um",
     RANGE(16e-6, 2e-3, "the cut that opens it is 12 um wide; beyond 2 mm it is no eyelet"),
     .fallback = "80 um", .sentence = "Diameter of its hole as drawn. Changes the mask only."},
    {"ring", D_LENGTH, .unit = "um",
     RANGE(5e-6, 2e-3,
           "what is thinner than 5 um is near the rules of the masks; beyond 2 mm it is no eyelet"),
     .fallback = "30 um",
     .sentence = "Width of material around the hole, at least: what of it lies outside of the body "
                 "is added to it, in the mask and in its mass."},
};
static const fw_xml_attribute_row comb_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the drive, its own in this scene."},
    {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = electrode_kinds,
     .sentence = "comb: fingers that are drawn in between others; plate: two faces that attract "
                 "each other."},
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that carries the rotor."},
    {"against", REF(FW_SPACE_BODY), .ground = true, .fallback = "ground",
     .sentence = "What carries the stator."},
    {"x", PLACE, .fallback = "0 mm",
     .sentence = "comb: middle of the overlap; plate: of the rotor's face. In the rotor's frame."},
    {"y", PLACE, .fallback = "0 mm",
     .sentence = "comb: middle of the overlap; plate: of the rotor's face. In the rotor's frame."},
    {"direction", TURNS, REQUIRED,
     .sentence = "In the frame of the stator, from its x axis. comb: where the rotor is pulled to, "
                 "along the fingers; plate: from rotor to stator, across the gap."},
    {"fingers", D_PURE, WHOLE,
     RANGE(1, 1e6, "a comb has at least one finger, and no wafer carries a million"),
     .sentence = "comb: fingers of the rotor, each between two of the stator."},
    {"gap", D_LENGTH, .unit = "um",
     ABOVE(0, 0.3, "electrodes that touch are short-circuited; " WAFER), REQUIRED,
     .sentence = "comb: on either side of a finger; plate: between the faces."},
    {"overlap", D_LENGTH, .unit = "um",
     ABOVE(0, 0.3, "the formula holds for fingers that are engaged; " WAFER),
     .sentence = "comb: by which the fingers are engaged as drawn."},
    {"length", D_LENGTH, .unit = "um", ABOVE(0, 0.3, "a face needs a length; " WAFER),
     .fallback = "comb: twice the overlap",
     .sentence = "comb: of the fingers; plate: of the faces, along the wafer."},
    {"width", D_LENGTH, .unit = "um",
     RANGE(1e-6, 1e-3,
           "contact lithography prints nothing below 1 um; beyond 1 mm it is no finger"),
     .fallback = "8 um",
     .sentence = "comb: of every finger, of rotor and stator. Changes the mask, the rotor's "
                 "mass and the field at the fingers' edges."},
    {"depth", THICKNESS, .fallback = "thickness of the device layer",
     .sentence = "Of the electrodes, across the wafer. Masks draw them through all of the layer, "
                 "and what is made is "
                 "judged: another depth is warned of."},
    {"voltage", D_VOLTAGE, RANGE(-1e4, 1e4, "gaps of micrometres break down far below 10 kV"),
     .sentence =
         "Between rotor and stator, times the law; the force goes with its square. 0 V drives "
         "nothing, and the electrodes are there all the same."},
    {"pad", .kind = FW_KIND_WORD, .words = pad_places, .fallback = "probed",
     .sentence = "Where the stator is contacted: probed on its pad, or at the edge of the chip, to "
                 "which a track leads through a gap in the frame (in flows with an insulating "
                 "carrier). What any scene says of a drive holds."},
};
static const fw_xml_attribute_row base_rows[] = {
    {"ax", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Acceleration of the base along the world's x axis, times the law."},
    {"ay", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Acceleration of the base along the world's y axis, times the law."},
    {"az", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Acceleration of the base across the plane, times the law: a shock to which the "
                 "device is judged as "
                 "plates on its flexures."},
};

/* ---- surfaces ---- */

static const fw_xml_attribute_row friction_rows[] = {
    {"on", REF(FW_SPACE_JOINT), REQUIRED,
     .sentence = "A revolute, a hinge of <six-bar>, or a prismatic."},
    {"coefficient", D_PURE,
     RANGE(0, 10, "friction brakes; rubber on rubber comes to 2, clean metals in vacuum to 10"),
     REQUIRED, .sentence = "While it slides: friction force over normal force."},
    {"static-coefficient", D_PURE,
     RANGE(0, 10, "friction brakes; rubber on rubber comes to 2, clean metals in vacuum to 10"),
     .fallback = "coefficient", .sentence = "While it sticks: at least as large as coefficient."},
    {"radius", D_LENGTH, .unit = "um", ABOVE(0, 1e7, "without an arm friction has no torque; " FAR),
     .fallback = "of the hinge's conjugate surfaces",
     .sentence = "Of the pin or of what else slides, on which the friction force has its arm; not "
                 "for a prismatic."},
    {"preload", D_FORCE, RANGE(0, 1e20, "surfaces only press; 1e20 N is beyond any structure"),
     .fallback = "0 uN", .sentence = "Normal force that is there without the joint's own force."},
};
static const fw_xml_attribute_row contact_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the contact, its own in this scene."},
    {"on", REF(FW_SPACE_JOINT),
     .sentence = "A hinge with a flexure, whose conjugate surfaces touch where the gap closes; the "
                 "flexure then may be pressed and stretched. Either on, or a and b."},
    {"gap", D_LENGTH, .unit = "um",
     ABOVE(0, 0.3, "surfaces without a gap touch from the start, on all sides; " WAFER),
     .fallback = "the flexure's", .sentence = "With on: between the conjugate surfaces as made."},
    {"a", REF(FW_SPACE_BODY), .ground = true,
     .sentence = "What carries the first round thing (inside: the hole), or ground."},
    {"a-x", PLACE, .fallback = "0 mm", .sentence = "Its centre. " BODY_POINT_X},
    {"a-y", PLACE, .fallback = "0 mm", .sentence = "Its centre. " BODY_POINT_X},
    {"a-face", TURNS,
     .sentence = "With a and b, outside: a is no round thing but a flat face through its point, "
                 "which counts as endless. "
                 "Where its normal points, away from a's material, from the x axis of a."},
    {"b", REF(FW_SPACE_BODY), .ground = true,
     .sentence = "What carries the second round thing (inside: the disc), or ground."},
    {"b-x", PLACE, .fallback = "0 mm", .sentence = "Its centre. " BODY_POINT_X},
    {"b-y", PLACE, .fallback = "0 mm", .sentence = "Its centre. " BODY_POINT_X},
    {"side", .kind = FW_KIND_WORD, .words = contact_sides,
     .sentence = "With a and b. inside: a disc in a hole; outside: two discs side by side."},
    {"distance", LENGTH,
     .sentence = "With a and b: of the centres when the two touch. inside: radius of the hole less "
                 "that of the disc; outside: both radii together."},
    {"stiffness", D_LINEAR_K,
     ABOVE(0, 1e20, "without stiffness nothing is held back; beyond is no structure"),
     .fallback = "with on: of the line contact of the surfaces",
     .sentence = "Force per length by which the two come too near; needed with a and b."},
    {"damping", D_LINEAR_C, ELASTIC, .fallback = "0 N s/m",
     .sentence = "Force per speed while they touch."},
    {"undrawn", .kind = FW_KIND_WORD, .words = undrawn_words, .fallback = "both are judged",
     .sentence =
         "Outside, of what the masks of this device do not draw (which is said by name, FW-D656). "
         "placed: an object that is gripped, or a stop that is put there, with its face at the "
         "place that is stated. etched: masks that you add draw it in the same layer, so that its "
         "edge moves as all edges of a flow do. Of what is drawn it says nothing. Where the scene "
         "has a temperature or a stress of the layer, what is placed keeps its own size in metres "
         "(see expansion), and what is etched grows with the layer."},
    {"expansion", D_PER_K, RANGE(-0.01, 0.01, "no solid stretches by 1 % per kelvin"),
     .fallback = "0: it keeps its size",
     .sentence = "Outside, of what is placed: its own thermal expansion, where the scene has a "
                 "temperature, which it then has too."},
};

/* ---- material and surroundings ---- */

static const fw_xml_attribute_row damping_rows[] = {
    {"loss-factor", D_PURE,
     RANGE(0, 1, "a negative one would feed energy in; above 1 nothing rings any more"),
     .fallback = "the material's",
     .sentence = "Of the flexures: energy lost per radian of an oscillation over energy stored."},
    {"frequency", D_RATE, ABOVE(0, 1e15, "without frequency nothing swings; beyond is light"),
     .fallback = "of the lowest mode",
     .sentence = "At which a hinge has the damping loss-factor x stiffness / (2 pi frequency); the "
                 "lower another frequency, the less it is damped."},
};
static const fw_xml_attribute_row temperature_rows[] = {
    {"change", D_KELVIN, .difference = true, REQUIRED,
     RANGE(-400, 3000, "there is nothing below 0 K, and no flexure stays elastic beyond"),
     .sentence = "Of device and substrate, from where the device was made, times the law: a "
                 "difference, in K."},
    {"expansion", D_PER_K, RANGE(-0.01, 0.01, "no solid stretches by 1 % per kelvin"),
     .fallback = "the material's",
     .sentence = "Of the device layer: change of length per kelvin, in the mean over the change."},
    {"substrate-expansion", D_PER_K, RANGE(-0.01, 0.01, "no solid stretches by 1 % per kelvin"),
     .fallback = "the substrate's",
     .sentence = "Likewise of what the device is anchored to: silicon, or borosilicate glass where "
                 "the flow "
                 "has carrier=\"insulating\"."},
    {"modulus-change", D_PER_K, RANGE(-0.01, 0.01, "no solid softens by 1 % per kelvin"),
     .fallback = "the material's",
     .sentence = "Of Young's modulus, relative, per kelvin; negative: it softens when warm."},
};
static const fw_xml_attribute_row stress_rows[] = {
    {"mean", D_STRESS, RANGE(-2e10, 2e10, "no film bears more than 20 GPa"), .fallback = "0 MPa",
     .sentence = "Of the layer as deposited, before it is set free; tension is positive."},
    {"gradient", D_STRESS_SLOPE, RANGE(-2e17, 2e17, "20 GPa over 0.1 um"), .fallback = "0 MPa/um",
     .sentence = "Change of that stress along the thickness, away from the wafer."},
};
static const fw_xml_attribute_row air_rows[] = {
    {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = air_kinds,
     .sentence = "slide: a film between a body and a plane below it, sheared; squeeze: a film "
                 "between two walls that come nearer; drag: the open air around a body."},
    {"on", REF(FW_SPACE_BODY), .fallback = "all bodies",
     .sentence = "Body on which it acts; squeeze needs it."},
    {"against", REF(FW_SPACE_BODY), .ground = true, .fallback = "ground",
     .sentence = "squeeze: what carries the other wall."},
    {"gap", D_LENGTH, .unit = "um", ABOVE(0, 0.3, "a film needs a thickness; " WAFER),
     .sentence = "slide, squeeze: thickness of the film as drawn."},
    {"area", D_AREA, ABOVE(0, 0.1, "without a face there is nothing to act on; " WAFER),
     .fallback = "of the drawn shape", .sentence = "slide, drag: of the body's face; needs on."},
    {"x", PLACE, .fallback = "0 mm",
     .sentence = "squeeze: middle of the wall, in the body's frame."},
    {"y", PLACE, .fallback = "0 mm",
     .sentence = "squeeze: middle of the wall, in the body's frame."},
    {"direction", TURNS, .fallback = "0 deg",
     .sentence = "squeeze: where the wall faces, from the x axis of the body."},
    {"length", D_LENGTH, .unit = "um", ABOVE(0, 0.3, "a wall needs a length; " WAFER),
     .sentence = "squeeze: of the wall, along the wafer."},
    {"depth", THICKNESS, .fallback = "thickness of the device layer",
     .sentence = "squeeze: of the wall, across the wafer."},
    {"pressure", .kind = FW_KIND_NUMBER, .dimension = {-1, 1, -2, 0, 0, 0, 0, 0}, .unit = "kPa",
     ABOVE(0, 1e7,
           "without pressure there is no air: leave <air> out; beyond 10 MPa it is no ideal "
           "gas"),
     .fallback = "101.325 kPa",
     .sentence = "Of the air; below some 1 kPa films are thinner than "
                 "the way between two molecules, which is allowed for."},
    {"temperature", D_KELVIN,
     RANGE(80, 2000, "air is liquid below 80 K and falls apart above 2000 K"),
     .fallback = "293.15 K", .sentence = "Of the air, absolute: 20 Cel is 293.15 K."},
    {"viscosity", D_VISCOSITY,
     ABOVE(0, 10, "nothing flows without it; 10 Pa s is beyond glycerol and far beyond gases"),
     .fallback = "of dry air at that temperature", .sentence = "Of another gas."},
};

#define OF_SCENE(space_) .space = (space_), .within = true
const fw_xml_element_row fw_device_table_effects[] = {
    {"tendon", "scene", "id", OF_SCENE(FW_SPACE_TENDON), .most = 2000, .timed = true,
     ROWS(tendon_rows),
     .sentence = "A cable without mass and friction, from its first <eyelet>, where it is fixed, "
                 "through the others to an actuator behind the last. pull: the actuator keeps a "
                 "tension. draw: it takes cable in, and the cable stretches; it never pushes."},
    {"eyelet", "tendon", .most = 20000, ROWS(eyelet_rows),
     .sentence = "A point that the cable is fixed to, or runs through; at least two, in order."},
    {"comb-drive", "scene", "id", OF_SCENE(FW_SPACE_COMB), .most = 2000, .timed = true,
     ROWS(comb_rows),
     .sentence = "Electrodes that attract each other: a comb, or two faces. What is not joined in "
                 "the layer is insulated only where the flow has carrier=\"insulating\"."},
    {"base-motion", "scene", .most = 2000, .timed = true, ROWS(base_rows),
     .sentence = "The ground is shaken: everything that moves is seen from it. Several add up."},
    {"friction", "scene", "on", .within = true, .most = 10000, ROWS(friction_rows),
     .sentence = "Dry friction of a joint: it sticks, and slides where the force is large enough."},
    {"contact", "scene", "id", OF_SCENE(FW_SPACE_CONTACT), .most = 10000, ROWS(contact_rows),
     .sentence =
         "Surfaces that touch and push back, without friction of their own: the conjugate "
         "surfaces of a hinge (on), or two round things (a, b). A jaw that holds a bead of "
         "radius r: a is the jaw and a-x, a-y a point of its flat face, with the face's normal "
         "a-face, or the centre of a tooth of radius R; b is what carries the bead (ground where "
         "it stands still; the other jaw with a point of its face where the bead goes with both) "
         "and b-x, b-y its centre; side is outside, distance r, with a tooth r + R, and between "
         "two faces the bead's diameter. A point without a-face is a corner: the force goes "
         "along the line between the two points. Parts of the two bodies may then meet, unless one "
         "of two points "
         "outside lies farther than the distance and 10 um from what is drawn of its body, as a "
         "bead in the open."},
    {"material-damping", "scene", .once = true, ROWS(damping_rows),
     .sentence = "The material of the flexures takes energy out of an oscillation, where the "
                 "hinges state no damping of their own."},
    {"temperature", "scene", .once = true, .timed = true, ROWS(temperature_rows),
     .sentence = "Device and substrate are warmer or colder than when the device was made: lengths "
                 "and stiffnesses change."},
    {"residual-stress", "scene", .once = true, ROWS(stress_rows),
     .sentence =
         "Stress that the layer was deposited with and gives way to when it is set free, by the "
         "biaxial modulus of its plane: of a crystal that of its elastic constants, else "
         "youngs-modulus/(1 - poisson). It acts from the start of the scene on, which rings by it; "
         "the theory page says how a scene begins at rest "
         "(docs/theory/effects/residual-stress.md)."},
    {"air", "scene", .most = 10000, ROWS(air_rows), .sentence = "Damping by the surrounding air."},
#define FW_EFFECT(name)
#define FW_EFFECT_ELEMENT(name, ...) __VA_ARGS__,
#include "device/effects.def"
#undef FW_EFFECT_ELEMENT
#undef FW_EFFECT
    {0},
};
