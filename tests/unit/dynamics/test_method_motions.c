/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every method on the same motions: against each other and against the reference values of the
   benchmarks. */
#include "quantity/law_kind.h"
#include "models.h"
#include <stdlib.h>

typedef struct outcome {
    fw_status status;
    const fw_dynamics_motion *motion;
    const char *message;
} outcome;

static outcome run(fw_arena *arena, const rig *r, const char *method, double rtol) {
    fw_diags *diags = fw_arena_one(arena, fw_diags);
    *diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {
        .method = method, .rtol = rtol, .samples = 11, .effects = {.mode = FW_EFFECTS_ALL}};
    outcome out = {0};
    out.status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, diags, &out.motion);
    out.message = diags->count ? diags->item[0].message : "";
    return out;
}

static bool is(const char *a, const char *b) {
    return strcmp(a, b) == 0;
}

/* largest difference of all samples: lengths over `length`, velocities over their largest */
static void motions_apart(const fw_dynamics_motion *a, const fw_dynamics_motion *b, double length,
                          double *q, double *v) {
    double speed[2] = {0, 0};
    *q = *v = 0;
    int n = 3 * a->nbody * a->nsample;
    for (int i = 0; i < n; i++)
        speed[i % 3 == 2] = fmax(speed[i % 3 == 2], fabs(b->v[i]));
    for (int i = 0; i < n; i++) {
        *q = fmax(*q, fabs(a->q[i] - b->q[i]) / (i % 3 == 2 ? 1 : length));
        *v = fmax(*v, fabs(a->v[i] - b->v[i]) / fmax(speed[i % 3 == 2], 1e-300));
    }
}

/* every method that takes the mechanism against the chain. `unique`: no redundant rows, so that the
   reactions are the same, too. Returns the methods compared. */
static int compare_all(fw_arena *arena, const rig *r, const char *name, double rtol, double length,
                       bool unique, double allowed) {
    outcome chain = run(arena, r, "chain", rtol);
    assert_int_equal(chain.status, FW_OK);
    int count = 0;
    for (size_t k = 1; fw_multibody_method_at(k).name; k++) {
        const char *method = fw_multibody_method_at(k).name;
        outcome other = run(arena, r, method, rtol);
        if (other.status == FW_SOLVER && is(method, "minimal")) {
            assert_non_null(strstr(other.message, "two bodies at a time"));
            continue;
        }
        if (other.status != FW_OK) fail_msg("%s, %s: %s", name, method, other.message);
        const fw_dynamics_motion *a = other.motion, *b = chain.motion;
        double q, v, force = 0, size = 0;
        motions_apart(a, b, length, &q, &v);
        for (int i = 0; i < 2 * a->npin * a->nsample; i++) {
            force = fmax(force, fabs(a->reaction_N[i] - b->reaction_N[i]));
            size = fmax(size, fabs(b->reaction_N[i]));
        }
        if (getenv("VERBOSE"))
            print_message("%s, %s: q %.1e v %.1e force %.1e\n", name, method, q, v, force / size);
        if (!(q <= allowed && v <= 10 * allowed && (!unique || force <= 100 * allowed * size)))
            fail_msg("%s, %s: q %.1e v %.1e force %.1e", name, method, q, v, force / size);
        assert_true(a->stats.max_constraint_norm <= 1e-12);
        count++;
    }
    return count;
}

static void methods_agree(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig six = rig_six_bar(arena, false), twice = rig_six_bar(arena, true);
    rig squeezer = rig_squeezer(arena), pendulum = rig_pendulum(arena);
    rig *all[] = {&six, &twice, &squeezer, &pendulum};
    for (int i = 0; i < 4; i++)
        all[i]->scene.duration_s /= test_cases(1, 8);
    assert_int_equal(compare_all(arena, &six, "six-bar", 1e-13, 1e-3, true, 1e-11), 8);
    assert_int_equal(compare_all(arena, &twice, "hinge twice", 1e-12, 1e-3, false, 1e-11), 7);
    assert_int_equal(compare_all(arena, &squeezer, "squeezer", 1e-12, 1e-2, true, 1e-10), 8);
    assert_int_equal(compare_all(arena, &pendulum, "pendulum", 1e-12, 1, true, 1e-11), 8);
    fw_arena_free(arena);
}

