/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed form of a strip of lines and arcs whose width varies: its sections, and what their sums give. */
#include "base/constants.h"
#include "flexure/beam.h"
#include "flexure/section.h"
#include <math.h>

/* ---- sections ---- */

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
    *root_m = p->straight_more_m[end] + (block * mean + (p->root_m[end] - block) * along) / along;
}

fw_flexure_end_loss fw_flexure_path_end(const fw_flexure_course *p, const fw_flexure_path_stuff *m,
                                        int end) {
    const fw_geometry_strip_piece *q = &p->shape[end ? p->n - 1 : 0].piece;
    double length = 0, f = 1, t = q->width_m[2 * end], h = m->end_depth_m, k = q->curvature_per_m;
    if (!m->elastic.known) return (fw_flexure_end_loss){0};
    for (int i = 0; i < p->n; i++)
        length += p->shape[i].piece.length_m;
    if (k != 0) f = depth_at(m, h * sqrt(fabs(k) / t)).bow;
    double block = p->concentration[end] == 1 ? 0 : fw_flexure_root_block_m(t, 0);
    return fw_flexure_end_loss_of(&m->elastic, h, f, length, block);
}

/* mean of P over exp(-s/l) along the arc (line) that the strip ends with: P + l (T + q N)/(1 +
   q^2), T inwards, N to the centre of curvature, q = l/R */
void fw_flexure_path_end_loss(const fw_flexure_course *p, const fw_flexure_path_stuff *m, int end,
                              fw_flexure_path_section *at, double *loss_m) {
    double root;
    fw_flexure_path_root(p, m, end, at, &root);
    *loss_m = 0;
    if (!m->elastic.known) return;
    double k = p->shape[end ? p->n - 1 : 0].piece.curvature_per_m;
    double inwards = end ? -1 : 1, psi = at->pose.angle_rad;
    const fw_flexure_end_loss loss = fw_flexure_path_end(p, m, end);
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
                               .end_depth_m = in->depth_m,
                               .by_stress = in->crystal.known};
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

