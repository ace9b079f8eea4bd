/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bias, gaps and edges of the fixed point, in the JSON of the recipe. */
#include "recipe/words.h"
#include <math.h>

static void number(fw_text *out, const char *name, double value, bool first) {
    fw_text_printf(out, "%s\"%s\":", first ? "" : ",", name);
    fw_put_or_null(out, value);
}

static void face(fw_text *out, const char *name, double known_m, double low_m, double high_m) {
    fw_text_printf(out, ",\"%s\":{", name);
    number(out, "known_m", known_m, true);
    number(out, "low_m", low_m, false);
    number(out, "high_m", high_m, false);
    fw_text_add(out, "}");
}

static void opening(fw_text *out, const fw_edge_class *c) {
    fw_text_add(out, "{\"name\":");
    fw_put_json(out, c->name);
    number(out, "drawn_m", c->drawn_m, false);
    number(out, "mask_m", c->plate_m, false);
    number(out, "under_mask_m", c->opening_m, false);
    number(out, "through_s", c->through_s, false);
    number(out, "over_etch", c->over_etch, false);
    face(out, "top", c->edge.top_m, c->low.top_m, c->high.top_m);
    face(out, "bottom", c->edge.bottom_m, c->low.bottom_m, c->high.bottom_m);
    fw_text_add(out, "}");
}

void fw_recipe_edges_json(const fw_flow *flow, fw_text *out) {
    const fw_fixed_point *p = &flow->edges;
    fw_text_printf(out, ",\"edges\":{\"solved\":%s,\"open\":%s", p->solved ? "true" : "false",
                   p->open || p->wet_open || p->worn_open ? "true" : "false");
    number(out, "printed_m", p->printed_m, false);
    number(out, "wet_m", p->wet_m, false);
    number(out, "worn_m", p->worn_m, false);
    number(out, "etch_m", p->etch_m, false);
    number(out, "least_bias_m", p->low_m, false);
    number(out, "most_bias_m", p->high_m, false);
    fw_text_add(out, ",\"openings\":[");
    for (int i = 0; i < p->ncls; i++) {
        fw_text_add(out, i ? ",\n" : "\n");
        opening(out, &p->cls[i]);
    }
    fw_text_add(out, "]}");
}
