/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effects.h"
#include "test.h"

/* a lever on the ground: inertia about the pin j + m l^2, torsion k */
typedef struct lever {
    fw_mechanism_mass body[1];
    fw_mechanism_pin pin[1];
    fw_device_spring spring[1];
    fw_device_force force[1];
    fw_device_torque torque[1];
    fw_device_initial initial[1];
    fw_mechanism m;
    fw_device_scene scene;
} lever;

static void lever_new(lever *s, double k, double c) {
    memset(s, 0, sizeof *s);
    s->body[0] = (fw_mechanism_mass){"lever", 2e-8, 3e-15, 1e-3, 0, 0, {0, 0}};
    s->pin[0] = (fw_mechanism_pin){.id = "O",
                                   .body_a = FW_GROUND,
                                   .body_b = 0,
                                   .bx_m = -1e-3,
                                   .stiffness_Nm_per_rad = k,
                                   .damping_Nms_per_rad = c,
                                   .hinge = FW_NONE};
    s->m =
        (fw_mechanism){.body = s->body, .pin = s->pin, .spring = s->spring, .nbody = 1, .npin = 1};
    s->scene = (fw_device_scene){.name = "s",
                                 .duration_s = 1e-3,
                                 .force = s->force,
                                 .torque = s->torque,
                                 .initial = s->initial};
}

static fw_status compile(fw_arena *arena, const lever *s, fw_effect_mode mode, const char *list,
                         double accuracy, fw_diags *diags, fw_effect_ledger *ledger,
                         fw_effects_loads *loads) {
    const fw_effect_choice choice = {.mode = mode, .list = list};
    return fw_effects_compile(arena, &s->m, &s->scene, &choice, accuracy, diags, ledger, loads);
}

static const fw_effect_entry *entry(const fw_effect_ledger *ledger, const char *id) {
    for (int i = 0; i < ledger->count; i++)
        if (strcmp(ledger->item[i].id, id) == 0) return &ledger->item[i];
    fail_msg("no effect %s", id);
    return NULL;
}

static void test_table(void **state) {
    (void)state;
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    assert_true(count > 20);
    for (size_t i = 0; i < count; i++) {
        assert_non_null(row[i]->id);
        assert_non_null(row[i]->summary);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(row[i]->id, row[j]->id);
    }
}

/* what a scene does not call for leaves nothing behind in the compiled arrays */
static void test_absent_effects_cost_nothing(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 0, 0);
    assert_int_equal(compile(arena, &s, FW_EFFECTS_ALL, NULL, 1e-3, &diags, &ledger, &loads),
                     FW_OK);
    assert_int_equal(loads.ntorsion + loads.nload + loads.nspring + loads.ntimed + loads.nstop +
                         loads.nslide,
                     0);
    assert_true(entry(&ledger, "inertia")->active); /* every motion has it until it is left out */
    assert_false(loads.quasi_static);
    for (int i = 0; i < ledger.count; i++) {
        if (strcmp(ledger.item[i].id, "inertia") == 0) continue;
        assert_false(ledger.item[i].called_for);
        assert_false(ledger.item[i].active);
        assert_true(ledger.item[i].bound == 0);
    }
    for (int i = 0; i < 3; i++)
        assert_true(loads.constant[i] == 0 && loads.velocity[i] == 0);
    fw_arena_free(arena);
}

/* the lever under a torque T turns by 2 T/k at its peak, and the weight at arm l by 2 m g l/k: the
   bound is at least m g l/T and, for small angles, not much more */
