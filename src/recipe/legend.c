/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/legend.h"
#include <math.h>
#include <string.h>

void fw_legend_add(fw_legend *legend, const fw_legend_entry *layer) {
    fw_legend_entry *e = legend->entry;
    int at = 0;
    while (at < legend->n &&
           (strcmp(e[at].material, layer->material) != 0 || e[at].exposed != layer->exposed))
        at++;
    if (at == legend->most) return;
    if (at == legend->n) {
        e[legend->n++] = *layer;
        e[at].thickness_m = 0, legend->column_m[at] = 0;
    }
    e[at].unknown = e[at].unknown || isnan(layer->thickness_m);
    e[at].top_m = fmax(e[at].top_m, layer->top_m);
    e[at].reach_m = fmax(e[at].reach_m, layer->reach_m);
    legend->column_m[at] += layer->thickness_m;
}

void fw_legend_end_column(fw_legend *legend) {
    for (int i = 0; i < legend->n; i++) {
        legend->entry[i].thickness_m = fmax(legend->entry[i].thickness_m, legend->column_m[i]);
        legend->column_m[i] = 0;
    }
}

void fw_legend_from_the_top(fw_legend *legend) {
    fw_legend_entry *e = legend->entry;
    for (int i = 1; i < legend->n; i++)
        for (int k = i; k > 0 && e[k].top_m > e[k - 1].top_m; k--) {
            fw_legend_entry swap = e[k];
            e[k] = e[k - 1];
            e[k - 1] = swap;
        }
}
