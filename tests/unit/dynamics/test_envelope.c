/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The envelope of a scene: modes against closed forms, upper and lower bounds against runs, and
   answers to further forces and to changes of stiffness against runs that have them. */
#include "bounds.h"
#include "effects/envelope.h"

static const double pi = 3.14159265358979323846;

static void find(fw_arena *arena, const rig *r, fw_effects_envelope *e) {
    assert_int_equal(fw_effects_envelope_find(arena, &r->m, &r->scene, e), FW_OK);
}

/* a bar pinned at one end: omega^2 = k/J, J about the pin; J shape_phi^2 = 1 */
static rig lever(fw_arena *arena, double k, double c, double torque) {
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "lever", 2e-8, 3e-15, 1e-3, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, k, c);
    rig_torque(&r, 0, torque);
    r.scene.duration_s = 1e-3;
    return r;
}

static void one_mode(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double k = 1e-6, j = 3e-15 + 2e-8 * 1e-6, torque = 2e-9;
    rig r = lever(arena, k, 0, torque);
    fw_effects_envelope e;
    find(arena, &r, &e);
    assert_true(e.valid && e.modes == 1 && e.n == 3);
    double omega = sqrt(k / j);
    assert_near(e.omega[0], omega, 1e-9 * omega);
    assert_near(fabs(e.turn[0]), 1 / sqrt(j), 1e-9 / sqrt(j));
    assert_near(e.amplitude[0] * fabs(e.turn[0]), 2 * torque / k, 1e-9 * torque / k);
    assert_true(e.angle[0] >= 2 * torque / k && e.angle[0] < 2.2 * torque / k);
    assert_true(e.rate[0] >= omega * torque / k && e.rate[0] < 1.1 * omega * torque / k);
    assert_true(e.floor <= 2 * torque / k && e.floor > 1.9 * torque / k);
    assert_true(e.reach[1] >= 2e-3 * torque / k && e.speed[1] >= 1e-3 * omega * torque / k);
    /* the pin accelerates the centre of mass: m l theta'' up to m l omega^2 T/k, and T makes no
       force of its own */
    double force = 2e-8 * 1e-3 * omega * omega * torque / k;
    assert_true(e.force[0] >= force && e.force[0] < 1.2 * 2 * force + 1e-15);
    /* one more torque of a tenth, for good or with the motion */
    const fw_effect_case c = {arena, &r.m, &r.scene, &e, NULL, NULL};
    const double more[3] = {0, 0, 0.1 * torque};
    double answer = fw_effects_envelope_answer(&c, more, 1);
    assert_true(answer >= 0.1 && answer < 0.12);
    double swinging = fw_effects_envelope_answer(&c, more, (double)INFINITY);
    /* in step with it: int |sin w t|, of two whole arches and a part of the third */
    double arches = omega * 1e-3 - 2 * pi;
    assert_true(arches > 0 && arches < pi);
    assert_near(swinging / answer, (5 - cos(arches)) / 2, 1e-9 * swinging / answer);
    fw_arena_free(arena);
}

/* half a swing only: the deflection is (1 - cos w T) of the static one at the end */
static void short_scene(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = lever(arena, 1e-6, 0, 2e-9);
    fw_effects_envelope e;
    for (double share = 0.05; share < 1; share += 0.1) {
        r.scene.duration_s = share * pi / sqrt(1e-6 / (3e-15 + 2e-8 * 1e-6));
        find(arena, &r, &e);
        double peak = (1 - cos(share * pi)) * 2e-3;
        assert_true(e.valid);
        assert_true(e.floor <= peak * (1 + 1e-9) && e.floor > 0.9 * peak);
        assert_true(e.angle[0] >= peak);
    }
    fw_arena_free(arena);
}

/* two bars with springs in line, by hand: (K - w^2 M) has the determinant of two quadratics */
static void two_modes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 2, 2, 0);
    const double l = 1, m = 2, jc = 0.3;
    rig_body(&r, "a", m, jc, l / 2, 0, 0);
    rig_body(&r, "b", m, jc, 1.5 * l, 0, 0);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 10, 0);
    rig_pin(&r, "B", 0, 1, l, 0, 4, 0);
    rig_torque(&r, 1, 0.1);
    r.scene.duration_s = 5;
    fw_effects_envelope e;
    find(arena, &r, &e);
    assert_true(e.valid && e.modes == 2);
    /* in the bodies' turns: M = [jc + m l^2/4 + m l^2, m l^2/2; ., jc + m l^2/4] */
    double m11 = jc + m / 4 + m, m12 = m / 2, m22 = jc + m / 4, k11 = 14, k12 = -4, k22 = 4;
    for (int j = 0; j < 2; j++) {
        double w = e.omega[j] * e.omega[j];
        double det = (k11 - w * m11) * (k22 - w * m22) - (k12 - w * m12) * (k12 - w * m12);
        assert_near(det, 0, 1e-10 * k11 * k22);
        const double *s = e.shape + 6 * j;
        assert_near(m11 * s[2] * s[2] + 2 * m12 * s[2] * s[5] + m22 * s[5] * s[5], 1, 1e-10);
        assert_near(s[4], l * s[2] + l / 2 * s[5], 1e-10); /* joints hold */
        assert_near(e.turn[2 * j + 1], s[5] - s[2], 1e-12);
    }
    assert_true(e.omega[0] < e.omega[1]);
    fw_arena_free(arena);
}

