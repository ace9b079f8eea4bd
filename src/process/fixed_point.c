/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where edges end up: bias, gaps, time and what the etch takes sideways, solved together (fixed_point.h); and how deep an
   opening then is. */
#include "process/films.h"
#include "process/fixed_point.h"
#include "process/process_law.h"
#include <math.h>
#include <string.h>

static const double SAME = 1e-9; /* relative: two openings of one class */
enum { MOST_STEPS = 100, HALVINGS = 60 };

/* ---- what the pack says ---- */

static double known(const fw_quantity *q) {
    return q && !q->unknown ? q->value : (double)NAN;
}

static const fw_quantity *argument(const fw_process_argument *list, int n, const char *name) {
    for (int i = 0; i < n; i++)
        if (strcmp(list[i].name, name) == 0) return list[i].q;
    return NULL;
}

static double depth_of(const fw_process_flow *flow, const fw_process_change *c,
                       double thickness_m) {
    bool own =
        c->thickness && flow->thickness &&
        (c->thickness == flow->thickness || (c->thickness->id && flow->thickness->id &&
                                             strcmp(c->thickness->id, flow->thickness->id) == 0));
    return own && thickness_m > 0.0 ? thickness_m : known(c->thickness);
}

static bool lags(const char *name) {
    const fw_process_law *law = fw_process_law_find(name);
    return law && law->lags;
}

/* how narrow openings fall behind: the step's own law, else the one it derives on the way */
static void read_lag(const fw_process_step *s, fw_process_cut *cut) {
    bool own = lags(s->law);
    const fw_process_argument *list = s->argument;
    int n = s->nargument;
    const char *shape = s->shape;
    for (int i = 0; !own && i < s->nderive; i++)
        if (lags(s->derive[i].law)) {
            list = s->derive[i].argument;
            n = s->derive[i].nargument;
            shape = s->derive[i].shape;
        }
    cut->width_m = (double)INFINITY;
    if (!own && list == s->argument) return;
    bool linear = strcmp(shape, "linear") == 0;
    cut->lag = linear                           ? FW_LAG_LINEAR
               : strcmp(shape, "cylinder") == 0 ? FW_LAG_CYLINDER
                                                : FW_LAG_SLOT;
    cut->lag_quantity = argument(list, n, linear ? "lag" : "probability");
    cut->lag_value = known(cut->lag_quantity);
    cut->own = own = own && !fw_process_lag_is_guess(cut->lag_quantity);
    const fw_quantity *width = own ? argument(list, n, "width") : NULL;
    cut->follows = width && width->id && strcmp(width->id, FW_MASK_OPENING) == 0;
    if (own && !cut->follows) cut->width_m = known(width);
}

/* the range of the anisotropy: the corner's, so that the verdict looks at the same one */
static void read_range(const fw_process_flow *flow, const fw_quantity *A, fw_process_cut *cut) {
    cut->low = cut->high = cut->anisotropy;
    for (int i = 0; i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        if (c->of != FW_CORNER_ANISOTROPY || c->q != A) continue;
        const fw_quantity *q = A->unknown ? c->assumed : A;
        if (!q || q->unknown) return;
        fw_process_quantity_range(q, &cut->low, &cut->high);
        cut->high = fmin(cut->high, 1.0);
    }
}

static void read_cut(const fw_process_flow *flow, const fw_process_step *s,
                     const fw_process_change *c, double depth_m, fw_process_cut *cut) {
    *cut = (fw_process_cut){.step = s,
                            .quantity = c->anisotropy,
                            .device = !flow->material || strcmp(c->material, flow->material) == 0,
                            .depth_m = depth_m,
                            .overrun = s->overrun,
                            .anisotropy = known(c->anisotropy),
                            .compensate = c->compensate,
                            .lag_value = 0.0};
    read_lag(s, cut);
    read_range(flow, c->anisotropy, cut);
}

