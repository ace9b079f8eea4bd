/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two flows with bench times in minutes, and shops made by hand or at random. */
#ifndef FW_TESTS_SHOPS_H
#define FW_TESTS_SHOPS_H
#include "schedule/schedule.h"
#include "test.h"

typedef struct row {
    const char *id, *machine;
    int load; /* 99: once per lot; on the shelf every wafer by itself */
    double run_min, attended_min;
} row;

static const row cu_rows[] = {
    {"C01", "bench", 1, 5, 5},       {"C02", "wetbench", 6, 45, 20},
    {"C03", "HFbench", 99, 20, 20},  {"C04", "HFbench", 1, 10, 10},
    {"C05", "HFbench", 1, 2, 2},     {"C06", "HFbench", 1, 3, 3},
    {"C07", "HFbench", 1, 3, 3},     {"C08", "HFbench", 1, 6, 6},
    {"C09", "hotplate", 1, 10, 1},   {"C10", "spinner", 1, 4, 4},
    {"C11", "hotplate", 1, 8, 1},    {"C12", "spinner", 1, 4, 4},
    {"C13", "hotplate", 1, 16, 1},   {"C14", "spinner", 1, 3, 3},
    {"C15", "shelf", 99, 77, 0},     {"C16", "aligner", 1, 10, 10},
    {"C17", "shelf", 99, 15, 0},     {"C18", "litho bench", 1, 10, 10},
    {"C19", "metrology", 1, 10, 10}, {"C20", "plasma", 1, 10, 5},
    {"C21", "plating", 1, 10, 10},   {"C22", "plating", 1, 21.04, 3},
    {"C23", "metrology", 1, 12, 12}, {"C24", "solvent", 6, 20, 5},
    {"C25", "wetbench", 1, 5, 5},    {"C26", "wetbench", 1, 15, 15},
    {"C27", "CPD", 2, 60, 15},       {"C28", "metrology", 1, 30, 30},
};

static const row si_rows[] = {
    {"S01", "bench", 1, 8, 8},       {"S02", "wetbench", 6, 35, 15},
    {"S03", "sputter", 4, 90, 15},   {"S04", "metrology", 1, 5, 5},
    {"S05", "hotplate", 1, 15, 10},  {"S06", "hmds", 6, 20, 3},
    {"S07", "spinner", 1, 3, 3},     {"S08", "hotplate", 1, 2, 1},
    {"S09", "aligner", 1, 8, 8},     {"S10", "hotplate", 1, 2, 1},
    {"S11", "litho bench", 1, 5, 5}, {"S12", "metrology", 1, 8, 8},
    {"S13", "hotplate", 1, 5, 1},    {"S14", "wetbench", 1, 16.67, 16.67},
    {"S15", "metrology", 1, 12, 12}, {"S16", "plasma", 1, 15, 5},
    {"S17", "RIE", 99, 20, 3},       {"S18", "RIE", 1, 119, 15},
    {"S19", "metrology", 1, 10, 10}, {"S20", "solvent", 6, 60, 10},
    {"S21", "wetbench", 6, 20, 20},  {"S22", "wetbench", 6, 25, 10},
    {"S23", "metrology", 1, 30, 30},
};

enum { CU_ROWS = sizeof cu_rows / sizeof cu_rows[0], SI_ROWS = sizeof si_rows / sizeof si_rows[0] };

static const fw_schedule_calendar round_the_clock = {
    .open_s = 0.0, .close_s = 86400.0, .weekends = true};

static inline fw_schedule_hold hold_of(int from, int to, double min_s, double max_s) {
    return (fw_schedule_hold){.from = from, .to = to, .min_s = min_s, .max_s = max_s};
}

static inline int find_row(const row *rows, int n, const char *id) {
    for (int i = 0; i < n; i++)
        if (strcmp(rows[i].id, id) == 0) return i;
    fail_msg("no row %s", id);
    return -1;
}

