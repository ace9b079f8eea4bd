/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two solids: their nearest places at a pose of each, and what poses off these may take from that distance. */
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

/* ---- a coordinate of a path ---- */

const double *fw_clearance_path_coefficients(const fw_clearance_path *path, int piece, int q) {
    return path->bern + ((size_t)piece * (size_t)path->nq + (size_t)q) * FW_CLEARANCE_NODES;
}

double fw_clearance_path_value(const fw_clearance_path *path, int piece, int q, double theta) {
    double b[FW_CLEARANCE_NODES];
    int n = path->nodes[piece];
    memcpy(b, fw_clearance_path_coefficients(path, piece, q), (size_t)n * sizeof *b);
    for (int k = n - 1; k > 0; k--)
        for (int i = 0; i < k; i++)
            b[i] += theta * (b[i + 1] - b[i]);
    return b[0];
}

/* de Casteljau at `to`, which leaves the part before it, then at from/to, which leaves the one behind
   that. Cost 2 n^2/2 products. Source: G. Farin, Curves and Surfaces for CAGD, 5th ed., 5.4.
   Test: test_clearance.c coefficients_hold_the_polynomial */
void fw_clearance_path_part(const fw_clearance_path *path, int piece, int q, double from, double to,
                            double out[FW_CLEARANCE_NODES]) {
    int n = path->nodes[piece];
    memcpy(out, fw_clearance_path_coefficients(path, piece, q), (size_t)n * sizeof *out);
    for (int k = 1; to < 1 && k < n; k++)
        for (int i = n - 1; i >= k; i--)
            out[i] = out[i - 1] + to * (out[i] - out[i - 1]);
    double at = to > 0 ? from / to : 0;
    for (int k = n - 1; at > 0 && k > 0; k--)
        for (int i = 0; i < k; i++)
            out[i] += at * (out[i + 1] - out[i]);
}

/* ---- the nearest places of two solids at a pose of each ---- */

enum { RUN = 8 };

fw_geometry_vec2 fw_clearance_place(const fw_clearance_solid *solid, fw_clearance_pose pose,
                                    fw_geometry_vec2 drawn) {
    double turn = pose.phi_rad - solid->turned_rad, c = cos(turn), s = sin(turn);
    fw_geometry_vec2 r = vec_scale(1 + pose.longer, vec_sub(drawn, solid->centre));
    return (fw_geometry_vec2){pose.x_m + c * r.x - s * r.y, pose.y_m + s * r.x + c * r.y};
}

/* from where the second solid is drawn to where it is seen from the first one, as drawn and in its lengths */
typedef struct seen {
    double c, s, x, y; /* c and s times what the second one is longer by than the first */
    double times, m;   /* that; m of one of the first one's lengths */
} seen;

static seen seen_from(const fw_clearance_pair *pair, const fw_clearance_pose pose[2]) {
    const fw_clearance_solid *a = &pair->things->solid[pair->a], *b = &pair->things->solid[pair->b];
    double ta = pose[0].phi_rad - a->turned_rad, turn = pose[1].phi_rad - b->turned_rad - ta;
    const double m = 1 + pose[0].longer, times = (1 + pose[1].longer) / m;
    double c = times * cos(turn), s = times * sin(turn), ca = cos(ta), sa = sin(ta);
    double dx = (pose[1].x_m - pose[0].x_m) / m, dy = (pose[1].y_m - pose[0].y_m) / m;
    return (seen){c,
                  s,
                  a->centre.x + ca * dx + sa * dy - (c * b->centre.x - s * b->centre.y),
                  a->centre.y - sa * dx + ca * dy - (s * b->centre.x + c * b->centre.y),
                  times,
                  m};
}

static fw_geometry_vec2 moved(const seen *by, fw_geometry_vec2 p) {
    return (fw_geometry_vec2){by->c * p.x - by->s * p.y + by->x, by->s * p.x + by->c * p.y + by->y};
}

static fw_geometry_segment moved_segment(const seen *by, const fw_geometry_segment *s) {
    fw_geometry_segment out = *s;
    out.a = moved(by, s->a);
    out.b = moved(by, s->b);
    if (s->kind == FW_ARC) out.centre = moved(by, s->centre), out.radius = by->times * s->radius;
    return out;
}

/* Of two solids with a hinge between them, what lies inside the hinge's circle and what does not can
   not meet: they turn about the circle's centre. What lies inside is the hinge's own matter. */
