/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of device files. A new element or attribute is one row in table_*.c. Private to
   device/. */
#ifndef FW_DEVICE_DEVICE_TABLE_H
#define FW_DEVICE_DEVICE_TABLE_H
#include "base/constants.h"
#include "xml/xml.h"
#include "xml/xml_reader.h"

typedef enum fw_device_space { /* ids are unique within one of these */
                               FW_SPACE_NONE,
                               FW_SPACE_PARAMETER,
                               FW_SPACE_FLOW,
                               FW_SPACE_FLEXURE,
                               FW_SPACE_BODY,
                               FW_SPACE_JOINT,
                               FW_SPACE_SPRING,
                               FW_SPACE_DRIVER,
                               FW_SPACE_SCENE,
                               FW_SPACE_TENDON,
                               FW_SPACE_COMB,
                               FW_SPACE_CONTACT,
                               FW_SPACE_PROBE,
                               FW_SPACE_STUDY,
                               FW_SPACE_COUNT
} fw_device_space;

/* each ends with a row without a name */
extern const fw_xml_element_row fw_device_table_mechanism[], fw_device_table_shapes[],
    fw_device_table_scene[], fw_device_table_effects[], fw_device_table_study[];
extern const fw_xml_table fw_device_table, fw_device_study_table;

/* the words of a study's attributes, each in the order of its enum, NULL behind the last */
typedef struct fw_device_study_words {
    const char *const *kind,
        *const *points, *const *judge, *const *spread, *const *take, *const *goal, *const *level;
} fw_device_study_words;
extern const fw_device_study_words fw_device_study_words_of;

/* numbers of the mistakes of device and study files */
#define FW_DEVICE_TABLE_NUMBERS                                                                    \
    {                                                                                              \
        .root = 15, .element = 40, .misplaced = 41, .attribute = 42, .missing = 43, .name = 44,    \
        .twice = 45, .range = 47, .word = 48, .form = 48, .text = 49, .once = 51, .most = 66,      \
        .whole = 96                                                                                \
    }

/* What the rows of the table are written with: dimensions, ranges with their reasons, and the
   attributes that several elements share. Included by table_*.c only. */

/* dimensions */
#define D_LENGTH   .kind = FW_KIND_NUMBER, .dimension = {.m = 1}
#define D_ANGLE    .kind = FW_KIND_NUMBER, .dimension = {.rad = 1}
#define D_MASS     .kind = FW_KIND_NUMBER, .dimension = {.kg = 1}, .unit = "mg"
#define D_INERTIA  .kind = FW_KIND_NUMBER, .dimension = {.m = 2, .kg = 1}, .unit = "mg mm^2"
#define D_TIME     .kind = FW_KIND_NUMBER, .dimension = {.s = 1}, .unit = "ms"
#define D_RATE     .kind = FW_KIND_NUMBER, .dimension = {.s = -1}, .unit = "Hz"
#define D_PURE     .kind = FW_KIND_NUMBER, .unit = "1"
#define D_PRESSURE .kind = FW_KIND_NUMBER, .dimension = {-1, 1, -2, 0, 0, 0, 0, 0}, .unit = "GPa"
#define SOME_STRESS                                                                                \
    D_PRESSURE, ABOVE(0, 2e11, "a limit lies above 0; no material is stronger than 200 GPa"),      \
        .fallback = "the material's"
#define D_DENSITY .kind = FW_KIND_NUMBER, .dimension = {.m = -3, .kg = 1}, .unit = "kg/m3"
#define D_FORCE   .kind = FW_KIND_NUMBER, .dimension = {1, 1, -2, 0, 0, 0, 0, 0}, .unit = "uN"
#define D_TORQUE  .kind = FW_KIND_NUMBER, .dimension = {2, 1, -2, 0, 0, 0, 0, 0}, .unit = "uN mm"
#define D_TURNING_K                                                                                \
    .kind = FW_KIND_NUMBER, .dimension = {2, 1, -2, 0, 0, 0, -1, 0}, .unit = "N m/rad"
#define D_TURNING_C                                                                                \
    .kind = FW_KIND_NUMBER, .dimension = {2, 1, -1, 0, 0, 0, -1, 0}, .unit = "N m s/rad"
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
#define TURN D_ANGLE, .unit = "deg", RANGE(-2 * FW_PI, 2 * FW_PI, "one full turn")
/* <mechanism> and <scene> serve any size; what is drawn keeps to the wafer (build_mechanism.c) */
#define FAR    "beyond 1e7 m a number resolves no better than a nanometre"
#define PLACE  D_LENGTH, .unit = "mm", RANGE(-1e7, 1e7, FAR)
#define LENGTH D_LENGTH, .unit = "mm", RANGE(0, 1e7, FAR)
#define TURNS                                                                                      \
    D_ANGLE,                                                                                       \
        .unit = "deg",                                                                             \
        RANGE(-2e4 * FW_PI, 2e4 * FW_PI, "10000 turns, behind which an angle loses four digits")
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
#define WHOLE    .whole = true
#define ID       .kind = FW_KIND_ID
#define TEXT     .kind = FW_KIND_TEXT
#define REF(to)  .kind = FW_KIND_REF, .space = (to)
#define ROWS(a)  .attribute = (a), .nattribute = sizeof(a) / sizeof((a)[0])
/* the same, written in place: effects.def */
#define ATTRIBUTES(...) ROWS(((const fw_xml_attribute_row[]){__VA_ARGS__}))

/* ---- which element of a description a path names ----
   Steps ELEMENT, ELEMENT[ID] or ELEMENT[N] with '/' between them, as edit.h says (edit.c). */

typedef struct fw_device_path {
    const char *attribute; /* behind "/@"; NULL: the element itself */
    const char *wrong;     /* what is wrong with it; NULL: nothing */
    const char *word;      /* the name that this is about; NULL: none */
    char name[64];
} fw_device_path;

/* false: there is no such element, and out->wrong says why. Test: test_edits.c, test_parameter.c */
bool fw_device_path_find(fw_xml_element *root, const char *path, fw_xml_element **found,
                         fw_device_path *out);

/* sentence of a point of a body */
#define FW_POINT_OF_BODY                                                                           \
    "Point in the body's frame, whose origin is the centroid of what is drawn of a link or "       \
    "platform without mass."

#endif
