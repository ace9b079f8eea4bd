/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays with names and units, and tables of rows. */
#include "plan/design.h"
#include <string.h>

/* ---- one array ---- */

static const size_t size_of[] = {[FW_ARRAY_REAL] = sizeof(double),
                                 [FW_ARRAY_WHOLE] = sizeof(int32_t),
                                 [FW_ARRAY_TEXT] = sizeof(const char *),
                                 [FW_ARRAY_COMPLEX] = 2 * sizeof(double),
                                 [FW_ARRAY_TRUTH] = sizeof(int32_t)};

static void *add(fw_plan_arrays *to, fw_plan_array_name name, int32_t type, int dimensions,
                 const fw_plan_axis *axis) {
    fw_array *a = to->no_memory ? NULL : fw_arena_one(to->arena, fw_array);
    size_t n = 1;
    to->no_memory = !a || to->count == FW_PLAN_ARRAYS_MOST;
    if (to->no_memory) return NULL;
    *a = (fw_array){.name = name.name,
                    .unit = name.unit,
                    .about = name.about,
                    .type = type,
                    .dimensions = dimensions,
                    .extent = {1, 1, 1}};
    for (int i = 0; i < dimensions; i++) {
        a->extent[i] = axis[i].n;
        a->label[i] = axis[i].label;
        n *= axis[i].n;
    }
    void *data = fw_arena_alloc(to->arena, n, size_of[type]);
    a->data = data;
    to->no_memory = !data;
    if (data) to->item[to->count++] = a;
    return data;
}

double *fw_plan_array_real(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                           const fw_plan_axis *axis) {
    return add(to, name, FW_ARRAY_REAL, dimensions, axis);
}

double *fw_plan_array_complex(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                              const fw_plan_axis *axis) {
    return add(to, name, FW_ARRAY_COMPLEX, dimensions, axis);
}

const char **fw_plan_array_text(fw_plan_arrays *to, fw_plan_array_name name, fw_plan_axis axis) {
    return add(to, name, FW_ARRAY_TEXT, 1, &axis);
}

int32_t *fw_plan_array_whole(fw_plan_arrays *to, fw_plan_array_name name, int32_t type,
                             fw_plan_axis axis) {
    return add(to, name, type, 1, &axis);
}

const char **fw_plan_labels(fw_plan_arrays *to, size_t n) {
    const char **label = to->no_memory ? NULL : fw_arena_array(to->arena, const char *, n);
    to->no_memory = !label;
    return label;
}

/* ---- rows ---- */

static void copy_member(int32_t type, void *to, size_t i, const unsigned char *from) {
    switch (type) {
    case FW_ARRAY_REAL:
        memcpy((double *)to + i, from, sizeof(double));
        break;
    case FW_ARRAY_TEXT:
        memcpy((const char **)to + i, from, sizeof(const char *));
        break;
    case FW_ARRAY_WHOLE:
    case FW_ARRAY_TRUTH:
        ((int32_t *)to)[i] = *(const int *)(const void *)from;
        break;
    }
}

void fw_plan_array_columns(fw_plan_arrays *to, const fw_plan_column *column, size_t ncolumn,
                           const void *row, size_t n, size_t size, const char *const *label) {
    const fw_plan_axis axis = {n, label};
    for (size_t k = 0; k < ncolumn; k++) {
        void *data = add(to, column[k].name, column[k].type, 1, &axis);
        for (size_t i = 0; data && i < n; i++)
            copy_member(column[k].type, data, i,
                        (const unsigned char *)row + i * size + column[k].at);
    }
}
