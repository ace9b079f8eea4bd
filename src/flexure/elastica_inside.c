/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is inside a solved beam: section forces, strain, energy. */
#include "flexure/elastica_core.h"
#include <math.h>
#include <string.h>

/* values at the start of element n of the solved mesh; its rotations are those of the solution, the
   passes change none */
static const fw_flexure_element *walk(fw_flexure_elastica *e, int n, fw_flexure_carried *at) {
    const fw_flexure_mesh *mesh = &e->mesh[e->solved];
    fw_flexure_elastica_begin(e, at);
    for (int i = 0; i < n; i++)
        fw_flexure_element_pass(&mesh->element[i], &e->p[1], at);
    return &mesh->element[n];
}

/* from the start of an element over a part of it, as an element of its own: the unknowns are known,
   the rotations follow in a few passes */
static fw_flexure_carried partly(const fw_flexure_elastica *e, const fw_flexure_element *from,
                                 const fw_flexure_carried *start, double part) {
    fw_flexure_element el = {.piece = from->piece, .from = from->from, .h = part * from->h};
    fw_flexure_carried at = *start;
    fw_flexure_element_fill(e, &el);
    el.phi = start->value[PHI] + start->value[MOMENT] * el.turned;
    for (int i = 0; i < 12; i++) {
        double most = 0;
        at = *start;
        fw_flexure_element_pass(&el, &e->p[1], &at);
        el.phi += el.change[0];
        for (int k = 0; k < FW_NODES; k++)
            most = fmax(most, fabs(el.change[0][k]));
        if (most < 1e-15) break;
    }
    return at;
}

static double before_m(const fw_flexure_elastica *e, int piece) {
    double s = 0;
    for (int i = 0; i < piece; i++)
        s += e->beam->piece[i].length_m;
    return s;
}

static void describe(const fw_flexure_elastica *e, const fw_flexure_element *el, double part,
                     const fw_flexure_carried *at, fw_flexure_elastica_state *out) {
    double l = e->length_m, C = e->soft, s_m = l * (el->from + part * el->h);
    fw_flexure_beam_section made;
    fw_flexure_beam_at(e->beam, el->piece, &e->pose[el->piece], s_m, &made);
    double psi = made.pose.psi_rad + at->value[PHI], fx = e->p[1] / (C * l), fy = e->p[2] / (C * l);
    out->s_m = before_m(e, el->piece) + s_m;
    out->pose = (fw_flexure_beam_pose){made.pose.x_m + l * at->value[X],
                                       made.pose.y_m + l * at->value[Y], psi};
    out->rotation_rad = at->value[PHI];
    out->moment_Nm = at->value[MOMENT] / C;
    out->axial_N = fx * cos(psi) + fy * sin(psi);
    out->shear_N = fy * cos(psi) - fx * sin(psi);
    double stretch = out->axial_N * made.axial_per_N;
    double bend = 0.5 * made.width_m * out->moment_Nm * made.bend_per_Nm2;
    out->strain[0] = stretch - bend;
    out->strain[1] = stretch + bend;
}

static double larger(const fw_flexure_elastica_state *at) {
    return fmax(fabs(at->strain[0]), fabs(at->strain[1]));
}

/* in: s from 0 to the length of the beam (m), after a solution; out: state there, at a kink that
   behind it. Error that of the solution: the element before it is integrated afresh up to s, to
   order 16. Cost about 2 us. Test: test_elastica.c inside_a_wound_arc, energy_and_equilibrium */
void fw_flexure_elastica_at(fw_flexure_elastica *e, double s_m, fw_flexure_elastica_state *out) {
    const fw_flexure_mesh *mesh = e->solved < 0 ? NULL : &e->mesh[e->solved];
    *out = (fw_flexure_elastica_state){0};
    if (!mesh) return;
    int n = 0;
    double s = s_m / e->length_m;
    while (n + 1 < mesh->count && s >= mesh->element[n].h)
        s -= mesh->element[n++].h;
    fw_flexure_carried start, at;
    const fw_flexure_element *el = walk(e, n, &start);
    double part = fmin(fmax(s / el->h, 0), 1);
    at = partly(e, el, &start, part);
    describe(e, el, part, &at, out);
}

/* strain at the nodes of an element and at its ends, by the collocation polynomial */
static void at_places(const fw_flexure_elastica *e, const fw_flexure_element *el,
                      const fw_flexure_carried *start, fw_flexure_elastica_state *out) {
    enum { LAST = FW_NODES + 1 };
    fw_nodes moment = (fw_nodes){0} + start->value[MOMENT];
    for (int j = 0; j < FW_NODES; j++) {
        double psi = el->psi[j] + el->phi[j], c = cos(psi), s = sin(psi);
        double N = e->p[1] * c + e->p[2] * s, V = e->p[2] * c - e->p[1] * s;
        moment -= el->h * (1 + (el->axial[j] - el->shear[j]) * N) * V * e->rule.column[j];
    }
    for (int i = 0; i < FW_NODES; i++) {
        const fw_flexure_carried at = {.value = {el->phi[i], moment[i], 0, 0}};
        describe(e, el, e->rule.node[i], &at, &out[1 + i]);
    }
    describe(e, el, 0, start, &out[0]);
    fw_flexure_carried end = *start;
    fw_flexure_element copy = *el;
    fw_flexure_element_pass(&copy, &e->p[1], &end);
    describe(e, el, 1, &end, &out[LAST]);
}

