/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects of general mechanisms: loads with laws, stops, sliding joints, cables; and the static
   response of mechanisms with joints and drivers. */
#include "quantity/law_kind.h"
#include "effects/effects.h"
#include "test.h"

enum { BODIES = 3 };
typedef struct bench {
    fw_arena *arena;
    fw_diags diags;
    fw_mechanism_mass body[BODIES];
    fw_mechanism_pin pin[4];
    fw_device_joint joint[4];
    fw_device_driver driver[2];
    fw_device_spring spring[2];
    fw_device_force force[2];
    fw_device_torque torque[2];
    fw_device_initial initial[1];
    fw_mechanism m;
    fw_device_scene scene;
    fw_effect_ledger ledger;
    fw_effects_loads loads;
} bench;

static const double none = (double)NAN;

static void bench_new(bench *b) {
    memset(b, 0, sizeof *b);
    b->arena = fw_arena_new(0);
    b->diags = fw_diags_new(b->arena);
    b->body[0] = (fw_mechanism_mass){"a", 2, 0.3, 1.0, 0.5, 0.4, {0, 0}};
    b->body[1] = (fw_mechanism_mass){"b", 1, 0.2, 3.0, 1.5, -0.3, {0, 0}};
    b->body[2] = (fw_mechanism_mass){"c", 3, 0.5, -1.0, 2.0, 1.1, {0, 0}};
    for (int i = 0; i < 4; i++)
        b->pin[i] = (fw_mechanism_pin){
            .body_a = FW_GROUND, .hinge = FW_NONE, .stop_min_rad = none, .stop_max_rad = none};
    b->m = (fw_mechanism){.body = b->body,
                          .pin = b->pin,
                          .joint = b->joint,
                          .driver = b->driver,
                          .spring = b->spring,
                          .nbody = BODIES};
    b->scene = (fw_device_scene){.name = "s",
                                 .duration_s = 1,
                                 .force = b->force,
                                 .torque = b->torque,
                                 .initial = b->initial};
}

static void compile(bench *b) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_AUTO};
    assert_int_equal(fw_effects_compile(b->arena, &b->m, &b->scene, &choice, 1e-3, &b->diags,
                                        &b->ledger, &b->loads),
                     FW_OK);
}

static const fw_effect_entry *entry(const bench *b, const char *id) {
    for (int i = 0; i < b->ledger.count; i++)
        if (strcmp(b->ledger.item[i].id, id) == 0) return &b->ledger.item[i];
    fail_msg("no effect %s", id);
    return NULL;
}

static void loads_with_laws(void **state) {
    (void)state;
    static const fw_quantity_law always = {.kind = &fw_quantity_law_step,
                                           .end_s = (double)INFINITY};
    static const fw_quantity_law late = {
        .kind = &fw_quantity_law_step, .start_s = 0.5, .end_s = (double)INFINITY};
    static const fw_quantity_law cosine = {.kind = &fw_quantity_law_sine,
                                           .end_s = (double)INFINITY,
                                           .frequency_Hz = 3,
                                           .phase_rad = 0.5};
    bench b;
    bench_new(&b);
    b.force[0] = (fw_device_force){.body = 0, .fx_N = 5, .fy_N = 7, .law = &always};
    b.force[1] = (fw_device_force){.body = 1, .x_m = 0.2, .fx_N = 2, .law = &late};
    b.torque[0] = (fw_device_torque){.body = 2, .value_Nm = 4, .law = &cosine};
    b.torque[1] = (fw_device_torque){.body = 2, .value_Nm = 9};
    b.scene.nforce = b.scene.ntorque = 2;
    compile(&b);
    assert_true(entry(&b, "applied-load")->active);
    assert_true(b.loads.constant[0] == 5 && b.loads.constant[1] == 7); /* a step from 0 is none */
    assert_true(b.loads.constant[8] == 9);
    assert_int_equal(b.loads.nload, 0);
    assert_int_equal(b.loads.ntimed, 2);
    assert_true(b.loads.timed[0].law == &late && b.loads.timed[0].x_m == 0.2);
    assert_true(b.loads.timed[1].torque_Nm == 4 && b.loads.timed[1].fx_N == 0);
    double force[9];
    fw_effects_loads_initial_force(&b.m, &b.loads, force);
    assert_true(force[3] == 0 && force[4] == 0 && force[5] == 0); /* not yet */
    assert_near(force[8], 9 + 4 * sin(0.5), 1e-14);
    fw_arena_free(b.arena);
}

