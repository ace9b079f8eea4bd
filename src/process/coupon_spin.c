/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include <math.h>

/* Resist of thickness d at speed w: ln d = ln d0 - a ln(w/w0), w0 the reference speed of the pack.
   Two parameters in closed form; the error of the speed counts with a, which is iterated. d, d0 m;
   w rad/s; a 1. Source: docs/theory/calibrate.md. Test: test_calibrate.c. */
static fw_status fit(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], one[FW_COUPON_ROWS], x[FW_COUPON_ROWS], w0, u0;
    if (!fw_process_coupon_value(w, "resist.w0", &w0, &u0))
        return fw_process_coupon_wrong(w, w->row[0], "resist.w0 is not known in this flow");
    fw_process_fit f = {.value = {0.0, 0.5}};
    for (int round = 0; round < 6; round++) {
        for (int i = 0; i < w->nrow; i++) {
            const fw_process_measurement *r = w->row[i];
            if (!fw_quantity_dimension_equal(r->at_dimension,
                                             (fw_quantity_dimension)FW_DIM_ROTATION) ||
                !(r->at > 0.0) || !(r->value > 0.0))
                return fw_process_coupon_wrong(
                    w, r,
                    "spin needs a thickness above zero, and the speed in the "
                    "columns at, u_at and at_unit");
            y[i] = log(r->value), one[i] = 1.0, x[i] = -log(r->at / w0);
            s[i] = hypot(r->uncertainty / r->value, f.value[1] * r->at_uncertainty / r->at);
        }
        f = fw_process_fit_plane(y, s, one, x, w->nrow);
        if (w->nrow < 2 || !isfinite(f.value[1]))
            return fw_process_coupon_wrong(w, w->row[0], "spin needs two speeds or more");
    }
    if (!(f.value[1] > 0.0))
        return fw_process_coupon_wrong(w, w->row[0],
                                       "the resist is thicker at higher speed: check the rows");
    double d0 = exp(f.value[0]);
    const char *note = fw_arena_printf(w->arena,
                                       "from %d coats; correlation of thickness and exponent "
                                       "%d %%",
                                       w->nrow, (int)lround(100.0 * f.correlation));
    FW_NEED(note);
    FW_TRY(fw_process_coupon_give(w, "resist.d0", d0, d0 * f.uncertainty[0], &f, note));
    return fw_process_coupon_give(w, "resist.a", f.value[1], f.uncertainty[1], &f, note);
}

const fw_process_coupon fw_process_coupon_spin = {"spin", FW_DIM_LENGTH, false, false, true, fit};
