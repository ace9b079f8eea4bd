/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: what a body is drawn of. */
#include "device/device_table.h"

static const char *const yes_no[] = {"yes", "no", NULL};
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
         RANGE(1, 500, "a comb of 500 teeth is wider than any die that is of use"),                \
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
    {"to-x", POSITION, REQUIRED, .sentence = "Where it ends, in the body's frame."},
    {"to-y", POSITION, REQUIRED, .sentence = "Where it ends, in the body's frame."},
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
     .sentence = "Of letters, digits and . , - + = / _ ( ) : % #; any other is drawn as a star."},
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
