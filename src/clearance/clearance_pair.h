/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two solids, the edges of them that may come near each other, and how far poses may let them come.
   Private to the room and its tests. */
#ifndef FW_CLEARANCE_CLEARANCE_PAIR_H
#define FW_CLEARANCE_CLEARANCE_PAIR_H
#include "clearance/clearance.h"
#include "maths/maths_interval.h"

typedef struct fw_clearance_pair {
    const fw_clearance_things *things;
    int a, b; /* solids; nbody: the ground */
    const fw_clearance_edge **edge[2];
    int count[2];
    fw_geometry_box *box;    /* (count[0]) of the first one's edges */
    fw_geometry_box *run;    /* of every eight of these */
    fw_geometry_box whole;   /* of all of them */
    fw_geometry_vec2 centre; /* in the first solid as drawn: the middle of its edges */
    double reach_m;          /* of these edges about it */
    double arm_m[2];         /* farthest edge from the solid's own centre of mass */
    /* two edges that may be the nearest ones, looked at first; NULL: not known */
    const fw_clearance_edge *likely[2];
} fw_clearance_pair;

fw_geometry_vec2 fw_clearance_place(const fw_clearance_solid *solid, fw_clearance_pose pose,
                                    fw_geometry_vec2 drawn);
/* walls: only edges of the ground that are walls whatever a scene lets meet */
fw_status fw_clearance_pair_new(fw_arena *arena, const fw_clearance_things *things, int a, int b,
                                bool walls, fw_clearance_pair *pair);
void fw_clearance_pair_boxes(fw_clearance_pair *pair);
void fw_clearance_pair_measure(fw_clearance_pair *pair);
/* kept: work, (count[0]) */
void fw_clearance_pair_narrow(fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                              double near_m, double slack_m, bool *kept);
/* least distance at these poses of the two solids where it is below the limit, else the limit */
double fw_clearance_pair_distance(const fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                                  double limit_m, fw_clearance_meet *meet);
/* the same without a limit; its nearest edges are looked at first from now on */
double fw_clearance_pair_distance_first(fw_clearance_pair *pair, const fw_clearance_pose pose[2]);

/* ---- poses of a pair along a path ---- */

enum { FW_CLEARANCE_OF_POSE = 4 }; /* x, y, phi, longer */
/* which of the path's coordinates it is */
static inline int fw_clearance_coordinate(const fw_clearance_path *path, int solid, int of_pose) {
    return of_pose < 3 ? 3 * solid + of_pose : path->nq - 1;
}

fw_clearance_pose fw_clearance_ground_pose(const fw_clearance_things *things);
void fw_clearance_pair_at(const fw_clearance_pair *pair, const fw_clearance_path *path, int piece,
                          double theta, fw_clearance_pose pose[2]);
/* coefficients of both solids' poses over one piece of the span; how many */
int fw_clearance_pair_coefficients(const fw_clearance_pair *pair, const fw_clearance_path *path,
                                   const fw_clearance_span *span, int piece,
                                   fw_clearance_pose pose[FW_CLEARANCE_NODES][2]);

/* ---- clearance_pair.c: poses that are not quite known ---- */

/* no two edges are nearer than at the middle poses by more than this, for every pose that is a
   convex combination of those that were added */
typedef struct fw_clearance_slack {
    fw_clearance_pose middle[2];
    fw_geometry_vec2 lever[2]; /* J(c - x), of both solids at their middle poses */
    double linear_m, turn_rad[2];
} fw_clearance_slack;
void fw_clearance_slack_begin(const fw_clearance_pair *pair, const fw_clearance_pose middle[2],
                              fw_clearance_slack *slack);
void fw_clearance_slack_add(const fw_clearance_pair *pair, const fw_clearance_pose pose[2],
                            fw_clearance_slack *slack);
double fw_clearance_slack_m(const fw_clearance_pair *pair, const fw_clearance_slack *slack);

/* poses of a pair of which all poses of a region are convex combinations, but for the rests */
enum { FW_CLEARANCE_HULL = FW_CLEARANCE_NODES > 8 ? FW_CLEARANCE_NODES : 8 };
typedef struct fw_clearance_hull {
    fw_clearance_pose middle[2], pose[FW_CLEARANCE_HULL][2];
    int count;
    double rest_m[2], rest_rad[2];
    bool apart; /* of each solid by itself: whichever poses of the two go together */
} fw_clearance_hull;
/* Proved: two edges are nowhere in the region nearer than this. *where: at which of the hull's
   poses they are, to first order; *there_m: how near */
double fw_clearance_edges_bound(const fw_clearance_pair *pair, const fw_clearance_hull *hull,
                                const fw_clearance_meet *meet, int *where, double *there_m);
/* the least of these bounds over all edges that may come nearer than needed_m; -HUGE_VAL as soon as
   one is below it. slack_m: of the region */
double fw_clearance_pair_bound(const fw_clearance_pair *pair, const fw_clearance_hull *hull,
                               double slack_m, double needed_m);

/* ---- clearance_search.c: the least over all poses of a domain ---- */

typedef struct fw_clearance_region { /* a part of a domain */
    fw_clearance_span span;          /* of a motion */
    double low[3], high[3];          /* of a box of the platform's poses: m, m, rad */
} fw_clearance_region;

enum { FW_CLEARANCE_PARTS = 16 };
typedef struct fw_clearance_domain {
    const void *context;
    /* poses in the region, and by how much the pair may be nearer in it than at these; false: not
       bounded, and an infinite slack then says that there is no pose at all */
    bool (*bound)(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *region, fw_clearance_pose middle[2], double *slack_m);
    /* the same of all of it, in a time that does not go with it; and of `moved` */
    void (*rough)(const void *context, const fw_clearance_pair *pair,
                  const fw_clearance_region *all, fw_clearance_pose middle[2], double *slack_m,
                  double *moved_m);
    /* the same as poses that hold those of the region between them; false: not known. NULL: never */
    bool (*hull)(const void *context, const fw_clearance_pair *pair,
                 const fw_clearance_region *region, fw_clearance_hull *hull);
    /* the region that is one pose of that hull; NULL: these are no poses of the region */
    fw_clearance_region (*corner)(const fw_clearance_region *region, int corner);
    /* how far the pair is moved against each other, at most, from the first pose */
    double (*moved)(const void *context, const fw_clearance_pair *pair,
                    const fw_clearance_region *all);
    /* a pose of the region (part 0: the first one), into at->pose and what says which it is; false:
       there is none */
    bool (*pose)(const void *context, const fw_clearance_pair *pair,
                 const fw_clearance_region *region, double part, fw_clearance_least *at);
    /* poses where it begins */
    void (*start)(const void *context, const fw_clearance_pair *pair, fw_clearance_pose pose[2]);
    /* into parts, how many; 0: too small */
    int (*split)(const void *context, const fw_clearance_region *region,
                 fw_clearance_region part[FW_CLEARANCE_PARTS]);
    /* `bound` gives the pose in the middle of the region, part 0.5, as its middle poses */
    bool middle_is_a_pose;
    /* where a pair meets first, and before that of before_s; false: it does not. NULL: there is no order */
    bool (*first_meeting)(const void *context, const fw_clearance_pair *pair,
                          const fw_clearance_region *all, double before_s,
                          fw_clearance_least *least);
} fw_clearance_domain;

fw_status fw_clearance_search(fw_arena *arena, const fw_clearance_things *things,
                              const fw_clearance_domain *domain, const fw_clearance_region *all,
                              const fw_clearance_wish *wish, fw_clearance_least *least);

#endif
