/* SPDX-License-Identifier: GPL-3.0-or-later */
/* SUNDIALS 6.4 (Debian) on the reference six-bar: IDA on the index-1 form with Baumgarte terms and
   on the stabilised index-2 form of Gear, Gupta and Leimkuhler, both with the analytic Jacobian and
   KLU (or dense); CVODE on the accelerations from a block-tridiagonal elimination. Not part of the
   product.

   Unknowns of IDA: q (15), v (15), lambda (12), mu (12, GGL only). With joint j between bodies a =
   j-1 and b = j, arms d = R s and e = R' s: Psi_j = r_a + d_a - r_b - d_b,  G_j = [I e_a | -I
   -e_b],  Gdot v = -w_a^2 d_a + w_b^2 d_b index 1:  q' = v,  M v' + G^T lambda = Q,  G v' + Gdot v
   + 2 alpha G v + alpha^2 Psi = 0 GGL:      q' + G^T mu = v,  M v' + G^T lambda = Q,  Psi = 0,  G v
   = 0

   peer_sundials sixbar | rhs; further arguments: measure.h */
#include "../measure.h"
#include <cvode/cvode.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { Q = 0, V = 15, L = 30, U = 42, INDEX1 = 42, GGL = 54, ENTRIES = 640 };

typedef struct joints { /* of one pose; arms of the ground are zero, its hinge is in `fixed` */
    double d[6][2][2], e[6][2][2];
} joints;

static double arm[6][2][2]; /* local, side a and b */

static int body_of(int joint, int side) { /* -1: ground */
    int b = joint - 1 + side;
    return b < 5 ? b : -1;
}

static void prepare(void) {
    for (int j = 0; j < 6; j++)
        for (int s = 0; s < 2; s++)
            for (int k = 0; k < 2; k++) {
                int b = body_of(j, s);
                arm[j][s][k] = b < 0 ? 0 : six_hinge[j][k] - six_centre[b][k];
            }
}

static void pose(const double *q, joints *g) {
    double c[5], s[5];
    for (int b = 0; b < 5; b++)
        c[b] = cos(q[3 * b + 2]), s[b] = sin(q[3 * b + 2]);
    memset(g, 0, sizeof *g);
    for (int j = 0; j < 6; j++)
        for (int k = 0; k < 2; k++) {
            int b = body_of(j, k);
            if (b < 0) continue;
            double x = arm[j][k][0], y = arm[j][k][1];
            g->d[j][k][0] = c[b] * x - s[b] * y, g->d[j][k][1] = s[b] * x + c[b] * y;
            g->e[j][k][0] = -g->d[j][k][1], g->e[j][k][1] = g->d[j][k][0];
        }
}

/* applied forces: springs and dampers of the hinges, constant loads */
static void loads(const double *q, const double *v, double *f) {
    memset(f, 0, 15 * sizeof *f);
    for (int j = 0; j < 6; j++) {
        int a = body_of(j, 0), b = body_of(j, 1);
        double th = (b < 0 ? 0 : q[3 * b + 2]) - (a < 0 ? 0 : q[3 * a + 2]);
        double w = (b < 0 ? 0 : v[3 * b + 2]) - (a < 0 ? 0 : v[3 * a + 2]);
        double torque = six_stiffness[j] * th + six_damping[j] * w;
        if (a >= 0) f[3 * a + 2] += torque;
        if (b >= 0) f[3 * b + 2] -= torque;
    }
    f[6] += six_force[0], f[7] += six_force[1], f[2] += six_torque;
}

/* psi, G v, Gdot v: (12) each; any may be NULL */
static void constraints(const joints *g, const double *q, const double *v, double *psi, double *gv,
                        double *gdv) {
    for (int j = 0; j < 6; j++)
        for (int k = 0; k < 2; k++) {
            double p = 0, r = 0, c = 0;
            for (int s = 0; s < 2; s++) {
                int b = body_of(j, s);
                double sign = s ? -1 : 1;
                if (b < 0) {
                    p += sign * six_hinge[j][k];
                    continue;
                }
                double w = v ? v[3 * b + 2] : 0;
                p += sign * (q[3 * b + k] + g->d[j][s][k]);
                r += sign * ((v ? v[3 * b + k] : 0) + g->e[j][s][k] * w);
                c -= sign * w * w * g->d[j][s][k];
            }
            if (psi) psi[2 * j + k] = p;
            if (gv) gv[2 * j + k] = r;
            if (gdv) gdv[2 * j + k] = c;
        }
}

