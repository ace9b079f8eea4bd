/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/verdict_parts.h"
#include "verdict/verdict_fabrication.h"
#include "flexure/flexure.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

bool fw_verdict_fabrication_open(const fw_verdict_fabrication_input *input, int ninput) {
    return ninput > 0 && input[ninput - 1].open;
}

fw_verdict_fabrication fw_verdict_fabrication_at(const fw_verdict_fabrication_input *input,
                                                 int ninput, const double *x) {
    fw_verdict_fabrication fabricated = {.thickness_ratio = 1.0, .youngs_ratio = 1.0};
    for (int i = 0; i < ninput; i++) {
        double off = x[i] - input[i].drawn;
        fabricated.edge_m += input[i].edge_m * (x[i] - input[i].even) + input[i].edge_at_m;
        fabricated.flare_m += input[i].flare_m * off + input[i].flare_at_m;
        fabricated.thickness_ratio += input[i].thickness * off + input[i].thickness_at;
        fabricated.youngs_ratio += input[i].youngs * off + input[i].youngs_at;
        fabricated.expansion_per_K += input[i].expansion * off + input[i].expansion_at;
        fabricated.substrate_per_K += input[i].substrate * off + input[i].substrate_at;
        fabricated.local_m += input[i].local * off;
    }
    return fabricated;
}

/* ---- the variant ---- */

static void change_variant(fw_mechanism_variant *v, const fw_verdict_fabrication *fabricated) {
    double stiff = fabricated->thickness_ratio * fabricated->youngs_ratio;
    v->thickness_m *= fabricated->thickness_ratio;
    fw_device_material *m = &v->material;
    m->youngs.value *= fabricated->youngs_ratio;
    /* of a crystal all directions alike: what is known is by how much the stiffness may be off */
    m->c11.value *= fabricated->youngs_ratio;
    m->c12.value *= fabricated->youngs_ratio;
    m->c44.value *= fabricated->youngs_ratio;
    m->expansion.value += fabricated->expansion_per_K;
    v->substrate_expansion.value += fabricated->substrate_per_K;
    v->explicit_mass_scale *= fabricated->thickness_ratio;
    v->explicit_stiffness_scale *= stiff;
    v->explicit_damping_scale *= sqrt(stiff * fabricated->thickness_ratio);
}

/* ---- flexures and their joints ---- */

/* Fillets up to here, over the width, were compared with solids closely; beyond, the law holds to
   twice the width with a wider band (fw_flexure_shape_marks). */
static const double compared_fillet = 1.25;

/* A concave fillet shrinks where the material grows, and grows where it recedes. One that leaves
   the range only thereby counts as its end: the wider a fillet the less it concentrates, so that
   this is on the safe side, by 2 % at 1.5. */
static double fabricated_fillet(double fillet_m, double edge_m, double drawn_m, double width_m) {
    double fabricated = fmax(0.0, fillet_m - edge_m);
    return fillet_m > compared_fillet * drawn_m ? fabricated
                                                : fmin(fabricated, compared_fillet * width_m);
}

/* what is left of a piece that loses `first` and `last` at its ends; its width is taken as the parabola through the
   three that are stated */
static void shorten(fw_geometry_strip_piece *p, double first_m, double last_m) {
    const double *w = p->width_m, whole = p->length_m;
    const double bend = 2.0 * (w[0] + w[2] - 2.0 * w[1]), slope = w[2] - w[0] - bend;
    double now[3];
    for (int k = 0; k < 3; k++) {
        double at = (first_m + 0.5 * k * (whole - first_m - last_m)) / whole;
        now[k] = w[0] + at * (slope + at * bend);
    }
    bool uniform = w[0] == w[1] && w[1] == w[2];
    for (int k = 0; k < 3 && !uniform; k++)
        p->width_m[k] = now[k];
    p->length_m = whole - first_m - last_m;
}

/* Both edges of a path move by `edge_m` along their normals, and so do the walls that it grows out of: either end
   stands out by that. */
