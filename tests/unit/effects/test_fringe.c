/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The field at the edges of a comb's fingers, against boundary elements of its own: the cross-section of a comb that
   goes on for ever aside, two fingers to a period, charges on panels that crowd towards the corners. */
#include "drive_rig.h"
#include "effects/effects.h"
#include "maths/matrix.h"
#include <complex.h>

/* ---- boundary elements ---- */

enum { SIDE = 26, FACES = 4, PANELS = 2 * FACES * SIDE };

typedef struct panel {
    double complex a, b;
} panel;

/* -1/(2 pi) int ln|z - zeta| |d zeta| over a panel: the real part of a closed form */
static double panel_log(panel p, double complex z) {
    double complex d = (p.b - p.a) / cabs(p.b - p.a), u = (z - p.a) / d, v = (z - p.b) / d;
    double at_u = cabs(u) > 0 ? creal(u * clog(u)) : 0, at_v = cabs(v) > 0 ? creal(v * clog(v)) : 0;
    return -(at_u - at_v - cabs(p.b - p.a)) / (2 * M_PI);
}

/* all images at x + k period: -ln|2 sin(pi z/period)|/(2 pi), the nearest in closed form */
static double influence(panel p, double complex z, double period) {
    static const double at[3] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[3] = {5. / 18, 8. / 18, 5. / 18};
    double all = 0, length = cabs(p.b - p.a);
    for (int k = -1; k <= 1; k++)
        all += panel_log(p, z - k * period);
    for (int i = 0; i < 3; i++) {
        double complex r = z - (0.5 * (p.a + p.b) + 0.5 * at[i] * (p.b - p.a)), s = 2 * csin(M_PI * r / period);
        double smooth = log(cabs(s));
        if (cabs(r) < 1e-9 * period) { /* what is left of the sine as all go to 0 */
            smooth = log(2 * M_PI / period) - 2 * log(period);
        } else {
            for (int k = -1; k <= 1; k++)
                smooth -= log(cabs(r - k * period));
        }
        all -= weight[i] * length * smooth / (2 * M_PI);
    }
    return all;
}

/* C/eps0 per length of a finger of width w and depth h, the gaps beside it being one and other */
static double elements(double w, double h, double one, double other) {
    static panel p[PANELS];
    static double matrix[(PANELS + 1) * (PANELS + 1)], q[PANELS + 1];
    static int pivot[PANELS + 1];
    const double period = 2 * w + one + other;
    int n = 0;
    for (int finger = 0; finger < 2; finger++) {
        const double left = finger ? w + one : 0;
        const double complex up = h * csqrt(-1);
        const double complex corner[5] = {left, left + w, left + w + up, left + up, left};
        for (int f = 0; f < FACES; f++)
            for (int i = 0; i < SIDE; i++) {
                double s = 0.5 * (1 - cos(M_PI * i / SIDE)), t = 0.5 * (1 - cos(M_PI * (i + 1) / SIDE));
                /* once more towards the corners, where the charge is without bound */
                s = s * s * (3 - 2 * s), t = t * t * (3 - 2 * t);
                p[n++] = (panel){corner[f] + s * (corner[f + 1] - corner[f]), corner[f] + t * (corner[f + 1] - corner[f])};
            }
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            matrix[i * (n + 1) + j] = influence(p[j], 0.5 * (p[i].a + p[i].b), period);
        matrix[i * (n + 1) + n] = 1; /* the potential far away; no charge in a period */
        matrix[n * (n + 1) + i] = cabs(p[i].b - p[i].a);
        q[i] = i < n / 2 ? 0.5 : -0.5;
    }
    matrix[n * (n + 1) + n] = 0, q[n] = 0;
    assert_true(fw_maths_lu_factor(n + 1, matrix, pivot));
    fw_maths_lu_solve(n + 1, matrix, pivot, NULL, q);
    double charge = 0;
    for (int i = 0; i < n / 2; i++)
        charge += q[i] * cabs(p[i].b - p[i].a);
    return charge;
}

static double closed(double w, double h, double one, double other) {
    return h / one + h / other + fw_effects_comb_edge(one, w, NULL) + fw_effects_comb_edge(other, w, NULL);
}

/* ---- ends of fingers, seen from above ---- */

typedef struct outline {
    panel p[700];
    double volt[700];
    int n;
} outline;

