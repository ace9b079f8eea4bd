/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/compare.h"
#include <math.h>

/* where body a and body b put the pin, drawn pose; the mask is drawn there, so both must agree */
static double pin_gap(const fw_mechanism *m, const fw_pin *pin) {
    const int body[2] = {pin->body_a, pin->body_b};
    const double local[2][2] = {{pin->ax_m, pin->ay_m}, {pin->bx_m, pin->by_m}};
    double at[2][2];
    for (int i = 0; i < 2; i++) {
        fw_mass ground = {0};
        const fw_mass *b = body[i] == FW_GROUND ? &ground : &m->body[body[i]];
        double c = cos(b->phi_rad), s = sin(b->phi_rad);
        at[i][0] = b->x_m + c * local[i][0] - s * local[i][1];
        at[i][1] = b->y_m + s * local[i][0] + c * local[i][1];
    }
    return hypot(at[0][0] - at[1][0], at[0][1] - at[1][1]);
}

fw_status fw_verdict_check_closure(const fw_device *device, const fw_mechanism *m,
                                   fw_diags *diags) {
    const double grid = 10e-9;
    fw_status status = FW_OK;
    for (int i = 0; i < m->npin; i++) {
        double gap = pin_gap(m, &m->pin[i]);
        if (gap <= grid) continue;
        char um[32];
        status =
            fw_diag_error(diags, 206, device->joint[i].place,
                          "joint %s does not close in the drawn position: its two bodies put it "
                          "%s um apart (10 nm is allowed); correct the body positions or its "
                          "coordinates, since masks are drawn there",
                          m->pin[i].id, fw_number_text(um, sizeof um, gap * 1e6, 4));
    }
    return status;
}
