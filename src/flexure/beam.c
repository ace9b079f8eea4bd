/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/beam.h"
#include "base/constants.h"
#include "flexure/section.h"
#include <math.h>

static double sinc(double x) {
    return fabs(x) < 1e-4 ? 1 - x * x / 6 : sin(x) / x;
}

/* s along a piece: the chord of an arc of angle k s is s sinc(k s/2), in the direction half way */
static fw_flexure_beam_pose along(const fw_flexure_beam_pose *from, double curvature_per_m,
                                  double s_m) {
    double half = 0.5 * curvature_per_m * s_m, chord = s_m * sinc(half);
    return (fw_flexure_beam_pose){from->x_m + chord * cos(from->psi_rad + half),
                                  from->y_m + chord * sin(from->psi_rad + half),
                                  from->psi_rad + 2 * half};
}

static fw_flexure_beam_pose first(const fw_flexure_beam *b) {
    return (fw_flexure_beam_pose){b->x_m, b->y_m, b->psi_rad};
}

void fw_flexure_beam_poses(const fw_flexure_beam *b, fw_flexure_beam_pose *out) {
    fw_flexure_beam_pose at = first(b);
    for (int i = 0; i < b->npiece; i++) {
        at.psi_rad += b->piece[i].kink_rad;
        out[i] = at;
        at = along(&at, b->piece[i].curvature_per_m, b->piece[i].length_m);
    }
    out[b->npiece] = at;
}

static double width_at(const fw_flexure_beam *b, int piece, double s_m) {
    if (b->width) return b->width(b->context, piece, s_m);
    const double *w = b->piece[piece].width_m, z = s_m / b->piece[piece].length_m;
    double rise = w[2] - w[0], bow = 2 * (w[0] - 2 * w[1] + w[2]);
    return w[0] + z * rise - z * (1 - z) * bow;
}

/* of 1/E, by both ends */
static double lost_at(const fw_flexure_beam *b, int piece, double s_m) {
    double before = s_m, behind = -s_m, sum = 0;
    if (b->lost_per_Pa[0] == 0 && b->lost_per_Pa[1] == 0) return 0;
    for (int i = 0; i < piece; i++)
        before += b->piece[i].length_m;
    for (int i = piece; i < b->npiece; i++)
        behind += b->piece[i].length_m;
    if (b->lost_per_Pa[0] != 0) sum += b->lost_per_Pa[0] * exp(-before / b->lost_m[0]);
    if (b->lost_per_Pa[1] != 0) sum += b->lost_per_Pa[1] * exp(-behind / b->lost_m[1]);
    return sum;
}

void fw_flexure_beam_at(const fw_flexure_beam *b, int piece, const fw_flexure_beam_pose *start,
                        double s_m, fw_flexure_beam_section *out) {
    out->pose = along(start, b->piece[piece].curvature_per_m, s_m);
    double t = out->width_m = width_at(b, piece, s_m);
    double four = b->cubic ? cos(4 * (out->pose.psi_rad + b->orientation_rad)) : 0;
    double per_E = b->cubic ? b->a0_per_Pa + b->a1_per_Pa * four : 1 / b->youngs_Pa;
    double per_G = b->cubic ? b->g0_per_Pa + b->g1_per_Pa * four : 0;
    double per_A = 1 / (b->depth_m * t), depth = b->depth_factor > 0 ? b->depth_factor : 1;
    if (!(per_G > 0)) per_G = 1 / b->shear_Pa;
    if (b->stiffer) depth *= b->stiffer(b->context, piece, s_m);
    out->bend_per_Nm2 = 12 * (per_E - lost_at(b, piece, s_m)) * per_A / (t * t * depth);
    out->axial_per_N = b->inextensible ? 0 : per_E * per_A / (1 + b->along);
    out->shear_per_N = b->inextensible ? 0 : 1.2 * per_A * per_G;
}

/* sums over the beam, about a point: of 1/EI times 1, x, y, x^2, x y, y^2, and of what axial and
   shear strain add to xx, xy, yy */
enum { W1, WX, WY, WXX, WXY, WYY, AXX, AXY, AYY, SUMS };

