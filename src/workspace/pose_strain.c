/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "workspace/pose_load.h"
#include <math.h>
#include <string.h>

enum { DEPTH = 120, GRID = 9 };

typedef struct bounding {
    const fw_arena *arena;
    const fw_workspace_hold *hold;
    double relative, size[3];
    bool sampled; /* nothing is proved */
    fw_workspace_strain_proof *proof;
    fw_workspace_response *over, *at; /* (nactuator) of a box and of a pose */
    double found[FW_SIX], bound[FW_SIX];
    double force_N[FW_SIX]; /* at most in the leaves so far; of samples the largest */
} bounding;

/* statics over the box for the grips from..to; false: a pose may be out of reach */
static bool look(const bounding *b, const fw_workspace_box3 *box, int from, int to,
                 fw_workspace_pose_load *load, fw_workspace_response *response) {
    const fw_workspace_hold *h = b->hold;
    if (!fw_workspace_pose_load_over(h, box, NULL, load)) return false;
    for (int i = 0; i < h->nactuator; i++) {
        bool used = false;
        for (int g = from; g <= to && !used; g++)
            for (int k = 0; k < 3 && !h->grip[g].wrench; k++)
                used = used || h->grip[g].actuator[k] == i;
        if (used) fw_workspace_pose_response(h, load, &h->actuator[i], &response[i]);
    }
    return true;
}

/* the leg's forces are those of a wrench on the platform, which was looked at before */
static bool seen(const bounding *b, int grip, int from, bool own) {
    return own && from == 0 && grip > 0 && b->hold->grip[0].wrench;
}

/* no less than the size of a joint force at every pose of the box */
static double size_of(const fw_workspace_jet2 *force, const double half[3]) {
    const fw_maths_interval x = fw_jet_range(&force->x, half), y = fw_jet_range(&force->y, half);
    return fw_up(hypot(fmax(-x.lo, x.hi), fmax(-y.lo, y.hi)));
}

/* strains at one pose, by the grips from..to that certainly hold it */
static void try_pose(bounding *b, const double pose[3], int from, int to) {
    const fw_workspace_box3 at = {{pose[0], pose[1], pose[2]}, {pose[0], pose[1], pose[2]}};
    fw_workspace_pose_load load;
    if (!look(b, &at, from, to, &load, b->at)) return;
    for (int g = from; g <= to; g++) {
        fw_workspace_jet2 force[FW_SIX];
        bool certain, own[2];
        if (!fw_workspace_pose_forces(b->hold, &load, b->at, &b->hold->grip[g], &certain, own,
                                      force) ||
            !certain)
            continue;
        for (int i = 0; i < FW_SIX; i++) {
            if (seen(b, g, from, own[i > 2])) continue;
            fw_maths_interval now = fw_workspace_pose_strain(b->hold, &load, i, &force[i], NULL);
            if (b->sampled) b->force_N[i] = fmax(b->force_N[i], size_of(&force[i], load.half));
            if (!(now.lo > b->found[i])) continue;
            b->found[i] = now.lo;
            b->proof->most[i] = (fw_workspace_strain_extreme){
                .pose = {pose[0], pose[1], pose[2]}, .grip = g, .strain = now};
        }
    }
}

static bool close_enough(const bounding *b, int hinge, double far) {
    return far <= b->found[hinge] * (1.0 + b->relative) + 1e-15;
}

/* a pose of the box may say more than is known: of large boxes only where their bound is near */
static bool worth(const bounding *b, const fw_workspace_box3 *box, int hinge, double bound) {
    double most = 0.0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, (box->hi[i] - box->lo[i]) / b->size[i]);
    return isfinite(bound) && (most < 0.2 || bound <= 1.03 * b->found[hinge]);
}

/* one enclosure of the box: does it say all that is wanted? Where a bound is too far the corner to
   which that strain grows is tried. */
static bool enough(bounding *b, const fw_workspace_box3 *box) {
    fw_workspace_pose_load load;
    if (!look(b, box, 0, b->hold->ngrip - 1, &load, b->over)) return false;
    double far[FW_SIX] = {0}, most_N[FW_SIX] = {0};
    for (int g = 0; g < b->hold->ngrip; g++) {
        fw_workspace_jet2 force[FW_SIX];
        bool certain, own[2];
        if (!fw_workspace_pose_forces(b->hold, &load, b->over, &b->hold->grip[g], &certain, own,
                                      force))
            continue;
        for (int i = 0; i < FW_SIX; i++) {
            if (seen(b, g, 0, own[i > 2])) continue;
            double slope[3] = {0}, corner[3];
            double now = fw_workspace_pose_strain(b->hold, &load, i, &force[i], slope).hi;
            if (!close_enough(b, i, now)) {
                for (int k = 0; k < 3; k++)
                    corner[k] = slope[k] > 0.0 ? box->hi[k] : box->lo[k];
                if (worth(b, box, i, now)) try_pose(b, corner, g, g);
                if (!close_enough(b, i, now)) return false;
            }
            far[i] = fmax(far[i], now);
            most_N[i] = fmax(most_N[i], size_of(&force[i], load.half));
        }
    }
    for (int i = 0; i < FW_SIX; i++) {
        b->bound[i] = fmax(b->bound[i], far[i]);
        b->force_N[i] = fmax(b->force_N[i], most_N[i]);
    }
    return true;
}

