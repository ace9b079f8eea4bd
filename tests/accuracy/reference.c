/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of hinge angles and final states of the motions that docs/accuracy.md measures, by a
   program that shares nothing with the product: long double, joint forces by Gaussian elimination
   on all joints at once, extrapolated midpoint steps of fixed length (Gragg, Bulirsch and Stoer;
   Hairer, Norsett and Wanner I, II.9), no projection.

   accuracy_reference             rows PROBLEM,WHAT,INDEX,VALUE: `peak`: per joint, the extreme of
   the relative angle (rad, with its sign); `end`: x y phi of every body; `angle`, `rate`: of the
   cranks of N four-bar windows after 2 s accuracy_reference check FILE  distance to what others
   have computed: the six-bar's table in quad precision (FILE), the squeezer's angles in quad
   precision, elliptic functions for the windows; and to steps twice as long

   Units of the six-bar: mm, mg, ms; of the others SI. Errors: those that `check` prints, 1e-14 and
   less. Cost: seconds. Test: reference_check.py. */
#include "measure.h"
#include <stdbool.h>

enum { BODIES = 7, PINS = 10, STATE = 6 * BODIES, ROWS = 2 * PINS, STAGES = 8 };
typedef long double real;

typedef struct pin {
    int a, b; /* -1: the ground */
    real pa[2], pb[2], stiffness, damping, rest;
} pin;

typedef struct linkage {
    const char *name;
    int nbody, npin;
    real mass[BODIES], inertia[BODIES], load[BODIES][3], start[3 * BODIES];
    pin joint[PINS];
    bool spring; /* the squeezer's, from the ground to body 2 */
    real end, step;
} linkage;

/* ---- equations of motion: M a = f - G^T l, G a = c ---- */

typedef struct arm { /* from the centre of mass to the joint, world axes */
    real x, y;
} arm;

static arm arm_of(const real *x, int body, const real p[2]) {
    if (body < 0) return (arm){p[0], p[1]};
    real c = cosl(x[3 * body + 2]), s = sinl(x[3 * body + 2]);
    return (arm){c * p[0] - s * p[1], s * p[0] + c * p[1]};
}

static void springs(const linkage *m, const real *x, const real *v, real f[BODIES][3]) {
    for (int j = 0; j < m->npin; j++) {
        const pin *p = &m->joint[j];
        real angle = (p->b < 0 ? 0 : x[3 * p->b + 2]) - (p->a < 0 ? 0 : x[3 * p->a + 2]) - p->rest;
        real rate = (p->b < 0 ? 0 : v[3 * p->b + 2]) - (p->a < 0 ? 0 : v[3 * p->a + 2]);
        real torque = -p->stiffness * angle - p->damping * rate;
        if (p->b >= 0) f[p->b][2] += torque;
        if (p->a >= 0) f[p->a][2] -= torque;
    }
    if (!m->spring) return;
    const real at[2] = {.00957L, .00074L};
    arm r = arm_of(x, 2, at);
    real dx = x[6] + r.x - .014L, dy = x[7] + r.y - .072L, length = sqrtl(dx * dx + dy * dy);
    real pull = -4530 * (length - .07785L) / length, fx = pull * dx, fy = pull * dy;
    f[2][0] += fx, f[2][1] += fy, f[2][2] += r.x * fy - r.y * fx;
}

/* row i of pair j: coefficients of the body's (ax, ay, alpha) in the joint's acceleration */
static void solve(int n, real s[ROWS][ROWS + 1]) {
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabsl(s[i][k]) > fabsl(s[best][k])) best = i;
        for (int i = 0; best != k && i <= n; i++) {
            real t = s[k][i];
            s[k][i] = s[best][i], s[best][i] = t;
        }
        for (int i = k + 1; i < n; i++) {
            if (s[i][k] == 0) continue;
            real factor = s[i][k] / s[k][k];
            for (int c = k; c <= n; c++)
                s[i][c] -= factor * s[k][c];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int c = k + 1; c < n; c++)
            s[k][n] -= s[k][c] * s[c][n];
        s[k][n] /= s[k][k];
    }
}

