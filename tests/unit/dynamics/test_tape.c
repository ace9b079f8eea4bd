/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pass that was kept and is shown again is, to the last bit and for whoever looks at it, the one that would have
   been computed; and what differs in a single number is computed. */
#include "models.h"

/* whoever looks: a sum of all that is shown, in its order */
typedef struct looker {
    uint64_t sum;
    long instants, pieces, glances, starts;
    int refuse;          /* every so many thirds are not enough; 0: they always are */
    const double *first; /* where the first instant of the run stands */
} looker;

static void sum_up(looker *l, const double *x, size_t n) {
    for (size_t i = 0; i < n; i++) {
        uint64_t word;
        memcpy(&word, &x[i], sizeof word);
        l->sum = (l->sum ^ word) * 1099511628211u;
    }
}

enum { BODIES = 5, PINS = 6 };

static void take(looker *l, const fw_dynamics_instant *now) {
    if (l->instants++ == 0) l->first = now->q;
    const double other[] = {now->t_s, now->begins, now->hinge, now->piece_s};
    sum_up(l, other, 4);
    sum_up(l, now->q, 3 * BODIES);
    sum_up(l, now->angle_rad, PINS);
    sum_up(l, now->reaction_N, 2 * PINS);
    assert_non_null(now->loads);
}

static void see(void *context, const fw_dynamics_instant *now) {
    looker *l = context;
    if (now)
        take(l, now);
    else
        l->starts++;
}

static bool glance(void *context, const fw_dynamics_instant *third) {
    looker *l = context;
    if (l->refuse > 0 && l->glances++ % l->refuse == 0) return false;
    for (int i = 0; i < FW_THIRDS; i++)
        take(l, &third[i]);
    return true;
}

static void trace(void *context, const fw_dynamics_piece *piece) {
    looker *l = context;
    if (!piece) return;
    l->pieces++;
    sum_up(l, &piece->from_s, 1), sum_up(l, &piece->to_s, 1);
    sum_up(l, piece->q, (size_t)piece->nodes * 3 * BODIES);
}

typedef struct seen {
    looker fine, coarse;
    const fw_dynamics_motion *motion;
    uint64_t waiting; /* sum of the rows that waited */
} seen;

static seen move(fw_arena *arena, const rig *r, fw_dynamics_motion_options o, int refuse,
                 fw_dynamics_tapes *tapes) {
    seen s = {.fine = {.refuse = refuse}, .coarse = {.refuse = refuse}};
    fw_diags diags = fw_diags_new(arena);
    o.observe = see, o.glance = glance, o.context = &s.fine, o.other = &s.coarse;
    o.tapes = tapes;
    assert_int_equal(fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &s.motion), FW_OK);
    for (int i = 0; i < s.motion->nsample; i++)
        s.waiting = 3 * s.waiting + fw_dynamics_motion_waits(s.motion, i);
    return s;
}

static void same_looks(const looker *a, const looker *b) {
    assert_true(a->sum == b->sum);
    assert_int_equal(a->instants, b->instants);
    assert_int_equal(a->pieces, b->pieces);
    assert_int_equal(a->starts, b->starts);
}

static void same(const double *a, const double *b, int count) {
    assert_memory_equal(a, b, (size_t)count * sizeof *a);
}

