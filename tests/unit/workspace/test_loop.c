/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes of poses and of joint rotations against plain inverse kinematics at points of them. */
#include "workspace/loop.h"
#include "six_bar_fixture.h"
#include "test.h"
#include "workspace/reach.h"

static uint64_t seed;

static double unit(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static double either(double size) {
    return size * (2 * unit() - 1);
}

/* a six-bar whose hinges are moved by up to `by` um; start angles in the platform's pose */
static bool strewn(six_bar_fixture *f, double by, fw_workspace_loop *loop) {
    double p[6][2];
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 2; k++)
            p[i][k] = six_bar_reference[i][k] + either(by);
    six_bar_make(f, (const double(*)[2])p);
    for (int i = 0; i < 6; i++)
        f->pin[i].free_angle_rad = either(0.05);
    return fw_workspace_loop_set_up(&f->mechanism, loop);
}

static double left_or_right(const fw_workspace_loop *k, int hinge, double angle) {
    double turn = angle - k->start_rad[hinge];
    return hinge < 3 ? turn : -turn;
}

/* where a leg is stretched in the drawn pose, on either side, which way it bends is not known: nothing is proved from there */
static void a_stretched_leg_has_no_side(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        double p[6][2];
        memcpy(p, six_bar_reference, sizeof p);
        for (int k = 0; k < 3 && i < 2; k++)
            p[i ? 5 - k : k][0] = i ? 400 : -400, p[i ? 5 - k : k][1] = 700 * (k - 1);
        six_bar_fixture f;
        fw_workspace_loop loop;
        six_bar_make(&f, (const double(*)[2])p);
        assert_int_equal(fw_workspace_loop_set_up(&f.mechanism, &loop), i == 2);
    }
}

/* linear part and remainder hold the rotation at every pose of the box, not only its range */
static void forms_hold_every_pose(void **state) {
    (void)state;
    seed = 3;
    long held = 0;
    for (int i = 0; i < 3000; i++) {
        six_bar_fixture f;
        fw_workspace_loop loop;
        if (!strewn(&f, 300, &loop)) continue;
        fw_workspace_box3 box;
        double size = pow(10, -4.5 * unit()), half[3], middle[3];
        const double scale[3] = {300e-6, 300e-6, 0.3};
        for (int k = 0; k < 3; k++) {
            double c = either(scale[k]), h = scale[k] * size * unit();
            box.lo[k] = c - h, box.hi[k] = c + h;
            middle[k] = fw_box3_middle(&box, k, &half[k]);
        }
        fw_workspace_loop_box known;
        fw_workspace_loop_pose_box(&loop, &box, &known);
        for (int n = 0; n < 20; n++) {
            double pose[3], angle[FW_SIX];
            int leg;
            for (int k = 0; k < 3; k++)
                pose[k] = fmin(
                    fmax(middle[k] + (n < 8 ? (n >> k & 1 ? half[k] : -half[k]) : either(half[k])),
                         box.lo[k]),
                    box.hi[k]);
            bool there =
                fw_workspace_six_bar_inverse(&f.mechanism, pose[0], pose[1], pose[2], angle, &leg);
            if (known.reached == FW_OUT_OF_REACH) assert_false(there);
            if (known.reached != FW_REACHED) continue;
            assert_true(there);
            for (int j = 0; j < FW_SIX; j++) {
                const fw_workspace_form *psi = &known.psi[j];
                double line = 0, value = left_or_right(&loop, j, angle[j]);
                for (int k = 0; k < 3; k++)
                    line += psi->grad[k] * (pose[k] - middle[k]);
                /* the plain inverse rounds by some 1e-15 */
                double low = psi->at.lo + line - psi->rest, high = psi->at.hi + line + psi->rest;
                if (fabs(low) > 3 || fabs(high) > 3) continue;
                if (!(low <= value + 2e-14 && value - 2e-14 <= high))
                    fail_msg("hinge %d: %.17g not in [%.17g, %.17g]", j, value, low, high);
                held++;
            }
        }
    }
    assert_true(held > 100000);
}

/* a box of rotations of A, B, C: its platform and its right leg hold what the inverse says of the
   pose they lead to; the remainder is of second order */
