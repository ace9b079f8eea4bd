/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tangent is the derivative of G^T lambda - Q, which other files compute. */
#include "quantity/law_kind.h"
#include "statics/statics_equilibrium.h"
#include "multibody/systems.h"

enum { BODIES = 5, N = 3 * BODIES };

typedef struct plant { /* bodies with every joint and every force, at random */
    rig r;
    fw_effects_loads loads;
    fw_quantity_law ramp, drive;
    fw_multibody_system *sys;
} plant;

static double pick(uint64_t *seed) {
    return 2 * rig_random(seed) - 1;
}

static int other_body(uint64_t *seed, int not ) {
    for (;;) {
        int b = (int)(rig_random(seed) * (BODIES + 1)) - 1;
        if (b != not ) return b;
    }
}

static void random_joints(fw_arena *arena, plant *p, uint64_t *seed) {
    fw_mechanism *m = &p->r.m;
    m->joint = fw_arena_array(arena, fw_device_joint, 3);
    m->njoint = 3;
    for (int i = 0; i < 3; i++) {
        int a = other_body(seed, 99);
        m->joint[i] = (fw_device_joint){.id = "tie",
                                        .kind = (fw_device_joint_kind)i,
                                        .body_a = a,
                                        .body_b = other_body(seed, a),
                                        .ax_m = pick(seed),
                                        .ay_m = pick(seed),
                                        .bx_m = pick(seed),
                                        .by_m = pick(seed),
                                        .axis_rad = 3 * pick(seed),
                                        .angle_rad = pick(seed),
                                        .length_m = 1 + pick(seed),
                                        .free_length_m = pick(seed)};
    }
    p->drive = (fw_quantity_law){
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 0.1};
    m->driver = fw_arena_array(arena, fw_device_driver, 2);
    m->ndriver = 2;
    m->driver[0] =
        (fw_device_driver){.id = "turn", .revolute = 0, .joint = FW_NONE, .law = p->drive};
    m->driver[1] =
        (fw_device_driver){.id = "travel", .revolute = FW_NONE, .joint = 0, .law = p->drive};
}

static void random_terms(fw_arena *arena, plant *p, uint64_t *seed) {
    fw_effects_loads *t = &p->loads;
    const fw_mechanism *m = &p->r.m;
    *t = (fw_effects_loads){.nbody = BODIES};
    t->constant = fw_arena_array(arena, double, N);
    t->velocity = fw_arena_array(arena, double, N);
    t->torsion = fw_arena_array(arena, fw_effects_torsion, 8);
    t->stop = fw_arena_array(arena, fw_effects_stop, 8);
    t->load = fw_arena_array(arena, fw_effects_point_load, 8);
    t->timed = fw_arena_array(arena, fw_effects_timed_load, 8);
    t->spring = fw_arena_array(arena, fw_device_spring, 8);
    t->slide = fw_arena_array(arena, fw_effects_slide, 1);
    for (int i = 0; i < N; i++)
        t->constant[i] = pick(seed);
    p->ramp =
        (fw_quantity_law){.kind = &fw_quantity_law_ramp, .end_s = (double)INFINITY, .rise_s = 3};
    for (int i = 0; i < 3; i++) {
        const fw_mechanism_pin *pin = &m->pin[i];
        t->torsion[t->ntorsion++] = (fw_effects_torsion){
            i, pin->body_a, pin->body_b, rig_random(seed), rig_random(seed), pick(seed)};
        t->stop[t->nstop++] = (fw_effects_stop){.pin = i,
                                                .body_a = pin->body_a,
                                                .body_b = pin->body_b,
                                                .side = i % 2 ? 1 : -1,
                                                .at_rad = pick(seed),
                                                .stiffness_Nm_per_rad = rig_random(seed),
                                                .damping_Nms_per_rad = 0.1 * rig_random(seed)};
        int a = other_body(seed, 99);
        t->spring[t->nspring++] = (fw_device_spring){.body_a = a,
                                                     .body_b = other_body(seed, a),
                                                     .ax_m = pick(seed),
                                                     .ay_m = pick(seed),
                                                     .bx_m = pick(seed),
                                                     .by_m = pick(seed),
                                                     .stiffness_N_per_m = rig_random(seed),
                                                     .damping_Ns_per_m = rig_random(seed),
                                                     .length_m = rig_random(seed),
                                                     .cable = i == 1};
        t->load[t->nload++] =
            (fw_effects_point_load){i, pick(seed), pick(seed), pick(seed), pick(seed)};
        t->timed[t->ntimed++] = (fw_effects_timed_load){
            i + 1, pick(seed), pick(seed), pick(seed), pick(seed), pick(seed), &p->ramp};
    }
    t->slide[t->nslide++] = (fw_effects_slide){0, rig_random(seed), rig_random(seed)};
}

