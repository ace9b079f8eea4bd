/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the beam's solver gets to its results: errors it tells, warm starts, the primary branch and
   its end, states inside, and what it refuses. */
#include "flexure/beam.h"
#include "test.h"

static const double um = 1e-6;

static uint64_t seed = 8675309;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) * 0x1p-53;
}

typedef struct rig {
    fw_arena *arena;
    fw_flexure_beam_piece piece[3];
    fw_flexure_beam beam;
    fw_flexure_elastica *e;
    double soft, length;
} rig;

static void begin(rig *r, const double *point, bool hinged) {
    r->arena = fw_arena_new(0);
    r->beam.piece = r->piece;
    assert_int_equal(fw_flexure_elastica_new(r->arena, &r->beam, point, hinged, &r->e), FW_OK);
    r->soft = fw_flexure_elastica_linear(r->e)->c[0][0];
    r->length = fw_flexure_elastica_linear(r->e)->length_m;
}

/* EI = 1, starting at the origin along x */
static fw_flexure_beam thin(int npiece) {
    return (fw_flexure_beam){
        .npiece = npiece, .depth_m = 1, .youngs_Pa = 12, .shear_Pa = 1, .inextensible = true};
}

static void one(rig *r, double length, double curvature, const double *point, bool hinged) {
    *r = (rig){.beam = thin(1)};
    r->piece[0] = (fw_flexure_beam_piece){
        .length_m = length, .curvature_per_m = curvature, .width_m = {1, 1, 1}};
    begin(r, point, hinged);
}

static void wild(rig *r) {
    *r = (rig){.beam = {.npiece = 1 + (int)uniform(0, 2.999),
                        .psi_rad = uniform(-3, 3),
                        .depth_m = 0.1,
                        .youngs_Pa = 1e9,
                        .shear_Pa = 4e8,
                        .root_m = {uniform(-0.01, 0.02), uniform(-0.01, 0.02)}}};
    double t = uniform(0.02, 0.05);
    for (int i = 0; i < r->beam.npiece; i++)
        r->piece[i] = (fw_flexure_beam_piece){
            .length_m = uniform(0.3, 1) / r->beam.npiece,
            .curvature_per_m = uniform(-5, 5) * r->beam.npiece,
            .kink_rad = i ? uniform(-1, 1) : 0,
            .width_m = {t * uniform(0.6, 1.4), t * uniform(0.6, 1.4), t * uniform(0.6, 1.4)}};
    begin(r, NULL, false);
}

/* the error that is told is never below the true one, at any tolerance, and is not idle: it stays
   below the tolerance where the code says so */
static void errors_are_told(void **state) {
    (void)state;
    int loose = 0, finer = 0;
    for (int n = 0; n < 400; n++) {
        rig r;
        fw_flexure_elastica_result exact, rough;
        wild(&r);
        double load = uniform(0.05, 1);
        fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                         {uniform(-1, 1) * load}};
        for (int i = 1; i < 3; i++)
            task.value[i] = uniform(-4, 4) * load / (r.soft * r.length);
        fw_flexure_elastica_solve(r.e, &task, 1e-13, false, &exact);
        assert_true(exact.code <= FW_ELASTICA_ROUGH);
        for (double tolerance = 1e-11; tolerance < 1e-3; tolerance *= 100) {
            fw_flexure_elastica_solve(r.e, &task, tolerance, false, &rough);
            assert_int_equal(rough.code, FW_ELASTICA_OK);
            assert_true(rough.error <= tolerance);
            for (int i = 0; i < 3; i++) {
                double off = fabs(rough.twist[i] - exact.twist[i]);
                assert_true(off <= rough.twist_error[i] + exact.twist_error[i]);
                off = fabs(rough.wrench[i] - exact.wrench[i]);
                assert_true(off <= rough.wrench_error[i] + exact.wrench_error[i]);
            }
            loose += rough.error > 1e-12;
            finer += rough.mesh < exact.mesh;
        }
        fw_arena_free(r.arena);
    }
    assert_true(loose > 100 && finer > 100);
}

