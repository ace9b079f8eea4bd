/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With A (n x p) of the products at the points and A^T A = L L^T, the rows v_i = L^-1 a_i are those of an orthonormal
   basis, and the leading part of L is that of a lower degree. So one factorisation gives, for every degree with q terms,

     fitted_i = sum over j < q of v_ij w_j,   w = sum over i of v_i y_i,   leverage_i = sum over j < q of v_ij^2

   and the coefficients are those of L_q^T c = w. Legendre's polynomials keep A^T A near a diagonal where points fill the cube
   evenly, so that squaring its condition costs nothing. */
#include "chance/joint.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

/* share of a product's square that has to be its own: below, its coefficient would be round-off */
static const double told_apart = 1e-9;

typedef struct fit {
    size_t n, terms, columns;
    int degrees;    /* that are tried: 0 to degrees */
    size_t *within; /* (degrees + 1) terms up to this degree */
    double *v;      /* (n x terms) products, then rows of the orthonormal basis */
    double *gram;   /* (terms x terms) by columns, then L in its lower part */
    double *w;      /* (terms x columns) */
} fit;

/* products of k of the variables, of powers that add up to the degree at most: (dimensions over k) (degree over k) */
size_t fw_chance_surface_terms(size_t dimensions, int degree, int together) {
    double terms = 1, of_k = 1;
    for (int k = 1; k <= degree && k <= together && (size_t)k <= dimensions; k++) {
        of_k = of_k * (double)(dimensions - (size_t)k + 1) * (degree - k + 1) / ((double)k * k);
        terms += of_k;
    }
    return (size_t)(terms + 0.5);
}

/* ---- products ---- */

/* in the order of their degree: each is one of a degree less, or the same less a last factor, times P_k of a variable that
   comes behind those that it has */
static void number_terms(fw_chance_surface *s, int *less, int *variable, int *power, int *total,
                         int *factors) {
    size_t n = 1;
    less[0] = 0, variable[0] = -1, power[0] = 0, total[0] = 0, factors[0] = 0;
    for (int degree = 1; degree <= s->degree; degree++)
        for (size_t t = 0, end = n; t < end; t++)
            for (int v = variable[t] + 1; v < (int)s->dimensions && total[t] < degree; v++) {
                if (factors[t] == s->together) break;
                less[n] = (int)t, variable[n] = v, factors[n] = factors[t] + 1;
                power[n] = degree - total[t], total[n] = degree;
                n++;
            }
}

static void products(const fw_chance_surface *s, const double *z, double *out) {
    double p[FW_CHANCE_SURFACE_TERMS][FW_CHANCE_SURFACE_DEGREE + 1]; /* P_k of each variable */
    for (size_t v = 0; v < s->dimensions; v++) {
        p[v][0] = 1, p[v][1] = z[v];
        for (int k = 2; k <= s->degree; k++)
            p[v][k] = ((2 * k - 1) * z[v] * p[v][k - 1] - (k - 1) * p[v][k - 2]) / k;
    }
    out[0] = 1;
    for (size_t t = 1; t < s->terms; t++)
        out[t] = out[s->less[t]] * p[s->variable[t]][s->power[t]];
}

void fw_chance_surface_at(const fw_chance_surface *s, const double *z, double *work, double *y) {
    products(s, z, work);
    memset(y, 0, s->columns * sizeof *y);
    for (size_t t = 0; t < s->terms; t++)
        for (size_t c = 0; c < s->columns; c++)
            y[c] += work[t] * s->coefficient[t * s->columns + c];
}

/* ---- least squares ---- */

static fw_status number(fw_arena *arena, fw_chance_surface *s) {
    int *all = fw_arena_array(arena, int, 5 * s->terms);
    FW_NEED(all);
    number_terms(s, all, all + s->terms, all + 2 * s->terms, all + 3 * s->terms,
                 all + 4 * s->terms);
    s->less = all, s->variable = all + s->terms, s->power = all + 2 * s->terms;
    return FW_OK;
}

/* points between two looks at a request to stop */
enum { AT_ONCE = 64 };