static void plant_new(fw_arena *arena, uint64_t seed, plant *p) {
    *p = (plant){.r = rig_new(arena, BODIES, 4, 4)};
    for (int b = 0; b < BODIES; b++)
        rig_body(&p->r, "body", 0.5 + rig_random(&seed), 0.1 + rig_random(&seed), 3 * pick(&seed),
                 3 * pick(&seed), 3 * pick(&seed));
    for (int i = 0; i < 4; i++) {
        int a = i == 0 ? FW_GROUND : other_body(&seed, 99);
        rig_pin_local(&p->r, "pin", a, pick(&seed), pick(&seed), other_body(&seed, a), pick(&seed),
                      pick(&seed));
    }
    random_joints(arena, p, &seed);
    random_terms(arena, p, &seed);
    p->sys = rig_system_with(arena, &p->r.m, &p->loads, 5, NULL);
    p->sys->piece_s = 1;
}

/* G^T lambda - Q at y, with the flags of stops and cables as they are */
static void balance(fw_multibody_system *sys, double t, const double *y, const double *lambda,
                    double *f) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    const double *accel = fw_multibody_forces(sys, pose, y + N)->accel;
    for (int i = 0; i < N; i++)
        f[i] = -(i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]) * accel[i];
    rig_transpose(m, pose, lambda, f);
}

/* largest difference between column j of the tangent and the difference quotient of order 6 */
static double column_error(fw_multibody_system *sys, double t, double *y, const double *lambda,
                           int j, const double *matrix, int column) {
    static const double weight[6] = {-1.0 / 60, 9.0 / 60,  -45.0 / 60,
                                     45.0 / 60, -9.0 / 60, 1.0 / 60};
    static const int at[6] = {-3, -2, -1, 1, 2, 3};
    double sum[N] = {0}, f[N], keep = y[j], h = 1e-3, worst = 0;
    for (int k = 0; k < 6; k++) {
        y[j] = keep + at[k] * h;
        balance(sys, t, y, lambda, f);
        for (int i = 0; i < N; i++)
            sum[i] += weight[k] * f[i] / h;
    }
    y[j] = keep;
    for (int i = 0; i < N; i++)
        worst = fmax(worst, fabs(sum[i] - matrix[i * N + column]));
    return worst;
}

static void every_joint_and_force(void **state) {
    (void)state;
    int stops = 0, cables = 0, kinds[5] = {0};
    for (uint64_t seed = 1; seed <= 40; seed++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t noise = seed * 7919;
        plant p;
        plant_new(arena, seed, &p);
        const fw_multibody_model *m = p.sys->model;
        double y[2 * N + 8] = {0}, lambda[64] = {0}, k[N * N], c[N * N], t = 1.5 / m->scale.time_s;
        for (int i = 0; i < 2 * N; i++)
            y[i] = pick(&noise);
        for (int i = 0; i < m->nblock; i++) {
            bool two = m->block[i].rows == FW_ROWS_PIN || m->block[i].rows == FW_ROWS_SLIDE;
            lambda[2 * i] = pick(&noise);
            lambda[2 * i + 1] = two ? pick(&noise) : 0;
            kinds[m->block[i].rows]++;
        }
        const fw_multibody_pose *pose = fw_multibody_set_switches(p.sys, t, y);
        for (int i = 0; i < fw_multibody_switch_count(m); i++)
            if (fw_multibody_switch_on(p.sys, i)) *(i < m->nstop ? &stops : &cables) += 1;
        fw_statics_tangent(p.sys, pose, y + N, lambda, k, c);
        for (int j = 0; j < N; j++) {
            double stiff = column_error(p.sys, t, y, lambda, j, k, j);
            double damp = column_error(p.sys, t, y, lambda, N + j, c, j);
            if (!(stiff < 1e-9 && damp < 1e-10))
                fail_msg("seed %d, column %d: K off by %g, C by %g", (int)seed, j, stiff, damp);
        }
        fw_arena_free(arena);
    }
    assert_true(stops > 10 && cables > 10);
    for (int i = 0; i < 5; i++)
        assert_true(kinds[i] >= 40);
}

