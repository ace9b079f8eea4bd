/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law_kind.h"
#include "mechanism/mechanism.h"
#include "test.h"

static const double unset = (double)NAN;

static fw_quantity known(double value) {
    return (fw_quantity){.value = value};
}

typedef struct desk { /* a lever with a csfh hinge to the ground and a second body behind it */
    fw_device_body body[2];
    fw_device_revolute revolute[2];
    fw_device_flexure flexure[1];
    fw_device_spring spring[1];
    fw_device device;
    fw_layout_hinge_layout hinge[2];
    fw_layout_body_layout shape[2];
    fw_layout layout;
    fw_mechanism_variant variant;
    fw_arena *arena;
    fw_diags diags;
} desk;

static void desk_new(desk *d) {
    memset(d, 0, sizeof *d);
    d->arena = fw_arena_new(0);
    assert_non_null(d->arena);
    d->diags = fw_diags_new(d->arena);
    d->body[0] = (fw_device_body){
        .id = "AB", .mass_kg = unset, .inertia_kg_m2 = unset, .x_m = unset, .y_m = unset};
    d->body[1] = (fw_device_body){.id = "BC",
                                  .mass_kg = 2e-8,
                                  .inertia_kg_m2 = 3e-15,
                                  .x_m = 3e-3,
                                  .y_m = 1e-3,
                                  .phi_rad = 0.5};
    d->revolute[0] = (fw_device_revolute){.id = "A",
                                          .body_a = FW_GROUND,
                                          .body_b = 0,
                                          .x_m = 0,
                                          .y_m = 0,
                                          .ax_m = unset,
                                          .ay_m = unset,
                                          .bx_m = unset,
                                          .by_m = unset,
                                          .stiffness_Nm_per_rad = unset,
                                          .damping_Nms_per_rad = unset,
                                          .flexure = 0,
                                          .place = {"d.xml", 7, 3}};
    d->revolute[1] = d->revolute[0];
    d->revolute[1].id = "B";
    d->revolute[1].body_a = 0, d->revolute[1].body_b = 1;
    d->revolute[1].x_m = 2e-3, d->revolute[1].y_m = 1e-3;
    d->revolute[1].flexure = FW_NONE;
    d->flexure[0] = (fw_device_flexure){.id = "A",
                                        .kind = FW_FLEXURE_CSFH,
                                        .length_m = 300e-6,
                                        .angle_rad = 4.1887902047863905,
                                        .radius_m = 300e-6 / 4.18879020478639,
                                        .width_m = 9e-6,
                                        .gap_m = 8e-6,
                                        .fillet_m = unset};
    d->spring[0] = (fw_device_spring){.id = "s",
                                      .body_a = FW_GROUND,
                                      .body_b = 1,
                                      .stiffness_N_per_m = 4,
                                      .damping_Ns_per_m = 5,
                                      .length_m = 1e-3};
    d->device = (fw_device){.file = "d.xml",
                            .body = d->body,
                            .revolute = d->revolute,
                            .flexure = d->flexure,
                            .spring = d->spring,
                            .nbody = 2,
                            .nrevolute = 2,
                            .nflexure = 1,
                            .nspring = 1,
                            .safety_factor = 1.5};
    d->shape[0] = (fw_layout_body_layout){
        .area_m2 = 2e-7, .perimeter_m = 1e-3, .centroid = {1e-3, 0.5e-3}, .polar_m4 = 4e-14};
    d->hinge[0] = (fw_layout_hinge_layout){.drawn = true, .fillet_m = 6e-6};
    d->layout = (fw_layout){.drawn = true, .hinge = d->hinge, .body = d->shape};
    d->variant = (fw_mechanism_variant){.thickness_m = 50e-6,
                                        .explicit_mass_scale = 1,
                                        .explicit_stiffness_scale = 1,
                                        .explicit_damping_scale = 1};
    d->variant.material = (fw_device_material){.id = "silicon",
                                               .youngs = known(169e9),
                                               .poisson = known(0.06),
                                               .density = known(2330),
                                               .strength = known(2.5e9),
                                               .loss = known(1e-3)};
}

static fw_status build(desk *d, const fw_mechanism **m) {
    return fw_mechanism_build(d->arena, &d->device, &d->layout, &d->variant, &d->diags, m);
}

/* the hinge's direction in the crystal, and its pin at the crystal's own centre; an isotropic one
   stays where it is drawn */
