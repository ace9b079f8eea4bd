/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lengths, boxes and area integrals in closed form. */
#include "geometry/segment.h"

double fw_geometry_contour_perimeter(const fw_geometry_contour *contour) {
    double sum = 0;
    for (int i = 0; i < contour->count; i++)
        sum += fw_geometry_segment_length(&contour->segment[i]);
    return sum;
}

fw_geometry_box fw_geometry_contour_box(const fw_geometry_contour *contour) {
    if (contour->count == 0) return (fw_geometry_box){0, 0, 0, 0};
    fw_geometry_box box = fw_segment_box(&contour->segment[0]);
    for (int i = 1; i < contour->count; i++)
        box = fw_box_join(box, fw_segment_box(&contour->segment[i]));
    return box;
}

/* integrals over the area about one reference point */
typedef struct integrals {
    double area;            /* m2 */
    fw_geometry_vec2 first; /* m3 */
    double polar;           /* m4 */
} integrals;

/* x - sin x without cancellation near 0 */
static double less_sine(double x) {
    if (fabs(x) > 0.5) return x - sin(x);
    double term = x * x * x / 6, sum = 0;
    for (int k = 4; k < 24; k += 2) {
        sum += term;
        term *= -x * x / (k * (k + 1));
    }
    return sum;
}

/* Green's theorem for one segment: the triangle (reference, a, b) and, for an arc of signed sweep w
   and mid direction m, the circular segment: area r^2 (w - sin w) / 2, first moment about the
   centre (2/3) r^3 sin^3(w/2) m, polar moment about the centre r^4 (w - sin w (2 + cos w) / 3) / 4.
   In: segment, reference (m). Added to *sum. Error: a few ulp of the largest term, so the reference
   is chosen near the outline. Source: own derivation, docs/theory/contours.md. Test: test_moments
 */
static void add_segment(integrals *sum, const fw_geometry_segment *s, fw_geometry_vec2 reference) {
    fw_geometry_vec2 a = vec_sub(s->a, reference), b = vec_sub(s->b, reference);
    double twice = vec_cross(a, b);
    sum->area += 0.5 * twice;
    sum->first = vec_along(sum->first, twice / 6, vec_add(a, b));
    sum->polar += twice / 12 * (vec_dot(a, a) + vec_dot(a, b) + vec_dot(b, b));
    if (s->kind == FW_LINE) return;
    double w = s->sweep_rad, r = s->radius, r2 = r * r, half = sin(0.5 * w);
    fw_geometry_vec2 c = vec_sub(s->centre, reference);
    fw_geometry_vec2 middle = vec_unit(fw_geometry_vec_rotate(vec_sub(s->a, s->centre), 0.5 * w));
    double area = 0.5 * r2 * less_sine(w);
    fw_geometry_vec2 first = vec_scale(2.0 / 3.0 * r2 * r * half * half * half, middle);
    /* w - sin w (2 + cos w)/3 = (2/3)(w - sin w) + (1/6)(2 w - sin 2w) */
    double polar = 0.25 * r2 * r2 * (2.0 / 3.0 * less_sine(w) + less_sine(2 * w) / 6);
    sum->area += area;
    sum->first = vec_add(sum->first, vec_along(first, area, c));
    sum->polar += polar + 2 * vec_dot(c, first) + area * vec_dot(c, c);
}

static fw_geometry_vec2 middle_of(fw_geometry_box box) {
    return (fw_geometry_vec2){0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)};
}

/* the first of the integrals alone, by the same sums */
double fw_geometry_contour_area_in(const fw_geometry_contour *contour, fw_geometry_box box) {
    double sum = 0;
    fw_geometry_vec2 reference = middle_of(box);
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        sum += 0.5 * vec_cross(vec_sub(s->a, reference), vec_sub(s->b, reference));
        if (s->kind == FW_ARC) sum += 0.5 * (s->radius * s->radius) * less_sine(s->sweep_rad);
    }
    return sum;
}

double fw_geometry_contour_area(const fw_geometry_contour *contour) {
    return fw_geometry_contour_area_in(contour, fw_geometry_contour_box(contour));
}

fw_geometry_moments fw_geometry_region_moments(const fw_geometry_region *region) {
    if (region->count == 0) return (fw_geometry_moments){0};
    fw_geometry_box box = fw_geometry_contour_box(&region->contour[0]);
    for (int i = 1; i < region->count; i++)
        box = fw_box_join(box, fw_geometry_contour_box(&region->contour[i]));
    fw_geometry_vec2 reference = middle_of(box);
    integrals sum = {0};
    for (int i = 0; i < region->count; i++)
        for (int k = 0; k < region->contour[i].count; k++)
            add_segment(&sum, &region->contour[i].segment[k], reference);
    if (sum.area == 0) return (fw_geometry_moments){0, reference, 0};
    fw_geometry_vec2 shift = vec_scale(1 / sum.area, sum.first);
    double polar = sum.polar - sum.area * vec_dot(shift, shift);
    return (fw_geometry_moments){sum.area, vec_add(reference, shift), polar};
}
