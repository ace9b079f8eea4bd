/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "xml/xml_reader.h"
#include "base/text.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <string.h>

static const char *const status_words[] = {"stated",   "derived", "typical",
                                           "measured", "assumed", NULL};
static const char *const true_word[] = {"true", NULL};
#define DECIMAL .kind = FW_KIND_DECIMAL
#define SIZE    DECIMAL, .ranged = true, .max = 1e300, .reason = "it is a size"
const fw_xml_attribute_row fw_xml_quantity_rows[FW_QUANTITY_ROWS] = {
    {"id", .datatype = "NCName", .required = true, .sentence = "Name that references use."},
    {"value", DECIMAL, .sentence = "In the unit; needed unless it is unknown."},
    {"word",
     .sentence = "Or what it is called, of what is no number (range=\"word\"): which resist."},
    {"u", SIZE, .sentence = "Standard uncertainty, in the unit; 0: exact."},
    {"urel", SIZE, .sentence = "Or the relative one."},
    {"spread", SIZE,
     .sentence = "Of the uncertainty, how wafers are taken to differ, standard, in the unit, where "
                 "it was not read on several of them; 0: nothing says it."},
    {"lo", DECIMAL, .sentence = "Or the lowest it can be, with hi."},
    {"hi", DECIMAL, .sentence = "The highest."},
    {"unit", .required = true, .sentence = "1 for a pure number."},
    {"status", .kind = FW_KIND_WORD, .words = status_words, .required = true,
     .sentence = "How well it is known."},
    {"u-status", .kind = FW_KIND_WORD, .words = status_words,
     .sentence = "How well its uncertainty is known, where that is not from the same source."},
    {"src", .datatype = "NCName", .required = true, .sentence = "The <source> it is from."},
    {"note", .sentence = "For people."},
    {"unknown", .kind = FW_KIND_WORD, .words = true_word,
     .sentence = "true: nobody knows it yet; what needs it is not computable."},
    {"least", DECIMAL, .sentence = "Lowest value that makes sense at all, with most."},
    {"most", DECIMAL, .sentence = "Highest value that makes sense at all."},
    {"range", .datatype = "NCName",
     .sentence = "Or the name of a range that packs share: share, efficiency, anisotropy ..."},
};

static fw_place value_place(const fw_xml_element *e, const char *name) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, name);
    return a ? a->place : e->place;
}

/* "2026-11-20", of a year that people may have measured in: what lies in another century to come is a slip of the pen */
static void check_date(const fw_xml_element *e, fw_diags *diags) {
    const fw_xml_attribute *date = fw_xml_attribute_of(e, "date");
    long day, civil[3] = {0};
    if (!date || !date->value[0]) return;
    if (strlen(date->value) == 10 && fw_quantity_date_parse(date->value, &day))
        fw_quantity_civil(day, civil);
    if (civil[0] < 1800 || civil[0] >= 2100)
        fw_diag_error(
            diags, 171, date->place,
            "source '%s': date=\"%s\" is no day of the years 1800 to 2099; write 2026-11-20",
            fw_xml_attribute_of(e, "id")->value, date->value);
}

fw_status fw_xml_sources_read(fw_arena *arena, const fw_xml_element *parent, fw_diags *diags,
                              fw_xml_source_text **source, int *nsource) {
    int count = 0;
    size_t before = diags->errors;
    for (const fw_xml_element *e = parent->first_child; e; e = e->next)
        count += strcmp(e->name, "source") == 0;
    *nsource = 0;
    FW_NEED(*source = fw_arena_array(arena, fw_xml_source_text, (size_t)count));
    for (const fw_xml_element *e = parent->first_child; e; e = e->next) {
        if (strcmp(e->name, "source") != 0) continue;
        const fw_xml_attribute *id = fw_xml_attribute_of(e, "id");
        if (!id || !id->value[0]) {
            fw_diag_error(diags, 43, e->place, "<source> has no id; add id=\"...\"");
            continue;
        }
        int twice = 0;
        for (int i = 0; i < *nsource; i++)
            twice |= strcmp((*source)[i].id, id->value) == 0;
        if (twice)
            fw_diag_error(diags, 45, id->place, "source '%s' is given twice; rename one",
                          id->value);
        const fw_xml_attribute *kind = fw_xml_attribute_of(e, "kind");
        if (!twice)
            (*source)[(*nsource)++] =
                (fw_xml_source_text){id->value, e->text, kind ? kind->value : ""};
        check_date(e, diags);
    }
    return diags->failed ? FW_NOMEM : diags->errors > before ? FW_INPUT : FW_OK;
}

