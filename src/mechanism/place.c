/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mechanism/mechanism.h"
#include <math.h>

fw_vec2 fw_pin_place(const fw_mechanism *m, const fw_pin *pin, int side) {
    int index = side ? pin->body_b : pin->body_a;
    double x = side ? pin->bx_m : pin->ax_m, y = side ? pin->by_m : pin->ay_m;
    if (index == FW_GROUND) return (fw_vec2){x, y};
    const fw_mass *body = &m->body[index];
    double c = cos(body->phi_rad), s = sin(body->phi_rad);
    return (fw_vec2){body->x_m + c * x - s * y, body->y_m + s * x + c * y};
}
