/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices whose substrate expands otherwise than they do: equilibria, motions and given motions
   against elementary geometry, and a temperature with a law against a constant one. */
#include "quantity/law_kind.h"
#include "assembly/assembly.h"
#include "rest_rigs.h"
#include "statics/statics.h"

static const double pi = 3.14159265358979323846;
enum { WIDTH = 3, HEIGHT = 2 };

/* two legs and a beam on four equal hinges; the ground's points grow apart by `strain` */
static rig portal(fixture *f, double strain, double c) {
    rig r = rig_new(f->arena, 3, 4, 0);
    rig_body(&r, "left", 1, 0.4, 0, HEIGHT / 2.0, 0);
    rig_body(&r, "beam", 2, 1.7, WIDTH / 2.0, HEIGHT, 0);
    rig_body(&r, "right", 1, 0.4, WIDTH, HEIGHT / 2.0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 5, c);
    rig_pin(&r, "B", 0, 1, 0, HEIGHT, 5, c);
    rig_pin(&r, "C", 1, 2, WIDTH, HEIGHT, 5, c);
    rig_pin(&r, "D", 2, FW_GROUND, WIDTH, 0, 5, c);
    r.scene.temperature = fw_arena_array(f->arena, fw_device_temperature, 2);
    r.scene.temperature[r.scene.ntemperature++] =
        (fw_device_temperature){.change_K = 100,
                                .expansion_per_K = 5e-6,
                                .substrate_expansion_per_K = ((1 + strain) * (1 + 5e-4) - 1) / 100,
                                .modulus_change_per_K = 0};
    r.scene.duration_s = 1;
    return r;
}

static const fw_statics *rest(fixture *f, const rig *r) {
    const fw_statics_static_options o = {.path = false};
    const fw_statics *s = NULL;
    fw_status status = fw_statics_solve(f->arena, &r->m, &r->scene, &o, &f->diags, &s);
    if (status != FW_OK) fail_msg("%s", f->diags.item[f->diags.count - 1].message);
    return s;
}

static const fw_dynamics_motion *run(fixture *f, const rig *r, const char *method, double rtol,
                                     int samples) {
    fw_dynamics_motion_options o = {.method = method, .rtol = rtol, .samples = samples};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(f->arena, &r->m, &r->scene, &o, &f->diags, &motion);
    if (status != FW_OK)
        fail_msg("%s: %s", method ? method : "default", f->diags.item[f->diags.count - 1].message);
    assert_true(motion->stats.max_constraint_norm < 1e-12);
    return motion;
}

/* By symmetry the beam stays level and each leg leans by theta with WIDTH (1 + strain) = WIDTH + 2
   HEIGHT sin theta, whatever the stiffness of the equal hinges: to the right on the right. */
static void portal_leans(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        fixture f = begin();
        double strain = (i - 1.5) * 4e-3, theta = asin(WIDTH * strain / (2 * HEIGHT));
        rig r = portal(&f, strain, 0);
        const fw_statics *s = rest(&f, &r);
        /* the left foot moves left, so the leg turns clockwise: -theta */
        const double want[4] = {-theta, theta, theta, -theta};
        for (int k = 0; k < 4; k++)
            assert_near(s->angle_rad[k], want[k], 1e-12);
        fw_arena_free(f.arena);
    }
}

/* the law at the end of the scene counts in statics; a slow ramp leads the damped motion there */
static void ramp_ends_like_a_constant(void **state) {
    (void)state;
    fixture f = begin();
    rig steady = portal(&f, 8e-3, 0), ramped = portal(&f, 8e-3, 4);
    const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 60};
    ramped.scene.temperature[0].law = &ramp;
    ramped.scene.duration_s = 100;
    const fw_statics *a = rest(&f, &steady), *b = rest(&f, &ramped);
    const fw_dynamics_motion *m = run(&f, &ramped, NULL, 1e-9, 3);
    assert_true(m->stats.energy_error < 1e-7);
    for (int i = 0; i < 4; i++) {
        assert_near(b->angle_rad[i], a->angle_rad[i], 1e-13);
        assert_near(m->angle_rad[2 * 4 + i], a->angle_rad[i], 1e-8);
        assert_true(fabs(m->angle_rad[i]) < 1e-15); /* at the start it is cold */
    }
    /* half way up the ramp, slowly: the equilibrium of that strain, but for the lag */
    rig half = portal(&f, 8e-3 * 50 / 60, 0);
    const fw_statics *c = rest(&f, &half);
    for (int i = 0; i < 4; i++)
        assert_near(m->angle_rad[4 + i], c->angle_rad[i], 3e-4);
    fw_arena_free(f.arena);
}