static void add(const fw_flexure_beam_section *at, double weight, const double about[2],
                double *sum) {
    double x = at->pose.x_m - about[0], y = at->pose.y_m - about[1], w = weight * at->bend_per_Nm2;
    double c = cos(at->pose.psi_rad), s = sin(at->pose.psi_rad);
    double n = weight * at->axial_per_N, v = weight * at->shear_per_N;
    sum[W1] += w, sum[WX] += w * x, sum[WY] += w * y;
    sum[WXX] += w * x * x, sum[WXY] += w * x * y, sum[WYY] += w * y * y;
    sum[AXX] += n * c * c + v * s * s;
    sum[AXY] += (n - v) * c * s;
    sum[AYY] += n * s * s + v * c * c;
}

typedef struct rule {
    double node[FW_GAUSS_MOST], weight[FW_GAUSS_MOST];
} rule;

/* each piece cut into `panels` panels of 16 nodes; the roots weigh dL/EI and bend only */
static void integrate(const fw_flexure_beam *b, const rule *r, int panels, const double about[2],
                      double *sum) {
    fw_flexure_beam_section at;
    fw_flexure_beam_pose start = first(b);
    for (int k = 0; k < SUMS; k++)
        sum[k] = 0;
    for (int i = 0; i < b->npiece; i++) {
        double length = b->piece[i].length_m, h = length / panels;
        start.psi_rad += b->piece[i].kink_rad;
        for (int j = 0; j < panels; j++)
            for (int k = 0; k < FW_GAUSS_MOST; k++) {
                fw_flexure_beam_at(b, i, &start, (j + r->node[k]) * h, &at);
                add(&at, r->weight[k] * h, about, sum);
            }
        for (int end = 0; end < 2; end++)
            if (end ? i == b->npiece - 1 : i == 0) {
                fw_flexure_beam_at(b, i, &start, end ? length : 0, &at);
                at.axial_per_N = at.shear_per_N = 0;
                add(&at, b->root_m[end], about, sum);
            }
        start = along(&start, b->piece[i].curvature_per_m, length);
    }
}

/* centre of the weights about a first guess, and the sums about it: twice, so that what is left of
   the first moments is small and nothing cancels in the second ones */
static void centred(const fw_flexure_beam *b, const rule *r, int panels, double centre[2],
                    double *sum) {
    centre[0] = b->x_m, centre[1] = b->y_m;
    for (int turn = 0; turn < 2; turn++) {
        integrate(b, r, panels, centre, sum);
        centre[0] += sum[WX] / sum[W1], centre[1] += sum[WY] / sum[W1];
    }
    double x = sum[WX] / sum[W1], y = sum[WY] / sum[W1];
    sum[WXX] -= x * sum[WX], sum[WXY] -= x * sum[WY], sum[WYY] -= y * sum[WY];
}

static double apart(const double *a, const double *b, const double p[2], const double q[2],
                    double length) {
    double bend = fabs(a[WXX]) + fabs(a[WYY]), e = fabs(a[W1] - b[W1]) / fabs(a[W1]);
    for (int i = 0; i < 2; i++)
        e = fmax(e, fabs(p[i] - q[i]) / length);
    for (int k = WXX; k <= WYY; k++)
        e = fmax(e, fabs(a[k] - b[k]) / bend);
    double stretch = fabs(a[AXX]) + fabs(a[AYY]);
    for (int k = AXX; k <= AYY; k++)
        if (stretch > 0) e = fmax(e, fabs(a[k] - b[k]) / stretch);
    return e;
}

static void describe(const fw_flexure_beam *b, fw_flexure_beam_linear *out) {
    fw_flexure_beam_pose at = first(b);
    out->length_m = 0;
    for (int i = 0; i < b->npiece; i++) {
        at.psi_rad += b->piece[i].kink_rad;
        at = along(&at, b->piece[i].curvature_per_m, b->piece[i].length_m);
        out->length_m += b->piece[i].length_m;
    }
    out->end = at;
    out->turn_rad = at.psi_rad - b->psi_rad;
    out->chord_m = hypot(at.x_m - b->x_m, at.y_m - b->y_m);
    out->chord_rad = atan2(at.y_m - b->y_m, at.x_m - b->x_m);
}

/* With w = 1/EI, P = (x, y) the centre line, t and n its tangent and normal, root weights dL/EI:
     W  = int w P ds/int w ds
     C  = int w b b' ds + int (t t'/EA + n n'/(kGA)) ds,  b = (1, y - yW, -(x - xW))
   in the order (theta, ux, uy). A section's axial force and moment are not coupled (Reissner), so
   that W is the centre of compliance too; the coupling of a thick arc moves it by r u^2/3 sin(a)/a
   (u = t/2r), which closed forms of arcs have and this has not.
   in: beam; SI. out: W, C and the shape of the centre line; error: difference of two divisions of
   the pieces, the finer one of which is returned (16 nodes a panel: a uniform arc below half a turn
   a panel is exact to rounding, hence no closed form for it).
   Valid for any shape; cost 12 us for a uniform arc. Source: Castigliano; docs/theory/beams.md.
   Test: test_beam.c */
