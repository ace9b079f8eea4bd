/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Code of a compiled expression: a postfix program on a stack of jets. Private to quantity/. */
#ifndef FW_QUANTITY_PROGRAM_H
#define FW_QUANTITY_PROGRAM_H
#include "quantity/quantity_law.h"

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
/* step of a function of functions.c */
fw_quantity_op fw_quantity_function_op(int function);

/* which side abs, min, max take at t, packed: two times with the same answer lie in the same piece
   or in pieces that do not differ (up to collisions of a 64-bit hash) */
uint64_t fw_quantity_program_branches(const fw_quantity_program *program, double t_s);
/* as fw_quantity_program_value, abs, min, max taking the side that they take at piece_s */
void fw_quantity_program_value_in(const fw_quantity_program *program, double t_s, double piece_s,
                                  double value[3]);

#endif
