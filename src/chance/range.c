/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of which only an interval is known: the range of a probability, over the ends of the intervals and, where these may
   not be enough, inside. */
#include "chance/estimate.h"
#include "chance/random.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Halvings of a step of the search. Points that are looked at before it: so many of the inputs' own distribution, every
   second twice as far out, and design points of the corners; steep: those nearest to their limit, of which slopes are
   looked at; settings inside, some of the points at each. SEED_LOOK: of no part of an estimate (estimate.c). */
enum { HALVINGS = 4, OWN = 64, TAILS = 64, STEEP = 16, WITHIN = 8, SEED_LOOK = 1000005 };
#define STEP    0.0625 /* of an interval, of a slope */
#define REACH   2      /* how much steeper it may be elsewhere */
#define NOTHING 1e-3   /* of what the inputs' own points differ by: no slope */

typedef struct hunt {
    fw_arena *arena;
    const fw_chance_limit *limit;
    const fw_chance_unknowns *unknowns;
    const fw_chance_options *options;
    fw_chance_range *out;
    double *setting;
    double *tried; /* (out->settings x (count + 1)) settings, and what was estimated there */
    double *point; /* ((OWN + TAILS) x dimensions) that are looked at */
    size_t points;
} hunt;

static fw_status check(const fw_chance_unknowns *u, const char **why) {
    if (u->count > FW_CHANCE_UNKNOWNS_MOST)
        *why = "more than 10 inputs are unknown, which makes more than 1024 settings of their ends";
    for (size_t i = 0; i < u->count; i++)
        if (!isfinite(u->low[i]) || !isfinite(u->high[i]) || u->low[i] > u->high[i])
            *why = "an interval needs a lower end that is not above its upper end";
    return *why ? FW_INPUT : FW_OK;
}

static double middle(const fw_chance_estimate *e) {
    return (e->probability_low + e->probability_high) / 2;
}

size_t fw_chance_range_looks(size_t count) {
    const size_t corners = (size_t)1 << count;
    return count > 0 ? OWN + corners * (OWN + STEEP * count) : 0;
}

/* its steps stay on a lattice of sixteenths */
size_t fw_chance_range_inside(size_t count) {
    const size_t corners = (size_t)1 << count, rounds = (size_t)4 * HALVINGS * HALVINGS * count;
    size_t lattice = 1;
    for (size_t i = 0; i < count && lattice < rounds + corners; i++)
        lattice *= ((size_t)1 << HALVINGS) + 1;
    if (count == 0) return 0;
    return 1 + (lattice - corners < rounds ? lattice - corners : rounds);
}

/* the estimate at the hunt's setting; the same seed everywhere, so that settings differ by what they do */
static fw_status try_setting(hunt *h, const char **why) {
    fw_chance_estimate e;
    fw_mark mark = fw_arena_mark(h->arena);
    h->unknowns->set(h->limit->context, h->setting);
    FW_TRY(fw_chance_estimate_run(h->arena, h->limit, h->options, &e, why));
    fw_chance_range *out = h->out;
    size_t bytes = h->unknowns->count * sizeof *h->setting;
    bool least = !out->settings || middle(&e) < middle(&out->least);
    bool most = !out->settings || middle(&e) > middle(&out->most);
    if (least) {
        out->least = e;
        memcpy(out->least_at, h->setting, bytes);
    }
    if (most) {
        out->most = e;
        memcpy(out->most_at, h->setting, bytes);
    }
    double *tried = h->tried + out->settings * (h->unknowns->count + 1);
    memcpy(tried, h->setting, bytes);
    tried[h->unknowns->count] = middle(&e);
    out->low = out->settings ? fmin(out->low, e.low) : e.low;
    out->high = out->settings ? fmax(out->high, e.high) : e.high;
    out->settings++;
    out->evaluations += e.evaluations;
    const size_t n = h->limit->dimensions,
                 most_of = h->unknowns->count < 6 ? 2 : 1; /* of each corner, the nearest */
    for (size_t k = 0; k < e.points && k < most_of && h->points < OWN + TAILS; k++)
        memcpy(h->point + h->points++ * n, e.point[k].u, n * sizeof *h->point);
    if (!least && !most) fw_arena_rewind(h->arena, mark); /* its words and points are not wanted */
    return FW_OK;
}

static void to_corner(const hunt *h, size_t corner, double *setting) {
    const fw_chance_unknowns *u = h->unknowns;
    for (size_t i = 0; i < u->count; i++)
        setting[i] = corner >> i & 1 ? u->high[i] : u->low[i];
}