static void line(outline *to, double complex a, double complex b, int n, double volt) {
    for (int i = 0; i < n; i++) {
        double s = 0.5 * (1 - cos(M_PI * i / n)), t = 0.5 * (1 - cos(M_PI * (i + 1) / n));
        s = s * s * (3 - 2 * s), t = t * t * (3 - 2 * t);
        to->volt[to->n] = volt;
        to->p[to->n++] = (panel){a + s * (b - a), a + t * (b - a)};
    }
}

/* a finger along the imaginary axis about x, from its root to its tip, whose corners are rounded */
static void finger(outline *to, double x, double root, double tip, double w, double r, double volt) {
    enum { ARC = 12 };
    const double up = tip > root ? 1 : -1, h = 0.5 * w;
    const double complex i1 = csqrt(-1);
    for (int side = -1; side <= 1; side += 2) {
        line(to, x + side * h + i1 * root, x + side * h + i1 * (tip - up * r), 32, volt);
        for (int k = 0; k < ARC && r > 0; k++) {
            const double s = 0.5 * M_PI * k / ARC, t = 0.5 * M_PI * (k + 1) / ARC;
            to->volt[to->n] = volt;
            to->p[to->n++] = (panel){x + side * (h - r + r * cos(s)) + i1 * (tip - up * r * (1 - sin(s))),
                                     x + side * (h - r + r * cos(t)) + i1 * (tip - up * r * (1 - sin(t)))};
        }
    }
    line(to, x - h + r + i1 * tip, x + h - r + i1 * tip, 20, volt);
}

/* C/eps0 per depth of one finger of each side, w wide, gaps g, engaged by ov, tips away from the roots, the rotor aside */
static double cell(double w, double g, double ov, double away, double aside, double r) {
    static outline o;
    static double matrix[701 * 701], q[701];
    static int pivot[701];
    const double pitch = w + g, period = 2 * pitch, top = ov + 2 * away;
    const double complex i1 = csqrt(-1);
    o.n = 0;
    finger(&o, aside, 0, ov + away, w, r, 1);
    line(&o, aside + 0.5 * w, aside - 0.5 * w + period, 32, 1);
    finger(&o, pitch, top, away, w, r, 0);
    line(&o, -pitch + 0.5 * w + i1 * top, pitch - 0.5 * w + i1 * top, 32, 0);
    const int n = o.n;
    assert_true(n <= 700);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            matrix[i * (n + 1) + j] = influence(o.p[j], 0.5 * (o.p[i].a + o.p[i].b), period);
        matrix[i * (n + 1) + n] = 1;
        matrix[n * (n + 1) + i] = cabs(o.p[i].b - o.p[i].a);
        q[i] = o.volt[i];
    }
    matrix[n * (n + 1) + n] = 0, q[n] = 0;
    assert_true(fw_maths_lu_factor(n + 1, matrix, pivot));
    fw_maths_lu_solve(n + 1, matrix, pivot, NULL, q);
    double charge = 0;
    for (int i = 0; i < n; i++)
        if (o.volt[i] > 0.5) charge += q[i] * cabs(o.p[i].b - o.p[i].a);
    return charge;
}

/* Tips from a quarter of a gap to three gaps from the root: the pull along, C with all of its ends, of fingers as they are drawn, with
   round tips, within 5 and 2 %; without the ends' part C is off by a third and the pull by ten times */
static void ends_of_fingers(void **state) {
    (void)state;
    const double width[] = {8, 2, 20}, gap[] = {10, 5, 8}, away[] = {0.25, 0.5, 1, 1.8, 3};
    double pull = 0, whole = 0, without = 0, missed = 0;
    for (int i = 0; i < test_fewest(3, 1); i++)
        for (int k = 0; k < 5; k++) {
            const double w = width[i], g = gap[i], d = away[k] * g, r = fmin(3, 0.4 * w), step = 0.02 * g, ov = 2 * g;
            const fw_effects_comb_tips tip = fw_effects_comb_tips_of(g * 1e-6, w * 1e-6, 20);
            double by[2], G = fw_effects_comb_tip(&tip, d * 1e-6, by);
            const double far = cell(w, g, ov - step, d + step, 0, r), near = cell(w, g, ov + step, d - step, 0, r),
                         want = 0.25 * g * (near - far) / step, got = 1 - 2e-6 * g * by[0];
            pull = fmax(pull, fabs(got / want - 1));
            whole = fmax(whole, fabs((2 * ov / g + 4 * (tip.ends + G)) / (0.5 * (near + far)) - 1));
            without = fmax(without, 1 - 4 * ov / g / (near + far));
            missed = fmax(missed, want);
        }
    assert_true(pull < 5e-2 && whole < 2e-2);
    assert_true(without > 0.35 && missed > 10);
}

