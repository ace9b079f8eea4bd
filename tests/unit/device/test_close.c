/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses that rounding left open are closed once, by the least change; all others keep their bits.
 */
#include "files.h"
#include <math.h>
#include <stdint.h>

static const double pi = 3.14159265358979323846, UM = 1e-6;

typedef struct pose {
    double x, y, phi;
} pose;

static pose pose_of(const fw_device *d, int body) {
    return (pose){d->body[body].x_m, d->body[body].y_m, d->body[body].phi_rad};
}

static void point(pose p, double x, double y, double out[2]) {
    out[0] = p.x + cos(p.phi) * x - sin(p.phi) * y;
    out[1] = p.y + sin(p.phi) * x + cos(p.phi) * y;
}

static double gap_of(const fw_device *d, int joint) {
    const fw_device_revolute *j = &d->revolute[joint];
    double a[2] = {j->ax_m, j->ay_m}, b[2] = {j->bx_m, j->by_m};
    if (j->body_a >= 0) point(pose_of(d, j->body_a), j->ax_m, j->ay_m, a);
    if (j->body_b >= 0) point(pose_of(d, j->body_b), j->bx_m, j->by_m, b);
    return hypot(a[0] - b[0], a[1] - b[1]);
}

/* reads it; notes FW-D132, of which there is one or none */
static const fw_device *read(fw_arena *arena, const char *xml, size_t notes) {
    fw_diags diags = fw_diags_new(arena);
    const fw_device *d;
    assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &d), FW_OK);
    if (diags.count != notes) fail_msg("%zu notes of %zu in %s", diags.count, notes, xml);
    for (size_t i = 0; i < diags.count; i++) {
        assert_int_equal(diags.item[i].number, 132);
        assert_int_equal(diags.item[i].severity, FW_NOTE);
    }
    return d;
}

#define MASS "mass=\"1 mg\" inertia=\"1 mg mm^2\""

/* A pendulum 1 mm below its pin, which the body puts `gap` to the right: half of it is a move, half
   a turn about the centre of mass, as moves and turns at the pin count alike. */
static void half_a_move_half_a_turn(void **state) {
    (void)state;
    static const double gap_um[] = {0.009, 0.011, 0.29, 0.31, 5};
    for (int i = 0; i < 5; i++) {
        fw_arena *arena = fw_arena_new(0);
        bool closes = gap_um[i] > 0.01 && gap_um[i] < 0.3;
        char xml[500];
        snprintf(xml, sizeof xml,
                 DEVICE("<mechanism><body id=\"p\" " MASS " x=\"%.6f um\" y=\"-1 mm\"/>"
                        "<revolute id=\"A\" a=\"ground\" b=\"p\" b-y=\"1 mm\"/></mechanism>"),
                 gap_um[i]);
        const fw_device *d = read(arena, xml, closes);
        double gap = gap_um[i] * UM;
        if (!closes) { /* every bit as before */
            assert_true(d->body[0].y_m == -1e-3 && d->body[0].phi_rad == 0);
            assert_relative(d->body[0].x_m, gap, 1e-12);
            assert_relative(gap_of(d, 0), gap, 1e-9);
        } else {
            assert_true(gap_of(d, 0) < 1e-18);
            assert_near(d->body[0].x_m, 0.5 * gap, gap * gap / 1e-3);
            assert_near(d->body[0].phi_rad, 0.5 * gap / 1e-3, gap * gap / 1e-6);
            assert_true(d->revolute[0].x_m == 0 &&
                        d->revolute[0].y_m == 0); /* the ground does not move */
        }
        fw_arena_free(arena);
    }
}

/* two places that no pose brings together: nothing is changed, and the gaps are refused later */
static void contradictions_stay(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device *d = read(
        arena,
        DEVICE(
            "<mechanism><body id=\"p\" " MASS " x=\"0 mm\" y=\"0 mm\"/>"
            "<revolute id=\"A\" a=\"ground\" a-x=\"-1 mm\" b=\"p\" b-x=\"-1 mm\"/>"
            "<revolute id=\"B\" a=\"ground\" a-x=\"1000.1 um\" b=\"p\" b-x=\"1 mm\"/></mechanism>"),
        0);
    assert_true(d->body[0].x_m == 0 && d->body[0].y_m == 0 && d->body[0].phi_rad == 0);
    /* a tenth of a micrometre is no rounding in a mechanism of 30 um */
    d = read(arena,
             DEVICE("<mechanism><body id=\"p\" " MASS " x=\"0.1 um\" y=\"30 um\"/>"
                    "<revolute id=\"A\" a=\"ground\" b=\"p\" b-y=\"-30 um\"/></mechanism>"),
             0);
    assert_relative(d->body[0].x_m, 0.1 * UM, 1e-12);
    fw_arena_free(arena);
}