static fw_status change_pieces(fw_arena *arena, double edge_m, fw_device_flexure *f) {
    if (f->npiece == 0) return FW_OK;
    fw_geometry_strip_piece *piece =
        fw_arena_array(arena, fw_geometry_strip_piece, (size_t)f->npiece);
    FW_NEED(piece);
    for (int i = 0; i < f->npiece; i++) {
        piece[i] = f->piece[i];
        shorten(&piece[i], i == 0 ? edge_m : 0.0, i + 1 == f->npiece ? edge_m : 0.0);
        for (int k = 0; k < 3; k++)
            piece[i].width_m[k] += 2.0 * edge_m;
    }
    f->piece = piece;
    return FW_OK;
}

/* the same of an arc or a line, whose narrowest or widest place stays in the middle */
static void change_length(double edge_m, fw_device_flexure *f) {
    const double whole = f->length_m, left = (whole - 2.0 * edge_m) / whole;
    if (f->width_middle_m > 0.0)
        f->width_m = f->width_middle_m + (f->width_m - f->width_middle_m) * left * left;
    f->length_m = whole - 2.0 * edge_m;
    if (f->kind == FW_FLEXURE_CSFH) f->angle_rad *= left;
    if (f->kind == FW_FLEXURE_PATH)
        f->angle_rad -=
            edge_m * (f->piece[0].curvature_per_m + f->piece[f->npiece - 1].curvature_per_m);
}

/* what is left at one hinge, where they differ */
static fw_verdict_fabrication at_hinge(const fw_verdict_fabrication *fabricated, int joint) {
    fw_verdict_fabrication here = *fabricated;
    if (here.sign) here.edge_m += here.sign[joint] * here.local_m;
    return here;
}

/* a flexure of its own for every hinge */
static fw_status tell_apart(fw_arena *arena, const fw_device *was, fw_device *d) {
    size_t f = (size_t)was->nflexure, j = (size_t)was->nrevolute;
    FW_NEED(d->flexure = fw_arena_grow(arena, d->flexure, f, f + j, sizeof *d->flexure));
    for (int i = 0; i < was->nrevolute; i++) {
        const int own = was->revolute[i].flexure;
        if (own == FW_NONE) continue;
        d->flexure[d->nflexure] = was->flexure[own];
        d->revolute[i].flexure = d->nflexure++;
    }
    return FW_OK;
}

static fw_status change_flexure(fw_arena *arena, const fw_verdict_fabrication *fabricated,
                                fw_device_flexure *f, const char **gone) {
    double drawn_width = f->width_m, edge = fabricated->edge_m;
    if (isnan(f->fillet_m)) f->fillet_m = fw_flexure_default_fillet(f);
    change_length(edge, f);
    f->width_m += 2.0 * edge;
    if (f->width_middle_m > 0.0) f->width_middle_m += 2.0 * edge;
    FW_TRY(change_pieces(arena, edge, f));
    f->flare_m = fabricated->flare_m;
    f->fillet_m = fabricated_fillet(f->fillet_m, edge, drawn_width, f->width_m);
    bool gap = f->gap_m > 0.0;
    f->gap_m = gap ? f->gap_m - 2.0 * edge : f->gap_m;
    char now[32], was[32];
    fw_number_text(was, sizeof was, drawn_width * 1e6, 4);
    if (!(f->width_m > fabs(f->flare_m))) {
        fw_number_text(now, sizeof now, 1e6 * (f->width_m - fabs(f->flare_m)), 3);
        FW_NEED(*gone = fw_arena_printf(
                    arena, "%s%s, %s um wide as drawn, is cut through (%s um are left)",
                    FW_NAMED("flexure", f->id), was, now));
    } else if (gap && !(f->gap_m > fabs(f->flare_m))) {
        FW_NEED(*gone = fw_arena_printf(
                    arena, "the gap of %s%s closes, so that its surfaces are one piece",
                    FW_NAMED("flexure", f->id)));
    }
    return FW_OK;
}

static void move(double *x, double *y, double along_m, double direction_rad) {
    if (isnan(*x) || isnan(*y)) return;
    *x += along_m * cos(direction_rad);
    *y += along_m * sin(direction_rad);
}

