/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A layout with a layer for each role and a rule of every kind, drawn part by part at any place. */
#ifndef FW_TEST_RULE_FIELD_H
#define FW_TEST_RULE_FIELD_H
#include "mask/rule.h"
#include "scene.h"

enum { RULES = 11, WINDOWS = 4, LAYERS = FW_ROLE_DICING + 1 };
static const double MOST_SLACK_M __attribute__((unused)) =
    2 * (5e-9 + 0.70710678118654752e-9); /* of two arcs */

typedef struct field {
    scene *s;
    fw_mask_layer layer[LAYERS];
    fw_mask_rule rule[RULES];
    uint64_t seed;
    fw_geometry_pose pose; /* of the part being drawn */
    bool mirror;
    const char *label;
} field;

static inline double between(field *f, double low, double high) {
    return low + (high - low) * random01(&f->seed);
}

/* ---- the rules: a layer for each role, named by it ---- */

static inline void add_rule(field *f, const fw_mask_rule_kind_row *kind, fw_layout_role layer,
                            fw_layout_role other, unsigned of, double least) {
    f->rule[f->s->table.nrule++] = (fw_mask_rule){.kind = kind,
                                                  .layer = (int)layer,
                                                  .other = other == layer ? -1 : (int)other,
                                                  .least = least,
                                                  .most = HUGE_VAL,
                                                  .of = of,
                                                  .source = "test rule",
                                                  .severity = FW_ERROR};
}

static const double DEG = PI / 180, FEATURE_M = 4.05e-6;

static inline field *field_new(uint64_t seed) {
    static const char *const name[LAYERS] = {"structure", "flexure", "frame", "tether",
                                             "text",      "mark",    "dicing"};
    scene *s = scene_new(0, 0);
    field *f = fw_arena_one(s->arena, field);
    f->s = s;
    f->seed = seed;
    for (int k = 0; k < LAYERS; k++)
        f->layer[k] = (fw_mask_layer){.layer = k + 1,
                                      .id = name[k],
                                      .name = name[k],
                                      .purpose = "test",
                                      .tone = "data dark",
                                      .colour = "#000000",
                                      .roles = 1u << k};
    s->table = (fw_mask_table){.flow = "test-flow",
                               .reading = "right-reading chrome down",
                               .layer = f->layer,
                               .nlayer = LAYERS,
                               .rule = f->rule};
    const fw_layout_role st = FW_ROLE_STRUCTURE, te = FW_ROLE_TETHER, di = FW_ROLE_DICING;
    add_rule(f, &fw_mask_kind_width, st, st, 0, 4 * UM);
    add_rule(f, &fw_mask_kind_space, st, st, 0, 4 * UM);
    add_rule(f, &fw_mask_kind_notch, st, st, 0, 5 * UM);
    add_rule(f, &fw_mask_kind_feature, FW_ROLE_FLEXURE, FW_ROLE_FLEXURE, 0, FEATURE_M);
    add_rule(f, &fw_mask_kind_area, FW_ROLE_FRAME, FW_ROLE_FRAME, FW_OF_ISLAND | FW_OF_HOLE,
             400 * UM * UM);
    add_rule(f, &fw_mask_kind_enclosure, FW_ROLE_TEXT, FW_ROLE_FRAME, 0, 6 * UM);
    add_rule(f, &fw_mask_kind_separation, FW_ROLE_MARK, FW_ROLE_FRAME, 0, 7 * UM);
    add_rule(f, &fw_mask_kind_angle, te, te, FW_OF_OUTLINE, 60 * DEG);
    add_rule(f, &fw_mask_kind_edge, te, te, FW_OF_OUTLINE, 1 * UM);
    add_rule(f, &fw_mask_kind_angle, di, di, FW_OF_POLYGON, 60 * DEG);
    add_rule(f, &fw_mask_kind_edge, di, di, FW_OF_POLYGON, 0.3 * UM);
    return f;
}

/* ---- drawing, in um in the part's own frame ---- */

static inline fw_geometry_vec2 world(const field *f, double x, double y) {
    fw_geometry_vec2 p = {x * UM, f->mirror ? -y * UM : y * UM};
    double c = cos(f->pose.angle_rad), s = sin(f->pose.angle_rad);
    return (fw_geometry_vec2){f->pose.x_m + c * p.x - s * p.y, f->pose.y_m + s * p.x + c * p.y};
}

static inline void draw(field *f, fw_layout_role role, fw_geometry_contour c) {
    fw_geometry_contour moved;
    assert_int_equal(fw_geometry_contour_transform(f->s->arena, &c, f->pose, f->mirror, &moved),
                     FW_OK);
    scene_add(f->s, role, f->label, moved);
}

static inline void draw_polygon(field *f, fw_layout_role role, const double (*p)[2], int n) {
    draw(f, role, polygon(f->s->arena, p, n));
}

static inline void draw_box(field *f, fw_layout_role role, double x0, double y0, double x1,
                            double y1) {
    const double p[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    draw_polygon(f, role, p, 4);
}

static inline void draw_disc(field *f, fw_layout_role role, double x, double y, double r) {
    fw_geometry_contour c;
    assert_int_equal(
        fw_geometry_contour_disc(f->s->arena, (fw_geometry_vec2){x * UM, y * UM}, r * UM, &c),
        FW_OK);
    draw(f, role, c);
}

static inline void draw_ring(field *f, fw_layout_role role, double inner, double outer, double from,
                             double sweep) {
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_contour_ring_sector(f->s->arena, (fw_geometry_vec2){0, 0},
                                                     inner * UM, outer * UM, from, sweep, &c),
                     FW_OK);
    draw(f, role, c);
}

static inline const fw_mask *examine(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = fw_mask_examine(s->arena, &s->layout, &s->table, "test device", &s->options,
                                       &s->diags, &mask);
    if (!mask) fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    assert_int_equal(status, mask->nbroken ? FW_INPUT : FW_OK);
    assert_true(mask->whole);
    return mask;
}

static inline void print_findings(const fw_mask *mask) {
    for (int i = 0; i < mask->nfinding && i < 5; i++) {
        const fw_mask_finding *g = &mask->finding[i];
        print_message("  %s %s %.12g of %.12g at %.6f %.6f, %.6f %.6f um: %s %d, %s %d\n",
                      g->rule->kind->name, g->what, g->value, g->needed, g->at[0].x / UM,
                      g->at[0].y / UM, g->at[1].x / UM, g->at[1].y / UM,
                      g->label[0] ? g->label[0] : "-", g->edge[0], g->label[1] ? g->label[1] : "-",
                      g->edge[1]);
    }
}

static inline fw_mask_rule window_rule(void) {
    return (fw_mask_rule){.kind = &fw_mask_kind_density,
                          .layer = FW_ROLE_DICING,
                          .other = -1,
                          .least = 0.2,
                          .most = 0.5,
                          .window_m = 100 * UM,
                          .step_m = 100 * UM,
                          .source = "test rule",
                          .severity = FW_ERROR};
}

#endif
