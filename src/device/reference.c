/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What elements refer to, which attributes they need and which they refuse.
   Ids are unique within their kind, and references lead somewhere. */
#include "base/text.h"
#include "device/device_reader.h"
#include <stdio.h>
#include <string.h>

static size_t count_of(const fw_device *d, fw_device_space space) {
    switch (space) {
    case FW_SPACE_PARAMETER:
        return (size_t)d->nparameter;
    case FW_SPACE_FLOW:
        return (size_t)d->nflow;
    case FW_SPACE_FLEXURE:
        return (size_t)d->nflexure;
    case FW_SPACE_BODY:
        return (size_t)d->nbody;
    case FW_SPACE_JOINT:
        return (size_t)d->nrevolute + (size_t)d->njoint;
    case FW_SPACE_SCENE:
        return (size_t)d->nscene;
    case FW_SPACE_PROBE:
        return (size_t)d->nprobe;
    case FW_SPACE_NONE:
    case FW_SPACE_SPRING: /* nothing refers to these */
    case FW_SPACE_DRIVER:
    case FW_SPACE_TENDON:
    case FW_SPACE_COMB:
    case FW_SPACE_CONTACT:
    case FW_SPACE_STUDY:
    case FW_SPACE_COUNT:
        break;
    }
    return 0;
}

typedef struct named {
    const char *id;
    fw_place place;
} named;

static named name_of(const fw_device *d, fw_device_space space, size_t i) {
    size_t joints = (size_t)d->nrevolute;
    named n = space == FW_SPACE_PARAMETER ? (named){d->parameter[i].name, d->parameter[i].place}
              : space == FW_SPACE_SCENE   ? (named){d->scene[i].name, d->scene[i].place}
              : space == FW_SPACE_PROBE   ? (named){d->probe[i].id, d->probe[i].place}
              : space == FW_SPACE_FLOW    ? (named){d->flow[i].ref, d->flow[i].place}
              : space == FW_SPACE_FLEXURE ? (named){d->flexure[i].id, d->flexure[i].place}
              : space == FW_SPACE_BODY    ? (named){d->body[i].id, d->body[i].place}
              : i < joints                ? (named){d->revolute[i].id, d->revolute[i].place}
                           : (named){d->joint[i - joints].id, d->joint[i - joints].place};
    if (!n.id) n.id = "";
    return n;
}

/* ---- the index: open addressing, at most half full; the first of equal ids stays ---- */

static uint64_t hash_of(const char *id) {
    uint64_t hash = FW_HASH_BEGIN;
    for (; *id; id++)
        hash = fw_hash_add(hash, (unsigned char)*id);
    return hash ^ (hash >> 32);
}

/* slot of the id, or the free one where it belongs */
static int *slot_of(const fw_device *d, fw_device_space space, const fw_device_id_index *x,
                    const char *id) {
    size_t mask = ((size_t)1 << x->bits) - 1, at = (size_t)hash_of(id) & mask;
    while (x->slot[at] && strcmp(name_of(d, space, (size_t)x->slot[at] - 1).id, id) != 0)
        at = (at + 1) & mask;
    return &x->slot[at];
}

/* what was built since the last look-up comes in; false when memory is short */
static bool enter(fw_device_reader *r, fw_device_space space) {
    const fw_device *d = r->device;
    fw_device_id_index *x = &r->index[space];
    size_t n = count_of(d, space);
    if (!x->slot || n > ((size_t)1 << x->bits) / 2) {
        for (x->bits = 5; n > ((size_t)1 << x->bits) / 2;)
            x->bits++;
        x->slot = fw_arena_array(r->arena, int, (size_t)1 << x->bits);
        x->entered = 0;
    }
    for (; x->slot && (size_t)x->entered < n; x->entered++) {
        int *slot = slot_of(d, space, x, name_of(d, space, (size_t)x->entered).id);
        if (*slot == 0) *slot = x->entered + 1;
    }
    return x->slot != NULL;
}

enum { SUGGESTIONS_MOST = 2000 }; /* ids that a misspelt one is compared with */