double fw_flexure_path_root_factor(const fw_flexure_input *in, const fw_flexure_path_stuff *m,
                                   int end, const fw_flexure_path_section *at) {
    if (in->fillet_m < 0) return fw_flexure_path_fibre_factor(at, m);
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
    return 0.5 * t / (section * youngs_Pa) * fw_flexure_path_fibre_factor(at, m);
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

/* ---- the whole strip ---- */

enum { NODES = FW_GAUSS_MOST, PANELS_MOST = 256, PLACES = 48 };

typedef struct rule {
    double node[NODES], weight[NODES];
} rule;

/* sums over the strip about a point; see fw_flexure_path */
enum { W1, WX, WY, FXX, FXY, FYY, AXX, AXY, AYY, THIN, SUMS };

static void add(const fw_flexure_path_section *at, double weight, const double about[2],
                double *sum) {
    double x = at->neutral_x_m - about[0], y = at->neutral_y_m - about[1];
    double c = cos(at->pose.angle_rad), s = sin(at->pose.angle_rad);
    double w = weight * at->bend_per_Nm2, f = weight * at->force_per_Nm2;
    double n = weight * at->stretch_per_N, v = weight * at->shear_per_N;
    sum[W1] += w, sum[WX] += w * x, sum[WY] += w * y;
    sum[FXX] += f * x * x, sum[FXY] += f * x * y, sum[FYY] += f * y * y;
    sum[AXX] += n * c * c + v * s * s;
    sum[AXY] += (n - v) * c * s;
    sum[AYY] += n * s * s + v * c * c;
    sum[THIN] += weight * at->thin_per_Nm2;
}

/* a root bends only, about the end of the centre line, and so does what an end loses, inside of it
 */
static void add_root(const fw_flexure_course *p, const fw_flexure_path_stuff *m, int end,
                     const double about[2], double *sum) {
    fw_flexure_path_section at;
    double root;
    fw_flexure_path_root(p, m, end, &at, &root);
    at.neutral_x_m = at.pose.x_m, at.neutral_y_m = at.pose.y_m;
    at.stretch_per_N = at.shear_per_N = at.thin_per_Nm2 = 0;
    /* forces: E I D alone, without what curvature does to the strip */
    at.force_per_Nm2 = at.bend_per_Nm2 * at.golovin;
    add(&at, root, about, sum);
    fw_flexure_path_end_loss(p, m, end, &at, &root);
    if (root == 0) return;
    at.stretch_per_N = at.shear_per_N = at.thin_per_Nm2 = 0;
    at.force_per_Nm2 = at.bend_per_Nm2 * at.golovin;
    add(&at, -root, about, sum);
}

static void integrate(const fw_flexure_course *p, const fw_flexure_path_stuff *m, const rule *r,
                      int panels, const double about[2], double *sum) {
    fw_flexure_path_section at;
    for (int k = 0; k < SUMS; k++)
        sum[k] = 0;
    for (int i = 0; i < p->n; i++) {
        double h = p->shape[i].piece.length_m / panels;
        for (int j = 0; j < panels; j++)
            for (int k = 0; k < NODES; k++) {
                fw_flexure_path_section_at(p, m, i, (j + r->node[k]) * h, &at);
                add(&at, r->weight[k] * h, about, sum);
            }
    }
    for (int end = 0; end < 2; end++)
        add_root(p, m, end, about, sum);
}

static double apart(const double *a, const double *b, double length) {
    double worst = fabs(a[W1] - b[W1]) / a[W1];
    worst = fmax(worst, hypot(a[WX] - b[WX], a[WY] - b[WY]) / (a[W1] * length));
    double force = fabs(a[FXX]) + fabs(a[FYY]), give = fabs(a[AXX]) + fabs(a[AYY]);
    for (int k = FXX; k <= FYY; k++)
        worst = fmax(worst, fabs(a[k] - b[k]) / force);
    for (int k = AXX; k <= AYY; k++)
        worst = fmax(worst, fabs(a[k] - b[k]) / give);
    return worst;
}

/* centre of the weights w, then the sums about it; panels doubled until nothing moves by 1e-13 */
static int measure(const fw_flexure_course *p, const fw_flexure_path_stuff *m, double centre[2],
                   double *sum) {
    rule r;
    double before[SUMS], length = 0;
    int panels = 1;
    for (int i = 0; i < p->n; i++)
        length += p->shape[i].piece.length_m;
    fw_flexure_gauss_rule(NODES, r.node, r.weight);
    centre[0] = centre[1] = 0;
    integrate(p, m, &r, panels, centre, before);
    for (panels = 2; panels <= PANELS_MOST; panels *= 2) {
        integrate(p, m, &r, panels, centre, sum);
        bool done = apart(sum, before, length) < 1e-13;
        for (int k = 0; k < SUMS; k++)
            before[k] = sum[k];
        if (done) break;
    }
    for (int turn = 0; turn < 2; turn++) { /* about W, so that nothing cancels */
        centre[0] += sum[WX] / sum[W1], centre[1] += sum[WY] / sum[W1];
        integrate(p, m, &r, panels, centre, sum);
    }
    return panels;
}

/* ---- place in the frame ---- */

static void lay(fw_flexure_course *p, const fw_geometry_strip_piece *piece, int n,
                fw_geometry_pose start) {
    p->n = n;
    for (int i = 0; i < n; i++) {
        fw_geometry_strip_shape_of(&piece[i], &p->shape[i]);
        p->start[i] = start;
        start = fw_geometry_strip_along(start, piece[i].curvature_per_m, piece[i].length_m);
    }
    p->start[n] = start;
}

static void give_roots(fw_flexure_course *p, double fillet_m) {
    const double ends[2] = {p->shape[0].piece.width_m[0], p->shape[p->n - 1].piece.width_m[2]};
    for (int end = 0; end < 2; end++) {
        p->root_m[end] = fw_flexure_root_length_m(ends[end], fillet_m);
        p->concentration[end] = fw_flexure_fillet_concentration(ends[end], fillet_m);
        const double bent = p->shape[end ? p->n - 1 : 0].piece.curvature_per_m;
        p->straight_more_m[end] = bent == 0 ? fw_flexure_straight_more_m(ends[end], fillet_m) : 0;
    }
}

static void outline_centre(const fw_flexure_course *p, double W[2]) {
    const fw_flexure_path_stuff plain = {.youngs_Pa = 1};
    double sum[SUMS];
    measure(p, &plain, W, sum);
}

/* the chord up the y axis, W on the x axis */
static void lay_on_chord(fw_flexure_course *p, const fw_geometry_strip_piece *piece, int n,
                         double fillet_m) {
    fw_geometry_pose end = fw_geometry_strip_end(piece, n, (fw_geometry_pose){0});
    double up = 0.5 * FW_PI - atan2(end.y_m, end.x_m), W[2];
    lay(p, piece, n, (fw_geometry_pose){0, 0, up});
    give_roots(p, fillet_m);
    outline_centre(p, W);
    if (W[0] < -1e-9 * fw_geometry_strip_length(piece, n)) { /* the same from its other end */
        fw_geometry_strip_piece back[FW_STRIP_MOST];
        fw_geometry_strip_turned(piece, n, back);
        for (int i = 0; i < n; i++)
            back[i].curvature_per_m = -back[i].curvature_per_m;
        lay_on_chord(p, back, n, fillet_m);
        return;
    }
    for (int i = 0; i <= n; i++)
        p->start[i].y_m -= W[1];
}

void fw_flexure_path_of(const fw_flexure_input *in, fw_flexure_course *p) {
    if (in->kind == FW_FLEXURE_PATH) {
        lay_on_chord(p, in->piece, in->npiece, in->fillet_m);
        return;
    }
    bool arc = in->kind == FW_FLEXURE_CSFH;
    double t = in->width_m, r = in->radius_m, a = 0.5 * in->angle_rad;
    double middle = in->width_middle_m > 0 ? in->width_middle_m : t;
    const fw_geometry_strip_piece one = {in->length_m, arc ? 1 / r : 0, {t, middle, t}};
    lay(p, &one, 1,
        arc ? (fw_geometry_pose){r * cos(a), -r * sin(a), 0.5 * FW_PI - a}
            : (fw_geometry_pose){0, -0.5 * in->length_m, 0.5 * FW_PI});
    give_roots(p, in->fillet_m);
}

static double farthest(const fw_flexure_course *p, double x, double y) {
    double far = 0;
    for (int i = 0; i < p->n; i++)
        for (int k = 0; k <= PLACES; k++) {
            const fw_geometry_strip_piece *q = &p->shape[i].piece;
            fw_geometry_pose at =
                fw_geometry_strip_along(p->start[i], q->curvature_per_m, q->length_m * k / PLACES);
            far = fmax(far, hypot(at.x_m - x, at.y_m - y));
        }
    return far;
}

static bool beyond(const fw_flexure_course *p, double fillet_m) {
    bool out = false;
    for (int end = 0; end < 2; end++) {
        const fw_geometry_strip_piece *q = &p->shape[end ? p->n - 1 : 0].piece;
        double x = fillet_m / q->width_m[2 * end];
        out = out || (x >= 0 && x < 0.05) || x > 1.25 * (1.0 + 1e-9);
    }
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        double t = fmax(q->width_m[1], fmax(q->width_m[0], q->width_m[2]));
        out = out || t * fabs(q->curvature_per_m) > 0.3;
    }
    return out;
}

