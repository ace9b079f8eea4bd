/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joints that say the same twice or thrice. Hard because S = G M^-1 G^T is then singular in every
   position: a solver that factors it stops or divides round-off by round-off, and one that decides
   a rank by a threshold may drop the wrong row. What contradicts itself, however little, is an
   error that names the joint, never a motion. */
#include "hard.h"

enum { ROWS = 11, N = 15 };
static const double mm = 1e-3;

/* error of every row against the same without the redundant joint, in mm and rad */
static double compare(const fw_dynamics_motion *m, const fw_dynamics_motion *reference) {
    double worst = 0;
    for (int i = 0; i < ROWS * N; i++)
        worst = fmax(worst, fabs(m->q[i] - reference->q[i]) / (i % 3 == 2 ? 1 : mm));
    return worst;
}

static const fw_dynamics_motion *plain_motion(fw_arena *arena) {
    rig r = rig_six_bar(arena, false);
    return hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = ROWS});
}

/* hinge D 1 + `more` times; every copy off by `off` metres in its local points */
static rig with_copies(fw_arena *arena, int more, double off) {
    rig r = rig_six_bar(arena, false);
    fw_mechanism_pin *pin = fw_arena_array(arena, fw_mechanism_pin, 16);
    memcpy(pin, r.m.pin, (size_t)r.m.npin * sizeof *pin);
    r.m.pin = pin;
    for (int i = 1; i <= more; i++) {
        fw_mechanism_pin *p = rig_pin(&r, i == 1 ? "D2" : "D3", 2, 3, 2.20 * mm, 2.75 * mm, 0, 0);
        p->ax_m += i * off, p->by_m -= i * off / 3;
    }
    return r;
}

static void test_hinge_twice_and_thrice(void **state) {
    (void)state;
    static const double off[] = {0, 1e-19, 4e-19}; /* an ulp of these coordinates is 4e-19 m */
    fw_arena *arena = fw_arena_new(0);
    const fw_dynamics_motion *one = plain_motion(arena);
    for (int more = 1; more <= 2; more++)
        for (size_t k = 0; k < sizeof off / sizeof off[0]; k++) {
            rig r = with_copies(arena, more, off[k]);
            const fw_dynamics_motion *m =
                hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = ROWS});
            double worst = compare(m, one), force = 0;
            for (int i = 0; i < ROWS; i++)
                for (int c = 0; c < 2; c++) { /* the copies share the force */
                    const double *at = m->reaction_N + (size_t)(i * 2 * r.m.npin);
                    double sum = at[6 + c];
                    for (int copy = 0; copy < more; copy++)
                        sum += at[12 + 2 * copy + c];
                    force = fmax(force, fabs(sum - one->reaction_N[12 * i + 6 + c]));
                }
            print_message("redundant: hinge D %d times, off by %.0e m: motion to %.1e, sum of the "
                          "forces to %.1e mN\n",
                          more + 1, off[k], worst, force * 1e3);
            assert_true(worst < 1e-9);
            assert_true(force < 1e-9 * 1e-3);
        }
    fw_arena_free(arena);
}

/* copies that contradict each other: an error with the joint's name, down to what is noise of the
   scene's size (1e-13 of 4 mm) */
static void test_hinge_slightly_elsewhere(void **state) {
    (void)state;
    static const double off[] = {1e-6, 1e-9, 1e-12, 1e-14};
    for (size_t k = 0; k < sizeof off / sizeof off[0]; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = with_copies(arena, 1, off[k]);
        outcome out =
            hard_try(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-10, .samples = ROWS});
        print_message("redundant: hinge D twice, %.0e m apart: %s\n", off[k],
                      out.status == FW_OK ? "accepted" : out.message);
        assert_int_equal(out.status, FW_SOLVER);
        assert_int_equal(out.number, 100);
        assert_true(strstr(out.message, "joint D") != NULL);
        fw_arena_free(arena);
    }
}

/* a cart on two parallel guides, and a body welded thrice to the platform */
static void test_guides_and_welds(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_dynamics_motion *m[2];
    for (int k = 0; k < 2; k++) {
        rig r = rig_new(arena, 1, 0, 1);
        rig_body(&r, "cart", 2, 0.3, 0.5, 0.2, 0.4);
        for (int i = 0; i <= k; i++) {
            fw_device_joint *t = hard_tie_at(arena, &r, "guide", FW_JOINT_PRISMATIC, FW_GROUND, 0,
                                             0.5 + i * 3 * cos(0.3), 0.2 + i * 3 * sin(0.3));
            t->axis_rad = 0.3;
        }
        rig_spring(&r, "spring", FW_GROUND, 2, 1, 0, 0.1, 0.1, 30, 0.5);
        r.scene.gravity = true, r.scene.gy_m_per_s2 = -9.81;
        r.scene.duration_s = 3;
        m[k] = hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = 4});
    }
    double guides = 0, welds = 0;
    for (int i = 0; i < 12; i++)
        guides = fmax(guides, fabs(m[0]->q[i] - m[1]->q[i]));
    for (int k = 0; k < 2; k++) {
        rig r = rig_six_bar(arena, false);
        fw_mechanism_mass *body = fw_arena_array(arena, fw_mechanism_mass, 6);
        memcpy(body, r.m.body, 5 * sizeof *body);
        r.m.body = body;
        rig_body(&r, "extra", 1e-8, 1e-15, 1.7 * mm, 3.2 * mm, 0.3);
        for (int i = 0; i <= 2 * k; i++)
            hard_tie_at(arena, &r, "weld", FW_JOINT_WELD, 2, 5, (1.6 + i) * mm, (3 - 0.3 * i) * mm);
        m[k] = hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = 4});
    }
    for (int i = 0; i < 4 * 18; i++)
        welds = fmax(welds, fabs(m[0]->q[i] - m[1]->q[i]) / (i % 3 == 2 ? 1 : mm));
    print_message("redundant: two guides to %.1e, three welds to %.1e\n", guides, welds);
    assert_true(guides < 1e-9);
    assert_true(welds < 1e-9);
    fw_arena_free(arena);
}

