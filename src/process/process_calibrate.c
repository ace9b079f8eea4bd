/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a table of measurements to quantities of the flow: every coupon in turn, and how their results go together. */
#include "base/constants.h"
#include "process/calibrate.h"
#include "process/coupon.h"
#include "process/pack.h"
#include "quantity/program.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* in the order in which one needs another: edges before the ladder, rates before depths by time */
#define FW_PROCESS_COUPON(name) &fw_process_coupon_##name,
static const fw_process_coupon *const table[] = {
#include "process/coupons.def"
};
#undef FW_PROCESS_COUPON
enum { KINDS = sizeof table / sizeof table[0] };

/* ---- the whole table ---- */

const fw_process_coupon *fw_process_coupon_kind(const char *name) {
    for (int i = 0; i < KINDS; i++)
        if (strcmp(table[i]->name, name) == 0) return table[i];
    return NULL;
}

const char *fw_process_coupon_other_side(const fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(row->coupon);
    for (int i = 0; kind && i < 2 && kind->sides[0]; i++)
        if (strcmp(kind->sides[i], row->feature) == 0) return kind->sides[1 - i];
    return NULL;
}

bool fw_process_coupon_is_looked_at(const fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(row->coupon);
    return kind && !kind->sides_measured && fw_process_coupon_other_side(row);
}

const char *fw_process_coupon_rate(const fw_process_flow *flow, const fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(row->coupon);
    const fw_quantity *etched = fw_process_flow_etch(flow).rate;
    if (kind && kind->rate) return row->feature;
    if (kind == &fw_process_coupon_release) return "release.R";
    return (kind == &fw_process_coupon_slots || kind == &fw_process_coupon_ladder) && etched
               ? etched->id
               : NULL;
}

bool fw_process_coupon_of_one_run(const char *coupon) {
    const fw_process_coupon *kind = fw_process_coupon_kind(coupon);
    return kind && kind->one_run;
}

static const char *unit_of(fw_quantity_dimension d) {
    const fw_quantity_dimension length = FW_DIM_LENGTH, time = FW_DIM_TIME;
    if (fw_quantity_dimension_equal(d, length)) return " um";
    if (fw_quantity_dimension_equal(d, time)) return " min";
    const char *unit = fw_quantity_dimension_unit(d);
    return unit && strcmp(unit, "1") != 0 ? unit : "";
}

static void put_form(const fw_process_coupon *kind, const char *feature, fw_text *out) {
    enum { FEATURES = sizeof kind->features / sizeof kind->features[0] };
    const char *unit = unit_of(kind->measured);
    fw_text_add(out, kind->name);
    for (int i = 0; i < FEATURES && kind->features[i] && !kind->features_said; i++)
        fw_text_printf(out, "%s%s", i ? "|" : ", ", kind->features[i]);
    if (kind->features_said) fw_text_printf(out, ", %s", kind->features_said);
    if (!kind->features[0] && !kind->features_said)
        fw_text_printf(out, ", %s", kind->rate && feature ? feature : "FEATURE");
    if (kind->drawn) fw_text_add(out, ", drawn=__ um");
    fw_text_printf(out, ", value=__ __ __ __ __%s, u=__%s", kind->any_measured ? " UNIT" : unit,
                   kind->any_measured ? " UNIT" : unit);
    if (kind->at)
        fw_text_printf(out, ", at=__%s",
                       fw_quantity_dimension_equal(kind->under[0], (fw_quantity_dimension){0})
                           ? " UNIT"
                           : unit_of(kind->under[0]));
}

/* is it one of the words of the name, which have - between them? */
static bool is_word_of(const char *name, const char *word) {
    const size_t n = strlen(word);
    for (const char *at = name; n > 0 && (at = strstr(at, word)); at++)
        if ((at == name || at[-1] == '-') && (at[n] == '-' || at[n] == '\0')) return true;
    return false;
}

const char *fw_process_coupon_called(const char *name) {
    const char *called = NULL;
    if (fw_process_coupon_kind(name)) return name;
    for (int i = 0; i < KINDS; i++) {
        if (!is_word_of(table[i]->name, name)) continue;
        if (called) return name; /* of two */
        called = table[i]->name;
    }
    return called ? called : name;
}