/* what the outline alone gives; W of a uniform modulus, as it is drawn about. Cost: that of one
   integral, see below */
void fw_flexure_path_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    fw_flexure_course p;
    double W[2], turn = 0, least = HUGE_VAL, length = 0;
    fw_flexure_path_of(in, &p);
    outline_centre(&p, W);
    for (int i = 0; i < p.n; i++) {
        double low, high;
        const fw_geometry_strip_piece *q = &p.shape[i].piece;
        fw_geometry_strip_widths(&p.shape[i], &low, &high);
        least = fmin(least, low);
        length += q->length_m, turn += q->curvature_per_m * q->length_m;
    }
    double dL = 0.5 * (p.root_m[0] + p.root_m[1]);
    *f = (fw_flexure_shape){.kind = FW_FLEXURE_PATH,
                            .length_m = length,
                            .radius_m = farthest(&p, W[0], 0),
                            .width_m = least,
                            .fillet_m = in->fillet_m,
                            .half_angle_rad = 0.5 * turn,
                            .golovin = 1,
                            .root_length_m = dL,
                            .whole_m = length + 2 * dL,
                            .fillet_concentration = fmax(p.concentration[0], p.concentration[1]),
                            .centre_m = W[0],
                            .beyond_fit = beyond(&p, in->fillet_m),
                            .start = p.start[0]};
}

