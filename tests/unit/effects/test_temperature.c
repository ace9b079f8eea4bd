/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a temperature leaves in the terms; flexures that soften with a law. Motions and equilibria
   are in tests/unit/statics/test_thermal.c. */
#include "quantity/law_kind.h"
#include "effects/effects.h"
#include "element_check.h"

typedef struct stand {
    fw_arena *arena;
    fw_diags diags;
    fw_mechanism_mass body[2];
    fw_mechanism_pin pin[2];
    fw_mechanism m;
    fw_mechanism_variant variant;
    fw_device_temperature warm[3];
    fw_device_scene scene;
    fw_effect_ledger ledger;
    fw_effects_loads loads;
} stand;

/* a lever on a flexure of the ground, and one on it by a spring that is no flexure */
static void stand_new(stand *s) {
    memset(s, 0, sizeof *s);
    s->arena = fw_arena_new(0);
    s->diags = fw_diags_new(s->arena);
    for (int i = 0; i < 2; i++) {
        s->body[i] = (fw_mechanism_mass){"b", 1, 1, i + 0.5, 0, 0.2 * i, {0, 0}};
        s->pin[i] = (fw_mechanism_pin){.id = "A",
                                       .body_a = i - 1,
                                       .body_b = i,
                                       .ax_m = i ? 0.5 : 0.25,
                                       .bx_m = -0.5,
                                       .stiffness_Nm_per_rad = 4 + i,
                                       .free_angle_rad = 0.3,
                                       .hinge = i ? FW_NONE : 0};
    }
    s->m = (fw_mechanism){
        .body = s->body, .pin = s->pin, .nbody = 2, .npin = 2, .variant = &s->variant};
    s->variant.material.expansion.value = 1e-5;
    s->variant.material.modulus_change.value = -2e-4;
    s->variant.substrate_expansion.value = 1e-5;
    s->variant.substrate = "slate";
    const double open = (double)NAN;
    for (int i = 0; i < 3; i++)
        s->warm[i] = (fw_device_temperature){100, open, open, open, NULL, {0}};
    s->scene =
        (fw_device_scene){.name = "s", .duration_s = 1, .temperature = s->warm, .ntemperature = 1};
}

static void compile(stand *s) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_AUTO};
    fw_status status = fw_effects_compile(s->arena, &s->m, &s->scene, &choice, 1e-3, &s->diags,
                                          &s->ledger, &s->loads);
    if (status != FW_OK) fail_msg("%s", s->diags.item[0].message);
}

static void what_is_constant(void **state) {
    (void)state;
    stand s;
    stand_new(&s);
    compile(&s); /* of one material: no mismatch, softer */
    assert_false(s.loads.strained);
    assert_relative(s.loads.torsion[0].stiffness_Nm_per_rad, 4 * 0.98, 1e-14);
    assert_relative(s.loads.torsion[1].stiffness_Nm_per_rad, 5, 1e-14);
    assert_int_equal(s.loads.nelement, 0);
    /* the substrate's own; two changes add */
    s.scene.ntemperature = 2;
    s.warm[0].substrate_expansion_per_K = 3e-6;
    s.warm[1].substrate_expansion_per_K = 3e-6, s.warm[1].change_K = -40;
    compile(&s);
    assert_true(s.loads.strained && !s.loads.stretch.law);
    assert_near(s.loads.strain[2], -7e-6 * 100 / 1.001 + 7e-6 * 40 / (1 - 4e-4), 1e-15);
    assert_true(s.loads.strain[0] == 0 && s.loads.strain[1] == 0);
    assert_relative(s.loads.torsion[0].stiffness_Nm_per_rad, 4 * (1 - 2e-4 * 60), 1e-14);
    s.scene.ntemperature = 1, s.warm[0].change_K = 0;
    compile(&s);
    for (int i = 0; i < s.ledger.count; i++)
        if (strcmp(s.ledger.item[i].id, "temperature") == 0)
            assert_false(s.ledger.item[i].called_for);
    fw_arena_free(s.arena);
}

static const char *reason_of(const stand *s) {
    for (int i = 0; i < s->ledger.count; i++)
        if (strcmp(s->ledger.item[i].id, "temperature") == 0) return s->ledger.item[i].reason;
    return "";
}

