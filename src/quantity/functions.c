/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/functions.h"
#include "quantity/program.h"
#include <math.h>
#include <string.h>

/* what a function takes and gives; `same` arguments share a dimension */
typedef enum takes { TAKES_PURE, TAKES_ANGLE, TAKES_ANY, TAKES_SAME } takes;
typedef enum gives { GIVES_PURE, GIVES_ANGLE, GIVES_SAME, GIVES_ROOT } gives;

typedef struct row {
    const char *name;
    int least, most; /* number of arguments */
    takes takes;
    gives gives;
} row;

enum { SQRT, EXP, LN, SIN, COS, TAN, ASIN, ACOS, ATAN, ATAN2, MIN, MAX, ABS };
static const row table[] = {
    [SQRT] = {"sqrt", 1, 1, TAKES_ANY, GIVES_ROOT},
    [EXP] = {"exp", 1, 1, TAKES_PURE, GIVES_PURE},
    [LN] = {"ln", 1, 1, TAKES_PURE, GIVES_PURE},
    [SIN] = {"sin", 1, 1, TAKES_ANGLE, GIVES_PURE},
    [COS] = {"cos", 1, 1, TAKES_ANGLE, GIVES_PURE},
    [TAN] = {"tan", 1, 1, TAKES_ANGLE, GIVES_PURE},
    [ASIN] = {"asin", 1, 1, TAKES_PURE, GIVES_ANGLE},
    [ACOS] = {"acos", 1, 1, TAKES_PURE, GIVES_ANGLE},
    [ATAN] = {"atan", 1, 1, TAKES_PURE, GIVES_ANGLE},
    [ATAN2] = {"atan2", 2, 2, TAKES_SAME, GIVES_ANGLE},
    [MIN] = {"min", 2, FW_ARGUMENTS_MOST, TAKES_SAME, GIVES_SAME},
    [MAX] = {"max", 2, FW_ARGUMENTS_MOST, TAKES_SAME, GIVES_SAME},
    [ABS] = {"abs", 1, 1, TAKES_ANY, GIVES_SAME},
};
enum { COUNT = sizeof table / sizeof table[0] };

int fw_quantity_function_find(const char *name, size_t n) {
    for (int i = 0; i < COUNT; i++)
        if (strlen(table[i].name) == n && memcmp(table[i].name, name, n) == 0) return i;
    return -1;
}

fw_quantity_op fw_quantity_function_op(int function) {
    static const fw_quantity_op op[COUNT] = {
        [SQRT] = FW_OP_SQRT, [EXP] = FW_OP_EXP,     [LN] = FW_OP_LN,     [SIN] = FW_OP_SIN,
        [COS] = FW_OP_COS,   [TAN] = FW_OP_TAN,     [ASIN] = FW_OP_ASIN, [ACOS] = FW_OP_ACOS,
        [ATAN] = FW_OP_ATAN, [ATAN2] = FW_OP_ATAN2, [MIN] = FW_OP_MIN,   [MAX] = FW_OP_MAX,
        [ABS] = FW_OP_ABS};
    return op[function];
}

const char *fw_quantity_function_name(int function) {
    return function >= 0 && function < COUNT ? table[function].name : NULL;
}

bool fw_quantity_dimension_differs_in_angle(fw_quantity_dimension a, fw_quantity_dimension b) {
    a.rad = b.rad = 0;
    return fw_quantity_dimension_equal(a, b);
}

bool fw_quantity_value_unify(const fw_quantity_value *a, const fw_quantity_value *b,
                             fw_quantity_dimension *common) {
    *common = a->dimension;
    if (fw_quantity_dimension_equal(a->dimension, b->dimension)) return true;
    if (!fw_quantity_dimension_differs_in_angle(a->dimension, b->dimension)) return false;
    if (b->composite) return true;
    *common = b->dimension;
    return a->composite;
}

static const char *no_root(fw_arena *arena, fw_quantity_dimension d) {
    return fw_arena_printf(arena,
                           "the square root of %s has no whole dimension; take the root of "
                           "a square, such as sqrt(a^2 + b^2)",
                           fw_quantity_dimension_phrase(arena, d));
}

