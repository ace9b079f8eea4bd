/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed form under forces of any size: its derivatives against differences, its small forces
   against finite.c, and forces and displacements up to ten widths against the exact beam. */
#include "flexure/beam.h"
#include "flexure/finite.h"
#include "flexure/path.h"
#include "strip_input.h"
#include "test.h"
#include <math.h>

static const double degree = M_PI / 180;

typedef struct strip { /* of length 1 mm, with its law and its beam */
    fw_flexure_input in;
    fw_flexure_result closed;
    fw_flexure_hinge_law law;
    fw_flexure_hinge_rest rest;
    fw_flexure_elastica *beam;
    fw_arena *arena;
} strip;

/* slender: t/L; fillet_m below 0: rigid ends */
static strip strip_of(double angle_deg, double slender, double fillet) {
    strip s = {.arena = fw_arena_new(0)};
    s.in = strip_input(1e-3, angle_deg, slender, fillet);
    fw_flexure_closed_form(&s.in, &s.closed);
    fw_flexure_hinge_law_of(&s.in, &s.closed, &s.law);
    s.rest = fw_flexure_hinge_rest_of(&s.law);
    fw_flexure_beam *b = fw_arena_one(s.arena, fw_flexure_beam);
    assert_int_equal(fw_flexure_beam_of_input(s.arena, &s.in, &s.closed, b), FW_OK);
    const double pin[2] = {s.closed.centre_m, 0};
    assert_int_equal(fw_flexure_elastica_new(s.arena, b, pin, false, &s.beam), FW_OK);
    return s;
}

/* moments at both roots of a wrench (M, F) on the second body, by equilibrium in its place */
static void root_moments(const strip *s, const double twist[3], const double wrench[3],
                         double M[2]) {
    double a = 0.5 * s->in.angle_rad, c = cos(twist[0]), sn = sin(twist[0]);
    double rx = s->in.radius_m * cos(a) - s->closed.centre_m, ry = s->in.radius_m * sin(a);
    if (!(a > 0)) rx = 0, ry = 0.5 * s->in.length_m;
    double x2 = c * rx - sn * ry, y2 = sn * rx + c * ry; /* second root from the second W */
    double x1 = twist[1] - rx, y1 = twist[2] + ry;       /* second W from the first root */
    M[0] = wrench[0] + x1 * wrench[2] - y1 * wrench[1];
    M[1] = wrench[0] - (x2 * wrench[2] - y2 * wrench[1]);
}

static void derivatives(void **state) {
    (void)state;
    const double weight[7] = {-1, 9, -45, 0, 45, -9, 1}, size[3] = {1, 1e-3, 1e-3};
    const double angle[] = {0, 3, 40, 90, 180, 270, 330};
    for (int i = 0; i < 70; i++) {
        strip s = strip_of(angle[i % 7], 0.02, i % 2 ? 0.3 : -1);
        double th = 0.5 * sin(i), w = 0.08e-3 * cos(3 * i), pull = 12e-6 * sin(2 * i);
        fw_flexure_hinge_soft soft;
        fw_flexure_hinge_law_soft(&s.law, &s.rest, th, true, &soft);
        double v =
            soft.drift_m.value - 0.6 * w * w / 1e-3 + pull * soft.bend_y.value / soft.bend_x.value;
        double p[3] = {th, w, v};
        fw_flexure_hinge_bent b, near;
        fw_flexure_hinge_law_bend(&s.law, &s.rest, p, true, &b);
        for (int k = 0; k < 3; k++) {
            double slope = 0, curve[3] = {0}, h = (k == 2 ? 1e-6 : 1e-3) * size[k];
            for (int n = -3; n <= 3; n++) {
                double q[3] = {p[0], p[1], p[2]};
                q[k] += n * h;
                fw_flexure_hinge_law_bend(&s.law, &s.rest, q, false, &near);
                slope += weight[n + 3] * near.energy_J / (60 * h);
                for (int j = 0; j < 3; j++)
                    curve[j] += weight[n + 3] * near.gradient[j] / (60 * h);
            }
            assert_near(b.gradient[k], slope,
                        1e-6 * (fabs(slope) + sqrt(b.hessian[k][k] * b.energy_J)));
            for (int j = 0; j < 3; j++) {
                assert_near(b.hessian[j][k], curve[j],
                            1e-5 * sqrt(fabs(b.hessian[j][j] * b.hessian[k][k])));
                assert_near(b.hessian[j][k], b.hessian[k][j], 0);
            }
        }
        fw_arena_free(s.arena);
    }
}

