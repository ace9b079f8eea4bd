/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which elements and attributes there are, and which are missing. */
#include "base/text.h"
#include "base/sort.h"
#include "xml/xml_reader.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- rows of a table ---- */

const fw_xml_element_row *fw_xml_row_at(const fw_xml_table *table, int i) {
    for (int k = 0; table->part[k] && i >= 0; k++)
        for (const fw_xml_element_row *row = table->part[k]; row->name; row++)
            if (i-- == 0) return row;
    return NULL;
}

int fw_xml_row_index(const fw_xml_table *table, const char *name) {
    int i = 0;
    for (int k = 0; table->part[k]; k++)
        for (const fw_xml_element_row *row = table->part[k]; row->name; row++, i++)
            if (strcmp(row->name, name) == 0) return i;
    return -1;
}

const fw_xml_element_row *fw_xml_row_find(const fw_xml_table *table, const char *name) {
    return fw_xml_row_at(table, fw_xml_row_index(table, name));
}

bool fw_xml_row_inside(const fw_xml_element_row *row, const char *parent) {
    if (!parent[0]) return !row->parent[0];
    return fw_words_hold(row->parent, " ", parent);
}

int fw_xml_row_index_in(const fw_xml_table *table, const char *name, const char *parent) {
    int i = 0;
    for (int k = 0; table->part[k]; k++)
        for (const fw_xml_element_row *row = table->part[k]; row->name; row++, i++)
            if (strcmp(row->name, name) == 0 && fw_xml_row_inside(row, parent)) return i;
    return fw_xml_row_index(table, name);
}

const fw_xml_element_row *fw_xml_row_in(const fw_xml_table *table, const char *name,
                                        const char *parent) {
    return fw_xml_row_at(table, fw_xml_row_index_in(table, name, parent));
}

/* ---- from elements to records ---- */

