/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a place of a mask that cannot be drawn belongs to: mostly a hinge whose two heads were given
   no room, and then neither bias nor tolerance is what to change. Test: test_causes.c. */
#include "mask/mask_polygons.h"
#include "base/constants.h"
#include "base/text.h"
#include <math.h>

/* of a hinge's keep-out disc: necks and root blocks reach a little beyond it */
static const double REACH = 1.25;

static const fw_layout_hinge_layout *hinge_at(const fw_layout *layout, int nhinge,
                                              fw_geometry_vec2 at) {
    const fw_layout_hinge_layout *best = NULL;
    double least = 1;
    for (int j = 0; j < nhinge; j++) {
        const fw_layout_hinge_layout *h = &layout->hinge[j];
        if (!h->drawn || !(h->keep_out_m > 0)) continue;
        double share = vec_distance(h->centre, at) / (REACH * h->keep_out_m);
        if (share < least) least = share, best = h;
    }
    return best;
}

/* the highest joint that a piece belongs to: others are not drawn */
static int hinges_of(const fw_layout *layout) {
    int n = 0;
    for (int i = 0; i < layout->npiece; i++)
        n = layout->piece[i].joint >= n ? layout->piece[i].joint + 1 : n;
    return n;
}

const char *fw_mask_cause(fw_arena *arena, const fw_layout *layout, fw_geometry_vec2 at) {
    if (!isfinite(at.x + at.y)) return "";
    const fw_layout_hinge_layout *h = hinge_at(layout, hinges_of(layout), at);
    if (!h || !h->id) return "";
    char axis[32];
    fw_number_text(axis, sizeof axis, h->axis_rad * 180 / FW_PI, 6);
    return h->axis_stated
               ? fw_arena_printf(
                     arena,
                     "; the place belongs to hinge %s, whose flexure bulges towards %s "
                     "deg because the file says so: its two sides have no room for each "
                     "other there, so turn its axis, or leave axis out to have one "
                     "chosen",
                     h->id, axis)
               : fw_arena_printf(arena,
                                 "; the place belongs to hinge %s, whose flexure bulges towards %s "
                                 "deg: state another axis for it, or move what is beside it",
                                 h->id, axis);
}
