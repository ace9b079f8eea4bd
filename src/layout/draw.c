/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a drawing is made with and holds: sketches in local coordinates; joints, slots, names and pieces; which of these
   are walls; area and moments of a body. */
#include "base/text.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include "layout/layout.h"
#include <math.h>

/* ---- sketches and pieces ---- */

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

fw_status fw_layout_plate_outline(fw_layout_drawing *d, int body, fw_geometry_contour *plate) {
    const fw_device_body *b = &d->device->body[body];
    const double w = 0.5 * b->plate_width_m, h = 0.5 * b->plate_height_m;
    const fw_layout_local local = {fw_v(b->plate_x_m, b->plate_y_m), cos(b->plate_angle_rad),
                                   sin(b->plate_angle_rad), false};
    const fw_geometry_vec2 corner[4] = {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
    return fw_layout_polygon(d->arena, &local, corner, 4, -1, plate);
}

/* ---- the drawing ---- */

const char *fw_layout_um(char buffer[32], double metres) {
    return fw_number_text(buffer, 32, metres * 1e6, 5);
}

const char *fw_layout_body_label(fw_layout_drawing *d, int body) {
    if (body == FW_GROUND && d->base != FW_NONE) {
        const fw_geometry_vec2 at = fw_layout_joint_point(d->device, d->base);
        char x[32], y[32];
        return fw_arena_printf(d->arena, "base of %s%s at (%s, %s) um",
                               FW_NAMED("hinge", d->device->revolute[d->base].id),
                               fw_layout_um(x, at.x), fw_layout_um(y, at.y));
    }
    if (body == FW_GROUND) return "base";
    const fw_device_body *b = &d->device->body[body];
    return fw_arena_printf(d->arena, "%s%s",
                           fw_text_kind(b->platform ? "platform " : "link ", b->id), b->id);
}

fw_place fw_layout_body_place(const fw_layout_drawing *d, int body) {
    if (body >= 0) return d->device->body[body].place;
    if (d->base != FW_NONE) return d->device->revolute[d->base].place;
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

/* with more than two ground hinges, and where one base between two of them has no way to the frame */
bool fw_layout_own_bases(const fw_layout_drawing *d) {
    return d->base_side || fw_layout_body_joints(d->device, FW_GROUND, NULL, 0) > 2;
}

const fw_layout_side *fw_layout_side_of(const fw_layout_drawing *d, int joint, int body) {
    const fw_layout_hinge_plan *plan = &d->hinge[joint];
    return &plan->side[plan->side[1].body == body];
}

static bool is_on_ground(const fw_device_revolute *j) {
    return j->body_a == FW_GROUND || j->body_b == FW_GROUND;
}

int fw_layout_drawing_slot(const fw_layout_drawing *d, int body, int joint) {
    const fw_device *device = d->device;
    if (body != FW_GROUND) return body;
    if (!fw_layout_own_bases(d)) return device->nbody;
    int n = 0;
    for (int j = 0; j < joint; j++)
        n += is_on_ground(&device->revolute[j]);
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

fw_geometry_vec2 fw_layout_window_outward(fw_layout_window_side side) {
    static const fw_geometry_vec2 out[] = {{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}};
    return out[side];
}

/* ---- to which side a base leaves its hinge ----
   A base bends: what holds a leaf aside of its line is hundreds of times softer than the leaf is along itself, and its bar
   then goes half around the hinge. So where a leaf whose axis is stated runs straight towards a side of the window, its base
   leaves to that side, in line with it. Of any other the flexure would turn with its base, and what is soft itself asks little of
   its base. docs/theory/layout.md, section 5; decision 256; test_layout_hubs.c */

static fw_layout_window_side side_along(fw_geometry_vec2 way) {
    fw_layout_window_side most = FW_LEFT;
    for (int i = 0; i < 4; i++) {
        const fw_layout_window_side side = (fw_layout_window_side)i;
        if (fw_dot(fw_layout_window_outward(side), way) >
            fw_dot(fw_layout_window_outward(most), way))
            most = side;
    }
    return most;
}

static bool leaf_is_stated(const fw_device *device, const fw_device_revolute *j) {
    const fw_device_flexure_kind kind = device->flexure[j->flexure].kind;
    return is_on_ground(j) && !isnan(j->axis_rad) &&
           (kind == FW_FLEXURE_LEAF || kind == FW_FLEXURE_PATH);
}

bool fw_layout_has_stated_leaf(const fw_device *device) {
    for (int j = 0; j < device->nrevolute; j++)
        if (leaf_is_stated(device, &device->revolute[j])) return true;
    return false;
}

/* does the leaf run straight to a side of the window, from its hinge to the end that the ground holds? */
static bool leaf_leads(const fw_layout_drawing *d, int joint, fw_layout_window_side *to) {
    const double straight = 0.97; /* cosine of 14 degrees */
    const fw_layout_local *own = &fw_layout_side_of(d, joint, FW_GROUND)->local;
    if (!leaf_is_stated(d->device, &d->device->revolute[joint])) return false;
    const fw_geometry_vec2 way = fw_sub(fw_layout_local_point(own, fw_v(0.0, 1.0)),
                                        fw_layout_local_point(own, fw_v(0.0, 0.0)));
    *to = side_along(way);
    return fw_dot(fw_layout_window_outward(*to), way) >= straight;
}

bool fw_layout_sides_by_leaf(const fw_layout_drawing *d, fw_layout_window_side *side) {
    int joint[2];
    fw_layout_window_side to;
    const int n = fw_layout_body_joints(d->device, FW_GROUND, joint, 2);
    const bool both = n == 2 && leaf_leads(d, joint[0], &to) && leaf_leads(d, joint[1], &to);
    bool any = both; /* a bar between both would hold them aside of their lines */
    if (n == 2 && !both) return false;
    for (int j = 0; j < d->device->nrevolute; j++) {
        if (!is_on_ground(&d->device->revolute[j])) continue;
        side[j] = side_along(fw_layout_side_of(d, j, FW_GROUND)->direction);
        if (!leaf_leads(d, j, &to)) continue;
        any = any || to != side[j];
        side[j] = to;
    }
    return any;
}

double fw_layout_base_reach(const fw_layout_drawing *d, int joint) {
    fw_geometry_vec2 out = fw_layout_side_of(d, joint, FW_GROUND)->direction;
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

/* ---- walls ----
   What of a drawing stands as one, and where such walls are made. */

bool fw_layout_is_wall(const fw_layout_piece *p) {
    switch (p->role) {
    case FW_ROLE_STRUCTURE:
    case FW_ROLE_FRAME:
    case FW_ROLE_TETHER:
        return p->body >= 0 || p->body == FW_GROUND || p->body == FW_ISLAND;
    case FW_ROLE_FLEXURE: /* bends: a thing of its own */
    case FW_ROLE_TEXT:
    case FW_ROLE_MARK:
    case FW_ROLE_DICING:
    case FW_ROLE_BACK:
    case FW_ROLE_CAVITY: /* of the carrier */
    case FW_ROLE_LAND:
    case FW_ROLE_METAL:
    case FW_ROLE_COUNT:
    case FW_ROLE_CELL:
        break;
    }
    return false;
}

bool fw_layout_has_outline(const fw_layout *layout, int body) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (fw_layout_is_wall(p) && (body < 0 ? p->body < 0 : p->body == body)) return true;
    }
    return false;
}

double fw_layout_walls_m(const fw_layout *layout) {
    return 2 * layout->edge_m + fabs(layout->flare_m);
}

/* ---- area and moments ----
   Area, edges and moments of what belongs to a body: its outline with the pieces in its holes, and
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
    *to = (fw_layout_body_layout){.area_m2 = m.area_m2,
                                  .centroid = m.centroid,
                                  .polar_m4 = m.polar_m4,
                                  .spread_m4 = m.spread_m4};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < part[i].count; k++)
            if (!(part[i].segment[k].flags & FW_SEGMENT_JOINT))
                edge_moments(&part[i].segment[k], m.centroid, &to->perimeter_m, &to->edge_m2,
                             &to->edge_m3);
    return FW_OK;
}

/* ---- what a process does to an outline ---- */

/* its soundness says how wide its spaces and widths are, but for those that a description draws */
static bool has_drawn(const fw_geometry_contour *c) {
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].flags & FW_SEGMENT_DRAWN) return true;
    return false;
}

/* a process moves the edges by about 1 um to either side; sound: of this outline */
fw_status fw_layout_takes_bias(fw_arena *arena, const fw_geometry_contour *c, double sound,
                               bool *good) {
    static const double bias_m[] = {1.5e-6, -1.5e-6};
    const double known = has_drawn(c) ? 0.0 : 0.999 * fmin(1.0, sound);
    const double clear_m[] = {known * fw_layout_rule.own_space_m,
                              known * fw_layout_rule.own_width_m};
    *good = true;
    for (int i = 0; i < 2 && *good; i++) {
        fw_geometry_contour moved;
        fw_status status =
            fw_geometry_contour_offset_clear(arena, c, bias_m[i], clear_m[i], &moved, NULL, NULL);
        *good = status == FW_OK;
        if (status != FW_GEOMETRY) FW_TRY(status);
    }
    return FW_OK;
}
