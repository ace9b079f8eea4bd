/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions about a description. */
#include "device/device_reader.h"
#include <math.h>
#include <string.h>

bool fw_device_in_flow(const char *asked, const char *flow) {
    return !asked || (flow && strcmp(asked, flow) == 0);
}

bool fw_device_needs_shapes(const fw_device *device) {
    for (int i = 0; i < device->nbody; i++) {
        const fw_device_body *b = &device->body[i];
        if (isnan(b->mass_kg) || isnan(b->inertia_kg_m2) || isnan(b->x_m) || isnan(b->y_m))
            return true;
    }
    return false;
}

int fw_device_flexure_pieces(const fw_device_flexure *f, fw_geometry_strip_piece *piece) {
    if (f->kind == FW_FLEXURE_PATH) {
        for (int i = 0; i < f->npiece; i++)
            piece[i] = f->piece[i];
        return f->npiece;
    }
    double t = f->width_m, middle = f->width_middle_m > 0 ? f->width_middle_m : t;
    *piece = (fw_geometry_strip_piece){.length_m = f->length_m,
                                       .curvature_per_m =
                                           f->kind == FW_FLEXURE_CSFH ? 1 / f->radius_m : 0,
                                       .width_m = {t, middle, t}};
    return 1;
}

bool fw_device_flexure_varies(const fw_device_flexure *f) {
    return f->kind == FW_FLEXURE_PATH || (f->width_middle_m > 0 && f->width_middle_m != f->width_m);
}

double fw_device_flexure_narrowest_m(const fw_device_flexure *f) {
    return f->width_middle_m > 0 && f->width_middle_m < f->width_m ? f->width_middle_m : f->width_m;
}

bool fw_device_body_drawn(const fw_device_body *body) {
    return !isnan(body->width_m) || !isnan(body->plate_width_m) || body->nshape > 0;
}
