/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least clearance over a motion, which is kept as polynomials between whose coefficients it stays. */
#include "clearance/clearance.h"
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

/* ---- the motion as polynomials ---- */

/* A motion as Bernstein polynomials, piece by piece: the coefficients of a polynomial over a part of
   its piece hold its values there between the least and the largest of them. */

enum { NODES = FW_CLEARANCE_NODES, MOST_BYTES = 6 << 20, LEAST_PIECES = 16, MOST_PIECES = 8192 };

fw_status fw_clearance_path_new(fw_arena *arena, int nbody, fw_clearance_path *path) {
    size_t each = (size_t)(3 * nbody + 1) * NODES * sizeof(double), room = MOST_BYTES / (each + 1);
    size_t n = room < LEAST_PIECES ? LEAST_PIECES : room > MOST_PIECES ? MOST_PIECES : room;
    return fw_clearance_path_of(arena, nbody, (int)n, path);
}

fw_status fw_clearance_path_of(fw_arena *arena, int nbody, int pieces, fw_clearance_path *path) {
    size_t n = (size_t)pieces, each = (size_t)(3 * nbody + 1) * NODES * sizeof(double);
    *path = (fw_clearance_path){.nq = 3 * nbody + 1, .capacity = pieces};
    FW_NEED(path->start = fw_arena_array(arena, double, (size_t)path->nq));
    FW_NEED(path->node = fw_arena_array(arena, double, (size_t)path->nq *NODES));
    FW_NEED(path->nodes = fw_arena_array(arena, int, n));
    FW_NEED(path->t_s = fw_arena_array(arena, double, 2 * n));
    FW_NEED(path->bern = fw_arena_raw(arena, n * each));
    return FW_OK;
}

bool fw_clearance_path_full(const fw_clearance_path *path) {
    return path->npiece == path->capacity;
}

static double bernstein(int degree, int i, double x) {
    double value = 1;
    for (int k = 0; k < i; k++)
        value *= x * (degree - k) / (k + 1);
    for (int k = 0; k < degree - i; k++)
        value *= 1 - x;
    return value;
}

/* the inverse of the matrix of Bernstein polynomials at equally spaced places: Gauss and Jordan;
   condition 4e3 for 8 nodes, so that coefficients are right to 1e-12 of the largest value */
static void fit_of(fw_clearance_path *path, int n) {
    double a[NODES][2 * NODES] = {{0}};
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            a[i][j] = bernstein(n - 1, j, (double)i / (n - 1));
        a[i][n + i] = 1;
    }
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
        for (int j = 0; j < 2 * n; j++) {
            double swap = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = swap;
        }
        double scale = 1 / a[k][k];
        for (int j = 0; j < 2 * n; j++)
            a[k][j] *= scale;
        for (int i = 0; i < n; i++) {
            double part = a[i][k];
            for (int j = 0; i != k && j < 2 * n; j++)
                a[i][j] -= part * a[k][j];
        }
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            path->fit[i][j] = a[i][n + j];
    path->of = n;
}

static void note_jump(fw_clearance_path *path, const fw_dynamics_piece *piece) {
    const int n = path->nq - 1;
    const double *from = piece->q, *to = piece->q + (size_t)(piece->nodes - 1) * (size_t)n;
    path->njump++;
    for (int q = 0; q < n; q += 3) {
        double by = hypot(to[q] - from[q], to[q + 1] - from[q + 1]);
        if (by > path->jump_m) path->jump_m = by, path->jump_s = piece->from_s;
    }
}

void fw_clearance_path_add(fw_clearance_path *path, const fw_dynamics_piece *piece) {
    int n = piece->nodes, k = path->npiece;
    if (fw_clearance_path_full(path)) return; /* never: whoever adds looks first */
    if (path->of != n) fit_of(path, n);
    for (int i = 0; i < n; i++) {
        double *at = path->node + (size_t)i * (size_t)path->nq;
        at[path->nq - 1] = fw_dynamics_piece_node(piece, path->nq / 3, i, at);
    }
    if (!path->begun) memcpy(path->start, path->node, (size_t)path->nq * sizeof *path->start);
    path->begun = true;
    if (piece->jump) note_jump(path, piece);
    path->nodes[k] = n;
    path->t_s[2 * k] = piece->from_s;
    path->t_s[2 * k + 1] = piece->to_s;
    double *out = path->bern + (size_t)k * (size_t)path->nq * NODES;
    for (int q = 0; q < path->nq; q++, out += NODES) {
        double base = path->node[q];
        for (int i = 0; i < n; i++) {
            double sum = 0; /* of differences: what the pose itself is rounded to does not count */
            for (int j = 0; j < n; j++)
                sum += path->fit[i][j] * (path->node[j * path->nq + q] - base);
            out[i] = base + sum;
        }
    }
    path->npiece++;
}

