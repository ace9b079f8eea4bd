/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A small die with a frame in two halves, lettering, a mark and a lane, and wafers of it. */
#ifndef FW_TEST_PLATE_H
#define FW_TEST_PLATE_H
#include "layout/layout.h"
#include "mask/scene.h"
#include "wafer/wafer.h"

enum { MOST_VARIANTS = 16 };

typedef struct plate {
    fw_arena *arena;
    fw_diags diags;
    fw_mask_layer layer[5];
    fw_mask_table table;
    fw_device device;
    fw_device_parameter parameter[2];
    fw_wafer_variant variant[MOST_VARIANTS];
    fw_wafer_input input;
    const char *lettering; /* of the dies of sweeps */
} plate;

static inline fw_mask_layer layer_of(int number, const char *id, unsigned roles, bool biased) {
    return (fw_mask_layer){.layer = number,
                           .id = id,
                           .name = id,
                           .purpose = "test",
                           .tone = "data dark",
                           .colour = "#3d6aa8",
                           .roles = roles,
                           .biased = biased,
                           .min_width_m = 4e-6,
                           .min_space_m = 4e-6,
                           .rule_source = "test rule"};
}

static inline fw_geometry_contour loop(fw_arena *arena, const double (*p)[3], int n) {
    fw_geometry_outline o =
        fw_geometry_outline_start(arena, (fw_geometry_vec2){p[0][0] * UM, p[0][1] * UM});
    for (int i = 1; i <= n; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){p[i % n][0] * UM, p[i % n][1] * UM},
                                 p[i % n][2] != 0 ? FW_SEGMENT_JOINT : 0);
    fw_geometry_contour c = {0};
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    return c;
}

typedef struct pieces {
    fw_layout_piece *piece;
    int count, capacity;
} pieces;

static inline void put_piece(plate *p, pieces *list, fw_layout_role role,
                             fw_geometry_contour contour) {
    fw_layout_piece item = {role, FW_NONE - 1, FW_NONE, "piece", contour};
    assert_int_equal(fw_layout_add(p->arena, item, &list->piece, &list->count, &list->capacity),
                     FW_OK);
}

