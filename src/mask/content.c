/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The test die as a mask, and the list of what is on it. */
#include "mask/content.h"
#include "mask/json.h"
#include <math.h>
#include <string.h>

/* the layer on which structure is drawn has the rules that the patterns keep */
static const fw_mask_layer *structure_layer(const fw_mask_table *table) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_STRUCTURE) return &table->layer[k];
    return NULL;
}

fw_status fw_mask_frame_marks(fw_arena *arena, const fw_mask_table *table, const fw_layout *device,
                              const fw_layout **layout, int *left_out) {
    const fw_mask_layer *layer = structure_layer(table);
    double width = layer ? layer->min_width_m : 0, space = layer ? layer->min_space_m : 0;
    return fw_content_on_frame(arena, device, table->pattern, table->npattern, width, space, layout,
                               left_out);
}

fw_status fw_mask_coupons_build(fw_arena *arena, const fw_mask_table *table,
                                const fw_coupon_options *options, fw_diags *diags,
                                const fw_mask_coupons **coupons) {
    *coupons = NULL;
    const fw_mask_layer *layer = structure_layer(table);
    if (table->npattern == 0 || !layer) return FW_OK;
    fw_mask_coupons *c = fw_arena_one(arena, fw_mask_coupons);
    FW_NEED(c);
    const char *title = fw_arena_printf(arena, "TEST %s", table->flow);
    FW_NEED(title);
    fw_content_options content = {.die = options->die,
                                  .frame_m = options->frame_m,
                                  .lane_m = options->lane_m,
                                  .bias_m = options->mask.bias_m,
                                  .width_rule_m = layer->min_width_m,
                                  .space_rule_m = layer->min_space_m,
                                  .title = title,
                                  .flow = table->flow,
                                  .die_id = options->die_id,
                                  .file = layer->place.file};
    FW_TRY(fw_content_build(arena, table->pattern, table->npattern, &content, diags, &c->content));
    fw_mask_options mask = options->mask;
    mask.bias_m = 0; /* it is in the outlines, where a pattern wants it */
    mask.no_islands = true;
    mask.title = title;
    FW_TRY(fw_mask_build(arena, c->content->layout, table, title, &mask, diags, &c->mask));
    *coupons = c;
    return FW_OK;
}

/* ---- the list ---- */

static void place(fw_text *out, const char *key, fw_vec2 p) {
    fw_text_printf(out, "\"%s\": [", key);
    fw_text_fixed(out, p.x * 1e6, 4);
    fw_text_add(out, ", ");
    fw_text_fixed(out, p.y * 1e6, 4);
    fw_text_add(out, "]");
}

static fw_vec2 on_die(const fw_coupon *c, fw_vec2 p) {
    return (fw_vec2){c->at.x + p.x, c->at.y + p.y};
}

static void feature(fw_text *out, const fw_coupon *c, const fw_feature *f) {
    fw_text_add(out, "\n        {");
    fw_mask_json_text(out, "feature", f->name);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "drawn_um", f->drawn_m * 1e6, 9);
    fw_text_add(out, ", ");
    place(out, "from_um", on_die(c, f->from));
    fw_text_add(out, ", ");
    place(out, "to_um", on_die(c, f->to));
    fw_text_add(out, "}");
}

static void coupon(fw_text *out, const fw_coupon *c) {
    const fw_pattern *p = c->pattern;
    fw_text_add(out, "\n    {");
    fw_mask_json_text(out, "coupon", p->id);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "kind", p->kind->name);
    fw_text_add(out, ", ");
    fw_mask_json_text(out, "title", p->title);
    fw_text_printf(out, ",\n     \"placed\": %s, \"biased\": %s, ", c->placed ? "true" : "false",
                   p->biased ? "true" : "false");
    fw_mask_json_text(out, "gives", p->gives);
    fw_text_add(out, ",\n     ");
    fw_mask_json_text(out, "what", p->kind->what);
    fw_text_add(out, ",\n     ");
    fw_mask_json_text(out, "measure", p->measure);
    fw_text_add(out, ",\n     ");
    fw_mask_json_text(out, "formula", c->formula);
    fw_text_add(out, ",\n     ");
    fw_mask_json_text(out, "source", p->source);
    fw_text_add(out, ",\n     \"figures\": [");
    for (int i = 0; i < c->nfigure; i++) {
        fw_text_add(out, i ? ", {" : "{");
        fw_mask_json_text(out, "name", c->figure[i].name);
        fw_text_add(out, ", ");
        fw_mask_json_number(out, "value", c->figure[i].value, 9);
        fw_text_add(out, ", ");
        fw_mask_json_text(out, "unit", c->figure[i].unit);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    if (c->placed) {
        fw_text_add(out, ",\n     ");
        place(out, "corner_um", c->at);
        fw_text_add(out, ", ");
        place(out, "size_um", (fw_vec2){c->width_m, c->height_m});
        fw_text_add(out, ",\n     \"features\": [");
        for (int i = 0; i < c->nfeature; i++) {
            fw_text_add(out, i ? "," : "");
            feature(out, c, &c->feature[i]);
        }
        fw_text_add(out, "]");
    }
    fw_text_add(out, "}");
}

fw_status fw_mask_write_coupons(const fw_mask_coupons *coupons, const char *gds_sha256,
                                const fw_output_file *file, int nfile, fw_text *out) {
    const fw_content *content = coupons->content;
    FW_TRY(fw_mask_write_certificate_of(coupons->mask, gds_sha256, file, nfile, out));
    /* the certificate is one object; its members go on */
    while (out->length > 0 && out->data[out->length - 1] != '}')
        out->length--;
    if (out->length < 2) return FW_INTERNAL;
    out->length--;
    while (out->length > 0 &&
           (out->data[out->length - 1] == '\n' || out->data[out->length - 1] == ' '))
        out->length--;
    fw_text_add(out, ",\n  ");
    fw_mask_json_number(out, "fill_density", content->fill_density, 9);
    fw_text_add(out, ", ");
    fw_mask_json_number(out, "fill_area_um2", content->fill_area_m2 * 1e12, 12);
    fw_text_add(out, ",\n  \"coupons\": [");
    for (int i = 0; i < content->ncoupon; i++) {
        fw_text_add(out, i ? "," : "");
        coupon(out, &content->coupon[i]);
    }
    fw_text_add(out, "\n  ]\n}\n");
    return fw_text_end(out);
}
