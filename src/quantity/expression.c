/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Recursive descent: sum -> product -> signed -> power -> primary. */
#include "base/text.h"
#include "base/constants.h"
#include "quantity/program.h"
#include <math.h>
#include <string.h>

enum { DEPTH_MOST = 64 };

typedef struct parser {
    fw_arena *arena;
    fw_quantity_lexer lexer;
    fw_quantity_token token; /* the one not yet used */
    const fw_quantity_names *names;
    fw_quantity_expression_error *error;
    /* what varies with time is compiled to this; NULL: time is not known */
    fw_quantity_program *program;
    int depth;
} parser;

static const fw_quantity_dimension pure = {0};

static bool fail(parser *p, size_t offset, int number, const char *message) {
    *p->error = (fw_quantity_expression_error){offset, number, message};
    return false;
}

static bool advance(parser *p) {
    p->token = fw_quantity_lexer_next(&p->lexer);
    return p->token.kind != FW_TOKEN_WRONG;
}

static bool is_mark(const parser *p, char mark) {
    return p->token.kind == FW_TOKEN_MARK && p->token.mark == mark;
}

static const char *dimension(parser *p, fw_quantity_dimension d) {
    return fw_quantity_dimension_phrase(p->arena, d);
}

static bool finite_at(parser *p, size_t offset, const fw_quantity_value *v) {
    if (v->varies || isfinite(v->value)) return true;
    return fail(p, offset, 28,
                "the result is too large for a number (beyond 1e308); check units and exponents");
}

/* v = a op b: a step of the program when one of them varies; true when it was */
static bool emit(parser *p, fw_quantity_op op, const fw_quantity_value *a,
                 const fw_quantity_value *b, fw_quantity_value *v) {
    if (!a->varies && !b->varies) return false;
    double constant = a->varies ? b->value : a->value;
    fw_quantity_program_emit(p->program, op,
                             !a->varies   ? FW_LEFT_CONSTANT
                             : !b->varies ? FW_RIGHT_CONSTANT
                                          : FW_BOTH_ON_STACK,
                             constant);
    v->value = (double)NAN; /* not known before t is */
    v->varies = true;
    return true;
}

/* the arguments that vary lie on the stack in their order; min and max go through them from the
   back, the constant ones folded into one */
static void emit_call(parser *p, int function, const fw_quantity_value *argument, int n) {
    fw_quantity_op op = fw_quantity_function_op(function);
    if (n == 1) {
        fw_quantity_program_emit(p->program, op, FW_BOTH_ON_STACK, 0);
        return;
    }
    fw_quantity_value folded = argument[0];
    if (op == FW_OP_ATAN2) {
        emit(p, op, &argument[0], &argument[1], &folded);
        return;
    }
    fw_quantity_value constant = {.value = op == FW_OP_MIN ? (double)INFINITY : -(double)INFINITY};
    int varying = 0;
    for (int i = 0; i < n; i++) {
        const double x = argument[i].value;
        varying += argument[i].varies;
        if (!argument[i].varies)
            constant.value = op == FW_OP_MIN ? fmin(constant.value, x) : fmax(constant.value, x);
    }
    for (int i = 1; i < varying; i++)
        fw_quantity_program_emit(p->program, op, FW_BOTH_ON_STACK, 0);
    if (varying < n) fw_quantity_program_emit(p->program, op, FW_RIGHT_CONSTANT, constant.value);
}

static bool parse_sum(parser *p, fw_quantity_value *v);

/* name( a, b, ... ): the token behind the name is '(' */
static bool parse_call(parser *p, const fw_quantity_token *name, fw_quantity_value *v) {
    const char *text = p->lexer.text + name->start;
    int function = fw_quantity_function_find(text, name->length);
    if (function < 0) {
        const char *names[32];
        size_t count = 0;
        while (count < 32 && (names[count] = fw_quantity_function_name((int)count)) != NULL)
            count++;
        char *word = fw_arena_strndup(p->arena, text, name->length);
        const char *better = word ? fw_did_you_mean(word, names, count) : NULL;
        return fail(p, name->start, 23,
                    fw_arena_printf(p->arena, "unknown function '%.*s'; %s%s%s", (int)name->length,
                                    text,
                                    better ? "did you mean '" : "known are sqrt exp ln sin cos ",
                                    better ? better : "tan asin acos atan atan2 min max abs",
                                    better ? "'?" : ""));
    }
    fw_quantity_value argument[FW_ARGUMENTS_MOST];
    int n = 0;
    do {
        if (n == FW_ARGUMENTS_MOST)
            return fail(p, p->token.start, 23, "more than 16 arguments; nest the calls");
        if (!advance(p) || !parse_sum(p, &argument[n++])) return false;
    } while (is_mark(p, ','));
    if (!is_mark(p, ')'))
        return fail(p, p->token.start, 32, "a ')' is missing behind the arguments");
    int number;
    const char *message;
    if (!fw_quantity_function_apply(p->arena, function, argument, n, v, &number, &message))
        return fail(p, name->start, number, message);
    if (v->varies) emit_call(p, function, argument, n);
    return finite_at(p, name->start, v) && advance(p);
}

