/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact beam's law on a lattice of its solutions, against the beam itself at random places: its
   forces, its tangent, that these are derivatives of its energy, across faces of cells too, and that it
   does not depend on what was asked for before. */
#include "flexure/beam.h"
#include "flexure/finite.h"
#include "flexure/path.h"
#include "strip_input.h"
#include "test.h"
#include <math.h>
#include <string.h>

typedef struct strip { /* of length 1 mm */
    fw_flexure_input in;
    fw_flexure_result closed;
    fw_flexure_hinge_law law;
    fw_flexure_hinge_rest rest;
    fw_flexure_beam beam;
    fw_flexure_elastica *direct, *own;
    fw_flexure_chart *chart;
    fw_arena *arena;
    double unit[3]; /* N m, N, N: K for a rotation of 1, K/L */
} strip;

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static void strip_new(strip *s, double angle_deg, double slender, double fillet, double crystal) {
    const double L = 1e-3;
    *s = (strip){.arena = fw_arena_new(0)};
    s->in = strip_input(L, angle_deg, slender, fillet);
    if (!isnan(crystal)) s->in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, crystal);
    fw_flexure_closed_form(&s->in, &s->closed);
    fw_flexure_hinge_law_of(&s->in, &s->closed, &s->law);
    s->rest = fw_flexure_hinge_rest_of(&s->law);
    assert_int_equal(fw_flexure_beam_of_input(s->arena, &s->in, &s->closed, &s->beam), FW_OK);
    const double pin[2] = {s->closed.centre_m + s->closed.offset_m[0], s->closed.offset_m[1]};
    assert_int_equal(fw_flexure_elastica_new(s->arena, &s->beam, pin, false, &s->direct), FW_OK);
    assert_int_equal(fw_flexure_elastica_new(s->arena, &s->beam, pin, false, &s->own), FW_OK);
    assert_int_equal(fw_flexure_chart_new(s->arena, &s->law, s->own, &s->chart), FW_OK);
    s->unit[0] = s->law.stiffness_Nm_per_rad;
    s->unit[1] = s->unit[2] = s->unit[0] / L;
}

/* a place up to 0.3 rad, eight hundredths of the length, and eight times EI/L^2 of force; false: the
   closed form has none */
static bool place(const strip *s, unsigned *seed, double at[3]) {
    double u[2], moment, pull, L = s->in.length_m, F = 8 * random_(seed) * s->unit[1];
    at[0] = 0.3 * random_(seed), at[1] = 0.08 * L * random_(seed);
    if (!fw_flexure_hinge_law_held(&s->law, &s->rest, at[0], F, at[1], u, &moment, &pull))
        return false;
    at[2] = u[1];
    return true;
}

static void twist_of(const double at[3], double twist[3]) {
    double c = cos(0.5 * at[0]), s = sin(0.5 * at[0]);
    twist[0] = at[0], twist[1] = c * at[1] - s * at[2], twist[2] = s * at[1] + c * at[2];
}

static const struct shape {
    double angle_deg, slender, fillet, crystal;
} shapes[] = {{0, 1 / 120.0, 0.5, (double)NAN}, {0, 1 / 20.0, 0.5, (double)NAN},   {90, 1 / 30.0, 0.5, (double)NAN},
              {180, 1 / 40.0, -1, (double)NAN}, {270, 1 / 20.0, 0.5, 0.4}, {270, 1 / 60.0, 0.5, (double)NAN}};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static void shape_new(strip *s, int i) {
    strip_new(s, shapes[i].angle_deg, shapes[i].slender, shapes[i].fillet, shapes[i].crystal);
}

/* Forces of the lattice and of the beam in the same place: of themselves, of what 10 mrad take, and,
   where a strip is stiff along its chord, of what a tenth of a nanometre in a millimetre asks for */