static void check_names(const fw_xml_element *e, fw_diags *diags) {
    const char *known[FW_QUANTITY_ROWS];
    for (int k = 0; k < FW_QUANTITY_ROWS; k++)
        known[k] = fw_xml_quantity_rows[k].name;
    for (int i = 0; i < e->nattribute; i++) {
        int found = 0;
        for (int k = 0; k < FW_QUANTITY_ROWS && !found; k++)
            found = strcmp(known[k], e->attribute[i].name) == 0;
        if (found) continue;
        const char *better = fw_did_you_mean(e->attribute[i].name, known, FW_QUANTITY_ROWS);
        fw_diag_error(
            diags, 42, e->attribute[i].name_place, "<q> has no attribute '%s'%s%s%s",
            e->attribute[i].name, better ? "; did you mean '" : "", better ? better : "",
            better ? "'?"
                   : "; known are id value word u urel spread lo hi unit status u-status src note "
                     "unknown least most range");
    }
}

/* 1 when present and a number; absent leaves *value NaN without a word */
static int number(const fw_xml_element *e, const char *name, fw_diags *diags, double *value) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, name);
    *value = (double)NAN;
    if (!a) return 0;
    if (fw_number_parse(a->value, strlen(a->value), value)) return 1;
    *value = (double)NAN;
    fw_diag_error(diags, 70, a->place,
                  "%s=\"%s\" is not a number; write digits with '.', and the "
                  "unit in unit=\"...\"",
                  name, a->value);
    return 0;
}

static void read_unit(const fw_xml_element *e, fw_diags *diags, fw_quantity *q,
                      fw_quantity_unit *unit) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "unit");
    const char *wrong;
    size_t wrong_n;
    *unit = (fw_quantity_unit){.factor = 1.0};
    if (!a) {
        fw_diag_error(diags, 43, e->place,
                      "<q> has no unit; add unit=\"...\" (unit=\"1\" for a pure "
                      "number)");
        return;
    }
    q->unit = a->value;
    if (fw_quantity_unit_parse(a->value, strlen(a->value), unit, &wrong, &wrong_n)) {
        q->dimension = unit->dimension;
        return;
    }
    const char *better = fw_quantity_unit_suggestion(wrong, wrong_n, NULL);
    fw_diag_error(diags, 21, fw_xml_inside(a, (size_t)(wrong - a->value)),
                  "unknown unit '%.*s' in \"%s\"%s%s%s", (int)wrong_n, wrong, a->value,
                  better ? "; did you mean '" : "", better ? better : "",
                  better ? "'?" : "; the symbols are listed in docs/reference/device.md");
}

static void read_status(const fw_xml_element *e, fw_diags *diags, fw_quantity *q) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "status");
    q->status = FW_ASSUMED;
    if (!a)
        fw_diag_error(diags, 43, e->place,
                      "<q> has no status; add status=\"measured\", stated, "
                      "derived, typical or assumed");
    else if (!fw_quantity_value_status_parse(a->value, &q->status))
        fw_diag_error(diags, 48, a->place,
                      "status \"%s\" is not one of measured, stated, derived, "
                      "typical, assumed",
                      a->value);
}

