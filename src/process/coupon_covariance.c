/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the results of coupons go together: the same measurement stands behind several of them. */
#include "process/coupon.h"
#include <math.h>
#include <string.h>

typedef struct source { /* one independent error of the data */
    int row;            /* its measured value, or what it was measured under; -1: of the flow */
    bool at;
    const fw_quantity *q;
    double u;
} source;

typedef struct problem {
    fw_arena *arena;
    const fw_process_flow *flow;
    const fw_process_measurement *row;
    int n;
    const fw_process_calibration *found;
} problem;

/* step of the differences in standard uncertainties: small beside what the fits are linear in, large beside the 1e-12 to
   which they are solved */
static const double step = 0.1;

static void shift_row(const problem *p, const source *s, double by, fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(p->row[s->row].coupon);
    memcpy(row, p->row, (size_t)p->n * sizeof *row);
    if (!s->at) {
        row[s->row].value += by;
        return;
    }
    for (int i = 0; i < p->n; i++)
        if (i == s->row || (kind->one_run && fw_process_coupon_kind(p->row[i].coupon) == kind))
            row[i].at += by;
}

/* the results with one error moved; false: they cannot be found there */
static bool results(const problem *p, const source *s, double by, fw_process_coupon_work *w,
                    fw_process_measurement *row, double *value, fw_status *status) {
    fw_mark mark = fw_arena_mark(p->arena);
    fw_diags quiet = fw_diags_new(p->arena);
    fw_process_calibrated *out = w->out;
    *w = (fw_process_coupon_work){
        .arena = p->arena, .flow = p->flow, .known = out, .out = out, .diags = &quiet};
    if (s->row < 0) {
        memcpy(row, p->row, (size_t)p->n * sizeof *row);
        w->shifted = s->q, w->shift = by;
    } else
        shift_row(p, s, by, row);
    *status = fw_process_coupon_fit_all(w, row, p->n);
    bool good = *status == FW_OK && w->nout == p->found->count;
    for (int i = 0; good && i < w->nout; i++) {
        good = strcmp(out[i].id, p->found->item[i].id) == 0;
        value[i] = out[i].value;
    }
    if (*status == FW_INPUT) *status = FW_OK;
    fw_arena_rewind(p->arena, mark);
    return good;
}

static int sources_of(const problem *p, const fw_process_coupon_work *w, const double *u,
                      bool shared, source *list) {
    int n = 0;
    for (int i = 0; i < p->n; i++) {
        const fw_process_measurement *r = &p->row[i];
        const fw_process_coupon *kind = fw_process_coupon_kind(r->coupon);
        bool first = true;
        if (u[i] > 0.0) list[n++] = (source){.row = i, .u = u[i]};
        for (int k = 0; k < i; k++)
            first = first && fw_process_coupon_kind(p->row[k].coupon) != kind;
        if (shared && r->at_uncertainty > 0.0 && (first || !kind->one_run))
            list[n++] = (source){.row = i, .at = true, .u = r->at_uncertainty};
    }
    for (int i = 0; shared && i < w->nused; i++)
        list[n++] = (source){.row = -1, .q = w->used[i], .u = w->used[i]->uncertainty};
    return n;
}

/* C += g g', g the change of the results for one standard uncertainty of a source; a quantity of the flow that the coupons
   used is itself one of the (m) results, behind the items (count) */
static fw_status add_source(const problem *p, const source *s, int own, int m,
                            fw_process_coupon_work *w, fw_process_measurement *row, double *C) {
    double value[2][FW_COUPON_RESULTS] = {{0}}, g[FW_COUPON_RESULTS + FW_COUPON_USED] = {0};
    double from = 0.0, to = 0.0;
    for (int side = 0; side < 2; side++) {
        fw_status status;
        bool good = results(p, s, (side ? step : -step) * s->u, w, row, value[side], &status);
        FW_TRY(status);
        for (int i = 0; !good && i < p->found->count; i++)
            value[side][i] = p->found->item[i].value;
        if (good) *(side ? &to : &from) = side ? step : -step;
    }
    for (int i = 0; to > from && i < p->found->count; i++)
        g[i] = (value[1][i] - value[0][i]) / (to - from);
    if (own >= 0) g[own] = s->u;
    for (int i = 0; i < m; i++)
        for (int k = 0; k < m; k++)
            C[i * m + k] += g[i] * g[k];
    return FW_OK;
}

