/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sketches in local coordinates, and what a drawing holds: its joints, slots, names and pieces. */
#include "layout/draw.h"
#include "base/text.h"
#include "layout/layout_text.h"
#include <math.h>

fw_geometry_vec2 fw_layout_local_point(const fw_layout_local *local, fw_geometry_vec2 p) {
    double y = local->mirror ? -p.y : p.y;
    return fw_v(local->origin.x + (local->c * p.x - local->s * y),
                local->origin.y + (local->s * p.x + local->c * y));
}

fw_layout_sketch fw_layout_sketch_start(fw_arena *arena, const fw_layout_local *local,
                                        fw_geometry_vec2 p) {
    return (fw_layout_sketch){fw_geometry_outline_start(arena, fw_layout_local_point(local, p)),
                              local};
}

void fw_layout_sketch_line(fw_layout_sketch *sketch, fw_geometry_vec2 to, unsigned flags) {
    fw_geometry_outline_line(&sketch->outline, fw_layout_local_point(sketch->local, to), flags);
}

void fw_layout_sketch_arc(fw_layout_sketch *sketch, fw_geometry_vec2 centre, double sweep_rad,
                          fw_geometry_vec2 to) {
    fw_geometry_outline_arc_to(&sketch->outline, fw_layout_local_point(sketch->local, centre),
                               sketch->local->mirror ? -sweep_rad : sweep_rad,
                               fw_layout_local_point(sketch->local, to), 0);
}

fw_status fw_layout_sketch_close(fw_layout_sketch *sketch, fw_geometry_contour *contour) {
    fw_geometry_contour made;
    FW_TRY(fw_geometry_outline_close(&sketch->outline, &made));
    if (fw_geometry_contour_area(&made) < 0.0)
        return fw_geometry_contour_reverse(sketch->outline.arena, &made, contour);
    *contour = made;
    return FW_OK;
}

fw_status fw_layout_polygon(fw_arena *arena, const fw_layout_local *local,
                            const fw_geometry_vec2 *p, int n, int joint,
                            fw_geometry_contour *contour) {
    fw_layout_sketch sketch = fw_layout_sketch_start(arena, local, p[0]);
    for (int i = 1; i <= n; i++)
        fw_layout_sketch_line(&sketch, p[i % n], i - 1 == joint ? FW_SEGMENT_JOINT : 0);
    return fw_layout_sketch_close(&sketch, contour);
}

/* ---- the drawing ---- */

const char *fw_layout_um(char buffer[32], double metres) {
    return fw_number_text(buffer, 32, metres * 1e6, 5);
}

const char *fw_layout_body_label(fw_layout_drawing *d, int body) {
    if (body == FW_GROUND) return "base";
    const fw_device_body *b = &d->device->body[body];
    return fw_arena_printf(d->arena, "%s %s", b->platform ? "platform" : "link", b->id);
}

fw_place fw_layout_body_place(const fw_layout_drawing *d, int body) {
    if (body >= 0) return d->device->body[body].place;
    return (fw_place){d->device->file, 0, 0};
}

fw_geometry_vec2 fw_layout_joint_point(const fw_device *device, int joint) {
    return fw_v(device->revolute[joint].x_m, device->revolute[joint].y_m);
}

/* joints of a body in the order of the file; returns how many there are */
int fw_layout_body_joints(const fw_device *device, int body, int *joint, int most) {
    int n = 0;
    for (int j = 0; j < device->nrevolute; j++)
        if (device->revolute[j].body_a == body || device->revolute[j].body_b == body) {
            if (n < most) joint[n] = j;
            n++;
        }
    return n;
}

int fw_layout_drawing_slot(const fw_layout_drawing *d, int body, int joint) {
    const fw_device *device = d->device;
    if (body != FW_GROUND) return body;
    if (fw_layout_body_joints(device, FW_GROUND, NULL, 0) <= 2) return device->nbody;
    int n = 0;
    for (int j = 0; j < joint; j++)
        n += device->revolute[j].body_a == FW_GROUND || device->revolute[j].body_b == FW_GROUND;
    return device->nbody + n;
}

const fw_geometry_contour *fw_layout_drawing_outline(const fw_layout_drawing *d, int slot) {
    return d->held[slot].count > 0 ? &d->held[slot] : &d->plain[slot];
}

fw_status fw_layout_drawing_add(fw_layout_drawing *d, fw_layout_role role, int body, int joint,
                                const char *label, const fw_geometry_contour *contour) {
    fw_layout_piece piece = {role, body, joint, label, *contour};
    FW_NEED(label);
    return fw_layout_add(d->arena, piece, &d->layout->piece, &d->layout->npiece, &d->capacity);
}

double fw_layout_base_reach(const fw_layout_drawing *d, int joint) {
    const fw_layout_hinge_plan *plan = &d->hinge[joint];
    fw_geometry_vec2 out = plan->side[plan->side[1].body == FW_GROUND].direction;
    fw_geometry_vec2 w = fw_layout_joint_point(d->device, joint);
    const fw_geometry_box *b = &d->layout->window;
    double x = out.x > 0.0 ? b->x1 - w.x : w.x - b->x0, y = out.y > 0.0 ? b->y1 - w.y : w.y - b->y0;
    return (fabs(out.x) > fabs(out.y) ? x : y) - fw_layout_rule.stub_m;
}

bool fw_layout_eyelets_on(const fw_layout_drawing *d, int body) {
    for (int i = 0; i < d->neyelet; i++)
        if (d->eyelet[i].eyelet->body == body) return true;
    return false;
}