static void accelerations(const linkage *m, const real *x, const real *v, real *acc) {
    static real s[ROWS][ROWS + 1], g[ROWS][3 * BODIES];
    const int n = 2 * m->npin, nq = 3 * m->nbody;
    real f[BODIES][3];
    memcpy(f, m->load, sizeof f);
    springs(m, x, v, f);
    memset(g, 0, sizeof g);
    for (int j = 0; j < m->npin; j++) {
        const pin *p = &m->joint[j];
        s[2 * j][n] = s[2 * j + 1][n] = 0;
        for (int side = 0; side < 2; side++) {
            int body = side ? p->b : p->a;
            if (body < 0) continue;
            real sign = side ? 1 : -1, w = v[3 * body + 2];
            arm r = arm_of(x, body, side ? p->pb : p->pa);
            g[2 * j][3 * body] += sign, g[2 * j][3 * body + 2] -= sign * r.y;
            g[2 * j + 1][3 * body + 1] += sign, g[2 * j + 1][3 * body + 2] += sign * r.x;
            s[2 * j][n] -= sign * w * w * r.x, s[2 * j + 1][n] -= sign * w * w * r.y;
        }
    }
    for (int i = 0; i < n; i++) { /* G M^-1 G^T l = G M^-1 f - c, with c = -(centripetal) */
        for (int k = 0; k < n; k++)
            s[i][k] = 0;
        for (int q = 0; q < nq; q++) {
            if (g[i][q] == 0) continue;
            real share = g[i][q] / (q % 3 == 2 ? m->inertia[q / 3] : m->mass[q / 3]);
            for (int k = 0; k < n; k++)
                if (g[k][q] != 0) s[i][k] += share * g[k][q];
            s[i][n] += share * f[q / 3][q % 3];
        }
    }
    solve(n, s);
    for (int q = 0; q < nq; q++) {
        acc[q] = f[q / 3][q % 3];
        for (int i = 0; i < n; i++)
            acc[q] -= g[i][q] * s[i][n];
        acc[q] /= q % 3 == 2 ? m->inertia[q / 3] : m->mass[q / 3];
    }
}

/* ---- one step of y = (x, v) ---- */

static void slope(const linkage *m, const real *y, real *dy) {
    const int nq = 3 * m->nbody;
    memcpy(dy, y + nq, (size_t)nq * sizeof *y);
    accelerations(m, y, y + nq, dy + nq);
}

/* change of y over h by n midpoint steps: as a change, so that extrapolation enlarges the round-off
 * of small numbers only */
static void midpoint(const linkage *m, const real *y, real h, int n, real *out) {
    const int ny = 6 * m->nbody;
    real before[STATE] = {0}, now[STATE], at[STATE], f[STATE], d = h / n;
    slope(m, y, f);
    for (int i = 0; i < ny; i++)
        now[i] = d * f[i];
    for (int k = 1; k <= n; k++) {
        for (int i = 0; i < ny; i++)
            at[i] = y[i] + now[i];
        slope(m, at, f);
        for (int i = 0; i < ny; i++) {
            real next = before[i] + 2 * d * f[i];
            if (k == n) out[i] = (before[i] + now[i] + d * f[i]) / 2;
            before[i] = now[i], now[i] = next;
        }
    }
}

static void step(const linkage *m, const real *y, real h, real *out) {
    static real table[STAGES][STATE];
    const int ny = 6 * m->nbody;
    for (int k = 0; k < STAGES; k++) {
        midpoint(m, y, h, 2 * (k + 1), table[k]);
        for (int j = k - 1; j >= 0; j--) {
            real ratio = (real)(k + 1) / (real)(j + 1);
            for (int i = 0; i < ny; i++)
                table[j][i] =
                    table[j + 1][i] + (table[j + 1][i] - table[j][i]) / (ratio * ratio - 1);
        }
    }
    for (int i = 0; i < ny; i++)
        out[i] = y[i] + table[0][i];
}

