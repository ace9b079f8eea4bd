/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include "base/text.h"
#include "layout/text.h"
#include <math.h>

fw_vec2 fw_local_point(const fw_local *local, fw_vec2 p) {
    double y = local->mirror ? -p.y : p.y;
    return fw_v(local->origin.x + (local->c * p.x - local->s * y),
                local->origin.y + (local->s * p.x + local->c * y));
}

fw_sketch fw_sketch_start(fw_arena *arena, const fw_local *local, fw_vec2 p) {
    return (fw_sketch){fw_outline_start(arena, fw_local_point(local, p)), local};
}

void fw_sketch_line(fw_sketch *sketch, fw_vec2 to, unsigned flags) {
    fw_outline_line(&sketch->outline, fw_local_point(sketch->local, to), flags);
}

void fw_sketch_arc(fw_sketch *sketch, fw_vec2 centre, double sweep_rad, fw_vec2 to) {
    fw_outline_arc_to(&sketch->outline, fw_local_point(sketch->local, centre),
                      sketch->local->mirror ? -sweep_rad : sweep_rad,
                      fw_local_point(sketch->local, to), 0);
}

fw_status fw_sketch_close(fw_sketch *sketch, fw_contour *contour) {
    fw_contour made;
    FW_TRY(fw_outline_close(&sketch->outline, &made));
    if (fw_contour_area(&made) < 0.0)
        return fw_contour_reverse(sketch->outline.arena, &made, contour);
    *contour = made;
    return FW_OK;
}

fw_status fw_layout_polygon(fw_arena *arena, const fw_local *local, const fw_vec2 *p, int n,
                            int joint, fw_contour *contour) {
    fw_sketch sketch = fw_sketch_start(arena, local, p[0]);
    for (int i = 1; i <= n; i++)
        fw_sketch_line(&sketch, p[i % n], i - 1 == joint ? FW_SEGMENT_JOINT : 0);
    return fw_sketch_close(&sketch, contour);
}

const char *fw_layout_um(char buffer[32], double metres) {
    return fw_number_text(buffer, 32, metres * 1e6, 5);
}

const char *fw_body_label(fw_drawing *d, int body) {
    if (body == FW_GROUND) return "base";
    const fw_body *b = &d->device->body[body];
    return fw_arena_printf(d->arena, "%s %s", b->platform ? "platform" : "link", b->id);
}

fw_place fw_body_place(const fw_drawing *d, int body) {
    if (body >= 0) return d->device->body[body].place;
    return (fw_place){d->device->file, 0, 0};
}

fw_vec2 fw_joint_point(const fw_device *device, int joint) {
    return fw_v(device->joint[joint].x_m, device->joint[joint].y_m);
}

/* joints of a body in the order of the file; returns how many there are */
int fw_body_joints(const fw_device *device, int body, int *joint, int most) {
    int n = 0;
    for (int j = 0; j < device->njoint; j++)
        if (device->joint[j].body_a == body || device->joint[j].body_b == body) {
            if (n < most) joint[n] = j;
            n++;
        }
    return n;
}

int fw_drawing_slot(const fw_drawing *d, int body, int joint) {
    const fw_device *device = d->device;
    if (body != FW_GROUND) return body;
    if (fw_body_joints(device, FW_GROUND, NULL, 0) <= 2) return device->nbody;
    int n = 0;
    for (int j = 0; j < joint; j++)
        n += device->joint[j].body_a == FW_GROUND || device->joint[j].body_b == FW_GROUND;
    return device->nbody + n;
}

const fw_contour *fw_drawing_outline(const fw_drawing *d, int slot) {
    return d->held[slot].count > 0 ? &d->held[slot] : &d->plain[slot];
}

fw_status fw_drawing_add(fw_drawing *d, fw_role role, int body, int joint, const char *label,
                         const fw_contour *contour) {
    fw_piece piece = {role, body, joint, label, *contour};
    FW_NEED(label);
    return fw_layout_add(d->arena, piece, &d->layout->piece, &d->layout->npiece, &d->capacity);
}
