/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vectors, and what can be asked of one or two segments: the parts of this room, shared with the
   exact rule checks of mask/. */
#ifndef FW_GEOMETRY_SEGMENT_H
#define FW_GEOMETRY_SEGMENT_H
#include "base/constants.h"
#include "geometry/contour.h"
#include <math.h>

#define FW_COINCIDENT_M 1e-12 /* points nearer than this are one point */
#define FW_SMOOTH_RAD   1e-6  /* a smaller turn is no corner */

static inline fw_geometry_vec2 vec_add(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return (fw_geometry_vec2){p.x + q.x, p.y + q.y};
}
static inline fw_geometry_vec2 vec_sub(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return (fw_geometry_vec2){p.x - q.x, p.y - q.y};
}
static inline fw_geometry_vec2 vec_scale(double s, fw_geometry_vec2 p) {
    return (fw_geometry_vec2){s * p.x, s * p.y};
}
static inline fw_geometry_vec2 vec_along(fw_geometry_vec2 p, double s, fw_geometry_vec2 u) {
    return (fw_geometry_vec2){p.x + s * u.x, p.y + s * u.y};
}
static inline double vec_dot(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x * q.x + p.y * q.y;
}
static inline double vec_cross(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x * q.y - p.y * q.x;
}
/* not hypot: sqrt is correctly rounded everywhere, so results do not depend on the C library */
static inline double vec_length(fw_geometry_vec2 p) {
    return sqrt(p.x * p.x + p.y * p.y);
}
static inline double vec_distance(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return vec_length(vec_sub(p, q));
}
static inline fw_geometry_vec2 vec_left(fw_geometry_vec2 p) {
    return (fw_geometry_vec2){-p.y, p.x};
}
static inline bool vec_same(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x == q.x && p.y == q.y;
}
static inline bool vec_before(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
}
static inline bool vec_finite(fw_geometry_vec2 p) {
    return isfinite(p.x) && isfinite(p.y);
}
/* unit vector; (1, 0) for the null vector */
static inline fw_geometry_vec2 vec_unit(fw_geometry_vec2 p) {
    double length = vec_length(p);
    return length > 0 ? vec_scale(1 / length, p) : (fw_geometry_vec2){1, 0};
}

fw_geometry_vec2 fw_geometry_vec_rotate(fw_geometry_vec2 p, double angle_rad);
/* angle from p to q, -pi..pi */
double fw_geometry_vec_angle(fw_geometry_vec2 p, fw_geometry_vec2 q);
/* angle + 2 pi k nearest to `near` */
double fw_geometry_angle_near(double angle_rad, double near_rad);

/* foot of the perpendicular on a line, or the nearer end; *t: where */
static inline fw_geometry_vec2 vec_line_foot(fw_geometry_vec2 a, fw_geometry_vec2 b,
                                             fw_geometry_vec2 from, double *t) {
    fw_geometry_vec2 along = vec_sub(b, a);
    double square = vec_dot(along, along);
    double here = square > 0 ? vec_dot(vec_sub(from, a), along) / square : 0;
    *t = here < 0 ? 0 : here > 1 ? 1 : here;
    if (here <= 0) return a;
    if (here >= 1) return b;
    return here <= 0.5 ? vec_along(a, here, along) : vec_along(b, here - 1, along);
}

/* t runs from 0 at a to 1 at b; both ends are returned bit for bit */
fw_geometry_vec2 fw_geometry_segment_point(const fw_geometry_segment *s, double t);
/* chords in place of it that are off by 0.5 % of its radius: how many */
int fw_geometry_segment_parts(const fw_geometry_segment *s);
fw_geometry_vec2 fw_geometry_segment_tangent(const fw_geometry_segment *s,
                                             double t); /* unit, in the running direction */
double fw_geometry_segment_length(const fw_geometry_segment *s);
double fw_geometry_segment_parameter(const fw_geometry_segment *s,
                                     fw_geometry_vec2 on); /* of a point on the segment, 0..1 */
