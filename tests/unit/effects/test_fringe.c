/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The field at the edges of a comb's fingers, against boundary elements of its own: the cross-section of a comb that
   goes on for ever aside, two fingers to a period, charges on panels that crowd towards the corners. */
#include "drive_rig.h"
#include "effects/effects.h"
#include "maths/dense.h"
#include <complex.h>

/* ---- boundary elements ---- */

enum { SIDE = 26, FACES = 4, PANELS = 2 * FACES * SIDE };

typedef struct panel {
    double complex a, b;
} panel;

/* -1/(2 pi) int ln|z - zeta| |d zeta| over a panel: the real part of a closed form */
static double panel_log(panel p, double complex z) {
    double complex d = (p.b - p.a) / cabs(p.b - p.a), u = (z - p.a) / d, v = (z - p.b) / d;
    double at_u = cabs(u) > 0 ? creal(u * clog(u)) : 0, at_v = cabs(v) > 0 ? creal(v * clog(v)) : 0;
    return -(at_u - at_v - cabs(p.b - p.a)) / (2 * M_PI);
}

/* all images at x + k period: -ln|2 sin(pi z/period)|/(2 pi), the nearest in closed form */
static double influence(panel p, double complex z, double period) {
    static const double at[3] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[3] = {5. / 18, 8. / 18, 5. / 18};
    double all = 0, length = cabs(p.b - p.a);
    for (int k = -1; k <= 1; k++)
        all += panel_log(p, z - k * period);
    for (int i = 0; i < 3; i++) {
        double complex r = z - (0.5 * (p.a + p.b) + 0.5 * at[i] * (p.b - p.a)), s = 2 * csin(M_PI * r / period);
        double smooth = log(cabs(s));
        if (cabs(r) < 1e-9 * period) { /* what is left of the sine as all go to 0 */
            smooth = log(2 * M_PI / period) - 2 * log(period);
        } else {
            for (int k = -1; k <= 1; k++)
                smooth -= log(cabs(r - k * period));
        }
        all -= weight[i] * length * smooth / (2 * M_PI);
    }
    return all;
}

/* C/eps0 per length of a finger of width w and depth h, the gaps beside it being one and other */
static double elements(double w, double h, double one, double other) {
    static panel p[PANELS];
    static double matrix[(PANELS + 1) * (PANELS + 1)], q[PANELS + 1];
    static int pivot[PANELS + 1];
    const double period = 2 * w + one + other;
    int n = 0;
    for (int finger = 0; finger < 2; finger++) {
        const double left = finger ? w + one : 0;
        const double complex up = h * csqrt(-1);
        const double complex corner[5] = {left, left + w, left + w + up, left + up, left};
        for (int f = 0; f < FACES; f++)
            for (int i = 0; i < SIDE; i++) {
                double s = 0.5 * (1 - cos(M_PI * i / SIDE)), t = 0.5 * (1 - cos(M_PI * (i + 1) / SIDE));
                /* once more towards the corners, where the charge is without bound */
                s = s * s * (3 - 2 * s), t = t * t * (3 - 2 * t);
                p[n++] = (panel){corner[f] + s * (corner[f + 1] - corner[f]), corner[f] + t * (corner[f + 1] - corner[f])};
            }
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            matrix[i * (n + 1) + j] = influence(p[j], 0.5 * (p[i].a + p[i].b), period);
        matrix[i * (n + 1) + n] = 1; /* the potential far away; no charge in a period */
        matrix[n * (n + 1) + i] = cabs(p[i].b - p[i].a);
        q[i] = i < n / 2 ? 0.5 : -0.5;
    }
    matrix[n * (n + 1) + n] = 0, q[n] = 0;
    assert_true(fw_maths_lu_factor(n + 1, matrix, pivot));
    fw_maths_lu_solve(n + 1, matrix, pivot, q);
    double charge = 0;
    for (int i = 0; i < n / 2; i++)
        charge += q[i] * cabs(p[i].b - p[i].a);
    return charge;
}

static double closed(double w, double h, double one, double other) {
    return h / one + h / other + fw_effects_comb_edge(one, w, NULL) + fw_effects_comb_edge(other, w, NULL);
}

/* from gaps that are twice as wide as the layer is deep on, and fingers from a third of a gap to six gaps wide */
static void fringe_of_a_comb(void **state) {
    (void)state;
    const double width[] = {0.3, 1, 2, 6}, depth[] = {0.5, 1, 3, 10, 25};
    double worst = 0, least = 1;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 5; k++) {
            double want = elements(width[i], depth[k], 1, 1);
            worst = fmax(worst, fabs(closed(width[i], depth[k], 1, 1) / want - 1));
            least = fmin(least, 1 - 2 * depth[k] / want);
        }
    assert_true(worst < 2e-3);
    assert_true(least > 0.025); /* there is always some */
}

