/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a picture of layers names beside it: one entry for each material, the topmost first. Private
   to the room. */
#ifndef FW_RECIPE_LEGEND_H
#define FW_RECIPE_LEGEND_H
#include <stdbool.h>

typedef struct fw_legend_entry {
    const char *material;
    bool exposed, unknown; /* unknown: some layer's thickness is not stated */
    double thickness_m, top_m, reach_m;
} fw_legend_entry;

enum { FW_LEGEND_MOST = 16 };
typedef struct fw_legend {
    int n, most; /* entries, and how many the picture has room for */
    fw_legend_entry entry[FW_LEGEND_MOST];
    double column_m[FW_LEGEND_MOST]; /* thickness so far within the column */
} fw_legend;

/* a layer of the column at hand; thickness_m NAN: not stated */
void fw_legend_add(fw_legend *legend, const fw_legend_entry *layer);
/* two coats of one material add up within a column; of all columns the thickest counts */
void fw_legend_end_column(fw_legend *legend);
void fw_legend_from_the_top(fw_legend *legend);

#endif