static void test_gravity_bound(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 1e-6, 0);
    s.scene.gravity = true;
    s.scene.gy_m_per_s2 = -9.81;
    s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 2e-9};
    s.scene.ntorque = 1;
    for (double g = 1e-4; g < 1; g *= 10) { /* the weight's moment over the torque */
        s.scene.gy_m_per_s2 = -g * 2e-9 / (2e-8 * 1e-3);
        assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, 3e-2, &diags, &ledger, &loads),
                         FW_OK);
        const fw_effect_entry *e = entry(&ledger, "gravity");
        /* the whole motion is that of T - m g l, and 2 of them in a half period */
        assert_true(e->bound >= g / (1 - g));
        assert_true(e->bound < 1.2 * g / (1 - g));
        assert_true(e->called_for && e->active == (e->bound >= 3e-2));
        assert_true((loads.constant[1] != 0) == e->active);
        if (!e->active) assert_non_null(strstr(e->reason, "left out: below the accuracy wanted"));
        assert_near(ledger.left_out, e->active ? 0 : e->bound, 1e-15);
    }
    assert_true(entry(&ledger, "applied-load")->active);
    assert_true(isinf(entry(&ledger, "applied-load")->bound));
    /* without a spring there is no linear motion to compare with */
    s.pin[0].stiffness_Nm_per_rad = 0;
    assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, 1, &diags, &ledger, &loads), FW_OK);
    assert_true(isinf(entry(&ledger, "gravity")->bound));
    assert_non_null(strstr(entry(&ledger, "gravity")->reason, "elastic"));
    fw_arena_free(arena);
}

/* without having been asked for, and what has no part at rest; damping, which acts on rates */
static void test_equilibrium_reasons(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 1e-6, 1e-15);
    s.scene.gravity = true;
    s.scene.gy_m_per_s2 = -9.81;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(compile(arena, &s, i ? FW_EFFECTS_WHOLE : FW_EFFECTS_ALL, NULL, 1, &diags,
                                 &ledger, &loads),
                         FW_OK);
        assert_true(entry(&ledger, "gravity")->active && entry(&ledger, "joint-damping")->active);
        assert_non_null(
            strstr(entry(&ledger, "gravity")->reason, i ? "leave nothing out" : "were asked for"));
    }
    fw_effects_in_equilibrium(&ledger);
    assert_true(entry(&ledger, "gravity")->active);
    assert_false(entry(&ledger, "joint-damping")->active || entry(&ledger, "inertia")->active);
    assert_non_null(strstr(entry(&ledger, "joint-damping")->reason, "no part in an equilibrium"));
    assert_non_null(strstr(entry(&ledger, "air")->reason, "not called for"));
    fw_arena_free(arena);
}

/* two effects each below the accuracy wanted and both together not: only the smaller is left out */
static void test_sum_rule(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 1e-6, 1e-15);
    s.scene.gravity = true;
    s.scene.gy_m_per_s2 = -1e-4 * 9.81;
    s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 2e-9};
    s.scene.ntorque = 1;
    assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, 0.2, &diags, &ledger, &loads),
                     FW_OK);
    double g = entry(&ledger, "gravity")->bound, d = entry(&ledger, "joint-damping")->bound;
    assert_true(g > 0 && d > 0 && g + d < 0.2);
    assert_near(ledger.left_out, g + d, 1e-15);
    double between = fmax(g, d) + 0.5 * fmin(g, d);
    assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, between, &diags, &ledger, &loads),
                     FW_OK);
    const char *small = g < d ? "gravity" : "joint-damping";
    const char *large = g < d ? "joint-damping" : "gravity";
    assert_false(entry(&ledger, small)->active);
    assert_true(entry(&ledger, large)->active);
    assert_non_null(strstr(entry(&ledger, large)->reason, "with what is left out already"));
    assert_near(ledger.left_out, fmin(g, d), 1e-15);
    fw_arena_free(arena);
}

/* a stop out of reach has the bound 0 and is left out; one within reach stays, and with it
   everything else */
static void test_stop_bound(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 1e-6, 1e-18);
    s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 2e-9}; /* peak 4e-3 rad */
    s.scene.ntorque = 1;
    s.pin[0].stop_stiffness_Nm_per_rad = 1e-3;
    s.pin[0].stop_min_rad = (double)NAN;
    for (double at = 1e-3; at < 0.1; at *= 2) {
        s.pin[0].stop_max_rad = at;
        assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, 1e-2, &diags, &ledger, &loads),
                         FW_OK);
        bool out = !entry(&ledger, "joint-stop")->active;
        if (at < 4.1e-3) assert_false(out);
        if (at > 8e-3) assert_true(out);
        assert_int_equal(loads.nstop, !out);
        assert_true(entry(&ledger, "joint-stop")->bound == (out ? 0 : (double)INFINITY));
        assert_int_equal(isinf(entry(&ledger, "joint-damping")->bound), !out);
    }
    fw_arena_free(arena);
}

/* weight along a mast moves nothing by itself and takes m g l from its stiffness: the true change
   of the deflection is within the bound, and where it could take all, weight is kept */
