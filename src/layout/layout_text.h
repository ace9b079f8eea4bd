/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lettering, alignment marks and the dicing lane, as polygons that pass a width/space check.

   Letters are drawn on square cells of one stroke, nine high and up to nine wide, two cells apart.
   Every part and every space is at least `stroke` wide; corners are 90 or 270 degrees; closed
   letters (A B D O 0 8 ...) are open through a stencil gap, so there is neither a hole nor an
   island; parts never touch at a corner. Text is UTF-8; the font has ASCII, the letters of Latin-1,
   mu, omega and some signs (glyphs.def). What it lacks is refused, never drawn as something else.
   All coordinates are multiples of 1 nm. */
#ifndef FW_LAYOUT_LAYOUT_TEXT_H
#define FW_LAYOUT_LAYOUT_TEXT_H
#include "layout/layout.h"

/* the text, or as much of its beginning as is no longer than length_m, with '+' at its end; "" where
   not even one letter and the '+' are */
fw_status fw_layout_text_fit(fw_arena *arena, const char *string, double height_m, double stroke_m,
                             double length_m, const char **shown);
/* the first character that the font lacks, inside the string; NULL: it has them all */
const char *fw_layout_text_lacks(const char *string);
/* FW_INPUT with an error at `place` (FW-D390) where the font lacks a character of the text, which
   `what` says what it is; else FW_OK */
fw_status fw_layout_text_check(const char *string, const char *what, fw_place place,
                               fw_diags *diags);

/* width of the line of text, m; 0 for "" and for sizes that fw_layout_text refuses */
double fw_layout_text_width(const char *string, double height_m, double stroke_m);

/* appends the letters as pieces with body FW_NONE - 1; `origin` is the lower left corner. Cells are
   height / 9, rounded down to 1 nm. FW_GEOMETRY unless stroke >= 1 nm and height >= 9 stroke, all
   finite and below 1 m, and the font has every character. The three last arguments are a growing array: *npiece used of *capacity. */
fw_status fw_layout_text(fw_arena *arena, const char *string, fw_geometry_vec2 origin,
                         double height_m, double stroke_m, fw_layout_role role, const char *label,
                         fw_layout_piece **piece, int *npiece, int *capacity);

double fw_layout_to_grid(double x_m); /* nearest multiple of 1 nm */

/* four equal arms, each coarse near the centre (half width w, length a) and fine at the tip (f, b):
   the coarse part is found by eye, the fine one is lined up. Counter-clockwise. */
enum { FW_LAYOUT_CROSS = 28 };
void fw_layout_cross(fw_geometry_vec2 centre, double w, double a, double f, double b,
                     fw_geometry_vec2 p[FW_LAYOUT_CROSS]);
/* appends one piece, growing the array */
fw_status fw_layout_add(fw_arena *arena, fw_layout_piece item, fw_layout_piece **piece, int *npiece,
                        int *capacity);

/* appends the title (device->die.title, else the name), the version and the parameters as TEXT,
   crosses and corner brackets as MARK, and four rectangles of the lane as DICING (joined at the
   corners by JOINT segments), all between `window` and `die`. What does not fit with strokes of
   5 um is left out: text loses its last items (then ends in '+'), marks need 80 um of bar beside
   the lane. FW_GEOMETRY when the window is not inside the die. */
fw_status fw_layout_annotate(fw_arena *arena, const fw_device *device, fw_geometry_box window,
                             fw_geometry_box die, fw_diags *diags, fw_layout_piece **piece,
                             int *npiece, int *capacity);

#endif
