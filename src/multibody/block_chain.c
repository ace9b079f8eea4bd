/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/model.h"
#include <math.h>
#include <string.h>

/* ---- S where every block is a pin ---- */

/* with p(r) = (-r_y, r_x) the rows of pin i on body b are +-[I, p(r_i)], so the block of pins i, j
   that share b is +-(I/m + p(r_i) p(r_j)^T / J); 15 flops per pin and body */
static void assemble_pins(fw_model *m) {
    fw_chain *restrict c = &m->chain;
    const double *restrict arm = m->arm, *restrict minv = m->minv, *restrict jinv = m->jinv;
    for (int i = 0; i < c->pins; i++) {
        int a = m->body[2 * i], b = m->body[2 * i + 1];
        double ax = arm[4 * i], ay = arm[4 * i + 1], bx = arm[4 * i + 2], by = arm[4 * i + 3];
        double mass = minv[a] + minv[b], ja = jinv[a], jb = jinv[b];
        c->diagonal[3 * i] = mass + ja * ay * ay + jb * by * by;
        c->diagonal[3 * i + 1] = -(ja * ax * ay + jb * bx * by);
        c->diagonal[3 * i + 2] = mass + ja * ax * ax + jb * bx * bx;
    }
    for (int i = 0; i < c->ncoupling; i++) {
        const fw_coupling *k = &c->coupling[i];
        const double *r = arm + 2 * k->row_arm, *s = arm + 2 * k->column_arm;
        double *to = c->block + 4 * k->block;
        double mass = k->sign * minv[k->body], j = k->sign * jinv[k->body];
        to[0] += mass + j * r[1] * s[1];
        to[1] -= j * r[1] * s[0];
        to[2] -= j * r[0] * s[1];
        to[3] += mass + j * r[0] * s[0];
    }
}

/* ---- S of any blocks, from their 2 x 3 Jacobians ---- */

/* row k of g times M^-1 times row l of h */
static double weighted(const double *g, int k, const double *h, int l, double minv, double jinv) {
    g += 3 * k, h += 3 * l;
    return minv * (g[0] * h[0] + g[1] * h[1]) + jinv * g[2] * h[2];
}

static void assemble_any(fw_model *m) {
    fw_chain *c = &m->chain;
    for (int i = 0; i < c->pins; i++) {
        double *d = c->diagonal + 3 * i;
        fw_rows rows = m->block[i].rows;
        d[0] = d[1] = 0;
        d[2] = rows == FW_ROWS_PIN || rows == FW_ROWS_SLIDE ? 0 : 1; /* an empty row: lambda = 0 */
        for (int side = 0; side < 2; side++) {
            int body = m->body[2 * i + side];
            const double *g = m->jac + 12 * i + 6 * side;
            double minv = m->minv[body], jinv = m->jinv[body];
            d[0] += weighted(g, 0, g, 0, minv, jinv);
            d[1] += weighted(g, 0, g, 1, minv, jinv);
            d[2] += weighted(g, 1, g, 1, minv, jinv);
        }
    }
    for (int i = 0; i < c->ncoupling; i++) {
        const fw_coupling *k = &c->coupling[i];
        const double *g = m->jac + 6 * k->row_arm, *h = m->jac + 6 * k->column_arm;
        double *to = c->block + 4 * k->block, minv = m->minv[k->body], jinv = m->jinv[k->body];
        for (int e = 0; e < 4; e++)
            to[e] += weighted(g, e / 2, h, e % 2, minv, jinv);
    }
}

/* S = G M^-1 G^T in 2 x 2 blocks along the joint graph. Inputs: the pose (arms or jac), minv, jinv;
   outputs diagonal (3 pins), block (4 blocks). Exact but for rounding. Cost O(pins). Source:
   reference-point coordinates, e.g. Garcia de Jalon and Bayo 1994, ch. 2 and 5. Test:
   test_block_chain.c. */
void fw_chain_assemble(fw_model *m) {
    memset(m->chain.block, 0, 4 * (size_t)m->chain.blocks * sizeof *m->chain.block);
    if (m->plain)
        assemble_pins(m);
    else
        assemble_any(m);
}

/* S + eps D = L D L^T, D = 1/m_a + 1/m_b for pins, column by column in the compiled order. The
   shift goes with the smaller eigenvalue of a pin's block: one that went with the larger, r^2/J,
   would drown it where J is small against m r^2. Outputs pivot (inverse pivot blocks), factor (L).
   `block` is used up. Error: backward stable, S + eps D is positive definite. Cost: chains and
   rings O(pins). Source: Golub and Van Loan, Matrix Computations, ch. 4. Test: test_block_chain.c.
 */
