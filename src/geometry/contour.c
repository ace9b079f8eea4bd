/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"

fw_geometry_outline fw_geometry_outline_start(fw_arena *arena, fw_geometry_vec2 point) {
    return (fw_geometry_outline){
        .arena = arena, .first = point, .at = point, .invalid = !vec_finite(point)};
}

static void push(fw_geometry_outline *outline, fw_geometry_segment segment) {
    outline->at =
        segment
            .b; /* also where there is no memory, which must not look like a flaw of the drawing */
    if (outline->failed) return;
    if (outline->count == outline->capacity) {
        int more = outline->capacity ? 2 * outline->capacity : 8;
        fw_geometry_segment *grown = fw_arena_grow(
            outline->arena, outline->segment, (size_t)outline->count, (size_t)more, sizeof *grown);
        if (!grown) {
            outline->failed = true;
            return;
        }
        outline->segment = grown;
        outline->capacity = more;
    }
    outline->segment[outline->count++] = segment;
}

/* a step shorter than the tolerance moves the last end instead of adding a sliver */
static void nudge(fw_geometry_outline *outline, fw_geometry_vec2 to) {
    if (outline->count > 0)
        outline->segment[outline->count - 1].b = to;
    else
        outline->first = to;
    outline->at = to;
}

void fw_geometry_outline_line(fw_geometry_outline *outline, fw_geometry_vec2 to, unsigned flags) {
    if (!vec_finite(to)) {
        outline->invalid = true;
        return;
    }
    fw_geometry_vec2 step = vec_sub(to, outline->at);
    bool far = fabs(step.x) > FW_COINCIDENT_M || fabs(step.y) > FW_COINCIDENT_M;
    if (!far && vec_length(step) <= FW_COINCIDENT_M) {
        nudge(outline, to);
        return;
    }
    push(outline,
         (fw_geometry_segment){.kind = FW_LINE, .flags = flags, .a = outline->at, .b = to});
}

void fw_geometry_outline_arc(fw_geometry_outline *outline, fw_geometry_vec2 centre,
                             double sweep_rad, unsigned flags) {
    fw_geometry_vec2 ray = vec_sub(outline->at, centre);
    fw_geometry_vec2 to = fabs(sweep_rad) == FW_TURN
                              ? outline->at
                              : vec_add(centre, fw_geometry_vec_rotate(ray, sweep_rad));
    fw_geometry_outline_arc_to(outline, centre, sweep_rad, to, flags);
}

void fw_geometry_outline_arc_to(fw_geometry_outline *outline, fw_geometry_vec2 centre,
                                double sweep_rad, fw_geometry_vec2 to, unsigned flags) {
    double radius = vec_distance(outline->at, centre);
    fw_geometry_segment arc = {FW_ARC, flags, outline->at, to, centre, radius, sweep_rad};
    /* the sweep is made to agree with the end points */
    arc.sweep_rad = fw_geometry_angle_near(
        fw_geometry_vec_angle(vec_sub(arc.a, centre), vec_sub(to, centre)), sweep_rad);
    if (fabs(arc.sweep_rad) > FW_TURN) arc.sweep_rad = copysign(FW_TURN, sweep_rad);
    if (radius * fabs(sweep_rad) <= FW_COINCIDENT_M &&
        vec_distance(outline->at, to) <= FW_COINCIDENT_M) {
        nudge(outline, to);
        return;
    }
    if (!fw_geometry_segment_valid(&arc) || arc.sweep_rad * sweep_rad < 0 ||
        fabs(arc.sweep_rad - sweep_rad) * radius > 16 * FW_COINCIDENT_M) {
        outline->invalid = true;
        return;
    }
    push(outline, arc);
}

fw_status fw_geometry_outline_close(fw_geometry_outline *outline, fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    if (!outline->failed && outline->count > 0 && !vec_same(outline->at, outline->first)) {
        if (vec_distance(outline->at, outline->first) <= FW_COINCIDENT_M)
            outline->segment[outline->count - 1].b = outline->first;
        else
            fw_geometry_outline_line(outline, outline->first, 0);
    }
    if (outline->failed) return FW_NOMEM;
    if (outline->invalid) return FW_GEOMETRY;
    fw_geometry_contour made = {outline->segment, outline->count};
    if (!fw_geometry_contour_valid(&made)) return FW_GEOMETRY;
    *contour = made;
    return FW_OK;
}

/* Simple outlines, all counter-clockwise. */

static fw_status four_corners(fw_arena *arena, const fw_geometry_vec2 corner[4],
                              fw_geometry_contour *contour) {
    fw_geometry_outline outline = fw_geometry_outline_start(arena, corner[0]);
    for (int i = 1; i < 4; i++)
        fw_geometry_outline_line(&outline, corner[i], 0);
    FW_TRY(fw_geometry_outline_close(&outline, contour));
    return contour->count == 4 ? FW_OK : FW_GEOMETRY;
}

