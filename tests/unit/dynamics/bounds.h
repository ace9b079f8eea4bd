/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Are the bounds of the effects honest? Random devices and scenes, each run with all effects, with
   those that auto keeps, and with each one left out: what changes must stay within the bounds.

   A new effect takes part with one row in bounds_effects: a function that gives the device or the
   scene a random element of its kind. */
#ifndef FW_TESTS_BOUNDS_H
#define FW_TESTS_BOUNDS_H
#include "bounds_effects.h"
#include "statics/statics.h"
#include <stdio.h>
#include <stdlib.h>

/* ---- effects: one row each ---- */

static inline void bounds_gravity(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    (void)arena;
    /* m g r of the order of a share of k times turn */
    double share = bounds_log(seed, 1e-5, 1) * d->turn, angle = 6.283 * rig_random(seed);
    double g = share * 1e-6 / (1e-8 * 1e-3);
    d->r.scene.gravity = true;
    d->r.scene.gx_m_per_s2 = g * cos(angle), d->r.scene.gy_m_per_s2 = g * sin(angle);
}

static inline void bounds_joint_damping(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    (void)arena;
    double zeta = bounds_log(seed, 1e-6, 0.3);
    for (int i = 0; i < d->r.m.npin; i++)
        d->r.m.pin[i].damping_Nms_per_rad =
            2 * zeta / d->omega * d->r.m.pin[i].stiffness_Nm_per_rad * bounds_log(seed, 0.3, 3);
    for (int i = 0; i < d->r.m.njoint; i++)
        if (d->r.m.joint[i].kind == FW_JOINT_PRISMATIC)
            d->r.m.joint[i].damping_Ns_per_m =
                2 * zeta / d->omega * d->r.m.joint[i].stiffness_N_per_m * rig_random(seed);
}

static inline void bounds_joint_stop(fw_arena *arena, bounds_device *d, uint64_t *seed) {
    (void)arena;
    int i = (int)(d->r.m.npin * rig_random(seed));
    fw_mechanism_pin *p = &d->r.m.pin[i];
    double phi_a = p->body_a == FW_GROUND ? 0 : d->r.m.body[p->body_a].phi_rad;
    double phi_b = p->body_b == FW_GROUND ? 0 : d->r.m.body[p->body_b].phi_rad;
    p->stop_stiffness_Nm_per_rad = 1e-4;
    p->stop_min_rad = (double)NAN;
    p->stop_max_rad = phi_b - phi_a - p->free_angle_rad + d->turn * bounds_log(seed, 0.5, 30);
}

typedef struct bounds_effect {
    const char *id;
    double chance;
    void (*add)(fw_arena *arena, bounds_device *d, uint64_t *seed);
} bounds_effect;

/* those that make every bound infinite are rare */
static const bounds_effect bounds_effects[] = {
    {"gravity", 0.4, bounds_gravity},
    {"joint-damping", 0.5, bounds_joint_damping},
    {"joint-stop", 0.08, bounds_joint_stop},
    {"base-motion", 0.25, bounds_base_motion},
    {"material-damping", 0.15, bounds_material_damping},
    {"air", 0.25, bounds_air},
    {"temperature", 0.25, bounds_temperature},
    {"residual-stress", 0.12, bounds_residual_stress},
    {"tendon", 0.12, bounds_tendon},
    {"comb-drive", 0.15, bounds_comb_drive},
    {"contact", 0.08, bounds_contact},
    {"friction", 0.2, bounds_friction},
    {"inertia", 0, NULL},
};
enum { BOUNDS_EFFECTS = sizeof bounds_effects / sizeof bounds_effects[0] };

