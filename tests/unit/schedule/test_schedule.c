/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schedules: an independent greedy schedule of both flows, every rule of a schedule on random
   shops, small shops against all schedules there are. */
#include "schedule/place.h"
#include "shops.h"

static fw_arena *arena;
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static uint64_t seed = 11;
static int below(int n) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (int)((seed >> 33) % (uint64_t)n);
}

/* non-delay list schedules computed by another program (Python), minutes; the first rule here is
   the same one. What is returned is never worse, and never better than the bound. */
static void greedy_reference(void **state) {
    (void)state;
    static const int wafers[] = {1, 2, 3, 4, 6, 10};
    static const double cu[2][6] = {{444.04, 538.08, 607.08, 676.08, 814.08, 1114.04},
                                    {444.04, 563.04, 721.04, 902.08, 1173.08, 1907.12}};
    static const double si[2][6] = {{533.67, 722.34, 911.01, 1102.00, 1516.67, 2072.00},
                                    {533.67, 781.34, 1029.01, 1274.68, 1860.02, 2825.70}};
    for (int people = 0; people < 2; people++)
        for (int i = 0; i < 6; i++)
            for (int flow = 0; flow < 2; flow++) {
                fw_schedule_shop shop = flow ? shop_of(arena, si_rows, SI_ROWS, wafers[i], people)
                                             : shop_of(arena, cu_rows, CU_ROWS, wafers[i], people);
                double want = 60.0 * (flow ? si : cu)[people][i];
                fw_schedule_placing p;
                fw_schedule s;
                assert_int_equal(fw_schedule_placing_new(arena, &shop, &p), FW_OK);
                assert_true(fw_schedule_place_all(&p, FW_RULE_EARLIEST_ADVANCED));
                assert_near(p.makespan_s, want, 1e-6);
                assert_int_equal(fw_schedule_solve(arena, &shop, 10, &s), FW_OK);
                assert_true(s.feasible);
                assert_true(s.makespan_s <= want + 1e-6);
                check_schedule(&s);
                int next = 0; /* wafers come in as they are numbered, where no load behind holds them apart */
                for (int k = 0; k < s.nrun; k++)
                    if (flow && s.run[k].task == 0) {
                        assert_int_equal(s.run[k].first, next);
                        next += s.run[k].count;
                    }
                if (wafers[i] == 1) assert_true(s.optimal);
            }
}

/* ---- small shops, all schedules ---- */

enum { TASKS = 3, MOST = 14 }; /* minutes of the horizon */

typedef struct small {
    fw_schedule_shop shop;
    row rows[TASKS];
    fw_schedule_hold hold[2];
    fw_schedule_calendar hours[2];
    int start[TASKS * 3]; /* minutes, task * wafers + wafer; -1: not yet */
    int best, wafers;
} small;

static int run_min(const small *s, int task) {
    return (int)s->rows[task].run_min;
}

