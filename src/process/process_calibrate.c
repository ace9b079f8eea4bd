/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/coupon.h"
#include "base/constants.h"
#include "process/calibrate.h"
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
                         of->coupon, best ? "; did you mean '" : "", best ? best : "",
                         best ? "'?" : "", list.data);
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
    FW_NEED(first && second ? is : NULL);
    return fw_diag_error(diags, 211, r->place,
                         "%s is measured at %s%s%s, which stands under at, not at %s", r->coupon,
                         first, two ? " or " : "", two ? second : "", is);
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
    return check_under(kind, r, diags);
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

fw_status fw_process_coupon_fit_all(fw_process_coupon_work *w,
                                    const fw_process_measurement *measurement, int n) {
    fw_status status = FW_OK;
    for (int k = 0; k < KINDS; k++) {
        w->n = 0;
        for (int i = 0; i < n; i++) {
            if (fw_process_coupon_kind(measurement[i].coupon) != table[k]) continue;
            if (w->n == FW_COUPON_ROWS)
                return fw_process_coupon_wrong(w, &measurement[i],
                                               "more than %d rows of one coupon", FW_COUPON_ROWS);
            w->measurement[w->n++] = &measurement[i];
        }
        if (w->n == 0) continue;
        fw_status of_kind = table[k]->fit(w);
        if (of_kind == FW_OK) of_kind = join(w->arena, w->diags, w->out, &w->nout);
        if (of_kind != FW_OK && of_kind != FW_INPUT) return of_kind;
        if (of_kind == FW_INPUT) status = of_kind; /* and what is wrong with the others */
        w->nknown = w->nout;
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
        if (of_row == FW_NOMEM) return of_row;
        if (of_row != FW_OK) status = of_row;
    }
    if (n == 0) return fw_diag_error(diags, 211, (fw_place){0}, "the table holds no measurement");
    FW_TRY(status);
    status = fw_process_coupon_fit_all(w, measurement, n);
    if (status != FW_OK && status != FW_INPUT) return status;
    for (int k = 0; k < w->nout; k++)
        if (check_result(flow, &out[k], measurement[0].place, diags) != FW_OK) status = FW_INPUT;
    FW_TRY(status);
    *calibration = (fw_process_calibration){.item = out, .count = w->nout};
    return diags->failed ? FW_NOMEM : FW_OK;
}