static inline bool bounds_make(fw_arena *arena, uint64_t seed, bounds_device *d) {
    for (int i = 0; i < 5; i++)
        rig_random(&seed);
    memset(d, 0, sizeof *d);
    size_t kinds = sizeof bounds_devices / sizeof bounds_devices[0];
    d->r = bounds_devices[(size_t)((double)kinds * rig_random(&seed))](arena, &seed);
    d->turn = bounds_log(&seed, 1e-4, 0.5);
    d->r.scene.duration_s = 1;
    d->omega = 1;
    for (int i = 0; i < d->r.m.npin; i++) { /* most are drawn free of force */
        const fw_mechanism_pin *p = &d->r.m.pin[i];
        double a = p->body_a == FW_GROUND ? 0 : d->r.m.body[p->body_a].phi_rad;
        double b = p->body_b == FW_GROUND ? 0 : d->r.m.body[p->body_b].phi_rad;
        d->r.m.pin[i].free_angle_rad = b - a;
    }
    for (int i = 0; i < d->r.m.npin; i++)
        d->r.m.pin[i].hinge = FW_NONE;
    d->slow = rig_random(&seed) < 0.3;
    uint64_t again = seed;
    bounds_add_loads(d, &seed);
    if (!bounds_scale_loads(arena, d)) return false;
    /* again with the duration and the frequency known, which the laws go by */
    d->r.scene.duration_s = bounds_log(&seed, d->slow ? 30 : 2, d->slow ? 400 : 80) / d->omega;
    d->laws = d->r.scene.nforce = d->r.scene.ntorque = 0;
    bounds_add_loads(d, &again);
    if (!bounds_scale_loads(arena, d)) return false;
    if (rig_random(&seed) < (d->slow ? 0.05 : 0.2)) {
        int b = (int)(d->r.m.nbody * rig_random(&seed));
        rig_velocity(&d->r, b, 0, 0, d->turn * d->omega * rig_random(&seed));
        d->r.scene.initial[0].moves_free = true;
    }
    for (int i = 0; i < BOUNDS_EFFECTS; i++)
        if (rig_random(&seed) < bounds_effects[i].chance) bounds_effects[i].add(arena, d, &seed);
    return true;
}

/* ---- runs ---- */

typedef struct bounds_tally {
    double *tight; /* bound over true change, of changes that are not round-off */
    int count, called, left_out, finite;
} bounds_tally;

typedef struct bounds_score {
    bounds_tally effect[BOUNDS_EFFECTS];
    int devices, without, rows, bare, ended, bad, room;
    double divide; /* all bounds are: above 1 the test must fail */
} bounds_score;

static inline bool bounds_has(const fw_effect_ledger *l, const char *id) {
    for (int i = 0; i < l->count; i++)
        if (strcmp(l->item[i].id, id) == 0) return l->item[i].active;
    return false;
}

/* NULL: it has no motion, because electrodes touch for instance. Rows of equilibria that end are
   what fw_statics_move_scene makes of them: inertia acts; *ended counts them */
static inline const fw_dynamics_motion *bounds_run_at(fw_arena *arena, const rig *r,
                                                      fw_effect_mode mode, const char *list,
                                                      double accuracy, double rtol, int *ended) {
    fw_diags diags = fw_diags_new(arena);
    const fw_dynamics_motion *m = NULL;
    fw_dynamics_motion_options o = {.accuracy = 1e5 * rtol,
                                    .rtol = rtol,
                                    .samples = 2,
                                    .most_steps = 100000,
                                    .effects = {.mode = mode, .list = list}};
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const char *why;
    if (fw_dynamics_check_request(&r->m, &r->scene, &o, &diags) != FW_OK) return NULL;
    if (fw_effects_compile(arena, &r->m, &r->scene, &o.effects, accuracy, &diags, &ledger,
                           &loads) != FW_OK)
        return NULL;
    if (loads.quasi_static) {
        o.rtol = 0;
        if (fw_statics_quasi_static_motion(arena, &r->m, &r->scene, &o, &ledger, &loads, &diags, &m,
                                           &why) == FW_OK)
            return m;
        ++*ended;
        o.rtol = rtol;
        loads.quasi_static = false;
    }
    fw_status status =
        fw_dynamics_simulate_compiled(arena, &r->m, &r->scene, &o, &ledger, &loads, &diags, &m);
    assert_true(status == FW_OK || status == FW_SOLVER || status == FW_INPUT || status == FW_LIMIT);
    return status == FW_OK ? m : NULL;
}

static inline const fw_dynamics_motion *bounds_run(fw_arena *arena, const rig *r,
                                                   fw_effect_mode mode, const char *list,
                                                   double accuracy, int *ended) {
    return bounds_run_at(arena, r, mode, list, accuracy, 1e-9, ended);
}