static bool unknown_name(parser *p, const fw_quantity_token *name) {
    const char *text = p->lexer.text + name->start;
    int n = (int)name->length;
    if (fw_quantity_unit_symbol(text, name->length))
        return fail(p, name->start, 22,
                    fw_arena_printf(p->arena,
                                    "the unit '%.*s' stands without a number; write "
                                    "'1 %.*s'; a compound unit has no parentheses: "
                                    "0.3 kg/A/s^2, not 0.3 kg/(A s^2)",
                                    n, text, n, text));
    if (fw_quantity_function_find(text, name->length) >= 0)
        return fail(
            p, name->start, 23,
            fw_arena_printf(p->arena, "'%.*s' is a function: write %.*s(...)", n, text, n, text));
    size_t count = p->names ? p->names->count : 0;
    const char **known = fw_arena_array(p->arena, const char *, count);
    char *word = fw_arena_strndup(p->arena, text, name->length);
    if (!known || !word) return fail(p, name->start, 22, NULL);
    for (size_t i = 0; i < count; i++)
        known[i] = p->names->item[i].name;
    const char *better = fw_did_you_mean(word, known, count);
    return fail(
        p, name->start, 22,
        better ? fw_arena_printf(p->arena, "no parameter '%s'; did you mean '%s'?", word, better)
               : fw_arena_printf(p->arena,
                                 "no parameter '%s'; declare it with <parameter name=\"%s\" "
                                 "value=\"...\"/>",
                                 word, word));
}

static const fw_quantity_name_value *parameter(const parser *p, const char *text, size_t n) {
    for (size_t i = 0; p->names && i < p->names->count; i++) {
        const fw_quantity_name_value *item = &p->names->item[i];
        if (strncmp(item->name, text, n) == 0 && item->name[n] == '\0') return item;
    }
    return NULL;
}

/* t or time; a parameter of the same name makes it ambiguous, and then the other word must do */
static bool parse_time(parser *p, const fw_quantity_token *name, fw_quantity_value *v) {
    const char *text = p->lexer.text + name->start;
    const char *other = name->length == 1 ? "time" : "t";
    if (parameter(p, text, name->length))
        return fail(p, name->start, 34,
                    parameter(p, other, strlen(other))
                        ? "time has no name of its own here, because parameters are called both "
                          "'t' and 'time'; rename one of them"
                        : fw_arena_printf(p->arena,
                                          "'%.*s' could mean the time or the parameter of this "
                                          "name; write '%s' for the time, or rename the parameter",
                                          (int)name->length, text, other));
    fw_quantity_program_emit(p->program, FW_OP_TIME, FW_BOTH_ON_STACK, 0);
    *v = (fw_quantity_value){.value = (double)NAN, .dimension = {.s = 1}, .varies = true};
    return true;
}

static bool parse_name(parser *p, fw_quantity_value *v) {
    fw_quantity_token name = p->token;
    const char *text = p->lexer.text + name.start;
    if (!advance(p)) return false;
    if (is_mark(p, '(')) return parse_call(p, &name, v);
    bool time =
        (name.length == 1 && text[0] == 't') || (name.length == 4 && memcmp(text, "time", 4) == 0);
    if (p->program && time) return parse_time(p, &name, v);
    const fw_quantity_name_value *item = parameter(p, text, name.length);
    if (item) {
        *v = (fw_quantity_value){.value = item->value, .dimension = item->dimension};
        return finite_at(p, name.start, v);
    }
    if (name.length == 2 && memcmp(text, "pi", 2) == 0) {
        *v = (fw_quantity_value){.value = FW_PI};
        return true;
    }
    return unknown_name(p, &name);
}

/* a comma outside of a function's arguments: mostly a decimal comma */
static bool comma(parser *p) {
    const char *text = p->lexer.text;
    size_t at = p->token.start, first = at, end = at + 1;
    while (first > 0 && text[first - 1] >= '0' && text[first - 1] <= '9')
        first--;
    while (end < p->lexer.n && text[end] >= '0' && text[end] <= '9')
        end++;
    if (first == at || end == at + 1)
        return fail(p, at, 20,
                    "a comma stands only between the arguments of a function; remove it");
    return fail(
        p, at, 20,
        fw_arena_printf(p->arena, "the decimal sign is a point, not a comma: write '%.*s.%.*s'",
                        (int)(at - first), text + first, (int)(end - at - 1), text + at + 1));
}

