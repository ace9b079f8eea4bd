/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smallest change of one parameter that is accepted.

   In: a device that is not accepted, and a way to read it again with another value of a
   parameter.

   Out: of every parameter the value nearest to the present one that accepts, as a text for
   --set, or that none was found.

   Method: "the device with the value x is accepted" is true or false and need not be monotonous.
   Looked at are, on both sides of the present value and outward, values whose distances grow by a
   constant factor (1.5, or what 9 of them need) up to the bounds, where they are stated, else to a
   quarter and to four times the value. The nearest ones are looked at of all parameters first:
   those go first that may do with the least change by the power of x that they show. A side on
   which things get worse is looked at where the other one was in vain, and not between its
   nearest value and its end where they are worse still there; nor is one that gets better and
   is beyond the limit at its end all the same; a parameter with which what is furthest from its
   limit does not go is left. These looks are glances: the drawn device, and the corner of its
   flow that is worst so far, at coarse accuracy; what they reject is rejected. Between the first that may be
   accepted and the one before it the limit is enclosed by glances: by the secant of
   ln(utilisation), straight where that goes with a power of x, or by halving where the secant
   gains less than half. There the whole verdict is asked, on both sides of the limit, and tells
   what coarse judgements are off by; until a value that is accepted and one that is not are
   within 1 % of the change, a thousandth of the value, or one unit of the last digit. All values
   are decimal numbers in the unit as written; what is printed was judged as printed.

   Validity: an interval that accepts and lies between two values looked at is missed, and so is
   one nearer than the first value that accepts. What a glance puts more than 5 % beyond the
   limit is not looked at more closely. Nothing below a ten-thousandth of the range is resolved.

   Cost: at most MOST_TRIALS looks for a parameter, and most_work evaluations of hinges for all,
   0.7 of what is left for each; usually 5 to 20 looks, of which two to four are whole verdicts.
   What was not settled by then is said to be so.

   Source: regula falsi with halving: Dekker, in Dejon & Henrici (eds), Constructive Aspects of
   the Fundamental Theorem of Algebra, 1969.

   Test: tests/unit/plan/test_advice.c, tests/cli/test_advice.py. */
#include "base/sort.h"
#include "verdict/advice.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* evaluations of hinges of all looks: some seconds. A scene of many periods takes more for one */
static const double most_work = 1.5e7;
static const double at_first =
    0.5; /* of what is left: for the values beside all, for one parameter */
enum { MOST_TRIALS = 40, MOST_PARAMETERS = 30, FEWEST_RINGS = 4, MOST_RINGS = 9 };
/* the change is known to this part of it */
static const double known_to = 0.01;
/* and the value to this part of it: of a small change nobody types all digits */
static const double as_typed = 1e-3;
/* a coarse judgement may be off by less than this: refinement pays */
static const double worth_refining = 1.05;
static const double clear_of_limit = 0.997; /* coarsely */
static const double ring_factor = 1.5;
static const double well_beyond = 1.2; /* of the limit: what is only guessed at */
static const double unchanged = 1e-6;  /* a smaller difference is of rounding */

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
    sample nearest;   /* to its limit, of what was drawn; coarse infinite: nothing was */
    double excess;    /* of the present value */
    bool idle;        /* what is furthest from its limit does not go with it */
} parameter_search;

