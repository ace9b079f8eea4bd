/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/statics.h"
#include "statics/statics_equilibrium.h"
#include "rest_rigs.h"
#include <float.h>

static const fw_statics_modes *modes_at(fixture *f, const rig *r, bool equilibrium, int drawn) {
    const fw_statics_modes *out = NULL;
    const fw_statics_mode_options o = {.at_equilibrium = equilibrium, .drawn = drawn};
    fw_status status = fw_statics_small_motions(f->arena, &r->m, &r->scene, &o, &f->diags, &out);
    if (status != FW_OK)
        fail_msg("%s: %s", fw_status_text(status),
                 f->diags.count ? f->diags.item[f->diags.count - 1].message : "");
    return out;
}

/* independent reference, 34-digit arithmetic with the exact tangent: omega and damped eigenvalue,
   1/ms; also with a hinge that is written twice */
static void six_bar_reference(void **state) {
    (void)state;
    static const double value[2][3][3] = {
        {{3.20948244008156315, -0.0204533271652472767, 3.20941905683972815},
         {10.8921843666153928, -0.232686531273247363, 10.8897838997340557},
         {21.6312405147640869, -0.795976084627911108, 21.6164091853811138}},
        {{3.11975510335430441, -0.0204788855194180835, 3.11968965333070031},
         {10.5901497014204704, -0.231654262336109059, 10.5877585161423649},
         {21.8596448005621405, -0.79212668334459096, 21.8449807504278065}}};
    for (int kind = 0; kind < 4; kind++) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, kind & 1);
        const fw_statics_modes *m = modes_at(&f, &r, kind & 2, 0);
        assert_int_equal(m->count, 3);
        assert_int_equal(m->rank.rank, 12);
        assert_int_equal(f.diags.count, 0);
        assert_near(m->out_of_rest, 0, 1e-14);
        for (int k = 0; k < 3; k++) {
            const fw_statics_mode *mode = &m->mode[k];
            const double *want = value[kind / 2][k];
            assert_int_equal(mode->kind, FW_MODE_OSCILLATION);
            assert_relative(mode->omega_rad_per_s / 1e3, want[0], 2e-13);
            assert_relative(mode->f_Hz, mode->omega_rad_per_s / (2 * acos(-1.0)), 1e-15);
            assert_relative(mode->eigenvalue_per_s[0][0] / 1e3, want[1], 1e-12);
            assert_relative(mode->eigenvalue_per_s[0][1] / 1e3, want[2], 2e-13);
            assert_near(mode->eigenvalue_per_s[1][1], -mode->eigenvalue_per_s[0][1], 0);
            assert_relative(mode->damping_ratio, -want[1] / hypot(want[1], want[2]), 1e-12);
        }
        fw_arena_free(f.arena);
    }
}

/* a spectrum of a thousand unknowns takes half a minute: it looks by itself whether it should stop */
static void a_spectrum_stops(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    double *q = fw_arena_array(f.arena, double, 3 * (size_t)r.m.nbody);
    for (int b = 0; b < r.m.nbody; b++)
        q[3 * b] = r.m.body[b].x_m, q[3 * b + 1] = r.m.body[b].y_m,
              q[3 * b + 2] = r.m.body[b].phi_rad;
    const fw_multibody_model *m;
    fw_statics_reduced reduced;
    fw_cancel cancel = {0};
    fw_arena_stop_with(f.arena, &cancel);
    assert_int_equal(fw_multibody_model_new(f.arena, &r.m, NULL, q, 1, NULL, &m), FW_OK);
    assert_int_equal(fw_statics_reduced_new(f.arena, m, false, &reduced), FW_OK);
    const size_t n = (size_t)reduced.n;
    double *stiffness = fw_arena_array(f.arena, double, n *n);
    reduced.dof = reduced.n; /* nothing is held: of bodies without joints */
    for (size_t i = 0; i < n; i++)
        reduced.right[i * n + i] = stiffness[i * n + i] = 1;
    assert_int_equal(fw_statics_reduced_spectrum(&reduced, stiffness), FW_OK);
    fw_cancel_request(&cancel, 2);
    assert_int_equal(fw_statics_reduced_spectrum(&reduced, stiffness), FW_CANCELLED);
    fw_arena_free(f.arena);
}