/* joints that are not pins, rows that turn, drivers, a law in time */
static void methods_agree_on_other_joints(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const double t[3] = {0, 1e-3, 2e-3}, g[3] = {0, 1, -1}, angle[3] = {0, 0.4, 0.1};
    rig r = rig_new(arena, 4, 2, 0);
    rig_body(&r, "crank", 2e-8, 4e-15, 2e-4, 0, 0);
    rig_body(&r, "rod", 1e-8, 3e-15, 10e-4, 1e-4, 0.3);
    rig_body(&r, "piston", 3e-8, 2e-15, 18e-4, 0, 0);
    rig_body(&r, "flag", 1e-8, 1e-15, 20e-4, 3e-4, 0.2);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 1e-6, 1e-11);
    rig_pin(&r, "B", 0, 1, 4e-4, 0, 1e-6, 0);
    r.m.joint = fw_arena_array(arena, fw_device_joint, 4);
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "guide",
                                                .kind = FW_JOINT_PRISMATIC,
                                                .body_a = FW_GROUND,
                                                .body_b = 2,
                                                .axis_rad = 0.1,
                                                .ax_m = 18e-4,
                                                .stiffness_N_per_m = 0.02};
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "strut",
                                                .kind = FW_JOINT_DISTANCE,
                                                .body_a = 1,
                                                .body_b = 2,
                                                .ax_m = 2e-4,
                                                .length_m = 7e-4};
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "seam",
                                                .kind = FW_JOINT_WELD,
                                                .body_a = 2,
                                                .body_b = 3,
                                                .ax_m = 2e-4,
                                                .ay_m = 3e-4,
                                                .angle_rad = 0.2};
    r.scene.duration_s = 2e-3 / test_cases(1, 2);
    fw_quantity_law law = {
        .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = g, .ntable = 3};
    rig_force(&r, 2, 2e-5, 1e-5);
    r.scene.force[0].law = &law;
    assert_int_equal(compare_all(arena, &r, "ties", 1e-12, 1e-3, true, 1e-10), 7);
    r.m.driver = fw_arena_array(arena, fw_device_driver, 1);
    r.m.driver[r.m.ndriver++] = (fw_device_driver){
        .id = "motor",
        .revolute = 0,
        .joint = FW_NONE,
        .law = {.kind = &fw_quantity_law_table, .table_t_s = t, .table_value = angle, .ntable = 3}};
    assert_int_equal(compare_all(arena, &r, "driven", 1e-12, 1e-3, true, 1e-10), 7);
    /* a driver whose speed jumps strikes the mechanism, and velocities that contradict the joints
       are changed: both by the least change in the mass metric, whatever a method corrects by */
    rig six = rig_six_bar(arena, false);
    six.scene.duration_s = 2e-3 / test_cases(1, 4);
    rig_velocity(&six, 2, 0.5, 0.1, 0);
    assert_int_equal(compare_all(arena, &six, "bad start", 1e-12, 1e-3, true, 1e-10), 8);
    six.m.driver = r.m.driver;
    six.m.ndriver = 1;
    assert_int_equal(compare_all(arena, &six, "driven six-bar", 1e-12, 1e-3, true, 1e-10), 8);
    fw_arena_free(arena);
}

static void methods_agree_on_random_mechanisms(void **state) {
    (void)state;
    int minimal = 0, count = test_cases(6, 2);
    for (uint64_t seed = 1; seed <= (uint64_t)count; seed++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_any(arena, seed);
        r.scene.duration_s *= 0.2;
        char name[32];
        snprintf(name, sizeof name, "random %d", (int)seed);
        minimal += compare_all(arena, &r, name, 1e-12, 1e-3, true, 1e-9) == 8;
        fw_arena_free(arena);
    }
    assert_true(3 * minimal >= 2 * count);
}