static void where_it_says_nothing(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *const why[] = {"freely", "elastic", "repeat", "drivers", "too far"};
    for (int i = 0; i < 5; i++) {
        rig r = i == 2 ? rig_six_bar(arena, true) : lever(arena, i == 1 ? 0 : 1e-6, 0, 2e-9);
        if (i == 0) {
            r = bounds_row(arena, &(uint64_t){3}, 3, false);
            r.m.pin[1].stiffness_Nm_per_rad = 0;
            rig_torque(&r, 0, 1e-9);
            r.scene.duration_s = 1e-3;
        }
        fw_device_driver driver = {.revolute = 0, .joint = FW_NONE};
        if (i == 3) r.m.driver = &driver, r.m.ndriver = 1;
        if (i == 4) r.scene.torque[0].value_Nm = 1e-6;
        fw_effects_envelope e;
        find(arena, &r, &e);
        assert_false(e.valid);
        assert_non_null(e.why_not);
        if (!strstr(e.why_not, why[i])) fail_msg("%s: %s", why[i], e.why_not);
        const fw_effect_case c = {arena, &r.m, &r.scene, &e, NULL, NULL};
        assert_true(isinf(fw_effects_envelope_answer(&c, NULL, 1)));
        assert_true(isinf(fw_effects_envelope_stiffness(&c, 1e-9)));
    }
    fw_arena_free(arena);
}

/* ---- against runs ---- */

typedef struct seen { /* largest over a run */
    const fw_mechanism *m;
    double reach[60], angle[40], force[40];
} seen;

static void see(void *context, const fw_dynamics_instant *at) {
    seen *s = context;
    if (!at) return;
    for (int b = 0; b < s->m->nbody; b++) {
        const double q0[3] = {s->m->body[b].x_m, s->m->body[b].y_m, s->m->body[b].phi_rad};
        for (int k = 0; k < 3; k++)
            s->reach[3 * b + k] = fmax(s->reach[3 * b + k], fabs(at->q[3 * b + k] - q0[k]));
    }
    for (int i = 0; i < s->m->npin; i++) {
        s->angle[i] = fmax(s->angle[i], fabs(at->angle_rad[i]));
        s->force[i] = fmax(s->force[i], hypot(at->reaction_N[2 * i], at->reaction_N[2 * i + 1]));
    }
}

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r, seen *s, double *rate) {
    enum { SAMPLES = 400 };
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m = NULL;
    const fw_dynamics_motion_options o = {.rtol = 1e-9,
                                          .samples = SAMPLES,
                                          .effects = {.mode = FW_EFFECTS_ALL},
                                          .observe = s ? see : NULL,
                                          .context = s};
    assert_int_equal(fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &m), FW_OK);
    for (int k = 0; rate && k < SAMPLES; k++)
        for (int i = 0; i < r->m.npin; i++) {
            int a = r->m.pin[i].body_a, b = r->m.pin[i].body_b;
            const double *v = m->v + (size_t)k * 3 * (size_t)r->m.nbody;
            double w = (b == FW_GROUND ? 0 : v[3 * b + 2]) - (a == FW_GROUND ? 0 : v[3 * a + 2]);
            rate[i] = fmax(rate[i], fabs(w));
        }
    return m;
}

static bool all_at_least(const char *what, uint64_t seed, const double *bound, const double *value,
                         int count) {
    for (int i = 0; i < count; i++)
        if (value[i] > bound[i] * (1 + 1e-6) + 1e-12 * (what[0] == 'a' || i % 3 == 2)) {
            print_error("seed %llu: %s %d is %.6g, its bound %.6g\n", (unsigned long long)seed,
                        what, i, value[i], bound[i]);
            return false;
        }
    return true;
}