/* a constant strain put on at once swings about the equilibrium; a law that has it from the start
   on gives the same motion */
static void from_the_start(void **state) {
    (void)state;
    fixture f = begin();
    rig constant = portal(&f, 5e-3, 0.1), always = portal(&f, 5e-3, 0.1);
    const fw_quantity_law cosine = {.kind = &fw_quantity_law_sine,
                                    .end_s = (double)INFINITY,
                                    .frequency_Hz = 1e-12,
                                    .phase_rad = pi / 2};
    always.scene.temperature[0].law = &cosine;
    const fw_dynamics_motion *a = run(&f, &constant, NULL, 1e-11, 3),
                             *b = run(&f, &always, NULL, 1e-11, 3);
    for (int i = 0; i < 12; i++)
        assert_near(a->angle_rad[i], b->angle_rad[i], 1e-10);
    constant.scene.duration_s = 400;
    a = run(&f, &constant, NULL, 1e-9, 2);
    const fw_statics *s = rest(&f, &constant);
    for (int i = 0; i < 4; i++)
        assert_near(a->angle_rad[4 + i], s->angle_rad[i], 1e-8);
    fw_arena_free(f.arena);
}

/* ---- what the ground alone moves: two bars of length L pinned to the ground W apart and to each
   other; the apex is at sqrt(L^2 - (W e/2)^2), e = 1 + strain law ---- */

static void apex(double t, double w_rad_per_s, double strain, double y[3]) {
    const double half = 1.5, length = 2.5;
    double e = 1 + strain * sin(w_rad_per_s * t), e1 = strain * w_rad_per_s * cos(w_rad_per_s * t);
    double e2 = -strain * w_rad_per_s * w_rad_per_s * sin(w_rad_per_s * t), x = half * e;
    y[0] = sqrt(length * length - x * x);
    y[1] = -x * half * e1 / y[0];
    y[2] = -(half * half * e1 * e1 + x * half * e2 + y[1] * y[1]) / y[0];
}

static rig roof(fixture *f, const fw_quantity_law *law, double strain) {
    rig r = rig_new(f->arena, 2, 3, 0);
    double tilt = atan2(2, 1.5);
    rig_body(&r, "left", 1, 0.5, 0.75, 1, tilt);
    rig_body(&r, "right", 1, 0.5, 2.25, 1, -tilt);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", 0, 1, 1.5, 2, 0, 0);
    rig_pin(&r, "C", 1, FW_GROUND, 3, 0, 0, 0);
    r.scene.temperature = fw_arena_array(f->arena, fw_device_temperature, 1);
    r.scene.temperature[r.scene.ntemperature++] = (fw_device_temperature){
        .change_K = 1, .expansion_per_K = 0, .substrate_expansion_per_K = strain, .law = law};
    r.scene.duration_s = 3;
    return r;
}