/* out += G^T l */
static void transpose(const joints *g, const double *l, double *out) {
    for (int j = 0; j < 6; j++)
        for (int s = 0; s < 2; s++) {
            int b = body_of(j, s);
            if (b < 0) continue;
            double sign = s ? -1 : 1;
            for (int k = 0; k < 2; k++) {
                out[3 * b + k] += sign * l[2 * j + k];
                out[3 * b + 2] += sign * g->e[j][s][k] * l[2 * j + k];
            }
        }
}

/* accelerations and multipliers: block-tridiagonal S lambda = G M^-1 Q + rest, one pass */
static void accelerate(const double *q, const double *v, double alpha, double *a, double *l) {
    joints g;
    double f[15], psi[12], gv[12], gdv[12], diagonal[6][2][2], pivot[6][2][2], upper[6][2][2];
    pose(q, &g);
    loads(q, v, f);
    constraints(&g, q, v, psi, gv, gdv);
    for (int b = 0; b < 5; b++)
        f[3 * b] /= six_mass[b], f[3 * b + 1] /= six_mass[b], f[3 * b + 2] /= six_inertia[b];
    constraints(&g, q, f, NULL, l, NULL); /* G M^-1 Q */
    for (int i = 0; i < 12; i++)
        l[i] += gdv[i] + 2 * alpha * gv[i] + alpha * alpha * psi[i];
    for (int j = 0; j < 6; j++)
        for (int r = 0; r < 2; r++)
            for (int c = 0; c < 2; c++) {
                double sum = 0;
                for (int s = 0; s < 2; s++) {
                    int b = body_of(j, s);
                    if (b >= 0)
                        sum +=
                            (r == c) / six_mass[b] + g.e[j][s][r] * g.e[j][s][c] / six_inertia[b];
                }
                diagonal[j][r][c] = sum;
                upper[j][r][c] = j < 5 ? -((r == c) / six_mass[j] +
                                           g.e[j][1][r] * g.e[j + 1][0][c] / six_inertia[j])
                                       : 0;
            }
    for (int j = 0; j < 6; j++) { /* forward: D_j -= U^T D^-1 U, right side likewise */
        double(*d)[2] = diagonal[j], det = d[0][0] * d[1][1] - d[0][1] * d[1][0];
        double(*p)[2] = pivot[j];
        p[0][0] = d[1][1] / det, p[1][1] = d[0][0] / det;
        p[0][1] = -d[0][1] / det, p[1][0] = -d[1][0] / det;
        if (j == 5) break;
        for (int r = 0; r < 2; r++)
            for (int k = 0; k < 2; k++) {
                double x = upper[j][0][r] * p[0][k] + upper[j][1][r] * p[1][k];
                l[2 * j + 2 + r] -= x * l[2 * j + k];
                for (int c = 0; c < 2; c++)
                    diagonal[j + 1][r][c] -= x * upper[j][k][c];
            }
    }
    for (int j = 5; j >= 0; j--) {
        double x[2] = {l[2 * j], l[2 * j + 1]};
        for (int k = 0; j < 5 && k < 2; k++)
            x[k] -= upper[j][k][0] * l[2 * j + 2] + upper[j][k][1] * l[2 * j + 3];
        for (int k = 0; k < 2; k++)
            l[2 * j + k] = pivot[j][k][0] * x[0] + pivot[j][k][1] * x[1];
    }
    double back[15] = {0};
    transpose(&g, l, back);
    for (int i = 0; i < 15; i++)
        a[i] = f[i] - back[i] / (i % 3 == 2 ? six_inertia[i / 3] : six_mass[i / 3]);
}

/* ---- IDA ---- */
typedef struct ida_case {
    int n, sparse, suppress; /* n: INDEX1 or GGL */
    double alpha, tolerance, algebraic, first_step;
    const six_reference *reference;
    int column[ENTRIES], row[ENTRIES], place[ENTRIES], entries, stored; /* triplets in CSC */
    double value[ENTRIES];
    sunindextype pointer[GGL + 1], index[ENTRIES];
} ida_case;

