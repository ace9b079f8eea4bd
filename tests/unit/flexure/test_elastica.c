/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The geometrically exact beam: against tables of hinges (mpmath, 28 digits; um, uN, rad there),
   against an integration of its own equations by another method, and identities on random beams. */
#include "flexure/beam.h"
#include "test.h"

static const double degree = M_PI / 180, um = 1e-6;

static const fw_flexure_elastica_end turn_and_force[3] = {FW_END_THETA, FW_END_FX, FW_END_FY};

static void solve(fw_flexure_elastica *e, const fw_flexure_elastica_end given[3], const double v[3],
                  double tolerance, fw_flexure_elastica_result *out) {
    const fw_flexure_elastica_task task = {{given[0], given[1], given[2]}, {v[0], v[1], v[2]}};
    fw_flexure_elastica_solve(e, &task, tolerance, false, out);
}

/* ---- random beams, of size 1: 1 to 3 pieces, tapers, kinks, roots, crystals ---- */

static uint64_t seed = 20261120;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) * 0x1p-53;
}

typedef struct wild {
    fw_arena *arena;
    fw_flexure_beam_piece piece[3];
    fw_flexure_beam beam;
    fw_flexure_elastica *e;
    double soft, length; /* C_theta, and the beam's length */
} wild;

static void begin(wild *w) {
    w->arena = fw_arena_new(0);
    w->beam.piece = w->piece;
    assert_int_equal(fw_flexure_elastica_new(w->arena, &w->beam, NULL, false, &w->e), FW_OK);
    w->soft = fw_flexure_elastica_linear(w->e)->c[0][0];
    w->length = fw_flexure_elastica_linear(w->e)->length_m;
}

static void grow(wild *w) {
    *w = (wild){.beam = {.npiece = 1 + (int)uniform(0, 2.999),
                         .x_m = uniform(-1, 1),
                         .y_m = uniform(-1, 1),
                         .psi_rad = uniform(-3, 3),
                         .depth_m = 0.1,
                         .youngs_Pa = 1e9,
                         .shear_Pa = 4e8,
                         .depth_factor = uniform(1, 1.1),
                         .root_m = {uniform(-0.01, 0.02), uniform(-0.01, 0.02)},
                         .cubic = uniform(0, 1) < 0.5,
                         .a0_per_Pa = 1e-9,
                         .a1_per_Pa = 1.3e-10,
                         .orientation_rad = uniform(0, 1)}};
    double t = uniform(0.02, 0.05);
    for (int i = 0; i < w->beam.npiece; i++)
        w->piece[i] = (fw_flexure_beam_piece){
            .length_m = uniform(0.3, 1) / w->beam.npiece,
            .curvature_per_m = uniform(-4, 4) * w->beam.npiece,
            .kink_rad = i ? uniform(-1, 1) : 0,
            .width_m = {t * uniform(0.8, 1.2), t * uniform(0.8, 1.2), t * uniform(0.8, 1.2)}};
    begin(w);
}

static void load(const wild *w, double most, double v[3]) { /* rotation and force */
    v[0] = uniform(-1, 1) * most;
    for (int i = 1; i < 3; i++)
        v[i] = uniform(-3, 3) * most / (w->soft * w->length);
}

/* ---- tables ---- */

static fw_flexure_beam hinge(fw_flexure_beam_piece *piece, char which, bool rigid) {
    bool third = which == '3';
    double r = 100 * um, a = 135 * degree, t = third ? 10 * um : 8 * um;
    double E = third ? 115e9 : 169e9, nu = third ? 0.34 : 0.22;
    *piece = (fw_flexure_beam_piece){
        .length_m = 2 * a * r, .curvature_per_m = 1 / r, .width_m = {t, t, t}};
    return (fw_flexure_beam){.piece = piece,
                             .npiece = 1,
                             .x_m = r * cos(a),
                             .y_m = -r * sin(a),
                             .psi_rad = 0.5 * M_PI - a,
                             .depth_m = third ? 9 * um : 50 * um,
                             .youngs_Pa = E,
                             .shear_Pa = E / (2 * (1 + nu)),
                             .inextensible = rigid};
}

