/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Electrodes of a rotor and a stator at a given voltage V, ports: the stator's point and the
   rotor's. Of the rotor against the stator, in the stator's frame turned by `direction` (e along, n
   across): x = e.d, y = n.d, tilt theta; d from the stator's point to the rotor's, 0 as drawn.

     comb   C = eps0 h N int_a^b [1/(g - y - theta s) + 1/(g + y + theta s)] ds,
            a = -overlap/2 - x (tip of the stator's fingers), b = overlap/2 (tip of the rotor's)
     plate  C = eps0 h int_-l/2^l/2 ds/(g - x + theta s)

   Each strip of length l between electrodes whose gap goes linearly from one end to the other, m in
   the middle, has int = (l/m) phi(q), q = (theta l/2m)^2, phi(q) = atanh(sqrt q)/sqrt q: closed at
   every tilt, by its series 1 + q/3 + q^2/5 + ... where q is small.

   Co-energy: f = +grad C V^2/2, E = -C V^2/2, the source feeds -C V V' besides (power balance of
   effects.h; the charge that it moves at constant V is C' V^2, half of it work). V^2 goes with the
   load factor. First and second derivatives of C are exact.

   Walls that lean, by l of the gap from the middle of the depth to either face, leave the gaps g + l z, -1 <= z <= 1: C is the mean
   over the depth, by the points of Gauss; of plates that stand parallel eps0 h L atanh(l/(g - x))/l, which pulls with the mean of
   1/gap^2, 1/((g - x)^2 - l^2). Three points up to l = g/10, else six: within 1e-4 of
   the pull while l is below 0.3 and 0.6 of the gap in the middle of the depth. Edges and tips are those of the same gaps.

   and ends of fingers, whose field goes with the distance of tips from the other comb's root (element.c).

   Inputs SI. Range: |gap change| <= 95 % of the gap at both ends, the fingers engaged and no nearer to
   the root than a fifth of the gap; small tilts (sin theta = theta). Left out: fringe fields (an effect of their own,
   fringe_field.c, which sets edge and end). Cost about 3700 instructions. Source: parallel plates piecewise, W. C. Tang et al.,
   Sens. Actuators A 21 (1990) 328; R. Legtenberg et al., J. Micromech. Microeng. 6 (1996) 320 (side
   instability). Test: test_comb_drive.c. */
#include "effects/effects.h"
#include "base/constants.h"
#include "effects/effect.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_nearest = 0.05; /* of the gap: nearer is called a touch */

/* ---- one strip ---- */

/* phi(q) = atanh(sqrt q)/sqrt q = sum q^n/(2n + 1), 0 <= q < 1, with phi' and phi'';
   2 q phi' = 1/(1 - q) - phi */
static void shape(double q, double phi[3]) {
    phi[0] = phi[1] = phi[2] = 0;
    if (q >= 0.2) {
        double root = sqrt(q), far = 1 / (1 - q); /* q >= 1: not a number */
        phi[0] = atanh(root) / root;
        phi[1] = (far - phi[0]) / (2 * q);
        phi[2] = (far * far - 3 * phi[1]) / (2 * q);
        return;
    }
    double power = 1;
    for (int n = 0; n < 40; n++, power *= q) {
        phi[0] += power / (2 * n + 1);
        phi[1] += (n + 1) * power / (2 * n + 3);
        phi[2] += (n + 2) * (n + 1) * power / (2 * n + 5);
        if (power * (n + 2) < DBL_EPSILON / 8) break;
    }
}

typedef struct strip { /* l, m, t: length, gap in the middle, tilt, and their slopes by x, y, theta
                        */
    double l, m, t;
    double by[3][3]; /* of l, m, t */
    double m_xt;     /* the one second derivative that is not 0: of m by x and theta */
} strip;

/* slopes of a function of l, m, t with the derivatives f, by those of what a strip stands at */
static void add_slope(const strip *s, double scale, const double f[3], double *slope) {
    for (int i = 0; i < 3; i++)
        slope[i] += scale * (f[0] * s->by[0][i] + f[1] * s->by[1][i] + f[2] * s->by[2][i]);
}

static void add_bend(const strip *s, double scale, double by_m, const double second[3][3],
                     double *bend) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 9; k++)
                bend[3 * i + j] += scale * s->by[k / 3][i] * second[k / 3][k % 3] * s->by[k % 3][j];
    bend[2] += scale * by_m * s->m_xt;
    bend[6] += scale * by_m * s->m_xt;
}

