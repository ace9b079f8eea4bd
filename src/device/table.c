/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/table.h"
#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846
/* dimensions */
#define D_LENGTH    .kind = FW_KIND_NUMBER, .dimension = {.m = 1}
#define D_ANGLE     .kind = FW_KIND_NUMBER, .dimension = {.rad = 1}
#define D_MASS      .kind = FW_KIND_NUMBER, .dimension = {.kg = 1}, .unit = "mg"
#define D_INERTIA   .kind = FW_KIND_NUMBER, .dimension = {.m = 2, .kg = 1}, .unit = "mg mm^2"
#define D_TIME      .kind = FW_KIND_NUMBER, .dimension = {.s = 1}, .unit = "ms"
#define D_RATE      .kind = FW_KIND_NUMBER, .dimension = {.s = -1}, .unit = "Hz"
#define D_PURE      .kind = FW_KIND_NUMBER, .unit = "1"
#define D_PRESSURE  .kind = FW_KIND_NUMBER, .dimension = {-1, 1, -2, 0, 0, 0, 0}, .unit = "GPa"
#define D_DENSITY   .kind = FW_KIND_NUMBER, .dimension = {.m = -3, .kg = 1}, .unit = "kg/m3"
#define D_FORCE     .kind = FW_KIND_NUMBER, .dimension = {1, 1, -2, 0, 0, 0, 0}, .unit = "uN"
#define D_TORQUE    .kind = FW_KIND_NUMBER, .dimension = {2, 1, -2, 0, 0, 0, 0}, .unit = "uN mm"
#define D_TURNING_K .kind = FW_KIND_NUMBER, .dimension = {2, 1, -2, 0, 0, 0, -1}, .unit = "N m/rad"
#define D_TURNING_C                                                                                \
    .kind = FW_KIND_NUMBER, .dimension = {2, 1, -1, 0, 0, 0, -1}, .unit = "N m s/rad"
#define D_LINEAR_K .kind = FW_KIND_NUMBER, .dimension = {.kg = 1, .s = -2}, .unit = "N/m"
#define D_LINEAR_C .kind = FW_KIND_NUMBER, .dimension = {.kg = 1, .s = -1}, .unit = "N s/m"
#define D_SPEED    .kind = FW_KIND_NUMBER, .dimension = {.m = 1, .s = -1}, .unit = "mm/s"
#define D_SPIN     .kind = FW_KIND_NUMBER, .dimension = {.s = -1, .rad = 1}, .unit = "rad/s"
#define D_GRAVITY  .kind = FW_KIND_NUMBER, .dimension = {.m = 1, .s = -2}, .unit = "m/s^2"

/* ranges with their reason */
#define RANGE(low, high, why) .ranged = true, .min = (low), .max = (high), .reason = (why)
#define ABOVE(low, high, why) RANGE(low, high, why), .open = true
#define WAFER                 "wafers are at most 300 mm wide"
#define POSITION              D_LENGTH, .unit = "mm", RANGE(-0.3, 0.3, WAFER)
#define SIZE                                                                                       \
    D_LENGTH, .unit = "um",                                                                        \
              RANGE(1e-6, 0.3, "contact lithography prints nothing below 1 um, and " WAFER)
#define THIN                                                                                       \
    D_LENGTH,                                                                                      \
        .unit = "um",                                                                              \
        RANGE(1e-7, 0.3, "the data of materials do not hold for strips below 0.1 um, and " WAFER)
#define GAP  D_LENGTH, .unit = "um", RANGE(0, 0.3, WAFER)
#define TURN D_ANGLE, .unit = "deg", RANGE(-2 * PI, 2 * PI, "one full turn")
/* <mechanism> and <scene> serve any size; what is drawn keeps to the wafer (build_mechanism.c) */
#define FAR    "beyond 1e7 m a number resolves no better than a nanometre"
#define PLACE  D_LENGTH, .unit = "mm", RANGE(-1e7, 1e7, FAR)
#define LENGTH D_LENGTH, .unit = "mm", RANGE(0, 1e7, FAR)
#define TURNS                                                                                      \
    D_ANGLE, .unit = "deg",                                                                        \
             RANGE(-2e4 * PI, 2e4 * PI, "10000 turns, behind which an angle loses four digits")