/* square tips, far from the root: exact; by a motion across ends are as if the overlap were longer, from an overlap of half a gap on */
static void ends_aside(void **state) {
    (void)state;
    const double width[] = {8, 2, 20}, overlap[] = {10, 5, 30}, away[] = {60, 10, 5};
    for (int i = 0; i < test_fewest(3, 1); i++) {
        const double w = width[i], g = 10, ov = overlap[i];
        assert_relative(cell(w, g, ov, 60, 0, 0), 2 * ov / g + 4 * fw_effects_comb_edge(2 * g, w, NULL), 2e-2);
        for (int k = 0; k < 3; k++) {
            const fw_effects_comb_tips tip = fw_effects_comb_tips_of(g * 1e-6, w * 1e-6, 20);
            if (ov + away[k] < 1.5 * g) continue; /* FW-D715 */
            if (ov + away[k] < 1.5 * g) continue; /* FW-D715 */
            const double d = away[k], y = 2, more = 1 / (g - y) + 1 / (g + y) - 2 / g;
            double by[2], b = fw_effects_comb_tip_aside(&tip, d * 1e-6, by);
            const double want = (cell(w, g, ov, d, y, 0) - cell(w, g, ov, d, 0, 0)) / more;
            assert_relative(ov + 2 * b * g, want, 0.06);
        }
    }
}

/* ---- two bars in open space ---- */

/* C/eps0 per length of two rectangles, x along their gap: panels as above, no charge in all */
static double bars(const double rect[2][4]) {
    enum { MOST = 2 * 4 * 60 };
    static panel p[MOST];
    static double matrix[(MOST + 1) * (MOST + 1)], q[MOST + 1];
    static int pivot[MOST + 1];
    const double complex i1 = csqrt(-1);
    int n = 0, first = 0;
    for (int bar = 0; bar < 2; bar++) {
        const double *r = rect[bar];
        const double complex corner[5] = {r[0] + i1 * r[2], r[1] + i1 * r[2], r[1] + i1 * r[3], r[0] + i1 * r[3], r[0] + i1 * r[2]};
        for (int f = 0; f < 4; f++)
            for (int i = 0; i < 60; i++) {
                double s = 0.5 * (1 - cos(M_PI * i / 60)), t = 0.5 * (1 - cos(M_PI * (i + 1) / 60));
                p[n++] = (panel){corner[f] + s * (corner[f + 1] - corner[f]), corner[f] + t * (corner[f + 1] - corner[f])};
            }
        if (bar == 0) first = n;
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            matrix[i * (n + 1) + j] = panel_log(p[j], 0.5 * (p[i].a + p[i].b));
        matrix[i * (n + 1) + n] = 1;
        matrix[n * (n + 1) + i] = cabs(p[i].b - p[i].a);
        q[i] = i < first ? 0.5 : -0.5;
    }
    matrix[n * (n + 1) + n] = 0, q[n] = 0;
    assert_true(fw_maths_lu_factor(n + 1, matrix, pivot));
    fw_maths_lu_solve(n + 1, matrix, pivot, NULL, q);
    double charge = 0;
    for (int i = 0; i < first; i++)
        charge += q[i] * cabs(p[i].b - p[i].a);
    return charge;
}

static double equal_bars(double g, double w, double h) {
    const double rect[2][4] = {{-w, 0, 0, h}, {g, g + w, 0, h}};
    return bars(rect);
}

