/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schedule/place.h"
#include "base/sort.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static double runs_of(const fw_schedule_shop *shop, int task) {
    const fw_schedule_task *t = &shop->task[task];
    int at_once = t->alone ? shop->machine[t->machine].places : t->load;
    return ceil((double)shop->wafers / at_once);
}

static double there_of(const fw_schedule_task *t) {
    return t->by_day ? t->duration_s : t->attended_s;
}

/* earliest end of the flow when task `from` may start at t: tasks alone, in the working day */
static double rest_after(const fw_schedule_shop *shop, int from, double t) {
    for (int i = from; i < shop->ntask; i++) {
        double there = there_of(&shop->task[i]);
        if (there > 0.0) t = fw_schedule_calendar_fit(&shop->calendar, t, there);
        t += shop->task[i].duration_s;
    }
    return t;
}

/* Runs on one machine follow each other. None starts before the first of its tasks can, and behind
   the last run the flow still has at least what follows the last of its tasks. */
static double machine_bound(const fw_schedule_shop *shop, int machine, const double *earliest_s) {
    int first = -1, last = -1;
    double busy = 0.0, there = 0.0;
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        if (t->machine != machine) continue;
        first = first < 0 ? i : first;
        last = i;
        /* where a run occupies one of several places, so many run at once */
        double share = t->alone ? 1.0 : 1.0 / shop->machine[machine].places;
        busy += runs_of(shop, i) * t->duration_s * share;
        there += t->alone ? 0.0 : runs_of(shop, i) * there_of(t) * share;
    }
    if (first < 0) return 0.0;
    double t = fmax(earliest_s[first] + busy,
                    fw_schedule_calendar_worked(&shop->calendar, earliest_s[first], there));
    return rest_after(shop, last + 1, t);
}

/* K people stand there for all attended parts; behind the last one its run and the flow go on */
static double operator_bound(const fw_schedule_shop *shop, const double *earliest_s) {
    double work = 0.0, from = (double)INFINITY, least = (double)INFINITY;
    for (int i = 0; i < shop->ntask; i++) {
        if (!(shop->task[i].attended_s > 0.0)) continue;
        work += runs_of(shop, i) * shop->task[i].attended_s;
        from = fmin(from, earliest_s[i]);
    }
    if (work <= 0.0) return 0.0;
    double t = fw_schedule_calendar_worked(&shop->calendar, from, work / shop->operators);
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *k = &shop->task[i];
        if (k->attended_s > 0.0)
            least = fmin(least, rest_after(shop, i + 1, t + k->duration_s - k->attended_s));
    }
    return least;
}

/* Each bound holds for every schedule, windows and days included: people and machines only delay a
   wafer alone, fitting into the day never makes a later start earlier, and where a window forbids
   loads that are counted here, the truth is later still. Test: test_schedule.c, brute_force. */
static void lower_bounds(const fw_schedule_shop *shop, const double *earliest_s, double start_s,
                         fw_schedule_bound *b) {
    int last = shop->ntask - 1;
    *b = (fw_schedule_bound){.path_s = earliest_s[last] + shop->task[last].duration_s - start_s};
    for (int m = 0; m < shop->nmachine; m++) {
        double at = machine_bound(shop, m, earliest_s) - start_s;
        if (at <= b->machine_s) continue;
        b->machine_s = at;
        b->machine = m;
    }
    b->operator_s = fmax(0.0, operator_bound(shop, earliest_s) - start_s);
    b->best_s = fmax(b->path_s, fmax(b->machine_s, b->operator_s));
}

/* Every rule once, then small changes of the best order, kept where they are no worse. The random
   numbers are always the same, so that the same shop gives the same schedule. */

enum { MOST_WORK = 500000 }; /* runs placed while improving: about a second at most */
enum { MOST_WAFERS = 50, MOST_OPERATORS = 50, MOST_TASKS = 200 };

static const double ties_s[] = {FW_TIE_S, (double)INFINITY, -1.0};
enum { TIES = sizeof ties_s / sizeof ties_s[0] };