#define ANY_MASS                                                                                   \
    D_MASS, RANGE(1e-30, 1e15,                                                                     \
                  "without mass the equations of motion are singular; an electron weighs 1e-30 "   \
                  "kg, a mountain 1e15 kg")
#define ANY_INERTIA                                                                                \
    D_INERTIA, RANGE(1e-60, 1e30,                                                                  \
                     "without inertia the equations of motion are singular; beyond lie the "       \
                     "smallest and greatest mass at the smallest and greatest size")
#define ELASTIC                                                                                    \
    RANGE(0, 1e20, "a negative one would feed energy in; 1e20 in SI units is beyond any structure")
#define WITHIN_TIME                                                                                \
    RANGE(0, 1e9, "a scene begins at 0, and none takes longer than 1e9 s, thirty years")
#define NOT_NEGATIVE                                                                               \
    RANGE(0, 1e6,                                                                                  \
          "a negative one would feed energy in, and 1e6 in SI units is beyond anything small")
#define SOME_MASS                                                                                  \
    ABOVE(0, 1, "without mass the equations of motion are singular; a device weighs far below 1 kg")
#define SOME_INERTIA                                                                               \
    ABOVE(0, 1, "without inertia the equations of motion are singular; 1 kg m^2 is not small")
#define THICKNESS                                                                                  \
    D_LENGTH, .unit = "um",                                                                        \
              RANGE(1e-7, 2e-3,                                                                    \
                    "the data of materials do not hold for films below 0.1 um; wafers and plated " \
                    "films are at most "                                                           \
                    "2 mm thick")
#define REQUIRED .required = true
#define ID       .kind = FW_KIND_ID
#define TEXT     .kind = FW_KIND_TEXT
#define REF(to)  .kind = FW_KIND_REF, .space = (to)
#define ROWS(a)  .attribute = (a), .nattribute = sizeof(a) / sizeof((a)[0])

static const char *const flexure_kinds[] = {"csfh", "leaf", NULL};
static const char *const hinge_names[] = {"A", "B", "C", "D", "E", "F", NULL};
static const char *const link_names[] = {"AB", "BC", "DE", "EF", NULL};
static const char *const platform_names[] = {"CD", NULL};
static const char *const yes_no[] = {"yes", "no", NULL};
static const char *const laws[] = {"step", "ramp", "sine", "table", "expression", NULL};

