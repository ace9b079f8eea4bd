/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <mechanism>: bodies, joints, springs, drivers. */
#include "device/device_reader.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* what is drawn must lie on a wafer */
static void check_on_wafer(fw_device_reader *r, const fw_xml_record *record, const char *name,
                           double value_m) {
    const double most_m = 0.3;
    char label[FW_LABEL], value[FW_LABEL];
    if (!(fabs(value_m) > most_m * (1 + 1e-12))) return;
    fw_diag_error(
        r->diags, 47, fw_xml_place_of(record, name),
        "%s: %s puts it at %s; what is drawn must lie within -300 mm and 300 mm (wafers are at "
        "most 300 mm wide). Move it there; or, for a mechanism that is only computed, give its "
        "bodies mass and inertia in place of a width, a plate or shapes",
        fw_xml_label(record, label), name, fw_xml_in_unit(value, value_m, "mm"));
}

/* ---- revolute, prismatic, distance, weld, spring, driver ---- */

/* both ends of a joint or spring; false when one is not known */
static bool read_ends(fw_device_reader *r, const fw_xml_record *record, int *a, int *b) {
    *a = fw_device_reference(r, record, "a");
    *b = fw_device_reference(r, record, "b");
    if (*a == FW_NOWHERE || *b == FW_NOWHERE) return false;
    if (*a != *b) return true;
    char label[FW_LABEL];
    fw_diag_error(r->diags, 62, fw_xml_place_of(record, "b"),
                  "%s joins '%s' to itself; a and b must be two bodies, or a body and ground",
                  fw_xml_label(record, label), fw_xml_text_of(record, "a"));
    return false;
}

/* world = pose of the body * local; NaN while the body's pose waits for its shape */
static void to_world(const fw_device *d, int body, double lx_m, double ly_m, double *x_m,
                     double *y_m) {
    *x_m = lx_m;
    *y_m = ly_m;
    if (body < 0) return;
    const fw_device_body *b = &d->body[body];
    double c = cos(b->phi_rad), s = sin(b->phi_rad);
    *x_m = b->x_m + c * lx_m - s * ly_m;
    *y_m = b->y_m + s * lx_m + c * ly_m;
}

/* ---- turning ---- */

static void check_stops(fw_device_reader *r, const fw_xml_record *record,
                        const fw_device_revolute *j) {
    static const char *const need[] = {"stop-min", "stop-max", "stop-damping"};
    char label[FW_LABEL], low[FW_LABEL], high[FW_LABEL];
    bool angle = fw_xml_given(record, "stop-min") || fw_xml_given(record, "stop-max");
    fw_xml_label(record, label);
    if (fw_xml_given(record, "stop-stiffness") && !angle)
        fw_diag_error(r->diags, 64, fw_xml_place_of(record, "stop-stiffness"),
                      "%s: stop-stiffness without a stop; add stop-min or stop-max, or remove it",
                      label);
    for (int i = 0; i < 3 && !fw_xml_given(record, "stop-stiffness"); i++)
        if (fw_xml_given(record, need[i])) {
            fw_diag_error(r->diags, 64, fw_xml_place_of(record, need[i]),
                          "%s: %s needs stop-stiffness, the torque per angle beyond the stop",
                          label, need[i]);
            break;
        }
    if (j->stop_min_rad >= j->stop_max_rad)
        fw_diag_error(r->diags, 63, fw_xml_place_of(record, "stop-min"),
                      "%s: stop-min %s is not below stop-max %s; exchange them", label,
                      fw_xml_in_unit(low, j->stop_min_rad, "deg"),
                      fw_xml_in_unit(high, j->stop_max_rad, "deg"));
    if (j->stop_stiffness_Nm_per_rad == 0)
        fw_diag_error(r->diags, 64, fw_xml_place_of(record, "stop-stiffness"),
                      "%s: a stop needs a stop-stiffness above 0; increase it, or remove the stop",
                      label);
}

