/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distance of the outlines of two solids at one pose, and its extremes over a piece of a motion,
   for probes. Flexures, which are only held by discs, and the die's edge are no part of it.

   With both solids off their middle poses by (dx, t) points p, q that are D apart there are within
     D - s <= |q' - p'| <= D sqrt(1 + t_b^2) + s
   (clearance_pair.c: |q - p + t_b J(q - p)| = |q - p| sqrt(1 + t_b^2)). The first holds for all
   pairs of points, the second for the nearest ones, so that the distance lies between them all over
   the span of which the slack is. Spans are halved until that decides. */
#include "clearance/clearance_pair.h"
#include <math.h>

struct fw_clearance_gap {
    fw_clearance_pair pair;
    double drawn_m;
};

static void keep_walls(fw_clearance_pair *pair) {
    for (int k = 0; k < 2; k++) {
        int n = 0;
        for (int i = 0; i < pair->count[k]; i++)
            if (!pair->edge[k][i]->bends && !pair->edge[k][i]->always)
                pair->edge[k][n++] = pair->edge[k][i];
        pair->count[k] = n;
    }
    fw_clearance_pair_boxes(pair);
    fw_clearance_pair_measure(pair);
}

static fw_clearance_pose drawn_pose(const fw_clearance_things *things, int solid) {
    const fw_clearance_solid *s = &things->solid[solid];
    return (fw_clearance_pose){s->centre.x, s->centre.y, s->turned_rad, 0};
}

static void drawn_poses(const fw_clearance_pair *pair, fw_clearance_pose pose[2]) {
    pose[0] = drawn_pose(pair->things, pair->a);
    pose[1] = drawn_pose(pair->things, pair->b);
}

fw_status fw_clearance_gap_new(fw_arena *arena, const fw_clearance_things *things, int a, int b,
                               const fw_clearance_gap **gap) {
    const int ground = things->nbody;
    fw_clearance_gap *g = fw_arena_one(arena, fw_clearance_gap);
    fw_clearance_pose pose[2];
    FW_NEED(g);
    *gap = NULL;
    FW_TRY(fw_clearance_pair_new(arena, things, a < 0 ? ground : a, b < 0 ? ground : b, false,
                                 &g->pair));
    keep_walls(&g->pair);
    if (g->pair.count[0] == 0 || g->pair.count[1] == 0) return FW_OK;
    drawn_poses(&g->pair, pose);
    g->drawn_m = fw_clearance_pair_distance_first(&g->pair, pose);
    if (isfinite(g->drawn_m)) *gap = g; /* else no two edges may meet */
    return FW_OK;
}

double fw_clearance_gap_drawn_m(const fw_clearance_gap *gap) {
    return gap->drawn_m;
}

static void poses_of(const fw_clearance_pair *pair, const double *q, double longer,
                     fw_clearance_pose pose[2]) {
    for (int k = 0; k < 2; k++) {
        int solid = k ? pair->b : pair->a;
        const double *at = q + 3 * solid;
        pose[k] = solid == pair->things->nbody ? fw_clearance_ground_pose(pair->things)
                                               : (fw_clearance_pose){at[0], at[1], at[2], longer};
    }
}

double fw_clearance_gap_m(const fw_clearance_gap *gap, const double *q, double longer) {
    fw_clearance_pose pose[2];
    poses_of(&gap->pair, q, longer, pose);
    return fw_clearance_pair_distance(&gap->pair, pose, HUGE_VAL, NULL);
}

double fw_clearance_gap_moved_m(const fw_clearance_gap *gap, const double *q, double longer) {
    fw_clearance_pose drawn[2], pose[2];
    fw_clearance_slack slack;
    drawn_poses(&gap->pair, drawn);
    poses_of(&gap->pair, q, longer, pose);
    fw_clearance_slack_begin(&gap->pair, drawn, &slack);
    fw_clearance_slack_add(&gap->pair, pose, &slack);
    return fw_clearance_slack_m(&gap->pair, &slack);
}

/* ---- over a piece of a motion ---- */

typedef struct part {
    double from, to;
    double bound_m; /* proved of it */
} part;

/* what a part of the piece may hold: the distance in its middle, which is a pose of it, and a bound of
   all others */