/* the same words; that of the value where it is not given */
static void read_u_status(const fw_xml_element *e, fw_diags *diags, fw_quantity *q) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "u-status");
    q->u_status = q->status;
    if (a && !fw_quantity_value_status_parse(a->value, &q->u_status))
        fw_diag_error(diags, 48, a->place,
                      "u-status \"%s\" is not one of measured, stated, derived, typical, assumed",
                      a->value);
}

/* "stated" is a claim about a publication, "measured" about somebody's measurement: each needs such a source */
static void check_claim(const fw_xml_element *e, const fw_xml_attribute *src,
                        const fw_xml_source_text *s, fw_diags *diags) {
    const fw_xml_attribute *id = fw_xml_attribute_of(e, "id"),
                           *status = fw_xml_attribute_of(e, "status");
    if (!status || !s->kind || !s->kind[0]) return;
    if (strcmp(status->value, "stated") == 0 && strcmp(s->kind, "publication") != 0 &&
        strcmp(s->kind, "datasheet") != 0)
        fw_diag_error(diags, 173, src->place,
                      "'%s' has status stated, but its source is of kind %s; use typical "
                      "or assumed, or name the publication",
                      id ? id->value : "q", s->kind);
    if (strcmp(status->value, "measured") == 0 && strcmp(s->kind, "measured") != 0)
        fw_diag_error(diags, 173, src->place,
                      "'%s' has status measured, but its source is of kind %s; say who measured it "
                      "and when in a <source kind=\"measured\">, or use stated, typical or assumed",
                      id ? id->value : "q", s->kind);
}

static void read_source(const fw_xml_element *e, const fw_xml_source_text *source, int nsource,
                        fw_diags *diags, fw_quantity *q) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, "src");
    q->source = "";
    if (!a) {
        fw_diag_error(diags, 43, e->place,
                      "<q> has no src; name the <source> that the number is "
                      "from");
        return;
    }
    for (int i = 0; i < nsource; i++)
        if (strcmp(source[i].id, a->value) == 0) {
            q->source = source[i].text;
            check_claim(e, a, &source[i], diags);
            return;
        }
    fw_diag_error(diags, 46, a->place,
                  "no <source id=\"%s\"> in this file; add it, or name another", a->value);
}

/* exactly one of u, urel, lo with hi */
static void read_uncertainty(const fw_xml_element *e, fw_diags *diags, double written,
                             const fw_quantity_unit *unit, fw_quantity *q) {
    double u, urel, lo, hi;
    size_t before = diags->errors;
    int has_u = number(e, "u", diags, &u), has_urel = number(e, "urel", diags, &urel);
    int has_lo = number(e, "lo", diags, &lo), has_hi = number(e, "hi", diags, &hi);
    if (diags->errors > before) return;
    if (has_lo != has_hi || has_u + has_urel + has_lo != 1) {
        fw_diag_error(diags, 71, e->place,
                      "<q> needs exactly one uncertainty: u (standard), urel "
                      "(relative), or lo and hi together; u=\"0\" says exact");
        return;
    }
    if ((has_u && u < 0.0) || (has_urel && urel < 0.0)) {
        fw_diag_error(diags, 71, value_place(e, has_u ? "u" : "urel"),
                      "an uncertainty cannot be negative; give its size");
        return;
    }
    if (has_lo && !(lo <= written && written <= hi)) {
        fw_diag_error(diags, 71, value_place(e, "lo"),
                      "the value lies outside lo to hi; correct the "
                      "range");
        return;
    }
    double wide = has_u ? u : has_urel ? urel * fabs(written) : (hi - lo) / sqrt(12.0);
    fw_quantity_unit scale = *unit;
    scale.offset = 0.0; /* a width has no zero point */
    q->uncertainty = fw_quantity_unit_to_si(&scale, wide);
    if (has_lo) {
        q->interval = true;
        q->low = fw_quantity_unit_to_si(unit, lo), q->high = fw_quantity_unit_to_si(unit, hi);
    }
    if (!isfinite(q->uncertainty)) {
        q->uncertainty = 0.0;
        fw_diag_error(diags, 71, e->place, "the uncertainty is too large for a number");
    }
}