static fw_device_revolute revolute_of(fw_device_reader *r, const fw_xml_record *record) {
    const fw_device *d = r->device;
    fw_device_revolute j = {.id = fw_xml_text_of(record, "id"),
                            .x_m = (double)NAN,
                            .y_m = (double)NAN,
                            .ax_m = fw_xml_number_or(record, "a-x", 0.0),
                            .ay_m = fw_xml_number_or(record, "a-y", 0.0),
                            .bx_m = fw_xml_number_or(record, "b-x", 0.0),
                            .by_m = fw_xml_number_or(record, "b-y", 0.0),
                            .stiffness_Nm_per_rad = fw_xml_number_of(record, "stiffness"),
                            .damping_Nms_per_rad = fw_xml_number_of(record, "damping"),
                            .free_angle_rad = fw_xml_number_or(record, "free-angle", 0.0),
                            .flexure = fw_device_reference(r, record, "hinge"),
                            .axis_rad = fw_xml_number_of(record, "axis"),
                            .stop_min_rad = fw_xml_number_of(record, "stop-min"),
                            .stop_max_rad = fw_xml_number_of(record, "stop-max"),
                            .stop_stiffness_Nm_per_rad = fw_xml_number_of(record, "stop-stiffness"),
                            .stop_damping_Nms_per_rad = fw_xml_number_of(record, "stop-damping"),
                            .place = record->element->place};
    check_stops(r, record, &j);
    if (!read_ends(r, record, &j.body_a, &j.body_b)) return j;
    to_world(d, j.body_a, j.ax_m, j.ay_m, &j.x_m, &j.y_m);
    if (j.flexure >= 0 || (j.body_a >= 0 && fw_device_body_drawn(&d->body[j.body_a])) ||
        (j.body_b >= 0 && fw_device_body_drawn(&d->body[j.body_b]))) {
        check_on_wafer(r, record, "a-x", j.x_m);
        check_on_wafer(r, record, "a-y", j.y_m);
    }
    return j;
}

/* ---- other joints ---- */

static fw_device_joint joint_of(fw_device_reader *r, const fw_xml_record *record,
                                fw_device_joint_kind kind) {
    fw_device_joint t = {.id = fw_xml_text_of(record, "id"),
                         .kind = kind,
                         .ax_m = fw_xml_number_or(record, "a-x", 0.0),
                         .ay_m = fw_xml_number_or(record, "a-y", 0.0),
                         .bx_m = fw_xml_number_or(record, "b-x", 0.0),
                         .by_m = fw_xml_number_or(record, "b-y", 0.0),
                         .axis_rad = fw_xml_number_of(record, "axis"),
                         .angle_rad = fw_xml_number_of(record, "angle"),
                         .length_m = fw_xml_number_of(record, "length"),
                         .stiffness_N_per_m = fw_xml_number_or(record, "stiffness", 0.0),
                         .damping_Ns_per_m = fw_xml_number_or(record, "damping", 0.0),
                         .free_length_m = fw_xml_number_or(record, "free-length", 0.0),
                         .place = record->element->place};
    read_ends(r, record, &t.body_a, &t.body_b);
    return t;
}

static fw_device_spring spring_of(fw_device_reader *r, const fw_xml_record *record) {
    const char *cable = fw_xml_text_of(record, "cable");
    fw_device_spring s = {.id = fw_xml_text_of(record, "id"),
                          .ax_m = fw_xml_number_or(record, "a-x", 0.0),
                          .ay_m = fw_xml_number_or(record, "a-y", 0.0),
                          .bx_m = fw_xml_number_or(record, "b-x", 0.0),
                          .by_m = fw_xml_number_or(record, "b-y", 0.0),
                          .stiffness_N_per_m = fw_xml_number_of(record, "stiffness"),
                          .damping_Ns_per_m = fw_xml_number_or(record, "damping", 0.0),
                          .length_m = fw_xml_number_or(record, "length", 0.0),
                          .expansion_per_K = fw_xml_number_or(record, "expansion", 0.0),
                          .cable = cable && strcmp(cable, "yes") == 0,
                          .place = record->element->place};
    read_ends(r, record, &s.body_a, &s.body_b);
    return s;
}

/* ---- drivers ---- */