typedef struct entry {
    char which[8], theory[32];
    double th, fx, fy, M, root, tip, x, y, most;
} entry;

/* lengths have 471 um behind them, whose rounding is 1e-13 um: that much is allowed beside 1e-9 */
static void against_entry(const entry *t) {
    const double exact = 1e-9, round = 2e-13;
    fw_flexure_beam_piece piece;
    fw_flexure_beam beam = hinge(&piece, t->which[1], t->theory[0] == 'i');
    fw_arena *arena = fw_arena_new(0);
    fw_flexure_elastica *e = NULL;
    fw_flexure_elastica_result at;
    fw_flexure_elastica_state end;
    assert_int_equal(fw_flexure_elastica_new(arena, &beam, NULL, false, &e), FW_OK);
    const double force[3] = {t->th * degree, t->fx * um, t->fy * um};
    solve(e, turn_and_force, force, 1e-10, &at);
    assert_int_equal(at.code, FW_ELASTICA_OK);
    assert_relative(at.wrench[0] * 1e12, t->M, exact);
    assert_relative(at.start_Nm * 1e12, t->root, exact);
    assert_near(at.twist[1] * 1e6, t->x, exact * fabs(t->x) + round);
    assert_near(at.twist[2] * 1e6, t->y, exact * fabs(t->y) + round);
    fw_flexure_elastica_at(e, piece.length_m, &end);
    assert_relative(end.moment_Nm * 1e12, t->tip, exact);
    fw_flexure_elastica_peak_strain(e, &end);
    assert_true(fabs(end.moment_Nm) * 1e12 > t->most * (1 - 1e-9));

    const double twist[3] = {t->th * degree, t->x * um, t->y * um};
    fw_flexure_elastica_of_twist(e, twist, 1e-8, false, &at);
    assert_int_equal(at.code, FW_ELASTICA_OK);
    assert_relative(at.wrench[0] * 1e12, t->M, exact);
    assert_near(at.wrench[1] * 1e6, t->fx, exact * 100);
    assert_near(at.wrench[2] * 1e6, t->fy, exact * 100);
    const double wrench[3] = {t->M * 1e-12, t->fx * um, t->fy * um};
    fw_flexure_elastica_of_wrench(e, wrench, 1e-10, false, &at);
    assert_int_equal(at.code, FW_ELASTICA_OK);
    assert_relative(at.twist[0], t->th * degree, exact);
    assert_near(at.twist[1] * 1e6, t->x, exact * fabs(t->x) + 10 * round);
    assert_near(at.twist[2] * 1e6, t->y, exact * fabs(t->y) + 10 * round);
    fw_arena_free(arena);
}

static void hinges_match_the_tables(void **state) {
    (void)state;
    char line[600];
    entry t;
    int rows = 0;
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/hinge/ge_hinge_reference.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (; fgets(line, sizeof line, file); rows++) {
        assert_int_equal(sscanf(line, "%7[^,],%31[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", t.which,
                                t.theory, &t.th, &t.fx, &t.fy, &t.M, &t.root, &t.tip, &t.x, &t.y,
                                &t.most),
                         11);
        against_entry(&t);
    }
    fclose(file);
    assert_int_equal(rows, 80);
}