/* the wrench in the first body's frame is the gradient of the same energy by the twist */
static void wrench_and_tangent(void **state) {
    (void)state;
    for (int i = 0; i < 40; i++) {
        strip s = strip_of(8.0 * i, 0.02, 0.3);
        const double p[3] = {0.5 * sin(i), 8e-6 * cos(3 * i), 6e-6 * sin(2 * i)};
        double F[3], T[3][3], low[3], high[3], unused[3][3];
        fw_flexure_hinge_law_wrench(&s.law, &s.rest, p, F, T);
        for (int k = 0; k < 3; k++) {
            double h = k ? 1e-10 : 1e-6, from[3] = {p[0], p[1], p[2]}, to[3] = {p[0], p[1], p[2]};
            from[k] -= h, to[k] += h;
            fw_flexure_hinge_law_wrench(&s.law, &s.rest, from, low, unused);
            fw_flexure_hinge_law_wrench(&s.law, &s.rest, to, high, unused);
            for (int j = 0; j < 3; j++) {
                assert_near(T[j][k], (high[j] - low[j]) / (2 * h),
                            1e-6 * sqrt(fabs(T[j][j] * T[k][k])));
                assert_near(T[j][k], T[k][j], 1e-12 * sqrt(fabs(T[j][j] * T[k][k])));
            }
        }
        fw_arena_free(s.arena);
    }
}

/* without much force it is the law of finite.c */
static void small_forces(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        strip s = strip_of(17.0 * i, 0.02, 0.3);
        fw_flexure_hinge_at at;
        fw_flexure_hinge_bent b;
        double th = 0.3 * cos(i);
        fw_flexure_hinge_law_at(&s.law, th, &at);
        const double p[3] = {th, 1e-12, at.drift_m.value};
        fw_flexure_hinge_law_bend(&s.law, &s.rest, p, true, &b);
        assert_relative(b.hessian[1][1], at.kx_N_per_m.value, 1e-9);
        assert_relative(b.hessian[2][2], at.ky_N_per_m.value, 1e-9);
        assert_relative(b.gradient[0], s.law.stiffness_Nm_per_rad * th, 1e-9);
        fw_arena_free(s.arena);
    }
}

/* the law's place under the wrench (th, Fx, Fy) given: Newton's method from `twist` */
static bool settle(const strip *s, const double F[2], double twist[3], double wrench[3]) {
    double T[3][3];
    for (int i = 0; i < 60; i++) {
        fw_flexure_hinge_law_wrench(&s->law, &s->rest, twist, wrench, T);
        double fx = F[0] - wrench[1], fy = F[1] - wrench[2];
        double det = T[1][1] * T[2][2] - T[1][2] * T[2][1];
        double dx = (T[2][2] * fx - T[1][2] * fy) / det, dy = (T[1][1] * fy - T[2][1] * fx) / det;
        twist[1] += dx, twist[2] += dy;
        if (hypot(dx, dy) < 1e-16) return true;
    }
    return false;
}

typedef struct compared {
    int count;
    double place, moment; /* largest so far */
} compared;

/* one state: rotation th under a dead force on the second body. Place of the law against that of
   the exact beam, relative to how far W is from where a pure moment has it; root moments, relative
   to the largest in the strip. Strains up to 1 %, displacements up to ten widths and 0.6 r. */