/* ---- the closed form ---- */

static void largest(const fw_flexure_course *p, double *thick, double *slope, double *aside) {
    *thick = *slope = *aside = 0;
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        double h = q->length_m / PLACES, last = q->width_m[0];
        for (int j = 0; j <= PLACES; j++) {
            double t = fw_geometry_strip_width(&p->shape[i], j * h);
            *thick = fmax(*thick, t * fabs(q->curvature_per_m));
            *slope = fmax(*slope, 0.5 * fabs(t - last) / h);
            *aside = fmax(*aside, fabs(fw_geometry_strip_aside(&p->shape[i], j * h)));
            last = t;
        }
    }
}

double fw_flexure_path_root_opens(const fw_flexure_course *p, int end, double s_m) {
    const fw_geometry_strip_shape *shape = &p->shape[end ? p->n - 1 : 0];
    double L = shape->piece.length_m, s = fmin(fmax(s_m, 0), 0.5 * L);
    double ratio = fw_geometry_strip_width(shape, end ? L - s : s) /
                   fw_geometry_strip_width(shape, end ? L : 0);
    return ratio * ratio;
}

static double opens_of(const fw_flexure_course *p, int end, const fw_flexure_input *in) {
    const fw_geometry_strip_piece *q = &p->shape[end ? p->n - 1 : 0].piece;
    double s = fw_flexure_root_reach_m(q->width_m[2 * end], in->fillet_m, q->curvature_per_m);
    double more = fmax(fw_flexure_path_root_opens(p, end, s) - 1, 0);
    return in->crystal.known ? more + fmin(more, 0.02) : more / (1 + more);
}

/* What a path's closed form may be off by besides what its ends and root law are (varying in flexure.c):
     edges that open by 2 s: bending over-estimated by 1 - (atan(3 ...)) ~ s^2 of the section's
       stiffness (Timoshenko's wedge; shear tilts the neutral fibres)
     middle between the edges beside the centre line by d: W by d, forces by 2 d over the size
     peak strain: less at a root by what the strip opens up to where the peak stands (silicon: up to 2 % more); 0.7 % in
       the middle of one that is thin there, 0.3 % of several pieces (silicon: 1 %); between isotropic roots up to
       0.2 t/R more, of solids 50 um deep with bends of R = 3 to 8 t: 0.6 % at 8 t, 2 % at 6 t, 3.5 % at 5 t, 5 % at 3 t
   In: rad, m. test_path.c errors_are_stated, test_forces.c */
fw_flexure_error fw_flexure_path_errors(fw_flexure_shape *f, const fw_flexure_input *in) {
    fw_flexure_course p;
    double thick, slope, aside;
    fw_flexure_path_of(in, &p);
    largest(&p, &thick, &slope, &aside);
    const double open[2] = {opens_of(&p, 0, in), opens_of(&p, 1, in)},
                 most = fmax(open[0], open[1]);
    const bool plain = p.n == 1 && p.shape[0].uniform, crystal = in->crystal.known;
    f->widening = thick > 0.3 ? 10 : thick > 0.15 ? 2 : 1;
    const double size = f->radius_m;
    double taper = slope * slope, off = 2 * aside / size, deep = fmin(in->depth_m / f->width_m, 5);
    double pieces = p.n == 1 ? (plain ? 0 : 0.007) : crystal ? 0.010 : 0.003;
    const double bends = crystal || plain ? 0 : 0.04 * deep * fmin(thick, 0.35);
    const double worst = taper + pieces, place = p.n == 1 && !crystal ? taper : worst;
    return (fw_flexure_error){.stiffness = taper,
                              .softer = taper, /* of one arc or line all that is not its ends' */
                              .kx = taper + off,
                              .ky = taper + off,
                              .strain = worst + (crystal ? most : most / (1 - most)),
                              .above = worst + bends,
                              .place_less = {place + open[0], place + open[1], place},
                              .between_more = crystal && p.n > 1 ? 0 : worst + bends,
                              .centre_m = aside + 0.1 * taper * size};
}

