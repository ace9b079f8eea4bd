/* SPDX-License-Identifier: GPL-3.0-or-later */
/* References to cells, and notes. */
#include "mask/references.h"
#include "mask/records.h"

void fw_mask_gds_array(fw_text *out, const char *cell, fw_geometry_point at, int columns, int rows,
                       fw_geometry_point step) {
    bool one = columns == 1 && rows == 1;
    fw_gds_record(out, one ? FW_GDS_SREF : FW_GDS_AREF, 0);
    fw_gds_string(out, FW_GDS_SNAME, cell);
    if (!one) {
        fw_gds_record(out, FW_GDS_COLROW, 4);
        fw_gds_u16(out, (unsigned)columns);
        fw_gds_u16(out, (unsigned)rows);
    }
    fw_gds_record(out, FW_GDS_XY, one ? 8 : 24);
    fw_gds_point(out, at.x_dbu, at.y_dbu);
    if (!one) {
        fw_gds_point(out, at.x_dbu + columns * step.x_dbu, at.y_dbu);
        fw_gds_point(out, at.x_dbu, at.y_dbu + rows * step.y_dbu);
    }
    fw_gds_record(out, FW_GDS_ENDEL, 0);
}

void fw_mask_gds_note(fw_text *out, const fw_mask_layer *layer, fw_geometry_point at,
                      const char *line) {
    fw_gds_record(out, FW_GDS_TEXT, 0);
    fw_gds_number(out, FW_GDS_LAYER, layer->layer);
    fw_gds_number(out, FW_GDS_TEXTTYPE, layer->datatype);
    fw_gds_record(out, FW_GDS_XY, 8);
    fw_gds_point(out, at.x_dbu, at.y_dbu);
    fw_gds_string(out, FW_GDS_STRING, line);
    fw_gds_record(out, FW_GDS_ENDEL, 0);
}
