/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One schedule from one order: serial generation. Private to schedule/. */
#ifndef FW_SCHEDULE_PLACE_H
#define FW_SCHEDULE_PLACE_H
#include "schedule/schedule.h"

#define FW_HORIZON_S (400.0 * 86400.0) /* no shop plans farther ahead */
#define FW_TIE_S     (4.0 * 3600.0)    /* windows that are usually placed at once */

/* which unit is placed next */
typedef enum fw_schedule_rule {
    FW_RULE_EARLIEST_ADVANCED, /* starts first; of those the one furthest on */
    FW_RULE_EARLIEST_BEHIND,
    FW_RULE_EARLIEST_END,
    FW_RULE_EARLIEST_LONG,
    FW_RULE_WAFER, /* wafer by wafer */
    FW_RULE_STEP,  /* step by step */
    FW_RULE_LIST   /* least priority first */
} fw_schedule_rule;
enum { FW_RULES = FW_RULE_LIST };
const char *fw_schedule_rule_text(fw_schedule_rule rule);

typedef struct fw_schedule_line { /* what occupies a machine, or the operators */
    double *start_s, *end_s;      /* (n) by start */
    double longest_s;             /* no span was ever longer */
    int n, places;
} fw_schedule_line;

/* A block is a row of tasks that tight windows tie together: its runs are placed at once, and
   shifted until every window holds. That finds a schedule where people and machines are short, but
   lets no other wafer in between, so that the search also tries without, and with all of them. A
   unit is a block, or one task, for a group of wafers. */
typedef struct fw_schedule_group {
    int from, to;     /* tasks */
    int first, count; /* wafers */
    bool placed;
} fw_schedule_group;

typedef struct fw_schedule_placing {
    const fw_schedule_shop *shop;
    double start_s; /* of the schedule */
    double tie_s;   /* windows up to this tie tasks into a block */
    int on; /* so many tasks behind the last one that is in a filling are done to each of its wafers
               before one of them goes on; below 0: each goes to the end of their block at once */
    bool parted;       /* that made a difference in the last schedule */
    bool hopeless;     /* the last one failed inside of a unit, whatever was placed around it */
    int *load;         /* (ntask) wafers of a run; lowered where windows do not allow so many */
    double *priority;  /* (ntask x wafers), for FW_RULE_LIST */
    double *release_s; /* (ntask x wafers) not before */
    double *begin_s, *finish_s; /* (ntask x wafers) what was placed */
    fw_schedule_line *machine, people;
    fw_schedule_group *unit;
    fw_schedule_run *run; /* (nrun) in the order of placing */
    int *next;            /* (wafers) first task that is not placed */
    int nunit, nrun;
    int failed_from, failed_to; /* tasks at whose windows it failed last */
    long work;                  /* runs placed so far, also those that were undone */
    double makespan_s, sum_s;   /* of the last schedule; sum of the ends of all wafers */
} fw_schedule_placing;

fw_status fw_schedule_placing_new(fw_arena *arena, const fw_schedule_shop *shop,
                                  fw_schedule_placing *p);
/* false: no schedule was found with this order (and no smaller loads) */
bool fw_schedule_place_all(fw_schedule_placing *p, fw_schedule_rule rule);

/* gives the runs (n) of wafers that might as well be others to the one with the smaller number first */
fw_status fw_schedule_wafers_in_order(fw_arena *arena, const fw_schedule_shop *shop,
                                      fw_schedule_run *run, int n);
/* gives every attended run of these (n) an operator */
fw_status fw_schedule_name_operators(fw_arena *arena, const fw_schedule_shop *shop,
                                     fw_schedule_run *run, int n);

/* ---- what occupies a machine or the operators ---- */

double fw_schedule_line_fit(const fw_schedule_line *line, double t, double length);
/* nothing for an empty span */
void fw_schedule_line_add(fw_schedule_line *line, double start, double end);

/* hours and closed days of the machines (n), from the flow's <tool>s; FW_INPUT with FW-D376 */
fw_status fw_schedule_tool_hours(fw_arena *arena, const fw_process_flow *flow,
                                 const fw_schedule_calendar *day, fw_schedule_machine *machine,
                                 int n, const fw_schedule_task *task, int ntask, fw_diags *diags);

/* ---- hours ---- */

/* Earliest t >= from at which a run of the task fits into the working day and the hours of its machine, whoever else is
   there; INFINITY: never. It never falls when `from` rises: what the bounds rest on. Test: test_tools.c */
double fw_schedule_alone_fit(const fw_schedule_shop *shop, int task, double from_s);
/* the day that most plans are made for, FW_WORKING_DAY from Monday to Friday, from the same date on */
fw_schedule_calendar fw_schedule_usual_day(const fw_schedule_calendar *of);
/* are people there at the same times, without breaks? */
bool fw_schedule_same_day(const fw_schedule_calendar *a, const fw_schedule_calendar *b);
/* earliest t by which the machine has been open for work_s since from, stretches shorter than least_s > 0 left out;
   INFINITY: never */
double fw_schedule_machine_worked(const fw_schedule_machine *machine, double from_s, double work_s,
                                  double least_s);

#endif