static double turned(const fw_device *d, int body) {
    return body == FW_GROUND ? 0.0 : d->body[body].phi_rad;
}

/* the hinge point is the centre of elastic weights of what stands; where the axis is not drawn it
   stays */
static void move_hinge_point(fw_device *d, int j, fw_geometry_vec2 by, double axis_rad) {
    fw_device_revolute *joint = &d->revolute[j];
    const double way = hypot(by.x, by.y), to = axis_rad + atan2(by.y, by.x);
    move(&joint->x_m, &joint->y_m, way, to);
    move(&joint->ax_m, &joint->ay_m, way, to - turned(d, joint->body_a));
    move(&joint->bx_m, &joint->by_m, way, to - turned(d, joint->body_b));
}

/* From W as drawn to W as made, in the frame as drawn. An arc and a leaf keep theirs, with their middle; that of a path
   goes with its two ends, the first of which is now edge_m farther along. */
static fw_geometry_vec2 way_of_centre(const fw_flexure_input *then, double was_m,
                                      const fw_flexure_input *made, double now_m, double edge_m) {
    fw_flexure_shape before, now;
    if (then->kind != FW_FLEXURE_PATH) return (fw_geometry_vec2){now_m - was_m, 0.0};
    fw_flexure_shape_of(then, &before);
    fw_flexure_shape_of(made, &now);
    const fw_geometry_pose at =
        fw_geometry_strip_along(before.start, then->piece[0].curvature_per_m, edge_m);
    const double turn = at.angle_rad - now.start.angle_rad, x = now_m - now.start.x_m,
                 y = -now.start.y_m;
    return (fw_geometry_vec2){at.x_m + cos(turn) * x - sin(turn) * y - was_m,
                              at.y_m + sin(turn) * x + cos(turn) * y};
}

static void change_joint(const fw_device *was, const fw_layout *drawn, double edge_m,
                         fw_verdict_fabricated_device *out, int j) {
    fw_device *d = &out->device;
    fw_device_revolute *joint = &d->revolute[j];
    if (joint->flexure == FW_NONE) return;
    /* in one thickness and modulus, so that only the section counts */
    const fw_flexure_input then = fw_mechanism_flexure(was, drawn, &out->variant, j),
                           fabricated = fw_mechanism_flexure(d, out->drawn, &out->variant, j);
    fw_flexure_result before, now;
    fw_flexure_closed_form(&then, &before);
    fw_flexure_closed_form(&fabricated, &now);
    fw_flexure_flare(&then, was->flexure[was->revolute[j].flexure].flare_m, &before);
    fw_flexure_flare(&fabricated, d->flexure[joint->flexure].flare_m, &now);
    double ratio = now.stiffness_Nm_per_rad / before.stiffness_Nm_per_rad;
    joint->stiffness_Nm_per_rad *= ratio;
    joint->damping_Nms_per_rad *= sqrt(ratio);
    if (drawn && drawn->drawn && drawn->hinge[j].drawn)
        move_hinge_point(d, j,
                         way_of_centre(&then, before.centre_m, &fabricated, now.centre_m, edge_m),
                         drawn->hinge[j].axis_rad);
}

/* ---- bodies: what is drawn grows by e along every edge (fw_layout_body_measure); what is stated goes with it.
   A frame whose place is not stated stays where it was drawn. ---- */

static void change_body(const fw_layout_body_layout *shape, double edge_m, fw_device_body *body,
                        fw_layout_body_layout *changed) {
    if (!(shape->area_m2 > 0.0)) return;
    double area = fmax(0.01, 1.0 + edge_m * shape->perimeter_m / shape->area_m2),
           polar = fmax(0.01, 1.0 + edge_m * shape->edge_m3 / shape->polar_m4);
    double shift = edge_m / (area * shape->area_m2);
    body->mass_kg *= area;
    body->inertia_kg_m2 *= polar;
    if (isnan(body->x_m)) body->x_m = shape->centroid.x;
    if (isnan(body->y_m)) body->y_m = shape->centroid.y;
    changed->area_m2 *= area;
    changed->polar_m4 *= polar;
    changed->spread_m4.x *= polar, changed->spread_m4.y *= polar; /* as long a shape as it was */
    changed->centroid.x += shift * shape->edge_m2.x;
    changed->centroid.y += shift * shape->edge_m2.y;
}

