/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of attributes: words, ids, references and expressions with their ranges. */
#include "base/text.h"
#include "device/reader.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const fw_cell *fw_cell_of(const fw_record *record, const char *name) {
    static const fw_cell none = {0};
    for (int i = 0; i < record->nattribute; i++)
        if (strcmp(record->attribute[i].name, name) == 0) return &record->cell[i];
    return &none;
}

bool fw_given(const fw_record *record, const char *name) {
    const fw_cell *cell = fw_cell_of(record, name);
    return cell->given || cell->missing;
}

bool fw_failed(const fw_record *record, const char *name) {
    const fw_cell *cell = fw_cell_of(record, name);
    return cell->missing || (cell->given && !cell->ok);
}

double fw_number_or(const fw_record *record, const char *name, double absent) {
    const fw_cell *cell = fw_cell_of(record, name);
    if (!cell->given && !cell->missing) return absent;
    return cell->ok ? cell->number : (double)NAN;
}

double fw_number_of(const fw_record *record, const char *name) {
    return fw_number_or(record, name, (double)NAN);
}

const char *fw_text_of(const fw_record *record, const char *name) {
    const fw_cell *cell = fw_cell_of(record, name);
    return cell->given && cell->ok ? cell->given->value : NULL;
}

fw_place fw_place_of(const fw_record *record, const char *name) {
    const fw_cell *cell = fw_cell_of(record, name);
    return cell->given ? cell->given->place : record->element->place;
}

const char *fw_label(const fw_record *record, char buffer[FW_LABEL]) {
    const char *key = record->row->key ? fw_text_of(record, record->row->key) : NULL;
    if (key)
        snprintf(buffer, FW_LABEL, "%s '%s'", record->row->name, key);
    else
        snprintf(buffer, FW_LABEL, "<%s>", record->row->name);
    return buffer;
}

const char *fw_in_unit(char buffer[FW_LABEL], double value, const char *unit) {
    fw_unit u = {.factor = 1.0};
    bool pure = !unit || strcmp(unit, "1") == 0;
    if (!pure) fw_unit_parse(unit, strlen(unit), &u, NULL, NULL);
    fw_number_text(buffer, 40, fw_unit_from_si(&u, value), 6);
    if (!pure) snprintf(buffer + strlen(buffer), FW_LABEL - strlen(buffer), " %s", unit);
    return buffer;
}

int fw_count(const fw_reader *r, const char *element) {
    int count = 0;
    for (int i = 0; i < r->nrecord; i++)
        count += fw_is(&r->record[i], element);
    return count;
}

bool fw_is(const fw_record *record, const char *element) {
    return strcmp(record->row->name, element) == 0;
}

bool fw_full(const fw_reader *r) {
    return r->diags->count >= FW_DIAG_MOST;
}

bool fw_id_valid(const char *id, bool hyphen) {
    size_t n = strlen(id);
    if (n == 0 || n > 64) return false;
    for (size_t i = 0; i < n; i++) {
        bool letter =
            (id[i] >= 'a' && id[i] <= 'z') || (id[i] >= 'A' && id[i] <= 'Z') || id[i] == '_';
        bool later = (id[i] >= '0' && id[i] <= '9') || (hyphen && id[i] == '-');
        if (!letter && !(i > 0 && later)) return false;
    }
    return true;
}

static fw_status read_expression(fw_reader *r, const fw_attribute *a, const fw_dimension *wanted,
                                 fw_dimension *found, double *value, fw_expression_error *error) {
    if (!wanted)
        return fw_expression_evaluate_any(r->arena, a->value, strlen(a->value), &r->names, value,
                                          found, error);
    *found = *wanted;
    return fw_expression_evaluate(r->arena, a->value, strlen(a->value), &r->names, *wanted, value,
                                  error);
}

/* Is a name unknown, while some <parameter> has lost its name? That one is reported, and it may be
   the one that is used here. */
