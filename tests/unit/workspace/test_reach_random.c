/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random six-bars with random, one-sided limits: what is proved of boxes, against plain inverse
   kinematics and Monte Carlo. */
#include "workspace/reach.h"
#include "six_bar_fixture.h"
#include "test.h"

static uint64_t seed;

static double unit(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static double either(double size) {
    return size * (2 * unit() - 1);
}

typedef struct subject {
    six_bar_fixture f;
    fw_workspace_loop loop;
    fw_workspace_reach_limits limits;
} subject;

static bool strewn(subject *s, double by, double limit) {
    double p[6][2];
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 2; k++)
            p[i][k] = six_bar_reference[i][k] + either(by);
    six_bar_make(&s->f, (const double(*)[2])p);
    for (int i = 0; i < 6; i++) {
        s->f.pin[i].free_angle_rad = either(0.02);
        s->limits.low_rad[i] = -limit * (0.3 + unit());
        s->limits.high_rad[i] = limit * (0.3 + unit());
    }
    return fw_workspace_loop_set_up(&s->f.mechanism, &s->loop);
}

/* within the limits, by the engine's own inverse kinematics */
static bool plain(const subject *s, const double pose[3]) {
    double angle[FW_SIX];
    int leg;
    if (!fw_workspace_six_bar_inverse(&s->f.mechanism, pose[0], pose[1], pose[2], angle, &leg))
        return false;
    for (int i = 0; i < FW_SIX; i++)
        if (angle[i] < s->limits.low_rad[i] || angle[i] > s->limits.high_rad[i]) return false;
    return true;
}

static void forward(const subject *s, const double q[3], double pose[3]) {
    const fw_workspace_leg *l = &s->loop.leg[0];
    double a = q[0], b = q[0] + q[1], c = q[0] + q[1] + q[2];
    pose[0] = l->base.x + cos(a) * l->a.x - sin(a) * l->a.y + cos(b) * l->b.x - sin(b) * l->b.y -
              cos(c) * l->to.x + sin(c) * l->to.y - s->loop.centre.x;
    pose[1] = l->base.y + sin(a) * l->a.x + cos(a) * l->a.y + sin(b) * l->b.x + cos(b) * l->b.y -
              sin(c) * l->to.x - cos(c) * l->to.y - s->loop.centre.y;
    pose[2] = c;
}

/* What a cut box says of its parts beforehand, and what a part says of which only that is asked
   which is not proved of the box, is so at points of the part. How many parts were told
   beforehand. */
static int parts_agree(const subject *s, const fw_workspace_allowed *allowed,
                       const fw_workspace_box3 *box, unsigned open,
                       const fw_workspace_loop_box *known) {
    double between[3];
    unsigned inside, outside;
    int told = 0;
    for (int k = 0; k < 3; k++) { /* where rounding may have moved it */
        double middle = 0.5 * (box->lo[k] + box->hi[k]);
        between[k] = middle + either(4e-16);
        between[k] = fmin(fmax(between[k], box->lo[k]), box->hi[k]);
    }
    fw_workspace_reach_parts(allowed, 3, box, between, open, known, &inside, &outside);
    for (int part = 0; part < 8; part++) {
        fw_workspace_box3 half = *box;
        for (int k = 0; k < 3; k++)
            *(part >> k & 1 ? &half.lo[k] : &half.hi[k]) = between[k];
        fw_workspace_loop_box seen;
        fw_maths_interval share;
        unsigned left = open;
        fw_workspace_inside where =
            fw_workspace_reach_judge(&s->loop, allowed, 3, 0, &half, &left, &seen, &share);
        bool in = inside >> part & 1, out = outside >> part & 1;
        assert_false(in && out);
        told += in || out;
        for (int n = 0; n < 60; n++) {
            double q[3], pose[3];
            for (int k = 0; k < 3; k++) /* points of its faces and corners, too */
                q[k] = half.lo[k] +
                       fmin(fmax(1.2 * unit() - 0.1, 0.0), 1.0) * (half.hi[k] - half.lo[k]);
            forward(s, q, pose);
            bool holds = plain(s, pose);
            if (in || where == FW_INSIDE) assert_true(holds);
            if (out || where == FW_OUTSIDE) assert_false(holds);
        }
    }
    return told;
}

