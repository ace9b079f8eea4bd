/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/tessellate.h"
#include "wafer/wafer_notes.h"
#include <math.h>

static void add_mask(const fw_mask *mask, double times, fw_wafer_sum *s) {
    for (int i = 0; i < mask->nshape; i++) {
        const fw_mask_shape *x = &mask->shape[i];
        fw_wafer_sum *of = &s[x->layer];
        double vertices = x->npart == 0 ? x->polygon.count : 0;
        for (int k = 0; k < x->npart; k++)
            vertices += x->part[k].count;
        of->polygons += times * (x->npart == 0 ? 1 : x->npart);
        of->vertices += times * vertices;
        of->area_m2 += times * 0.5e-18 * (double)fw_geometry_polygon_area2(&x->polygon);
    }
    for (int k = 0; k < mask->table->nlayer; k++) {
        s[k].width_m = fmin(s[k].width_m, mask->measure[k].width_m);
        s[k].space_m = fmin(s[k].space_m, mask->measure[k].space_m);
    }
}

fw_status fw_wafer_sums(const fw_wafer *w, fw_arena *arena, fw_wafer_sum **out) {
    fw_wafer_sum *s = fw_arena_array(arena, fw_wafer_sum, (size_t)w->table->nlayer);
    FW_NEED(s);
    for (int k = 0; k < w->table->nlayer; k++)
        s[k].width_m = s[k].space_m = HUGE_VAL;
    for (int c = 0; c < w->ncell; c++)
        add_mask(w->cell[c].mask, w->cell[c].placed, s);
    if (w->plate) add_mask(w->plate, 1, s);
    *out = s;
    return FW_OK;
}

fw_geometry_box fw_wafer_extent(const fw_wafer *w) {
    if (w->plate) return w->plate->box;
    fw_geometry_box b = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < w->grid.nsite; i++) {
        double x = w->grid.site[i].x * 1e-9, y = w->grid.site[i].y * 1e-9;
        b = (fw_geometry_box){fmin(b.x0, x), fmin(b.y0, y), fmax(b.x1, x + w->grid.width * 1e-9),
                              fmax(b.y1, y + w->grid.height * 1e-9)};
    }
    return b;
}
