/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least clearance over a box of the platform's poses. From the Taylor forms of the loop
   (workspace/loop.h): rotations of all hinges over a part of the box as value + gradient . d within
   a rest, d the displacement of the platform from the middle. A body at a pivot P that turns by t
   and whose pivot is carried round O by s goes, at its centre of mass G, by
     dG = s J(P - O) + t J(G - P) + e,  |e| <= s^2/2 |P - O| + t^2/2 |G - P|,
   which is linear in d but for rests. The linear parts at the eight corners bound the slack of the
   pair (clearance_slack.c), the rests come on top. */
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include "workspace/loop.h"
#include <math.h>

enum { LINKS = 5 };

typedef struct boxes {
    const fw_clearance_things *things;
    const fw_workspace_loop *loop;
    fw_workspace_box3 whole;
} boxes;

/* pose of one body over a part of the box */
typedef struct linear {
    fw_clearance_pose middle;
    double grad[3][3];       /* of x, y, phi by the platform's x, y, phi */
    double rest_m, rest_rad; /* what they may be off by */
} linear;

typedef struct turn { /* of a link from where it is drawn */
    double at, grad[3], rest, most;
} turn;

static turn turn_of(const fw_workspace_form *f, double sign, const double half[3]) {
    turn t = {.at = sign * 0.5 * (f->at.lo + f->at.hi),
              .rest = f->rest + 0.5 * (f->at.hi - f->at.lo)};
    for (int i = 0; i < 3; i++) {
        t.grad[i] = sign * f->grad[i];
        t.most += fabs(f->grad[i]) * half[i];
    }
    t.most += t.rest;
    return t;
}

static turn plus(turn a, turn b, double most) {
    turn t = {.at = a.at + b.at, .rest = a.rest + b.rest, .most = most};
    for (int i = 0; i < 3; i++)
        t.grad[i] = a.grad[i] + b.grad[i];
    return t;
}

/* the vector turned by t: its displacement is linear in d but for a rest */
static fw_geometry_vec2 carry(fw_geometry_vec2 drawn, const turn *t, linear *out) {
    fw_geometry_vec2 now = fw_geometry_vec_rotate(drawn, t->at), left = vec_left(now);
    double length = vec_length(drawn);
    for (int i = 0; i < 3; i++) {
        out->grad[0][i] += t->grad[i] * left.x;
        out->grad[1][i] += t->grad[i] * left.y;
    }
    out->rest_m += length * (t->rest + 0.5 * t->most * t->most);
    return now;
}

static void put(const fw_clearance_solid *solid, fw_geometry_vec2 centre, const turn *t,
                linear *out) {
    out->middle = (fw_clearance_pose){centre.x, centre.y, solid->turned_rad + t->at};
    for (int i = 0; i < 3; i++)
        out->grad[2][i] = t->grad[i];
    out->rest_rad = t->rest;
}

/* bodies AB, BC of the left leg or EF, DE of the right one; CD is the platform */
static void leg_poses(const boxes *b, const fw_workspace_loop_box *known, const double half[3],
                      int side, linear *lower, linear *upper, int first, int second) {
    const fw_workspace_leg *leg = &b->loop->leg[side];
    const int base = side ? 5 : 0, step = side ? -1 : 1;
    const fw_clearance_solid *solid = b->things->solid;
    turn t = turn_of(&known->psi[base], 1, half), e = turn_of(&known->psi[base + step], 1, half);
    turn both = plus(t, e, t.most + e.most);
    *lower = *upper = (linear){.rest_m = 0};
    fw_geometry_vec2 arm = vec_sub(solid[first].centre, leg->base);
    fw_geometry_vec2 at = vec_add(leg->base, carry(arm, &t, lower));
    put(&solid[first], at, &t, lower);
    fw_geometry_vec2 elbow = vec_add(leg->base, carry(leg->a, &t, upper));
    arm = vec_sub(solid[second].centre, vec_add(leg->base, leg->a));
    at = vec_add(elbow, carry(arm, &both, upper));
    put(&solid[second], at, &both, upper);
}