static void test_weight_along_a_mast(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 1e-6, 0); /* arm of 1 mm along x: gravity along -x presses on it */
    s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-9};
    s.scene.ntorque = 1;
    s.scene.gravity = true;
    for (double share = 1e-4; share < 3; share *= 4) { /* m g l over k */
        s.scene.gx_m_per_s2 = -share * 1e-6 / (2e-8 * 1e-3);
        assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, 1e-3, &diags, &ledger, &loads),
                         FW_OK);
        const fw_effect_entry *g = entry(&ledger, "gravity");
        double change = share < 1 ? share / (1 - share) : (double)INFINITY;
        assert_true(g->bound >= change * (1 - 1e-12));
        assert_int_equal(g->active, !(g->bound < 1e-3));
    }
    fw_arena_free(arena);
}

/* the lever under a torque from rest swings to 1 + exp(-z pi) of the static angle, z = zeta over
   sqrt(1 - zeta^2); the bound is not below that change, and not a hundred times above it */
static void test_damping_bound(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    for (double c = 1e-18; c < 1e-10; c *= 10) {
        lever_new(&s, 1e-6, c);
        s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 2e-9};
        s.scene.ntorque = 1;
        assert_int_equal(compile(arena, &s, FW_EFFECTS_AUTO, NULL, 1e-3, &diags, &ledger, &loads),
                         FW_OK);
        const fw_effect_entry *d = entry(&ledger, "joint-damping");
        double j = 3e-15 + 2e-8 * 1e-6, zeta = c / (2 * sqrt(j * 1e-6));
        double change = -expm1(-zeta / sqrt(1 - zeta * zeta) * acos(-1.0)) /
                        (2 + expm1(-zeta / sqrt(1 - zeta * zeta) * acos(-1.0)));
        assert_true(d->bound >= change);
        assert_true(d->bound <= 100 * change);
        assert_int_equal(d->active, d->bound >= 1e-3);
        assert_true((loads.torsion[0].damping_Nms_per_rad > 0) == d->active);
    }
    fw_arena_free(arena);
}

static void test_choices(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    lever s;
    lever_new(&s, 1e-6, 1e-12);
    s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-7};
    s.scene.ntorque = 1;
    s.initial[0] = (fw_device_initial){.body = 0, .omega_rad_per_s = 3};
    s.scene.ninitial = 1;
    s.force[0] = (fw_device_force){.body = 0, .x_m = 1e-4, .fx_N = 1, .fy_N = 2};
    s.scene.nforce = 1;
    assert_int_equal(compile(arena, &s, FW_EFFECTS_NONE, NULL, 1e-3, &diags, &ledger, &loads),
                     FW_OK);
    /* what the motion is made of stays: stiffness, loads, starting velocities */
    assert_int_equal(loads.ntorsion, 1);
    assert_int_equal(loads.nload, 1);
    assert_true(loads.torsion[0].stiffness_Nm_per_rad == 1e-6);
    assert_true(loads.torsion[0].damping_Nms_per_rad == 0);
    assert_true(loads.velocity[2] == 3);
    assert_true(entry(&ledger, "applied-load")->active);
    assert_false(entry(&ledger, "joint-damping")->active);
    assert_int_equal(compile(arena, &s, FW_EFFECTS_LIST, "gravity, joint-damping", 1e-3, &diags,
                             &ledger, &loads),
                     FW_OK);
    assert_true(loads.torsion[0].damping_Nms_per_rad == 1e-12);
    assert_int_equal(loads.nload, 1);
    assert_int_equal(compile(arena, &s, FW_EFFECTS_ALL, NULL, 1e-3, &diags, &ledger, &loads),
                     FW_OK);
    assert_int_equal(loads.nload, 1);
    assert_true(entry(&ledger, "joint-damping")->cost > 0);
    assert_true(entry(&ledger, "applied-load")->cost > 0);
    assert_true(entry(&ledger, "point-spring")->cost == 0); /* not called for */
    assert_true(loads.constant[2] == 1e-7);
    assert_true(loads.torsion[0].damping_Nms_per_rad == 1e-12);
    /* a mistake names what there is */
    assert_int_equal(
        compile(arena, &s, FW_EFFECTS_LIST, "gravity,frictoin", 1e-3, &diags, &ledger, &loads),
        FW_USAGE);
    assert_int_equal(diags.item[0].number, 110);
    assert_non_null(strstr(diags.item[0].message, "frictoin"));
    assert_non_null(strstr(diags.item[0].message, "joint-damping"));
    fw_arena_free(arena);
}