/* C and the pull of equal bars, from a twentieth to three times their depth apart */
static void fringe_of_bars(void **state) {
    (void)state;
    const double width[] = {0.08, 0.4, 0.8, 4}, gap[] = {0.05, 0.12, 0.4, 1, 3};
    double worst = 0, pull = 0;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 5; k++) {
            const double w = width[i], g = gap[k], d = 0.04 * g;
            double by[2], F = fw_effects_plate_edge(g, w, 1, by), want = equal_bars(g, w, 1);
            double slope = (equal_bars(g - d, w, 1) - equal_bars(g + d, w, 1)) / (2 * d) * (1 - 0.0016);
            worst = fmax(worst, fabs((1 / g + F) / want - 1));
            pull = fmax(pull, fabs((1 / (g * g) - by[0]) / slope - 1));
        }
    assert_true(worst < 4e-3 && pull < 1.8e-2);
    /* what bars of another size have is that of the same shape */
    double by[2], same[2];
    assert_relative(fw_effects_plate_edge(5e-6, 40e-6, 50e-6, by), fw_effects_plate_edge(0.1, 0.8, 1, same), 1e-12);
    assert_relative(by[0] * 50e-6, same[0], 1e-12);
    assert_relative(by[1] * 2500e-12, same[1], 1e-12);
}

/* in the plane of the wafer, as plates are drawn: the stator is longer by the gap and 10 um at either end */
static void ends_of_plates(void **state) {
    (void)state;
    const struct {
        double l, g, share, pull;
    } at[] = {{200, 5, 7e-3, 1e-2}, {400, 3, 7e-3, 1e-2}, {400, 6, 7e-3, 1e-2}, {800, 10, 7e-3, 1e-2}, {200, 20, 1e-2, 3e-2}};
    for (int i = 0; i < test_fewest((int)(sizeof at / sizeof at[0]), 1); i++) {
        const double l = at[i].l, g = at[i].g, w = 40, d = 0.04 * g;
        double c[3], by[2], end = fw_effects_plate_end(g, w, l, by);
        for (int k = -1; k <= 1; k++) {
            const double x = g + k * d, more = g + 10;
            const double rect[2][4] = {{-w, 0, 0, l}, {x, x + w, -more, l + more}};
            c[k + 1] = bars(rect);
        }
        assert_relative(l / g + 2 * end, c[1], at[i].share);
        assert_relative(l / (g * g) - 2 * by[0], (c[0] - c[2]) / (2 * d) * (1 - 0.0016), at[i].pull);
    }
}

/* ---- whole plates, in space ---- */

typedef struct patch { /* a rectangle at `at` of the axis, from u0 to u1 and v0 to v1 of the other two */
    int axis;
    double at, u0, u1, v0, v1;
} patch;

/* 4 pi times the potential of a unit of charge per area: u ln(v + r) + v ln(u + r) - z atan(u v/(z r)) at the corners */
static double patch_potential(const patch *p, const double x[3]) {
    const double z = x[p->axis] - p->at, u[2] = {p->u0 - x[p->axis == 0], p->u1 - x[p->axis == 0]};
    const int other = p->axis == 2 ? 1 : 2;
    const double v[2] = {p->v0 - x[other], p->v1 - x[other]};
    double sum = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            double r = sqrt(u[i] * u[i] + v[j] * v[j] + z * z), one = 0;
            if (v[j] + r > 0) one += u[i] * log(v[j] + r);
            if (u[i] + r > 0) one += v[j] * log(u[i] + r);
            if (z != 0) one -= z * atan(u[i] * v[j] / (z * r));
            sum += i == j ? one : -one;
        }
    return sum;
}

/* patches of a quarter of a box, whose planes y = 0 and z = 0 it is its own image in; they crowd towards its edges */
static int cut(const double x[2], double y, double z, patch *out) {
    enum { X = 9, Y = 14, Z = 9 };
    double at[X + 1], up[Y + 1], deep[Z + 1];
    int n = 0;
    for (int i = 0; i <= X; i++)
        at[i] = x[0] + (x[1] - x[0]) * 0.5 * (1 - cos(M_PI * i / X));
    for (int i = 0; i <= Y; i++)
        up[i] = y * sin(0.5 * M_PI * i / Y);
    for (int i = 0; i <= Z; i++)
        deep[i] = z * sin(0.5 * M_PI * i / Z);
    for (int j = 0; j < Y; j++)
        for (int k = 0; k < Z; k++)
            for (int side = 0; side < 2; side++)
                out[n++] = (patch){0, x[side], up[j], up[j + 1], deep[k], deep[k + 1]};
    for (int i = 0; i < X; i++) {
        for (int k = 0; k < Z; k++)
            out[n++] = (patch){1, y, at[i], at[i + 1], deep[k], deep[k + 1]};
        for (int j = 0; j < Y; j++)
            out[n++] = (patch){2, z, at[i], at[i + 1], up[j], up[j + 1]};
    }
    return n;
}