/* is it a word of the list? One that is declared twice, which is an error of its own, is named once */
static bool is_listed(const char *list, const char *id) {
    const size_t n = strlen(id);
    for (const char *at = strstr(list, id); at; at = strstr(at + 1, id))
        if ((at == list || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0')) return true;
    return false;
}

/* either end of the reference may be the misspelt one, so the message names both places */
static void report_dangling(fw_device_reader *r, const fw_xml_record *record,
                            const fw_xml_attribute_row *row, const fw_xml_attribute *a) {
    const fw_device *d = r->device;
    size_t n = count_of(d, (fw_device_space)row->space);
    const char *kind = fw_device_table.space[row->space], *better = NULL;
    char label[FW_LABEL], list[200] = "";
    size_t used = 0;
    int least = 3, listed = 0;
    fw_place there = {0};
    for (size_t i = 0; i < n && i < SUGGESTIONS_MOST && !fw_xml_full(r->diags); i++) {
        const named other = name_of(d, (fw_device_space)row->space, i);
        const char *id = other.id;
        int distance = fw_edit_distance(a->value, id, 2);
        if (distance < least && (size_t)distance < strlen(id)) {
            least = distance;
            better = id;
            there = other.place;
        }
        if (used + strlen(id) + 3 < sizeof list && !is_listed(list, id))
            used +=
                (size_t)snprintf(list + used, sizeof list - used, "%s%s", listed++ ? " " : "", id);
    }
    fw_xml_label(record, label);
    if (row->ground && fw_edit_distance(a->value, "ground", 2) < least) {
        fw_diag_error(r->diags, 46, a->place, "%s: there is no %s '%.64s'; did you mean 'ground'?",
                      label, kind, a->value);
        return;
    }
    if (better && strlen(a->value) > 2)
        fw_diag_error(r->diags, 46, a->place,
                      "%s: there is no %s '%.64s'; did you mean '%s', declared at %d:%d? Make the "
                      "two alike",
                      label, kind, a->value, better, there.line, there.column);
    else
        fw_diag_error(r->diags, 46, a->place, "%s: there is no %s '%.64s'; declared %s: %s", label,
                      kind, a->value, listed == 1 ? "is" : "are", listed ? list : "none");
}

int fw_device_reference(fw_device_reader *r, const fw_xml_record *record, const char *name) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    if (cell->missing || (cell->given && !cell->ok)) return FW_NOWHERE;
    if (!cell->given) return FW_NONE;
    const fw_xml_attribute_row *row = record->attribute;
    while (strcmp(row->name, name) != 0)
        row++;
    const char *id = cell->given->value;
    if (strcmp(id, "ground") == 0 && row->space == FW_SPACE_BODY) {
        if (row->ground) return FW_GROUND;
        char label[FW_LABEL];
        fw_diag_error(r->diags, 46, cell->given->place,
                      "%s: the ground is fixed and cannot be "
                      "used here; name a body",
                      fw_xml_label(record, label));
        return FW_NOWHERE;
    }
    if (!enter(r, (fw_device_space)row->space)) {
        r->diags->failed = 1; /* memory is short: every step ends with asking for this */
        return FW_NOWHERE;
    }
    int found = *slot_of(r->device, (fw_device_space)row->space, &r->index[row->space], id);
    if (found) return found - 1;
    if (!r->xml.broken[row->space]) report_dangling(r, record, row, cell->given);
    return FW_NOWHERE;
}

/* ---- attributes ---- */

bool fw_device_refused(fw_device_reader *r, const fw_xml_record *record, int number,
                       const char *const *names, int n, const char *why) {
    char label[FW_LABEL];
    for (int i = 0; i < n; i++)
        if (fw_xml_given(record, names[i])) {
            fw_diag_error(r->diags, number, fw_xml_place_of(record, names[i]), "%s: %s %s",
                          fw_xml_label(record, label), names[i], why);
            return true;
        }
    return false;
}

bool fw_device_needed(fw_device_reader *r, const fw_xml_record *record, int number,
                      const char *const *names, int n, const char *why) {
    char label[FW_LABEL];
    for (int i = 0; i < n; i++)
        if (!fw_xml_given(record, names[i])) {
            fw_diag_error(r->diags, number, record->element->place, "%s needs %s=\"...\": %s",
                          fw_xml_label(record, label), names[i], why);
            return true;
        }
    return false;
}
