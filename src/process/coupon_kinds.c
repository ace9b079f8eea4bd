/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of coupons. Of etching: rates and selectivities, the ladder of undercut lines, slots of several widths. Of
   printing and resist: lines and spaces, thickness over spin speed. */
#include "base/constants.h"
#include "process/coupon.h"
#include <math.h>
#include <string.h>

/* ---- rates and selectivities ---- */

/* the rows of one feature, as y = R x */
static int collect(const fw_process_coupon_work *w, const char *feature, double *y, double *sy,
                   double *x, double *sx) {
    int n = 0;
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (strcmp(r->feature, feature) != 0) continue;
        y[n] = r->value, sy[n] = r->uncertainty;
        x[n] = r->at, sx[n++] = r->at_uncertainty;
    }
    return n;
}

/* The times of these rows as they would have been under the reference conditions, x f. What f may be off by is in proportion
   in all rows of one condition, and no scatter; *shared is the least of any row, and what a row has beyond that, which
   tells it from others, counts as its own: (f x)^2 (u_i^2 - u_least^2). Test: test_calibrate.c, of_warm_baths. */
static fw_status correct(fw_process_coupon_work *w, const char *feature, double *x, double *sx,
                         double *shared) {
    fw_process_coupon_speed of[FW_COUPON_ROWS];
    int n = 0;
    *shared = (double)INFINITY;
    for (int i = 0; i < w->n; i++) {
        if (strcmp(w->measurement[i]->feature, feature) != 0) continue;
        FW_TRY(fw_process_coupon_sped(w, feature, w->measurement[i], &of[n]));
        *shared = fmin(*shared, of[n++].uncertainty);
    }
    for (int i = 0; i < n; i++) {
        const double own = sqrt(fmax(of[i].uncertainty * of[i].uncertainty - *shared * *shared, 0));
        x[i] *= of[i].factor;
        sx[i] = hypot(sx[i] * of[i].factor, x[i] * own);
    }
    return FW_OK;
}

static bool first_of(const fw_process_coupon_work *w, int i) {
    for (int k = 0; k < i; k++)
        if (strcmp(w->measurement[k]->feature, w->measurement[i]->feature) == 0) return false;
    return true;
}

/* the time of one run as it would have been under the reference conditions of the rate; any of its rows says which it had */
static fw_status correct_run(fw_process_coupon_work *w, const char *rate, double *t, double *u_t) {
    fw_process_measurement says = *w->measurement[0];
    fw_process_coupon_speed of;
    for (int k = 0; k < FW_CONDITIONS; k++)
        for (int i = 0; i < w->n; i++) {
            const fw_process_measurement *r = w->measurement[i];
            const double is = r->condition[k], before = says.condition[k];
            if (!(is > 0.0)) continue;
            if (before > 0.0 && fabs(is - before) > 1e-8 * before)
                return fw_process_coupon_wrong(
                    w, r,
                    "%s: all rows are of one run, so its %s is the same "
                    "in all",
                    r->coupon, k == FW_CONDITION_TEMPERATURE ? "temperature" : "open area");
            says.condition[k] = is, says.condition_uncertainty[k] = r->condition_uncertainty[k];
        }
    FW_TRY(fw_process_coupon_sped(w, rate, &says, &of));
    *u_t = of.factor * hypot(*u_t, *t * of.uncertainty);
    *t *= of.factor;
    return FW_OK;
}

/* Depth or thickness d after a time t, R = d/t through the origin, both with errors. The feature is
   the id of the rate in the pack: pan.R, rie.R, al.R, seed.R, release.R. d m, t s, R m/s. Test:
   test_calibrate.c. */
static fw_status rates(fw_process_coupon_work *w) {
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        const fw_quantity *q = fw_process_flow_quantity(w->flow, r->feature);
        if (!q || !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_SPEED))
            return fw_process_coupon_wrong(
                w, r,
                "the feature of etch-rate is the id of a rate of flow '%s', "
                "for example pan.R; '%s' is none",
                w->flow->id, r->feature);
        if (!fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_TIME) ||
            !(r->at > 0.0))
            return fw_process_coupon_wrong(
                w, r, "a rate needs its time in the columns at, u_at and at_unit");
        if (!first_of(w, i)) continue;
        double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS];
        const int n = collect(w, r->feature, y, sy, x, sx);
        double shared;
        FW_TRY(correct(w, r->feature, x, sx, &shared));
        fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, n);
        FW_TRY(fw_process_coupon_give(w, r->feature, f.value[0],
                                      hypot(f.uncertainty[0], f.value[0] * shared), &f,
                                      "depth over time, through the origin"));
    }
    return FW_OK;
}