/* what the work of all trials may come to behind this search */
static double limit_of(const fw_verdict_trial *trial) {
    return fmin(trial->work + most_work, trial->most_work);
}

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
    if (h->trial->drawn && out->coarse < h->nearest.coarse) h->nearest = *out;
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
    bool jumps = false;
    while (!spent(h) && !close_by(h, near, far)) {
        const double gap = fabs(far->at - near->at);
        const bool halve = jumps || gap > 0.5 * before;
        double at = root(h, near, far, halve, beside);
        sample middle;
        before = gap;
        if (!between(h, near, far, &at)) return FW_OK;
        FW_TRY(glance(h, at, &middle));
        bool in = !middle.rejected && estimate(h, &middle) <= 1;
        beside = in ? -0.4 : 0.4; /* the other side is to come closer */
        sample *side = in ? far : near;
        jumps = jumps || (!halve && fw_verdict_jumps(log(side->coarse), log(middle.coarse)));
        *side = middle;
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
    double kind = 0.005; /* by how much glances are too kind, at least: doubled each time */
    for (;;) {           /* what was found by glances is judged even where the time is over */
        sample inner = near;
        if (estimate(h, far) <= 1) FW_TRY(approach(h, &inner, far));
        if (estimate(h, far) > clear_of_limit) FW_TRY(step_out(h, &outer, far));
        FW_TRY(judge(h, far->at, far));
        if (far->accepted) {
            inner.judged = inner.judged || clearly_beyond(h, &inner);
            return tighten(h, inner.judged ? inner : near, far);
        }
        if (far->at == outer.at) return FW_OK;
        if (spent(h)) return judge(h, outer.at, far); /* of what may be, the surest */
        near = *far; /* glances were too kind: further out, by what is known now */
        if (estimate(h, far) <= 1) h->bias *= (1 + kind) / estimate(h, far), kind *= 2;
        FW_TRY(glance(h, outer.at, far));
        if (far->rejected) return FW_OK;
    }
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

/* what a look at one value further out says; where it may be accepted, the limit before it.
   found->accepted: it was */
static fw_status follow(parameter_search *h, const sample *before, sample *found) {
    if (found->rejected || estimate(h, found) > worth_refining) return FW_OK;
    return enclose(h, *before, found);
}

static fw_status sample_further(parameter_search *h, double at, const sample *before,
                                sample *found) {
    FW_TRY(glance(h, at, found));
    return follow(h, before, found);
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

/* ---- both sides ---- */

/* beyond a hundred times the limit, or without a number, other things are wrong */
static bool comparable(const sample *l) {
    return l->coarse < 100;
}

static bool is_beyond(const parameter_search *h, const sample *l) {
    return l->rejected || estimate(h, l) > worth_refining;
}

/* what is furthest from its limit is the same on both sides */
static bool is_flat(const sample l[2]) {
    return comparable(&l[0]) && comparable(&l[1]) &&
           fabs(l[0].coarse - l[1].coarse) <= unchanged * l[0].coarse;
}

/* one side, outward */
typedef struct outward {
    int side;          /* 1: above, -1: below the present value */
    sample near, last; /* the first value looked at there, the furthest one */
    sample end;        /* where the side ends, if that was looked at */
    bool ended, left;  /* it was; nothing is looked for between last and end */
} outward;

/* Nothing is looked for between two values where what is wrong goes one way from the other side's
   nearest value over this side's to its end, and is beyond its limit there, too. */
static fw_status look_at_end(parameter_search *h, const outward *other, outward *o) {
    const double at = on_side(h, o->side, h->value.range), c = o->near.coarse;
    if (o->ended || spent(h) || at == o->last.at) return FW_OK;
    FW_TRY(glance(h, at, &o->end));
    o->ended = true;
    const bool beyond = is_beyond(h, &o->near) && is_beyond(h, &o->end);
    /* the present value was judged otherwise: as far as it had to be to be rejected */
    const bool worse = other->near.at != h->value.now && c >= (1 - unchanged) * other->near.coarse;
    o->left = beyond && (worse ? !(o->end.coarse < (1 - unchanged) * c)
                               : comparable(&o->end) && o->end.coarse < c);
    return FW_OK;
}

/* by the power of x through the two values before it, the end of this side is beyond its limit */
static bool falls_short(const parameter_search *h, const outward *other, const outward *o) {
    const sample *inner = o->last.at == o->near.at ? &other->near : &o->near, *outer = &o->last;
    if (!comparable(inner) || !comparable(outer) || !(inner->at * outer->at > 0)) return false;
    const double power = log(outer->coarse / inner->coarse) / log(outer->at / inner->at);
    const double end = on_side(h, o->side, h->value.range) / outer->at;
    return end > 0 && h->bias * outer->coarse * pow(end, power) > well_beyond;
}

/* the next value of a side; o->last.accepted: it, or one before it, was */
static fw_status step_outward(parameter_search *h, double away, outward *o) {
    const double at = on_side(h, o->side, away);
    const sample before = o->last;
    if (at == before.at || o->left || spent(h)) return FW_OK; /* at its end */
    if (o->ended && at == o->end.at)
        o->last = o->end;
    else
        FW_TRY(glance(h, at, &o->last));
    return follow(h, &before, &o->last);
}

/* both sides in turn, or that which got better first and the other one where it is in vain */
static fw_status go_outward(parameter_search *h, outward o[2], sample *best) {
    double away[MOST_RINGS];
    const int n = rings(h, away) - 1; /* without the nearest */
    const bool one_way = comparable(&o[0].near) && comparable(&o[1].near);
    for (int m = 0; m < 2 * n; m++) {
        const int i = 1 + (one_way ? m % n : m / 2), k = one_way ? m / n : m % 2;
        if (one_way && (k == 1 || falls_short(h, &o[1], &o[0])))
            FW_TRY(look_at_end(h, &o[!k], &o[k]));
        FW_TRY(step_outward(h, away[i], &o[k]));
        if (!o[k].last.accepted) continue;
        *best = o[k].last;
        return k == 1 ? FW_OK : sample_other_side(h, o[1].side, &o[1].last, best);
    }
    return FW_OK;
}

/* first: the nearest values looked at, above and below the present one, whose excess is `excess` */
static fw_status search(parameter_search *h, const sample first[2], double excess, sample *best) {
    const int better = first[0].coarse <= first[1].coarse ? 0 : 1; /* the side that got better */
    const sample now = {.at = h->value.now, .coarse = excess, .judged = true};
    outward o[2];
    for (int k = 0; k < 2; k++) {
        const int s = k == 0 ? better : !better;
        o[k] = (outward){.side = s == 0 ? 1 : -1, .near = first[s], .last = first[s]};
    }
    for (int k = 0; k < 2; k++) {
        if (o[k].near.at == h->value.now) continue; /* at its end */
        FW_TRY(follow(h, &now, &o[k].last));
        if (!o[k].last.accepted) continue;
        *best = o[k].last;
        return k == 1 ? FW_OK : sample_other_side(h, o[1].side, &now, best);
    }
    if (is_flat(first))
        for (int k = 0; k < 2; k++)
            FW_TRY(look_at_end(h, &o[!k], &o[k]));
    h->idle = o[0].left && o[1].left;
    return h->idle ? FW_OK : go_outward(h, o, best);
}

/* ---- one parameter ---- */

/* "; the nearest that was looked at, 40 uN, misses what is asked by a factor of 61 (now 120)"; "": nothing is to be said */
static const char *nearest_text(const parameter_search *h) {
    char times[32], now[32];
    const char *value = fw_verdict_value_text(h->trial->arena, &h->value, h->nearest.at, 6);
    if (!value) return NULL;
    if (!isfinite(h->nearest.coarse) || !(h->nearest.coarse > 1) || !(h->excess > 1)) return "";
    if (!(h->nearest.coarse < (1 - unchanged) * h->excess))
        return "; none that was looked at comes nearer to what is asked";
    return fw_arena_printf(
        h->trial->arena,
        "; the nearest that was looked at, %s, misses what is asked by a factor of %s (now %s)",
        value, fw_number_text(times, sizeof times, h->nearest.coarse, 3),
        fw_number_text(now, sizeof now, h->excess, 3));
}

static fw_status report(const parameter_search *h, const sample *best,
                        fw_verdict_parameter_advice *out) {
    fw_arena *arena = h->trial->arena;
    const char *now = fw_verdict_value_text(h->trial->arena, &h->value, h->value.now, 6);
    const char *low = fw_verdict_value_text(h->trial->arena, &h->value, h->value.low, 6),
               *high = fw_verdict_value_text(h->trial->arena, &h->value, h->value.high, 6);
    const char *nearest = nearest_text(h);
    FW_NEED(now && low && high ? nearest : NULL);
    out->low = fw_quantity_unit_to_si(&h->value.unit, h->value.low);
    out->high = fw_quantity_unit_to_si(&h->value.unit, h->value.high);
    out->trials = h->trials;
    out->ended = spent(h);
    if (!best->accepted && out->ended) {
        FW_NEED(
            out->text = fw_arena_printf(
                arena,
                "%s: no value from %s to %s was found in the time that a search is given; now %s%s",
                out->name, low, high, now, nearest));
        return FW_OK;
    }
    if (h->idle) {
        out->found = FW_PARAMETER_NONE;
        FW_NEED(
            out->text = fw_arena_printf(
                arena,
                "%s: what is furthest from being accepted does not go with it (looked at from %s "
                "to %s); now %s",
                out->name, low, high, now));
        return FW_OK;
    }
    if (!best->accepted) {
        out->found = FW_PARAMETER_NONE;
        FW_NEED(out->text =
                    fw_arena_printf(arena,
                                    "%s: no value from %s to %s was found with which the design is "
                                    "accepted%s; now %s%s",
                                    out->name, low, high,
                                    h->trial->shapeless ? "" : " and can be drawn", now, nearest));
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
    *h = (parameter_search){.trial = trial, .bias = 1, .nearest = {.coarse = HUGE_VAL}};
    return fw_verdict_value_of_parameter(trial, p, &h->value, ok);
}

typedef struct candidate {
    const fw_device_parameter *parameter;
    parameter_search h;
    sample first[2]; /* the nearest values, above and below */
    double need;     /* how large a change of it may do, by these */
    bool ok;
} candidate;

/* by the power of x through the present value and the better one of those beside it */
static double need_of(const candidate *c, double excess) {
    const sample *l = &c->first[c->first[0].coarse <= c->first[1].coarse ? 0 : 1];
    if (is_flat(c->first)) return HUGE_VAL;
    if (!comparable(l)) return 1e3;
    const double rate = log(excess / l->coarse) / distance(&c->h, l) * c->h.value.range;
    return l->coarse <= 1 ? 0 : rate > 0 ? fmin(log(l->coarse) / rate, 1e3) : 1e3;
}

/* the nearest values on both sides are looked at */
static fw_status look_beside(candidate *c, double excess) {
    parameter_search *h = &c->h;
    double away[MOST_RINGS];
    rings(h, away);
    for (int k = 0; k < 2; k++) {
        const double at = on_side(h, k == 0 ? 1 : -1, away[0]);
        c->first[k] = (sample){.at = h->value.now, .coarse = excess, .rejected = true};
        if (at != h->value.now && !spent(h)) FW_TRY(glance(h, at, &c->first[k]));
    }
    c->need = need_of(c, excess);
    return FW_OK;
}

static fw_status advise_on(candidate *c, double excess, fw_verdict_parameter_advice *out) {
    const fw_device_parameter *p = c->parameter;
    *out = (fw_verdict_parameter_advice){.name = p->name,
                                         .found = FW_PARAMETER_NOT_LOOKED,
                                         .from = p->value,
                                         .to = (double)NAN,
                                         .low = (double)NAN,
                                         .high = (double)NAN,
                                         .change = (double)NAN};
    if (c->ok && c->h.trials > 0) {
        sample best = {0};
        c->h.excess = excess;
        FW_TRY(search(&c->h, c->first, excess, &best));
        return report(&c->h, &best, out);
    }
    out->ended = c->ok;
    const char *why = c->ok ? "the search had taken all the time that it is given"
                            : "state its min and max to say how far it may go";
    FW_NEED(out->text =
                fw_arena_printf(c->h.trial->arena, "%s: no value was tried: %s", p->name, why));
    return FW_OK;
}

/* those that may do with the least change first */
static int by_need(const void *a, const void *b) {
    const candidate *p = a, *q = b;
    const int order = fw_order_doubles(p->need, q->need);
    return order ? order : p->parameter < q->parameter ? -1 : p->parameter > q->parameter;
}

static fw_status candidates(fw_verdict_trial *trial, double excess, candidate *all) {
    const fw_device *d = trial->device;
    const double most = trial->work + at_first * (limit_of(trial) - trial->work);
    for (int i = 0; i < d->nparameter; i++) {
        candidate *c = &all[i];
        *c = (candidate){.parameter = &d->parameter[i], .need = HUGE_VAL};
        FW_TRY(begin(trial, c->parameter, &c->h, &c->ok));
        c->h.most_work = most;
        if (c->ok && i < MOST_PARAMETERS) FW_TRY(look_beside(c, excess));
    }
    qsort(all, (size_t)d->nparameter, sizeof *all, by_need);
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
    const int n = trial->device->nparameter;
    if (n == 0) return FW_OK;
    candidate *all;
    FW_NEED(out->parameter = fw_arena_array(trial->arena, fw_verdict_parameter_advice, (size_t)n));
    FW_NEED(all = fw_arena_array(trial->arena, candidate, (size_t)n));
    const double excess = fw_verdict_trial_excess(trial), limit = limit_of(trial);
    FW_TRY(candidates(trial, excess, all));
    for (int i = 0; i < n;
         i++) { /* what one finds to be the worst corner, the next looks at first */
        const double share = fmax(1.0 / (n - i), at_first);
        all[i].h.most_work = trial->work + share * (limit - trial->work);
        FW_TRY(advise_on(&all[i], excess, &out->parameter[i]));
    }
    out->nparameter = n;
    qsort(out->parameter, (size_t)n, sizeof *out->parameter, by_change);
    return FW_OK;
}
