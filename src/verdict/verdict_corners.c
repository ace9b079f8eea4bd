/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A verdict for everything that a flow may make. Which corner of the ranges is worst differs by
   hinge and scene: a given rotation strains a wide flexure more, a given load a thin one. Theory:
   docs/theory/as-fabricated.md. */
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* a first-order estimate that was off by more than this proves nothing: every corner is run */
static const double fw_trusted = 0.3;
/* below this an input does not decide which corner is the worst one */
static const double fw_of_no_account = 2e-3;

/* ---- first order ---- */

static void nominal_point(const fw_verdict_variant_verdict *v, double *x) {
    for (int i = 0; i < v->ninput; i++)
        x[i] = v->input[i].nominal;
}

static int first_edge(const fw_verdict_variant_verdict *v) {
    int i = 0;
    while (!fw_verdict_search_edges_only(&v->input[i]))
        i++;
    return i;
}

/* the point by which the slopes of input i are found; false: they are those of another, scaled, or there is none */
static bool slope_point(const fw_verdict_variant_verdict *v, int i, double *x) {
    const fw_verdict_fabrication_input *in = &v->input[i];
    if (!fw_verdict_search_has_range(in)) return false;
    if (fw_verdict_search_edges_only(in) && first_edge(v) < i) return false;
    nominal_point(v, x);
    x[i] = in->nominal > in->low ? in->low : in->high;
    return true;
}

/* those of all slopes, with_nominal: and the nominal device, need nothing of each other */
static fw_status slopes_ahead(fw_verdict_search *s, bool with_nominal) {
    const size_t width = (size_t)s->v->ninput;
    double *x = fw_arena_array(s->arena, double, (width + 1) * width);
    FW_NEED(x);
    size_t n = with_nominal;
    nominal_point(s->v, x);
    for (int i = 0; i < s->v->ninput; i++)
        n += slope_point(s->v, i, x + n * width);
    return fw_verdict_search_ahead(s, x, NULL, n);
}

/* d ln U/dx by one run per input, at the low end of its range: thin flexures, where things change
   fastest. A check that is not there at that end (a flexure gone) has no slope: NaN */
static fw_status slopes(fw_verdict_search *s) {
    const fw_verdict_variant_verdict *v = s->v;
    double x[FW_FABRICATION_INPUTS];
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        int like = fw_verdict_search_edges_only(in) ? first_edge(v) : i, n = v->ninput;
        s->slope_like[i] = like;
        s->slope_point[i] = FW_NONE;
        if (!fw_verdict_search_has_range(in)) continue; /* slopes are 0: it stays where it is */
        for (int r = 0; like < i && r < s->ncheck; r++)
            s->slope[r * n + i] = s->slope[r * n + like] * in->edge_m / v->input[like].edge_m;
        if (!slope_point(v, i, x)) continue;
        s->slope_point[i] = s->fabricated->ncorner;
        const double *at = s->ln + (size_t)s->fabricated->ncorner * (size_t)s->ncheck;
        FW_TRY(fw_verdict_search_run(s, x, FW_NO_CORNER));
        for (int r = 0; r < s->ncheck; r++)
            s->slope[r * n + i] = (at[r] - s->ln[r]) / (x[i] - in->nominal);
    }
    s->first = s->fabricated->ncorner;
    fw_verdict_ends_slopes(s);
    return FW_OK;
}

static double estimate(const fw_verdict_search *s, int check, unsigned bits) {
    const fw_verdict_variant_verdict *v = s->v;
    double x[FW_FABRICATION_INPUTS], ln = s->ln[check];
    fw_verdict_search_corner_point(s, bits, x);
    for (int i = 0; i < v->ninput; i++)
        ln += s->slope[check * v->ninput + i] * (x[i] - v->input[i].nominal);
    return ln;
}