bool fw_chain_factor(fw_chain *c, double epsilon) {
    double *restrict d = c->diagonal, *restrict block = c->block, *restrict factor = c->factor;
    c->shift = epsilon;
    for (int i = 0; i < c->pins; i++) {
        d[3 * i] += epsilon * c->isotropic[2 * i];
        d[3 * i + 2] += epsilon * c->isotropic[2 * i + 1];
    }
    bool positive = true;
    for (int k = 0; k < c->pins; k++) {
        double xx = d[3 * k], xy = d[3 * k + 1], yy = d[3 * k + 2];
        double determinant = xx * yy - xy * xy;
        positive &= xx > 0 && determinant > 0;
        double inverse = 1 / determinant;
        double px = yy * inverse, pxy = -xy * inverse, py = xx * inverse;
        c->pivot[3 * k] = px, c->pivot[3 * k + 1] = pxy, c->pivot[3 * k + 2] = py;
        for (int e = c->column[k]; e < c->column[k + 1]; e++) {
            const double *b = block + 4 * e;
            double *l = factor + 4 * e, *to = d + 3 * c->row[e];
            double l0 = b[0] * px + b[1] * pxy, l1 = b[0] * pxy + b[1] * py;
            double l2 = b[2] * px + b[3] * pxy, l3 = b[2] * pxy + b[3] * py;
            l[0] = l0, l[1] = l1, l[2] = l2, l[3] = l3;
            to[0] -= l0 * b[0] + l1 * b[1];
            to[1] -= l0 * b[2] + l1 * b[3];
            to[2] -= l2 * b[2] + l3 * b[3];
        }
        for (int u = c->first[k]; u < c->first[k + 1]; u++) {
            const double *l = factor + 4 * c->update[u].left, *b = block + 4 * c->update[u].right;
            double *to = block + 4 * c->update[u].to;
            to[0] -= l[0] * b[0] + l[1] * b[1];
            to[1] -= l[0] * b[2] + l[1] * b[3];
            to[2] -= l[2] * b[0] + l[3] * b[1];
            to[3] -= l[2] * b[2] + l[3] * b[3];
        }
    }
    return positive;
}

void fw_chain_solve(const fw_chain *c, double *restrict x) {
    const double *restrict factor = c->factor;
    for (int k = 0; k < c->pins; k++) {
        double x0 = x[2 * k], x1 = x[2 * k + 1];
        for (int e = c->column[k]; e < c->column[k + 1]; e++) {
            const double *l = factor + 4 * e;
            double *to = x + 2 * c->row[e];
            to[0] -= l[0] * x0 + l[1] * x1;
            to[1] -= l[2] * x0 + l[3] * x1;
        }
    }
    for (int k = c->pins - 1; k >= 0; k--) {
        const double *p = c->pivot + 3 * k;
        double x0 = p[0] * x[2 * k] + p[1] * x[2 * k + 1];
        double x1 = p[1] * x[2 * k] + p[2] * x[2 * k + 1];
        for (int e = c->column[k]; e < c->column[k + 1]; e++) {
            const double *l = factor + 4 * e, *from = x + 2 * c->row[e];
            x0 -= l[0] * from[0] + l[2] * from[1];
            x1 -= l[1] * from[0] + l[3] * from[1];
        }
        x[2 * k] = x0, x[2 * k + 1] = x1;
    }
}

/* S x = right without a rank decision: x += (S + eps D)^-1 (right - S x). After a sweep with step d
   the residual is exactly eps D d, so the next right-hand side costs nothing. Two sweeps always,
   more while the residual exceeds 1e-14 |right|, at most six. The error in a mode with relative
   eigenvalue s shrinks by eps/(s + eps) per sweep; modes with s = 0 are redundant rows and do not
   move a body. Source: proximal point algorithm, Rockafellar 1976; Carpentier et al., RSS 2021.
   Test: test_block_chain.c. */
void fw_chain_proximal(const fw_chain *c, const double *right, double *x, double *more) {
    int n = 2 * c->pins;
    double size = 0;
    for (int i = 0; i < n; i++) {
        size = fmax(size, fabs(right[i]));
        more[i] = right[i];
        x[i] = 0;
    }
    for (int sweep = 0; sweep < 6; sweep++) {
        fw_chain_solve(c, more);
        double residual = 0;
        for (int i = 0; i < n; i++) {
            x[i] += more[i];
            more[i] *= c->shift * c->isotropic[i];
            residual = fmax(residual, fabs(more[i]));
        }
        if (sweep > 0 && !(residual > 1e-14 * size)) return;
    }
}
