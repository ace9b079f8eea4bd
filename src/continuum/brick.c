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