/* Aside every gap counts by itself, as if its neighbour were as wide. The rotor moves by up to half of the gap: the gap
   becomes 3 times the other one, and what the closed form leaves of the pull aside is below 3 %. */
static void fringe_aside(void **state) {
    (void)state;
    double worst = 0, pull = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 1; k <= 5; k++) {
            const double w = 0.6 + 0.9 * i, h = 2 + 4 * i, y = 0.1 * k, d = 0.02;
            double want[3], got[3];
            for (int n = -1; n <= 1; n++) {
                double one = 1 + y + n * d, other = 1 - y - n * d;
                want[n + 1] = elements(w, h, one, other), got[n + 1] = closed(w, h, one, other);
            }
            worst = fmax(worst, fabs(got[1] / want[1] - 1));
            pull = fmax(pull, fabs((got[2] - got[0]) / (want[2] - want[0]) - 1));
        }
    assert_true(worst < 1e-2 && pull < 3e-2);
}

static void with_comb(rig *r, const fw_device_comb *c, const char *effects) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_LIST, .list = effects};
    rig_new(r, 7);
    r->scene.comb = fw_arena_one(r->arena, fw_device_comb);
    r->scene.comb[0] = *c;
    r->scene.ncomb = 1;
    assert_int_equal(
        fw_effects_compile(r->arena, &r->m, &r->scene, &choice, 1e-3, &r->diags, &r->ledger, &r->loads), FW_OK);
    r->e = &r->loads.element[0];
}

/* of the element: its pull is that of the closed form, its derivatives those of its capacitance */
static void the_element_has_it(void **state) {
    (void)state;
    const double eps0 = 8.8541878128e-12;
    const fw_device_comb comb = {.id = "comb", .kind = FW_ELECTRODES_COMB, .body_a = FW_GROUND, .body_b = 0,
                                 .direction_rad = 0.7, .fingers = 20, .gap_m = 4e-6, .overlap_m = 60e-6,
                                 .length_m = 140e-6, .width_m = 7e-6, .depth_m = (double)NAN, .voltage_V = 30};
    rig with, without;
    with_comb(&with, &comb, "fringe-field");
    with_comb(&without, &comb, "comb-drive");
    const fw_effects_comb_element *c = fw_effects_comb_of(with.e), *plain = fw_effects_comb_of(without.e);
    for (int i = 0; i < 60; i++) {
        const double at[3] = {3e-5 * rig_random(&with), 1.5e-6 * rig_random(&with), 0.02 * rig_random(&with)};
        double slope[3], bend[9], other[9], unused[3], F = 0;
        double more = fw_effects_comb_capacitance(c, at, slope, bend) -
                      fw_effects_comb_capacitance(plain, at, unused, other);
        /* the middle of the overlap is at -x/2; 400 midpoints over it */
        const double l = 60e-6 + at[0];
        for (int k = 0; k < 400; k++) {
            const double s = -0.5 * at[0] + ((k + 0.5) / 400 - 0.5) * l, y = at[1] + at[2] * s;
            F += l / 400 * (fw_effects_comb_edge(4e-6 - y, 7e-6, NULL) + fw_effects_comb_edge(4e-6 + y, 7e-6, NULL));
        }
        assert_relative(more, eps0 * 20 * F, 2e-3);
        const double h[3] = {2e-8, 2e-8, 2e-5};
        for (int k = 0; k < 3; k++) {
            double v[7], s[3][7], now[3];
            for (int j = -3; j <= 3; j++) {
                double moved[3] = {at[0], at[1], at[2]};
                moved[k] += j * h[k];
                v[j + 3] = fw_effects_comb_capacitance(c, moved, now, NULL);
                for (int n = 0; n < 3; n++)
                    s[n][j + 3] = now[n];
            }
            assert_near(fw_check_slope(v, h[k]), slope[k], 1e-8 * v[3] / h[k]);
            for (int n = 0; n < 3; n++)
                assert_near(fw_check_slope(s[n], h[k]), bend[3 * n + k], 1e-7 * v[3] / h[k] / h[n]);
        }
    }
    /* a plate is no comb */
    fw_device_comb flat = comb;
    rig plate;
    flat.kind = FW_ELECTRODES_PLATE;
    with_comb(&plate, &flat, "fringe-field");
    assert_null(fw_effects_comb_of(plate.e)->edge);
    fw_arena_free(with.arena), fw_arena_free(without.arena), fw_arena_free(plate.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(fringe_of_a_comb), cmocka_unit_test(fringe_aside),
                                       cmocka_unit_test(the_element_has_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
