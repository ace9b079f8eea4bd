/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smallest change of one parameter that is accepted.

   In: a device that is not accepted, and a way to read it again with another value of a
   parameter.

   Out: of every parameter the value nearest to the present one that accepts, as a text for
   --set, or that none was found.

   Method: "the device with the value x is accepted" is true or false and need not be monotonous,
   so nothing is concluded from a value about those beyond it. Looked at are, on both sides of
   the present value and outward, values whose distances grow by a constant factor (1.5, or what
   9 of them need) up to the bounds, where they are stated, else to a quarter and to four times
   the value. These looks are glances: the drawn device, and the corner of its flow that is worst
   so far, at coarse accuracy; what they reject is rejected. Between the first that may be
   accepted and the one before it the limit is enclosed by glances: by the secant of
   ln(utilisation), straight where that goes with a power of x, or by halving where the secant
   gains less than half. There the whole verdict is asked, on both sides of the limit, and tells
   what coarse judgements are off by; until a value that is accepted and one that is not are
   within 1 % of the change, a thousandth of the value, or one unit of the last digit. All values
   are decimal numbers in the unit as written; what is printed was judged as printed.

   Validity: an interval that accepts and lies between two values looked at is missed, and so is
   one nearer than the first value that accepts. What a glance puts more than 5 % beyond the
   limit is not looked at more closely. Nothing below a ten-thousandth of the range is resolved.

   Cost: at most MOST_TRIALS looks for a parameter, some MOST_IN_ALL for all, and most_work
   evaluations of hinges, shared evenly; usually 15 to 25 looks, of which two to four are whole
   verdicts. What was not settled by then is said to be so.

   Source: regula falsi with halving: Dekker, in Dejon & Henrici (eds), Constructive Aspects of
   the Fundamental Theorem of Algebra, 1969.

   Test: tests/unit/plan/test_advice.c, tests/cli/test_advice.py. */
#include "base/sort.h"
#include "verdict/advice.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* evaluations of hinges of all looks: some seconds. A scene of many periods takes more for one */
static const double most_work = 6e6;
enum { MOST_TRIALS = 40, MOST_IN_ALL = 600, FEWEST_RINGS = 4, MOST_RINGS = 9 };
/* the change is known to this part of it */
static const double known_to = 0.01;
/* and the value to this part of it: of a small change nobody types all digits */
static const double as_typed = 1e-3;
/* a coarse judgement may be off by less than this: refinement pays */
static const double worth_refining = 1.05;
static const double clear_of_limit = 0.997; /* coarsely */
static const double ring_factor = 1.5;

typedef struct sample { /* at one value */
    double at;          /* in the unit as written */
    double coarse;      /* largest utilisation coarsely, numbers taken as they are; NaN: not run */
    bool rejected;      /* for certain, coarsely */
    bool judged, accepted; /* as closely as any verdict */
} sample;

typedef struct parameter_search { /* for one parameter; values in the unit as written */
    fw_verdict_trial *trial;
    fw_verdict_value value;
    double bias; /* close over coarse, where both were run last */
    int trials;
    double most_work; /* trial->work may come to */
} parameter_search;

static bool spent(const parameter_search *h) {
    return h->trials >= MOST_TRIALS || h->trial->work >= h->most_work;
}

static double distance(const parameter_search *h, const sample *l) {
    return fabs(l->at - h->value.now);
}

/* ---- trials ---- */

static fw_status run(parameter_search *h, double at, fw_verdict_look look) {
    const char *value = fw_verdict_value_text(h->trial->arena, &h->value, at, 12);
    FW_NEED(value);
    const fw_device_set set = {h->value.path, value};
    h->trials++;
    return fw_verdict_trial_restate(h->trial, &set, 1, look);
}

static bool acceptable(const fw_verdict_trial *trial) {
    return trial->decision == FW_ACCEPT && trial->drawn;
}

static fw_status glance(parameter_search *h, double at, sample *out) {
    FW_TRY(run(h, at, FW_LOOK_GLANCE));
    *out = (sample){.at = at,
                    .coarse = fw_verdict_trial_excess(h->trial),
                    .rejected = h->trial->decision == FW_REJECT || !h->trial->drawn};
    return FW_OK;
}

/* judged as any device; then coarsely, at the corner that now governs: what coarse judgements
   are off by */