static void test_crystal(void **state) {
    (void)state;
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    d.hinge[0].axis_rad = 0.7;
    d.body[0].phi_rad = 0.4;
    d.revolute[0].x_m = 1e-4, d.revolute[0].y_m = -2e-4;
    d.variant.orientation_rad = 0.2;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_false(m->hinge[0].input.crystal.known);
    assert_near(m->hinge[0].off_a_m.x, 0, 0);
    assert_near(fw_mechanism_pin_place(m, &m->pin[0], 0).x, 1e-4, 0);
    double E = m->hinge[0].closed_form.youngs_Pa;
    assert_near(E, 169e9, 0);

    d.variant.material.c11 = known(165.7e9);
    d.variant.material.c12 = known(63.9e9);
    d.variant.material.c44 = known(79.6e9);
    assert_int_equal(build(&d, &m), FW_OK);
    const fw_mechanism_hinge *h = &m->hinge[0];
    assert_true(h->input.crystal.known && h->input.crystal.aligned);
    assert_near(h->input.crystal.cos4, cos(4 * 0.5), 1e-15);
    assert_near(h->input.crystal.sin4, sin(4 * 0.5), 1e-15);
    assert_relative(h->law.stiffness_Nm_per_rad, h->closed_form.stiffness_Nm_per_rad, 1e-15);
    const double *off = h->closed_form.offset_m;
    assert_true(fabs(off[0]) > 1e-8 && fabs(off[1]) > 1e-7);
    double x = 1e-4 + cos(0.7) * off[0] - sin(0.7) * off[1];
    double y = -2e-4 + sin(0.7) * off[0] + cos(0.7) * off[1];
    for (int side = 0; side < 2; side++) {
        fw_geometry_vec2 w = fw_mechanism_pin_place(m, &m->pin[0], side);
        assert_near(w.x, x, 1e-18);
        assert_near(w.y, y, 1e-18);
    }
    /* drawn points, where the surfaces are: the pin less its offset, in each body's frame */
    const fw_mechanism_pin *p = &m->pin[0];
    fw_geometry_vec2 a =
        fw_mechanism_local_place(m, p->body_a, p->ax_m - h->off_a_m.x, p->ay_m - h->off_a_m.y);
    fw_geometry_vec2 b =
        fw_mechanism_local_place(m, p->body_b, p->bx_m - h->off_b_m.x, p->by_m - h->off_b_m.y);
    assert_near(hypot(a.x - 1e-4, a.y + 2e-4) + hypot(b.x - 1e-4, b.y + 2e-4), 0, 1e-18);

    d.layout.drawn = false; /* nothing says where the hinge points: the mean, and no offset */
    d.revolute[0].axis_rad = unset;
    d.body[0].mass_kg = 1e-8, d.body[0].inertia_kg_m2 = 1e-15, d.body[0].x_m = d.body[0].y_m = 0;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_false(m->hinge[0].input.crystal.aligned);
    assert_near(fw_mechanism_pin_place(m, &m->pin[0], 0).x, 1e-4, 0);
    fw_arena_free(d.arena);
}

static void test_masses(void **state) {
    (void)state;
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    d.variant.explicit_mass_scale = 3;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_int_equal(d.diags.count, 0);
    double surface = 2330 * 50e-6;
    assert_near(m->body[0].mass_kg, surface * 2e-7, 1e-20);
    assert_near(m->body[0].inertia_kg_m2, surface * 4e-14, 1e-28);
    assert_near(m->body[0].x_m, 1e-3, 1e-18); /* the centroid */
    assert_near(m->body[0].y_m, 0.5e-3, 1e-18);
    assert_near(m->body[1].mass_kg, 6e-8, 1e-20); /* explicit ones scale */
    assert_near(m->body[1].inertia_kg_m2, 9e-15, 1e-27);
    fw_arena_free(d.arena);
}

/* the world point comes back from both local points */
static void test_points(void **state) {
    (void)state;
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    assert_int_equal(build(&d, &m), FW_OK);
    const fw_mechanism_pin *b = &m->pin[1];
    assert_near(b->ax_m, 1e-3, 1e-18);
    assert_near(b->ay_m, 0.5e-3, 1e-18);
    double c = cos(0.5), s = sin(0.5);
    assert_near(3e-3 + c * b->bx_m - s * b->by_m, 2e-3, 1e-17);
    assert_near(1e-3 + s * b->bx_m + c * b->by_m, 1e-3, 1e-17);
    /* the other way about: b's local point gives the world and a's */
    d.revolute[1].x_m = d.revolute[1].y_m = unset;
    d.revolute[1].bx_m = b->bx_m, d.revolute[1].by_m = b->by_m;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_near(m->pin[1].ax_m, 1e-3, 1e-17);
    d.revolute[1].bx_m = unset;
    assert_int_equal(build(&d, &m), FW_INPUT);
    assert_int_equal(d.diags.item[0].number, 84);
    fw_arena_free(d.arena);
}

