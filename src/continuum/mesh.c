/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a flexure (its centre line of lines and arcs, edges, fillets and blocks) and its mesh of bricks. */
#include "continuum/solver.h"
#include "base/constants.h"
#include <math.h>

/* ---- the profile ---- */

/* on the centre line: point, unit tangent; left normal (-ty, tx) */
typedef struct centre_frame {
    double x, y, tx, ty;
} centre_frame;

/* seen along the way out of the strip into the block */
typedef struct root_fillet {
    double before_m; /* of its start from the root, along the centre line */
    fw_geometry_vec2 centre;
    double from_rad, sweep_rad; /* from the edge of the strip to the face of the root */
} root_fillet;

typedef struct profile {
    const fw_continuum_shape *shape;
    double length_m, s0_m[FW_CONTINUUM_PIECES]; /* where each piece starts */
    centre_frame start[FW_CONTINUUM_PIECES];
    root_fillet fillet[2][2]; /* [end][side: 0 right, 1 left of the way out] */
} profile;

/* a point of an edge and the unit normal there, into the material */
typedef struct edge_point {
    fw_geometry_vec2 p, n;
} edge_point;

/* frame at arc length s; beyond the ends the last piece goes on */
static centre_frame frame_at(const profile *p, double s_m) {
    int i = 0;
    while (i + 1 < p->shape->npiece && s_m >= p->s0_m[i + 1])
        i++;
    centre_frame f = p->start[i];
    double ds = s_m - p->s0_m[i], turn = p->shape->piece[i].curvature_per_m * ds;
    /* chord of an arc: ds sinc(turn/2) at half the turn */
    double half = 0.5 * turn, chord = fabs(half) < 1e-9 ? ds : ds * sin(half) / half;
    double c = cos(half), s = sin(half);
    centre_frame g = {.x = f.x + chord * (f.tx * c - f.ty * s),
                      .y = f.y + chord * (f.ty * c + f.tx * s)};
    g.tx = f.tx * cos(turn) - f.ty * sin(turn);
    g.ty = f.ty * cos(turn) + f.tx * sin(turn);
    return g;
}

/* outward-looking frame at distance `before` inside end 0 or 1 (< 0: in the block) */
static centre_frame frame_outwards(const profile *p, int end, double before_m) {
    centre_frame f = frame_at(p, end ? p->length_m - before_m : before_m);
    if (!end) f.tx = -f.tx, f.ty = -f.ty;
    return f;
}

static fw_geometry_vec2 offset_from(centre_frame f, double n_m) {
    return (fw_geometry_vec2){f.x - n_m * f.ty, f.y + n_m * f.tx};
}

static double end_curvature(const profile *p, int end) {
    return end ? p->shape->piece[p->shape->npiece - 1].curvature_per_m
               : -p->shape->piece[0].curvature_per_m;
}

/* Fillet of radius rho tangent to the edge at n = +-t/2 and to the straight face of the root. Its
   centre lies at n_c = +-(t/2 + rho) and rho before the face; on a centre line of curvature k the
   circle about the arc's centre through it has radius |1/k - n_c|, so that it is
   asin(rho/|1/k - n_c|)/|k| before the root along the centre line.
   in: profile with lines placed; out: fillet; false: it does not fit inside the curve */
static bool fillet_at(const profile *p, int end, int side, root_fillet *fillet) {
    const fw_continuum_shape *shape = p->shape;
    double rho = shape->fillet_m, k = end_curvature(p, end), sign = side ? 1.0 : -1.0;
    double nc = sign * (0.5 * shape->width_m + rho);
    fillet->before_m = rho;
    if (k != 0.0) {
        double q = (1.0 / k - nc) * (k > 0.0 ? 1.0 : -1.0);
        if (!(q > 1.000001 * rho)) return false;
        fillet->before_m = asin(rho / q) / fabs(k);
    }
    double last = shape->piece[end ? shape->npiece - 1 : 0].length_m;
    if (!(fillet->before_m < last)) return false;
    centre_frame f = frame_outwards(p, end, fillet->before_m);
    fillet->centre = offset_from(f, nc);
    fillet->from_rad = atan2(-sign * f.tx, sign * f.ty);
    fillet->sweep_rad = sign * 0.5 * FW_PI + k * fillet->before_m;
    return true;
}

