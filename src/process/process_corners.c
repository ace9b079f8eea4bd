/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corners of a flow: read from the pack, and handed to the verdict as independent inputs. */
#include "process/films.h"
#include "process/pack.h"
#include "process/process.h"
#include <math.h>
#include <string.h>

/* ---- corners of quantities that a laboratory found together ---- */

/* one effect of all inputs, per unit and at their centres */
typedef struct effect {
    double *each, *at;
    double centre;
} effect;

static void effects_of(fw_verdict_fabrication_input *in, effect e[4]) {
    e[0] = (effect){&in->edge_m, &in->edge_at_m, in->even};
    e[1] = (effect){&in->flare_m, &in->flare_at_m, in->drawn};
    e[2] = (effect){&in->thickness, &in->thickness_at, in->drawn};
    e[3] = (effect){&in->youngs, &in->youngs_at, in->drawn};
}

/* Cholesky's factor of the correlations; a pivot is held above 1e-6, so that inputs that are fully correlated keep a range
   of a thousandth of their own. false: all are independent */
static bool factor(const fw_verdict_fabrication_input *in, int n,
                   double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    bool any = false;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++) {
            double sum = i == k ? 1.0 : fw_quantity_correlation(&in[i].q, &in[k].q);
            any = any || (i != k && sum != 0.0);
            for (int j = 0; j < k; j++)
                sum -= L[i][j] * L[k][j];
            L[i][k] = i == k ? sqrt(fmax(sum, 1e-6)) : sum / L[k][k];
        }
    return any;
}

/* what goes with input i: of input k > i the part s_k L_ki/(s_i L_ii) for every unit of it */
static void take_along(fw_verdict_fabrication_input *in, int n, int i,
                       double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    effect own[4], other[4];
    effects_of(&in[i], own);
    for (int k = i + 1; k < n; k++) {
        if (L[k][i] == 0.0) continue;
        double part = in[k].sigma * L[k][i] / (in[i].sigma * L[i][i]);
        effects_of(&in[k], other);
        for (int e = 0; e < 4; e++) {
            double more = *other[e].each * part;
            *own[e].each += more;
            *own[e].at -= more * (in[i].nominal - own[e].centre);
        }
    }
}

static fw_status name_parts(fw_arena *arena, fw_verdict_fabrication_input *in, int n, int i,
                            double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    static const double named = 0.05; /* less decides nothing that a person reads */
    for (int k = i + 1; k < n; k++)
        if (fabs(L[k][i]) > named)
            FW_NEED(in[i].name =
                        fw_arena_printf(arena, "%s (taking %s along)", in[i].name, in[k].q.id));
    for (int k = 0; k < i; k++)
        if (fabs(L[i][k]) > named)
            FW_NEED(in[i].name =
                        fw_arena_printf(arena, "%s (apart from %s)", in[i].name, in[k].q.id));
    return FW_OK;
}

/* x_k = n_k + s_k sum_i<=k L_ki z_i, z independent, R = L L': the state sum_k e_k (x_k - c_k) is written in
   y_i = n_i + s_i L_ii z_i, whose effect is e_i + sum_k>i e_k s_k L_ki/(s_i L_ii). y has the range of x about n, times
   L_ii; the first of two correlated inputs keeps its own, and the other what the first one does not say. The nominal
   device is the same. Without correlations nothing changes.
   Source: Golub and Van Loan, 4.2. Test: test_correlation.c, corners (against draws of the correlated inputs). */
fw_status fw_process_corners_independent(fw_arena *arena, fw_verdict_fabrication_input *in, int n) {
    double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS] = {{0}};
    for (int i = 0; i < n; i++)
        if (!(in[i].sigma > 0.0)) return FW_OK;
    if (!factor(in, n, L)) return FW_OK;
    for (int i = 0; i < n; i++) {
        FW_TRY(name_parts(arena, in, n, i, L));
        take_along(in, n, i, L); /* of later inputs as they are: their own turn comes */
    }
    for (int i = 0; i < n; i++) {
        in[i].low = in[i].nominal - (in[i].nominal - in[i].low) * L[i][i];
        in[i].high = in[i].nominal + (in[i].high - in[i].nominal) * L[i][i];
        in[i].sigma *= L[i][i];
    }
    return FW_OK;
}

/* ---- reading ---- */

