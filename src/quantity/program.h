/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tokens of an expression; shared by the evaluator and the search for names. Private to quantity/.
 */
#ifndef FW_QUANTITY_PROGRAM_H
#define FW_QUANTITY_PROGRAM_H
#include "quantity/quantity.h"
#include "quantity/quantity_law.h"

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

/* The functions of expressions: one row each. Private to quantity/. */

enum { FW_ARGUMENTS_MOST = 16 };

typedef struct fw_quantity_value {
    double value;
    fw_quantity_dimension dimension;
    /* made by * or / of something with a dimension beyond angles: a missing or extra rad is then
       forgiven (length / angle is a radius) */
    bool composite;
    bool varies; /* with time: the value is not known yet */
    bool
        in_degrees; /* one number of a scale that does not begin at 0 K: of 20 Cel there is no double */
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

/* Code of a compiled expression: a postfix program on a stack of jets. Private to quantity/. */

enum { FW_PROGRAM_STACK = 256 };

typedef enum fw_quantity_op {
    FW_OP_TIME,     /* push t */
    FW_OP_CONSTANT, /* push a number */
    FW_OP_NEGATE,
    FW_OP_SQRT,
    FW_OP_EXP,
    FW_OP_LN,
    FW_OP_SIN,
    FW_OP_COS,
    FW_OP_TAN,
    FW_OP_ASIN,
    FW_OP_ACOS,
    FW_OP_ATAN,
    FW_OP_ABS,
    FW_OP_ADD, /* two operands, this and the following */
    FW_OP_SUBTRACT,
    FW_OP_MULTIPLY,
    FW_OP_DIVIDE,
    FW_OP_POWER,
    FW_OP_ATAN2,
    FW_OP_MIN,
    FW_OP_MAX
} fw_quantity_op;

/* where the operands of a binary step are; a constant one is part of the step */
typedef enum fw_quantity_operands {
    FW_BOTH_ON_STACK,
    FW_LEFT_CONSTANT,
    FW_RIGHT_CONSTANT
} fw_quantity_operands;

typedef struct fw_quantity_step {
    fw_quantity_op op;
    fw_quantity_operands operands;
    double constant;
} fw_quantity_step;

struct fw_quantity_program {
    fw_quantity_step *step; /* (count) */
    int count, room;
    int depth, deepest; /* of the stack, while compiling */
    bool smooth;        /* no abs, min, max, atan2 of something that varies */
    bool too_deep;
};

/* room for every step that a text of n bytes can need */
fw_status fw_quantity_program_new(fw_arena *arena, size_t n, fw_quantity_program **program);
void fw_quantity_program_emit(fw_quantity_program *program, fw_quantity_op op,
                              fw_quantity_operands operands, double constant);
/* step of a function of lexer.c */
fw_quantity_op fw_quantity_function_op(int function);

/* bounds of value and slope over low_s to high_s, proved by interval arithmetic: {least, most} of each; infinite where
   there are none */
void fw_quantity_program_range(const fw_quantity_program *program, double low_s, double high_s,
                               double value[2], double slope[2]);
/* which side abs, min, max take at t, packed: two times with the same answer lie in the same piece
   or in pieces that do not differ (up to collisions of a 64-bit hash) */
uint64_t fw_quantity_program_branches(const fw_quantity_program *program, double t_s);
/* as fw_quantity_program_value, abs, min, max taking the side that they take at piece_s */
void fw_quantity_program_value_in(const fw_quantity_program *program, double t_s, double piece_s,
                                  double value[3]);

#endif
