/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: <six-bar> and <mechanism> with what they hold. */
#include "device/device_table.h"

static const char *const hinge_names[] = {"A", "B", "C", "D", "E", "F", NULL};
static const char *const link_names[] = {"AB", "BC", "DE", "EF", NULL};
static const char *const platform_names[] = {"CD", NULL};
static const char *const yes_no[] = {"yes", "no", NULL};

static const fw_xml_attribute_row hinge_rows[] = {
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
static const fw_xml_attribute_row link_rows[] = {
    {"id", .kind = FW_KIND_WORD, REQUIRED, .words = link_names,
     .sentence = "Which link of ABCDEF."},
    {"width", SIZE, .fallback = "not drawn", .sentence = "Of the bar between its hinges."},
    {"mass", D_MASS, SOME_MASS, .fallback = "from the drawn shape",
     .sentence = "Mass; together with inertia."},
    {"inertia", D_INERTIA, SOME_INERTIA, .fallback = "from the drawn shape",
     .sentence = "Moment of inertia about the centre of mass; together with mass."},
    {"x", POSITION, .fallback = "midpoint of its hinges",
     .sentence = "Reference frame and centre of mass, when mass is given."},
    {"y", POSITION, .fallback = "midpoint of its hinges",
     .sentence = "Reference frame and centre of mass, when mass is given."},
};
static const fw_xml_attribute_row platform_rows[] = {
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
static const fw_xml_attribute_row body_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id for joints, springs and scenes; not \"ground\"."},
    {"mass", ANY_MASS, .fallback = "from the drawn shape",
     .sentence = "Mass; together with inertia."},
    {"inertia", ANY_INERTIA, .fallback = "from the drawn shape",
     .sentence = "Moment of inertia about the centre of mass; together with mass."},
    {"x", PLACE, REQUIRED,
     .sentence = "Origin of the body's reference frame, in which its points are stated."},
    {"y", PLACE, REQUIRED,
     .sentence = "Origin of the body's reference frame, in which its points are stated."},
    {"phi", TURNS, .fallback = "0 deg", .sentence = "Angle of that frame's axes."},
    {"com-x", PLACE, .fallback = "0 mm with mass, else the drawn shape's centroid",
     .sentence = "Centre of mass in the body's frame; together with mass."},
    {"com-y", PLACE, .fallback = "0 mm with mass, else the drawn shape's centroid",
     .sentence = "Centre of mass in the body's frame; together with mass."},
    {"width", SIZE, .fallback = "not drawn",
     .sentence = "Of the bars that join its hinges. With plate-width there are no bars: it bounds "
                 "the width of the necks that lead into the plate."},
    {"inner-corner", GAP, .fallback = "0 um: sharp, as drawn",
     .sentence =
         "Radius with which inward corners of the shapes inside it are rounded, those where "
         "two shapes meet as well."},
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
         .sentence = "Point a in the body's frame; on ground in the world."},                      \
        {"a-y", PLACE, .fallback = "0 mm",                                                         \
         .sentence = "Point a in the body's frame; on ground in the world."},                      \
        {"b", REF(FW_SPACE_BODY), .ground = true, REQUIRED,                                        \
         .sentence = "What it holds: another body, or ground."},                                   \
        {"b-x", PLACE, .fallback = "0 mm",                                                         \
         .sentence = "Point b in the body's frame; on ground in the world."},                      \
    {                                                                                              \
        "b-y", PLACE, .fallback = "0 mm",                                                          \
                      .sentence = "Point b in the body's frame; on ground in the world."           \
    }
static const fw_xml_attribute_row revolute_rows[] = {
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
static const fw_xml_attribute_row prismatic_rows[] = {
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
static const fw_xml_attribute_row distance_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"length", D_LENGTH, .unit = "mm",
     ABOVE(0, 1e7, "a rod without length has no direction and would be a revolute; " FAR),
     .fallback = "as drawn",
     .sentence = "Between the two points; a driver of this joint gives the length instead."},
};
static const fw_xml_attribute_row weld_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"angle", TURNS, .fallback = "as drawn", .sentence = "phi_b - phi_a, which the joint keeps."},
};
static const fw_xml_attribute_row driver_rows[] = {
    {"id", ID, .fallback = "the joint's", .sentence = "Id of the driver."},
    {"joint", REF(FW_SPACE_JOINT), REQUIRED,
     .sentence = "What it moves: the angle of a revolute or of a hinge of <six-bar>, the travel of "
                 "a prismatic, or the length of a distance."},
    {"value", .kind = FW_KIND_TIMED, .unit = "rad or m", REQUIRED,
     .sentence =
         "That angle, travel or length at the time t, for example 30 deg * sin(2*pi*t/(1 s))."},
};
static const fw_xml_attribute_row spring_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the spring."},
    ENDS,
    {"stiffness", D_LINEAR_K, ELASTIC, REQUIRED,
     .sentence = "Force per length by which it is longer than at rest."},
    {"damping", D_LINEAR_C, ELASTIC, .fallback = "0 N s/m", .sentence = "Force per speed."},
    {"length", LENGTH, .fallback = "0 mm", .sentence = "Length at which it is at rest."},
    {"cable", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "yes: it only pulls, and hangs slack while shorter than its length."},
};

const fw_xml_element_row fw_device_table_mechanism[] = {
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
     .sentence = "A rigid body; it needs mass and inertia, or a shape: width, plate-width and "
                 "plate-height, or elements inside it."},
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
    {0},
};
