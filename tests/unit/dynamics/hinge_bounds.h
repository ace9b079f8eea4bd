/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The same question as in bounds.h for hinges that give: random six-bars, four-bars and chains
   whose joints are flexures, arcs and leaves, of the geometry's own stiffness; peaks with all
   effects against peaks with ideal pins, and against what auto keeps. */
#ifndef FW_TESTS_HINGE_BOUNDS_H
#define FW_TESTS_HINGE_BOUNDS_H
#include "bounds.h"

/* silicon, 50 um deep: arc (half angle > 0) or leaf; short enough that its stiffness along itself
   leaves the run affordable */
static inline fw_flexure_hinge_law hinge_bounds_law(uint64_t *seed) {
    const double E_Pa = 160e9, depth_m = 50e-6;
    double width_m = 1e-6 * bounds_log(seed, 5, 10), length_m = width_m * bounds_log(seed, 15, 50);
    double half_rad = rig_random(seed) < 0.6 ? 1 + 1.4 * rig_random(seed) : 0;
    double EA = E_Pa * depth_m * width_m, EI = EA * width_m * width_m / 12;
    double root_m = rig_random(seed) < 0.5 ? 0 : 0.5 * width_m, whole_m = length_m + 2 * root_m;
    return (fw_flexure_hinge_law){.stiffness_Nm_per_rad = EI / whole_m,
                                  .half_angle_rad = half_rad,
                                  .length_m = length_m,
                                  .share = length_m / whole_m,
                                  .bend_m_per_N = length_m * length_m * length_m / (8 * EI),
                                  .root_m_per_N = root_m * length_m * length_m / (2 * EI),
                                  .axial_m_per_N = length_m / (2 * EA),
                                  .shear_m_per_N = 1.22 * length_m / (5.0 / 6 * EA)};
}

static inline void hinge_bounds_flex(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    fw_mechanism *m = &d->r.m;
    m->hinge = fw_arena_array(arena, fw_mechanism_hinge, (size_t)m->npin);
    m->nhinge = m->npin;
    double tau_s = bounds_log(seed, 1e-9, 1e-6);
    for (int i = 0; i < m->npin; i++) {
        m->hinge[i] = (fw_mechanism_hinge){.pin = i,
                                           .law = hinge_bounds_law(seed),
                                           .axis_rad = 6.283 * rig_random(seed),
                                           .first_is_a = rig_random(seed) < 0.5,
                                           .cover_from_rad = (double)NAN,
                                           .cover_to_rad = (double)NAN};
        m->pin[i].hinge = i;
        m->pin[i].stiffness_Nm_per_rad = m->hinge[i].law.stiffness_Nm_per_rad;
        m->pin[i].damping_Nms_per_rad = tau_s * m->pin[i].stiffness_Nm_per_rad;
    }
}

static inline bool hinge_bounds_make(fw_arena *arena, uint64_t seed, bounds_device *d) {
    static rig (*const devices[])(fw_arena *, uint64_t *) = {bounds_six_bar, bounds_four_bar,
                                                             bounds_chain};
    static const fw_mechanism_variant variant = {.thickness_m = 50e-6};
    for (int i = 0; i < 5; i++)
        rig_random(&seed);
    memset(d, 0, sizeof *d);
    d->r = devices[(size_t)(3 * rig_random(&seed))](arena, &seed);
    d->r.m.variant = &variant;
    d->turn = bounds_log(&seed, 1e-3, 0.2);
    d->r.scene.duration_s = d->omega = 1;
    for (int i = 0; i < d->r.m.npin; i++) {
        const fw_mechanism_pin *p = &d->r.m.pin[i];
        double a = p->body_a == FW_GROUND ? 0 : d->r.m.body[p->body_a].phi_rad;
        double b = p->body_b == FW_GROUND ? 0 : d->r.m.body[p->body_b].phi_rad;
        d->r.m.pin[i].free_angle_rad = b - a;
    }
    hinge_bounds_flex(arena, d, &seed);
    uint64_t again = seed;
    bounds_add_loads(d, &seed);
    if (!bounds_scale_loads(arena, d)) return false;
    d->r.scene.duration_s = bounds_log(&seed, 2, 40) / d->omega;
    d->laws = d->r.scene.nforce = d->r.scene.ntorque = 0;
    bounds_add_loads(d, &again);
    if (!bounds_scale_loads(arena, d)) return false;
    if (rig_random(&seed) < 0.5) bounds_gravity(arena, d, &seed);
    return true;
}