/* the nearest point; the second: its distance (t and at may be NULL) */
fw_geometry_vec2 fw_geometry_segment_foot(const fw_geometry_segment *s, fw_geometry_vec2 from,
                                          double *t);
double fw_geometry_segment_nearest(const fw_geometry_segment *s, fw_geometry_vec2 from, double *t,
                                   fw_geometry_vec2 *at);
/* Is the nearest point no farther than a reach? Asked of many places. Said by squares, without a root, a quotient or an
   angle, where the foot is surely no end of the segment, or the carrier is too far away, and the distance is not within a
   billionth of the reach (and 1e-10 m, by which ends may be off a circle); else by the nearest point.
   In: segment, reach > 0 (m), place. Out: whether fw_geometry_segment_nearest is at most the reach. Test:
   test_segment.c. */
typedef struct fw_geometry_near {
    const fw_geometry_segment *segment;
    double reach;
    double far,
        sure; /* the reach squared, with all that may be wrong: of a line times its length squared, */
    double within, sure_within; /* of an arc from its centre, on either side of it */
    fw_geometry_vec2 u,
        v; /* line: along it; arc: from the centre to its ends, turned round where it runs clockwise */
    double square, margin;
    bool both,
        either; /* arc: less, more than half a turn: after one end and before the other, or one of these */
} fw_geometry_near;
fw_geometry_near fw_geometry_near_of(const fw_geometry_segment *s, double reach);
static inline bool fw_geometry_is_near(const fw_geometry_near *n, fw_geometry_vec2 at) {
    const fw_geometry_segment *s = n->segment;
    if (s->kind == FW_LINE) {
        const fw_geometry_vec2 to = vec_sub(at, s->a);
        const double t = vec_dot(to, n->u), off = vec_cross(n->u, to), square = off * off;
        if (square > n->far) return false;
        if (t >= 0 && t <= n->square && square < n->sure) return true;
    } else {
        const fw_geometry_vec2 ray = vec_sub(at, s->centre);
        const double square = vec_dot(ray, ray);
        if (square > n->far || square < n->within) return false;
        if (square < n->sure && square > n->sure_within) {
            const double margin = n->margin * (fabs(ray.x) + fabs(ray.y));
            const bool after_a = vec_cross(n->u, ray) > margin,
                       before_b = vec_cross(ray, n->v) > margin;
            if ((n->both && after_a && before_b) || (n->either && (after_a || before_b)))
                return true;
        }
    }
    return fw_geometry_segment_nearest(s, at, NULL, NULL) <= n->reach;
}
/* sets row[i], of bytes 0 and 1, for first <= i <= last where (from_x + (i + 0.5) step, y) is near; of a line along x,
   whose carrier is as far from all of them, those between its ends at once. Test: test_segment.c */
void fw_geometry_near_row(const fw_geometry_near *n, double from_x, double step, double y,
                          int first, int last, unsigned char *row);
/* does the ray from the arc's centre along `direction` meet the arc (ends included)? */
bool fw_geometry_segment_faces(const fw_geometry_segment *arc, fw_geometry_vec2 direction,
                               double *t);
/* moved by d along its normals, to the right of its way: outward of a contour; an arc's radius may come out <= 0, and
   nothing of it is left then */
fw_geometry_segment fw_geometry_segment_moved(const fw_geometry_segment *s, double d);
fw_geometry_segment fw_geometry_segment_reverse(const fw_geometry_segment *s);
/* the part between two parameters, with end points already known */
fw_geometry_segment fw_geometry_segment_cut(const fw_geometry_segment *s, double t0,
                                            fw_geometry_vec2 p0, double t1, fw_geometry_vec2 p1);
bool fw_geometry_segment_valid(const fw_geometry_segment *s);

