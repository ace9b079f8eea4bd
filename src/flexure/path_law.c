/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What flexures of any centre line do at large rotation: the law of a path, and the beam that a flexure is. */
#include "base/constants.h"
#include "flexure/beam.h"
#include "flexure/path.h"
#include "flexure/section.h"
#include <math.h>

/* ---- the law ----

   A path at finite rotation. With w = ds/(E I D g) and the roots' dL/(E I D g) at the two ends, C =
   int w, a pure moment that turns the second body by th turns the section at s by th f(s), f(s) =
   int_0^s w / C, exactly, at any th (inextensible). So

     P(s, th) = A + int_0^s (cos, sin)(psi(s) + th f(s)) ds
     drift    = R(-th/2) [B(th) + R(th) (W - B) - W],  W = int w P/C as made
     c(th)    = int w b b' ds + int (t t'/EA + n n' 6/5/GA) ds,  b = (y, -x) of P(s, th) from its
   own centre int w P/C, all in the frame half turned

   and of the third variation what a pull Fy along the chord does (finite_force.c), with phi_f(s) =
   int_0^s w (centre - P) x f for f = e, n along the axis and across it

     xxy = int (n.t) phi_e^2 + 2 (e.t) phi_e phi_n ds,   yyy = int (n.t) phi_n^2 ds

   drift from the exact kinematics, c from the second variation about that state with the rotation
   held: of one arc that is the law of finite.c. Of c and drift the law takes c_xx, c_yy and the
   drift along y; of a strip that is its own mirror image the rest is 0.
   In: outline, m, Pa, rad; out: m, m/N. Valid |th| < 2 pi; the forces' error goes with their square
   as in finite.c. Quadrature and series to 1e-12. Cost: 0.2 ms for the table of one hinge.
   Source: docs/theory/flexure-path.md. Test: test_path_law.c. */

enum { NODES = FW_GAUSS_MOST, PANELS = 4 };

typedef struct knot {        /* node of the quadrature */
    double psi_rad, share;   /* as made; f */
    double length_m, weight; /* ds; w ds over C */
    double stretch, shear;   /* ds/EA, ds 6/5/GA */
} knot;

struct fw_flexure_path_way {
    knot *knot;      /* (n) panel after panel */
    double *panel_m; /* (n/NODES) length of each panel */
    int n;
    double inside[NODES * NODES]; /* fw_flexure_gauss_integrals */
    double weight[NODES];         /* of the rule */
    fw_geometry_pose first, last;
    double root[2]; /* shares of the roots */
    double W[2];    /* centre of weights as made */
    double total;   /* C */
};

/* sections of the strip as made */
static double lay_knots(fw_flexure_path_way *way, const fw_flexure_course *p,
                        const fw_flexure_path_stuff *m, const double *node, const double *weight) {
    double total = 0;
    for (int i = 0; i < p->n; i++)
        for (int j = 0; j < PANELS; j++) {
            double h = p->shape[i].piece.length_m / PANELS;
            way->panel_m[way->n / NODES] = h;
            for (int k = 0; k < NODES; k++) {
                fw_flexure_path_section at;
                fw_flexure_path_section_at(p, m, i, (j + node[k]) * h, &at);
                double ds = weight[k] * h, t = at.width_m;
                way->knot[way->n++] = (knot){.psi_rad = at.pose.angle_rad,
                                             .length_m = ds,
                                             .weight = ds * at.bend_per_Nm2,
                                             .stretch = ds * at.thin_per_Nm2 * t * t / 12,
                                             .shear = ds * at.shear_per_N};
                total += ds * at.bend_per_Nm2;
            }
        }
    return total;
}

/* f at the nodes: within a panel by the polynomial through them */
static void share_out(fw_flexure_path_way *way, const double *weight) {
    double before = way->root[0];
    for (int first = 0; first < way->n; first += NODES) {
        knot *at = way->knot + first;
        double sum = 0;
        for (int i = 0; i < NODES; i++) {
            at[i].share = before;
            for (int j = 0; j < NODES; j++)
                at[i].share += way->inside[i * NODES + j] * at[j].weight / weight[j];
            sum += at[i].weight;
        }
        before += sum;
    }
}

typedef struct wound {                /* sums of one state */
    double end[2];                    /* B */
    double centre[2];                 /* int w P/C */
    double xx, xy, yy, axx, axy, ayy; /* int w P P' over C; int of the rest */
} wound;