static bool may_meet(const fw_clearance_pair *pair, const fw_clearance_edge *p,
                     const fw_clearance_edge *q) {
    return p->other != pair->b && q->other != pair->a && p->held != pair->b && q->held != pair->a;
}

void fw_clearance_pair_boxes(fw_clearance_pair *pair) {
    for (int i = 0; i < pair->count[0]; i++) {
        pair->box[i] = fw_segment_box(&pair->edge[0][i]->segment);
        pair->whole = i ? fw_box_join(pair->whole, pair->box[i]) : pair->box[i];
        fw_geometry_box *run = &pair->run[i / RUN];
        *run = i % RUN ? fw_box_join(*run, pair->box[i]) : pair->box[i];
    }
}

/* two lines that do not cross: an end of one and its foot on the other */
static double line_distance(const fw_geometry_segment *p, const fw_geometry_segment *q,
                            double least, fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    double square = least * least, t;
    for (int end = 0; end < 2; end++) {
        fw_geometry_vec2 from = end ? p->b : p->a, foot = vec_line_foot(q->a, q->b, from, &t);
        fw_geometry_vec2 d = vec_sub(from, foot);
        if (vec_dot(d, d) < square) square = vec_dot(d, d), *at_p = from, *at_q = foot;
        from = end ? q->b : q->a;
        foot = vec_line_foot(p->a, p->b, from, &t);
        d = vec_sub(from, foot);
        if (vec_dot(d, d) < square) square = vec_dot(d, d), *at_p = foot, *at_q = from;
    }
    return sqrt(square);
}

/* where it is below `least`; what has its boxes apart does not cross. gap: of the boxes */
static double edge_distance(const fw_geometry_segment *p, fw_geometry_box p_box,
                            const fw_geometry_segment *q, fw_geometry_box q_box, double least,
                            fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q) {
    double gap = fw_box_gap(p_box, q_box);
    bool lines = p->kind == FW_LINE && q->kind == FW_LINE;
    if (gap <= 10 * FW_COINCIDENT_M) return fw_geometry_segment_distance(p, q, at_p, at_q);
    if (lines) return line_distance(p, q, least, at_p, at_q);
    if (fw_geometry_segment_clear_of(p, &q_box) >= least ||
        fw_geometry_segment_clear_of(q, &p_box) >= least)
        return least;
    fw_geometry_chord chord[FW_MOST_CHORDS];
    int n = fw_geometry_segment_chords(p, q, chord);
    for (int i = 0; i < n; i++) {
        double d = vec_distance(chord[i].at_p, chord[i].at_q);
        if (d < least) least = d, *at_p = chord[i].at_p, *at_q = chord[i].at_q;
    }
    return least;
}

/* the nearest places found so far, in the first solid's frame as drawn, and their edges */
typedef struct nearest {
    double m;
    fw_geometry_vec2 p, q;
    const fw_clearance_edge *at_p, *at_q;
} nearest;

static void take_nearer(const fw_clearance_pair *pair, const fw_clearance_edge *e,
                        fw_geometry_box e_box, const fw_clearance_edge *f,
                        const fw_geometry_segment *there, fw_geometry_box box, nearest *so_far) {
    fw_geometry_vec2 here, across;
    if (!may_meet(pair, e, f)) return;
    double d = edge_distance(&e->segment, e_box, there, box, so_far->m, &here, &across);
    if (d < so_far->m) *so_far = (nearest){d, here, across, e, f};
}

/* what is near as drawn is near at most poses, too: few other edges are nearer than that */
static void look_first(const fw_clearance_pair *pair, const seen *by, nearest *so_far) {
    const fw_clearance_edge *e = pair->likely[0], *f = pair->likely[1];
    if (!e) return;
    const fw_geometry_segment there = moved_segment(by, &f->segment);
    take_nearer(pair, e, fw_segment_box(&e->segment), f, &there, fw_segment_box(&there), so_far);
}

static nearest nearest_places(const fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                              double limit_m) {
    const seen by = seen_from(pair, pose);
    nearest so_far = {.m = limit_m / by.m};
    look_first(pair, &by, &so_far);
    for (int j = 0; j < pair->count[1] && so_far.m > 0; j++) {
        const fw_clearance_edge *f = pair->edge[1][j];
        const fw_geometry_segment there = moved_segment(&by, &f->segment);
        const fw_geometry_box box = fw_segment_box(&there);
        if (fw_box_gap(box, pair->whole) >= so_far.m) continue;
        for (int i = 0; i < pair->count[0]; i++) {
            if (i % RUN == 0 && fw_box_gap(box, pair->run[i / RUN]) >= so_far.m) {
                i += RUN - 1;
                continue;
            }
            if (fw_box_gap(box, pair->box[i]) >= so_far.m) continue;
            take_nearer(pair, pair->edge[0][i], pair->box[i], f, &there, box, &so_far);
        }
    }
    so_far.m = so_far.at_p ? so_far.m * by.m : limit_m;
    return so_far;
}