static bool parse_primary(parser *p, fw_quantity_value *v) {
    if (p->token.kind == FW_TOKEN_NUMBER) {
        *v = (fw_quantity_value){.value = p->token.value,
                                 .dimension = p->token.dimension,
                                 .in_degrees = p->token.zero != 0};
        return finite_at(p, p->token.start, v) && advance(p);
    }
    if (p->token.kind == FW_TOKEN_NAME) return parse_name(p, v);
    if (is_mark(p, '(')) {
        size_t open = p->token.start;
        if (!advance(p) || !parse_sum(p, v)) return false;
        if (is_mark(p, ',')) return comma(p);
        if (!is_mark(p, ')'))
            return fail(p, open, 32, "this '(' is never closed; add the missing ')'");
        return advance(p);
    }
    if (p->token.kind == FW_TOKEN_END)
        return fail(p, p->token.start, 20,
                    "the expression stops too early; a number or a name is "
                    "missing here");
    return fail(
        p, p->token.start, 20,
        fw_arena_printf(p->arena, "a number or a name is wanted here, not '%c'", p->token.mark));
}

/* pure number to a power that goes with time */
static bool raise_to_varying(parser *p, size_t offset, fw_quantity_value *base,
                             const fw_quantity_value *exponent) {
    if (!fw_quantity_dimension_equal(base->dimension, pure))
        return fail(p, offset, 30,
                    fw_arena_printf(p->arena,
                                    "%s to a power that changes with time has no dimension; the "
                                    "base must be a pure number",
                                    dimension(p, base->dimension)));
    if (!base->varies && base->value <= 0.0)
        return fail(p, offset, 29,
                    "a power that changes with time needs a positive base; check the sign");
    base->composite = false;
    emit(p, FW_OP_POWER, base, exponent, base);
    return true;
}

/* base^exponent; with a dimension only where every exponent of it stays whole */
static bool raise(parser *p, size_t offset, fw_quantity_value *base,
                  const fw_quantity_value *exponent) {
    double e = exponent->value;
    if (!fw_quantity_dimension_equal(exponent->dimension, pure))
        return fail(p, offset, 30,
                    fw_arena_printf(p->arena, "the exponent is %s; it must be a pure number",
                                    dimension(p, exponent->dimension)));
    if (exponent->varies) return raise_to_varying(p, offset, base, exponent);
    if (base->value == 0.0 && e < 0.0)
        return fail(p, offset, 27, "division by zero: zero to a negative power");
    if (base->value < 0.0 && e != rint(e))
        return fail(p, offset, 29,
                    "a negative number to a broken power is not real; check the sign of the base");
    int8_t *const part[] = {&base->dimension.m,   &base->dimension.kg,   &base->dimension.s,
                            &base->dimension.A,   &base->dimension.K,    &base->dimension.mol,
                            &base->dimension.rad, &base->dimension.money};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        double raised = *part[i] * e;
        if (raised != rint(raised) || fabs(raised) > 127.0)
            return fail(p, offset, 30,
                        fw_arena_printf(p->arena,
                                        "%s to this power has no whole dimension; powers of "
                                        "quantities must be whole and small",
                                        dimension(p, base->dimension)));
        *part[i] = (int8_t)raised;
    }
    if (!emit(p, FW_OP_POWER, base, exponent, base)) base->value = pow(base->value, e);
    return finite_at(p, offset, base);
}

static bool parse_signed(parser *p, fw_quantity_value *v);

static bool parse_power(parser *p, fw_quantity_value *v) {
    if (!parse_primary(p, v)) return false;
    if (!is_mark(p, '^')) return true;
    size_t offset = p->token.start;
    fw_quantity_value exponent;
    return advance(p) && parse_signed(p, &exponent) && raise(p, offset, v, &exponent);
}

/* -2^2 is -4; every path of nesting passes here, so here is the limit on depth */
static bool parse_signed(parser *p, fw_quantity_value *v) {
    if (++p->depth > DEPTH_MOST)
        return fail(p, p->token.start, 31,
                    "the expression is nested more than 64 deep; split it with a <parameter>");
    bool minus = is_mark(p, '-'), ok;
    if (minus || is_mark(p, '+')) {
        ok = advance(p);
        if (ok && minus && p->token.kind == FW_TOKEN_NUMBER && p->token.zero != 0) {
            p->token.value = 2 * p->token.zero - p->token.value; /* -40 Cel is 40 below zero */
            minus = false;
        }
        ok = ok && parse_signed(p, v);
        if (ok && minus) v->value = -v->value;
        if (ok && minus && v->varies)
            fw_quantity_program_emit(p->program, FW_OP_NEGATE, FW_BOTH_ON_STACK, 0);
    } else
        ok = parse_power(p, v);
    p->depth--;
    return ok;
}

