/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When which wafer is on which machine, and who stands there: a computed flow for N wafers, K
   operators and a working day. Hold windows are a temporal network; a schedule keeps all of them.
   What a step without a known time takes is not guessed: it is counted with the time that somebody
   must stand there, and marked. */
#ifndef FW_SCHEDULE_SCHEDULE_H
#define FW_SCHEDULE_SCHEDULE_H
#include "base/text.h"
#include "process/process.h"

/* when people are there, in seconds of a day that starts at 0:00 */
typedef struct fw_schedule_calendar {
    double open_s, close_s; /* 0 <= open < close <= 86400; 0 and 86400: round the clock */
    bool weekends;          /* people come on Saturdays and Sundays too */
    double break_s[4][2];   /* (breaks) ascending, inside the day: nobody is there from ... to */
    int breaks;
    unsigned closed_days; /* bit 0: Monday; on them it is closed */
    bool dated;           /* first_day is stated; without it day 1 is a Monday */
    bool undated;   /* ... and nobody asks when: dates on which a machine is closed do not count */
    long first_day; /* of the plan, days since 1970-01-01, negative before */
    double first_s; /* it begins no earlier on that day */
    bool
        zoned; /* its times are zone_min ahead of UTC; without it those of the laboratory's own clock */
    int zone_min;
    int changes;                    /* of the clock, in the order of time, while a plan may last */
    double change_s[6], ahead_s[6]; /* when, and how far it is ahead from then on of one that was
                                       never changed */
} fw_schedule_calendar;

typedef struct fw_schedule_machine { /* takes one load at a time, or so many wafers on their own */
    const char *id, *title;
    int places;
    const fw_schedule_calendar *hours; /* (nhours) a run lies inside all of them */
    const double (*closed_s)[2];       /* (nclosed) from 0:00 of day 1 */
    int nhours, nclosed;
} fw_schedule_machine;

typedef struct fw_schedule_task { /* a step of the flow as it is planned */
    const char *id, *title;
    int machine;
    double duration_s; /* planned time, at least attended_s */
    double latest_s;   /* the same at the stop time of the step */
    double attended_s; /* an operator stands there for this long, from the start on */
    bool at_end;       /* ... or up to the end, since somebody must end it: it goes on by itself */
    int load;          /* most wafers of one run */
    bool lot;          /* once for all wafers together */
    bool
        filling; /* it mixes one filling of a bath, for as many wafers as its load: that is not made smaller */
    int serves; /* most wafers that it may mix one filling for, where it mixes a bath; 0: it does not */
    int fillings; /* ... and how many are mixed one after the other in duration_s */
    bool alone;   /* a hold: every wafer by itself, up to the machine's places */
    bool by_day;  /* the whole run inside the working day: nobody may be alone with it */
    bool unknown; /* no time is known: counted with attended_s only */
    bool stated;  /* the time is the user's planning time */
    bool
        in_parts; /* somebody looks at it between its parts: the whole run inside the working day where one is so long */
} fw_schedule_task;

/* how long from its start on people must be in the house; their hands are taken for attended_s of it */
static inline double fw_schedule_task_there_s(const fw_schedule_task *t) {
    return t->by_day || t->in_parts ? t->duration_s : t->attended_s;
}
/* from when on after its start an operator's hands are taken */
static inline double fw_schedule_task_attended_from_s(const fw_schedule_task *t) {
    return t->at_end ? t->duration_s - t->attended_s : 0.0;
}
/* earliest t >= from at which a run of the task may start because people are in the house then: where it is ended by hand both
   when it is put in and when it is ended; INFINITY: never */
double fw_schedule_people_fit(const fw_schedule_calendar *calendar, const fw_schedule_task *task,
                              double from_s);

typedef struct fw_schedule_hold { /* min <= start of `to` - end of `from` <= max, for every wafer */
    int from, to;                 /* tasks */
    double min_s, max_s;          /* -INFINITY, INFINITY: none */
    bool implied; /* not of the pack: two steps that nobody does alone, on the same day; or `why` */
    bool first_only;   /* for the first wafer of the lot */
    const char *why;   /* what the wafer is like meanwhile: "wet with h.pan"; NULL: as `implied` */
    const char *keeps; /* instead: "a filling of SC1 keeps no longer (sc1.keeps)"; NULL */
} fw_schedule_hold;