static void stops(void **state) {
    (void)state;
    bench b;
    bench_new(&b);
    b.m.npin = 2;
    b.pin[0].body_b = 0;
    compile(&b);
    assert_false(entry(&b, "joint-stop")->called_for);
    assert_int_equal(b.loads.nstop, 0);
    /* body a stands at 0.4: the upper stop at 0.1 + free angle 0.2 is pressed in by 0.1 */
    b.pin[0].free_angle_rad = 0.2;
    b.pin[0].stop_min_rad = -0.5, b.pin[0].stop_max_rad = 0.1;
    b.pin[0].stop_stiffness_Nm_per_rad = 30, b.pin[0].stop_damping_Nms_per_rad = 2;
    /* between a and b the angle is -0.7: the lower stop at -0.4 is pressed in by 0.3 */
    b.pin[1].body_a = 0, b.pin[1].body_b = 1;
    b.pin[1].stop_min_rad = -0.4, b.pin[1].stop_stiffness_Nm_per_rad = 10;
    compile(&b);
    const fw_effect_entry *e = entry(&b, "joint-stop");
    assert_true(e->called_for && e->active && isinf(e->bound));
    assert_int_equal(b.loads.nstop, 3);
    assert_true(b.loads.stop[0].side == -1 && b.loads.stop[0].at_rad == -0.5);
    assert_true(b.loads.stop[1].side == 1 && b.loads.stop[1].at_rad == 0.1 &&
                b.loads.stop[1].stiffness_Nm_per_rad == 30 &&
                b.loads.stop[1].damping_Nms_per_rad == 2 && b.loads.stop[1].free_angle_rad == 0.2);
    double force[9];
    fw_effects_loads_initial_force(&b.m, &b.loads, force);
    assert_near(force[2], -30 * 0.1 - 10 * 0.3, 1e-13);
    assert_near(force[5], 10 * 0.3, 1e-13);
    fw_arena_free(b.arena);
}

/* elastic energy of slides and springs at a pose, written down on its own */
static double energy(const bench *b, const double *q) {
    double v = 0;
    for (int i = 0; i < b->m.njoint + b->m.nspring; i++) {
        bool slide = i < b->m.njoint;
        const fw_device_joint *t = &b->joint[slide ? i : 0];
        const fw_device_spring *s = &b->spring[slide ? 0 : i - b->m.njoint];
        int body[2] = {slide ? t->body_a : s->body_a, slide ? t->body_b : s->body_b};
        const double local[4] = {slide ? t->ax_m : s->ax_m, slide ? t->ay_m : s->ay_m,
                                 slide ? t->bx_m : s->bx_m, slide ? t->by_m : s->by_m};
        double x[2], y[2];
        for (int k = 0; k < 2; k++) {
            const double ground[3] = {0};
            const double *at = body[k] == FW_GROUND ? ground : &q[3 * body[k]];
            x[k] = at[0] + cos(at[2]) * local[2 * k] - sin(at[2]) * local[2 * k + 1];
            y[k] = at[1] + sin(at[2]) * local[2 * k] + cos(at[2]) * local[2 * k + 1];
        }
        if (slide) {
            double turn = t->axis_rad + (t->body_a == FW_GROUND ? 0 : q[3 * t->body_a + 2]);
            double s_m = (x[1] - x[0]) * cos(turn) + (y[1] - y[0]) * sin(turn) - t->free_length_m;
            v += t->stiffness_N_per_m * s_m * s_m / 2;
        } else {
            double longer = hypot(x[1] - x[0], y[1] - y[0]) - s->length_m;
            if (!s->cable || longer > 0) v += s->stiffness_N_per_m * longer * longer / 2;
        }
    }
    return v;
}