typedef struct best {
    fw_schedule_run *run;
    double *priority; /* (ntask x wafers) starts */
    int *load;
    int nrun;
    double makespan_s, sum_s;
    fw_schedule_rule rule;
    double tie_s;
    bool any;
} best;

typedef struct search {
    const fw_schedule_shop *shop;
    fw_schedule_placing placing;
    best best;
    uint64_t state;
    double bound_s;
} search;

/* splitmix64: Steele, Lea, Flood, OOPSLA 2014 */
static double uniform(search *s) {
    uint64_t z = (s->state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static int below(search *s, int n) {
    int k = (int)(uniform(s) * n);
    return k < n ? k : n - 1;
}

static size_t cells(const search *s) {
    return (size_t)s->shop->ntask * (size_t)s->shop->wafers;
}

static bool at_bound(double makespan_s, double bound_s) {
    return makespan_s <= bound_s * (1.0 + 1e-9) + 1e-6;
}

static bool done(const search *s) {
    return s->best.any && at_bound(s->best.makespan_s, s->bound_s);
}

static bool try_rule(search *s, fw_schedule_rule rule) {
    fw_schedule_placing *p = &s->placing;
    best *b = &s->best;
    if (!fw_schedule_place_all(p, rule)) return false;
    if (b->any && (p->makespan_s > b->makespan_s + 1e-6 ||
                   (p->makespan_s > b->makespan_s - 1e-6 && p->sum_s > b->sum_s + 1e-6)))
        return false;
    b->any = true;
    b->rule = rule;
    b->tie_s = p->tie_s;
    b->makespan_s = p->makespan_s;
    b->sum_s = p->sum_s;
    b->nrun = p->nrun;
    memcpy(b->run, p->run, (size_t)p->nrun * sizeof *p->run);
    memcpy(b->priority, p->begin_s, cells(s) * sizeof *p->begin_s);
    memcpy(b->load, p->load, (size_t)s->shop->ntask * sizeof *p->load);
    return true;
}

/* a few wafers earlier or later at a step, and perhaps in all that follows; or another load */
static void change(search *s) {
    const fw_schedule_shop *shop = s->shop;
    fw_schedule_placing *p = &s->placing;
    int changes = 1 + below(s, 3), batch = below(s, shop->ntask);
    double size = s->best.makespan_s * (uniform(s) < 0.5 ? 0.05 : 0.3);
    for (int i = 0; i < changes; i++) {
        int task = below(s, shop->ntask), wafer = below(s, shop->wafers);
        double by = (2.0 * uniform(s) - 1.0) * size;
        int last = uniform(s) < 0.5 ? task : shop->ntask - 1;
        for (int k = task; k <= last; k++)
            p->priority[k * shop->wafers + wafer] += by;
    }
    const fw_schedule_task *t = &shop->task[batch];
    if (!t->lot && t->load > 1 && uniform(s) < 0.5) {
        int most = t->load < shop->wafers ? t->load : shop->wafers;
        p->load[batch] = 1 + below(s, most);
    }
}

static void improve(search *s, int effort) {
    fw_schedule_placing *p = &s->placing;
    const size_t loads = (size_t)s->shop->ntask * sizeof *p->load;
    const long most = p->work + MOST_WORK;
    for (int i = 0; i < effort && p->work < most && !done(s); i++) {
        memcpy(p->priority, s->best.priority, cells(s) * sizeof *p->priority);
        memcpy(p->load, s->best.load, loads);
        p->tie_s = uniform(s) < 0.2 ? ties_s[below(s, TIES)] : s->best.tie_s;
        change(s);
        try_rule(s, FW_RULE_LIST);
    }
}

static fw_status room(fw_arena *arena, search *s) {
    FW_TRY(fw_schedule_placing_new(arena, s->shop, &s->placing));
    FW_NEED(s->best.run = fw_arena_array(arena, fw_schedule_run, cells(s)));
    FW_NEED(s->best.priority = fw_arena_array(arena, double, cells(s)));
    FW_NEED(s->best.load = fw_arena_array(arena, int, (size_t)s->shop->ntask));
    return FW_OK;
}

static int by_start(const void *a, const void *b) {
    const fw_schedule_run *r = a, *s = b;
    int order = fw_order_doubles(r->start_s, s->start_s);
    if (!order) order = fw_order_wholes(r->task, s->task);
    return order ? order : fw_order_wholes(r->first, s->first);
}

/* spans that overlap at most K times can always be given to K people, first come first served */
static fw_status name_operators(fw_arena *arena, const fw_schedule_shop *shop, fw_schedule_run *run,
                                int n) {
    double *free_s = fw_arena_array(arena, double, (size_t)shop->operators);
    FW_NEED(free_s);
    for (int i = 0; i < n; i++) {
        const fw_schedule_task *t = &shop->task[run[i].task];
        if (!(t->attended_s > 0.0)) continue;
        int who = 0;
        while (who < shop->operators - 1 && free_s[who] > run[i].start_s + 2e-6)
            who++;
        run[i].operator_ = who;
        free_s[who] = run[i].start_s + t->attended_s;
    }
    return FW_OK;
}

static int usual_effort(const fw_schedule_shop *shop) {
    int runs = shop->ntask * shop->wafers;
    int n = shop->wafers == 1 ? 100 : 250000 / (runs > 0 ? runs : 1);
    return n > 4000 ? 4000 : n;
}

/* makespan against the bound */
static void measure(fw_schedule *out) {
    const double bound_s = out->bound.best_s;
    out->optimal = at_bound(out->makespan_s, bound_s);
    out->gap = out->optimal || !(bound_s > 0.0) ? 0.0 : out->makespan_s / bound_s - 1.0;
}

static fw_status solve(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                       fw_schedule *out) {
    search s = {.shop = shop, .state = 20250106, .bound_s = out->bound.best_s};
    FW_TRY(room(arena, &s));
    for (int r = 0; r < TIES * FW_RULES && !done(&s); r++) {
        s.placing.tie_s = ties_s[r / FW_RULES];
        for (int i = 0; i < shop->ntask; i++)
            s.placing.load[i] = shop->task[i].load;
        try_rule(&s, (fw_schedule_rule)(r % FW_RULES));
    }
    if (!s.best.any) {
        const fw_schedule_task *from = &shop->task[s.placing.failed_from],
                               *to = &shop->task[s.placing.failed_to];
        FW_NEED(
            out->why = fw_arena_printf(
                arena,
                "no order was found that keeps all windows with these people and this working "
                "day; it failed at %s%s%s. Fewer wafers, more operators or a longer day may help",
                from->id, from == to ? "" : " to ", from == to ? "" : to->id));
        return FW_OK;
    }
    improve(&s, effort > 0 ? effort : usual_effort(shop));
    out->feasible = true;
    out->rule = fw_schedule_rule_text(s.best.rule);
    out->nrun = s.best.nrun;
    out->makespan_s = s.best.makespan_s;
    measure(out);
    qsort(s.best.run, (size_t)s.best.nrun, sizeof *s.best.run, by_start);
    out->run = s.best.run;
    return name_operators(arena, shop, s.best.run, s.best.nrun);
}

/* a schedule of a problem with less freedom, `later_s` later, is one of this problem too: does it keep the working day? */
static bool fits_day(const fw_schedule_shop *shop, const fw_schedule *of, double later_s) {
    for (int i = 0; i < of->nrun; i++) {
        const fw_schedule_task *t = &shop->task[of->run[i].task];
        double start = of->run[i].start_s + later_s,
               there = t->by_day ? t->duration_s : t->attended_s;
        if (there > 0.0 && fw_schedule_calendar_fit(&shop->calendar, start, there) > start + 1e-6)
            return false;
    }
    return true;
}

static fw_status take_over(fw_arena *arena, const fw_schedule *of, double later_s,
                           fw_schedule *out) {
    fw_schedule_run *run = fw_arena_array(arena, fw_schedule_run, (size_t)of->nrun);
    FW_NEED(run);
    memcpy(run, of->run, (size_t)of->nrun * sizeof *run);
    for (int i = 0; i < of->nrun; i++) {
        run[i].start_s += later_s;
        run[i].end_s += later_s;
    }
    out->feasible = true;
    out->why = NULL;
    out->rule = of->rule;
    out->run = run;
    out->nrun = of->nrun;
    out->makespan_s = of->makespan_s;
    measure(out);
    return FW_OK;
}

static bool better(const fw_schedule *a, const fw_schedule *b) {
    return a->feasible && (!b->feasible || a->makespan_s < b->makespan_s - 1e-6);
}

/* The search is no proof, so that it may miss what it finds for fewer people, or without a working day: neither may be
   better than what is handed out. Cost: one search more for every operator that can be busy at once, and one. */
static fw_status solve_with_less(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                                 fw_schedule *out) {
    fw_schedule_shop less = *shop;
    fw_schedule other = *out;
    int most = shop->operators < shop->wafers ? shop->operators : shop->wafers;
    if (most > shop->nmachine) most = shop->nmachine;
    for (int k = shop->operators > most ? most : shop->operators - 1; k > 0 && !out->optimal; k--) {
        less.operators = k;
        other.feasible = false;
        FW_TRY(solve(arena, &less, effort, &other));
        if (better(&other, out)) FW_TRY(take_over(arena, &other, 0.0, out));
    }
    if (out->optimal || fw_schedule_calendar_round(&shop->calendar)) return FW_OK;
    less = *shop;
    less.calendar = (fw_schedule_calendar){.open_s = 0.0, .close_s = 86400.0, .weekends = true};
    other.feasible = false;
    FW_TRY(solve(arena, &less, effort, &other));
    if (better(&other, out) && fits_day(shop, &other, out->start_s))
        FW_TRY(take_over(arena, &other, out->start_s, out));
    return FW_OK;
}

/* NULL, or why nobody can ever stand there long enough */
static const char *day_too_short(fw_arena *arena, const fw_schedule_shop *shop) {
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        double there = t->by_day ? t->duration_s : t->attended_s;
        if (isfinite(fw_schedule_calendar_fit(&shop->calendar, 0.0, there))) continue;
        fw_text text = fw_text_new(arena);
        fw_text_printf(&text, "%s %s longer than the working day", t->id,
                       t->by_day ? "must not run without people, and takes" : "needs somebody for");
        return text.failed ? "" : text.data;
    }
    return NULL;
}

fw_status fw_schedule_solve(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                            fw_schedule *out) {
    *out = (fw_schedule){.shop = shop, .start_s = fw_schedule_calendar_start(&shop->calendar)};
    if (shop->wafers > MOST_WAFERS || shop->operators > MOST_OPERATORS) return FW_LIMIT;
    if (shop->ntask > MOST_TASKS) {
        FW_NEED(out->pause_s = fw_arena_array(arena, double, (size_t)shop->ntask));
        FW_NEED(out->why = fw_arena_printf(arena, "it has more than %d steps", MOST_TASKS));
        return FW_OK;
    }
    for (int i = 0; i < shop->ntask; i++)
        out->unknown += shop->task[i].unknown;
    FW_TRY(fw_schedule_network_conflict(arena, shop, false, &out->why));
    if (out->why) return FW_OK;
    double *pause_s = fw_arena_array(arena, double, (size_t)shop->ntask);
    double *earliest_s = fw_arena_array(arena, double, (size_t)shop->ntask);
    FW_NEED(pause_s ? earliest_s : NULL);
    FW_TRY(fw_schedule_network_conflict(arena, shop, true, &out->late));
    FW_TRY(fw_schedule_network_pauses(arena, shop, pause_s));
    out->pause_s = pause_s;
    out->why = day_too_short(arena, shop);
    if (out->why) return FW_OK;
    bool ok;
    int failing;
    FW_TRY(fw_schedule_network_earliest(shop, out->start_s, earliest_s, &ok, &failing));
    if (!ok) {
        FW_NEED(out->why = fw_arena_printf(
                    arena, "the windows about %s (%s) cannot be kept within the working day",
                    shop->task[failing].id, shop->task[failing].title));
        return FW_OK;
    }
    lower_bounds(shop, earliest_s, out->start_s, &out->bound);
    FW_TRY(solve(arena, shop, effort, out));
    return solve_with_less(arena, shop, effort, out);
}