/* largest difference of any peak over the largest peak of `all`; and what the runs do not know */
static inline double bounds_apart(const fw_dynamics_motion *all, const fw_dynamics_motion *other,
                                  double *unknown) {
    double apart = 0, most = 0, error = 0;
    for (int i = 0; i < all->npin; i++) {
        most = fmax(most, fabs(all->peak[i].angle_rad));
        apart = fmax(apart, fabs(fabs(all->peak[i].angle_rad) - fabs(other->peak[i].angle_rad)));
        error = fmax(error, all->peak[i].error_rad + other->peak[i].error_rad);
    }
    error -= fw_dynamics_motion_left_out(all) +
             fw_dynamics_motion_left_out(other); /* that is what is looked at */
    *unknown = error / most;
    return apart / most;
}

static inline int bounds_effect_index(const char *id) {
    for (int i = 0; i < BOUNDS_EFFECTS; i++)
        if (strcmp(bounds_effects[i].id, id) == 0) return i;
    return -1;
}

typedef struct bounds_trial {
    fw_arena *arena;
    const bounds_device *d;
    uint64_t seed;
    double accuracy;
    const fw_dynamics_motion *all;
    bounds_score *score;
} bounds_trial;

/* Is the change of `other` against all effects within the bound? A violation counts where runs a
   thousand times finer say the same: the errors that runs state of themselves are estimates. */
static inline double bounds_judge(const bounds_trial *t, const fw_dynamics_motion *other,
                                  fw_effect_mode mode, const char *list, double bound,
                                  double *unknown, const char *what) {
    int ended = 0;
    double change = bounds_apart(t->all, other, unknown);
    bound /= t->score->divide;
    if (change <= bound + *unknown) return change;
    const rig *r = &t->d->r;
    const fw_dynamics_motion *all =
        bounds_run_at(t->arena, r, FW_EFFECTS_ALL, NULL, 1e-3, 1e-12, &ended);
    rig bare = *r;
    if (strcmp(what, "tendon") == 0) bare.scene.ntendon = 0;
    other = bounds_run_at(t->arena, &bare, mode, list, t->accuracy, 1e-12, &ended);
    if (all && other) change = bounds_apart(all, other, unknown);
    if (change <= bound + *unknown) return change;
    t->score->bad++;
    print_error("seed %llu: %s changes the peaks by %.4g, its bound is %.4g (runs: %.2g)\n",
                (unsigned long long)t->seed, what, change, bound, *unknown);
    return change;
}

/* all effects but one */
static inline void bounds_but(const fw_effect_ledger *l, int one, char *list, size_t size) {
    list[0] = 0;
    for (int j = 0; j < l->count; j++)
        if (j != one) snprintf(list + strlen(list), size - strlen(list), "%s,", l->item[j].id);
}

/* every effect on its own: left out against its bound */
static inline void bounds_singles(const bounds_trial *t) {
    const fw_effect_ledger *ledger = &t->all->ledger;
    for (int i = 0; i < ledger->count; i++) {
        const fw_effect_entry *e = &ledger->item[i];
        int k = bounds_effect_index(e->id), ended = 0;
        if (k < 0 || !e->called_for) continue;
        bounds_tally *tally = &t->score->effect[k];
        char list[512];
        double unknown;
        tally->called++;
        if (!isfinite(e->bound)) continue;
        tally->finite++;
        bounds_but(ledger, i, list, sizeof list);
        rig bare = t->d->r; /* tendons are kept: what their bound is of is a scene without */
        bool kept = strcmp(e->id, "tendon") == 0;
        if (kept) bare.scene.ntendon = 0;
        const fw_dynamics_motion *without =
            kept ? bounds_run(t->arena, &bare, FW_EFFECTS_ALL, NULL, t->accuracy, &ended)
                 : bounds_run(t->arena, &t->d->r, FW_EFFECTS_LIST, list, t->accuracy, &ended);
        t->score->ended += ended;
        if (ended > 0) continue; /* nothing to compare */
        if (!without) {
            t->score->bad++;
            print_error("seed %llu: no motion without %s, its bound is %.4g\n",
                        (unsigned long long)t->seed, e->id, e->bound);
            continue;
        }
        double change = bounds_judge(t, without, kept ? FW_EFFECTS_ALL : FW_EFFECTS_LIST, list,
                                     e->bound, &unknown, e->id);
        if (change > 3 * unknown && tally->count < t->score->room)
            tally->tight[tally->count++] = e->bound / change;
    }
}

