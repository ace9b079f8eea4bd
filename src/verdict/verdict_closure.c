/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/compare.h"
#include "base/constants.h"
#include <math.h>

/* the mask is drawn where the bodies are, so both must put a pin at the same place */
static double pin_gap(const fw_mechanism *m, const fw_mechanism_pin *pin) {
    fw_geometry_vec2 a = fw_mechanism_pin_place(m, pin, 0), b = fw_mechanism_pin_place(m, pin, 1);
    return hypot(a.x - b.x, a.y - b.y);
}

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0.0 : m->body[body].phi_rad;
}

static bool driven(const fw_mechanism *m, int joint) {
    for (int i = 0; i < m->ndriver; i++)
        if (m->driver[i].joint == joint) return true;
    return false;
}

/* how far a joint is from holding as drawn: m, and rad beside it */
static double joint_gap(const fw_mechanism *m, int i, double *angle_rad) {
    const fw_device_joint *t = &m->joint[i];
    fw_geometry_vec2 a = fw_mechanism_local_place(m, t->body_a, t->ax_m, t->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, t->body_b, t->bx_m, t->by_m);
    double dx = b.x - a.x, dy = b.y - a.y, axis = turn_of(m, t->body_a) + t->axis_rad;
    *angle_rad = turn_of(m, t->body_b) - turn_of(m, t->body_a) - t->angle_rad;
    switch (t->kind) {
    case FW_JOINT_PRISMATIC:
        return fabs(-sin(axis) * dx + cos(axis) * dy);
    case FW_JOINT_DISTANCE: /* a driver gives another length, from the start on */
        *angle_rad = 0;
        return driven(m, i) ? 0 : fabs(hypot(dx, dy) - t->length_m);
    case FW_JOINT_WELD:
        break;
    }
    return hypot(dx, dy);
}

fw_status fw_verdict_check_closure(const fw_device *device, const fw_mechanism *m,
                                   fw_diags *diags) {
    const double grid = 10e-9, tilt_rad = 1e-5; /* 10 nm over 1 mm */
    fw_status status = FW_OK;
    for (int i = 0; i < m->npin + m->njoint; i++) {
        bool pin = i < m->npin;
        double tilt = 0, gap = pin ? pin_gap(m, &m->pin[i]) : joint_gap(m, i - m->npin, &tilt);
        const char *id = pin ? m->pin[i].id : m->joint[i - m->npin].id;
        char text[32];
        if (gap > grid)
            status = fw_diag_error(
                diags, 206, pin ? device->revolute[i].place : m->joint[i - m->npin].place,
                "joint %s does not close in the drawn position: its two bodies put it "
                "%s um apart (10 nm is allowed); correct the body positions or its "
                "coordinates, since masks are drawn there; `flexwright assemble` prints poses "
                "that close",
                id, fw_number_text(text, sizeof text, gap * 1e6, 4));
        else if (fabs(tilt) > tilt_rad)
            status = fw_diag_error(
                diags, 206, m->joint[i - m->npin].place,
                "joint %s does not close in the drawn position: its bodies are turned against "
                "each other by %s deg more than its angle; correct the angle or the bodies, since "
                "masks are drawn there",
                id, fw_number_text(text, sizeof text, tilt * 180 / FW_PI, 4));
    }
    return status;
}
