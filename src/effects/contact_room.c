/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which gaps the motion can close at all: hinges by the give and drift of W (hinge_give.c), points
   by the reach of their bodies. Inputs SI from the envelope. Test:
   test_hinge_give.c, test_contact.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include <math.h>

const fw_mechanism_hinge *fw_effects_contact_hinge(const fw_mechanism *m,
                                                   const fw_device_contact_use *use) {
    if (use->joint < 0 || use->joint >= m->npin || m->pin[use->joint].hinge == FW_NONE) return NULL;
    return &m->hinge[m->pin[use->joint].hinge];
}

double fw_effects_contact_gap(const fw_effect_case *c, const fw_device_contact_use *use,
                              const fw_mechanism_hinge *h) {
    if (!isnan(use->distance_m)) return use->distance_m;
    const fw_device *d = c->mechanism->device;
    bool drawn = h->surface_radius_m > 0 && d && h->flexure >= 0 && h->flexure < d->nflexure;
    return drawn ? d->flexure[h->flexure].gap_m : 0;
}

/* as far as a point of a body can move, m */
static double reach_of(const fw_effect_case *c, int body, double x, double y) {
    if (body == FW_GROUND) return 0;
    const double *r = c->envelope->reach + 3 * body;
    return hypot(r[0], r[1]) + r[2] * hypot(x, y);
}

/* the least overlap that is still open: distance left, less what the motion can take of it */
static double room(const fw_effect_case *c, const fw_device_contact_use *use) {
    const fw_mechanism *m = c->mechanism;
    if (use->joint != FW_NONE) {
        const fw_mechanism_hinge *h = fw_effects_contact_hinge(m, use);
        if (!h) return -1;
        /* the surfaces' centres move against each other as the hinge turns about W beside them */
        double turn =
            c->envelope->angle[use->joint] + fabs(fw_effects_pin_deflection(m, use->joint));
        return fw_effects_contact_gap(c, use, h) - fw_effects_hinge_give_most(c, use->joint) -
               turn * hypot(h->off_a_m.x, h->off_a_m.y);
    }
    fw_geometry_vec2 a = fw_mechanism_local_place(m, use->body_a, use->ax_m, use->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, use->body_b, use->bx_m, use->by_m);
    double now = hypot(b.x - a.x, b.y - a.y), moves = 0;
    moves += reach_of(c, use->body_a, use->ax_m, use->ay_m);
    moves += reach_of(c, use->body_b, use->bx_m, use->by_m);
    return (use->side == FW_CONTACT_INSIDE ? use->distance_m - now : now - use->distance_m) - moves;
}

bool fw_effects_contact_may_touch(const fw_effect_case *c) {
    bool known = c->envelope->valid;
    for (int i = 0; i < c->mechanism->nhinge; i++) /* hinges that give and are not in it */
        known = known && (!fw_effects_hinge_flexes(c, i) || c->envelope->pinned);
    for (int i = 0; i < c->scene->ncontact; i++)
        if (!known || !(room(c, &c->scene->contact[i]) > 0)) return true;
    return false;
}