static fw_status change_hinge_layout(fw_arena *arena, const fw_verdict_fabrication *fabricated,
                                     const fw_device_flexure *f, fw_layout_hinge_layout *h) {
    const double edge_m = fabricated->edge_m, out_m = edge_m + 0.5 * fabs(fabricated->flare_m);
    if (!h->drawn || !f) return FW_OK;
    h->fillet_m = fabricated_fillet(h->fillet_m, edge_m, f->width_m - 2.0 * edge_m, f->width_m);
    if (h->surface_radius_m > 0.0) h->surface_radius_m += edge_m;
    if (h->gap_m > 0.0) h->gap_m -= 2.0 * edge_m;
    return out_m == 0.0 ? FW_OK : fw_layout_free_rotation_made(arena, h, out_m, &h->free_rad);
}

/* ---- what drives, damps and touches ---- */

/* Fingers, films and round things are of the same layer: their tips and faces move as every edge does. A finger
   keeps its length, for its root moves as its tip does. */
static void change_comb(const fw_verdict_fabrication *fabricated, const fw_device *d,
                        fw_device_comb *c) {
    const double edge = fabricated->edge_m;
    c->gap_m -= 2.0 * edge;
    c->lean_m = fabs(fabricated->flare_m);
    c->depth_m *= fabricated->thickness_ratio; /* NaN stays: that of the layer */
    if (c->kind == FW_ELECTRODES_PLATE) {      /* its fringe does not feel what its bar loses */
        double own = c->direction_rad + turned(d, c->body_a) - turned(d, c->body_b);
        c->length_m += 2.0 * edge;
        move(&c->bx_m, &c->by_m, edge, own);
        return;
    }
    c->width_m = fw_device_comb_width_m(c) + 2.0 * edge;
    if (isnan(c->length_m)) c->length_m = 2.0 * c->overlap_m;
    c->overlap_m += 2.0 * edge;
}

static void change_film(const fw_verdict_fabrication *fabricated, fw_device_air *a) {
    a->gap_m -= 2.0 * fabricated->edge_m;
    a->length_m += 2.0 * fabricated->edge_m;
    a->depth_m *= fabricated->thickness_ratio;
    move(&a->x_m, &a->y_m, fabricated->edge_m, a->direction_rad);
}

/* a stated place and a drawn wall, whose corners are rounded, need not agree better */
static const double touches_m = 10e-6;

/* where a point of a body is drawn */
static fw_geometry_vec2 drawn_place(const fw_device *d, const fw_layout *layout, int body,
                                    double x_m, double y_m) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x_m, y_m};
    const fw_device_body *b = &d->body[body];
    const fw_geometry_vec2 centroid = layout->body[body].centroid;
    const double c = cos(b->phi_rad), s = sin(b->phi_rad);
    return (fw_geometry_vec2){(isnan(b->x_m) ? centroid.x : b->x_m) + c * x_m - s * y_m,
                              (isnan(b->y_m) ? centroid.y : b->y_m) + s * x_m + c * y_m};
}

bool fw_verdict_comes_near(const fw_layout *layout, int body, fw_geometry_vec2 at,
                           double distance_m) {
    bool any = false;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->body != body || !fw_layout_is_wall(p)) continue;
        any = true;
        for (int k = 0; k < p->contour.count; k++)
            if (fw_geometry_segment_nearest(&p->contour.segment[k], at, NULL, NULL) <= distance_m)
                return true;
    }
    return !any;
}

/* Is the first (or second) of the two that touch part of what is drawn of its body, and so of the layer? Of two round
   things each is about its point and no larger than the distance; a flat face goes through its point, and what it meets
   has its surface the distance before its own point. A bead that is held stands in the open. *at: where. */
