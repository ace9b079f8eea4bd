/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a drawing may meet what: the outlines of every body and of all that stands, cut where
   they enter the region of a hinge. */
#include "clearance/clearance.h"
#include "geometry/segment.h"
#include <math.h>

enum { ROOM = 64 };
static const double fw_on_circle_m = 1e-7;

typedef struct building {
    fw_arena *arena;
    const fw_layout *layout;
    const fw_device *device;
    const fw_mechanism *mechanism;
    fw_clearance_things *things;
    int *room; /* (nbody + 1) */
} building;

static int solid_of(const building *b, int body) {
    return body >= 0 && body < b->things->nbody ? body : b->things->nbody;
}

static bool belongs(const fw_layout_hinge_layout *h, int body) {
    return h->drawn && (h->lower == body || h->upper == body);
}

static fw_status keep(building *b, int solid, const fw_clearance_edge *edge) {
    fw_clearance_solid *s = &b->things->solid[solid];
    if (s->count == b->room[solid]) {
        int more = b->room[solid] ? 2 * b->room[solid] : ROOM;
        FW_NEED(s->edge = fw_arena_grow(b->arena, s->edge, (size_t)s->count, (size_t)more,
                                        sizeof *s->edge));
        b->room[solid] = more;
    }
    s->edge[s->count++] = *edge;
    return FW_OK;
}

/* bodies are cut out along the circle: what lies on it is the hinge's own */
static double circle_m(const fw_layout_hinge_layout *h) {
    return h->keep_out_m + fw_on_circle_m;
}

/* Parts of a segment inside and outside of one hinge's circle. The hinge's own verdict judges what
   happens inside (touches, free_rad). A JOINT there is no edge: the flexure goes on from it. */
static fw_status cut(building *b, int solid, int joint, fw_clearance_edge edge) {
    const fw_layout_hinge_layout *h = &b->layout->hinge[joint];
    const fw_geometry_segment whole = edge.segment;
    const double r = circle_m(h);
    fw_geometry_vec2 east = {h->centre.x + r, h->centre.y};
    const fw_geometry_segment circle = {.kind = FW_ARC,
                                        .a = east,
                                        .b = east,
                                        .centre = h->centre,
                                        .radius = r,
                                        .sweep_rad = FW_TURN};
    fw_geometry_hit hit[FW_MOST_HITS];
    double t[FW_MOST_HITS + 2] = {0};
    int n = fw_geometry_segment_intersect(&whole, &circle, hit), m = 1;
    for (int i = 0; i < n; i++)
        if (hit[i].tp > 1e-9 && hit[i].tp < 1 - 1e-9) {
            int k = m++;
            for (; k > 1 && t[k - 1] > hit[i].tp; k--)
                t[k] = t[k - 1];
            t[k] = hit[i].tp;
        }
    t[m] = 1;
    for (int i = 0; i < m; i++) {
        if (!(t[i + 1] > t[i])) continue;
        fw_geometry_vec2 p = fw_geometry_segment_point(&whole, t[i]),
                         q = fw_geometry_segment_point(&whole, t[i + 1]);
        fw_geometry_vec2 middle = fw_geometry_segment_point(&whole, 0.5 * (t[i] + t[i + 1]));
        edge.segment = m == 1 ? whole : fw_geometry_segment_cut(&whole, t[i], p, t[i + 1], q);
        edge.hinge = vec_distance(middle, h->centre) < r ? joint : FW_NONE;
        edge.other = FW_NONE;
        if (edge.hinge != FW_NONE)
            edge.other = solid_of(b, solid_of(b, h->lower) == solid ? h->upper : h->lower);
        if (edge.hinge != FW_NONE && (whole.flags & FW_SEGMENT_JOINT)) continue;
        FW_TRY(keep(b, solid, &edge));
    }
    return FW_OK;
}

/* circles of hinges lie apart (FW-D125): an edge that crosses two of them is cut by one after the
   other */
static fw_status add(building *b, int solid, int body, const fw_clearance_edge *edge) {
    fw_geometry_box box = fw_segment_box(&edge->segment);
    int first = b->things->solid[solid].count, joint = 0;
    FW_TRY(keep(b, solid, edge));
    for (; joint < b->device->nrevolute; joint++) {
        const fw_layout_hinge_layout *h = &b->layout->hinge[joint];
        const fw_geometry_box at = {h->centre.x, h->centre.y, h->centre.x, h->centre.y};
        if (!belongs(h, body) || fw_box_gap(box, at) > circle_m(h)) continue;
        int last = b->things->solid[solid].count;
        for (int i = first; i < last; i++) { /* cut parts go behind, this one is taken out */
            fw_clearance_edge whole = b->things->solid[solid].edge[i];
            if (whole.hinge == FW_NONE)
                FW_TRY(cut(b, solid, joint, whole));
            else
                FW_TRY(keep(b, solid, &whole));
        }
        fw_clearance_solid *s = &b->things->solid[solid];
        for (int i = last; i < s->count; i++)
            s->edge[first + i - last] = s->edge[i];
        s->count = first + s->count - last;
    }
    return FW_OK;
}

/* the body that a tether ends at, which the layout says of its piece */
static int held_by(const fw_layout *layout, const fw_layout_piece *tether) {
    for (int i = 0; i < layout->ntether; i++)
        if (layout->tether[i].label == tether->label) return layout->tether[i].body;
    return FW_NONE;
}