/* the corner where the estimate is largest (up) or least; inputs of no account are as in `like` */
static unsigned end_corner(const fw_verdict_search *s, int check, bool up, unsigned like) {
    unsigned bits = 0;
    for (int i = 0; i < s->v->ninput; i++) {
        double slope = s->slope[check * s->v->ninput + i];
        double size = fabs(slope) * (s->v->input[i].high - s->v->input[i].low);
        bool high = size < fw_of_no_account ? like >> i & 1u : (slope > 0.0) == up;
        bits |= high ? 1u << i : 0u;
    }
    return bits;
}

/* that corner of a check, as one that was run where the difference is of no account */
static unsigned choose(const fw_verdict_search *s, int check, bool up) {
    for (int p = 0; p < s->fabricated->ncorner; p++)
        if (s->bits[p] != FW_NO_CORNER) {
            unsigned bits = end_corner(s, check, up, s->bits[p]);
            if (bits == s->bits[p]) return bits;
        }
    return end_corner(s, check, up, 0);
}

/* how far off the estimates of checks from..to that may matter were at a corner that was run: those that used `least` */
static double estimate_error(const fw_verdict_search *s, int point, int from, int to,
                             double least) {
    double error = 0.0;
    for (int r = from; r < to; r++) {
        double got = s->ln[(size_t)point * (size_t)s->ncheck + (size_t)r];
        double want = estimate(s, r, s->bits[point]);
        if (isnan(want) && isnan(got)) continue;        /* neither here nor there */
        if (isnan(want) || isnan(got)) return HUGE_VAL; /* gone, or new */
        if (fmax(got, want) < log(least)) continue;     /* far below every limit */
        error = fmax(error, fabs(got - want));
    }
    return error;
}

static double largest_run(const fw_verdict_search *s) {
    double most = -HUGE_VAL;
    for (int p = 0; p < s->fabricated->ncorner; p++)
        for (int r = 0; r < s->nplane; r++)
            most = fmax(most, s->ln[(size_t)p * (size_t)s->ncheck + (size_t)r]); /* NaN is passed */
    return most;
}

/* a utilisation above this may be beyond its limit with the band of the model: for a required pose
   with what drift and give of the hinges may add, and wider outside the fitted range of fillets and
   arcs (10 % counted for every flexure) */
static double near_limit(const fw_verdict_search *s, int check) {
    int scenes = s->device->nscene + 1;
    bool pose = check < s->v->nhinge * scenes && check % scenes == scenes - 1;
    const fw_verdict_model_errors *e = &fw_verdict_model_error;
    double give = 0.0;
    for (int k = 0; k < FW_SIX && pose; k++)
        give = fmax(give, s->v->workspace.load[k].give);
    return 0.95 / (1.1 + e->strain + (pose ? give : e->motion));
}

/* Upper bound of ln U at a corner that may not have been run: by one that was, where the two differ
   in inputs of no account only; else first order with the error seen so far. */
static double upper_at(const fw_verdict_search *s, int check, unsigned bits) {
    const fw_verdict_variant_verdict *v = s->v;
    unsigned account = 0;
    for (int i = 0; i < v->ninput; i++) {
        double slope = fabs(s->slope[check * v->ninput + i]);
        if (slope * (v->input[i].high - v->input[i].low) >= fw_of_no_account) account |= 1u << i;
    }
    for (int p = 0; p < s->fabricated->ncorner; p++)
        if (s->bits[p] != FW_NO_CORNER && ((s->bits[p] ^ bits) & account) == 0)
            return s->ln[(size_t)p * (size_t)s->ncheck + (size_t)check] + estimate(s, check, bits) -
                   estimate(s, check, s->bits[p]);
    return estimate(s, check, bits) + s->fabricated->error;
}

/* the highest of these bounds, over all corners or those that were not run */
static double highest_bound(const fw_verdict_search *s, int check, bool unrun, unsigned *at) {
    double highest = -HUGE_VAL;
    const unsigned fixed = fw_verdict_search_without_range(s->v);
    for (unsigned bits = 0; bits < 1u << s->v->ninput; bits++) {
        if ((bits & fixed) || (unrun && fw_verdict_search_find(s, bits) != FW_NONE)) continue;
        double upper = upper_at(s, check, bits);
        if (upper > highest) highest = upper, *at = bits;
    }
    return highest;
}

