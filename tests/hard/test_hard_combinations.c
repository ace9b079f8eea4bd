/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every effect with every other one: random mechanisms in scenes that draw their effects, laws,
   method, integrator and tolerance by lot. Each must end, or say why not; nothing may be without a
   number; and the energies must close: what is stored, lost and fed in by whatever acts, through
   all events and jumps of laws. A seed alone: FW_HARD_CASE=n. */
#include "quantity/law_kind.h"
#include "hard.h"

static const double NOT = (double)NAN;
static uint64_t seed;

static double lot(double from, double to) {
    return from + (to - from) * rig_random(&seed);
}
static bool chance(double share) {
    return rig_random(&seed) < share;
}
static double decades(double low, double high) {
    return pow(10, lot(low, high));
}
static int body_of(const rig *r) {
    return (int)(r->m.nbody * rig_random(&seed));
}

/* ---- laws ---- */

/* smooth; with a corner; that jumps */
static const fw_quantity_law *any_law(fw_arena *arena, double end_s, bool jumps) {
    fw_quantity_law *law = fw_arena_one(arena, fw_quantity_law);
    double *t = fw_arena_array(arena, double, 6), *v = fw_arena_array(arena, double, 6);
    switch ((int)lot(0, jumps ? 5 : 3)) {
    case 0:
        *law = (fw_quantity_law){.kind = &fw_quantity_law_sine,
                                 .frequency_Hz = lot(0.5, 8) / end_s,
                                 .end_s = (double)INFINITY};
        break;
    case 1:
        *law = hard_law(arena, "1 - cos(2000 rad/s * t)", (fw_quantity_dimension){0});
        break;
    case 2: /* corners */
        for (int i = 0; i < 6; i++)
            t[i] = i * end_s / 5, v[i] = i ? lot(-1, 1) : 0;
        *law = (fw_quantity_law){
            .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = v, .ntable = 6};
        break;
    case 3:
        *law = (fw_quantity_law){
            .kind = &fw_quantity_law_step, .start_s = lot(0, end_s), .end_s = (double)INFINITY};
        break;
    default:
        *law = (fw_quantity_law){.kind = &fw_quantity_law_step, .start_s = lot(0, end_s / 2)};
        law->end_s = lot(law->start_s + 0.1 * end_s, end_s);
    }
    return law;
}

/* ---- effects, one function each; all may be there together ---- */

static void some_friction(fw_arena *arena, rig *r) {
    fw_device_scene *s = &r->scene;
    s->friction = fw_arena_array(arena, fw_device_friction_use, 32);
    for (int i = 0; i < r->m.npin; i++)
        if (chance(0.5)) {
            double mu = lot(0.05, 0.35);
            s->friction[s->nfriction++] =
                (fw_device_friction_use){.revolute = i,
                                         .joint = FW_NONE,
                                         .coefficient = mu,
                                         .static_coefficient = chance(0.5) ? NOT : mu * lot(1, 2),
                                         .radius_m = decades(-5.5, -4),
                                         .preload_N = chance(0.5) ? 0 : 3e-3 * lot(0, 1)};
        }
}

static void some_contact(fw_arena *arena, rig *r) {
    fw_device_scene *s = &r->scene;
    s->contact = fw_arena_array(arena, fw_device_contact_use, 8);
    for (int n = 1 + (int)lot(0, 3); n > 0; n--) {
        int b = body_of(r), a = chance(0.5) ? FW_GROUND : body_of(r);
        if (a == b) a = FW_GROUND;
        bool inside = chance(0.5);
        fw_device_contact_use u = {.id = "touch",
                                   .joint = FW_NONE,
                                   .side = inside ? FW_CONTACT_INSIDE : FW_CONTACT_OUTSIDE,
                                   .body_a = a,
                                   .body_b = b,
                                   .bx_m = lot(-3e-4, 3e-4),
                                   .by_m = lot(-3e-4, 3e-4),
                                   .stiffness_N_per_m = decades(0.5, 4),
                                   .damping_Ns_per_m = chance(0.5) ? 0 : decades(-7, -4)};
        fw_geometry_vec2 at = fw_mechanism_local_place(&r->m, b, u.bx_m, u.by_m);
        hard_local(r, a, at.x + lot(-1e-3, 1e-3), at.y + lot(-1e-3, 1e-3), &u.ax_m, &u.ay_m);
        fw_geometry_vec2 from = fw_mechanism_local_place(&r->m, a, u.ax_m, u.ay_m);
        double now = hypot(at.x - from.x, at.y - from.y), gap = lot(-2e-6, 1e-4);
        u.distance_m = inside ? now + gap : fmax(0.1 * now, now - gap);
        s->contact[s->ncontact++] = u;
    }
}

