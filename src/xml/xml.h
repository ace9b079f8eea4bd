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

/* Any document as a tree, with texts and elements in the order in which they stand: for pictures, whose values are
   long. DOCTYPE and with it entities are refused, and no other file is opened. */
typedef struct fw_xml_node {
    const char *name; /* of an element, without its prefix; NULL: a text */
    const char *text; /* of a text, as it stands there */
    const char **
        attribute; /* names without prefixes and values in turn, NULL behind them; of a text NULL */
    struct fw_xml_node *parent, *first, *last, *next;
} fw_xml_node;

/* FW_INPUT: no XML, or refused; *line says where, from 1 */
fw_status fw_xml_tree(fw_arena *arena, const char *xml, size_t n, fw_xml_node **root, int *line);
const char *fw_xml_node_value(const fw_xml_node *of, const char *name); /* or NULL */

/* The raw bytes of an XML text: where tags and attributes stand, and what is refused before a
   parser sees it. Private to xml/. */

enum {
    FW_XML_BYTES_MOST = 8 * 1024 * 1024,
    FW_XML_DEPTH_MOST = 32,
    FW_XML_ELEMENTS_MOST = 200000,
    FW_XML_ATTRIBUTES_MOST = 64,
    FW_XML_ALL_ATTRIBUTES_MOST = 1000000,
    FW_XML_VALUE_MOST = 4096,
    FW_XML_LAW_MOST = 65536 /* of table, factor and value: laws in time and expressions */
};

typedef struct fw_xml_bytes {
    const char *data;
    size_t n;
} fw_xml_bytes;

typedef struct fw_xml_raw_attribute { /* offsets into the text */
    size_t name, name_length, value, value_length;
} fw_xml_raw_attribute;

/* byte offset -> line and column, both from 1 */
fw_place fw_xml_place_at(const char *file, fw_xml_bytes xml, size_t offset);
int fw_xml_starts_with(fw_xml_bytes xml, size_t at, const char *what);
size_t fw_xml_find(fw_xml_bytes xml, size_t at, const char *what); /* xml.n when absent */

/* the first start tag at or behind `at`, comments and the like skipped; xml.n when none */
size_t fw_xml_next_tag(fw_xml_bytes xml, size_t at);
/* the next attribute name="value" at or behind `at` inside a tag; 0 when the tag ends first */
int fw_xml_next_attribute(fw_xml_bytes xml, size_t at, fw_xml_raw_attribute *attribute);

/* refusals; *body is the offset behind a byte order mark */
fw_status fw_xml_guard(const char *file, fw_xml_bytes xml, fw_diags *diags, size_t *body);

#endif