static bool may_be_nameless(const fw_reader *r, const fw_attribute *a,
                            const fw_expression_error *error) {
    if (error->number != 22 || !r->broken[FW_SPACE_PARAMETER]) return false;
    char word[65];
    size_t n = strspn(a->value + error->offset,
                      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
    if (n == 0 || n >= sizeof word) return false;
    memcpy(word, a->value + error->offset, n);
    word[n] = '\0';
    return !fw_expression_reserved(word);
}

fw_status fw_expression_report(fw_reader *r, const fw_attribute *a, const char *what, size_t part,
                               const fw_expression_error *error) {
    fw_expression_error whole = *error;
    whole.offset += part;
    if (may_be_nameless(r, a, &whole)) return FW_OK;
    if (a->place.line == 0)
        fw_diag_error(r->diags, error->number, a->place, "%s=\"%s\": %s", what, a->value,
                      error->message);
    else
        fw_diag_error(r->diags, error->number, fw_xml_inside(a, whole.offset), "%s: %s", what,
                      error->message);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_attribute_evaluate(fw_reader *r, const fw_attribute *a, const char *what,
                                const fw_dimension *wanted, fw_dimension *found, double *value,
                                bool *ok) {
    fw_expression_error error;
    *ok = false;
    *value = (double)NAN;
    if (fw_full(r) || fw_expression_uses(a->value, strlen(a->value), r->lost, r->nlost))
        return FW_OK;
    fw_status status = read_expression(r, a, wanted, found, value, &error);
    if (status == FW_NOMEM) return status;
    *ok = status == FW_OK;
    return *ok ? FW_OK : fw_expression_report(r, a, what, 0, &error);
}

/* "above 0 um and at most 300000 um" */
static void say_range(fw_reader *r, const fw_record *record, const fw_attribute_row *row,
                      const fw_cell *cell) {
    char label[FW_LABEL], value[FW_LABEL], low[FW_LABEL], high[FW_LABEL];
    fw_diag_error(r->diags, 47, cell->given->place,
                  "%s: %s is %s; it must be %s %s and at most %s (%s)", fw_label(record, label),
                  row->name, fw_in_unit(value, cell->number, row->unit),
                  row->open ? "above" : "at least", fw_in_unit(low, row->min, row->unit),
                  fw_in_unit(high, row->max, row->unit), row->reason);
}

/* how often a unit is written in the text */
static int count_unit(const char *text, const char *unit) {
    size_t n = strlen(unit);
    int count = 0;
    for (const char *at = strstr(text, unit); at; at = strstr(at + n, unit)) {
        bool whole = (at == text || !isalpha((unsigned char)at[-1])) &&
                     !isalnum((unsigned char)at[n]) && at[n] != '_';
        count += whole;
    }
    return count;
}

/* "20 Cel" is 293.15 K, which as a difference nobody means; "80 Cel - 20 Cel" is 60 K */
static void check_difference(fw_reader *r, const fw_record *record, const fw_attribute_row *row,
                             fw_cell *cell) {
    const fw_device *d = r->device;
    const char *text = cell->given->value;
    int points = count_unit(text, "Cel");
    for (int i = 0; i < d->nparameter; i++)
        points += strcmp(d->parameter[i].unit, "Cel") == 0 &&
                  fw_expression_uses(text, strlen(text), &d->parameter[i].name, 1);
    if (points % 2 == 0) return;
    char label[FW_LABEL];
    cell->ok = false;
    fw_diag_error(
        r->diags, 94, cell->given->place,
        "%s: %s is a difference of temperatures, and Cel counts from 273.15 K; write it in "
        "K, or as a difference such as 80 Cel - 20 Cel",
        fw_label(record, label), row->name);
}

static fw_status read_number(fw_reader *r, const fw_record *record, const fw_attribute_row *row,
                             fw_cell *cell) {
    fw_dimension found;
    FW_TRY(fw_attribute_evaluate(r, cell->given, row->name, &row->dimension, &found, &cell->number,
                                 &cell->ok));
    if (cell->ok && row->difference) check_difference(r, record, row, cell);
    /* a hair beyond a bound is rounding: "330 deg" must pass */
    if (cell->ok && row->ranged &&
        ((row->open ? cell->number <= row->min
                    : cell->number < row->min - 1e-12 * fabs(row->min)) ||
         cell->number > row->max + 1e-12 * fabs(row->max))) {
        cell->ok = false;
        say_range(r, record, row, cell);
    }
    char label[FW_LABEL], value[FW_LABEL];
    if (cell->ok && row->whole && cell->number != rint(cell->number)) {
        cell->ok = false;
        fw_diag_error(r->diags, 96, cell->given->place, "%s: %s is %s; it must be a whole number",
                      fw_label(record, label), row->name,
                      fw_in_unit(value, cell->number, row->unit));
    }
    return FW_OK;
}

static int list_words(char *list, size_t room, const char *const *words) {
    size_t used = 0;
    for (int i = 0; words[i] && used + strlen(words[i]) + 3 < room; i++)
        used += (size_t)snprintf(list + used, room - used, "%s%s", i ? ", " : "", words[i]);
    return (int)used;
}

static void read_word(fw_reader *r, const fw_record *record, const fw_attribute_row *row,
                      fw_cell *cell) {
    const fw_attribute *a = cell->given;
    char list[128] = "";
    for (int i = 0; row->words[i]; i++)
        if (strcmp(row->words[i], a->value) == 0) {
            cell->ok = true;
            return;
        }
    list_words(list, sizeof list, row->words);
    fw_diag_error(r->diags, 48, a->place, "<%s> %s=\"%.64s\" is not one of: %s", record->row->name,
                  row->name, a->value, list);
}

static void read_id(fw_reader *r, const fw_attribute_row *row, fw_cell *cell) {
    const fw_attribute *a = cell->given;
    bool name = row->kind == FW_KIND_NAME;
    cell->ok = fw_id_valid(a->value, !name);
    if (!cell->ok)
        fw_diag_error(
            r->diags, 44, a->place,
            "%s=\"%.80s\" is not a name: a letter or _ first, then letters, digits, _%s; at "
            "most 64",
            row->name, a->value, name ? "" : " and -");
    else if (name && fw_expression_reserved(a->value)) {
        cell->ok = false;
        fw_diag_error(r->diags, 54, a->place,
                      "'%s' is a unit symbol or a function and cannot name a parameter; choose "
                      "another, for example '%s0'",
                      a->value, a->value);
    } else if (row->kind == FW_KIND_ID && strcmp(a->value, "ground") == 0) {
        cell->ok = false;
        fw_diag_error(r->diags, 44, a->place,
                      "\"ground\" is given and cannot be declared; choose another id");
    }
}

static fw_status read_cell(fw_reader *r, const fw_record *record, int i) {
    const fw_attribute_row *row = &record->attribute[i];
    fw_cell *cell = &record->cell[i];
    if (!cell->given) return FW_OK;
    switch (row->kind) {
    case FW_KIND_NUMBER:
        return read_number(r, record, row, cell);
    case FW_KIND_WORD:
        read_word(r, record, row, cell);
        break;
    case FW_KIND_ID:
    case FW_KIND_NAME:
        read_id(r, row, cell);
        break;
    case FW_KIND_TEXT:
    case FW_KIND_REF:
    case FW_KIND_TIMED:
    case FW_KIND_TABLE:
        cell->ok = true;
        break; /* references wait until all ids are known, laws until their use is */
    case FW_KIND_ANY:
        break; /* parameter.c */
    }
    return FW_OK;
}

static fw_status read_cells(fw_reader *r, bool numbers) {
    for (int k = 0; k < r->nrecord; k++) {
        const fw_record *record = &r->record[k];
        for (int i = 0; i < record->nattribute; i++)
            if ((record->attribute[i].kind == FW_KIND_NUMBER) == numbers)
                FW_TRY(read_cell(r, record, i));
        if (!numbers && record->row->key && fw_failed(record, record->row->key))
            r->broken[record->row->space] = true;
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_words_read(fw_reader *r) {
    return read_cells(r, false);
}

fw_status fw_cells_read(fw_reader *r) {
    return read_cells(r, true);
}
