/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be told of an expression without evaluating it: its names and its units. */
#include "quantity/program.h"
#include <string.h>

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
        while (end < n &&
               (text[end] == '_' || (text[end] >= '0' && text[end] <= '9') ||
                (text[end] >= 'a' && text[end] <= 'z') || (text[end] >= 'A' && text[end] <= 'Z')))
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