fw_status fw_process_coupon_forms(const fw_process_coupon_read *read, int n, fw_text *out) {
    for (int i = 0; i < KINDS; i++) {
        bool told = false;
        for (int k = 0; k < n; k++) {
            if (!read[k].words || !strstr(read[k].words, table[i]->name)) continue;
            if (told && !table[i]->rate) continue; /* one line serves whatever is read of it */
            fw_text_add(out, out->length ? "; " : "");
            put_form(table[i], read[k].id, out);
            told = true;
        }
    }
    return fw_text_end(out);
}

static fw_status unknown_kind(fw_diags *diags, const fw_process_measurement *of) {
    const char *names[KINDS];
    for (int i = 0; i < KINDS; i++)
        names[i] = table[i]->name;
    const char *best = fw_did_you_mean(of->coupon, names, KINDS);
    fw_text list = fw_text_new(diags->arena);
    for (int i = 0; i < KINDS; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "", names[i]);
    FW_TRY(fw_text_end(&list));
    return fw_diag_error(diags, 211, of->place, "there is no coupon '%s'%s%s%s; known are %s",
                         of->coupon, FW_DID_YOU_MEAN(best), list.data);
}

static fw_status check_feature(const fw_process_coupon *kind, const fw_process_measurement *r,
                               fw_diags *diags) {
    const char *const *name = kind->features;
    enum { MOST = sizeof kind->features / sizeof kind->features[0] };
    int n = 0;
    for (; n < MOST && name[n]; n++)
        if (strcmp(r->feature, name[n]) == 0) return FW_OK;
    if (n == 0) return FW_OK;
    bool three = n > 2;
    return fw_diag_error(diags, 211, r->place, "the feature of %s is %s%s%s%s%s, not '%s'",
                         r->coupon, name[0], three ? ", " : "", three ? name[1] : "",
                         n > 1 ? " or " : "", n > 1 ? name[n - 1] : "", r->feature);
}

static fw_status check_under(const fw_process_coupon *kind, const fw_process_measurement *r,
                             fw_diags *diags) {
    const fw_quantity_dimension *under = kind->under, plain = {0};
    bool any = fw_quantity_dimension_equal(under[0], plain),
         two = !fw_quantity_dimension_equal(under[1], plain);
    if (any || fw_quantity_dimension_equal(r->at_dimension, under[0]) ||
        (two && fw_quantity_dimension_equal(r->at_dimension, under[1])))
        return FW_OK;
    const char *first = fw_quantity_dimension_text(diags->arena, under[0]),
               *second = fw_quantity_dimension_text(diags->arena, under[1]),
               *is = fw_quantity_dimension_text(diags->arena, r->at_dimension);
    const char *unit = fw_quantity_dimension_unit(under[0]);
    FW_NEED(first && second ? is : NULL);
    return fw_diag_error(diags, 211, r->place,
                         "%s is measured at %s%s%s%s%s, which stands under at, not at %s",
                         r->coupon, first, two ? " or " : "", two ? second : "",
                         unit ? ", such as 20 " : "", unit ? unit : "", is);
}

bool fw_process_coupon_on_test_die(const char *coupon) {
    const fw_process_coupon *kind = fw_process_coupon_kind(coupon);
    return kind && !kind->plain;
}

const fw_quantity *fw_process_coupon_mask(const fw_process_flow *flow,
                                          const fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(row->coupon);
    return kind && kind->of_mask ? fw_process_flow_etch(flow).mask : NULL;
}

/* a mask cannot lose more than there was of it: what is left is mistaken for that, or a unit is wrong */
static fw_status check_lost(const fw_process_flow *flow, const fw_process_measurement *r,
                            fw_diags *diags) {
    static const double sure = 3.0;
    const fw_quantity *mask = fw_process_coupon_mask(flow, r);
    char lost[32], there[32];
    if (!mask || mask->unknown) return FW_OK;
    const double most = mask->value + sure * hypot(mask->uncertainty, r->uncertainty);
    if (!(r->value > most)) return FW_OK;
    return fw_diag_error(
        diags, 211, r->place,
        "%s: the mask lost %s um, and there were %s um of it (%s): give what the etch took of it, "
        "its step before the etch less that after it",
        r->coupon, fw_number_text(lost, sizeof lost, r->value * 1e6, 4),
        fw_number_text(there, sizeof there, mask->value * 1e6, 4), mask->id);
}