static fw_status gram_of(const fw_arena *arena, const fit *f) {
    for (size_t i = 0; i < f->n; i++) {
        if (i % AT_ONCE == 0 && fw_arena_cancelled(arena)) return FW_CANCELLED;
        const double *v = f->v + i * f->terms;
        for (size_t j = 0; j < f->terms; j++)
            for (size_t k = j; k < f->terms; k++)
                f->gram[j * f->terms + k] += v[j] * v[k];
    }
    return FW_OK;
}

/* gram = L L^T; false: a product is, but for round-off, a sum of those before it at these points */
static bool factor(const fit *f, double *size) {
    for (size_t j = 0; j < f->terms; j++)
        size[j] = f->gram[j * f->terms + j];
    if (!fw_maths_cholesky((int)f->terms, f->gram)) return false;
    for (size_t j = 0; j < f->terms; j++) {
        const double l = f->gram[j * f->terms + j];
        if (!(l * l > told_apart * size[j])) return false;
    }
    return true;
}

/* v = L^-1 v, of one point */
static void orthonormal(const fit *f, double *v) {
    for (size_t j = 0; j < f->terms; j++) {
        const double *l = f->gram + j * f->terms; /* column j */
        v[j] /= l[j];
        for (size_t k = j + 1; k < f->terms; k++)
            v[k] -= l[k] * v[j];
    }
}

static void project(const fit *f, const double *y) {
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < f->terms; j++)
            for (size_t c = 0; c < f->columns; c++)
                f->w[j * f->columns + c] += f->v[i * f->terms + j] * y[i * f->columns + c];
}

/* missed (degrees + 1 x columns): the largest residual of each degree with a point left out */
static void miss(const fit *f, const double *y, double *missed, double *fitted) {
    for (size_t i = 0; i < f->n; i++) {
        const double *v = f->v + i * f->terms;
        double leverage = 0;
        size_t j = 0;
        memset(fitted, 0, f->columns * sizeof *fitted);
        for (int k = 0; k <= f->degrees; k++) {
            for (; j < f->within[k]; j++) {
                leverage += v[j] * v[j];
                for (size_t c = 0; c < f->columns; c++)
                    fitted[c] += v[j] * f->w[j * f->columns + c];
            }
            const double left = fmax(1 - leverage, 1e-6);
            for (size_t c = 0; c < f->columns; c++) {
                double *m = &missed[(size_t)k * f->columns + c];
                *m = fmax(*m, fabs(y[i * f->columns + c] - fitted[c]) / left);
            }
        }
    }
}

/* L_q^T c = w, of one column; those of higher degrees stay 0 */
static void solve(const fit *f, size_t q, size_t c, double *coefficient) {
    for (size_t j = q; j-- > 0;) {
        double rest = f->w[j * f->columns + c];
        for (size_t k = j + 1; k < q; k++)
            rest -= f->gram[j * f->terms + k] * coefficient[k * f->columns + c];
        coefficient[j * f->columns + c] = rest / f->gram[j * f->terms + j];
    }
}

static fw_status fit_new(fw_arena *scratch, const fw_chance_surface *s, size_t n, fit *f) {
    *f = (fit){.n = n, .terms = s->terms, .columns = s->columns, .degrees = s->degree};
    FW_NEED(f->within = fw_arena_array(scratch, size_t, (size_t)s->degree + 1));
    for (int k = 0; k <= s->degree; k++)
        f->within[k] = fw_chance_surface_terms(s->dimensions, k, s->together);
    FW_NEED(f->v = fw_arena_array(scratch, double, n * f->terms));
    FW_NEED(f->gram = fw_arena_array(scratch, double, f->terms * f->terms));
    FW_NEED(f->w = fw_arena_array(scratch, double, f->terms * f->columns));
    return FW_OK;
}

