/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the effect `friction` makes of a scene. */
#include "quantity/law_kind.h"
#include "effects/effect.h"
#include "test.h"

static const double NOT = (double)NAN;

typedef struct arm {
    fw_mechanism_mass body[1];
    fw_mechanism_pin pin[2];
    fw_device_joint joint[2];
    fw_mechanism_hinge hinge[1];
    fw_device_friction_use use[4];
    fw_mechanism m;
    fw_device_scene scene;
} arm;

static void arm_new(arm *s) {
    memset(s, 0, sizeof *s);
    s->body[0] = (fw_mechanism_mass){"arm", 2e-8, 3e-15, 1e-3, 0, 0, {0, 0}};
    for (int i = 0; i < 2; i++)
        s->pin[i] = (fw_mechanism_pin){
            .id = i ? "B" : "A", .body_a = FW_GROUND, .body_b = 0, .bx_m = -1e-3, .hinge = FW_NONE};
    s->pin[0].hinge = 0;
    s->hinge[0] = (fw_mechanism_hinge){.pin = 0, .surface_radius_m = 75e-6};
    s->joint[0] = (fw_device_joint){.id = "rail", .kind = FW_JOINT_PRISMATIC, .body_a = FW_GROUND};
    s->joint[1] = (fw_device_joint){.id = "rod", .kind = FW_JOINT_DISTANCE, .body_a = FW_GROUND};
    s->m = (fw_mechanism){.body = s->body,
                          .pin = s->pin,
                          .joint = s->joint,
                          .hinge = s->hinge,
                          .nbody = 1,
                          .npin = 2,
                          .njoint = 2,
                          .nhinge = 1};
    s->scene = (fw_device_scene){.name = "s", .duration_s = 1e-3, .friction = s->use};
}

static fw_device_friction_use *use(arm *s, int revolute, int joint, double mu) {
    fw_device_friction_use *u = &s->use[s->scene.nfriction++];
    *u = (fw_device_friction_use){.revolute = revolute,
                                  .joint = joint,
                                  .coefficient = mu,
                                  .static_coefficient = NOT,
                                  .radius_m = NOT,
                                  .place = {"device.xml", 7, 3}};
    return u;
}

static void test_called_for(void **state) {
    (void)state;
    arm s;
    const fw_effect_case c = {.mechanism = &s.m, .scene = &s.scene};
    arm_new(&s);
    assert_false(fw_effect_friction.called_for(&c));
    use(&s, 0, FW_NONE, 0); /* nothing rubs */
    use(&s, 1, FW_NONE, 0.3)->radius_m = 0;
    use(&s, FW_NONE, 1, 0.3); /* a rod does not slide */
    assert_false(fw_effect_friction.called_for(&c));
    use(&s, FW_NONE, 0, 0)->static_coefficient = 0.2; /* holds only */
    assert_true(fw_effect_friction.called_for(&c));
    assert_int_equal(fw_effect_friction.count(&c), 1);
    double bound = 0;
    const char *why = NULL;
    assert_int_equal(fw_effect_friction.bound(&c, &bound, &why), FW_OK);
    assert_true(isinf(bound) && why);
}

static void test_values(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    arm s;
    arm_new(&s);
    use(&s, 0, FW_NONE, 0.3)->preload_N = 1e-3; /* the hinge's own radius, static = kinetic */
    fw_device_friction_use *u = use(&s, 1, FW_NONE, 0.2);
    u->radius_m = 2e-5, u->static_coefficient = 0.5;
    use(&s, FW_NONE, 0, 0.4)->static_coefficient = 0.1; /* not below kinetic */
    fw_effects_loads loads;
    assert_int_equal(fw_effects_loads_new(arena, &s.m, &s.scene, &loads), FW_OK);
    const fw_effect_case c = {.arena = arena, .mechanism = &s.m, .scene = &s.scene};
    assert_int_equal(fw_effect_friction.add(&c, &loads), FW_OK);
    assert_int_equal(loads.nfriction, 3);
    const fw_effects_friction *f = loads.friction;
    assert_true(f[0].pin == 0 && f[0].joint == FW_NONE && f[0].element == FW_NONE);
    assert_true(f[0].radius_m == 75e-6 && f[0].static_coefficient == 0.3);
    assert_true(f[0].preload_N == 1e-3 && f[0].kinetic_coefficient == 0.3);
    assert_true(f[1].pin == 1 && f[1].radius_m == 2e-5 && f[1].static_coefficient == 0.5);
    assert_true(f[2].joint == 0 && f[2].pin == FW_NONE && f[2].static_coefficient == 0.4);
    assert_string_equal(f[2].id, "rail");
    assert_int_equal(f[2].place.line, 7);
    fw_arena_free(arena);
}