static inline void put_box(plate *p, pieces *list, fw_layout_role role, double x0, double y0,
                           double x1, double y1) {
    const double q[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    put_piece(p, list, role, polygon(p->arena, q, 4));
}

static double die_um[2] = {2000, 1600};

/* die of 2000 um x 1600 um, or die_um, about (300, -200) um with a lane of 50 um, a frame of `bar` um in halves
   that share two joints, a disc of `radius` um in the window */
static inline const fw_mask *die_mask(plate *p, double bar, double radius, const char *title,
                                      bool rejected, fw_geometry_box *die,
                                      fw_geometry_box *window) {
    pieces list = {0};
    const double wide = 0.5 * die_um[0], high = 0.5 * die_um[1], l = 50, in = l + bar, m = -200;
    const double x0 = 300 - wide, x1 = 300 + wide, y0 = m - high, y1 = m + high;
    *die = (fw_geometry_box){x0 * UM, y0 * UM, x1 * UM, y1 * UM};
    *window = (fw_geometry_box){(x0 + in) * UM, (y0 + in) * UM, (x1 - in) * UM, (y1 - in) * UM};
    const double lower[8][3] = {{x0 + l, y0 + l, 0}, {x1 - l, y0 + l, 0},   {x1 - l, m, 0},
                                {x1 - in, m, 1},     {x1 - in, y0 + in, 0}, {x0 + in, y0 + in, 0},
                                {x0 + in, m, 0},     {x0 + l, m, 1}};
    const double upper[8][3] = {{x1 - l, m, 1},        {x1 - l, y1 - l, 0}, {x0 + l, y1 - l, 0},
                                {x0 + l, m, 0},        {x0 + in, m, 1},     {x0 + in, y1 - in, 0},
                                {x1 - in, y1 - in, 0}, {x1 - in, m, 0}};
    put_piece(p, &list, FW_ROLE_FRAME, loop(p->arena, lower, 8));
    put_piece(p, &list, FW_ROLE_FRAME, loop(p->arena, upper, 8));
    fw_geometry_contour disc;
    assert_int_equal(fw_geometry_contour_disc(p->arena, (fw_geometry_vec2){300 * UM, -200 * UM},
                                              radius * UM, &disc),
                     FW_OK);
    put_piece(p, &list, FW_ROLE_STRUCTURE, disc);
    put_box(p, &list, FW_ROLE_MARK, x0 + l + 20, y0 + l + 20, x0 + l + 60, y0 + l + 60);
    double stroke = 6e-6;
    assert_int_equal(fw_layout_text(p->arena, title,
                                    (fw_geometry_vec2){(x0 + in) * UM, (y0 + l + 20) * UM},
                                    9 * stroke, stroke, FW_ROLE_TEXT, "title", &list.piece,
                                    &list.count, &list.capacity),
                     FW_OK);
    put_box(p, &list, FW_ROLE_DICING, x0, y0, x1, y0 + l);
    fw_layout layout = {.drawn = true, .piece = list.piece, .npiece = list.count};
    fw_mask_options options = p->input.mask;
    options.rejected = rejected;
    const fw_mask *mask = NULL;
    if (fw_mask_build(p->arena, &layout, &p->table, "tiny", &options, &p->diags, &mask) != FW_OK)
        fail_msg("%s", p->diags.count ? p->diags.item[0].message : "no mask");
    return mask;
}

/* a wafer of 50.8 mm; sweeps are added by the tests */
static inline plate *plate_new(double bar) {
    fw_arena *arena = fw_arena_new(0);
    plate *p = fw_arena_one(arena, plate);
    double none = (double)NAN;
    p->arena = arena;
    p->diags = fw_diags_new(arena);
    p->lettering = "TINY";
    p->layer[0] = layer_of(1, "device", 0xf, true);
    p->layer[1] = layer_of(2, "text", 1u << FW_ROLE_TEXT, false);
    p->layer[2] = layer_of(3, "marks", 1u << FW_ROLE_MARK, false);
    p->layer[3] = layer_of(4, "lane", 1u << FW_ROLE_DICING, false);
    p->layer[4] = layer_of(63, "notes", 0, false);
    p->layer[4].documentation = true;
    p->layer[4].min_width_m = p->layer[4].min_space_m = 0;
    p->table = (fw_mask_table){.flow = "test-flow",
                               .reading = "right-reading chrome down",
                               .layer = p->layer,
                               .nlayer = 5,
                               .plate = "1/0 NOT 2/0 NOT 3/0"};
    p->parameter[0] = (fw_device_parameter){.name = "arc", .dimension = {.rad = 1}, .unit = "deg"};
    p->parameter[1] = (fw_device_parameter){.name = "link", .dimension = {.m = 1}, .unit = "um"};
    p->device = (fw_device){.name = "tiny device", .parameter = p->parameter, .nparameter = 2};
    p->device.wafer = (fw_device_wafer_asked){.asked = true,
                                              .diameter_m = 50.8e-3,
                                              .flat_m = none,
                                              .edge_m = 3e-3,
                                              .pitch_x_m = none,
                                              .pitch_y_m = none,
                                              .plate_m = none,
                                              .order = {.scale = 1,
                                                        .size_m = none,
                                                        .thickness_m = none,
                                                        .cd_m = none,
                                                        .registration_m = none,
                                                        .defect_m = none,
                                                        .quantity = 1},
                                              .title = "TINY PLATE"};
    p->input = (fw_wafer_input){.device = &p->device,
                                .table = &p->table,
                                .variant = p->variant,
                                .nvariant = 1,
                                .mask = {.bias_m = 1.1e-6}};
    fw_wafer_variant *v = &p->input.stand_in;
    v->mask = die_mask(p, bar, 300, "TINY", false, &v->die, &v->window);
    v->decision = "accept";
    v->utilisation = 0.5;
    p->variant[0] = *v;
    return p;
}

/* n x m different dies */
static inline void plate_sweep(plate *p, double bar, int n, int m) {
    p->device.wafer.sweep[0] = (fw_device_sweep){.parameter = 0, .unit = "deg", .steps = n};
    p->device.wafer.sweep[1] = (fw_device_sweep){.parameter = 1, .unit = "um", .steps = m};
    p->device.wafer.nsweep = m > 1 ? 2 : 1;
    p->input.nvariant = n * m;
    for (int i = 0; i < n * m; i++) {
        fw_wafer_variant *v = &p->variant[i];
        v->mask = die_mask(p, bar, 200 + 10 * i, p->lettering, false, &v->die, &v->window);
        v->decision = i == 1 ? "inconclusive" : "accept";
        v->utilisation = 0.5 + 0.01 * i;
        v->value[0] = (100 + 10.0 * (i % n)) * PI / 180;
        v->value[1] = (10 + 5.0 * (i / n)) * UM;
    }
}

static inline const fw_wafer *plate_build(plate *p) {
    const fw_wafer *w = NULL;
    if (fw_wafer_build(p->arena, &p->input, &p->diags, &w) != FW_OK)
        fail_msg("%s", p->diags.count ? p->diags.item[p->diags.count - 1].message : "no wafer");
    return w;
}

#endif
