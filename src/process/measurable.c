/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be read, and how exactly: the rows that a laboratory is meant to get from each coupon, at the
   flow's own values, go through calibrate itself; what comes out has the uncertainty that the real rows
   will give. And the flow with one of them as it would be after that. */
#include "base/constants.h"
#include "base/text.h"
#include "process/calibrate.h"
#include "process/coupon.h"
#include "process/films.h"
#include "process/pack.h"
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
    if (q && !q->id) return q->unknown ? (double)NAN : q->value; /* a number in the step itself */
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
    double e = known(m->flow, edge) - (printed ? 0.0 : fw_process_coupon_loss(m->flow, NULL));
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
    double edge, u;
    fw_process_coupon_work *of = fw_arena_one(m->arena, fw_process_coupon_work);
    if (!of) return; /* reads nothing; what comes next says that there is no memory */
    of->arena = m->arena, of->flow = m->flow;
    fw_process_coupon_mask_edge(of, &edge, &u);
    for (size_t i = 0; i < sizeof slot_um / sizeof slot_um[0]; i++) {
        double w = slot_um[i] * 1e-6, depth = D;
        for (int k = 0; k < 40 && isfinite(depth); k++) /* contracts by S (1/K - 1) */
            depth = D - S * fw_process_arde_integral(w - 2.0 * edge, depth, false);
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
    double E = D * (1.0 + (isnan(over) ? 0.0 : over)), edge, u;
    fw_process_coupon_work *of = fw_arena_one(m->arena, fw_process_coupon_work);
    if (!of) return; /* as above */
    of->arena = m->arena, of->flow = m->flow;
    fw_process_coupon_mask_edge(of, &edge, &u);
    const double lost = (1.0 - A) * E - edge;
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

/* a release that stops between two plates of the ladder: one of 40 um is free, one of 50 um held */
static void of_release(meant *m) {
    const double hole = 10e-6, pitch[] = {40e-6, 50e-6}, R = known(m->flow, "release.R");
    const double reach = 0.5 * ((pitch[0] - hole) / sqrt(2.0) + pitch[1] / sqrt(2.0) - 0.5 * hole);
    for (int i = 0; i < 2; i++) {
        fw_process_measurement row =
            lengths("release-holes", i ? "held" : "free", pitch[i], hole, m->width_m);
        row.at = reach / R;
        row.at_uncertainty = m->time_s;
        row.at_dimension = (fw_quantity_dimension)FW_DIM_TIME;
        if (isfinite(R)) add(m, row);
    }
}

/* the planned thickness at the planned charge per area; narrow pads as thick as flexures come out */
static void of_pads(meant *m) {
    const fw_process_plating of = fw_process_flow_plating(m->flow, "");
    double d = value_of(m, of.thickness), made = of.made ? known(m->flow, of.made) : (double)NAN,
           q = d * value_of(m, of.valence) * FW_FARADAY_C_PER_mol * value_of(m, of.density) /
               (value_of(m, of.efficiency) * value_of(m, of.molar_mass));
    if (of.made &&
        fw_process_corner_is_share(FW_CORNER_THICKNESS, fw_process_flow_quantity(m->flow, of.made)))
        made *= d;
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
    {"cd-lines", NULL, NULL, of_lines},
    {"etch-rate", NULL, NULL, of_rates},
    {"arde-slots", "cd-lines", of_lines, of_slots},
    {"undercut-ladder", "cd-lines", of_lines, of_ladder},
    {"al-step", NULL, NULL, of_mask_step},
    {"release-holes", NULL, NULL, of_release},
    {"plating-pads", NULL, NULL, of_pads},
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

/* ---- what is given of readings and nothing takes ---- */

/* what the coupon itself does not take */
static void ask_columns(const fw_process_measurement *r, const fw_process_coupon *kind,
                        const char *file, fw_diags *diags) {
    if (!kind->drawn && !isnan(r->drawn_m) && r->drawn_m > 0.0)
        fw_diag_warning(diags, 679, (fw_place){file, r->place.line, r->place.column},
                        "%s takes no drawn width: what stands under drawn_um is not used",
                        r->coupon);
    if (!kind->at && !isnan(r->at))
        fw_diag_warning(diags, 679, (fw_place){file, r->place.line, r->place.column},
                        "%s is measured under no condition: what stands under at is not used",
                        r->coupon);
}

/* the quantities that a step would correct the rate by, and that nobody knows; "": no step would */
static fw_status lacks(const fw_process_flow *flow, fw_process_condition which, const char *rate,
                       fw_diags *diags, const char **names, const char **step) {
    const fw_process_coupon_lacking of = fw_process_coupon_lacks(flow, which, rate);
    fw_text text = fw_text_new(diags->arena);
    fw_text_add(&text, "");
    for (int i = 0; i < of.n; i++)
        fw_text_printf(&text, "%s%s", i ? " and " : "", of.q[i]->id);
    FW_TRY(fw_text_end(&text));
    *names = text.data;
    *step = of.step ? of.step->id : "";
    return FW_OK;
}

static fw_status ask_given(const fw_process_flow *flow, const fw_process_measurement *r, int rows,
                           fw_process_condition which, bool typed, const char *file,
                           fw_diags *diags) {
    static const char *const word[FW_CONDITIONS] = {
        [FW_CONDITION_TEMPERATURE] = "temperature", [FW_CONDITION_OPEN_AREA] = "open area"};
    const char *rate = fw_process_coupon_rate(flow, r), *names, *step;
    const bool by_depth =
        fw_quantity_dimension_equal(r->at_dimension, (fw_quantity_dimension)FW_DIM_LENGTH);
    const fw_place at = {file, r->place.line, r->place.column};
    if (rate && fw_process_flow_corrects(flow, which, rate)) {
        if (by_depth && typed)
            fw_diag_warning(
                diags, 679, at,
                "the %s of %d row%s of %s is not used: these give no rate, but what was "
                "etched at a depth",
                word[which], rows, rows > 1 ? "s" : "", r->coupon);
        return FW_OK;
    }
    FW_TRY(lacks(flow, which, rate ? rate : "", diags, &names, &step));
    if (*names)
        fw_diag_warning(
            diags, 679, at,
            "the %s of %d row%s of %s is not used: step %s corrects %s for it where %s "
            "are known, and here they are not. State them in a laboratory pack and name "
            "it with --lab",
            word[which], rows, rows > 1 ? "s" : "", r->coupon, step, rate, names);
    else
        fw_diag_warning(
            diags, 679, at,
            "the %s of %d row%s of %s is not used: no step of flow '%s' corrects %s for "
            "it",
            word[which], rows, rows > 1 ? "s" : "", r->coupon, flow->id,
            rate ? rate : "what it gives");
    return FW_OK;
}

/* once for all rows of a coupon, at the first. Test: test_calibrate.c, columns_that_nothing_takes */
fw_status fw_process_measurements_ask(const fw_process_flow *flow,
                                      const fw_process_measurement *const *row, int n, bool typed,
                                      const char *file, fw_diags *diags) {
    for (int i = 0; i < n; i++) {
        const fw_process_coupon *kind = fw_process_coupon_kind(row[i]->coupon);
        bool first = kind != NULL;
        for (int k = 0; k < i; k++)
            first = first && (strcmp(row[k]->coupon, row[i]->coupon) != 0 ||
                              strcmp(row[k]->feature, row[i]->feature) != 0);
        if (typed && first) ask_columns(row[i], kind, file, diags);
        for (int c = 0; c < FW_CONDITIONS; c++) {
            int rows = 0, before = 0;
            for (int k = 0; k < n; k++)
                if (strcmp(row[k]->coupon, row[i]->coupon) == 0 &&
                    strcmp(row[k]->feature, row[i]->feature) == 0 && row[k]->condition[c] > 0.0)
                    rows++, before += k < i;
            if (kind && row[i]->condition[c] > 0.0 && before == 0)
                FW_TRY(ask_given(flow, row[i], rows, (fw_process_condition)c, typed, file, diags));
        }
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* All readings of the coupon are of one run, but what stands under `at` is not the same: both count, and one may be
   mistyped. Told once of a coupon, wafer and step. */
void fw_process_readings_ask_apart(const fw_process_readings *r, fw_diags *diags) {
    const fw_process_reading *last = &r->item[r->n - 1];
    const fw_process_measurement *b = &last->row;
    if (isnan(b->at) || !fw_process_coupon_of_one_run(b->coupon)) return;
    for (int i = 0; i < r->n - 1; i++) {
        const fw_process_measurement *a = &r->item[i].row;
        if (strcmp(r->item[i].step, last->step) != 0 ||
            strcmp(r->item[i].wafer, last->wafer) != 0 || strcmp(a->coupon, b->coupon) != 0)
            continue;
        const double u = hypot(fmax(a->at_uncertainty, 0.0), fmax(b->at_uncertainty, 0.0));
        if (fabs(a->at - b->at) <= 2.0 * u + 1e-12 * fabs(a->at)) continue;
        fw_diag_warning(diags, 611, b->place,
                        "coupon %s of step %s%s%s is of one run, but lines %d and %d say that it "
                        "was under something else (at=); each reading counts with its own. Where "
                        "one is mistyped, log its readings again; where both were measured, say "
                        "by u-at= how exactly",
                        b->coupon, last->step, last->wafer[0] ? ", wafer " : "", last->wafer,
                        (int)a->place.line, (int)b->place.line);
        return;
    }
}

/* ---- at which step of the flow a coupon is read ---- */

/* "the edge of the aluminium (made.al-edge) ": as its corner is called */
static void put_named(const fw_process_flow *flow, const char *id, fw_text *out) {
    for (int i = 0; i < flow->ncorner; i++)
        if (flow->corner[i].q && strcmp(flow->corner[i].q->id, id) == 0) {
            fw_text_printf(out, "the %s (%s) ", flow->corner[i].name, id);
            return;
        }
    fw_text_printf(out, "%s ", id);
}

/* "the printed edge (litho.edge) from S11 to S13, ..." */
static fw_status said(fw_arena *arena, const fw_process_flow *flow,
                      const fw_process_coupon_stage *stage, int n, const char **where) {
    fw_text text = fw_text_new(arena);
    for (int i = 0; i < n; i++) {
        const fw_process_step *last =
            stage[i].until ? stage[i].until - 1 : flow->step + flow->nstep - 1;
        fw_text_add(&text, i ? ", " : "");
        if (stage[i].gives) put_named(flow, stage[i].gives, &text);
        fw_text_printf(&text, last > stage[i].from ? "from %s to %s" : "at %s", stage[i].from->id,
                       last->id);
    }
    FW_TRY(fw_text_end(&text));
    *where = text.data;
    return FW_OK;
}

/* A coupon that its flow does not make has no stage, and is read whenever somebody reads it: others refuse what nothing takes.
   Test: test_wafer_state.c, where_coupons_are_read; test_asrun.c, lines_in_the_resist */
fw_status fw_process_coupon_stage_at(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_process_measurement *row, const fw_process_step *step,
                                     bool *there, fw_process_coupon_stage *stage,
                                     const char **where) {
    const fw_process_coupon *kind = fw_process_coupon_kind(row->coupon);
    fw_process_coupon_stage list[FW_COUPON_STAGES];
    const int n = kind && kind->stages ? kind->stages(flow, row, list) : 0;
    *stage = (fw_process_coupon_stage){0};
    *there = n == 0;
    for (int i = 0; i < n; i++)
        if (step >= list[i].from && (!list[i].until || step < list[i].until))
            *there = true, *stage = list[i];
    return *there ? FW_OK : said(arena, flow, list, n, where);
}

/* the edge of an etched layer is what is left beyond that, and slots and lines of the ladder begin where that edge is */
bool fw_process_coupon_follows_plan(const fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(row->coupon);
    if (!kind || !kind->stages) return false;
    if (kind->stages == fw_process_stages_of_edges)
        return !row->of || strcmp(row->of, FW_PROCESS_PRINTED_EDGE) != 0;
    return kind->stages == fw_process_stages_of_etch;
}

/* puts it there, or takes it */
bool fw_process_step_makes_edges(const fw_process_flow *flow, const fw_process_step *s) {
    for (const fw_process_step *etch = flow->step; etch < flow->step + flow->nstep; etch++)
        for (int k = 0; k < etch->nchange; k++) {
            const fw_quantity *d = fw_process_change_takes_edges(flow, &etch->change[k]);
            for (int i = 0; d && i < s->nchange; i++)
                if (s->change[i].thickness == d) return true;
        }
    return false;
}

/* ---- packs of former versions ---- */

/* Packs that calibrate wrote before `spread` was (version 1, as some are that have it): what it found of one wafer, or in a table, with what was read alone. How the next
   one differs is the flow's, as in those of now (FW-D734). Test: test_wafers.c, packs_of_before */
fw_status fw_process_lab_keep_spread(fw_arena *arena, const fw_process_flow *flow, const char *id,
                                     fw_quantity *q) {
    const char *note = q->note ? q->note : "";
    const bool found = strstr(note, "chi square ") || strstr(note, "no residual to test");
    fw_process_calibrated c = {
        .id = id, .value = q->value, .uncertainty = q->uncertainty, .note = note};
    if (!found || q->unknown || q->status != FW_MEASURED || q->spread_taken || q->spread > 0.0 ||
        strstr(note, "which differ by"))
        return FW_OK;
    FW_TRY(fw_process_calibrated_spread(arena, flow, "of one wafer", &c));
    q->spread = c.spread, q->uncertainty = c.uncertainty, q->spread_taken = true;
    return FW_OK;
}

double fw_process_lab_read_part(const fw_quantity *q) {
    const bool former = q->spread_taken && q->note && !strstr(q->note, "how the next one differs");
    const double read = sqrt(fmax(q->uncertainty * q->uncertainty - q->spread * q->spread, 0.0));
    return former && q->uncertainty > 0.0 ? read / q->uncertainty : 1.0;
}