/* where edges are known to come out, and the ranges of both edges and walls */
static void read_corners(const fw_process_flow *flow, double thickness_m,
                         fw_process_fixed_point *p) {
    for (int i = 0; i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        bool edge = c->of == FW_CORNER_EDGE, wall = c->of == FW_CORNER_TAPER;
        const fw_quantity *q = c->q && c->q->unknown ? c->assumed : c->q;
        if ((!edge && !wall) || !fw_process_corner_counts(c)) continue;
        const bool open = !q || q->unknown;
        p->open = p->open || open;
        if (open || (wall && isnan(thickness_m))) continue;
        double low, high, x = c->q->unknown ? 0.0 : q->value;
        fw_process_quantity_range(q, &low, &high);
        if (edge) {
            p->printed_m -= x;
            p->edges_u_m = hypot(p->edges_u_m, q->uncertainty);
            p->off_low_m += low - x;
            p->off_high_m += high - x;
        } else {
            p->flare_m += thickness_m * x;
            p->flare_off_m += thickness_m * fmax(x - low, high - x);
        }
    }
}

static void read_flow(const fw_process_flow *flow, double thickness_m, fw_process_fixed_point *p) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nchange; k++) {
            const fw_process_change *c = &s->change[k];
            double depth = depth_of(flow, c, thickness_m);
            if (!fw_process_where_is_of_device(flow, c->where)) continue;
            if (c->isotropic) {
                p->wet_open = p->wet_open || isnan(depth);
                p->wet_m += isnan(depth) ? 0.0 : depth * (1.0 + s->overrun);
            }
            if (c->anisotropy && !isnan(depth) && p->ncut < FW_CUTS)
                read_cut(flow, s, c, depth, &p->cut[p->ncut++]);
        }
    }
    read_corners(flow, thickness_m > 0.0 ? thickness_m : known(flow->thickness), p);
}

double fw_process_fixed_point_printed_m(const fw_process_fixed_point *p) {
    return p->bias_m - p->printed_m;
}

double fw_process_fixed_point_slope(const fw_process_fixed_point *p, double device_m) {
    bool cut = false;
    for (int i = 0; i < p->ncut; i++)
        cut = cut || p->cut[i].device;
    return cut || !(device_m > 0.0) ? 0.0 : -p->flare_m / device_m;
}

/* ---- openings ---- */

static void add_class(fw_process_fixed_point *p, fw_process_gap_kind kind, const char *name,
                      double gap_m) {
    if (!(gap_m > 0.0) || !isfinite(gap_m)) return;
    int at = p->ncls;
    for (int i = 0; i < p->ncls; i++) {
        if (p->cls[i].kind != FW_GAP_FIELD && kind != FW_GAP_FIELD &&
            fabs(p->cls[i].drawn_m - gap_m) <= SAME * gap_m)
            return;
        if (at == p->ncls && gap_m < p->cls[i].drawn_m) at = i;
    }
    memmove(&p->cls[at + 1], &p->cls[at], (size_t)(p->ncls - at) * sizeof *p->cls);
    p->cls[at] = (fw_process_edge_class){.kind = kind, .name = name, .drawn_m = gap_m};
    p->ncls++;
}

/* the mean opening of the field, 2 A/P: a slot of length L and width w has A = L w, P = 2 L */
static fw_status list_classes(fw_arena *arena, const fw_process_mask_facts *f,
                              fw_process_fixed_point *p) {
    if (!f || (f->structure_area_m2 == 0.0 && f->die_area_m2 == 0.0)) return FW_OK;
    FW_NEED(p->cls = fw_arena_array(arena, fw_process_edge_class, (size_t)f->ngap + 2));
    for (int i = 0; i < f->ngap; i++)
        add_class(p, f->gap[i].kind, f->gap[i].name, f->gap[i].gap_m);
    add_class(p, FW_GAP_SLOT, "narrowest slot", f->narrowest_slot_m);
    if (f->perimeter_m > 0.0)
        add_class(p, FW_GAP_FIELD, "open field",
                  2.0 * (f->die_area_m2 - f->structure_area_m2) / f->perimeter_m);
    p->field = p->ncls > 0 ? p->ncls - 1 : 0;
    for (int i = 0; i < p->ncls; i++)
        if (p->cls[i].kind == FW_GAP_FIELD) p->field = i;
    return FW_OK;
}