/* D = least |p - q| over all edges p of the first solid and q of the second that may meet. In the
   first one's frame as drawn, so that its boxes stay. Error: that of fw_geometry_segment_distance,
   1e-15 m beside rounding of places (1e-18 m per mm of turn). Cost: a box for every edge of the
   second solid, a distance for pairs whose boxes are nearer than the least so far.
   Test: test_clearance.c */
double fw_clearance_pair_distance(const fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                                  double limit_m, fw_clearance_meet *meet) {
    const nearest found = nearest_places(pair, pose, limit_m);
    const fw_clearance_edge *p = found.at_p, *q = found.at_q;
    if (meet && p) {
        const fw_clearance_solid *a = &pair->things->solid[pair->a];
        *meet = (fw_clearance_meet){.distance_m = found.m,
                                    .at_a = fw_clearance_place(a, pose[0], found.p),
                                    .at_b = fw_clearance_place(a, pose[0], found.q),
                                    .a = p->label,
                                    .b = q->label,
                                    .edge = {p, q},
                                    .bound = p->bends || q->bends,
                                    .lane = p->always || q->always,
                                    .tether = p->held != FW_NONE || q->held != FW_NONE};
    }
    return found.m;
}

double fw_clearance_pair_distance_first(fw_clearance_pair *pair, const fw_clearance_pose pose[2]) {
    const nearest found = nearest_places(pair, pose, HUGE_VAL);
    pair->likely[0] = found.at_p, pair->likely[1] = found.at_q;
    return found.m;
}

static double far_of(const fw_geometry_segment *s, fw_geometry_vec2 from) {
    if (s->kind == FW_ARC) return vec_distance(s->centre, from) + s->radius;
    return fmax(vec_distance(s->a, from), vec_distance(s->b, from));
}

/* centre, reach and arms from the edges that are left */
void fw_clearance_pair_measure(fw_clearance_pair *pair) {
    const fw_geometry_box w = pair->whole;
    pair->centre = (fw_geometry_vec2){0.5 * (w.x0 + w.x1), 0.5 * (w.y0 + w.y1)};
    pair->reach_m = 0;
    for (int k = 0; k < 2; k++) {
        const fw_clearance_solid *solid = &pair->things->solid[k ? pair->b : pair->a];
        pair->arm_m[k] = 0;
        for (int i = 0; i < pair->count[k]; i++) {
            const fw_geometry_segment *s = &pair->edge[k][i]->segment;
            pair->arm_m[k] = fmax(pair->arm_m[k], far_of(s, solid->centre));
            if (k == 0) pair->reach_m = fmax(pair->reach_m, far_of(s, pair->centre));
        }
    }
}

/* Keeps the edges that may come nearer than `near_m` to one of the other side, where no two come
   nearer than at these poses by more than `slack_m`. Cost: every pair of boxes, by eights. */
void fw_clearance_pair_narrow(fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                              double near_m, double slack_m, bool *kept) {
    const seen by = seen_from(pair, pose);
    const double limit = (near_m + slack_m) / by.m;
    int n = 0;
    for (int i = 0; i < pair->count[0]; i++)
        kept[i] = false;
    for (int j = 0; j < pair->count[1]; j++) {
        const fw_clearance_edge *f = pair->edge[1][j];
        const fw_geometry_segment there = moved_segment(&by, &f->segment);
        const fw_geometry_box box = fw_segment_box(&there);
        bool any = false;
        if (fw_box_gap(box, pair->whole) > limit) continue;
        for (int i = 0; i < pair->count[0]; i++) {
            if (i % RUN == 0 && fw_box_gap(box, pair->run[i / RUN]) > limit) {
                i += RUN - 1;
                continue;
            }
            if (any && kept[i]) continue;
            if (fw_box_gap(box, pair->box[i]) > limit) continue;
            if (may_meet(pair, pair->edge[0][i], f)) any = kept[i] = true;
        }
        if (any) pair->edge[1][n++] = f;
    }
    pair->count[1] = n;
    n = 0;
    for (int i = 0; i < pair->count[0]; i++)
        if (kept[i]) pair->edge[0][n++] = pair->edge[0][i];
    pair->count[0] = n;
    fw_clearance_pair_boxes(pair);
    fw_clearance_pair_measure(pair);
}

