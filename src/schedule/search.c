/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The best schedule of a shop that is found in bounded work, and how much better any other could be. */
#include "base/sort.h"
#include "schedule/place.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- lower bounds of the end of all schedules ----
   Each holds with windows, days and hours of machines: people and machines only delay a wafer alone, fitting into hours
   never makes a later start earlier, and where a window forbids loads that are counted here, the truth is later still.
   Tests: test_schedule.c, brute_force; test_tools.c, bounds. */

/* how often the machine runs the task, loads that its places take at once counted once */
static int rounds_of(const fw_schedule_shop *shop, int task) {
    const fw_schedule_task *t = &shop->task[task];
    int load = t->alone ? 1 : t->load, places = shop->machine[t->machine].places;
    int runs = (shop->wafers + load - 1) / load;
    return (runs + places - 1) / places;
}

/* earliest end of the flow when task `from` may start at t: tasks alone, in their hours */
static double rest_after(const fw_schedule_shop *shop, int from, double t) {
    for (int i = from; i < shop->ntask; i++)
        t = fw_schedule_alone_fit(shop, i, t) + shop->task[i].duration_s;
    return t;
}

/* Equal runs of one task on one place, each as early as it fits: no other order ends earlier, since a later start
   never fits earlier. */
static double task_bound(const fw_schedule_shop *shop, int task, double from_s) {
    double t = from_s;
    for (int i = rounds_of(shop, task); i > 0; i--)
        t = fw_schedule_alone_fit(shop, task, t) + shop->task[task].duration_s;
    return rest_after(shop, task + 1, t);
}

/* All runs on one machine follow each other. None starts before the first of its tasks can, and behind the last run
   the flow still has at least what follows the last of its tasks. */
static double machine_bound(const fw_schedule_shop *shop, int machine, const double *earliest_s) {
    int first = -1, last = -1;
    double busy = 0.0, there = 0.0, shortest = (double)INFINITY, most = 0.0;
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        if (t->machine != machine) continue;
        first = first < 0 ? i : first;
        last = i;
        double load = t->alone ? 1.0 : t->load,
               runs = ceil(shop->wafers / load) / shop->machine[machine].places;
        busy += runs * t->duration_s;
        there += runs * fw_schedule_task_there_s(t);
        if (t->duration_s > 0.0) shortest = fmin(shortest, t->duration_s);
        most = fmax(most, task_bound(shop, i, earliest_s[i]));
    }
    if (!(busy > 0.0)) return most;
    double t =
        fmax(fw_schedule_machine_worked(&shop->machine[machine], earliest_s[first], busy, shortest),
             fw_schedule_calendar_worked(&shop->calendar, earliest_s[first], there));
    return fmax(most, rest_after(shop, last + 1, t));
}

/* K people stand there for all attended parts; behind the last one its run and the flow go on */
static double operator_bound(const fw_schedule_shop *shop, const double *earliest_s) {
    double work = 0.0, from = (double)INFINITY, least = (double)INFINITY;
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        if (!(t->attended_s > 0.0)) continue;
        work += ceil((double)shop->wafers / t->load) * t->attended_s;
        from = fmin(from, earliest_s[i] + fw_schedule_task_attended_from_s(t));
    }
    if (work <= 0.0) return 0.0;
    double t = fw_schedule_calendar_worked(&shop->calendar, from, work / shop->operators);
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *k = &shop->task[i];
        const double behind = k->at_end ? 0.0 : k->duration_s - k->attended_s;
        if (k->attended_s > 0.0) least = fmin(least, rest_after(shop, i + 1, t + behind));
    }
    return least;
}

/* earliest_s (ntask): of a wafer alone */
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

/* ---- the best order ----
   Every rule once, then small changes of the best order, kept where they are no worse. The random
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
    int on;
    bool any;
} best;

typedef struct search {
    const fw_schedule_shop *shop;
    fw_schedule_placing placing;
    best best;
    uint64_t state;
    double bound_s;
    bool any; /* the first order that is found will do */
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
    return s->best.any && (s->any || at_bound(s->best.makespan_s, s->bound_s));
}

/* what was placed is the best now */
static void take(search *s, fw_schedule_rule rule) {
    const fw_schedule_placing *p = &s->placing;
    best *b = &s->best;
    b->any = true;
    b->rule = rule;
    b->tie_s = p->tie_s;
    b->on = p->on;
    b->makespan_s = p->makespan_s;
    b->sum_s = p->sum_s;
    b->nrun = p->nrun;
    memcpy(b->run, p->run, (size_t)p->nrun * sizeof *p->run);
    memcpy(b->priority, p->begin_s, cells(s) * sizeof *p->begin_s);
    memcpy(b->load, p->load, (size_t)s->shop->ntask * sizeof *p->load);
}

