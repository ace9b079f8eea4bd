/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a drawing stands as a wall, and where such walls are made. */
#include "layout/layout.h"
#include <math.h>

bool fw_layout_is_wall(const fw_layout_piece *p) {
    switch (p->role) {
    case FW_ROLE_STRUCTURE:
    case FW_ROLE_FRAME:
    case FW_ROLE_TETHER:
        return p->body >= 0 || p->body == FW_GROUND || p->body == FW_ISLAND;
    case FW_ROLE_FLEXURE: /* bends: a thing of its own */
    case FW_ROLE_TEXT:
    case FW_ROLE_MARK:
    case FW_ROLE_DICING:
    case FW_ROLE_BACK:
    case FW_ROLE_CAVITY: /* of the carrier */
    case FW_ROLE_LAND:
    case FW_ROLE_METAL:
    case FW_ROLE_COUNT:
        break;
    }
    return false;
}

bool fw_layout_has_outline(const fw_layout *layout, int body) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (fw_layout_is_wall(p) && (body < 0 ? p->body < 0 : p->body == body)) return true;
    }
    return false;
}

double fw_layout_walls_m(const fw_layout *layout) {
    return 2 * layout->edge_m + fabs(layout->flare_m);
}