/* ---- the least clearance over it ---- */

/* The least clearance over a motion: the domain is time, halved by pieces first, then within one. */

typedef struct motion {
    fw_maths_interval *range; /* (nq) of every coordinate, over all of it */
    const fw_clearance_things *things;
    const fw_clearance_path *path;
    double within_m; /* what is as near as this has met: 0, but for a way that is taken further */
    double small_m;  /* a span in which no more than this is moved is where they meet */
} motion;

static void join(fw_maths_interval *range, double x) {
    range->lo = x < range->lo ? x : range->lo;
    range->hi = x > range->hi ? x : range->hi;
}

/* of the six coordinates of a pair over a span: x, y, phi of the first solid, then of the second */
static void ranges_of(const motion *s, const fw_clearance_pair *pair, const fw_clearance_span *span,
                      fw_maths_interval range[2][FW_CLEARANCE_OF_POSE]) {
    const bool all = span->first == 0 && span->last == s->path->npiece - 1 && s->range &&
                     span->from == 0 && span->to == 1;
    const fw_clearance_pose stands = fw_clearance_ground_pose(s->things);
    const double at[FW_CLEARANCE_OF_POSE] = {stands.x_m, stands.y_m, stands.phi_rad, 0};
    for (int k = 0; k < 2; k++) {
        const int solid = k ? pair->b : pair->a;
        for (int i = 0; i < FW_CLEARANCE_OF_POSE; i++) {
            const int q = fw_clearance_coordinate(s->path, solid, i);
            fw_maths_interval *r = &range[k][i];
            *r = (fw_maths_interval){HUGE_VAL, -HUGE_VAL};
            if (solid == s->things->nbody)
                *r = (fw_maths_interval){at[i], at[i]};
            else if (all)
                *r = s->range[q];
            else
                for (int piece = span->first; piece <= span->last; piece++) {
                    double c[NODES];
                    fw_clearance_path_part(s->path, piece, q, span->from, span->to, c);
                    for (int j = 0; j < s->path->nodes[piece]; j++)
                        join(r, c[j]);
                }
        }
    }
}

static void middle_of(const motion *s, const fw_clearance_pair *pair, const fw_clearance_span *span,
                      fw_maths_interval range[2][FW_CLEARANCE_OF_POSE],
                      fw_clearance_pose middle[2]) {
    ranges_of(s, pair, span, range);
    for (int k = 0; k < 2; k++)
        middle[k] = (fw_clearance_pose){
            0.5 * (range[k][0].lo + range[k][0].hi), 0.5 * (range[k][1].lo + range[k][1].hi),
            0.5 * (range[k][2].lo + range[k][2].hi), 0.5 * (range[k][3].lo + range[k][3].hi)};
}

/* no two edges of the pair are nearer in this span than at the middle poses by more than this */
static double slack_about(const motion *s, const fw_clearance_pair *pair,
                          const fw_clearance_span *span, const fw_clearance_pose middle[2]) {
    fw_clearance_slack slack;
    fw_clearance_pose pose[NODES][2];
    fw_clearance_slack_begin(pair, middle, &slack);
    for (int piece = span->first; piece <= span->last; piece++) {
        int n = fw_clearance_pair_coefficients(pair, s->path, span, piece, pose);
        for (int i = 0; i < n; i++)
            fw_clearance_slack_add(pair, (const fw_clearance_pose *)pose[i], &slack);
    }
    return fw_clearance_slack_m(pair, &slack);
}

/* ---- as a domain ---- */

static bool bound(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *region, fw_clearance_pose middle[2], double *slack_m) {
    fw_maths_interval range[2][FW_CLEARANCE_OF_POSE];
    middle_of(context, pair, &region->span, range, middle);
    *slack_m = slack_about(context, pair, &region->span, middle);
    return true;
}

/* The coefficients of a span of one piece; of many, corners of the ranges of each solid's coordinates: oscillations that
   slide along a wall are proved as a whole, whatever they do one after the other. */