typedef struct fw_schedule_shop { /* the problem */
    const fw_schedule_task *task;
    const fw_schedule_hold *hold;
    const fw_schedule_machine *machine;
    int ntask, nhold, nmachine;
    int wafers, operators;
    fw_schedule_calendar calendar;
    bool
        soon; /* orders are tried, too, in which all wafers of a filling are in it before one goes on */
} fw_schedule_shop;

/* what a run waited for last */
typedef enum fw_schedule_wait {
    FW_WAIT_NOTHING,
    FW_WAIT_FLOW,     /* the step before, or a hold's least time */
    FW_WAIT_MACHINE,  /* another load */
    FW_WAIT_OPERATOR, /* all were busy */
    FW_WAIT_DAY,      /* the working day */
    FW_WAIT_TOOL,     /* the hours of the machine */
    FW_WAIT_HOLD      /* it would have opened a window too early */
} fw_schedule_wait;
const char *fw_schedule_wait_text(fw_schedule_wait wait);

typedef struct fw_schedule_run { /* one load of one step */
    int task, first, count;      /* wafers first ... first + count - 1, from 0 */
    double start_s, end_s;       /* from 0:00 of the first day */
    int operator_;               /* from 0; -1: unattended */
    fw_schedule_wait waits_for;
} fw_schedule_run;

typedef struct fw_schedule_bound { /* no schedule can end earlier, after the first start */
    double path_s;                 /* of one wafer alone, with its holds and the working day */
    double machine_s;              /* of the busiest machine */
    double operator_s;             /* of everybody's attended time */
    double best_s;                 /* the largest */
    int machine;                   /* whose bound machine_s is */
} fw_schedule_bound;

typedef struct fw_schedule {
    const fw_schedule_shop *shop;
    bool feasible;
    const char *why;            /* when not feasible: the chain, or what was not found */
    const fw_schedule_run *run; /* (nrun) by start */
    const double *pause_s;      /* (ntask) longest pause allowed after a task; INFINITY: any */
    int nrun, unknown;          /* unknown: tasks without a time */
    double start_s;             /* of the working day: where makespan and bounds count from */
    double makespan_s;
    fw_schedule_bound bound;
    double gap;       /* makespan/bound - 1 */
    bool optimal;     /* the gap is 0 */
    const char *rule; /* how it was found */
    const char *late; /* the chain that breaks when every step runs to its stop time; NULL */
} fw_schedule;

#define FW_WORKING_DAY "08:00-18:00"
typedef struct fw_schedule_options {
    int wafers, operators; /* 0: 1 */
    const char *day;       /* as FW_WORKING_DAY; NULL: that; "none": round the clock */
    const char *planned;   /* times for steps, "S03=90 min,S09=20 s"; NULL: none */
    int effort;            /* schedules tried; 0: by size */
    bool
        undated; /* nobody asks when: what a machine is closed for on dates is left out where `day` has none */
} fw_schedule_options;

/* "08:00-18:00", "08:00-12:00,13:00-18:00" with breaks between, or "none"; behind it " from 2026-11-23" where the plan
   begins on a date, "T13:00" where on a time of it, " UTC" or " UTC+01:00" where its zone is stated, or a rule of POSIX for one whose clocks are changed, " CET-1CEST,M3.5.0,M10.5.0/3";
   false: it is none of these */
/* calendar.c: a time of the clock of a zone ("UTC", "UTC+01:00" or a rule of POSIX, as in a day) as times of UTC, s since 1970, the
   earlier one first: how many there are, 0 where the clock passes over it, 2 where it is set back over it; -1: that is no zone */
int fw_schedule_zone_times(const char *zone, double clock_s, double utc_s[2]);
/* calendar.c: are the hours and dates of a laboratory's machines such? FW-D376. It is asked where a laboratory pack is read, also
   where nothing is scheduled */
