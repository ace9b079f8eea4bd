/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What friction does at one instant, on random mechanisms and states: the equations of motion with
   its torques, and the law of every joint with friction, checked from the outside. */
#include "multibody/systems.h"
#include "effects/effect.h"
#include "multibody/multibody_scratch.h"

static const double NOT = (double)NAN;

static fw_multibody_system *system_of(fw_arena *arena, const rig *r, const char *method) {
    fw_diags diags = fw_diags_new(arena);
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(arena, fw_effects_loads);
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &all, 1e-3, &diags, &ledger, loads), FW_OK);
    fw_multibody_system *sys =
        rig_system_with(arena, &r->m, loads, r->scene.duration_s, fw_multibody_method_find(method));
    sys->piece_s = r->scene.duration_s / 2;
    return sys;
}

/* friction in most pins; sometimes a block on a body, that slides along it */
static rig any(fw_arena *arena, uint64_t seed) {
    rig r = rig_any(arena, seed);
    double strength = pow(10, -3 + 3 * rig_random(&seed)); /* loads of any size */
    for (int i = 0; i < r.scene.nforce; i++)
        r.scene.force[i].fx_N *= strength, r.scene.force[i].fy_N *= strength;
    for (int i = 0; i < r.scene.ntorque; i++)
        r.scene.torque[i].value_Nm *= strength;
    for (int i = 0; i < r.m.npin; i++)
        r.m.pin[i].stiffness_Nm_per_rad *= strength;
    r.scene.friction = fw_arena_array(arena, fw_device_friction_use, 16);
    for (int i = 0; i < r.m.npin; i++) {
        if (rig_random(&seed) < 0.2) continue;
        double mu = 0.1 + 0.3 * rig_random(&seed);
        r.scene.friction[r.scene.nfriction++] =
            (fw_device_friction_use){.revolute = i,
                                     .joint = FW_NONE,
                                     .coefficient = mu,
                                     .static_coefficient = rig_random(&seed) < 0.5 ? NOT : 1.5 * mu,
                                     .radius_m = 3e-4 * rig_random(&seed),
                                     .preload_N = 3e-3 * rig_random(&seed)};
        if (rig_random(&seed) < 0.3) r.scene.friction[r.scene.nfriction - 1].preload_N = 0;
    }
    if (rig_random(&seed) < 0.5) {
        int host = r.m.nbody - 1;
        fw_mechanism_mass *more = fw_arena_array(arena, fw_mechanism_mass, (size_t)r.m.nbody + 1);
        memcpy(more, r.m.body, (size_t)r.m.nbody * sizeof *more);
        r.m.body = more;
        double c = cos(r.m.body[host].phi_rad + 0.4), s = sin(r.m.body[host].phi_rad + 0.4);
        rig_body(&r, "block", 5e-9, 3e-16, r.m.body[host].x_m + 2e-4 * c,
                 r.m.body[host].y_m + 2e-4 * s, 0.1);
        r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
        r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "rail",
                                                    .kind = FW_JOINT_PRISMATIC,
                                                    .body_a = host,
                                                    .body_b = host + 1,
                                                    .axis_rad = 0.4,
                                                    .angle_rad = 0.1 - r.m.body[host].phi_rad};
        r.scene.friction[r.scene.nfriction++] = (fw_device_friction_use){
            .revolute = FW_NONE, .joint = 0, .coefficient = 0.2, .static_coefficient = 0.3};
    }
    return r;
}

/* relative acceleration of an entry by differences of its rate along y + h f, order 4 */
static double relative(fw_multibody_system *sys, int i, const double *y, const double *f) {
    const fw_multibody_model *m = sys->model;
    double rate[4], z[128];
    const double at[4] = {-2, -1, 1, 2}, h = 1e-4;
    for (int k = 0; k < 4; k++) {
        double t = at[k] * h; /* q along its parabola */
        for (int c = 0; c < m->nq; c++) {
            z[c] = y[c] + t * y[m->nq + c] + t * t / 2 * f[m->nq + c];
            z[m->nq + c] = y[m->nq + c] + t * f[m->nq + c];
        }
        fw_multibody_friction_rows(sys, fw_multibody_pose_at(sys, 0, z), z + m->nq);
        rate[k] = sys->friction->rate[i];
    }
    return (8 * (rate[2] - rate[1]) - (rate[3] - rate[0])) / (12 * h);
}

