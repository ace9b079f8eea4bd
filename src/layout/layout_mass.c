/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Area, edges and moments of what belongs to a body: its outline with the pieces in its holes, and
   the near half of each flexure that it hangs on.

     A = sum A_k,   A c = sum A_k c_k,   I = sum I_k + A_k |c_k - c|^2        by Green's theorem

   A flexure is cut across at half the length of each of its edges: the two halves add up to it
   exactly, and of a strip of one width they are halves of its length. While its ends move apart, a
   strip's kinetic energy is not that of two rigid halves; that is off by some tenths of its own mass,
   itself some percent of a light link's.
   An offset e of all edges outward changes, to first order (Steiner),

     A by e P,   A c by e S + c e P,   I by e Q,   P = int dl, S = int (x - c) dl, Q = int |x - c|^2 dl

   over the edges, without the cuts between pieces; lines and arcs in closed form.
   m2, m, m, m4; S in m2, Q in m3. Cost: linear in the edges. Test: tests/unit/layout/test_layout_mass.c */
#include "geometry/segment.h"
#include "layout/draw.h"

/* n edges from `first` on: which one holds the middle of their length, and where on it (0..1) */
static int middle_of(const fw_geometry_contour *c, int first, int n, double *t) {
    double whole = 0, before = 0;
    int k = 0;
    for (int i = 0; i < n; i++)
        whole += fw_geometry_segment_length(&c->segment[first + i]);
    for (; k < n - 1; k++) {
        double own = fw_geometry_segment_length(&c->segment[first + k]);
        if (before + own >= 0.5 * whole) break;
        before += own;
    }
    *t = (0.5 * whole - before) / fw_geometry_segment_length(&c->segment[first + k]);
    return first + k;
}

/* One half of a flexure, whose contour is: one edge of the strip from the lower root on, the cut at
   the upper root, the other edge back, the cut at the lower root. */
static fw_status half_of(fw_arena *arena, const fw_geometry_contour *c, bool upper,
                         fw_geometry_contour *half) {
    int cut[2] = {c->count - 1, c->count - 1}, n = 0;
    for (int i = c->count - 2; i >= 0; i--)
        if (c->segment[i].flags & FW_SEGMENT_JOINT) cut[0] = i;
    double t[2];
    int out = middle_of(c, 0, cut[0], &t[0]),
        back = middle_of(c, cut[0] + 1, cut[1] - cut[0] - 1, &t[1]);
    const fw_geometry_segment *o = &c->segment[out], *i = &c->segment[back];
    const fw_geometry_vec2 at[2] = {fw_geometry_segment_point(o, t[0]),
                                    fw_geometry_segment_point(i, t[1])};
    fw_geometry_segment *s = fw_arena_array(arena, fw_geometry_segment, (size_t)c->count + 3);
    FW_NEED(s);
    if (upper) {
        s[n++] = fw_geometry_segment_cut(o, t[0], at[0], 1, o->b);
        for (int k = out + 1; k < back; k++)
            s[n++] = c->segment[k];
        s[n++] = fw_geometry_segment_cut(i, 0, i->a, t[1], at[1]);
    } else {
        s[n++] = fw_geometry_segment_cut(i, t[1], at[1], 1, i->b);
        for (int k = back + 1; k < c->count + out; k++)
            s[n++] = c->segment[k % c->count];
        s[n++] = fw_geometry_segment_cut(o, 0, o->a, t[0], at[0]);
    }
    s[n] = (fw_geometry_segment){
        .kind = FW_LINE, .a = s[n - 1].b, .b = s[0].a, .flags = FW_SEGMENT_JOINT};
    *half = (fw_geometry_contour){.segment = s, .count = n + 1};
    return FW_OK;
}

/* halves of the flexures at this body */
static fw_status add_halves(const fw_layout_drawing *d, int body, fw_geometry_contour *part,
                            int *n) {
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        const fw_geometry_contour *flexure = &d->hinge[j].flexure;
        if (flexure->count == 0 || (h->lower != body && h->upper != body)) continue;
        FW_TRY(half_of(d->arena, flexure, h->upper == body, &part[*n]));
        if (fw_geometry_contour_area(&part[*n]) < 0)
            FW_TRY(fw_geometry_contour_reverse(d->arena, &part[*n], &part[*n]));
        (*n)++;
    }
    return FW_OK;
}

/* length l of an edge, l times its middle, and the integral of |x|^2 dl, all from `origin` */
static void edge_moments(const fw_geometry_segment *s, fw_geometry_vec2 origin, double *length,
                         fw_geometry_vec2 *first, double *second) {
    double l = fw_geometry_segment_length(s);
    *length += l;
    if (s->kind == FW_LINE) {
        fw_geometry_vec2 mid =
            fw_sub(fw_v(0.5 * (s->a.x + s->b.x), 0.5 * (s->a.y + s->b.y)), origin);
        *first = fw_add(*first, l, mid);
        *second += l * (fw_dot(mid, mid) + l * l / 12);
        return;
    }
    double r = s->radius, sign = s->sweep_rad < 0 ? -1 : 1;
    fw_geometry_vec2 c = fw_sub(s->centre, origin), a = fw_sub(s->a, s->centre),
                     b = fw_sub(s->b, s->centre);
    fw_geometry_vec2 u =
        fw_v(sign * (b.y - a.y), sign * (a.x - b.x)); /* r times the integral of u */
    *first = fw_add(fw_add(*first, l, c), r, u);
    *second += l * (fw_dot(c, c) + r * r) + 2 * r * fw_dot(c, u);
}

fw_status fw_layout_body_measure(fw_layout_drawing *d, int body, const fw_geometry_contour *extra,
                                 int nextra) {
    int ncap = d->caps ? d->caps[body].count : 0, n = 0;
    fw_geometry_contour *part;
    FW_NEED(part = fw_arena_array(d->arena, fw_geometry_contour,
                                  (size_t)(ncap + nextra + d->device->nrevolute) + 1));
    part[n++] = d->plain[body];
    for (int i = 0; i < ncap; i++)
        part[n++] = d->caps[body].contour[i];
    for (int i = 0; i < nextra; i++)
        part[n++] = extra[i];
    FW_TRY(add_halves(d, body, part, &n));
    fw_geometry_region region = {part, n};
    fw_geometry_moments m = fw_geometry_region_moments(&region);
    fw_layout_body_layout *to = &d->layout->body[body];
    *to = (fw_layout_body_layout){
        .area_m2 = m.area_m2, .centroid = m.centroid, .polar_m4 = m.polar_m4};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < part[i].count; k++)
            if (!(part[i].segment[k].flags & FW_SEGMENT_JOINT))
                edge_moments(&part[i].segment[k], m.centroid, &to->perimeter_m, &to->edge_m2,
                             &to->edge_m3);
    return FW_OK;
}
