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
