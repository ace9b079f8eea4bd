/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The raw bytes of an XML text: where tags and attributes stand, and what is refused before a
   parser sees it. Private to xml/. */
#ifndef FW_XML_XML_GUARD_H
#define FW_XML_XML_GUARD_H
#include "base/diag.h"

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
