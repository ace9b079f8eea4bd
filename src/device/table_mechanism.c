/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: <six-bar> and <mechanism> with what they hold, and what a body is drawn of. */
#include "device/device_table.h"

/* ---- <six-bar> and <mechanism> ---- */

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
     .sentence =
         "Direction of the flexure's bulge, from the x axis; the strip of a leaf lies across it."},
};
#define DRAWN_FRAME                                                                                \
    "Without mass the origin of its frame, from which points of it are measured, is the centroid " \
    "of all that is drawn of it, necks and rings of its hinges included; `flexwright assemble` "   \
    "says where."
static const fw_xml_attribute_row link_rows[] = {
    {"id", .kind = FW_KIND_WORD, REQUIRED, .words = link_names,
     .sentence = "Which link of ABCDEF."},
    {"width", SIZE, .fallback = "not drawn",
     .sentence =
         "Of the bar between its hinges, which begins at each with a neck that is narrower, "
         "by 6 um and where the hinge's ring asks for it by more."},
    {"mass", D_MASS, SOME_MASS, .fallback = "from the drawn shape",
     .sentence = "Mass; together with inertia."},
    {"inertia", D_INERTIA, SOME_INERTIA, .fallback = "from the drawn shape",
     .sentence = "Moment of inertia about the centre of mass; together with mass."},
    {"x", POSITION, .fallback = "midpoint of its hinges",
     .sentence = "Reference frame and centre of mass, when mass is given. " DRAWN_FRAME},
    {"y", POSITION, .fallback = "midpoint of its hinges",
     .sentence = "Reference frame and centre of mass, when mass is given. " DRAWN_FRAME},
};
static const fw_xml_attribute_row platform_rows[] = {
    {"id", .kind = FW_KIND_WORD, REQUIRED, .words = platform_names, .sentence = "Always CD."},
    {"width", SIZE, .fallback = "not drawn", .sentence = "Of the rectangle; together with height."},
    {"height", SIZE, .fallback = "not drawn", .sentence = "Of the rectangle; together with width."},
    {"x", POSITION, REQUIRED,
     .sentence = "Centre of the rectangle, and of mass when mass is given. " DRAWN_FRAME},
    {"y", POSITION, REQUIRED,
     .sentence = "Centre of the rectangle, and of mass when mass is given. " DRAWN_FRAME},
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
     .sentence =
         "Of the bars that join its hinges, each of which begins at its hinge with a neck that "
         "is narrower, by 6 um and where the hinge's ring asks for it by more. Bars run "
         "straight, across whatever else is drawn of the body. With plate-width there are "
         "none: it bounds the width of the necks."},
    {"inner-corner", GAP, .fallback = "0 um: sharp, as drawn",
     .sentence =
         "Radius with which inward corners of the shapes inside it are rounded, those where "
         "two shapes meet as well."},
    {"plate-width", SIZE, .fallback = "no plate",
     .sentence = "Of a rectangle; with plate-height. Where the body has shapes inside it, it is "
                 "one more of them."},
    {"plate-height", SIZE, .fallback = "no plate", .sentence = "Of a rectangle; with plate-width."},
    {"plate-x", PLACE, .fallback = "x", .sentence = "Centre of the rectangle, as drawn."},
    {"plate-y", PLACE, .fallback = "y", .sentence = "Centre of the rectangle, as drawn."},
    {"plate-angle", TURN, .fallback = "0 deg", .sentence = "Of the rectangle against the x axis."},
};
#define POINT_OF(end)                                                                              \
    "Point " end                                                                                   \
    " in the body's frame, whose origin is the centroid of what is drawn of a link or "            \
    "platform without mass; on ground in the world."
