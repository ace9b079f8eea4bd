/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions in time. Random ones are evaluated a second time here, in complex arithmetic: the
   complex step gives the first derivative to round-off, and differences of eighth order of it the
   second. */
#include "base/text.h"
#include "quantity/program.h"
#include "quantity/quantity_law.h"
#include "test.h"
#include <complex.h>

static const fw_quantity_dimension pure = {0}, length = {.m = 1}, angle = {.rad = 1};
static const fw_quantity_name_value items[] = {{"r", 2e-3, {.m = 1}}, {"n", 3.0, {0}}};
static const fw_quantity_names names = {items, 2};

static fw_arena *arena;
static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_quantity_program *compile(const char *text, fw_quantity_dimension wanted) {
    fw_quantity_expression_error error;
    fw_quantity_program *p;
    fw_status s =
        fw_quantity_program_compile(arena, text, strlen(text), &names, wanted, &p, &error);
    if (s != FW_OK) fail_msg("%s: %zu %s", text, error.offset, error.message);
    return p;
}

static void values(void **state) {
    (void)state;
    const double pi = 3.14159265358979323846, w = 2 * pi / 10e-3;
    const struct {
        const char *text;
        fw_quantity_dimension wanted;
        double t, value[3];
    } good[] = {
        {"5", pure, 0.3, {5, 0, 0}},
        {"t/(1 s)", pure, 0.25, {0.25, 1, 0}},
        {"time/(1 s)", pure, 0.25, {0.25, 1, 0}},
        {"3 - t/(1 s)", pure, 0.25, {2.75, -1, 0}},
        {"t/(1 s) - 3", pure, 0.25, {-2.75, 1, 0}},
        {"t/(1 s) - (t/(1 s))^2", pure, 0.25, {0.1875, 0.5, -2}},
        {"-t^2/(1 s^2)", pure, 0.5, {-0.25, -1, -2}},
        {"(t/(1 s))^1", pure, 0, {0, 1, 0}},
        {"(t/(1 s))^2", pure, 0, {0, 0, 2}},
        {"(t/(1 s))^3", pure, 0, {0, 0, 0}},
        {"(t/(1 s))^0", pure, 0, {1, 0, 0}},
        {"2 s/t", pure, 0.5, {4, -8, 32}},
        {"sin(2*pi*t/(10 ms))", pure, 0, {0, w, 0}},
        {"0.2 rad * sin(2*pi*t/(10 ms))", angle, 0, {0, 0.2 * w, 0}},
        {"3 rad/s * t", angle, 2, {6, 3, 0}},
        {"r + 5 mm/s * t", length, 2, {0.012, 0.005, 0}},
        {"n*r*t/(1 s)", length, 2, {0.012, 0.006, 0}},
        {"atan2(sin(t*1 rad/s), cos(t*1 rad/s))", angle, 2, {2, 1, 0}},
        {"atan2(sin(t*1 rad/s), cos(t*1 rad/s))", angle, 4, {4 - 2 * pi, 1, 0}},
        {"atan2(t, 1 s)", angle, 1, {pi / 4, 0.5, -0.5}},
        {"atan2(1 s, t)", angle, 1, {pi / 4, -0.5, 0.5}},
        {"abs(t - 1 s)/(1 s)", pure, 0.25, {0.75, -1, 0}},
        {"min(t, 1 s, 2 s)/(1 s)", pure, 0.25, {0.25, 1, 0}},
        {"min(3 s, t, 1 s, 2*t)/(1 s)", pure, 2, {1, 0, 0}},
        {"max(t, 1 s, 2*t, t^2/(1 s))/(1 s)", pure, 3, {9, 6, 2}},
        {"2^(t/(1 s))", pure, 1, {2, 2 * log(2), 2 * log(2) * log(2)}},
        {"(t/(1 s))^(t/(1 s))", pure, 1, {1, 1, 2}},
        {"sqrt(t^2)/(1 s)", pure, 3, {3, 1, 0}},
        {"exp(ln(t/(1 s)))", pure, 3, {3, 1, 0}},
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        double v[3];
        fw_quantity_program *p = compile(good[i].text, good[i].wanted);
        fw_quantity_program_value(p, good[i].t, v);
        for (int k = 0; k < 3; k++)
            if (!(fabs(v[k] - good[i].value[k]) <= 1e-13 * (fabs(good[i].value[k]) + 1)))
                fail_msg("%s, derivative %d at %g: %.17g, not %.17g", good[i].text, k, good[i].t,
                         v[k], good[i].value[k]);
    }
}

