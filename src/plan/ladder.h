/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladder of `flexwright hinge`: one hinge by models of growing fidelity and cost. A level is a
   function and a row of ladder_levels.c. docs/theory/flexure-errors.md. */
#ifndef FW_PLAN_LADDER_H
#define FW_PLAN_LADDER_H
#include "flexure/finite.h"
#include "plan/plan.h"
#include "report/report.h"

typedef struct fw_plan_ladder_case {
    fw_arena *arena; /* of this evaluation: freed when it has been measured */
    const fw_mechanism *mechanism;
    const fw_mechanism_hinge *hinge; /* its input is what every level starts from */
    fw_diags *diags;                 /* for what a level has to say */
} fw_plan_ladder_case;

typedef struct fw_plan_ladder_level {
    const char *name, *summary;
    bool external; /* takes seconds and a program that need not be installed */
    /* fills a row but cpu_s and centre_m; row->state says whether there is one */
    fw_status (*work)(const fw_plan_ladder_case *c, fw_report_level *row);
} fw_plan_ladder_level;

enum { FW_LADDER_LEVELS_MOST = 8 };
const fw_plan_ladder_level *fw_plan_ladder_levels(size_t *count);

typedef enum fw_plan_ladder_wanted {
    FW_LADDER_CHEAP = -1, /* all but those of external programs */
    FW_LADDER_AUTO = -2,  /* the same, and external ones where those do not reach the accuracy */
    FW_LADDER_ALL = -3,
    FW_LADDER_ONCE = -4  /* as CHEAP, each level run once: what it costs is not wanted */
} fw_plan_ladder_wanted; /* else: index of the one level */

enum { FW_DRIFT_POINTS = 41 };
typedef struct fw_plan_ladder_drift {
    fw_flexure_surfaces surfaces; /* aside_rad NaN: not drawn */
    double limit_rad;             /* the range: +- this */
    double contact_rad[2]; /* pure moment: at what rotations of the pin, - and +; NaN: none in
                               the range up to half a turn */
    double closing_N[2];   /* force along and across that closes the gap at rest; NaN: no gap */
    fw_flexure_drift_advice advice;                /* for +- limit */
    fw_flexure_drift_point point[FW_DRIFT_POINTS]; /* from - to + limit, rotation of the pin */
} fw_plan_ladder_drift;

typedef struct fw_plan_ladder { /* of one hinge in one flow */
    const char *flow;
    const fw_mechanism *mechanism;
    const fw_mechanism_hinge *hinge;
    fw_report_level row[FW_LADDER_LEVELS_MOST]; /* (rows) */
    int rows;
    int picked;   /* cheapest row whose own error is below the accuracy; where none is, the best */
    bool reached; /* it is below */
    double reaches; /* error of the picked row's stiffness */
    int shared;     /* index of the ladder that was solved for this one too; -1: its own */
    fw_plan_ladder_drift drift;
} fw_plan_ladder;

typedef struct fw_plan_ladders {
    fw_plan_ladder *item; /* (count) */
    int count;
    double accuracy; /* wanted, relative, of the rotation that a moment makes: of the stiffness */
} fw_plan_ladders;

/* the layout for what needs the hinges only: one that cannot be made is a warning, and what can be
   shown of it says where the hinges are and how they are drawn; NULL: nothing does */
fw_status fw_plan_hinges_layout(fw_plan *plan, const fw_layout **layout);
fw_status fw_plan_hinges_mechanism(fw_plan *plan, const fw_layout *layout,
                                   const fw_mechanism_variant *variant,
                                   const fw_mechanism **mechanism);
/* every hinge in every flow of a loaded plan; hinges that are alike are solved once */
fw_status fw_plan_ladders_run(fw_plan *plan, int wanted, fw_plan_ladders *out);
/* the same for the report */
fw_status fw_plan_report_hinges(fw_plan *plan, const fw_plan_ladders *all, fw_report_hinge **out);
const char *fw_plan_ladder_id(const fw_plan_ladder *ladder);

/* One level; measured: repeated until the clock can see it, at most for 2 ms. Visible because
   callgrind counts what each call of it costs (tests/accuracy/levels.c). */
fw_status fw_plan_ladder_climb(const fw_plan_ladder_case *c, const fw_plan_ladder_level *level,
                               bool measured, fw_report_level *row);

#endif