static bool hull_of(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *region, fw_clearance_hull *hull) {
    enum { CORNERS = 8 };
    const motion *s = context;
    const fw_clearance_span *span = &region->span;
    fw_maths_interval r[2][FW_CLEARANCE_OF_POSE];
    *hull = (fw_clearance_hull){.apart = span->first != span->last};
    middle_of(s, pair, span, r, hull->middle);
    if (!hull->apart)
        hull->count = fw_clearance_pair_coefficients(pair, s->path, span, span->first, hull->pose);
    for (; hull->apart && hull->count < CORNERS; hull->count++)
        for (int k = 0; k < 2; k++) {
            const int c = hull->count;
            hull->pose[c][k] = (fw_clearance_pose){
                c & 1 ? r[k][0].hi : r[k][0].lo, c & 2 ? r[k][1].hi : r[k][1].lo,
                c & 4 ? r[k][2].hi : r[k][2].lo, c & 1 ? r[k][3].hi : r[k][3].lo};
        }
    return true;
}

static void start_of(const motion *s, const fw_clearance_pair *pair, fw_clearance_pose start[2]) {
    for (int k = 0; k < 2; k++) {
        int solid = k ? pair->b : pair->a;
        const double *q = s->path->start + 3 * solid;
        start[k] = solid == s->things->nbody
                       ? fw_clearance_ground_pose(s->things)
                       : (fw_clearance_pose){q[0], q[1], q[2], s->path->start[s->path->nq - 1]};
    }
}

static double moved(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *all) {
    fw_clearance_pose start[2];
    start_of(context, pair, start);
    return slack_about(context, pair, &all->span, start);
}

/* part 0: where the span begins, 1: where it ends, 0.5: between */
static bool pose(const void *context, const fw_clearance_pair *pair,
                 const fw_clearance_region *region, double part, fw_clearance_least *at) {
    const motion *s = context;
    const fw_clearance_span *span = &region->span;
    int piece = part <= 0 ? span->first : part >= 1 ? span->last : (span->first + span->last) / 2;
    double theta = span->from + part * (span->to - span->from);
    const double *t = s->path->t_s + 2 * piece;
    fw_clearance_pair_at(pair, s->path, piece, theta, at->pose);
    at->t_s = t[0] + theta * (t[1] - t[0]);
    return true;
}

/* Bounds of a span of many pieces cost as much as there are pieces: it is cut into sixteen */
static int split(const void *context, const fw_clearance_region *region,
                 fw_clearance_region part[FW_CLEARANCE_PARTS]) {
    const fw_clearance_span *span = &region->span;
    int pieces = span->last - span->first + 1, n = pieces;
    (void)context;
    if (n > FW_CLEARANCE_PARTS) n = FW_CLEARANCE_PARTS;
    for (int i = 0; i < n && pieces > 1; i++) {
        part[i] = *region;
        part[i].span.first = span->first + (int)((long)pieces * i / n);
        part[i].span.last = span->first + (int)((long)pieces * (i + 1) / n) - 1;
    }
    if (pieces > 1) return n;
    part[0] = part[1] = *region;
    part[0].span.to = part[1].span.from = 0.5 * (span->from + span->to);
    return span->to - span->from > 1e-12 ? 2 : 0;
}

/* of all poses, from the range of each coordinate alone */
static void rough(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *all, fw_clearance_pose middle[2], double *slack_m,
                  double *moved_m) {
    const motion *s = context;
    fw_clearance_pose start[2];
    (void)all;
    start_of(s, pair, start);
    for (int about = 0; about < 2; about++) { /* the middle, then the start */
        double off[2][FW_CLEARANCE_OF_POSE] = {{0}};
        for (int k = 0; k < 2; k++) {
            int solid = k ? pair->b : pair->a;
            double at[FW_CLEARANCE_OF_POSE] = {start[k].x_m, start[k].y_m, start[k].phi_rad,
                                               start[k].longer};
            for (int q = 0; q < FW_CLEARANCE_OF_POSE && solid < s->things->nbody; q++) {
                fw_maths_interval r = s->range[fw_clearance_coordinate(s->path, solid, q)];
                if (about == 0) at[q] = 0.5 * (r.lo + r.hi);
                off[k][q] = fmax(r.hi - at[q], at[q] - r.lo);
            }
            if (about == 0) middle[k] = (fw_clearance_pose){at[0], at[1], at[2], at[3]};
        }
        fw_clearance_slack slack;
        fw_clearance_slack_begin(pair, about ? start : middle, &slack);
        double x = off[0][0] + off[1][0], y = off[0][1] + off[1][1];
        slack.linear_m = sqrt(x * x + y * y) + (off[0][2] + off[1][2]) *
                                                   (1 + fabs(slack.middle[0].longer)) *
                                                   pair->reach_m;
        for (int k = 0; k < 2; k++) {
            slack.turn_rad[k] = off[k][2];
            slack.linear_m += off[k][3] * pair->arm_m[k];
            slack.linear_m += off[k][2] * vec_length(slack.lever[k]);
        }
        *(about ? moved_m : slack_m) = fw_clearance_slack_m(pair, &slack);
    }
}

