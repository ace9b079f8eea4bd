/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What ideal pins leave out, as nonlinear_hinge.c bounds it, against whole motions: the same mechanism
   with hinges as they are and with hinges so stiff and free of drift that they are pins, from rest
   under loads put on at once. */
#include "flexure/path.h"
#include "hinge_rigs.h"

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static double mass_of(const rig *r, int i) {
    return i % 3 == 2 ? r->body[i / 3].inertia_kg_m2 : r->body[i / 3].mass_kg;
}

/* hinges that hold W `factor` times as stiffly, without drift and shortening (a table whose series
   are constants), and damp what is left */
static void make_pins(rig *r, double factor) {
    for (int i = 0; i < r->m.npin; i++) {
        fw_flexure_hinge_law *law = &r->hinge[i].law;
        fw_flexure_hinge_at at;
        struct fw_flexure_hinge_table *table =
            fw_arena_one(r->arena, struct fw_flexure_hinge_table);
        fw_flexure_hinge_law_at(law, 0, &at);
        table->bend_x[0] = 1 / (factor * at.kx_N_per_m.value);
        table->bend_y[0] = 1 / (factor * at.ky_N_per_m.value);
        law->table = table;
        law->length_m = 1;
        r->pin[i].damping_Nms_per_rad = 2e-7 * r->pin[i].stiffness_Nm_per_rad;
    }
}

typedef struct motion {
    double peak, angle[RIG_PINS], force[RIG_PINS], give[RIG_PINS];
} motion;