static void add_point(wound *o, double weight, double x, double y) {
    o->centre[0] += weight * x, o->centre[1] += weight * y;
    o->xx += weight * x * x, o->xy += weight * x * y, o->yy += weight * y * y;
}

/* one panel of the wound strip: directions and places of its nodes from the place (x, y), which
   moves on to its end */
static void wind_panel(const fw_flexure_path_way *way, int first, double th, double c[NODES],
                       double s[NODES], double px[NODES], double py[NODES], double end[2]) {
    const knot *at = way->knot + first;
    double h = way->panel_m[first / NODES], across = 0, up = 0;
    for (int i = 0; i < NODES; i++) {
        double psi = at[i].psi_rad + th * at[i].share;
        c[i] = cos(psi), s[i] = sin(psi);
        across += at[i].length_m * c[i], up += at[i].length_m * s[i];
    }
    for (int i = 0; i < NODES; i++) {
        px[i] = end[0], py[i] = end[1];
        for (int j = 0; j < NODES; j++) {
            px[i] += h * way->inside[i * NODES + j] * c[j];
            py[i] += h * way->inside[i * NODES + j] * s[j];
        }
    }
    end[0] += across, end[1] += up;
}

/* the strip wound by th, in the first body's frame with the first end at the origin */
static wound wind(const fw_flexure_path_way *way, double th) {
    wound o = {0};
    double c[NODES], s[NODES], px[NODES], py[NODES];
    for (int first = 0; first < way->n; first += NODES) {
        const knot *at = way->knot + first;
        wind_panel(way, first, th, c, s, px, py, o.end);
        for (int i = 0; i < NODES; i++) {
            o.axx += at[i].stretch * c[i] * c[i] + at[i].shear * s[i] * s[i];
            o.axy += (at[i].stretch - at[i].shear) * c[i] * s[i];
            o.ayy += at[i].stretch * s[i] * s[i] + at[i].shear * c[i] * c[i];
            add_point(&o, at[i].weight, px[i], py[i]);
        }
    }
    add_point(&o, way->root[1], o.end[0], o.end[1]); /* the first root is at the origin */
    return o;
}

/* the third variation about that state */
static void third(const fw_flexure_path_way *way, double th, const double centre[2],
                  const double *weight, fw_flexure_path_pose *out) {
    double c[NODES], s[NODES], px[NODES], py[NODES], end[2] = {0};
    double co = cos(0.5 * th), si = sin(0.5 * th);
    const double f[2][2] = {{co, si}, {-si, co}};
    double phi[2]; /* so far: the first root turns, too */
    for (int k = 0; k < 2; k++)
        phi[k] = way->total * way->root[0] * (centre[0] * f[k][1] - centre[1] * f[k][0]);
    out->third_xxy = out->third_yyy = 0;
    for (int first = 0; first < way->n; first += NODES) {
        const knot *at = way->knot + first;
        double turn[2][NODES], now[2][NODES];
        wind_panel(way, first, th, c, s, px, py, end);
        for (int k = 0; k < 2; k++)
            for (int i = 0; i < NODES; i++)
                turn[k][i] = way->total * at[i].weight *
                             ((centre[0] - px[i]) * f[k][1] - (centre[1] - py[i]) * f[k][0]);
        for (int k = 0; k < 2; k++)
            for (int i = 0; i < NODES; i++) {
                now[k][i] = phi[k];
                for (int j = 0; j < NODES; j++)
                    now[k][i] += way->inside[i * NODES + j] * turn[k][j] / weight[j];
            }
        for (int i = 0; i < NODES; i++) {
            double te = f[0][0] * c[i] + f[0][1] * s[i], tn = f[1][0] * c[i] + f[1][1] * s[i];
            double e = now[0][i], n = now[1][i], ds = at[i].length_m;
            out->third_xxy += ds * (tn * e * e + 2 * te * e * n);
            out->third_yyy += ds * tn * n * n;
            phi[0] += turn[0][i], phi[1] += turn[1][i];
        }
    }
}

