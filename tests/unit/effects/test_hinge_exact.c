/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures as exact beams in a mechanism: laws of every element, the same bits for the same pose,
   crystals, leaves, and where there is no equilibrium. The six-bar of the tables is in
   tests/unit/statics/test_hinge_models.c. */
#include "element_check.h"
#include "hinge_rigs.h"

static const double E = 147.0790923914665e9;

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static void two_bodies(rig *r, double axis, bool first_is_a) {
    rig_new(r, 2, 1);
    r->body[0] = (fw_mechanism_mass){"a", 1e-8, 1e-15, 1e-4, 2e-4, 0.3, {0, 0}};
    r->body[1] = (fw_mechanism_mass){"b", 1e-8, 1e-15, -1e-4, 3e-4, -0.2, {0, 0}};
    rig_hinge(r, 0, "H", 0, 1, (fw_geometry_vec2){1e-4, 1e-4}, axis, first_is_a);
    rig_strip(&r->hinge[0], E);
}

/* a leaf of the same length, made by the closed forms themselves, its roots included */
static void real_strip(rig *r, fw_device_flexure_kind kind, double crystal_rad) {
    fw_mechanism_hinge *h = &r->hinge[0];
    h->input.kind = kind;
    h->input.fillet_m = 4e-6;
    if (kind == FW_FLEXURE_LEAF) h->input.angle_rad = h->input.radius_m = 0;
    if (!isnan(crystal_rad))
        h->input.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, crystal_rad);
    fw_flexure_closed_form(&h->input, &h->closed_form);
    fw_flexure_hinge_law_of(&h->input, &h->closed_form, &h->law);
    r->pin[0].stiffness_Nm_per_rad = h->closed_form.stiffness_Nm_per_rad;
}

static const fw_effects_force_element *exact(rig *r) {
    rig_compile(r);
    const fw_effects_force_element *e;
    fw_effects_element_class const *closed = r->loads.element[0].class_;
    assert_int_equal(fw_effects_hinges_exact(r->arena, &r->m, &r->loads), FW_OK);
    e = &r->loads.element[0];
    assert_ptr_not_equal(e->class_, closed);
    return e;
}

/* both senses, arcs, leaves and crystals, roots, a free angle and damping: power, tangent and
   balance on random states */
static void element_laws(void **state) {
    (void)state;
    unsigned seed = 11;
    int held = 0;
    for (int i = 0; i < 48; i++) {
        rig r;
        bool leaf = i % 3 == 0;
        two_bodies(&r, 4 * random_(&seed), i % 2 == 0);
        if (i % 4 > 0)
            real_strip(&r, leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                       i % 8 == 1 ? 0.4 : (double)NAN);
        r.pin[0].free_angle_rad = 0.05;
        r.pin[0].damping_Nms_per_rad = i % 5 == 0 ? 0 : 1e-10;
        const fw_effects_force_element *e = exact(&r);
        double p[6], w[6];
        /* along its chord a leaf is stiff: what is random there would buckle it */
        double far = leaf && i % 4 > 0 ? 4e-8 : 4e-6;
        for (int k = 0; k < 6; k++) {
            p[k] = (k % 3 == 2 ? 0.3 : far) * random_(&seed);
            w[k] = (k % 3 == 2 ? 300 : 1e4 * far) * random_(&seed);
        }
        fw_effects_port_state s = {.load = 1, .p = p, .w = w};
        const char *why;
        if (!e->class_->valid(e, &s, &why)) {
            fw_arena_free(r.arena);
            continue;
        }
        held++;
        fw_check_tangent(e, &s, leaf ? 4e-10 : 2e-8, leaf ? 1e-4 : 1e-3, 2e-6);
        fw_check_power(e, &s, 1e-7, 1e-6);
        fw_check_balance(e, &s, 1e-11);
        fw_arena_free(r.arena);
    }
    assert_true(held >= 44);
}

/* to the last bit, whatever was asked for before */
static void the_pose_alone(void **state) {
    (void)state;
    enum { POSES = 40 };
    unsigned seed = 5;
    rig r;
    two_bodies(&r, 1.1, false);
    const fw_effects_force_element *e = exact(&r);
    double p[POSES][6], w[6] = {0}, f[POSES][6], again[6], k[36], c[36];
    for (int i = 0; i < POSES; i++) {
        for (int j = 0; j < 6; j++)
            p[i][j] = (j % 3 == 2 ? 0.6 : 6e-6) * random_(&seed);
        const fw_effects_port_state s = {.load = 1, .p = p[i], .w = w};
        e->class_->force(e, &s, f[i]);
    }
    for (int i = 0; i < 200; i++) {
        int at = ((int)(random_(&seed) * POSES / 2) + POSES / 2) % POSES;
        const fw_effects_port_state s = {.load = 1, .p = p[at], .w = w};
        if (i % 3 == 0) e->class_->tangent(e, &s, k, c);
        if (i % 5 == 0) (void)e->class_->energy(e, &s);
        e->class_->force(e, &s, again);
        assert_memory_equal(again, f[at], sizeof again);
    }
    fw_arena_free(r.arena);
}