/* from the last state the same result as from none, in fewer passes */
static void warm_is_cold(void **state) {
    (void)state;
    long passes[2] = {0, 0};
    for (int n = 0; n < 20; n++) {
        rig r;
        fw_flexure_elastica_result at[2];
        wild(&r);
        fw_flexure_elastica *other = NULL;
        assert_int_equal(fw_flexure_elastica_new(r.arena, &r.beam, NULL, false, &other), FW_OK);
        double phase = uniform(0, 6);
        for (int i = 0; i < 40; i++) {
            double a = phase + 0.02 * i;
            const double wrench[3] = {0.3 / r.soft * sin(a), cos(a) / (r.soft * r.length),
                                      sin(2 * a) / (r.soft * r.length)};
            fw_flexure_elastica_of_wrench(r.e, wrench, 1e-9, true, &at[0]);
            fw_flexure_elastica_of_wrench(other, wrench, 1e-9, false, &at[1]);
            for (int w = 0; w < 2; w++) {
                assert_int_equal(at[w].code, FW_ELASTICA_OK);
                passes[w] += at[w].passes;
            }
            for (int k = 0; k < 3; k++)
                assert_near(at[0].twist[k], at[1].twist[k],
                            at[0].twist_error[k] + at[1].twist_error[k]);
        }
        fw_arena_free(r.arena);
    }
    assert_true(passes[0] < passes[1]);
}

/* A leaf hardly stretches: the place of its end is met by Newton's method all the same, without
   load steps, along its chord only where there is force */
static void leaves_are_met_at_once(void **state) {
    (void)state;
    for (int n = 0; n < 60; n++) {
        double t = 8 * um, L = 471 * um, angle = uniform(-3, 3);
        rig r = {.beam = {.npiece = 1,
                          .psi_rad = angle,
                          .depth_m = 50 * um,
                          .youngs_Pa = 169e9,
                          .shear_Pa = 69e9}};
        r.piece[0] = (fw_flexure_beam_piece){.length_m = L, .width_m = {t, t, t}};
        begin(&r, NULL, false);
        fw_flexure_elastica_result at[2];
        for (int i = 0; i < 10; i++) {
            const fw_flexure_elastica_task task = {
                {FW_END_THETA, FW_END_FX, FW_END_FY},
                {0.2 * sin(n + 0.2 * i), 3e-4 * cos(n + 0.1 * i), 3e-4 * sin(n + 0.3 * i)}};
            fw_flexure_elastica_solve(r.e, &task, 1e-11, false, &at[0]);
            assert_true(at[0].code <= FW_ELASTICA_ROUGH);
            fw_flexure_elastica_of_twist(r.e, at[0].twist, 1e-8, i > 4, &at[1]);
            assert_int_equal(at[1].code, FW_ELASTICA_OK);
            assert_int_equal(at[1].steps, 0);
            assert_true(at[1].passes < 40);
            for (int k = 0; k < 3; k++)
                assert_near(at[1].wrench[k], at[0].wrench[k],
                            at[1].wrench_error[k] + at[0].wrench_error[k] +
                                1e-9 * (k ? 3e-4 : fabs(at[0].wrench[0])));
        }
        fw_arena_free(r.arena);
    }
}

/* Half of a shallow arch, its apex guided downwards: it snaps. Held at a place instead, the apex
   can be led past the limit; the greatest load there is where the loaded one stops. */
static void limits_are_told(void **state) {
    (void)state;
    rig r;
    fw_flexure_elastica_result at;
    const fw_flexure_elastica_end force[3] = {FW_END_THETA, FW_END_UX, FW_END_FY};
    one(&r, 1, -0.5, NULL, false); /* 0.245 high: turned over it is 0.49 away */
    double most = 0, least = 0;
    bool past = false;
    for (int i = 1; i <= 1000; i++) {
        const double twist[3] = {0, 0, 0.00047 * i};
        fw_flexure_elastica_of_twist(r.e, twist, 1e-8, i > 1, &at);
        assert_int_equal(at.code, FW_ELASTICA_OK);
        assert_true(at.stability > 0);
        if (at.wrench[2] < most && i < 500) past = true;
        if (!past) most = fmax(most, at.wrench[2]);
        least = past ? fmin(least, at.wrench[2]) : at.wrench[2];
    }
    assert_true(past && least < 0.5 * most && at.wrench[2] > most); /* it has snapped through */
    for (int i = 0; i < 2; i++) {
        fw_flexure_elastica_task task = {{force[0], force[1], force[2]},
                                         {0, 0, (i ? 1.5 : 0.999) * most}};
        fw_flexure_elastica_solve(r.e, &task, 1e-9, false, &at);
        assert_int_equal(at.code, i ? FW_ELASTICA_LIMIT : FW_ELASTICA_OK);
        assert_near(at.reached, i ? 1 / 1.5 : 1, 1e-3);
        assert_true(at.stability > 0);
    }
    assert_true(at.stability < 0.2); /* it goes to 0 with the root of what is left to the limit */
    assert_relative(at.wrench[2], most, 1e-3);
    fw_arena_free(r.arena);
}

