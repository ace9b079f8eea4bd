/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tokens of an expression, what they tell of it without its being evaluated (its names and its units), and the functions
   that it may call. */
#include "base/text.h"
#include "quantity/program.h"
#include <math.h>
#include <string.h>

/* ---- tokens ---- */

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static size_t skip(const char *text, size_t n, size_t i) {
    while (i < n && is_space(text[i]))
        i++;
    return i;
}

/* 12, .5, 1.5e-6; the e belongs to it only when digits follow ("2 eV" and "2eV" are units) */
static size_t number_end(const char *text, size_t n, size_t i) {
    while (i < n && is_digit(text[i]))
        i++;
    if (i < n && text[i] == '.')
        for (i++; i < n && is_digit(text[i]);)
            i++;
    size_t e = i;
    if (e < n && (text[e] == 'e' || text[e] == 'E')) {
        e++;
        if (e < n && (text[e] == '+' || text[e] == '-')) e++;
        if (e < n && is_digit(text[e])) {
            while (e < n && is_digit(text[e]))
                e++;
            return e;
        }
    }
    return i;
}

static fw_quantity_token wrong(fw_quantity_lexer *lexer, size_t start, int number,
                               const char *message) {
    *lexer->error = (fw_quantity_expression_error){start, number, message};
    return (fw_quantity_token){.kind = FW_TOKEN_WRONG, .start = start};
}

static fw_quantity_token unknown_unit(fw_quantity_lexer *lexer, const char *symbol, size_t n) {
    const char *better = fw_quantity_unit_suggestion(symbol, n, lexer->usual);
    const char *message =
        better ? fw_arena_printf(lexer->arena, "unknown unit '%.*s'; did you mean '%s'?", (int)n,
                                 symbol, better)
               : fw_arena_printf(lexer->arena,
                                 "unknown unit '%.*s'; units follow the number and are listed in "
                                 "docs/reference/device.md, for example 'um' or 'N m/rad'",
                                 (int)n, symbol);
    return wrong(lexer, (size_t)(symbol - lexer->text), 21, message);
}

/* a unit may follow a number; what could only be a misspelt unit is an error here */
static fw_quantity_token unit_after(fw_quantity_lexer *lexer, fw_quantity_token token) {
    const char *text = lexer->text;
    size_t at = skip(text, lexer->n, lexer->at), wrong_n;
    const char *symbol;
    fw_quantity_unit unit;
    size_t used = fw_quantity_unit_scan(text + at, lexer->n - at, false, &unit, &symbol, &wrong_n);
    if (used == 0) {
        bool word = wrong_n > 0 && symbol == text + at && !fw_quantity_unit_symbol(symbol, wrong_n);
        return word ? unknown_unit(lexer, symbol, wrong_n) : token;
    }
    if (used == 1 && text[at] == '1') /* "5 1": two numbers */
        return token;
    /* "5 um foo": only behind * and / may a name follow */
    size_t next = skip(text, lexer->n, at + used);
    if (symbol && wrong_n > 0 && symbol == text + next && is_letter(text[next]))
        return unknown_unit(lexer, symbol, wrong_n);
    token.value = fw_quantity_unit_to_si(&unit, token.value);
    token.zero = unit.offset;
    token.dimension = unit.dimension;
    token.unit_start = at;
    token.unit_length = used;
    lexer->at = at + used;
    token.length = lexer->at - token.start;
    return token;
}

static fw_quantity_token number(fw_quantity_lexer *lexer) {
    size_t start = lexer->at, end = number_end(lexer->text, lexer->n, start);
    fw_quantity_token token = {.kind = FW_TOKEN_NUMBER, .start = start, .length = end - start};
    if (!fw_number_parse(lexer->text + start, end - start, &token.value))
        return wrong(lexer, start, 28,
                     "this number is not finite or has too many digits; numbers lie within "
                     "1e-307 to 1e308");
    lexer->at = end;
    return unit_after(lexer, token);
}