fw_status fw_schedule_tool_words(const fw_process_flow *flow, fw_diags *diags);
/* have machines that are closed on dates a plan that begins on one? FW-D376; before anything is computed */
fw_status fw_schedule_tool_dates(const fw_process_flow *flow, const char *day, fw_diags *diags);
bool fw_schedule_calendar_parse(const char *text, fw_schedule_calendar *calendar);
/* FW_OK also when there is no schedule: feasible is false and `why` says it. FW_LIMIT: too large */
fw_status fw_schedule_solve(fw_arena *arena, const fw_schedule_shop *shop, int effort,
                            fw_schedule *schedule);
/* (nstep) how many runs each step of the flow has in a plan: people, holds and waiting make more of them than full loads are;
   NULL: there is no plan. Test: tests/cli/test_schedule.py */
fw_status fw_schedule_loads(fw_arena *arena, const fw_schedule *plan, const fw_process_flow *flow,
                            const int **loads);
/* Is an order found at all? What fw_schedule_solve begins with, without anything that improves it */
fw_status fw_schedule_is_found(fw_arena *arena, const fw_schedule_shop *shop, bool *found);
/* both; FW-D196 and FW-D197 warn when there is none. Where none is found a step that mixes a bath does so for fewer wafers than
   a filling serves (FW-D758) */
fw_status fw_schedule_make(fw_arena *arena, const fw_process_flow *flow,
                           const fw_schedule_options *options, fw_diags *diags,
                           const fw_schedule **schedule);

/* ---- the temporal network of one wafer, without machines and people ---- */

/* NULL: the holds fit together. Otherwise the chain that does not, in words. latest: with the times
   at which the steps must stop instead of the planned ones. */
fw_status fw_schedule_network_conflict(fw_arena *arena, const fw_schedule_shop *shop, bool latest,
                                       const char **why);
/* longest pause between the end of each task and the start of the next (ntask); the network must be
   free of conflict */
fw_status fw_schedule_network_pauses(fw_arena *arena, const fw_schedule_shop *shop,
                                     double *pause_s);
/* earliest start of every task (ntask) of a wafer alone in the shop, from start_s on, with the
   working day and the hours of the machines. *ok false: it never fits (the task at which it fails is in *failing) */
fw_status fw_schedule_network_earliest(const fw_schedule_shop *shop, double start_s,
                                       double *earliest_s, bool *ok, int *failing);

/* ---- the working day ---- */

/* earliest t >= from such that people are there from t to t + length; INFINITY: never */
double fw_schedule_calendar_fit(const fw_schedule_calendar *calendar, double from_s,
                                double length_s);
/* earliest time by which people have been there for work_s since from_s */
double fw_schedule_calendar_worked(const fw_schedule_calendar *calendar, double from_s,
                                   double work_s);
bool fw_schedule_calendar_round(const fw_schedule_calendar *calendar); /* round the clock */
extern const fw_schedule_calendar fw_schedule_round_the_clock;
/* when the first working day begins, s from 0:00 of day 1 */
double fw_schedule_calendar_start(const fw_schedule_calendar *calendar);
/* Times of a plan go on evenly from 0:00 of day 1. What the clock on the wall shows at t, and the first time at which it
   shows that; they differ where it is changed on the way. Test: test_calendar.c */
double fw_schedule_calendar_clock(const fw_schedule_calendar *calendar, double t);
double fw_schedule_calendar_elapsed(const fw_schedule_calendar *calendar, double clock_s);
extern const char *const fw_schedule_weekday[7]; /* "Mon" ... */
/* 0: Monday; `day` counts from 0 */
int fw_schedule_calendar_weekday(const fw_schedule_calendar *calendar, long day);

/* earliest t >= from such that a run of this length lies inside the hours of the machine and on no day
   on which it is closed; INFINITY: never. Test: test_tools.c */
double fw_schedule_machine_fit(const fw_schedule_machine *machine, double from_s, double length_s);
/* when the machine closes that is open at t; INFINITY: it has no hours */
double fw_schedule_machine_closes(const fw_schedule_machine *machine, double t);

/* ---- durations in words ---- */

/* "45 s", "16 min 40 s", "1 h 30 min" */
void fw_schedule_put_duration(fw_text *out, double seconds);

#endif
