/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The same mechanism from nanometres to kilometres. Hard because numbers of 1e-27 and 1e12 meet in
   one set of equations, every fixed threshold is wrong somewhere, and far from the origin the
   digits of a coordinate are used up by where the mechanism stands. */
#include "hard.h"

enum { ROWS = 21, N = 15 };

/* the reference six-bar with lengths, masses and times scaled and moved */
static rig scaled(fw_arena *arena, double length, double mass, double time) {
    rig r = rig_six_bar(arena, false);
    double inertia = mass * length * length, torque = inertia / (time * time);
    for (int b = 0; b < r.m.nbody; b++) {
        fw_mechanism_mass *p = &r.m.body[b];
        p->mass_kg *= mass, p->inertia_kg_m2 *= inertia;
        p->x_m *= length, p->y_m *= length;
    }
    for (int i = 0; i < r.m.npin; i++) {
        fw_mechanism_pin *p = &r.m.pin[i];
        p->ax_m *= length, p->ay_m *= length, p->bx_m *= length, p->by_m *= length;
        p->stiffness_Nm_per_rad *= torque, p->damping_Nms_per_rad *= torque * time;
    }
    r.scene.force[0].fx_N *= torque / length, r.scene.force[0].fy_N *= torque / length;
    r.scene.torque[0].value_Nm *= torque;
    r.scene.duration_s *= time;
    return r;
}

static void test_sizes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = scaled(arena, 1, 1, 1);
    const fw_dynamics_motion_options o = {.rtol = 1e-12, .samples = ROWS};
    const fw_dynamics_motion *one = hard_run(arena, &r, o);
    double worst = 0, energy = 0;
    int count = 0;
    static const double length[] = {1e-6, 1e-3, 1, 1e3, 1e6}, mass[] = {1e-12, 1e-6, 1, 1e6, 1e12},
                        time[] = {1e-6, 1, 1e6};
    for (size_t a = 0; a < 5; a++)
        for (size_t b = 0; b < 5; b++)
            for (size_t c = 0; c < 3; c++, count++) {
                fw_mark mark = fw_arena_mark(arena);
                rig s = scaled(arena, length[a], mass[b], time[c]);
                const fw_dynamics_motion *m = hard_run(arena, &s, o);
                double unit[2] = {1e-3 * length[a], 1}, off = 0;
                for (int i = 0; i < ROWS * N; i++) {
                    double u = unit[i % 3 == 2];
                    off = fmax(off, fabs(m->q[i] / u - one->q[i] / (i % 3 == 2 ? 1 : 1e-3)));
                    /* 1000 rad/s or 2 m/s are usual rates */
                    double rate = i % 3 == 2 ? 1000 : 2;
                    off = fmax(off,
                               fabs(m->v[i] * time[c] / (i % 3 == 2 ? 1 : length[a]) - one->v[i]) /
                                   rate);
                }
                double newton = mass[b] * length[a] / (time[c] * time[c]);
                for (int i = 0; i < ROWS * 12; i++) /* of 0.8 mN */
                    off = fmax(off, fabs(m->reaction_N[i] / newton - one->reaction_N[i]) / 8e-4);
                energy = fmax(energy, fabs(m->stats.energy_error - one->stats.energy_error));
                if (off > 1e-10)
                    fail_msg("length %g mass %g time %g: off by %.2e", length[a], mass[b], time[c],
                             off);
                worst = fmax(worst, off);
                fw_arena_rewind(arena, mark);
            }
    print_message(
        "units: %d scalings from 3 nm to 3 km, 1e-20 to 1e4 kg, 10 ns to 10 ks: positions, "
        "rates and forces agree to %.1e, energy error changes by %.1e\n",
        count, worst, energy);
    fw_arena_free(arena);
}

/* 2^20 sizes from the origin: coordinates on a grid that both places hold exactly (1e-9 mm would
   not be), so that only the arithmetic can differ */
static void test_far_away(void **state) {
    (void)state;
    const double cell = 0x1p-20; /* m */
    fw_arena *arena = fw_arena_new(0);
    const fw_dynamics_motion *m[3];
    static const double away[3] = {0, 0x1p11, -0x1p13}; /* m: up to 2.7 million sizes */
    for (int k = 0; k < 3; k++) {
        rig r = rig_six_bar(arena, false);
        for (int b = 0; b < 5; b++) {
            fw_mechanism_mass *p = &r.m.body[b];
            p->x_m = round(p->x_m / cell) * cell + away[k];
            p->y_m = round(p->y_m / cell) * cell - away[k] / 2;
        }
        for (int i = 0; i < r.m.npin; i++) {
            fw_mechanism_pin *p = &r.m.pin[i];
            double x = p->body_a == FW_GROUND ? p->ax_m : p->bx_m, y;
            static const double at[7][2] = {{0.70, 0.15}, {0.20, 1.40}, {0.80, 2.70}, {2.20, 2.75},
                                            {2.85, 1.45}, {2.30, 0.15}, {2.20, 2.75}};
            x = round(at[i][0] * 1e-3 / cell) * cell, y = round(at[i][1] * 1e-3 / cell) * cell;
            const int body[2] = {p->body_a, p->body_b};
            double *to[2] = {&p->ax_m, &p->bx_m}, *up[2] = {&p->ay_m, &p->by_m};
            for (int side = 0; side < 2; side++) {
                bool ground = body[side] == FW_GROUND;
                *to[side] = ground ? x + away[k] : x + away[k] - r.m.body[body[side]].x_m;
                *up[side] = ground ? y - away[k] / 2 : y - away[k] / 2 - r.m.body[body[side]].y_m;
            }
        }
        m[k] = hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = ROWS});
    }
    for (int k = 1; k < 3; k++) {
        double angle = 0, place = 0;
        for (int i = 0; i < ROWS * N; i++) {
            double moved = i % 3 == 0 ? away[k] : i % 3 == 1 ? -away[k] / 2 : 0;
            double off = fabs(m[k]->q[i] - moved - m[0]->q[i]);
            double *to = i % 3 == 2 ? &angle : &place;
            *to = fmax(*to, off);
        }
        double digit = fabs(away[k]) * 0x1p-52;
        print_message("units: %g m from the origin: angles to %.1e rad, places to %.1e m (a digit "
                      "there is %.1e m)\n",
                      away[k], angle, place, digit);
        assert_true(angle < 1e-10);
        assert_true(place <= 2 * digit + 1e-13);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
