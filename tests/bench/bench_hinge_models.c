/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an equilibrium of the six-bar of the tables costs with its hinges as pins, in closed form
   and as exact beams: thread CPU time, median of rounds, in us, for four load_cases. `solve`: the
   descent from the assembled pose, model included; `whole`: what the command does, effects, step to
   the next level and all. And an evaluation of forces, of forces and tangent, of all six hinges.

   cmake --build DIR --target bench_hinge_models && DIR/tests/bench/bench_hinge_models */
#include "effects/hinge_rigs.h"
#include "statics/statics_equilibrium.h"
#include "statics/statics.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 41 };

static double now_us(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *x) {
    qsort(x, ROUNDS, sizeof *x, by_size);
    return x[ROUNDS / 2];
}

static const struct {
    const char *name;
    int body[2];
    double torque_Nm[2], fx_N;
} load_cases[] = {{"L1", {0, 4}, {1.5e-7, 0.5e-7}, 0},
                  {"L2", {0, 4}, {-3e-7, 3e-7}, 0},
                  {"L3", {2, 2}, {0, 0}, 150e-6},
                  {"L6", {2, 2}, {3e-7, 0}, 0}};

static void fill(rig *r, int load, fw_device_force *force, fw_device_torque *torque) {
    rig_six_bar(r, false);
    for (int i = 0; i < 6; i++)
        rig_strip(&r->hinge[i], 147.0790923914665e9);
    *force = (fw_device_force){.body = 2, .fx_N = load_cases[load].fx_N};
    for (int i = 0; i < 2; i++)
        torque[i] = (fw_device_torque){.body = load_cases[load].body[i],
                                       .value_Nm = load_cases[load].torque_Nm[i]};
    r->scene.force = force, r->scene.nforce = 1;
    r->scene.torque = torque, r->scene.ntorque = 2;
}

static int iterations;

static double solve_us(rig *r, fw_effects_hinge_model model) {
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    const fw_effect_choice c = {.mode = FW_EFFECTS_WHOLE, .hinge = model};
    assert_int_equal(
        fw_effects_compile(r->arena, &r->m, &r->scene, &c, 1e-3, &r->diags, &ledger, &loads),
        FW_OK);
    double x[ROUNDS];
    for (int i = 0; i < ROUNDS; i++) {
        fw_mark mark = fw_arena_mark(r->arena);
        fw_statics_equilibrium w;
        bool unstable = false;
        double from = now_us();
        assert_int_equal(
            fw_statics_equilibrium_new_loads(r->arena, &r->m, &r->scene, &loads, &r->diags, &w),
            FW_OK);
        assert_int_equal(fw_statics_equilibrium_settle(&w, &unstable), FW_OK);
        x[i] = now_us() - from;
        iterations = w.iterations;
        fw_arena_rewind(r->arena, mark);
    }
    return median(x);
}

static double whole_us(rig *r, fw_effects_hinge_model model) {
    const fw_statics_static_options o = {.effects = {.mode = FW_EFFECTS_AUTO, .hinge = model}};
    double x[ROUNDS];
    for (int i = 0; i < ROUNDS; i++) {
        fw_mark mark = fw_arena_mark(r->arena);
        const fw_statics *s;
        double from = now_us();
        assert_int_equal(fw_statics_solve(r->arena, &r->m, &r->scene, &o, &r->diags, &s), FW_OK);
        x[i] = now_us() - from;
        fw_arena_rewind(r->arena, mark);
    }
    return median(x);
}

static void forces_us(rig *r, fw_effects_hinge_model model) {
    fw_effect_ledger ledger;
    fw_effects_loads *t = &r->loads;
    const fw_effect_choice c = {.mode = FW_EFFECTS_WHOLE, .hinge = model};
    assert_int_equal(
        fw_effects_compile(r->arena, &r->m, &r->scene, &c, 1e-3, &r->diags, &ledger, t), FW_OK);
    double q[RIG_N], f[RIG_N], k[RIG_N * RIG_N], x[2][ROUNDS];
    for (int i = 0; i < ROUNDS; i++)
        for (int which = 0; which < 2; which++) {
            double from = now_us();
            for (int j = 0; j < 200; j++) {
                rig_drawn(r, q);
                for (int b = 0; b < RIG_N; b++)
                    q[b] += (b % 3 == 2 ? 2e-2 : 1e-7) * sin(b + 0.01 * j + i);
                rig_forces(r, q, f, which ? k : NULL);
            }
            x[which][i] = (now_us() - from) / 200;
        }
    printf("%-10s forces of six hinges %7.2f us, with tangent %7.2f us\n",
           fw_effects_hinge_model_text(model), median(x[0]), median(x[1]));
}

int main(void) {
    for (size_t l = 0; l < sizeof load_cases / sizeof *load_cases; l++)
        for (int m = FW_HINGE_REVOLUTE; m <= FW_HINGE_ELASTICA; m++) {
            rig r;
            fw_device_force force;
            fw_device_torque torque[2];
            fill(&r, (int)l, &force, torque);
            double solve = solve_us(&r, (fw_effects_hinge_model)m);
            printf("%s %-10s solve %8.1f us in %2d steps, whole %8.1f us\n", load_cases[l].name,
                   fw_effects_hinge_model_text((fw_effects_hinge_model)m), solve, iterations,
                   whole_us(&r, (fw_effects_hinge_model)m));
            if (l == 0 && m > FW_HINGE_REVOLUTE) forces_us(&r, (fw_effects_hinge_model)m);
            fw_arena_free(r.arena);
        }
    return 0;
}
