/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which layers make the plate: "1/0 NOT 2/0 NOT 3/0". */
#include "mask/mask.h"
#include "geometry/segment.h"
#include "mask/mask_polygons.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int layer_named(const fw_mask_table *table, const char *s, char **end) {
    if (*s < '0' || *s > '9') return -1;
    long layer = strtol(s, end, 10), datatype = -1;
    if (**end != '/' || (*end)[1] < '0' || (*end)[1] > '9') return -1;
    datatype = strtol(*end + 1, end, 10);
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].layer == layer && table->layer[k].datatype == datatype) return k;
    return -1;
}

/* behind "AND " and so on, or NULL */
static const char *behind_operator(const char *s) {
    static const char *const word[] = {" AND ", " OR ", " NOT ", " XOR "};
    for (int i = 0; i < 4; i++)
        if (strncmp(s, word[i], strlen(word[i])) == 0) return s + strlen(word[i]);
    return NULL;
}

bool fw_mask_plate_layers(const fw_mask_table *table, const char *layers, bool *named, int *first,
                          const char **wrong) {
    const char *s = layers;
    *first = -1;
    while (s) {
        char *end;
        int k = layer_named(table, s, &end);
        *wrong = s;
        if (k < 0) return false;
        if (*first < 0) *first = k;
        if (named) named[k] = true;
        s = *end ? behind_operator(end) : NULL;
        *wrong = end;
        if (*end && !s) return false;
    }
    return true;
}

bool fw_mask_plate_draws(const fw_mask_table *table, int plate, int layer) {
    for (const char *s = fw_mask_plate_at(table, plate).layers; s;) {
        char *end;
        int k = layer_named(table, s, &end);
        if (k < 0 || k == layer) return k == layer;
        s = *end ? behind_operator(end) : NULL;
    }
    return false;
}

/* the operator before `s` */
static fw_geometry_set_rule rule_before(const char *s) {
    static const struct {
        const char *word;
        fw_geometry_set_rule rule;
    } known[] = {{" AND ", FW_SET_AND}, {" NOT ", FW_SET_NOT}, {" XOR ", FW_SET_XOR}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(s - strlen(known[i].word), known[i].word, strlen(known[i].word)) == 0)
            return known[i].rule;
    return FW_SET_OR;
}

fw_status fw_mask_plate_terms(fw_arena *arena, const fw_mask_table *table,
                              fw_mask_plate_term **term, int *n) {
    return fw_mask_plate_terms_of(arena, table, table->device_plate, term, n);
}

fw_status fw_mask_plate_terms_of(fw_arena *arena, const fw_mask_table *table, int plate,
                                 fw_mask_plate_term **term, int *n) {
    const char *layers = fw_mask_plate_at(table, plate).layers;
    *n = 0;
    size_t most = layers ? strlen(layers) / 3 + 1 : (size_t)table->nlayer;
    FW_NEED(*term = fw_arena_array(arena, fw_mask_plate_term, most));
    for (int k = 0; !layers && k < table->nlayer; k++)
        if (table->layer[k].biased) (*term)[(*n)++] = (fw_mask_plate_term){k, FW_SET_OR};
    for (const char *s = layers; s;) {
        char *end;
        int k = layer_named(table, s, &end);
        if (k < 0) return FW_INPUT; /* cannot be: the table was read */
        (*term)[(*n)++] = (fw_mask_plate_term){k, s == layers ? FW_SET_OR : rule_before(s)};
        s = *end ? behind_operator(end) : NULL;
    }
    return FW_OK;
}

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

static fw_status order_sites(fw_arena *arena, const fw_mask *mask, fw_mask_order *order) {
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
        order->plate[k] = table->layer[k].roles != 0;
    if (first >= 0) {
        order->tone = table->layer[first].tone;
        order->field = strcmp(order->tone, "data dark") == 0 ? "clear" : "dark";
    }
    order->mirror = mirrored(row->reading);
    for (int k = 0; k < table->nlayer; k++) {
        if (!order->plate[k]) continue;
        int polygons, vertices;
        fw_mask_order_count(mask, k, &polygons, &vertices);
        order->polygons += polygons;
        order->vertices += vertices;
        order->width_m = fmin(order->width_m, mask->measure[k].width_m);
        order->space_m = fmin(order->space_m, mask->measure[k].space_m);
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

static void least_line(fw_text *out, const char *what, double value_m) {
    bool there = isfinite(value_m);
    char number[32], line[64];
    fw_number_text(number, sizeof number, (there ? value_m : FW_MASK_LOOK_M) * 1e6, 7);
    snprintf(line, sizeof line, "%s%s um", there ? "" : "none below ", number);
    fw_mask_order_line(out, what, line);
}

void fw_mask_order_size_lines(fw_text *out, double width_m, double space_m, const fw_mask *mask) {
    char line[200], number[32];
    least_line(out, "least feature", width_m);
    least_line(out, "least space", space_m);
    snprintf(line, sizeof line, "%s um per edge, in the data already; mask CD bias 0",
             fw_number_text(number, sizeof number, mask->bias_m * 1e6, 6));
    fw_mask_order_line(out, "process bias", line);
    snprintf(line, sizeof line, "1 nm; arcs within %s nm",
             fw_number_text(number, sizeof number, mask->tolerance_m * 1e9, 6));
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
    fw_mask_order_size_lines(out, order->width_m, order->space_m, mask);
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
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}