static void test_stiffness_and_damping(void **state) {
    (void)state;
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    assert_int_equal(build(&d, &m), FW_OK);
    assert_int_equal(m->nhinge, 1);
    assert_int_equal(m->pin[0].hinge, 0);
    assert_int_equal(m->pin[1].hinge, FW_NONE);
    double own = m->hinge[0].closed_form.stiffness_Nm_per_rad;
    assert_near(m->pin[0].stiffness_Nm_per_rad, own, 0);
    assert_near(own, 1.711e-6, 0.2e-6); /* E I / L with corrections */
    double surface = 2330 * 50e-6;
    double j = surface * 4e-14 + surface * 2e-7 * (1e-6 + 0.25e-6);
    assert_near(m->pin[0].damping_Nms_per_rad, 1e-3 * sqrt(own * j), 1e-9 * sqrt(own * j));
    assert_true(m->pin[1].stiffness_Nm_per_rad == 0 && m->pin[1].damping_Nms_per_rad == 0);
    assert_near(m->spring[0].stiffness_N_per_m, 4, 0);
    /* the drawn fillet is used, and the closed form stays when the stiffness is explicit */
    const double limit = m->hinge[0].closed_form.limit_angle_rad;
    d.hinge[0].fillet_m = 2e-6;
    d.revolute[0].stiffness_Nm_per_rad = 1.03 * own / 2;
    d.revolute[0].damping_Nms_per_rad = 7e-12;
    d.variant.explicit_stiffness_scale = 2;
    d.variant.explicit_damping_scale = 3;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_near(m->pin[0].stiffness_Nm_per_rad, 1.03 * own, 1e-20);
    assert_near(m->pin[0].damping_Nms_per_rad, 21e-12, 1e-26);
    assert_near(m->spring[0].stiffness_N_per_m, 8, 1e-12);
    assert_true(m->hinge[0].closed_form.limit_angle_rad < limit); /* sharper fillet */
    assert_int_equal(d.diags.count, 0);
    /* more than 10 % apart: one warning, not one per flow */
    d.revolute[0].stiffness_Nm_per_rad = own;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_int_equal(build(&d, &m), FW_OK);
    assert_int_equal(d.diags.count, 1);
    assert_int_equal(d.diags.item[0].number, 86);
    assert_int_equal(d.diags.item[0].severity, FW_WARNING);
    assert_int_equal(d.diags.item[0].place.line, 7);
    fw_arena_free(d.arena);
}

static void test_without_a_layout(void **state) {
    (void)state;
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    assert_int_equal(fw_mechanism_build(d.arena, &d.device, NULL, &d.variant, &d.diags, &m),
                     FW_INPUT);
    assert_null(m);
    assert_int_equal(d.diags.item[0].number, 82);
    d.body[0] = (fw_device_body){.id = "AB", .mass_kg = 1e-8, .inertia_kg_m2 = 1e-15, .x_m = 1e-3};
    assert_int_equal(fw_mechanism_build(d.arena, &d.device, NULL, &d.variant, &d.diags, &m), FW_OK);
    assert_near(m->body[0].x_m, 1e-3, 0);
    fw_arena_free(d.arena);
}

/* every mistake is an error with its number, and all of one kind of part are reported together */
static void test_mistakes(void **state) {
    (void)state;
    for (int i = 0; i < 9; i++) {
        static const int number[] = {80, 81, 83, 83, 87, 87, 88, 89, 81};
        desk d;
        const fw_mechanism *m = NULL;
        desk_new(&d);
        switch (i) {
        case 0:
            d.variant.thickness_m = 0;
            break;
        case 1:
            d.variant.material.density.unknown = true;
            break;
        case 2:
            d.body[1].mass_kg = 0;
            break;
        case 3:
            d.body[1].phi_rad = (double)INFINITY;
            break;
        case 4:
            d.revolute[1].body_b = 0;
            break;
        case 5:
            d.revolute[1].body_b = 5;
            break;
        case 6:
            d.revolute[1].stiffness_Nm_per_rad = -1;
            break;
        case 7:
            d.spring[0].body_b = FW_GROUND;
            break;
        default:
            d.variant.material.youngs.unknown = true;
            break;
        }
        assert_int_equal(build(&d, &m), FW_INPUT);
        assert_null(m);
        assert_int_equal(d.diags.item[0].number, number[i]);
        assert_non_null(fw_diag_find(number[i]));
        fw_arena_free(d.arena);
    }
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    d.body[0].mass_kg = -1, d.body[1].mass_kg = -1;
    assert_int_equal(build(&d, &m), FW_INPUT);
    assert_int_equal(d.diags.errors, 2);
    fw_arena_free(d.arena);
}

