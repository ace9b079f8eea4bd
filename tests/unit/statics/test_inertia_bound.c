/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is the bound on what a row of equilibria misses honest? Random devices and loads as for the other
   effects, most of them slow, with inertia and without. */
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "dynamics/bounds.h"
#include "test.h"

typedef struct score {
    int devices, bounded, left_out, ended, bad;
    double least, most;
} score;

/* loads that take their time: laws stretched to the scene's own, which becomes long */
static void slow_down(bounds_device *d, uint64_t seed) {
    double factor = bounds_log(&seed, 1, 200);
    d->r.scene.duration_s *= factor;
    for (int i = 0; i < d->laws; i++) {
        fw_quantity_law *l = &d->law[i];
        l->start_s *= factor, l->end_s *= factor, l->rise_s *= factor;
        l->frequency_Hz /= factor, l->frequency_most_Hz /= factor;
        if (rig_random(&seed) < 0.8) /* begins at nothing */
            l->phase_rad = 0, d->table_v[i][0] = 0;
        for (int k = 0; k < l->ntable; k++)
            d->table_t[i][k] *= factor;
        if (l->kind != &fw_quantity_law_step) continue;
        l->kind = &fw_quantity_law_ramp; /* a jump is never slow */
        l->rise_s = d->r.scene.duration_s * (0.1 + rig_random(&seed));
    }
    fw_device_scene *s = &d->r.scene; /* what acts from the start on comes in the same way */
    for (int i = 0; i < s->nforce; i++)
        if (!s->force[i].law) s->force[i].law = &d->law[0];
    for (int i = 0; i < s->ntorque; i++)
        if (!s->torque[i].law) s->torque[i].law = &d->law[0];
}

static void try(uint64_t seed, score *to) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    static bounds_device d;
    if (bounds_make(arena, seed, &d)) {
        fw_effect_ledger ledger;
        fw_effects_loads loads;
        const fw_dynamics_motion *row = NULL;
        const char *why = NULL;
        const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
        uint64_t more = seed ^ 0x77;
        if (d.laws > 0 && rig_random(&more) < 0.8) slow_down(&d, seed);
        d.r.scene.ninitial = 0;
        d.r.scene.gravity = rig_random(&more) < 0.1 && d.r.scene.gravity;
        assert_int_equal(
            fw_effects_compile(arena, &d.r.m, &d.r.scene, &all, 1e-3, &diags, &ledger, &loads),
            FW_OK);
        double bound = 0, unknown;
        int ended = 0;
        for (int i = 0; i < ledger.count; i++)
            if (strcmp(ledger.item[i].id, "inertia") == 0) bound = ledger.item[i].bound;
        to->devices++;
        if (isfinite(bound)) {
            const fw_dynamics_motion_options o = {.accuracy = 1e-4};
            fw_status status = fw_statics_quasi_static_motion(arena, &d.r.m, &d.r.scene, &o,
                                                              &ledger, &loads, &diags, &row, &why);
            to->bounded++;
            to->left_out += bound < 0.1;
            if (status == FW_SOLVER) to->ended++;
            assert_true(status == FW_OK || status == FW_SOLVER);
        }
        const fw_dynamics_motion *full =
            row ? bounds_run(arena, &d.r, FW_EFFECTS_ALL, NULL, 1e-3, &ended) : NULL;
        if (full) {
            double change = bounds_apart(full, row, &unknown);
            if (change > bound + unknown) {
                to->bad++;
                print_error("seed %llu: the peaks change by %.4g, the bound is %.4g\n",
                            (unsigned long long)seed, change, bound);
            }
            if (change > 3 * unknown) to->least = fmin(to->least, bound / change);
        }
    }
    fw_arena_free(arena);
}

static void honest(void **state) {
    (void)state;
    score s = {.least = (double)INFINITY};
    const char *many = getenv("FW_BOUNDS");
    int count = many ? atoi(many) : test_cases(200, 40);
    for (int i = 0; i < count; i++)
        try(7000 + (uint64_t)i, &s);
    print_message(
        "%d devices, bounded %d, below 10 %% in %d, row ended in %d; least bound over true "
        "change %.3g\n",
        s.devices, s.bounded, s.left_out, s.ended, s.least);
    assert_int_equal(s.bad, 0);
    assert_true(s.bounded > count / 3 && s.left_out > count / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(honest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
