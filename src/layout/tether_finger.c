/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a finger of the frame may reach a body, before anything of it is drawn, and what stands in its way where none
   may. */
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>
#include <string.h>

/* ---- where one may ---- */

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
   at the window's edge, once in between; NaN: it is not inside at `deep`, as where the body is just as
   thick as a finger begins below its edge */
static double edge_depth(const fw_layout_drawing *d, const fw_layout_attachment *a, double along,
                         double deep) {
    double in = deep, out = 0.0;
    const fw_geometry_contour *body = &d->plain[a->body];
    if (!fw_geometry_contour_contains(body, fw_layout_window_point(d->layout, a->side, along, in)))
        return (double)NAN;
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
    if (isnan(low) || isnan(middle) || isnan(high)) return -1.0;
    double cut =
        fmin(middle, fmin(low, high)) - r * hypot(1.0, slope) - fw_layout_rule.neck_straight_m;
    return middle - cut < fw_layout_rule.tether_cut_m ? fw_layout_to_grid(cut)
                                                      : -1.0; /* else: no straight edge */
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

/* ---- a body without a tether ----
   A body without a tether: of all straight fingers that could reach its edge were it alone, the one
   whose way has the least in it.

   Fingers are looked at every 20 um along the body on all four sides. A part that lies across a finger has to stand aside,
   along the side of the window: beyond the finger and its clearance with all that it has in the finger's depth. What
   lies on either side of it leaves an opening: where that is wide enough the finger goes into its middle, else it has
   to be wider. Arcs by 16 chords and their rise, so that a part may be asked to go farther than it must, by 1 % of its
   radius at most. In: a drawing with its base and its rings and stators. Out: a finger that fits, or clauses. Cost: some
   ms, only for what is refused. Test: tests/unit/layout/test_missing.c, tests/accept/held.py */

typedef struct flank { /* of the opening that a finger stands in */
    double
        by_m; /* how far it reaches into the finger and its clearance; below 0: that much is free */
    const char *name;
} flank;

typedef struct way { /* of one finger */
    fw_layout_window_side side;
    double along, deep; /* deep: of the cut, in the window */
    double aside_m;     /* what all in the way have to move together */
    int parts;
    const char *first; /* of them the one that is most in the way */
    double first_m;
    flank left, right; /* of what does not lie across it */
    double wider_m;    /* > 0: by how much their opening is too narrow */
} way;

typedef struct extent { /* along the side, of what lies in the depth of a finger */
    double low, high;   /* low > high: nothing */
    double left,
        right; /* where what is left and what is right of the finger's line ends; -+HUGE_VAL: nothing */
    bool across; /* something lies across that line */
} extent;

static const extent NO_EXTENT = {HUGE_VAL, -HUGE_VAL, -HUGE_VAL, HUGE_VAL, false};

static bool is_upright(fw_layout_window_side side) {
    return side == FW_LEFT || side == FW_RIGHT;
}

/* metres inwards from the window's edge */
static double depth_of(const fw_layout *l, fw_layout_window_side side, fw_geometry_vec2 p) {
    return fw_dot(fw_sub(fw_layout_window_point(l, side, 0.0, 0.0), p),
                  fw_layout_window_outward(side));
}

static void take_range(extent *e, double along, double low, double high) {
    e->low = fmin(e->low, low);
    e->high = fmax(e->high, high);
    const double touches_m = 1e-9;
    if (high < along - touches_m)
        e->left = fmax(e->left, high);
    else if (low > along + touches_m)
        e->right = fmin(e->right, low);
    else
        e->across = true;
}

static void take_chord(extent *e, double along, double a0, double d0, double a1, double d1,
                       double most, double more) {
    double t0 = 0.0, t1 = 1.0;
    if (fmin(d0, d1) > most) return;
    if (d0 > most) t0 = (most - d0) / (d1 - d0);
    if (d1 > most) t1 = (most - d0) / (d1 - d0);
    double p = a0 + t0 * (a1 - a0), q = a0 + t1 * (a1 - a0);
    take_range(e, along, fmin(p, q) - more, fmax(p, q) + more);
}

/* of an outline less deep than `most`; low > high: nothing of it */
static extent extent_of(const fw_layout *l, const way *w, double most,
                        const fw_geometry_contour *c) {
    enum { CHORDS = 16 };
    const fw_layout_window_side side = w->side;
    extent e = NO_EXTENT;
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        bool line = s->kind == FW_LINE;
        double rise = line ? 0.0 : s->radius * (1.0 - cos(0.5 * s->sweep_rad / CHORDS));
        fw_geometry_vec2 p = s->a;
        for (int k = 1; k <= (line ? 1 : CHORDS); k++) {
            fw_geometry_vec2 q = s->b;
            if (!line && k < CHORDS) {
                double turn = k * s->sweep_rad / CHORDS, x = cos(turn), y = sin(turn);
                fw_geometry_vec2 r = fw_sub(s->a, s->centre);
                q = fw_v(s->centre.x + x * r.x - y * r.y, s->centre.y + y * r.x + x * r.y);
            }
            bool up = is_upright(side);
            take_chord(&e, w->along, up ? p.y : p.x, depth_of(l, side, p), up ? q.y : q.x,
                       depth_of(l, side, q), most + rise, rise);
            p = q;
        }
    }
    return e;
}