fw_status fw_flexure_path_way_new(fw_arena *arena, const fw_flexure_input *in,
                                  const fw_flexure_path_way **out) {
    fw_flexure_course p;
    fw_flexure_path_way *way;
    double node[NODES], weight[NODES], root, lost;
    fw_flexure_path_section at;
    fw_flexure_path_of(in, &p);
    const fw_flexure_path_stuff m = fw_flexure_path_stuff_of(&p, in);
    FW_NEED(way = fw_arena_one(arena, fw_flexure_path_way));
    FW_NEED(way->knot = fw_arena_array(arena, knot, (size_t)(p.n * PANELS * NODES)));
    FW_NEED(way->panel_m = fw_arena_array(arena, double, (size_t)(p.n * PANELS)));
    fw_flexure_gauss_rule(NODES, node, weight);
    fw_flexure_gauss_integrals(NODES, node, weight, way->inside);
    for (int i = 0; i < NODES; i++)
        way->weight[i] = weight[i];
    way->first = p.start[0], way->last = p.start[p.n];
    way->total = lay_knots(way, &p, &m, node, weight);
    for (int end = 0; end < 2; end++) {
        fw_flexure_path_root(&p, &m, end, &at, &root);
        fw_flexure_path_end_loss(&p, &m, end, &at, &lost);
        way->root[end] = (root - lost) * at.bend_per_Nm2; /* both at the end: W 0.1 um off */
        way->total += way->root[end];
    }
    way->root[0] /= way->total, way->root[1] /= way->total;
    for (int i = 0; i < way->n; i++)
        way->knot[i].weight /= way->total;
    share_out(way, weight);
    const wound made = wind(way, 0);
    way->W[0] = made.centre[0], way->W[1] = made.centre[1];
    *out = way;
    return FW_OK;
}

void fw_flexure_path_pose_at(const fw_flexure_path_way *way, double th, fw_flexure_path_pose *out) {
    const wound o = wind(way, th);
    const wound made = {.end = {way->last.x_m - way->first.x_m, way->last.y_m - way->first.y_m}};
    double c = cos(0.5 * th), s = sin(0.5 * th);
    double bx = way->W[0] - made.end[0], by = way->W[1] - made.end[1];
    double x = o.end[0] + cos(th) * bx - sin(th) * by - way->W[0];
    double y = o.end[1] + sin(th) * bx + cos(th) * by - way->W[1];
    out->drift_m[0] = c * x + s * y, out->drift_m[1] = c * y - s * x;
    /* softness in the first body's frame, then turned by -th/2 */
    const double *g = o.centre;
    double xx = way->total * (o.yy - g[1] * g[1]) + o.axx;
    double yy = way->total * (o.xx - g[0] * g[0]) + o.ayy;
    double xy = -way->total * (o.xy - g[0] * g[1]) + o.axy;
    out->c[0][0] = c * c * xx + 2 * c * s * xy + s * s * yy;
    out->c[1][1] = s * s * xx - 2 * c * s * xy + c * c * yy;
    out->c[0][1] = out->c[1][0] = c * s * (yy - xx) + (c * c - s * s) * xy;
    double along = c * c * o.axx + 2 * c * s * o.axy + s * s * o.ayy;
    out->bend[0] = out->c[0][0] - along, out->bend[1] = out->c[1][1] - (o.axx + o.ayy - along);
    third(way, th, o.centre, way->weight, out);
}

void fw_flexure_path_left_out(const fw_flexure_path_way *way, double rotation_rad, double *drift_m,
                              double *coupling) {
    enum { STEPS = 16 };
    *drift_m = *coupling = 0;
    for (int i = -STEPS; i <= STEPS; i++) {
        fw_flexure_path_pose at;
        fw_flexure_path_pose_at(way, rotation_rad * i / STEPS, &at);
        *drift_m = fmax(*drift_m, fabs(at.drift_m[0]));
        *coupling = fmax(*coupling, fabs(at.c[0][1]) / sqrt(at.c[0][0] * at.c[1][1]));
    }
}

/* px: d(kx)/dFy less that of the chord, 1/L, times 60 bend_x */
static double pull_along(const fw_flexure_path_pose *p, double length_m) {
    return 60 * (p->third_xxy / p->bend[0] - p->bend[0] / length_m);
}

/* py: 42 third_yyy over bend_y; a straight strip has neither, and px of a leaf */
static double pull_across(const fw_flexure_path_pose *p, double length_m) {
    bool straight = p->bend[1] < 1e-12 * p->bend[0];
    return straight ? pull_along(p, length_m) : 42 * p->third_yyy / p->bend[1];
}

static int terms_of(const double *c, int before) {
    double most = 0;
    for (int n = 0; n < FW_PATH_TERMS; n++)
        most = fmax(most, fabs(c[n]));
    for (int n = FW_PATH_TERMS; n > before; n--)
        if (fabs(c[n - 1]) > 1e-14 * most) return n;
    return before;
}

