/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of expressions: one row each. Private to quantity/. */
#ifndef FW_QUANTITY_FUNCTIONS_H
#define FW_QUANTITY_FUNCTIONS_H
#include "quantity/lexer.h"

enum { FW_ARGUMENTS_MOST = 16 };

typedef struct fw_quantity_value {
    double value;
    fw_quantity_dimension dimension;
    /* made by * or / of something with a dimension beyond angles: a missing or extra rad is then
       forgiven (length / angle is a radius) */
    bool composite;
    bool varies; /* with time: the value is not known yet */
} fw_quantity_value;

bool fw_quantity_dimension_differs_in_angle(fw_quantity_dimension a,
                                            fw_quantity_dimension b); /* in nothing else */
/* may a and b be added or compared? *common is the dimension of the result */
bool fw_quantity_value_unify(const fw_quantity_value *a, const fw_quantity_value *b,
                             fw_quantity_dimension *common);

int fw_quantity_function_find(const char *name, size_t n); /* or -1 */
const char *fw_quantity_function_name(int function);       /* NULL behind the last */
/* false with a diagnostic number and a sentence (NULL: memory was short) */
bool fw_quantity_function_apply(fw_arena *arena, int function, const fw_quantity_value *argument,
                                int n, fw_quantity_value *result, int *number,
                                const char **message);

#endif
