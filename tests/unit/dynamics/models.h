/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mechanisms built by hand for the tests of this room. */
#ifndef FW_TEST_MODELS_H
#define FW_TEST_MODELS_H
#include "dynamics/dynamics.h"
#include "test.h"

typedef struct rig {
    fw_mechanism m;
    fw_device_scene scene;
} rig;

static inline rig rig_new(fw_arena *arena, int nbody, int npin, int nspring) {
    rig r = {0};
    r.m.body = fw_arena_array(arena, fw_mechanism_mass, (size_t)nbody);
    r.m.pin = fw_arena_array(arena, fw_mechanism_pin, (size_t)npin);
    r.m.spring = fw_arena_array(arena, fw_device_spring, (size_t)nspring);
    r.scene.force = fw_arena_array(arena, fw_device_force, (size_t)nbody);
    r.scene.torque = fw_arena_array(arena, fw_device_torque, (size_t)nbody);
    r.scene.initial = fw_arena_array(arena, fw_device_initial, (size_t)nbody);
    r.scene.name = "test";
    return r;
}

static inline void rig_body(rig *r, const char *id, double mass, double inertia, double x, double y,
                            double phi) {
    r->m.body[r->m.nbody++] = (fw_mechanism_mass){id, mass, inertia, x, y, phi, {0, 0}};
}

/* pin at a world point; bodies must be there already */
static inline fw_mechanism_pin *rig_pin(rig *r, const char *id, int a, int b, double x, double y,
                                        double k, double c) {
    fw_mechanism_pin *p = &r->m.pin[r->m.npin++];
    *p = (fw_mechanism_pin){.id = id,
                            .body_a = a,
                            .body_b = b,
                            .stiffness_Nm_per_rad = k,
                            .damping_Nms_per_rad = c,
                            .hinge = FW_NONE};
    double *to[2] = {&p->ax_m, &p->bx_m}, *up[2] = {&p->ay_m, &p->by_m};
    const int body[2] = {a, b};
    for (int i = 0; i < 2; i++) {
        if (body[i] == FW_GROUND) {
            *to[i] = x, *up[i] = y;
            continue;
        }
        const fw_mechanism_mass *m = &r->m.body[body[i]];
        double dx = x - m->x_m, dy = y - m->y_m, co = cos(m->phi_rad), si = sin(m->phi_rad);
        *to[i] = co * dx + si * dy, *up[i] = -si * dx + co * dy;
    }
    return p;
}

/* pin by local points, as a description states them */
static inline fw_mechanism_pin *rig_pin_local(rig *r, const char *id, int a, double ax, double ay,
                                              int b, double bx, double by) {
    fw_mechanism_pin *p = &r->m.pin[r->m.npin++];
    *p = (fw_mechanism_pin){.id = id,
                            .body_a = a,
                            .body_b = b,
                            .ax_m = ax,
                            .ay_m = ay,
                            .bx_m = bx,
                            .by_m = by,
                            .hinge = FW_NONE};
    return p;
}

static inline fw_device_spring *rig_spring(rig *r, const char *id, int a, double ax, double ay,
                                           int b, double bx, double by, double k, double length) {
    fw_device_spring *s = &r->m.spring[r->m.nspring++];
    *s = (fw_device_spring){.id = id,
                            .body_a = a,
                            .body_b = b,
                            .ax_m = ax,
                            .ay_m = ay,
                            .bx_m = bx,
                            .by_m = by,
                            .stiffness_N_per_m = k,
                            .length_m = length};
    return s;
}

static inline void rig_force(rig *r, int body, double fx, double fy) {
    r->scene.force[r->scene.nforce++] = (fw_device_force){.body = body, .fx_N = fx, .fy_N = fy};
}
static inline void rig_torque(rig *r, int body, double value) {
    r->scene.torque[r->scene.ntorque++] = (fw_device_torque){.body = body, .value_Nm = value};
}
static inline void rig_velocity(rig *r, int body, double vx, double vy, double omega) {
    r->scene.initial[r->scene.ninitial++] = (fw_device_initial){
        .body = body, .vx_m_per_s = vx, .vy_m_per_s = vy, .omega_rad_per_s = omega};
}

