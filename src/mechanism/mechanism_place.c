/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mechanism/builder.h"
#include <math.h>

fw_geometry_vec2 fw_mechanism_body_point(const fw_mechanism_mass *body, fw_geometry_vec2 local) {
    if (!body) return local;
    double c = cos(body->phi_rad), s = sin(body->phi_rad);
    return (fw_geometry_vec2){body->x_m + c * local.x - s * local.y,
                              body->y_m + s * local.x + c * local.y};
}

fw_geometry_vec2 fw_mechanism_local_place(const fw_mechanism *m, int body, double x_m, double y_m) {
    return fw_mechanism_body_point(body == FW_GROUND ? NULL : &m->body[body],
                                   (fw_geometry_vec2){x_m, y_m});
}

fw_geometry_vec2 fw_mechanism_pin_place(const fw_mechanism *m, const fw_mechanism_pin *pin,
                                        int side) {
    return side ? fw_mechanism_local_place(m, pin->body_b, pin->bx_m, pin->by_m)
                : fw_mechanism_local_place(m, pin->body_a, pin->ax_m, pin->ay_m);
}
