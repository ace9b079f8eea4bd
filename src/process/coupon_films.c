/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coupons of printing, resist and plating: lines and spaces, thickness over spin speed, mass and
   pads of copper. */
#include "process/coupon.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

/* ---- printed lines and spaces ---- */

/* Lines and spaces of known width on the mask, not compensated, measured on the wafer: every edge
   stands out by e = (m - w)/2, of a space by (w - m)/2. m, w, e m. Where the flow etches a mask
   layer sideways by L = sum d (1 + overrun), made.al-edge = e + L is what is left of it; else e is
   litho.edge. Weighted mean; residuals are tested. Source: geometry. Test: test_calibrate.c. */
static fw_status fit_lines(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], loss = fw_process_coupon_loss(w->flow);
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        bool space = strcmp(r->feature, "space") == 0;
        y[i] = (space ? -0.5 : 0.5) * (r->value - r->drawn_m);
        s[i] = 0.5 * r->uncertainty;
    }
    fw_process_fit f = fw_process_fit_mean(y, s, w->n);
    const char *edge = fw_process_coupon_edge(w->flow);
    bool etched = strcmp(edge, FW_PROCESS_PRINTED_EDGE) != 0;
    return fw_process_coupon_give(
        w, edge, f.value[0] + (etched ? loss : 0.0), f.uncertainty[0], &f,
        etched ? "edge in the aluminium against the mask, and what the wet etch is "
                 "planned to take; the printed edge is in it"
               : "edge on the wafer against the mask");
}

const fw_process_coupon fw_process_coupon_cd_lines = {
    "cd-lines", FW_DIM_LENGTH, false, true, false, false, fit_lines, .features = {"line", "space"}};

/* ---- resist over spin speed ---- */

/* Resist of thickness d at speed w: ln d = ln d0 - a ln(w/w0), w0 the reference speed of the pack.
   Two parameters in closed form; the error of the speed counts with a, which is iterated. d, d0 m;
   w rad/s; a 1. Source: docs/theory/calibrate.md. Test: test_calibrate.c. */
static fw_status fit_spin(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], one[FW_COUPON_ROWS], x[FW_COUPON_ROWS], w0;
    if (!fw_process_coupon_value(w, "resist.w0", &w0, NULL))
        return fw_process_coupon_wrong(
            w, w->measurement[0],
            "resist.w0 is not known in this flow; enter it in a laboratory pack");
    fw_process_fit f = {.value = {0.0, 0.5}};
    for (int round = 0; round < 6; round++) {
        for (int i = 0; i < w->n; i++) {
            const fw_process_measurement *r = w->measurement[i];
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
        f = fw_process_fit_plane(y, s, one, x, w->n);
        if (w->n < 2 || !isfinite(f.value[1]))
            return fw_process_coupon_wrong(w, w->measurement[0], "spin needs two speeds or more");
    }
    if (!(f.value[1] > 0.0))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "the resist is thicker at higher speed: check the rows");
    double d0 = exp(f.value[0]);
    const char *note = fw_arena_printf(w->arena,
                                       "from %d coats; correlation of thickness and exponent "
                                       "%d %%",
                                       w->n, (int)lround(100.0 * f.correlation));
    FW_NEED(note);
    FW_TRY(fw_process_coupon_give(w, "resist.d0", d0, d0 * f.uncertainty[0], &f, note));
    return fw_process_coupon_give(w, "resist.a", f.value[1], f.uncertainty[1], &f, note);
}

const fw_process_coupon fw_process_coupon_spin = {
    "spin", FW_DIM_LENGTH, false, false, true, false, fit_spin, .under = {FW_DIM_ROTATION}};

/* ---- plating ---- */

static fw_status need(fw_process_coupon_work *w, const char *id, double *value) {
    if (fw_process_coupon_value(w, id, value, NULL)) return FW_OK;
    return fw_process_coupon_wrong(
        w, w->measurement[0], "%s is not known in this flow; enter it in a laboratory pack", id);
}

/* Mass m of a deposit for a charge Q: eta = m n F/(M Q), through the origin over several runs. m
   kg, Q A s, M kg/mol; eta 1. Source: Faraday's law. Test: test_calibrate.c. */
static fw_status by_mass(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS], n, M;
    FW_TRY(need(w, "cu.n", &n));
    FW_TRY(need(w, "cu.M", &M));
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
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
    fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, w->n);
    if (f.value[0] > 1.0 + 3.0 * f.uncertainty[0])
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "more copper than the charge can deposit: check mass, "
                                       "charge and units");
    return fw_process_coupon_give(w, "cu.eta", f.value[0], f.uncertainty[0], &f,
                                  "mass over charge");
}

/* rows with a pad of the least (or largest) sizes */
static int pads_of(const fw_process_coupon_work *w, bool wide, double size_m, double *y,
                   double *s) {
    int n = 0;
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
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
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], q, u_q, n, M, rho, widest = 0.0, d = 0.0;
    FW_TRY(need(w, "cu.n", &n));
    FW_TRY(need(w, "cu.M", &M));
    FW_TRY(need(w, "cu.rho", &rho));
    FW_TRY(fw_process_coupon_condition(w, (fw_quantity_dimension)FW_DIM(-2, 0, 1, 1, 0, 0, 0),
                                       "the charge per area", &q, &u_q));
    for (int i = 0; i < w->n; i++)
        widest = fmax(widest, w->measurement[i]->drawn_m);
    fw_process_fit wide = fw_process_fit_mean(y, s, pads_of(w, true, widest * (1.0 - 1e-9), y, s));
    double eta = wide.value[0] * n * FW_FARADAY_C_PER_mol * rho / (M * q);
    double u_wide = wide.uncertainty[0] / wide.value[0], u = eta * hypot(u_wide, u_q / q);
    if (eta > 1.0 + 3.0 * u)
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "more copper than the charge can deposit: check "
                                       "thickness, charge per area and units");
    FW_TRY(fw_process_coupon_give(w, "cu.eta", eta, u, &wide,
                                  "thickness of the widest pads over charge"));
    int narrow = pads_of(w, false, 30.0e-6 * (1.0 + 1e-9), y, s);
    if (narrow == 0 || widest < 100.0e-6 || !fw_process_coupon_value(w, "cu.d", &d, NULL))
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

const fw_process_coupon fw_process_coupon_mass = {
    "plating-mass", FW_DIM_MASS, false, false, true, false, by_mass, .under = {FW_DIM_CHARGE}};
const fw_process_coupon fw_process_coupon_pads = {
    "plating-pads", FW_DIM_LENGTH, false,   true,
    true,           true,          by_pads, .under = {FW_DIM(-2, 0, 1, 1, 0, 0, 0)}};
