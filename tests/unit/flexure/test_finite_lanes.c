/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges side by side have the bits of each alone, whatever stands beside them and however wide the processor's registers
   are; and what the series of finite_lanes.c say is what the law in full says. */
#include "flexure/finite.h"
#include "strip_input.h"
#include "test.h"
#include <math.h>

enum { MOST = 11 };

static uint64_t seed = 0x51de;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) / 9007199254740992.0;
}

typedef struct row {
    fw_flexure_hinge_law law[MOST];
    fw_flexure_hinge_rest rest[MOST];
    fw_flexure_hinge_bent out[MOST];
    fw_flexure_hinge_lanes lanes;
    bool known[MOST];
} row;

/* leaves and arcs by turns; a third of them far beyond what the series are good for */
static void place(row *r, int i, int k) {
    const fw_flexure_hinge_law *law = &r->law[i];
    fw_flexure_hinge_at at;
    const bool far = (i + k) % 3 == 0;
    const double th = uniform(-1, 1) * (far && k % 2 ? 2 : 0.6), L = law->length_m;
    const double w = L * uniform(-0.05, 0.05), y = far ? uniform(-9, 20) : uniform(-0.05, 0.05);
    fw_flexure_hinge_law_slopes(law, &r->rest[i], th, &at);
    double *to = r->lanes.at + i;
    to[0] = th, to[r->lanes.stride] = w;
    to[2 * r->lanes.stride] =
        at.drift_m.value - 0.6 * w * w / L + y * L / (8 * law->bend_m_per_N) / at.ky_N_per_m.value;
}

static void row_of(fw_arena *arena, int count, row *r) {
    const fw_flexure_hinge_rest *rest[MOST];
    for (int i = 0; i < count; i++) {
        const double angle = i % 2 ? uniform(5, 330) : 0;
        const fw_flexure_input in =
            strip_input(1e-3, angle, uniform(0.005, 0.04), i % 3 ? 0.3 : -1);
        fw_flexure_result closed;
        fw_flexure_closed_form(&in, &closed);
        fw_flexure_hinge_law_of(&in, &closed, &r->law[i]);
        if (i % 4 == 3) /* ends that lose more than their roots give, as deep strips of a crystal have them */
            r->law[i].root_m_per_N = -0.04 * r->law[i].bend_m_per_N, r->law[i].share = 1.02;
        r->rest[i] = fw_flexure_hinge_rest_of(&r->law[i]), rest[i] = &r->rest[i];
    }
    assert_int_equal(fw_flexure_hinge_lanes_new(arena, count, rest, &r->lanes), FW_OK);
    for (int i = 0; i < count; i++)
        r->lanes.out[i] = &r->out[i];
}

static void same(const fw_flexure_hinge_bent *a, const fw_flexure_hinge_bent *b) {
    const double x[8] = {a->energy_J,    a->pull_N,     a->gradient[0], a->gradient[1],
                         a->gradient[2], a->kx_N_per_m, a->ky_N_per_m,  a->drift_slope};
    const double y[8] = {b->energy_J,    b->pull_N,     b->gradient[0], b->gradient[1],
                         b->gradient[2], b->kx_N_per_m, b->ky_N_per_m,  b->drift_slope};
    assert_memory_equal(x, y, sizeof x);
    assert_int_equal(a->holds, b->holds);
}

static void bits_of_each_alone(void **state) {
    (void)state;
    int known = 0, asked = 0;
    for (int count = 1; count <= MOST; count++)
        for (int k = 0; k < 60; k++) {
            static row r;
            fw_arena *arena = fw_arena_new(0);
            row_of(arena, count, &r);
            const int best = r.lanes.widest;
            for (int i = 0; i < count; i++)
                place(&r, i, k);
            for (int widest = 1; widest <= best; widest *= 2) {
                r.lanes.widest = widest;
                fw_flexure_hinge_lanes_bend(&r.lanes, r.known);
                for (int i = 0; i < count; i++) {
                    const double *from = r.lanes.at + i;
                    const double at[3] = {from[0], from[r.lanes.stride], from[2 * r.lanes.stride]};
                    fw_flexure_hinge_bent alone, *to = &alone;
                    asked++;
                    const unsigned knows = fw_flexure_lanes_bend_1(r.rest[i].number, 1, at, 1, &to);
                    assert_int_equal(knows, r.known[i]);
                    if (!knows) continue;
                    known++;
                    same(&alone, &r.out[i]);
                }
            }
            fw_arena_free(arena);
        }
    assert_true(known > asked / 2 && known < asked * 9 / 10);
}

/* forces, stiffnesses and energy, against those that come with second derivatives, which finite_force.c works out by
   itself; what differs is how far y is found and how functions are summed */
static void law_in_full(void **state) {
    (void)state;
    static row r;
    int known = 0;
    fw_arena *arena = fw_arena_new(0);
    for (int k = 0; k < 400; k++) {
        row_of(arena, MOST, &r);
        for (int i = 0; i < MOST; i++)
            place(&r, i, k);
        fw_flexure_hinge_lanes_bend(&r.lanes, r.known);
        for (int i = 0; i < MOST; i++) {
            const double *from = r.lanes.at + i, L = r.law[i].length_m;
            const double at[3] = {from[0], from[r.lanes.stride], from[2 * r.lanes.stride]};
            const fw_flexure_hinge_bent *few = &r.out[i];
            fw_flexure_hinge_bent full;
            if (!r.known[i]) continue;
            known++;
            fw_flexure_hinge_law_bend(&r.law[i], &r.rest[i], at, true, &full);
            const double force = fabs(full.gradient[1]) + fabs(full.gradient[2]);
            const double moment = fabs(full.gradient[0]) + force * L;
            assert_near(few->gradient[0], full.gradient[0], 1e-12 * moment);
            for (int j = 1; j < 3; j++)
                assert_near(few->gradient[j], full.gradient[j], 1e-12 * force);
            assert_near(few->energy_J, full.energy_J,
                        1e-12 * full.energy_J + 1e-12 * force * L * 0.01);
            assert_relative(few->kx_N_per_m, full.kx_N_per_m, 1e-13);
            assert_relative(few->ky_N_per_m, full.ky_N_per_m, 1e-10);
            assert_near(few->drift_slope, full.drift_slope, 1e-14 * L);
            assert_int_equal(few->holds, full.holds);
        }
    }
    fw_arena_free(arena);
    assert_true(known > 1500);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_of_each_alone),
        cmocka_unit_test(law_in_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