/* does (task, wafer) at t fit with what was put before? loads are equal starts of one task */
static bool fits(const small *s, int task, int wafer, int t, int upto) {
    const fw_schedule_task *k = &s->shop.task[task];
    int together = 1, people = k->attended_s > 0;
    if (task > 0 && t < s->start[(task - 1) * s->wafers + wafer] + run_min(s, task - 1))
        return false;
    for (int h = 0; h < s->shop.machine[k->machine].nhours; h++) {
        const fw_schedule_calendar *c = &s->shop.machine[k->machine].hours[h];
        if (60 * t < c->open_s || 60 * (t + run_min(s, task)) > c->close_s) return false;
    }
    for (int h = 0; h < s->shop.nhold; h++)
        if (s->hold[h].to == task) {
            double w = 60.0 * (t - s->start[s->hold[h].from * s->wafers + wafer] -
                               run_min(s, s->hold[h].from));
            if (w > s->hold[h].max_s + 1e-9 || w < s->hold[h].min_s - 1e-9) return false;
        }
    for (int i = 0; i < upto; i++) {
        int other = i / s->wafers, at = s->start[i];
        const fw_schedule_task *o = &s->shop.task[other];
        bool same_run = other == task && at == t;
        together += same_run;
        if (same_run) continue;
        if (o->machine == k->machine && at < t + run_min(s, task) && t < at + run_min(s, other))
            return false;
    }
    if (together > k->load) return false;
    if (!people) return true;
    /* people: at every minute at most so many loads are attended; loads count once */
    int attended = (int)s->rows[task].attended_min;
    for (int m = t; m < t + attended; m++) {
        int busy = 1;
        for (int i = 0; i < upto; i++) {
            int other = i / s->wafers, at = s->start[i];
            bool counted = other == task && at == t;
            for (int j = 0; j < i && !counted; j++)
                counted = j / s->wafers == other && s->start[j] == at;
            if (!counted && at <= m && m < at + (int)s->rows[other].attended_min) busy++;
        }
        if (busy > s->shop.operators) return false;
    }
    return true;
}

static void all_schedules(small *s, int cell, int latest) {
    if (latest >= s->best) return;
    if (cell == TASKS * s->wafers) {
        s->best = latest;
        return;
    }
    int task = cell / s->wafers, wafer = cell % s->wafers;
    int from = task > 0 ? s->start[cell - s->wafers] + run_min(s, task - 1) : 0;
    for (int t = from; t + run_min(s, task) < s->best; t++) {
        if (!fits(s, task, wafer, t, cell)) continue;
        s->start[cell] = t;
        int end = t + run_min(s, task);
        all_schedules(s, cell + 1, end > latest ? end : latest);
    }
}

static void random_small(small *s) {
    static const char *const id[] = {"A", "B", "C"}, *const machine[] = {"x", "y"};
    s->wafers = 2 + below(2);
    for (int i = 0; i < TASKS; i++) {
        int run = 1 + below(3);
        s->rows[i] = (row){id[i], machine[below(2)], 1 + below(2), run, below(run + 1)};
    }
    s->shop = shop_of(arena, s->rows, TASKS, s->wafers, 1 + below(2));
    s->shop.nhold = below(3);
    s->shop.hold = s->hold;
    for (int k = 0; k < s->shop.nhold; k++) {
        int from = below(TASKS - 1), to = from + 1 + below(TASKS - 1 - from);
        int between = to > from + 1 ? run_min(s, from + 1) : 0;
        s->hold[k] = hold_of(from, to, below(2) ? 60.0 : 0.0, 60.0 * (between + 1 + below(3)));
    }
}

/* on one machine of two, as long as any run, of the first day of the horizon */
static void random_hours(small *s) {
    int m = below(s->shop.nmachine), open = below(5), close = open + 3 + below(3 * MOST);
    fw_schedule_machine *machine = fw_arena_array(arena, fw_schedule_machine, TASKS);
    memcpy(machine, s->shop.machine, (size_t)s->shop.nmachine * sizeof *machine);
    s->hours[0] =
        (fw_schedule_calendar){.open_s = 60.0 * open, .close_s = 60.0 * close, .weekends = true};
    machine[m].hours = s->hours;
    machine[m].nhours = 1;
    s->shop.machine = machine;
}

/* 120 shops of two or three wafers, a third with a machine that has hours: never better than the best of all schedules,
   and nearly always equal; the bound never above it. A batch may start together only. */
