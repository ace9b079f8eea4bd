/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of coupons: one file and one row in process_calibrate.c each. Private to process/. */
#ifndef FW_PROCESS_COUPON_H
#define FW_PROCESS_COUPON_H
#include "process/calibrate.h"
#include "process/fit.h"
#include "process/process_law.h"

enum { FW_COUPON_ROWS = 200, FW_COUPON_RESULTS = 64 };

typedef struct fw_process_coupon_work { /* what a kind reads and fills */
    fw_arena *arena;
    const fw_process_flow *flow;
    const fw_process_measurement *row[FW_COUPON_ROWS]; /* (nrow) of this kind */
    int nrow;
    const fw_process_calibrated *known; /* (nknown) of the kinds before it */
    int nknown;
    fw_process_calibrated *out; /* (nout) room for FW_COUPON_RESULTS in all */
    int nout;
    fw_diags *diags;
} fw_process_coupon_work;

typedef struct fw_process_coupon {
    const char *name;
    fw_quantity_dimension measured; /* of every row */
    bool any_measured;              /* ... or as the kind says */
    bool drawn, at;                 /* columns that it needs */
    fw_status (*fit)(fw_process_coupon_work *work);
} fw_process_coupon;

extern const fw_process_coupon fw_process_coupon_cd_lines, fw_process_coupon_etch_rate,
    fw_process_coupon_slots, fw_process_coupon_ladder, fw_process_coupon_step,
    fw_process_coupon_mass, fw_process_coupon_pads, fw_process_coupon_spin;

/* a result, tested: FW-D212 and FW_INPUT where chi square is too large. Several kinds may give the
   same id: they are joined afterwards. freedom and chi_square of `fit`. */
fw_status fw_process_coupon_give(fw_process_coupon_work *work, const char *id, double value,
                                 double uncertainty, const fw_process_fit *fit, const char *note);
/* FW-D211 at the row */
fw_status fw_process_coupon_wrong(fw_process_coupon_work *work, const fw_process_measurement *row,
                                  const char *format, ...) __attribute__((format(printf, 3, 4)));
/* what a kind before this one found, else the flow's own; false: neither is known */
bool fw_process_coupon_value(const fw_process_coupon_work *work, const char *id, double *value,
                             double *uncertainty);
/* all rows stand under one condition of dimension d, which is set; FW-D211 otherwise */
fw_status fw_process_coupon_condition(fw_process_coupon_work *work, fw_quantity_dimension d,
                                      const char *what, double *value, double *uncertainty);
bool fw_process_coupon_has(const fw_process_flow *flow, const char *id);
/* what isotropic masked etches take from every edge on the way, and the mask adds: m */
double fw_process_coupon_loss(const fw_process_flow *flow);

#endif
