/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be read, and how exactly: the rows that a laboratory is meant to get from each coupon, at the
   flow's own values, go through calibrate itself; what comes out has the uncertainty that the real rows
   will give. And the flow with one of them as it would be after that. At the end: whether what the steps of a flow measure is
   there. */
#include "base/constants.h"
#include "base/text.h"
#include "process/calibrate.h"
#include "process/coupon.h"
#include "process/films.h"
#include "process/pack.h"
#include <ctype.h>
#include <math.h>
#include <string.h>

enum { ROWS = 64, READINGS = 32 };

/* how exactly one reading is made: standard uncertainties of the pack, SI */
typedef struct meant {
    fw_arena *arena;
    const fw_process_flow *flow;
    double width_m, depth_m, step_m, time_s;
    fw_process_measurement row[ROWS];
    int n;
} meant;

static double known(const fw_process_flow *flow, const char *id) {
    const fw_quantity *q = fw_process_flow_quantity(flow, id);
    double value;
    return q && fw_process_flow_nominal(flow, q, &value) ? value : (double)NAN;
}

static double value_of(const meant *m, const fw_quantity *q) {
    return q ? known(m->flow, q->id) : (double)NAN;
}

/* a row whose value or condition is not a number reads nothing: the flow lacks what it follows from */
static void add(meant *m, fw_process_measurement row) {
    bool bare = isnan(row.at);
    if (m->n == ROWS || !(row.uncertainty > 0.0) || !isfinite(row.value) ||
        (!bare && !(row.at > 0.0)))
        return;
    m->row[m->n++] = row;
}

static fw_process_measurement lengths(const char *coupon, const char *feature, double drawn_m,
                                      double value, double uncertainty) {
    return (fw_process_measurement){.coupon = coupon,
                                    .feature = feature,
                                    .drawn_m = drawn_m,
                                    .value = value,
                                    .uncertainty = uncertainty,
                                    .at = (double)NAN,
                                    .dimension = FW_DIM_LENGTH};
}

/* ---- the rows of each coupon: sizes are those of the patterns in masks/ ---- */

static const double cd_um[] = {4, 6, 10}, slot_um[] = {4, 5, 7, 10, 20, 50, 100},
                    line_um[] = {10, 12, 16, 20, 24}, pad_um[] = {10, 30, 100, 300};

/* where an edge stands against the mask: coupon_kinds.c */
static void of_lines(meant *m) {
    const char *edge = fw_process_coupon_edge(m->flow);
    bool printed = strcmp(edge, FW_PROCESS_PRINTED_EDGE) == 0;
    double e = known(m->flow, edge) - (printed ? 0.0 : fw_process_coupon_loss(m->flow));
    for (size_t i = 0; i < sizeof cd_um / sizeof cd_um[0]; i++) {
        double w = cd_um[i] * 1e-6;
        add(m, lengths("cd-lines", "line", w, w + 2.0 * e, m->width_m));
        add(m, lengths("cd-lines", "space", w, w - 2.0 * e, m->width_m));
    }
}

/* depths after 0.9 of the time of wide openings, before the etch is through: to first order in the lag
   D = R t - S J(w, R t), which moves no uncertainty of the fit by as much as the readings do */
static void of_slots(meant *m) {
    fw_process_etch etch = fw_process_flow_etch(m->flow);
    double R = value_of(m, etch.rate), S = value_of(m, etch.lag);
    double D = m->flow->thickness ? 0.9 * known(m->flow, m->flow->thickness->id) : (double)NAN;
    for (size_t i = 0; i < sizeof slot_um / sizeof slot_um[0]; i++) {
        double w = slot_um[i] * 1e-6, depth = D;
        for (int k = 0; k < 40 && isfinite(depth); k++) /* contracts by S (1/K - 1) */
            depth = D - S * fw_process_arde_integral(w, depth, false);
        fw_process_measurement row = lengths("arde-slots", "", w, depth, m->depth_m);
        row.at = D / R;
        row.at_uncertainty = m->time_s;
        row.at_dimension = (fw_quantity_dimension)FW_DIM_TIME;
        add(m, row);
    }
}

