/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tendons and electrodes in motion, against closed forms. */
#include "quantity/law_kind.h"
#include "models.h"

static const double PI = 3.14159265358979323846, eps0 = 8.8541878128e-12;

typedef struct fixture {
    fw_arena *arena;
    fw_diags diags;
} fixture;

static fixture begin(void) {
    fixture f = {.arena = fw_arena_new(0)};
    f.diags = fw_diags_new(f.arena);
    return f;
}

static fw_status simulate(fixture *f, const rig *r, int samples, fw_effect_mode mode,
                          const fw_dynamics_motion **motion) {
    const fw_dynamics_motion_options o = {.rtol = 1e-12, .samples = samples, .effects = {.mode = mode}};
    return fw_dynamics_simulate(f->arena, &r->m, &r->scene, &o, &f->diags, motion);
}

static const fw_dynamics_motion *run(fixture *f, const rig *r, int samples) {
    const fw_dynamics_motion *motion = NULL;
    if (simulate(f, r, samples, FW_EFFECTS_AUTO, &motion) != FW_OK)
        fail_msg("%s", f->diags.count ? f->diags.item[0].message : "no diagnostic");
    return motion;
}

static void guide(fixture *f, rig *r, int body, double axis) {
    r->m.joint = fw_arena_array(f->arena, fw_device_joint, 1);
    r->m.joint[r->m.njoint++] = (fw_device_joint){.id = "guide",
                                                  .kind = FW_JOINT_PRISMATIC,
                                                  .body_a = FW_GROUND,
                                                  .body_b = body,
                                                  .ax_m = r->m.body[body].x_m,
                                                  .ay_m = r->m.body[body].y_m,
                                                  .axis_rad = axis};
}

static bool said(const fixture *f, int number) {
    for (size_t i = 0; i < f->diags.count; i++)
        if (f->diags.item[i].number == number) return true;
    return false;
}

/* ---- tendons ---- */

/* straight down from the ring at the origin; slack is fallen through freely, then the mass swings
   on the cable through half a circle of phase and comes back to where it began: period
   2 sqrt(2 s/g) + 2 (pi - atan(w sqrt(2 s/g)))/w, w^2 = k/m */
static void test_slack_fall(void **state) {
    (void)state;
    static const fw_device_eyelet line[] = {{.body = FW_GROUND}, {.body = 0}};
    const double m = 1e-6, k = 0.05, g = 9.81, slack = 0.3e-3, top = -1e-3;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 0, 0);
    rig_body(&r, "bob", m, 1e-13, 0, top, 0);
    guide(&f, &r, 0, PI / 2);
    fw_device_tendon cable = {.id = "cable",
                              .eyelet = (fw_device_eyelet *)line,
                              .neyelet = 2,
                              .pull_N = (double)NAN,
                              .draw_m = 0,
                              .stiffness_N_per_m = k,
                              .slack_m = slack};
    r.scene.tendon = &cable, r.scene.ntendon = 1;
    r.scene.gravity = true, r.scene.gy_m_per_s2 = -g;
    double w = sqrt(k / m), fall = sqrt(2 * slack / g);
    double period = 2 * fall + 2 * (PI - atan(w * fall)) / w;
    r.scene.duration_s = 8 * period;
    const fw_dynamics_motion *o =
        run(&f, &r, 33); /* four samples per period: the second at the bottom */
    double rest = m * g / k, depth = slack + rest + sqrt(rest * rest + 2 * rest * slack);
    for (int i = 0; i < 33; i += 2) {
        double want = i % 4 == 2 ? top - depth : top;
        assert_near(o->q[3 * i + 1], want, 1e-8 * depth);
        assert_near(o->v[3 * i + 1], 0, 1e-6 * g * fall);
    }
    assert_int_equal(o->stats.events, 16);
    assert_true(o->stats.energy_error < 1e-9);
    fw_arena_free(f.arena);
}

/* acceleration of a free body at (x, y) on the taut cable */
static void taut(const double s[4], double k, double m, double g, double rest, double f[4]) {
    double l = hypot(s[0], s[1]), pull = k * (l - rest) / (m * l);
    f[0] = s[2], f[1] = s[3], f[2] = -pull * s[0], f[3] = -pull * s[1] - g;
}

