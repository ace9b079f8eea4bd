/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"
#include "models.h"
#include <stdlib.h>

typedef struct fixture {
    fw_arena *arena;
    fw_diags diags;
} fixture;

static fixture begin(void) {
    fixture f = {.arena = fw_arena_new(0)};
    assert_non_null(f.arena);
    f.diags = fw_diags_new(f.arena);
    return f;
}

static const fw_dynamics_motion *simulate(fixture *f, const rig *r, double rtol, int samples) {
    const fw_dynamics_motion *motion = NULL;
    const fw_dynamics_motion_options o = {.rtol = rtol, .samples = samples};
    assert_int_equal(fw_dynamics_simulate(f->arena, &r->m, &r->scene, &o, &f->diags, &motion),
                     FW_OK);
    assert_true(motion->stats.max_constraint_norm <= 1e-12);
    assert_int_equal(f->diags.errors, 0);
    return motion;
}

/* |Psi| of a sample, in metres */
static double gap(const rig *r, const double *q) {
    double worst = 0;
    for (int i = 0; i < r->m.npin; i++) {
        const fw_mechanism_pin *p = &r->m.pin[i];
        const int body[2] = {p->body_a, p->body_b};
        const double local[2][2] = {{p->ax_m, p->ay_m}, {p->bx_m, p->by_m}};
        double at[2][2];
        for (int k = 0; k < 2; k++) {
            const double *b = body[k] == FW_GROUND ? (const double[3]){0} : q + 3 * body[k];
            at[k][0] = b[0] + cos(b[2]) * local[k][0] - sin(b[2]) * local[k][1];
            at[k][1] = b[1] + sin(b[2]) * local[k][0] + cos(b[2]) * local[k][1];
        }
        worst = fmax(worst, hypot(at[0][0] - at[1][0], at[0][1] - at[1][1]));
    }
    return worst;
}

/* error against the table in units of mm, rad, and of the largest velocity of each kind */
static void compare_with_table(const rig *r, const fw_dynamics_motion *m, double *error_q,
                               double *error_v) {
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/sixbar_ref_0p1ms.txt", "r");
    assert_non_null(file);
    char line[2048];
    int row = 0;
    double speed[2] = {0, 0};
    static double table[101][30];
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#') continue;
        char *at = line;
        double t = strtod(at, &at);
        assert_true(row < 101);
        assert_near(t, 0.1 * row, 1e-9);
        for (int c = 0; c < 30; c++)
            table[row][c] = strtod(at, &at);
        for (int c = 15; c < 30; c++)
            speed[c % 3 == 2] = fmax(speed[c % 3 == 2], fabs(table[row][c]));
        row++;
    }
    fclose(file);
    assert_int_equal(row, 101);
    assert_int_equal(m->nsample, 101);
    *error_q = *error_v = 0;
    for (int i = 0; i < 101; i++) {
        for (int c = 0; c < 15; c++) {
            double unit = c % 3 == 2 ? 1 : 1e-3, rate = c % 3 == 2 ? 1e3 : 1;
            *error_q = fmax(*error_q, fabs(m->q[15 * i + c] / unit - table[i][c]));
            *error_v = fmax(*error_v,
                            fabs(m->v[15 * i + c] / rate - table[i][15 + c]) / speed[c % 3 == 2]);
        }
        assert_true(gap(r, m->q + 15 * i) <= 1e-12 * 1e-3);
    }
}

