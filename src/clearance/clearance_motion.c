/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least clearance over a motion: branch and bound in time over all pairs of solids at once, the
   least bound first. */
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

enum { NODES = FW_CLEARANCE_NODES };

typedef struct node {
    double low_m; /* proved of this pair in this span */
    int pair;
    fw_clearance_span span;
} node;

typedef struct search {
    fw_arena *arena;
    const fw_clearance_things *things;
    const fw_clearance_path *path;
    const fw_clearance_wish *wish;
    fw_clearance_least *least;
    fw_clearance_pair *pair; /* (npair) */
    double *moved_m;         /* (npair) */
    bool *narrowed;          /* (npair) */
    bool *kept;              /* work */
    int npair;
    node *heap; /* (count) the least first */
    int count, room;
    double open_m; /* the least bound that was left when the search ended */
} search;

/* ---- the heap ---- */

static fw_status push(search *s, const node *n) {
    if (s->count == s->room) {
        int more = s->room ? 2 * s->room : 256;
        FW_NEED(s->heap = fw_arena_grow(s->arena, s->heap, (size_t)s->count, (size_t)more,
                                        sizeof *s->heap));
        s->room = more;
    }
    int i = s->count++;
    for (; i > 0 && s->heap[(i - 1) / 2].low_m > n->low_m; i = (i - 1) / 2)
        s->heap[i] = s->heap[(i - 1) / 2];
    s->heap[i] = *n;
    return FW_OK;
}

static node pop(search *s) {
    node top = s->heap[0], last = s->heap[--s->count];
    int i = 0;
    for (int child = 1; child < s->count; child = 2 * i + 1) {
        if (child + 1 < s->count && s->heap[child + 1].low_m < s->heap[child].low_m) child++;
        if (s->heap[child].low_m >= last.low_m) break;
        s->heap[i] = s->heap[child];
        i = child;
    }
    s->heap[i] = last;
    return top;
}

/* ---- poses of a pair over a span ---- */

static fw_clearance_pose ground_pose(const search *s) {
    const fw_clearance_solid *ground = &s->things->solid[s->things->nbody];
    return (fw_clearance_pose){ground->centre.x, ground->centre.y, ground->turned_rad};
}

static void pose_at(const search *s, const fw_clearance_pair *pair, int piece, double theta,
                    fw_clearance_pose pose[2]) {
    for (int k = 0; k < 2; k++) {
        int solid = k ? pair->b : pair->a, q = 3 * solid;
        pose[k] = ground_pose(s);
        if (solid == s->things->nbody) continue;
        pose[k].x_m = fw_clearance_path_value(s->path, piece, q, theta);
        pose[k].y_m = fw_clearance_path_value(s->path, piece, q + 1, theta);
        pose[k].phi_rad = fw_clearance_path_value(s->path, piece, q + 2, theta);
    }
}

/* coefficients of both solids' poses over one piece of the span */
static int coefficients(const search *s, const fw_clearance_pair *pair,
                        const fw_clearance_span *span, int piece,
                        fw_clearance_pose pose[NODES][2]) {
    int n = s->path->nodes[piece];
    for (int k = 0; k < 2; k++) {
        int solid = k ? pair->b : pair->a;
        double c[3][NODES];
        bool ground = solid == s->things->nbody;
        for (int q = 0; q < 3 && !ground; q++)
            fw_clearance_path_part(s->path, piece, 3 * solid + q, span->from, span->to, c[q]);
        for (int i = 0; i < n; i++)
            pose[i][k] =
                ground ? ground_pose(s) : (fw_clearance_pose){c[0][i], c[1][i], c[2][i]};
    }
    return n;
}

static void join(fw_maths_interval *range, double x) {
    range->lo = fmin(range->lo, x);
    range->hi = fmax(range->hi, x);
}