static bool has_length_or_more(fw_quantity_dimension d) {
    d.rad = 0;
    return !fw_quantity_dimension_equal(d, pure);
}

static bool parse_product(parser *p, fw_quantity_value *v) {
    if (!parse_signed(p, v)) return false;
    while (is_mark(p, '*') || is_mark(p, '/')) {
        bool over = is_mark(p, '/');
        size_t offset = p->token.start;
        fw_quantity_value right;
        if (!advance(p) || !parse_signed(p, &right)) return false;
        if ((v->in_degrees && fw_quantity_dimension_equal(right.dimension, pure)) ||
            (right.in_degrees && !over && fw_quantity_dimension_equal(v->dimension, pure)))
            return fail(p, offset, 719,
                        "a temperature in Cel is no number of degrees to be multiplied: 20 Cel are "
                        "293.15 K, and twice that would be 586.3 K; write what is meant, in K or "
                        "as one number");
        v->in_degrees = false;
        if (over && right.value == 0.0)
            return fail(p, offset, 27, "division by zero; the divisor must not vanish");
        v->composite = v->composite || right.composite || has_length_or_more(v->dimension) ||
                       has_length_or_more(right.dimension);
        if (!emit(p, over ? FW_OP_DIVIDE : FW_OP_MULTIPLY, v, &right, v))
            v->value = over ? v->value / right.value : v->value * right.value;
        if (!fw_quantity_dimension_combine(&v->dimension, right.dimension, over ? -1 : 1))
            return fail(p, offset, 30, "the exponents of the dimension leave -127 to 127");
        if (!finite_at(p, offset, v)) return false;
    }
    return true;
}

static bool parse_sum(parser *p, fw_quantity_value *v) {
    if (!parse_product(p, v)) return false;
    while (is_mark(p, '+') || is_mark(p, '-')) {
        bool minus = is_mark(p, '-');
        size_t offset = p->token.start;
        fw_quantity_value right;
        if (!advance(p) || !parse_product(p, &right)) return false;
        fw_quantity_dimension common;
        if (!fw_quantity_value_unify(v, &right, &common))
            return fail(p, offset, 26,
                        fw_arena_printf(p->arena,
                                        "%s cannot be %s %s; give both sides the "
                                        "same kind of unit",
                                        dimension(p, minus ? right.dimension : v->dimension),
                                        minus ? "subtracted from" : "added to",
                                        dimension(p, minus ? v->dimension : right.dimension)));
        if (!emit(p, minus ? FW_OP_SUBTRACT : FW_OP_ADD, v, &right, v))
            v->value += minus ? -right.value : right.value;
        v->dimension = common;
        v->composite = v->composite && right.composite;
        v->in_degrees = false;
        if (!finite_at(p, offset, v)) return false;
    }
    return true;
}

static bool parse_all(parser *p, fw_quantity_value *v) {
    if (!advance(p)) return false;
    if (p->token.kind == FW_TOKEN_END)
        return fail(p, 0, 33, "the value is empty; write a number with its unit, or an expression");
    if (!parse_sum(p, v)) return false;
    if (is_mark(p, ')')) return fail(p, p->token.start, 32, "this ')' closes nothing; remove it");
    if (is_mark(p, ',')) return comma(p);
    if (p->token.kind != FW_TOKEN_END)
        return fail(p, p->token.start, 20,
                    "an operator (+ - * / ^) is missing here, or the rest is too much");
    return true;
}

static fw_status run(fw_arena *arena, const char *text, size_t n, const fw_quantity_names *names,
                     const fw_quantity_dimension *wanted, fw_quantity_program *program,
                     fw_quantity_value *v, fw_quantity_expression_error *error) {
    *error = (fw_quantity_expression_error){0};
    *v = (fw_quantity_value){0};
    parser p = {.arena = arena,
                .lexer = {.arena = arena,
                          .text = text,
                          .n = n,
                          .error = error,
                          .usual = wanted ? fw_quantity_dimension_unit(*wanted) : NULL},
                .names = names,
                .error = error,
                .program = program};
    if (parse_all(&p, v) &&
        (!program || !program->too_deep ||
         fail(&p, 0, 31,
              "too many parts wait for each other; split the expression with a <parameter>")))
        return FW_OK;
    return error->message ? FW_INPUT : FW_NOMEM;
}

