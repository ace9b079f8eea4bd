/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hand-made pieces and layer tables for the tests of mask/. */
#ifndef FW_TEST_SCENE_H
#define FW_TEST_SCENE_H
#include "mask/mask_parts.h"
#include "test.h"

#define UM 1e-6
#define PI 3.14159265358979323846

typedef struct scene {
    fw_arena *arena;
    fw_diags diags;
    fw_layout_piece piece[512];
    fw_layout layout;
    fw_mask_layer layer[3];
    fw_mask_table table;
    fw_mask_options options;
} scene;

/* layer 1/0 biased: structure, flexure, frame, tether; 2/0 the other roles; 63/0 notes */
static inline scene *scene_new(double width_rule_m, double space_rule_m) {
    fw_arena *arena = fw_arena_new(0);
    scene *s = fw_arena_one(arena, scene);
    s->arena = arena;
    s->diags = fw_diags_new(arena);
    s->layer[0] = (fw_mask_layer){.layer = 1,
                                  .id = "device",
                                  .name = "DEVICE",
                                  .purpose = "test",
                                  .tone = "data dark",
                                  .colour = "#3d6aa8",
                                  .roles = 0xf,
                                  .biased = true,
                                  .min_width_m = width_rule_m,
                                  .min_space_m = space_rule_m,
                                  .rule_source = "test rule"};
    s->layer[1] = (fw_mask_layer){.layer = 2,
                                  .id = "text",
                                  .name = "TEXT",
                                  .purpose = "letters",
                                  .tone = "data clear",
                                  .colour = "#5b6770",
                                  .roles = 0x70,
                                  .min_width_m = width_rule_m,
                                  .min_space_m = space_rule_m,
                                  .rule_source = "test rule"};
    s->layer[2] = (fw_mask_layer){.layer = 63,
                                  .id = "notes",
                                  .name = "NOTES",
                                  .purpose = "notes",
                                  .tone = "data dark",
                                  .colour = "#000000",
                                  .documentation = true};
    s->table = (fw_mask_table){.flow = "test-flow",
                               .reading = "right-reading chrome down",
                               .layer = s->layer,
                               .nlayer = 3};
    s->layout = (fw_layout){.drawn = true, .piece = s->piece};
    return s;
}

static inline void scene_free(scene *s) {
    fw_arena_free(s->arena);
}

static inline void scene_add(scene *s, fw_layout_role role, const char *label,
                             fw_geometry_contour contour) {
    s->piece[s->layout.npiece++] = (fw_layout_piece){role, FW_NONE - 1, FW_NONE, label, contour};
}

static inline fw_geometry_contour polygon(fw_arena *arena, const double (*p)[2], int n) {
    fw_geometry_outline o =
        fw_geometry_outline_start(arena, (fw_geometry_vec2){p[0][0] * UM, p[0][1] * UM});
    for (int i = 1; i < n; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){p[i][0] * UM, p[i][1] * UM}, 0);
    fw_geometry_contour c = {0};
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

static inline void scene_box(scene *s, const char *label, double x0, double y0, double x1,
                             double y1) {
    const double p[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    scene_add(s, FW_ROLE_STRUCTURE, label, polygon(s->arena, p, 4));
}

/* half ring about the origin through its corners, inner and outer at either end, anticlockwise from the first; its ends are joints */
static inline fw_geometry_contour scene_half_ring(fw_arena *arena, const fw_geometry_vec2 corner[4]) {
    const fw_geometry_vec2 o = {0, 0};
    fw_geometry_outline a = fw_geometry_outline_start(arena, corner[0]);
    fw_geometry_outline_line(&a, corner[1], FW_SEGMENT_JOINT);
    fw_geometry_outline_arc_to(&a, o, PI, corner[2], 0);
    fw_geometry_outline_line(&a, corner[3], FW_SEGMENT_JOINT);
    fw_geometry_outline_arc_to(&a, o, -PI, corner[0], 0);
    fw_geometry_contour ring;
    assert_int_equal(fw_geometry_outline_close(&a, &ring), FW_OK);
    return ring;
}

/* half ring about the origin above y = 0 between two legs that go down by `leg`, all `width` wide;
   the ends of the ring are joints */
static inline void scene_arch(scene *s, double radius, double width, double leg) {
    double ri = (radius - 0.5 * width) * UM, ro = (radius + 0.5 * width) * UM;
    fw_geometry_vec2 corner[4] = {{ri, 0}, {ro, 0}, {-ro, 0}, {-ri, 0}};
    scene_add(s, FW_ROLE_FLEXURE, "arch", scene_half_ring(s->arena, corner));
    for (int side = 0; side < 2; side++) {
        fw_geometry_vec2 left = corner[2 * side], right = corner[2 * side + 1];
        fw_geometry_outline b =
            fw_geometry_outline_start(s->arena, (fw_geometry_vec2){left.x, -leg * UM});
        fw_geometry_outline_line(&b, (fw_geometry_vec2){right.x, -leg * UM}, 0);
        fw_geometry_outline_line(&b, right, 0);
        fw_geometry_outline_line(&b, left, FW_SEGMENT_JOINT);
        fw_geometry_outline_line(&b, (fw_geometry_vec2){left.x, -leg * UM}, 0);
        fw_geometry_contour stub;
        assert_int_equal(fw_geometry_outline_close(&b, &stub), FW_OK);
        scene_add(s, FW_ROLE_STRUCTURE, side ? "left leg" : "right leg", stub);
    }
}

static inline fw_status scene_build(scene *s, const fw_mask **mask) {
    return fw_mask_build(s->arena, &s->layout, &s->table, "test device", &s->options, &s->diags,
                         mask);
}

static inline const char *scene_first(const scene *s, int number) {
    for (size_t i = 0; i < s->diags.count; i++)
        if (s->diags.item[i].number == number) return s->diags.item[i].message;
    fail_msg("FW-D%03d was not reported; first message: %s", number,
             s->diags.count ? s->diags.item[0].message : "none");
    return "";
}

static inline void assert_says(const char *message, const char *part) {
    if (!strstr(message, part)) fail_msg("\"%s\" does not say \"%s\"", message, part);
}

/* small fixed pseudo-random numbers: the same everywhere */
static inline double random01(uint64_t *seed) {
    *seed = *seed * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

#endif
