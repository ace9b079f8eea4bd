/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What poses strain: the strain over a box, and what is known of it at the worst poses. */
#include "base/text.h"
#include "workspace/pose_load.h"
#include <math.h>
#include <string.h>

/* ---- over a whole required box ---- */

enum { DEPTH = 120, GRID = 9, SIGNS = 1 << FW_SIX };

typedef struct bounding {
    const fw_arena *arena;
    const fw_workspace_hold *hold;
    double relative, size[3];
    bool sampled; /* nothing is proved */
    fw_workspace_strain_proof *proof;
    fw_workspace_view *over, *at; /* of a box and of a pose */
    double found[FW_SIX], bound[FW_SIX];
    double force_N[FW_SIX]; /* at most in the leaves so far; of samples the largest */
    double rub_Nm[FW_SIX];
} bounding;

/* the leg's forces are those of a wrench on the platform, which was looked at before */
static bool seen(const bounding *b, int grip, int from, bool own) {
    return own && from == 0 && grip > 0 && b->hold->grip[0].wrench;
}

/* no less than the size of a joint force at every pose of the box */
static double size_of(const fw_workspace_jet2 *force, const double half[3]) {
    const fw_maths_interval x = fw_jet_range(&force->x, half), y = fw_jet_range(&force->y, half);
    return fw_up(hypot(fmax(-x.lo, x.hi), fmax(-y.lo, y.hi)));
}

/* the same of hinge i at what was looked at last, with what friction adds to it */
static double force_at(const fw_workspace_view *v, const fw_workspace_gripped *by, int i) {
    return size_of(&by->force[i], v->load.half) + (v->hold->rubs ? v->rub.more_N[i] : 0.0);
}

static double rub_at(const fw_workspace_view *v, int i) {
    return v->hold->rubs ? v->rub.most_Nm[i] : 0.0;
}