/* where rounding is all there is the beam is still the beam */
static void hardly_bent(void **state) {
    (void)state;
    unsigned seed = 3;
    for (int i = 0; i < 60; i++) {
        rig r;
        two_bodies(&r, 1.1, i % 2 == 0);
        if (i % 3) real_strip(&r, i % 3 == 1 ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH, (double)NAN);
        const fw_effects_force_element *e = exact(&r);
        double p[6], w[6] = {0};
        const char *why;
        for (int j = 0; j < 6; j++)
            p[j] = ldexp(random_(&seed), -30 - i % 30) * (j % 3 == 2 ? 1 : 1e-4);
        const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
        assert_true(e->class_->valid(e, &s, &why));
        fw_arena_free(r.arena);
    }
}

/* small motions are those of the closed form, whose kx, ky and K are the same integrals; of an
   element at rest with its roots, and with a crystal's modulus by direction */
static void at_rest_as_closed(void **state) {
    (void)state;
    static const double crystal[] = {(double)NAN, 0, 0.25 * M_PI};
    for (int i = 0; i < 4; i++) {
        rig r;
        two_bodies(&r, 0.7, i % 2 == 0);
        real_strip(&r, i == 3 ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                   i < 3 ? crystal[i] : (double)NAN);
        double k[2][36], c[36], w[6] = {0}, p[6] = {0};
        rig_compile(&r);
        const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
        r.loads.element[0].class_->tangent(&r.loads.element[0], &s, k[0], c);
        assert_int_equal(fw_effects_hinges_exact(r.arena, &r.m, &r.loads), FW_OK);
        r.loads.element[0].class_->tangent(&r.loads.element[0], &s, k[1], c);
        /* W of the closed form is that of a thick arc, 0.015 um from the beam's, which couples
           force and rotation; a crystal's kx and ky hold shear with one modulus */
        for (int a = 0; a < 36; a++) {
            double size = sqrt(k[0][7 * (a / 6)] * k[0][7 * (a % 6)]);
            assert_near(k[1][a] / size, k[0][a] / size, i == 1 || i == 2 ? 6e-3 : 3e-3);
        }
        fw_arena_free(r.arena);
    }
}

/* a leaf pressed along its chord beyond its buckling length has no equilibrium on the primary
   branch: said, and the force is still finite */
static void no_equilibrium(void **state) {
    (void)state;
    rig r;
    two_bodies(&r, 0, true);
    real_strip(&r, FW_FLEXURE_LEAF, (double)NAN);
    const fw_effects_force_element *e = exact(&r);
    double p[6] = {0}, w[6] = {0}, f[6];
    const char *why = NULL;
    const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
    assert_true(e->class_->valid(e, &s, &why));
    p[1] = 50e-6; /* the first body towards the second along y, a tenth of its length */
    bool held = e->class_->valid(e, &s, &why);
    e->class_->force(e, &s, f);
    for (int i = 0; i < 6; i++)
        assert_true(isfinite(f[i]));
    if (!held) assert_non_null(strstr(why, "buckle"));
    assert_false(held);
    fw_arena_free(r.arena);
}

/* room for lattices of a six-bar whose hinges from `equal` on have a width of their own each */
static size_t followed_bytes(int equal) {
    rig r;
    rig_six_bar(&r, false);
    for (int i = 0; i < 6; i++) {
        rig_strip(&r.hinge[i], E);
        if (i >= equal) r.hinge[i].input.width_m *= 1 + 0.01 * i;
    }
    (void)exact(&r);
    size_t before = fw_arena_peak(r.arena);
    assert_int_equal(fw_effects_hinges_follow(r.arena, &r.loads), FW_OK);
    size_t room = fw_arena_peak(r.arena) - before;
    assert_int_equal(fw_effects_hinges_follow(NULL, &r.loads), FW_OK);
    fw_arena_free(r.arena);
    return room;
}

/* hinges that are the same beam share one lattice of its solutions, others do not */
static void one_lattice_of_one_beam(void **state) {
    (void)state;
    double all = (double)followed_bytes(0), one = (double)followed_bytes(6);
    assert_true(one > 0 && one < 0.4 * all);
    assert_true(followed_bytes(3) > (size_t)(2 * one));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(element_laws),   cmocka_unit_test(the_pose_alone),
        cmocka_unit_test(hardly_bent),    cmocka_unit_test(at_rest_as_closed),
        cmocka_unit_test(no_equilibrium), cmocka_unit_test(one_lattice_of_one_beam),
    };
    return cmocka_run_group_tests_name("hinge-exact", tests, NULL, NULL);
}
