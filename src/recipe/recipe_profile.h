/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the films of a wafer lie along a straight cut: the mask's exact outlines, each moved to
   where a film's wall stands, cut by the line in closed form. Private to recipe/. */
#ifndef FW_RECIPE_RECIPE_PROFILE_H
#define FW_RECIPE_RECIPE_PROFILE_H
#include "process/films.h"
#include "recipe/recipe.h"

/* the plate's shapes near the cut, moved; one edge of the cache */
typedef struct fw_recipe_outline_at {
    double edge_m;                /* outside the drawn edge */
    fw_geometry_contour *contour; /* (nshape) of the slicer; count 0: nothing is left of it */
    fw_geometry_slices inside;    /* along the line: the structure */
    fw_geometry_slices gap;       /* openings before, between and behind it; ends at infinity */
    double *width_m;              /* (gap.n) across; NaN: not asked for yet */
} fw_recipe_outline_at;

typedef struct fw_recipe_slicer {
    fw_arena *arena;
    const fw_mask *mask;
    const fw_recipe_cut *cut;
    const fw_mask_plate_term *term; /* (nterm) */
    int nterm;
    const fw_mask_shape **shape; /* (nshape) of the plate, near the window */
    int *term_of;                /* (nshape) */
    int nshape;
    fw_recipe_outline_at *at; /* (nat) */
    int nat, capacity;
    double bias_m; /* of what the plate draws, against what is drawn */
    /* of the flow's other plates; NULL: not asked for yet */
    struct fw_recipe_slicer *further[FW_PROCESS_PLATES];
    struct fw_recipe_region *region; /* solved so far (block_region.c) */
} fw_recipe_slicer;

typedef struct fw_recipe_patch { /* a film in the section: a trapezium */
    const fw_process_film *film;
    double low_m[2], high_m[2]; /* from and to, at the bottom and at the top; 0 to cut->length_m */
    double bottom_m, top_m;     /* drawn heights */
} fw_recipe_patch;

typedef struct fw_recipe_cross_section {
    fw_process_films films;
    fw_recipe_patch *patch; /* (n) bottom first */
    int n, capacity;
} fw_recipe_cross_section;

fw_status fw_recipe_slicer_start(fw_arena *arena, const fw_mask *mask, const fw_recipe_cut *cut,
                                 fw_recipe_slicer *slicer);
/* the structure with its edges so far outside the drawn ones */
fw_status fw_recipe_slicer_at(fw_recipe_slicer *slicer, double edge_m,
                              const fw_recipe_outline_at **at);
/* of the device's slicer: that of a further plate, from 1 */
fw_status fw_recipe_slicer_of_plate(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                    int plate, fw_recipe_slicer **out);
/* width of opening g: the largest circle in it with its middle on the cut. So a slot that is cut
   askew has its own width. INFINITY where it has no end. */
double fw_recipe_slicer_opening(const fw_recipe_slicer *slicer, const fw_recipe_outline_at *at,
                                int g);
#define FW_NEAR_M 400e-6

/* how much farther out feet beside an opening of w_m stand than beside the open field; m */
double fw_recipe_foot_more(const fw_process_flow *flow, const fw_process_cut *cut, double w_m);

/* the wafer after step `index` along the cut */
fw_status fw_recipe_cross_section_of(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                     int index, fw_recipe_cross_section *profile);

/* ---- how it is painted: recipe_section.c ---- */
const char *fw_recipe_paint_fill(const char *material, bool exposed);

/* one scale for all pictures of a flow */
typedef struct fw_recipe_section_scale {
    double window_m;      /* along the cut */
    double low_m, high_m; /* heights, over all steps */
    double exaggeration;  /* of heights: 1, 2, 5, ... */
} fw_recipe_section_scale;
fw_status fw_recipe_section_scale_of(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_recipe_cut *cut, fw_recipe_section_scale *scale);
/* parts of the picture: the films (height out), a scale bar, a legend in columns (rows out) */
void fw_recipe_section_draw(const fw_recipe_cross_section *profile,
                            const fw_recipe_section_scale *scale, double width, fw_text *out,
                            double *height);
void fw_recipe_section_scale_bar(const fw_recipe_section_scale *scale, double width, double y,
                                 fw_text *out);
int fw_recipe_section_legend(const fw_process_flow *flow, const fw_process_films *films,
                             double width, int columns, double y, fw_text *out);
/* the section after a step as an SVG fragment, 310 wide */
fw_status fw_recipe_section_exact(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                  const fw_recipe_section_scale *scale, int index, fw_text *out);
/* the block behind the cut after a step, seen from above; drawn into a group at (0, 0), size out */
fw_status fw_recipe_block_draw(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                               const fw_recipe_section_scale *scale, int index, double width,
                               fw_text *out, double *height);

/* ---- what lies along a cut: recipe_sections.c ---- */

typedef struct fw_recipe_section_part { /* a piece as drawn, within the window */
    double from_m, to_m;
    const char *label;
} fw_recipe_section_part;

typedef struct fw_recipe_section_opening { /* between two parts of the structure */
    double from_m, to_m;                   /* along the cut, as drawn */
    /* width across, fw_recipe_slicer_opening. NaN: a part is gone there, or the flow makes no such
       film */
    double drawn_m, mask_m, top_m, bottom_m;
    double depth_m; /* of the cut through the device layer; NaN: there is none */
} fw_recipe_section_opening;

typedef struct fw_recipe_section_plan {
    fw_recipe_section_part *part;       /* (npart) */
    fw_recipe_section_opening *opening; /* (nopening) */
    int npart, nopening;
} fw_recipe_section_plan;
fw_status fw_recipe_section_plan_of(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                                    fw_recipe_section_plan *plan);

/* ---- the outlines behind a cut as polygons in its own frame, clipped to the block that is shown,
   and the walls that stand on them: block.c ---- */

/* of an outline in the frame of the cut: x along it, y behind it; m */
typedef struct fw_recipe_spot {
    double x, y;
    bool open; /* the edge that ends here is no wall: the block's own side, or a joint of pieces */
} fw_recipe_spot;

typedef struct fw_recipe_ring {
    fw_recipe_spot *corner; /* (n) */
    int n;
} fw_recipe_ring;

typedef struct fw_recipe_rings {
    /* (n) pieces, and holes in them: inside where the number of rings is odd */
    fw_recipe_ring *ring;
    int n;
} fw_recipe_rings;

typedef struct fw_recipe_wall { /* from a to b, material on its left; m */
    fw_recipe_spot a, b;
    int film;
} fw_recipe_wall;

/* an outline in the frame of the cut, arcs within tolerance_m, within the block */
fw_status fw_recipe_ring_of(fw_arena *arena, const fw_recipe_cut *cut,
                            const fw_geometry_contour *contour, double tolerance_m,
                            fw_recipe_ring *ring);
/* where a film of a flow with several plates lies; part: 0 at its foot, 1 at its head. Always asked with one tolerance */
fw_status fw_recipe_region_of(fw_recipe_slicer *slicer, const fw_process_flow *flow,
                              const fw_process_film *film, double part, double tolerance_m,
                              fw_recipe_rings *rings);

/* Sorts walls of one height so that none is drawn before one that it hides. toward: unit vector in
   the plane to the eye. */
fw_status fw_recipe_walls_sort(fw_arena *arena, fw_recipe_wall *wall, int n, double toward_x,
                               double toward_y);

#endif
