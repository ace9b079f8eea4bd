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
    fw_verdict_reason reason[] = {{.number = 1, .scene = "pull", .flow = "one", .keep = 0.5, .decision = FW_REJECT},
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
    /* reasons stand behind the hinges: of loads of which a share is kept they say that so many times too much is there */
    assert_int_equal(trial.nhinge, 3);
    for (int i = 0; i < 3; i++) {
        const fw_verdict_trial_hinge *h = &trial.hinge[i];
        assert_int_equal(h->joint, FW_NONE);
        assert_int_equal(h->decision, FW_REJECT);
        assert_near(h->utilisation_high, 1 / reason[i].keep, 1e-12);
        assert_near(h->likely, 1 / reason[i].keep, 1e-12);
        assert_true(h->scene == reason[i].scene);
        assert_true(h->flow == reason[i].flow);
    }
    fw_arena_free(arena);
}

/* a pair that meets: how much of the time it does, and what is missing of all that is wanted between the two, of where it began, as for one
   that comes too near */
static void pairs_that_meet(void **state) {
    (void)state;
    static const struct {
        double share, start_m, required_m, wall_m, high_m, want;
    } row[] = {{0.3, 10e-6, 5e-6, 1e-6, 2e-6, 0.7 + 0.8 + 0.01}, {1, 20e-6, 0, 0, 0, 0.01}, {0.5, 0, 50e-9, 0, 0, 0.5 + 0.5 + 0.01},
               {0.9, 4e-6, 1e-6, 0, -3e-6, 0.1 + 0.25 + 0.01}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_device_scene scene = {.name = "push"};
        const fw_device device = {.scene = &scene, .nscene = 1};
        fw_verdict_clearance pair = apart("push", FW_NONE, 0);
        pair.least.share = row[i].share, pair.least.start_m = row[i].start_m;
        pair.required_m = row[i].required_m, pair.wall_m = row[i].wall_m, pair.high_m = row[i].high_m;
        fw_mechanism_variant flow = {.flow = "one"};
        fw_verdict_variant_verdict variant = {.variant = &flow, .clearance = &pair, .nclearance = 1};
        const fw_verdict verdict = {.variant = &variant, .nvariant = 1};
        fw_verdict_options options = {0};
        fw_verdict_trial trial;
        assert_int_equal(fw_verdict_trial_start(arena, &device, &options, &verdict, &trial), FW_OK);
        assert_near(trial.check[0], row[i].want, 1e-12);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_check_has_its_own_place),
        cmocka_unit_test(pairs_that_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
