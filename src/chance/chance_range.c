/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chance/estimate.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { UNKNOWNS_MOST = 10, HALVINGS = 4 };

typedef struct hunt {
    fw_arena *arena;
    const fw_chance_limit *limit;
    const fw_chance_unknowns *unknowns;
    const fw_chance_options *options;
    fw_chance_range *out;
    double *setting;
} hunt;

static fw_status check(const fw_chance_unknowns *u, const char **why) {
    if (u->count > UNKNOWNS_MOST)
        *why = "more than 10 inputs are unknown, which makes more than 1024 settings of their ends";
    for (size_t i = 0; i < u->count; i++)
        if (!isfinite(u->low[i]) || !isfinite(u->high[i]) || u->low[i] > u->high[i])
            *why = "an interval needs a lower end that is not above its upper end";
    return *why ? FW_INPUT : FW_OK;
}

static double middle(const fw_chance_estimate *e) {
    return (e->probability_low + e->probability_high) / 2;
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
    out->low = out->settings ? fmin(out->low, e.low) : e.low;
    out->high = out->settings ? fmax(out->high, e.high) : e.high;
    out->settings++;
    out->evaluations += e.evaluations;
    if (!least && !most) fw_arena_rewind(h->arena, mark); /* its words and points are not wanted */
    return FW_OK;
}

static fw_status corners(hunt *h, const char **why) {
    const fw_chance_unknowns *u = h->unknowns;
    for (size_t corner = 0; corner < (size_t)1 << u->count; corner++) {
        for (size_t i = 0; i < u->count; i++)
            h->setting[i] = corner >> i & 1 ? u->high[i] : u->low[i];
        FW_TRY(try_setting(h, why));
    }
    return FW_OK;
}

/* one way of one input from the best setting so far; *better: it became the best */
static fw_status probe(hunt *h, const double *best, size_t i, double way, bool *better,
                       const char **why) {
    const fw_chance_unknowns *u = h->unknowns;
    size_t bytes = u->count * sizeof *best;
    memcpy(h->setting, best, bytes);
    h->setting[i] = fmin(u->high[i], fmax(u->low[i], best[i] + way * (u->high[i] - u->low[i])));
    *better = false;
    if (h->setting[i] == best[i]) return FW_OK;
    FW_TRY(try_setting(h, why));
    *better = memcmp(best, h->setting, bytes) == 0;
    return FW_OK;
}

/* Compass search from a corner: each input up and down by half its interval, then by a quarter, an eighth, a sixteenth;
   what is better is gone on from. `best` is least_at or most_at, which follows by itself. */
static fw_status inside(hunt *h, const double *best, const char **why) {
    for (int halving = 1; halving <= HALVINGS; halving++) {
        bool any = true;
        for (int round = 0; any && round < HALVINGS; round++) {
            any = false;
            for (size_t i = 0; i < h->unknowns->count; i++)
                for (int way = -1; way <= 1; way += 2) {
                    bool better;
                    FW_TRY(probe(h, best, i, ldexp(way, -halving), &better, why));
                    any |= better;
                }
        }
    }
    return FW_OK;
}

/* The range of a probability over inputs of which only intervals are known: its least and its greatest over all corners,
   and where asked over a search inside, each estimated with the same random numbers. Where the probability rises or falls
   with each unknown, whatever the others are, the corners are enough. Output: from the lowest lower end to the highest
   upper end of all settings' intervals. Cost: 2^count estimates, the search some 20 count more. Source: M. Beer, S. Ferson,
   V. Kreinovich, Mech. Syst. Signal Process. 37 (2013) 4. Test: test_range.c */
fw_status fw_chance_range_run(fw_arena *arena, const fw_chance_limit *limit,
                              const fw_chance_unknowns *unknowns, const fw_chance_options *options,
                              fw_chance_range *out, const char **why) {
    *out = (fw_chance_range){.settings = 0};
    *why = NULL;
    FW_TRY(check(unknowns, why));
    hunt h = {arena, limit, unknowns, options, out, fw_arena_array(arena, double, unknowns->count)};
    FW_NEED(h.setting);
    FW_NEED(out->least_at = fw_arena_array(arena, double, unknowns->count));
    FW_NEED(out->most_at = fw_arena_array(arena, double, unknowns->count));
    FW_TRY(corners(&h, why));
    if (unknowns->search == FW_CHANCE_ENDS) return FW_OK;
    FW_TRY(inside(&h, out->least_at, why));
    return inside(&h, out->most_at, why);
}
