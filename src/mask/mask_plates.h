/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plates of a flow that prints several: rows <plate> and <content> of its layer table, and the kinds of
   content. Private to the room. */
#ifndef FW_MASK_MASK_PLATES_H
#define FW_MASK_MASK_PLATES_H
#include "mask/mask.h"
#include "xml/xml_reader.h"

typedef struct fw_mask_content_parameter {
    const char *name;   /* attribute of <content> */
    double usual;       /* m; NAN: must be stated */
    double least, most; /* m */
    const char *sentence;
} fw_mask_content_parameter;

typedef struct fw_mask_sheet { /* pieces that a content adds to a drawing */
    fw_arena *arena;
    const fw_layout *device;
    fw_layout_piece *piece;
    int npiece, capacity;
} fw_mask_sheet;
fw_status fw_mask_sheet_add(fw_mask_sheet *sheet, fw_layout_role role, int body, const char *label,
                            const fw_geometry_contour *contour);

/* one reason more; text NULL: FW_NOMEM */
fw_status fw_mask_verdict_add(fw_mask_verdict *verdict, const char *text);
double fw_mask_overlay_between_m(const fw_mask_table *table, int a, int b); /* of two plates */

typedef struct fw_mask_content_kind { /* a row: one for each line of contents.def */
    const char *name, *what;
    fw_mask_content_parameter parameter[FW_CONTENT_PARAMETERS];
    int nparameter;
    fw_status (*draw)(const fw_mask_content *content, fw_mask_sheet *sheet);
    /* adds why the device cannot be made with it; layout: without what other contents draw */
    fw_status (*judge)(const fw_mask_content *content, const fw_mask_table *table,
                       const fw_layout *layout, fw_mask_verdict *verdict);
} fw_mask_content_kind;
const fw_mask_content_kind *fw_mask_content_kind_at(size_t i); /* NULL behind the last row */

extern const fw_xml_element_row fw_mask_plate_rows[];
fw_status fw_mask_plates_build(fw_xml_reader *r, fw_mask_table *table);
fw_status fw_mask_contents_build(fw_xml_reader *r, fw_mask_table *table);

#endif