static fw_status no_etch(fw_process_coupon_work *w, const char *coupon, const char *what) {
    return fw_process_coupon_wrong(w, w->measurement[0],
                                   "flow '%s' has no etch of its device layer with %s, which %s "
                                   "reads; take the rows out",
                                   w->flow->id, what, coupon);
}

/* Selectivity S_m = D/a: what is etched over what the mask loses, a measured at D. Through the
   origin as a = D/S_m. D, a m. Test: test_calibrate.c. */
static fw_status selectivity(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], sy[FW_COUPON_ROWS], x[FW_COUPON_ROWS], sx[FW_COUPON_ROWS];
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (!fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_LENGTH) ||
            !(r->at > 0.0))
            return fw_process_coupon_wrong(
                w, r,
                "al-step needs the etched depth in the columns at, u_at and "
                "at_unit");
        y[i] = r->value, sy[i] = r->uncertainty, x[i] = r->at, sx[i] = r->at_uncertainty;
    }
    fw_process_fit f = fw_process_fit_ratio(y, sy, x, sx, w->n);
    double loss = f.value[0], u = f.uncertainty[0];
    if (!(loss > 3.0 * u))
        return fw_process_coupon_wrong(
            w, w->measurement[0],
            "the loss of the mask is not above its uncertainty, so that no selectivity follows; "
            "etch longer, or measure it more exactly");
    fw_process_etch etch = fw_process_flow_etch(w->flow);
    if (!etch.selectivity) return no_etch(w, "al-step", "a selectivity to its mask");
    return fw_process_coupon_give(w, etch.selectivity->id, 1.0 / loss, u / (loss * loss), &f,
                                  "etched depth over the loss of the mask");
}

const fw_process_coupon fw_process_coupon_etch_rate = {
    "etch-rate", FW_DIM_LENGTH,          false,         false,       true, false,
    rates,       .under = {FW_DIM_TIME}, .plain = true, .rate = true};
const fw_process_coupon fw_process_coupon_step = {
    "al-step",
    FW_DIM_LENGTH,
    false,
    false,
    true,
    false,
    selectivity,
    .features_said =
        "value what the mask lost (its step before the etch less that after it), at the "
        "etched depth",
    .under = {FW_DIM_LENGTH},
    .of_mask = true,
    .stages = fw_process_stages_of_mask};

/* ---- lines undercut in a ladder of widths ---- */

/* twice the lateral loss of both edges: of a line that stands, w - m; between the widest line that
   is gone and the narrowest that stands, uniform: (stands - gone)/sqrt(12) */
static fw_status ladder_losses(fw_process_coupon_work *w, double *y, double *s, int *n) {
    double gone = -1.0, stands = (double)INFINITY;
    const fw_process_measurement *of = NULL;
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (strcmp(r->feature, "width") == 0) {
            y[*n] = r->drawn_m - r->value;
            s[(*n)++] = r->uncertainty;
        } else { /* gone or stands */
            of = r;
            if (r->feature[0] == 'g')
                gone = fmax(gone, r->drawn_m);
            else
                stands = fmin(stands, r->drawn_m);
        }
    }
    if (!of) return FW_OK;
    bool both = gone >= 0.0 && isfinite(stands);
    if (!both && *n > 0) {
        fw_diag_warning(
            w->diags, 211, of->place,
            "lines that are all gone, or all stand, bound the undercut on one side only: "
            "these rows of undercut-ladder are left out, its widths are used");
        return FW_OK;
    }
    if (!both)
        return fw_process_coupon_wrong(
            w, of,
            "undercut-ladder without widths needs the widest line that is gone and the "
            "narrowest that stands, both");
    if (!(gone < stands))
        return fw_process_coupon_wrong(
            w, of,
            "a line stands that is narrower than one that is gone; check the rows gone and stands");
    y[*n] = 0.5 * (gone + stands);
    s[(*n)++] = (stands - gone) / sqrt(12.0);
    return FW_OK;
}

