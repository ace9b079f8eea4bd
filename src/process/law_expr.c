/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/process_law.h"
#include "quantity/expression.h"
#include <string.h>

/* t = one arithmetic expression over the declared arguments, dimension-checked: a laboratory adds
   its own law without a compiler. Slopes by central difference. Test: test_law.c, expr. */
static fw_status evaluate(fw_process_law_call *call, const double *x, double *result) {
    fw_quantity_name_value item[FW_LAW_ARGUMENTS];
    for (int i = 0; i < call->n; i++)
        item[i] = (fw_quantity_name_value){call->name[i], x[i], call->dimension[i]};
    fw_quantity_names names = {item, (size_t)call->n};
    fw_quantity_expression_error error = {0};
    fw_status status =
        fw_quantity_expression_evaluate(call->arena, call->expression, strlen(call->expression),
                                        &names, call->wanted, result, &error);
    if (status == FW_INPUT)
        call->why = error.message ? error.message : "the expression has no value";
    return status;
}

const fw_process_law fw_process_law_expr = {
    "expr", "t = expression over the arguments", NULL, 0, evaluate, NULL, NULL, NULL};
