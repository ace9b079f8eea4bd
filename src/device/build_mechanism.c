/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <mechanism>: bodies, joints, springs, drivers. */
#include "device/device_reader.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <string.h>

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
        fw_device_wafer_check(r, record, "a-x", j.x_m);
        fw_device_wafer_check(r, record, "a-y", j.y_m);
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

void fw_device_mass_check(fw_device_reader *r, const fw_xml_record *record, bool shape,
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

bool fw_device_body_drawn(const fw_device_body *body) {
    return !isnan(body->width_m) || !isnan(body->plate_width_m);
}

void fw_device_wafer_check(fw_device_reader *r, const fw_xml_record *record, const char *name,
                           double value_m) {
    const double most_m = 0.3;
    char label[FW_LABEL], value[FW_LABEL];
    if (!(fabs(value_m) > most_m * (1 + 1e-12))) return;
    fw_diag_error(
        r->diags, 47, fw_xml_place_of(record, name),
        "%s: %s puts it at %s; what is drawn must lie within -300 mm and 300 mm (wafers are at "
        "most 300 mm wide); leave the width out for a mechanism that is only computed",
        fw_xml_label(record, label), name, fw_xml_in_unit(value, value_m, "mm"));
}

static fw_device_body body_of(fw_device_reader *r, const fw_xml_record *record) {
    bool wide = fw_xml_given(record, "plate-width"), high = fw_xml_given(record, "plate-height");
    char label[FW_LABEL];
    if (wide != high)
        fw_diag_error(r->diags, 64, fw_xml_place_of(record, wide ? "plate-width" : "plate-height"),
                      "%s: plate-width and plate-height belong together; add the other",
                      fw_xml_label(record, label));
    fw_device_mass_check(r, record, fw_xml_given(record, "width") || wide || high,
                         "width (bars to its joints) or plate-width and plate-height");
    fw_device_body b = {.id = fw_xml_text_of(record, "id"),
                        .mass_kg = fw_xml_number_of(record, "mass"),
                        .inertia_kg_m2 = fw_xml_number_of(record, "inertia"),
                        .x_m = fw_xml_number_of(record, "x"),
                        .y_m = fw_xml_number_of(record, "y"),
                        .phi_rad = fw_xml_number_or(record, "phi", 0.0),
                        .width_m = fw_xml_number_of(record, "width"),
                        .plate_width_m = fw_xml_number_of(record, "plate-width"),
                        .plate_height_m = fw_xml_number_of(record, "plate-height"),
                        .plate_x_m = (double)NAN,
                        .plate_y_m = (double)NAN,
                        .plate_angle_rad = fw_xml_number_or(record, "plate-angle", 0.0),
                        .place = record->element->place,
                        .width_place = fw_xml_place_of(record, "width")};
    if (wide && high) {
        b.plate_x_m = fw_xml_number_or(record, "plate-x", b.x_m);
        b.plate_y_m = fw_xml_number_or(record, "plate-y", b.y_m);
    }
    if (fw_device_body_drawn(&b)) {
        fw_device_wafer_check(r, record, "x", b.x_m);
        fw_device_wafer_check(r, record, "y", b.y_m);
        fw_device_wafer_check(r, record, "plate-x", b.plate_x_m);
        fw_device_wafer_check(r, record, "plate-y", b.plate_y_m);
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
        if (fw_xml_is(&r->xml.record[i], "body"))
            d->body[d->nbody++] = body_of(r, &r->xml.record[i]);
    check_present(r);
    return build_joints(r);
}
