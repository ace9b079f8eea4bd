/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "beam.h"

#include <math.h>
#include <string.h>

enum { HELD = 12 }; /* turn, x, y and their nine derivatives by p */

static void rates(const struct flexure *f, const struct place *at, const double p[3],
                  const double u[HELD], double du[HELD]) {
    double bend = at->bend * f->softer, stretch = at->stretch * f->softer,
           shear = at->shear * f->softer;
    double c = cos(at->psi + u[0]), s = sin(at->psi + u[0]);
    double moment = p[0] - u[1] * p[2] + u[2] * p[1];
    double n = p[1] * c + p[2] * s, v = -p[1] * s + p[2] * c;
    double along = 1 + n / stretch, across = v / shear;
    du[0] = moment / bend;
    du[1] = along * c - across * s;
    du[2] = along * s + across * c;
    for (int j = 0; j < 3; j++) {
        const double *w = u + 3 + 3 * j;
        double dm = (j == 0) - w[1] * p[2] + w[2] * p[1];
        double dn = v * w[0], dv = -n * w[0];
        if (j == 1) {
            dm += u[2];
            dn += c;
            dv -= s;
        }
        if (j == 2) {
            dm -= u[1];
            dn += s;
            dv += c;
        }
        double *d = du + 3 + 3 * j;
        d[0] = dm / bend;
        d[1] = dn / stretch * c - dv / shear * s - du[2] * w[0];
        d[2] = dn / stretch * s + dv / shear * c + du[1] * w[0];
    }
}

static void march(const struct flexure *f, const struct span *span, int i, const double p[3],
                  double u[HELD]) {
    const struct place *at = span->place + 2 * i;
    double h = span->step, k[4][HELD], w[HELD];
    rates(f, at, p, u, k[0]);
    for (int m = 0; m < HELD; m++)
        w[m] = u[m] + h / 2 * k[0][m];
    rates(f, at + 1, p, w, k[1]);
    for (int m = 0; m < HELD; m++)
        w[m] = u[m] + h / 2 * k[1][m];
    rates(f, at + 1, p, w, k[2]);
    for (int m = 0; m < HELD; m++)
        w[m] = u[m] + h * k[2][m];
    rates(f, at + 2, p, w, k[3]);
    for (int m = 0; m < HELD; m++)
        u[m] += h / 6 * (k[0][m] + 2 * k[1][m] + 2 * k[2][m] + k[3][m]);
}

static void stress(const struct place *at, const double p[3], const double u[HELD],
                   struct shot *out) {
    double moment = p[0] - u[1] * p[2] + u[2] * p[1];
    double n = p[1] * cos(at->psi + u[0]) + p[2] * sin(at->psi + u[0]);
    double left = fabs(n / at->area - moment * at->left),
           right = fabs(n / at->area + moment * at->right);
    double most = left > right ? left : right;
    if (most > out->worst) {
        out->worst = most;
        out->at = 2;
    }
}

static void root_stress(const struct root *r, int which, double moment, double n,
                        struct shot *out) {
    double left = n * r->tension - moment * r->left, right = n * r->tension + moment * r->right;
    out->signal[2 * which] = left;
    out->signal[2 * which + 1] = right;
    double most = fabs(left) > fabs(right) ? fabs(left) : fabs(right);
    if (most > out->roots) out->roots = most;
    if (most > out->worst) {
        out->worst = most;
        out->at = which;
    }
}

void beam_shoot(const struct flexure *f, const double p[3], int stresses, struct shot *out) {
    double u[HELD] = {0};
    const struct place *last = &f->span[f->spans - 1].place[2 * f->span[f->spans - 1].steps];
    double first = f->root[0].give / f->softer, second = f->root[1].give / f->softer;
    u[0] = first * p[0];
    u[3] = first;
    memset(out, 0, sizeof *out);
    for (int k = 0; k < f->spans; k++) {
        const struct span *span = f->span + k;
        for (int i = 0; i < span->steps; i++) {
            if (stresses) stress(span->place + 2 * i, p, u, out);
            march(f, span, i, p, u);
        }
        if (stresses) stress(span->place + 2 * span->steps, p, u, out);
    }
    out->moment = p[0] - u[1] * p[2] + u[2] * p[1];
    for (int j = 0; j < 3; j++) {
        const double *w = u + 3 + 3 * j;
        out->moment_by[j] =
            (j == 0) + (j == 1) * u[2] - (j == 2) * u[1] - w[1] * p[2] + w[2] * p[1];
        out->by[0][j] = w[0] + second * out->moment_by[j];
        out->by[1][j] = w[1];
        out->by[2][j] = w[2];
    }
    out->turn = u[0] + second * out->moment;
    out->x = u[1];
    out->y = u[2];
    if (stresses) {
        double end = last->psi + u[0];
        double begin = f->span[0].place[0].psi + first * p[0];
        root_stress(&f->root[0], 0, p[0], p[1] * cos(begin) + p[2] * sin(begin), out);
        root_stress(&f->root[1], 1, out->moment, p[1] * cos(end) + p[2] * sin(end), out);
    }
}

int beam_hold(const struct flexure *f, const double where[3], double p[3], struct shot *out) {
    for (int i = 0; i < 30; i++) {
        beam_shoot(f, p, 0, out);
        double a[9], r[3] = {where[0] - out->turn, where[1] - out->x, where[2] - out->y};
        double miss = fabs(r[0]) * 100 + fabs(r[1]) + fabs(r[2]);
        for (int m = 0; m < 9; m++)
            a[m] = out->by[m / 3][m % 3];
        if (!isfinite(miss) || !solve_dense(3, a, r)) return 1;
        for (int m = 0; m < 3; m++) {
            p[m] += r[m];
            out->moment += out->moment_by[m] * r[m];
        }
        if (miss < 1e-5) return 0; /* um: what is left is its square */
    }
    return 1;
}

int solve_dense(int n, double *a, double *b) {
    int sign = 1;
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
        if (!(fabs(a[best * n + k]) > 0)) return 0;
        if (best != k) {
            sign = -sign;
            for (int j = 0; j < n; j++) {
                double t = a[k * n + j];
                a[k * n + j] = a[best * n + j];
                a[best * n + j] = t;
            }
            double t = b[k];
            b[k] = b[best];
            b[best] = t;
        }
        if (a[k * n + k] < 0) sign = -sign;
        for (int i = k + 1; i < n; i++) {
            double q = a[i * n + k] / a[k * n + k];
            if (q == 0) continue;
            for (int j = k; j < n; j++)
                a[i * n + j] -= q * a[k * n + j];
            b[i] -= q * b[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            b[k] -= a[k * n + j] * b[j];
        b[k] /= a[k * n + k];
    }
    return sign;
}