/* Lines of width w on the mask, not compensated; the mask layer lost L at every edge (what the flow
   plans, less where edges are printed and come out, or that cd-lines read), the plasma u at the top: w - m = 2 L + 2 u, u = (1 - A) E, A = 1 - u/E.
   E: the depth that wide openings have reached, or rate times the time, over-etch included. All m;
   A 1. u(A)^2 = (u_u/E)^2 + (u u_E/E^2)^2. Source: docs/theory/calibrate.md. Test:
   test_calibrate.c. */
static fw_status fit_ladder(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], E, u_E, edge, u_edge;
    int n = 0;
    fw_process_etch etch = fw_process_flow_etch(w->flow);
    if (!etch.anisotropy) return no_etch(w, "undercut-ladder", "an anisotropy");
    bool timed = fw_quantity_dimension_equal(w->measurement[0]->at_dimension,
                                             (fw_quantity_dimension)FW_DIM_TIME);
    FW_TRY(fw_process_coupon_condition(w, w->measurement[0]->at_dimension, "what was etched", &E,
                                       &u_E));
    if (timed) {
        double R, u_R;
        if (!etch.rate || !fw_process_coupon_value(w, etch.rate->id, &R, &u_R))
            return fw_process_coupon_wrong(w, w->measurement[0],
                                           "the rate of the etch is not known; give the depth in "
                                           "wide openings in the column at");
        FW_TRY(correct_run(w, etch.rate->id, &E, &u_E));
        u_E = hypot(R * u_E, E * u_R);
        E *= R;
    } else if (!fw_quantity_dimension_equal(w->measurement[0]->at_dimension,
                                            (fw_quantity_dimension)FW_DIM_LENGTH))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "the column at of undercut-ladder takes a depth or a time");
    FW_TRY(ladder_losses(w, y, s, &n));
    fw_process_coupon_mask_edge(w, &edge, &u_edge);
    fw_process_fit f = fw_process_fit_mean(y, s, n);
    double u = 0.5 * f.value[0] + edge;
    double A = 1.0 - u / E, u_A = hypot(hypot(0.5 * f.uncertainty[0], u_edge), u / E * u_E) / E;
    if (!(A > 0.0) || !(A < 1.0 + 2.0 * u_A))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "the anisotropy that follows is not between 0 and 1: check "
                                       "the widths, the edge of the mask layer and the depth");
    const char *note = fw_arena_printf(
        w->arena, "undercut at the top over the depth of wide openings, %d lines", n);
    FW_NEED(note);
    return fw_process_coupon_give(w, etch.anisotropy->id, fmin(A, 1.0), u_A, &f, note);
}

const fw_process_coupon fw_process_coupon_ladder = {
    "undercut-ladder",
    FW_DIM_LENGTH,
    false,
    true,
    true,
    true,
    fit_ladder,
    .features = {"width", "gone", "stands"},
    .sides = {"gone", "stands"},
    .features_said = "width, or gone and stands in one line each",
    .under = {FW_DIM_TIME, FW_DIM_LENGTH},
    .stages = fw_process_stages_of_etch};

/* ---- plates with holes: how far a release has gone sideways ---- */

/* Plates with holes of width h in a square grid of pitch p, released for a time t: free from a reach r on, from the
   nearest hole to the middle of four, (p - h)/sqrt 2 where holes are square and p/sqrt 2 - h/2 where they are round;
   printed ones lie between. The widest that is free and the narrowest that is held have r_1 <= R t <= r_2 between
   them, uniform: R = (r_1 + r_2)/(2 t), u_r = (r_2 - r_1)/sqrt 12. p, h m, t s, R m/s. Range: one front, in a film
   that is thin against r. u_h counts with 1/sqrt 2. Source: docs/theory/calibrate.md. Test: test_calibrate.c. */
