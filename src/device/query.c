/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/device.h"
#include <math.h>
#include <string.h>

bool fw_device_in_flow(const char *asked, const char *flow) {
    return !asked || (flow && strcmp(asked, flow) == 0);
}

bool fw_device_needs_shapes(const fw_device *device) {
    for (int i = 0; i < device->nbody; i++) {
        const fw_body *b = &device->body[i];
        if (isnan(b->mass_kg) || isnan(b->inertia_kg_m2) || isnan(b->x_m) || isnan(b->y_m))
            return true;
    }
    return false;
}
