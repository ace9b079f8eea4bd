/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tethers: fingers that hold the moving bodies on the frame until they are broken at their necks.
 */
#include "layout/draw.h"
#include <math.h>

static bool finger_is_clear(const fw_drawing *d, const fw_contour *finger, int body) {
    for (int s = 0; s < d->nslot; s++) {
        if (s == body || d->plain[s].count == 0) continue;
        if (fw_contour_distance(finger, &d->plain[s], NULL, NULL) < 20e-6) return false;
    }
    for (int i = 0; i < d->nlug; i++)
        if (fw_contour_distance(finger, &d->lug[i], NULL, NULL) < 20e-6) return false;
    for (int i = 0; i < d->nattachment; i++) {
        const fw_attachment *a = &d->attachment[i];
        if (a->finger.count > 0 && fw_contour_distance(finger, &a->finger, NULL, NULL) < 60e-6)
            return false;
    }
    fw_box box = fw_contour_box(finger); /* axis-parallel, so the box is the finger */
    for (int j = 0; j < d->device->njoint; j++) {
        const fw_hinge_layout *h = &d->layout->hinge[j];
        double x = fmax(fmax(box.x0 - h->centre.x, h->centre.x - box.x1), 0.0);
        double y = fmax(fmax(box.y0 - h->centre.y, h->centre.y - box.y1), 0.0);
        if (hypot(x, y) < h->keep_out_m + 10e-6) return false;
    }
    return true;
}

/* the finger may leave its own body only once: everything from a little outside on is free */
static bool leaves_once(const fw_drawing *d, const fw_attachment *a, fw_vec2 from) {
    const fw_contour *body = &d->plain[a->body];
    fw_vec2 out = fw_window_outward(a->side);
    fw_vec2 side = fw_left(out);
    double length = fw_dot(fw_sub(fw_window_point(d->layout, a->side, 0.0, 0.0), from), out);
    for (int edge = -1; edge <= 1; edge++) {
        bool inside = true;
        for (double s = 0.0; s < length; s += 2e-6) {
            fw_vec2 p = fw_add(fw_add(from, s, out), edge * (0.5 * FW_TETHER_M + 8e-6), side);
            bool in = fw_contour_contains(body, p);
            if (in && !inside) return false;
            inside = in;
        }
        if (inside) return false;
    }
    return fw_contour_contains(body, from);
}

static fw_status try_finger(fw_drawing *d, int body, fw_window_side side, fw_vec2 from,
                            bool *done) {
    fw_attachment a = {.body = body};
    bool up = side == FW_LEFT || side == FW_RIGHT;
    double start = up ? from.x : from.y, along = up ? from.y : from.x;
    *done = false;
    FW_TRY(fw_strip_draw(d, side, start, start, along, 0.5 * FW_TETHER_M, 0.5 * FW_TETHER_NECK_M,
                         FW_TETHER_STUB_M, &a));
    if (!leaves_once(d, &a, from) || !finger_is_clear(d, &a.finger, body)) return FW_OK;
    *done = true;
    return fw_attachment_add(d, &a);
}

static void sides_by_distance(const fw_layout *l, fw_vec2 p, fw_window_side order[4]) {
    double far[4];
    for (int i = 0; i < 4; i++) {
        fw_window_side s = (fw_window_side)i;
        far[i] = fw_dot(fw_sub(fw_window_point(l, s, 0.0, 0.0), p), fw_window_outward(s));
        int k = i;
        for (; k > 0 && far[order[k - 1]] > far[i] + 1e-9; k--)
            order[k] = order[k - 1];
        order[k] = s;
    }
}

/* two fingers in mirrored places on the nearest side where that works, else any two, else one */
static fw_status hold_plate(fw_drawing *d, int body, int *held) {
    const fw_body *b = &d->device->body[body];
    static const double place[] = {0.14, 0.22, 0.07, 0.3, 0.38};
    fw_vec2 middle = fw_v(b->plate_x_m, b->plate_y_m), x = fw_polar(b->plate_angle_rad);
    fw_window_side order[4];
    sides_by_distance(d->layout, middle, order);
    for (int s = 0; s < 4 && *held < 2; s++) {
        fw_vec2 out = fw_window_outward(order[s]), y = fw_left(x);
        bool across = fabs(fw_dot(out, y)) > fabs(fw_dot(out, x));
        fw_vec2 along = across ? x : y;
        double size = across ? b->plate_width_m : b->plate_height_m;
        for (size_t i = 0; i < sizeof place / sizeof place[0] && *held < 2; i++)
            for (int sign = -1; sign <= 1 && *held < 2; sign += 2) {
                bool done;
                FW_TRY(try_finger(d, body, order[s], fw_add(middle, sign * place[i] * size, along),
                                  &done));
                *held += done;
            }
    }
    return FW_OK;
}

/* one finger from the bar of a link, near its middle */
static fw_status hold_bar(fw_drawing *d, int body, int *held) {
    int joint[2];
    static const double place[] = {0.5, 0.42, 0.58, 0.35, 0.65};
    if (fw_body_joints(d->device, body, joint, 2) != 2) return FW_OK;
    fw_vec2 p = fw_joint_point(d->device, joint[0]), q = fw_joint_point(d->device, joint[1]);
    fw_window_side order[4];
    sides_by_distance(d->layout, fw_v(0.5 * (p.x + q.x), 0.5 * (p.y + q.y)), order);
    for (int s = 0; s < 4 && *held < 1; s++) {
        fw_vec2 along = fw_towards(p, q), out = fw_window_outward(order[s]);
        if (fabs(fw_dot(along, out)) > 0.8) continue; /* would run along the bar */
        for (size_t i = 0; i < sizeof place / sizeof place[0] && *held < 1; i++) {
            bool done;
            FW_TRY(try_finger(d, body, order[s], fw_add(p, place[i], fw_sub(q, p)), &done));
            *held += done;
        }
    }
    return FW_OK;
}

/* platforms first. A body that no finger reaches freely stays without; a platform without is worth
   a warning. */
fw_status fw_tethers_draw(fw_drawing *d) {
    if (!d->device->die.tethers) return FW_OK;
    for (int pass = 0; pass < 2; pass++)
        for (int b = 0; b < d->device->nbody; b++) {
            bool plate = !isnan(d->device->body[b].plate_width_m);
            int held = 0;
            if (plate != (pass == 0)) continue;
            if (plate)
                FW_TRY(hold_plate(d, b, &held));
            else
                FW_TRY(hold_bar(d, b, &held));
            if (!plate || held > 0) continue;
            const char *label = fw_body_label(d, b);
            FW_NEED(label);
            fw_diag_warning(d->diags, 127, d->device->body[b].place,
                            "%s has no tether: none of the window's sides is reached without "
                            "crossing another part; handle the released device with care",
                            label);
        }
    return FW_OK;
}