/* a parallelogram with a driven crank and the other crank driven, too */
static rig driven_twice(fw_arena *arena, const char *second, bool same_pin) {
    static const double p[4][2] = {{0, 0}, {0.3, 0.4}, {1.3, 0.4}, {1, 0}};
    rig r = rig_new(arena, 3, 4, 0);
    hard_bars(&r, p, 3, 1);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "D", 2, FW_GROUND, 1, 0, 0, 0);
    const fw_quantity_dimension rad = {.rad = 1};
    double start = atan2(0.4, 0.3);
    r.m.pin[2].free_angle_rad = start;
    r.m.pin[3].free_angle_rad = -(r.m.body[2].phi_rad);
    hard_driver(arena, &r, "first", 2, FW_NONE, hard_law(arena, "0.3 rad * sin(2 * t / 1 s)", rad));
    hard_driver(arena, &r, "second", same_pin ? 2 : 3, FW_NONE, hard_law(arena, second, rad));
    r.scene.duration_s = 2;
    return r;
}

static void test_drivers(void **state) {
    (void)state;
    /* the angle of D counts from the bar to the ground: the opposite sign */
    static const struct {
        const char *law;
        bool same_pin, fits;
    } second[] = {
        {"0.3 rad * sin(2 * t / 1 s)", true, true},
        {"-0.3 rad * sin(2 * t / 1 s)", false, true},
        {"0.3 rad * sin(2 * t / 1 s) + 0.1 rad * t / 1 s", true, false},
        {"-0.3 rad * sin(2 * t / 1 s) + 1e-6 rad * (t / 1 s)^2", false, false},
        {"-0.3 rad * sin(2 * t / 1 s) + 0.1 rad * (t / 1 s)^4", false, false},
        {"-0.3 rad * sin(2 * t / 1 s) + 0.1 rad", false, false},
    };
    for (size_t i = 0; i < sizeof second / sizeof second[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = driven_twice(arena, second[i].law, second[i].same_pin);
        outcome out =
            hard_try(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-10, .samples = 21});
        if (second[i].fits) {
            if (out.status != FW_OK) fail_msg("%s", out.message);
            double worst = 0;
            for (int k = 0; k < 21; k++) {
                double want = 0.3 * sin(2 * out.m->t_s[k]) + atan2(0.4, 0.3);
                worst = fmax(worst, fabs(hard_q(out.m, k)[2] - want));
                worst = fmax(worst, fabs(hard_q(out.m, k)[5]));
            }
            print_message("redundant: driver on a driven mechanism (%s): angles to %.1e, energy "
                          "%.1e\n",
                          second[i].same_pin ? "same joint" : "other joint", worst,
                          out.m->stats.energy_error);
            assert_true(worst < 1e-13);
            assert_true(out.m->stats.energy_error < 1e-8);
        } else {
            print_message("redundant: driver %s: %s\n", second[i].law,
                          out.status == FW_OK ? "ACCEPTED" : out.message);
            assert_int_equal(out.status, FW_SOLVER);
            assert_true(strstr(out.message, "first") || strstr(out.message, "second") ||
                        strstr(out.message, "joint A") || strstr(out.message, "joint D"));
        }
        fw_arena_free(arena);
    }
}

/* the other methods: right, or refused in words */
static void test_methods(void **state) {
    (void)state;
    for (size_t i = 0; fw_multibody_method_at(i).name; i++) {
        fw_arena *arena = fw_arena_new(0);
        const fw_dynamics_motion *one = plain_motion(arena);
        rig r = with_copies(arena, 2, 0);
        outcome out =
            hard_try(arena, &r,
                     (fw_dynamics_motion_options){
                         .rtol = 1e-12, .samples = ROWS, .method = fw_multibody_method_at(i).name});
        double worst = out.status == FW_OK ? compare(out.m, one) : 0;
        if (out.status == FW_OK)
            print_message("redundant: hinge D thrice by %-22s: to %.1e\n",
                          fw_multibody_method_at(i).name, worst);
        else
            print_message("redundant: hinge D thrice by %-22s: %s\n",
                          fw_multibody_method_at(i).name, out.message);
        assert_true(worst < 1e-9);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hinge_twice_and_thrice),
        cmocka_unit_test(test_hinge_slightly_elsewhere),
        cmocka_unit_test(test_guides_and_welds),
        cmocka_unit_test(test_drivers),
        cmocka_unit_test(test_methods),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