static double pressing(const fw_multibody_system *sys, int i) {
    const fw_multibody_friction_joint *f = &sys->model->friction[i];
    const double *l = sys->work->solution.lambda + 2 * f->block;
    return f->preload + (f->slides ? fabs(l[1]) : hypot(l[0], l[1]));
}

/* M a + G^T lambda = Q + sum h T, by virtual power with random w: no way through the rows */
static void check_motion(fw_multibody_system *sys, const double *y, const double *f,
                         uint64_t *seed) {
    const fw_multibody_model *m = sys->model;
    double force[64] = {0}, w[64], left = 0, size = 0, torque[16];
    const struct fw_multibody_frictions *s = sys->friction;
    for (int i = 0; i < s->n; i++)
        torque[i] = s->torque[i];
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, 0, y);
    const fw_multibody_solution *found = fw_multibody_forces(sys, pose, y + m->nq);
    rig_transpose(m, pose, found->lambda, force);
    for (int c = 0; c < m->nq; c++) {
        double mass = c % 3 == 2 ? m->inertia[c / 3] : m->mass[c / 3];
        w[c] = rig_random(seed) - 0.5;
        double part[2] = {mass * (f[m->nq + c] - found->accel[c]) * w[c], force[c] * w[c]};
        left += part[0] + part[1];
        size += fabs(part[0]) + fabs(part[1]);
    }
    fw_multibody_friction_rows(sys, pose, w);
    for (int i = 0; i < s->n; i++)
        left -= torque[i] * s->rate[i];
    assert_near(left, 0, 1e-11 * (1 + size));
}

static void check_laws(fw_multibody_system *sys, const double *y, const double *f, int count[3]) {
    struct fw_multibody_frictions *s = sys->friction;
    double rate[16];
    fw_multibody_friction_rows(sys, fw_multibody_pose_at(sys, 0, y), y + sys->model->nq);
    for (int i = 0; i < s->n; i++)
        rate[i] = s->rate[i];
    for (int i = 0; i < s->n; i++) {
        const fw_multibody_friction_joint *item = &s->joint[i];
        double n = pressing(sys, i), t = s->torque[i];
        assert_near(n, s->item[i].press, 1e-11 * (1 + n));
        if (!s->rests[i]) {
            assert_true(rate[i] != 0);
            assert_near(t, -(rate[i] > 0 ? 1 : -1) * item->slide * n, 1e-12 * (1 + n));
            count[0]++;
            continue;
        }
        assert_near(rate[i], 0, 1e-12);
        double a = relative(sys, i, y, f);
        assert_true(fabs(t) <= item->rest * n * (1 + 1e-11) + 1e-14);
        if (fabs(a) < 1e-7 * (1 + s->size[i])) {
            count[1]++;
            continue;
        }
        assert_near(t, (a > 0 ? -1 : 1) * item->slide * n, 1e-12 * (1 + n));
        count[2]++;
    }
}

/* Two solutions T and T + d need d != 0 with |d_r| <= mu_r |sum_c rho_rc d_c| for every r that
   slips, rho_rc the force of r for unit T_c while the others hold. Is there one? By powers of the
   map from several patterns of signs; the forces from accelerations of the method, not from the
   small system: T of those that hold by least squares over their relative accelerations. */
