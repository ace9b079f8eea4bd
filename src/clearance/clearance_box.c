/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least clearance over a required box of the six-bar's poses, with all that rides on it. */
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include "workspace/loop.h"
#include "workspace/workspace.h"
#include <math.h>

/* ---- what rides on the six-bar ---- */

/* What rides on the six-bar without being of it, in a pose of the platform. A tree of bodies hangs on
   one of the six-bar's bodies (or on the ground); a joint that held two of these together would take
   freedom from the platform, and nothing could be required of it (workspace/loop.c). Joined by
   welds and flexures that nothing else deflects it goes with that body as it is drawn: a required
   pose has no loads of its own, and flexures at rest stay as they are. A pin without a flexure, a
   slider, a rod, a driver, or a spring to something that moves against it leaves its pose open.
   In: mechanism; out: of every body the one it goes with. Cost: bodies times joints.
   Test: tests/clearance/cases.py riders */

enum { LINKS = 5 };

/* body of the six-bar that a body goes with, FW_GROUND, or: its pose is open; not seen yet */
enum { OPEN = FW_GROUND - 1, NOT_SEEN = FW_GROUND - 2 };

static bool is_flexure(const fw_mechanism *m, int pin) {
    for (int i = 0; i < m->nhinge; i++)
        if (m->hinge[i].pin == pin) return true;
    return false;
}

/* what one of two joined bodies goes with the other goes with, too; true: that is new */
static bool spread(int a, int b, bool rigid, int *with) {
    int known = a == FW_GROUND ? FW_GROUND : with[a], other = b == FW_GROUND ? FW_GROUND : with[b];
    bool from_a = b >= LINKS && other == NOT_SEEN && known != NOT_SEEN;
    bool from_b = a >= LINKS && known == NOT_SEEN && other != NOT_SEEN;
    if (from_a) with[b] = rigid ? known : OPEN;
    if (from_b) with[a] = rigid ? other : OPEN;
    if (from_a || from_b) return true;
    /* a second joint that is not rigid, or one to what is open, opens the other */
    bool open = !rigid || known == OPEN || other == OPEN;
    bool more = false;
    if (open && a >= LINKS && known >= FW_GROUND) with[a] = OPEN, more = true;
    if (open && b >= LINKS && other >= FW_GROUND) with[b] = OPEN, more = true;
    return more;
}

static bool spring_pulls(const fw_mechanism *m, const int *with, int spring) {
    int a = m->spring[spring].body_a, b = m->spring[spring].body_b;
    int p = a == FW_GROUND ? FW_GROUND : with[a], q = b == FW_GROUND ? FW_GROUND : with[b];
    return p != q && (a >= LINKS || b >= LINKS);
}

/* with: (nbody) */
static void riders(const fw_mechanism *m, int *with) {
    for (int i = 0; i < m->nbody; i++)
        with[i] = i < LINKS ? i : NOT_SEEN;
    bool more = true;
    while (more) {
        more = false;
        for (int i = FW_SIX; i < m->npin; i++)
            more |= spread(m->pin[i].body_a, m->pin[i].body_b, is_flexure(m, i), with);
        for (int i = 0; i < m->njoint; i++)
            more |= spread(m->joint[i].body_a, m->joint[i].body_b,
                           m->joint[i].kind == FW_JOINT_WELD, with);
        for (int i = 0; i < m->nspring && !more; i++)
            if (spring_pulls(m, with, i))
                more |= spread(m->spring[i].body_a, m->spring[i].body_b, false, with);
        for (int i = 0; i < m->ndriver && !more; i++) {
            int pin = m->driver[i].revolute;
            if (pin >= FW_SIX) more |= spread(m->pin[pin].body_a, m->pin[pin].body_b, false, with);
        }
    }
    for (int i = LINKS; i < m->nbody; i++)
        if (with[i] == NOT_SEEN) with[i] = OPEN;
}

/* ---- the least clearance over a box ---- */