/* F = int ds/gap = (l/m) phi(q), r = t l/2m, q = r^2, w = 1/(1 - q) = phi + 2 q phi':
     F_l = w/m,  F_m = -l w/m^2,  F_t = (l/m)^2 r phi',  F_ll = 2 q w^2/(m l),
     F_lm = -(w + 2 q w^2)/m^2,  F_lt = l r w^2/m^2,  F_mm = 2 l (w + q w^2)/m^3,
     F_mt = -l^2 r w^2/m^3,  F_tt = (l/m)^3 (phi'/2 + q phi'')
   scale F is returned, its slopes are added */
static double add_strip(const strip *s, double scale, double *slope, double *bend) {
    double l = s->l, m = s->m, a = 1 / m, r = 0.5 * s->t * l * a, q = r * r, w = 1 / (1 - q);
    double phi[3], la = l * a;
    shape(q, phi);
    const double f[3] = {w * a, -la * w * a, la * la * r * phi[1]};
    if (slope) add_slope(s, scale, f, slope);
    if (bend) {
        double ww = w * w;
        double lm = -(w + 2 * q * ww) * a * a, lt = la * r * ww * a, mt = -la * la * r * ww * a;
        const double second[3][3] = {
            {0.5 * s->t * s->t * l * ww * a * a * a, lm, lt}, /* 2 q/l = t^2 l/2m^2 */
            {lm, 2 * la * (w + q * ww) * a * a, mt},
            {lt, mt, la * la * la * (0.5 * phi[1] + q * phi[2])}};
        add_bend(s, scale, f[1], second, bend);
    }
    return scale * la * phi[0];
}

/* int F ds over a strip, by two points of Gauss: m + a t l, a = +-1/sqrt 12. F is so flat that what this leaves out is
   below 1e-4 of it up to a tilt that halves the gap at an end. */
static double add_edge(const strip *s, const fw_effects_comb_element *c, double *slope,
                       double *bend) {
    const double l = s->l, t = s->t, scale = c->edge_F_per_m;
    double f[3] = {0}, second[3][3] = {{0}}, all = 0;
    for (int side = -1; side <= 1; side += 2) {
        const double a = side / sqrt(12.0);
        double by[2], at = c->edge(c, s->m + a * t * l, by);
        all += 0.5 * l * at;
        f[0] += 0.5 * (at + l * a * t * by[0]);
        f[1] += 0.5 * l * by[0];
        f[2] += 0.5 * l * l * a * by[0];
        if (!bend) continue;
        second[0][0] += a * t * (by[0] + 0.5 * l * a * t * by[1]);
        second[0][1] += 0.5 * (by[0] + l * a * t * by[1]);
        second[0][2] += l * a * (by[0] + 0.5 * l * a * t * by[1]);
        second[1][1] += 0.5 * l * by[1];
        second[1][2] += 0.5 * l * l * a * by[1];
        second[2][2] += 0.5 * l * l * l * a * a * by[1];
    }
    second[1][0] = second[0][1], second[2][0] = second[0][2], second[2][1] = second[1][2];
    if (slope) add_slope(s, scale, f, slope);
    if (bend) add_bend(s, scale, f[1], second, bend);
    return scale * all;
}

/* the ends of a plate, whose length stays: depth times that of the gaps there, m -+ t l/2 */
static double add_ends(const strip *s, const fw_effects_comb_element *c, double *slope,
                       double *bend) {
    const double l = s->l, scale = c->edge_F_per_m * c->depth_m;
    double f[3] = {0}, second[3][3] = {{0}}, all = 0;
    for (int side = -1; side <= 1; side += 2) {
        const double arm = 0.5 * side * l;
        double by[2];
        all += c->end(c, s->m + arm * s->t, by);
        f[1] += by[0];
        f[2] += arm * by[0];
        second[1][1] += by[1];
        second[1][2] += arm * by[1];
        second[2][2] += arm * arm * by[1];
    }
    second[2][1] = second[1][2];
    if (slope) add_slope(s, scale, f, slope);
    if (bend) add_bend(s, scale, f[1], second, bend);
    return scale * all;
}