/* `driven`, per joint and joint: line of its driver, 0: none yet */
static fw_status add_driver(fw_device_reader *r, const fw_xml_record *record, int *driven) {
    static const fw_quantity_dimension angle = {.rad = 1}, length = {.m = 1};
    fw_device *d = r->device;
    int k = fw_device_reference(r, record, "joint");
    const char *joint = fw_xml_text_of(record, "joint"), *id = fw_xml_text_of(record, "id");
    fw_device_driver *driver = &d->driver[d->ndriver++];
    *driver = (fw_device_driver){.id = id ? id : joint,
                                 .revolute = FW_NONE,
                                 .joint = FW_NONE,
                                 .law = {.kind = &fw_quantity_law_expression},
                                 .place = record->element->place,
                                 .value_place = fw_xml_place_of(record, "value")};
    if (k < 0) return FW_OK;
    if (k < d->nrevolute)
        driver->revolute = k;
    else
        driver->joint = k - d->nrevolute;
    if (driver->joint != FW_NONE && d->joint[driver->joint].kind == FW_JOINT_WELD)
        return fw_diag_error(r->diags, 73, fw_xml_place_of(record, "joint"),
                             "driver: '%s' is a weld, and a weld does not move; drive a revolute, "
                             "prismatic or distance joint",
                             joint) == FW_NOMEM
                   ? FW_NOMEM
                   : FW_OK;
    if (driven[k])
        fw_diag_error(r->diags, 73, fw_xml_place_of(record, "joint"),
                      "driver: '%s' is driven already (line %d), and a joint cannot follow two "
                      "laws; remove one",
                      joint, driven[k]);
    else
        driven[k] = driver->place.line;
    return fw_device_time_program(r, record, "value", driver->revolute != FW_NONE ? angle : length,
                                  &driver->law.program);
}

static fw_status add_drivers(fw_device_reader *r) {
    int *driven =
        fw_arena_array(r->arena, int, (size_t)r->device->nrevolute + (size_t)r->device->njoint);
    FW_NEED(driven);
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "driver"))
            FW_TRY(add_driver(r, &r->xml.record[i], driven));
    return FW_OK;
}

static fw_status build_joints(fw_device_reader *r) {
    fw_device *d = r->device;
    size_t joints = (size_t)fw_xml_count(&r->xml, "prismatic") +
                    (size_t)fw_xml_count(&r->xml, "distance") +
                    (size_t)fw_xml_count(&r->xml, "weld");
    FW_NEED(d->spring = fw_arena_array(r->arena, fw_device_spring,
                                       (size_t)fw_xml_count(&r->xml, "spring")));
    FW_NEED(d->joint = fw_arena_array(r->arena, fw_device_joint, joints));
    FW_NEED(d->driver = fw_arena_array(r->arena, fw_device_driver,
                                       (size_t)fw_xml_count(&r->xml, "driver")));
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *record = &r->xml.record[i];
        if (fw_xml_is(record, "revolute"))
            d->revolute[d->nrevolute++] = revolute_of(r, record);
        else if (fw_xml_is(record, "prismatic"))
            d->joint[d->njoint++] = joint_of(r, record, FW_JOINT_PRISMATIC);
        else if (fw_xml_is(record, "distance"))
            d->joint[d->njoint++] = joint_of(r, record, FW_JOINT_DISTANCE);
        else if (fw_xml_is(record, "weld"))
            d->joint[d->njoint++] = joint_of(r, record, FW_JOINT_WELD);
        else if (fw_xml_is(record, "spring"))
            d->spring[d->nspring++] = spring_of(r, record);
    }
    FW_TRY(add_drivers(r));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- bodies ---- */

static void check_mass(fw_device_reader *r, const fw_xml_record *record, bool shape,
                       const char *shape_advice) {
    char label[FW_LABEL];
    bool mass = fw_xml_given(record, "mass"), inertia = fw_xml_given(record, "inertia");
    if (mass != inertia)
        fw_diag_error(
            r->diags, 64, fw_xml_place_of(record, mass ? "mass" : "inertia"),
            "%s: mass and inertia belong together; add the %s, or remove this one and give "
            "a shape",
            fw_xml_label(record, label), mass ? "inertia" : "mass");
    else if (!mass && !shape)
        fw_diag_error(r->diags, 61, record->element->place,
                      "%s has neither mass and inertia nor a shape; give both, or %s",
                      fw_xml_label(record, label), shape_advice);
}

