/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "quantity/program.h"
#include <string.h>

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