/* One end of the fingers aside by Y: b (g/(g - Y) + g/(g + Y) - 2), b of the distance D = away - x. moves: of Y by x, y, theta */
static double add_end_aside(const fw_effects_comb_element *c, double scale, double away, double at,
                            const double moves[3], double xt, double *slope, double *bend) {
    const double g = c->gap_m, p = 1 / (g - at), n = 1 / (g + at);
    const double h = g * (p + n) - 2, h1 = g * (p * p - n * n),
                 h2 = 2 * g * (p * p * p + n * n * n);
    double by[2];
    const double b = fw_effects_comb_tip_aside(&c->tip, away, by);
    const double ahead[3] = {-1, 0, 0};
    for (int i = 0; slope && i < 3; i++)
        slope[i] += scale * (by[0] * ahead[i] * h + b * h1 * moves[i]);
    for (int i = 0; bend && i < 9; i++) {
        const int k = i / 3, l = i % 3;
        bend[i] += scale * (by[1] * ahead[k] * ahead[l] * h +
                            by[0] * h1 * (ahead[k] * moves[l] + moves[k] * ahead[l]) +
                            b * h2 * moves[k] * moves[l]);
    }
    if (bend) bend[2] += scale * b * h1 * xt, bend[6] += scale * b * h1 * xt;
    return scale * b * h;
}

/* Ends of all fingers, two gaps beside each, at both ends alike. Where the rotor turns its fingers come nearer to the root at one side of
   the comb: two places at the root mean square of theirs stand for all. Edges act at ends far from the root by 1.42 of what
   they do at faces, on what the root adds by 0.3 of it (elements in space, test_fringe.c). */
static double add_tips(const fw_effects_comb_element *c, const double place[3], double *slope,
                       double *bend) {
    const double edge = c->edge ? c->tip.edge_m : 0, half = 0.5 * c->overlap_m, t = place[2],
                 away = fw_effects_comb_away(c, place[0], 0),
                 root = c->edge_F_per_m * (c->depth_m + FW_EFFECTS_COMB_EDGE_AT_ROOT * edge);
    double all = 4 * c->edge_F_per_m * (c->depth_m + FW_EFFECTS_COMB_EDGE_AT_ENDS * edge) *
                 c->tip.ends,
           by[2];
    for (int side = -1; side <= 1; side += 2) {
        const double arm = side * c->tip.spread_m, turns[3] = {-1, 0, arm};
        all += 2 * root * fw_effects_comb_tip(&c->tip, away + arm * t, by);
        for (int i = 0; slope && i < 3; i++)
            slope[i] += 2 * root * by[0] * turns[i];
        for (int i = 0; bend && i < 9; i++)
            bend[i] += 2 * root * by[1] * turns[i / 3] * turns[i % 3];
    }
    const double rotor[3] = {0, 1, half}, stator[3] = {-t, 1, -half - place[0]};
    all += add_end_aside(c, root, away, place[1] + t * half, rotor, 0, slope, bend);
    return all +
           add_end_aside(c, root, away, place[1] - t * (half + place[0]), stator, -1, slope, bend);
}

/* of one gap; slope and bend are added to */
static double add_slice(const fw_effects_comb_element *c, const double place[3], double *slope,
                        double *bend) {
    const double x = place[0], y = place[1], t = place[2];
    double face = c->face_Fm;
    if (c->kind == FW_ELECTRODES_PLATE) {
        const strip only = {
            .l = c->length_m, .m = c->gap_m - x, .t = t, .by = {{0}, {-1, 0, 0}, {0, 0, 1}}};
        const double within = add_strip(&only, only.m > 0 ? face : (double)NAN, slope, bend);
        if (!c->edge || !isfinite(within)) return within;
        const double edges = add_edge(&only, c, slope, bend);
        return within + edges + add_ends(&only, c, slope, bend) + c->tip.corners_F;
    }
    /* the middle of the overlap is at s = -x/2 */
    double off = y - 0.5 * t * x, all = 0;
    if (!(fabs(off) < c->gap_m)) face = (double)NAN; /* beyond touch there is no field */
    for (int side = 1; side >= -1; side -= 2) {
        const strip one = {.l = c->overlap_m + x,
                           .m = c->gap_m - side * off,
                           .t = t,
                           .by = {{1, 0, 0}, {0.5 * side * t, -side, 0.5 * side * x}, {0, 0, 1}},
                           .m_xt = 0.5 * side};
        all += add_strip(&one, face, slope, bend);
        if (c->edge) all += add_edge(&one, c, slope, bend);
    }
    return all + (isfinite(all) ? add_tips(c, place, slope, bend) : 0);
}

/* points and weights of Gauss over -1 to 1, the positive half; M. Abramowitz, I. Stegun, table 25.4 */
static const double gauss_3[2][2] = {{0, 8.0 / 9}, {0.7745966692414834, 5.0 / 9}},
                    gauss_6[3][2] = {{0.2386191860831969, 0.4679139345726910},
                                     {0.6612093864662645, 0.3607615730481386},
                                     {0.9324695142031521, 0.1713244923791704}};

