/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Branch and bound over all pairs of solids at once, the least bound first: over a motion's time or a
   box of poses alike. */
#include "clearance/clearance_pair.h"
#include "geometry/segment.h"
#include <math.h>

typedef struct node {
    double low_m; /* proved of this pair in this region; below 0: nothing is */
    double key_m;
    int pair;
    fw_clearance_region region;
} node;

typedef struct search {
    fw_arena *arena;
    const fw_clearance_domain *domain;
    const fw_clearance_things *things;
    const fw_clearance_wish *wish;
    fw_clearance_least *least;
    fw_clearance_pair *pair; /* (npair) */
    double *moved_m;         /* (npair) */
    bool *narrowed;          /* (npair) */
    bool *kept;              /* work */
    int npair;
    node *heap; /* (count) the least first */
    int count, room;
    double open_m; /* the least bound of regions that could not be halved any more */
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
    for (; i > 0 && s->heap[(i - 1) / 2].key_m > n->key_m; i = (i - 1) / 2)
        s->heap[i] = s->heap[(i - 1) / 2];
    s->heap[i] = *n;
    return FW_OK;
}

static node pop(search *s) {
    node top = s->heap[0], last = s->heap[--s->count];
    int i = 0;
    for (int child = 1; child < s->count; child = 2 * i + 1) {
        if (child + 1 < s->count && s->heap[child + 1].key_m < s->heap[child].key_m) child++;
        if (s->heap[child].key_m >= last.key_m) break;
        s->heap[i] = s->heap[child];
        i = child;
    }
    s->heap[i] = last;
    return top;
}

/* ---- what is found ---- */

/* what is more than wanted by this is enough for certain */
static const double fw_rounding_m = 1e-12;

/* what the motion may be off by comes off the distance: the least of that is looked for */
static double lost(const search *s, int p) {
    return s->wish->off * s->moved_m[p];
}

static double tolerance(const search *s) {
    return fmax(1e-9, s->wish->relative * fabs(s->least->left_m));
}

static double enough_of(const search *s) {
    return s->wish->enough_m + s->wish->beyond * s->least->farthest_m;
}

/* more than this left decides nothing any more */
static double bar(const search *s) {
    double enough = enough_of(s);
    return s->least->known ? fmin(s->least->left_m - tolerance(s), enough) : enough;
}

/* Where two parts are not proved to be apart that comes first: whether they meet is more than how
   near they come. */
static double key_of(const search *s, int p, double low_m) {
    const double first_m = 1;
    return low_m - lost(s, p) - (low_m > 0 ? 0 : first_m);
}

/* below this a distance at a pose is the least so far */
static double least_limit(const search *s, int p) {
    const fw_clearance_least *least = s->least;
    return least->known ? fmax(1e-12, least->left_m + lost(s, p)) : HUGE_VAL;
}

/* d: a distance at a pose of the pair, which says where it is, below the limit */
static void record(search *s, int p, const fw_clearance_least *there, double d,
                   const fw_clearance_meet *meet) {
    const fw_clearance_pair *pair = &s->pair[p];
    fw_clearance_least *least = s->least, now = *there;
    int ground = s->things->nbody;
    now.known = true;
    now.left_m = d > 0 ? d - lost(s, p) : -HUGE_VAL;
    now.m = d;
    now.low_m = least->low_m;
    now.at = *meet;
    now.a = pair->a == ground ? FW_GROUND : pair->a;
    now.b = pair->b == ground ? FW_GROUND : pair->b;
    now.moved_m = s->moved_m[p];
    now.farthest_m = least->farthest_m;
    now.share = 1;
    now.looked = least->looked;
    now.given_up = least->given_up;
    *least = now;
}

