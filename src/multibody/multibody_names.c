/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a block of constraints is called in the description, and where it stands there. */
#include "multibody/model.h"

const char *fw_multibody_block_name(const fw_mechanism *m, const fw_multibody_block *b) {
    const char *id = b->pin != FW_NONE     ? m->pin[b->pin].id
                     : b->joint != FW_NONE ? m->joint[b->joint].id
                                           : m->driver[b->driver].id;
    return id ? id : "(unnamed)";
}

fw_place fw_multibody_block_place(const fw_mechanism *m, const fw_multibody_block *b) {
    const fw_device *d = m->device;
    if (b->driver != FW_NONE) return m->driver[b->driver].place;
    if (b->joint != FW_NONE) return m->joint[b->joint].place;
    return d && b->pin < d->nrevolute ? d->revolute[b->pin].place : (fw_place){0};
}
