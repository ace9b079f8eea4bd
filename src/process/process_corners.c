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

enum { EFFECTS = 6 };

static void effects_of(fw_verdict_fabrication_input *in, effect e[EFFECTS]) {
    e[0] = (effect){&in->edge_m, &in->edge_at_m, in->even};
    e[1] = (effect){&in->flare_m, &in->flare_at_m, in->drawn};
    e[2] = (effect){&in->thickness, &in->thickness_at, in->drawn};
    e[3] = (effect){&in->youngs, &in->youngs_at, in->drawn};
    e[4] = (effect){&in->expansion, &in->expansion_at, in->drawn};
    e[5] = (effect){&in->substrate, &in->substrate_at, in->drawn};
}

/* what has one value goes with nothing, and how hinges differ moves nothing that all have in common */
static double correlation(const fw_verdict_fabrication_input *a,
                          const fw_verdict_fabrication_input *b) {
    return a->sigma > 0.0 && b->sigma > 0.0 && a->local == 0.0 && b->local == 0.0
               ? fw_quantity_correlation(&a->q, &b->q)
               : 0.0;
}

/* Cholesky's factor of the correlations; a pivot is held above 1e-6, so that inputs that are fully correlated keep a range
   of a thousandth of their own. false: all are independent */
static bool factor(const fw_verdict_fabrication_input *in, int n,
                   double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    bool any = false;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++) {
            double sum = i == k ? 1.0 : correlation(&in[i], &in[k]);
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
    effect own[EFFECTS], other[EFFECTS];
    effects_of(&in[i], own);
    for (int k = i + 1; k < n; k++) {
        if (L[k][i] == 0.0) continue;
        double part = in[k].sigma * L[k][i] / (in[i].sigma * L[i][i]);
        effects_of(&in[k], other);
        for (int e = 0; e < EFFECTS; e++) {
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

bool fw_process_corner_is_share(fw_process_corner_of of, const fw_quantity *q) {
    return of == FW_CORNER_THICKNESS && q &&
           fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_NONE);
}

static const fw_quantity *quantity(fw_process_pack *pack, const fw_xml_record *e, const char *name,
                                   int of) {
    const fw_xml_attribute *a = fw_process_pack_get(e, name);
    if (!a) return NULL;
    const fw_quantity *q = fw_process_pack_find(pack, a, FW_ID_QUANTITY);
    if (q && !fw_quantity_dimension_equal(q->dimension, kind[of].dimension) &&
        !fw_process_corner_is_share((fw_process_corner_of)of, q))
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
    if (of == FW_CORNER_THICKNESS && layer && c->q != layer && !layer->unknown &&
        !fw_process_corner_is_share(c->of, c->q))
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
    if (pack->flow->ncorner > FW_FLOW_INPUTS)
        fw_diag_error(pack->diags, 260, pack->flow->corner[FW_FLOW_INPUTS].place,
                      "a flow has at most %d corners: join those that move the same edge",
                      FW_FLOW_INPUTS);
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

/* What is made is what is planned times the share x that comes of it: d = x h, h m the thickness that the device is planned
   with, whoever says it; x 1. Then it is a length like any other. Test: test_corners.c thickness_follows_its_plan. */
static void of_planned(fw_verdict_fabrication_input *in, double planned_m) {
    fw_quantity *q = &in->q;
    scale_range(in, planned_m);
    q->value *= planned_m, q->uncertainty *= planned_m, q->low *= planned_m, q->high *= planned_m;
    q->dimension = (fw_quantity_dimension)FW_DIM_LENGTH;
    q->unit = "um";
}

/* u(z) = (1 - A)(E - z - lag(z)) from every wall at depth z: the edge goes back by the mean of both
   faces, (1 - A)(E - (D + lag)/2), against the m that the mask adds, and one face is left
   2 (1 - A)(D + lag) wider than the other; lag beside the open field, where flexures stand. E, D,
   lag and m are those of the fixed point, so that mask, time and corner cannot differ. A masking
   layer counts with its foot, E - D - lag. D, E m; A 1. An unknown lag counts as none: it is open besides. Edges are even where (1 - A) edge_m = m.
   Source: docs/theory/etching.md; test_corners.c against fw_process_undercut_widths,
   test_fixed_point.c. */
static bool anisotropy(const fw_process_fixed_point *p, const fw_process_corner *c,
                       fw_verdict_fabrication_input *in) {
    const fw_process_cut *cut = fw_process_fixed_point_cut(p, c->q);
    if (!cut) return false;
    double field = p->ncls ? p->cls[p->field].opening_m : (double)INFINITY;
    double foot = fw_process_cut_foot(cut, field);
    in->edge_m = cut->device ? 0.5 * (cut->least_m + foot) : foot;
    in->flare_m = cut->device ? foot - cut->least_m : 0.0;
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
    case FW_CORNER_LOCAL: /* about what all have in common, by as much as q may be, either way */
        in->local = 1.0;
        in->high = fmax(fabs(in->low), fabs(in->high));
        in->low = -in->high;
        in->nominal = 0.0;
        break;
    case FW_CORNER_TAPER:
        in->flare_m = v->thickness_m;
        break;
    case FW_CORNER_ANISOTROPY:
        if (!anisotropy(p, c, in)) return false;
        break;
    case FW_CORNER_THICKNESS:
        /* the device may ask for another one; what is measured may lie beside what was aimed at */
        if (fw_process_corner_is_share(c->of, q))
            of_planned(in, v->thickness_m);
        else
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
    fw_process_wear_range(w, &in->low, &in->high);
    in->edge_m = -1.0;
    in->even = w->loss_m;
    in->thickness = -1.0 / v->thickness_m;
    return true;
}

/* ---- thermal expansion, where a scene goes by that of the material ---- */

/* cut out of one wafer, or of one substance: whatever it expands by, both do */
static bool is_of_one(const fw_quantity *a, const fw_quantity *b) {
    return !a->unknown && !b->unknown && a->value == b->value && a->uncertainty == b->uncertainty;
}

static bool expansion_input(const fw_quantity *q, const char *name, bool substrate,
                            fw_verdict_fabrication_input *in) {
    *in = (fw_verdict_fabrication_input){.name = name};
    set_range(in, q);
    in->drawn = q->value;
    *(substrate ? &in->substrate : &in->expansion) = 1.0;
    return in->high > in->low;
}

/* Both are known to some part alone, and their difference is less. A scene that states them has them so. Test:
   test_corners.c */
static int expansions(const fw_mechanism_variant *v, fw_verdict_fabrication_input *list, int room) {
    const fw_quantity *layer = &v->material.expansion, *substrate = &v->substrate_expansion;
    int n = 0;
    if (v->heated_layer && v->heated_substrate && is_of_one(layer, substrate)) return 0;
    if (v->heated_layer && !layer->unknown && n < room)
        n += expansion_input(layer, "thermal expansion", false, &list[n]);
    if (v->heated_substrate && !substrate->unknown && n < room)
        n += expansion_input(substrate, "thermal expansion of the substrate", true, &list[n]);
    return n;
}

/* ---- what nobody knows, and nothing is assumed of ----
   A corner whose quantity is unknown and has no assumed range, a quantity that FW-D665 wants a corner for, a lag that the
   time of a cut needs, the depth of an isotropic etch: each moves what is made by nobody knows how much. It stands among
   the inputs, moves nothing, and holds the verdict open. Test: test_corners.c, what_nobody_knows */

static void add_open(const char *name, const fw_quantity *q, fw_place place,
                     fw_verdict_fabrication_input *list, int *n) {
    const char *id = q && q->id ? q->id : name;
    for (int i = 0; i < *n; i++)
        if (list[i].open && strcmp(list[i].unknown, id) == 0) return;
    if (*n == FW_FABRICATION_INPUTS)
        return; /* others are open; the flow's own judgement names all */
    list[*n] = (fw_verdict_fabrication_input){.name = name, .unknown = id, .open = true};
    if (q) list[*n].q = *q;
    list[*n].q.value = list[*n].q.uncertainty = 0.0;
    if (!list[*n].q.place.file) list[*n].q.place = place;
    ++*n;
}

static bool is_uncertain(const fw_quantity *q) {
    return q->unknown || q->uncertainty > 0.0;
}

static bool has_corner(const fw_process_flow *f, const fw_quantity *q) {
    for (int i = 0; i < f->ncorner; i++)
        if (f->corner[i].q == q || f->corner[i].assumed == q || f->corner[i].within == q)
            return true;
    return false;
}

static bool has_corner_of(const fw_process_flow *f, fw_process_corner_of of, bool etched) {
    for (int i = 0; i < f->ncorner; i++)
        if (f->corner[i].of == of && (!etched || f->corner[i].etched)) return true;
    return false;
}

/* by what q moves the device though no corner has it, and which corner would; NULL: it does not */
static const char *moves_without(const fw_process_flow *f, const fw_quantity *q,
                                 const char **corner) {
    static const char made[] = "made.";
    if (!q->id || !is_uncertain(q) || has_corner(f, q)) return NULL;
    const bool edge = strcmp(q->id, FW_PROCESS_PRINTED_EDGE) == 0,
               thick = q == f->thickness && !has_corner_of(f, FW_CORNER_THICKNESS, false),
               other = strncmp(q->id, made, strlen(made)) == 0;
    *corner = edge ? "edge" : other ? "..." : "thickness";
    return edge    ? "moves every edge that is printed"
           : other ? "says how the device is made"
           : thick ? "is the thickness of the device's layer"
                   : NULL;
}

static bool nothing_assumed(const fw_process_corner *c) {
    return c->q && c->q->unknown && (!c->assumed || c->assumed->unknown);
}

static void open_inputs(const fw_process_flow *flow, const fw_process_fixed_point *p,
                        fw_verdict_fabrication_input *list, int *n) {
    for (int i = 0; i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        if (!nothing_assumed(c) || !fw_process_corner_counts(c)) continue;
        if (c->of != FW_CORNER_ANISOTROPY || fw_process_fixed_point_cut(p, c->q))
            add_open(c->name, c->q, c->place, list, n);
    }
    for (int k = 0; k < p->ncut; k++) {
        const fw_process_cut *c = &p->cut[k];
        const bool lag = isnan(c->lag_value) || !c->lag_quantity;
        if (isnan(c->low)) add_open("anisotropy", c->quantity, c->step->place, list, n);
        if (isnan(c->etched_m))
            add_open(lag ? "lag of narrow openings" : "opening that an etch is timed by",
                     lag ? c->lag_quantity : fw_process_step_argument(c->step, "width"),
                     c->step->place, list, n);
    }
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            if (c->isotropic && c->thickness && c->thickness->unknown &&
                fw_process_where_is_of_device(flow, c->where))
                add_open("depth of an isotropic etch", c->thickness, c->place, list, n);
        }
    for (int i = 0; i < flow->nquantity; i++) {
        const fw_quantity *q = flow->quantity[i];
        const char *corner;
        if (q->unknown && moves_without(flow, q, &corner)) add_open(q->id, q, q->place, list, n);
    }
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
    for (int i = 0; i < flow->ncorner && *ninput < FW_FLOW_INPUTS; i++)
        *ninput += fill(edges, &flow->corner[i], variant, &list[*ninput]);
    if (*ninput < FW_FLOW_INPUTS) *ninput += wear_input(&edges->wear, variant, &list[*ninput]);
    *ninput += expansions(variant, list + *ninput, FW_RANGED_INPUTS - *ninput);
    *input = list;
    FW_TRY(fw_process_corners_independent(arena, list, *ninput));
    open_inputs(flow, edges, list, ninput);
    return FW_OK;
}

/* ---- do corners move what is made? ----
   A corner is what the verdict looks at the ends of. One that names what the device is not made by is dropped there, and
   what is uncertain and has none is taken for exact: both accept what is not known. Test: test_corners.c. */

/* the change by whose anisotropy q the device is cut, or what masks it; any where q is NULL */
static const fw_process_change *cut_by(const fw_process_flow *f, const fw_quantity *q,
                                       const fw_process_step **by) {
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (!c->anisotropy || (q && c->anisotropy != q) ||
                !fw_process_where_is_of_device(f, c->where))
                continue;
            *by = &f->step[i];
            return c;
        }
    return NULL;
}

/* the step that sets q, is timed with it, or makes a layer so thick */
static const fw_process_step *taken_by(const fw_process_flow *f, const fw_quantity *q) {
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        bool takes = fw_process_step_sets(s, q);
        for (int k = 0; k < s->nargument; k++)
            takes = takes || s->argument[k].q == q;
        for (int k = 0; k < s->nchange; k++)
            takes = takes || s->change[k].thickness == q;
        if (takes) return s;
    }
    return NULL;
}