static double reference_m(const fw_process_fixed_point *p) {
    return p->ncls ? p->cls[p->field].drawn_m : (double)INFINITY;
}

/* ---- one etch ---- */

/* S J(w, D) or c D^2/(2 w), from t = (D + lag)/R: see law_etch.c for formula, source and error.
   w, D m, result m; 0 at w = INFINITY, NaN where S or c is not known. Test: test_law.c, arde. */
double fw_process_cut_lag(const fw_process_cut *cut, double w_m, double depth_m) {
    if (cut->lag == FW_LAG_NONE) return 0.0;
    if (isnan(cut->lag_value)) return (double)NAN;
    if (w_m == (double)INFINITY) return 0.0;
    if (cut->lag == FW_LAG_LINEAR) return cut->lag_value * depth_m * depth_m / (2.0 * w_m);
    return cut->lag_value * fw_process_arde_integral(w_m, depth_m, cut->lag == FW_LAG_CYLINDER);
}

double fw_process_cut_foot(const fw_process_cut *cut, double w_m) {
    double lag = fw_process_cut_lag(cut, w_m, cut->depth_m), left = cut->least_m - cut->depth_m;
    return fmax(0.0, left - (isnan(lag) ? 0.0 : lag));
}

/* d(lag)/dw, 1: J = w j(D/w) with j' = 1/K - 1, hence dJ/dw = J/w - x (1/K(x) - 1), x = D/w */
static double lag_slope(const fw_process_cut *cut, double w_m, double lag_m) {
    if (cut->lag == FW_LAG_NONE || w_m == (double)INFINITY) return 0.0;
    if (cut->lag == FW_LAG_LINEAR) return -lag_m / w_m;
    double x = cut->depth_m / w_m;
    double K = cut->lag == FW_LAG_CYLINDER ? fw_process_knudsen_cylinder(2.0 * x)
                                           : fw_process_knudsen_slot(x);
    return lag_m / w_m - cut->lag_value * x * (1.0 / K - 1.0);
}

/* E = (1 + overrun) (D + lag(w)) at the narrowest opening w, and what the mask adds, with slopes in
   the edge m of the masking layer: openings are gap - 2 m. `field` is the opening beside flexures,
   whose edges the mask brings to where they are drawn. What an unknown lag takes at least, without any, is known. */
static void cut_at(fw_process_cut *c, double A, double narrow_m, double field_m,
                   double *mask_slope) {
    double w = c->follows ? narrow_m : c->width_m;
    double lag = c->own ? fw_process_cut_lag(c, w, c->depth_m) : 0.0;
    double wide = fw_process_cut_lag(c, field_m, c->depth_m), more = 1.0 + c->overrun;
    c->planned_m = c->depth_m + lag;
    c->etched_m = more * c->planned_m;
    c->least_m = isnan(lag) ? more * c->depth_m : c->etched_m; /* a lag can only add to it */
    c->reach_slope = c->follows && !isnan(lag) ? -2.0 * more * lag_slope(c, w, lag) : 0.0;
    double foot = fw_process_cut_foot(c, field_m);
    double foot_slope =
        foot > 0.0 ? c->reach_slope + (isnan(wide) ? 0.0 : 2.0 * lag_slope(c, field_m, wide)) : 0.0;
    double share = !c->device || c->compensate == FW_FACE_BOTTOM ? 1.0
                   : c->compensate == FW_FACE_TOP                ? 0.0
                                                                 : 0.5;
    double loss = 1.0 - A;
    bool adds = !isnan(A);
    c->mask_m = adds ? loss * ((1.0 - share) * c->least_m + share * foot) : 0.0;
    *mask_slope = adds ? loss * ((1.0 - share) * c->reach_slope + share * foot_slope) : 0.0;
}