/* without surfaces and radius: FW-D245 at the element, also through the whole compilation */
static void test_unknown_radius(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    arm s;
    arm_new(&s);
    use(&s, 1, FW_NONE, 0.3);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    assert_int_equal(fw_effects_compile(arena, &s.m, &s.scene, &all, 1e-3, &diags, &ledger, &loads),
                     FW_INPUT);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 245);
    assert_int_equal(diags.item[0].place.line, 7);
    assert_non_null(strstr(diags.item[0].message, "give radius"));
    fw_arena_free(arena);
}

static double ten(const fw_effects_force_element *e, const fw_effects_port_state *seen) {
    (void)e, (void)seen;
    return 10;
}

/* a contact between the two points of the pin presses; another one does not */
static void test_contact_presses(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    arm s;
    arm_new(&s);
    use(&s, 0, FW_NONE, 0.3);
    fw_effects_loads loads;
    assert_int_equal(fw_effects_loads_new(arena, &s.m, &s.scene, &loads), FW_OK);
    const fw_effects_element_class contact = {.effect = "contact", .pressing = ten};
    const fw_effects_element_class other = {.effect = "air", .pressing = ten};
    for (int i = 0; i < 3; i++) {
        fw_effects_force_element *e =
            fw_effects_loads_add_element(arena, &loads, i == 1 ? &other : &contact, 2);
        e->port[0] = (fw_effects_port){FW_GROUND, i == 0 ? 1e-3 : 0, 0};
        e->port[1] = (fw_effects_port){0, -1e-3, 0};
    }
    const fw_effect_case c = {.arena = arena, .mechanism = &s.m, .scene = &s.scene};
    assert_int_equal(fw_effect_friction.add(&c, &loads), FW_OK);
    assert_int_equal(loads.friction[0].element, 2);
    fw_arena_free(arena);
}

/* the arm about A under a torque from rest, w^2 = k/(J + m l^2), for half a period: the swing to 2
   F/k ends at 2 (F - T)/k with a constant friction T. By closed forms: the change is T/F; the bound
   is T/F but for the margin, T = mu r (p + N0)/(1 - mu r g), where N0 and g are joint forces of the
   order of F/l and 1/l */
static double bound_of(fw_arena *arena, double mu, double radius, double preload, double halves,
                       const fw_quantity_law *law) {
    arm s;
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const double k = 1e-6, F = 1e-10, w = sqrt(k / (3e-15 + 2e-8 * 1e-6));
    fw_device_torque torque = {.body = 0, .value_Nm = F, .law = law};
    arm_new(&s);
    s.m.npin = 1, s.m.njoint = 0, s.m.nhinge = 0;
    s.pin[0].hinge = FW_NONE;
    s.pin[0].stiffness_Nm_per_rad = k;
    s.scene.torque = &torque;
    s.scene.ntorque = 1;
    s.scene.duration_s = halves * acos(-1.0) / w;
    fw_device_friction_use *u = use(&s, 0, FW_NONE, mu);
    u->radius_m = radius, u->preload_N = preload;
    const fw_effect_choice all = {.mode = FW_EFFECTS_AUTO};
    assert_int_equal(fw_effects_compile(arena, &s.m, &s.scene, &all, 1e-3, &diags, &ledger, &loads),
                     FW_OK);
    for (int i = 0; i < ledger.count; i++)
        if (strcmp(ledger.item[i].id, "friction") == 0) {
            assert_int_equal(ledger.item[i].active, !(ledger.item[i].bound < 1e-3));
            return ledger.item[i].bound;
        }
    return (double)NAN;
}

static void test_bound(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double F = 1e-10, mu = 0.3, r = 1e-10;
    for (double share = 1e-4; share < 0.2; share *= 3) {
        double preload = share * F / (mu * r), bound = bound_of(arena, mu, r, preload, 1, NULL);
        bound /= 1 + bound; /* the ledger's grows by what it may do to its own floor */
        assert_true(bound >= share);
        assert_true(bound <= 1.02 * share);
        /* the peak comes with the first swing; under a load with a law it may come late, and
           friction in step with the motion counts every swing: four */
        assert_near(bound_of(arena, mu, r, preload, 4, NULL), bound / (1 - bound), 1e-2 * share);
        const fw_quantity_law step = {.kind = &fw_quantity_law_step,
                                      .end_s = 1}; /* behind the scene */
        double late = bound_of(arena, mu, r, preload, 4, &step);
        late /= 1 + late;
        if (share < 0.02) assert_true(late >= 4 * share && late <= 4.1 * share);
    }
    /* its own reaction alone: 2 F m l/(J + m l^2) at the turning points and less */
    double reaction = 2e-8 * 1e-3 / (3e-15 + 2e-8 * 1e-6),
           bound = bound_of(arena, mu, r, 0, 1, NULL);
    assert_true(bound >= mu * r * reaction && bound <= 4 * mu * r * reaction);
    /* jams: mu r reaction = 1 */
    assert_true(isinf(bound_of(arena, mu, 1 / (mu * reaction), 0, 1, NULL)));
    assert_true(isinf(bound_of(arena, mu, r, 0.5 * F / (mu * r), 1, NULL))); /* more than a third */
    fw_arena_free(arena);
}

