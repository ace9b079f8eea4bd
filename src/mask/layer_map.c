/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask_parts.h"
#include "mask/rule.h"
#include <string.h>

/* ---- reading ---- */

typedef struct reader {
    fw_arena *arena;
    fw_diags *diags;
    fw_mask_layer_map *map;
    const char *flow;
    int capacity;
} reader;

enum { MOST_WORDS = 5 };

typedef struct word {
    const char *text;
    fw_place place;
} word;

/* words of one line, up to a '#'; one more than MOST_WORDS says that there are too many */
static fw_status split(reader *r, const char *line, size_t n, fw_place start, word *to,
                       int *count) {
    *count = 0;
    for (size_t i = 0; i < n && line[i] != '#' && *count <= MOST_WORDS;) {
        if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
            i++;
            continue;
        }
        size_t from = i;
        while (i < n && line[i] != ' ' && line[i] != '\t' && line[i] != '\r' && line[i] != '#')
            i++;
        word *w = &to[(*count)++];
        w->place = start;
        w->place.column = (int)from + 1;
        FW_NEED(w->text = fw_arena_strndup(r->arena, line + from, i - from));
    }
    return FW_OK;
}

static fw_status add(reader *r, fw_mask_layer_entry entry) {
    fw_mask_layer_map *m = r->map;
    for (int i = 0; i < m->n; i++) {
        const fw_mask_layer_entry *e = &m->entry[i];
        bool same =
            e->flow == entry.flow || (e->flow && entry.flow && !strcmp(e->flow, entry.flow));
        if (same && strcmp(e->layer, entry.layer) == 0)
            fw_diag_error(r->diags, 380, entry.place,
                          "layer \"%s\" has a line already, line %d; keep one of them", entry.layer,
                          e->place.line);
    }
    if (m->n == r->capacity) {
        int more = r->capacity ? 2 * r->capacity : 16;
        FW_NEED(m->entry = fw_arena_grow(r->arena, m->entry, (size_t)m->n, (size_t)more,
                                         sizeof *m->entry));
        r->capacity = more;
    }
    m->entry[m->n++] = entry;
    return FW_OK;
}

static void refuse(reader *r, fw_place place, const char *what, const char *text) {
    const char *shown = fw_text_shown(r->arena, text, strlen(text));
    fw_diag_error(r->diags, 380, place,
                  "%s \"%s\"; a line is LAYER NUMBER/DATATYPE name NAME, for example "
                  "\"structure 7/0 name POLY2\", with numbers 0 to 65535 and a name of 1 to 32 of "
                  "A-Z a-z 0-9 _ -; or \"flow NAME\"",
                  what, shown ? shown : "");
}

/* LAYER [NUMBER/DATATYPE] [name NAME] */
static fw_status layer_line(reader *r, const word *w, int n) {
    fw_mask_layer_entry e = {
        .layer = w[0].text, .flow = r->flow, .number = -1, .datatype = -1, .place = w[0].place};
    e.number_place = e.name_place = e.place;
    int at = 1;
    if (!fw_mask_is_name(e.layer)) {
        refuse(r, e.place, "no layer is called", e.layer);
        return FW_OK;
    }
    if (at < n && fw_mask_gds_pair(w[at].text, &e.number, &e.datatype))
        e.number_place = w[at++].place;
    if (at + 1 < n && strcmp(w[at].text, "name") == 0) {
        if (!fw_mask_is_name(w[at + 1].text)) {
            refuse(r, w[at + 1].place, "not a name:", w[at + 1].text);
            return FW_OK;
        }
        e.name = w[at + 1].text;
        e.name_place = w[at + 1].place;
        at += 2;
    }
    if (at < n) {
        refuse(r, w[at].place, "not understood:", w[at].text);
        return FW_OK;
    }
    if (e.number < 0 && !e.name) {
        refuse(r, e.place, "neither number nor name for", e.layer);
        return FW_OK;
    }
    return add(r, e);
}