static void try_rule(search *s, fw_schedule_rule rule) {
    const fw_schedule_placing *p = &s->placing;
    const best *b = &s->best;
    if (!fw_schedule_place_all(&s->placing, rule)) return;
    if (b->any && (p->makespan_s > b->makespan_s + 1e-6 ||
                   (p->makespan_s > b->makespan_s - 1e-6 && p->sum_s > b->sum_s + 1e-6)))
        return;
    take(s, rule);
}

/* every rule, from the loads that the tasks have; true: it is of no use to try another of them */
static bool try_rules(search *s, double tie_s, int on) {
    fw_schedule_placing *p = &s->placing;
    p->tie_s = tie_s;
    p->on = on;
    for (int rule = 0; rule < FW_RULES && !done(s); rule++) {
        for (int i = 0; i < s->shop->ntask; i++)
            p->load[i] = s->shop->task[i].load;
        try_rule(s, (fw_schedule_rule)rule);
        if (on >= 0 && (p->hopeless || !p->parted)) return !p->parted;
    }
    return false;
}

static void find(search *s) {
    for (int t = 0; t < TIES; t++)
        (void)try_rules(s, ties_s[t], -1);
    for (int t = 0; s->shop->soon && t < TIES; t++)
        for (int on = 0; on < s->shop->ntask && !s->best.any; on++)
            if (try_rules(s, ties_s[t], on)) break;
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
    if (!t->lot && !t->filling && t->load > 1 && uniform(s) < 0.5) {
        int most = t->load < shop->wafers ? t->load : shop->wafers;
        p->load[batch] = 1 + below(s, most);
    }
}

static void improve(search *s, int effort) {
    fw_schedule_placing *p = &s->placing;
    const size_t loads = (size_t)s->shop->ntask * sizeof *p->load;
    const long most = p->work + MOST_WORK;
    p->on = s->best.on;
    for (int i = 0; i < effort && p->work < most && !done(s); i++) {
        memcpy(p->priority, s->best.priority, cells(s) * sizeof *p->priority);
        memcpy(p->load, s->best.load, loads);
        p->tie_s = uniform(s) < 0.2 ? ties_s[below(s, TIES)] : s->best.tie_s;
        change(s);
        try_rule(s, FW_RULE_LIST);
    }
}

/* ---- wafers in their order, among equals ----
   One wafer is as good as another, so that people expect 1 before 2 at every step. Starts of one step, given to its
   wafers in ascending order, are the same list with other numbers; placed again it is kept where it ends no later. */

/* pairs of wafers of which the one with the larger number is earlier at a step */
static long inversions(const search *s, const double *begin_s) {
    const int n = s->shop->wafers;
    long sum = 0;
    for (int task = 0; task < s->shop->ntask; task++)
        for (int v = 1; v < n; v++)
            for (int u = 0; u < v; u++)
                sum += begin_s[task * n + u] > begin_s[task * n + v] + 1e-6;
    return sum;
}

static int ascending(const void *a, const void *b) {
    return fw_order_doubles(*(const double *)a, *(const double *)b);
}

/* of the best schedule, steps `from` to `to` in order, placed again */
static void try_in_order(search *s, int from, int to) {
    fw_schedule_placing *p = &s->placing;
    best *b = &s->best;
    const size_t n = (size_t)s->shop->wafers;
    memcpy(p->priority, b->priority, cells(s) * sizeof *p->priority);
    memcpy(p->load, b->load, (size_t)s->shop->ntask * sizeof *p->load);
    for (int task = from; task <= to; task++)
        qsort(p->priority + (size_t)task * n, n, sizeof *p->priority, ascending);
    p->tie_s = b->tie_s;
    p->on = b->on;
    if (!fw_schedule_place_all(p, FW_RULE_LIST) || p->makespan_s > b->makespan_s + 1e-6 ||
        inversions(s, p->begin_s) >= inversions(s, b->priority))
        return;
    take(s, b->rule);
}