fw_quantity_token fw_quantity_lexer_next(fw_quantity_lexer *lexer) {
    const char *text = lexer->text;
    size_t i = lexer->at = skip(text, lexer->n, lexer->at);
    if (i == lexer->n) return (fw_quantity_token){.kind = FW_TOKEN_END, .start = i};
    char c = text[i];
    if (is_digit(c) || (c == '.' && i + 1 < lexer->n && is_digit(text[i + 1])))
        return number(lexer);
    if (is_letter(c)) {
        size_t end = i;
        while (end < lexer->n && (is_letter(text[end]) || is_digit(text[end])))
            end++;
        lexer->at = end;
        return (fw_quantity_token){.kind = FW_TOKEN_NAME, .start = i, .length = end - i};
    }
    if (c != '\0' && strchr("+-*/^(),", c)) {
        lexer->at = i + 1;
        return (fw_quantity_token){.kind = FW_TOKEN_MARK, .start = i, .length = 1, .mark = c};
    }
    if ((unsigned char)c < 0x20 || (unsigned char)c > 0x7e)
        return wrong(lexer, i, 20,
                     "this character has no meaning here; expressions hold numbers, units, names, "
                     "+ - * / ^ ( ) and commas, in ASCII");
    return wrong(
        lexer, i, 20,
        fw_arena_printf(lexer->arena,
                        "'%c' has no meaning here; expressions hold numbers, units, names, "
                        "+ - * / ^ ( ) and commas",
                        c));
}

/* ---- names and units ---- */

bool fw_quantity_expression_reserved(const char *name) {
    size_t n = strlen(name);
    return strcmp(name, "pi") == 0 || fw_quantity_function_find(name, n) >= 0 ||
           fw_quantity_unit_symbol(name, n);
}

static bool listed(const char *const *names, size_t count, const char *name, size_t n) {
    for (size_t i = 0; i < count; i++)
        if (strlen(names[i]) == n && memcmp(names[i], name, n) == 0) return true;
    return false;
}

bool fw_quantity_expression_uses(const char *text, size_t n, const char *const *names,
                                 size_t count) {
    /* words, units included: a doubt may only silence a second message, never a first */
    for (size_t i = 0; i < n;) {
        size_t end = i;
        while (end < n && (is_letter(text[end]) || is_digit(text[end])))
            end++;
        if (end > i && listed(names, count, text + i, end - i)) return true;
        i = end > i ? end : i + 1;
    }
    return false;
}

fw_status fw_quantity_expression_names(fw_arena *arena, const char *text, size_t n,
                                       const char *const **names, size_t *count) {
    fw_quantity_expression_error error = {0};
    fw_quantity_lexer lexer = {.arena = arena, .text = text, .n = n, .error = &error};
    const char **list = NULL;
    size_t used = 0, room = 0;
    for (fw_quantity_token t = fw_quantity_lexer_next(&lexer); t.kind != FW_TOKEN_END;
         t = fw_quantity_lexer_next(&lexer)) {
        if (t.kind == FW_TOKEN_WRONG) { /* said by the evaluation; nothing behind it counts */
            if (!error.message) return FW_NOMEM;
            break;
        }
        const char *name = text + t.start;
        if (t.kind != FW_TOKEN_NAME || listed(list, used, name, t.length)) continue;
        char *copy = fw_arena_strndup(arena, name, t.length);
        FW_NEED(copy);
        if (fw_quantity_expression_reserved(copy)) continue;
        if (used == room) {
            FW_NEED(list = fw_arena_grow(arena, list, room, room ? 2 * room : 4, sizeof *list));
            room = room ? 2 * room : 4;
        }
        list[used++] = copy;
    }
    *names = list;
    *count = used;
    return FW_OK;
}

fw_status fw_quantity_expression_unit(fw_arena *arena, const char *text, size_t n,
                                      fw_quantity_dimension dimension, const char **unit) {
    fw_quantity_expression_error error = {0};
    fw_quantity_lexer lexer = {.arena = arena, .text = text, .n = n, .error = &error};
    *unit = "";
    for (fw_quantity_token t = fw_quantity_lexer_next(&lexer); t.kind != FW_TOKEN_END;
         t = fw_quantity_lexer_next(&lexer)) {
        if (t.kind == FW_TOKEN_WRONG) return error.message ? FW_OK : FW_NOMEM;
        if (t.kind == FW_TOKEN_NUMBER && t.unit_length > 0 &&
            fw_quantity_dimension_equal(t.dimension, dimension)) {
            FW_NEED(*unit = fw_arena_strndup(arena, text + t.unit_start, t.unit_length));
            return FW_OK;
        }
    }
    return FW_OK;
}

/* ---- functions ---- */

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
