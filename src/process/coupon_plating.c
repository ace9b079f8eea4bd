/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of coupons of plating: the mass of what is plated, and pads of several widths. */
#include "base/constants.h"
#include "process/coupon.h"
#include <math.h>
#include <string.h>

static fw_status need(fw_process_coupon_work *w, const fw_quantity *q, const char *what,
                      double *value) {
    const char *id = q && q->id ? q->id : what;
    *value = q ? q->value : 0.0; /* of a number that stands in the step itself */
    if (q && (q->id ? fw_process_coupon_value(w, q->id, value, NULL) : !q->unknown)) return FW_OK;
    return fw_process_coupon_wrong(
        w, w->measurement[0], "%s is not known in this flow; enter it in a laboratory pack", id);
}

/* the plating that the rows are of, and n F/M of its metal; what its efficiency is called tells one of several */
static fw_status plating_of(fw_process_coupon_work *w, fw_process_plating *of, double *C_per_kg) {
    const fw_process_measurement *r = w->measurement[0];
    double n, M;
    *of = fw_process_flow_plating(w->flow, r->feature);
    if (!of->efficiency)
        return fw_process_coupon_wrong(w, r,
                                       "flow '%s' has no step that plates by its charge (law "
                                       "faraday, with an efficiency), which %s reads; take the "
                                       "rows out",
                                       w->flow->id, r->coupon);
    FW_TRY(need(w, of->valence, "the valence", &n));
    FW_TRY(need(w, of->molar_mass, "the molar mass", &M));
    *C_per_kg = n * FW_FARADAY_C_PER_mol / M;
    return FW_OK;
}

static fw_status too_much(fw_process_coupon_work *w, const fw_process_plating *of,
                          const char *check) {
    return fw_process_coupon_wrong(w, w->measurement[0],
                                   "more than the charge can deposit of %s: check %s",
                                   fw_process_flow_material_name(w->flow, of->material), check);
}

bool fw_process_coupon_is_metered(const fw_process_measurement *r, const fw_process_coupon *of) {
    static const fw_process_coupon *const own[] = {&fw_process_coupon_mass,
                                                   &fw_process_coupon_pads};
    bool known = false;
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        known = known || ((!of || of == own[i]) && strcmp(r->coupon, own[i]->name) == 0);
    return known && r->at > 0.0 && r->at_uncertainty > 0.0;
}

double fw_process_coupon_meter(const fw_process_measurement *row, int n,
                               const fw_process_coupon *of) {
    double least = (double)INFINITY;
    for (int i = 0; i < n; i++)
        if (fw_process_coupon_is_metered(&row[i], of))
            least = fmin(least, row[i].at_uncertainty / row[i].at);
    return isfinite(least) ? least : 0.0;
}

/* Mass m of a deposit for a charge Q: eta = m n F/(M Q), through the origin over several runs. One meter tells all charges:
   what it is off by, s = least u_Q/Q, is no scatter, and comes on top. m kg, Q A s, M kg/mol; eta, s 1. Source: Faraday's
   law. Test: test_calibrate.c coverage, charges_of_one_meter. */
static fw_status by_mass(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS], per;
    fw_process_plating of;
    FW_TRY(plating_of(w, &of, &per));
    double shared = 0.0;
    for (int i = 0; i < w->n; i++) {
        const double of_row = fw_process_coupon_meter(w->measurement[i], 1, NULL);
        if (of_row > 0.0 && (shared == 0.0 || of_row < shared)) shared = of_row;
    }
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (!fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_CHARGE) ||
            !(r->at > 0.0))
            return fw_process_coupon_wrong(
                w, r,
                "plating-mass needs the charge in the columns at, u_at and "
                "at_unit");
        y[i] = r->value * per, sy[i] = r->uncertainty * per;
        x[i] = r->at;
        sx[i] = sqrt(fmax(pow(r->at_uncertainty, 2.0) - pow(shared * r->at, 2.0), 0.0));
    }
    fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, w->n);
    const double u = hypot(f.uncertainty[0], f.value[0] * shared);
    if (f.value[0] > 1.0 + 3.0 * u) return too_much(w, &of, "mass, charge and units");
    return fw_process_coupon_give(w, of.efficiency->id, f.value[0], u, &f, "mass over charge");
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
   d_narrow/d_wide: what is plated to d on average is f d there. The flow's corner of the thickness has f itself (made.cu
   of the copper flow), whatever d is planned, or f d where it is a length. d m, q A s/m2, rho kg/m3; eta, f 1. Both groups are tested on their own. Source:
   Faraday's law. Test: test_calibrate.c. */
static fw_status by_pads(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], q, u_q, per, rho, widest = 0.0, d = 1.0;
    fw_process_plating of;
    FW_TRY(plating_of(w, &of, &per));
    FW_TRY(need(w, of.density, "the density", &rho));
    FW_TRY(fw_process_coupon_condition(w, (fw_quantity_dimension)FW_DIM(-2, 0, 1, 1, 0, 0, 0),
                                       "the charge per area", &q, &u_q));
    for (int i = 0; i < w->n; i++)
        widest = fmax(widest, w->measurement[i]->drawn_m);
    fw_process_fit wide = fw_process_fit_mean(y, s, pads_of(w, true, widest * (1.0 - 1e-9), y, s));
    double eta = wide.value[0] * per * rho / q;
    double u_wide = wide.uncertainty[0] / wide.value[0], u = eta * hypot(u_wide, u_q / q);
    if (eta > 1.0 + 3.0 * u) return too_much(w, &of, "thickness, charge per area and units");
    FW_TRY(fw_process_coupon_give(w, of.efficiency->id, eta, u, &wide,
                                  "thickness of the widest pads over charge"));
    int narrow = pads_of(w, false, 30.0e-6 * (1.0 + 1e-9), y, s);
    const bool share =
        of.made &&
        fw_process_corner_is_share(FW_CORNER_THICKNESS, fw_process_flow_quantity(w->flow, of.made));
    if (narrow == 0 || widest < 100.0e-6 || !of.made ||
        (!share && (!of.thickness || !of.thickness->id ||
                    !fw_process_coupon_value(w, of.thickness->id, &d, NULL))))
        return FW_OK;
    fw_process_fit thin = fw_process_fit_mean(y, s, narrow);
    double f = thin.value[0] / wide.value[0];
    const char *note = fw_arena_printf(
        w->arena, "pads up to 30 um are %d permille as thick as the widest%s%s",
        (int)lround(1000.0 * f), share ? "" : "; that times ", share ? "" : of.thickness->id);
    FW_NEED(note);
    return fw_process_coupon_give(
        w, of.made, f * d, f * d * hypot(thin.uncertainty[0] / thin.value[0], u_wide), &thin, note);
}

const fw_process_coupon fw_process_coupon_mass = {
    "plating-mass",           FW_DIM_MASS,   false,          false, true, false, by_mass,
    .under = {FW_DIM_CHARGE}, .plain = true, .metered = true};
const fw_process_coupon fw_process_coupon_pads = {"plating-pads",
                                                  FW_DIM_LENGTH,
                                                  false,
                                                  true,
                                                  true,
                                                  true,
                                                  by_pads,
                                                  .under = {FW_DIM(-2, 0, 1, 1, 0, 0, 0)},
                                                  .metered = true,
                                                  .stages = fw_process_stages_of_plating};
