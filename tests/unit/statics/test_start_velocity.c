/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocities at the start of mechanisms whose flexures must give way to move at all. */
#include "effects/hinge_rigs.h"
#include "quantity/law_kind.h"
#include "statics/statics.h"

static const fw_dynamics_motion *moved(rig *r, fw_effects_hinge_model hinge) {
    const fw_dynamics_motion_options o = {
        .effects = {.mode = FW_EFFECTS_ALL, .hinge = hinge}, .accuracy = 1e-4, .samples = 11};
    const fw_dynamics_motion *x = NULL;
    if (fw_statics_move_scene(r->arena, &r->m, &r->scene, &o, &r->diags, &x) != FW_OK)
        fail_msg("%s", r->diags.count ? r->diags.item[r->diags.count - 1].message : "?");
    return x;
}

static const fw_mechanism_mass block = {"stage", 1e-8, 1e-15, 0, 0, 0, {0, 0}};

/* a stage on two flexures of the ground: with pins it could not move; it starts as stated */
static void a_stage_starts_as_stated(void **state) {
    (void)state;
    for (int exact = 0; exact < 2; exact++) {
        rig r;
        rig_new(&r, 1, 2);
        r.body[0] = block;
        rig_hinge(&r, 0, "A", FW_GROUND, 0, (fw_geometry_vec2){-5e-4, 0}, 0, true);
        rig_hinge(&r, 1, "B", FW_GROUND, 0, (fw_geometry_vec2){5e-4, 0}, 0, true);
        for (int i = 0; i < 2; i++)
            rig_strip(&r.hinge[i], 147.0790923914665e9);
        fw_device_initial start = {.body = 0, .vx_m_per_s = 0.05, .turns_free = true};
        r.scene.initial = &start, r.scene.ninitial = 1;
        r.scene.duration_s = 2e-4;
        const fw_dynamics_motion *x = moved(&r, exact ? FW_HINGE_ELASTICA : FW_HINGE_COMPLIANCE);
        assert_relative(x->v[0], 0.05, 1e-9);
        assert_near(x->v[1], 0, 1e-9);
        /* and swings on both flexures: as far as the energy goes, k x^2/2 = m v^2/2 */
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&r.hinge[0].law, 0, &at);
        double far = 0, k = 2 * at.kx_N_per_m.value;
        for (int i = 0; i < x->nsample; i++)
            far = fmax(far, fabs(x->q[3 * i]));
        assert_true(far > 0.7 * 0.05 * sqrt(1e-8 / k) && far < 1.05 * 0.05 * sqrt(1e-8 / k));
        fw_arena_free(r.arena);
    }
}

/* two stages in a row, the first one's velocity not stated: it goes at half the speed of the second,
   as in a slow displacement */
static void what_is_not_stated_follows(void **state) {
    (void)state;
    rig r;
    rig_new(&r, 2, 4);
    r.body[0] = block, r.body[1] = block;
    r.body[1].y_m = 5e-4;
    for (int i = 0; i < 2; i++) {
        double x = i ? 5e-4 : -5e-4;
        rig_hinge(&r, i, i ? "B" : "A", FW_GROUND, 0, (fw_geometry_vec2){x, -1e-4}, 0, true);
        rig_hinge(&r, 2 + i, i ? "D" : "C", 0, 1, (fw_geometry_vec2){x, 4e-4}, 0, true);
    }
    fw_device_initial start = {.body = 1, .vx_m_per_s = 0.05, .turns_free = true};
    r.scene.initial = &start, r.scene.ninitial = 1;
    r.scene.duration_s = 1e-4;
    const fw_dynamics_motion *x = moved(&r, FW_HINGE_COMPLIANCE);
    assert_relative(x->v[3], 0.05, 1e-9);
    assert_true(x->v[0] > 0.4 * 0.05 && x->v[0] < 0.6 * 0.05);
    fw_arena_free(r.arena);
}

/* a lever on one flexure turns about it, as with a pin: nothing is stretched at the start */
static void a_lever_turns_about_its_hinge(void **state) {
    (void)state;
    rig r;
    rig_new(&r, 1, 1);
    r.body[0] = (fw_mechanism_mass){"lever", 1e-8, 1e-15, 5e-4, 0, 0, {0, 0}};
    rig_hinge(&r, 0, "A", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, 0, true);
    fw_device_initial start = {.body = 0, .omega_rad_per_s = 30, .moves_free = true};
    r.scene.initial = &start, r.scene.ninitial = 1;
    r.scene.duration_s = 1e-4;
    const fw_dynamics_motion *x = moved(&r, FW_HINGE_COMPLIANCE);
    assert_relative(x->v[2], 30, 1e-9);
    assert_relative(x->v[1], 30 * 5e-4, 1e-6);
    assert_near(x->v[0], 0, 1e-9);
    fw_arena_free(r.arena);
}

