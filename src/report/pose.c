/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include "base/constants.h"
#include "flexure/path.h"
#include <math.h>

enum { CHORDS_PER_TURN = 36 };

/* share of the upper body in the rotation of a point of the flexure: how far along the centre line
   it lies, 0 at the root of `lower`, 1 at the root of `upper` */
static double weight(const fw_hinge_layout *h, const fw_flexure *f, const fw_course *path,
                     fw_vec2 p) {
    double c = cos(h->axis_rad), s = sin(h->axis_rad);
    double x = p.x - h->arc_centre.x, y = p.y - h->arc_centre.y;
    double lx = c * x + s * y, ly = -s * x + c * y;
    if (path) return fw_path_nearest(path, lx, ly);
    double w =
        f->kind == FW_FLEXURE_LEAF ? 0.5 + ly / f->length_m : 0.5 + atan2(ly, lx) / f->angle_rad;
    return isfinite(w) ? fmax(0.0, fmin(1.0, w)) : 0.5;
}

static int chords(const fw_segment *s) {
    if (s->kind == FW_LINE) return 1;
    return 1 + (int)(fmin(fabs(s->sweep_rad), 2.0 * FW_PI) / (2.0 * FW_PI) * CHORDS_PER_TURN);
}

static fw_vec2 along(const fw_segment *s, double u) {
    if (s->kind == FW_LINE)
        return (fw_vec2){s->a.x + u * (s->b.x - s->a.x), s->a.y + u * (s->b.y - s->a.y)};
    double c = cos(u * s->sweep_rad), d = sin(u * s->sweep_rad);
    double x = s->a.x - s->centre.x, y = s->a.y - s->centre.y;
    return (fw_vec2){s->centre.x + c * x - d * y, s->centre.y + d * x + c * y};
}

static fw_status bend_make(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                           const fw_piece *piece, fw_report_bend *bend) {
    const fw_hinge_layout *h = &layout->hinge[piece->joint];
    const fw_flexure *f = &device->flexure[device->joint[piece->joint].flexure];
    const fw_contour *contour = &piece->contour;
    const fw_flexure_input in = fw_flexure_input_of(f, h->fillet_m);
    bool varies = fw_flexure_varies(f);
    fw_course path;
    if (varies) fw_path_of(&in, &path);
    int n = 0;
    for (int i = 0; i < contour->count; i++)
        n += chords(&contour->segment[i]);
    *bend = (fw_report_bend){.piece = piece,
                             .centre = h->centre,
                             .lower = h->lower,
                             .upper = h->upper,
                             .joint = piece->joint};
    FW_NEED(bend->point = fw_arena_array(arena, fw_report_bend_point, (size_t)n));
    for (int i = 0; i < contour->count; i++) {
        const fw_segment *s = &contour->segment[i];
        int m = chords(s);
        for (int k = 0; k < m; k++) {
            fw_vec2 p = along(s, (double)k / m);
            bend->point[bend->npoint++] =
                (fw_report_bend_point){p.x, p.y, weight(h, f, varies ? &path : NULL, p)};
        }
    }
    return FW_OK;
}

fw_status fw_report_bends_make(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               fw_report_bends *bends) {
    *bends = (fw_report_bends){0};
    if (!fw_report_drawn(layout) || !layout->hinge) return FW_OK;
    FW_NEED(bends->item = fw_arena_array(arena, fw_report_bend, (size_t)layout->npiece));
    for (int i = 0; i < layout->npiece; i++) {
        const fw_piece *p = &layout->piece[i];
        if (p->role != FW_ROLE_FLEXURE || p->joint < 0 || !layout->hinge[p->joint].drawn ||
            device->joint[p->joint].flexure < 0)
            continue;
        FW_TRY(bend_make(arena, device, layout, p, &bends->item[bends->count]));
        bends->count++;
    }
    return FW_OK;
}

