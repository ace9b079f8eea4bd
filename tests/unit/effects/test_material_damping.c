/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "hinge_rigs.h"
#include "quantity/law_kind.h"

static const double nan_ = (double)NAN;

/* two links; the estimate of the mechanism is in both pins */
static void rig_chain(rig *r, fw_device_material_damping *use) {
    rig_new(r, 2, 2);
    r->body[0] = (fw_mechanism_mass){"a", 2e-8, 3e-15, 5e-4, 0, 0, {0, 0}};
    r->body[1] = (fw_mechanism_mass){"b", 1e-8, 1e-15, 15e-4, 0, 0, {0, 0}};
    rig_hinge(r, 0, "A", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, 0.4, true);
    rig_hinge(r, 1, "B", 0, 1, (fw_geometry_vec2){1e-3, 0}, 0.4, true);
    r->pin[0].damping_Nms_per_rad = r->pin[1].damping_Nms_per_rad = 1e-12;
    r->variant.material.loss.value = 2e-3;
    r->scene.damping = use, r->scene.ndamping = use ? 1 : 0;
}

static void compile(rig *r) {
    assert_int_equal(fw_effects_loads_new(r->arena, &r->m, &r->scene, &r->loads), FW_OK);
    if (fw_effect_joint_damping.called_for(&r->c))
        assert_int_equal(fw_effect_joint_damping.add(&r->c, &r->loads), FW_OK);
    if (fw_effect_material_damping.called_for(&r->c))
        assert_int_equal(fw_effect_material_damping.add(&r->c, &r->loads), FW_OK);
}

static double damper(const rig *r, int pin) {
    int at = r->loads.torsion_of[pin];
    return at ? r->loads.torsion[at - 1].damping_Nms_per_rad : 0;
}

static void counts_once(void **state) {
    (void)state;
    fw_device_material_damping use = {.loss_factor = 5e-3, .frequency_Hz = 800};
    rig r;
    rig_chain(&r, NULL); /* the scene says nothing: the estimate */
    compile(&r);
    assert_false(fw_effect_material_damping.called_for(&r.c));
    assert_near(damper(&r, 0), 1e-12, 0);
    assert_near(damper(&r, 1), 1e-12, 0);
    fw_arena_free(r.arena);

    rig_chain(&r, &use); /* stated at one pin: it stays; the other has c = eta k/omega */
    r.hinge[1].damping_stated = true;
    compile(&r);
    assert_relative(damper(&r, 0), 5e-3 * r.pin[0].stiffness_Nm_per_rad / (2 * M_PI * 800), 1e-14);
    assert_near(damper(&r, 1), 1e-12, 0);
    fw_arena_free(r.arena);

    rig_chain(&r, &use); /* joint-damping has nothing left to do */
    compile(&r);
    assert_false(fw_effect_joint_damping.called_for(&r.c));
    /* pins that are no flexures keep theirs */
    r.pin[1].hinge = FW_NONE;
    compile(&r);
    assert_near(damper(&r, 1), 1e-12, 0);
    r.pin[0].hinge = FW_NONE;
    assert_false(fw_effect_material_damping.called_for(&r.c));
    fw_arena_free(r.arena);
}

/* frequency: stated, the lowest mode, or sqrt(k/J) of the hinge; loss: stated or the material's */
static void where_it_holds(void **state) {
    (void)state;
    fw_device_material_damping use = {.loss_factor = nan_, .frequency_Hz = nan_};
    rig r;
    rig_chain(&r, &use);
    compile(&r);
    double k = r.pin[0].stiffness_Nm_per_rad;
    double ja = 3e-15 + 2e-8 * 25e-8, jb = 1e-15 + 1e-8 * 25e-8;
    assert_relative(damper(&r, 0), 2e-3 * sqrt(k * ja), 1e-12);
    assert_relative(damper(&r, 1), 2e-3 * sqrt(k * jb), 1e-12); /* the smaller of the two */
    double omega = 4321;
    r.envelope = (fw_effects_envelope){.valid = true, .modes = 1, .omega = &omega};
    compile(&r);
    assert_relative(damper(&r, 0), 2e-3 * k / omega, 1e-14);
    assert_relative(damper(&r, 1), 2e-3 * k / omega, 1e-14);
    fw_arena_free(r.arena);

    rig_chain(&r, &use);
    r.variant.material.loss.unknown = true;
    use.place = (fw_place){"d.xml", 12, 3};
    assert_int_equal(fw_effects_loads_new(r.arena, &r.m, &r.scene, &r.loads), FW_OK);
    assert_int_equal(fw_effect_material_damping.add(&r.c, &r.loads), FW_INPUT);
    assert_int_equal(r.diags.item[0].number, 247);
    assert_int_equal(r.diags.item[0].place.line, 12);
    double bound;
    const char *why;
    assert_int_equal(fw_effect_material_damping.bound(&r.c, &bound, &why), FW_OK);
    assert_true(isinf(bound)); /* so that its add is called, and says so */
    fw_arena_free(r.arena);
}

/* a single hinge that swings free: its loss per radian at omega is eta; without an envelope
   nothing is promised */