static fw_status judge(parameter_search *h, double at, sample *out) {
    FW_TRY(run(h, at, FW_LOOK_WHOLE));
    bool accepted = acceptable(h->trial);
    double excess = fw_verdict_trial_excess(h->trial);
    FW_TRY(glance(h, at, out));
    out->judged = true;
    out->accepted = accepted;
    double bias = excess / out->coarse;
    if (bias > 0.5 && bias < 2) h->bias = bias; /* else they are about different things */
    return FW_OK;
}

static double estimate(const parameter_search *h, const sample *l) {
    return l->coarse * h->bias;
}

/* by what is known now of glances, clearly not accepted */
static bool clearly_beyond(const parameter_search *h, const sample *l) {
    return l->rejected || estimate(h, l) > 2 - clear_of_limit;
}

/* ---- between a value that is not accepted and one that may be ---- */

static double rest_of(const parameter_search *h, const sample *far) {
    return fmax(known_to * distance(h, far), as_typed * fabs(h->value.now));
}

/* nothing is left to look at between them */
static bool close_by(const parameter_search *h, const sample *near, const sample *far) {
    double gap = fabs(far->at - near->at), rest = rest_of(h, far);
    return gap <= rest * (1 + 1e-9) || gap <= 1.01 * fw_verdict_value_step(&h->value, rest);
}

/* `at` as a decimal number strictly between; false: there is none */
static bool between(const parameter_search *h, const sample *near, const sample *far, double *at) {
    double step = fw_verdict_value_step(&h->value, rest_of(h, far));
    double low = fmin(near->at, far->at), high = fmax(near->at, far->at);
    *at = fw_verdict_value_rounded(*at, step);
    if (*at <= low + 1e-3 * step) *at = fw_verdict_value_rounded(low + 0.6 * step, step);
    if (*at >= high - 1e-3 * step) *at = fw_verdict_value_rounded(high - 0.6 * step, step);
    return *at > low + 1e-3 * step && *at < high - 1e-3 * step;
}

/* where the secant of ln(utilisation) meets 0; the middle where it does not, or that is asked
   for */
static double root(const parameter_search *h, const sample *near, const sample *far, bool halve,
                   double beside) {
    double gap = far->at - near->at, a = log(estimate(h, near)), b = log(estimate(h, far));
    if (halve || !(b < 0) || isnan(a)) return near->at + 0.5 * gap;
    if (a <= 0) return near->at + copysign(rest_of(h, far), gap); /* it was judged: only just not */
    double t = a / (a - b) + beside * rest_of(h, far) / fabs(gap);
    return near->at + fmin(fmax(t, 0.02), 0.98) * gap;
}

/* brings both together by glances */
static fw_status approach(parameter_search *h, sample *near, sample *far) {
    double beside = 0.4, before = HUGE_VAL;
    while (!spent(h) && !close_by(h, near, far)) {
        double gap = fabs(far->at - near->at);
        double at = root(h, near, far, gap > 0.5 * before, beside);
        sample middle;
        before = gap;
        if (!between(h, near, far, &at)) return FW_OK;
        FW_TRY(glance(h, at, &middle));
        bool in = !middle.rejected && estimate(h, &middle) <= 1;
        beside = in ? -0.4 : 0.4; /* the other side is to come closer */
        *(in ? far : near) = middle;
    }
    return FW_OK;
}

/* from an accepted value inward until one is not, in growing steps; near: not accepted */
static fw_status tighten(parameter_search *h, sample near, sample *far) {
    double stride = 1;
    while (!spent(h)) {
        if (near.judged && close_by(h, &near, far)) return FW_OK;
        double gap = far->at - near.at, step = fw_verdict_value_step(&h->value, rest_of(h, far));
        double whole = step * floor(stride * rest_of(h, far) / step + 1e-9);
        double at = far->at - copysign(fmin(fmax(whole, step), 0.5 * fabs(gap)), gap);
        sample inner;
        if (!between(h, &near, far, &at)) return FW_OK;
        FW_TRY(glance(h, at, &inner)); /* what it rejects needs no closer look */
        if (clearly_beyond(h, &inner))
            inner.judged = true;
        else
            FW_TRY(judge(h, at, &inner));
        if (inner.accepted)
            *far = inner, stride *= 2;
        else
            near = inner, stride = fmax(stride / 2, 1);
    }
    return FW_OK;
}

/* a step from the limit towards `outer`: right at it a verdict takes the closest of all looks, and
   may have to leave it open all the same */
static fw_status step_out(parameter_search *h, const sample *outer, sample *far) {
    double rest = rest_of(h, far), at = far->at + copysign(rest, outer->at - far->at);
    sample further;
    if (spent(h) || !between(h, far, outer, &at)) return FW_OK;
    FW_TRY(glance(h, at, &further));
    if (!further.rejected) *far = further;
    return FW_OK;
}