/* points of a line (point, unit direction) on a circle, of two circles; 0, 1 (touch) or 2 */
int fw_geometry_line_circle(fw_geometry_vec2 p, fw_geometry_vec2 u, fw_geometry_vec2 centre,
                            double radius, fw_geometry_vec2 hit[2]);
int fw_geometry_circle_circle(fw_geometry_vec2 c1, double r1, fw_geometry_vec2 c2, double r2,
                              fw_geometry_vec2 hit[2]);
/* points common to the carriers (whole line or whole circle) of two segments */
int fw_geometry_carrier_meet(const fw_geometry_segment *p, const fw_geometry_segment *q,
                             fw_geometry_vec2 hit[2]);

typedef struct fw_geometry_hit {
    double tp, tq;
    fw_geometry_vec2 at;
} fw_geometry_hit;
enum { FW_MOST_HITS = 6 };
/* where two segments meet, touch, or begin and end to overlap */
int fw_geometry_segment_intersect(const fw_geometry_segment *p, const fw_geometry_segment *q,
                                  fw_geometry_hit hit[FW_MOST_HITS]);

/* stationary chords between two segments */
typedef struct fw_geometry_chord {
    double tp, tq;
    fw_geometry_vec2 at_p, at_q;
} fw_geometry_chord;
enum { FW_MOST_CHORDS = 12 };
int fw_geometry_segment_chords(const fw_geometry_segment *p, const fw_geometry_segment *q,
                               fw_geometry_chord chord[FW_MOST_CHORDS]);
/* |r1 - r2| of concentric arcs that run opposite ways, so that their normals face each other, and
   lie before each other seen from the centre, in the unit direction `along`: the least of all
   chords on which they face each other. HUGE_VAL: they are not like that */
double fw_geometry_concentric_gap(const fw_geometry_segment *p, const fw_geometry_segment *q,
                                  fw_geometry_vec2 *along);
double fw_geometry_segment_distance(const fw_geometry_segment *p, const fw_geometry_segment *q,
                                    fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q);
/* lines for all of which one thing is computed: their ends, each number in a row */
enum { FW_GEOMETRY_LINES_TOGETHER = 4 };
typedef struct fw_geometry_lines {
    double *ax, *ay, *bx,
        *by; /* (n, and as many more as are computed together, which say nothing) */
    int n;
} fw_geometry_lines;
/* room for n lines, without any */
fw_status fw_geometry_lines_new(fw_arena *arena, int n, fw_geometry_lines *to);
void fw_geometry_lines_add(fw_geometry_lines *to, double ax, double ay, double bx, double by);
/* off (n, and FW_GEOMETRY_LINES_TOGETHER more): the squared distances of a place from the lines; returns
   the least, HUGE_VAL where there is none. Same bits on every processor. Cost 8 operations a line and place.
   Test: test_body_arms.c */
double fw_geometry_lines_least_square(const fw_geometry_lines *lines, fw_geometry_vec2 at,
                                      double *off);

/* turns of the contour about the point, counter-clockwise positive */
int fw_geometry_contour_winding(const fw_geometry_contour *contour, fw_geometry_vec2 point);