#define ENDS                                                                                       \
    {"a", REF(FW_SPACE_BODY), .ground = true, REQUIRED,                                            \
     .sentence = "What it holds on to: a body, or ground."},                                       \
        {"a-x", PLACE, .fallback = "0 mm", .sentence = POINT_OF("a")},                             \
        {"a-y", PLACE, .fallback = "0 mm", .sentence = POINT_OF("a")},                             \
        {"b", REF(FW_SPACE_BODY), .ground = true, REQUIRED,                                        \
         .sentence = "What it holds: another body, or ground."},                                   \
        {"b-x", PLACE, .fallback = "0 mm", .sentence = POINT_OF("b")}, {                           \
        "b-y", PLACE, .fallback = "0 mm", .sentence = POINT_OF("b")                                \
    }
static const fw_xml_attribute_row revolute_rows[] = {
    {"id", ID, REQUIRED, .sentence = "Id of the joint."},
    ENDS,
    {"stiffness", D_TURNING_K, ELASTIC, .fallback = "from the flexure, else 0",
     .sentence = "Of its spring: torque per angle."},
    {"damping", D_TURNING_C, ELASTIC, .fallback = "from the flexure's material, else 0",
     .sentence = "Torque per angular velocity."},
    {"free-angle", TURNS, .fallback = "0 deg",
     .sentence =
         "phi_b - phi_a at which the joint's angle is 0 and its spring at rest. A flexure is made "
         "at rest as it is "
         "drawn: state the difference of phi as drawn, where bodies do not lie alike (FW-D622)."},
    {"hinge", REF(FW_SPACE_FLEXURE), .fallback = "an ideal pivot",
     .sentence =
         "The flexure that it is; stiffness, damping and limit then come from its geometry."},
    {"axis", TURN, .fallback = "chosen by the layout",
     .sentence =
         "Direction of the flexure's bulge, from the x axis; the strip of a leaf lies "
         "across it. Left to the layout it may "
         "be turned away from its body, which makes another mechanism of a leg that is "
         "pulled or pressed: state it where "
         "that matters. A leaf on the ground that runs straight to a side of the frame by it has "
         "its base in line with it, far stiffer than one around the hinge. Where nothing is drawn "
         "a is at "
         "its end on the right of that direction, and b at the one on the left."},
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
    {"length", LENGTH, .fallback = "0 mm",
     .sentence =
         "Length at which it is at rest. It is not of the layer, and stays what it is where "
         "a temperature or a stress makes that longer or shorter."},
    {"expansion", .kind = FW_KIND_NUMBER, .dimension = {.K = -1}, .unit = "ppm/K",
     RANGE(-0.01, 0.01, "no solid stretches by 1 % per kelvin"),
     .fallback = "0: it keeps its length",
     .sentence =
         "Of that length: its own thermal expansion, where a scene has a temperature, which "
         "it then has too."},
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
     .sentence =
         "A rigid body; it needs mass and inertia, or a shape: width, plate-width and "
         "plate-height, or elements inside it. Each of its hinges has a neck that leads "
         "straight into the body: with shapes into the nearest that takes all of its width, "
         "along a way that closes no gap between them (else FW-D702), within 0.6 mm of the "
         "hinge's free circle; towards the middle of a plate-width that no shape is nearer "
         "than; along the bars of a width."},
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
     .sentence =
         "A motor: a joint follows an expression in time, whatever force that takes; "
         "simulate --forces says how much. Before the scene it stands still: a speed that it "
         "begins with comes at once to what joints tie to it, and flexures pull the rest "
         "after it."},
    {0},
};

/* ---- what a body is drawn of ---- */

static const char *const mirrors[] = {"no", "x", "y", NULL};
static const char *const symmetries[] = {"none", "x", "y", "both", NULL};
static const char *const turns[] = {"left", "right", NULL};
static const char *const ends[] = {"square", "round", NULL};
static const char *const drawn_in[] = {"um", "nm", "mm", "cm", "m", "in", "mil", NULL};