static const fw_attribute_row device_rows[] = {
    {"name", ID, REQUIRED, .sentence = "Name of the device; it names outputs and the GDSII cell."},
};
static const fw_attribute_row parameter_rows[] = {
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
static const fw_attribute_row material_rows[] = {
    {"ref", ID, REQUIRED, .sentence = "Id of a material in processes/base.xml."},
    {"youngs-modulus", D_PRESSURE,
     RANGE(1e6, 2e12, "below 1 MPa are gels and foams; no material is stiffer than 2 TPa"),
     .fallback = "the material's", .sentence = "Young's modulus for bending in the wafer plane."},
    {"poisson", D_PURE, ABOVE(-1, 0.5, "elastic stability of an isotropic body"),
     .fallback = "the material's", .sentence = "Poisson's ratio."},
    {"density", D_DENSITY,
     RANGE(1, 3e4, "no solid to build of is lighter than 1 kg/m3 or denser than 30000 kg/m3"),
     .fallback = "the material's", .sentence = "Density."},
    {"strength", D_PRESSURE,
     RANGE(1e3, 2e11,
           "what is weaker than 1 kPa cannot be handled; no material is stronger than 200 GPa"),
     .fallback = "the material's", .sentence = "Stress that the safety factor divides."},
    {"thickness", THICKNESS, .fallback = "the flow's",
     .sentence = "Thickness of the device layer."},
};
static const fw_attribute_row limits_rows[] = {
    {"safety-factor", D_PURE, RANGE(1, 100, "below 1 the limit itself would be exceeded"),
     .fallback = "1.5", .sentence = "Strength divided by the stress that is allowed."},
};
static const fw_attribute_row flow_rows[] = {
    {"ref", ID, REQUIRED, .sentence = "Name of a process pack, e.g. al-masked-rie."},
    {"material", ID, .fallback = "the device's", .sentence = "Id of the material in this flow."},
    {"thickness", THICKNESS, .fallback = "the device's",
     .sentence = "Thickness of the device layer in this flow."},
};
static const fw_attribute_row flexure_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id for hinges to refer to."},
    {"kind", .kind = FW_KIND_WORD, REQUIRED, .words = flexure_kinds,
     .sentence = "csfh: a thin arc between conjugate surfaces; leaf: a thin straight strip."},
    {"length", SIZE,
     .sentence = "Along the centre line, from face to face. csfh: exactly two of "
                 "length, radius and angle."},
    {"radius", SIZE, .sentence = "Of the arc's centre line (csfh only)."},
    {"angle", D_ANGLE, .unit = "deg",
     ABOVE(0, 330 * PI / 180, "beyond 330 deg the ends of the arc meet"),
     .sentence = "Subtended by the arc (csfh only)."},
    {"width", THIN, REQUIRED, .sentence = "Of the thin part, in the wafer plane."},
    {"gap", GAP, .fallback = "0 um", .sentence = "Of the conjugate surfaces; 0: none."},
    {"fillet", GAP, .fallback = "chosen by the layout", .sentence = "Radius at the roots."},
};
static const fw_attribute_row hinge_rows[] = {
    {"at", .kind = FW_KIND_WORD, REQUIRED, .words = hinge_names,
     .sentence = "Which hinge of ABCDEF."},
    {"x", POSITION, REQUIRED, .sentence = "Hinge point as drawn."},
    {"y", POSITION, REQUIRED, .sentence = "Hinge point as drawn."},
    {"flexure", REF(FW_SPACE_FLEXURE), .fallback = "an ideal pivot", .sentence = "Its flexure."},
    {"stiffness", D_TURNING_K, NOT_NEGATIVE, .fallback = "from the flexure",
     .sentence = "Torque per angle."},
    {"damping", D_TURNING_C, NOT_NEGATIVE, .fallback = "from the flexure's material",
     .sentence = "Torque per angular velocity."},
    {"free-angle", TURN, .fallback = "0 deg", .sentence = "Angle at which the spring is at rest."},
    {"axis", TURN, .fallback = "chosen by the layout",
     .sentence = "Direction of the flexure's bulge, from the x axis."},
};
static const fw_attribute_row link_rows[] = {
    {"id", .kind = FW_KIND_WORD, REQUIRED, .words = link_names,
     .sentence = "Which link of ABCDEF."},
    {"width", SIZE, .fallback = "not drawn", .sentence = "Of the bar between its hinges."},
    {"mass", D_MASS, SOME_MASS, .fallback = "from the drawn shape",
     .sentence = "Mass; together with inertia."},
    {"inertia", D_INERTIA, SOME_INERTIA, .fallback = "from the drawn shape",
     .sentence = "Moment of inertia about the centre of mass; together with mass."},
    {"x", POSITION, .fallback = "midpoint of its hinges",
     .sentence = "Centre of mass, when mass is given."},
    {"y", POSITION, .fallback = "midpoint of its hinges",
     .sentence = "Centre of mass, when mass is given."},
};
static const fw_attribute_row platform_rows[] = {
    {"id", .kind = FW_KIND_WORD, REQUIRED, .words = platform_names, .sentence = "Always CD."},
    {"width", SIZE, .fallback = "not drawn", .sentence = "Of the rectangle; together with height."},
    {"height", SIZE, .fallback = "not drawn", .sentence = "Of the rectangle; together with width."},
    {"x", POSITION, REQUIRED,
     .sentence = "Centre of the rectangle, and of mass when mass is given."},
    {"y", POSITION, REQUIRED,
     .sentence = "Centre of the rectangle, and of mass when mass is given."},
    {"angle", TURN, .fallback = "0 deg",
     .sentence = "Of the rectangle's width against the x axis."},
    {"mass", D_MASS, SOME_MASS, .fallback = "from the drawn shape",
     .sentence = "Mass; together with inertia."},
    {"inertia", D_INERTIA, SOME_INERTIA, .fallback = "from the drawn shape",
     .sentence = "Moment of inertia about the centre of mass; together with mass."},
};
static const fw_attribute_row body_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id for joints, springs and scenes; not \"ground\"."},
    {"mass", ANY_MASS, .fallback = "from the drawn shape",
     .sentence = "Mass; together with inertia."},
    {"inertia", ANY_INERTIA, .fallback = "from the drawn shape",
     .sentence = "Moment of inertia about the centre of mass; together with mass."},
    {"x", PLACE, REQUIRED, .sentence = "Centre of mass; local coordinates start here."},
    {"y", PLACE, REQUIRED, .sentence = "Centre of mass; local coordinates start here."},
    {"phi", TURNS, .fallback = "0 deg", .sentence = "Angle of the body's own axes."},
    {"width", SIZE, .fallback = "not drawn", .sentence = "Of the bars that join its hinges."},
    {"plate-width", SIZE, .fallback = "no plate", .sentence = "Of a rectangle; with plate-height."},
    {"plate-height", SIZE, .fallback = "no plate", .sentence = "Of a rectangle; with plate-width."},
    {"plate-x", PLACE, .fallback = "x", .sentence = "Centre of the rectangle, as drawn."},
    {"plate-y", PLACE, .fallback = "y", .sentence = "Centre of the rectangle, as drawn."},
    {"plate-angle", TURN, .fallback = "0 deg", .sentence = "Of the rectangle against the x axis."},
};
#define ENDS                                                                                       \
    {"a", REF(FW_SPACE_BODY), .ground = true, REQUIRED,                                            \
     .sentence = "What it holds on to: a body, or ground."},                                       \
        {"a-x", PLACE, .fallback = "0 mm",                                                         \
         .sentence =                                                                               \
             "Point a: from the centre of mass, in the body's axes; on ground in the world."},     \
        {"a-y", PLACE, .fallback = "0 mm",                                                         \
         .sentence =                                                                               \
             "Point a: from the centre of mass, in the body's axes; on ground in the world."},     \
        {"b", REF(FW_SPACE_BODY), .ground = true, REQUIRED,                                        \
         .sentence = "What it holds: another body, or ground."},                                   \
        {"b-x", PLACE, .fallback = "0 mm",                                                         \
         .sentence =                                                                               \
             "Point b: from the centre of mass, in the body's axes; on ground in the world."},     \
    {                                                                                              \
        "b-y", PLACE,                                                                              \
            .fallback = "0 mm",                                                                    \
            .sentence =                                                                            \
                "Point b: from the centre of mass, in the body's axes; on ground in the world."    \
    }