/* ground that has grown by 0.1 um between two flexures of a stage, one twice as stiff as the other: the stage begins
   where both pull alike, two thirds of the way from the softer, and stays there; pins cannot do that and say so */
static void open_pins_begin_at_rest(void **state) {
    (void)state;
    const double grown = 1e-7, modulus = 147.0790923914665e9;
    for (int exact = 0; exact < 2; exact++) {
        rig r;
        rig_new(&r, 1, 2);
        r.body[0] = block;
        rig_hinge(&r, 0, "A", FW_GROUND, 0, (fw_geometry_vec2){-5e-4, 0}, 0, true);
        rig_hinge(&r, 1, "B", FW_GROUND, 0, (fw_geometry_vec2){5e-4, 0}, 0, true);
        rig_strip(&r.hinge[0], modulus);
        rig_strip(&r.hinge[1], 2 * modulus);
        r.hinge[1].law = rig_h1(2 * modulus);
        r.pin[1].stiffness_Nm_per_rad *= 2;
        r.pin[1].ax_m += grown;
        r.scene.duration_s = 2e-4;
        const fw_dynamics_motion *x = moved(&r, exact ? FW_HINGE_ELASTICA : FW_HINGE_COMPLIANCE);
        for (int i = 0; i < x->nsample; i++) {
            assert_relative(x->q[3 * i], 2 * grown / 3, 1e-3);
            assert_near(x->v[3 * i], 0, 1e-7);
        }
        const fw_dynamics_motion_options o = {.effects = {.hinge = FW_HINGE_REVOLUTE}, .samples = 2};
        assert_int_equal(fw_statics_move_scene(r.arena, &r.m, &r.scene, &o, &r.diags, &x),
                         FW_SOLVER);
        assert_int_equal(r.diags.item[r.diags.count - 1].number, 100);
        fw_arena_free(r.arena);
    }
}

/* a crank that a driver turns from the first instant on, and a flail on a flexure of it: the flail is at rest until the flexure
   pulls it, whatever another body is said to begin with; where it is said to turn with the crank it does, and nothing rings */
static void flexures_pull_after_a_driver(void **state) {
    (void)state;
    const double rate = 50;
    for (int stated = 0; stated < 3; stated++) {
        rig r;
        rig_new(&r, 3, 3);
        r.body[0] = (fw_mechanism_mass){"crank", 1e-8, 1e-15, 0, 0, 0, {0, 0}};
        r.body[1] = (fw_mechanism_mass){"flail", 1e-8, 1e-15, 1e-3, 0, 0, {0, 0}};
        r.body[2] = (fw_mechanism_mass){"other", 1e-8, 1e-15, 0, 3e-3, 0, {0, 0}};
        rig_hinge(&r, 0, "H", 0, 1, (fw_geometry_vec2){5e-4, 0}, 0, true);
        rig_hinge(&r, 1, "A", FW_GROUND, 2, (fw_geometry_vec2){1e-3, 3e-3}, 0, true);
        rig_hinge(&r, 2, "P", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, 0, true);
        r.pin[2].hinge = FW_NONE, r.pin[2].stiffness_Nm_per_rad = 0, r.m.nhinge = 2;
        fw_device_driver turn = {.id = "turn", .revolute = 2, .joint = FW_NONE};
        turn.law = (fw_quantity_law){.kind = &fw_quantity_law_ramp, .rise_s = 1 / rate};
        r.m.driver = &turn, r.m.ndriver = 1;
        fw_device_initial start[2] = {{.body = 2, .omega_rad_per_s = 3, .moves_free = true},
                                      {.body = 1, .vy_m_per_s = rate * 1e-3}};
        start[1].omega_rad_per_s = rate;
        r.scene.initial = start, r.scene.ninitial = stated;
        r.scene.duration_s = 1e-5;
        const fw_dynamics_motion *x = moved(&r, FW_HINGE_COMPLIANCE);
        assert_relative(x->v[2], rate, 1e-9);
        assert_near(x->v[4], stated == 2 ? rate * 1e-3 : 0, 1e-9);
        assert_near(x->v[5], stated == 2 ? rate : 0, 1e-6);
        assert_near(x->v[8], stated ? 3 : 0, 1e-9);
        fw_arena_free(r.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stage_starts_as_stated),
        cmocka_unit_test(what_is_not_stated_follows),
        cmocka_unit_test(a_lever_turns_about_its_hinge),
        cmocka_unit_test(open_pins_begin_at_rest),
        cmocka_unit_test(flexures_pull_after_a_driver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