/* the initial force is minus the gradient of the energy, off the constraints too */
static void slides_and_cables(void **state) {
    (void)state;
    bench b;
    bench_new(&b);
    b.joint[0] = (fw_device_joint){.kind = FW_JOINT_PRISMATIC,
                                   .body_a = 0,
                                   .body_b = 1,
                                   .ax_m = 0.3,
                                   .ay_m = -0.2,
                                   .bx_m = 0.1,
                                   .by_m = 0.4,
                                   .axis_rad = 0.7,
                                   .stiffness_N_per_m = 11,
                                   .free_length_m = 0.25};
    b.joint[1] = (fw_device_joint){.kind = FW_JOINT_PRISMATIC,
                                   .body_a = FW_GROUND,
                                   .body_b = 2,
                                   .ax_m = 0.3,
                                   .bx_m = 0.5,
                                   .axis_rad = 2,
                                   .damping_Ns_per_m = 3,
                                   .stiffness_N_per_m = 4};
    b.spring[0] = (fw_device_spring){.body_a = 2,
                                     .body_b = 1,
                                     .ax_m = 0.2,
                                     .by_m = 0.3,
                                     .stiffness_N_per_m = 6,
                                     .length_m = 1,
                                     .cable = true};
    b.spring[1] = (fw_device_spring){.body_a = FW_GROUND,
                                     .body_b = 0,
                                     .ax_m = 2,
                                     .stiffness_N_per_m = 5,
                                     .length_m = 40,
                                     .cable = true};
    b.m.njoint = b.m.nspring = 2;
    compile(&b);
    assert_true(entry(&b, "joint-elasticity")->active && entry(&b, "point-spring")->active);
    assert_int_equal(b.loads.nslide, 2);
    assert_true(b.loads.slide[0].joint == 0 && b.loads.slide[0].stiffness_N_per_m == 11);
    assert_true(b.loads.slide[1].joint == 1 && b.loads.slide[1].damping_Ns_per_m == 3 &&
                b.loads.slide[1].stiffness_N_per_m == 4);
    assert_true(b.loads.nspring == 2 && b.loads.spring[0].cable);
    double force[9], q[9];
    fw_effects_loads_initial_force(&b.m, &b.loads, force);
    for (int i = 0; i < 9; i++) {
        for (int k = 0; k < BODIES; k++)
            q[3 * k] = b.body[k].x_m, q[3 * k + 1] = b.body[k].y_m,
                  q[3 * k + 2] = b.body[k].phi_rad;
        const double at = q[i], h = 1e-3;
        double slope = 0;
        static const double weight[3] = {3.0 / 4, -3.0 / 20, 1.0 / 60};
        for (int k = 1; k <= 3; k++) {
            q[i] = at + k * h;
            double up = energy(&b, q);
            q[i] = at - k * h;
            slope += weight[k - 1] * (up - energy(&b, q)) / h;
        }
        assert_near(force[i], -slope, 1e-9);
    }
    /* the slack one gives nothing */
    b.m.nspring = 1;
    double same[9];
    compile(&b);
    fw_effects_loads_initial_force(&b.m, &b.loads, same);
    assert_memory_equal(force, same, sizeof same);
    fw_arena_free(b.arena);
}

/* a sliding body with a pendulum: the bound of its damper goes with c, and what slides freely has
   nothing to be small against */
static void damping_bound(void **state) {
    (void)state;
    bench b;
    bench_new(&b);
    b.m.nbody = 2, b.m.njoint = b.m.npin = 1;
    b.joint[0] = (fw_device_joint){.kind = FW_JOINT_PRISMATIC,
                                   .body_a = FW_GROUND,
                                   .body_b = 0,
                                   .by_m = 0.4,
                                   .damping_Ns_per_m = 1e-3};
    b.pin[0] = (fw_mechanism_pin){.body_a = 0,
                                  .body_b = 1,
                                  .ax_m = 0.1,
                                  .bx_m = -0.5,
                                  .free_angle_rad = -0.7,
                                  .stiffness_Nm_per_rad = 10,
                                  .stop_min_rad = none,
                                  .stop_max_rad = none};
    b.force[0] = (fw_device_force){.body = 0, .fx_N = 1e-2};
    b.scene.nforce = 1;
    compile(&b);
    const fw_effect_entry *e = entry(&b, "joint-damping");
    assert_true(e->called_for && e->active && isinf(e->bound));
    assert_non_null(strstr(e->reason, "freely"));
    b.joint[0].stiffness_N_per_m = 100;
    b.joint[0].free_length_m = b.body[0].x_m - 0.4 * sin(0.4);
    double before = 0;
    for (double c = 1e-8; c < 1e-1; c *= 10) {
        b.joint[0].damping_Ns_per_m = c;
        compile(&b);
        e = entry(&b, "joint-damping");
        assert_true(isfinite(e->bound) && e->bound > 0);
        assert_int_equal(e->active, e->bound >= 1e-3);
        assert_true((b.loads.slide[0].damping_Ns_per_m > 0) == e->active);
        if (before > 0) assert_true(e->bound > 9 * before && e->bound < 11 * before);
        before = e->bound;
    }
    assert_true(entry(&b, "joint-damping")->active);
    fw_arena_free(b.arena);
}