fw_status fw_geometry_contour_rectangle(fw_arena *arena, fw_geometry_box box,
                                        fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    if (!(box.x1 - box.x0 > FW_COINCIDENT_M && box.y1 - box.y0 > FW_COINCIDENT_M))
        return FW_GEOMETRY;
    const fw_geometry_vec2 corner[4] = {
        {box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
    return four_corners(arena, corner, contour);
}

/* two half circles: no writer needs a special case for an arc that ends where it begins */
fw_status fw_geometry_contour_disc(fw_arena *arena, fw_geometry_vec2 centre, double radius_m,
                                   fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    if (!vec_finite(centre) || !isfinite(radius_m) || radius_m <= FW_COINCIDENT_M)
        return FW_GEOMETRY;
    fw_geometry_vec2 right = {centre.x + radius_m, centre.y},
                     left = {centre.x - radius_m, centre.y};
    fw_geometry_segment *s = fw_arena_array(arena, fw_geometry_segment, 2);
    FW_NEED(s);
    s[0] = (fw_geometry_segment){FW_ARC, 0, right, left, centre, radius_m, FW_PI};
    s[1] = (fw_geometry_segment){FW_ARC, 0, left, right, centre, radius_m, FW_PI};
    *contour = (fw_geometry_contour){s, 2};
    return FW_OK;
}

fw_status fw_geometry_contour_bar(fw_arena *arena, fw_geometry_vec2 p, fw_geometry_vec2 q,
                                  double width_m, fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    fw_geometry_vec2 along = vec_sub(q, p);
    if (!(vec_length(along) > FW_COINCIDENT_M && width_m > FW_COINCIDENT_M) || !isfinite(width_m))
        return FW_GEOMETRY;
    fw_geometry_vec2 half = vec_scale(0.5 * width_m, vec_left(vec_unit(along)));
    const fw_geometry_vec2 corner[4] = {vec_sub(p, half), vec_sub(q, half), vec_add(q, half),
                                        vec_add(p, half)};
    return four_corners(arena, corner, contour);
}

fw_status fw_geometry_contour_ring_sector(fw_arena *arena, fw_geometry_vec2 centre, double inner_m,
                                          double outer_m, double angle0_rad, double sweep_rad,
                                          fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    bool sizes = inner_m >= 0 && outer_m - inner_m > FW_COINCIDENT_M && isfinite(outer_m);
    /* a closed ring has a hole and is no single outline */
    bool angles = isfinite(angle0_rad) && (FW_TURN - sweep_rad) * outer_m > FW_COINCIDENT_M &&
                  sweep_rad * outer_m > FW_COINCIDENT_M;
    if (!vec_finite(centre) || !sizes || !angles) return FW_GEOMETRY;
    fw_geometry_vec2 u0 = {cos(angle0_rad), sin(angle0_rad)};
    fw_geometry_vec2 u1 = {cos(angle0_rad + sweep_rad), sin(angle0_rad + sweep_rad)};
    bool pie = inner_m <= FW_COINCIDENT_M;
    fw_geometry_outline outline = fw_geometry_outline_start(arena, vec_along(centre, outer_m, u0));
    fw_geometry_outline_arc_to(&outline, centre, sweep_rad, vec_along(centre, outer_m, u1), 0);
    fw_geometry_outline_line(&outline, pie ? centre : vec_along(centre, inner_m, u1), 0);
    if (!pie)
        fw_geometry_outline_arc_to(&outline, centre, -sweep_rad, vec_along(centre, inner_m, u0), 0);
    return fw_geometry_outline_close(&outline, contour);
}

typedef struct frame {
    double c, s, x, y;
    bool mirror;
} frame;

static fw_geometry_vec2 moved(const frame *f, fw_geometry_vec2 p) {
    double y = f->mirror ? -p.y : p.y;
    return (fw_geometry_vec2){f->c * p.x - f->s * y + f->x, f->s * p.x + f->c * y + f->y};
}

fw_status fw_geometry_contour_transform(fw_arena *arena, const fw_geometry_contour *contour,
                                        fw_geometry_pose pose, bool mirror_y,
                                        fw_geometry_contour *out) {
    *out = (fw_geometry_contour){0};
    if (!isfinite(pose.x_m) || !isfinite(pose.y_m) || !isfinite(pose.angle_rad)) return FW_GEOMETRY;
    int n = contour->count;
    fw_geometry_segment *segment = fw_arena_array(arena, fw_geometry_segment, (size_t)n);
    FW_NEED(segment);
    frame f = {cos(pose.angle_rad), sin(pose.angle_rad), pose.x_m, pose.y_m, mirror_y};
    for (int i = 0; i < n; i++) {
        /* a mirrored outline runs the other way; read backwards it stays counter-clockwise */
        fw_geometry_segment s = mirror_y ? fw_geometry_segment_reverse(&contour->segment[n - 1 - i])
                                         : contour->segment[i];
        s.a = moved(&f, s.a);
        s.b = moved(&f, s.b);
        if (s.kind == FW_ARC) {
            s.centre = moved(&f, s.centre);
            if (mirror_y) s.sweep_rad = -s.sweep_rad;
        }
        segment[i] = s;
    }
    *out = (fw_geometry_contour){segment, n};
    return FW_OK;
}

fw_status fw_geometry_contour_reverse(fw_arena *arena, const fw_geometry_contour *contour,
                                      fw_geometry_contour *out) {
    *out = (fw_geometry_contour){0};
    int n = contour->count;
    fw_geometry_segment *segment = fw_arena_array(arena, fw_geometry_segment, (size_t)n);
    FW_NEED(segment);
    for (int i = 0; i < n; i++)
        segment[i] = fw_geometry_segment_reverse(&contour->segment[n - 1 - i]);
    *out = (fw_geometry_contour){segment, n};
    return FW_OK;
}

/* one y-monotone piece against the ray from the point to the right: +1 up, -1 down, 0 none.
   Half-open in y, so that a vertex on the ray counts once. */
static int crosses(double y0, double y1, double y) {
    if ((y0 <= y) == (y1 <= y)) return 0;
    return y0 <= y ? 1 : -1;
}

static int line_winding(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    int way = crosses(s->a.y, s->b.y, p.y);
    if (way == 0) return 0;
    /* the crossing lies to the right of p when p is to the left of the upward edge */
    double side = vec_cross(vec_sub(s->b, s->a), vec_sub(p, s->a));
    return (way > 0) == (side > 0) ? way : 0;
}

static int arc_winding(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    fw_geometry_vec2 c = s->centre;
    double r = s->radius, y = p.y - c.y;
    /* beside the circle (ends may be off it by less than 1e-10 m): nothing to the right, or all of
       it, and then the steps below add up to that from one end to the other */
    if (fabs(y) > r + 1e-10 || p.x >= c.x + r) return 0;
    if (p.x < c.x - r) return crosses(s->a.y, s->b.y, p.y);
    double half = fabs(y) < r ? sqrt((r - y) * (r + y)) : 0;
    double start = atan2(s->a.y - c.y, s->a.x - c.x), end = start + s->sweep_rad;
    double way = s->sweep_rad > 0 ? 1 : -1;
    /* quadrant pairs: right half between -pi/2 and pi/2 (+ 2 pi k), left half the others */
    double sector = floor((start + 0.5 * FW_PI) / FW_PI);
    double y0 = s->a.y;
    int total = 0;
    for (int guard = 0; guard < 4; guard++) {
        double limit = way > 0 ? (sector + 0.5) * FW_PI : (sector - 0.5) * FW_PI;
        bool last = way > 0 ? end <= limit : end >= limit;
        bool right = fmod(fabs(sector), 2) < 0.5;
        bool up = right == (way > 0);
        double y1 = last ? s->b.y : up ? c.y + r : c.y - r;
        int step = crosses(y0, y1, p.y);
        if (step != 0 && p.x < (right ? c.x + half : c.x - half)) total += step;
        if (last) break;
        y0 = y1;
        sector += way;
    }
    return total;
}

/* Winding number by a ray to the right: lines by the sign of a cross product, arcs cut at their top
   and bottom, where x = c_x +- sqrt(r^2 - (y - c_y)^2) is single-valued.
   In: contour, point (m). Exact for points off the outline by more than rounding. O(n).
   Test: test_distance.c. */
int fw_geometry_contour_winding(const fw_geometry_contour *contour, fw_geometry_vec2 point) {
    int total = 0;
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        total += s->kind == FW_LINE ? line_winding(s, point) : arc_winding(s, point);
    }
    return total;
}

bool fw_geometry_contour_contains(const fw_geometry_contour *contour, fw_geometry_vec2 point) {
    return fw_geometry_contour_winding(contour, point) != 0;
}

/* Lengths, boxes and area integrals in closed form. */

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
    double area;             /* m2 */
    fw_geometry_vec2 first;  /* m3 */
    double polar;            /* m4 */
    fw_geometry_vec2 spread; /* of (x^2 - y^2, 2 x y), m4 */
} integrals;

