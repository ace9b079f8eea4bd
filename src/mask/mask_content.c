/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The test die as a mask. */
#include "mask/mask.h"
#include <math.h>
#include <string.h>

/* the layer on which structure is drawn has the rules that the patterns keep */
static const fw_mask_layer *structure_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_STRUCTURE) return &table->layer[k];
    return NULL;
}

fw_status fw_mask_frame_marks(fw_arena *arena, const fw_mask_table *table, const fw_layout *device,
                              const fw_layout **layout, int *left_out) {
    const fw_mask_layer *layer = structure_layer(table);
    double width = layer ? layer->min_width_m : 0, space = layer ? layer->min_space_m : 0;
    return fw_layout_content_on_frame(arena, device, table->pattern, table->npattern, width, space,
                                      layout, left_out);
}

fw_status fw_mask_coupons_build(fw_arena *arena, const fw_mask_table *table,
                                const fw_mask_coupon_options *options, fw_diags *diags,
                                const fw_mask_coupons **coupons) {
    *coupons = NULL;
    const fw_mask_layer *layer = structure_layer(table);
    if (table->npattern == 0 || !layer) return FW_OK;
    fw_mask_coupons *c = fw_arena_one(arena, fw_mask_coupons);
    FW_NEED(c);
    const char *title = fw_arena_printf(arena, "TEST %s", table->flow);
    FW_NEED(title);
    fw_layout_content_options content = {.die = options->die,
                                         .frame_m = options->frame_m,
                                         .lane_m = options->lane_m,
                                         .bias_m = options->mask.bias_m,
                                         .width_rule_m = layer->min_width_m,
                                         .space_rule_m = layer->min_space_m,
                                         .title = title,
                                         .flow = table->flow,
                                         .die_id = options->die_id,
                                         .file = layer->place.file};
    FW_TRY(fw_layout_content_build(arena, table->pattern, table->npattern, &content, diags,
                                   &c->content));
    fw_mask_options mask = options->mask;
    mask.bias_m = 0; /* it is in the outlines, where a pattern wants it */
    mask.no_islands = true;
    mask.title = title;
    FW_TRY(fw_mask_build(arena, c->content->layout, table, title, &mask, diags, &c->mask));
    *coupons = c;
    return FW_OK;
}
