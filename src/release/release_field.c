/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "release/release_field.h"
#include "base/constants.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

fw_geometry_vec2 fw_release_edge_foot(const fw_release_edge *e, fw_geometry_vec2 p) {
    if (e->radius == 0.0) {
        double t;
        return vec_line_foot(e->a, e->b, p, &t);
    }
    fw_geometry_vec2 ray = vec_sub(p, e->centre);
    double length = vec_length(ray);
    if (length > 0.0 && vec_dot(ray, e->middle) >= e->cosine * length)
        return vec_along(e->centre, e->radius / length, ray);
    return vec_distance(p, e->a) <= vec_distance(p, e->b) ? e->a : e->b;
}

/* ---- edges ---- */

static void add_edge(fw_release_field *f, const fw_geometry_segment *s, int part) {
    fw_release_edge *e = &f->edge[f->nedge++];
    *e = (fw_release_edge){
        .a = s->a, .b = s->b, .part = part, .open = !(s->flags & FW_SEGMENT_JOINT)};
    e->about = vec_scale(0.5, vec_add(s->a, s->b));
    e->length = vec_distance(s->a, s->b);
    e->around = 0.5 * e->length;
    e->along = vec_unit(vec_sub(s->b, s->a));
    if (s->kind != FW_ARC) return;
    e->centre = s->centre;
    e->radius = s->radius;
    e->cosine = cos(0.5 * fabs(s->sweep_rad));
    e->middle = vec_unit(fw_geometry_vec_rotate(vec_sub(s->a, s->centre), 0.5 * s->sweep_rad));
    if (e->cosine > 0.0) { /* less than half a turn: about the chord's middle */
        double bow = e->radius * (1.0 - e->cosine);
        e->around = fmax(e->around, bow);
    } else {
        e->about = e->centre;
        e->around = e->radius;
    }
}

static void add_climb(fw_release_field *f, fw_release_climb c, double from, double to) {
    if (from == to) return;
    c.way = to > from ? 1 : -1;
    c.y0 = from < to ? from : to, c.y1 = from < to ? to : from;
    c.x_most = c.radius > 0.0 ? c.cx + (c.side > 0.0 ? c.radius : 0.0) : c.x0 > c.x1 ? c.x0 : c.x1;
    f->climb[f->nclimb++] = c;
}

/* a line at once; an arc is cut where it is level, at the top and the bottom of its circle */
static void add_climbs(fw_release_field *f, const fw_geometry_segment *s, int part) {
    fw_release_climb c = {.part = part};
    if (s->kind == FW_LINE) {
        bool up = s->b.y > s->a.y;
        c.x0 = up ? s->a.x : s->b.x, c.x1 = up ? s->b.x : s->a.x;
        add_climb(f, c, s->a.y, s->b.y);
        return;
    }
    c.cx = s->centre.x, c.cy = s->centre.y, c.radius = s->radius;
    double at = atan2(s->a.y - s->centre.y, s->a.x - s->centre.x), end = at + s->sweep_rad;
    double turn = s->sweep_rad > 0 ? 1.0 : -1.0, y = s->a.y;
    for (int n = 0; n < 4;
         n++) { /* the circle is level at k pi - pi/2: at its top where k is odd */
        double beyond = (at + 0.5 * FW_PI) / FW_PI;
        double k = turn > 0 ? floor(beyond + 1e-9) + 1.0 : ceil(beyond - 1e-9) - 1.0;
        double level = k * FW_PI - 0.5 * FW_PI;
        bool last = turn * (level - end) >= 0.0, top = fmod(fabs(k), 2.0) == 1.0;
        double to = last ? end : level;
        double y_to = last ? s->b.y : s->centre.y + (top ? s->radius : -s->radius);
        c.side = cos(0.5 * (at + to)) >= 0 ? 1.0 : -1.0;
        add_climb(f, c, y, y_to);
        if (last) return;
        y = y_to, at = to;
    }
}

static int bin_of(const fw_release_field *f, double y) {
    double i = floor((y - f->box.y0) / f->bin_m);
    return i < 0.0 ? 0 : i >= f->bins ? f->bins - 1 : (int)i;
}

/* From right to left, by the bin in which the rightmost point lies: behind a climb none reaches farther to the right than
   a bin beyond it. */
