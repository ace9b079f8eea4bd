/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices built by hand, as device/ would hand them on: the reference six-bar of
   docs/gallery/reference-six-bar/device.xml and a four-bar. */
#ifndef FW_TEST_LAYOUT_FIXTURE_H
#define FW_TEST_LAYOUT_FIXTURE_H
#include "layout/layout.h"
#include <math.h>

#define NONE ((double)NAN) /* not given */

typedef struct fixture {
    fw_device device;
    fw_device_body body[10];
    fw_device_revolute revolute[10];
    fw_device_flexure flexure[10];
} fixture;

static inline fw_device_body fixture_body(const char *id, double width_m) {
    return (fw_device_body){.id = id,
                            .mass_kg = NONE,
                            .inertia_kg_m2 = NONE,
                            .x_m = NONE,
                            .y_m = NONE,
                            .width_m = width_m,
                            .plate_width_m = NONE,
                            .plate_height_m = NONE,
                            .plate_x_m = NONE,
                            .plate_y_m = NONE};
}

static inline void fixture_hinge(fixture *f, int i, const char *id, int a, int b, double x_m,
                                 double y_m, double length_m, double width_m, double angle_rad) {
    f->flexure[i] = (fw_device_flexure){.id = id,
                                        .kind = FW_FLEXURE_CSFH,
                                        .length_m = length_m,
                                        .angle_rad = angle_rad,
                                        .radius_m = length_m / angle_rad,
                                        .width_m = width_m,
                                        .gap_m = 8e-6,
                                        .fillet_m = NONE};
    f->revolute[i] = (fw_device_revolute){.id = id,
                                          .body_a = a,
                                          .body_b = b,
                                          .x_m = x_m,
                                          .y_m = y_m,
                                          .ax_m = NONE,
                                          .ay_m = NONE,
                                          .bx_m = NONE,
                                          .by_m = NONE,
                                          .stiffness_Nm_per_rad = NONE,
                                          .damping_Nms_per_rad = NONE,
                                          .flexure = i,
                                          .axis_rad = NONE};
}

static inline void fixture_finish(fixture *f, const char *name, int nbody, int njoint) {
    f->device = (fw_device){.file = "test.xml",
                            .name = name,
                            .body = f->body,
                            .revolute = f->revolute,
                            .flexure = f->flexure,
                            .nbody = nbody,
                            .nrevolute = njoint,
                            .nflexure = njoint,
                            .thickness_m = 50e-6,
                            .safety_factor = 1.5,
                            .die = {.width_m = NONE,
                                    .height_m = NONE,
                                    .frame_m = NONE,
                                    .lane_m = NONE,
                                    .clearance_m = NONE,
                                    .tethers = true}};
}

static inline void fixture_six_bar(fixture *f) {
    static const double x[] = {0.70, 0.20, 0.80, 2.20, 2.85, 2.30};
    static const double y[] = {0.15, 1.40, 2.70, 2.75, 1.45, 0.15};
    static const double length[] = {300, 250, 200, 240, 350, 400};
    static const double width[] = {9, 8.5, 8, 8, 9, 10};
    static const char *const hinge[] = {"A", "B", "C", "D", "E", "F"};
    static const char *const body[] = {"AB", "BC", "CD", "DE", "EF"};
    *f = (fixture){.device = {.file = "test.xml"}};
    for (int i = 0; i < 5; i++)
        f->body[i] = fixture_body(body[i], 120e-6);
    f->body[2].width_m = NONE;
    f->body[2].platform = true;
    f->body[2].plate_width_m = 1.4e-3;
    f->body[2].plate_height_m = 0.4e-3;
    f->body[2].plate_x_m = 1.5e-3;
    f->body[2].plate_y_m = 2.875e-3;
    for (int i = 0; i < 6; i++)
        fixture_hinge(f, i, hinge[i], i == 0 ? FW_GROUND : i - 1, i == 5 ? FW_GROUND : i,
                      x[i] * 1e-3, y[i] * 1e-3, length[i] * 1e-6, width[i] * 1e-6,
                      4.0 * M_PI / 3.0);
    fixture_finish(f, "reference-six-bar", 5, 6);
    f->device.six_bar = true;
    f->device.die.width_m = 5.6e-3;
    f->device.die.height_m = 5e-3;
    f->device.die.title = "REFERENCE SIX-BAR";
}