static bool is_of_layer(const fw_device *d, const fw_layout *layout, const fw_device_contact_use *c,
                        bool second, fw_geometry_vec2 *at) {
    const int body = second ? c->body_b : c->body_a;
    *at = (fw_geometry_vec2){0, 0};
    if (!layout || !layout->drawn) return true;
    *at = drawn_place(d, layout, body, second ? c->bx_m : c->ax_m, second ? c->by_m : c->ay_m);
    if (!c->face) return fw_verdict_comes_near(layout, body, *at, c->distance_m + touches_m);
    if (second) {
        const double normal = c->face_rad + turned(d, c->body_a);
        move(&at->x, &at->y, -c->distance_m, normal);
    }
    return fw_verdict_comes_near(layout, body, *at, touches_m);
}

static bool is_outside(const fw_device_contact_use *c) {
    return c->joint == FW_NONE && c->side == FW_CONTACT_OUTSIDE && !isnan(c->distance_m);
}

bool fw_verdict_contact_drawn(const fw_device *d, const fw_layout *layout,
                              const fw_device_contact_use *c) {
    fw_geometry_vec2 at;
    return !is_outside(c) ||
           (is_of_layer(d, layout, c, false, &at) && is_of_layer(d, layout, c, true, &at));
}

static bool is_not_said(const fw_device *d, const fw_layout *layout,
                        const fw_device_contact_use *c) {
    return c->undrawn == FW_UNDRAWN_NOT_SAID && !fw_verdict_contact_drawn(d, layout, c);
}

const char *fw_verdict_undrawn_not_said(const fw_device *device, const fw_layout *layout,
                                        const char *flow) {
    for (int i = 0; layout && layout->drawn && i < device->nscene; i++)
        for (int k = 0; k < device->scene[i].ncontact; k++)
            if (fw_device_in_flow(device->scene[i].flow, flow) &&
                is_not_said(device, layout, &device->scene[i].contact[k]))
                return fw_text_name(device->scene[i].contact[k].id);
    return NULL;
}

fw_status fw_verdict_undrawn_as(fw_arena *arena, const fw_device *device, fw_device_undrawn undrawn,
                                const fw_device **as) {
    fw_device *d = fw_arena_one(arena, fw_device);
    const size_t s = (size_t)device->nscene;
    FW_NEED(d);
    *d = *device;
    FW_NEED(d->scene = fw_arena_grow(arena, d->scene, s, s, sizeof *d->scene));
    for (size_t i = 0; i < s; i++) {
        fw_device_scene *scene = &d->scene[i];
        const size_t t = (size_t)scene->ncontact;
        if (t == 0) continue;
        FW_NEED(scene->contact =
                    fw_arena_grow(arena, scene->contact, t, t, sizeof *scene->contact));
        for (size_t k = 0; k < t; k++)
            if (scene->contact[k].undrawn == FW_UNDRAWN_NOT_SAID)
                scene->contact[k].undrawn = undrawn;
    }
    *as = d;
    return FW_OK;
}

static fw_status undrawn_sentence(fw_arena *arena, const fw_device *d,
                                  const fw_device_contact_use *c, bool second, fw_geometry_vec2 at,
                                  const char **text) {
    static const char not_said[] =
        "it has to be put there from elsewhere, or drawn by masks that you add; judged is that it "
        "stands where it is stated, and that its edge moves as all edges do (undrawn=\"placed\" or "
        "\"etched\" says which)";
    static const char placed[] =
        "it has to be put there from elsewhere, and what its place is off by comes off what the "
        "contact leaves";
    static const char etched[] = "masks that you add have to draw it in the same layer";
    static const char *const judged[] = {[FW_UNDRAWN_NOT_SAID] = not_said,
                                         [FW_UNDRAWN_PLACED] = placed,
                                         [FW_UNDRAWN_ETCHED] = etched};
    char x[32], y[32];
    const int body = second ? c->body_b : c->body_a;
    const double um = 1e-3; /* of coordinates: to a nanometre */
    FW_NEED(*text = fw_arena_printf(
                arena, "%s%s: the masks draw nothing of %s at %s(%s, %s) um: %s",
                FW_NAMED("contact", fw_text_name(c->id)),
                body == FW_GROUND ? "ground" : fw_text_name(d->body[body].id),
                c->face ? "" : "its point ",
                fw_number_text(x, sizeof x, um * nearbyint(1e9 * at.x), 6),
                fw_number_text(y, sizeof y, um * nearbyint(1e9 * at.y), 6), judged[c->undrawn]));
    return FW_OK;
}

