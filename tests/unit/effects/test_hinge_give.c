/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What ideal pins leave out, as hinge_give.c bounds it, against whole motions: the same mechanism
   with hinges as they are and with hinges so stiff and free of drift that they are pins, from rest
   under loads put on at once. */
#include "hinge_rigs.h"
#include "maths/lapack.h"

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static double mass_of(const rig *r, int i) {
    return i % 3 == 2 ? r->body[i / 3].inertia_kg_m2 : r->body[i / 3].mass_kg;
}

/* hinges that hold W `factor` times as stiffly, without drift, and damp what is left */
static void make_pins(rig *r, double factor) {
    for (int i = 0; i < r->m.npin; i++) {
        fw_hinge_law *law = &r->hinge[i].law;
        law->bend_m_per_N /= factor, law->root_m_per_N /= factor;
        law->axial_m_per_N /= factor, law->shear_m_per_N /= factor;
        law->length_m = 1e-15; /* of the drift alone */
        r->pin[i].damping_Nms_per_rad = 2e-7 * r->pin[i].stiffness_Nm_per_rad;
    }
}

typedef struct motion {
    double peak, angle[RIG_PINS], force[RIG_PINS], give[RIG_PINS];
} motion;

static void all_forces(const rig *r, const double *q, const double *v, double *force, motion *out) {
    double p[6], w[6], f[6];
    memset(force, 0, 3 * (size_t)r->m.nbody * sizeof *force);
    for (int i = 0; i < r->terms.nelement; i++) {
        const fw_force_element *e = &r->terms.element[i];
        const fw_seen s = {.load = 1, .p = p, .w = w};
        fw_element_look(e, q, v, p, w);
        e->class_->force(e, &s, f);
        fw_element_push(e, q, f, force);
        out->angle[i] = fmax(out->angle[i], fabs(p[5] - p[2]));
        out->force[i] = fmax(out->force[i], hypot(f[3], f[4]));
        out->give[i] = fmax(out->give[i], hypot(p[3] - p[0], p[4] - p[1]));
    }
}

/* leap-frog; stable for steps below 2/omega of the stiffest pin */
static motion move(const rig *r, const double *load, double end_s, double step_s) {
    motion out = {0};
    double q[RIG_N], v[RIG_N] = {0}, force[RIG_N];
    int n = 3 * r->m.nbody;
    rig_drawn(r, q);
    for (double t = 0; t < end_s; t += step_s) {
        all_forces(r, q, v, force, &out);
        for (int i = 0; i < n; i++) {
            v[i] += step_s * (force[i] + load[i]) / mass_of(r, i);
            q[i] += step_s * v[i];
        }
    }
    for (int i = 0; i < r->m.npin; i++)
        out.peak = fmax(out.peak, out.angle[i]);
    return out;
}

/* modes of the pinned mechanism from hinges 1e5 times as stiff, and an envelope that is exactly the
   motion */
static void envelope_from(rig *r, const rig *pinned, int modes, const motion *ideal) {
    int n = 3 * r->m.nbody;
    double q[RIG_N], force[RIG_N], a[RIG_N * RIG_N], value[RIG_N];
    fw_lapack_space space;
    rig_drawn(pinned, q);
    rig_forces(pinned, q, force, a);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            a[i * n + j] /= sqrt(mass_of(r, i) * mass_of(r, j));
    assert_int_equal(fw_eigen_space(r->arena, n, &space), FW_OK);
    assert_true(fw_eigen(n, a, value, &space));
    fw_envelope *e = &r->envelope;
    *e = (fw_envelope){
        .valid = true, .n = n, .modes = modes, .floor = ideal->peak, .most = ideal->peak};
    e->omega = fw_arena_array(r->arena, double, (size_t)modes);
    e->shape = fw_arena_array(r->arena, double, (size_t)(modes * n));
    e->turn = fw_arena_array(r->arena, double, (size_t)(modes * r->m.npin));
    e->angle = fw_arena_array(r->arena, double, (size_t)r->m.npin);
    e->force = fw_arena_array(r->arena, double, (size_t)r->m.npin);
    e->reach = fw_arena_array(r->arena, double, (size_t)n);
    for (int k = 0; k < modes; k++) {
        e->omega[k] = sqrt(value[k]);
        for (int i = 0; i < n; i++)
            e->shape[k * n + i] = a[k * n + i] / sqrt(mass_of(r, i));
    }
    for (int i = 0; i < r->m.npin; i++)
        e->angle[i] = ideal->angle[i], e->force[i] = ideal->force[i];
}

/* the mechanism as it is, as pins for its forces and motion, as pins for its modes */
typedef struct trio {
    rig real, ideal, pinned;
} trio;

static void trio_new(trio *t, bool six_bar, double mass_factor, double end_s) {
    rig *const all[3] = {&t->real, &t->ideal, &t->pinned};
    for (int i = 0; i < 3; i++) {
        rig *r = all[i];
        if (six_bar)
            rig_six_bar(r, false);
        else {
            rig_new(r, 1, 1);
            r->body[0] = (fw_mass){"lever", 1e-8, 8e-16, 5e-4, 1e-4, 0};
            rig_hinge(r, 0, "H", FW_GROUND, 0, (fw_vec2){0, 0}, 0.9, true);
        }
        for (int b = 0; b < r->m.nbody; b++)
            r->body[b].mass_kg *= mass_factor, r->body[b].inertia_kg_m2 *= mass_factor;
        if (i) make_pins(r, i == 1 ? 50 : 1e5);
        r->scene.duration_s = end_s;
        rig_compile(r);
    }
}

