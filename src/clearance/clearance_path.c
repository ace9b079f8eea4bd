/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion as Bernstein polynomials, piece by piece: the coefficients of a polynomial over a part of
   its piece hold its values there between the least and the largest of them. */
#include "clearance/clearance.h"
#include <math.h>
#include <string.h>

enum { NODES = FW_CLEARANCE_NODES, MOST_BYTES = 6 << 20, LEAST_PIECES = 16, MOST_PIECES = 8192 };

fw_status fw_clearance_path_new(fw_arena *arena, int nbody, fw_clearance_path *path) {
    size_t each = (size_t)(3 * nbody) * NODES * sizeof(double), room = MOST_BYTES / (each + 1);
    size_t n = room < LEAST_PIECES ? LEAST_PIECES : room > MOST_PIECES ? MOST_PIECES : room;
    return fw_clearance_path_of(arena, nbody, (int)n, path);
}

fw_status fw_clearance_path_of(fw_arena *arena, int nbody, int pieces, fw_clearance_path *path) {
    size_t n = (size_t)pieces, each = (size_t)(3 * nbody) * NODES * sizeof(double);
    *path = (fw_clearance_path){.nq = 3 * nbody, .capacity = pieces};
    FW_NEED(path->start = fw_arena_array(arena, double, (size_t)path->nq));
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
    const double *from = piece->q, *to = piece->q + (size_t)(piece->nodes - 1) * (size_t)path->nq;
    path->njump++;
    for (int q = 0; q + 1 < path->nq; q += 3) {
        double by = hypot(to[q] - from[q], to[q + 1] - from[q + 1]);
        if (by > path->jump_m) path->jump_m = by, path->jump_s = piece->from_s;
    }
}

void fw_clearance_path_add(fw_clearance_path *path, const fw_dynamics_piece *piece) {
    int n = piece->nodes, k = path->npiece;
    if (fw_clearance_path_full(path)) return; /* never: whoever adds looks first */
    if (path->of != n) fit_of(path, n);
    if (!path->begun) memcpy(path->start, piece->q, (size_t)path->nq * sizeof *path->start);
    path->begun = true;
    if (piece->jump) note_jump(path, piece);
    path->nodes[k] = n;
    path->t_s[2 * k] = piece->from_s;
    path->t_s[2 * k + 1] = piece->to_s;
    double *out = path->bern + (size_t)k * (size_t)path->nq * NODES;
    for (int q = 0; q < path->nq; q++, out += NODES) {
        double base = piece->q[q];
        for (int i = 0; i < n; i++) {
            double sum = 0; /* of differences: what the pose itself is rounded to does not count */
            for (int j = 0; j < n; j++)
                sum += path->fit[i][j] * (piece->q[j * path->nq + q] - base);
            out[i] = base + sum;
        }
    }
    path->npiece++;
}

const double *fw_clearance_path_coefficients(const fw_clearance_path *path, int piece, int q) {
    return path->bern + ((size_t)piece * (size_t)path->nq + (size_t)q) * NODES;
}

double fw_clearance_path_value(const fw_clearance_path *path, int piece, int q, double theta) {
    double b[NODES];
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
                            double out[NODES]) {
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
