/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/certify.h"
#include "base/constants.h"
#include "base/text.h"

enum { ENDS = 2 * FW_SIX, DEPTH = 120 }; /* ends: least of A..F, then most */

typedef struct proving {
    const fw_arena *arena;
    const fw_workspace_loop *loop;
    double relative, size[3];
    fw_workspace_proof *proof;
    double found[ENDS]; /* best proved at a pose so far, as a quantity that is to be largest */
    double bound[ENDS]; /* largest over the leaves */
} proving;

/* the joint angle of hinge e % 6, or its negative for the ends from below */
static double towards(int e, fw_maths_interval angle, bool far) {
    if (e < FW_SIX) return far ? -angle.lo : -angle.hi;
    return far ? angle.hi : angle.lo;
}

/* rotations beyond +-180 deg would be others by a turn */
static bool unambiguous(fw_maths_interval psi) {
    return psi.lo > -FW_PI && psi.hi < FW_PI;
}

static fw_maths_interval angle_over(const proving *p, const fw_workspace_loop_box *known, int hinge,
                                    const double half[3], bool *clear) {
    fw_maths_interval psi = fw_form_range(&known->psi[hinge], half);
    *clear = *clear && unambiguous(psi);
    return fw_workspace_loop_angle_range(p->loop, hinge, psi);
}

/* what the hinges' angles are at one pose; false: out of reach for certain */
static bool try_pose(proving *p, const double pose[3]) {
    const fw_workspace_box3 box = {{pose[0], pose[1], pose[2]}, {pose[0], pose[1], pose[2]}};
    fw_workspace_loop_box known;
    double half[3];
    for (int i = 0; i < 3; i++)
        fw_box3_middle(&box, i, &half[i]);
    fw_workspace_loop_pose_box(p->loop, &box, &known);
    if (known.reached == FW_OUT_OF_REACH) return false;
    if (known.reached != FW_REACHED) return true;
    for (int e = 0; e < ENDS; e++) {
        bool clear = true;
        fw_maths_interval angle = angle_over(p, &known, e % FW_SIX, half, &clear);
        double now = towards(e, angle, false);
        if (!clear || !(now > p->found[e])) continue;
        p->found[e] = now;
        fw_workspace_extreme *at = e < FW_SIX ? &p->proof->least[e] : &p->proof->most[e - FW_SIX];
        *at = (fw_workspace_extreme){.pose = {pose[0], pose[1], pose[2]}, .angle_rad = angle};
    }
    return true;
}

static void pose_in(const fw_workspace_box3 *box, int corner, double pose[3]) {
    for (int i = 0; i < 3; i++) {
        double unused;
        pose[i] = corner < 0        ? fw_box3_middle(box, i, &unused)
                  : corner >> i & 1 ? box->hi[i]
                                    : box->lo[i];
    }
}

/* one enclosure of the box: does it say all that is wanted? */
static bool enough(proving *p, const fw_workspace_box3 *box, fw_workspace_reached *reached) {
    fw_workspace_loop_box known;
    double half[3], far[ENDS];
    for (int i = 0; i < 3; i++)
        fw_box3_middle(box, i, &half[i]);
    fw_workspace_loop_pose_box(p->loop, box, &known);
    *reached = known.reached;
    if (known.reached != FW_REACHED) return false;
    bool clear = true;
    for (int e = 0; e < ENDS; e++) {
        far[e] = towards(e, angle_over(p, &known, e % FW_SIX, half, &clear), true);
        double other = fmax(fabs(p->found[e]), fabs(p->found[(e + FW_SIX) % ENDS]));
        if (!(far[e] <= p->found[e] + p->relative * other + 1e-12)) clear = false;
    }
    for (int e = 0; e < ENDS && clear; e++)
        p->bound[e] = fmax(p->bound[e], far[e]);
    return clear;
}

/* the coordinate along which the box is longest, measured in the whole box; FW_NONE: no double lies
   between its ends */