static void joint_boxes_close(void **state) {
    (void)state;
    seed = 4;
    long held = 0;
    for (int i = 0; i < 2000; i++) {
        six_bar_fixture f;
        fw_workspace_loop loop;
        if (!strewn(&f, 200, &loop)) continue;
        fw_workspace_box3 box;
        double half[3], middle[3], size = pow(10, -1 - 4 * unit());
        for (int k = 0; k < 3; k++) {
            double c = either(0.15), h = size * unit();
            box.lo[k] = c - h, box.hi[k] = c + h;
            middle[k] = fw_box3_middle(&box, k, &half[k]);
        }
        fw_workspace_loop_box known;
        const fw_maths_interval all = {-(double)INFINITY, (double)INFINITY};
        fw_workspace_loop_joint_box(&loop, &box, all, FW_WANT_ALL, &known);
        if (known.reached != FW_REACHED) continue;
        for (int n = 0; n < 10; n++) {
            double q[3], angle[FW_SIX], pose[3];
            for (int k = 0; k < 3; k++)
                q[k] = middle[k] + either(half[k]);
            /* forward: C and the platform of the left leg */
            const fw_workspace_leg *l = &loop.leg[0];
            double a = q[0], b = q[0] + q[1], c = q[0] + q[1] + q[2];
            pose[0] = l->base.x + cos(a) * l->a.x - sin(a) * l->a.y + cos(b) * l->b.x -
                      sin(b) * l->b.y - cos(c) * l->to.x + sin(c) * l->to.y - loop.centre.x;
            pose[1] = l->base.y + sin(a) * l->a.x + cos(a) * l->a.y + sin(b) * l->b.x +
                      cos(b) * l->b.y - sin(c) * l->to.x - cos(c) * l->to.y - loop.centre.y;
            pose[2] = c;
            int leg;
            assert_true(
                fw_workspace_six_bar_inverse(&f.mechanism, pose[0], pose[1], pose[2], angle, &leg));
            for (int j = 0; j < FW_SIX + 3; j++) {
                const fw_workspace_form *form =
                    j < FW_SIX ? &known.psi[j] : &known.extent[j - FW_SIX];
                double value = j < FW_SIX ? left_or_right(&loop, j, angle[j]) : pose[j - FW_SIX];
                double line = 0, slack = j < FW_SIX ? 1e-13 : 1e-17;
                if (j == FW_SIX + 2) slack = 1e-14;
                for (int k = 0; k < 3; k++)
                    line += form->grad[k] * (q[k] - middle[k]);
                double low = form->at.lo + line - form->rest;
                double high = form->at.hi + line + form->rest;
                if (j < FW_SIX && (fabs(low) > 3 || fabs(high) > 3)) continue;
                if (!(low <= value + slack && value - slack <= high))
                    fail_msg("form %d: %.17g not in [%.17g, %.17g]", j, value, low, high);
                held++;
            }
        }
    }
    assert_true(held > 50000);
}

static void remainders_fall_fourfold(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    fw_workspace_loop loop;
    assert_true(fw_workspace_loop_set_up(&f.mechanism, &loop));
    double before[FW_SIX] = {0};
    for (int n = 0; n < 5; n++) {
        double h = 0.01 / (1 << n);
        fw_workspace_box3 box = {{0.02 - h, -0.03 - h, 0.01 - h}, {0.02 + h, -0.03 + h, 0.01 + h}};
        fw_workspace_loop_box known;
        const fw_maths_interval all = {-(double)INFINITY, (double)INFINITY};
        fw_workspace_loop_joint_box(&loop, &box, all, FW_WANT_ALL, &known);
        assert_int_equal(known.reached, FW_REACHED);
        for (int j = 3; j < FW_SIX; j++) {
            if (n > 1) assert_near(before[j] / known.psi[j].rest, 4.0, 0.4);
            before[j] = known.psi[j].rest;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stretched_leg_has_no_side),
        cmocka_unit_test(forms_hold_every_pose),
        cmocka_unit_test(joint_boxes_close),
        cmocka_unit_test(remainders_fall_fourfold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