/* rotation and force on arcs of 90, 180 and 270 degrees, inextensible */
static void arcs_match_the_tables(void **state) {
    (void)state;
    char line[600];
    int rows = 0;
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/hinge/prb3theta_check.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (; fgets(line, sizeof line, file); rows++) {
        double angle, th, fx, fy, x, y, M;
        assert_int_equal(
            sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &angle, &th, &fx, &fy, &x, &y, &M), 7);
        fw_flexure_beam_piece piece;
        fw_flexure_beam beam = hinge(&piece, '1', true);
        double a = 0.5 * angle * degree, r = 100 * um;
        piece.length_m = 2 * a * r;
        beam.x_m = r * cos(a), beam.y_m = -r * sin(a), beam.psi_rad = 0.5 * M_PI - a;
        fw_arena *arena = fw_arena_new(0);
        fw_flexure_elastica *e = NULL;
        fw_flexure_elastica_result at;
        const double v[3] = {th * degree, fx * um, fy * um};
        assert_int_equal(fw_flexure_elastica_new(arena, &beam, NULL, false, &e), FW_OK);
        solve(e, turn_and_force, v, 1e-10, &at);
        assert_relative(at.wrench[0] * 1e12, M, 1e-9);
        assert_near(at.twist[1] * 1e6, x, 1e-9 * fabs(x) + 2e-13);
        assert_near(at.twist[2] * 1e6, y, 1e-9 * fabs(y) + 2e-13);
        fw_arena_free(arena);
    }
    fclose(file);
    assert_int_equal(rows, 60);
}

/* ---- another method: Runge and Kutta's, with the sections of the beam as they are ---- */

typedef struct flow {
    double phi, M, x, y;
} flow;

static flow slope(const wild *w, const fw_flexure_beam_pose *start, int piece, double s,
                  const flow *at, const double f[2]) {
    fw_flexure_beam_section c;
    fw_flexure_beam_at(&w->beam, piece, start, s, &c);
    double psi = c.pose.psi_rad + at->phi, N = f[0] * cos(psi) + f[1] * sin(psi);
    double V = f[1] * cos(psi) - f[0] * sin(psi), e = 1 + N * c.axial_per_N, g = V * c.shear_per_N;
    flow d = {at->M * c.bend_per_Nm2, 0, e * cos(psi) - g * sin(psi), e * sin(psi) + g * cos(psi)};
    d.M = f[0] * d.y - f[1] * d.x;
    return d;
}

static flow moved(const flow *a, double h, const flow *d) {
    return (flow){a->phi + h * d->phi, a->M + h * d->M, a->x + h * d->x, a->y + h * d->y};
}

static flow integrate(const wild *w, flow at, const double f[2], int steps) {
    fw_flexure_beam_pose start[4];
    fw_flexure_beam_poses(&w->beam, start);
    for (int p = 0; p < w->beam.npiece; p++)
        for (int i = 0; i < steps; i++) {
            double h = w->piece[p].length_m / steps, s = i * h;
            flow k[4], half = at;
            k[0] = slope(w, &start[p], p, s, &at, f);
            half = moved(&at, 0.5 * h, &k[0]);
            k[1] = slope(w, &start[p], p, s + 0.5 * h, &half, f);
            half = moved(&at, 0.5 * h, &k[1]);
            k[2] = slope(w, &start[p], p, s + 0.5 * h, &half, f);
            half = moved(&at, h, &k[2]);
            k[3] = slope(w, &start[p], p, s + h, &half, f);
            for (int j = 0; j < 4; j++)
                at = moved(&at, h / (j % 3 ? 3 : 6), &k[j]);
        }
    return at;
}

