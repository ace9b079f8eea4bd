/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a hinge's axis drifts, and where its conjugate surfaces meet. Theory:
   docs/theory/axis-drift.md. */
#include "base/constants.h"
#include "flexure/finite.h"
#include <math.h>

enum { STEPS = 256, HALVINGS = 60 };

/* Pole of the displacement that turns by th and moves W by drift along y of the frame half turned:
     p = -drift / (2 sin(th/2)) along x of that frame, -> -drift'(0), nothing, at th = 0
   To first order in th it is -drift''(0) th/2: what is called the shift of the rotation centre in
   the literature (Verotti 2016); the error of a pin at W is the drift itself, second order.
   in: rad, m; out: m. Valid |th| < pi. Exact for the law. Cost 50 ns.
   Below 1e-5 rad by two terms: the slope at th is drift'(0) + drift''(0) th.
   source: docs/theory/axis-drift.md eq. 15; test_drift.c pole_stands_still */
static double pole(const fw_flexure_hinge_at *at, double th) {
    double s = 2 * sin(0.5 * th);
    return fabs(th) < 1e-5 ? 0.5 * at->drift_m.curve * th - at->drift_m.slope
                           : -at->drift_m.value / s;
}

/* what is left of a gap when the surfaces are displaced by u: gap - |u| cos zeta */
static double left(const fw_flexure_surfaces *s, double x, double y) {
    return s->gap_m - hypot(x, y) * cos(s->aside_rad);
}

/* Displacement of the second body's W in the frame half turned, h = th/2, under a force F that
   keeps its direction in the first body's frame; in: rad, N; out: m, NaN beyond the buckling load.
   Error of the law: finite_force.c. Test: test_drift.c under_a_force */
static void displaced(const fw_flexure_hinge_law *law, double th, const double F[2], double u[2]) {
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(law);
    double c = cos(0.5 * th), s = sin(0.5 * th), x = F ? F[0] : 0, y = F ? F[1] : 0, moment, pull;
    if (!fw_flexure_hinge_law_under(law, &rest, th, (const double[2]){c * x + s * y, c * y - s * x},
                                    u, &moment, &pull))
        u[0] = u[1] = (double)NAN;
}

/* the offset o along y of the first body is o (sin h, cos h) in the frame half turned; a point c
   that both bodies carry parts by (R(h) - R(-h)) c = 2 sin h (-c_y, c_x) */
static double left_at(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s, double th,
                      const double F[2]) {
    double u[2], h = 0.5 * th;
    displaced(law, th, F, u);
    double turn = 2 * sin(h), x = u[0] - turn * s->centre_m[1], y = u[1] + turn * s->centre_m[0];
    return left(s, x - s->offset_m * sin(h), y - s->offset_m * cos(h));
}

void fw_flexure_drift_displacement(const fw_flexure_hinge_law *law, double th, const double F[2],
                                   double u_m[2]) {
    double u[2], c = cos(0.5 * th), s = sin(0.5 * th);
    displaced(law, th, F, u);
    u_m[0] = c * u[0] - s * u[1], u_m[1] = s * u[0] + c * u[1];
}

fw_flexure_drift_point fw_flexure_drift_at(const fw_flexure_hinge_law *law,
                                           const fw_flexure_surfaces *surfaces, double th) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(law, th, &at);
    return (fw_flexure_drift_point){th, at.drift_m.value, pole(&at, th),
                                    left_at(law, surfaces, th, NULL)};
}

void fw_flexure_drift_curve(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *surfaces,
                            double low_rad, double high_rad, int n, fw_flexure_drift_point *point) {
    for (int i = 0; i < n; i++) {
        double part = n > 1 ? (double)i / (n - 1) : 0;
        point[i] = fw_flexure_drift_at(law, surfaces, low_rad + part * (high_rad - low_rad));
    }
}

/* The surfaces meet where |u| cos zeta = gap (radii Rc and Rc + gap about centres u apart).
   In: rad, m, N; out rad, to 1e-15. Sought from 0 in steps of 0.7 deg, then halved: a touch that
   ends within one step is missed. After it the hinge is a pin joint of that clearance, which this
   does not follow (contact.c does). Cost 10 to 20 us.
   source: docs/theory/axis-drift.md eq. 16; test_drift.c surfaces_meet */
double fw_flexure_drift_contact_rad(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s,
                                    const double F[2], int sense) {
    double low = 0, step = (sense < 0 ? -FW_PI : FW_PI) / STEPS;
    if (!(left_at(law, s, 0, F) > 0)) return 0;
    for (int i = 1; i < STEPS; i++) {
        double high = i * step;
        if (left_at(law, s, high, F) > 0) {
            low = high;
            continue;
        }
        for (int k = 0; k < HALVINGS; k++) {
            double middle = 0.5 * (low + high);
            if (left_at(law, s, middle, F) > 0)
                low = middle;
            else
                high = middle;
        }
        return high;
    }
    return (double)NAN;
}

/* The drift has one sign for both senses of rotation, 0 at rest: surfaces that are concentric half
   way of it need half the gap. A pin at (p, 0) from W is off by drift + 2 p sin(th/2): none at th
   where p is the pole of th.
   source: docs/theory/axis-drift.md eq. 17; test_drift.c advice_halves_the_gap */
fw_flexure_drift_advice fw_flexure_drift_advise(const fw_flexure_hinge_law *law, double low_rad,
                                                double high_rad) {
    double most = 0, least = 0;
    fw_flexure_hinge_at at;
    for (int i = 0; i <= STEPS; i++) {
        fw_flexure_hinge_law_at(law, low_rad + i * (high_rad - low_rad) / STEPS, &at);
        most = fmax(most, at.drift_m.value), least = fmin(least, at.drift_m.value);
    }
    fw_flexure_drift_advice advice = {.offset_m = 0.5 * (most + least),
                                      .centred_m = fmax(most, -least)};
    /* the offset itself turns with the first body: a little more than half is needed */
    const fw_flexure_surfaces s = {.gap_m = 0, .offset_m = advice.offset_m};
    for (int i = 0; i <= STEPS; i++) {
        double th = low_rad + i * (high_rad - low_rad) / STEPS;
        advice.gap_m = fmax(advice.gap_m, -left_at(law, &s, th, NULL));
    }
    double far = high_rad > -low_rad ? high_rad : low_rad, near = far > 0 ? -low_rad : high_rad;
    fw_flexure_hinge_law_at(law, far, &at);
    advice.pivot_x_m = pole(&at, far) * (1 - fabs(near / far));
    if (!isfinite(advice.pivot_x_m)) advice.pivot_x_m = 0;
    return advice;
}