static void compare(const strip *s, double th, const double F[2], compared *worst) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&s->law, th, &at);
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY}, {th, F[0], F[1]}};
    fw_flexure_elastica_result r;
    fw_flexure_elastica_state peak;
    fw_flexure_elastica_solve(s->beam, &task, 1e-10, false, &r);
    if (r.code != FW_ELASTICA_OK) return;
    fw_flexure_elastica_peak_strain(s->beam, &peak);
    double c = cos(0.5 * th), sn = sin(0.5 * th), t = s->in.width_m;
    double far = hypot(c * r.twist[1] + sn * r.twist[2],
                       c * r.twist[2] - sn * r.twist[1] - at.drift_m.value);
    double most = s->in.angle_rad > 0 ? fmin(10 * t, 0.6 * s->in.radius_m) : 10 * t;
    if (fmax(fabs(peak.strain[0]), fabs(peak.strain[1])) > 0.01 || far > most || far < 0.2 * t)
        return;
    double twist[3] = {th, r.twist[1], r.twist[2]}, wrench[3], M[2], N[2];
    assert_true(settle(s, F, twist, wrench));
    root_moments(s, r.twist, r.wrench, N);
    root_moments(s, twist, wrench, M);
    double off = hypot(twist[1] - r.twist[1], twist[2] - r.twist[2]) / far;
    double moment = fmax(fabs(M[0] - N[0]), fabs(M[1] - N[1])) /
                    fmax(fabs(peak.moment_Nm), fmax(fabs(N[0]), fabs(N[1])));
    worst->place = fmax(worst->place, off), worst->moment = fmax(worst->moment, moment);
    worst->count++;
}

static void holds(const compared *worst, int least) {
    if (!(worst->count > least && worst->place < 0.01 && worst->moment < 0.004))
        fail_msg("%d states: place off by %g, moment by %g", worst->count, worst->place,
                 worst->moment);
}

static void against_the_exact_beam(void **state) {
    (void)state;
    const double angle[] = {0, 0, 20, 60, 90, 135, 180, 225, 270, 300, 330};
    compared worst = {0};
    for (int a = 0; a < 11; a++)
        for (int i = 0; i < 240; i++) {
            strip s = strip_of(angle[a], i % 2 ? 1 / 40.0 : 1 / 80.0, i % 3 ? 0.5 : -1);
            double th = (i / 2 % 5 - 2) * 15 * degree, u = (1 + i % 10) * s.in.width_m;
            fw_flexure_hinge_at at;
            fw_flexure_hinge_law_at(&s.law, th, &at);
            double kx = at.kx_N_per_m.value, ky = fmin(at.ky_N_per_m.value, 20 * kx);
            const double F[2] = {u * kx * cos(0.7 * i), (i % 4 ? 1 : 0) * u * ky * sin(0.7 * i)};
            compare(&s, th, F, &worst);
            fw_arena_free(s.arena);
        }
    holds(&worst, 1000);
}

static uint64_t seed = 0x18b;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) / 9007199254740992.0;
}

/* none of these states was looked at when the law was made */
static void at_random_states(void **state) {
    (void)state;
    compared worst = {0};
    for (int i = 0; i < 2400; i++) {
        double angle = i % 8 ? uniform(1, 332) : 0;
        strip s = strip_of(angle, 1 / uniform(40, 160), i % 3 ? uniform(0.1, 0.8) : -1);
        double th = uniform(-30, 30) * degree, u = uniform(0.3, 10) * s.in.width_m;
        double way = uniform(0, 2 * M_PI);
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&s.law, th, &at);
        double kx = at.kx_N_per_m.value, ky = fmin(at.ky_N_per_m.value, 20 * kx);
        compare(&s, th, (const double[2]){u * kx * cos(way), u * ky * sin(way)}, &worst);
        fw_arena_free(s.arena);
    }
    holds(&worst, 1000);
}