/* what the scene leaves open is the material's for the layer, the flow's for the substrate */
static void what_it_stands_on(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        stand s;
        stand_new(&s);
        double own = 1e-5, below = 2e-6;
        s.variant.substrate_expansion.value = below;
        if (i & 1) s.warm[0].expansion_per_K = own = 4e-5;
        if (i & 2) s.warm[0].substrate_expansion_per_K = below = -3e-6;
        compile(&s);
        assert_near(s.loads.strain[2], (1 + 100 * below) / (1 + 100 * own) - 1, 1e-15);
        assert_true((strstr(reason_of(&s), "substrate: slate") != NULL) == (i < 2));
        fw_arena_free(s.arena);
    }
    stand s;
    stand_new(
        &s); /* each in the mean over the change; of a substrate that does not say how it goes a warning tells it */
    s.variant.material.expansion_slope.value = 2e-8;
    s.variant.material.expansion_curvature.value = -3e-11;
    s.variant.substrate_slope.value = 1e-8;
    compile(&s);
    double own = 1e-5 + 2e-6 - 3e-7, below = 1e-5 + 1e-6;
    assert_near(s.loads.strain[2], (1 + 100 * below) / (1 + 100 * own) - 1, 1e-15);
    assert_int_equal(s.diags.count, 0);
    s.variant.substrate_slope.unknown = true;
    s.warm[0].place = (fw_place){"t.xml", 5, 1};
    compile(&s);
    compile(&s);
    assert_near(s.loads.strain[2], (1 + 1e-3) / (1 + 100 * own) - 1, 1e-15);
    assert_int_equal(s.diags.count, 1);
    assert_int_equal(s.diags.item[0].number, 748);
    assert_non_null(strstr(s.diags.item[0].message, "expansion of the substrate"));
    s.warm[0].place.line = 7, s.warm[0].change_K = 50;
    compile(&s);
    s.warm[0].change_K = -100, s.warm[0].substrate_expansion_per_K = 1e-5;
    compile(&s);
    assert_int_equal(s.diags.count, 1);
    fw_arena_free(s.arena);
    stand_new(&s);
    s.variant.substrate_expansion.unknown = true;
    s.warm[0].expansion_per_K = 0; /* of the layer only */
    const fw_effect_choice choice = {.mode = FW_EFFECTS_AUTO};
    assert_int_equal(
        fw_effects_compile(s.arena, &s.m, &s.scene, &choice, 1e-3, &s.diags, &s.ledger, &s.loads),
        FW_INPUT);
    assert_int_equal(s.diags.item[0].number, 253);
    fw_arena_free(s.arena);
}

static void with_a_law(void **state) {
    (void)state;
    static const fw_quantity_law sine = {.kind = &fw_quantity_law_sine,
                                         .end_s = (double)INFINITY,
                                         .frequency_Hz = 3,
                                         .phase_rad = 0.4};
    stand s;
    stand_new(&s);
    s.scene.ntemperature = 2; /* and 40 K less all the time */
    s.warm[0].law = &sine, s.warm[0].expansion_per_K = 0;
    s.warm[1].expansion_per_K = s.warm[1].substrate_expansion_per_K = 0;
    s.warm[1].change_K = -40;
    compile(&s);
    assert_false(s.loads.strained);
    assert_true(s.loads.stretch.law == &sine && s.loads.stretch.centre_m.x == 0.25);
    assert_relative(s.loads.stretch.strain, 1e-3, 1e-14);
    assert_relative(s.loads.torsion[0].stiffness_Nm_per_rad, 4 * 1.008, 1e-14);
    assert_int_equal(s.loads.nelement, 1);
    const fw_effects_force_element *e = &s.loads.element[0];
    assert_true(e->works && !e->dissipates && e->laws == 1 && e->pin == FW_NONE);
    uint64_t seed = 9;
    for (int round = 0; round < 30; round++) {
        double p[6], w[6], f[6], all[12];
        for (int i = 0; i < 12; i++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            all[i] = 2 * ((double)(seed >> 11) * 0x1p-53) - 1;
        }
        memcpy(p, all, sizeof p), memcpy(w, all + 6, sizeof w);
        const double t = 0.02 * round;
        const fw_effects_port_state seen = {
            .t_s = t, .piece_s = t + 1e-3, .load = 1, .p = p, .w = w};
        e->class_->force(e, &seen, f);
        double k = -0.02 * 4 * sin(6 * 3.14159265358979323846 * t + 0.4);
        assert_near(f[5], -k * (p[5] - p[2] - 0.3), 1e-15);
        fw_check_tangent(e, &seen, 1e-3, 1e-3, 1e-9);
        fw_check_power(e, &seen, 1e-3, 1e-9);
        fw_check_balance(e, &seen, 1e-12);
    }
    fw_arena_free(s.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_constant),
                                       cmocka_unit_test(what_it_stands_on),
                                       cmocka_unit_test(with_a_law)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