static void prefer_order(search *s) {
    const int last = s->shop->ntask - 1;
    const long before = s->shop->wafers > 1 ? inversions(s, s->best.priority) : 0;
    if (before > 0) try_in_order(s, 0, last);
    for (int from = 0; from <= last && inversions(s, s->best.priority) > 0; from++) {
        try_in_order(s, from, last);
        try_in_order(s, from, from);
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

static fw_status none_found(fw_arena *arena, const search *s, const char **why) {
    const fw_schedule_shop *shop = s->shop;
    const int first = s->placing.failed_from, last = s->placing.failed_to;
    const char *keeps = NULL;
    for (int i = 0; i < shop->nhold; i++)
        if (shop->hold[i].keeps && shop->hold[i].to <= last && shop->hold[i].to >= first)
            keeps = shop->hold[i].keeps;
    FW_NEED(*why = fw_arena_printf(
                arena,
                "no order was found that keeps all windows with these people and this working "
                "day; it failed at %s%s%s%s%s. Fewer wafers, more operators or a longer day may "
                "help",
                shop->task[first].id, first == last ? "" : " to ",
                first == last ? "" : shop->task[last].id, keeps ? ", where " : "",
                keeps ? keeps : ""));
    return FW_OK;
}

static fw_status solve(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                       fw_schedule *out) {
    search s = {.shop = shop, .state = 20250106, .bound_s = out->bound.best_s};
    FW_TRY(room(arena, &s));
    s.placing.start_s = out->start_s;
    find(&s);
    if (!s.best.any) return none_found(arena, &s, &out->why);
    improve(&s, effort > 0 ? effort : usual_effort(shop));
    prefer_order(&s);
    out->feasible = true;
    out->rule = fw_schedule_rule_text(s.best.rule);
    out->nrun = s.best.nrun;
    out->makespan_s = s.best.makespan_s;
    measure(out);
    qsort(s.best.run, (size_t)s.best.nrun, sizeof *s.best.run, by_start);
    out->run = s.best.run;
    FW_TRY(fw_schedule_wafers_in_order(arena, shop, s.best.run, s.best.nrun));
    return fw_schedule_name_operators(arena, shop, s.best.run, s.best.nrun);
}

fw_status fw_schedule_is_found(fw_arena *arena, const fw_schedule_shop *shop, bool *found) {
    search s = {.shop = shop, .any = true};
    *found = false;
    if (shop->wafers > MOST_WAFERS || shop->ntask > MOST_TASKS) return FW_OK;
    FW_TRY(room(arena, &s));
    find(&s);
    *found = s.best.any;
    return FW_OK;
}

/* Least shift, from `shift` on, by which all runs of a schedule lie inside the working day and the hours of the machines;
   INFINITY: beyond `most`. Each run alone never fits earlier when it is shifted by more, so that the least fixed point is
   reached from below. Windows, places and people do not mind a shift. */
static double fitting_shift(const fw_schedule_shop *shop, const fw_schedule *of, double shift,
                            double most) {
    for (double before = -(double)INFINITY; shift > before + 1e-6;) {
        before = shift;
        for (int i = 0; i < of->nrun && shift <= most; i++) {
            const double start = of->run[i].start_s;
            shift =
                fmax(shift, fw_schedule_alone_fit(shop, of->run[i].task, start + shift) - start);
        }
        if (!(shift <= most)) return (double)INFINITY;
    }
    return shift;
}

static fw_status take_over(fw_arena *arena, const fw_schedule *of, double shift, fw_schedule *out) {
    fw_schedule_run *run = fw_arena_array(arena, fw_schedule_run, (size_t)of->nrun);
    FW_NEED(run);
    for (int i = 0; i < of->nrun; i++) {
        run[i] = of->run[i];
        run[i].start_s += shift;
        run[i].end_s += shift;
    }
    out->feasible = true;
    out->why = NULL;
    out->rule = of->rule;
    out->run = run;
    out->nrun = of->nrun;
    out->makespan_s = of->start_s + of->makespan_s + shift - out->start_s;
    measure(out);
    return FW_OK;
}

static bool is_ever_done(const fw_schedule_shop *shop) {
    for (int i = 0; i < shop->ntask; i++)
        if (isinf(fw_schedule_alone_fit(shop, i, 0.0))) return false;
    return true;
}

/* what is found for the other hours is handed out where it keeps those of the shop, moved to where it begins */
static fw_status solve_other(fw_arena *arena, const fw_schedule_shop *shop,
                             const fw_schedule_shop *as, double from_s, int effort,
                             fw_schedule *out) {
    fw_schedule other = *out;
    other.feasible = false;
    other.start_s = fmax(from_s, fw_schedule_calendar_start(&as->calendar));
    other.bound.best_s -= other.start_s - out->start_s; /* it is of an end, and counts from there */
    if (out->optimal || !is_ever_done(as)) return FW_OK;
    FW_TRY(solve(arena, as, effort, &other));
    if (!other.feasible) return FW_OK;
    const double earliest = fmin(0.0, out->start_s - other.start_s),
                 end = other.start_s + other.makespan_s,
                 most =
                     (out->feasible ? out->start_s + out->makespan_s - 1e-6 : FW_HORIZON_S) - end,
                 shift = fitting_shift(shop, &other, earliest, most);
    return isfinite(shift) ? take_over(arena, &other, shift, out) : FW_OK;
}

/* Hours that leave out some of what the shop's state, and shorter ones: without breaks, round the clock, the usual day; with
   the hours of the machines and without */
static fw_status solve_other_hours(fw_arena *arena, const fw_schedule_shop *shop,
                                   const fw_schedule_shop *people, int effort, fw_schedule *out) {
    fw_schedule_machine *open = fw_arena_array(arena, fw_schedule_machine, (size_t)shop->nmachine);
    FW_NEED(open);
    bool hours = false, by_day = !fw_schedule_calendar_round(&shop->calendar);
    const fw_schedule_calendar usual = fw_schedule_usual_day(&shop->calendar);
    for (int m = 0; m < shop->nmachine; m++) {
        open[m] = shop->machine[m];
        hours = hours || open[m].nhours + open[m].nclosed > 0;
        open[m].nhours = open[m].nclosed = 0;
    }
    for (int machines = 0; machines <= (int)hours; machines++) {
        fw_schedule_shop as = *people;
        if (machines) as.machine = open;
        if (machines) FW_TRY(solve_other(arena, shop, &as, out->start_s, effort, out));
        as.calendar.breaks = 0;
        if (shop->calendar.breaks > 0)
            FW_TRY(solve_other(arena, shop, &as, out->start_s, effort, out));
        as.calendar = fw_schedule_round_the_clock;
        if (by_day) FW_TRY(solve_other(arena, shop, &as, out->start_s, effort, out));
        if (!by_day) /* as the usual day's plan tries it */
            FW_TRY(solve_other(arena, shop, &as, fw_schedule_calendar_start(&usual), effort, out));
        as.calendar = usual;
        if (machines || !fw_schedule_same_day(&usual, &shop->calendar))
            FW_TRY(solve_other(arena, shop, &as, out->start_s, effort, out));
    }
    return FW_OK;
}

/* The search is no proof, so that it may miss what it finds for fewer people, or other hours: neither may be better
   than what is handed out. Cost: one search more for every operator that can be busy at once and each kind of
   hours. Test: test_schedule.c, never_worse_than_its_relaxations. */
static fw_status solve_with_less(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                                 fw_schedule *out) {
    int most = shop->operators < shop->wafers ? shop->operators : shop->wafers;
    if (most > shop->nmachine) most = shop->nmachine;
    FW_TRY(solve_other_hours(arena, shop, shop, effort, out));
    for (int k = shop->operators > most ? most : shop->operators - 1; k > 0 && !out->optimal; k--) {
        fw_schedule_shop less = *shop;
        less.operators = k;
        FW_TRY(solve_other(arena, shop, &less, out->start_s, effort, out));
        FW_TRY(solve_other_hours(arena, shop, &less, effort, out));
    }
    return FW_OK;
}

/* NULL, or why nobody can ever stand there long enough */
static fw_status day_too_short(fw_arena *arena, const fw_schedule_shop *shop, const char **why) {
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        double there = fw_schedule_task_there_s(t);
        fw_text text = fw_text_new(arena);
        if (isinf(fw_schedule_calendar_fit(&shop->calendar, 0.0, there)) ||
            isinf(fw_schedule_people_fit(&shop->calendar, t, 0.0)))
            fw_text_printf(&text, "%s %s longer than the working day", t->id,
                           t->by_day ? "must not run without people, and takes"
                                     : "needs somebody for");
        else if (isinf(fw_schedule_alone_fit(shop, i, 0.0)))
            fw_text_printf(&text,
                           "%s needs somebody while '%s' is open, and the machine's hours and the "
                           "working day never meet for so long",
                           t->id, shop->machine[t->machine].id);
        else
            continue;
        FW_TRY(fw_text_end(&text));
        *why = text.data;
        return FW_OK;
    }
    return FW_OK;
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
    FW_TRY(day_too_short(arena, shop, &out->why));
    if (out->why) return FW_OK;
    bool ok;
    int failing;
    FW_TRY(fw_schedule_network_earliest(shop, out->start_s, earliest_s, &ok, &failing));
    if (!ok) {
        FW_NEED(out->why = fw_arena_printf(
                    arena,
                    "the windows about %s (%s) cannot be kept within the working day and "
                    "the hours of the machines",
                    shop->task[failing].id, shop->task[failing].title));
        return FW_OK;
    }
    lower_bounds(shop, earliest_s, out->start_s, &out->bound);
    FW_TRY(solve(arena, shop, effort, out));
    return solve_with_less(arena, shop, effort, out);
}