void fw_flexure_beam_compliance(const fw_flexure_beam *b, fw_flexure_beam_linear *out) {
    enum { FINEST = 1024 };
    double sum[2][SUMS], centre[2][2];
    *out = (fw_flexure_beam_linear){0};
    describe(b, out);
    rule r;
    fw_flexure_gauss_rule(FW_GAUSS_MOST, r.node, r.weight);
    int now = 0;
    centred(b, &r, 1, centre[0], sum[0]);
    for (int panels = 2; panels <= FINEST; panels *= 2) {
        now = !now;
        centred(b, &r, panels, centre[now], sum[now]);
        out->error = apart(sum[now], sum[!now], centre[now], centre[!now], out->length_m);
        if (out->error < 4e-15) break;
    }
    const double *s = sum[now];
    for (int i = 0; i < 2; i++)
        out->centre_m[i] = centre[now][i];
    out->c[0][0] = s[W1];
    out->c[1][1] = s[WYY] + s[AXX];
    out->c[2][2] = s[WXX] + s[AYY];
    out->c[1][2] = out->c[2][1] = s[AXY] - s[WXY];
    /* c[0][1] = int w (y - yW) and c[0][2] are zero by the choice of W */
    out->compliance_centre_m[0] = out->centre_m[0] + out->c[2][0] / out->c[0][0];
    out->compliance_centre_m[1] = out->centre_m[1] - out->c[1][0] / out->c[0][0];
    out->error = fmax(out->error, 4e-15);
}

/* P_0 .. P_n at x by their recurrence */
static void legendre(int n, long double x, long double *p) {
    p[0] = 1;
    if (n > 0) p[1] = x;
    for (int k = 2; k <= n; k++)
        p[k] = ((2 * k - 1) * x * p[k - 1] - (k - 1) * p[k - 2]) / k;
}

/* roots of P_n by Newton's method from cos(pi (i + 3/4)/(n + 1/2)), weight on [-1, 1]
     w = 2 (1 - x^2)/(n P_(n-1)(x))^2
   in: n <= FW_GAUSS_MOST. out: nodes and weights on [0, 1], rounded from long double; exact for
   polynomials of degree 2 n - 1. Source: Abramowitz and Stegun 25.4.29.
   Test: test_beam.c rules_are_exact */
void fw_flexure_gauss_rule(int n, double *node, double *weight) {
    long double p[FW_GAUSS_MOST + 1];
    for (int i = 0; i < (n + 1) / 2; i++) {
        long double x = cosl((long double)FW_PI * (i + 0.75L) / (n + 0.5L));
        for (int k = 0; k < 5; k++) {
            legendre(n, x, p);
            x -= p[n] * (x * x - 1) / (n * (x * p[n] - p[n - 1]));
        }
        legendre(n, x, p);
        node[n - 1 - i] = (double)(0.5L * (1 + x));
        node[i] = (double)(0.5L * (1 - x));
        weight[i] = weight[n - 1 - i] =
            (double)((1 - x * x) / ((long double)n * n * p[n - 1] * p[n - 1]));
    }
}

/* The j-th Lagrange polynomial is w_j sum_k (2k + 1)/2 P_k(x_j) P_k(x), since the rule is exact for
   the products; the integral of (2k + 1) P_k is P_(k+1) - P_(k-1).
   Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5.
   Test: test_beam.c rules_are_exact */
void fw_flexure_gauss_integrals(int n, const double *node, const double *weight, double *a) {
    long double at[FW_GAUSS_MOST + 2], of[FW_GAUSS_MOST + 2];
    for (int i = 0; i < n; i++) {
        long double x = 2 * (long double)node[i] - 1;
        legendre(n, x, at);
        for (int j = 0; j < n; j++) {
            legendre(n, 2 * (long double)node[j] - 1, of);
            long double sum = x + 1;
            for (int k = 1; k < n; k++)
                sum += of[k] * (at[k + 1] - at[k - 1]);
            a[i * n + j] = (double)(0.5L * (long double)weight[j] * sum);
        }
    }
}