/* where linear theory has nothing to say, even the smallest weight stays: a driver, a stop within
   reach, a cable. A load that comes late is no reason. */
static void gravity_is_kept(void **state) {
    (void)state;
    static const fw_quantity_law late = {
        .kind = &fw_quantity_law_step, .start_s = 0.5, .end_s = (double)INFINITY};
    for (int i = 0; i < 6; i++) {
        bench b;
        bench_new(&b);
        b.m.npin = 3;
        for (int k = 0; k < 3; k++) {
            b.pin[k].body_b = k, b.pin[k].bx_m = 0.1, b.pin[k].stiffness_Nm_per_rad = 1;
            b.pin[k].free_angle_rad = b.body[k].phi_rad;
        }
        b.scene.gravity = true, b.scene.gy_m_per_s2 = -1e-9;
        b.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-2};
        b.scene.ntorque = 1;
        if (i == 1) b.torque[0].law = &late;
        if (i == 2)
            b.m.ndriver = 1, b.driver[0] = (fw_device_driver){.revolute = 0, .joint = FW_NONE};
        if (i == 3 || i == 5)
            b.pin[1].stop_max_rad = i == 3 ? 1e-3 : 1, b.pin[1].stop_stiffness_Nm_per_rad = 1;
        if (i == 4)
            b.spring[0] = (fw_device_spring){
                .body_a = 0, .body_b = 1, .stiffness_N_per_m = 1, .length_m = 9, .cable = true};
        if (i == 4) b.m.nspring = 1;
        compile(&b);
        bool kept = i == 2 || i == 3 || i == 4;
        assert_int_equal(entry(&b, "gravity")->active, kept);
        assert_true(isinf(entry(&b, "gravity")->bound) == kept);
        fw_arena_free(b.arena);
    }
}

/* ---- static response with joints, against solutions by hand ---- */

static void respond(bench *b, const double *force, double *u, double *turn, bool expected) {
    bool valid;
    assert_int_equal(fw_effects_static_response(b->arena, &b->m, &b->loads, force, u, turn, &valid),
                     FW_OK);
    assert_int_equal(valid, expected);
}

static void response_of_a_slider(void **state) {
    (void)state;
    bench b;
    bench_new(&b);
    double u[9], turn[4];
    b.m.nbody = 1;
    b.body[0].phi_rad = 0;
    b.joint[0] = (fw_device_joint){.kind = FW_JOINT_PRISMATIC,
                                   .body_a = FW_GROUND,
                                   .body_b = 0,
                                   .axis_rad = 0.6,
                                   .bx_m = 0.3,
                                   .stiffness_N_per_m = 50};
    b.m.njoint = 1;
    compile(&b);
    const double pull[3] = {3, 4, 7}; /* only the part along the axis moves it */
    respond(&b, pull, u, turn, true);
    double along = (3 * cos(0.6) + 4 * sin(0.6)) / 50;
    assert_near(u[0], along * cos(0.6), 1e-14);
    assert_near(u[1], along * sin(0.6), 1e-14);
    assert_near(u[2], 0, 1e-14);
    /* driven, it stays; without its spring it is free */
    b.driver[0] = (fw_device_driver){.revolute = FW_NONE, .joint = 0};
    b.m.ndriver = 1;
    respond(&b, pull, u, turn, true);
    for (int i = 0; i < 3; i++)
        assert_near(u[i], 0, 1e-14);
    b.m.ndriver = 0;
    b.joint[0].stiffness_N_per_m = 0;
    compile(&b);
    respond(&b, pull, u, turn, false);
    fw_arena_free(b.arena);
}

/* Two levers of arm 1 on springs k1 and k2, turned by 0.4 and -0.3, joined by a rod from tip to
   tip: with the rod's direction e, e.t1 theta1 = e.t2 theta2 (tips move along t1, t2) and virtual
   work (k1 theta1 - T) dtheta1 + k2 theta2 dtheta2 = 0. */
