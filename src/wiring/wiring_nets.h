/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of the room. */
#ifndef FW_WIRING_WIRING_NETS_H
#define FW_WIRING_WIRING_NETS_H
#include "wiring/wiring.h"

/* Which pieces hang together: part[i] is the lowest index of a piece of the same conductor, -1: no conductor.
   contour: of each piece, count 0: not there. Joined are pieces with a common cut, and, where `touching`, those
   whose outlines meet. */
fw_status fw_wiring_parts(fw_arena *arena, const fw_layout *layout,
                          const fw_geometry_contour *contour, bool islands, bool touching,
                          int *part);
bool fw_wiring_conducts(const fw_layout_piece *piece, bool islands);
/* do two outlines share a JOINT? */
bool fw_wiring_share_cut(const fw_geometry_contour *p, const fw_geometry_contour *q);
/* the least distance of two parts, and where, but for tethers and the bodies that they hold; HUGE_VAL: one is not
   there. boxes: (npiece) */
typedef struct fw_wiring_near {
    double m;
    fw_geometry_vec2 at[2];
    int piece[2];
} fw_wiring_near;
fw_wiring_near fw_wiring_least(const fw_layout *layout, const fw_geometry_contour *contour,
                               const fw_geometry_box *box, const int *part, int a, int b);

/* drives, what they ask of the nets, pads (wiring_drives.c) */
fw_status fw_wiring_drives(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                           const fw_wiring_asked *asked, fw_wiring *w);
/* gaps, fields, and what there is to say of them (wiring_gaps.c) */
fw_status fw_wiring_gaps(fw_arena *arena, const fw_layout *layout, const fw_wiring_asked *asked,
                         fw_wiring *w);

/* adds a sentence to a list with room for it; NULL: FW_NOMEM */
fw_status fw_wiring_say(fw_arena *arena, const char ***list, int *n, const char *sentence);
static inline bool fw_wiring_is_driven(const fw_wiring_net *net) {
    return net->low_V < 0.0 || net->high_V > 0.0;
}

#endif