static fw_status build_profile(const fw_continuum_shape *shape, profile *p, const char **why) {
    *p = (profile){.shape = shape};
    *why = "the centre line has no piece";
    if (shape->npiece < 1 || shape->npiece > FW_CONTINUUM_PIECES) return FW_GEOMETRY;
    p->start[0] = (centre_frame){shape->x_m, shape->y_m, cos(shape->direction_rad),
                                 sin(shape->direction_rad)};
    for (int i = 0; i < shape->npiece; i++) {
        const fw_continuum_piece *piece = &shape->piece[i];
        *why = "a piece of the centre line has no length or is curved more tightly than its width";
        if (!(piece->length_m > 0.0 && isfinite(piece->length_m) &&
              fabs(piece->curvature_per_m) * shape->width_m < 1.8))
            return FW_GEOMETRY;
        if (i > 0) {
            p->s0_m[i] = p->length_m;
            p->start[i] = (centre_frame){0};
            profile before = *p;
            fw_continuum_shape cut = *shape;
            cut.npiece = i;
            before.shape = &cut;
            p->start[i] = frame_at(&before, p->length_m);
        }
        p->length_m += piece->length_m;
    }
    *why = "width or depth is not positive";
    if (!(shape->width_m > 0.0 && shape->depth_m > 0.0)) return FW_GEOMETRY;
    if (shape->root == FW_ROOT_RIGID) return FW_OK;
    *why = "the fillets leave no strip between them, or do not fit inside the curve";
    for (int end = 0; end < 2; end++)
        for (int side = 0; side < 2; side++)
            if (!(shape->fillet_m > 0.0) || !fillet_at(p, end, side, &p->fillet[end][side]))
                return FW_GEOMETRY;
    for (int side = 0; side < 2; side++)
        if (!(p->fillet[0][!side].before_m + p->fillet[1][side].before_m <
              p->length_m - 0.5 * shape->width_m))
            return FW_GEOMETRY;
    *why = "the root block is not larger than the strip with its fillets";
    double least = 0.5 * shape->width_m + shape->fillet_m;
    double k = fmax(fabs(end_curvature(p, 0)), fabs(end_curvature(p, 1)));
    if (!(shape->block_half_m > 1.2 * least && shape->block_length_m > 1.2 * least &&
          k * shape->block_half_m < 0.95 && k * shape->block_length_m < FW_PI))
        return FW_GEOMETRY;
    return FW_OK;
}

/* at `side` (0 right, 1 left of the way from first to second root), u in [0, 1] along the strip
   between its fillets, or along a fillet from the strip to the face */
static edge_point strip_edge(const profile *p, int side, double u) {
    double a = 0.0, b = p->length_m, sign = side ? 1.0 : -1.0;
    if (p->shape->root == FW_ROOT_BLOCK) {
        a = p->fillet[0][!side].before_m;
        b = p->length_m - p->fillet[1][side].before_m;
    }
    centre_frame f = frame_at(p, a + u * (b - a));
    return (edge_point){offset_from(f, sign * 0.5 * p->shape->width_m),
                        {sign * f.ty, -sign * f.tx}};
}

static edge_point fillet_edge(const profile *p, int end, int side, double u) {
    const root_fillet *fillet = &p->fillet[end][end ? side : !side];
    double at = fillet->from_rad + u * fillet->sweep_rad, c = cos(at), s = sin(at);
    return (edge_point){
        {fillet->centre.x + p->shape->fillet_m * c, fillet->centre.y + p->shape->fillet_m * s},
        {c, s}};
}

/* outer boundary of the block from the right to the left of the way out, v in [0, 1]: the first
   `corner` and the last belong to the sides */
