/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What joins bodies beside pins: point-to-point springs, joints and drivers. Values that the file
   leaves open are those of the drawn pose. */
#include "mechanism/mechanism.h"
#include "quantity/law_kind.h"
#include <float.h>
#include <math.h>

bool fw_mechanism_all_finite(const double *value, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(value[i])) return false;
    return true;
}

bool fw_mechanism_said_already(const fw_diags *diags, int number, fw_place place) {
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].number == number && diags->item[i].place.line == place.line &&
            diags->item[i].place.column == place.column && place.line > 0)
            return true;
    return false;
}

static bool two_bodies(const fw_mechanism_builder *b, int x, int y) {
    int n = b->device->nbody;
    return x >= FW_GROUND && y >= FW_GROUND && x < n && y < n && x != y;
}

/* explicit values of the file, scaled; 0 where there is none */
static double scaled(double value, double scale) {
    return isnan(value) ? 0 : value * scale;
}

/* from point a to point b in the drawn pose */
static fw_geometry_vec2 span(const fw_mechanism_builder *b, int body_a, double ax, double ay,
                             int body_b, double bx, double by) {
    fw_geometry_vec2 from = fw_mechanism_local_place(b->mechanism, body_a, ax, ay);
    fw_geometry_vec2 to = fw_mechanism_local_place(b->mechanism, body_b, bx, by);
    return (fw_geometry_vec2){to.x - from.x, to.y - from.y};
}

fw_status fw_mechanism_build_spring(const fw_mechanism_builder *b, int i) {
    const fw_device_spring *from = &b->device->spring[i];
    fw_device_spring *to = &b->mechanism->spring[i];
    *to = *from;
    to->stiffness_N_per_m = scaled(from->stiffness_N_per_m, b->variant->explicit_stiffness_scale);
    to->damping_Ns_per_m = scaled(from->damping_Ns_per_m, b->variant->explicit_damping_scale);
    const double all[7] = {
        to->ax_m,    to->ay_m, to->bx_m, to->by_m, to->stiffness_N_per_m, to->damping_Ns_per_m,
        to->length_m};
    if (!two_bodies(b, to->body_a, to->body_b) || !fw_mechanism_all_finite(all, 7) || all[4] < 0 ||
        all[5] < 0 || all[6] < 0)
        return fw_diag_error(
            b->diags, 89, from->place,
            "spring %s must join two different bodies, with finite points and with "
            "stiffness, damping and length that are not negative",
            fw_text_name(from->id));
    fw_geometry_vec2 d = span(b, to->body_a, to->ax_m, to->ay_m, to->body_b, to->bx_m, to->by_m);
    /* a slack cable pushes in no direction, and so does a spring without a rest length */
    if (d.x == 0 && d.y == 0 && to->length_m > 0 && to->stiffness_N_per_m > 0 && !to->cable &&
        !fw_mechanism_said_already(b->diags, 91, from->place)) {
        char length[32];
        fw_diag_warning(b->diags, 91, from->place,
                        "both ends of spring %s lie on the same point as drawn, and its length at "
                        "rest is %s m: its force has no direction and is left out until they part; "
                        "move an end, or give length=\"0 um\"",
                        fw_text_name(from->id),
                        fw_number_text(length, sizeof length, to->length_m, 4));
    }
    return FW_OK;
}

/* phi_b - phi_a as drawn */
static double drawn_angle(const fw_mechanism_builder *b, int body_a, int body_b) {
    const fw_mechanism_mass *body = b->mechanism->body;
    return (body_b == FW_GROUND ? 0 : body[body_b].phi_rad) -
           (body_a == FW_GROUND ? 0 : body[body_a].phi_rad);
}

fw_status fw_mechanism_build_joint(const fw_mechanism_builder *b, int i) {
    const fw_device_joint *from = &b->device->joint[i];
    fw_device_joint *to = &b->mechanism->joint[i];
    *to = *from;
    bool distance = to->kind == FW_JOINT_DISTANCE, prismatic = to->kind == FW_JOINT_PRISMATIC;
    if (!two_bodies(b, to->body_a, to->body_b))
        return fw_diag_error(b->diags, 90, from->place,
                             "joint %s must join two different bodies of the mechanism",
                             fw_text_name(from->id));
    if (distance && isnan(to->length_m)) {
        fw_geometry_vec2 d =
            span(b, to->body_a, to->ax_m, to->ay_m, to->body_b, to->bx_m, to->by_m);
        to->length_m = hypot(d.x, d.y);
    } else if (!distance)
        to->length_m = 0;
    if (distance)
        to->angle_rad = 0;
    else if (isnan(to->angle_rad))
        to->angle_rad = drawn_angle(b, to->body_a, to->body_b);
    if (!prismatic) to->axis_rad = to->free_length_m = 0;
    to->stiffness_N_per_m =
        prismatic ? scaled(from->stiffness_N_per_m, b->variant->explicit_stiffness_scale) : 0;
    to->damping_Ns_per_m =
        prismatic ? scaled(from->damping_Ns_per_m, b->variant->explicit_damping_scale) : 0;
    const double all[] = {to->ax_m,
                          to->ay_m,
                          to->bx_m,
                          to->by_m,
                          to->axis_rad,
                          to->angle_rad,
                          to->length_m,
                          to->free_length_m,
                          to->stiffness_N_per_m,
                          to->damping_Ns_per_m};
    if (!fw_mechanism_all_finite(all, sizeof all / sizeof all[0]) || to->stiffness_N_per_m < 0 ||
        to->damping_Ns_per_m < 0)
        return fw_diag_error(
            b->diags, 90, from->place,
            "points, axis, angle and lengths of joint %s must be finite, stiffness "
            "and damping not negative",
            fw_text_name(from->id));
    if (distance && !(to->length_m > 0))
        return fw_diag_error(
            b->diags, 90, from->place,
            "the points of distance joint %s lie on the same point as drawn, and a "
            "rod without length has no direction; give its length, or join the "
            "bodies by a <revolute>",
            fw_text_name(from->id));
    return FW_OK;
}

fw_status fw_mechanism_build_driver(const fw_mechanism_builder *b, int i) {
    const fw_device_driver *from = &b->device->driver[i];
    b->mechanism->driver[i] = *from;
    bool revolute = from->revolute >= 0 && from->revolute < b->device->nrevolute;
    bool joint = from->joint >= 0 && from->joint < b->device->njoint &&
                 b->device->joint[from->joint].kind != FW_JOINT_WELD;
    double value[3] = {(double)NAN, (double)NAN, (double)NAN};
    if (revolute == joint || (revolute ? from->joint : from->revolute) != FW_NONE)
        return fw_diag_error(b->diags, 92, from->place,
                             "driver %s must drive one revolute, prismatic or distance joint",
                             fw_text_name(from->id));
    if (fw_quantity_law_is_ready(&from->law))
        fw_quantity_law_value(&from->law, 0, DBL_MIN, value); /* the piece that begins at 0 */
    if (!fw_mechanism_all_finite(value, 3))
        return fw_diag_error(
            b->diags, 92, from->value_place,
            "the value of driver %s, its rate or its acceleration is not finite at the "
            "start",
            fw_text_name(from->id));
    if (joint && b->device->joint[from->joint].kind == FW_JOINT_DISTANCE && !(value[0] > 0))
        return fw_diag_error(b->diags, 92, from->value_place,
                             "driver %s gives its rod a length that is not above 0 at the start",
                             fw_text_name(from->id));
    return FW_OK;
}