double fw_effects_comb_capacitance(const fw_effects_comb_element *c, const double place[3],
                                   double *slope, double *bend) {
    const double hardly = 0.1;
    const bool little = fabs(c->lean_m) < hardly * c->gap_m;
    const double(*point)[2] = little ? gauss_3 : gauss_6;
    double all = 0, by[3], bent[9];
    if (slope) memset(slope, 0, 3 * sizeof *slope);
    if (bend) memset(bend, 0, 9 * sizeof *bend);
    if (!(c->lean_m != 0)) return add_slice(c, place, slope, bend);
    for (int k = 0; k < 6; k++) {
        const int at = k / 2, side = k % 2 ? -1 : 1;
        fw_effects_comb_element slice = *c;
        if (little && (at == 2 || k == 1)) continue;
        slice.gap_m += side * point[at][0] * c->lean_m;
        memset(by, 0, sizeof by);
        memset(bent, 0, sizeof bent);
        all += 0.5 * point[at][1] * add_slice(&slice, place, slope ? by : NULL, bend ? bent : NULL);
        for (int i = 0; slope && i < 3; i++)
            slope[i] += 0.5 * point[at][1] * by[i];
        for (int i = 0; bend && i < 9; i++)
            bend[i] += 0.5 * point[at][1] * bent[i];
    }
    return all;
}

/* Half of what the long edges add, where something stands near or below; of ends and corners 3 %, and what wide bodies behind
   a plate add, up to 8 %, is less than that half. Without edges all of what they add is missing. */
double fw_effects_comb_capacitance_off(const fw_effects_comb_element *c, const double place[3]) {
    const bool comb = c->kind == FW_ELECTRODES_COMB;
    const double all = fw_effects_comb_capacitance(c, place, NULL, NULL),
                 left = c->edge ? 0.5 : 1.5;
    const double edges =
        comb ? 2 * c->edge_F_per_m *
                   (c->tip.edge_m * ((c->overlap_m + place[0]) / c->gap_m + 3 * c->tip.ends))
             : c->edge_F_per_m * c->length_m *
                   fw_effects_plate_edge(fmax(c->gap_m - place[0], 1e-3 * c->gap_m), c->width_m,
                                         c->depth_m, NULL);
    return 0.03 + left * edges / all;
}

/* ---- where the rotor is ---- */

static const fw_effects_comb_element *data_of(const fw_effects_force_element *e) {
    return e->data;
}

/* e of the stator as it stands */
static fw_geometry_vec2 along(const fw_effects_force_element *e, const double *p) {
    double turned = data_of(e)->direction_rad + p[2];
    return (fw_geometry_vec2){cos(turned), sin(turned)};
}

void fw_effects_comb_place(const fw_effects_force_element *e, const double *p, double place[3]) {
    fw_geometry_vec2 u = along(e, p);
    double dx = p[3] - p[0], dy = p[4] - p[1];
    place[0] = u.x * dx + u.y * dy;
    place[1] = -u.y * dx + u.x * dy;
    place[2] = p[5] - p[2] - data_of(e)->turn_rad;
}

/* d(place)/dp, 3 x 6: d = p1 - p0 and e turns with the stator: x' = e.d' + y theta_a' */
static void way(const fw_effects_force_element *e, const double *p, double j[3][6]) {
    fw_geometry_vec2 u = along(e, p);
    double place[3];
    fw_effects_comb_place(e, p, place);
    const double rows[3][6] = {{-u.x, -u.y, place[1], u.x, u.y, 0},
                               {u.y, -u.x, -place[0], -u.y, u.x, 0},
                               {0, 0, -1, 0, 0, 1}};
    memcpy(j, rows, sizeof rows);
}

void fw_effects_comb_rate(const fw_effects_force_element *e, const double *p, const double *w,
                          double rate[3]) {
    double j[3][6];
    way(e, p, j);
    for (int i = 0; i < 3; i++) {
        rate[i] = 0;
        for (int k = 0; k < 6; k++)
            rate[i] += j[i][k] * w[k];
    }
}

/* ---- the class ---- */

/* V and V' */
static void volts(const fw_effects_force_element *e, const fw_effects_port_state *s, double v[2]) {
    double value[3] = {1, 0, 0};
    if (e->law[0]) fw_quantity_law_value(e->law[0], s->t_s, s->piece_s, value);
    v[0] = data_of(e)->voltage_V * value[0];
    v[1] = data_of(e)->voltage_V * value[1];
}