static fw_flexure_path_section section_of(const fw_flexure_course *p,
                                          const fw_flexure_path_stuff *m, int i, double s) {
    fw_flexure_path_section at;
    fw_flexure_path_section_at(p, m, i, s, &at);
    return at;
}

static double fibre(const fw_flexure_course *p, const fw_flexure_path_stuff *m,
                    const fw_flexure_input *in, int i, double s) {
    const fw_flexure_path_section at = section_of(p, m, i, s);
    return fw_flexure_path_fibre(&at, in->youngs_Pa, m);
}

/* largest strain per moment: at the roots with their fillets, and in each piece, found on a grid
   and closed in by golden section; concentration: over what the beam has where it is; fit: by eq. 5
 */
static double peak(const fw_flexure_course *p, const fw_flexure_path_stuff *m,
                   const fw_flexure_input *in, fw_flexure_result *out, double *fit) {
    const double part = 0.5 * (sqrt(5) - 1);
    double best = 0, share = 1, roots = 0, between = 0, even = 0;
    fw_flexure_path_stuff by_strain = *m; /* the fit */
    by_strain.by_stress = false;
    for (int end = 0; end < 2; end++) {
        int i = end ? p->n - 1 : 0;
        const fw_flexure_path_section at =
            section_of(p, m, i, end ? p->shape[i].piece.length_m : 0);
        double plain = fw_flexure_path_fibre(&at, in->youngs_Pa, m),
               own = fw_flexure_path_fibre_factor(&at, m);
        double narrows = fmax(1, 1 / fw_flexure_path_root_opens(p, end, in->fillet_m));
        double factor = narrows * fw_flexure_path_root_factor(in, m, end, &at);
        roots = fmax(roots,
                     p->concentration[end] * fw_flexure_path_fibre(&at, in->youngs_Pa, &by_strain));
        if (plain * factor <= best * own) continue;
        best = plain * factor / own;
        share = factor;
    }
    for (int i = 0; i < p->n; i++) {
        double L = p->shape[i].piece.length_m, h = L / PLACES, top = 0, where = 0;
        const bool uneven = !p->shape[i].uniform || m->by_stress;
        for (int k = 0; k <= PLACES; k++) {
            double e = fibre(p, m, in, i, k * h);
            even = fmax(even, m->by_stress ? fibre(p, &by_strain, in, i, k * h) : 0);
            if (e > top) top = e, where = k * h;
        }
        double low = fmax(0, where - h), high = fmin(L, where + h);
        for (int k = 0; k < 40 && uneven; k++) {
            double a = high - part * (high - low), b = low + part * (high - low);
            if (fibre(p, m, in, i, a) > fibre(p, m, in, i, b))
                high = b;
            else
                low = a;
        }
        if (uneven) top = fmax(top, fibre(p, m, in, i, 0.5 * (low + high)));
        const fw_flexure_path_section at = section_of(p, m, i, 0.5 * (low + high));
        if (top > between) between = top, out->fibre = fw_flexure_path_fibre_factor(&at, m);
        if (top > best) best = top, share = fw_flexure_path_fibre_factor(&at, m);
    }
    out->concentration = share;
    *fit = fmax(roots, m->by_stress ? even : between);
    return best;
}

/* mean of both roots' (dL - d)/E, counted in the mean modulus */
static double root_less_loss(const fw_flexure_course *p, const fw_flexure_path_stuff *m) {
    double sum = 0;
    for (int end = 0; end < 2; end++) {
        fw_flexure_path_section at;
        double root, lost, t;
        fw_flexure_path_root(p, m, end, &at, &root);
        t = at.width_m;
        fw_flexure_path_end_loss(p, m, end, &at, &lost);
        sum += 0.5 * (root - lost) * at.thin_per_Nm2 * m->depth_m * t * t * t / 12;
    }
    return sum * m->youngs_Pa;
}