static const struct {
    const char *word;
    fw_quantity_dimension dimension;
} kind[] = {{"edge", FW_DIM_LENGTH},      {"taper", {.rad = 1}}, {"anisotropy", {0}},
            {"thickness", FW_DIM_LENGTH}, {"youngs", {0}},       {"local", FW_DIM_LENGTH}};
enum { KINDS = sizeof kind / sizeof kind[0] };

static const fw_quantity *quantity(fw_process_pack *pack, const fw_xml_record *e, const char *name,
                                   int of) {
    const fw_xml_attribute *a = fw_process_pack_get(e, name);
    if (!a) return NULL;
    const fw_quantity *q = fw_process_pack_find(pack, a, FW_ID_QUANTITY);
    if (q && !fw_quantity_dimension_equal(q->dimension, kind[of].dimension))
        fw_diag_error(pack->diags, 260, a->place, "'%s' is no %s; give a quantity of that kind",
                      a->value, kind[of].word);
    return q;
}

static void read_corner(fw_process_pack *pack, const fw_xml_record *e) {
    fw_process_flow *f = pack->flow;
    int of = 0;
    while (of < KINDS && strcmp(kind[of].word, fw_process_pack_text(e, "of")) != 0)
        of++;
    if (of == KINDS) return; /* said by the schema */
    fw_process_corner *c = &f->corner[f->ncorner++];
    *c = (fw_process_corner){.of = (fw_process_corner_of)of,
                             .name = fw_process_pack_text(e, "name"),
                             .q = quantity(pack, e, "q", of),
                             .assumed = quantity(pack, e, "assumed", of),
                             .within = quantity(pack, e, "within", of),
                             .etched = strcmp(fw_process_pack_text(e, "etched"), "yes") == 0,
                             .place = e->element->place};
    for (const fw_process_corner *other = f->corner; other < c; other++)
        if (other->of == c->of && other->q == c->q)
            fw_diag_error(pack->diags, 260, e->element->place,
                          "a corner of this '%s' stands above already: its range would count twice",
                          kind[of].word);
    if (c->etched && of != FW_CORNER_EDGE)
        fw_diag_error(pack->diags, 260, e->element->place,
                      "etched is of an edge that an isotropic etch leaves; '%s' is none",
                      kind[of].word);
    const fw_quantity *layer = f->thickness;
    if (of == FW_CORNER_THICKNESS && layer && c->q != layer && !layer->unknown)
        c->aim_m = layer->value;
    if ((of == FW_CORNER_YOUNGS) == (fw_process_pack_get(e, "q") != NULL))
        fw_diag_error(pack->diags, 260, e->element->place,
                      of == FW_CORNER_YOUNGS
                          ? "the corner of Young's modulus is the material's own; it takes no q"
                          : "a corner of '%s' needs q: the quantity whose range it is",
                      kind[of].word);
}

void fw_process_pack_corners(fw_process_pack *pack) {
    for (const fw_xml_record *e = pack->root->first_child; e; e = e->next)
        if (fw_xml_is(e, "corner")) read_corner(pack, e);
    if (pack->flow->ncorner > FW_FABRICATION_INPUTS)
        fw_diag_error(pack->diags, 260, pack->flow->corner[FW_FABRICATION_INPUTS].place,
                      "a flow has at most %d corners: join those that move the same edge",
                      FW_FABRICATION_INPUTS);
}

/* ---- edges that isotropic etches leave ---- */

/* Standard uncertainty of an etch's own rate, relative: that of the step's time at an exact thickness. NaN: its time is
   not computable. */
static fw_status rate_uncertainty(fw_arena *arena, const fw_process_step *s, double *relative) {
    fw_process_law_use use = fw_process_law_of_step(s, NULL);
    fw_process_argument *argument =
        fw_arena_array(arena, fw_process_argument, (size_t)s->nargument);
    FW_NEED(argument);
    *relative = (double)NAN;
    if (!use.law) return FW_OK;
    for (int i = 0; i < s->nargument; i++) {
        argument[i] = s->argument[i];
        if (strcmp(argument[i].name, "thickness") != 0) continue;
        fw_quantity *exact = fw_arena_one(arena, fw_quantity);
        FW_NEED(exact);
        *exact = *argument[i].q;
        exact->uncertainty = 0.0;
        argument[i].q = exact;
    }
    use.argument = argument;
    fw_process_law_answer answer;
    FW_TRY(fw_process_law_evaluate(arena, &use, &answer));
    if (answer.computable && answer.value > 0.0) *relative = answer.uncertainty / answer.value;
    return FW_OK;
}

