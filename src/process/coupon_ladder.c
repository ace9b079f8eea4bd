/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include <math.h>
#include <string.h>

/* twice the lateral loss of both edges: of a line that stands, w - m; between the widest line that
   is gone and the narrowest that stands, uniform: (stands - gone)/sqrt(12) */
static fw_status losses(fw_process_coupon_work *w, double *y, double *s, int *n) {
    double gone = -1.0, stands = (double)INFINITY;
    const fw_process_measurement *of = NULL;
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        if (strcmp(r->feature, "width") == 0) {
            y[*n] = r->drawn_m - r->value;
            s[(*n)++] = r->uncertainty;
        } else if (strcmp(r->feature, "gone") == 0 || strcmp(r->feature, "stands") == 0) {
            of = r;
            if (r->feature[0] == 'g')
                gone = fmax(gone, r->drawn_m);
            else
                stands = fmin(stands, r->drawn_m);
        } else
            return fw_process_coupon_wrong(
                w, r,
                "the feature of undercut-ladder is width (of the top), gone "
                "or stands, not '%s'",
                r->feature);
    }
    if (!of) return FW_OK;
    if (gone < 0.0 || isinf(stands))
        return fw_process_coupon_wrong(w, of,
                                       "undercut-ladder needs the widest line that is gone and the "
                                       "narrowest that stands, both");
    if (!(gone < stands))
        return fw_process_coupon_wrong(w, of,
                                       "a line stands that is narrower than one that is gone");
    y[*n] = 0.5 * (gone + stands);
    s[(*n)++] = (stands - gone) / sqrt(12.0);
    return FW_OK;
}

/* Lines of width w on the mask, not compensated; the mask layer lost L at every edge (what the flow
   plans less made.al-edge), the plasma u at the top: w - m = 2 L + 2 u, u = (1 - A) E, A = 1 - u/E.
   E: the depth that wide openings have reached, or rate times the time, over-etch included. All m;
   A 1. u(A)^2 = (u_u/E)^2 + (u u_E/E^2)^2. Source: docs/theory/calibrate.md.
   Test: test_calibrate.c.
 */
static fw_status fit(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], E, u_E, edge = 0.0, u_edge = 0.0;
    int n = 0;
    bool timed =
        fw_quantity_dimension_equal(w->row[0]->at_dimension, (fw_quantity_dimension)FW_DIM_TIME);
    FW_TRY(fw_process_coupon_condition(w, w->row[0]->at_dimension, "what was etched", &E, &u_E));
    if (timed) {
        double R, u_R;
        if (!fw_process_coupon_value(w, "rie.R", &R, &u_R))
            return fw_process_coupon_wrong(w, w->row[0],
                                           "the rate rie.R is not known; give the depth in wide "
                                           "openings in the column at");
        u_E = hypot(R * u_E, E * u_R);
        E *= R;
    } else if (!fw_quantity_dimension_equal(w->row[0]->at_dimension,
                                            (fw_quantity_dimension)FW_DIM_LENGTH))
        return fw_process_coupon_wrong(w, w->row[0],
                                       "the column at of undercut-ladder is a depth or a time");
    FW_TRY(losses(w, y, s, &n));
    fw_process_coupon_value(w, "made.al-edge", &edge, &u_edge);
    fw_process_fit f = fw_process_fit_mean(y, s, n);
    double u = 0.5 * f.value[0] - (fw_process_coupon_loss(w->flow) - edge);
    double A = 1.0 - u / E, u_A = hypot(hypot(0.5 * f.uncertainty[0], u_edge), u / E * u_E) / E;
    if (!(A > 0.0) || !(A < 1.0 + 2.0 * u_A))
        return fw_process_coupon_wrong(w, w->row[0],
                                       "an anisotropy that is not between 0 and 1 comes of it: "
                                       "check widths, edge of the aluminium and depth");
    const char *note = fw_arena_printf(
        w->arena, "undercut at the top over the depth of wide openings, %d lines", n);
    FW_NEED(note);
    return fw_process_coupon_give(w, "rie.A", fmin(A, 1.0), u_A, &f, note);
}

const fw_process_coupon fw_process_coupon_ladder = {
    "undercut-ladder", FW_DIM_LENGTH, false, true, true, fit};