fw_status fw_process_measurement_of_flow(const fw_process_flow *flow,
                                         const fw_process_measurement *r, fw_diags *diags) {
    const fw_process_coupon *kind = fw_process_coupon_kind(r->coupon);
    FW_TRY(check_lost(flow, r, diags));
    if (!kind || !kind->rate) return FW_OK;
    const fw_quantity *q = fw_process_flow_quantity(flow, r->feature);
    if (q && fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_SPEED))
        return FW_OK;
    return fw_diag_error(diags, 605, r->place,
                         "the feature of %s is the id of a rate of flow '%s', and '%s' is none",
                         r->coupon, flow->id, r->feature);
}

/* no width below 0, no depth of metres, no line of half a metre on a plate: what a pack may not say either (FW-D278) */
static bool makes_sense(const fw_process_measurement *r, fw_diags *diags) {
    const struct {
        const char *id;
        double value;
        fw_quantity_dimension dimension;
    } of[] = {{"measured", r->value, r->dimension},
              {"drawn", r->drawn_m, FW_DIM_LENGTH},
              {"at", r->at, r->at_dimension}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        const char *unit = fw_quantity_dimension_unit(of[i].dimension);
        const fw_quantity q = {.id = of[i].id,
                               .value = of[i].value,
                               .unit = unit ? unit : "1",
                               .dimension = of[i].dimension,
                               .place = r->place};
        if (!isnan(q.value) && !fw_process_quantity_in_range(&q, diags)) return false;
    }
    return true;
}

fw_status fw_process_measurement_check(const fw_process_measurement *r, fw_diags *diags) {
    const fw_process_coupon *kind = fw_process_coupon_kind(r->coupon);
    if (!kind) return unknown_kind(diags, r);
    const char *is = fw_quantity_dimension_text(diags->arena, r->dimension),
               *want = fw_quantity_dimension_text(diags->arena, kind->measured);
    FW_NEED(is ? want : NULL);
    if (!fw_quantity_dimension_equal(r->dimension, kind->measured))
        return fw_diag_error(diags, 211, r->place, "%s is measured as %s, not as %s", r->coupon,
                             want, is);
    if (kind->drawn && !(r->drawn_m > 0.0))
        return fw_diag_error(diags, 211, r->place, "%s needs drawn_um, the width on the mask",
                             r->coupon);
    if (kind->at && !(r->at > 0.0))
        return fw_diag_error(diags, 211, r->place,
                             "%s needs the columns at, u_at and at_unit: the time, depth, "
                             "charge or speed at which it was measured",
                             r->coupon);
    FW_TRY(check_feature(kind, r, diags));
    FW_TRY(check_under(kind, r, diags));
    return makes_sense(r, diags) ? FW_OK : FW_INPUT;
}

/* two coupons of one number: their weighted mean, unless they contradict each other */
static fw_status join(fw_arena *arena, fw_diags *diags, fw_process_calibrated *list, int *n) {
    for (int i = 0; i < *n; i++)
        for (int k = i + 1; k < *n; k++) {
            fw_process_calibrated *a = &list[i], *b = &list[k];
            if (strcmp(a->id, b->id) != 0) continue;
            double y[2] = {a->value, b->value}, s[2] = {a->uncertainty, b->uncertainty};
            fw_process_fit f = fw_process_fit_mean(y, s, 2);
            double p = fw_process_chi_square_above(f.chi_square, 1);
            char text[32];
            if (p < FW_COUPON_LEAST_PROBABILITY)
                return fw_diag_error(
                    diags, 212, (fw_place){0},
                    "%s from %s and from %s contradict each other (probability %s)", a->id,
                    a->coupon, b->coupon, fw_number_text(text, sizeof text, p, 2));
            FW_NEED(a->coupon = fw_arena_printf(arena, "%s, %s", a->coupon, b->coupon));
            FW_NEED(a->note = fw_arena_printf(arena, "%s; and %s", a->note, b->note));
            a->value = f.value[0], a->uncertainty = f.uncertainty[0];
            fw_process_calibrated_join(a, b);
            a->rows += b->rows;
            a->chi_square += b->chi_square + f.chi_square;
            a->freedom += b->freedom + 1;
            a->probability = fw_process_chi_square_above(a->chi_square, a->freedom);
            memmove(b, b + 1, (size_t)(*n - k - 1) * sizeof *b);
            --*n, --k;
        }
    return FW_OK;
}

/* a result meets the range of the quantity that it replaces: no rate below 0, no share above 1 */
static fw_status check_result(const fw_process_flow *flow, const fw_process_calibrated *c,
                              fw_place place, fw_diags *diags) {
    const fw_quantity *old = fw_process_flow_quantity(flow, c->id);
    if (!old) return FW_OK;
    fw_quantity q = *old;
    q.value = c->value;
    q.unknown = false;
    q.place = place;
    return fw_process_quantity_in_range(&q, diags) ? FW_OK : FW_INPUT;
}

