/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

fw_status fw_multibody_dense_new(fw_arena *arena, int rows, int n,
                                 const fw_multibody_dense_kernel *kernel,
                                 fw_multibody_dense **result) {
    fw_multibody_dense *d;
    size_t r = (size_t)rows, c = (size_t)n;
    FW_NEED(d = fw_arena_one(arena, fw_multibody_dense));
    *d = (fw_multibody_dense){.rows = rows, .n = n, .kernel = kernel};
    d->rank.least = rows;
    d->rank.smallest = (double)INFINITY;
    FW_NEED(d->g = fw_arena_array(arena, double, r *c));
    FW_NEED(d->a = fw_arena_array(arena, double, r *c));
    FW_NEED(d->root = fw_arena_array(arena, double, c));
    FW_NEED(d->w = fw_arena_array(arena, double, c));
    double **of_rows[] = {&d->row, &d->b, &d->lambda, &d->gamma, &d->out};
    for (size_t i = 0; i < sizeof of_rows / sizeof of_rows[0]; i++)
        FW_NEED(*of_rows[i] = fw_arena_array(arena, double, r));
    FW_TRY(fw_maths_lapack_ready());
    if (rows > 0) FW_TRY(kernel->prepare(arena, d));
    *result = d;
    return FW_OK;
}

/* D^-1/2 of a row: its translations in the mass metric, or what turns where nothing else moves.
   Coordinates come in threes x, y, phi. */
static double balance(const fw_multibody_dense *d, const double *g) {
    double shift = 0, turn = 0;
    for (int j = 0; j < d->n; j++) {
        double part = g[j] * d->root[j];
        if (j % 3 == 2)
            turn += part * part;
        else
            shift += part * part;
    }
    double size = shift > 0 ? shift : turn;
    return size > 0 ? 1 / sqrt(size) : 1;
}

bool fw_multibody_dense_factor(fw_multibody_dense *d) {
    double check = 0;
    for (int i = 0; i < d->rows; i++) {
        const double *g = d->g + (size_t)i * (size_t)d->n;
        d->row[i] = balance(d, g);
        for (int j = 0; j < d->n; j++) {
            double value = d->row[i] * g[j] * d->root[j];
            d->a[(size_t)i + (size_t)j * (size_t)d->rows] = value;
            check += 0 * value;
        }
    }
    if (check != 0) return false; /* LAPACK may loop on a NaN */
    return d->rows == 0 || d->kernel->factor(d);
}

void fw_multibody_dense_accelerate(fw_multibody_dense *d, const double *gamma, double *a,
                                   double *lambda) {
    if (d->rows == 0) return;
    for (int i = 0; i < d->rows; i++)
        d->b[i] = -d->row[i] * gamma[i];
    for (int j = 0; j < d->n; j++)
        d->w[j] = a[j] / d->root[j];
    if (!d->kernel->solve(d, d->b, d->w, d->lambda, FW_SWEEPS)) d->w[0] = (double)NAN;
    for (int i = 0; i < d->rows; i++)
        lambda[i] = d->row[i] * d->lambda[i];
    for (int j = 0; j < d->n; j++)
        a[j] = d->w[j] * d->root[j];
}

/* d of least mass norm with G d = -r, one sweep: rows that cannot be met are left alone */
static void correct(fw_multibody_dense *d, const double *r, double *correction) {
    memset(correction, 0, (size_t)d->n * sizeof *correction);
    if (d->rows == 0) return;
    for (int i = 0; i < d->rows; i++)
        d->b[i] = -d->row[i] * r[i];
    memset(d->w, 0, (size_t)d->n * sizeof *d->w);
    if (!d->kernel->solve(d, d->b, d->w, d->lambda, 1)) d->w[0] = (double)NAN;
    for (int j = 0; j < d->n; j++)
        correction[j] = d->w[j] * d->root[j];
}

/* (1 - (eps/(s^2 + eps))^k) / s^2 as a sum of positive terms, so that s = 0 is no special case */
double fw_multibody_dense_share(double s_squared, int sweeps) {
    double inverse = 1 / (s_squared + fw_epsilon), term = inverse, sum = 0;
    for (int j = 0; j < sweeps; j++) {
        sum += term;
        term *= fw_epsilon * inverse;
    }
    return sum;
}

/* s descending, `noise` the round-off of s relative to s[0] */
void fw_multibody_dense_monitor(fw_multibody_dense *d, const double *s, int count, double noise) {
    fw_multibody_rank_monitor *k = &d->rank;
    int rank = 0;
    while (rank < count && s[rank] > noise * s[0])
        rank++;
    int redundant = d->rows - rank;
    k->evaluations++;
    k->least = redundant < k->least ? redundant : k->least;
    k->most = redundant > k->most ? redundant : k->most;
    if (rank == 0) return;
    k->smallest = fmin(k->smallest, s[rank - 1]);
    k->weak += s[rank - 1] < 1e-3;
}

void fw_multibody_dense_times(const fw_multibody_dense *d, const double *w, double *r) {
    memset(r, 0, (size_t)d->rows * sizeof *r);
    for (int j = 0; j < d->n; j++) {
        const double *a = d->a + (size_t)j * (size_t)d->rows;
        for (int i = 0; i < d->rows; i++)
            r[i] += a[i] * w[j];
    }
}

