/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask.h"
#include "geometry/segment.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a mask shop asks for beside the data: which layers make the plate, tone, reading, sizes, and
   where to measure. docs/theory/mask-files.md says where the terms come from. */

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
int fw_mask_reading_mirrors(const char *reading) {
    bool right = strstr(reading, "right-reading"), wrong = strstr(reading, "wrong-reading");
    bool down = strstr(reading, "chrome down"), up = strstr(reading, "chrome up");
    if (right == wrong || down == up) return -1;
    return right == down;
}

/* ---- sites ---- */
static void add_site(fw_mask_order *order, fw_mask_order_site site) {
    order->site[order->nsite++] = site;
}

/* Of a layer without a width below 100 um its smallest polygon stands for it: where a line along x through its middle,
   half a grid step beside the vertices, enters and leaves it first. Ends within 0.5 nm. */
static bool chord_across(const fw_mask *mask, int layer, fw_mask_order_site *site) {
    const fw_mask_shape *least = NULL;
    double at[2] = {HUGE_VAL, HUGE_VAL};
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *s = &mask->shape[i];
        if (s->layer == layer && (!least || s->area_m2 < least->area_m2)) least = s;
    }
    if (!least) return false;
    double y = floor(0.5e9 * (least->box.y0 + least->box.y1)) + 0.5;
    for (int i = 0; i < least->polygon.count; i++) {
        fw_geometry_point a = least->polygon.vertex[i],
                          b = least->polygon.vertex[(i + 1) % least->polygon.count];
        if ((a.y_dbu < y) == (b.y_dbu < y)) continue;
        double x = a.x_dbu + (y - a.y_dbu) * ((double)b.x_dbu - a.x_dbu) / (b.y_dbu - a.y_dbu);
        if (x < at[0])
            at[1] = at[0], at[0] = x;
        else
            at[1] = fmin(at[1], x);
    }
    *site = (fw_mask_order_site){layer,
                                 least->piece->label,
                                 false,
                                 {at[0] * FW_GEOMETRY_GRID_M, y * FW_GEOMETRY_GRID_M},
                                 {at[1] * FW_GEOMETRY_GRID_M, y * FW_GEOMETRY_GRID_M}};
    return isfinite(at[1]);
}