static void moved_by_the_ground_alone(void **state) {
    (void)state;
    fixture f = begin();
    const double w = 2.7, strain = 0.05;
    const fw_quantity_law sine = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = w / (2 * pi)};
    rig r = roof(&f, &sine, strain);
    double q[6], y[3];
    for (int b = 0; b < 2; b++)
        q[3 * b] = r.m.body[b].x_m, q[3 * b + 1] = r.m.body[b].y_m,
              q[3 * b + 2] = r.m.body[b].phi_rad;
    const fw_assembly_kinematics_options o = {.effects = {.mode = FW_EFFECTS_ALL}};
    const fw_assembly_kinematics *k;
    assert_int_equal(
        fw_assembly_kinematics_follow(f.arena, &r.m, &r.scene, q, 13, &o, &f.diags, &k), FW_OK);
    for (int i = 0; i < 13; i++) { /* centres of mass are half way up */
        apex(k[i].t_s, w, strain, y);
        assert_near(k[i].q[1], y[0] / 2, 1e-13);
        assert_near(k[i].v[1], y[1] / 2, 1e-12);
        assert_near(k[i].a[1], y[2] / 2, 1e-11);
    }
    for (size_t i = 0; fw_multibody_method_at(i).name; i++) {
        const fw_dynamics_motion *m = run(&f, &r, fw_multibody_method_at(i).name, 1e-11, 7);
        for (int s = 0; s < 7; s++) {
            apex(m->t_s[s], w, strain, y);
            assert_near(m->q[6 * s + 1], y[0] / 2, 1e-12);
            assert_near(m->v[6 * s + 1], y[1] / 2, 1e-10);
            assert_near(m->accel[6 * s + 1], y[2] / 2, 1e-9);
        }
    }
    fw_arena_free(f.arena);
}

/* the six-bar and, without `minimal`, one with a sliding joint, a rod, a weld and a spring on the
   ground: all methods agree, and the books close */
static rig mixed(fixture *f) {
    rig r = rig_new(f->arena, 4, 1, 2);
    rig_body(&r, "slider", 1, 0.2, 1, 0.3, 0.1);
    rig_body(&r, "bar", 1.5, 0.3, 2, 1, 0.4);
    rig_body(&r, "tail", 0.7, 0.1, 2.8, 1.4, 0.2);
    rig_body(&r, "bob", 1, 0.2, 4, 2, 0);
    rig_pin(&r, "P", 1, 2, 2.4, 1.2, 3, 0.2);
    fw_device_joint *t = rig_guide(f, &r, 0, 0, 0.3, 0.1);
    t->stiffness_N_per_m = 4, t->damping_Ns_per_m = 0.3, t->angle_rad = 0.1;
    t->free_length_m = 0.8, t->by_m = 0.1, t->ay_m = 0.35;
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "rod",
                                                .kind = FW_JOINT_DISTANCE,
                                                .body_a = FW_GROUND,
                                                .body_b = 1,
                                                .ax_m = 2.5,
                                                .ay_m = -0.7,
                                                .bx_m = 0.2,
                                                .length_m = 1.8};
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "link",
                                                .kind = FW_JOINT_DISTANCE,
                                                .body_a = 0,
                                                .body_b = 1,
                                                .bx_m = -0.4,
                                                .length_m = 1};
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "weld",
                                                .kind = FW_JOINT_WELD,
                                                .body_a = 3,
                                                .body_b = FW_GROUND,
                                                .ax_m = 0.1,
                                                .bx_m = 4.1,
                                                .by_m = 2};
    rig_spring(&r, "spring", FW_GROUND, 0.5, 2.5, 1, 0.1, 0.2, 6, 1)->damping_Ns_per_m = 0.4;
    rig_spring(&r, "spring", 2, 0.3, 0, FW_GROUND, 3.5, 2.5, 5, 0.5)->damping_Ns_per_m = 0.1;
    r.scene.temperature = fw_arena_array(f->arena, fw_device_temperature, 1);
    r.scene.ntemperature = 1;
    r.scene.duration_s = 2;
    return r;
}