/* strains at one pose, by the grips from..to that certainly hold it */
static void try_pose(bounding *b, const double pose[3], int from, int to) {
    const fw_workspace_box3 at = {{pose[0], pose[1], pose[2]}, {pose[0], pose[1], pose[2]}};
    if (!fw_workspace_view_at(b->at, &at)) return;
    for (int g = from; g <= to; g++) {
        fw_workspace_gripped *by = fw_workspace_view_grip(b->at, g);
        if (!by->holds || !by->certain) continue;
        for (int i = 0; i < FW_SIX; i++) {
            if (seen(b, g, from, by->own[i > 2])) continue;
            fw_maths_interval now = fw_workspace_view_strain(b->at, by, i, NULL);
            if (b->sampled)
                b->force_N[i] = fmax(b->force_N[i], force_at(b->at, by, i)),
                b->rub_Nm[i] = fmax(b->rub_Nm[i], rub_at(b->at, i));
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

/* What only pulls lets go on one side of a face through the box, where its strain with friction may be largest: no pose of
   either side says how large. Such a box is halved so far and no further, and its bound stands. */
static bool on_edge(const bounding *b, const fw_workspace_box3 *box, bool certain) {
    double most = 0.0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, (box->hi[i] - box->lo[i]) / b->size[i]);
    return b->hold->rubs && !certain && most < 0.05;
}

/* one enclosure of the box: does it say all that is wanted? Where a bound is too far the corner to
   which that strain grows is tried. */
static bool enough(bounding *b, const fw_workspace_box3 *box) {
    if (!fw_workspace_view_at(b->over, box)) return false;
    double far[FW_SIX] = {0}, most_N[FW_SIX] = {0}, rub_Nm[FW_SIX] = {0};
    for (int g = 0; g < b->hold->ngrip; g++) {
        if (!fw_workspace_view_grip(b->over, g)->holds) continue;
        for (int i = 0; i < FW_SIX; i++) {
            fw_workspace_gripped *by = fw_workspace_view_grip(b->over, g);
            if (seen(b, g, 0, by->own[i > 2])) continue;
            double slope[3], corner[3];
            double now = fw_workspace_view_strain(b->over, by, i, slope).hi;
            if (!close_enough(b, i, now)) {
                for (int k = 0; k < 3; k++)
                    corner[k] = slope[k] > 0.0 ? box->hi[k] : box->lo[k];
                if (worth(b, box, i, now)) try_pose(b, corner, g, g);
                if (!close_enough(b, i, now) && !on_edge(b, box, by->certain)) return false;
                by = fw_workspace_view_grip(b->over, g); /* the pose may have taken its place */
            }
            far[i] = fmax(far[i], now);
            most_N[i] = fmax(most_N[i], force_at(b->over, by, i));
            rub_Nm[i] = fmax(rub_Nm[i], rub_at(b->over, i));
        }
    }
    for (int i = 0; i < FW_SIX; i++) {
        b->bound[i] = fmax(b->bound[i], far[i]);
        b->force_N[i] = fmax(b->force_N[i], most_N[i]);
        b->rub_Nm[i] = fmax(b->rub_Nm[i], rub_Nm[i]);
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
    FW_NEED(b->over = fw_arena_alloc(arena, 2, sizeof *b->over));
    b->at = b->over + 1;
    FW_TRY(fw_workspace_view_new(arena, hold, b->over));
    FW_TRY(fw_workspace_view_new(arena, hold, b->at));
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
    memcpy(proof->rub_Nm, b.rub_Nm, sizeof b.rub_Nm);
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
    memcpy(proof->rub_Nm, b.rub_Nm, sizeof b.rub_Nm);
    return fw_arena_cancelled(arena) ? FW_CANCELLED : FW_OK;
}

fw_status fw_workspace_presses_itself(fw_arena *arena, const fw_workspace_hold *hold,
                                      const fw_workspace_box3 *box, bool *itself) {
    fw_workspace_view *view;
    FW_NEED(view = fw_arena_one(arena, fw_workspace_view));
    FW_TRY(fw_workspace_view_new(arena, hold, view));
    *itself = false;
    for (int c = 0; c < 9 * hold->ngrip && !*itself; c++) {
        fw_workspace_box3 at;
        for (int k = 0; k < 3; k++)
            at.lo[k] = at.hi[k] = c / hold->ngrip == 8       ? 0.5 * (box->lo[k] + box->hi[k])
                                  : c / hold->ngrip >> k & 1 ? box->hi[k]
                                                             : box->lo[k];
        if (!fw_workspace_view_at(view, &at)) continue;
        fw_workspace_view_grip(view, c % hold->ngrip);
        for (int i = 0; i < FW_SIX; i++)
            *itself = *itself || !(view->rub.most_Nm[i] < HUGE_VAL);
    }
    return FW_OK;
}

const char *fw_workspace_actuation(const fw_workspace_strain_proof *proof, int hinge) {
    return proof->hold->grip[proof->most[hinge].grip].name;
}

/* ---- first order: what is known at the worst poses beside the proved strain ---- */

static const double first_order_most = 0.2; /* beyond, first order says nothing */

/* A leg whose hinges are displaced is one whose platform hinge is. It is asked where the axis of a hinge is not known. */
typedef struct worst {
    const fw_workspace_hold *hold;
    const fw_workspace_strain_extreme *at;
    fw_workspace_response *response;
    int hinge;
} worst;

/* joint forces at a pose by a grip, C and D displaced; false: out of reach, or it does not hold there */
static bool held_at(const fw_workspace_hold *h, const double p[3], const double *shift,
                    const fw_workspace_grip *grip, fw_workspace_response *response,
                    fw_workspace_pose_load *load, fw_workspace_jet2 force[FW_SIX],
                    fw_workspace_rub *rub) {
    const fw_workspace_box3 at = {{p[0], p[1], p[2]}, {p[0], p[1], p[2]}};
    bool certain, own[2];
    if (!fw_workspace_pose_load_over(h, &at, shift, load)) return false;
    for (int k = 0; k < 3 && !grip->wrench; k++) {
        int i = grip->actuator[k];
        fw_workspace_pose_response(h, load, &h->actuator[i], &response[i]);
    }
    return fw_workspace_pose_forces(h, load, response, grip, &certain, own, force, rub);
}

/* strain of the hinge with C and D displaced; 0: out of reach */
static double displaced(const worst *w, const double shift[4], fw_workspace_pose_load *load,
                        fw_workspace_jet2 force[FW_SIX], fw_workspace_rub *rub) {
    if (!held_at(w->hold, w->at->pose, shift, &w->hold->grip[w->at->grip], w->response, load, force,
                 rub))
        return 0.0;
    fw_maths_interval s = fw_workspace_pose_strain(w->hold, load, w->hinge, &force[w->hinge],
                                                   w->hold->rubs ? rub : NULL, NULL);
    return 0.5 * (s.lo + s.hi);
}

/* How far a hinge's drift and give move the end that a stiff leg would have, times how the strain
   goes with that end. A leg that pushes the platform with R gives by C R the other way: its end has
   to be held that much further along R. The left leg pushes with R, the right one with -R. give:
   with its sign; drift: the size of what the drift does. in: N, strain/m; out: strain. */
static void given(const fw_mechanism *m, const fw_workspace_pose_load *load, int i,
                  const fw_workspace_jet2 *force, const double slope[2], double *give,
                  double *drift) {
    int k = m->pin[i].hinge;
    if (k == FW_NONE) return;
    const fw_mechanism_hinge *h = &m->hinge[k];
    double theta = load->theta[i].v.m, fx = force->x.v.m, fy = force->y.v.m;
    double sign = i < 3 ? 1.0 : -1.0, steep = hypot(slope[0], slope[1]);
    fw_flexure_hinge_at at;
    if (!fw_flexure_hinge_law_holds(&h->law, theta)) {
        *drift = HUGE_VAL;
        return;
    }
    fw_flexure_hinge_law_at(&h->law, theta, &at);
    double cx = 1.0 / at.kx_N_per_m.value, cy = 1.0 / at.ky_N_per_m.value;
    if (!isfinite(h->axis_rad)) { /* C is known within its two ends, whatever its direction */
        *give += sign * 0.5 * (cx + cy) * (slope[0] * fx + slope[1] * fy);
        *drift += steep * (0.5 * fabs(cx - cy) * hypot(fx, fy) + fabs(at.drift_m.value));
        return;
    }
    double c = load->frame[i].x.v.m, s = load->frame[i].y.v.m;
    double along = c * slope[0] + s * slope[1], across = c * slope[1] - s * slope[0];
    *give += sign * (along * (c * fx + s * fy) * cx + across * (c * fy - s * fx) * cy);
    *drift += fabs(across * at.drift_m.value);
}

/* first order, and its square for what that leaves out; far out it says nothing */
static void give_and_drift(const worst *w, const fw_mechanism *m,
                           const fw_workspace_pose_load *load, const fw_workspace_jet2 *force,
                           double strain, fw_workspace_give *out) {
    fw_workspace_pose_load beside;
    fw_workspace_rub rub;
    fw_workspace_jet2 other[FW_SIX];
    double slope[4], step = 1e-4 * w->hold->length_m, give = 0.0, drift = 0.0;
    for (int i = 0; i < 4; i++) {
        double up[4] = {0}, down[4] = {0};
        up[i] = step, down[i] = -step;
        slope[i] =
            (displaced(w, up, &beside, other, &rub) - displaced(w, down, &beside, other, &rub)) /
            (2.0 * step);
    }
    for (int i = 0; i < FW_SIX; i++)
        given(m, load, i, &force[i], &slope[i < 3 ? 0 : 2], &give, &drift);
    give /= strain, drift /= strain;
    out->give = fmax(give, 0.0) + drift + give * give;
    out->relief = fmax(-give, 0.0) + drift + give * give;
    if (!(fmax(out->give, out->relief) < first_order_most)) *out = fw_workspace_nothing_known;
}

/* ---- which signs friction may have ----
   A hinge rubs against the way that it turned last. Poses are come to from any side: with v the velocity of the platform
   and g_i the gradient of the angle of hinge i, signs are those of g_i . v, and where a hinge stands still in the last move,
   as it moved before. All of these choices are found next to the lines v = g_i x g_j, with either sign for i and j. In: a
   pose; out: strain that is reached at least, and the joint force there. Cost 120 strains. Test: test_pose_strain.c
   friction_of_either_sign */

/* forces with these signs; false: what only pulls would push */
static bool with_signs(const fw_workspace_hold *h, const fw_workspace_grip *grip,
                       const double size[3], const fw_workspace_jet2 force[FW_SIX],
                       const fw_workspace_rub *rub, const int sign[FW_SIX], double to[FW_SIX][2]) {
    enum { ROUNDS = 60 };
    double torque[FW_SIX] = {0};
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < FW_SIX; i++) {
            to[i][0] = force[i].x.v.m, to[i][1] = force[i].y.v.m;
            for (int j = 0; j < FW_SIX; j++)
                to[i][0] += torque[j] * rub->force[j][i].x.v.m,
                    to[i][1] += torque[j] * rub->force[j][i].y.v.m;
        }
        for (int j = 0; j < FW_SIX; j++)
            torque[j] =
                sign[j] * h->rub_arm_m[j] * (h->rub_preload_N[j] + hypot(to[j][0], to[j][1]));
    }
    for (int k = 0; k < 3 && !grip->wrench; k++) {
        double all = size[k];
        for (int j = 0; j < FW_SIX; j++)
            all += torque[j] * rub->size[j][k].v.m;
        if (h->actuator[grip->actuator[k]].pulls && all < 0) return false;
    }
    return true;
}

/* sign[k] of the n rubbing hinges when the platform moves along v */
static void signs_along(const fw_workspace_pose_load *load, double unit_m, const double v[3],
                        int sign[FW_SIX]) {
    for (int i = 0; i < FW_SIX; i++) {
        const fw_maths_centred *d = load->theta[i].d;
        const double turns = d[0].m * unit_m * v[0] + d[1].m * unit_m * v[1] + d[2].m * v[2];
        sign[i] = turns < 0 ? -1 : 1;
    }
}

static void reached_with(const worst *w, const fw_workspace_pose_load *load,
                         const fw_workspace_jet2 force[FW_SIX], const fw_workspace_rub *rub,
                         fw_workspace_load *out) {
    const fw_workspace_hold *h = w->hold;
    const double unit = h->length_m;
    double least = 0, size[3];
    fw_workspace_grip_sizes(h, load, w->response, &h->grip[w->at->grip], size);
    for (int k = 0; k < FW_SIX * FW_SIX * 8; k++) {
        const int a = k / 8 % FW_SIX, b = k / 8 / FW_SIX;
        const fw_maths_centred *p = load->theta[a].d, *q = load->theta[b].d;
        const double u[3] = {p[0].m * unit, p[1].m * unit, p[2].m},
                     x[3] = {q[0].m * unit, q[1].m * unit, q[2].m}, s = k & 4 ? -1 : 1;
        const double v[3] = {s * (u[1] * x[2] - u[2] * x[1]), s * (u[2] * x[0] - u[0] * x[2]),
                             s * (u[0] * x[1] - u[1] * x[0])};
        int sign[FW_SIX];
        double to[FW_SIX][2];
        if (a >= b) continue;
        signs_along(load, unit, v, sign);
        sign[a] = k & 1 ? 1 : -1, sign[b] = k & 2 ? 1 : -1;
        if (!with_signs(h, &h->grip[w->at->grip], size, force, rub, sign, to)) continue;
        const fw_workspace_jet2 now = fw_jet2_exact(to[w->hinge][0], to[w->hinge][1]);
        const double strain = fw_workspace_pose_strain(h, load, w->hinge, &now, NULL, NULL).lo;
        if (strain > least) least = strain, out->force_N = hypot(to[w->hinge][0], to[w->hinge][1]);
    }
    out->error = fmax(out->strain - least, out->error);
}

fw_status fw_workspace_load_of(fw_arena *arena, const fw_workspace_hold *hold,
                               const fw_mechanism *m, const fw_workspace_strain_proof *proof,
                               int hinge, const fw_workspace_give *give, fw_workspace_load *out) {
    worst w = {.hold = hold, .at = &proof->most[hinge], .hinge = hinge};
    *out = (fw_workspace_load){.strain = proof->strain[hinge],
                               .most_N = proof->force_N[hinge],
                               .rub_Nm = proof->rub_Nm[hinge]};
    if (hold->section[hinge].n == 0) return FW_OK;
    FW_NEED(w.response = fw_arena_array(arena, fw_workspace_response, (size_t)hold->nactuator + 1));
    fw_workspace_pose_load load;
    fw_workspace_rub rub;
    fw_workspace_jet2 force[FW_SIX];
    const double none[4] = {0};
    double strain = displaced(&w, none, &load, force, &rub);
    out->known = true;
    out->error = fmax(out->strain - w.at->strain.lo, 0.0);
    out->x_m = w.at->pose[0], out->y_m = w.at->pose[1], out->phi_rad = w.at->pose[2];
    if (!(strain > 0.0)) return FW_OK; /* nothing turns */
    out->angle_rad = load.theta[hinge].v.m;
    out->force_N = hypot(force[hinge].x.v.m, force[hinge].y.v.m);
    if (hold->rubs) reached_with(&w, &load, force, &rub, out);
    out->actuation = hold->grip[w.at->grip].name;
    if (hold->given_by)
        FW_NEED(out->actuation =
                    fw_arena_printf(arena, "%s; against it %s", out->actuation, hold->given_by));
    int k = m->pin[hinge].hinge;
    out->over_rotation = strain / (fabs(out->angle_rad) * m->hinge[k].closed_form.strain_per_rad);
    fw_workspace_give by = *give;
    if (by.first_order) give_and_drift(&w, m, &load, force, strain, &by);
    out->give = by.give, out->relief = by.relief, out->added = by.added;
    return FW_OK;
}

void fw_workspace_load_both(const fw_workspace_load *a, const fw_workspace_load *b,
                            fw_workspace_load *out) {
    double of_a = a->strain * (1.0 + a->added), of_b = b->strain * (1.0 + b->added);
    fw_workspace_load most = b->strain > a->strain ? *b : *a;
    most.most_N = fmax(a->most_N, b->most_N), most.rub_Nm = fmax(a->rub_Nm, b->rub_Nm);
    double all = fmax(of_a, of_b);
    if (all > 0.0) {
        double least = fmax(of_a * (1.0 - a->relief), of_b * (1.0 - b->relief));
        most.added = all / most.strain - 1.0;
        most.give = fmax(of_a * (1.0 + a->give), of_b * (1.0 + b->give)) / all - 1.0;
        most.relief = 1.0 - least / all;
    }
    *out = most;
}

/* of one pose and grip, with every choice of friction's signs: how many */
static int forces_at(const fw_workspace_hold *h, fw_workspace_response *response,
                     const double pose[3], int grip, double *force_N) {
    fw_workspace_pose_load load;
    fw_workspace_rub rub = {0};
    fw_workspace_jet2 force[FW_SIX];
    double size[3] = {0}, to[FW_SIX][2];
    int n = 0;
    if (!held_at(h, pose, NULL, &h->grip[grip], response, &load, force, &rub)) return 0;
    if (h->rubs) fw_workspace_grip_sizes(h, &load, response, &h->grip[grip], size);
    for (int k = 0; k < (h->rubs ? SIGNS : 1); k++) {
        int sign[FW_SIX];
        bool other = false; /* of a hinge that does not rub */
        for (int i = 0; i < FW_SIX; i++) {
            sign[i] = h->rubs ? (k >> i & 1 ? 1 : -1) : 0;
            other = other || (h->rubs && !rub.rubs[i] && sign[i] > 0);
        }
        if (other || (!with_signs(h, &h->grip[grip], size, force, &rub, sign, to) && h->rubs))
            continue;
        memcpy(force_N + 12 * n++, to, sizeof to);
    }
    return n;
}

/* by one scene */
static fw_status forces_of(fw_arena *arena, const fw_workspace_strain_proof *proof,
                           const double low[3], const double high[3], double *force_N, int *n) {
    const fw_workspace_hold *h = proof->hold;
    fw_workspace_response *response;
    FW_NEED(response = fw_arena_array(arena, fw_workspace_response, (size_t)h->nactuator + 1));
    for (int k = 0; k < 8 * h->ngrip; k++) {
        const int c = k / h->ngrip;
        const fw_geometry_vec2 at =
            fw_workspace_in_layer(h, (c & 1 ? high : low)[0], (c & 2 ? high : low)[1]);
        const double pose[3] = {at.x, at.y, (c & 4 ? high : low)[2]};
        *n += forces_at(h, response, pose, k % h->ngrip, force_N + 12 * *n);
    }
    for (int i = 0; i < FW_SIX; i++)
        *n += forces_at(h, response, proof->most[i].pose, proof->most[i].grip, force_N + 12 * *n);
    return FW_OK;
}

fw_status fw_workspace_forces(fw_arena *arena, const fw_workspace_strain_proof *proof,
                              const double low[3], const double high[3], double **force_N, int *n) {
    size_t most = 0;
    for (const fw_workspace_strain_proof *p = proof; p; p = p->also)
        most += (size_t)(p->hold->rubs ? SIGNS : 1) * (8 * (size_t)p->hold->ngrip + FW_SIX);
    FW_NEED(*force_N = fw_arena_array(arena, double, 12 * most));
    *n = 0;
    for (const fw_workspace_strain_proof *p = proof; p; p = p->also)
        FW_TRY(forces_of(arena, p, low, high, *force_N, n));
    return FW_OK;
}