/* A clamped arc of 270 degrees under a force at its tip: the linear answer leads Newton's method to
   other equilibria; in many small load steps, each from the one before, it goes where the solver
   goes at once. */
static void primary_branch(void **state) {
    (void)state;
    const double angle = 1.5 * M_PI, tip[2] = {sin(angle), 1 - cos(angle)};
    for (int n = 0; n < 24; n++) {
        rig r;
        fw_flexure_elastica_result at, steps;
        one(&r, angle, 1, tip, false);
        double a = n * M_PI / 12, f[2] = {0.5 * cos(a), 0.5 * sin(a)};
        for (int i = 1; i <= 200; i++) {
            const double wrench[3] = {0, f[0] * i / 200, f[1] * i / 200};
            fw_flexure_elastica_of_wrench(r.e, wrench, 1e-9, i > 1, &steps);
            assert_int_equal(steps.code, FW_ELASTICA_OK);
        }
        const double wrench[3] = {0, f[0], f[1]};
        fw_flexure_elastica_of_wrench(r.e, wrench, 1e-9, false, &at);
        assert_int_equal(at.code, FW_ELASTICA_OK);
        for (int k = 0; k < 3; k++)
            assert_near(at.twist[k], steps.twist[k], 1e-8);
        assert_true(at.stability > 0);
        fw_arena_free(r.arena);
    }
}

/* a moment winds an arc to one of another radius: place, rotation and strain everywhere */
static void inside_a_wound_arc(void **state) {
    (void)state;
    rig r = {.beam = {.npiece = 1, .depth_m = 50 * um, .youngs_Pa = 169e9, .shear_Pa = 69e9}};
    double R = 100 * um, L = 1.5 * M_PI * R, t = 8 * um;
    r.piece[0] =
        (fw_flexure_beam_piece){.length_m = L, .curvature_per_m = 1 / R, .width_m = {t, t, t}};
    begin(&r, NULL, false);
    double M = 0.3 / r.soft, EI = L / r.soft, k = 1 / R + M / EI;
    const double wrench[3] = {M, 0, 0};
    fw_flexure_elastica_result at;
    fw_flexure_elastica_of_wrench(r.e, wrench, 1e-10, false, &at);
    assert_relative(at.twist[0], 0.3, 1e-14);
    for (int i = 0; i <= 20; i++) {
        fw_flexure_elastica_state in;
        double s = L * i / 20;
        fw_flexure_elastica_at(r.e, s, &in);
        assert_near(in.pose.x_m, sin(k * s) / k, 1e-14 * R);
        assert_near(in.pose.y_m, (1 - cos(k * s)) / k, 1e-14 * R);
        assert_near(in.pose.psi_rad, k * s, 1e-13);
        assert_relative(in.moment_Nm, M, 1e-13);
        assert_near(in.strain[0], -0.5 * t * M / EI, 1e-16);
        assert_near(in.strain[1], 0.5 * t * M / EI, 1e-16);
    }
    assert_relative(fw_flexure_elastica_energy_J(r.e), 0.5 * M * 0.3, 1e-13);
    fw_arena_free(r.arena);
}

/* sections by the polynomials of the solution against those integrated afresh, of any beam at any
   load, ends and corners of pieces among them */
static void forces_along_are_those_at(void **state) {
    (void)state;
    enum { PLACES = 41 };
    for (int n = 0; n < 40; n++) {
        rig r;
        fw_flexure_elastica_result at;
        double part[PLACES], M[PLACES], N[PLACES], most = 0, pull = 0;
        wild(&r);
        const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                               {uniform(-0.6, 0.6),
                                                uniform(-2, 2) / (r.soft * r.length),
                                                uniform(-2, 2) / (r.soft * r.length)}};
        fw_flexure_elastica_solve(r.e, &task, 1e-9, false, &at);
        if (at.code > FW_ELASTICA_ROUGH) continue;
        for (int i = 0; i < PLACES; i++)
            part[i] = i / (PLACES - 1.0);
        fw_flexure_elastica_along(r.e, PLACES, part, M, N);
        for (int i = 0; i < PLACES; i++)
            most = fmax(most, fabs(M[i])), pull = fmax(pull, fabs(N[i]));
        for (int i = 0; i < PLACES; i++) {
            fw_flexure_elastica_state in;
            fw_flexure_elastica_at(r.e, part[i] * r.length, &in);
            assert_near(M[i], in.moment_Nm, 2e-7 * most);
            assert_near(N[i], in.axial_N, 2e-7 * pull);
        }
        fw_arena_free(r.arena);
    }
}