static void modal_load(const fw_effects_force_element *e, const double *p, double half, double *f) {
    double place[3], slope[3], j[3][6];
    fw_effects_comb_place(e, p, place);
    fw_effects_comb_capacitance(data_of(e), place, slope, NULL);
    way(e, p, j);
    for (int k = 0; k < 6; k++)
        f[k] = half * (slope[0] * j[0][k] + slope[1] * j[1][k] + slope[2] * j[2][k]);
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double v[2];
    volts(e, s, v);
    modal_load(e, s->p, 0.5 * v[0] * v[0] * s->load, f);
}

static void slope_of(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    double v[2];
    volts(e, s, v);
    modal_load(e, s->p, 0.5 * v[0] * v[0], f);
}

/* -(J^T C'' J + sum C'_i d2(place_i)) V^2/2; second derivatives with the stator's turn: de = n, dn
   = -e, so d2x: n by points, -x by turns; d2y: -e by points, -y by turns */
static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    double v[2], place[3], slope[3], bend[9], j[3][6];
    volts(e, s, v);
    double half = 0.5 * v[0] * v[0] * s->load;
    fw_effects_comb_place(e, s->p, place);
    fw_effects_comb_capacitance(data_of(e), place, slope, bend);
    way(e, s->p, j);
    memset(damping, 0, 36 * sizeof *damping);
    for (int a = 0; a < 6; a++)
        for (int b = 0; b < 6; b++) {
            double curve = 0;
            for (int i = 0; i < 9; i++)
                curve += j[i / 3][a] * bend[i] * j[i % 3][b];
            stiffness[6 * a + b] = -half * curve;
        }
    for (int k = 0; k < 6; k++) {
        if (k % 3 == 2) continue;
        double turned = -half * (slope[0] * j[1][k] - slope[1] * j[0][k]);
        stiffness[6 * k + 2] += turned;
        stiffness[12 + k] += turned;
    }
    stiffness[14] += half * (slope[0] * place[0] + slope[1] * place[1]);
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    double v[2], place[3];
    volts(e, s, v);
    fw_effects_comb_place(e, s->p, place);
    return -0.5 * fw_effects_comb_capacitance(data_of(e), place, NULL, NULL) * v[0] * v[0] *
           s->load;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    double v[2], place[3];
    volts(e, s, v);
    fw_effects_comb_place(e, s->p, place);
    out[0] = 0;
    out[1] = -fw_effects_comb_capacitance(data_of(e), place, NULL, NULL) * v[0] * v[1] * s->load;
}

/* the gap that is left at the nearer end and face, relative to the gap in the middle of the depth */
static double least_gap(const fw_effects_comb_element *c, const double place[3]) {
    const double leans = fabs(c->lean_m);
    if (c->kind == FW_ELECTRODES_PLATE)
        return 1 - (leans + place[0] + 0.5 * c->length_m * fabs(place[2])) / c->gap_m;
    double at_stator = place[1] - place[2] * (0.5 * c->overlap_m + place[0]);
    double at_rotor = place[1] + place[2] * 0.5 * c->overlap_m;
    return 1 - (leans + fmax(fabs(at_stator), fabs(at_rotor))) / c->gap_m;
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    const fw_effects_comb_element *c = data_of(e);
    double place[3];
    fw_effects_comb_place(e, s->p, place);
    if (c->kind == FW_ELECTRODES_COMB && !(c->overlap_m + place[0] > 0)) {
        *why = "the fingers of the comb drive have left each other: the capacitance of an engaged "
               "comb does not hold there. Draw them with more overlap, or move less";
        return false;
    }
    if (c->kind == FW_ELECTRODES_COMB &&
        !(fw_effects_comb_away(c, place[0], place[2]) > FW_EFFECTS_COMB_NEAREST_ROOT * c->gap_m)) {
        *why = "fingers of the comb drive have come within a fifth of its gap of the root of the "
               "other comb, whose pull "
               "grows without end there: draw longer fingers, or use less voltage";
        return false;
    }
    if (!(least_gap(c, place) >= fw_nearest)) {
        *why = "the electrodes have come within 5 % of their gap of each other: they touch, "
               "which is pull-in. Use less voltage, a stiffer suspension or a wider gap";
        return false;
    }
    return true;
}