static void look(search *s, int p, const fw_clearance_region *region, double part) {
    fw_clearance_least now = {.known = true};
    fw_clearance_meet meet = {.a = NULL};
    if (!s->domain->pose(s->domain->context, &s->pair[p], region, part, &now)) return;
    s->least->looked++;
    double limit = least_limit(s, p);
    double d = fw_clearance_pair_distance(&s->pair[p], now.pose, limit, &meet);
    if (d < limit) record(s, p, &now, d, &meet);
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

/* a pair of which nothing moves against the other is no clearance of the motion */
static fw_status add_pair(search *s, const fw_clearance_region *all, int a, int b) {
    const int nsolid = s->things->nbody + 1;
    if (s->things->solid[a].count == 0 || s->things->solid[b].count == 0) return FW_OK;
    if (s->wish->left_out && (s->wish->left_out[a] || s->wish->left_out[b])) return FW_OK;
    bool walls = s->wish->may_meet && s->wish->may_meet[a * nsolid + b];
    if (walls && b != s->things->nbody) return FW_OK;
    const double still_m = 1e-10;
    fw_clearance_pair *pair = &s->pair[s->npair];
    fw_clearance_pose middle[2];
    double slack;
    FW_TRY(fw_clearance_pair_new(s->arena, s->things, a, b, walls, pair));
    if (pair->count[0] == 0 || pair->count[1] == 0) return FW_OK;
    node first = {.low_m = -1, .pair = s->npair, .region = *all};
    s->domain->rough(s->domain->context, pair, all, middle, &slack, &s->moved_m[s->npair]);
    if (slack < still_m) return FW_OK;
    s->least->farthest_m = fmax(s->least->farthest_m, s->moved_m[s->npair]);
    if (isfinite(slack)) first.low_m = boxes_apart(s, pair, middle) - slack;
    first.key_m = key_of(s, s->npair, first.low_m);
    s->npair++;
    return push(s, &first);
}

/* Only edges that may come as near as the least that is known matter from here on. */
static void narrow(search *s, int p, const fw_clearance_region *region) {
    fw_clearance_pair *pair = &s->pair[p];
    fw_clearance_pose middle[2];
    double slack;
    s->moved_m[p] = s->domain->moved(s->domain->context, pair, region);
    s->narrowed[p] = true;
    if (!isfinite(s->wish->enough_m)) { /* the least is looked for */
        look(s, p, region, 0);
        look(s, p, region, 1);
        look(s, p, region, 0.5);
    }
    if (!s->domain->bound(s->domain->context, pair, region, middle, &slack)) return;
    double near = enough_of(s); /* left */
    if (s->least->known) near = fmin(near, s->least->left_m);
    near = fmax(near + lost(s, p), 1e-9);
    if (isfinite(near + slack)) fw_clearance_pair_narrow(pair, middle, near, slack, s->kept);
}

/* ---- the search ---- */

/* does a bound decide that the region need not be looked at? */
static bool decides(const search *s, int p, double low_m) {
    return low_m > 0 && low_m - lost(s, p) >= bar(s);
}

/* What the direction in which the nearest edges are apart proves where their distance alone decides nothing,
   and where it is nearest to first order, a look at that pose. */
static double look_along(search *s, const node *n, const fw_clearance_meet *meet, double slack) {
    const fw_clearance_domain *domain = s->domain;
    const fw_clearance_pair *pair = &s->pair[n->pair];
    fw_clearance_hull hull;
    int nearest;
    double there;
    if (!domain->hull || !domain->hull(domain->context, pair, &n->region, &hull)) return -HUGE_VAL;
    /* whoever asks for enough alone reads what the looks on the way to it have found, too */
    if (hull.apart && isfinite(s->wish->enough_m)) return -HUGE_VAL;
    double low = fw_clearance_edges_bound(pair, &hull, meet, &nearest, &there);
    if (domain->corner && there - lost(s, n->pair) < bar(s)) {
        const fw_clearance_region corner = domain->corner(&n->region, nearest);
        look(s, n->pair, &corner, 0.5);
    }
    if (!decides(s, n->pair, low)) return -HUGE_VAL;
    return fw_clearance_pair_bound(pair, &hull, slack, fmax(bar(s) + lost(s, n->pair), 0));
}

/* what the region's middle proves, and where that is a pose what it finds; false: there is no pose
   in it */
static bool look_at_middle(search *s, const node *n, double *low, bool *looked) {
    const fw_clearance_domain *domain = s->domain;
    const fw_clearance_pair *pair = &s->pair[n->pair];
    fw_clearance_pose middle[2];
    fw_clearance_meet meet = {.a = NULL};
    double slack;
    *looked = false;
    if (!domain->bound(domain->context, pair, &n->region, middle, &slack)) return isfinite(slack);
    double limit = fmax(bar(s) + lost(s, n->pair), 0) + slack + fw_rounding_m;
    s->least->looked++;
    double d = fw_clearance_pair_distance(pair, middle, limit, &meet);
    *low = fmax(*low, d - slack);
    *looked = domain->middle_is_a_pose;
    fw_clearance_least now = {.known = true};
    if (*looked && d < limit && d < least_limit(s, n->pair) &&
        domain->pose(domain->context, pair, &n->region, 0.5, &now))
        record(s, n->pair, &now, d, &meet);
    if (d < limit && d > 0 && !decides(s, n->pair, *low))
        *low = fmax(*low, look_along(s, n, &meet, slack));
    return true;
}

static fw_status examine(search *s, const node *n) {
    if (!s->narrowed[n->pair]) narrow(s, n->pair, &n->region);
    const fw_clearance_pair *pair = &s->pair[n->pair];
    double low = n->low_m;
    bool looked;
    if (pair->count[0] == 0 || pair->count[1] == 0 || decides(s, n->pair, low)) return FW_OK;
    if (!look_at_middle(s, n, &low, &looked)) return FW_OK;
    if (decides(s, n->pair, low)) return FW_OK;
    if (!looked) look(s, n->pair, &n->region, 0.5);
    if (decides(s, n->pair, low)) return FW_OK;
    fw_clearance_region part[FW_CLEARANCE_PARTS];
    int parts = s->domain->split(s->domain->context, &n->region, part);
    if (parts == 0) {
        s->open_m = fmin(s->open_m, low - lost(s, n->pair));
        return FW_OK;
    }
    for (int i = 0; i < parts; i++) {
        const node next = {
            .low_m = low, .key_m = key_of(s, n->pair, low), .pair = n->pair, .region = part[i]};
        FW_TRY(push(s, &next));
    }
    return FW_OK;
}

static int pair_of(const search *s, const fw_clearance_least *least) {
    int ground = s->things->nbody;
    int a = least->a == FW_GROUND ? ground : least->a,
        b = least->b == FW_GROUND ? ground : least->b;
    for (int i = 0; i < s->npair; i++)
        if (s->pair[i].a == a && s->pair[i].b == b) return i;
    return FW_NONE;
}

static double start_distance(const search *s, int p) {
    fw_clearance_pose start[2];
    s->domain->start(s->domain->context, &s->pair[p], start);
    return fw_clearance_pair_distance(&s->pair[p], start, HUGE_VAL, NULL);
}

/* Pair p was found to meet, where it was looked first. What counts is which pair meets first, and when: behind a meeting
   the motion is none of the device's. A flexure that is only bounded does not go before what is drawn. */
static void meets_first(search *s, const fw_clearance_region *all, int p) {
    const fw_clearance_domain *domain = s->domain;
    fw_clearance_least *least = s->least;
    domain->first_meeting(domain->context, &s->pair[p], all, HUGE_VAL, least);
    for (int k = 0; k < s->npair; k++) {
        const fw_clearance_pair *pair = &s->pair[k];
        if (k == p || pair->count[0] == 0 || pair->count[1] == 0) continue;
        fw_clearance_least other = {.known = true};
        other.moved_m = s->narrowed[k] ? s->moved_m[k] : domain->moved(domain->context, pair, all);
        bool before = domain->first_meeting(domain->context, pair, all, least->t_s, &other);
        least->looked += other.looked;
        if (!before || (other.at.bound && !least->at.bound)) continue;
        s->moved_m[k] = other.moved_m;
        const double share = other.share;
        record(s, k, &other, 0, &other.at); /* went_m with it */
        least->share = share;
        least->start_m = start_distance(s, k);
    }
}

static fw_status run(search *s, const fw_clearance_region *all) {
    fw_clearance_least *least = s->least;
    const double before = least->known ? least->left_m : HUGE_VAL;
    const long before_looked = least->looked;
    for (; s->count > 0 && s->heap[0].key_m < bar(s);) {
        if (least->known && least->m <= 0) break;
        bool undecided = s->heap[0].key_m < s->wish->needed_m + s->wish->beyond * least->farthest_m;
        long most = undecided ? s->wish->most_ever : s->wish->most;
        if (least->looked - before_looked >= most || fw_arena_cancelled(s->arena)) {
            least->given_up = undecided;
            break;
        }
        const node n = pop(s);
        FW_TRY(examine(s, &n));
    }
    if (fw_arena_cancelled(s->arena)) return FW_CANCELLED;
    for (int i = 0; i < s->count; i++)
        s->open_m = fmin(s->open_m, fmax(0, s->heap[i].low_m) - lost(s, s->heap[i].pair));
    least->low_m = fmin(least->low_m, fmin(s->open_m, bar(s)));
    int p = least->known && least->left_m < before ? pair_of(s, least) : FW_NONE;
    if (p == FW_NONE) return FW_OK;
    least->start_m = start_distance(s, p);
    if (least->m <= 0 && s->domain->first_meeting) meets_first(s, all, p);
    return FW_OK;
}

/* Least over all pairs of solids and all poses of a domain of their distance d:
     d >= D(middle) - slack   over a region (clearance_pair.c), d at a pose >= the least.
   Regions of all pairs lie in one heap; the one with the least bound is looked at next and halved,
   until no bound is below the least distance found by more than the error wanted. In: things, a
   domain and all of it (m, rad); out: least, its bound, pair, places. Error: least.m - least.low_m
   <= max(1 nm, relative * m), proved, unless given up. Cost: a slack and a distance
   (clearance_pair.c) for every region that is looked at. Source: docs/theory/clearance.md.
   Test: test_clearance.c, tests/clearance/ */
fw_status fw_clearance_search(fw_arena *arena, const fw_clearance_things *things,
                              const fw_clearance_domain *domain, const fw_clearance_region *all,
                              const fw_clearance_wish *wish, fw_clearance_least *least) {
    size_t n = (size_t)things->nbody + 1, pairs = n * (n - 1) / 2, edges = 1;
    fw_arena *work = fw_arena_part(arena, 0);
    fw_status status = FW_OK;
    FW_NEED(work);
    search s = {.arena = work,
                .domain = domain,
                .things = things,
                .wish = wish,
                .least = least,
                .open_m = HUGE_VAL};
    for (size_t i = 0; i < n; i++)
        edges += (size_t)things->solid[i].count;
    s.pair = fw_arena_array(work, fw_clearance_pair, pairs);
    s.moved_m = fw_arena_array(work, double, pairs);
    s.narrowed = fw_arena_array(work, bool, pairs);
    s.kept = fw_arena_array(work, bool, edges);
    if (!s.pair || !s.moved_m || !s.narrowed || !s.kept) status = FW_NOMEM;
    for (size_t a = 0; a < n && status == FW_OK; a++)
        for (size_t b = a + 1; b < n && status == FW_OK; b++)
            status = add_pair(&s, all, (int)a, (int)b);
    if (status == FW_OK) status = run(&s, all);
    fw_arena_free(work);
    return status;
}