/* the limit between near (not accepted) and *far (may be). far->accepted says whether it was
   found */
static fw_status enclose(parameter_search *h, sample near, sample *far) {
    const sample outer = *far;
    while (!spent(h)) {
        sample inner = near;
        if (estimate(h, far) <= 1) FW_TRY(approach(h, &inner, far));
        if (estimate(h, far) > clear_of_limit) FW_TRY(step_out(h, &outer, far));
        FW_TRY(judge(h, far->at, far));
        if (far->accepted) {
            inner.judged = inner.judged || clearly_beyond(h, &inner);
            return tighten(h, inner.judged ? inner : near, far);
        }
        if (far->at == outer.at) return FW_OK;
        near = *far; /* glances were too kind: further out, by what is known now */
        FW_TRY(glance(h, outer.at, far));
        if (far->rejected) return FW_OK;
    }
    return FW_OK;
}

/* ---- outward ---- */

/* the value at a distance on one side, at most the end of that side */
static double on_side(const parameter_search *h, int side, double away) {
    double at = fw_verdict_value_rounded(h->value.now + side * away,
                                         fw_verdict_value_step(&h->value, 0.05 * away));
    return fmin(fmax(at, h->value.low), h->value.high);
}

/* distances of the values looked at: the first a tenth of the value, or less of a small range */
static int rings(const parameter_search *h, double *away) {
    double first = fmin(h->value.range / 8, fmax(0.1 * fabs(h->value.now), 1e-3 * h->value.range));
    first = fmax(first, h->value.digit);
    int n = (int)ceil(log(h->value.range / first) / log(ring_factor) - 1e-9) + 1;
    n = n < FEWEST_RINGS ? FEWEST_RINGS : n > MOST_RINGS ? MOST_RINGS : n;
    for (int i = 0; i < n; i++)
        away[i] = first * pow(h->value.range / first, i / (double)(n - 1));
    return n;
}

/* one value further out; where it may be accepted, the limit before it. found->accepted: it was */
static fw_status sample_further(parameter_search *h, double at, const sample *before,
                                sample *found) {
    FW_TRY(glance(h, at, found));
    if (found->rejected || estimate(h, found) > worth_refining) return FW_OK;
    return enclose(h, *before, found);
}

/* the other side, not yet looked at as far out as `best`: something there may be nearer */
static fw_status sample_other_side(parameter_search *h, int side, const sample *before,
                                   sample *best) {
    double away = distance(h, best), at = on_side(h, side, away);
    sample there;
    if (spent(h) || fabs(at - h->value.now) > away) return FW_OK;
    if (fabs(at - before->at) < h->value.digit) return FW_OK;
    FW_TRY(sample_further(h, at, before, &there));
    if (there.accepted && distance(h, &there) < away) *best = there;
    return FW_OK;
}

static fw_status search(parameter_search *h, double excess, sample *best) {
    double away[MOST_RINGS];
    int n = rings(h, away);
    sample last[2] = {{.at = h->value.now, .coarse = excess, .judged = true},
                      {.at = h->value.now, .coarse = excess, .judged = true}};
    for (int i = 0; i < n; i++) {
        int first = last[0].coarse <= last[1].coarse ? 0 : 1; /* the side that got better */
        for (int k = 0; k < 2; k++) {
            int s = k == 0 ? first : !first;
            double at = on_side(h, s == 0 ? 1 : -1, away[i]);
            if (at == last[s].at || spent(h)) continue; /* at its end */
            sample now;
            FW_TRY(sample_further(h, at, &last[s], &now));
            if (!now.accepted) {
                last[s] = now;
                continue;
            }
            *best = now;
            return k == 1 ? FW_OK : sample_other_side(h, s == 0 ? -1 : 1, &last[!s], best);
        }
    }
    return FW_OK;
}

/* ---- one parameter ---- */

