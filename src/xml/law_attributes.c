/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The attributes of time laws as rows of a table. They come from the rows of the
   laws (quantity/law_kind.h); one that several laws have stands there once, and its sentence says
   what it means in each. */
#include "base/text.h"
#include "quantity/law_kind.h"
#include "xml/xml_table.h"
#include <string.h>

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