/* all edges; the solid that is smaller comes first, since rotations count with its size */
fw_status fw_clearance_pair_new(fw_arena *arena, const fw_clearance_things *things, int a, int b,
                                bool walls, fw_clearance_pair *pair) {
    const fw_geometry_box p = things->solid[a].box, q = things->solid[b].box;
    bool swap = fmax(p.x1 - p.x0, p.y1 - p.y0) > fmax(q.x1 - q.x0, q.y1 - q.y0);
    *pair = (fw_clearance_pair){.things = things, .a = swap ? b : a, .b = swap ? a : b};
    for (int k = 0; k < 2; k++) {
        const fw_clearance_solid *s = &things->solid[k ? pair->b : pair->a];
        FW_NEED(pair->edge[k] = fw_arena_alloc(arena, (size_t)s->count, sizeof *pair->edge[k]));
        bool some = walls && (k ? pair->b : pair->a) == things->nbody;
        for (int i = 0; i < s->count; i++)
            if (!some || s->edge[i].always) pair->edge[k][pair->count[k]++] = &s->edge[i];
    }
    FW_NEED(pair->box = fw_arena_array(arena, fw_geometry_box, (size_t)pair->count[0] + 1));
    FW_NEED(pair->run = fw_arena_array(arena, fw_geometry_box, (size_t)pair->count[0] / RUN + 1));
    fw_clearance_pair_boxes(pair);
    fw_clearance_pair_measure(pair);
    return FW_OK;
}

/* ---- by how much they may come nearer at poses that are not quite known ---- */

/* By how much two solids may come nearer than at their middle poses.

   A point p of a solid with its centre of mass at x goes by
     d(p) = dx + (R(t) - 1)(p - x) = dx + t J(p - x) + e,  |e| <= t^2/2 |p - x|
   when the pose is off by (dx, t). For p of solid a, q of solid b, and any point c,
     d(q) - d(p) = u + (tb - ta) J(p - c) + tb J(q - p) + e_b - e_a,
     u = dx_b - dx_a + tb J(c - x_b) - ta J(c - x_a).
   q - p + tb J(q - p) is never shorter than q - p: the second is square to it. So
     |q' - p'| >= |q - p| - (|u| + |tb - ta| max|p - c| + (ta^2 arm_a + tb^2 arm_b)/2).
   A pose of which the solid is longer by g more than in the middle one moves p by g arm at most besides.
   What turns both alike, or about c, costs only the last part, of second order. u, ta, tb are linear
   in the poses and the parentheses convex in them, so that the bound holds for all poses in the
   convex hull of those it was computed for: Bernstein coefficients of a motion, corners of a box.
   Error: proved, but for rounding (1e-19 m). Source: docs/theory/clearance.md.
   Test: test_clearance.c slack_bounds_every_pose */

void fw_clearance_slack_begin(const fw_clearance_pair *pair, const fw_clearance_pose middle[2],
                              fw_clearance_slack *slack) {
    const fw_clearance_solid *a = &pair->things->solid[pair->a];
    *slack = (fw_clearance_slack){.middle = {middle[0], middle[1]}};
    fw_geometry_vec2 c = fw_clearance_place(a, middle[0], pair->centre);
    for (int k = 0; k < 2; k++)
        slack->lever[k] = vec_left(vec_sub(c, (fw_geometry_vec2){middle[k].x_m, middle[k].y_m}));
}

void fw_clearance_slack_add(const fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                            fw_clearance_slack *slack) {
    double ux = 0, uy = 0, turn[2], grows = 0;
    for (int k = 0; k < 2; k++) {
        double sign = k ? 1 : -1;
        turn[k] = pose[k].phi_rad - slack->middle[k].phi_rad;
        ux += sign * (pose[k].x_m - slack->middle[k].x_m + turn[k] * slack->lever[k].x);
        uy += sign * (pose[k].y_m - slack->middle[k].y_m + turn[k] * slack->lever[k].y);
        if (fabs(turn[k]) > slack->turn_rad[k]) slack->turn_rad[k] = fabs(turn[k]);
        grows += fabs(pose[k].longer - slack->middle[k].longer) * pair->arm_m[k];
    }
    const double reach = (1 + fabs(slack->middle[0].longer)) * pair->reach_m;
    double here = sqrt(ux * ux + uy * uy) + fabs(turn[1] - turn[0]) * reach + grows;
    if (here > slack->linear_m) slack->linear_m = here;
}