#define REPEATS                                                                                    \
    {"hole", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",                              \
     .sentence = "yes: cut out of the body instead of added to it; it lies inside of what is "     \
                 "drawn, clear of hinges."},                                                       \
        {"copies",                                                                                 \
         D_PURE,                                                                                   \
         WHOLE,                                                                                    \
         RANGE(1, 500,                                                                             \
               "1 is the shape alone, and 500 teeth are wider than any die that is of use"),       \
         .fallback = "1",                                                                          \
         .sentence =                                                                               \
             "How many are drawn, each moved on from the one before by pitch-x, pitch-y."},        \
        {"pitch-x", POSITION, .fallback = "0 mm", .sentence = "From copy to copy, body's axes."},  \
        {"pitch-y", POSITION, .fallback = "0 mm", .sentence = "From copy to copy, body's axes."},  \
    {                                                                                              \
        "symmetry", .kind = FW_KIND_WORD, .words = symmetries, .fallback = "none",                 \
                    .sentence = "Draws the mirror image besides: x about the x axis of the "       \
                                "body's frame (y becomes -y), y about its y axis, both: all four." \
    }
#define CORNER                                                                                     \
    {                                                                                              \
        "corner", GAP, .fallback = "0 um: sharp, as drawn",                                        \
                       .sentence = "Radius with which its corners are rounded."                    \
    }

static const fw_xml_attribute_row outline_rows[] = {
    {"id", ID, .sentence = "Id for --set and the page."},
    {"x", POSITION, .fallback = "0 mm",
     .sentence = "Where its own origin lies in the body's frame: where the first line begins, or "
                 "the origin of the file."},
    {"y", POSITION, .fallback = "0 mm", .sentence = "See x."},
    {"angle", TURN, .fallback = "0 deg", .sentence = "By which it is turned about that origin."},
    {"mirror", .kind = FW_KIND_WORD, .words = mirrors, .fallback = "no",
     .sentence =
         "Drawn as its mirror image, before it is turned: x about its own x axis (y becomes "
         "-y), y about its own y axis."},
    {"start-x", POSITION, .fallback = "0 mm", .sentence = "Where its first line or arc begins."},
    {"start-y", POSITION, .fallback = "0 mm", .sentence = "Where its first line or arc begins."},
    CORNER,
    REPEATS,
    {"file", TEXT,
     .sentence = "A DXF or GDSII file, beside or below the device file, whose closed lines are "
                 "drawn instead of lines and arcs given here."},
    {"layer", TEXT, .fallback = "the only one",
     .sentence = "Layer of the file: a name, of GDSII NUMBER or NUMBER/DATATYPE."},
    {"cell", TEXT, .fallback = "the only one", .sentence = "Cell of a GDSII file."},
    {"unit", .kind = FW_KIND_WORD, .words = drawn_in, .fallback = "what the file says",
     .sentence = "What one unit of a DXF file is; where the file says so too ($INSUNITS), both "
                 "must agree."},
};
static const fw_xml_attribute_row line_rows[] = {
    {"to-x", POSITION, REQUIRED, .sentence = "Where it ends, from the outline's origin."},
    {"to-y", POSITION, REQUIRED, .sentence = "Where it ends, from the outline's origin."},
};
static const fw_xml_attribute_row arc_rows[] = {
    {"to-x", POSITION, REQUIRED, .sentence = "Where it ends, from the outline's origin."},
    {"to-y", POSITION, REQUIRED, .sentence = "Where it ends, from the outline's origin."},
    {"radius", D_LENGTH, .unit = "um", ABOVE(0, 0.3, WAFER), REQUIRED,
     .sentence = "At least half the distance of its ends."},
    {"turn", .kind = FW_KIND_WORD, .words = turns, REQUIRED,
     .sentence = "left: counter-clockwise; right: clockwise."},
    {"large", .kind = FW_KIND_WORD, .words = yes_no, .fallback = "no",
     .sentence = "yes: the way round that is more than half a turn."},
};
static const fw_xml_attribute_row plate_rows[] = {
    {"id", ID, .sentence = "Id for --set and the page."},
    {"x", POSITION, .fallback = "0 mm", .sentence = "Its centre in the body's frame."},
    {"y", POSITION, .fallback = "0 mm", .sentence = "Its centre in the body's frame."},
    {"width", SIZE, REQUIRED, .sentence = "Along x."},
    {"height", SIZE, REQUIRED, .sentence = "Along y."},
    {"angle", TURN, .fallback = "0 deg", .sentence = "By which it is turned about its centre."},
    CORNER,
    REPEATS,
};
static const fw_xml_attribute_row bar_rows[] = {
    {"id", ID, .sentence = "Id for --set and the page."},
    {"x", POSITION, .fallback = "0 mm", .sentence = "Where it begins, in the body's frame."},
    {"y", POSITION, .fallback = "0 mm", .sentence = "Where it begins, in the body's frame."},
    {"to-x", POSITION, REQUIRED,
     .sentence = "Where it ends, in the body's frame; both are written, like to-x=\"0 mm\" "
                 "to-y=\"0.5 mm\" width=\"100 um\"."},
    {"to-y", POSITION, REQUIRED,
     .sentence = "Where it ends, in the body's frame; both are written, like to-x=\"0 mm\" "
                 "to-y=\"0.5 mm\" width=\"100 um\"."},
    {"width", SIZE, REQUIRED, .sentence = "Across it."},
    {"ends", .kind = FW_KIND_WORD, .words = ends, .fallback = "square",
     .sentence = "round: half a disc about each of the two points."},
    CORNER,
    REPEATS,
};
static const fw_xml_attribute_row disc_rows[] = {
    {"id", ID, .sentence = "Id for --set and the page."},
    {"x", POSITION, .fallback = "0 mm", .sentence = "Its centre in the body's frame."},
    {"y", POSITION, .fallback = "0 mm", .sentence = "Its centre in the body's frame."},
    {"radius", SIZE, REQUIRED, .sentence = "Of the disc."},
    REPEATS,
};
static const fw_xml_attribute_row lettering_rows[] = {
    {"text", TEXT, REQUIRED,
     .sentence = "Of ASCII, letters of Latin-1 and a Greek mu; any other character is refused at "
                 "its place."},
    {"x", POSITION, .fallback = "0 mm", .sentence = "Its lower left corner in the body's frame."},
    {"y", POSITION, .fallback = "0 mm", .sentence = "Its lower left corner in the body's frame."},
    {"height", D_LENGTH, .unit = "um",
     RANGE(36e-6, 5e-3, "a stroke is a ninth of it, and none below 4 um opens in every flow"),
     .fallback = "72 um", .sentence = "Of a letter; its strokes are a ninth of that."},
    {"angle", TURN, .fallback = "0 deg", .sentence = "By which it is turned about that corner."},
};

const fw_xml_element_row fw_device_table_shapes[] = {
    {"outline", "body", "id", .most = 4000, ROWS(outline_rows),
     .sentence = "A closed line of <line> and <arc>, or those of a file. A body is the union of "
                 "its bars (width), its plate and all outlines, plates, bars and discs inside it, "
                 "less those with hole=\"yes\"."},
    {"line", "outline", .most = 100000, ROWS(line_rows),
     .sentence = "A straight line from where the one before ends. The last one ends where the "
                 "first begins."},
    {"arc", "outline", .most = 100000, ROWS(arc_rows),
     .sentence = "A circular arc from where the line before ends."},
    {"plate", "body", "id", .most = 4000, ROWS(plate_rows),
     .sentence = "A rectangle that belongs to the body; any number of them."},
    {"bar", "body", "id", .most = 4000, ROWS(bar_rows),
     .sentence = "A bar between two points that belongs to the body; with copies, a comb."},
    {"disc", "body", "id", .most = 4000, ROWS(disc_rows),
     .sentence = "A disc that belongs to the body; with hole=\"yes\" a round hole."},
    {"lettering", "body", .most = 200, ROWS(lettering_rows),
     .sentence = "Letters cut through the body. Letters that would have an island are open like "
                 "stencils, so nothing falls out; where they do not fit they are refused."},
    {0},
};