/* a slide across its axis, a rod along itself, a weld in place and angle */
static void other_joints_close_too(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device *d = read(
        arena,
        DEVICE("<mechanism><body id=\"s\" " MASS " x=\"3 mm\" y=\"0.2 um\" phi=\"1e-4 rad\"/>"
               "<body id=\"r\" " MASS " x=\"6 mm\" y=\"4 mm\"/>"
               "<body id=\"w\" " MASS " x=\"3000.1 um\" y=\"1 mm\" phi=\"0.5 rad\"/>"
               "<prismatic id=\"slide\" a=\"ground\" b=\"s\" axis=\"0 deg\" angle=\"0 deg\"/>"
               "<distance id=\"rod\" a=\"s\" b=\"r\" length=\"5000.1 um\"/>"
               "<weld id=\"weld\" a=\"s\" a-y=\"1 mm\" b=\"w\" angle=\"0.5 rad\"/></mechanism>"),
        1);
    pose s = pose_of(d, 0), r = pose_of(d, 1), w = pose_of(d, 2);
    double at[2];
    point(s, 0, 1e-3, at);
    assert_near(s.y, 0, 1e-15);
    assert_near(s.phi, 0, 1e-13);
    assert_near(hypot(r.x - s.x, r.y - s.y), 5000.1 * UM, 1e-14);
    assert_near(hypot(at[0] - w.x, at[1] - w.y), 0, 1e-14);
    assert_near(w.phi - s.phi, 0.5, 1e-13);
    assert_near(s.x, 3e-3, 0.2 * UM);
    assert_near(r.x, 6e-3, 0.2 * UM);
    fw_arena_free(arena);
}

/* ---- four-bars with all numbers rounded to 0.1 um, against their closed form ---- */

static double random01(uint64_t *seed) {
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*seed >> 11) * 0x1p-53;
}

typedef struct bar {
    double a[2], b[2]; /* its two pins, local */
} bar;

/* the bar with its pin a at P and its pin b at Q */
static pose between(const bar *m, const double P[2], const double Q[2]) {
    double phi = atan2(Q[1] - P[1], Q[0] - P[0]) - atan2(m->b[1] - m->a[1], m->b[0] - m->a[0]);
    pose p = {0, 0, remainder(phi, 2 * pi)};
    double at[2];
    point(p, m->a[0], m->a[1], at);
    return (pose){P[0] - at[0], P[1] - at[1], p.phi};
}

static double length_of(const bar *m) {
    return hypot(m->b[0] - m->a[0], m->b[1] - m->a[1]);
}

/* the assembly with the crank turned to theta, C on the side of BD where it was */
static void assembly(const bar m[3], const double A[2], const double D[2], double theta,
                     double side, pose out[3]) {
    double crank = length_of(&m[0]), p = length_of(&m[1]), q = length_of(&m[2]);
    double B[2] = {A[0] + crank * cos(theta), A[1] + crank * sin(theta)};
    double dx = D[0] - B[0], dy = D[1] - B[1], far = hypot(dx, dy);
    double along = (far * far + p * p - q * q) / (2 * far), up = side * sqrt(p * p - along * along);
    double C[2] = {B[0] + (along * dx - up * dy) / far, B[1] + (along * dy + up * dx) / far};
    out[0] = between(&m[0], A, B);
    out[1] = between(&m[1], B, C);
    out[2] = between(&m[2], C, D);
}

static double distance2(const bar m[3], const pose p[3], const pose q[3]) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double lever2 = 0.5 * (m[i].a[0] * m[i].a[0] + m[i].a[1] * m[i].a[1] +
                               m[i].b[0] * m[i].b[0] + m[i].b[1] * m[i].b[1]);
        double turn = p[i].phi - q[i].phi;
        sum += pow(p[i].x - q[i].x, 2) + pow(p[i].y - q[i].y, 2) + lever2 * turn * turn;
    }
    return sum;
}