/* as complex numbers: (x^2 - y^2, 2 x y) is the square of (x, y) */
static fw_geometry_vec2 product(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return (fw_geometry_vec2){p.x * q.x - p.y * q.y, p.x * q.y + p.y * q.x};
}

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
   centre (2/3) r^3 sin^3(w/2) m, polar moment about the centre r^4 (w - sin w (2 + cos w) / 3) / 4,
   spread about the centre r^4 sin w (1 - cos w)/6 m^2 with m a complex number.
   In: segment, reference (m). Added to *sum. Error: a few ulp of the largest term, so the reference
   is chosen near the outline. Source: own derivation, docs/theory/contours.md. Test: test_moments
 */
static void add_segment(integrals *sum, const fw_geometry_segment *s, fw_geometry_vec2 reference) {
    fw_geometry_vec2 a = vec_sub(s->a, reference), b = vec_sub(s->b, reference);
    double twice = vec_cross(a, b);
    sum->area += 0.5 * twice;
    sum->first = vec_along(sum->first, twice / 6, vec_add(a, b));
    sum->polar += twice / 12 * (vec_dot(a, a) + vec_dot(a, b) + vec_dot(b, b));
    fw_geometry_vec2 squares = vec_add(vec_add(product(a, a), product(a, b)), product(b, b));
    sum->spread = vec_along(sum->spread, twice / 12, squares);
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
    double spread = r2 * r2 * sin(w) * 2 * half * half / 6;
    sum->spread = vec_along(sum->spread, spread, product(middle, middle));
    sum->spread = vec_along(sum->spread, 2, product(c, first));
    sum->spread = vec_along(sum->spread, area, product(c, c));
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
    if (sum.area == 0) return (fw_geometry_moments){.centroid = reference};
    fw_geometry_vec2 shift = vec_scale(1 / sum.area, sum.first);
    double polar = sum.polar - sum.area * vec_dot(shift, shift);
    fw_geometry_vec2 spread = vec_along(sum.spread, -sum.area, product(shift, shift));
    return (fw_geometry_moments){sum.area, vec_add(reference, shift), polar, spread};
}

