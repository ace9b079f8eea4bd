/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/outlines.h"
#include <math.h>

/* The mask's contour moved by edge - bias: what the mask added, less what the flow took. Edge and
   bias m outside the drawn edge. NaN: not asked for. Test: test_outlines.c, identity. */
static fw_status fabricated(fw_arena *arena, const fw_mask *mask, const fw_mask_shape *s,
                            double edge_m, fw_geometry_contour *out, int *gone) {
    double d = edge_m - mask->bias_m;
    int i, j;
    *out = (fw_geometry_contour){0};
    if (isnan(d)) return FW_OK;
    if (d == 0.0) {
        *out = s->contour;
        return FW_OK;
    }
    fw_status status = fw_geometry_contour_offset(arena, &s->contour, d, out, &i, &j);
    if (status != FW_GEOMETRY) return status;
    *out = (fw_geometry_contour){0};
    ++*gone;
    return FW_OK;
}

fw_status fw_mask_outlines_of(fw_arena *arena, const fw_mask *mask, fw_mask_outlines *out) {
    *out = (fw_mask_outlines){0};
    const fw_mask_edges *e = mask->edges;
    if (!e) return FW_OK;
    FW_NEED(out->outline = fw_arena_array(arena, fw_mask_outline, (size_t)mask->nshape));
    int most = 0; /* gone at the best end is gone at the worst one too */
    for (int k = 0; k < mask->nshape; k++) {
        const fw_mask_shape *s = &mask->shape[k];
        if (!mask->table->layer[s->layer].biased) continue;
        fw_mask_outline *o = &out->outline[out->n++];
        o->shape = s;
        FW_TRY(fabricated(arena, mask, s, e->top_m, &o->top, &out->gone_top));
        FW_TRY(fabricated(arena, mask, s, e->bottom_m, &o->bottom, &out->gone_bottom));
        FW_TRY(fabricated(arena, mask, s, e->least_m, &o->least, &out->gone_least));
        FW_TRY(fabricated(arena, mask, s, e->most_m, &o->most, &most));
    }
    return FW_OK;
}
