/* SPDX-License-Identifier: GPL-3.0-or-later */
/* KLayout layer properties: colours and names of the table. */
#include "mask/mask.h"
#include "mask/mask_parts.h"
#include <string.h>

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

/* KLayout technology: grid, the layer properties file beside it, how to read DXF so that its layers
   get the numbers of GDSII and arcs the mask's tolerance, and how to write what every reader takes.
   Members as KLayout 0.28 writes them; what is not said keeps its default. */

/* KLayout takes letters, digits and _ as they are, a letter first; other names in quotes */
static bool is_plain(const char *name) {
    bool letter = *name == '_' || (*name >= 'A' && *name <= 'Z') || (*name >= 'a' && *name <= 'z');
    return letter && !strchr(name, '-');
}

static fw_status layer_map(const fw_mask *mask, fw_text *out) {
    fw_text_add(out, "   <layer-map>layer_map(");
    bool some = false;
    for (int k = 0; k < mask->table->nlayer; k++) {
        const fw_mask_layer *y = &mask->table->layer[k];
        if (!y->roles) continue;
        const char *name = fw_mask_dxf_layer(out->arena, mask, k); /* nothing to be escaped in it */
        FW_NEED(name);
        const char *quote = is_plain(name) ? "" : "\\'";
        fw_text_printf(out, "%s'%s%s%s : %d/%d'", some ? ";" : "", quote, name, quote, y->layer,
                       y->datatype);
        some = true;
    }
    fw_text_add(out, ")</layer-map>\n");
    return FW_OK;
}

fw_status fw_mask_write_lyt(const fw_mask *mask, fw_text *out) {
    fw_text_add(out,
                "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<technology>\n <name>flexwright-");
    fw_text_escaped(out, mask->flow);
    fw_text_printf(out, "</name>\n <description>%s", mask->rejected ? "REJECTED: " : "");
    fw_text_escaped(out, mask->table->order ? mask->table->order : mask->table->reading);
    fw_text_add(out, "</description>\n <group>flexwright</group>\n <dbu>0.001</dbu>\n"
                     " <layer-properties_file>");
    fw_text_escaped(out, mask->flow);
    fw_text_add(out, ".lyp</layer-properties_file>\n"
                     " <add-other-layers>true</add-other-layers>\n"
                     " <reader-options>\n"
                     "  <dxf>\n"
                     "   <dbu>0.001</dbu>\n"
                     "   <unit>1</unit>\n"
                     "   <circle-points>1000000</circle-points>\n"
                     "   <circle-accuracy>");
    fw_text_number(out, mask->tolerance_m * 1e6, 9);
    fw_text_add(out, "</circle-accuracy>\n   <polyline-mode>2</polyline-mode>\n");
    FW_TRY(layer_map(mask, out));
    fw_text_add(out, "  </dxf>\n"
                     " </reader-options>\n"
                     " <writer-options>\n"
                     "  <gds2>\n"
                     "   <write-timestamps>false</write-timestamps>\n"
                     "   <multi-xy-records>false</multi-xy-records>\n"
                     "   <max-vertex-count>4000</max-vertex-count>\n"
                     "   <max-cellname-length>32</max-cellname-length>\n"
                     "   <libname>FLEXWRIGHT</libname>\n"
                     "  </gds2>\n"
                     " </writer-options>\n"
                     "</technology>\n");
    return fw_text_end(out);
}