fw_status fw_verdict_undrawn(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             fw_verdict_from_outside *list, int *n) {
    for (int i = 0; i < device->nscene; i++)
        for (int k = 0; k < 2 * device->scene[i].ncontact; k++) {
            const fw_device_contact_use *c = &device->scene[i].contact[k / 2];
            const char *text;
            fw_geometry_vec2 at;
            bool said = false;
            if (!is_outside(c) || is_of_layer(device, layout, c, k % 2, &at)) continue;
            FW_TRY(undrawn_sentence(arena, device, c, k % 2, at, &text));
            for (int j = 0; j < *n && !said; j++)
                said = strcmp(list[j].text, text) == 0;
            if (!said) list[(*n)++] = (fw_verdict_from_outside){text, 656, c->place};
        }
    return FW_OK;
}

/* A hinge without a distance of its own has the gap of its flexure, as made. What is drawn of two round things, or of a
   face and what it meets, grows by the edge; and where walls lean, to the face of the layer at which they stand out most, which
   meets first, by half of the flare more. All walls lean alike, so that two that are drawn meet at the same face. */
static void change_contact(const fw_verdict_fabrication *fabricated, const fw_device *d,
                           const fw_layout *layout, fw_device_contact_use *c) {
    const double edge_m =
        fabricated->edge_m + (d->meets_midway ? 0 : 0.5 * fabs(fabricated->flare_m));
    if (isnan(c->distance_m)) return;
    if (!is_outside(c)) {
        c->distance_m -= 2.0 * edge_m;
        return;
    }
    const bool etched = c->undrawn == FW_UNDRAWN_ETCHED;
    fw_geometry_vec2 at;
    const bool first = etched || is_of_layer(d, layout, c, false, &at),
               second = etched || is_of_layer(d, layout, c, true, &at);
    c->distance_m += (first + second) * edge_m;
}

/* What is left of a gap, or of round things, is nothing. The distance of a flat face is where what it meets begins, from
   that one's own point, and may lie on either side of it. */
static fw_status contact_gone(fw_arena *arena, const fw_device_contact_use *c, double drawn_m,
                              const char **gone) {
    char was[32], now[32];
    if (!(c->distance_m <= 0.0) || c->face) return FW_OK;
    fw_number_text(was, sizeof was, 1e6 * drawn_m, 4);
    fw_number_text(now, sizeof now, 1e6 * c->distance_m, 3);
    FW_NEED(*gone = fw_arena_printf(
                arena,
                is_outside(c)
                    ? "nothing is left of %s%s: its two round things, which touch at %s um "
                      "as drawn, would touch at %s um: make them larger"
                    : "the gap of %s%s closes: %s um as drawn, %s um are left: make it wider",
                FW_NAMED("contact", fw_text_name(c->id)), was, now));
    return FW_OK;
}

static fw_status change_scene(fw_arena *arena, const fw_verdict_fabrication *fabricated,
                              const fw_device *d, const fw_layout *layout, fw_device_scene *s,
                              const char **gone) {
    size_t c = (size_t)s->ncomb, a = (size_t)s->nair, t = (size_t)s->ncontact;
    double least = fabs(fabricated->flare_m);
    FW_NEED(s->comb = fw_arena_grow(arena, s->comb, c, c, sizeof *s->comb));
    FW_NEED(s->air = fw_arena_grow(arena, s->air, a, a, sizeof *s->air));
    FW_NEED(s->contact = fw_arena_grow(arena, s->contact, t, t, sizeof *s->contact));
    for (size_t i = 0; i < c; i++) {
        fw_device_comb *comb = &s->comb[i];
        change_comb(fabricated, d, comb);
        bool apart = comb->kind == FW_ELECTRODES_COMB && !(comb->overlap_m > 0.0);
        if (apart || !(comb->gap_m > least))
            FW_NEED(*gone =
                        fw_arena_printf(arena, "%s of %s%s %s", apart ? "the fingers" : "the gap",
                                        FW_NAMED("comb drive", fw_text_name(comb->id)),
                                        apart ? "no longer reach each other" : "closes"));
    }
    for (size_t i = 0; i < a; i++) {
        if (s->air[i].kind != FW_AIR_SQUEEZE) continue;
        change_film(fabricated, &s->air[i]);
        if (!(s->air[i].gap_m > least)) *gone = "the gap of a squeezed film closes";
    }
    for (size_t i = 0; i < t; i++) {
        fw_device_contact_use *contact = &s->contact[i];
        const double drawn_m = contact->distance_m;
        change_contact(fabricated, d, layout, contact);
        FW_TRY(contact_gone(arena, contact, drawn_m, gone));
    }
    return FW_OK;
}