/* C/eps0 of two boxes as plates are drawn */
static double boxes(double l, double h, double g, double reach) {
    enum { MOST = 1000 };
    static patch p[MOST];
    static double matrix[(MOST + 1) * (MOST + 1)], q[MOST + 1], area[MOST];
    static int pivot[MOST + 1];
    const double one[2] = {-40, 0}, other[2] = {g, g + 40};
    const int first = cut(one, 0.5 * l, 0.5 * h, p), n = first + cut(other, 0.5 * l + reach, 0.5 * h, p + first);
    assert_true(n <= MOST);
    for (int i = 0; i < n; i++) {
        double x[3];
        x[p[i].axis] = p[i].at;
        x[p[i].axis == 0] = 0.5 * (p[i].u0 + p[i].u1);
        x[p[i].axis == 2 ? 1 : 2] = 0.5 * (p[i].v0 + p[i].v1);
        area[i] = (p[i].u1 - p[i].u0) * (p[i].v1 - p[i].v0);
        for (int j = 0; j < n; j++) {
            double *to = &matrix[i * (n + 1) + j];
            *to = 0;
            for (int image = 0; image < 4; image++) {
                const double seen[3] = {x[0], image & 1 ? -x[1] : x[1], image & 2 ? -x[2] : x[2]};
                *to += patch_potential(&p[j], seen) / (4 * M_PI);
            }
        }
        matrix[i * (n + 1) + n] = 1;
        q[i] = i < first ? 0.5 : -0.5;
    }
    for (int j = 0; j < n; j++)
        matrix[n * (n + 1) + j] = area[j];
    matrix[n * (n + 1) + n] = 0, q[n] = 0;
    assert_true(fw_maths_lu_factor(n + 1, matrix, pivot));
    fw_maths_lu_solve(n + 1, matrix, pivot, NULL, q);
    double charge = 0;
    for (int i = 0; i < first; i++)
        charge += q[i] * area[i];
    return 4 * charge;
}

static void with_comb(rig *r, const fw_device_comb *c, const char *effects) {
    const fw_effect_choice choice = {.mode = FW_EFFECTS_LIST, .list = effects};
    rig_new(r, 7);
    r->scene.comb = fw_arena_one(r->arena, fw_device_comb);
    r->scene.comb[0] = *c;
    r->scene.ncomb = 1;
    assert_int_equal(
        fw_effects_compile(r->arena, &r->m, &r->scene, &choice, 1e-3, &r->diags, &r->ledger, &r->loads), FW_OK);
    r->e = &r->loads.element[0];
}

/* Edges and ends together leave out what the corners have, which C has by a product: within 3 %, 2 % up to a gap of 20 um. The pull is within 3 %,
   and what may be missing of it covers the rest. Without any of it the pull is off by four times as much. */
static void whole_plates(void **state) {
    (void)state;
    const fw_device_comb flat = {.id = "plate", .kind = FW_ELECTRODES_PLATE, .body_a = FW_GROUND, .body_b = 0,
                                 .gap_m = 5e-6, .length_m = 180e-6, .depth_m = 50e-6, .voltage_V = 30};
    rig r;
    with_comb(&r, &flat, "fringe-field");
    const fw_effects_comb_element has = *fw_effects_comb_of(r.e);
    const struct {
        double l, h, g, share;
    } at[] = {{200, 50, 5, 0.02}, {400, 50, 6, 0.02}, {200, 50, 20, 0.02}, {200, 50, 40, 0.03}};
    for (int i = 0; i < test_fewest((int)(sizeof at / sizeof at[0]), 1); i++) {
        const double l = at[i].l, h = at[i].h, g = at[i].g, d = 0.06 * g;
        fw_effects_comb_element e = {.kind = FW_ELECTRODES_PLATE, .gap_m = g * 1e-6, .length_m = l * 1e-6,
                                     .depth_m = h * 1e-6, .width_m = 40e-6, .edge_F_per_m = 1, .face_Fm = h * 1e-6,
                                     .edge = has.edge, .end = has.end};
        const double here[3] = {0, 0, 0}, reach = g + 10, c = boxes(l, h, g, reach);
        const double pull = (boxes(l, h, g - d, reach) - boxes(l, h, g + d, reach)) / (2 * d) * (1 - 0.0036);
        double slope[3], got = 1e6 * fw_effects_comb_capacitance(&e, here, slope, NULL);
        e.tip.corners_F = fw_effects_plate_corners(&e);
        got = 1e6 * fw_effects_comb_capacitance(&e, here, slope, NULL);
        assert_relative(got, c, at[i].share);
        assert_true(fw_effects_comb_capacitance_off(&e, here) > at[i].share);
        assert_true(slope[0] / pull > 0.97 && slope[0] / pull < 1);
        assert_true(slope[0] * (1 + fw_effects_comb_fringe(&e, NULL)) > pull);
        assert_true(l * h / (g * g) / pull < 1 - 4 * (1 - slope[0] / pull));
    }
    fw_arena_free(r.arena);
}