static void forces_are_the_beam_s(void **state) {
    (void)state;
    unsigned seed = 1;
    for (int i = 0; i < SHAPES; i++) {
        strip s;
        int known = 0, asked = 0;
        shape_new(&s, i);
        for (int n = 0; n < 60; n++) {
            double at[3], twist[3], near[3], wrench[3], tangent[3][3];
            fw_flexure_elastica_result r;
            fw_flexure_hinge_bent b;
            if (n % 6 == 0) /* places all over: each lattice has room for some */
                assert_int_equal(fw_flexure_chart_new(s.arena, &s.law, s.own, &s.chart), FW_OK);
            if (!place(&s, &seed, at)) continue;
            twist_of(at, twist);
            fw_flexure_hinge_law_wrench(&s.law, &s.rest, twist, near, NULL);
            const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                                   {twist[0], twist[1], twist[2]}};
            fw_flexure_elastica_near(s.direct, &task, twist, near, 1e-11, &r);
            if (r.code != FW_ELASTICA_OK && r.code != FW_ELASTICA_ROUGH) continue;
            asked++;
            if (!fw_flexure_chart_bend(s.chart, at, true, &b)) continue;
            known++;
            const fw_flexure_half_turned half = fw_flexure_hinge_half_turned(twist);
            fw_flexure_hinge_wrench_of(&b, &half, wrench, tangent);
            double ky = b.hessian[2][2], slack = 1e-10 * s.in.length_m * ky;
            for (int k = 0; k < 3; k++) {
                double arm = k == 0 ? s.in.length_m : 1, far = k == 0 ? 0.1 : 1;
                double size = fabs(r.wrench[k]) + 1e-2 * s.unit[k];
                assert_true(fabs(wrench[k] - r.wrench[k]) < 5e-6 * size + far * arm * slack * 4);
                for (int j = 0; j < 3; j++) {
                    double norm = sqrt(fabs(r.stiffness[k][k] * r.stiffness[j][j]));
                    assert_near(tangent[k][j] / norm, r.stiffness[k][j] / norm, 2e-4);
                }
            }
        }
        assert_true(asked > 40);
        assert_true(known >= 0.8 * asked);
        fw_arena_free(s.arena);
    }
}

/* the gradient is that of the energy, and the tangent that of the gradient, within cells and across
   their faces: along lines that cross many of them, by differences of either side */
static void one_potential(void **state) {
    (void)state;
    unsigned seed = 7;
    for (int i = 0; i < SHAPES; i++) {
        strip s;
        shape_new(&s, i);
        double L = s.in.length_m, step[3] = {1e-5, 1e-5 * L, 0};
        for (int n = 0; n < 40; n++) {
            double at[3];
            fw_flexure_hinge_bent b, side[2];
            if (!place(&s, &seed, at) || !fw_flexure_chart_bend(s.chart, at, true, &b)) continue;
            step[2] = 1e-3 * s.unit[1] / b.hessian[2][2];
            for (int k = 0; k < 3; k++) {
                double there = at[k];
                bool both = true;
                for (int j = 0; j < 2; j++) {
                    at[k] = there + (j ? step[k] : -step[k]);
                    both = both && fw_flexure_chart_bend(s.chart, at, false, &side[j]);
                }
                at[k] = there;
                if (!both) continue;
                double slope = (side[1].energy_J - side[0].energy_J) / (2 * step[k]);
                double size = fabs(b.gradient[k]) + 1e-2 * s.unit[k];
                assert_near(slope / size, b.gradient[k] / size, 2e-5);
                for (int j = 0; j < 3; j++) {
                    double curve = (side[1].gradient[j] - side[0].gradient[j]) / (2 * step[k]);
                    double norm = sqrt(fabs(b.hessian[k][k] * b.hessian[j][j]));
                    assert_near(curve / norm, b.hessian[k][j] / norm, 2e-4);
                }
            }
        }
        fw_arena_free(s.arena);
    }
}

/* on a line through many cells the forces have no steps: from either side of a face nothing jumps
   beyond what the way between the two places makes */
static void no_steps_at_faces(void **state) {
    (void)state;
    strip s;
    shape_new(&s, 4);
    double before[3] = {0}, slope[3] = {0}, d = 1e-4;
    int row = 0, known = 0; /* in a row; in all */
    for (int n = 0; n < 4000; n++) {
        double th = -0.2 + n * d, at[3] = {th, 0.02 * s.in.length_m * sin(9 * th), 0};
        double u[2], moment, pull;
        fw_flexure_hinge_bent b;
        assert_true(fw_flexure_hinge_law_held(&s.law, &s.rest, th, 2 * sin(7 * th) * s.unit[1], at[1],
                                              u, &moment, &pull));
        at[2] = u[1];
        row = fw_flexure_chart_bend(s.chart, at, false, &b) ? row + 1 : 0;
        known += row > 0;
        for (int k = 0; row > 0 && k < 3; k++) {
            double now = (b.gradient[k] - before[k]) / s.unit[k];
            /* second differences of a smooth way: d^2 times some tens */
            if (row > 2) assert_true(fabs(now - slope[k]) < 200 * d * d);
            slope[k] = now, before[k] = b.gradient[k];
        }
    }
    assert_true(known > 3600);
    fw_arena_free(s.arena);
}