static void test_six_bar_reference(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const double rtol[] = {1e-13, 1e-11, 1e-9, 1e-7};
    const double allowed[] = {1e-11, 1e-9, 1e-7, 1e-5};
    for (int i = 0; i < 4; i++) {
        const fw_dynamics_motion *m = simulate(&f, &r, rtol[i], 101);
        double q, v;
        compare_with_table(&r, m, &q, &v);
        print_message("rtol %g: q %.2e v %.2e steps %ld (%ld rejected) rhs %ld cpu %.3f ms + %.3f, "
                      "psi %.1e, energy %.1e\n",
                      rtol[i], q, v, m->stats.steps, m->stats.rejected, m->stats.rhs,
                      1e3 * m->stats.cpu_s, 1e3 * m->stats.estimate_cpu_s,
                      m->stats.max_constraint_norm, m->stats.energy_error);
        assert_true(q <= allowed[i]);
        assert_true(v <= 10 * allowed[i]);
        assert_true(m->stats.energy_error <= 10 * allowed[i]);
        assert_true(m->stats.projections >= m->stats.steps);
    }
    fw_arena_free(f.arena);
}

/* joint forces in mN; the reference's multipliers are forces on body a */
static void test_six_bar_reactions(void **state) {
    (void)state;
    static const struct {
        int row;
        double lambda[12];
    } reference[] = {
        {0,
         {-8.816631690029130603e-02, -9.927025159295131780e-02, -6.772796786885900219e-02,
          -9.109491198037839626e-02, -4.499851038239053618e-03, -8.281238829957748825e-02,
          -7.608803303001453579e-02, 8.442592414116768847e-02, -8.041986564380489140e-05,
          6.046087268393301069e-02, 3.249393264645691980e-02, 4.667941585189039640e-02}},
        {10,
         {5.375068333970412731e-01, 3.630458719219381643e-01, 5.168717948638350143e-01,
          3.632294862124307914e-01, 4.578029878410979509e-01, 3.767553794280259927e-01,
          -1.404368066905078771e-01, 6.976017593268729610e-01, -2.019853688890383004e-01,
          7.480540402694007372e-01, -2.255301975214685691e-01, 7.738452947655936586e-01}},
        {100,
         {-3.847226827358657931e-02, -4.505733646844998992e-02, -1.935315215491551291e-02,
          -3.869851644393755653e-02, 3.440587430806853625e-02, -3.190489456405414725e-02,
          -9.477521564421894842e-02, 1.574365058319219948e-01, -4.110327841207465547e-02,
          1.442537001510341461e-01, -2.201771828040890097e-02, 1.346970978584722116e-01}},
    };
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-13, 101);
    for (size_t i = 0; i < sizeof reference / sizeof reference[0]; i++)
        for (int k = 0; k < 12; k++)
            assert_near(m->reaction_N[12 * reference[i].row + k] * 1e3, -reference[i].lambda[k],
                        2e-10);
    fw_arena_free(f.arena);
}

/* nearly a point mass: m r^2/J up to 1e13. Released level, it swings through half a turn, whatever
   J. At 1e14 round-off decides (a J one unit in the last place away has made one kernel 327 rad
   wrong and another right to 1e-9 rad): there the estimate of the error must say so, no more. */
static void test_tiny_inertia(void **state) {
    (void)state;
    fixture f = begin();
    const double finer = test_fewest(test_cases(1, 4), 12); /* a decade, or some of them */
    for (double J = 1e-1; J > 1e-14; J *= pow(10, -finer)) {
        const double tolerance[] = {1e-13, 1e-9, 0};
        for (int i = 0; i < 3; i++) {
            rig r = rig_new(f.arena, 1, 1, 0);
            rig_body(&r, "bob", 1.0, J, 1.0, 0.0, 0.0);
            rig_pin(&r, "O", FW_GROUND, 0, 0.0, 0.0, 0.0, 0.0);
            r.scene.gravity = true;
            r.scene.gy_m_per_s2 = -9.81;
            r.scene.duration_s = 2.0 * (1.0 + J);
            const fw_dynamics_motion *m = simulate(&f, &r, tolerance[i], 2);
            assert_near(fabs(m->peak[0].angle_rad), acos(-1.0), m->peak[0].error_rad);
            if (J > 5e-14) assert_true(m->peak[0].error_rad < 1e-3);
            assert_true(m->stats.steps < 200000);
        }
    }
    fw_arena_free(f.arena);
}