fw_status fw_process_coupon_covariance(fw_arena *arena, const fw_process_flow *flow,
                                       const fw_process_measurement *measurement, int n,
                                       const fw_process_calibration *found, const double *u,
                                       bool shared, fw_process_covariance *out) {
    problem p = {arena, flow, measurement, n, found};
    fw_process_coupon_work *w = fw_arena_one(arena, fw_process_coupon_work);
    FW_NEED(w);
    FW_NEED(w->out = fw_arena_array(arena, fw_process_calibrated, FW_COUPON_RESULTS));
    fw_process_measurement *row = fw_arena_array(arena, fw_process_measurement, (size_t)n);
    source *list = fw_arena_array(arena, source, (size_t)(2 * n + FW_COUPON_USED));
    double value[FW_COUPON_RESULTS];
    fw_status status;
    FW_NEED(row ? list : NULL);
    const source none = {.row = -1};
    if (!results(&p, &none, 0.0, w, row, value, &status))
        return status == FW_OK ? FW_INTERNAL : status;
    int nsource = sources_of(&p, w, u, shared, list), count = found->count, m = count + w->nused;
    *out = (fw_process_covariance){.m = m};
    FW_NEED(out->id = fw_arena_array(arena, const char *, (size_t)m));
    FW_NEED(out->C = fw_arena_array(arena, double, (size_t)(m * m)));
    for (int i = 0; i < m; i++)
        out->id[i] = i < count ? found->item[i].id : w->used[i - count]->id;
    for (int s = 0, own = count; s < nsource; s++)
        FW_TRY(add_source(&p, &list[s], list[s].q ? own++ : -1, m, w, row, out->C));
    return FW_OK;
}

fw_status fw_process_coupon_joint(fw_arena *arena, const fw_process_covariance *of,
                                  const double *deviation, fw_process_calibration *out) {
    static const double least = 1e-3; /* below, it changes no digit that is printed */
    int *kept = fw_arena_array(arena, int, (size_t)of->m), n = 0, m = of->m;
    FW_NEED(kept);
    for (int i = 0; i < m; i++) {
        bool joint = false;
        for (int k = 0; k < m; k++)
            joint =
                joint || (k != i && fabs(of->C[i * m + k]) >= least * deviation[i] * deviation[k]);
        if (joint && deviation[i] > 0.0) kept[n++] = i;
    }
    out->joint = NULL, out->correlation = NULL, out->njoint = 0;
    if (n == 0) return FW_OK;
    const char **names = fw_arena_array(arena, const char *, (size_t)n);
    double *r = fw_arena_array(arena, double, (size_t)(n * n));
    FW_NEED(names ? r : NULL);
    for (int i = 0; i < n; i++) {
        names[i] = of->id[kept[i]];
        for (int k = 0; k < n; k++)
            r[i * n + k] =
                i == k ? 1.0
                       : of->C[kept[i] * m + kept[k]] / (deviation[kept[i]] * deviation[kept[k]]);
    }
    double *L = fw_arena_array(arena, double, (size_t)(n * n));
    FW_NEED(L);
    /* wafers that do not all have the same coupons may give what no errors can have: towards independence until they can */
    for (int round = 0; round < 400 && !fw_process_correlation_possible(r, n, L); round++)
        for (int i = 0; i < n * n; i++)
            r[i] *= i % (n + 1) ? 0.95 : 1.0;
    if (!fw_process_correlation_possible(r, n, L)) return FW_INTERNAL; /* something is no number */
    out->joint = names;
    out->correlation = r;
    out->njoint = n;
    return FW_OK;
}

/* Covariance of the results: C = sum_s g_s g_s', g_s = d(results)/d(s) u_s over all independent errors s of the data, by
   central differences over +-0.1 u_s of the whole calibration, so that joined coupons and results that use others are in
   it, and new kinds of coupons without a line of their own. Of a run that several rows share, what they were measured
   under is one error. r_ij = C_ij/(s_i s_j), s_i^2 the larger of C_ii and the variance that the fit states (a ladder read
   by what stands has a part that no row carries).
   Rows and results SI; r 1. First order: exact for fits that are linear in the data, and good to the square of the
   relative uncertainties else. Cost: two calibrations for every row.
   Source: JCGM 102:2011, 6.2 (law of propagation, several outputs). Test: test_correlation.c. */
fw_status fw_process_calibration_correlate(fw_arena *arena, const fw_process_flow *flow,
                                           const fw_process_measurement *measurement, int n,
                                           fw_process_calibration *calibration) {
    double *u = fw_arena_array(arena, double, (size_t)n);
    fw_process_covariance all;
    FW_NEED(u);
    for (int i = 0; i < n; i++)
        u[i] = measurement[i].uncertainty;
    FW_TRY(fw_process_coupon_covariance(arena, flow, measurement, n, calibration, u, true, &all));
    double *deviation = fw_arena_array(arena, double, (size_t)all.m);
    FW_NEED(deviation);
    for (int i = 0; i < all.m; i++)
        deviation[i] = fmax(sqrt(all.C[i * all.m + i]),
                            i < calibration->count ? calibration->item[i].uncertainty : 0.0);
    return fw_process_coupon_joint(arena, &all, deviation, calibration);
}
