/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weighted least squares of one or two parameters in closed form. Private to process/. */
#ifndef FW_PROCESS_COUPON_H
#define FW_PROCESS_COUPON_H
#include "process/calibrate.h"
#include "process/process_law.h"

typedef struct fw_process_fit {
    double value[2], uncertainty[2], correlation;
    double chi_square;
    int freedom;
} fw_process_fit;

/* mean of y (n) with standard uncertainties s (n) */
fw_process_fit fw_process_fit_mean(const double *y, const double *s, int n);
/* y = R x through the origin, both with errors: s_y, s_x (n; s_x may be 0) */
fw_process_fit fw_process_fit_ratio(const double *y, const double *s_y, const double *x,
                                    const double *s_x, int n);
/* y = a p + b q; s of y (n). value[0] = a. Needs n >= 2 and p, q not in proportion: else NaN */
fw_process_fit fw_process_fit_plane(const double *y, const double *s, const double *p,
                                    const double *q, int n);
/* probability of a chi square above x with n degrees of freedom; n 0: 1 */
double fw_process_chi_square_above(double x, int n);

/* Kinds of coupons: a file coupon_*.c and a line in coupons.def each. Private to process/. */

enum { FW_COUPON_ROWS = 200, FW_COUPON_RESULTS = 64, FW_COUPON_USED = 32, FW_COUPON_READ = 64 };

/* of a larger chi square: below, the data contradict */
#define FW_COUPON_LEAST_PROBABILITY 0.001

typedef struct fw_process_coupon_work { /* what a kind reads and fills */
    fw_arena *arena;
    const fw_process_flow *flow;
    const fw_process_measurement *measurement[FW_COUPON_ROWS]; /* (n) of this kind */
    int n;
    bool one_run;                       /* of the kind */
    const fw_process_calibrated *known; /* (nknown) of the kinds before it */
    int nknown;
    fw_process_calibrated *out; /* (nout) room for FW_COUPON_RESULTS in all */
    int nout;
    fw_diags *diags;
    const fw_quantity *used[FW_COUPON_USED]; /* (nused) of the flow, with their uncertainty */
    int nused;
    const fw_quantity *read[FW_COUPON_READ]; /* (nread) of the flow, by this kind, known or not */
    int nread;
    const fw_quantity *shifted; /* one of them, counted with this much more: process_calibrate.c */
    double shift;
} fw_process_coupon_work;

/* what there is to be read of a row's coupon, in the order of the flow (wafer_state.c): so many, up to FW_COUPON_STAGES */
enum { FW_COUPON_STAGES = 2 };
typedef int fw_process_coupon_stages(const fw_process_flow *flow, const fw_process_measurement *row,
                                     fw_process_coupon_stage *stage);
fw_process_coupon_stages
    fw_process_stages_of_edges, /* lines: the image in the resist, then the layer etched under it */
    fw_process_stages_of_etch,  /* of the etch that cuts the device layer */
    fw_process_stages_of_mask,  /* of what masks that etch, while it is there */
    fw_process_stages_of_release, /* of the release of the device */
    fw_process_stages_of_plating; /* of the step that plates */

typedef struct fw_process_coupon {
    const char *name;
    fw_quantity_dimension measured; /* of every row */
    bool any_measured;              /* ... or as the kind says */
    bool drawn, at;                 /* columns that it needs */
    bool one_run; /* what stands under `at` is the same, with one error, in all rows */
    fw_status (*fit)(fw_process_coupon_work *work);
    /* what a row must say, checked where it is written down too, since a line of a log cannot be taken back: one of these
       features (any: none is listed), and under `at` one of these (any: the first is a plain number) */
    const char *features[3];
    const char *
        features_said; /* how they go together, or what is measured where there are none; NULL: any one of them will do */
    const char *sides[2]; /* features that bound from either side, and say nothing alone */
    bool sides_measured;  /* ... with a value; else they are looked at */
    fw_quantity_dimension under[2];
    bool
        metered; /* what stands under `at` is told by one meter, with one error, in all rows of all such kinds */
    const char *mistaken; /* what is often taken for it; NULL */
    bool plain;           /* read on any wafer: stands on no test die */
    bool rate;            /* its feature is the id of a rate of the flow */
    bool of_mask; /* what the layer loses that masks the etch: no more than there is of it */
    fw_process_coupon_stages
        *stages; /* NULL: whenever it is read, what it was made under is said */
} fw_process_coupon;