/* what this kind found, from `first` on, and of which values of the flow */
static fw_status add_with(const fw_process_coupon_work *w, int first, fw_process_calibration *to) {
    for (int i = 0; i < w->nread; i++)
        for (int k = first; k < w->nout; k++) {
            const fw_process_found_with with = {w->read[i], w->out[k].id};
            FW_TRY(fw_process_calibration_with(w->arena, to, &with));
        }
    return FW_OK;
}

/* of the kind, and of the same: of lines in the resist and in the layer below each by themselves */
static bool goes_with(const fw_process_measurement *row, const fw_process_coupon *kind,
                      const fw_process_measurement *first) {
    return fw_process_coupon_kind(row->coupon) == kind && fw_text_same(row->of, first->of);
}

/* the rows that go with the first one */
static fw_status fit_kind(fw_process_coupon_work *w, const fw_process_coupon *kind,
                          const fw_process_measurement *first, int n,
                          fw_process_calibration *with) {
    w->n = 0;
    for (int i = 0; i < n; i++) {
        if (!goes_with(&first[i], kind, first)) continue;
        if (w->n == FW_COUPON_ROWS)
            return fw_process_coupon_wrong(w, &first[i], "more than %d rows of one coupon",
                                           FW_COUPON_ROWS);
        w->measurement[w->n++] = &first[i];
    }
    w->one_run = kind->one_run;
    w->nread = 0;
    const int before = w->nout;
    fw_status status = kind->fit(w);
    for (int k = before; k < w->nout; k++)
        w->out[k].of_wafer = first->of_wafer;
    if (with && status == FW_OK && !first->of_wafer) FW_TRY(add_with(w, before, with));
    if (status == FW_OK) status = join(w->arena, w->diags, w->out, &w->nout);
    w->nknown = w->nout;
    return status;
}

/* all rows through all kinds, into work->out; `with`: what they were found with goes there; NULL: it is not asked for */
static fw_status fit_all(fw_process_coupon_work *w, const fw_process_measurement *measurement,
                         int n, fw_process_calibration *with) {
    fw_status status = FW_OK;
    for (int k = 0; k < KINDS; k++)
        for (int i = 0; i < n; i++) {
            bool first = fw_process_coupon_kind(measurement[i].coupon) == table[k];
            for (int b = 0; b < i && first; b++)
                first = !goes_with(&measurement[b], table[k], &measurement[i]);
            if (!first) continue;
            const fw_status of_kind = fit_kind(w, table[k], &measurement[i], n - i, with);
            if (of_kind != FW_OK && of_kind != FW_INPUT) return of_kind;
            if (of_kind == FW_INPUT) status = of_kind; /* and what is wrong with the others */
        }
    return status;
}