/* The least clearance over a box of the platform's poses. From the Taylor forms of the loop
   (workspace/loop.h): rotations of all hinges over a part of the box as value + gradient . d within
   a rest, d the displacement of the platform from the middle. A body at a pivot P that turns by t
   and whose pivot is carried round O by s goes, at its centre of mass G, by
     dG = s J(P - O) + t J(G - P) + e,  |e| <= s^2/2 |P - O| + t^2/2 |G - P|,
   which is linear in d but for rests. The linear parts at the eight corners bound the slack of the
   pair (clearance_pair.c), the rests come on top. What rides on one of the six-bar's bodies goes with
   it (above).

   All pairs ask for the same parts of the box: forms are kept by part. */

enum { KEPT = 64, CORNERS = 8 }; /* parts whose forms are kept; corners of a part */

/* pose of one body over a part of the box */
typedef struct linear {
    fw_clearance_pose middle;
    double grad[3][3];       /* of x, y, phi by the platform's x, y, phi */
    double rest_m, rest_rad; /* what they may be off by */
} linear;

typedef struct part { /* of the box, and what is known of it */
    double low[3], high[3], half[3];
    fw_workspace_reached reached;
    bool kept;
    linear pose[LINKS];
} part;

typedef struct boxes {
    const fw_clearance_things *things;
    const fw_workspace_loop *loop;
    fw_workspace_box3 whole;
    const int *with; /* (nbody) of the six-bar's bodies; FW_GROUND */
    part *memory;    /* (KEPT) */
    bool *unbounded; /* some pair: by how much it is moved */
} boxes;

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

static turn plus(turn a, turn b, double sign, const double half[3]) {
    turn t = {.at = a.at + sign * b.at, .rest = a.rest + b.rest};
    for (int i = 0; i < 3; i++) {
        t.grad[i] = a.grad[i] + sign * b.grad[i];
        t.most += fabs(t.grad[i]) * half[i];
    }
    t.most += t.rest;
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
    out->middle = (fw_clearance_pose){centre.x, centre.y, solid->turned_rad + t->at, 0};
    for (int i = 0; i < 3; i++)
        out->grad[2][i] = t->grad[i];
    out->rest_rad = t->rest;
}

/* Bodies AB, BC of the left leg or EF, DE of the right one; CD is the platform. The upper one hangs on
   the platform's pose, which has hardly a rest: its rotation is the platform's less that of the hinge
   there, or the sum of the two below, whichever is known better. */
static void leg_poses(const boxes *b, const fw_workspace_loop_box *known, const double half[3],
                      int side, const turn *platform, fw_geometry_vec2 moved, linear *lower,
                      linear *upper, int first, int second) {
    const fw_workspace_leg *leg = &b->loop->leg[side];
    const int base = side ? 5 : 0, step = side ? -1 : 1;
    const fw_clearance_solid *solid = b->things->solid;
    turn t = turn_of(&known->psi[base], 1, half), e = turn_of(&known->psi[base + step], 1, half);
    turn c = turn_of(&known->psi[base + 2 * step], 1, half);
    turn below = plus(t, e, 1, half), above = plus(*platform, c, -1, half);
    const turn *both = above.rest < below.rest ? &above : &below;
    *lower = *upper = (linear){.rest_m = 0};
    fw_geometry_vec2 arm = vec_sub(solid[first].centre, leg->base);
    fw_geometry_vec2 at = vec_add(leg->base, carry(arm, &t, lower));
    put(&solid[first], at, &t, lower);
    fw_geometry_vec2 joint = vec_add(b->loop->centre, leg->to);
    fw_geometry_vec2 now = vec_add(b->loop->centre, carry(leg->to, platform, upper));
    upper->grad[0][0] += 1, upper->grad[1][1] += 1;
    arm = carry(vec_sub(solid[second].centre, joint), both, upper);
    put(&solid[second], vec_add(vec_add(now, moved), arm), both, upper);
}