/* coupon_plating.c: is what stands under `at` of the row told by the meter of all kinds, or of this one (of)? And the least
   relative uncertainty of any such row, which all have of the meter; 0: none states one */
bool fw_process_coupon_is_metered(const fw_process_measurement *row, const fw_process_coupon *of);
double fw_process_coupon_meter(const fw_process_measurement *row, int n,
                               const fw_process_coupon *of);

/* process_calibrate.c: covariance of the items of a calibration and, behind them, of the quantities of the flow that the
   coupons used (id and C are m and m m, made here). u (n): standard uncertainties of the rows; shared: errors of what the
   rows were measured under, and of the flow, too. SI */
typedef struct fw_process_covariance {
    const char **id;
    double *C;
    int m;
} fw_process_covariance;
fw_status fw_process_coupon_covariance(fw_arena *arena, const fw_process_flow *flow,
                                       const fw_process_measurement *measurement, int n,
                                       const fw_process_calibration *found, const double *u,
                                       bool shared, fw_process_covariance *out);
/* coupon_fit.c: one more, unless it is there */
fw_status fw_process_calibration_with(fw_arena *arena, fw_process_calibration *calibration,
                                      const fw_process_found_with *with);
/* coupon_fit.c: adds to a result of one wafer what the flow has for how the next one differs, and says so; `who` says so little:
   "of one wafer" */
fw_status fw_process_calibrated_spread(fw_arena *arena, const fw_process_flow *flow,
                                       const char *who, fw_process_calibrated *c);
/* measurable.c: the same to a value of a pack that calibrate wrote before `spread` was, of one wafer or of a table; and what share of
   such a value's uncertainty was read, by which its correlations count: r_ij f_i f_j. Of all other values 1 */
fw_status fw_process_lab_keep_spread(fw_arena *arena, const fw_process_flow *flow, const char *id,
                                     fw_quantity *q);
double fw_process_lab_read_part(const fw_quantity *q);
/* what its readings alone are uncertain by */
double fw_process_calibrated_read_u(const fw_process_calibrated *c);
/* process_calibrate.c: the correlations of those ids that are correlated at all, into `calibration` */
fw_status fw_process_coupon_joint(fw_arena *arena, const fw_process_covariance *of,
                                  const double *deviation, fw_process_calibration *calibration);

/* process_table.c: can errors be correlated like this? r (n n), L (n n) is used */
bool fw_process_correlation_possible(const double *r, int n, double *L);

#define FW_PROCESS_COUPON(name) extern const fw_process_coupon fw_process_coupon_##name;
#include "process/coupons.def"
#undef FW_PROCESS_COUPON

/* ---- for the kinds: coupon_fit.c ---- */
/* a result, tested: FW-D212 and FW_INPUT where chi square is too large. Several kinds may give the
   same id: they are joined afterwards. freedom and chi_square of `fit`. */
fw_status fw_process_coupon_give(fw_process_coupon_work *work, const char *id, double value,
                                 double uncertainty, const fw_process_fit *fit, const char *note);
/* FW-D211 at the row */
fw_status fw_process_coupon_wrong(fw_process_coupon_work *work, const fw_process_measurement *at,
                                  const char *format, ...) __attribute__((format(printf, 3, 4)));
/* what a kind before this one found, else the flow's own; false: neither is known. uncertainty NULL: it is taken as
   exact */
bool fw_process_coupon_value(fw_process_coupon_work *work, const char *id, double *value,
                             double *uncertainty);
