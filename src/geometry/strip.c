/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/contour.h"
#include "geometry/segment.h"

enum { SAMPLES = 64 };

static double sinc(double x) {
    return fabs(x) < 1e-4 ? 1 - x * x / 6 : sin(x) / x;
}

fw_geometry_pose fw_geometry_strip_along(fw_geometry_pose p, double curvature_per_m, double s_m) {
    double half = 0.5 * curvature_per_m * s_m, chord = s_m * sinc(half);
    return (fw_geometry_pose){p.x_m + chord * cos(p.angle_rad + half),
                              p.y_m + chord * sin(p.angle_rad + half), p.angle_rad + 2 * half};
}

fw_geometry_pose fw_geometry_strip_end(const fw_geometry_strip_piece *piece, int n,
                                       fw_geometry_pose at) {
    for (int i = 0; i < n; i++)
        at = fw_geometry_strip_along(at, piece[i].curvature_per_m, piece[i].length_m);
    return at;
}

double fw_geometry_strip_length(const fw_geometry_strip_piece *piece, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += piece[i].length_m;
    return sum;
}

void fw_geometry_strip_turned(const fw_geometry_strip_piece *piece, int n,
                              fw_geometry_strip_piece *out) {
    for (int i = 0; i < n; i++) { /* reversing and mirroring both turn the sign of the curvature */
        const fw_geometry_strip_piece *p = &piece[n - 1 - i];
        out[i] = (fw_geometry_strip_piece){
            p->length_m, p->curvature_per_m, {p->width_m[2], p->width_m[1], p->width_m[0]}};
    }
}

static fw_geometry_vec2 place(fw_geometry_pose p, double left_m) {
    return (fw_geometry_vec2){p.x_m - left_m * sin(p.angle_rad), p.y_m + left_m * cos(p.angle_rad)};
}

/* Circle through a, b, c:
     centre = b + (|c-b|^2 (a-b) - |a-b|^2 (c-b)) rotated a quarter turn / (2 (a-b) x (c-b))
   or the line through a and c where b is nearer to it than 1e-13 m. In, out: m. Exact; the centre
   loses R/t digits of 16, the distance of the edge from b none.
   Source: elementary; docs/theory/flexure-path.md. Test: test_strip.c. */
static void through(fw_geometry_vec2 a, fw_geometry_vec2 b, fw_geometry_vec2 c,
                    fw_geometry_strip_side *out) {
    fw_geometry_vec2 u = vec_sub(a, b), v = vec_sub(c, b), ac = vec_sub(c, a);
    double cross = vec_cross(u, v), uu = vec_dot(u, u), vv = vec_dot(v, v);
    *out = (fw_geometry_strip_side){.a = a, .along = vec_unit(ac)};
    out->line = !(fabs(cross) > 1e-13 * vec_length(ac));
    if (out->line) return;
    fw_geometry_vec2 d = vec_sub(vec_scale(vv, u), vec_scale(uu, v));
    out->centre = vec_along(b, 0.5 / cross, vec_left(d));
    out->radius_m = vec_distance(b, out->centre);
    fw_geometry_vec2 p = vec_sub(a, out->centre), q = vec_sub(b, out->centre),
                     r = vec_sub(c, out->centre);
    out->sweep_rad = fw_geometry_vec_angle(p, q) + fw_geometry_vec_angle(q, r);
}

void fw_geometry_strip_shape_of(const fw_geometry_strip_piece *p, fw_geometry_strip_shape *out) {
    const double *w = p->width_m, k = p->curvature_per_m, L = p->length_m;
    *out = (fw_geometry_strip_shape){.piece = *p, .uniform = w[0] == w[1] && w[1] == w[2]};
    for (int side = 0; side < 2; side++) {
        double sign = side ? -0.5 : 0.5;
        fw_geometry_strip_side *e = &out->side[side];
        if (out->uniform && k != 0) {
            *e = (fw_geometry_strip_side){.concentric = true,
                                          .centre = {0, 1 / k},
                                          .radius_m = fabs(1 / k - sign * w[0]),
                                          .sweep_rad = k * L};
            continue;
        }
        fw_geometry_vec2 at[3];
        for (int i = 0; i < 3; i++)
            at[i] =
                place(fw_geometry_strip_along((fw_geometry_pose){0}, k, 0.5 * i * L), sign * w[i]);
        through(at[0], at[1], at[2], e);
    }
}

/* along the left normal n of the centre line at P: u with P + u n on the edge; of two, the one
   nearer to what the parabola through the stated widths says. |P + u n - C| = R */