static void constants_fold(void **state) {
    (void)state;
    double v[3], plain;
    fw_quantity_expression_error error;
    static const char *const text[] = {"2*3 + sin(0.5)", "min(4, 2, 3)", "n^2 - 1/3", "-(-2)^3"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        fw_quantity_program_value(compile(text[i], pure), 1.5, v);
        assert_int_equal(fw_quantity_expression_evaluate(arena, text[i], strlen(text[i]), &names,
                                                         pure, &plain, &error),
                         FW_OK);
        assert_true(v[0] == plain && v[1] == 0 && v[2] == 0);
    }
}

/* ---- random expressions ---- */

typedef struct tree {
    int op, a, b; /* children */
    double number;
} tree;
enum { NODES = 400 };
typedef struct forest {
    tree node[NODES];
    int count;
    uint64_t seed;
} forest;

static unsigned draw(forest *f, unsigned below) {
    f->seed = f->seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(f->seed >> 33) % below;
}

enum {
    NUMBER,
    TIME,
    ADD,
    SUB,
    MUL,
    DIV,
    SIN,
    COS,
    TAN,
    EXP,
    LN,
    SQRT,
    ASIN,
    ACOS,
    ATAN,
    ATAN2,
    POW,
    POWV,
    MIN,
    MAX,
    ABS,
    NEG,
    OPS
};

static int grow(forest *f, int depth) {
    int i = f->count++;
    if (depth == 0 || f->count > NODES - 40) {
        f->node[i] = (tree){draw(f, 3) ? TIME : NUMBER, 0, 0, 0.25 + 0.125 * draw(f, 20)};
        return i;
    }
    int op = ADD + (int)draw(f, OPS - ADD);
    int a = grow(f, depth - 1), b = grow(f, depth - 1);
    f->node[i] = (tree){op, a, b, 2 + draw(f, 3)};
    return i;
}

/* arguments are kept inside of the domains: s stands for sin(argument) */
static void write(fw_text *out, const forest *f, int i) {
    static const char *const open[OPS] = {[ADD] = "(",
                                          [SUB] = "(",
                                          [MUL] = "(",
                                          [DIV] = "(",
                                          [SIN] = "sin(",
                                          [COS] = "cos(",
                                          [TAN] = "tan(0.7*sin(",
                                          [EXP] = "exp(sin(",
                                          [LN] = "ln(3+sin(",
                                          [SQRT] = "sqrt(2+sin(",
                                          [ASIN] = "asin(0.8*sin(",
                                          [ACOS] = "acos(0.8*sin(",
                                          [ATAN] = "atan(",
                                          [ATAN2] = "atan2(",
                                          [POW] = "(2+sin(",
                                          [POWV] = "(2+sin(",
                                          [MIN] = "min(",
                                          [MAX] = "max(",
                                          [ABS] = "abs(",
                                          [NEG] = "-("};
    static const char *const between[OPS] = {
        [ADD] = ")+(",       [SUB] = ")-(",       [MUL] = ")*(", [DIV] = ")/(3+sin(",
        [ATAN2] = ",2+cos(", [POWV] = "))^(sin(", [MIN] = ",",   [MAX] = ","};
    static const char *const close[OPS] = {[ADD] = ")",
                                           [SUB] = ")",
                                           [MUL] = ")",
                                           [DIV] = "))",
                                           [SIN] = ")",
                                           [COS] = ")",
                                           [TAN] = "))",
                                           [EXP] = "))",
                                           [LN] = "))",
                                           [SQRT] = "))",
                                           [ASIN] = "))/(1 rad)",
                                           [ACOS] = "))/(1 rad)",
                                           [ATAN] = ")/(1 rad)",
                                           [ATAN2] = "))/(1 rad)",
                                           [POWV] = "))",
                                           [MIN] = ")",
                                           [MAX] = ")",
                                           [ABS] = ")",
                                           [NEG] = ")"};
    const tree *n = &f->node[i];
    if (n->op == NUMBER) {
        fw_text_number(out, n->number, 17);
        return;
    }
    if (n->op == TIME) {
        fw_text_add(out, "t/(1 s)");
        return;
    }
    if (n->op == NEG) fw_text_add(out, "(");
    fw_text_add(out, open[n->op]);
    write(out, f, n->a);
    if (between[n->op]) {
        fw_text_add(out, between[n->op]);
        write(out, f, n->b);
    }
    if (n->op == POW)
        fw_text_printf(out, "))^%d", (int)n->number);
    else
        fw_text_add(out, close[n->op]);
    if (n->op == NEG) fw_text_add(out, ")");
}

