/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A judged device as one list of numbers, by which the search for the least change goes: every check has a place of its own, so that none
   hides another one. The verdict is put down by hand: of two scenes, two boxes, a hinge and a reason about no scene each check has another
   number. */
#include "verdict/advice.h"
#include "test.h"
#include <math.h>

enum { JOINT, CLEARANCE, BOX = CLEARANCE + 2, PULL_IN = BOX + 2, REASON = PULL_IN + 2, OTHER = REASON + 2, CHECKS };

static fw_verdict_clearance apart(const char *scene, int box, double low_m) {
    return (fw_verdict_clearance){.scene = scene,
                                  .box = box,
                                  .least = {.m = low_m, .start_m = 10e-6},
                                  .m = low_m,
                                  .low_m = low_m,
                                  .high_m = low_m,
                                  .required_m = 5e-6};
}

static void every_check_has_its_own_place(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_device_scene scene[] = {{.name = "push"}, {.name = "pull"}};
    fw_device_workspace_box box[2] = {0};
    fw_device_revolute revolute[] = {{.id = "A"}};
    const fw_device device = {
        .scene = scene, .nscene = 2, .workspace = box, .nworkspace = 2, .revolute = revolute, .nrevolute = 1};
    const fw_statics_pull_in near = {.kind = FW_PULL_IN_FOLD, .margin = 4}, far = {.kind = FW_PULL_IN_FOLD, .margin = 8};
    const fw_statics_pull_in *pull_in[] = {&near, &far};
    fw_verdict_clearance clearance[] = {apart("pull", FW_NONE, 3e-6), apart("push", FW_NONE, 4e-6), apart("workspace", 0, 1e-6),
                                        apart("workspace", 1, 2e-6)};
    fw_verdict_reason reason[] = {{.number = 1, .scene = "pull", .keep = 0.5, .decision = FW_REJECT},
                                  {.number = 1, .scene = "push", .keep = 0.8, .decision = FW_REJECT},
                                  {.number = 1, .keep = 0.1, .decision = FW_REJECT}};
    fw_verdict_hinge_verdict hinge = {.scene = "push", .utilisation = 0.6, .utilisation_high = 0.7};
    fw_mechanism_variant flow = {.flow = "one"};
    fw_verdict_variant_verdict variant = {.variant = &flow,
                                          .pull_in = pull_in,
                                          .clearance = clearance,
                                          .nclearance = 4,
                                          .reason = reason,
                                          .nreason = 3,
                                          .hinge = &hinge,
                                          .nhinge = 1};
    const fw_verdict verdict = {.variant = &variant, .nvariant = 1};
    fw_verdict_options options = {0};
    fw_verdict_trial trial;
    assert_int_equal(fw_verdict_trial_start(arena, &device, &options, &verdict, &trial), FW_OK);
    const double want[CHECKS] = {[JOINT] = log(0.7),
                                 [CLEARANCE] = 0.1,
                                 [CLEARANCE + 1] = 0.2,
                                 [BOX] = 0.4,
                                 [BOX + 1] = 0.3,
                                 [PULL_IN] = log(1 / 4.0),
                                 [PULL_IN + 1] = log(1 / 8.0),
                                 [REASON] = log(1 / 0.8),
                                 [REASON + 1] = log(1 / 0.5),
                                 [OTHER] = log(1 / 0.1)};
    assert_int_equal(trial.ncheck, CHECKS);
    for (int i = 0; i < CHECKS; i++)
        assert_near(trial.check[i], want[i], 1e-12);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_check_has_its_own_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