static void another_method_agrees(void **state) {
    (void)state;
    for (int n = 0; n < 60; n++) {
        wild w;
        double v[3];
        fw_flexure_elastica_result at;
        grow(&w);
        load(&w, 0.5, v);
        solve(w.e, turn_and_force, v, 1e-11, &at);
        assert_int_equal(at.code, FW_ELASTICA_OK);
        const fw_flexure_beam_linear *lin = fw_flexure_elastica_linear(w.e);
        fw_flexure_beam_section c[2];
        fw_flexure_beam_pose start[4];
        int last = w.beam.npiece - 1;
        fw_flexure_beam_poses(&w.beam, start);
        fw_flexure_beam_at(&w.beam, 0, &start[0], 0, &c[0]);
        fw_flexure_beam_at(&w.beam, last, &start[last], w.piece[last].length_m, &c[1]);
        flow begin = {at.start_Nm * w.beam.root_m[0] * c[0].bend_per_Nm2, at.start_Nm, w.beam.x_m,
                      w.beam.y_m};
        flow end = integrate(&w, begin, &at.wrench[1], 800);
        double th = end.phi + end.M * w.beam.root_m[1] * c[1].bend_per_Nm2;
        double ax = lin->centre_m[0] - lin->end.x_m, ay = lin->centre_m[1] - lin->end.y_m;
        double bx = cos(th) * ax - sin(th) * ay, by = sin(th) * ax + cos(th) * ay;
        assert_near(th, at.twist[0], 1e-10);
        assert_near(end.x + bx - lin->centre_m[0], at.twist[1], 1e-10);
        assert_near(end.y + by - lin->centre_m[1], at.twist[2], 1e-10);
        double M = end.M - bx * at.wrench[2] + by * at.wrench[1];
        assert_near(M * w.soft, at.wrench[0] * w.soft, 1e-9);
        fw_arena_free(w.arena);
    }
}

/* ---- identities ---- */

static double scale(const wild *w, int i) {
    return i == 0 ? 1 : w->length;
}

/* K is symmetric, and the difference of wrenches to fourth order */
static void tangents_are_derivatives(void **state) {
    (void)state;
    for (int n = 0; n < 40; n++) {
        wild w;
        double v[3];
        fw_flexure_elastica_result at, near[4];
        grow(&w);
        load(&w, 0.5, v);
        solve(w.e, turn_and_force, v, 1e-11, &at);
        double size = 0;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                size = fmax(size, fabs(at.stiffness[i][j]) * scale(&w, i) * scale(&w, j));
        for (int j = 0; j < 3; j++) {
            const double h = 1e-4;
            for (int k = 0; k < 4; k++) {
                double twist[3] = {at.twist[0], at.twist[1], at.twist[2]};
                twist[j] += (k - 1.5 + (k > 1 ? 0.5 : -0.5)) * h * scale(&w, j);
                fw_flexure_elastica_of_twist(w.e, twist, 1e-11, true, &near[k]);
                assert_true(near[k].code <= FW_ELASTICA_ROUGH);
            }
            for (int i = 0; i < 3; i++) {
                double d = (8 * (near[2].wrench[i] - near[1].wrench[i]) - near[3].wrench[i] +
                            near[0].wrench[i]) /
                           (12 * h * scale(&w, j));
                double unit = scale(&w, i) * scale(&w, j);
                assert_near(d * unit, at.stiffness[i][j] * unit, 2e-7 * size);
                assert_near((at.stiffness[i][j] - at.stiffness[j][i]) * unit, 0, 1e-11 * size);
            }
        }
        fw_arena_free(w.arena);
    }
}

/* the energy is the work along a straight way of twists, by ten nodes of Gauss on each eighth;
   energy's own integral knows nothing of the wrench at the end */
static void energy_is_work(void **state) {
    (void)state;
    static const double x[5] = {.1488743389816312, .4333953941292472, .6794095682990244,
                                .8650633666889845, .9739065285171717};
    static const double g[5] = {.2955242247147529, .2692667193099963, .2190863625159820,
                                .1494513491505806, .0666713443086881};
    for (int n = 0; n < 30; n++) {
        wild w;
        double v[3], work = 0;
        fw_flexure_elastica_result end, at;
        grow(&w);
        load(&w, 0.4, v);
        solve(w.e, turn_and_force, v, 1e-11, &end);
        double energy = fw_flexure_elastica_energy_J(w.e);
        for (int i = 0; i < 80; i++) {
            double node = 0.5 * (1 + (i % 2 ? 1 : -1) * x[i % 10 / 2]), twist[3];
            double part = (i / 10 + node) / 8;
            for (int k = 0; k < 3; k++)
                twist[k] = part * end.twist[k];
            fw_flexure_elastica_of_twist(w.e, twist, 1e-10, false, &at);
            assert_true(at.code <= FW_ELASTICA_ROUGH);
            for (int k = 0; k < 3; k++)
                work += 0.0625 * g[i % 10 / 2] * at.wrench[k] * end.twist[k];
        }
        assert_relative(energy, work, 1e-9);
        fw_arena_free(w.arena);
    }
}

