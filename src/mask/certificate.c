/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was proven about the file, as JSON; docs/theory/masks.md explains every member. */
#include "mask/certificate.h"
#include "base/constants.h"
#include "mask/findings.h"
#include "mask/json.h"
#include "mask/notes.h"
#include <math.h>

static void layer(fw_text *out, const fw_mask_layer *y, const fw_mask_measure *m) {
    fw_text_printf(out, "    {\"gds\": \"%d/%d\", ", y->layer, y->datatype);
    fw_mask_json_text(out, "id", y->id);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "name", y->name);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "purpose", y->purpose);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "tone", y->tone);
    fw_text_printf(out, ",\n     \"biased\": %s, \"polygons\": %d, \"vertices\": %d,\n     ",
                   y->biased ? "true" : "false", m->shapes, m->vertices);
    fw_mask_json_number(out, "area_um2", m->area_m2 * 1e12, 17);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "polygon_area_um2", m->polygon_area_m2 * 1e12, 17);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "area_bound_um2", m->bound_m2 * 1e12, 6);
    fw_text_add(out, ",\n     ");
    fw_mask_json_number(out, "perimeter_um", m->perimeter_m * 1e6, 12);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "min_width_um", m->width_m * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "min_space_um", m->space_m * 1e6, 9);
    fw_text_add(out, ",\n     ");
    fw_mask_json_number(out, "rule_width_um", y->min_width_m * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "rule_space_um", y->min_space_m * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "rule_source", y->rule_source ? y->rule_source : "");
    fw_text_add(out, ",\n     ");
    fw_mask_json_number(out, "shortest_edge_nm", m->shortest_edge_m * 1e9, 6);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "sharpest_corner_deg", m->sharpest_rad * (180 / FW_PI), 6);
    fw_certificate_layer(out, m);
    fw_text_add(out, "}");
}

static void head(const fw_mask *mask, const char *gds_sha256, fw_text *out) {
    fw_text_add(out, "{\n  \"schema\": \"flexwright.mask/1\",\n  ");
    fw_mask_json_text(out, "device", mask->device);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "flow", mask->flow);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "cell", mask->cell);
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "version", FW_VERSION);
    fw_text_printf(out, ",\n  \"rejected\": %s,\n  ", mask->rejected ? "true" : "false");
    fw_mask_json_text(out, "gds_sha256", gds_sha256 ? gds_sha256 : "");
    fw_text_add(out, ",\n  ");
    fw_mask_json_text(out, "reading", mask->table->reading);
    fw_text_add(out, ",\n  \"grid_nm\": 1, ");
    fw_mask_json_number(out, "tolerance_nm", mask->tolerance_m * 1e9, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "edge_error_nm", mask->tolerance_m * 1e9 + FW_SQRT_HALF, 9);
    fw_text_add(out, ",\n  ");
    fw_mask_json_number(out, "bias_um_per_edge", mask->bias_m * 1e6, 9);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "bias", "process bias included, mask CD bias 0");
    fw_text_add(out, ",\n  \"extent_um\": [");
    const double side[] = {mask->box.x0, mask->box.y0, mask->box.x1, mask->box.y1};
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, i ? ", " : "");
        fw_text_number(out, side[i] * 1e6, 12);
    }
    fw_text_add(out, "],\n");
}

fw_status fw_mask_write_certificate(const fw_mask *mask, const char *gds_sha256, fw_text *out) {
    return fw_mask_write_certificate_of(mask, gds_sha256, NULL, 0, out);
}

fw_status fw_mask_write_certificate_of(const fw_mask *mask, const char *gds_sha256,
                                       const fw_output_file *file, int nfile, fw_text *out) {
    const char **line;
    int n;
    FW_TRY(fw_mask_notes(out->arena, mask, &line, &n));
    head(mask, gds_sha256, out);
    fw_text_add(out, "  \"proven\": [\"every polygon simple, in exact integers\", "
                     "\"areas within the bound\", \"both sides of every joint on the same grid "
                     "points\"");
    if (mask->nbroken == 0)
        fw_text_add(out, ", \"width and space of the exact outlines above the rules\"");
    fw_text_add(out, "],\n  \"findings\": ");
    fw_mask_json_findings(out, mask);
    fw_text_add(out, ",\n  \"layers\": [\n");
    for (int k = 0; k < mask->table->nlayer; k++) {
        layer(out, &mask->table->layer[k], &mask->measure[k]);
        fw_text_add(out, k + 1 < mask->table->nlayer ? ",\n" : "\n");
    }
    fw_text_add(out, "  ],\n");
    fw_certificate_shapes(mask, file, nfile, out);
    fw_text_add(out, "  \"notes\": [");
    for (int i = 0; i < n; i++) {
        fw_text_add(out, i ? ",\n    " : "\n    ");
        fw_mask_json_string(out, line[i]);
    }
    fw_text_add(out, "\n  ]\n}\n");
    return fw_text_end(out);
}