/* bodies at (1, 0.5) mm and (3, 1) mm, the second turned by 0.5 rad */
typedef struct joints {
    fw_device_joint joint[3];
    fw_device_driver driver[2];
} joints;

static fw_quantity_law law_of(fw_arena *arena, const char *text, fw_quantity_dimension wanted) {
    fw_quantity_expression_error error;
    fw_quantity_program *program;
    if (fw_quantity_program_compile(arena, text, strlen(text), NULL, wanted, &program, &error) !=
        FW_OK)
        fail_msg("%s: %s", text, error.message);
    return (fw_quantity_law){.kind = &fw_quantity_law_expression, .program = program};
}

static void joints_new(desk *d, joints *t) {
    desk_new(d);
    memset(t, 0, sizeof *t);
    t->joint[0] = (fw_device_joint){.id = "p",
                                    .kind = FW_JOINT_PRISMATIC,
                                    .body_a = 0,
                                    .body_b = 1,
                                    .bx_m = 1e-3,
                                    .axis_rad = 0.3,
                                    .angle_rad = unset,
                                    .length_m = unset,
                                    .stiffness_N_per_m = 2,
                                    .damping_Ns_per_m = unset,
                                    .free_length_m = 1e-4,
                                    .place = {"d.xml", 9, 1}};
    t->joint[1] = t->joint[0];
    t->joint[1].id = "d", t->joint[1].kind = FW_JOINT_DISTANCE, t->joint[1].body_a = FW_GROUND;
    t->joint[1].place.line = 10;
    t->joint[2] = t->joint[0];
    t->joint[2].id = "w", t->joint[2].kind = FW_JOINT_WELD, t->joint[2].place.line = 11;
    t->driver[0] = (fw_device_driver){
        .id = "A",
        .revolute = 0,
        .joint = FW_NONE,
        .law = law_of(d->arena, "3 rad/s * t", (fw_quantity_dimension){.rad = 1}),
        .place = {"d.xml", 12, 1}};
    t->driver[1] = (fw_device_driver){
        .id = "d",
        .revolute = FW_NONE,
        .joint = 1,
        .law = law_of(d->arena, "1 mm + 2 mm/s*t", (fw_quantity_dimension){.m = 1}),
        .place = {"d.xml", 13, 1}};
    d->device.joint = t->joint, d->device.njoint = 3;
    d->device.driver = t->driver, d->device.ndriver = 2;
}

static void test_joints(void **state) {
    (void)state;
    desk d;
    joints t;
    const fw_mechanism *m;
    joints_new(&d, &t);
    d.variant.explicit_stiffness_scale = 3, d.variant.explicit_damping_scale = 5;
    t.joint[0].damping_Ns_per_m = 7;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_int_equal(d.diags.count, 0);
    assert_int_equal(m->njoint, 3);
    assert_int_equal(m->ndriver, 2);
    assert_near(m->joint[0].angle_rad, 0.5, 0); /* as drawn */
    assert_near(m->joint[0].stiffness_N_per_m, 6, 0);
    assert_near(m->joint[0].damping_Ns_per_m, 35, 0);
    assert_near(m->joint[0].free_length_m, 1e-4, 0);
    assert_near(m->joint[1].length_m, hypot(3e-3 + 1e-3 * cos(0.5), 1e-3 + 1e-3 * sin(0.5)), 1e-18);
    assert_near(m->joint[1].stiffness_N_per_m, 0, 0); /* a rod has none */
    assert_near(m->joint[2].angle_rad, 0.5, 0);
    fw_geometry_vec2 p = fw_mechanism_local_place(m, 1, 1e-3, 0);
    assert_near(p.x, 3e-3 + 1e-3 * cos(0.5), 1e-18);
    /* what the file gives stays */
    t.joint[0].angle_rad = 0.25, t.joint[1].length_m = 4e-3;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_near(m->joint[0].angle_rad, 0.25, 0);
    assert_near(m->joint[1].length_m, 4e-3, 0);
    fw_arena_free(d.arena);
}

