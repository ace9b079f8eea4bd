/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What finds no room in the drawing: kept with its place, and said (FW-D131, FW-D127). The verdict
   rejects a device whose motion has what its masks lack. docs/theory/layout.md, section 13 */
#include "layout/draw.h"
#include <math.h>

/* of a try nothing is said, nor of a device that was drawn before */
fw_status fw_layout_missing_add(fw_layout_drawing *d, fw_layout_missing item) {
    fw_layout *l = d->layout;
    size_t n = (size_t)l->nmissing;
    char x[32], y[32];
    FW_NEED(item.name && item.why ? l : NULL);
    FW_NEED(l->missing = fw_arena_grow(d->arena, l->missing, n, n + 1, sizeof *l->missing));
    l->missing[l->nmissing++] = item;
    if (d->said) return FW_OK;
    fw_diag_warning(
        d->diags, item.number, item.place,
        "%s at (%s, %s) um %s not drawn: %s; a device that lacks what it moves with or is "
        "held by is rejected",
        item.name, fw_layout_um(x, item.at.x), fw_layout_um(y, item.at.y),
        item.number == 127 ? "are" : "is", item.why);
    return FW_OK;
}

bool fw_layout_same_comb(const fw_device_comb *p, const fw_device_comb *q) {
    bool length = p->length_m == q->length_m || (isnan(p->length_m) && isnan(q->length_m));
    return p->kind == q->kind && p->body_a == q->body_a && p->body_b == q->body_b &&
           p->bx_m == q->bx_m && p->by_m == q->by_m && p->direction_rad == q->direction_rad &&
           p->fingers == q->fingers && p->gap_m == q->gap_m && p->width_m == q->width_m && length &&
           (p->kind == FW_ELECTRODES_PLATE || p->overlap_m == q->overlap_m);
}

bool fw_layout_same_eyelet(const fw_device_eyelet *p, const fw_device_eyelet *q) {
    return p->body == q->body && p->x_m == q->x_m && p->y_m == q->y_m;
}

static bool moves_scene(const fw_device_scene *s, const fw_layout_missing *m) {
    for (int i = 0; m->comb && i < s->ncomb; i++)
        if (fw_layout_same_comb(&s->comb[i], m->comb)) return true;
    for (int t = 0; m->eyelet && t < s->ntendon; t++)
        for (int k = 0; k < s->tendon[t].neyelet; k++)
            if (fw_layout_same_eyelet(&s->tendon[t].eyelet[k], m->eyelet)) return true;
    return false;
}

bool fw_layout_missing_in_flow(const fw_device *device, const fw_layout_missing *m,
                               const char *flow) {
    if (!m->comb && !m->eyelet) return true;
    for (int i = 0; i < device->nscene; i++)
        if (fw_device_in_flow(device->scene[i].flow, flow) && moves_scene(&device->scene[i], m))
            return true;
    return false;
}