double fw_clearance_slack_m(const fw_clearance_pair *pair, const fw_clearance_slack *slack) {
    double second = 0;
    for (int k = 0; k < 2; k++)
        second += 0.5 * slack->turn_rad[k] * slack->turn_rad[k] *
                  (1 + fabs(slack->middle[k].longer)) * pair->arm_m[k];
    return slack->linear_m + second;
}

/* ---- the same by the direction in which two edges are apart ----

   The slack above is a length: what goes along a wall counts like what goes towards it, so that a
   pair which slides by at its least distance is cut into ever smaller regions. For a unit vector n
   and edges p, q at their middle poses

     |q' - p'| >= n.(q' - p') >= min over q of n.(q + d(q)) - max over p of n.(p + d(p)),

   where, from above, n.(p + d(p)) = n.dx + (n + t J'n).p - t J'n.x within t^2/2 |p - x|: a support
   function of the edge, linear in the pose. Over a region it is least at one of the hull's poses; what
   these are off by comes off. With n along the shortest way between the edges this is their distance
   where a region is small, and off by the square of its size. It says nothing where one lies in the
   hollow of the other: there the slack stands.
   Error: proved, but for rounding (1e-18 m). Cost: two supports for each pose of the hull.
   Source: docs/theory/clearance.md. Test: test_clearance.c direction_bounds_every_pose */

static fw_geometry_segment placed(const fw_clearance_solid *solid, fw_clearance_pose pose,
                                  const fw_geometry_segment *drawn) {
    fw_geometry_segment s = *drawn;
    s.a = fw_clearance_place(solid, pose, drawn->a);
    s.b = fw_clearance_place(solid, pose, drawn->b);
    if (s.kind == FW_ARC) {
        s.centre = fw_clearance_place(solid, pose, drawn->centre);
        s.radius = (1 + pose.longer) * drawn->radius;
    }
    return s;
}

/* the largest m.x of the edge's points */
static double support(const fw_geometry_segment *s, fw_geometry_vec2 m) {
    double t, most = fmax(vec_dot(m, s->a), vec_dot(m, s->b));
    if (s->kind == FW_ARC && fw_geometry_segment_faces(s, m, &t))
        most = fmax(most, vec_dot(m, s->centre) + s->radius * vec_length(m));
    return most;
}

/* the largest n.(x + d(x)) of an edge's points, without rests; place: of the centre of mass */
static double shifted_support(const fw_geometry_segment *s, fw_geometry_vec2 n,
                              fw_clearance_pose middle, fw_clearance_pose pose) {
    const fw_geometry_vec2 turned = {n.y, -n.x};
    const double t = pose.phi_rad - middle.phi_rad;
    return support(s, vec_along(n, t, turned)) + n.x * (pose.x_m - middle.x_m) +
           n.y * (pose.y_m - middle.y_m) - t * (turned.x * middle.x_m + turned.y * middle.y_m);
}

double fw_clearance_edges_bound(const fw_clearance_pair *pair, const fw_clearance_hull *hull,
                                const fw_clearance_meet *meet, int *where, double *there_m) {
    const fw_geometry_vec2 apart = vec_sub(meet->at_b, meet->at_a), n = vec_unit(apart);
    fw_geometry_segment edge[2];
    double turn[2] = {0, 0}, grows[2] = {0, 0}, rest = 0;
    *where = 0, *there_m = HUGE_VAL;
    for (int k = 0; k < 2; k++)
        edge[k] = placed(&pair->things->solid[k ? pair->b : pair->a], hull->middle[k],
                         &meet->edge[k]->segment);
    double least[2] = {HUGE_VAL, HUGE_VAL}; /* of each solid by itself */
    for (int i = 0; i < hull->count; i++) {
        const double q =
            -shifted_support(&edge[1], vec_scale(-1, n), hull->middle[1], hull->pose[i][1]);
        const double p = -shifted_support(&edge[0], n, hull->middle[0], hull->pose[i][0]);
        if (p + q < *there_m) *there_m = p + q, *where = i;
        least[0] = fmin(least[0], p), least[1] = fmin(least[1], q);
        for (int k = 0; k < 2; k++)
            turn[k] = fmax(turn[k], fabs(hull->pose[i][k].phi_rad - hull->middle[k].phi_rad)),
            grows[k] = fmax(grows[k], fabs(hull->pose[i][k].longer - hull->middle[k].longer));
    }
    if (hull->apart) *there_m = least[0] + least[1];
    for (int k = 0; k < 2; k++) {
        const fw_geometry_vec2 centre = {hull->middle[k].x_m, hull->middle[k].y_m};
        const double most = turn[k] + hull->rest_rad[k];
        const double of_arm = hull->rest_rad[k] + 0.5 * most * most + 2 * grows[k];
        rest += hull->rest_m[k] + of_arm * far_of(&edge[k], centre);
    }
    return *there_m - rest;
}