static double look(const fw_clearance_gap *gap, const fw_clearance_path *path, double sign,
                   const part *now, double best, double *bound_m) {
    const fw_clearance_pair *pair = &gap->pair;
    const fw_clearance_span span = {.first = 0, .last = 0, .from = now->from, .to = now->to};
    fw_clearance_pose middle[2], pose[FW_CLEARANCE_NODES][2];
    fw_clearance_slack slack;
    fw_clearance_pair_at(pair, path, 0, 0.5 * (now->from + now->to), middle);
    fw_clearance_slack_begin(pair, middle, &slack);
    int n = fw_clearance_pair_coefficients(pair, path, &span, 0, pose);
    for (int i = 0; i < n; i++)
        fw_clearance_slack_add(pair, (const fw_clearance_pose *)pose[i], &slack);
    double off = fw_clearance_slack_m(pair, &slack), turn = slack.turn_rad[1];
    double limit = sign < 0 ? best + off : HUGE_VAL;
    double d = fw_clearance_pair_distance(pair, middle, limit, NULL);
    *bound_m = sign < 0 ? d - off : d * sqrt(1 + turn * turn) + off;
    return d;
}

static double moved_over(const fw_clearance_gap *gap, const fw_clearance_path *path) {
    const fw_clearance_span all = {.first = 0, .last = 0, .from = 0, .to = 1};
    fw_clearance_pose drawn[2], pose[FW_CLEARANCE_NODES][2];
    fw_clearance_slack slack;
    drawn_poses(&gap->pair, drawn);
    fw_clearance_slack_begin(&gap->pair, drawn, &slack);
    int n = fw_clearance_pair_coefficients(&gap->pair, path, &all, 0, pose);
    for (int i = 0; i < n; i++)
        fw_clearance_slack_add(&gap->pair, (const fw_clearance_pose *)pose[i], &slack);
    return fw_clearance_slack_m(&gap->pair, &slack);
}

static double farther(double sign, double a, double b) {
    return sign * a > sign * b ? a : b;
}

/* Extreme of D over t in [0, 1] of a piece: spans are halved until no bound (above) is beyond the
   best by more than max(1 nm, 0.1 % of it). In: poses as polynomials (m, rad); out: m, s. Error:
   from known->m to known->bound_m, proved, but for rounding. Cost: a distance (clearance_pair.c) for
   every span, one where the piece holds nothing new, some twenty where it does. Source:
   docs/theory/probes.md. Test: test_clearance_gap.c extremes_are_those_of_dense_samples */
void fw_clearance_gap_over(const fw_clearance_gap *gap, const fw_clearance_path *path, double sign,
                           fw_clearance_gap_extreme *known) {
    enum { DEPTH = 64, TRIES = 4096 };
    const double from_s = path->t_s[0], to_s = path->t_s[1], shortest = 1e-9;
    part stack[DEPTH];
    int depth = 0;
    known->moved_m = fmax(known->moved_m, moved_over(gap, path));
    known->bound_m = farther(sign, known->m, known->bound_m);
    stack[depth++] = (part){0, 1, sign < 0 ? 0 : HUGE_VAL};
    for (int tries = 0; depth > 0; tries++) {
        const part now = stack[--depth];
        double middle = 0.5 * (now.from + now.to), bound = now.bound_m;
        if (sign < 0 && known->m <= 0) { /* they meet: nothing is less */
            known->bound_m = 0;
            break;
        }
        if (tries < TRIES) {
            double d = look(gap, path, sign, &now, known->m, &bound);
            if (sign * (d - known->m) > 0) {
                known->m = d;
                known->t_s = from_s + middle * (to_s - from_s);
            }
        }
        double tolerance = fmax(1e-9, 1e-3 * fabs(known->m));
        bool small = now.to - now.from < shortest || depth + 2 > DEPTH || tries >= TRIES;
        if (small || sign * (bound - known->m) <= tolerance) {
            known->bound_m = farther(sign, known->bound_m, bound);
            continue;
        }
        stack[depth++] = (part){now.from, middle, bound};
        stack[depth++] = (part){middle, now.to, bound};
    }
    if (sign < 0) known->bound_m = fmax(0, known->bound_m);
}
