/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mass that falls on a damped contact again and again, in closed form, in long double.

   g overlap (m), downwards, G the fall (m/s^2). In flight g'' = G; in touch m g'' = m G - k g - c
   g' about g_s = m G/k: with a = c/2m, w2 = k/m - a^2, p = g - g_s at its start, g = g_s + e^(-a s)
   (p C + (v + a p) S),  C = cos ws, S = sin ws/w  (cosh, sinh where w2 < 0). It takes hold where g
   = 0 comes back (or, when it never left, where k g + c g' is 0 again) and lets go at k g + c g' =
   0; both by bisection of the closed form. Source: the damped oscillator. */
#ifndef FW_TEST_BOUNCE_H
#define FW_TEST_BOUNCE_H
#include <math.h>
#include <stdbool.h>

typedef struct bounce {
    double m, k, c, fall, g0, v0; /* overlap and its rate at the start */
    double sign, offset;          /* component = offset + sign g */
    long double t, g, v;          /* of the present phase's start */
    bool on;
    long double end; /* of the present phase; infinite: it rests */
    long count;
} bounce;

static inline long double bounce_w2(const bounce *b) {
    long double a = (long double)b->c / (2 * (long double)b->m);
    return (long double)b->k / (long double)b->m - a * a;
}

static inline void bounce_state(const bounce *b, long double s, long double *g, long double *v) {
    long double fall = (long double)b->fall, m = (long double)b->m;
    if (!b->on) {
        *g = b->g + s * (b->v + 0.5L * fall * s), *v = b->v + fall * s;
        return;
    }
    long double a = (long double)b->c / (2 * m), still = m * fall / (long double)b->k;
    long double w2 = bounce_w2(b), w = sqrtl(fabsl(w2)), p = b->g - still;
    long double cosine =
        w2 > 0 ? expl(-a * s) * cosl(w * s) : (expl((w - a) * s) + expl(-(w + a) * s)) / 2;
    long double sine = w2 > 0 ? expl(-a * s) * sinl(w * s) / w
                              : (expl((w - a) * s) - expl(-(w + a) * s)) / (2 * w);
    *g = still + p * cosine + (b->v + a * p) * sine;
    *v = b->v * cosine - (p * w2 + a * (b->v + a * p)) * sine;
}

static inline long double bounce_push(const bounce *b, long double s) {
    long double g, v;
    bounce_state(b, s, &g, &v);
    return (long double)b->k * g + (long double)b->c * v;
}

/* zero of the push in (low, high), of opposite signs there */
static inline long double bounce_zero(const bounce *b, long double low, long double high) {
    bool up = bounce_push(b, high) > 0;
    for (int i = 0; i < 200; i++) {
        long double middle = 0.5L * (low + high);
        if ((bounce_push(b, middle) > 0) == up)
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* how long the phase that begins now lasts; infinite: for good */
static inline long double bounce_lasts(const bounce *b) {
    long double fall = (long double)b->fall;
    if (!b->on) {
        long double top = b->g - b->v * b->v / (2 * fall), back = -b->v / fall;
        if (b->v > 0 || top < 0) /* through g = 0 downwards */
            return back + sqrtl(fmaxl(0, back * back - 2 * b->g / fall));
        return bounce_zero(b, fmaxl(0, back - (long double)b->c / (long double)b->k), 1e3L);
    }
    /* push - m G = e^(-a t) (P cos + Q sin): least half a period behind its largest */
    long double step = 1e-3L / sqrtl(fabsl(bounce_w2(b))), s = 0;
    long double now = bounce_push(b, 0), next;
    while ((next = bounce_push(b, s + step)) >= now)
        s += step, now = next;
    long double high = s;
    while ((next = bounce_push(b, high + step)) < now)
        high += step, now = next;
    return now > 0 ? (long double)INFINITY : bounce_zero(b, s, high);
}

static inline void bounce_again(void *exact) {
    bounce *b = exact;
    b->t = 0, b->g = (long double)b->g0, b->v = (long double)b->v0, b->on = false, b->count = 0;
    b->end = bounce_lasts(b);
}

static inline void bounce_next(bounce *b) {
    long double g, v;
    bounce_state(b, b->end - b->t, &g, &v);
    b->g = g, b->v = v, b->t = b->end, b->on = !b->on, b->count++;
    b->end = b->t + bounce_lasts(b);
}

/* the component at t; t ascending */
static inline double bounce_at(void *exact, double t) {
    bounce *b = exact;
    while (b->end < (long double)t)
        bounce_next(b);
    long double g, v;
    bounce_state(b, (long double)t - b->t, &g, &v);
    return b->offset + b->sign * (double)g;
}

static inline long bounce_events(void *exact) {
    return ((const bounce *)exact)->count;
}

#endif