/* a second hinge D makes S singular everywhere; the motion must not notice */
static void test_redundant_hinge(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, true);
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-13, 101);
    double q, v;
    compare_with_table(&r, m, &q, &v);
    print_message("redundant: q %.2e v %.2e\n", q, v);
    assert_true(q <= 1e-9 && v <= 1e-9);
    fw_arena_free(f.arena);
}

static void test_pendulum(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_pendulum(f.arena);
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-13, 11);
    const double *q = m->q + 3 * 10, *v = m->v + 3 * 10, *one = m->q + 3;
    print_message("pendulum: x %.2e energy %.2e steps %ld\n", 2 * q[0] + 0.2750874625761168600544,
                  m->stats.energy_error, m->stats.steps);
    assert_near(2 * one[0], 0.9862917511318753193556, 1e-11);
    assert_near(2 * q[0], -0.2750874625761168600544, 1e-11);
    assert_near(2 * q[1], -0.9614192050991250642651, 1e-11);
    assert_near(2 * v[0], 4.175598100951728836461, 1e-10);
    assert_near(2 * v[1], -1.194749054560475271648, 1e-10);
    assert_true(m->stats.energy_error < 1e-10);
    /* 845 periods */
    r.scene.duration_s = 2000;
    m = simulate(&f, &r, 1e-13, 2);
    assert_near(2 * m->q[3], 0.8146030685890321521218, 1e-8);
    assert_near(2 * m->v[3], -1.95664770788265787019, 1e-7);
    assert_true(m->stats.energy_error < 1e-11);
    fw_arena_free(f.arena);
}

static void test_windows(void **state) {
    (void)state;
    const int n[] = {1, 2, 10, 40};
    const double want[4][4] = {
        {0.4783850577609705590054, 0.8781501787912093011639, 1.727264075547153635754,
         -0.940952179371515644193},
        {0.3284581115408153786522, 0.9445185381786009621613, 1.423051470206944123281,
         -0.4948688454870429589909},
        {0.2043535609897709854665, 0.978897145828304042303, 1.186680023754622830671,
         -0.247730100800822495561},
        {0.1805122266867283901032, 0.9835727405823115748813, 1.14844127746941413332,
         -0.2107700667794239317794},
    };
    const double rtol[] = {1e-9, 1e-10, 1e-11};
    for (int i = 0, sizes = test_fewest(4, 3); i < sizes; i++)
        for (int k = 0; k < 3; k += test_fewest(1, 2)) {
            fixture f = begin();
            rig r = rig_windows(f.arena, n[i]);
            const fw_dynamics_motion *m = simulate(&f, &r, rtol[k], 2);
            const double *q = m->q + 3 * m->nbody, *v = m->v + 3 * m->nbody;
            double c = cos(q[2]), s = sin(q[2]); /* B0: 0.5 above the centre of crank 0 */
            const double got[4] = {q[0] - 0.5 * s, q[1] + 0.5 * c, v[0] - 0.5 * c * v[2],
                                   v[1] - 0.5 * s * v[2]};
            double error = 0;
            for (int j = 0; j < 4; j++)
                error = fmax(error, fabs(got[j] - want[i][j]));
            print_message("N %d rtol %g: B0 %.2e steps %ld (%ld) cpu %.1f ms energy %.1e\n", n[i],
                          rtol[k], error, m->stats.steps, m->stats.rejected, 1e3 * m->stats.cpu_s,
                          m->stats.energy_error);
            assert_true(error < 1e-6);
            for (int b = 1; b <= n[i]; b++) /* cranks stay parallel */
                assert_near(q[3 * b + 2], q[2], 1e-9);
            fw_arena_free(f.arena);
        }
}