/* ---- the fixed point ---- */

/* m = F(m) for the edge m of the masking layer that the cuts then take back, by Newton from m = 0.
     F(m) = sum_k (1 - A_k) [(1 - s) E_k + s (E_k - D_k - lag_k(W - 2 m))],
     E_k = (1 + overrun_k) (D_k + lag_k(g - 2 m))
   In: g, W m, drawn narrowest gap and mean opening; A (ncut), 1; s = 0, 1/2, 1 for the face that is
   compensated. Out: false when there is no solution; *m, slope F' and steps in p. lag is convex and
   falls with w, W >= g, so that F is convex and rises: from the left Newton's steps stay left of
   the least solution and rise to it, and a point with F > m and F' >= 1 proves that there is none.
   Where S is 0 or nothing follows the mask, F is constant and one step does. Error: 1e-13 relative
   (quadratic). Cost: 3 lags per cut and step, 3 to 6 steps; at the fold some 20. Valid for A in
   [0, 1]. Source: docs/theory/etching.md. Test: test_fixed_point.c, against plain iteration on
   random packs, and at the fold. */
static bool newton(fw_process_fixed_point *p, const double *A, double gap_m, double field_m,
                   double *m) {
    *m = 0.0;
    p->slope = 0.0;
    for (p->iterations = 1; p->iterations <= MOST_STEPS; p->iterations++) {
        double F = 0.0, slope = 0.0;
        for (int k = 0; k < p->ncut; k++) {
            double d;
            cut_at(&p->cut[k], A[k], gap_m - 2.0 * *m, field_m - 2.0 * *m, &d);
            F += p->cut[k].mask_m;
            slope += d;
        }
        p->slope = slope;
        double off = F - *m;
        if (!isfinite(off) || !isfinite(slope)) return false;
        if (fabs(off) <= 1e-13 * fabs(F)) return slope < 1.0;
        if (off > 0.0 && slope >= 1.0) return false;
        *m += off / (1.0 - slope);
        if (!(gap_m - 2.0 * *m > 0.0)) return false;
    }
    return false;
}

static bool solvable(const fw_process_fixed_point *p, const double *A, double gap_m) {
    fw_process_fixed_point trial = *p;
    double m, W = fmax(reference_m(p), gap_m);
    return newton(&trial, A, gap_m, W, &m) &&
           gap_m > 2.0 * (m + p->wet_m + p->printed_m + p->wear.loss_m);
}

/* by bisection: the least of x in [bad, good] that has a solution; NaN when `good` has none */
static double least(const fw_process_fixed_point *p, const double *A, double bad, double good,
                    bool gap) {
    double own[FW_CUTS];
    for (int i = 0; i <= HALVINGS; i++) {
        double x = i == 0 ? good : 0.5 * (bad + good);
        memcpy(own, A, sizeof own);
        for (int k = 0; !gap && k < p->ncut; k++)
            if (p->cut[k].device && !isnan(A[k])) own[k] = x;
        bool there = solvable(p, own, gap ? x : p->cls[0].drawn_m);
        if (i == 0 && !there) return (double)NAN;
        if (i > 0 && there) good = x;
        if (!there) bad = x;
    }
    return good;
}

static void nearest_change(fw_process_fixed_point *p, const double *A) {
    if (p->ncls == 0) return;
    double g = p->cls[0].drawn_m,
           widest = 1e3 * (g + 2.0 * (p->wet_m + p->wear.loss_m + fabs(p->printed_m)));
    for (int k = 0; k < p->ncut; k++)
        widest += 1e3 * p->cut[k].depth_m;
    p->least_gap_m = least(p, A, g, widest, true);
    for (int k = 0; k < p->ncut; k++)
        if (p->cut[k].device && p->cut[k].anisotropy < 1.0)
            p->least_anisotropy = least(p, A, p->cut[k].anisotropy, 1.0, false);
}

