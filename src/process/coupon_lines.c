/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include <math.h>
#include <string.h>

/* Lines and spaces of known width on the mask, not compensated, measured on the wafer: every edge
   stands out by e = (m - w)/2, of a space by (w - m)/2. m, w, e m. Where the flow etches a mask
   layer sideways by L = sum d (1 + overrun), made.al-edge = e + L is what is left of it; else e is
   litho.edge. Weighted mean; residuals are tested. Source: geometry. Test: test_calibrate.c. */
static fw_status fit(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], loss = fw_process_coupon_loss(w->flow);
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        bool space = strcmp(r->feature, "space") == 0;
        if (!space && strcmp(r->feature, "line") != 0)
            return fw_process_coupon_wrong(
                w, r, "the feature of cd-lines is line or space, not '%s'", r->feature);
        y[i] = (space ? -0.5 : 0.5) * (r->value - r->drawn_m);
        s[i] = 0.5 * r->uncertainty;
    }
    fw_process_fit f = fw_process_fit_mean(y, s, w->nrow);
    bool etched = fw_process_coupon_has(w->flow, "made.al-edge");
    return fw_process_coupon_give(
        w, etched ? "made.al-edge" : "litho.edge", f.value[0] + (etched ? loss : 0.0),
        f.uncertainty[0], &f,
        etched ? "edge in the aluminium against the mask, and what the wet etch is "
                 "planned to take; the printed edge is in it"
               : "edge on the wafer against the mask");
}

const fw_process_coupon fw_process_coupon_cd_lines = {"cd-lines", FW_DIM_LENGTH, false,
                                                      true,       false,         fit};
