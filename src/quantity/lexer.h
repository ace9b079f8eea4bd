/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tokens of an expression; shared by the evaluator and the search for names. Private to quantity/.
 */
#ifndef FW_QUANTITY_LEXER_H
#define FW_QUANTITY_LEXER_H
#include "quantity/expression.h"

typedef enum fw_quantity_token_kind {
    FW_TOKEN_END,
    FW_TOKEN_NUMBER, /* with its unit, in SI */
    FW_TOKEN_NAME,
    FW_TOKEN_MARK, /* one of + - * / ^ ( ) , */
    FW_TOKEN_WRONG /* `error` is filled */
} fw_quantity_token_kind;

typedef struct fw_quantity_token {
    fw_quantity_token_kind kind;
    size_t start, length;
    char mark;
    double value;
    double zero; /* SI value of 0 in this unit: 273.15 for Cel, else 0 */
    fw_quantity_dimension dimension;
    size_t unit_start, unit_length; /* length 0: a number without unit */
} fw_quantity_token;

typedef struct fw_quantity_lexer {
    fw_arena *arena;
    const char *text;
    size_t n, at;
    fw_quantity_expression_error *error; /* message NULL after running out of memory */
    const char *usual; /* unit of the place, to choose between suggestions; or NULL */
} fw_quantity_lexer;

fw_quantity_token fw_quantity_lexer_next(fw_quantity_lexer *lexer);

/* longest unit that text starts with: bytes used, 0 when none; *wrong is the symbol where the chain
   stopped (NULL when it stopped for another reason) */
size_t fw_quantity_unit_scan(const char *text, size_t n, bool minus_allowed, fw_quantity_unit *unit,
                             const char **wrong, size_t *wrong_n);
bool fw_quantity_unit_symbol(const char *symbol, size_t n);
/* d += by * times; false when an exponent leaves -127..127 */
bool fw_quantity_dimension_combine(fw_quantity_dimension *d, fw_quantity_dimension by, int times);
/* a unit that suits the dimension in messages: "um", "N m/rad"; NULL when there is no usual one */
const char *fw_quantity_dimension_unit(fw_quantity_dimension d);
/* with its article, for sentences: "a length", "an angle" */
const char *fw_quantity_dimension_phrase(fw_arena *arena, fw_quantity_dimension d);

#endif