static void middle_of(const search *s, const fw_clearance_pair *pair,
                      const fw_clearance_span *span, fw_clearance_pose middle[2]) {
    fw_maths_interval range[2][3];
    fw_clearance_pose pose[NODES][2];
    for (int k = 0; k < 6; k++)
        range[k / 3][k % 3] = (fw_maths_interval){HUGE_VAL, -HUGE_VAL};
    for (int piece = span->first; piece <= span->last; piece++) {
        int n = coefficients(s, pair, span, piece, pose);
        for (int i = 0; i < n; i++)
            for (int k = 0; k < 2; k++) {
                join(&range[k][0], pose[i][k].x_m);
                join(&range[k][1], pose[i][k].y_m);
                join(&range[k][2], pose[i][k].phi_rad);
            }
    }
    for (int k = 0; k < 2; k++)
        middle[k] = (fw_clearance_pose){0.5 * (range[k][0].lo + range[k][0].hi),
                                        0.5 * (range[k][1].lo + range[k][1].hi),
                                        0.5 * (range[k][2].lo + range[k][2].hi)};
}

/* no two edges of the pair are nearer in this span than at the middle poses by more than this */
static double slack_about(const search *s, const fw_clearance_pair *pair,
                          const fw_clearance_span *span, const fw_clearance_pose middle[2]) {
    fw_clearance_slack slack;
    fw_clearance_pose pose[NODES][2];
    fw_clearance_slack_begin(pair, middle, &slack);
    for (int piece = span->first; piece <= span->last; piece++) {
        int n = coefficients(s, pair, span, piece, pose);
        for (int i = 0; i < n; i++)
            fw_clearance_slack_add(pair, (const fw_clearance_pose *)pose[i], &slack);
    }
    return fw_clearance_slack_m(pair, &slack);
}

/* ---- what is found ---- */

static double tolerance(const search *s) {
    return fmax(1e-9, s->wish->relative * s->least->m);
}

/* farther apart than this decides nothing */
static double bar(const search *s) {
    if (!s->least->known) return s->wish->enough_m;
    return fmin(s->least->m - tolerance(s), s->wish->enough_m);
}

static void look(search *s, int p, int piece, double theta) {
    const fw_clearance_pair *pair = &s->pair[p];
    fw_clearance_least *least = s->least;
    fw_clearance_pose pose[2];
    fw_clearance_meet meet = {.a = NULL};
    pose_at(s, pair, piece, theta, pose);
    least->looked++;
    double limit = least->known ? least->m : HUGE_VAL;
    double d = fw_clearance_pair_distance(pair, pose, limit, &meet);
    if (!(d < limit)) return;
    const double *t = s->path->t_s + 2 * piece;
    int ground = s->things->nbody;
    *least = (fw_clearance_least){.known = true,
                                  .m = d,
                                  .low_m = least->low_m,
                                  .at = meet,
                                  .t_s = t[0] + theta * (t[1] - t[0]),
                                  .a = pair->a == ground ? FW_GROUND : pair->a,
                                  .b = pair->b == ground ? FW_GROUND : pair->b,
                                  .pose = {pose[0], pose[1]},
                                  .moved_m = s->moved_m[p],
                                  .share = 1,
                                  .looked = least->looked,
                                  .given_up = least->given_up};
}

/* ---- pairs ---- */

static double boxes_apart(const search *s, const fw_clearance_pair *pair,
                          const fw_clearance_pose middle[2]) {
    fw_geometry_box box[2];
    for (int k = 0; k < 2; k++) {
        const fw_clearance_solid *solid = &s->things->solid[k ? pair->b : pair->a];
        fw_geometry_box b = solid->box;
        fw_geometry_vec2 corner[4] = {{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}, {b.x0, b.y1}};
        for (int i = 0; i < 4; i++) {
            fw_geometry_vec2 p = fw_clearance_place(solid, middle[k], corner[i]);
            fw_geometry_box at = {p.x, p.y, p.x, p.y};
            box[k] = i ? fw_box_join(box[k], at) : at;
        }
    }
    return fw_box_gap(box[0], box[1]);
}

static fw_clearance_span whole(const search *s) {
    return (fw_clearance_span){.first = 0, .last = s->path->npiece - 1, .from = 0, .to = 1};
}

/* a pair of which nothing moves against the other is no clearance of the motion */
static fw_status add_pair(search *s, int a, int b) {
    const int nsolid = s->things->nbody + 1;
    if (s->things->solid[a].count == 0 || s->things->solid[b].count == 0) return FW_OK;
    if (s->wish->may_meet && s->wish->may_meet[a * nsolid + b]) return FW_OK;
    const double still_m = 1e-10;
    fw_clearance_pair *pair = &s->pair[s->npair];
    const fw_clearance_span all = whole(s);
    fw_clearance_pose middle[2], start[2];
    FW_TRY(fw_clearance_pair_new(s->arena, s->things, a, b, pair));
    middle_of(s, pair, &all, middle);
    double slack = slack_about(s, pair, &all, middle);
    if (slack < still_m) return FW_OK;
    pose_at(s, pair, 0, 0, start);
    s->moved_m[s->npair] = slack_about(s, pair, &all, start);
    const node first = {.low_m = fmax(0, boxes_apart(s, pair, middle) - slack),
                        .pair = s->npair++,
                        .span = all};
    return push(s, &first);
}

