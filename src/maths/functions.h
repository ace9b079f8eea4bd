/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distribution functions and their inverses, and the root in a bracket by which an inverse is found; cycles of a
   history. */
#ifndef FW_MATHS_FUNCTIONS_H
#define FW_MATHS_FUNCTIONS_H
#include "base/arena.h"
#include <stdbool.h>
#include <stddef.h>

/* ---- roots ---- */

typedef double fw_function(const void *context, double x);

/* x in [a, b] with f(x) = 0 to within `tolerance` + 4 eps |x|; f(a) and f(b) must differ in sign,
   or one be 0, else NaN */
double fw_maths_brent_root(fw_function *f, const void *context, double a, double b,
                           double tolerance);

/* ---- distributions ---- */

double fw_maths_normal_density(double u);
double fw_maths_normal_cdf(double u);
double fw_maths_normal_quantile(double p);
double fw_maths_normal_upper(double q);
double fw_maths_gamma_quantile(double p, double shape);
double fw_maths_beta_quantile(double p, double a, double b);

/* Student's t, for means of few readings */
double fw_maths_student_quantile(double p, double n);

/* ---- cycles of a history, for fatigue: turning points on the fly, rainflow counting behind ---- */

typedef struct fw_maths_cycle {
    double range, mean, count; /* peak to valley; middle; 1 or 0.5 */
} fw_maths_cycle;

typedef struct fw_maths_turning { /* turning points of a history that comes sample by sample */
    double gate;                  /* turns smaller than this are none */
    double *value;                /* (count) */
    size_t count, room;
    double latest;     /* extreme since the last turning point */
    int direction;     /* +1 rising, -1 falling, 0: nothing yet */
    double t[2], s[2]; /* the last two samples */
    int samples;
    bool failed; /* no memory */
} fw_maths_turning;

void fw_maths_turning_add(fw_maths_turning *turning, fw_arena *arena, double t, double value);
void fw_maths_turning_jump(fw_maths_turning *turning); /* no parabola across what comes next */
void fw_maths_turning_end(fw_maths_turning *turning, fw_arena *arena);

/* of n turning points; cycle (n) and work (n) are the caller's; returns the number of cycles */
size_t fw_maths_rainflow(const double *turn, size_t n, double *work, fw_maths_cycle *cycle);
/* of n turning points that come again and again: whole cycles only. work (2n + 1), cycle (n + 1) */
size_t fw_maths_rainflow_repeating(const double *turn, size_t n, double *work,
                                   fw_maths_cycle *cycle);

/* ---- the GNU Scientific Library ---- */

/* GSL answers by statuses and NaN from here on: its own handler of errors would end the process. It is one for the
   process, and designs run in parallel: it is written once */
void fw_maths_gsl_quiet(void);

#endif
