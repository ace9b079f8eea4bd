/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"
#include "six_bar_fixture.h"
#include "test.h"
#include "workspace/loop.h"

static fw_workspace_result run(six_bar_fixture *f, double x, double y, double phi) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    f->box = (fw_device_workspace_box){.x_min_m = -x,
                                       .x_max_m = x,
                                       .y_min_m = -y,
                                       .y_max_m = y,
                                       .phi_min_rad = -phi,
                                       .phi_max_rad = phi};
    f->device.nworkspace = 1;
    fw_workspace_result result;
    assert_int_equal(fw_workspace_required(arena, &f->mechanism, NULL, &diags, &result), FW_OK);
    fw_arena_free(arena);
    return result;
}

/* no random pose of the box turns a hinge further than what is reported, within its error */
static void corners_and_interior(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    const double box[][3] = {{50e-6, 30e-6, 0.02}, {300e-6, 100e-6, 0.1}, {1e-6, 300e-6, 0.3}};
    uint64_t seed = 1;
    for (size_t b = 0; b < 3; b++) {
        fw_workspace_result r = run(&f, box[b][0], box[b][1], box[b][2]);
        assert_true(r.required && r.reachable && r.certified);
        assert_relative(r.volume_m2_rad, 8 * box[b][0] * box[b][1] * box[b][2], 1e-12);
        for (int i = 0; i < 50000; i++) {
            double u[3], angle[FW_SIX];
            int leg;
            for (int k = 0; k < 3; k++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                u[k] = (2.0 * (double)(seed >> 11) / 9007199254740992.0 - 1.0) * box[b][k];
            }
            assert_true(fw_workspace_six_bar_inverse(&f.mechanism, u[0], u[1], u[2], angle, &leg));
            for (int j = 0; j < FW_SIX; j++)
                assert_true(fabs(angle[j]) <= fabs(r.peak[j].angle_rad) + r.peak[j].error_rad);
        }
    }
}

static void unreachable_pose_is_named(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_result r = run(&f, 3e-3, 1e-6, 0.01);
    assert_true(r.required && !r.reachable);
    assert_true(fabs(r.beyond.pose[0]) > 0.5e-3);
}

static void symmetric_design_gives_symmetric_hinges(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_result r = run(&f, 100e-6, 50e-6, 0.05);
    for (int j = 0; j < 3; j++)
        assert_relative(fabs(r.peak[j].angle_rad), fabs(r.peak[5 - j].angle_rad), 1e-9);
}

/* what rides on one body leaves the platform free; what joins two, or drives a hinge, does not */
static void riders(void **state) {
    (void)state;
    const struct {
        fw_device_joint joint[3];
        fw_mechanism_pin pin;
        int nbody, njoint, npin, driven; /* driven: 1 + joint */
        const char *held;
    } row[] = {
        {.nbody = 5},
        {{{.id = "t", .body_a = 2, .body_b = 5}}, .nbody = 6, .njoint = 1},
        {{{.id = "t", .body_a = 2, .body_b = FW_GROUND}}, .nbody = 5, .njoint = 1, .held = "t"},
        {{{.id = "t", .body_a = 0, .body_b = 3}}, .nbody = 5, .njoint = 1, .held = "t"},
        /* a loop of riders on the platform */
        {{{.id = "t", .body_a = 2, .body_b = 5},
          {.id = "u", .body_a = 5, .body_b = 6},
          {.id = "v", .body_a = 6, .body_b = 2}},
         .nbody = 7,
         .njoint = 3},
        /* the same loop over the platform and a link, closed by a pin */
        {{{.id = "t", .body_a = 2, .body_b = 5}, {.id = "u", .body_a = 6, .body_b = 5}},
         .pin = {.id = "p", .body_a = FW_GROUND, .body_b = 6},
         .nbody = 7,
         .njoint = 2,
         .npin = 1,
         .held = "t"},
        {.nbody = 5, .driven = 3, .held = "drive"},
        {.pin = {.id = "p", .body_a = 2, .body_b = 5}, .nbody = 6, .npin = 1, .driven = 7},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        six_bar_fixture f;
        six_bar_make(&f, six_bar_reference);
        fw_mechanism_pin pin[FW_SIX + 1];
        memcpy(pin, f.mechanism.pin, FW_SIX * sizeof pin[0]);
        pin[FW_SIX] = row[i].pin;
        fw_device_driver driver = {.id = "drive", .revolute = row[i].driven - 1, .joint = FW_NONE};
        fw_mechanism m = f.mechanism;
        fw_device_joint joint[3];
        memcpy(joint, row[i].joint, sizeof joint);
        m.pin = pin, m.joint = joint, m.driver = &driver;
        m.npin = FW_SIX + row[i].npin, m.njoint = row[i].njoint, m.nbody = row[i].nbody;
        m.ndriver = row[i].driven > 0;
        fw_arena *arena = fw_arena_new(0);
        const char *held = "?";
        assert_int_equal(fw_workspace_six_bar_foreign_joint(arena, &m, &held), FW_OK);
        if (!held != !row[i].held || (held && strcmp(held, row[i].held) != 0))
            fail_msg("row %zu: %s", i, held ? held : "none");
        /* and the required workspace says so */
        fw_diags diags = fw_diags_new(arena);
        fw_workspace_result result;
        f.box = (fw_device_workspace_box){.x_min_m = -1e-6, .x_max_m = 1e-6};
        f.device.nworkspace = 1;
        fw_mechanism_mass mass[7] = {0};
        memcpy(mass, f.mechanism.body, 5 * sizeof mass[0]);
        m.body = mass;
        assert_int_equal(fw_workspace_required(arena, &m, NULL, &diags, &result),
                         held ? FW_INPUT : FW_OK);
        if (held) assert_int_equal(diags.item[0].number, 200);
        fw_arena_free(arena);
    }
}

/* What is kept of proofs, of the last eight boxes, changes nothing of what is said: twelve boxes, and all of them once more */
static void what_is_kept_is_what_is_proved(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_workspace_kept *kept;
    assert_int_equal(fw_workspace_kept_new(arena, &kept), FW_OK);
    for (int i = 0; i < 24; i++) {
        const double x = 1e-6 * (20 + i % 12);
        const fw_workspace_result fresh = run(&f, x, x, 0.01);
        fw_workspace_result again;
        assert_int_equal(fw_workspace_required(arena, &f.mechanism, kept, &diags, &again), FW_OK);
        assert_true(fresh.certified && again.certified);
        for (int j = 0; j < FW_SIX; j++)
            assert_true(again.peak[j].angle_rad == fresh.peak[j].angle_rad && again.peak[j].error_rad == fresh.peak[j].error_rad);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_and_interior),
        cmocka_unit_test(unreachable_pose_is_named),
        cmocka_unit_test(symmetric_design_gives_symmetric_hinges),
        cmocka_unit_test(riders),
        cmocka_unit_test(what_is_kept_is_what_is_proved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
