/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured coupons back into numbers of the process: a table of measurements in, quantities of the
   flow with uncertainty out, written as a laboratory pack that replaces them by id. */
#ifndef FW_PROCESS_CALIBRATE_H
#define FW_PROCESS_CALIBRATE_H
#include "process/process.h"

/* what the law of a step may correct its rate for; each has a reference value, at which the rate is stated */
typedef enum fw_process_condition {
    FW_CONDITION_TEMPERATURE, /* of the bath, K */
    FW_CONDITION_OPEN_AREA,   /* of the wafer that loads the plasma, m2 */
    FW_CONDITIONS
} fw_process_condition;

typedef struct fw_process_measurement { /* one row of the table; SI */
    const char *coupon, *feature;
    double drawn_m;            /* NaN: not given */
    double value, uncertainty; /* standard, > 0 */
    double at, at_uncertainty; /* under which time, depth, charge, speed; NaN: not given */
    fw_quantity_dimension dimension, at_dimension;
    fw_place place;
    double condition[FW_CONDITIONS],
        condition_uncertainty[FW_CONDITIONS]; /* etched at; 0: not said */
    bool once;      /* another row reads the very same, and stands for it */
    const char *of; /* id of what was read, by the step that it was read at; NULL: by the flow */
    bool
        of_wafer; /* of an edge as this wafer alone has it: others of the wafer are read against it, and it gives no result */
} fw_process_measurement;

typedef struct fw_process_calibrated {
    const char *id;            /* quantity of the flow */
    double value, uncertainty; /* SI, standard */
    const char *coupon;
    const char *note;               /* how, and what it is correlated with */
    double chi_square, probability; /* of the residuals; probability of a larger one */
    int rows, freedom;              /* freedom 0: nothing to test */
    /* its readings do not say how wafers differ, and so much of the uncertainty is what the flow had for that, standard, SI;
       0: it had nothing */
    bool spread_taken;
    double spread;
    const char *source, *date; /* which wafers, how many readings, when; NULL: those of the file */
    /* of a rate that its step corrects for a condition: between which values it was measured, where all of its readings say
       so; 0: not all do, or it is none. It is written as that at the reference value */
    double least[FW_CONDITIONS], most[FW_CONDITIONS];
    bool of_wafer; /* of rows that are: no result */
} fw_process_calibrated;

typedef struct
    fw_process_found_with { /* a value of the flow, and a result that was found with it */
    const fw_quantity *q;
    const char *of;
} fw_process_found_with;

typedef struct fw_process_calibration {
    const fw_process_calibrated *item; /* (count) one for every id */
    int count;
    const fw_process_found_with *with; /* (nwith) known or not; none of the items */
    int nwith;
    const char
        *packs; /* laboratory packs that the flow had, "lab.xml (SHA-256 0123)"; NULL: none */
    /* what is correlated: ids (njoint), of the items first and then of those of the flow that the coupons used, and
       their correlations (njoint njoint); NULL: not asked for, or nothing is */
    const char *const *joint;
    const double *correlation;
    int njoint;
} fw_process_calibration;

/* CSV with the header coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit and, where it is known,
   temperature_Cel,u_temperature_K,open_area_cm2,u_open_area_cm2 (docs/theory/calibrate.md); lines that start with # are comments. All mistakes in diags:
   FW-D211. */
fw_status fw_process_measurements_read(fw_arena *arena, const char *file, const char *text,
                                       size_t n, fw_diags *diags,
                                       fw_process_measurement **measurement, int *nmeasurement);
/* every coupon of the table. FW_INPUT with FW-D211 (a row that does not fit its coupon) or FW-D212
   (the data contradict the law, or each other). */
fw_status fw_process_calibrate(fw_arena *arena, const fw_process_flow *flow,
                               const fw_process_measurement *measurement, int n, fw_diags *diags,
                               fw_process_calibration *calibration);
/* how each coupon that `words` name is written into a log: "cd-lines, line|space, drawn=__ um, value=__ ... um, u=__ um" */
typedef struct fw_process_coupon_read {
    const char *words,
        *id; /* that name coupons, and what they find: the feature of a coupon that serves any; NULL: not known */
} fw_process_coupon_read;
fw_status fw_process_coupon_forms(const fw_process_coupon_read *read, int n, fw_text *out);
/* the name of the kind that is called so: its name, or a word of that alone, as test die and run sheet have it ("slots" of
   "arde-slots"); what is none comes back as it is */
const char *fw_process_coupon_called(const char *name);
/* FW_INPUT and FW-D211 where a row lacks what its coupon needs */
fw_status fw_process_measurement_check(const fw_process_measurement *row, fw_diags *diags);
/* the same of what the flow must have for it: the rate that an etch-rate is of */
fw_status fw_process_measurement_of_flow(const fw_process_flow *flow,
                                         const fw_process_measurement *row, fw_diags *diags);