static void response_of_levers_and_a_rod(void **state) {
    (void)state;
    bench b;
    bench_new(&b);
    double u[9], turn[4];
    b.m.nbody = 2;
    b.body[0] = (fw_mechanism_mass){"a", 1, 1, 0.5 * cos(0.4), 0.5 * sin(0.4), 0.4, {0, 0}};
    b.body[1] = (fw_mechanism_mass){"b", 1, 1, 3 + 0.5 * cos(-0.3), 0.5 * sin(-0.3), -0.3, {0, 0}};
    for (int i = 0; i < 2; i++) {
        b.pin[i].body_b = i, b.pin[i].ax_m = 3 * i, b.pin[i].bx_m = -0.5;
        b.pin[i].stiffness_Nm_per_rad = i ? 20 : 10;
    }
    b.m.npin = 2;
    b.joint[0] = (fw_device_joint){.kind = FW_JOINT_DISTANCE,
                                   .body_a = 0,
                                   .body_b = 1,
                                   .ax_m = 0.5,
                                   .bx_m = 0.5,
                                   .length_m = 3};
    b.m.njoint = 1;
    compile(&b);
    const double torque[6] = {0, 0, 5, 0, 0, 0};
    respond(&b, torque, u, turn, true);
    double ex = 3 + cos(-0.3) - cos(0.4), ey = sin(-0.3) - sin(0.4), l = hypot(ex, ey);
    double e1 = (-ex * sin(0.4) + ey * cos(0.4)) / l, e2 = (-ex * sin(-0.3) + ey * cos(-0.3)) / l;
    double ratio = e1 / e2; /* theta2 / theta1 */
    double theta = 5 / (10 + 20 * ratio * ratio);
    assert_near(turn[0], theta, 1e-13);
    assert_near(turn[1], ratio * theta, 1e-13);
    /* the rod's length driven: its row replaces the rod's own, nothing changes */
    double same[9], again[4];
    b.driver[0] = (fw_device_driver){.revolute = FW_NONE, .joint = 0};
    b.m.ndriver = 1;
    respond(&b, torque, same, again, true);
    assert_near(again[0], turn[0], 1e-15);
    /* a hinge driven: all stand still */
    b.driver[0] = (fw_device_driver){.revolute = 1, .joint = FW_NONE};
    respond(&b, torque, same, again, true);
    assert_near(again[0], 0, 1e-14);
    assert_near(again[1], 0, 1e-14);
    fw_arena_free(b.arena);
}

/* a lever welded to a second body is one lever: tip force at arm 2.5 on a spring k */
static void response_of_a_weld(void **state) {
    (void)state;
    bench b;
    bench_new(&b);
    double u[9], turn[4];
    b.m.nbody = 2;
    b.body[0] = (fw_mechanism_mass){"a", 1, 1, 0.5, 0, 0, {0, 0}};
    b.body[1] = (fw_mechanism_mass){"b", 1, 1, 1.75, 0, 0.9, {0, 0}};
    b.pin[0].body_b = 0, b.pin[0].bx_m = -0.5, b.pin[0].stiffness_Nm_per_rad = 40;
    b.m.npin = 1;
    b.joint[0] = (fw_device_joint){.kind = FW_JOINT_WELD,
                                   .body_a = 0,
                                   .body_b = 1,
                                   .ax_m = 0.5,
                                   .bx_m = -0.75 * cos(0.9),
                                   .by_m = 0.75 * sin(0.9),
                                   .angle_rad = 0.9};
    b.m.njoint = 1;
    compile(&b);
    const double modal_load[6] = {0, 0, 0, 0, 8, 0};
    respond(&b, modal_load, u, turn, true);
    assert_near(turn[0], 8 * 1.75 / 40, 1e-14);
    assert_near(u[4], 1.75 * turn[0], 1e-14);
    assert_near(u[5], turn[0], 1e-14);
    fw_arena_free(b.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_with_laws),
        cmocka_unit_test(stops),
        cmocka_unit_test(slides_and_cables),
        cmocka_unit_test(damping_bound),
        cmocka_unit_test(gravity_is_kept),
        cmocka_unit_test(response_of_a_slider),
        cmocka_unit_test(response_of_levers_and_a_rod),
        cmocka_unit_test(response_of_a_weld),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