static double complex eval(const forest *f, int i, double complex t) {
    const tree *n = &f->node[i];
    if (n->op == NUMBER) return n->number;
    if (n->op == TIME) return t;
    double complex a = eval(f, n->a, t), b = 0;
    if (n->op <= DIV || n->op == ATAN2 || n->op == POWV || n->op == MIN || n->op == MAX)
        b = eval(f, n->b, t);
    switch (n->op) {
    case ADD:
        return a + b;
    case SUB:
        return a - b;
    case MUL:
        return a * b;
    case DIV:
        return a / (3 + csin(b));
    case SIN:
        return csin(a);
    case COS:
        return ccos(a);
    case TAN:
        return ctan(0.7 * csin(a));
    case EXP:
        return cexp(csin(a));
    case LN:
        return clog(3 + csin(a));
    case SQRT:
        return csqrt(2 + csin(a));
    case ASIN:
        return casin(0.8 * csin(a));
    case ACOS:
        return cacos(0.8 * csin(a));
    case ATAN:
        return catan(a);
    case ATAN2:
        return catan(a / (2 + ccos(b)));
    case POW:
        return cpow(2 + csin(a), n->number);
    case POWV:
        return cpow(2 + csin(a), csin(b));
    case MIN:
        return creal(a) <= creal(b) ? a : b;
    case MAX:
        return creal(a) >= creal(b) ? a : b;
    case ABS:
        return creal(a) >= 0 ? a : -a;
    default:
        return -a;
    }
}

/* CMPLX is not in every libc */
static double complex complex_of(double re, double im) {
    union {
        double part[2];
        double complex z;
    } u = {{re, im}};
    return u.z;
}

static double slope(const forest *f, double t) {
    const double h = 1e-40;
    return cimag(eval(f, 0, complex_of(t, h))) / h;
}