static void poses_of(const boxes *b, const fw_workspace_loop_box *known,
                     const fw_workspace_box3 *box, const double half[3], linear pose[LINKS]) {
    double unused, m[3];
    for (int i = 0; i < 3; i++)
        m[i] = fw_box3_middle(box, i, &unused);
    const turn platform = {.at = m[2], .grad = {0, 0, 1}, .most = half[2]};
    const fw_geometry_vec2 moved = {m[0], m[1]};
    leg_poses(b, known, half, 0, &platform, moved, &pose[0], &pose[1], 0, 1);
    leg_poses(b, known, half, 1, &platform, moved, &pose[4], &pose[3], 4, 3);
    const fw_clearance_solid *cd = &b->things->solid[2];
    pose[2] = (linear){.middle = {.x_m = cd->centre.x + m[0],
                                  .y_m = cd->centre.y + m[1],
                                  .phi_rad = cd->turned_rad + m[2]}};
    for (int i = 0; i < 3; i++)
        pose[2].grad[i][i] = 1;
}

/* the body of the six-bar that a solid goes with, or FW_GROUND */
static int goes_with(const boxes *b, int solid) {
    return solid == b->things->nbody ? FW_GROUND : b->with[solid];
}

static linear linear_of(const boxes *b, const part *known, int solid) {
    const fw_clearance_solid *s = &b->things->solid[solid];
    int with = goes_with(b, solid);
    if (with == FW_GROUND)
        return (linear){
            .middle = {.x_m = s->centre.x, .y_m = s->centre.y, .phi_rad = s->turned_rad}};
    linear out = known->pose[with];
    if (with == solid) return out;
    const fw_clearance_solid *on = &b->things->solid[with];
    turn t = {
        .at = out.middle.phi_rad - on->turned_rad, .rest = out.rest_rad, .most = out.rest_rad};
    for (int i = 0; i < 3; i++) {
        t.grad[i] = out.grad[2][i];
        t.most += fabs(t.grad[i]) * known->half[i];
    }
    fw_geometry_vec2 arm = carry(vec_sub(s->centre, on->centre), &t, &out);
    out.middle = (fw_clearance_pose){out.middle.x_m + arm.x, out.middle.y_m + arm.y,
                                     s->turned_rad + t.at, 0};
    return out;
}

static fw_clearance_pose at_corner(const linear *l, const double half[3], int corner) {
    double q[3] = {l->middle.x_m, l->middle.y_m, l->middle.phi_rad};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            q[k] += (corner >> i & 1 ? half[i] : -half[i]) * l->grad[k][i];
    return (fw_clearance_pose){q[0], q[1], q[2], 0};
}

/* about given middle poses */
static double slack_about(const boxes *b, const fw_clearance_pair *pair, const part *known,
                          const fw_clearance_pose middle[2]) {
    fw_clearance_slack slack;
    linear l[2] = {linear_of(b, known, pair->a), linear_of(b, known, pair->b)};
    double rest = 0;
    fw_clearance_slack_begin(pair, middle, &slack);
    for (int corner = 0; corner < CORNERS; corner++) {
        const fw_clearance_pose at[2] = {at_corner(&l[0], known->half, corner),
                                         at_corner(&l[1], known->half, corner)};
        fw_clearance_slack_add(pair, at, &slack);
    }
    for (int k = 0; k < 2; k++) {
        slack.turn_rad[k] += l[k].rest_rad;
        rest += l[k].rest_m + l[k].rest_rad * (vec_length(slack.lever[k]) + pair->reach_m);
    }
    return fw_clearance_slack_m(pair, &slack) + rest;
}

/* where a part of the box would be kept */
static size_t slot_of(const boxes *b, const fw_clearance_region *region) {
    double mixed = 0;
    for (int i = 0; i < 3; i++) {
        double size = b->whole.hi[i] - b->whole.lo[i];
        double from = size > 0 ? (region->low[i] - b->whole.lo[i]) / size : 0;
        double to = size > 0 ? (region->high[i] - b->whole.lo[i]) / size : 0;
        mixed += (i + 1) * (37 * from + 101 * to);
    }
    return (size_t)(unsigned)(int)(8 * mixed) % KEPT;
}

static bool is_part(const part *p, const fw_clearance_region *region) {
    for (int i = 0; i < 3; i++)
        if (p->low[i] != region->low[i] || p->high[i] != region->high[i]) return false;
    return p->kept;
}