double fw_clearance_pair_bound(const fw_clearance_pair *pair, const fw_clearance_hull *hull,
                               double slack_m, double needed_m) {
    const seen by = seen_from(pair, hull->middle);
    const double limit = (needed_m + slack_m) / by.m;
    const fw_clearance_solid *a = &pair->things->solid[pair->a];
    double low = HUGE_VAL;
    for (int j = 0; j < pair->count[1]; j++) {
        const fw_clearance_edge *f = pair->edge[1][j];
        const fw_geometry_segment there = moved_segment(&by, &f->segment);
        const fw_geometry_box box = fw_segment_box(&there);
        if (fw_box_gap(box, pair->whole) >= limit) continue;
        for (int i = 0; i < pair->count[0]; i++) {
            const fw_clearance_edge *e = pair->edge[0][i];
            int where;
            double there_m;
            if (i % RUN == 0 && fw_box_gap(box, pair->run[i / RUN]) >= limit) {
                i += RUN - 1;
                continue;
            }
            if (fw_box_gap(box, pair->box[i]) >= limit || !may_meet(pair, e, f)) continue;
            fw_geometry_vec2 p, q;
            const double d = edge_distance(&e->segment, pair->box[i], &there, box, limit, &p, &q);
            if (d >= limit) continue;
            if (d <= 0) return -HUGE_VAL;
            const fw_clearance_meet meet = {.at_a = fw_clearance_place(a, hull->middle[0], p),
                                            .at_b = fw_clearance_place(a, hull->middle[0], q),
                                            .edge = {e, f}};
            const double proved = fmax(
                by.m * d - slack_m, fw_clearance_edges_bound(pair, hull, &meet, &where, &there_m));
            if (proved < needed_m) return -HUGE_VAL;
            low = fmin(low, proved);
        }
    }
    return fmin(low, needed_m);
}

/* ---- poses of a pair along a path ---- */

fw_clearance_pose fw_clearance_ground_pose(const fw_clearance_things *things) {
    const fw_clearance_solid *ground = &things->solid[things->nbody];
    return (fw_clearance_pose){ground->centre.x, ground->centre.y, ground->turned_rad, 0};
}

void fw_clearance_pair_at(const fw_clearance_pair *pair, const fw_clearance_path *path, int piece,
                          double theta, fw_clearance_pose pose[2]) {
    for (int k = 0; k < 2; k++) {
        int solid = k ? pair->b : pair->a, q = 3 * solid;
        pose[k] = fw_clearance_ground_pose(pair->things);
        if (solid == pair->things->nbody) continue;
        pose[k].x_m = fw_clearance_path_value(path, piece, q, theta);
        pose[k].y_m = fw_clearance_path_value(path, piece, q + 1, theta);
        pose[k].phi_rad = fw_clearance_path_value(path, piece, q + 2, theta);
        pose[k].longer = fw_clearance_path_value(path, piece, path->nq - 1, theta);
    }
}

int fw_clearance_pair_coefficients(const fw_clearance_pair *pair, const fw_clearance_path *path,
                                   const fw_clearance_span *span, int piece,
                                   fw_clearance_pose pose[FW_CLEARANCE_NODES][2]) {
    int n = path->nodes[piece];
    const fw_clearance_pose stands = fw_clearance_ground_pose(pair->things);
    for (int k = 0; k < 2; k++) {
        int solid = k ? pair->b : pair->a;
        double c[FW_CLEARANCE_OF_POSE][FW_CLEARANCE_NODES];
        bool ground = solid == pair->things->nbody;
        for (int q = 0; q < FW_CLEARANCE_OF_POSE && !ground; q++)
            fw_clearance_path_part(path, piece, fw_clearance_coordinate(path, solid, q), span->from,
                                   span->to, c[q]);
        for (int i = 0; i < n; i++)
            pose[i][k] = ground ? stands : (fw_clearance_pose){c[0][i], c[1][i], c[2][i], c[3][i]};
    }
    return n;
}