static int terms_of_all(const struct fw_flexure_hinge_table *t) {
    const double *const all[] = {t->bend_x,  t->bend_y, t->rest_x, t->rest_y,
                                 t->drift_m, t->pull_x, t->pull_y};
    int terms = 1;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        terms = terms_of(all[i], terms);
    return terms;
}

fw_status fw_flexure_path_law(fw_arena *arena, const fw_flexure_input *in,
                              const fw_flexure_result *closed_form, fw_flexure_hinge_law *law) {
    enum { N = FW_PATH_TERMS };
    const fw_flexure_path_way *way;
    struct fw_flexure_hinge_table *t;
    fw_flexure_shape f;
    fw_flexure_path_pose at[N];
    FW_TRY(fw_flexure_path_way_new(arena, in, &way));
    FW_NEED(t = fw_arena_one(arena, struct fw_flexure_hinge_table));
    for (int i = 0; i < N; i++)
        fw_flexure_path_pose_at(way, 2 * FW_PI * cos(FW_PI * (i + 0.5) / N), &at[i]);
    fw_flexure_shape_of(in, &f);
    for (int n = 0; n < N; n++)
        for (int i = 0; i < N; i++) {
            double by = (n ? 2.0 : 1.0) / N * cos(FW_PI * n * (i + 0.5) / N);
            const fw_flexure_path_pose *p = &at[i];
            t->bend_x[n] += by * p->bend[0];
            t->bend_y[n] += by * p->bend[1];
            t->rest_x[n] += by * (p->c[0][0] - p->bend[0]);
            t->rest_y[n] += by * (p->c[1][1] - p->bend[1]);
            t->drift_m[n] += by * p->drift_m[1];
            t->pull_x[n] += by * pull_along(p, f.length_m);
            t->pull_y[n] += by * pull_across(p, f.length_m);
        }
    t->terms = terms_of_all(t), t->straight = in->kind == FW_FLEXURE_LEAF;
    fw_flexure_path_pose_at(way, 0, &at[0]);
    *law = (fw_flexure_hinge_law){.stiffness_Nm_per_rad = closed_form->stiffness_Nm_per_rad,
                                  .half_angle_rad = f.half_angle_rad,
                                  .length_m = f.length_m,
                                  .share = 1 - way->root[0] - way->root[1],
                                  .bend_m_per_N = at[0].c[0][0],
                                  .table = t};
    return FW_OK;
}

/* ---- the beam of beam.h that a flexure is, with the corrections of its closed form ---- */

static void moduli_of(const fw_flexure_crystal *k, fw_flexure_beam *out) {
    out->cubic = true;
    out->a0_per_Pa = k->a0_per_Pa;
    out->a1_per_Pa = k->aligned ? k->a1_per_Pa : 0; /* else the mean over all directions */
    out->orientation_rad = 0.25 * atan2(k->sin4, k->cos4);
}

/* the crystal of the closed form in the frame of the flexure; psi of a tangent is a quarter turn
   off the polar angle, which cos 4 psi does not feel. The two roots give as
   fw_flexure_root_m_per_Pa has it, the ends take away what fw_flexure_end_loss_of says, spread as
   it is found there */
static void elastic_of(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                       fw_flexure_beam *out) {
    const fw_flexure_crystal elastic = fw_flexure_elastic_of(in), *k = &elastic;
    double turn = 0.5 * FW_PI - out->psi_rad; /* from the middle to either end */
    fw_flexure_shape shape;
    fw_flexure_shape_of(in, &shape);
    moduli_of(k, out);
    out->depth_factor = closed_form->depth_factor * shape.golovin;
    out->shear_Pa = closed_form->youngs_Pa / (2 * (1 + closed_form->poisson));
    double h = in->depth_m, L = in->length_m, t = in->width_m, E = closed_form->youngs_Pa, f = 1;
    if (in->kind == FW_FLEXURE_CSFH)
        f = fw_flexure_depth_crystal(h / sqrt(in->radius_m * t), k, E).bow;
    const fw_flexure_end_loss loss = fw_flexure_end_loss_of(k, h, f, L, shape.root_block_m);
    double far = exp(-L / loss.reach_m);
    double lost = k->bow_per_Pa * loss.length_m / (loss.reach_m * (1 - far));
    for (int end = 0; end < 2; end++) {
        double four = 4 * (out->orientation_rad + (end ? turn : -turn));
        double per_E = out->a0_per_Pa + out->a1_per_Pa * cos(four) - lost * (1 + far);
        out->lost_per_Pa[end] = lost, out->lost_m[end] = loss.reach_m;
        out->root_m[end] = fw_flexure_root_m_per_Pa(&shape, k, k->aligned ? cos(four) : 0) / per_E;
    }
}

