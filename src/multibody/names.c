/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a block of constraints is called in the description, and where it stands there. */
#include "multibody/model.h"

const char *fw_block_name(const fw_mechanism *m, const fw_block *b) {
    const char *id = b->pin != FW_NONE   ? m->pin[b->pin].id
                     : b->tie != FW_NONE ? m->tie[b->tie].id
                                         : m->driver[b->driver].id;
    return id ? id : "(unnamed)";
}

fw_place fw_block_place(const fw_mechanism *m, const fw_block *b) {
    const fw_device *d = m->device;
    if (b->driver != FW_NONE) return m->driver[b->driver].place;
    if (b->tie != FW_NONE) return m->tie[b->tie].place;
    return d && b->pin < d->njoint ? d->joint[b->pin].place : (fw_place){0};
}