static void brute_force(void **state) {
    (void)state;
    int optimal = 0, all = 0, held = 0, hours = 0;
    int rounds = test_fewest(test_cases(120, 40), 12);
    for (int round = 0; round < rounds; round++) {
        small s = {.best = 3 * MOST};
        fw_schedule got;
        random_small(&s);
        bool with_hours = round % 3 == 0;
        if (with_hours) random_hours(&s);
        all_schedules(&s, 0, 0);
        assert_int_equal(fw_schedule_solve(arena, &s.shop, 300, &got), FW_OK);
        if (s.best == 3 * MOST) continue; /* beyond the horizon of this search */
        all++;
        hours += with_hours;
        held += s.shop.nhold > 0;
        if (!got.feasible) {
            print_message("not found: best %d, %s\n", s.best, got.why);
            continue;
        }
        check_schedule(&got);
        assert_true(got.makespan_s >= 60.0 * s.best - 1e-6);
        assert_true(got.bound.best_s <= 60.0 * s.best + 1e-6);
        assert_true(!got.optimal || fabs(got.makespan_s - 60.0 * s.best) < 1e-6);
        optimal += got.makespan_s <= 60.0 * s.best + 1e-6;
    }

    assert_true(4 * all > 3 * rounds && 12 * held > 5 * rounds && 4 * hours > rounds);
    assert_true(optimal >= 0.97 * all);
}

typedef struct larger {
    row rows[8];
    fw_schedule_hold hold[4];
    fw_schedule_shop shop;
} larger;

static void random_larger(larger *l) {
    static const char *const id[] = {"A", "B", "C", "D", "E", "F", "G", "H"};
    static const char *const machine[] = {"m", "n", "o", "p", "shelf"};
    for (int i = 0; i < 8; i++) {
        double run = 1 + below(200);
        l->rows[i] = (row){id[i], machine[below(5)], below(8) ? 1 + below(4) : 99, run,
                           below(4) ? below((int)run + 1) : 0};
        if (strcmp(l->rows[i].machine, "shelf") == 0) l->rows[i].attended_min = 0;
    }
    l->shop = shop_of(arena, l->rows, 8, 1 + below(8), 1 + below(3));
    l->shop.nhold = below(4);
    l->shop.hold = l->hold;
    for (int k = 0; k < l->shop.nhold; k++) {
        int from = below(7), to = from + 1 + below(7 - from < 2 ? 7 - from : 2);
        double between = to > from + 1 ? l->shop.task[from + 1].duration_s : 0.0;
        l->hold[k] = hold_of(from, to, -(double)INFINITY, between + 60.0 * below(300));
    }
}

/* random larger shops with batches, holds, days and people: every rule of a schedule holds */
static void random_shops(void **state) {
    (void)state;
    int found = 0;
    int rounds = test_fewest(test_cases(120, 40), 12);
    for (int round = 0; round < rounds; round++) {
        larger l;
        random_larger(&l);
        if (below(2))
            l.shop.calendar = (fw_schedule_calendar){
                .open_s = 8 * 3600.0, .close_s = 18 * 3600.0, .weekends = below(2) == 0};
        fw_schedule got;
        assert_int_equal(fw_schedule_solve(arena, &l.shop, 20, &got), FW_OK);
        assert_true(got.feasible || got.why);
        if (!got.feasible) continue;
        check_schedule(&got);
        found++;
    }

    assert_true(4 * found > 3 * rounds);
}

/* places for three, against counting at every second */
static void line(void **state) {
    (void)state;
    for (int round = 0; round < 2000; round++) {
        double start[9], end[9];
        fw_schedule_line l = {.start_s = start, .end_s = end, .places = 1 + below(3)};
        for (int i = 0; i < 9; i++) {
            int t = below(30), n = below(8);
            double at = fw_schedule_line_fit(&l, t, n);
            bool full = true;
            for (double x = t; full && x <= at; x += 1.0) {
                full = false;
                for (double y = x; y < x + n; y += 1.0) {
                    int busy = 0;
                    for (int k = 0; k < l.n; k++)
                        busy += start[k] <= y && end[k] > y;
                    full = full || busy >= l.places;
                }
                if (!full) assert_near(at, x, 0);
            }
            assert_false(full);
            fw_schedule_line_add(&l, at, at + n);
        }
    }
}