/* Only edges that may come as near as the least that is known matter from here on. */
static void narrow(search *s, int p, const fw_clearance_span *span) {
    fw_clearance_pair *pair = &s->pair[p];
    fw_clearance_pose middle[2];
    look(s, p, span->first, 0);
    look(s, p, span->last, 1);
    look(s, p, (span->first + span->last) / 2, 0.5);
    middle_of(s, pair, span, middle);
    double near = fmin(s->least->known ? s->least->m : HUGE_VAL, s->wish->enough_m);
    double slack = slack_about(s, pair, span, middle);
    if (isfinite(near)) fw_clearance_pair_narrow(pair, middle, near, slack, s->kept);
    s->narrowed[p] = true;
}

/* ---- the search ---- */

static void halves(const search *s, const fw_clearance_span *span, fw_clearance_span half[2]) {
    (void)s;
    half[0] = half[1] = *span;
    if (span->last > span->first) {
        half[0].last = (span->first + span->last) / 2;
        half[1].first = half[0].last + 1;
    } else {
        half[0].to = half[1].from = 0.5 * (span->from + span->to);
    }
}

static bool too_short(const fw_clearance_span *span) {
    return span->first == span->last && span->to - span->from < 1e-12;
}

static fw_status examine(search *s, const node *n) {
    if (!s->narrowed[n->pair]) narrow(s, n->pair, &n->span);
    const fw_clearance_pair *pair = &s->pair[n->pair];
    fw_clearance_pose middle[2];
    if (pair->count[0] == 0 || pair->count[1] == 0 || n->low_m >= bar(s)) return FW_OK;
    middle_of(s, pair, &n->span, middle);
    double slack = slack_about(s, pair, &n->span, middle), limit = bar(s) + slack;
    double low = fw_clearance_pair_distance(pair, middle, limit, NULL) - slack;
    s->least->looked++;
    low = fmax(low, n->low_m);
    if (low >= bar(s)) return FW_OK;
    look(s, n->pair, (n->span.first + n->span.last) / 2, 0.5 * (n->span.from + n->span.to));
    if (low >= bar(s)) return FW_OK;
    if (too_short(&n->span)) {
        s->open_m = fmin(s->open_m, low);
        return FW_OK;
    }
    fw_clearance_span half[2];
    halves(s, &n->span, half);
    for (int i = 0; i < 2; i++) {
        const node next = {.low_m = low, .pair = n->pair, .span = half[i]};
        FW_TRY(push(s, &next));
    }
    return FW_OK;
}

/* the earliest instant at which the pair that meets does: spans in order of time, each cleared or
   halved; what is left within 1 nm of motion is where they meet */
static fw_status first_meeting(search *s, int p, fw_clearance_least *least) {
    fw_clearance_span stack[128], half[2];
    int depth = 0;
    const fw_clearance_pair *pair = &s->pair[p];
    stack[depth++] = whole(s);
    for (long tries = 0; depth > 0 && tries < 4096; tries++) {
        const fw_clearance_span span = stack[--depth];
        fw_clearance_pose middle[2];
        middle_of(s, pair, &span, middle);
        double slack = slack_about(s, pair, &span, middle);
        least->looked++;
        if (fw_clearance_pair_distance(pair, middle, slack + 1e-12, NULL) > slack) continue;
        if ((slack < 1e-9 || too_short(&span)) && span.first == span.last) {
            fw_clearance_pose pose[2], start[2];
            const double *t = s->path->t_s + 2 * span.first;
            pose_at(s, pair, span.first, span.to, pose);
            pose_at(s, pair, 0, 0, start);
            fw_clearance_slack moved;
            fw_clearance_slack_begin(pair, start, &moved);
            fw_clearance_slack_add(pair, pose, &moved);
            fw_clearance_meet meet = least->at;
            fw_clearance_pair_distance(pair, pose, HUGE_VAL, &meet);
            least->at = meet;
            least->pose[0] = pose[0], least->pose[1] = pose[1];
            least->t_s = t[0] + span.to * (t[1] - t[0]);
            least->share = fmin(1, fw_clearance_slack_m(pair, &moved) / least->moved_m);
            return FW_OK;
        }
        if (depth + 2 > 128) continue;
        halves(s, &span, half);
        stack[depth++] = half[1];
        stack[depth++] = half[0];
    }
    return FW_OK;
}