/* tops of lines that stand, once the device layer is through with the over-etch: coupon_kinds.c */
static void of_ladder(meant *m) {
    fw_process_etch etch = fw_process_flow_etch(m->flow);
    double A = value_of(m, etch.anisotropy), over = value_of(m, etch.over_etch);
    double D = m->flow->thickness ? known(m->flow, m->flow->thickness->id) : (double)NAN;
    double E = D * (1.0 + (isnan(over) ? 0.0 : over)),
           edge = known(m->flow, fw_process_coupon_edge(m->flow));
    double lost = fw_process_coupon_loss(m->flow) - (isnan(edge) ? 0.0 : edge) + (1.0 - A) * E;
    for (size_t i = 0; i < sizeof line_um / sizeof line_um[0]; i++) {
        double w = line_um[i] * 1e-6;
        fw_process_measurement row =
            lengths("undercut-ladder", "width", w, w - 2.0 * lost, m->width_m);
        row.at = E;
        row.at_uncertainty = m->depth_m;
        row.at_dimension = (fw_quantity_dimension)FW_DIM_LENGTH;
        if (row.value > 0.0) add(m, row);
    }
}

static void of_mask_step(meant *m) {
    double S = value_of(m, fw_process_flow_etch(m->flow).selectivity);
    double D = m->flow->thickness ? known(m->flow, m->flow->thickness->id) : (double)NAN;
    fw_process_measurement row = lengths("al-step", "", (double)NAN, D / S, m->step_m);
    row.at = D;
    row.at_uncertainty = m->depth_m;
    row.at_dimension = (fw_quantity_dimension)FW_DIM_LENGTH;
    if (isfinite(D)) add(m, row);
}

/* the planned thickness at the planned charge per area; narrow pads as thick as flexures come out */
static void of_pads(meant *m) {
    double d = known(m->flow, "cu.d"), made = known(m->flow, "made.cu"),
           q = d * known(m->flow, "cu.n") * FW_FARADAY_C_PER_mol * known(m->flow, "cu.rho") /
               (known(m->flow, "cu.eta") * known(m->flow, "cu.M"));
    for (size_t i = 0; i < sizeof pad_um / sizeof pad_um[0]; i++) {
        bool narrow = pad_um[i] <= 30.0 && isfinite(made);
        fw_process_measurement row =
            lengths("plating-pads", "", pad_um[i] * 1e-6, narrow ? made : d, m->step_m);
        row.at = q;
        row.at_uncertainty = 0.0;
        row.at_dimension = (fw_quantity_dimension)FW_DIM(-2, 0, 1, 1, 0, 0, 0);
        if (isfinite(q)) add(m, row);
    }
}

/* Half of the film of a step whose time is thickness over rate, timed and measured: once a rate. A rate
   that goes with no film, as that of a bake, is a rule and nothing to read. */
static void of_rates(meant *m) {
    for (int i = 0; i < m->flow->nstep; i++) {
        const fw_process_step *s = &m->flow->step[i];
        const fw_quantity *rate = fw_process_step_argument(s, "rate"), *film = NULL,
                          *thickness = fw_process_step_argument(s, "thickness");
        for (int c = 0; c < s->nchange; c++)
            if (thickness && s->change[c].thickness == thickness) film = thickness;
        bool again = false;
        for (int k = 0; rate && k < m->n; k++)
            again = again || strcmp(m->row[k].feature, rate->id) == 0;
        if (!rate || !film || rate->unknown || film->unknown || again) continue;
        double d = 0.5 * film->value;
        fw_process_measurement row = lengths("etch-rate", rate->id, (double)NAN, d, m->step_m);
        row.at = d / rate->value;
        row.at_uncertainty = m->time_s;
        row.at_dimension = (fw_quantity_dimension)FW_DIM_TIME;
        add(m, row);
    }
}