/* The mask adds what the isotropic etches below it are planned to take sideways, L = sum d (1 + overrun); what is left of
   it comes of their rates, each lasting as planned:
     u(e)^2 = sum (L_i u(R_i)/R_i)^2
   d, L, e m; R m/s. A laboratory that has measured the edge keeps what it found, and where a time is not computable the
   pack's own number stays. Error: first order in u(R)/R. Cost: one evaluation of each law.
   Source: docs/theory/etching.md. Test: test_corners.c edge_of_an_etch_follows_its_rate. */
fw_status fw_process_corners_follow(fw_arena *arena, fw_process_flow *flow) {
    double square = 0.0;
    int etches = 0;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_step *s = &flow->step[i];
            const fw_process_change *c = &s->change[k];
            const fw_quantity *more = s->overrun_from;
            if (!c->isotropic || !c->thickness || c->thickness->unknown ||
                !fw_process_where_is_of_device(flow, c->where))
                continue;
            double relative, over = more && !more->unknown ? more->value : s->overrun;
            FW_TRY(rate_uncertainty(arena, s, &relative));
            square += pow(c->thickness->value * (1.0 + over) * relative, 2.0);
            etches++;
        }
    for (int i = 0; i < flow->ncorner && etches > 0 && !isnan(square); i++) {
        fw_quantity *q = flow->corner[i].etched && flow->corner[i].q
                             ? fw_process_flow_own_quantity(flow, flow->corner[i].q->id)
                             : NULL;
        if (q && !q->replaced && !q->unknown) q->uncertainty = sqrt(square);
    }
    return FW_OK;
}

/* ---- what the device itself loses ---- */

typedef struct lost { /* in one step */
    double loss_m, u_m;
    const char *missing;
    bool never;
} lost;

/* does the mask give it, or a step on the way? Whether or not that was done by now */
static bool comes_later(const fw_process_flow *flow, const fw_quantity *q) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        if (s->planned == q) return true;
        for (int k = 0; k < s->nderive; k++)
            if (s->derive[k].q == q) return true;
    }
    return q->id && fw_process_quantity_computed(q);
}

/* the step's arguments with the reach of a release in the place of what the pack leaves to the mask; *l says what is not
   known of them */
static void arguments_with(const fw_process_flow *flow, const fw_process_step *s,
                           const fw_quantity *reach, fw_process_argument *list, lost *l) {
    for (int i = 0; i < s->nargument; i++) {
        const fw_quantity *q = s->argument[i].q;
        const bool solved = fw_process_release_solves(flow, q),
                   later = !solved && comes_later(flow, q);
        list[i] = s->argument[i];
        if (solved) list[i].q = reach;
        if (!later && !(solved && reach->unknown)) continue;
        l->missing = q->id;
        l->never = l->never || later;
    }
}

static const fw_quantity *of_name(const fw_process_step *s, const fw_process_argument *list,
                                  const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(list[i].name, name) == 0) return list[i].q;
    return NULL;
}

static const char *first_unknown(const fw_process_step *s, const fw_process_argument *list) {
    for (int i = 0; i < s->nargument; i++)
        if (list[i].q->unknown && list[i].q->id) return list[i].q->id;
    return "an input of its time";
}

/* l = r T (1 + overrun), T by the step's own law; where r is the R of the law `rate` it cancels in l, and need not be known.
   u of fw_process_lost_uncertainty. */
