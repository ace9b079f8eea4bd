/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A compiled expression in time: evaluation with exact first and second derivative.

   Every step works on jets (f, f', f''), the Taylor coefficients of order 0, 1, 2 in t without the
   1/n!, by Leibniz' rule for products and Faa di Bruno's for functions:
   (f g)'' = f'' g + 2 f' g' + f g'',   (h(f))'' = h''(f) f'^2 + h'(f) f''.
   Source: Griewank and Walther, Evaluating Derivatives (SIAM 2008), chapter 13. Exact up to
   round-off; cost a few operations per step, no allocation. Test: test_program.c. */
#include "quantity/program.h"
#include "base/text.h"
#include "maths/maths_interval.h"
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

/* ---- ranges ---- */

/* of the value and of its slope */
typedef struct span {
    fw_maths_interval f, d;
} span;

static const fw_maths_interval all_numbers = {(double)-INFINITY, (double)INFINITY};

static fw_maths_interval mul(fw_maths_interval a, fw_maths_interval b) {
    const fw_maths_interval x = fw_maths_interval_mul(a, b);
    return isnan(x.lo) || isnan(x.hi) ? all_numbers : x; /* 0 times infinity */
}

static fw_maths_interval over(fw_maths_interval a, fw_maths_interval b) {
    const fw_maths_interval x = fw_maths_interval_div(a, b);
    return isnan(x.lo) || isnan(x.hi) ? all_numbers : x;
}

/* of functions that rise with their argument; the library is right to a few units in the last place */
static fw_maths_interval rising(double (*of)(double), fw_maths_interval a) {
    const double lo = of(a.lo), hi = of(a.hi), few = 8 * DBL_EPSILON;
    if (isnan(lo) || isnan(hi)) return all_numbers;
    return (fw_maths_interval){lo - few * fabs(lo), hi + few * fabs(hi)};
}

static fw_maths_interval power_of(fw_maths_interval a, double e) {
    const double lo = pow(a.lo, e), hi = pow(a.hi, e), few = 8 * DBL_EPSILON;
    const bool inside = a.lo <= 0 && a.hi >= 0;
    if (e == 0) return (fw_maths_interval){1, 1};
    if (isnan(lo) || isnan(hi) || (inside && e < 0)) return all_numbers;
    double least = fmin(lo, hi), most = fmax(lo, hi);
    if (inside && least > 0) least = 0;
    return (fw_maths_interval){least - few * fabs(least), most + few * fabs(most)};
}

static span span_function(fw_quantity_op op, span a) {
    const fw_maths_interval one = {1, 1}, two = {2, 2};
    fw_maths_interval f = a.f, w;
    switch (op) {
    case FW_OP_SQRT:
        f = rising(sqrt, a.f);
        return (span){f, over(a.d, mul(two, f))};
    case FW_OP_EXP:
        f = rising(exp, a.f);
        return (span){f, mul(f, a.d)};
    case FW_OP_LN:
        return (span){rising(log, a.f), over(a.d, a.f)};
    case FW_OP_SIN:
        return (span){fw_maths_interval_sin(f), mul(fw_maths_interval_cos(f), a.d)};
    case FW_OP_COS:
        return (span){fw_maths_interval_cos(f),
                      mul(fw_interval_negated(fw_maths_interval_sin(f)), a.d)};
    case FW_OP_TAN:
        w = fw_maths_interval_cos(f);
        return (span){over(fw_maths_interval_sin(f), w), over(a.d, power_of(w, 2))};
    case FW_OP_ASIN:
    case FW_OP_ACOS:
        w = over(a.d, rising(sqrt, fw_interval_sub(one, power_of(f, 2))));
        f = rising(asin, f);
        if (op == FW_OP_ASIN) return (span){f, w};
        return (span){fw_interval_sub(rising(acos, (fw_maths_interval){0, 0}), f),
                      fw_interval_negated(w)};
    case FW_OP_ATAN:
        return (span){rising(atan, f), over(a.d, fw_interval_add(one, power_of(f, 2)))};
    case FW_OP_ABS:
        if (f.lo >= 0) return a;
        w = fw_interval_negated(f);
        if (f.hi <= 0) return (span){w, fw_interval_negated(a.d)};
        return (span){{0, fmax(w.hi, f.hi)}, fw_interval_hull(a.d, fw_interval_negated(a.d))};
    case FW_OP_NEGATE:
    case FW_OP_TIME: /* not functions of one operand, from here on */
    case FW_OP_CONSTANT:
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
    return (span){fw_interval_negated(a.f), fw_interval_negated(a.d)};
}

static span span_power(span a, span b) {
    if (b.f.lo == b.f.hi) {
        const double e = b.f.lo;
        const fw_maths_interval by = {e, e};
        return (span){power_of(a.f, e), mul(mul(by, power_of(a.f, e - 1)), a.d)};
    }
    const span ln = span_function(FW_OP_LN, a);
    const span x = {mul(b.f, ln.f), fw_interval_add(mul(b.d, ln.f), mul(b.f, ln.d))};
    return span_function(FW_OP_EXP, x);
}

static span span_binary(fw_quantity_op op, span a, span b) {
    const bool least = op == FW_OP_MIN;
    fw_maths_interval q;
    switch (op) {
    case FW_OP_ADD:
        return (span){fw_interval_add(a.f, b.f), fw_interval_add(a.d, b.d)};
    case FW_OP_SUBTRACT:
        return (span){fw_interval_sub(a.f, b.f), fw_interval_sub(a.d, b.d)};
    case FW_OP_MULTIPLY:
        return (span){mul(a.f, b.f), fw_interval_add(mul(a.d, b.f), mul(a.f, b.d))};
    case FW_OP_DIVIDE:
        q = over(a.f, b.f);
        return (span){q, over(fw_interval_sub(a.d, mul(q, b.d)), b.f)};
    case FW_OP_POWER:
        return span_power(a, b);
    case FW_OP_MIN:
    case FW_OP_MAX:
        if (least ? a.f.hi < b.f.lo : a.f.lo > b.f.hi) return a;
        if (least ? b.f.hi < a.f.lo : b.f.lo > a.f.hi) return b;
        q = least ? (fw_maths_interval){fmin(a.f.lo, b.f.lo), fmin(a.f.hi, b.f.hi)}
                  : (fw_maths_interval){fmax(a.f.lo, b.f.lo), fmax(a.f.hi, b.f.hi)};
        return (span){q, fw_interval_hull(a.d, b.d)};
    case FW_OP_ATAN2: /* no bounds of it, nor of what has not two operands */
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
    return (span){all_numbers, all_numbers};
}

/* Natural extensions of the value and of its derivative. Source: Moore, Kearfott and Cloud, Introduction to Interval
   Analysis (SIAM 2009), 5 and 6. Assumed of the library: exp, log, pow, asin, acos, atan err by less than 8 units in the
   last place. Error: outward, of first order in the width. Cost as of `run`, times five. Test: test_program.c */
void fw_quantity_program_range(const fw_quantity_program *p, double low_s, double high_s,
                               double value[2], double slope[2]) {
    span stack[FW_PROGRAM_STACK];
    int top = -1;
    for (int i = 0; i < p->count; i++) {
        const fw_quantity_step *step = &p->step[i];
        const span constant = {fw_interval_point(step->constant), {0, 0}};
        if (step->op == FW_OP_TIME)
            stack[++top] = (span){{low_s, high_s}, {1, 1}};
        else if (step->op == FW_OP_CONSTANT)
            stack[++top] = constant;
        else if (!has_two_operands(step->op))
            stack[top] = span_function(step->op, stack[top]);
        else if (step->operands == FW_LEFT_CONSTANT)
            stack[top] = span_binary(step->op, constant, stack[top]);
        else if (step->operands == FW_RIGHT_CONSTANT)
            stack[top] = span_binary(step->op, stack[top], constant);
        else {
            stack[top - 1] = span_binary(step->op, stack[top - 1], stack[top]);
            top--;
        }
    }
    const span r = top == 0 ? stack[0] : (span){all_numbers, all_numbers};
    value[0] = r.f.lo, value[1] = r.f.hi, slope[0] = r.d.lo, slope[1] = r.d.hi;
}

/* of the sides */
uint64_t fw_quantity_program_branches(const fw_quantity_program *program, double t_s) {
    sides s;
    uint64_t hash = FW_HASH_BEGIN;
    if (program->smooth) return hash;
    run(program, t_s, &s, true);
    int words = ((s.count < SIDES_MOST ? s.count : SIDES_MOST) + 63) / 64;
    for (int i = 0; i < words; i++)
        hash = fw_hash_add(hash, s.bit[i]);
    return hash;
}

bool fw_quantity_program_smooth(const fw_quantity_program *program) {
    return program->smooth;
}
