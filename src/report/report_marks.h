/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room. What pictures mark in the warning colour: why a layout cannot be made, and
   why a device is rejected, each with a number in the picture and a row below it. */
#ifndef FW_REPORT_REPORT_MARKS_H
#define FW_REPORT_REPORT_MARKS_H
#include "report/report_page.h"

typedef struct fw_report_mark {
    int number;          /* FW-Dnnn; 0: the hinge's own limit */
    const char *label;   /* a few words */
    const char *text;    /* a sentence */
    const char *of;      /* probe; NULL */
    fw_geometry_vec2 at; /* world; NaN: no one place */
    int body[2], nbody;  /* concerned; FW_GROUND, FW_ISLAND */
    int joint[2], njoint;
    const fw_geometry_region *overlap; /* NULL or empty: none */
} fw_report_mark;

typedef struct fw_report_marks {
    fw_report_mark *item; /* (count) in the order of their numbers, from 1 */
    int count;
} fw_report_marks;

/* layout and verdict may be NULL; none of a device that is not rejected and can be drawn */
fw_status fw_report_marks_of(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict *verdict, fw_report_marks *marks);
extern const char fw_report_mark_colour[];
/* over the drawing; and over its names, the numbers beside their places */
void fw_report_marks_tags(const fw_device *device, const fw_layout *layout,
                          const fw_report_marks *marks, const fw_report_view *view, fw_text *out);
void fw_report_marks_svg(const fw_device *device, const fw_layout *layout,
                         const fw_report_marks *marks, const fw_report_view *view, fw_text *out);
/* the rows below it, and how high they are */
fw_status fw_report_marks_legend(fw_arena *arena, const fw_report_marks *marks, double width,
                                 double top, fw_text *out);
double fw_report_marks_height(const fw_report_marks *marks);
#endif