static void test_squeezer(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_squeezer(f.arena);
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-13, 7);
    const double *q = m->q + 21 * 6, *v = m->v + 21 * 6;
    const double beta = 15.810771195153707097, theta = -15.75637105841183947,
                 gamma = 0.040822240119645804858, phi = -0.53473011634207959377,
                 delta = 0.52440996587995406937, omega = 0.53473011634207959377,
                 epsilon = 1.0480807410419378731;
    /* K2 turns with beta + Theta, K4 with Phi + delta, K6 with Omega + epsilon */
    const double want[7] = {beta,  beta + theta,    gamma,  phi + delta,
                            delta, omega + epsilon, epsilon};
    double error = 0;
    for (int b = 0; b < 7; b++)
        error = fmax(error, fabs(q[3 * b + 2] - want[b]));
    print_message("squeezer: angles %.2e rate %.2e steps %ld cpu %.2f ms energy %.1e\n", error,
                  v[2] / 1139.9203022591060642 - 1, m->stats.steps, 1e3 * m->stats.cpu_s,
                  m->stats.energy_error);
    assert_true(error < 1e-9);
    assert_near(v[2] / 1139.9203022591060642, 1, 1e-9);
    /* point F at 0.01 and 0.02 s */
    const double path[2][2] = {{-3.890552388649431935e-03, 5.819244118541015420e-03},
                               {-2.274420924160498096e-03, 6.620197086170539815e-03}};
    for (int i = 0; i < 2; i++) {
        const double *k = m->q + (size_t)21 * (size_t)(2 * i + 2);
        assert_near(k[0] + .00608 * cos(k[2]), path[i][0], 1e-12);
        assert_near(k[1] + .00608 * sin(k[2]), path[i][1], 1e-12);
    }
    fw_arena_free(f.arena);
}

/* every tolerance from loose to tight keeps the branch (no bifurcation at the singular positions)
 */
static void test_windows_keep_the_branch(void **state) {
    (void)state;
    const int more = test_fewest(1, 9);
    const double tighter = test_fewest(10, 1000);
    for (int n = 1; n <= 10; n += more)
        for (double rtol = 1e-5; rtol > 0.5e-12; rtol /= tighter) {
            fixture f = begin();
            rig r = rig_windows(f.arena, n);
            const fw_dynamics_motion *m = simulate(&f, &r, rtol, 51);
            for (int i = 0; i < 51; i++)
                for (int b = 1; b <= n; b++)
                    assert_near(m->q[(size_t)(3 * m->nbody * i + 3 * b + 2)],
                                m->q[(size_t)(3 * m->nbody * i + 2)], 1e-7);
            fw_arena_free(f.arena);
        }
}

/* all kinds of effects at once, random mechanisms: the energy balance closes and tightens with
   rtol, and every sample closes the joints */
static void test_energy_balance(void **state) {
    (void)state;
    for (uint64_t seed = 500, end = 500 + (uint64_t)test_fewest(30, 6); seed < end; seed++) {
        fixture f = begin();
        rig r = rig_any(f.arena, seed);
        fw_device_spring springs[2] = {{.id = "s",
                                        .body_a = FW_GROUND,
                                        .body_b = 1,
                                        .ax_m = 1e-3,
                                        .ay_m = -2e-3,
                                        .bx_m = 1e-4,
                                        .by_m = 2e-4,
                                        .stiffness_N_per_m = 0.2,
                                        .damping_Ns_per_m = 1e-5,
                                        .length_m = 1e-3},
                                       {.id = "t",
                                        .body_a = 0,
                                        .body_b = 1,
                                        .ay_m = 3e-4,
                                        .by_m = -2e-4,
                                        .stiffness_N_per_m = 0.3,
                                        .length_m = 5e-4}};
        r.m.spring = springs;
        r.m.nspring = 2;
        r.scene.gravity = true;
        r.scene.gx_m_per_s2 = 3;
        r.scene.gy_m_per_s2 = -9;
        for (int i = 0; i < r.scene.nforce; i++)
            r.scene.force[i].x_m = 2e-4, r.scene.force[i].y_m = -1e-4;
        r.m.pin[0].free_angle_rad = 0.2;
        rig_velocity(&r, 0, 0, 0, 50);
        const double rtol[] = {1e-6, 1e-9, 1e-12};
        for (int k = 0; k < 3; k++) {
            const fw_dynamics_motion *motion = NULL;
            const fw_dynamics_motion_options o = {
                .rtol = rtol[k], .samples = 21, .effects = {.mode = FW_EFFECTS_ALL}};
            assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &motion),
                             FW_OK);
            assert_true(motion->stats.energy_error < 300 * rtol[k]);
            assert_true(motion->stats.max_constraint_norm <= 1e-12);
            for (int i = 0; i < 21; i++) {
                assert_near(motion->t_s[i], r.scene.duration_s * i / 20, 1e-18);
                assert_true(gap(&r, motion->q + (size_t)(3 * r.m.nbody * i)) < 1e-12 * 1e-3);
            }
            assert_true(motion->t_s[20] == r.scene.duration_s);
        }
        fw_arena_free(f.arena);
    }
}

