/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Markup: text from templates for HTML and SVG, and the canvas of all pictures. */
#ifndef FW_BASE_SVG_H
#define FW_BASE_SVG_H
#include "base/text.h"
#include <stdarg.h>
#include <stdbool.h>

/* ---- templates ----

   Text from templates, and numbers as people read them: for HTML and SVG.

   A directive of a template is a letter or digit in braces:

     {s}        const char *   escaped; NULL: nothing
     {r}        const char *   as it is, for markup of our own
     {i}        int
     {l}        long
     {c}        double         coordinate of a picture, at most 2 decimals
     {1} ... {9} double        coordinate with at most 1, 2, 3, 4, 6 or 9 decimals
     {n}        double         4 significant digits
     {e}        double         2 significant digits
     {u}        double, const char *   value with SI prefix and unit, 4 digits
     {d}        double         rad, shown in degrees with their sign, 4 digits
     {D}        double         the same for columns: no sign, zeros at the end are kept
     {p}        double         ratio, shown in per cent
     {h}        double         seconds, shown as a duration

   A number that is not finite becomes a dash; a coordinate that is not, 0. */

void fw_markup(fw_text *out, const char *format, ...);
/* the first n bytes of a template; `quote` is written wherever it has an apostrophe */
void fw_markup_part(fw_text *out, const char *format, size_t n, char quote, va_list *arguments);

void fw_markup_number(fw_text *out, double value, int digits);

/* ---- the canvas ----

   Nothing else in the program writes an element of SVG (tests/arch looks).

   An element is a template as above, without its brackets: the name, its attributes with
   apostrophes for quotes and, after a '>', its content:

     fw_svg_put(out, "circle cx='{c}' cy='{c}' r='3' fill='{r}'\n", x, y, colour);
     fw_svg_put(out, "text x='{c}' y='{c}' font-size='11'>{s}\n", x, y, name);

   become <circle .../> and <text ...>name</text>. A newline at the end of a template ends the line
   of the document behind the tag. Coordinates are written with a fixed number of decimals and
   without trailing zeros: {c} (2) for pictures in pixels, {3} for millimetres, {4} and {6} for
   micrometres; so a picture has the same bytes on every machine.

   What an open element or attribute holds is written by fw_markup and the functions of base/text.h.
   A picture is fw_svg_begin, a title, often paper, elements, fw_svg_end. */

/* ---- the document ---- */

typedef enum fw_svg_size { /* width and height as attributes, beside the view box */
                           FW_SVG_SIZE_NONE, /* the picture takes the width that a page gives it */
                           FW_SVG_SIZE_BEHIND, /* of the view box */
                           FW_SVG_SIZE_BEFORE
} fw_svg_size;

typedef struct fw_svg_frame {
    double width, height; /* of the view box, in user units */
    int decimals;         /* of those two, and of the size of the font */
    fw_svg_size size;     /* in pixels, or in mm */
    double unit_mm;       /* > 0: so long is a user unit */
    int mm_decimals;
    bool file;         /* a file of its own, with an XML declaration */
    bool links;        /* has elements `use` with xlink:href, which old importers ask for */
    const char *lead;  /* attributes before the sizes, with apostrophes for quotes; NULL: none */
    const char *trail; /* likewise, behind them */
    const char *font;  /* family; NULL: none */
    double font_size;  /* 0: none */
} fw_svg_frame;

/* of pages and plots; of the pictures of a recipe; of small ones within its run sheet */
extern const char fw_svg_font_page[], fw_svg_font_sheet[], fw_svg_font_step[];

void fw_svg_begin(fw_text *out, const fw_svg_frame *frame);
/* the frame of a report's picture: in a file of its own, or in a page */
void fw_svg_begin_picture(fw_text *out, double width, double height, bool file);
/* a line of its own: what a screen reader says and a pointer shows */
void fw_svg_title(fw_text *out, const char *format, ...);
/* fills the picture: viewers with a dark background show it otherwise */
void fw_svg_paper(fw_text *out, const char *colour);
void fw_svg_end(fw_text *out);
/* a picture within a picture, which cuts off what reaches over its edges; ends like the outer one
 */
void fw_svg_inset(fw_text *out, const char *attributes, ...);

/* ---- elements ---- */

void fw_svg_put(fw_text *out, const char *element, ...);
void fw_svg_open(fw_text *out, const char *element, ...); /* without content; of groups and texts */
void fw_svg_close(fw_text *out, const char *name);        /* its name, and a newline or none */
/* An element whose last attribute follows in pieces: "animate attributeName='d' values" writes up
   to the quote behind values=. fw_svg_finish closes the quote and writes the end of the tag as it
   is:
   "/>", ">" where content follows, with a newline or without. */
void fw_svg_start(fw_text *out, const char *element, ...);
void fw_svg_finish(fw_text *out, const char *end);

/* ---- paths ---- */

/* the attributes before d, whose commands follow */
void fw_svg_path(fw_text *out, const char *attributes, ...);
void fw_svg_path_end(fw_text *out); /* and the line of the document */
/* ends d and writes attributes behind it, at least one, up to the last quote */
void fw_svg_more(fw_text *out, const char *attributes, ...);
/* "M1.5 2", "L3 4": an absolute command and its point */
void fw_svg_point(fw_text *out, char command, double x, double y, int decimals);

/* ---- motion: SMIL, which browsers run even inside <img> ---- */

/* Over and over in so many seconds, straight between key frames. The values follow, with ";"
   between them, then fw_svg_finish(out, "/>"). Of the path that is open; of the group that was
   opened last: "translate" or "rotate". */
void fw_svg_animate_path(fw_text *out, int seconds);
void fw_svg_animate_group(fw_text *out, const char *transform, int seconds);

/* ---- scales ---- */

/* the 1, 2 or 5 times a power of ten at or above x; 1 for what is not positive */
double fw_svg_nice(double x);
/* a value on a scale with such a step: as many decimals as the step has, and a true minus sign */
void fw_svg_tick(fw_text *out, double value, double step);

typedef struct fw_svg_axes { /* of a plot; all in pixels but the ranges */
    double left, right, top, bottom;
    double x0, x1, y0, y1; /* values at these edges */
    int columns, rows;     /* about how many lines of the grid there shall be; 0: none */
} fw_svg_axes;
double fw_svg_axes_x(const fw_svg_axes *axes, double x);
double fw_svg_axes_y(const fw_svg_axes *axes, double y);
/* lines of the grid with their values, left of the plot and below it; the zero lines are darker */
void fw_svg_grid(fw_text *out, const fw_svg_axes *axes);

#endif