/* the step that makes another layer than the device's so thick; NULL: none does */
static const fw_process_step *of_another(const fw_process_flow *f, const fw_quantity *q) {
    for (int i = 0; i < f->nstep && q != f->thickness; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            if (f->step[i].change[k].thickness == q && f->material &&
                strcmp(f->step[i].change[k].material, f->material) != 0)
                return &f->step[i];
    return NULL;
}

static void lint_corner(fw_process_pack *pack, const fw_process_corner *c) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = NULL;
    const fw_process_change *cut;
    switch (c->of) {
    case FW_CORNER_ANISOTROPY:
        if (!c->q || cut_by(f, c->q, &s)) return;
        cut = cut_by(f, NULL, &s);
        fw_diag_error(pack->diags, 664, c->place,
                      "the corner '%s' names '%s', by which no step cuts the device: it moves "
                      "nothing%s%s%s%s%s",
                      c->name, c->q->id, cut ? "; step " : "; leave it out", cut ? s->id : "",
                      cut ? " cuts it with '" : "", cut ? cut->anisotropy->id : "", cut ? "'" : "");
        return;
    case FW_CORNER_THICKNESS:
        if (c->q && (s = of_another(f, c->q)))
            fw_diag_error(pack->diags, 664, c->place,
                          "the corner '%s' names '%s', which is the thickness of another layer "
                          "(step %s): it says nothing of the device's, '%s'",
                          c->name, c->q->id, s->id, f->thickness ? f->thickness->id : "");
        return;
    case FW_CORNER_EDGE:
    case FW_CORNER_LOCAL:
    case FW_CORNER_TAPER:
        if (c->q && (s = taken_by(f, c->q)))
            fw_diag_error(pack->diags, 664, c->place,
                          "the corner '%s' names '%s', with which step %s works: it is not where "
                          "an edge or a wall comes out; name what is measured of that, as '%s'",
                          c->name, c->q->id, s->id, FW_PROCESS_PRINTED_EDGE);
        return;
    case FW_CORNER_YOUNGS:
        return;
    }
}

