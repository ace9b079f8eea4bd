/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gauss-Legendre rules on [0, 1]. Private to the room. */
#ifndef FW_FLEXURE_GAUSS_H
#define FW_FLEXURE_GAUSS_H

enum { FW_GAUSS_MOST = 16 };

/* n nodes in rising order and their weights, which add up to 1 */
void fw_flexure_gauss_rule(int n, double *node, double *weight);
/* a[i * n + j] = integral of the j-th Lagrange polynomial of the nodes from 0 to node i: the
   collocation method of order 2 n */
void fw_flexure_gauss_integrals(int n, const double *node, const double *weight, double *a);

#endif