static void methods_agree(void **state) {
    (void)state;
    const fw_quantity_law swings = {.kind = &fw_quantity_law_sine,
                                    .end_s = (double)INFINITY,
                                    .frequency_Hz = 0.9,
                                    .phase_rad = 0.3};
    const fw_quantity_law fast = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 700};
    for (int kind = 0; kind < 2; kind++) {
        fixture f = begin();
        rig r = kind ? mixed(&f) : rig_six_bar(f.arena, false);
        fw_device_temperature warm = {.change_K = 100,
                                      .expansion_per_K = 2e-5,
                                      .substrate_expansion_per_K = kind ? 6e-4 : 1.2e-4,
                                      .law = kind ? &swings : &fast};
        r.scene.temperature = &warm, r.scene.ntemperature = 1;
        const fw_dynamics_motion *first = NULL;
        for (size_t i = 0; fw_multibody_method_at(i).name; i++) {
            if (kind && strcmp(fw_multibody_method_at(i).name, "minimal") == 0) continue;
            const fw_dynamics_motion *m = run(&f, &r, fw_multibody_method_at(i).name, 1e-12, 5);
            assert_true(m->stats.energy_error < 1e-9);
            if (!first) first = m;
            const double size = kind ? 1 : 1e-3;
            for (int k = 0; k < 5 * 3 * m->nbody; k++)
                assert_near(m->q[k], first->q[k], 1e-9 * (k % 3 == 2 ? 1 : size));
        }
        /* and the temperature is felt */
        r.scene.ntemperature = 0;
        const fw_dynamics_motion *cold = run(&f, &r, NULL, 1e-11, 5);
        double most = 0;
        for (int k = 0; k < 5 * 3 * cold->nbody; k++)
            if (k % 3 == 2) most = fmax(most, fabs(cold->q[k] - first->q[k]));
        assert_true(most > 1e-3);
        fw_arena_free(f.arena);
    }
}

/* electrodes on a ground that grows: where its growth ends energy balances, also where samples
   were taken in the step before */
static void ends_of_ramps(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 1, 0);
        rig_body(&r, "lever", 1, 3, 1, 0, 0);
        rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 16, 0);
        fw_device_comb plate = {.id = "plate",
                                .kind = FW_ELECTRODES_PLATE,
                                .body_a = FW_GROUND,
                                .body_b = 0,
                                .bx_m = 0.5,
                                .direction_rad = 0.7,
                                .gap_m = 1,
                                .length_m = 0.5,
                                .depth_m = 1,
                                .voltage_V = 4e5};
        r.scene.comb = &plate, r.scene.ncomb = 1;
        const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 1.003 + 0.1 * i};
        fw_device_temperature warm = {.change_K = 100,
                                      .expansion_per_K = 2e-5,
                                      .substrate_expansion_per_K = 5e-4,
                                      .modulus_change_per_K = 0,
                                      .law = &ramp};
        r.scene.temperature = &warm, r.scene.ntemperature = 1;
        r.scene.duration_s = 4;
        fw_dynamics_motion_options o = {
            .rtol = 1e-12, .samples = 401, .effects = {.mode = FW_EFFECTS_ALL}};
        const fw_dynamics_motion *m = NULL;
        assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m), FW_OK);
        assert_true(m->stats.energy_error < 1e-10);
        fw_arena_free(f.arena);
    }
}

/* equilibria know laws by their values: how fast a cable is drawn and a ground grows at the end of
   the scene is nothing to dampers. k x = K (draw law - slack - x) for a cable along the guide */
static void dampers_rest(void **state) {
    (void)state;
    static const fw_device_eyelet line[] = {{.body = 0}, {.body = FW_GROUND, .x_m = 1}};
    const fw_quantity_law swings = {.kind = &fw_quantity_law_sine,
                                    .end_s = (double)INFINITY,
                                    .frequency_Hz = 0.6,
                                    .phase_rad = 1};
    double q[2][2];
    for (int i = 0; i < 2; i++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 0, 1);
        rig_body(&r, "slider", 1, 1, 0, 0, 0);
        rig_guide(&f, &r, 0, 0, 0, 0)->stiffness_N_per_m = 3;
        fw_device_tendon cable = {.id = "cable",
                                  .eyelet = (fw_device_eyelet *)line,
                                  .neyelet = 2,
                                  .pull_N = (double)NAN,
                                  .draw_m = 0.02,
                                  .slack_m = -0.1,
                                  .stiffness_N_per_m = 7,
                                  .damping_Ns_per_m = i ? 4 : 0,
                                  .law = &swings};
        r.scene.tendon = &cable, r.scene.ntendon = 1;
        r.scene.duration_s = 1;
        double law = sin(1.2 * acos(-1.0) + 1);
        q[i][0] = rest(&f, &r)->q[0];
        assert_near(q[i][0], 7 * (0.02 * law + 0.1) / 10, 1e-12);
        r.scene.ntendon = 0;
        rig_spring(&r, "spring", FW_GROUND, -1, 0.3, 0, 0, 0, 5, 1.2)->damping_Ns_per_m = i ? 4 : 0;
        fw_device_temperature warm = {.change_K = 100,
                                      .expansion_per_K = 2e-5,
                                      .substrate_expansion_per_K = 5e-4,
                                      .law = &swings};
        r.scene.temperature = &warm, r.scene.ntemperature = 1;
        q[i][1] = rest(&f, &r)->q[0];
        assert_true(fabs(q[i][1]) > 1e-2);
        fw_arena_free(f.arena);
    }
    assert_near(q[1][1], q[0][1], 1e-12);
}