void fw_multibody_dense_subtract_transpose(const fw_multibody_dense *d, const double *lambda,
                                           double *w) {
    for (int j = 0; j < d->n; j++) {
        const double *a = d->a + (size_t)j * (size_t)d->rows;
        double sum = 0;
        for (int i = 0; i < d->rows; i++)
            sum += a[i] * lambda[i];
        w[j] -= sum;
    }
}

double fw_multibody_dense_largest(const double *x, int count) {
    double largest = 0;
    for (int i = 0; i < count; i++)
        largest = fmax(largest, fabs(x[i]));
    return largest;
}

/* (w, lambda) += (dw, dl) with the residuals r1 = w0 - w - A^T lambda, r2 = b - A w formed anew, so
   that the sweeps also refine: at least two, more while a residual exceeds 1e-14 of its terms. */
bool fw_multibody_dense_sweep(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                              int sweeps, double *more, double *start,
                              bool (*step)(fw_multibody_dense *d, double *r1, double *r2)) {
    size_t n = (size_t)d->n, rows = (size_t)d->rows;
    double *r1 = more, *r2 = more + n, size = fw_multibody_dense_largest(w, d->n);
    memcpy(start, w, n * sizeof *w);
    memset(w, 0, n * sizeof *w);
    memset(lambda, 0, rows * sizeof *lambda);
    for (int sweep = 0; sweep < sweeps; sweep++) {
        for (size_t j = 0; j < n; j++)
            r1[j] = start[j] - w[j];
        fw_multibody_dense_subtract_transpose(d, lambda, r1);
        fw_multibody_dense_times(d, w, r2);
        for (size_t i = 0; i < rows; i++)
            r2[i] = b[i] - r2[i];
        double left = fw_multibody_dense_largest(r2, d->rows),
               far = fw_multibody_dense_largest(r1, d->n);
        double scale = fmax(size, fw_multibody_dense_largest(w, d->n));
        if (sweep > 1 && left <= 1e-14 * scale && far <= 1e-14 * scale) return true;
        if (!step(d, r1, r2)) return false;
        for (size_t j = 0; j < n; j++)
            w[j] += r1[j];
        for (size_t i = 0; i < rows; i++)
            lambda[i] += r2[i];
    }
    return true;
}

/* ---- for the model ---- */

fw_status fw_multibody_dense_model_prepare(fw_arena *arena, fw_multibody_system *sys,
                                           const fw_mechanism *mechanism, fw_diags *diags) {
    (void)mechanism, (void)diags;
    const fw_multibody_model *m = sys->model;
    fw_multibody_dense *d;
    FW_TRY(fw_multibody_dense_new(arena, m->rows, m->nq, m->method->kernel, &d));
    for (int b = 0; b < m->nbody; b++) {
        d->root[3 * b] = d->root[3 * b + 1] = sqrt(m->minv[b]);
        d->root[3 * b + 2] = sqrt(m->jinv[b]);
    }
    sys->work->method = d;
    return FW_OK;
}

bool fw_multibody_dense_model_factor(fw_multibody_system *sys, const fw_multibody_pose *pose) {
    fw_multibody_dense *d = sys->work->method;
    fw_multibody_dense_jacobian(sys->model, pose, d->g);
    return fw_multibody_dense_factor(d);
}

void fw_multibody_dense_model_accelerate(fw_multibody_system *sys,
                                         const fw_multibody_factor *factor, const double *gamma,
                                         double *a, double *lambda) {
    fw_multibody_dense *d = sys->work->method;
    (void)factor;
    fw_multibody_pack(sys->model, gamma, d->gamma);
    fw_multibody_dense_accelerate(d, d->gamma, a, d->out);
    fw_multibody_unpack(sys->model, d->out, lambda);
}

void fw_multibody_dense_model_correct(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                      const double *r, double *correction) {
    fw_multibody_dense *d = sys->work->method;
    (void)pose;
    fw_multibody_pack(sys->model, r, d->gamma);
    correct(d, d->gamma, correction);
}

fw_status fw_multibody_dense_model_report(const fw_multibody_system *sys,
                                          const fw_mechanism *mechanism, fw_text *out) {
    const fw_multibody_dense *d = sys->work->method;
    const fw_multibody_rank_monitor *k = &d->rank;
    char number[32];
    (void)mechanism;
    if (k->evaluations == 0) return FW_OK;
    if (k->most == 0)
        fw_text_printf(out, "all %d constraint rows are independent", d->rows);
    else if (k->least == k->most)
        fw_text_printf(out, "%d of %d constraint rows are redundant", k->most, d->rows);
    else
        fw_text_printf(out, "between %d and %d of %d constraint rows are redundant", k->least,
                       k->most, d->rows);
    fw_number_text(number, sizeof number, k->smallest, 2);
    if (k->weak > 0)
        fw_text_printf(out,
                       "; in %ld of %ld evaluations a singular value lay between round-off and "
                       "0.001 (the smallest %s): a singular position, where the damped share of "
                       "the constraint counts and not a rank",
                       k->weak, k->evaluations, number);
    else if (k->smallest < (double)INFINITY)
        fw_text_printf(out, "; the smallest singular value was %s", number);
    return fw_text_end(out);
}