static fw_geometry_vec2 block_edge(const profile *p, int end, double corner, double v) {
    double half = p->shape->block_half_m, length = p->shape->block_length_m;
    double deep = length, n;
    if (v < corner) {
        n = -half, deep = length * v / corner;
    } else if (v > 1.0 - corner) {
        n = half, deep = length * (1.0 - v) / corner;
    } else {
        n = half * (2.0 * (v - corner) / (1.0 - 2.0 * corner) - 1.0);
    }
    return offset_from(frame_outwards(p, end, -deep), n);
}

/* from the end of the strip's edge around fillet, face, block and back, on the way out at `end`,
   counter-clockwise: right side of the way out first */
static void round_block(fw_geometry_outline *o, const profile *p, int end) {
    const fw_continuum_shape *s = p->shape;
    const root_fillet *right = &p->fillet[end][0], *left = &p->fillet[end][1];
    double k = end ? s->piece[s->npiece - 1].curvature_per_m : -s->piece[0].curvature_per_m;
    double half = s->block_half_m, length = s->block_length_m;
    centre_frame near = frame_outwards(p, end, 0.0), far = frame_outwards(p, end, -length);
    fw_geometry_vec2 centre = k != 0.0 ? offset_from(near, 1.0 / k) : (fw_geometry_vec2){0.0, 0.0};
    fw_geometry_outline_arc(o, right->centre, right->sweep_rad, 0);
    fw_geometry_outline_line(o, offset_from(near, -half), 0);
    if (k != 0.0)
        fw_geometry_outline_arc_to(o, centre, k * length, offset_from(far, -half), 0);
    else
        fw_geometry_outline_line(o, offset_from(far, -half), 0);
    fw_geometry_outline_line(o, offset_from(far, half), 0);
    if (k != 0.0)
        fw_geometry_outline_arc_to(o, centre, -k * length, offset_from(near, half), 0);
    else
        fw_geometry_outline_line(o, offset_from(near, half), 0);
    centre_frame f = frame_outwards(p, end, left->before_m);
    double last = left->from_rad + left->sweep_rad;
    fw_geometry_outline_line(o,
                             (fw_geometry_vec2){left->centre.x + s->fillet_m * cos(last),
                                                left->centre.y + s->fillet_m * sin(last)},
                             0);
    fw_geometry_outline_arc_to(o, left->centre, -left->sweep_rad, offset_from(f, 0.5 * s->width_m),
                               0);
}

/* an edge of the strip, `side` of the way from first to second root, forwards or back */
static void along(fw_geometry_outline *o, const profile *p, int side, bool forwards) {
    const fw_continuum_shape *s = p->shape;
    double a = 0.0, b = p->length_m, n = (side ? 0.5 : -0.5) * s->width_m;
    if (s->root == FW_ROOT_BLOCK)
        a = p->fillet[0][!side].before_m, b -= p->fillet[1][side].before_m;
    for (int step = 0; step < s->npiece; step++) {
        int i = forwards ? step : s->npiece - 1 - step;
        double from = fmax(a, p->s0_m[i]), k = s->piece[i].curvature_per_m;
        double to = fmin(b, p->s0_m[i] + s->piece[i].length_m);
        fw_geometry_vec2 target = offset_from(frame_at(p, forwards ? to : from), n);
        if (k == 0.0)
            fw_geometry_outline_line(o, target, 0);
        else
            fw_geometry_outline_arc_to(o, offset_from(p->start[i], 1.0 / k),
                                       (forwards ? k : -k) * (to - from), target, 0);
    }
}

fw_status fw_continuum_outline(fw_arena *arena, const fw_continuum_shape *shape,
                               fw_geometry_contour *contour, const char **why) {
    profile p;
    FW_TRY(build_profile(shape, &p, why));
    *why = "the outline does not close";
    bool block = shape->root == FW_ROOT_BLOCK;
    fw_geometry_outline o = fw_geometry_outline_start(arena, strip_edge(&p, 0, 0.0).p);
    along(&o, &p, 0, true);
    if (block)
        round_block(&o, &p, 1);
    else
        fw_geometry_outline_line(&o, strip_edge(&p, 1, 1.0).p, 0);
    along(&o, &p, 1, false);
    if (block) round_block(&o, &p, 0);
    return fw_geometry_outline_close(&o, contour);
}