static bool may_jam(fw_multibody_system *sys) {
    struct fw_multibody_frictions *s = sys->friction;
    double reach[32][32][2], x[32], next[32];
    int who[32] = {0}, count = 0, stuck[32] = {0}, held = 0;
    for (int i = 0; i < s->n; i++)
        if (s->item[i].slip)
            who[count++] = i;
        else
            stuck[held++] = i;
    if (!fw_multibody_friction_hold(s, held, stuck)) return false;
    for (int c = 0; c < count; c++) {
        double right[32], back[32];
        for (int e = 0; e < held; e++)
            right[e] = s->gain[stuck[e] * s->n + who[c]];
        fw_multibody_friction_holding(s, held, stuck, right, back);
        for (int r = 0; r < count; r++)
            for (int k = 0; k < 2; k++) {
                const double *turn = s->turn + 2 * who[r] * s->n + k;
                reach[r][c][k] = turn[2 * who[c]];
                for (int e = 0; e < held; e++)
                    reach[r][c][k] -= turn[2 * stuck[e]] * back[e];
            }
    }
    uint64_t seed = 1;
    for (int pattern = 0; pattern < 64; pattern++) {
        for (int r = 0; r < count; r++)
            x[r] = pattern && rig_random(&seed) < 0.5 ? -1 : 1;
        for (int k = 0; k < 60; k++) {
            double size = 0, least = (double)INFINITY;
            for (int r = 0; r < count; r++) {
                const fw_multibody_friction_joint *f = &s->joint[who[r]];
                double rho[2] = {0, 0};
                for (int c = 0; c < count; c++)
                    rho[0] += reach[r][c][0] * x[c], rho[1] += reach[r][c][1] * x[c];
                next[r] = (s->item[who[r]].yields ? f->rest : f->slide) * hypot(rho[0], rho[1]);
                size = fmax(size, next[r]);
                if (fabs(x[r]) > 1e-6) least = fmin(least, next[r] / fabs(x[r]));
            }
            if (least >= 1) return true;
            for (int r = 0; r < count; r++)
                x[r] = (x[r] < 0 ? -1 : 1) * next[r] / size;
        }
    }
    return false;
}

/* all moving, some at rest, all at rest */
static void laws_hold(void **state) {
    (void)state;
    int count[3] = {0}, refused = 0;
    uint64_t seed = 3;
    for (int c = 0; c < 600; c++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = any(arena, 1000 + (uint64_t)c);
        fw_multibody_system *sys = system_of(arena, &r, c % 2 ? "chain" : "svd");
        const fw_multibody_model *m = sys->model;
        if (!sys->friction) {
            fw_arena_free(arena);
            continue;
        }
        double y[128] = {0}, f[128];
        struct fw_multibody_frictions *s = sys->friction;
        for (int i = 0; i < m->nq && c % 3; i++)
            y[m->nq + i] = 0.5 * (rig_random(&seed) - 0.5);
        const fw_multibody_factor *factor =
            fw_multibody_factorise(sys, fw_multibody_pose_at(sys, 0, y));
        assert_non_null(factor);
        assert_true(fw_multibody_project_velocity(sys, factor, y + m->nq));
        fw_multibody_friction_begin(sys);
        fw_multibody_friction_track(sys, y); /* these velocities have been */
        if (c % 3 == 1) {                    /* bring about half of them to rest */
            for (int i = 0; i < s->n; i++)
                s->item[i].slip = rig_random(&seed) < 0.5, s->item[i].held = NOT;
            fw_multibody_friction_settle(sys, factor, y + m->nq);
        }
        if (!fw_multibody_friction_decide(sys, 0, y)) {
            assert_true(may_jam(sys));
            refused++;
            fw_arena_free(arena);
            continue;
        }
        assert_true(fw_multibody_evaluate(sys, 0, y, true, f));
        assert_true(m->dissipated < 0 || f[m->dissipated] >= -1e-12);
        check_laws(sys, y, f, count);
        fw_multibody_rhs(sys, 0, y, f);
        check_motion(sys, y, f, &seed);
        fw_arena_free(arena);
    }
    print_message("%d slip, %d stick, %d begin to slip; %d refused\n", count[0], count[1], count[2],
                  refused);
    assert_true(count[0] > 500 && count[1] > 300 && count[2] > 100);
    assert_true(refused < 3);
}

/* ---- many joints ---- */

/* a chain of n bodies in random directions from the ground, now and then back to the ground, and
   rods across it: friction in every pin, under loads of any size */