/* eighth order central difference of the slope, with the error that two step sizes show */
static double curvature(const forest *f, double t, double *error) {
    static const double c[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double sum[2];
    for (int s = 0; s < 2; s++) {
        double h = s ? 1e-3 : 2e-3;
        sum[s] = 0;
        for (int k = 0; k < 4; k++)
            sum[s] += c[k] * (slope(f, t + (k + 1) * h) - slope(f, t - (k + 1) * h)) / h;
    }
    *error = fabs(sum[0] - sum[1]);
    return sum[1];
}

/* ranges about t hold what the expression is within them, and are narrow where they are short; counts those of which
   something is known */
static int ranges(const fw_quantity_program *p, const char *text, double t) {
    double f[2], d[2], wide = 1e-3;
    int known = 0;
    for (int i = 0; i < 2; i++, wide = 0.2) {
        fw_quantity_program_range(p, t - wide, t + wide, f, d);
        for (int k = -4; k <= 4; k++) {
            double v[3];
            fw_quantity_program_value(p, t + wide * k / 4, v);
            if (isnan(v[0]) || isnan(v[1])) continue;
            if (!(f[0] <= v[0] && v[0] <= f[1] && d[0] <= v[1] && v[1] <= d[1]))
                fail_msg("%s at %g +- %g: %.17g in %.17g to %.17g, slope %.17g in %.17g to %.17g",
                         text, t, wide, v[0], f[0], f[1], v[1], d[0], d[1]);
        }
        known += i == 0 && isfinite(f[0]) && isfinite(f[1]) && isfinite(d[0]) && isfinite(d[1]);
    }
    return known;
}

static void derivatives_of_random_expressions(void **state) {
    (void)state;
    int curved = 0, known = 0;
    for (unsigned i = 0; i < 3000; i++) {
        fw_mark mark = fw_arena_mark(arena);
        forest f = {.seed = 12345 + i};
        fw_text text = fw_text_new(arena);
        grow(&f, 1 + (int)draw(&f, 4));
        write(&text, &f, 0);
        assert_int_equal(fw_text_end(&text), FW_OK);
        fw_quantity_program *p = compile(text.data, pure);
        for (int k = 0; k < 4; k++) {
            double v[3], t = 0.13 + 0.61 * k, error;
            fw_quantity_program_value(p, t, v);
            double f0 = creal(eval(&f, 0, t)), f1 = slope(&f, t), f2 = curvature(&f, t, &error);
            double size = 1 + fabs(f0) + fabs(f1);
            known += ranges(p, text.data, t);
            if (!(fabs(v[0] - f0) <= 1e-11 * size) || !(fabs(v[1] - f1) <= 1e-10 * size))
                fail_msg("%s at %g: %.17g %.17g, not %.17g %.17g", text.data, t, v[0], v[1], f0,
                         f1);
            if (error > 1e-6 * (size + fabs(f2))) continue; /* a bend or a pole is near */
            curved++;
            if (!(fabs(v[2] - f2) <= 1e-6 * (size + fabs(f2))))
                fail_msg("%s at %g: second %.17g, not %.17g", text.data, t, v[2], f2);
        }
        fw_arena_rewind(arena, mark);
    }
    assert_true(curved > 9000); /* of 12000 */
    assert_true(known > 9000);
}

/* ---- mistakes ---- */

static void mistakes(void **state) {
    (void)state;
    static const fw_quantity_name_value t_item[] = {{"t", 1e-5, {.m = 1}}};
    static const fw_quantity_name_value both[] = {{"t", 1, {0}}, {"time", 1, {0}}};
    static const fw_quantity_names with_t = {t_item, 1}, with_both = {both, 2};
    const struct {
        const char *text;
        const fw_quantity_names *names;
        fw_quantity_dimension wanted;
        int number;
        size_t offset;
        const char *says;
    } bad[] = {
        {"2*t", &names, {0}, 25, 0, "a time"},
        {"sin(t)", &names, {0}, 26, 0, "angle"},
        {"exp(t)", &names, {0}, 26, 0, "pure number"},
        {"t + 1 m", &names, {.s = 1}, 26, 2, "added"},
        {"min(t, 1 m)", &names, {.s = 1}, 26, 0, "compares"},
        {"2^t", &names, {0}, 30, 1, "exponent"},
        {"t^(t/(1 s))", &names, {0}, 30, 1, "base"},
        {"(-2)^(t/(1 s))", &names, {0}, 29, 4, "positive"},
        {"t^0.5", &names, {0}, 30, 1, "whole"},
        {"sqrt(t)", &names, {0}, 30, 0, "square root"},
        {"t/0", &names, {.s = 1}, 27, 1, "zero"},
        {"2 + ", &names, {0}, 20, 4, "missing"},
        {"tt", &names, {0}, 22, 0, "no parameter"},
        {"t/(1 s)", &with_t, {0}, 34, 0, "write 'time'"},
        {"1 + (3*t)", &with_t, {0}, 34, 7, "write 'time'"},
        {"time/(1 s)", &with_both, {0}, 34, 0, "rename"},
        {"0.1*sin(t/(1 s))", &names, {.rad = 1}, 24, 0, "angle"},
        {"", &names, {0}, 33, 0, "empty"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_quantity_expression_error e;
        fw_quantity_program *p;
        fw_status s = fw_quantity_program_compile(arena, bad[i].text, strlen(bad[i].text),
                                                  bad[i].names, bad[i].wanted, &p, &e);
        if (s != FW_INPUT || p || e.number != bad[i].number || e.offset != bad[i].offset ||
            !strstr(e.message, bad[i].says))
            fail_msg("%s: %s, %d at %zu: %s", bad[i].text, fw_status_text(s), e.number, e.offset,
                     e.message ? e.message : "");
    }
    /* time works beside a parameter t, and t beside a parameter time; without time t is a name */
    fw_quantity_expression_error e;
    fw_quantity_program *p;
    double v;
    assert_int_equal(fw_quantity_program_compile(arena, "time/(1 s)", 10, &with_t, pure, &p, &e),
                     FW_OK);
    assert_int_equal(fw_quantity_expression_evaluate(arena, "2*t", 3, &with_t, length, &v, &e),
                     FW_OK);
    assert_near(v, 2e-5, 1e-20);
    assert_int_equal(fw_quantity_expression_evaluate(arena, "2*t", 3, &names, length, &v, &e),
                     FW_INPUT);
    assert_int_equal(e.number, 22);
}

/* where the expression does not exist its value says so, and nothing traps */
static void outside_of_the_domain(void **state) {
    (void)state;
    static const char *const text[] = {"1 s/t",
                                       "ln(t/(1 s))",
                                       "sqrt(t/(1 s) - 1)",
                                       "asin(2 + t/(1 s))/(1 rad)",
                                       "(t/(1 s) - 1)^0.5",
                                       "(t/(1 s) - 1)^(1 + t/(1 s))",
                                       "exp(1e4 + t/(1 s))",
                                       "atan2(t, t)*0/(1 rad) + (t/(1 s))^-1"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        double v[3];
        fw_quantity_program_value(compile(text[i], pure), 0, v);
        assert_false(isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]));
    }
    double v[3]; /* the slope of a root at zero is infinite, of the square of it is not known */
    fw_quantity_program_value(compile("sqrt(t/(1 s))", pure), 0, v);
    assert_true(v[0] == 0 && isinf(v[1]));
    fw_quantity_program_value(compile("sin(t/(1 s))", pure), (double)INFINITY, v);
    assert_true(isnan(v[0]));
}

