/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the elastica: nodes, sections there, and what the collocation needs of them. */
#include "flexure/elastica_core.h"
#include "flexure/gauss.h"
#include <math.h>
#include <string.h>

/* value at x of the Lagrange polynomial of z[k] */
static double lagrange(int n, const double *z, int k, double x) {
    double product = 1;
    for (int i = 0; i < n; i++)
        if (i != k) product *= (x - z[i]) / (z[k] - z[i]);
    return product;
}

void fw_flexure_rule_fill(fw_flexure_rule *rule) {
    double node[FW_NODES], weight[FW_NODES], a[FW_NODES * FW_NODES], z[FW_NODES + 2];
    fw_flexure_gauss_rule(FW_NODES, node, weight);
    fw_flexure_gauss_integrals(FW_NODES, node, weight, a);
    z[0] = 0, z[FW_NODES + 1] = 1;
    for (int i = 0; i < FW_NODES; i++) {
        rule->node[i] = z[i + 1] = node[i];
        rule->weight[i] = weight[i];
        for (int j = 0; j < FW_NODES; j++)
            rule->column[j][i] = a[i * FW_NODES + j];
    }
    for (int half = 0; half < 2; half++)
        for (int i = 0; i < FW_NODES; i++)
            for (int k = 0; k < FW_NODES + 2; k++)
                rule->finer[half][i][k] = lagrange(FW_NODES + 2, z, k, 0.5 * (half + node[i]));
}

/* sections at the nodes of an element whose piece, from and h are set; with D = diag(1/EI) and A
   the collocation matrix, phi = phi0 + h A D (M0 + h A m) = phi0 + turned M0 + twice m */
void fw_flexure_element_fill(const fw_flexure_elastica *e, fw_flexure_element *el) {
    const fw_flexure_rule *r = &e->rule;
    const fw_flexure_beam_pose *start = &e->pose[el->piece];
    fw_flexure_beam_section at, ends[2];
    double l = e->length_m, C = e->soft, h = el->h;
    for (int i = 0; i < FW_NODES; i++) {
        fw_flexure_beam_at(e->beam, el->piece, start, l * (el->from + h * r->node[i]), &at);
        el->psi[i] = at.pose.psi_rad;
        el->cos_made[i] = cos(at.pose.psi_rad);
        el->sin_made[i] = sin(at.pose.psi_rad);
        el->bend[i] = at.bend_per_Nm2 * l / C;
        el->axial[i] = at.axial_per_N / (C * l);
        el->shear[i] = at.shear_per_N / (C * l);
    }
    for (int end = 0; end < 2; end++)
        fw_flexure_beam_at(e->beam, el->piece, start, l * (el->from + h * end), &ends[end]);
    el->dx = (ends[1].pose.x_m - ends[0].pose.x_m) / l;
    el->dy = (ends[1].pose.y_m - ends[0].pose.y_m) / l;
    el->once_end = h * r->weight;
    el->turn = 0;
    el->turned = el->twice_end = (fw_nodes){0};
    for (int j = 0; j < FW_NODES; j++) {
        double to_end = 0;
        el->turn += el->once_end[j] * el->bend[j];
        el->turned += h * el->bend[j] * r->column[j];
        el->twice[j] = (fw_nodes){0};
        for (int k = 0; k < FW_NODES; k++) {
            el->twice[j] += h * h * el->bend[k] * r->column[j][k] * r->column[k];
            to_end += h * el->once_end[k] * el->bend[k] * r->column[j][k];
        }
        el->twice_end[j] = to_end;
    }
}

void fw_flexure_mesh_fill(fw_flexure_elastica *e, int level) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    if (mesh->made) return;
    double cumulative = e->hinged ? 0 : e->root[0];
    fw_flexure_element *el = mesh->element;
    for (int piece = 0; piece < e->beam->npiece; piece++) {
        int n = e->per_piece[piece] << level;
        double h = e->beam->piece[piece].length_m / e->length_m / n;
        for (int i = 0; i < n; i++, el++) {
            el->piece = piece;
            el->from = i * h;
            el->h = h;
            fw_flexure_element_fill(e, el);
            el->cumulative = cumulative;
            cumulative += el->turn;
        }
    }
    mesh->made = true;
}

void fw_flexure_mesh_refine(fw_flexure_elastica *e, int level) {
    const fw_flexure_mesh *from = &e->mesh[level];
    fw_flexure_mesh *to = &e->mesh[level + 1];
    fw_flexure_mesh_fill(e, level + 1);
    for (int n = 0; n < from->count; n++) {
        double z[FW_NODES + 2];
        const fw_flexure_element *el = &from->element[n];
        z[0] = el->start;
        memcpy(z + 1, &el->phi, sizeof el->phi);
        z[FW_NODES + 1] = n + 1 < from->count ? el[1].start : from->end;
        for (int half = 0; half < 2; half++) {
            double phi[FW_NODES];
            for (int i = 0; i < FW_NODES; i++) {
                const double *w = e->rule.finer[half][i];
                double sum = 0;
                for (int k = 0; k < FW_NODES + 2; k++)
                    sum += w[k] * z[k];
                phi[i] = sum;
            }
            memcpy(&to->element[2 * n + half].phi, phi, sizeof phi);
        }
    }
}