/* auto against all: below the sum of the bounds left out, which is below the accuracy */
static inline void bounds_auto(const bounds_trial *t) {
    double unknown;
    int ended = 0;
    const fw_dynamics_motion *some =
        bounds_run(t->arena, &t->d->r, FW_EFFECTS_AUTO, NULL, t->accuracy, &ended);
    if (!some) {
        t->score->bad++;
        print_error("seed %llu: no motion with auto\n", (unsigned long long)t->seed);
        return;
    }
    for (int i = 0; i < some->ledger.count; i++) {
        int k = bounds_effect_index(some->ledger.item[i].id);
        const fw_effect_entry *e = &some->ledger.item[i];
        if (k >= 0 && e->called_for && !e->active) t->score->effect[k].left_out++;
    }
    t->score->rows += !bounds_has(&some->ledger, "inertia");
    t->score->ended += ended;
    assert_true(some->ledger.left_out < t->accuracy);
    bounds_judge(t, some, FW_EFFECTS_AUTO, NULL, some->ledger.left_out, &unknown, "auto");
}

/* nothing but what belongs to the scene: no bound is promised, but where they are small */
static inline void bounds_none(const bounds_trial *t) {
    double sum = 0, unknown;
    int ended = 0;
    const fw_dynamics_motion *bare =
        bounds_run(t->arena, &t->d->r, FW_EFFECTS_NONE, NULL, t->accuracy, &ended);
    for (int i = 0; bare && i < t->all->ledger.count; i++)
        if (t->all->ledger.item[i].called_for && !bare->ledger.item[i].active)
            sum += t->all->ledger.item[i].bound;
    if (!bare || ended > 0 || !(sum < 0.2)) return;
    t->score->bare++;
    bounds_judge(t, bare, FW_EFFECTS_NONE, NULL, sum, &unknown, "none");
}

static inline void bounds_try(uint64_t seed, bounds_score *score) {
    static bounds_device d;
    uint64_t more = seed ^ 0x5555;
    int ended = 0;
    bounds_trial t = {.arena = fw_arena_new(0), .d = &d, .seed = seed, .score = score};
    if (bounds_make(t.arena, seed, &d)) {
        t.accuracy = bounds_log(&more, 1e-4, 0.1);
        t.all = bounds_run(t.arena, &d.r, FW_EFFECTS_ALL, NULL, 1e-3, &ended);
        score->devices++;
        score->without += !t.all;
        if (t.all) {
            bounds_auto(&t);
            bounds_none(&t);
            bounds_singles(&t);
        }
    }
    fw_arena_free(t.arena);
}

static inline int bounds_by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* prints how tight the bounds are; the largest number of violations that is right is none */
static inline void bounds_check(uint64_t first, int count) {
    fw_arena *arena = fw_arena_new(0);
    const char *divide = getenv("FW_BOUNDS_DIVIDE");
    bounds_score score = {.room = count, .divide = divide ? atof(divide) : 1};
    for (int i = 0; i < BOUNDS_EFFECTS; i++)
        score.effect[i].tight = fw_arena_array(arena, double, (size_t)count);
    for (int i = 0; i < count; i++)
        bounds_try(first + (uint64_t)i, &score);
    print_message(
        "%d devices, %d of them without a motion; auto left inertia out in %d, none judged "
        "in %d; rows of equilibria that ended: %d\n",
        score.devices, score.without, score.rows, score.bare, score.ended);
    print_message("bound over true change: least, 10 %%, half, 90 %%\n");
    for (int i = 0; i < BOUNDS_EFFECTS; i++) {
        bounds_tally *t = &score.effect[i];
        qsort(t->tight, (size_t)t->count, sizeof *t->tight, bounds_by_size);
        print_message("  %-18s in %d, bounded in %d, left out by auto in %d;", bounds_effects[i].id,
                      t->called, t->finite, t->left_out);
        if (t->count > 0)
            print_message(" %.3g %.3g %.3g %.3g (%d)", t->tight[0], t->tight[t->count / 10],
                          t->tight[t->count / 2], t->tight[t->count * 9 / 10], t->count);
        print_message("\n");
    }
    print_message("%d violations\n", score.bad);
    assert_int_equal(score.bad, 0);
    fw_arena_free(arena);
}

#endif
