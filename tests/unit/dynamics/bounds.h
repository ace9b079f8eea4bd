/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Are the bounds of the effects honest? Random devices and scenes, each run with all effects, with
   those that auto keeps, and with each one left out: what changes must stay within the bounds.

   A new effect takes part with one row in bounds_effects: a function that gives the device or the
   scene a random element of its kind. */
#ifndef FW_TESTS_BOUNDS_H
#define FW_TESTS_BOUNDS_H
#include "models.h"
#include <stdio.h>
#include <stdlib.h>

enum { BOUNDS_LOADS = 8 };

typedef struct bounds_device {
    rig r;
    double turn;  /* rad: wanted of the static response to the loads */
    double omega; /* rad/s: about the lowest */
    fw_law law[BOUNDS_LOADS];
    double table_t[BOUNDS_LOADS][4], table_v[BOUNDS_LOADS][4];
    int laws;
} bounds_device;

/* from a to b, evenly in its logarithm */
static inline double bounds_log(uint64_t *seed, double a, double b) {
    return a * pow(b / a, rig_random(seed));
}

static inline double bounds_sign(uint64_t *seed) {
    return rig_random(seed) < 0.5 ? -1 : 1;
}

/* ---- devices ---- */

static inline rig bounds_six_bar(fw_arena *arena, uint64_t *seed) {
    rig r = rig_six_bar(arena, false);
    for (int i = 0; i < r.m.npin; i++) {
        r.m.pin[i].stiffness_Nm_per_rad *= bounds_log(seed, 0.3, 3);
        r.m.pin[i].damping_Nms_per_rad = 0;
    }
    for (int b = 0; b < r.m.nbody; b++) {
        double f = bounds_log(seed, 0.5, 2);
        r.m.body[b].mass_kg *= f, r.m.body[b].inertia_kg_m2 *= f;
    }
    r.scene.nforce = r.scene.ntorque = 0;
    return r;
}

/* n bodies in a row from the ground, closed at the end or not */
static inline rig bounds_row(fw_arena *arena, uint64_t *seed, int n, bool closed) {
    rig r = rig_new(arena, n, n + 1, 1);
    double x = 0, y = 0, angle = 1.5 * rig_random(seed);
    for (int i = 0; i < n; i++) {
        double l = 1e-3 * bounds_log(seed, 0.5, 2), m = 1e-8 * bounds_log(seed, 0.3, 3);
        double dx = l * cos(angle), dy = l * sin(angle);
        rig_body(&r, "link", m, m * l * l * (0.06 + 0.1 * rig_random(seed)), x + dx / 2, y + dy / 2,
                 0.5 * rig_random(seed));
        rig_pin(&r, "pin", i - 1, i, x, y, 1e-6 * bounds_log(seed, 0.3, 3), 0);
        x += dx, y += dy;
        angle -= closed ? 0.6 + 1.2 * rig_random(seed) : rig_random(seed) - 0.5;
    }
    if (closed) rig_pin(&r, "end", n - 1, FW_GROUND, x, y, 1e-6 * bounds_log(seed, 0.3, 3), 0);
    return r;
}

static inline rig bounds_four_bar(fw_arena *arena, uint64_t *seed) {
    return bounds_row(arena, seed, 3, true);
}

static inline rig bounds_chain(fw_arena *arena, uint64_t *seed) {
    return bounds_row(arena, seed, 1 + (int)(5 * rig_random(seed)), false);
}

/* a chain whose end slides on the ground, with a spring along or a point spring */
static inline rig bounds_slider(fw_arena *arena, uint64_t *seed) {
    rig r = bounds_row(arena, seed, 2, false);
    fw_mass *last = &r.m.body[1];
    r.m.tie = fw_arena_array(arena, fw_tie, 1);
    r.m.tie[r.m.ntie++] = (fw_tie){.id = "slide",
                                   .kind = FW_TIE_DISTANCE,
                                   .body_a = FW_GROUND,
                                   .body_b = 1,
                                   .ax_m = last->x_m + 1e-3 * (0.5 + rig_random(seed)),
                                   .ay_m = last->y_m - 1e-3 * rig_random(seed)};
    r.m.tie[0].length_m = hypot(r.m.tie[0].ax_m - last->x_m, r.m.tie[0].ay_m - last->y_m);
    if (rig_random(seed) < 0.5) return r;
    /* prismatic: a third body between the chain's end and the ground */
    rig p = bounds_row(arena, seed, 3, false);
    double axis = 0.7 * rig_random(seed);
    p.m.tie = r.m.tie;
    p.m.ntie = 1;
    p.m.tie[0] = (fw_tie){.id = "slide",
                          .kind = FW_TIE_PRISMATIC,
                          .body_a = FW_GROUND,
                          .body_b = 2,
                          .ax_m = p.m.body[2].x_m,
                          .ay_m = p.m.body[2].y_m,
                          .axis_rad = axis,
                          .angle_rad = p.m.body[2].phi_rad,
                          .stiffness_N_per_m = bounds_log(seed, 0.1, 10)};
    return p;
}