static void some_tendons(fw_arena *arena, rig *r) {
    fw_device_scene *s = &r->scene;
    s->tendon = fw_arena_array(arena, fw_device_tendon, 4);
    for (int n = 1 + (int)lot(0, 2); n > 0; n--) {
        fw_device_tendon *t = &s->tendon[s->ntendon++];
        bool pulled = chance(0.5);
        *t = (fw_device_tendon){.id = "tendon",
                                .eyelet = fw_arena_array(arena, fw_device_eyelet, 4),
                                .neyelet = 2 + (int)lot(0, 3),
                                .pull_N = pulled ? decades(-5, -3.3) : NOT,
                                .draw_m = pulled ? NOT : -lot(0, 4e-5),
                                .stiffness_N_per_m = decades(0, 3),
                                .damping_Ns_per_m = chance(0.5) ? 0 : decades(-7, -4),
                                .slack_m = lot(-2e-6, 3e-5),
                                .law = any_law(arena, s->duration_s, chance(0.5))};
        for (int i = 0; i < t->neyelet; i++) {
            int b = i == 0 ? FW_GROUND : body_of(r);
            t->eyelet[i] =
                (fw_device_eyelet){.body = b,
                                   .x_m = b == FW_GROUND ? lot(-2e-3, -1e-3) : lot(-4e-4, 4e-4),
                                   .y_m = lot(-4e-4, 4e-4)};
        }
    }
}

static void some_cables(fw_arena *arena, rig *r) {
    r->m.spring = fw_arena_array(arena, fw_device_spring, 8);
    for (int n = 1 + (int)lot(0, 3); n > 0; n--) {
        int b = body_of(r);
        const fw_mechanism_mass *m = &r->m.body[b];
        double x = m->x_m + lot(-2e-3, 2e-3), y = m->y_m + lot(1e-3, 2e-3);
        fw_device_spring *s = rig_spring(r, "line", FW_GROUND, x, y, b, 0, 0, decades(-0.5, 3),
                                         hypot(x - m->x_m, y - m->y_m) * lot(0.98, 1.05));
        s->cable = chance(0.7), s->damping_Ns_per_m = chance(0.5) ? 0 : decades(-7, -4);
    }
}

static void some_stops(rig *r) {
    for (int i = 0; i < r->m.npin; i++)
        if (chance(0.4)) {
            fw_mechanism_pin *p = &r->m.pin[i];
            p->stop_min_rad = chance(0.2) ? NOT : -lot(0.005, 0.2);
            p->stop_max_rad = chance(0.2) ? NOT : lot(0.005, 0.2);
            p->stop_stiffness_Nm_per_rad = decades(-5.5, -2);
            p->stop_damping_Nms_per_rad = chance(0.5) ? 0 : decades(-12, -9);
        }
}