/* shapes are what they are said to be: largest part 1, allowed by the joints, modal mass and
   stiffness as the bodies and springs have them */
static void shapes_of_the_six_bar(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_six_bar(f.arena, false);
    const fw_statics_modes *m = modes_at(&f, &r, false, 3);
    for (int k = 0; k < 3; k++) {
        const fw_statics_mode *mode = &m->mode[k];
        double mass = 0, stiff = 0, most = 0;
        for (int b = 0; b < 5; b++) {
            const double *s = mode->shape + 3 * b;
            mass += r.m.body[b].mass_kg * (s[0] * s[0] + s[1] * s[1]) +
                    r.m.body[b].inertia_kg_m2 * s[2] * s[2];
            most = fmax(most, fmax(fabs(s[2]), hypot(s[0], s[1]) / m->unit_length_m));
        }
        for (int i = 0; i < r.m.npin; i++) {
            const fw_mechanism_pin *p = &r.m.pin[i];
            double turn = 0, open[2] = {0};
            for (int side = 0; side < 2; side++) {
                int b = side ? p->body_b : p->body_a;
                if (b == FW_GROUND) continue;
                double sign = side ? 1 : -1, x = side ? p->bx_m : p->ax_m,
                       y = side ? p->by_m : p->ay_m;
                const double *s = mode->shape + 3 * b;
                turn += sign * s[2];
                open[0] += sign * (s[0] - s[2] * y), open[1] += sign * (s[1] + s[2] * x);
            }
            assert_near(open[0] / m->unit_length_m, 0, 1e-14);
            assert_near(open[1] / m->unit_length_m, 0, 1e-14);
            stiff += p->stiffness_Nm_per_rad * turn * turn;
        }
        assert_near(most, 1, 1e-14);
        assert_relative(mode->modal_mass_kg_m2, mass, 1e-13);
        assert_relative(mode->stiffness_per_s2, stiff / mass, 1e-13);
        /* lightly damped: the complex shape is nearly the real one */
        const double *re = mode->damped, *im = re + 15;
        double sign = 0;
        for (int i = 0; i < 15; i++)
            sign += re[i] * mode->shape[i] > 0 ? 1 : -1;
        for (int i = 0; i < 15; i++) {
            double unit = i % 3 == 2 ? 1 : m->unit_length_m;
            assert_near(re[i] / unit, (sign > 0 ? 1 : -1) * mode->shape[i] / unit, 0.05);
            assert_near(im[i] / unit, 0, 0.05);
        }
        /* frames start and end at rest and go out to both sides */
        const double *frame = mode->frame;
        assert_non_null(frame);
        for (int i = 0; i < 15; i++) {
            double unit = i % 3 == 2 ? 1 : 1e-3;
            assert_near(frame[i] / unit, m->q[i] / unit, 1e-13);
            assert_near(frame[15 * 24 + i] / unit, m->q[i] / unit, 1e-13);
        }
        for (int i = 0; i < FW_MODE_FRAMES; i++) /* closed at B */
            for (int c = 0; c < 2; c++) {
                const double *q = frame + 15 * i, *l[2] = {&r.m.pin[1].ax_m, &r.m.pin[1].bx_m};
                double at[2];
                for (int s = 0; s < 2; s++) {
                    double co = cos(q[3 * s + 2]), si = sin(q[3 * s + 2]);
                    at[s] = q[3 * s + c] +
                            (c ? si * l[s][0] + co * l[s][1] : co * l[s][0] - si * l[s][1]);
                }
                assert_near(at[0], at[1], 1e-15);
            }
    }
    assert_string_equal(fw_statics_mode_kind_text(m->mode[0].kind), "oscillation");
    fw_arena_free(f.arena);
}