static int residual(double t, N_Vector yy, N_Vector yp, N_Vector rr, void *context) {
    (void)t;
    const ida_case *c = context;
    const double *y = NV_DATA_S(yy), *p = NV_DATA_S(yp);
    double *r = NV_DATA_S(rr), f[15], psi[12], gv[12], gdv[12], ga[12];
    joints g;
    pose(y, &g);
    loads(y + Q, y + V, f);
    constraints(&g, y, y + V, psi, gv, gdv);
    for (int i = 0; i < 15; i++) {
        r[Q + i] = p[Q + i] - y[V + i];
        r[V + i] = (i % 3 == 2 ? six_inertia[i / 3] : six_mass[i / 3]) * p[V + i] - f[i];
    }
    transpose(&g, y + L, r + V);
    if (c->n == GGL) {
        transpose(&g, y + U, r + Q);
        memcpy(r + L, psi, sizeof psi);
        memcpy(r + U, gv, sizeof gv);
    } else {
        constraints(&g, y, p + V, NULL, ga, NULL);
        for (int i = 0; i < 12; i++)
            r[L + i] = ga[i] + gdv[i] + 2 * c->alpha * gv[i] + c->alpha * c->alpha * psi[i];
    }
    return 0;
}

static void add(ida_case *c, int row, int column, double value) {
    c->row[c->entries] = row, c->column[c->entries] = column;
    c->value[c->entries++] = value;
}

/* entries of dF/dy + cj dF/dy' in a fixed order */
static void entries(ida_case *c, double cj, const double *y, const double *p) {
    joints g;
    c->entries = 0;
    pose(y, &g);
    for (int i = 0; i < 15; i++) {
        add(c, Q + i, Q + i, cj);
        add(c, Q + i, V + i, -1);
        add(c, V + i, V + i, cj * (i % 3 == 2 ? six_inertia[i / 3] : six_mass[i / 3]));
    }
    for (int j = 0; j < 6; j++)
        for (int s = 0; s < 2; s++)
            for (int o = 0; o < 2; o++) { /* torque of hinge j on side s from the angle of side o */
                int b = body_of(j, s), of = body_of(j, o);
                if (b < 0 || of < 0) continue;
                double sign = s == o ? 1 : -1;
                add(c, V + 3 * b + 2, Q + 3 * of + 2, sign * six_stiffness[j]);
                add(c, V + 3 * b + 2, V + 3 * of + 2, sign * six_damping[j]);
            }
    for (int j = 0; j < 6; j++)
        for (int s = 0; s < 2; s++) {
            int b = body_of(j, s);
            if (b < 0) continue;
            double sign = s ? -1 : 1, w = y[V + 3 * b + 2], dw = p[V + 3 * b + 2];
            const double *d = g.d[j][s], *e = g.e[j][s], *l = y + L + 2 * j;
            /* G^T lambda: its torque e.lambda turns with the body */
            add(c, V + 3 * b + 2, Q + 3 * b + 2, -sign * (d[0] * l[0] + d[1] * l[1]));
            if (c->n == GGL) {
                const double *u = y + U + 2 * j;
                add(c, Q + 3 * b + 2, Q + 3 * b + 2, -sign * (d[0] * u[0] + d[1] * u[1]));
            }
            for (int k = 0; k < 2; k++) {
                int phi = 3 * b + 2, at = 3 * b + k, row = 2 * j + k;
                add(c, V + at, L + row, sign);
                add(c, V + phi, L + row, sign * e[k]);
                if (c->n == GGL) {
                    add(c, Q + at, U + row, sign);
                    add(c, Q + phi, U + row, sign * e[k]);
                    add(c, L + row, Q + at, sign);
                    add(c, L + row, Q + phi, sign * e[k]);
                    add(c, U + row, V + at, sign);
                    add(c, U + row, V + phi, sign * e[k]);
                    add(c, U + row, Q + phi, -sign * w * d[k]);
                    continue;
                }
                double a = c->alpha;
                add(c, L + row, V + at, sign * (cj + 2 * a));
                add(c, L + row, V + phi, sign * ((cj + 2 * a) * e[k] - 2 * w * d[k]));
                add(c, L + row, Q + at, sign * a * a);
                add(c, L + row, Q + phi,
                    sign * (a * a * e[k] - (dw + 2 * a * w) * d[k] - w * w * e[k]));
            }
        }
}

/* places of the triplets in compressed columns; duplicates share one */
static void compress(ida_case *c) {
    static int found[GGL][GGL];
    c->stored = 0;
    for (int i = 0; i < GGL; i++)
        for (int j = 0; j < GGL; j++)
            found[i][j] = -1;
    for (int k = 0; k < c->entries; k++)
        found[c->row[k]][c->column[k]] = 0;
    for (int j = 0; j < c->n; j++) {
        c->pointer[j] = c->stored;
        for (int i = 0; i < c->n; i++)
            if (found[i][j] == 0) {
                c->index[c->stored] = i;
                found[i][j] = c->stored++;
            }
    }
    c->pointer[c->n] = c->stored;
    for (int k = 0; k < c->entries; k++)
        c->place[k] = found[c->row[k]][c->column[k]];
}