/* from gaps that are twice as wide as the layer is deep on, and fingers from a third of a gap to six gaps wide */
static void fringe_of_a_comb(void **state) {
    (void)state;
    const double width[] = {0.3, 1, 2, 6}, depth[] = {0.5, 1, 3, 10, 25};
    double worst = 0, least = 1;
    for (int i = 0; i < test_fewest(4, 1); i++)
        for (int k = 0; k < 5; k++) {
            double want = elements(width[i], depth[k], 1, 1);
            worst = fmax(worst, fabs(closed(width[i], depth[k], 1, 1) / want - 1));
            least = fmin(least, 1 - 2 * depth[k] / want);
        }
    assert_true(worst < 2e-3);
    assert_true(least > 0.025); /* there is always some */
}

/* Aside every gap counts by itself, as if its neighbour were as wide. The rotor moves by up to half of the gap: the gap
   becomes 3 times the other one, and what the closed form leaves of the pull aside is below 3 %. */
static void fringe_aside(void **state) {
    (void)state;
    double worst = 0, pull = 0;
    for (int i = 0; i < test_fewest(3, 1); i++)
        for (int k = 1; k <= 5; k++) {
            const double w = 0.6 + 0.9 * i, h = 2 + 4 * i, y = 0.1 * k, d = 0.02;
            double want[3], got[3];
            for (int n = -1; n <= 1; n++) {
                double one = 1 + y + n * d, other = 1 - y - n * d;
                want[n + 1] = elements(w, h, one, other), got[n + 1] = closed(w, h, one, other);
            }
            worst = fmax(worst, fabs(got[1] / want[1] - 1));
            pull = fmax(pull, fabs((got[2] - got[0]) / (want[2] - want[0]) - 1));
        }
    assert_true(worst < 1e-2 && pull < 3e-2);
}

/* of the element: its pull is that of the closed form, its derivatives those of its capacitance */
static void the_element_has_it(void **state) {
    (void)state;
    const double eps0 = 8.8541878128e-12;
    const fw_device_comb comb = {.id = "comb", .kind = FW_ELECTRODES_COMB, .body_a = FW_GROUND, .body_b = 0,
                                 .direction_rad = 0.7, .fingers = 20, .gap_m = 4e-6, .overlap_m = 60e-6,
                                 .length_m = 140e-6, .width_m = 7e-6, .depth_m = (double)NAN, .voltage_V = 30};
    rig with, without;
    with_comb(&with, &comb, "fringe-field");
    with_comb(&without, &comb, "comb-drive");
    const fw_effects_comb_element *c = fw_effects_comb_of(with.e), *plain = fw_effects_comb_of(without.e);
    for (int i = 0; i < 60; i++) {
        const double at[3] = {3e-5 * rig_random(&with), 1.5e-6 * rig_random(&with), 0.02 * rig_random(&with)};
        double slope[3], bend[9], other[9], unused[3], F = 0;
        double more = fw_effects_comb_capacitance(c, at, slope, bend) -
                      fw_effects_comb_capacitance(plain, at, unused, other);
        /* the middle of the overlap is at -x/2; 400 midpoints over it */
        const double l = 60e-6 + at[0];
        for (int k = 0; k < 400; k++) {
            const double s = -0.5 * at[0] + ((k + 0.5) / 400 - 0.5) * l, y = at[1] + at[2] * s;
            F += l / 400 * (fw_effects_comb_edge(4e-6 - y, 7e-6, NULL) + fw_effects_comb_edge(4e-6 + y, 7e-6, NULL));
        }
        /* and ends of fingers, far from the root, with 1.42 times what faces have */
        F += 4 * 1.42 * c->tip.edge_m * c->tip.ends;
        assert_relative(more, eps0 * 20 * F, 1e-2);
        const double h[3] = {2e-8, 2e-8, 2e-5};
        for (int k = 0; k < 3; k++) {
            double v[7], s[3][7], now[3];
            for (int j = -3; j <= 3; j++) {
                double moved[3] = {at[0], at[1], at[2]};
                moved[k] += j * h[k];
                v[j + 3] = fw_effects_comb_capacitance(c, moved, now, NULL);
                for (int n = 0; n < 3; n++)
                    s[n][j + 3] = now[n];
            }
            assert_near(fw_check_slope(v, h[k]), slope[k], 1e-8 * v[3] / h[k]);
            for (int n = 0; n < 3; n++)
                assert_near(fw_check_slope(s[n], h[k]), bend[3 * n + k], 1e-7 * v[3] / h[k] / h[n]);
        }
    }
    fw_arena_free(with.arena), fw_arena_free(without.arena);
}