static fw_status report(const parameter_search *h, const sample *best,
                        fw_verdict_parameter_advice *out) {
    fw_arena *arena = h->trial->arena;
    const char *now = fw_verdict_value_text(h->trial->arena, &h->value, h->value.now, 6);
    const char *low = fw_verdict_value_text(h->trial->arena, &h->value, h->value.low, 6),
               *high = fw_verdict_value_text(h->trial->arena, &h->value, h->value.high, 6);
    FW_NEED(now && low && high ? now : NULL);
    out->low = fw_quantity_unit_to_si(&h->value.unit, h->value.low);
    out->high = fw_quantity_unit_to_si(&h->value.unit, h->value.high);
    out->trials = h->trials;
    out->ended = !best->accepted && spent(h);
    if (out->ended) {
        FW_NEED(
            out->text = fw_arena_printf(
                arena,
                "%s: no value from %s to %s was found in the time that a search is given; now %s",
                out->name, low, high, now));
        return FW_OK;
    }
    if (!best->accepted) {
        out->found = FW_PARAMETER_NONE;
        FW_NEED(out->text = fw_arena_printf(
                    arena,
                    "%s: no value from %s to %s was found with which the design is accepted and "
                    "can be drawn; now %s",
                    out->name, low, high, now));
        return FW_OK;
    }
    out->found = FW_PARAMETER_ACCEPTS;
    out->to = fw_quantity_unit_to_si(&h->value.unit, best->at);
    out->change = fabs(out->to - out->from) / fabs(out->from);
    FW_NEED(out->value_text = fw_verdict_value_text(h->trial->arena, &h->value, best->at, 12));
    char share[32] = "";
    fw_percent_text(share, sizeof share, out->change);
    bool known = out->from > 0;
    FW_NEED(out->text = fw_arena_printf(arena, "%s: %s is accepted; now %s%s%s%s", out->name,
                                        out->value_text, now, known ? " (" : "", known ? share : "",
                                        !known                ? ""
                                        : out->to > out->from ? " % more)"
                                                              : " % less)"));
    return FW_OK;
}

static fw_status begin(fw_verdict_trial *trial, const fw_device_parameter *p, parameter_search *h,
                       bool *ok) {
    *h = (parameter_search){.trial = trial, .bias = 1};
    return fw_verdict_value_of_parameter(trial, p, &h->value, ok);
}

/* share: of the work that is left, for this parameter */
static fw_status advise_on(fw_verdict_trial *trial, const fw_device_parameter *p, double excess,
                           int left, double share, fw_verdict_parameter_advice *out) {
    *out = (fw_verdict_parameter_advice){.name = p->name,
                                         .found = FW_PARAMETER_NOT_LOOKED,
                                         .from = p->value,
                                         .to = (double)NAN,
                                         .low = (double)NAN,
                                         .high = (double)NAN,
                                         .change = (double)NAN};
    parameter_search h;
    bool ok = false;
    if (left > 0) FW_TRY(begin(trial, p, &h, &ok));
    if (ok) {
        sample best = {0};
        h.most_work = trial->work + share * (most_work - trial->work);
        FW_TRY(search(&h, excess, &best));
        return report(&h, &best, out);
    }
    const char *why = left > 0 ? "state its min and max to say how far it may go"
                               : "there are more parameters than a search has time for";
    FW_NEED(out->text = fw_arena_printf(trial->arena, "%s: no value was tried: %s", p->name, why));
    return FW_OK;
}

/* what accepts first, then what was looked at in vain, then what was not looked at */
static int place_of(fw_verdict_parameter_found found) {
    switch (found) {
    case FW_PARAMETER_ACCEPTS:
        return 0;
    case FW_PARAMETER_NONE:
        return 1;
    case FW_PARAMETER_NOT_LOOKED:
        break;
    }
    return 2;
}

/* of those that accept the smallest change first */
static int by_change(const void *a, const void *b) {
    const fw_verdict_parameter_advice *p = a, *q = b;
    int order = fw_order_wholes(place_of(p->found), place_of(q->found));
    if (order == 0 && p->found == FW_PARAMETER_ACCEPTS)
        order = fw_order_doubles(p->change, q->change);
    return order ? order : strcmp(p->name, q->name);
}

fw_status fw_verdict_change_parameters(fw_verdict_trial *trial, fw_verdict *out) {
    const fw_device *device = trial->device;
    int left = MOST_IN_ALL, n = device->nparameter;
    if (n == 0) return FW_OK;
    FW_NEED(out->parameter = fw_arena_array(trial->arena, fw_verdict_parameter_advice, (size_t)n));
    const double excess = fw_verdict_trial_excess(trial);
    for (int i = 0; i < n;
         i++) { /* what one finds to be the worst corner, the next looks at first */
        FW_TRY(advise_on(trial, &device->parameter[i], excess, left, 1.0 / (n - i),
                         &out->parameter[i]));
        left -= out->parameter[i].trials;
    }
    out->nparameter = n;
    qsort(out->parameter, (size_t)n, sizeof *out->parameter, by_change);
    return FW_OK;
}