static const part *know(const boxes *b, const fw_clearance_region *region) {
    part *p = &b->memory[slot_of(b, region)];
    if (is_part(p, region)) return p;
    fw_workspace_loop_box known;
    fw_workspace_box3 box;
    for (int i = 0; i < 3; i++) {
        box.lo[i] = p->low[i] = region->low[i];
        box.hi[i] = p->high[i] = region->high[i];
        fw_box3_middle(&box, i, &p->half[i]);
    }
    fw_workspace_loop_pose_box(b->loop, &box, &known);
    p->kept = true;
    p->reached = known.reached;
    if (known.reached == FW_REACHED) poses_of(b, &known, &box, p->half, p->pose);
    return p;
}

static bool bound(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *region, fw_clearance_pose middle[2], double *slack_m) {
    const boxes *b = context;
    const part *known = know(b, region);
    *slack_m = known->reached == FW_OUT_OF_REACH ? HUGE_VAL : 0;
    if (known->reached != FW_REACHED) return false;
    middle[0] = linear_of(b, known, pair->a).middle;
    middle[1] = linear_of(b, known, pair->b).middle;
    *slack_m = slack_about(b, pair, known, middle);
    return true;
}

static bool hull_of(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *region, fw_clearance_hull *hull) {
    const boxes *b = context;
    const part *known = know(b, region);
    if (known->reached != FW_REACHED) return false;
    hull->count = CORNERS;
    hull->apart = false; /* both are where the platform says */
    for (int k = 0; k < 2; k++) {
        const linear l = linear_of(b, known, k ? pair->b : pair->a);
        hull->middle[k] = l.middle;
        hull->rest_m[k] = l.rest_m, hull->rest_rad[k] = l.rest_rad;
        for (int corner = 0; corner < CORNERS; corner++)
            hull->pose[corner][k] = at_corner(&l, known->half, corner);
    }
    return true;
}

static fw_clearance_region corner_of(const fw_clearance_region *region, int corner) {
    fw_clearance_region one = *region;
    for (int i = 0; i < 3; i++)
        one.low[i] = one.high[i] = corner >> i & 1 ? region->high[i] : region->low[i];
    return one;
}

/* the pose in the middle; part 0: the drawn one, if it is in the box */
static bool pose_of(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *region, double where, fw_clearance_least *at) {
    const boxes *b = context;
    fw_clearance_region one = *region;
    const bool middle = where > 0 && where < 1;
    for (int i = 0; i < 3; i++) {
        double rest = fmin(fmax(0, region->low[i]), region->high[i]);
        one.low[i] = one.high[i] = where <= 0 ? rest : region->high[i];
        at->platform[i] = middle ? 0.5 * (region->low[i] + region->high[i]) : one.low[i];
    }
    const part *known = know(b, middle ? region : &one);
    if (middle && known->reached == FW_MAY_BE_OUT) {
        for (int i = 0; i < 3; i++)
            one.low[i] = one.high[i] = at->platform[i];
        known = know(b, &one);
    }
    if (known->reached != FW_REACHED) return false;
    at->pose[0] = linear_of(b, known, pair->a).middle;
    at->pose[1] = linear_of(b, known, pair->b).middle;
    at->t_s = (double)NAN;
    return true;
}