/* How far a pair is from its start at the pose of the path where that is most, in the measure in which moved() bounds it. A
   share of a motion is one of what it does: the bound, of coefficients and of ranges, is some per cent more, and would make
   of a pair that just meets one that meets for sure. Error: between 16 instants of a piece, second order */
static double went(const motion *s, const fw_clearance_pair *pair) {
    enum { INSTANTS = 16 };
    fw_clearance_pose start[2], now[2];
    double most = 0;
    start_of(s, pair, start);
    for (int piece = 0; piece < s->path->npiece; piece++)
        for (int i = 0; i <= INSTANTS; i++) {
            fw_clearance_slack off;
            fw_clearance_pair_at(pair, s->path, piece, (double)i / INSTANTS, now);
            fw_clearance_slack_begin(pair, start, &off);
            fw_clearance_slack_add(pair, (const fw_clearance_pose *)now, &off);
            most = fmax(most, fw_clearance_slack_m(pair, &off));
        }
    return most;
}

static void meet_here(const motion *s, const fw_clearance_pair *pair, const fw_clearance_span *span,
                      fw_clearance_least *least) {
    fw_clearance_pose now[2], start[2];
    fw_clearance_slack off;
    const double *t = s->path->t_s + 2 * span->first;
    fw_clearance_pair_at(pair, s->path, span->first, span->to, now);
    start_of(s, pair, start);
    fw_clearance_slack_begin(pair, start, &off);
    fw_clearance_slack_add(pair, now, &off);
    fw_clearance_pair_distance(pair, now, HUGE_VAL, &least->at);
    least->pose[0] = now[0], least->pose[1] = now[1];
    least->t_s = t[0] + span->to * (t[1] - t[0]);
    least->went_m = went(s, pair);
    least->share = fmin(1, fw_clearance_slack_m(pair, &off) / least->went_m);
}

/* what the direction in which edges are apart proves, where they slide by each other nearer than they move */
static bool slides_clear(const motion *s, const fw_clearance_pair *pair,
                         const fw_clearance_region *region, double slack) {
    fw_clearance_hull hull;
    return s->within_m > 0 && hull_of(s, pair, region, &hull) &&
           fw_clearance_pair_bound(pair, &hull, slack, s->within_m) >= s->within_m;
}

/* The earliest instant, and before that of `before_s`, at which a pair meets: spans in order of time, each cleared or
   halved; what is left within 1 nm of motion is where they meet. False: it does not, or was not found. */
static bool first_meeting(const void *context, const fw_clearance_pair *pair,
                          const fw_clearance_region *all, double before_s,
                          fw_clearance_least *least) {
    enum { DEPTH = 512, TRIES = 4096 };
    const motion *s = context;
    fw_clearance_region stack[DEPTH];
    int depth = 0;
    stack[depth++] = *all;
    for (int tries = 0; depth > 0 && tries < TRIES; tries++) {
        const fw_clearance_region now = stack[--depth];
        const double *t = s->path->t_s + 2 * now.span.first;
        if (t[0] + now.span.from * (t[1] - t[0]) >= before_s) return false; /* so are all others */
        fw_clearance_pose middle[2];
        double slack;
        bound(s, pair, &now, middle, &slack);
        least->looked++;
        const double near = s->within_m + slack;
        const double d = fw_clearance_pair_distance(pair, middle, near + 1e-12, NULL);
        if (d > near || (d > s->within_m && slides_clear(s, pair, &now, slack))) continue;
        fw_clearance_region part[FW_CLEARANCE_PARTS];
        int parts = split(s, &now, part);
        bool one = now.span.first == now.span.last;
        if (one && (slack < s->small_m || parts == 0)) {
            meet_here(s, pair, &now.span, least);
            return least->t_s < before_s;
        }
        for (int i = parts - 1; i >= 0 && depth < DEPTH; i--)
            stack[depth++] = part[i];
    }
    return false;
}