/* the reference six-bar ABCDEF in SI; `twice_d` adds a second hinge D (redundant) */
static inline rig rig_six_bar(fw_arena *arena, bool twice_d) {
    rig r = rig_new(arena, 5, 7, 0);
    const double mm = 1e-3, mg = 1e-6, mgmm2 = 1e-12;
    rig_body(&r, "AB", 0.0188 * mg, 0.00286 * mgmm2, 0.45 * mm, 0.775 * mm, 0);
    rig_body(&r, "BC", 0.0200 * mg, 0.00344 * mgmm2, 0.50 * mm, 2.05 * mm, 0);
    rig_body(&r, "CD", 0.0653 * mg, 0.01155 * mgmm2, 1.50 * mm, 2.875 * mm, 0);
    rig_body(&r, "DE", 0.0203 * mg, 0.00360 * mgmm2, 2.525 * mm, 2.10 * mm, 0);
    rig_body(&r, "EF", 0.0197 * mg, 0.00330 * mgmm2, 2.575 * mm, 0.80 * mm, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0.70 * mm, 0.15 * mm, 1.711e-6, 0.0070e-9);
    rig_pin(&r, "B", 0, 1, 0.20 * mm, 1.40 * mm, 1.730e-6, 0.0060e-9);
    rig_pin(&r, "C", 1, 2, 0.80 * mm, 2.70 * mm, 1.803e-6, 0.0050e-9);
    rig_pin(&r, "D", 2, 3, 2.20 * mm, 2.75 * mm, 1.502e-6, 0.0055e-9);
    rig_pin(&r, "E", 3, 4, 2.85 * mm, 1.45 * mm, 1.467e-6, 0.0065e-9);
    rig_pin(&r, "F", 4, FW_GROUND, 2.30 * mm, 0.15 * mm, 1.760e-6, 0.0075e-9);
    if (twice_d) rig_pin(&r, "D2", 2, 3, 2.20 * mm, 2.75 * mm, 0, 0);
    rig_force(&r, 2, 0.35e-3, -0.20e-3);
    rig_torque(&r, 0, -0.15e-6);
    r.scene.duration_s = 10e-3;
    return r;
}

/* A01: point pendulum as a body with a tiny inertia would be stiff to state; the arm carries J = 0
   in the source, here mass 1 at distance 1 with inertia J and length chosen so that J + m l^2 = m l
   L */
static inline rig rig_pendulum(fw_arena *arena) {
    rig r = rig_new(arena, 1, 1, 0);
    const double j = 0.25, l = 0.5; /* j + l^2 = l * 1 for m = 1: same equation as the point mass */
    rig_body(&r, "bob", 1, j, -l, 0, 0);
    rig_pin_local(&r, "O", FW_GROUND, 0, 0, 0, l, 0);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 10;
    return r;
}

/* A02: N four-bar windows; bodies 0..N cranks, N+1..2N couplers */
static inline rig rig_windows(fw_arena *arena, int n) {
    rig r = rig_new(arena, 2 * n + 1, 3 * n + 1, 0);
    for (int i = 0; i <= n; i++) {
        rig_body(&r, "crank", 1, 1.0 / 12, i, 0.5, 0);
        rig_velocity(&r, i, 0.5, 0, -1);
    }
    for (int i = 1; i <= n; i++) {
        rig_body(&r, "coupler", 1, 1.0 / 12, i - 0.5, 1, 0);
        rig_velocity(&r, n + i, 1, 0, 0);
    }
    for (int i = 0; i <= n; i++)
        rig_pin(&r, "base", FW_GROUND, i, i, 0, 0, 0);
    for (int i = 1; i <= n; i++) {
        rig_pin(&r, "left", i - 1, n + i, i - 1, 1, 0, 0);
        rig_pin(&r, "right", n + i, i, i, 1, 0, 0);
    }
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 10;
    return r;
}