/* a pendulum that starts slack, off the vertical: a parabola until its distance is the rest length
   (a quartic, solved here), then the elastic pendulum, integrated here by 20000 steps of order 4 */
static void test_slack_pendulum(void **state) {
    (void)state;
    static const fw_device_eyelet line[] = {{.body = FW_GROUND}, {.body = 0}};
    const double m = 1e-6, k = 0.2, g = 9.81, slack = 0.4e-3, x = 0.8e-3, y = -1e-3;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 0, 0);
    rig_body(&r, "bob", m, 1e-13, x, y, 0);
    fw_device_tendon cable = {.id = "cable",
                              .eyelet = (fw_device_eyelet *)line,
                              .neyelet = 2,
                              .pull_N = (double)NAN,
                              .stiffness_N_per_m = k,
                              .slack_m = slack};
    r.scene.tendon = &cable, r.scene.ntendon = 1;
    r.scene.gravity = true, r.scene.gy_m_per_s2 = -g;
    rig_velocity(&r, 0, -0.02, 0, 0);
    double rest = hypot(x, y) + slack, low = 0, high = 0.02;
    for (int i = 0; i < 100; i++) {
        double t = 0.5 * (low + high);
        *(hypot(x - 0.02 * t, y - g * t * t / 2) < rest ? &low : &high) = t;
    }
    double s[4] = {x - 0.02 * low, y - g * low * low / 2, -0.02, -g * low}, h = 2e-3 / 20000;
    for (int i = 0; i < 20000; i++) {
        double a[4][4], at[4];
        for (int j = 0; j < 4; j++) {
            for (int c = 0; c < 4; c++)
                at[c] = s[c] + (j ? (j == 3 ? h : h / 2) * a[j - 1][c] : 0);
            taut(at, k, m, g, rest, a[j]);
        }
        for (int c = 0; c < 4; c++)
            s[c] += h / 6 * (a[0][c] + 2 * a[1][c] + 2 * a[2][c] + a[3][c]);
    }
    assert_true(hypot(s[0], s[1]) > rest); /* still taut */
    r.scene.duration_s = low + 2e-3;
    const fw_dynamics_motion *o = run(&f, &r, 2);
    assert_int_equal(o->stats.events, 1);
    assert_near(o->q[3], s[0], 1e-9 * rest);
    assert_near(o->q[4], s[1], 1e-9 * rest);
    assert_near(o->v[3], s[2], 1e-8);
    assert_near(o->v[4], s[3], 1e-8);
    fw_arena_free(f.arena);
}

/* over a corner, pulled by a sine: only its positive halves pull. After each the speed has grown by
   2 P/(m w), and in the other half it stays */
static void test_pulled_by_a_sine(void **state) {
    (void)state;
    static const fw_device_eyelet line[] = {
        {.body = 0}, {.body = FW_GROUND, .x_m = 5e-3}, {.body = FW_GROUND, .x_m = 5e-3, .y_m = -1}};
    static const fw_quantity_law sine = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 1000};
    const double m = 1e-6, pull = 1e-4, w = 2 * PI * 1000;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 0, 0);
    rig_body(&r, "bob", m, 1e-13, 1e-3, 0, 0);
    guide(&f, &r, 0, 0);
    fw_device_tendon cable = {.id = "cable",
                              .eyelet = (fw_device_eyelet *)line,
                              .neyelet = 3,
                              .pull_N = pull,
                              .draw_m = (double)NAN,
                              .law = &sine};
    r.scene.tendon = &cable, r.scene.ntendon = 1;
    r.scene.duration_s = 3e-3;
    const fw_dynamics_motion *o = run(&f, &r, 7);
    double speed = 0, place = 1e-3;
    for (int i = 0; i < 7; i++) {
        assert_near(o->v[3 * i], speed, 1e-9);
        assert_near(o->q[3 * i], place, 1e-11);
        /* half a period: x'' = P/m sin: x grows by v h + P/(m w) h */
        place += speed * 0.5e-3 + (i % 2 ? 0 : pull / (m * w) * 0.5e-3);
        if (i % 2 == 0) speed += 2 * pull / (m * w);
    }
    assert_true(o->stats.energy_error < 1e-9); /* the actuator's work is counted */
    fw_arena_free(f.arena);
}