/* two levers in a row: the linear response against the solution by hand */
static void test_static_response(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_mechanism_mass body[2] = {{"a", 1, 1, 1, 0, 0, {0, 0}}, {"b", 1, 1, 3, 0, 0, {0, 0}}};
    fw_mechanism_pin pin[2] = {{.body_a = FW_GROUND, .body_b = 0, .bx_m = -1},
                               {.body_a = 0, .body_b = 1, .ax_m = 1, .bx_m = -1}};
    fw_device_spring spring[1] = {{.body_a = FW_GROUND,
                                   .body_b = 1,
                                   .ax_m = 4,
                                   .ay_m = -2,
                                   .bx_m = 1,
                                   .stiffness_N_per_m = 5,
                                   .length_m = 2}};
    const fw_mechanism m = {.body = body, .pin = pin, .spring = spring, .nbody = 2, .npin = 2};
    fw_effects_torsion torsion[2] = {{0, FW_GROUND, 0, 10, 0, 0}, {1, 0, 1, 20, 0, 0}};
    const double force[6] = {0, 0, 0, 0, 3, 0}; /* at x = 3 */
    double zero[6] = {0};
    fw_effects_loads loads = {
        .nbody = 2, .constant = zero, .velocity = zero, .torsion = torsion, .ntorsion = 2};
    double u[6], turn[2];
    bool valid;
    assert_int_equal(fw_effects_static_response(arena, &m, &loads, force, u, turn, &valid), FW_OK);
    assert_true(valid);
    assert_near(turn[0], 3.0 * 3 / 10, 1e-12); /* moment at each hinge over its stiffness */
    assert_near(turn[1], 3.0 * 1 / 20, 1e-12);
    assert_near(u[4], 3 * turn[0] + turn[1], 1e-12);
    /* the spring at the tip carries part of it: virtual work with tip = 4 t0 + 2 t1 */
    loads.spring = spring;
    loads.nspring = 1;
    assert_int_equal(fw_effects_static_response(arena, &m, &loads, force, u, turn, &valid), FW_OK);
    assert_true(valid);
    double tip = 4 * turn[0] + 2 * turn[1];
    assert_near(10 * turn[0], 3.0 * 3 - 5 * tip * 4, 1e-11);
    assert_near(20 * turn[1], 3.0 * 1 - 5 * tip * 2, 1e-11);
    /* no spring at the second hinge: it can move freely, and that is said */
    loads.nspring = 0;
    loads.ntorsion = 1;
    assert_int_equal(fw_effects_static_response(arena, &m, &loads, force, u, turn, &valid), FW_OK);
    assert_false(valid);
    fw_arena_free(arena);
}

static void test_out_of_memory(void **state) {
    (void)state;
    lever s;
    lever_new(&s, 1e-6, 1e-12);
    s.scene.gravity = true;
    s.scene.gx_m_per_s2 = 1;
    s.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-7};
    s.scene.ntorque = 1;
    long count = 1000;
    for (long n = 1; n <= count; n++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_effect_ledger ledger;
        fw_effects_loads loads;
        fw_arena_fail_at(n, 0);
        fw_status status = compile(arena, &s, FW_EFFECTS_AUTO, NULL, 1e-3, &diags, &ledger, &loads);
        long made = fw_arena_count();
        fw_arena_fail_at(0, 0);
        fw_arena_free(arena);
        if (made < n) {
            assert_int_equal(status, FW_OK);
            return;
        }
        assert_int_equal(status, FW_NOMEM);
    }
    fail_msg("never went through");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_absent_effects_cost_nothing),
        cmocka_unit_test(test_gravity_bound),
        cmocka_unit_test(test_sum_rule),
        cmocka_unit_test(test_equilibrium_reasons),
        cmocka_unit_test(test_stop_bound),
        cmocka_unit_test(test_weight_along_a_mast),
        cmocka_unit_test(test_damping_bound),
        cmocka_unit_test(test_choices),
        cmocka_unit_test(test_static_response),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