/* the same shop gives the same schedule */
static void repeatable(void **state) {
    (void)state;
    fw_schedule_shop shop = shop_of(arena, si_rows, SI_ROWS, 5, 2);
    fw_schedule a, b;
    assert_int_equal(fw_schedule_solve(arena, &shop, 0, &a), FW_OK);
    assert_int_equal(fw_schedule_solve(arena, &shop, 0, &b), FW_OK);
    assert_int_equal(a.nrun, b.nrun);
    assert_memory_equal(a.run, b.run, (size_t)a.nrun * sizeof *a.run);
}

/* more people, or the whole day, never make a plan later */
static void never_worse_than_its_relaxations(void **state) {
    (void)state;
    int most = test_fewest(test_cases(5, 3), 2);
    for (int silicon = 0; silicon < 2; silicon++)
        for (int wafers = 2; wafers <= most; wafers++) {
            double before = (double)INFINITY;
            for (int k = 1; k <= 3; k++) {
                fw_schedule_shop shop = silicon ? shop_of(arena, si_rows, SI_ROWS, wafers, k)
                                                : shop_of(arena, cu_rows, CU_ROWS, wafers, k);
                fw_schedule all, day;
                assert_int_equal(fw_schedule_solve(arena, &shop, 100, &all), FW_OK);
                check_schedule(&all);
                assert_true(all.makespan_s <= before + 1e-6);
                before = all.makespan_s;
                fw_schedule_shop by_day = shop;
                by_day.calendar = (fw_schedule_calendar){
                    .open_s = 8 * 3600.0, .close_s = 20 * 3600.0, .weekends = false};
                assert_int_equal(fw_schedule_solve(arena, &by_day, 100, &day), FW_OK);
                check_schedule(&day);
                assert_true(day.makespan_s >= all.makespan_s - 1e-6 ||
                            all.gap > 0.0); /* the day is a restriction */
                bool fits = true;
                for (int i = 0; i < all.nrun && fits; i++) {
                    double at = all.run[i].start_s + 8 * 3600.0,
                           there = shop.task[all.run[i].task].attended_s;
                    fits = there <= 0.0 ||
                           fw_schedule_calendar_fit(&by_day.calendar, at, there) <= at + 1e-6;
                }
                if (fits) assert_true(day.makespan_s <= all.makespan_s + 1e-6);
            }
        }
}

static fw_schedule solved(const fw_schedule_shop *shop, fw_schedule_calendar calendar,
                          fw_schedule_shop *kept) {
    fw_schedule got;
    *kept = *shop;
    kept->calendar = calendar;
    assert_int_equal(fw_schedule_solve(arena, kept, 40, &got), FW_OK);
    if (got.feasible) check_schedule(&got);
    return got;
}

/* Random shops round the clock and by day, for one person and for two, some with a machine that has
   hours: less restricted is never later. */
static void longer_hours_are_never_later(void **state) {
    (void)state;
    static const fw_schedule_calendar day = {.open_s = 8 * 3600.0, .close_s = 18 * 3600.0};
    int compared = 0, rounds = test_fewest(test_cases(150, 30), 10);
    seed = 14184652527849212424u; /* the first shop is one whose plan round the clock was later than the one by day */
    for (int round = 0; round < rounds; round++) {
        larger l;
        random_larger(&l);
        fw_schedule_calendar hours = {.open_s = 9 * 3600.0, .close_s = 20 * 3600.0, .weekends = true};
        if (below(4) == 0) {
            fw_schedule_machine *m =
                fw_arena_array(arena, fw_schedule_machine, (size_t)l.shop.nmachine);
            memcpy(m, l.shop.machine, (size_t)l.shop.nmachine * sizeof *m);
            m[0].hours = &hours;
            m[0].nhours = 1;
            l.shop.machine = m;
        }
        double before = (double)INFINITY;
        for (int k = 1; k <= 2; k++) {
            fw_schedule_shop at[2];
            l.shop.operators = k;
            const fw_schedule all = solved(&l.shop, fw_schedule_round_the_clock, &at[0]),
                              open = solved(&l.shop, day, &at[1]);
            if (open.feasible) {
                assert_true(all.feasible);
                assert_true(all.start_s + all.makespan_s <= open.start_s + open.makespan_s + 1e-6);
                if (l.shop.machine[0].nhours == 0)
                    assert_true(all.makespan_s <= open.makespan_s + 1e-6);
                assert_true(open.makespan_s <= before + 1e-6);
                before = open.makespan_s;
                compared++;
            }
        }
    }
    assert_true(compared > rounds);
}

