/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which elements and attributes there are, and which are missing. */
#include "base/text.h"
#include "device/reader.h"
#include "device/table.h"
#include <stdio.h>
#include <string.h>

static void unknown_element(fw_reader *r, const fw_element *e, const char *parent) {
    const char *names[FW_ELEMENTS_MOST];
    size_t n = 0;
    const fw_element_row *row;
    for (int i = 0; (row = fw_element_row_at(i)) != NULL && n < FW_ELEMENTS_MOST; i++)
        if (strcmp(row->parent, parent) == 0) names[n++] = row->name;
    const char *better = fw_full(r) ? NULL : fw_did_you_mean(e->name, names, n);
    r->unknown_element = true;
    if (better) { /* what it would have declared is not missed again */
        r->broken[fw_element_row_find(better)->space] = true;
        fw_diag_error(r->diags, 40, e->place, "<%s> is not known; did you mean <%s>?", e->name,
                      better);
        return;
    }
    char list[512] = "nothing";
    size_t used = 0;
    for (size_t i = 0; i < n && used + strlen(names[i]) + 4 < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s<%s>", i ? " " : "", names[i]);
    fw_diag_error(r->diags, 40, e->place, "<%.64s> is not known inside <%s>; allowed are: %s",
                  e->name, parent, list);
}

/* an attribute that was probably meant counts as there and failed, so that it is not missed again
 */
static void unknown_attribute(fw_reader *r, fw_record *record, const fw_attribute *a) {
    const fw_element_row *row = record->row;
    char list[512] = "it has none";
    size_t used = 0;
    int best = -1, least = 3;
    for (int i = 0; i < record->nattribute; i++) {
        const char *name = record->attribute[i].name;
        int distance = fw_full(r) ? 3 : fw_edit_distance(a->name, name, 2);
        if (distance < least && (size_t)distance < strlen(name)) {
            least = distance;
            best = i;
        }
        if (used + strlen(name) + 2 < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? " " : "", name);
    }
    if (best >= 0) {
        record->cell[best].missing = true;
        fw_diag_error(r->diags, 42, a->name_place, "<%s> has no attribute '%s'; did you mean '%s'?",
                      row->name, a->name, record->attribute[best].name);
    } else
        fw_diag_error(r->diags, 42, a->name_place, "<%s> has no attribute '%.64s'; known are: %s",
                      row->name, a->name, list);
}

static void read_attributes(fw_reader *r, fw_record *record) {
    const fw_element_row *row = record->row;
    for (int i = 0; i < record->element->nattribute; i++) {
        const fw_attribute *a = &record->element->attribute[i];
        int k = 0;
        while (k < record->nattribute && strcmp(record->attribute[k].name, a->name) != 0)
            k++;
        if (k < record->nattribute)
            record->cell[k].given = a;
        else
            unknown_attribute(r, record, a);
    }
    for (int k = 0; k < record->nattribute; k++) {
        fw_cell *cell = &record->cell[k];
        const fw_attribute_row *attribute = &record->attribute[k];
        if (cell->given) {
            cell->missing = false;
            continue;
        }
        bool key = row->key && strcmp(row->key, attribute->name) == 0;
        if (attribute->required && !cell->missing)
            fw_diag_error(r->diags, 43, record->element->place, "<%s> needs %s=\"...\": %s",
                          row->name, attribute->name, attribute->sentence);
        cell->missing = cell->missing || attribute->required;
        if (cell->missing && key) r->broken[row->space] = true;
    }
}

typedef struct walk {
    fw_reader *r;
    int seen[FW_ELEMENTS_MOST]; /* per row of the table */
    const fw_element
        *once[FW_ELEMENTS_MOST]; /* the last one of a row that may stand once in its parent */
    int capacity;
} walk;

/* how often an element may stand: once in its parent, or `most` in the file */
static bool too_often(walk *w, const fw_element *e, const fw_element_row *row, size_t k) {
    fw_reader *r = w->r;
    if (row->once) {
        const fw_element *first = w->once[k];
        if (first && first->parent == e->parent) {
            fw_diag_error(r->diags, 51, e->place,
                          "<%s> is given twice (first at line %d); one is allowed, so remove one",
                          e->name, first->place.line);
            return true;
        }
        w->once[k] = e;
    }
    if (row->most == 0 || ++w->seen[k] <= row->most) return false;
    if (w->seen[k] == row->most + 1)
        fw_diag_error(r->diags, 66, e->place, "more than %d <%s> elements; that is the limit",
                      row->most, row->name);
    return true;
}

static fw_status read_element(walk *w, fw_element *e, int parent);

static fw_status read_children(walk *w, fw_element *e, int self) {
    for (fw_element *child = e->first_child; child; child = child->next)
        FW_TRY(read_element(w, child, self));
    return FW_OK;
}

static fw_status add_record(walk *w, fw_element *e, const fw_element_row *row, int parent) {
    fw_reader *r = w->r;
    if (r->nrecord == w->capacity) {
        int more = w->capacity ? 2 * w->capacity : 64;
        FW_NEED(r->record = fw_arena_grow(r->arena, r->record, (size_t)r->nrecord, (size_t)more,
                                          sizeof *r->record));
        w->capacity = more;
    }
    fw_device_attributes *all = &r->attributes[fw_element_index(row->name)];
    if (!all->item) FW_TRY(fw_device_attributes_of(r->arena, row, all));
    fw_record record = {.element = e,
                        .row = row,
                        .attribute = all->item,
                        .nattribute = all->count,
                        .parent = parent};
    FW_NEED(record.cell = fw_arena_array(r->arena, fw_cell, (size_t)record.nattribute));
    read_attributes(r, &record);
    r->record[r->nrecord++] = record;
    return FW_OK;
}

static fw_status read_element(walk *w, fw_element *e, int parent) {
    fw_reader *r = w->r;
    const char *inside = parent < 0 ? "" : r->record[parent].row->name;
    int index = fw_element_index(e->name);
    const fw_element_row *row = fw_element_row_at(index);
    if (!row) {
        unknown_element(r, e, inside);
        return FW_OK;
    }
    if (strcmp(row->parent, inside) != 0) {
        fw_diag_error(r->diags, 41, e->place, "<%s> may not stand inside <%s>; move it into <%s>",
                      e->name, inside, row->parent[0] ? row->parent : "nothing");
        r->unknown_element = true;
        r->broken[row->space] = true;
        return FW_OK;
    }
    if (too_often(w, e, row, (size_t)index)) return FW_OK;
    if (e->text[0])
        fw_diag_error(r->diags, 49, e->text_place,
                      "text is not expected inside <%s>; values stand in attributes, remarks in "
                      "<!-- -->",
                      e->name);
    int self = r->nrecord;
    FW_TRY(add_record(w, e, row, parent));
    return read_children(w, e, self);
}

static fw_status check_root(fw_reader *r) {
    static const char urn[] = "urn:flexwright:device:1";
    const fw_element *root = r->root;
    if (strcmp(root->name, "device") != 0)
        return fw_diag_error(
            r->diags, 15, root->place,
            "the file's first element is <%.64s>, a device file begins with <device "
            "xmlns=\"%s\" name=\"...\">",
            root->name, urn);
    if (strcmp(root->space, urn) != 0)
        fw_diag_error(r->diags, 15, root->place,
                      "xmlns is \"%.100s\" and must be \"%s\"; write <device xmlns=\"%s\" "
                      "name=\"...\">",
                      root->space, urn, urn);
    return FW_OK;
}

fw_status fw_records_read(fw_reader *r) {
    walk w = {.r = r};
    FW_TRY(check_root(r));
    FW_TRY(read_element(&w, r->root, -1));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