/* A03: Andrews' squeezer in reference-point form */
static inline rig rig_squeezer(fw_arena *arena) {
    rig r = rig_new(arena, 7, 10, 1);
    rig_body(&r, "K1", .04325, 2.194e-6, 9.18248598030761435996e-04, -5.67407456290548322244e-05,
             -6.17138900142764496359e-02);
    rig_body(&r, "K2", .00365, 4.410e-7, -4.49143335993307224128e-03, 2.77536255794289940228e-04,
             -6.17138900142764496359e-02);
    rig_body(&r, "K3", .02373, 5.255e-6, -1.87421866703154576219e-02, 2.04851067890739304766e-02,
             4.55279819163070380256e-01);
    rig_body(&r, "K4", .00706, 5.667e-7, -3.02229398301588874216e-02, 1.20711823566639393233e-02,
             7.10033369709728434900e-01);
    rig_body(&r, "K5", .07050, 1.169e-5, -5.32368281557041386557e-02, 1.66318479666163072100e-02,
             4.87364979543842550226e-01);
    rig_body(&r, "K6", .00706, 5.667e-7, -2.85432685367836040722e-02, -1.07222547072522878576e-02,
             1.00787905438393530782e+00);
    rig_body(&r, "K7", .05498, 1.912e-5, -5.62655817857573480277e-02, -2.13550702962614190007e-03,
             1.23054744454982119250e+00);
    rig_pin_local(&r, "O", FW_GROUND, 0, 0, 0, -.00092, 0);
    rig_pin_local(&r, "F", 0, .00608, 0, 1, .0115, 0);
    rig_pin_local(&r, "E3", 1, -.0165, 0, 2, -.01043, -.01626);
    rig_pin_local(&r, "E4", 1, -.0165, 0, 3, 0, -.01421);
    rig_pin_local(&r, "E6", 1, -.0165, 0, 5, .01421, 0);
    rig_pin_local(&r, "B", FW_GROUND, -.03635, .03273, 2, -.01043, .01874);
    rig_pin_local(&r, "G", 3, 0, .00579, 4, .01692, -.00916);
    rig_pin_local(&r, "A5", FW_GROUND, -.06934, -.00227, 4, -.02308, -.00916);
    rig_pin_local(&r, "H", 5, -.00579, 0, 6, -.00449, -.02772);
    rig_pin_local(&r, "A7", FW_GROUND, -.06934, -.00227, 6, -.00449, .01228);
    r.m.spring[r.m.nspring++] = (fw_device_spring){.id = "CD",
                                                   .body_a = FW_GROUND,
                                                   .body_b = 2,
                                                   .ax_m = .014,
                                                   .ay_m = .072,
                                                   .bx_m = .00957,
                                                   .by_m = .00074,
                                                   .stiffness_N_per_m = 4530,
                                                   .length_m = .07785};
    rig_torque(&r, 0, .033);
    r.scene.duration_s = 0.03;
    return r;
}

/* repeatable random numbers in [0, 1): splitmix64 */
static inline double rig_random(uint64_t *seed) {
    uint64_t z = (*seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* a random mechanism: a chain of 2 to 7 bodies in a row that starts at the ground, sometimes closed
   to the ground, sometimes with a branch; springs at every pin, loads on some bodies; 1 mm sizes */
static inline rig rig_any(fw_arena *arena, uint64_t seed) {
    int n = 2 + (int)(6 * rig_random(&seed));
    rig r = rig_new(arena, n + 1, n + 3, 0);
    bool closed = n >= 3 && rig_random(&seed) < 0.6;
    double x = 0, y = 0, angle = 1.2 * rig_random(&seed);
    for (int i = 0; i < n; i++) {
        double l = 1e-3 * (0.5 + rig_random(&seed)), m = 1e-8 * (0.5 + 2 * rig_random(&seed));
        double dx = l * cos(angle), dy = l * sin(angle);
        rig_body(&r, "link", m, m * l * l * (0.06 + 0.1 * rig_random(&seed)), x + dx / 2,
                 y + dy / 2, 0.5 * rig_random(&seed));
        double k = 1e-6 * (0.3 + 3 * rig_random(&seed)), c = 1e-11 * rig_random(&seed);
        rig_pin(&r, "pin", i - 1, i, x, y, k, c); /* body -1 is the ground */
        x += dx, y += dy;
        angle -= 2.0 * rig_random(&seed) * (closed ? 1 : 0.5);
        if (rig_random(&seed) < 0.5)
            rig_force(&r, i, 3e-4 * (rig_random(&seed) - 0.5), 3e-4 * (rig_random(&seed) - 0.5));
    }
    rig_torque(&r, n - 1, 2e-7 * (rig_random(&seed) - 0.5));
    if (closed) rig_pin(&r, "end", n - 1, FW_GROUND, x, y, 1e-6, 0);
    if (rig_random(&seed) < 0.4) {
        int at = n / 2;
        rig_body(&r, "branch", 1e-8, 2e-15, r.m.body[at].x_m + 3e-4, r.m.body[at].y_m + 5e-4, 0.3);
        rig_pin(&r, "side", at, n, r.m.body[at].x_m, r.m.body[at].y_m, 8e-7, 1e-12);
    }
    r.scene.duration_s = 1e-3 * (1 + 9 * rig_random(&seed));
    return r;
}

#endif