/* EI is what makes K = EI/(L + 2 dL) the stiffness of the closed form, as in
   fw_flexure_hinge_law_of; of a crystal it goes with the direction. Test: test_beam.c, of a crystal
   tests/cli/test_hinge.py test_random_beams */
void fw_flexure_beam_of_flexure(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                                fw_flexure_beam_piece *piece, fw_flexure_beam *out) {
    bool arc = in->kind == FW_FLEXURE_CSFH;
    double t = in->width_m, L = in->length_m, dL = closed_form->root_length_m;
    double a = arc ? 0.5 * in->angle_rad : 0, r = arc ? in->radius_m : 0;
    double thin = in->youngs_Pa * in->depth_m * t * t * t / 12;
    *piece = (fw_flexure_beam_piece){
        .length_m = L, .curvature_per_m = arc ? 1 / r : 0, .width_m = {t, t, t}};
    *out =
        (fw_flexure_beam){.piece = piece,
                          .npiece = 1,
                          .x_m = r * cos(a),
                          .y_m = arc ? -r * sin(a) : -0.5 * L,
                          .psi_rad = 0.5 * FW_PI - a,
                          .depth_m = in->depth_m,
                          .youngs_Pa = in->youngs_Pa,
                          .shear_Pa = in->youngs_Pa / (2 * (1 + in->poisson)),
                          .depth_factor = closed_form->stiffness_Nm_per_rad * (L + 2 * dL) / thin,
                          .root_m = {dL, dL}};
    if (fw_flexure_elastic_of(in).known) elastic_of(in, closed_form, out);
}

/* what the sections of a path's beam are asked of */
typedef struct strip_made {
    fw_flexure_course course;
    fw_flexure_path_stuff stuff;
} strip_made;

static double width(const void *context, int piece, double s_m) {
    const strip_made *strip = context;
    return fw_geometry_strip_width(&strip->course.shape[piece], s_m);
}

/* D g */
static double stiffer(const void *context, int piece, double s_m) {
    const strip_made *strip = context;
    fw_flexure_path_section at;
    if (strip->course.shape[piece].piece.curvature_per_m == 0) return 1;
    fw_flexure_path_section_at(&strip->course, &strip->stuff, piece, s_m, &at);
    return at.depth.stiffness * at.golovin;
}

/* int exp(-s/l) ds/(I D g) of an end, s from it, as l int 1/(I D g) du with u = exp(-s/l) */
static double felt_by(const strip_made *strip, int end, double l_m) {
    const fw_flexure_course *p = &strip->course;
    double node[NODES], weight[NODES], length = 0, sum = 0;
    for (int i = 0; i < p->n; i++)
        length += p->shape[i].piece.length_m;
    fw_flexure_gauss_rule(NODES, node, weight);
    const double far = exp(-length / l_m), step = (1 - far) / PANELS;
    for (int k = 0; k < PANELS * NODES; k++) {
        double s = -l_m * log(far + (k / NODES + node[k % NODES]) * step);
        double from = end ? length - s : s;
        int i = 0;
        for (; i < p->n - 1 && from > p->shape[i].piece.length_m; i++)
            from -= p->shape[i].piece.length_m;
        double t = width(strip, i, from), h = strip->stuff.depth_m;
        sum += l_m * step * weight[k % NODES] * 12 / (h * t * t * t * stiffer(strip, i, from));
    }
    return sum;
}

/* Roots that give, and ends that lose, as much as those of the closed form: of a crystal the block has its
   mean modulus, and what an end loses is spread as fw_flexure_end_loss_of found it. The ends count three
   times as much in what a force bends as in what a moment turns, so that a beam without them cannot
   have both from one factor on all of its length. Test: test_path_law.c beam_of_a_crystal */