static fw_status order_climbs(fw_release_field *f) {
    const double wide = (f->box.x1 - f->box.x0) / f->bins;
    int *first = fw_arena_array(f->arena, int, (size_t)f->bins + 1);
    int *bin = fw_arena_raw(f->arena, ((size_t)f->nclimb + 1) * sizeof *bin);
    fw_release_climb *to = fw_arena_raw(f->arena, ((size_t)f->nclimb + 1) * sizeof *to);
    FW_NEED(first && bin ? to : NULL);
    for (int i = 0; i < f->nclimb; i++) {
        const double k = (f->box.x1 - f->climb[i].x_most) / wide;
        bin[i] = k > 0.0 ? k < f->bins ? (int)k : f->bins - 1 : 0;
        first[bin[i] + 1]++;
    }
    for (int b = 0; b < f->bins; b++)
        first[b + 1] += first[b];
    for (int i = 0; i < f->nclimb; i++)
        to[first[bin[i]]++] = f->climb[i];
    f->climb = to;
    f->behind_m = 1.000001 * wide;
    return FW_OK;
}

static fw_status sort_climbs(fw_release_field *f) {
    f->bins = f->nclimb / 4 + 1;
    f->bin_m = (f->box.y1 - f->box.y0) / f->bins;
    FW_TRY(order_climbs(f));
    FW_NEED(f->first = fw_arena_array(f->arena, int, (size_t)f->bins + 2));
    for (int i = 0; i < f->nclimb; i++)
        for (int b = bin_of(f, f->climb[i].y0); b <= bin_of(f, f->climb[i].y1); b++)
            f->first[b + 2]++;
    for (int b = 0; b < f->bins; b++)
        f->first[b + 2] += f->first[b + 1];
    FW_NEED(f->listed = fw_arena_array(f->arena, int, (size_t)f->first[f->bins + 1] + 1));
    for (int i = 0; i < f->nclimb; i++)
        for (int b = bin_of(f, f->climb[i].y0); b <= bin_of(f, f->climb[i].y1); b++)
            f->listed[f->first[b + 1]++] = i;
    return FW_OK;
}

/* lettering: what its edges are cut out of, asked just outside of each */
void fw_release_field_hosts(fw_release_field *f, const fw_layout *layout, const int *part_of) {
    for (int i = 0, first = 0; i < layout->npiece; i++) {
        const fw_geometry_contour *c = &layout->piece[i].contour;
        int host = FW_RELEASE_OPENING;
        if (part_of[i] == FW_RELEASE_MIXED) continue;
        for (int k = 0; part_of[i] == FW_RELEASE_OPENING && k < c->count; k++) {
            fw_geometry_vec2 t = fw_geometry_segment_tangent(&c->segment[k], 0.5);
            fw_geometry_vec2 at = fw_geometry_segment_point(&c->segment[k], 0.5);
            int here = fw_release_field_part(f, vec_along(at, -1e-9, vec_left(t)));
            if (here < 0) continue;
            host = host < 0 && host != FW_RELEASE_SEVERAL ? here
                   : host == here                         ? here
                                                          : FW_RELEASE_SEVERAL;
        }
        for (int k = 0; part_of[i] == FW_RELEASE_OPENING && k < c->count; k++)
            f->edge[first + k].part = host;
        first += c->count;
    }
}

fw_status fw_release_field_make(fw_arena *arena, const fw_layout *layout, const int *part_of,
                                int npart, fw_release_field *f) {
    size_t edges = 0;
    *f = (fw_release_field){.arena = arena, .npart = npart, .box = layout->die};
    for (int i = 0; i < layout->npiece; i++)
        if (part_of[i] != FW_RELEASE_MIXED) edges += (size_t)layout->piece[i].contour.count;
    FW_NEED(f->edge = fw_arena_raw(arena, edges * sizeof *f->edge));
    FW_NEED(f->climb = fw_arena_raw(arena, 4 * edges * sizeof *f->climb));
    FW_NEED(f->winding = fw_arena_array(arena, int, (size_t)npart + 1));
    FW_NEED(f->met = fw_arena_array(arena, bool, (size_t)npart + 1));
    FW_NEED(f->touched = fw_arena_array(arena, int, (size_t)npart + 1));
    for (int i = 0; i < layout->npiece; i++) {
        const fw_geometry_contour *c = &layout->piece[i].contour;
        if (part_of[i] == FW_RELEASE_MIXED) continue;
        fw_geometry_box box = fw_geometry_contour_box(c);
        f->box = fw_box_join(f->box, box);
        for (int k = 0; k < c->count; k++) {
            add_edge(f, &c->segment[k], part_of[i]);
            add_climbs(f, &c->segment[k], part_of[i]);
        }
    }
    return sort_climbs(f);
}