static rig (*const bounds_devices[])(fw_arena *, uint64_t *) = {bounds_six_bar, bounds_four_bar,
                                                                bounds_chain, bounds_slider};

/* ---- loads ---- */

static inline const fw_law *bounds_law(bounds_device *d, uint64_t *seed) {
    double t = d->r.scene.duration_s, kind = rig_random(seed);
    if (kind < 0.4 || d->laws == BOUNDS_LOADS) return NULL;
    fw_law *l = &d->law[d->laws];
    double *at = d->table_t[d->laws], *value = d->table_v[d->laws];
    d->laws++;
    *l = (fw_law){.kind = FW_LAW_STEP,
                  .start_s = rig_random(seed) < 0.5 ? 0 : 0.4 * t * rig_random(seed),
                  .end_s = (double)INFINITY};
    if (kind < 0.55) {
        if (rig_random(seed) < 0.5) l->end_s = l->start_s + 0.5 * t * rig_random(seed);
    } else if (kind < 0.7) {
        l->kind = FW_LAW_RAMP;
        l->rise_s = bounds_log(seed, 0.01, 2) * t;
    } else if (kind < 0.85) {
        l->kind = FW_LAW_SINE;
        l->frequency_Hz = bounds_log(seed, 0.1, 3) * d->omega / 6.28;
        l->phase_rad = 3 * rig_random(seed);
    } else {
        l->kind = FW_LAW_TABLE;
        l->ntable = 4;
        l->table_t_s = at, l->table_value = value;
        for (int i = 0; i < 4; i++) {
            at[i] = t * (i + 0.8 * rig_random(seed)) / 4;
            value[i] = 2 * rig_random(seed) - 1;
        }
    }
    return l;
}

static inline void bounds_add_loads(bounds_device *d, uint64_t *seed) {
    rig *r = &d->r;
    int count = 1 + (int)(3 * rig_random(seed));
    for (int i = 0; i < count; i++) {
        int b = (int)(r->m.nbody * rig_random(seed));
        if (rig_random(seed) < 0.5 && r->scene.ntorque < r->m.nbody) {
            rig_torque(r, b, bounds_sign(seed) * bounds_log(seed, 0.1, 1));
            r->scene.torque[r->scene.ntorque - 1].law = bounds_law(d, seed);
        } else if (r->scene.nforce < r->m.nbody) {
            rig_force(r, b, 1e3 * (2 * rig_random(seed) - 1), 1e3 * (2 * rig_random(seed) - 1));
            fw_force *f = &r->scene.force[r->scene.nforce - 1];
            f->law = bounds_law(d, seed);
            if (rig_random(seed) < 0.5) f->x_m = 5e-4 * (2 * rig_random(seed) - 1);
        }
    }
}

static inline double bounds_static(fw_arena *arena, const rig *r, double *omega) {
    fw_effect_ledger ledger;
    fw_terms terms;
    fw_diags diags = fw_diags_new(arena);
    const fw_effect_choice choice = {FW_EFFECTS_NONE, NULL};
    double force[60], u[60], turn[40], most = 0, work = 0, mass = 0;
    bool valid;
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &choice, 1e-3, &diags, &ledger, &terms), FW_OK);
    fw_terms_largest_force(&r->m, &terms, r->scene.duration_s, force);
    assert_int_equal(fw_static_response(arena, &r->m, &terms, force, u, turn, &valid), FW_OK);
    for (int i = 0; i < r->m.npin && valid; i++)
        most = fmax(most, fabs(turn[i]));
    for (int i = 0; i < 3 * r->m.nbody && valid; i++) {
        const fw_mass *b = &r->m.body[i / 3];
        work += force[i] * u[i];
        mass += (i % 3 == 2 ? b->inertia_kg_m2 : b->mass_kg) * u[i] * u[i];
    }
    *omega = work > 0 ? sqrt(work / mass) : 0;
    return most;
}

