/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An integration of small non-smooth systems that shares nothing with the program: long double,
   classical Runge-Kutta steps of fixed length, one flag that a value switches, each switch located
   by bisection on the length of the step that ends there. */
#ifndef FW_TEST_REFERENCE_H
#define FW_TEST_REFERENCE_H
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { REF_MOST = 4 };
typedef long double ref_real;

typedef struct ref {
    int n; /* components of the state */
    void (*rhs)(const struct ref *r, ref_real t, const ref_real *x, ref_real *dx);
    ref_real (*value)(const struct ref *r, ref_real t, const ref_real *x); /* > 0: on */
    const void *data;
    ref_real t, x[REF_MOST], h; /* h: longest step */
    bool on;
    long events;
} ref;

static inline void ref_step(const ref *r, ref_real h, ref_real *to) {
    ref_real k[4][REF_MOST], at[REF_MOST];
    static const ref_real part[4] = {0, 0.5L, 0.5L, 1};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < r->n; i++)
            at[i] = r->x[i] + (s ? part[s] * h * k[s - 1][i] : 0);
        r->rhs(r, r->t + part[s] * h, at, k[s]);
    }
    for (int i = 0; i < r->n; i++)
        to[i] = r->x[i] + h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static inline bool ref_fits(const ref *r, ref_real h, const ref_real *x) {
    ref_real value = r->value(r, r->t + h, x);
    return r->on ? value >= 0 : value <= 0;
}

static inline void ref_to(ref *r, ref_real end) {
    while (r->t < end) {
        ref_real h = fminl(r->h, end - r->t), to[REF_MOST], low = 0;
        bool last = h >= end - r->t;
        ref_step(r, h, to);
        if (!ref_fits(r, h, to)) {
            for (ref_real high = h; high - low > 1e-18L * (1 + r->t);) {
                ref_real middle = 0.5L * (low + high);
                ref_step(r, middle, to);
                if (ref_fits(r, middle, to))
                    low = middle;
                else
                    high = middle;
                h = high;
            }
            ref_step(r, h, to);
            r->on = !r->on, r->events++, last = false;
        }
        memcpy(r->x, to, sizeof to);
        r->t = last ? end : r->t + h;
    }
}

#endif