static fw_status take_line(reader *r, const char *line, size_t n, fw_place place) {
    word w[MOST_WORDS + 1];
    int count;
    FW_TRY(split(r, line, n, place, w, &count));
    if (count == 0) return FW_OK;
    if (strcmp(w[0].text, "flow") != 0) return layer_line(r, w, count);
    if (count == 2 && fw_mask_is_name(w[1].text))
        r->flow = w[1].text;
    else
        refuse(r, w[count > 1].place, count > 1 ? "no flow is called" : "which flow?",
               w[count > 1].text);
    return FW_OK;
}

fw_status fw_mask_layer_map_read(fw_arena *arena, const char *file, const char *text, size_t n,
                                 fw_diags *diags, fw_mask_layer_map *map) {
    reader r = {.arena = arena, .diags = diags, .map = map};
    size_t errors = diags->errors;
    fw_place place = {file, 1, 1};
    *map = (fw_mask_layer_map){0};
    if (memchr(text, '\0', n))
        return fw_diag_error(diags, 380, place,
                             "the file holds a NUL byte, so that it is no text; save it as UTF-8");
    for (size_t i = 0; i < n; place.line++) {
        const char *end = memchr(text + i, '\n', n - i);
        size_t length = end ? (size_t)(end - (text + i)) : n - i;
        FW_TRY(take_line(&r, text + i, length, place));
        i += length + 1;
    }
    if (diags->failed) return FW_NOMEM;
    if (diags->errors > errors) return FW_INPUT;
    if (map->n == 0)
        return fw_diag_error(diags, 380, (fw_place){file, 1, 1},
                             "the file says nothing of any layer; a line is, for example, "
                             "\"structure 7/0 name POLY2\"");
    return FW_OK;
}

/* ---- into a table ---- */

static int layer_named(const fw_mask_table *table, const char *name) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].id && strcmp(table->layer[k].id, name) == 0) return k;
    return fw_mask_layer_of_role(table, name);
}

/* DXF of release 12 knows 31 letters without case, of which "REJECTED_" takes nine */
static bool same_name(const char *a, const char *b) {
    enum { TOLD_APART = 22 };
    for (int i = 0; i < TOLD_APART; i++) {
        char p = a[i], q = b[i];
        if (p >= 'a' && p <= 'z') p = (char)(p - 'a' + 'A');
        if (q >= 'a' && q <= 'z') q = (char)(q - 'a' + 'A');
        if (p != q) return false;
        if (p == '\0') return true;
    }
    return true;
}

/* entries of either layer, of which at least one is there */
static void check_pair(const fw_mask_table *table, const fw_mask_layer_entry *const *by, int i,
                       int j, fw_diags *diags) {
    const fw_mask_layer *a = &table->layer[i], *b = &table->layer[j];
    if (!by[i] && !by[j]) return;
    const fw_mask_layer_entry *e = by[j] ? by[j] : by[i];
    if (a->layer == b->layer && a->datatype == b->datatype)
        fw_diag_error(diags, 382, e->number_place,
                      "layers %s and %s of flow %s would both be %d/%d; give one of them another "
                      "number",
                      a->id, b->id, table->flow, a->layer, a->datatype);
    if (same_name(a->name, b->name))
        fw_diag_error(diags, 382, e->name_place,
                      "layers %s and %s of flow %s would be called %s and %s, which DXF does not "
                      "tell apart: its first 22 letters count, without case",
                      a->id, b->id, table->flow, a->name, b->name);
}

