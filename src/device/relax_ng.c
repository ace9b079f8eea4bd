/* SPDX-License-Identifier: GPL-3.0-or-later */
/* docs/reference/device.rng, for editors and xmllint; the program itself does not use it. */
#include "base/text.h"
#include "device/reader.h"
#include <string.h>

static void add_pattern(fw_text *out, const char *pattern) {
    fw_text_printf(out, "<data type=\"string\"><param name=\"pattern\">%s</param></data>", pattern);
}

static void add_value(fw_text *out, const fw_attribute_row *a) {
    if (a->kind == FW_KIND_WORD) {
        fw_text_add(out, "<choice>");
        for (int i = 0; a->words[i]; i++)
            fw_text_printf(out, "<value>%s</value>", a->words[i]);
        fw_text_add(out, "</choice>");
    } else if (a->kind == FW_KIND_ID || a->kind == FW_KIND_REF)
        add_pattern(out, "[A-Za-z_][A-Za-z0-9_\\-]{0,63}");
    else if (a->kind == FW_KIND_NAME)
        add_pattern(out, "[A-Za-z_][A-Za-z0-9_]{0,63}");
    else if (fw_kind_is_expression(a->kind))
        add_pattern(out, "[ -~\\s]*\\S[ -~\\s]*");
    else
        fw_text_add(out, "<text/>");
}

static void add_attribute(fw_text *out, const fw_attribute_row *a) {
    const char *open = a->required ? "" : "<optional>", *close = a->required ? "" : "</optional>";
    fw_text_printf(out, "      %s<attribute name=\"%s\">", open, a->name);
    add_value(out, a);
    fw_text_printf(out, "</attribute>%s\n", close);
}

static void add_children(fw_text *out, const char *parent) {
    const fw_element_row *row;
    int found = 0;
    for (int i = 0; (row = fw_element_row_at(i)) != NULL; i++) {
        if (strcmp(row->parent, parent) != 0) continue;
        fw_text_add(out, found++ ? "" : "      <zeroOrMore><choice>\n");
        fw_text_printf(out, "        <ref name=\"%s\"/>\n", row->name);
    }
    if (found) fw_text_add(out, "      </choice></zeroOrMore>\n");
}

fw_status fw_device_relax_ng(fw_text *out) {
    const fw_element_row *e;
    fw_text_add(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                     "<!-- generated from src/device/table_*.c; do not edit -->\n"
                     "<grammar xmlns=\"http://relaxng.org/ns/structure/1.0\" "
                     "ns=\"urn:flexwright:device:1\"\n"
                     "         datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\">\n"
                     "  <start><ref name=\"device\"/></start>\n");
    for (int i = 0; (e = fw_element_row_at(i)) != NULL; i++) {
        fw_text_printf(out, "  <define name=\"%s\">\n    <element name=\"%s\">\n", e->name,
                       e->name);
        fw_device_attributes all;
        FW_TRY(fw_device_attributes_of(out->arena, e, &all));
        for (int k = 0; k < all.count; k++)
            add_attribute(out, &all.item[k]);
        int before = (int)out->length;
        add_children(out, e->name);
        if ((int)out->length == before && all.count == 0) fw_text_add(out, "      <empty/>\n");
        fw_text_add(out, "    </element>\n  </define>\n");
    }
    fw_text_add(out, "</grammar>\n");
    return fw_text_end(out);
}
