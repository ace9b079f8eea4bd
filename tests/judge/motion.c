/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "motion.h"

#include <math.h>
#include <string.h>

enum { FREE = 3 * BODIES };

/* Jacobi's rotations on a symmetric matrix; its eigenvalues end on the diagonal. */
static void diagonal(int n, double *a) {
    for (int sweep = 0; sweep < 60; sweep++) {
        double off = 0, on = 0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                *(i == j ? &on : &off) += a[i * n + j] * a[i * n + j];
        if (off < 1e-26 * on) return;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                if (a[p * n + q] == 0) continue;
                double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
                double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
                double c = 1 / sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < n; k++) {
                    double x = a[k * n + p], y = a[k * n + q];
                    a[k * n + p] = c * x - s * y;
                    a[k * n + q] = s * x + c * y;
                }
                for (int k = 0; k < n; k++) {
                    double x = a[p * n + k], y = a[q * n + k];
                    a[p * n + k] = c * x - s * y;
                    a[q * n + k] = s * x + c * y;
                }
            }
    }
}

static double mass(const struct model *model, int i) {
    const struct body *body = &model->body[i / 3 + 1];
    return i % 3 == 2 ? body->inertia : body->mass;
}

void motion_frequencies(struct model *model, double *omega) {
    double k[FREE * FREE];
    statics_stiffness(model, k);
    motion_frequencies_of(model, k, omega);
}

void motion_frequencies_of(struct model *model, double *k, double *omega) {
    int n = 3 * model->bodies;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            double both = (k[i * n + j] + k[j * n + i]) / 2;
            k[i * n + j] = k[j * n + i] = both;
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            k[i * n + j] /= sqrt(mass(model, i) * mass(model, j));
    diagonal(n, k);
    for (int i = 0; i < n; i++)
        omega[i] = sqrt(fmax(0, k[i * n + i]));
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && omega[j] < omega[j - 1]; j--) {
            double t = omega[j];
            omega[j] = omega[j - 1];
            omega[j - 1] = t;
        }
}

/* Accelerations of a pose; the wrenches of the beams are kept as the start of the next search. */
static int accelerate(struct model *model, const double *q, double share, double time, double *p,
                      double *acceleration) {
    double force[3 * (BODIES + 1)] = {0};
    model_loads(model, q, share, time, force);
    for (int i = 0; i < model->flexures; i++) {
        struct flexure *f = &model->flexure[i];
        double from[2], to[2];
        struct shot shot;
        model_root(model, q, f, 0, 0, from);
        model_root(model, q, f, 1, 0, to);
        double angle = f->psi + q[3 * f->a + 2], c = cos(angle), s = sin(angle);
        double dx = to[0] - from[0], dy = to[1] - from[1];
        double where[3] = {q[3 * f->b + 2] - q[3 * f->a + 2], c * dx + s * dy, -s * dx + c * dy};
        if (beam_hold(f, where, p + 3 * i, &shot)) return 1;
        double fx = c * p[3 * i + 1] - s * p[3 * i + 2], fy = s * p[3 * i + 1] + c * p[3 * i + 2];
        if (f->a) {
            double lx = from[0] - model->body[f->a].x - q[3 * f->a],
                   ly = from[1] - model->body[f->a].y - q[3 * f->a + 1];
            force[3 * f->a] += fx;
            force[3 * f->a + 1] += fy;
            force[3 * f->a + 2] += p[3 * i] + lx * fy - ly * fx;
        }
        if (f->b) {
            double lx = to[0] - model->body[f->b].x - q[3 * f->b],
                   ly = to[1] - model->body[f->b].y - q[3 * f->b + 1];
            force[3 * f->b] -= fx;
            force[3 * f->b + 1] -= fy;
            force[3 * f->b + 2] -= shot.moment + lx * fy - ly * fx;
        }
    }
    for (int i = 0; i < 3 * model->bodies; i++)
        acceleration[i] = force[3 + i] / mass(model, i);
    return 0;
}

/* Stresses of a pose, and the tops of parabolas through the last three of each face. */
static void watch(struct model *model, const double *p, double kept[2][FLEXURES][4], int seen,
                  struct answer *out) {
    for (int i = 0; i < model->flexures; i++) {
        struct shot shot;
        beam_shoot(&model->flexure[i], p + 3 * i, 1, &shot);
        if (shot.worst > out->stress[i]) {
            out->stress[i] = shot.worst;
            out->at[i] = shot.at;
        }
        out->roots[i] = fmax(out->roots[i], shot.roots);
        for (int m = 0; m < 4; m++) {
            double a = kept[0][i][m], b = kept[1][i][m], c = shot.signal[m], bend = a - 2 * b + c;
            if (seen > 1 && (b - a) * (c - b) < 0 && bend != 0) {
                double top = fabs(b - (c - a) * (c - a) / (8 * bend));
                if (top > out->stress[i]) {
                    out->stress[i] = top;
                    out->at[i] = m / 2;
                }
                out->roots[i] = fmax(out->roots[i], top);
            }
            kept[0][i][m] = b;
            kept[1][i][m] = c;
        }
        out->most = fmax(out->most, out->stress[i]);
    }
}

int motion_follow(struct model *model, double share, int fineness, double most,
                  struct answer *out) {
    int n = 3 * model->bodies, bad = 0;
    double omega[FREE], q[3 * (BODIES + 1)] = {0}, v[FREE] = {0}, p[3 * FLEXURES] = {0}, time = 0;
    double kept[2][FLEXURES][4] = {{{0}}};
    motion_frequencies(model, omega);
    double h = 2 * acos(-1.0) / omega[n - 1] / fineness;
    if (model->pulse > 0) h = fmin(h, model->pulse / 40);
    long steps = (long)ceil(model->duration / h);
    h = model->duration / (double)steps;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < model->loads; i++)
        if (model->load[i].kind == LOAD_START)
            for (int m = 0; m < 3; m++)
                v[3 * (model->load[i].body - 1) + m] = share * model->load[i].number[m];
    for (long step = 0; step <= steps && !bad; step++) {
        double k[3][FREE], at[3 * (BODIES + 1)] = {0};
        bad = accelerate(model, q, share, time, p, k[0]);
        if (!bad) watch(model, p, kept, (int)(step > 2 ? 2 : step), out);
        if (bad || (most > 0 && out->most > 3 * most)) break;
        for (int i = 0; i < n; i++)
            at[3 + i] = q[3 + i] + h / 2 * v[i] + h * h / 8 * k[0][i];
        bad = accelerate(model, at, share, time + h / 2, p, k[1]);
        for (int i = 0; i < n; i++)
            at[3 + i] = q[3 + i] + h * v[i] + h * h / 2 * k[1][i];
        bad = bad || accelerate(model, at, share, time + h, p, k[2]);
        for (int i = 0; i < n; i++) {
            q[3 + i] += h * v[i] + h * h / 6 * (k[0][i] + 2 * k[1][i]);
            v[i] += h / 6 * (k[0][i] + 4 * k[1][i] + k[2][i]);
        }
        time += h;
    }
    return bad;
}