static int longest(const bounding *b, const fw_workspace_box3 *box) {
    int axis = FW_NONE;
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        double width = box->hi[i] - box->lo[i], c = 0.5 * (box->lo[i] + box->hi[i]);
        if (!(c > box->lo[i] && c < box->hi[i]) || !(width / b->size[i] > most)) continue;
        most = width / b->size[i];
        axis = i;
    }
    return axis;
}

static fw_workspace_proof_end walk(bounding *b, const fw_workspace_box3 *whole, long most,
                                   fw_text *tree) {
    static const char *const name[] = {"x", "y", "p"};
    fw_workspace_box3 stack[DEPTH];
    int depth = 0;
    stack[depth++] = *whole;
    while (depth > 0) {
        fw_workspace_box3 box = stack[--depth];
        if (b->proof->boxes++ >= most || fw_arena_cancelled(b->arena)) return FW_UNDECIDED;
        if (enough(b, &box)) {
            fw_text_add(tree, ".");
            b->proof->leaves++;
            continue;
        }
        int axis = longest(b, &box);
        if (axis == FW_NONE || depth + 2 > DEPTH) return FW_UNDECIDED;
        fw_text_add(tree, name[axis]);
        double middle = 0.5 * (box.lo[axis] + box.hi[axis]);
        stack[depth] = stack[depth + 1] = box;
        stack[depth].lo[axis] = middle;
        stack[depth + 1].hi[axis] = middle; /* the lower half comes first */
        depth += 2;
    }
    return FW_PROVED;
}

static fw_status start(fw_arena *arena, const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                       fw_workspace_strain_proof *proof, bounding *b) {
    *proof = (fw_workspace_strain_proof){.hold = hold};
    *b = (bounding){.arena = arena, .hold = hold, .proof = proof};
    size_t n = (size_t)hold->nactuator + 1;
    FW_NEED(b->over = fw_arena_array(arena, fw_workspace_response, n));
    FW_NEED(b->at = fw_arena_array(arena, fw_workspace_response, n));
    for (int i = 0; i < 3; i++)
        b->size[i] = fmax(box->hi[i] - box->lo[i], 1e-300);
    return FW_OK;
}

/* n poses along every coordinate */
static void grid(bounding *b, const fw_workspace_box3 *box, int n) {
    for (int i = 0; i < n * n * n; i++) {
        const int step[3] = {i % n, i / n % n, i / (n * n)};
        double pose[3];
        for (int k = 0; k < 3; k++)
            pose[k] = step[k] == n - 1 ? box->hi[k]
                                       : box->lo[k] + (box->hi[k] - box->lo[k]) * step[k] / (n - 1);
        try_pose(b, pose, 0, b->hold->ngrip - 1);
    }
}

/* Largest strain of every hinge over a box of poses, by branch and bound: a box is a leaf when the
   forms of pose_load.c bound the strain of each hinge under each grip by what some pose is proved
   to reach, within `relative`; else it is halved. in: box m, rad; out: strains, proved; the tree of
   boxes. Error: proved. Cost about 15 us a box and 5 us for each of its grips. Source:
   docs/theory/workspace.md. Test: test_pose_strain.c, tests/accept/check_certificate.py. */
fw_status fw_workspace_certify_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                      const fw_workspace_box3 *box, double relative, long most,
                                      fw_workspace_strain_proof *proof,
                                      fw_workspace_proof_end *end) {
    bounding b;
    FW_TRY(start(arena, hold, box, proof, &b));
    b.relative = relative;
    grid(&b, box, 2);
    fw_text tree = fw_text_new(arena);
    *end = walk(&b, box, most, &tree);
    FW_TRY(fw_text_end(&tree));
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    if (*end != FW_PROVED) return FW_OK;
    /* a hair more, so that another enclosure of the same numbers can confirm it */
    for (int i = 0; i < FW_SIX; i++)
        proof->strain[i] = b.bound[i] > 0.0 ? b.bound[i] * (1.0 + 1e-4) : 0.0;
    memcpy(proof->force_N, b.force_N, sizeof b.force_N);
    proof->tree = tree.data;
    proof->proved = true;
    return FW_OK;
}

fw_status fw_workspace_sample_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                     const fw_workspace_box3 *box,
                                     fw_workspace_strain_proof *proof) {
    bounding b;
    double coarse[FW_SIX];
    FW_TRY(start(arena, hold, box, proof, &b));
    b.sampled = true;
    grid(&b, box, GRID / 2 + 1);
    memcpy(coarse, b.found, sizeof coarse);
    grid(&b, box, GRID);
    for (int i = 0; i < FW_SIX; i++) /* the grid twice as fine found this much more */
        proof->strain[i] = b.found[i] + 2.0 * (b.found[i] - coarse[i]);
    memcpy(proof->force_N, b.force_N, sizeof b.force_N);
    return fw_arena_cancelled(arena) ? FW_CANCELLED : FW_OK;
}

const char *fw_workspace_actuation(const fw_workspace_strain_proof *proof, int hinge) {
    return proof->hold->grip[proof->most[hinge].grip].name;
}