static fw_device_body body_of(fw_device_reader *r, const fw_xml_record *record) {
    static const char *const centre[] = {"com-x", "com-y"};
    bool wide = fw_xml_given(record, "plate-width"), high = fw_xml_given(record, "plate-height");
    char label[FW_LABEL];
    if (wide != high)
        fw_diag_error(r->diags, 64, fw_xml_place_of(record, wide ? "plate-width" : "plate-height"),
                      "%s: plate-width and plate-height belong together; add the other",
                      fw_xml_label(record, label));
    int shapes = fw_device_shapes_given(record);
    check_mass(r, record, fw_xml_given(record, "width") || wide || high || shapes > 0,
               "width (bars to its joints), plate-width and plate-height, or an <outline>");
    fw_device_body b = {.id = fw_xml_text_of(record, "id"),
                        .mass_kg = fw_xml_number_of(record, "mass"),
                        .inertia_kg_m2 = fw_xml_number_of(record, "inertia"),
                        .x_m = fw_xml_number_of(record, "x"),
                        .y_m = fw_xml_number_of(record, "y"),
                        .phi_rad = fw_xml_number_or(record, "phi", 0.0),
                        .com_x_m = fw_xml_number_of(record, "com-x"),
                        .com_y_m = fw_xml_number_of(record, "com-y"),
                        .width_m = fw_xml_number_of(record, "width"),
                        .plate_width_m = fw_xml_number_of(record, "plate-width"),
                        .plate_height_m = fw_xml_number_of(record, "plate-height"),
                        .plate_x_m = (double)NAN,
                        .plate_y_m = (double)NAN,
                        .plate_angle_rad = fw_xml_number_or(record, "plate-angle", 0.0),
                        .nshape = shapes, /* until they are built */
                        .inner_corner_m = fw_xml_number_or(record, "inner-corner", 0.0),
                        .inner_corner_place = fw_xml_place_of(record, "inner-corner"),
                        .place = record->element->place,
                        .width_place = fw_xml_place_of(record, "width"),
                        .shape_failed = fw_xml_failed(record, "width") ||
                                        fw_xml_failed(record, "plate-width") ||
                                        fw_xml_failed(record, "plate-height")};
    for (int k = 0; k < 2; k++)
        if (fw_xml_given(record, centre[k]) && !fw_xml_given(record, "mass"))
            fw_diag_error(
                r->diags, 64, fw_xml_place_of(record, centre[k]),
                "%s: %s is of a stated mass, but the body has none: its centre of mass is "
                "that of its drawn shape; add mass and inertia, or remove it",
                fw_xml_label(record, label), centre[k]);
    if (wide && high) {
        b.plate_x_m = fw_xml_number_or(record, "plate-x", b.x_m);
        b.plate_y_m = fw_xml_number_or(record, "plate-y", b.y_m);
    }
    if (fw_xml_given(record, "inner-corner") && shapes == 0)
        fw_diag_error(r->diags, 309, fw_xml_place_of(record, "inner-corner"),
                      "%s: inner-corner is of shapes inside the body, and there are none; remove "
                      "it, or draw an <outline>",
                      fw_xml_label(record, label));
    if (fw_device_body_drawn(&b)) {
        check_on_wafer(r, record, "x", b.x_m);
        check_on_wafer(r, record, "y", b.y_m);
        check_on_wafer(r, record, "plate-x", b.plate_x_m);
        check_on_wafer(r, record, "plate-y", b.plate_y_m);
    }
    return b;
}

static void check_present(fw_device_reader *r) {
    const fw_xml_record *mechanism = NULL;
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "mechanism")) mechanism = &r->xml.record[i];
    if (r->xml.unknown_element || r->device->nbody > 0) return;
    if (mechanism)
        fw_diag_error(r->diags, 52, mechanism->element->place,
                      "<mechanism> has no <body>; add at least one");
    else
        fw_diag_error(r->diags, 52, r->xml.root->place,
                      "<device> has no mechanism; add <six-bar> or <mechanism>");
}

