/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include "base/constants.h"
#include <math.h>

static fw_status need(fw_process_coupon_work *w, const char *id, double *value) {
    double u;
    if (fw_process_coupon_value(w, id, value, &u)) return FW_OK;
    return fw_process_coupon_wrong(w, w->row[0], "%s is not known in this flow", id);
}

/* Mass m of a deposit for a charge Q: eta = m n F/(M Q), through the origin over several runs. m
   kg, Q A s, M kg/mol; eta 1. Source: Faraday's law. Test: test_calibrate.c. */
static fw_status by_mass(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS], n, M;
    FW_TRY(need(w, "cu.n", &n));
    FW_TRY(need(w, "cu.M", &M));
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        if (!fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_CHARGE) ||
            !(r->at > 0.0))
            return fw_process_coupon_wrong(
                w, r,
                "plating-mass needs the charge in the columns at, u_at and "
                "at_unit");
        y[i] = r->value * n * FW_FARADAY_C_PER_mol / M,
        sy[i] = r->uncertainty * n * FW_FARADAY_C_PER_mol / M;
        x[i] = r->at, sx[i] = r->at_uncertainty;
    }
    fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, w->nrow);
    if (f.value[0] > 1.0 + 3.0 * f.uncertainty[0])
        return fw_process_coupon_wrong(w, w->row[0],
                                       "more copper than the charge can deposit: check mass, "
                                       "charge and units");
    return fw_process_coupon_give(w, "cu.eta", f.value[0], f.uncertainty[0], &f,
                                  "mass over charge");
}

/* rows with a pad of the least (or largest) sizes */
static int pads_of(const fw_process_coupon_work *w, bool wide, double size_m, double *y,
                   double *s) {
    int n = 0;
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        if (wide ? r->drawn_m < size_m : r->drawn_m > size_m) continue;
        y[n] = r->value, s[n++] = r->uncertainty;
    }
    return n;
}

/* Thickness of pads of several widths, one run of charge q per area: the widest ones give
   eta = d n F rho/(M q), and those up to 30 um, as wide as flexures, the factor f =
   d_narrow/d_wide: what is plated to cu.d on average is f cu.d there, which is made.cu. d m, q A
   s/m2, rho kg/m3; eta, f 1. Both groups are tested on their own. Source: Faraday's law. Test:
   test_calibrate.c. */
static fw_status by_pads(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], q, u_q, n, M, rho, widest = 0.0, d = 0.0, u_d;
    FW_TRY(need(w, "cu.n", &n));
    FW_TRY(need(w, "cu.M", &M));
    FW_TRY(need(w, "cu.rho", &rho));
    FW_TRY(fw_process_coupon_condition(w, (fw_quantity_dimension)FW_DIM(-2, 0, 1, 1, 0, 0, 0),
                                       "the charge per area", &q, &u_q));
    for (int i = 0; i < w->nrow; i++)
        widest = fmax(widest, w->row[i]->drawn_m);
    fw_process_fit wide = fw_process_fit_mean(y, s, pads_of(w, true, widest * (1.0 - 1e-9), y, s));
    double eta = wide.value[0] * n * FW_FARADAY_C_PER_mol * rho / (M * q);
    double u_wide = wide.uncertainty[0] / wide.value[0], u = eta * hypot(u_wide, u_q / q);
    if (eta > 1.0 + 3.0 * u)
        return fw_process_coupon_wrong(w, w->row[0],
                                       "more copper than the charge can deposit: check "
                                       "thickness, charge per area and units");
    FW_TRY(fw_process_coupon_give(w, "cu.eta", eta, u, &wide,
                                  "thickness of the widest pads over charge"));
    int narrow = pads_of(w, false, 30.0e-6 * (1.0 + 1e-9), y, s);
    if (narrow == 0 || widest < 100.0e-6 || !fw_process_coupon_value(w, "cu.d", &d, &u_d))
        return FW_OK;
    fw_process_fit thin = fw_process_fit_mean(y, s, narrow);
    double f = thin.value[0] / wide.value[0];
    const char *note = fw_arena_printf(
        w->arena, "pads up to 30 um are %d permille as thick as the widest; that times cu.d",
        (int)lround(1000.0 * f));
    FW_NEED(note);
    return fw_process_coupon_give(w, "made.cu", f * d,
                                  f * d * hypot(thin.uncertainty[0] / thin.value[0], u_wide), &thin,
                                  note);
}

const fw_process_coupon fw_process_coupon_mass = {"plating-mass", FW_DIM_MASS, false,
                                                  false,          true,        by_mass};
const fw_process_coupon fw_process_coupon_pads = {"plating-pads", FW_DIM_LENGTH, false,
                                                  true,           true,          by_pads};
