/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a wafer is like after every step: wet and with what, under resist that is not baked, hot, in a pumped chamber;
   and how long it may wait like that. Follows from the steps' operations, changes, chemicals and <finish>es alone, so
   that a pack cannot forget it. Theory: docs/theory/process.md, "What a wafer is like between steps". */
#ifndef FW_PROCESS_WAFER_STATE_H
#define FW_PROCESS_WAFER_STATE_H
#include "process/process.h"

typedef enum fw_process_state {
#define X(name, key, longest, is, why) FW_STATE_##name,
#include "process/wafer_states.def"
#undef X
    FW_STATES
} fw_process_state;

typedef struct fw_process_wafer { /* after a step */
    bool is[FW_STATES];
    int since[FW_STATES];            /* index of the step that brought it about */
    const char *with[FW_STATES];     /* id of the chemical, resist or tool */
    const fw_process_hazard *liquid; /* WET: NULL is deionised water, or what no chemical names */
    bool released; /* compliant parts are free: a meniscus that dries pulls them down */
} fw_process_wafer;

/* of every step (nstep); pure */
fw_status fw_process_flow_wafers(fw_arena *arena, const fw_process_flow *flow,
                                 fw_process_wafer **wafer);
/* from one step on: *wafer is that before the step and becomes that after it */
void fw_process_wafer_pass(const fw_process_flow *flow, int step, fw_process_wafer *wafer);
/* fills in flow->wait, one for every state that a step brings about: when a flow was read, and again when values were
   replaced */
fw_status fw_process_flow_waits(fw_arena *arena, fw_process_flow *flow);
bool fw_process_step_is_op(const fw_process_step *step, const char *op);
/* the last of its chemicals that wets; NULL: none does */
const fw_process_hazard *fw_process_step_liquid(const fw_process_step *step);
/* does the step work in a liquid? */
bool fw_process_step_in_liquid(const fw_process_step *step);
/* may a wet wafer come to the step? */
bool fw_process_step_takes_wet(const fw_process_step *step);
/* "wet with phosphoric acid bath (h.pan)" */
const char *fw_process_wafer_words(fw_arena *arena, const fw_process_flow *flow,
                                   const fw_process_wafer *wafer, fw_process_state state);
const char *fw_process_state_why(fw_process_state state);
const char *fw_process_state_key(fw_process_state state);

#endif