/* Of corners that are nobody's worst, the one where a hinge may still be beyond its limit: the bound
   that is reported of an accepted hinge is below its limit. */
static unsigned not_yet_below(const fw_verdict_search *s) {
    int checks = s->device->nscene + 1;
    double highest = 0.0;
    unsigned next = FW_NO_CORNER, at = 0;
    for (int k = 0; k < s->v->nhinge; k++)
        for (int r = k * checks; r < (k + 1) * checks; r++) {
            if (isnan(s->ln[r])) continue;
            double upper = highest_bound(s, r, true, &at) + log(fw_verdict_band_above(s, k));
            if (upper > highest) highest = upper, next = at;
        }
    return next;
}

/* runs the corner of the check whose estimate, with the error seen so far, is highest and either
   above everything that was run or near a limit, across the plane near a limit; false: there is none left */
static fw_status run_next(fw_verdict_search *s, bool *ran) {
    double largest = largest_run(s), highest = -HUGE_VAL;
    unsigned next = FW_NO_CORNER;
    for (int r = 0; r < s->ncheck; r++) {
        if (isnan(s->ln[r])) continue;
        const bool across = r >= s->nplane;
        unsigned bits = choose(s, r, true);
        double upper = estimate(s, r, bits) + (across ? s->across_error : s->fabricated->error);
        double bar = across ? log(FW_NEAR_TIPPING) : fmin(largest, log(near_limit(s, r)));
        bool first = !across && s->fabricated->ncorner == s->first; /* one is run in any case */
        if (!first && (fw_verdict_search_find(s, bits) != FW_NONE || !(upper > bar))) continue;
        if (upper > highest) highest = upper, next = bits;
    }
    if (next == FW_NO_CORNER) next = not_yet_below(s);
    if (next == FW_NO_CORNER) next = fw_verdict_ends_next(s);
    *ran = next != FW_NO_CORNER;
    if (!*ran) return FW_OK;
    double x[FW_FABRICATION_INPUTS];
    fw_verdict_search_corner_point(s, next, x);
    FW_TRY(fw_verdict_search_run(s, x, next));
    const int at = s->fabricated->ncorner - 1;
    s->fabricated->error =
        fmax(s->fabricated->error, estimate_error(s, at, 0, s->nplane, FW_FAR_BELOW));
    s->across_error =
        fmax(s->across_error, estimate_error(s, at, s->nplane, s->ncheck, FW_FLAT_BELOW));
    fw_verdict_ends_compare(s, at);
    return FW_OK;
}

static bool no_slope(const fw_verdict_search *s) {
    for (int r = 0; r < s->nplane; r++)
        for (int i = 0; !isnan(s->ln[r]) && i < s->v->ninput; i++)
            if (isnan(s->slope[r * s->v->ninput + i])) return true;
    return false;
}

static fw_status all_ahead(fw_verdict_search *s, unsigned fixed) {
    const size_t width = (size_t)s->v->ninput;
    double *x = fw_arena_array(s->arena, double, ((size_t)1 << s->v->ninput) * width);
    size_t n = 0;
    FW_NEED(x);
    for (unsigned bits = 0; bits < 1u << s->v->ninput; bits++)
        if (!(bits & fixed) && fw_verdict_search_find(s, bits) == FW_NONE)
            fw_verdict_search_corner_point(s, bits, x + width * n++);
    return fw_verdict_search_ahead(s, x, NULL, n);
}