static void give_ends(const strip_made *strip, fw_flexure_beam *out) {
    const double most = 0.5; /* of 1/E: of a strip that is many times as wide soon behind its end */
    const fw_flexure_course *p = &strip->course;
    double root[2], soft[2];
    for (int end = 0; end < 2; end++) {
        fw_flexure_path_section at;
        fw_flexure_path_root(p, &strip->stuff, end, &at, &root[end]);
        soft[end] = at.bend_per_Nm2;
        const fw_flexure_end_loss loss = fw_flexure_path_end(p, &strip->stuff, end);
        if (!(loss.length_m > 0)) continue;
        double inertia = at.thin_per_Nm2 / at.bend_per_Nm2 * at.width_m * at.width_m * at.width_m *
                         strip->stuff.depth_m / 12;
        out->lost_m[end] = loss.reach_m;
        double lost = strip->stuff.elastic.bow_per_Pa * loss.length_m / inertia;
        out->lost_per_Pa[end] =
            fmin(lost / felt_by(strip, end, loss.reach_m), most * out->a0_per_Pa);
    }
    for (int end = 0; end < 2; end++) { /* the root's rotation is counted in the section there */
        fw_flexure_beam_section at;
        const int i = end ? p->n - 1 : 0;
        const fw_flexure_beam_pose from = {p->start[i].x_m, p->start[i].y_m, p->start[i].angle_rad};
        fw_flexure_beam_at(out, i, &from, end ? p->shape[i].piece.length_m : 0, &at);
        out->root_m[end] = root[end] * soft[end] / at.bend_per_Nm2;
    }
}

/* Width, modulus and depth factor at every place, roots and ends are those of the closed form, and 1/C_th of the
   beam is its stiffness to rounding: one factor on the whole beam takes what quadratures are off by.
   Not in it: Winkler's neutral line, by which a moment moves the point that it turns about. In, out: SI.
   Cost: that of fw_flexure_beam_compliance. Test: test_path.c beam_of_a_path, test_path_law.c */
fw_status fw_flexure_path_beam(fw_arena *arena, const fw_flexure_input *in,
                               const fw_flexure_result *closed_form, fw_flexure_beam *out) {
    strip_made *strip;
    fw_flexure_beam_piece *piece;
    fw_flexure_beam_linear linear;
    FW_NEED(strip = fw_arena_one(arena, strip_made));
    const fw_flexure_course *p = &strip->course;
    fw_flexure_path_of(in, &strip->course);
    strip->stuff = fw_flexure_path_stuff_of(p, in);
    FW_NEED(piece = fw_arena_array(arena, fw_flexure_beam_piece, (size_t)p->n));
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        piece[i] =
            (fw_flexure_beam_piece){.length_m = q->length_m,
                                    .curvature_per_m = q->curvature_per_m,
                                    .width_m = {q->width_m[0], q->width_m[1], q->width_m[2]}};
    }
    *out = (fw_flexure_beam){.piece = piece,
                             .npiece = p->n,
                             .x_m = p->start[0].x_m,
                             .y_m = p->start[0].y_m,
                             .psi_rad = p->start[0].angle_rad,
                             .depth_m = in->depth_m,
                             .youngs_Pa = closed_form->youngs_Pa,
                             .shear_Pa = closed_form->youngs_Pa / (2 * (1 + closed_form->poisson)),
                             .depth_factor = 1,
                             .width = width,
                             .stiffer = stiffer,
                             .context = strip};
    const fw_flexure_crystal *k = &strip->stuff.elastic;
    if (k->known) {
        moduli_of(k, out);
        out->g0_per_Pa = k->g0_per_Pa, out->g1_per_Pa = k->aligned ? k->g1_per_Pa : 0;
    }
    give_ends(strip, out);
    fw_flexure_beam_compliance(out, &linear);
    out->depth_factor = linear.c[0][0] * closed_form->stiffness_Nm_per_rad;
    return FW_OK;
}

fw_status fw_flexure_beam_of_input(fw_arena *arena, const fw_flexure_input *in,
                                   const fw_flexure_result *closed_form, fw_flexure_beam *out) {
    if (fw_flexure_input_varies(in)) return fw_flexure_path_beam(arena, in, closed_form, out);
    fw_flexure_beam_piece *piece = fw_arena_one(arena, fw_flexure_beam_piece);
    FW_NEED(piece);
    fw_flexure_beam_of_flexure(in, closed_form, piece, out);
    return FW_OK;
}

void fw_flexure_beam_scale(fw_flexure_beam *beam, double by) {
    if (!(by > 0)) return;
    beam->youngs_Pa *= by, beam->shear_Pa *= by;
    beam->a0_per_Pa /= by, beam->a1_per_Pa /= by;
    beam->g0_per_Pa /= by, beam->g1_per_Pa /= by;
    for (int end = 0; end < 2; end++)
        beam->lost_per_Pa[end] /= by;
}