/* swinging, standing with a spring, standing without: omega^2 = (k - m g l) / (J + m l^2) */
static void pendulum_up_and_down(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 1, 0);
        double m = 0.6, l = 0.8, j = 0.05, g = 9.81, k = (kind & 1) * 9.0, up = kind & 2 ? 1 : -1;
        rig_body(&r, "bob", m, j, 0, up * l, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, k, 0);
        r.scene.gravity = true;
        r.scene.gy_m_per_s2 = -g;
        r.scene.duration_s = 1;
        const fw_statics_modes *out = modes_at(&f, &r, false, 1);
        const fw_statics_mode *mode = &out->mode[0];
        double stiff = (k - up * m * g * l) / (j + m * l * l);
        assert_relative(mode->stiffness_per_s2, stiff, 1e-13);
        assert_int_equal(mode->kind, stiff > 0 ? FW_MODE_OSCILLATION : FW_MODE_UNSTABLE);
        assert_relative(mode->eigenvalue_per_s[0][stiff > 0], sqrt(fabs(stiff)), 1e-13);
        assert_near(mode->omega_rad_per_s, stiff > 0 ? sqrt(stiff) : 0, 1e-12);
        assert_int_equal(said(&f, 113), stiff < 0);
        if (kind == 2) { /* nothing holds it up: it comes to rest below */
            const fw_statics_modes *down = modes_at(&f, &r, true, 0);
            assert_relative(down->mode[0].stiffness_per_s2, m * g * l / (j + m * l * l), 1e-12);
            assert_near(fabs(down->q[2]), acos(-1.0), 1e-12);
        }
        fw_arena_free(f.arena);
    }
}

/* m x'' + c x' + k x = 0 with every damping, from none over critical to ten thousand times that */
static void damping_of_one_wheel(void **state) {
    (void)state;
    static const double ratio[] = {0, 1e-9, 1e-3, 0.5, 0.99, 1.01, 3, 1e2, 1e4};
    for (size_t i = 0; i < sizeof ratio / sizeof ratio[0]; i++) {
        fixture f = begin();
        rig r = rig_new(f.arena, 1, 1, 0);
        double j = 2e-9, k = 5e-6, omega = sqrt(k / j), z = ratio[i];
        rig_body(&r, "wheel", 1e-6, j, 0, 0, 0);
        rig_pin(&r, "axle", FW_GROUND, 0, 0, 0, k, 2 * z * j * omega);
        r.scene.duration_s = 1;
        const fw_statics_mode *mode = &modes_at(&f, &r, false, 0)->mode[0];
        assert_relative(mode->omega_rad_per_s, omega, 1e-14);
        if (z < 1) {
            assert_int_equal(mode->kind, FW_MODE_OSCILLATION);
            assert_near(mode->eigenvalue_per_s[0][0] / omega, -z, 1e-15 + 1e-13 * z);
            assert_relative(mode->eigenvalue_per_s[0][1] / omega, sqrt(1 - z * z), 1e-13);
        } else {
            double slow = -1 / (z + sqrt(z * z - 1)), fast = -(z + sqrt(z * z - 1));
            assert_int_equal(mode->kind, FW_MODE_OVERDAMPED);
            assert_relative(mode->eigenvalue_per_s[0][0] / omega, slow, 1e-12);
            assert_relative(mode->eigenvalue_per_s[1][0] / omega, fast, 1e-12);
        }
        assert_near(mode->damping_ratio, z, 1e-12 * (1 + z));
        fw_arena_free(f.arena);
    }
}

/* two bars in a row, the second lighter by up to 1e12, or the second spring stiffer: both
   frequencies keep their digits (det (K - x M) = a x^2 - b x + c), except what a stiff spring
   takes: the lower one is a difference of terms that are larger by the ratio of the springs */