static fw_status by_rate(fw_arena *arena, const fw_process_step *s, const fw_quantity *r,
                         const fw_process_argument *list, lost *l) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *d = of_name(s, list, "thickness"), *R = of_name(s, list, "rate");
    fw_process_argument wide[FW_LAW_ARGUMENTS];
    fw_quantity none;
    fw_process_law_answer T;
    const double u_rate = r->unknown || r->value == 0.0 ? 0.0 : r->uncertainty / fabs(r->value);
    if (law->by_rate && R == r && !d->unknown) {
        const double of_d = d->value != 0.0 ? d->uncertainty / fabs(d->value) : 0.0;
        l->loss_m = d->value * (1.0 + s->overrun);
        l->u_m = fw_process_lost_uncertainty(true, u_rate, hypot(of_d, u_rate)) * l->loss_m;
        return FW_OK;
    }
    fw_process_law_use use = fw_process_law_of_step(s, list);
    use.argument = fw_process_law_wide(&use, wide, &none, true);
    FW_TRY(fw_process_law_evaluate(arena, &use, &T));
    if (!T.computable)
        l->missing = first_unknown(s, list);
    else if (r->unknown)
        l->missing = r->id;
    if (l->missing) return FW_OK;
    l->loss_m = r->value * T.value * (1.0 + s->overrun);
    l->u_m =
        fw_process_lost_uncertainty(R == r, u_rate, T.value > 0.0 ? T.uncertainty / T.value : 0.0) *
        l->loss_m;
    return FW_OK;
}

/* l = d (T/T_wide) (1 + overrun)/S: fw_process_exposed_loss */
static fw_status by_selectivity(fw_arena *arena, const fw_process_step *s, const fw_quantity *S,
                                const fw_quantity *reach, const fw_process_argument *list,
                                lost *l) {
    fw_process_argument wide[FW_LAW_ARGUMENTS];
    fw_quantity none;
    fw_process_law_answer own, open;
    fw_process_law_use use = fw_process_law_of_step(s, list);
    const double deep = fw_process_step_depth(s, reach->unknown ? (double)NAN : reach->value);
    use.argument = fw_process_law_wide(&use, wide, &none, true);
    FW_TRY(fw_process_law_evaluate(arena, &use, &own));
    use.argument = list;
    use.argument = fw_process_law_wide(&use, wide, &none, false);
    FW_TRY(fw_process_law_evaluate(arena, &use, &open));
    if (S->unknown)
        l->missing = S->id;
    else if (isnan(deep))
        l->missing = "how much the step takes off";
    else if (use.law->lags && !(own.computable && open.computable && open.value > 0.0))
        l->missing = first_unknown(s, list);
    if (l->missing) return FW_OK;
    const double slowed = use.law->lags ? own.value / open.value : 1.0;
    l->loss_m = deep * slowed * (1.0 + s->overrun) / S->value;
    l->u_m = l->loss_m * S->uncertainty / S->value;
    return FW_OK;
}

static fw_status lost_in(fw_arena *arena, const fw_process_flow *flow, const fw_process_step *s,
                         const fw_process_exposed *x, const fw_quantity *reach, lost *l) {
    fw_process_argument list[FW_LAW_ARGUMENTS];
    *l = (lost){0};
    if (!fw_process_law_find(s->law) || s->nargument > FW_LAW_ARGUMENTS) {
        l->missing = "the time of its law";
        return FW_OK;
    }
    arguments_with(flow, s, reach, list, l);
    if (l->missing) return FW_OK;
    return x->rate ? by_rate(arena, s, x->rate, list, l)
                   : by_selectivity(arena, s, x->selectivity, reach, list, l);
}

/* losses of all steps, a release of which runs so far */
static fw_status wear_with(fw_arena *arena, const fw_process_flow *flow, const fw_quantity *reach,
                           fw_process_wear *w) {
    bool released = false;
    *w = (fw_process_wear){0};
    for (int i = 0; flow->material && i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nchange; k++)
            released = released || s->change[k].reach;
        for (int k = 0; k < s->nexposed && fw_process_step_is_wet(s); k++) {
            const fw_process_exposed *x = &s->exposed[k];
            lost l;
            if (strcmp(x->material, flow->material) != 0) continue;
            if (!w->step) w->step = s, w->exposed = x;
            FW_TRY(lost_in(arena, flow, s, x, reach, &l));
            if (l.missing && !w->missing) w->missing = l.missing, w->never = l.never;
            w->loss_m += l.loss_m;
            w->after_m += released ? l.loss_m : 0.0;
            w->uncertainty_m = hypot(w->uncertainty_m, l.u_m);
        }
    }
    return FW_OK;
}

/* Sum over the steps that say <exposed> of the device's own material, losses added, uncertainties in quadrature. Walls stand
   by what they lose from the release on further out when it begins, a, so that its reach is way + a, and a grows with it:
     a = f(way + a),   by Aitken's extrapolation, exact at once where f is linear, as for the law `rate`;
   f' >= 1: the bath takes the device as fast as it frees it, and no reach is enough. Error: 1e-12 relative. Cost: some three
   evaluations of each law. Source: docs/theory/process.md, "What a step takes along". Test: test_wear.c. */