/* a coupon, and those whose result its own law takes; in the order of coupons.def */
static const struct {
    const char *coupon, *with;
    void (*before)(meant *m), (*rows)(meant *m);
} table[] = {
    {"cd-lines", NULL, NULL, of_lines},    {"etch-rate", NULL, NULL, of_rates},
    {"arde-slots", NULL, NULL, of_slots},  {"undercut-ladder", "cd-lines", of_lines, of_ladder},
    {"al-step", NULL, NULL, of_mask_step}, {"plating-pads", NULL, NULL, of_pads},
};
enum { KINDS = sizeof table / sizeof table[0] };

/* ---- through calibrate ---- */

static bool is_listed(const fw_process_measurable *list, int n, const char *id) {
    return fw_process_measurable_of(list, n, id) != NULL;
}

static fw_status read_coupon(meant *m, int kind, fw_process_measurable *list, int *n) {
    fw_process_calibration found = {0};
    fw_diags quiet = fw_diags_new(m->arena); /* a coupon that this flow cannot have reads nothing */
    m->n = 0;
    if (table[kind].before) table[kind].before(m);
    int first = m->n;
    table[kind].rows(m);
    if (m->n == first) return FW_OK;
    fw_status status = fw_process_calibrate(m->arena, m->flow, m->row, m->n, &quiet, &found);
    if (status == FW_NOMEM) return status;
    for (int i = 0; status == FW_OK && i < found.count; i++) {
        const fw_process_calibrated *c = &found.item[i];
        if (strcmp(c->coupon, table[kind].coupon) != 0 || is_listed(list, *n, c->id)) continue;
        if (*n == READINGS) return FW_LIMIT;
        fw_process_measurable *r = &list[(*n)++];
        *r = (fw_process_measurable){.id = c->id, .uncertainty = c->uncertainty, .coupon = true};
        FW_NEED(r->by = fw_arena_printf(m->arena, "coupon %s%s%s", c->coupon,
                                        table[kind].with ? ", with " : "",
                                        table[kind].with ? table[kind].with : ""));
    }
    return FW_OK;
}

/* read.ID */
static fw_status read_instrument(const fw_process_flow *flow, const fw_quantity *how,
                                 fw_process_measurable *list, int *n) {
    const char *id = how->id + strlen(FW_PROCESS_READ);
    const fw_quantity *q = fw_process_flow_quantity(flow, id);
    double value;
    if (!q || how->unknown || is_listed(list, *n, id)) return FW_OK;
    bool same = fw_quantity_dimension_equal(q->dimension, how->dimension);
    bool pure = fw_quantity_dimension_equal(how->dimension, (fw_quantity_dimension)FW_DIM_NONE);
    if (!same && (!pure || !fw_process_flow_nominal(flow, q, &value))) return FW_OK;
    if (*n == READINGS) return FW_LIMIT;
    list[(*n)++] =
        (fw_process_measurable){.id = id,
                                .uncertainty = same ? how->value : how->value * fabs(value),
                                .by = how->note ? how->note : how->source};
    return FW_OK;
}

const fw_process_measurable *fw_process_measurable_of(const fw_process_measurable *reading, int n,
                                                      const char *id) {
    for (int i = 0; i < n; i++)
        if (strcmp(reading[i].id, id) == 0) return &reading[i];
    return NULL;
}

fw_status fw_process_measurables(fw_arena *arena, const fw_process_flow *flow,
                                 const fw_process_measurable **reading, int *n) {
    fw_process_measurable *list = fw_arena_array(arena, fw_process_measurable, READINGS);
    meant *m = fw_arena_one(arena, meant);
    FW_NEED(list && m ? list : NULL);
    *m = (meant){.arena = arena,
                 .flow = flow,
                 .width_m = known(flow, FW_PROCESS_READ "width"),
                 .depth_m = known(flow, FW_PROCESS_READ "depth"),
                 .step_m = known(flow, FW_PROCESS_READ "step"),
                 .time_s = known(flow, FW_PROCESS_READ "time")};
    *n = 0;
    for (int i = 0; i < KINDS; i++)
        FW_TRY(read_coupon(m, i, list, n));
    size_t prefix = strlen(FW_PROCESS_READ);
    for (int i = flow->nquantity - 1; i >= 0; i--) /* the flow's own before the shared ones */
        if (flow->quantity[i]->id && strncmp(flow->quantity[i]->id, FW_PROCESS_READ, prefix) == 0)
            FW_TRY(read_instrument(flow, flow->quantity[i], list, n));
    *reading = list;
    return FW_OK;
}