/* a guided leaf whose ends keep their distance: forces and root moments at a given place */
static void guided_and_held(void **state) {
    (void)state;
    int held = 0;
    for (int slender = 40; slender <= 160; slender += 30)
        for (int i = 1; i <= 10; i++) {
            strip s = strip_of(0, 1.0 / slender, i % 2 ? 0.5 : -1);
            const double twist[3] = {0, i * s.in.width_m, 0};
            double wrench[3], T[3][3], M[2], N[2];
            fw_flexure_elastica_result r;
            fw_flexure_elastica_state peak;
            fw_flexure_hinge_law_wrench(&s.law, &s.rest, twist, wrench, T);
            fw_flexure_elastica_of_twist(s.beam, twist, 1e-8, false, &r);
            assert_true(r.code == FW_ELASTICA_OK || r.code == FW_ELASTICA_ROUGH);
            fw_flexure_elastica_peak_strain(s.beam, &peak);
            root_moments(&s, twist, wrench, M);
            root_moments(&s, r.twist, r.wrench, N);
            /* above 3 % of strain the root moments drift apart: 10 % at 11 % */
            double most = fmax(fabs(peak.strain[0]), fabs(peak.strain[1]));
            if (most < 0.03) {
                held++;
                double force = most < 0.01 ? 0.003 : 0.03, moment = most < 0.01 ? 0.008 : 0.03;
                assert_relative(wrench[1], r.wrench[1], force);
                assert_relative(wrench[2], r.wrench[2], force);
                assert_relative(M[0], N[0], moment);
            }
            fw_arena_free(s.arena);
        }
    assert_true(held >= 40);
}

/* a leaf pressed beyond what it bears alone, that others hold: where its ends are says what is in it,
   to the law by the pull, to the exact beam by the force across */
static void held_by_others(void **state) {
    (void)state;
    int beyond = 0;
    for (int i = 1; i <= 24; i++) {
        strip s = strip_of(0, 1 / 60.0, i % 2 ? 0.5 : -1);
        double th = (i % 3 - 1) * degree, EI = s.closed.stiffness_Nm_per_rad * s.in.length_m;
        double most = i * EI / (s.in.length_m * s.in.length_m); /* y to 24, and w to 2.4 widths */
        double w = 0.1 * i * s.in.width_m, u[2], moment, pull;
        if (!fw_flexure_hinge_law_held(&s.law, &s.rest, th, -most, w, u, &moment, &pull))
            fail_msg("not held at y = -%d", i);
        fw_flexure_hinge_bent b;
        fw_flexure_hinge_law_bend(&s.law, &s.rest, (const double[3]){th, w, u[1]}, false, &b);
        assert_relative(b.pull_N, -most, 1e-8);
        assert_relative(b.gradient[0], moment, 1e-8);
        double v[2], other, alone;
        const double force[2] = {b.gradient[1], b.gradient[2]};
        beyond += !fw_flexure_hinge_law_under(&s.law, &s.rest, th, force, v, &other, &alone);
        double co = cos(0.5 * th), si = sin(0.5 * th);
        const double twist[3] = {th, co * w - si * u[1], si * w + co * u[1]};
        const double wrench[3] = {moment - 0.5 * (w * force[1] - u[1] * force[0]),
                                  co * force[0] - si * force[1], si * force[0] + co * force[1]};
        fw_flexure_elastica_result r[2];
        double part[3] = {0, 0.3, 1}, M[2][3], N[2][3];
        fw_flexure_elastica_held(s.beam, twist, wrench, (const double[2]){co, si}, 1e-8, &r[0]);
        assert_true(r[0].code <= FW_ELASTICA_ROUGH);
        fw_flexure_elastica_along(s.beam, 3, part, M[0], N[0]);
        /* its own place is one that has this force across */
        const fw_flexure_elastica_task place = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                                {r[0].twist[0], r[0].twist[1], r[0].twist[2]}};
        fw_flexure_elastica_near(s.beam, &place, twist, wrench, 1e-8, &r[1]);
        assert_true(r[1].code <= FW_ELASTICA_ROUGH);
        fw_flexure_elastica_along(s.beam, 3, part, M[1], N[1]);
        for (int k = 0; k < 3; k++) {
            assert_relative(N[0][k], -most, 0.003); /* tilted by what the strip is bent */
            assert_near(M[0][k], M[1][k], 0.02 * fabs(M[0][0]));
        }
        fw_arena_free(s.arena);
    }
    assert_true(beyond > 5);
}