static int longest(const proving *p, const fw_workspace_box3 *box) {
    int axis = FW_NONE;
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        double width = box->hi[i] - box->lo[i], c = 0.5 * (box->lo[i] + box->hi[i]);
        if (!(c > box->lo[i] && c < box->hi[i]) || !(width / p->size[i] > most)) continue;
        most = width / p->size[i];
        axis = i;
    }
    return axis;
}

static fw_workspace_proof_end walk(proving *p, const fw_workspace_box3 *whole, long most,
                                   fw_text *tree, double pose[3]) {
    fw_workspace_box3 stack[DEPTH];
    int depth = 0;
    stack[depth++] = *whole;
    while (depth > 0) {
        fw_workspace_box3 box = stack[--depth];
        fw_workspace_reached reached;
        if (p->proof->boxes++ >= most || fw_arena_cancelled(p->arena)) return FW_UNDECIDED;
        pose_in(&box, -1, pose);
        if (!try_pose(p, pose)) return FW_REFUTED;
        if (enough(p, &box, &reached)) {
            fw_text_add(tree, ".");
            p->proof->leaves++;
            continue;
        }
        int axis = longest(p, &box);
        if (axis == FW_NONE || depth + 2 > DEPTH) return FW_UNDECIDED;
        static const char *const name[] = {"x", "y", "p"};
        fw_text_add(tree, name[axis]);
        double middle = 0.5 * (box.lo[axis] + box.hi[axis]);
        stack[depth] = stack[depth + 1] = box;
        stack[depth].lo[axis] = middle;
        stack[depth + 1].hi[axis] = middle; /* the lower half comes first */
        depth += 2;
    }
    return FW_PROVED;
}

/* Range of every joint angle over a box of poses, by branch and bound: a box is a leaf when its
   Taylor form (loop.h) bounds each of the twelve ends by what some pose is proved to reach, within
   `relative` of the larger end; else it is halved. Reached means that h^2 > 0 holds all over the
   box (loop.c): the elbow keeps its side, so that all poses are on one branch, and the leg is
   neither stretched nor folded (no serial singularity). in: box m, rad; out: ranges rad, proved;
   the tree of boxes. Error: proved. Cost about 1.5 us per box, some 100 boxes. Source:
   docs/theory/workspace.md. Test: test_certify.c, test_required.c,
   tests/accept/check_certificate.py. */
fw_status fw_workspace_certify_box(fw_arena *arena, const fw_workspace_loop *loop,
                                   const fw_workspace_box3 *box, double relative, long most,
                                   fw_workspace_proof *proof, double pose[3],
                                   fw_workspace_proof_end *end) {
    *proof = (fw_workspace_proof){0};
    proving p = {.arena = arena, .loop = loop, .relative = relative, .proof = proof};
    for (int i = 0; i < 3; i++) {
        proof->low[i] = box->lo[i], proof->high[i] = box->hi[i];
        p.size[i] = fmax(box->hi[i] - box->lo[i], 1e-300);
    }
    for (int e = 0; e < ENDS; e++)
        p.found[e] = p.bound[e] = -(double)INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        pose_in(box, corner, pose);
        if (try_pose(&p, pose)) continue;
        *end = FW_REFUTED;
        return FW_OK;
    }
    fw_text tree = fw_text_new(arena);
    *end = walk(&p, box, most, &tree, pose);
    FW_TRY(fw_text_end(&tree));
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    if (*end != FW_PROVED) return FW_OK;
    /* a hair more, so that another enclosure of the same numbers can confirm it */
    for (int i = 0; i < FW_SIX; i++)
        proof->angle_rad[i] =
            (fw_maths_interval){fw_down(-p.bound[i] - 1e-12), fw_up(p.bound[i + FW_SIX] + 1e-12)};
    proof->tree = tree.data;
    proof->proved = true;
    return FW_OK;
}
