/* SPDX-License-Identifier: GPL-3.0-or-later */
/* coordinate-partitioning: Gaussian elimination of G with complete pivoting splits the coordinates
   into dependent ones u and independent ones v,

       A = [ A_u  A_v ]        w_u = c - X w_v,   X = A_u^-1 A_v,   c = A_u^-1 b_1,
           [ A_lu A_lv ]       (I + X^T X) w_v = w0_v - X^T (w0_u - c)

   in mass-weighted coordinates (multibody/multibody_dense.h), where B = [-X; I] spans the null
   space of the first rows and B^T B is the reduced mass matrix. The partition stays until it
   degrades: until the ratio of the smallest to the largest pivot of A_u is a tenth of what it was
   when it was chosen, or below 1e-3. (X says nothing about that: it stays bounded at a singular
   position, while A_u^-1 does not.)

   Pivots end at 1e-3 of the largest. Rows left over, redundant ones and those that vanish near a
   singular position, are not dropped: they remain constraints of the reduced equations,

       H w_v = h,   H = A_lv - A_lu X,   h = b_l - A_lu c,

   and go through the proximal iteration with S = H (I + X^T X)^-1 H^T + eps, so that no rank is
   decided. Corrections of positions and velocities move the dependent coordinates alone, as long as
   no such row asks for more and the pivots of A_u lie within a factor of 10. Beyond that they are
   of least mass norm: holding one coordinate there pushes the errors of a motion that is about to
   become free into the motion that goes on (measured on two four-bar windows, rtol 1e-12: error at
   10 s 2e-8 instead of 2e-9). Error: round-off times |X|^2. Cost rows^2 n + n_v^2 n; complete
   pivoting, rows^2 n, when the partition changes. Source: Wehage and Haug, J. Mech. Des. 104 (1982)
   247-255. Test: test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

static const double least_pivot = 1e-3, worse = 10, near = 0.1;

typedef struct partition {
    int k, left, free;     /* dependents = rows eliminated, rows left over, independents */
    int *row, *column;     /* order: eliminated rows first, dependent columns first */
    int *before;           /* (n) column order of the partition before */
    double condition;      /* of A_u when it was chosen */
    double *lu;            /* (k x k) A_u */
    int *pivot;            /* (k) */
    double *x;             /* (k x free) */
    double *h, *y;         /* (free x left) H^T; (I + X^T X)^-1 H^T */
    double *mass;          /* (free x free) Cholesky factor of I + X^T X */
    double *s;             /* (left x left) Cholesky factor of S */
    double *copy;          /* (rows x n) */
    double *c, *z, *force; /* (n) */
    double *r, *mu, *step; /* (rows) */
    long changes;
    int least_left, most_left;
    bool chosen;
} partition;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    partition *p;
    size_t rows = (size_t)d->rows, n = (size_t)d->n, k = rows < n ? rows : n;
    FW_NEED(p = fw_arena_one(arena, partition));
    p->least_left = d->rows;
    FW_NEED(p->row = fw_arena_array(arena, int, rows));
    FW_NEED(p->column = fw_arena_array(arena, int, n));
    FW_NEED(p->before = fw_arena_array(arena, int, n));
    FW_NEED(p->pivot = fw_arena_array(arena, int, k));
    FW_NEED(p->lu = fw_arena_array(arena, double, k *k));
    FW_NEED(p->s = fw_arena_array(arena, double, rows *rows));
    FW_NEED(p->mass = fw_arena_array(arena, double, n *n));
    double **blocks[] = {&p->x, &p->h, &p->y, &p->copy};
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++)
        FW_NEED(*blocks[i] = fw_arena_array(arena, double, rows *n));
    FW_NEED(p->c = fw_arena_array(arena, double, n));
    FW_NEED(p->z = fw_arena_array(arena, double, n));
    FW_NEED(p->force = fw_arena_array(arena, double, n));
    FW_NEED(p->r = fw_arena_array(arena, double, rows));
    FW_NEED(p->mu = fw_arena_array(arena, double, rows));
    FW_NEED(p->step = fw_arena_array(arena, double, rows));
    d->space = p;
    return FW_OK;
}

static double entry(const fw_multibody_dense *d, int row, int column) {
    return d->a[(size_t)row + (size_t)column * (size_t)d->rows];
}

static bool contains(const int *order, int count, int value) {
    for (int i = 0; i < count; i++)
        if (order[i] == value) return true;
    return false;
}

/* a change is one of the set of independent coordinates, not of their order */
static void choose(fw_multibody_dense *d) {
    partition *p = d->space;
    double last;
    int k = p->k;
    memcpy(p->before, p->column, (size_t)d->n * sizeof *p->column);
    memcpy(p->copy, d->g, (size_t)d->rows * (size_t)d->n * sizeof *d->g);
    p->k =
        fw_maths_complete_pivoting(d->rows, d->n, p->copy, p->row, p->column, least_pivot, &last);
    p->left = d->rows - p->k;
    p->free = d->n - p->k;
    bool other = p->chosen && k != p->k;
    for (int j = 0; p->chosen && j < p->k && !other; j++)
        other = !contains(p->before, k, p->column[j]);
    p->changes += other;
    p->chosen = true;
}

