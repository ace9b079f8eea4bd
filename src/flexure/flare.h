/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure whose two faces are not equally wide: walls that etching left at a slope. */
#ifndef FW_FLEXURE_FLARE_H
#define FW_FLEXURE_FLARE_H
#include "flexure/flexure.h"

/* corrects what was computed for a rectangle of the mean width: flare_m is half of what one face is
   wider than the other, of either sign; 0 changes nothing */
void fw_flexure_flare(const fw_flexure_input *in, double flare_m, fw_flexure_result *out);

#endif
