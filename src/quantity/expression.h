/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arithmetic with units, dimension-checked: "2*t + 5 um", "1.711e-6 N m/rad", "sqrt(a^2+b^2)".

   Grammar: sum of products of powers; numbers may be followed by a unit ("5 um", "20 mA/cm2"); a
   unit binds tighter than * and /. Names are parameters. Functions: sqrt exp ln sin cos tan asin
   acos atan atan2 min max abs. `pi` is known. `t` may be a variable (time laws). */
#ifndef FW_QUANTITY_EXPRESSION_H
#define FW_QUANTITY_EXPRESSION_H
#include "quantity/quantity.h"

typedef struct fw_quantity_name_value {
    const char *name;
    double value; /* SI */
    fw_quantity_dimension dimension;
} fw_quantity_name_value;

typedef struct fw_quantity_names {
    const fw_quantity_name_value *item;
    size_t count;
} fw_quantity_names;

typedef struct fw_quantity_expression_error {
    size_t offset;       /* byte offset into the text where it went wrong */
    int number;          /* diagnostic number 020-039 */
    const char *message; /* complete sentence with what to do */
} fw_quantity_expression_error;

/* evaluates `text` (n bytes). FW_OK, FW_INPUT with *error filled, or FW_NOMEM.
   A bare number where `wanted` has a dimension is an error that suggests the unit. */
fw_status fw_quantity_expression_evaluate(fw_arena *arena, const char *text, size_t n,
                                          const fw_quantity_names *names,
                                          fw_quantity_dimension wanted, double *value,
                                          fw_quantity_expression_error *error);

/* the same where any dimension will do (parameters): the dimension found comes back */
fw_status fw_quantity_expression_evaluate_any(fw_arena *arena, const char *text, size_t n,
                                              const fw_quantity_names *names, double *value,
                                              fw_quantity_dimension *dimension,
                                              fw_quantity_expression_error *error);
/* the first unit written in the text that has this dimension, "" when there is none */
fw_status fw_quantity_expression_unit(fw_arena *arena, const char *text, size_t n,
                                      fw_quantity_dimension dimension, const char **unit);
/* could a parameter not have this name: it is a unit symbol, a function or pi */
bool fw_quantity_expression_reserved(const char *name);

/* does the text use one of these names? (to keep one mistake from being reported again) */
bool fw_quantity_expression_uses(const char *text, size_t n, const char *const *names,
                                 size_t count);

/* names used in the text, in order of appearance, without duplicates (for parameter ordering) */
fw_status fw_quantity_expression_names(fw_arena *arena, const char *text, size_t n,
                                       const char *const **names, size_t *count);

#endif
