/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of linear motions against closed forms of one mode, and against a fine leap-frog of two
   that dampers joint together. */
#include "quantity/law_kind.h"
#include "effects/modal.h"
#include "hinge_rigs.h"

enum { BODIES = 2 };

typedef struct row { /* a chain of pins from the ground, drawn straight */
    rig r;
    fw_device_torque torque[BODIES];
    fw_effects_modal modal;
    fw_effects_modal_loads modal_loads;
    fw_effects_peaks peaks;
} row;

static const double k_Nm = 2e-6, inertia = 1e-15, mass = 1e-8, arm = 5e-4;

static void row_new(row *x, int bodies, double zeta) {
    memset(x, 0, sizeof *x);
    rig_new(&x->r, bodies, bodies);
    x->r.m.nhinge = 0;
    for (int b = 0; b < bodies; b++) {
        x->r.body[b] = (fw_mechanism_mass){"link", mass, inertia, (2 * b + 1) * arm, 0, 0, {0, 0}};
        x->r.pin[b] = (fw_mechanism_pin){.id = "p",
                                         .body_a = b - 1,
                                         .body_b = b,
                                         .ax_m = b ? arm : 0,
                                         .bx_m = -arm,
                                         .stiffness_Nm_per_rad = k_Nm,
                                         .hinge = FW_NONE};
    }
    double omega = sqrt(k_Nm / (inertia + mass * arm * arm));
    x->r.pin[0].damping_Nms_per_rad = 2 * zeta * k_Nm / omega;
    x->r.scene.torque = x->torque;
}

static void row_find(row *x, double end_s) {
    rig *r = &x->r;
    r->scene.duration_s = end_s;
    assert_int_equal(fw_effects_loads_new(r->arena, &r->m, &r->scene, &r->loads), FW_OK);
    assert_int_equal(fw_effect_joint_elasticity.add(&r->c, &r->loads), FW_OK);
    assert_int_equal(fw_effect_joint_damping.add(&r->c, &r->loads), FW_OK);
    assert_int_equal(fw_effect_applied_load.add(&r->c, &r->loads), FW_OK);
    assert_int_equal(fw_effects_modal_find(r->arena, &r->m, &r->scene, &r->loads, &x->modal),
                     FW_OK);
    assert_null(x->modal.why_not);
    assert_int_equal(fw_effects_modal_loads_find(r->arena, &x->modal, &x->modal_loads), FW_OK);
    assert_int_equal(fw_effects_peaks_find(r->arena, &x->modal, &x->modal_loads,
                                           x->modal.omega[x->modal.modes - 1], NULL, NULL,
                                           &x->peaks),
                     FW_OK);
    assert_null(x->peaks.why_not);
}

static void between(const row *x, int pin, double peak, double within) {
    assert_true(x->peaks.low[pin] <= peak * (1 + 1e-9) && peak <= x->peaks.high[pin] * (1 + 1e-9));
    assert_near(x->peaks.low[pin], peak, within * peak);
    assert_near(x->peaks.high[pin], peak, within * peak);
}

/* a step: s (1 + e^(-pi zeta/sqrt(1 - zeta^2))) */
static void step(void **state) {
    (void)state;
    for (int i = 0; i < 5; i++) {
        const double zeta[] = {0, 1e-3, 0.05, 0.3, 0.9};
        row x;
        row_new(&x, 1, zeta[i]);
        double omega = sqrt(k_Nm / (inertia + mass * arm * arm));
        x.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-8};
        x.r.scene.ntorque = 1;
        row_find(&x, 20 / omega);
        double z = zeta[i];
        between(&x, 0, 1e-8 / k_Nm * (1 + exp(-M_PI * z / sqrt(1 - z * z))), 1e-4);
        assert_near(x.peaks.still[0], 1e-8 / k_Nm, 1e-9);
        assert_near(x.peaks.ring[0], 1e-8 * x.modal.turn[0] / (omega * omega),
                    1e-6 * x.peaks.ring[0]);
        fw_arena_free(x.r.arena);
    }
}

