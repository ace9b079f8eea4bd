/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hold windows as a simple temporal network (Dechter, Meiri, Pearl, Artificial Intelligence 49
   (1991) 61): nodes are the starts of the tasks of one wafer, an arc i -> j of weight w says
   start_j >= start_i + w. A least pause is an arc forwards, a longest one an arc backwards of
   negative weight. The network can be kept exactly when no cycle has a positive weight. */
#include "schedule/place.h"
#include <math.h>

typedef struct arc {
    int from, to, hold; /* hold: index; -1: the flow */
    bool back;          /* a longest time */
    double weight_s;
} arc;

static double lasts(const fw_schedule_shop *shop, int task, bool latest) {
    return latest ? shop->task[task].latest_s : shop->task[task].duration_s;
}

static fw_status arcs_of(fw_arena *arena, const fw_schedule_shop *shop, bool latest, arc **list,
                         int *n) {
    FW_NEED(*list = fw_arena_array(arena, arc, (size_t)(shop->ntask + 2 * shop->nhold)));
    *n = 0;
    for (int i = 0; i + 1 < shop->ntask; i++)
        (*list)[(*n)++] = (arc){i, i + 1, -1, false, lasts(shop, i, latest)};
    for (int i = 0; i < shop->nhold; i++) {
        const fw_schedule_hold *h = &shop->hold[i];
        double p = lasts(shop, h->from, latest);
        if (h->min_s > 0.0) (*list)[(*n)++] = (arc){h->from, h->to, i, false, p + h->min_s};
        if (h->max_s < (double)INFINITY)
            (*list)[(*n)++] = (arc){h->to, h->from, i, true, -(p + h->max_s)};
    }
    return FW_OK;
}

static void put_part(fw_text *out, const char *before, const char *id, const char *then,
                     double seconds) {
    fw_text_printf(out, "%s%s%s%s", out->length ? ", " : "", before, id, then);
    fw_schedule_put_duration(out, seconds);
}

/* The cycle in words, arcs in the order of the flow and a window's last: what must start soon
   enough, and what lies between. The own time of the step whose end opens a window stands in both
   and is left out. */
static fw_status cycle_words(fw_arena *arena, const fw_schedule_shop *shop, const arc *list,
                             const int *cycle, int n, bool latest, const char **why) {
    fw_text windows = fw_text_new(arena), between = fw_text_new(arena), out = fw_text_new(arena);
    double needs = 0.0, allowed = 0.0;
    for (int i = 0; i < n; i++) {
        const arc *a = &list[cycle[i]], *before = &list[cycle[(i + n - 1) % n]];
        double own = lasts(shop, a->back ? a->to : a->from, latest);
        bool opens = before->back && !a->back; /* a leaves the step that opens the window */
        if (a->back) {
            const fw_schedule_hold *h = &shop->hold[a->hold];
            allowed += h->max_s + (list[cycle[(i + 1) % n]].back ? own : 0.0);
            fw_text_printf(&windows, "%s%s must start within ", windows.length ? ", and " : "",
                           shop->task[h->to].id);
            fw_schedule_put_duration(&windows, h->max_s);
            fw_text_printf(&windows, " of the end of %s", shop->task[h->from].id);
            if (h->why) fw_text_printf(&windows, " (the wafer is %s)", h->why);
            if (h->keeps) fw_text_printf(&windows, " (%s)", h->keeps);
            continue;
        }
        needs += a->weight_s - (opens ? own : 0.0);
        if (!opens) put_part(&between, "", shop->task[a->from].id, " ", own);
        if (a->hold >= 0)
            put_part(&between, "after ", shop->task[a->from].id, " at least ", a->weight_s - own);
    }
    fw_text_add(&between, "");
    FW_TRY(fw_text_end(&windows));
    FW_TRY(fw_text_end(&between));
    fw_text_printf(&out, "%s, but what lies between takes ", windows.data);
    fw_schedule_put_duration(&out, needs);
    fw_text_printf(&out, " (%s): ", between.data);
    fw_schedule_put_duration(&out, needs - allowed);
    fw_text_add(&out, " too long");
    FW_TRY(fw_text_end(&out));
    *why = out.data;
    return FW_OK;
}

/* the arcs of the cycle that node `risen` is behind, in the order of the flow, the last one a
   window's: a cycle of forward arcs alone cannot be */
static fw_status cycle_of(fw_arena *arena, const arc *list, const int *by, int n, int risen,
                          int **cycle, int *length) {
    int *found = fw_arena_array(arena, int, (size_t)n);
    FW_NEED(found);
    FW_NEED(*cycle = fw_arena_array(arena, int, (size_t)n));
    for (int i = 0; i < n && by[risen] >= 0; i++)
        risen = list[by[risen]].from; /* now it is on the cycle */
    int node = risen, last = 0;
    *length = 0;
    do {
        found[(*length)++] = by[node];
        node = list[by[node]].from;
    } while (node != risen && *length < n);
    for (int i = 0; i < *length; i++) /* found is against the arcs */
        if (list[found[i]].back) last = i;
    for (int i = 0; i < *length; i++)
        (*cycle)[*length - 1 - i] = found[(last + i) % *length];
    return FW_OK;
}