/* no run leaves the envelope, and none stays below its floor */
static void holds_every_run(void **state) {
    (void)state;
    int valid = 0, bad = 0;
    double loosest = 0, tightest = 0;
    int count = test_cases(300, 40);
    for (uint64_t seed = 500; seed < 500 + (uint64_t)count; seed++) {
        fw_arena *arena = fw_arena_new(0);
        bounds_device d;
        fw_effects_envelope e;
        if (bounds_make(arena, seed, &d)) {
            for (int i = 0; i < d.r.m.npin; i++)
                d.r.m.pin[i].stop_stiffness_Nm_per_rad = 0;
            d.r.scene.ncontact = d.r.scene.nfriction = 0; /* the envelope does not take them in */
            find(arena, &d.r, &e);
            if (e.valid) {
                seen s = {.m = &d.r.m};
                double rate[40] = {0}, peak = 0;
                const fw_dynamics_motion *m = run(arena, &d.r, &s, rate);
                for (int i = 0; i < m->npin; i++)
                    peak = fmax(peak, fabs(m->peak[i].angle_rad));
                valid++;
                bad += !all_at_least("angle", seed, e.angle, s.angle, e.npin);
                bad += !all_at_least("reach", seed, e.reach, s.reach, e.n);
                bad += !all_at_least("rate", seed, e.rate, rate, e.npin);
                bad += !all_at_least("force", seed, e.force, s.force, e.npin);
                bad += !all_at_least("floor", seed, &peak, &e.floor, 1);
                bad += !all_at_least("most", seed, &e.most, &peak, 1);
                loosest = fmax(loosest, e.most / peak);
                tightest = fmax(tightest, peak / e.floor);
            }
        }
        fw_arena_free(arena);
    }
    print_message("%d envelopes; most / peak up to %.3g, peak / floor up to %.3g\n", valid, loosest,
                  tightest);
    assert_true(valid > count / 2);
    assert_int_equal(bad, 0);
}

/* every spring stiffer by the same part, and every one by a random part up to it */
static void stiffness_changes(void **state) {
    (void)state;
    int valid = 0, bad = 0;
    int count = test_cases(200, 30);
    for (uint64_t seed = 2000; seed < 2000 + (uint64_t)count; seed++) {
        fw_arena *arena = fw_arena_new(0);
        bounds_device d;
        fw_effects_envelope e;
        uint64_t more = seed;
        if (bounds_make(arena, seed, &d)) {
            for (int i = 0; i < d.r.m.npin; i++)
                d.r.m.pin[i].stop_stiffness_Nm_per_rad = 0;
            d.r.scene.ncontact = d.r.scene.nfriction = 0; /* the envelope does not take them in */
            find(arena, &d.r, &e);
            if (e.valid) {
                double part = bounds_log(&more, 1e-6, 0.1), unknown;
                bool same = rig_random(&more) < 0.5;
                const fw_effect_case c = {arena, &d.r.m, &d.r.scene, &e, NULL, NULL};
                double bound = fw_effects_envelope_stiffness(&c, part);
                const fw_dynamics_motion *before = run(arena, &d.r, NULL, NULL);
                for (int i = 0; i < d.r.m.npin; i++)
                    d.r.m.pin[i].stiffness_Nm_per_rad *=
                        1 + part * (same ? 1 : 2 * rig_random(&more) - 1);
                for (int i = 0; i < d.r.m.njoint; i++)
                    d.r.m.joint[i].stiffness_N_per_m *= 1 + (same ? part : 0);
                double change = bounds_apart(before, run(arena, &d.r, NULL, NULL), &unknown);
                valid++;
                if (change > bound + unknown) {
                    bad++;
                    print_error(
                        "seed %llu: a part %.3g of the stiffness changes %.3g, bound %.3g\n",
                        (unsigned long long)seed, part, change, bound);
                }
            }
        }
        fw_arena_free(arena);
    }
    assert_true(valid > count / 2);
    assert_int_equal(bad, 0);
}

/* a weight along a mast: m g l / k of the stiffness, twice for the overshoot */
static void softening(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = lever(arena, 1e-6, 0, 2e-9);
    fw_effects_envelope e;
    find(arena, &r, &e);
    const fw_effect_case c = {arena, &r.m, &r.scene, &e, NULL, NULL};
    for (int sign = -1; sign <= 1; sign += 2) {
        const double weight[3] = {sign * 3e-6, 0, 0};
        double part;
        assert_int_equal(fw_effects_envelope_softening(&c, weight, &part), FW_OK);
        assert_near(part, 2 * 3e-6 * 1e-3 / 1e-6, 1e-6 * part);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_mode),        cmocka_unit_test(short_scene),
        cmocka_unit_test(two_modes),       cmocka_unit_test(where_it_says_nothing),
        cmocka_unit_test(holds_every_run), cmocka_unit_test(stiffness_changes),
        cmocka_unit_test(softening),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
