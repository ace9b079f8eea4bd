/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/path_sections.h"
#include "flexure/beam.h"
#include "flexure/section.h"
#include <math.h>

static double per_youngs(const fw_flexure_path_stuff *m, double psi_rad) {
    const fw_flexure_crystal *k = &m->elastic;
    if (!k->known) return 1 / m->youngs_Pa;
    return k->a0_per_Pa + k->a1_per_Pa * (k->cos4 * cos(4 * psi_rad) - k->sin4 * sin(4 * psi_rad));
}

static double per_shear(const fw_flexure_path_stuff *m, double psi_rad) {
    const fw_flexure_crystal *k = &m->elastic;
    if (!k->known) return 2 * (1 + m->poisson) / m->youngs_Pa;
    return k->g0_per_Pa + k->g1_per_Pa * (k->cos4 * cos(4 * psi_rad) - k->sin4 * sin(4 * psi_rad));
}

static fw_flexure_depth depth_at(const fw_flexure_path_stuff *m, double deep) {
    if (m->elastic.known) return fw_flexure_depth_crystal(deep, &m->elastic, m->youngs_Pa);
    return fw_flexure_depth_at(deep, m->poisson);
}

/* In: place, m, Pa; out: what a section gives per moment and force, SI. Formulas:
   fw_flexure_path. Cost 60 to 120 ns. Test: test_path.c */
void fw_flexure_path_section_at(const fw_flexure_course *p, const fw_flexure_path_stuff *m, int i,
                                double s_m, fw_flexure_path_section *out) {
    double k = p->shape[i].piece.curvature_per_m, t = fw_geometry_strip_width(&p->shape[i], s_m);
    double R = 1 / fabs(k), u = 0.5 * t * fabs(k), h = m->depth_m > 0 ? m->depth_m : 1;
    *out = (fw_flexure_path_section){.pose = fw_geometry_strip_along(p->start[i], k, s_m),
                                     .width_m = t,
                                     .depth = {1, 1, 1, 1, 1},
                                     .golovin = 1};
    double psi = out->pose.angle_rad, per_E = per_youngs(m, psi), per_A = 1 / (h * t);
    double e = 0, bend = 12 * per_E * per_A / (t * t), force = bend, share = 1;
    if (k != 0) {
        e = fw_flexure_neutral_offset(R, u);
        share = (R - e) / R;
        force = per_E * per_A / (e * R);
        out->golovin = fw_flexure_golovin(u);
        out->curved = k * t / 3.0;
        if (m->depth_m > 0) out->depth = depth_at(m, h / sqrt(R * t));
    }
    double D = out->depth.stiffness, towards = copysign(e, k);
    out->thin_per_Nm2 = bend;
    out->bend_per_Nm2 = bend / (D * out->golovin);
    out->force_per_Nm2 = force / D;
    out->stretch_per_N = per_E * per_A * share / D;
    out->shear_per_N = 1.2 * per_shear(m, psi) * per_A;
    out->neutral_x_m = out->pose.x_m - towards * sin(psi);
    out->neutral_y_m = out->pose.y_m + towards * cos(psi);
}

/* of a crystal the block counts with its mean modulus (fw_flexure_root_m_per_Pa) */
void fw_flexure_path_root(const fw_flexure_course *p, const fw_flexure_path_stuff *m, int end,
                          fw_flexure_path_section *at, double *root_m) {
    int i = end ? p->n - 1 : 0;
    fw_flexure_path_section_at(p, m, i, end ? p->shape[i].piece.length_m : 0, at);
    *root_m = p->root_m[end];
    if (!m->elastic.known || p->concentration[end] == 1) return;
    double block = fw_flexure_root_block_m(at->width_m, 0), mean = m->elastic.a0_per_Pa;
    double along = per_youngs(m, at->pose.angle_rad);
    *root_m = (block * mean + (p->root_m[end] - block) * along) / along;
}

/* mean of P over exp(-s/l) along the arc (line) that the strip ends with: P + l (T + q N)/(1 +
   q^2), T inwards, N to the centre of curvature, q = l/R */
void fw_flexure_path_end_loss(const fw_flexure_course *p, const fw_flexure_path_stuff *m, int end,
                              fw_flexure_path_section *at, double *loss_m) {
    double root, length = 0, f = 1;
    fw_flexure_path_root(p, m, end, at, &root);
    *loss_m = 0;
    if (!m->elastic.known) return;
    for (int i = 0; i < p->n; i++)
        length += p->shape[i].piece.length_m;
    double k = p->shape[end ? p->n - 1 : 0].piece.curvature_per_m, t = at->width_m;
    double h = m->end_depth_m, inwards = end ? -1 : 1, psi = at->pose.angle_rad;
    double block = p->concentration[end] == 1 ? 0 : fw_flexure_root_block_m(t, 0);
    if (k != 0) f = depth_at(m, h * sqrt(fabs(k) / t)).bow;
    const fw_flexure_end_loss loss = fw_flexure_end_loss_of(&m->elastic, h, f, length, block);
    double q = loss.reach_m * k, far = loss.reach_m / (1 + q * q); /* N: to the left times k */
    at->neutral_x_m = at->pose.x_m + far * (inwards * cos(psi) - q * sin(psi));
    at->neutral_y_m = at->pose.y_m + far * (inwards * sin(psi) + q * cos(psi));
    *loss_m = m->elastic.bow_per_Pa * loss.length_m / per_youngs(m, psi);
}

