/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a finger of the frame may reach a body, before anything of it is drawn. */
#include "geometry/segment.h"
#include "layout/tether_finger.h"
#include <math.h>

bool fw_layout_finger_is_clear(const fw_layout_drawing *d, const fw_geometry_contour *finger,
                               int body) {
    const double space = fw_layout_rule.strip_clear_m, between = fw_layout_rule.fingers_apart_m;
    for (int s = 0; s < d->nslot; s++) {
        if (s == body || d->plain[s].count == 0) continue;
        if (fw_geometry_contour_distance_below(finger, &d->plain[s], space, NULL, NULL) < space)
            return false;
    }
    for (int i = 0; i < d->nlug; i++)
        if (fw_geometry_contour_distance_below(finger, &d->lug[i], space, NULL, NULL) < space)
            return false;
    for (int i = 0; i < d->nattachment; i++) {
        const fw_layout_attachment *a = &d->attachment[i];
        if (a->finger.count > 0 &&
            fw_geometry_contour_distance_below(finger, &a->finger, between, NULL, NULL) < between)
            return false;
    }
    fw_geometry_box box =
        fw_geometry_contour_box(finger); /* axis-parallel, so the box is the finger */
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        double x = fmax(fmax(box.x0 - h->centre.x, h->centre.x - box.x1), 0.0);
        double y = fmax(fmax(box.y0 - h->centre.y, h->centre.y - box.y1), 0.0);
        if (hypot(x, y) < h->keep_out_m + fw_layout_rule.strip_disc_m) return false;
    }
    return true;
}

enum { FEW = 128 };

/* a lower bound of the distance from an outline: no segment's box is nearer */
static double clear_way(const fw_geometry_contour *c, const fw_geometry_box *box,
                        fw_geometry_vec2 p) {
    fw_geometry_box at = {p.x, p.y, p.x, p.y};
    double least = HUGE_VAL;
    for (int i = 0; i < c->count; i++) {
        fw_geometry_box own = i < FEW ? box[i] : fw_segment_box(&c->segment[i]);
        if (fw_box_apart(&at, &own, least)) continue;
        double gap = fw_box_gap(at, own);
        if (gap < least) gap = fmax(gap, fw_geometry_segment_clear_of(&c->segment[i], &at));
        if (gap < least) least = gap;
    }
    return least;
}

/* looked at every 2 um, but where no edge is near for longer */
bool fw_layout_finger_leaves_once(const fw_layout_drawing *d, const fw_layout_attachment *a,
                                  fw_geometry_vec2 from) {
    const fw_geometry_contour *body = &d->plain[a->body];
    fw_geometry_vec2 out = fw_layout_window_outward(a->side);
    fw_geometry_vec2 side = fw_left(out);
    double length = fw_dot(fw_sub(fw_layout_window_point(d->layout, a->side, 0.0, 0.0), from), out);
    fw_geometry_box box = fw_geometry_contour_box(body), own[FEW];
    for (int i = 0; i < body->count && i < FEW; i++)
        own[i] = fw_segment_box(&body->segment[i]);
    const double beside = 0.5 * fw_layout_rule.tether_m + fw_layout_rule.finger_beside_m;
    for (int edge = -1; edge <= 1; edge++) {
        bool inside = true;
        double known = -1.0; /* up to there nothing changes */
        for (double s = 0.0; s < length; s += fw_layout_rule.finger_step_m) {
            if (s < known) continue;
            fw_geometry_vec2 p = fw_add(fw_add(from, s, out), edge * beside, side);
            bool in = p.x >= box.x0 && p.x <= box.x1 && p.y >= box.y0 && p.y <= box.y1 &&
                      fw_geometry_contour_contains(body, p);
            if (in && !inside) return false;
            inside = in;
            known = s + clear_way(body, own, p) - 1e-9;
        }
        if (inside) return false;
    }
    return fw_geometry_contour_contains(body, from);
}

/* where a line straight outwards leaves the body, as depth in the window: inside at `deep`, outside
   at the window's edge, once in between */
static double edge_depth(const fw_layout_drawing *d, const fw_layout_attachment *a, double along,
                         double deep) {
    double in = deep, out = 0.0;
    const fw_geometry_contour *body = &d->plain[a->body];
    if (!fw_geometry_contour_contains(body, fw_layout_window_point(d->layout, a->side, along, in)))
        return deep;
    while (in - out > 1e-9) {
        double middle = 0.5 * (in + out);
        if (fw_geometry_contour_contains(body,
                                         fw_layout_window_point(d->layout, a->side, along, middle)))
            in = middle;
        else
            out = middle;
    }
    return in;
}

double fw_layout_finger_cut(const fw_layout_drawing *d, const fw_layout_attachment *a, double at,
                            double deep) {
    double r = d->corner_m[a->body], far = 0.5 * fw_layout_rule.tether_neck_m + r;
    double low = edge_depth(d, a, at - far, deep), high = edge_depth(d, a, at + far, deep);
    double middle = edge_depth(d, a, at, deep), slope = (high - low) / (2.0 * far);
    double cut =
        fmin(middle, fmin(low, high)) - r * hypot(1.0, slope) - fw_layout_rule.neck_straight_m;
    return middle - cut < fw_layout_rule.tether_cut_m ? fw_layout_to_grid(cut)
                                                      : -1.0; /* else: no straight edge */
}

void fw_layout_sides_by_distance(const fw_layout *l, fw_geometry_vec2 p,
                                 fw_layout_window_side order[4]) {
    double far[4];
    for (int i = 0; i < 4; i++) {
        fw_layout_window_side s = (fw_layout_window_side)i;
        far[i] =
            fw_dot(fw_sub(fw_layout_window_point(l, s, 0.0, 0.0), p), fw_layout_window_outward(s));
        int k = i;
        for (; k > 0 && far[order[k - 1]] > far[i] + 1e-9; k--)
            order[k] = order[k - 1];
        order[k] = s;
    }
}

fw_layout_ray_hit fw_layout_finger_edge(const fw_layout_drawing *d, int body,
                                        fw_layout_window_side side, double along) {
    const double beside = 30e-6;
    fw_geometry_vec2 out = fw_layout_window_outward(side), in = fw_v(-out.x, -out.y);
    fw_layout_ray_hit hit[3];
    for (int k = 0; k < 3; k++) {
        double at = along + (k - 1) * beside;
        hit[k] = fw_layout_first_hit(&d->plain[body],
                                     fw_layout_window_point(d->layout, side, at, 0.0), in);
    }
    if (hit[0].segment != hit[1].segment || hit[2].segment != hit[1].segment) hit[1].segment = -1;
    return hit[1];
}