/* deflections of 1e-6 rad get the accuracy asked for too: the tolerance follows the motion's size
 */
static void test_small_motion(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    for (int i = 0; i < 2; i++) {
        double scale = i ? 1e-6 : 1;
        r.scene.force[0].fx_N = 0.35e-4 * scale, r.scene.force[0].fy_N = -0.2e-4 * scale;
        r.scene.torque[0].value_Nm = -0.15e-7 * scale;
        const fw_dynamics_motion *m = NULL;
        const fw_dynamics_motion_options o = {.accuracy = 1e-4};
        assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m), FW_OK);
        assert_true(m->peak[5].error_rad < 1e-4 * fabs(m->peak[5].angle_rad));
        assert_true(fabs(m->peak[5].angle_rad) > 1e-2 * scale);
    }
    fw_arena_free(f.arena);
}

/* shifting the whole mechanism by a metre changes nothing but round-off of the coordinates */
static void test_far_from_the_origin(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false), far = rig_six_bar(f.arena, false);
    for (int b = 0; b < 5; b++)
        far.m.body[b].x_m += 1;
    far.m.pin[0].ax_m += 1;
    far.m.pin[5].bx_m += 1;
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-10, 5), *n = simulate(&f, &far, 1e-10, 5);
    for (int i = 0; i < 6; i++)
        assert_near(n->peak[i].angle_rad, m->peak[i].angle_rad, 1e-9);
    fw_arena_free(f.arena);
}

static void test_repeatable(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-8, 50), *n = simulate(&f, &r, 1e-8, 50);
    assert_memory_equal(m->q, n->q, 50 * 15 * sizeof(double));
    assert_memory_equal(m->v, n->v, 50 * 15 * sizeof(double));
    assert_memory_equal(m->peak, n->peak, 6 * sizeof(fw_dynamics_peak));
    fw_arena_free(f.arena);
}

static void test_contradicting_velocity(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_pendulum(f.arena);
    r.scene.gravity = false;
    rig_velocity(&r, 0, 1, 1, 0); /* along and across the arm */
    const fw_dynamics_motion *m = simulate(&f, &r, 1e-9, 2);
    assert_int_equal(f.diags.count, 1);
    assert_int_equal(f.diags.item[0].number, 106);
    assert_near(m->v[0], 0, 1e-15);
    assert_near(m->v[1], 0.5, 1e-14); /* m v l = (J + m l^2) omega, here v/2 */
    assert_near(m->v[2], -1, 1e-14);
    fw_arena_free(f.arena);
}

typedef struct mistake {
    fw_status status;
    int number;
} mistake;