static fw_status fit_release(fw_process_coupon_work *w) {
    double t, u_t, least = -1.0, most = (double)INFINITY, u_hole = 0.0;
    FW_TRY(
        fw_process_coupon_condition(w, (fw_quantity_dimension)FW_DIM_TIME, "the time", &t, &u_t));
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (!(r->value > 0.0) || !(r->value < r->drawn_m))
            return fw_process_coupon_wrong(w, r,
                                           "drawn is the pitch of the holes and measured their "
                                           "width, which is above zero and less than that");
        const double square = (r->drawn_m - r->value) / sqrt(2.0),
                     round = r->drawn_m / sqrt(2.0) - 0.5 * r->value;
        if (strcmp(r->feature, "free") == 0)
            least = fmax(least, square);
        else
            most = fmin(most, round);
        u_hole = fmax(u_hole, r->uncertainty / sqrt(2.0));
    }
    if (least < 0.0 || !isfinite(most))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "release-holes needs the widest pitch of which a plate is "
                                       "free, and the narrowest that is held, both");
    if (!(least < most))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "a plate is held that has a smaller pitch than one that is "
                                       "free; check the rows free and held");
    FW_TRY(correct_run(w, "release.R", &t, &u_t));
    const double reach = 0.5 * (least + most), u = hypot((most - least) / sqrt(12.0), u_hole);
    const fw_process_fit f = {.value = {reach / t}};
    return fw_process_coupon_give(w, "release.R", reach / t, reach / t * hypot(u / reach, u_t / t),
                                  &f,
                                  "between the widest plate that is free and the narrowest held");
}

const fw_process_coupon fw_process_coupon_release = {
    "release-holes",
    FW_DIM_LENGTH,
    false,
    true,
    true,
    true,
    fit_release,
    .features = {"free", "held"},
    .sides = {"free", "held"},
    .features_said = "free and held in one line each, drawn their pitch, value the width of a hole",
    .sides_measured = true,
    .under = {FW_DIM_TIME},
    .stages = fw_process_stages_of_release};

/* ---- slots: the lag of narrow openings ---- */

/* depth of a slot after R0 t, lag S: root of D + S J(w, D) = R0 t by Newton; J' = 1/K - 1 */
static double depth_of(double width, double travelled, double S) {
    double D = travelled;
    for (int i = 0; i < 60; i++) {
        double slope = 1.0 + S * (1.0 / fw_process_knudsen_slot(D / width) - 1.0);
        double step = (D + S * fw_process_arde_integral(width, D, false) - travelled) / slope;
        D = fmax(D - step, 0.1 * D);
        if (fabs(step) < 1e-15 * travelled) break;
    }
    return D;
}

/* the opening in the layer that masks the etch; edges that stand out by `edge` narrow it */
static double opening_of(const fw_process_measurement *r, double edge) {
    return r->drawn_m - 2.0 * edge;
}

/* D_i = R0 t - S J(w_i, D_i), two parameters R0 t and S; the rows were looked at. NaN: all are equally wide */
static fw_process_fit lag_of(const fw_process_coupon_work *w, double edge) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], p[FW_COUPON_ROWS], q[FW_COUPON_ROWS];
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        y[i] = r->value, s[i] = r->uncertainty, p[i] = 1.0;
        q[i] = -fw_process_arde_integral(opening_of(r, edge), r->value, false);
    }
    fw_process_fit f = fw_process_fit_plane(y, s, p, q, w->n);
    for (int round = 0; round < 8 && f.value[1] > -0.5; round++) {
        const double travelled = f.value[0], S = f.value[1];
        for (int i = 0; i < w->n; i++) {
            double width = opening_of(w->measurement[i], edge), D = depth_of(width, travelled, S);
            double slope = 1.0 + S * (1.0 / fw_process_knudsen_slot(D / width) - 1.0);
            p[i] = 1.0 / slope;
            q[i] = -fw_process_arde_integral(width, D, false) / slope;
            y[i] = w->measurement[i]->value - D + p[i] * travelled + q[i] * S;
        }
        f = fw_process_fit_plane(y, s, p, q, w->n);
    }
    return f;
}