static inline bool hinge_active(const fw_effect_ledger *l, const char *id) {
    for (int i = 0; i < l->count; i++)
        if (strcmp(l->item[i].id, id) == 0) return l->item[i].active;
    return false;
}

typedef struct hinge_score {
    double *tight;
    int devices, finite, bad, count, refused, left_out;
} hinge_score;

/* NULL: the motion has none (a hinge wound up, no steps left); that says nothing of bounds */
static inline const fw_dynamics_motion *
hinge_run(fw_arena *arena, const rig *r, fw_effect_mode mode, const char *list, double accuracy) {
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m = NULL;
    const fw_dynamics_motion_options o = {
        .accuracy = accuracy, .rtol = 1e-8, .samples = 2, .effects = {.mode = mode, .list = list}};
    return fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &m) == FW_OK ? m : NULL;
}

static inline void hinge_bounds_try(uint64_t seed, hinge_score *score) {
    static bounds_device d;
    fw_arena *arena = fw_arena_new(0);
    uint64_t more = seed ^ 0x5555;
    if (hinge_bounds_make(arena, seed, &d)) {
        double accuracy = bounds_log(&more, 1e-3, 0.5), unknown, bound = (double)INFINITY;
        const fw_dynamics_motion *all = hinge_run(arena, &d.r, FW_EFFECTS_ALL, NULL, 1e-3);
        const fw_dynamics_motion *pins =
            hinge_run(arena, &d.r, FW_EFFECTS_LIST, "joint-damping,gravity,inertia", 1e-3);
        const fw_dynamics_motion *some = hinge_run(arena, &d.r, FW_EFFECTS_AUTO, NULL, accuracy);
        if (!all || !pins || !some) {
            score->refused++;
            fw_arena_free(arena);
            return;
        }
        score->devices++;
        for (int i = 0; i < all->ledger.count; i++)
            if (strcmp(all->ledger.item[i].id, "nonlinear-hinge") == 0) {
                assert_true(all->ledger.item[i].called_for);
                bound = all->ledger.item[i].bound;
                score->left_out += !some->ledger.item[i].active;
            }
        if (hinge_active(&some->ledger, "nonlinear-hinge")) /* it calms them */
            assert_true(hinge_active(&some->ledger, "joint-damping"));
        assert_false(hinge_active(&pins->ledger, "nonlinear-hinge"));
        double change = bounds_apart(all, pins, &unknown);
        if (isfinite(bound)) {
            score->finite++;
            if (change > 3 * unknown) score->tight[score->count++] = bound / change;
        }
        if (change > bound + unknown) {
            score->bad++;
            print_error("seed %llu: pins change the peaks by %.4g, the bound is %.4g (%.2g)\n",
                        (unsigned long long)seed, change, bound, unknown);
        }
        change = bounds_apart(all, some, &unknown);
        if (change > some->ledger.left_out + unknown) {
            score->bad++;
            print_error("seed %llu: auto changes the peaks by %.4g, it says %.4g (%.2g)\n",
                        (unsigned long long)seed, change, some->ledger.left_out, unknown);
        }
    }
    fw_arena_free(arena);
}

static inline void hinge_bounds_check(uint64_t first, int count) {
    fw_arena *arena = fw_arena_new(0);
    hinge_score s = {.tight = fw_arena_array(arena, double, (size_t)count)};
    for (int i = 0; i < count; i++)
        hinge_bounds_try(first + (uint64_t)i, &s);
    qsort(s.tight, (size_t)s.count, sizeof *s.tight, bounds_by_size);
    print_message("%d devices with flexures (%d without a motion), bounded %d, pins by auto %d\n",
                  s.devices, s.refused, s.finite, s.left_out);
    if (s.count > 0)
        print_message(
            "  bound over true change: least %.3g, 10 %% %.3g, half %.3g, 90 %% %.3g (%d)\n",
            s.tight[0], s.tight[s.count / 10], s.tight[s.count / 2], s.tight[s.count * 9 / 10],
            s.count);
    assert_int_equal(s.bad, 0);
    assert_true(10 * s.refused < s.devices);
    assert_true(2 * s.finite > s.devices); /* it says something */
    fw_arena_free(arena);
}

#endif
