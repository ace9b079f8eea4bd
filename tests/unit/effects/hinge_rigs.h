/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mechanisms of flexure hinges made by hand, and a small Newton method for their equilibria with
   nothing but the elements' own forces and tangents. SI. */
#ifndef FW_TESTS_HINGE_RIGS_H
#define FW_TESTS_HINGE_RIGS_H
#include "effects/effect.h"
#include "effects/envelope.h"
#include "maths/matrix.h"
#include "test.h"

enum { RIG_BODIES = 5, RIG_PINS = 6, RIG_N = 3 * RIG_BODIES };

typedef struct rig {
    fw_arena *arena;
    fw_diags diags;
    fw_mechanism_mass body[RIG_BODIES];
    fw_mechanism_pin pin[RIG_PINS];
    fw_mechanism_hinge hinge[RIG_PINS];
    fw_mechanism_variant variant;
    fw_mechanism m;
    fw_device_scene scene;
    fw_effects_envelope envelope;
    fw_effects_loads loads;
    fw_effect_case c;
} rig;

/* H1 of the tables: r = 100 um, 270 degrees, 8 um wide, 50 um deep, nu = 0.22; no roots */
static inline fw_flexure_hinge_law rig_h1(double E_Pa) {
    double a = 0.75 * M_PI, L = 2 * a * 100e-6, EA = E_Pa * 50e-6 * 8e-6;
    double EI = EA * 8e-6 * 8e-6 / 12;
    return (fw_flexure_hinge_law){.stiffness_Nm_per_rad = EI / L,
                                  .half_angle_rad = a,
                                  .length_m = L,
                                  .share = 1,
                                  .bend_m_per_N = L * L * L / (8 * EI),
                                  .axial_m_per_N = L / (2 * EA),
                                  .shear_m_per_N = L * 2 * (1 + 0.22) / (2 * 5.0 / 6 * EA)};
}

static inline void rig_new(rig *r, int bodies, int pins) {
    memset(r, 0, sizeof *r);
    r->arena = fw_arena_new(0);
    assert_non_null(r->arena);
    r->diags = fw_diags_new(r->arena);
    r->variant.thickness_m = 50e-6;
    r->variant.material.loss.value = 1; /* what gives is damped, wherever a test has a damper */
    r->m = (fw_mechanism){.variant = &r->variant,
                          .body = r->body,
                          .pin = r->pin,
                          .hinge = r->hinge,
                          .nbody = bodies,
                          .npin = pins,
                          .nhinge = pins};
    r->scene = (fw_device_scene){.name = "s", .duration_s = 1e-3};
    r->envelope = (fw_effects_envelope){.why_not = "not asked for"};
    r->c = (fw_effect_case){.arena = r->arena,
                            .mechanism = &r->m,
                            .scene = &r->scene,
                            .envelope = &r->envelope,
                            .diags = &r->diags};
}

static inline void rig_hinge(rig *r, int i, const char *id, int a, int b, fw_geometry_vec2 at,
                             double axis, bool first_is_a) {
    fw_geometry_vec2 pa = at, pb = at;
    if (a != FW_GROUND) pa.x -= r->body[a].x_m, pa.y -= r->body[a].y_m;
    if (b != FW_GROUND) pb.x -= r->body[b].x_m, pb.y -= r->body[b].y_m;
    r->hinge[i] = (fw_mechanism_hinge){.pin = i,
                                       .law = rig_h1(147.0790923914665e9),
                                       .axis_rad = axis,
                                       .first_is_a = first_is_a,
                                       .cover_from_rad = (double)NAN,
                                       .cover_to_rad = (double)NAN};
    r->pin[i] = (fw_mechanism_pin){.id = id,
                                   .body_a = a,
                                   .body_b = b,
                                   .ax_m = pa.x,
                                   .ay_m = pa.y,
                                   .bx_m = pb.x,
                                   .by_m = pb.y,
                                   .stiffness_Nm_per_rad = r->hinge[i].law.stiffness_Nm_per_rad,
                                   .hinge = i};
}

/* ABCDEF of the tables; mirrored: drawn as its mirror image in the y axis */
static inline void rig_six_bar(rig *r, bool mirrored) {
    static const double x[] = {-700, -1200, -400, 400, 1200, 700};
    static const double y[] = {-1000, 0, 700, 700, 0, -1000};
    static const double axis[] = {90, 0, -90, -90, 180, 90};
    static const int first[] = {FW_GROUND, 0, 1, 3, 4, FW_GROUND}, second[] = {0, 1, 2, 2, 3, 4};
    static const char *const id[] = {"A", "B", "C", "D", "E", "F"};
    double s = mirrored ? -1e-6 : 1e-6;
    rig_new(r, 5, 6);
    for (int b = 0; b < 5; b++)
        r->body[b] = (fw_mechanism_mass){.id = "link",
                                         .mass_kg = 1e-8,
                                         .inertia_kg_m2 = 1e-15,
                                         .x_m = s * 0.5 * (x[b] + x[b + 1]),
                                         .y_m = 1e-6 * 0.5 * (y[b] + y[b + 1])};
    for (int i = 0; i < 6; i++) {
        double to = axis[i] * M_PI / 180;
        fw_geometry_vec2 at = {s * x[i], 1e-6 * y[i]};
        rig_hinge(r, i, id[i], first[i], second[i], at, mirrored ? M_PI - to : to, !mirrored);
    }
}

