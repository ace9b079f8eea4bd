/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Certificate and order data of the plate, as JSON; docs/reference/json.md explains every member.
 */
#include "mask/json.h"
#include "geometry/tessellate.h"
#include "mask/order.h"
#include "wafer/notes.h"
#include <math.h>

static void mm(fw_text *out, const char *key, double m, const char *behind) {
    fw_mask_json_number(out, key, m * 1e3, 12);
    fw_text_add(out, behind);
}

static void head(const fw_wafer *w, const char *gds_sha256, fw_text *out) {
    static const char *const side[] = {"bottom", "top", "left", "right"};
    fw_text_add(out, "{\n  \"schema\": \"flexwright.wafer/1\",\n  ");
    fw_mask_json_text(out, "device", w->device->name);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "title", w->title);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "flow", w->flow);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "version", FW_VERSION);
    fw_text_printf(out, ", \"rejected\": %s,\n  ", w->rejected ? "true" : "false");
    fw_mask_json_text(out, "gds_sha256", gds_sha256 ? gds_sha256 : "");
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "cell", w->top);
    fw_text_add(out, ",\n  \"wafer\": {");
    mm(out, "diameter_mm", w->form.diameter_m, ", ");
    mm(out, "flat_mm", w->form.flat_m, ", ");
    mm(out, "notch_mm", w->form.notch_m, ", ");
    fw_mask_json_text(out, "flat_side", side[w->form.side]);
    fw_text_add(out, ", ");
    mm(out, "edge_exclusion_mm", w->form.edge_m, "},\n  \"grid\": {");
    mm(out, "die_x_mm", w->grid.width * 1e-9, ", ");
    mm(out, "die_y_mm", w->grid.height * 1e-9, ", ");
    mm(out, "pitch_x_mm", w->grid.pitch_x * 1e-9, ", ");
    mm(out, "pitch_y_mm", w->grid.pitch_y * 1e-9, ", ");
    fw_text_printf(out, "\"rows\": %d, \"columns\": %d,\n    ", w->grid.rows, w->grid.columns);
    fw_mask_json_text(out, "centre_x", w->grid.street_x ? "street" : "die");
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "centre_y", w->grid.street_y ? "street" : "die");
    fw_text_printf(out,
                   ", \"dies\": %d, \"alignment_sites\": %d, \"test_dies\": %d, \"ids\": %s},\n",
                   w->dies, w->alignments, w->tests, w->ids ? "true" : "false");
}

/* what a mask shop asks for; tones and sides are those of the die's own order sheet */
static fw_status plate(const fw_wafer *w, const fw_wafer_sum *s, fw_text *out) {
    static const char *const sense[] = {"right-reading", "wrong-reading"};
    fw_order order;
    const fw_mask *any = w->ncell > 0 ? w->cell[0].mask : w->plate;
    FW_TRY(fw_order_gather(out->arena, any, &order));
    double width = HUGE_VAL, space = HUGE_VAL;
    for (int k = 0; k < w->table->nlayer; k++)
        if (order.plate[k]) {
            width = fmin(width, s[k].width_m);
            space = fmin(space, s[k].space_m);
        }
    fw_text_add(out, "  \"plate\": {");
    mm(out, "edge_mm", w->form.plate_m, ", ");
    fw_mask_json_text(out, "layers", w->table->plate);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "polygon_tone", order.tone);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "field", order.field);
    fw_text_add(out, ",\n    ");
    fw_mask_json_text(out, "reading", w->table->reading);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "reading_chrome_up", order.mirror < 0 ? NULL : sense[order.mirror]);
    fw_text_add(out, ", \"grid_nm\": 1,\n    ");
    fw_mask_json_number(out, "min_feature_um", width * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "min_space_um", space * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "bias_um_per_edge", any->bias_m * 1e6, 9);
    fw_text_add(out, ",\n    \"extent_um\": [");
    fw_box box = fw_wafer_extent(w);
    const double side[] = {box.x0, box.y0, box.x1, box.y1};
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_text_number(out, side[i] * 1e6, 12);
    }
    fw_text_add(out, "]},\n");
    return FW_OK;
}

static fw_status variants(const fw_wafer *w, fw_text *out) {
    const fw_wafer_asked *asked = &w->device->wafer;
    fw_text_add(out, "  \"variants\": [");
    for (int v = 0; v < w->nvariant; v++) {
        const fw_wafer_variant *u = &w->variant[v];
        fw_text_printf(out, "%s\n    {\"variant\": %d, \"parameters\": [", v ? "," : "", v + 1);
        for (int k = 0; k < asked->nsweep; k++) {
            fw_text_add(out, k ? ", {" : "{");
            fw_mask_json_text(out, "name", w->device->parameter[asked->sweep[k].parameter].name);
            fw_text_add(out, ", ");
            fw_mask_json_number(out, "value", fw_wafer_value(w, u, k), 12);
            fw_text_add(out, ", ");
            fw_mask_json_text(out, "unit", asked->sweep[k].unit);
            fw_text_add(out, "}");
        }
        fw_text_printf(out, "], \"dies\": %d, ", u->dies);
        fw_mask_json_text(out, "verdict", u->decision);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "utilisation", u->utilisation, 12);
        fw_text_printf(out, ", \"nominal_instead\": %s, ", fw_wafer_stood_in(u) ? "true" : "false");
        fw_mask_json_text(out, "why", u->why);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "\n  ],\n");
    return FW_OK;
}

static void cells(const fw_wafer *w, fw_text *out) {
    fw_text_add(out, "  \"cells\": [");
    for (int c = 0; c < w->ncell; c++) {
        const fw_mask *m = w->cell[c].mask;
        int vertices = 0;
        for (int i = 0; i < m->nshape; i++)
            vertices += m->shape[i].polygon.count;
        fw_text_printf(out, "%s\n    {", c ? "," : "");
        fw_mask_json_text(out, "cell", w->cell[c].name);
        fw_text_printf(out, ", \"placed\": %d, \"polygons\": %d, \"vertices\": %d}",
                       w->cell[c].placed, m->nshape, vertices);
    }
    fw_text_printf(out, "\n  ],\n  \"arrays\": %d,\n", w->nrun);
}

static void layers(const fw_wafer *w, const fw_wafer_sum *s, fw_text *out) {
    fw_text_add(out, "  \"layers\": [");
    for (int k = 0; k < w->table->nlayer; k++) {
        const fw_mask_layer *y = &w->table->layer[k];
        fw_text_printf(out, "%s\n    {\"gds\": \"%d/%d\", ", k ? "," : "", y->layer, y->datatype);
        fw_mask_json_text(out, "name", y->name);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "polygons", s[k].polygons, 15);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "vertices", s[k].vertices, 15);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "polygon_area_um2", s[k].area_m2 * 1e12, 17);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "min_width_um", s[k].width_m * 1e6, 9);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "min_space_um", s[k].space_m * 1e6, 9);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "\n  ]\n}\n");
}

fw_status fw_wafer_write_json(const fw_wafer *w, const char *gds_sha256, fw_text *out) {
    fw_wafer_sum *s;
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    head(w, gds_sha256, out);
    FW_TRY(plate(w, s, out));
    FW_TRY(variants(w, out));
    cells(w, out);
    layers(w, s, out);
    return fw_text_end(out);
}
