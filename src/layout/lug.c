/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include "base/constants.h"
#include <math.h>

/* Tendon eyelets: open rings on short stems at the platform's edge. A closed eye would be a hole in
   the outline; the tendon is hooked in through the opening, which faces along the edge, across the
   pull. */
static const double eye = 40e-6, outer = 70e-6, stem = 50e-6, height = 64e-6;

/* local: origin on the edge, +y outwards, the eye opens towards +x */
static fw_status draw_lug(fw_drawing *d, const fw_local *local, fw_contour *lug) {
    fw_vec2 c = fw_v(0.0, height);
    double foot = -acos(stem / outer), from = -FW_PI / 12.0, to = from + FW_PI / 3.0;
    fw_vec2 right = fw_v(stem, height + outer * sin(foot)), left = fw_v(-stem, right.y);
    fw_sketch k = fw_sketch_start(d->arena, local, fw_v(-stem, -25e-6));
    fw_sketch_line(&k, fw_v(stem, -25e-6), 0);
    fw_sketch_line(&k, right, 0);
    fw_sketch_arc(&k, c, from - foot, fw_add(c, outer, fw_polar(from)));
    fw_sketch_line(&k, fw_add(c, eye, fw_polar(from)), 0);
    fw_sketch_arc(&k, c, -(2.0 * FW_PI - (to - from)), fw_add(c, eye, fw_polar(to)));
    fw_sketch_line(&k, fw_add(c, outer, fw_polar(to)), 0);
    fw_sketch_arc(&k, c, FW_PI - foot - to, left);
    return fw_sketch_close(&k, lug);
}

static bool has_room(const fw_drawing *d, fw_vec2 centre) {
    for (int j = 0; j < d->device->njoint; j++) {
        const fw_hinge_layout *h = &d->layout->hinge[j];
        if (fw_norm(fw_sub(centre, h->centre)) < h->keep_out_m + outer + 10e-6) return false;
    }
    return true;
}

/* None where tendons of the file say where the platform's eyelets are (eyelet.c). In pairs, as far
   as there is room beside the hinges, at most four: two on the edge that faces away from the
   mechanism, two on the opposite edge, two on the short edges. Mirrored places, so that two tendons
   of a pair pull evenly. */
fw_status fw_platform_lugs(fw_drawing *d, int body, double shift_m, fw_contour *lug, int *nlug) {
    const fw_body *b = &d->device->body[body];
    *nlug = 0;
    if (isnan(b->plate_width_m) || fw_eyelets_on(d, body)) return FW_OK;
    double w = 0.5 * b->plate_width_m, h = 0.5 * b->plate_height_m;
    fw_vec2 middle = fw_v(b->plate_x_m, b->plate_y_m);
    fw_vec2 x = fw_polar(b->plate_angle_rad), y = fw_left(x);
    if (fw_dot(fw_sub(d->centre, middle), y) > 0.0) { /* y away from the rest */
        x = fw_v(-x.x, -x.y);
        y = fw_v(-y.x, -y.y);
    }
    const struct {
        fw_vec2 edge, out; /* for the right lug of the pair */
    } place[] = {
        {{0.62 * w - shift_m, h}, {0.0, 1.0}},
        {{0.45 * w - shift_m, -h}, {0.0, -1.0}},
        {{w, h - stem - 30e-6 - shift_m}, {1.0, 0.0}},
    };
    for (size_t i = 0; i < sizeof place / sizeof place[0] && *nlug < 4; i++) {
        bool upright = place[i].out.x > 0.0;
        if (upright ? h < 2.0 * stem : 0.38 * w < stem || 0.45 * w - shift_m < outer + 15e-6)
            continue;
        fw_local local[2];
        bool room = true;
        for (int k = 0; k < 2; k++) {
            double sign = k == 0 ? -1.0 : 1.0;
            fw_vec2 at = fw_add(fw_add(middle, sign * place[i].edge.x, x), place[i].edge.y, y);
            fw_vec2 out = fw_add(fw_v(sign * place[i].out.x * x.x, sign * place[i].out.x * x.y),
                                 place[i].out.y, y);
            /* local y is `out`; local x, to which the eye opens, is towards the pair's middle, on
               the short edges towards -y */
            fw_vec2 open = upright ? fw_v(-y.x, -y.y) : fw_v(-sign * x.x, -sign * x.y);
            bool mirror = fw_dot(fw_left(open), out) < 0.0;
            local[k] = (fw_local){at, open.x, open.y, mirror};
            room = room && has_room(d, fw_add(at, height, out));
        }
        for (int k = 0; k < 2 && room; k++) {
            FW_TRY(draw_lug(d, &local[k], &lug[*nlug]));
            FW_NEED(d->lug = fw_arena_grow(d->arena, d->lug, (size_t)d->nlug, (size_t)d->nlug + 1,
                                           sizeof *d->lug));
            d->lug[d->nlug++] = lug[(*nlug)++];
        }
    }
    return FW_OK;
}