fw_status fw_device_build_mechanism(fw_device_reader *r) {
    fw_device *d = r->device;
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "body")) {
            d->body[d->nbody] = body_of(r, &r->xml.record[i]);
            FW_TRY(fw_device_build_shapes(r, &r->xml.record[i], &d->body[d->nbody++]));
        }
    check_present(r);
    return build_joints(r);
}

/* <six-bar>: bodies AB BC CD DE EF and joints A..F of the general planar mechanism. */

enum { BODIES = 5, JOINTS = 6, PLATFORM = 2 };
static const char *const body_id[BODIES] = {"AB", "BC", "CD", "DE", "EF"};
static const char *const joint_id[JOINTS] = {"A", "B", "C", "D", "E", "F"};

typedef struct parts {
    const fw_xml_record *body[BODIES], *joint[JOINTS]; /* NULL: missing */
} parts;

static int index_of(const char *id, const char *const *ids, int n) {
    for (int i = 0; id && i < n; i++)
        if (strcmp(ids[i], id) == 0) return i;
    return -1;
}

static void gather(const fw_device_reader *r, parts *p) {
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *record = &r->xml.record[i];
        int k;
        if (fw_xml_is(record, "hinge") &&
            (k = index_of(fw_xml_text_of(record, "at"), joint_id, JOINTS)) >= 0 && !p->joint[k])
            p->joint[k] = record;
        else if ((fw_xml_is(record, "link") || fw_xml_is(record, "platform")) &&
                 (k = index_of(fw_xml_text_of(record, "id"), body_id, BODIES)) >= 0 && !p->body[k])
            p->body[k] = record;
    }
}

static void report_missing(fw_device_reader *r, const parts *p, fw_place place) {
    char list[200] = "";
    size_t used = 0;
    for (int i = 0; i < JOINTS && !r->xml.broken[FW_SPACE_JOINT]; i++)
        if (!p->joint[i])
            used += (size_t)snprintf(list + used, sizeof list - used, " <hinge at=\"%s\">",
                                     joint_id[i]);
    for (int i = 0; i < BODIES && !r->xml.broken[FW_SPACE_BODY]; i++)
        if (!p->body[i])
            used += (size_t)snprintf(list + used, sizeof list - used, " <%s id=\"%s\">",
                                     i == PLATFORM ? "platform" : "link", body_id[i]);
    if (used > 0)
        fw_diag_error(r->diags, 52, place,
                      "<six-bar> is not complete; add%s (it has six hinges, four links and a "
                      "platform)",
                      list);
}

static fw_device_revolute six_bar_joint(fw_device_reader *r, const parts *p, int i) {
    fw_device_revolute j = {.id = joint_id[i],
                            .body_a = i - 1, /* ground is -1 */
                            .body_b = i < BODIES ? i : FW_GROUND,
                            .ax_m = (double)NAN,
                            .ay_m = (double)NAN,
                            .bx_m = (double)NAN,
                            .by_m = (double)NAN,
                            .flexure = FW_NONE,
                            .stop_min_rad = (double)NAN,
                            .stop_max_rad = (double)NAN,
                            .stop_stiffness_Nm_per_rad = (double)NAN,
                            .stop_damping_Nms_per_rad = (double)NAN};
    const fw_xml_record *record = p->joint[i];
    if (!record) return j;
    j.x_m = fw_xml_number_of(record, "x");
    j.y_m = fw_xml_number_of(record, "y");
    j.stiffness_Nm_per_rad = fw_xml_number_of(record, "stiffness");
    j.damping_Nms_per_rad = fw_xml_number_of(record, "damping");
    j.free_angle_rad = fw_xml_number_or(record, "free-angle", 0.0);
    j.axis_rad = fw_xml_number_of(record, "axis");
    j.flexure = fw_device_reference(r, record, "flexure");
    j.place = record->element->place;
    return j;
}