static void light_links_and_stiff_springs(void **state) {
    (void)state;
    for (int kind = 0; kind < 14; kind++) {
        fixture f = begin();
        double light = kind < 7 ? pow(10, -2 * kind) : 1, stiff = kind < 7 ? 1 : pow(10, kind - 6);
        double m1 = 1e-8, j1 = 3e-16, m2 = light * 1e-8, j2 = light * 2e-16, l = 1e-3, k1 = 1e-6,
               k2 = 2e-6 * stiff;
        rig r = rig_new(f.arena, 2, 2, 0);
        rig_body(&r, "first", m1, j1, l / 2, 0, 0);
        rig_body(&r, "second", m2, j2, 1.5 * l, 0, 0);
        rig_pin(&r, "O", FW_GROUND, 0, 0, 0, k1, 0);
        rig_pin(&r, "P", 0, 1, l, 0, k2, 0);
        r.scene.duration_s = 1;
        double m11 = j1 + m1 * l * l / 4 + m2 * l * l, m12 = m2 * l * l / 2,
               m22 = j2 + m2 * l * l / 4;
        double a = m11 * m22 - m12 * m12, b = (k1 + k2) * m22 + k2 * m11 + 2 * k2 * m12,
               c = k1 * k2;
        double root = b + sqrt(b * b - 4 * a * c);
        const fw_statics_modes *m = modes_at(&f, &r, false, 0);
        assert_int_equal(m->count, 2);
        assert_relative(m->mode[0].stiffness_per_s2, 2 * c / root, 1e-13 + 4e-16 * stiff);
        assert_relative(m->mode[1].stiffness_per_s2, root / (2 * a), 1e-12);
        fw_arena_free(f.arena);
    }
}

static void free_motions_are_named(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 3, 2, 0);
    rig_body(&r, "held", 1, 1, 1, 0, 0);
    rig_body(&r, "crank", 1, 1, 4, 0, 0);
    rig_body(&r, "puck", 1, 1, 9, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 5, 0);
    rig_pin(&r, "P", FW_GROUND, 1, 3, 0, 0, 0.7);
    r.scene.duration_s = 1;
    const fw_statics_modes *m = modes_at(&f, &r, false, 0);
    assert_int_equal(m->count, 5);
    int cranks = 0, pucks = 0;
    for (int k = 0; k < 4; k++) {
        const fw_statics_mode *mode = &m->mode[k];
        assert_int_equal(mode->kind, FW_MODE_FREE);
        assert_near(mode->f_Hz, 0, 0);
        assert_near(mode->eigenvalue_per_s[0][0], 0, 0);
        if (strcmp(mode->bodies, "crank") == 0) {
            cranks++; /* J + m l^2 = 2 */
            assert_relative(mode->eigenvalue_per_s[1][0], -0.7 / 2, 1e-13);
        }
        pucks += strcmp(mode->bodies, "puck") == 0;
    }
    assert_int_equal(cranks, 1);
    assert_int_equal(pucks, 3);
    assert_string_equal(m->mode[4].bodies, "held");
    assert_relative(m->mode[4].omega_rad_per_s, sqrt(5.0 / 2), 1e-13);
    assert_true(said(&f, 113));
    fw_arena_free(f.arena);
}

/* motions of frequency 0 of bodies that know nothing of each other stay apart, whatever they weigh
 */
static void free_motions_stay_apart(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 2, 2, 0);
    rig_body(&r, "heavy", 1, 1, 1, 0, 0);
    rig_body(&r, "light", 1e-9, 1e-15, 1e-3, 5, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", FW_GROUND, 1, 0, 5, 0, 0);
    r.scene.gravity = true; /* both level: no stiffness */
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 1;
    const fw_statics_modes *m = modes_at(&f, &r, false, 0);
    assert_int_equal(m->count, 2);
    int heavy = strcmp(m->mode[0].bodies, "heavy") == 0 ? 0 : 1;
    assert_string_equal(m->mode[heavy].bodies, "heavy");
    assert_string_equal(m->mode[1 - heavy].bodies, "light");
    /* round-off goes with the root of the ratio of the inertias */
    assert_near(m->mode[heavy].shape[5], 0, 8 * DBL_EPSILON * sqrt(2 / 2e-15));
    assert_near(m->mode[1 - heavy].shape[2], 0, 1e-12);
    const fw_statics *s;
    const fw_statics_static_options o = {.path = false};
    r.scene.gravity = false;
    assert_int_equal(fw_statics_solve(f.arena, &r.m, &r.scene, &o, &f.diags, &s), FW_OK);
    assert_non_null(strstr(s->loose, "heavy"));
    assert_non_null(strstr(s->loose, "light"));
    fw_arena_free(f.arena);
}