/* A chain of three bodies from the frame: two pins with springs, then a slide with one, each body turned. `at` is the index that each
   has, `other` says that what is between two bodies begins at the other one: the same device in other words. */
static double bound_of_chain(fw_arena *arena, const int at[3], bool other, bool slides) {
    static const double phi[] = {0.3, -0.5, 0.7};
    static const fw_geometry_vec2 centre[] = {{1e-3, 2e-4}, {3e-3, 0}, {5e-3, 1e-4}};
    static const fw_geometry_vec2 place[] = {{0, 0}, {2e-3, 5e-4}, {4e-3, 3e-4}};
    const double axis = 0.4, apart = 2e-4;
    fw_mechanism_mass body[3];
    fw_mechanism_pin pin[2];
    fw_geometry_vec2 local[3][2]; /* of each joint: in the body before it and in the one behind it */
    for (int i = 0; i < 3; i++) {
        body[at[i]] = (fw_mechanism_mass){"b", (1 + i) * 2e-8, (2 + i) * 3e-15, centre[i].x, centre[i].y, phi[i], {0, 0}};
        for (int side = 0; side < 2; side++) {
            const int b = i - 1 + side;
            fw_geometry_vec2 p = place[i];
            if (i == 2 && side) p.x += apart * cos(axis), p.y += apart * sin(axis);
            if (b >= 0) {
                const double x = p.x - centre[b].x, y = p.y - centre[b].y;
                p = (fw_geometry_vec2){cos(phi[b]) * x + sin(phi[b]) * y, cos(phi[b]) * y - sin(phi[b]) * x};
            }
            local[i][side] = p;
        }
    }
    for (int i = 0; i < 2; i++) {
        const int before = i ? at[i - 1] : FW_GROUND, behind = at[i], turned = i && other;
        pin[i] = (fw_mechanism_pin){.id = "p", .body_a = turned ? behind : before, .body_b = turned ? before : behind,
                                    .ax_m = local[i][turned].x, .ay_m = local[i][turned].y, .bx_m = local[i][!turned].x,
                                    .by_m = local[i][!turned].y, .stiffness_Nm_per_rad = (2 - i) * 1e-6, .hinge = FW_NONE};
        pin[i].free_angle_rad = (pin[i].body_b == FW_GROUND ? 0 : body[pin[i].body_b].phi_rad) -
                                (pin[i].body_a == FW_GROUND ? 0 : body[pin[i].body_a].phi_rad);
    }
    const double to_a = other ? phi[2] : phi[1], to_b = other ? phi[1] : phi[2];
    fw_device_joint slide = {.id = "s", .kind = FW_JOINT_PRISMATIC, .body_a = other ? at[2] : at[1], .body_b = other ? at[1] : at[2],
                             .ax_m = local[2][other].x, .ay_m = local[2][other].y, .bx_m = local[2][!other].x, .by_m = local[2][!other].y,
                             .axis_rad = axis - to_a + (other ? acos(-1.0) : 0), .angle_rad = to_b - to_a, .stiffness_N_per_m = 2,
                             .free_length_m = apart};
    const fw_mechanism m = {.body = body, .pin = pin, .joint = &slide, .nbody = 3, .npin = 2, .njoint = 1};
    const fw_device_torque torque = {.body = at[2], .value_Nm = 1e-10};
    fw_device_friction_use rubs = {.revolute = slides ? FW_NONE : 1, .joint = slides ? 0 : FW_NONE, .coefficient = 0.01,
                                   .static_coefficient = NOT, .radius_m = slides ? NOT : 2e-5, .preload_N = 1e-9, .place = {"device.xml", 7, 3}};
    const fw_device_scene scene = {.name = "s", .duration_s = 1e-2, .friction = &rubs, .nfriction = 1, .torque = (fw_device_torque *)&torque, .ntorque = 1};
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const fw_effect_choice all = {.mode = FW_EFFECTS_AUTO};
    assert_int_equal(fw_effects_compile(arena, &m, &scene, &all, 1e-3, &diags, &ledger, &loads), FW_OK);
    for (int i = 0; i < ledger.count; i++)
        if (strcmp(ledger.item[i].id, "friction") == 0) return ledger.item[i].bound;
    return NOT;
}

/* what a device is does not depend on the order in which its bodies are named, nor on which of two is said to hold the other */
static void test_order(void **state) {
    (void)state;
    static const int order[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    fw_arena *arena = fw_arena_new(0);
    for (int slides = 0; slides < 2; slides++) {
        const double is = bound_of_chain(arena, order[0], false, slides);
        assert_true(is > 1e-6 && is < 1);
        for (int i = 0; i < 12; i++)
            assert_near(bound_of_chain(arena, order[i / 2], i % 2, slides) / is, 1, 1e-9);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_called_for),     cmocka_unit_test(test_values),
        cmocka_unit_test(test_unknown_radius), cmocka_unit_test(test_contact_presses),
        cmocka_unit_test(test_bound),        cmocka_unit_test(test_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