/* a lever on a flexure: its frequency goes with sqrt(1 + beta dT), its joint's own spring does not
 */
static void softer_flexure(void **state) {
    (void)state;
    for (int hinge = 0; hinge < 2; hinge++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 1, 0);
        rig_body(&r, "lever", 1, 3, 1, 0, 0);
        rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 16, 0)->hinge = hinge ? 0 : FW_NONE;
        rig_velocity(&r, 0, 0, 0.1, 0.1);
        fw_device_temperature warm = {.change_K = 50, .modulus_change_per_K = -2e-3};
        r.scene.temperature = &warm, r.scene.ntemperature = 1;
        r.scene.duration_s = 5;
        const fw_dynamics_motion *m = run(&f, &r, NULL, 1e-12, 11);
        double w = sqrt(16 * (hinge ? 0.9 : 1) / 4);
        for (int i = 0; i < 11; i++)
            assert_near(m->angle_rad[i], 0.1 / w * sin(w * m->t_s[i]), 1e-11);
        fw_arena_free(f.arena);
    }
}

static void mistakes(void **state) {
    (void)state;
    static const fw_quantity_law late = {
        .kind = &fw_quantity_law_step, .start_s = 0.5, .end_s = (double)INFINITY};
    static const fw_quantity_law ramp = {.kind = &fw_quantity_law_ramp, .rise_s = 1};
    for (int i = 0; i < 5; i++) {
        fixture f = begin();
        rig r = portal(&f, 1e-3, 0);
        fw_device_temperature *t = r.scene.temperature;
        if (i == 0) t->law = &late;
        if (i == 1) t->law = &ramp, t[1] = t[0], r.scene.ntemperature = 2;
        if (i == 2) t->expansion_per_K = (double)NAN;
        if (i == 3) r.m.pin[0].hinge = 0, t->modulus_change_per_K = (double)NAN;
        if (i == 4) r.m.pin[0].hinge = 0, t->modulus_change_per_K = -0.02;
        fw_dynamics_motion_options o = {.samples = 2};
        const fw_dynamics_motion *m;
        assert_int_equal(fw_dynamics_simulate(f.arena, &r.m, &r.scene, &o, &f.diags, &m), FW_INPUT);
        assert_true(said(&f, i == 2 || i == 3 ? 253 : 252));
        fw_arena_free(f.arena);
    }
}

/* ---- stress of the layer ---- */

/* A portal whose layer wants to be `shorter`, and bowed: the ground's points stand WIDTH/(1 +
   strain of the layer) apart, a beam of WIDTH has the chord (2/kappa) sin(kappa WIDTH/2). */
static void stressed_layer(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        fixture f = begin();
        rig r = portal(&f, 0, 0);
        fw_mechanism_variant v = {.thickness_m = i ? 1 : 1e-3};
        v.material.youngs.value = 100e9, v.material.poisson.value = 0.25;
        fw_device_residual_stress s = {.mean_Pa = i < 2 ? 400e6 : -250e6,
                                       .gradient_Pa_per_m = i == 1 ? 0 : 9e9};
        r.m.variant = &v;
        r.scene.ntemperature = 0;
        r.scene.stress = &s, r.scene.nstress = 1;
        double layer = -s.mean_Pa * 0.75 / 100e9, kappa = s.gradient_Pa_per_m * 0.75 / 100e9;
        double ground = WIDTH / (1 + layer), beam = WIDTH, leg = HEIGHT;
        if (kappa > 0) {
            beam = 2 / kappa * sin(kappa * WIDTH / 2), leg = 2 / kappa * sin(kappa * HEIGHT / 2);
            assert_relative(beam, WIDTH * (1 - kappa * kappa * WIDTH * WIDTH / 24), 1e-5);
        }
        double theta = asin((ground - beam) / (2 * leg));
        const fw_statics *rests = rest(&f, &r);
        assert_near(rests->angle_rad[0], -theta, 1e-12);
        assert_near(rests->angle_rad[1], theta, 1e-12);
        assert_near(rests->angle_rad[3], -theta, 1e-12);
        /* its free end rises by kappa L^2/2 = 0.3 m: 0 where there is no gradient */
        assert_int_equal(said(&f, 251), i == 0);
        const fw_effect_ledger *ledger = &rests->ledger;
        for (int k = 0; k < ledger->count; k++)
            if (strcmp(ledger->item[k].id, "residual-stress") == 0)
                assert_true(ledger->item[k].active && ledger->item[k].bound >= 1);
        v.material.youngs.unknown = true;
        const fw_statics_static_options o = {.path = false};
        const fw_statics *none;
        assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &none), FW_INPUT);
        assert_true(said(&f, 253));
        fw_arena_free(f.arena);
    }
}