/* the part of the uncertainty by which wafers are taken to differ */
static void read_spread(const fw_xml_element *e, fw_diags *diags, const fw_quantity_unit *unit,
                        fw_quantity *q) {
    static const double rounding = 1e-3; /* both are written with four digits */
    double spread;
    if (!number(e, "spread", diags, &spread)) return;
    fw_quantity_unit scale = *unit;
    scale.offset = 0.0;
    q->spread_taken = true;
    q->spread = fw_quantity_unit_to_si(&scale, spread);
    if (!(q->spread >= 0.0) || q->spread > q->uncertainty * (1.0 + rounding)) {
        q->spread = 0.0;
        fw_diag_error(diags, 71, value_place(e, "spread"),
                      "spread is a part of the standard uncertainty: no less than 0, and no more "
                      "than that");
    }
}

/* what is named has neither a value nor an uncertainty, and its unit is 1 */
static void read_word(const fw_xml_element *e, const fw_xml_attribute *word, fw_diags *diags,
                      fw_quantity *q) {
    static const char *const numbers[] = {"value", "u", "urel", "lo", "hi", "spread"};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        if (fw_xml_attribute_of(e, numbers[i])) {
            fw_diag_error(diags, 728, value_place(e, numbers[i]),
                          "word=\"%.64s\" and %s exclude each other: what is named is no number; "
                          "remove one",
                          word->value, numbers[i]);
            return;
        }
    q->word = word->value;
    if (word->value[strspn(word->value, " ")] == '\0')
        fw_diag_error(diags, 728, word->place,
                      "word=\"\" says nothing; name it, or leave it unknown");
    else if (strcmp(q->unit, "1") != 0)
        fw_diag_error(diags, 728, word->place, "a word has no unit; write unit=\"1\"");
}

static void read_value(const fw_xml_element *e, fw_diags *diags, const fw_quantity_unit *unit,
                       fw_quantity *q) {
    const fw_xml_attribute *unknown = fw_xml_attribute_of(e, "unknown"),
                           *word = fw_xml_attribute_of(e, "word");
    if (unknown) {
        q->unknown = true;
        if (strcmp(unknown->value, "true") != 0)
            fw_diag_error(diags, 48, unknown->place,
                          "unknown=\"%s\"; only unknown=\"true\" has a "
                          "meaning, else leave it out",
                          unknown->value);
        if (word || fw_xml_attribute_of(e, "value"))
            fw_diag_error(diags, 70, value_place(e, word ? "word" : "value"),
                          "a %s and unknown=\"true\" exclude "
                          "each other; remove one",
                          word ? "word" : "value");
        return;
    }
    double written;
    if (word) {
        read_word(e, word, diags, q);
        return;
    }
    if (!fw_xml_attribute_of(e, "value")) {
        fw_diag_error(diags, 43, e->place,
                      "<q> has no value; add value=\"...\" or unknown=\"true\"");
        return;
    }
    if (!number(e, "value", diags, &written)) return;
    q->value = fw_quantity_unit_to_si(unit, written);
    if (!isfinite(q->value)) {
        fw_diag_error(diags, 28, value_place(e, "value"), "the value is too large in SI units");
        return;
    }
    read_uncertainty(e, diags, written, unit, q);
    read_spread(e, diags, unit, q);
}

bool fw_xml_quantity_check_range(const fw_quantity *q, const fw_quantity *range, fw_diags *diags) {
    bool given = range->least != 0.0 || range->most != 0.0;
    if (!given || q->unknown || (q->value >= range->least && q->value <= range->most)) return true;
    char value[32], least[32], most[32];
    fw_quantity bound = *range;
    bound.value = range->least;
    fw_number_text(least, sizeof least, fw_quantity_in_unit(&bound), 6);
    bound.value = range->most;
    fw_number_text(most, sizeof most, fw_quantity_in_unit(&bound), 6);
    fw_number_text(value, sizeof value, fw_quantity_in_unit(q), 6);
    fw_diag_error(diags, 278, q->place,
                  "'%s' is %s %s, outside its plausible range of %s to %s %s; check its unit (A is "
                  "ampere, Ao angstrom)",
                  q->id ? q->id : "q", value, q->unit, least, most, range->unit);
    return false;
}

