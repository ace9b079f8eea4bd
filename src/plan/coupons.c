/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The test die of a flow, as large as the device's. What keeps it from being drawn never keeps the
   device's own mask. */
#include "plan/stages.h"

fw_status fw_plan_coupons(fw_plan *plan, fw_plan_flow *pf) {
    const fw_device *device = plan->device;
    fw_mask_coupon_options options = {.die = plan->layout->die,
                                      .frame_m = device->die.frame_m,
                                      .lane_m = device->die.lane_m,
                                      .mask = {.bias_m = pf->mask->bias_m,
                                               .tolerance_m = pf->mask->tolerance_m,
                                               .vertex_limit = pf->mask->vertex_limit,
                                               .flattening = pf->mask->flattening,
                                               .thickness_m = pf->mask->thickness_m,
                                               .rejected = pf->mask->rejected,
                                               .note = pf->mask->note,
                                               .nnote = pf->mask->nnote}};
    fw_diags said = fw_diags_new(plan->arena);
    fw_status status = fw_mask_coupons_build(plan->arena, pf->table, &options, &said, &pf->coupons);
    if (status == FW_NOMEM || said.failed) return FW_NOMEM;
    size_t left_out = said.count;
    if (status != FW_OK) {
        fw_diag_note(&plan->diags, 188, (fw_place){.file = device->file},
                     "there is no test die for flow %s: %s", pf->use->ref,
                     said.count ? said.item[0].message : fw_status_text(status));
        pf->coupons = NULL;
        return FW_OK;
    }
    if (!pf->coupons) return FW_OK;
    if (left_out > 0)
        fw_diag_note(&plan->diags, 186, said.item[0].place,
                     "%zu of %d test patterns of flow %s find no room on a die of this size; "
                     "masks/%s-coupons.json says which",
                     left_out, pf->coupons->content->ncoupon, pf->use->ref, pf->use->ref);
    pf->coupons_gds = fw_text_new(plan->arena);
    FW_TRY(fw_mask_write_gds(pf->coupons->mask, &pf->coupons_gds));
    return fw_plan_hash(plan, &pf->coupons_gds, &pf->coupons_sha256);
}
