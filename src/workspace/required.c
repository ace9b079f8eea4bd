/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/pose_load.h"
#include "base/constants.h"
#include "base/text.h"
#include "effects/effects.h"
#include <math.h>
#include <string.h>

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

/* Rotations of the links beyond +-180 deg would be others by a turn; those of C and D are what the platform's own has beyond
   them, however far it turns. */
static bool unambiguous(int hinge, fw_maths_interval psi) {
    return hinge == 2 || hinge == 3 || (psi.lo > -FW_PI && psi.hi < FW_PI);
}

static fw_maths_interval angle_over(const proving *p, const fw_workspace_loop_box *known, int hinge,
                                    const double half[3], bool *clear) {
    fw_maths_interval psi = fw_form_range(&known->psi[hinge], half);
    *clear = *clear && unambiguous(hinge, psi);
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

enum { COARSE = 9, FINE = 17, MOST_BOXES = 20000 };

/* of the proved ends of ranges, relative; of strains, which a verdict's band holds */
static const double sharpness = 1e-3, strain_sharpness = 2e-3;

static double along(const fw_workspace_box3 *box, int axis, int i, int n) {
    return box->lo[axis] + (box->hi[axis] - box->lo[axis]) * i / (n - 1);
}

/* largest |angle| of every joint over an n x n x n grid; false at a pose out of reach (in `at`) */
static bool scan(const fw_workspace_six_bar *k, const fw_workspace_box3 *box, int n,
                 fw_workspace_peak peak[FW_SIX], double at[3]) {
    for (int j = 0; j < FW_SIX; j++)
        peak[j] = (fw_workspace_peak){0};
    for (int i = 0; i < n * n * n; i++) {
        int step[3] = {i % n, i / n % n, i / (n * n)};
        double angle[FW_SIX];
        int leg;
        for (int axis = 0; axis < 3; axis++)
            at[axis] = along(box, axis, step[axis], n);
        if (!fw_workspace_six_bar_solve(k, at[0], at[1], at[2], angle, &leg)) return false;
        for (int j = 0; j < FW_SIX; j++)
            if (fabs(angle[j]) > fabs(peak[j].angle_rad))
                peak[j] = (fw_workspace_peak){angle[j], 0, at[0], at[1], at[2]};
    }
    return true;
}

/* climbs from the best grid pose by steps that halve, staying inside the box */
static void refine(const fw_workspace_six_bar *k, const fw_workspace_box3 *box, int joint,
                   fw_workspace_peak *peak) {
    double at[3] = {peak->x_m, peak->y_m, peak->phi_rad};
    for (double step = 1.0 / (FINE - 1); step > 1e-9;) {
        bool better = false;
        for (int move = 0; move < 6; move++) {
            int axis = move / 2, leg;
            double width = box->hi[axis] - box->lo[axis], angle[FW_SIX], to[3];
            memcpy(to, at, sizeof to);
            to[axis] += (move % 2 ? -step : step) * width;
            to[axis] = fmin(fmax(to[axis], box->lo[axis]), box->hi[axis]);
            if (fw_workspace_six_bar_solve(k, to[0], to[1], to[2], angle, &leg) &&
                fabs(angle[joint]) > fabs(peak->angle_rad)) {
                *peak = (fw_workspace_peak){angle[joint], 0, to[0], to[1], to[2]};
                memcpy(at, to, sizeof at);
                better = true;
            }
        }
        if (!better) step *= 0.5;
    }
}

/* Where the proof is left undecided (close to a stretched leg, for instance): grid of 17^3 poses,
   best one climbed to its local maximum. Not a proof; the error is what the refinement from a 9^3
   to the 17^3 grid and the climb still changed. Cost about 6000 inverse kinematics, 1 ms. source:
   docs/theory/workspace.md; test_required.c corners_and_interior */
static bool sampled(const fw_workspace_six_bar *k, const fw_workspace_box3 *box,
                    fw_workspace_result *result, double at[3]) {
    fw_workspace_peak coarse[FW_SIX], fine[FW_SIX];
    if (!scan(k, box, COARSE, coarse, at) || !scan(k, box, FINE, fine, at)) return false;
    for (int j = 0; j < FW_SIX; j++) {
        refine(k, box, j, &coarse[j]);
        refine(k, box, j, &fine[j]);
        fine[j].error_rad = fabs(fabs(fine[j].angle_rad) - fabs(coarse[j].angle_rad)) +
                            1e-9 * fabs(fine[j].angle_rad);
        if (fabs(coarse[j].angle_rad) > fabs(fine[j].angle_rad)) {
            coarse[j].error_rad = fine[j].error_rad;
            fine[j] = coarse[j];
        }
        if (fabs(fine[j].angle_rad) > fabs(result->peak[j].angle_rad)) result->peak[j] = fine[j];
    }
    return true;
}

/* the end of the proved range that is farther from zero, and how much nearer the truth may be */
static fw_workspace_peak peak_of(const fw_workspace_proof *proof, int hinge) {
    fw_maths_interval range = proof->angle_rad[hinge];
    bool above = range.hi >= -range.lo;
    const fw_workspace_extreme *at = above ? &proof->most[hinge] : &proof->least[hinge];
    double far = above ? range.hi : range.lo, near = above ? at->angle_rad.lo : at->angle_rad.hi;
    return (fw_workspace_peak){far, fw_up(fabs(far - near)), at->pose[0], at->pose[1], at->pose[2]};
}

/* ---- what devices have in common ---- */

enum { PROVED = 8, TREE_MOST = 4096 };

typedef struct proved {
    fw_workspace_loop loop; /* doubles alone: compared as bytes */
    fw_workspace_box3 box;
    fw_workspace_proof proof; /* its tree is the one below */
    char tree[TREE_MOST];
} proved;

struct fw_workspace_kept {
    proved item[PROVED];
    int next; /* to be replaced */
    fw_workspace_poses *poses;
};

fw_status fw_workspace_kept_new(fw_arena *arena, fw_workspace_kept **kept) {
    FW_NEED(*kept = fw_arena_one(arena, fw_workspace_kept));
    return fw_workspace_poses_new(arena, &(*kept)->poses);
}

static const proved *find(const fw_workspace_kept *all, const fw_workspace_loop *loop,
                          const fw_workspace_box3 *box) {
    for (int i = 0; all && i < PROVED; i++) {
        const proved *k = &all->item[i];
        if (k->proof.proved && memcmp(&k->box, box, sizeof *box) == 0 &&
            memcmp(&k->loop, loop, sizeof *loop) == 0)
            return k;
    }
    return NULL;
}

static void keep(fw_workspace_kept *all, const fw_workspace_loop *loop,
                 const fw_workspace_box3 *box, const fw_workspace_proof *proof) {
    const size_t n = strlen(proof->tree) + 1;
    if (!all || n > TREE_MOST) return;
    proved *k = &all->item[all->next];
    all->next = (all->next + 1) % PROVED;
    k->loop = *loop, k->box = *box, k->proof = *proof;
    memcpy(k->tree, proof->tree, n);
}

static fw_status certify(fw_arena *arena, const fw_workspace_loop *loop, fw_workspace_kept *kept,
                         const fw_workspace_box3 *box, fw_workspace_proof *proof, double pose[3],
                         fw_workspace_proof_end *end) {
    const proved *known = find(kept, loop, box);
    if (!known) {
        FW_TRY(fw_workspace_certify_box(arena, loop, box, sharpness, MOST_BOXES, proof, pose, end));
        if (*end == FW_PROVED) keep(kept, loop, box, proof);
        return FW_OK;
    }
    *end = FW_PROVED;
    *proof = known->proof;
    FW_NEED(proof->tree = fw_arena_strdup(arena, known->tree));
    return FW_OK;
}

/* of one box and what is given in two scenes: the worse one of every hinge */
static void both(fw_workspace_strain_proof *now, fw_workspace_strain_proof *all) {
    all->proved = all->proved && now->proved;
    for (int i = 0; i < FW_SIX; i++) {
        all->force_N[i] = fmax(all->force_N[i], now->force_N[i]);
        all->rub_Nm[i] = fmax(all->rub_Nm[i], now->rub_Nm[i]);
        if (now->strain[i] > all->strain[i])
            all->strain[i] = now->strain[i], all->most[i] = now->most[i];
    }
    now->also = all->also, all->also = now;
}

typedef struct required_box { /* of one box */
    const fw_mechanism *m;
    const fw_workspace_loop *loop; /* as drawn */
    fw_workspace_kept *kept;
    const fw_workspace_box3 *box;
    fw_workspace_result *result;
    int index;
} required_box;

/* at: a pose that pins do not reach, or NULL. true: the box is not reached, for certain or with pins; what is certain is
   named, else the first one */
static bool is_beyond(const required_box *q, const fw_workspace_loop *loop,
                      const fw_workspace_box3 *box, const double *at) {
    fw_workspace_result *r = q->result;
    fw_workspace_beyond now;
    if (!fw_workspace_beyond_of(q->m, loop, box, at, &now)) return false;
    if (r->reachable || (now.certain && !r->beyond.certain))
        r->beyond = now, r->fail_box = q->index;
    r->reachable = false;
    return true;
}

/* what holds the box where the ground stands at `strain`, and what is given in that scene, or in none (NULL); box: in the
   layer's lengths */
static fw_status held(fw_arena *arena, const required_box *q, const fw_device_scene *scene,
                      double strain, fw_workspace_box3 *box, fw_workspace_hold *hold) {
    fw_workspace_loop *loop;
    const fw_geometry_vec2 middle = fw_mechanism_ground_centre(q->m);
    const fw_workspace_hold of = {.loop = q->loop, .strain = strain, .middle = middle};
    FW_NEED(loop = fw_arena_one(arena, fw_workspace_loop));
    *box = *q->box;
    for (int end = 0; end < 2 && strain != 0; end++) {
        double *at = end ? box->hi : box->lo;
        const fw_geometry_vec2 stands = fw_workspace_in_layer(&of, at[0], at[1]);
        at[0] = stands.x, at[1] = stands.y;
    }
    *loop = *q->loop;
    for (int side = 0; side < 2; side++) {
        fw_geometry_vec2 *base = &loop->leg[side].base;
        *base = fw_workspace_on_ground(&of, base->x, base->y);
    }
    FW_TRY(fw_workspace_hold_of(arena, q->m, strain == 0 ? q->loop : loop, box,
                                q->kept ? q->kept->poses : NULL, hold));
    hold->strain = strain, hold->middle = middle;
    FW_TRY(fw_workspace_hold_given(arena, q->m, scene, hold));
    if (strain != 0)
        FW_NEED(hold->given_by = fw_arena_printf(
                    arena, "%s%sthe growth of the layer on its carrier in scene %s",
                    hold->given_by ? hold->given_by : "", hold->given_by ? ", " : "", scene->name));
    return FW_OK;
}

/* The legs of a layer that grew: rotations of the box, which all poses of it have to have, too. *whole: all are reached */
static fw_status grown_rotations(fw_arena *arena, const required_box *q,
                                 const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                                 bool *whole) {
    fw_workspace_proof found;
    fw_workspace_proof_end end;
    double at[3];
    FW_TRY(certify(arena, hold->loop, q->kept, box, &found, at, &end));
    if (end == FW_REFUTED) *whole = !is_beyond(q, hold->loop, box, at);
    if (end == FW_UNDECIDED) q->result->certified = false;
    for (int j = 0; j < FW_SIX && end == FW_PROVED; j++) {
        fw_workspace_peak now = peak_of(&found, j);
        const fw_geometry_vec2 seen = fw_workspace_on_substrate(hold, now.x_m, now.y_m);
        now.x_m = seen.x, now.y_m = seen.y;
        if (fabs(now.angle_rad) > fabs(q->result->peak[j].angle_rad)) q->result->peak[j] = now;
    }
    return FW_OK;
}

/* Strains over one box, and the worst pose so far of every hinge. scene: whose weight, contacts, friction and heat are
   given; NULL: none */
static fw_status one_strain(fw_arena *arena, const required_box *q, const fw_device_scene *scene,
                            double strain, fw_workspace_strain_proof *proof, bool *whole) {
    fw_workspace_hold *hold = fw_arena_one(arena, fw_workspace_hold);
    fw_workspace_result *result = q->result;
    fw_workspace_proof_end end;
    FW_NEED(hold);
    fw_workspace_box3 box;
    FW_TRY(held(arena, q, scene, strain, &box, hold));
    if (hold->unknown) result->unknown = hold->unknown;
    if (hold->badly_by && (!result->badly_by || hold->badly < result->badly))
        result->badly_by = hold->badly_by, result->badly = hold->badly;
    bool itself = false;
    if (hold->rubs) FW_TRY(fw_workspace_presses_itself(arena, hold, &box, &itself));
    if (itself) { /* nothing is known of it */
        result->presses_itself = scene->name, hold->rubs = false;
        memset(hold->rub_arm_m, 0, sizeof hold->rub_arm_m);
    }
    FW_TRY(
        fw_workspace_certify_strain(arena, hold, &box, strain_sharpness, MOST_BOXES, proof, &end));
    if (end != FW_PROVED) {
        result->certified = false;
        FW_TRY(fw_workspace_sample_strain(arena, hold, &box, proof));
    }
    fw_workspace_give give[FW_SIX];
    FW_TRY(fw_workspace_gives(arena, hold, q->m, &box, proof, give));
    for (int i = 0; i < FW_SIX; i++) {
        if (hold->section[i].n == 0) continue;
        fw_workspace_load now, was = result->load[i];
        FW_TRY(fw_workspace_load_of(arena, hold, q->m, proof, i, &give[i], &now));
        const fw_geometry_vec2 seen = fw_workspace_on_substrate(hold, now.x_m, now.y_m);
        now.x_m = seen.x, now.y_m = seen.y;
        bool worse = !was.known || now.strain > was.strain;
        result->load[i] = worse ? now : was;
        if (was.known) fw_workspace_load_both(&was, &now, &result->load[i]);
    }
    return strain != 0 ? grown_rotations(arena, q, hold, &box, whole) : FW_OK;
}

/* how a scene gives: nothing at all, or with the ground at these strains */
static int ways_of(const fw_mechanism *m, const fw_device_scene *s, double strain[2]) {
    fw_effects_heat_strains(m, s, strain);
    const double stress = fw_effects_stress_strain(m, s);
    strain[0] += stress, strain[1] += stress;
    int n = strain[1] > strain[0] ? 2 : strain[1] != 0 ? 1 : 0;
    if (n == 0 && fw_workspace_scene_gives(m, s)) n = 1, strain[0] = 0;
    return n;
}

/* By what each scene of the flow gives, as it may be in any of them. *whole: all of the box is reached */
static fw_status all_strains(fw_arena *arena, const required_box *q,
                             fw_workspace_strain_proof *proof, bool *whole) {
    const fw_mechanism *m = q->m;
    bool any = false, all_give = true, first = true;
    double strain[2];
    for (int i = 0; i < m->device->nscene; i++) {
        const fw_device_scene *s = &m->device->scene[i];
        if (!fw_device_in_flow(s->flow, m->variant->flow)) continue;
        any = true;
        all_give = all_give && ways_of(m, s, strain) > 0;
    }
    for (int i = any && all_give ? 0 : -1; i < m->device->nscene; i++) {
        const fw_device_scene *s = i < 0 ? NULL : &m->device->scene[i];
        if (s && !fw_device_in_flow(s->flow, m->variant->flow)) continue;
        const int ways = s ? ways_of(m, s, strain) : 1;
        for (int k = 0; k < ways; k++) {
            fw_workspace_strain_proof *now =
                first ? proof : fw_arena_one(arena, fw_workspace_strain_proof);
            FW_NEED(now);
            FW_TRY(one_strain(arena, q, s, s ? strain[k] : 0, now, whole));
            if (!first) both(now, proof);
            first = false;
        }
    }
    return FW_OK;
}

static void take_peaks(const fw_workspace_proof *proof, fw_workspace_result *result) {
    for (int j = 0; j < FW_SIX; j++) {
        const fw_workspace_peak now = peak_of(proof, j);
        if (fabs(now.angle_rad) > fabs(result->peak[j].angle_rad)) result->peak[j] = now;
    }
}

/* one required box: proved where that can be, else sampled; *whole: it is reached */
static fw_status one_box(fw_arena *arena, const fw_workspace_six_bar *k, bool provable,
                         const required_box *q, fw_workspace_proof *proof, bool *whole) {
    const fw_workspace_box3 *box = q->box;
    fw_workspace_result *result = q->result;
    result->volume_m2_rad +=
        (box->hi[0] - box->lo[0]) * (box->hi[1] - box->lo[1]) * (box->hi[2] - box->lo[2]);
    fw_workspace_proof_end end = FW_UNDECIDED;
    double at[3];
    if (provable) FW_TRY(certify(arena, q->loop, q->kept, box, proof, at, &end));
    *whole = end == FW_PROVED;
    if (end == FW_UNDECIDED) {
        result->certified = false;
        *whole = sampled(k, box, result, at);
    }
    *whole = !is_beyond(q, q->loop, box, *whole ? NULL : at);
    if (end == FW_PROVED) take_peaks(proof, result);
    return FW_OK;
}

/* Of a box that pins do not reach whole, and flexures may, a part that they do reach: from the place of it that is nearest to
   rest outward. Its poses are required, so that what is too much there is too much for the box. Test: test_program.py,
   test_overstraining_workspace_rejects */
static fw_status part_of_box(fw_arena *arena, const required_box *q) {
    static const double shares[] = {0.95, 0.85, 0.7, 0.5, 0.3};
    for (size_t k = 0; k < sizeof shares / sizeof *shares; k++) {
        fw_workspace_box3 box;
        fw_workspace_proof proof;
        fw_workspace_strain_proof strain = {0};
        fw_workspace_proof_end end;
        double at[3];
        bool whole = true;
        for (int j = 0; j < 3; j++) {
            const double rest = fmin(fmax(0, q->box->lo[j]), q->box->hi[j]);
            box.lo[j] = rest + shares[k] * (q->box->lo[j] - rest);
            box.hi[j] = rest + shares[k] * (q->box->hi[j] - rest);
        }
        FW_TRY(certify(arena, q->loop, q->kept, &box, &proof, at, &end));
        if (end != FW_PROVED) continue;
        required_box part = *q;
        part.box = &box;
        q->result->in_part = true;
        take_peaks(&proof, q->result);
        return all_strains(arena, &part, &strain, &whole);
    }
    return FW_OK;
}

fw_status fw_workspace_required(fw_arena *arena, const fw_mechanism *m, fw_workspace_kept *kept,
                                fw_diags *diags, fw_workspace_result *result) {
    size_t n = (size_t)m->device->nworkspace;
    bool *in_flow = fw_arena_array(arena, bool, n), *whole = fw_arena_array(arena, bool, n);
    fw_workspace_proof *proof = fw_arena_array(arena, fw_workspace_proof, n);
    FW_NEED(in_flow);
    FW_NEED(whole);
    fw_workspace_strain_proof *strain = fw_arena_array(arena, fw_workspace_strain_proof, n);
    fw_workspace_loop *loop = fw_arena_one(arena, fw_workspace_loop);
    FW_NEED(proof);
    FW_NEED(strain);
    FW_NEED(loop);
    *result = (fw_workspace_result){.reachable = true,
                                    .certified = true,
                                    .fail_box = FW_NONE,
                                    .asked = in_flow,
                                    .box_reachable = whole,
                                    .proof = proof,
                                    .strain = strain};
    fw_workspace_six_bar k;
    bool known = fw_workspace_six_bar_set_up(m, &k),
         provable = known && fw_workspace_loop_set_up(m, loop);
    const char *held = NULL;
    if (known) FW_TRY(fw_workspace_six_bar_foreign_joint(arena, m, &held));
    for (int i = 0; i < m->device->nworkspace; i++) {
        const fw_device_workspace_box *of = &m->device->workspace[i];
        if (!fw_device_in_flow(of->flow, m->variant->flow)) continue;
        if (!known) {
            fw_diag_error(diags, 200, of->place,
                          "a required workspace needs the six-bar's inverse kinematics: describe "
                          "the mechanism with <six-bar>, or state the motion as a scene");
            return FW_INPUT;
        }
        if (held)
            return fw_diag_error(diags, 200, of->place,
                                 "%s holds or drives the six-bar, so that its platform cannot take "
                                 "every pose of a required workspace: remove the <workspace> and "
                                 "state the motion as a scene, or remove the joint",
                                 held);
        result->required = true;
        in_flow[i] = true;
        const fw_workspace_box3 box = {{of->x_min_m, of->y_min_m, of->phi_min_rad},
                                       {of->x_max_m, of->y_max_m, of->phi_max_rad}};
        const required_box q = {
            .m = m, .loop = loop, .kept = kept, .box = &box, .result = result, .index = i};
        FW_TRY(one_box(arena, &k, provable, &q, &proof[i], &whole[i]));
        if (whole[i] && provable && m->nhinge > 0)
            FW_TRY(all_strains(arena, &q, &strain[i], &whole[i]));
        if (!whole[i] && !result->beyond.certain && provable && m->nhinge > 0)
            FW_TRY(part_of_box(arena, &q));
    }
    for (int i = 0; i < m->device->nscene && result->required; i++)
        if (fw_device_in_flow(m->device->scene[i].flow, m->variant->flow))
            FW_TRY(fw_workspace_left_out(arena, m, &m->device->scene[i], result));
    result->certified = result->certified && result->required && result->reachable;
    return FW_OK;
}