static void start_at(const void *context, const fw_clearance_pair *pair,
                     fw_clearance_pose pose[2]) {
    start_of(context, pair, pose);
}

/* a pair has met: only how far it would have been moved is still of account */
static fw_status go_on(fw_arena *arena, const motion *s, const fw_clearance_region *all,
                       fw_clearance_least *least) {
    const int ground = s->things->nbody;
    fw_mark mark = fw_arena_mark(arena);
    fw_clearance_pair pair;
    FW_TRY(fw_clearance_pair_new(arena, s->things, least->a == FW_GROUND ? ground : least->a,
                                 least->b == FW_GROUND ? ground : least->b, false, &pair));
    const double now = went(s, &pair);
    if (now > least->went_m) {
        least->share *= least->went_m / now;
        least->went_m = now;
    }
    least->moved_m = fmax(least->moved_m, moved(s, &pair, all));
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

static fw_status ranges(fw_arena *arena, const fw_clearance_path *path, fw_maths_interval **out) {
    FW_NEED(*out = fw_arena_array(arena, fw_maths_interval, (size_t)path->nq));
    for (int q = 0; q < path->nq; q++) {
        fw_maths_interval r = {HUGE_VAL, -HUGE_VAL};
        for (int piece = 0; piece < path->npiece; piece++) {
            const double *c = fw_clearance_path_coefficients(path, piece, q);
            for (int i = 0; i < path->nodes[piece]; i++) {
                r.lo = c[i] < r.lo ? c[i] : r.lo;
                r.hi = c[i] > r.hi ? c[i] : r.hi;
            }
        }
        (*out)[q] = r;
    }
    return FW_OK;
}

fw_status fw_clearance_of_path(fw_arena *arena, const fw_clearance_things *things,
                               const fw_clearance_path *path, const fw_clearance_wish *wish,
                               fw_clearance_least *least) {
    motion context = {.things = things, .path = path, .small_m = 1e-9};
    const fw_clearance_domain domain = {.context = &context,
                                        .bound = bound,
                                        .hull = hull_of,
                                        .moved = moved,
                                        .pose = pose,
                                        .start = start_at,
                                        .rough = rough,
                                        .split = split,
                                        .first_meeting = first_meeting};
    const fw_clearance_region all = {.span = {.first = 0, .last = path->npiece - 1, .to = 1}};
    if (path->npiece == 0) return FW_OK;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(ranges(arena, path, &context.range));
    if (least->known && least->m <= 0) return go_on(arena, &context, &all, least);
    fw_status status = fw_clearance_search(arena, things, &domain, &all, wish, least);
    fw_arena_rewind(arena, mark);
    return status;
}

/* ---- how much of the way to a distance is used ---- */

/* Along the straight way from where the motion begins to where a pair is farthest against each other,
   and on, until it would come within a distance: x times as far. The share is 1/x. What is nearest may
   never lose anything; what loses most may be far from nearest.

   Farthest: at the end of a piece of the path where one of the three coordinates of one against the
   other is largest or least. Error: of x, a thousandth of the motion; that a longer motion goes the same way is an
   assumption (docs/theory/clearance.md, section 5). Test: test_clearance.c */

enum { FARTHEST = 6 };

/* of one solid against the other where a piece ends, less what it was at the start */
static void apart_at(const motion *s, const fw_clearance_pair *pair, int piece, double out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int side = 0; side < 2; side++) {
            const int solid = side ? pair->b : pair->a, q = 3 * solid + k;
            if (solid == s->things->nbody) continue;
            const double to =
                fw_clearance_path_coefficients(s->path, piece, q)[s->path->nodes[piece] - 1];
            out[k] += (side ? 1 : -1) * (to - s->path->start[q]);
        }
    }
}