static void some_combs(fw_arena *arena, rig *r) {
    fw_device_scene *s = &r->scene;
    s->comb = fw_arena_array(arena, fw_device_comb, 2);
    int b = body_of(r);
    s->comb[s->ncomb++] = (fw_device_comb){.id = "comb",
                                           .kind = FW_ELECTRODES_COMB,
                                           .body_a = FW_GROUND,
                                           .body_b = b,
                                           .direction_rad = lot(0, 6),
                                           .fingers = 20,
                                           .gap_m = 2e-2, /* no pull-in: it moves by less */
                                           .overlap_m = 3e-3,
                                           .length_m = 1, /* nor does it reach a root as it turns */
                                           .depth_m = 50e-6,
                                           .voltage_V = decades(1, 2),
                                           .law = any_law(arena, s->duration_s, chance(0.5))};
}

static void some_air(fw_arena *arena, rig *r) {
    fw_device_scene *s = &r->scene;
    s->air = fw_arena_array(arena, fw_device_air, 4);
    for (int n = 1 + (int)lot(0, 2); n > 0; n--)
        s->air[s->nair++] = (fw_device_air){.kind = FW_AIR_SLIDE,
                                            .body = body_of(r),
                                            .against = FW_GROUND,
                                            .gap_m = decades(-6, -4.5),
                                            .area_m2 = decades(-8, -6.5),
                                            .x_m = NOT,
                                            .y_m = NOT,
                                            .direction_rad = NOT,
                                            .length_m = NOT,
                                            .depth_m = NOT,
                                            .pressure_Pa = NOT,
                                            .temperature_K = NOT,
                                            .viscosity_Pas = NOT};
}

static void some_loads(fw_arena *arena, rig *r) {
    fw_device_scene *s = &r->scene;
    for (int i = 0; i < s->nforce; i++)
        if (chance(0.5)) s->force[i].law = any_law(arena, s->duration_s, true);
    for (int i = 0; i < s->ntorque; i++)
        if (chance(0.5)) s->torque[i].law = any_law(arena, s->duration_s, true);
    if (chance(0.5)) s->gravity = true, s->gx_m_per_s2 = lot(-9, 9), s->gy_m_per_s2 = lot(-9, 9);
    if (chance(0.5)) {
        s->base = fw_arena_array(arena, fw_device_base_motion, 1);
        s->base[s->nbase++] = (fw_device_base_motion){.ax_m_per_s2 = lot(-100, 100),
                                                      .ay_m_per_s2 = lot(-100, 100),
                                                      .law = any_law(arena, s->duration_s, true)};
    }
    if (chance(0.3)) {
        s->temperature = fw_arena_array(arena, fw_device_temperature, 1);
        s->temperature[s->ntemperature++] =
            (fw_device_temperature){.change_K = lot(-200, 200),
                                    .expansion_per_K = 2e-5,
                                    .substrate_expansion_per_K = chance(0.5) ? 0 : 3e-5,
                                    .modulus_change_per_K = chance(0.5) ? 0 : -6e-5,
                                    .law = any_law(arena, s->duration_s, false)};
    }
}

static rig any_scene(fw_arena *arena, int c, char *what) {
    seed = 1000003 * (uint64_t)(c + 1);
    rig r = rig_any(arena, seed);
    (void)lot(0, 1);
    r.scene.duration_s = lot(1e-3, 6e-3);
    some_loads(arena, &r);
    const char *at = what;
    if (chance(0.5)) some_friction(arena, &r), *what++ = 'f';
    if (chance(0.5)) some_contact(arena, &r), *what++ = 'c';
    if (chance(0.4)) some_tendons(arena, &r), *what++ = 't';
    if (chance(0.4)) some_cables(arena, &r), *what++ = 'r';
    if (chance(0.5)) some_stops(&r), *what++ = 's';
    if (chance(0.3)) some_combs(arena, &r), *what++ = 'e';
    if (chance(0.4)) some_air(arena, &r), *what++ = 'a';
    bool closed = r.m.pin[r.m.npin - 1].body_b == FW_GROUND ||
                  (r.m.npin > 1 && r.m.pin[r.m.npin - 2].body_b == FW_GROUND);
    if (!closed && chance(0.3)) {
        fw_quantity_law law = hard_law(
            arena, chance(0.5) ? "0.2 rad * sin(2000 rad/s * t)" : "0.1 rad * min(1, t / 1e-3 s)",
            (fw_quantity_dimension){.rad = 1});
        hard_driver(arena, &r, "motor", 0, FW_NONE, law), *what++ = 'd';
    }
    if (r.scene.nbase) *what++ = 'b';
    if (r.scene.ntemperature) *what++ = 'T';
    if (what == at) *what++ = '-';
    *what = 0;
    return r;
}