static void check_hinge_points(fw_device_reader *r, const parts *p) {
    const fw_device_revolute *joint = r->device->revolute;
    for (int i = 0; i < BODIES; i++) {
        double d = hypot(joint[i + 1].x_m - joint[i].x_m, joint[i + 1].y_m - joint[i].y_m);
        if (p->joint[i] && p->joint[i + 1] && d < 1e-9)
            fw_diag_error(r->diags, 60, fw_xml_place_of(p->joint[i + 1], "x"),
                          "hinges %s and %s of %s '%s' lie on the same point; move one",
                          joint_id[i], joint_id[i + 1], i == PLATFORM ? "platform" : "link",
                          body_id[i]);
    }
}

static void check_link(fw_device_reader *r, const fw_xml_record *record) {
    static const char *const centre[] = {"x", "y"};
    check_mass(r, record, fw_xml_given(record, "width"), "width");
    for (int k = 0; k < 2; k++)
        if (fw_xml_given(record, centre[k]) && !fw_xml_given(record, "mass")) {
            char label[FW_LABEL];
            fw_diag_error(r->diags, 64, fw_xml_place_of(record, centre[k]),
                          "%s: %s gives the centre of mass, but the body has no mass; add mass and "
                          "inertia, or remove it",
                          fw_xml_label(record, label), centre[k]);
        }
}

static fw_device_body six_bar_body(fw_device_reader *r, const parts *p, int i) {
    double none = (double)NAN;
    fw_device_body b = {.id = body_id[i],
                        .mass_kg = none,
                        .inertia_kg_m2 = none,
                        .x_m = none,
                        .y_m = none,
                        .com_x_m = none,
                        .com_y_m = none,
                        .width_m = none,
                        .plate_width_m = none,
                        .plate_height_m = none,
                        .plate_x_m = none,
                        .plate_y_m = none,
                        .platform = i == PLATFORM};
    const fw_xml_record *record = p->body[i];
    if (!record) return b;
    const fw_device_revolute *first = &r->device->revolute[i], *second = first + 1;
    bool heavy = fw_xml_given(record, "mass");
    b.mass_kg = fw_xml_number_of(record, "mass");
    b.inertia_kg_m2 = fw_xml_number_of(record, "inertia");
    b.place = record->element->place;
    if (i != PLATFORM) {
        b.width_m = fw_xml_number_of(record, "width");
        b.width_place = fw_xml_place_of(record, "width");
        b.x_m = fw_xml_number_or(record, "x", heavy ? (first->x_m + second->x_m) / 2 : none);
        b.y_m = fw_xml_number_or(record, "y", heavy ? (first->y_m + second->y_m) / 2 : none);
        check_link(r, record);
        return b;
    }
    b.plate_width_m = fw_xml_number_of(record, "width");
    b.plate_height_m = fw_xml_number_of(record, "height");
    b.plate_x_m = fw_xml_number_of(record, "x");
    b.plate_y_m = fw_xml_number_of(record, "y");
    b.plate_angle_rad = fw_xml_number_or(record, "angle", 0.0);
    b.x_m = heavy ? b.plate_x_m : none;
    b.y_m = heavy ? b.plate_y_m : none;
    check_mass(r, record, fw_xml_given(record, "width") && fw_xml_given(record, "height"),
               "width and height");
    return b;
}

fw_status fw_device_expand_six_bar(fw_device_reader *r) {
    fw_device *d = r->device;
    const fw_xml_record *six_bar = NULL;
    for (int i = 0; i < r->xml.nrecord && !six_bar; i++)
        if (fw_xml_is(&r->xml.record[i], "six-bar")) six_bar = &r->xml.record[i];
    size_t bodies = (size_t)fw_xml_count(&r->xml, "body") + BODIES,
           joints = (size_t)fw_xml_count(&r->xml, "revolute");
    FW_NEED(d->body = fw_arena_array(r->arena, fw_device_body, bodies));
    FW_NEED(d->revolute = fw_arena_array(r->arena, fw_device_revolute, joints + JOINTS));
    if (!six_bar) return FW_OK;
    parts p = {0};
    gather(r, &p);
    report_missing(r, &p, six_bar->element->place);
    d->six_bar = true;
    for (int i = 0; i < JOINTS; i++)
        d->revolute[d->nrevolute++] = six_bar_joint(r, &p, i);
    check_hinge_points(r, &p);
    for (int i = 0; i < BODIES; i++)
        d->body[d->nbody++] = six_bar_body(r, &p, i);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