static void unknown_element(fw_xml_reader *r, const fw_xml_element *e,
                            const fw_xml_element_row *inside) {
    const char *parent = inside ? inside->name : "";
    const int number = fw_xml_numbers_of(r, inside)->element;
    const char *names[FW_ELEMENTS_MOST];
    size_t n = 0;
    const fw_xml_element_row *row;
    for (int i = 0; (row = fw_xml_row_at(r->table, i)) != NULL && n < FW_ELEMENTS_MOST; i++)
        if (fw_xml_row_inside(row, parent)) names[n++] = row->name;
    const char *better = fw_xml_full(r->diags) ? NULL : fw_did_you_mean(e->name, names, n);
    r->unknown_element = true;
    if (better) { /* what it would have declared is not missed again */
        r->broken[fw_xml_row_find(r->table, better)->space] = true;
        fw_diag_error(r->diags, number, e->place, "<%s> is not known; did you mean <%s>?", e->name,
                      better);
        return;
    }
    char list[512] = "nothing";
    size_t used = 0;
    for (size_t i = 0; i < n && used + strlen(names[i]) + 4 < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s<%s>", i ? " " : "", names[i]);
    fw_diag_error(r->diags, number, e->place, "<%.64s> is not known inside <%s>; allowed are: %s",
                  e->name, parent, list);
}

/* an attribute that was probably meant counts as there and failed, so that it is not missed again
 */
static void unknown_attribute(fw_xml_reader *r, fw_xml_record *record, const fw_xml_attribute *a) {
    const fw_xml_element_row *row = record->row;
    const fw_xml_numbers *numbers = fw_xml_numbers_of(r, row);
    const fw_place place = numbers->at_value ? a->place : a->name_place;
    char list[512] = "it has none";
    size_t used = 0;
    const char *names[FW_XML_ATTRIBUTES_MOST];
    const size_t all = (size_t)record->nattribute,
                 n = all < FW_XML_ATTRIBUTES_MOST ? all : FW_XML_ATTRIBUTES_MOST;
    for (size_t i = 0; i < n; i++) {
        const char *name = names[i] = record->attribute[i].name;
        if (used + strlen(name) + 2 < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? " " : "", name);
    }
    const char *better = fw_xml_full(r->diags) ? NULL : fw_did_you_mean(a->name, names, n);
    if (better) {
        size_t best = 0;
        while (names[best] != better)
            best++;
        record->cell[best].missing = true;
        fw_diag_error(r->diags, numbers->attribute, place,
                      "<%s> has no attribute '%s'; did you mean '%s'?", row->name, a->name, better);
    } else
        fw_diag_error(r->diags, numbers->attribute, place,
                      "<%s> has no attribute '%.64s'; known are: %s", row->name, a->name, list);
}

static void read_attributes(fw_xml_reader *r, fw_xml_record *record) {
    const fw_xml_element_row *row = record->row;
    for (int i = 0; i < record->element->nattribute; i++) {
        const fw_xml_attribute *a = &record->element->attribute[i];
        int k = 0;
        while (k < record->nattribute && strcmp(record->attribute[k].name, a->name) != 0)
            k++;
        if (k < record->nattribute)
            record->cell[k].given = a;
        else if (!row->apart)
            unknown_attribute(r, record, a);
    }
    if (row->apart) return;
    for (int k = 0; k < record->nattribute; k++) {
        fw_xml_cell *cell = &record->cell[k];
        const fw_xml_attribute_row *attribute = &record->attribute[k];
        if (cell->given) {
            cell->missing = false;
            continue;
        }
        bool key = row->key && strcmp(row->key, attribute->name) == 0;
        if (attribute->required && !cell->missing)
            fw_diag_error(r->diags, fw_xml_numbers_of(r, row)->missing, record->element->place,
                          "<%s> needs %s=\"...\": %s", row->name, attribute->name,
                          attribute->sentence);
        cell->missing = cell->missing || attribute->required;
        if (cell->missing && key) r->broken[row->space] = true;
    }
}

typedef struct walk {
    fw_xml_reader *r;
    int met[FW_ELEMENTS_MOST]; /* per row of the table */
    /* the last one of a row that may stand once in its parent */
    const fw_xml_element *once[FW_ELEMENTS_MOST];
    const fw_xml_element_row *needed[FW_ELEMENTS_MOST]; /* (nneeded) that must be there */
    int nneeded;
} walk;

/* how often an element may stand: once in its parent, or `most` in the file */
static bool too_often(walk *w, const fw_xml_element *e, const fw_xml_element_row *row, size_t k) {
    fw_xml_reader *r = w->r;
    if (row->once) {
        const fw_xml_element *first = w->once[k];
        if (first && first->parent == e->parent) {
            fw_diag_error(r->diags, fw_xml_numbers_of(r, row)->once, e->place,
                          "<%s> is given twice (first at line %d); one is allowed, so remove one",
                          e->name, first->place.line);
            return true;
        }
        w->once[k] = e;
    }
    if (row->most == 0 || ++w->met[k] <= row->most) return false;
    if (w->met[k] == row->most + 1)
        fw_diag_error(r->diags, fw_xml_numbers_of(r, row)->most, e->place,
                      "more than %d <%s> elements; that is the limit", row->most, row->name);
    return true;
}

static fw_status read_element(walk *w, fw_xml_element *e, int parent);

/* what must stand in an element at least once */
static void check_needed(const walk *w, const fw_xml_element *e, const fw_xml_element_row *row) {
    fw_xml_reader *r = w->r;
    for (int i = 0; i < w->nneeded; i++) {
        const fw_xml_element_row *child = w->needed[i];
        if (!fw_xml_row_inside(child, row->name)) continue;
        const fw_xml_element *c = e->first_child;
        while (c && strcmp(c->name, child->name) != 0)
            c = c->next;
        if (!c)
            fw_diag_error(r->diags, fw_xml_numbers_of(r, row)->needed, e->place,
                          "<%s> needs a <%s> inside: %s", row->name, child->name, child->sentence);
    }
}

static fw_status read_children(walk *w, fw_xml_element *e, const fw_xml_element_row *row,
                               int self) {
    for (fw_xml_element *child = e->first_child; child; child = child->next)
        FW_TRY(read_element(w, child, self));
    check_needed(w, e, row);
    return FW_OK;
}

static fw_status add_record(fw_xml_reader *r, fw_xml_element *e, const fw_xml_element_row *row,
                            int parent) {
    if (r->nrecord == r->capacity) {
        int more = r->capacity ? 2 * r->capacity : 64;
        FW_NEED(r->record = fw_arena_grow(r->arena, r->record, (size_t)r->nrecord, (size_t)more,
                                          sizeof *r->record));
        r->capacity = more;
    }
    fw_xml_attributes all = {row->attribute, row->nattribute};
    if (row->timed) { /* found once for every row of the table */
        fw_xml_attributes *kept = &r->timed[fw_xml_row_index(r->table, row->name)];
        if (!kept->item) FW_TRY(fw_xml_attributes_of(r->arena, row, kept));
        all = *kept;
    }
    fw_xml_record record = {
        .element = e, .row = row, .attribute = all.item, .nattribute = all.count, .parent = parent};
    FW_NEED(record.cell = fw_arena_array(r->arena, fw_xml_cell, (size_t)record.nattribute));
    read_attributes(r, &record);
    r->record[r->nrecord++] = record;
    return FW_OK;
}

/* the row of an element in its parent; NULL: it does not belong there, which is reported */
static const fw_xml_element_row *row_of(walk *w, const fw_xml_element *e,
                                        const fw_xml_element_row *inside) {
    fw_xml_reader *r = w->r;
    const char *parent = inside ? inside->name : "";
    int index = fw_xml_row_index_in(r->table, e->name, parent);
    const fw_xml_element_row *row = fw_xml_row_at(r->table, index);
    if (!row) {
        unknown_element(r, e, inside);
        return NULL;
    }
    if (!fw_xml_row_inside(row, parent)) {
        char where[256] = "";
        size_t used = 0;
        const fw_xml_element_row *other;
        for (int i = 0; (other = fw_xml_row_at(r->table, i)) != NULL; i++)
            if (strcmp(other->name, e->name) == 0 && used < sizeof where - 1)
                used += (size_t)snprintf(where + used, sizeof where - used, "%s<%s>",
                                         used ? " or " : "",
                                         other->parent[0] ? other->parent : "nothing");
        fw_diag_error(r->diags, fw_xml_numbers_of(r, inside)->misplaced, e->place,
                      "<%s> may not stand inside <%s>; move it into %s", e->name, parent, where);
        r->unknown_element = true;
        r->broken[row->space] = true;
        return NULL;
    }
    return too_often(w, e, row, (size_t)index) ? NULL : row;
}

static fw_status read_element(walk *w, fw_xml_element *e, int parent) {
    fw_xml_reader *r = w->r;
    const fw_xml_element_row *row = row_of(w, e, parent < 0 ? NULL : r->record[parent].row);
    if (!row) return FW_OK;
    if (e->text[0] && !row->text)
        fw_diag_error(r->diags, fw_xml_numbers_of(r, row)->text, e->text_place,
                      "text is not expected inside <%s>; values stand in attributes, remarks in "
                      "<!-- -->",
                      e->name);
    const fw_xml_element_row *own = row;
    if (row->specialise) FW_TRY(row->specialise(r, e, &own));
    if (!own) return FW_OK;
    int self = r->nrecord;
    FW_TRY(add_record(r, e, own, parent));
    return read_children(w, e, row, self);
}

static fw_status check_root(fw_xml_reader *r) {
    const fw_xml_table *t = r->table;
    const fw_xml_element *root = r->root;
    if (strcmp(root->name, t->root) != 0)
        return fw_diag_error(r->diags, t->numbers.root, root->place,
                             "the file's first element is <%.64s>, a %s begins with <%s "
                             "xmlns=\"%s\" %s>",
                             root->name, t->file, t->root, t->urn, t->head);
    if (strcmp(root->space, t->urn) != 0)
        fw_diag_error(r->diags, t->numbers.root, root->place,
                      "xmlns is \"%.100s\" and must be \"%s\"; write <%s xmlns=\"%s\" %s>",
                      root->space, t->urn, t->root, t->urn, t->head);
    return FW_OK;
}

fw_status fw_xml_records_read(fw_xml_reader *r) {
    walk w = {.r = r};
    const fw_xml_element_row *row;
    for (int i = 0; (row = fw_xml_row_at(r->table, i)) != NULL; i++)
        if (row->needed) w.needed[w.nneeded++] = row;
    FW_TRY(check_root(r));
    FW_TRY(read_element(&w, r->root, -1));
    for (int i = r->nrecord - 1; i > 0; i--) { /* backwards, so that the first comes first */
        fw_xml_record *parent = &r->record[r->record[i].parent];
        r->record[i].next = parent->first_child;
        parent->first_child = &r->record[i];
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- ids that are given twice ---- */

typedef struct entry {
    int space;
    int within; /* record whose own ids these are, -1: of the whole file */
    const fw_xml_attribute *id;
    int order;
} entry;

static int compare(const void *left, const void *right) {
    const entry *a = left, *b = right;
    int c = fw_order_wholes(a->space, b->space);
    if (!c) c = fw_order_wholes(a->within, b->within);
    if (!c) c = strcmp(a->id->value, b->id->value);
    return c ? c : fw_order_wholes(a->order, b->order);
}

fw_status fw_xml_ids_check(fw_xml_reader *r) {
    entry *entries = fw_arena_array(r->arena, entry, (size_t)r->nrecord);
    FW_NEED(entries);
    size_t n = 0;
    for (int i = 0; i < r->nrecord; i++) {
        const fw_xml_record *record = &r->record[i];
        const char *key = record->row->key;
        if (record->row->space == 0 || !fw_xml_text_of(record, key)) continue;
        entries[n++] = (entry){record->row->space, record->row->within ? record->parent : -1,
                               fw_xml_cell_of(record, key)->given, i};
    }
    qsort(entries, n, sizeof *entries, compare);
    for (size_t i = 1, first = 0; i < n; i++) {
        const entry *a = &entries[first], *b = &entries[i];
        if (a->space != b->space || a->within != b->within ||
            strcmp(a->id->value, b->id->value) != 0) {
            first = i;
            continue;
        }
        fw_diag_error(r->diags, r->table->numbers.twice, b->id->place,
                      "%s '%s' is given twice (first at line %d, column %d); rename or remove one",
                      r->table->space[a->space], a->id->value, a->id->place.line,
                      a->id->place.column);
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_xml_table_read(fw_arena *arena, const fw_xml_table *table, const char *file,
                            const char *xml, size_t n, fw_diags *diags, fw_xml_reader *r) {
    *r = (fw_xml_reader){.arena = arena, .diags = diags, .table = table};
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &r->root));
    if (!r->root) return FW_INPUT;
    FW_TRY(fw_xml_records_read(r));
    FW_TRY(fw_xml_words_read(r));
    FW_TRY(fw_xml_ids_check(r));
    return fw_xml_numbers_read(r);
}