static void poses_of(const boxes *b, const fw_workspace_loop_box *known,
                     const fw_workspace_box3 *box, const double half[3], linear pose[LINKS]) {
    leg_poses(b, known, half, 0, &pose[0], &pose[1], 0, 1);
    leg_poses(b, known, half, 1, &pose[4], &pose[3], 4, 3);
    double unused, m[3];
    for (int i = 0; i < 3; i++)
        m[i] = fw_box3_middle(box, i, &unused);
    const fw_clearance_solid *cd = &b->things->solid[2];
    pose[2] = (linear){.middle = {cd->centre.x + m[0], cd->centre.y + m[1], cd->turned_rad + m[2]}};
    for (int i = 0; i < 3; i++)
        pose[2].grad[i][i] = 1;
}

static bool is_ground(const boxes *b, int solid) {
    return solid == b->things->nbody;
}

static linear linear_of(const boxes *b, const linear pose[LINKS], int solid) {
    const fw_clearance_solid *s = &b->things->solid[solid];
    if (!is_ground(b, solid)) return pose[solid];
    return (linear){.middle = {s->centre.x, s->centre.y, s->turned_rad}};
}

static fw_clearance_pose at_corner(const linear *l, const double half[3], int corner) {
    double q[3] = {l->middle.x_m, l->middle.y_m, l->middle.phi_rad};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            q[k] += (corner >> i & 1 ? half[i] : -half[i]) * l->grad[k][i];
    return (fw_clearance_pose){q[0], q[1], q[2]};
}

/* about given middle poses */
static double slack_about(const boxes *b, const fw_clearance_pair *pair, const linear pose[LINKS],
                          const double half[3], const fw_clearance_pose middle[2]) {
    fw_clearance_slack slack;
    linear l[2] = {linear_of(b, pose, pair->a), linear_of(b, pose, pair->b)};
    double rest = 0;
    fw_clearance_slack_begin(pair, middle, &slack);
    for (int corner = 0; corner < 8; corner++) {
        const fw_clearance_pose at[2] = {at_corner(&l[0], half, corner),
                                         at_corner(&l[1], half, corner)};
        fw_clearance_slack_add(pair, at, &slack);
    }
    for (int k = 0; k < 2; k++) {
        slack.turn_rad[k] += l[k].rest_rad;
        rest += l[k].rest_m + l[k].rest_rad * (vec_length(slack.lever[k]) + pair->reach_m);
    }
    return fw_clearance_slack_m(pair, &slack) + rest;
}

static fw_workspace_reached know(const boxes *b, const fw_clearance_region *region,
                                 fw_workspace_box3 *box, double half[3], linear pose[LINKS]) {
    fw_workspace_loop_box known;
    for (int i = 0; i < 3; i++) {
        box->lo[i] = region->low[i], box->hi[i] = region->high[i];
        fw_box3_middle(box, i, &half[i]);
    }
    fw_workspace_loop_pose_box(b->loop, box, &known);
    if (known.reached == FW_REACHED) poses_of(b, &known, box, half, pose);
    return known.reached;
}

static bool bound(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *region, fw_clearance_pose middle[2], double *slack_m) {
    const boxes *b = context;
    fw_workspace_box3 box;
    linear pose[LINKS];
    double half[3];
    fw_workspace_reached reached = know(b, region, &box, half, pose);
    *slack_m = reached == FW_OUT_OF_REACH ? HUGE_VAL : 0;
    if (reached != FW_REACHED) return false;
    middle[0] = linear_of(b, pose, pair->a).middle;
    middle[1] = linear_of(b, pose, pair->b).middle;
    *slack_m = slack_about(b, pair, pose, half, middle);
    return true;
}

