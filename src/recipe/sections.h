/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What lies along a cut, for the picture and the JSON of sections. Private to recipe/. */
#ifndef FW_RECIPE_SECTIONS_H
#define FW_RECIPE_SECTIONS_H
#include "recipe/profile.h"

typedef struct fw_section_part { /* a piece as drawn, within the window */
    double from_m, to_m;
    const char *label;
} fw_section_part;

typedef struct fw_section_opening { /* between two parts of the structure */
    double from_m, to_m;            /* along the cut, as drawn */
    /* width across, fw_slicer_opening. NaN: a part is gone there, or the flow makes no such film */
    double drawn_m, mask_m, top_m, bottom_m;
    double depth_m; /* of the cut through the device layer; NaN: there is none */
} fw_section_opening;

typedef struct fw_section_plan {
    fw_section_part *part;       /* (npart) */
    fw_section_opening *opening; /* (nopening) */
    int npart, nopening;
} fw_section_plan;
fw_status fw_section_plan_of(fw_slicer *slicer, const fw_flow *flow, fw_section_plan *plan);

/* title, device, cut and REJECTED; 40 high */
void fw_section_head(const fw_flow *flow, const fw_recipe_header *header, const char *what,
                     fw_text *out);
/* a page 860 wide around a body 800 wide */
fw_status fw_section_page(const fw_text *body, double height, const char *title, fw_text *out);

#endif