/* the result follows from that quantity of the flow, too; NULL: from none */
void fw_process_coupon_note_read(fw_process_coupon_work *work, const fw_quantity *q);
typedef struct fw_process_coupon_speed { /* what the conditions do to a rate */
    double factor;      /* of the rate, against that at the reference values of its law */
    double uncertainty; /* of it, relative: of the law's inputs and of the conditions */
} fw_process_coupon_speed;
/* of the rate `id` where the row was etched; 1 and 0 where its law knows of no condition, or the row says none */
fw_status fw_process_coupon_sped(fw_process_coupon_work *work, const char *id,
                                 const fw_process_measurement *row, fw_process_coupon_speed *speed);
/* how many times as fast a rate is there as at the reference value of the step that corrects it */
fw_status fw_process_step_speed(fw_process_coupon_work *work, const fw_process_step *step,
                                fw_process_condition which, double at, double *factor);
/* the name of the argument that has the reference value */
const char *fw_process_condition_reference(fw_process_condition which);
/* the kind of that name; NULL: none */
const fw_process_coupon *fw_process_coupon_kind(const char *name);
/* says of a what both say of the conditions that they were measured at: coupon_fit.c */
void fw_process_calibrated_join(fw_process_calibrated *a, const fw_process_calibrated *b);
/* the first step of the flow that corrects the rate for that; NULL: none does */
const fw_process_step *fw_process_flow_corrects(const fw_process_flow *flow,
                                                fw_process_condition which, const char *rate);
typedef struct fw_process_coupon_lacking {  /* what a step lacks to correct a rate */
    const fw_process_step *step;            /* NULL: none would */
    const fw_quantity *q[FW_LAW_ARGUMENTS]; /* (n) */
    int n;
} fw_process_coupon_lacking;
fw_process_coupon_lacking fw_process_coupon_lacks(const fw_process_flow *flow,
                                                  fw_process_condition which, const char *rate);
/* all rows stand under one condition of dimension d, which is set; FW-D211 otherwise */
fw_status fw_process_coupon_condition(fw_process_coupon_work *work, fw_quantity_dimension d,
                                      const char *what, double *value, double *uncertainty);
typedef struct
    fw_process_etch { /* quantities of the etch that cuts the device layer; each may be NULL */
    const fw_quantity *rate, *lag, *anisotropy;
    const fw_quantity *selectivity; /* to what masks it */
    const fw_quantity *mask;        /* thickness of that, as it was put there; NULL: not known */
    const fw_quantity *over_etch;
} fw_process_etch;
/* of the step that removes the flow's own material in a direction */
fw_process_etch fw_process_flow_etch(const fw_process_flow *flow);
typedef struct
    fw_process_plating { /* quantities of a step that plates by its charge; each may be NULL */
    const fw_quantity *thickness, *density, *valence, *molar_mass;
    const fw_quantity *efficiency; /* with an id; NULL: there is no such step */
    const char *material;
    const char *made; /* id of how thick the device comes out, where it plates that; NULL */
} fw_process_plating;
/* the one whose efficiency is called so, else that of the flow's own material, else the first */
fw_process_plating fw_process_flow_plating(const fw_process_flow *flow, const char *efficiency);
/* id of the edge that lines of the mask layer read: of the layer that was etched under the resist, or the printed one */
const char *fw_process_coupon_edge(const fw_process_flow *flow);
/* how far the edges of the layer that masks the etch stand outside of the drawn ones, m, as the flow plans it or the coupons
   before found: printed, less what isotropic etches take */
void fw_process_coupon_mask_edge(fw_process_coupon_work *work, double *edge_m,
                                 double *uncertainty_m);
/* what isotropic masked etches take from every edge on the way, and the mask adds: m. What it follows from is noted for
   the coupon; NULL: for none */
double fw_process_coupon_loss(const fw_process_flow *flow, fw_process_coupon_work *work);

#endif
