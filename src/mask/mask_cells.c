/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layers that the cells of a description go to, in the layer tables of the flows. */
#include "base/text.h"
#include "mask/mask.h"
#include "mask/mask_table.h"
#include "mask/mask_writers.h"
#include <stdio.h>
#include <string.h>

int fw_mask_layer_named(const fw_mask_table *table, const char *text) {
    int layer, datatype;
    if (strcmp(text, "mask") == 0) return fw_mask_layer_of_role(table, "structure");
    if (fw_mask_gds_pair(text, &layer, &datatype)) {
        for (int k = 0; k < table->nlayer; k++)
            if (table->layer[k].layer == layer && table->layer[k].datatype == datatype) return k;
        return -1;
    }
    for (int k = 0; k < table->nlayer; k++)
        if (fw_text_same(table->layer[k].id, text) || fw_text_same(table->layer[k].name, text))
            return k;
    return fw_mask_layer_of_role(table, text);
}

/* a row for what no row has: it is in every file, and on no plate */
static fw_status add_own(fw_arena *arena, fw_mask_table *table, const char *text, fw_place place) {
    int number, datatype;
    size_t n = (size_t)table->nlayer;
    fw_mask_gds_pair(text, &number, &datatype);
    fw_mask_layer *list = fw_arena_grow(arena, table->layer, n, n + 1, sizeof *list);
    const char *id = fw_arena_printf(arena, "cell-%d-%d", number, datatype);
    const char *name = fw_arena_printf(arena, "CELL_%d_%d", number, datatype);
    FW_NEED(list && id && name ? list : NULL);
    list[n] = (fw_mask_layer){.layer = number,
                              .datatype = datatype,
                              .id = id,
                              .name = name,
                              .purpose = "drawn by cells of the description alone; on no plate",
                              .roles = 1u << FW_ROLE_CELL,
                              .tone = n > 0 ? list[0].tone : NULL,
                              .colour = "#7a7a7a",
                              .place = place};
    table->layer = list;
    table->nlayer++;
    return FW_OK;
}

static int role_of(const fw_mask_layer *layer) {
    for (int r = 0; r < FW_ROLE_COUNT; r++)
        if (layer->roles & 1u << r) return r;
    return FW_CELL_ROLE_NONE;
}

static fw_status unknown_layer(fw_arena *arena, const fw_mask_table *t, const char *to,
                               fw_place place, fw_diags *diags) {
    fw_text has = fw_text_new(arena);
    const char **id = fw_arena_array(arena, const char *, (size_t)t->nlayer + 1);
    FW_NEED(id);
    for (int k = 0; k < t->nlayer; k++)
        id[k] = t->layer[k].id ? t->layer[k].id : "";
    id[t->nlayer] = "mask";
    const char *near = fw_did_you_mean(to, id, (size_t)t->nlayer + 1);
    for (int k = 0; k < t->nlayer; k++)
        if (!t->layer[k].documentation)
            fw_text_printf(&has, "%s%s (%d/%d)", k ? ", " : "", t->layer[k].id, t->layer[k].layer,
                           t->layer[k].datatype);
    FW_NEED(has.failed ? NULL : has.data);
    return fw_diag_error(diags, 570, place,
                         "flow %s has no layer '%.64s' for a cell%s%s%s; it has mask, %s, and any "
                         "NUMBER/DATATYPE besides is a layer of the cell's own",
                         t->flow, to, near ? " (did you mean '" : "", near ? near : "",
                         near ? "'?)" : "", has.data);
}

/* one layer of a cell in one flow */
static fw_status settle(fw_arena *arena, fw_mask_table *t, const fw_device_cell *cell,
                        fw_device_cell_layer *layer, const char *first, fw_diags *diags) {
    int number, datatype, k = fw_mask_layer_named(t, layer->to);
    if (k < 0 && fw_mask_gds_pair(layer->to, &number, &datatype)) {
        k = t->nlayer;
        FW_TRY(add_own(arena, t, layer->to, cell->layers_place));
    }
    if (k < 0) return unknown_layer(arena, t, layer->to, cell->layers_place, diags);
    if (t->layer[k].documentation)
        return fw_diag_error(
            diags, 570, cell->layers_place,
            "layer %s of flow %s is for records and never exposed; put the cell on another one",
            layer->to, t->flow);
    int role = role_of(&t->layer[k]);
    if (layer->role != FW_CELL_ROLE_OPEN && layer->role != role)
        return fw_diag_error(
            diags, 570, cell->layers_place,
            "layer %s draws something else in flow %s than in flow %s; name what it draws: mask, "
            "text, mark ...",
            layer->to, t->flow, first);
    layer->role = role;
    return FW_OK;
}

fw_status fw_mask_cells_settle(fw_arena *arena, const fw_device *device,
                               fw_mask_table *const *table, int ntable, fw_diags *diags) {
    fw_status worst = FW_OK;
    for (int side = 0; side < 2; side++) {
        const fw_device_cell *cell = side ? device->wafer.cell : device->cell;
        int n = side ? device->wafer.ncell : device->ncell;
        for (int i = 0; i < n; i++)
            for (int k = 0; k < cell[i].nlayer; k++) {
                cell[i].layer[k].role = FW_CELL_ROLE_OPEN;
                for (int t = 0; t < ntable; t++) {
                    fw_status status =
                        settle(arena, table[t], &cell[i], &cell[i].layer[k], table[0]->flow, diags);
                    if (status != FW_OK && status != FW_INPUT) return status;
                    if (status != FW_OK) worst = status;
                }
            }
    }
    return worst;
}

/* ---- what files say of them ---- */

/* "7/0" of where it goes */
static const char *gds_of(const fw_mask *mask, const fw_layout_cell *c,
                          char text[FW_MASK_GDS_TEXT]) {
    int k = fw_mask_layer_named(mask->table, c->layer);
    if (k < 0) return c->layer;
    snprintf(text, FW_MASK_GDS_TEXT, "%d/%d", mask->table->layer[k].layer,
             mask->table->layer[k].datatype);
    return text;
}

void fw_mask_cells_json(fw_json *json, const fw_mask *mask) {
    if (mask->nplaced == 0) return;
    fw_json_line(json, 2);
    fw_json_list(json, "drawings");
    for (int i = 0; i < mask->nplaced; i++) {
        const fw_layout_cell *c = &mask->placed[i];
        char gds[FW_MASK_GDS_TEXT];
        fw_json_object(json, NULL);
        fw_json_text(json, "name", c->of->name);
        fw_json_text(json, "file", c->of->file);
        fw_json_text(json, "gds", gds_of(mask, c, gds));
        fw_json_truth(json, "biased", c->biased);
        fw_json_end(json);
    }
    fw_json_end(json);
}

void fw_mask_cells_order_text(const fw_mask *mask, fw_text *out) {
    if (mask->nplaced == 0) return;
    fw_text_add(out, "\ndrawings of others on it: name, file, layer\n");
    for (int i = 0; i < mask->nplaced; i++) {
        const fw_layout_cell *c = &mask->placed[i];
        char gds[FW_MASK_GDS_TEXT];
        fw_text_printf(out, "%s  %s  %s\n", c->of->name, c->of->file, gds_of(mask, c, gds));
    }
}
