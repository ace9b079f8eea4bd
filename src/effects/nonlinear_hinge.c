/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures as they are instead of pins: the element is in hinge_element.c, the law in
   flexure/finite.c, the bound in hinge_give.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->nhinge; i++)
        if (fw_effects_hinge_flexes(c, i)) return true;
    return false;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->nhinge; i++)
        n += fw_effects_hinge_flexes(c, i);
    return n;
}

/* What ideal pins in place of the hinges change in the peaks: hinge_give.c. Where surfaces may
   touch the hinge must be able to give. Test: test_hinge_give.c, test_hinge_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const char *why;
    *value = (double)INFINITY;
    *reason = "conjugate surfaces may touch, which needs the hinge to give: kept";
    if (c->scene->ncontact > 0 && fw_effects_contact_may_touch(c)) return FW_OK;
    FW_TRY(fw_effects_hinge_give_bound(c, value, &why));
    *reason = "flexures give and drift: peaks of the linear motion with pins and with hinges that "
              "give, and what the hinges do besides";
    if (why)
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "flexures give and drift, and nothing bounds what that does: kept (%s)", why));
    return FW_OK;
}

const fw_effect_row fw_effect_nonlinear_hinge = {
    .id = "nonlinear-hinge",
    .summary = "what flexures do besides turning: their axis drifts, forces displace it",
    .called_for = called_for,
    .bound = bound,
    .add = fw_effects_hinges_flex,
    .adds_blindly = true,
    .cost = 2900,
    .count = count,
    .solid = FW_EFFECTS_SOLID_HAS};