static void boxes_agree_with_plain_kinematics(void **state) {
    (void)state;
    seed = 21;
    int count[3] = {0}, told = 0;
    int boxes = test_cases(4000, 800);
    for (int i = 0; i < boxes; i++) {
        subject s;
        if (!strewn(&s, 300, 0.25)) continue;
        fw_workspace_allowed allowed = fw_workspace_limits_allow(&s.loop, &s.limits);
        fw_workspace_box3 whole = fw_workspace_reach_whole(&s.loop, &allowed), box;
        for (int k = 0; k < 3; k++) {
            double w = (whole.hi[k] - whole.lo[k]) * 0.12 * unit();
            box.lo[k] = whole.lo[k] + unit() * (whole.hi[k] - whole.lo[k] - w);
            box.hi[k] = box.lo[k] + w;
        }
        fw_workspace_loop_box known;
        fw_maths_interval share;
        unsigned open = FW_WANT_LIMITS;
        fw_workspace_inside where =
            fw_workspace_reach_judge(&s.loop, &allowed, 3, 0, &box, &open, &known, &share);
        enum { POINTS = 400 };
        int in = 0;
        for (int n = 0; n < POINTS; n++) {
            double q[3], pose[3];
            for (int k = 0; k < 3; k++)
                q[k] = box.lo[k] + unit() * (box.hi[k] - box.lo[k]);
            forward(&s, q, pose);
            in += plain(&s, pose);
        }
        count[where]++;
        if (where == FW_INSIDE) assert_int_equal(in, POINTS);
        if (where == FW_OUTSIDE) assert_int_equal(in, 0);
        if (where == FW_CUT) told += parts_agree(&s, &allowed, &box, open, &known);
        if (where == FW_CUT) { /* 5 sigma, and a count */
            double p = (double)in / POINTS, tol = 5 * sqrt(p * (1 - p) / POINTS) + 3.0 / POINTS;
            assert_true(share.lo <= p + tol && share.hi >= p - tol);
        }
    }
    assert_true(count[FW_INSIDE] > boxes / 40 && count[FW_OUTSIDE] > boxes / 40 &&
                count[FW_CUT] > boxes / 40);
    assert_true(told > count[FW_CUT]);
}

/* the same volume from poses drawn in a box that holds the set: nothing of the leg's rotations in
 * it */
static void volume_against_monte_carlo(void **state) {
    (void)state;
    seed = 22;
    fw_arena *arena = fw_arena_new(0);
    for (int i = 0; i < 6; i += test_cases(1, 4)) {
        subject s;
        if (!strewn(&s, 200, i < 4 ? 0.1 : 0.3)) continue;
        fw_workspace_measure v;
        assert_int_equal(fw_workspace_reach_volume(arena, &s.loop, &s.limits,
                                                   (fw_workspace_proof_effort){3e-3, 1000000}, &v),
                         FW_OK);
        assert_true(v.reached);
        enum { POSES = 400000 };
        const double reach = i < 4 ? 600e-6 : 1500e-6, turn = i < 4 ? 0.42 : 1.25;
        long in = 0, edge = 0;
        for (long n = 0; n < POSES; n++) {
            double pose[3] = {either(reach), either(reach), either(turn)};
            if (!plain(&s, pose)) continue;
            in++;
            edge += fabs(pose[0]) > 0.99 * reach || fabs(pose[1]) > 0.99 * reach ||
                    fabs(pose[2]) > 0.99 * turn;
        }
        assert_int_equal(edge, 0); /* the box holds the set */
        double whole = 8 * reach * reach * turn, p = (double)in / POSES;
        double sigma = whole * sqrt(p * (1 - p) / POSES);
        assert_true(p * whole > v.value.lo - 4.5 * sigma && p * whole < v.value.hi + 4.5 * sigma);
    }
    fw_arena_free(arena);
}

/* limits so wide that the left leg could be stretched: only the branch counts, and Monte Carlo
 * agrees */
