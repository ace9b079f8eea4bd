/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/compare.h"
#include <math.h>

/* the mask is drawn where the bodies are, so both must put a pin at the same place */
static double pin_gap(const fw_mechanism *m, const fw_pin *pin) {
    fw_vec2 a = fw_pin_place(m, pin, 0), b = fw_pin_place(m, pin, 1);
    return hypot(a.x - b.x, a.y - b.y);
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
                          "coordinates, since masks are drawn there; `flexwright assemble` prints poses "
                          "that close",
                          m->pin[i].id, fw_number_text(um, sizeof um, gap * 1e6, 4));
    }
    return status;
}