/* ---- what counts in a flow whose quantity a laboratory has measured ---- */

static bool among(const fw_process_argument *argument, int n, const fw_quantity *q) {
    for (int i = 0; i < n; i++)
        if (argument[i].q == q) return true;
    return false;
}

/* of a time that is computed: a time that is handed on as it is stated has no inputs to measure */
static bool step_takes(const fw_process_step *s, const fw_quantity *q) {
    const fw_process_law *law = fw_process_law_find(s->law);
    bool computes = law && !law->stated;
    if (computes && (among(s->argument, s->nargument, q) || among(s->need, s->nneed, q)))
        return true;
    for (int i = 0; i < s->nderive; i++) /* what is derived under an id is an input of others */
        if (s->derive[i].q && among(s->derive[i].argument, s->derive[i].nargument, q)) return true;
    for (int i = 0; i < s->nexposed; i++)
        if (s->exposed[i].rate == q || s->exposed[i].selectivity == q) return true;
    for (int i = 0; i < s->nchange; i++)
        if (s->change[i].anisotropy == q || s->change[i].reach == q) return true;
    return false;
}

bool fw_process_flow_takes(const fw_process_flow *flow, const fw_quantity *q) {
    if (!q->id || fw_process_quantity_computed(q) ||
        strncmp(q->id, FW_PROCESS_READ, strlen(FW_PROCESS_READ)) == 0)
        return false;
    for (int i = 0; i < flow->ncorner; i++)
        if (flow->corner[i].q == q) return true;
    for (int i = 0; i < flow->nstep; i++)
        if (step_takes(&flow->step[i], q)) return true;
    return false;
}

bool fw_process_flow_nominal(const fw_process_flow *flow, const fw_quantity *q, double *value) {
    for (int i = 0; q->unknown && i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        if (c->q != q || !c->assumed || c->assumed->unknown) continue;
        *value = c->assumed->value;
        return true;
    }
    *value = q->value;
    return !q->unknown;
}

/* ---- a flow with one quantity as it would then be, for a while ---- */

/* as fw_process_lab_apply leaves it */
static fw_quantity *replace(fw_process_flow *flow, const fw_process_with *with, fw_quantity *was) {
    fw_quantity *q = with->id ? fw_process_flow_own_quantity(flow, with->id) : NULL;
    if (!q) return NULL;
    *was = *q;
    q->value = with->value;
    q->uncertainty = with->uncertainty;
    q->unknown = q->interval = false;
    q->replaced = true;
    q->status = q->u_status = FW_MEASURED;
    return q;
}

/* how uncertain the edges of corners are, which may follow from what is replaced */
static void keep_edges(const fw_process_flow *flow, double u[FW_FABRICATION_INPUTS]) {
    for (int i = 0; i < flow->ncorner; i++)
        u[i] = flow->corner[i].q ? flow->corner[i].q->uncertainty : 0.0;
}

static void return_edges(fw_process_flow *flow, const double u[FW_FABRICATION_INPUTS]) {
    for (int i = 0; i < flow->ncorner; i++)
        if (flow->corner[i].etched && flow->corner[i].q)
            fw_process_flow_own_quantity(flow, flow->corner[i].q->id)->uncertainty = u[i];
}

fw_status fw_process_flow_fabricated_with(fw_arena *arena, fw_process_flow *flow,
                                          const fw_process_with *with,
                                          const fw_process_mask_facts *facts,
                                          const fw_mechanism_variant *variant,
                                          const fw_verdict_fabrication_input **input, int *ninput) {
    double edge[FW_FABRICATION_INPUTS];
    keep_edges(flow, edge);
    fw_quantity was, *q = replace(flow, with, &was);
    fw_status status = q ? fw_process_corners_follow(arena, flow) : FW_OK;
    if (status == FW_OK)
        status = fw_process_flow_fabricated(arena, flow, facts, variant, input, ninput);
    return_edges(flow, edge);
    if (q) *q = was;
    return status;
}

