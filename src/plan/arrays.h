/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a design as named arrays (FW_NUMBERS_... of the public header). One set is composed by one
   function, out of columns or of tables with axes. Private to the room. Test: tests/unit/plan/test_arrays.c */
#ifndef FW_PLAN_ARRAYS_H
#define FW_PLAN_ARRAYS_H
#include "plan/design.h"

enum { FW_PLAN_ARRAYS_MOST = 48 };

typedef struct fw_plan_arrays { /* one set */
    fw_arena *arena;
    fw_array *item[FW_PLAN_ARRAYS_MOST];
    size_t count;
    bool no_memory; /* what was asked for next is NULL */
} fw_plan_arrays;

typedef struct fw_plan_axis {
    size_t n;
    const char *const *label; /* (n) or NULL */
} fw_plan_axis;

typedef struct fw_plan_array_name {
    const char *name, *unit, *about;
} fw_plan_array_name;

/* zeroed values of a new array in its set, to be filled; NULL: memory was short (the set says so) */
double *fw_plan_array_real(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                           const fw_plan_axis *axis);
const char **fw_plan_array_text(fw_plan_arrays *to, fw_plan_array_name name, fw_plan_axis axis);
int32_t *fw_plan_array_whole(fw_plan_arrays *to, fw_plan_array_name name, int32_t type,
                             fw_plan_axis axis);
double *fw_plan_array_complex(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                              const fw_plan_axis *axis);

/* a member of the struct that stands for a row */
typedef struct fw_plan_column {
    fw_plan_array_name name;
    int32_t type; /* FW_ARRAY_REAL: double, _TEXT: const char *, _WHOLE and _TRUTH: int */
    size_t at;    /* offset of it */
} fw_plan_column;

/* an array for each column; row: (n) structs of `size` bytes; label: of the rows, or NULL */
void fw_plan_array_columns(fw_plan_arrays *to, const fw_plan_column *column, size_t ncolumn,
                           const void *row, size_t n, size_t size, const char *const *label);
#define FW_PLAN_COLUMN(type, row, member, name, unit, about)                                       \
    { {name, unit, about}, type, offsetof(row, member) }

/* (n) places for labels, NULL: memory was short */
const char **fw_plan_labels(fw_plan_arrays *to, size_t n);

/* ---- the sets: the stage that makes them was called ---- */

typedef fw_status fw_plan_compose(fw_design *design, fw_plan_arrays *to);
/* arrays_verdict.c */
fw_plan_compose fw_plan_numbers_parameters, fw_plan_numbers_scenes, fw_plan_numbers_hinges,
    fw_plan_numbers_flow_hinges, fw_plan_numbers_flows, fw_plan_numbers_governing,
    fw_plan_numbers_clearances, fw_plan_numbers_requirements, fw_plan_numbers_probes,
    fw_plan_numbers_motion_probes;
/* arrays_motion.c */
fw_plan_compose fw_plan_numbers_motion, fw_plan_numbers_peaks, fw_plan_numbers_modes,
    fw_plan_numbers_statics, fw_plan_numbers_load_path, fw_plan_numbers_assembly,
    fw_plan_numbers_workspace;

#endif