/* ---- a whole motion ---- */

typedef struct found {
    real peak[PINS], y[STATE];
} found;

static real relative(const pin *p, const real *y) {
    return (p->b < 0 ? 0 : y[3 * p->b + 2]) - (p->a < 0 ? 0 : y[3 * p->a + 2]);
}

/* where the rate of a joint vanishes within a step: regula falsi (Illinois), each trial a step from
 * `from` */
static real turning(const linkage *m, const pin *p, const real *from, real h, real r0, real r1) {
    const int nq = 3 * m->nbody;
    real low = 0, high = h, at[STATE];
    for (int i = 0; i < 60; i++) {
        real t = low + (high - low) * r0 / (r0 - r1);
        step(m, from, t, at);
        real r = relative(p, at + nq);
        if (r == 0 || high - low < 1e-12L * h) break;
        if ((r > 0) == (r0 > 0))
            low = t, r0 = r, r1 /= 2;
        else
            high = t, r1 = r, r0 /= 2;
        if (fabsl(r) < 1e-18L * fabsl(r1 - r0)) break;
    }
    return relative(p, at);
}

static void widen(real *peak, real angle) {
    if (fabsl(angle) > fabsl(*peak)) *peak = angle;
}

typedef void (*visitor)(int steps, const real *y, void *context);

static found run(const linkage *m, real h, visitor visit, void *context) {
    const int nq = 3 * m->nbody, n = (int)(m->end / h + .5L);
    found f = {0};
    real next[STATE];
    memcpy(f.y, m->start, (size_t)nq * sizeof *f.y);
    for (int k = 0; k <= n; k++) {
        for (int j = 0; j < m->npin; j++)
            widen(&f.peak[j], relative(&m->joint[j], f.y));
        if (visit) visit(k, f.y, context);
        if (k == n) break;
        step(m, f.y, h, next);
        for (int j = 0; j < m->npin; j++) {
            real r0 = relative(&m->joint[j], f.y + nq), r1 = relative(&m->joint[j], next + nq);
            if (r0 * r1 < 0) widen(&f.peak[j], turning(m, &m->joint[j], f.y, h, r0, r1));
        }
        memcpy(f.y, next, sizeof next);
    }
    return f;
}

/* ---- the mechanisms ---- */

static void place(const linkage *m, int body, real x, real y, real p[2]) {
    if (body < 0) {
        p[0] = x, p[1] = y;
        return;
    }
    const real *q = m->start + 3 * body; /* these bodies start unrotated */
    p[0] = x - q[0], p[1] = y - q[1];
}

static linkage six_bar(void) {
    linkage m = {.name = "six-bar", .nbody = 5, .npin = 6, .end = 10, .step = .02L};
    for (int b = 0; b < 5; b++) {
        /* decimal numbers, to all digits: what a double adds is taken off again */
        m.mass[b] = roundl(1e6L * (real)six_mass[b]) / 1e6L;
        m.inertia[b] = roundl(1e6L * (real)six_inertia[b]) / 1e6L;
        for (int i = 0; i < 2; i++)
            m.start[3 * b + i] = roundl(1e6L * (real)six_centre[b][i]) / 1e6L;
    }
    for (int j = 0; j < 6; j++) {
        pin *p = &m.joint[j];
        *p = (pin){.a = j - 1, .b = j < 5 ? j : -1};
        real x = roundl(1e6L * (real)six_hinge[j][0]) / 1e6L,
             y = roundl(1e6L * (real)six_hinge[j][1]) / 1e6L;
        place(&m, p->a, x, y, p->pa), place(&m, p->b, x, y, p->pb);
        p->stiffness = roundl(1e6L * (real)six_stiffness[j]) / 1e6L;
        p->damping = roundl(1e6L * (real)six_damping[j]) / 1e6L;
    }
    m.load[2][0] = .35L, m.load[2][1] = -.20L, m.load[0][2] = -.15L;
    return m;
}