/* all flexures to another arc length (factor) and subtended angle */
static inline void fixture_flexures(fixture *f, double factor, double angle_deg) {
    for (int i = 0; i < f->device.nflexure; i++) {
        fw_device_flexure *x = &f->flexure[i];
        x->length_m *= factor;
        x->angle_rad = angle_deg * M_PI / 180.0;
        x->radius_m = x->length_m / x->angle_rad;
    }
}

/* crank, coupler with a plate, rocker */
static inline void fixture_four_bar(fixture *f) {
    *f = (fixture){.device = {.file = "test.xml"}};
    f->body[0] = fixture_body("crank", 100e-6);
    f->body[1] = fixture_body("coupler", 100e-6);
    f->body[2] = fixture_body("rocker", 100e-6);
    fixture_hinge(f, 0, "P", FW_GROUND, 0, 0.0, 0.0, 250e-6, 8e-6, M_PI);
    fixture_hinge(f, 1, "Q", 0, 1, 0.1e-3, 0.9e-3, 250e-6, 8e-6, M_PI);
    fixture_hinge(f, 2, "R", 1, 2, 1.3e-3, 1.1e-3, 250e-6, 8e-6, M_PI);
    fixture_hinge(f, 3, "S", 2, FW_GROUND, 1.5e-3, 0.0, 250e-6, 8e-6, M_PI);
    fixture_finish(f, "four-bar", 3, 4);
}

/* stage on three legs of two links (3-RRR): a body with three hinges, three ground hinges */
static inline void fixture_stage(fixture *f) {
    static const char *const link[] = {"upper 1", "upper 2", "upper 3",
                                       "lower 1", "lower 2", "lower 3"};
    static const char *const hinge[] = {"G1", "K1", "S1", "G2", "K2", "S2", "G3", "K3", "S3"};
    *f = (fixture){.device = {.file = "test.xml"}};
    for (int i = 0; i < 6; i++)
        f->body[i] = fixture_body(link[i], 100e-6);
    f->body[6] = fixture_body("stage", 140e-6);
    for (int i = 0; i < 3; i++) {
        double a = (90.0 + 120.0 * i) * M_PI / 180.0, b = a + 0.5, r = 0.6e-3;
        fixture_hinge(f, 3 * i, hinge[3 * i], FW_GROUND, 3 + i, 1.6e-3 * cos(a + 1.0),
                      1.6e-3 * sin(a + 1.0), 250e-6, 8e-6, M_PI);
        fixture_hinge(f, 3 * i + 1, hinge[3 * i + 1], 3 + i, i, 1.65e-3 * cos(b), 1.65e-3 * sin(b),
                      250e-6, 8e-6, M_PI);
        fixture_hinge(f, 3 * i + 2, hinge[3 * i + 2], i, 6, r * cos(a), r * sin(a), 250e-6, 8e-6,
                      M_PI);
    }
    fixture_finish(f, "stage", 7, 9);
}

/* a plate on one hinge, turned by 30 degrees */
static inline void fixture_paddle(fixture *f) {
    *f = (fixture){.device = {.file = "test.xml"}};
    f->body[0] = fixture_body("paddle", NONE);
    f->body[0].plate_width_m = 0.8e-3;
    f->body[0].plate_height_m = 0.5e-3;
    f->body[0].plate_x_m = 0.5e-3;
    f->body[0].plate_y_m = 0.3e-3;
    f->body[0].plate_angle_rad = M_PI / 6.0;
    f->body[0].platform = true;
    fixture_hinge(f, 0, "H", FW_GROUND, 0, 0.0, 0.0, 250e-6, 8e-6, M_PI);
    fixture_finish(f, "paddle", 1, 1);
}
#endif
