/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a mask says about itself, for the documentation layer and the heads of files. */
#include "mask/mask_writers.h"
#include <stdio.h>
#include <string.h>

int fw_mask_notes_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].documentation) return k;
    return -1;
}

typedef struct lines {
    fw_arena *arena;
    const char **line;
    int count;
} lines;

fw_status fw_mask_note(fw_arena *arena, const char *key, const char *value, const char **line) {
    FW_NEED(value);
    fw_text text = fw_text_new(arena);
    const char *at = fw_arena_printf(arena, "%s%s%s", key, *key ? "=" : "", value);
    FW_NEED(at);
    while (*at) { /* readers take ASCII only; a whole character is one <U+00B5> */
        const char *letter = at;
        unsigned code = fw_text_character(&at);
        bool plain = code >= 0x20 && code <= 0x7e;
        if (text.length + (plain ? 1 : 10) > FW_MASK_NOTE_MOST) break;
        if (plain)
            fw_text_bytes(&text, letter, 1);
        else
            fw_text_printf(&text, "<U+%04X>", code);
    }
    *line = text.data ? text.data : "";
    return fw_text_end(&text);
}

static fw_status add(lines *l, const char *key, const char *value) {
    return fw_mask_note(l->arena, key, value, &l->line[l->count++]);
}

static fw_status add_layers(lines *l, const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++) {
        const fw_mask_layer *y = &table->layer[k];
        char key[32];
        snprintf(key, sizeof key, "layer %d/%d", y->layer, y->datatype);
        const char *value = fw_arena_printf(l->arena, "%s; %s; %s", y->name, y->tone, y->purpose);
        FW_NEED(value);
        FW_TRY(add(l, key, value));
    }
    return FW_OK;
}

fw_status fw_mask_notes(fw_arena *arena, const fw_mask *mask, const char ***line, int *count) {
    enum { OWN = 10 };
    lines l = {arena, NULL, 0};
    size_t most = OWN + (size_t)mask->table->nlayer + (size_t)mask->nnote;
    FW_NEED(l.line = fw_arena_array(arena, const char *, most));
    char number[32];
    if (mask->rejected) FW_TRY(add(&l, "status", "REJECTED"));
    FW_TRY(add(&l, "device", mask->device));
    FW_TRY(add(&l, "title", mask->title));
    FW_TRY(add(&l, "program", "flexwright " FW_VERSION));
    FW_TRY(add(&l, "flow", mask->flow));
    FW_TRY(add(&l, "reading", mask->table->reading));
    if (mask->table->order) FW_TRY(add(&l, "order", mask->table->order));
    FW_TRY(
        add(&l, "bias_um_per_edge", fw_number_text(number, sizeof number, mask->bias_m * 1e6, 6)));
    FW_TRY(add(&l, "bias", "process bias included, mask CD bias 0"));
    FW_TRY(
        add(&l, "tolerance_nm", fw_number_text(number, sizeof number, mask->tolerance_m * 1e9, 6)));
    FW_TRY(add_layers(&l, mask->table));
    for (int i = 0; i < mask->nnote; i++)
        FW_TRY(add(&l, "", mask->note[i]));
    *line = l.line;
    *count = l.count;
    return FW_OK;
}
