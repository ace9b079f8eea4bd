/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order sheet as JSON; docs/reference/json.md explains every member. */
#include "geometry/segment.h"
#include "mask/json.h"
#include "mask/order.h"

static void place(fw_text *out, const char *key, fw_vec2 at) {
    fw_text_printf(out, "\"%s\": [", key);
    fw_text_fixed(out, at.x * 1e6, 4);
    fw_text_add(out, ", ");
    fw_text_fixed(out, at.y * 1e6, 4);
    fw_text_add(out, "]");
}

static void yes_no(fw_text *out, const char *key, int value) {
    fw_text_printf(out, "\"%s\": %s", key, value < 0 ? "null" : value ? "true" : "false");
}

static void head(const fw_mask *mask, const fw_order *order, fw_text *out) {
    const char *sense[] = {"right-reading", "wrong-reading"};
    fw_text_add(out, "{\n  \"schema\": \"flexwright.order/1\",\n  ");
    fw_mask_json_text(out, "mask", order->name);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "device", mask->device);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "flow", mask->flow);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "cell", mask->cell);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "version", FW_VERSION);
    fw_text_add(out, ",\n  ");
    yes_no(out, "rejected", mask->rejected);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "plate", mask->table->plate);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "plate_text", mask->table->order);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "polygon_tone", order->tone);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "field", order->field);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "reading", mask->table->reading);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "reading_chrome_up", order->mirror < 0 ? NULL : sense[order->mirror]);
    fw_text_add(out, ", ");
    yes_no(out, "mirror_seen_chrome_up", order->mirror);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "mirror_axis", order->mirror == 1 ? "x becomes -x" : NULL);
    fw_text_add(out, ", ");
    yes_no(out, "mirrored_in_data", 0);
    fw_text_add(out, ",\n  ");
}

static void sizes(const fw_mask *mask, const fw_order *order, fw_text *out) {
    fw_mask_json_number(out, "min_feature_um", order->width_m * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "min_space_um", order->space_m * 1e6, 9);
    fw_text_add(out, ",\n  ");
    fw_mask_json_number(out, "bias_um_per_edge", mask->bias_m * 1e6, 9);
    fw_text_add(out, ", \"bias_in_data\": true, \"mask_cd_bias_um\": 0,\n  ");
    fw_text_add(out, "\"grid_nm\": 1, ");
    fw_mask_json_number(out, "tolerance_nm", mask->tolerance_m * 1e9, 9);
    fw_text_add(out, ",\n  \"extent_um\": [");
    const double side[] = {mask->box.x0, mask->box.y0, mask->box.x1, mask->box.y1};
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_text_number(out, side[i] * 1e6, 12);
    }
    fw_text_printf(out, "],\n  \"vertex_limit\": %d,", mask->vertex_limit);
    fw_text_printf(out, "\n  \"polygons\": %d, \"vertices\": %d,\n", order->polygons,
                   order->vertices);
}

static void layers(const fw_mask *mask, const fw_order *order, fw_text *out) {
    fw_text_add(out, "  \"layers\": [");
    for (int k = 0; k < mask->table->nlayer; k++) {
        const fw_mask_layer *y = &mask->table->layer[k];
        const fw_mask_measure *m = &mask->measure[k];
        int polygons, vertices;
        fw_order_count(mask, k, &polygons, &vertices);
        fw_text_printf(out, "%s\n    {\"gds\": \"%d/%d\", ", k ? "," : "", y->layer, y->datatype);
        fw_mask_json_text(out, "name", y->name);
        fw_text_add(out, ", ");
        fw_mask_json_text(out, "polygon_tone", y->documentation ? NULL : y->tone);
        fw_text_add(out, ", ");
        yes_no(out, "on_plate", order->plate[k]);
        fw_text_add(out, ", ");
        yes_no(out, "biased", y->biased);
        fw_text_printf(out, ",\n     \"polygons\": %d, \"vertices\": %d, ", polygons, vertices);
        fw_mask_json_number(out, "min_width_um", m->width_m * 1e6, 9);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "min_space_um", m->space_m * 1e6, 9);
        fw_text_add(out, ", ");
        fw_mask_json_text(out, "purpose", y->purpose);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "\n  ],\n");
}

static void sites(const fw_mask *mask, const fw_order *order, fw_text *out) {
    fw_text_add(out, "  \"cd_sites\": [");
    for (int i = 0; i < order->nsite; i++) {
        const fw_order_site *s = &order->site[i];
        const fw_mask_layer *y = &mask->table->layer[s->layer];
        fw_text_printf(out, "%s\n    {\"site\": %d, \"gds\": \"%d/%d\", ", i ? "," : "", i + 1,
                       y->layer, y->datatype);
        fw_mask_json_text(out, "what", s->what);
        fw_text_add(out, ", ");
        fw_mask_json_text(out, "kind", s->space ? "space" : "width");
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "cd_um", vec_distance(s->from, s->to) * 1e6, 9);
        fw_text_add(out, ",\n     ");
        place(out, "centre_um", vec_along(s->from, 0.5, vec_sub(s->to, s->from)));
        fw_text_add(out, ", ");
        place(out, "from_um", s->from);
        fw_text_add(out, ", ");
        place(out, "to_um", s->to);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "\n  ],\n");
}

fw_status fw_mask_write_order(const fw_mask *mask, const fw_output_file *file, int nfile,
                              fw_text *out) {
    fw_order order;
    FW_TRY(fw_order_gather(out->arena, mask, &order));
    head(mask, &order, out);
    sizes(mask, &order, out);
    layers(mask, &order, out);
    sites(mask, &order, out);
    fw_text_add(out, "  \"files\": [");
    for (int i = 0; i < nfile; i++) {
        fw_text_printf(out, "%s\n    {", i ? "," : "");
        fw_mask_json_text(out, "name", file[i].name);
        fw_text_printf(out, ", \"bytes\": %zu, ", file[i].size);
        fw_mask_json_text(out, "sha256", file[i].sha256);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "\n  ]\n}\n");
    return fw_text_end(out);
}