/* the table in tests/data at 11 of its rows */
static void every_method_gives_the_six_bar_table(void **state) {
    (void)state;
    size_t every = (size_t)test_cases(1, 4);
    static double table[101][30];
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/sixbar_ref_0p1ms.txt", "r");
    assert_non_null(file);
    char line[2048];
    int row = 0;
    while (row < 101 && fgets(line, sizeof line, file)) {
        if (line[0] == '#') continue;
        char *at = line;
        (void)strtod(at, &at);
        for (int c = 0; c < 30; c++)
            table[row][c] = strtod(at, &at);
        row++;
    }
    fclose(file);
    assert_int_equal(row, 101);
    for (size_t k = 0; fw_multibody_method_at(k).name; k += every) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        outcome out = run(arena, &r, fw_multibody_method_at(k).name, 1e-13);
        assert_int_equal(out.status, FW_OK);
        double worst = 0;
        for (int i = 0; i < 11; i++)
            for (int c = 0; c < 15; c++)
                worst = fmax(worst, fabs(out.motion->q[15 * i + c] / (c % 3 == 2 ? 1 : 1e-3) -
                                         table[10 * i][c]));
        if (!(worst <= 1e-11)) fail_msg("%s: %.1e", fw_multibody_method_at(k).name, worst);
        fw_arena_free(arena);
    }
}

/* Andrews' squeezer at 0.03 s, the quad-precision column of the benchmark */
static void every_method_gives_andrews_squeezer(void **state) {
    (void)state;
    size_t every = (size_t)test_cases(1, 4);
    static const double beta = 15.810771195153707097, gamma = 0.040822240119645804858,
                        delta = 0.52440996587995406937, epsilon = 1.0480807410419378731;
    for (size_t k = 0; fw_multibody_method_at(k).name; k += every) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_squeezer(arena);
        outcome out = run(arena, &r, fw_multibody_method_at(k).name, 1e-13);
        assert_int_equal(out.status, FW_OK);
        const double *q = out.motion->q + 21 * 10;
        const double error[] = {q[2] - beta, q[8] - gamma, q[14] - delta, q[20] - epsilon};
        for (int i = 0; i < 4; i++)
            if (!(fabs(error[i]) <= 1e-10))
                fail_msg("%s, angle %d: %.1e", fw_multibody_method_at(k).name, i, error[i]);
        fw_arena_free(arena);
    }
}

/* A02: B0 at 10 s, after ten passes through positions where the rank of G drops by N. Before the
   first of them all methods agree to round-off of the integration. */
static void windows_pass_singular_positions(void **state) {
    (void)state;
    size_t every = (size_t)test_cases(1, 4);
    static const struct {
        int n;
        double x, y;
    } exact[] = {{1, 0.4783850577609705590054, 0.8781501787912093011639},
                 {2, 0.3284581108415408153786522, 0.9445185381786009621613}};
    for (int e = 0; e < 2; e++)
        for (size_t k = 0; fw_multibody_method_at(k).name; k += every) {
            const char *method = fw_multibody_method_at(k).name;
            fw_arena *arena = fw_arena_new(0);
            rig r = rig_windows(arena, exact[e].n);
            outcome out = run(arena, &r, method, 1e-11);
            if (out.status != FW_OK) fail_msg("%s: %s", method, out.message);
            const double *q = out.motion->q + 3 * out.motion->nbody * 10;
            double error = fmax(fabs(-sin(q[2]) - exact[e].x), fabs(cos(q[2]) - exact[e].y));
            if (getenv("VERBOSE"))
                print_message("windows %d, %s: %.1e\n", exact[e].n, method, error);
            if (!(error <= 1e-6)) fail_msg("%s: %.1e", method, error);
            fw_arena_free(arena);
        }
    fw_arena *arena = fw_arena_new(0);
    rig before = rig_windows(arena, 2);
    before.scene.duration_s = 0.45 / test_cases(1, 2);
    assert_int_equal(compare_all(arena, &before, "windows, before", 1e-13, 1, true, 1e-11), 8);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(methods_agree),
        cmocka_unit_test(methods_agree_on_other_joints),
        cmocka_unit_test(methods_agree_on_random_mechanisms),
        cmocka_unit_test(every_method_gives_the_six_bar_table),
        cmocka_unit_test(every_method_gives_andrews_squeezer),
        cmocka_unit_test(windows_pass_singular_positions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
