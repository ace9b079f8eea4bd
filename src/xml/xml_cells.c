/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of attributes, read into the cells of a record: words, ids and expressions with their
   ranges. A mistake is reported once, where it is: what depends on it stays without a value in
   silence. Numbers of diagnostics that all files share stand here; the others are the table's
   (fw_xml_numbers). */
#include "xml/xml_reader.h"
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const fw_xml_cell *fw_xml_cell_of(const fw_xml_record *record, const char *name) {
    static const fw_xml_cell none = {0};
    for (int i = 0; i < record->nattribute; i++)
        if (strcmp(record->attribute[i].name, name) == 0) return &record->cell[i];
    return &none;
}

bool fw_xml_given(const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    return cell->given || cell->missing;
}

bool fw_xml_failed(const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    return cell->missing || (cell->given && !cell->ok);
}

double fw_xml_number_or(const fw_xml_record *record, const char *name, double absent) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    if (!cell->given && !cell->missing) return absent;
    return cell->ok ? cell->number : (double)NAN;
}

int fw_xml_whole_or(const fw_xml_record *record, const char *name, int otherwise) {
    const double value = fw_xml_number_or(record, name, otherwise);
    return value >= INT_MIN && value <= INT_MAX ? (int)value : otherwise;
}

double fw_xml_number_of(const fw_xml_record *record, const char *name) {
    return fw_xml_number_or(record, name, (double)NAN);
}

const char *fw_xml_text_of(const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    return cell->given && cell->ok ? cell->given->value : NULL;
}

fw_place fw_xml_place_of(const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    return cell->given ? cell->given->place : record->element->place;
}

const char *fw_xml_label(const fw_xml_record *record, char buffer[FW_LABEL]) {
    const char *key = record->row->key ? fw_xml_text_of(record, record->row->key) : NULL;
    if (key)
        snprintf(buffer, FW_LABEL, "%s '%s'", record->row->name, key);
    else
        snprintf(buffer, FW_LABEL, "<%s>", record->row->name);
    return buffer;
}

const char *fw_xml_in_unit(char buffer[FW_LABEL], double value, const char *unit) {
    fw_quantity_unit u = {.factor = 1.0};
    bool pure = !unit || strcmp(unit, "1") == 0;
    if (!pure && strcmp(unit, "um") == 0 && fabs(value) >= 0.01)
        unit = fabs(value) >= 1 ? "m" : "mm"; /* no 300000 um */
    if (!pure) fw_quantity_unit_parse(unit, strlen(unit), &u, NULL, NULL);
    /* 40 bytes hold any number; the rest of the buffer is for the unit */
    fw_number_text(buffer, 40, fw_quantity_unit_from_si(&u, value), 6);
    if (!pure) snprintf(buffer + strlen(buffer), FW_LABEL - strlen(buffer), " %s", unit);
    return buffer;
}

int fw_xml_count(const fw_xml_reader *r, const char *element) {
    int count = 0;
    for (int i = 0; i < r->nrecord; i++)
        count += fw_xml_is(&r->record[i], element);
    return count;
}

int fw_xml_children(const fw_xml_record *record, const char *element) {
    int count = 0;
    for (const fw_xml_record *c = record->first_child; c; c = c->next)
        count += fw_xml_is(c, element);
    return count;
}

bool fw_xml_is(const fw_xml_record *record, const char *element) {
    return strcmp(record->element->name, element) == 0;
}

bool fw_xml_full(const fw_diags *diags) {
    return diags->count >= FW_DIAG_MOST;
}

const fw_xml_numbers *fw_xml_numbers_of(const fw_xml_reader *r, const fw_xml_element_row *row) {
    return row && row->numbers ? row->numbers : &r->table->numbers;
}