/* to the last bit, whichever places were asked for before, and by which strip of the same shape */
static void the_place_alone(void **state) {
    (void)state;
    enum { PLACES = 30 };
    unsigned seed = 3;
    strip s, other;
    double at[PLACES][3];
    fw_flexure_hinge_bent b[PLACES], again;
    bool known[PLACES];
    shape_new(&s, 2), shape_new(&other, 2);
    for (int i = 0; i < PLACES; i++) {
        while (!place(&s, &seed, at[i])) {}
        known[i] = fw_flexure_chart_bend(s.chart, at[i], false, &b[i]);
    }
    for (int i = 0; i < 400; i++) {
        int n = ((int)(random_(&seed) * PLACES / 2) + PLACES / 2) % PLACES;
        fw_flexure_chart *of = i % 2 ? s.chart : other.chart;
        assert_int_equal(fw_flexure_chart_bend(of, at[n], false, &again), known[n]);
        if (!known[n]) continue;
        assert_memory_equal(again.gradient, b[n].gradient, sizeof again.gradient);
        assert_memory_equal(&again.energy_J, &b[n].energy_J, sizeof again.energy_J);
    }
    fw_arena_free(s.arena), fw_arena_free(other.arena);
}

/* where the beam has no equilibrium the lattice says nothing */
static void not_beyond_buckling(void **state) {
    (void)state;
    strip s;
    fw_flexure_hinge_bent b;
    shape_new(&s, 0);
    const double L = s.in.length_m, pressed[3] = {0, 0, -0.01 * L}, far[3] = {0.1, 0.6 * L, 0};
    const double wild[3] = {(double)NAN, 0, 0}, farther[3] = {0, 1e12, 0};
    assert_false(fw_flexure_chart_bend(s.chart, pressed, false, &b));
    assert_false(fw_flexure_chart_bend(s.chart, far, false, &b));
    assert_false(fw_flexure_chart_bend(s.chart, wild, false, &b));
    assert_false(fw_flexure_chart_bend(s.chart, farther, false, &b));
    fw_arena_free(s.arena);
}

/* where every question is about another place there is an end of corners, and the beam is asked: what
   was found before stays */
static void an_end_of_corners(void **state) {
    (void)state;
    unsigned seed = 5;
    int late = 0;
    strip s;
    double first[3] = {0.01, 0, 0}, at[3];
    fw_flexure_hinge_bent b, again;
    shape_new(&s, 3);
    assert_true(fw_flexure_chart_bend(s.chart, first, false, &b));
    for (int n = 0; n < 300; n++)
        if (place(&s, &seed, at) && fw_flexure_chart_bend(s.chart, at, false, &again) && n >= 200) late++;
    assert_true(late < 50);
    for (int n = 0; n < 200000; n++) /* who asks often is answered */
        (void)fw_flexure_chart_bend(s.chart, first, false, &again);
    assert_true(fw_flexure_chart_bend(s.chart, first, false, &again));
    assert_memory_equal(again.gradient, b.gradient, sizeof b.gradient);
    fw_arena_free(s.arena);
}

/* A slender leaf whose ends lose something of their stiffness (silicon) is pulled harder and harder: its
   lattice has the steps of any other, so that the whole way is in it */
static void a_pulled_leaf_of_silicon(void **state) {
    (void)state;
    enum { QUESTIONS = 4000 };
    strip s;
    int known = 0;
    strip_new(&s, 0, 1 / 148.0, 0.36, 0.08);
    for (int n = 0; n < QUESTIONS; n++) {
        double part = (double)n / QUESTIONS, w = 0.02 * part * s.in.length_m, u[2], moment, pull;
        fw_flexure_hinge_bent b;
        assert_true(fw_flexure_hinge_law_held(&s.law, &s.rest, 0, 500 * part * s.unit[1], w, u, &moment, &pull));
        const double at[3] = {0, w, u[1]};
        known += fw_flexure_chart_bend(s.chart, at, false, &b);
    }
    if (known < 0.98 * QUESTIONS) fail_msg("%d of %d", known, QUESTIONS);
    fw_arena_free(s.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pulled_leaf_of_silicon),
        cmocka_unit_test(forces_are_the_beam_s), cmocka_unit_test(one_potential),
        cmocka_unit_test(no_steps_at_faces),     cmocka_unit_test(the_place_alone),
        cmocka_unit_test(not_beyond_buckling),   cmocka_unit_test(an_end_of_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