/* mechanism, constants and start of Mazzia and Magherini, Test Set for IVP Solvers, II-18; the
 * start in quad precision */
static linkage squeezer(void) {
    static const real body[7][5] = {{.04325L, 2.194e-6L, 9.18248598030761435996e-04L,
                                     -5.67407456290548322244e-05L, -6.17138900142764496359e-02L},
                                    {.00365L, 4.410e-7L, -4.49143335993307224128e-03L,
                                     2.77536255794289940228e-04L, -6.17138900142764496359e-02L},
                                    {.02373L, 5.255e-6L, -1.87421866703154576219e-02L,
                                     2.04851067890739304766e-02L, 4.55279819163070380256e-01L},
                                    {.00706L, 5.667e-7L, -3.02229398301588874216e-02L,
                                     1.20711823566639393233e-02L, 7.10033369709728434900e-01L},
                                    {.07050L, 1.169e-5L, -5.32368281557041386557e-02L,
                                     1.66318479666163072100e-02L, 4.87364979543842550226e-01L},
                                    {.00706L, 5.667e-7L, -2.85432685367836040722e-02L,
                                     -1.07222547072522878576e-02L, 1.00787905438393530782e+00L},
                                    {.05498L, 1.912e-5L, -5.62655817857573480277e-02L,
                                     -2.13550702962614190007e-03L, 1.23054744454982119250e+00L}};
    linkage m = {
        .name = "squeezer",
        .nbody = 7,
        .npin = 10,
        .spring = true,
        .end = .03L,
        .step = 5e-5L,
        .joint = {{.a = -1, .b = 0, .pb = {-.00092L, 0}},
                  {.a = 0, .b = 1, .pa = {.00608L, 0}, .pb = {.0115L, 0}},
                  {.a = 1, .b = 2, .pa = {-.0165L, 0}, .pb = {-.01043L, -.01626L}},
                  {.a = 1, .b = 3, .pa = {-.0165L, 0}, .pb = {0, -.01421L}},
                  {.a = 1, .b = 5, .pa = {-.0165L, 0}, .pb = {.01421L, 0}},
                  {.a = -1, .b = 2, .pa = {-.03635L, .03273L}, .pb = {-.01043L, .01874L}},
                  {.a = 3, .b = 4, .pa = {0, .00579L}, .pb = {.01692L, -.00916L}},
                  {.a = -1, .b = 4, .pa = {-.06934L, -.00227L}, .pb = {-.02308L, -.00916L}},
                  {.a = 5, .b = 6, .pa = {-.00579L, 0}, .pb = {-.00449L, -.02772L}},
                  {.a = -1, .b = 6, .pa = {-.06934L, -.00227L}, .pb = {-.00449L, .01228L}}}};
    for (int b = 0; b < 7; b++) {
        m.mass[b] = body[b][0], m.inertia[b] = body[b][1];
        memcpy(m.start + 3 * b, body[b] + 2, 3 * sizeof(real));
    }
    m.load[0][2] = .033L;
    return m;
}

/* Windows: all cranks turn alike, so that N windows are one pendulum: angle a of a crank from the
   upright, T = ((N+1)/3 + N) a'^2 / 2, V = ((N+1)/2 + N) g cos a; RK4 in long double, 2^18 steps.
 */
typedef struct windows_end {
    real angle, rate;
} windows_end;

static windows_end windows(int n, real end) {
    const real k = (.5L * (n + 1) + n) * 9.81L / ((n + 1) / 3.L + n);
    enum { STEPS = 1 << 18 };
    windows_end y = {0, -1};
    const real h = end / STEPS;
    for (int i = 0; i < STEPS; i++) {
        real a1 = y.rate, r1 = k * sinl(y.angle);
        real a2 = y.rate + h / 2 * r1, r2 = k * sinl(y.angle + h / 2 * a1);
        real a3 = y.rate + h / 2 * r2, r3 = k * sinl(y.angle + h / 2 * a2);
        real a4 = y.rate + h * r3, r4 = k * sinl(y.angle + h * a3);
        y.angle += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4),
            y.rate += h / 6 * (r1 + 2 * r2 + 2 * r3 + r4);
    }
    return y;
}

