/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order sheet of a plate of the layered file for people: ASCII, to be pasted into a shop's form. */
#include "geometry/segment.h"
#include "mask/mask.h"
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

const fw_wafer_site *fw_wafer_nearest_die(const fw_wafer *w, double x, double y,
                                          const fw_wafer_site *const *before, int n) {
    const fw_wafer_site *best = NULL;
    double least = HUGE_VAL;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        bool taken = s->kind != FW_WAFER_DIE;
        for (int k = 0; k < n; k++)
            taken = taken || before[k] == s;
        double away = hypot(s->x + 0.5 * w->grid.width - x, s->y + 0.5 * w->grid.height - y);
        if (taken || away >= least) continue;
        least = away;
        best = s;
    }
    return best;
}

/* ---- the whole plate ----
   Places to measure are those of the die nearest to the centre, in coordinates of the plate. */

static void lengths(fw_text *out, const char *what, double a_m, const char *between, double b_m) {
    char a[32], b[32], line[160];
    fw_number_text(a, sizeof a, a_m * 1e3, 9);
    fw_number_text(b, sizeof b, b_m * 1e3, 9);
    snprintf(line, sizeof line, "%s%s%s%s", a, between, b, " mm");
    fw_mask_order_line(out, what, line);
}

static void head(const fw_wafer *w, const fw_mask_order *order, fw_text *out) {
    if (w->rejecting) fw_mask_order_rejected(out, w->rejecting);
    bool several = fw_mask_plates(w->table) > 1;
    fw_text_printf(out, "Order sheet of plate %s-%s%s%s (flexwright " FW_VERSION ")\n\n", w->top,
                   w->flow, several ? "-" : "",
                   several ? fw_mask_plate_at(w->table, order->plate_index).id : "");
    fw_mask_order_line(out, "device", w->device->name);
    fw_mask_order_line(out, "title", w->title);
    fw_mask_order_line(out, "flow", w->flow);
    fw_mask_order_line(out, "top cell", w->top);
    lengths(out, "plate", w->form.plate_m, " mm x ", w->form.plate_m);
    lengths(out, "wafer", w->form.diameter_m, " mm, in the plate's middle; edge exclusion ",
            w->form.edge_m);
    fw_mask_order_set_lines(out, w->table, order);
    fw_mask_order_plate_lines(out, "layers on the plate", w->table, order);
}

static void content_of_layers(const fw_wafer *w, const fw_mask_order *order, const fw_mask *any,
                              const fw_wafer_sum *s, fw_text *out) {
    double width = HUGE_VAL, space = HUGE_VAL, polygons = 0, vertices = 0;
    bool unfinished = false;
    for (int k = 0; k < w->table->nlayer; k++) {
        if (!order->plate[k]) continue;
        width = fmin(width, s[k].width_m);
        space = fmin(space, s[k].space_m);
        unfinished = unfinished || s[k].unfinished;
        polygons += s[k].polygons;
        vertices += s[k].vertices;
    }
    fw_mask_order_size_lines(out, width, space, unfinished, any, order->plate_index);
    fw_mask_order_extent_line(out, fw_wafer_extent(w));
    fw_text_printf(out, "%-22s %d dies, %d alignment sites, %d test dies\n", "places", w->dies,
                   w->alignments, w->tests);
    fw_text_printf(out, "%-22s %d, %d references\n", "cells", w->ncell + 1, w->nrun);
    fw_text_printf(out, "%-22s ", "polygons, flat");
    fw_text_number(out, polygons, 15);
    fw_text_add(out, ", ");
    fw_text_number(out, vertices, 15);
    fw_text_add(out, " vertices\n");
}

static void sites_of_middle(const fw_wafer *w, const fw_mask_order *order, const fw_wafer_site *die,
                            fw_geometry_vec2 shift, fw_text *out) {
    char name[2 * FW_WAFER_NAME];
    int wide = fw_mask_order_gds_width(w->table);
    fw_text_printf(out,
                   "\nCD sites in die %s: centre of the chord from the plate's middle and its "
                   "direction, um and degrees\n",
                   fw_wafer_site_name(w, die, name));
    fw_mask_order_site_heading(out, "layer", wide);
    for (int i = 0; i < order->nsite; i++) {
        const fw_mask_order_site *s = &order->site[i];
        fw_geometry_vec2 along = vec_sub(s->to, s->from), at = vec_along(s->from, 0.5, along);
        char gds[FW_MASK_GDS_TEXT];
        fw_mask_order_site_row(out, i + 1, fw_mask_order_gds(gds, &w->table->layer[s->layer]), wide,
                               s, vec_add(at, shift), along);
    }
}

fw_status fw_wafer_write_order(const fw_wafer *w, int plate, const fw_output_file *file, int nfile,
                               fw_text *out) {
    const fw_wafer_site *die = fw_wafer_nearest_die(w, 0, 0, NULL, 0);
    if (!die) return FW_INTERNAL; /* test dies leave one */
    const fw_wafer_variant *v = &w->variant[die->variant];
    if (fw_wafer_stood_in(v)) v = &w->stand_in;
    fw_mask_order order;
    fw_wafer_sum *s;
    int32_t dx, dy;
    FW_TRY(fw_mask_order_gather(out->arena, v->mask, plate, &order));
    FW_TRY(fw_wafer_sums(w, out->arena, &s));
    fw_wafer_origin(&w->grid, v->die, &dx, &dy);
    head(w, &order, out);
    content_of_layers(w, &order, v->mask, s, out);
    sites_of_middle(w, &order, die, (fw_geometry_vec2){(die->x + dx) * 1e-9, (die->y + dy) * 1e-9},
                    out);
    fw_text_add(out, "\nfiles: sha256, bytes, name\n");
    for (int i = 0; i < nfile; i++)
        fw_text_printf(out, "%s  %zu  %s\n", file[i].sha256, file[i].size, file[i].name);
    return fw_text_end(out);
}