/* ---- the 20-node brick: node order, shape functions' derivatives, and what they say about a mesh ---- */

const signed char fw_continuum_brick[20][3] = {
    {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
    {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
    {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};

/* derivatives by g, h, r in [-1, 1]^3 of the serendipity function of node a (Zienkiewicz and
   Taylor, The Finite Element Method, 5th ed., vol. 1, section 8.11) */
static void derivatives(int a, const double at[3], double d[3]) {
    double c[3], f[3];
    int middle = -1;
    for (int m = 0; m < 3; m++) {
        c[m] = fw_continuum_brick[a][m] - 1.0;
        if (fw_continuum_brick[a][m] == 1) middle = m;
        f[m] = 1.0 + c[m] * at[m];
    }
    if (middle >= 0) f[middle] = 1.0 - at[middle] * at[middle];
    double scale = middle >= 0 ? 0.25 : 0.125;
    double sum = c[0] * at[0] + c[1] * at[1] + c[2] * at[2] - 2.0;
    for (int m = 0; m < 3; m++) {
        double others = f[(m + 1) % 3] * f[(m + 2) % 3];
        if (middle >= 0)
            d[m] = scale * others * (m == middle ? -2.0 * at[m] : c[m]);
        else
            d[m] = scale * others * c[m] * (sum + f[m]);
    }
}

/* at the middle of the height of a brick of the lowest layer */
static double jacobian(const fw_continuum_mesh *mesh, int i, int j, const double at[3]) {
    double m[3][3] = {{0.0}};
    for (int a = 0; a < 20; a++) {
        const signed char *o = fw_continuum_brick[a];
        size_t flat = (size_t)(2 * i + o[0]) * (size_t)(2 * mesh->nj + 1) + (size_t)(2 * j + o[1]);
        double p[3] = {mesh->x[flat], mesh->y[flat], mesh->z[o[2]]}, d[3];
        derivatives(a, at, d);
        for (int r = 0; r < 3; r++)
            for (int s = 0; s < 3; s++)
                m[r][s] += d[r] * p[s];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* V = sum of det J over 3 x 3 Gauss points (exact: det J of 8-node quadrilaterals is of degree 5 at
   most in each coordinate); det J also at the corners. The layers are the same profile: what a
   brick interpolates does not depend on the height, so one layer says it for all.
   cost: 25 points a quadrilateral; test_mesh.c */
fw_continuum_quality fw_continuum_mesh_quality(const fw_continuum_mesh *mesh) {
    const double g = sqrt(0.6), at[5] = {-g, 0.0, g, -1.0, 1.0};
    const double weight[5] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0, 0.0, 0.0};
    double layers = (mesh->z[2 * mesh->nk] - mesh->z[0]) / (mesh->z[2] - mesh->z[0]);
    fw_continuum_quality q = {.least_jacobian = 1.0};
    for (int i = 0; i < mesh->ni; i++)
        for (int j = 0; j < mesh->nj; j++) {
            double least = (double)INFINITY, most = 0.0;
            for (int n = 0; n < 25; n++) {
                int a = n % 5, b = n / 5;
                double det = jacobian(mesh, i, j, (double[3]){at[a], at[b], 0.0});
                q.volume_m3 += 2.0 * layers * weight[a] * weight[b] * det;
                least = fmin(least, det), most = fmax(most, fabs(det));
            }
            q.least_jacobian = fmin(q.least_jacobian, least / most);
        }
    return q;
}

/* ---- the mapped mesh ---- */

/* Lines across start and end square to the edges: straight in the strip, through the
   fillets they bow until a half circle stands on the face of the root, from where the lattice runs
   out radially to the outline of the block. One lattice, hence no gaps. docs/theory/continuum.md */

enum { MOST = 400 }; /* stations in one direction */

typedef enum part { PART_BLOCK, PART_FILLET, PART_STRIP } part;
typedef struct station { /* of the lattice's first direction */
    part part;
    int end;
    double u; /* strip: along it; fillet: from strip to face; block: from the face outwards */
} station;

typedef struct plan { /* element counts and their spacing */
    fw_continuum_finer more;
    int block, fillet, strip, across, corner, layers;
    double at_strip[MOST + 1], at_block[MOST + 1], at_across[MOST + 1], at_depth[MOST + 1];
} plan;

static int count_of(double wanted, int least) {
    int n = (int)floor(wanted + 0.5);
    return n < least ? least : n > MOST ? MOST : n;
}

/* n intervals of [0, 1], each `ratio` times the one before */
static void graded(double *at, int n, double ratio) {
    double sum = 0.0, step = 1.0;
    for (int i = 0; i < n; i++, step *= ratio)
        sum += step;
    at[0] = 0.0, step = 1.0 / sum;
    for (int i = 1; i <= n; i++, step *= ratio)
        at[i] = at[i - 1] + step;
    at[n] = 1.0;
}

/* ratio for which the first of n intervals is `first` of the whole; within [1/4, 4] */
static double ratio_for(int n, double first) {
    double low = 0.25, high = 4.0;
    for (int k = 0; k < 60; k++) {
        double q = 0.5 * (low + high), sum = 0.0, step = 1.0;
        for (int i = 0; i < n; i++, step *= q)
            sum += step;
        if (1.0 / sum > first)
            low = q;
        else
            high = q;
    }
    return 0.5 * (low + high);
}

/* the strip, symmetric: from `first` at both ends growing by half to `most`, then even */
static int strip_stations(double length, double first, double most, double growth, double *at) {
    int n = 0;
    double step = first < most ? first : most, sum = 0.0;
    at[0] = 0.0;
    while (sum + 0.5 * step < 0.5 * length && n < MOST / 2 - 1) {
        sum += step;
        at[++n] = sum;
        step = fmin(step * growth, most);
    }
    for (int i = 0; i <= n; i++)
        at[i] *= 0.5 / sum;
    for (int i = 1; i <= n; i++)
        at[n + i] = 1.0 - at[n - i];
    return 2 * n;
}

static void plan_strip(plan *c, const fw_continuum_shape *s, double length, double f) {
    double curved = 0.0, most = length / (32.0 * f), t = s->width_m;
    for (int i = 0; i < s->npiece; i++)
        curved = fmax(curved, fabs(s->piece[i].curvature_per_m));
    if (curved > 0.0) most = fmin(most, 0.15 / (f * curved));
    double first = s->root == FW_ROOT_BLOCK ? 1.8 * s->fillet_m / c->fillet : 0.3 * t / f;
    c->strip = strip_stations(length, first, most, 1.0 + 0.5 / f, c->at_strip);
}

/* more, and thinner ones at the edges, where the fillet is small against the width */
static void plan_across(plan *c, const fw_continuum_shape *s, double f) {
    double share = s->root == FW_ROOT_BLOCK ? s->fillet_m / s->width_m : 1.0;
    double base = share >= 0.35 ? 3.0 : share >= 0.15 ? 4.0 : 5.0;
    int half = count_of((base + c->more.across) * f, 2);
    double even = 0.5 / half, first = fmin(0.6 * even, 0.16 * share / f), side[MOST + 1];
    graded(side, half, ratio_for(half, 2.0 * first));
    c->across = 2 * half;
    for (int j = 0; j <= half; j++) {
        c->at_across[j] = 0.5 * side[j];
        c->at_across[2 * half - j] = 1.0 - 0.5 * side[j];
    }
    c->corner = 1;
    for (int j = 1; j < half; j++)
        if (fabs(c->at_across[j] - 0.28) < fabs(c->at_across[c->corner] - 0.28)) c->corner = j;
}

/* two layers at least: with one through half the depth the peak strain of a strip as deep as wide
   came out 1.7 % too high (H3: 0.014554 with one, 0.014311 with two, 0.014282 with three) */
static void plan_depth(plan *c, const fw_continuum_shape *s, double f, bool plane_stress) {
    double half = 0.5 * s->depth_m / s->width_m;
    c->layers = plane_stress ? 1 : count_of(((half < 2.0 ? 2.0 : 3.0) + c->more.layers) * f, 2);
    graded(c->at_depth, c->layers, c->layers > 1 ? pow(0.5, 1.0 / (c->layers - 1)) : 1.0);
}

static void make_plan(plan *c, const profile *p, double f, bool plane_stress,
                      fw_continuum_finer more) {
    const fw_continuum_shape *s = p->shape;
    *c = (plan){.more = more};
    if (s->root == FW_ROOT_BLOCK) {
        double radius = 0.5 * s->width_m + s->fillet_m;
        double reach = fmin(s->block_half_m, s->block_length_m) - radius;
        c->fillet = count_of((8.0 + c->more.fillet) * f, 2);
        double first = 1.3 * s->fillet_m / c->fillet * 1.5;
        c->block = count_of((3.0 + 1.2 * log(fmax(1.0, reach / (4.0 * first)))) * f, 3);
        graded(c->at_block, c->block, ratio_for(c->block, fmin(0.5, first / reach)));
    }
    plan_strip(c, s, p->length_m, f);
    plan_across(c, s, f);
    plan_depth(c, s, f, plane_stress);
}

static double halfway(const double *at, int half_step) {
    return half_step & 1 ? 0.5 * (at[half_step / 2] + at[half_step / 2 + 1]) : at[half_step / 2];
}

static station station_at(const plan *c, int i) {
    int block = 2 * c->block, fillet = 2 * c->fillet, strip = 2 * c->strip;
    if (i < block) return (station){PART_BLOCK, 0, halfway(c->at_block, block - i)};
    i -= block;
    if (i < fillet) return (station){PART_FILLET, 0, 1.0 - 0.5 * i / c->fillet};
    i -= fillet;
    if (i <= strip) return (station){PART_STRIP, 0, halfway(c->at_strip, i)};
    i -= strip;
    if (i <= fillet) return (station){PART_FILLET, 1, 0.5 * i / c->fillet};
    return (station){PART_BLOCK, 1, halfway(c->at_block, i - fillet)};
}

/* Cubic that leaves both edges square. For a circular arc through a turn of 2 A with chord c the
   handles of the usual approximation are c/(3 cos^2(A/2)); error below 2 % of c at A = 90 degrees,
   which only places inner nodes. */
static fw_geometry_vec2 across(edge_point right, edge_point left, double v) {
    fw_geometry_vec2 p = right.p, q = left.p;
    double chord = hypot(q.x - p.x, q.y - p.y);
    double cosine = -(right.n.x * left.n.x + right.n.y * left.n.y); /* of 2 A */
    double half = sqrt(fmax(0.0, 0.5 * (1.0 + cosine)));            /* cos A */
    double h = chord / (1.5 * (1.0 + half)), w = 1.0 - v;
    double b0 = w * w * w, b1 = 3.0 * v * w * w, b2 = 3.0 * v * v * w, b3 = v * v * v;
    return (fw_geometry_vec2){
        b0 * p.x + b1 * (p.x + h * right.n.x) + b2 * (q.x + h * left.n.x) + b3 * q.x,
        b0 * p.y + b1 * (p.y + h * right.n.y) + b2 * (q.y + h * left.n.y) + b3 * q.y};
}

static fw_geometry_vec2 place(const profile *p, const plan *c, int i, int j) {
    station s = station_at(c, i);
    double v = halfway(c->at_across, j);
    if (s.part == PART_STRIP) return across(strip_edge(p, 0, s.u), strip_edge(p, 1, s.u), v);
    double u = s.part == PART_FILLET ? s.u : 1.0;
    fw_geometry_vec2 in = across(fillet_edge(p, s.end, 0, u), fillet_edge(p, s.end, 1, u), v);
    if (s.part == PART_FILLET) return in;
    double corner = c->at_across[c->corner];
    fw_geometry_vec2 out = block_edge(p, s.end, corner, s.end ? v : 1.0 - v);
    return (fw_geometry_vec2){in.x + s.u * (out.x - in.x), in.y + s.u * (out.y - in.y)};
}

size_t fw_continuum_lattice(const fw_continuum_mesh *mesh, int i, int j, int k) {
    size_t across_n = (size_t)(2 * mesh->nj + 1), up = (size_t)(2 * mesh->nk + 1);
    return ((size_t)i * across_n + (size_t)j) * up + (size_t)k;
}

bool fw_continuum_rigid(const fw_continuum_mesh *mesh, int end, int i, int j) {
    return i == (end ? 2 * mesh->ni : 0) && j >= 2 * mesh->corner &&
           j <= 2 * (mesh->nj - mesh->corner);
}

static void number_nodes(fw_continuum_mesh *mesh) {
    int next = 0;
    for (int i = 0; i <= 2 * mesh->ni; i++)
        for (int j = 0; j <= 2 * mesh->nj; j++)
            for (int k = 0; k <= 2 * mesh->nk; k++)
                if ((i & 1) + (j & 1) + (k & 1) <= 1)
                    mesh->number[fw_continuum_lattice(mesh, i, j, k)] = ++next;
    mesh->nnode = next;
    mesh->nelement = mesh->ni * mesh->nj * mesh->nk;
}

/* formula: see the head of this file; in: shape (m), refinement (1), out: mesh
   valid: what build_profile accepts; the caller looks at the quality
   cost: O(nodes); test_mesh.c: volume against the exact outline, Jacobians, fillet radii */
fw_status fw_continuum_mesh_build(fw_arena *arena, const fw_continuum_shape *shape,
                                  double refinement, bool plane_stress, fw_continuum_mesh *mesh,
                                  const char **why) {
    return fw_continuum_mesh_finer(arena, shape, refinement, plane_stress,
                                   (fw_continuum_finer){.fillet = 0}, mesh, why);
}

fw_status fw_continuum_mesh_finer(fw_arena *arena, const fw_continuum_shape *shape,
                                  double refinement, bool plane_stress, fw_continuum_finer more,
                                  fw_continuum_mesh *mesh, const char **why) {
    profile p;
    plan *c;
    *mesh = (fw_continuum_mesh){0};
    FW_TRY(build_profile(shape, &p, why));
    FW_NEED(c = fw_arena_one(arena, plan));
    make_plan(c, &p, refinement, plane_stress, more);
    mesh->ni = c->strip + 2 * (c->fillet + c->block);
    mesh->nj = c->across, mesh->nk = c->layers,
    mesh->corner = c->block && shape->sides_free ? c->corner : 0;
    mesh->quiet = c->block;
    while (!c->block && c->at_strip[mesh->quiet] * p.length_m < shape->width_m)
        mesh->quiet++;
    mesh->depth_m = plane_stress ? 0.05 * shape->width_m : shape->depth_m;
    size_t flat = (size_t)(2 * mesh->ni + 1) * (size_t)(2 * mesh->nj + 1);
    FW_NEED(mesh->x = fw_arena_array(arena, double, flat));
    FW_NEED(mesh->y = fw_arena_array(arena, double, flat));
    FW_NEED(mesh->z = fw_arena_array(arena, double, (size_t)(2 * mesh->nk + 1)));
    FW_NEED(mesh->number = fw_arena_array(arena, int, flat *(size_t)(2 * mesh->nk + 1)));
    for (int i = 0; i <= 2 * mesh->ni; i++)
        for (int j = 0; j <= 2 * mesh->nj; j++) {
            fw_geometry_vec2 at = place(&p, c, i, j);
            size_t n = (size_t)i * (size_t)(2 * mesh->nj + 1) + (size_t)j;
            mesh->x[n] = at.x, mesh->y[n] = at.y;
        }
    for (int k = 0; k <= 2 * mesh->nk; k++)
        mesh->z[k] = 0.5 * mesh->depth_m * halfway(c->at_depth, k);
    number_nodes(mesh);
    return FW_OK;
}
