/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order sheet for people: ASCII, to be pasted into a shop's form. */
#include "geometry/segment.h"
#include "mask/order.h"
#include <stdio.h>

static void row(fw_text *out, const char *what, const char *value) {
    fw_text_printf(out, "%-22s %s\n", what, value);
}

static const char *micrometres(char *text, size_t n, double value_m) {
    char number[32];
    if (isfinite(value_m))
        snprintf(text, n, "%s um", fw_number_text(number, sizeof number, value_m * 1e6, 7));
    else
        snprintf(text, n, "none below %s um",
                 fw_number_text(number, sizeof number, FW_MASK_LOOK_M * 1e6, 7));
    return text;
}

static void head(const fw_mask *mask, const fw_mask_order *order, fw_text *out) {
    char line[200], number[32];
    if (mask->rejected) fw_text_add(out, "REJECTED: the design is not accepted. Do not order.\n\n");
    fw_text_printf(out, "Order sheet of mask %s (flexwright " FW_VERSION ")\n\n", order->name);
    row(out, "device", mask->device);
    row(out, "flow", mask->flow);
    row(out, "top cell", mask->cell);
    row(out, "plate", mask->table->plate ? mask->table->plate : "not said: all layers drawn");
    if (mask->table->order) row(out, "", mask->table->order);
    snprintf(line, sizeof line, "digitised %s (%s field)", order->tone ? order->tone : "data: ask",
             order->field ? order->field : "unknown");
    row(out, "polygon tone", line);
    row(out, "reading", mask->table->reading);
    static const char *const mirror[] = {
        "the reading does not say: ask before writing",
        "no: with the chrome up the plate looks like the data",
        "yes: with the chrome up the plate is the mirror image of the data (x becomes -x)"};
    row(out, "mirror", mirror[order->mirror + 1]);
    row(out, "", "the data themselves are not mirrored");
    row(out, "least feature", micrometres(line, sizeof line, order->width_m));
    row(out, "least space", micrometres(line, sizeof line, order->space_m));
    snprintf(line, sizeof line, "%s um per edge, in the data already; mask CD bias 0",
             fw_number_text(number, sizeof number, mask->bias_m * 1e6, 6));
    row(out, "process bias", line);
    snprintf(line, sizeof line, "1 nm; arcs within %s nm",
             fw_number_text(number, sizeof number, mask->tolerance_m * 1e9, 6));
    row(out, "grid", line);
}

static void box(const fw_mask *mask, fw_text *out) {
    const double side[] = {mask->box.x0, mask->box.y0, mask->box.x1, mask->box.y1};
    fw_text_printf(out, "%-22s ", "extent");
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, i == 2 ? " to " : i ? ", " : "");
        fw_text_fixed(out, side[i] * 1e6, 4);
    }
    fw_text_add(out, " um\n");
}

static void layers(const fw_mask *mask, const fw_mask_order *order, fw_text *out) {
    fw_text_add(out, "\nlayer  name                 tone        on plate  polygons  vertices\n");
    for (int k = 0; k < mask->table->nlayer; k++) {
        const fw_mask_layer *y = &mask->table->layer[k];
        int polygons, vertices;
        char gds[32];
        fw_mask_order_count(mask, k, &polygons, &vertices);
        snprintf(gds, sizeof gds, "%d/%d", y->layer, y->datatype);
        fw_text_printf(out, "%-6s %-20s %-11s %-9s %8d  %8d\n", gds, y->name,
                       y->documentation ? "-" : y->tone, order->plate[k] ? "yes" : "no", polygons,
                       vertices);
    }
}

static void sites(const fw_mask *mask, const fw_mask_order *order, fw_text *out) {
    fw_text_add(out, "\nCD sites: centre of the chord and its direction, um and degrees\n"
                     "site  layer  kind        x            y       angle       CD  what\n");
    for (int i = 0; i < order->nsite; i++) {
        const fw_mask_order_site *s = &order->site[i];
        const fw_mask_layer *y = &mask->table->layer[s->layer];
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        char gds[32];
        snprintf(gds, sizeof gds, "%d/%d", y->layer, y->datatype);
        double degrees = atan2(along.y, along.x) * 180 / FW_PI;
        fw_text_printf(out, "%4d  %-5s  %-5s ", i + 1, gds, s->space ? "space" : "width");
        fw_text_real(out, "%12.3f", at.x * 1e6);
        fw_text_real(out, " %12.3f", at.y * 1e6);
        fw_text_real(out, " %8.2f", degrees);
        fw_text_real(out, " %8.3f", vec_length(along) * 1e6);
        fw_text_printf(out, "  %s\n", s->what);
    }
}

fw_status fw_mask_write_order_text(const fw_mask *mask, const fw_output_file *file, int nfile,
                                   fw_text *out) {
    fw_mask_order order;
    FW_TRY(fw_mask_order_gather(out->arena, mask, &order));
    head(mask, &order, out);
    box(mask, out);
    fw_text_printf(out, "%-22s %d, %d vertices, at most %d each\n", "polygons on the plate",
                   order.polygons, order.vertices, mask->vertex_limit);
    layers(mask, &order, out);
    sites(mask, &order, out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}