/* everything derives from a potential: at rest K is symmetric, C is symmetric and takes energy */
static void rest_is_symmetric(void **state) {
    (void)state;
    for (uint64_t seed = 100; seed < 120; seed++) {
        fw_arena *arena = fw_arena_new(0);
        uint64_t noise = seed;
        plant p;
        plant_new(arena, seed, &p);
        double y[2 * N + 8] = {0}, lambda[64], k[N * N], c[N * N], power = 0, x[N];
        for (int i = 0; i < 64; i++)
            lambda[i] = pick(&noise);
        for (int i = 0; i < N; i++)
            y[i] = pick(&noise), x[i] = pick(&noise);
        fw_statics_tangent(p.sys, fw_multibody_pose_at(p.sys, 0, y), y + N, lambda, k, c);
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++) {
                assert_near(k[i * N + j], k[j * N + i], 1e-14);
                assert_near(c[i * N + j], c[j * N + i], 1e-14);
                power += x[i] * c[i * N + j] * x[j];
            }
        assert_true(power >= -1e-14);
        fw_arena_free(arena);
    }
}

/* points that coincide: a spring without length is k I and c I there, between turned bodies too */
static void springs_without_length(void **state) {
    (void)state;
    for (uint64_t seed = 200; seed < 220; seed++) {
        fw_arena *arena = fw_arena_new(0);
        plant p;
        plant_new(arena, seed, &p);
        fw_effects_loads *t = &p.loads;
        t->ntorsion = t->nstop = t->nload = t->ntimed = t->nslide = 0;
        for (int i = 0; i < 3; i++) {
            fw_device_spring *s = &t->spring[i];
            if (s->body_b == FW_GROUND) s->body_b = s->body_a, s->body_a = FW_GROUND;
            const fw_mechanism_mass *b = &p.r.m.body[s->body_b];
            double x = s->ax_m, y = s->ay_m;
            if (s->body_a != FW_GROUND) {
                const fw_mechanism_mass *a = &p.r.m.body[s->body_a];
                x = a->x_m + cos(a->phi_rad) * s->ax_m - sin(a->phi_rad) * s->ay_m;
                y = a->y_m + sin(a->phi_rad) * s->ax_m + cos(a->phi_rad) * s->ay_m;
            }
            s->bx_m = cos(b->phi_rad) * (x - b->x_m) + sin(b->phi_rad) * (y - b->y_m);
            s->by_m = cos(b->phi_rad) * (y - b->y_m) - sin(b->phi_rad) * (x - b->x_m);
            s->length_m = 0, s->cable = false;
        }
        double u[2 * N + 8] = {0}, lambda[64] = {0}, k[N * N], c[N * N];
        p.sys = rig_system_with(arena, &p.r.m, t, 5, NULL);
        p.sys->piece_s = 1;
        fw_statics_tangent(p.sys, fw_multibody_pose_at(p.sys, 0, u), u + N, lambda, k, c);
        double most = 0;
        for (int j = 0; j < N; j++) {
            double stiff = column_error(p.sys, 0, u, lambda, j, k, j);
            double damp = column_error(p.sys, 0, u, lambda, N + j, c, j);
            if (!(stiff < 1e-9 && damp < 1e-9))
                fail_msg("seed %d, column %d: K off by %g, C by %g", (int)seed, j, stiff, damp);
            most = fmax(most, fmin(k[j * N + j], c[j * N + j]));
        }
        assert_true(most > 0.01);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_joint_and_force),
        cmocka_unit_test(rest_is_symmetric),
        cmocka_unit_test(springs_without_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