static int pair_of(const search *s, const fw_clearance_least *least) {
    int ground = s->things->nbody;
    int a = least->a == FW_GROUND ? ground : least->a, b = least->b == FW_GROUND ? ground : least->b;
    for (int i = 0; i < s->npair; i++)
        if (s->pair[i].a == a && s->pair[i].b == b) return i;
    return FW_NONE;
}

/* distance of the pair where the motion begins */
static void note_start(search *s, int p) {
    fw_clearance_pose pose[2];
    pose_at(s, &s->pair[p], 0, 0, pose);
    s->least->start_m = fw_clearance_pair_distance(&s->pair[p], pose, HUGE_VAL, NULL);
}

static fw_status run(search *s) {
    fw_clearance_least *least = s->least;
    const double before = least->known ? least->m : HUGE_VAL;
    for (; s->count > 0 && s->heap[0].low_m < bar(s);) {
        if (least->known && least->m <= 0) break;
        if (least->looked >= s->wish->most || fw_arena_cancelled(s->arena)) {
            least->given_up = true;
            break;
        }
        const node n = pop(s);
        FW_TRY(examine(s, &n));
    }
    if (fw_arena_cancelled(s->arena)) return FW_CANCELLED;
    if (s->count > 0) s->open_m = fmin(s->open_m, s->heap[0].low_m);
    double proved = fmin(s->open_m, bar(s)); /* the pair's own: never above what was found */
    least->low_m = fmax(0, fmin(least->low_m, proved));
    int p = least->known && least->m < before ? pair_of(s, least) : FW_NONE;
    if (p == FW_NONE) return FW_OK;
    note_start(s, p);
    return least->m <= 0 ? first_meeting(s, p, least) : FW_OK;
}

/* Least over all pairs of solids and all instants of the path of their distance d(t):
     d(t) >= D(middle) - slack   over a span (clearance_slack.c), d at an instant >= the least.
   Spans of all pairs lie in one heap; the one with the least bound is looked at next and halved, by
   pieces first, then within a piece, until no bound is below the least distance found by more than
   the error wanted. In: things, a path (m, rad); out: least, its bound, pair, places, instant.
   Error: least.m - least.low_m <= max(1 nm, relative * m), proved, unless given up. Cost: a slack
   (pieces x nodes) and a distance (clearance_pair.c) for every span that is looked at.
   Source: docs/theory/clearance.md. Test: test_clearance.c, tests/clearance/ */
fw_status fw_clearance_of_path(fw_arena *arena, const fw_clearance_things *things,
                               const fw_clearance_path *path, const fw_clearance_wish *wish,
                               fw_clearance_least *least) {
    size_t n = (size_t)things->nbody + 1, pairs = n * (n - 1) / 2, edges = 1;
    fw_arena *work = fw_arena_part(arena, 0);
    fw_status status = FW_OK;
    FW_NEED(work);
    search s = {.arena = work, .things = things, .path = path, .wish = wish, .least = least,
                .open_m = HUGE_VAL};
    for (size_t i = 0; i < n; i++)
        edges += (size_t)things->solid[i].count;
    s.pair = fw_arena_array(work, fw_clearance_pair, pairs);
    s.moved_m = fw_arena_array(work, double, pairs);
    s.narrowed = fw_arena_array(work, bool, pairs);
    s.kept = fw_arena_array(work, bool, edges);
    if (!s.pair || !s.moved_m || !s.narrowed || !s.kept) status = FW_NOMEM;
    for (size_t a = 0; a < n && status == FW_OK && path->npiece > 0; a++)
        for (size_t b = a + 1; b < n && status == FW_OK; b++)
            status = add_pair(&s, (int)a, (int)b);
    if (status == FW_OK) status = run(&s);
    fw_arena_free(work);
    return status;
}