/* what exact beams are made of: the strip of rig_h1, without the corrections of a real one */
static inline void rig_strip(fw_mechanism_hinge *h, double E_Pa) {
    double a = 0.75 * M_PI;
    h->input = (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                                  .length_m = 2 * a * 100e-6,
                                  .angle_rad = 2 * a,
                                  .radius_m = 100e-6,
                                  .width_m = 8e-6,
                                  .fillet_m = -1,
                                  .depth_m = 50e-6,
                                  .youngs_Pa = E_Pa,
                                  .poisson = 0.22};
    h->closed_form = (fw_flexure_result){.centre_m = 100e-6 * sin(a) / a,
                                         .stiffness_Nm_per_rad = rig_h1(E_Pa).stiffness_Nm_per_rad,
                                         .youngs_Pa = E_Pa,
                                         .poisson = 0.22,
                                         .concentration = 1,
                                         .fibre = 1};
}

static inline void rig_compile(rig *r) {
    assert_int_equal(fw_effects_loads_new(r->arena, &r->m, &r->scene, &r->loads), FW_OK);
    assert_int_equal(fw_effect_joint_elasticity.add(&r->c, &r->loads), FW_OK);
    assert_int_equal(fw_effect_joint_damping.add(&r->c, &r->loads), FW_OK);
    assert_true(fw_effect_nonlinear_hinge.called_for(&r->c));
    assert_int_equal(fw_effect_nonlinear_hinge.add(&r->c, &r->loads), FW_OK);
}

static inline void rig_drawn(const rig *r, double *q) {
    for (int b = 0; b < r->m.nbody; b++)
        q[3 * b] = r->body[b].x_m, q[3 * b + 1] = r->body[b].y_m, q[3 * b + 2] = r->body[b].phi_rad;
}

/* elements' forces and tangent at q; `on`: of all switches, NULL: as the state says */
static inline void rig_forces(const rig *r, const double *q, double *force, double *stiffness) {
    size_t n = 3 * (size_t)r->m.nbody;
    double p[36], w[36], f[36], k[36 * 36], d[36 * 36];
    memset(force, 0, n * sizeof *force);
    if (stiffness) memset(stiffness, 0, n * n * sizeof *stiffness);
    for (int i = 0; i < r->loads.nelement; i++) {
        const fw_effects_force_element *e = &r->loads.element[i];
        bool on[2] = {false, false};
        fw_effects_port_state s = {.load = 1, .p = p, .w = w, .on = on};
        fw_effects_element_place_ports(e, q, NULL, p, w);
        for (int j = 0; j < e->switches; j++)
            on[j] = e->class_->switch_value(e, &s, j) > 0;
        e->class_->force(e, &s, f);
        fw_effects_element_add_forces(e, q, f, force);
        if (!stiffness) continue;
        e->class_->tangent(e, &s, k, d);
        const fw_effects_matrix to = {.n = 3 * r->m.nbody, .dense = stiffness};
        fw_effects_element_spread(e, q, NULL, f, k, d, &to, NULL);
    }
}

/* equilibrium under constant forces and couples at the centres of mass, in `steps` of the load */
static inline void rig_equilibrium(const rig *r, const double *load, int steps, double *q) {
    int n = 3 * r->m.nbody;
    double force[RIG_N], stiffness[RIG_N * RIG_N], x[RIG_N];
    const double unit[3] = {1e-3, 1e-3, 1};
    for (int step = 1; step <= steps; step++)
        for (int round = 0;; round++) {
            double largest = 0;
            bool fine;
            if (round > 40) fail_msg("no equilibrium at step %d", step);
            rig_forces(r, q, force, stiffness);
            for (int i = 0; i < n; i++) { /* in units of about one */
                x[i] = (force[i] + load[i] * step / steps) * unit[i % 3] * 1e6;
                for (int j = 0; j < n; j++)
                    stiffness[i * n + j] *= unit[i % 3] * unit[j % 3] * 1e6;
            }
            assert_int_equal(fw_maths_dense_solve_symmetric(r->arena, n, stiffness, x, x, &fine),
                             FW_OK);
            assert_true(fine);
            for (int i = 0; i < n; i++)
                largest = fmax(largest, fabs(x[i]));
            double part = largest > 0.1 ? 0.1 / largest : 1;
            for (int i = 0; i < n; i++)
                q[i] += part * x[i] * unit[i % 3];
            if (largest < 1e-13) break;
        }
}

#endif