static fw_status run_all(fw_verdict_search *s) {
    double x[FW_FABRICATION_INPUTS];
    const unsigned fixed = fw_verdict_search_without_range(s->v);
    s->fabricated->all = true;
    FW_TRY(all_ahead(s, fixed));
    for (unsigned bits = 0; bits < 1u << s->v->ninput; bits++) {
        if ((bits & fixed) || fw_verdict_search_find(s, bits) != FW_NONE) continue;
        fw_verdict_search_corner_point(s, bits, x);
        FW_TRY(fw_verdict_search_run(s, x, bits));
    }
    return FW_OK;
}

static fw_status run_nominal(fw_verdict_search *s) {
    double x[FW_FABRICATION_INPUTS];
    nominal_point(s->v, x);
    return fw_verdict_search_run(s, x, FW_NO_CORNER);
}

fw_status fw_verdict_search_corners(fw_verdict_search *s) {
    const bool trial = s->options.corners != FW_CORNERS_AUTO; /* often refused at once */
    if (!trial) FW_TRY(slopes_ahead(s, true));
    FW_TRY(run_nominal(s));
    if (s->fabricated->corner[0].decision == FW_REJECT && !s->options.all_made) return FW_OK;
    if (trial) FW_TRY(slopes_ahead(s, false));
    FW_TRY(slopes(s));
    if (no_slope(s) || fw_verdict_ends_unknown(s)) return run_all(s);
    for (bool ran = true; ran && fmax(s->fabricated->error, s->across_error) <= fw_trusted;)
        FW_TRY(run_next(s, &ran));
    return fmax(s->fabricated->error, s->across_error) > fw_trusted ? run_all(s) : FW_OK;
}

fw_status fw_verdict_search_ends(fw_verdict_search *s, int check) {
    double x[FW_FABRICATION_INPUTS];
    bool one = s->first == 0 || fw_verdict_search_without_range(s->v) + 1u == 1u << s->v->ninput;
    if (one || s->fabricated->all || isnan(s->ln[check])) return FW_OK; /* no other corner */
    for (int up = 0; up < 2; up++) {
        unsigned bits = choose(s, check, up);
        if (fw_verdict_search_find(s, bits) != FW_NONE) continue;
        fw_verdict_search_corner_point(s, bits, x);
        FW_TRY(fw_verdict_search_run(s, x, bits));
    }
    return FW_OK;
}

/* ---- hinges that differ ----
   Edges of every hinge may stand apart from what all have in common by up to d. At the worst device that was run each
   hinge alone is made narrower by d: the change of every check. To first order the worst pattern of a check adds the
   sizes of all of them. It is run for every check that it may bring to its limit, at that check's own worst point, and
   what the estimate is off there is added to all. */

/* where hinges differ most; false: nothing says that they do */
static bool most_apart(const fw_verdict_variant_verdict *v, double *x) {
    bool any = false;
    for (int i = 0; i < v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &v->input[i];
        if (in->local == 0.0 || !(in->high > in->low)) continue;
        any = true, x[i] = in->high;
    }
    return any;
}

static int worst_point(const fw_verdict_search *s, int check, int points) {
    int worst = FW_NONE;
    for (int p = 0; p < points; p++) {
        const double ln = s->ln[(size_t)p * (size_t)s->ncheck + (size_t)check];
        if (isnan(ln)) continue;
        if (worst == FW_NONE || ln > s->ln[(size_t)worst * (size_t)s->ncheck + (size_t)check])
            worst = p;
    }
    return worst;
}

typedef struct apart {
    int points;     /* those that were run alike */
    double *change; /* (ncheck x nrevolute) of ln U as one hinge alone gets narrower */
    double *most;   /* (ncheck) ln U of the worst pattern, to first order; NaN: no such check */
    double error;
} apart;