fw_status fw_process_flow_times_with(fw_arena *arena, fw_process_flow *flow,
                                     const fw_process_with *with,
                                     const fw_process_mask_facts *facts, fw_process_time *time) {
    fw_quantity was, *q = replace(flow, with, &was);
    fw_diags quiet = fw_diags_new(arena);
    fw_status status = fw_process_flow_compute_once(arena, flow, facts, &quiet);
    if (q) *q = was;
    FW_TRY(status);
    for (int i = 0; i < flow->nstep; i++)
        time[i] = flow->step[i].time;
    return FW_OK;
}

/* ---- is what is measured there? ----
   A film is on the wafer before a step, or after it, where any column has it. What is read of another piece (a witness, a
   dummy) and what is counted to be none (residue) needs it not. Test: test_measured.c. */

/* its layers before and after a step */
typedef struct around {
    fw_process_stack before, after;
} around;

static fw_status around_step(fw_process_pack *pack, int at, around *a) {
    FW_TRY(fw_process_flow_stack(pack->arena, pack->flow, at - 1, &a->before, NULL));
    return fw_process_flow_stack(pack->arena, pack->flow, at, &a->after, NULL);
}

static bool holds(const fw_process_stack *stack, const char *material) {
    for (int column = 0; column < stack->columns; column++)
        if (fw_process_stack_holds(stack, column, material)) return true;
    return false;
}

static bool is_around(const around *a, const char *material) {
    return holds(&a->before, material) || holds(&a->after, material);
}

/* some of its columns have it, and some have not: it has an edge there. NULL: any two columns are unlike, a hollow in one */
static bool has_edge(const fw_process_stack *stack, const char *material) {
    bool with = false, bare = false;
    for (int column = 0; column < stack->columns; column++) {
        bool there = material && fw_process_stack_holds(stack, column, material);
        with = with || there;
        bare = bare || (material && !there);
        with = with || (!material && stack->n[column] != stack->n[0]);
        for (int i = 0; !material && !with && i < stack->n[column]; i++) {
            const fw_process_cell *c = &stack->cell[column][i], *first = &stack->cell[0][i];
            with = strcmp(c->material, first->material) != 0 || c->height < first->height ||
                   c->height > first->height;
        }
    }
    return with && (bare || !material);
}

static bool edge_around(const around *a, const char *material) {
    return has_edge(&a->before, material) || has_edge(&a->after, material);
}

/* the film whose thickness q is, and that comes on at step *when first; NULL: q is none, or one of several */
static const char *film_of(const fw_process_flow *f, const fw_quantity *q, int *when) {
    const char *material = NULL;
    for (int i = 0; q && i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (c->thickness != q || strcmp(c->kind, "remove") == 0) continue;
            if (material && strcmp(material, c->material) != 0) return NULL;
            if (!material) *when = i;
            material = c->material;
        }
    return material;
}

/* a wafer that is bonded on or mounted later is looked at as it comes in */
static bool comes_in_later(const fw_process_flow *f, int at, int when) {
    return when > at && (fw_process_step_is_op(&f->step[when], "bond") ||
                         fw_process_step_is_op(&f->step[when], "mount"));
}

static void lint_film(fw_process_pack *pack, int at, const around *a, const fw_quantity *q,
                      const char *does) {
    const fw_process_flow *f = pack->flow;
    int when = -1;
    const char *material = film_of(f, q, &when);
    if (!material || is_around(a, material) || comes_in_later(f, at, when)) return;
    fw_diag_error(pack->diags, 623, f->step[at].place,
                  "step %s %s %s, the thickness of '%s', and there is none on the wafer %s: do it "
                  "while that is there, or leave it out",
                  f->step[at].id, does, q->id, material, when > at ? "yet" : "any more");
}