static double crossing(const fw_release_climb *c, double y) {
    double dy = y - c->cy;
    if (c->radius == 0.0) return c->x0 + (c->x1 - c->x0) * ((y - c->y0) / (c->y1 - c->y0));
    double square = c->radius * c->radius - dy * dy;
    return c->cx + c->side * (square > 0.0 ? sqrt(square) : 0.0);
}

/* Winding number of every part about p, by the crossings of a ray to the right. A part holds p where its
   own number is not 0, and no lettering does. Half-open in y, so that a ray through a corner counts
   once. Cost: the edges whose heights share a bin with p. Test: test_reach_field.c,
   parts_are_those_of_contains. */
int fw_release_field_part(fw_release_field *f, fw_geometry_vec2 p) {
    int found = FW_RELEASE_OPENING, b = bin_of(f, p.y), n = 0;
    for (int i = f->first[b]; i < f->first[b + 1]; i++) {
        const fw_release_climb *c = &f->climb[f->listed[i]];
        if (c->x_most <= p.x) {
            if (c->x_most <= p.x - f->behind_m) break;
            continue;
        }
        if (!(c->y0 <= p.y && p.y < c->y1)) continue;
        if (crossing(c, p.y) <= p.x) continue;
        int at = c->part + 1; /* 0: lettering */
        if (!f->met[at]) f->touched[n++] = at;
        f->met[at] = true;
        f->winding[at] += c->way;
    }
    bool cleared = f->winding[0] != 0;
    for (int i = 0; i < n; i++) {
        int at = f->touched[i];
        if (at > 0 && f->winding[at] != 0) found = at - 1;
        f->winding[at] = 0;
        f->met[at] = false;
    }
    return cleared ? FW_RELEASE_OPENING : found;
}

static int by_x(const void *p, const void *q) {
    double a = ((const fw_release_crossing *)p)->x, b = ((const fw_release_crossing *)q)->x;
    return (a > b) - (a < b);
}

static void sort_row(fw_release_crossing *row, int n) {
    enum { SHORT = 12 };
    if (n > SHORT) qsort(row, (size_t)n, sizeof *row, by_x);
    for (int i = 1; n <= SHORT && i < n; i++) {
        fw_release_crossing c = row[i];
        int k = i;
        for (; k > 0 && row[k - 1].x > c.x; k--)
            row[k] = row[k - 1];
        row[k] = c;
    }
}

/* a part whose number is not 0, of those that were met; 0: none */
static int any_of(const fw_release_field *f, int touched) {
    for (int i = touched - 1; i >= 0; i--)
        if (f->touched[i] > 0 && f->winding[f->touched[i]] != 0) return f->touched[i];
    return 0;
}

/* The same for all points of a row from x0 to x1 at once: between two crossings the numbers do not change, and
   from right to left they are sums. Cost: that of one point, and of sorting what is between. Test:
   test_reach_field.c, rows_are_those_of_points. */
int fw_release_field_row(fw_release_field *f, double y, double x0, double x1,
                         fw_release_crossing *row) {
    int b = bin_of(f, y), n = 0, touched = 0;
    for (int i = f->first[b]; i < f->first[b + 1]; i++) {
        const fw_release_climb *c = &f->climb[f->listed[i]];
        if (c->x_most <= x0 - f->behind_m) break;
        if (!(c->y0 <= y && y < c->y1) || c->x_most <= x0) continue;
        double x = crossing(c, y);
        if (x <= x0) continue;
        int at = c->part + 1;
        if (!f->met[at]) f->touched[touched++] = at;
        f->met[at] = true;
        if (x >= x1)
            f->winding[at] += c->way;
        else
            row[n++] = (fw_release_crossing){x, at, c->way, FW_RELEASE_OPENING};
    }
    sort_row(row, n);
    int here = any_of(f, touched);
    row[n] = (fw_release_crossing){HUGE_VAL, 0, 0, f->winding[0] == 0 ? here - 1 : -1};
    for (int i = n - 1; i >= 0; i--) { /* what lies left of this crossing has it on its right */
        int at = row[i].edge_part;
        f->winding[at] += row[i].way;
        if (at > 0 && f->winding[at] != 0) here = at;
        if (here > 0 && f->winding[here] == 0) here = any_of(f, touched);
        if (here > 0 && f->winding[0] == 0) row[i].part = here - 1;
    }
    for (int i = 0; i < touched; i++) {
        f->winding[f->touched[i]] = 0;
        f->met[f->touched[i]] = false;
    }
    return n;
}