/* ---- as commands of an SVG path ---- */

int fw_geometry_arc_parts(const fw_geometry_segment *s, double most_rad) {
    return (int)ceil(fabs(s->sweep_rad) / most_rad - 1e-9);
}

fw_geometry_vec2 fw_geometry_arc_end(const fw_geometry_segment *s, int i, int parts) {
    if (i == parts) return s->b;
    double angle = s->sweep_rad * i / parts, c = cos(angle), n = sin(angle);
    fw_geometry_vec2 r = {s->a.x - s->centre.x, s->a.y - s->centre.y};
    return (fw_geometry_vec2){s->centre.x + r.x * c - r.y * n, s->centre.y + r.x * n + r.y * c};
}

static void point(fw_text *out, const fw_geometry_sheet *sheet, char command, fw_geometry_vec2 at) {
    fw_svg_point(out, command, (at.x - sheet->x0_m) * sheet->per_m,
                 (sheet->y1_m - at.y) * sheet->per_m, sheet->decimals);
}

static void arc(fw_text *out, const fw_geometry_sheet *sheet, const fw_geometry_segment *s) {
    int parts = fw_geometry_arc_parts(s, sheet->most_rad);
    double r = s->radius * sheet->per_m, half_turn = 0.5 * (3.0 * FW_GEOMETRY_ARC_EXACT);
    bool large = fabs(s->sweep_rad) / parts > half_turn;
    for (int i = 1; i <= parts; i++) {
        fw_svg_point(out, 'A', r, r, sheet->decimals);
        fw_text_add(out, large ? " 0 1" : " 0 0");
        fw_text_add(out, s->sweep_rad < 0.0 ? " 1" : " 0"); /* y points down */
        point(out, sheet, ' ', fw_geometry_arc_end(s, i, parts));
    }
}

static void run(fw_text *out, const fw_geometry_sheet *sheet, const fw_geometry_contour *c,
                bool edges) {
    bool down = false; /* the pen: a joint lifts it */
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (edges && s->flags & FW_SEGMENT_JOINT) {
            down = false;
            continue;
        }
        if (!down) point(out, sheet, 'M', s->a);
        down = true;
        if (s->kind == FW_ARC)
            arc(out, sheet, s);
        else
            point(out, sheet, 'L', s->b);
    }
}

void fw_geometry_svg_contour(fw_text *out, const fw_geometry_sheet *sheet,
                             const fw_geometry_contour *c) {
    run(out, sheet, c, false);
    if (c->count > 0) fw_text_add(out, "Z");
}

void fw_geometry_svg_edges(fw_text *out, const fw_geometry_sheet *sheet,
                           const fw_geometry_contour *c) {
    run(out, sheet, c, true);
}