/* From one solution to the next along a motion, section forces are those of a beam that is asked afresh, to the
   tolerance; a step from a solution whose error is known says yes nearly always, and a solution
   that goes on from there is the fresh one's, too */
static void again_is_afresh(void **state) {
    (void)state;
    enum { PLACES = 17, STEPS = 30 };
    const double tolerance = 1e-5;
    int asked = 0, followed = 0;
    for (int n = 0; n < 30; n++) {
        rig r;
        fw_flexure_elastica *fresh = NULL;
        fw_flexure_elastica_result at;
        double part[PLACES], M[2][PLACES], N[2][PLACES];
        double turn = uniform(-0.4, 0.4), pull = uniform(-2, 2), phase = uniform(0, 6);
        wild(&r);
        assert_int_equal(fw_flexure_elastica_new(r.arena, &r.beam, NULL, false, &fresh), FW_OK);
        for (int i = 0; i < PLACES; i++)
            part[i] = i / (PLACES - 1.0);
        for (int i = 0; i < STEPS; i++) {
            double a = phase + 0.03 * i, force = pull / (r.soft * r.length);
            const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                                   {turn * (1 + 0.4 * sin(a)), force * cos(a), force * sin(2 * a)}};
            fw_flexure_elastica_solve(fresh, &task, 1e-11, false, &at);
            if (at.code > FW_ELASTICA_ROUGH) break;
            asked += i > 0;
            fw_flexure_elastica_result again;
            if (i > 0 && fw_flexure_elastica_again(r.e, &task, tolerance, &again)) {
                followed++;
                double size = hypot(at.twist[1], at.twist[2]) + fabs(at.twist[0]) * r.length;
                assert_near(again.twist[1], at.twist[1], tolerance * size);
                assert_near(again.twist[2], at.twist[2], tolerance * size);
                assert_near(again.start_Nm, at.start_Nm, tolerance * (fabs(at.start_Nm) + fabs(at.wrench[0]) + fabs(force) * r.length));
            } else
                fw_flexure_elastica_solve(r.e, &task, 1e-8, false, &at);
            fw_flexure_elastica_along(r.e, PLACES, part, M[0], N[0]);
            fw_flexure_elastica_along(fresh, PLACES, part, M[1], N[1]);
            double most = 0, axial = fabs(force);
            for (int k = 0; k < PLACES; k++)
                most = fmax(most, fabs(M[1][k]));
            for (int k = 0; k < PLACES; k++) {
                assert_near(M[0][k], M[1][k], tolerance * (most + axial * r.length));
                assert_near(N[0][k], N[1][k], tolerance * axial);
            }
            if (i % 7 != 6) continue;
            fw_flexure_elastica_result warm;
            fw_flexure_elastica_solve(r.e, &task, 1e-9, true, &warm);
            assert_true(warm.code <= FW_ELASTICA_ROUGH);
            assert_near(warm.wrench[0], at.wrench[0], 1e-7 * (most + axial * r.length));
        }
        fw_arena_free(r.arena);
    }
    assert_true(asked > 500 && followed > 0.9 * asked);
}

/* the peak against 4000 places and the ends of the pieces; every section in
 * balance with the end */
