/* SPDX-License-Identifier: GPL-3.0-or-later */
/* KLayout layer properties: colours and names of the table. */
#include "mask/mask.h"

static void layer(fw_text *out, const fw_mask *mask, const fw_mask_layer *y) {
    fw_text_printf(out,
                   " <properties>\n"
                   "  <frame-color>%s</frame-color>\n"
                   "  <fill-color>%s</fill-color>\n"
                   "  <frame-brightness>-40</frame-brightness>\n"
                   "  <fill-brightness>0</fill-brightness>\n"
                   "  <dither-pattern>I0</dither-pattern>\n"
                   "  <line-style/>\n"
                   "  <valid>true</valid>\n"
                   "  <visible>true</visible>\n"
                   "  <transparent>%s</transparent>\n"
                   "  <width>1</width>\n"
                   "  <marked>false</marked>\n"
                   "  <xfill>false</xfill>\n"
                   "  <animation>0</animation>\n"
                   "  <name>%s",
                   y->colour, y->colour, y->documentation ? "true" : "false",
                   mask->rejected ? "REJECTED " : "");
    fw_text_escaped(out, y->name);
    fw_text_printf(out, ", %s (%d/%d)</name>\n  <source>%d/%d@1</source>\n </properties>\n",
                   y->tone, y->layer, y->datatype, y->layer, y->datatype);
}

fw_status fw_mask_write_lyp(const fw_mask *mask, fw_text *out) {
    fw_text_add(out, "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<layer-properties>\n");
    for (int k = 0; k < mask->table->nlayer; k++)
        layer(out, mask, &mask->table->layer[k]);
    fw_text_add(out, " <name/>\n</layer-properties>\n");
    return fw_text_end(out);
}