/* of the flexibility: what isotropic ends take off it (lost), and what straight roots of a crystal, and of all that is
   counted with its ends, give more (more) */
static void ends_of_strain(const fw_flexure_course *p, const fw_flexure_input *in,
                           const fw_flexure_path_stuff *m, double *lost, double *more) {
    fw_flexure_input own = *in;
    fw_flexure_path_stuff with = *m;
    own.ends = true;
    with.elastic = fw_flexure_elastic_of(&own);
    *lost = *more = 0;
    for (int end = 0; end < 2; end++) {
        fw_flexure_path_section at;
        double one;
        fw_flexure_path_end_loss(p, &with, end, &at, &one);
        *lost += one * at.bend_per_Nm2, *more += p->straight_more_m[end] * at.bend_per_Nm2;
    }
}

/* Strip of any centre line P(s), width t(s), local radius R, neutral radius R - e (Winkler), depth
   factor D(R, t), Golovin's factor g(t/2R), roots dL as weights at the two ends:
     w  = ds/(E I D g),  W = int P_n w/int w,  P_n = P moved by e to the centre of curvature
     C_th = int w = 1/K
     C_ff = int b b' df + int (t t' (R - e)/R/(E A D) + n n' 6/5/(G A)) ds
            df = ds/(E A e R D) (ds/EI where straight), b = (y, -x) of P_n from W
   that is fw_flexure_csfh with its constants taken at every place. D is that of an endless arc of
   the local radius: where pieces of different radius meet it changes within sqrt(R t) and not at
   once. Strain: M t/2/(E I D g) max((1 + t/3R) F_inner, (1 - t/3R) F_outer), the largest of the
   whole strip, with Kt and a crystal's q at the roots, and the width where their fillets end if it
   is less there.
   in: outline, m, Pa, rad; out: SI. Error: fw_flexure_path_errors. Cost 140 us for one piece.
   source: docs/theory/flexure-path.md; test_path.c */
void fw_flexure_path(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    fw_flexure_course p;
    double sum[SUMS], W[2], fit;
    fw_flexure_path_of(in, &p);
    const fw_flexure_path_stuff m = fw_flexure_path_stuff_of(&p, in);
    measure(&p, &m, W, sum);
    out->offset_m[0] = W[0] - f->centre_m, out->offset_m[1] = W[1];
    if (hypot(out->offset_m[0], out->offset_m[1]) < 1e-12 * f->length_m)
        out->offset_m[0] = out->offset_m[1] = 0;
    double(*C)[3] = out->compliance;
    C[0][0] = sum[W1];
    C[0][1] = C[1][0] = C[0][2] = C[2][0] = 0;
    C[1][1] = sum[FYY] + sum[AXX];
    C[2][2] = sum[FXX] + sum[AYY];
    C[1][2] = C[2][1] = sum[AXY] - sum[FXY];
    out->youngs_Pa = m.youngs_Pa, out->poisson = m.poisson;
    if (m.elastic.known) out->root_length_m = root_less_loss(&p, &m);
    out->stiffness_Nm_per_rad = 1 / sum[W1];
    out->stiffness_thin = 1 / sum[THIN];
    fw_flexure_path_stuff flat = m;
    flat.depth_m = 0;
    double without[SUMS], other[2];
    measure(&p, &flat, other, without);
    out->depth_factor = without[W1] / (in->depth_m * sum[W1]);
    double lost, more;
    ends_of_strain(&p, in, &m, &lost, &more);
    out->ends_stiffer = sum[W1] / (sum[W1] - (m.elastic.known ? more : lost));
    out->ends_lost = in->crystal.known ? 0 : lost / (sum[W1] - (m.elastic.known ? 0 : lost));
    out->strain_per_rad = peak(&p, &m, in, out, &fit) / sum[W1] * out->ends_stiffer;
    out->strain_fit_per_rad = fit / sum[W1];
}