static void a_swinging_lever(void **state) {
    (void)state;
    for (double eta = 1e-5; eta < 0.2; eta *= 7) {
        fw_device_material_damping use = {.loss_factor = eta, .frequency_Hz = nan_};
        rig r;
        rig_new(&r, 1, 1);
        r.body[0] = (fw_mechanism_mass){"a", 1e-9, 3e-15, 5e-4, 0, 0, {0, 0}};
        rig_hinge(&r, 0, "A", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, 0.4, true);
        r.scene.damping = &use, r.scene.ndamping = 1;
        compile(&r);
        double k = r.pin[0].stiffness_Nm_per_rad, J = 3e-15 + 1e-9 * 25e-8, c = damper(&r, 0);
        double omega = sqrt(k / J);
        assert_relative(M_PI * c * omega / (2 * M_PI * 0.5 * k), eta, 1e-12);
        double bound;
        const char *why;
        r.scene.duration_s = 20 / omega;
        assert_int_equal(fw_effect_material_damping.bound(&r.c, &bound, &why), FW_OK);
        assert_true(isinf(bound));
        fw_arena_free(r.arena);
    }
}

/* no longer relaxation time for what the hinge gives than for its rotation, where the damping is the
   material's */
static void what_gives_is_damped_too(void **state) {
    (void)state;
    for (int stated = 0; stated < 2; stated++) {
        fw_device_material_damping use = {.loss_factor = 5e-3, .frequency_Hz = 8e5};
        rig r;
        rig_chain(&r, &use);
        r.hinge[0].damping_stated = stated;
        compile(&r);
        assert_int_equal(fw_effect_nonlinear_hinge.add(&r.c, &r.loads), FW_OK);
        const fw_effects_force_element *e = &r.loads.element[0];
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&r.hinge[0].law, 0, &at);
        const double p[6] = {0}, speed = 1e-3, axis = 0.4;
        const double w[6] = {0, 0, 0, speed * cos(axis), speed * sin(axis), 0};
        const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
        double f[6], tau = 5e-3 / (2 * M_PI * 8e5);
        e->class_->force(e, &s, f);
        double wanted = stated ? 0 : -tau * at.kx_N_per_m.value * speed;
        assert_near(f[3] * cos(axis) + f[4] * sin(axis), wanted, 1e-12 * fabs(wanted) + 1e-20);
        assert_near(damper(&r, 0), stated ? 1e-12 : tau * r.pin[0].stiffness_Nm_per_rad, 1e-22);
        fw_arena_free(r.arena);
    }
}

/* what a hinge gives is damped as its material is at its own frequency, sqrt(k/m) of the lighter body, and
   not by the rotation's damper, which is far too strong there; but where nothing sets it off in earnest no
   less than by a loss factor of 5e-3, with contacts, too */
static void what_is_stiff_rings_on(void **state) {
    (void)state;
    /* slow: nothing, and a ramp; a contact that is open; jolts: a step, a pulse of a few periods, a velocity */
    enum { NOTHING, STATED, RAMP, TOUCHING, STEP, PULSE, START, SCENES };
    static const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 1};
    static const fw_quantity_law pulse = {.kind = &fw_quantity_law_half_sine, .rise_s = 1e-4};
    for (int scene = 0; scene < SCENES; scene++) {
        fw_device_material_damping use = {.loss_factor = 2e-2, .frequency_Hz = 80};
        fw_device_contact_use contact = {.joint = FW_NONE};
        fw_device_force force = {.law = scene == RAMP ? &ramp : NULL, .fx_N = 1e-6};
        fw_device_base_motion shake = {.law = &pulse};
        fw_device_initial start = {.vx_m_per_s = 1e-3};
        rig r;
        rig_chain(&r, scene == STATED ? &use : NULL);
        double K = r.pin[1].stiffness_Nm_per_rad, eta = scene == STATED ? 2e-2 : 2e-3;
        double wanted = scene >= STEP ? eta : fmax(eta, 5e-3);
        r.scene.duration_s = 10;
        r.pin[1].damping_Nms_per_rad = eta * sqrt(K * (1e-15 + 1e-8 * 25e-8));
        compile(&r);
        r.scene.force = &force, r.scene.nforce = scene == RAMP || scene == STEP;
        r.scene.contact = &contact, r.scene.ncontact = scene == TOUCHING;
        r.scene.base = &shake, r.scene.nbase = scene == PULSE;
        r.scene.initial = &start, r.scene.ninitial = scene == START;
        assert_int_equal(fw_effect_nonlinear_hinge.add(&r.c, &r.loads), FW_OK);
        const fw_effects_force_element *e = &r.loads.element[1];
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&r.hinge[1].law, 0, &at);
        const double k[2] = {at.kx_N_per_m.value, at.ky_N_per_m.value};
        for (int i = 0; i < 2; i++) {
            double angle = 0.4 + i * M_PI / 2, speed = 1e-3, mass = 1e-8, f[6];
            const double p[6] = {0}, w[6] = {0, 0, 0, speed * cos(angle), speed * sin(angle), 0};
            const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
            e->class_->force(e, &s, f);
            double c = -(f[3] * cos(angle) + f[4] * sin(angle)) / speed;
            double omega = sqrt(k[i] / mass); /* of the second body on the hinge */
            assert_relative(c * omega / k[i], wanted, 1e-9);
            assert_true(damper(&r, 1) * omega / K > 1.5 * wanted);
        }
        fw_arena_free(r.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_once),
        cmocka_unit_test(where_it_holds),
        cmocka_unit_test(a_swinging_lever),
        cmocka_unit_test(what_gives_is_damped_too),
        cmocka_unit_test(what_is_stiff_rings_on),
    };
    return cmocka_run_group_tests_name("material-damping", tests, NULL, NULL);
}
