/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/sort.h"
#include "schedule/place.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double tiny_s = 1e-6;

/* first span that starts at x or later */
static int starting(const fw_schedule_line *line, double x) {
    int low = 0, high = line->n;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (line->start_s[middle] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* one place: whatever overlaps must be over first, since nothing fits before it any more */
static double after_all(const fw_schedule_line *line, double t, double length) {
    for (int i = starting(line, t - line->longest_s); i < line->n; i++) {
        if (line->start_s[i] >= t + length - tiny_s) break;
        if (line->end_s[i] > t + tiny_s) t = line->end_s[i];
    }
    return t;
}

/* how many spans hold the moment x; *first_end is when the first of them ends */
static int holding(const fw_schedule_line *line, double x, double *first_end) {
    int n = 0;
    *first_end = (double)INFINITY;
    for (int i = starting(line, x - line->longest_s); i < line->n; i++) {
        if (line->start_s[i] > x + tiny_s) break;
        if (line->end_s[i] <= x + tiny_s) continue;
        *first_end = fmin(*first_end, line->end_s[i]);
        n++;
    }
    return n;
}

/* Earliest t' >= t with a place free from t' to t' + length. A moment x in [t, t + length) at which
   all places are taken forbids every start up to the first end of those that take them; only t and
   the starts of spans can be such moments. length 0 fits anywhere. Cost: the square
   of the spans near t.
   Test: test_schedule.c, line. */
double fw_schedule_line_fit(const fw_schedule_line *line, double t, double length) {
    double end;
    if (length <= 0.0) return t;
    if (line->places == 1) return after_all(line, t, length);
    for (bool again = true; again;) {
        again = holding(line, t, &end) >= line->places;
        for (int i = starting(line, t); i < line->n && !again; i++) {
            if (line->start_s[i] >= t + length - tiny_s) break;
            again = holding(line, line->start_s[i], &end) >= line->places;
        }
        if (again) t = end;
    }
    return t;
}

void fw_schedule_line_add(fw_schedule_line *line, double start, double end) {
    if (end <= start) return;
    int at = starting(line, start);
    size_t behind = (size_t)(line->n - at) * sizeof *line->start_s;
    memmove(&line->start_s[at + 1], &line->start_s[at], behind);
    memmove(&line->end_s[at + 1], &line->end_s[at], behind);
    line->start_s[at] = start;
    line->end_s[at] = end;
    line->longest_s = fmax(line->longest_s, end - start);
    line->n++;
}

/* what was added */
static void line_remove(fw_schedule_line *line, double start, double end) {
    if (end <= start) return;
    int at = starting(line, start);
    while (at < line->n && line->end_s[at] != end)
        at++;
    if (at == line->n) return; /* it was never added */
    size_t behind = (size_t)(--line->n - at) * sizeof *line->start_s;
    memmove(&line->start_s[at], &line->start_s[at + 1], behind);
    memmove(&line->end_s[at], &line->end_s[at + 1], behind);
}

/* Serial schedule generation with windows: runs are placed one after the other at their earliest
   feasible start, also into gaps. Where a longest time is broken, the run that opened the window is
   shifted by what is missing and what follows is placed again (the unscheduling step of Neumann,
   Schwindt, Zimmermann, Project Scheduling with Time Windows and Scarce Resources, 2003, 2.6). */

enum { MOST_SHIFTS = 400, MOST_RESTARTS = 25 };

typedef enum answer { PLACED, LATE, FAILED } answer;

static int at(const fw_schedule_placing *p, int task, int wafer) {
    return task * p->shop->wafers + wafer;
}

static fw_status new_line(fw_arena *arena, size_t most, int places, fw_schedule_line *line) {
    *line = (fw_schedule_line){.places = places};
    FW_NEED(line->start_s = fw_arena_array(arena, double, most));
    FW_NEED(line->end_s = fw_arena_array(arena, double, most));
    return FW_OK;
}

fw_status fw_schedule_placing_new(fw_arena *arena, const fw_schedule_shop *shop,
                                  fw_schedule_placing *p) {
    size_t all = (size_t)shop->ntask * (size_t)shop->wafers;
    *p = (fw_schedule_placing){.shop = shop,
                               .start_s = fw_schedule_calendar_start(&shop->calendar),
                               .tie_s = FW_TIE_S,
                               .on = -1};
    FW_NEED(p->load = fw_arena_array(arena, int, (size_t)shop->ntask));
    FW_NEED(p->priority = fw_arena_array(arena, double, all));
    FW_NEED(p->release_s = fw_arena_array(arena, double, all));
    FW_NEED(p->begin_s = fw_arena_array(arena, double, all));
    FW_NEED(p->finish_s = fw_arena_array(arena, double, all));
    FW_NEED(p->unit = fw_arena_array(arena, fw_schedule_group, all));
    FW_NEED(p->run = fw_arena_array(arena, fw_schedule_run, all));
    FW_NEED(p->next = fw_arena_array(arena, int, (size_t)shop->wafers));
    FW_NEED(p->machine = fw_arena_array(arena, fw_schedule_line, (size_t)shop->nmachine));
    for (int m = 0; m < shop->nmachine; m++) {
        size_t most = 0;
        for (int i = 0; i < shop->ntask; i++)
            most += shop->task[i].machine == m ? (size_t)shop->wafers : 0;
        FW_TRY(new_line(arena, most, shop->machine[m].places, &p->machine[m]));
    }
    FW_TRY(new_line(arena, all, shop->operators, &p->people));
    for (int i = 0; i < shop->ntask; i++)
        p->load[i] = shop->task[i].load;
    return FW_OK;
}

/* last task of the block that starts with `from` */
static int block_end(const fw_schedule_shop *shop, int from, double tie_s) {
    int to = from;
    for (bool grown = true; grown;) {
        grown = false;
        for (int i = 0; i < shop->nhold; i++) {
            const fw_schedule_hold *h = &shop->hold[i];
            if (h->max_s > tie_s || isinf(h->max_s) || h->from > to || h->to <= to ||
                h->from < from)
                continue;
            to = h->to;
            grown = true;
        }
    }
    return to;
}

static void make_units(fw_schedule_placing *p) {
    const fw_schedule_shop *shop = p->shop;
    p->nunit = 0;
    for (int from = 0; from < shop->ntask;) {
        int to = block_end(shop, from, p->tie_s), group = 1;
        for (int i = from; i <= to; i++)
            group = p->load[i] > group ? p->load[i] : group;
        for (int w = 0; w < shop->wafers; w += group) {
            int count = shop->wafers - w < group ? shop->wafers - w : group;
            p->unit[p->nunit++] = (fw_schedule_group){from, to, w, count, false};
        }
        from = to + 1;
    }
}

/* earliest start of a run for what was placed so far, and what it waited for last */
static double earliest(const fw_schedule_placing *p, int task, int first, int count,
                       fw_schedule_wait *why) {
    const fw_schedule_shop *shop = p->shop;
    const fw_schedule_task *t = &shop->task[task];
    const double lead = fw_schedule_task_attended_from_s(t);
    double start = p->start_s;
    *why = FW_WAIT_NOTHING;
    for (int w = first; w < first + count; w++) {
        double ready = task > 0 ? p->finish_s[at(p, task - 1, w)] : p->start_s;
        for (int k = 0; k < shop->nhold; k++)
            if (shop->hold[k].to == task && shop->hold[k].min_s > 0.0)
                ready =
                    fmax(ready, p->finish_s[at(p, shop->hold[k].from, w)] + shop->hold[k].min_s);
        if (ready > start + tiny_s) start = ready, *why = FW_WAIT_FLOW;
    }
    for (int w = first; w < first + count; w++)
        if (p->release_s[at(p, task, w)] > start + tiny_s)
            start = p->release_s[at(p, task, w)], *why = FW_WAIT_HOLD;
    for (;;) {
        double before = start, next = start;
        next = fw_schedule_people_fit(&shop->calendar, t, start);
        if (next > start + tiny_s) start = next, *why = FW_WAIT_DAY;
        next = fw_schedule_machine_fit(&shop->machine[t->machine], start, t->duration_s);
        if (next > start + tiny_s) start = next, *why = FW_WAIT_TOOL;
        next = fw_schedule_line_fit(&p->machine[t->machine], start, t->duration_s);
        if (next > start + tiny_s) start = next, *why = FW_WAIT_MACHINE;
        next = fw_schedule_line_fit(&p->people, start + lead, t->attended_s) - lead;
        if (next > start + tiny_s) start = next, *why = FW_WAIT_OPERATOR;
        if (start <= before || start > p->start_s + FW_HORIZON_S) return start;
    }
}

static void place_run(fw_schedule_placing *p, int task, int first, int count) {
    const fw_schedule_task *t = &p->shop->task[task];
    fw_schedule_wait why;
    double start = earliest(p, task, first, count, &why), end = start + t->duration_s;
    p->run[p->nrun++] = (fw_schedule_run){task, first, count, start, end, -1, why};
    for (int w = first; w < first + count; w++) {
        p->begin_s[at(p, task, w)] = start;
        p->finish_s[at(p, task, w)] = end;
    }
    fw_schedule_line_add(&p->machine[t->machine], start, end);
    const double from = start + fw_schedule_task_attended_from_s(t);
    fw_schedule_line_add(&p->people, from, from + t->attended_s);
    p->work++;
}

static void undo_to(fw_schedule_placing *p, int nrun) {
    while (p->nrun > nrun) {
        const fw_schedule_run *r = &p->run[--p->nrun];
        const fw_schedule_task *t = &p->shop->task[r->task];
        line_remove(&p->machine[t->machine], r->start_s, r->end_s);
        const double from = r->start_s + fw_schedule_task_attended_from_s(t);
        line_remove(&p->people, from, from + t->attended_s);
    }
}

/* pushes the opening of a broken window back; false: none is broken. Only windows that open inside
   the unit (inside) or before it. The shift goes to all wafers of the run that opened it. */
static bool broken(fw_schedule_placing *p, const fw_schedule_group *u, bool inside) {
    const fw_schedule_shop *shop = p->shop;
    bool any = false;
    for (int k = 0; k < shop->nhold; k++) {
        const fw_schedule_hold *h = &shop->hold[k];
        if (h->to < u->from || h->to > u->to || (h->from >= u->from) != inside) continue;
        for (int w = u->first; w < u->first + u->count; w++) {
            if (h->first_only && w > 0) break;
            double over = p->begin_s[at(p, h->to, w)] - p->finish_s[at(p, h->from, w)] - h->max_s;
            if (!(over > tiny_s)) continue;
            double begin = p->begin_s[at(p, h->from, w)] + over;
            p->release_s[at(p, h->from, w)] = fmax(begin, p->release_s[at(p, h->from, w)]);
            any = true;
        }
    }
    return any;
}

/* the runs of these tasks for some of the unit's wafers, task by task */
static void place_runs(fw_schedule_placing *p, int from, int to, int first, int count) {
    for (int task = from; task <= to; task++)
        for (int w = 0; w < count; w += p->load[task]) {
            int left = count - w;
            place_run(p, task, first + w, left < p->load[task] ? left : p->load[task]);
        }
}

/* Up to which task (at most `to`) the wafers of a filling are done one load after the other before the first of them goes on: so far
   behind the last one that is in the filling */
static int parting(fw_schedule_placing *p, int mixes, int to) {
    const fw_schedule_shop *shop = p->shop;
    int last = mixes;
    for (int k = 0; k < shop->nhold; k++)
        if (shop->hold[k].keeps && shop->hold[k].from == mixes && shop->hold[k].to <= to &&
            shop->hold[k].to > last)
            last = shop->hold[k].to;
    if (p->on < 0 || last == mixes || last + p->on >= to) return to;
    p->parted = true;
    return last + p->on;
}

/* these tasks for some of the unit's wafers, load by load through all of them */
static void place_chains(fw_schedule_placing *p, int from, int to, int first, int count) {
    int together = 1;
    for (int task = from; task <= to; task++)
        together = p->load[task] > together ? p->load[task] : together;
    for (int k = 0; from <= to && k < count; k += together)
        place_runs(p, from, to, first + k, count - k < together ? count - k : together);
}

/* Where a filling is mixed in the unit its wafers go on from there one load after the other: all of them at once would wait for
   each other at every step. What is done once for the lot is done to all before it, and to all behind it */
static void place_tasks(fw_schedule_placing *p, const fw_schedule_group *u) {
    const fw_schedule_task *task = p->shop->task;
    int mixes = u->from, from = u->from, to = u->from;
    while (mixes <= u->to && !task[mixes].filling)
        mixes++;
    for (int i = u->from; i <= u->to && mixes <= u->to; i++)
        if (task[i].lot && i < mixes) from = i + 1;
    for (to = mixes; to < u->to && !task[to + 1].lot;)
        to++;
    if (mixes > u->to) from = u->to + 1;
    place_runs(p, u->from, from - 1, u->first, u->count);
    if (mixes > u->to) return;
    const int part = parting(p, mixes, to);
    for (int w = 0; w < u->count; w += p->load[mixes]) {
        const int left = u->count - w, n = left < p->load[mixes] ? left : p->load[mixes];
        place_runs(p, from, mixes, u->first + w, n);
        place_chains(p, mixes + 1, part, u->first + w, n);
        place_chains(p, part + 1, to, u->first + w, n);
    }
    place_runs(p, to + 1, u->to, u->first, u->count);
}

static answer place_unit(fw_schedule_placing *p, fw_schedule_group *u) {
    int before = p->nrun;
    for (int shift = 0; shift < MOST_SHIFTS; shift++) {
        place_tasks(p, u);
        if (p->run[p->nrun - 1].start_s > p->start_s + FW_HORIZON_S) break;
        if (!broken(p, u, true)) {
            u->placed = true;
            for (int w = u->first; w < u->first + u->count; w++)
                p->next[w] = u->to + 1;
            return broken(p, u, false) ? LATE : PLACED;
        }
        undo_to(p, before);
    }
    undo_to(p, before);
    return FAILED;
}

static bool ready(const fw_schedule_placing *p, const fw_schedule_group *u) {
    for (int w = u->first; w < u->first + u->count; w++)
        if (p->next[w] != u->from) return false;
    return !u->placed;
}

static bool looks_at_start(fw_schedule_rule rule) {
    switch (rule) {
    case FW_RULE_EARLIEST_ADVANCED:
    case FW_RULE_EARLIEST_BEHIND:
    case FW_RULE_EARLIEST_END:
    case FW_RULE_EARLIEST_LONG:
        return true;
    case FW_RULE_WAFER:
    case FW_RULE_STEP:
    case FW_RULE_LIST:
        return false;
    }
    return false;
}

/* smaller goes first; the second decides between equal ones, then the wafer */
static void key_of(const fw_schedule_placing *p, const fw_schedule_group *u, fw_schedule_rule rule,
                   double key[3]) {
    const fw_schedule_task *t = &p->shop->task[u->from];
    int count = u->count < p->load[u->from] ? u->count : p->load[u->from];
    fw_schedule_wait why;
    double start = 0.0;
    if (looks_at_start(rule))
        start = round(earliest(p, u->from, u->first, count, &why) * 1e6) * 1e-6;
    const double of[][2] = {[FW_RULE_EARLIEST_ADVANCED] = {start, -u->from},
                            [FW_RULE_EARLIEST_BEHIND] = {start, u->from},
                            [FW_RULE_EARLIEST_END] = {start + t->duration_s, -u->from},
                            [FW_RULE_EARLIEST_LONG] = {start, -t->duration_s},
                            [FW_RULE_WAFER] = {u->first, u->from},
                            [FW_RULE_STEP] = {u->from, u->first},
                            [FW_RULE_LIST] = {p->priority[at(p, u->from, u->first)], -u->from}};
    key[0] = of[rule][0];
    key[1] = of[rule][1];
    key[2] = u->first;
}

static fw_schedule_group *choose(fw_schedule_placing *p, fw_schedule_rule rule) {
    fw_schedule_group *best = NULL;
    double least[3] = {0, 0, 0};
    for (int i = 0; i < p->nunit; i++) {
        double key[3];
        if (!ready(p, &p->unit[i])) continue;
        key_of(p, &p->unit[i], rule, key);
        int k = 0;
        while (best && k < 2 && key[k] == least[k])
            k++;
        if (best && !(key[k] < least[k])) continue;
        best = &p->unit[i];
        memcpy(least, key, sizeof least);
    }
    return best;
}

static void begin(fw_schedule_placing *p) {
    p->nrun = p->people.n = 0;
    p->people.longest_s = 0.0;
    for (int m = 0; m < p->shop->nmachine; m++) {
        p->machine[m].n = 0;
        p->machine[m].longest_s = 0.0;
    }
    for (int w = 0; w < p->shop->wafers; w++)
        p->next[w] = 0;
    for (int i = 0; i < p->nunit; i++)
        p->unit[i].placed = false;
}

static void forget_releases(fw_schedule_placing *p) {
    for (int i = 0; i < p->shop->ntask * p->shop->wafers; i++)
        p->release_s[i] = p->start_s;
}

/* windows that do not open for so many wafers at once: one less at the step with the largest load
 */
static bool smaller_load(fw_schedule_placing *p, const fw_schedule_group *u) {
    int most = -1;
    for (int i = u->from; i <= u->to; i++)
        if (!p->shop->task[i].lot && !p->shop->task[i].filling && p->load[i] > 1 &&
            (most < 0 || p->load[i] > p->load[most]))
            most = i;
    if (most < 0) return false;
    p->load[most] = u->count - 1 < p->load[most] && u->count > 1 ? u->count - 1 : p->load[most] - 1;
    return true;
}

static void measure(fw_schedule_placing *p) {
    const fw_schedule_shop *shop = p->shop;
    p->makespan_s = p->sum_s = 0.0;
    for (int w = 0; w < shop->wafers; w++) {
        double end = p->finish_s[at(p, shop->ntask - 1, w)] - p->start_s;
        p->makespan_s = fmax(p->makespan_s, end);
        p->sum_s += end;
    }
}

bool fw_schedule_place_all(fw_schedule_placing *p, fw_schedule_rule rule) {
    make_units(p);
    forget_releases(p);
    p->parted = false;
    p->hopeless = false;
    for (int restart = 0; restart < MOST_RESTARTS;) {
        answer result = PLACED;
        begin(p);
        for (int left = p->nunit; left > 0 && result == PLACED; left--) {
            fw_schedule_group *u = choose(p, rule);
            if (!u) return false;
            result = place_unit(p, u);
            if (result != PLACED) {
                p->failed_from = u->from;
                p->failed_to = u->to;
            }
            if (result == FAILED) {
                p->hopeless = !smaller_load(p, u);
                if (p->hopeless) return false;
                make_units(p);
                forget_releases(p);
            }
        }
        if (result == PLACED) {
            measure(p);
            return true;
        }
        restart += result == LATE;
    }
    return false;
}

const char *fw_schedule_rule_text(fw_schedule_rule rule) {
    static const char *const text[] = {"earliest start, most advanced wafer first",
                                       "earliest start, least advanced wafer first",
                                       "earliest end first",
                                       "earliest start, longest run first",
                                       "wafer by wafer",
                                       "step by step",
                                       "improved order"};
    return text[rule];
}

/* ---- wafers in their order ----
   One wafer is as good as another, so that the order in which a search has found them means nothing. Two wafers exchange
   all their runs from a step on, until one that is done to several at once, where the one with the larger number is the
   earlier one and their windows stay kept: nothing of machines, people or ends changes. Test: test_schedule.c */

typedef struct order {
    const fw_schedule_shop *shop;
    fw_schedule_run *run;
    int *at; /* (ntask x wafers) the run of a task that a wafer is in */
} order;

static fw_schedule_run *run_of(const order *o, int task, int wafer) {
    return &o->run[o->at[(size_t)task * (size_t)o->shop->wafers + (size_t)wafer]];
}

static bool keeps_windows(const order *o, int wafer) {
    const fw_schedule_shop *shop = o->shop;
    const double slack = 1e-6;
    for (int i = 0; i + 1 < shop->ntask; i++)
        if (run_of(o, i, wafer)->end_s > run_of(o, i + 1, wafer)->start_s + slack) return false;
    for (int i = 0; i < shop->nhold; i++) {
        const fw_schedule_hold *h = &shop->hold[i];
        const double wait = run_of(o, h->to, wafer)->start_s - run_of(o, h->from, wafer)->end_s;
        if (h->first_only && wafer > 0) continue;
        if (wait < h->min_s - slack || wait > h->max_s + slack) return false;
    }
    return true;
}

static void exchange(order *o, int from, int to, int u, int v) {
    const size_t n = (size_t)o->shop->wafers;
    for (int task = from; task < to; task++) {
        int *a = &o->at[(size_t)task * n + (size_t)u], *b = &o->at[(size_t)task * n + (size_t)v];
        const int was = *a;
        *a = *b;
        *b = was;
        run_of(o, task, u)->first = u;
        run_of(o, task, v)->first = v;
    }
}

static bool waits(const fw_schedule_run *r) {
    return r->waits_for == FW_WAIT_FLOW || r->waits_for == FW_WAIT_HOLD;
}

/* u < v; from: the first task that each is in by itself; -> the first one behind it that it is not */
static int alone_until(const order *o, int from, int u, int v) {
    int to = from;
    while (to < o->shop->ntask && run_of(o, to, u)->count == 1 && run_of(o, to, v)->count == 1 &&
           !o->shop->task[to].lot)
        to++;
    return to;
}

static bool sort_pair(order *o, int u, int v) {
    bool any = false;
    for (int from = 0; from < o->shop->ntask; from++) {
        const int to = alone_until(o, from, u, v);
        if (to == from) continue;
        const bool together = from == 0 || run_of(o, from - 1, u) == run_of(o, from - 1, v) ||
                              (!waits(run_of(o, from, u)) && !waits(run_of(o, from, v))),
                   after = to == o->shop->ntask || run_of(o, to, u) == run_of(o, to, v) ||
                           (!waits(run_of(o, to, u)) && !waits(run_of(o, to, v)));
        if (!together || !after || run_of(o, from, u)->start_s <= run_of(o, from, v)->start_s)
            continue;
        exchange(o, from, to, u, v);
        if (keeps_windows(o, u) && keeps_windows(o, v))
            any = true;
        else
            exchange(o, from, to, u, v);
    }
    return any;
}

/* each exchange takes away an inversion of the first of its tasks and changes none before it: it ends */
fw_status fw_schedule_wafers_in_order(fw_arena *arena, const fw_schedule_shop *shop,
                                      fw_schedule_run *run, int n) {
    order o = {shop, run, fw_arena_array(arena, int, (size_t)shop->ntask *(size_t)shop->wafers)};
    FW_NEED(o.at);
    for (int i = 0; i < n; i++)
        for (int w = run[i].first; w < run[i].first + run[i].count; w++)
            o.at[(size_t)run[i].task * (size_t)shop->wafers + (size_t)w] = i;
    for (bool any = true; any;) {
        any = false;
        for (int v = 1; v < shop->wafers; v++)
            for (int u = 0; u < v; u++)
                any = sort_pair(&o, u, v) || any;
    }
    return FW_OK;
}

/* ---- who stands there ---- */

typedef struct attended { /* of a run */
    double from_s;
    int run;
} attended;

static int by_from(const void *a, const void *b) {
    const attended *p = a, *q = b;
    const int first = fw_order_doubles(p->from_s, q->from_s);
    return first ? first : fw_order_wholes(p->run, q->run);
}

/* spans that overlap at most K times can always be given to K people, first come first served */
fw_status fw_schedule_name_operators(fw_arena *arena, const fw_schedule_shop *shop,
                                     fw_schedule_run *run, int n) {
    double *free_s = fw_arena_array(arena, double, (size_t)shop->operators);
    attended *span = fw_arena_array(arena, attended, (size_t)n + 1);
    int spans = 0;
    FW_NEED(free_s ? span : NULL);
    for (int i = 0; i < n; i++) {
        const fw_schedule_task *t = &shop->task[run[i].task];
        if (t->attended_s > 0.0)
            span[spans++] = (attended){run[i].start_s + fw_schedule_task_attended_from_s(t), i};
    }
    qsort(span, (size_t)spans, sizeof *span, by_from);
    for (int i = 0; i < spans; i++) {
        int who = 0;
        while (who < shop->operators - 1 && free_s[who] > span[i].from_s + 2e-6)
            who++;
        run[span[i].run].operator_ = who;
        free_s[who] = span[i].from_s + shop->task[run[span[i].run].task].attended_s;
    }
    return FW_OK;
}
