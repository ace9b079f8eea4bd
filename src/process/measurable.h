/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a laboratory can read in a flow, and how exactly: by the coupons of calibrate or by an
   instrument that the pack names; and the flow with one quantity as it would be after that. Theory:
   docs/theory/measurements.md. */
#ifndef FW_PROCESS_MEASURABLE_H
#define FW_PROCESS_MEASURABLE_H
#include "process/process.h"

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