fw_status fw_process_calibrate(fw_arena *arena, const fw_process_flow *flow,
                               const fw_process_measurement *measurement, int n, fw_diags *diags,
                               fw_process_calibration *calibration) {
    fw_status status = FW_OK;
    fw_process_calibrated *out = fw_arena_array(arena, fw_process_calibrated, FW_COUPON_RESULTS);
    fw_process_coupon_work *w = fw_arena_one(arena, fw_process_coupon_work);
    FW_NEED(out ? w : NULL);
    *w = (fw_process_coupon_work){
        .arena = arena, .flow = flow, .known = out, .out = out, .diags = diags};
    for (int i = 0; i < n; i++) {
        fw_status of_row = fw_process_measurement_check(&measurement[i], diags);
        if (of_row == FW_OK) of_row = check_lost(flow, &measurement[i], diags);
        if (of_row == FW_NOMEM) return of_row;
        if (of_row != FW_OK) status = of_row;
    }
    if (n == 0) return fw_diag_error(diags, 211, (fw_place){0}, "the table holds no measurement");
    FW_TRY(status);
    fw_process_calibration with = {0};
    status = fit_all(w, measurement, n, &with);
    if (status != FW_OK && status != FW_INPUT) return status;
    for (int k = 0; k < w->nout; k++)
        if (check_result(flow, &out[k], measurement[0].place, diags) != FW_OK) status = FW_INPUT;
    FW_TRY(status);
    *calibration = (fw_process_calibration){
        .item = out, .count = w->nout, .with = with.with, .nwith = with.nwith};
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- how the results of coupons go together: the same measurement stands behind several of them ---- */

typedef struct source { /* one independent error of the data */
    int row;            /* its measured value, or what it was measured under; -1: of the flow */
    bool at;            /* of `at` */
    bool common;        /* of a condition, which one instrument told of all rows */
    double metered;     /* relative, of `at` of all rows of the kind that one meter told; 0: no */
    const fw_process_coupon *kind; /* NULL: of all metered kinds */
    fw_process_condition of;
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

static double beyond(double u, double shared) {
    static const double rounding = 1e-9;
    return u > shared * (1.0 + rounding) ? sqrt(u * u - shared * shared) : 0.0;
}

static void shift_row(const problem *p, const source *s, double by, fw_process_measurement *row) {
    const fw_process_coupon *kind = fw_process_coupon_kind(p->row[s->row].coupon);
    memcpy(row, p->row, (size_t)p->n * sizeof *row);
    for (int i = 0; s->metered > 0.0 && i < p->n; i++)
        if (fw_process_coupon_is_metered(&row[i], s->kind)) row[i].at *= 1.0 + by * s->metered;
    if (s->metered > 0.0) return;
    for (int i = 0; s->common && i < p->n; i++)
        if (row[i].condition[s->of] > 0.0)
            row[i].condition[s->of] += by / s->u * row[i].condition_uncertainty[s->of];
    if (s->common) return;
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
    *status = fit_all(w, row, p->n, NULL);
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
        const double own =
            kind->metered
                ? beyond(r->at_uncertainty, fw_process_coupon_meter(p->row, p->n, kind) * r->at)
                : r->at_uncertainty;
        if (shared && own > 0.0 && (first || !kind->one_run))
            list[n++] = (source){.row = i, .at = true, .u = own};
    }
    const double all = fw_process_coupon_meter(p->row, p->n, NULL);
    if (shared && all > 0.0) list[n++] = (source){.metered = all, .u = 1.0};
    for (int k = 0; shared && k < KINDS; k++) {
        const double own = beyond(fw_process_coupon_meter(p->row, p->n, table[k]), all);
        if (own > 0.0) list[n++] = (source){.metered = own, .kind = table[k], .u = 1.0};
    }
    for (int k = 0; shared && k < FW_CONDITIONS; k++) {
        bool off = false;
        for (int i = 0; i < p->n; i++)
            off = off || (p->row[i].condition[k] > 0.0 && p->row[i].condition_uncertainty[k] > 0.0);
        if (off) list[n++] = (source){.common = true, .of = (fw_process_condition)k, .u = 1.0};
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
    source *list =
        fw_arena_array(arena, source, (size_t)(2 * n + FW_CONDITIONS + FW_COUPON_USED + KINDS + 1));
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
   by what stands has a part that no row carries). Where C_ii is the larger it is stated, too: what two coupons of one
   quantity share does not average out where they are joined.
   Rows and results SI; r 1. First order: exact for fits that are linear in the data, and good to the square of the
   relative uncertainties else. Cost: two calibrations for every row.
   Source: JCGM 102:2011, 6.2 (law of propagation, several outputs). Test: test_correlation.c. */
fw_status fw_process_calibration_correlate(fw_arena *arena, const fw_process_flow *flow,
                                           const fw_process_measurement *measurement, int n,
                                           fw_process_calibration *calibration) {
    static const double more = 1.01; /* first order, on either side */
    double *u = fw_arena_array(arena, double, (size_t)n);
    fw_process_covariance all;
    FW_NEED(u);
    for (int i = 0; i < n; i++)
        u[i] = measurement[i].uncertainty;
    FW_TRY(fw_process_coupon_covariance(arena, flow, measurement, n, calibration, u, true, &all));
    double *deviation = fw_arena_array(arena, double, (size_t)all.m);
    FW_NEED(deviation);
    fw_process_calibrated *item =
        fw_arena_array(arena, fw_process_calibrated, (size_t)calibration->count + 1);
    FW_NEED(item);
    for (int i = 0; i < all.m; i++) {
        const double found = sqrt(all.C[i * all.m + i]);
        deviation[i] = found;
        if (i >= calibration->count) continue;
        item[i] = calibration->item[i];
        if (found > more * item[i].uncertainty) item[i].uncertainty = found;
        deviation[i] = fmax(found, item[i].uncertainty);
    }
    calibration->item = item;
    return fw_process_coupon_joint(arena, &all, deviation, calibration);
}