/* ---- where edges stand ---- */

/* u(z) = (1 - A) (E - z - lag(w, z)): the wall at depth z is attacked from when the floor passes it
   until the end, at the constant rate (1 - A) R. Top z = 0, bottom z = D (0 where the floor has
   not come through). Edges outward, m. The wall between is taken straight: off by at most
   (1 - A) |lag(D)/2 - lag(D/2)|. */
fw_process_edge fw_process_fixed_point_edge(const fw_process_fixed_point *p, double w_m,
                                            const double *A) {
    double m = p->etch_m;
    fw_process_edge e = {m - 0.5 * p->flare_m, 0.0, m + 0.5 * p->flare_m};
    for (int k = 0; k < p->ncut; k++) {
        const fw_process_cut *c = &p->cut[k];
        if (isnan(A[k])) continue; /* its known part: nothing */
        double foot = fw_process_cut_foot(c, w_m);
        e.top_m -= (1.0 - A[k]) * (c->device ? c->least_m : foot);
        e.bottom_m -= (1.0 - A[k]) * foot;
    }
    e.middle_m = 0.5 * (e.top_m + e.bottom_m);
    return e;
}

const fw_process_cut *fw_process_fixed_point_cut(const fw_process_fixed_point *p,
                                                 const fw_quantity *anisotropy) {
    for (int k = 0; k < p->ncut; k++)
        if (anisotropy && p->cut[k].quantity == anisotropy) return &p->cut[k];
    return NULL;
}

static const fw_process_cut *device_cut(const fw_process_fixed_point *p) {
    for (int k = 0; k < p->ncut; k++)
        if (p->cut[k].device) return &p->cut[k];
    return NULL;
}

/* the corners of edges and walls move a face besides */
static fw_process_edge shifted(fw_process_edge e, double off_m, double wall_m) {
    return (fw_process_edge){e.top_m + off_m + 0.5 * wall_m, e.middle_m + off_m,
                             e.bottom_m + off_m + 0.5 * wall_m};
}

static void place_edges(fw_process_fixed_point *p, const double *A, const double *low,
                        const double *high) {
    const fw_process_cut *cut = device_cut(p);
    const fw_process_edge none = {(double)NAN, (double)NAN, (double)NAN};
    bool ranged = true;
    double least, most;
    fw_process_wear_range(&p->wear, &least, &most);
    const double worn_low = p->off_low_m + p->wear.loss_m - most,
                 worn_high = p->off_high_m + p->wear.loss_m - least;
    for (int k = 0; k < p->ncut; k++)
        ranged = ranged && !isnan(low[k]) && !isnan(high[k]) && !isnan(p->cut[k].etched_m);
    for (int i = 0; i < p->ncls; i++) {
        fw_process_edge_class *c = &p->cls[i];
        c->plate_m = c->drawn_m - 2.0 * p->bias_m;
        c->opening_m = c->drawn_m - 2.0 * p->etch_m;
        double reach =
            cut ? cut->depth_m + fw_process_cut_lag(cut, c->opening_m, cut->depth_m) : (double)NAN;
        c->reach_m = reach;
        c->through_s = (double)NAN;
        c->over_etch = cut ? cut->etched_m / reach - 1.0 : (double)NAN;
        c->edge = fw_process_fixed_point_edge(p, c->opening_m, A);
        c->low = c->high = none;
        if (!ranged) continue;
        c->low =
            shifted(fw_process_fixed_point_edge(p, c->opening_m, low), worn_low, -p->flare_off_m);
        c->high =
            shifted(fw_process_fixed_point_edge(p, c->opening_m, high), worn_high, p->flare_off_m);
    }
}