static rig many(fw_arena *arena, int n, uint64_t seed) {
    rig r = rig_new(arena, n, n + 8, 0);
    double x = 0, y = 0, level = pow(10, -2 + 3 * rig_random(&seed));
    for (int i = 0; i < n; i++) {
        double l = 1e-3 * (0.5 + rig_random(&seed)), m = 1e-8 * (0.5 + 2 * rig_random(&seed));
        double angle = 6.3 * rig_random(&seed), dx = l * cos(angle), dy = l * sin(angle);
        rig_body(&r, "link", m, m * l * l * (0.06 + 0.1 * rig_random(&seed)), x + dx / 2,
                 y + dy / 2, angle);
        rig_pin(&r, "pin", i - 1, i, x, y, 0, 0);
        x += dx, y += dy;
        rig_force(&r, i, level * 1e-3 * (rig_random(&seed) - 0.5),
                  level * 1e-3 * (rig_random(&seed) - 0.5));
    }
    for (int loops = (int)(4 * rig_random(&seed)); loops > 0; loops--) {
        int i = (int)(n * rig_random(&seed));
        const fw_mechanism_mass *b = &r.m.body[i];
        rig_pin(&r, "loop", i, FW_GROUND, b->x_m, b->y_m, 0, 0);
    }
    double least = rig_random(&seed) < 0.5 ? 1 : 0.3; /* one size for all, or very different ones */
    r.scene.friction = fw_arena_array(arena, fw_device_friction_use, (size_t)r.m.npin);
    for (int i = 0; i < r.m.npin; i++) {
        double mu = 0.1 + 0.2 * rig_random(&seed);
        r.scene.friction[r.scene.nfriction++] = (fw_device_friction_use){
            .revolute = i,
            .joint = FW_NONE,
            .coefficient = mu,
            .static_coefficient = rig_random(&seed) < 0.5 ? NOT : 1.5 * mu,
            .radius_m = 1e-4 * (least + (1 - least) * rig_random(&seed)),
            .preload_N = rig_random(&seed) < 0.3 ? 0 : 2e-3 * rig_random(&seed)};
    }
    r.scene.duration_s = 1e-2;
    return r;
}

/* rate 0: |T| <= mu_s N r and no acceleration, or T = mu_k N r against it; else T against the rate.
   Largest mismatch, relative */
static double mismatch(fw_multibody_system *sys, const double *y, int *holds, int *lets_go) {
    const fw_multibody_model *m = sys->model;
    struct fw_multibody_frictions *s = sys->friction;
    double worst = 0, f[512], torque[64];
    assert_true(fw_multibody_evaluate(sys, 0, y, true, f));
    memcpy(torque, s->torque, (size_t)s->n * sizeof *torque);
    for (int i = 0; i < s->n; i++) {
        const fw_multibody_friction_joint *item = &s->joint[i];
        double n = pressing(sys, i), t = torque[i], size = s->size[i] + fabs(s->accel[i]), a;
        a = (item->b < m->nbody ? f[m->nq + 3 * item->b + 2] : 0) -
            (item->a < m->nbody ? f[m->nq + 3 * item->a + 2] : 0);
        for (int j = 0; j < s->n; j++)
            size += fabs(s->gain[i * s->n + j] * torque[j]);
        size += s->loose[i] * item->rest * n; /* of what it holds without moving */
        if (!s->rests[i]) {
            double rate = (item->b < m->nbody ? y[m->nq + 3 * item->b + 2] : 0) -
                          (item->a < m->nbody ? y[m->nq + 3 * item->a + 2] : 0);
            worst = fmax(worst, fabs(t + (rate > 0 ? 1 : -1) * item->slide * n) / (1 + n));
            continue;
        }
        double over = fmax(0, fabs(t) - item->rest * n) / (1 + n);
        double slips = fabs(t + (a > 0 ? 1 : -1) * item->slide * n) / (1 + n);
        double stands = fmax(over, fabs(a) / size);
        *(stands < slips ? holds : lets_go) += 1;
        worst = fmax(worst, fmin(stands, slips));
    }
    return worst;
}

/* 2000 of 3 to 30 joints, half of them at rest, the others partly: always an answer, and a right
   one; but where friction can feed itself */