static fw_status check_slots(fw_process_coupon_work *w, double edge) {
    if (w->n < 2)
        return fw_process_coupon_wrong(w, w->measurement[0], "arde-slots needs two widths or more");
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        if (!(r->value > 0.0) || r->value / r->drawn_m > 1000.0)
            return fw_process_coupon_wrong(
                w, r, "the depth of a slot must be above zero and below 1000 times its width");
        if (!(opening_of(r, edge) > 0.0))
            return fw_process_coupon_wrong(w, r,
                                           "this slot is closed in the layer that masks the etch, "
                                           "whose edges stand out by %.3g um: check drawn_um, and "
                                           "the rows of cd-lines",
                                           1e6 * edge);
    }
    return FW_OK;
}

/* Slots drawn w_i wide, which the layer that masks the etch opens by w_i - 2 e, e where its edges stand; the same time t:
   D_i = R0 t - S J(w_i - 2 e, D_i) (docs/theory/calibrate.md). With two slots that is S = (D2 - D1)/(J1 - J2),
   R0 = (D1 + S J1)/t; with more, the start of Gauss and Newton on D_i(R0 t, S), weighted with 1/u^2: dD/d(R0 t) = 1/(1
   + S J'), dD/dS = -J/(1 + S J').
   Time and e are common to all: their uncertainties come on top, that of e by a fit with e + u_e. w, e, D m, t s; S 1. Lag
   above twice its uncertainty below zero is refused. Test: test_calibrate.c, two_slots, coverage. */
static fw_status fit_slots(fw_process_coupon_work *w) {
    double t, u_t, edge, u_edge;
    fw_process_etch etch = fw_process_flow_etch(w->flow);
    if (!etch.rate || !etch.lag) return no_etch(w, "arde-slots", "a rate and a lag");
    FW_TRY(fw_process_coupon_condition(w, (fw_quantity_dimension)FW_DIM_TIME, "the etch time", &t,
                                       &u_t));
    fw_process_coupon_mask_edge(w, &edge, &u_edge);
    FW_TRY(check_slots(w, edge));
    fw_process_fit f = lag_of(w, edge);
    const double travelled = f.value[0], S = f.value[1];
    if (!isfinite(S))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "all slots of arde-slots are equally wide; the lag follows "
                                       "from slots of different widths");
    if (!(S > -2.0 * f.uncertainty[1]))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "narrow slots came out deeper than wide ones: that is no "
                                       "lag of this law; check the order of the rows");
    fw_process_fit wider = lag_of(w, edge - u_edge); /* the side on which none closes */
    const double u_travelled = hypot(f.uncertainty[0], wider.value[0] - travelled),
                 u_S = hypot(f.uncertainty[1], wider.value[1] - S);
    FW_TRY(correct_run(w, etch.rate->id, &t, &u_t));
    double R = travelled / t, u = hypot(u_travelled / t, R * u_t / t);
    const char *note =
        edge == 0.0 ? fw_arena_printf(w->arena, "from %d slots", w->n)
                    : fw_arena_printf(w->arena,
                                      "from %d slots, %.4g um %s in the layer that masks the etch "
                                      "than drawn",
                                      w->n, 2e6 * fabs(edge), edge < 0.0 ? "wider" : "narrower");
    FW_NEED(note);
    FW_TRY(fw_process_coupon_give(w, etch.rate->id, R, u, &f, note));
    return fw_process_coupon_give(w, etch.lag->id, fmax(S, 0.0), u_S, &f, note);
}

const fw_process_coupon fw_process_coupon_slots = {"arde-slots",
                                                   FW_DIM_LENGTH,
                                                   false,
                                                   true,
                                                   true,
                                                   true,
                                                   fit_slots,
                                                   .under = {FW_DIM_TIME},
                                                   .stages = fw_process_stages_of_etch};

/* ---- printed lines and spaces ---- */

/* Lines and spaces of known width on the mask, not compensated, measured on the wafer: every edge
   stands out by e = (m - w)/2, of a space by (w - m)/2. m, w, e m. In a mask layer that the flow
   etches sideways by L = sum d (1 + overrun), made.al-edge = e + L is what is left of it; in the resist e is
   litho.edge. Weighted mean; residuals are tested. Source: geometry. Test: test_calibrate.c; test_asrun.c,
   lines_in_the_resist. */