static bool halve(fw_quantity_dimension *d) {
    int8_t *const part[] = {&d->m, &d->kg, &d->s, &d->A, &d->K, &d->mol, &d->rad};
    for (int i = 0; i < 7; i++) {
        if (*part[i] % 2 != 0) return false;
        *part[i] = (int8_t)(*part[i] / 2);
    }
    return true;
}

static bool dimension_allowed(takes rule, const fw_quantity_value *v) {
    static const fw_quantity_dimension none = {0}, angle = {.rad = 1};
    if (rule == TAKES_PURE || rule == TAKES_ANGLE)
        return fw_quantity_dimension_equal(v->dimension, none) ||
               (rule == TAKES_ANGLE && fw_quantity_dimension_equal(v->dimension, angle)) ||
               (v->composite && fw_quantity_dimension_differs_in_angle(v->dimension, none));
    return true;
}

static double compute(int function, const fw_quantity_value *argument, int n) {
    double x = argument[0].value;
    switch (function) {
    case SQRT:
        return sqrt(x);
    case EXP:
        return exp(x);
    case LN:
        return log(x);
    case SIN:
        return sin(x);
    case COS:
        return cos(x);
    case TAN:
        return tan(x);
    case ASIN:
        return asin(x);
    case ACOS:
        return acos(x);
    case ATAN:
        return atan(x);
    case ATAN2:
        return atan2(x, argument[1].value);
    case ABS:
        return fabs(x);
    case MIN:
    case MAX:
        break;
    }
    for (int i = 1; i < n; i++)
        x = function == MIN ? fmin(x, argument[i].value) : fmax(x, argument[i].value);
    return x;
}

/* NULL when the argument lies in the domain, else what to say */
static const char *outside_domain(int function, double x) {
    if (function == SQRT && x < 0.0)
        return "the square root of a negative number is not real; check the sign below the root";
    if (function == LN && x <= 0.0)
        return "the logarithm of zero or a negative number does not exist; its argument must be "
               "positive";
    if ((function == ASIN || function == ACOS) && fabs(x) > 1.0)
        return "asin and acos take numbers between -1 and 1; this argument lies outside";
    return NULL;
}

bool fw_quantity_function_apply(fw_arena *arena, int function, const fw_quantity_value *argument,
                                int n, fw_quantity_value *result, int *number,
                                const char **message) {
    const row *f = &table[function];
    *result =
        (fw_quantity_value){.dimension = argument[0].dimension, .composite = argument[0].composite};
    *number = 23;
    if (n < f->least || n > f->most) {
        *message = fw_arena_printf(arena, "%s takes %s%d argument%s, %d given", f->name,
                                   f->most > f->least ? "at least " : "", f->least,
                                   f->least == 1 ? "" : "s", n);
        return false;
    }
    *number = 26;
    bool varies = false;
    for (int i = 0; i < n; i++) {
        varies = varies || argument[i].varies;
        if (!dimension_allowed(f->takes, &argument[i])) {
            *message = fw_arena_printf(arena, "%s takes %s, not %s", f->name,
                                       f->takes == TAKES_ANGLE ? "an angle or a pure number"
                                                               : "a pure number",
                                       fw_quantity_dimension_phrase(arena, argument[i].dimension));
            return false;
        }
        if (f->takes == TAKES_SAME &&
            !fw_quantity_value_unify(result, &argument[i], &result->dimension)) {
            *message =
                fw_arena_printf(arena, "%s compares %s with %s; both must be the same", f->name,
                                fw_quantity_dimension_phrase(arena, result->dimension),
                                fw_quantity_dimension_phrase(arena, argument[i].dimension));
            return false;
        }
    }
    *number = 29;
    *message = argument[0].varies ? NULL : outside_domain(function, argument[0].value);
    if (*message) return false;
    if (f->gives == GIVES_ROOT && !halve(&result->dimension)) {
        *number = 30;
        *message = no_root(arena, result->dimension);
        return false;
    }
    if (f->gives == GIVES_PURE || f->gives == GIVES_ANGLE)
        *result = (fw_quantity_value){.dimension = {.rad = f->gives == GIVES_ANGLE}};
    result->varies = varies;
    result->value = varies ? (double)NAN : compute(function, argument, n);
    return true;
}
