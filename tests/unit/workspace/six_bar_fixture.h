/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A six-bar mechanism from six hinge points, for tests of the workspace. */
#ifndef FW_TEST_SIX_BAR_FIXTURE_H
#define FW_TEST_SIX_BAR_FIXTURE_H
#include "workspace/loop.h"

typedef struct six_bar_fixture {
    fw_device device;
    fw_mechanism_variant variant;
    fw_mechanism_mass body[5];
    fw_mechanism_pin pin[6];
    fw_mechanism mechanism;
    fw_device_workspace_box box;
} six_bar_fixture;

/* p: A..F in um; the platform's reference point is the middle of C and D */
static inline void six_bar_make(six_bar_fixture *f, const double p[6][2]) {
    *f = (six_bar_fixture){0};
    for (int i = 0; i < 5; i++) {
        f->body[i].x_m = 0.5e-6 * (p[i][0] + p[i + 1][0]);
        f->body[i].y_m = 0.5e-6 * (p[i][1] + p[i + 1][1]);
    }
    for (int i = 0; i < 6; i++) {
        fw_mechanism_pin *pin = &f->pin[i];
        pin->body_a = i - 1; /* A: ground -1 -> 0 .. F: 4 -> ground */
        pin->body_b = i == 5 ? FW_GROUND : i;
        double x = p[i][0] * 1e-6, y = p[i][1] * 1e-6;
        pin->ax_m = i == 0 ? x : x - f->body[i - 1].x_m;
        pin->ay_m = i == 0 ? y : y - f->body[i - 1].y_m;
        pin->bx_m = i == 5 ? x : x - f->body[i].x_m;
        pin->by_m = i == 5 ? y : y - f->body[i].y_m;
        pin->hinge = FW_NONE;
    }
    f->device.six_bar = true;
    f->device.workspace = &f->box;
    f->mechanism = (fw_mechanism){.device = &f->device,
                                  .variant = &f->variant,
                                  .body = f->body,
                                  .pin = f->pin,
                                  .nbody = 5,
                                  .npin = 6};
}

static const double six_bar_reference[6][2] = {{-700, -1000}, {-1200, 0}, {-400, 700},
                                               {400, 700},    {1200, 0},  {700, -1000}};
#endif
