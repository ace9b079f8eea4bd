/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Panels with logarithmic axes, curves that are told apart without colour, labels at their ends.
   Private to the room. */
#ifndef FW_STUDY_AXES_H
#define FW_STUDY_AXES_H
#include "base/text.h"
#include <stdbool.h>

typedef struct fw_study_axis { /* decades from low to high, as exponents */
    double low, high;
    bool falls; /* large values first */
} fw_study_axis;
fw_study_axis fw_study_axis_new(bool falls);
void fw_study_axis_add(fw_study_axis *axis,
                       double value);        /* what is no number above 0 is passed by */
void fw_study_axis_end(fw_study_axis *axis); /* whole decades, at least one */

typedef struct fw_study_panel {
    double x, y, width, height; /* of the plot area */
    fw_study_axis ax, ay;
    bool bare; /* no axis of y */
} fw_study_panel;
double fw_study_panel_x(const fw_study_panel *p, double value);
double fw_study_panel_y(const fw_study_panel *p, double value);
void fw_study_panel_frame(const fw_study_panel *p, const char *title, const char *x_name,
                          const char *y_name, fw_text *out);
/* n points in picture coordinates; `style` gives colour, dashes and marker */
void fw_study_panel_curve(const fw_study_panel *p, const double *x, const double *y, int n,
                          int style, fw_text *out);

enum { FW_LABELS = 24 };
typedef struct fw_study_labels {
    struct {
        const char *text;
        double x, y, at; /* end of the curve; where the label is */
        int style;
    } item[FW_LABELS];
    int n;
} fw_study_labels;
void fw_study_labels_add(fw_study_labels *l, const char *text, double x, double y, int style);
void fw_study_labels_draw(fw_study_labels *l, const fw_study_panel *p, fw_text *out);

#endif