static fw_status copy(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                      const fw_verdict_fabrication *fabricated, fw_verdict_fabricated_device *out) {
    fw_device *d = &out->device;
    size_t f = (size_t)device->nflexure, j = (size_t)device->nrevolute, b = (size_t)device->nbody;
    size_t s = (size_t)device->nscene;
    *d = *device;
    FW_NEED(d->flexure = fw_arena_grow(arena, d->flexure, f, f, sizeof *d->flexure));
    FW_NEED(d->revolute = fw_arena_grow(arena, d->revolute, j, j, sizeof *d->revolute));
    FW_NEED(d->body = fw_arena_grow(arena, d->body, b, b, sizeof *d->body));
    FW_NEED(d->scene = fw_arena_grow(arena, d->scene, s, s, sizeof *d->scene));
    if (!layout) return FW_OK;
    fw_layout *l = &out->layout;
    *l = *layout;
    out->drawn = l;
    l->edge_m = fabricated->edge_m;
    l->flare_m = fabricated->flare_m;
    if (!layout->drawn) return FW_OK;
    FW_NEED(l->hinge = fw_arena_grow(arena, l->hinge, j, j, sizeof *l->hinge));
    FW_NEED(l->body = fw_arena_grow(arena, l->body, b, b, sizeof *l->body));
    return FW_OK;
}

fw_status fw_verdict_fabrication_build(fw_arena *arena, const fw_device *device,
                                       const fw_layout *layout, const fw_mechanism_variant *variant,
                                       const fw_verdict_fabrication *fabricated,
                                       fw_verdict_fabricated_device *out) {
    *out = (fw_verdict_fabricated_device){.variant = *variant};
    bool drawn = layout && layout->drawn;
    FW_TRY(copy(arena, device, layout, fabricated, out));
    change_variant(&out->variant, fabricated);
    for (int i = 0; i < device->nflexure; i++)
        FW_TRY(change_flexure(arena, fabricated, &out->device.flexure[i], &out->gone));
    if (fabricated->sign) FW_TRY(tell_apart(arena, device, &out->device));
    for (int j = 0; fabricated->sign && j < device->nrevolute; j++) {
        const fw_verdict_fabrication here = at_hinge(fabricated, j);
        const int f = out->device.revolute[j].flexure;
        if (f != FW_NONE) FW_TRY(change_flexure(arena, &here, &out->device.flexure[f], &out->gone));
    }
    for (int i = 0; i < device->nscene; i++)
        if (fw_device_in_flow(device->scene[i].flow, variant->flow))
            FW_TRY(
                change_scene(arena, fabricated, device, layout, &out->device.scene[i], &out->gone));
    if (out->gone) return FW_OK;
    for (int j = 0; drawn && j < device->nrevolute; j++) {
        const fw_verdict_fabrication here = at_hinge(fabricated, j);
        int f = out->device.revolute[j].flexure;
        FW_TRY(change_hinge_layout(arena, &here, f == FW_NONE ? NULL : &out->device.flexure[f],
                                   &out->layout.hinge[j]));
    }
    for (int j = 0; j < device->nrevolute; j++)
        change_joint(device, layout, at_hinge(fabricated, j).edge_m, out, j);
    for (int b = 0; drawn && b < device->nbody; b++)
        change_body(&layout->body[b], fabricated->edge_m, &out->device.body[b],
                    &out->layout.body[b]);
    return FW_OK;
}