static const fw_effects_element_class comb_class = {.effect = "comb-drive",
                                                    .electrodes = true,
                                                    .force = force,
                                                    .tangent = tangent,
                                                    .energy = energy,
                                                    .power = power,
                                                    .slope = slope_of,
                                                    .valid = valid};

const fw_effects_comb_element *fw_effects_comb_of(const fw_effects_force_element *e) {
    return e->class_ == &comb_class ? data_of(e) : NULL;
}

/* ---- the row ---- */

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->ncomb; i++)
        if (c->scene->comb[i].voltage_V != 0) return true;
    return false;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    (void)c;
    *value = (double)INFINITY;
    *reason = "the scene drives combs with a voltage: they are the motion itself";
    return FW_OK;
}

/* a world point as the body sees it, as drawn */
static fw_effects_port port_at(const fw_mechanism *m, int body, fw_geometry_vec2 world) {
    if (body == FW_GROUND) return (fw_effects_port){body, world.x, world.y};
    const fw_mechanism_mass *b = &m->body[body];
    double dx = world.x - b->x_m, dy = world.y - b->y_m, c = cos(b->phi_rad), s = sin(b->phi_rad);
    return (fw_effects_port){body, c * dx + s * dy, -s * dx + c * dy};
}

static fw_status add_one(const fw_effect_case *c, const fw_device_comb *from,
                         fw_effects_loads *loads) {
    fw_effects_comb_element *d;
    fw_effects_force_element *e;
    FW_NEED(d = fw_arena_one(c->arena, fw_effects_comb_element));
    FW_NEED(e = fw_effects_loads_add_element(c->arena, loads, &comb_class, 2));
    *d = fw_effects_comb_as_drawn(c, from);
    fw_geometry_vec2 world =
        fw_mechanism_local_place(c->mechanism, from->body_b, from->bx_m, from->by_m);
    e->id = from->id ? from->id : "comb-drive";
    e->place = from->place;
    e->data = d;
    e->port[0] = port_at(c->mechanism, from->body_a, world);
    e->port[1] = (fw_effects_port){from->body_b, from->bx_m, from->by_m};
    if (!fw_quantity_law_is_constant(from->law)) e->law[e->laws++] = from->law;
    e->works = e->laws > 0;
    const double as_drawn[3] = {0, 0, 0};
    double slope[3], bend[9];
    fw_effects_comb_capacitance(d, as_drawn, slope, bend);
    double volt = d->voltage_V * fw_quantity_law_largest(from->law, c->scene->duration_s);
    e->force_N = 0.5 * volt * volt * fabs(slope[0]);
    e->size_N_per_m = 0.5 * volt * volt * fmax(fabs(bend[0]), fabs(bend[4]));
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->scene->ncomb; i++)
        if (c->scene->comb[i].voltage_V != 0) FW_TRY(add_one(c, &c->scene->comb[i], loads));
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    return c->scene->ncomb;
}

static const char *id_of(const fw_device *device, int body) {
    return body < 0 ? "ground" : device->body[body].id;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    for (int i = 0; i < s->ncomb; i++) {
        const fw_device_comb *c = &s->comb[i];
        fw_effects_say(to, "; {s} {s} between {s} and {s} at {u}",
                       c->kind == FW_ELECTRODES_COMB ? "comb" : "plates", c->id,
                       id_of(device, c->body_b), id_of(device, c->body_a), c->voltage_V, "V");
        fw_effects_say_law(to, c->law);
    }
}

static void loads(const fw_device_scene *s, fw_effects_load_scaling *list) {
    if (s->ncomb > 0)
        fw_effects_add_load(list, (fw_effects_load){.name = "voltages", .squared = true});
}

static void scale(fw_device_scene *s, double by) {
    for (int i = 0; i < s->ncomb; i++)
        s->comb[i].voltage_V *= sqrt(by);
}

static void values(const fw_device_scene *s, fw_effects_load_values *list) {
    for (int i = 0; i < s->ncomb; i++)
        fw_effects_add_load_value(list, (fw_effects_load_value){.element = "comb-drive",
                                                                .id = s->comb[i].id,
                                                                .attribute = "voltage",
                                                                .unit = "V",
                                                                .value = s->comb[i].voltage_V,
                                                                .squared = true});
}

const fw_effect_row fw_effect_comb_drive = {
    .id = "comb-drive",
    .summary = "electrostatic forces between the electrodes of comb drives and plates",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 5360,
    .count = count,
    .kept = true,
    .describe = describe,
    .loads = loads,
    .scale = scale,
    .values = values};