/* does the coupon stand on a test die, under its kind or its name? */
bool fw_process_coupon_on_test_die(const char *coupon);
/* are all rows of the coupon of one run, so that what stands under `at` is the same in all? */
bool fw_process_coupon_of_one_run(const char *coupon);
/* of a row that bounds from one side ("gone"), the feature that bounds from the other ("stands"); NULL: it does not */
const char *fw_process_coupon_other_side(const fw_process_measurement *row);
/* the rate of the flow that the coupon gives; NULL: none. And the quantity of the condition that the step's law corrects that
   rate for; NULL: it does not */
const char *fw_process_coupon_rate(const fw_process_flow *flow, const fw_process_measurement *row);
const fw_quantity *fw_process_step_corrects(const fw_process_step *step, fw_process_condition which,
                                            const char *rate);
/* standard uncertainty of a number as it is written, in its own unit: uniform within one of its last digit */
double fw_process_written_uncertainty(const char *number);
/* does what follows from the row (with what it is of) take its wafer to have been etched sideways as the flow plans it now? */
bool fw_process_coupon_follows_plan(const fw_process_measurement *row);
/* of a change that is such an etch: how thick what it takes was put there, and is planned to be; NULL: it is none */
const fw_quantity *fw_process_change_takes_edges(const fw_process_flow *flow,
                                                 const fw_process_change *change);
/* is the step about a layer that such an etch takes from every edge? */
bool fw_process_step_makes_edges(const fw_process_flow *flow, const fw_process_step *step);
/* does what follows from the row take the edge of the layer that masks the etch (slots, the ladder), as lines of its wafer have it, else as
   the flow plans it? */
bool fw_process_coupon_begins_at_edge(const fw_process_measurement *row);
/* is it what tells where that edge is? And the step that leaves it there; NULL: the flow has none */
bool fw_process_coupon_tells_edge(const fw_process_flow *flow, const fw_process_measurement *row);
const fw_process_step *fw_process_flow_edge_step(const fw_process_flow *flow);
/* how thick what masks the etch was put there, where the coupon says what was lost of it; NULL: it does not, or no such thing */
const fw_quantity *fw_process_coupon_mask(const fw_process_flow *flow,
                                          const fw_process_measurement *row);
/* is such a row looked at, without a value? */
bool fw_process_coupon_is_looked_at(const fw_process_measurement *row);

/* ---- at which step of the flow a coupon is read: measurable.c ---- */

/* What is there to be read of a coupon from the step on that makes it, which its own entry is after, until the one that covers
   it, changes it or takes it away */
typedef struct fw_process_coupon_stage {
    const fw_process_step *from, *until; /* from NULL: read on any wafer; until NULL: to the end */
    const char *gives; /* id of the edge that it is; NULL: the coupon has none of several */
} fw_process_coupon_stage;
/* of a reading that is logged for the step. false: nothing is there to be read then, and *where says when there is: "the
   printed edge (litho.edge) from S11 to S13, ..." */
fw_status fw_process_coupon_stage_at(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_process_measurement *row, const fw_process_step *step,
                                     bool *there, fw_process_coupon_stage *stage,
                                     const char **where);

/* says what is given and cannot be used: a condition that nothing corrects the rate for, a column that the coupon does not
   take (FW-D679). typed: all of it was written for its row, as in a table; else conditions are those of the run, too */
fw_status fw_process_measurements_ask(const fw_process_flow *flow,
                                      const fw_process_measurement *const *row, int n, bool typed,
                                      const char *file, fw_diags *diags);
/* asks after results that lie far from what the flow has (FW-D643) */
void fw_process_calibration_ask(const fw_process_flow *flow,
                                const fw_process_calibration *calibration, const char *file,
                                fw_diags *diags);

/* ---- coupons of several wafers, at several sites of each ---- */

typedef struct fw_process_reading {
    /* value: mean of the sites; uncertainty: the instrument's, 0: none */
    fw_process_measurement row;
    const char *wafer;       /* "": of the lot */
    const char *step, *date; /* where it was logged, "2026-11-20" */
    double squares;          /* sum of the squared distances of its sites from their mean, SI */
    int nsite;               /* 0: looked at, not measured */
    const char *
        edge_off; /* of slots and the ladder: by which run the edge that they begin at is not as planned; NULL: it is */
} fw_process_reading;

typedef struct fw_process_readings {
    fw_process_reading *item;        /* (n) */
    int n, left_out;                 /* that do not count: a warning says of each why */
    const char *lot, *file, *sha256; /* lot may be NULL */
} fw_process_readings;

/* measurable.c, FW-D611: says where the last reading is of one run with others, and what stands under `at` is not the same */
void fw_process_readings_ask_apart(const fw_process_readings *readings, fw_diags *diags);
/* wafer_state.c, FW-D693: leaves out what begins at an edge that is not as planned and that nobody read, and lines of one wafer
   alone that nothing is read against */
void fw_process_readings_of_edges(const fw_process_flow *flow, fw_process_readings *readings,
                                  fw_diags *diags);
/* calibrate_wafers.c: every wafer by itself, then what they have in common; with the correlations */
fw_status fw_process_calibrate_wafers(fw_arena *arena, const fw_process_flow *flow,
                                      const fw_process_readings *readings, fw_diags *diags,
                                      fw_process_calibration *calibration);

