/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Andrews' squeezer (IFToMM A03). Hard because seven light bodies with three loops are thrown
   around at 1000 rad/s and every error of phase grows with the angle: the published reference
   itself is off by 1e-10. Compared with two quad-precision programs that agree to 20 digits. */
#include "hard.h"

static void near(const char *what, double got, double want, double size, double tol,
                 double *worst) {
    double error = fabs(got - want) / size;
    *worst = fmax(*worst, error);
    if (!(error <= tol))
        fail_msg("%s = %.17g, expected %.17g (off by %.2e)", what, got, want, error);
}

/* t = 0.03 s: angles, rates, accelerations and multipliers y1 ... y27 of the test set */
static void test_at_30_ms(void **state) {
    (void)state;
    static const double angle[7] = {15.810771195153707097,   -15.75637105841183947,
                                    0.040822240119645804858, -0.53473011634207959377,
                                    0.52440996587995406937,  0.53473011634207959377,
                                    1.0480807410419378731};
    static const double rate[7] = {1139.9203022591060642,  -1424.3792951775400732,
                                   11.032911910618593745,  19.293374105032040832,
                                   0.57356991482950245382, -19.293374105032040832,
                                   0.32317914924913087499};
    static const double accel[7] = {
        -24631.76312287463447, 51850.319636464231534,  324102.60070757860581, 566749.42200099532649,
        16743.63541834544461,  -566749.42200099532649, 9826.5078015441626885};
    static const double lambda[6] = {199.17534810453862819, -29.755309974971763324,
                                     23.066543611622151129, 31.452725275771137075,
                                     22.642494786394378578, 11.617392352611255907};
    /* body coordinate = sum of these two joint coordinates: K1 K2 K3 K4 K5 K6 K7 */
    static const int part[7][2] = {{0, -1}, {0, 1}, {2, -1}, {3, 4}, {4, -1}, {5, 6}, {6, -1}};
    /* the test set places K3 from B, K4 and K5 from A, K6 and K7 from A: its loops close at E */
    static const int pin[3] = {2, 3, 4};
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_squeezer(arena);
    const fw_dynamics_motion *m =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-13, .samples = 2});
    double e[4] = {0};
    for (int b = 0; b < 7; b++) {
        double want[3] = {0};
        for (int i = 0; i < 2 && part[b][i] >= 0; i++) {
            want[0] += angle[part[b][i]];
            want[1] += rate[part[b][i]];
            want[2] += accel[part[b][i]];
        }
        size_t at = (size_t)(21 + 3 * b + 2);
        near("angle", m->q[at], want[0], 1, 1e-10, &e[0]);
        near("rate", m->v[at], want[1], 1424, 1e-10, &e[1]);
        near("acceleration", m->accel[at], want[2], 566749, 1e-8, &e[2]);
    }
    for (int i = 0; i < 6; i++)
        near("multiplier", m->reaction_N[20 + 2 * pin[i / 2] + i % 2], lambda[i], 200, 1e-8, &e[3]);
    print_message("squeezer at 0.03 s, rtol 1e-13: angles to %.1e rad, rates %.1e, accelerations "
                  "%.1e, reactions %.1e of the largest; %ld steps, energy %.1e\n",
                  e[0], e[1], e[2], e[3], m->stats.steps, m->stats.energy_error);
    assert_true(m->stats.energy_error < 1e-12);
    fw_arena_free(arena);
}

/* the path of F to 0.05 s, beta there, and T + V - E0 - tau (beta - beta0) = 0 from the rows */
static void test_to_50_ms(void **state) {
    (void)state;
    static const double path[11][2] = {
        {6.986674115451445708662050e-03, -4.317230645688954625766717e-04},
        {6.844641754253787716557768e-03, 1.466587622996195710472167e-03},
        {-3.890552388649431935263227e-03, 5.819244118541015419738568e-03},
        {5.665434415839353634592085e-03, -4.111307928120077195873615e-03},
        {-2.274420924160498096234623e-03, 6.620197086170539814897950e-03},
        {6.274785249525569064792854e-03, -3.102752015926561599973598e-03},
        {-6.963039427046851507572970e-03, -7.183884307191019081353671e-04},
        {4.285449235466332266482625e-03, 5.534882550717858571810133e-03},
        {5.086198911145603806701710e-03, -4.809426227343681194768569e-03},
        {-4.415584339038532278431818e-03, -5.431630965450216227403142e-03},
        {-5.208504722296719976e-03, 4.676695260310721585e-03}};
    for (int e = 9; e <= 13; e += 2) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_squeezer(arena);
        r.scene.duration_s = 0.05;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = pow(10, -e), .samples = 11});
        double f = 0, balance = 0, first = 0;
        for (int i = 0; i < 11; i++) {
            const double *q = hard_q(m, i), *v = hard_v(m, i);
            f = fmax(f, hypot(q[0] + .00608 * cos(q[2]) - path[i][0],
                              q[1] + .00608 * sin(q[2]) - path[i][1]));
            double energy = 0;
            for (int b = 0; b < 7; b++) {
                const fw_mechanism_mass *p = &r.m.body[b];
                const double *w = v + 3 * b;
                energy += 0.5 * (p->mass_kg * (w[0] * w[0] + w[1] * w[1]) +
                                 p->inertia_kg_m2 * w[2] * w[2]);
            }
            double c = cos(q[8]), s = sin(q[8]);
            double dx = q[6] + c * .00957 - s * .00074 - .014;
            double dy = q[7] + s * .00957 + c * .00074 - .072;
            double stretch = hypot(dx, dy) - .07785;
            energy += 0.5 * 4530 * stretch * stretch - .033 * (q[2] - m->q[2]);
            if (i == 0) first = energy;
            balance = fmax(balance, fabs(energy - first));
        }
        const double *q = hard_q(m, 10), *v = hard_v(m, 10);
        double largest = m->stats.largest_energy_J;
        print_message("squeezer to 0.05 s, rtol 1e-%d: F to %.1e m, beta %.1e rad, beta' %.1e, "
                      "T+V-E0-tau(beta-beta0) %.1e of %.3f J\n",
                      e, f, fabs(q[2] - 33.82586776695451733),
                      fabs(v[2] / 1144.535502653847468 - 1), balance / largest, largest);
        if (e == 13) {
            assert_true(f < 1e-12);
            assert_near(q[2], 33.82586776695451733, 1e-10);
            assert_relative(v[2], 1144.535502653847468, 1e-10);
            assert_true(balance < 1e-12 * largest);
        }
        fw_arena_free(arena);
    }
}

/* accelerations and multipliers at rest: beta'' and theta'' and the first two of the test set */
static void test_start(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_squeezer(arena);
    const fw_dynamics_motion *m =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = 2});
    double e = 0;
    near("beta''", m->accel[2], 14222.4439199541138705911625887, 14222, 1e-10, &e);
    near("theta''", m->accel[5] - m->accel[2], -10666.8329399655854029433719415, 14222, 1e-10, &e);
    near("lambda1", m->reaction_N[4], 98.5668703962410896057654982170, 98, 1e-10, &e);
    near("lambda2", m->reaction_N[5], -6.12268834425566265503114393122, 98, 1e-10, &e);
    print_message("squeezer at rest: accelerations and multipliers to %.1e\n", e);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_start),
        cmocka_unit_test(test_at_30_ms),
        cmocka_unit_test(test_to_50_ms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