/* ---- electrodes ---- */

static rig plate(fixture *f, fw_device_comb *c, double volt) {
    *c = (fw_device_comb){.id = "plate",
                          .kind = FW_ELECTRODES_PLATE,
                          .body_a = FW_GROUND,
                          .gap_m = 3e-6,
                          .length_m = 250e-6,
                          .depth_m = 20e-6,
                          .voltage_V = volt};
    rig r = rig_new(f->arena, 1, 0, 0);
    rig_body(&r, "rotor", 2e-9, 1e-17, 0, 0, 0);
    guide(f, &r, 0, 0);
    r.m.joint[0].stiffness_N_per_m = 2;
    r.scene.comb = c, r.scene.ncomb = 1;
    r.scene.duration_s = 1e-3;
    return r;
}

/* A voltage put on at once: k x^2/2 = eps0 A V^2/2 (1/(g - x) - 1/g) where it turns, that is
   k x g (g - x) = eps0 A V^2: it turns below g/2 while V^2 < k g^3/(4 eps0 A), 0.919 of the static
   voltage, and snaps above */
static void test_sudden_voltage(void **state) {
    (void)state;
    const double k = 2, g = 3e-6, area = 250e-6 * 20e-6;
    double sudden = sqrt(k * g * g * g / (4 * eps0 * area));
    static const double share[] = {0.5, 0.98, 1.02};
    for (int i = 0; i < 3; i++) {
        fixture f = begin();
        fw_device_comb c;
        rig r = plate(&f, &c, share[i] * sudden);
        const fw_dynamics_motion *o;
        fw_status status = simulate(&f, &r, 20001, FW_EFFECTS_NONE, &o); /* no fringe */
        if (share[i] > 1) {
            assert_int_equal(status, FW_SOLVER);
            assert_true(said(&f, 242));
            fw_arena_free(f.arena);
            continue;
        }
        assert_int_equal(status, FW_OK);
        double most = 0, turn = 0.5 * g * (1 - sqrt(1 - share[i] * share[i]));
        for (int s = 0; s < 20001; s++)
            most = fmax(most, o->q[3 * s]);
        assert_near(most, turn, 1e-4 * turn); /* the sample nearest to it */
        assert_true(o->stats.energy_error < 1e-9);
        fw_arena_free(f.arena);
    }
}

static void count_again(void *context, const fw_dynamics_instant *instant) {
    int *again = context;
    *again += instant == NULL;
}

/* Where electrodes meet is settled by two runs that end at the same instant: who only wants a decision has no third
   run at the tightest tolerance, and the same reason */
static void test_a_formula_ends(void **state) {
    (void)state;
    int again[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        fixture f = begin();
        fw_device_comb c;
        const rig r = plate(&f, &c, 100);
        const fw_dynamics_motion *o;
        const fw_dynamics_motion_options options = {
            .sparing = k == 1, .observe = count_again, .context = &again[k]};
        assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &options, &f.diags, &o),
                         FW_SOLVER);
        assert_true(said(&f, 242));
        fw_arena_free(f.arena);
    }
    print_message("  run again %d times, sparing %d\n", again[0], again[1]);
    assert_int_equal(again[0], 2);
    assert_int_equal(again[1], 1);
}

/* a voltage that changes: the source's share in the balance of energies */
static void test_energy_of_a_law(void **state) {
    (void)state;
    static const fw_quantity_law sine = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 3000};
    fixture f = begin();
    fw_device_comb c;
    rig r = plate(&f, &c, 5);
    c.law = &sine;
    const fw_dynamics_motion *o = run(&f, &r, 11);
    double most = 0;
    for (int s = 0; s < 11; s++)
        most = fmax(most, fabs(o->q[3 * s]));
    assert_true(most > 1e-9); /* it moves */
    assert_true(o->stats.energy_error < 1e-9);
    assert_false(said(&f, 241));
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slack_fall),       cmocka_unit_test(test_slack_pendulum),
        cmocka_unit_test(test_pulled_by_a_sine), cmocka_unit_test(test_sudden_voltage),
        cmocka_unit_test(test_energy_of_a_law),  cmocka_unit_test(test_a_formula_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
