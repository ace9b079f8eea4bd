/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of a wafer say of it in words. Private to the room. */
#ifndef FW_WAFER_WAFER_NOTES_H
#define FW_WAFER_WAFER_NOTES_H
#include "wafer/wafer.h"

/* lines "key=value" for the documentation layer, ASCII */
fw_status fw_wafer_notes(fw_arena *arena, const fw_wafer *wafer, const char ***line, int *count);
/* "arc = 220 deg, link = 120 um"; "" without sweeps */
const char *fw_wafer_values(fw_arena *arena, const fw_wafer *wafer, const fw_wafer_variant *v);
/* of one sweep, in its unit */
double fw_wafer_value(const fw_wafer *wafer, const fw_wafer_variant *v, int sweep);
const char *fw_wafer_kind_text(fw_wafer_kind kind);
const char *fw_wafer_site_name(const fw_wafer *wafer, const fw_wafer_site *site,
                               char name[2 * FW_WAFER_NAME]);
/* are the dies of this variant the stand-in's? */
bool fw_wafer_stood_in(const fw_wafer_variant *v);

typedef struct fw_wafer_sum { /* of one layer over the whole plate */
    double polygons, vertices, area_m2, width_m, space_m;
} fw_wafer_sum;
fw_status fw_wafer_sums(const fw_wafer *wafer, fw_arena *arena, fw_wafer_sum **sum);
/* of all that is drawn: the fiducials stand outermost, without them the places do */
fw_geometry_box fw_wafer_extent(const fw_wafer *wafer);

#endif