/* (joints) signs of devices of which one hinge alone is narrower, and as often where they are; NULL: it has no flexure */
static fw_status each_narrower(fw_verdict_search *s, const double *x, const signed char **sign) {
    const size_t joints = (size_t)s->device->nrevolute, width = (size_t)s->v->ninput;
    const signed char **next = fw_arena_array(s->arena, const signed char *, joints);
    double *at = fw_arena_array(s->arena, double, joints *width);
    size_t n = 0;
    FW_NEED(next && at ? next : NULL);
    for (size_t j = 0; j < joints; j++) {
        signed char *one;
        if (s->device->revolute[j].flexure == FW_NONE) continue;
        FW_NEED(one = fw_arena_array(s->arena, signed char, joints));
        one[j] = -1;
        sign[j] = next[n] = one;
        memcpy(at + width * n++, x, width * sizeof *x);
    }
    return fw_verdict_search_ahead(s, at, next, n);
}

static fw_status change_each(fw_verdict_search *s, apart *a, int worst) {
    const size_t joints = (size_t)s->device->nrevolute, n = (size_t)s->v->ninput;
    double *ln = fw_arena_array(s->arena, double, (size_t)s->ncheck),
           *x = fw_arena_array(s->arena, double, n);
    const signed char **sign = fw_arena_array(s->arena, const signed char *, joints);
    fw_verdict_fabricated_corner narrower;
    FW_NEED(ln && x && sign ? ln : NULL);
    memcpy(x, s->fabricated->corner[worst].x, n * sizeof *x);
    most_apart(s->v, x);
    FW_TRY(each_narrower(s, x, sign));
    for (size_t j = 0; j < joints; j++) {
        if (!sign[j]) continue;
        s->sign = sign[j];
        FW_TRY(fw_verdict_search_point(s, x, &narrower, ln));
        fw_verdict_ends_apart(s, worst, &narrower);
        s->judged++;
        for (int r = 0; r < s->ncheck; r++) {
            const double was = s->ln[(size_t)worst * (size_t)s->ncheck + (size_t)r];
            /* gone at one of the two: no estimate */
            a->change[(size_t)r * joints + j] = isnan(was) && isnan(ln[r]) ? 0.0
                                                : isnan(was + ln[r])       ? fw_trusted
                                                                           : ln[r] - was;
        }
    }
    return FW_OK;
}

/* the pattern of a check at its own worst point; *ran false: it was run already */
static fw_status run_pattern(fw_verdict_search *s, apart *a, int check, bool *ran) {
    const size_t joints = (size_t)s->device->nrevolute, n = (size_t)s->v->ninput;
    const int worst = worst_point(s, check, a->points);
    double *x = fw_arena_array(s->arena, double, n);
    signed char *sign = fw_arena_array(s->arena, signed char, joints);
    FW_NEED(x && sign ? x : NULL);
    for (size_t j = 0; j < joints; j++)
        if (s->device->revolute[j].flexure != FW_NONE)
            sign[j] = a->change[(size_t)check * joints + j] < 0.0 ? 1 : -1;
    memcpy(x, s->fabricated->corner[worst].x, n * sizeof *x);
    most_apart(s->v, x);
    *ran = false;
    for (int p = a->points; p < s->fabricated->ncorner; p++)
        if (memcmp(s->fabricated->corner[p].x, x, n * sizeof *x) == 0 &&
            memcmp(s->fabricated->corner[p].sign, sign, joints) == 0)
            return FW_OK;
    if (s->fabricated->ncorner >= FW_MOST_POINTS) return FW_OK;
    s->sign = sign;
    *ran = true;
    FW_TRY(fw_verdict_search_run(s, x, FW_NO_CORNER));
    const double got =
        s->ln[(size_t)(s->fabricated->ncorner - 1) * (size_t)s->ncheck + (size_t)check];
    if (!isnan(got) && check < s->nplane) a->error = fmax(a->error, fabs(got - a->most[check]));
    return FW_OK;
}