static int jacobian(double t, double cj, N_Vector yy, N_Vector yp, N_Vector rr, SUNMatrix m,
                    void *context, N_Vector w1, N_Vector w2, N_Vector w3) {
    (void)t, (void)rr, (void)w1, (void)w2, (void)w3;
    ida_case *c = context;
    entries(c, cj, NV_DATA_S(yy), NV_DATA_S(yp));
    if (!c->sparse) {
        for (int k = 0; k < c->entries; k++)
            SM_ELEMENT_D(m, c->row[k], c->column[k]) += c->value[k];
        return 0;
    }
    memcpy(SM_INDEXPTRS_S(m), c->pointer, (size_t)(c->n + 1) * sizeof *c->pointer);
    memcpy(SM_INDEXVALS_S(m), c->index, (size_t)c->stored * sizeof *c->index);
    double *data = SM_DATA_S(m);
    memset(data, 0, (size_t)c->stored * sizeof *data);
    for (int k = 0; k < c->entries; k++)
        data[c->place[k]] += c->value[k];
    return 0;
}

static void start(double *y, double *p) {
    for (int b = 0; b < 5; b++)
        y[3 * b] = six_centre[b][0], y[3 * b + 1] = six_centre[b][1];
    if (p) accelerate(y, y + V, 0, p + V, y + L);
}

static outcome ida_run(void *context) {
    ida_case *c = context;
    outcome o = {0, 0, 0, NULL};
    SUNContext sun;
    SUNContext_Create(NULL, &sun);
    N_Vector y = N_VNew_Serial(c->n, sun), p = N_VNew_Serial(c->n, sun),
             id = N_VNew_Serial(c->n, sun), atol = N_VNew_Serial(c->n, sun);
    N_VConst(0, y), N_VConst(0, p);
    start(NV_DATA_S(y), NV_DATA_S(p));
    for (int i = 0; i < c->n; i++) {
        NV_Ith_S(id, i) = i < L;
        NV_Ith_S(atol, i) = i < L ? c->tolerance : c->algebraic;
    }
    entries(c, 1, NV_DATA_S(y), NV_DATA_S(p));
    compress(c);
    void *ida = IDACreate(sun);
    IDASetErrFile(ida, NULL);
    IDAInit(ida, residual, 0, y, p);
    IDASVtolerances(ida, c->tolerance, atol);
    IDASetUserData(ida, c);
    IDASetId(ida, id);
    IDASetSuppressAlg(ida, c->suppress);
    IDASetMaxNumSteps(ida, 10000000);
    if (c->first_step > 0) IDASetInitStep(ida, c->first_step);
    SUNMatrix m = c->sparse ? SUNSparseMatrix(c->n, c->n, c->stored, CSC_MAT, sun)
                            : SUNDenseMatrix(c->n, c->n, sun);
    SUNLinearSolver solver = c->sparse ? SUNLinSol_KLU(y, m, sun) : SUNLinSol_Dense(y, m, sun);
    IDASetLinearSolver(ida, solver, m);
    IDASetJacFn(ida, jacobian);
    double began = cpu_seconds(), t = 0;
    for (int k = 1; k <= 10; k++) {
        if (IDASolve(ida, k, &t, y, p, IDA_NORMAL) < 0) {
            o.failed = "IDASolve stops";
            break;
        }
        o.error = fmax(o.error, six_error(c->reference, k, NV_DATA_S(y)));
    }
    o.cpu_s = cpu_seconds() - began;
    IDAGetNumResEvals(ida, &o.rhs);
    IDAFree(&ida);
    SUNLinSolFree(solver);
    SUNMatDestroy(m);
    N_VDestroy(y), N_VDestroy(p), N_VDestroy(id), N_VDestroy(atol);
    SUNContext_Free(&sun);
    return o;
}

/* ---- CVODE ---- */
typedef struct cvode_case {
    int adams;
    double alpha, tolerance;
    const six_reference *reference;
} cvode_case;

static int velocity(double t, N_Vector yy, N_Vector ff, void *context) {
    (void)t;
    const cvode_case *c = context;
    const double *y = NV_DATA_S(yy);
    double *f = NV_DATA_S(ff), l[12];
    memcpy(f, y + V, 15 * sizeof *f);
    accelerate(y, y + V, c->alpha, f + V, l);
    return 0;
}