/* operators 0: as many as anybody can want */
static inline fw_schedule_shop shop_of(fw_arena *memory, const row *rows, int n, int wafers,
                                       int operators) {
    fw_schedule_task *task = fw_arena_array(memory, fw_schedule_task, (size_t)n);
    fw_schedule_machine *machine = fw_arena_array(memory, fw_schedule_machine, (size_t)n);
    assert_true(task && machine);
    int machines = 0;
    for (int i = 0; i < n; i++) {
        bool shelf = strcmp(rows[i].machine, "shelf") == 0, lot = rows[i].load == 99 && !shelf;
        int m = 0, load = shelf ? 1 : lot ? wafers : rows[i].load;
        while (m < machines && strcmp(machine[m].id, rows[i].machine) != 0)
            m++;
        if (m == machines)
            machine[machines++] = (fw_schedule_machine){
                .id = rows[i].machine, .title = rows[i].machine, .places = shelf ? 50 : 1};
        task[i] = (fw_schedule_task){.id = rows[i].id,
                                     .title = rows[i].id,
                                     .machine = m,
                                     .duration_s = 60.0 * rows[i].run_min,
                                     .latest_s = 60.0 * rows[i].run_min,
                                     .attended_s = 60.0 * rows[i].attended_min,
                                     .load = load < wafers ? load : wafers,
                                     .lot = lot,
                                     .alone = shelf};
    }
    return (fw_schedule_shop){.task = task,
                              .machine = machine,
                              .ntask = n,
                              .nmachine = machines,
                              .wafers = wafers,
                              .operators = operators ? operators : 50,
                              .calendar = round_the_clock};
}

/* of a run, from when to when somebody stands there */
static inline double hands_from(const fw_schedule_task *t, const fw_schedule_run *r) {
    return t->at_end ? r->end_s - t->attended_s : r->start_s;
}
static inline double hands_until(const fw_schedule_task *t, const fw_schedule_run *r) {
    return hands_from(t, r) + t->attended_s;
}

/* every rule of a schedule, looked at from outside: each wafer does every task once and in order,
   no machine takes more than it has places for or runs outside its hours, nobody stands in two
   places, people work by day, every hold is kept */
static inline void check_schedule(const fw_schedule *s) {
    const fw_schedule_shop *shop = s->shop;
    static double start[200 * 50], end[200 * 50];
    static int count[200 * 50];
    memset(count, 0, sizeof count);
    double last = 0.0;
    for (int i = 0; i < s->nrun; i++) {
        const fw_schedule_run *r = &s->run[i];
        const fw_schedule_task *t = &shop->task[r->task];
        assert_true(r->count >= 1 && r->first + r->count <= shop->wafers);
        assert_true(r->count <= t->load && (!t->lot || r->count == shop->wafers));
        assert_near(r->end_s - r->start_s, t->duration_s, 1e-6);
        const double there = t->by_day || t->in_parts ? t->duration_s : t->attended_s,
                     from = t->at_end ? r->end_s - there : r->start_s;
        if (there > 0.0)
            assert_near(fw_schedule_calendar_fit(&shop->calendar, from, there), from, 1e-6);
        const fw_schedule_machine *m = &shop->machine[t->machine];
        assert_near(fw_schedule_machine_fit(m, r->start_s, t->duration_s), r->start_s, 1e-6);
        for (int w = r->first; w < r->first + r->count; w++) {
            count[r->task * shop->wafers + w]++;
            start[r->task * shop->wafers + w] = r->start_s;
            end[r->task * shop->wafers + w] = r->end_s;
        }
        last = r->end_s > last ? r->end_s : last;
        int same = 0;
        for (int k = 0; k < s->nrun; k++) {
            const fw_schedule_run *o = &s->run[k];
            const fw_schedule_task *u = &shop->task[o->task];
            if (u->machine == t->machine && o->start_s <= r->start_s + 1e-6 &&
                o->end_s > r->start_s + 2e-6)
                same++;
            if (k != i && t->attended_s > 0 && u->attended_s > 0 && o->operator_ == r->operator_)
                assert_true(hands_until(u, o) <= hands_from(t, r) + 4e-6 ||
                            hands_until(t, r) <= hands_from(u, o) + 4e-6);
        }
        assert_true(same <= shop->machine[t->machine].places);
        assert_true(r->operator_ < shop->operators);
        assert_true((r->operator_ >= 0) == (t->attended_s > 0));
    }
    for (int i = 0; i < shop->ntask * shop->wafers; i++) {
        assert_int_equal(count[i], 1);
        if (i >= shop->wafers) assert_true(start[i] >= end[i - shop->wafers] - 1e-6);
    }
    for (int k = 0; k < shop->nhold; k++)
        for (int w = 0; w < shop->wafers; w++) {
            const fw_schedule_hold *h = &shop->hold[k];
            if (h->first_only && w > 0) break;
            double waited = start[h->to * shop->wafers + w] - end[h->from * shop->wafers + w];
            assert_true(waited <= h->max_s + 2e-6 && waited >= h->min_s - 2e-6);
        }
    assert_near(last - s->start_s, s->makespan_s, 1e-6);
    assert_true(s->makespan_s >= s->bound.best_s - 1e-6);
}

#endif