/* the highest first; at least one is run */
static fw_status run_patterns(fw_verdict_search *s, apart *a) {
    bool *done = fw_arena_array(s->arena, bool, (size_t)s->ncheck), ran, any = false;
    FW_NEED(done);
    for (int turn = 0; turn < s->ncheck; turn++) {
        int next = FW_NONE;
        for (int r = 0; r < s->ncheck; r++)
            if (!done[r] && !isnan(a->most[r]) && (next == FW_NONE || a->most[r] > a->most[next]))
                next = r;
        if (next == FW_NONE) return FW_OK;
        done[next] = true;
        const bool across = next >= s->nplane;
        const double near = log(across ? FW_NEAR_TIPPING : near_limit(s, next));
        if ((any || across) && !(a->most[next] + (across ? 0 : a->error) > near)) continue;
        FW_TRY(run_pattern(s, a, next, &ran));
        any = any || ran;
    }
    return FW_OK;
}

/* most (nhinge): of a hinge at the worst pattern, 0 where none is known */
static fw_status hinges_apart(fw_verdict_search *s, double *most) {
    const size_t joints = (size_t)s->device->nrevolute;
    apart a = {.points = s->fabricated->ncorner};
    double unused[FW_FABRICATION_INPUTS];
    if (!most_apart(s->v, unused) || s->first == 0) return FW_OK;
    FW_NEED(a.change = fw_arena_array(s->arena, double, (size_t)s->ncheck *joints));
    FW_NEED(a.most = fw_arena_array(s->arena, double, (size_t)s->ncheck));
    size_t highest = 0, cells = (size_t)a.points * (size_t)s->ncheck;
    for (size_t i = 0; i < cells; i++)
        if ((int)(i % (size_t)s->ncheck) < s->nplane && !(s->ln[i] <= s->ln[highest]) &&
            !isnan(s->ln[i]))
            highest = i;
    FW_TRY(change_each(s, &a, (int)(highest / (size_t)s->ncheck)));
    for (int r = 0; r < s->ncheck; r++) {
        const int at = worst_point(s, r, a.points);
        a.most[r] = at == FW_NONE ? (double)NAN : s->ln[(size_t)at * (size_t)s->ncheck + (size_t)r];
        for (size_t j = 0; j < joints; j++)
            a.most[r] += fabs(a.change[(size_t)r * joints + j]);
    }
    FW_TRY(run_patterns(s, &a));
    s->sign = NULL;
    const int checks = s->device->nscene + 1;
    for (int r = 0; r < s->v->nhinge * checks; r++) {
        if (isnan(a.most[r])) continue;
        double numeric = 0.0;
        for (int c = 0; c < s->fabricated->ncorner; c++)
            numeric = fmax(numeric, s->fabricated->corner[c].hinge[r / checks].numeric);
        most[r / checks] = fmax(most[r / checks], exp(a.most[r] + a.error) + numeric);
    }
    return FW_OK;
}

/* ---- what it says ---- */

static void tightest(fw_verdict_search *s, int k) {
    fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    fw_verdict_fabricated_hinge *h = &fabricated->hinge[k];
    for (int c = 1; c < fabricated->ncorner; c++) {
        const fw_verdict_hinge_verdict *now = &fabricated->corner[c].hinge[k],
                                       *worst = &fabricated->corner[h->corner].hinge[k];
        if (now->scene && (!worst->scene || now->utilisation > worst->utilisation)) h->corner = c;
    }
    h->most = fabricated->corner[h->corner].hinge[k].utilisation +
              fabricated->corner[h->corner].hinge[k].numeric;
}

/* sigma and what it is made of, from the check that governs the nominal device; the bound over all
   corners from every check */
static void first_order(fw_verdict_search *s, int k) {
    fw_verdict_fabricated_hinge *h = &s->fabricated->hinge[k];
    int checks = s->device->nscene + 1, check = FW_NONE, n = s->v->ninput;
    double sum = 0.0;
    for (int r = k * checks; r < (k + 1) * checks; r++) {
        if (isnan(s->ln[r])) continue;
        if (check == FW_NONE || s->ln[r] > s->ln[check]) check = r;
        unsigned at;
        if (!s->fabricated->all) h->most = fmax(h->most, exp(highest_bound(s, r, false, &at)));
    }
    for (int i = 0; check != FW_NONE && i < n; i++) {
        double slope = s->slope[check * n + i];
        h->share[i] = isnan(slope) ? 0.0 : exp(s->ln[check]) * slope * s->v->input[i].sigma;
        sum += h->share[i] * h->share[i];
    }
    h->sigma = sqrt(sum);
}