fw_status fw_process_flow_wear(fw_arena *arena, const fw_process_flow *flow, double way_m,
                               fw_process_wear *wear) {
    enum { MOST = 30 };
    const fw_quantity *edge = fw_process_flow_own_quantity(flow, FW_PROCESS_PRINTED_EDGE);
    fw_quantity reach = {.unknown = isnan(way_m),
                         .value = way_m,
                         .uncertainty = edge && !edge->unknown ? edge->uncertainty : 0.0,
                         .dimension = FW_DIM_LENGTH,
                         .unit = "um",
                         .status = FW_DERIVED};
    double a = 0.0;
    for (int i = 0; i < MOST; i++) {
        reach.value = fmax(way_m + a, 0.0);
        FW_TRY(wear_with(arena, flow, &reach, wear));
        const double once = wear->after_m;
        if (reach.unknown || fabs(once - a) <= 1e-12 * fabs(way_m)) return FW_OK;
        reach.value = fmax(way_m + once, 0.0);
        FW_TRY(wear_with(arena, flow, &reach, wear));
        const double first = once - a, second = wear->after_m - once;
        if (fabs(second) >= fabs(first)) break;
        a += first * first / (first - second);
    }
    wear->loss_m = wear->after_m = wear->uncertainty_m = 0.0;
    wear->missing = "a reach that is enough: the device is taken as fast as it is freed";
    wear->never = true;
    return FW_OK;
}

bool fw_process_flow_wears_by_reach(const fw_process_flow *flow) {
    for (int i = 0; flow->material && i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        bool takes = false, reaches = false;
        for (int k = 0; k < s->nexposed; k++)
            takes = takes || strcmp(s->exposed[k].material, flow->material) == 0;
        for (int k = 0; k < s->nargument; k++)
            reaches = reaches || fw_process_release_solves(flow, s->argument[k].q);
        for (int k = 0; k < s->nchange; k++)
            reaches = reaches || fw_process_release_solves(flow, s->change[k].reach);
        if (takes && reaches && fw_process_step_is_wet(s)) return true;
    }
    return false;
}

/* ---- inputs of the verdict ---- */

static void set_range(fw_verdict_fabrication_input *in, const fw_quantity *q) {
    in->q = *q;
    in->nominal = q->value;
    in->sigma = q->uncertainty;
    fw_process_quantity_range(q, &in->low, &in->high);
}

static void scale_range(fw_verdict_fabrication_input *in, double by) {
    in->nominal *= by, in->low *= by, in->high *= by, in->sigma *= by;
}

/* u(z) = (1 - A)(E - z - lag(z)) from every wall at depth z: the edge goes back by the mean of both
   faces, (1 - A)(E - (D + lag)/2), against the m that the mask adds, and one face is left
   2 (1 - A)(D + lag) wider than the other; lag beside the open field, where flexures stand. E, D,
   lag and m are those of the fixed point, so that mask, time and corner cannot differ. A masking
   layer counts with its foot, E - D - lag. D, E m; A 1. Edges are even where (1 - A) edge_m = m.
   Source: docs/theory/etching.md; test_corners.c against fw_process_undercut_widths,
   test_fixed_point.c. */
static bool anisotropy(const fw_process_fixed_point *p, const fw_process_corner *c,
                       fw_verdict_fabrication_input *in) {
    const fw_process_cut *cut = fw_process_fixed_point_cut(p, c->q);
    if (!cut || isnan(cut->etched_m)) return false;
    double field = p->ncls ? p->cls[p->field].opening_m : (double)INFINITY;
    double foot = fw_process_cut_foot(cut, field);
    in->edge_m = cut->device ? 0.5 * (cut->etched_m + foot) : foot;
    in->flare_m = cut->device ? foot - cut->etched_m : 0.0;
    in->drawn = 1.0;
    in->even = in->edge_m > 0.0 ? 1.0 - cut->mask_m / in->edge_m : 1.0;
    in->high = fmin(in->high, 1.0);
    in->nominal = fmin(in->nominal, 1.0);
    return true;
}

