/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/trial_value.h"
#include <math.h>
#include <string.h>

static const double least_step = 1e-4; /* of the range: nobody asks for a finer digit */
static const double factor_without_bounds = 4.0;
/* of the value, where its end is 0: a load that is taken away altogether is no advice, and a scene
   in which nothing moves is the slowest of all to judge */
static const double nearest_to_0 = 0.01;

/* of a dimension in SI: "kg m s-2"; a parameter computed from others has no unit of its own */
static const char *si_unit(fw_arena *arena, fw_quantity_dimension d) {
    const struct {
        const char *symbol;
        int power;
    } part[] = {{"kg", d.kg}, {"m", d.m},     {"s", d.s},     {"A", d.A},
                {"K", d.K},   {"mol", d.mol}, {"rad", d.rad}, {"EUR", d.money}};
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "");
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        if (part[i].power == 0) continue;
        fw_text_printf(&text, "%s%s", text.length ? " " : "", part[i].symbol);
        if (part[i].power != 1) fw_text_printf(&text, "%d", part[i].power);
    }
    return text.failed ? NULL : text.data;
}

const char *fw_verdict_value_text(fw_arena *arena, const fw_verdict_value *value, double x,
                                  int digits) {
    char number[40];
    fw_number_text(number, sizeof number, x, digits);
    return fw_arena_printf(arena, "%s%s%s", number, value->unit_text[0] ? " " : "",
                           value->unit_text);
}

double fw_verdict_value_step(const fw_verdict_value *value, double x) {
    double step = pow(10, floor(log10(x) + 1e-9));
    return fmax(step, value->digit);
}

double fw_verdict_value_rounded(double x, double step) {
    return step >= 1 ? nearbyint(x / step) * step : nearbyint(x / step) / nearbyint(1 / step);
}

/* is it a count? One that is written as a whole number, and cannot be read between two of them */
static fw_status is_count(fw_verdict_trial *trial, const fw_verdict_value *h, bool *count) {
    *count = false;
    if (h->unit_text[0] || h->now != nearbyint(h->now)) return FW_OK;
    double between = h->now + (h->now + 0.5 <= h->high ? 0.5 : -0.5);
    if (between < h->low) return FW_OK;
    const char *value = fw_verdict_value_text(trial->arena, h, between, 12);
    FW_NEED(value);
    fw_arena *scratch = fw_arena_part(trial->arena, 0);
    FW_NEED(scratch);
    const fw_verdict_restated *r = &trial->options->restated;
    const fw_device *device = NULL;
    fw_verdict_variant_verdict *variant =
        fw_arena_array(scratch, fw_verdict_variant_verdict, (size_t)trial->verdict->nvariant);
    const fw_device_set set = {h->path, value};
    fw_status status = variant ? r->with(r->context, scratch, &set, 1, &device, variant) : FW_NOMEM;
    fw_arena_free(scratch);
    *count = status != FW_OK;
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}

fw_status fw_verdict_value_of_parameter(fw_verdict_trial *trial, const fw_device_parameter *p,
                                        fw_verdict_value *h, bool *ok) {
    *h = (fw_verdict_value){.path = p->name, .unit_text = p->unit};
    *ok = false;
    if (!fw_quantity_unit_parse(p->unit, strlen(p->unit), &h->unit, NULL, NULL) ||
        !fw_quantity_dimension_equal(h->unit.dimension, p->dimension)) {
        FW_NEED(h->unit_text = si_unit(trial->arena, p->dimension));
        h->unit = (fw_quantity_unit){.factor = 1, .dimension = p->dimension};
    }
    double ends[2] = {p->min, p->max}, v = h->now = fw_quantity_unit_from_si(&h->unit, p->value);
    for (int i = 0; i < 2; i++) {
        double away = (i == 0) == (v > 0) ? 1 / factor_without_bounds : factor_without_bounds;
        ends[i] = isinf(ends[i]) ? v * away : fw_quantity_unit_from_si(&h->unit, ends[i]);
    }
    h->low = fmin(v > 0 && ends[0] == 0 ? nearest_to_0 * v : ends[0], v);
    h->high = fmax(v < 0 && ends[1] == 0 ? nearest_to_0 * v : ends[1], v);
    h->range = fmax(v - h->low, h->high - v);
    if (!(h->range > 0)) return FW_OK;
    bool count;
    h->digit = pow(10, floor(log10(least_step * h->range)));
    FW_TRY(is_count(trial, h, &count));
    if (count) h->digit = fmax(h->digit, 1);
    *ok = true;
    return FW_OK;
}