void fw_report_pose_at(const fw_motion *motion, int body, double t_s, double pose[3]) {
    pose[0] = pose[1] = pose[2] = 0.0;
    if (body < 0 || body >= motion->nbody || motion->nsample == 0) return;
    int low = 0, high = motion->nsample - 1;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (motion->t_s[middle] <= t_s)
            low = middle;
        else
            high = middle;
    }
    double span = motion->t_s[high] - motion->t_s[low];
    double u = span > 0.0 ? fmax(0.0, fmin(1.0, (t_s - motion->t_s[low]) / span)) : 0.0;
    size_t wide = 3 * (size_t)motion->nbody;
    const double *a = motion->q + (size_t)low * wide + 3 * (size_t)body;
    const double *b = motion->q + (size_t)high * wide + 3 * (size_t)body;
    for (int k = 0; k < 3; k++)
        pose[k] = a[k] + u * (b[k] - a[k]);
}

fw_vec2 fw_report_moved(const fw_mechanism *mechanism, const fw_motion *motion, int body,
                        double t_s, fw_vec2 drawn) {
    if (body < 0 || body >= motion->nbody) return drawn;
    double pose[3];
    fw_report_pose_at(motion, body, t_s, pose);
    const fw_mass *m = &mechanism->body[body];
    double c = cos(pose[2] - m->phi_rad), s = sin(pose[2] - m->phi_rad);
    double x = drawn.x - m->x_m, y = drawn.y - m->y_m;
    return (fw_vec2){pose[0] + c * x - s * y, pose[1] + s * x + c * y};
}

static double turned(const fw_mechanism *mechanism, const fw_motion *motion, int body, double t_s) {
    if (body < 0 || body >= motion->nbody) return 0.0;
    double pose[3];
    fw_report_pose_at(motion, body, t_s, pose);
    return pose[2] - mechanism->body[body].phi_rad;
}

/* p(t) = W(t) + R((1-w) a + w b) (p - W), a and b the rotations of the two bodies since the drawing
   and w the share along the centre line: meets both bodies exactly, in between an illustration. */
fw_vec2 fw_report_bent(const fw_mechanism *mechanism, const fw_motion *motion,
                       const fw_report_bend *bend, double t_s, fw_report_bend_point point) {
    fw_vec2 w = fw_report_moved(mechanism, motion, bend->lower, t_s, bend->centre);
    double a = turned(mechanism, motion, bend->lower, t_s);
    double b = turned(mechanism, motion, bend->upper, t_s);
    double angle = a + point.weight * (b - a), c = cos(angle), s = sin(angle);
    double x = point.x_m - bend->centre.x, y = point.y_m - bend->centre.y;
    return (fw_vec2){w.x + c * x - s * y, w.y + s * x + c * y};
}

void fw_report_reach_add(fw_box *box, const fw_device *device, const fw_layout *layout,
                         const fw_mechanism *mechanism, const fw_motion *motion) {
    enum { INSTANTS = 64 };
    if (motion->nsample == 0) return;
    double end = motion->t_s[motion->nsample - 1];
    for (int j = 0; j < device->njoint; j++)
        for (int i = 0; i <= INSTANTS; i++) {
            fw_vec2 p =
                fw_report_moved(mechanism, motion, device->joint[j].body_a, end * i / INSTANTS,
                                fw_report_hinge_point(device, layout, j));
            fw_report_box_add(box, p.x, p.y);
        }
}

double fw_report_pin_limit(const fw_mechanism *mechanism, int pin) {
    int h = pin >= 0 && pin < mechanism->npin ? mechanism->pin[pin].hinge : FW_NONE;
    if (h < 0 || h >= mechanism->nhinge) return (double)NAN;
    double limit = mechanism->hinge[h].closed_form.limit_angle_rad;
    return isfinite(limit) && limit > 0.0 ? limit : (double)NAN;
}

fw_report_worst fw_report_motion_worst(const fw_mechanism *mechanism, const fw_motion *motion) {
    fw_report_worst worst = {.pin = FW_NONE};
    for (int k = 0; k < motion->npin; k++) {
        double u = fabs(motion->peak[k].angle_rad) / fw_report_pin_limit(mechanism, k);
        if (isfinite(u) && (worst.pin == FW_NONE || u > worst.utilisation))
            worst = (fw_report_worst){k, u, motion->peak[k].t_s};
    }
    if (!isfinite(worst.t_s)) worst.t_s = 0.0;
    return worst;
}