static void many_joints(void **state) {
    (void)state;
    int holds = 0, lets_go = 0, refused = 0, mixed = 0, joints = 0;
    double worst = 0;
    uint64_t seed = 5;
    for (int c = 0; c < 2000; c++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = many(arena, 3 + c % 26, 40000 + 17 * (uint64_t)c);
        fw_multibody_system *sys = system_of(arena, &r, "chain");
        const fw_multibody_model *m = sys->model;
        double y[512] = {0};
        struct fw_multibody_frictions *s = sys->friction;
        for (int i = 0; i < m->nq && c % 2; i++)
            y[m->nq + i] = 0.1 * (rig_random(&seed) - 0.5);
        const fw_multibody_factor *factor =
            fw_multibody_factorise(sys, fw_multibody_pose_at(sys, 0, y));
        assert_non_null(factor);
        assert_true(fw_multibody_project_velocity(sys, factor, y + m->nq));
        fw_multibody_friction_begin(sys);
        fw_multibody_friction_track(sys, y);
        if (c % 2) { /* most of them at rest */
            for (int i = 0; i < s->n; i++)
                s->item[i].slip = rig_random(&seed) < 0.3, s->item[i].held = NOT;
            fw_multibody_friction_settle(sys, factor, y + m->nq);
        }
        int before[2] = {holds, lets_go};
        if (!fw_multibody_friction_decide(sys, 0, y)) {
            assert_true(may_jam(sys));
            refused++;
        } else {
            worst = fmax(worst, mismatch(sys, y, &holds, &lets_go));
            mixed += holds > before[0] && lets_go > before[1];
            joints = s->n > joints ? s->n : joints;
        }
        fw_arena_free(arena);
    }
    print_message("%d hold, %d let go, %d scenes with both, up to %d joints; off by %.1e; %d "
                  "may jam\n",
                  holds, lets_go, mixed, joints, worst, refused);
    assert_true(worst < 1e-10);
    assert_true(refused < 10);
    assert_true(mixed > 500 && joints >= 28);
}

/* a contact presses: it sees its points as the model has them, and its switches as they are held */
static void without_force(const fw_effects_force_element *e, const fw_effects_port_state *s,
                          double *f) {
    (void)s;
    memset(f, 0, 3 * (size_t)e->ports * sizeof *f);
}
static double by_place(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    (void)e;
    return s->on[0] && !s->on[1] ? 2 + s->p[3] - s->p[0] + 10 * (s->p[4] - s->p[1]) + s->w[4] : -1;
}
static double by_side(const fw_effects_force_element *e, const fw_effects_port_state *s, int i) {
    (void)e, (void)s;
    return i ? -1 : 1;
}

static void contact_presses(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_effects_element_class contact = {
        .effect = "contact", .force = without_force, .switch_value = by_side, .pressing = by_place};
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "rotor", 2, 0.5, 3, 4, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 3, 4, 0, 0);
    r.scene.duration_s = 3;
    fw_effects_loads loads;
    assert_int_equal(fw_effects_loads_new(arena, &r.m, &r.scene, &loads), FW_OK);
    fw_effects_force_element *e = fw_effects_loads_add_element(arena, &loads, &contact, 2);
    e->switches = 2;
    e->port[0] = (fw_effects_port){FW_GROUND, 0.5, 0};
    e->port[1] = (fw_effects_port){0, 0.25, 0};
    fw_effects_friction *f = fw_effects_loads_add_friction(arena, &loads);
    f->pin = 0, f->element = 0, f->kinetic_coefficient = f->static_coefficient = 0.3;
    f->radius_m = 0.1, f->preload_N = 1;
    const double omega = 1.5;
    fw_multibody_system *sys = rig_system_with(arena, &r.m, &loads, 3, NULL);
    const fw_multibody_model *m = sys->model;
    double y[8] = {0}, out[8];
    y[5] = omega * m->scale.time_s;
    fw_multibody_set_switches(sys, 0, y);
    fw_multibody_friction_begin(sys);
    assert_true(fw_multibody_friction_decide(sys, 0, y));
    fw_multibody_rhs(sys, 0, y, out);
    /* x + 10 y from port a to port b, upward speed of b */
    double n = 1 + 2 + 3.25 - 0.5 + 40 + 0.25 * omega;
    assert_near(out[5] / m->scale.time_s / m->scale.time_s, -0.3 * 0.1 * n / 0.5, 1e-12);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_hold),
        cmocka_unit_test(many_joints),
        cmocka_unit_test(contact_presses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