/* least and most, both or none */
static void read_range(const fw_xml_element *e, fw_diags *diags, const fw_quantity_unit *unit,
                       fw_quantity *q) {
    double least, most;
    size_t before = diags->errors;
    int has_least = number(e, "least", diags, &least), has_most = number(e, "most", diags, &most);
    if (diags->errors > before || has_least + has_most == 0) return;
    if (has_least != has_most || !(least < most)) {
        fw_diag_error(diags, 71, value_place(e, has_least ? "least" : "most"),
                      "a plausible range needs least and most, the smaller one first");
        return;
    }
    q->least = fw_quantity_unit_to_si(unit, least);
    q->most = fw_quantity_unit_to_si(unit, most);
    fw_xml_quantity_check_range(q, q, diags);
}

bool fw_xml_is_token(const char *text) {
    static const char first[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_",
                      later[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789-.";
    const size_t n = strlen(text);
    return n >= 1 && n <= 64 && strchr(first, *text) && strspn(text, later) == n;
}

fw_status fw_xml_quantity_read(fw_arena *arena, const fw_xml_element *element,
                               const fw_xml_source_text *source, int nsource, fw_diags *diags,
                               fw_quantity *q) {
    (void)arena;
    size_t before = diags->errors;
    *q = (fw_quantity){.unit = "", .source = "", .place = element->place};
    check_names(element, diags);
    const fw_xml_attribute *id = fw_xml_attribute_of(element, "id");
    const fw_xml_attribute *note = fw_xml_attribute_of(element, "note"),
                           *range = fw_xml_attribute_of(element, "range");
    if (!id || !id->value[0])
        fw_diag_error(diags, 43, element->place, "<q> has no id; add id=\"...\"");
    else if (!fw_xml_is_token(id->value))
        fw_diag_error(diags, 545, id->place, "<q> id=\"%.64s\" must be " FW_XML_TOKEN, id->value);
    else
        q->id = id->value;
    q->note = note ? note->value : NULL;
    q->range = range ? range->value : NULL;
    fw_quantity_unit unit;
    read_unit(element, diags, q, &unit);
    read_status(element, diags, q);
    read_u_status(element, diags, q);
    read_source(element, source, nsource, diags, q);
    read_value(element, diags, &unit, q);
    read_range(element, diags, &unit, q);
    if (range && !q->unknown &&
        fw_quantity_is_word(q) != (q->word && strcmp(range->value, "word") == 0))
        fw_diag_error(
            diags, 728, range->place,
            q->word
                ? "range=\"%.64s\" is of numbers; what is named by word=\"...\" has range=\"word\""
                : "range=\"%.64s\": what is named has word=\"...\", and no value",
            range->value);
    if (diags->failed) return FW_NOMEM;
    if (diags->errors == before) return FW_OK;
    q->unknown = true;
    return FW_INPUT;
}

/* The attributes of time laws as rows of a table. They come from the rows of the
   laws (quantity/law_kind.h); one that several laws have stands there once, and its sentence says
   what it means in each. */

static const fw_quantity_law_attribute *find(const fw_quantity_law_kind *kind, const char *name) {
    for (int i = 0; i < kind->attributes; i++)
        if (strcmp(kind->attribute[i].name, name) == 0) return &kind->attribute[i];
    return NULL;
}

/* the first law that has the attribute with this sentence, or with any where it is NULL */
static const fw_quantity_law_kind *first_with(const char *name, const char *sentence) {
    const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds;
    for (; *kind; kind++) {
        const fw_quantity_law_attribute *a = find(*kind, name);
        if (a && (!sentence || strcmp(a->sentence, sentence) == 0)) return *kind;
    }
    return NULL;
}

/* "step, sine: nothing from then on." */
static const char *sentence_of(fw_arena *arena, const char *name) {
    fw_text text = fw_text_new(arena);
    for (const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds; *kind; kind++) {
        const fw_quantity_law_attribute *a = find(*kind, name);
        if (!a || first_with(name, a->sentence) != *kind) continue;
        fw_text_printf(&text, "%s%s", text.length ? "; " : "", (*kind)->name);
        for (const fw_quantity_law_kind *const *other = kind + 1; *other; other++) {
            const fw_quantity_law_attribute *b = find(*other, name);
            if (b && strcmp(a->sentence, b->sentence) == 0)
                fw_text_printf(&text, ", %s", (*other)->name);
        }
        fw_text_printf(&text, ": %s", a->sentence);
    }
    fw_text_add(&text, ".");
    return fw_text_end(&text) == FW_OK ? text.data : NULL;
}

static fw_xml_attribute_row row_of(const fw_quantity_law_attribute *a) {
    static const fw_xml_kind kind[] = {[FW_QUANTITY_LAW_NUMBER] = FW_KIND_NUMBER,
                                       [FW_QUANTITY_LAW_POINTS] = FW_KIND_TABLE,
                                       [FW_QUANTITY_LAW_EXPRESSION] = FW_KIND_TIMED};
    return (fw_xml_attribute_row){.name = a->name,
                                  .kind = kind[a->form],
                                  .dimension = a->dimension,
                                  .unit = a->unit,
                                  .ranged = a->least < a->most,
                                  .open = a->open,
                                  .whole = a->whole,
                                  .min = a->least,
                                  .max = a->most,
                                  .reason = a->reason,
                                  .fallback = a->absent_text};
}

/* "law" itself, a word among the names of the laws */
static fw_status choice(fw_arena *arena, fw_xml_attribute_row *row) {
    const char **words;
    size_t n = 0;
    while (fw_quantity_law_kinds[n])
        n++;
    FW_NEED(words = fw_arena_array(arena, const char *, n + 1));
    for (size_t i = 0; i < n; i++)
        words[i] = fw_quantity_law_kinds[i]->name;
    *row = (fw_xml_attribute_row){.name = "law",
                                  .kind = FW_KIND_WORD,
                                  .words = words,
                                  .fallback = words[0],
                                  .sentence = "How it goes with time: one of those above."};
    return FW_OK;
}

fw_status fw_xml_law_attributes(fw_arena *arena, fw_xml_attributes *all) {
    fw_xml_attribute_row *row;
    int n = 0;
    FW_NEED(row = fw_arena_array(arena, fw_xml_attribute_row, FW_ATTRIBUTES_MOST));
    FW_TRY(choice(arena, &row[n++]));
    for (const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds; *kind; kind++)
        for (int i = 0; i < (*kind)->attributes && n < FW_ATTRIBUTES_MOST; i++) {
            const fw_quantity_law_attribute *a = &(*kind)->attribute[i];
            if (first_with(a->name, NULL) != *kind) continue;
            row[n] = row_of(a);
            FW_NEED(row[n++].sentence = sentence_of(arena, a->name));
        }
    *all = (fw_xml_attributes){row, n};
    return FW_OK;
}

fw_status fw_xml_attributes_of(fw_arena *arena, const fw_xml_element_row *row,
                               fw_xml_attributes *all) {
    *all = (fw_xml_attributes){row->attribute, row->nattribute};
    if (!row->timed) return FW_OK;
    fw_xml_attributes law;
    fw_xml_attribute_row *both;
    FW_TRY(fw_xml_law_attributes(arena, &law));
    size_t own = (size_t)row->nattribute, more = (size_t)law.count;
    FW_NEED(both = fw_arena_array(arena, fw_xml_attribute_row, own + more));
    memcpy(both, row->attribute, own * sizeof *both);
    memcpy(both + own, law.item, more * sizeof *both);
    *all = (fw_xml_attributes){both, row->nattribute + law.count};
    return FW_OK;
}
