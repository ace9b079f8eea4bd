/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A straight strip of stated length. */
#include "device/flexure_kind.h"

static fw_status build(fw_device_reader *r, int at, fw_device_flexure *f) {
    const fw_xml_record *record = &r->xml.record[at];
    char label[FW_LABEL];
    f->kind = FW_FLEXURE_LEAF;
    if (!f->length_given)
        fw_diag_error(r->diags, 58, record->element->place, "%s: a leaf needs its length",
                      fw_xml_label(record, label));
    fw_device_flexure_slender(r, record, f);
    fw_device_flexure_middle(r, record, f);
    return FW_OK;
}

static const char *const takes[] = {"length", "width-middle", NULL};
const fw_device_flexure_row fw_device_flexure_leaf = {
    .name = "leaf",
    .takes = takes,
    .refused = {58, "a leaf is straight and has no ", "; remove it or write kind=\"csfh\""},
    .build = build};
