/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include <math.h>

/* depth of a slot after R0 t, lag S: root of D + S J(w, D) = R0 t by Newton; J' = 1/K - 1 */
static double depth_of(double width, double travelled, double S) {
    double D = travelled;
    for (int i = 0; i < 60; i++) {
        double slope = 1.0 + S * (1.0 / fw_process_knudsen_slot(D / width) - 1.0);
        double step = (D + S * fw_process_arde_integral(width, D, false) - travelled) / slope;
        D = fmax(D - step, 0.1 * D);
        if (fabs(step) < 1e-15 * travelled) break;
    }
    return D;
}

/* Slots of widths w, the same time t: D_i = R0 t - S J(w_i, D_i)
   (docs/theory/calibrate.md). With two slots that is S = (D2 - D1)/(J1 - J2), R0 = (D1 + S J1)/t;
   with more, the start of Gauss and Newton on D_i(R0 t, S), weighted with 1/u^2: dD/d(R0 t) = 1/(1
   + S J'), dD/dS = -J/(1 + S J').
   The time is common to all: its uncertainty comes on top of R0's. w, D m, t s; S 1. Lag above
   twice its uncertainty below zero is refused. Test: test_calibrate.c, two_slots, coverage. */
static fw_status fit(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], p[FW_COUPON_ROWS], q[FW_COUPON_ROWS], t, u_t;
    FW_TRY(fw_process_coupon_condition(w, (fw_quantity_dimension)FW_DIM_TIME, "the etch time", &t,
                                       &u_t));
    if (w->nrow < 2)
        return fw_process_coupon_wrong(w, w->row[0], "arde-slots needs two widths or more");
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        if (!(r->value > 0.0) || r->value / r->drawn_m > 1000.0)
            return fw_process_coupon_wrong(
                w, r, "the depth of a slot is above zero and below 1000 widths");
        y[i] = r->value, s[i] = r->uncertainty, p[i] = 1.0;
        q[i] = -fw_process_arde_integral(r->drawn_m, r->value, false);
    }
    fw_process_fit f = fw_process_fit_plane(y, s, p, q, w->nrow);
    double travelled = f.value[0], S = f.value[1];
    if (!isfinite(S))
        return fw_process_coupon_wrong(w, w->row[0], "all slots of arde-slots are equally wide");
    for (int round = 0; round < 8 && S > -0.5; round++) {
        for (int i = 0; i < w->nrow; i++) {
            double width = w->row[i]->drawn_m, D = depth_of(width, travelled, S);
            double slope = 1.0 + S * (1.0 / fw_process_knudsen_slot(D / width) - 1.0);
            p[i] = 1.0 / slope;
            q[i] = -fw_process_arde_integral(width, D, false) / slope;
            y[i] = w->row[i]->value - D + p[i] * travelled + q[i] * S;
        }
        f = fw_process_fit_plane(y, s, p, q, w->nrow);
        travelled = f.value[0], S = f.value[1];
    }
    if (!(S > -2.0 * f.uncertainty[1]))
        return fw_process_coupon_wrong(w, w->row[0],
                                       "narrow slots came out deeper than wide ones: that is no "
                                       "lag of this law; check the order of the rows");
    double R = travelled / t, u = hypot(f.uncertainty[0] / t, R * u_t / t);
    const char *note = fw_arena_printf(w->arena, "from %d slots; correlation of rate and lag %d %%",
                                       w->nrow, (int)lround(100.0 * f.correlation));
    FW_NEED(note);
    FW_TRY(fw_process_coupon_give(w, "rie.R", R, u, &f, note));
    return fw_process_coupon_give(w, "rie.S", fmax(S, 0.0), f.uncertainty[1], &f, note);
}

const fw_process_coupon fw_process_coupon_slots = {"arde-slots", FW_DIM_LENGTH, false,
                                                   true,         true,          fit};