/* the pose in the middle; part 0: the drawn one, if it is in the box */
static bool pose_of(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *region, double part, fw_clearance_least *at) {
    const boxes *b = context;
    fw_clearance_region one = *region;
    fw_workspace_box3 box;
    linear pose[LINKS];
    double half[3];
    for (int i = 0; i < 3; i++) {
        double middle = 0.5 * (region->low[i] + region->high[i]);
        double rest = fmin(fmax(0, region->low[i]), region->high[i]);
        one.low[i] = one.high[i] = part <= 0 ? rest : part >= 1 ? region->high[i] : middle;
        at->platform[i] = one.low[i];
    }
    if (know(b, &one, &box, half, pose) != FW_REACHED) return false;
    at->pose[0] = linear_of(b, pose, pair->a).middle;
    at->pose[1] = linear_of(b, pose, pair->b).middle;
    at->t_s = (double)NAN;
    return true;
}

static void drawn(const void *context, const fw_clearance_pair *pair, fw_clearance_pose pose[2]) {
    const boxes *b = context;
    for (int k = 0; k < 2; k++) {
        const fw_clearance_solid *s = &b->things->solid[k ? pair->b : pair->a];
        pose[k] = (fw_clearance_pose){s->centre.x, s->centre.y, s->turned_rad};
    }
}

static double moved(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *all) {
    const boxes *b = context;
    fw_workspace_box3 box;
    linear pose[LINKS];
    double half[3];
    if (know(b, all, &box, half, pose) != FW_REACHED) return 0;
    fw_clearance_pose from[2];
    drawn(b, pair, from);
    return slack_about(b, pair, pose, half, from);
}

static int split(const void *context, const fw_clearance_region *region,
                 fw_clearance_region half[FW_CLEARANCE_PARTS]) {
    const boxes *b = context;
    int axis = FW_NONE;
    double most = 1e-9;
    for (int i = 0; i < 3; i++) {
        double size = b->whole.hi[i] - b->whole.lo[i];
        double width = size > 0 ? (region->high[i] - region->low[i]) / size : 0;
        if (width > most) most = width, axis = i;
    }
    half[0] = half[1] = *region;
    if (axis == FW_NONE) return 0;
    half[0].high[axis] = half[1].low[axis] = 0.5 * (region->low[axis] + region->high[axis]);
    return 2;
}

static void rough(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *all, fw_clearance_pose middle[2], double *slack_m,
                  double *moved_m) {
    if (!bound(context, pair, all, middle, slack_m)) *slack_m = HUGE_VAL;
    *moved_m = 0; /* required poses are not off */
}

fw_status fw_clearance_of_box(fw_arena *arena, const fw_clearance_things *things,
                              const fw_mechanism *m, const fw_device_workspace_box *asked,
                              const fw_clearance_wish *wish, fw_clearance_least *least,
                              bool *known) {
    fw_workspace_loop loop;
    size_t n = (size_t)things->nbody + 1;
    fw_clearance_wish of_six = *wish;
    *known = fw_workspace_loop_set_up(m, &loop);
    if (!*known) return FW_OK;
    bool *may_meet = fw_arena_array(arena, bool, n *n);
    FW_NEED(may_meet);
    for (size_t i = 0; i < n * n; i++) {
        size_t a = i / n, b = i % n;
        bool six = (a < LINKS || a + 1 == n) && (b < LINKS || b + 1 == n);
        may_meet[i] = !six || (wish->may_meet && wish->may_meet[i]);
    }
    of_six.may_meet = may_meet;
    const fw_clearance_region all = {.low = {asked->x_min_m, asked->y_min_m, asked->phi_min_rad},
                                     .high = {asked->x_max_m, asked->y_max_m, asked->phi_max_rad}};
    boxes context = {.things = things, .loop = &loop};
    for (int i = 0; i < 3; i++)
        context.whole.lo[i] = all.low[i], context.whole.hi[i] = all.high[i];
    const fw_clearance_domain domain = {.context = &context,
                                        .bound = bound,
                                        .moved = moved,
                                        .pose = pose_of,
                                        .start = drawn,
                                        .rough = rough,
                                        .split = split};
    return fw_clearance_search(arena, things, &domain, &all, &of_six, least);
}