static fw_status no_unit(fw_arena *arena, const char *text, size_t n, fw_quantity_dimension wanted,
                         fw_quantity_expression_error *error) {
    const char *unit = fw_quantity_dimension_unit(wanted),
               *kind = fw_quantity_dimension_phrase(arena, wanted);
    size_t first = 0, last = n;
    double ignored;
    while (first < n && (unsigned char)text[first] <= ' ')
        first++;
    while (last > first && (unsigned char)text[last - 1] <= ' ')
        last--;
    error->number = 24;
    error->offset = first;
    if (unit && fw_number_parse(text + first, last - first, &ignored))
        error->message = fw_arena_printf(arena,
                                         "'%.*s' has no unit, and %s is wanted; write for "
                                         "example '%.*s %s'",
                                         (int)(last - first), text + first, kind,
                                         (int)(last - first), text + first, unit);
    else
        error->message = fw_arena_printf(arena, "a pure number is given where %s is wanted%s%s%s",
                                         kind, unit ? "; give it a unit, for example '" : "",
                                         unit ? unit : "", unit ? "'" : "");
    return error->message ? FW_INPUT : FW_NOMEM;
}

static fw_status wrong_dimension(fw_arena *arena, fw_quantity_dimension got,
                                 fw_quantity_dimension wanted,
                                 fw_quantity_expression_error *error) {
    const char *unit = fw_quantity_dimension_unit(wanted);
    bool to_pure = fw_quantity_dimension_equal(wanted, pure);
    error->number = 25;
    error->offset = 0;
    error->message = fw_arena_printf(arena, "this is %s, and %s is wanted; %s%s%s",
                                     fw_quantity_dimension_phrase(arena, got),
                                     fw_quantity_dimension_phrase(arena, wanted),
                                     to_pure ? "leave the unit out" : "use a unit such as '",
                                     to_pure ? ""
                                     : unit  ? unit
                                             : fw_quantity_dimension_text(arena, wanted),
                                     to_pure ? "" : "'");
    return error->message ? FW_INPUT : FW_NOMEM;
}

static fw_status check_dimension(fw_arena *arena, const char *text, size_t n,
                                 const fw_quantity_value *v, fw_quantity_dimension wanted,
                                 fw_quantity_expression_error *error) {
    bool fits = fw_quantity_dimension_equal(v->dimension, wanted) ||
                (v->composite && fw_quantity_dimension_differs_in_angle(v->dimension, wanted));
    if (!fits && fw_quantity_dimension_equal(v->dimension, pure))
        return no_unit(arena, text, n, wanted, error);
    return fits ? FW_OK : wrong_dimension(arena, v->dimension, wanted, error);
}

fw_status fw_quantity_expression_evaluate(fw_arena *arena, const char *text, size_t n,
                                          const fw_quantity_names *names,
                                          fw_quantity_dimension wanted, double *value,
                                          fw_quantity_expression_error *error) {
    fw_quantity_value v;
    *value = (double)NAN;
    FW_TRY(run(arena, text, n, names, &wanted, NULL, &v, error));
    FW_TRY(check_dimension(arena, text, n, &v, wanted, error));
    *value = v.value;
    return FW_OK;
}

fw_status fw_quantity_program_compile(fw_arena *arena, const char *text, size_t n,
                                      const fw_quantity_names *names, fw_quantity_dimension wanted,
                                      fw_quantity_program **program,
                                      fw_quantity_expression_error *error) {
    fw_quantity_value v;
    fw_quantity_program *p;
    *program = NULL;
    FW_TRY(fw_quantity_program_new(arena, n, &p));
    FW_TRY(run(arena, text, n, names, &wanted, p, &v, error));
    FW_TRY(check_dimension(arena, text, n, &v, wanted, error));
    if (!v.varies) fw_quantity_program_emit(p, FW_OP_CONSTANT, FW_BOTH_ON_STACK, v.value);
    *program = p;
    return FW_OK;
}

fw_status fw_quantity_expression_evaluate_any(fw_arena *arena, const char *text, size_t n,
                                              const fw_quantity_names *names, double *value,
                                              fw_quantity_dimension *dimension_found,
                                              fw_quantity_expression_error *error) {
    fw_quantity_value v;
    *value = (double)NAN;
    *dimension_found = pure;
    FW_TRY(run(arena, text, n, names, NULL, NULL, &v, error));
    *value = v.value;
    *dimension_found = v.dimension;
    return FW_OK;
}