/* a spring without length whose ends coincide holds in both directions: k / m = 100, and as a beam
   of 0.8 m about a pin with J + m r^2 = 1.25: k 0.64 / 1.25; damped by c / (2 sqrt(k m)) */
static void spring_without_length(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_new(f.arena, 1, 1, 1);
    rig_body(&r, "plate", 1, 1, 0, 0, 0);
    rig_spring(&r, "spring", FW_GROUND, 0, 0, 0, 0, 0, 100, 0)->damping_Ns_per_m = 0.4;
    r.scene.duration_s = 1;
    for (int at = 0; at < 2; at++) {
        const fw_statics_modes *m = modes_at(&f, &r, at, 0);
        assert_int_equal(m->count, 3);
        assert_int_equal(m->mode[0].kind, FW_MODE_FREE); /* it turns about that point */
        for (int k = 1; k < 3; k++) {
            assert_relative(m->mode[k].omega_rad_per_s, 10, 1e-14);
            assert_relative(m->mode[k].damping_ratio, 0.02, 1e-13);
        }
    }
    fixture g = begin();
    r = rig_new(g.arena, 1, 1, 1);
    rig_body(&r, "beam", 1, 1, 0.3, 0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0.8, 0, 0, 0);
    rig_spring(&r, "spring", FW_GROUND, 0, 0, 0, -0.3, 0, 100, 0);
    r.scene.duration_s = 1;
    const fw_statics_modes *m = modes_at(&g, &r, false, 0);
    assert_relative(m->mode[0].omega_rad_per_s, sqrt(100 * 0.64 / 1.25), 1e-13);
    const fw_statics *s;
    const fw_statics_static_options o = {.path = false};
    assert_int_equal(fw_statics_solve(g.arena, &r.m, &r.scene, &o, &g.diags, &s), FW_OK);
    assert_int_equal(s->negative + s->neutral, 0);
    assert_relative(s->eigenvalue_per_s2[0], 51.2, 1e-13);
    fw_arena_free(f.arena);
    fw_arena_free(g.arena);
}

/* a pose that a bent spring pulls away is no place of rest, and that is said */
static void out_of_rest_is_said(void **state) {
    (void)state;
    fixture f = begin();
    rig r = rig_mast(&f, 1, 2, 0.5);
    r.m.pin[0].free_angle_rad = 0.2;
    const fw_statics_modes *m = modes_at(&f, &r, false, 0);
    assert_true(said(&f, 114));
    assert_near(m->out_of_rest, 0.2, 1e-12);
    fixture g = begin();
    m = modes_at(&g, &r, true, 0);
    assert_false(said(&g, 114));
    double theta = 0.3; /* k (theta - 0.2) = P l sin theta; the mast of length 1, P at its top */
    for (int i = 0; i < 50; i++)
        theta -= (2 * (theta - 0.2) - 0.5 * sin(theta)) / (2 - 0.5 * cos(theta));
    assert_near(m->q[2], theta, 1e-13);
    double inertia = 0.3 + 2 * 0.4 * 0.4;
    assert_relative(m->mode[0].stiffness_per_s2, (2 - 0.5 * cos(theta)) / inertia, 1e-12);
    fw_arena_free(f.arena);
    fw_arena_free(g.arena);
}

/* (lambda^2 M + lambda C + K) x is orthogonal to every allowed motion, on random mechanisms; sums
   of eigenvalues are those of the matrices */