/* A_u = L U, X, H; false: A_u is singular */
static bool eliminate(fw_multibody_dense *d) {
    partition *p = d->space;
    size_t k = (size_t)p->k;
    for (int j = 0; j < p->k; j++)
        for (int i = 0; i < p->k; i++)
            p->lu[(size_t)i + (size_t)j * k] = entry(d, p->row[i], p->column[j]);
    if (k > 0 && !fw_maths_lapack_lu(p->k, p->lu, p->pivot)) return false;
    for (int j = 0; j < p->free; j++)
        for (int i = 0; i < p->k; i++)
            p->x[(size_t)i + (size_t)j * k] = entry(d, p->row[i], p->column[p->k + j]);
    if (k > 0 && p->free > 0 &&
        !fw_maths_lapack_lu_solve(false, p->k, p->free, p->lu, p->pivot, p->x))
        return false;
    for (int l = 0; l < p->left; l++)
        for (int j = 0; j < p->free; j++) {
            double sum = entry(d, p->row[p->k + l], p->column[p->k + j]);
            for (int i = 0; i < p->k; i++)
                sum -= entry(d, p->row[p->k + l], p->column[i]) * p->x[(size_t)i + (size_t)j * k];
            p->h[j + l * p->free] = sum;
        }
    return true;
}

/* smallest over largest pivot of A_u */
static double condition(const partition *p) {
    double least = (double)INFINITY, most = 0;
    for (int i = 0; i < p->k; i++) {
        double size = fabs(p->lu[i + i * p->k]);
        least = fmin(least, size);
        most = fmax(most, size);
    }
    return p->k > 0 ? least / most : 1;
}

/* largest |H| in unweighted coordinates: what could be a pivot again */
static double left_over(const fw_multibody_dense *d) {
    const partition *p = d->space;
    double largest = 0;
    for (int l = 0; l < p->left; l++)
        for (int j = 0; j < p->free; j++)
            largest = fmax(largest, fabs(p->h[j + l * p->free]) / d->row[p->row[p->k + l]] /
                                        d->root[p->column[p->k + j]]);
    return largest;
}

static bool degraded(const fw_multibody_dense *d) {
    const partition *p = d->space;
    double largest = fw_multibody_dense_largest(d->g, d->rows * d->n);
    return !(condition(p) >= fmax(p->condition / worse, least_pivot)) ||
           left_over(d) > worse * least_pivot * largest;
}

/* Cholesky factors of I + X^T X and of S = H (I + X^T X)^-1 H^T + eps */
static bool reduce(fw_multibody_dense *d) {
    partition *p = d->space;
    size_t k = (size_t)p->k, free = (size_t)p->free, left = (size_t)p->left;
    for (size_t j = 0; j < free; j++)
        for (size_t i = j; i < free; i++) {
            double sum = i == j;
            for (size_t e = 0; e < k; e++)
                sum += p->x[e + i * k] * p->x[e + j * k];
            p->mass[i + j * free] = sum;
        }
    if (free > 0 && !fw_maths_cholesky(p->free, p->mass)) return false;
    if (left == 0 || free == 0) return true;
    memcpy(p->y, p->h, free * left * sizeof *p->y);
    for (size_t l = 0; l < left; l++)
        if (!fw_maths_cholesky_solve(p->free, p->mass, p->y + l * free)) return false;
    for (size_t j = 0; j < left; j++)
        for (size_t i = j; i < left; i++) {
            double sum = i == j ? fw_epsilon : 0;
            for (size_t e = 0; e < free; e++)
                sum += p->h[e + i * free] * p->y[e + j * free];
            p->s[i + j * left] = sum;
        }
    return fw_maths_cholesky(p->left, p->s);
}

static bool kernel_factor(fw_multibody_dense *d) {
    partition *p = d->space;
    bool fresh = !p->chosen;
    if (fresh) choose(d);
    if (!eliminate(d) || fresh || degraded(d)) {
        if (!fresh) choose(d);
        if (!eliminate(d)) return false;
        p->condition = condition(p);
    }
    p->least_left = p->left < p->least_left ? p->left : p->least_left;
    p->most_left = p->left > p->most_left ? p->left : p->most_left;
    return reduce(d);
}

/* c = A_u^-1 b_1 (k), r = h (left) */
static bool particular(fw_multibody_dense *d, const double *b) {
    partition *p = d->space;
    for (int i = 0; i < p->k; i++)
        p->c[i] = b[p->row[i]];
    if (p->k > 0 && !fw_maths_lapack_lu_solve(false, p->k, 1, p->lu, p->pivot, p->c)) return false;
    for (int l = 0; l < p->left; l++) {
        double sum = b[p->row[p->k + l]];
        for (int i = 0; i < p->k; i++)
            sum -= entry(d, p->row[p->k + l], p->column[i]) * p->c[i];
        p->r[l] = sum;
    }
    return true;
}