static fw_status corners(hunt *h, const char **why) {
    for (size_t corner = 0; corner < (size_t)1 << h->unknowns->count; corner++) {
        to_corner(h, corner, h->setting);
        FW_TRY(try_setting(h, why));
    }
    return FW_OK;
}

/* ---- are the ends enough? ---- */

typedef struct look {
    double *at;     /* (corners x points) what they have at the corners */
    double *value;  /* (count x STEEP) room, or of points */
    double *some;   /* (STEEP x dimensions) room for those that are nearest to their limit */
    double nothing; /* less than this is no change */
    bool *rises,
        *falls; /* (count) does any that matters have more, or less, the more there is of an unknown? */
    double
        *beyond_at; /* (count) where a point that matters has most beyond what it has at all ends */
    double beyond;  /* by so much; 0: none */
} look;

static fw_status values_at(hunt *h, size_t count, const double *u, double *value) {
    h->unknowns->set(h->limit->context, h->setting);
    h->out->looked += count;
    return h->limit->g(h->limit->context, 0, count, u, value);
}

/* what the points of the inputs' own distribution differ by, the most at any corner */
static double spread_of(const look *l, size_t corners, size_t points) {
    double most = 0;
    for (size_t c = 0; c < corners; c++) {
        double sum = 0, square = 0, n = 0;
        for (size_t k = 0; k < OWN; k += 2) {
            const double v = l->at[c * points + k];
            if (isfinite(v)) sum += v, square += v * v, n++;
        }
        if (n > 1) most = fmax(most, sqrt(fmax(square / n - sum / n * (sum / n), 0)));
    }
    return most;
}

/* the points nearest to their limit at a corner, the nearest first: how many */
static size_t nearest(const double *value, size_t points, size_t order[STEEP]) {
    size_t n = 0;
    for (size_t k = 0; k < points; k++) {
        if (!isfinite(value[k])) continue;
        size_t at = n;
        while (at > 0 && fabs(value[k]) < fabs(value[order[at - 1]]))
            at--;
        if (at == STEEP) continue;
        if (n < STEEP) n++;
        memmove(order + at + 1, order + at, (n - 1 - at) * sizeof *order);
        order[at] = k;
    }
    return n;
}

/* Slopes at a corner of those that are nearest to their limit. One matters where it gets there, within the intervals, as
   steep as twice that. */
static fw_status slopes(hunt *h, look *l, size_t corner) {
    const fw_chance_unknowns *u = h->unknowns;
    const size_t n = h->limit->dimensions;
    const double *here = l->at + corner * h->points;
    size_t order[STEEP];
    const size_t steep = nearest(here, h->points, order);
    for (size_t k = 0; k < steep; k++)
        memcpy(l->some + k * n, h->point + order[k] * n, n * sizeof *l->some);
    for (size_t i = 0; i < u->count; i++) {
        const bool above = corner >> i & 1;
        double *value = l->value + i * STEEP;
        to_corner(h, corner, h->setting);
        h->setting[i] += (above ? -STEP : STEP) * (u->high[i] - u->low[i]);
        FW_TRY(values_at(h, steep, l->some, value));
        for (size_t k = 0; k < steep; k++)
            value[k] = (value[k] - here[order[k]]) / (above ? -STEP : STEP);
    }
    for (size_t k = 0; k < steep; k++) {
        double reach = 0;
        for (size_t i = 0; i < u->count; i++)
            if (isfinite(l->value[i * STEEP + k])) reach += REACH * fabs(l->value[i * STEEP + k]);
        if (fabs(here[order[k]]) > reach) continue;
        for (size_t i = 0; i < u->count; i++) {
            l->rises[i] |= l->value[i * STEEP + k] > l->nothing;
            l->falls[i] |= l->value[i * STEEP + k] < -l->nothing;
        }
    }
    return FW_OK;
}

/* Has a point less at this setting inside than at all corners, or more? It matters where it would fail, or hold, with
   twice that, and does not so at all corners. */
static void take_beyond(const hunt *h, look *l, size_t point, double value) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t c = 0; c < (size_t)1 << h->unknowns->count; c++) {
        low = fmin(low, l->at[c * h->points + point]);
        high = fmax(high, l->at[c * h->points + point]);
    }
    const double less = low - value, more = value - high;
    const bool dips = less > l->nothing && high > 0 && value - REACH * less <= 0;
    const bool peaks = more > l->nothing && low <= 0 && value + REACH * more > 0;
    if ((!dips && !peaks) || fmax(less, more) <= l->beyond) return;
    l->beyond = fmax(less, more);
    memcpy(l->beyond_at, h->setting, h->unknowns->count * sizeof *h->setting);
}