/* what was worked out once at a rotation serves every force there: where it leads to, the law bears that force */
static void under_many_forces(void **state) {
    (void)state;
    int held = 0;
    for (int i = 0; i < 40; i++) {
        strip s = strip_of(8.0 * i, 0.02, 0.3);
        const double th = 0.4 * sin(i), at[3] = {th, 5e-6 * cos(3 * i), 1e-7 * sin(2 * i)};
        fw_flexure_hinge_bent b;
        fw_flexure_hinge_law_bend(&s.law, &s.rest, at, false, &b);
        fw_flexure_hinge_rotated rotated;
        fw_flexure_hinge_law_rotated(&s.law, &s.rest, th, &rotated);
        for (int k = 0; k < 5; k++) {
            const double force[2] = {b.gradient[1] * (1 - 0.4 * k), b.gradient[2] * (0.3 * k - 1)};
            double u[2], moment, pull;
            if (!fw_flexure_hinge_rotated_under(&rotated, force, u, &moment, &pull)) continue;
            fw_flexure_hinge_bent is;
            fw_flexure_hinge_law_bend(&s.law, &s.rest, (const double[3]){th, u[0], u[1]}, false, &is);
            const double most = fabs(force[0]) + fabs(force[1]);
            assert_near(is.gradient[1], force[0], 1e-7 * most);
            assert_near(is.gradient[2], force[1], 1e-7 * most);
            assert_near(is.gradient[0], moment, 1e-7 * (fabs(moment) + most * s.in.length_m));
            held++;
        }
        fw_arena_free(s.arena);
    }
    assert_true(held > 120);
}

/* what is not asked for its second derivatives takes fewer looks at the functions, and says the same */
static void in_one_step(void **state) {
    (void)state;
    double worst = 0;
    for (int i = 0; i < 100; i++) {
        strip s = strip_of(i % 5 ? uniform(0, 330) : 0, uniform(0.005, 0.05), i % 2 ? 0.3 : -1);
        fw_flexure_hinge_soft soft;
        for (int k = 0; k < 25; k++) {
            const double th = uniform(-0.6, 0.6), w = 1e-4 * uniform(-1, 1);
            const double y = pow(10, uniform(-5, 1)) * (k % 2 ? 1 : -1); /* F L^2/EI */
            fw_flexure_hinge_law_soft(&s.law, &s.rest, th, false, &soft);
            const double v = soft.drift_m.value - 0.6 * w * w / s.law.length_m +
                             y * soft.bend_y.value * s.law.length_m / (8 * s.law.bend_m_per_N);
            const double at[3] = {th, w, v};
            fw_flexure_hinge_bent few, full;
            fw_flexure_hinge_law_bend(&s.law, &s.rest, at, false, &few);
            fw_flexure_hinge_law_bend(&s.law, &s.rest, at, true, &full);
            if (!full.holds) continue;
            const double size[3] = {s.law.length_m, 1, 1}, force = fabs(full.gradient[1]) + fabs(full.gradient[2]);
            for (int j = 0; j < 3; j++) {
                double off = fabs(few.gradient[j] - full.gradient[j]) /
                             (force * size[j] + (j ? 0 : fabs(full.gradient[0])));
                worst = fmax(worst, off);
            }
        }
        fw_arena_free(s.arena);
    }
    assert_true(worst < 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives),      cmocka_unit_test(wrench_and_tangent),
        cmocka_unit_test(small_forces),     cmocka_unit_test(against_the_exact_beam),
        cmocka_unit_test(at_random_states), cmocka_unit_test(guided_and_held),
        cmocka_unit_test(held_by_others),   cmocka_unit_test(under_many_forces),
        cmocka_unit_test(in_one_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
