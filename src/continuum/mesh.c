/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The 20-node brick: node order, shape functions' derivatives, and what they say about a mesh. */
#include "continuum/mesh.h"
#include <math.h>

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

/* Mapped mesh. Lines across start and end square to the edges: straight in the strip, through the
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

static void make_plan(plan *c, const fw_continuum_profile *p, double f, bool plane_stress,
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
static fw_geometry_vec2 across(fw_continuum_profile_edge right, fw_continuum_profile_edge left,
                               double v) {
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

static fw_geometry_vec2 place(const fw_continuum_profile *p, const plan *c, int i, int j) {
    station s = station_at(c, i);
    double v = halfway(c->at_across, j);
    if (s.part == PART_STRIP)
        return across(fw_continuum_profile_strip_edge(p, 0, s.u),
                      fw_continuum_profile_strip_edge(p, 1, s.u), v);
    double u = s.part == PART_FILLET ? s.u : 1.0;
    fw_geometry_vec2 in = across(fw_continuum_profile_fillet_edge(p, s.end, 0, u),
                                 fw_continuum_profile_fillet_edge(p, s.end, 1, u), v);
    if (s.part == PART_FILLET) return in;
    double corner = c->at_across[c->corner];
    fw_geometry_vec2 out = fw_continuum_profile_block_edge(p, s.end, corner, s.end ? v : 1.0 - v);
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
   valid: what fw_continuum_profile_build accepts; the caller looks at the quality
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
    fw_continuum_profile profile;
    plan *c;
    *mesh = (fw_continuum_mesh){0};
    FW_TRY(fw_continuum_profile_build(shape, &profile, why));
    FW_NEED(c = fw_arena_one(arena, plan));
    make_plan(c, &profile, refinement, plane_stress, more);
    mesh->ni = c->strip + 2 * (c->fillet + c->block);
    mesh->nj = c->across, mesh->nk = c->layers,
    mesh->corner = c->block && shape->sides_free ? c->corner : 0;
    mesh->quiet = c->block;
    while (!c->block && c->at_strip[mesh->quiet] * profile.length_m < shape->width_m)
        mesh->quiet++;
    mesh->depth_m = plane_stress ? 0.05 * shape->width_m : shape->depth_m;
    size_t flat = (size_t)(2 * mesh->ni + 1) * (size_t)(2 * mesh->nj + 1);
    FW_NEED(mesh->x = fw_arena_array(arena, double, flat));
    FW_NEED(mesh->y = fw_arena_array(arena, double, flat));
    FW_NEED(mesh->z = fw_arena_array(arena, double, (size_t)(2 * mesh->nk + 1)));
    FW_NEED(mesh->number = fw_arena_array(arena, int, flat *(size_t)(2 * mesh->nk + 1)));
    for (int i = 0; i <= 2 * mesh->ni; i++)
        for (int j = 0; j <= 2 * mesh->nj; j++) {
            fw_geometry_vec2 at = place(&profile, c, i, j);
            size_t n = (size_t)i * (size_t)(2 * mesh->nj + 1) + (size_t)j;
            mesh->x[n] = at.x, mesh->y[n] = at.y;
        }
    for (int k = 0; k <= 2 * mesh->nk; k++)
        mesh->z[k] = 0.5 * mesh->depth_m * halfway(c->at_depth, k);
    number_nodes(mesh);
    return FW_OK;
}
