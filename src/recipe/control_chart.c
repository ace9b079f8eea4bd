/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/control_chart.h"
#include <math.h>

bool fw_recipe_chart_factors(int n, double *A2, double *D3, double *D4) {
    static const double factor[][3] = {
        {1.880, 0.0, 3.267},   {1.023, 0.0, 2.574},   {0.729, 0.0, 2.282},
        {0.577, 0.0, 2.114},   {0.483, 0.0, 2.004},   {0.419, 0.076, 1.924},
        {0.373, 0.136, 1.864}, {0.337, 0.184, 1.816}, {0.308, 0.223, 1.777}};
    if (n < 2 || n > 10) return false;
    *A2 = factor[n - 2][0], *D3 = factor[n - 2][1], *D4 = factor[n - 2][2];
    return true;
}

/* the most frequent number of sites, of two the larger */
static int frequent(const fw_recipe_chart *c, int *times) {
    int best = 1;
    *times = 0;
    for (int i = 0; i < c->npoint; i++) {
        int n = 0;
        for (int k = 0; k < c->npoint; k++)
            n += c->point[k].n == c->point[i].n;
        if (n > *times || (n == *times && c->point[i].n > best)) best = c->point[i].n, *times = n;
    }
    return best;
}

/* |x_i - x_(i-1)| of individual values, none at the first */
static void moving_ranges(fw_recipe_chart *c) {
    const fw_recipe_chart_point *before = NULL;
    for (int i = 0; i < c->npoint; i++) {
        fw_recipe_chart_point *p = &c->point[i];
        if (p->n != 1) continue;
        p->range = before ? fabs(p->mean - before->mean) : (double)NAN;
        before = p;
    }
}

static void averages(fw_recipe_chart *c) {
    int ranges = 0;
    c->centre = c->range_centre = 0.0;
    for (int i = 0; i < c->npoint; i++) {
        const fw_recipe_chart_point *p = &c->point[i];
        if (p->n != c->size) continue;
        c->centre += p->mean / c->counted;
        if (!isnan(p->range)) c->range_centre += p->range, ranges++;
    }
    c->range_centre = ranges ? c->range_centre / ranges : (double)NAN;
}

static void mark(fw_recipe_chart *c) {
    int same = 0, side = 0;
    for (int i = 0; i < c->npoint; i++) {
        fw_recipe_chart_point *p = &c->point[i];
        if (p->n != c->size) continue;
        int is = (p->mean > c->centre) - (p->mean < c->centre);
        same = is != 0 && is == side ? same + 1 : is != 0;
        side = is;
        p->run = same >= FW_CHART_RUN;
        p->beyond = p->mean < c->lower || p->mean > c->upper;
        p->range_beyond = p->range < c->range_lower || p->range > c->range_upper;
    }
}

/* Subgroups of n = 2 to 10 sites: xbar-bar +- A2 R-bar, ranges D3 R-bar to D4 R-bar. Individual values: x-bar +- 2.66
   MR-bar, moving ranges of two 0 to 3.267 MR-bar (2.66 = 3/d2(2), 3.267 = D4(2)). Limits of their own from 8 subgroups of
   one size on (trial limits until 20); with fewer there are none. Out of control: beyond a limit, or the eighth and every
   further of a run on one side of the centre. Input and output in the unit of what was measured. A false alarm of the
   limits is one in 370 points of a normal distribution, of the runs one in 128 starts.
   Source: D. C. Montgomery, Introduction to Statistical Quality Control, 6.2, 6.4 and appendix VI; NIST/SEMATECH e-Handbook
   of Statistical Methods, 6.3.2. Test: test_control_chart.c. */
void fw_recipe_chart_judge(fw_recipe_chart *c) {
    double A2 = 2.66, D3 = 0.0, D4 = 3.267;
    c->size = frequent(c, &c->counted);
    moving_ranges(c);
    averages(c);
    c->limits = c->counted >= FW_CHART_LEAST &&
                (c->size == 1 || fw_recipe_chart_factors(c->size, &A2, &D3, &D4));
    if (!c->limits) return;
    c->lower = c->centre - A2 * c->range_centre;
    c->upper = c->centre + A2 * c->range_centre;
    c->range_lower = D3 * c->range_centre;
    c->range_upper = D4 * c->range_centre;
    mark(c);
}