static void all_forces(const rig *r, const double *q, const double *v, double *force, motion *out) {
    double p[6], w[6], f[6];
    memset(force, 0, 3 * (size_t)r->m.nbody * sizeof *force);
    for (int i = 0; i < r->loads.nelement; i++) {
        const fw_effects_force_element *e = &r->loads.element[i];
        const fw_effects_port_state s = {.load = 1, .p = p, .w = w};
        fw_effects_element_place_ports(e, q, v, p, w);
        e->class_->force(e, &s, f);
        fw_effects_element_add_forces(e, q, f, force);
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

/* the mechanism as it is, and as pins */
typedef struct trio {
    rig real, ideal;
} trio;

static void trio_new(trio *t, bool six_bar, double mass_factor, double end_s) {
    rig *const all[2] = {&t->real, &t->ideal};
    for (int i = 0; i < 2; i++) {
        rig *r = all[i];
        if (six_bar)
            rig_six_bar(r, false);
        else {
            rig_new(r, 1, 1);
            r->body[0] = (fw_mechanism_mass){"lever", 1e-8, 8e-16, 5e-4, 1e-4, 0, {0, 0}};
            rig_hinge(r, 0, "H", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, 0.9, true);
        }
        for (int b = 0; b < r->m.nbody; b++)
            r->body[b].mass_kg *= mass_factor, r->body[b].inertia_kg_m2 *= mass_factor;
        if (i) make_pins(r, 50);
        r->scene.duration_s = end_s;
        rig_compile(r);
    }
}

static void trio_free(trio *t) {
    fw_arena_free(t->real.arena);
    fw_arena_free(t->ideal.arena);
}

/* the loads as the scene's, put on at once, and the envelope of that scene */
static void put_on(rig *r, const double *load) {
    fw_device_force *force = fw_arena_array(r->arena, fw_device_force, RIG_BODIES);
    fw_device_torque *torque = fw_arena_array(r->arena, fw_device_torque, RIG_BODIES);
    for (int b = 0; b < r->m.nbody; b++) {
        force[b] = (fw_device_force){.body = b, .fx_N = load[3 * b], .fy_N = load[3 * b + 1]};
        torque[b] = (fw_device_torque){.body = b, .value_Nm = load[3 * b + 2]};
    }
    r->scene.force = force, r->scene.nforce = r->m.nbody;
    r->scene.torque = torque, r->scene.ntorque = r->m.nbody;
    assert_int_equal(fw_effects_envelope_find(r->arena, &r->m, &r->scene, &r->envelope), FW_OK);
    if (!r->envelope.valid) fail_msg("%s", r->envelope.why_not);
    assert_non_null(r->envelope.pinned);
}

/* returns the bound over the peak */
static double check(trio *t, const double *load, const motion *with, const motion *without) {
    const char *why;
    double bound, value, off = fabs(with->peak - without->peak) / fmax(with->peak, without->peak);
    rig *r = &t->real;
    put_on(r, load);
    const fw_effects_envelope *e = &r->envelope;
    assert_true(e->floor <= with->peak && with->peak <= e->most);
    assert_true(e->pinned->floor <= without->peak && without->peak <= e->pinned->most);
    for (int i = 0; i < r->m.npin; i++) {
        if (!(with->give[i] <= fw_effects_hinge_give_most(&r->c, i)))
            fail_msg("pin %d gives %g m, bound %g m", i, with->give[i],
                     fw_effects_hinge_give_most(&r->c, i));
        if (!(with->force[i] <= e->force[i]))
            fail_msg("pin %d bears %g N, bound %g N", i, with->force[i], e->force[i]);
    }
    assert_int_equal(fw_effect_nonlinear_hinge.bound(&r->c, &bound, &why), FW_OK);
    if (!(off <= bound)) fail_msg("off by %g, bound %g", off, bound);

    /* a gap that the bound leaves open is not called for, a smaller one is */
    double give = fw_effects_hinge_give_most(&r->c, 0);
    fw_device_contact_use use = {.joint = 0, .distance_m = 1.01 * give, .stiffness_N_per_m = 1};
    r->scene.contact = &use, r->scene.ncontact = 1;
    assert_int_equal(fw_effect_contact.bound(&r->c, &value, &why), FW_OK);
    assert_near(value, 0, 0);
    use.distance_m = 0.99 * give;
    assert_int_equal(fw_effect_contact.bound(&r->c, &value, &why), FW_OK);
    assert_true(isinf(value));
    assert_int_equal(fw_effect_nonlinear_hinge.bound(&r->c, &value, &why), FW_OK);
    assert_true(isinf(value));
    r->scene.ncontact = 0;
    return bound / off;
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
            load[k] = random_(&seed) * (k % 3 == 2 ? 1e-7 : 2e-4) * (i % 8 < 4 ? 0.1 : 0.03);
        trio_new(&t, six, i % 4 < 2 ? 1 : 0.3, end_s);
        motion with = move(&t.real, load, end_s, 2e-7);
        motion without = move(&t.ideal, load, end_s, 5e-8);
        telling += check(&t, load, &with, &without) < 30;
        trio_free(&t);
    }
    print_message("%d of 24 bounds within 30 times what is true\n", telling);
    assert_true(telling > 8); /* it says something */
}

/* where the theory has no place for what is there, nothing is promised */
static void nothing_promised(void **state) {
    (void)state;
    trio t;
    double load[RIG_N] = {0, 1e-6, 0}, bound;
    const char *why;
    trio_new(&t, false, 1, 1e-3);
    rig *r = &t.real;
    assert_int_equal(fw_effects_hinge_give_bound(&r->c, &bound, &why), FW_OK);
    assert_true(isinf(bound) && why); /* no envelope */
    put_on(r, load);
    assert_int_equal(fw_effects_hinge_give_bound(&r->c, &bound, &why), FW_OK);
    assert_true(isfinite(bound) && !why);
    r->envelope.pinned->omega[0] *= 20; /* as fast as the pins vibrate */
    assert_int_equal(fw_effects_hinge_give_bound(&r->c, &bound, &why), FW_OK);
    assert_true(isinf(bound) && why);
    r->envelope.pinned->omega[0] /= 20;
    r->envelope.pinned = NULL;
    assert_int_equal(fw_effects_hinge_give_bound(&r->c, &bound, &why), FW_OK);
    assert_true(isinf(bound) && why);
    trio_free(&t);
}

static fw_effect_entry give_of(rig *r, double accuracy, const fw_effect_ledger *like,
                               fw_effect_ledger *ledger) {
    const fw_effect_choice choice = {.like = like};
    fw_diags diags = fw_diags_new(r->arena);
    fw_effects_loads loads;
    assert_int_equal(
        fw_effects_compile(r->arena, &r->m, &r->scene, &choice, accuracy, &diags, ledger, &loads),
        FW_OK);
    for (int i = 0; i < ledger->count; i++)
        if (strcmp(ledger->item[i].id, "nonlinear-hinge") == 0) return ledger->item[i];
    fail();
    return (fw_effect_entry){0};
}

/* what acts by far in a device much like this one acts here, with that bound; else it is found */
static void like_another(void **state) {
    (void)state;
    double load[RIG_N] = {0, 1e-6, 0};
    fw_effect_ledger first, same, ledger;
    trio t;
    trio_new(&t, false, 1, 1e-3);
    rig *r = &t.real;
    put_on(r, load);
    const fw_effect_entry found = give_of(r, 1e-9, NULL, &first);
    assert_true(found.active && isfinite(found.bound));
    for (int i = 0; i < first.count; i++) /* a bound that is none of this device's */
        if (strcmp(first.item[i].id, found.id) == 0) first.item[i].bound *= 1.5;
    fw_effect_entry e = give_of(r, found.bound / 4, &first, &same);
    assert_true(e.active);
    assert_near(e.bound, 1.5 * found.bound, 1e-9 * found.bound);
    for (int i = 0; i < 2; i++) { /* not by far; and not a bit */
        e = give_of(r, found.bound / (i ? 0.5 : 2), &first, &ledger);
        assert_near(e.bound, found.bound, 1e-9 * found.bound);
        assert_true(e.active == !i);
    }
    trio_free(&t);
}

/* Where nobody reads bounds, that of hinges whose model was asked for is not found, and nothing else is another: what
   acts, all other bounds, and what they add up to. Where it decides it is found all the same. */
static void what_nobody_reads(void **state) {
    (void)state;
    double load[RIG_N] = {0, 1e-6, 0};
    trio t;
    trio_new(&t, false, 1, 1e-3);
    rig *r = &t.real;
    put_on(r, load);
    for (int model = FW_HINGE_AUTO; model <= FW_HINGE_COMPLIANCE; model++) {
        fw_effect_ledger ledger[2];
        fw_effects_loads loads[2];
        fw_diags diags = fw_diags_new(r->arena);
        for (int untold = 0; untold < 2; untold++) {
            const fw_effect_choice choice = {.hinge = (fw_effects_hinge_model)model,
                                             .untold = untold};
            assert_int_equal(fw_effects_compile(r->arena, &r->m, &r->scene, &choice, 1e-3, &diags,
                                                &ledger[untold], &loads[untold]),
                             FW_OK);
        }
        assert_int_equal(loads[0].nelement, loads[1].nelement);
        assert_int_equal(loads[0].nreleased, loads[1].nreleased);
        assert_true(ledger[0].left_out == ledger[1].left_out);
        assert_true(ledger[0].beside == ledger[1].beside);
        assert_int_equal(ledger[0].hinge.used, ledger[1].hinge.used);
        for (int i = 0; i < ledger[0].count; i++) {
            const fw_effect_entry *told = &ledger[0].item[i], *untold = &ledger[1].item[i];
            assert_int_equal(told->active, untold->active);
            assert_true(told->cost == untold->cost);
            if (strcmp(told->id, "nonlinear-hinge") == 0 && model != FW_HINGE_AUTO)
                assert_true(isfinite(told->bound) && isinf(untold->bound));
            else
                assert_true(told->bound == untold->bound);
        }
    }
    trio_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_nobody_reads),
        cmocka_unit_test(motions),
        cmocka_unit_test(nothing_promised),
        cmocka_unit_test(like_another),
    };
    return cmocka_run_group_tests_name("hinge give", tests, NULL, NULL);
}