/* golden section between two parts of an element; the largest |strain| there */
static void climb(const fw_flexure_elastica *e, const fw_flexure_element *el,
                  const fw_flexure_carried *start, double low, double high,
                  fw_flexure_elastica_state *best) {
    const double golden = 0.5 * (sqrt(5) - 1);
    fw_flexure_elastica_state at[2];
    double x[2] = {high - golden * (high - low), low + golden * (high - low)};
    for (int k = 0; k < 2; k++) {
        const fw_flexure_carried there = partly(e, el, start, x[k]);
        describe(e, el, x[k], &there, &at[k]);
    }
    for (int i = 0; i < 32; i++) {
        int new = larger(&at[0]) > larger(&at[1]) ? 0 : 1;
        if (larger(&at[new]) > larger(best)) *best = at[new];
        *(new ? &low : &high) = x[!new];
        at[!new] = at[new], x[!new] = x[new];
        x[new] = new ? low + golden *(high - low) : high - golden *(high - low);
        const fw_flexure_carried there = partly(e, el, start, x[new]);
        describe(e, el, x[new], &there, &at[new]);
    }
}

/* the largest |strain| of either fibre: first over all nodes and ends of elements, then by golden
   section beside the largest. Position to 1e-6 of an element, value to its square and the error of
   the solution. Cost about 100 us. Test: test_elastica.c peak_strain */
void fw_flexure_elastica_peak_strain(fw_flexure_elastica *e, fw_flexure_elastica_state *out) {
    enum { PLACES = FW_NODES + 2 };
    fw_flexure_elastica_state at[PLACES];
    int element = -1, place = 0;
    *out = (fw_flexure_elastica_state){0};
    if (e->solved < 0) return;
    fw_flexure_carried start, kept = {0};
    fw_flexure_elastica_begin(e, &start);
    for (int n = 0; n < e->mesh[e->solved].count; n++) {
        fw_flexure_element *el = &e->mesh[e->solved].element[n];
        at_places(e, el, &start, at);
        for (int i = 0; i < PLACES; i++)
            if (element < 0 || larger(&at[i]) > larger(out)) {
                *out = at[i];
                element = n, place = i, kept = start;
            }
        fw_flexure_element_pass(el, &e->p[1], &start);
    }
    const fw_flexure_element *el = &e->mesh[e->solved].element[element];
    double z[PLACES] = {0};
    memcpy(z + 1, &e->rule.node, sizeof e->rule.node);
    z[PLACES - 1] = 1;
    climb(e, el, &kept, z[place > 0 ? place - 1 : 0], z[place + 1 < PLACES ? place + 1 : place],
          out);
}

/* U = 1/2 int (M^2/EI + N^2/EA + V^2/(kGA)) ds + 1/2 sum over the roots of dL/EI M^2, by the nodes
   of the solved mesh. Test: test_elastica.c energy_is_work */
double fw_flexure_elastica_energy_J(fw_flexure_elastica *e) {
    if (e->solved < 0) return (double)NAN;
    const fw_flexure_mesh *mesh = &e->mesh[e->solved];
    fw_flexure_carried at;
    fw_flexure_elastica_begin(e, &at);
    double sum = e->hinged ? 0 : e->root[0] * at.value[MOMENT] * at.value[MOMENT];
    for (int n = 0; n < mesh->count; n++) {
        fw_flexure_element *el = &mesh->element[n];
        fw_nodes moment = (fw_nodes){0} + at.value[MOMENT], stretch;
        for (int j = 0; j < FW_NODES; j++) {
            double psi = el->psi[j] + el->phi[j], c = cos(psi), s = sin(psi);
            double N = e->p[1] * c + e->p[2] * s, V = e->p[2] * c - e->p[1] * s;
            moment -= el->h * (1 + (el->axial[j] - el->shear[j]) * N) * V * e->rule.column[j];
            stretch[j] = N * N * el->axial[j] + V * V * el->shear[j];
        }
        fw_nodes density = el->once_end * (moment * moment * el->bend + stretch);
        for (int j = 0; j < FW_NODES; j++)
            sum += density[j];
        fw_flexure_element_pass(el, &e->p[1], &at);
    }
    sum += e->root[1] * at.value[MOMENT] * at.value[MOMENT];
    return 0.5 * sum / e->soft;
}
