/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The <q> element: one number with unit, uncertainty, status and source. Material and process packs
   share it.

   <q id value unit status src note/> with exactly one of u (standard, in `unit`), urel (relative)
   or lo and hi (uniform between them: u = (hi - lo)/sqrt(12)); or unknown="true" instead of value.
   least and most, both or none, are the range in which a value makes sense at all: what replaces
   this one must lie there too, which catches A for Ao and min for s. range names one of those that
   packs share instead (process/quantity_ranges.def). */
#ifndef FW_XML_XML_QUANTITY_H
#define FW_XML_XML_QUANTITY_H
#include "xml/xml_table.h"
#include "xml/xml.h"
#include "quantity/quantity.h"

/* what may stand in <q>, for tables (apart) and schemas; fw_xml_quantity_read has the checks */
enum { FW_QUANTITY_ROWS = 15 };
extern const fw_xml_attribute_row fw_xml_quantity_rows[FW_QUANTITY_ROWS];

typedef struct fw_xml_source_text { /* <source id ...>text</source> */
    const char *id, *text;
} fw_xml_source_text;

/* all <source> children of `parent`, in file order; duplicate or missing ids are errors */
fw_status fw_xml_sources_read(fw_arena *arena, const fw_xml_element *parent, fw_diags *diags,
                              fw_xml_source_text **source, int *nsource);

/* false and FW-D278 when the value is outside the plausible range of `range`, which is q itself or
   the one that q replaces */
bool fw_xml_quantity_check_range(const fw_quantity *q, const fw_quantity *range, fw_diags *diags);

/* FW_INPUT when the element is wrong (all its mistakes are in diags); *q is then unknown. `src` is
   resolved among the sources; q->source is the source's text. Attributes that are not named above
   are errors. The value is in SI, degrees Celsius in kelvin. */
fw_status fw_xml_quantity_read(fw_arena *arena, const fw_xml_element *element,
                               const fw_xml_source_text *source, int nsource, fw_diags *diags,
                               fw_quantity *q);

#endif