static bool id_valid(const char *id, bool hyphen) {
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

/* wanted NULL: any dimension, which comes back in *found */
static fw_status read_expression(fw_xml_reader *r, const fw_xml_attribute *a,
                                 const fw_quantity_dimension *wanted, fw_quantity_dimension *found,
                                 double *value, fw_quantity_expression_error *error) {
    if (!wanted)
        return fw_quantity_expression_evaluate_any(r->arena, a->value, strlen(a->value), &r->names,
                                                   value, found, error);
    *found = *wanted;
    return fw_quantity_expression_evaluate(r->arena, a->value, strlen(a->value), &r->names, *wanted,
                                           value, error);
}

/* Is a name unknown (FW-D22), while that of some <parameter> could not be read? That mistake has
   been reported, and it may be this very name: to miss it here as well would report one mistake
   twice. A reserved word, a unit or a function, is never the name of a parameter. */
static bool may_be_unread_name(const fw_xml_reader *r, const fw_xml_attribute *a,
                               const fw_quantity_expression_error *error) {
    if (error->number != 22 || !r->table->names || !r->broken[r->table->names]) return false;
    char word[65];
    size_t n = strspn(a->value + error->offset,
                      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
    if (n == 0 || n >= sizeof word) return false;
    memcpy(word, a->value + error->offset, n);
    word[n] = '\0';
    return !fw_quantity_expression_reserved(word);
}

fw_status fw_xml_expression_report(fw_xml_reader *r, const fw_xml_attribute *a, const char *what,
                                   size_t part, const fw_quantity_expression_error *error) {
    fw_quantity_expression_error in_value = *error;
    in_value.offset += part;
    if (may_be_unread_name(r, a, &in_value)) return FW_OK;
    if (a->place.line == 0) /* from --set: there is no line to point into, so the text is shown */
        fw_diag_error(r->diags, error->number, a->place, "%s=\"%s\": %s", what, a->value,
                      error->message);
    else
        fw_diag_error(r->diags, error->number, fw_xml_inside(a, in_value.offset), "%s: %s", what,
                      error->message);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* FW_INPUT: the expression is wrong, and `error` says how. FW_OK with *ok false: nothing is to be
   said, because the report is full or the expression uses a name whose own value has failed. */
static fw_status evaluate(fw_xml_reader *r, const fw_xml_attribute *a,
                          const fw_quantity_dimension *wanted, fw_quantity_dimension *found,
                          double *value, bool *ok, fw_quantity_expression_error *error) {
    *ok = false;
    *value = (double)NAN;
    if (fw_xml_full(r->diags) ||
        fw_quantity_expression_uses(a->value, strlen(a->value), r->lost, r->nlost))
        return FW_OK;
    fw_status status = read_expression(r, a, wanted, found, value, error);
    *ok = status == FW_OK;
    return status == FW_OK || status == FW_NOMEM ? status : FW_INPUT;
}

fw_status fw_xml_attribute_evaluate(fw_xml_reader *r, const fw_xml_attribute *a, const char *what,
                                    const fw_quantity_dimension *wanted,
                                    fw_quantity_dimension *found, double *value, bool *ok) {
    fw_quantity_expression_error error;
    fw_status status = evaluate(r, a, wanted, found, value, ok, &error);
    return status == FW_INPUT ? fw_xml_expression_report(r, a, what, 0, &error) : status;
}

/* a number with at most a unit behind it: "-1 mm" */
static bool is_plain(const char *text) {
    double number;
    const size_t n = strcspn(text, " ");
    return fw_number_parse(text, n, &number) && strcspn(text + n, "+-*/^(") == strlen(text + n);
}

/* "above 0 um and at most 300 mm"; a value as it is written, and what an expression comes to. What has no id of its own is
   named by what it stands in */
static void report_range(fw_xml_reader *r, const fw_xml_record *record,
                         const fw_xml_attribute_row *row, const fw_xml_cell *cell) {
    char label[FW_LABEL], in[FW_LABEL], value[FW_LABEL], low[FW_LABEL], high[FW_LABEL];
    const bool named =
        record->parent > 0 && !(record->row->key && fw_xml_text_of(record, record->row->key));
    const bool plain = is_plain(cell->given->value);
    fw_diag_error(r->diags, fw_xml_numbers_of(r, record->row)->range, cell->given->place,
                  "%s%s%s: %s is %s%s%s; it must be %s %s and at most %s (%s)",
                  fw_xml_label(record, label), named ? " of " : "",
                  named ? fw_xml_label(&r->record[record->parent], in) : "", row->name,
                  plain ? "" : cell->given->value, plain ? "" : ", which is ",
                  plain ? cell->given->value : fw_xml_in_unit(value, cell->number, row->unit),
                  row->open ? "above" : "at least", fw_xml_in_unit(low, row->min, row->unit),
                  fw_xml_in_unit(high, row->max, row->unit), row->reason);
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

/* "20 Cel" is 293.15 K, which as a difference nobody means; "80 Cel - 20 Cel" is 60 K. Each reading
   in degrees Celsius brings 273.15 K along, and in a difference they cancel in pairs: so an odd
   number of them is wrong. An even number may be wrong too (a sum); that is not looked for. */
static void check_difference(fw_xml_reader *r, const fw_xml_record *record,
                             const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const char *text = cell->given->value;
    int readings = count_unit(text, "Cel");
    for (size_t i = 0; i < r->ncelsius; i++)
        readings += fw_quantity_expression_uses(text, strlen(text), &r->celsius[i], 1);
    if (readings % 2 == 0) return;
    char label[FW_LABEL];
    cell->ok = false;
    fw_diag_error(
        r->diags, 94, cell->given->place,
        "%s: %s is a difference of temperatures, and Cel counts from 273.15 K; write it in "
        "K, or as a difference such as 80 Cel - 20 Cel",
        fw_xml_label(record, label), row->name);
}

/* The range, and whether it is whole. A value may be beyond a bound by 1e-12 of it: that is
   rounding, for "330 deg" in radians need not have the bits of a bound of 330 deg. A lower bound
   that is itself excluded is taken as it is. */
static void check_number(fw_xml_reader *r, const fw_xml_record *record,
                         const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const double least = row->min - 1e-12 * fabs(row->min);
    const double most = row->max + 1e-12 * fabs(row->max);
    if (row->ranged &&
        ((row->open ? cell->number <= row->min : cell->number < least) || cell->number > most)) {
        cell->ok = false;
        report_range(r, record, row, cell);
    }
    char label[FW_LABEL], value[FW_LABEL];
    if (cell->ok && row->whole && cell->number != rint(cell->number)) {
        cell->ok = false;
        fw_diag_error(r->diags, fw_xml_numbers_of(r, record->row)->whole, cell->given->place,
                      "%s: %s is %s; it must be a whole number", fw_xml_label(record, label),
                      row->name, fw_xml_in_unit(value, cell->number, row->unit));
    }
}

/* a wrong expression has the table's number where that has one for it, else the expression's own */
static fw_status read_number(fw_xml_reader *r, const fw_xml_record *record,
                             const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const fw_xml_numbers *numbers = fw_xml_numbers_of(r, record->row);
    fw_quantity_expression_error error;
    fw_quantity_dimension found;
    fw_status status =
        evaluate(r, cell->given, &row->dimension, &found, &cell->number, &cell->ok, &error);
    if (status == FW_INPUT && numbers->expression)
        fw_diag_error(r->diags, numbers->expression, cell->given->place, "%s: %s", row->name,
                      error.message);
    else if (status == FW_INPUT)
        return fw_xml_expression_report(r, cell->given, row->name, 0, &error);
    else if (status != FW_OK)
        return status;
    if (cell->ok && row->difference) check_difference(r, record, row, cell);
    if (cell->ok) check_number(r, record, row, cell);
    return FW_OK;
}

/* digits without a unit */
static void read_decimal(fw_xml_reader *r, const fw_xml_record *record,
                         const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const fw_xml_attribute *a = cell->given;
    cell->ok = fw_number_parse(a->value, strlen(a->value), &cell->number);
    if (cell->ok)
        check_number(r, record, row, cell);
    else
        fw_diag_error(r->diags, fw_xml_numbers_of(r, record->row)->decimal, a->place,
                      "<%s> %s=\"%.64s\" is not a number; write digits, with '.' and e where "
                      "needed",
                      record->row->name, row->name, a->value);
}

/* text (n) among the words; -1: it is none of them */
static int word_index(const char *const *words, const char *text, size_t n) {
    for (int i = 0; words[i]; i++)
        if (strlen(words[i]) == n && memcmp(words[i], text, n) == 0) return i;
    return -1;
}

/* `text` (n) is none of the words: says which there are, and which one it may have been. No such
   search where the report is full, for it would not be seen. */
static void say_word(fw_xml_reader *r, const fw_xml_record *record, const fw_xml_attribute_row *row,
                     const fw_xml_attribute *a, const char *text, size_t n) {
    char list[256] = "", wrong[65] = "";
    size_t used = 0, count = 0;
    for (const char *const *word = row->words; *word; word++, count++)
        if (used + strlen(*word) + 3 < sizeof list)
            used +=
                (size_t)snprintf(list + used, sizeof list - used, "%s%s", count ? ", " : "", *word);
    memcpy(wrong, text, n < sizeof wrong ? n : sizeof wrong - 1);
    const char *better = fw_xml_full(r->diags) ? NULL : fw_did_you_mean(wrong, row->words, count);
    fw_diag_error(r->diags, fw_xml_numbers_of(r, record->row)->word, a->place,
                  "<%s> %s=\"%s\" is not one of: %s%s%s%s", record->row->name, row->name, wrong,
                  list, FW_DID_YOU_MEAN(better));
}

static void read_word(fw_xml_reader *r, const fw_xml_record *record,
                      const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const fw_xml_attribute *a = cell->given;
    cell->ok = word_index(row->words, a->value, strlen(a->value)) >= 0;
    if (!cell->ok) say_word(r, record, row, a, a->value, strlen(a->value));
}

/* words with blanks between; every wrong one is reported */
static void read_words(fw_xml_reader *r, const fw_xml_record *record,
                       const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const fw_xml_attribute *a = cell->given;
    cell->ok = true;
    const char *words = a->value;
    for (fw_word word; fw_word_next(&words, " \t\r\n", &word);)
        if (word_index(row->words, word.at, word.length) < 0) {
            cell->ok = false;
            say_word(r, record, row, a, word.at, word.length);
        }
}

static void read_form(fw_xml_reader *r, const fw_xml_record *record,
                      const fw_xml_attribute_row *row, fw_xml_cell *cell) {
    const fw_xml_attribute *a = cell->given;
    cell->ok = row->form(a->value);
    if (!cell->ok)
        fw_diag_error(r->diags, fw_xml_numbers_of(r, record->row)->form, a->place,
                      "<%s> %s=\"%.64s\" must be %s", record->row->name, row->name, a->value,
                      row->reason);
}

static void read_id(fw_xml_reader *r, const fw_xml_record *record, const fw_xml_attribute_row *row,
                    fw_xml_cell *cell) {
    const fw_xml_attribute *a = cell->given;
    const int number = fw_xml_numbers_of(r, record->row)->name;
    bool name = row->kind == FW_KIND_NAME;
    cell->ok = id_valid(a->value, !name);
    if (!cell->ok)
        fw_diag_error(
            r->diags, number, a->place,
            "%s=\"%.80s\" is not a name: a letter or _ first, then letters, digits, _%s; at "
            "most 64",
            row->name, a->value, name ? "" : " and -");
    else if (name && fw_quantity_expression_reserved(a->value)) {
        cell->ok = false;
        fw_diag_error(r->diags, 54, a->place,
                      "'%s' is a unit symbol or a function and cannot name a parameter; choose "
                      "another, for example '%s0'",
                      a->value, a->value);
    } else if (row->kind == FW_KIND_ID && strcmp(a->value, "ground") == 0) {
        cell->ok = false;
        fw_diag_error(r->diags, number, a->place,
                      "\"ground\" is given and cannot be declared; choose another id");
    }
}

static fw_status read_cell(fw_xml_reader *r, const fw_xml_record *record, int i) {
    const fw_xml_attribute_row *row = &record->attribute[i];
    fw_xml_cell *cell = &record->cell[i];
    if (!cell->given) return FW_OK;
    switch (row->kind) {
    case FW_KIND_NUMBER:
        return read_number(r, record, row, cell);
    case FW_KIND_WORD:
        read_word(r, record, row, cell);
        break;
    case FW_KIND_ID:
    case FW_KIND_NAME:
        read_id(r, record, row, cell);
        break;
    case FW_KIND_WORDS:
        read_words(r, record, row, cell);
        break;
    case FW_KIND_FORM:
        read_form(r, record, row, cell);
        break;
    case FW_KIND_DECIMAL:
        read_decimal(r, record, row, cell);
        break;
    case FW_KIND_TEXT:
    case FW_KIND_REF:
    case FW_KIND_TIMED:
    case FW_KIND_TABLE:
        cell->ok = true;
        break; /* References wait until all ids are known; laws and tables in time until it is
                  known what they drive, and so their dimension. */
    case FW_KIND_ANY:
        break; /* The value of a parameter: device/parameter.c reads it. */
    }
    return FW_OK;
}

static bool is_number(fw_xml_kind kind) {
    return kind == FW_KIND_NUMBER || kind == FW_KIND_DECIMAL;
}

/* All numbers, or all else. Numbers come second, because expressions use the names that are read
   first. An element that stands apart is read by a function of its own. A key that failed is noted
   for its space: whoever misses that id later keeps silent. */
static fw_status read_cells(fw_xml_reader *r, bool numbers) {
    for (int k = 0; k < r->nrecord; k++) {
        const fw_xml_record *record = &r->record[k];
        if (record->row->apart) continue;
        for (int i = 0; i < record->nattribute; i++)
            if (is_number(record->attribute[i].kind) == numbers) FW_TRY(read_cell(r, record, i));
        if (!numbers && record->row->key && fw_xml_failed(record, record->row->key))
            r->broken[record->row->space] = true;
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_xml_words_read(fw_xml_reader *r) {
    return read_cells(r, false);
}

fw_status fw_xml_numbers_read(fw_xml_reader *r) {
    return read_cells(r, true);
}
