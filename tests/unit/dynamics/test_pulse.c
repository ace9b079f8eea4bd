/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Short loads and drivers after a long rest. An oscillator I theta'' + k theta = T exp(-(t/w)^2)
   with I = k = 2 and T = 1 in SI swings with T/I w sqrt(pi) exp(-(w/2)^2) after a bell of width w,
   exactly when the bell is over. Every integrator must be right within the error that it states,
   and state an error that is worth something. */
#include "quantity/law_kind.h"
#include "models.h"

static const double pi = 3.14159265358979323846;

static fw_quantity_law bell(fw_arena *arena, double height, double centre_s, double w_s) {
    static const fw_quantity_names none = {NULL, 0};
    fw_quantity_expression_error error;
    fw_quantity_program *p;
    const char *text =
        fw_arena_printf(arena, "%.17g*exp(-((t - %.17g s)/(%.17g s))^2)", height, centre_s, w_s);
    assert_int_equal(fw_quantity_program_compile(arena, text, strlen(text), &none,
                                                 (fw_quantity_dimension){0}, &p, &error),
                     FW_OK);
    return (fw_quantity_law){.kind = &fw_quantity_law_expression, .program = p};
}

static rig oscillator(fw_arena *arena, const fw_quantity_law *law) {
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "p", 1, 1, 1, 0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 2, 0);
    rig_torque(&r, 0, 1);
    r.scene.torque[0].law = law;
    r.scene.duration_s = 10;
    return r;
}

static fw_dynamics_peak peak_of(fw_arena *arena, const rig *r, const char *integrator, double rtol,
                                int pin) {
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *motion;
    const fw_dynamics_motion_options o = {.integrator = integrator, .rtol = rtol};
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    /* warnings may say that the tolerance is too loose, or that rk4 cannot do better */
    if (status != FW_OK || diags.errors > 0)
        fail_msg("%s: %s", integrator, diags.count ? diags.item[0].message : "");
    return motion->peak[pin];
}

static double swing(double w) {
    return 0.5 * w * sqrt(pi) * exp(-w * w / 4);
}

/* 10 to 300 ms in 10 s, 0.508 to 14.894 deg */
static void test_every_integrator(void **state) {
    (void)state;
    const size_t every = (size_t)test_cases(1, 4); /* the widths share the integrators */
    const double width[] = {0.01, 0.03, 0.1, 0.3}, degrees[] = {0.508, 1.523, 5.065, 14.894};
    for (int i = 0; i < 4; i++) {
        assert_near(swing(width[i]) * 180 / pi, degrees[i], 5e-4);
        for (size_t k = (size_t)i % every; fw_dynamics_integrator_at(k).name; k += every) {
            const char *name = fw_dynamics_integrator_at(k).name;
            fw_arena *arena = fw_arena_new(0);
            const fw_quantity_law law = bell(arena, 1, 4.3, width[i]);
            const rig r = oscillator(arena, &law);
            fw_dynamics_peak p = peak_of(arena, &r, name, 0, 0);
            double error = fabs(fabs(p.angle_rad) - swing(width[i]));
            if (error > p.error_rad || p.error_rad > 1e-3 * swing(width[i]))
                fail_msg("%s, %g s: off by %g, stated %g of %g", name, width[i], error, p.error_rad,
                         swing(width[i]));
            fw_arena_free(arena);
        }
    }
}

/* widths from 30 us to 1 s anywhere in 10 s, at all tolerances: what is stated holds */
static void test_honest(void **state) {
    (void)state;
    const char *const name[] = {"auto", "dopri5", "radau5", "gsl-msadams", "rk4"};
    const double rtol[] = {1e-5, 1e-6, 1e-7, 1e-9, 0};
    uint64_t seed = 5;
    double worst = 0;
    for (int i = 0; i < test_cases(200, 50); i++) {
        double u[2];
        for (int k = 0; k < 2; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            u[k] = (double)(seed >> 11) / 9007199254740992.0;
        }
        double w = 3e-4 * pow(1000, u[0]), centre = 4 * w + (8 - 6 * w - pi) * u[1];
        fw_arena *arena = fw_arena_new(0);
        const fw_quantity_law law = bell(arena, 1, centre, w);
        const rig r = oscillator(arena, &law);
        fw_dynamics_peak p = peak_of(arena, &r, name[i % 5], rtol[i / 5 % 5], 0);
        double error = fabs(fabs(p.angle_rad) - swing(w));
        worst = fmax(worst, error / p.error_rad);
        if (error > p.error_rad)
            fail_msg("%s at %g: bell of %g s at %g s: off by %g, stated %g of %g", name[i % 5],
                     rtol[i / 5 % 5], w, centre, error, p.error_rad, swing(w));
        fw_arena_free(arena);
    }
    print_message("  worst error/estimate %.2f\n", worst);
}

/* a slide that is shaken for 20 ms throws the rod that hangs from it: against a run with steps of a
   tenth of a millisecond around the jerk, which needs no strides to see it */
static void test_driver(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_quantity_law shake = bell(arena, 0.1, 4.3, 20e-3),
                          early = bell(arena, 0.1, 0.1, 20e-3);
    double peak[2], stated[2];
    for (int i = 0; i < 2; i++) {
        rig r = rig_new(arena, 2, 1, 0);
        rig_body(&r, "p", 1, 1, 0, 0, 0);
        rig_body(&r, "q", 1, 0.1, 0, -0.5, -pi / 2);
        rig_pin(&r, "R", 0, 1, 0, 0, 1, 0)->free_angle_rad = -pi / 2;
        r.m.joint = fw_arena_one(arena, fw_device_joint);
        *r.m.joint = (fw_device_joint){
            .id = "P", .kind = FW_JOINT_PRISMATIC, .body_a = FW_GROUND, .body_b = 0};
        r.m.njoint = 1;
        r.m.driver = fw_arena_one(arena, fw_device_driver);
        *r.m.driver = (fw_device_driver){
            .id = "d", .revolute = FW_NONE, .joint = 0, .law = i ? early : shake};
        r.m.ndriver = 1;
        r.scene.duration_s = i ? 5.8 : 10;
        fw_dynamics_peak p = peak_of(arena, &r, NULL, i ? 1e-12 : 0, 0);
        peak[i] = fabs(p.angle_rad), stated[i] = p.error_rad;
    }
    assert_true(peak[1] > 0.1);
    assert_near(peak[0], peak[1], stated[0] + stated[1]);
    assert_true(stated[0] < 1e-3 * peak[0]);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_integrator),
        cmocka_unit_test(test_honest),
        cmocka_unit_test(test_driver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