/* of a plate, likewise, at any tilt that leaves a gap */
static void a_plate_has_it(void **state) {
    (void)state;
    const double eps0 = 8.8541878128e-12;
    const fw_device_comb flat = {.id = "plate", .kind = FW_ELECTRODES_PLATE, .body_a = FW_GROUND, .body_b = 0,
                                 .direction_rad = 0.7, .gap_m = 5e-6, .length_m = 180e-6, .depth_m = (double)NAN,
                                 .voltage_V = 30};
    rig with, without;
    with_comb(&with, &flat, "fringe-field");
    with_comb(&without, &flat, "comb-drive");
    const fw_effects_comb_element *c = fw_effects_comb_of(with.e), *plain = fw_effects_comb_of(without.e);
    assert_true(c->edge && c->end && !plain->edge);
    assert_relative(c->width_m, 40e-6, 1e-12);
    for (int i = 0; i < 60; i++) {
        const double at[3] = {2e-6 * rig_random(&with), 3e-6 * rig_random(&with), 0.012 * rig_random(&with)};
        double slope[3], bend[9], F = 0, ends = 0;
        double more = fw_effects_comb_capacitance(c, at, slope, bend) -
                      fw_effects_comb_capacitance(plain, at, NULL, NULL);
        for (int k = 0; k < 400; k++)
            F += 180e-6 / 400 * fw_effects_plate_edge(5e-6 - at[0] + at[2] * ((k + 0.5) / 400 - 0.5) * 180e-6, 40e-6, 50e-6, NULL);
        for (int side = -1; side <= 1; side += 2)
            ends += 50e-6 * fw_effects_plate_end(5e-6 - at[0] + side * at[2] * 90e-6, 40e-6, 180e-6, NULL);
        const double corners = 1.5 * pow(10, 0.2) * 5e-6 * fw_effects_plate_edge(5e-6, 40e-6, 50e-6, NULL) *
                               fw_effects_plate_end(5e-6, 40e-6, 180e-6, NULL); /* as drawn */
        assert_relative(more, eps0 * (F + ends + corners), 2e-3);
        const double h[3] = {2e-8, 2e-8, 2e-5};
        for (int k = 0; k < 3; k++) {
            double v[7], s[3][7], now[3];
            for (int j = -3; j <= 3; j++) {
                double moved[3] = {at[0], at[1], at[2]};
                moved[k] += j * h[k];
                v[j + 3] = fw_effects_comb_capacitance(c, moved, now, NULL);
                for (int n = 0; n < 3; n++)
                    s[n][j + 3] = now[n];
            }
            assert_near(fw_check_slope(v, h[k]), slope[k], 1e-7 * v[3] / h[k]);
            for (int n = 0; n < 3; n++)
                assert_near(fw_check_slope(s[n], h[k]), bend[3 * n + k], 1e-6 * v[3] / h[k] / h[n]);
        }
    }
    fw_arena_free(with.arena), fw_arena_free(without.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(fringe_of_a_comb), cmocka_unit_test(fringe_aside),
                                       cmocka_unit_test(fringe_of_bars),   cmocka_unit_test(ends_of_plates),
                                       cmocka_unit_test(whole_plates),     cmocka_unit_test(the_element_has_it),
                                       cmocka_unit_test(ends_of_fingers),  cmocka_unit_test(ends_aside),
                                       cmocka_unit_test(a_plate_has_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