/* ---- what is printed ---- */

static void print(const linkage *m) {
    found f = run(m, m->step, NULL, NULL);
    for (int j = 0; j < m->npin; j++)
        printf("%s,peak,%d,%.20Le\n", m->name, j, f.peak[j]);
    for (int q = 0; q < 3 * m->nbody; q++)
        printf("%s,end,%d,%.20Le\n", m->name, q, f.y[q]);
}

typedef struct table {
    FILE *file;
    int every;
    real worst;
} table;

/* a row of the quad table every 0.1 ms: t, q, v */
static void compare(int steps, const real *y, void *context) {
    table *t = context;
    char line[4096], *at = line;
    if (steps % t->every) return;
    do
        if (!fgets(line, sizeof line, t->file)) return;
    while (*line == '#');
    strtold(at, &at);
    for (int i = 0; i < 30; i++)
        t->worst = fmaxl(t->worst, fabsl(strtold(at, &at) - y[i]));
}

static real halved(const linkage *m) {
    found a = run(m, m->step, NULL, NULL), b = run(m, 2 * m->step, NULL, NULL);
    real worst = 0, size = 0;
    for (int j = 0; j < m->npin; j++) {
        worst = fmaxl(worst, fabsl(a.peak[j] - b.peak[j]));
        size = fmaxl(size, fabsl(a.peak[j]));
    }
    return worst / size;
}

static void check(const char *path) {
    static const real angle[7] = {15.810771195153707097L,  -15.75637105841183947L,
                                  .040822240119645804858L, -.53473011634207959377L,
                                  .52440996587995406937L,  .53473011634207959377L,
                                  1.0480807410419378731L};
    static const int part[7][2] = {{0, -1}, {0, 1}, {2, -1}, {3, 4}, {4, -1}, {5, 6}, {6, -1}};
    linkage m = six_bar();
    table t = {.file = fopen(path, "r"), .every = 5};
    if (!t.file) exit(2);
    run(&m, m.step, compare, &t);
    fclose(t.file);
    printf("six-bar,table,%.2Le\nsix-bar,peaks by steps twice as long,%.2Le\n", t.worst,
           halved(&m));
    m = squeezer();
    found f = run(&m, m.step, NULL, NULL);
    real worst = 0;
    for (int b = 0; b < 7; b++) {
        real want = angle[part[b][0]] + (part[b][1] < 0 ? 0 : angle[part[b][1]]);
        worst = fmaxl(worst, fabsl(f.y[3 * b + 2] - want));
    }
    printf("squeezer,table,%.2Le\nsqueezer,peaks by steps twice as long,%.2Le\n", worst,
           halved(&m));
    worst = 0;
    for (size_t i = 0; i < sizeof windows_reference / sizeof *windows_reference; i++) {
        windows_end e = windows(windows_reference[i].n, 10);
        const double *b = windows_reference[i].b0;
        real x = -sinl(e.angle), y = cosl(e.angle);
        worst = fmaxl(worst, fmaxl(fabsl(x - (real)b[0]), fabsl(y - (real)b[1])));
        worst =
            fmaxl(worst, fmaxl(fabsl(-e.rate * y - (real)b[2]), fabsl(e.rate * x - (real)b[3])));
    }
    printf("windows,table,%.2Le\n", worst);
}

int main(int argc, char **argv) {
    if (argc > 2 && strcmp(argv[1], "check") == 0) {
        check(argv[2]);
        return 0;
    }
    const linkage six = six_bar(), seven = squeezer();
    print(&six), print(&seven);
    static const int sizes[] = {4, 40};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        windows_end e = windows(sizes[i], 2);
        printf("windows-%d,angle,0,%.20Le\nwindows-%d,rate,0,%.20Le\n", sizes[i], e.angle, sizes[i],
               e.rate);
    }
    return 0;
}