static void inside_any_beam(void **state) {
    (void)state;
    for (int n = 0; n < 25; n++) {
        rig r;
        fw_flexure_elastica_result at;
        fw_flexure_elastica_state peak, in;
        wild(&r);
        const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                               {uniform(-0.4, 0.4),
                                                uniform(-1, 1) / (r.soft * r.length),
                                                uniform(-1, 1) / (r.soft * r.length)}};
        fw_flexure_elastica_solve(r.e, &task, 1e-11, false, &at);
        assert_true(at.code <= FW_ELASTICA_ROUGH);
        fw_flexure_elastica_peak_strain(r.e, &peak);
        double top = fmax(fabs(peak.strain[0]), fabs(peak.strain[1])), most = 0;
        const double *w = fw_flexure_elastica_linear(r.e)->centre_m;
        double ends = 0;
        for (int i = 0; i < 2 * r.beam.npiece + 4000; i++) {
            double s = r.length * i / 4000;
            if (i >= 4000) { /* both sides of every kink */
                if (i % 2 == 0) ends += r.piece[(i - 4000) / 2].length_m;
                s = ends * (1 + (i % 2 ? 1e-12 : -1e-12));
            }
            fw_flexure_elastica_at(r.e, s, &in);
            most = fmax(most, fmax(fabs(in.strain[0]), fabs(in.strain[1])));
            double x = w[0] + at.twist[1] - in.pose.x_m, y = w[1] + at.twist[2] - in.pose.y_m;
            double M = at.wrench[0] + x * at.wrench[2] - y * at.wrench[1];
            assert_near(in.moment_Nm * r.soft, M * r.soft, 1e-10);
        }
        assert_true(top >= most * (1 - 1e-9) && top <= most * (1 + 1e-6));
        double there = 0;
        for (int side = -1; side <= 1; side += 2) {
            fw_flexure_elastica_at(r.e, peak.s_m * (1 + side * 1e-12), &in);
            there = fmax(there, fmax(fabs(in.strain[0]), fabs(in.strain[1])));
        }
        assert_relative(there, top, 1e-9);
        fw_arena_free(r.arena);
    }
}

static void nothing_gives_nothing(void **state) {
    (void)state;
    rig r;
    fw_flexure_elastica_result at;
    const double none[3] = {0};
    wild(&r);
    for (int warm = 0; warm < 2; warm++) {
        fw_flexure_elastica_of_twist(r.e, none, 1e-9, warm, &at);
        assert_int_equal(at.code, FW_ELASTICA_OK);
        for (int i = 0; i < 3; i++) {
            assert_near(at.wrench[i], 0, 0);
            /* the tangent at rest is the inverse of the compliance */
            const fw_flexure_beam_linear *lin = fw_flexure_elastica_linear(r.e);
            for (int j = 0; j < 3; j++) {
                double sum = 0, size = 0;
                for (int k = 0; k < 3; k++) {
                    sum += at.stiffness[i][k] * lin->c[k][j];
                    size += fabs(at.stiffness[i][k] * lin->c[k][j]);
                }
                assert_near(sum, i == j, 1e-9 * size + 1e-9);
            }
        }
    }
    fw_arena_free(r.arena);
}

static fw_flexure_elastica_code code_of(fw_flexure_elastica *e, fw_flexure_elastica_end a,
                                        fw_flexure_elastica_end b, fw_flexure_elastica_end c,
                                        double value) {
    const fw_flexure_elastica_task task = {{a, b, c}, {value, value, value}};
    fw_flexure_elastica_result at;
    fw_flexure_elastica_solve(e, &task, 1e-9, false, &at);
    return at.code;
}

static void what_is_refused(void **state) {
    (void)state;
    rig r;
    one(&r, 1, 0, NULL, false); /* straight, cannot stretch: no place along it can be asked for */
    assert_int_equal(code_of(r.e, FW_END_THETA, FW_END_UX, FW_END_UY, 0.1), FW_ELASTICA_LOOSE);
    assert_int_equal(code_of(r.e, FW_END_THETA, FW_END_THETA, FW_END_UY, 0.1), FW_ELASTICA_LOOSE);
    assert_int_equal(code_of(r.e, FW_END_M, FW_END_FX, FW_END_FY, (double)NAN), FW_ELASTICA_LOOSE);
    assert_int_equal(code_of(r.e, FW_END_M, FW_END_FX, FW_END_FY, 0.1), FW_ELASTICA_OK);
    fw_arena_free(r.arena);
    one(&r, 1, 0, NULL, true); /* on a hinge, and nothing but forces */
    assert_int_equal(code_of(r.e, FW_END_M, FW_END_FX, FW_END_FY, 0.1), FW_ELASTICA_LOOSE);
    assert_int_equal(code_of(r.e, FW_END_THETA, FW_END_FX, FW_END_FY, 0.1), FW_ELASTICA_OK);
    fw_arena_free(r.arena);
    one(&r, 1, 0.3, NULL, false); /* further away than it is long */
    assert_true(code_of(r.e, FW_END_THETA, FW_END_UX, FW_END_UY, 2) >= FW_ELASTICA_LIMIT);
    fw_arena_free(r.arena);
}

