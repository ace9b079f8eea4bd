/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A compiled expression in time: evaluation with exact first and second derivative.

   Every step works on jets (f, f', f''), the Taylor coefficients of order 0, 1, 2 in t without the
   1/n!, by Leibniz' rule for products and Faa di Bruno's for functions:
   (f g)'' = f'' g + 2 f' g' + f g'',   (h(f))'' = h''(f) f'^2 + h'(f) f''.
   Source: Griewank and Walther, Evaluating Derivatives (SIAM 2008), chapter 13. Exact up to
   round-off; cost a few operations per step, no allocation. Test: test_program.c. */
#include "quantity/program.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct jet {
    double f, d, dd;
} jet;

/* sides of abs, min, max: 1 bit per step */
typedef struct sides {
    uint64_t bit[64];
    int count;
} sides;

enum { SIDES_MOST = 64 * 64 };

/* ---- building ---- */

/* a step needs at least one byte of text of its own */
fw_status fw_quantity_program_new(fw_arena *arena, size_t n, fw_quantity_program **program) {
    fw_quantity_program *p = fw_arena_one(arena, fw_quantity_program);
    FW_NEED(p);
    FW_NEED(p->step = fw_arena_array(arena, fw_quantity_step, n + 1));
    p->room = n < 1000000 ? (int)n + 1 : 1000001;
    p->smooth = true;
    *program = p;
    return FW_OK;
}

static bool has_two_operands(fw_quantity_op op) {
    switch (op) {
    case FW_OP_ADD:
    case FW_OP_SUBTRACT:
    case FW_OP_MULTIPLY:
    case FW_OP_DIVIDE:
    case FW_OP_POWER:
    case FW_OP_ATAN2:
    case FW_OP_MIN:
    case FW_OP_MAX:
        return true;
    case FW_OP_TIME:
    case FW_OP_CONSTANT:
    case FW_OP_NEGATE:
    case FW_OP_SQRT:
    case FW_OP_EXP:
    case FW_OP_LN:
    case FW_OP_SIN:
    case FW_OP_COS:
    case FW_OP_TAN:
    case FW_OP_ASIN:
    case FW_OP_ACOS:
    case FW_OP_ATAN:
    case FW_OP_ABS:
        break;
    }
    return false;
}

void fw_quantity_program_emit(fw_quantity_program *p, fw_quantity_op op,
                              fw_quantity_operands operands, double constant) {
    bool adds = op == FW_OP_TIME || op == FW_OP_CONSTANT;
    bool pops = has_two_operands(op) && operands == FW_BOTH_ON_STACK;
    p->depth += adds - pops;
    if (p->depth > p->deepest) p->deepest = p->depth;
    if (p->depth > FW_PROGRAM_STACK || p->count == p->room) {
        p->too_deep = true;
        return;
    }
    if (op == FW_OP_ABS || op == FW_OP_ATAN2 || op == FW_OP_MIN || op == FW_OP_MAX)
        p->smooth = false;
    p->step[p->count++] = (fw_quantity_step){op, operands, constant};
}

/* ---- evaluation ---- */

/* h(f) from h, h', h'' at f; a factor that vanishes hides an infinite derivative, as in t^1 */
static jet chain(const jet *a, double h, double d1, double d2) {
    double first = a->d == 0 ? 0 : d1 * a->d;
    double curved = a->d == 0 ? 0 : d2 * a->d * a->d;
    return (jet){h, first, curved + (a->dd == 0 ? 0 : d1 * a->dd)};
}

static jet multiply(const jet *a, const jet *b) {
    return (jet){a->f * b->f, a->d * b->f + a->f * b->d,
                 a->dd * b->f + 2 * a->d * b->d + a->f * b->dd};
}

/* q = a / b from a = q b */
static jet divide(const jet *a, const jet *b) {
    double q = a->f / b->f, d = (a->d - q * b->d) / b->f;
    return (jet){q, d, (a->dd - 2 * d * b->d - q * b->dd) / b->f};
}