/* the bias that other anisotropies would ask for; NaN: none is possible */
static double bias_at(const fw_process_fixed_point *p, const double *A, double gap_m,
                      double field_m) {
    fw_process_fixed_point other = *p;
    double m;
    for (int k = 0; k < p->ncut; k++) /* of an unknown lag one end alone is known */
        if (isnan(A[k]) || isnan(p->cut[k].etched_m)) return (double)NAN;
    return newton(&other, A, gap_m, field_m, &m) ? m + p->wet_m + p->printed_m + p->wear.loss_m
                                                 : (double)NAN;
}

/* From the openings to the middle of what must come free, from the foot of the walls; m. Where walls stand does not depend
   on what they lose afterwards, which the mask adds. NaN: nothing is drawn. */
static double way_of(const fw_process_fixed_point *p, const fw_process_mask_facts *facts,
                     const double *A) {
    const fw_release *r = facts ? facts->release : NULL;
    if (!r || r->slowest < 0 || !(r->needed_m > 0.0)) return (double)NAN;
    if (!p->solved || p->ncls == 0) return r->needed_m;
    const double w = p->cls[p->field].drawn_m - 2.0 * p->etch_m,
                 foot = fw_process_fixed_point_edge(p, w, A).bottom_m;
    return r->needed_m + (isfinite(foot) ? foot : 0.0);
}

fw_status fw_process_fixed_point_solve(fw_arena *arena, const fw_process_flow *flow,
                                       const fw_process_mask_facts *facts, double thickness_m,
                                       fw_process_fixed_point *out) {
    fw_process_fixed_point *p = out;
    double A[FW_CUTS] = {0}, low[FW_CUTS] = {0}, high[FW_CUTS] = {0}, m;
    *p = (fw_process_fixed_point){.least_gap_m = (double)NAN, .least_anisotropy = (double)NAN};
    read_flow(flow, thickness_m, p);
    FW_TRY(list_classes(arena, facts, p));
    for (int k = 0; k < p->ncut; k++) {
        A[k] = p->cut[k].anisotropy;
        low[k] = p->cut[k].low;
        high[k] = p->cut[k].high;
    }
    double gap = p->ncls ? p->cls[0].drawn_m : (double)INFINITY, field = reference_m(p);
    p->solved = newton(p, A, gap, field, &m);
    p->etch_m = p->solved ? m : 0.0;
    for (int k = 0; k < p->ncut && !p->solved; k++) { /* what the drawn gap would ask for */
        double slope;
        cut_at(&p->cut[k], A[k], gap, field, &slope);
        p->cut[k].mask_m = 0.0;
    }
    FW_TRY(fw_process_flow_wear(arena, flow, way_of(p, facts, A), &p->wear));
    p->bias_m = p->etch_m + p->wet_m + p->printed_m + p->wear.loss_m;
    for (int k = 0; k < p->ncut; k++)
        p->open = p->open || isnan(A[k]) || isnan(p->cut[k].etched_m);
    if (!p->solved) nearest_change(p, A);
    p->high_m = bias_at(p, low, gap, field);
    p->low_m = bias_at(p, high, gap, field);
    place_edges(p, A, low, high);
    return FW_OK;
}

/* ---- how deep a cut is in an opening ---- */

/* z + lag(w, z) = E by bisection: the left side rises with z. In: the cut with its E, the opening w
   m. Out: m, error 1e-15 of the depth. Test: test_films.c, depth: z = D and E where they should. */
double fw_process_cut_depth(const fw_process_cut *cut, double w_m) {
    double E = cut->etched_m;
    if (isnan(E)) return cut->depth_m;
    double lag = fw_process_cut_lag(cut, w_m, cut->depth_m);
    if (isnan(lag)) return fmin(E, cut->depth_m);
    if (cut->depth_m + lag <= E) return cut->depth_m;
    double low = 0.0, high = cut->depth_m;
    for (int i = 0; i < 50; i++) {
        double z = 0.5 * (low + high);
        if (z + fw_process_cut_lag(cut, w_m, z) <= E)
            low = z;
        else
            high = z;
    }
    return low;
}