/* texts that nest, repeat or are random bytes end in a value or a message; the stack is bounded */
static void hostile_texts(void **state) {
    (void)state;
    static const char alphabet[] = "t 0123456789.e+-*/^(),sincoqrabx";
    forest f = {.seed = 99};
    int fine = 0;
    for (int i = 0; i < 20000; i++) {
        char text[48];
        size_t n = 1 + draw(&f, sizeof text - 1);
        for (size_t k = 0; k < n; k++)
            text[k] = alphabet[draw(&f, sizeof alphabet - 1)];
        fw_mark mark = fw_arena_mark(arena);
        fw_quantity_expression_error e;
        fw_quantity_program *p;
        fw_status s = fw_quantity_program_compile(arena, text, n, &names,
                                                  (fw_quantity_dimension){.s = 1}, &p, &e);
        assert_true(s == FW_OK || (s == FW_INPUT && e.message && e.offset <= n));
        if (s == FW_OK) {
            double v[3];
            fw_quantity_program_value(p, 0.5, v);
            fine++;
        }
        fw_arena_rewind(arena, mark);
    }
    assert_true(fine > 0);
    /* 60 calls inside each other, each with 15 values that wait: more than the stack holds */
    fw_text text = fw_text_new(arena);
    for (int i = 0; i < 60; i++)
        fw_text_add(&text, "min(t,t,t,t,t,t,t,t,t,t,t,t,t,t,t,");
    fw_text_add(&text, "t");
    for (int i = 0; i < 60; i++)
        fw_text_add(&text, ")");
    fw_quantity_expression_error e;
    fw_quantity_program *p;
    assert_int_equal(fw_quantity_program_compile(arena, text.data, text.length, &names,
                                                 (fw_quantity_dimension){.s = 1}, &p, &e),
                     FW_INPUT);
    assert_int_equal(e.number, 31);
    /* a long one that does not nest is no matter */
    text = fw_text_new(arena);
    for (int i = 0; i < 1000; i++)
        fw_text_add(&text, "t+");
    fw_text_add(&text, "t");
    double v[3];
    fw_quantity_program_value(compile(text.data, (fw_quantity_dimension){.s = 1}), 2, v);
    assert_true(v[0] == 2002 && v[1] == 1001 && v[2] == 0);
}

static void memory_runs_out(void **state) {
    (void)state;
    static const char *const text[] = {"sin(2*pi*t/(10 ms)) + min(1, t/(1 s))", "2*t + 1 m",
                                       "sinn(t)"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        for (long n = 1; n < 30; n++) {
            fw_quantity_expression_error e;
            fw_quantity_program *p;
            fw_arena_fail_at(n, 1);
            fw_status s =
                fw_quantity_program_compile(arena, text[i], strlen(text[i]), &names, pure, &p, &e);
            long used = fw_arena_count();
            fw_arena_fail_at(0, 0);
            if (used < n) break;
            assert_int_equal(s, FW_NOMEM);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values),
        cmocka_unit_test(constants_fold),
        cmocka_unit_test(derivatives_of_random_expressions),
        cmocka_unit_test(mistakes),
        cmocka_unit_test(outside_of_the_domain),
        cmocka_unit_test(hostile_texts),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