/* every allocation that fails is said */
static void memory_runs_out(void **state) {
    (void)state;
    rig r;
    fw_flexure_elastica *e = NULL;
    one(&r, 1, 0.3, NULL, false);
    int failures = 0;
    for (long n = 1; n < 20; n++) {
        fw_arena_fail_at(n, 1);
        fw_status status = fw_flexure_elastica_new(r.arena, &r.beam, NULL, false, &e);
        fw_arena_fail_at(0, 0);
        if (status == FW_OK) break;
        assert_int_equal(status, FW_NOMEM);
        failures++;
    }
    assert_true(failures >= 3);
    fw_arena_free(r.arena);
}

/* A leaf pulled by N along its chord and turned by a little bends as a column,
   M(xi) = M0 cosh z (2 xi - 1)/cosh z, z^2 = N (1 + d N) L^2/4 EI, whatever N: to z = 35, where what the first root's
   moment changes has grown by 1e30 at the other one */
static void strongly_pulled(void **state) {
    (void)state;
    const double L = 600 * um, t = 5 * um, h = 20 * um, E = 1e11, G = 4e10, dL = 1.2 * um, th = 1e-6;
    const double EA = E * h * t, EI = EA * t * t / 12, d = 1 / EA - 1.2 / (G * h * t);
    for (double strain = 1e-4; strain < 0.025; strain *= 1.3) {
        double N = strain * EA, q = N * (1 + d * N), z = 0.5 * L * sqrt(q / EI), stretch = strain * L;
        double M0 = th / (L / EI * tanh(z) / z + 2 * dL / EI);
        rig r = {.beam = {.npiece = 1, .depth_m = h, .youngs_Pa = E, .shear_Pa = G, .root_m = {dL, dL}}};
        r.piece[0] = (fw_flexure_beam_piece){.length_m = L, .width_m = {t, t, t}};
        begin(&r, NULL, false);
        /* along x: the chord stays half way between both bodies */
        const double twist[3] = {th, stretch * cos(0.5 * th), stretch * sin(0.5 * th)};
        const double guess[3] = {M0, N, 0}, part[] = {0, 0.25, 0.5, 0.75, 1};
        const fw_flexure_elastica_task place = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                                {twist[0], twist[1], twist[2]}};
        const fw_flexure_elastica_task force = {{FW_END_THETA, FW_END_FX, FW_END_FY},
                                                {th, N * cos(0.5 * th), N * sin(0.5 * th)}};
        for (int i = 0; i < 2; i++) {
            fw_flexure_elastica_result out;
            double M[5], along[5];
            fw_flexure_elastica_near(r.e, i ? &force : &place, twist, guess, 1e-8, &out);
            assert_int_equal(out.code, FW_ELASTICA_OK);
            fw_flexure_elastica_along(r.e, 5, part, M, along);
            for (int k = 0; k < 5; k++) {
                double wanted = M0 * cosh(z * (2 * part[k] - 1)) / cosh(z);
                assert_true(fabs(M[k] - wanted) < 1e-5 * M0);
                assert_true(fabs(along[k] / N - 1) < 1e-6);
            }
            for (int k = 0; k < 9; k++) {
                double a = out.stiffness[k / 3][k % 3], b = out.stiffness[k % 3][k / 3];
                assert_true(fabs(a - b) <= 1e-6 * (fabs(a) + fabs(b)));
            }
            fw_flexure_elastica_state end;
            fw_flexure_elastica_at(r.e, L, &end);
            assert_true(fabs(end.moment_Nm - M0) < 1e-5 * M0);
            double U = 0.5 * N * stretch + 0.5 * M0 * th;
            assert_true(fabs(fw_flexure_elastica_energy_J(r.e) / U - 1) < 1e-6);
        }
        fw_arena_free(r.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_told),
        cmocka_unit_test(warm_is_cold),
        cmocka_unit_test(leaves_are_met_at_once),
        cmocka_unit_test(limits_are_told),
        cmocka_unit_test(strongly_pulled),
        cmocka_unit_test(primary_branch),
        cmocka_unit_test(inside_a_wound_arc),
        cmocka_unit_test(inside_any_beam),
        cmocka_unit_test(nothing_gives_nothing),
        cmocka_unit_test(what_is_refused),
        cmocka_unit_test(memory_runs_out),
        cmocka_unit_test(forces_along_are_those_at), /* last: they draw from the same numbers */
        cmocka_unit_test(again_is_afresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