static double falling(double coefficient, double base, double exponent) {
    return coefficient == 0 ? 0 : coefficient * pow(base, exponent);
}

/* a^b; with a varying exponent b the base must be positive: a^b = exp(b ln a) */
static jet power(const jet *a, const jet *b) {
    double value = pow(a->f, b->f);
    if (b->d == 0 && b->dd == 0) {
        double e = b->f;
        return chain(a, value, falling(e, a->f, e - 1), falling(e * (e - 1), a->f, e - 2));
    }
    if (!(a->f > 0)) { /* 0^b is 0 for b > 0 and stays so where the base is constant */
        bool zero = a->f == 0 && b->f > 0 && a->d == 0 && a->dd == 0;
        double slope = zero ? 0 : (double)NAN;
        return (jet){zero || (a->f == 0 && b->f > 0) ? 0 : (double)NAN, slope, slope};
    }
    const jet ln = chain(a, log(a->f), 1 / a->f, -1 / (a->f * a->f));
    const jet x = multiply(b, &ln);
    return chain(&x, value, value, value);
}

/* d atan2(y, x) = (x dy - y dx) / (x^2 + y^2), scaled by h = hypot(x, y) against overflow */
static jet angle(const jet *y, const jet *x) {
    double h = hypot(x->f, y->f), c = x->f / h, s = y->f / h;
    double d = (c * y->d - s * x->d) / h;
    double dd = (c * y->dd - s * x->dd - 2 * d * (c * x->d + s * y->d)) / h;
    return (jet){atan2(y->f, x->f), d, dd};
}

static jet function(fw_quantity_op op, const jet *a) {
    double x = a->f, v, w;
    switch (op) {
    case FW_OP_SQRT:
        v = sqrt(x);
        return chain(a, v, 0.5 / v, -0.25 / (v * x));
    case FW_OP_EXP:
        v = exp(x);
        return chain(a, v, v, v);
    case FW_OP_LN:
        return chain(a, log(x), 1 / x, -1 / (x * x));
    case FW_OP_SIN:
        v = sin(x), w = cos(x);
        return chain(a, v, w, -v);
    case FW_OP_COS:
        v = cos(x), w = sin(x);
        return chain(a, v, -w, -v);
    case FW_OP_TAN:
        v = tan(x), w = 1 + v * v;
        return chain(a, v, w, 2 * v * w);
    case FW_OP_ASIN:
        w = 1 / sqrt((1 - x) * (1 + x));
        return chain(a, asin(x), w, x * w * w * w);
    case FW_OP_ACOS:
        w = 1 / sqrt((1 - x) * (1 + x));
        return chain(a, acos(x), -w, -x * w * w * w);
    case FW_OP_ATAN:
        w = 1 / (1 + x * x);
        return chain(a, atan(x), w, -2 * x * w * w);
    case FW_OP_NEGATE:
    case FW_OP_TIME: /* not functions of one operand, from here on */
    case FW_OP_CONSTANT:
    case FW_OP_ABS:
    case FW_OP_ADD:
    case FW_OP_SUBTRACT:
    case FW_OP_MULTIPLY:
    case FW_OP_DIVIDE:
    case FW_OP_POWER:
    case FW_OP_ATAN2:
    case FW_OP_MIN:
    case FW_OP_MAX:
        break;
    }
    return (jet){-a->f, -a->d, -a->dd};
}

/* true: abs keeps its argument, min and max take the left one. The first run over the program asks
   and stores (store), a second one at another time of the same piece reads. */
static bool side(fw_quantity_op op, const jet *a, const jet *b, sides *s, bool store) {
    bool first = op == FW_OP_ABS ? a->f >= 0 : op == FW_OP_MIN ? a->f <= b->f : a->f >= b->f;
    int i = s->count++;
    if (i >= SIDES_MOST) return first;
    uint64_t mask = (uint64_t)1 << (i % 64);
    if (store) {
        if (i % 64 == 0) s->bit[i / 64] = 0;
        if (first) s->bit[i / 64] |= mask;
        return first;
    }
    return (s->bit[i / 64] & mask) != 0;
}