/* z += (I + X^T X)^-1 H^T S^-1 (h - H z), swept; mu: the multipliers of H, with opposite sign */
static bool left_rows(partition *p, const double *h, int sweeps) {
    double *step = p->step;
    for (int sweep = 0; sweep < sweeps; sweep++) {
        for (int l = 0; l < p->left; l++) {
            step[l] = h[l];
            for (int j = 0; j < p->free; j++)
                step[l] -= p->h[j + l * p->free] * p->z[j];
        }
        if (!fw_maths_cholesky_solve(p->left, p->s, step)) return false;
        for (int l = 0; l < p->left; l++) {
            p->mu[l] -= step[l];
            for (int j = 0; j < p->free; j++)
                p->z[j] += p->y[j + l * p->free] * step[l];
        }
    }
    return true;
}

static void place(fw_multibody_dense *d, double *w) { /* w_u = c - X z, w_v = z */
    partition *p = d->space;
    for (int i = 0; i < p->k; i++) {
        double sum = p->c[i];
        for (int j = 0; j < p->free; j++)
            sum -= p->x[i + j * p->k] * p->z[j];
        w[p->column[i]] = sum;
    }
    for (int j = 0; j < p->free; j++)
        w[p->column[p->k + j]] = p->z[j];
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    partition *p = d->space;
    if (!particular(d, b)) return false;
    for (int j = 0; j < p->free; j++) {
        double sum = w[p->column[p->k + j]];
        for (int i = 0; i < p->k; i++)
            sum -= p->x[i + j * p->k] * (w[p->column[i]] - p->c[i]);
        p->z[j] = sum;
    }
    if (p->free > 0 && !fw_maths_cholesky_solve(p->free, p->mass, p->z)) return false;
    memset(p->mu, 0, (size_t)d->rows * sizeof *p->mu);
    if (p->left > 0 && p->free > 0 && !left_rows(p, p->r, sweeps)) return false;
    /* A_u^T lambda_1 = w0_u - w_u - A_lu^T mu */
    double *force = p->force;
    for (int i = 0; i < p->k; i++)
        force[i] = w[p->column[i]];
    place(d, w);
    for (int i = 0; i < p->k; i++) {
        force[i] -= w[p->column[i]];
        for (int l = 0; l < p->left; l++)
            force[i] -= entry(d, p->row[p->k + l], p->column[i]) * p->mu[l];
    }
    if (p->k > 0 && !fw_maths_lapack_lu_solve(true, p->k, 1, p->lu, p->pivot, force)) return false;
    for (int i = 0; i < d->rows; i++)
        lambda[p->row[i]] = i < p->k ? force[i] : p->mu[i - p->k];
    return true;
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

/* the independent coordinates stay where they are, except near singular positions: what a step
   left in the motion that is about to become free would be pushed into them */
static void correct(fw_multibody_system *sys, const fw_multibody_pose *pose, const double *r,
                    double *correction) {
    fw_multibody_dense *d = sys->work->method;
    partition *p = d->space;
    if (d->rows > 0 && condition(p) < near) {
        fw_multibody_dense_model_correct(sys, pose, r, correction);
        return;
    }
    memset(correction, 0, (size_t)d->n * sizeof *correction);
    if (d->rows == 0) return;
    fw_multibody_pack(sys->model, r, d->gamma);
    for (int i = 0; i < d->rows; i++)
        d->b[i] = -d->row[i] * d->gamma[i];
    bool good = particular(d, d->b);
    memset(p->z, 0, (size_t)d->n * sizeof *p->z);
    memset(p->mu, 0, (size_t)d->rows * sizeof *p->mu);
    if (p->left > 0 && p->free > 0) good &= left_rows(p, p->r, 1);
    place(d, correction);
    if (!good) correction[0] = (double)NAN;
    for (int j = 0; j < d->n; j++)
        correction[j] *= d->root[j];
}

static fw_status report(const fw_multibody_system *sys, const fw_mechanism *mechanism,
                        fw_text *out) {
    static const char *const axis[] = {"x", "y", "phi"};
    const fw_multibody_dense *d = sys->work->method;
    const partition *p = d->space;
    if (!p || !p->chosen) return FW_OK;
    fw_text_add(out, p->free > 0 ? "independent coordinates: " : "no independent coordinate");
    for (int j = 0; j < p->free; j++) {
        int column = p->column[p->k + j];
        fw_text_printf(out, "%s%s.%s", j > 0 ? ", " : "", mechanism->body[column / 3].id,
                       axis[column % 3]);
    }
    fw_text_printf(out, "; changed %ld time%s", p->changes, p->changes == 1 ? "" : "s");
    if (p->most_left > 0)
        fw_text_printf(
            out,
            "; up to %d of %d constraint rows (at least %d) had no pivot above 0.001 and "
            "were kept as constraints of the independent coordinates",
            p->most_left, d->rows, p->least_left);
    return fw_text_end(out);
}

const fw_multibody_method fw_multibody_method_coordinate_partitioning = {
    .name = "coordinate-partitioning",
    .cost = {66000, 3},
    .independent = true,
    .summary =
        "independent coordinates chosen by complete pivoting, changed when the pivots degrade",
    .source = "Wehage and Haug 1982",
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = correct,
    .report = report,
};
