/* SPDX-License-Identifier: GPL-3.0-or-later */
/* XML with the place of every element and attribute, read from memory by libxml2's SAX2 interface.

   Refused at once, with a place: DOCTYPE and entities, processing instructions, text that is not
   UTF-8, NUL bytes, more than 8 MiB, 32 levels, 200 000 elements, 64 attributes per
   element and 1 000 000 in all, 4 096 bytes per value. No other file is ever opened. */
#ifndef FW_XML_XML_H
#define FW_XML_XML_H
#include "base/diag.h"

typedef struct fw_xml_attribute {
    const char *name, *value;
    fw_place place;      /* of the value's first character */
    size_t value_offset; /* byte offset of the value in the file */
    int exact;           /* value bytes equal file bytes (no entity inside): offsets inside hold */
    fw_place name_place; /* of the name's first character */
    const char *raw; /* the value as it stands in the file, raw_length bytes; not ended by NUL */
    size_t raw_length;
} fw_xml_attribute;

typedef struct fw_xml_element {
    const char *name, *space;    /* local name, namespace */
    fw_place place;              /* of the '<' */
    size_t offset;               /* of it, in bytes of the file */
    fw_xml_attribute *attribute; /* (nattribute) */
    int nattribute;
    const char *text; /* character data directly inside, trimmed; "" when none */
    fw_place text_place;
    struct fw_xml_element *parent, *first_child, *last_child, *next;
} fw_xml_element;

/* root NULL when it could not be read at all */
fw_status fw_xml_read(fw_arena *arena, const char *file, const char *xml, size_t n, fw_diags *diags,
                      fw_xml_element **root);
const fw_xml_attribute *fw_xml_attribute_of(const fw_xml_element *element,
                                            const char *name); /* or NULL */
/* place of byte `offset` of the value; the value's own place where it is not exact */
fw_place fw_xml_inside(const fw_xml_attribute *attribute, size_t offset);

#endif