static fw_status explain(fw_verdict_search *s) {
    fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    const fw_verdict_fabricated_corner *c = &fabricated->corner[fabricated->at];
    const fw_verdict_hinge_verdict *h =
        fabricated->governing == FW_NONE ? NULL : &c->hinge[fabricated->governing];
    const char *flow = s->v->variant->flow ? s->v->variant->flow : "this flow";
    if (!h || c->why) {
        const char *why = fw_verdict_ends_why(s, fabricated->at);
        FW_NEED(why);
        why = fw_arena_printf(s->arena, "as %s makes it (%s): %s", flow, c->what, why);
        return (fabricated->reason = why) ? FW_OK : FW_NOMEM;
    }
    char used[32], drawn[32];
    fw_percent_text(used, sizeof used, h->utilisation);
    fw_percent_text(drawn, sizeof drawn, s->v->hinge[fabricated->governing].utilisation);
    FW_NEED(fabricated->reason = fw_arena_printf(
                s->arena,
                "as %s makes it%s (%s) %s%s uses %s %% of its limit in %s, as drawn %s %%", flow,
                fabricated->at ? " at worst" : "", c->what, FW_NAMED("hinge", h->id), used,
                h->scene, drawn));
    return FW_OK;
}

static fw_status add_reason(fw_verdict_search *s, fw_verdict_variant_verdict *v) {
    const fw_verdict_fabricated_verdict *fabricated = s->fabricated;
    const fw_verdict_fabricated_corner *c = &fabricated->corner[fabricated->at];
    const fw_verdict_hinge_verdict *h =
        fabricated->governing == FW_NONE ? NULL : &c->hinge[fabricated->governing];
    double keep = h ? fmin(fmax(0.98 / h->utilisation_high, 1e-3), 0.99) : FW_VERDICT_KEEP_HALF;
    const char *text = fabricated->reason;
    if (fabricated->control)
        FW_NEED(text =
                    fw_arena_printf(s->arena, "%s; %s", fabricated->reason, fabricated->control));
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = h ? h->scene : "as made",
                                                  .flow = v->variant->flow,
                                                  .number = h ? 237 : 238,
                                                  .decision = fabricated->decision,
                                                  .keep = keep,
                                                  .not_by_loads = !h && c->not_by_loads,
                                                  .not_by_width = !h && c->not_by_width,
                                                  .text = text};
    return FW_OK;
}

fw_status fw_verdict_search_begin(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_verdict_options *options,
                                  const fw_verdict_variant_verdict *v, fw_verdict_search *s) {
    size_t n = (size_t)v->ninput, h = (size_t)v->nhinge;
    const int ncheck = fw_verdict_checks(device, v), nplane = ncheck - 2 * device->nscene;
    *s = (fw_verdict_search){.arena = arena,
                             .device = device,
                             .layout = layout,
                             .options = *options,
                             .v = v,
                             .nplane = nplane,
                             .ncheck = ncheck,
                             .tipping = fw_verdict_across_counts(v),
                             .clearances = fw_verdict_search_clearances_count(v, false),
                             .nearest = fw_verdict_search_clearances_count(v, true)};
    s->options.motion.samples = 65; /* stability is looked at between them */
    FW_NEED(s->fabricated = fw_arena_one(arena, fw_verdict_fabricated_verdict));
    FW_NEED(s->fabricated->corner =
                fw_arena_array(arena, fw_verdict_fabricated_corner, FW_MOST_POINTS));
    FW_NEED(s->fabricated->hinge = fw_arena_array(arena, fw_verdict_fabricated_hinge, h));
    FW_NEED(s->ln = fw_arena_array(arena, double, (size_t)FW_MOST_POINTS *(size_t)s->ncheck));
    FW_NEED(s->bits = fw_arena_array(arena, unsigned, FW_MOST_POINTS));
    FW_NEED(s->slope = fw_arena_array(arena, double, (size_t)s->ncheck *n));
    FW_NEED(s->end = fw_arena_array(arena, fw_verdict_end, 2 * (size_t)v->nrequirement));
    for (size_t k = 0; k < h; k++)
        FW_NEED(s->fabricated->hinge[k].share = fw_arena_array(arena, double, n));
    s->fabricated->ln = s->ln;
    s->fabricated->ncheck = s->ncheck;
    s->fabricated->held = FW_NONE;
    s->fabricated->held_share = (double)NAN;
    return fw_verdict_search_most(s);
}