/* every "N/M" of a text that is the number of a layer becomes its new one */
static fw_status renumber(fw_arena *arena, const fw_mask_layer *old, const fw_mask_layer *layer,
                          int n, const char **text) {
    if (!*text) return FW_OK;
    fw_text out = fw_text_new(arena);
    bool inside = false; /* of a longer number or word */
    for (const char *s = *text; *s;) {
        char pair[16];
        size_t length = strspn(s, "0123456789/");
        int number, datatype, k = n;
        if (!inside && length > 0 && length < sizeof pair) {
            memcpy(pair, s, length);
            pair[length] = '\0';
            if (fw_mask_gds_pair(pair, &number, &datatype))
                for (k = 0; k < n && (old[k].layer != number || old[k].datatype != datatype);)
                    k++;
        }
        if (k < n) {
            fw_text_printf(&out, "%d/%d", layer[k].layer, layer[k].datatype);
            s += length;
            continue;
        }
        inside = strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789/.", *s);
        fw_text_bytes(&out, s++, 1);
    }
    FW_TRY(fw_text_end(&out));
    *text = out.length ? out.data : *text;
    return FW_OK;
}

/* lines for one flow count before those for all */
static const fw_mask_layer_entry *entry_for(fw_mask_layer_map *map, const fw_mask_table *table,
                                            int k, fw_diags *diags) {
    fw_mask_layer_entry *found = NULL;
    for (int i = 0; i < map->n; i++) {
        fw_mask_layer_entry *e = &map->entry[i];
        if (e->flow && (!table->flow || strcmp(e->flow, table->flow) != 0)) continue;
        if (layer_named(table, e->layer) != k) continue;
        e->used = true;
        if (found && !found->flow == !e->flow)
            fw_diag_error(diags, 382, e->place,
                          "\"%s\" and \"%s\" (line %d) are the same layer of flow %s; keep one of "
                          "the lines",
                          e->layer, found->layer, found->place.line, table->flow);
        if (!found || e->flow) found = e;
    }
    return found;
}

/* "plate" is the one layer of the plate as it is written */
static void name_plate(fw_mask_layer_map *map, fw_mask_table *table) {
    const fw_mask_layer_entry *found = NULL;
    for (int i = 0; i < map->n; i++) {
        fw_mask_layer_entry *e = &map->entry[i];
        if (strcmp(e->layer, "plate") != 0 || layer_named(table, e->layer) >= 0) continue;
        if (e->flow && (!table->flow || strcmp(e->flow, table->flow) != 0)) continue;
        e->used = true;
        if (!found || e->flow) found = e;
    }
    if (!found) return;
    table->written_numbered = found->number >= 0;
    table->written_layer = found->number;
    table->written_datatype = found->datatype;
    table->written_name = found->name;
}

static void warn_of_large(const fw_mask_layer_entry *e, fw_diags *diags) {
    if (e->number <= 32767 && e->datatype <= 32767) return;
    fw_diag_warning(diags, 383, e->number_place,
                    "GDSII readers that take its numbers as signed see layer %d/%d as %d/%d; up to "
                    "32767 all read the same, up to 255 the oldest ones too",
                    e->number, e->datatype, e->number > 32767 ? e->number - 65536 : e->number,
                    e->datatype > 32767 ? e->datatype - 65536 : e->datatype);
}

fw_status fw_mask_layer_map_apply(fw_arena *arena, fw_mask_layer_map *map, fw_mask_table *table,
                                  fw_diags *diags) {
    size_t errors = diags->errors, n = (size_t)table->nlayer;
    fw_mask_layer *old = fw_arena_array(arena, fw_mask_layer, n);
    const fw_mask_layer_entry **by = fw_arena_array(arena, const fw_mask_layer_entry *, n);
    FW_NEED(old && by ? old : NULL);
    for (int k = 0; k < table->nlayer; k++) {
        fw_mask_layer *y = &table->layer[k];
        old[k] = *y;
        const fw_mask_layer_entry *e = by[k] = entry_for(map, table, k, diags);
        if (!e) continue;
        if (e->number >= 0) y->layer = e->number, y->datatype = e->datatype;
        if (e->name) y->name = e->name;
        if (e->number >= 0) warn_of_large(e, diags);
    }
    name_plate(map, table);
    for (int j = 1; j < table->nlayer; j++)
        for (int i = 0; i < j; i++)
            check_pair(table, by, i, j, diags);
    FW_TRY(renumber(arena, old, table->layer, table->nlayer, &table->plate));
    for (int i = 0; i < table->nplate; i++) {
        FW_TRY(renumber(arena, old, table->layer, table->nlayer, &table->plates[i].layers));
        FW_TRY(renumber(arena, old, table->layer, table->nlayer, &table->plates[i].order));
    }
    FW_TRY(renumber(arena, old, table->layer, table->nlayer, &table->order));
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}