static double digits(double value) { /* as a user types it: 0.1 um */
    return 1e-7 * round(value / 1e-7);
}

static void rounded_four_bars(void **state) {
    (void)state;
    uint64_t seed = 7;
    int closed = 0;
    for (int run = 0; run < 60; run++) {
        double A[2] = {0, 0}, D[2] = {(1.2 + random01(&seed)) * 1e-3, 0};
        double P[4][2] = {{0, 0}, {0, 0}, {0, 0}, {D[0], 0}};
        P[1][0] = (random01(&seed) - 0.5) * 1e-3, P[1][1] = (0.7 + 0.5 * random01(&seed)) * 1e-3;
        P[2][0] = D[0] + (random01(&seed) - 0.5) * 1e-3;
        P[2][1] = (0.7 + 0.5 * random01(&seed)) * 1e-3;
        bar m[3];
        pose typed[3], nearer[3], found[3];
        char xml[2000], *at = xml, *end = xml + sizeof xml;
        at += snprintf(at, (size_t)(end - at), "%s",
                       "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><mechanism>");
        for (int i = 0; i < 3; i++) {
            double x = 0.5 * (P[i][0] + P[i + 1][0]), y = 0.5 * (P[i][1] + P[i + 1][1]);
            x += 1e-4 * random01(&seed);
            m[i] = (bar){{digits(P[i][0] - x), digits(P[i][1] - y)},
                         {digits(P[i + 1][0] - x), digits(P[i + 1][1] - y)}};
            typed[i] = (pose){digits(x), digits(y), 0};
            at += snprintf(at, (size_t)(end - at),
                           "<body id=\"b%d\" " MASS " x=\"%.1f um\" y=\"%.1f um\"/>", i,
                           typed[i].x * 1e6, typed[i].y * 1e6);
        }
        D[0] = digits(D[0]);
        for (int i = 0; i < 4; i++) {
            char a[16] = "ground", b[16] = "ground";
            const double *on_a = i ? m[i - 1].b : A, *on_b = i < 3 ? m[i].a : D;
            if (i) snprintf(a, sizeof a, "b%d", i - 1);
            if (i < 3) snprintf(b, sizeof b, "b%d", i);
            at += snprintf(at, (size_t)(end - at),
                           "<revolute id=\"j%d\" a=\"%s\" a-x=\"%.1f um\" a-y=\"%.1f um\" b=\"%s\" "
                           "b-x=\"%.1f um\" b-y=\"%.1f um\"/>",
                           i, a, on_a[0] * 1e6, on_a[1] * 1e6, b, on_b[0] * 1e6, on_b[1] * 1e6);
        }
        snprintf(at, (size_t)(end - at), "</mechanism></device>");
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        const fw_device *d;
        assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &d),
                         FW_OK);
        for (int i = 0; i < 3; i++)
            found[i] = pose_of(d, i);
        double most = 0;
        for (int j = 0; j < 4; j++)
            most = fmax(most, gap_of(d, j));
        if (diags.count) { /* closed, and the nearest of all assemblies of these very bars */
            assert_int_equal(diags.item[0].number, 132);
            assert_true(most < 1e-15);
            double theta = found[0].phi + atan2(m[0].b[1] - m[0].a[1], m[0].b[0] - m[0].a[0]);
            double side = (P[2][0] - P[1][0]) * (P[3][1] - P[1][1]) -
                                      (P[2][1] - P[1][1]) * (P[3][0] - P[1][0]) >
                                  0
                              ? -1
                              : 1;
            double least = distance2(m, found, typed);
            assembly(m, A, D, theta, side, nearer);
            assert_near(sqrt(distance2(m, nearer, found)), 0, 1e-14);
            for (int sign = -1; sign <= 1; sign += 2) {
                assembly(m, A, D, theta + sign * 1e-5, side, nearer);
                /* grows with the square of the step; the first order is what a slip would show */
                assert_true(distance2(m, nearer, typed) > least);
            }
            closed++;
        } else /* by chance the digits fit */
            assert_true(most <= 10e-9);
        fw_arena_free(arena);
    }
    assert_true(closed > 40);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_a_move_half_a_turn),
        cmocka_unit_test(contradictions_stay),
        cmocka_unit_test(other_joints_close_too),
        cmocka_unit_test(rounded_four_bars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