/* ---- how near stators come as made ----
   Breakdown asks for the least gap between electrodes that any device of the flow has. At corners that were run the
   distance lost, from where the motion begins to the least that it may be, is known. At others it is a product of what
   each input alone does to it, as every estimate there (verdict_corners.c), with the error that estimates were seen to
   have:  lost <= lost_0 exp(sum over inputs of max(g (low - x_0), g (high - x_0)) + error),  g = d ln lost/dx.
   In: corners of a search, m. Out: v->stator[].low_m. Range: corners with a motion; where one
   has none nothing may be left of the gap. Test: test_made.c, Breakdown in tests/cli/test_effects.py. Source: docs/theory/wiring.md, 4. */

fw_status fw_verdict_stators_keep(fw_arena *arena, const fw_verdict_variant_verdict *now,
                                  fw_verdict_fabricated_corner *corner) {
    const size_t n = (size_t)now->nstator;
    corner->nstator = now->nstator;
    if (n > 0)
        FW_NEED(corner->stator = fw_arena_grow(arena, now->stator, n, n, sizeof *corner->stator));
    return FW_OK;
}

/* what is lost at a corner; 10 nm more, so that nothing has a ratio; NaN: it is not known there */
static double lost_at(const fw_verdict_search *s, int point, const fw_wiring_moved *of) {
    const double hardly_m = 1e-8;
    const fw_verdict_fabricated_corner *c = &s->fabricated->corner[point];
    double most = (double)NAN;
    for (int i = 0; i < c->nstator; i++)
        if (c->stator[i].index == of->index && c->stator[i].stator == of->stator)
            most = fmax(most, c->stator[i].start_m - c->stator[i].low_m + hardly_m);
    return most;
}

/* NaN: at a corner that a slope would be made of it is not known */
static double lost_unrun(const fw_verdict_search *s, const fw_wiring_moved *of) {
    const double none = lost_at(s, 0, of);
    double ln = s->fabricated->error;
    for (int i = 0; i < s->v->ninput; i++) {
        const fw_verdict_fabrication_input *in = &s->v->input[i];
        const int like = s->slope_like[i], point = s->slope_point[like];
        if (point == FW_NONE) continue;
        const double off = s->fabricated->corner[point].x[like] - s->v->input[like].nominal,
                     scale = like < i ? in->edge_m / s->v->input[like].edge_m : 1,
                     slope = scale * log(lost_at(s, point, of) / none) / off;
        if (isnan(slope)) return slope;
        ln += fmax(slope * (in->low - in->nominal), slope * (in->high - in->nominal));
    }
    return none * exp(ln);
}

/* where it is not known what is lost nothing may be left of the gap */
void fw_verdict_stators_made(const fw_verdict_search *s, fw_verdict_variant_verdict *v) {
    for (int k = 0; k < v->nstator; k++) {
        fw_wiring_moved *to = &v->stator[k];
        double most = s->first > 0 && !s->fabricated->all ? lost_unrun(s, to) : 0;
        bool unknown = isnan(most);
        for (int p = 0; p < s->fabricated->ncorner; p++) {
            unknown = unknown || isnan(lost_at(s, p, to));
            most = fmax(most, lost_at(s, p, to));
        }
        if (unknown) to->low_m = fmin(to->low_m, 0);
        if (most > 0) to->low_m = fmin(to->low_m, to->start_m - most);
    }
}

const char *fw_verdict_search_value_text(fw_arena *arena, const fw_verdict_fabrication_input *input,
                                         double x) {
    fw_quantity q = input->q;
    char text[32];
    q.value = x;
    fw_number_text(text, sizeof text, fw_quantity_in_unit(&q), 4);
    bool unit = q.unit && strcmp(q.unit, "1") != 0;
    return fw_arena_printf(arena, "%s%s%s", text, unit ? " " : "", unit ? q.unit : "");
}