/* ---- what nothing answers to ---- */

static const char *names_of(fw_arena *arena, const fw_mask_table *const *table, int n,
                            const char *flow) {
    fw_text names = fw_text_new(arena);
    for (int i = 0; i < n; i++) {
        if (flow && strcmp(table[i]->flow, flow) != 0) continue;
        fw_text_printf(&names, "%sflow %s has", names.length ? "; " : "", table[i]->flow);
        for (int k = 0; k < table[i]->nlayer; k++)
            fw_text_printf(&names, "%s %s", k ? "," : "", table[i]->layer[k].id);
    }
    return fw_text_end(&names) == FW_OK && names.length ? names.data : "";
}

/* of a line for `flow`, or for all: what it was probably meant for, "; did you mean 'text'?"; ":" */
static const char *layer_meant(fw_arena *arena, const fw_mask_layer_entry *e,
                               const fw_mask_table *const *table, int ntable) {
    size_t n = 1 + FW_ROLE_COUNT, of = 0;
    for (int i = 0; i < ntable; i++)
        n += (size_t)table[i]->nlayer;
    const char **name = fw_arena_array(arena, const char *, n);
    if (!name) return NULL;
    for (const char *const *role = fw_mask_role_names(); *role; role++)
        name[of++] = *role;
    name[of++] = "plate";
    for (int i = 0; i < ntable; i++)
        for (int k = 0; (!e->flow || strcmp(table[i]->flow, e->flow) == 0) && k < table[i]->nlayer;
             k++)
            name[of++] = table[i]->layer[k].id;
    const char *near = fw_did_you_mean(e->layer, name, of);
    return near ? fw_arena_printf(arena, "; did you mean '%s'?", near) : ":";
}

static const char *flow_meant(fw_arena *arena, const char *flow, const fw_mask_table *const *table,
                              int ntable) {
    const char **name = fw_arena_array(arena, const char *, (size_t)ntable);
    if (!name) return NULL;
    for (int i = 0; i < ntable; i++)
        name[i] = table[i]->flow;
    const char *near = fw_did_you_mean(flow, name, (size_t)ntable);
    return near ? fw_arena_printf(arena, "; did you mean '%s'?", near) : "";
}

fw_status fw_mask_layer_map_finish(fw_arena *arena, const fw_mask_layer_map *map,
                                   const fw_mask_table *const *table, int ntable, fw_diags *diags) {
    size_t errors = diags->errors;
    const char *told = NULL; /* of a flow that is not here: once */
    for (int i = 0; i < map->n; i++) {
        const fw_mask_layer_entry *e = &map->entry[i];
        bool planned = !e->flow;
        for (int k = 0; k < ntable; k++)
            planned = planned || strcmp(table[k]->flow, e->flow) == 0;
        if (e->used) continue;
        const char *meant = planned ? layer_meant(arena, e, table, ntable)
                                    : flow_meant(arena, e->flow, table, ntable);
        FW_NEED(meant);
        if (planned)
            fw_diag_error(diags, 381, e->place,
                          "no layer has the id or the role \"%s\"%s %s; roles are structure, "
                          "flexure, frame, tether, text, mark, dicing, back, cavity, land, metal; "
                          "\"plate\" is the layer of the plate as it is written",
                          e->layer, meant, names_of(arena, table, ntable, e->flow));
        else if (!told || strcmp(told, e->flow) != 0)
            fw_diag_warning(diags, 383, e->place,
                            "flow %s is not planned here, so that its lines do nothing%s (the name "
                            "is that of its process pack)",
                            told = e->flow, meant);
    }
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}