/* Of a bath or a current the end needs somebody: hands are taken for the last part of the run, and people are in the house when it
   is put in and when it is ended. So two short etches may begin together and end one after the other; one that would end after
   the day waits for the next, and one of a night goes on over it. */
static void who_ends_it(void **state) {
    (void)state;
    static const struct {
        double from_h, run_min, attended_min, start_h; /* by the fit */
    } of[] = {{8, 24, 6, 8},     {17, 24, 6, 17},   {16, 180, 30, 32},   {15, 180, 30, 15},
              {17, 960, 30, 17}, {12, 960, 30, 16.5}, {19, 24, 6, 32}, {8, 24, 24, 8}};
    fw_schedule_calendar day;
    assert_true(fw_schedule_calendar_parse("08:00-18:00", &day));
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        const fw_schedule_task t = {.id = "A", .duration_s = 60.0 * of[i].run_min, .attended_s = 60.0 * of[i].attended_min, .at_end = true};
        assert_near(fw_schedule_people_fit(&day, &t, 3600.0 * of[i].from_h), 3600.0 * of[i].start_h, 1.0);
    }
    fw_arena *own = fw_arena_new(0);
    for (int at_end = 0; at_end < 2; at_end++) {
        const fw_schedule_task task[] = {
            {.id = "A", .title = "etch", .duration_s = 1440.0, .latest_s = 1440.0, .attended_s = 360.0, .load = 1, .at_end = at_end},
            {.id = "B", .title = "look", .machine = 1, .duration_s = 300.0, .latest_s = 300.0, .attended_s = 300.0, .load = 1}};
        const fw_schedule_machine machine[] = {{.id = "bath", .title = "bath", .places = 2}, {.id = "bench", .title = "bench", .places = 1}};
        const fw_schedule_shop shop = {.task = task, .machine = machine, .ntask = 2, .nmachine = 2, .wafers = 2, .operators = 1, .calendar = day};
        fw_schedule s;
        assert_int_equal(fw_schedule_solve(own, &shop, 0, &s), FW_OK);
        assert_true(s.feasible);
        assert_true(s.makespan_s >= s.bound.best_s - 1e-6);
        for (int i = 0; i < s.nrun; i++)
            for (int k = 0; k < i; k++) {
                const fw_schedule_task *t = &task[s.run[i].task], *u = &task[s.run[k].task];
                const double from = s.run[i].start_s + fw_schedule_task_attended_from_s(t), other = s.run[k].start_s + fw_schedule_task_attended_from_s(u);
                assert_true(from >= other + u->attended_s - 1e-5 || other >= from + t->attended_s - 1e-5);
                assert_int_equal(s.run[i].operator_, 0);
            }
        for (int i = 0; i < s.nrun && at_end; i++)
            if (s.run[i].task == 0) assert_near(fw_schedule_task_attended_from_s(&task[0]), 1080.0, 0.0);
    }
    fw_arena_free(own);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_ends_it), cmocka_unit_test(greedy_reference), cmocka_unit_test(brute_force),
        cmocka_unit_test(random_shops),     cmocka_unit_test(line),
        cmocka_unit_test(repeatable),       cmocka_unit_test(never_worse_than_its_relaxations),
        cmocka_unit_test(longer_hours_are_never_later)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
