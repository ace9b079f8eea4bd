/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the first place that is free and the last: what each body hangs on when it lets go, and the
   anchors of each mechanism. Reaches are as drawn: the foot of the walls comes to them. */
#ifndef FW_RELEASE_RELEASE_HOLD_H
#define FW_RELEASE_RELEASE_HOLD_H
#include "release/release.h"

typedef struct fw_release_body_hold {
    int body, group;
    const char *label;
    double free_m;   /* nothing of it is bonded any more */
    const char **by; /* (nby) what it then hangs on: bonded parts, bases at hinges, tethers */
    int nby;
    int holders; /* of them, each tether counted: 1: its last anchor; 0: it floats */
} fw_release_body_hold;

typedef struct fw_release_group_hold { /* bodies that flexures join */
    double hangs_m;        /* from here on nothing of it is bonded: it hangs on its anchors alone */
    const char *last_bond; /* that let go then */
    const char *at;        /* "hinge A, hinge F": to bases; "": none */
    int ground_hinges, tethers;
    /* of base and frame what keeps a bond longest, and how long; NULL, NaN: it has no anchor */
    const char *last_anchor;
    double last_anchor_m;
} fw_release_group_hold;

typedef struct fw_release_hold {
    fw_release_body_hold *body; /* (nbody) in the order in which they let go */
    int nbody;
    fw_release_group_hold *group; /* (ngroup) */
    int ngroup;
} fw_release_hold;

fw_status fw_release_hold_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               const fw_release *release, const fw_release_hold **out);

#endif