/* a ramp of rise T: s (1 + |sin(w T/2)|/(w T/2)), its end the only late kick: s/(w T) */
static void ramp(void **state) {
    (void)state;
    for (int i = 1; i < 6; i++) {
        row x;
        row_new(&x, 1, 0);
        double omega = sqrt(k_Nm / (inertia + mass * arm * arm)), rise = 1.3 * i, s = 1e-8 / k_Nm;
        fw_quantity_law law = {
            .kind = &fw_quantity_law_ramp, .rise_s = rise / omega, .end_s = (double)INFINITY};
        x.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-8, .law = &law};
        x.r.scene.ntorque = 1;
        row_find(&x, 20 / omega);
        between(&x, 0, s * (1 + fabs(sin(0.5 * rise)) / (0.5 * rise)), 1e-4);
        assert_near(x.peaks.late[0] * fabs(x.modal.turn[0]), s / rise, 1e-4 * s);
        fw_arena_free(x.r.arena);
    }
}

/* two modes tied by one damper: q'' = f - C q' - W^2 q step by step */
static void tied(void **state) {
    (void)state;
    row x;
    row_new(&x, 2, 0.4);
    x.torque[0] = (fw_device_torque){.body = 1, .value_Nm = 1e-8};
    x.r.scene.ntorque = 1;
    double end_s = 40 * sqrt((inertia + mass * arm * arm) / k_Nm), peak[2] = {0};
    row_find(&x, end_s);
    const fw_effects_modal *o = &x.modal;
    double q[2] = {0}, v[2] = {0}, a[2], h = end_s / 400000;
    assert_int_equal(o->modes, 2);
    assert_true(fabs(o->damping[1]) > 0.1 * o->damping[0]);
    for (int n = 0; n < 400000; n++) {
        for (int j = 0; j < 2; j++)
            a[j] = x.modal_loads.item[0].mode[j] - o->omega[j] * o->omega[j] * q[j] -
                   o->damping[2 * j] * v[0] - o->damping[2 * j + 1] * v[1];
        for (int j = 0; j < 2; j++)
            v[j] += h * a[j], q[j] += h * v[j];
        for (int i = 0; i < 2; i++)
            peak[i] = fmax(peak[i], fabs(o->turn[i] * q[0] + o->turn[2 + i] * q[1]));
    }
    for (int i = 0; i < 2; i++) {
        assert_near(x.peaks.low[i], peak[i], 1e-3 * peak[i]);
        assert_near(x.peaks.high[i], peak[i], 1e-3 * peak[i]);
    }
    fw_arena_free(x.r.arena);
}

/* a force -part W^2 q that follows the motion is a stiffer spring: of one mode under a step the
   peak is 2 f/(W^2 (1 + part)); and a constant one a load */
static void follow(void *data, const double *q, const double *load, bool there, double *force) {
    const fw_effects_modal *o = data;
    (void)load, (void)there;
    for (int j = 0; j < o->modes; j++)
        force[j] = -0.1 * o->omega[j] * o->omega[j] * q[j];
}

static void like_the_load(void *data, const double *q, const double *load, bool there,
                          double *force) {
    const fw_effects_modal *o = data;
    (void)q, (void)there;
    for (int j = 0; j < o->modes; j++)
        force[j] = 0.1 * load[j];
}

static void sources(void **state) {
    (void)state;
    void (*const at[])(void *, const double *, const double *, bool, double *) = {follow,
                                                                              like_the_load};
    const double factor[] = {1 / 1.1, 1.1};
    for (int i = 0; i < 2; i++) {
        row x;
        row_new(&x, 1, 0);
        double omega = sqrt(k_Nm / (inertia + mass * arm * arm));
        x.torque[0] = (fw_device_torque){.body = 0, .value_Nm = 1e-8};
        x.r.scene.ntorque = 1;
        row_find(&x, 60 / omega);
        double late[1] = {0}, linear = 2e-8 / k_Nm;
        const fw_effects_peaks_source source = {at[i], &x.modal, late};
        assert_int_equal(fw_effects_peaks_find(x.r.arena, &x.modal, &x.modal_loads,
                                               x.modal.omega[0], NULL, &source, &x.peaks),
                         FW_OK);
        assert_near(x.peaks.low[0], linear * factor[i], 2e-3 * linear);
        assert_near(x.peaks.high[0], linear * factor[i], 2e-3 * linear);
        fw_arena_free(x.r.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(step),
        cmocka_unit_test(ramp),
        cmocka_unit_test(tied),
        cmocka_unit_test(sources),
    };
    return cmocka_run_group_tests_name("peaks", tests, NULL, NULL);
}
