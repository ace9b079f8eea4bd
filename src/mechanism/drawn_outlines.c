/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probes between outlines need what is drawn of both sides. */
#include "mechanism/builder.h"

static const char *name_of(const fw_device *d, int body) {
    return body < 0 ? "ground" : d->body[body].id;
}

/* of a layout that cannot be made nothing is said here: its own errors say why */
fw_status fw_mechanism_check_outlines(const fw_mechanism_builder *b) {
    const fw_device *d = b->device;
    const fw_layout *layout = b->layout;
    fw_status status = FW_OK;
    if (!layout || layout->nfault > 0) return FW_OK;
    for (int i = 0; i < d->nprobe; i++) {
        const fw_device_probe *p = &d->probe[i];
        if (fw_device_probe_kinds[p->row].takes != FW_PROBE_OUTLINES) continue;
        const int side[2] = {p->body, p->body_b};
        for (int k = 0; k < 2; k++) {
            if (layout->drawn && fw_layout_has_outline(layout, side[k])) continue;
            status = FW_INPUT;
            if (fw_mechanism_said_already(b->diags, 323, p->place)) break;
            fw_diag_error(
                b->diags, 323, p->place,
                "probe '%s': nothing is drawn of %s%s%s, so that it has no outline; draw it, or "
                "give points: kind=\"distance\" or \"opening\"",
                p->id ? p->id : "", fw_mechanism_name_or_none(name_of(d, side[k])),
                !layout->drawn && layout->why_not ? ": " : "",
                !layout->drawn && layout->why_not ? layout->why_not : "");
            break;
        }
    }
    return status;
}