static void frames_are_equal(void **state) {
    (void)state;
    for (int n = 0; n < 30; n++) {
        wild w;
        double v[3], turn = uniform(-3, 3), c = cos(turn), s = sin(turn);
        fw_flexure_elastica_result a, b;
        grow(&w);
        load(&w, 0.5, v);
        solve(w.e, turn_and_force, v, 1e-10, &a);
        double twist[3] = {a.twist[0], c * a.twist[1] - s * a.twist[2],
                           s * a.twist[1] + c * a.twist[2]};
        wild other = w;
        other.beam.psi_rad += turn;
        other.beam.orientation_rad -= turn;
        other.beam.x_m = uniform(-1, 1);
        begin(&other);
        fw_flexure_elastica_of_twist(other.e, twist, 1e-10, false, &b);
        assert_near(b.wrench[0] * w.soft, a.wrench[0] * w.soft, 1e-9);
        double unit = w.soft * w.length;
        assert_near(b.wrench[1] * unit, (c * a.wrench[1] - s * a.wrench[2]) * unit, 1e-8);
        assert_near(b.wrench[2] * unit, (s * a.wrench[1] + c * a.wrench[2]) * unit, 1e-8);
        fw_arena_free(w.arena);
        fw_arena_free(other.arena);
    }
}

/* the same beam from its other end: the first body moves against the second */
static void ends_are_equal(void **state) {
    (void)state;
    for (int n = 0; n < 30; n++) {
        wild w;
        double v[3];
        fw_flexure_elastica_result a, b;
        grow(&w);
        load(&w, 0.5, v);
        solve(w.e, turn_and_force, v, 1e-10, &a);
        const fw_flexure_beam_pose *end = &fw_flexure_elastica_linear(w.e)->end;
        wild back = w;
        int count = w.beam.npiece;
        for (int i = 0; i < count; i++) {
            const fw_flexure_beam_piece *from = &w.piece[count - 1 - i];
            back.piece[i] = *from;
            back.piece[i].curvature_per_m *= -1;
            back.piece[i].kink_rad = i ? -w.piece[count - i].kink_rad : 0;
            back.piece[i].width_m[0] = from->width_m[2];
            back.piece[i].width_m[2] = from->width_m[0];
        }
        back.beam.x_m = end->x_m, back.beam.y_m = end->y_m;
        back.beam.psi_rad = end->psi_rad + M_PI;
        back.beam.root_m[0] = w.beam.root_m[1], back.beam.root_m[1] = w.beam.root_m[0];
        begin(&back);
        double th = a.twist[0], c = cos(th), s = sin(th), ux = a.twist[1], uy = a.twist[2];
        const double twist[3] = {-th, -(c * ux + s * uy), -(c * uy - s * ux)};
        fw_flexure_elastica_of_twist(back.e, twist, 1e-10, false, &b);
        double fx = a.wrench[1], fy = a.wrench[2], unit = w.soft * w.length;
        assert_near(b.wrench[0] * w.soft, -(a.wrench[0] + ux * fy - uy * fx) * w.soft, 1e-8);
        assert_near(b.wrench[1] * unit, -(c * fx + s * fy) * unit, 1e-8);
        assert_near(b.wrench[2] * unit, -(c * fy - s * fx) * unit, 1e-8);
        fw_arena_free(w.arena);
        fw_arena_free(back.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hinges_match_the_tables), cmocka_unit_test(arcs_match_the_tables),
        cmocka_unit_test(another_method_agrees),   cmocka_unit_test(tangents_are_derivatives),
        cmocka_unit_test(energy_is_work),          cmocka_unit_test(frames_are_equal),
        cmocka_unit_test(ends_are_equal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