fw_status fw_verdict_as_fabricated(fw_arena *arena, const fw_device *device,
                                   const fw_layout *layout, const fw_verdict_options *options,
                                   fw_verdict_variant_verdict *v) {
    fw_verdict_search s;
    const char *open; /* what nobody knows; NULL: nothing */
    bool decided, alone = options->corners == FW_CORNERS_SUSPECT && v->nsuspect > 0;
    bool quick = alone || options->corners != FW_CORNERS_AUTO;
    if (v->ninput == 0 || options->corners == FW_CORNERS_NONE) return FW_OK;
    if (v->drawn == FW_REJECT && !options->all_made) return FW_OK;
    FW_TRY(fw_verdict_not_known(arena, v, &open));
    /* What is undecided as drawn stays so, but for what the flow makes of it without any deviation; a glance, which does not
       refine, is told how much further its corner is from the limit */
    const bool nominal = v->drawn != FW_ACCEPT && !options->all_made && !alone;
    if (nominal && (quick || options->at_a_glance)) return FW_OK;
    FW_TRY(fw_verdict_search_begin(arena, device, layout, options, v, &s));
    if (quick && !alone) s.options.corners = FW_CORNERS_FIRST;
    FW_TRY(fw_verdict_search_suspects(&s, &decided));
    double *apart_most = fw_arena_array(arena, double, (size_t)v->nhinge);
    FW_NEED(apart_most);
    if (nominal) {
        FW_TRY(run_nominal(&s));
        if (s.fabricated->corner[0].decision != FW_REJECT) return FW_OK;
    } else if (!decided) {
        FW_TRY(fw_verdict_search_corners(&s));
        FW_TRY(hinges_apart(&s, apart_most));
    }
    for (int k = 0; k < v->nhinge; k++) {
        tightest(&s, k);
        if (!decided && s.first > 0) first_order(&s, k);
        s.fabricated->hinge[k].most = fmax(s.fabricated->hinge[k].most, apart_most[k]);
    }
    if (!decided) FW_TRY(fw_verdict_ends_made(&s));
    if (!decided) fw_verdict_stators_made(&s, v);
    fw_verdict_search_govern(&s);
    v->fabricated = s.fabricated;
    const bool accepted = s.fabricated->decision == FW_ACCEPT;
    if (accepted || (!quick && !decided)) FW_TRY(fw_verdict_between_corners(&s, v));
    if (accepted && !quick) FW_TRY(fw_verdict_edge_room_made(&s));
    if (accepted) return FW_OK;
    if (quick) {
        v->decision = FW_INCONCLUSIVE;
        return FW_OK;
    }
    s.fabricated->reason = open;
    if (s.fabricated->corner[s.fabricated->at].decision == FW_ACCEPT) return FW_OK;
    FW_TRY(explain(&s));
    if (s.fabricated->decision == FW_INCONCLUSIVE && !options->unheld && !open)
        FW_TRY(fw_verdict_fabrication_control(&s));
    v->decision = fw_verdict_worse(v->decision, s.fabricated->decision);
    return add_reason(&s, v);
}