static void take_flank(flank *f, double by_m, const char *name) {
    if (by_m > f->by_m) *f = (flank){by_m, name};
}

/* e: of a part that keeps space_m from the finger */
static void take_part(way *w, extent e, double space_m, const char *name) {
    double half = 0.5 * fw_layout_rule.tether_m + space_m;
    if (e.low > e.high) return;
    if (!e.across) {
        take_flank(&w->left, e.left - (w->along - half), name);
        take_flank(&w->right, (w->along + half) - e.right, name);
        return;
    }
    double aside = fmin(e.high - (w->along - half), (w->along + half) - e.low);
    w->aside_m += aside;
    w->parts++;
    if (aside <= w->first_m) return;
    w->first_m = aside;
    w->first = name;
}

/* the finger goes into the middle of its opening, as far as it has to */
static void take_opening(way *w) {
    const double left = w->left.by_m, right = w->right.by_m;
    w->wider_m = left + right;
    if (left <= 0.0 && right <= 0.0) return;
    if (isfinite(left) && isfinite(right))
        w->along += 0.5 * (left - right);
    else
        w->along += left > 0.0 ? left : -right;
    if (!(w->wider_m > 0.0)) return;
    w->aside_m += w->wider_m;
    w->parts++;
    if (w->wider_m <= w->first_m) return;
    w->first_m = w->wider_m;
    w->first = w->left.name;
}

static fw_status take_all(fw_layout_drawing *d, int body, way *w) {
    const double space = fw_layout_rule.strip_clear_m;
    const fw_layout *l = d->layout;
    const double most = w->deep + space;
    for (int s = 0; s < d->nslot; s++) {
        if (s == body || d->plain[s].count == 0) continue;
        const char *name = fw_layout_body_label(d, s < d->device->nbody ? s : FW_GROUND);
        FW_NEED(name);
        take_part(w, extent_of(l, w, most, &d->plain[s]), space, name);
    }
    for (int i = 0; i < d->nlug; i++)
        take_part(w, extent_of(l, w, most, &d->lug[i]), space, "an eyelet or a stator");
    for (int i = 0; i < d->nattachment; i++)
        if (d->attachment[i].finger.count > 0)
            take_part(w, extent_of(l, w, most, &d->attachment[i].finger),
                      fw_layout_rule.fingers_apart_m, "another tether");
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &l->hinge[j];
        const double r = h->keep_out_m + fw_layout_rule.strip_disc_m;
        double along = is_upright(w->side) ? h->centre.y : h->centre.x;
        const char *name =
            fw_arena_printf(d->arena, "%s%s", FW_NAMED("hinge", d->device->revolute[j].id));
        FW_NEED(name);
        extent disc = NO_EXTENT;
        if (depth_of(l, w->side, h->centre) - r < w->deep)
            take_range(&disc, w->along, along - r, along + r);
        take_part(w, disc, 0.0, name);
    }
    return FW_OK;
}

static void keep_fit(const way *w, fw_layout_fit fit[FW_LAYOUT_FITS], int *nfit) {
    const double same_m = 1e-6;
    for (int i = 0; i < *nfit; i++)
        if (fit[i].side == w->side && fabs(fit[i].along - w->along) < same_m) return;
    if (*nfit < FW_LAYOUT_FITS) fit[(*nfit)++] = (fw_layout_fit){w->side, w->along};
}