/* strains move the points of loads and springs with the material: a bent lever on a spring, loaded
   off its joints, twice as large and with twice the rest length is the same lever */
static void points_follow(void **state) {
    (void)state;
    fixture f = begin();
    rig r[2];
    double strain[2] = {1, 1};
    for (int i = 0; i < 2; i++) {
        double size = i ? 2 : 1;
        r[i] = rig_new(f.arena, 1, 1, 1);
        rig_body(&r[i], "lever", 1, 1, 0, 0, 0);
        rig_pin_local(&r[i], "A", FW_GROUND, size, 0, 0, size * 0.3, size * 0.1);
        rig_spring(&r[i], "spring", FW_GROUND, -size, size * 0.5, 0, size * 0.4, -size * 0.2, 3,
                   0.7);
        r[i].scene.force[r[i].scene.nforce++] = (fw_device_force){
            .body = 0, .x_m = size * -0.5, .y_m = size * 0.8, .fx_N = 2, .fy_N = 1};
    }
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    fw_effects_loads loads[2];
    fw_effect_ledger ledger;
    for (int i = 0; i < 2; i++)
        assert_int_equal(fw_effects_compile(f.arena, &r[i].m, &r[i].scene, &all, 1e-3, &f.diags,
                                            &ledger, &loads[i]),
                         FW_OK);
    const fw_mechanism *same, *grown;
    assert_int_equal(fw_effects_strain(f.arena, &r[1].m, &loads[1], &same), FW_OK);
    assert_true(same == &r[1].m); /* nothing is strained */
    memcpy(loads[0].strain, strain, sizeof strain);
    loads[0].strained = true;
    assert_int_equal(fw_effects_strain(f.arena, &r[0].m, &loads[0], &grown), FW_OK);
    fw_geometry_vec2 c = fw_mechanism_ground_centre(&r[0].m);
    assert_near(grown->pin[0].ax_m, 2 * r[0].m.pin[0].ax_m - c.x, 1e-15);
    assert_near(grown->pin[0].bx_m, r[1].m.pin[0].bx_m, 1e-15);
    assert_near(loads[0].load[0].x_m, loads[1].load[0].x_m, 1e-15);
    assert_near(loads[0].load[0].y_m, loads[1].load[0].y_m, 1e-15);
    assert_near(loads[0].spring[0].bx_m, loads[1].spring[0].bx_m, 1e-15);
    assert_near(loads[0].spring[0].ay_m, 2 * r[0].m.spring[0].ay_m - c.y, 1e-15);
    assert_true(loads[0].spring[0].length_m == 0.7);
    fw_arena_free(f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(portal_leans),   cmocka_unit_test(ramp_ends_like_a_constant),
        cmocka_unit_test(from_the_start), cmocka_unit_test(moved_by_the_ground_alone),
        cmocka_unit_test(methods_agree),  cmocka_unit_test(ends_of_ramps),
        cmocka_unit_test(dampers_rest),   cmocka_unit_test(softer_flexure),
        cmocka_unit_test(mistakes),       cmocka_unit_test(stressed_layer),
        cmocka_unit_test(points_follow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