static void lint_lacking(fw_process_pack *pack, const fw_quantity *q, fw_place place,
                         const char *moves, const char *corner) {
    fw_diag_warning(pack->diags, 665, place,
                    "'%s' is not known%s and %s, but no corner has it: %s; add <corner "
                    "of=\"%s\" .../>",
                    q->id, q->unknown ? "" : " exactly", moves,
                    q->unknown ? "nobody knows what is made" : "the verdict takes it for exact",
                    corner);
}

/* ... and what of a step moves edges */
static void lint_moving(fw_process_pack *pack, const fw_process_step *s,
                        const fw_process_change *c) {
    const fw_process_flow *f = pack->flow;
    if (!fw_process_where_is_of_device(f, c->where)) return;
    if (c->anisotropy && is_uncertain(c->anisotropy) && !has_corner(f, c->anisotropy))
        lint_lacking(pack, c->anisotropy, c->place, "moves the walls of the device", "anisotropy");
    const fw_quantity *rate = fw_process_step_argument(s, "rate");
    if (c->isotropic && rate && is_uncertain(rate) && !has_corner_of(f, FW_CORNER_EDGE, true))
        lint_lacking(pack, rate, c->place, "moves every edge as far sideways as down",
                     "edge\" etched=\"yes");
}

fw_status fw_process_lint_corners(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->ncorner; i++)
        lint_corner(pack, &f->corner[i]);
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            lint_moving(pack, &f->step[i], &f->step[i].change[k]);
    for (int i = 0; i < f->nquantity; i++) {
        const char *corner, *moves = moves_without(f, f->quantity[i], &corner);
        if (moves) lint_lacking(pack, f->quantity[i], f->quantity[i]->place, moves, corner);
    }
    return FW_OK;
}
