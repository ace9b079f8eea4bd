/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bias, gaps and edges of the fixed point, in the JSON of the recipe. */
#include "base/members.h"
#include "recipe/words.h"

static void number(fw_text *out, const char *key, double value) {
    fw_put_number(out, key, value, FW_PLAIN_DIGITS);
}

static void face(fw_text *out, const char *key, double known_m, double low_m, double high_m) {
    fw_put_open(out, key, '{');
    number(out, "known_m", known_m);
    number(out, "low_m", low_m);
    number(out, "high_m", high_m);
    fw_text_add(out, "}");
}

static void opening(fw_text *out, const fw_edge_class *c) {
    fw_put_line(out);
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "name", c->name);
    number(out, "drawn_m", c->drawn_m);
    number(out, "mask_m", c->plate_m);
    number(out, "under_mask_m", c->opening_m);
    number(out, "through_s", c->through_s);
    number(out, "over_etch", c->over_etch);
    face(out, "top", c->edge.top_m, c->low.top_m, c->high.top_m);
    face(out, "bottom", c->edge.bottom_m, c->low.bottom_m, c->high.bottom_m);
    fw_text_add(out, "}");
}

void fw_recipe_edges_json(const fw_flow *flow, fw_text *out) {
    const fw_fixed_point *p = &flow->edges;
    fw_put_open(out, "edges", '{');
    fw_put_truth(out, "solved", p->solved);
    fw_put_truth(out, "open", p->open || p->wet_open || p->worn_open);
    number(out, "printed_m", p->printed_m);
    number(out, "wet_m", p->wet_m);
    number(out, "worn_m", p->worn_m);
    number(out, "etch_m", p->etch_m);
    number(out, "least_bias_m", p->low_m);
    number(out, "most_bias_m", p->high_m);
    fw_put_open(out, "openings", '[');
    for (int i = 0; i < p->ncls; i++)
        opening(out, &p->cls[i]);
    fw_text_add(out, "]}");
}