static void test_stops(void **state) {
    (void)state;
    desk d;
    const fw_mechanism *m;
    desk_new(&d);
    d.revolute[0].stop_min_rad = -0.1, d.revolute[0].stop_max_rad = unset;
    d.revolute[0].stop_stiffness_Nm_per_rad = 2e-3, d.revolute[0].stop_damping_Nms_per_rad = 3e-6;
    d.revolute[1].stop_min_rad = d.revolute[1].stop_max_rad = unset;
    d.revolute[1].stop_stiffness_Nm_per_rad = d.revolute[1].stop_damping_Nms_per_rad = unset;
    d.variant.explicit_stiffness_scale = 3, d.variant.explicit_damping_scale = 5;
    assert_int_equal(build(&d, &m), FW_OK);
    assert_near(m->pin[0].stop_min_rad, -0.1, 0);
    assert_true(isnan(m->pin[0].stop_max_rad));
    assert_near(m->pin[0].stop_stiffness_Nm_per_rad, 6e-3, 1e-18);
    assert_near(m->pin[0].stop_damping_Nms_per_rad, 15e-6, 1e-18);
    assert_true(isnan(m->pin[1].stop_min_rad) && m->pin[1].stop_stiffness_Nm_per_rad == 0 &&
                m->pin[1].stop_damping_Nms_per_rad == 0);
    fw_arena_free(d.arena);
}

static void test_mistakes_of_joints(void **state) {
    (void)state;
    static const int number[] = {90, 90, 90, 90, 92, 92, 92, 92, 92};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        desk d;
        joints t;
        const fw_mechanism *m = NULL;
        joints_new(&d, &t);
        switch (i) {
        case 0:
            t.joint[0].body_b = 0;
            break;
        case 1:
            t.joint[1].length_m = 0;
            break;
        case 2: /* as drawn, and drawn on one point */
            t.joint[1].ax_m = 3e-3, t.joint[1].ay_m = 1e-3, t.joint[1].bx_m = 0;
            break;
        case 3:
            t.joint[2].bx_m = (double)INFINITY;
            break;
        case 4:
            t.driver[0].revolute = 7;
            break;
        case 5: /* a weld */
            t.driver[1].joint = 2;
            break;
        case 6: /* both */
            t.driver[0].joint = 1;
            break;
        case 7:
            t.driver[0].law =
                law_of(d.arena, "1 rad*ln(t/(1 s))", (fw_quantity_dimension){.rad = 1});
            break;
        default:
            t.driver[1].law = law_of(d.arena, "2 mm/s*t", (fw_quantity_dimension){.m = 1});
            break;
        }
        assert_int_equal(build(&d, &m), FW_INPUT);
        assert_null(m);
        assert_int_equal(d.diags.errors, 1);
        assert_int_equal(d.diags.item[0].number, number[i]);
        assert_non_null(fw_diag_find(number[i]));
        fw_arena_free(d.arena);
    }
}

/* a spring with a rest length whose ends coincide has no direction: said once, not per flow */
static void test_spring_without_direction(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        desk d;
        const fw_mechanism *m;
        desk_new(&d);
        d.spring[0].ax_m = 3e-3, d.spring[0].ay_m = 1e-3;
        d.spring[0].place = (fw_place){"d.xml", 20, 5};
        if (i == 1) d.spring[0].length_m = 0;
        if (i == 2) d.spring[0].cable = true;
        if (i == 3) d.spring[0].ax_m = 3.1e-3;
        assert_int_equal(build(&d, &m), FW_OK);
        assert_int_equal(build(&d, &m), FW_OK);
        assert_int_equal(d.diags.count, i == 0);
        if (i == 0) assert_int_equal(d.diags.item[0].number, 91);
        if (i == 0) assert_int_equal(d.diags.item[0].place.line, 20);
        fw_arena_free(d.arena);
    }
}

static void test_out_of_memory(void **state) {
    (void)state;
    for (long n = 1; n < 20; n++) {
        desk d;
        const fw_mechanism *m;
        desk_new(&d);
        fw_arena_fail_at(n, 0);
        fw_status status = build(&d, &m);
        long made = fw_arena_count();
        fw_arena_fail_at(0, 0);
        fw_arena_free(d.arena);
        assert_int_equal(status, made < n ? FW_OK : FW_NOMEM);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crystal),
        cmocka_unit_test(test_masses),
        cmocka_unit_test(test_points),
        cmocka_unit_test(test_stiffness_and_damping),
        cmocka_unit_test(test_without_a_layout),
        cmocka_unit_test(test_mistakes),
        cmocka_unit_test(test_joints),
        cmocka_unit_test(test_stops),
        cmocka_unit_test(test_mistakes_of_joints),
        cmocka_unit_test(test_spring_without_direction),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