/* ---- the lot of them ---- */

/* gsl-bsimp is left out: its dense output, which events need, takes some 30 ms a step */
typedef struct tool {
    const char *name;
    double least, allowed; /* rtol; energy_error / rtol */
} tool;
static const tool integrator[] = {{"dop853", 1e-11, 3e4},  {"dop853", 1e-8, 3e4},
                                  {NULL, 1e-8, 3e4},       {"dopri5", 1e-8, 3e4},
                                  {"radau5", 1e-8, 1e5},   {"gsl-rk8pd", 1e-9, 1e5},
                                  {"gsl-rkf45", 1e-8, 1e5}};
static const char *const method[] = {"chain", "chain",     "coordinate-partitioning",
                                     "svd",   "qr",        "udwadia-kalaba",
                                     "schur", "augmented", "block-least-squares"};
enum {
    TOOLS = sizeof integrator / sizeof integrator[0],
    METHODS = sizeof method / sizeof method[0]
};

static void check_numbers(const fw_dynamics_motion *m) {
    for (int k = 0; k < m->nsample; k++)
        for (int i = 0; i < 3 * m->nbody; i++)
            assert_true(isfinite(hard_q(m, k)[i]) && isfinite(hard_v(m, k)[i]));
    for (int i = 0; i < m->npin; i++)
        assert_true(isfinite(m->peak[i].angle_rad) && isfinite(m->peak[i].error_rad));
}

static void combinations(void **state) {
    (void)state;
    const char *one = getenv("FW_HARD_CASE");
    int from = one ? atoi(one) : 0, to = one ? from + 1 : hard_quick() ? 5 : 24;
    int refused = 0, failed = 0;
    long events = 0, steps = 0;
    double worst = 0;
    for (int c = from; c < to; c++) {
        fw_arena *arena = fw_arena_new(0);
        char what[16];
        rig r = any_scene(arena, c, what);
        const tool *by = &integrator[(int)lot(0, TOOLS)];
        fw_dynamics_motion_options o = {.integrator = by->name,
                                        .method = method[(int)lot(0, METHODS)],
                                        .rtol = by->least * decades(0, 1),
                                        .most_steps = 100000,
                                        .samples = 21};
        outcome out = hard_try(arena, &r, o);
        if (out.status != FW_OK) {
            print_message("%d %s by %s, %s: %s\n", c, what, o.method,
                          by->name ? by->name : "(auto)", out.message);
            refused += out.number == 244 || out.number == 242;
            failed += out.number != 244 && out.number != 242;
        } else {
            check_numbers(out.m);
            const fw_dynamics_motion_stats *s = &out.m->stats;
            double share = s->energy_error / (by->allowed * s->rtol);
            if (share > 1 || one || s->cpu_s > 1)
                print_message("%d %s by %s, %s: rtol %.1e, energy %.1e, %ld events, %ld steps, "
                              "%.1f s\n",
                              c, what, o.method, out.m->integrator, s->rtol, s->energy_error,
                              s->events, s->steps, s->cpu_s);
            failed += share > 1;
            worst = fmax(worst, share);
            events += s->events, steps += s->steps;
        }
        fw_arena_free(arena);
    }
    print_message("%d scenes: %ld events, %ld steps; energies up to %.2f of what is allowed; %d "
                  "refused\n",
                  to - from, events, steps, worst, refused);
    assert_int_equal(failed, 0);
    assert_true(refused <= (to - from) / 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(combinations)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