/* q is how deep a later step etches, and nothing else; NULL: it is not */
static const fw_process_step *etched_later(const fw_process_flow *f, int at, const fw_quantity *q) {
    const fw_process_step *first = NULL;
    for (int i = 0; q && i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            if (f->step[i].change[k].thickness != q) continue;
            if (i <= at || strcmp(f->step[i].change[k].kind, "remove") != 0) return NULL;
            if (!first) first = &f->step[i];
        }
    return first;
}

/* What works without a change works on what is there: a device that is cut, where it is freed or driven; a coat, where its
   rim is stripped. */
static void lint_bare(fw_process_pack *pack, const fw_process_step *s, const around *a) {
    const fw_process_flow *f = pack->flow;
    bool coat = false;
    if (s->nchange > 0) return;
    if ((s->bears || fw_process_step_is_op(s, "release")) && f->material &&
        !has_edge(&a->before, f->material))
        fw_diag_error(pack->diags, 623, s->place,
                      "step %s %s the device, and '%s' is not cut there; do it after the step that "
                      "cuts it",
                      s->id, s->bears ? "drives" : "frees", f->material);
    if (!fw_process_step_is_op(s, "strip")) return;
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            coat = coat || (fw_process_step_is_op(&f->step[i], "coat") &&
                            holds(&a->before, f->step[i].change[k].material));
    if (!coat)
        fw_diag_error(
            pack->diags, 623, s->place,
            "step %s strips, and there is no coat on the wafer; do it while there is one, "
            "or say by a <change> what it takes off",
            s->id);
}

/* the quantity of a limit "{=al.d*0.95}"; NULL: it names none */
static const fw_quantity *limit_of(const fw_process_flow *f, const char *const *limit) {
    for (int i = 0; i < f->ntext; i++) {
        char id[FW_LABEL];
        const char *raw = f->text[i].raw;
        if (f->text[i].slot != (const char **)limit || strncmp(raw, "{=", 2) != 0) continue;
        const size_t n = strcspn(raw + 2, "*}");
        if (n >= sizeof id) continue;
        memcpy(id, raw + 2, n);
        id[n] = '\0';
        return fw_process_flow_quantity(f, id);
    }
    return NULL;
}

static bool is_word_in(const char *text, const char *word) {
    const size_t n = strlen(word);
    for (const char *p = text; n > 0 && (p = strstr(p, word)); p++)
        if ((p == text || !isalnum((unsigned char)p[-1])) && !isalnum((unsigned char)p[n]))
            return true;
    return false;
}

/* the material that a measurement names, by its id or its name; NULL: none */
static const char *named_in(const fw_process_flow *f, const char *measure) {
    for (int i = 0; i < f->nprocess_material; i++) {
        const fw_process_material *m = &f->process_material[i];
        if (is_word_in(measure, m->id) || is_word_in(measure, m->name)) return m->id;
    }
    return NULL;
}

static bool is_elsewhere(const fw_process_accept *a) {
    return strstr(a->measure, "witness") || strstr(a->measure, "dummy");
}

static bool counts_none(const fw_process_accept *a) {
    double high;
    return !a->low[0] && fw_number_parse(a->high, strlen(a->high), &high) && !(high > 0.0);
}

/* does the step make a layer that a probe can stand on? Wafers come in with the first look, or are bonded and mounted */
static bool makes(const fw_process_step *s, const char *material) {
    static const char none[] = "inspect bond mount coat";
    for (int k = 0; k < s->nchange && !fw_words_hold(none, " ", s->op); k++)
        if (strcmp(s->change[k].kind, "remove") != 0 &&
            strcmp(s->change[k].material, material) == 0)
            return true;
    return false;
}

/* does a layer that was made lie open everywhere? */
static bool layer_on_top(const fw_process_flow *f, const fw_process_stack *stack) {
    bool all = stack->columns > 0;
    for (int column = 0; column < stack->columns; column++) {
        const fw_process_cell *top = fw_process_stack_top(stack, column, false);
        bool made = false;
        for (int i = 0; top && i < f->nstep; i++)
            made = made || makes(&f->step[i], top->material);
        all = all && made;
    }
    return all;
}