static void same_motions(const seen *x, const seen *y) {
    const fw_dynamics_motion *a = x->motion, *b = y->motion;
    same_looks(&x->fine, &y->fine), same_looks(&x->coarse, &y->coarse);
    assert_int_equal(a->nsample, b->nsample);
    assert_true(x->waiting == y->waiting);
    fw_dynamics_motion_rows(a, 0, a->nsample), fw_dynamics_motion_rows(b, 0, b->nsample);
    same(a->t_s, b->t_s, a->nsample);
    same(a->q, b->q, a->nsample * 3 * a->nbody);
    same(a->v, b->v, a->nsample * 3 * a->nbody);
    same(a->accel, b->accel, a->nsample * 3 * a->nbody);
    same(a->angle_rad, b->angle_rad, a->nsample * a->npin);
    same(a->reaction_N, b->reaction_N, a->nsample * 2 * a->npin);
    assert_memory_equal(a->peak, b->peak, (size_t)a->npin * sizeof *a->peak);
    assert_string_equal(a->tolerance, b->tolerance);
    assert_true(a->end_s == b->end_s && a->ended == b->ended && a->displaced == b->displaced);
    const fw_dynamics_motion_stats *s = &a->stats, *t = &b->stats;
    assert_true(s->steps == t->steps && s->rejected == t->rejected && s->rhs == t->rhs);
    assert_true(s->projections == t->projections && s->all_steps == t->all_steps &&
                s->all_rhs == t->all_rhs && s->runs == t->runs);
    assert_true(s->energy_error == t->energy_error && s->largest_energy_J == t->largest_energy_J);
    assert_true(s->max_constraint_norm == t->max_constraint_norm &&
                s->max_velocity_norm == t->max_velocity_norm && s->rtol == t->rtol);
}

/* the third time what was asked for twice is shown from where it stands; with thirds that are enough for one and not
   for another */
static void the_same_bits(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const rig six = rig_six_bar(arena, false);
    for (int k = 0; k < 8; k++) {
        fw_dynamics_tapes *tapes;
        const fw_dynamics_motion_options o = {.rtol = k & 4 ? 0 : 1e-7,
                                              .samples = k & 1 ? 11 : 101,
                                              .late_rows = k & 1,
                                              .trace = k & 2 ? trace : NULL,
                                              .trace_both = true};
        assert_int_equal(fw_dynamics_tapes_new(arena, &tapes), FW_OK);
        const seen alone = move(arena, &six, o, 3, NULL);
        assert_true(alone.fine.instants > 100 && alone.coarse.instants > 10);
        assert_int_equal(alone.fine.pieces > 0, o.trace != NULL);
        seen before = {{0}, {0}, NULL, 0};
        for (int turn = 0; turn < 4; turn++) {
            const seen now = move(arena, &six, o, 3, tapes), often = move(arena, &six, o, 1, NULL);
            same_motions(&alone, &now);
            const seen all = move(arena, &six, o, 1, turn > 1 ? tapes : NULL);
            same_motions(&often, &all);
            if (turn == 3) assert_ptr_equal(now.fine.first, before.fine.first);
            if (turn == 1) assert_ptr_not_equal(now.fine.first, before.fine.first);
            before = now;
        }
        fw_dynamics_tapes_free(tapes);
    }
    fw_arena_free(arena);
}

/* one bit of one number */
static void another_number(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_dynamics_motion_options o = {.rtol = 1e-7, .samples = 11};
    fw_dynamics_tapes *tapes;
    assert_int_equal(fw_dynamics_tapes_new(arena, &tapes), FW_OK);
    rig six = rig_six_bar(arena, false);
    for (int k = 0; k < 3; k++)
        move(arena, &six, o, 0, tapes);
    double *const number[] = {&six.m.pin[3].stiffness_Nm_per_rad, &six.m.pin[1].damping_Nms_per_rad,
                              &six.m.pin[2].free_angle_rad,       &six.m.pin[4].ax_m,
                              &six.m.body[2].mass_kg,             &six.m.body[1].inertia_kg_m2,
                              &six.scene.duration_s,              &six.m.body[3].phi_rad};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        const double was = *number[i];
        *number[i] = nextafter(was, 10);
        const seen alone = move(arena, &six, o, 0, NULL);
        for (int k = 0; k < 3; k++) {
            const seen now = move(arena, &six, o, 0, tapes);
            same_motions(&alone, &now);
            /* what is known of one says nothing of the other */
            double *steady = fw_dynamics_motion_steady(now.motion);
            assert_true(k < 2 ? steady == NULL : steady && *steady == 0);
            if (steady) *steady = 0.5;
        }
        *number[i] = was;
    }
    fw_dynamics_motion_options other = o;
    other.rtol = nextafter(o.rtol, 1);
    const seen alone = move(arena, &six, other, 0, NULL), now = move(arena, &six, other, 0, tapes);
    same_motions(&alone, &now);
    assert_null(fw_dynamics_motion_steady(alone.motion));
    assert_null(fw_dynamics_motion_steady(now.motion));
    move(arena, &six, other, 0, tapes);
    const seen third = move(arena, &six, other, 0, tapes), fourth = move(arena, &six, other, 0, tapes);
    assert_ptr_equal(fw_dynamics_motion_steady(third.motion), fw_dynamics_motion_steady(fourth.motion));
    *fw_dynamics_motion_steady(third.motion) = 0.7;
    assert_true(*fw_dynamics_motion_steady(fourth.motion) == 0.7);
    fw_dynamics_tapes_free(tapes);
    fw_arena_free(arena);
}