static outcome cvode_run(void *context) {
    cvode_case *c = context;
    outcome o = {0, 0, 0, NULL};
    SUNContext sun;
    SUNContext_Create(NULL, &sun);
    N_Vector y = N_VNew_Serial(30, sun);
    N_VConst(0, y);
    start(NV_DATA_S(y), NULL);
    void *cvode = CVodeCreate(c->adams ? CV_ADAMS : CV_BDF, sun);
    CVodeSetErrFile(cvode, NULL);
    CVodeInit(cvode, velocity, 0, y);
    CVodeSStolerances(cvode, c->tolerance, c->tolerance);
    CVodeSetUserData(cvode, c);
    CVodeSetMaxNumSteps(cvode, 10000000);
    SUNMatrix m = NULL;
    SUNLinearSolver solver = NULL;
    SUNNonlinearSolver fixed = NULL;
    if (c->adams) {
        fixed = SUNNonlinSol_FixedPoint(y, 0, sun);
        CVodeSetNonlinearSolver(cvode, fixed);
    } else {
        m = SUNDenseMatrix(30, 30, sun);
        solver = SUNLinSol_Dense(y, m, sun);
        CVodeSetLinearSolver(cvode, solver, m);
    }
    double began = cpu_seconds(), t = 0;
    for (int k = 1; k <= 10; k++) {
        if (CVode(cvode, k, y, &t, CV_NORMAL) < 0) {
            o.failed = "CVode stops";
            break;
        }
        o.error = fmax(o.error, six_error(c->reference, k, NV_DATA_S(y)));
    }
    o.cpu_s = cpu_seconds() - began;
    long more = 0;
    CVodeGetNumRhsEvals(cvode, &o.rhs);
    if (!c->adams) CVodeGetNumLinRhsEvals(cvode, &more);
    o.rhs += more;
    CVodeFree(&cvode);
    if (solver) SUNLinSolFree(solver);
    if (m) SUNMatDestroy(m);
    if (fixed) SUNNonlinSolFree(fixed);
    N_VDestroy(y);
    SUNContext_Free(&sun);
    return o;
}

/* ---- curves ---- */
static void six_bar(const request *wish) {
    static const struct {
        const char *name;
        int n, sparse, suppress;
        double algebraic, first_step, alpha;
    } ida[] = {
        {"IDA index 1 Baumgarte KLU", INDEX1, 1, 0, 1, 1e-4, 10},
        {"IDA index 1 Baumgarte KLU suppress", INDEX1, 1, 1, 1, 1e-4, 10},
        {"IDA index 1 Baumgarte dense", INDEX1, 0, 0, 1, 1e-4, 10},
        {"IDA GGL KLU", GGL, 1, 0, 1, 1e-4, 0},
        {"IDA GGL KLU suppress", GGL, 1, 1, 1, 1e-4, 0},
        {"IDA GGL dense", GGL, 0, 0, 1, 1e-4, 0},
        {"IDA GGL KLU uniform tolerances", GGL, 1, 0, 0, 0, 0},
    };
    six_reference reference;
    six_read(wish->reference, &reference);
    for (size_t i = 0; i < sizeof ida / sizeof *ida; i++)
        for (int e = 4; e <= 13; e++) {
            static ida_case c;
            c.n = ida[i].n, c.sparse = ida[i].sparse, c.suppress = ida[i].suppress;
            c.tolerance = pow(10, -e), c.alpha = ida[i].alpha;
            c.algebraic = ida[i].algebraic > 0 ? ida[i].algebraic : c.tolerance;
            c.first_step = ida[i].first_step;
            c.reference = &reference;
            if (wanted(wish, ida[i].name, e))
                print_row("SUNDIALS", ida[i].name, c.tolerance, measure(ida_run, &c));
        }
    for (int adams = 0; adams < 2; adams++)
        for (int e = 4; e <= 13; e++) {
            cvode_case c = {adams, 10, pow(10, -e), &reference};
            const char *name = adams ? "CVODE Adams fixed point" : "CVODE BDF dense";
            if (wanted(wish, name, e))
                print_row("SUNDIALS", name, c.tolerance, measure(cvode_run, &c));
        }
}

int main(int argc, char **argv) {
    request wish = read_request(argc, argv);
    prepare();
    if (strcmp(wish.problem, "sixbar") == 0)
        six_bar(&wish);
    else
        return 2;
    return 0;
}