/* the finger at `along`, if the body alone would take it */
static fw_status look_at(fw_layout_drawing *d, int body, fw_layout_window_side side, double along,
                         way *best, fw_layout_fit fit[FW_LAYOUT_FITS], int *nfit) {
    const double into = 30e-6;
    fw_layout_attachment a = {.body = body};
    fw_layout_ray_hit hit = fw_layout_finger_edge(d, body, side, along);
    if (hit.segment < 0) return FW_OK;
    fw_geometry_vec2 from = fw_add(hit.at, -into, fw_layout_window_outward(side));
    double start = is_upright(side) ? from.x : from.y;
    FW_TRY(fw_layout_strip_draw(d, side, start, start, along, 0.5 * fw_layout_rule.tether_m,
                                fw_layout_rule.tether_stub_m, &a));
    if (!fw_layout_finger_leaves_once(d, &a, from)) return FW_OK;
    double deep = depth_of(d->layout, side, from);
    double cut = fw_layout_finger_cut(d, &a, fw_layout_to_grid(along), deep);
    if (cut < fw_layout_rule.finger_least_m) return FW_OK;
    way w = {.side = side,
             .along = along,
             .deep = cut,
             .left = {.by_m = -HUGE_VAL},
             .right = {.by_m = -HUGE_VAL}};
    FW_TRY(take_all(d, body, &w));
    take_opening(&w);
    if (w.parts == 0)
        keep_fit(&w, fit, nfit);
    else if (w.aside_m < best->aside_m)
        *best = w;
    return FW_OK;
}

/* what would have to be otherwise for the finger to have room; NULL: FW_NOMEM */
static const char *way_clear(fw_arena *arena, const way *w, const char *side) {
    char at[32], um[32], aside[32];
    const char *of = "", *others = "";
    const bool opening = w->wider_m > 0.0 && w->first_m == w->wider_m;
    if (opening && strcmp(w->left.name, w->right.name) != 0)
        of = fw_arena_printf(arena, " and %s", w->right.name);
    if (w->parts > 1)
        others = fw_arena_printf(arena, ", and %d more beside it, %s um altogether", w->parts - 1,
                                 fw_layout_um(um, w->aside_m));
    if (!of || !others) return NULL;
    return fw_arena_printf(arena,
                           "a finger from the %s side at %s = %s um, were %s%s%s %s um %s%s; or "
                           "<die tethers=\"no\"/>, and the released device is handled with care",
                           side, is_upright(w->side) ? "y" : "x", fw_layout_um(at, w->along),
                           opening ? "the opening beside " : "", w->first, of,
                           fw_number_text(aside, sizeof aside, ceil(w->first_m * 1e6), 6),
                           opening ? "wider" : "farther aside", others);
}

fw_status fw_layout_tether_room(fw_layout_drawing *d, int body, fw_layout_fit fit[FW_LAYOUT_FITS],
                                int *nfit, fw_geometry_vec2 *at, const char **why,
                                const char **room) {
    static const char *const side_name[] = {
        [FW_LEFT] = "left", [FW_RIGHT] = "right", [FW_BOTTOM] = "lower", [FW_TOP] = "upper"};
    const double step = 20e-6;
    fw_geometry_box box = fw_geometry_contour_box(&d->plain[body]);
    way best = {.aside_m = HUGE_VAL};
    *at = d->layout->body[body].centroid;
    *nfit = 0;
    for (int s = FW_LEFT; s <= FW_TOP; s++) {
        bool up = is_upright((fw_layout_window_side)s);
        for (double p = up ? box.y0 : box.x0; p < (up ? box.y1 : box.x1); p += step)
            FW_TRY(look_at(d, body, (fw_layout_window_side)s, p, &best, fit, nfit));
    }
    *why =
        "no straight finger of the frame reaches it without crossing another part, so that nothing "
        "holds it between release and use";
    *room = "no straight edge of the body faces the frame at all: give it one 60 um long, or say "
            "<die tethers=\"no\"/> and handle the released device with care";
    if (*nfit > 0 && best.parts == 0)
        *room = "an edge of the body that is straight for 60 um and away from its corners, "
                "contacts and "
                "springs, or <die tethers=\"no\"/>, and the released device is handled with care";
    if (best.parts == 0) return FW_OK;
    *at = fw_layout_window_point(d->layout, best.side, best.along, best.deep);
    FW_NEED(*why = fw_arena_printf(
                d->arena,
                "no straight finger of the frame reaches it without crossing another part (from "
                "the "
                "%s side, where the way is clearest, %s), so that nothing holds it between release "
                "and use",
                side_name[best.side], best.first));
    FW_NEED(*room = way_clear(d->arena, &best, side_name[best.side]));
    return FW_OK;
}