/* what goes with time, or with what happened before, is not kept; nor what ends early */
static void not_kept(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_dynamics_tapes *tapes;
    assert_int_equal(fw_dynamics_tapes_new(arena, &tapes), FW_OK);
    const rig six = rig_six_bar(arena, false);
    const fw_dynamics_motion_options early = {.rtol = 1e-7, .samples = 11, .most_angle_rad = 0.02},
                                     whole = {.rtol = 1e-7, .samples = 11, .reactions = true};
    const fw_dynamics_motion_options *const all[] = {&early, &whole};
    for (int i = 0; i < 2; i++) {
        const seen alone = move(arena, &six, *all[i], 0, NULL);
        const double *before = NULL;
        for (int k = 0; k < 4; k++) {
            const seen now = move(arena, &six, *all[i], 0, tapes);
            same_motions(&alone, &now);
            assert_ptr_not_equal(now.fine.first, before);
            before = now.fine.first;
        }
        assert_int_equal(alone.motion->ended, i == 0);
    }
    fw_dynamics_tapes_free(tapes);
    fw_arena_free(arena);
}

/* Devices that move alike bear different angles. These are looked at after many evaluations only: before, they are not part of a
   motion, and a motion that reads them is that of its own device. */
static void what_each_bears(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_dynamics_tapes *tapes;
    assert_int_equal(fw_dynamics_tapes_new(arena, &tapes), FW_OK);
    const rig six = rig_six_bar(arena, false);
    double bears[PINS];
    fw_dynamics_motion_options o = {
        .rtol = 1e-7, .samples = 11, .hopeless_rad = bears, .hopeless_rhs = 1000000};
    const double *first = NULL;
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < PINS; i++)
            bears[i] = 0.001 * (k + i + 1);
        const seen alone = move(arena, &six, o, 0, NULL), now = move(arena, &six, o, 0, tapes);
        same_motions(&alone, &now);
        assert_false(alone.motion->ended);
        if (k > 2) assert_ptr_equal(now.fine.first, first);
        first = now.fine.first;
    }
    o.hopeless_rhs = 50; /* what is kept took more */
    for (int k = 0; k < 5; k++) {
        bears[0] = k & 1 ? 10 : 0.001;
        for (int i = 1; i < PINS; i++)
            bears[i] = 10;
        const seen alone = move(arena, &six, o, 0, NULL), now = move(arena, &six, o, 0, tapes);
        same_motions(&alone, &now);
        assert_int_equal(alone.motion->ended, !(k & 1));
        assert_ptr_not_equal(now.fine.first, first);
    }
    fw_dynamics_tapes_free(tapes);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_bits),
                                       cmocka_unit_test(another_number),
                                       cmocka_unit_test(not_kept),
                                       cmocka_unit_test(what_each_bears)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
