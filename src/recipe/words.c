/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/words.h"
#include <math.h>
#include <string.h>

static bool listed(const fw_row *row, int n, const fw_quantity *q) {
    for (int i = 0; i < n; i++)
        if (row[i].q == q) return true;
    return false;
}

static const char *in_words(fw_arena *arena, const char *name) {
    char *words = fw_arena_strdup(arena, name);
    for (char *c = words; c && *c; c++)
        if (*c == '_') *c = ' ';
    return words;
}

fw_status fw_step_rows(fw_arena *arena, const fw_step *s, fw_row **row, int *n) {
    size_t most = (size_t)(s->nsetting + s->nargument + s->nneed + s->nderived);
    FW_NEED(*row = fw_arena_array(arena, fw_row, most));
    *n = 0;
    for (int i = 0; i < s->nsetting; i++)
        (*row)[(*n)++] = (fw_row){s->setting[i].name, s->setting[i].tolerance_low,
                                  s->setting[i].tolerance_high, s->setting[i].q, false};
    for (int i = 0; i < s->nargument + s->nneed; i++) {
        const fw_argument *a = i < s->nargument ? &s->argument[i] : &s->need[i - s->nargument];
        if (listed(*row, *n, a->q)) continue;
        const char *name = in_words(arena, a->name);
        FW_NEED(name);
        (*row)[(*n)++] = (fw_row){name, "", "", a->q, false};
    }
    for (int i = 0; i < s->nderived; i++)
        (*row)[(*n)++] = (fw_row){s->derived[i]->id, "", "", s->derived[i], true};
    return FW_OK;
}

double fw_row_uncertainty(const fw_quantity *q) {
    fw_unit unit;
    if (!q->unit || !fw_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL))
        return q->uncertainty;
    unit.offset = 0.0; /* a width has no zero point */
    return fw_unit_from_si(&unit, q->uncertainty);
}

void fw_put_plain(fw_text *out, double value) {
    fw_text_number(out, value, FW_PLAIN_DIGITS);
}

void fw_put_uncertainty(fw_text *out, double value) {
    fw_text_number(out, value, FW_UNCERTAINTY_DIGITS);
}

void fw_put_value(fw_text *out, double value) {
    double size = fabs(value);
    if (size >= 1e5 && size < 1e7 && floor(size) == size)
        fw_text_number(out, value, FW_UNCERTAINTY_DIGITS);
    else
        fw_text_number(out, value, size >= 100.0 && size < 1e6 ? 6 : 4);
}

static const struct {
    const char *from, *to;
} symbols[] = {{"um", "µm"},   {"Cel", "°C"}, {"Ao", "Å"},        {"ohm", "Ω"},   {"kohm", "kΩ"},
               {"Mohm", "MΩ"}, {"uN", "µN"},  {"{sccm}", "sccm"}, {"cm2", "cm²"}, {"cm3", "cm³"},
               {"m2", "m²"},   {"m3", "m³"},  {"cm-2", "cm⁻²"},   {"mm2", "mm²"}};

static void put_symbol(fw_text *out, const char *s, size_t n) {
    for (size_t i = 0; i < sizeof symbols / sizeof symbols[0]; i++)
        if (strlen(symbols[i].from) == n && memcmp(symbols[i].from, s, n) == 0) {
            fw_text_add(out, symbols[i].to);
            return;
        }
    for (size_t i = 0; i < n; i++) {
        char one[2] = {s[i], '\0'};
        fw_text_escaped(out, one);
    }
}

void fw_put_unit(fw_text *out, const char *unit) {
    if (strcmp(unit, "1") == 0) return;
    while (*unit) {
        size_t n = strcspn(unit, " /.*");
        put_symbol(out, unit, n);
        unit += n;
        if (*unit) {
            fw_text_bytes(out, unit, 1);
            unit++;
        }
    }
}

const char *fw_missing_list(fw_arena *arena, const fw_time *time) {
    fw_text list = fw_text_new(arena);
    fw_text_add(&list, "");
    for (int i = 0; i < time->nmissing; i++) {
        fw_text_add(&list, i ? ", " : "");
        fw_text_add(&list, time->missing[i]);
    }
    return fw_text_end(&list) == FW_OK ? list.data : NULL;
}