static const fw_attribute_row revolute_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"stiffness", D_TURNING_K, ELASTIC, .fallback = "from the flexure, else 0",
     .sentence = "Of its spring: torque per angle."},
    {"damping", D_TURNING_C, ELASTIC, .fallback = "from the flexure's material, else 0",
     .sentence = "Torque per angular velocity."},
    {"free-angle", TURNS, .fallback = "0 deg",
     .sentence = "phi_b - phi_a at which the joint's angle is 0 and its spring at rest."},
    {"hinge", REF(FW_SPACE_FLEXURE), .fallback = "an ideal pivot",
     .sentence =
         "The flexure that it is; stiffness, damping and limit then come from its geometry."},
    {"axis", TURN, .fallback = "chosen by the layout",
     .sentence = "Direction of the flexure's bulge, from the x axis."},
    {"stop-min", TURNS, .fallback = "no stop",
     .sentence = "Below this angle of the joint a stop pushes back; needs stop-stiffness."},
    {"stop-max", TURNS, .fallback = "no stop",
     .sentence = "Above this angle of the joint a stop pushes back; needs stop-stiffness."},
    {"stop-stiffness", D_TURNING_K, ELASTIC, .fallback = "no stop",
     .sentence = "Of the stops: torque per angle beyond stop-min or stop-max."},
    {"stop-damping", D_TURNING_C, ELASTIC, .fallback = "0 N m s/rad",
     .sentence = "Of the stops: torque per angular velocity, only beyond stop-min or stop-max."},
};
static const fw_attribute_row prismatic_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"axis", TURNS, REQUIRED,
     .sentence =
         "Direction of the line through point a on which point b slides, from the x axis of a."},
    {"angle", TURNS, .fallback = "as drawn", .sentence = "phi_b - phi_a, which the joint keeps."},
    {"stiffness", D_LINEAR_K, ELASTIC, .fallback = "0 N/m",
     .sentence = "Of a spring along the line: force per travel."},
    {"damping", D_LINEAR_C, ELASTIC, .fallback = "0 N s/m", .sentence = "Force per speed."},
    {"free-length", PLACE, .fallback = "0 mm",
     .sentence = "Distance of point b from point a along the line at which travel is 0 and the "
                 "spring at rest."},
};
static const fw_attribute_row distance_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"length", D_LENGTH, .unit = "mm",
     ABOVE(0, 1e7, "a rod without length has no direction and would be a revolute; " FAR),
     .fallback = "as drawn",
     .sentence = "Between the two points; a driver of this joint gives the length instead."},
};
static const fw_attribute_row weld_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"angle", TURNS, .fallback = "as drawn", .sentence = "phi_b - phi_a, which the joint keeps."},
};
static const fw_attribute_row driver_rows[] = {
    {"id", ID, .fallback = "the joint's", .sentence = "Id of the driver."},
    {"joint", REF(FW_SPACE_JOINT), REQUIRED,
     .sentence = "What it moves: the angle of a revolute or of a hinge of <six-bar>, the travel of "
                 "a prismatic, or the length of a distance."},
    {"value", .kind = FW_KIND_TIMED, .unit = "rad or m", REQUIRED,
     .sentence =
         "That angle, travel or length at the time t, for example 30 deg * sin(2*pi*t/(1 s))."},
};
static const fw_attribute_row spring_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the spring."},
    ENDS,
    {"stiffness", D_LINEAR_K, ELASTIC, REQUIRED,
     .sentence = "Force per length by which it is longer than at rest."},
    {"damping", D_LINEAR_C, ELASTIC, .fallback = "0 N s/m", .sentence = "Force per speed."},
    {"length", LENGTH, .fallback = "0 mm", .sentence = "Length at which it is at rest."},
    {"cable", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "yes: it only pulls, and hangs slack while shorter than its length."},
};
static const fw_attribute_row scene_rows[] = {
    {"name", ID, REQUIRED, .sentence = "Name of the scene."},
    {"duration", D_TIME, REQUIRED,
     RANGE(1e-12, 1e9,
           "nothing that this model holds for moves within 1 ps, and no motion takes longer than "
           "1e9 s, thirty years"),
     .sentence = "How long the motion is followed."},
    {"flow", REF(FW_SPACE_FLOW), .fallback = "all flows", .sentence = "Only in this flow."},
};
/* how a load goes with time; which attribute belongs to which law: time_law.c */
#define LAW                                                                                        \
    {"law", .kind = FW_KIND_WORD, .words = laws, .fallback = "step",                               \
     .sentence = "How the load goes with time: see Time, above."},                                 \
        {"start", D_TIME, WITHIN_TIME, .fallback = "0 ms",                                         \
         .sentence = "step, ramp, sine: no load before."},                                         \
        {"end", D_TIME, WITHIN_TIME, .fallback = "never",                                          \
         .sentence = "step, sine: no load from then on."},                                         \
        {"rise", D_TIME,                                                                           \
         ABOVE(0, 1e9, "a ramp that takes no time is a step; no scene takes longer than 1e9 s"),   \
         .sentence = "ramp: time that it takes from no load to the full one."},                    \
        {"frequency", D_RATE, ABOVE(0, 1e15, "without frequency nothing swings; beyond is light"), \
         .sentence = "sine: periods per second."},                                                 \
        {"phase", TURNS, .fallback = "0 deg",                                                      \
         .sentence =                                                                               \
             "sine: angle at the start; 0 deg begins without load, 90 deg with all of it."},       \
        {"table", .kind = FW_KIND_TABLE, .unit = "ms",                                             \
         .sentence = "table: the factor at rising times; linear between them, constant before "    \
                     "and behind."},                                                               \
    {                                                                                              \
        "factor", .kind = FW_KIND_TIMED, .unit = "1",                                              \
                  .sentence = "expression: the factor at the time t."                              \
    }