/* *found false: points do not tell the products of this degree apart */
static fw_status fit_degree(fw_arena *scratch, size_t n, const double *z, const double *y,
                            fw_chance_surface *s, bool *found) {
    fit f;
    FW_TRY(fit_new(scratch, s, n, &f));
    double *missed = fw_arena_array(scratch, double, ((size_t)s->degree + 2) * s->columns);
    double *size = fw_arena_array(scratch, double, f.terms);
    FW_NEED(missed && size ? missed : NULL);
    for (size_t i = 0; i < n; i++)
        products(s, z + i * s->dimensions, f.v + i * f.terms);
    FW_TRY(gram_of(scratch, &f));
    *found = factor(&f, size);
    if (!*found) return FW_OK;
    for (size_t i = 0; i < n; i++) {
        if (i % AT_ONCE == 0 && fw_arena_cancelled(scratch)) return FW_CANCELLED;
        orthonormal(&f, f.v + i * f.terms);
    }
    project(&f, y);
    miss(&f, y, missed, missed + ((size_t)s->degree + 1) * s->columns);
    for (size_t c = 0; c < s->columns; c++) {
        int best = 0;
        for (int k = 1; k <= s->degree; k++)
            if (missed[(size_t)k * s->columns + c] < missed[(size_t)best * s->columns + c])
                best = k;
        s->degree_of[c] = best;
        s->missed[c] = missed[(size_t)best * s->columns + c];
        solve(&f, f.within[best], c, s->coefficient);
    }
    return FW_OK;
}

/* the highest degree for which there are points enough; 0: none */
static int degree_of(size_t n, size_t dimensions, int together) {
    int degree = 0;
    for (; degree < FW_CHANCE_SURFACE_DEGREE; degree++) {
        const size_t terms = fw_chance_surface_terms(dimensions, degree + 1, together);
        if (terms > FW_CHANCE_SURFACE_TERMS || terms * FW_CHANCE_SURFACE_POINTS > n) break;
    }
    return degree;
}

/* variables in one product, at most */
static int together_of(size_t dimensions) {
    const size_t cubic = fw_chance_surface_terms(dimensions, 3, 3);
    return cubic > FW_CHANCE_SURFACE_TERMS ? 2 : FW_CHANCE_SURFACE_DEGREE;
}

fw_status fw_chance_surface_fit(fw_arena *arena, size_t n, size_t dimensions, const double *z,
                                size_t columns, const double *y, fw_chance_surface *out) {
    bool found = false;
    const int together = together_of(dimensions);
    for (int degree = degree_of(n, dimensions, together); degree > 0 && !found; degree--) {
        *out = (fw_chance_surface){
            .dimensions = dimensions, .columns = columns, .degree = degree, .together = together};
        out->terms = fw_chance_surface_terms(dimensions, degree, together);
        FW_TRY(number(arena, out));
        FW_NEED(out->coefficient = fw_arena_array(arena, double, out->terms *columns));
        FW_NEED(out->missed = fw_arena_array(arena, double, columns));
        FW_NEED(out->degree_of = fw_arena_array(arena, int, columns));
        fw_arena *scratch = fw_arena_part(arena, 0);
        FW_NEED(scratch);
        const fw_status status = fit_degree(scratch, n, z, y, out, &found);
        fw_arena_free(scratch);
        FW_TRY(status);
    }
    if (!found) *out = (fw_chance_surface){.dimensions = dimensions, .columns = columns};
    return FW_OK;
}

fw_status fw_chance_surface_fill(fw_arena *arena, size_t n, size_t d, const double *z,
                                 size_t columns, size_t column, double *y, double *missed) {
    size_t has = 0;
    fw_chance_surface s;
    *missed = 0;
    for (size_t i = 0; i < n; i++)
        has += y[i * columns + column] != 0;
    if (has == 0 || has == n) return FW_OK;
    double *at = fw_arena_array(arena, double, has *d), *of = fw_arena_array(arena, double, has),
           *work = fw_arena_array(arena, double, FW_CHANCE_SURFACE_TERMS);
    FW_NEED(at && of && work ? at : NULL);
    for (size_t i = 0, k = 0; i < n; i++) {
        if (y[i * columns + column] == 0) continue;
        memcpy(at + k * d, z + i * d, d * sizeof *at);
        of[k++] = y[i * columns + column];
    }
    FW_TRY(fw_chance_surface_fit(arena, has, d, at, 1, of, &s));
    if (s.terms == 0) return FW_OK;
    *missed = s.missed[0];
    for (size_t i = 0; i < n; i++)
        if (y[i * columns + column] == 0)
            fw_chance_surface_at(&s, z + i * d, work, &y[i * columns + column]);
    return FW_OK;
}