/* Bellman and Ford for longest paths from a source that reaches every node at 0. After n rounds a
   node that still rises is behind a positive cycle, which the arcs that raised it lead into. Cost:
   n rounds of at most n + 2 holds arcs, microseconds. Tests: test_network.c, windows, random. */
fw_status fw_schedule_network_conflict(fw_arena *arena, const fw_schedule_shop *shop, bool latest,
                                       const char **why) {
    int n = shop->ntask, narc, risen = -1, length;
    arc *list;
    *why = NULL;
    for (int i = 0; i < shop->nhold; i++)
        if (shop->hold[i].from >= shop->hold[i].to) {
            FW_NEED(*why = fw_arena_printf(
                        arena, "the hold of %s counts from %s, which comes later",
                        shop->task[shop->hold[i].to].id, shop->task[shop->hold[i].from].id));
            return FW_OK;
        }
    FW_TRY(arcs_of(arena, shop, latest, &list, &narc));
    double *at = fw_arena_array(arena, double, (size_t)n);
    int *by = fw_arena_array(arena, int, (size_t)n), *cycle;
    FW_NEED(at ? by : NULL);
    for (int i = 0; i < n; i++)
        by[i] = -1;
    for (int round = 0; round <= n; round++) {
        risen = -1;
        for (int k = 0; k < narc; k++) {
            double least = at[list[k].from] + list[k].weight_s;
            if (least <= at[list[k].to] + 1e-6) continue; /* a microsecond is rounding */
            at[list[k].to] = least;
            by[list[k].to] = k;
            risen = list[k].to;
        }
        if (risen < 0) return FW_OK;
    }
    FW_TRY(cycle_of(arena, list, by, n, risen, &cycle, &length));
    return cycle_words(arena, shop, list, cycle, length, latest, why);
}

/* pause_i = least upper bound of start_{i+1} - end_i: the shortest path i -> i+1 in the distance
   graph, which are the arcs turned round (Floyd and Warshall). Cost: n^3, below a millisecond for
   50 steps. Test: test_network.c, pauses. */
fw_status fw_schedule_network_pauses(fw_arena *arena, const fw_schedule_shop *shop,
                                     double *pause_s) {
    int n = shop->ntask, narc;
    arc *list;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(arcs_of(arena, shop, false, &list, &narc));
    double *d = fw_arena_array(arena, double, (size_t)n *(size_t)n);
    FW_NEED(d);
    for (int i = 0; i < n * n; i++)
        d[i] = i % (n + 1) == 0 ? 0.0 : (double)INFINITY;
    for (int k = 0; k < narc; k++) {
        double *at = &d[list[k].to * n + list[k].from];
        *at = fmin(*at, -list[k].weight_s);
    }
    for (int k = 0; k < n; k++)
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                d[i * n + j] = fmin(d[i * n + j], d[i * n + k] + d[k * n + j]);
    for (int i = 0; i < n; i++)
        pause_s[i] = i + 1 < n ? d[i * n + i + 1] - shop->task[i].duration_s : (double)INFINITY;
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

/* Least fixed point of start_i = fit(max(arcs into i)), fit into the working day and the hours of its machine: every right side rises with the starts, so
   iterating from below ends at the earliest start of every task, or beyond all limits. With people
   there round the clock it is the longest path. Test: test_network.c, earliest. */
fw_status fw_schedule_network_earliest(const fw_schedule_shop *shop, double start_s,
                                       double *earliest_s, bool *ok, int *failing) {
    const double horizon_s = start_s + 400.0 * 86400.0;
    *failing = 0;
    for (int i = 0; i < shop->ntask; i++)
        earliest_s[i] = start_s;
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < shop->ntask; i++) {
            const fw_schedule_task *t = &shop->task[i];
            double at = earliest_s[i];
            if (i > 0) at = fmax(at, earliest_s[i - 1] + shop->task[i - 1].duration_s);
            for (int k = 0; k < shop->nhold; k++) {
                const fw_schedule_hold *h = &shop->hold[k];
                double end = earliest_s[h->from] + shop->task[h->from].duration_s;
                if (h->to == i && h->min_s > 0.0) at = fmax(at, end + h->min_s);
                if (h->from == i && h->max_s < (double)INFINITY)
                    at = fmax(at, earliest_s[h->to] - h->max_s - t->duration_s);
            }
            at = fw_schedule_alone_fit(shop, i, at);
            if (at <= earliest_s[i] + 1e-6) continue;
            earliest_s[i] = at;
            again = true;
            if (at < horizon_s) continue;
            *failing = i;
            *ok = false;
            return FW_OK;
        }
    }
    *ok = true;
    return FW_OK;
}