/* the pieces at whose ends they are farthest, each once; how many */
static int farthest(const motion *s, const fw_clearance_pair *pair, int piece[FARTHEST]) {
    double most[FARTHEST] = {0};
    int at[FARTHEST], n = 0;
    for (int k = 0; k < FARTHEST; k++)
        at[k] = FW_NONE;
    for (int i = 0; i < s->path->npiece; i++) {
        double off[3];
        apart_at(s, pair, i, off);
        for (int k = 0; k < FARTHEST; k++) {
            const double by = k % 2 ? -off[k / 2] : off[k / 2];
            if (by > most[k]) most[k] = by, at[k] = i;
        }
    }
    for (int k = 0; k < FARTHEST; k++) {
        bool seen = at[k] == FW_NONE;
        for (int i = 0; i < n; i++)
            seen = seen || piece[i] == at[k];
        if (!seen) piece[n++] = at[k];
    }
    return n;
}

/* from the start to the end of a piece, and so many times as far; t_s of the line: times */
static void line_to(const fw_clearance_path *path, int piece, double times,
                    fw_clearance_path *line) {
    for (int q = 0; q < path->nq; q++) {
        double *c = line->bern + (size_t)q * NODES;
        const double to = fw_clearance_path_coefficients(path, piece, q)[path->nodes[piece] - 1];
        c[0] = path->start[q];
        c[1] = c[0] + times * (to - c[0]);
    }
    line->nodes[0] = 2;
    line->t_s[0] = 0;
    line->t_s[1] = times;
    line->npiece = 1;
}

/* kept: work, room for the first one's edges. Edges that no line brings near each other are left out first. */
static void way_of_pair(const motion *s, fw_clearance_pair *pair, bool *kept, motion *on,
                        fw_clearance_path *line, fw_clearance_way *way) {
    const fw_clearance_region all = {.span = {.first = 0, .last = 0, .to = 1}};
    const double still_m = 1e-10, most = 1e3, exactly = 1e-3;
    fw_clearance_pose start[2];
    int piece[FARTHEST];
    const int n = farthest(s, pair, piece);
    double by = 0;
    for (int i = 0; i < n; i++) {
        line_to(s->path, piece[i], 1 / way->share, line);
        by = fmax(by, moved(on, pair, &all));
    }
    if (by * way->share < still_m) return;
    start_of(s, pair, start);
    const double near = on->within_m + by;
    if (fw_clearance_pair_distance(pair, start, near, NULL) >= near) return;
    fw_clearance_pair_narrow(pair, start, on->within_m, by, kept);
    for (int i = 0; i < n && pair->count[0] > 0 && pair->count[1] > 0; i++) {
        fw_clearance_least met = {.known = true, .moved_m = 1};
        line_to(s->path, piece[i], 1 / way->share, line);
        on->small_m = fmax(1e-9, exactly * way->share * moved(on, pair, &all));
        if (!first_meeting(on, pair, &all, 1 / way->share, &met)) continue;
        *way = (fw_clearance_way){.share = fmin(1 / met.t_s, most),
                                  .a = met.at.a,
                                  .b = met.at.b,
                                  .at = met.at.at_a,
                                  .t_s = s->path->t_s[2 * piece[i] + 1]};
    }
}

fw_status fw_clearance_way_of_path(fw_arena *arena, const fw_clearance_things *things,
                                   const fw_clearance_path *path, const fw_clearance_wish *wish,
                                   double within_m, fw_clearance_way *way) {
    const int n = things->nbody + 1;
    fw_mark mark = fw_arena_mark(arena);
    fw_clearance_path line;
    FW_TRY(fw_clearance_path_of(arena, things->nbody, 1, &line));
    const motion s = {.things = things, .path = path};
    motion on = {.things = things, .path = &line, .within_m = within_m};
    line.start = path->start;
    for (int a = 0; a < n && path->npiece > 0; a++)
        for (int b = a + 1; b < n; b++) {
            const bool walls = wish->may_meet && wish->may_meet[a * n + b];
            fw_clearance_pair pair;
            if ((walls && b != things->nbody) || things->solid[a].count == 0 ||
                things->solid[b].count == 0)
                continue;
            fw_mark here = fw_arena_mark(arena);
            FW_TRY(fw_clearance_pair_new(arena, things, a, b, walls, &pair));
            bool *kept = fw_arena_array(arena, bool, (size_t)pair.count[0] + 1);
            FW_NEED(kept);
            if (pair.count[0] > 0 && pair.count[1] > 0)
                way_of_pair(&s, &pair, kept, &on, &line, way);
            fw_arena_rewind(arena, here);
        }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