/* settings inside, evenly over each interval; an eighth of the points at each, design points at all */
static fw_status within(hunt *h, look *l) {
    static const double way[FW_CHANCE_UNKNOWNS_MOST] = {
        1.0 / WITHIN,    0.4142135623731, 1.7320508075689, 2.2360679774998, 2.6457513110646,
        3.3166247903554, 3.6055512754640, 4.1231056256177, 4.3588989435407, 4.7958315233127};
    const fw_chance_unknowns *u = h->unknowns;
    const size_t n = h->limit->dimensions, each = OWN / WITHIN;
    for (size_t j = 0; j < WITHIN; j++) {
        for (size_t i = 0; i < u->count; i++) {
            const double share = (0.5 + (double)j) * way[i];
            h->setting[i] = u->low[i] + (share - floor(share)) * (u->high[i] - u->low[i]);
        }
        FW_TRY(values_at(h, each, h->point + j * each * n, l->value));
        for (size_t k = 0; k < each; k++)
            take_beyond(h, l, j * each + k, l->value[k]);
        if (h->points == OWN) continue;
        FW_TRY(values_at(h, h->points - OWN, h->point + OWN * n, l->value));
        for (size_t k = OWN; k < h->points; k++)
            take_beyond(h, l, k, l->value[k - OWN]);
    }
    return FW_OK;
}

/* What a probability is at a setting is which points have more than 0, and it changes by those at their limit. Where all of
   these go one way with each unknown at all corners, and none has inside what it has at no corner, the ends are enough: of
   several limits each of which only rises or only falls with an unknown, the one that governs at an end and rises towards
   it was below all others all the way. */
static fw_status are_ends_enough(hunt *h, look *l) {
    const size_t n = h->limit->dimensions, count = h->unknowns->count,
                 corners_n = (size_t)1 << count;
    const uint64_t seed = fw_chance_seed(h->options->seed, SEED_LOOK);
    for (size_t k = 0; k < OWN; k++)
        for (size_t d = 0; d < n; d++)
            h->point[k * n + d] = (double)(1 + k % 2) * fw_chance_normal(seed, k, d);
    const size_t room = STEEP * count > h->points ? STEEP * count : h->points;
    *l = (look){.at = fw_arena_array(h->arena, double, corners_n * h->points),
                .value = fw_arena_array(h->arena, double, room),
                .some = fw_arena_array(h->arena, double, STEEP *n),
                .rises = fw_arena_array(h->arena, bool, count),
                .falls = fw_arena_array(h->arena, bool, count),
                .beyond_at = fw_arena_array(h->arena, double, count)};
    FW_NEED(l->at && l->value && l->some && l->rises && l->falls && l->beyond_at ? l : NULL);
    for (size_t c = 0; c < corners_n; c++) {
        to_corner(h, c, h->setting);
        FW_TRY(values_at(h, h->points, h->point, l->at + c * h->points));
    }
    l->nothing = NOTHING * spread_of(l, corners_n, h->points);
    for (size_t c = 0; c < corners_n; c++)
        FW_TRY(slopes(h, l, c));
    FW_TRY(within(h, l));
    h->out->inside = l->beyond > 0;
    for (size_t i = 0; i < count; i++)
        if (l->rises[i] && l->falls[i]) h->out->inside = true;
    return FW_OK;
}

/* ---- the search ---- */

/* what was estimated at the hunt's setting; NULL: nothing was */
static const double *tried_at(const hunt *h) {
    const size_t count = h->unknowns->count;
    for (size_t k = 0; k < h->out->settings; k++) {
        const double *tried = h->tried + k * (count + 1);
        if (memcmp(tried, h->setting, count * sizeof *tried) == 0) return tried + count;
    }
    return NULL;
}

/* Is a parabola through the best at an end of its interval, what was tried at the hunt's setting, which is `change` worse,
   and at twice that step, best at the end? Else it is so between. */
static bool leads_to_the_end(hunt *h, const double *best, double was, size_t i, double change) {
    const fw_chance_unknowns *u = h->unknowns;
    const double here = h->setting[i];
    if (best[i] != u->low[i] && best[i] != u->high[i]) return false;
    h->setting[i] = best[i] + 2 * (here - best[i]);
    const double *farther = tried_at(h);
    h->setting[i] = here;
    return farther && 4 * change >= fabs(*farther - was);
}