static jet binary(const fw_quantity_step *step, const jet *a, const jet *b, sides *s, bool store) {
    switch (step->op) {
    case FW_OP_ADD:
        return (jet){a->f + b->f, a->d + b->d, a->dd + b->dd};
    case FW_OP_SUBTRACT:
        return (jet){a->f - b->f, a->d - b->d, a->dd - b->dd};
    case FW_OP_MULTIPLY:
        return multiply(a, b);
    case FW_OP_DIVIDE:
        return divide(a, b);
    case FW_OP_POWER:
        return power(a, b);
    case FW_OP_ATAN2:
        return angle(a, b);
    case FW_OP_MIN:
    case FW_OP_MAX:
    case FW_OP_TIME: /* not of two operands, from here on */
    case FW_OP_CONSTANT:
    case FW_OP_NEGATE:
    case FW_OP_SQRT:
    case FW_OP_EXP:
    case FW_OP_LN:
    case FW_OP_SIN:
    case FW_OP_COS:
    case FW_OP_TAN:
    case FW_OP_ASIN:
    case FW_OP_ACOS:
    case FW_OP_ATAN:
    case FW_OP_ABS:
        break;
    }
    return side(step->op, a, b, s, store) ? *a : *b;
}

static jet run(const fw_quantity_program *p, double t_s, sides *s, bool store) {
    jet stack[FW_PROGRAM_STACK];
    int top = -1;
    s->count = 0;
    for (int i = 0; i < p->count; i++) {
        const fw_quantity_step *step = &p->step[i];
        const jet constant = {step->constant, 0, 0};
        if (step->op == FW_OP_TIME)
            stack[++top] = (jet){t_s, 1, 0};
        else if (step->op == FW_OP_CONSTANT)
            stack[++top] = constant;
        else if (step->op == FW_OP_ABS) {
            if (!side(step->op, &stack[top], NULL, s, store))
                stack[top] = function(FW_OP_NEGATE, &stack[top]);
        } else if (!has_two_operands(step->op))
            stack[top] = function(step->op, &stack[top]);
        else if (step->operands == FW_LEFT_CONSTANT)
            stack[top] = binary(step, &constant, &stack[top], s, store);
        else if (step->operands == FW_RIGHT_CONSTANT)
            stack[top] = binary(step, &stack[top], &constant, s, store);
        else {
            stack[top - 1] = binary(step, &stack[top - 1], &stack[top], s, store);
            top--;
        }
    }
    return top == 0 ? stack[0] : (jet){(double)NAN, (double)NAN, (double)NAN};
}

void fw_quantity_program_value(const fw_quantity_program *program, double t_s, double value[3]) {
    sides s;
    jet j = run(program, t_s, &s, true);
    value[0] = j.f, value[1] = j.d, value[2] = j.dd;
}

void fw_quantity_program_value_in(const fw_quantity_program *program, double t_s, double piece_s,
                                  double value[3]) {
    sides s;
    if (program->smooth || piece_s == t_s) {
        fw_quantity_program_value(program, t_s, value);
        return;
    }
    run(program, piece_s, &s, true);
    jet j = run(program, t_s, &s, false);
    value[0] = j.f, value[1] = j.d, value[2] = j.dd;
}

/* FNV-1a over the sides */
uint64_t fw_quantity_program_branches(const fw_quantity_program *program, double t_s) {
    sides s;
    uint64_t hash = 14695981039346656037u;
    if (program->smooth) return hash;
    run(program, t_s, &s, true);
    int words = ((s.count < SIDES_MOST ? s.count : SIDES_MOST) + 63) / 64;
    for (int i = 0; i < words; i++)
        hash = (hash ^ s.bit[i]) * 1099511628211u;
    return hash;
}

bool fw_quantity_program_smooth(const fw_quantity_program *program) {
    return program->smooth;
}

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
    int8_t *const part[] = {&d->m, &d->kg, &d->s, &d->A, &d->K, &d->mol, &d->rad, &d->money};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
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