static void stretched_legs_end_the_branch(void **state) {
    (void)state;
    seed = 23;
    fw_arena *arena = fw_arena_new(0);
    subject s;
    assert_true(strewn(&s, 0, 0.5));
    for (int i = 0; i < FW_SIX; i++)
        s.f.pin[i].free_angle_rad = 0, s.limits.low_rad[i] = -1.5, s.limits.high_rad[i] = 1.5;
    assert_true(fw_workspace_loop_set_up(&s.f.mechanism, &s.loop));
    fw_workspace_measure v;
    assert_int_equal(fw_workspace_reach_volume(arena, &s.loop, &s.limits,
                                               (fw_workspace_proof_effort){0.05, 1000000}, &v),
                     FW_OK);
    assert_true(v.value.lo > 0 && v.value.hi < 1.4 * v.value.lo);
    enum { POSES = 400000 };
    long in = 0;
    for (long n = 0; n < POSES; n++) {
        double pose[3] = {either(3.3e-3), either(4.5e-3), either(3.141592653589793)};
        in += plain(&s, pose);
    }
    double whole = 8 * 3.3e-3 * 4.5e-3 * 3.141592653589793, p = (double)in / POSES;
    double sigma = whole * sqrt(p * (1 - p) / POSES);
    if (!(p * whole > v.value.lo - 5 * sigma && p * whole < v.value.hi + 5 * sigma))
        fail_msg("%g not in [%g, %g]", p * whole, v.value.lo, v.value.hi);
    fw_arena_free(arena);
}

/* ---- the tree that the certificate has ---- */

static const char *behind(const char *node) {
    const char *next = node + 1;
    for (int part = 0; *node == FW_NODE_HALVED && part < 8; part++)
        next = behind(next);
    return next;
}

/* what the tree says of the leaf that a point is in */
static char leaf_at(const fw_workspace_volume_proof *proof, const double q[3]) {
    fw_workspace_box3 box = proof->box;
    const char *node = proof->tree;
    while (*node == FW_NODE_HALVED) {
        int part = 0;
        for (int k = 0; k < 3; k++) {
            double middle = 0.5 * (box.lo[k] + box.hi[k]);
            if (q[k] > middle) part |= 1 << k;
            *(q[k] > middle ? &box.lo[k] : &box.hi[k]) = middle;
        }
        node++;
        for (; part > 0; part--)
            node = behind(node);
    }
    return *node;
}

/* no pose is where its leaf says that it is not; returns how many leaves said something */
static long tree_holds(const subject *s, const fw_workspace_volume_proof *proof, int points) {
    long told = 0;
    assert_int_equal(*behind(proof->tree), '\0');
    assert_int_equal(strspn(proof->tree, "ioch"), strlen(proof->tree));
    for (int n = 0; n < points; n++) {
        double q[3], pose[3];
        for (int k = 0; k < 3; k++)
            q[k] = proof->box.lo[k] + unit() * (proof->box.hi[k] - proof->box.lo[k]);
        forward(s, q, pose);
        char leaf = leaf_at(proof, q);
        if (leaf == FW_NODE_INSIDE) assert_true(plain(s, pose));
        if (leaf == FW_NODE_OUTSIDE) assert_false(plain(s, pose));
        told += leaf != FW_NODE_CUT;
    }
    return told;
}

/* the search that keeps its tree gives the same bits as the one that does not; the leaves of the
   tree hold for random six-bars, where legs may be stretched, and where nothing is left */
static void trees_agree_with_plain_kinematics(void **state) {
    (void)state;
    seed = 24;
    fw_arena *arena = fw_arena_new(0);
    const fw_workspace_proof_effort effort = {1e-2, 20000};
    int count = test_cases(40, 8);
    for (int i = 0; i < count; i++) {
        subject s;
        if (!strewn(&s, i == 0 ? 0 : 200, i == 0 ? 1.5 : 0.2)) continue;
        fw_workspace_measure v, same;
        fw_workspace_volume_proof proof;
        assert_int_equal(fw_workspace_reach_certify(arena, &s.loop, &s.limits, effort, &v, &proof),
                         FW_OK);
        assert_int_equal(fw_workspace_reach_volume(arena, &s.loop, &s.limits, effort, &same),
                         FW_OK);
        assert_true(v.value.lo == same.value.lo && v.value.hi == same.value.hi);
        assert_true(v.boxes == same.boxes && v.level == same.level && v.reached == same.reached);
        assert_true(tree_holds(&s, &proof, 1500) > (i == 0 ? 0 : 450));
        s.limits.low_rad[1] = 0.2, s.limits.high_rad[1] = 0.1;
        assert_int_equal(fw_workspace_reach_certify(arena, &s.loop, &s.limits, effort, &v, &proof),
                         FW_OK);
        assert_true(v.value.hi == 0.0);
        assert_string_equal(proof.tree, "o");
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_agree_with_plain_kinematics),
        cmocka_unit_test(volume_against_monte_carlo),
        cmocka_unit_test(stretched_legs_end_the_branch),
        cmocka_unit_test(trees_agree_with_plain_kinematics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