/* the loads so that the static response to the largest of them turns some pin by d->turn */
static inline bool bounds_scale_loads(fw_arena *arena, bounds_device *d) {
    double turn = bounds_static(arena, &d->r, &d->omega);
    if (!(turn > 0) || !(d->omega > 0)) return false;
    fw_scene *s = &d->r.scene;
    for (int i = 0; i < s->nforce; i++)
        s->force[i].fx_N *= d->turn / turn, s->force[i].fy_N *= d->turn / turn;
    for (int i = 0; i < s->ntorque; i++)
        s->torque[i].value_Nm *= d->turn / turn;
    return true;
}

/* ---- effects: one row each ---- */

static inline void bounds_gravity(bounds_device *d, uint64_t *seed) {
    /* m g r of the order of a share of k times turn */
    double share = bounds_log(seed, 1e-5, 1) * d->turn, angle = 6.283 * rig_random(seed);
    double g = share * 1e-6 / (1e-8 * 1e-3);
    d->r.scene.gravity = true;
    d->r.scene.gx_m_per_s2 = g * cos(angle), d->r.scene.gy_m_per_s2 = g * sin(angle);
}

static inline void bounds_joint_damping(bounds_device *d, uint64_t *seed) {
    double zeta = bounds_log(seed, 1e-6, 0.3);
    for (int i = 0; i < d->r.m.npin; i++)
        d->r.m.pin[i].damping_Nms_per_rad =
            2 * zeta / d->omega * d->r.m.pin[i].stiffness_Nm_per_rad * bounds_log(seed, 0.3, 3);
    for (int i = 0; i < d->r.m.ntie; i++)
        if (d->r.m.tie[i].kind == FW_TIE_PRISMATIC)
            d->r.m.tie[i].damping_Ns_per_m =
                2 * zeta / d->omega * d->r.m.tie[i].stiffness_N_per_m * rig_random(seed);
}

static inline void bounds_joint_stop(bounds_device *d, uint64_t *seed) {
    int i = (int)(d->r.m.npin * rig_random(seed));
    fw_pin *p = &d->r.m.pin[i];
    double phi_a = p->body_a == FW_GROUND ? 0 : d->r.m.body[p->body_a].phi_rad;
    double phi_b = p->body_b == FW_GROUND ? 0 : d->r.m.body[p->body_b].phi_rad;
    p->stop_stiffness_Nm_per_rad = 1e-4;
    p->stop_min_rad = (double)NAN;
    p->stop_max_rad = phi_b - phi_a - p->free_angle_rad + d->turn * bounds_log(seed, 0.5, 30);
}

typedef struct bounds_effect {
    const char *id;
    double chance;
    void (*add)(bounds_device *d, uint64_t *seed);
} bounds_effect;

static const bounds_effect bounds_effects[] = {
    {"gravity", 0.6, bounds_gravity},
    {"joint-damping", 0.7, bounds_joint_damping},
    {"joint-stop", 0.15, bounds_joint_stop},
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
        const fw_pin *p = &d->r.m.pin[i];
        double a = p->body_a == FW_GROUND ? 0 : d->r.m.body[p->body_a].phi_rad;
        double b = p->body_b == FW_GROUND ? 0 : d->r.m.body[p->body_b].phi_rad;
        d->r.m.pin[i].free_angle_rad = b - a;
    }
    uint64_t again = seed;
    bounds_add_loads(d, &seed);
    if (!bounds_scale_loads(arena, d)) return false;
    /* again with the duration and the frequency known, which the laws go by */
    d->r.scene.duration_s = bounds_log(&seed, 2, 80) / d->omega;
    d->laws = d->r.scene.nforce = d->r.scene.ntorque = 0;
    bounds_add_loads(d, &again);
    if (!bounds_scale_loads(arena, d)) return false;
    if (rig_random(&seed) < 0.2) {
        int b = (int)(d->r.m.nbody * rig_random(&seed));
        rig_velocity(&d->r, b, 0, 0, d->turn * d->omega * rig_random(&seed));
        d->r.scene.initial[0].moves_free = true;
    }
    for (int i = 0; i < BOUNDS_EFFECTS; i++)
        if (rig_random(&seed) < bounds_effects[i].chance) bounds_effects[i].add(d, &seed);
    return true;
}

/* ---- runs ---- */

typedef struct bounds_tally {
    double *tight; /* bound over true change, of changes that are not round-off */
    int count, called, left_out, finite;
} bounds_tally;

typedef struct bounds_score {
    bounds_tally effect[BOUNDS_EFFECTS];
    int devices, bad, room;
} bounds_score;

