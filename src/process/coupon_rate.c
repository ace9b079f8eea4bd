/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include <math.h>
#include <string.h>

/* the rows of one feature, as y = R x */
static int collect(const fw_process_coupon_work *w, const char *feature, double *y, double *sy,
                   double *x, double *sx) {
    int n = 0;
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        if (strcmp(r->feature, feature) != 0) continue;
        y[n] = r->value, sy[n] = r->uncertainty;
        x[n] = r->at, sx[n++] = r->at_uncertainty;
    }
    return n;
}

static bool first_of(const fw_process_coupon_work *w, int i) {
    for (int k = 0; k < i; k++)
        if (strcmp(w->row[k]->feature, w->row[i]->feature) == 0) return false;
    return true;
}

/* Depth or thickness d after a time t, R = d/t through the origin, both with errors. The feature is
   the id of the rate in the pack: pan.R, rie.R, al.R, seed.R, release.R. d m, t s, R m/s. Test:
   test_calibrate.c. */
static fw_status rates(fw_process_coupon_work *w) {
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        const fw_quantity *q = fw_process_flow_quantity(w->flow, r->feature);
        if (!q || !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_SPEED))
            return fw_process_coupon_wrong(
                w, r,
                "the feature of etch-rate is the id of a rate of flow '%s', "
                "for example pan.R; '%s' is none",
                w->flow->id, r->feature);
        if (!fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_TIME) ||
            !(r->at > 0.0))
            return fw_process_coupon_wrong(
                w, r, "a rate needs its time in the columns at, u_at and at_unit");
        if (!first_of(w, i)) continue;
        double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS];
        fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, collect(w, r->feature, y, sy, x, sx));
        FW_TRY(fw_process_coupon_give(w, r->feature, f.value[0], f.uncertainty[0], &f,
                                      "depth over time, through the origin"));
    }
    return FW_OK;
}

/* Selectivity S_m = D/a: what is etched over what the mask loses, a measured at D. Through the
   origin as a = D/S_m. D, a m. Test: test_calibrate.c. */
static fw_status selectivity(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS];
    for (int i = 0; i < w->nrow; i++) {
        const fw_process_measurement *r = w->row[i];
        if (!fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_LENGTH) ||
            !(r->at > 0.0))
            return fw_process_coupon_wrong(
                w, r,
                "al-step needs the etched depth in the columns at, u_at and "
                "at_unit");
        y[i] = r->value, sy[i] = r->uncertainty, x[i] = r->at, sx[i] = r->at_uncertainty;
    }
    fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, w->nrow);
    double loss = f.value[0], u = f.uncertainty[0];
    if (!(loss > 3.0 * u))
        return fw_process_coupon_wrong(w, w->row[0],
                                       "the loss of the mask is not above its uncertainty: no "
                                       "selectivity comes of it");
    return fw_process_coupon_give(w, "rie.selectivity", 1.0 / loss, u / (loss * loss), &f,
                                  "etched depth over the loss of the mask");
}

const fw_process_coupon fw_process_coupon_etch_rate = {"etch-rate", FW_DIM_LENGTH, false,
                                                       false,       true,          rates};
const fw_process_coupon fw_process_coupon_step = {"al-step", FW_DIM_LENGTH, false,
                                                  false,     true,          selectivity};