static void trio_free(trio *t) {
    fw_arena_free(t->real.arena);
    fw_arena_free(t->ideal.arena);
    fw_arena_free(t->pinned.arena);
}

/* returns the bound over the peak */
static double check(trio *t, const motion *with, const motion *without) {
    fw_hinge_give give;
    rig *r = &t->real;
    envelope_from(r, &t->pinned, r->m.nbody > 1 ? 3 : 1, without);
    assert_int_equal(fw_hinge_give_find(&r->c, &give), FW_OK);
    if (give.why_not) fail_msg("%s", give.why_not);
    for (int i = 0; i < r->m.npin; i++)
        if (!(with->give[i] <= give.give_m[i]))
            fail_msg("pin %d gives %g m, bound %g m", i, with->give[i], give.give_m[i]);
    double off = fabs(with->peak - without->peak);
    double bound = give.turned_rad + give.softening * without->peak;
    if (!(off <= bound)) fail_msg("off by %g rad, bound %g rad", off, bound);
    assert_true(give.softening > 0 && give.softening < 0.5);

    /* a gap that the bound leaves open is not called for, a smaller one is */
    fw_contact_use use = {.joint = 0, .distance_m = 1.01 * give.give_m[0], .stiffness_N_per_m = 1};
    const char *why;
    double value;
    r->scene.contact = &use, r->scene.ncontact = 1;
    assert_int_equal(fw_effect_contact.bound(&r->c, &value, &why), FW_OK);
    assert_near(value, 0, 0);
    use.distance_m = 0.99 * give.give_m[0];
    assert_int_equal(fw_effect_contact.bound(&r->c, &value, &why), FW_OK);
    assert_true(isinf(value));
    assert_int_equal(fw_effect_nonlinear_hinge.bound(&r->c, &value, &why), FW_OK);
    assert_true(isinf(value));
    r->scene.ncontact = 0;
    return bound / without->peak;
}

static void motions(void **state) {
    (void)state;
    unsigned seed = 3;
    const double end_s = 6e-4;
    int telling = 0;
    for (int i = 0; i < 24; i++) {
        double load[RIG_N] = {0};
        bool six = i % 2;
        trio t;
        for (int k = 0; k < (six ? RIG_N : 3); k++)
            load[k] = random_(&seed) * (k % 3 == 2 ? 1e-7 : 2e-4) * (i % 8 < 4 ? 0.2 : 0.03);
        trio_new(&t, six, i % 4 < 2 ? 1 : 0.3, end_s);
        motion with = move(&t.real, load, end_s, 2e-7);
        motion without = move(&t.ideal, load, end_s, 5e-8);
        telling += check(&t, &with, &without) < 0.5;
        trio_free(&t);
    }
    assert_true(telling > 12); /* it says something */
}

/* equilibria under loads that turn the hinges by up to 0.13 rad: drift and arms count */
static void equilibria(void **state) {
    (void)state;
    const struct {
        int body, part;
        double value;
    } load[] = {{0, 2, 1.5e-7}, {4, 2, -3e-7}, {2, 0, 150e-6}, {2, 1, -150e-6}, {2, 2, 3e-7}};
    for (int i = 0; i < 5; i++) {
        double f[RIG_N] = {0}, q[RIG_N], force[RIG_N], v[RIG_N] = {0};
        trio t;
        motion m[2];
        memset(m, 0, sizeof m);
        f[3 * load[i].body + load[i].part] = load[i].value;
        trio_new(&t, true, 1, 1e-3);
        for (int k = 0; k < 2; k++) {
            const rig *r = k ? &t.ideal : &t.real;
            rig_drawn(r, q);
            rig_equilibrium(r, f, 10, q);
            all_forces(r, q, v, force, &m[k]);
            for (int j = 0; j < 6; j++)
                m[k].peak = fmax(m[k].peak, m[k].angle[j]);
        }
        check(&t, &m[0], &m[1]);
        trio_free(&t);
    }
}

/* where the theory has no place for what is there, nothing is promised */
static void nothing_promised(void **state) {
    (void)state;
    trio t;
    fw_hinge_give give;
    motion none = {.peak = 0.1, .angle = {0.1}, .force = {1e-4}};
    trio_new(&t, false, 1, 1e-3);
    rig *r = &t.real;
    assert_int_equal(fw_hinge_give_find(&r->c, &give), FW_OK);
    assert_non_null(give.why_not); /* no envelope */
    envelope_from(r, &t.pinned, 1, &none);
    assert_int_equal(fw_hinge_give_find(&r->c, &give), FW_OK);
    assert_null(give.why_not);
    r->envelope.omega[0] *= 10; /* as fast as the pins vibrate */
    assert_int_equal(fw_hinge_give_find(&r->c, &give), FW_OK);
    assert_non_null(give.why_not);
    r->envelope.omega[0] /= 10;
    r->hinge[0].axis_rad = (double)NAN;
    assert_int_equal(fw_hinge_give_find(&r->c, &give), FW_OK);
    assert_non_null(give.why_not);
    r->hinge[0].axis_rad = 0;
    r->scene.nbase = 1;
    assert_int_equal(fw_hinge_give_find(&r->c, &give), FW_OK);
    assert_non_null(give.why_not);
    trio_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motions),
        cmocka_unit_test(equilibria),
        cmocka_unit_test(nothing_promised),
    };
    return cmocka_run_group_tests_name("hinge give", tests, NULL, NULL);
}
