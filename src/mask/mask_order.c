/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a mask shop asks for beside the data: which layers make the plate, tone, reading, sizes, and
   where to measure. docs/theory/mask-files.md says where the terms come from. */
#include "mask/order.h"
#include "mask/mask_flatten.h"
#include <string.h>

void fw_mask_order_count(const fw_mask *mask, int layer, int *polygons, int *vertices) {
    *polygons = *vertices = 0;
    for (int i = 0; i < mask->nshape; i++) {
        if (mask->shape[i].layer != layer) continue;
        *polygons += mask->shape[i].npart;
        for (int k = 0; k < mask->shape[i].npart; k++)
            *vertices += mask->shape[i].part[k].count;
    }
}

/* right-reading chrome down is wrong-reading chrome up, and the other way round */
static int mirrored(const char *reading) {
    bool right = strstr(reading, "right-reading"), wrong = strstr(reading, "wrong-reading");
    bool down = strstr(reading, "chrome down"), up = strstr(reading, "chrome up");
    if (right == wrong || down == up) return -1;
    return right == down;
}

/* ---- sites ---- */
static void add_site(fw_mask_order *order, fw_mask_order_site site) {
    order->site[order->nsite++] = site;
}

fw_status fw_mask_order_sites(fw_arena *arena, const fw_mask *mask, fw_mask_order *order) {
    size_t most = 2 * (size_t)mask->table->nlayer + (size_t)mask->nshape;
    FW_NEED(order->site = fw_arena_array(arena, fw_mask_order_site, most));
    for (int k = 0; k < mask->table->nlayer; k++) {
        const fw_mask_measure *m = &mask->measure[k];
        if (!order->plate[k]) continue;
        if (isfinite(m->width_m))
            add_site(order,
                     (fw_mask_order_site){k, "least width", false, m->width_at[0], m->width_at[1]});
        if (isfinite(m->space_m))
            add_site(order,
                     (fw_mask_order_site){k, "least space", true, m->space_at[0], m->space_at[1]});
    }
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        if (!order->plate[s->layer] || s->piece->role != FW_ROLE_FLEXURE) continue;
        int a, b;
        if (!isfinite(fw_geometry_contour_clearance(&s->contour, true, &a, &b)) || a < 0) continue;
        fw_geometry_chord c = fw_mask_narrowest(&s->contour.segment[a], &s->contour.segment[b]);
        add_site(order, (fw_mask_order_site){s->layer, s->piece->label, false, c.at_p, c.at_q});
    }
    return FW_OK;
}

fw_status fw_mask_order_gather(fw_arena *arena, const fw_mask *mask, fw_mask_order *order) {
    const fw_mask_table *table = mask->table;
    const char *wrong;
    int first;
    *order = (fw_mask_order){.width_m = HUGE_VAL, .space_m = HUGE_VAL};
    FW_NEED(order->name = fw_arena_printf(arena, "%s-%s", mask->cell, mask->flow));
    FW_NEED(order->plate = fw_arena_array(arena, bool, (size_t)table->nlayer));
    if (!fw_mask_plate_layers(table, order->plate, &first, &wrong)) return FW_INPUT;
    for (int k = 0; !table->plate && k < table->nlayer; k++) /* not said: all that is drawn */
        order->plate[k] = table->layer[k].roles != 0;
    if (first >= 0) {
        order->tone = table->layer[first].tone;
        order->field = strcmp(order->tone, "data dark") == 0 ? "clear" : "dark";
    }
    order->mirror = mirrored(table->reading);
    for (int k = 0; k < table->nlayer; k++) {
        if (!order->plate[k]) continue;
        int polygons, vertices;
        fw_mask_order_count(mask, k, &polygons, &vertices);
        order->polygons += polygons;
        order->vertices += vertices;
        order->width_m = fmin(order->width_m, mask->measure[k].width_m);
        order->space_m = fmin(order->space_m, mask->measure[k].space_m);
    }
    return fw_mask_order_sites(arena, mask, order);
}