static void drawn(const void *context, const fw_clearance_pair *pair, fw_clearance_pose pose[2]) {
    const boxes *b = context;
    for (int k = 0; k < 2; k++) {
        const fw_clearance_solid *s = &b->things->solid[k ? pair->b : pair->a];
        pose[k] = (fw_clearance_pose){s->centre.x, s->centre.y, s->turned_rad, 0};
    }
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

/* ---- how far a pair is moved from where it is drawn ----
   Over a large box the rests of the forms are many times what the pair is moved by. So the box is halved until what
   is proved exceeds what the pair is moved by at one of its poses by no more than a tenth. Where a leg is all but
   stretched a link turns by any angle for a little of the platform's way, and parts so small that it is proved there
   are none. */

/* at one pose, where that is reached; 0: it is not proved to be */
static double moved_at(const boxes *b, const fw_clearance_pair *pair, const double at[3]) {
    fw_clearance_region one;
    fw_clearance_pose from[2];
    for (int i = 0; i < 3; i++)
        one.low[i] = one.high[i] = at[i];
    const part *known = know(b, &one);
    if (known->reached != FW_REACHED) return 0;
    drawn(b, pair, from);
    return slack_about(b, pair, known, from);
}

/* no pose of the region moves the pair by more than this; *found: by how much one of the box does */
static double moved_over(const boxes *b, const fw_clearance_pair *pair,
                         const fw_clearance_region *region, int depth, double *found) {
    enum { DEEPEST = 12 };
    const double close = 1.1;
    const part *known = know(b, region);
    fw_clearance_region half[FW_CLEARANCE_PARTS];
    fw_clearance_pose from[2];
    double most = HUGE_VAL, middle[3];
    if (known->reached == FW_OUT_OF_REACH) return 0;
    drawn(b, pair, from);
    if (known->reached == FW_REACHED) most = slack_about(b, pair, known, from);
    if (most <= close * *found) return most;
    for (int i = 0; i < 3; i++)
        middle[i] = 0.5 * (region->low[i] + region->high[i]);
    *found = fmax(*found, moved_at(b, pair, middle));
    if (most <= close * *found || depth == DEEPEST || split(b, region, half) == 0) return most;
    double first = moved_over(b, pair, &half[0], depth + 1, found);
    return fmax(first, moved_over(b, pair, &half[1], depth + 1, found));
}

static double moved(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *all) {
    const boxes *b = context;
    int with[2] = {goes_with(b, pair->a), goes_with(b, pair->b)};
    bool required =
        (with[0] == 2 || with[0] == FW_GROUND) && (with[1] == 2 || with[1] == FW_GROUND);
    double found = 0;
    if (required) return 0;
    for (int corner = 0; corner < CORNERS; corner++) {
        const fw_clearance_region one = corner_of(all, corner);
        found = fmax(found, moved_at(b, pair, one.low));
    }
    const double most = moved_over(b, pair, all, 0, &found);
    if (isfinite(most)) return most;
    *b->unbounded = true;
    return found;
}

static void rough(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *all, fw_clearance_pose middle[2], double *slack_m,
                  double *moved_m) {
    *moved_m = moved(context, pair, all);
    if (!bound(context, pair, all, middle, slack_m)) *slack_m = HUGE_VAL;
}

fw_status fw_clearance_of_box(fw_arena *arena, const fw_clearance_things *things,
                              const fw_mechanism *m, const fw_device_workspace_box *asked,
                              const fw_clearance_wish *wish, fw_clearance_least *least, bool *known,
                              int *open) {
    fw_workspace_loop loop;
    fw_clearance_wish of_six = *wish;
    *known = fw_workspace_loop_set_up(m, &loop);
    *open = FW_NONE;
    if (!*known) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    int *with = fw_arena_array(arena, int, (size_t)m->nbody);
    bool *left_out = fw_arena_array(arena, bool, (size_t)m->nbody + 1);
    part *memory = fw_arena_array(arena, part, KEPT);
    FW_NEED(with && left_out && memory ? with : NULL);
    riders(m, with);
    for (int i = m->nbody - 1; i >= 0; i--) {
        left_out[i] = with[i] == OPEN;
        if (left_out[i] && things->solid[i].count > 0) *open = i;
    }
    of_six.left_out = left_out;
    const fw_clearance_region all = {.low = {asked->x_min_m, asked->y_min_m, asked->phi_min_rad},
                                     .high = {asked->x_max_m, asked->y_max_m, asked->phi_max_rad}};
    bool unbounded = false;
    boxes context = {
        .things = things, .loop = &loop, .with = with, .memory = memory, .unbounded = &unbounded};
    for (int i = 0; i < 3; i++)
        context.whole.lo[i] = all.low[i], context.whole.hi[i] = all.high[i];
    const fw_clearance_domain domain = {.context = &context,
                                        .bound = bound,
                                        .hull = hull_of,
                                        .corner = corner_of,
                                        .moved = moved,
                                        .pose = pose_of,
                                        .start = drawn,
                                        .rough = rough,
                                        .split = split,
                                        .middle_is_a_pose = true};
    fw_status status = fw_clearance_search(arena, things, &domain, &all, &of_six, least);
    if (unbounded) least->moved_m = HUGE_VAL, least->low_m = -HUGE_VAL;
    fw_arena_rewind(arena, mark);
    return status;
}
