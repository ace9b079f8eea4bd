/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Three outlines of one shape: as drawn, on the mask, as it stands in the end. The last is the
   mask's outline taken back by what the flow loses at its edges, at the top and at the bottom face.
   What is handed over is in fw_mask_edges (mask.h). */
#ifndef FW_MASK_OUTLINES_H
#define FW_MASK_OUTLINES_H
#include "mask/mask.h"

/* contours of one shape of a biased layer; count 0: not asked for, or nothing of it is left */
typedef struct fw_mask_outline {
    const fw_mask_shape *shape;      /* piece->contour is as drawn, contour is on the mask */
    fw_geometry_contour top, bottom; /* as fabricated, known part */
    fw_geometry_contour least, most; /* of the top face, at the ends of what is assumed */
} fw_mask_outline;

typedef struct fw_mask_outlines {
    fw_mask_outline *outline; /* (n) */
    int n;
    int gone_top, gone_bottom, gone_least; /* shapes of which that face has nothing left */
} fw_mask_outlines;

/* In: a mask with its edges. FW_OK with n = 0 where it has none. A shape that cannot be taken back
   so far without changing what hangs together has count 0 and is counted. Exact: lines and arcs as
   fw_geometry_contour_offset makes them; taking back what was added gives the drawn outline to
   1e-12 m. */
fw_status fw_mask_outlines_of(fw_arena *arena, const fw_mask *mask, fw_mask_outlines *out);
/* the picture of fw_mask_write_outlines as a part of an HTML document: ids begin with the flow */
fw_status fw_mask_outlines_part(const fw_mask *mask, fw_text *out);

#endif