/* what a width is read at: an edge of what is named, of the device where a flexure is, or of anything */
static void lint_width(fw_process_pack *pack, const fw_process_step *s, const around *wafer,
                       const fw_process_accept *a, const char *named) {
    const fw_process_flow *f = pack->flow;
    const char *of = named || !is_word_in(a->measure, "flexure") ? named : f->material;
    if (edge_around(wafer, of)) return;
    fw_diag_error(pack->diags, 624, a->place,
                  "step %s measures '%s', and %s has an edge there; measure it after the step that "
                  "opens it",
                  s->id, a->measure, of ? "nothing of it" : "nothing on the wafer");
}

/* these patterns are of the device's layer, and every pattern is of a layer that was opened */
static void lint_coupon(fw_process_pack *pack, const fw_process_step *s, const around *wafer,
                        const fw_process_accept *a) {
    static const char device[] = "slots ladder cantilevers break-beams";
    const char *of = fw_words_hold(device, " ", a->coupon) ? pack->flow->material : NULL;
    if (!a->coupon[0] || edge_around(wafer, of)) return;
    fw_diag_error(pack->diags, 624, a->place,
                  "step %s looks at the coupon '%s', and '%s' is not patterned there; look after "
                  "the step that opens it",
                  s->id, a->coupon, of ? of : "the wafer");
}

static void lint_read(fw_process_pack *pack, const fw_process_step *s, const around *wafer,
                      const fw_process_accept *a) {
    const fw_process_flow *f = pack->flow;
    const char *named = named_in(f, a->measure);
    if (named && (a->low[0] || a->high[0]) && !is_around(wafer, named))
        fw_diag_error(pack->diags, 624, a->place,
                      "step %s measures '%s', and there is no '%s' on the wafer, before it or "
                      "after; measure it while it is there",
                      s->id, a->measure, named);
    else if (is_word_in(a->measure, "width"))
        lint_width(pack, s, wafer, a, named);
    else if (is_word_in(a->measure, "step height") && !edge_around(wafer, NULL))
        fw_diag_error(pack->diags, 624, a->place,
                      "step %s measures '%s', and the wafer has no step: every layer covers all of "
                      "it; measure it on a witness, or after a layer was opened",
                      s->id, a->measure);
    else if (is_word_in(a->measure, "sheet resistance") && !layer_on_top(f, &wafer->before) &&
             !layer_on_top(f, &wafer->after))
        fw_diag_warning(pack->diags, 624, a->place,
                        "step %s measures '%s', and no layer that a step has put on lies open: it "
                        "is the wafer's own; measure it after the layer, or remove it",
                        s->id, a->measure);
}

fw_status fw_process_lint_measured(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    for (int i = 0; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        around wafer;
        FW_TRY(around_step(pack, i, &wafer));
        lint_bare(pack, s, &wafer);
        for (int k = 0; k < s->nargument; k++)
            if (strcmp(s->argument[k].name, "thickness") == 0)
                lint_film(pack, i, &wafer, s->argument[k].q, "is timed for");
        for (int k = 0; k < s->naccept; k++) {
            const fw_process_accept *a = &s->accept[k];
            lint_coupon(pack, s, &wafer, a);
            if (is_elsewhere(a) || counts_none(a)) continue;
            const fw_quantity *low = limit_of(f, &a->low), *q = low ? low : limit_of(f, &a->high);
            lint_film(pack, i, &wafer, q, "accepts a wafer by");
            const fw_process_step *etch = etched_later(f, i, q);
            if (etch)
                fw_diag_error(pack->diags, 623, s->place,
                              "step %s accepts a wafer by %s, and step %s etches so deep later; "
                              "look after it",
                              s->id, q->id, etch->id);
            lint_read(pack, s, &wafer, a);
        }
    }
    return FW_OK;
}