static fw_status fit_lines(fw_process_coupon_work *w) {
    const char *of = w->measurement[0]->of, *edge = of ? of : fw_process_coupon_edge(w->flow);
    const bool etched = strcmp(edge, FW_PROCESS_PRINTED_EDGE) != 0;
    const double loss = etched ? fw_process_coupon_loss(w->flow, w) : 0.0;
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS];
    for (int i = 0; i < w->n; i++) {
        const fw_process_measurement *r = w->measurement[i];
        bool space = strcmp(r->feature, "space") == 0;
        y[i] = (space ? -0.5 : 0.5) * (r->value - r->drawn_m);
        s[i] = 0.5 * r->uncertainty;
    }
    fw_process_fit f = fw_process_fit_mean(y, s, w->n);
    return fw_process_coupon_give(
        w, edge, f.value[0] + loss, f.uncertainty[0], &f,
        etched ? "edge in the aluminium against the mask, and what the wet etch is "
                 "planned to take; the printed edge is in it"
               : "edge on the wafer against the mask");
}

const fw_process_coupon fw_process_coupon_cd_lines = {
    "cd-lines",
    FW_DIM_LENGTH,
    false,
    true,
    false,
    false,
    fit_lines,
    .features = {"line", "space"},
    .stages = fw_process_stages_of_edges,
    .mistaken = "the mask does not widen the lines of the coupon, so that an etch below the resist "
                "takes its planned loss "
                "from them, too"};

/* ---- resist over spin speed ---- */

/* Resist of thickness d at speed w: ln d = ln d0 - a ln(w/w0), w0 the reference speed of the pack.
   Two parameters in closed form; the error of the speed counts with a, which is iterated. d, d0 m;
   w rad/s; a 1. Source: docs/theory/calibrate.md. Test: test_calibrate.c. */
static fw_status fit_spin(fw_process_coupon_work *w) {
    double y[FW_COUPON_ROWS], s[FW_COUPON_ROWS], one[FW_COUPON_ROWS], x[FW_COUPON_ROWS], w0;
    if (!fw_process_coupon_value(w, "resist.w0", &w0, NULL))
        return fw_process_coupon_wrong(
            w, w->measurement[0],
            "resist.w0 is not known in this flow; enter it in a laboratory pack");
    fw_process_fit f = {.value = {0.0, 0.5}};
    for (int round = 0; round < 6; round++) {
        for (int i = 0; i < w->n; i++) {
            const fw_process_measurement *r = w->measurement[i];
            if (!fw_quantity_dimension_equal(r->at_dimension,
                                             (fw_quantity_dimension)FW_DIM_ROTATION) ||
                !(r->at > 0.0) || !(r->value > 0.0))
                return fw_process_coupon_wrong(
                    w, r,
                    "spin needs a thickness above zero, and the speed in the "
                    "columns at, u_at and at_unit");
            y[i] = log(r->value), one[i] = 1.0, x[i] = -log(r->at / w0);
            s[i] = hypot(r->uncertainty / r->value, f.value[1] * r->at_uncertainty / r->at);
        }
        f = fw_process_fit_plane(y, s, one, x, w->n);
        if (w->n < 2 || !isfinite(f.value[1]))
            return fw_process_coupon_wrong(w, w->measurement[0], "spin needs two speeds or more");
    }
    if (!(f.value[1] > 0.0))
        return fw_process_coupon_wrong(w, w->measurement[0],
                                       "the resist is thicker at higher speed: check the rows");
    double d0 = exp(f.value[0]);
    const char *note = fw_arena_printf(w->arena, "from %d coats", w->n);
    FW_NEED(note);
    FW_TRY(fw_process_coupon_give(w, "resist.d0", d0, d0 * f.uncertainty[0], &f, note));
    return fw_process_coupon_give(w, "resist.a", f.value[1], f.uncertainty[1], &f, note);
}

const fw_process_coupon fw_process_coupon_spin = {
    "spin",       FW_DIM_LENGTH, false, false, true, false, fit_spin, .under = {FW_DIM_ROTATION},
    .plain = true};
