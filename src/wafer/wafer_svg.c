/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plate as exact outlines: every cell once in <defs>, with true arcs, and <use> for each place.
   1 user unit = 1 um, y downwards, the plate's upper left corner is the origin. A <g> is used and
   not a <symbol>, which some importers clip at its own box. */
#include "base/svg.h"
#include "mask/mask_writers.h"
#include "wafer/wafer_parts.h"
#include <math.h>

/* layers in the order of the table; ids stay those of the table in the top cell only. The mask goes
   by the name of its cell here: steps of a sweep have the same name of their own, and ids of a
   document must differ */
static void layers(const fw_wafer *w, const fw_mask *of, const char *name,
                   fw_geometry_vec2 upper_left, bool top, fw_text *out) {
    fw_mask named = *of;
    const fw_mask *mask = &named;
    named.cell = name;
    for (int k = 0; k < w->table->nlayer; k++) {
        const fw_mask_layer *y = &w->table->layer[k];
        bool any = false;
        for (int i = 0; i < mask->nshape && !any; i++)
            any = mask->shape[i].layer == k;
        if (!any) continue;
        if (top)
            fw_svg_open(out, "g id='{r}' data-gds='{i}/{i}' fill='{r}' fill-opacity='0.8'\n", y->id,
                        y->layer, y->datatype, y->colour);
        else
            fw_svg_open(out, "g data-gds='{i}/{i}' fill='{r}' fill-opacity='0.8'\n", y->layer,
                        y->datatype, y->colour);
        fw_mask_svg_paths(mask, k, upper_left, out);
        fw_svg_close(out, "g\n");
    }
}

static void head(const fw_wafer *w, fw_text *out) {
    double size = w->form.plate_m * 1e6;
    fw_svg_begin(out, &(fw_svg_frame){.width = size,
                                      .height = size,
                                      .decimals = 6,
                                      .size = FW_SVG_SIZE_BEFORE,
                                      .unit_mm = 1e-3,
                                      .mm_decimals = 9,
                                      .file = true,
                                      .links = true,
                                      .lead = "version='1.1'"});
    fw_svg_title(out, "{r}{s}, {s}, whole plate", w->rejected ? "REJECTED: " : "", w->title,
                 w->flow);
    fw_svg_put(out, "desc>1 unit = 1 um; {s}; flexwright " FW_VERSION "\n", w->table->reading);
}

static void use(const fw_wafer *w, const fw_wafer_run *r, double half_um, fw_text *out) {
    for (int j = 0; j < r->rows; j++)
        for (int i = 0; i < r->columns; i++)
            fw_svg_put(out, "use xlink:href='#{r}' x='{3}' y='{3}'\n", w->cell[r->cell].name,
                       half_um + 1e-3 * (r->x + i * r->step_x),
                       half_um - 1e-3 * (r->y + j * r->step_y));
}

static size_t expected_bytes(const fw_wafer *w) {
    size_t n = 16384;
    for (int c = 0; c < w->ncell; c++) {
        n += 96 * (size_t)w->cell[c].placed;
        for (int i = 0; i < w->cell[c].mask->nshape; i++)
            n += 100 + 90 * (size_t)w->cell[c].mask->shape[i].contour.count;
    }
    return n;
}

fw_status fw_wafer_write_svg(const fw_wafer *w, fw_text *out) {
    double half_um = 0.5 * w->form.plate_m * 1e6;
    fw_text_reserve(out, expected_bytes(w));
    head(w, out);
    fw_svg_open(out, "defs\n");
    for (int c = 0; c < w->ncell; c++) {
        fw_svg_open(out, "g id='{r}'\n", w->cell[c].name);
        layers(w, w->cell[c].mask, w->cell[c].name, (fw_geometry_vec2){0, 0}, false, out);
        fw_svg_close(out, "g\n");
    }
    fw_svg_close(out, "defs\n");
    if (w->plate)
        layers(w, w->plate, w->top,
               (fw_geometry_vec2){-0.5 * w->form.plate_m, 0.5 * w->form.plate_m}, true, out);
    for (int i = 0; i < w->nrun; i++)
        use(w, &w->run[i], half_um, out);
    if (w->rejected)
        fw_svg_put(out, "text id='rejected' x='50%' y='50%' text-anchor='middle' "
                        "font-family='sans-serif' font-size='15000' fill='#c00000' "
                        "fill-opacity='0.6'>REJECTED\n");
    fw_svg_end(out);
    return fw_text_end(out);
}
