/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Control charts of what was measured. Private to recipe/. */
#ifndef FW_RECIPE_CONTROL_CHART_H
#define FW_RECIPE_CONTROL_CHART_H
#include "base/text.h"
#include <stdbool.h>

typedef struct fw_recipe_chart_point { /* a subgroup: the sites of one wafer */
    const char *label;
    double mean, range; /* range of its sites; of single values the moving range; NaN: none */
    int n;              /* sites */
    bool outside;       /* a site of it is not accepted */
    bool beyond, run,
        range_beyond; /* of the limits; the eighth and further of one side; of the range's limits */
} fw_recipe_chart_point;

typedef struct fw_recipe_chart {
    const char *title, *unit;
    double low, high; /* what is accepted; NaN: no such limit */
    fw_recipe_chart_point *point;
    int npoint;
    int size; /* of the subgroups that limits are of: the most frequent one; 1: individual values */
    bool limits; /* there are enough subgroups for limits of their own */
    int counted; /* subgroups of that size */
    double centre, lower, upper, range_centre, range_lower, range_upper;
} fw_recipe_chart;

enum { FW_CHART_LEAST = 8, FW_CHART_FIRM = 20, FW_CHART_RUN = 8 };

/* factors of subgroups of n, 2 to 10; false: no such n */
bool fw_recipe_chart_factors(int n, double *A2, double *D3, double *D4);
/* limits and what breaks the rules, from the points' means, ranges and sizes */
void fw_recipe_chart_judge(fw_recipe_chart *chart);
/* as an SVG fragment, two panels one above the other (control_chart_svg.c) */
void fw_recipe_chart_svg(const fw_recipe_chart *chart, fw_text *out);

#endif