/* process_calibrate.c: fills joint and correlation of what was found from these rows */
fw_status fw_process_calibration_correlate(fw_arena *arena, const fw_process_flow *flow,
                                           const fw_process_measurement *measurement, int n,
                                           fw_process_calibration *calibration);
/* coupon_fit.c: of a table, which has no wafers: how the next one differs stays what the flow has for it, and is added to every
   result */
fw_status fw_process_calibration_keep_spread(fw_arena *arena, const fw_process_flow *flow,
                                             fw_process_calibration *calibration);
/* the laboratory pack: <process flow="..."> with a <q status="measured"> for each */
fw_status fw_process_calibration_pack(const fw_process_flow *flow,
                                      const fw_process_calibration *calibration,
                                      const char *measured_file, const char *measured_sha256,
                                      fw_text *out);
/* a table for people: old value, new value, test */
fw_status fw_process_calibration_text(const fw_process_flow *flow,
                                      const fw_process_calibration *calibration, fw_text *out);

/* ---- laboratory packs ---- */

/* Replaces quantities of the flow by id, adds each to flow->override and says it (FW-D198). A pack
   for another flow changes nothing. FW_INPUT with FW-D211: no such id, another dimension, or an id
   that the mask or a step computes. */
/* the flow that a pack names, "" for none, and where */
fw_status fw_process_lab_flow(fw_arena *arena, const char *file, const char *xml, size_t n,
                              const char **flow, fw_place *place);
/* adds what a laboratory pack for this flow chooses (<choose alternative>) to the list; says nothing of mistakes, which
   fw_process_lab_apply does */
fw_status fw_process_lab_choices(fw_arena *arena, const char *file, const char *xml, size_t n,
                                 const char *flow, fw_process_choice **choice, int *nchoice);
fw_status fw_process_lab_apply(fw_arena *arena, const char *file, const char *xml, size_t n,
                               fw_process_flow *flow, fw_diags *diags);
/* once all packs are applied: what calibrate found with a value of the flow that is another now (FW-D676) */
fw_status fw_process_lab_ask(fw_arena *arena, const fw_process_flow *flow, fw_diags *diags);
/* ... and what moves the bias of the mask beyond what was judged without it, so that wafers printed before are others
   (FW-D683) */
fw_status fw_process_lab_ask_bias(fw_arena *arena, const fw_process_flow *flow, fw_diags *diags);

/* ---- what a laboratory can read in a flow, and how exactly ----
   By the coupons of calibrate or by an instrument that the pack names; and the flow with one quantity as it would be after
   that. Theory: docs/theory/measurements.md. */

/* quantities of this prefix say how exactly something is read; they are no inputs of a step */
#define FW_PROCESS_READ "read."

typedef struct fw_process_measurable {
    const char *id;     /* quantity of the flow */
    double uncertainty; /* standard, SI, at the value that the flow has now */
    const char *by;     /* "coupon undercut-ladder, with cd-lines", "thickness gauge, five sites" */
    bool coupon;
} fw_process_measurable;

/* What can be read, each id once, coupons before instruments. Of a coupon: what calibrate says of the
   rows that the test die is meant to give, read as exactly as read.width, read.depth, read.step and
   read.time of the pack say; a coupon whose rows need a value that is not known reads nothing. Of an
   instrument: read.ID of the pack, in the unit of ID, or relative where it is a pure number and ID is
   not. Test: tests/unit/process/test_measurable.c */
fw_status fw_process_measurables(fw_arena *arena, const fw_process_flow *flow,
                                 const fw_process_measurable **reading, int *n);
/* of a list; NULL: nothing reads it */
const fw_process_measurable *fw_process_measurable_of(const fw_process_measurable *reading, int n,
                                                      const char *id);

/* is it an input of a computed time, or of what the flow makes of a device? Not what the mask or a
   step computes, nor a time that is stated as such */
bool fw_process_flow_takes(const fw_process_flow *flow, const fw_quantity *q);
/* The value that a quantity is taken at where nobody has measured it: its own, else the nominal one of
   the range that a corner assumes; false: there is none. */
bool fw_process_flow_nominal(const fw_process_flow *flow, const fw_quantity *q, double *value);

typedef struct fw_process_with { /* one quantity, as a laboratory pack would replace it */
    const char *id;              /* NULL: the flow as it is */
    double value, uncertainty;   /* SI, standard */
} fw_process_with;

/* fw_process_flow_fabricated with that. The flow is for this alone: it is put back, but for what is
   computed in it. */
fw_status fw_process_flow_fabricated_with(fw_arena *arena, fw_process_flow *flow,
                                          const fw_process_with *with,
                                          const fw_process_mask_facts *facts,
                                          const fw_mechanism_variant *variant,
                                          const fw_verdict_fabrication_input **input, int *ninput);
/* the time of every step, (nstep), after fw_process_flow_compute's first pass with that; likewise.
   Texts in them live as long as the arena. */
fw_status fw_process_flow_times_with(fw_arena *arena, fw_process_flow *flow,
                                     const fw_process_with *with,
                                     const fw_process_mask_facts *facts, fw_process_time *time);

#endif