/* does an input that is known exactly still make something else than the drawing? */
static bool moves(const fw_verdict_fabrication_input *in) {
    static const double least_m = 1e-15, least = 1e-12; /* rounding */
    double off = in->nominal - in->drawn;
    return fabs(in->edge_m * (in->nominal - in->even)) > least_m ||
           fabs(in->flare_m * off) > least_m || fabs(in->thickness * off) > least ||
           fabs(in->youngs * off) > least;
}

static bool fill(const fw_process_fixed_point *p, const fw_process_corner *c,
                 const fw_mechanism_variant *v, fw_verdict_fabrication_input *in) {
    bool unknown = c->q && c->q->unknown;
    const fw_quantity *q = c->of == FW_CORNER_YOUNGS ? &v->material.youngs
                           : unknown                 ? c->assumed
                                                     : c->q;
    if (!q || q->unknown || !fw_process_corner_counts(c)) return false;
    *in = (fw_verdict_fabrication_input){.name = c->name, .unknown = unknown ? c->q->id : NULL};
    set_range(in, q);
    switch (c->of) {
    case FW_CORNER_EDGE: /* its known part is in the bias of the mask */
        in->edge_m = 1.0;
        in->drawn = in->nominal;
        in->even = unknown ? 0.0 : in->nominal;
        break;
    case FW_CORNER_LOCAL: /* about what all have in common */
        in->local = 1.0;
        in->drawn = in->nominal;
        break;
    case FW_CORNER_TAPER:
        in->flare_m = v->thickness_m;
        break;
    case FW_CORNER_ANISOTROPY:
        if (!anisotropy(p, c, in)) return false;
        break;
    case FW_CORNER_THICKNESS:
        /* the device may ask for another one; what is measured may lie beside what was aimed at */
        scale_range(in, v->thickness_m / (c->aim_m > 0.0 ? c->aim_m : q->value));
        in->thickness = 1.0 / v->thickness_m;
        in->drawn = v->thickness_m;
        break;
    case FW_CORNER_YOUNGS:
        in->youngs = 1.0 / q->value;
        in->drawn = q->value;
        break;
    }
    return in->high > in->low || moves(in);
}

/* what wet steps take of every open face, l: the mask adds the known l at the edges, and the layer
   ends l thinner. Edges move by -(x - l), thickness by -x/t. Test: test_wear.c. */
static bool wear_input(const fw_process_wear *w, const fw_mechanism_variant *v,
                       fw_verdict_fabrication_input *in) {
    if (!(w->loss_m > 0.0) || !(v->thickness_m > 0.0)) return false;
    const fw_quantity *by = w->exposed->rate ? w->exposed->rate : w->exposed->selectivity;
    *in = (fw_verdict_fabrication_input){.name = "wet steps on the device",
                                         .q = {.id = by->id,
                                               .value = w->loss_m,
                                               .uncertainty = w->uncertainty_m,
                                               .dimension = FW_DIM_LENGTH,
                                               .unit = "um",
                                               .status = by->status,
                                               .source = by->source,
                                               .place = w->exposed->place}};
    set_range(in, &in->q);
    in->low = fmax(in->low, 0.0);
    in->edge_m = -1.0;
    in->even = w->loss_m;
    in->thickness = -1.0 / v->thickness_m;
    return true;
}

fw_status fw_process_flow_fabricated(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_process_mask_facts *facts,
                                     const fw_mechanism_variant *variant,
                                     const fw_verdict_fabrication_input **input, int *ninput) {
    fw_verdict_fabrication_input *list =
        fw_arena_array(arena, fw_verdict_fabrication_input, FW_FABRICATION_INPUTS);
    fw_process_fixed_point *edges = fw_arena_one(arena, fw_process_fixed_point);
    FW_NEED(list && edges ? list : NULL);
    FW_TRY(fw_process_fixed_point_solve(arena, flow, facts, variant->thickness_m, edges));
    *ninput = 0;
    for (int i = 0; i < flow->ncorner && *ninput < FW_FABRICATION_INPUTS; i++)
        *ninput += fill(edges, &flow->corner[i], variant, &list[*ninput]);
    if (*ninput < FW_FABRICATION_INPUTS)
        *ninput += wear_input(&edges->wear, variant, &list[*ninput]);
    *input = list;
    return fw_process_corners_independent(arena, list, *ninput);
}