static double edge_at(const fw_geometry_strip_shape *f, int side, double s_m) {
    const fw_geometry_strip_piece *p = &f->piece;
    const fw_geometry_strip_side *e = &f->side[side];
    const double *w = p->width_m, sign = side ? -0.5 : 0.5;
    if (f->uniform) return sign * w[0];
    double z = s_m / p->length_m;
    double near = sign * (w[0] + z * (w[2] - w[0]) - 2 * z * (1 - z) * (w[0] - 2 * w[1] + w[2]));
    fw_geometry_pose at = fw_geometry_strip_along((fw_geometry_pose){0}, p->curvature_per_m, s_m);
    fw_geometry_vec2 n = {-sin(at.angle_rad), cos(at.angle_rad)}, P = {at.x_m, at.y_m};
    if (e->line) return -vec_cross(vec_sub(P, e->a), e->along) / vec_cross(n, e->along);
    fw_geometry_vec2 q = vec_sub(P, e->centre);
    double b = vec_dot(q, n), length = vec_length(q);
    double in = b * b - (length - e->radius_m) * (length + e->radius_m);
    if (!(in >= 0)) return (double)NAN;
    double root = sqrt(in);
    return fabs(-b + root - near) < fabs(-b - root - near) ? -b + root : -b - root;
}

double fw_geometry_strip_width(const fw_geometry_strip_shape *f, double s_m) {
    return f->uniform ? f->piece.width_m[0] : edge_at(f, 0, s_m) - edge_at(f, 1, s_m);
}

double fw_geometry_strip_aside(const fw_geometry_strip_shape *f, double s_m) {
    return f->uniform ? 0 : 0.5 * (edge_at(f, 0, s_m) + edge_at(f, 1, s_m));
}

fw_geometry_segment fw_geometry_strip_edge(const fw_geometry_strip_shape *f, fw_geometry_pose start,
                                           int side) {
    const fw_geometry_strip_piece *p = &f->piece;
    const fw_geometry_strip_side *e = &f->side[side];
    double sign = side ? -0.5 : 0.5;
    fw_geometry_pose end = fw_geometry_strip_along(start, p->curvature_per_m, p->length_m);
    fw_geometry_segment s = {.kind = e->line ? FW_LINE : FW_ARC,
                             .a = place(start, sign * p->width_m[0]),
                             .b = place(end, sign * p->width_m[2])};
    if (e->line) return s;
    fw_geometry_vec2 c = fw_geometry_vec_rotate(e->centre, start.angle_rad);
    s.centre = (fw_geometry_vec2){start.x_m + c.x, start.y_m + c.y};
    s.radius = e->radius_m;
    s.sweep_rad = e->sweep_rad;
    return s;
}

void fw_geometry_strip_widths(const fw_geometry_strip_shape *f, double *least_m, double *most_m) {
    *least_m = *most_m = f->piece.width_m[0];
    for (int i = 0; i <= SAMPLES; i++) {
        double w = fw_geometry_strip_width(f, f->piece.length_m * i / SAMPLES);
        if (!(w < 0) && !(w >= 0)) {
            *least_m = *most_m = w;
            return;
        }
        *least_m = fmin(*least_m, w), *most_m = fmax(*most_m, w);
    }
}

/* a hit that is the joint of two neighbours: where the earlier ends and the later begins */
static bool is_joint(const fw_geometry_hit *hit, const fw_geometry_segment *before,
                     const fw_geometry_segment *after) {
    return vec_distance(hit->at, before->b) < 1e-10 && vec_distance(hit->at, after->a) < 1e-10;
}

static bool meet(const fw_geometry_segment *before, const fw_geometry_segment *after,
                 bool neighbours) {
    fw_geometry_hit hit[FW_MOST_HITS];
    int n = fw_geometry_segment_intersect(before, after, hit);
    for (int i = 0; i < n; i++)
        if (!neighbours || !is_joint(&hit[i], before, after)) return true;
    return false;
}

bool fw_geometry_strip_crosses(const fw_geometry_strip_piece *piece, int n, int *i, int *j) {
    fw_geometry_segment edge[FW_STRIP_MOST][2];
    fw_geometry_pose at = {0};
    n = n < FW_STRIP_MOST ? n : FW_STRIP_MOST;
    for (int k = 0; k < n; k++) {
        fw_geometry_strip_shape f;
        fw_geometry_strip_shape_of(&piece[k], &f);
        for (int side = 0; side < 2; side++)
            edge[k][side] = fw_geometry_strip_edge(&f, at, side);
        at = fw_geometry_strip_along(at, piece[k].curvature_per_m, piece[k].length_m);
    }
    for (*i = 0; *i < n; (*i)++)
        for (*j = *i; *j < n; (*j)++)
            for (int k = 0; k < 4; k++) {
                int left = k & 1, right = k >> 1;
                if (*i == *j && left >= right) continue;
                bool joint = *j == *i + 1 && left == right;
                if (meet(&edge[*i][left], &edge[*j][right], joint)) return true;
            }
    return false;
}
