/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures as they are instead of pins: the element is in hinge_element.c, the law in
   flexure/finite.c, the bound in hinge_give.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

/* where the file states the stiffness its law holds, unless the surfaces can touch: that needs the
   hinge to give */
static bool wanted(const fw_effect_case *c, int hinge) {
    const fw_hinge *h = &c->mechanism->hinge[hinge];
    return fw_hinge_is_known(h) && (!h->stated || fw_hinge_touches(c->scene, h->pin));
}

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->nhinge; i++)
        if (wanted(c, i)) return true;
    return false;
}

static fw_status add(const fw_effect_case *c, fw_terms *terms) {
    for (int i = 0; i < c->mechanism->nhinge; i++)
        if (wanted(c, i)) FW_TRY(fw_hinge_release(c, terms, i));
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->nhinge; i++)
        n += wanted(c, i);
    return n;
}

/* further rotation over the floor, and what a softer mechanism does to the motion: hinge_give.c.
   Where surfaces may touch the hinge must be able to give. Test: test_hinge_give.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    fw_hinge_give give;
    *value = (double)INFINITY;
    FW_TRY(fw_hinge_give_find(c, &give));
    *reason = give.why_not;
    if (give.why_not) return FW_OK;
    *reason = "conjugate surfaces may touch, which needs the hinge to give: kept";
    if (fw_contact_may_touch(c, &give)) return FW_OK;
    *value = fw_envelope_stiffness(c, give.softening) + give.turned_rad / c->envelope->floor;
    *reason = "bound: what hinges that give and drift add to the rotations, and take from the "
              "stiffness";
    return FW_OK;
}

const fw_effect_row fw_effect_nonlinear_hinge = {
    .id = "nonlinear-hinge",
    .summary = "what flexures do besides turning: their axis drifts, forces displace it",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 2630,
    .count = count};