/* one way of one input from the best setting so far; *better: it became the best; *change: at least what differs there */
static fw_status probe(hunt *h, const double *best, const fw_chance_estimate *there, size_t i,
                       double way, bool *better, double *change, const char **why) {
    const fw_chance_unknowns *u = h->unknowns;
    const double was = middle(there);
    size_t bytes = u->count * sizeof *best;
    memcpy(h->setting, best, bytes);
    h->setting[i] = fmin(u->high[i], fmax(u->low[i], best[i] + way * (u->high[i] - u->low[i])));
    *better = false;
    const double *tried = tried_at(h);
    if (!tried) {
        FW_TRY(try_setting(h, why));
        tried = tried_at(h);
        *better = memcmp(best, h->setting, bytes) == 0;
    }
    if (tried && !leads_to_the_end(h, best, was, i, fabs(*tried - was)))
        *change = fmax(*change, fabs(*tried - was));
    return FW_OK;
}

/* Compass search from the best so far: each input up and down by half its interval, then by a quarter, an eighth, a
   sixteenth; what is better is gone on from. Where a quarter or less changes less than half the interval of the estimate,
   what lies between is, of a bend like a parabola, an eighth of that at most, and smaller steps are left out. `best` and `there` are
   those of the least or the most of the range, which follow by themselves. */
static fw_status inside(hunt *h, const double *best, const fw_chance_estimate *there,
                        const char **why) {
    for (int halving = 1; halving <= HALVINGS; halving++) {
        double change = 0;
        bool any = true;
        for (int round = 0; any && round < HALVINGS; round++) {
            any = false;
            for (size_t i = 0; i < h->unknowns->count; i++)
                for (int way = -1; way <= 1; way += 2) {
                    bool better;
                    FW_TRY(probe(h, best, there, i, ldexp(way, -halving), &better, &change, why));
                    any |= better;
                }
        }
        if (halving > 1 && change < (there->high - there->low) / 2) return FW_OK;
    }
    return FW_OK;
}

static fw_status search_inside(hunt *h, const char **why) {
    const fw_chance_side side = h->unknowns->side;
    h->out->inside = true;
    if (side != FW_CHANCE_MOST_ONLY) FW_TRY(inside(h, h->out->least_at, &h->out->least, why));
    return side == FW_CHANCE_LEAST_ONLY ? FW_OK : inside(h, h->out->most_at, &h->out->most, why);
}

/* where points say so; nobody who has a share of them only can tell where to look next */
static fw_status search_where_needed(hunt *h, const char **why) {
    look l;
    FW_TRY(are_ends_enough(h, &l));
    if (!h->out->inside) return FW_OK;
    if (h->limit->apart) {
        *why =
            "an estimate at one value of what is only assumed says which value is looked at next";
        return FW_LIMIT;
    }
    memcpy(h->setting, l.beyond_at, h->unknowns->count * sizeof *h->setting);
    if (l.beyond > 0) FW_TRY(try_setting(h, why));
    return search_inside(h, why);
}

/* The range of a probability over inputs of which only intervals are known: its least and its greatest over all corners,
   and where asked, or where points show that these may not be enough, over a search inside, each estimated with the same
   random numbers. Where the probability rises or falls with each unknown, whatever the others are, the corners are enough;
   of two limits of which one binds at either end the probability is least inside. Output: from the lowest lower end to the
   highest upper end of all settings' intervals. A peak narrower than a sixteenth of an interval, or one that none of the
   points that were looked at shows, may be missed. Cost: 2^count estimates and fw_chance_range_looks() points, the search
   some 10 count estimates more. Source: M. Beer, S. Ferson, V. Kreinovich, Mech. Syst. Signal Process. 37 (2013) 4.
   Test: test_range.c */
fw_status fw_chance_range_run(fw_arena *arena, const fw_chance_limit *limit,
                              const fw_chance_unknowns *unknowns, const fw_chance_options *options,
                              fw_chance_range *out, const char **why) {
    *out = (fw_chance_range){.settings = 0};
    *why = NULL;
    FW_TRY(check(unknowns, why));
    const size_t n = unknowns->count, most = ((size_t)1 << n) + fw_chance_range_inside(n);
    hunt h = {.arena = arena,
              .limit = limit,
              .unknowns = unknowns,
              .options = options,
              .out = out,
              .setting = fw_arena_array(arena, double, n),
              .tried = fw_arena_array(arena, double, most *(n + 1)),
              .point = fw_arena_array(arena, double, (OWN + TAILS) * limit->dimensions),
              .points = OWN};
    FW_NEED(h.setting && h.tried && h.point ? h.setting : NULL);
    FW_NEED(out->least_at = fw_arena_array(arena, double, n));
    FW_NEED(out->most_at = fw_arena_array(arena, double, n));
    FW_TRY(corners(&h, why));
    switch (unknowns->search) {
    case FW_CHANCE_ENDS:
        return FW_OK;
    case FW_CHANCE_INSIDE:
        return search_inside(&h, why);
    case FW_CHANCE_WHERE_NEEDED:
        return search_where_needed(&h, why);
    }
    return FW_INTERNAL;
}