static void test_mistakes(void **state) {
    (void)state;
    static const mistake want[] = {
        {FW_INPUT, 105},  {FW_USAGE, 103}, {FW_USAGE, 104}, {FW_USAGE, 105},
        {FW_SOLVER, 100}, {FW_INPUT, 107}, {FW_INPUT, 105}, {FW_INPUT, 105},
        {FW_INPUT, 107},  {FW_USAGE, 110}, {FW_SOLVER, 0},
    };
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, false);
        fw_dynamics_motion_options o = {.samples = 3};
        const fw_dynamics_motion *m = NULL;
        switch (i) {
        case 0:
            r.scene.duration_s = 0;
            break;
        case 1:
            o.method = "magic";
            break;
        case 2:
            o.integrator = "euler";
            break;
        case 3:
            o.rtol = (double)NAN;
            break;
        case 4:
            r.m.pin[5].bx_m += 9e-3;
            break;
        case 5:
            r.m.body[2].mass_kg = 0;
            break;
        case 6:
            r.scene.force[0].fx_N = (double)INFINITY;
            break;
        case 7:
            r.scene.torque[0].body = 5;
            break;
        case 8:
            r.m.pin[2].ax_m = (double)NAN;
            break;
        case 9:
            o.effects = (fw_effect_choice){.mode = FW_EFFECTS_LIST, .list = "magnetism"};
            break;
        default:
            r.scene.force[0].fx_N = 1e300;
            break;
        }
        assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m),
                         want[i].status);
        assert_null(m);
        assert_true(f.diags.count >= 1);
        if (want[i].number) assert_int_equal(f.diags.item[0].number, want[i].number);
        assert_non_null(fw_diag_find(f.diags.item[0].number));
        fw_arena_free(f.arena);
    }
}

static void test_cancel(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_dynamics_motion_options o = {0};
    const fw_dynamics_motion *m = NULL;
    fw_cancel cancel = {0};
    fw_arena_stop_with(f.arena, &cancel);
    fw_cancel_request(&cancel, 2);
    assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m), FW_CANCELLED);
    fw_cancel_clear(&cancel);
    assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m), FW_OK);
    fw_arena_free(f.arena);
}

/* every allocation may fail; a longer scene asks for no more of them: the loop allocates nothing */
static void test_memory(void **state) {
    (void)state;
    long count = 0;
    for (int i = 0; i < 2; i++) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, false);
        const fw_dynamics_motion_options o = {.samples = 3, .rtol = 1e-8};
        const fw_dynamics_motion *m = NULL;
        r.scene.duration_s *= i ? 20 : 1;
        fw_arena_fail_at(0, 0);
        assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m), FW_OK);
        if (i) assert_int_equal(fw_arena_count(), count);
        count = fw_arena_count();
        fw_arena_free(f.arena);
    }
    for (long n = 1; n <= count; n++) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, false);
        const fw_dynamics_motion_options o = {.samples = 3, .rtol = 1e-8};
        const fw_dynamics_motion *m = NULL;
        fw_arena_fail_at(n, 0);
        fw_status status = fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m);
        fw_arena_fail_at(0, 0);
        assert_int_equal(status, FW_NOMEM);
        assert_null(m);
        fw_arena_free(f.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_six_bar_reference),
        cmocka_unit_test(test_six_bar_reactions),
        cmocka_unit_test(test_tiny_inertia),
        cmocka_unit_test(test_redundant_hinge),
        cmocka_unit_test(test_pendulum),
        cmocka_unit_test(test_windows),
        cmocka_unit_test(test_squeezer),
        cmocka_unit_test(test_windows_keep_the_branch),
        cmocka_unit_test(test_energy_balance),
        cmocka_unit_test(test_small_motion),
        cmocka_unit_test(test_far_from_the_origin),
        cmocka_unit_test(test_repeatable),
        cmocka_unit_test(test_contradicting_velocity),
        cmocka_unit_test(test_mistakes),
        cmocka_unit_test(test_cancel),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