static void damped_pairs_satisfy_the_pencil(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        fixture f = begin();
        rig r = rig_any(f.arena, seed);
        uint64_t noise = seed;
        for (int i = 0; i < r.m.npin; i++) /* from light to heavy, not proportional */
            r.m.pin[i].damping_Nms_per_rad = pow(10, -12 + 3 * rig_random(&noise));
        const fw_statics_modes *m = modes_at(&f, &r, true, 0);
        fw_statics_equilibrium w;
        const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
        assert_int_equal(fw_statics_equilibrium_new(f.arena, &r.m, &r.scene, &all, FW_STATICS_DENSE, &f.diags, &w),
                         FW_OK);
        bool unstable;
        assert_int_equal(fw_statics_equilibrium_settle(&w, &unstable), FW_OK);
        int n = w.reduced.n, dof = w.reduced.dof;
        double t = w.model->scale.time_s, sum = 0, trace = 0, fastest = 0;
        double *c = fw_arena_array(f.arena, double, (size_t)(n * n));
        const fw_multibody_pose *pose = fw_multibody_pose_at(w.system, 0, w.y);
        fw_statics_tangent(w.system, pose, w.y + w.model->nq, w.lambda, w.stiffness, c);
        for (int k = 0; k < dof; k++) {
            const double *phi = w.reduced.shape + k * n;
            for (int i = 0; i < n * n; i++)
                trace += phi[i / n] * c[i] * phi[i % n];
            for (int p = 0; p < 2; p++) {
                sum += m->mode[k].eigenvalue_per_s[p][0] * t;
                fastest = fmax(fastest, t * hypot(m->mode[k].eigenvalue_per_s[p][0],
                                                  m->mode[k].eigenvalue_per_s[p][1]));
            }
        }
        assert_near(sum, -trace, 1e-12 * fastest * dof);
        for (int k = 0; k < dof; k++) {
            const double *e = m->mode[k].eigenvalue_per_s[0], *x = m->mode[k].damped;
            double a = e[0] * t, b = e[1] * t, ss = a * a - b * b, si = 2 * a * b;
            for (int l = 0; l < dof; l++) {
                double re = 0, im = 0, size = 0;
                for (int i = 0; i < n; i++) {
                    double phi = w.reduced.shape[l * n + i];
                    double mass = i % 3 == 2 ? w.model->inertia[i / 3] : w.model->mass[i / 3];
                    for (int j = 0; j < n; j++) {
                        double unit = j % 3 == 2 ? 1 : m->unit_length_m, p = x[j] / unit;
                        double q = x[n + j] / unit, kk = w.stiffness[i * n + j], cc = c[i * n + j];
                        double mm = i == j ? mass : 0;
                        double fr = mm * ss + cc * a + kk, fi = mm * si + cc * b;
                        re += phi * (fr * p - fi * q), im += phi * (fr * q + fi * p);
                        size += fabs(phi) * (hypot(fr, fi) + kk) * hypot(p, q);
                    }
                }
                assert_near(re / size, 0, 1e-11);
                assert_near(im / size, 0, 1e-11);
            }
        }
        fw_arena_free(f.arena);
    }
}

static void short_memory_is_said(void **state) {
    (void)state;
    int failures = 0;
    for (long n = 1;; n += 5) {
        fixture f = begin();
        rig r = rig_six_bar(f.arena, true);
        const fw_statics_modes *m;
        const fw_statics_mode_options o = {.at_equilibrium = true, .drawn = 3};
        fw_arena_fail_at(n, 1);
        fw_status status = fw_statics_small_motions(f.arena, &r.m, &r.scene, &o, &f.diags, &m);
        fw_arena_fail_at(0, 0);
        fw_arena_free(f.arena);
        if (status == FW_OK) break;
        assert_int_equal(status, FW_NOMEM);
        failures++;
    }
    assert_true(failures > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(six_bar_reference), cmocka_unit_test(a_spectrum_stops),
        cmocka_unit_test(shapes_of_the_six_bar),
        cmocka_unit_test(pendulum_up_and_down),
        cmocka_unit_test(damping_of_one_wheel),
        cmocka_unit_test(light_links_and_stiff_springs),
        cmocka_unit_test(free_motions_are_named),
        cmocka_unit_test(free_motions_stay_apart),
        cmocka_unit_test(spring_without_length),
        cmocka_unit_test(out_of_rest_is_said),
        cmocka_unit_test(damped_pairs_satisfy_the_pencil),
        cmocka_unit_test(short_memory_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