static inline const fw_motion *bounds_run(fw_arena *arena, const rig *r, fw_effect_mode mode,
                                          const char *list, double accuracy) {
    fw_diags diags = fw_diags_new(arena);
    const fw_motion *m = NULL;
    const fw_motion_options o = {
        .accuracy = accuracy, .rtol = 1e-9, .samples = 2, .effects = {mode, list}};
    assert_int_equal(fw_simulate(arena, &r->m, &r->scene, &o, &diags, &m), FW_OK);
    return m;
}

/* largest difference of any peak over the largest peak of `all`; and what the runs do not know */
static inline double bounds_apart(const fw_motion *all, const fw_motion *other, double *unknown) {
    double apart = 0, most = 0, error = 0;
    for (int i = 0; i < all->npin; i++) {
        most = fmax(most, fabs(all->peak[i].angle_rad));
        apart = fmax(apart, fabs(fabs(all->peak[i].angle_rad) - fabs(other->peak[i].angle_rad)));
        error = fmax(error, all->peak[i].error_rad + other->peak[i].error_rad);
    }
    error -= fw_motion_left_out(all) + fw_motion_left_out(other); /* that is what is looked at */
    *unknown = error / most;
    return apart / most;
}

static inline int bounds_effect_index(const char *id) {
    for (int i = 0; i < BOUNDS_EFFECTS; i++)
        if (strcmp(bounds_effects[i].id, id) == 0) return i;
    return -1;
}

/* every effect on its own: left out against its bound */
static inline void bounds_singles(fw_arena *arena, const bounds_device *d, uint64_t seed,
                                  const fw_motion *all, bounds_score *score) {
    for (int i = 0; i < all->ledger.count; i++) {
        const fw_effect_entry *e = &all->ledger.item[i];
        int k = bounds_effect_index(e->id);
        if (k < 0 || !e->called_for) continue;
        score->effect[k].called++;
        if (!isfinite(e->bound)) continue;
        score->effect[k].finite++;
        char list[512] = "";
        for (int j = 0; j < all->ledger.count; j++)
            if (j != i)
                snprintf(list + strlen(list), sizeof list - strlen(list), "%s,",
                         all->ledger.item[j].id);
        double unknown,
            change =
                bounds_apart(all, bounds_run(arena, &d->r, FW_EFFECTS_LIST, list, 1e-3), &unknown);
        if (change > e->bound + unknown) {
            score->bad++;
            print_error("seed %llu: %s changes the peaks by %.4g, its bound is %.4g (runs: %.2g)\n",
                        (unsigned long long)seed, e->id, change, e->bound, unknown);
        }
        if (change > 3 * unknown && score->effect[k].count < score->room)
            score->effect[k].tight[score->effect[k].count++] = e->bound / change;
    }
}

static inline void bounds_try(uint64_t seed, bounds_score *score) {
    fw_arena *arena = fw_arena_new(0);
    static bounds_device d;
    uint64_t more = seed ^ 0x5555;
    if (bounds_make(arena, seed, &d)) {
        double accuracy = bounds_log(&more, 1e-4, 0.3), unknown;
        const fw_motion *all = bounds_run(arena, &d.r, FW_EFFECTS_ALL, NULL, 1e-3);
        const fw_motion *some = bounds_run(arena, &d.r, FW_EFFECTS_AUTO, NULL, accuracy);
        double change = bounds_apart(all, some, &unknown);
        score->devices++;
        for (int i = 0; i < some->ledger.count; i++) {
            int k = bounds_effect_index(some->ledger.item[i].id);
            const fw_effect_entry *e = &some->ledger.item[i];
            if (k >= 0 && e->called_for && !e->active) score->effect[k].left_out++;
        }
        assert_true(some->ledger.left_out < accuracy);
        if (change > some->ledger.left_out + unknown) {
            score->bad++;
            print_error("seed %llu: the peaks change by %.4g, the sum of bounds is %.4g\n",
                        (unsigned long long)seed, change, some->ledger.left_out);
        }
        bounds_singles(arena, &d, seed, all, score);
    }
    fw_arena_free(arena);
}

static inline int bounds_by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* prints how tight the bounds are; the largest number of violations that is right is none */
static inline void bounds_check(uint64_t first, int count) {
    fw_arena *arena = fw_arena_new(0);
    bounds_score score = {.room = count};
    for (int i = 0; i < BOUNDS_EFFECTS; i++)
        score.effect[i].tight = fw_arena_array(arena, double, (size_t)count);
    for (int i = 0; i < count; i++)
        bounds_try(first + (uint64_t)i, &score);
    print_message("%d devices; bound over true change: least, 10 %%, half, 90 %%\n", score.devices);
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
    assert_int_equal(score.bad, 0);
    fw_arena_free(arena);
}

#endif