static fw_status order_sites(fw_arena *arena, const fw_mask *mask, fw_mask_order *order) {
    size_t most = 3 * (size_t)mask->table->nlayer + (size_t)mask->nshape;
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
        fw_mask_order_site across;
        if (!isfinite(m->width_m) && chord_across(mask, k, &across)) add_site(order, across);
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

fw_status fw_mask_order_gather(fw_arena *arena, const fw_mask *mask, int plate,
                               fw_mask_order *order) {
    const fw_mask_table *table = mask->table;
    const fw_mask_plate_row own = fw_mask_plate_at(table, plate), *row = &own;
    const char *wrong;
    int first;
    *order = (fw_mask_order){.plate_index = plate, .width_m = HUGE_VAL, .space_m = HUGE_VAL};
    FW_NEED(order->name = fw_arena_printf(arena, "%s-%s%s%s", mask->cell, mask->flow,
                                          fw_mask_plates(table) > 1 ? "-" : "",
                                          fw_mask_plates(table) > 1 ? row->id : ""));
    FW_NEED(order->plate = fw_arena_array(arena, bool, (size_t)table->nlayer));
    if (!fw_mask_plate_layers(table, row->layers, order->plate, &first, &wrong)) return FW_INPUT;
    for (int k = 0; !row->layers && k < table->nlayer; k++) /* not said: all that is drawn */
        order->plate[k] = (table->layer[k].roles & ~(1u << FW_ROLE_CELL)) != 0;
    if (first >= 0) {
        order->tone = table->layer[first].tone;
        order->field = strcmp(order->tone, "data dark") == 0 ? "clear" : "dark";
    }
    order->mirror = fw_mask_reading_mirrors(row->reading);
    for (int k = 0; k < table->nlayer; k++) {
        if (!order->plate[k]) continue;
        int polygons, vertices;
        fw_mask_order_count(mask, k, &polygons, &vertices);
        order->polygons += polygons;
        order->vertices += vertices;
        order->width_m = fmin(order->width_m, mask->measure[k].width_m);
        order->space_m = fmin(order->space_m, mask->measure[k].space_m);
        order->unfinished = order->unfinished || mask->measure[k].unfinished;
    }
    return order_sites(arena, mask, order);
}

/* The order sheet for people: ASCII, to be pasted into a shop's form. */

void fw_mask_order_line(fw_text *out, const char *what, const char *value) {
    fw_text_printf(out, "%-22s %s\n", what, value);
}

void fw_mask_order_plate_lines(fw_text *out, const char *what, const fw_mask_table *table,
                               const fw_mask_order *order) {
    static const char *const mirror[] = {
        "the reading does not say: ask before writing",
        "no: with the chrome up the plate looks like the data",
        "yes: with the chrome up the plate is the mirror image of the data (x becomes -x)"};
    const fw_mask_plate_row own = fw_mask_plate_at(table, order->plate_index), *row = &own;
    char tone[200];
    fw_mask_order_line(out, what, row->layers ? row->layers : "not said: all layers drawn");
    if (row->order) fw_mask_order_line(out, "", row->order);
    snprintf(tone, sizeof tone, "digitised %s (%s field)", order->tone ? order->tone : "data: ask",
             order->field ? order->field : "unknown");
    fw_mask_order_line(out, "polygon tone", tone);
    fw_mask_order_line(out, "reading", row->reading);
    fw_mask_order_line(out, "mirror", mirror[order->mirror + 1]);
    fw_mask_order_line(out, "", "the data themselves are not mirrored");
}

void fw_mask_order_set_lines(fw_text *out, const fw_mask_table *table, const fw_mask_order *order) {
    const fw_mask_plate_row own = fw_mask_plate_at(table, order->plate_index), *row = &own;
    char line[200], number[32];
    if (fw_mask_plates(table) < 2) return;
    snprintf(line, sizeof line, "%d of %d of this flow, \"%s\": %s", order->plate_index + 1,
             table->nplate, row->id, row->title);
    fw_mask_order_line(out, "of the set", line);
    if (!row->aligned_to) return;
    snprintf(line, sizeof line, "to the marks of plate \"%s\"%s, within %s um", row->aligned_to,
             row->back ? ", seen from the back of the wafer" : "",
             fw_number_text(number, sizeof number, row->overlay_m * 1e6, 4));
    fw_mask_order_line(out, "aligned", line);
}

static void least_line(fw_text *out, const char *what, double value_m, bool unfinished) {
    bool there = isfinite(value_m);
    char number[32], line[128];
    fw_number_text(number, sizeof number, (there ? value_m : FW_MASK_LOOK_M) * 1e6, 7);
    snprintf(line, sizeof line, "%s%s um%s", there ? "" : "none below ", number,
             unfinished ? there ? " or less: edges are too many to be looked through (FW-D592)"
                                : " among those looked at, which are not all (FW-D592)"
                        : "");
    fw_mask_order_line(out, what, line);
}

/* "-20 um per edge of 6/0, 20 um of 7/0" of a plate with lengths of its own; of the device's "1.1 um per edge" */
static void bias_line(fw_text *out, const fw_mask *mask, int plate, double scale) {
    const fw_mask_table *table = mask->table;
    char number[32];
    int said = 0;
    fw_text line = fw_text_new(out->arena);
    bool own = plate != table->device_plate;
    for (int k = 0; own && k < table->nlayer; k++) {
        if (!fw_mask_plate_draws(table, plate, k)) continue;
        double bias_m = scale * fw_mask_layer_bias_m(mask, k);
        fw_text_printf(&line, "%s%s um %sof %d/%d", said ? ", " : "",
                       fw_number_text(number, sizeof number, bias_m * 1e6, 6),
                       said ? "" : "per edge ", table->layer[k].layer, table->layer[k].datatype);
        said++;
    }
    if (!own)
        fw_text_printf(&line, "%s um per edge",
                       fw_number_text(number, sizeof number, scale * mask->bias_m * 1e6, 6));
    fw_text_add(&line, ", in the data already; mask CD bias 0");
    fw_mask_order_line(out, "process bias", fw_text_end(&line) == FW_OK ? line.data : "");
}

double fw_mask_plate_bias_m(const fw_mask *mask, int plate) {
    int first;
    const char *wrong;
    const char *layers = fw_mask_plate_at(mask->table, plate).layers;
    bool own = plate != mask->table->device_plate && layers &&
               fw_mask_plate_layers(mask->table, layers, NULL, &first, &wrong);
    return own ? fw_mask_layer_bias_m(mask, first) : mask->bias_m;
}

void fw_mask_order_size_lines(fw_text *out, double width_m, double space_m, bool unfinished,
                              const fw_mask *mask, int plate) {
    fw_mask_order_scaled_lines(out, width_m, space_m, unfinished, mask, plate, 1);
}

void fw_mask_order_scaled_lines(fw_text *out, double width_m, double space_m, bool unfinished,
                                const fw_mask *mask, int plate, double scale) {
    char line[200], number[32];
    least_line(out, "least feature", width_m, unfinished);
    least_line(out, "least space", space_m, unfinished);
    bias_line(out, mask, plate, scale);
    snprintf(line, sizeof line, "1 nm; arcs within %s nm",
             fw_number_text(number, sizeof number, scale * mask->tolerance_m * 1e9, 6));
    fw_mask_order_line(out, "grid", line);
}

void fw_mask_order_extent_line(fw_text *out, fw_geometry_box box) {
    const double side[] = {box.x0, box.y0, box.x1, box.y1};
    fw_text_printf(out, "%-22s ", "extent");
    for (int i = 0; i < 4; i++) {
        fw_text_add(out, i == 2 ? " to " : i ? ", " : "");
        fw_text_fixed(out, side[i] * 1e6, 4);
    }
    fw_text_add(out, " um\n");
}

void fw_mask_json_because(fw_json *json, const fw_mask *mask) {
    if (mask->nbecause == 0) return;
    fw_json_line(json, 2);
    fw_json_list(json, "rejected_because");
    for (int i = 0; i < mask->nbecause; i++)
        fw_json_text(json, NULL, mask->because[i]);
    fw_json_end(json);
}

void fw_mask_json_set(fw_json *json, const fw_mask_table *table, const fw_mask_order *order) {
    const fw_mask_plate_row own = fw_mask_plate_at(table, order->plate_index), *row = &own;
    if (fw_mask_plates(table) < 2) return;
    fw_json_line(json, 2);
    fw_json_object(json, "plate_of_set");
    fw_json_text(json, "id", row->id);
    fw_json_text(json, "title", row->title);
    fw_json_whole(json, "number", order->plate_index + 1);
    fw_json_whole(json, "of", table->nplate);
    fw_json_text(json, "aligned_to", row->aligned_to);
    fw_json_truth(json, "from_the_back", row->back);
    fw_json_number(json, "overlay_um", row->overlay_m * 1e6, 9);
    fw_json_end(json);
}

void fw_mask_order_rejected(fw_text *out, const fw_mask *mask) {
    fw_text_add(out, "REJECTED: the design is not accepted. Do not order.\n");
    for (int i = 0; i < mask->nbecause; i++)
        fw_text_printf(out, "  because %s\n", mask->because[i]);
    fw_text_add(out, "\n");
}

static void head(const fw_mask *mask, const fw_mask_order *order, fw_text *out) {
    if (mask->rejected) fw_mask_order_rejected(out, mask);
    fw_text_printf(out, "Order sheet of mask %s (flexwright " FW_VERSION ")\n\n", order->name);
    fw_mask_order_line(out, "device", mask->device);
    fw_mask_order_line(out, "flow", mask->flow);
    fw_mask_order_line(out, "top cell", mask->cell);
    fw_mask_order_set_lines(out, mask->table, order);
    fw_mask_order_plate_lines(out, "plate", mask->table, order);
    fw_mask_order_size_lines(out, order->width_m, order->space_m, order->unfinished, mask,
                             order->plate_index);
}

const char *fw_mask_order_gds(char text[FW_MASK_GDS_TEXT], const fw_mask_layer *layer) {
    snprintf(text, FW_MASK_GDS_TEXT, "%d/%d", layer->layer, layer->datatype);
    return text;
}

int fw_mask_order_gds_width(const fw_mask_table *table) {
    char gds[FW_MASK_GDS_TEXT];
    size_t most = 5;
    for (int k = 0; k < table->nlayer; k++) {
        size_t wide = strlen(fw_mask_order_gds(gds, &table->layer[k]));
        most = wide > most ? wide : most;
    }
    return (int)most;
}

static void layers(const fw_mask *mask, const fw_mask_order *order, fw_text *out) {
    int wide = fw_mask_order_gds_width(mask->table), name = 20;
    for (int k = 0; k < mask->table->nlayer; k++)
        if (strlen(mask->table->layer[k].name) > (size_t)name)
            name = (int)strlen(mask->table->layer[k].name);
    fw_text_printf(out, "\n%-*s  %-*s tone        on plate  polygons  vertices\n", wide, "layer",
                   name, "name");
    for (int k = 0; k < mask->table->nlayer; k++) {
        const fw_mask_layer *y = &mask->table->layer[k];
        int polygons, vertices;
        char gds[FW_MASK_GDS_TEXT];
        fw_mask_order_count(mask, k, &polygons, &vertices);
        fw_text_printf(out, "%-*s  %-*s %-11s %-9s %8d  %8d\n", wide, fw_mask_order_gds(gds, y),
                       name, y->name, y->documentation ? "-" : y->tone,
                       order->plate[k] ? "yes" : "no", polygons, vertices);
    }
}

void fw_mask_order_site_heading(fw_text *out, const char *where, int wide) {
    fw_text_printf(out, "site  %-*s  %-5s %12s %12s %8s %8s  what\n", wide, where, "kind", "x", "y",
                   "angle", "CD");
}

void fw_mask_order_site_row(fw_text *out, int number, const char *where, int wide,
                            const fw_mask_order_site *site, fw_geometry_vec2 at,
                            fw_geometry_vec2 along) {
    fw_text_printf(out, "%4d  %-*s  %-5s ", number, wide, where, site->space ? "space" : "width");
    fw_text_real(out, "%12.3f", at.x * 1e6);
    fw_text_real(out, " %12.3f", at.y * 1e6);
    fw_text_real(out, " %8.2f", atan2(along.y, along.x) * 180 / FW_PI);
    fw_text_real(out, " %8.3f", vec_length(along) * 1e6);
    fw_text_printf(out, "  %s\n", site->what);
}

static void sites(const fw_mask *mask, const fw_mask_order *order, fw_text *out) {
    int wide = fw_mask_order_gds_width(mask->table);
    fw_text_add(out, "\nCD sites: centre of the chord and its direction, um and degrees\n");
    fw_mask_order_site_heading(out, "layer", wide);
    for (int i = 0; i < order->nsite; i++) {
        const fw_mask_order_site *s = &order->site[i];
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        char gds[FW_MASK_GDS_TEXT];
        fw_mask_order_site_row(out, i + 1, fw_mask_order_gds(gds, &mask->table->layer[s->layer]),
                               wide, s, at, along);
    }
}

fw_status fw_mask_write_order_text(const fw_mask *mask, int plate, const fw_output_file *file,
                                   int nfile, fw_text *out) {
    fw_mask_order order;
    FW_TRY(fw_mask_order_gather(out->arena, mask, plate, &order));
    head(mask, &order, out);
    fw_mask_order_extent_line(out, mask->box);
    fw_text_printf(out, "%-22s %d, %d vertices, at most %d each\n", "polygons on the plate",
                   order.polygons, order.vertices, mask->vertex_limit);
    layers(mask, &order, out);
    sites(mask, &order, out);
    FW_TRY(fw_mask_wiring_order_text(mask, out));
    fw_mask_cells_order_text(mask, out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}