/* mean modulus of a crystal: what the whole strip bends like, int ds/I / int ds/(E I) */
fw_flexure_path_stuff fw_flexure_path_stuff_of(const fw_flexure_course *p,
                                               const fw_flexure_input *in) {
    double node[FW_GAUSS_MOST], weight[FW_GAUSS_MOST], bend = 0, soft = 0;
    fw_flexure_path_stuff m = {.youngs_Pa = in->youngs_Pa,
                               .poisson = in->poisson,
                               .depth_m = in->depth_m,
                               .end_depth_m = in->depth_m};
    m.elastic = fw_flexure_elastic_of(in);
    if (!in->crystal.known) return m;
    fw_flexure_gauss_rule(FW_GAUSS_MOST, node, weight);
    enum { PANELS = 8 };
    for (int i = 0; i < p->n; i++)
        for (int j = 0; j < PANELS * FW_GAUSS_MOST; j++) {
            double h = p->shape[i].piece.length_m / PANELS;
            double s = (j / FW_GAUSS_MOST + node[j % FW_GAUSS_MOST]) * h;
            double t = fw_geometry_strip_width(&p->shape[i], s);
            double psi = p->start[i].angle_rad + p->shape[i].piece.curvature_per_m * s;
            double w = h * weight[j % FW_GAUSS_MOST] / (t * t * t);
            bend += w, soft += w * per_youngs(&m, psi);
        }
    m.youngs_Pa = bend / soft;
    m.poisson = -in->crystal.s12_per_Pa * m.youngs_Pa;
    return m;
}

double fw_flexure_path_fibre_factor(const fw_flexure_path_section *at) {
    double c = fabs(at->curved);
    return fmax((1 + c) * at->depth.inner, (1 - c) * at->depth.outer);
}

double fw_flexure_path_root_factor(const fw_flexure_input *in, const fw_flexure_path_stuff *m,
                                   int end, const fw_flexure_path_section *at) {
    if (in->fillet_m < 0) return fw_flexure_path_fibre_factor(at);
    const fw_flexure_root_case root = {.width_m = at->width_m,
                                       .fillet_m = in->fillet_m,
                                       .depth_m = in->depth_m,
                                       .curved = at->curved,
                                       .poisson = m->poisson,
                                       .bow = at->depth.bow,
                                       .end = end ? 1 : -1,
                                       .angle_rad = at->pose.angle_rad};
    return fw_flexure_root_peak(&root, &in->crystal);
}

/* stress M t/2/(I D g) over the modulus that strains are counted in */
double fw_flexure_path_fibre(const fw_flexure_path_section *at, double youngs_Pa,
                             const fw_flexure_path_stuff *m) {
    double t = at->width_m, h = m->depth_m > 0 ? m->depth_m : 1;
    double section = h * t * t * t / 12 * at->depth.stiffness * at->golovin;
    return 0.5 * t / (section * youngs_Pa) * fw_flexure_path_fibre_factor(at);
}

/* ---- places ---- */

fw_geometry_vec2 fw_flexure_path_edge(const fw_flexure_course *p, int i, double part, int side) {
    const fw_geometry_strip_shape *f = &p->shape[i];
    double s = part * f->piece.length_m;
    double off = fw_geometry_strip_aside(f, s) + 0.5 * side * fw_geometry_strip_width(f, s);
    fw_geometry_pose at = fw_geometry_strip_along(p->start[i], f->piece.curvature_per_m, s);
    return (fw_geometry_vec2){at.x_m - off * sin(at.angle_rad), at.y_m + off * cos(at.angle_rad)};
}

double fw_flexure_path_nearest(const fw_flexure_course *p, double x_m, double y_m) {
    enum { PLACES = 48 };
    double least = HUGE_VAL, where = 0, before = 0;
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        for (int k = 0; k <= PLACES; k++) {
            double s = q->length_m * k / PLACES;
            fw_geometry_pose at = fw_geometry_strip_along(p->start[i], q->curvature_per_m, s);
            double far = hypot(at.x_m - x_m, at.y_m - y_m);
            if (far < least) least = far, where = before + s;
        }
        before += q->length_m;
    }
    return where / before;
}