static fw_status add_piece(building *b, const fw_layout_piece *p) {
    int solid = solid_of(b, p->body);
    fw_clearance_edge edge = {
        .hinge = FW_NONE, .other = FW_NONE, .held = FW_NONE, .label = p->label};
    if (p->role == FW_ROLE_TETHER) edge.held = held_by(b->layout, p);
    for (int i = 0; i < p->contour.count; i++) {
        edge.segment = p->contour.segment[i];
        FW_TRY(add(b, solid, solid < b->things->nbody ? solid : FW_GROUND, &edge));
    }
    return FW_OK;
}

static const fw_mechanism_hinge *hinge_at(const fw_mechanism *m, int joint) {
    for (int i = 0; i < m->nhinge; i++)
        if (m->hinge[i].pin == joint) return &m->hinge[i];
    return NULL;
}

/* A flexure that bends stays within a disc about its hinge point, which goes with either body
   (clearance_strip.c). Its own two bodies are the hinge's matter. Where nothing says what it bears
   the disc is the circle that the layout keeps for it. */
static fw_status add_flexure(building *b, const fw_layout_piece *p) {
    const fw_layout_hinge_layout *h = &b->layout->hinge[p->joint];
    const fw_mechanism_hinge *hinge = hinge_at(b->mechanism, p->joint);
    fw_clearance_strip strip = {.known = false};
    fw_clearance_bend bend = {.known = false};
    FW_TRY(fw_clearance_strip_of(b->arena, b->layout, p, &strip));
    if (hinge) bend = fw_clearance_bend_of(b->mechanism, hinge);
    double r = h->keep_out_m;
    if (strip.known && bend.known) r = fw_clearance_strip_reach(&strip, &bend);
    const fw_geometry_vec2 c = h->centre, east = {c.x + r, c.y}, west = {c.x - r, c.y};
    for (int side = 0; side < 2; side++) {
        int solid = solid_of(b, side ? h->upper : h->lower);
        fw_clearance_edge edge = {.hinge = p->joint,
                                  .other = solid_of(b, side ? h->lower : h->upper),
                                  .held = FW_NONE,
                                  .bends = true,
                                  .label = p->label};
        for (int half = 0; half < 2; half++) {
            edge.segment = (fw_geometry_segment){.kind = FW_ARC,
                                                 .a = half ? west : east,
                                                 .b = half ? east : west,
                                                 .centre = c,
                                                 .radius = r,
                                                 .sweep_rad = FW_PI};
            FW_TRY(keep(b, solid, &edge));
        }
    }
    return FW_OK;
}

/* Nothing that moves may be where the saw goes: the lane begins where the frame ends. */
static fw_status add_lane(building *b) {
    fw_geometry_box frame = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < b->layout->npiece; i++) {
        const fw_layout_piece *p = &b->layout->piece[i];
        if (p->role == FW_ROLE_FRAME)
            frame = fw_box_join(frame, fw_geometry_contour_box(&p->contour));
    }
    if (!(frame.x1 > frame.x0)) return FW_OK;
    const fw_geometry_vec2 corner[5] = {{frame.x0, frame.y0},
                                        {frame.x1, frame.y0},
                                        {frame.x1, frame.y1},
                                        {frame.x0, frame.y1},
                                        {frame.x0, frame.y0}};
    for (int i = 0; i < 4; i++) {
        const fw_clearance_edge edge = {
            .segment = {.kind = FW_LINE, .a = corner[i], .b = corner[i + 1]},
            .hinge = FW_NONE,
            .other = FW_NONE,
            .held = FW_NONE,
            .always = true,
            .label = "dicing lane"};
        FW_TRY(keep(b, b->things->nbody, &edge));
    }
    return FW_OK;
}

/* As drawn; the mechanism says where centres of mass are. Cost: every segment against every hinge
   of its body. Test: test_clearance.c */
fw_status fw_clearance_things_of(fw_arena *arena, const fw_layout *layout, const fw_mechanism *m,
                                 fw_clearance_things *things) {
    size_t n = (size_t)m->nbody + 1;
    building b = {
        .arena = arena, .layout = layout, .device = m->device, .mechanism = m, .things = things};
    *things = (fw_clearance_things){.nbody = m->nbody};
    FW_NEED(things->solid = fw_arena_array(arena, fw_clearance_solid, n));
    FW_NEED(b.room = fw_arena_array(arena, int, n));
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (fw_layout_is_wall(p)) FW_TRY(add_piece(&b, p));
        if (p->role == FW_ROLE_FLEXURE && p->joint >= 0 && layout->hinge[p->joint].drawn)
            FW_TRY(add_flexure(&b, p));
    }
    FW_TRY(add_lane(&b));
    for (size_t i = 0; i < n; i++) {
        fw_clearance_solid *s = &things->solid[i];
        if (i + 1 < n) {
            const fw_mechanism_mass *at = m->drawn ? &m->drawn[i] : &m->body[i];
            s->centre = (fw_geometry_vec2){at->x_m, at->y_m};
            s->turned_rad = at->phi_rad;
        }
        for (int k = 0; k < s->count; k++) {
            fw_geometry_box box = fw_segment_box(&s->edge[k].segment);
            s->box = k ? fw_box_join(s->box, box) : box;
        }
    }
    return FW_OK;
}