static const fw_attribute_row force_rows[] = {
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that it pulls."},
    {"x", PLACE, .fallback = "0 mm",
     .sentence = "Point in the body's frame, from its centre of mass."},
    {"y", PLACE, .fallback = "0 mm",
     .sentence = "Point in the body's frame, from its centre of mass."},
    {"fx", D_FORCE, .fallback = "0 uN", .sentence = "Along the world's x axis."},
    {"fy", D_FORCE, .fallback = "0 uN", .sentence = "Along the world's y axis."},
    LAW,
};
static const fw_attribute_row torque_rows[] = {
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that it turns."},
    {"value", D_TORQUE, REQUIRED, .sentence = "Positive counter-clockwise, from x to y."},
    LAW,
};
static const fw_attribute_row gravity_rows[] = {
    {"gx", D_GRAVITY, .fallback = "0 m/s^2", .sentence = "Along the world's x axis."},
    {"gy", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Along the world's y axis; -9.81 m/s^2 where y points up."},
};
static const fw_attribute_row initial_rows[] = {
    {"body", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that moves at the start."},
    {"vx", D_SPEED, .fallback = "0 mm/s", .sentence = "Velocity of the centre of mass."},
    {"vy", D_SPEED, .fallback = "0 mm/s", .sentence = "Velocity of the centre of mass."},
    {"omega", D_SPIN, .fallback = "0 rad/s", .sentence = "Angular velocity."},
};
static const fw_attribute_row workspace_rows[] = {
    {"flow", REF(FW_SPACE_FLOW), .fallback = "all flows", .sentence = "Only in this flow."},
    {"x-min", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"x-max", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"y-min", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"y-max", POSITION, REQUIRED, .sentence = "Platform displacement from the drawn pose."},
    {"phi-min", TURN, REQUIRED, .sentence = "Platform rotation from the drawn pose."},
    {"phi-max", TURN, REQUIRED, .sentence = "Platform rotation from the drawn pose."},
};
static const fw_attribute_row die_rows[] = {
    {"width", SIZE, .fallback = "from the drawn mechanism", .sentence = "Of the chip."},
    {"height", SIZE, .fallback = "from the drawn mechanism", .sentence = "Of the chip."},
    {"frame", GAP, .fallback = "chosen by the layout", .sentence = "Width of the frame."},
    {"lane", GAP, .fallback = "chosen by the layout", .sentence = "Width of the dicing lane."},
    {"clearance", GAP, .fallback = "chosen by the layout",
     .sentence = "Between moving parts and the frame."},
    {"title", TEXT, .fallback = "the device's name", .sentence = "Written on the die."},
    {"tethers", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "yes",
     .sentence = "Thin bridges that hold the mechanism until they are broken."},
};

#define LATER(name_, parent_, sentence_)                                                           \
    { name_, parent_, .later = true, .sentence = sentence_ }
static const fw_element_row table[] = {
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
    {"six-bar", "device", .once = true,
     .sentence = "The manipulator ABCDEF: ground at A and F, links AB, BC, DE, EF, platform CD."},
    {"hinge", "six-bar", "at", FW_SPACE_JOINT, ROWS(hinge_rows),
     .sentence = "One of the six hinges."},
    {"link", "six-bar", "id", FW_SPACE_BODY, ROWS(link_rows), .sentence = "One of the four links."},
    {"platform", "six-bar", "id", FW_SPACE_BODY, ROWS(platform_rows),
     .sentence = "The platform CD that carries the tool."},
    {"mechanism", "device", .once = true,
     .sentence = "Any planar mechanism; with <six-bar> it adds to that and may use its ids."},
    {"body", "mechanism", "id", FW_SPACE_BODY, .most = 50000, ROWS(body_rows),
     .sentence = "A rigid body; it needs mass and inertia, or a shape."},
    {"revolute", "mechanism", "id", FW_SPACE_JOINT, .most = 100000, ROWS(revolute_rows),
     .sentence = "A pin on which b turns against a. Its angle is phi_b - phi_a - free-angle; a "
                 "spring, a damper and stops may act on it."},
    {"spring", "mechanism", "id", FW_SPACE_SPRING, .most = 100000, ROWS(spring_rows),
     .sentence =
         "A spring with a damper between point a and point b; cable=\"yes\" makes it a cable."},
    {"prismatic", "mechanism", "id", FW_SPACE_JOINT, .most = 100000, ROWS(prismatic_rows),
     .sentence = "A slide: point b stays on a line fixed to a, and b does not turn against a. Its "
                 "travel is the distance from point a to point b along the line, less free-length; "
                 "a spring and a damper may act on it."},
    {"distance", "mechanism", "id", FW_SPACE_JOINT, .most = 100000, ROWS(distance_rows),
     .sentence = "A massless rod with a pin at each end: point a and point b keep their distance."},
    {"weld", "mechanism", "id", FW_SPACE_JOINT, .most = 100000, ROWS(weld_rows),
     .sentence = "Two bodies made one: point b stays on point a, and b does not turn against a."},
    {"driver", "mechanism", "id", FW_SPACE_DRIVER, .most = 100000, ROWS(driver_rows),
     .sentence = "A motor: a joint follows an expression in time, whatever force that takes; "
                 "simulate --forces says how much."},
    {"scene", "device", "name", FW_SPACE_SCENE, .most = 200, ROWS(scene_rows),
     .sentence = "What acts on the mechanism, and for how long; the verdict holds for all scenes."},
    {"force", "scene", ROWS(force_rows),
     .sentence = "A force on a point of a body; the point moves with it, the direction stays."},
    {"torque", "scene", ROWS(torque_rows), .sentence = "A torque on a body."},
    {"gravity", "scene", .once = true, ROWS(gravity_rows), .sentence = "Weight of all bodies."},
    {"initial", "scene", ROWS(initial_rows),
     .sentence = "Velocity of a body at the start. What is not given, of this body or of others, "
                 "follows through the joints; what they do not allow is corrected, as little as "
                 "possible."},
    LATER("tendon", "scene", "A cable that pulls."),
    LATER("comb-drive", "scene", "An electrostatic comb."),
    LATER("base-motion", "scene", "A moving base."),
    LATER("friction", "scene", "Friction in a joint."),
    LATER("contact", "scene", "Contact of the conjugate surfaces."),
    LATER("temperature", "scene", "Thermal expansion."),
    LATER("air", "scene", "Damping by the surrounding air."),
    {"workspace", "device", .most = 200, ROWS(workspace_rows),
     .sentence = "Platform poses that must be reachable, relative to the drawn pose."},
    {"die", "device", .once = true, ROWS(die_rows), .sentence = "The chip around the mechanism."},
};

const fw_element_row *fw_device_table(int *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

const fw_element_row *fw_element_row_find(const char *name) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (strcmp(table[i].name, name) == 0) return &table[i];
    return NULL;
}

const char *fw_space_text(fw_space space) {
    static const char *const text[FW_SPACE_COUNT] = {
        "name", "parameter", "flow", "flexure", "body", "joint", "spring", "driver", "scene"};
    return text[space];
}

bool fw_kind_is_expression(fw_kind kind) {
    return kind == FW_KIND_NUMBER || kind == FW_KIND_ANY || kind == FW_KIND_TIMED ||
           kind == FW_KIND_TABLE;
}