/* of numbers: fmin and fmax without their calls */
static inline double fw_lesser(double p, double q) {
    return p < q ? p : q;
}
static inline double fw_greater(double p, double q) {
    return p > q ? p : q;
}
/* least distance between two boxes */
static inline double fw_box_gap(fw_geometry_box p, fw_geometry_box q) {
    double x = fw_greater(fw_greater(p.x0 - q.x1, q.x0 - p.x1), 0);
    double y = fw_greater(fw_greater(p.y0 - q.y1, q.y0 - p.y1), 0);
    return x > 0 && y > 0 ? sqrt(x * x + y * y) : x + y;
}
/* are they that far apart along x or along y alone, as most boxes are? */
static inline bool fw_box_apart(const fw_geometry_box *p, const fw_geometry_box *q, double least) {
    return p->x0 - q->x1 >= least || q->x0 - p->x1 >= least || p->y0 - q->y1 >= least ||
           q->y0 - p->y1 >= least;
}
/* the same of what is farther than `most`: fw_box_gap(p, q) > most, with a root for boxes at corners of each other alone */
static inline bool fw_box_beyond(const fw_geometry_box *p, const fw_geometry_box *q, double most) {
    return p->x0 - q->x1 > most || q->x0 - p->x1 > most || p->y0 - q->y1 > most ||
           q->y0 - p->y1 > most || fw_box_gap(*p, *q) > most;
}
static inline fw_geometry_box fw_box_join(fw_geometry_box p, fw_geometry_box q) {
    return (fw_geometry_box){fw_lesser(p.x0, q.x0), fw_lesser(p.y0, q.y0), fw_greater(p.x1, q.x1),
                             fw_greater(p.y1, q.y1)};
}
fw_geometry_box fw_geometry_arc_box(const fw_geometry_segment *arc, fw_geometry_box ends);
static inline fw_geometry_box fw_segment_box(const fw_geometry_segment *s) {
    fw_geometry_box box = {fw_lesser(s->a.x, s->b.x), fw_lesser(s->a.y, s->b.y),
                           fw_greater(s->a.x, s->b.x), fw_greater(s->a.y, s->b.y)};
    return s->kind == FW_LINE ? box : fw_geometry_arc_box(s, box);
}
/* a lower bound of the distance between an arc and anything in the box; 0 of a line */
double fw_geometry_segment_clear_of(const fw_geometry_segment *s, const fw_geometry_box *box);
/* turn at the corner where `before` ends and `after` begins, > 0 to the left (convex) */
double fw_geometry_corner_turn(const fw_geometry_segment *before, const fw_geometry_segment *after);
/* closed, joined bit for bit, finite, every segment well formed */
bool fw_geometry_contour_valid(const fw_geometry_contour *contour);

/* Private to geometry/: the pieces into which the outlines of two regions are cut. */

typedef struct fw_geometry_cut { /* segment number, where on it, which node */
    int segment, node;
    double t;
} fw_geometry_cut;

typedef struct fw_geometry_edge { /* part t0..t1 of a segment between two nodes */
    int segment, rank;            /* rank: the how-manieth part of its segment */
    int owner;                    /* 0 = p, 1 = q */
    int from, to;                 /* nodes */
    double t0, t1;
    bool reversed, keep, used;
    int twin; /* edge of the other region on the same path, or -1 */
} fw_geometry_edge;

typedef struct fw_geometry_graph {
    fw_arena *arena;
    const fw_geometry_segment **segment; /* (nsegment) of p, then of q */
    fw_geometry_vec2 *node;              /* (nnode) */
    int *same;        /* (nnode) an earlier node that it is one with, or itself */
    int *head, *next; /* (heads), (nnode) chains of nodes by the square of 1 nm they lie in; -1 */
    unsigned heads;   /* a power of two */
    fw_geometry_cut *cut;                     /* (ncut) */
    fw_geometry_edge *edge;                   /* (nedge) */
    int nsegment, nfirst, nnode, ncut, nedge; /* nfirst: segments of p */
    int node_room, cut_room;
    fw_geometry_box *own;   /* (nsegment) of each segment */
    fw_geometry_box box[2]; /* of p, of q */
    fw_geometry_vec2 asked; /* the last place that a node was asked for, */
    int answer;             /* and which it was */
} fw_geometry_graph;

/* an edge as a segment of its own, in its running direction */
fw_geometry_segment fw_geometry_edge_segment(const fw_geometry_graph *graph,
                                             const fw_geometry_edge *edge);
/* kept edges to closed outlines, each visiting a node at most once */
fw_status fw_geometry_graph_stitch(fw_geometry_graph *graph, fw_geometry_region *out);

#endif
