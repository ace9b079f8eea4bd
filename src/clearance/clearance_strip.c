/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the strip of a flexure can be, whatever bends it within its elastic limit.

   A section at s along the strip from a root turns against it by at most k s, where k is the largest
   change of curvature, and so a point of the strip, t/2 beside its centre line, goes by at most
     b(s) = k s (s + t)/2 + 2 e s
   against the body at that root: e is the largest strain of the centre line, twice for what shear
   adds. k <= 2 e/t, e the strain at the limit (of a thick arc the inner side has more, so less k).
   The same holds from the other root, against the other body. Hence
     |p - W| <= |p drawn - W| + min(b(s), b(L - s)),
   about the hinge point W of the nearer body: a disc that goes with either body.

   In: layout, hinge (SI); out: radius (m). Error: proved, to rounding. Cost: 24 points of an edge.
   Source: docs/theory/clearance.md. Test: test_clearance_strip.c */
#include "clearance/clearance_strip.h"
#include "flexure/path.h"
#include "geometry/segment.h"
#include <math.h>

/* ---- the strip ---- */

static bool joins(const fw_layout *layout, const fw_geometry_segment *joint, int body) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role == FW_ROLE_FLEXURE || p->body != body) continue;
        for (int k = 0; k < p->contour.count; k++) {
            const fw_geometry_segment *s = &p->contour.segment[k];
            if ((s->flags & FW_SEGMENT_JOINT) && vec_same(s->a, joint->b) &&
                vec_same(s->b, joint->a))
                return true;
        }
    }
    return false;
}

/* segments from one joint to the other, whose places along the strip are shares of their length */
static int side_of(const fw_geometry_contour *c, int first, int last, bool back, double *length,
                   fw_clearance_strip_part *part) {
    int n = 0;
    double run = 0;
    for (int i = (first + 1) % c->count; i != last; i = (i + 1) % c->count) {
        double size = fw_geometry_segment_length(&c->segment[i]);
        part[n++] = (fw_clearance_strip_part){c->segment[i], run, run + size};
        run += size;
    }
    *length = run;
    for (int i = 0; back && i < n; i++) {
        part[i].from_m = run - part[i].from_m;
        part[i].to_m = run - part[i].to_m;
    }
    return n;
}

/* strip->known stays false where the roots cannot be told from each other */
fw_status fw_clearance_strip_of(fw_arena *arena, const fw_layout *layout,
                                const fw_layout_piece *piece, fw_clearance_strip *strip) {
    const fw_geometry_contour *c = &piece->contour;
    const fw_layout_hinge_layout *h = &layout->hinge[piece->joint];
    int joint[2], n = 0, lower = FW_NONE;
    *strip = (fw_clearance_strip){.hinge = h};
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].flags & FW_SEGMENT_JOINT) {
            if (n < 2) joint[n] = i;
            n++;
        }
    if (n != 2) return FW_OK;
    for (int i = 0; i < 2 && lower == FW_NONE; i++)
        if (joins(layout, &c->segment[joint[i]], h->lower)) lower = i;
    if (lower == FW_NONE) return FW_OK;
    FW_NEED(strip->part = fw_arena_array(arena, fw_clearance_strip_part, (size_t)c->count));
    double length[2];
    int first = side_of(c, joint[lower], joint[1 - lower], false, &length[0], strip->part);
    strip->count =
        first + side_of(c, joint[1 - lower], joint[lower], true, &length[1], strip->part + first);
    strip->length_m = fmax(length[0], length[1]);
    for (int i = 0; i < strip->count; i++) {
        double by = strip->length_m / length[i >= first];
        strip->part[i].from_m *= by;
        strip->part[i].to_m *= by;
    }
    strip->known = strip->length_m > 0;
    return FW_OK;
}

/* ---- how far it bends ---- */

static double least_width(const fw_flexure_input *in) {
    double least = in->width_m;
    if (in->width_middle_m > 0) least = fmin(least, in->width_middle_m);
    for (int i = 0; i < in->npiece; i++) {
        fw_geometry_strip_shape shape;
        double low, high;
        fw_geometry_strip_shape_of(&in->piece[i], &shape);
        fw_geometry_strip_widths(&shape, &low, &high);
        least = i ? fmin(least, low) : low;
    }
    return least;
}

/* at the elastic limit with its safety factor: what bends further is not accepted */
fw_clearance_bend fw_clearance_bend_of(const fw_mechanism *m, const fw_mechanism_hinge *hinge) {
    const fw_flexure_input *in = &hinge->input;
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&hinge->limits);
    const fw_flexure_crystal *x = &in->crystal;
    double allowed = limit ? limit->allowable_Pa : m->variant->material.strength.value;
    double strain = allowed / m->device->safety_factor / in->youngs_Pa;
    /* strains are stress over one modulus; along the softest direction there is more */
    if (x->known) strain *= fmax(1, (x->a0_per_Pa + fabs(x->a1_per_Pa)) * in->youngs_Pa);
    fw_clearance_bend b = {.strain = strain, .width_m = least_width(in), .forced_per_m = HUGE_VAL};
    b.curvature_per_m = 2 * strain / b.width_m;
    b.straight = in->kind == FW_FLEXURE_LEAF && !fw_flexure_input_varies(in);
    double roots = 2 * hinge->closed_form.root_length_m;
    b.root_share = fmax(0, roots / (in->length_m + roots));
    b.known = isfinite(b.curvature_per_m) && b.curvature_per_m > 0;
    return b;
}

double fw_clearance_bend_at(const fw_clearance_bend *b, double s_m) {
    return b->curvature_per_m * s_m * (s_m + b->width_m) / 2 + 2 * b->strain * s_m;
}

/* least distance about a point that holds all of a part: of a chord the ends are the farthest, an arc
   leaves it by at most length^2/(8 r) */
static double farthest(const fw_geometry_segment *s, fw_geometry_vec2 from) {
    double far = fmax(vec_distance(s->a, from), vec_distance(s->b, from));
    if (s->kind != FW_ARC) return far;
    double length = fw_geometry_segment_length(s);
    return far + fmin(length * length / (8 * s->radius), length / 2);
}

fw_geometry_segment fw_clearance_strip_cut(const fw_geometry_segment *s, double from, double to) {
    if (from <= 0 && to >= 1) return *s;
    return fw_geometry_segment_cut(s, from, fw_geometry_segment_point(s, from), to,
                                   fw_geometry_segment_point(s, to));
}

double fw_clearance_strip_reach(const fw_clearance_strip *strip, const fw_clearance_bend *bend) {
    enum { PIECES = 12 };
    double reach = 0;
    for (int i = 0; i < strip->count; i++) {
        const fw_clearance_strip_part *p = &strip->part[i];
        for (int k = 0; k < PIECES; k++) {
            double from = (double)k / PIECES, to = (double)(k + 1) / PIECES;
            fw_geometry_segment s = fw_clearance_strip_cut(&p->segment, from, to);
            double s0 = p->from_m + from * (p->to_m - p->from_m);
            double s1 = p->from_m + to * (p->to_m - p->from_m);
            double near = fw_clearance_bend_at(bend, fmax(s0, s1));
            double other = fw_clearance_bend_at(bend, strip->length_m - fmin(s0, s1));
            reach = fmax(reach, farthest(&s, strip->hinge->centre) + fmin(near, other));
        }
    }
    return reach;
}
